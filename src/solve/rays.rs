//! When rays pass a point, for times that are rounded to other numbers than those of the run.

use crate::motion::Motion;
use crate::number::{Number, Scalar};
use crate::problem::{Problem, Start};

/// The rays of a run by the times at which they are at the ground, modulo round trips.
///
/// **Source**: a ray that is at the ground at τ passes the point x at `τ + k t₁ ± x/c`. Rays begin at the start, at the
/// points between which its data are linear, and at each impact and release.
#[derive(Debug)]
pub(super) struct Rays<N> {
    round_trip: N,
    wave_speed: N,
    end: N,
    /// `τ`, with the fraction of `τ/t₁` in doubles, in the order of these.
    known: Vec<(f64, N)>,
}

/// Fractions of a round trip that differ by more are not compared in the numbers of the run: doubles hold a fraction of
/// a million round trips to 1e-10.
const NEAR: f64 = 1e-6;

impl<N: Scalar> Rays<N> {
    pub(super) fn of(motion: &dyn Motion<N>, problem: &Problem) -> Self {
        let scales = motion.scales();
        let precision = motion.end().precision();
        let mut known = vec![(0.0, scales.time.zero())];
        let mut add = |time: N| known.push((fraction(&(time.clone() / &scales.time)), time));
        if let Start::Profile(profile) = &problem.start {
            let mut of = |(point, _): &(Number, Number)| {
                let after = N::from_number(point, &precision) / &scales.wave_speed;
                add(-after.clone());
                add(after);
            };
            profile.displacement.iter().for_each(&mut of);
            profile.velocity.iter().for_each(of);
        }
        motion.events().iter().for_each(|event| add(event.time.clone()));
        known.sort_by(|a, b| a.0.total_cmp(&b.0));
        Rays { round_trip: scales.time, wave_speed: scales.wave_speed, end: motion.end(), known }
    }

    /// `time`, or that within `roundings` of it at which a ray passes `point`.
    pub(super) fn meant(&self, point: &N, time: N, roundings: f64) -> N {
        let travel = point.clone() / &self.wave_speed;
        let on_ray = |delay: N| {
            let at_ground = time.clone() - &delay;
            self.known_near(fraction(&(at_ground.clone() / &self.round_trip))).find_map(|known| {
                let trips = (at_ground.clone() - known) / &self.round_trip;
                let trips = (trips.clone() + trips.ratio(1, 2)).floor_int().filter(|trips| *trips >= 0)?;
                let met = self.round_trip.int(trips) * &self.round_trip + known + &delay;
                let near = (met.clone() - &time).to_f64().abs() <= roundings;
                (near && self.end.below(&met) != Ok(true)).then_some(met)
            })
        };
        on_ray(travel.clone()).or_else(|| on_ray(-travel)).unwrap_or(time)
    }

    /// The rays at about this fraction of a round trip: 0 and 1 are neighbours.
    fn known_near(&self, fraction: f64) -> impl Iterator<Item = &N> {
        [fraction - 1.0, fraction, fraction + 1.0].into_iter().flat_map(|fraction| {
            let from = self.known.partition_point(|(known, _)| *known < fraction - NEAR);
            self.known[from..].iter().take_while(move |(known, _)| *known <= fraction + NEAR).map(|(_, time)| time)
        })
    }
}

fn fraction<N: Scalar>(trips: &N) -> f64 {
    let trips = trips.to_f64();
    trips - trips.floor()
}
