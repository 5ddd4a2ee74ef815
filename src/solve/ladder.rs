//! The precision ladder: doubles, longer numbers or enclosures, until the bound of the answer is small enough.

use std::borrow::Cow;
use std::sync::Arc;

use super::derivative::{Asked, Computed};
use super::plan::{Engine, Goal, Plan};
use super::question::{Numbers, Observer, UNOBSERVED};
use super::rung::{LONG, Lacks, Rung};
use crate::cells::Task;
use crate::error::Error;
use crate::lattice::Undamped;
use crate::motion::{Ending, Motion, Scales};
use crate::number::{Answer, Bounded, IntoValue, Scalar};
use crate::problem::Problem;
use crate::reason::{Reason, Warning};

impl Plan {
    /// Returns the answer to one `query` of `problem`, in numbers that carry their bound. Nothing else is computed: no
    /// list of events is settled before it. `numbers` returns the numbers of the answer that must have the digits of
    /// the plan.
    ///
    /// **Accuracy**: that of [`Plan::numbers`].
    ///
    /// **Errors**: the errors of the run and of the query; [`Error::Unsettled`], [`Error::Undecided`] if no affordable
    /// number of bits settles the answer.
    ///
    /// ```
    /// use dalembert::engine::Motion;
    /// use dalembert::{Numbers, Plan, Problem, Question};
    /// let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(4).build()?;
    /// let plan = Plan::of(&rod, &Question::bounce(Numbers::default()))?;
    /// // Corollary 1: 2L μ = 8, and that of gravity, g L t₁ = 2, per ρS.
    /// let impulse = plan.ask::<f64, _>(&rod, |motion| Ok(motion.impulse(0)), |found| found.iter().collect())?;
    /// assert!((impulse.map_or(0.0, |impulse| *impulse.value()) - 10.0).abs() < 1e-13);
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn ask<S: Target, T>(
        &self,
        problem: &Problem,
        query: impl Fn(&dyn Motion<S::Carried>) -> Result<T, Error>,
        numbers: impl Fn(&T) -> Vec<&S::Carried>,
    ) -> Result<T, Error> {
        let ladder = Ladder { problem, plan: self, observe: &UNOBSERVED };
        ladder.ask::<S, T>(Vec::new(), query, numbers).map(|(_, answer)| answer)
    }
}

/// An engine that has run.
pub(crate) type Engined<S> = Arc<dyn Motion<<S as Answer>::Carried>>;

/// A number system of answers, with the conversion of a run in the numbers of a rung.
pub trait Target: Answer<Carried: IntoValue> {
    /// Runs the planned engine in the numbers of `rung`.
    ///
    /// **Errors**: the errors of the engine; [`Error::NotDecided`] if these numbers do not decide a comparison.
    fn run(problem: &Problem, plan: &Plan, rung: Rung, observe: &Observer) -> Result<Engined<Self>, Error>;

    /// Computes the requested derivatives of a history with the engine `run`, by the method of this number system.
    ///
    /// **Errors**: the errors of runs with other values; [`Error::Derivative`].
    fn derivatives(asked: &Asked<'_>, run: &Engined<Self>) -> Result<Computed<Self::Carried>, Error>;
}

/// A problem and its plan, for a sequence of attempts.
#[derive(Clone, Copy)]
pub(crate) struct Ladder<'a> {
    pub(crate) problem: &'a Problem,
    pub(crate) plan: &'a Plan,
    pub(crate) observe: &'a Observer,
}

/// An attempt: its rung, and the engine that has run in those numbers.
#[derive(Clone)]
pub(crate) struct Attempt<S: Answer> {
    pub(crate) rung: Rung,
    pub(crate) engine: Engined<S>,
    /// Whether exact numbers were tried on events that coincide within their bounds, and did not decide either.
    tried: bool,
    /// Whether longer numbers break off before the end of this run.
    farthest: bool,
}

