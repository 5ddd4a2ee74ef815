//! First contacts over impact speed and damping.

use std::iter::once;

use super::Failed;
use crate::error::Error;
use crate::first_contact::FirstContact;
use crate::mapped::{CollectVec, mapped, try_mapped};
use crate::motion::{Motion, Side};
use crate::number::{Analytic, Estimate, Number, Scalar};
use crate::paper::formulas::limit;
use crate::problem::{Parameters, Problem, Run};
use crate::quantity::{Restitution, energy_shares, restitution};
use crate::solve::{Numbers, Plan, Question};
use crate::sweep::{Axis, Grid, threshold_near};
use crate::threads::Threads;

/// `r` of Figures 4–7, where `c = L = g = 1`.
pub(crate) const DAMPINGS: [&str; 4] = ["0", "0.1", "0.2", "0.3"];

pub(crate) type Double = Estimate<f64>;
/// A first contact that ends with a bounce: `t_b`, and what is asked there.
pub(crate) type Ended = Option<(Double, Vec<Option<Double>>)>;

/// What is asked of a first contact between its impact and its bounce.
pub(super) type Wanted = fn(&dyn Motion<Double>, [&Double; 2]) -> Result<Vec<Option<Double>>, Error>;

/// `e_E²`.
pub(super) const RESTITUTION: Wanted =
    |motion, [from, to]| Ok(vec![restitution(motion, (from, Some(to)))?.energy_squared.ok()]);

/// `E_h(t_b)/E(t_b)` and `E(t_b)/E(0)`.
pub(super) const SHARES: Wanted =
    |motion, [from, to]| Ok(energy_shares(motion, (from, Some(to)))?.map(Result::ok).to_vec());

/// `E_h(t_b)` and `E_z(t_b)`.
pub(super) const ENERGIES: Wanted =
    |motion, [_, to]| motion.energy(to).map(|energy| vec![Some(energy.translational), Some(energy.vibrational)]);

/// The first contacts of a grid over `impact.speed` and `rod.damping`, the speed varying fastest, to `accuracy` of the
/// numbers, or of 1 where they are less.
pub(crate) fn contacts(grid: &Grid, wanted: Wanted, accuracy: f64, threads: Threads) -> Result<Vec<Ended>, Failed> {
    threads.all(grid.len(), |index| contact(&grid.problem(index)?, wanted, accuracy))
}

/// The grid of the paper's rod, `c = L = g = 1`.
pub(crate) fn grid(dampings: &str, speeds: &str) -> Result<Grid, Failed> {
    let rod = Problem::uniform(1.into(), 1.into(), 1.into(), 1.into());
    let axes = [format!("rod.damping={dampings}"), format!("impact.speed={speeds}")];
    Ok(Grid::new(rod, try_mapped(&axes, |axis| axis.parse::<Axis>())?)?)
}

fn contact(problem: &Problem, wanted: Wanted, accuracy: f64) -> Result<Ended, Failed> {
    let plan = Plan::of(problem, &Question::bounce(Numbers::Double(Some(accuracy))))?;
    let query = |motion: &dyn Motion<Double>| {
        let Some((from, Some(to))) = motion.contact_times(0) else { return Ok(None) };
        let values = wanted(motion, [&from, &to])?;
        // The time relative to itself, and the others to 1.
        let whole = to.clone() / Double::exact(*to.value());
        Ok(Some((whole, (to, values))))
    };
    let found = plan.ask::<f64, _>(problem, query, |ended| {
        ended.iter().flat_map(|(whole, (_, values))| once(whole).chain(values.iter().flatten())).collect_vec()
    })?;
    Ok(found.map(|(_, ended)| ended))
}

/// What Figures 4–7 tend to for `μ → ∞`, as long as `t_b = t₁`.
#[derive(Clone, Debug)]
pub(crate) struct Limits {
    /// `lim e_E = 2e^{−R}(I₀(R) − I₁(R)) − e^{−2R}`.
    pub(crate) restitution: Double,
    /// `lim E_h/E` and `lim E/E(0)`.
    pub(crate) translational: Option<Double>,
    pub(crate) kept: Option<Double>,
    /// `e^{−2R}`, `R = r t₁`: what the paper supposes of `E/E(0)`.
    pub(crate) decay: Double,
}

