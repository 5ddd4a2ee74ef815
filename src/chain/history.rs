//! A solved chain: answers as [`Value`]s, in numbers that are long enough for each of them.

use std::fmt;
use std::sync::{Arc, Mutex, OnceLock};

use super::answers::{Answers, ChainTime, run};
use super::column::{ChainColumn, ChainContactQuantity, ChainQuantity};
use super::definition::Chain;
use super::listing::{ChainListing, Judged, piece_numbers};
use super::numbers::{ChainNumbers, NumberRows};
use super::run::{ChainEvent, ForcePiece};
use super::scales::Scales;
use crate::error::Error;
use crate::motion::{Ending, Field, Side};
use crate::number::{Number, Open, Value, bits_for_digits};
use crate::problem::Parameter;
use crate::quantity::Measure;
use crate::reason::Warning;
use crate::solve::chain::EXACT_PIECES;
use crate::solve::rung::rungs;
use crate::solve::{DEFAULT_ACCURACY, Numbers, Observer, Rung};
use crate::threads::locked;

/// A row of numbers of a chain at a time.
#[derive(Clone, Debug)]
pub struct ChainRow {
    /// Limit that the numbers are; `None` where both limits are the same.
    pub side: Option<Side>,
    /// The numbers.
    pub values: Vec<Value>,
}

/// Returns a row for the limit from `side`; without one, a row that both limits have, or two.
fn rows(side: Option<Side>, values: impl Fn(Side) -> Result<Vec<Value>, Error>) -> Result<Vec<ChainRow>, Error> {
    let row = |side: Side, values: Vec<Value>| ChainRow { side: Some(side), values };
    if let Some(side) = side {
        return Ok(vec![row(side, values(side)?)]);
    }
    let [left, right] = [values(Side::Left)?, values(Side::Right)?];
    if left.iter().zip(&right).all(|(left, right)| left.agrees(right)) {
        return Ok(vec![ChainRow { side: None, values: right }]);
    }
    Ok(vec![row(Side::Left, left), row(Side::Right, right)])
}

/// Share of the natural scale from which on the size of a number decides whether its bound is small enough.
const FAINT: f64 = 1e-6;
/// Bits beyond those of the digits of a time, which tell it from an event beside it.
const GUARD: u32 = 16;

type Attempt = OnceLock<Result<Box<dyn Answers>, Error>>;

/// A solved chain.
///
/// Each answer comes from the first attempt whose bound is small enough: doubles, fractions, longer numbers, or
/// enclosures with exact roots where events coincide within their bounds.
///
/// **Accuracy**: that of the [`Numbers`]: *within its bound* for doubles and digits, *exact* for fractions, *enclosure*
/// for proved digits.
///
/// ```
/// use dalembert::Numbers;
/// use dalembert::chain::{Body, Chain, ChainColumn};
/// // OpenFOAM's bars of E = 49 and 100: f = 7/170 until the wave returns from the softer one.
/// let number = |text: &str| text.parse::<dalembert::Number>();
/// let bar = |modulus: i64| Ok::<_, dalembert::number::NumberError>(
///     Body::elastic(10.into(), modulus.into(), number("0.01")?, 1.into()));
/// let chain = Chain::builder(bar(49)?.with_velocity(number("0.1")?))
///     .contact(number("0.01")?, bar(100)?)
///     .until(number("0.5")?)
///     .build()?;
/// let exact = chain.solve(Numbers::Exact)?;
/// assert_eq!(exact.listing()?.contacts[0].peak.to_string(), "7/170");
/// assert_eq!(exact.listing()?.events[1].t.to_string(), "27/70");
/// let doubles = chain.solve(Numbers::default())?;
/// let force = ChainColumn::read("force.1", &chain).ok_or("no such joint")?;
/// let value = doubles.value(force, &number("0.2")?, dalembert::Side::Right)?;
/// assert!((value.to_f64() - 7.0 / 170.0).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct ChainHistory {
    chain: Chain,
    numbers: Numbers,
    observe: Observer,
    attempts: Vec<(Rung, Attempt)>,
    /// Whether each attempt has the events of the listing.
    agreeing: Vec<OnceLock<bool>>,
    scales: Scales,
    listed: OnceLock<Result<Listed, Error>>,
    /// The values by which derivatives have errors that are estimates.
    estimated: Mutex<Vec<Parameter>>,
}

