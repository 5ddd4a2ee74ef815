//! Every route at every setting, as something that can be run and timed.

use super::march::march;
use super::printed::Printed;
use super::value::{Answer, Value};
use super::{CostError, Quantity, Question};
use crate::damped::Damped;
#[cfg(feature = "mp")]
use crate::first_contact::FirstContact;
use crate::history::{EventKind, Side};
use crate::modal::Modal;
use crate::rod::Parameters;
use crate::scene::{Engine, Plan, System};
use crate::solve::{Solution, solve};

/// A way to an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Route {
    /// [`crate::first_contact::FirstContact`]: the paper's closed forms, summed.
    ClosedForm,
    /// [`crate::lattice`]: undamped, from event to event.
    Lattice,
    /// What the plan of a damped scene does: the closed form of the first contact, then cells.
    Joined,
    /// [`Damped`]: characteristic cells from the start.
    Cells,
    /// [`Modal`]: modes.
    Modes,
    /// [`Printed`]: the paper's integrals by adaptive quadrature.
    Printed,
    /// [`march`](super::march): finite differences at CFL = 1.
    Differences,
    /// Intervals with ends rounded outwards.
    Enclosures,
}

impl Route {
    /// Every route, in the order in which they are shown.
    pub const ALL: [Route; 8] = [
        Route::ClosedForm,
        Route::Lattice,
        Route::Joined,
        Route::Cells,
        Route::Modes,
        Route::Printed,
        Route::Differences,
        Route::Enclosures,
    ];

    /// The name in output: `closed form`.
    pub fn name(self) -> &'static str {
        match self {
            Route::ClosedForm => "closed form",
            Route::Lattice => "lattice",
            Route::Joined => "closed form, then cells",
            Route::Cells => "cells",
            Route::Modes => "modal sum",
            Route::Printed => "printed integrals",
            Route::Differences => "finite differences",
            Route::Enclosures => "enclosures",
        }
    }
}

/// One route at one setting.
pub(super) struct Candidate<'a> {
    pub(super) route: Route,
    pub(super) setting: String,
    /// Decimal digits that the numbers of this setting hold.
    pub(super) digits: u32,
    /// Whether this is what the plan does.
    pub(super) chosen: bool,
    /// How long this is expected to take.
    pub(super) expected: Expected,
    /// Runs it, in about the seconds that are left if it can tell.
    pub(super) run: Box<dyn Fn(f64) -> Result<Value, CostError> + 'a>,
}

/// How long a setting is expected to take.
#[derive(Clone, Copy)]
pub(super) enum Expected {
    /// Seconds.
    Seconds(f64),
    /// Times as long as the setting before it.
    Times(f64),
}
use Expected::{Seconds, Times};

/// Settings of one route, the cheapest first.
pub(super) type Ladder<'a> = Vec<Candidate<'a>>;

/// Digits that a double holds.
const DOUBLE: u32 = 17;
#[cfg(feature = "mp")]
const LONG: [u32; 4] = [50, 100, 300, 1000];
/// A stress that rises through zero is followed for this many round trips.
const MOST_TRIPS: i64 = 64;

/// Every route that can answer, and why the others cannot.
pub(super) fn ladders<'a>(question: &'a Question, plan: &'a Plan) -> (Vec<Ladder<'a>>, Vec<(Route, String)>) {
    let (mut ladders, mut left_out) = (Vec::new(), Vec::new());
    let mut take = |route: Route, ladder: Result<Ladder<'a>, String>| match ladder {
        Ok(ladder) => ladders.push(ladder),
        Err(why) => left_out.push((route, why)),
    };
    let first = question.of_first_contact();
    take(Route::ClosedForm, first.clone().map(|()| closed_form(question)));
    let planned_route = match plan.engine {
        Engine::Lattice => Route::Lattice,
        Engine::Cells => Route::Joined,
    };
    match planned_route {
        Route::Lattice => take(Route::Joined, Err("the scene has no damping: the plan takes the lattice".into())),
        _ => take(Route::Lattice, Err("the scene has damping, which couples the characteristics".into())),
    }
    match plan.system {
        System::Certified(_) => take(planned_route, Err("the plan takes enclosures".into())),
        _ => take(planned_route, Ok(by_plan(planned_route, question, plan))),
    }
    take(Route::Cells, Ok(cells(question)));
    take(Route::Modes, first.clone().and_then(|()| modes(question)));
    take(Route::Printed, first.and_then(|()| printed(question)));
    take(Route::Differences, Ok(differences(question)));
    #[cfg(feature = "mp")]
    take(Route::Enclosures, enclosures(question, plan));
    (ladders, left_out)
}

