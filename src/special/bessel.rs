//! Modified Bessel functions of the first kind, scaled by `e^{−z}`, in any precision.

use std::any::Any;

use super::{bits, enclosed, roundoff};
use crate::number::Analytic;

/// The double that a generic number is, where it is one: doubles have faster ways.
fn as_double<S: Analytic>(z: &S) -> Option<f64> {
    (z as &dyn Any).downcast_ref::<f64>().copied()
}

/// `e^{−z} I₀(z)` for `z ≥ 0`.
///
/// **Source**: (2.16), the function of the *first* kind; the paper's text says second.
///
/// **Accuracy**: for `f64` within 8 roundings, and within an ulp beyond z = 2; within 1.1 roundings for long numbers.
///
/// ```
/// assert_eq!(dalembert::special::i0_scaled(&0.0), 1.0);
/// ```
pub fn i0_scaled<S: Analytic>(z: &S) -> S {
    match as_double(z) {
        Some(small) if small <= 2.0 => z.double(short(small, &SQUARES)),
        Some(large) => z.double(pxfm::f_i0e(large)),
        None => generic(z, 0),
    }
}

/// `e^{−z} I₁(z)` for `z ≥ 0`.
///
/// **Source**: after (2.22).
///
/// **Accuracy**: for `f64` within 8 roundings, and within an ulp beyond z = 2; within 1.1 roundings for long numbers.
///
/// ```
/// assert_eq!(dalembert::special::i1_scaled(&0.0), 0.0);
/// ```
pub fn i1_scaled<S: Analytic>(z: &S) -> S {
    match as_double(z) {
        Some(small) if small <= 2.0 => z.double(0.5 * small * short(small, &PRODUCTS)),
        Some(large) => z.double(pxfm::f_i1e(large)),
        None => generic(z, 1),
    }
}

/// `e^{−z} I_n(z)` for `z ≥ 0`.
///
/// **Source**: `I_n = I_0 Π r_k`, `r_k = I_k/I_{k−1} = z/(2k + z r_{k+1})` downwards, all terms positive.
///
/// **Accuracy**: within `≈ 8n + 2z ln n` roundings; for long numbers and `z ≤ bits + 64` within 1.1.
pub fn in_scaled<S: Analytic>(z: &S, n: u32) -> S {
    if z.to_f64() <= bits(z) + 64.0
        && let Some(value) = many(z, n)
    {
        return value;
    }
    let ray = super::Ray::at_source(z);
    let ratios = ray.ratios(i64::from(n));
    ratios.into_iter().fold(i0_scaled(z), |value, ratio| value * &ratio)
}

/// `1/m²`, m = 1 … 13.
const SQUARES: [f64; 13] = reciprocals(0);
/// `1/(m(m+1))`, m = 1 … 13.
const PRODUCTS: [f64; 13] = reciprocals(1);

const fn reciprocals(n: usize) -> [f64; 13] {
    let mut list = [0.0; 13];
    let mut m = 1;
    while m <= 13 {
        list[m - 1] = 1.0 / (m * (m + n)) as f64;
        m += 1;
    }
    list
}

/// `e^{−z} Σ_m yᵐ Π 1/(k(k+n))`, y = z²/4, in doubles, z ≤ 2, ten times as fast as a correctly rounded function.
///
/// With y ≤ 1 the rest after m = 13 is below `2/(14!)² < 2⁻⁷⁰`. In Horner's form the last step has one rounding and weighs 1,
/// those before add three each times the terms that they stand in, `(I₀ − 1)/I₀ < 0.6`, and the exponential has two.
fn short(z: f64, steps: &[f64; 13]) -> f64 {
    let y = 0.25 * z * z;
    steps.iter().rev().fold(1.0, |tail, step| 1.0 + y * step * tail) * (-z).exp()
}

