//! Doubles that know when they do not suffice, and what they turn to.

use super::bounce::{Bounce, Route};
use super::field::{Estimate, FirstContact};
use crate::history::Side;
use crate::modal::Modal;
use crate::number::Analytic;
#[cfg(feature = "mp")]
use crate::rod::Parameters;

/// Modes that are summed where the rays cancel: with them the stress is known to some 10⁻¹¹ of the lowest mode at
/// `τR² ≈ 300`, which is `R → π` and 30 round trips.
const MODES: u32 = 4096;

/// What the modes may be expected to reach.
const MODAL_ACCURACY: f64 = 1e-10;

impl FirstContact<f64> {
    /// `t_b`, with as many digits in between as it takes, up to some thousand, to be sure of `accuracy`, relative.
    ///
    /// **Source**: [`FirstContact::bounce`], in doubles first: by the rays, then, where those cancel, by the modes. Without the
    /// feature `mp` that is also the last word.
    ///
    /// **Accuracy**: `error` says what was reached.
    ///
    /// ```
    /// # use dalembert::{rod::Parameters, first_contact::{Bounce, FirstContact}};
    /// // g = 0, R = 3.135: the terms are e⁴⁸, their sum is of order one.
    /// let rod = Parameters { length: 0.5, wave_speed: 1.0, damping: 3.135, gravity: 0.0, speed: 1.0 };
    /// # #[cfg(feature = "mp")] {
    /// let Bounce::At { time, .. } = FirstContact::new(&rod).bounce_within(1e-12) else { panic!("it bounces") };
    /// assert!((time - 15.33318837004014).abs() < 1e-11);
    /// # }
    /// ```
    pub fn bounce_within(&self, accuracy: f64) -> Bounce<f64> {
        let mut bounce = self.bounce();
        if good(&bounce, accuracy) {
            return bounce;
        }
        // Late in the contact it is the rays that cancel, and the modes do not. Longer numbers are as fast and know more.
        let worth = cfg!(not(feature = "mp")) || accuracy >= MODAL_ACCURACY;
        let late = worth
            && match &bounce {
                Bounce::Undecided { until, .. } => *until >= 2.0 * self.round_trip,
                Bounce::At { time, .. } => *time >= 2.0 * self.round_trip,
                Bounce::Never { .. } => false,
            };
        if late {
            let by_modes = self.bounce_by(&Route::Modes(Modal::new(&self.rod, MODES)));
            if good(&by_modes, accuracy) {
                return by_modes;
            }
            if reach(&by_modes) < reach(&bounce) {
                bounce = by_modes;
            }
        }
        #[cfg(feature = "mp")]
        {
            bounce = escalate(&self.rod, accuracy).unwrap_or(bounce);
        }
        bounce
    }

    /// `v_x(0,t)` to `accuracy`, relative, as far as longer numbers reach; and the bits that were used, 53 for doubles.
    ///
    /// **Source**: [`FirstContact::stress`]. Without the feature `mp` doubles are all there is.
    ///
    /// **Accuracy**: the estimate's `error` says what was reached.
    pub fn stress_within(&self, time: f64, side: Side, accuracy: f64) -> (Estimate<f64>, u32) {
        let stress = self.stress(&time, side);
        let enough = |found: &Estimate<f64>| found.error <= accuracy * found.value.abs();
        if enough(&stress) || stress.error.is_infinite() {
            return (stress, 53);
        }
        #[cfg(feature = "mp")]
        {
            use crate::number::Scalar;
            // A lattice time as doubles compute it is meant to be that lattice time.
            let trips = self.trips(&time);
            let whole = trips.floor_int().filter(|k| trips == *k as f64);
            for bits in LADDER {
                let long = longer(&self.rod, bits);
                let time = match whole {
                    Some(k) => long.round_trip() * k,
                    None => rug::Float::with_val(bits, time),
                };
                let found = long.stress(&time, side);
                let value = found.value.to_f64();
                let found = Estimate { value, error: found.error + 2f64.powi(-53) * value.abs() };
                if enough(&found) {
                    return (found, bits);
                }
            }
        }
        (stress, 53)
    }
}

/// Bits that are tried where doubles do not suffice.
#[cfg(feature = "mp")]
const LADDER: [u32; 6] = [128, 256, 512, 1024, 2048, 4096];

/// The same rod, exactly, in longer numbers.
#[cfg(feature = "mp")]
fn longer(rod: &Parameters<f64>, bits: u32) -> FirstContact<rug::Float> {
    let lift = |x: f64| rug::Float::with_val(bits, x);
    FirstContact::new(&Parameters {
        length: lift(rod.length),
        wave_speed: lift(rod.wave_speed),
        damping: lift(rod.damping),
        gravity: lift(rod.gravity),
        speed: lift(rod.speed),
    })
}

/// The relative error of an answer, infinite where there is none.
fn reach(bounce: &Bounce<f64>) -> f64 {
    match bounce {
        Bounce::At { time, error, .. } => error / time,
        Bounce::Never { .. } => 0.0,
        Bounce::Undecided { .. } => f64::INFINITY,
    }
}

/// Whether more digits would add nothing.
fn good<S: Analytic>(bounce: &Bounce<S>, accuracy: f64) -> bool {
    match bounce {
        Bounce::At { time, error, .. } => *error <= accuracy * time.to_f64(),
        Bounce::Never { .. } => true,
        Bounce::Undecided { digits, .. } => !digits,
    }
}

/// The bounce from the same parameters, exact in longer numbers.
#[cfg(feature = "mp")]
fn escalate(rod: &Parameters<f64>, accuracy: f64) -> Option<Bounce<f64>> {
    let mut last = None;
    for bits in LADDER {
        let bounce = longer(rod, bits).bounce();
        let enough = good(&bounce, accuracy);
        last = Some(match bounce {
            Bounce::At { time, kind, error } => {
                Bounce::At { error: error + 2f64.powi(-53) * time.to_f64(), time: time.to_f64(), kind }
            }
            Bounce::Never { reason } => Bounce::Never { reason },
            Bounce::Undecided { until, why, digits } => Bounce::Undecided { until: until.to_f64(), why, digits },
        });
        if enough {
            break;
        }
    }
    last
}
