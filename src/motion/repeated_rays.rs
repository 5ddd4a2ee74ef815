//! Rays of a rod by itself, which both ends reflect for ever.

use super::passing::{NEAR, Passing, is_displaced, is_open, is_rounded, widest_bound};
use super::{Event, EventKind, Motion, Scales};
use crate::number::Scalar;

/// The rays of a rod by itself, by the times at which they leave the ground, modulo round trips.
///
/// **Source**: a ray that leaves the ground at τ passes the point x at `τ + x/c + k t₁` and `τ − x/c + (k + 1) t₁`,
/// `k ≥ 0`. Rays begin at impacts and releases, and at the points between which the initial data are linear; the latter
/// are entered as if they had left the ground before the start.
///
/// **Accuracy**: each time is known within the bound that it carries; no other tolerance distinguishes two rays.
#[derive(Clone, Debug)]
pub(super) struct RepeatedRays<S> {
    round_trip: S,
    pub(super) wave_speed: S,
    /// Groups of rays that are at the ground at the same times modulo round trips, in the order of these times.
    known: Vec<Phase<S>>,
    /// The greatest bound of their times, in round trips.
    widest: f64,
}

/// Rays whose times differ by whole round trips.
#[derive(Clone, Debug)]
struct Phase<S> {
    /// Fraction of a round trip, as a double.
    fraction: f64,
    /// Times at which they leave the ground, ascending, and whether they may carry a jump (otherwise only a kink).
    rays: Vec<(S, bool)>,
}

impl<S: Scalar> RepeatedRays<S> {
    pub(super) fn of(motion: &dyn Motion<S>) -> Self {
        let mut found = Self::of_start(motion);
        for event in motion.events().iter().filter(|event| event.t.to_f64() != 0.0) {
            found.push(ray_of(event));
        }
        Self::with(motion, found)
    }

    /// Returns the rays of the start, and the displaced rays: those of events whose time error exceeds `roundings`
    /// roundings of the time, or that lie on no ray of the start.
    pub(super) fn parted(motion: &dyn Motion<S>, roundings: f64) -> [Self; 2] {
        let start = Self::with(motion, Self::of_start(motion));
        let own = |time: &S| is_rounded(time, roundings) && !start.near(&time.zero(), time).is_empty();
        let round_trip = motion.scales().time;
        let times = motion.events().iter().map(|event| &event.t);
        let off = times.filter(|time| is_displaced(*time, &round_trip) && time.to_f64() > 0.0 && !own(time));
        let displaced = Self::with(motion, off.map(|time| (time.clone(), true)).collect());
        [start, displaced]
    }

    /// Returns the rays of the initial data, and the ray of a rod that stands on the ground.
    fn of_start(motion: &dyn Motion<S>) -> Vec<(S, bool)> {
        let Scales { time: round_trip, wave_speed, .. } = motion.scales();
        let mut found = Vec::new();
        for corner in motion.corners() {
            let late = corner / &wave_speed;
            found.extend([(-late.clone(), true), (late - &round_trip, true)]);
        }
        let stands = motion.events().first().filter(|event| event.t.to_f64() == 0.0);
        found.extend(stands.map(ray_of));
        found
    }

    fn with(motion: &dyn Motion<S>, found: Vec<(S, bool)>) -> Self {
        let Scales { time: round_trip, wave_speed, .. } = motion.scales();
        let fraction = |time: &S| fraction(&(time.clone() / &round_trip));
        let mut phases: Vec<_> = found.into_iter().map(|ray| (fraction(&ray.0), ray)).collect();
        phases.sort_by(|(a, (at_a, _)), (b, (at_b, _))| a.total_cmp(b).then(at_a.to_f64().total_cmp(&at_b.to_f64())));
        let widest = widest_bound(phases.iter().map(|(_, (time, _))| time)) / round_trip.to_f64();
        let mut rays = RepeatedRays { round_trip, wave_speed, known: Vec::new(), widest };
        for (fraction, ray) in phases {
            match rays.known.last() {
                Some(last) if fraction - last.fraction <= NEAR && rays.same_phase(&last.rays[0].0, &ray.0) => {
                    let last = rays.known.len() - 1;
                    rays.known[last].rays.push(ray);
                }
                _ => rays.known.push(Phase { fraction, rays: vec![ray] }),
            }
        }
        for phase in &mut rays.known {
            phase.rays.sort_by(|a, b| a.0.to_f64().total_cmp(&b.0.to_f64()));
        }
        rays
    }

    /// Returns whether two times differ by whole round trips, within their bounds.
    fn same_phase(&self, a: &S, b: &S) -> bool {
        let apart = b.clone() - a;
        let trips = (apart.to_f64() / self.round_trip.to_f64()).round();
        (apart - self.round_trip.double(trips) * &self.round_trip).vanishes() != Ok(false)
    }

