//! The paper's rod from the first contact on: closed form while the contact lasts, cells after it.

use std::ops::ControlFlow;

use super::budget::AtEvent;
use super::effort::Effort;
use super::history::Damped;
use super::piece::Unresolved;
use super::with_bounds::{Bounding, Lines, Pair};
use crate::error::Error;
use crate::first_contact::{Bounce, ContactHistory, FirstContact};
use crate::motion::{Course, Ending, Energy, Event, Field, Motion, Scales, Side, StressPiece, Uncertainty, unobserved};
use crate::number::Estimate;
use crate::problem::{Parameters, Problem, Run};
use crate::reason::Reason;
use crate::special::RoundedSpecial;

/// The damped rod that starts as the paper's does, through any number of impacts: [`ContactHistory`] as long as the
/// first contact lasts, [`Damped`] from the bounce on.
///
/// **Source**: Theorem 1 and the closed forms of section 3 until `t_b`; the characteristic cells of [`crate::cells`]
/// after it.
///
/// **Units**: those of the problem.
///
/// **Accuracy**: within [`Motion::error_estimate`] of the natural scales.
#[derive(Clone, Debug)]
pub struct ContactThenCells<S> {
    contact: ContactHistory<Estimate<S>>,
    rod: Parameters<S>,
    /// `t_b`.
    bounce: Option<S>,
    march: Option<Damped<S>>,
    course: Course<S>,
    error: S,
    /// The same of the first contact.
    before: f64,
    effort: Effort,
}

/// How far a history is to go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// As far as the problem's run says.
    Run,
    /// To the first release at most: closed forms alone, no cells.
    Bounce,
}

/// Cells are not marched to more digits than this: their cost grows with the cube of the digits.
const MOST_MARCHED: f64 = 300.0;

fn pair<S>((a, b): (Estimate<S>, Estimate<S>)) -> (S, S) {
    (a.into_value(), b.into_value())
}

impl<S: RoundedSpecial> ContactThenCells<S> {
    /// Follows `problem`, whose first contact ends as `bounce` says, to about `digits` decimal digits of the natural
    /// scales, and no farther than `reach`.
    ///
    /// **Errors**: those of [`Damped::solve`].
    pub fn solve(
        problem: &Problem,
        precision: &S::Precision,
        digits: f64,
        bounce: Bounce<Estimate<S>>,
        reach: Reach,
    ) -> Result<Self, Error> {
        Self::solve_observed(problem, precision, Effort::of(digits), (bounce, reach), None, &unobserved)
    }

    /// [`Self::solve`], observed; `rate` is `h′` at the bounce where it is known better than here.
    pub(crate) fn solve_observed(
        problem: &Problem,
        precision: &S::Precision,
        effort: Effort,
        (bounce, reach): (Bounce<Estimate<S>>, Reach),
        rate: Option<Estimate<S>>,
        observe: &dyn Fn(usize, usize) -> ControlFlow<()>,
    ) -> Result<Self, Error> {
        let rod = Parameters::<S>::of(problem, precision)?;
        let asked = match &problem.run {
            Run::Time(time) => Some(S::from_number(time, precision).carry()),
            Run::Impacts(_) => None,
        };
        let contact = ContactHistory::new(FirstContact::new(&Parameters::of(problem, precision)?), bounce, asked)?;
        let course = contact.course().clone().map(Estimate::into_value);
        let bounce = course.events.get(1).map(|release| release.time.clone());
        let time_error = course.events.get(1).map_or(0.0, |release| release.time_error);
        let round_trip = rod.round_trip();
        let error = round_trip.double(17.0) * round_trip.roundoff() + round_trip.double(time_error) / &round_trip;
        let mut history =
            ContactThenCells { before: error.to_f64(), error, march: None, course, bounce, contact, rod, effort };
        history.follow(problem, precision, (reach, rate), observe)?;
        Ok(history)
    }

    /// The flight and all that comes after it, from the cells.
    fn follow(
        &mut self,
        problem: &Problem,
        precision: &S::Precision,
        (reach, rate): (Reach, Option<Estimate<S>>),
        observe: &dyn Fn(usize, usize) -> ControlFlow<()>,
    ) -> Result<(), Error> {
        let rebound = self.contact.rebound().map(|rebound| rebound.velocity.clone());
        let (Some(bounce), Some(rebound), Reach::Run) = (self.bounce.clone(), rebound, reach) else { return Ok(()) };
        if self.effort.digits > MOST_MARCHED {
            self.course.ending = Ending::Undecided(Reason::MostDigits(MOST_MARCHED as u32));
            return Ok(());
        }
        let release = (&bounce, self.course.events[1].time_error, &self.course.events[1].end_velocity);
        // The cells account for the roundings of the parameters themselves.
        let form = FirstContact::new(&self.rod.carry());
        let rate = rate.unwrap_or(rebound);
        let march = Damped::after_bounce(problem, precision, self.effort, &form, release, &rate, observe)?;
        let Course { events, contacts, .. } = march.course();
        self.course.events.extend(events.iter().skip(1).cloned());
        self.course.contacts.extend(contacts.iter().cloned());
        let error = march.error_estimate();
        if error > self.error {
            self.error = error;
        }
        self.course.end = march.end();
        self.course.ending = march.ending().clone();
        self.course.warnings = march.warnings().to_vec();
        self.march = Some(march);
        Ok(())
    }

