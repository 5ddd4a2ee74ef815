//! The first contact in doubles where it is hard: extremes of every parameter, times on a ray, thresholds, lost digits.
#![allow(clippy::unwrap_used, clippy::panic)]

use dalembert::first_contact::{Bounce, BounceKind, FirstContact};
use dalembert::rod::Parameters;

fn rod(damping: f64, gravity: f64, length: f64, speed: f64) -> Parameters<f64> {
    Parameters { length, wave_speed: 1.0, damping, gravity, speed }
}

/// g = 0, R → π: terms of 10⁴⁰ add up to one, and the modes give the root without longer numbers.
#[test]
fn late_bounces_without_longer_numbers() {
    for (damping, truth) in
        [(3.13, 11.661_366_701_443_884), (3.135, 15.333_188_370_040_146), (3.14, 31.404_098_476_589_4)]
    {
        let contact = FirstContact::new(&rod(damping, 0.0, 0.5, 1.0));
        let Bounce::At { time, kind, error } = contact.bounce_within(1e-9) else { panic!("{damping}") };
        assert_eq!(kind, BounceKind::Root);
        // dt_b/dr = (π/Ω³) r and more: the double nearest to r is up to 2.2·10⁻¹⁶ away.
        let omega = ((std::f64::consts::PI - damping) * (std::f64::consts::PI + damping)).sqrt();
        let input = 2.3e-16 * damping * std::f64::consts::PI / omega.powi(3);
        println!("{damping}: {time} {error:e} {:e} {input:e}", time - truth);
        assert!((time - truth).abs() <= error + input, "{damping}: {time} {error:e}");
        assert!(error < 1e-9 * truth, "{damping}: {error:e}");
    }
}
