//! Thresholds, limits and the flight: as printed, or in the closed form that follows from the print.

use super::printed::Printed;
pub use super::printed::i0;
use super::quadrature::Quadrature;
use dalembert::Side;
use dalembert::special::{Special, i0_scaled, i1_scaled};

/// Round trips in which a release is looked for.
const MOST_TRIPS: i64 = 64;

/// The first time at which a stress is tensile: just after a lattice time, or where it rises through zero between two,
/// if one of `looks` in each round trip shows that. A search without a proof, for routes that have no other; `None`
/// after 64 round trips.
pub fn first_release(round_trip: f64, looks: i64, stress: impl Fn(f64, Side) -> f64) -> Option<f64> {
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

/// The Illinois rule: regula falsi that halves the value at an end that stays.
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

impl Printed {
    /// The first release that [`first_release`] finds.
    pub fn release(&self, round_trip: f64, looks: i64) -> Option<f64> {
        // The limit from earlier times at a lattice time is that without the ray that arrives there.
        let before = |t: f64, side: Side| if side == Side::Left { t * (1.0 - 4.0 * f64::EPSILON) } else { t };
        first_release(round_trip, looks, |t, side| self.strain(before(t, side)))
    }
}

/// `∫ f` over `[a,b]`, cut at `cut`.
pub fn integral(ends: [f64; 2], cut: f64, f: &dyn Fn(f64) -> f64) -> f64 {
    Quadrature::new(1e-13).integral(ends, &[cut], 0.0, f)
}

/// `t*` after a bounce at `end` with `h¹`. **Source**: Remark 2, `r ≠ 0`.
pub fn top_time(r: f64, g: f64, end: f64, h1: f64) -> f64 {
    end + 1.0 / (2.0 * r) * (1.0 + 2.0 * r * h1 / g).ln()
}

/// `h_max` after a bounce with `h⁰`, `h¹`. **Source**: Remark 2, `r ≠ 0`.
pub fn top_height(r: f64, g: f64, h0: f64, h1: f64) -> f64 {
    (h1 + 2.0 * r * h0) / (2.0 * r) - g / (4.0 * r * r) * (1.0 + 2.0 * r * h1 / g).ln()
}

/// `I₀(z)` by its series.
pub fn i0_series(z: f64) -> f64 {
    let square = z * z / 4.0;
    let (mut term, mut sum) = (1.0, 0.0);
    for m in 1..4000u32 {
        sum += term;
        term *= square / f64::from(m).powi(2);
        if term < 1e-20 * sum {
            break;
        }
    }
    sum + term
}

/// `K₀(z) = ∫₀^∞ e^{−z cosh s} ds`, the function of the second kind, by the trapezoidal rule.
pub fn k0(z: f64) -> f64 {
    let step = 1.0 / 16.0;
    (1..200u32).map(|k| (-z * (step * f64::from(k)).cosh()).exp() * step).sum::<f64>() + 0.5 * step * (-z).exp()
}

/// `I₀(z)`, of the first kind.
pub fn i0_first_kind<S: Special>(z: &S) -> S {
    i0_scaled(z) * &z.exp()
}

/// `I₀⁻¹(2)`, by Newton's method from 9/5: ten steps double the digits ten times.
pub fn inverse_i0_of_2<S: Special>(like: &S) -> S {
    let mut z = like.ratio(9, 5);
    for _ in 0..10 {
        let (value, slope) = (i0_scaled(&z), i1_scaled(&z));
        z = z.clone() - (value - (-z).exp() * like.int(2)) / slope;
    }
    z
}

/// The right-hand side of (2.32) in closed form, `c = L = g = 1`: `μ₀ (I₀(R) + I₁(R))/(2 − I₀(R))` with `μ₀ = 2`.
pub fn threshold<S: Special>(r: &S) -> S {
    let ratio = r.int(2) * r;
    let (i0, i1) = (i0_scaled(&ratio), i1_scaled(&ratio));
    let two = r.int(2) * &(-ratio).exp();
    (i0.clone() + i1) * &r.int(2) / (two - i0)
}

/// `lim e_E` for `μ → ∞` and `t_b = t₁ = 2`: `2e^{−R}(I₀(R) − I₁(R)) − e^{−2R}`, where (4.75) has `e^{−R}`.
pub fn limit<S: Special>(r: &S) -> S {
    let ratio = r.int(2) * r;
    let decay = (-(ratio.clone() * &r.int(2))).exp();
    (i0_scaled(&ratio) - i1_scaled(&ratio)) * &r.int(2) - decay
}
