//! Every example runs, and prints something.

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

#[test]
fn many_bounces() {
    assert!(runs("many_bounces").ends_with("every event returns after 16/3\n"));
}

#[test]
fn xt_lattice() {
    assert_eq!(runs("xt_lattice").lines().count(), 5);
}

#[test]
fn snapshot_your_scene() {
    assert!(runs("snapshot_your_scene").starts_with("0 … 1: -3/4 … -5/4\n"));
}
