//! A snapshot test of the stress history of a scene of your own: a change in it fails the test.
//!
//! Put `main` into a test of your own crate. In exact fractions the text is the same on every machine, so a snapshot
//! (crate `insta`) may hold it. A snapshot says "unchanged", not "right": put an assertion beside it that you can
//! derive with pencil and paper. Review new snapshots with `cargo insta review`.

use dalembert::Scene;

const SCENE: &str = r#"
    title = "A rod of two metres, dropped"
    rod = { length = 2, wave_speed = 4 }
    impact = { speed = 3 }
    gravity = { acceleration = 2 }
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let stress = Scene::parse(SCENE)?.problem.exact()?.stress_history()?;
    println!("{stress}");

    // By hand: μ = 3 ≥ g t₁ = 2, so contact lasts t₁ = 1 and v_x = −(μ + g t)/c falls from −3/4 to −5/4.
    assert_eq!(stress.pieces[0].end, 1);
    assert_eq!(stress.pieces[0].strain_end.to_string(), "-5/4");

    // `insta::assert_snapshot!(stress)` keeps the text in a file beside your test; for a short one, inline:
    insta::assert_snapshot!(stress, @r"
    0 … 1: -3/4 … -5/4
    1 … 4: 0 … 0
    ends: the impact after the last contact asked for
    ");
    Ok(())
}
