//! The answer in `Value`s, for every number system.

use super::derivative::{Derivative, Derivatives};
use super::finer::{Finer, digits_beyond, is_held};
use super::ladder::Target;
use super::places::Places;
use super::plan::Plan;
use super::question::{Numbers, Observer, Question, unobserved};
use super::rung::LONG;
use super::solution::{ExactnessEnd, Solution};
use super::typed::TypedHistory;
use crate::error::Error;
use crate::motion::{Contact, Ending, Energy, Event, EventKind, Field, Scales, Side, StressPiece, Waves, straight};
use crate::number::{IntoValue, List, Number, Scalar, Value};
use crate::problem::{Parameter, Problem, Written};
use crate::quantity::{
    self, Flight, Measure, Missing, Quantity, Restitution, SLICE, Slice, Table, Undefined, UnitSystem, Units,
    ValueQuery, flights,
};
use crate::reason::Warning;

/// The motion of a rod: its impacts and releases, and the values of every quantity at any time, as [`Value`]s.
///
/// All times are absolute and in the units of the problem. A time or a point is a number as it is written: `2`,
/// `"1/3"`, `0.1` (which is 1/10). A time outside `0 … end()` is [`Error::TimeOutside`], or [`Error::BeyondEnd`] and
/// [`Error::BeyondExactness`] if the history ends for a reason of its own; a point outside the rod is
/// [`Error::PointOutside`].
///
/// [`Problem::answer`] returns the same answers in one number system, for further computations.
///
/// **Accuracy**: that of the [`Plan`]. An answer is computed again with more bits if the current ones do not leave the
/// requested digits.
///
/// ```
/// use dalembert::{Problem, Value};
/// let rod = Problem::uniform(1.into(), 1.into(), 1.into(), 3.into());
/// let history = rod.solve()?;
/// // Corollary 1: μ = 3 ≥ g t₁ = 2, so the contact lasts exactly t₁ = 2L/c.
/// assert_eq!(history.contacts()?[0].release.as_ref().map(Value::to_f64), Some(2.0));
/// // d'Alembert: at t = 1/2 the wave front of the impact is at x = 1/2; below it v_x = −(μ + g(t − x))/c.
/// assert_eq!(history.at(0.25, 0.5)?.strain, -3.25);
/// # Ok::<(), dalembert::Error>(())
/// ```
#[derive(Debug)]
pub struct History {
    solution: Solution,
    exactness_end: Option<ExactnessEnd>,
    units: Units,
    finer: Finer,
}

/// Evaluates `$body` for the typed history inside `$history`, in any number system.
macro_rules! typed {
    ($history:expr, $typed:ident => $body:expr) => {
        match &$history.solution {
            Solution::Double($typed) => $body,
            Solution::Exact($typed) => $body,
            Solution::Digits($typed) => $body,
            Solution::Certified($typed) => $body,
        }
    };
}

/// Evaluates `$body` for the longer run that `$places` need, if there is one and it answers; otherwise for the typed
/// history inside `$history`.
macro_rules! typed_at {
    ($history:expr, $places:expr, $typed:ident => $body:expr) => {{
        let ladder = typed!($history, history => history.ladder());
        let mut found = None;
        if LONG && let Some(digits) = digits_beyond(ladder.plan, &$places) {
            if let Some($typed) = $history.finer.proved(ladder, digits)? {
                found = answered((|| -> Result<_, Error> { $body })());
            }
            if found.is_none()
                && let Some($typed) = $history.finer.in_digits(ladder, digits)?
            {
                found = answered((|| -> Result<_, Error> { $body })());
            }
        }
        match found {
            Some(found) => found,
            None => typed!($history, $typed => $body),
        }
    }};
}

/// Returns an answer of a longer run, or its interruption; `None` for any other error.
fn answered<T>(found: Result<T, Error>) -> Option<Result<T, Error>> {
    Some(found).filter(|found| matches!(found, Ok(_) | Err(Error::Interrupted)))
}

/// Values of quantities by row; a missing value is replaced by the reason.
pub type Rows = Vec<Vec<Result<Value, Undefined>>>;

