//! Every example runs, and prints what it is about.

use std::process::Command;

fn runs(name: &str) -> String {
    let cargo = Command::new(env!("CARGO"))
        .args(["run", "--quiet", "--all-features", "--example", name])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(cargo.status.success(), "{name}: {}", String::from_utf8_lossy(&cargo.stderr));
    String::from_utf8(cargo.stdout).unwrap()
}

#[test]
fn first_bounce() {
    assert!(runs("first_bounce").contains("3.5000"));
}

/// The excess of the duration goes to 1.678347/ω, and the depth and the force to those of a rigid ground.
#[test]
fn soft_limit() {
    let text = runs("soft_limit");
    let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split_whitespace().collect()).collect();
    assert_eq!(rows.len(), 11);
    for row in &rows[3..10] {
        assert_eq!((row[2], row[4]), ("1.678346990017", "1.000000000000"), "{text}");
    }
}

#[test]
fn many_bounces() {
    assert!(runs("many_bounces").ends_with("every event returns after 16/3\n"));
}

#[test]
fn xt_lattice() {
    let text = runs("xt_lattice");
    let numbers = |line: &str| line.split_whitespace().map(|word| word.parse().unwrap()).collect::<Vec<f64>>();
    let rows: Vec<Vec<f64>> = text.lines().skip(1).map(numbers).collect();
    // Leaves, returns, and ([v_x], [v_t]) going up and coming down: the landing stops the end, [v_t] = μ = 3; from the
    // release on the rays carry μ₀ = g t₁ = 2, and a free end keeps it.
    let released = |from: f64| vec![from, from + 2.0, 2.0, -2.0, -2.0, -2.0];
    assert_eq!(rows, [vec![0.0, 2.0, -3.0, 3.0, 3.0, 3.0], released(2.0), released(4.0), released(6.0)]);
}

/// A contact code whose release comes within a step of 2/3.
#[test]
fn compare_your_code() {
    let text = runs("compare_your_code");
    let rows = text.lines().skip(1).map(|line| line.split(',').map(|x| x.parse::<f64>().unwrap()).collect::<Vec<_>>());
    let pushed = rows.filter(|row| row[3] > 0.0 && row[0] < 1.0).last().unwrap();
    assert!((pushed[0] - 2.0 / 3.0).abs() < 10.0 / 400.0 / 30.0, "{pushed:?}");
}

#[test]
fn snapshot_your_scene() {
    assert!(runs("snapshot_your_scene").starts_with("0 … 1: -3/4 … -5/4\n"));
}

/// The events of μ = 3, period 16.
#[test]
fn contact_switch() {
    let text = runs("contact_switch");
    let times: Vec<&str> = text.lines().filter_map(|line| line.split_whitespace().nth(1)).collect();
    assert_eq!(times, ["0", "2", "8", "10", "16", "18"]);
}

/// Chapter 6's limit, and no bounce from π on.
#[test]
fn damped_rod() {
    let text = runs("damped_rod");
    assert!(text.starts_with("R = 1: e_P = 0.380363101, in closed form 0.380363101,"), "{text}");
    assert!(text.contains("r = 3.14: leaves at 31.404098,"), "{text}");
    assert!(text.ends_with("r = 3.15: never leaves\n"), "{text}");
}

#[test]
fn sensitive_landing() {
    let text = runs("sensitive_landing");
    assert!(text.starts_with("μ = 1: t = 31") && text.ends_with("4√ε = 4.0000e-5\n"), "{text}");
}