    /// Hops that the bound of the error does not tell apart from contact, if there may be any.
    pub fn unresolved(&self) -> Option<&Unresolved<S>> {
        self.march.as_ref().and_then(Damped::unresolved)
    }

    /// Refuses a time that is not known, and says whether it is one of the first contact.
    fn in_contact(&self, time: &S, side: Side) -> Result<bool, Error> {
        if time.is_negative() || *time > self.course.end || !time.is_finite() {
            return Err(Error::TimeOutside { found: time.text(), end: self.course.end.text() });
        }
        let flies = |bounce: &S| time > bounce || time == bounce && side == Side::Right;
        Ok(!self.bounce.as_ref().is_some_and(flies))
    }

    /// Whether that is the first bounce itself.
    fn at_bounce(&self, time: &S) -> bool {
        self.bounce.as_ref() == Some(time)
    }

    /// The cells at a time after the bounce; the history ends at the bounce where there are none.
    fn later(&self) -> Result<&Damped<S>, Error> {
        self.march
            .as_ref()
            .ok_or_else(|| Error::TimeOutside { found: self.course.end.text(), end: self.course.end.text() })
    }
}

impl<S: RoundedSpecial> Motion<S> for ContactThenCells<S> {
    fn course(&self) -> &Course<S> {
        &self.course
    }

    fn stress_pieces(&self) -> Vec<StressPiece<S>> {
        let until = self.bounce.as_ref().unwrap_or(&self.course.end);
        let first = self.contact.stress_pieces().into_iter();
        let mut pieces: Vec<StressPiece<S>> = first.map(|piece| piece.map(Estimate::into_value)).collect();
        if let Some(march) = &self.march {
            let later = march.stress_pieces().into_iter().filter(|piece| piece.to > *until);
            // The flight begins where the closed form ends.
            pieces.extend(later.map(|piece| StressPiece {
                from: if piece.from < *until { until.clone() } else { piece.from },
                ..piece
            }));
            if let Some(flight) = pieces.iter_mut().find(|piece| piece.from >= *until) {
                flight.from = until.clone();
            }
        }
        pieces
    }

    fn strain(&self, time: &S, side: Side) -> Result<S, Error> {
        if self.in_contact(time, side)? || self.at_bounce(time) {
            return Ok(self.contact.strain(&time.carry(), side)?.into_value());
        }
        self.later()?.strain(time, side)
    }

    fn ground_end(&self, time: &S, side: Side) -> Result<(S, S), Error> {
        if self.in_contact(time, side)? || self.at_bounce(time) {
            return self.contact.ground_end(&time.carry(), side).map(pair);
        }
        self.later()?.ground_end(time, side)
    }

    fn top_end(&self, time: &S, side: Side) -> Result<(S, S), Error> {
        let top = self.field(&self.rod.length, time, side)?;
        Ok((top.displacement, top.velocity))
    }

    fn centre(&self, time: &S) -> Result<(S, S), Error> {
        self.bounded_centre(time).map_or_else(|| self.later()?.centre(time), |centre| centre.map(pair))
    }

    fn energy(&self, time: &S) -> Result<Energy<S>, Error> {
        if !self.in_contact(time, Side::Left)? {
            return self.later()?.energy(time);
        }
        Ok(self.contact.energy(&time.carry())?.map(Estimate::into_value))
    }

    fn energy_parts(&self, time: &S) -> Result<[S; 2], Error> {
        if !self.in_contact(time, Side::Left)? {
            return self.later()?.energy_parts(time);
        }
        Ok(self.contact.energy_parts(&time.carry())?.map(Estimate::into_value))
    }

    fn field(&self, point: &S, time: &S, side: Side) -> Result<Field<S>, Error> {
        if point.is_negative() || *point > self.rod.length || !point.is_finite() {
            return Err(Error::PointOutside { found: point.text(), length: self.rod.length.text() });
        }
        if !self.in_contact(time, side)? {
            return self.later()?.field(point, time, side);
        }
        Ok(self.contact.field(&point.carry(), &time.carry(), side)?.map(Estimate::into_value))
    }

