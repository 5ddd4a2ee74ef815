//! What several test files share: reference files, problems made from them, and how far apart two numbers are.

#![allow(dead_code, reason = "the tests of the command use a part of it")]

use std::cell::Cell;
use std::fmt::Debug;

use dalembert::{
    Error, Float, Interval, Number, Numbers, Observer, Parameters, Plan, Problem, Question, Rational, Run, Speed,
    Start, TypedHistory,
};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use serde_json::Value;

/// Runs `check` on so many random cases, or on as many as `PROPTEST_CASES` says if that is more. It says how many
/// numbers of a case it has compared, by one or several routes; each route must have compared some in at least so many
/// cases.
#[track_caller]
pub(crate) fn compares<T: Debug, const N: usize>(
    cases: u32,
    least: [u32; N],
    strategy: impl Strategy<Value = T>,
    check: impl Fn(T) -> Result<[usize; N], TestCaseError>,
) {
    let asked = std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok());
    let cases = cases.max(asked.unwrap_or(0));
    let config = ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() };
    let compared = Cell::new([0; N]);
    let run = TestRunner::new(config).run(&strategy, |case| {
        let counts = check(case)?;
        let mut sums = compared.get();
        sums.iter_mut().zip(counts).for_each(|(sum, count)| *sum += u32::from(count > 0));
        compared.set(sums);
        Ok(())
    });
    run.unwrap_or_else(|error| panic!("{error}"));
    let compared = compared.get();
    let enough = compared.iter().zip(&least).all(|(found, least)| found >= least);
    assert!(enough, "of {cases} cases {compared:?} compared numbers, and {least:?} should");
}

/// A file of `tests/reference/`.
pub(crate) fn reference(name: &str) -> Vec<Value> {
    let path = format!("{}/tests/reference/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    serde_json::from_str(&text).unwrap()
}

/// A string or number of a reference file as a number.
pub(crate) fn number(value: &Value) -> Number {
    match value {
        Value::String(text) => text.parse().unwrap(),
        other => other.to_string().parse().unwrap(),
    }
}

/// `p/q`, in the fractions of this build.
pub(crate) fn fraction(p: i64, q: i64) -> Rational {
    format!("{p}/{q}").parse::<Number>().unwrap().to_rational()
}

/// The uniform problem of a reference case, followed through `run`.
pub(crate) fn problem(case: &Value, run: Run) -> Problem {
    let mut problem = Problem::uniform(
        number(&case["length"]),
        number(&case["wave_speed"]),
        number(&case["gravity"]),
        number(&case["impact_speed"]),
    );
    if !case["damping"].is_null() {
        problem = problem.to_builder().damping(number(&case["damping"])).build().unwrap();
    }
    problem = problem.with_run(run).unwrap();
    problem
}

/// A uniform problem from texts, followed to `time`.
pub(crate) fn uniform(length: &str, wave_speed: &str, gravity: &str, speed: &str, run: Run) -> Problem {
    let number = |text: &str| text.parse::<Number>().unwrap();
    let mut problem = Problem::uniform(number(length), number(wave_speed), number(gravity), number(speed));
    problem = problem.to_builder().start(Start::Uniform(Speed::Given(number(speed)))).run(run).build().unwrap();
    problem
}

/// `|a − b|` relative to the greater of `|b|` and `scale`.
#[track_caller]
pub(crate) fn close(what: &str, a: f64, b: f64, scale: f64, accuracy: f64) {
    let error = (a - b).abs() / b.abs().max(scale);
    assert!(error <= accuracy, "{what}: found {a:e}, expected {b:e}, off by {error:.1e} > {accuracy:.0e}");
}

/// The first contact of the rod that these doubles spell, in doubles to `accuracy`.
pub(crate) fn first_contact(rod: &Parameters<f64>, accuracy: f64) -> TypedHistory<f64> {
    let number = |x: f64| format!("{x:e}").parse::<Number>().unwrap();
    let mut problem =
        Problem::uniform(number(rod.length), number(rod.wave_speed), number(rod.gravity), number(rod.speed));
    problem = problem.to_builder().damping(number(rod.damping)).build().unwrap();
    to_accuracy(&problem, accuracy)
}

/// The first contact of `problem` in doubles to `accuracy`.
pub(crate) fn to_accuracy(problem: &Problem, accuracy: f64) -> TypedHistory<f64> {
    let plan = Plan::of(problem, &Question::first_contact(Numbers::Double(Some(accuracy)))).unwrap();
    TypedHistory::solve(problem, &plan, std::sync::Arc::new(dalembert::engine::unobserved)).unwrap()
}

/// A history in the numbers of its plan.
pub(crate) enum Solution {
    Double(TypedHistory<f64>),
    Digits(TypedHistory<Float>),
    Exact(TypedHistory<Rational>),
    Certified(TypedHistory<Interval>),
}

impl Solution {
    /// The run of `problem` in `numbers`.
    pub(crate) fn of(problem: &Problem, numbers: Numbers, observe: Observer) -> Result<Self, Error> {
        let plan = Plan::of(problem, &Question::run(numbers))?;
        Ok(match numbers {
            Numbers::Double(_) => Solution::Double(TypedHistory::solve(problem, &plan, observe)?),
            Numbers::Digits(_) => Solution::Digits(TypedHistory::solve(problem, &plan, observe)?),
            Numbers::Exact => Solution::Exact(TypedHistory::solve(problem, &plan, observe)?),
            Numbers::Certified(_) => Solution::Certified(TypedHistory::solve(problem, &plan, observe)?),
            Numbers::ExactThenDigits(_) => unreachable!("one number system for the whole run"),
        })
    }
}

/// `t_b` and its bound, where the rod bounces.
pub(crate) fn bounce_time(history: &TypedHistory<f64>) -> Option<(f64, f64)> {
    history.events().get(1).map(|release| (release.t, release.t_error))
}

/// Numbers that look random, the same on every machine (splitmix64).
pub(crate) struct Random(pub(crate) u64);
impl Random {
    /// What `make explore` draws from.
    pub(crate) fn explored() -> u64 {
        std::env::var("PROPTEST_RNG_SEED").ok().and_then(|seed| seed.parse().ok()).unwrap_or(1)
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * (((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64)
    }

    /// Four digits, so that a failure can be typed.
    pub(crate) fn typed(&mut self, low: f64, high: f64) -> f64 {
        format!("{:.3e}", self.between(low, high)).parse().unwrap()
    }

    /// Between powers of ten, in five digits.
    pub(crate) fn size(&mut self, low: f64, high: f64) -> String {
        format!("{:.4e}", 10f64.powf(self.between(low, high)))
    }

    /// Whether something of this probability happens.
    pub(crate) fn is(&mut self, probability: f64) -> bool {
        self.between(0.0, 1.0) < probability
    }

    /// One of them.
    pub(crate) fn of<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.between(0.0, list.len() as f64) as usize]
    }
}
