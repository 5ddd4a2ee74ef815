//! The field along the rod; an undamped motion as two travelling waves; rays.

use glam::{DMat2, DVec2};

use super::maps::maps;
use crate::number::Scalar;
use crate::problem::Top;

/// The displacement and its derivatives at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Field<S> {
    /// `v`.
    pub displacement: S,
    /// `v_t`.
    pub velocity: S,
    /// `v_x`.
    pub strain: S,
}

maps!(pub Field { displacement, velocity, strain });

impl<S> Field<S> {
    /// Returns displacement, velocity and strain.
    pub fn numbers(&self) -> [&S; 3] {
        [&self.displacement, &self.velocity, &self.strain]
    }
}

/// The exact solution of an undamped rod:
/// `v(x,t) = (P(t − x/c) ± P(t + x/c − t₁))/2 + a + b x + d x²`, with `+` under a free top and `−` under a fixed one,
/// and a piecewise quadratic, continuous function `P` on `−t₁ … end`.
///
/// **Source**: d'Alembert. `P′` is the upward invariant `v_t − c v_x` that leaves the ground, less `g t₁/2` under a
/// free top; the polynomial in `x` solves `c² v_xx = g`.
///
/// **Accuracy**: *exact* in fractions; otherwise that of the numbers in it.
///
/// ```
/// use dalembert::Problem;
/// let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).build()?;
/// let waves = rod.doubles()?.waves()?;
/// // Behind the wave of the impact v_x = −(μ + g(t − x))/c.
/// assert_eq!(waves.at(&0.25, &0.5).strain, -3.25);
/// # Ok::<(), dalembert::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Waves<S> {
    /// `P`, in the order of time.
    pub pieces: Vec<WavePiece<S>>,
    /// `a`.
    pub constant: S,
    /// `b`.
    pub linear: S,
    /// `d`.
    pub quadratic: S,
    /// The boundary condition at `x = L`.
    pub top: Top,
    /// `t₁`.
    pub round_trip: S,
    /// `c`.
    pub wave_speed: S,
    /// `L`.
    pub length: S,
}

/// A stretch of an undamped rod at one time, without a ray inside: velocity and strain are linear along it.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretch<S> {
    /// `x` at its lower end.
    pub from: S,
    /// Its width.
    pub width: S,
    /// `v` at its lower end.
    pub displacement: S,
    /// `v_t` at its lower end, and `v_tx`.
    pub velocity: [S; 2],
    /// `v_x` at its lower end, and `v_xx`.
    pub strain: [S; 2],
}

maps!(pub Stretch { from, width, displacement } maps velocity, strain);

impl<S: Scalar> Stretch<S> {
    /// Returns `v` at the distance `way` above the lower end.
    pub(crate) fn displacement_after(&self, way: &S) -> S {
        let [strain, bend] = &self.strain;
        (bend.clone() * way / way.int(2) + strain) * way + &self.displacement
    }

    /// Returns the rest of the stretch above its first `way`.
    pub(crate) fn after(&self, way: &S) -> Self {
        let along = |[value, slope]: &[S; 2]| [slope.clone() * way + value, slope.clone()];
        Stretch {
            from: self.from.clone() + way,
            width: self.width.clone() - way,
            displacement: self.displacement_after(way),
            velocity: along(&self.velocity),
            strain: along(&self.strain),
        }
    }

    /// Returns `∫ f dx` and `∫ f (x − from) dx` over the first `way` of the stretch, for `f` = `v`, `v_t`, `v_x`.
    pub(crate) fn moments(&self, way: &S) -> [[S; 2]; 3] {
        let square = way.square();
        let linear = |[value, slope]: &[S; 2]| {
            let rise = slope.clone() * way;
            [(rise.clone() / way.int(2) + value) * way, (rise / way.int(3) + &(value.clone() / way.int(2))) * &square]
        };
        let [strain, bend] = &self.strain;
        let (rise, sag) = (strain.clone() * way, bend.clone() * &square);
        let displacement = [
            (rise.clone() / way.int(2) + &(sag.clone() / way.int(6)) + &self.displacement) * way,
            (rise / way.int(3) + &(sag / way.int(8)) + &(self.displacement.clone() / way.int(2))) * &square,
        ];
        [displacement, linear(&self.velocity), linear(&self.strain)]
    }
}