    fn rates(&self, points: &[S], times: &[S]) -> Result<Vec<[S; 2]>, Error> {
        let mut first = 0;
        while first < times.len() && self.in_contact(&times[first], Side::Right)? {
            first += 1;
        }
        let (contact, later) = times.split_at(first);
        let carry = |numbers: &[S]| numbers.iter().map(|x| x.carry()).collect::<Vec<_>>();
        let rates = self.contact.rates(&carry(points), &carry(contact))?;
        let mut rates: Vec<_> = rates.into_iter().map(|pair| pair.map(Estimate::into_value)).collect();
        if !later.is_empty() {
            rates.extend(self.later()?.rates(points, later)?);
        }
        Ok(rates)
    }

    fn highest(&self, release: &Event<S>) -> Option<(S, S)> {
        if self.at_bounce(&release.time) {
            return self.contact.rebound()?.highest().map(pair);
        }
        self.march.as_ref().and_then(|march| march.highest(release))
    }

    fn scales(&self) -> Scales<S> {
        self.contact.scales().map(Estimate::into_value)
    }

    fn error_estimate(&self) -> S {
        self.error.clone()
    }

    fn uncertainty(&self, time: &S) -> Uncertainty {
        match (&self.march, &self.bounce) {
            (Some(march), Some(bounce)) if time > bounce => march.uncertainty(time),
            _ => Uncertainty { rise: self.before, speed: self.before, rate: self.before, ..Uncertainty::default() },
        }
    }
}

/// The first contact, whose closed forms carry their own bounds: late in it the rays cancel.
impl<S: RoundedSpecial> Bounding<S> for ContactThenCells<S> {
    fn bounded(&self, time: &S, side: Side) -> Option<&dyn Motion<Estimate<S>>> {
        let first = self.in_contact(time, side).is_ok_and(|is| is) || self.at_bounce(time);
        first.then_some(&self.contact as &dyn Motion<Estimate<S>>)
    }

    /// The first event of the cells is the bounce.
    fn at_event(&self, event: usize) -> Option<AtEvent> {
        self.march.as_ref()?.at_event(event.checked_sub(1)?)
    }

    fn lines(&self, time: &S, points: &[S]) -> Result<Lines<S>, Error> {
        self.later()?.lines(time, points)
    }

    fn bounded_centre(&self, time: &S) -> Option<Pair<S>> {
        match (self.in_contact(time, Side::Left).ok()?, self.course.events.get(2)) {
            (true, _) => Some(self.contact.centre(&time.carry())),
            // Until the next impact the centre flies freely, whatever the rod does.
            (false, next) if next.is_none_or(|next| *time <= next.time) => Some(self.contact.flight(&time.carry())),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Number;

    /// A release that is displaced by hand moves every later event by no more than the bound says that it may, and the
    /// bound does not exceed that by orders of magnitude with each impact.
    #[test]
    fn events_move_with_a_displaced_release_as_the_bound_says() {
        let number = |text: &str| text.parse::<Number>().unwrap_or_else(|error| unreachable!("{error}"));
        // Below g t₁ = 2 the first release is at a root of the stress; a displaced one at a ray would leave a stripe.
        for (damping, speed, displaced) in [
            ("0.0122", "1.41", -1e-7),
            ("0.0122", "1.41", 1e-7),
            ("0.1", "1", 1e-7),
            ("0.05", "1.7", -1e-7),
            ("0.2", "1.2", 1e-7),
            ("0.00001", "1.3", 1e-8),
        ] {
            let mut problem = Problem::uniform(number("1"), number("1"), number("1"), number(speed));
            (problem.rod.damping, problem.run) = (Some(number(damping)), Run::Impacts(5));
            let solve = || -> Result<_, Error> {
                let rod = Parameters::<f64>::of(&problem, &())?;
                let contact = FirstContact::new(&rod.carry());
                let bounce = contact.bounce();
                let straight = ContactThenCells::<f64>::solve(&problem, &(), 13.0, bounce, Reach::Run)?;
                let first = straight.events()[1].clone();
                let release = (first.time + displaced, f64::abs(displaced) + first.time_error, first.end_velocity);
                let form = straight.contact.form();
                let off = Damped::after_bounce(
                    &problem,
                    &(),
                    Effort::of(13.0),
                    form,
                    (&release.0, release.1, &release.2),
                    &Estimate::new(0.0, f64::INFINITY),
                    &unobserved,
                )?;
                Ok((straight, off))
            };
            let (straight, off) = solve().unwrap_or_else(|error| unreachable!("{error}"));
            let (ours, theirs) = (&straight.events()[1..], off.events());
            assert_eq!(ours.len(), theirs.len(), "{damping} {speed}");
            for (k, (a, b)) in ours.iter().zip(theirs).enumerate() {
                let moved = (a.time - b.time).abs();
                assert!(moved <= b.time_error, "{damping} {speed}, event {k}: {moved:e} {:e}", b.time_error);
                let most = f64::abs(displaced) * 30f64.powi(k as i32 + 1);
                assert!(b.time_error <= most, "{damping} {speed}, event {k}: {:e} {most:e}", b.time_error);
            }
        }
    }
}
