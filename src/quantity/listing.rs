//! Quantities of all events, contacts, flights and pieces of the stress: a list for each.

use std::iter::repeat;

use super::restitution::{Undefined, energy_shares, flights, restitution};
use super::table::{Needs, Quantity, Source};
use super::unit::Units;
use crate::error::Error;
use crate::motion::{Contact, Ending, EventKind, Motion};
use crate::number::Scalar;

/// A table that a history lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Table {
    /// Impacts and releases: `t`, `v_end`, `h`, `h_rate`.
    Events,
    /// Contacts: `impact`, `release`, `duration`, velocities of the end, `impulse`, `peak_strain`, coefficients of
    /// restitution, energies at the release; with a material `peak_stress` and `peak_force` too.
    Contacts,
    /// Flights: `takeoff`, `landing`, and `top_time` and `top` where the centre of mass turns.
    Flights,
    /// `v_x(0,·)` piece by piece: `start`, `end`, `strain_start`, `strain_end`; with a material `stress_start` and
    /// `stress_end` too.
    Stress,
}

impl Table {
    /// Returns the columns, in their order.
    pub fn quantities(self) -> &'static [Quantity] {
        let needs = match self {
            Table::Events => Needs::Event,
            Table::Contacts => Needs::Contact,
            Table::Flights => Needs::Flight,
            Table::Stress => Needs::Piece,
        };
        needs.all()
    }
}

/// Returns the values of `quantities` of one kind for each event, contact, flight or piece, in units of the problem;
/// `None` where there is none.
pub(crate) fn values<S: Scalar>(
    motion: &dyn Motion<S>,
    quantities: &[Quantity],
    units: &Units,
) -> Result<Vec<Vec<Option<S>>>, Error> {
    let value = |(value, quantity): (Result<S, Undefined>, &Quantity)| {
        Some(quantity.in_unit(value.ok()?, &motion.scales(), units))
    };
    Ok(rows(motion, quantities)?.into_iter().map(|row| row.into_iter().zip(quantities).map(value).collect()).collect())
}

/// Returns the values of quantities of one kind for each event, contact, flight or piece, without a unit, or the reason
/// why there is none.
pub fn rows<S: Scalar>(motion: &dyn Motion<S>, quantities: &[Quantity]) -> Result<Vec<Row<S>>, Error> {
    let mut all: Vec<Row<S>> = Vec::new();
    // Neighbours have one source.
    for quantities in quantities.chunk_by(|a, b| a.source().0 == b.source().0) {
        let rows = quantities[0].source().0.rows(motion)?;
        all.resize_with(all.len().max(rows.len()), || Vec::with_capacity(quantities.len()));
        for (row, answers) in all.iter_mut().zip(rows) {
            row.extend(quantities.iter().filter_map(|quantity| answers.get(quantity.source().1).cloned()));
        }
    }
    Ok(all)
}

/// Returns the value of `quantity` of a contact or a flight, counted from 0, in units of the problem, or the reason why
/// there is none.
pub fn contact_value<S: Scalar>(
    motion: &dyn Motion<S>,
    units: &Units,
    quantity: Quantity,
    contact: usize,
) -> Result<Result<S, Undefined>, Error> {
    let (source, place) = quantity.source();
    let row = match (source, motion.contact_times(contact)) {
        // When it begins and ends is known without what happens in it.
        (Source::Span | Source::Restitution | Source::Shares | Source::Left, Some((from, to))) => {
            Some(source.of_times(motion, &from, to.as_ref())?)
        }
        (Source::Span | Source::Restitution | Source::Shares | Source::Left, None) => None,
        _ => source.rows(motion)?.into_iter().nth(contact),
    };
    let value = row.and_then(|row| row.into_iter().nth(place));
    let value = value.ok_or(Error::NoContact { contact, found: motion.contacts().len() })?;
    Ok(value.map(|value| quantity.in_unit(value, &motion.scales(), units)))
}

/// Answers of one source for one contact, event, flight or piece.
pub type Row<S> = Vec<Result<S, Undefined>>;

impl Source {
    /// Returns the answers for every contact, event, flight or piece.
    fn rows<S: Scalar>(self, motion: &dyn Motion<S>) -> Result<Vec<Row<S>>, Error> {
        Ok(match self {
            Source::Event => motion.events().iter().map(|event| known(&event.numbers())).collect(),
            Source::Ends => {
                let velocities = |kind: EventKind| {
                    let events = motion.events().iter().filter(move |event| event.kind == kind);
                    events.map(|event| Ok(event.v_end.clone())).chain(repeat(Err(Undefined::Unfinished)))
                };
                let ends = velocities(EventKind::Impact).zip(velocities(EventKind::Release));
                ends.take(motion.contacts().len()).map(|(impact, release)| vec![impact, release]).collect()
            }
            Source::Push => {
                // A contact that lasts is counted up to the requested time, not to where a run happens to stop.
                let counted = |end: &Option<S>| end.is_some() || *motion.ending() == Ending::Time;
                let push = |contact: &Contact<S>| match counted(&contact.release) {
                    true => known(&[&contact.impulse, &contact.peak_strain]),
                    false => vec![Err(Undefined::Unfinished), Err(Undefined::Unfinished)],
                };
                motion.contacts().iter().map(push).collect()
            }
            Source::Flight => flights(motion)?
                .into_iter()
                .map(|flight| {
                    let reason = if flight.landing.is_some() { Undefined::NoTurn } else { Undefined::NotYet };
                    let turns = |x: Option<S>| x.ok_or(reason);
                    vec![
                        Ok(flight.takeoff),
                        flight.landing.ok_or(Undefined::Lasts),
                        turns(flight.top_time),
                        turns(flight.top),
                    ]
                })
                .collect(),
            Source::Piece => motion
                .stress_pieces()
                .iter()
                .map(|piece| known(&[&piece.start, &piece.end, &piece.strain_start, &piece.strain_end]))
                .collect(),
            Source::Span | Source::Restitution | Source::Shares | Source::Left => motion
                .contacts()
                .iter()
                .map(|contact| self.of_times(motion, &contact.impact, contact.release.as_ref()))
                .collect::<Result<Vec<_>, _>>()?,
            _ => Vec::new(),
        })
    }

    /// Returns the answers for the contact from one time to another.
    fn of_times<S: Scalar>(self, motion: &dyn Motion<S>, from: &S, to: Option<&S>) -> Result<Row<S>, Error> {
        let unfinished = Undefined::Unfinished;
        Ok(match (self, to) {
            (Source::Restitution, _) => {
                let found = restitution(motion, (from, to))?;
                vec![found.e_p, found.e_e2]
            }
            (Source::Shares, _) => energy_shares(motion, (from, to))?.into(),
            (Source::Left, Some(to)) => known(&motion.energy(to)?.numbers()),
            (Source::Left, None) => vec![Err(unfinished), Err(unfinished), Err(unfinished)],
            (_, Some(to)) => vec![Ok(from.clone()), Ok(to.clone()), Ok(to.clone() - from)],
            (_, None) => vec![Ok(from.clone()), Err(unfinished), Err(unfinished)],
        })
    }
}

fn known<S: Clone>(numbers: &[&S]) -> Row<S> {
    numbers.iter().map(|number| Ok((*number).clone())).collect()
}
