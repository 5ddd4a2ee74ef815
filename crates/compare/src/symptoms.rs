//! Symptoms that need no fit: empty columns, a lost start, other units, another body, an unstable energy, another mass,
//! velocities between two steps, and fronts that are spread.

use super::agreement::Agreement;
use super::cause_fits::{CLEAR, LEFT};
use super::hint::Hint;
use super::model::Model;
use super::norms::ComparedColumn;
use super::reference::Reference;
use super::wording::factor_question;
use dalembert::Problem;
use dalembert::number::Scalar;
use dalembert::quantity::{Measure, Quantity};
use dalembert::{Error, Side};

/// Least factor of a column, or of its inverse, that is one of units.
const OTHER_UNIT: f64 = 10.0;
/// Smallest number of samples for a diagnosis.
pub(super) const FEWEST: usize = 8;
/// Number of standard errors that a symptom exceeds.
const EVIDENT: f64 = 3.0;
/// Rounding of values that are written with six digits.
const SIX_DIGITS: f64 = 5e-6;

/// Returns whether a column is zero throughout although the exact one is not.
pub(super) fn is_empty(column: &ComparedColumn) -> bool {
    column.theirs.iter().all(|value| *value == 0.0) && column.norms.l2.relative.is_some_and(|share| share > LEFT)
}

/// Returns the hint at an empty column.
pub(super) fn empty_column(column: &ComparedColumn) -> Hint {
    let quantity = column.what.name();
    let text = format!("{quantity} is zero throughout: an empty column?");
    Hint { quantity, ..Hint::new("empty", 0.0, text) }
}

fn energy(columns: &[ComparedColumn]) -> Option<&ComparedColumn> {
    columns.iter().find(|column| column.what == Quantity::Energy && !is_empty(column))
}

/// Returns the hint at an initial velocity that was ignored: most of the energy is gone at the second sample.
pub(super) fn lost_start(columns: &[ComparedColumn]) -> Option<Hint> {
    let energy = energy(columns)?;
    let [first, second] = energy.theirs.get(..2)?.try_into().ok()?;
    let lost: f64 = first - second;
    (lost > first / 2.0 && energy.ours[1] > energy.ours[0] / 2.0).then(|| {
        let (lost, first) = (lost.decimal(4), first.decimal(4));
        let text =
            format!("{lost} of {first} of the energy are lost in the first step: is the initial velocity ignored?");
        Hint::new("start_velocity", -1.0, text)
    })
}

/// Returns the hint at an axis that points the other way: all displacements and velocities have the other sign.
pub(super) fn turned_axis(columns: &[ComparedColumn]) -> Option<Hint> {
    let is_along = |column: &&ComparedColumn| {
        let is_zero = column.ours.iter().chain(&column.theirs).all(|value| *value == 0.0);
        matches!(column.what.measure(), Some(Measure::Length | Measure::Velocity)) && !is_zero
    };
    let along: Vec<&ComparedColumn> = columns.iter().filter(is_along).collect();
    let squares = |values: &mut dyn Iterator<Item = f64>| values.map(|value| value * value).sum::<f64>();
    let is_turned = |column: &&ComparedColumn| {
        let left = squares(&mut column.ours.iter().zip(&column.theirs).map(|(ours, theirs)| ours + theirs));
        left < LEFT * LEFT * squares(&mut column.ours.iter().copied())
    };
    // A single column has a sign of its own.
    (along.len() > 1 && along.iter().all(is_turned)).then(|| {
        let names: Vec<&str> = along.iter().map(|column| column.what.name()).collect();
        let text = format!("{} have the other sign: does the axis of the data point to the ground?", names.join(", "));
        Hint::new("axis", -1.0, text)
    })
}

/// Returns the hint at a body that starts the other way: a velocity of the first sample has the other sign, and the
/// column is not merely turned. An end that touches the ground at the start has the speed of the impact before it.
pub(super) fn other_way(columns: &[ComparedColumn], reference: &Reference<'_>) -> Option<Hint> {
    columns.iter().filter(|column| column.what.measure() == Some(Measure::Velocity)).find_map(|column| {
        let (quantity, theirs, first) = (column.what.name(), *column.theirs.first()?, *column.ours.first()?);
        let ours = if first == 0.0 { -reference.rod().speed } else { first };
        let left: f64 = column.ours.iter().zip(&column.theirs).map(|(a, b)| (a + b).powi(2)).sum();
        let size: f64 = column.ours.iter().map(|a| a * a).sum();
        let starts_otherwise = ours * theirs < 0.0 && theirs.abs() > LEFT * ours.abs() && left > LEFT * LEFT * size;
        starts_otherwise.then(|| {
            let [ours, theirs] = [ours, theirs].map(|value| value.decimal(4));
            let text =
                format!("{quantity} is {theirs} in the first row, where the scene has {ours}: which way does it move?");
            Hint { quantity, ..Hint::new("start_velocity", -1.0, text.replace('-', "−")) }
        })
    })
}

