//! The paper's rod from the first contact on: closed form while the contact lasts, cells after it.

use super::history::Damped;
use super::static_state::{StaticState, faded_after};
use crate::error::Error;
use crate::first_contact::{Bounce, FirstContact, Rebound};
use crate::history::{Contact, Ending, Energy, Event, EventKind, Field, History, Scales, Side, StressPiece};
use crate::number::Analytic;
use crate::rod::{Parameters, Problem, Run};

/// The damped rod that starts as the paper's does, through any number of impacts: [`FirstContact`] as long as the first
/// contact lasts, [`Damped`] from the bounce on.
///
/// **Source**: Theorem 1 and the closed forms of section 3 until `t_b`; the characteristic cells of [`crate::cells`] after it.
///
/// **Units**: those of the problem.
///
/// **Accuracy**: within [`History::error_estimate`] of the natural scales.
#[derive(Clone, Debug)]
pub struct Joined<S> {
    contact: FirstContact<S>,
    rod: Parameters<S>,
    bounce: Option<Rebound<S>>,
    march: Option<Damped<S>>,
    /// From when on a contact without end is at rest.
    rest: Option<S>,
    events: Vec<Event<S>>,
    contacts: Vec<Contact<S>>,
    end: S,
    ending: Ending,
    error: S,
    digits: f64,
}

/// How far a history is to go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// As far as the problem's run says.
    Run,
    /// To the first release at most: closed forms alone, no cells.
    Bounce,
    /// The same, because what is left of the motion at the release is too faint for doubles.
    Faint,
}

/// A contact without end is followed for this many round trips, and beyond them if it is at rest by then; where no time is asked
/// for, fewer are shown.
const MOST_TRIPS: i64 = 256;
const SHOWN_TRIPS: i64 = 8;
/// Cells are not marched to more digits than this: their cost grows with the cube of the digits.
const MOST_MARCHED: f64 = 300.0;

impl<S: Analytic> Joined<S> {
    /// Follows `problem`, whose first contact ends as `bounce` says, to about `digits` decimal digits of the natural scales,
    /// and no farther than `reach`.
    ///
    /// **Errors**: those of [`Damped::solve`].
    pub fn solve(
        problem: &Problem,
        precision: &S::Precision,
        digits: f64,
        bounce: Bounce<S>,
        reach: Reach,
    ) -> Result<Self, Error> {
        let rod = Parameters::<S>::of(problem, precision)?;
        let contact = FirstContact::new(&rod);
        let asked = match &problem.run {
            Run::Time(time) => Some(S::from_number(time, precision)),
            Run::Impacts(_) => None,
        };
        let round_trip = contact.round_trip();
        let start = Event {
            kind: EventKind::Impact,
            time: round_trip.zero(),
            end_velocity: -rod.speed.clone(),
            centre: round_trip.zero(),
            centre_velocity: -rod.speed.clone(),
            time_error: 0.0,
        };
        let mut joined = Joined {
            error: round_trip.double(16.0) * round_trip.roundoff(),
            end: asked.clone().unwrap_or_else(|| round_trip.int(SHOWN_TRIPS) * &round_trip),
            ending: Ending::Time,
            events: vec![start],
            contacts: Vec::new(),
            bounce: None,
            march: None,
            rest: None,
            contact,
            rod,
            digits,
        };
        match bounce {
            Bounce::At { time, error, .. } if asked.as_ref().is_none_or(|asked| time <= *asked) => {
                joined.release(time, error);
                joined.follow(problem, precision, reach)?;
            }
            // The contact outlasts the time asked for.
            Bounce::At { .. } => (),
            Bounce::Never { reason } => {
                let most = round_trip.int(MOST_TRIPS) * &round_trip;
                if asked.is_none() {
                    joined.ending = Ending::NoBounce(reason);
                } else if joined.end > most {
                    joined.ending = Ending::NoBounce(reason);
                    match faded_after(&joined.rod, MOST_TRIPS) {
                        Some(trips) => {
                            joined.rest = Some(round_trip.int(trips) * &round_trip);
                            joined.error = joined.error + round_trip.roundoff();
                        }
                        None => joined.end = most,
                    }
                }
            }
            Bounce::Undecided { until, why, .. } => {
                if asked.as_ref().is_none_or(|asked| *asked > until) {
                    joined.end = until;
                    joined.ending = Ending::Undecided(why);
                }
            }
        }
        joined.first_contact();
        Ok(joined)
    }

    /// With this error estimate, if it is below the history's own.
    pub(crate) fn estimated(mut self, estimate: f64) -> Self {
        if self.error.to_f64() > estimate {
            self.error = self.error.double(estimate);
        }
        self
    }

