//! The answer in one number system: events, and the queries of a history.

use std::sync::{Mutex, OnceLock};

use super::ladder::{Attempt, Ladder, Target};
use super::plan::Plan;
use super::question::{Numbers, Observer, Question};
use super::rung::Rung;
use crate::error::Error;
use crate::motion::{
    Contact, Ending, Energy, Event, Field, Motion, Ray, Scales, Side, StressHistory, StressPiece, Waves,
};
use crate::number::{Answer, Number, Scalar, show};
use crate::problem::{Parameter, Problem};
use crate::quantity::{self, Flight, Quantity, Restitution, Slice, UnitSystem, Units, flights, restitution};
use crate::reason::{Reason, Warning};
use crate::threads::locked;

/// The motion of a rod: its impacts and releases, and the values of every quantity at any time, in numbers `S`.
///
/// All times are absolute and in the units of the problem. A query at a time outside `0 … end()` is
/// [`Error::TimeOutside`], or [`Error::BeyondEnd`] and [`Error::BeyondExactness`] if the history ends for a reason of
/// its own; a query at a point outside the rod is [`Error::PointOutside`].
///
/// A time that is a [`Scalar::spelling`], as those of the command are, represents exactly the number that it spells.
/// Longer runs and fractions decide on which side of an event or a ray it lies; otherwise the bound covers both sides
/// and [`TypedHistory::warnings`] names the time. A computed time represents the event or the ray within some roundings
/// of it; the time of an event, as the history returns it, represents the event.
///
/// **Accuracy**: that of the [`Plan`]. An answer is computed again with more bits if the current ones do not leave the
/// requested digits.
///
/// ```
/// use dalembert::Problem;
/// let rod = Problem::uniform(1.into(), 1.into(), 1.into(), 3.into());
/// let motion = rod.doubles()?;
/// // Corollary 1: μ = 3 ≥ g t₁ = 2, so the contact lasts exactly t₁ = 2L/c.
/// assert_eq!(motion.contacts()[0].release, Some(2.0));
/// // d'Alembert: at t = 1/2 the wave front of the impact is at x = 1/2; below it v_x = −(μ + g(t − x))/c.
/// assert_eq!(motion.at(0.25, 0.5)?.strain, -3.25);
/// # Ok::<(), dalembert::Error>(())
/// ```
pub struct TypedHistory<S: Target> {
    problem: Problem,
    plan: Plan,
    pub(super) observe: Observer,
    /// The attempt that settled the events; every query goes to it first.
    pub(super) first: Attempt<S>,
    /// The last attempt, in longer numbers if a query needed them.
    last: Mutex<Attempt<S>>,
    events: OnceLock<Vec<Event<S>>>,
    contacts: OnceLock<Vec<Contact<S>>>,
    ending: Ending,
    end: S,
    /// Times that earlier attempts could not distinguish from those of events or rays.
    covered: Mutex<Vec<f64>>,
    /// Values by which derivatives were computed whose errors are estimates.
    pub(super) estimated: Mutex<Vec<Parameter>>,
}

impl<S: Target> TypedHistory<S> {
    /// Solves `problem` by `plan`; see [`Observer`] for what `observe` receives.
    ///
    /// **Errors**: those of [`Plan::solve`](crate::solve::Plan::solve).
    pub fn solve(problem: &Problem, plan: &Plan, observe: Observer) -> Result<Self, Error> {
        let ladder = Ladder { problem, plan, observe: &observe };
        let ask_events = plan.settles_events;
        let query = |engine: &dyn Motion<S::Carried>| {
            let (events, contacts) = if ask_events { (engine.events(), engine.contacts()) } else { Default::default() };
            Ok((engine.end(), events.to_vec(), contacts.to_vec()))
        };
        let (attempt, (end, events, contacts)) = ladder.ask::<S, _>(Vec::new(), query, |(end, events, contacts)| {
            let happens = events.iter().flat_map(Event::numbers).chain(contacts.iter().flat_map(Contact::numbers));
            std::iter::once(end).chain(happens).collect()
        })?;
        let motion = TypedHistory {
            ending: attempt.engine.ending().clone(),
            last: Mutex::new(attempt.clone()),
            first: attempt,
            events: OnceLock::new(),
            contacts: OnceLock::new(),
            end: S::strip(end),
            covered: Mutex::default(),
            estimated: Mutex::default(),
            problem: problem.clone(),
            plan: plan.clone(),
            observe,
        };
        if ask_events {
            motion.events.get_or_init(|| events.into_iter().map(|event| event.map(S::strip)).collect());
            motion.contacts.get_or_init(|| contacts.into_iter().map(|contact| contact.map(S::strip)).collect());
        }
        Ok(motion)
    }

