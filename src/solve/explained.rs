//! A plan in sentences: its reasons, its limits and its reach.

use super::plan::{CellLimits, Climb, DEFAULT_ACCURACY, Engine, Goal, MOST_PROVED, Plan, Reach};
use super::question::Numbers;
use super::rung::FEWEST_BITS;

impl Plan {
    /// Returns the reasons for this engine and these numbers, one sentence each.
    pub fn reasons(&self) -> Vec<String> {
        let engine = match self.engine {
            Engine::Lattice => "without damping the solution travels unchanged along its characteristics",
            Engine::ClosedForm => {
                "damping couples the characteristics; the first contact has a closed form, and no more is asked for"
            }
            Engine::Chain => "without damping waves travel unchanged through each body, and all happens at its ends",
            Engine::Cells => {
                "damping couples the characteristics: inside a cell between rays Riemann's formula converges \
                 geometrically"
            }
        };
        let numbers = match self.numbers {
            Numbers::Double(accuracy) => {
                let exactly = match self.engine {
                    Engine::Lattice | Engine::Chain => {
                        "; exact ones where an event and a ray coincide within their bounds"
                    }
                    _ if self.cells.is_some() => {
                        "; those and a proof where bounds leave open what happens at the ground"
                    }
                    _ => "",
                };
                format!(
                    "doubles with an error bound; longer numbers where the bound is above {:e} of the greatest number \
                     of an answer{exactly}",
                    accuracy.unwrap_or(DEFAULT_ACCURACY)
                )
            }
            Numbers::Digits(digits) => {
                let proved = match self.cells {
                    Some(_) => format!("; the run is proved, up to {MOST_PROVED} bits and where nothing stays open"),
                    None => String::new(),
                };
                format!("{digits} digits are asked for: bits are added until the error bound leaves that many{proved}")
            }
            Numbers::Certified(digits) => format!(
                "{digits} proved digits are asked for: enclosures, with bits added until every comparison is settled \
                 and every digit known"
            ),
            Numbers::Exact => "fractions are asked for: the run stops where a root is irrational".into(),
            Numbers::ExactThenDigits(digits) => {
                format!("fractions are asked for, and {digits} digits of the whole run where they end")
            }
        };
        let mut reasons = vec![engine.to_string(), numbers];
        if self.foreseen_loss >= 1.0 {
            reasons.push(format!(
                "rounding at the impacts is foreseen to take {:.0} digits, and as many more are carried",
                self.foreseen_loss
            ));
        }
        reasons
    }

    /// Returns the limits of the plan, one sentence each.
    pub fn limits(&self) -> Vec<String> {
        let mut limits = Vec::new();
        let Goal { digits, spare, .. } = self.goal;
        if digits > 0.0 {
            limits.push(format!(
                "a number is settled at {digits:.0} digits, or at {:.0} below the greatest of its answer",
                digits + spare
            ));
        }
        let Climb { bits, most_bits, most_enclosed, exact_contacts, .. } = self.climb;
        if let Some(contacts) = exact_contacts.filter(|_| matches!(self.numbers, Numbers::Double(_))) {
            limits.push(format!("exact numbers decide meetings of events through {contacts} contacts"));
        }
        limits.push(match bits <= most_bits {
            true => format!("longer numbers have {bits} to {most_bits} bits, enclosures up to {most_enclosed}"),
            false => "no longer numbers than doubles".into(),
        });
        if let Some(CellLimits { double_digits, double_cells, long_cells, most_digits }) = self.cells {
            let long = long_cells.map_or(String::new(), |cells| format!(", {cells} in {FEWEST_BITS} bits"));
            limits.push(format!(
                "cells: {double_digits} digits and {double_cells} cells in doubles{long}; none beyond {most_digits} \
                 digits"
            ));
        }
        limits
    }
}

impl std::fmt::Display for Reach {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Reach::Contacts(1) => f.write_str("through the first contact and the flight after it"),
            Reach::Contacts(contacts) => write!(f, "through {contacts} contacts and the flight after the last"),
            Reach::FirstContact => f.write_str("to the end of the first contact"),
            Reach::Time(time) => write!(f, "to t = {time}"),
        }
    }
}
