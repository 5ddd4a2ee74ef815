//! What data show without a fit: empty columns, a lost start, energy from nowhere, half steps, and how far fronts are
//! spread.

use serde::Serialize;

use super::agree::Agreement;
use super::norms::Compared;
use super::ours::Ours;
use dalembert::Error;
use dalembert::Side;
use dalembert::number::Scalar;
use dalembert::quantity::Quantity;

/// One number that is wrong.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Verdict {
    /// Which: `wave_speed`.
    pub(crate) kind: &'static str,
    /// The column that it is about; `all` where it is all of them.
    pub(crate) quantity: &'static str,
    pub(crate) value: f64,
    /// Its standard error; zero where it is counted.
    pub(crate) error: f64,
    pub(crate) text: String,
}

/// From what value on a number that is wrong would be said: a share, a time, or an offset.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct ToldFrom {
    pub(crate) kind: &'static str,
    pub(crate) quantity: &'static str,
    pub(crate) value: f64,
}

#[derive(Debug, Default)]
pub(crate) struct Judgement {
    pub(crate) hints: Vec<Verdict>,
    /// Where no number is: from what value on each would have been said.
    pub(crate) told_from: Vec<ToldFrom>,
    /// Over how long a time the fronts are spread.
    pub(crate) spread: Option<f64>,
}

/// At most so much of ‖e‖₂ is left by an explanation.
pub(super) const LEFT: f64 = 0.5;
/// Fewer samples say nothing.
pub(super) const FEWEST: usize = 8;

pub(super) fn is_empty(column: &Compared) -> bool {
    column.theirs.iter().all(|value| *value == 0.0) && column.norms.l2.relative.is_some_and(|share| share > LEFT)
}

pub(super) fn empty(column: &Compared) -> Verdict {
    let name = column.what.name();
    let text = format!("{name} is zero throughout: an empty column?");
    Verdict { kind: "empty", quantity: name, value: 0.0, error: 0.0, text }
}

fn energy(columns: &[Compared]) -> Option<&Compared> {
    columns.iter().find(|column| column.what == Quantity::Energy && !is_empty(column))
}

/// A start that is not that of the scene: the greater part of the energy is gone at the second sample.
pub(super) fn lost_start(columns: &[Compared]) -> Option<Verdict> {
    let energy = energy(columns)?;
    let [first, second] = energy.theirs.get(..2)?.try_into().ok()?;
    let lost: f64 = first - second;
    (lost > first / 2.0 && energy.ours[1] > energy.ours[0] / 2.0).then(|| {
        let (lost, first) = (lost.decimal(4), first.decimal(4));
        let text =
            format!("{lost} of {first} of the energy are lost in the first step: is the initial velocity ignored?");
        Verdict { kind: "start_velocity", quantity: "all", value: -1.0, error: 0.0, text }
    })
}

/// A mass that is not that of the scene: before the first contact nothing happens that a scheme may do wrong, and the
/// kinetic energy is another at the same speed.
///
/// **Source**: the factor by which the energy, and that by which the speed of the end, fits best, by least squares;
/// what is left of the energy gives the standard error.
pub(super) fn lighter(ours: &Ours<'_>, agreement: &Agreement) -> Option<Verdict> {
    let Agreement { grid, step, .. } = agreement;
    let first = ours.history.contacts().first().map_or(f64::INFINITY, |contact| contact.impact);
    let count = grid.times.partition_point(|time| *time < first - 2.0 * step);
    let factor = |what: Quantity| {
        let column = agreement.column(what)?;
        let sum =
            |f: &dyn Fn(f64, f64) -> f64| -> f64 { (0..count).map(|k| f(column.ours[k], column.theirs[k])).sum() };
        let factor = sum(&|ours, theirs| ours * theirs) / sum(&|ours, _| ours * ours);
        let left = sum(&|ours, theirs| (theirs - factor * ours).powi(2)) / sum(&|ours, _| ours * ours);
        Some((factor, (left / count.saturating_sub(1).max(1) as f64).sqrt().max(ROUNDING)))
    };
    let ((energy, error), (speed, _)) = (factor(Quantity::KineticEnergy)?, factor(Quantity::EndVelocity)?);
    let (off, by_speed) = (energy - 1.0, (speed * speed - 1.0).abs());
    let told = off.abs() > 2.0 * error && by_speed < LEFT * LEFT * off.abs() && off.abs() < LEFT;
    (count >= FEWEST && told).then(|| {
        let (percent, error_percent) = ((100.0 * off).decimal(3), (100.0 * error).decimal(1));
        let text = format!(
            "mass off by {percent} ± {error_percent} %, as the kinetic energy before the first contact, at the same \
             speed: check density, area and length"
        );
        Verdict { kind: "mass", quantity: "all", value: off, error, text: text.replace('-', "−") }
    })
}

