//! The rod, the ground and the start: what is solved, in exact numbers.

use super::in_chain::InChain;
use super::{Builder, Parameter, ProblemError};
use crate::number::{Number, Rational};

/// The initial-boundary-value problem: `v_tt + 2r v_t − c² v_xx = −g` on `0 < x < L`, unilateral contact at `x = 0`.
///
/// It is made by [`Problem::builder`] or read from a [scene](crate::Scene); both end in the same checks.
///
/// **Source**: paper (1.2)–(1.8), extended by a fixed top and a piecewise-linear start.
///
/// **Units**: any consistent units.
///
/// ```
/// use dalembert::Problem;
/// let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).build()?;
/// // μ = 3 is 3/2 of the critical speed g t₁ = 2.
/// assert_eq!(rod.dimensionless().speed_ratio, Some(1.5));
/// let error = rod.to_builder().length(-1).build().unwrap_err();
/// assert_eq!(error.to_string(), "found length = -1, expected a length above zero");
/// # Ok::<(), dalembert::problem::ProblemError>(())
/// ```
///
/// # Limits
/// So that no intermediate result overflows or underflows in double precision:
///
/// | quantity | range |
/// |---|---|
/// | every quantity with a unit, `t₁ = 2L/c`, `μ` and `g t₁` among them | 0 where that makes sense, or 1e-40 … 1e40 |
/// | `R = r t₁` | 0, or 1e-305 … 1e6 |
/// | `M = μ/(g t₁)` | 1e-12 … 1e12, or no gravity |
/// | time of the run | at most 1e12 `t₁` |
/// | fall of a free rod that starts above the ground | at most 1e6 `t₁` |
/// | impacts | 1 … 10 000 000 |
/// | points of a profile | 2 … 100 000, at least 1e-12 L apart |
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    pub(super) length: Number,
    pub(super) material: Material,
    pub(super) damping: Option<Number>,
    pub(super) top: Top,
    pub(super) gravity: Option<Number>,
    pub(super) start: Start,
    pub(super) run: Run,
    /// The chain that the body is part of; `None` for a rod by itself.
    pub(crate) in_chain: Option<InChain>,
}

/// The material, which sets the wave speed `c`.
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
        /// Cross-section `S > 0`; without it forces, impulses and energies are those of a unit of it.
        area: Option<Number>,
    },
}

/// The end `x = L`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Top {
    /// `v_x(L,t) = 0`.
    #[default]
    Free,
    /// `v(L,t) = v(L,0)`.
    Fixed,
}

/// Displacement and velocity at `t = 0`.
#[derive(Clone, Debug, PartialEq)]
pub enum Start {
    /// Undeformed on the ground, with uniform velocity `−μ`: (1.7), (1.8).
    Uniform(Speed),
    /// Undeformed with its lower end above the ground, with a uniform velocity downwards.
    Above {
        /// `v(x,0) > 0`: how far the lower end is above the ground.
        gap: Number,
        /// `−v_t(x,0) ≥ 0`; zero only under gravity.
        speed: Number,
    },
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
/// An empty list means zero. Strain and velocity may jump: the same `x` twice. Of displacement and strain one at most
/// is given; with a strain the lower end touches the ground.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Profile {
    /// Pairs `(x, v)`.
    pub displacement: Vec<(Number, Number)>,
    /// Pairs `(x, v_x)`.
    pub strain: Vec<(Number, Number)>,
    /// Pairs `(x, v_t)`.
    pub velocity: Vec<(Number, Number)>,
}

