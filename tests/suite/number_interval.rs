//! Enclosures enclose: every operation, on random fractions in few bits, against the exact result; and comparisons
//! never guess.

use std::cmp::Ordering;

use dalembert::Interval;
use dalembert::number::{Analytic, IntervalPrecision, Open, Scalar};
use proptest::prelude::*;
use rug::ops::Pow;
use rug::{Float, Rational};

fn fraction() -> impl Strategy<Value = Rational> {
    (-40i64..=40, 1i64..=12).prop_map(|(p, q)| Rational::from((p, q)))
}

/// An interval of width up to 1 around `x`, which it holds anywhere inside.
fn around(x: &Rational, before: &Rational, after: &Rational, bits: u32) -> Interval {
    let precision = IntervalPrecision::bits(bits);
    let lo = Interval::rational(&(x.clone() - before.clone().abs()), precision);
    let hi = Interval::rational(&(x.clone() + after.clone().abs()), precision);
    Interval::between(lo.lo().clone(), hi.hi().clone())
}

fn slack() -> impl Strategy<Value = (Rational, Rational)> {
    (0i64..=6, 0i64..=6).prop_map(|(a, b)| (Rational::from((a, 12)), Rational::from((b, 12))))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    /// Each number inside is within a unit of the last digit that is printed.
    #[test]
    fn printed_digits_are_proved(x in fraction(), places in 0u32..40, bits in 8u32..160, asked in 1usize..30) {
        let slack = Rational::from((1, rug::Integer::from(10).pow(places)));
        let inside = around(&x, &slack, &slack, bits);
        for text in [inside.to_string(), format!("{inside:.asked$}")] {
            if text.starts_with('[') {
                prop_assert!(places < 4 || bits < 16 || x.cmp0().is_eq(), "{}", text);
                continue;
            }
            let printed = Float::with_val(400, Float::parse(&text).unwrap());
            let mantissa = text.split('e').next().unwrap();
            // Zeros before the point may only hold the place of digits.
            let digits = if mantissa.contains('.') { mantissa } else { mantissa.trim_end_matches('0') };
            let count = digits.replace(['-', '.'], "").trim_start_matches('0').len().max(1) as i32;
            let leading = (printed.to_f64().abs().log10() + 1e-12).floor() as i32;
            let unit = Float::with_val(400, 10).pow(leading + 1 - count);
            for end in [inside.lo(), inside.hi()] {
                prop_assert!(Float::with_val(400, &printed - end).abs() <= unit, "{} for {:?}", text, inside);
            }
        }
    }

    #[test]
    fn arithmetic_encloses(x in fraction(), y in fraction(), (a, b) in slack(), (c, d) in slack(), bits in 3u32..20) {
        let (ix, iy) = (around(&x, &a, &b, bits), around(&y, &c, &d, bits));
        prop_assert!((ix.clone() + &iy).contains(&Rational::from(&x + &y)));
        prop_assert!((ix.clone() - &iy).contains(&Rational::from(&x - &y)));
        prop_assert!((ix.clone() * &iy).contains(&Rational::from(&x * &y)));
        prop_assert!(ix.square().contains(&Rational::from(&x * &x)));
        prop_assert!(ix.magnitude().contains(&x.clone().abs()));
        prop_assert!((-ix.clone()).contains(&Rational::from(-&x)));
        prop_assert!(ix.clone().widened(&iy).contains(&Rational::from(&x + &y)));
        prop_assert!(ix.clone().widened(&iy).contains(&Rational::from(&x - &y)));
        if y.cmp0().is_ne() {
            prop_assert!((ix.clone() / &iy).contains(&Rational::from(&x / &y)));
        }
        // What the ends settle has to be answered, and every answer has to be right.
        prop_assert!(ix.compare(&iy).is_ok() || (ix.hi() >= iy.lo() && iy.hi() >= ix.lo()));
        prop_assert!(Scalar::sign(&ix).is_ok() || (*ix.lo() <= 0 && *ix.hi() >= 0));
        if let Ok(answer) = ix.below(&iy) {
            prop_assert_eq!(answer, x < y);
        }
        if let Ok(order) = ix.compare(&iy) {
            prop_assert_eq!(order, x.cmp(&y));
        }
        if let Ok(sign) = Scalar::sign(&ix) {
            prop_assert_eq!(sign, x.cmp0());
        }
        if let Ok(answer) = ix.positive() {
            prop_assert_eq!(answer, x.cmp0().is_gt());
        }
        if let Ok(answer) = ix.negative() {
            prop_assert_eq!(answer, x.cmp0().is_lt());
        }
        if let Some(floor) = ix.floor_int() {
            prop_assert_eq!(Some(floor), x.clone().floor().numer().to_i64());
        }
        prop_assert!(ix.to_f64().abs() >= Float::with_val(53, &x).to_f64().abs() * (1.0 - 1e-15));
    }

    #[test]
    fn functions_enclose(x in fraction(), (a, b) in slack(), bits in 3u32..30) {
        let small = x.clone() / 4u32;
        let wide = around(&small, &a, &b, bits);
        let exact = Float::with_val(300, &small);
        // Forty digits stand for the truth: they lie inside by far more than their own error, or on a point.
        let inside = |found: &Interval, truth: Float| {
            Float::with_val(300, found.lo() - &truth) <= 1e-80 && Float::with_val(300, &truth - found.hi()) <= 1e-80
        };
        prop_assert!(inside(&wide.exp(), exact.clone().exp()));
        prop_assert!(inside(&wide.exp_m1(), exact.clone().exp_m1()));
        prop_assert!(inside(&wide.cos(), exact.clone().cos()));
        prop_assert!(inside(&wide.sin(), exact.clone().sin()));
        prop_assert!(inside(&wide.pi(), Analytic::pi(&exact)));
        if small > 0 {
            prop_assert!(inside(&wide.sqrt(), exact.clone().sqrt()));
            prop_assert!(inside(&wide.ln(), exact.clone().ln()));
            prop_assert!(inside(&wide.ln_1p(), exact.clone().ln_1p()));
        }
    }

    /// With the exact number inside, `a + b√d`, comparisons that no interval decides are decided rightly.
    #[test]
    fn the_exact_number_decides(a in fraction(), b in fraction(), d in 2i64..12, bits in 8u32..40) {
        let lift = |x: &Rational| Interval::rational(x, IntervalPrecision::with_exact(bits));
        let root = lift(&Rational::from(d)).sqrt();
        let number = lift(&a) + &(lift(&b) * &root);
        // (a + b√d)(a − b√d) = a² − b²d
        let product = number.clone() * &(lift(&a) - &(lift(&b) * &root));
        let norm = Rational::from(a.square_ref()) - Rational::from(b.square_ref()) * d;
        prop_assert_eq!(product.compare(&lift(&norm)), Ok(Ordering::Equal));
        let back = number.square().sqrt();
        prop_assert_eq!(back.compare(&number.magnitude()), Ok(Ordering::Equal));
        prop_assert_eq!(number.below(&number), Ok(false));
        let truth = Float::with_val(200, d).sqrt() * &b + &a;
        if truth.clone().abs() > 1e-30 {
            prop_assert_eq!(number.positive(), Ok(truth > 0));
        }
    }
}

#[test]
fn a_guess_is_never_let_through() {
    let third = Interval::rational(&Rational::from((1, 3)), IntervalPrecision::bits(20));
    let one = third.clone() * &third.int(3);
    assert_eq!(one.compare(&third), Ok(Ordering::Greater));
    assert_eq!(one.compare(&one.int(1)), Err(Open));
    assert_eq!(one.below(&one.int(1)), Err(Open));
    // Division by what may be zero is everything.
    let nothing = one.clone() - &one.int(1);
    assert!(!(one / &nothing).is_finite());
}