    pub(super) fn carried_end(&self) -> S::Carried {
        self.current().engine.end()
    }

    /// Returns the natural scales with their bounds.
    pub(super) fn carried_scales(&self) -> Scales<S::Carried> {
        self.current().engine.scales()
    }

    pub(super) fn ladder(&self) -> Ladder<'_> {
        Ladder { problem: &self.problem, plan: &self.plan, observe: &self.observe }
    }

    fn current(&self) -> Attempt<S> {
        locked(&self.last).clone()
    }

    /// Returns the answer to any `query`, in numbers that carry their bound; `numbers` returns the numbers of the
    /// answer that must have the digits of the plan.
    ///
    /// **Accuracy**: that of the [`Plan`]. The query is repeated with more bits if the current ones do not settle it.
    ///
    /// **Errors**: those of the query; [`Error::Unsettled`], [`Error::Undecided`] if too many bits do not settle it.
    ///
    /// ```
    /// use dalembert::{Number, Problem, Side};
    /// use dalembert::number::Scalar;
    /// let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).build()?;
    /// // A time that no double holds, in the precision of each attempt.
    /// let third: Number = "1/3".parse()?;
    /// let history = rod.doubles()?;
    /// let strain = history.ask(
    ///     |motion| motion.strain(&Scalar::from_number(&third, &motion.end().precision()), Side::Right),
    ///     |strain| vec![strain],
    /// )?;
    /// assert_eq!(*strain.value(), -10.0 / 3.0); // −(μ + g t)/c
    /// assert!(strain.bound() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn ask<T>(
        &self,
        query: impl Fn(&dyn Motion<S::Carried>) -> Result<T, Error>,
        numbers: impl Fn(&T) -> Vec<&S::Carried>,
    ) -> Result<T, Error> {
        let last = self.current();
        let known = if self.first.rung == last.rung { vec![last] } else { vec![self.first.clone(), last] };
        let answer = self.ladder().ask(known, query, numbers);
        let (attempt, answer) = answer.map_err(|error| self.explained(error))?;
        self.keep(attempt);
        Ok(answer)
    }

    /// Keeps an attempt in other numbers than those of the first and the last one.
    fn keep(&self, attempt: Attempt<S>) {
        let mut last = locked(&self.last);
        if attempt.rung != last.rung && attempt.rung != self.first.rung {
            let before = std::mem::replace(&mut *last, attempt);
            let covered = before.engine.covered().map(|(times, _)| times);
            locked(&self.covered).extend(covered.into_iter().flatten());
        }
    }

    /// Adds to an error of a query the reason why the history ends before the requested time.
    pub fn explained(&self, error: Error) -> Error {
        let Error::TimeOutside { found, end } = error else { return error };
        let (found, end) = told_apart(found, end);
        let after = found.parse::<Number>().is_ok_and(|time| time.to_f64() > 0.0);
        match &self.ending {
            ending @ Ending::ExactnessEnds { .. } if after => {
                Error::BeyondExactness { found, ending: ending.to_string() }
            }
            ending if after && *ending != Ending::Time => Error::BeyondEnd { found, end, ending: ending.to_string() },
            _ => Error::TimeOutside { found, end },
        }
    }

    /// Returns the last known time: before an event at an irrational time, a fraction just below it.
    pub fn end(&self) -> &S {
        &self.end
    }

    /// Returns the reason of the end.
    pub fn ending(&self) -> &Ending {
        &self.ending
    }

    /// Formats a number of an answer with exactly the digits that the [`Plan`] promises: a `Float` and an enclosure
    /// carry more.
    ///
    /// **Accuracy**: *correctly rounded* to the requested digits; the shortest text of a double; a fraction in full.
    ///
    /// ```
    /// let rod = dalembert::Problem::builder().length(12).wave_speed(30).gravity(10).impact_speed(40).build()?;
    /// let history = rod.digits(50)?;
    /// // t_b = t₁ = 2L/c = 4/5, and the peak is −(μ + g t₁)/c = −8/5.
    /// assert_eq!(history.text(history.contacts()[0].release.as_ref().unwrap()), format!("0.8{}", "0".repeat(49)));
    /// assert_eq!(rod.certified(5)?.text(&rod.certified(5)?.contacts()[0].peak_strain), "-1.6000");
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn text(&self, number: &S) -> String {
        match self.plan().numbers {
            Numbers::Digits(digits) | Numbers::ExactThenDigits(digits) | Numbers::Certified(digits) => {
                show(&number.exactly(), digits)
            }
            Numbers::Double(_) | Numbers::Exact => number.text(),
        }
    }

    /// Returns the factors that convert strains to stress and force, and values per `ρS` to impulse and energy.
    ///
    /// ```
    /// use dalembert::{Problem, quantity::Measure};
    /// // c = √(E/ρ) = 2, and nothing but the momentum ρS L μ turns round: an impulse of 2ρS L μ, of which ρS = 2.
    /// let rod = Problem::builder().length(2).material(4, 1, 2).impact_speed(1).build()?;
    /// let history = rod.doubles()?;
    /// let impulse = history.contacts()[0].impulse;
    /// assert_eq!(impulse, 4.0);
    /// assert_eq!(history.units().factor::<f64>(Measure::Impulse, &()).map(|factor| factor * impulse), Some(8.0));
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn units(&self) -> Units {
        Units::new(&self.problem, UnitSystem::default())
    }

    /// Returns the problem.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// Returns the plan by which it was solved.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Returns the rung of the last answer.
    pub fn rung(&self) -> Rung {
        self.current().rung
    }

    /// Returns all impacts and releases, in order. A rod that stands on the ground has its first impact at `t = 0`.
    pub fn events(&self) -> &[Event<S>] {
        self.events
            .get_or_init(|| self.current().engine.events().iter().map(|event| event.clone().map(S::strip)).collect())
    }

    /// Returns all contacts, in order.
    pub fn contacts(&self) -> &[Contact<S>] {
        let strip = |contact: &Contact<S::Carried>| contact.clone().map(S::strip);
        self.contacts.get_or_init(|| self.current().engine.contacts().iter().map(strip).collect())
    }

    /// Returns the flights between the contacts, and their highest points.
    pub fn flights(&self) -> Result<Vec<Flight<S>>, Error> {
        let found = self.ask(flights, |flights| Flight::numbers(flights))?;
        Ok(found.into_iter().map(|flight| flight.map(S::strip)).collect())
    }

    /// Returns `e_P` and `e_E²` of a contact, counted from 0.
    ///
    /// **Accuracy**: in doubles the accuracy of `h` and `h′` at both ends, of which these are ratios: if one of them is
    /// nearly zero, no double is accurate enough for its ratio. In other numbers their own.
    ///
    /// **Errors**: [`Error::NoContact`] if the history has fewer contacts.
    pub fn restitution(&self, contact: usize) -> Result<Restitution<S>, Error> {
        Ok(self.carried_restitution(contact)?.map(S::strip))
    }

    /// Computes [`TypedHistory::restitution`] in numbers that carry their bound.
    pub(super) fn carried_restitution(&self, contact: usize) -> Result<Restitution<S::Carried>, Error> {
        let doubles = matches!(self.plan().numbers, Numbers::Double(_));
        let query = |engine: &dyn Motion<S::Carried>| {
            let times = engine.contact_times(contact);
            let missing = || Error::NoContact { contact, found: engine.contacts().len() };
            let (from, to) = times.ok_or_else(missing)?;
            let centres =
                std::iter::once(&from).chain(&to).map(|time| engine.centre(time)).collect::<Result<Vec<_>, _>>()?;
            Ok((restitution(engine, (&from, to.as_ref()))?, centres))
        };
        let (found, _) = self.ask(query, |(found, centres)| match doubles {
            true => centres.iter().flat_map(|(h, rate)| [h, rate]).collect::<Vec<_>>(),
            false => Restitution::numbers(found),
        })?;
        Ok(found)
    }

    /// Returns `v_x(0,·)` piece by piece: strains, see [`StressHistory`].
    pub fn stress_history(&self) -> Result<StressHistory<S>, Error> {
        let pieces = self.ask(|engine| Ok(engine.stress_pieces()), |pieces| StressPiece::numbers(pieces))?;
        let answer = |piece: StressPiece<S::Carried>| piece.with_own_coefficients().map(S::strip);
        let pieces = pieces.into_iter().map(answer).collect();
        Ok(StressHistory { pieces, ending: self.ending.clone() })
    }

    /// Returns `v_x(0,t)`: the strain at the ground, which is the stress there divided by the modulus; zero in flight.
    pub fn strain(&self, time: S, side: Side) -> Result<S, Error> {
        let time = self.time(&time)?;
        Ok(S::strip(self.ask(|engine| engine.strain(&time, side), |value| vec![value])?))
    }

    /// Returns `v(0,t)` and `v_t(0,t)`, for the end at the ground.
    pub fn ground_end(&self, time: S, side: Side) -> Result<(S, S), Error> {
        self.pair(time, |engine, time| engine.ground_end(time, side))
    }

    /// Returns `v(L,t)` and `v_t(L,t)`, for the upper end.
    pub fn top_end(&self, time: S, side: Side) -> Result<(S, S), Error> {
        self.pair(time, |engine, time| engine.top_end(time, side))
    }

    /// Returns `h(t)` and `h′(t)`: the centre of mass, relative to its position in the undeformed rod on the ground.
    pub fn centre(&self, time: S) -> Result<(S, S), Error> {
        self.pair(time, |engine, time| engine.centre(time))
    }

    /// Converts a time to the numbers of the engine. **Errors**: [`Error::TimeOutside`] for NaN and infinities.
    fn time(&self, time: &S) -> Result<S::Carried, Error> {
        let time = time.carry();
        quantity::check_finite(&self.end.carry(), std::slice::from_ref(&time)).map(|()| time)
    }

    fn pair(&self, time: S, ask: impl Fn(&dyn Motion<S::Carried>, &S::Carried) -> Pair<S>) -> Result<(S, S), Error> {
        let time = self.time(&time)?;
        let (a, b) = self.ask(|engine| ask(engine, &time), |(a, b)| vec![a, b])?;
        Ok((S::strip(a), S::strip(b)))
    }

    /// Returns `E(t)`, `E_h(t)`, `E_z(t)`: the energies, per linear density.
    pub fn energy(&self, time: S) -> Result<Energy<S>, Error> {
        let time = self.time(&time)?;
        Ok(self.ask(|engine| engine.energy(&time), |energy| energy.numbers().to_vec())?.map(S::strip))
    }

    /// Returns the values of `columns` at every time of `times`, column by column. If `side` is `None`, a time at which
    /// the two limits of any quantity differ has two rows, the limit from earlier times first.
    ///
    /// **Accuracy**: that of the [`Plan`], each column by itself.
    pub fn columns(&self, columns: &[Quantity], times: &[S], side: Option<Side>) -> Result<Vec<Vec<S>>, Error> {
        let times: Vec<_> = times.iter().map(Answer::carry).collect();
        let table = self.ask_columns(columns, side, |_| Ok(times.clone()))?;
        Ok(table.into_iter().map(|column| column.into_iter().map(S::strip).collect()).collect())
    }

    /// Returns [`TypedHistory::columns`] in numbers that carry their bound, at times of the engine itself, or at times
    /// lifted to the precision of each attempt.
    pub fn ask_columns(
        &self,
        columns: &[Quantity],
        side: Option<Side>,
        times: impl Fn(&dyn Motion<S::Carried>) -> Result<Vec<S::Carried>, Error>,
    ) -> Result<Vec<Vec<S::Carried>>, Error> {
        self.ask_columns_in(&self.units(), columns, side, times)
    }

    pub(super) fn ask_columns_in(
        &self,
        units: &Units,
        columns: &[Quantity],
        side: Option<Side>,
        times: impl Fn(&dyn Motion<S::Carried>) -> Result<Vec<S::Carried>, Error>,
    ) -> Result<Vec<Vec<S::Carried>>, Error> {
        let query = |engine: &dyn Motion<S::Carried>| {
            let table = quantity::columns(engine, units, columns, &times(engine)?, side)?;
            let scaled = quantity::scaled(engine, units, columns, &table);
            Ok((table, scaled))
        };
        Ok(self.ask(query, |(_, scaled)| scaled.iter().collect())?.0)
    }

    /// Returns [`History::sample_field`](super::History::sample_field) in numbers that carry their bound, on a grid of
    /// points and times in the numbers of the engine.
    pub fn ask_slices(
        &self,
        slice: Slice,
        side: Option<Side>,
        grid: impl Fn(&dyn Motion<S::Carried>) -> Result<(Vec<S::Carried>, Vec<S::Carried>), Error>,
    ) -> Result<Vec<Vec<S::Carried>>, Error> {
        let query = |engine: &dyn Motion<S::Carried>| {
            let (points, times) = grid(engine)?;
            let table = quantity::slices(engine, slice, &points, &times, side)?;
            let scaled = quantity::scaled(engine, &self.units(), &quantity::SLICE, &table);
            Ok((table, scaled))
        };
        Ok(self.ask(query, |(_, scaled)| scaled.iter().collect())?.0)
    }

    /// Returns `v`, `v_t`, `v_x` at `(x,t)`; on a ray, the limit from later times.
    pub fn at(&self, point: S, time: S) -> Result<Field<S>, Error> {
        self.field(&[point], &[time], Side::Right).map(|mut values| values.remove(0))
    }

    /// Returns `v`, `v_t`, `v_x` at every point of `points` for every time of `times`: time by time, with all points of
    /// one time together.
    pub fn field(&self, points: &[S], times: &[S], side: Side) -> Result<Vec<Field<S>>, Error> {
        let points: Vec<_> = points.iter().map(Answer::carry).collect();
        let value = |(time, point): (&S, _)| {
            let time = self.time(time)?;
            let value = self.ask(|engine| engine.field(point, &time, side), |field| field.numbers().to_vec())?;
            Ok(value.map(S::strip))
        };
        times.iter().flat_map(|time| points.iter().map(move |point| (time, point))).map(value).collect()
    }

    /// Returns the rays that leave the ground in round trip `trip`, counted from 0, with the jumps that they carry.
    ///
    /// **Errors**: [`Error::NoRays`] under damping.
    pub fn rays(&self, trip: usize) -> Result<Vec<Ray<S>>, Error> {
        let rays = self.ask(|motion| motion.rays(trip), |rays| rays.iter().map(|ray| &ray.from).collect())?;
        Ok(rays.into_iter().map(|ray| ray.map(S::strip)).collect())
    }

    /// Returns the whole solution as two travelling waves: a piecewise quadratic function of one variable.
    ///
    /// **Errors**: [`Error::NoWaves`] under damping; [`Error::TooManyPieces`].
    pub fn waves(&self) -> Result<Waves<S>, Error> {
        Ok(self.ask(|engine| engine.waves(), |waves| waves.numbers())?.map(S::strip))
    }

    /// Returns the natural scales of the motion.
    pub fn scales(&self) -> Scales<S> {
        self.current().engine.scales().map(S::strip)
    }

    /// Returns a bound of the error of events and of values at ordinary times, relative to the natural scales; zero if
    /// all is exact.
    pub fn error_estimate(&self) -> f64 {
        self.current().engine.error_estimate().to_f64()
    }

    /// Returns the number of impacts, and `log₁₀` of the factor by which rounding errors may have grown over them;
    /// `None` if the engine does not track this.
    pub fn digits_lost(&self) -> Option<(u32, f64)> {
        self.current().engine.digits_lost()
    }

    /// Returns the warnings about the answer.
    pub fn warnings(&self) -> Vec<Warning> {
        let Attempt { engine, rung, .. } = self.current();
        let mut warnings = engine.warnings().to_vec();
        // The first contact is in closed form.
        let closed = engine.events().len() < 2 || matches!(engine.ending(), Ending::Undecided(Reason::MostDigits(_)));
        warnings.extend(self.plan.not_proved(rung).filter(|_| !closed));
        warnings.extend(self.problem.warnings());
        if !warnings.iter().any(|warning| matches!(warning, Warning::StrainAboveOne { .. })) {
            let peaks = engine.contacts().iter().map(|contact| contact.peak_strain.to_f64().abs());
            warnings.extend(self.problem.strain_warning(peaks.fold(0.0, f64::max)));
        }
        let mut covered = locked(&self.covered).clone();
        for engine in [&self.first.engine, &engine] {
            covered.extend(engine.covered().into_iter().flat_map(|(times, _)| times));
        }
        covered.sort_by(f64::total_cmp);
        covered.dedup();
        warnings.extend(covered.into_iter().map(|time| Warning::TimeNotTold { time }));
        let estimated = locked(&self.estimated);
        warnings.extend(estimated.iter().map(|by| Warning::EstimatedErrors { parameter: by.to_string() }));
        warnings
    }
}

