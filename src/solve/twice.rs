//! A second march beside the first: what separates them says how far both may be off.

use crate::cells::Damped;
use crate::history::{History, Scales, Side};
use crate::number::Number;
use crate::rod::{Problem, Speed, Start};

/// How much farther from the truth than from each other two marches are taken to be.
const SAFETY: f64 = 16.0;

/// An estimate of the error of `first` relative to its scales, from a second march of the same problem with cells half as long
/// and with speed, gravity and damping off by four units in their last place: so that what cells leave out, roundings
/// and the rounding of the parameters themselves all show. `None` where the two do not have the same events.
///
/// An estimate and no bound: it is sixteen times what separates the two in every event and at nine times between.
pub(super) fn estimate(problem: &Problem, digits: f64, first: &dyn History<f64>) -> Option<f64> {
    let second = Damped::<f64>::solve_with(&nudged(problem), &(), digits + 1.0, 2).ok()?;
    let Scales { time, velocity, .. } = first.scales();
    let rise = time * velocity;
    let (ours, theirs) = (first.events(), second.events());
    if ours.len() != theirs.len() || ours.iter().zip(theirs).any(|(a, b)| a.kind != b.kind) {
        return None;
    }
    let mut apart = 0.0_f64;
    let mut see = |a: f64, b: f64, scale: f64| apart = apart.max((a - b).abs() / scale);
    for (a, b) in ours.iter().zip(theirs) {
        see(a.time, b.time, time);
        see(a.end_velocity, b.end_velocity, velocity);
        see(a.centre, b.centre, rise);
        see(a.centre_velocity, b.centre_velocity, velocity);
    }
    let end = first.end().min(second.end());
    for k in 1..10 {
        let at = end * f64::from(k) / 10.0;
        let (a, b) = (first.ground_end(&at, Side::Right).ok()?, second.ground_end(&at, Side::Right).ok()?);
        see(a.0, b.0, rise);
        let (a, b) = (first.centre(&at).ok()?, second.centre(&at).ok()?);
        see(a.0, b.0, rise);
        see(a.1, b.1, velocity);
    }
    Some(SAFETY * apart + 64.0 * f64::EPSILON)
}

/// The problem with its parameters off in their last places.
fn nudged(problem: &Problem) -> Problem {
    let off = |number: &Number, ulps: f64| -> Number {
        let value = number.to_f64() * (1.0 + ulps * f64::EPSILON);
        // A double in this range always spells a number.
        format!("{value:e}").parse().unwrap_or_else(|_| number.clone())
    };
    let mut problem = problem.clone();
    problem.gravity = problem.gravity.as_ref().map(|gravity| off(gravity, -4.0));
    problem.rod.damping = problem.rod.damping.as_ref().map(|damping| off(damping, 4.0));
    if let Start::Uniform(Speed::Given(speed) | Speed::DropHeight(speed)) = &mut problem.start {
        *speed = off(speed, 4.0);
    }
    problem
}
