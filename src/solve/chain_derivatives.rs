//! Derivatives of the numbers of a chain with respect to one of its values.

use std::collections::BTreeMap;

use super::chain::EXACT_PIECES;
use super::derivative::{Derivatives, Request, Rows, Varying, of_same_events};
use super::differences;
use super::plan::DEFAULT_ACCURACY;
use super::question::{Numbers, Observer};
use super::rates;
use crate::chain::{Chain, ChainEvent, ChainHistory, ChainNumbers, ChainRun, RowKey, Varied};
use crate::error::Error;
use crate::motion::Ending;
use crate::number::{Bounded, Dual, Estimate, Float, Number, Rational, Scalar, Value};
use crate::problem::{Parameter, stepped};

impl Varying for Chain {
    fn value_in<S: Scalar>(&self, by: Parameter, precision: &S::Precision) -> Result<S, Error> {
        Ok(S::from_number(&self.number(by)?, precision))
    }

    fn moved(&self, by: Parameter, step: &Rational) -> Option<Self> {
        let number = stepped(&self.number(by).ok()?, step, self.only_grows(by), || self.scale_of_zero(by))?;
        self.moved_to(by, number)
    }

    fn only_grows(&self, by: Parameter) -> bool {
        self.is_non_negative(by) && self.number(by).is_ok_and(|number| number.is_zero())
    }

    fn scale_of_zero(&self, by: Parameter) -> Number {
        format!("{:e}", self.scale_from_zero(by)).parse().unwrap_or_else(|_| 1.into())
    }

    fn power(&self, _: Parameter) -> i64 {
        1
    }
}

/// A request for derivatives of numbers of a chain.
struct AskedOfChain<'a> {
    chain: &'a Chain,
    observe: &'a Observer,
    by: Parameter,
    numbers: ChainNumbers<'a>,
    /// The keys of the rows of a list.
    keys: &'a [RowKey],
    /// Whether a run may end before the time asked for, where fractions end.
    may_end: bool,
}

impl AskedOfChain<'_> {
    /// Returns the numbers of a run.
    fn rows<N: Bounded>(&self, run: &ChainRun<N>) -> Result<Rows<N>, Error> {
        if !self.may_end && *run.ending() != Ending::Time {
            return Err(Error::NotDecided { what: "by fractions", bits: 0 });
        }
        Ok(self.in_order(self.numbers.of(run)?, run.events()))
    }

    /// Returns the rows of a list in the order of the keys, with an empty row for an event that the run does not have.
    fn in_order<N: Clone, E>(&self, rows: Rows<N>, events: &[ChainEvent<E>]) -> Rows<N> {
        if self.numbers.is_at_times() {
            return rows;
        }
        let width = self.numbers.measures().len();
        let found: BTreeMap<RowKey, Vec<Option<N>>> = self.numbers.keys(events).into_iter().zip(rows).collect();
        self.keys.iter().map(|key| found.get(key).cloned().unwrap_or_else(|| vec![None; width])).collect()
    }
}

impl Request for AskedOfChain<'_> {
    type Of = Chain;

    fn of(&self) -> &Chain {
        self.chain
    }

    fn by(&self) -> Parameter {
        self.by
    }

    fn is_stretched(&self) -> bool {
        !self.numbers.points().is_empty()
    }

    fn long_rows(&self, chain: &Chain, exponent: u32) -> Result<(Rows<Estimate<Float>>, Vec<f64>), Error> {
        let history = chain.solve_observed(Numbers::Digits(2 * exponent), self.observe.clone())?;
        let rows = self.in_order(history.rows(self.numbers)?, &history.listing()?.events);
        let long = |value: Value| value.without_ends().as_float().cloned();
        let rows = rows.into_iter().map(|row| row.into_iter().map(|value| value.and_then(long)).collect());
        Ok((rows.collect(), self.numbers.measures().into_iter().map(|measure| chain.scale(measure)).collect()))
    }

    fn exact_rows(&self) -> Result<Rows<Rational>, Error> {
        self.rows(&ChainRun::new(self.chain, &(), &|events, pieces| (self.observe)(events, pieces))?)
    }

    fn rated_rows(&self, value: &Rational, sign: i64) -> Result<(Rows<Dual<Rational>>, bool), Error> {
        let expected = "a value that could be twice as great";
        let further = self.chain.moved(self.by, &Rational::from(1));
        let further = &further.ok_or(Error::Derivative { parameter: self.by, expected })?;
        let varied = Varied { now: self.chain, further, falls: sign < 0 };
        let run = ChainRun::<Dual<Rational>>::varied(varied, &(), &|events, pieces| (self.observe)(events, pieces))?;
        // `further` exceeds the value by its size, or by a scale of its own at zero.
        let scale = match value.vanishes() {
            Ok(true) => self.chain.scale_of_zero(self.by).to_rational(),
            _ => value.magnitude(),
        };
        let per_value = Rational::from(1) / scale;
        let scaled = |number: Option<Dual<Rational>>| number.map(|number| number.scaled_rate(&per_value));
        let rows = self.rows(&run)?;
        let other = self.in_order(self.numbers.with_other_side().of(&run)?, run.events());
        let mut pairs = rows.iter().flatten().zip(other.iter().flatten());
        let is_same = pairs.all(|pair| match pair {
            (Some(a), Some(b)) => a.alike(b),
            (a, b) => a.is_none() && b.is_none(),
        });
        // All that is listed or asked for precedes the coincidence.
        let last = match self.numbers.times() {
            [] => run.events().iter().map(|event| event.t.to_f64()).fold(f64::NEG_INFINITY, f64::max),
            times => times.iter().map(Number::to_f64).fold(f64::NEG_INFINITY, f64::max),
        };
        let is_decided = run.undetermined_from().is_none_or(|from| last < from);
        let rows = rows.into_iter().map(|row| row.into_iter().map(scaled).collect()).collect();
        Ok((rows, is_same && is_decided))
    }
}

