#![allow(clippy::unwrap_used)]
use super::*;
use dalembert::number::Estimate;

#[test]
fn a_truth_is_as_exact_as_its_text() {
    let digits =
        |truth: &str, value: f64| Truth::from_text(truth).unwrap().right_digits(&Estimate::exact(value).into());
    assert_eq!(digits("2", 2.0), f64::INFINITY);
    assert_eq!(digits("5/2", 2.5), f64::INFINITY);
    assert_eq!(digits("2.500", 2.5), 3.0);
    assert_eq!(digits("2", f64::NAN), 0.0);
    assert!((digits("2", 2.002) - 3.0).abs() < 1e-12);
    assert!(Truth::from_text("no bounce").is_none());
}
