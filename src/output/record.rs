//! What is printed, as plain data: gathered once from the history, formatted in several ways.

use serde_json::{Value, json};

use super::writer::{WIDTH, wrapped};
use crate::error::Error;
use crate::motion::{Contact, Ending, Energy, Event, Motion, StressPiece};
use crate::number::Scalar;
use crate::quantity::{EnergyShares, Flight, Restitution, Undefined, Units, energy_shares, flights, restitution};
use crate::reason::Warning;
use crate::solve::ExactnessEnd;

/// What stands above the numbers.
#[derive(Clone, Debug, Default)]
pub struct Head {
    /// The title of the scene.
    pub title: Option<String>,
    /// The number system in words.
    pub number: String,
    /// The effects that the scene calls for.
    pub effects: Vec<&'static str>,
    /// Digits that a `Float` shows.
    pub digits: u32,
    /// `c`, `t₁`, `R` and `M`.
    pub parameters: String,
    /// Whether a table may be wider than 80 characters.
    pub wide: bool,
    /// What gives strains and values per `ρS` a unit.
    pub units: Units,
    /// What the user should know.
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

    /// A line for each warning.
    pub(super) fn warning_lines(&self) -> String {
        self.warnings.iter().map(|warning| self.line(&format!("warning: {warning}"))).collect()
    }

    /// What the numbers do not say.
    pub(super) fn notes(&self) -> Vec<String> {
        let end = self.exact_until.iter().map(|end| format!("{end}; the numbers are {}", self.number));
        end.chain(self.warnings.iter().map(|warning| format!("warning: {warning}"))).collect()
    }

    /// Where fractions ended.
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

/// A contact, its coefficients, and the energies at its end if it has one.
#[derive(Clone, Debug)]
pub struct Finished<S> {
    /// The contact.
    pub contact: Contact<S>,
    /// `e_P` and `e_E²`.
    pub restitution: Restitution<S>,
    /// The factors of `e_E²`.
    pub shares: EnergyShares<S>,
    /// The energies at its end.
    pub energy: Option<Energy<S>>,
}

impl<S> Finished<S> {
    /// Why `e_P` and `e_E²` are not defined, where they are not.
    pub(super) fn undefined(&self) -> [Option<&Undefined>; 2] {
        let Restitution { momentum, energy_squared } = &self.restitution;
        [momentum.as_ref().err(), energy_squared.as_ref().err()]
    }
}

/// A history, ready to be printed.
#[derive(Clone, Debug)]
pub struct Record<S> {
    /// Impacts and releases.
    pub events: Vec<Event<S>>,
    /// Contacts with their coefficients and the energies at their ends.
    pub contacts: Vec<Finished<S>>,
    /// Flights with their tops.
    pub flights: Vec<Flight<S>>,
    /// The stress at the ground, where it is asked for.
    pub stress: Vec<StressPiece<S>>,
    /// The stress at the ground in equal parts of the history, where a line of blocks shows it.
    pub outline: Vec<f64>,
    /// The last time that is known, and why.
    pub end: (S, Ending),
    /// Bound on the error relative to the natural scales; zero where all is exact.
    pub error: f64,
    /// Impacts, and the digits that rounding may have taken over them; `None` where that is not followed.
    pub lost: Option<(u32, f64)>,
}

impl<S> Record<S> {
    /// Every number that is printed, with or without those that are ratios of others.
    pub fn numbers(&self, ratios: bool) -> Vec<&S> {
        let mut all = vec![&self.end.0];
        all.extend(self.events.iter().flat_map(Event::numbers));
        for Finished { contact, restitution, shares, energy } in &self.contacts {
            all.extend(contact.numbers());
            if ratios {
                all.extend(restitution.numbers());
                all.extend(shares.numbers());
            }
            all.extend(energy.iter().flat_map(Energy::numbers));
        }
        all.extend(self.flights.iter().flat_map(Flight::numbers));
        all.extend(self.stress.iter().flat_map(|piece| [&piece.from, &piece.to, &piece.left, &piece.right]));
        all
    }
}

/// Gathers what is printed of `history`; the stress at the ground only if asked for, as it can cost more than all the
/// rest.
pub fn record<S: Scalar>(history: &dyn Motion<S>, stress: bool) -> Result<Record<S>, Error> {
    let end = history.end();
    let mut contacts = Vec::with_capacity(history.contacts().len());
    for contact in history.contacts() {
        contacts.push(Finished {
            energy: contact.to.as_ref().map(|to| history.energy(to)).transpose()?,
            restitution: restitution(history, contact.times())?,
            shares: energy_shares(history, contact.times())?,
            contact: contact.clone(),
        });
    }
    Ok(Record {
        events: history.events().to_vec(),
        contacts,
        flights: flights(history)?,
        stress: if stress { history.stress_pieces() } else { Vec::new() },
        outline: Vec::new(),
        end: (end, history.ending().clone()),
        error: history.error_estimate().to_f64(),
        lost: history.digits_lost(),
    })
}