/// Events, contacts and forces.
struct Listed {
    listing: Arc<ChainListing>,
    /// The first time of a decision that the attempt leaves open.
    doubt: Option<f64>,
}

impl fmt::Debug for ChainHistory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ChainHistory")
            .field("chain", &self.chain)
            .field("numbers", &self.numbers)
            .finish_non_exhaustive()
    }
}

impl Chain {
    /// Solves the chain in `numbers`.
    ///
    /// **Errors**: [`Error::TooManyPieces`]; [`Error::Irrational`] if fractions cannot hold a parameter;
    /// [`Error::Accuracy`]; [`Error::Digits`].
    pub fn solve(&self, numbers: Numbers) -> Result<ChainHistory, Error> {
        self.solve_observed(numbers, crate::solve::unobserved())
    }

    /// Checks that a run in these numbers is possible.
    ///
    /// **Errors**: [`Error::Accuracy`]; [`Error::Digits`]; [`Error::SoftExact`] for springs, dashpots or masses in
    /// fractions.
    pub fn check_numbers(&self, numbers: Numbers) -> Result<(), Error> {
        numbers.check()?;
        if self.is_soft() && numbers == Numbers::Exact { Err(Error::SoftExact) } else { Ok(()) }
    }

    /// Solves the chain as [`Chain::solve`] does; `observe` receives the number of events and of wave pieces.
    pub fn solve_observed(&self, numbers: Numbers, observe: Observer) -> Result<ChainHistory, Error> {
        self.check_numbers(numbers)?;
        let is_possible = |rung: &Rung| !(self.is_soft() && *rung == Rung::Fractions);
        let attempts = rungs(numbers).into_iter().filter(is_possible).map(|rung| (rung, Attempt::new()));
        let attempts: Vec<_> = attempts.collect();
        let agreeing = attempts.iter().map(|_| OnceLock::new()).collect();
        let (scales, listed) = (self.scales(), OnceLock::new());
        let (chain, estimated) = (self.clone(), Mutex::default());
        let history = ChainHistory { chain, numbers, observe, attempts, agreeing, scales, listed, estimated };
        history.attempt(0).map(|_| ()).or_else(|error| match error {
            Error::Irrational { .. } if history.attempts.len() > 1 => Ok(()),
            error => Err(error),
        })?;
        Ok(history)
    }
}

impl ChainHistory {
    /// Returns the chain.
    pub fn chain(&self) -> &Chain {
        &self.chain
    }

    pub(crate) fn numbers(&self) -> Numbers {
        self.numbers
    }

    pub(crate) fn observer(&self) -> &Observer {
        &self.observe
    }

    /// Keeps for [`ChainHistory::warnings`] that the errors of derivatives are estimates.
    pub(crate) fn note_estimates(&self, by: Parameter) {
        let mut estimated = locked(&self.estimated);
        if !estimated.contains(&by) {
            estimated.push(by);
        }
    }

    /// Returns events, contacts and forces.
    ///
    /// **Errors**: the errors of the runs.
    pub fn listing(&self) -> Result<Arc<ChainListing>, Error> {
        self.listed().map(|listed| listed.listing.clone())
    }

    /// Returns the reason of the end, by the attempt that gives the listing.
    ///
    /// **Errors**: the errors of the runs.
    pub fn ending(&self) -> Result<Ending, Error> {
        self.listed().map(|listed| listed.listing.ending.clone())
    }

    fn listed(&self) -> Result<&Listed, Error> {
        let peaks = !self.chain.is_soft();
        let list = || {
            let query = |run: &dyn Answers| Ok((run.listing(), run.doubt()));
            let (listing, doubt) = self.settled(0, query, |(listing, _)| listing.numbers(peaks))?;
            Ok(Listed { listing: Arc::new(listing.map(|value| self.printed(value))), doubt })
        };
        self.listed.get_or_init(list).as_ref().map_err(Clone::clone)
    }

