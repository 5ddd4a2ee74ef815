//! Bessel functions as the paper defines them, in doubles.

use std::f64::consts::PI;

/// `I₀(z)` by the integral (2.16). **Accuracy**: within a few roundings.
pub(crate) fn i0(z: f64) -> f64 {
    period(z, |_| 1.0)
}

/// `I₁(z)/z`, from the same integral by parts. **Accuracy**: within a few roundings.
pub(super) fn i1_over_z(z: f64) -> f64 {
    period(z, |angle| angle.sin().powi(2))
}

/// The mean of `weight(θ) cosh(z cos θ)` over a period by the trapezoidal rule, which converges geometrically.
fn period(z: f64, weight: impl Fn(f64) -> f64) -> f64 {
    // The rule leaves 2 I_{2n}(z): below a roundoff of I₀ for all z.
    let n = 12 + (2.0 * z.sqrt() + 0.6 * z) as i32;
    let point = |k: i32| {
        let angle = PI * f64::from(k) / f64::from(n);
        weight(angle) * (z * angle.cos()).cosh()
    };
    (0..n).map(point).sum::<f64>() / f64::from(n)
}

#[cfg(test)]
#[path = "tests/bessel.rs"]
mod tests;
