//! Numbers as they are printed, as text and as JSON.

use super::Scalar;

/// Digits that spell every double.
pub const DOUBLE_DIGITS: u32 = 17;

/// Bits that hold `digits` decimal digits: `⌈digits · log₂10⌉`.
///
/// **Accuracy**: exact for every `digits` below 10⁹.
///
/// ```
/// assert_eq!(dalembert::number::bits_for_digits(15), 50);
/// ```
pub fn bits_for_digits(digits: u32) -> u32 {
    let bits = (u64::from(digits) * 3_321_928_095).div_ceil(1_000_000_000);
    u32::try_from(bits).unwrap_or(u32::MAX)
}

/// Digits that tell numbers of so many bits apart.
pub(super) const fn digits_for_bits(bits: u32) -> u32 {
    (bits as u64 * 301_029_996 / 1_000_000_000) as u32 + 2
}

/// A number that carries its bound, as it is printed: at most so many significant digits, and none beyond the bound;
/// `0` where no digit is known.
///
/// **Accuracy**: *correctly rounded* of an enclosure, both of whose ends round to what is printed. Of other numbers
/// correctly rounded unless the bound is astride a rounding boundary, and then within one unit of the last digit: a
/// last unit is at least twice the bound.
pub fn show<S: Scalar>(x: &S, digits: u32) -> String {
    shown_digits(x, digits).map_or_else(|| "0".into(), |digits| x.decimal(digits))
}

/// How many digits are printed: at most so many, none beyond the bound, and of an enclosure those that both ends prove;
/// `None` where no digit is known.
fn shown_digits<S: Scalar>(x: &S, digits: u32) -> Option<u32> {
    let size = x.to_f64().abs();
    // −1 for the half unit that rounding takes.
    let known =
        ((size - 2.0 * x.log2_error().exp2()).max(0.0).log2() - x.log2_error() - 1.0) * std::f64::consts::LOG10_2;
    (known >= 1.0).then(|| x.proved(digits.min(known as u32))).filter(|digits| *digits > 0)
}

/// `log₂` of the bound of the error of the shortest text that reads as the same double, which may be half a unit of the
/// last bit off that double.
pub fn double_bound<S: Scalar>(x: &S) -> f64 {
    with_rounding(x, x.to_f64().abs().log2() - f64::from(f64::MANTISSA_DIGITS))
}

/// `log₂` of the bound of the error of [`show`]'s text, with the rounding to its digits.
pub fn shown_bound<S: Scalar>(x: &S, digits: u32) -> f64 {
    let size = x.to_f64().abs();
    let rounding = shown_digits(x, digits).map_or(size.log2(), |digits| {
        // A power of ten whose logarithm is rounded down keeps its decade.
        let last = (size.log10() + 1e-9).floor() + 1.0 - f64::from(digits);
        last / std::f64::consts::LOG10_2 - 1.0
    });
    let rounded = || show(x, digits).parse::<f64>().is_ok_and(|read| read != x.to_f64());
    if x.log2_error() == f64::NEG_INFINITY && rounded() { rounding } else { with_rounding(x, rounding) }
}

/// The bound of `x` and of a rounding of the size `2^rounding` together.
fn with_rounding<S: Scalar>(x: &S, rounding: f64) -> f64 {
    let own = x.log2_error();
    if own.is_infinite() {
        return own;
    }
    let (least, most) = (own.min(rounding), own.max(rounding));
    most + (least - most).exp2().ln_1p() / std::f64::consts::LN_2
}

/// A bound, given by its `log₂`, to two digits, rounded up: `3.1e-14`; `0` where the number is exact.
pub fn bound_of_log2(log2: f64) -> String {
    let log10 = log2 * std::f64::consts::LOG10_2;
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
#[path = "tests/text.rs"]
mod tests;
