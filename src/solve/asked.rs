//! Times that are asked for: each stands for exactly what it spells.
//!
//! A time that is not told from that of an event or a ray within both bounds lies before it, on it or after it. More
//! bits tell; what is answered until then covers all three. Only a time that the engine itself has given, such as that
//! of an event, stands for the event, whenever that is.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use crate::error::Error;
use crate::motion::moments::Moments;
use crate::motion::{Contact, Course, Ending, Event, Field, Motion, Pair, Ray, RayRegister, Scales, Side};
use crate::motion::{StressPiece, Stretch, Waves};
use crate::number::{Estimate, Number, READ, Rational, Rounded, Scalar, spelled, spelled_by};
use crate::problem::{Material, Problem, Start};
use crate::reason::Warning;

/// An engine whose answers at such times cover all that the time may mean.
#[derive(Debug)]
pub(super) struct Asked<E, S> {
    engine: E,
    /// The same motion in exact numbers, where there is one.
    exact: Option<Arc<dyn Motion<Estimate<S>>>>,
    /// Whether the engine is asked in longer numbers, which tell what a double spells.
    longer: bool,
    start: StartRays,
    rays: OnceLock<RayRegister<Estimate<S>>>,
    open: Mutex<Vec<(f64, bool)>>,
}

/// Where rays of the start are, in exact numbers.
#[derive(Debug)]
struct StartRays {
    length: Number,
    /// `None` for a root.
    wave_speed: Option<Number>,
    corners: Vec<Number>,
}

/// A double with more roundings than one does not spell what is asked for by itself.
const SPELLED: f64 = 1.5;
/// With no more roundings than these a time at a ray of the start is that of the ray.
const RAY_ROUNDINGS: f64 = 64.0;

/// The bound of a number in roundings of itself.
fn roundings<S: Rounded>(x: &Estimate<S>) -> f64 {
    let size = x.to_f64().abs();
    if size > 0.0 { x.error() / size } else { 0.0 }
}

/// Whether longer numbers know which number was spelled.
fn is_spelled<S: Rounded>(x: &Estimate<S>) -> bool {
    roundings(x) <= SPELLED || x.error() == 3.0 * x.to_f64().abs()
}

/// Whether a time was computed by an engine and not spelled.
pub(super) fn computed<S: Scalar>(time: &S) -> bool {
    let roundings = (time.log2_error() - time.to_f64().abs().log2() - time.log2_roundoff()).exp2();
    // What is spelled is off by so many roundings at its beginning, exactly.
    let spelled = [0.0, 1.0, 2.0, 3.0].into_iter().any(|few| (roundings - few).abs() < 0.5 * READ);
    !spelled && roundings.is_finite()
}

impl StartRays {
    fn of(problem: &Problem) -> Self {
        let mut corners = vec![Number::from(0), problem.rod.length.clone()];
        if let Start::Profile(profile) = &problem.start {
            corners.extend(profile.displacement.iter().chain(&profile.velocity).map(|(x, _)| x.clone()));
        }
        let wave_speed = match &problem.rod.material {
            Material::WaveSpeed(speed) => Some(speed.clone()),
            Material::Elastic { .. } => None,
        };
        StartRays { length: problem.rod.length.clone(), wave_speed, corners }
    }

    /// Whether a ray of the start is at `point` at `time` exactly.
    fn meet(&self, point: f64, time: &Estimate<f64>) -> Option<bool> {
        let (point, time) = (spelled(point)?.to_rational(), spelled_by(time)?.to_rational());
        let way = time * &self.wave_speed.as_ref()?.to_rational();
        let double = self.length.to_rational();
        let double = double.clone() + &double;
        let whole = |x: Rational| {
            let trips = x / &double;
            trips.floor_int().is_some_and(|whole| trips == trips.int(whole))
        };
        let met = |corner: &Number| {
            let corner = corner.to_rational();
            let [up, down] = [way.clone() - &point, way.clone() + &point];
            [up.clone() - &corner, up + &corner, down.clone() - &corner, down + &corner].into_iter().any(whole)
        };
        Some(self.corners.iter().any(met))
    }
}

impl<S: Rounded, E: Motion<Estimate<S>>> Asked<E, S> {
    pub(super) fn new(engine: E, problem: &Problem) -> Self {
        let (rays, open) = (OnceLock::new(), Mutex::default());
        Asked { engine, exact: None, longer: false, start: StartRays::of(problem), rays, open }
    }

    /// The same with exact numbers that tell every time.
    pub(super) fn backed(self, exact: Arc<dyn Motion<Estimate<S>>>) -> Self {
        Asked { exact: Some(exact), ..self }
    }

