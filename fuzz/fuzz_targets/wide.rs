//! Any bytes: two numbers of three limbs, computed with on the stack and in `dashu`. `cargo +nightly fuzz run wide`
#![no_main]

use dalembert::number::{Analytic, Float, Scalar, Wide};

/// Builds a number from a mantissa and an exponent; exponents of most inputs are close, so that sums cancel.
fn number(mantissa: [i64; 3], exponent: i8) -> (Wide<3>, Float) {
    let (wide, long) = (Wide::<3>::from(1), Float::with_val(192, 1));
    fn built<S: Scalar>(one: S, mantissa: [i64; 3], exponent: i8) -> S {
        let (word, two) = (one.int(1 << 32) * one.int(1 << 32), one.int(2));
        let sum = (one.int(mantissa[0]) * &word + one.int(mantissa[1])) / word + one.int(mantissa[2]);
        (0..exponent.unsigned_abs()).fold(sum, |x, _| if exponent < 0 { x / &two } else { x * &two })
    }
    (built(wide, mantissa, exponent), built(long, mantissa, exponent))
}

/// Asserts that both are the same, up to a rounding of the middle between two numbers, which `Wide` takes from zero.
fn same(what: &str, wide: Wide<3>, long: Float, roundings: f64) {
    let Some(found) = wide.to_rational() else { return assert!(!long.is_finite(), "{what}") };
    let sure = long.to_rational().expect("a finite number");
    let apart = Scalar::to_f64(&(found - &sure)).abs();
    assert!(apart <= roundings * Scalar::to_f64(&sure).abs() * 2f64.powi(-191), "{what} {apart:e}");
}

libfuzzer_sys::fuzz_target!(|input: ([i64; 3], i8, [i64; 3], i8)| {
    let (m, e, n, f) = input;
    let ((a, x), (b, _)) = (number(m, e), number(n, f));
    same("number", a, x.clone(), 4.0);
    // The numbers of both may differ in a middle, so both compute with the same ones.
    let lift = |x: &Wide<3>| Float::with_val(192, &x.to_rational().expect("a finite number"));
    let (x, y) = (lift(&a), lift(&b));
    same("sum", a + b, x.clone() + &y, 1.0);
    same("difference", a - b, x.clone() - &y, 1.0);
    same("product", a * b, x.clone() * &y, 1.0);
    if !y.is_zero() {
        same("quotient", a / b, x.clone() / &y, 1.0);
    }
    if let Some(root) = a.try_sqrt() {
        same("root", root, x.clone().sqrt(), 1.0);
    }
    if x.to_f64().abs() < 1e6 {
        same("exp", a.exp(), Analytic::exp(&x), 1.1);
        same("sin", a.sin(), Analytic::sin(&x), 1.1);
        same("cos", a.cos(), Analytic::cos(&x), 1.1);
    }
});