/// All lists of a history, settled together.
#[derive(Debug)]
pub struct Listing {
    /// Kind of each event.
    pub kinds: Vec<EventKind>,
    /// A row for each impact and release, of [`Table::Events`].
    pub events: Rows,
    /// A row for each contact, of [`Table::Contacts`].
    pub contacts: Rows,
    /// A row for each flight, of [`Table::Flights`].
    pub flights: Rows,
    /// The stress at the ground; empty if it was not requested.
    pub stress: Vec<StressPiece<Value>>,
    /// A row for each piece of the stress, of [`Table::Stress`].
    pub pieces: Rows,
    /// Whether a piece of the stress was curved, before it was replaced by straight ones.
    pub is_curved: bool,
}

/// Form of the stress at the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StressForm {
    /// Linear pieces with an error of at most this fraction of the greatest stress.
    Straight(f64),
    /// Pieces with the coefficients of their Chebyshev series.
    Series,
}

impl History {
    /// Converts the values of the history to the units of `system`.
    pub fn in_units(self, system: UnitSystem) -> Self {
        let units = Units::new(self.problem(), system);
        History { units, ..self }
    }

    /// Returns the problem.
    pub fn problem(&self) -> &Problem {
        typed!(self, history => history.problem())
    }

    /// Returns the plan by which it was solved.
    pub fn plan(&self) -> &Plan {
        typed!(self, history => history.plan())
    }

    /// Returns the units of the values.
    pub fn units(&self) -> &Units {
        &self.units
    }

    /// Returns the number of digits of each value; 0 for doubles and fractions.
    pub fn digits(&self) -> u32 {
        match self.plan().numbers {
            Numbers::Digits(digits) | Numbers::Certified(digits) => digits,
            Numbers::Double(_) | Numbers::Exact | Numbers::ExactThenDigits(_) => 0,
        }
    }

    /// Returns the event or parameter that fractions cannot hold, if digits of the whole run replace the fractions.
    pub fn exactness_end(&self) -> Option<&ExactnessEnd> {
        self.exactness_end.as_ref()
    }

    /// Returns the last known time: before an event at an irrational time, a fraction just below it.
    pub fn end(&self) -> Value {
        typed!(self, history => self.value(history.carried_end(), Some(Measure::Time)))
    }

    /// Returns the reason of the end.
    pub fn ending(&self) -> &Ending {
        typed!(self, history => history.ending())
    }

    /// Returns the warnings that come with the answer.
    pub fn warnings(&self) -> Vec<Warning> {
        typed!(self, history => history.warnings())
    }

    /// Returns the number of impacts, and `log₁₀` of the factor by which rounding errors may have grown over them;
    /// `None` if the engine does not track this.
    pub fn digits_lost(&self) -> Option<(u32, f64)> {
        typed!(self, history => history.digits_lost())
    }

    /// Returns the natural scales of the motion.
    pub fn scales(&self) -> Scales<f64> {
        typed!(self, history => history.carried_scales().map(|scale| Scalar::to_f64(&scale)))
    }

    /// Returns a bound of the error of events and of values at ordinary times, relative to the natural scales; zero if
    /// all is exact.
    pub fn error_estimate(&self) -> f64 {
        typed!(self, history => history.error_estimate())
    }

    /// Returns `error` with the reason why the history ends before the requested time.
    pub fn explained(&self, error: Error) -> Error {
        typed!(self, history => history.explained(error))
    }

    /// Returns the result of `query` for the history in doubles, which solves the same run again if it is in other
    /// numbers: for pictures and other uses that need no more.
    ///
    /// **Errors**: those of [`Plan::solve`].
    ///
    /// ```
    /// use dalembert::{Numbers, Problem};
    /// let rod = Problem::builder().length(1).wave_speed(1).impact_speed(1).build()?;
    /// // A rod without gravity leaves the ground after a round trip 2L/c.
    /// let history = rod.solve_in(Numbers::Exact)?;
    /// assert_eq!(history.in_doubles(|history| history.contacts()[0].release)?, Some(2.0));
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn in_doubles<T>(&self, query: impl FnOnce(&TypedHistory<f64>) -> T) -> Result<T, Error> {
        if let Solution::Double(history) = &self.solution {
            return Ok(query(history));
        }
        let plan = self.plan().in_numbers(self.problem(), Numbers::default());
        Ok(query(&TypedHistory::solve(self.problem(), &plan, unobserved())?))
    }

