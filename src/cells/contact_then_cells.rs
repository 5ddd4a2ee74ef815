//! The paper's rod from the first contact on: closed form during the contact, cells after it.

use super::bounds::bounded_piece;
use super::effort::{Effort, MOST_DIGITS, Task};
use super::history::Damped;
use super::uncertainty::{meant, within};
use crate::error::Error;
use crate::first_contact::{Bounce, ContactHistory, FirstContact};
use crate::motion::moments::Moments;
use crate::motion::{Contact, Course, Ending, Field, Motion, Pair, Scales, Side, StressPiece, unobserved};
use crate::number::{Answer, Estimate, Rounded, Scalar};
use crate::problem::{Parameters, Problem, Run};
use crate::reason::Reason;
use crate::special::RoundedSpecial;

/// The damped rod with the paper's initial data, through any number of impacts: [`ContactHistory`] during the first
/// contact, [`Damped`] from the bounce on.
///
/// **Source**: Theorem 1 and the closed forms of section 3 until `t_b`; the characteristic cells of `cells`
/// after it.
///
/// **Units**: those of the problem.
///
/// **Accuracy**: *within its own bound*.
#[derive(Clone, Debug)]
pub struct ContactThenCells<S> {
    contact: ContactHistory<Estimate<S>>,
    march: Option<Damped<S>>,
    course: Course<Estimate<S>>,
    error: S,
    /// Bound of a strain of the first contact without a bound of its own.
    strain: f64,
}

/// The solution valid at a time, and the time to query it at.
type Part<'a, S> = (&'a dyn Motion<Estimate<S>>, Estimate<S>);

/// Returns a time or a point with its bound, of at least one rounding.
fn rounded<S: Rounded>(x: &Estimate<S>) -> Estimate<S> {
    Estimate::new(x.value().clone(), x.error().max(x.to_f64().abs()))
}

impl<S: RoundedSpecial> ContactThenCells<S> {
    /// Solves `problem`, whose first contact ends as `bounce` says, to about `digits` decimal digits of the natural
    /// scales.
    ///
    /// **Errors**: those of [`Damped::solve`].
    pub fn solve(
        problem: &Problem,
        precision: &S::Precision,
        digits: f64,
        bounce: Bounce<Estimate<S>>,
    ) -> Result<Self, Error> {
        Self::march(&Task { problem, precision, effort: Effort::of(digits), observe: &unobserved }, bounce, None)
    }

    /// Solves a `task` in the same way; `rate` is a better value of `h′` at the bounce, if known.
    pub(crate) fn march(
        task: &Task<'_, S>,
        bounce: Bounce<Estimate<S>>,
        rate: Option<Estimate<S>>,
    ) -> Result<Self, Error> {
        let mut history = Self::first_contact(task.problem, task.precision, bounce)?;
        history.follow(task, rate)?;
        Ok(history)
    }

    /// Solves the first contact alone, without a flight.
    pub(crate) fn first_contact(
        problem: &Problem,
        precision: &S::Precision,
        bounce: Bounce<Estimate<S>>,
    ) -> Result<Self, Error> {
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
        let course = Course { contacts, ..known };
        Ok(ContactThenCells { error, strain, march: None, course, contact })
    }

    /// Appends the flight and all later motion, from the cells.
    fn follow(&mut self, task: &Task<'_, S>, rate: Option<Estimate<S>>) -> Result<(), Error> {
        let (Some(rebound), Some(release)) = (self.contact.rebound(), self.course.events.get(1)) else { return Ok(()) };
        if task.effort.digits > MOST_DIGITS {
            self.course.ending = Ending::Undecided(Reason::MostDigits(MOST_DIGITS as u32));
            return Ok(());
        }
        let release = (release.t.value(), release.t_error, release.v_end.value());
        // The cells account for the roundings of the parameters themselves.
        let form = FirstContact::new(&Parameters::<S>::of(task.problem, task.precision)?.carry());
        let rate = rate.unwrap_or_else(|| rebound.velocity.clone());
        let mut march = Damped::after_bounce(task, &form, release, &rate)?;
        march.rebound = Some(rebound.clone());
        let Course { end, ending, events, contacts, warnings } = march.course().clone();
        self.course.events.extend(events.into_iter().skip(1));
        self.course.contacts.extend(contacts);
        let error = march.error_estimate().into_value();
        if error > self.error {
            self.error = error;
        }
        self.course = Course { end, ending, warnings, ..self.course.clone() };
        self.march = Some(march);
        Ok(())
    }

