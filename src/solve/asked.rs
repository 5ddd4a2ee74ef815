//! Queries at times next to an event or a ray: each time represents exactly the number that it spells.
//!
//! A time that is indistinguishable from that of an event or of a displaced ray within both bounds may lie before it,
//! on it or after it. Such a query goes to longer runs, which are made for these times only and kept. If none of them
//! decides, the answer covers both sides. All other times are answered directly.

use std::convert::identity;
use std::sync::{Arc, Mutex, OnceLock};

use super::forwarded::forwarded;
use super::ladder::Engined;
use super::rung::Rung;
use crate::error::Error;
use crate::motion::moments::Moments;
use crate::motion::{Course, Field, Motion, Pair, RayRegister, Scales, Side, Stretch};
use crate::number::{Answer, Estimate, Rational, Rounded, Scalar, Spelling, spelled_as};
use crate::problem::{Material, Problem, Start};
use crate::threads::locked;

/// The rays of a motion: those of the start, and those of events whose times carry errors.
pub(super) struct Windows<N> {
    start: RayRegister<N>,
    displaced: RayRegister<N>,
}

/// Maximum time error, in roundings, of a ray that counts as exactly placed.
const ROUNDED: f64 = 64.0;
/// Maximum distance, in roundings, at which a computed time counts as that of an event or a ray.
const COMPUTED: f64 = 8.0;

impl<N: Scalar> Windows<N> {
    pub(super) fn of(motion: &dyn Motion<N>) -> Self {
        let [start, displaced] = RayRegister::parted(motion, ROUNDED);
        Windows { start, displaced }
    }

    pub(super) fn displaced(&self, point: &N, time: &N) -> Vec<N> {
        self.displaced.near(point, time)
    }

    pub(super) fn all(&self, point: &N, time: &N) -> Vec<N> {
        let mut near = self.displaced(point, time);
        near.extend(self.start.near(point, time));
        near
    }
}

/// The rays of the start, in fractions.
struct StartRays {
    /// The path of a round trip, `2L`.
    trip: Rational,
    /// The wave speed; `None` if it is irrational: then no fraction is the time of such a ray.
    wave_speed: Option<Rational>,
    corners: Vec<Rational>,
}

impl StartRays {
    fn of(problem: &Problem) -> Self {
        let length = problem.length().to_rational();
        let mut corners = vec![length.zero(), length.clone()];
        if let Start::Profile(profile) = problem.start() {
            let lists = [&profile.displacement, &profile.strain, &profile.velocity];
            corners.extend(lists.into_iter().flatten().map(|(x, _)| x.to_rational()));
        }
        let wave_speed = match problem.material() {
            Material::WaveSpeed(speed) => Some(speed.to_rational()),
            Material::Elastic { modulus, density, .. } => (modulus.to_rational() / density.to_rational()).try_sqrt(),
        };
        StartRays { trip: length.clone() + length, wave_speed, corners }
    }

    /// Returns whether a ray of the start passes a point exactly at the time that `time` spells.
    fn meet<S: Rounded>(&self, point: &Estimate<S>, time: &Estimate<S>) -> bool {
        let exactly = |x: &Estimate<S>| Some(spelled_as(x.as_double()?, x.spelled_as())?.to_rational());
        let (Some(point), Some(time), Some(wave_speed)) = (exactly(point), exactly(time), &self.wave_speed) else {
            return false;
        };
        let way = time * wave_speed;
        let whole = |x: Rational| {
            let trips = x / &self.trip;
            trips.floor_int().is_some_and(|whole| trips == trips.int(whole))
        };
        self.corners.iter().any(|corner| {
            let [up, down] = [way.clone() - &point, way.clone() + &point];
            [up.clone() - corner, up + corner, down.clone() - corner, down + corner].into_iter().any(whole)
        })
    }
}

const NOT_TOLD: &str = "on which side of an event or a ray a time lies";

/// Builds the error that tells the caller to query a longer run.
pub(super) fn not_told(bits: Option<u32>) -> Error {
    Error::not_decided(NOT_TOLD, bits)
}

/// The longer runs for such times, in order, and the function that makes them.
pub(super) struct Longer<S: Answer> {
    pub(super) rungs: Vec<Rung>,
    /// Maximum number of contacts for which fractions are tried.
    pub(super) exact_contacts: u32,
    pub(super) run: Box<dyn Fn(Rung) -> Result<Engined<S>, Error> + Send + Sync>,
}

/// Treatment of a time on which an engine is undecided.
pub(super) enum Open<S: Answer> {
    /// Longer runs are queried; if none decides, the answer covers both sides.
    Ask(Longer<S>),
    /// The same, for an engine that reports undecided times itself.
    Says(Longer<S>),
    /// Spelled times yield this error; computed times stand for the event or the ray.
    Refuse(Error),
}