    /// The first release.
    fn release(&mut self, time: S, error: f64) {
        let rebound = self.contact.rebound(&time);
        let unit = self.contact.round_trip();
        // The rod that were glued on would be pulled: that stress is what the end leaves with.
        let pull = self.contact.stress(&time, Side::Right);
        let leaves = if pull.value.to_f64() > pull.error { pull.value * &self.rod.wave_speed } else { time.zero() };
        self.error = self.error.clone() + time.double(error) / &unit;
        self.events.push(Event {
            kind: EventKind::Release,
            end_velocity: leaves,
            centre: rebound.centre.value.clone(),
            centre_velocity: rebound.velocity.value.clone(),
            time_error: error,
            time,
        });
        self.bounce = Some(rebound);
    }

    /// The flight and all that comes after it, from the cells.
    fn follow(&mut self, problem: &Problem, precision: &S::Precision, reach: Reach) -> Result<(), Error> {
        let Some(bounce) = &self.bounce else { return Ok(()) };
        let ending = match reach {
            Reach::Run if self.digits <= MOST_MARCHED => None,
            Reach::Run => Some(Ending::Undecided(format!(
                "beyond {MOST_MARCHED} digits only the first contact is computed, not the flight after it"
            ))),
            Reach::Bounce => Some(Ending::Bounce),
            Reach::Faint => {
                let rest = bounce.velocity.value.to_f64() / self.rod.speed.to_f64();
                Some(Ending::Undecided(format!(
                    "the rod leaves with {rest:.1e} of the impact speed: --digits N follows so faint a motion"
                )))
            }
        };
        if let Some(ending) = ending {
            self.end = bounce.time.clone();
            self.ending = ending;
            return Ok(());
        }
        let release = (&bounce.time, self.events[1].time_error, &self.events[1].end_velocity);
        let march = Damped::after_bounce(problem, precision, self.digits, &self.contact, release)?;
        self.events.extend(march.events().iter().skip(1).cloned());
        self.contacts.extend(march.contacts().iter().cloned());
        let error = march.error_estimate();
        if error > self.error {
            self.error = error;
        }
        self.end = march.end();
        self.ending = march.ending().clone();
        self.march = Some(march);
        Ok(())
    }

    /// The first contact: impulse from the momentum balance, peak from the closed form.
    ///
    /// **Source**: (3.36) integrated: `−c² ∫ v_x dt = P(t) − P(0) + 2rL h(t) + gLt`.
    fn first_contact(&mut self) {
        let to = self.bounce.as_ref().map(|bounce| bounce.time.clone());
        let until = to.clone().unwrap_or_else(|| self.end.clone());
        let (centre, velocity) = self.contact_centre(&until);
        let drag = self.rod.damping.int(2) * &self.rod.damping * &centre;
        let gained = velocity + &self.rod.speed + drag + self.rod.gravity.clone() * &until;
        let contact =
            Contact { from: until.zero(), to, impulse: gained * &self.rod.length, peak_stress: self.peak(&until) };
        self.contacts.insert(0, contact);
    }

    /// The rod at rest, if it is at this time of a contact without end.
    fn at_rest(&self, time: &S) -> Option<StaticState<S>> {
        self.rest.as_ref().filter(|rest| time > rest).map(|_| StaticState::of(&self.rod))
    }

    /// `h`, `h′` in the first contact.
    fn contact_centre(&self, time: &S) -> (S, S) {
        self.at_rest(time).map_or_else(
            || {
                let (centre, velocity) = self.contact.centre(time);
                (centre.value, velocity.value)
            },
            |state| state.centre(),
        )
    }

    /// `v_x(0,t)` in the first contact.
    fn contact_stress(&self, time: &S, side: Side) -> S {
        self.at_rest(time)
            .map_or_else(|| self.contact.stress(time, side).value, |state| state.field(&time.zero()).strain)
    }