/// The answer of what the plan does.
pub(super) fn planned(question: &Question, plan: &Plan) -> Result<Value, CostError> {
    match solve(&question.problem, plan, |_, _| ())? {
        Solution::Double(history) => question.ask(history.as_ref()),
        #[cfg(feature = "mp")]
        Solution::Digits(history, _) => question.ask(history.as_ref()),
        #[cfg(feature = "mp")]
        Solution::Exact(history, None) => question.ask(history.as_ref()),
        #[cfg(feature = "mp")]
        Solution::Exact(exact, Some((history, _))) => {
            question.ask(exact.as_ref()).or_else(|_| question.ask(history.as_ref()))
        }
    }
}

/// The answer to that many digits, by the planned engine.
#[cfg(feature = "mp")]
pub(super) fn to_digits(question: &Question, plan: &Plan, digits: u32) -> Result<Value, CostError> {
    planned(question, &Plan { system: System::Digits(digits), ..plan.clone() })
}

/// The answer in fractions: `None` for a damped rod, an error where they end too early.
#[cfg(feature = "mp")]
pub(super) fn fractions(question: &Question, plan: &Plan) -> Option<Result<Value, CostError>> {
    if plan.engine != Engine::Lattice {
        return None;
    }
    let history = match crate::solve::undamped::<rug::Rational>(&question.problem, &()) {
        Ok(history) => history,
        Err(error) => return Some(Err(error.into())),
    };
    Some(question.ask(&history))
}

/// The answer with that many proved digits.
#[cfg(feature = "mp")]
pub(super) fn enclosed(question: &Question, digits: u32) -> Result<Value, CostError> {
    if question.problem.rod.damping.is_some() {
        question
            .of_first_contact()
            .map_err(|why| CostError::GaveUp(format!("{why}: only that is proved under damping")))?;
    }
    fn numbers(value: &Value) -> Vec<&crate::number::Interval> {
        match value {
            Value::Enclosed(interval) => vec![interval],
            _ => Vec::new(),
        }
    }
    crate::solve::certify(&question.problem, digits, |history| question.ask(history), numbers, |_, _| ())
}

/// The closed form in numbers of that many bits.
#[cfg(feature = "mp")]
pub(super) fn closed_in_bits(question: &Question, bits: u32) -> Result<Value, CostError> {
    question.closed::<rug::Float>(&bits, FirstContact::bounce)
}

fn closed_form(question: &Question) -> Ladder<'_> {
    let in_doubles = Candidate {
        route: Route::ClosedForm,
        setting: "double".into(),
        digits: DOUBLE,
        chosen: false,
        expected: Seconds(1e-6),
        run: Box::new(|_| question.closed::<f64>(&(), |contact| contact.bounce_within(1e-13))),
    };
    #[cfg_attr(not(feature = "mp"), expect(unused_mut))]
    let mut ladder = vec![in_doubles];
    #[cfg(feature = "mp")]
    for (digits, expected) in LONG.into_iter().zip([Seconds(0.01), Times(3.0), Times(10.0), Times(20.0)]) {
        let bits = crate::number::bits_for_digits(digits) + 16;
        ladder.push(Candidate {
            route: Route::ClosedForm,
            setting: format!("{digits} digits"),
            digits: digits + 6,
            chosen: false,
            expected,
            run: Box::new(move |_| closed_in_bits(question, bits)),
        });
    }
    ladder
}

fn by_plan<'a>(route: Route, question: &'a Question, plan: &'a Plan) -> Ladder<'a> {
    let candidate =
        |setting: String, digits: u32, expected: Expected, run: Box<dyn Fn(f64) -> Result<Value, CostError> + 'a>| {
            Candidate { route, setting, digits, chosen: false, expected, run }
        };
    let digits = match plan.system {
        System::Digits(digits) | System::Exact(Some(digits)) => digits + 8,
        System::Double(_) | System::Exact(None) | System::Certified(_) => DOUBLE,
    };
    let chosen = candidate(plan.system.to_string(), digits, Seconds(0.0), Box::new(|_| planned(question, plan)));
    #[cfg_attr(not(feature = "mp"), expect(unused_mut))]
    let mut ladder = vec![Candidate { chosen: true, ..chosen }];
    #[cfg(feature = "mp")]
    {
        if let Some(Ok(_)) = fractions(question, plan) {
            let run = |_| fractions(question, plan).unwrap_or(Err(CostError::GaveUp("damped".into())));
            ladder.push(candidate("fractions".into(), DOUBLE, Times(30.0), Box::new(run)));
        }
        // Cells cost about the cube of their digits, of which the plan takes eight more than asked; the lattice hardly more for long numbers.
        let growths = if route == Route::Lattice { [3.0, 1.5, 2.0, 4.0] } else { [30.0, 4.0, 15.0, 30.0] };
        for (digits, growth) in LONG.into_iter().zip(growths.map(Times)) {
            if plan.system == System::Digits(digits) {
                continue;
            }
            let run = move |_| to_digits(question, plan, digits);
            ladder.push(candidate(format!("{digits} digits"), digits + 8, growth, Box::new(run)));
        }
    }
    ladder
}

