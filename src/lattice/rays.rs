//! The rays of the lattice and the jumps that they carry.

use glam::{DMat2, DVec2};

use super::history::Undamped;
use super::trace::Place;
use crate::number::{Bounded, Scalar};
use crate::problem::Top;

/// A ray `ct = ±(x − 2kL)` of the lattice over one round trip: up from the ground, back from the top.
///
/// **Source**: Proposition 2. Across a ray going up `[v_x] = −[p]/2c`, `[v_t] = [p]/2`; across one coming down
/// `[v_x] = [q]/2c`, `[v_t] = [q]/2`, the jump being taken in the direction of time at a fixed point.
#[derive(Clone, Debug, PartialEq)]
pub struct Ray<S> {
    /// When it leaves the ground.
    pub from: S,
    /// When it comes back.
    pub to: S,
    /// `([v_x], [v_t])` on the way up.
    pub up: [S; 2],
    /// `([v_x], [v_t])` on the way down.
    pub down: [S; 2],
    /// The jump of `v_tt` along with it, `[p′]/2` on the way up: all that a release from zero stress leaves.
    pub kink: S,
}

impl<S: Scalar> Ray<S> {
    /// `([v_x], [v_t])` on the way up as a plane vector. **Accuracy**: rounded to doubles.
    pub fn up_vector(&self) -> DVec2 {
        DVec2::new(self.up[0].to_f64(), self.up[1].to_f64())
    }

    /// `([v_x], [v_t])` on the way down as a plane vector. **Accuracy**: rounded to doubles.
    pub fn down_vector(&self) -> DVec2 {
        DVec2::new(self.down[0].to_f64(), self.down[1].to_f64())
    }
}

/// What an end does to the jump `([v_x], [v_t])` of a ray that it reflects: an end that is held (a fixed top, the ground in
/// contact) turns `[v_t]` round, a free one `[v_x]`.
///
/// ```
/// use glam::DVec2;
/// assert_eq!(dalembert::lattice::reflection(true) * DVec2::new(0.5, 1.0), DVec2::new(0.5, -1.0));
/// ```
pub fn reflection(held: bool) -> DMat2 {
    DMat2::from_diagonal(if held { DVec2::new(1.0, -1.0) } else { DVec2::new(-1.0, 1.0) })
}

/// The rays of an undamped history.
pub trait Rays<S> {
    /// The rays that leave the ground in round trip `trip` (0 is the first), in order, jumps and mere kinks.
    fn rays(&self, trip: usize) -> Vec<Ray<S>>;
}

impl<N: Bounded> Rays<N> for Undamped<N> {
    fn rays(&self, trip: usize) -> Vec<Ray<N>> {
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
