//! Tests of the march against the first half of a contact by hand.

use super::SpringContact;
use dalembert::problem::Problem;
use dalembert::quantity::Quantity;

/// A rod of unit length, wave speed and speed presses a spring of `EA/k = s` in by `s (1 − exp(−t/s))` until the wave
/// from the top arrives at `t = 2`; its force per mass is `1 − exp(−t/s)`.
#[test]
fn a_spring_is_pressed_in() {
    let rod = Problem::builder().length(1).wave_speed(1).impact_speed(1).time(3).build().unwrap();
    let (softness, time) = (0.05_f64, 0.5_f64);
    let march = SpringContact::solve(&rod, softness, 3.0).unwrap();
    let grown = 1.0 - (-time / softness).exp();
    let impulse = time - softness * grown;
    let by_hand = [
        (Quantity::EndDisplacement, -softness * grown),
        (Quantity::TopDisplacement, -time),
        (Quantity::CentreVelocity, impulse - 1.0),
        (Quantity::Centre, -time + time * time / 2.0 - softness * (time - softness * grown)),
        (Quantity::Impulse, impulse),
    ];
    for (quantity, value) in by_hand {
        let found = march.at(quantity, time).unwrap();
        assert!((found - value).abs() < 1e-3, "{quantity:?}: {found} {value}");
    }
    // Nothing stands for a quantity that the march does not record.
    for quantity in [Quantity::Energy, Quantity::KineticEnergy, Quantity::Strain, Quantity::EndVelocity] {
        assert_eq!(march.at(quantity, time), None, "{quantity:?}");
    }
}