/// Returns the hints at displacements and velocities in another unit: all of them have about the same factor, or all of
/// each kind. A single column has a factor of its own.
pub(super) fn other_units(columns: &[ComparedColumn], reference: &Reference<'_>) -> Vec<Hint> {
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let factor = |column: &&ComparedColumn| product(&column.ours, &column.theirs) / product(&column.ours, &column.ours);
    let hint = |measures: &[Measure]| {
        let is_zero = |column: &&ComparedColumn| product(&column.ours, &column.ours) == 0.0;
        let has_measure =
            |column: &&ComparedColumn| column.what.measure().is_some_and(|measure| measures.contains(&measure));
        let along: Vec<_> = columns.iter().filter(has_measure).filter(|column| !is_zero(column)).collect();
        let mean = along.iter().map(factor).sum::<f64>() / along.len() as f64;
        let is_other = mean.is_finite() && !(1.0 / OTHER_UNIT..=OTHER_UNIT).contains(&mean);
        let fits = |column: &&ComparedColumn| {
            let left: f64 = column.ours.iter().zip(&column.theirs).map(|(a, b)| (b - mean * a).powi(2)).sum();
            left < LEFT * LEFT * product(&column.theirs, &column.theirs)
        };
        (along.len() > 1 && is_other && mean > 0.0 && along.iter().all(fits)).then(|| {
            let names: Vec<&str> = along.iter().map(|column| column.what.name()).collect();
            let question = factor_question(along[0].what, mean, LEFT * mean / OTHER_UNIT, reference);
            let text = format!("{} × {}: {question}", names.join(", "), mean.decimal(4));
            Hint::new("factor", mean, text)
        })
    };
    let (length, velocity) = (Measure::Length, Measure::Velocity);
    match hint(&[length, velocity]) {
        Some(hint) => vec![hint],
        None => [length, velocity].iter().filter_map(|measure| hint(&[*measure])).collect(),
    }
}

/// Returns the hint at the displacements and velocities of another body of the chain in place of those of this one.
pub(super) fn other_body(model: &Model<'_>) -> Option<Hint> {
    let (chain, own) = model.problem.chain()?;
    let is_along = |k: &usize| {
        matches!(model.signals[*k].column.measure(), Some(Measure::Length | Measure::Velocity))
            && !model.signals[*k].is_zero
    };
    let square = |problem: &Problem| {
        let errors = model.errors(&model.values(problem, |time| time).ok()?);
        let along = (0..errors.len()).filter(is_along);
        Some(along.flat_map(|k| &errors[k]).map(|error| error * error).sum::<f64>())
    };
    let here = square(model.problem)?;
    let is_clear = |body: &usize| {
        let problem = chain.problem(*body).ok();
        *body != own && problem.and_then(|problem| square(&problem)).is_some_and(|there| there < CLEAR * here)
    };
    // Data of a body that does as this one are no evidence.
    let is_resolved = here > (model.step / 2.0).powi(2) * (model.times.len() * model.signals.len()) as f64;
    let body = (0..chain.bodies().len()).filter(|_| is_resolved).find(is_clear)? + 1;
    let text = format!("the columns are those of body {body}: are the bodies counted from the ground up?");
    Some(Hint::new("other_body", body as f64, text))
}

