//! Numbers as they are printed.

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

/// The bound of the error of the shortest text that reads as the same double, which may be half a unit of the last bit
/// off that double; `0` where the double is exact.
pub fn double_bound_text<S: Scalar>(x: &S) -> String {
    bound_of_log2(double_bound(x))
}

/// `log₂` of what [`double_bound_text`] says.
pub(crate) fn double_bound<S: Scalar>(x: &S) -> f64 {
    with_rounding(x, x.to_f64().abs().log2() - f64::from(f64::MANTISSA_DIGITS))
}

/// The bound of the error of [`show`]'s text, with the rounding to its digits; `0` where the text is exact.
pub fn shown_bound_text<S: Scalar>(x: &S, digits: u32) -> String {
    bound_of_log2(shown_bound(x, digits))
}

/// `log₂` of what [`shown_bound_text`] says.
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
mod tests {
    use super::*;
    use crate::number::Interval;
    use rug::Float;

    #[test]
    fn no_digit_beyond_the_bound_is_printed() {
        let around = |x: f64, by: f64| Interval::between(Float::with_val(99, x - by), Float::with_val(99, x + by));
        assert_eq!(show(&around(2.0, 9e-6), 20), "2.0000");
        assert_eq!(show(&around(2.0, 3.0), 20), "0");
        // 1.05 lies between: of two digits one end says 1.0 and the other 1.1.
        let ends = [104_999_999, 105_000_001].map(|end| Float::with_val(99, end) / 100_000_000u32);
        let [low, high] = ends;
        let astride = Interval::between(low, high);
        assert_eq!([1, 2, 3, 6].map(|digits| show(&astride, digits)), ["1", "1", "1.05", "1.05000"]);
        assert_eq!(show(&around(0.25, 1e-6), 1), "0.25");
        assert_eq!(show(&around(0.0, 1e-20), 20), "0");
        assert_eq!(bound_of_log2(crate::number::Estimate::new(1.0f64, 3.0).log2_error()), "3.4e-16");
        // 1 + ε with a bound of one rounding: ε/2 and, for the text, another.
        assert_eq!(double_bound_text(&crate::number::Estimate::new(1.0f64 + f64::EPSILON, 1.0)), "2.3e-16");
        assert_eq!(double_bound_text(&crate::number::Estimate::exact(1.0f64)), "0");
        // Four decimals are half of 1e-4 off, and the number itself 9e-6.
        assert_eq!(shown_bound_text(&around(2.0, 9e-6), 20), "5.9e-5");
        assert_eq!(shown_bound_text(&crate::number::Estimate::exact(0.2f64 + 0.1), 12), "5.1e-13");
        assert_eq!(shown_bound_text(&crate::number::Estimate::exact(0.25f64), 12), "0");
        // Zeros at the end are digits, whether they are printed or not.
        assert_eq!(shown_bound_text(&crate::number::Estimate::new(6.0f64, 1.0), 12), "5.1e-12");
        assert_eq!(shown_bound_text(&crate::number::Estimate::new(1000.0f64, 1.0), 4), "5.1e-1");
        // 0 printed: the end farthest from it, 1e-20, and the radius.
        assert_eq!(shown_bound_text(&around(0.0, 1e-20), 20), "2.1e-20");
    }

    /// Both ends of any enclosure round to what is printed of it, and what is printed of its ends is outside of it.
    #[test]
    fn both_ends_print_what_is_proved() {
        let mut state = 1878u64;
        let mut next = move |below: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 20) % below
        };
        let read = |text: &str| text.parse::<crate::number::Number>().unwrap().to_rational();
        let (mut compared, mut short) = (0, 0);
        for _ in 0..4000 {
            // Next to the place where the rounding to so many digits changes, and anywhere.
            let digits = 1 + next(20) as u32;
            let mantissa = Float::with_val(200, next(10u64.pow(digits.min(12))) as f64 + 0.5 * next(3) as f64);
            let power = |n: u64| Float::with_val(200, Float::i_pow_u(10, n as u32));
            let scale = power(next(30)) / power(25);
            let middle = mantissa * &scale;
            let by = |n: u64| scale.clone() / power(n);
            let (lo, hi) = (middle.clone() - by(next(24)), middle.clone() + by(next(24)));
            let x = Interval::between(lo.clone(), hi.clone());
            let [low, high] = x.ends(digits).unwrap().map(|end| read(&end));
            assert!(low <= lo && high >= hi, "{lo} {hi}: {low} {high}");
            let text = show(&x, digits);
            // Zeros before the point do not say whether they are known.
            if text.ends_with('0') && !text.contains('.') {
                continue;
            }
            let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
            let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
            let figures = mantissa.trim_start_matches(['-', '0', '.']).bytes().filter(u8::is_ascii_digit).count();
            short += usize::from((figures as u32) < digits);
            let half = read(&format!("5e{}", exponent.parse::<i64>().unwrap() - decimals as i64 - 1));
            for end in [&lo, &hi] {
                let off = end.to_rational().unwrap() - read(&text);
                assert!(off.abs() <= half, "{lo} {hi} in {digits} digits: {text}");
            }
            compared += 1;
        }
        assert!(compared > 2500 && short > 500, "{compared} {short}");
    }
}