/// An engine with the treatment of times on which it is undecided.
pub(super) struct TimeResolver<S: Rounded> {
    engine: Engined<S>,
    windows: OnceLock<Windows<Estimate<S>>>,
    start: StartRays,
    open: Open<S>,
    made: Mutex<Vec<(Rung, Option<Engined<S>>)>>,
    covered: Mutex<Vec<f64>>,
}

impl<S: Rounded> TimeResolver<S> {
    pub(super) fn of(engine: Engined<S>, problem: &Problem, open: Open<S>) -> Engined<S> {
        let (windows, made, covered) = (OnceLock::new(), Mutex::default(), Mutex::default());
        Arc::new(TimeResolver { engine, windows, start: StartRays::of(problem), open, made, covered })
    }

    fn windows(&self) -> &Windows<Estimate<S>> {
        self.windows.get_or_init(|| Windows::of(&*self.engine))
    }

    fn near(&self, point: &Estimate<S>, time: &Estimate<S>) -> Vec<Estimate<S>> {
        let (windows, refuses) = (self.windows(), matches!(self.open, Open::Refuse(_)));
        match time.spelled_as() {
            None if refuses => return Vec::new(),
            None => {}
            // Long numbers do not record a shortest decimal.
            Some(_) if refuses => return windows.displaced(point, time),
            Some(spelling) => {
                let near = windows.all(point, time);
                let met = spelling != Spelling::Near && !near.is_empty() && self.start.meet(point, time);
                return if met { windows.displaced(point, time) } else { near };
            }
        }
        let mut near = windows.displaced(point, time);
        let roundings = COMPUTED * time.value().unit() * time.to_f64().abs();
        let apart = |met: &Estimate<S>| (met.value().clone() - time.value()).to_f64().abs();
        if near.iter().any(|met| apart(met) <= roundings) {
            near.clear();
        }
        near
    }

    /// Returns a longer run, which is made at its first use.
    fn made(&self, longer: &Longer<S>, rung: Rung) -> Option<Engined<S>> {
        let mut made = locked(&self.made);
        if let Some((_, run)) = made.iter().find(|(known, _)| *known == rung) {
            return run.clone();
        }
        let run = (longer.run)(rung).ok();
        made.push((rung, run.clone()));
        run
    }

    /// Returns the answer of `ask` at a time, from a longer run if this one is undecided; otherwise all possible
    /// answers, combined by `cover`.
    fn answer<T>(
        &self,
        point: &Estimate<S>,
        time: &Estimate<S>,
        side: Side,
        ask: impl Fn(&dyn Motion<Estimate<S>>, &Estimate<S>, Side) -> Result<T, Error>,
        cover: impl Fn(T, &T) -> T,
    ) -> Result<T, Error> {
        let longer = match &self.open {
            Open::Says(longer) => match ask(&*self.engine, time, side) {
                Err(Error::NotDecided { what: NOT_TOLD, .. } | Error::Open(_)) => longer,
                found => return found,
            },
            _ if self.near(point, time).is_empty() => return ask(&*self.engine, time, side),
            Open::Ask(longer) => longer,
            Open::Refuse(error) => return Err(error.clone()),
        };
        for rung in &longer.rungs {
            // Fractions interpret a double as the number that it spells.
            let many = || self.engine.digits_lost().is_some_and(|(contacts, _)| contacts > longer.exact_contacts);
            if *rung == Rung::Fractions && (time.spelled_as() == Some(Spelling::Near) || many()) {
                continue;
            }
            if let Some(Ok(found)) = self.made(longer, *rung).map(|run| ask(&*run, time, side)) {
                return Ok(found);
            }
        }
        let mut met = self.windows().all(point, time);
        if met.is_empty() {
            met.push(time.clone());
        }
        locked(&self.covered).push(time.to_f64());
        let mut found: Option<T> = None;
        for met in met {
            // `time` is within both bounds of `met`, and a spelled time within its bound of `time`; a computed one
            // stands for `met`.
            let spelled = if time.spelled_as().is_some() { time.bound() } else { 0.0 };
            let late = met.double(met.bound() + time.bound() + spelled);
            let exactly = |time: Estimate<S>| Estimate::exact(time.into_value());
            let [before, after] = [exactly(met.clone() - &late), exactly(met.clone() + &late)];
            for (time, side) in [(&before, Side::Left), (&met, Side::Left), (&met, Side::Right), (&after, Side::Right)]
            {
                match ask(&*self.engine, time, side) {
                    Ok(other) => {
                        found = Some(match found {
                            Some(found) => cover(found, &other),
                            None => other,
                        });
                    }
                    // Times beyond the end need no cover.
                    Err(Error::TimeOutside { .. } | Error::NotDecided { .. } | Error::Open(_)) => {}
                    Err(error) => return Err(error),
                }
            }
        }
        found.map_or_else(|| ask(&*self.engine, time, side), Ok)
    }
}

