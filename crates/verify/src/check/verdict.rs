//! What a route promises, whether it keeps that, and what a case comes to.

use crate::account::Found;
use crate::truth::Truth;
use crate::value::{NoAnswer, Value};

/// The one truth that is no number.
pub const NO_BOUNCE: &str = "no bounce";

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Promise {
    /// So many right digits.
    Digits(u32),
    /// That the answer is within the bound that comes with it, and this bound leaves so many digits. With zero digits
    /// the route may also leave the answer undecided.
    Bound(u32),
    /// The truth itself.
    Exact,
    /// Two bounds with the truth between them, and so many digits in common.
    Enclosed(u32),
    /// Nothing. The catalogue shows that fewer digits than this are right: what goes wrong has to be seen to go wrong.
    Fewer(u32),
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
            Promise::Fewer(1) => f.write_str("nothing: no digit is right"),
            Promise::Fewer(digits) => write!(f, "nothing: fewer than {digits} digits are right"),
        }
    }
}

/// What came of a promise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display, strum::IntoStaticStr)]
pub enum Outcome {
    #[strum(serialize = "kept")]
    Kept,
    /// Nothing was promised, and digits are lost as foreseen.
    #[strum(serialize = "breaks")]
    Breaks,
    /// The route leaves the answer undecided, which it may.
    #[strum(serialize = "says so")]
    Undecided,
    #[strum(serialize = "FAILED")]
    Failed,
}

impl Outcome {
    /// The name in output.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// What a case comes to when all its promises are kept, or that they are not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display, strum::IntoStaticStr)]
pub enum Verdict {
    /// Every route keeps what it promises.
    #[strum(serialize = "holds")]
    Holds,
    /// The paper is right.
    #[strum(serialize = "reproduced")]
    Reproduced,
    /// The paper is off, and here is the truth.
    #[strum(serialize = "corrected")]
    Corrected,
    /// The paper means the right thing and prints another.
    #[strum(serialize = "misprint")]
    Misprint,
    /// The paper leaves it open, and here is an answer.
    #[strum(serialize = "settled")]
    Settled,
    /// Some route does not keep what it promises.
    #[strum(serialize = "FAILED")]
    Failed,
}

impl Verdict {
    /// The name in output.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

#[derive(Clone, Debug)]
pub struct Row {
    pub route: String,
    pub found: Found<Value>,
    pub promise: Promise,
    /// How many of its digits are right: `None` where there is no number, infinite for the truth itself.
    pub digits: Option<f64>,
    pub outcome: Outcome,
    pub seconds: f64,
}

impl Row {
    /// The answer in words: `no bounce`, or a number.
    pub fn found(&self) -> String {
        match &self.found {
            Ok(value) => value.to_string(),
            Err(NoAnswer::NoSuchQuantity { .. }) => NO_BOUNCE.into(),
            Err(_) => "undecided".into(),
        }
    }
}

/// What comes of a promise; `truth` is `None` where there is no bounce.
pub fn outcome(promise: Promise, truth: Option<&Truth>, answer: &Found<Value>, digits: f64) -> Outcome {
    let kept = |holds: bool| if holds { Outcome::Kept } else { Outcome::Failed };
    let broken = |breaks: bool| if breaks { Outcome::Breaks } else { Outcome::Failed };
    match (answer, truth, promise) {
        (Err(NoAnswer::NoSuchQuantity { .. }), None, promise) => kept(!matches!(promise, Promise::Fewer(_))),
        (Err(NoAnswer::NoSuchQuantity { .. }), Some(_), promise) | (Ok(_), None, promise) => {
            broken(matches!(promise, Promise::Fewer(_)))
        }
        (Err(_), _, Promise::Bound(0)) => Outcome::Undecided,
        (Err(_), ..) => Outcome::Failed,
        (Ok(_), Some(_), Promise::Fewer(most)) => broken(digits < f64::from(most)),
        (Ok(_), Some(_), Promise::Digits(least) | Promise::Enclosed(least)) => kept(digits >= f64::from(least)),
        (Ok(_), Some(_), Promise::Exact) => kept(digits == f64::INFINITY),
        (Ok(answer), Some(truth), Promise::Bound(least)) => {
            let scale = 10f64.powf(truth.log10_scale());
            let useful = answer.bound() <= 10f64.powi(-(least as i32)) * scale;
            // No more can be seen than the truth is known to.
            let within = digits >= truth.most_digits() || 10f64.powf(-digits) * scale <= answer.bound();
            kept(useful && within)
        }
    }
}
