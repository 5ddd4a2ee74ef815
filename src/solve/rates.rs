//! Derivatives of undamped rods and chains from their histories in numbers `a + b ε`: in fractions for a growing and a
//! shrinking value; in doubles, if no threshold is met, for a growing one.

use super::derivative::{
    Asked, At, Derivative, Derivatives, NoDerivative, Request, Rows, Varying, at, is_settled, of_each,
};
use super::ladder::{Engined, Ladder};
use super::plan::{Engine, Plan};
use super::question::{Numbers, Question};
use super::rung::Rung;
use super::typed::TypedHistory;
use super::{chain, long};
use crate::error::Error;
use crate::lattice::{Scaled, Undamped};
use crate::motion::{AtStart, Datum, Motion};
use crate::number::{Bounded, DOUBLE_DIGITS, Dual, Estimate, Float, Number, Rational, Reads, Scalar};
use crate::problem::{Parameter, Parameters, Problem};
use crate::quantity::{Quantity, UnitSystem, Units};
use crate::reason::Warning;

type OneSide = Result<Rational, NoDerivative>;

/// Computes the derivatives in fractions that are `asked` for; fails for damping and for a gravity or length of zero.
pub(super) fn in_fractions(asked: &impl Request) -> Result<Derivatives<Rational>, Error> {
    let (rates, settled) = on_both_sides(asked)?;
    let quotients = if settled { None } else { Some(long::quotients(asked, DOUBLE_DIGITS)?) };
    Ok(of_each(&rates, |place, sides| {
        derivative(match &quotients {
            Some(quotients) => confirmed(sides.clone(), at(quotients, place)),
            None if settled || sides[0] == sides[1] => sides.clone(),
            None => [Err(NoDerivative::Unsettled), Err(NoDerivative::Unsettled)],
        })
    }))
}

fn derivative([left, right]: [OneSide; 2]) -> Derivative<Rational> {
    match (left, right) {
        (Ok(left), Ok(right)) if left == right => Derivative::One(right),
        (left, right) => Derivative::Sides { left, right },
    }
}

impl<'a> Asked<'a> {
    /// Returns the same plan for another problem.
    fn ladder(&self, problem: &'a Problem) -> Ladder<'a> {
        Ladder { problem, plan: self.plan, observe: self.observe }
    }
}

impl Request for Asked<'_> {
    type Of = Problem;

    fn of(&self) -> &Problem {
        self.problem
    }

    fn by(&self) -> Parameter {
        self.by
    }

    fn is_stretched(&self) -> bool {
        self.by == Parameter::Length && self.at.is_some_and(|at| !at.points.is_empty())
    }

    fn long_rows(&self, problem: &Problem, exponent: u32) -> Result<(Rows<Estimate<Float>>, Vec<f64>), Error> {
        let question = Question { want: self.want.clone(), numbers: Numbers::Digits(2 * exponent) };
        let plan = Plan::of(problem, &question)?;
        let history = TypedHistory::<Float>::solve(problem, &plan, self.observe.clone())?;
        let query = |motion: &dyn Motion<_>| self.scaled(problem, motion);
        history.ask(query, |(rows, _)| rows.iter().flatten().flatten().collect())
    }

    fn exact_rows(&self) -> Result<Rows<Rational>, Error> {
        let problem = &*self.plan.reaching(self.problem);
        let ladder = self.ladder(problem);
        match self.plan.engine {
            Engine::Chain => self.values(problem, &*chain::engine::<Rational>(ladder, (Rung::Fractions, &()))?),
            _ => self.values(problem, &ladder.lattice::<Rational>(&())?),
        }
    }

    fn rated_rows(&self, value: &Rational, sign: i64) -> Result<(Rows<Dual<Rational>>, bool), Error> {
        let zero = value.vanishes() == Ok(true);
        if zero && matches!(self.by, Parameter::Gravity | Parameter::Length) || self.by == Parameter::Damping {
            let expected = "digits or doubles: a rod without it is another problem in fractions";
            return Err(Error::Derivative { parameter: self.by, expected });
        }
        with_rates(self, &self.plan.reaching(self.problem), value, sign)
    }
}

/// Returns the rates from the left and from the right, and whether first order settles them all.
fn on_both_sides(asked: &impl Request) -> Result<(Rows<[OneSide; 2]>, bool), Error> {
    let value = asked.of().value_in::<Rational>(asked.by(), &())?;
    let (right, mut settled) = asked.rated_rows(&value, 1)?;
    let left = match asked.of().only_grows(asked.by()) {
        true => None,
        false => {
            let (left, both) = asked.rated_rows(&value, -1)?;
            settled &= both;
            Some(left)
        }
    };
    let base = asked.exact_rows()?;
    let rates = of_each(&base, |place, number| {
        let right = side(&right, number, place);
        let there = |rows: &&Rows<Dual<Rational>>| !asked.is_stretched() || at(rows, place).is_some();
        let left = left.as_ref().filter(there);
        let left = left.map_or_else(|| right.clone(), |rows| side(rows, number, place).map(|rate| -rate));
        settled &= left.is_ok() && right.is_ok();
        [left, right]
    });
    Ok((rates, settled))
}

