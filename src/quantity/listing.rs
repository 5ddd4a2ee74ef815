//! Quantities of all events, contacts, flights and pieces of the stress: a list for each.

use super::flight::flights;
use super::restitution::{Undefined, energy_shares, restitution};
use super::table::{Quantity, Source};
use super::unit::Units;
use crate::error::Error;
use crate::motion::{EventKind, Motion};
use crate::number::Scalar;
use Quantity::*;

/// What a history lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Table {
    /// Impacts and releases: `time`, `end_velocity`, `centre`, `centre_velocity`.
    Events,
    /// Contacts: `from`, `to`, `impulse`, `peak_strain`; with a material `peak_stress` and `peak_force` too.
    Contacts,
    /// For each contact `e_P`, `e_E²` and its factors: `momentum`, `energy_squared`, `translational_part`,
    /// `energy_kept`.
    Restitution,
    /// Flights: `from`, `to`, and `top_time` and `top` where the centre of mass turns.
    Flights,
    /// `v_x(0,·)` piece by piece: `from`, `to`, `strain_from`, `strain_to`.
    Stress,
}

impl Table {
    /// Its columns.
    pub fn quantities(self) -> &'static [Quantity] {
        match self {
            Table::Events => &[EventTime, EventVelocity, EventCentre, EventCentreVelocity],
            Table::Contacts => &[Impact, Release, ContactImpulse, PeakStrain, PeakStress, PeakForce],
            Table::Restitution => &[MomentumRestitution, EnergyRestitution, TranslationalShare, EnergyKept],
            Table::Flights => &[FlightBegins, FlightEnds, TopTime, Top],
            Table::Stress => &[PieceBegins, PieceEnds, PieceStrainBegins, PieceStrainEnds],
        }
    }
}

