//! A damped rod without gravity: the wake of the impact, what the bounce keeps, and how late it comes.
//!
//! L = 1/2 and c = μ = 1, so that t₁ = 1 and R = r. Chapters 6 and 7 of the guide derive what is asserted here.

use dalembert::{Error, Problem, Side, TypedHistory};
use std::f64::consts::PI;

/// `I_n(z) = Σ (z/2)^{n+2k}/(k!(n+k)!)` for n = 0, 1.
fn bessel(n: u32, z: f64) -> f64 {
    let nested = (1..40).rev().fold(1.0, |sum, k| 1.0 + sum * z * z / 4.0 / f64::from(k * (n + k)));
    nested * (z / 2.0).powi(n as i32)
}

fn solved(damping: &str) -> Result<TypedHistory<f64>, Error> {
    Problem::builder().length("1/2").wave_speed(1).damping(damping).impact_speed(1).build()?.doubles()
}

fn main() -> Result<(), Error> {
    let history = solved("1")?;
    for time in [0.25, 0.5, 0.75] {
        // Until the first ray is back: v_x(0,t) = −μ e^{−rt} I₀(rt)/c.
        assert!((history.strain(time, Side::Right)? + (-time).exp() * bessel(0, time)).abs() < 1e-14);
    }
    let kept = history.restitution(0)?.e_p.unwrap_or(f64::NAN);
    let theory = 2.0 * (-1f64).exp() * (bessel(0, 1.0) - bessel(1, 1.0)) - (-2f64).exp();
    println!("R = 1: e_P = {kept:.9}, in closed form {theory:.9}, and e^(-R) = {:.9}", (-1f64).exp());
    assert!((kept - theory).abs() < 1e-9);

    for r in ["3.1", "3.13", "3.14"] {
        // The lowest mode decides, to a few percent.
        let swing = PI / (PI * PI - r.parse::<f64>().unwrap_or(f64::NAN).powi(2)).sqrt();
        let time = solved(r)?.contacts()[0].release.unwrap_or(f64::NAN);
        println!("r = {r}: leaves at {time:.6}, half a swing of the lowest mode {swing:.4}");
        assert!((time / swing - 1.0).abs() < 0.04);
    }
    assert_eq!(solved("3.15")?.contacts()[0].release, None); // From R = π on it does not swing.
    println!("r = 3.15: never leaves");
    Ok(())
}
