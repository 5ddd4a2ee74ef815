//! Formulas as they stand in print, in plain doubles: additions, multiplications, divisions and square roots in the order in which
//! they are written, as a reader would program them. What goes wrong with them goes wrong in the same way on every machine.

use crate::first_contact::FirstContact;
use crate::history::Side;
use crate::number::Answer;
use crate::rod::Parameters;
use crate::special::{Special, gauss_legendre, i0_scaled, i1_scaled};

/// `I_n(z)`, n = 0 or 1, by its series.
pub(super) fn bessel(n: u32, z: f64) -> f64 {
    let square = z * z / 4.0;
    let (mut term, mut sum) = (if n == 0 { 1.0 } else { z / 2.0 }, 0.0);
    for m in 1..4000u32 {
        sum += term;
        term *= square / (f64::from(m) * f64::from(m + n));
        if term < 1e-20 * sum || !term.is_finite() {
            break;
        }
    }
    sum + term
}

/// `H_r(t)`. **Source**: before (2.28), with the k of (2.26) from a division.
pub(super) fn impact_kernel(r: f64, t1: f64, t: f64) -> f64 {
    let k = (t / t1).floor() as u32;
    let mut sum = bessel(0, r * t);
    for j in 1..=k {
        let late = f64::from(j) * t1;
        let ray = 2.0 * bessel(0, r * (t * t - late * late).max(0.0).sqrt());
        sum += if j % 2 == 0 { ray } else { -ray };
    }
    sum
}

/// The first t at which `H_r` is negative, g = 0: in steps of a thousandth of a round trip, then by halving; zero if there is none before 40.
/// **Source**: Theorem 1.
pub(super) fn first_tension(r: f64, t1: f64) -> f64 {
    let tensile = |t: f64| impact_kernel(r, t1, t) < 0.0;
    for step in 1000..40_000u32 {
        let (mut from, mut to) = (t1 * f64::from(step) / 1000.0, t1 * f64::from(step + 1) / 1000.0);
        if tensile(from) {
            return from;
        }
        if tensile(to) {
            for _ in 0..60 {
                let middle = 0.5 * (from + to);
                if tensile(middle) { to = middle } else { from = middle }
            }
            return to;
        }
    }
    0.0
}

/// `∫ₐᵇ f`, cut at `cuts`, by Gauss's rule with 24 nodes on each piece.
pub(super) fn integral(a: f64, b: f64, cuts: &[f64], f: impl Fn(f64) -> f64) -> f64 {
    let rule = gauss_legendre(&1.0f64, 24);
    let mut ends: Vec<f64> = cuts.iter().copied().filter(|cut| a < *cut && *cut < b).chain([a, b]).collect();
    ends.sort_by(f64::total_cmp);
    let piece = |from: f64, to: f64| {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        rule.iter().map(|(x, weight)| weight * half * f(middle + half * x)).sum::<f64>()
    };
    ends.windows(2).map(|pair| piece(pair[0], pair[1])).sum()
}

/// A rod with `c = L = 1`, and so `t₁ = 2`.
#[derive(Clone, Copy)]
pub(super) struct Printed {
    pub(super) r: f64,
    pub(super) g: f64,
    pub(super) mu: f64,
}

/// `t₁, 2t₁, …`
const TRIPS: [f64; 4] = [2.0, 4.0, 6.0, 8.0];

impl Printed {
    /// `Ψ_r(t)`. **Source**: (2.28), the integral by quadrature.
    pub(super) fn psi(self, t: f64) -> f64 {
        let Printed { r, g, mu } = self;
        let weight = integral(0.0, t, &TRIPS, |tau| (r * (t - tau)).exp() * impact_kernel(r, 2.0, tau));
        -mu * impact_kernel(r, 2.0, t) - g * weight
    }

    /// `v_x(0,t)`.
    pub(super) fn stress(self, t: f64) -> f64 {
        (-self.r * t).exp() * self.psi(t)
    }

    /// `P(t)` in contact. **Source**: (3.38), the integral by quadrature.
    pub(super) fn momentum(self, t: f64) -> f64 {
        let Printed { r, g, mu } = self;
        let push = integral(0.0, t, &TRIPS, |tau| (r * tau).exp() * self.psi(tau));
        let lost = (-2.0 * r * t).exp();
        -lost * push - g / (2.0 * r) * (1.0 - lost) - mu * lost
    }

    /// `h(t)` in contact. **Source**: (3.39).
    pub(super) fn centre(self, t: f64) -> f64 {
        integral(0.0, t, &TRIPS, |tau| self.momentum(tau))
    }

    /// `h(t)` in flight, released at `end`. **Source**: (3.44).
    pub(super) fn flight(self, end: f64, t: f64) -> f64 {
        let Printed { r, g, .. } = self;
        let (h0, h1) = (self.centre(end), self.momentum(end));
        let lost = (-2.0 * r * (t - end)).exp();
        let a = h1 + 2.0 * r * h0;
        (a - g * (t - end) - h1 * lost) / (2.0 * r) + g / (2.0 * r * (2.0 * r)) * (1.0 - lost)
    }

    /// `P(t)` in flight, released at `end`. **Source**: (3.43).
    pub(super) fn flying(self, end: f64, t: f64) -> f64 {
        let Printed { r, g, .. } = self;
        -g / (2.0 * r) + (self.momentum(end) + g / (2.0 * r)) * (-2.0 * r * (t - end)).exp()
    }