/// Returns the hint at a mass that is not that of the scene: the kinetic energy of a rod that moves as one before the
/// first contact, which no scheme gets wrong, has another value at the same speed.
///
/// **Source**: the factors of the energy and of the speed of the end that fit best, by least squares; the standard
/// error is that of the residual of the energy.
pub(super) fn unlike_mass(reference: &Reference<'_>, agreement: &Agreement) -> Option<Hint> {
    let Agreement { grid, step, .. } = agreement;
    let first = reference.history.contacts().first().map_or(f64::INFINITY, |contact| contact.impact);
    let count = grid.times.partition_point(|time| *time < first - 2.0 * step);
    let factor = |what: Quantity| {
        let column = agreement.column(what)?;
        let sum =
            |f: &dyn Fn(f64, f64) -> f64| -> f64 { (0..count).map(|k| f(column.ours[k], column.theirs[k])).sum() };
        let factor = sum(&|ours, theirs| ours * theirs) / sum(&|ours, _| ours * ours);
        let left = sum(&|ours, theirs| (theirs - factor * ours).powi(2)) / sum(&|ours, _| ours * ours);
        Some((factor, (left / count.saturating_sub(1).max(1) as f64).sqrt().max(SIX_DIGITS)))
    };
    let ((energy, error), (speed, _)) = (factor(Quantity::KineticEnergy)?, factor(Quantity::EndVelocity)?);
    let (off, by_speed) = (energy - 1.0, (speed * speed - 1.0).abs());
    // The speed of the end gives the energy of a rod that moves as one.
    let (energies, speeds) = (agreement.column(Quantity::KineticEnergy)?, agreement.column(Quantity::EndVelocity)?);
    let per_square = |k: usize| energies.ours[k] / speeds.ours[k].powi(2);
    let is_rigid = (0..count).all(|k| (per_square(k) / per_square(0) - 1.0).abs() < SIX_DIGITS);
    let is_evident = is_rigid && off.abs() > EVIDENT * error && by_speed < LEFT * LEFT * off.abs() && off.abs() < LEFT;
    (count >= FEWEST && is_evident).then(|| {
        let (percent, error_percent) = ((100.0 * off).decimal(3), (100.0 * error).decimal(1));
        let text = format!(
            "mass off by {percent} ± {error_percent} %, as the kinetic energy before the first contact, at the same \
             speed: check density, area and length"
        );
        Hint { error, ..Hint::new("mass", off, text.replace('-', "−")) }
    })
}

/// Returns the hint at an energy without that of the weight: it is the sum of the other two.
///
/// **Errors**: those of the history.
pub(super) fn no_potential(reference: &Reference<'_>, agreement: &Agreement) -> Result<Option<Hint>, Error> {
    let Some(energy) = energy(&agreement.quantities) else { return Ok(None) };
    let parts = [Quantity::KineticEnergy, Quantity::StrainEnergy];
    let parts = reference.history.columns(&parts, &agreement.grid.times, Some(Side::Right))?;
    let sums = parts[0].iter().zip(&parts[1]).map(|(kinetic, strain)| kinetic + strain);
    let square = |sum: f64, (a, b): (f64, &f64)| sum + (a - b).powi(2);
    let (left, base) =
        (sums.zip(&energy.theirs).fold(0.0, square), energy.ours.iter().copied().zip(&energy.theirs).fold(0.0, square));
    let text =
        format!("{} is that without the weight: is the potential energy of gravity left out?", energy.what.name());
    Ok((left < CLEAR * base).then(|| Hint { quantity: energy.what.name(), ..Hint::new("no_potential", -1.0, text) }))
}

/// Returns the hint at an unstable scheme: the energy doubles.
pub(super) fn unstable_energy(columns: &[ComparedColumn]) -> Option<Hint> {
    let energy = energy(columns)?;
    let first = *energy.theirs.first()?;
    let most = energy.theirs.iter().copied().fold(first, f64::max);
    let share = most / first - 1.0;
    (first > 0.0 && share > 1.0).then(|| {
        let text = format!("energy up by {} %, from nowhere: the scheme is unstable", (100.0 * share).decimal(4));
        Hint { quantity: energy.what.name(), ..Hint::new("energy_gain", share, text) }
    })
}

