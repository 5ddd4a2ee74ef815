//! Facts about a run that every output states beside its numbers.

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value as Json, json};

use super::table::{table_digits, wrapped};
use crate::terminal;
use dalembert::quantity::{Measure, Quantity, Units};
use dalembert::reason::Warning;
use dalembert::solve::ExactnessEnd;
use dalembert::{Ending, Value};

/// Facts about a run.
#[derive(Clone, Debug)]
pub(crate) struct RunInfo {
    pub(crate) title: Option<String>,
    /// The number system in words.
    pub(crate) number: String,
    pub(crate) effects: Vec<&'static str>,
    /// Digits of a long number; 0 for doubles and fractions.
    pub(crate) digits: u32,
    /// `c`, `t₁`, `R` and `M`.
    pub(crate) parameters: String,
    /// Whether a table may be wider than the page.
    pub(crate) wide: bool,
    pub(crate) units: Units,
    pub(crate) warnings: Vec<Warning>,
    /// The event or parameter that is no fraction, if a run in digits stands in for one in fractions.
    pub(crate) exact_until: Option<ExactnessEnd>,
}

impl RunInfo {
    /// Returns a number as a table shows it.
    pub(crate) fn text(&self, value: &Value) -> String {
        value.to_digits(table_digits(self.digits))
    }

    /// Returns a line of prose, wrapped where it is wider than the page.
    pub(super) fn line(&self, text: &str) -> String {
        if self.wide { format!("{text}\n") } else { wrapped(text, terminal::width(), "    ") + "\n" }
    }

    pub(super) fn warning_texts(&self) -> Vec<String> {
        self.warnings.iter().map(ToString::to_string).collect()
    }

    /// Returns the warnings, as they stand below a table.
    pub(super) fn warning_lines(&self) -> String {
        self.warnings.iter().map(|warning| self.line(&format!("warning: {warning}"))).collect()
    }

    /// Prints the warnings on standard error.
    pub(crate) fn print_warnings(&self) {
        self.warnings.iter().for_each(terminal::warn);
    }

    /// Returns the comments above a CSV.
    pub(super) fn notes(&self) -> Vec<String> {
        let end = self.exact_until.iter().map(|end| format!("{end}; the numbers are {}", self.number));
        end.chain(self.warnings.iter().map(|warning| format!("warning: {warning}"))).collect()
    }

    pub(super) fn exact_until_json(&self) -> Option<ExactUntil> {
        self.exact_until.as_ref().map(ExactUntil::from_end)
    }

    /// Returns the lines below a table of values of `quantities`: the end of exactness, units and warnings.
    pub(crate) fn below_values(&self, quantities: &[Quantity]) -> String {
        let end =
            self.exact_until.as_ref().map_or_else(String::new, |end| format!("{end}; these are {}\n", self.number));
        let measures: Vec<Measure> = quantities.iter().filter_map(|quantity| quantity.measure()).collect();
        let lines = end + &self.unit_line(&measures) + &self.warning_lines();
        if lines.is_empty() { lines } else { format!("\n{lines}") }
    }

    /// Returns the units that a scene does not name itself, in a line: `impulse in N s, energies in J`.
    pub(super) fn unit_line(&self, measures: &[Measure]) -> String {
        let text = |measure: &Measure| {
            let word = match measure {
                Measure::Impulse => "impulse",
                Measure::Energy => "energies",
                Measure::Stress | Measure::Force if self.units.has_material() => measure.name(),
                _ => return None,
            };
            match self.units.name(*measure) {
                "" => None,
                unit if unit.starts_with("per") => Some(format!("{word} {unit}")),
                unit => Some(format!("{word} in {unit}")),
            }
        };
        let mut texts: Vec<String> = measures.iter().filter_map(text).collect();
        texts.dedup();
        if texts.is_empty() { String::new() } else { texts.join(", ") + "\n" }
    }

    /// Returns the name of the unit of each measure, null if it is not known; impulse and energy are per `ρS` without a
    /// material.
    pub(super) fn units_json(&self) -> Map<String, Json> {
        use Measure::{Energy, Force, Impulse, Length, Stress, Time, Velocity};
        let measures = [Time, Length, Velocity, Stress, Force, Impulse, Energy];
        let name = |measure: Measure| Some(self.units.name(measure)).filter(|name| !name.is_empty());
        measures.iter().map(|measure| (measure.name().to_string(), json!(name(*measure)))).collect()
    }
}

/// The end of fractions: the event, its time as a surd and the nearest double; or the reason in words.
#[derive(Clone, Debug, Default, JsonSchema, Serialize)]
#[serde(rename = "exact_until")]
pub(super) struct ExactUntil {
    #[serde(skip_serializing_if = "Option::is_none")]
    event: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    surd: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    near: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
}

impl ExactUntil {
    /// Returns the event at which exactness ends; `None` for another ending.
    pub(super) fn new(ending: &Ending) -> Option<Self> {
        let Ending::ExactnessEnds { kind, time, near } = ending else { return None };
        let (event, surd, near) = (Some(kind.to_string()), Some(time.to_string()), Some(*near));
        Some(ExactUntil { event, surd, near, reason: None })
    }

    pub(super) fn from_end(end: &ExactnessEnd) -> Self {
        match end {
            ExactnessEnd::Event(ending) => ExactUntil::new(ending).unwrap_or_else(|| ExactUntil::from_reason(ending)),
            parameter => ExactUntil::from_reason(parameter),
        }
    }

    fn from_reason(reason: &impl ToString) -> Self {
        ExactUntil { reason: Some(reason.to_string()), ..ExactUntil::default() }
    }
}
