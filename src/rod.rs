//! The rod, the ground and the start: what is solved, in exact numbers, and the parameters that follow from it.

use crate::error::Error;
use crate::number::{Answer, Number, Scalar};

/// The initial-boundary-value problem: `v_tt + 2r v_t − c² v_xx = −g` on `0 < x < L`, unilateral contact at `x = 0`.
///
/// **Source**: paper (1.2)–(1.8), extended by a fixed top and a piecewise-linear start.
///
/// **Units**: any consistent units.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// The rod.
    pub rod: Rod,
    /// `g ≥ 0`; `None` where the scene has no gravity.
    pub gravity: Option<Number>,
    /// Displacement and velocity at `t = 0`.
    pub start: Start,
    /// How far to follow the motion.
    pub run: Run,
}

/// The rod: geometry, material, damping and what holds its top.
#[derive(Clone, Debug, PartialEq)]
pub struct Rod {
    /// `L > 0`.
    pub length: Number,
    /// What sets the wave speed.
    pub material: Material,
    /// `r ≥ 0`; `None` where the scene has no damping.
    pub damping: Option<Number>,
    /// The end `x = L`.
    pub top: Top,
}

/// What sets the wave speed `c`.
#[derive(Clone, Debug, PartialEq)]
pub enum Material {
    /// `c > 0` itself.
    WaveSpeed(Number),
    /// `c = √(modulus/density)`; forces and energies can then be given in SI.
    Elastic {
        /// Young's modulus `E > 0`.
        modulus: Number,
        /// Density `ρ > 0`.
        density: Number,
        /// Cross-section `S > 0`.
        area: Number,
    },
}

/// The end `x = L`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Top {
    /// `v_x(L,t) = 0`.
    Free,
    /// `v(L,t) = v(L,0)`.
    Fixed,
}

/// Displacement and velocity at `t = 0`.
#[derive(Clone, Debug, PartialEq)]
pub enum Start {
    /// Undeformed on the ground, with uniform velocity `−μ`: (1.7), (1.8).
    Uniform(Speed),
    /// Piecewise linear along the rod.
    Profile(Profile),
}

/// The impact speed `μ > 0`.
#[derive(Clone, Debug, PartialEq)]
pub enum Speed {
    /// `μ` itself.
    Given(Number),
    /// `μ = √(2 g h)` after a fall from rest through the height `h`, without air drag.
    DropHeight(Number),
}

/// A start that is not uniform: values at points `x` in increasing order from `0` to `L`, linear between them.
/// An empty list means zero. The velocity may jump: the same `x` twice.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Profile {
    /// Pairs `(x, v)`.
    pub displacement: Vec<(Number, Number)>,
    /// Pairs `(x, v_t)`.
    pub velocity: Vec<(Number, Number)>,
}

/// How far to follow the motion.
#[derive(Clone, Debug, PartialEq)]
pub enum Run {
    /// This many contacts, each with the flight after it. The default is one.
    Impacts(u32),
    /// Up to this time, which is included.
    Time(Number),
}

impl Problem {
    /// The paper's problem: a rod that hits the ground undeformed, with uniform velocity `−μ`, followed through the
    /// first contact and the flight after it.
    ///
    /// ```
    /// use dalembert::{Number, Problem};
    /// let problem = Problem::uniform(Number::from(1), Number::from(1), Number::from(1), Number::from(3));
    /// assert!(problem.rod.damping.is_none());
    /// ```
    pub fn uniform(length: Number, wave_speed: Number, gravity: Number, speed: Number) -> Self {
        Problem {
            rod: Rod { length, material: Material::WaveSpeed(wave_speed), damping: None, top: Top::Free },
            gravity: Some(gravity).filter(|g| !g.is_zero()),
            start: Start::Uniform(Speed::Given(speed)),
            run: Run::Impacts(1),
        }
    }
}

impl Problem {
    /// Whether the start is uniform and the top free, as in the paper: then the first contact has a closed form.
    ///
    /// **Source**: (1.3), (1.7), (1.8).
    pub fn has_closed_form(&self) -> bool {
        self.rod.top == Top::Free && matches!(self.start, Start::Uniform(_))
    }
}

/// The parameters of a problem in one number system.
#[derive(Clone, Debug)]
pub struct Parameters<S> {
    /// `L`.
    pub length: S,
    /// `c`.
    pub wave_speed: S,
    /// `r`.
    pub damping: S,
    /// `g`.
    pub gravity: S,
    /// `μ`, zero where the start is not uniform.
    pub speed: S,
}

impl<S: Scalar> Parameters<S> {
    /// The parameters of `problem`.
    ///
    /// **Accuracy**: *exact* in fractions; one rounding for each value given and one for each operation otherwise.
    ///
    /// **Errors**: [`Error::Irrational`] where a fraction would need the square root of a number that is no square.
    pub fn of(problem: &Problem, precision: &S::Precision) -> Result<Self, Error> {
        let lift = |n: &Number| S::from_number(n, precision);
        let root = |quantity: &'static str, square: S| match square.try_sqrt() {
            Some(root) => Ok(root),
            None => Err(Error::Irrational { quantity, square: square.text() }),
        };
        let length = lift(&problem.rod.length);
        let or_zero = |n: &Option<Number>| n.as_ref().map_or_else(|| length.zero(), lift);
        let gravity = or_zero(&problem.gravity);
        let wave_speed = match &problem.rod.material {
            Material::WaveSpeed(c) => lift(c),
            Material::Elastic { modulus, density, .. } => root("wave speed", lift(modulus) / lift(density))?,
        };
        let speed = match &problem.start {
            Start::Uniform(Speed::Given(speed)) => lift(speed),
            Start::Uniform(Speed::DropHeight(h)) => root("impact speed", gravity.int(2) * &gravity * lift(h))?,
            Start::Profile(_) => length.zero(),
        };
        Ok(Parameters { damping: or_zero(&problem.rod.damping), length, wave_speed, gravity, speed })
    }

    /// `t₁ = 2L/c`: the round trip.
    ///
    /// ```
    /// # use dalembert::{Number, Problem, rod::Parameters};
    /// let rod = Problem::uniform(Number::from(10), Number::from(30), Number::from(10), Number::from(10));
    /// let parameters = Parameters::<f64>::of(&rod, &())?;
    /// assert_eq!(parameters.round_trip(), 2.0 / 3.0);
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn round_trip(&self) -> S {
        self.length.int(2) * &self.length / &self.wave_speed
    }

    /// `μ₀ = g t₁`: the speed that gravity gives in a round trip. At `μ ≥ μ₀` an undamped first contact lasts exactly `t₁`.
    pub fn critical_speed(&self) -> S {
        self.round_trip() * &self.gravity
    }
}

impl<S: Answer> Parameters<S> {
    /// The same parameters, taken for exact, in the numbers that computations carry.
    ///
    /// ```
    /// # use dalembert::rod::Parameters;
    /// let rod = Parameters { length: 1.0, wave_speed: 1.0, damping: 0.1, gravity: 1.0, speed: 3.0 };
    /// assert_eq!(rod.carry().damping.error(), 0.0);
    /// ```
    pub fn carry(&self) -> Parameters<S::Carried> {
        Parameters {
            length: self.length.carry(),
            wave_speed: self.wave_speed.carry(),
            damping: self.damping.carry(),
            gravity: self.gravity.carry(),
            speed: self.speed.carry(),
        }
    }
}
