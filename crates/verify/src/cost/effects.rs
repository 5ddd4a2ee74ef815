//! What each effect costs: the same scene with it and without it, run in turns.

use std::time::Instant;

use super::clock::{Timing, batch, check_budget, sample};
use crate::route::{run_engine, run_planned};
use crate::value::NoAnswer;
use dalembert::number::Number;
use dalembert::problem::{Parameters, Problem, Run, Speed, Start, Top};
use dalembert::solve::Numbers;
use dalembert::{Effect, Scene};

#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The effect; `None` for the plan itself, which decides what to leave out.
    pub effect: Option<Effect>,
    pub called: bool,
    /// The scene as it is planned.
    pub with: Timing,
    /// The same with the effect switched off, which changes nothing where the scene does not call for it; for the plan
    /// itself, the engine called directly.
    pub without: Timing,
    /// The differences of neighbouring runs.
    pub costs: Timing,
}

impl Difference {
    /// The name in output: `damping`, or `plan`.
    pub fn name(&self) -> &'static str {
        self.effect.map_or("plan", Effect::name)
    }

    /// What the median of the differences may be by chance, seconds: three times `spread/√runs`, near its standard
    /// deviation.
    pub fn noise(&self) -> f64 {
        3.0 * self.costs.spread.unwrap_or(0.0) / (self.costs.runs as f64).sqrt()
    }

    /// Whether the difference cannot be told from nothing.
    pub fn is_noise(&self) -> bool {
        self.costs.seconds.abs() <= self.noise()
    }
}

const MOST_PAIRS: usize = 201;
/// What can be switched off.
const LIST: [Effect; 5] =
    [Effect::Damping, Effect::Gravity, Effect::RepeatedImpacts, Effect::FixedTop, Effect::FieldEnergies];

/// The time that every effect and the plan itself cost `scene`, in about `seconds` in all. The energies of the field
/// count as called for where `energies` says so: then one energy at the end of the history is part of the scene.
pub fn effects(
    scene: &Scene,
    energies: bool,
    seconds: f64,
    mut observe: impl FnMut(f64, &str),
) -> Result<Vec<Difference>, NoAnswer> {
    check_budget(seconds)?;
    let numbers = Numbers::Double(scene.accuracy);
    let called_effects = scene.called_effects();
    let called = |effect: Effect| match effect {
        Effect::FieldEnergies => energies,
        other => called_effects.contains(&other),
    };
    let slot = seconds / (LIST.len() + 1) as f64;
    let with = || run_planned(&scene.problem, numbers, energies);
    let mut rows = Vec::with_capacity(LIST.len() + 1);
    for (k, effect) in LIST.into_iter().enumerate() {
        observe(k as f64 * slot / seconds, effect.name());
        let other = switched_off(scene, effect)?;
        let energies = energies && effect != Effect::FieldEnergies;
        let difference = in_turns(slot, with, || run_planned(&other, numbers, energies))?;
        rows.push(Difference { effect: Some(effect), called: called(effect), ..difference });
    }
    observe(1.0 - slot / seconds, "the plan itself");
    rows.push(in_turns(slot, with, || run_engine(&scene.problem, energies))?);
    Ok(rows)
}

fn switched_off(scene: &Scene, effect: Effect) -> Result<Problem, NoAnswer> {
    let mut problem = scene.problem.clone();
    match effect {
        Effect::Damping => problem.rod.damping = None,
        Effect::Gravity => {
            // The speed that gravity gave stays.
            let speed = Parameters::<f64>::of(&problem, &())?.speed;
            match &mut problem.start {
                start @ Start::Uniform(Speed::DropHeight(_)) => *start = Start::Uniform(Speed::Given(spelt(speed)?)),
                Start::Above { gap, speed } if speed.is_zero() => {
                    let gravity = problem.gravity.as_ref().map_or(0.0, Number::to_f64);
                    *speed = spelt((2.0 * gravity * gap.to_f64()).sqrt())?;
                }
                _ => (),
            }
            problem.gravity = None;
        }
        Effect::RepeatedImpacts => problem.run = Run::Impacts(1),
        Effect::FixedTop => problem.rod.top = Top::Free,
        _ => (),
    }
    Ok(problem)
}

fn spelt(speed: f64) -> Result<Number, NoAnswer> {
    format!("{speed:e}").parse().map_err(|_| NoAnswer::GaveUp(format!("an impact speed of {speed}")))
}

/// Both in turns, so that what slows the machine slows both.
fn in_turns(
    slot: f64,
    with: impl Fn() -> Result<f64, NoAnswer>,
    without: impl Fn() -> Result<f64, NoAnswer>,
) -> Result<Difference, NoAnswer> {
    let start = Instant::now();
    with()?;
    without()?;
    let began = Instant::now();
    with()?;
    let batched = batch(began.elapsed().as_secs_f64());
    let (mut pairs, mut pair): (Vec<[f64; 2]>, f64) = (Vec::new(), 0.0);
    while pairs.len() < 3 || (pairs.len() < MOST_PAIRS && start.elapsed().as_secs_f64() + pair < slot) {
        let began = Instant::now();
        // Who goes first changes, so that going first favours neither.
        pairs.push(if pairs.len() % 2 == 0 {
            [sample(batched, &with), sample(batched, &without)]
        } else {
            let [without, with] = [sample(batched, &without), sample(batched, &with)];
            [with, without]
        });
        pair = began.elapsed().as_secs_f64();
    }
    let of = |part: fn(&[f64; 2]) -> f64| Timing::of(&mut pairs.iter().map(part).collect::<Vec<_>>());
    let (with, without, costs) = (of(|pair| pair[0]), of(|pair| pair[1]), of(|pair| pair[0] - pair[1]));
    Ok(Difference { effect: None, called: true, with, without, costs })
}
