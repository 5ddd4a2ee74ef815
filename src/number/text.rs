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
#[cfg(any(feature = "cli", all(test, feature = "mp")))]
pub(crate) fn double_bound<S: Scalar>(x: &S) -> f64 {
    with_rounding(x, x.to_f64().abs().log2() - f64::from(f64::MANTISSA_DIGITS))
}

/// `log₂` of the bound of the error of [`show`]'s text, with the rounding to its digits.
#[cfg(any(feature = "cli", all(test, feature = "mp")))]
pub(crate) fn shown_bound<S: Scalar>(x: &S, digits: u32) -> f64 {
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
#[cfg(any(feature = "cli", all(test, feature = "mp")))]
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

/// A number that carries its bound as a JSON value: a number for a double (null if not finite),
/// `{"value": …, "lo": …, "hi": …}` with `lo ≤ truth ≤ hi` for an enclosure, a string otherwise.
#[cfg(feature = "cli")]
pub(crate) fn number_json<S: Scalar>(x: &S, digits: u32) -> serde_json::Value {
    let text = show(x, if digits == 0 { DOUBLE_DIGITS } else { digits });
    match (x.as_double(), x.ends(digits)) {
        (Some(value), _) if !value.is_finite() => serde_json::Value::Null,
        (Some(_), _) if text == "0" => 0.0.into(),
        (Some(value), _) => value.into(),
        (None, Some([lo, hi])) => serde_json::json!({"value": text, "lo": lo, "hi": hi}),
        (None, None) => text.into(),
    }
}

/// The bound of the error of a number as it is printed, as a JSON value: a number where a double holds it, a string
/// otherwise; `null` for an enclosure, which has it in itself.
#[cfg(feature = "cli")]
pub(crate) fn bound_json<S: Scalar>(x: &S, digits: u32) -> serde_json::Value {
    if x.ends(1).is_some() {
        return serde_json::Value::Null;
    }
    let log2 = match x.as_double() {
        Some(_) if show(x, DOUBLE_DIGITS) != "0" => double_bound(x),
        _ => shown_bound(x, if digits == 0 { DOUBLE_DIGITS } else { digits }),
    };
    let text = bound_of_log2(log2);
    match text.parse::<f64>() {
        Ok(bound) if bound > 0.0 || text == "0" => bound.into(),
        _ => text.into(),
    }
}

#[cfg(all(test, feature = "mp"))]
#[path = "tests/text.rs"]
mod tests;
