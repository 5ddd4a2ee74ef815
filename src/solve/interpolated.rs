//! Derivatives of the cubic through four runs in doubles: for damped rods, and where rates carried through a run do not
//! settle the derivatives.
//!
//! With a relative step `h` of the value, the error of the derivative of the cubic is about `h³ f⁗/4` plus the error
//! `n` of doubles divided by h; that of the quadratic through three of the runs is `h² f‴/6` or `/3`. The difference of
//! the two serves as the error, plus `h³` of the natural size. The error of the quadratic and `n/h` are of one size
//! for `h³ = n`.
//!
//! Next to a kink the third difference is as great as the change of the slope, except for a kink half a step away,
//! where the second difference is as great. If either is large, runs in long numbers settle the derivative.

use super::derivative::{Asked, Derivative, Derivatives, Rows, at, is_settled, of_each};
use super::ladder::{Engined, Ladder};
use super::plan::{Engine, Plan};
use super::question::Question;
use crate::error::Error;
use crate::motion::Motion;
use crate::number::{Estimate, Number, Rational, Scalar};
use crate::threads::Threads;

type Double = Estimate<f64>;

/// Minimum and maximum step, relative to the value.
const STEPS: [f64; 2] = [1e-5, 1e-3];
/// Factor by which the second step is shorter, if the first does not settle the derivatives.
const FINER: f64 = 10.0;
/// Maximum second derivative, relative to its natural size.
const BEND: f64 = 100.0;

/// Computes the derivatives that are `asked` for from this `run` and three more; `None` if some are not settled.
pub(super) fn of(asked: &Asked<'_>, run: &Engined<f64>) -> Result<Option<Derivatives<Double>>, Error> {
    let value = asked.by.value_in::<f64>(asked.problem, &())?;
    let (base, scales) = asked.scaled(asked.problem, &**run)?;
    let size = |(number, scale): (&Option<Double>, &f64)| {
        let number = number.as_ref()?;
        Some(number.bound() / number.value().abs().max(*scale))
    };
    let known = base.iter().flat_map(|row| row.iter().zip(&scales).filter_map(size)).fold(0.0, f64::max);
    let part = known.cbrt().clamp(STEPS[0], STEPS[1]);
    for part in [part, part / FINER] {
        // The step is a short decimal.
        let step = format!("{part:.0e}").parse().unwrap_or_else(|_| 1.into());
        if let Some(found) = with_step(asked, (&base, &scales), value, &step)? {
            return Ok(Some(found));
        }
    }
    Ok(None)
}

/// Computes the derivatives from runs with this relative step beside the run with the numbers `base`.
fn with_step(
    asked: &Asked<'_>,
    (base, scales): (&Rows<Double>, &[f64]),
    value: f64,
    step: &Number,
) -> Result<Option<Derivatives<Double>>, Error> {
    let one_sided = asked.by.only_grows(asked.problem);
    let offsets: [i64; 3] = if one_sided { [1, 2, 3] } else { [-1, 1, 2] };
    let run = |k: usize| {
        let by = step.to_rational() * Rational::from(offsets[k]);
        let Some(problem) = asked.by.moved(asked.problem, &by) else { return Ok(Vec::new()) };
        let plan = Plan::of(&problem, &Question { want: asked.want.clone(), numbers: asked.plan.numbers })?;
        let ladder = Ladder { problem: &problem, plan: &plan, observe: asked.observe };
        let query = |motion: &dyn Motion<Double>| asked.scaled(&problem, motion);
        let found = ladder.ask::<f64, _>(Vec::new(), query, |(rows, _)| rows.iter().flatten().flatten().collect())?;
        Ok::<Rows<Double>, Error>(found.1.0)
    };
    // A run on the lattice takes less time than starting a thread.
    let runs = match asked.plan.engine {
        Engine::Lattice => (0..3).map(run).collect::<Result<Vec<_>, _>>()?,
        _ => Threads::default().all(3, run)?,
    };
    let scale = if value == 0.0 { asked.by.scale_of_zero(asked.problem).to_f64() } else { value.abs() };
    let cubic = Cubic { part: step.to_f64(), value: scale / asked.by.power(asked.problem) as f64, one_sided };
    let mut settled = true;
    let found = of_each(base, |place, number| {
        let there = runs.iter().map(|run| at(run, place)).collect::<Option<Vec<_>>>();
        let slope = there.and_then(|there| cubic.slope(number, &there, scales[place.1]));
        settled &= slope.is_some();
        Derivative::One(slope.unwrap_or_else(|| number.zero()))
    });
    Ok(settled.then_some(found))
}

/// The positions of the runs.
struct Cubic {
    /// The step relative to the value.
    part: f64,
    /// The value, divided by the power with which it enters the problem.
    value: f64,
    /// Whether all other runs are to the right of the first one.
    one_sided: bool,
}

impl Cubic {
    /// Computes the derivative of a number with the values `there` in the other runs; `None` if it is not settled.
    fn slope(&self, here: &Double, there: &[&Double], scale: f64) -> Option<Double> {
        let sum = |weights: [i64; 4], divisor: f64| {
            let numbers = std::iter::once(here).chain(there.iter().copied()).zip(weights);
            let sum = numbers.fold(here.zero(), |sum, (number, weight)| sum + number.clone() * here.int(weight));
            sum / here.double(divisor)
        };
        let step = self.part * self.value;
        // The positions are 0, 1, 2 and 3, or 0, −1, 1 and 2.
        let (quadratic, bend, third) = match self.one_sided {
            true => (sum([-3, 4, -1, 0], 2.0 * step), sum([1, -2, 1, 0], step), sum([-1, 3, -3, 1], 3.0 * step)),
            false => (sum([0, -1, 1, 0], 2.0 * step), sum([-2, 1, 1, 0], step), sum([-3, 1, 3, -1], 6.0 * step)),
        };
        let natural = here.value().abs().max(scale) / self.value;
        let slope = (quadratic + &third).widened(&third).widened(&here.double(natural * self.part.powi(3)));
        let size = slope.value().abs() + natural;
        let settled = is_settled(&slope, natural) && bend.value().abs() <= BEND * self.part * size;
        settled.then_some(slope)
    }
}
