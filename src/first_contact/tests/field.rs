use super::*;
use crate::number::{Estimate, Float};
use crate::problem::Problem;

/// Checks in longer numbers that the field lies below its fading bound, by a factor of at most the square of `1 + Rτ`,
/// some 1e4.
#[test]
fn motions_fade_as_is_said() -> Result<(), crate::Error> {
    for (damping, trips) in [("3.1", 36.25), ("3.1415", 33.5), ("2.9", 40.75)] {
        let rod = Problem::builder().length("1/2").wave_speed(1).damping(damping).impact_speed(2).build()?;
        // The fading bound starts at a quarter of 512 bits.
        let faded = FirstContact::new(&Parameters::<Estimate<Float>>::of(&rod, &512)?).faded(trips);
        let faded = faded.map_or(f64::NAN, f64::exp2);
        let contact = FirstContact::new(&Parameters::<Estimate<Float>>::of(&rod, &1200)?);
        let time = Estimate::exact(Float::with_val(1200, trips));
        let mut most = 0.0f64;
        for k in 0..=8 {
            let point = Estimate::exact(Float::with_val(1200, f64::from(k) / 16.0));
            let Field { velocity, strain, .. } = contact.field(&point, &time, Side::Right);
            assert!(velocity.bound().max(strain.bound()) < 1e-9 * faded, "{damping}");
            most = most.max(velocity.to_f64().abs() + strain.to_f64().abs());
        }
        assert!(most <= 2.0 * faded && most > 1e-5 * faded, "{damping}: {most:e} {faded:e}");
    }
    let early = FirstContact::new(&Parameters::<Estimate<f64>>::of(
        &Problem::uniform(1.into(), 1.into(), 1.into(), 1.into()),
        &(),
    )?);
    assert_eq!(early.faded(1e6), None);
    Ok(())
}