impl Profile {
    /// Returns whether the means of displacement and velocity over the rod are zero, which fractions decide.
    pub(crate) fn has_zero_means(&self) -> [bool; 2] {
        let exact = |(x, value): &(Number, Number)| [x.to_rational(), value.to_rational()];
        let area = |points: &[(Number, Number)]| {
            let twice = |pair: &[(Number, Number)]| {
                let [[from, low], [to, high]] = [exact(&pair[0]), exact(&pair[1])];
                (to - from) * (low + high)
            };
            points.windows(2).map(twice).fold(Rational::from(0), |sum, part| sum + part)
        };
        // The strain s displaces all that lies above: `∫ (L − x) s dx`.
        let length = self.strain.last().map_or_else(|| Rational::from(0), |(x, _)| x.to_rational());
        let lift = |pair: &[(Number, Number)]| {
            let [[from, low], [to, high]] = [exact(&pair[0]), exact(&pair[1])];
            let width = to - &from;
            let (three, twice) = (Rational::from(3), high.clone() + &high);
            ((length.clone() - from) * (low.clone() + high) * three - width.clone() * (low + twice)) * width
        };
        let lifted = self.strain.windows(2).map(lift).fold(Rational::from(0), |sum, part| sum + part);
        [lifted.is_zero() && area(&self.displacement).is_zero(), area(&self.velocity).is_zero()]
    }
}

/// The end of the run.
#[derive(Clone, Debug, PartialEq)]
pub enum Run {
    /// This many contacts, each with the flight after it. The default is one.
    Impacts(u32),
    /// Up to this time, which is included.
    Time(Number),
}

impl Problem {
    /// The paper's problem without any check: a rod that hits the ground undeformed, with uniform velocity `−μ`,
    /// followed through the first contact and the flight after it.
    #[doc(hidden)]
    pub fn uniform(length: Number, wave_speed: Number, gravity: Number, speed: Number) -> Self {
        Problem {
            length,
            material: Material::WaveSpeed(wave_speed),
            damping: None,
            top: Top::Free,
            gravity: Some(gravity).filter(|g| !g.is_zero()),
            start: Start::Uniform(Speed::Given(speed)),
            run: Run::Impacts(1),
            in_chain: None,
        }
    }

    /// A problem to be put together value by value.
    ///
    /// ```
    /// use dalembert::Problem;
    /// let rod = Problem::builder().length(1).wave_speed(1).gravity("9.81").impact_speed(3).build()?;
    /// assert!(rod.damping().is_none() && rod.has_closed_form());
    /// # Ok::<(), dalembert::problem::ProblemError>(())
    /// ```
    pub fn builder() -> Builder {
        Builder::default()
    }

    /// A builder with the values of this problem. What is set replaces them: a `time` the number of impacts, a
    /// `displacement` the impact.
    ///
    /// ```
    /// use dalembert::Problem;
    /// let rod = Problem::builder().length(1).wave_speed(1).impact_speed(3).build()?;
    /// let damped = rod.to_builder().damping(0.1).time(40).build()?;
    /// assert_eq!(damped.dimensionless().damping_ratio, 0.2);
    /// assert_eq!(damped.to_builder().damping(0).impacts(1).build()?, rod);
    /// # Ok::<(), dalembert::problem::ProblemError>(())
    /// ```
    pub fn to_builder(&self) -> Builder {
        Builder::from_problem(self)
    }

    /// The same problem followed through `run`.
    ///
    /// **Errors**: [`ProblemError`] for a run outside of its [limits](crate::Problem#limits).
    ///
    /// ```
    /// use dalembert::{Problem, Run};
    /// let rod = Problem::builder().length(1).wave_speed(1).impact_speed(3).build()?;
    /// assert_eq!(*rod.with_run(Run::Impacts(3))?.run(), Run::Impacts(3));
    /// assert!(rod.with_run(Run::Impacts(0)).is_err());
    /// # Ok::<(), dalembert::problem::ProblemError>(())
    /// ```
    pub fn with_run(&self, run: Run) -> Result<Self, ProblemError> {
        self.to_builder().run(run).build()
    }

    /// The same problem followed through a part of its run.
    pub(crate) fn shortened(&self, run: Run) -> Self {
        Problem { run, ..self.clone() }
    }

    /// Returns `L > 0`.
    pub fn length(&self) -> &Number {
        &self.length
    }

    /// Returns the material.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// Returns `r > 0`; `None` where the rod is undamped.
    pub fn damping(&self) -> Option<&Number> {
        self.damping.as_ref()
    }

