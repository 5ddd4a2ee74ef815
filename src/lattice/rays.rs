//! The rays of the lattice.

use super::history::Undamped;
use super::trace::Place;
use crate::motion::Ray;
use crate::number::Bounded;
use crate::problem::Top;

impl<N: Bounded> Undamped<N> {
    /// The rays that leave the ground in round trip `trip` (0 is the first), in order, jumps and mere kinks.
    pub(super) fn rays_of(&self, trip: usize) -> Vec<Ray<N>> {
        let trace = &self.ground().trace;
        if trip >= trace.trips() {
            return Vec::new();
        }
        let units = self.units();
        let mut rays = Vec::new();
        for piece in 0..trace.slice(trip + 1).len() {
            let mut here = Place { index: trip + 1, piece, age: units.length.zero() };
            let after = trace.piece(&here);
            here.age = after.age;
            let left = trace.place_before(here.index, piece, &here.age);
            let before = trace.piece(&left);
            let jump = after.line.value_at(&here.age) - before.line.value_at(&left.age);
            let kink = after.line.slope - &before.line.slope;
            if jump.vanishes() == Ok(true) && kink.vanishes() == Ok(true) {
                continue;
            }
            let half = (jump * &units.velocity).halved();
            let strain = half.clone() / &units.wave_speed;
            let from = (here.age.int(trip as i64) + &here.age) * &units.round_trip;
            let up = [-strain.clone(), half.clone()];
            let down = match self.top() {
                Top::Free => [strain, half],
                Top::Fixed => [-strain, -half],
            };
            let kink = (kink * &units.velocity / &units.round_trip).halved();
            rays.push(Ray { to: from.clone() + &units.round_trip, from, up, down, kink });
        }
        rays
    }
}
