//! Rays of a body of a chain, each of which passes the body once.

use super::passing::{NEAR, Passing, is_displaced, is_open, is_rounded, widest_bound};
use super::{Motion, Scales};
use crate::number::Scalar;

/// The rays of a body of a chain, by the times at which they leave its ends.
///
/// **Source**: a ray that leaves the lower end at τ passes the point x at `τ + x/c`, one that leaves the upper end at
/// `τ + (L − x)/c`.
#[derive(Clone, Debug)]
pub(super) struct ListedRays<S> {
    length: S,
    pub(super) wave_speed: S,
    /// Times at which rays leave the lower end and the upper end, ascending, and whether they carry a jump (otherwise
    /// only a kink).
    ends: [Vec<(S, bool)>; 2],
    /// Distance within which doubles find every ray that a time may be the time of.
    reach: f64,
}

impl<S: Scalar> ListedRays<S> {
    pub(super) fn new(motion: &dyn Motion<S>, departures: [Vec<(S, S)>; 2]) -> Self {
        let ends = departures.map(|rays| {
            let mut rays: Vec<_> = rays.into_iter().map(|(time, jump)| (time, jump.vanishes() != Ok(true))).collect();
            rays.sort_by(|a, b| a.0.to_f64().total_cmp(&b.0.to_f64()));
            rays
        });
        let Scales { length, wave_speed, time, .. } = motion.scales();
        let reach = NEAR * time.to_f64() + widest_bound(ends.iter().flatten().map(|(time, _)| time));
        ListedRays { length, wave_speed, ends, reach }
    }

    /// Returns the rays whose times are known to `roundings` roundings, and the others.
    pub(super) fn parted(self, roundings: f64) -> [Self; 2] {
        let ListedRays { length, wave_speed, ends, reach } = self;
        let round_trip = length.clone() * length.int(2) / &wave_speed;
        let (mut known, mut displaced) = ([vec![], vec![]], [vec![], vec![]]);
        for (rays, parts) in ends.into_iter().zip(known.iter_mut().zip(&mut displaced)) {
            (*parts.0, *parts.1) = rays.into_iter().partition(|(time, _)| is_rounded(time, roundings));
            parts.1.retain(|(time, _)| is_displaced(time, &round_trip));
        }
        let rays = |ends| ListedRays { length: length.clone(), wave_speed: wave_speed.clone(), ends, reach };
        [rays(known), rays(displaced)]
    }

    /// Returns the rays of each end with the time that they take to `point`.
    fn ways(&self, point: &S) -> [(&[(S, bool)], S); 2] {
        let delays = [point.clone(), self.length.clone() - point].map(|way| way / &self.wave_speed);
        let [up, down] = &self.ends;
        let [rise, fall] = delays;
        [(up, rise), (down, fall)]
    }

    /// Returns the times at which rays pass `point` near `time`, each with whether the ray goes upward.
    pub(super) fn about(&self, point: &S, time: &S) -> Vec<(S, bool)> {
        let mut met = Vec::new();
        for ((rays, delay), upward) in self.ways(point).into_iter().zip([true, false]) {
            let departure = time.to_f64() - delay.to_f64();
            let reach = self.reach + time.log2_error().exp2() + delay.log2_error().exp2();
            let first = rays.partition_point(|(ray, _)| ray.to_f64() < departure - reach);
            let near = rays[first..].iter().take_while(|(ray, _)| ray.to_f64() <= departure + reach);
            met.extend(near.map(|(ray, _)| (ray.clone() + &delay, upward)));
        }
        met
    }

    /// Returns the times at which rays pass `point` that are indistinguishable from `time` within both bounds.
    pub(super) fn near(&self, point: &S, time: &S) -> Vec<S> {
        let near = self.about(point, time).into_iter().map(|(met, _)| met);
        near.filter(|met| is_open(met, time)).collect()
    }

    /// Returns the rays that pass `point` from one time to another, in order.
    pub(super) fn passing(&self, point: &S, from: f64, to: f64) -> Vec<Passing<S>> {
        let mut found = Vec::new();
        for (rays, delay) in self.ways(point) {
            let passing =
                rays.iter().map(|(ray, jump)| Passing { time: ray.clone() + &delay, age: delay.to_f64(), jump: *jump });
            found.extend(passing.filter(|ray| (from..=to).contains(&ray.time.to_f64())));
        }
        found.sort_by(|a, b| a.time.to_f64().total_cmp(&b.time.to_f64()));
        found
    }
}
