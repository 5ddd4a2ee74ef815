//! The promises of routes, whether they keep them, and the verdict on a case.

use crate::error::VerifyError;
use crate::routes::{Truth, shown};
use dalembert::Value;

/// The one truth that is no number.
pub(super) const NO_BOUNCE: &str = "no bounce";

/// The promise of a route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Promise {
    /// This many right digits.
    Digits(u32),
    /// An answer within its own bound, which leaves this many digits. With zero digits the route may also leave the
    /// answer undecided.
    Bound(u32),
    /// The truth itself.
    Exact,
    /// Two ends with the truth between them, and with this many digits in common.
    Enclosed(u32),
    /// No promise: the catalogue shows that fewer digits than this are right.
    Fewer(u32),
}

impl std::fmt::Display for Promise {
    /// Writes the promise in words: `36 digits proved`.
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

/// The outcome of a promise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display, strum::IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
pub enum Outcome {
    /// The promise is kept.
    Kept,
    /// The route promises nothing, and loses digits as foreseen.
    Breaks,
    /// The route leaves the answer undecided, as its promise allows.
    #[strum(serialize = "says so")]
    Undecided,
    /// The promise is broken.
    #[strum(serialize = "FAILED")]
    Failed,
}

/// The verdict on a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display, strum::IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
pub enum Verdict {
    /// Every route keeps what it promises.
    Holds,
    /// The paper is right.
    Reproduced,
    /// The paper is wrong, and the catalogue has the truth.
    Corrected,
    /// The paper means the right thing and prints another.
    Misprint,
    /// The paper leaves a question open, and the catalogue has the answer.
    Settled,
    /// Some route does not keep what it promises.
    #[strum(serialize = "FAILED")]
    Failed,
}

/// A route to a question, with its answer.
#[derive(Clone, Debug)]
pub struct CheckedRoute {
    /// The route in words.
    pub route: String,
    pub(super) answer: Result<Value, VerifyError>,
    /// The promise of the route.
    pub promise: Promise,
    /// Number of right digits: `None` without a number, infinite for the truth itself.
    pub digits: Option<f64>,
    /// The outcome of the promise.
    pub outcome: Outcome,
    /// Time of the answer, seconds.
    pub seconds: f64,
}

impl CheckedRoute {
    /// Returns the answer in words: `no bounce`, or a number.
    pub fn answer(&self) -> String {
        match &self.answer {
            Ok(value) => shown(value),
            Err(VerifyError::NoSuchQuantity { .. }) => NO_BOUNCE.into(),
            Err(_) => "undecided".into(),
        }
    }
}

impl Promise {
    /// Judges an answer with so many right `digits`; `truth` is `None` for a motion without a bounce.
    pub(super) fn outcome(self, truth: Option<&Truth>, answer: &Result<Value, VerifyError>, digits: f64) -> Outcome {
        let kept = |holds: bool| if holds { Outcome::Kept } else { Outcome::Failed };
        let broken = |breaks: bool| if breaks { Outcome::Breaks } else { Outcome::Failed };
        match (answer, truth, self) {
            (Err(VerifyError::NoSuchQuantity { .. }), None, promise) => kept(!matches!(promise, Promise::Fewer(_))),
            (Err(VerifyError::NoSuchQuantity { .. }), Some(_), promise) | (Ok(_), None, promise) => {
                broken(matches!(promise, Promise::Fewer(_)))
            }
            (Err(_), _, Promise::Bound(0)) => Outcome::Undecided,
            (Err(_), ..) => Outcome::Failed,
            (Ok(_), Some(_), Promise::Fewer(most)) => broken(digits < f64::from(most)),
            (Ok(_), Some(_), Promise::Digits(least) | Promise::Enclosed(least)) => kept(digits >= f64::from(least)),
            (Ok(_), Some(_), Promise::Exact) => kept(digits == f64::INFINITY),
            (Ok(answer), Some(truth), Promise::Bound(least)) => {
                let scale = 10f64.powf(truth.log10_scale());
                let useful = answer.log2_error().exp2() <= 10f64.powi(-(least as i32)) * scale;
                // An error below the uncertainty of the truth cannot be seen.
                let within = digits >= truth.most_digits() || 10f64.powf(-digits) * scale <= answer.log2_error().exp2();
                kept(useful && within)
            }
        }
    }
}
