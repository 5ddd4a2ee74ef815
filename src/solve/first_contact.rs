//! The first contact in doubles, repeated by its modes or in longer numbers where the bound exceeds what is asked.

use crate::first_contact::{Bounce, FirstContact};
use crate::modal::Modal;
use crate::motion::Side;
use crate::number::Estimate;
use crate::problem::Parameters;

/// Modes that are summed where the rays cancel: with them the stress is known to some 10⁻¹¹ of the lowest mode at
/// `τR² ≈ 300`, which is `R → π` and 30 round trips.
const MODES: u32 = 4096;

/// What the modes may be expected to reach.
const MODAL_ACCURACY: f64 = 1e-10;

/// `t_b` within `accuracy`, relative, of a rod whose parameters are exactly these doubles.
///
/// **Source**: [`FirstContact::bounce`], in doubles first: by the rays, then, where those cancel, by the modes; then in
/// numbers of up to 4096 bits. Without the feature `mp` doubles are all there is.
///
/// **Accuracy**: the bound of the time says what was reached.
///
/// ```
/// # use dalembert::{problem::Parameters, first_contact::{Bounce, FirstContact}, solve::bounce_within};
/// // g = 0, R = 3.135: the terms are e⁴⁸, their sum is of order one.
/// let rod = Parameters { length: 0.5, wave_speed: 1.0, damping: 3.135, gravity: 0.0, speed: 1.0 };
/// # #[cfg(feature = "mp")] {
/// let Bounce::At { time, .. } = bounce_within(&FirstContact::new(&rod.carry()), 1e-12) else { panic!("it bounces") };
/// assert!((time.value() - 15.33318837004014).abs() < 1e-11);
/// # }
/// ```
pub fn bounce_within(contact: &FirstContact<Estimate<f64>>, accuracy: f64) -> Bounce<Estimate<f64>> {
    let mut bounce = contact.bounce();
    if good(&bounce, accuracy) {
        return bounce;
    }
    // Late in the contact it is the rays that cancel, and the modes do not. Longer numbers are as fast and reach
    // farther.
    let worth = cfg!(not(feature = "mp")) || accuracy >= MODAL_ACCURACY;
    let late = match &bounce {
        Bounce::Undecided { until: time, .. } | Bounce::At { time, .. } => {
            *time.value() >= 2.0 * contact.round_trip().value()
        }
        Bounce::Never(_) => false,
    };
    if worth && late {
        let modal = Modal::new(&doubles(contact.rod()), MODES);
        // The last moment of a cell belongs to it.
        let side = |trips: &f64, k: i64| if *trips == (k + 1) as f64 { Side::Left } else { Side::Right };
        let by_modes = contact.bounce_by(&|trips, k| modal.ground(trips.value(), side(trips.value(), k)));
        if good(&by_modes, accuracy) {
            return by_modes;
        }
        if reach(&by_modes) < reach(&bounce) {
            bounce = by_modes;
        }
    }
    long::bounce(contact, accuracy).unwrap_or(bounce)
}

fn exact_enough(found: &Estimate<f64>, accuracy: f64) -> bool {
    found.bound() <= accuracy * found.value().abs()
}

fn doubles(rod: &Parameters<Estimate<f64>>) -> Parameters<f64> {
    Parameters {
        length: *rod.length.value(),
        wave_speed: *rod.wave_speed.value(),
        damping: *rod.damping.value(),
        gravity: *rod.gravity.value(),
        speed: *rod.speed.value(),
    }
}

/// The relative error of an answer, infinite where there is none.
fn reach(bounce: &Bounce<Estimate<f64>>) -> f64 {
    match bounce {
        Bounce::At { time, .. } => time.bound() / time.value(),
        Bounce::Never(_) => 0.0,
        Bounce::Undecided { .. } => f64::INFINITY,
    }
}

/// Whether more digits would add nothing.
fn good(bounce: &Bounce<Estimate<f64>>, accuracy: f64) -> bool {
    match bounce {
        Bounce::At { time, .. } => exact_enough(time, accuracy),
        Bounce::Never(_) => true,
        Bounce::Undecided { why, .. } => !why.needs_bits(),
    }
}

#[cfg(not(feature = "mp"))]
mod long {
    use super::*;

    pub(super) fn bounce(_: &FirstContact<Estimate<f64>>, _: f64) -> Option<Bounce<Estimate<f64>>> {
        None
    }
}

#[cfg(feature = "mp")]
mod long {
    use super::*;
    use crate::number::{Answer, Scalar};
    use rug::Float;

    /// Bits that are tried where doubles do not suffice.
    const LADDER: [u32; 6] = [128, 256, 512, 1024, 2048, 4096];

    /// The same rod, exactly, in longer numbers.
    fn longer(contact: &FirstContact<Estimate<f64>>, bits: u32) -> FirstContact<Estimate<Float>> {
        let rod = doubles(contact.rod());
        let lift = |x: f64| Float::with_val(bits, x).carry();
        FirstContact::new(&Parameters {
            length: lift(rod.length),
            wave_speed: lift(rod.wave_speed),
            damping: lift(rod.damping),
            gravity: lift(rod.gravity),
            speed: lift(rod.speed),
        })
    }

    /// The nearest double, with the bound of both.
    fn shorter(x: &Estimate<Float>) -> Estimate<f64> {
        let value = x.value().to_f64();
        Estimate::new(value, x.bound() / value.roundoff() + value.abs())
    }

    pub(super) fn bounce(contact: &FirstContact<Estimate<f64>>, accuracy: f64) -> Option<Bounce<Estimate<f64>>> {
        let mut last = None;
        for bits in LADDER {
            let bounce = longer(contact, bits).bounce().map(shorter);
            let enough = good(&bounce, accuracy.max(f64::EPSILON));
            last = Some(bounce);
            if enough {
                break;
            }
        }
        last
    }
}