    /// An engine in longer numbers, read in these.
    pub(super) fn longer(engine: E, problem: &Problem) -> Self {
        Asked { longer: true, ..Self::new(engine, problem) }
    }

    /// The time as the engine has it, and the times of events and rays at `point` that it is not told from; at the
    /// ground without a point.
    fn near(&self, point: Option<&Estimate<S>>, time: &Estimate<S>) -> (Estimate<S>, Vec<Estimate<S>>) {
        let (seconds, events) = (time.to_f64(), self.engine.events());
        let told = self.longer && is_spelled(time);
        if told || computed(time) || seconds.is_nan() || seconds <= 0.0 {
            return (time.clone(), Vec::new());
        }
        let ground = point.is_none_or(|point| point.to_f64() == 0.0);
        let next = events.partition_point(|event| event.time.to_f64() < seconds);
        let mut near = Vec::new();
        if ground {
            for Event { time: event, .. } in events[next.saturating_sub(1)..].iter().take(2) {
                if event.value() == time.value() && event.error() == time.error() {
                    return (time.clone(), Vec::new());
                }
                if event.error().is_finite() && (event.clone() - time).vanishes() != Ok(false) {
                    near.push(event.clone());
                }
            }
        }
        let zero = time.zero();
        let rays = self.rays.get_or_init(|| RayRegister::of(&self.engine));
        near.extend(rays.near(point.unwrap_or(&zero), time));
        if !near.is_empty() && self.at_start_ray(point, time) {
            let on_ray = |met: &Estimate<S>| roundings(met) <= RAY_ROUNDINGS;
            let own = near.iter().find(|met| on_ray(met)).unwrap_or(time).clone();
            near.retain(|met| !on_ray(met));
            return (own, near);
        }
        (time.clone(), near)
    }

    /// What is no number is no time.
    fn finite(&self, time: &Estimate<S>) -> Result<(), Error> {
        let outside = || Error::TimeOutside { found: time.text(), end: self.engine.end().text() };
        if time.is_finite() { Ok(()) } else { Err(outside()) }
    }

    /// Whether a ray of the start is there at that very time. Long numbers hold more digits than are spelled.
    fn at_start_ray(&self, point: Option<&Estimate<S>>, time: &Estimate<S>) -> bool {
        if !is_spelled(time) {
            return false;
        }
        match (time.as_double(), point.map_or(Some(0.0), Scalar::as_double)) {
            (Some(double), Some(point)) => self.start.meet(point, &Estimate::new(double, time.error())) == Some(true),
            _ => true,
        }
    }

    /// What `ask` says at a time: where that is open, all that may be meant, put together by `cover`.
    fn answer<T>(
        &self,
        point: Option<&Estimate<S>>,
        time: &Estimate<S>,
        side: Side,
        ask: impl Fn(&dyn Motion<Estimate<S>>, &Estimate<S>, Side) -> Result<T, Error>,
        cover: impl Fn(T, &T) -> T,
    ) -> Result<T, Error> {
        self.finite(time)?;
        let (own, near) = self.near(point, time);
        if near.is_empty() {
            return ask(&self.engine, &own, side);
        }
        if let Some(exact) = self.exact.as_ref().filter(|_| is_spelled(time)) {
            return ask(&**exact, time, side);
        }
        let mut found = ask(&self.engine, time, side)?;
        // More bits hold more of what is spelled, but not read in doubles.
        let tellable = time.as_double().is_none() || is_spelled(time);
        self.open.lock().unwrap_or_else(PoisonError::into_inner).push((time.to_f64(), tellable));
        for met in near {
            let late = met.double(met.bound() + time.bound());
            let exactly = |time: Estimate<S>| Estimate::exact(time.into_value());
            let [before, after] = [exactly(met.clone() - &late), exactly(met.clone() + &late)];
            for (time, side) in [(&before, Side::Left), (&met, Side::Left), (&met, Side::Right), (&after, Side::Right)]
            {
                match ask(&self.engine, time, side) {
                    Ok(other) => found = cover(found, &other),
                    // Beyond the end there is nothing to be covered.
                    Err(Error::TimeOutside { .. }) => {}
                    Err(error) => return Err(error),
                }
            }
        }
        Ok(found)
    }
}

/// `a`, with a bound that reaches over `b`.
fn over<S: Rounded>(a: Estimate<S>, b: &Estimate<S>) -> Estimate<S> {
    let apart = b.value().clone() - a.value();
    let reach = apart.in_roundoffs() + apart.to_f64().abs() + b.error();
    Estimate::new(a.value().clone(), a.error().max(reach))
}