    /// The most compressive stress up to `until`.
    ///
    /// Candidates are both limits at every lattice time and interior points of each cell. In the first cell only its ends
    /// can be: there `−c v_x = e^{−rt}(μ I₀ + g t (I₀ + I₁))` has the derivative `e^{−rt} I₀ (g − μ r (1 − I₁/I₀))`, which
    /// rises with `I₁/I₀` and so has at most one zero, a minimum. An interior maximum is narrowed by golden section
    /// until the square of its width, which is the relative error of the peak, is below the roundoff.
    ///
    /// Interior points are looked at in the first 16 cells, and the ends of 64. What still oscillates after that has decayed by
    /// `e^{−16R}`, and only a contact with `R > 1` lasts so long under gravity; what does not oscillate tends to the static
    /// stress from one side, which the last end knows best. Without gravity the peak is `μ/c` at the start.
    fn peak(&self, until: &S) -> S {
        let stress = |time: &S| self.contact_stress(time, Side::Left);
        let mut peak = self.contact_stress(&until.zero(), Side::Right);
        let deeper = |peak: S, value: S| if value < peak { value } else { peak };
        if self.rod.gravity.is_zero() {
            return peak;
        }
        for (k, (from, to)) in self.cells(until).into_iter().enumerate().take(64) {
            let start = self.contact_stress(&from, Side::Right);
            if !(1..16).contains(&k) {
                peak = deeper(deeper(peak, start), stress(&to));
                continue;
            }
            let width = to.clone() - &from;
            let at = |k: usize| from.clone() + width.clone() * width.ratio(k as i64, 12);
            let mut values = vec![start];
            values.extend((1..12).map(|k| stress(&at(k))));
            values.push(stress(&to));
            let least = (1..=12).fold(0, |least, k| if values[k] < values[least] { k } else { least });
            peak = deeper(peak, values.swap_remove(least));
            if (1..12).contains(&least) {
                let (mut low, mut high) = (at(least - 1), at(least + 1));
                let steps = (0.75 * f64::from(peak.bits().unwrap_or(53))).ceil() as u32;
                for _ in 0..steps {
                    let third = (high.clone() - &low) * low.ratio(382, 1000);
                    let (a, b) = (low.clone() + &third, high.clone() - &third);
                    if stress(&a) < stress(&b) { high = b } else { low = a }
                }
                peak = deeper(peak, stress(&low));
            }
        }
        deeper(peak, stress(until))
    }

    /// The lattice cells up to `until`.
    fn cells(&self, until: &S) -> Vec<(S, S)> {
        let unit = self.contact.round_trip();
        let mut cells = Vec::new();
        let mut from = unit.zero();
        for k in 1..=MOST_TRIPS + 1 {
            if from >= *until {
                break;
            }
            let next = unit.int(k) * &unit;
            let still = self.rest.as_ref().is_some_and(|rest| from >= *rest);
            let to = if next < *until && !still { next } else { until.clone() };
            cells.push((from, to.clone()));
            from = to;
        }
        cells
    }

    /// Chebyshev coefficients of the stress on a cell, to the digits asked for.
    fn chebyshev(&self, from: &S, to: &S) -> Vec<S> {
        let half = from.ratio(1, 2);
        let (middle, radius) = ((from.clone() + to) * &half, (to.clone() - from) * &half);
        let scale = self.rod.speed.clone() + self.contact.round_trip() * &self.rod.gravity;
        let least = scale / &self.rod.wave_speed * (from.int(10).ln() * from.double(-self.digits)).exp();
        // Analytic in a neighbourhood of the cell: the terms fall off geometrically, by a digit or more each.
        let first = (self.digits.ceil() as u64).next_power_of_two().clamp(16, 1024) as i64;
        for n in std::iter::successors(Some(first), |n| Some(2 * n)) {
            let cosines: Vec<S> = (0..4 * n).map(|k| (half.pi() * half.ratio(k, 2 * n)).cos()).collect();
            let angle = |k: i64, j: i64| cosines[(k * (2 * j + 1) % (4 * n)) as usize].clone();
            let values: Vec<S> = (0..n)
                .map(|j| self.contact.stress(&(middle.clone() + radius.clone() * angle(1, j)), Side::Left).value)
                .collect();
            let coefficient = |k: i64| {
                let sum = values.iter().zip(0..).fold(half.zero(), |sum, (value, j)| sum + value.clone() * angle(k, j));
                sum * half.ratio(if k == 0 { 1 } else { 2 }, n)
            };
            let mut terms: Vec<S> = (0..n).map(coefficient).collect();
            let settled = terms.iter().rev().take(4).all(|term| term.magnitude() <= least);
            if settled || n >= 1024 {
                while terms.len() > 1 && terms.last().is_some_and(|term| term.magnitude() <= least) {
                    terms.pop();
                }
                return terms;
            }
        }
        Vec::new()
    }

    /// Refuses a time that is not known, and says whether it is one of the first contact.
    fn in_contact(&self, time: &S, side: Side) -> Result<bool, Error> {
        if time.is_negative() || *time > self.end || !time.is_finite() {
            return Err(Error::TimeOutside { found: time.text(), end: self.end.text() });
        }
        Ok(match &self.bounce {
            Some(bounce) => *time < bounce.time || (*time == bounce.time && side == Side::Left),
            None => true,
        })
    }