/// Returns a number whose bound covers both numbers with their bounds.
fn hull<S: Rounded>(a: Estimate<S>, b: &Estimate<S>) -> Estimate<S> {
    if a.error().is_nan() || b.error().is_nan() {
        return Estimate::new(a.into_value(), f64::INFINITY);
    }
    let apart = b.value().clone() - a.value();
    let far = apart.in_roundoffs() + apart.to_f64().abs();
    let to = if apart.is_negative() { -far } else { far };
    let (low, high) = ((-a.error()).min(to - b.error()), a.error().max(to + b.error()));
    if (low, high) == (-a.error(), a.error()) || !(high - low).is_finite() {
        return Estimate::new(a.value().clone(), high.max(-low));
    }
    let step = apart.double((low + high) / 2.0) * &apart.roundoff();
    let middle = a.value().clone() + &step;
    // The margin covers the rounding of the step, the sum and half of the width.
    let rounding = 4.0 * (middle.to_f64().abs() + step.to_f64().abs());
    Estimate::new(middle, (high - low) / 2.0 + rounding)
}

impl<S: Rounded> Motion<Estimate<S>> for TimeResolver<S> {
    forwarded!(Estimate<S>, identity);

    fn strain(&self, time: &Estimate<S>, side: Side) -> Result<Estimate<S>, Error> {
        self.answer(&time.zero(), time, side, |engine, time, side| engine.strain(time, side), hull)
    }

    fn pair(&self, pair: Pair, time: &Estimate<S>, side: Side) -> Result<[Estimate<S>; 2], Error> {
        if pair != Pair::GroundEnd {
            return self.engine.pair(pair, time, side);
        }
        let ask = |engine: &dyn Motion<_>, time: &_, side| engine.pair(pair, time, side);
        self.answer(&time.zero(), time, side, ask, |[a, b], [c, d]| [hull(a, c), hull(b, d)])
    }

    fn in_contact(&self, time: &Estimate<S>, side: Side) -> Result<Estimate<S>, Error> {
        let cover = |found: Estimate<S>, other: &Estimate<S>| {
            // The value stays 0 or 1: a number between them has no meaning.
            let apart = (other.value().clone() - found.value()).in_roundoffs();
            Estimate::new(found.value().clone(), found.error().max(apart))
        };
        self.answer(&time.zero(), time, side, |engine, time, side| engine.in_contact(time, side), cover)
    }

    fn field(&self, point: &Estimate<S>, time: &Estimate<S>, side: Side) -> Result<Field<Estimate<S>>, Error> {
        let ask = |engine: &dyn Motion<_>, time: &_, side| engine.field(point, time, side);
        let cover = |found: Field<Estimate<S>>, other: &Field<Estimate<S>>| Field {
            displacement: hull(found.displacement, &other.displacement),
            velocity: hull(found.velocity, &other.velocity),
            strain: hull(found.strain, &other.strain),
        };
        self.answer(point, time, side, ask, cover)
    }

    fn may_jump(&self, time: &Estimate<S>) -> Result<bool, Error> {
        let [ground, top] = [time.zero(), self.engine.scales().length];
        if matches!(self.open, Open::Says(_)) {
            return Ok(self.engine.may_jump(time).unwrap_or(true));
        }
        let near = [ground, top].iter().any(|point| !self.near(point, time).is_empty());
        if near { Ok(true) } else { self.engine.may_jump(time) }
    }

    fn covered(&self) -> Option<(Vec<f64>, &dyn Motion<Estimate<S>>)> {
        let covered = locked(&self.covered);
        (!covered.is_empty()).then(|| (covered.clone(), &*self.engine))
    }

    fn course(&self) -> &Course<Estimate<S>> {
        self.engine.course()
    }
    fn scales(&self) -> Scales<Estimate<S>> {
        self.engine.scales()
    }
    fn rates(&self, places: &[(Estimate<S>, Estimate<S>)]) -> Result<Vec<[Estimate<S>; 2]>, Error> {
        self.engine.rates(places)
    }
    fn stretches(&self, time: &Estimate<S>) -> Result<Vec<Stretch<Estimate<S>>>, Error> {
        self.engine.stretches(time)
    }
    fn moments(&self, time: &Estimate<S>, points: &[Estimate<S>]) -> Result<Vec<Moments<Estimate<S>>>, Error> {
        self.engine.moments(time, points)
    }
}

#[cfg(test)]
#[path = "tests/asked.rs"]
mod tests;
