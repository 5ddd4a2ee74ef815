//! What is printed, as plain data: gathered once from the history, formatted in several ways.

use serde_json::{Value, json};

use super::dataset::{Dataset, Shared};
use super::table::{WIDTH, wrapped};
use dalembert::Ending;
use dalembert::problem::Parameter;
use dalembert::quantity::{Undefined, Units};
use dalembert::reason::Warning;
use dalembert::solve::{Derivatives, ExactnessEnd};

/// What stands above the numbers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Head {
    pub title: Option<String>,
    /// The number system in words.
    pub number: String,
    pub effects: Vec<&'static str>,
    /// Digits that a `Float` shows.
    pub digits: u32,
    /// `c`, `t₁`, `R` and `M`.
    pub parameters: String,
    /// Whether a table may be wider than 80 characters.
    pub wide: bool,
    /// What gives strains and values per `ρS` a unit.
    pub units: Units,
    pub warnings: Vec<Warning>,
    /// What fractions could not hold, if a run in digits stands in for them.
    pub exact_until: Option<ExactnessEnd>,
}

impl Head {
    /// A line of prose, in several where it is wider than a table may be.
    pub(super) fn line(&self, text: &str) -> String {
        if self.wide { format!("{text}\n") } else { wrapped(text, WIDTH, "    ") + "\n" }
    }

    pub(super) fn warning_texts(&self) -> Vec<String> {
        self.warnings.iter().map(ToString::to_string).collect()
    }

    pub(super) fn warning_lines(&self) -> String {
        self.warnings.iter().map(|warning| self.line(&format!("warning: {warning}"))).collect::<Vec<_>>().concat()
    }

    pub(super) fn notes(&self) -> Vec<String> {
        let end = self.exact_until.iter().map(|end| format!("{end}; the numbers are {}", self.number));
        end.chain(self.warnings.iter().map(|warning| format!("warning: {warning}"))).collect()
    }

    pub(super) fn exact_until_json(&self) -> Value {
        match &self.exact_until {
            None => Value::Null,
            Some(ExactnessEnd::Event(Ending::ExactnessEnds { kind, time, near })) => {
                json!({"event": kind, "surd": time, "near": near})
            }
            Some(ExactnessEnd::Event(other)) => json!({"reason": other.to_string()}),
            Some(parameter) => json!({"reason": parameter.to_string()}),
        }
    }
}

pub(crate) struct Derived {
    pub(crate) by: Parameter,
    pub(crate) events: Derivatives<Shared>,
    pub(crate) contacts: Derivatives<Shared>,
}

/// A history, ready to be printed, whatever its numbers.
pub(crate) struct Record {
    pub(super) events: Dataset,
    /// Contacts with their coefficients and the energies at their ends.
    pub(super) contacts: Dataset,
    /// Why `e_P` and `e_E²` of each contact are not defined, where they are not.
    pub(super) undefined: Vec<[Option<Undefined>; 2]>,
    pub(super) flights: Dataset,
    pub(super) derivatives: Vec<Derived>,
    /// The stress at the ground, where it is asked for.
    pub(super) stress: Dataset,
    /// Whether a piece of it is curved.
    pub(super) curved: bool,
    /// The stress at the ground in equal parts of the history, where a line of blocks shows it.
    pub(crate) outline: Vec<f64>,
    /// The last time that is known, and why.
    pub(crate) end: (Shared, Ending),
    /// Bound on the error relative to the natural scales; zero where all is exact.
    pub(super) error: f64,
    /// Impacts, and the digits that rounding may have taken over them; `None` where that is not followed.
    pub(super) lost: Option<(u32, f64)>,
}