impl<S: Rounded, E: Motion<Estimate<S>>> Motion<Estimate<S>> for Asked<E, S> {
    fn strain(&self, time: &Estimate<S>, side: Side) -> Result<Estimate<S>, Error> {
        self.answer(None, time, side, |engine, time, side| engine.strain(time, side), over)
    }

    fn pair(&self, pair: Pair, time: &Estimate<S>, side: Side) -> Result<[Estimate<S>; 2], Error> {
        if pair != Pair::GroundEnd {
            self.finite(time)?;
            return self.engine.pair(pair, time, side);
        }
        let ask = |engine: &dyn Motion<_>, time: &_, side| engine.pair(pair, time, side);
        self.answer(None, time, side, ask, |[a, b], [c, d]| [over(a, c), over(b, d)])
    }

    fn in_contact(&self, time: &Estimate<S>, side: Side) -> Result<Estimate<S>, Error> {
        self.answer(None, time, side, |engine, time, side| engine.in_contact(time, side), over)
    }

    fn field(&self, point: &Estimate<S>, time: &Estimate<S>, side: Side) -> Result<Field<Estimate<S>>, Error> {
        let ask = |engine: &dyn Motion<_>, time: &_, side| engine.field(point, time, side);
        let cover = |found: Field<Estimate<S>>, other: &Field<Estimate<S>>| Field {
            displacement: over(found.displacement, &other.displacement),
            velocity: over(found.velocity, &other.velocity),
            strain: over(found.strain, &other.strain),
        };
        self.answer(Some(point), time, side, ask, cover)
    }

    fn may_jump(&self, time: &Estimate<S>) -> Result<bool, Error> {
        let top = self.scales().length;
        let [(own, ground), (_, above)] = [None, Some(&top)].map(|point| self.near(point, time));
        if ground.is_empty() && above.is_empty() { self.engine.may_jump(&own) } else { Ok(true) }
    }

    fn take_open_times(&self) -> Vec<(f64, bool)> {
        let own = std::mem::take(&mut *self.open.lock().unwrap_or_else(PoisonError::into_inner));
        self.engine.take_open_times().into_iter().chain(own).collect()
    }

    fn course(&self) -> &Course<Estimate<S>> {
        self.engine.course()
    }
    fn scales(&self) -> Scales<Estimate<S>> {
        self.engine.scales()
    }
    fn stress_pieces(&self) -> Vec<StressPiece<Estimate<S>>> {
        self.engine.stress_pieces()
    }
    fn end(&self) -> Estimate<S> {
        self.engine.end()
    }
    fn ending(&self) -> &Ending {
        self.engine.ending()
    }
    fn events(&self) -> &[Event<Estimate<S>>] {
        self.engine.events()
    }
    fn contacts(&self) -> &[Contact<Estimate<S>>] {
        self.engine.contacts()
    }
    fn contact_times(&self, contact: usize) -> Option<(Estimate<S>, Option<Estimate<S>>)> {
        self.engine.contact_times(contact)
    }
    fn impulse(&self, contact: usize) -> Option<Estimate<S>> {
        self.engine.impulse(contact)
    }
    fn warnings(&self) -> &[Warning] {
        self.engine.warnings()
    }
    fn rates(&self, points: &[Estimate<S>], times: &[Estimate<S>]) -> Result<Vec<[Estimate<S>; 2]>, Error> {
        self.engine.rates(points, times)
    }
    fn highest(&self, release: usize) -> Option<(Estimate<S>, Estimate<S>)> {
        self.engine.highest(release)
    }
    fn rays(&self, trip: usize) -> Result<Vec<Ray<Estimate<S>>>, Error> {
        self.engine.rays(trip)
    }
    fn stretches(&self, time: &Estimate<S>) -> Result<Vec<Stretch<Estimate<S>>>, Error> {
        self.engine.stretches(time)
    }
    fn corners(&self) -> Vec<Estimate<S>> {
        self.engine.corners()
    }
    fn moments(&self, time: &Estimate<S>, points: &[Estimate<S>]) -> Result<Vec<Moments<Estimate<S>>>, Error> {
        self.engine.moments(time, points)
    }
    fn waves(&self) -> Result<Waves<Estimate<S>>, Error> {
        self.engine.waves()
    }
    fn error_estimate(&self) -> Estimate<S> {
        self.engine.error_estimate()
    }
    fn digits_lost(&self) -> Option<(u32, f64)> {
        self.engine.digits_lost()
    }
}