    /// Returns the times at which rays pass `point` that are indistinguishable from `time` within both bounds.
    pub(super) fn near(&self, point: &S, time: &S) -> Vec<S> {
        // Doubles decide almost all cases.
        let (trip, seconds) = (self.round_trip.to_f64(), time.to_f64());
        let wave_speed = self.wave_speed.to_f64();
        let travel = point.to_f64() / wave_speed;
        let asked = (time.log2_error().exp2() + point.log2_error().exp2() / wave_speed) / trip;
        let widest = (self.widest + asked).min(1.0);
        let about = |delay: f64| {
            let trips = (seconds - delay) / trip;
            !self.known_near(trips - trips.floor(), NEAR + widest).is_empty()
        };
        if !about(travel) && !about(-travel) {
            return Vec::new();
        }
        let near = self.about(point, time, widest).into_iter().map(|(met, _)| met);
        near.filter(|met| is_open(met, time)).collect()
    }

    /// Returns the times at which rays pass `point` near `time`, up to `widest` round trips apart, each with whether
    /// the ray goes upward there.
    pub(super) fn about(&self, point: &S, time: &S, widest: f64) -> Vec<(S, bool)> {
        let travel = point.clone() / &self.wave_speed;
        let down = (point.vanishes() != Ok(true)).then(|| (-travel.clone(), false));
        let mut met = Vec::new();
        for (delay, upward) in std::iter::once((travel, true)).chain(down) {
            let at_ground = time.clone() - &delay;
            let place = fraction(&(at_ground.clone() / &self.round_trip));
            for known in self.known_near(place, NEAR + widest) {
                let trips = (at_ground.clone() - known) / &self.round_trip;
                if let Some(trips @ 0..) = (trips.clone() + trips.ratio(1, 2)).floor_int() {
                    met.push((self.round_trip.int(trips) * &self.round_trip + known + &delay, upward));
                }
            }
        }
        met
    }

    /// Returns the rays near this fraction of a round trip; 0 and 1 are neighbours.
    fn known_near(&self, fraction: f64, apart: f64) -> Vec<&S> {
        let near = [fraction - 1.0, fraction, fraction + 1.0].into_iter().flat_map(|fraction| {
            let from = self.known.partition_point(|phase| phase.fraction < fraction - apart);
            self.known[from..].iter().take_while(move |phase| phase.fraction <= fraction + apart)
        });
        near.map(|phase| &phase.rays[0].0).collect()
    }

    /// Returns the rays that pass `point` from one time to another, in order. At the ground this includes rays from the
    /// start that have never been there, as if they had left it before.
    pub(super) fn passing(&self, point: &S, from: f64, to: f64) -> Vec<Passing<S>> {
        let (trip, travel) = (self.round_trip.to_f64(), point.clone() / &self.wave_speed);
        let mut found: Vec<Passing<S>> = Vec::new();
        for Phase { rays, .. } in &self.known {
            let first = &rays[0].0;
            let first_jump = rays.iter().position(|ray| ray.1).unwrap_or(rays.len());
            let down = self.round_trip.clone() - &travel;
            for delay in [travel.clone(), down] {
                let (begins, late) = (first.to_f64(), delay.to_f64());
                let before = ((from - begins - late) / trip).floor().max(0.0);
                for k in 0u32.. {
                    let trips = before + f64::from(k);
                    let time = self.round_trip.double(trips) * &self.round_trip + first + &delay;
                    let at = time.to_f64();
                    if at > to {
                        break;
                    }
                    // The latest ray of the phase carries on for the earlier ones.
                    let begun = rays.partition_point(|(ray, _)| ray.to_f64() <= at - late + NEAR * trip).max(1);
                    if at >= from {
                        let (jump, age) = (begun > first_jump, at - rays[begun - 1].0.to_f64());
                        found.push(Passing { time, age, jump });
                    }
                }
            }
        }
        found.sort_by(|a, b| a.time.to_f64().total_cmp(&b.time.to_f64()));
        found.dedup_by(|b, a| {
            let apart = b.time.clone() - &a.time;
            let one = apart.to_f64() <= NEAR * trip && apart.vanishes() != Ok(false);
            if one {
                *a = Passing { time: a.time.clone(), age: a.age.min(b.age), jump: a.jump || b.jump };
            }
            one
        });
        found
    }
}

/// Returns the time at which the ray leaves the ground, and whether it may carry a jump.
fn ray_of<S: Scalar>(event: &Event<S>) -> (S, bool) {
    (event.t.clone(), event.kind == EventKind::Impact && event.v_end.vanishes() != Ok(true))
}

fn fraction<S: Scalar>(trips: &S) -> f64 {
    let trips = trips.to_f64();
    trips - trips.floor()
}
