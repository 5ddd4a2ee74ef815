//! Every way to an answer.

use super::value::{Answer, Answers, Trouble};
use crate::damped::Damped;
use crate::first_contact::{Bounce, Estimate, FirstContact, UndampedContact};
use crate::history::{Ending, EventKind, History, Side};
use crate::modal::Modal;
use crate::number::{Analytic, Number, Scalar};
use crate::rod::{Parameters, Problem, Run};
use crate::scene::{Engine, Plan, System};
use crate::solve::{Solution, solve};

/// The rod of a question, as a person would write it: `c = 1` unless said otherwise.
#[derive(Clone, Copy, Debug)]
pub struct Rod {
    /// `L`.
    pub length: &'static str,
    /// `c`.
    pub wave_speed: &'static str,
    /// `r`.
    pub damping: &'static str,
    /// `g`.
    pub gravity: &'static str,
    /// `μ`.
    pub speed: &'static str,
    /// Followed to this time; empty: through the first contact and the flight after it.
    pub until: &'static str,
}

impl Rod {
    /// The problem.
    pub(super) fn problem(&self) -> Result<Problem, Trouble> {
        let number = |text: &str| text.parse::<Number>();
        let mut problem = Problem::uniform(
            number(self.length)?,
            number(self.wave_speed)?,
            number(self.gravity)?,
            number(self.speed)?,
        );
        problem.rod.damping = Some(number(self.damping)?).filter(|r| !r.is_zero());
        if !self.until.is_empty() {
            problem.run = Run::Time(number(self.until)?);
        }
        Ok(problem)
    }
}

/// A time: a number, or [`AT_BOUNCE`].
pub(super) type Time = &'static str;
/// `t_b`.
pub(super) const AT_BOUNCE: Time = "t_b";

