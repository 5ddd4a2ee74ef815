//! Printed forms of numbers, as text and as JSON.

use super::{Number, Scalar};

/// Number of digits that determine every double.
pub const DOUBLE_DIGITS: u32 = 17;

/// Returns the number of bits that hold `digits` decimal digits: `⌈digits · log₂10⌉`.
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

/// Returns the number of digits that distinguish all numbers of this many bits.
pub(super) const fn digits_for_bits(bits: u32) -> u32 {
    (bits as u64 * 301_029_996 / 1_000_000_000) as u32 + 2
}

/// Returns the printed form of a number with a bound: at most this many significant digits, and none beyond the bound;
/// `0` if no digit is known.
///
/// **Accuracy**: *correctly rounded* for an enclosure, both of whose ends round to the printed number. Other numbers
/// are correctly rounded unless the bound crosses a rounding boundary, and then within one unit of the last digit: a
/// last unit is at least twice the bound.
pub fn show<S: Scalar>(x: &S, digits: u32) -> String {
    shown_digits(x, digits).map_or_else(|| "0".into(), |digits| x.decimal(digits))
}

/// Returns [`show`] beside numbers up to `greatest`: where no digit is known, `below 3.1e-6`, the bound of the
/// magnitude of the number. A bound of less than the last digit of `greatest` is not told: the number is `0` beside it.
pub fn show_beside<S: Scalar>(x: &S, digits: u32, greatest: f64) -> String {
    let bound = shown_bound(x, digits);
    let is_zero = bound <= greatest.log2() - f64::from(digits) / std::f64::consts::LOG10_2;
    match is_zero || x.log2_error() == f64::NEG_INFINITY || shown_digits(x, digits).is_some() {
        true => show(x, digits),
        false => format!("below {}", bound_of_log2(bound)),
    }
}

/// Returns the number of printed digits: at most `digits`, none beyond the bound, and for an enclosure only digits that
/// both ends prove; `None` if no digit is known.
fn shown_digits<S: Scalar>(x: &S, digits: u32) -> Option<u32> {
    let size = x.to_f64().abs();
    // The −1 accounts for the half unit of the rounding.
    let known =
        ((size - 2.0 * x.log2_error().exp2()).max(0.0).log2() - x.log2_error() - 1.0) * std::f64::consts::LOG10_2;
    (known >= 1.0).then(|| x.proved(digits.min(known as u32))).filter(|digits| *digits > 0)
}

/// Returns `log₂` of the error bound of the shortest text that reads as the same double; the text may differ from the
/// double by half a unit of the last bit.
pub fn double_bound<S: Scalar>(x: &S) -> f64 {
    with_rounding(x, x.to_f64().abs().log2() - f64::from(f64::MANTISSA_DIGITS))
}

/// Returns whether two texts spell one number; without long numbers, one double.
fn is_same(a: &str, b: &str) -> bool {
    if !cfg!(feature = "long") {
        return a.parse::<f64>() == b.parse::<f64>();
    }
    let numbers = a.parse::<Number>().ok().zip(b.parse::<Number>().ok());
    numbers.is_some_and(|(a, b)| a.compare(&b).is_eq())
}

/// Digits beyond those of a text that tell whether it is rounded.
const MORE_DIGITS: u32 = 60;

/// Returns `log₂` of the error bound of the text of [`show`], its rounding to digits included.
pub fn shown_bound<S: Scalar>(x: &S, digits: u32) -> f64 {
    let size = x.to_f64().abs();
    let rounding = shown_digits(x, digits).map_or(size.log2(), |digits| {
        // The margin keeps a power of ten in its decade if its logarithm is rounded down.
        let last = (size.log10() + 1e-9).floor() + 1.0 - f64::from(digits);
        last / std::f64::consts::LOG10_2 - 1.0
    });
    let rounded = || !is_same(&show(x, digits), &show(x, digits.saturating_add(MORE_DIGITS)));
    if x.log2_error() == f64::NEG_INFINITY && rounded() { rounding } else { with_rounding(x, rounding) }
}

/// Returns `log₂` of the sum of the bound of `x` and a rounding of the size `2^rounding`.
fn with_rounding<S: Scalar>(x: &S, rounding: f64) -> f64 {
    let own = x.log2_error();
    if own.is_infinite() {
        return own;
    }
    let (least, most) = (own.min(rounding), own.max(rounding));
    most + (least - most).exp2().ln_1p() / std::f64::consts::LN_2
}

/// Formats a bound, given by its `log₂`, to two digits, rounded up: `3.1e-14`; `0` if the number is exact.
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
