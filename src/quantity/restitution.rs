//! The coefficients of restitution of a contact, and how high a flight goes.

use std::iter::once;

use crate::error::Error;
use crate::motion::{EventKind, Motion, maps};
use crate::number::Scalar;

/// The coefficients of restitution `e_P` and `e_E²` of one contact, its end compared with its own beginning.
#[derive(Clone, Debug, PartialEq)]
pub struct Restitution<S> {
    /// `e_P = −P(release)/P(impact)`.
    pub e_p: Result<S, Undefined>,
    /// `e_E² = E_h(release)/E_h(impact)`.
    pub e_e2: Result<S, Undefined>,
}

/// The reason why a quantity of a contact or a flight is not defined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Undefined {
    /// The contact has no end.
    #[error("the contact does not end within this history")]
    Unfinished,
    /// The flight has no end.
    #[error("the flight does not end within this history")]
    Lasts,
    /// The centre of mass does not turn in free fall.
    #[error("the centre of mass does not turn in free fall in this flight")]
    NoTurn,
    /// The history ends before the centre of mass turns in free fall, if it does.
    #[error("the centre of mass does not turn in free fall within this history")]
    NotYet,
    /// A share of nothing.
    #[error("no energy to have a share of")]
    NoEnergy,
    /// The centre of mass stands still where the contact begins.
    #[error("the centre of mass has no momentum where the contact begins")]
    NoMomentum,
    /// The centre of mass can never come back to the height of an undeformed rod on the ground.
    #[error("E_h < 0 where the contact ends: the centre of mass never comes back to h = 0")]
    NegativeAfter,
    /// The energy ratio would compare with nothing, or with less.
    #[error("E_h ≤ 0 where the contact begins: nothing to compare with")]
    NotPositiveBefore,
}

maps!(pub(crate) Restitution {} maps e_p, e_e2);

impl<S> Restitution<S> {
    /// Returns every number in it.
    pub fn numbers(&self) -> Vec<&S> {
        self.e_p.iter().chain(&self.e_e2).collect()
    }
}

/// Computes the coefficients of restitution of the contact that begins at `from` and ends at `to`.
///
/// **Source**: section 4.1 and (4.71), with the state at the beginning of the contact for that at `t = 0`: the same for
/// the first contact. The datum of `E_h` is `h = 0`, the undeformed rod on the ground. `h` and `h′` are all that is
/// asked of the history.
///
/// **Accuracy**: *exact* for exact histories; otherwise that of `h` and `h′`. A momentum or an energy that is zero
/// within its bound counts as zero.
///
/// **Errors**: what the history cannot answer. A coefficient that is not defined has the reason in its place.
pub fn restitution<S: Scalar>(history: &dyn Motion<S>, (from, to): (&S, Option<&S>)) -> Result<Restitution<S>, Error> {
    let Some(to) = to else {
        return Ok(Restitution { e_p: Err(Undefined::Unfinished), e_e2: Err(Undefined::Unfinished) });
    };
    let (h0, rate0) = history.centre(from)?;
    let (h, rate) = history.centre(to)?;
    // E_h/L = h′²/2 + g h.
    let gravity = history.scales().gravity;
    let energy = |h: &S, rate: &S| rate.square() / rate.int(2) + gravity.clone() * h;
    let (before, after) = (energy(&h0, &rate0), energy(&h, &rate));
    let momentum = if rate0.vanishes()? { Err(Undefined::NoMomentum) } else { Ok(-(rate / &rate0)) };
    let energy_squared = if !before.positive()? {
        Err(Undefined::NotPositiveBefore)
    } else if after.negative()? {
        Err(Undefined::NegativeAfter)
    } else {
        Ok(after / before)
    };
    Ok(Restitution { e_p: momentum, e_e2: energy_squared })
}

/// Computes the factors of `e_E²` of the contact that begins at `from` and ends at `to`: `E_h(to)/E(to)`, what part of
/// the energy that is left moves the centre of mass, and `E(to)/E(from)`, what part damping leaves.
///
/// **Source**: (4.73). **Accuracy**: that of the energies. **Errors**: what the history cannot answer.
pub fn energy_shares<S: Scalar>(
    history: &dyn Motion<S>,
    (from, to): (&S, Option<&S>),
) -> Result<[Result<S, Undefined>; 2], Error> {
    let Some(to) = to else { return Ok([Err(Undefined::Unfinished), Err(Undefined::Unfinished)]) };
    let (before, after) = (history.energy(from)?, history.energy(to)?);
    let ratio = |part: &S, whole: &S| {
        Ok::<_, Error>(if whole.vanishes()? { Err(Undefined::NoEnergy) } else { Ok(part.clone() / whole) })
    };
    Ok([ratio(&after.translational, &after.total)?, ratio(&after.total, &before.total)?])
}

/// A flight of the rod.
#[derive(Clone, Debug, PartialEq)]
pub struct Flight<S> {
    /// Time at which it begins.
    pub takeoff: S,
    /// Time at which it ends; `None` where the history ends before.
    pub landing: Option<S>,
    /// `t*`, at which the centre of mass turns in free fall; `None` where it does not turn so in the flight.
    pub top_time: Option<S>,
    /// `h_max = h(t*)`, the height at which it turns.
    pub top: Option<S>,
}

maps!(pub(crate) Flight { takeoff } maps landing, top_time, top);

impl<S> Flight<S> {
    /// Returns every number in them.
    pub(crate) fn numbers(flights: &[Self]) -> Vec<&S> {
        let numbers = flights.iter().flat_map(|Flight { takeoff, landing, top_time, top }| {
            once(takeoff).chain(landing).chain(top_time).chain(top)
        });
        numbers.collect()
    }
}

/// Returns the flights of a history, in order.
///
/// **Source**: Remark 2, for every flight and not just the first.
///
/// **Accuracy**: *exact* for exact histories, otherwise that of `h` and `h′` at the release.
///
/// **Errors**: [`Error::NotDecided`] where it is not settled whether the centre of mass turns before the flight ends.
pub fn flights<S: Scalar>(history: &dyn Motion<S>) -> Result<Vec<Flight<S>>, Error> {
    let events = history.events();
    let end = history.end();
    let mut flights = Vec::new();
    for (k, release) in events.iter().enumerate().filter(|(_, event)| event.kind == EventKind::Release) {
        let landing = events.get(k + 1).map(|impact| impact.t.clone());
        let highest = match history.highest(k) {
            Some((time, _)) if landing.as_ref().unwrap_or(&end).below(&time)? => None,
            highest => highest,
        };
        let (top_time, top) = highest.unzip();
        flights.push(Flight { takeoff: release.t.clone(), landing, top_time, top });
    }
    Ok(flights)
}