type Pair<S> = Result<(<S as Answer>::Carried, <S as Answer>::Carried), Error>;

impl<S: Target> std::fmt::Debug for TypedHistory<S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { problem, plan, end, .. } = self;
        f.debug_struct("History")
            .field("problem", problem)
            .field("plan", plan)
            .field("end", end)
            .finish_non_exhaustive()
    }
}

/// Shortens two times to the text of doubles where that is shorter and still distinguishes them.
fn told_apart(found: String, end: String) -> (String, String) {
    // NaN is not a number of a scene.
    let double = |text: &String| text.parse().map(|number: Number| number.to_f64()).or(text.parse()).ok();
    let both = double(&found).zip(double(&end)).filter(|(found, end)| found != end);
    let shorter = |text: String, value: f64| if text.len() > 24 { value.to_string() } else { text };
    match both {
        Some((value, last)) => (shorter(found, value), shorter(end, last)),
        None => (found, end),
    }
}

impl Problem {
    /// Solves the problem in doubles. **Accuracy**: [`DEFAULT_ACCURACY`](crate::solve::DEFAULT_ACCURACY) of the natural
    /// scales.
    pub fn doubles(&self) -> Result<TypedHistory<f64>, Error> {
        self.answer(&Question::run(Numbers::default()))
    }