    /// Returns all impacts and releases, in order. A rod that stands on the ground has its first impact at `t = 0`.
    pub fn events(&self) -> Result<Vec<Event<Value>>, Error> {
        typed!(self, history => {
            let events = history.ask(|motion| Ok(motion.events().to_vec()), |events| {
                events.iter().flat_map(Event::numbers).collect()
            })?;
            Ok(events.into_iter().map(|event| Event {
                kind: event.kind,
                t: self.value(event.t, Some(Measure::Time)),
                v_end: self.value(event.v_end, Some(Measure::Velocity)),
                h: self.value(event.h, Some(Measure::Length)),
                h_rate: self.value(event.h_rate, Some(Measure::Velocity)),
                t_error: event.t_error,
            }).collect())
        })
    }

    /// Returns all contacts, in order; the impulse is in the units of the history.
    pub fn contacts(&self) -> Result<Vec<Contact<Value>>, Error> {
        typed!(self, history => {
            let contacts = history.ask(|motion| Ok(motion.contacts().to_vec()), |contacts| {
                contacts.iter().flat_map(Contact::numbers).collect()
            })?;
            let scales = history.carried_scales();
            Ok(contacts.into_iter().map(|contact| Contact {
                impact: self.value(contact.impact, Some(Measure::Time)),
                release: contact.release.map(|release| self.value(release, Some(Measure::Time))),
                impulse: self.quantity(Quantity::ContactImpulse, contact.impulse, &scales),
                peak_strain: self.value(contact.peak_strain, Some(Measure::Strain)),
            }).collect())
        })
    }

    /// Returns the flights between the contacts, and their highest points.
    pub fn flights(&self) -> Result<Vec<Flight<Value>>, Error> {
        typed!(self, history => {
            let found = history.ask(flights, |flights| Flight::numbers(flights))?;
            Ok(found.into_iter().map(|flight| flight.map(|x| self.value(x, None))).collect())
        })
    }

    /// Returns `e_P` and `e_E²` of a contact, counted from 0.
    ///
    /// **Errors**: [`Error::NoContact`] if the history has fewer contacts.
    pub fn restitution(&self, contact: usize) -> Result<Restitution<Value>, Error> {
        typed!(self, history => Ok(history.carried_restitution(contact)?.map(|x| self.value(x, None))))
    }

    /// Returns `v_x(0,t)`: the strain at the ground.
    pub fn strain(&self, time: impl Into<Written>, side: Side) -> Result<Value, Error> {
        self.at_time(Quantity::Strain, time, side)
    }

    /// Returns a time-dependent quantity at one time.
    pub fn at_time(&self, quantity: Quantity, time: impl Into<Written>, side: Side) -> Result<Value, Error> {
        let time = written("time", time)?;
        let mut columns = self.sample(&[quantity], &Places::from(&time), Some(side))?;
        Ok(columns.remove(0).remove(0))
    }

    /// Returns `v`, `v_t`, `v_x` at `(x,t)`; on a ray, the limit from later times.
    pub fn at(&self, point: impl Into<Written>, time: impl Into<Written>) -> Result<Field<Value>, Error> {
        let (point, time) = (written("point", point)?, written("time", time)?);
        let [displacement, velocity, strain] =
            self.sample_pairs(&Places::from(&point), &Places::from(&time), Side::Right)?.map(|mut list| list.remove(0));
        Ok(Field { displacement, velocity, strain })
    }

    /// Returns `E`, `E_h`, `E_z` at a time, in the units of the history.
    pub fn energy(&self, time: impl Into<Written>) -> Result<Energy<Value>, Error> {
        let time = written("time", time)?;
        let quantities = [Quantity::Energy, Quantity::TranslationalEnergy, Quantity::VibrationalEnergy];
        let columns = self.sample(&quantities, &Places::from(&time), Some(Side::Right))?;
        let [total, translational, vibrational] = [0, 1, 2].map(|k| columns[k][0].clone());
        Ok(Energy { total, translational, vibrational })
    }

    /// Returns the values of `quantities` over time, column by column. If `side` is `None`, a time at which the two
    /// limits of any quantity differ has two rows, the limit from earlier times first.
    ///
    /// **Accuracy**: that of the [`Plan`], each column by itself.
    ///
    /// **Errors**: [`Error::NotOverTime`]; the errors of a time outside the history.
    pub fn sample(
        &self,
        quantities: &[Quantity],
        times: &Places<'_>,
        side: Option<Side>,
    ) -> Result<Vec<Vec<Value>>, Error> {
        self.in_parts(times, |times| {
            typed_at!(self, [times], history => {
                let columns = history.ask_columns_in(&self.units, quantities, side, |motion| times.lift(motion))?;
                let column = |(quantity, column): (&Quantity, Vec<_>)| {
                    let unit = quantity.unit(&self.units);
                    column.into_iter().map(|x| self.printed(x, unit)).collect()
                };
                Ok(quantities.iter().zip(columns).map(column).collect())
            })
        })
    }