    /// The right-hand side of (2.32) for g = 1, the integral by quadrature.
    pub(super) fn threshold(r: f64) -> f64 {
        integral(0.0, 2.0, &[], |tau| (r * (2.0 - tau)).exp() * bessel(0, r * tau)) / (2.0 - bessel(0, 2.0 * r))
    }
}

/// `h_max` after a bounce with `h⁰`, `h¹`. **Source**: Remark 2, `r ≠ 0`.
pub(super) fn top_height(r: f64, g: f64, h0: f64, h1: f64) -> f64 {
    (h1 + 2.0 * r * h0) / (2.0 * r) - g / (4.0 * r * r) * (1.0 + 2.0 * r * h1 / g).ln()
}

/// `t*` after a bounce at `end` with `h¹`. **Source**: Remark 2, `r ≠ 0`.
pub(super) fn top_time(r: f64, g: f64, end: f64, h1: f64) -> f64 {
    end + 1.0 / (2.0 * r) * (1.0 + 2.0 * r * h1 / g).ln()
}

/// `I₀(z)` by the integral (2.16), the trapezoidal rule over a period.
pub(super) fn bessel_integral(z: f64) -> f64 {
    let angle = |k: u32| std::f64::consts::PI * f64::from(k) / 24.0;
    (0..24).map(|k| (z * angle(k).sin()).cosh()).sum::<f64>() / 24.0
}

/// `K₀(z) = ∫₀^∞ e^{−z cosh s} ds`, the function of the second kind, by the trapezoidal rule.
pub(super) fn second_kind(z: f64) -> f64 {
    let step = 1.0 / 16.0;
    (1..200u32).map(|k| (-z * (step * f64::from(k)).cosh()).exp() * step).sum::<f64>() + 0.5 * step * (-z).exp()
}

/// `I₀⁻¹(2)`, by Newton's method.
pub(super) fn inverse_bessel<S: Special>(like: &S) -> S {
    let mut z = like.ratio(9, 5);
    for _ in 0..10 {
        let (value, slope) = (i0_scaled(&z), i1_scaled(&z));
        z = z.clone() - (value - (-z).exp() * like.int(2)) / slope;
    }
    z
}

/// The right-hand side of (2.32) in closed form: `μ₀ (I₀(R) + I₁(R))/(2 − I₀(R))` with `μ₀ = 2`.
pub(super) fn threshold<S: Special>(r: &S) -> S {
    let round_trip = r.int(2) * r;
    let (i0, i1) = (i0_scaled(&round_trip), i1_scaled(&round_trip));
    let two = r.int(2) * &(-round_trip).exp();
    (i0.clone() + i1) * &r.int(2) / (two - i0)
}

#[cfg(feature = "mp")]
/// `lim e_E` for `μ → ∞` and `t_b = t₁ = 2`: `2e^{−R}(I₀(R) − I₁(R)) − e^{−2R}`.
pub(super) fn limit<S: Special>(r: &S) -> S {
    let round_trip = r.int(2) * r;
    let decay = (-(round_trip.clone() * &r.int(2))).exp();
    (i0_scaled(&round_trip) - i1_scaled(&round_trip)) * &r.int(2) - decay
}

/// The decimal in so many bits.
#[cfg(feature = "mp")]
pub(super) fn decimal(text: &str, bits: u32) -> rug::Float {
    let value = text.parse::<crate::Number>().map(|number| number.to_rational()).unwrap_or_default();
    rug::Float::with_val(bits, value)
}

/// `E − E_h` at `t₁`, both summed first.
pub(super) fn energy_difference(rod: &Parameters<f64>) -> f64 {
    let contact = FirstContact::new(&rod.carry());
    let end = rod.round_trip();
    let (height, rate) = contact.centre(&end.carry());
    let moving = rod.length * (0.5 * rate.value() * rate.value() + rod.gravity * height.value());
    let density = |x: f64| {
        let field = contact.field(&x.carry(), &end.carry(), Side::Left);
        let (velocity, strain) = (field.velocity.value(), rod.wave_speed * field.strain.value());
        0.5 * (velocity * velocity + strain * strain) + rod.gravity * field.displacement.value()
    };
    integral(0.0, rod.length, &[], density) - moving
}

/// `E(0) − 2r ∫₀ᵗ∫ v_t² dx dt`, c = L = 1, t < 2. **Source**: (3.55), integrated.
pub(super) fn energy_left(rod: &Parameters<f64>, t: f64) -> f64 {
    let contact = FirstContact::new(&rod.carry());
    let motion = |time: f64| {
        let ray = if time < 1.0 { time } else { 2.0 - time };
        integral(0.0, 1.0, &[ray], |x| contact.field(&x.carry(), &time.carry(), Side::Right).velocity.value().powi(2))
    };
    0.5 * rod.speed * rod.speed - 2.0 * rod.damping * integral(0.0, t, &[1.0], motion)
}

/// c = L = 1.
pub(super) fn rod(damping: f64, gravity: f64, speed: f64) -> Parameters<f64> {
    Parameters { length: 1.0, wave_speed: 1.0, damping, gravity, speed }
}
