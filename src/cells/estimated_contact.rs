//! The closed form of the first contact in numbers with bounds, roundings of times included.

use super::bounds::bounded_piece;
use super::effort::MOST_DIGITS;
use super::uncertainty::{meant, within};
use crate::error::Error;
use crate::first_contact::{Bounce, ContactHistory, FirstContact};
use crate::motion::moments::Moments;
use crate::motion::{Contact, Course, Ending, Field, Motion, Pair, Scales, Side, StressPiece};
use crate::number::{Answer, Estimate, Rounded, Scalar};
use crate::problem::{Parameters, Problem, Run};
use crate::reason::Reason;
use crate::special::RoundedSpecial;

/// The damped rod with the paper's initial data, through its first contact: a [`ContactHistory`] whose answers include
/// the rounding of the time and the place.
///
/// **Units**: those of the problem.
///
/// **Accuracy**: *within its own bound*.
#[derive(Clone, Debug)]
pub(crate) struct EstimatedContact<S> {
    contact: ContactHistory<Estimate<S>>,
    course: Course<Estimate<S>>,
    error: S,
    /// Bound of a strain without a bound of its own.
    strain: f64,
}

/// Returns a time or a point with its bound, of at least one rounding.
fn rounded<S: Rounded>(x: &Estimate<S>) -> Estimate<S> {
    Estimate::new(x.value().clone(), x.error().max(x.to_f64().abs()))
}

impl<S: RoundedSpecial> EstimatedContact<S> {
    /// Solves the first contact of `problem`, which ends as `bounce` says.
    pub(crate) fn new(problem: &Problem, precision: &S::Precision, bounce: Bounce<Estimate<S>>) -> Result<Self, Error> {
        let asked = match problem.run() {
            Run::Time(time) => Some(S::from_number(time, precision).carry()),
            Run::Impacts(_) => None,
        };
        let contact = ContactHistory::new(FirstContact::new(&Parameters::of(problem, precision)?), bounce, asked)?;
        let known = contact.course().clone();
        let time_error = known.events.get(1).map_or(0.0, |release| release.t_error);
        let round_trip = Parameters::<S>::of(problem, precision)?.round_trip();
        let error = round_trip.double(17.0) * round_trip.roundoff() + round_trip.double(time_error) / &round_trip;
        let Scales { velocity, wave_speed, .. } = contact.scales().map(|scale| scale.to_f64());
        let strain = error.to_f64() * velocity / wave_speed;
        // The bound of a peak that is only approached does not fall with more bits.
        let bounded =
            |found: Contact<Estimate<S>>| Contact { peak_strain: within(found.peak_strain.value(), strain), ..found };
        let contacts = known.contacts.into_iter().map(bounded).collect();
        Ok(EstimatedContact { error, strain, course: Course { contacts, ..known }, contact })
    }

    /// Ends the run at the release, after which a march would need too many digits.
    pub(crate) fn without_flight(mut self) -> Self {
        if self.contact.rebound().is_some() && self.course.events.len() > 1 {
            self.course.ending = Ending::Undecided(Reason::MostDigits(MOST_DIGITS as u32));
        }
        self
    }

    /// Returns the time of the nearest event if `time` differs from it by roundings alone; otherwise `time`, rounded.
    fn time(&self, time: &Estimate<S>) -> Estimate<S> {
        rounded(meant(&self.course.events, time))
    }
}

impl<S: RoundedSpecial> Motion<Estimate<S>> for EstimatedContact<S> {
    fn course(&self) -> &Course<Estimate<S>> {
        &self.course
    }

    fn scales(&self) -> Scales<Estimate<S>> {
        self.contact.scales().map(|scale| within(scale.value(), 0.0))
    }

    fn stress_pieces(&self) -> Vec<StressPiece<Estimate<S>>> {
        let bounded = |piece: StressPiece<Estimate<S>>| {
            // The bounds at both ends of a piece stand for those between: they hardly change between rays.
            let own = |time: &Estimate<S>, side| {
                self.contact.strain(&time.value().carry(), side).map_or(0.0, |strain| strain.bound())
            };
            let strain = self.strain.max(own(&piece.start, Side::Right)).max(own(&piece.end, Side::Left));
            let (start, end) = (piece.start.clone(), piece.end.clone());
            StressPiece { start, end, ..bounded_piece(piece.map(Estimate::into_value), strain) }
        };
        self.contact.stress_pieces().into_iter().map(bounded).collect()
    }

    fn strain(&self, time: &Estimate<S>, side: Side) -> Result<Estimate<S>, Error> {
        self.contact.strain(&self.time(time), side)
    }

    fn pair(&self, pair: Pair, time: &Estimate<S>, side: Side) -> Result<[Estimate<S>; 2], Error> {
        self.contact.pair(pair, &self.time(time), side)
    }

    fn field(&self, point: &Estimate<S>, time: &Estimate<S>, side: Side) -> Result<Field<Estimate<S>>, Error> {
        self.contact.field(&rounded(point), &self.time(time), side)
    }

    fn moments(&self, time: &Estimate<S>, points: &[Estimate<S>]) -> Result<Vec<Moments<Estimate<S>>>, Error> {
        let points: Vec<_> = points.iter().map(rounded).collect();
        self.contact.moments(&self.time(time), &points)
    }

    fn rates(&self, places: &[(Estimate<S>, Estimate<S>)]) -> Result<Vec<[Estimate<S>; 2]>, Error> {
        let place = |(point, time): &(Estimate<S>, Estimate<S>)| (point.clone(), self.time(time));
        self.contact.rates(&places.iter().map(place).collect::<Vec<_>>())
    }

    fn highest(&self, release: usize) -> Option<(Estimate<S>, Estimate<S>)> {
        self.contact.highest(release)
    }

    fn error_estimate(&self) -> Estimate<S> {
        Estimate::exact(self.error.clone())
    }
}
