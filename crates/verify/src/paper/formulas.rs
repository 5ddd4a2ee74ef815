//! Thresholds, limits and the flight after the bounce: as printed, or in the closed form that follows from the print.

pub(crate) use super::integrals::i0;
use super::quadrature::Quadrature;
use dalembert::special::{Special, i0_scaled, i1_scaled};

/// Integrates `f` over `[a,b]`, cut at `cut`, to a relative tolerance of 1e-13.
pub(crate) fn integral(ends: [f64; 2], cut: f64, f: &dyn Fn(f64) -> f64) -> f64 {
    Quadrature::new(1e-13).integral(ends, &[cut], 0.0, f)
}

/// Computes `t*`, the time of the top, after a bounce at `end` with `h¹`. **Source**: Remark 2, `r ≠ 0`.
pub(crate) fn top_time(r: f64, g: f64, end: f64, h1: f64) -> f64 {
    end + 1.0 / (2.0 * r) * (1.0 + 2.0 * r * h1 / g).ln()
}

/// Computes `h_max`, the height of the top, after a bounce with `h⁰`, `h¹`. **Source**: Remark 2, `r ≠ 0`.
pub(crate) fn top_height(r: f64, g: f64, h0: f64, h1: f64) -> f64 {
    (h1 + 2.0 * r * h0) / (2.0 * r) - g / (4.0 * r * r) * (1.0 + 2.0 * r * h1 / g).ln()
}

/// Computes `I₀(z)` by its series.
pub(crate) fn i0_series(z: f64) -> f64 {
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

/// Computes `K₀(z) = ∫₀^∞ e^{−z cosh s} ds`, the function of the second kind, by the trapezoidal rule.
pub(crate) fn k0(z: f64) -> f64 {
    let step = 1.0 / 16.0;
    (1..200u32).map(|k| (-z * (step * f64::from(k)).cosh()).exp() * step).sum::<f64>() + 0.5 * step * (-z).exp()
}

/// A number of the paper that belongs to no rod, or to `c = L = g = 1`. A fraction `[p, q]` stands for `p/q`.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Constant {
    /// `I₀(z)`, the function of the first kind.
    BesselI0([i64; 2]),
    /// `I₀⁻¹(2)`.
    InverseI0Of2,
    /// The least `μ` that bounces at `t₁`, for `r`.
    Threshold([i64; 2]),
    /// `lim e_E` for `μ → ∞`, for `r`.
    RestitutionLimit([i64; 2]),
}

impl Constant {
    /// Computes the number in the system and precision of `like`.
    pub(crate) fn value<S: Special>(self, like: &S) -> S {
        let fraction = |[p, q]: [i64; 2]| like.ratio(p, q);
        match self {
            Constant::BesselI0(z) => i0_scaled(&fraction(z)) * &fraction(z).exp(),
            Constant::InverseI0Of2 => inverse_i0_of_2(like),
            Constant::Threshold(r) => threshold(&fraction(r)),
            Constant::RestitutionLimit(r) => restitution_limit(&fraction(r)),
        }
    }
}

/// Computes `I₀⁻¹(2)` by ten steps of Newton's method from 9/5, each of which doubles the digits.
fn inverse_i0_of_2<S: Special>(like: &S) -> S {
    let mut z = like.ratio(9, 5);
    for _ in 0..10 {
        let (value, slope) = (i0_scaled(&z), i1_scaled(&z));
        z = z.clone() - (value - (-z).exp() * like.int(2)) / slope;
    }
    z
}

/// Computes the right-hand side of (2.32) in closed form for `c = L = g = 1`: `μ₀ (I₀(R) + I₁(R))/(2 − I₀(R))` with
/// `μ₀ = 2`, `R = 2r`.
fn threshold<S: Special>(r: &S) -> S {
    let ThresholdRatio { numerator, denominator } = ThresholdRatio::new(&(r.int(2) * r));
    numerator * &r.int(2) / denominator
}

/// The right-hand side of (2.32), divided by `μ₀`, as a fraction: `(I₀(R) + I₁(R))/(2 − I₀(R))`, both times `e^{−R}`.
pub(crate) struct ThresholdRatio<S> {
    pub(crate) numerator: S,
    /// No speed is high enough for a bounce at `t₁` unless this is positive.
    pub(crate) denominator: S,
}

impl<S: Special> ThresholdRatio<S> {
    /// Computes both terms for `R = r t₁`.
    pub(crate) fn new(damping_ratio: &S) -> Self {
        let (i0, i1) = (i0_scaled(damping_ratio), i1_scaled(damping_ratio));
        let denominator = (-damping_ratio.clone()).exp() * damping_ratio.int(2) - &i0;
        ThresholdRatio { numerator: i0 + i1, denominator }
    }
}

/// Computes `lim e_E` for `μ → ∞`, `t_b = t₁ = 2`: `2e^{−R}(I₀(R) − I₁(R)) − e^{−2R}`, where (4.75) has `e^{−R}`.
pub(crate) fn restitution_limit<S: Special>(r: &S) -> S {
    let ratio = r.int(2) * r;
    let decay = (-(ratio.clone() * &r.int(2))).exp();
    (i0_scaled(&ratio) - i1_scaled(&ratio)) * &r.int(2) - decay
}