/// The faster way of long numbers.
#[cfg(feature = "mp")]
fn many<S: Analytic>(z: &S, n: u32) -> Option<S> {
    let z = (z as &dyn Any).downcast_ref::<rug::Float>()?;
    super::many::same(super::in_scaled_bounded(z, n).0)
}

#[cfg(not(feature = "mp"))]
fn many<S: Analytic>(_: &S, _: u32) -> Option<S> {
    None
}

fn generic<S: Analytic>(z: &S, n: u32) -> S {
    many(z, n).unwrap_or_else(|| plain(z, i64::from(n)))
}

/// The expansion at infinity where it reaches the precision, the series at zero elsewhere.
fn plain<S: Analytic>(z: &S, n: i64) -> S {
    if S::RIGOROUS {
        return enclosed::bessel_scaled(z, n);
    }
    if z.to_f64() > bits(z) + 64.0 { expansion(z, n) } else { series(z, n) }
}

/// `(2πz)^{−1/2} Σ_k (−1)ᵏ a_k(n)/zᵏ`, for n = 0, 1 and z > bits + 64; from k = 2 on all terms have one sign.
///
/// The rest after ℓ terms is at most `4 χ(ℓ) |a_ℓ| z^{−ℓ} + e^{−2z}` with `χ(ℓ) = √π Γ(ℓ/2+1)/Γ(ℓ/2+1/2) < 2√ℓ + 2`
/// (DLMF 10.40(ii), (iii), with `|n² − ¼| π/2z < 0.02`). Terms fall until k ≈ 2z, where they are e^{−2z}, beyond the
/// precision.
pub(super) fn expansion<S: Analytic>(z: &S, n: i64) -> S {
    let mut term = z.one();
    let mut sum = z.one();
    let enough = roundoff(z);
    let last = (2.0 * bits(z)) as i64 + 128;
    for k in 1..=last {
        term = -(term * &z.int(4 * n * n - (2 * k - 1) * (2 * k - 1))) / (z.int(8 * k) * z);
        sum = sum + &term;
        if term.magnitude() * &z.int(16 * (k + 1)) < enough {
            break;
        }
    }
    sum / (z.pi() * z * &z.int(2)).sqrt()
}

