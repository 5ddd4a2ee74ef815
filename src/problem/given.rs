//! Values as a user gave them, and the limits that they are held to.

use std::collections::BTreeMap;

use super::written::has_unit;
use super::{Parameter, ProblemError, ProblemErrorKind as Kind, Written};
use crate::number::{Number, NumberError};

/// Every quantity with a unit: energies are products of at most seven of them and stay within 1e±300.
pub(super) const UNITS: (f64, f64) = (1e-40, 1e40);

pub(crate) type ByParameter<T> = BTreeMap<Parameter, T>;

/// A value that is a number, with what messages about it need.
pub(crate) struct Given<'a> {
    pub(super) path: &'a str,
    pub(super) name: &'a str,
    pub(super) shown: &'a str,
    pub(crate) number: &'a Number,
}

impl<'a> Given<'a> {
    /// **Errors**: [`Kind::NotANumber`].
    pub(crate) fn new(path: &'a str, name: &'a str, written: &'a Written) -> Result<Self, ProblemError> {
        let shown = written.shown.as_str();
        let error = match &written.number {
            Ok(number) => return Ok(Given { path, name, shown, number }),
            Err(error) => error,
        };
        let note =
            if let NumberError::TooLong(count) = error { format!(", {count} characters") } else { String::new() };
        let expected = match error {
            NumberError::Unreadable(text) if has_unit(text) => {
                "a number such as 3, 0.1, 1e-9 or \"1/3\", without a unit"
            }
            NumberError::Unreadable(_) => "a number such as 3, 0.1, 1e-9 or \"1/3\", decimal and finite",
            NumberError::ZeroDenominator(_) => "a fraction whose denominator is not zero",
            NumberError::Size(_) => "zero or a magnitude between 1e-300 and 1e300",
            NumberError::TooLong(_) => "a number of at most 20000 characters",
        };
        Err(ProblemError::new(Kind::NotANumber, path, format!("{name} = {shown}{note}"), expected))
    }

    pub(crate) fn error(&self, kind: Kind, note: &str, expected: impl Into<String>) -> ProblemError {
        ProblemError::new(kind, self.path, format!("{} = {}{note}", self.name, self.shown), expected)
    }

    pub(super) fn positive(self, what: &str) -> Result<Self, ProblemError> {
        match self.number.to_f64() {
            x if x <= 0.0 => Err(self.error(Kind::OutOfRange, "", format!("{what} above zero"))),
            x if !within(x, UNITS) => Err(self.error(Kind::OutOfRange, "", format!("{what} {}", range(UNITS)))),
            _ => Ok(self),
        }
    }

    /// `what` of this value is `x`, within `limits`.
    pub(super) fn makes(&self, what: &str, x: f64, limits: (f64, f64), expected: &str) -> Result<(), ProblemError> {
        if within(x, limits) {
            return Ok(());
        }
        let note = format!(", which makes {what}{x:e}");
        Err(self.error(Kind::Combination, &note, format!("{expected} {}", range(limits))))
    }
}

pub(crate) fn within(value: f64, (low, high): (f64, f64)) -> bool {
    (low..=high).contains(&value)
}

pub(super) fn range((low, high): (f64, f64)) -> String {
    format!("between {low:e} and {high:e}")
}
