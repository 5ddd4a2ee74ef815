//! What a history lists, as columns of numbers by name.

use super::flight::flights;
use super::restitution::{energy_shares, restitution};
use super::unit::{Measure, Units};
use crate::error::Error;
use crate::motion::{Event, Motion};
use crate::number::Scalar;

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

/// Columns by name. What there is not, such as the end of a contact that lasts, is `None`.
pub type Columns<S> = Vec<(&'static str, Vec<Option<S>>)>;

fn columns<T, S, const N: usize>(
    list: impl IntoIterator<Item = T>,
    names: [&'static str; N],
    row: impl Fn(T) -> Result<[Option<S>; N], Error>,
) -> Result<Columns<S>, Error> {
    let mut columns = names.map(|name| (name, Vec::new()));
    for one in list {
        columns.iter_mut().zip(row(one)?).for_each(|((_, column), value)| column.push(value));
    }
    Ok(columns.into())
}

/// The columns of `table`, in units of the problem.
///
/// **Accuracy**: that of the history's answers, and a rounding for each factor of a unit.
///
/// **Errors**: what the history cannot answer.
pub fn table<S: Scalar>(motion: &dyn Motion<S>, table: Table, units: &Units) -> Result<Columns<S>, Error> {
    let measured = |measure, x: &S| units.factor::<S>(measure, &x.precision()).map(|factor| x.clone() * factor);
    let (events, contacts) = (motion.events(), motion.contacts());
    match table {
        Table::Events => {
            let row = |event: &Event<S>| Ok(event.numbers().map(|x| Some(x.clone())));
            columns(events, ["time", "end_velocity", "centre", "centre_velocity"], row)
        }
        Table::Contacts => {
            let names = ["from", "to", "impulse", "peak_strain", "peak_stress", "peak_force"];
            let mut columns = columns(contacts.iter().cloned(), names, |contact| {
                let [impulse, stress, force] = [
                    measured(Measure::Impulse, &contact.impulse),
                    measured(Measure::Stress, &contact.peak_strain),
                    measured(Measure::Force, &contact.peak_strain),
                ];
                Ok([Some(contact.from), contact.to, impulse, Some(contact.peak_strain), stress, force])
            })?;
            columns.truncate(if units.has_material() { 6 } else { 4 });
            Ok(columns)
        }
        Table::Restitution => {
            columns(contacts, ["momentum", "energy_squared", "translational_part", "energy_kept"], |contact| {
                let (e, shares) = (restitution(motion, contact)?, energy_shares(motion, contact)?);
                Ok([e.momentum.ok(), e.energy_squared.ok(), shares.translational, shares.kept])
            })
        }
        Table::Flights => columns(flights(motion)?, ["from", "to", "top_time", "top"], |flight| {
            let (time, height) = flight.highest.unzip();
            Ok([Some(flight.from), flight.to, time, height])
        }),
        Table::Stress => columns(motion.stress_pieces(), ["from", "to", "strain_from", "strain_to"], |piece| {
            Ok([piece.from, piece.to, piece.left, piece.right].map(Some))
        }),
    }
}
