//! Search for the release: the first time at which the stress at the ground is tensile.

use super::PrintedIntegrals;
use dalembert::Side;

/// Number of round trips that are searched for a release.
const MOST_TRIPS: i64 = 64;

/// Returns the first time at which a stress is tensile: just after a lattice time, or at a rise through zero between
/// two, provided that one of `looks` samples in each round trip shows it; `None` after 64 round trips. The search
/// proves nothing.
pub(crate) fn first_release(round_trip: f64, looks: i64, stress: impl Fn(f64, Side) -> f64) -> Option<f64> {
    for k in 1..=MOST_TRIPS {
        let start = k as f64 * round_trip;
        let mut low = (start, stress(start, Side::Right));
        if low.1 >= 0.0 {
            return Some(start);
        }
        for look in 1..=looks {
            let (part, last) = (look as f64 / looks as f64, look == looks);
            let time = if last { (k + 1) as f64 * round_trip } else { start + round_trip * part };
            let high = (time, stress(time, if last { Side::Left } else { Side::Right }));
            if high.1 >= 0.0 {
                return Some(root(low, high, |t| stress(t, Side::Right)));
            }
            low = high;
        }
    }
    None
}

/// Returns the root between `low` and `high`, points (t, f), by the Illinois rule: regula falsi that halves the value
/// at an end that stays.
fn root(mut low: (f64, f64), mut high: (f64, f64), f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..60 {
        let time = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
        if !(time > low.0 && time < high.0) || high.0 - low.0 <= 2.0 * f64::EPSILON * high.0 {
            break;
        }
        let value = f(time);
        if value == 0.0 {
            return time;
        }
        if value < 0.0 {
            low = (time, value);
            high.1 *= 0.5;
        } else {
            high = (time, value);
            low.1 *= 0.5;
        }
    }
    if high.1.abs() < low.1.abs() { high.0 } else { low.0 }
}

impl PrintedIntegrals {
    /// Returns the release that [`first_release`] finds.
    pub(crate) fn release(&self, round_trip: f64, looks: i64) -> Option<f64> {
        // The limit from earlier times at a lattice time leaves out the ray that arrives there.
        let before = |t: f64, side: Side| if side == Side::Left { t * (1.0 - 4.0 * f64::EPSILON) } else { t };
        first_release(round_trip, looks, |t, side| self.strain(before(t, side)))
    }
}