/// The limits for a damping: the motion is linear in `μ` and `g`, so for `μ → ∞` all ratios are those of `g = 0`.
pub(crate) fn limits(damping: &str) -> Result<Limits, Failed> {
    let rod = Problem::builder().length(1).wave_speed(1).damping(damping).impact_speed(1).build()?;
    let shares = contact(&rod, SHARES, 1e-13)?.map_or(Vec::new(), |(_, shares)| shares);
    let share = |k: usize| shares.get(k).cloned().flatten();
    let r = Double::from_number(&damping.parse()?, &());
    let decay = (-r.int(4) * &r).exp();
    Ok(Limits { restitution: limit(&r), translational: share(0), kept: share(1), decay })
}

/// `μ` from which the bounce comes at `t₁`: `μ₀` times the threshold of (2.32).
pub(crate) fn dot(damping: &str) -> f64 {
    2.0 * threshold_near(2.0 * damping.parse().unwrap_or(f64::NAN))
}

/// Rows of Figure 1: `r`, `t`, which limit, `Ψ_r(t)` for `g = 0`, `t₁ = μ = c = 1`, and `t_b`. Two are of each whole
/// `t`.
///
/// **Source**: (2.28), `Ψ_r = e^{rt} v_x(0,t)` while the end is held.
pub(crate) fn kernel(damping: &str, per_trip: i32) -> Result<Vec<Vec<Option<Double>>>, Failed> {
    let rod = Problem::builder().length("1/2").wave_speed(1).damping(damping).impact_speed(1).build()?;
    let form = FirstContact::new(&Parameters::<Double>::of(&rod, &())?);
    let r = Double::from_number(&damping.parse()?, &());
    // As sharp as doubles can be: the index prints 14 decimals.
    let bounce = contact(&rod, |_, _| Ok(Vec::new()), 1e-15)?.map(|bounce| bounce.0);
    let row = |(k, side): (i32, Side)| {
        let time = Double::exact(f64::from(k) / f64::from(per_trip));
        let value = (r.clone() * &time).exp() * form.strain(&time, side);
        let side = Double::exact(if side == Side::Left { -1.0 } else { 1.0 });
        vec![damping.parse().ok().map(Double::exact), Some(time), Some(side), Some(value), bounce.clone()]
    };
    let sides = |k: i32| match k {
        0 => vec![(k, Side::Right)],
        k if k == 4 * per_trip => vec![(k, Side::Left)],
        k if k % per_trip == 0 => vec![(k, Side::Left), (k, Side::Right)],
        k => vec![(k, Side::Right)],
    };
    Ok(mapped((0..=4 * per_trip).flat_map(sides), row))
}

/// `e_E²` of the tenth contact over `impact.speed`, without damping; `None` where it is not defined or not settled.
pub(crate) fn tenth(grid: &Grid, threads: Threads) -> Result<Vec<Option<Double>>, Failed> {
    let one = |index: usize| {
        let rod = grid.problem(index).ok()?.with_run(Run::Impacts(10)).ok()?;
        let query = |motion: &dyn Motion<Double>| {
            let contact = motion.contacts().get(9);
            contact.map(|contact| restitution(motion, contact.times())).transpose()
        };
        let found = rod.solve().ok()?.ask(query, |found| found.iter().flat_map(Restitution::numbers).collect_vec());
        found.ok()??.energy_squared.ok()
    };
    threads.all(grid.len(), |index| Ok(one(index)))
}

pub(crate) fn speeds(grid: &Grid) -> Vec<Double> {
    let exact = |value: &Number| Estimate::exact(value.to_f64());
    grid.axes.last().map_or_else(Vec::new, |axis| mapped(&axis.values, exact))
}
