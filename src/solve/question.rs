//! What is asked of a problem, in which numbers, and who is told how far a run is.

use std::ops::ControlFlow;
use std::sync::{Arc, LazyLock};

use serde::Serialize;

use crate::number::Number;
use crate::quantity::{Needs, Quantity};

/// What is asked of a problem, and in which numbers: all that a [`Plan`](super::Plan) is made from besides the problem.
///
/// ```
/// use dalembert::{Numbers, Question};
/// let question = Question::run(Numbers::Digits(50));
/// assert_eq!(question.numbers.to_string(), "50 digits");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// What.
    pub want: Want,
    /// In which numbers.
    pub numbers: Numbers,
}

/// What is asked of a problem.
#[derive(Clone, Debug, PartialEq)]
pub enum Want {
    /// Every event and contact up to the end of the problem's own run.
    Run,
    /// The first contact, up to the bounce: its events, its impulse and its peak. No flight is followed.
    FirstContact,
    /// Single numbers of the first contact, such as `t_b`, `e_P`, `e_E²`, its impulse, the energies at the bounce: each
    /// is worked out when it is asked for, and nothing else.
    Bounce,
    /// Values between two times, both included. What lies before the first need not be kept.
    Between(Number, Number),
}

/// The numbers of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Numbers {
    /// Doubles, to this accuracy relative to the greatest number of an answer; `None` for
    /// [`DEFAULT_ACCURACY`](super::DEFAULT_ACCURACY). Where doubles alone do not reach it, longer numbers are computed
    /// with and rounded to doubles at the end.
    Double(Option<f64>),
    /// This many decimal digits, rounded once.
    Digits(u32),
    /// Fractions, without any error, as far as they reach.
    Exact,
    /// Fractions as far as they reach, and this many decimal digits of the whole run where they end before it does.
    ExactThenDigits(u32),
    /// This many decimal digits, proved by enclosures.
    Certified(u32),
}

impl Question {
    /// The whole run.
    pub fn run(numbers: Numbers) -> Self {
        Question { want: Want::Run, numbers }
    }

    /// The first contact alone.
    pub fn first_contact(numbers: Numbers) -> Self {
        Question { want: Want::FirstContact, numbers }
    }

    /// Single numbers of the first contact.
    pub fn bounce(numbers: Numbers) -> Self {
        Question { want: Want::Bounce, numbers }
    }

    /// What answers `quantity`: at `time` where it has one, otherwise of the first contact or at its end.
    pub fn of(quantity: Quantity, time: Option<&Number>, numbers: Numbers) -> Self {
        match (quantity.needs(), time) {
            (Needs::Event | Needs::Flight | Needs::Piece | Needs::Run, _) | (Needs::Contact, Some(_)) => {
                Question::run(numbers)
            }
            (Needs::Contact, None) if !quantity.is_of_ends() => Question::first_contact(numbers),
            // What has happened before is part of these.
            (_, None) if quantity.is_of_past() => Question::first_contact(numbers),
            (_, Some(time)) if quantity.is_of_past() => Question::between(0.into(), time.clone(), numbers),
            (_, None) => Question::bounce(numbers),
            (_, Some(time)) => Question::between(time.clone(), time.clone(), numbers),
        }
    }

    /// Values between two times.
    pub fn between(from: Number, to: Number, numbers: Numbers) -> Self {
        Question { want: Want::Between(from, to), numbers }
    }
}

impl Default for Numbers {
    fn default() -> Self {
        Numbers::Double(None)
    }
}

impl std::fmt::Display for Numbers {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Numbers::Double(None) => f.write_str("double"),
            Numbers::Double(Some(accuracy)) => write!(f, "double, accuracy {accuracy:e}"),
            Numbers::Digits(digits) => write!(f, "{digits} digits"),
            Numbers::Exact => f.write_str("exact"),
            Numbers::ExactThenDigits(digits) => write!(f, "exact, then {digits} digits"),
            Numbers::Certified(digits) => write!(f, "{digits} digits, proved"),
        }
    }
}

/// Receives from time to time how far a run is, in round trips, or in contacts where so many are asked for, and how
/// many pieces it has; may end the run with [`Error::Interrupted`](crate::Error::Interrupted).
pub type Observer = Arc<dyn Fn(usize, usize) -> ControlFlow<()> + Send + Sync>;

pub(super) static UNOBSERVED: LazyLock<Observer> = LazyLock::new(|| Arc::new(crate::motion::unobserved));

/// Returns an observer that lets every run go on.
pub fn unobserved() -> Observer {
    UNOBSERVED.clone()
}
