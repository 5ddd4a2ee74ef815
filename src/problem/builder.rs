//! A problem put together value by value.

use super::in_chain::InChain;
use super::profile::Points;
use super::validate::{Draft, IMPACT};
use super::{Parameter, Problem, ProblemError, Profile, Run, Speed, Start, Top, Written};

/// A problem put together value by value: see [`Problem::builder`]. Each [`Parameter`] has a setter by its name, whose
/// value is a number as it is [`Written`]; nothing is checked before [`build`](Builder::build).
///
/// **Units**: any consistent units.
#[derive(Clone, Debug, Default)]
pub struct Builder {
    draft: Draft,
    /// Values of the problem before, each unless a value is set that excludes it.
    base: Draft,
}

/// Pairs of sets of parameters that exclude each other: a value that is set replaces those of the problem before in the
/// other set.
const EXCLUSIVE: [[&[Parameter]; 2]; 4] = [
    [&[Parameter::WaveSpeed], &[Parameter::Modulus, Parameter::Density, Parameter::Area]],
    [&[Parameter::ImpactSpeed], &[Parameter::DropHeight]],
    [&[Parameter::Gap], &[Parameter::DropHeight]],
    [&[Parameter::Time], &[Parameter::Impacts]],
];

impl Builder {
    /// Sets a parameter that is one number. Any other parameter changes nothing: see [`Builder::top`],
    /// [`Builder::displacement`] and [`Builder::velocity`].
    ///
    /// ```
    /// use dalembert::{Parameter, Problem};
    /// let rod = Problem::builder().length(1).wave_speed(1);
    /// let other = rod.clone().set(Parameter::ImpactSpeed, "1/3").build()?;
    /// assert_eq!(other, rod.impact_speed("1/3").build()?);
    /// # Ok::<(), dalembert::problem::ProblemError>(())
    /// ```
    #[must_use]
    pub fn set(mut self, parameter: Parameter, value: impl Into<Written>) -> Self {
        if parameter.is_number() {
            self.draft.numbers.insert(parameter, value.into());
        }
        self
    }

    /// Makes messages name parameters by the keys of a scene file.
    #[must_use]
    pub fn from_scene(mut self) -> Self {
        self.base.from_scene = true;
        self
    }

    /// Sets Young's modulus `E`, density `ρ` and cross-section `S`, all above zero: `c = √(E/ρ)`.
    #[must_use]
    pub fn material(self, modulus: impl Into<Written>, density: impl Into<Written>, area: impl Into<Written>) -> Self {
        self.modulus(modulus).density(density).area(area)
    }

    /// Sets the end `x = L`; without it the end is free.
    #[must_use]
    pub fn top(mut self, top: Top) -> Self {
        self.draft.top = Some(top);
        self
    }

    /// Sets a top that does not move: `v(L,t) = v(L,0)`.
    #[must_use]
    pub fn fixed_top(self) -> Self {
        self.top(Top::Fixed)
    }

    /// Sets the start.
    #[must_use]
    pub fn start(mut self, start: Start) -> Self {
        match start {
            Start::Uniform(Speed::Given(speed)) => self.impact_speed(speed),
            Start::Uniform(Speed::DropHeight(height)) => self.drop_height(height),
            Start::Above { gap, speed } => self.gap(gap).impact_speed(speed),
            Start::Profile(Profile { displacement, strain, velocity }) => {
                let lists = Parameter::LISTS.into_iter().zip([displacement, strain, velocity]);
                let given = lists.filter(|(_, points)| !points.is_empty());
                self.draft.profiles.extend(given.map(|(list, points)| (list, written(points))));
                self
            }
        }
    }

    /// Sets the end of the run.
    #[must_use]
    pub fn run(self, run: Run) -> Self {
        match run {
            Run::Impacts(impacts) => self.impacts(impacts),
            Run::Time(time) => self.time(time),
        }
    }