    /// Solves the problem in fractions, up to the first irrational time. **Accuracy**: *exact*.
    ///
    /// **Errors**: [`Error::DampedExact`]; [`Error::Irrational`] if a parameter is no fraction.
    pub fn exact(&self) -> Result<TypedHistory<crate::number::Rational>, Error> {
        self.answer(&Question::run(Numbers::Exact))
    }

    /// Solves the problem in decimal digits. **Accuracy**: this many digits of each number, rounded once, as
    /// [`TypedHistory::text`] prints them; the `Float` itself carries more, without a guarantee.
    ///
    /// **Errors**: [`Error::Digits`]; [`Error::Unsettled`].
    pub fn digits(&self, digits: u32) -> Result<TypedHistory<crate::number::Float>, Error> {
        self.answer(&Question::run(Numbers::Digits(digits)))
    }

    /// Solves the problem in proved decimal digits. **Accuracy**: *enclosure*.
    ///
    /// **Errors**: [`Error::Undecided`].
    pub fn certified(&self, digits: u32) -> Result<TypedHistory<crate::number::Interval>, Error> {
        self.answer(&Question::run(Numbers::Certified(digits)))
    }

    /// Solves the first contact alone, in doubles: `t_b`, impulse, peak and restitution, without the flight after it.
    pub fn first_contact(&self) -> Result<TypedHistory<f64>, Error> {
        self.answer(&Question::first_contact(Numbers::default()))
    }
}