    /// Returns the end `x = L`.
    pub fn top(&self) -> Top {
        self.top
    }

    /// Returns `g > 0`; `None` where there is no gravity.
    pub fn gravity(&self) -> Option<&Number> {
        self.gravity.as_ref()
    }

    /// Returns displacement and velocity at `t = 0`.
    pub fn start(&self) -> &Start {
        &self.start
    }

    /// Returns the end of the run.
    pub fn run(&self) -> &Run {
        &self.run
    }

    /// Returns the height of the undeformed rod above the ground at the start; `None` where it starts on it, or by a
    /// profile.
    ///
    /// ```
    /// use dalembert::Problem;
    /// let rod = Problem::builder().length(1).wave_speed(1).impact_speed(2).gap("0.5").build()?;
    /// assert_eq!(rod.gap().map(|gap| gap.to_f64()), Some(0.5));
    /// assert_eq!(rod.to_builder().gap(0).build()?.gap(), None);
    /// # Ok::<(), dalembert::problem::ProblemError>(())
    /// ```
    pub fn gap(&self) -> Option<&Number> {
        match &self.start {
            Start::Above { gap, .. } => Some(gap),
            Start::Uniform(_) | Start::Profile(_) => None,
        }
    }

    /// Whether the start is uniform and the top free, as in the paper: then the first contact has a closed form.
    ///
    /// **Source**: (1.3), (1.7), (1.8).
    pub fn has_closed_form(&self) -> bool {
        self.top == Top::Free && matches!(self.start, Start::Uniform(_))
    }
}

/// The number that `$problem`, a reference or a mutable one, gives for `$parameter`: a reference of the same kind.
macro_rules! number_of {
    ($problem:expr, $parameter:expr) => {{
        let Problem { length, material, damping, top: _, gravity, start, run, in_chain } = $problem;
        match ($parameter, material, start, run) {
            (Parameter::Length, ..) => Some(length),
            (Parameter::Damping, ..) => damping.into(),
            (Parameter::Gravity, ..) => gravity.into(),
            (Parameter::Stiffness, ..) => match in_chain {
                Some(InChain { stiffness, .. }) => stiffness.into(),
                None => None,
            },
            (Parameter::Area, Material::Elastic { area, .. }, ..) => area.into(),
            (Parameter::WaveSpeed, Material::WaveSpeed(number), ..)
            | (Parameter::Modulus, Material::Elastic { modulus: number, .. }, ..)
            | (Parameter::Density, Material::Elastic { density: number, .. }, ..)
            | (Parameter::ImpactSpeed, _, Start::Uniform(Speed::Given(number)), _)
            | (Parameter::ImpactSpeed, _, Start::Above { speed: number, .. }, _)
            | (Parameter::DropHeight, _, Start::Uniform(Speed::DropHeight(number)), _)
            | (Parameter::Gap, _, Start::Above { gap: number, .. }, _)
            | (Parameter::Time, .., Run::Time(number)) => Some(number),
            _ => None,
        }
    }};
}

impl Parameter {
    /// Returns the number that `problem` gives for this parameter; `None` where it gives none.
    ///
    /// ```
    /// use dalembert::{Parameter, Problem};
    /// let rod = Problem::builder().length(2).wave_speed(1).impact_speed("1/3").build()?;
    /// assert_eq!(Parameter::ImpactSpeed.given(&rod).map(|speed| speed.to_string()).as_deref(), Some("1/3"));
    /// assert_eq!(Parameter::Modulus.given(&rod), None);
    /// # Ok::<(), dalembert::problem::ProblemError>(())
    /// ```
    pub fn given(self, problem: &Problem) -> Option<Number> {
        match (self, &problem.run) {
            (Parameter::Impacts, Run::Impacts(impacts)) => Some(i64::from(*impacts).into()),
            _ => number_of!(problem, self).cloned(),
        }
    }

    /// Returns the number that `problem` gives for this parameter, to be replaced.
    pub(super) fn given_mut(self, problem: &mut Problem) -> Option<&mut Number> {
        number_of!(problem, self)
    }
}
