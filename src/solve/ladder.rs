//! The precision ladder: an answer is computed in doubles, in longer numbers or in enclosures until its own bound
//! settles it.

use std::fmt;
use std::ops::ControlFlow;
use std::sync::Arc;

use super::plan::{Lacks, Plan, Rung};
use crate::error::Error;
use crate::motion::{Ending, Motion, Scales};
use crate::number::{Answer, Scalar};
use crate::problem::Problem;
use crate::reason::Warning;

/// Receives from time to time how far a run is, in round trips, or in contacts where so many are asked for, and how
/// many pieces it has; may end the run with [`Error::Interrupted`].
pub type Observer = Arc<dyn Fn(usize, usize) -> ControlFlow<()> + Send + Sync>;

/// An observer that does nothing.
pub(crate) fn unobserved() -> Observer {
    Arc::new(crate::lattice::unobserved)
}

/// An engine that has run.
pub(crate) type Engined<S> = Arc<dyn Motion<<S as Answer>::Carried>>;

/// A number system of answers, and how an attempt in the numbers of a rung is read in it.
pub trait Target: Answer {
    /// Runs the planned engine in the numbers of `rung`.
    ///
    /// **Errors**: those of the engine; [`Error::NotDecided`] where these numbers do not settle a comparison.
    fn run(problem: &Problem, plan: &Plan, rung: Rung, observe: &Observer) -> Result<Engined<Self>, Error>;
}

/// A problem, its plan and how far up the ladder the attempts are.
#[derive(Clone)]
pub(crate) struct Ladder {
    pub(crate) problem: Problem,
    pub(crate) plan: Plan,
    pub(crate) observe: Observer,
}

impl fmt::Debug for Ladder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Ladder").field("problem", &self.problem).field("plan", &self.plan).finish_non_exhaustive()
    }
}

/// An attempt: its numbers, and the engine that has run in them.
pub(crate) struct Attempt<S: Answer> {
    pub(crate) rung: Rung,
    pub(crate) engine: Engined<S>,
    /// Whether exact numbers have been tried where events coincide within their bounds, and did not decide either.
    tried: bool,
}

impl<S: Answer> Clone for Attempt<S> {
    fn clone(&self) -> Self {
        Attempt { rung: self.rung, engine: self.engine.clone(), tried: self.tried }
    }
}

/// As often an attempt may end at the same doubt, with more bits each time, before that is the answer.
const SAME_DOUBT: usize = 3;
/// No double is known better than this.
const MOST_DOUBLE_DIGITS: f64 = 15.0;

impl Ladder {
    /// The answer to `query`, settled: asked of `attempt` where there is one, and of attempts in more and more bits
    /// until every comparison on the way is decided and all `numbers` of the answer have the digits of the plan.
    ///
    /// **Accuracy**: each number is known to the digits of the plan, or to so many below the greatest number of the
    /// answer as the plan says. In doubles the best that could be reached; its own bounds say what that is.
    ///
    /// **Errors**: [`Error::Unsettled`] and [`Error::Undecided`] where too many bits do not settle it; those of the run
    /// and of the query.
    pub(crate) fn settle<S: Target, T>(
        &self,
        attempt: Option<Attempt<S>>,
        query: impl Fn(&dyn Motion<S::Carried>) -> Result<T, Error>,
        numbers: impl Fn(&T) -> Vec<&S::Carried>,
    ) -> Result<(Attempt<S>, T), Error> {
        let mut rung = attempt.as_ref().map_or(self.plan.rung, |attempt| attempt.rung);
        let tried = attempt.as_ref().is_some_and(|attempt| attempt.tried);
        let mut reserve = None;
        let mut known = attempt.map(|attempt| attempt.engine);
        let mut doubts: Vec<f64> = Vec::new();
        loop {
            let answer = match known.take() {
                Some(engine) => Ok(engine),
                None => S::run(&self.problem, &self.plan, rung, &self.observe),
            }
            .and_then(|engine| query(&*engine).map(|answer| (engine, answer)));
            // Errors on the way to an open comparison mean nothing, except where no bits can help.
            let (lacks, reached) = match answer {
                Ok((engine, answer)) => {
                    let missing = self.missing::<S>(&*engine, &numbers(&answer), &mut doubts);
                    let coincides = !tried && coincides(&self.plan, &*engine);
                    let reached = Some((Attempt { rung, engine, tried }, answer));
                    match reached {
                        Some(settled) if missing <= 0.0 && !coincides => return Ok(settled),
                        _ if missing <= 0.0 => {
                            reserve = reached;
                            (Lacks::Exactness, None)
                        }
                        _ => (Lacks::Bits(missing), reached),
                    }
                }
                Err(Error::NotDecided { .. } | Error::Open(_)) => (Lacks::Bits(f64::INFINITY), None),
                Err(error) => return Err(error),
            };
            // Where exact roots do not decide, the numbers that are known say what they take for one.
            let open = matches!((rung, lacks), (Rung::Confirmed(_) | Rung::Enclosures(_), Lacks::Bits(f64::INFINITY)));
            let next = self.plan.next(rung, lacks).filter(|_| reserve.is_none() || !open);
            match (next, reserve.take_if(|_| next.is_none()), reached) {
                (Some(next), ..) => rung = next,
                (None, Some((attempt, answer)), _) => return Ok((Attempt { tried: true, ..attempt }, answer)),
                (None, None, Some(reached)) if matches!(rung, Rung::Double) => return Ok(reached),
                (None, None, _) => return Err(self.unsettled(rung)),
            }
        }
    }

