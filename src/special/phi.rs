//! Functions `φ₁`, `φ₂` of free fall with drag, and two logarithmic means for its highest point, regular at zero.

use super::bits;
use crate::number::Analytic;

/// Computes `φ₁(z) = (eᶻ − 1)/z`, 1 at `z = 0`.
///
/// **Source**: (3.38), (3.43) without the division by `2r`.
///
/// **Accuracy**: within 3 roundings.
///
/// ```
/// use dalembert::special::phi1;
/// assert_eq!(phi1(&0.0), 1.0);
/// assert!((phi1(&1.0_f64) - 1.718281828459045).abs() < 1e-15);
/// ```
pub fn phi1<S: Analytic>(z: &S) -> S {
    if z.vanishes() == Ok(true) { z.one() } else { z.exp_m1() / z }
}

/// Bits of the factorial that are counted at once.
const STEP_BITS: f64 = 11.0;
const STEP: f64 = 2048.0;

/// Computes `φ₂(z) = (eᶻ − 1 − z)/z²`, 1/2 at `z = 0`.
///
/// **Source**: (3.38), (3.44) without the division by `4r²`.
///
/// **Accuracy**: within 16 roundings for `z ≤ 1`: for `|z| ≤ 1` the magnitudes of the terms sum to `φ₂(|z|) ≤ 2φ₂(z)`;
/// for `z < −1` the difference is more than a third of `|z|`.
///
/// ```
/// use dalembert::special::phi2;
/// assert_eq!(phi2(&0.0), 0.5);
/// assert!((phi2(&-1.0_f64) - 0.36787944117144233).abs() < 1e-15);
/// ```
pub fn phi2<S: Analytic>(z: &S) -> S {
    let one = z.one();
    // Both formulas are accurate near the boundary.
    if z.to_f64().abs() > 1.0 {
        return (z.exp_m1() - z) / z.square();
    }
    // Horner's rule for Σ zᵏ/(k+2)!. With |z| ≤ 1 the rest after K terms is below 2/(K+2)!.
    let (mut terms, mut factorial, mut left) = (1i64, 1.0f64, bits(z) + 2.0);
    while left > 0.0 {
        terms += 1;
        factorial *= (terms + 1) as f64;
        if factorial >= STEP {
            (factorial, left) = (factorial / STEP, left - STEP_BITS);
        }
    }
    // The factor that replaces all further terms is between 0 and 2.
    let mut sum = one.clone().widened(&one);
    for k in (1..=terms).rev() {
        sum = one.clone() + z.clone() / one.int(k + 2) * &sum;
    }
    sum / one.int(2)
}

/// Computes `λ(y) = ln(1+y)/y`, 1 at `y = 0`; the time of the highest point is `t* − t_b = (h¹/g) λ(2rh¹/g)`.
///
/// **Source**: Remark 2.
///
/// **Accuracy**: within 3 roundings.
///
/// **Errors**: not a number for `y ≤ −1`.
pub fn log_mean<S: Analytic>(y: &S) -> S {
    if y.vanishes() == Ok(true) { y.one() } else { y.ln_1p() / y }
}

/// Computes `λ₂(y) = (y − ln(1+y))/y²`, 1/2 at `y = 0`, for `y ≥ 0`; the highest point is
/// `h_max − h⁰ = ((h¹)²/g) λ₂(2rh¹/g)`.
///
/// **Source**: Remark 2.
///
/// **Accuracy**: within 32 roundings: at `y = 1/4` the difference is a tenth of `y`.
pub fn log_rest<S: Analytic>(y: &S) -> S {
    if y.to_f64() > 0.25 {
        return (y.clone() - y.ln_1p()) / y.square();
    }
    // The series Σ (−y)ᵏ/(k+2) alternates and decreases faster than 4⁻ᵏ, so the rest is below the first omitted term,
    // which is below 1.
    let terms = (bits(y) / 2.0) as i64 + 2;
    let mut sum = y.zero().widened(&y.one());
    for k in (0..=terms).rev() {
        sum = y.ratio(1, k + 2) - y.clone() * &sum;
    }
    sum
}

#[cfg(test)]
#[path = "tests/phi.rs"]
mod tests;