impl ChainHistory {
    /// Computes the derivatives of `numbers` with respect to a value of the chain, a row for each row of them. Times
    /// and points stay fixed: a value that jumps there has a derivative only on the side to which the jump moves away.
    /// A missing number, such as the end of a contact that lasts, is `None`.
    ///
    /// **Accuracy**: *exact* where fractions hold the run, also for an answer in doubles: rates are carried through the
    /// run, and difference quotients confirm them where first order does not decide the order of two events. Otherwise
    /// the error is an *estimate*, as [`ChainHistory::warnings`] then say: difference quotients of runs in long
    /// numbers, with a step as small as the last of the digits.
    ///
    /// **Errors**: [`Error::Problem`] if the chain has no such value; [`Error::TimeOutside`]; [`Error::PointOutside`];
    /// [`Error::Derivative`] for enclosures; [`Error::Digits`] for more than 60; the errors of the runs.
    ///
    /// ```
    /// use dalembert::chain::{Body, Chain, ChainNumbers};
    /// use dalembert::Numbers;
    /// // Two equal bars part when the wave returns: at gap/v + 2L/c.
    /// let bar = |velocity: i64| Body::new(1.into(), 1.into(), 1.into()).with_velocity(velocity.into());
    /// let chain = Chain::builder(bar(0)).contact(1.into(), bar(-2)).until(4.into()).build()?;
    /// let history = chain.solve(Numbers::default())?;
    /// let by_gap = history.derivatives("joint.1.gap".parse()?, ChainNumbers::Events)?;
    /// let times = by_gap.iter().map(|row| row[0].as_ref().and_then(|by| by.value()).map(|by| by.to_f64()));
    /// assert_eq!(times.collect::<Vec<_>>(), [Some(0.5), Some(0.5)]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn derivatives(&self, by: Parameter, numbers: ChainNumbers<'_>) -> Result<Derivatives<Value>, Error> {
        numbers.check(self.chain())?;
        let (system, observe) = (self.numbers(), self.observer());
        let doubles = matches!(system, Numbers::Double(_));
        // Doubles have another way where the numbers of fractions grow.
        let limit = if doubles { EXACT_PIECES } else { usize::MAX };
        let chain = self.chain();
        let limited = chain.clone().with_max_pieces(chain.max_pieces().min(limit));
        let listing = self.listing()?;
        // Fractions may end before the time asked for.
        if let Some(time) = numbers.times().iter().find(|time| time.to_f64() > listing.end.to_f64()) {
            return Err(Error::TimeOutside { found: time.to_string(), end: listing.end.to_string() });
        }
        let keys = &numbers.keys(&listing.events);
        let may_end = system == Numbers::Exact;
        let asked = |chain| AskedOfChain { chain, observe, by, numbers, keys, may_end };
        let digits = match system {
            Numbers::Certified(_) => {
                let expected = "digits that need not be proved";
                return Err(Error::Derivative { parameter: by, expected });
            }
            Numbers::Double(accuracy) => -accuracy.unwrap_or(DEFAULT_ACCURACY).log10(),
            Numbers::Exact => 0.0,
            Numbers::Digits(digits) | Numbers::ExactThenDigits(digits) => f64::from(digits),
        };
        if !matches!(system, Numbers::Digits(_)) {
            match rates::in_fractions(&asked(&limited)) {
                Ok(rows) => return Ok(self.printed_rows(rows, !numbers.is_at_times())),
                Err(error) if system == Numbers::Exact => return Err(error),
                Err(Error::Problem(error)) => return Err(Error::Problem(error)),
                Err(Error::Interrupted) => return Err(Error::Interrupted),
                Err(_) => {}
            }
        }
        let rows = differences::of(&asked(chain), digits.ceil() as u32)?;
        self.note_estimates(by);
        Ok(self.printed_rows(rows, !numbers.is_at_times()))
    }

    fn printed_rows<S: Into<Value>>(&self, rows: Derivatives<S>, is_list: bool) -> Derivatives<Value> {
        let rows = if is_list { of_same_events(rows) } else { rows };
        let printed = |found: super::Derivative<S>| found.map(|number| self.printed(number.into()));
        rows.into_iter().map(|row| row.into_iter().map(|found| found.map(printed)).collect()).collect()
    }
}
