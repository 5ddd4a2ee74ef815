//! Query for one value of a motion: of the run, of its first contact, or at a time.

use super::column::{columns, values_at};
use super::listing::contact_value;
use super::restitution::Undefined;
use super::table::{Needs, Quantity};
use super::unit::Units;
use crate::error::Error;
use crate::motion::{Ending, EventKind, Motion, Side};
use crate::number::{Number, Scalar};
use crate::problem::Run;

/// Query for one value: a quantity with its place and time.
#[derive(Clone, Debug)]
pub struct ValueQuery {
    /// The quantity.
    pub quantity: Quantity,
    /// `x`, for a quantity along the rod.
    pub point: Option<Number>,
    /// `t`, for a quantity at a time; `None` stands for the end of the first contact. For the impact and the release of
    /// a contact, a time next to it; `None` stands for the first contact.
    pub time: Option<Number>,
    /// The limit, where a value jumps.
    pub side: Side,
}

/// The reason why there is no number.
#[derive(Clone, Debug, PartialEq)]
pub struct Missing {
    /// Whether the bounds leave it undecided.
    pub open: bool,
    /// The reason, as it is printed.
    pub why: String,
}

impl Missing {
    /// Builds the reason for a number that is known not to exist.
    pub fn none(why: impl std::fmt::Display) -> Self {
        Missing { open: false, why: why.to_string() }
    }
}

/// Largest distance of an event from the time that it is asked next to.
const NEXT: f64 = 0.25;

impl Quantity {
    /// Returns every quantity that is one value of a run, each name once.
    pub fn singles() -> impl Iterator<Item = Quantity> {
        let all =
            [Needs::FirstContact, Needs::Contact, Needs::Time, Needs::Run].into_iter().flat_map(Needs::quantities);
        all.filter(|quantity| {
            let over_time = quantity.needs() == Needs::Contact && Needs::Time.named(quantity.name()).is_some();
            !over_time && !matches!(quantity, Quantity::Time | Quantity::Side)
        })
    }

    /// Returns the quantity of this name, or of this other name, among [`Quantity::singles`].
    pub fn single(name: &str) -> Option<Quantity> {
        let named = Quantity::singles().find(|quantity| quantity.name() == name);
        named.or_else(|| Quantity::singles().find(|quantity| quantity.also().contains(&name)))
    }
}

impl ValueQuery {
    /// Builds the query for `quantity`, at `time` if it depends on time.
    pub fn new(quantity: Quantity, time: Option<Number>) -> Self {
        ValueQuery { quantity, point: None, time, side: Side::Right }
    }

    /// Returns the value in units of the problem, whose run is `run`, and the same value without a unit; or the reason
    /// why there is none.
    pub fn evaluate<S: Scalar>(
        &self,
        motion: &dyn Motion<S>,
        units: &Units,
        run: &Run,
    ) -> Result<Result<[S; 2], Missing>, Error> {
        let ended = || Missing { open: motion.ending().is_open(), why: motion.ending().to_string() };
        let bounce = || motion.contact_times(0).and_then(|(_, to)| to).ok_or_else(ended);
        let event = |kind, near| event_near(motion, kind, near).ok_or_else(ended);
        let lift = |number: &Number| S::spelling(number, &motion.end().precision());
        let near = self.time.as_ref().map(Number::to_f64);
        let found = match (self.quantity, near, self.quantity.needs()) {
            (Quantity::BounceTime, ..) => bounce(),
            (Quantity::Impact, Some(near), _) => event(EventKind::Impact, near),
            (Quantity::Release, Some(near), _) => event(EventKind::Release, near),
            (Quantity::LastEvent, ..) => match (motion.ending(), motion.events().last()) {
                // The last event before an open question is not the last of the run.
                (Ending::Undecided(_) | Ending::ExactnessEnds { .. } | Ending::Unproved { .. }, _) => Err(ended()),
                (Ending::Bounce, _) if *run != Run::Impacts(1) => Err(ended()),
                (_, None) => Err(Missing::none("nothing happens in it")),
                (_, Some(last)) => Ok(last.t.clone()),
            },
            (Quantity::ShortestPiece, ..) => {
                let lengths = motion.stress_pieces().into_iter().map(|piece| piece.end - &piece.start);
                lengths.min_by(|a, b| a.to_f64().total_cmp(&b.to_f64())).ok_or_else(ended)
            }
            (quantity, _, Needs::Contact | Needs::Flight) => match contact_value(motion, units, quantity, 0) {
                Err(Error::NoContact { .. }) | Ok(Err(Undefined::Unfinished | Undefined::Lasts)) => Err(ended()),
                found => found?.map_err(Missing::none),
            },
            (quantity, _, needs) => {
                let time = match &self.time {
                    Some(time) => Ok(lift(time)),
                    None => bounce(),
                };
                let answer = |time: S| match (needs, &self.point) {
                    (Needs::PointAndTime, Some(point)) => {
                        values_at(motion, units, &[quantity], (&lift(point), &time), self.side)
                            .map(|mut row| row.remove(0))
                    }
                    _ => {
                        columns(motion, units, &[quantity], &[time], Some(self.side)).map(|mut t| t.remove(0).remove(0))
                    }
                };
                match time.map(answer) {
                    Ok(Err(Error::TimeOutside { .. })) => Err(ended()),
                    Ok(found) => Ok(found?),
                    Err(missing) => Err(missing),
                }
            }
        };
        Ok(found.map(|value| match self.quantity.factor(&motion.scales(), units) {
            Some(factor) => [value.clone(), value / factor],
            None => [value.clone(), value],
        }))
    }
}

/// Returns the time of the event of this kind that is next to a time, if one is.
fn event_near<S: Scalar>(motion: &dyn Motion<S>, kind: EventKind, near: f64) -> Option<S> {
    let apart = |time: &S| (time.to_f64() - near).abs();
    let of_kind = motion.events().iter().filter(|event| event.kind == kind).map(|event| event.t.clone());
    of_kind.filter(|time| apart(time) < NEXT).min_by(|a, b| apart(a).total_cmp(&apart(b)))
}
