//! The rays of the lattice and the jumps that they carry.

use glam::{DMat2, DVec2};

use super::solution::Undamped;
use crate::number::Scalar;
use crate::rod::Top;

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

impl<S: Scalar> Rays<S> for Undamped<S> {
    fn rays(&self, trip: usize) -> Vec<Ray<S>> {
        let trace = &self.marched().trace;
        if trip >= trace.trips() {
            return Vec::new();
        }
        let units = self.units();
        let mut rays = Vec::new();
        for piece in trace.slice(trip + 1) {
            let [before, after] = [true, false].map(|before| trace.value(trip + 1, &piece.fraction, before));
            let (_, earlier) = trace.find(trip + 1, &piece.fraction, true);
            let jump = after - before;
            let kink = piece.slope.clone() - &earlier.slope;
            if jump.is_zero() && kink.is_zero() {
                continue;
            }
            let half = jump * &units.velocity / units.length.int(2);
            let strain = half.clone() / &units.wave_speed;
            let from = (units.length.int(trip as i64) + &piece.fraction) * &units.round_trip;
            let up = [-strain.clone(), half.clone()];
            let down = match self.top() {
                Top::Free => [strain, half],
                Top::Fixed => [-strain, -half],
            };
            let kink = kink * &units.velocity / &units.round_trip / units.length.int(2);
            rays.push(Ray { to: from.clone() + &units.round_trip, from, up, down, kink });
        }
        rays
    }
}