/// Returns the rates on both sides that difference quotients confirm.
///
/// Next to a threshold, events may be `ε²` apart, which decides their order as well as `ε` does.
fn confirmed(rates: [OneSide; 2], quotient: Option<&Derivative<Estimate<Float>>>) -> [OneSide; 2] {
    let unsettled = NoDerivative::Unsettled;
    let Some(quotient) = quotient.map(Derivative::sides) else { return [Err(unsettled), Err(unsettled)] };
    let [left, right] = rates;
    let [to_left, to_right] = quotient;
    [(left, to_left), (right, to_right)].map(|(rate, quotient)| {
        let (rate, quotient) = (rate, quotient?);
        rate.ok().filter(|rate| meets(rate, quotient)).ok_or(unsettled)
    })
}

/// Returns whether a quotient equals a rate within its bound.
fn meets(rate: &Rational, quotient: &Estimate<Float>) -> bool {
    let number = Number::of_rational(rate);
    number.is_some_and(|number| Estimate::from_number(&number, &quotient.precision()).same(quotient))
}

/// Returns the rate of a number on a side with the same number; otherwise events change beyond first order.
fn side(rows: &Rows<Dual<Rational>>, number: &Rational, place: (usize, usize)) -> OneSide {
    let there = at(rows, place).filter(|there| there.value() == number);
    there.and_then(Dual::rate).cloned().ok_or(NoDerivative::Unsettled)
}

/// Computes the derivatives in doubles that are `asked` for, of the numbers of this `run`; `None` if the run is not one
/// of the lattice, if a threshold is met, or if bounds are too wide.
pub(super) fn in_doubles(asked: &Asked<'_>, run: &Engined<f64>) -> Result<Option<Derivatives<Estimate<f64>>>, Error> {
    let value = asked.by.value_in::<Estimate<f64>>(asked.problem, &())?;
    if asked.plan.engine != Engine::Lattice || asked.by == Parameter::Damping || value.vanishes() == Ok(true) {
        return Ok(None);
    }
    let problem = &*asked.plan.reaching(asked.problem);
    let (rows, settled) = with_rates(asked, problem, &value, 1)?;
    let (base, scales) = asked.scaled(problem, &**run)?;
    let mut settled = settled && base.len() == rows.len();
    let found = of_each(&base, |place, number| {
        let rate = at(&rows, place).filter(|there| there.value().same(number)).and_then(Dual::rate);
        let natural = number.value().abs().max(scales[place.1]) / value.value().abs();
        let rate = rate.filter(|rate| is_settled(rate, natural));
        settled &= rate.is_some();
        Derivative::One(rate.unwrap_or(number).clone())
    });
    Ok(settled.then_some(found))
}

/// Computes the derivatives in doubles that are `asked` for, by fractions, if the rod is a body of a chain or fractions
/// have decided the order of events in this `run`; `None` if first order does not settle them.
pub(super) fn by_fractions(asked: &Asked<'_>, run: &Engined<f64>) -> Result<Option<Derivatives<Estimate<f64>>>, Error> {
    if asked.rung != Rung::Fractions && asked.plan.engine != Engine::Chain {
        return Ok(None);
    }
    let (rates, settled) = on_both_sides(asked)?;
    let base = asked.values(asked.problem, &**run)?;
    let listed = |row: &Vec<Option<Estimate<f64>>>| row.iter().map(Option::is_some).collect::<Vec<_>>();
    let settled = settled
        && rates.iter().map(|row| row.iter().map(Option::is_some).collect::<Vec<_>>()).eq(base.iter().map(listed));
    Ok(settled.then(|| of_each(&rates, |_, sides| derivative(sides.clone()).map(Estimate::read))))
}

