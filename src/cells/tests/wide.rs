//! A damped march in floats of fixed limbs, compared with the march in more digits.

use std::ops::ControlFlow;

use super::{Damped, Effort, Task};
use crate::Number;
use crate::motion::{EventKind, Motion};
use crate::number::{Rational, Scalar, Wide};
use crate::problem::{Problem, Run};
use crate::special::RoundedSpecial;

/// Builds a rod with r = 1/10, μ = 10 and ten impacts.
fn rod() -> Problem {
    let mut problem = Problem::uniform(Number::from(1), Number::from(1), Number::from(1), Number::from(10));
    problem = problem.to_builder().damping("0.1").build().unwrap();
    problem = problem.with_run(Run::Impacts(10)).unwrap();
    problem
}

/// Computes the times of all events, and their bounds.
fn march<S: RoundedSpecial>(precision: &S::Precision, digits: f64, exactly: impl Fn(&S) -> Rational) -> Vec<Time> {
    let problem = rod();
    let effort = Effort { digits, cells: u64::MAX, until_lost: false };
    let task = Task { problem: &problem, precision, effort, observe: &|_, _| ControlFlow::Continue(()) };
    let run = Damped::<S>::march(&task, false).unwrap();
    let time = |event: &crate::motion::Event<_>| {
        let time: &crate::Estimate<S> = &event.t;
        Time { kind: event.kind, at: exactly(time.value()), log2_bound: time.log2_error() }
    };
    run.events().iter().map(time).collect()
}

struct Time {
    kind: EventKind,
    at: Rational,
    log2_bound: f64,
}

/// Counts the events, and asserts that each is within both bounds of the other, and that its own is as narrow as the
/// digits require.
fn agree(rough: &[Time], fine: &[Time], least_digits: f64) {
    assert_eq!(rough.len(), fine.len());
    assert_eq!(rough.iter().filter(|time| time.kind == EventKind::Impact).count(), 10);
    for (a, b) in rough.iter().zip(fine) {
        assert_eq!(a.kind, b.kind);
        let off = Scalar::to_f64(&(a.at.clone() - &b.at)).abs();
        assert!(off <= a.log2_bound.exp2() + b.log2_bound.exp2(), "{off} 2^{}", a.log2_bound);
        assert!(a.log2_bound < -least_digits * std::f64::consts::LOG2_10, "2^{}", a.log2_bound);
    }
}

fn wide<const N: usize>(digits: f64) -> Vec<Time> {
    march::<Wide<N>>(&(), digits, |x| Wide::to_rational(*x).unwrap())
}

#[test]
fn more_limbs_say_the_same() {
    agree(&wide::<2>(15.0), &wide::<4>(25.0), 8.0);
}

/// Only the fewest limbs without GMP and MPFR, whose long floats are 20 times slower.
#[test]
fn events_are_those_of_twice_the_bits() {
    let float = |bits: u32, digits: f64| march::<crate::number::Float>(&bits, digits, |x| x.to_rational().unwrap());
    agree(&wide::<2>(20.0), &float(256, 30.0), 12.0);
    if cfg!(feature = "mp") {
        agree(&wide::<3>(30.0), &float(384, 40.0), 22.0);
        agree(&wide::<4>(45.0), &float(512, 55.0), 37.0);
    }
}
