use super::*;
use crate::number::Bounded;

#[test]
fn zero_is_what_lies_within_the_bound() {
    let third = Estimate::rounded(1.0 / 3.0, 1.0);
    let one = third.int(3) * &third;
    assert_eq!((one.clone() - one.one()).sign(), Ok(Ordering::Equal));
    let more = Estimate::exact(1.0 + 4.0 * f64::EPSILON);
    assert_eq!(one.compare(&more), Ok(Ordering::Less));
    assert_eq!(Estimate::exact(0.0f64).sign(), Ok(Ordering::Equal));
    assert_eq!(Estimate::exact(f64::MIN_POSITIVE / 2.0).sign(), Ok(Ordering::Greater));
}

#[test]
fn a_root_of_what_may_be_zero_loses_half_of_the_digits() {
    let small = Estimate::new(0.0f64, 1.0);
    let root = small.try_sqrt().unwrap();
    assert!((root.bound() - (f64::EPSILON / 2.0).sqrt()).abs() < 1e-12 * root.bound());
    let four = Estimate::new(4.0f64, 4.0);
    // (a − b)/(√a + √b) = 4u/4, and one rounding of 2.
    assert!((four.try_sqrt().unwrap().error() - 3.0).abs() < 1e-9);
    assert!(Estimate::new(-1.0f64, 4.0).try_sqrt().is_none());
}

#[test]
fn a_number_at_an_integer_is_that_integer() {
    let below = Estimate::rounded(3.0 - f64::EPSILON, 1.0);
    assert_eq!(below.floor_int(), Some(3));
    assert_eq!(Estimate::exact(2.999).floor_int(), Some(2));
    assert_eq!(Estimate::exact(-0.5).floor_int(), Some(-1));
}

#[test]
fn quotients_by_what_may_be_zero_have_no_bound() {
    let zero = Estimate::new(1e-17f64, 1.0);
    assert_eq!((Estimate::exact(1.0) / &zero).error(), f64::INFINITY);
    let half = Estimate::exact(1.0f64) / Estimate::exact(2.0);
    assert_eq!((*half.value(), half.error()), (0.5, 0.5));
}

#[test]
fn an_unknown_bound_decides_nothing_and_stays_unknown() {
    let unknown = Estimate::new(0.0, f64::INFINITY) * &Estimate::exact(1.0) + &Estimate::exact(5.0);
    assert!(unknown.error().is_nan());
    assert_eq!(unknown.sign(), Ok(Ordering::Equal));
    let joined = unknown.joined(&Estimate::exact(5.0));
    assert!(joined.error().is_nan());
}
