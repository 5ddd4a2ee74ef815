//! What a route promises, and whether it keeps it.

use super::value::{Answer, Kept, Trouble, Truth, Value};

/// What a route promises of its answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Promise {
    /// So many right digits.
    Digits(u32),
    /// That the answer is within the bound that comes with it, and this bound leaves so many digits. With zero digits the route may
    /// also say that it does not know.
    Bound(u32),
    /// The truth itself.
    Exact,
    /// Two bounds with the truth between them, and so many digits in common.
    Enclosed(u32),
    /// Nothing. The catalogue shows that fewer digits than this are kept: what goes wrong, and has to be seen going wrong.
    Less(u32),
}

impl std::fmt::Display for Promise {
    /// In words: `36 digits proved`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Promise::Digits(0) => f.write_str("the right answer"),
            Promise::Digits(digits) => write!(f, "{digits} digits"),
            Promise::Bound(0) => f.write_str("within its own bound"),
            Promise::Bound(digits) => write!(f, "within its own bound, {digits} digits"),
            Promise::Exact => f.write_str("exact"),
            Promise::Enclosed(digits) => write!(f, "{digits} digits proved"),
            Promise::Less(1) => f.write_str("nothing: no digit is right"),
            Promise::Less(digits) => write!(f, "nothing: fewer than {digits} digits are right"),
        }
    }
}

/// What came of a promise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Kept.
    Kept,
    /// Nothing was promised, and digits are lost as foreseen.
    Breaks,
    /// The route says that it does not know, which it may.
    Silent,
    /// Not kept.
    Failed,
}

impl Outcome {
    /// The word in output.
    pub fn name(self) -> &'static str {
        match self {
            Outcome::Kept => "kept",
            Outcome::Breaks => "breaks",
            Outcome::Silent => "says so",
            Outcome::Failed => "FAILED",
        }
    }
}

/// One route's answer to one question.
#[derive(Clone, Debug)]
pub struct Row {
    /// The route, in words.
    pub route: String,
    /// What it answers.
    pub found: Value,
    /// What it promises.
    pub promise: Promise,
    /// The right digits.
    pub kept: Kept,
    /// Whether the promise is kept.
    pub outcome: Outcome,
    /// What it took, in seconds.
    pub seconds: f64,
}

impl Row {
    pub(super) fn judged(
        route: String,
        promise: Promise,
        truth: &Truth,
        answer: Result<Answer, Trouble>,
        seconds: f64,
    ) -> Self {
        let answer = match answer {
            Ok(answer) => answer,
            Err(Trouble(why)) => Answer { value: Value::Undecided(why), bound: f64::INFINITY },
        };
        let kept = truth.kept(&answer.value);
        let outcome = outcome(promise, truth, &answer, kept);
        Row { route, found: answer.value, promise, kept, outcome, seconds }
    }
}

fn outcome(promise: Promise, truth: &Truth, answer: &Answer, kept: Kept) -> Outcome {
    let held = |holds: bool| if holds { Outcome::Kept } else { Outcome::Failed };
    match (&answer.value, &truth.number) {
        (Value::Undecided(_), _) => {
            if promise == Promise::Bound(0) {
                Outcome::Silent
            } else {
                Outcome::Failed
            }
        }
        (Value::NoBounce, None) => held(!matches!(promise, Promise::Less(_))),
        (Value::NoBounce, Some(_)) | (_, None) => {
            if matches!(promise, Promise::Less(_)) {
                Outcome::Breaks
            } else {
                Outcome::Failed
            }
        }
        _ => match promise {
            Promise::Less(digits) if kept.digits() < f64::from(digits) => Outcome::Breaks,
            Promise::Less(_) => Outcome::Failed,
            Promise::Digits(digits) | Promise::Enclosed(digits) => held(kept.digits() >= f64::from(digits)),
            Promise::Exact => held(kept == Kept::All),
            Promise::Bound(digits) => {
                let useful = answer.bound <= 10f64.powi(-(digits as i32)) * truth.unit();
                let within = match kept {
                    Kept::All => true,
                    // As far as the truth is known.
                    Kept::Digits(digits) if Some(digits + 1.0) == truth.digits.map(f64::from) => true,
                    other => 10f64.powf(-other.digits()) * truth.unit() <= answer.bound,
                };
                held(useful && within)
            }
        },
    }
}
