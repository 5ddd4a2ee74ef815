use super::*;
use crate::number::{Estimate, Interval};
use rug::Float;

#[test]
fn no_digit_beyond_the_bound_is_printed() {
    let around = |x: f64, by: f64| Interval::between(Float::with_val(99, x - by), Float::with_val(99, x + by));
    assert_eq!(show(&around(2.0, 9e-6), 20), "2.0000");
    assert_eq!(show(&around(2.0, 3.0), 20), "0");
    // The ends surround 1.05: in two digits one end rounds to 1.0 and the other to 1.1.
    let ends = [104_999_999, 105_000_001].map(|end| Float::with_val(99, end) / 100_000_000u32);
    let [low, high] = ends;
    let astride = Interval::between(low, high);
    assert_eq!([1, 2, 3, 6].map(|digits| show(&astride, digits)), ["1", "1", "1.05", "1.05000"]);
    assert_eq!(show(&around(0.25, 1e-6), 1), "0.25");
    assert_eq!(show(&around(0.0, 1e-20), 20), "0");
    assert_eq!(bound_of_log2(Estimate::new(1.0f64, 3.0).log2_error()), "3.4e-16");
    // 1 + ε with a bound of one rounding: ε/2 and, for the text, another.
    assert_eq!(bound_of_log2(double_bound(&Estimate::new(1.0f64 + f64::EPSILON, 1.0))), "2.3e-16");
    assert_eq!(bound_of_log2(double_bound(&Estimate::exact(1.0f64))), "0");
    // Four decimals are half of 1e-4 off, and the number itself 9e-6.
    assert_eq!(bound_of_log2(shown_bound(&around(2.0, 9e-6), 20)), "5.9e-5");
    assert_eq!(bound_of_log2(shown_bound(&Estimate::exact(0.2f64 + 0.1), 12)), "5.1e-13");
    assert_eq!(bound_of_log2(shown_bound(&Estimate::exact(0.25f64), 12)), "0");
    // Zeros at the end are digits, whether they are printed or not.
    assert_eq!(bound_of_log2(shown_bound(&Estimate::new(6.0f64, 1.0), 12)), "5.1e-12");
    assert_eq!(bound_of_log2(shown_bound(&Estimate::new(1000.0f64, 1.0), 4)), "5.1e-1");
    // 0 printed: the end farthest from it, 1e-20, and the radius.
    assert_eq!(bound_of_log2(shown_bound(&around(0.0, 1e-20), 20)), "2.1e-20");
}

/// Checks that both ends of an enclosure round to its printed form, and that its printed ends lie outside it.
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
        // Enclosures near a rounding boundary of `digits` digits, and elsewhere.
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
        // Zeros before the point may be known digits or not.
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

#[test]
fn a_zero_beside_greater_numbers_is_zero_or_below_its_bound() {
    // Within 1e10 roundings of 1: 1.1e-6.
    let open = Estimate::new(1e-7, 1e10);
    assert_eq!(show(&open, 12), "0");
    assert_eq!(show_beside(&open, 12, 1.0), "below 1.3e-6");
    assert_eq!(show_beside(&open, 12, 2e6), "0");
    assert_eq!(show_beside(&open, 12, 0.0), "below 1.3e-6");
    assert_eq!(show_beside(&Estimate::new(0.0, 0.0), 12, 0.0), "0");
    assert_eq!(show_beside(&Estimate::new(0.25, 1e10), 12, 0.0), show(&Estimate::new(0.25, 1e10), 12));
}