/// Returns the time over which the fronts of the data are spread: the width of a ramp that is as far from a jump.
///
/// **Source**: `∫ e² dt = J² W/12` for a ramp of width `W` about a jump `J`; the median over the jumps at both ends of
/// the first contact, and at the top when the first wave arrives. The start is left out, as there are no data before
/// it. Data that are farther off than any ramp among the samples about the jump have no fronts.
pub(super) fn fronts_spread(reference: &Reference<'_>, agreement: &Agreement) -> Result<Option<f64>, Error> {
    let (history, Agreement { grid, quantities, .. }) = (reference.history, agreement);
    let trip = history.scales().time;
    let released = history.contacts().iter().find_map(|contact| contact.release).unwrap_or(f64::INFINITY);
    let events = history.events().iter().map(|event| event.t);
    let events: Vec<f64> = events.filter(|time| *time > 0.0 && *time <= released).collect();
    let first = history.contacts().first().map_or(0.0, |contact| contact.impact);
    let mut widths = Vec::new();
    for column in quantities.iter().filter(|column| column.what.jumps() && column.what.measure().is_some()) {
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
    Ok(widths.get(widths.len() / 2).copied().filter(|width| *width > agreement.step && *width < trip / 4.0))
}

/// Returns the hint at velocities that are half a step from their times, before any wave has reached the end of the rod
/// that they are of. Velocities that are the central differences of the displacement beside them, as those of Verlet's
/// scheme, belong to their times.
///
/// **Source**: every scheme has such a velocity to a rounding, so that `v − ours = ∓(Δt/2) v_tt`.
pub(super) fn half_step(reference: &Reference<'_>, agreement: &Agreement) -> Option<Hint> {
    let Agreement { grid, step, .. } = agreement;
    let (trip, first) = (reference.history.scales().time, reference.history.contacts().first());
    let first = first.map_or(f64::INFINITY, |contact| contact.impact);
    // Schemes send waves ahead of the first one: the top is left out well before it.
    let columns = [
        (Quantity::EndVelocity, Quantity::EndDisplacement, first),
        (Quantity::TopVelocity, Quantity::TopDisplacement, first + trip / 4.0),
    ];
    columns.into_iter().find_map(|(what, place, until)| {
        let column = agreement.column(what)?;
        let count = grid.times.partition_point(|time| *time < until - step);
        let rate = |k: usize| (column.ours[k] - column.ours[k - 1]) / (grid.times[k] - grid.times[k - 1]);
        let sum = |f: &dyn Fn(usize) -> f64| (1..count).filter(|k| rate(*k).is_finite()).map(f).sum::<f64>();
        let error_at = |k: usize| column.theirs[k] - column.ours[k];
        let (square, cross) = (sum(&|k| rate(k) * rate(k)), sum(&|k| error_at(k) * rate(k)));
        let late = -cross / square;
        let left = sum(&|k| (error_at(k) + late * rate(k)).powi(2));
        let is_half = (late.abs() / step - 0.5).abs() < LEFT * 0.5;
        let error = (left / square / (count as f64 - 2.0)).sqrt();
        let misfit = sum(&|k| error_at(k).powi(2));
        let is_seen = misfit > SIX_DIGITS * SIX_DIGITS * (1..count).map(|k| column.theirs[k].powi(2)).sum::<f64>();
        let is_evident = count > 3 && is_half && is_seen && EVIDENT * error < late.abs();
        let place = agreement.column(place).map(|place| place.theirs.as_slice());
        let is_central = place.is_some_and(|place| is_central_difference(&grid.times[..count], place, &column.theirs));
        (is_evident && !is_central).then(|| {
            let (quantity, side) = (what.name(), if late > 0.0 { "late" } else { "early" });
            let steps = late.abs() / step;
            let text = format!("{quantity} is {steps:.2} steps {side}: is it the velocity between two steps?");
            Hint { quantity, error, ..Hint::new("half_step", late, text) }
        })
    })
}

/// Returns whether `velocities` are nearer to the central differences of `places` than to those of one step, all of
/// them by a common factor that a wrong clock makes.
fn is_central_difference(times: &[f64], places: &[f64], velocities: &[f64]) -> bool {
    let misfit = |before: usize, after: usize| {
        let difference = |k: usize| (places[k + after] - places[k - before]) / (times[k + after] - times[k - before]);
        let pairs = (1..times.len().saturating_sub(1)).map(|k| (velocities[k], difference(k)));
        let pairs: Vec<(f64, f64)> = pairs.filter(|(_, difference)| difference.is_finite()).collect();
        let sum = |f: fn(f64, f64) -> f64| pairs.iter().map(|(v, d)| f(*v, *d)).sum::<f64>();
        let factor = sum(|v, d| v * d) / sum(|_, d| d * d);
        pairs.iter().map(|(v, d)| (v - factor * d).powi(2)).sum::<f64>()
    };
    misfit(1, 1) < misfit(1, 0).min(misfit(0, 1))
}
