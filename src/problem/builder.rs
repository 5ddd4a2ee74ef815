//! A problem put together value by value.

use super::profile::Points;
use super::validate::Draft;
use super::{Material, Problem, ProblemError, Run, Speed, Start, Top, Written};
use crate::number::Number;

/// A problem put together value by value: see [`Problem::builder`]. A number is given as [`Written`] says; nothing is
/// checked before [`build`](Builder::build).
///
/// **Units**: any consistent units.
#[derive(Clone, Debug, Default)]
pub struct Builder {
    draft: Draft,
    /// What holds where nothing is set.
    base: Option<Problem>,
}

/// The setters of single numbers.
macro_rules! setters {
    ($($(#[$doc:meta])* $setter:ident => $field:ident),* $(,)?) => {$(
        $(#[$doc])*
        #[must_use]
        pub fn $setter(mut self, value: impl Into<Written>) -> Self {
            self.draft.$field = Some(value.into());
            self
        }
    )*};
}

impl Builder {
    setters! {
        /// `L > 0`: the length.
        length => length,
        /// `c > 0`: the wave speed. Either this or the [`material`](Builder::material).
        wave_speed => wave_speed,
        /// `r ≥ 0`: the damping; without it none.
        damping => damping,
        /// `g ≥ 0`: the acceleration of gravity; without it none.
        gravity => gravity,
        /// `μ > 0`: the speed with which the undeformed rod hits the ground.
        impact_speed => speed,
        /// `h > 0`: a fall from rest through this height, without air drag or damping: `μ = √(2 g h)`.
        drop_height => drop_height,
        /// The time up to which to follow the motion, which is included.
        time => time,
    }

    /// Young's modulus `E`, density `ρ` and cross-section `S`, all above zero: `c = √(E/ρ)`.
    #[must_use]
    pub fn material(
        mut self,
        modulus: impl Into<Written>,
        density: impl Into<Written>,
        area: impl Into<Written>,
    ) -> Self {
        self.draft.modulus = Some(modulus.into());
        self.draft.density = Some(density.into());
        self.draft.area = Some(area.into());
        self
    }

    /// What holds the end `x = L`; without it nothing.
    #[must_use]
    pub fn top(mut self, top: Top) -> Self {
        self.draft.top = Some(top);
        self
    }

    /// A top that does not move: `v(L,t) = v(L,0)`.
    #[must_use]
    pub fn fixed_top(self) -> Self {
        self.top(Top::Fixed)
    }

    /// The displacement at `t = 0` as points `(x, v)` from `x = 0` to `x = L`, linear between them; in place of an impact.
    ///
    /// ```
    /// use dalembert::Problem;
    /// let rod = Problem::builder().length(1).wave_speed(1).fixed_top();
    /// let compressed = rod.displacement([(0, "1/2"), (1, "0")]).build()?;
    /// assert_eq!(compressed.dimensionless().speed_ratio, None);
    /// # Ok::<(), dalembert::problem::ProblemError>(())
    /// ```
    #[must_use]
    pub fn displacement<X: Into<Written>, V: Into<Written>>(
        mut self,
        points: impl IntoIterator<Item = (X, V)>,
    ) -> Self {
        self.draft.displacement = Some(written(points));
        self
    }

    /// The velocity at `t = 0` as points `(x, v_t)`, like the [`displacement`](Builder::displacement). It may jump: the
    /// same `x` twice.
    #[must_use]
    pub fn velocity<X: Into<Written>, V: Into<Written>>(mut self, points: impl IntoIterator<Item = (X, V)>) -> Self {
        self.draft.velocity = Some(written(points));
        self
    }

    /// How many contacts to follow, each with the flight after it; without it and without a `time`, one.
    #[must_use]
    pub fn impacts(mut self, impacts: u32) -> Self {
        self.draft.impacts = Some(impacts.into());
        self
    }

    /// The problem.
    ///
    /// **Errors**: [`ProblemError`] for the first value that is missing, is no number, or is outside of its
    /// [limits](crate::problem#limits) alone or together with others.
    ///
    /// ```
    /// use dalembert::Problem;
    /// let rod = Problem::builder().length(1).wave_speed(1).impact_speed(3).drop_height(2);
    /// let expected = "found drop_height as well as impact_speed, expected either impact_speed or drop_height";
    /// assert_eq!(rod.build().unwrap_err().to_string(), expected);
    /// ```
    pub fn build(self) -> Result<Problem, ProblemError> {
        match &self.base {
            Some(base) => over(self.draft, base).check(),
            None => self.draft.check(),
        }
    }

    pub(super) fn from_problem(problem: Problem) -> Self {
        Builder { draft: Draft::default(), base: Some(problem) }
    }
}

/// The values of `draft` and, where it has none, those of `base`. Values that exclude each other are replaced together.
fn over(mut draft: Draft, base: &Problem) -> Draft {
    fn fill<'a>(field: &mut Option<Written>, number: impl Into<Option<&'a Number>>) {
        if field.is_none() {
            *field = number.into().map(Written::from);
        }
    }
    let points =
        |points: &[(Number, Number)]| (!points.is_empty()).then(|| written(points.iter().map(|(x, v)| (x, v))));
    fill(&mut draft.length, &base.rod.length);
    fill(&mut draft.damping, base.rod.damping.as_ref());
    fill(&mut draft.gravity, base.gravity.as_ref());
    draft.top = draft.top.or(Some(base.rod.top));
    match &base.rod.material {
        Material::WaveSpeed(c) if draft.modulus.is_none() => fill(&mut draft.wave_speed, c),
        Material::Elastic { modulus, density, area } if draft.wave_speed.is_none() => {
            fill(&mut draft.modulus, modulus);
            fill(&mut draft.density, density);
            fill(&mut draft.area, area);
        }
        _ => {}
    }
    let impact = draft.speed.is_some() || draft.drop_height.is_some();
    match &base.start {
        _ if impact => {}
        Start::Uniform(_) if draft.displacement.is_some() || draft.velocity.is_some() => {}
        Start::Uniform(Speed::Given(speed)) => fill(&mut draft.speed, speed),
        Start::Uniform(Speed::DropHeight(height)) => fill(&mut draft.drop_height, height),
        Start::Profile(profile) => {
            draft.displacement = draft.displacement.or_else(|| points(&profile.displacement));
            draft.velocity = draft.velocity.or_else(|| points(&profile.velocity));
        }
    }
    match &base.run {
        Run::Time(time) if draft.impacts.is_none() => fill(&mut draft.time, time),
        Run::Impacts(impacts) if draft.time.is_none() => {
            draft.impacts = draft.impacts.or_else(|| Some((*impacts).into()));
        }
        _ => {}
    }
    draft
}

fn written<X: Into<Written>, V: Into<Written>>(points: impl IntoIterator<Item = (X, V)>) -> Points {
    points.into_iter().map(|(x, v)| (x.into(), v.into())).collect()
}