/// `e^{−z} Σ_m (z/2)^{2m+n}/(m!(m+n)!)`: all terms positive.
///
/// The ratio of terms, `z²/(4m(m+n))`, falls with m. Once it is below 1/2 the rest is smaller than the last term taken,
/// and the sum stops when that is a roundoff of it.
fn series<S: Analytic>(z: &S, n: i64) -> S {
    let half = z.clone() / z.int(2);
    let square = half.square();
    let mut term = (1..=n).fold(z.one(), |term, k| term * &half / z.int(k));
    let mut sum = term.clone();
    let enough = roundoff(z) / z.int(4);
    for m in 1i64.. {
        term = term * &square / z.int(m * (m + n));
        if term.is_zero() || !term.is_finite() {
            break;
        }
        sum = sum + &term;
        if square.clone() * &z.int(2) < z.int(m * (m + n)) && term <= sum.clone() * &enough {
            break;
        }
    }
    sum * &(-z.clone()).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (2.16) by the trapezoidal rule, which converges geometrically for a periodic integrand.
    fn by_integral(z: f64, n: i32) -> f64 {
        let points = 400 + 4 * z.sqrt() as i32;
        let sum: f64 = (0..points)
            .map(|k| {
                let angle = 2.0 * std::f64::consts::PI * f64::from(k) / f64::from(points);
                (-2.0 * z * (angle / 2.0).sin().powi(2)).exp() * (f64::from(n) * angle).cos()
            })
            .sum();
        sum / f64::from(points)
    }

    #[test]
    fn against_the_integral() {
        for z in [0.0, 1e-8, 0.3, 1.0, 1.8, 7.0, 50.0, 700.0, 1e4] {
            assert!((i0_scaled(&z) - by_integral(z, 0)).abs() < 1e-15 + 1e-13 * by_integral(z, 0), "{z}");
            for n in [1, 2, 3, 8, 20] {
                let wrong = (in_scaled(&z, n) - by_integral(z, n as i32)).abs();
                assert!(wrong < 4e-16 + 1e-13 * by_integral(z, n as i32), "{z} {n} {wrong}");
            }
        }
    }

    #[cfg(feature = "mp")]
    #[test]
    fn both_expansions_agree() {
        for digits in [64u32, 300, 2000] {
            for n in [0, 1] {
                let z = rug::Float::with_val(digits, digits + 70);
                let (near, far) = (series(&z, n), expansion(&z, n));
                let wrong: rug::Float = (near - &far) / far;
                assert!(wrong.is_zero() || wrong.get_exp().unwrap() < 14 - digits as i32, "{digits} {n} {wrong}");
            }
        }
    }

    /// The series and the expansion term by term, with twice the precision, against the fast way and its bound.
    #[cfg(feature = "mp")]
    #[test]
    fn the_fast_way_keeps_its_bound() {
        use crate::special::{in_bounded, in_scaled_bounded, psi_bounded};
        use rug::Float;
        for p in [64u32, 65, 200, 1000, 4096] {
            for z in [1e-300, 1e-20, 0.1, 0.7, 1.0, 1.99, 3.0, 10.0, 33.3, 120.0, 400.0, 1000.0, 1e5] {
                for z in [Float::with_val(p, z), Float::with_val(p, z) * Float::with_val(p, 2).sqrt()] {
                    for n in [0, 1, 2, 7, 40] {
                        if n > 1 && z > 2000 || p > 3000 && z > 200 && n > 1 {
                            continue;
                        }
                        let long = Float::with_val(2 * p + 64, &z);
                        let exact = if n > 1 { series(&long, n) } else { plain(&long, n) };
                        let off = |value: &Float, exact: &Float| {
                            let wrong = Float::with_val(64, value - exact) / exact;
                            (wrong.abs() << p).to_f64()
                        };
                        let (value, bound) = in_scaled_bounded(&z, n as u32);
                        let wrong = off(&value, &exact);
                        assert!(wrong <= bound && bound < 1.1, "{p} {z} {n} {wrong} {bound}");
                        let (value, bound) = in_bounded(&z, n as u32);
                        let plain = exact * &long.clone().exp();
                        assert!(off(&value, &plain) <= bound && bound < 1.1, "{p} {z} {n} {bound}");
                        if z < 2000 {
                            // r = 2, ξ = z/2 = η: ψ_n = I_n.
                            let half = Float::with_val(p, &z >> 1u32);
                            let (value, bound) = psi_bounded(&Float::with_val(p, 2), &half, &half, n as u32);
                            assert!(off(&value, &plain) <= bound && bound < 1.1, "{p} {z} {n} {bound}");
                        }
                    }
                }
            }
        }
    }

    #[cfg(feature = "mp")]
    #[test]
    fn doubles_and_many_digits_agree() {
        for z in [1e-300, 1e-5, 0.7, 1.3, 1.999, 2.0, 3.0, 20.0, 223.9, 224.1, 800.0, 1e4, 1e12] {
            let many = rug::Float::with_val(160, z);
            let accuracy = if z <= 2.0 { 9e-16 } else { 3e-16 };
            assert!((i0_scaled(&many).to_f64() / i0_scaled(&z) - 1.0).abs() < accuracy);
            assert!((i1_scaled(&many).to_f64() / i1_scaled(&z) - 1.0).abs() < accuracy);
            for n in if z < 1e5 { vec![2, 5, 30] } else { vec![] } {
                let (double, exact) = (in_scaled(&z, n), in_scaled(&many, n).to_f64());
                assert!((double - exact).abs() <= 1e-13 * exact, "{z} {n} {double} {exact}");
            }
        }
    }
}
