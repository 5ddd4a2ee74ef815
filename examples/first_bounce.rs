//! The first bounce of a rod that hits the ground, and the formulas that it must obey.
//!
//! A rod of length L, wave speed c, falls with speed μ under gravity g. When its lower end meets the ground a wave runs
//! up the rod, turns at the free top and comes back after the round trip t₁ = 2L/c. Corollary 1 says when the end
//! leaves:
//!
//! * μ ≥ g t₁: exactly when the wave is back, t_b = t₁;
//! * μ < g t₁: later, t_b = 2t₁ − μ/g.

use dalembert::{Error, Problem};

fn main() -> Result<(), Error> {
    println!("  μ      t_b    Corollary 1   e_P      e_E²     h_max");
    for (text, speed) in [("1/2", 0.5), ("1", 1.0), ("3/2", 1.5), ("2", 2.0), ("4", 4.0)] {
        // L = c = g = 1, so t₁ = 2. A text stands for exactly the number that it spells.
        let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(text).build()?;
        let history = rod.doubles()?;
        let bounce = history.contacts()[0].release.unwrap_or(f64::NAN);
        let expected = if speed >= 2.0 { 2.0 } else { 4.0 - speed };
        assert!((bounce - expected).abs() < 1e-14);

        // Undamped, the rod loses no energy, but some of it goes on as vibration.
        let e = history.restitution(0)?;
        let (e_p, e_e) = (e.e_p.unwrap_or(f64::NAN), e.e_e2.unwrap_or(f64::NAN));
        let top = history.flights()?[0].top.unwrap_or(f64::NAN);
        println!("{text:>4}  {bounce:7.4}  {expected:9.4}   {e_p:7.4}  {e_e:7.4}  {top:7.4}");
    }
    Ok(())
}