    /// Asks about times that the numbers of the history hold and about longer ones apart, so that only these take
    /// longer runs, and returns the columns of all.
    fn in_parts(
        &self,
        times: &Places<'_>,
        ask: impl Fn(&Places<'_>) -> Result<Vec<Vec<Value>>, Error>,
    ) -> Result<Vec<Vec<Value>>, Error> {
        let mut columns: Vec<Vec<Value>> = Vec::new();
        for part in times.parted(|number| is_held(self.plan(), number)) {
            let found = ask(&part)?;
            if columns.is_empty() {
                columns = found;
            } else {
                columns.iter_mut().zip(found).for_each(|(column, found)| column.extend(found));
            }
        }
        Ok(columns)
    }

    /// Returns `t`, `side`, `x`, `u`, `v`, `strain` (see [`SLICE`]) on the grid `points` at every time of `times`,
    /// column by column: values at the points, means over the cells between them, or nodal values of a projection.
    ///
    /// **Accuracy**: that of the [`Plan`], each column by itself.
    ///
    /// **Errors**: [`Error::Grid`].
    pub fn sample_field(
        &self,
        slice: Slice,
        points: &Places<'_>,
        times: &Places<'_>,
        side: Option<Side>,
    ) -> Result<Vec<Vec<Value>>, Error> {
        self.sample_along(&SLICE, slice, points, times, side)
    }

    /// Returns the values of `quantities` along the rod, column by column: each is one of [`SLICE`] or
    /// [`Quantity::PointStress`]. The grid is that of [`History::sample_field`].
    pub fn sample_along(
        &self,
        quantities: &[Quantity],
        slice: Slice,
        points: &Places<'_>,
        times: &Places<'_>,
        side: Option<Side>,
    ) -> Result<Vec<Vec<Value>>, Error> {
        let is_along = |quantity: &Quantity| SLICE.contains(quantity) || *quantity == Quantity::PointStress;
        if let Some(quantity) = quantities.iter().find(|quantity| !is_along(quantity)) {
            return Err(Error::NotAlong { quantity: quantity.name() });
        }
        self.in_parts(times, |times| typed_at!(self, [points, times], history => {
            let columns = history.ask_slices(slice, side, |motion| Ok((points.lift(motion)?, times.lift(motion)?)))?;
            let scales = history.carried_scales();
            let column = |quantity: &Quantity| {
                let place = SLICE.iter().position(|known| known == quantity).unwrap_or(SLICE.len() - 1);
                columns[place].iter().map(|x| self.quantity(*quantity, x.clone(), &scales)).collect()
            };
            Ok(quantities.iter().map(column).collect())
        }))
    }

    /// Returns `u`, `v`, `strain` at pairs of a point and a time, column by column.
    pub fn sample_pairs(&self, points: &Places<'_>, times: &Places<'_>, side: Side) -> Result<[Vec<Value>; 3], Error> {
        typed_at!(self, [points, times], history => {
            let fields = history.ask(
                |motion| {
                    let (points, times) = (points.lift(motion)?, times.lift(motion)?);
                    points.iter().zip(&times).map(|(x, t)| motion.field(x, t, side)).collect::<Result<Vec<_>, _>>()
                },
                |fields| fields.iter().flat_map(Field::numbers).collect(),
            )?;
            let mut columns = [Vec::new(), Vec::new(), Vec::new()];
            for field in fields {
                columns[0].push(self.value(field.displacement, Some(Measure::Length)));
                columns[1].push(self.value(field.velocity, Some(Measure::Velocity)));
                columns[2].push(self.value(field.strain, Some(Measure::Strain)));
            }
            Ok(columns)
        })
    }

    /// Returns the values of `quantities` of one kind for each event, contact, flight or piece of the stress.
    pub fn list(&self, quantities: &[Quantity]) -> Result<Rows, Error> {
        typed!(self, history => {
            let rows = history.ask(|motion| quantity::rows(motion, quantities), |rows| {
                rows.iter().flatten().filter_map(|value| value.as_ref().ok()).collect()
            })?;
            Ok(self.rows(quantities, rows, &history.carried_scales()))
        })
    }

    /// Returns all lists, settled together: the accuracy of each number is relative to the greatest of all. `ratios`
    /// states whether numbers without a unit are settled too. `stress` states the form of the stress at the ground,
    /// which can cost more than all other lists.
    pub fn listing(&self, stress: Option<StressForm>, ratios: bool) -> Result<Listing, Error> {
        typed!(self, history => {
            let lists = [Table::Events, Table::Contacts, Table::Flights].map(Table::quantities);
            let (_, rows, curve, kinds) = history.ask(
                |motion| {
                    let [events, contacts, flights] = lists.map(|quantities| quantity::rows(motion, quantities));
                    let rows = [events?, contacts?, flights?];
                    let curve = if stress.is_some() { motion.stress_pieces() } else { Vec::new() };
                    let kinds: Vec<EventKind> = motion.events().iter().map(|event| event.kind).collect();
                    Ok((motion.end(), rows, curve, kinds))
                },
                |(end, rows, curve, _)| {
                    let settled = |quantity: &Quantity| ratios || quantity.measure().is_some();
                    let listed = rows.iter().zip(lists).flat_map(|(rows, quantities)| {
                        rows.iter().flat_map(move |row| row.iter().zip(quantities))
                    });
                    let listed = listed.filter(|(_, quantity)| settled(quantity));
                    let listed = listed.filter_map(|(value, _)| value.as_ref().ok());
                    std::iter::once(end).chain(listed).chain(StressPiece::numbers(curve)).collect()
                },
            )?;
            let scales = history.carried_scales();
            let [events, contacts, flights] = rows;
            let is_curved = curve.iter().any(|piece| piece.chebyshev.len() > 2);
            let curve = match stress {
                Some(StressForm::Straight(part)) => straight(&curve, part),
                _ => curve,
            };
            let piece = |StressPiece { start, end, strain_start, strain_end, .. }: &StressPiece<_>| {
                [start, end, strain_start, strain_end, strain_start, strain_end].map(|x: &_| Ok(Clone::clone(x))).into()
            };
            let pieces = curve.iter().map(piece).collect();
            Ok(Listing {
                kinds,
                pieces: self.rows(Table::Stress.quantities(), pieces, &scales),
                events: self.rows(lists[0], events, &scales),
                contacts: self.rows(lists[1], contacts, &scales),
                flights: self.rows(lists[2], flights, &scales),
                stress: curve
                    .into_iter()
                    .map(|piece| piece.with_own_coefficients().map(|x| self.value(x, None)))
                    .collect(),
                is_curved,
            })
        })
    }

    /// Returns the whole solution as two travelling waves: a piecewise quadratic function of one variable.
    ///
    /// **Errors**: [`Error::NoWaves`] under damping; [`Error::TooManyPieces`].
    pub fn waves(&self) -> Result<Waves<Value>, Error> {
        typed!(self, history => {
            let waves = history.ask(|motion| motion.waves(), |waves| waves.numbers())?;
            Ok(waves.map(|x| self.value(x, None)))
        })
    }

    /// Returns one number, or the reason of its absence.
    pub fn query(&self, query: &ValueQuery) -> Result<Result<Value, Missing>, Error> {
        let [point, time] = [&query.point, &query.time].map(|number| List::Numbers(number.iter().cloned().collect()));
        typed_at!(self, [&Places::from(&point), &Places::from(&time)], history => {
            let run = self.problem().run();
            let found = history.ask(
                |motion| query.evaluate(motion, &self.units, run),
                |found| found.iter().map(|[_, plain]| plain).collect(),
            )?;
            Ok(found.map(|[value, _]| self.value(value, query.quantity.measure())))
        })
    }

    /// Returns the derivatives of `quantities` of one kind by `parameter`, for each event, contact or flight: see
    /// [`TypedHistory::derivatives`].
    pub fn derivatives(&self, parameter: Parameter, quantities: &[Quantity]) -> Result<Derivatives<Value>, Error> {
        typed!(self, history => Ok(self.erased(history.derivatives(parameter, quantities)?)))
    }

    /// Returns the derivatives of `quantities` by `parameter` at `times`, and at `points` for quantities along the rod:
    /// see [`TypedHistory::derivatives_at`].
    pub fn derivatives_at(
        &self,
        parameter: Parameter,
        quantities: &[Quantity],
        times: &[Number],
        points: &[Number],
        side: Side,
    ) -> Result<Derivatives<Value>, Error> {
        typed!(self, history => Ok(self.erased(history.derivatives_at(parameter, quantities, times, points, side)?)))
    }

    fn value(&self, number: impl IntoValue, measure: Option<Measure>) -> Value {
        let unit = measure.map_or("", |measure| self.units.name(measure));
        self.printed(number, unit)
    }

    fn printed(&self, number: impl IntoValue, unit: &'static str) -> Value {
        let value = number.into();
        let value = match self.solution {
            Solution::Double(_) => value.to_double(),
            // A proved run has answered for a time of more digits.
            Solution::Digits(_) => value.without_ends(),
            Solution::Exact(_) | Solution::Certified(_) => value,
        };
        value.printed_in(self.digits(), unit)
    }

    /// Returns the value of a quantity from its `number` without a unit.
    fn quantity<S: IntoValue>(&self, quantity: Quantity, number: S, scales: &Scales<S>) -> Value {
        let number = quantity.in_unit(number, scales, &self.units);
        self.printed(number, quantity.unit(&self.units))
    }

    fn rows<S: IntoValue>(&self, quantities: &[Quantity], rows: Vec<quantity::Row<S>>, scales: &Scales<S>) -> Rows {
        let value = |(value, quantity): (Result<S, Undefined>, &Quantity)| {
            value.map(|number| self.quantity(*quantity, number, scales))
        };
        rows.into_iter().map(|row| row.into_iter().zip(quantities).map(value).collect()).collect()
    }

    fn erased<S: IntoValue>(&self, rows: Derivatives<S>) -> Derivatives<Value> {
        let value = |found: Derivative<S>| found.map(|x| self.value(x, None));
        rows.into_iter().map(|row| row.into_iter().map(|found| found.map(value)).collect()).collect()
    }
}

/// Parses the number that `text` spells, as a list.
fn written(quantity: &'static str, text: impl Into<Written>) -> Result<List, Error> {
    match text.into().number() {
        Ok(number) => Ok(List::Numbers(vec![number.clone()])),
        Err(error) => Err(Error::Spelling { quantity, error: error.clone() }),
    }
}

impl Plan {
    /// Solves `problem`; see [`Observer`] for what `observe` receives.
    ///
    /// **Accuracy**: that of [`Plan::numbers`].
    ///
    /// **Errors**: [`Error::TooManyPieces`]; [`Error::Irrational`] if a parameter is irrational and no digits are
    /// requested; [`Error::Unsettled`], [`Error::Undecided`] if no affordable number of bits settles the answer;
    /// [`Error::Interrupted`] by `observe`.
    ///
    /// ```
    /// use dalembert::{Numbers, Plan, Problem, Question, Value};
    /// use std::{ops::ControlFlow, sync::Arc};
    /// let problem = Problem::uniform(10.into(), 30.into(), 10.into(), 10.into());
    /// let plan = Plan::of(&problem, &Question::run(Numbers::Exact))?;
    /// let history = plan.solve(&problem, Arc::new(|_, _| ControlFlow::Continue(())))?;
    /// assert_eq!(history.contacts()?[0].release.as_ref().map(Value::to_string), Some("2/3".into()));
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn solve(&self, problem: &Problem, observe: Observer) -> Result<History, Error> {
        let (solution, exactness_end) = self.solution(problem, observe)?;
        let (units, finer) = (Units::new(problem, UnitSystem::default()), Finer::default());
        Ok(History { solution, exactness_end, units, finer })
    }
}

impl Problem {
    /// Solves the problem in doubles. **Accuracy**: [`DEFAULT_ACCURACY`](crate::solve::DEFAULT_ACCURACY) of the natural
    /// scales.
    pub fn solve(&self) -> Result<History, Error> {
        self.solve_in(Numbers::default())
    }

    /// Solves the problem in `numbers`.
    ///
    /// **Errors**: those of [`Plan::solve`].
    pub fn solve_in(&self, numbers: Numbers) -> Result<History, Error> {
        self.ask(&Question::run(numbers), unobserved())
    }

    /// Solves the problem as far as `question` needs; see [`Observer`] for what `observe` receives.
    pub fn ask(&self, question: &Question, observe: Observer) -> Result<History, Error> {
        Plan::of(self, question)?.solve(self, observe)
    }

    /// Solves the problem as far as `question` needs, in the number system `S`.
    pub fn answer<S: Target>(&self, question: &Question) -> Result<TypedHistory<S>, Error> {
        TypedHistory::solve(self, &Plan::of(self, question)?, unobserved())
    }
}
