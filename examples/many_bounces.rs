//! Many bounces in exact fractions: a vibration that one bounce starts and the next one undoes.
//!
//! The bar of Doyen, Ern and Piperno is dropped from the height 5 and hits the ground with μ = 10. While it flies, the
//! vibration left by the first contact goes on; it comes back in phase, so that the second contact takes it all away.

use dalembert::Problem;
use dalembert::rug::Rational;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rod = Problem::builder().length(10).wave_speed(30).gravity(10).impact_speed(10).impacts(6).build()?;
    let history = rod.exact()?;

    println!("{:>6} {:>6} {:>8} {:>10} {:>10}", "from", "to", "E", "E_h", "E_z");
    for contact in history.contacts() {
        let Some(to) = &contact.release else { break };
        let energy = history.energy(to.clone())?;
        // Energy is constant, and not within rounding: as a fraction.
        assert_eq!(energy.total, 500);
        println!(
            "{:>6} {:>6} {:>8} {:>10} {:>10}",
            contact.impact, to, energy.total, energy.translational, energy.vibrational
        );
    }

    // The motion is periodic: every event comes again after 16/3.
    let period = Rational::from((16, 3));
    for (event, later) in history.events().iter().zip(&history.events()[4..]) {
        assert_eq!(Rational::from(&event.t + &period), later.t);
        assert_eq!(event.v_end, later.v_end);
    }
    println!("every event returns after {period}");
    Ok(())
}