/// Magnitude and error of a number of an answer, which determine whether it is settled.
struct Size {
    /// Magnitude as `log₂`.
    log2: f64,
    log2_error: f64,
    /// Whether it is indistinguishable from zero.
    may_vanish: bool,
}

fn sizes<S: Scalar>(numbers: Vec<&S>) -> Vec<Size> {
    let size = |x: &S| Size {
        log2: x.to_f64().abs().log2(),
        log2_error: x.log2_error(),
        may_vanish: x.vanishes() != Ok(false),
    };
    numbers.into_iter().map(size).collect()
}

/// The query that the ladder puts to each attempt. It returns the index of the answer, counted from 0, and the sizes of
/// its numbers, so that the ladder is compiled once for all kinds of answers.
type Query<'a, S> = &'a mut dyn FnMut(&dyn Motion<<S as Answer>::Carried>) -> Result<(usize, Vec<Size>), Error>;

/// Number of attempts, each with more bits, that may leave the same doubt before the doubt becomes the answer.
const SAME_DOUBT: usize = 3;

impl<'a> Ladder<'a> {
    /// Computes the history of an undamped rod.
    pub(super) fn lattice<N: Bounded>(self, precision: &N::Precision) -> Result<Undamped<N>, Error> {
        let Ladder { problem, plan, observe } = self;
        Undamped::solve_within(&plan.reaching(problem), precision, plan.lattice_limits(problem), &**observe)
    }

