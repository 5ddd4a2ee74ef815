//! How to hold on to the stress history of a scene of your own, so that a change in it does not go unseen.
//!
//! Put `stress_history` and the test below into your own `tests/`, and name your own scene. In exact fractions the text is
//! the same on every machine, so a snapshot (crate `insta`) may hold it. A snapshot says "unchanged", not "right": put an
//! assertion beside it that you can derive with pencil and paper. Review new snapshots with `cargo insta review`.

use dalembert::{Ask, Plan, Scene, Solution, solve};

const SCENE: &str = r#"
    title = "A rod of two metres, dropped"
    rod = { length = 2, wave_speed = 4 }
    impact = { speed = 3 }
    gravity = { acceleration = 2 }
"#;

/// One line for each piece of the stress at the ground: from, to, and v_x at both ends.
fn stress_history(scene: &str) -> Result<String, Box<dyn std::error::Error>> {
    let scene = Scene::parse(scene)?;
    let plan = Plan::of(&scene, Ask { exact: true, ..Ask::default() })?;
    let Solution::Exact(history, _) = solve(&scene.problem, &plan, |_, _| ())? else {
        return Err("the plan did not choose fractions".into());
    };
    let pieces = history.stress_pieces();
    let lines = pieces.iter().map(|piece| format!("{} … {}: {} … {}", piece.from, piece.to, piece.left, piece.right));
    Ok(lines.collect::<Vec<_>>().join("\n"))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let stress = stress_history(SCENE)?;
    println!("{stress}");

    // By hand: μ = 3 ≥ g t₁ = 2, so contact lasts t₁ = 1 and v_x = −(μ + g t)/c falls from −3/4 to −5/4.
    assert!(stress.starts_with("0 … 1: -3/4 … -5/4\n"));

    // `insta::assert_snapshot!(stress)` keeps the text in a file beside your test; for a short one, inline:
    insta::assert_snapshot!(stress, @r"
    0 … 1: -3/4 … -5/4
    1 … 4: 0 … 0
    ");
    Ok(())
}
