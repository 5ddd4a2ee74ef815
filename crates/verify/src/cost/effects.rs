//! The time that each effect costs: the same scene with it and without it, run in turns.

use std::time::Instant;

use super::timing::{Timing, batch_size, check_budget, sample};
use crate::error::VerifyError;
use crate::routes::{run_engine, run_planned};
use dalembert::number::Number;
use dalembert::problem::{Parameters, Problem, Speed, Start, Top};
use dalembert::solve::Numbers;
use dalembert::{Effect, Scene};

/// The time that an effect costs.
#[derive(Clone, Debug, PartialEq)]
pub struct EffectCost {
    /// The effect; `None` for the plan itself.
    effect: Option<Effect>,
    /// Whether the scene calls for the effect.
    pub called: bool,
    /// The time of the scene as planned.
    pub with: Timing,
    /// The time with the effect switched off, which changes nothing in a scene that does not call for it; for the plan
    /// itself, the time of the engine called directly.
    pub without: Timing,
    /// The differences of neighbouring runs.
    pub costs: Timing,
}

impl EffectCost {
    /// Returns the name in output: `damping`, or `plan`.
    pub fn name(&self) -> &'static str {
        self.effect.map_or("plan", Effect::name)
    }

    /// Returns the noise of the median of the differences, seconds: three times `spread/√runs`, which is near its
    /// standard deviation.
    pub fn noise(&self) -> f64 {
        3.0 * self.costs.spread.unwrap_or(0.0) / (self.costs.runs as f64).sqrt()
    }

    /// Returns whether the cost cannot be told from zero.
    pub fn is_noise(&self) -> bool {
        self.costs.seconds.abs() <= self.noise()
    }
}

const MOST_PAIRS: usize = 201;
/// Effects that can be switched off.
const EFFECTS: [Effect; 5] =
    [Effect::Damping, Effect::Gravity, Effect::RepeatedImpacts, Effect::FixedTop, Effect::FieldEnergies];

/// Measures the time that every effect and the plan itself cost `scene`, in about `seconds` in all.
///
/// With `energies` the scene calls for the energies of the field: one energy at the end of the history is part of each
/// run. `observe` receives the share of the time that is spent, and the name of the next measurement.
pub fn effects(
    scene: &Scene,
    energies: bool,
    seconds: f64,
    mut observe: impl FnMut(f64, &str),
) -> Result<Vec<EffectCost>, VerifyError> {
    check_budget(seconds)?;
    let numbers = Numbers::Double(scene.accuracy);
    let called_effects = scene.called_effects();
    let called = |effect: Effect| match effect {
        Effect::FieldEnergies => energies,
        other => called_effects.contains(&other),
    };
    let slot = seconds / (EFFECTS.len() + 1) as f64;
    let with = || run_planned(&scene.problem, numbers, energies);
    let mut rows = Vec::with_capacity(EFFECTS.len() + 1);
    for (k, effect) in EFFECTS.into_iter().enumerate() {
        observe(k as f64 * slot / seconds, effect.name());
        let other = switched_off(scene, effect)?;
        let energies = energies && effect != Effect::FieldEnergies;
        let cost = in_turns(slot, with, || run_planned(&other, numbers, energies))?;
        rows.push(EffectCost { effect: Some(effect), called: called(effect), ..cost });
    }
    observe(1.0 - slot / seconds, "the plan itself");
    rows.push(in_turns(slot, with, || run_engine(&scene.problem, energies))?);
    Ok(rows)
}

/// Returns the problem of `scene` without `effect`.
fn switched_off(scene: &Scene, effect: Effect) -> Result<Problem, VerifyError> {
    let problem = &scene.problem;
    let builder = problem.to_builder();
    let builder = match effect {
        Effect::Damping => builder.damping(0),
        Effect::Gravity => {
            // The rod keeps the speed that gravity gave it.
            let speed = Parameters::<f64>::of(problem, &())?.speed;
            let builder = builder.gravity(0);
            match problem.start() {
                Start::Uniform(Speed::DropHeight(_)) => builder.impact_speed(speed),
                Start::Above { gap, speed } if speed.is_zero() => {
                    let gravity = problem.gravity().map_or(0.0, Number::to_f64);
                    builder.impact_speed((2.0 * gravity * gap.to_f64()).sqrt())
                }
                _ => builder,
            }
        }
        Effect::RepeatedImpacts => builder.impacts(1),
        Effect::FixedTop => builder.top(Top::Free),
        _ => builder,
    };
    Ok(builder.build()?)
}

/// Measures both runs in turns, so that a slow moment of the machine slows both.
fn in_turns(
    slot: f64,
    with: impl Fn() -> Result<f64, VerifyError>,
    without: impl Fn() -> Result<f64, VerifyError>,
) -> Result<EffectCost, VerifyError> {
    let start = Instant::now();
    with()?;
    without()?;
    let began = Instant::now();
    with()?;
    let batched = batch_size(began.elapsed().as_secs_f64());
    let (mut pairs, mut pair): (Vec<[f64; 2]>, f64) = (Vec::new(), 0.0);
    while pairs.len() < 3 || (pairs.len() < MOST_PAIRS && start.elapsed().as_secs_f64() + pair < slot) {
        let began = Instant::now();
        // The order alternates, so that going first favours neither.
        pairs.push(if pairs.len() % 2 == 0 {
            [sample(batched, &with), sample(batched, &without)]
        } else {
            let [without, with] = [sample(batched, &without), sample(batched, &with)];
            [with, without]
        });
        pair = began.elapsed().as_secs_f64();
    }
    let timing = |part: fn(&[f64; 2]) -> f64| Timing::from_samples(&mut pairs.iter().map(part).collect::<Vec<_>>());
    let (with, without, costs) = (timing(|pair| pair[0]), timing(|pair| pair[1]), timing(|pair| pair[0] - pair[1]));
    Ok(EffectCost { effect: None, called: true, with, without, costs })
}
