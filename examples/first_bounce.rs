//! The first bounce of a rod that hits the ground, and the formulas that it must obey.
//!
//! A rod of length L, wave speed c, falls with speed μ under gravity g. When its lower end meets the ground a wave runs up
//! the rod, turns at the free top and comes back after the round trip t₁ = 2L/c. Corollary 1 says when the end leaves:
//!
//! * μ ≥ g t₁: exactly when the wave is back, t_b = t₁;
//! * μ < g t₁: later, t_b = 2t₁ − μ/g.

use dalembert::quantity::{flights, restitution};
use dalembert::solve::undamped;
use dalembert::{Error, History, Number, Problem};

fn main() -> Result<(), Error> {
    let (length, wave_speed, gravity) = (1.0, 1.0, 1.0);
    let round_trip = 2.0 * length / wave_speed;
    println!("  μ      t_b    Corollary 1   e_P      e_E²     h_max");
    for (text, speed) in [("1/2", 0.5), ("1", 1.0), ("3/2", 1.5), ("2", 2.0), ("4", 4.0)] {
        // Numbers are given as text, so that 1/2 is exactly one half in every number system.
        let mu: Number = text.parse().unwrap_or_else(|_| Number::from(1));
        let problem = Problem::uniform(Number::from(1), Number::from(1), Number::from(1), mu);

        // Solve in double precision: `rug::Rational` instead of `f64` would give fractions.
        let history = undamped::<f64>(&problem, &())?;
        let contact = &history.contacts()[0];
        let bounce = contact.to.unwrap_or(f64::NAN);
        let expected = if speed >= gravity * round_trip { round_trip } else { 2.0 * round_trip - speed / gravity };
        assert!((bounce - expected).abs() < 1e-14);

        // The ground gives as much momentum as the rod gains, and carries its weight meanwhile.
        let gained = length * (history.centre(&bounce)?.1 + speed);
        assert!((contact.impulse - (gained + gravity * length * bounce)).abs() < 1e-13);

        // Restitution: undamped, the rod loses no energy, but some of it goes on as vibration.
        let e = restitution(&history, contact)?;
        let (e_p, e_e) = (e.momentum.unwrap_or(f64::NAN), e.energy_squared.unwrap_or(f64::NAN));
        let top = flights(&history)[0].highest.map_or(f64::NAN, |(_, height)| height);
        println!("{text:>4}  {bounce:7.4}  {expected:9.4}   {e_p:7.4}  {e_e:7.4}  {top:7.4}");
    }
    Ok(())
}
