//! Sensitivity of the times of events to one value of a problem.

use crate::number::Scalar;
use crate::problem::{Parameter, Problem, Run};
use crate::quantity::Quantity;

/// Growth, from event to event, of a relative change of one value of a problem.
///
/// **Source**: the derivatives of the times of events.
///
/// **Accuracy**: *estimate*: the greater of both sides, and the mean growth from the first event to the last.
#[derive(Debug, serde::Serialize)]
pub struct Sensitivity {
    by: &'static str,
    /// Number of events in the measurement whose times depend on the value.
    events: usize,
    /// `|p ∂t/∂p|/t` of the last event.
    last: f64,
    /// Growth, in decimal digits for each event; zero if there is none.
    digits_per_event: f64,
}

/// Maximum number of contacts in the measurement.
const MEASURED: u32 = 10;

impl Sensitivity {
    /// Uses the first nonzero value of speed, gravity and length; `None` if fewer than two events have derivatives.
    pub fn of(problem: &Problem) -> Option<Self> {
        let known = |by: &Parameter| by.value_in::<f64>(problem, &()).is_ok_and(|value| value != 0.0);
        let by = [Parameter::ImpactSpeed, Parameter::Gravity, Parameter::Length].into_iter().find(known)?;
        let value = by.value_in::<f64>(problem, &()).ok()?;
        let (contacts, until) = match problem.run() {
            Run::Impacts(contacts) => ((*contacts).min(MEASURED), f64::INFINITY),
            Run::Time(time) => (MEASURED, time.to_f64()),
        };
        let history = problem.to_builder().impacts(contacts).build().ok()?.doubles().ok()?;
        let derivatives = history.derivatives(by, &[Quantity::EventTime]).ok()?;
        let mut found = Vec::new();
        for (event, row) in history.events().iter().zip(&derivatives).filter(|(event, _)| event.t <= until) {
            let sides = row[0].as_ref().map(|derivative| derivative.sides());
            let slopes = sides.into_iter().flatten().flatten().map(|slope| slope.value().abs());
            let most = slopes.fold(0.0, f64::max) * value.abs() / event.t;
            found.extend((event.t > 0.0 && most > 0.0).then_some(most));
        }
        let (first, last) = (*found.first()?, *found.last()?);
        let grown = (last / first).log10() / found.len().checked_sub(1).filter(|count| *count > 0)? as f64;
        Some(Sensitivity { by: by.name(), events: found.len(), last, digits_per_event: grown.max(0.0) })
    }
}

impl std::fmt::Display for Sensitivity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Sensitivity { by, events, last, digits_per_event } = self;
        let (last, digits) = (last.decimal(2), digits_per_event.decimal(2));
        write!(
            f,
            "1 % more {by} changes the time of the last of {events} events that depend on it by {last} %, to first \
             order: each event costs {digits} digits"
        )
    }
}
