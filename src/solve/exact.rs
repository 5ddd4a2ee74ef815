//! Derivatives in fractions: the undamped history in numbers `a + b ε`, for a value that grows and one that shrinks.

use super::derivative::{Asked, Derivative, Derivatives, NoDerivative, Rows, at, of_each};
use super::differences;
use crate::error::Error;
use crate::lattice::{Scaled, Undamped};
use crate::mapped::MapEach;
use crate::motion::{AtStart, Datum};
use crate::number::{Bounded, DOUBLE_DIGITS, Dual, Estimate, Float, Number, Rational, Scalar};
use crate::problem::{Material, Parameter, Parameters, Problem};
use crate::quantity::{Measure, Quantity};

type OneSide = Result<Rational, NoDerivative>;

/// The derivatives that are `asked` for; none for damping and for a gravity that is zero.
pub(super) fn derivatives(asked: &Asked<'_>) -> Result<Derivatives<Rational>, Error> {
    let value = asked.by.value_in::<Rational>(asked.problem, &())?;
    let zero = value.vanishes() == Ok(true);
    if zero && matches!(asked.by, Parameter::Gravity | Parameter::Length) || asked.by == Parameter::Damping {
        let expected = "digits or doubles: a rod without it is another problem in fractions";
        return Err(Error::Derivative { parameter: asked.by.name(), expected });
    }
    let problem = &*asked.plan.reaching(asked.problem);
    let base = asked.values(problem, &asked.plan.lattice::<Rational>(problem, &(), asked.observe)?)?;
    let right = rates(asked, problem, &value, 1)?;
    let left = if asked.by.only_grows(problem) { None } else { Some(rates(asked, problem, &value, -1)?) };
    let quotients = match differences::of(asked, DOUBLE_DIGITS) {
        Err(Error::NoMultiprecision) => None,
        quotients => Some(quotients?),
    };
    Ok(of_each(&base, |place, number| {
        let right = side(&right, number, place);
        let there = |rows: &&Rows<Dual>| !asked.is_stretched() || at(rows, place).is_some();
        let left = left.as_ref().filter(there);
        let left = left.map_or_else(|| right.clone(), |rows| side(rows, number, place).map(|rate| -rate));
        confirmed([left, right], quotients.as_ref().map(|quotients| at(quotients, place)))
    }))
}

/// The rates on both sides, as far as difference quotients confirm them; without these, where both are one.
///
/// Beside a threshold events may be apart by `ε²`, which decides what comes first as well as `ε` does.
fn confirmed(rates: [OneSide; 2], quotient: Option<Option<&Derivative<Estimate<Float>>>>) -> Derivative<Rational> {
    let unsettled = NoDerivative::Unsettled;
    let [left, right] = match quotient.map(|quotient| quotient.map(Derivative::sides)) {
        None if rates[0] == rates[1] => rates,
        None | Some(None) => [Err(unsettled), Err(unsettled)],
        Some(Some(quotients)) => {
            let [left, right] = rates;
            let [to_left, to_right] = quotients;
            [(left, to_left), (right, to_right)].map_each(|(rate, quotient)| {
                let (rate, quotient) = (rate, quotient?);
                let near = |rate: &Rational| meets(rate, quotient);
                rate.ok().filter(near).ok_or(unsettled)
            })
        }
    };
    match (left, right) {
        (Ok(left), Ok(right)) if left == right => Derivative::One(right),
        (left, right) => Derivative::Sides { left, right },
    }
}

/// Whether a quotient is a rate within its bound.
fn meets(rate: &Rational, quotient: &Estimate<Float>) -> bool {
    let number = Number::of_rational(rate);
    number.is_some_and(|number| Estimate::from_number(&number, &quotient.precision()).same(quotient))
}

/// The rate of a number on a side, where the same number is there: otherwise events do not move in first order only.
fn side(rows: &Rows<Dual>, number: &Rational, place: (usize, usize)) -> OneSide {
    let there = at(rows, place).filter(|there| there.value() == number);
    there.and_then(Dual::rate).cloned().ok_or(NoDerivative::Unsettled)
}

/// The numbers of the problem with a value that grows, or shrinks, with their rates.
fn rates(asked: &Asked<'_>, problem: &Problem, value: &Rational, sign: i64) -> Result<Rows<Dual>, Error> {
    let given = Parameters::<Rational>::of(problem, &())?;
    let rate = |on: bool| if on { Rational::from(sign) } else { Rational::default() };
    let dual = |number: Rational, by: Parameter| Dual::new(number, rate(asked.by == by));
    // √(E/ρ) has the rate c/2E, or −c/2ρ.
    let share = |c: &Rational| (c.clone() / value).halved() * Rational::from(sign);
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
        speed: dual(given.speed, Parameter::Speed),
    };
    let datum = |datum: Datum, number: &Number| {
        let number = number.to_rational();
        let rate = match (datum, asked.by) {
            (Datum::Point, Parameter::Length) => number.clone() / value,
            (Datum::Displacement(_), Parameter::Gap) => 1.into(),
            (Datum::Displacement(_), Parameter::StartDisplacement(None)) => number.clone(),
            (Datum::Velocity(_), Parameter::StartVelocity(None)) => number.clone(),
            (Datum::Displacement(k), Parameter::StartDisplacement(Some(node)))
            | (Datum::Velocity(k), Parameter::StartVelocity(Some(node))) => Rational::from(u32::from(k == node)),
            _ => Rational::default(),
        };
        Dual::new(number, rate * Rational::from(sign))
    };
    let data = AtStart::with(problem, &given, &datum);
    let scaled = Scaled::with(problem, &given, data)?;
    let limits = asked.plan.lattice_limits(problem);
    let history = Undamped::<Dual>::solve_scaled(scaled, &problem.run, limits, &**asked.observe)?;
    let mut rows = asked.values(problem, &history)?;
    for row in &mut rows {
        for (number, quantity) in row.iter_mut().zip(asked.quantities) {
            if let Some(number) = number {
                let by = unit_rate(asked.by, *quantity, &problem.rod.material, value) * Rational::from(sign);
                *number = number.clone() * Dual::new(1.into(), by);
            }
        }
    }
    Ok(rows)
}

/// The rate of what gives `quantity` its unit, as a part of it: stress and force have `E`, which is `c² ρ` at the same
/// density, impulse and energy `ρ`.
fn unit_rate(by: Parameter, quantity: Quantity, material: &Material, value: &Rational) -> Rational {
    let power = match (by, quantity.measure(), material) {
        (_, _, Material::WaveSpeed(_)) => 0,
        (Parameter::Modulus, Some(Measure::Stress | Measure::Force), _) => 1,
        (Parameter::WaveSpeed, Some(Measure::Stress | Measure::Force), _) => 2,
        (Parameter::Density, Some(Measure::Impulse | Measure::Energy), _) => 1,
        _ => 0,
    };
    if power == 0 { Rational::default() } else { Rational::from(power) / value }
}
