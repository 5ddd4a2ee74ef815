//! First contacts over impact speed and damping.

use rayon::prelude::*;

use super::Failed;
use crate::first_contact::{Bounce, FirstContact};
use crate::motion::Side;
use crate::number::{Estimate, Number};
use crate::paper::formulas::limit;
use crate::problem::{Parameters, Problem};
use crate::sweep::{Axis, Grid, threshold};

/// `r` of Figures 4–7, where `c = L = g = 1`.
pub(crate) const DAMPINGS: [&str; 4] = ["0", "0.1", "0.2", "0.3"];

/// How far a number of a figure may be off, relative to it or to 1.
const ACCURACY: f64 = 1e-13;

/// A first contact that ends with a bounce: `t_b`, and what is asked there.
pub(crate) type Ended = Option<(f64, Vec<Option<f64>>)>;
/// `t`, which limit, and the value.
type Sided = (f64, Side, f64);
type Double = Estimate<f64>;

/// What is asked of a first contact at its bounce.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Wanted {
    /// `e_E²`.
    Restitution,
    /// `E_h(t_b)/E(t_b)` and `E(t_b)/E(0)`.
    Shares,
    /// `E_h(t_b)` and `E_z(t_b)`.
    Energies,
}

/// The first contacts of a grid over `impact.speed` and `rod.damping`, the speed varying fastest, on all cores.
///
/// **Accuracy**: 1e-13 of the numbers, or of 1 where they are less: the closed form in doubles where its bound says so,
/// otherwise a history in longer numbers.
///
/// **Errors**: those of the history.
pub(crate) fn contacts(grid: &Grid, wanted: Wanted) -> Result<Vec<Ended>, Failed> {
    (0..grid.len()).into_par_iter().map(|index| contact(&grid.problem(index)?, wanted)).collect()
}

/// The grid of the paper's rod, `c = L = g = 1`.
pub(crate) fn grid(dampings: &str, speeds: &str) -> Result<Grid, Failed> {
    let rod = Problem::uniform(1.into(), 1.into(), 1.into(), 1.into());
    let axes = [format!("rod.damping={dampings}"), format!("impact.speed={speeds}")];
    Ok(Grid::new(rod, axes.iter().map(|axis| axis.parse::<Axis>()).collect::<Result<_, _>>()?)?)
}

fn contact(problem: &Problem, wanted: Wanted) -> Result<Ended, Failed> {
    let form = FirstContact::new(&Parameters::<Double>::of(problem, &())?);
    match form.bounce() {
        Bounce::Never(_) => Ok(None),
        Bounce::At { time, .. } if is_sharp(&time) => {
            let found = asked(&form, &time, wanted);
            if found.iter().flatten().all(is_sharp) {
                let plain = |value: Option<Double>| value.map(|value| *value.value());
                return Ok(Some((*time.value(), found.into_iter().map(plain).collect())));
            }
            by_history(problem, wanted)
        }
        _ => by_history(problem, wanted),
    }
}

fn is_sharp(value: &Double) -> bool {
    value.bound() <= ACCURACY * value.value().abs().max(1.0)
}

fn asked(form: &FirstContact<Double>, time: &Double, wanted: Wanted) -> Vec<Option<Double>> {
    match wanted {
        Wanted::Restitution => vec![form.rebound(time).energy_restitution_squared()],
        Wanted::Shares => form.restitution_factors(time).map_or(vec![None, None], |(a, b)| vec![Some(a), Some(b)]),
        Wanted::Energies => {
            let energy = form.energy(time);
            vec![Some(energy.translational), Some(energy.vibrational)]
        }
    }
}