/// Enclosures, where they reach: an answer that is wrong by more than it says is impossible.
#[cfg(feature = "mp")]
fn enclosures<'a>(question: &'a Question, plan: &Plan) -> Result<Ladder<'a>, String> {
    if question.problem.rod.damping.is_some() {
        question.of_first_contact().map_err(|why| format!("{why}: only that is proved under damping"))?;
    }
    let chosen = match plan.system {
        System::Certified(digits) => Some(digits),
        _ => None,
    };
    let mut settings: Vec<u32> = LONG.into_iter().chain([15]).chain(chosen).collect();
    settings.sort_unstable();
    settings.dedup();
    let candidate = |(k, digits): (usize, u32)| Candidate {
        route: Route::Enclosures,
        setting: format!("{digits} digits"),
        digits: digits + 9,
        chosen: chosen == Some(digits),
        expected: if k == 0 { Seconds(1e-3) } else { Times(4.0) },
        run: Box::new(move |_| enclosed(question, digits)),
    };
    Ok(settings.into_iter().enumerate().map(candidate).collect())
}

/// Cells from the start, whatever the scene: their error falls geometrically with the nodes.
fn cells(question: &Question) -> Ladder<'_> {
    let candidate = |(k, digits): (usize, u32)| Candidate {
        route: Route::Cells,
        setting: format!("to 1e-{digits}"),
        digits: DOUBLE,
        chosen: false,
        expected: if k == 0 { Seconds(1e-4) } else { Times(1.5) },
        run: Box::new(move |_| question.ask(&Damped::<f64>::solve(&question.problem, &(), f64::from(digits))?)),
    };
    [1, 3, 5, 7, 9, 11, 13].into_iter().enumerate().map(candidate).collect()
}

fn modes(question: &Question) -> Result<Ladder<'_>, String> {
    if question.quantity == Quantity::Vibrational {
        return Err("its energy is the whole one; E_z would be the difference of two".into());
    }
    let rod = Parameters::<f64>::of(&question.problem, &()).map_err(|error| error.to_string())?;
    let candidate = |k: u32| {
        let (rod, count) = (rod.clone(), 4 << (2 * k));
        Candidate {
            route: Route::Modes,
            setting: format!("N = {count}"),
            digits: DOUBLE,
            chosen: false,
            expected: if k == 0 { Seconds(1e-4) } else { Times(4.0) },
            run: Box::new(move |_| by_modes(question, &rod, &Modal::new(&rod, count))),
        }
    };
    Ok((0..8).map(candidate).collect())
}

fn by_modes(question: &Question, rod: &Parameters<f64>, modal: &Modal<f64>) -> Result<Value, CostError> {
    let time = question.time.as_ref().map_or(0.0, crate::Number::to_f64);
    let released = || first_release(rod.round_trip(), &|t, side| modal.stress(&t, side).value);
    let value = match question.quantity {
        Quantity::Stress => modal.stress(&time, Side::Right).value,
        Quantity::Centre => modal.centre(&time).0.value,
        Quantity::Energy | Quantity::Vibrational => modal.energy(&time).value,
        Quantity::BounceTime | Quantity::LastEvent => released()?,
        Quantity::Restitution => {
            let (height, velocity) = modal.centre(&released()?);
            restitution(rod, height.value, velocity.value)
        }
    };
    Ok(value.answer())
}

fn restitution(rod: &Parameters<f64>, height: f64, velocity: f64) -> f64 {
    (velocity * velocity + 2.0 * rod.gravity * height) / (rod.speed * rod.speed)
}