    /// Returns `t_b`.
    fn bounce(&self) -> Option<&S> {
        self.contact.events().get(1).map(|release| release.t.value())
    }

    /// Returns the cells if they are valid at `time`; the closed form includes the bounce itself.
    ///
    /// **Errors**: [`Error::TimeOutside`].
    fn later(&self, time: &Estimate<S>) -> Result<Option<&Damped<S>>, Error> {
        let time = time.value();
        if time.is_negative() || time > self.course.end.value() || !time.is_finite() {
            return Err(Error::TimeOutside { found: time.text(), end: self.course.end.text() });
        }
        Ok(self.march.as_ref().filter(|_| self.bounce().is_some_and(|bounce| time > bounce)))
    }

    /// Returns the solution valid at a time, and the time to query it at.
    fn part(&self, time: &Estimate<S>) -> Result<Part<'_, S>, Error> {
        let time = meant(&self.course.events, time);
        Ok(match self.later(time)? {
            Some(march) => (march, time.clone()),
            None => (&self.contact, rounded(time)),
        })
    }
}

impl<S: RoundedSpecial> Motion<Estimate<S>> for ContactThenCells<S> {
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
        let mut pieces: Vec<_> = self.contact.stress_pieces().into_iter().map(bounded).collect();
        if let (Some(march), Some(bounce)) = (&self.march, self.bounce()) {
            let first = pieces.len();
            pieces.extend(march.stress_pieces().into_iter().filter(|piece| piece.end.value() > bounce));
            // The flight begins where the closed form ends, and its stress is zero, without the errors of the cells.
            if let Some(flight) = pieces.get_mut(first) {
                let (start, end) = (self.course.events[1].t.clone(), flight.end.clone());
                *flight =
                    StressPiece { start, end, ..bounded_piece(flight.clone().map(Estimate::into_value), self.strain) };
            }
        }
        pieces
    }

    fn strain(&self, time: &Estimate<S>, side: Side) -> Result<Estimate<S>, Error> {
        let (part, time) = self.part(time)?;
        part.strain(&time, side)
    }

    fn pair(&self, pair: Pair, time: &Estimate<S>, side: Side) -> Result<[Estimate<S>; 2], Error> {
        let (part, time) = self.part(time)?;
        part.pair(pair, &time, side)
    }

    fn field(&self, point: &Estimate<S>, time: &Estimate<S>, side: Side) -> Result<Field<Estimate<S>>, Error> {
        let (part, time) = self.part(time)?;
        part.field(&rounded(point), &time, side)
    }

    fn moments(&self, time: &Estimate<S>, points: &[Estimate<S>]) -> Result<Vec<Moments<Estimate<S>>>, Error> {
        let time = meant(&self.course.events, time);
        match self.later(time)? {
            Some(march) => march.moments(time, points),
            None => {
                let points: Vec<_> = points.iter().map(rounded).collect();
                self.contact.moments(&rounded(time), &points)
            }
        }
    }

    fn rates(&self, points: &[Estimate<S>], times: &[Estimate<S>]) -> Result<Vec<[Estimate<S>; 2]>, Error> {
        let times: Vec<_> = times.iter().map(|time| meant(&self.course.events, time).clone()).collect();
        let mut first = 0;
        while first < times.len() && self.later(&times[first])?.is_none() {
            first += 1;
        }
        let contact: Vec<_> = times[..first].iter().map(rounded).collect();
        let mut rates = self.contact.rates(points, &contact)?;
        if let Some(march) = self.march.as_ref().filter(|_| first < times.len()) {
            rates.extend(march.rates(points, &times[first..])?);
        }
        Ok(rates)
    }

    fn highest(&self, release: usize) -> Option<(Estimate<S>, Estimate<S>)> {
        match release {
            0 | 1 => self.contact.highest(release),
            later => self.march.as_ref()?.highest(later - 1),
        }
    }

    fn error_estimate(&self) -> Estimate<S> {
        Estimate::exact(self.error.clone())
    }
}

#[cfg(test)]
#[path = "tests/contact_then_cells.rs"]
mod tests;