    /// Sets the displacement at `t = 0` as points `(x, v)` from `x = 0` to `x = L`, linear between them; in place of an
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
        self.draft.profiles.insert(Parameter::Displacement(None), written(points));
        self
    }

    /// Sets the strain at `t = 0` as points `(x, v_x)`, linear between them, in place of the displacement; the lower
    /// end touches the ground. It may jump: the same `x` twice.
    ///
    /// ```
    /// use dalembert::{Problem, Side};
    /// // A rod that stands on the ground under its own weight stays at rest.
    /// let rod = Problem::builder().length(1).wave_speed(1).gravity(2);
    /// let standing = rod.strain([(0, -2), (1, 0)]).time(9).build()?.solve()?;
    /// assert_eq!(standing.strain(7, Side::Right)?, -2.0);
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    #[must_use]
    pub fn strain<X: Into<Written>, V: Into<Written>>(mut self, points: impl IntoIterator<Item = (X, V)>) -> Self {
        self.draft.profiles.insert(Parameter::Strain(None), written(points));
        self
    }

    /// Sets the velocity at `t = 0` as points `(x, v_t)`, like the [`displacement`](Builder::displacement). It may
    /// jump: the same `x` twice.
    #[must_use]
    pub fn velocity<X: Into<Written>, V: Into<Written>>(mut self, points: impl IntoIterator<Item = (X, V)>) -> Self {
        self.draft.profiles.insert(Parameter::Velocity(None), written(points));
        self
    }

    /// Builds the problem.
    ///
    /// ```
    /// use dalembert::{Parameter, Problem};
    /// // A modulus alone leaves the density as it is, and replaces a wave speed.
    /// let rod = Problem::builder().length(1).modulus(4).density(1).impact_speed(1).build()?;
    /// let stiffer = rod.to_builder().modulus(9).build()?;
    /// assert_eq!(Parameter::Density.given(&stiffer), Some(1.into()));
    /// assert_eq!(Parameter::WaveSpeed.value(&stiffer.to_builder().wave_speed(5).build()?), Some(5.0));
    /// // A length alone stretches the points of the start.
    /// let strained = Problem::builder().length(1).wave_speed(1).velocity([(0, -1), (1, -2)]).build()?;
    /// let longer = strained.to_builder().length(3).build()?;
    /// assert_eq!(longer, Problem::builder().length(3).wave_speed(1).velocity([(0, -1), (3, -2)]).build()?);
    /// # Ok::<(), dalembert::problem::ProblemError>(())
    /// ```
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
        let Builder { mut draft, mut base } = self;
        if let Some(young) = base.in_chain.as_ref().and_then(InChain::young)
            && let Some(value) = draft.numbers.remove(&Parameter::Modulus)
        {
            draft.numbers.insert(young, value);
        }
        let is_of_chain = |parameter: &Parameter| matches!(parameter, Parameter::OfChain(_));
        let of_chain: Vec<(Parameter, Written)> = draft.numbers.extract_if(.., |key, _| is_of_chain(key)).collect();
        for (set, other) in EXCLUSIVE.iter().flat_map(|[a, b]| [(a, b), (b, a)]) {
            if set.iter().any(|parameter| draft.has(*parameter)) {
                base.numbers.retain(|parameter, _| !other.contains(parameter));
            }
        }
        if IMPACT.iter().any(|parameter| draft.has(*parameter)) {
            base.profiles.clear();
        }
        if !draft.profiles.is_empty() {
            base.numbers.retain(|parameter, _| !IMPACT.contains(parameter));
        }
        if let Some(length) = draft.numbers.get(&Parameter::Length) {
            base.stretch(length);
        }
        base.numbers.extend(draft.numbers);
        let [displacement, strain, _] = Parameter::LISTS;
        for (set, other) in [(displacement, strain), (strain, displacement)] {
            if draft.profiles.contains_key(&set) {
                base.profiles.remove(&other);
            }
        }
        base.profiles.extend(draft.profiles);
        base.top = draft.top.or(base.top);
        of_chain
            .iter()
            .try_fold(base.check()?, |problem, (parameter, value)| problem.with_chain_value(*parameter, value))
    }

    pub(super) fn from_problem(problem: &Problem) -> Self {
        let mut base = Draft { top: Some(problem.top), in_chain: problem.in_chain.clone(), ..Draft::default() };
        for parameter in Parameter::ALL {
            if let Some(number) = parameter.given(problem) {
                base.numbers.insert(*parameter, number.into());
            } else if let Some(points) = parameter.list(problem).filter(|points| !points.is_empty()) {
                base.profiles.insert(*parameter, written(points.iter().map(|(x, v)| (x, v))));
            }
        }
        Builder { draft: Draft::default(), base }
    }
}

fn written<X: Into<Written>, V: Into<Written>>(points: impl IntoIterator<Item = (X, V)>) -> Points {
    points.into_iter().map(|(x, v)| (x.into(), v.into())).collect()
}