fn printed(question: &Question) -> Result<Ladder<'_>, String> {
    if question.quantity == Quantity::Vibrational {
        return Err("printed is the whole energy; E_z would be the difference of two".into());
    }
    let rod = Parameters::<f64>::of(&question.problem, &()).map_err(|error| error.to_string())?;
    if rod.damping == 0.0 {
        return Err("without damping the paper itself has done its integrals".into());
    }
    let candidate = |(k, digits): (usize, i32)| {
        let rod = rod.clone();
        Candidate {
            route: Route::Printed,
            setting: format!("tolerance 1e-{digits}"),
            digits: DOUBLE,
            chosen: false,
            expected: if k == 0 { Seconds(1e-2) } else { Times(3.0) },
            run: Box::new(move |left| {
                by_integrals(question, &rod, Printed::new(&rod, 10f64.powi(-digits)).within(left))
            }),
        }
    };
    Ok([1, 2, 4, 6, 8, 10, 12, 14].into_iter().enumerate().map(candidate).collect())
}

fn by_integrals(question: &Question, rod: &Parameters<f64>, paper: Printed) -> Result<Value, CostError> {
    let time = question.time.as_ref().map_or(0.0, crate::Number::to_f64);
    // The limit from earlier times at a lattice time is that without the ray that arrives there.
    let before = |t: f64, side: Side| if side == Side::Left { t * (1.0 - 4.0 * f64::EPSILON) } else { t };
    let released = || first_release(rod.round_trip(), &|t, side| paper.stress(before(t, side)));
    let value = match question.quantity {
        Quantity::Stress => paper.stress(time),
        Quantity::Centre => paper.centre(time),
        Quantity::Energy | Quantity::Vibrational => paper.energy(time),
        Quantity::BounceTime | Quantity::LastEvent => released()?,
        Quantity::Restitution => {
            let time = released()?;
            restitution(rod, paper.centre(time), paper.momentum(time) / rod.length)
        }
    };
    paper.finished()?;
    Ok(value.answer())
}

/// The first time at which a stress is tensile: just after a lattice time, or where it rises through zero between two, if one of eight
/// looks shows that. A search without a proof, for routes that have no other.
fn first_release(round_trip: f64, stress: &dyn Fn(f64, Side) -> f64) -> Result<f64, CostError> {
    for k in 1..=MOST_TRIPS {
        let start = k as f64 * round_trip;
        let mut low = (start, stress(start, Side::Right));
        if low.1 >= 0.0 {
            return Ok(start);
        }
        for look in 1..=8 {
            let last = look == 8;
            let time = if last { (k + 1) as f64 * round_trip } else { start + round_trip * f64::from(look) / 8.0 };
            let high = (time, stress(time, if last { Side::Left } else { Side::Right }));
            if high.1 >= 0.0 {
                return Ok(root(low, high, |t| stress(t, Side::Right)));
            }
            low = high;
        }
    }
    Err(CostError::GaveUp(format!("no tensile stress in {MOST_TRIPS} round trips")))
}

/// The Illinois rule: regula falsi that halves an end that stays.
fn root(mut low: (f64, f64), mut high: (f64, f64), f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..60 {
        let time = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
        if !(time > low.0 && time < high.0) || high.0 - low.0 <= 2.0 * f64::EPSILON * high.0 {
            break;
        }
        let value = f(time);
        if value == 0.0 {
            return time;
        }
        if value < 0.0 {
            low = (time, value);
            high.1 *= 0.5;
        } else {
            high = (time, value);
            low.1 *= 0.5;
        }
    }
    if high.1.abs() < low.1.abs() { high.0 } else { low.0 }
}

fn differences(question: &Question) -> Ladder<'_> {
    let candidate = |k: u32| {
        let count = 8usize << (2 * k);
        Candidate {
            route: Route::Differences,
            setting: format!("{count} cells"),
            digits: DOUBLE,
            chosen: false,
            expected: if k == 0 { Seconds(1e-4) } else { Times(16.0) },
            run: Box::new(move |_| by_differences(question, count)),
        }
    };
    (0..7).map(candidate).collect()
}

fn by_differences(question: &Question, cells: usize) -> Result<Value, CostError> {
    let problem = &question.problem;
    let marched = march(problem, cells)?;
    let gave_up = |what: &str| CostError::GaveUp(format!("no {what} found with {cells} cells"));
    let release = marched.events.iter().find(|event| event.0 == EventKind::Release);
    let value = match question.quantity {
        Quantity::Stress => marched.stress,
        Quantity::Centre => marched.centre,
        Quantity::Energy => marched.energy[0],
        Quantity::Vibrational => marched.energy[0] - marched.energy[1],
        Quantity::BounceTime => release.ok_or_else(|| gave_up("release"))?.1,
        Quantity::LastEvent => marched.events.last().ok_or_else(|| gave_up("event"))?.1,
        Quantity::Restitution => {
            let [height, velocity] = marched.first_release.ok_or_else(|| gave_up("release"))?;
            restitution(&Parameters::of(problem, &())?, height, velocity)
        }
    };
    Ok(value.answer())
}