/// A piece of `P`: `sum + rate·τ + slope·τ²/2` for `τ = s − from ≥ 0`.
#[derive(Clone, Debug, PartialEq)]
pub struct WavePiece<S> {
    /// The argument of `P` at which it begins.
    pub from: S,
    /// `P`.
    pub sum: S,
    /// `P′`.
    pub rate: S,
    /// `P″`.
    pub slope: S,
}

maps!(pub WavePiece { from, sum, rate, slope });

impl<S: Scalar> WavePiece<S> {
    /// Returns `P` and `P′` at `s`.
    pub fn at(&self, s: &S) -> (S, S) {
        let passed = s.clone() - &self.from;
        let gained = self.slope.clone() * &passed;
        let mean = gained.clone() / passed.int(2) + &self.rate;
        (mean * &passed + &self.sum, gained + &self.rate)
    }
}

impl<S: Scalar> Waves<S> {
    /// Returns `v`, `v_t`, `v_x` at `(x,t)`; on a ray, the limit from later times.
    pub fn at(&self, x: &S, t: &S) -> Field<S> {
        let late = x.clone() / &self.wave_speed;
        let up = self.wave(&(t.clone() - &late));
        let down = self.wave(&(t.clone() + &late - &self.round_trip));
        let down = match self.top {
            Top::Free => down,
            Top::Fixed => (-down.0, -down.1),
        };
        let two = x.int(2);
        let bend = self.quadratic.clone() * x;
        Field {
            displacement: (up.0 + down.0) / &two + (bend.clone() + &self.linear) * x + &self.constant,
            velocity: (up.1.clone() + &down.1) / &two,
            strain: (down.1 - up.1) / &(two.clone() * &self.wave_speed) + bend * two + &self.linear,
        }
    }

    /// Returns `P` and `P′`. An undecided comparison puts `s` before the break; `P` is continuous there.
    fn wave(&self, s: &S) -> (S, S) {
        let begun = self.pieces.partition_point(|piece| s.below(&piece.from) == Ok(false));
        self.pieces[begun.max(1) - 1].at(s)
    }
}

maps!(pub Waves { constant, linear, quadratic, round_trip, wave_speed, length } lists pieces keeps top);

impl<S> Waves<S> {
    /// Returns all numbers of both waves.
    pub fn numbers(&self) -> Vec<&S> {
        let pieces = self.pieces.iter().flat_map(|piece| [&piece.from, &piece.sum, &piece.rate, &piece.slope]);
        [&self.constant, &self.linear, &self.quadratic].into_iter().chain(pieces).collect()
    }
}

/// A ray `ct = ±(x − 2kL)` of the lattice over one round trip: up from the ground, back from the top.
///
/// **Source**: Proposition 2. Across a ray going up `[v_x] = −[p]/2c`, `[v_t] = [p]/2`; across one coming down
/// `[v_x] = [q]/2c`, `[v_t] = [q]/2`, the jump being taken in the direction of time at a fixed point.
#[derive(Clone, Debug, PartialEq)]
pub struct Ray<S> {
    /// Time at which it leaves the ground.
    pub from: S,
    /// Time at which it returns.
    pub to: S,
    /// `([v_x], [v_t])` on the way up.
    pub up: [S; 2],
    /// `([v_x], [v_t])` on the way down.
    pub down: [S; 2],
    /// Jump of `v_tt` along the ray, `[p′]/2` on the way up. A release from zero stress leaves only this.
    pub kink: S,
}

maps!(pub Ray { from, to, kink } maps up, down);

impl<S: Scalar> Ray<S> {
    /// Returns `([v_x], [v_t])` on the way up as a plane vector. **Accuracy**: rounded to doubles.
    pub fn up_vector(&self) -> DVec2 {
        DVec2::new(self.up[0].to_f64(), self.up[1].to_f64())
    }

    /// Returns `([v_x], [v_t])` on the way down as a plane vector. **Accuracy**: rounded to doubles.
    pub fn down_vector(&self) -> DVec2 {
        DVec2::new(self.down[0].to_f64(), self.down[1].to_f64())
    }
}

/// Returns the reflection of the jump `([v_x], [v_t])` of a ray at an end: a held end (a fixed top, the ground in
/// contact) reverses `[v_t]`, a free end reverses `[v_x]`.
///
/// ```
/// use glam::DVec2;
/// assert_eq!(dalembert::engine::reflection(true) * DVec2::new(0.5, 1.0), DVec2::new(0.5, -1.0));
/// ```
pub fn reflection(held: bool) -> DMat2 {
    DMat2::from_diagonal(if held { DVec2::new(1.0, -1.0) } else { DVec2::new(-1.0, 1.0) })
}