    /// Returns the task of a damped march in the numbers of `rung`.
    pub(super) fn task<S: Scalar>(self, precision: &'a S::Precision, rung: Rung) -> Task<'a, S> {
        let Ladder { problem, plan, observe } = self;
        Task { problem, precision, effort: plan.effort(rung), observe: &**observe }
    }

    /// Returns the answer to `query`, settled by [`Ladder::settle`], and its attempt.
    pub(crate) fn ask<S: Target, T>(
        &self,
        known: Vec<Attempt<S>>,
        query: impl Fn(&dyn Motion<S::Carried>) -> Result<T, Error>,
        numbers: impl Fn(&T) -> Vec<&S::Carried>,
    ) -> Result<(Attempt<S>, T), Error> {
        let mut answers = Vec::with_capacity(1);
        let (attempt, chosen) = self.settle(known, &mut |engine| {
            answers.push(query(engine)?);
            let last = answers.len() - 1;
            Ok((last, sizes(numbers(&answers[last]))))
        })?;
        Ok((attempt, answers.swap_remove(chosen)))
    }

    /// Settles the answer to `query`. The `known` attempts answer first, then attempts with more and more bits, until
    /// every comparison is decided and all numbers of the answer have the digits of the plan.
    ///
    /// **Accuracy**: each number has the digits of the plan, or an error that many digits, plus the spare ones of the
    /// plan, below the greatest number of the answer. In doubles it is the best reachable accuracy, as its own bounds
    /// state.
    fn settle<S: Target>(&self, known: Vec<Attempt<S>>, query: Query<'_, S>) -> Result<(Attempt<S>, usize), Error> {
        let tried = known.iter().any(|attempt| attempt.tried);
        let farthest = known.iter().find(|attempt| attempt.farthest).map(|attempt| attempt.rung);
        let mut known = known.into_iter().map(|attempt| (attempt.rung, Some(attempt.engine)));
        let (mut rung, mut engine) = known.next().unwrap_or((self.plan.rung, None));
        let mut plan = Cow::Borrowed(self.plan);
        let mut reserve = None;
        let mut kept: Option<(Attempt<S>, usize, bool)> = None;
        let mut doubts: Vec<f64> = Vec::new();
        let mut before = f64::INFINITY;
        loop {
            let answer = match engine.take() {
                Some(engine) => Ok(engine),
                None => S::run(self.problem, &plan, rung, self.observe),
            }
            .and_then(|engine| {
                let (answer, sizes) = query(&*engine)?;
                // An answer that covers both sides of an event reports this; its accuracy is judged without the cover.
                let sizes = match engine.covered() {
                    Some((_, plain)) => query(plain).map_or(Vec::new(), |(_, sizes)| sizes),
                    None => sizes,
                };
                Ok((engine, (answer, sizes)))
            });
            // Errors on the way to an open comparison are meaningless, unless no bits can help.
            let lacks = match answer {
                Ok((engine, (answer, sizes))) => {
                    // Such a run breaks off earlier with more bits.
                    let last = breaks_off(self.plan, rung, &*engine);
                    let longer = |(kept, _, settled): &mut (Attempt<S>, usize, bool)| {
                        (*settled || last) && ends_before(&*engine, &*kept.engine)
                    };
                    if let Some((kept, answer, _)) = kept.take_if(longer) {
                        return Ok((Attempt { tried: true, farthest: last, ..kept }, answer));
                    }
                    let last = last || farthest == Some(rung);
                    let missing = self.missing(&*engine, &sizes, &mut doubts);
                    // A time in doubles has a rounding that no bits of the run reduce.
                    let finite = missing.is_finite();
                    let stuck = matches!(self.plan.numbers, Numbers::Double(_)) && finite && missing > before - 1.0;
                    if rung != Rung::Double && finite {
                        before = missing;
                    }
                    let coincides = !tried && coincides(self.plan, &*engine);
                    let open = !tried && self.plan.engine != Engine::Lattice && needs_bits(&*engine);
                    if open {
                        doubts.push(engine.end().to_f64());
                    }
                    let climbs = open && doubts.len() < SAME_DOUBT;
                    let tried = tried || open && !climbs;
                    let (attempt, settled) = (Attempt { rung, engine, tried, farthest: last }, missing <= 0.0);
                    if last || (settled || stuck) && !coincides && !climbs {
                        return Ok((attempt, answer));
                    }
                    if settled && !climbs {
                        reserve = Some((attempt, answer));
                        Lacks::Exactness
                    } else {
                        if climbs || rung == Rung::Double {
                            kept = Some((attempt, answer, settled));
                        }
                        Lacks::Bits(if climbs { f64::INFINITY } else { missing })
                    }
                }
                Err(Error::NotDecided { .. } | Error::Open(_)) => Lacks::Bits(f64::INFINITY),
                // Longer numbers have reached their limit of effort before the time that doubles answer.
                Err(error @ Error::TimeOutside { .. }) if LONG => {
                    let kept = kept.map(|(kept, answer, _)| (Attempt { tried: true, ..kept }, answer));
                    return kept.ok_or(error);
                }
                Err(error) => return Err(error),
            };
            // If exact roots do not decide, the known numbers report what they take as equal.
            let open = matches!((rung, lacks), (Rung::Confirmed(_) | Rung::Enclosures(_), Lacks::Bits(f64::INFINITY)));
            let next = self.plan.next(rung, lacks).filter(|_| reserve.is_none() || !open);
            if let Some(next) = next {
                if let (Rung::Double, Lacks::Bits(missing)) = (rung, lacks)
                    && missing.is_finite()
                {
                    plan = Cow::Owned(self.plan.lacking(missing));
                }
                (rung, engine) = known.next().unwrap_or((next, None));
                continue;
            }
            let kept = kept.filter(|(kept, _, settled)| *settled || kept.rung == Rung::Double);
            let best = reserve.or(kept.map(|(kept, answer, _)| (kept, answer)));
            let best = best.map(|(attempt, answer)| (Attempt { tried: true, ..attempt }, answer));
            return best.ok_or_else(|| self.unsettled(rung));
        }
    }

    fn unsettled(&self, rung: Rung) -> Error {
        let digits = self.plan.goal.digits as u32;
        match rung {
            Rung::Confirmed(bits) | Rung::Enclosures(bits) => Error::Undecided { digits, bits },
            rung => Error::Unsettled { digits, bits: rung.bits() },
        }
    }

    /// Estimates the additional bits that would settle the answer; zero or less if it is settled.
    fn missing<S: Scalar>(&self, engine: &dyn Motion<S>, numbers: &[Size], doubts: &mut Vec<f64>) -> f64 {
        if self.plan.engine == Engine::Lattice && matches!(engine.ending(), Ending::Undecided(_)) {
            let end = engine.end().to_f64();
            doubts.push(end);
            if doubts.iter().filter(|doubt| (*doubt - end).abs() <= 1e-9 * end).count() < SAME_DOUBT {
                return f64::INFINITY;
            }
        }
        let Goal { digits, spare, faint } = self.plan.goal;
        let bits = |digits: f64| digits * std::f64::consts::LOG2_10;
        let greatest = numbers.iter().map(|number| number.log2).fold(f64::NEG_INFINITY, f64::max);
        let floor = greatest - bits(digits + spare);
        let mut most = f64::NEG_INFINITY;
        for Size { log2: size, log2_error: error, may_vanish } in numbers {
            let mut missing = error - (size - bits(digits)).max(floor);
            // The number is unknown, whatever its size.
            if error.is_nan() || *error == f64::INFINITY {
                return f64::INFINITY;
            }
            // The natural scale decides when a number that is indistinguishable from zero is small enough.
            if missing > 0.0 && *may_vanish {
                missing = missing.min(error - least_scale(engine) + bits(digits + faint));
            }
            most = most.max(missing);
        }
        most
    }
}

/// Returns whether events count as one only because they agree within their bounds, and exact numbers are to decide.
fn coincides<S: Scalar>(plan: &Plan, engine: &dyn Motion<S>) -> bool {
    let contacts = engine.digits_lost().map_or(0, |(contacts, _)| contacts);
    let taken_for_one = || engine.warnings().iter().any(|warning| matches!(warning, Warning::Coincidence { .. }));
    plan.climb.exact_contacts.is_some_and(|most| contacts <= most)
        && (taken_for_one() || plan.engine == Engine::Lattice && ends_at_event(engine))
}

/// Returns whether the last event is indistinguishable from the end of the run, so that it may come after the end.
fn ends_at_event<S: Scalar>(engine: &dyn Motion<S>) -> bool {
    let Some(event) = engine.events().last().filter(|_| *engine.ending() == Ending::Time) else { return false };
    let left = engine.end() - &event.t;
    left.log2_error() > f64::NEG_INFINITY && left.vanishes() != Ok(false)
}

/// Returns whether a damped run warns that its bounds leave events open.
pub(super) fn needs_bits<S: Scalar>(engine: &dyn Motion<S>) -> bool {
    engine.warnings().iter().any(Warning::needs_bits)
}

/// Returns whether an answer in doubles comes from a run in long numbers that has reached its limit of effort.
fn breaks_off<S: Scalar>(plan: &Plan, rung: Rung, engine: &dyn Motion<S>) -> bool {
    let limited = matches!((plan.numbers, rung), (Numbers::Double(_), Rung::Bits(_)));
    limited && matches!(engine.ending(), Ending::Undecided(Reason::Effort { .. }))
}

/// Returns whether a run breaks off before another ends.
fn ends_before<S: Scalar>(engine: &dyn Motion<S>, other: &dyn Motion<S>) -> bool {
    engine.ending().is_open() && engine.end().to_f64() < other.end().to_f64() * (1.0 - 1e-6)
}

/// Returns `log₂` of the least of the natural scales of displacement, velocity, strain and energy.
fn least_scale<S: Scalar>(engine: &dyn Motion<S>) -> f64 {
    let Scales { time, velocity, length, wave_speed, .. } = engine.scales().map(|scale| scale.to_f64().log2());
    velocity + time.min(0.0).min(-wave_speed).min(velocity + length)
}
