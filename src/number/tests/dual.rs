use super::*;
use crate::number::{Estimate, Rational};

fn dual(value: (i64, i64), rate: (i64, i64)) -> Dual<Rational> {
    let fraction = |(p, q): (i64, i64)| Rational::from(p) / Rational::from(q);
    Dual::new(fraction(value), fraction(rate))
}

/// Checks `(x² + 3)/x` at x = 2, with the derivative `1 − 3/x²`, and `√(x² + 5)`, with the derivative `x/√(x² + 5)`.
#[test]
fn rates_are_derivatives() {
    let x = dual((2, 1), (1, 1));
    let quotient = (x.square() + x.int(3)) / &x;
    assert_eq!((quotient.value(), quotient.rate()), (dual((7, 2), (0, 1)).value(), dual((0, 1), (1, 4)).rate()));
    let root = (x.square() + x.int(5)).try_sqrt().unwrap();
    assert_eq!((root.value(), root.rate()), (dual((3, 1), (0, 1)).value(), dual((0, 1), (2, 3)).rate()));
}

#[test]
fn rates_decide_between_equal_numbers() {
    let (one, more, less) = (dual((1, 1), (0, 1)), dual((1, 1), (1, 9)), dual((1, 1), (-1, 9)));
    assert_eq!((more.compare(&one), less.compare(&one)), (Ok(Ordering::Greater), Ok(Ordering::Less)));
    assert_eq!([&one, &more, &less].map(Scalar::floor_int), [Some(1), Some(1), Some(0)]);
    // First order determines neither ε/ε nor √ε.
    let step = more - &one;
    assert_eq!(((one / &step).sign(), step.try_sqrt().unwrap().sign()), (Err(Open), Err(Open)));
}

/// Checks `√(x² + 3)/(2 x)` at x = 0.1, with the rate `−3/(2 x² √(x² + 3))`: in doubles the number and its rate are
/// each within their own bound, which is a few roundings of them.
#[test]
fn rates_in_doubles_carry_their_bounds() {
    let x = Dual::new(Estimate::rounded(0.1, 1.0), Estimate::exact(1.0));
    let found = (x.square() + x.int(3)).try_sqrt().unwrap() / x.clone().doubled();
    let rate = found.rate().unwrap();
    // √3.01 = 1.7349351572897473 as a double.
    let expected = -3.0 / (2.0 * 0.01 * 1.734_935_157_289_747_3);
    assert!((rate.value() - expected).abs() <= rate.bound() && rate.bound() < 40.0 * f64::EPSILON * expected.abs());
    // Equal within bounds: no rate decides which number is greater.
    let tenths = x.clone() + &x + &x;
    let three = Dual::constant(Estimate::rounded(0.3, 1.0));
    assert_eq!((tenths.compare(&three), three.compare(&three)), (Err(Open), Ok(Ordering::Equal)));
}

/// Checks that `a + b s` vanishes at `s = −a/b` with the rate `−ȧ/b + a ḃ/b²`. With a = 0 within 2⁻⁴³, ȧ = 2⁻⁴⁰, b = −2
/// and ḃ = 1 this is 2⁻⁴¹ within 2⁻⁴⁵, and the bound is at most four times that.
#[test]
fn a_root_next_to_a_break_has_a_rate() {
    let known = |x: f64| Estimate::exact(x);
    let height = Dual::new(Estimate::new(0.0, 1024.0), known(0.5f64.powi(40)));
    let slope = Dual::new(known(-2.0), known(1.0));
    let found = height.root_deviation(&slope, &Dual::constant(known(0.0))).unwrap();
    let rate = found.rate().unwrap();
    let (size, within) = (rate.value().abs(), rate.bound());
    assert!((size - 0.5f64.powi(41)).abs() <= within, "{rate:?}");
    assert!((0.5f64.powi(45)..0.5f64.powi(43)).contains(&within), "{rate:?}");
    // The root has no rate without a slope: its error is unbounded.
    let flat = height.root_deviation(&Dual::constant(known(0.0)), &Dual::constant(known(0.0))).unwrap();
    assert_eq!(flat.rate().unwrap().bound(), f64::INFINITY);
}