/// What is asked of a rod.
#[derive(Clone, Copy, Debug)]
pub enum Of {
    /// `t_b`.
    Bounce,
    /// The time of the event next to this one.
    Event(EventKind, f64),
    /// `v_x(0,t)`.
    Stress(Time, Side),
    /// The jump of `v_x(0,·)` at t.
    StressJump(Time),
    /// The jump of `v_t(x,·)` at t.
    VelocityJump(&'static str, Time),
    /// The jump of `v_x(x,·)` at t.
    StrainJump(&'static str, Time),
    /// `v` at `(x,t)`.
    Displacement(&'static str, Time),
    /// `v_t` at `(x,t)`.
    Velocity(&'static str, Time, Side),
    /// `v_x` at `(x,t)`.
    Strain(&'static str, Time, Side),
    /// `h(t)`.
    Centre(Time),
    /// `P(t) = L h′(t)`.
    Momentum(Time),
    /// `E(t)`.
    Energy(Time),
    /// `E_h(t)`.
    Translational(Time),
    /// `E_z(t)`.
    Vibrational(Time),
    /// `e_P`.
    MomentumRestitution,
    /// `e_E²`.
    Restitution,
    /// `E_h(t_b)/E(t_b)`.
    Share,
    /// `E(t_b)/E(0)`.
    Left,
    /// `E(t_b)/E(0) e^{2r t_b}`.
    Retained,
    /// A number that belongs to no rod.
    Constant,
    /// `t*`.
    TopTime,
    /// `h_max`.
    TopHeight,
}

impl Of {
    /// What a jump is the difference of: later minus earlier.
    fn sides(self) -> Option<[Of; 2]> {
        let of = |side: Side| match self {
            Of::StressJump(time) => Some(Of::Stress(time, side)),
            Of::VelocityJump(x, time) => Some(Of::Velocity(x, time, side)),
            Of::StrainJump(x, time) => Some(Of::Strain(x, time, side)),
            _ => None,
        };
        Some([of(Side::Right)?, of(Side::Left)?])
    }
}

/// A way to the answer.
#[derive(Clone, Copy, Debug)]
pub enum Route {
    /// A formula in plain doubles, as it stands in print or as a reader would program it.
    Plain(&'static str, fn() -> f64),
    /// A formula in numbers of so many digits.
    #[cfg(feature = "mp")]
    Long(&'static str, u32, fn(u32) -> rug::Float),
    /// The closed form over rays, in doubles with a bound.
    Rays,
    /// The bounce in doubles, by modes where rays cancel, in longer numbers where both fail.
    Within(f64),
    /// The modal sum, in doubles with a bound.
    Modes,
    /// The printed closed forms of `r = 0`, in fractions.
    Paper,
    /// The lattice, in doubles with a bound.
    Lattice,
    /// The lattice, in fractions.
    Fractions,
    /// Characteristic cells from the start, in doubles with an estimate.
    Cells,
    /// What `--accuracy` does.
    Accuracy(f64),
    /// What `--digits` does.
    Digits(u32),
    /// The closed form over rays, in numbers of so many digits.
    LongRays(u32),
    /// What `--certified` does.
    Enclosures(u32),
}

impl Route {
    /// In words.
    pub(super) fn name(self) -> String {
        match self {
            Route::Plain(what, _) => format!("{what}, plain doubles"),
            #[cfg(feature = "mp")]
            Route::Long(what, digits, _) => format!("{what}, {digits} digits"),
            Route::Rays => "closed form, doubles".into(),
            Route::Within(accuracy) => format!("closed form within {accuracy:e}"),
            Route::Modes => "modal sum, doubles".into(),
            Route::Paper => "printed form, fractions".into(),
            Route::Lattice => "lattice, doubles".into(),
            Route::Fractions => "lattice, fractions".into(),
            Route::Cells => "cells, doubles".into(),
            Route::Accuracy(accuracy) => format!("--accuracy {accuracy:e}"),
            Route::Digits(digits) => format!("--digits {digits}"),
            Route::LongRays(digits) => format!("closed form, {digits} digits"),
            Route::Enclosures(digits) => format!("--certified --digits {digits}"),
        }
    }

    /// Whether it can be taken without long numbers.
    pub(super) fn in_doubles(self) -> bool {
        #[cfg(feature = "mp")]
        if matches!(self, Route::Long(..)) {
            return false;
        }
        let long = matches!(self, Route::Digits(_) | Route::LongRays(_) | Route::Enclosures(_));
        !(long || matches!(self, Route::Paper | Route::Fractions | Route::Accuracy(_)))
    }

    /// The answer.
    pub(super) fn answer(self, rod: &Rod, of: Of) -> Result<Answer, Trouble> {
        match (self, of.sides()) {
            (Route::Plain(_, formula), _) => Ok(Answer { value: formula().value(), bound: f64::INFINITY }),
            #[cfg(feature = "mp")]
            (Route::Long(_, digits, formula), _) => {
                let value = formula(crate::number::bits_for_digits(digits) + SPARE_BITS).value();
                Ok(Answer { value, bound: f64::INFINITY })
            }
            (_, Some([later, earlier])) => {
                let problem = rod.problem()?;
                let (later, earlier) = (self.solved(&problem, later)?, self.solved(&problem, earlier)?);
                let value = later.value.minus(&earlier.value).ok_or_else(|| Trouble("two kinds of numbers".into()))?;
                Ok(Answer { value, bound: later.bound + earlier.bound })
            }
            (_, None) => self.solved(&rod.problem()?, of),
        }
    }

    fn solved(self, problem: &Problem, of: Of) -> Result<Answer, Trouble> {
        match self {
            Route::Plain(..) => not_here("of a rod"),
            #[cfg(feature = "mp")]
            Route::Long(..) => not_here("of a rod"),
            Route::Rays => by_rays::<f64>(problem, &(), of, FirstContact::bounce),
            Route::Within(accuracy) => by_rays::<f64>(problem, &(), of, |contact| contact.bounce_within(accuracy)),
            Route::Modes => by_modes(problem, of),
            Route::Lattice => answered(of_history(&crate::solve::undamped::<f64>(problem, &())?, of)),
            Route::Cells => answered(of_history(&Damped::<f64>::solve(problem, &(), CELL_DIGITS)?, of)),
            #[cfg(feature = "mp")]
            Route::Paper => by_paper::<rug::Rational>(problem, &(), of),
            #[cfg(feature = "mp")]
            Route::Fractions => answered(of_history(&crate::solve::undamped::<rug::Rational>(problem, &())?, of)),
            #[cfg(feature = "mp")]
            Route::LongRays(digits) => {
                let bits = crate::number::bits_for_digits(digits) + SPARE_BITS;
                by_rays::<rug::Float>(problem, &bits, of, FirstContact::bounce)
            }
            #[cfg(feature = "mp")]
            Route::Enclosures(digits) => {
                let ask = |history: &dyn History<crate::number::Interval>| of_history(history, of);
                let found = crate::solve::certify(
                    problem,
                    digits,
                    ask,
                    |found| found.iter().map(|e| &e.value).collect(),
                    |_, _| (),
                );
                answered(found)
            }
            #[cfg(not(feature = "mp"))]
            Route::Paper => by_paper::<f64>(problem, &(), of),
            Route::Accuracy(accuracy) => planned(problem, System::Double(Some(accuracy)), of),
            #[cfg(feature = "mp")]
            Route::Digits(digits) => planned(problem, System::Digits(digits), of),
            #[cfg(not(feature = "mp"))]
            _ => Err(crate::Error::NoMultiprecision.into()),
        }
    }
}

/// The digits that cells are marched to in doubles.
const CELL_DIGITS: f64 = 13.0;
/// Bits beyond the digits asked for, where rays hardly cancel.
#[cfg(feature = "mp")]
const SPARE_BITS: u32 = 32;
/// Modes that are summed.
const MODES: u32 = 2048;

/// `None`: there is no bounce.
type Found<S> = Result<Option<Estimate<S>>, Trouble>;

fn answered<S: Answers>(found: Found<S>) -> Result<Answer, Trouble> {
    Ok(match found? {
        Some(estimate) => estimate.into(),
        None => Answer { value: super::Value::NoBounce, bound: 0.0 },
    })
}

fn lift<S: Scalar>(text: &str, precision: &S::Precision) -> Result<S, Trouble> {
    Ok(S::from_number(&text.parse()?, precision))
}

fn not_here<T>(what: &str) -> Result<T, Trouble> {
    Err(Trouble(format!("this route is not asked {what}")))
}

/// By the closed forms over rays.
fn by_rays<S: Analytic + Answers>(
    problem: &Problem,
    precision: &S::Precision,
    of: Of,
    search: impl FnOnce(&FirstContact<S>) -> Bounce<S>,
) -> Result<Answer, Trouble> {
    let rod = Parameters::<S>::of(problem, precision)?;
    let contact = FirstContact::new(&rod);
    let bounce = search(&contact);
    if matches!(of, Of::Bounce) {
        return Ok(bounce.into());
    }
    let released = match &bounce {
        Bounce::At { time, .. } => Some(time.clone()),
        _ => None,
    };
    let released = || released.clone().ok_or_else(|| Trouble("no bounce".into()));
    let at = |time: Time| if time == AT_BOUNCE { released() } else { lift::<S>(time, precision) };
    let known = |value: S| {
        let error = value.to_f64().abs() * 2f64.powf(value.log2_roundoff() + 6.0);
        Estimate { value, error }
    };
    let estimate = match of {
        Of::Bounce | Of::Event(..) | Of::Constant | Of::StressJump(_) | Of::VelocityJump(..) | Of::StrainJump(..) => {
            return not_here("for that");
        }
        Of::Stress(time, side) => contact.stress(&at(time)?, side),
        Of::Displacement(x, time) => {
            let (field, errors) = contact.field(&lift(x, precision)?, &at(time)?, Side::Right);
            Estimate { value: field.displacement, error: errors[0] }
        }
        Of::Velocity(x, time, side) => {
            let (field, errors) = contact.field(&lift(x, precision)?, &at(time)?, side);
            Estimate { value: field.velocity, error: errors[1] }
        }
        Of::Strain(x, time, side) => {
            let (field, errors) = contact.field(&lift(x, precision)?, &at(time)?, side);
            Estimate { value: field.strain, error: errors[2] }
        }
        Of::Centre(time) => {
            let time = at(time)?;
            if released().is_ok_and(|end| time > end) {
                known(contact.rebound(&released()?).flight(&time).0)
            } else {
                contact.centre(&time).0
            }
        }
        Of::Momentum(time) => {
            let time = at(time)?;
            let rate = if released().is_ok_and(|end| time > end) {
                known(contact.rebound(&released()?).flight(&time).1)
            } else {
                contact.centre(&time).1
            };
            Estimate { error: rate.error * rod.length.to_f64(), value: rate.value * &rod.length }
        }
        Of::Energy(time) => {
            let (energy, errors) = contact.energy(&at(time)?);
            Estimate { value: energy.total, error: errors[0] }
        }
        Of::Translational(time) => {
            let (energy, errors) = contact.energy(&at(time)?);
            Estimate { value: energy.translational, error: errors[1] }
        }
        Of::Vibrational(time) => {
            let (energy, errors) = contact.energy(&at(time)?);
            Estimate { value: energy.vibrational, error: errors[2] }
        }
        _ => known(after_bounce(&contact, &rod.damping, &released()?, of)?),
    };
    Ok(estimate.into())
}

/// What is asked of the bounce as a whole.
fn after_bounce<S: Analytic>(contact: &FirstContact<S>, damping: &S, end: &S, of: Of) -> Result<S, Trouble> {
    let none = || Trouble("undefined".into());
    let rebound = contact.rebound(end);
    match of {
        Of::MomentumRestitution => rebound.momentum_restitution().ok_or_else(none),
        Of::Restitution => rebound.energy_restitution_squared().ok_or_else(none),
        Of::Share => contact.restitution_factors(end).map(|factors| factors.0).ok_or_else(none),
        Of::Left => contact.restitution_factors(end).map(|factors| factors.1).ok_or_else(none),
        Of::Retained => {
            let left = contact.restitution_factors(end).ok_or_else(none)?.1;
            let decay = damping.int(2) * damping * end;
            Ok(left * &decay.exp())
        }
        Of::TopTime => rebound.highest().map(|top| top.0).ok_or_else(none),
        _ => rebound.highest().map(|top| top.1).ok_or_else(none),
    }
}

/// By the modes, with the bounce from where their stress changes its sign.
fn by_modes(problem: &Problem, of: Of) -> Result<Answer, Trouble> {
    let rod = Parameters::<f64>::of(problem, &())?;
    let modal = Modal::new(&rod, MODES);
    let end = || released_by_modes(&modal, rod.round_trip());
    let at = |time: Time| if time == AT_BOUNCE { end() } else { lift::<f64>(time, &()) };
    let estimate = match of {
        Of::Bounce => Estimate { value: end()?, error: f64::INFINITY },
        Of::Stress(time, side) => modal.stress(&at(time)?, side),
        Of::Displacement(x, time) => {
            let (field, errors) = modal.field(&lift(x, &())?, &at(time)?, Side::Right);
            Estimate { value: field.displacement, error: errors[0] }
        }
        Of::Velocity(x, time, side) => {
            let (field, errors) = modal.field(&lift(x, &())?, &at(time)?, side);
            Estimate { value: field.velocity, error: errors[1] }
        }
        Of::Strain(x, time, side) => {
            let (field, errors) = modal.field(&lift(x, &())?, &at(time)?, side);
            Estimate { value: field.strain, error: errors[2] }
        }
        Of::Centre(time) => modal.centre(&at(time)?).0,
        Of::Momentum(time) => {
            let rate = modal.centre(&at(time)?).1;
            Estimate { value: rate.value * rod.length, error: rate.error * rod.length }
        }
        Of::Energy(time) => modal.energy(&at(time)?),
        Of::Translational(time) => translational(&modal, &rod, at(time)?),
        Of::Vibrational(time) => {
            let (total, moving) = (modal.energy(&at(time)?), translational(&modal, &rod, at(time)?));
            Estimate { value: total.value - moving.value, error: total.error + moving.error }
        }
        Of::MomentumRestitution => {
            let rate = modal.centre(&end()?).1;
            Estimate { value: rate.value / rod.speed, error: rate.error / rod.speed }
        }
        Of::Restitution => {
            let (moving, start) = (translational(&modal, &rod, end()?), 0.5 * rod.length * rod.speed * rod.speed);
            Estimate { value: moving.value / start, error: moving.error / start }
        }
        Of::Share => {
            let (total, moving) = (modal.energy(&end()?), translational(&modal, &rod, end()?));
            Estimate { value: moving.value / total.value, error: (moving.error + total.error) / total.value }
        }
        Of::Left => {
            let (total, start) = (modal.energy(&end()?), 0.5 * rod.length * rod.speed * rod.speed);
            Estimate { value: total.value / start, error: total.error / start }
        }
        Of::Retained => {
            let time = end()?;
            let (total, start) = (modal.energy(&time), 0.5 * rod.length * rod.speed * rod.speed);
            let growth = (2.0 * rod.damping * time).exp() / start;
            Estimate { value: total.value * growth, error: total.error * growth }
        }
        _ => return not_here("for that"),
    };
    Ok(estimate.into())
}

fn translational(modal: &Modal<f64>, rod: &Parameters<f64>, time: f64) -> Estimate<f64> {
    let (height, rate) = modal.centre(&time);
    let value = rod.length * (0.5 * rate.value * rate.value + rod.gravity * height.value);
    let error = rod.length * ((rate.value.abs() + rate.error) * rate.error + rod.gravity * height.error);
    Estimate { value, error: error + 4.0 * f64::EPSILON * rod.length * rate.value * rate.value }
}

/// Where the stress of the modes changes its sign: looked for in steps of an eighth of a round trip, then halved.
fn released_by_modes(modal: &Modal<f64>, round_trip: f64) -> Result<f64, Trouble> {
    let tensile = |time: f64| modal.stress(&time, Side::Right).value > 0.0;
    for step in 8..8 * 64 {
        let (mut from, mut to) = (f64::from(step - 1) * 0.125 * round_trip, f64::from(step) * 0.125 * round_trip);
        // At a lattice time the two limits differ.
        let before = if step % 8 == 0 { modal.stress(&to, Side::Left).value > 0.0 } else { tensile(to) };
        if !before && !tensile(to) {
            continue;
        }
        if !before {
            return Ok(to);
        }
        while to - from > 2.0 * f64::EPSILON * to {
            let middle = 0.5 * (from + to);
            if middle <= from || middle >= to {
                break;
            }
            if tensile(middle) { to = middle } else { from = middle }
        }
        return Ok(to);
    }
    Err(Trouble("no sign change in 64 round trips".into()))
}

/// By what is printed for `r = 0`.
fn by_paper<S: Answers>(problem: &Problem, precision: &S::Precision, of: Of) -> Result<Answer, Trouble> {
    let contact = UndampedContact::new(&Parameters::<S>::of(problem, precision)?);
    let contact = contact.ok_or_else(|| Trouble("damped".into()))?;
    let at = |time: Time| if time == AT_BOUNCE { Ok(contact.bounce_time()) } else { lift::<S>(time, precision) };
    let total = contact.total_energy();
    let value = match of {
        Of::Bounce => contact.bounce_time(),
        Of::Stress(time, side) => contact.stress(&at(time)?, side),
        Of::Centre(time) => contact.centre(&at(time)?).0,
        Of::Momentum(time) => contact.momentum(&at(time)?),
        Of::Energy(_) => total,
        Of::Translational(time) => contact.translational_energy(&at(time)?),
        Of::Vibrational(AT_BOUNCE) => contact.vibrational_energy_at_bounce(),
        Of::Share => total.one() - contact.vibrational_energy_at_bounce() / &total,
        Of::MomentumRestitution => contact.momentum_restitution(),
        Of::Restitution => contact.energy_restitution_squared().ok_or_else(|| Trouble("undefined".into()))?,
        Of::TopTime => contact.highest().ok_or_else(|| Trouble("no top".into()))?.0,
        Of::TopHeight => contact.highest().ok_or_else(|| Trouble("no top".into()))?.1,
        _ => return not_here("for that"),
    };
    Ok(Answer { value: value.value(), bound: 0.0 })
}

/// By what the plan does.
fn planned(problem: &Problem, system: System, of: Of) -> Result<Answer, Trouble> {
    let engine = if problem.rod.damping.is_some() { Engine::Cells } else { Engine::Lattice };
    let from = match (&problem.run, of) {
        // What is asked at the end needs nothing of what lies long behind.
        (Run::Time(time), Of::Centre(_)) => Some(time.to_f64()),
        _ => None,
    };
    let plan = Plan { effects: Vec::new(), engine, system, from, reasons: Vec::new(), cost: String::new() };
    match solve(problem, &plan, |_, _| ())? {
        Solution::Double(history) => answered(of_history(history.as_ref(), of)),
        #[cfg(feature = "mp")]
        Solution::Digits(history, _) => answered(of_history(history.as_ref(), of)),
        #[cfg(feature = "mp")]
        Solution::Exact(history, _) => answered(of_history(history.as_ref(), of)),
    }
}

/// What a history says.
fn of_history<S: Scalar>(history: &dyn History<S>, of: Of) -> Found<S> {
    let end = history.end();
    let precision = history.scales().length.precision();
    let release = history.events().iter().find(|event| event.kind == EventKind::Release);
    if release.is_none() && matches!(of, Of::Bounce) {
        return match history.ending() {
            Ending::NoBounce(_) | Ending::Rest(_) => Ok(None),
            other => Err(Trouble(other.to_string())),
        };
    }
    let released = || release.ok_or_else(|| Trouble(history.ending().to_string()));
    let at = |time: Time| {
        if time == AT_BOUNCE { released().map(|event| event.time.clone()) } else { lift::<S>(time, &precision) }
    };
    let scales = history.scales();
    let (time, velocity) = (scales.time.to_f64(), scales.velocity.to_f64());
    let (length, wave_speed) = (scales.length.to_f64(), scales.wave_speed.to_f64());
    let error = history.error_estimate().to_f64();
    let up_to = |value: S, scale: f64| Estimate { error: error * scale, value };
    let energy_scale = velocity * velocity * length;
    Ok(Some(match of {
        Of::Bounce => released().map(|event| Estimate { value: event.time.clone(), error: event.time_error })?,
        Of::Event(kind, near) => {
            let apart = |time: &S| (time.to_f64() - near).abs();
            let all = history.events().iter().filter(|event| event.kind == kind);
            let nearest = all.min_by(|a, b| apart(&a.time).total_cmp(&apart(&b.time)));
            match nearest {
                Some(event) if apart(&event.time) < 0.25 => {
                    Estimate { value: event.time.clone(), error: event.time_error }
                }
                _ => return Err(Trouble(history.ending().to_string())),
            }
        }
        Of::Stress(at_time, side) => up_to(history.stress(&at(at_time)?, side)?, velocity / wave_speed),
        Of::Displacement(x, at_time) => {
            up_to(history.field(&lift(x, &precision)?, &at(at_time)?, Side::Right)?.displacement, velocity * time)
        }
        Of::Velocity(x, at_time, side) => {
            up_to(history.field(&lift(x, &precision)?, &at(at_time)?, side)?.velocity, velocity)
        }
        Of::Strain(x, at_time, side) => {
            up_to(history.field(&lift(x, &precision)?, &at(at_time)?, side)?.strain, velocity / wave_speed)
        }
        Of::Centre(at_time) => up_to(history.centre(&at(at_time)?)?.0, velocity * time),
        Of::Momentum(at_time) => up_to(history.centre(&at(at_time)?)?.1 * &scales.length, velocity * length),
        Of::Energy(at_time) => up_to(history.energy(&at(at_time)?)?.total, energy_scale),
        Of::Translational(at_time) => up_to(history.energy(&at(at_time)?)?.translational, energy_scale),
        Of::Vibrational(at_time) => up_to(history.energy(&at(at_time)?)?.vibrational, energy_scale),
        Of::MomentumRestitution => {
            let (before, after) = (history.centre(&end.zero())?.1, history.centre(&at(AT_BOUNCE)?)?.1);
            up_to(-(after / &before), 4.0)
        }
        Of::Restitution | Of::Share | Of::Left => {
            let (before, after) = (history.energy(&end.zero())?, history.energy(&at(AT_BOUNCE)?)?);
            let ratio = match of {
                Of::Restitution => after.translational / &before.translational,
                Of::Share => after.translational / &after.total,
                _ => after.total / &before.total,
            };
            up_to(ratio, 4.0)
        }
        Of::Retained | Of::Constant | Of::StressJump(_) | Of::VelocityJump(..) | Of::StrainJump(..) => {
            return not_here("for that");
        }
        Of::TopTime | Of::TopHeight => {
            let top = history.highest(released()?).ok_or_else(|| Trouble("no top".into()))?;
            let scale = velocity * time;
            if matches!(of, Of::TopTime) { up_to(top.0, time) } else { up_to(top.1, scale) }
        }
    }))
}
