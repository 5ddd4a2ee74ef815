//! Rays, and the jumps that they carry.

use glam::{DMat2, DVec2};

use crate::number::Scalar;

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

impl<S> Ray<S> {
    /// The same ray in other numbers.
    pub fn map<T>(self, f: impl Fn(S) -> T) -> Ray<T> {
        Ray { from: f(self.from), to: f(self.to), up: self.up.map(&f), down: self.down.map(&f), kink: f(self.kink) }
    }
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

/// What an end does to the jump `([v_x], [v_t])` of a ray that it reflects: an end that is held (a fixed top, the
/// ground in contact) turns `[v_t]` round, a free one `[v_x]`.
///
/// ```
/// use glam::DVec2;
/// assert_eq!(dalembert::engine::reflection(true) * DVec2::new(0.5, 1.0), DVec2::new(0.5, -1.0));
/// ```
pub fn reflection(held: bool) -> DMat2 {
    DMat2::from_diagonal(if held { DVec2::new(1.0, -1.0) } else { DVec2::new(-1.0, 1.0) })
}
