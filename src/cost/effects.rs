//! What each effect costs: the same scene with it and without it, run in turns.

use std::time::Instant;

use super::CostError;
use super::clock::{Timing, batch, quantile, sample};
use crate::damped::{Damped, Joined};
use crate::first_contact::FirstContact;
use crate::history::History;
use crate::rod::{Parameters, Problem, Run, Speed, Start, Top};
use crate::scene::{Ask, Effect, Engine, Plan, Scene};
use crate::solve::{Solution, solve};

/// What one effect costs.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The effect; `None` for the plan itself, which decides what to leave out.
    pub effect: Option<Effect>,
    /// Whether the scene calls for it.
    pub called: bool,
    /// The scene as it is planned.
    pub with: Timing,
    /// The same with the effect switched off, which changes nothing where the scene does not call for it; for the plan itself, the
    /// engine called directly.
    pub without: Timing,
    /// The median of the differences of neighbouring runs, seconds.
    pub seconds: f64,
    /// The distance of the quartiles of these differences, seconds.
    pub spread: f64,
}

impl Difference {
    /// The name in output: `damping`, or `plan`.
    pub fn name(&self) -> &'static str {
        self.effect.map_or("plan", Effect::name)
    }

    /// What the median of the differences may be by chance, seconds: three times `spread/√runs`, near its standard deviation.
    pub fn noise(&self) -> f64 {
        3.0 * self.spread / (self.with.runs.max(1) as f64).sqrt()
    }

    /// Whether the difference cannot be told from nothing.
    pub fn is_noise(&self) -> bool {
        self.seconds.abs() <= self.noise()
    }
}

const MOST_PAIRS: usize = 201;
/// What can be switched off.
const LIST: [Effect; 5] =
    [Effect::Damping, Effect::Gravity, Effect::RepeatedImpacts, Effect::FixedTop, Effect::FieldEnergies];

/// The time that every effect and the plan itself cost `scene`, in about `seconds` in all. The energies of the field count as called for where `energies`
/// says so: then one energy at the end of the history is part of the scene.
///
/// **Accuracy**: medians of differences on this machine, now; [`Difference::is_noise`] says what is not to be told from nothing.
///
/// **Errors**: [`CostError::Seconds`], and those of the solver.
pub fn effects(
    scene: &Scene,
    energies: bool,
    seconds: f64,
    mut observe: impl FnMut(f64, &str),
) -> Result<Vec<Difference>, CostError> {
    if !(seconds > 0.0 && seconds <= 86_400.0) {
        return Err(CostError::Seconds { found: seconds });
    }
    let plan = Plan::of(scene, Ask::default())?;
    let called = |effect: Effect| match effect {
        Effect::FieldEnergies => energies,
        other => plan.effects.iter().any(|used| used.effect == other && used.called),
    };
    let slot = seconds / (LIST.len() + 1) as f64;
    let with = || planned(&scene.problem, &plan, energies);
    let mut rows = Vec::with_capacity(LIST.len() + 1);
    for (k, effect) in LIST.into_iter().enumerate() {
        observe(k as f64 * slot / seconds, effect.name());
        let mut other = scene.clone();
        other.problem = switched_off(scene, effect)?;
        let other_plan = Plan::of(&other, Ask::default())?;
        let energies = energies && effect != Effect::FieldEnergies;
        let difference = in_turns(slot, with, || planned(&other.problem, &other_plan, energies))?;
        rows.push(Difference { effect: Some(effect), called: called(effect), ..difference });
    }
    observe(1.0 - slot / seconds, "the plan itself");
    rows.push(in_turns(slot, with, || direct(&scene.problem, plan.engine, energies))?);
    Ok(rows)
}

/// The scene's problem without one effect.
fn switched_off(scene: &Scene, effect: Effect) -> Result<Problem, CostError> {
    let mut problem = scene.problem.clone();
    match effect {
        Effect::Damping => problem.rod.damping = None,
        Effect::Gravity => {
            // The speed that a drop gave stays.
            if let Start::Uniform(Speed::DropHeight(_)) = problem.start {
                let speed = format!("{:e}", Parameters::<f64>::of(&problem, &())?.speed);
                let number = speed.parse().map_err(|_| CostError::GaveUp(format!("an impact speed of {speed}")))?;
                problem.start = Start::Uniform(Speed::Given(number));
            }
            problem.gravity = None;
        }
        Effect::RepeatedImpacts => problem.run = Run::Impacts(1),
        Effect::FixedTop => problem.rod.top = Top::Free,
        _ => (),
    }
    Ok(problem)
}

/// Runs the plan, and asks for an energy at the end if told so.
fn planned(problem: &Problem, plan: &Plan, energies: bool) -> Result<f64, CostError> {
    match solve(problem, plan, |_, _| ())? {
        Solution::Double(history) => finish(history.as_ref(), energies),
        #[cfg(feature = "mp")]
        _ => Ok(0.0),
    }
}

/// The engine past the plan, as the plan would call it.
fn direct(problem: &Problem, engine: Engine, energies: bool) -> Result<f64, CostError> {
    // Boxed as a plan's history is: the allocation is none of an effect's.
    let history: Box<dyn History<f64>> = match engine {
        Engine::Lattice => Box::new(crate::solve::undamped::<f64>(problem, &())?),
        Engine::Cells if problem.has_closed_form() => {
            let bounce = FirstContact::new(&Parameters::<f64>::of(problem, &())?).bounce_within(1e-13);
            Box::new(Joined::<f64>::solve(problem, &(), 13.0, bounce, true)?)
        }
        Engine::Cells => Box::new(Damped::<f64>::solve(problem, &(), 13.0)?),
    };
    finish(history.as_ref(), energies)
}

fn finish(history: &dyn History<f64>, energies: bool) -> Result<f64, CostError> {
    if energies { Ok(history.energy(&history.end())?.total) } else { Ok(history.end()) }
}

/// Both in turns, so that what slows the machine slows both.
fn in_turns(
    slot: f64,
    with: impl Fn() -> Result<f64, CostError>,
    without: impl Fn() -> Result<f64, CostError>,
) -> Result<Difference, CostError> {
    let start = Instant::now();
    with()?;
    without()?;
    let began = Instant::now();
    with()?;
    let batched = batch(began.elapsed().as_secs_f64());
    let (mut a, mut b, mut differences) = (Vec::new(), Vec::new(), Vec::new());
    let mut pair = 0.0;
    while a.len() < 3 || (a.len() < MOST_PAIRS && start.elapsed().as_secs_f64() + pair < slot) {
        let began = Instant::now();
        // Who goes first changes, so that going first favours neither.
        let (x, y) = if a.len() % 2 == 0 {
            let x = sample(batched, &with);
            (x, sample(batched, &without))
        } else {
            let y = sample(batched, &without);
            (sample(batched, &with), y)
        };
        a.push(x);
        b.push(y);
        differences.push(x - y);
        pair = began.elapsed().as_secs_f64();
    }
    differences.sort_by(f64::total_cmp);
    let spread = quantile(&differences, 0.75) - quantile(&differences, 0.25);
    let (with, without) = (Timing::of(&mut a), Timing::of(&mut b));
    Ok(Difference { effect: None, called: true, with, without, seconds: quantile(&differences, 0.5), spread })
}
