//! The parameters of a problem in one number system, and the two numbers that decide its motion up to units.

use serde::Serialize;

use super::{Material, Problem, Speed, Start, Top};
use crate::error::Error;
use crate::motion::maps;
use crate::number::{Answer, Number, Scalar};

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
    /// `μ`; where the rod starts above the ground its speed at `t = 0`, and zero where it starts by a profile.
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
        let length = lift(&problem.length);
        let or_zero = |n: &Option<Number>| n.as_ref().map_or_else(|| length.zero(), lift);
        let gravity = or_zero(&problem.gravity);
        let wave_speed = match &problem.material {
            Material::WaveSpeed(c) => lift(c),
            Material::Elastic { modulus, density, .. } => root("wave speed", lift(modulus) / lift(density))?,
        };
        let speed = match &problem.start {
            Start::Uniform(Speed::Given(speed)) | Start::Above { speed, .. } => lift(speed),
            Start::Uniform(Speed::DropHeight(h)) => root("impact speed", gravity.int(2) * &gravity * lift(h))?,
            Start::Profile(_) => length.zero(),
        };
        Ok(Parameters { damping: or_zero(&problem.damping), length, wave_speed, gravity, speed })
    }

    /// `t₁ = 2L/c`: the round trip.
    ///
    /// ```
    /// use dalembert::{Parameters, Problem};
    /// let rod = Problem::builder().length(10).wave_speed(30).gravity(10).impact_speed(10).build()?;
    /// assert_eq!(Parameters::<f64>::of(&rod, &())?.round_trip(), 2.0 / 3.0);
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn round_trip(&self) -> S {
        self.length.int(2) * &self.length / &self.wave_speed
    }

    /// `μ₀ = g t₁`: the speed that gravity gives in a round trip. At `μ ≥ μ₀` an undamped first contact lasts exactly
    /// `t₁`.
    pub fn critical_speed(&self) -> S {
        self.round_trip() * &self.gravity
    }
}

/// The numbers that decide a uniform first contact up to the units of length and time, in doubles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Dimensionless {
    /// `R = r t₁`.
    pub damping_ratio: f64,
    /// `M = μ/(g t₁)`, with the speed at the first touch: infinite without gravity, `None` where the start is not
    /// uniform, and where a rod that starts above the ground is damped or held.
    pub speed_ratio: Option<f64>,
}

impl Problem {
    /// `R = r t₁` and `M = μ/(g t₁)`, with the round trip `t₁ = 2L/c`.
    ///
    /// **Source**: paper (2.32); Corollary 1 with `M = 1` at the critical speed.
    ///
    /// **Accuracy**: within 1e-14 relative: at most twelve roundings, each within 1.5 ulp.
    ///
    /// ```
    /// use dalembert::Problem;
    /// // t₁ = 2·6/3 = 4.
    /// let rod = Problem::builder().length(6).wave_speed(3).damping("1/8").gravity(2).impact_speed(4).build()?;
    /// assert_eq!(rod.dimensionless().damping_ratio, 0.5);
    /// assert_eq!(rod.dimensionless().speed_ratio, Some(0.5));
    /// # Ok::<(), dalembert::problem::ProblemError>(())
    /// ```
    pub fn dimensionless(&self) -> Dimensionless {
        let or_zero = |n: &Option<Number>| n.as_ref().map_or(0.0, Number::to_f64);
        let (t1, g) = (self.material.round_trip(&self.length), or_zero(&self.gravity));
        let falls_freely = self.damping.is_none() && self.top == Top::Free;
        let speed = self.touch_speed(g).filter(|_| falls_freely || self.gap().is_none());
        Dimensionless { damping_ratio: or_zero(&self.damping) * t1, speed_ratio: speed.map(|mu| mu / (g * t1)) }
    }
}

maps!(pub(crate) Parameters { length, wave_speed, damping, gravity, speed });

impl<S: Answer> Parameters<S> {
    /// The same parameters, taken for exact, in the numbers that computations carry.
    ///
    /// ```
    /// # use dalembert::Parameters;
    /// let rod = Parameters { length: 1.0, wave_speed: 1.0, damping: 0.1, gravity: 1.0, speed: 3.0 };
    /// assert_eq!(rod.carry().damping.error(), 0.0);
    /// ```
    pub fn carry(&self) -> Parameters<S::Carried> {
        self.clone().map(|number| number.exactly())
    }
}

impl Material {
    /// `t₁ = 2L/c` of a rod of this length, in double precision.
    pub(super) fn round_trip(&self, length: &Number) -> f64 {
        let wave_speed = match self {
            Material::WaveSpeed(c) => c.to_f64(),
            Material::Elastic { modulus, density, .. } => (modulus.to_f64() / density.to_f64()).sqrt(),
        };
        2.0 * length.to_f64() / wave_speed
    }
}

/// `√(μ² + 2 g gap)`: the speed at the first touch of a free undamped rod, in double precision.
pub(super) fn touch_speed(gap: &Number, speed: &Number, g: f64) -> f64 {
    speed.to_f64().hypot((2.0 * g * gap.to_f64()).sqrt())
}

impl Speed {
    /// `μ` in double precision under the gravity `g`.
    pub(super) fn value(&self, g: f64) -> f64 {
        match self {
            Speed::Given(speed) => speed.to_f64(),
            Speed::DropHeight(height) => (2.0 * g * height.to_f64()).sqrt(),
        }
    }
}