    /// The cells at a time after the bounce; the history ends at the bounce where there are none.
    fn later(&self) -> Result<&Damped<S>, Error> {
        self.march.as_ref().ok_or_else(|| Error::TimeOutside { found: self.end.text(), end: self.end.text() })
    }
}

impl<S: Analytic> History<S> for Joined<S> {
    fn end(&self) -> S {
        self.end.clone()
    }

    fn ending(&self) -> &Ending {
        &self.ending
    }

    fn events(&self) -> &[Event<S>] {
        &self.events
    }

    fn contacts(&self) -> &[Contact<S>] {
        &self.contacts
    }

    fn stress_pieces(&self) -> Vec<StressPiece<S>> {
        let until = self.bounce.as_ref().map_or(&self.end, |bounce| &bounce.time);
        let mut pieces: Vec<StressPiece<S>> = self
            .cells(until)
            .into_iter()
            .map(|(from, to)| {
                let still = self.rest.as_ref().is_some_and(|rest| from >= *rest);
                let left = self.contact_stress(if still { &to } else { &from }, Side::Right);
                let right = self.contact_stress(&to, Side::Left);
                let chebyshev = if still { vec![right.clone()] } else { self.chebyshev(&from, &to) };
                StressPiece { left, right, chebyshev, from, to }
            })
            .collect();
        if let Some(march) = &self.march {
            pieces.extend(march.stress_pieces());
        }
        pieces
    }

    fn stress(&self, time: &S, side: Side) -> Result<S, Error> {
        if time.is_zero() && side == Side::Left {
            return Ok(time.zero());
        }
        if self.in_contact(time, side)? {
            return Ok(self.contact_stress(time, side));
        }
        match (&self.bounce, &self.march) {
            (Some(bounce), _) if *time == bounce.time => Ok(time.zero()),
            _ => self.later()?.stress(time, side),
        }
    }

    fn ground_end(&self, time: &S, side: Side) -> Result<(S, S), Error> {
        if time.is_zero() && side == Side::Left {
            return Ok((time.zero(), -self.rod.speed.clone()));
        }
        if self.in_contact(time, side)? {
            return Ok((time.zero(), time.zero()));
        }
        match (&self.bounce, self.events.get(1)) {
            (Some(bounce), Some(release)) if *time == bounce.time => Ok((time.zero(), release.end_velocity.clone())),
            _ => self.later()?.ground_end(time, side),
        }
    }

    fn top_end(&self, time: &S, side: Side) -> Result<(S, S), Error> {
        let top = self.field(&self.rod.length, time, side)?;
        Ok((top.displacement, top.velocity))
    }

    fn centre(&self, time: &S) -> Result<(S, S), Error> {
        if self.in_contact(time, Side::Left)? {
            return Ok(self.contact_centre(time));
        }
        // Until the next impact the centre flies freely, whatever the rod does.
        match (&self.bounce, self.events.get(2)) {
            (Some(bounce), next) if next.is_none_or(|next| *time <= next.time) => Ok(bounce.flight(time)),
            _ => self.later()?.centre(time),
        }
    }

    fn energy(&self, time: &S) -> Result<Energy<S>, Error> {
        if !self.in_contact(time, Side::Left)? {
            return self.later()?.energy(time);
        }
        Ok(self.at_rest(time).map_or_else(|| self.contact.energy(time).0, |state| state.energy()))
    }

    fn field(&self, point: &S, time: &S, side: Side) -> Result<Field<S>, Error> {
        if point.is_negative() || *point > self.rod.length || !point.is_finite() {
            return Err(Error::PointOutside { found: point.text(), length: self.rod.length.text() });
        }
        if self.in_contact(time, side)? {
            let state = self.at_rest(time);
            return Ok(state.map_or_else(|| self.contact.field(point, time, side).0, |state| state.field(point)));
        }
        self.later()?.field(point, time, side)
    }

    fn highest(&self, release: &Event<S>) -> Option<(S, S)> {
        match &self.bounce {
            Some(bounce) if bounce.time == release.time => bounce.highest(),
            _ => self.march.as_ref().and_then(|march| march.highest(release)),
        }
    }

    fn scales(&self) -> Scales<S> {
        let fall = self.rod.critical_speed();
        Scales {
            time: self.contact.round_trip(),
            velocity: if fall > self.rod.speed { fall } else { self.rod.speed.clone() },
            length: self.rod.length.clone(),
            wave_speed: self.rod.wave_speed.clone(),
            gravity: self.rod.gravity.clone(),
        }
    }

    fn error_estimate(&self) -> S {
        self.error.clone()
    }

    fn warnings(&self) -> &[String] {
        self.march.as_ref().map_or(&[], |march| march.warnings())
    }
}