fn by_history(problem: &Problem, wanted: Wanted) -> Result<Ended, Failed> {
    let question = crate::Question::first_contact(crate::Numbers::Double(Some(ACCURACY)));
    let plan = crate::Plan::of(problem, &question)?;
    let history = crate::History::<f64>::solve(problem, &plan, crate::solve::unobserved())?;
    let Some(time) = history.contacts().first().and_then(|contact| contact.to) else { return Ok(None) };
    let values = match wanted {
        Wanted::Restitution => vec![history.restitution(0)?.energy_squared.ok()],
        Wanted::Shares => {
            let shares = history.energy_shares(0)?;
            vec![shares.translational, shares.kept]
        }
        Wanted::Energies => {
            let energy = history.energy(time)?;
            vec![Some(energy.translational), Some(energy.vibrational)]
        }
    };
    Ok(Some((time, values)))
}

/// What Figures 4–7 tend to for `μ → ∞`, as long as `t_b = t₁`.
#[derive(Clone, Debug)]
pub(crate) struct Limits {
    /// `lim e_E = 2e^{−R}(I₀(R) − I₁(R)) − e^{−2R}`.
    pub(crate) restitution: f64,
    /// `lim E_h/E` and `lim E/E(0)`.
    pub(crate) translational: f64,
    pub(crate) kept: f64,
    /// `R = r t₁`.
    pub(crate) ratio: f64,
}

/// The limits for a damping.
///
/// **Source**: the motion is linear in `μ` and `g`, so for `μ → ∞` all ratios are those of `g = 0`.
///
/// **Accuracy**: 1e-13.
pub(crate) fn limits(damping: &str) -> Result<Limits, Failed> {
    let rod = Problem::builder().length(1).wave_speed(1).damping(damping).impact_speed(1).build()?;
    let shares = contact(&rod, Wanted::Shares)?.map_or(Vec::new(), |(_, shares)| shares);
    let share = |k: usize| shares.get(k).copied().flatten().unwrap_or(f64::NAN);
    let r: f64 = damping.parse()?;
    Ok(Limits { restitution: limit(&r), translational: share(0), kept: share(1), ratio: 2.0 * r })
}

/// `μ` from which the bounce comes at `t₁`: `μ₀` times the threshold of (2.32).
pub(crate) fn dot(damping: &str) -> f64 {
    2.0 * threshold(2.0 * damping.parse().unwrap_or(f64::NAN))
}

/// `Ψ_r(t)` of Figure 1: `g = 0`, `t₁ = μ = c = 1`, with two values at whole `t`, and `t_b`.
///
/// **Source**: (2.28), `Ψ_r = e^{rt} v_x(0,t)` while the end is held.
pub(crate) fn kernel(damping: &str, per_trip: i32) -> Result<(Vec<Sided>, Ended), Failed> {
    let rod = Problem::builder().length("1/2").wave_speed(1).damping(damping).impact_speed(1).build()?;
    let form = FirstContact::new(&Parameters::<Double>::of(&rod, &())?);
    let r: f64 = damping.parse()?;
    let value = |k: i32, side: Side| {
        let time = f64::from(k) / f64::from(per_trip);
        (time, side, (r * time).exp() * form.strain(&Estimate::exact(time), side).value())
    };
    let mut rows = Vec::new();
    for k in 0..=4 * per_trip {
        if k > 0 && k % per_trip == 0 {
            rows.push(value(k, Side::Left));
        }
        if k < 4 * per_trip {
            rows.push(value(k, Side::Right));
        }
    }
    Ok((rows, contact(&rod, Wanted::Restitution)?))
}

/// `e_E²` of the tenth contact over `impact.speed`, without damping; `None` where it is not defined or not settled.
pub(crate) fn tenth(grid: &Grid) -> Vec<Option<f64>> {
    let one = |index: usize| {
        let rod = grid.problem(index).ok()?.with_run(crate::Run::Impacts(10)).ok()?;
        rod.solve().ok()?.restitution(9).ok()?.energy_squared.ok()
    };
    (0..grid.len()).into_par_iter().map(one).collect()
}

/// The values of the axis of speeds.
pub(crate) fn speeds(grid: &Grid) -> Vec<f64> {
    grid.axes.last().map_or_else(Vec::new, |axis| axis.values.iter().map(Number::to_f64).collect())
}
