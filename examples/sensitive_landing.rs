//! A landing without speed costs half of the digits.
//!
//! c = L = g = 1. With μ = 1 the rod comes down at t = 31 so that its end touches without speed: its height has a
//! double root there. Where μ = 1 − ε the landing comes earlier by 4√ε, up to terms of the order of ε.

use dalembert::{Error, Problem};

fn landing(speed: &str) -> Result<f64, Error> {
    let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(speed).time(32).build()?;
    let events = rod.doubles()?.events().to_vec();
    Ok(events.last().map_or(f64::NAN, |event| event.t))
}

fn main() -> Result<(), Error> {
    let touch = landing("1")?;
    println!("μ = 1: t = {touch}");
    assert!((touch - 31.0).abs() < 1e-9);
    for digits in [4, 6, 8, 10] {
        let error = 10f64.powi(-digits);
        let earlier = 31.0 - landing(&format!("0.{}", "9".repeat(digits as usize)))?;
        println!("μ = 1 - {error:.0e}: earlier by {earlier:.4e}, 4√ε = {:.4e}", 4.0 * error.sqrt());
        assert!((earlier - 4.0 * error.sqrt()).abs() < 2.0 * error);
    }
    Ok(())
}