    /// Returns whether a run that leaves a decision open has the events of the listing, whose attempt leaves one open
    /// too. Both are then right within their bounds under the same condition.
    fn agrees(&self, k: usize, run: &dyn Answers) -> bool {
        let Some(Ok(Listed { listing, doubt: Some(_) })) = self.listed.get() else { return false };
        if listing.ending != Ending::Time {
            return false;
        }
        let is_same = |(a, b): (&ChainEvent<Value>, &ChainEvent<Value>)| {
            let [t, other] = [&a.t, &b.t].map(Value::to_f64);
            let known = a.t.bound().to_f64() + b.t.bound().to_f64() + 4.0 * f64::EPSILON * t.abs();
            a.kind == b.kind && a.node == b.node && (t - other).abs() <= known
        };
        *self.agreeing[k].get_or_init(|| {
            let events = run.listing().events;
            *run.ending() == Ending::Time
                && events.len() == listing.events.len()
                && events.iter().zip(&listing.events).all(is_same)
        })
    }

    /// Finds the listing where the first attempt leaves a decision open, so that attempts are held against it.
    fn decide(&self) {
        if self.attempt(0).is_ok_and(|run| run.doubt().is_some()) {
            // An error of the listing is that of the query too.
            let _ = self.listed();
        }
    }

    /// Returns the value of a column at a time; at a jump, the limit from `side`. If no attempt tells the time from
    /// that of a jump, the bound covers both limits.
    ///
    /// **Errors**: [`Error::TimeOutside`]; [`Error::Problem`] for a column of another chain.
    pub fn value(&self, column: ChainColumn, time: &Number, side: Side) -> Result<Value, Error> {
        self.value_at(column, ChainTime::Spelled(time), side)
    }