/// Columns by name. What there is not, such as the end of a contact that lasts, is `None`.
pub type Columns<S> = Vec<(&'static str, Vec<Option<S>>)>;

/// The columns of `table`, in units of the problem.
///
/// **Accuracy**: that of the history's answers, and a rounding for each factor of a unit.
///
/// **Errors**: what the history cannot answer.
pub fn table<S: Scalar>(motion: &dyn Motion<S>, table: Table, units: &Units) -> Result<Columns<S>, Error> {
    let present = table.quantities().iter().copied().filter(|quantity| quantity.is_listed(units.has_material()));
    let present: Vec<Quantity> = present.collect();
    let rows = rows(motion, &present)?;
    let column = |(k, quantity): (usize, &Quantity)| {
        let factor = quantity.factor(&motion.scales(), units);
        let value = |row: &Row<S>| row.get(k)?.clone().ok().map(|value| quantity.scaled(value, factor.as_ref()));
        (quantity.key(), rows.iter().map(value).collect())
    };
    Ok(present.iter().enumerate().map(column).collect())
}

/// The values of quantities of one kind for each event, contact, flight or piece, as the history answers them, or why
/// there is none.
///
/// **Errors**: what the history cannot answer.
pub(crate) fn rows<S: Scalar>(motion: &dyn Motion<S>, quantities: &[Quantity]) -> Result<Vec<Row<S>>, Error> {
    let mut all: Vec<Row<S>> = Vec::new();
    let mut known: Option<(Source, Vec<Row<S>>)> = None;
    for quantity in quantities {
        let (source, place) = quantity.source();
        // Neighbours have one source.
        if known.as_ref().is_none_or(|known| known.0 != source) {
            known = Some((source, source.rows(motion, None)?));
        }
        let answers = known.iter().flat_map(|(_, rows)| rows);
        for (k, answer) in answers.enumerate() {
            if all.len() <= k {
                all.push(Vec::with_capacity(quantities.len()));
            }
            all[k].extend(answer.get(place).cloned());
        }
    }
    Ok(all)
}

/// The value of `quantity` of a contact or a flight, counted from 0, in units of the problem.
///
/// **Errors**: [`Error::NoContact`], and what the history cannot answer. What is not defined has the reason in its
/// place.
#[cfg(feature = "cli")]
pub(crate) fn of_contact<S: Scalar>(
    motion: &dyn Motion<S>,
    units: &Units,
    quantity: Quantity,
    contact: usize,
) -> Result<Result<S, Undefined>, Error> {
    let (source, place) = quantity.source();
    let row = source.rows(motion, Some(contact))?.pop().unwrap_or_default();
    let value = row.into_iter().nth(place).ok_or(Error::NoContact { contact, found: motion.contacts().len() })?;
    let factor = quantity.factor(&motion.scales(), units);
    Ok(value.map(|value| quantity.scaled(value, factor.as_ref())))
}

/// The answers to one question for one contact, event, flight or piece.
pub(crate) type Row<S> = Vec<Result<S, Undefined>>;

impl Source {
    /// Its answers for every contact, event, flight or piece; for the `only` one, counted from 0, where that is given.
    pub(super) fn rows<S: Scalar>(self, motion: &dyn Motion<S>, only: Option<usize>) -> Result<Vec<Row<S>>, Error> {
        let (skip, take) = only.map_or((0, usize::MAX), |only| (only, 1));
        let ok = |numbers: &[&S]| numbers.iter().map(|x| Ok((*x).clone())).collect::<Row<S>>();
        let contacts = || motion.contacts().iter().skip(skip).take(take);
        let unfinished = Undefined::Unfinished;
        // When one contact begins and ends is known without what happens in it.
        let times = || match only {
            Some(contact) => motion.contact_times(contact).into_iter().collect::<Vec<_>>(),
            None => motion.contacts().iter().map(|contact| (contact.from.clone(), contact.to.clone())).collect(),
        };
        Ok(match self {
            Source::Event => motion.events().iter().skip(skip).take(take).map(|event| ok(&event.numbers())).collect(),
            Source::Span => {
                let row = |(from, to): (S, Option<S>)| {
                    let to = to.ok_or(unfinished);
                    let length = to.clone().map(|to| to - &from);
                    vec![Ok(from), to, length]
                };
                times().into_iter().map(row).collect()
            }
            Source::Ends => {
                let of = |kind: EventKind, k: usize| {
                    let mut events = motion.events().iter().filter(|event| event.kind == kind);
                    events.nth(k).map(|event| event.end_velocity.clone()).ok_or(unfinished)
                };
                let ends = |(k, _)| vec![of(EventKind::Impact, skip + k), of(EventKind::Release, skip + k)];
                contacts().enumerate().map(ends).collect()
            }
            Source::Push => contacts().map(|contact| ok(&[&contact.impulse, &contact.peak_strain])).collect(),
            Source::Restitution => {
                let row = |(from, to): &(S, Option<S>)| {
                    restitution(motion, (from, to.as_ref())).map(|e| vec![e.momentum, e.energy_squared])
                };
                times().iter().map(row).collect::<Result<_, _>>()?
            }
            Source::Shares => {
                let row = |(from, to): &(S, Option<S>)| {
                    let shares = energy_shares(motion, (from, to.as_ref()))?;
                    let why = if to.is_none() { unfinished } else { Undefined::NoEnergy };
                    Ok::<_, Error>(vec![shares.translational.ok_or(why), shares.kept.ok_or(why)])
                };
                times().iter().map(row).collect::<Result<_, _>>()?
            }
            Source::Left => {
                let row = |(_, to): &(S, Option<S>)| match to {
                    Some(to) => motion.energy(to).map(|energy| ok(&energy.numbers())),
                    None => Ok(vec![Err(unfinished); 3]),
                };
                times().iter().map(row).collect::<Result<_, _>>()?
            }
            Source::Flight => {
                let row = |flight: super::Flight<S>| {
                    let (time, top) = flight.highest.unzip();
                    let turns = |x: Option<S>| x.ok_or(Undefined::NoTurn);
                    vec![Ok(flight.from), flight.to.ok_or(Undefined::Lasts), turns(time), turns(top)]
                };
                flights(motion)?.into_iter().skip(skip).take(take).map(row).collect()
            }
            Source::Piece => {
                let pieces = motion.stress_pieces().into_iter().skip(skip).take(take);
                pieces.map(|piece| ok(&[&piece.from, &piece.to, &piece.left, &piece.right])).collect()
            }
            _ => Vec::new(),
        })
    }
}
