//! The refusals of the library in pure Rust.
#![cfg(not(feature = "mp"))]

use dalembert::{Error, Numbers, Plan, Problem, Question};

#[test]
fn digits_and_proofs_are_refused_by_name() {
    let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).build().unwrap();
    assert_eq!(rod.digits(20).unwrap_err(), Error::NoMultiprecision);
    assert_eq!(rod.certified(20).unwrap_err(), Error::NoMultiprecision);
    let then_digits = Question::run(Numbers::ExactThenDigits(20));
    assert_eq!(Plan::of(&rod, &then_digits).unwrap_err(), Error::NoMultiprecision);
}

/// Shortly below r t₁ = π the rays of the first contact cancel, and doubles do not settle how it ends.
#[test]
fn a_late_bounce_is_refused_by_name() {
    let rod = Problem::builder().length("1/2").wave_speed(1).damping("3.13").impact_speed(1).build().unwrap();
    let refused = rod.doubles().unwrap_err();
    assert_eq!(refused, Error::NoMultiprecision);
    assert!(refused.to_string().contains("answers that doubles do not settle"), "{refused}");
}
