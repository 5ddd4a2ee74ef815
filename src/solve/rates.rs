//! Derivatives of undamped rods from their histories in numbers `a + b ε`: in fractions for a growing and a shrinking
//! value; in doubles, if no threshold is met, for a growing one.

use super::derivative::{Asked, Derivative, Derivatives, NoDerivative, Rows, at, is_settled, of_each};
use super::ladder::Engined;
use super::long;
use super::plan::{Engine, Rung};
use crate::error::Error;
use crate::lattice::{Scaled, Undamped};
use crate::motion::{AtStart, Datum, Motion};
use crate::number::{Bounded, DOUBLE_DIGITS, Dual, Estimate, Float, Number, Rational, Reads, Scalar};
use crate::problem::{Material, Parameter, Parameters, Problem};
use crate::quantity::{Measure, Quantity};
use crate::reason::Warning;

type OneSide = Result<Rational, NoDerivative>;

/// Computes the derivatives in fractions that are `asked` for; fails for damping and for a gravity or length of zero.
pub(super) fn in_fractions(asked: &Asked<'_>) -> Result<Derivatives<Rational>, Error> {
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

/// Returns the rates from the left and from the right, and whether first order settles them all.
fn on_both_sides(asked: &Asked<'_>) -> Result<(Rows<[OneSide; 2]>, bool), Error> {
    let value = asked.by.value_in::<Rational>(asked.problem, &())?;
    let zero = value.vanishes() == Ok(true);
    if asked.plan.engine == Engine::Chain {
        let expected = "digits or doubles: fractions carry no derivatives of a chain";
        return Err(Error::Derivative { parameter: asked.by, expected });
    }
    if zero && matches!(asked.by, Parameter::Gravity | Parameter::Length) || asked.by == Parameter::Damping {
        let expected = "digits or doubles: a rod without it is another problem in fractions";
        return Err(Error::Derivative { parameter: asked.by, expected });
    }
    let problem = &*asked.plan.reaching(asked.problem);
    let base = asked.values(problem, &asked.plan.lattice::<Rational>(problem, &(), asked.observe)?)?;
    let (right, mut settled) = with_rates(asked, problem, &value, 1)?;
    let left = match asked.by.only_grows(problem) {
        true => None,
        false => {
            let (left, both) = with_rates(asked, problem, &value, -1)?;
            settled &= both;
            Some(left)
        }
    };
    // A queried time may be that of a ray in first order only.
    settled &= asked.at.is_none();
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
    let (base, scales) = (asked.values(problem, &**run)?, asked.scales(problem, &**run));
    let mut settled = settled && base.len() == rows.len();
    let found = of_each(&base, |place, number| {
        let rate = at(&rows, place).filter(|there| there.value().same(number)).and_then(Dual::rate);
        let natural = number.value().abs().max(scales[place.1]) / value.value();
        let rate = rate.filter(|rate| is_settled(rate, natural));
        settled &= rate.is_some();
        Derivative::One(rate.unwrap_or(number).clone())
    });
    Ok(settled.then_some(found))
}

/// Computes the derivatives in doubles that are `asked` for, by fractions, if fractions have decided the order of
/// events in this `run`; `None` if first order does not settle them.
pub(super) fn by_fractions(asked: &Asked<'_>, run: &Engined<f64>) -> Result<Option<Derivatives<Estimate<f64>>>, Error> {
    if asked.rung != Rung::Fractions || asked.plan.engine == Engine::Chain {
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
/// settled; and whether no two events were taken as one on the way.
fn with_rates<S: Bounded>(
    asked: &Asked<'_>,
    problem: &Problem,
    value: &S,
    sign: i64,
) -> Result<(Rows<Dual<S>>, bool), Error> {
    let precision = value.precision();
    let given = Parameters::<S>::of(problem, &precision)?;
    let sign = value.int(sign);
    let dual = |number: S, by: Parameter| {
        let rate = if asked.by == by { sign.clone() } else { sign.zero() };
        Dual::new(number, rate)
    };
    // The rate of √(E/ρ) is c/2E, or −c/2ρ.
    let share = |c: &S| (c.clone() / value).halved() * &sign;
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
        Dual::new(number, rate * &sign)
    };
    let data = AtStart::with(problem, &given, &datum);
    let scaled = Scaled::with(problem, &given, data)?;
    let limits = asked.plan.lattice_limits(problem);
    let history = Undamped::<Dual<S>>::solve_scaled(scaled, problem.run(), limits, &**asked.observe)?;
    let mut rows = asked.values(problem, &history)?;
    for row in &mut rows {
        for (number, quantity) in row.iter_mut().zip(asked.quantities) {
            let power = unit_power(asked.by, *quantity, problem.material());
            if let Some(number) = number.as_mut().filter(|_| power != 0) {
                *number = number.clone() * Dual::new(value.one(), sign.clone() * value.int(power) / value);
            }
        }
    }
    // All listed events precede the coincidence, which is in the trip that begins at `from`.
    let before = |from: f64| asked.at.is_none() && history.events().iter().all(|event| event.t.to_f64() < from);
    let settled = |warning: &Warning| matches!(warning, Warning::Coincidence { from } if before(*from));
    Ok((rows, history.warnings().iter().all(settled)))
}

/// Returns the power of the value in the unit of `quantity`: stress and force contain `E`, which is `c² ρ` at the same
/// density; impulse and energy contain `ρ`.
fn unit_power(by: Parameter, quantity: Quantity, material: &Material) -> i64 {
    match (by, quantity.measure(), material) {
        (_, _, Material::WaveSpeed(_)) => 0,
        (Parameter::Modulus, Some(Measure::Stress | Measure::Force), _) => 1,
        (Parameter::WaveSpeed, Some(Measure::Stress | Measure::Force), _) => 2,
        (Parameter::Density, Some(Measure::Impulse | Measure::Energy), _) => 1,
        _ => 0,
    }
}
