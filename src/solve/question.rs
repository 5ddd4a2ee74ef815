//! Questions about a problem, their number systems, and observers of the progress of a run.

use std::ops::{ControlFlow, RangeInclusive};
use std::sync::{Arc, LazyLock};

use serde::Serialize;

use crate::error::Error;
use crate::number::Number;
use crate::quantity::{Needs, Quantity};

/// Accuracies of doubles that can be asked for: doubles hold no better one.
pub const ACCURACIES: RangeInclusive<f64> = 1e-15..=0.1;
/// Maximum requested digits; a larger number is a slip, not a question.
pub const MAX_DIGITS: u32 = 100_000;

/// A question about a problem and its number system: with the problem, all that a [`Plan`](super::Plan) depends on.
///
/// ```
/// use dalembert::{Numbers, Question};
/// let question = Question::run(Numbers::Digits(50));
/// assert_eq!(question.numbers.to_string(), "50 digits");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// The requested results.
    pub want: Want,
    /// The requested number system.
    pub numbers: Numbers,
}

/// The results requested of a problem.
#[derive(Clone, Debug, PartialEq)]
pub enum Want {
    /// Every event and contact up to the end of the problem's own run.
    Run,
    /// The first contact, up to the bounce: its events, its impulse and its peak. No flight is computed.
    FirstContact,
    /// Single numbers of the first contact, such as `t_b`, `e_P`, `e_E²`, its impulse, the energies at the bounce. Each
    /// is computed when it is queried, and nothing else.
    Bounce,
    /// Values between two times, both included. The run may drop all data before the first.
    Between(Number, Number),
}

/// The number system of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Numbers {
    /// Doubles, to this accuracy relative to the greatest number of an answer; `None` for
    /// [`DEFAULT_ACCURACY`](super::DEFAULT_ACCURACY). If doubles alone do not reach it, the computation uses longer
    /// numbers, rounded to doubles at the end.
    Double(Option<f64>),
    /// This many decimal digits, rounded once.
    Digits(u32),
    /// Fractions, without any error, up to the first irrational time.
    Exact,
    /// Fractions, replaced by this many decimal digits of the whole run if they do not reach its end.
    ExactThenDigits(u32),
    /// Decimal digits, this many, proved by enclosures.
    Certified(u32),
}

impl Question {
    /// Returns the question for the whole run.
    pub fn run(numbers: Numbers) -> Self {
        Question { want: Want::Run, numbers }
    }

    /// Returns the question for the first contact alone.
    pub fn first_contact(numbers: Numbers) -> Self {
        Question { want: Want::FirstContact, numbers }
    }

    /// Returns the question for single numbers of the first contact.
    pub fn bounce(numbers: Numbers) -> Self {
        Question { want: Want::Bounce, numbers }
    }

    /// Returns the question that yields `quantity`: at `time` if given, otherwise for the first contact or at its end.
    pub fn of(quantity: Quantity, time: Option<&Number>, numbers: Numbers) -> Self {
        match (quantity.needs(), time) {
            (Needs::Event | Needs::Flight | Needs::Piece | Needs::Run, _) | (Needs::Contact, Some(_)) => {
                Question::run(numbers)
            }
            (Needs::Contact, None) if !quantity.is_of_ends() => Question::first_contact(numbers),
            // These quantities depend on all that happened before.
            (_, None) if quantity.is_of_past() => Question::first_contact(numbers),
            (_, Some(time)) if quantity.is_of_past() => Question::between(0.into(), time.clone(), numbers),
            (_, None) => Question::bounce(numbers),
            (_, Some(time)) => Question::between(time.clone(), time.clone(), numbers),
        }
    }

    /// Returns the question for values between two times.
    pub fn between(from: Number, to: Number, numbers: Numbers) -> Self {
        Question { want: Want::Between(from, to), numbers }
    }
}

impl Numbers {
    /// Refuses an accuracy or a number of digits outside of its range.
    pub(crate) fn check(self) -> Result<(), Error> {
        match self {
            Numbers::Double(Some(found)) if !ACCURACIES.contains(&found) => Err(Error::Accuracy { found }),
            Numbers::Digits(found) | Numbers::ExactThenDigits(found) | Numbers::Certified(found)
                if !(1..=MAX_DIGITS).contains(&found) =>
            {
                Err(Error::Digits { found, most: MAX_DIGITS })
            }
            _ => Ok(()),
        }
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

/// A function that receives the progress of a run from time to time: round trips, or contacts if these limit the run,
/// and the number of pieces. It may end the run with [`Error::Interrupted`](crate::Error::Interrupted).
pub type Observer = Arc<dyn Fn(usize, usize) -> ControlFlow<()> + Send + Sync>;

pub(super) static UNOBSERVED: LazyLock<Observer> = LazyLock::new(|| Arc::new(crate::motion::unobserved));

/// Returns an observer that lets every run go on.
pub fn unobserved() -> Observer {
    UNOBSERVED.clone()
}
