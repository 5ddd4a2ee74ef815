//! Numbers as they are printed.

use super::Scalar;

/// Digits that spell every double.
pub const DOUBLE_DIGITS: u32 = 17;

/// A number that carries its bound, as it is printed: at most so many significant digits, and none beyond the bound;
/// `0` where no digit is known.
///
/// **Accuracy**: *correctly rounded* unless the bound is astride a rounding boundary, and then within one unit of the
/// last digit: a last unit is at least twice the bound.
pub fn show<S: Scalar>(x: &S, digits: u32) -> String {
    let size = x.to_f64().abs();
    // −1 for the half unit that rounding takes.
    let known =
        ((size - 2.0 * x.log2_error().exp2()).max(0.0).log2() - x.log2_error() - 1.0) * std::f64::consts::LOG10_2;
    if known.is_nan() || known < 1.0 { "0".into() } else { x.decimal(digits.min(known as u32)) }
}

/// The bound of a number's error to two digits, rounded up: `3.1e-14`; `0` where it is exact.
pub fn bound_text<S: Scalar>(x: &S) -> String {
    let log10 = x.log2_error() * std::f64::consts::LOG10_2;
    if log10 == f64::NEG_INFINITY {
        return "0".into();
    }
    if !log10.is_finite() {
        return "unknown".into();
    }
    let exponent = log10.floor();
    let tenths = (10f64.powf(log10 - exponent) * 10.0 * (1.0 + 1e-12)).ceil();
    match tenths >= 100.0 {
        true => format!("1e{}", exponent + 1.0),
        false => format!("{}e{exponent}", tenths / 10.0),
    }
}

#[cfg(all(test, feature = "mp"))]
mod tests {
    use super::*;
    use crate::number::Interval;
    use rug::Float;

    #[test]
    fn no_digit_beyond_the_bound_is_printed() {
        let around = |x: f64, by: f64| Interval::between(Float::with_val(99, x - by), Float::with_val(99, x + by));
        assert_eq!(show(&around(2.0, 9e-6), 20), "2.0000");
        assert_eq!(show(&around(2.0, 3.0), 20), "0");
        assert_eq!(show(&around(0.0, 1e-20), 20), "0");
        assert_eq!(bound_text(&crate::number::Estimate::new(1.0f64, 3.0)), "3.4e-16");
        assert_eq!(bound_text(&crate::number::Estimate::exact(1.0f64)), "0");
    }
}