/// Half of the last of six digits, in which numbers may be written.
const ROUNDING: f64 = 5e-6;

/// Energy from nowhere, as much as there was.
pub(super) fn gained(columns: &[Compared]) -> Option<Verdict> {
    let energy = energy(columns)?;
    let first = *energy.theirs.first()?;
    let most = energy.theirs.iter().copied().fold(first, f64::max);
    let share = most / first - 1.0;
    (first > 0.0 && share > 1.0).then(|| {
        let text = format!("energy up by {} %, from nowhere: the scheme is unstable", (100.0 * share).decimal(4));
        Verdict { kind: "energy_gain", quantity: energy.what.name(), value: share, error: 0.0, text }
    })
}

/// Over how long a time the fronts of the data are spread: the width of a ramp that is as far from a jump.
///
/// **Source**: `∫ e² dt = J² W/12` for a ramp of the width `W` about a jump `J`; the median over the jumps at both
/// ends of the first contact, and at the top when the first wave is there. The start is left out: before it there are
/// no data.
pub(super) fn spread(ours: &Ours<'_>, agreement: &Agreement) -> Result<Option<f64>, Error> {
    let (history, Agreement { grid, quantities: columns, .. }) = (ours.history, agreement);
    let trip = history.scales().time;
    let released = history.contacts().iter().find_map(|contact| contact.release).unwrap_or(f64::INFINITY);
    let events = history.events().iter().map(|event| event.t);
    let events: Vec<f64> = events.filter(|time| *time > 0.0 && *time <= released).collect();
    let first = history.contacts().first().map_or(0.0, |contact| contact.impact);
    let mut widths = Vec::new();
    for column in columns.iter().filter(|column| column.what.jumps() && column.what.measure().is_some()) {
        let times = if column.what == Quantity::TopVelocity { vec![first + trip / 2.0] } else { events.clone() };
        for time in times.into_iter().filter(|time| *time < *history.end()) {
            let limit = |side| Ok::<_, Error>(history.columns(&[column.what], &[time], Some(side))?[0][0]);
            let jump = limit(Side::Right)? - limit(Side::Left)?;
            let near = |k: &usize| (grid.times[*k] - time).abs() < trip / 8.0;
            let square = |k: usize| grid.weights[k] * (column.theirs[k] - column.ours[k]).powi(2);
            let sum: f64 = (0..grid.times.len()).filter(near).map(square).sum();
            let most = column.ours.iter().fold(0.0f64, |most, value| most.max(value.abs()));
            widths.extend((jump.abs() > LEFT * most).then(|| 12.0 * sum / (jump * jump)));
        }
    }
    widths.sort_by(f64::total_cmp);
    Ok(widths.get(widths.len() / 2).copied().filter(|width| *width > agreement.step))
}

/// Velocities that are half a step from their times: of a top, or an end, that nothing has reached yet but gravity.
///
/// **Source**: there every scheme has the velocity to a rounding, and `v − ours = ∓(Δt/2) v_tt`.
pub(super) fn half_step(ours: &Ours<'_>, agreement: &Agreement) -> Option<Verdict> {
    let Agreement { grid, quantities: columns, step, .. } = agreement;
    let (trip, first) = (ours.history.scales().time, ours.history.contacts().first());
    let first = first.map_or(f64::INFINITY, |contact| contact.impact);
    let of = |column: &Compared| {
        let until = match column.what {
            Quantity::EndVelocity => first,
            // Well before the first wave, of which schemes send some ahead.
            Quantity::TopVelocity => first + trip / 4.0,
            _ => return None,
        };
        let count = grid.times.partition_point(|time| *time < until - step);
        let rate = |k: usize| (column.ours[k] - column.ours[k - 1]) / (grid.times[k] - grid.times[k - 1]);
        let sum = |f: &dyn Fn(usize) -> f64| (1..count).filter(|k| rate(*k).is_finite()).map(f).sum::<f64>();
        let error = |k: usize| column.theirs[k] - column.ours[k];
        let (square, cross) = (sum(&|k| rate(k) * rate(k)), sum(&|k| error(k) * rate(k)));
        let late = -cross / square;
        let left = sum(&|k| (error(k) + late * rate(k)).powi(2));
        let is_half = (late.abs() / step - 0.5).abs() < LEFT * 0.5;
        let error = (left / square / (count as f64 - 2.0)).sqrt();
        (count > 3 && is_half && error < late.abs() / 2.0).then(|| {
            let (name, side) = (column.what.name(), if late > 0.0 { "late" } else { "early" });
            let steps = late.abs() / step;
            let text = format!("{name} is {steps:.2} steps {side}: is it the velocity between two steps?");
            Verdict { kind: "half_step", quantity: name, value: late, error, text }
        })
    };
    columns.iter().find_map(of)
}