    /// Returns the value of a column at an event of the [`listing`](ChainHistory::listing); at a jump, the limit from
    /// `side`, or both where no attempt tells the event from another jump. A jump that agrees with the event to
    /// 19 digits within the bounds of both is at the event.
    ///
    /// **Errors**: [`Error::Open`] if no attempt has this event.
    ///
    /// ```
    /// use dalembert::chain::{Body, Chain, ChainColumn};
    /// use dalembert::{Numbers, Side};
    /// let bar = |velocity: i64| Body::new(1.into(), 1.into(), 1.into()).with_velocity(velocity.into());
    /// let chain = Chain::builder(bar(0)).contact(1.into(), bar(-1)).until(4.into()).build()?;
    /// let history = chain.solve(Numbers::Exact)?;
    /// let force = ChainColumn::read("force.1", &chain).ok_or("no such joint")?;
    /// let at = |side: Side| history.value_at_event(force, 0, side).map(|force| force.to_string());
    /// assert_eq!([at(Side::Left)?, at(Side::Right)?], ["0", "1/2"]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn value_at_event(&self, column: ChainColumn, event: usize, side: Side) -> Result<Value, Error> {
        self.value_at(column, ChainTime::Event(event), side)
    }

    /// Returns a row of the values of columns at a time for the limit from `side`; without one, a row that both limits
    /// have or, where they differ, that from the left and that from the right.
    ///
    /// **Errors**: those of [`ChainHistory::value`] and [`ChainHistory::value_at_event`].
    ///
    /// ```
    /// use dalembert::chain::{Body, Chain, ChainColumn, ChainTime};
    /// use dalembert::Numbers;
    /// let bar = |velocity: i64| Body::new(1.into(), 1.into(), 1.into()).with_velocity(velocity.into());
    /// let chain = Chain::builder(bar(0)).contact(1.into(), bar(-1)).until(4.into()).build()?;
    /// let history = chain.solve(Numbers::Exact)?;
    /// let force = ChainColumn::list("force.1", &chain);
    /// let rows = history.rows_at(&force, ChainTime::Event(0), None)?;
    /// assert_eq!(rows.iter().map(|row| row.values[0].to_string()).collect::<Vec<_>>(), ["0", "1/2"]);
    /// assert_eq!(history.rows_at(&force, ChainTime::Spelled(&2.into()), None)?.len(), 1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn rows_at(
        &self,
        columns: &[ChainColumn],
        time: ChainTime<'_>,
        side: Option<Side>,
    ) -> Result<Vec<ChainRow>, Error> {
        rows(side, |side| columns.iter().map(|column| self.value_at(*column, time, side)).collect())
    }

    /// Returns a row of displacement, velocity and strain of each body at its point, as [`ChainHistory::rows_at`] does.
    ///
    /// **Errors**: those of [`ChainHistory::field`].
    pub fn field_rows_at(
        &self,
        bodies: &[usize],
        (point, time): (&Number, &Number),
        side: Option<Side>,
    ) -> Result<Vec<ChainRow>, Error> {
        let numbers = |body: &usize, side| Ok(self.field(*body, point, time, side)?.numbers().map(Value::clone));
        rows(side, |side| {
            Ok(bodies.iter().map(|body| numbers(body, side)).collect::<Result<Vec<_>, Error>>()?.concat())
        })
    }

    /// Returns a number of the contact of a node with this index, counted from 0.
    ///
    /// **Errors**: [`Error::NoContact`] if the node has fewer contacts; [`Error::ContactLasts`] for the end of one that
    /// lasts, and for impulse and peak of one that goes on beyond the end of a history that stops early; the errors of
    /// the runs.
    pub fn contact_value(&self, node: usize, quantity: ChainContactQuantity, contact: usize) -> Result<Value, Error> {
        let listing = self.listing()?;
        let mut of_node = listing.contacts.iter().filter(|contact| contact.node == node);
        let found = of_node.clone().count();
        let found = of_node.nth(contact).ok_or(Error::NoContact { contact, found })?;
        let is_known = quantity == ChainContactQuantity::Impact || listing.is_settled(found);
        quantity.of(found).filter(|_| is_known).cloned().ok_or(Error::ContactLasts { contact })
    }

    /// Returns the pieces of the compressive force of a node, in order and without a gap: lines, and where springs,
    /// dashpots or masses bend them, Chebyshev series.
    ///
    /// **Errors**: the errors of the runs.
    ///
    /// ```
    /// use dalembert::Numbers;
    /// use dalembert::chain::{Body, Chain, End};
    /// // A mass of 1 that strikes a rod with Z = 1 pushes with e^(−t).
    /// let mass = Body::rigid(1.into()).with_velocity((-1).into());
    /// let rod = Body::new(1.into(), 1.into(), 1.into());
    /// let chain = Chain::builder(rod).contact(0.into(), mass).bottom(End::Velocity(Vec::new())).until(1.into());
    /// let piece = chain.build()?.solve(Numbers::default())?.force_pieces(1)?.swap_remove(0);
    /// // T_k(0) is 1, 0, −1, 0, …
    /// let terms = piece.series.iter().zip([1.0, 0.0, -1.0, 0.0].iter().cycle());
    /// let middle: f64 = terms.map(|(c, t)| c.to_f64() * t).sum();
    /// assert!((middle - (-piece.end.to_f64() / 2.0).exp()).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn force_pieces(&self, node: usize) -> Result<Vec<ForcePiece<Value>>, Error> {
        ChainColumn { quantity: ChainQuantity::Force, place: node }.check(&self.chain)?;
        let pieces = self.settled(0, |run| Ok(run.forces(node)), |pieces| piece_numbers(pieces).collect())?;
        Ok(pieces.into_iter().map(|piece| piece.map(|value| self.printed(value))).collect())
    }

    /// Returns a time as a number of the answers.
    ///
    /// **Errors**: the errors of the runs.
    pub fn time(&self, time: &Number) -> Result<Value, Error> {
        let value = self.settled(0, |run| run.time(ChainTime::Spelled(time)), |time| vec![(time, Measure::Time)])?;
        Ok(self.printed(value))
    }

    fn value_at(&self, column: ChainColumn, time: ChainTime<'_>, side: Side) -> Result<Value, Error> {
        column.check(&self.chain)?;
        self.decide();
        let value = self.settled(
            time.digits(),
            |run| run.column(column, time, side),
            |value| vec![(value, column.quantity.measure())],
        )?;
        Ok(self.printed(value))
    }

    /// Returns displacement, velocity and strain of a body at its point; on a ray, the limit in time from `side`. If no
    /// attempt tells the point from a ray, the bounds cover both limits.
    ///
    /// **Errors**: [`Error::TimeOutside`], [`Error::PointOutside`]; [`Error::Problem`] for a body that there is not.
    pub fn field(&self, body: usize, point: &Number, time: &Number, side: Side) -> Result<Field<Value>, Error> {
        fn judged(field: &Field<Value>) -> Vec<Judged<'_>> {
            field.numbers().into_iter().zip([Measure::Length, Measure::Velocity, Measure::Strain]).collect()
        }
        self.chain.check_body(body)?;
        self.decide();
        let digits = point.written_digits().max(time.written_digits());
        let field = self.settled(digits, |run| run.field(body, point, time, side), judged)?;
        Ok(field.map(|value| self.printed(value)))
    }

    /// Returns numbers that are asked for together, in the numbers of the attempt that settles them.
    pub(crate) fn rows(&self, numbers: ChainNumbers<'_>) -> Result<NumberRows<Value>, Error> {
        self.decide();
        let measures = numbers.measures();
        let digits = numbers.times().iter().chain(numbers.points()).map(Number::written_digits).max().unwrap_or(0);
        self.settled(
            digits,
            |run| run.rows(numbers),
            |rows| {
                let cells = rows.iter().flat_map(|row| row.iter().zip(&measures));
                cells.filter_map(|(value, measure)| Some((value.as_ref()?, *measure))).collect()
            },
        )
    }

    /// Returns the number of wave pieces of the first attempt that reaches its end.
    pub fn pieces(&self) -> usize {
        self.reached().map_or(0, |run| run.pieces())
    }

    /// Returns the warnings: of events that even the last attempt does not tell apart, of strains above one, and of
    /// derivatives whose errors are estimates.
    pub fn warnings(&self) -> Vec<Warning> {
        let estimated = locked(&self.estimated);
        let estimated = estimated.iter().map(|by| Warning::EstimatedErrors { parameter: by.to_string() });
        self.coincidence().into_iter().chain(self.chain.strain_warning()).chain(estimated).collect()
    }

    fn coincidence(&self) -> Option<Warning> {
        let runs = || self.attempts.iter().filter_map(|(_, attempt)| attempt.get()?.as_deref().ok());
        let doubtful = runs().all(|run| !is_whole(run));
        let from = runs()
            .filter_map(|run| run.doubt())
            .fold(None, |least: Option<f64>, t| Some(least.map_or(t, |l| l.min(t))));
        from.filter(|_| doubtful).map(|from| Warning::Coincidence { from })
    }

    fn reached(&self) -> Option<&dyn Answers> {
        self.attempts.iter().find_map(|(_, attempt)| attempt.get()?.as_deref().ok())
    }

    /// Returns an attempt, which runs when it is needed first.
    fn attempt(&self, k: usize) -> Result<&dyn Answers, Error> {
        let (rung, attempt) = &self.attempts[k];
        let make = || {
            let doubles = matches!(self.numbers, Numbers::Double(_));
            let limited = *rung == Rung::Fractions && doubles && self.chain.max_pieces > EXACT_PIECES;
            let chain = Chain { max_pieces: EXACT_PIECES, ..self.chain.clone() };
            run(*rung, if limited { &chain } else { &self.chain }, &self.observe)
        };
        attempt.get_or_init(make).as_deref().map_err(Clone::clone)
    }

    /// Returns the answer to `query` of the first attempt that leaves no event open and whose bounds are small enough;
    /// if there is none, that with the smallest bounds among those that reach the end of the run. Longer numbers take a
    /// time within their roundings of an event for that of the event, so that numbers that do not hold the `digits` of
    /// the times and points of the query do not answer.
    fn settled<T>(
        &self,
        digits: u32,
        query: impl Fn(&dyn Answers) -> Result<T, Error>,
        numbers: impl Fn(&T) -> Vec<Judged<'_>>,
    ) -> Result<T, Error> {
        let mut best: Option<((bool, bool, f64), T)> = None;
        let mut failed = None;
        let tolerance = match self.numbers {
            Numbers::Double(accuracy) => accuracy.unwrap_or(DEFAULT_ACCURACY).log2(),
            Numbers::Exact => 0.0,
            Numbers::Digits(n) | Numbers::ExactThenDigits(n) | Numbers::Certified(n) => -f64::from(bits_for_digits(n)),
        };
        let last = self.attempts.len() - 1;
        for k in 0..=last {
            if matches!(self.attempts[k].0, Rung::Bits(bits) if k < last && bits < bits_for_digits(digits) + GUARD) {
                continue;
            }
            let answer = self
                .attempt(k)
                .and_then(|run| Ok((query(run)?, is_whole(run) || self.agrees(k, run), *run.ending() != Ending::Time)));
            let (answer, whole, ends_early) = match answer {
                Ok(answer) => answer,
                // The first attempt says what is wrong with the question.
                Err(error) => {
                    // A later attempt may go on where this one ends.
                    let ends_early = || self.attempt(k).is_ok_and(|run| *run.ending() != Ending::Time);
                    let open = match error {
                        Error::Open(_) | Error::NotDecided { .. } | Error::Irrational { .. } => true,
                        Error::TimeOutside { .. } => ends_early(),
                        _ => false,
                    };
                    if !open && !matches!(self.attempts[k].0, Rung::Fractions) || self.attempts.len() == 1 {
                        return best.map(|(_, answer)| answer).ok_or(error);
                    }
                    failed = Some(error);
                    continue;
                }
            };
            // The natural scale decides only for a number that is not distinguished from zero, or almost zero.
            let excess = |(value, measure): Judged<'_>| {
                let (size, scale) = (value.to_f64().abs(), self.scales.of(measure));
                if value.log2_error() == f64::NEG_INFINITY {
                    return f64::NEG_INFINITY;
                }
                let is_faint = size.log2() <= value.log2_error();
                let excess = value.log2_error() - size.max(if is_faint { scale } else { FAINT * scale }).log2();
                // A number without a bound is unknown, whatever its size; a maximum would pass over it.
                if excess.is_nan() { f64::INFINITY } else { excess - tolerance }
            };
            let worst = numbers(&answer).into_iter().map(excess).fold(f64::NEG_INFINITY, f64::max);
            if whole && worst <= 0.0 || self.attempts.len() == 1 {
                return Ok(answer);
            }
            let rank = (ends_early, !whole, worst);
            if best.as_ref().is_none_or(|(before, _)| rank < *before) {
                best = Some((rank, answer));
            }
        }
        best.map(|(_, answer)| answer).ok_or_else(|| failed.unwrap_or(Error::Open(Open)))
    }

    /// Returns a number of the requested system, with its digits.
    pub(crate) fn printed(&self, value: Value) -> Value {
        match self.numbers {
            Numbers::Double(_) => value.to_double(),
            Numbers::Exact => value,
            Numbers::Digits(digits) | Numbers::ExactThenDigits(digits) | Numbers::Certified(digits) => {
                let is_enclosed = value.as_interval().is_some() && !matches!(self.numbers, Numbers::Certified(_));
                let value = if is_enclosed { value.without_ends() } else { value };
                value.printed_in(digits, "")
            }
        }
    }
}

/// Returns whether a run reaches its end with every event decided.
fn is_whole(run: &dyn Answers) -> bool {
    *run.ending() == Ending::Time && run.doubt().is_none()
}
