//! A problem put together value by value.

use super::profile::Points;
use super::validate::{Draft, IMPACT};
use super::{Material, Problem, ProblemError, Profile, Run, Speed, Start, Top, Written};
use crate::number::Number;

/// A problem put together value by value: see [`Problem::builder`]. A number is given as [`Written`] says; nothing is
/// checked before [`build`](Builder::build).
///
/// **Units**: any consistent units.
#[derive(Clone, Debug, Default)]
pub struct Builder {
    draft: Draft,
    /// What holds where nothing is set that excludes it.
    base: Draft,
}

/// What is set replaces what the base has of its group: in place of the wave speed it can have those of the
/// material; a gap goes with a speed, and a drop height with neither.
const EXCLUSIVE: [&[&str]; 4] = [
    &["rod.wave_speed", "rod.modulus", "rod.density", "rod.area"],
    &["impact.speed", "impact.drop_height"],
    &["impact.gap", "impact.drop_height"],
    &["run.time", "run.impacts"],
];

/// The setters of single numbers, and their names.
macro_rules! setters {
    ($($(#[$doc:meta])* $setter:ident => $path:literal),* $(,)?) => {
        /// The names of the setters, and the paths in a scene file.
        pub const NUMBERS: &[(&str, &str)] = &[$((stringify!($setter), $path)),*];
        $(
        $(#[$doc])*
        #[must_use]
        pub fn $setter(mut self, value: impl Into<Written>) -> Self {
            self.draft.numbers.insert($path, value.into());
            self
        }
    )*};
}

impl Builder {
    setters! {
        /// `L > 0`: the length.
        length => "rod.length",
        /// `c > 0`: the wave speed. Either this or the [`material`](Builder::material).
        wave_speed => "rod.wave_speed",
        /// `E > 0`: Young's modulus, with the density in place of the wave speed: `c = √(E/ρ)`.
        modulus => "rod.modulus",
        /// `ρ > 0`: the density.
        density => "rod.density",
        /// `S > 0`: the cross-section; without it forces, impulses and energies are those of a unit of it.
        area => "rod.area",
        /// `r ≥ 0`: the damping; without it none.
        damping => "rod.damping",
        /// `g ≥ 0`: the acceleration of gravity; without it none.
        gravity => "gravity.acceleration",
        /// `μ > 0`: the speed with which the undeformed rod hits the ground at `t = 0`; with a [`gap`](Builder::gap)
        /// its speed downwards at `t = 0`, which may be zero under gravity.
        impact_speed => "impact.speed",
        /// The undeformed rod starts this far above the ground, and `t = 0` is that start, not the first touch.
        gap => "impact.gap",
        /// `h > 0`: a fall from rest through this height, without air drag or damping: `μ = √(2 g h)`. The fall is over
        /// at `t = 0`, the first touch.
        drop_height => "impact.drop_height",
        /// The time up to which to follow the motion, which is included.
        time => "run.time",
        /// How many contacts to follow, each with the flight after it; without it and without a `time`, one.
        impacts => "run.impacts",
    }

    /// The names of the setters of single numbers.
    #[doc(hidden)]
    pub fn numbers() -> impl Iterator<Item = &'static str> {
        Self::NUMBERS.iter().map(|(name, _)| *name)
    }

    /// The number of this name, one of [`Builder::numbers`]; any other changes nothing.
    #[doc(hidden)]
    #[must_use]
    pub fn named(mut self, name: &str, value: impl Into<Written>) -> Self {
        if let Some((_, path)) = Self::NUMBERS.iter().find(|(known, _)| *known == name) {
            self.draft.numbers.insert(path, value.into());
        }
        self
    }

    /// Young's modulus `E`, density `ρ` and cross-section `S`, all above zero: `c = √(E/ρ)`.
    #[must_use]
    pub fn material(self, modulus: impl Into<Written>, density: impl Into<Written>, area: impl Into<Written>) -> Self {
        self.modulus(modulus).density(density).area(area)
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

    /// The displacement at `t = 0` as points `(x, v)` from `x = 0` to `x = L`, linear between them; in place of an
    /// impact.
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
        self.draft.profiles.insert("start.displacement", written(points));
        self
    }

    /// The velocity at `t = 0` as points `(x, v_t)`, like the [`displacement`](Builder::displacement). It may jump: the
    /// same `x` twice.
    #[must_use]
    pub fn velocity<X: Into<Written>, V: Into<Written>>(mut self, points: impl IntoIterator<Item = (X, V)>) -> Self {
        self.draft.profiles.insert("start.velocity", written(points));
        self
    }

    /// The value at a path of a scene file, one of [`Builder::NUMBERS`].
    pub fn at(mut self, path: &'static str, value: &Number) -> Self {
        self.draft.numbers.insert(path, value.into());
        self.base.from_scene = true;
        self
    }

    /// The problem.
    ///
    /// **Errors**: [`ProblemError`] for the first value that is missing, is no number, or is outside of its
    /// [limits](crate::Problem#limits) alone or together with others.
    ///
    /// ```
    /// use dalembert::Problem;
    /// let rod = Problem::builder().length(1).wave_speed(1).impact_speed(3).drop_height(2);
    /// let expected = "found drop_height as well as impact_speed, expected either impact_speed or drop_height";
    /// assert_eq!(rod.build().unwrap_err().to_string(), expected);
    /// ```
    pub fn build(self) -> Result<Problem, ProblemError> {
        let Builder { draft, mut base } = self;
        for group in EXCLUSIVE.iter().filter(|group| group.iter().any(|path| draft.has(path))) {
            base.numbers.retain(|path, _| !group.contains(path));
        }
        if IMPACT.iter().any(|path| draft.has(path)) {
            base.profiles.clear();
        }
        if !draft.profiles.is_empty() {
            base.numbers.retain(|path, _| !IMPACT.contains(path));
        }
        base.numbers.extend(draft.numbers);
        base.profiles.extend(draft.profiles);
        base.top = draft.top.or(base.top);
        base.check()
    }

    pub(super) fn from_problem(problem: &Problem) -> Self {
        let mut base = Draft { top: Some(problem.rod.top), ..Draft::default() };
        let mut set = |path, number: &Number| _ = base.numbers.insert(path, number.clone().into());
        set("rod.length", &problem.rod.length);
        problem.rod.damping.iter().for_each(|r| set("rod.damping", r));
        problem.gravity.iter().for_each(|g| set("gravity.acceleration", g));
        match &problem.rod.material {
            Material::WaveSpeed(c) => set("rod.wave_speed", c),
            Material::Elastic { modulus, density, area } => {
                set("rod.modulus", modulus);
                set("rod.density", density);
                area.iter().for_each(|area| set("rod.area", area));
            }
        }
        match &problem.run {
            Run::Impacts(impacts) => set("run.impacts", &i64::from(*impacts).into()),
            Run::Time(time) => set("run.time", time),
        }
        match &problem.start {
            Start::Uniform(Speed::Given(speed)) => set("impact.speed", speed),
            Start::Uniform(Speed::DropHeight(height)) => set("impact.drop_height", height),
            Start::Above { gap, speed } => {
                set("impact.gap", gap);
                set("impact.speed", speed);
            }
            Start::Profile(Profile { displacement, velocity }) => {
                let both = [("start.displacement", displacement), ("start.velocity", velocity)];
                for (path, points) in both.into_iter().filter(|(_, points)| !points.is_empty()) {
                    base.profiles.insert(path, written(points.iter().map(|(x, v)| (x, v))));
                }
            }
        }
        Builder { draft: Draft::default(), base }
    }
}

fn written<X: Into<Written>, V: Into<Written>>(points: impl IntoIterator<Item = (X, V)>) -> Points {
    points.into_iter().map(|(x, v)| (x.into(), v.into())).collect()
}