    fn unsettled(&self, rung: Rung) -> Error {
        let digits = self.plan.goal().0 as u32;
        match rung {
            Rung::Confirmed(bits) | Rung::Enclosures(bits) => Error::Undecided { digits, bits },
            Rung::Bits(bits) => Error::Unsettled { digits, bits },
            Rung::Double | Rung::Fractions => Error::NoMultiprecision,
        }
    }

    /// About how many bits more would settle the answer; zero or less where it is settled.
    fn missing<S: Target>(
        &self,
        engine: &dyn Motion<S::Carried>,
        numbers: &[&S::Carried],
        doubts: &mut Vec<f64>,
    ) -> f64 {
        if self.plan.engine == super::Engine::Lattice && matches!(engine.ending(), Ending::Undecided(_)) {
            let end = engine.end().to_f64();
            doubts.push(end);
            if doubts.iter().filter(|doubt| (*doubt - end).abs() <= 1e-9 * end).count() < SAME_DOUBT {
                return f64::INFINITY;
            }
        }
        let (digits, spare) = self.plan.goal();
        let double = matches!(self.plan.numbers, super::Numbers::Double(_));
        let digits = if double { digits.min(MOST_DOUBLE_DIGITS) } else { digits };
        let log2 = |x: &S::Carried| x.to_f64().abs().log2();
        let greatest = numbers.iter().map(|x| log2(x)).fold(f64::NEG_INFINITY, f64::max);
        let bits = |digits: f64| digits * std::f64::consts::LOG2_10;
        let floor = greatest - bits(digits + spare);
        // What is not told from zero has no digits that bits could settle: its natural scale says when it is small.
        let faint = least_scale(engine) - bits(if double { digits } else { digits + FAINT_DIGITS });
        let missing = numbers.iter().map(|x| {
            let (size, error) = (log2(x), x.log2_error());
            // Nothing is known of it, whatever its size.
            if error.is_nan() || error == f64::INFINITY {
                return f64::INFINITY;
            }
            error - (size - bits(digits)).max(floor).max(if size <= error { faint } else { f64::NEG_INFINITY })
        });
        missing.fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Whether events are taken for one that are so only within their bounds, where exact numbers are to decide.
fn coincides<S: Scalar>(plan: &Plan, engine: &dyn Motion<S>) -> bool {
    let contacts = engine.digits_lost().map_or(0, |(contacts, _)| contacts);
    plan.tries_exact(contacts) && engine.warnings().iter().any(|warning| matches!(warning, Warning::Coincidence { .. }))
}

/// Digits below those asked for, and below its natural scale, from which on a number that is not told from zero is
/// settled.
const FAINT_DIGITS: f64 = 30.0;

/// `log₂` of the least of the natural scales of displacement, velocity, strain and energy.
fn least_scale<S: Scalar>(engine: &dyn Motion<S>) -> f64 {
    let Scales { time, velocity, length, wave_speed, .. } = engine.scales().map(|scale| scale.to_f64().log2());
    velocity + time.min(0.0).min(-wave_speed).min(velocity + length)
}
