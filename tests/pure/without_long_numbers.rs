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
