//! Runs of a chain, seen from one of its bodies.

use std::sync::Arc;

use super::ladder::Ladder;
use super::plan::Plan;
use super::question::Numbers;
use super::rung::{COARSE, LONG, Lacks, Rung};
use crate::chain::{BodyMotion, Chain, ChainRun, Varied};
use crate::error::Error;
use crate::motion::{Ending, Event, Motion};
use crate::number::{Bounded, Estimate, Scalar};
use crate::problem::Problem;
use crate::reason::Warning;

/// Whether motions of bodies of chains are built in.
const CHAINS: bool = cfg!(feature = "chain");
/// Limit of the wave pieces of an attempt in fractions, whose numbers grow with every joint.
pub(crate) const EXACT_PIECES: usize = 20_000;

/// Returns the error of an attempt that longer numbers follow.
fn undecided(rung: Rung, what: &'static str) -> Error {
    Error::NotDecided { what, bits: rung.bits() }
}

fn is_last(plan: &Plan, rung: Rung) -> bool {
    plan.next(rung, Lacks::Bits(f64::INFINITY)).is_none()
}

/// Returns the motion of the body that the problem describes, from a run of its chain in the numbers `N`.
///
/// **Errors**: those of the run; [`Error::NotDecided`] if longer numbers follow and this run does not decide its
/// events, or if its fractions end.
pub(super) fn motion<N: Bounded>(ladder: Ladder<'_>, at: (Rung, &N::Precision)) -> Result<BodyMotion<N>, Error> {
    let (plan, rung, motion) = (ladder.plan, at.0, open_motion::<N>(ladder, at)?);
    if !is_last(plan, rung) && motion.undetermined_from().is_some() {
        return Err(undecided(rung, "in which order the events come"));
    }
    if !is_last(plan, rung) && matches!(motion.ending(), Ending::ExactnessEnds { .. } | Ending::Undecided(_)) {
        return Err(undecided(rung, "what happens at a joint"));
    }
    Ok(motion)
}

/// Returns [`motion`] also where it leaves decisions open.
fn open_motion<N: Bounded>(
    Ladder { problem, plan, observe }: Ladder<'_>,
    (rung, precision): (Rung, &N::Precision),
) -> Result<BodyMotion<N>, Error> {
    if !CHAINS {
        return Err(Error::NoChains);
    }
    let problem = plan.reaching(problem);
    let (Some((chain, body)), Some(place)) = (problem.chain(), &problem.in_chain) else {
        return Err(undecided(rung, "a chain without neighbours"));
    };
    let is_last = is_last(plan, rung);
    let limited = rung == Rung::Fractions && !is_last && chain.max_pieces() > EXACT_PIECES;
    let run = || {
        let limit = Chain::with_max_pieces;
        let chain = if limited { &limit(&chain, EXACT_PIECES) } else { &chain };
        let observe = &|events: usize, pieces: usize| observe(events, pieces);
        match rung {
            Rung::Bits(bits) if LONG => ChainRun::<N>::confirmed(chain, precision, bits, observe),
            _ => ChainRun::<N>::new(chain, precision, observe),
        }
    };
    let run = match place.runs.get(&chain, rung.bits(), run) {
        Err(Error::TooManyPieces { .. }) if limited => return Err(undecided(rung, "by fractions")),
        // Doubles keep their answer where fractions have none.
        Err(Error::Irrational { .. } | Error::SoftExact) if !is_last || matches!(plan.numbers, Numbers::Double(_)) => {
            return Err(undecided(rung, "by fractions"));
        }
        run => run?,
    };
    Ok(BodyMotion::new(&chain, body, run))
}

/// Returns the motion in doubles where a picture is asked for and longer numbers leave a decision open: doubles with
/// the same events, known to the accuracy of the picture, are right under the same condition, and answer many times as
/// fast.
pub(super) fn sketch(ladder: Ladder<'_>, long: &dyn Motion<Estimate<f64>>) -> Option<BodyMotion<Estimate<f64>>> {
    let Numbers::Double(Some(accuracy)) = ladder.plan.numbers else { return None };
    let is_open = long.warnings().iter().any(|warning| matches!(warning, Warning::Coincidence { .. }));
    if accuracy < COARSE || !is_open {
        return None;
    }
    let motion = open_motion(ladder, (Rung::Double, &())).ok()?;
    let is_same = |(a, b): (&Event<Estimate<f64>>, &Event<Estimate<f64>>)| {
        a.kind == b.kind && (a.t.clone() - &b.t).vanishes() != Ok(false)
    };
    let agrees = *motion.ending() == Ending::Time
        && motion.events().len() == long.events().len()
        && motion.events().iter().zip(long.events()).all(is_same)
        && motion.error_estimate().to_f64() <= accuracy;
    agrees.then_some(motion)
}

/// Returns the motion of the body that the problem describes, in numbers that carry the rates at which they change as
/// the problem changes to `further`, or away from it where the value `falls`.
///
/// **Errors**: those of the run.
pub(super) fn varied<N: Bounded>(
    Ladder { problem, plan, observe }: Ladder<'_>,
    further: &Problem,
    falls: bool,
    precision: &N::Precision,
) -> Result<BodyMotion<N>, Error> {
    let (Some((chain, body)), Some((further, _))) = (problem.chain(), further.chain()) else {
        return Err(Error::NotDecided { what: "a chain without neighbours", bits: 0 });
    };
    // Doubles have another way where the numbers of fractions grow.
    let limit = if matches!(plan.numbers, Numbers::Double(_)) { EXACT_PIECES } else { usize::MAX };
    let chain = chain.with_max_pieces(chain.max_pieces().min(limit));
    let varied = Varied { now: &chain, further: &further, falls };
    let run = ChainRun::varied(varied, precision, &|events, pieces| observe(events, pieces))?;
    Ok(BodyMotion::new(&chain, body, Arc::new(run)))
}

pub(super) fn engine<N: Bounded>(ladder: Ladder<'_>, at: (Rung, &N::Precision)) -> Result<Arc<dyn Motion<N>>, Error> {
    Ok(Arc::new(motion::<N>(ladder, at)?))
}