/// Returns the numbers of the problem with a growing or a shrinking value, with their rates, as far as comparisons are
/// settled; and whether first order settles them.
///
/// First order does not settle two events that were taken as one, nor a queried time that may be that of a ray in first
/// order only: then the limits from both sides, or their rates, differ.
fn with_rates<S: Bounded>(
    asked: &Asked<'_>,
    problem: &Problem,
    value: &S,
    sign: i64,
) -> Result<(Rows<Dual<S>>, bool), Error> {
    let further = asked.by.moved(problem, &Rational::from(1));
    let expected = "a value that could be twice as great";
    let further = &further.ok_or(Error::Derivative { parameter: asked.by, expected })?;
    let is_chain = asked.plan.engine == Engine::Chain;
    let motion: Box<dyn Motion<Dual<S>>> = match is_chain {
        true => Box::new(chain::varied(asked.ladder(problem), further, sign < 0, &value.precision())?),
        false => Box::new(lattice(asked, problem, value, &value.int(sign))?),
    };
    let powers = unit_powers(asked, [problem, further]);
    // The problem has a power of the value, which `further` exceeds by its size, or by a scale of its own at zero.
    let scale = match value.vanishes() {
        Ok(true) => S::from_number(&asked.by.scale_of_zero(problem), &value.precision()),
        _ => value.magnitude(),
    };
    let per_value = value.int(asked.by.power(problem)) / scale;
    let rows = |asked: &Asked<'_>| {
        let mut rows = asked.values(problem, &*motion)?;
        for row in &mut rows {
            for (number, power) in row.iter_mut().zip(&powers) {
                if is_chain {
                    *number = number.take().map(|number| number.scaled_rate(&per_value));
                }
                if *power != 0 {
                    let unit = Dual::new(value.one(), per_value.clone() * value.int(sign * power));
                    *number = number.take().map(|number| number * unit);
                }
            }
        }
        Ok::<_, Error>(rows)
    };
    let found = rows(asked)?;
    let mut settled = true;
    if let Some(at) = asked.at.filter(|_| value.bits().is_none()) {
        let other = rows(&Asked { at: Some(At { side: at.side.other(), ..at }), want: asked.want.clone(), ..*asked })?;
        let mut pairs = found.iter().flatten().zip(other.iter().flatten());
        settled = pairs.all(|pair| matches!(pair, (Some(a), Some(b)) if a.alike(b)));
    }
    // All that is listed or queried precedes the coincidence, which is in the trip that begins at `from`.
    let before = |from: f64| match asked.at {
        Some(at) => at.times.iter().all(|time| time.to_f64() < from),
        None => motion.events().iter().all(|event| event.t.to_f64() < from),
    };
    let is_later = |warning: &Warning| matches!(warning, Warning::Coincidence { from } if before(*from));
    settled &= motion.warnings().iter().all(is_later);
    Ok((found, settled))
}

/// Returns the power of the value in the unit of each quantity, where `further` is the problem with twice the value, or
/// with twice the power of it that the problem has.
fn unit_powers(asked: &Asked<'_>, [problem, further]: [&Problem; 2]) -> Vec<i64> {
    let [units, others] = [problem, further].map(|problem| Units::new(problem, UnitSystem::default()));
    let power = |quantity: &Quantity| {
        let measure = quantity.measure()?;
        let [unit, other] = [&units, &others].map(|units| units.factor::<f64>(measure, &()));
        Some((other? / unit?).log2().round() as i64)
    };
    asked.quantities.iter().map(|quantity| power(quantity).unwrap_or(0)).collect()
}

/// Returns the history of a rod on the lattice with a growing or a shrinking value.
fn lattice<S: Bounded>(asked: &Asked<'_>, problem: &Problem, value: &S, sign: &S) -> Result<Undamped<Dual<S>>, Error> {
    let precision = value.precision();
    let given = Parameters::<S>::of(problem, &precision)?;
    let dual = |number: S, by: Parameter| {
        let rate = if asked.by == by { sign.clone() } else { sign.zero() };
        Dual::new(number, rate)
    };
    // The rate of √(E/ρ) is c/2E, or −c/2ρ.
    let share = |c: &S| (c.clone() / value).halved() * sign;
    let wave_speed = match asked.by {
        Parameter::Modulus => Dual::new(given.wave_speed.clone(), share(&given.wave_speed)),
        Parameter::Density => Dual::new(given.wave_speed.clone(), -share(&given.wave_speed)),
        _ => dual(given.wave_speed, Parameter::WaveSpeed),
    };
    let given = Parameters {
        length: dual(given.length, Parameter::Length),
        wave_speed,
        damping: Dual::constant(given.damping),
        gravity: dual(given.gravity, Parameter::Gravity),
        speed: dual(given.speed, Parameter::ImpactSpeed),
    };
    let datum = |datum: Datum, number: &Number| {
        let number = S::from_number(number, &precision);
        let rate = match (datum, asked.by) {
            (Datum::Point, Parameter::Length) => number.clone() / value,
            (Datum::Displacement(_), Parameter::Gap) => number.one(),
            (Datum::Displacement(_), Parameter::Displacement(None)) => number.clone(),
            (Datum::Strain(_), Parameter::Strain(None)) => number.clone(),
            (Datum::Velocity(_), Parameter::Velocity(None)) => number.clone(),
            (Datum::Displacement(k), Parameter::Displacement(Some(node)))
            | (Datum::Strain(k), Parameter::Strain(Some(node)))
            | (Datum::Velocity(k), Parameter::Velocity(Some(node))) => number.int(i64::from(k == node)),
            _ => number.zero(),
        };
        Dual::new(number, rate * sign)
    };
    let data = AtStart::with(problem, &given, &datum);
    let scaled = Scaled::with(problem, &given, data)?;
    let limits = asked.plan.lattice_limits(problem);
    Undamped::solve_scaled(scaled, problem.run(), limits, &**asked.observe)
}
