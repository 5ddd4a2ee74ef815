//! Problems.

use std::sync::Arc;

use dalembert::problem::{Builder, Written};
use dalembert::quantity::UnitSystem;
use dalembert::solve::{CERTIFIED_DIGITS, MAX_DIGITS};
use dalembert::{Material, Number, Numbers, Parameters, Plan, Question, Run, Scene, Speed, Start, Top, Units};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::history::History;
use super::number::written;
use super::{observer, one_of, refuse, run};

/// A profile by its name, its points as they are spelt.
type Spelt = (&'static str, Vec<[String; 2]>);

fn points(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<(Written, Written)>> {
    let shape = format!("found {name} of another shape, expected points (x, value), an array of shape (n, 2)");
    let pairs: Vec<[Bound<'_, PyAny>; 2]> = value.extract().map_err(|_| PyTypeError::new_err(shape))?;
    pairs.iter().map(|[x, v]| Ok((written("x", x)?, written(name, v)?))).collect()
}

/// The physics in exact numbers, checked.
#[pyclass(frozen, module = "dalembert._core")]
pub(crate) struct Problem {
    pub(crate) problem: dalembert::Problem,
    pub(crate) accuracy: Option<f64>,
    pub(crate) title: Option<String>,
    pub(crate) units: UnitSystem,
}

#[pymethods]
impl Problem {
    /// A problem from its values by name or from a scene in TOML, and other values in place of some, in order.
    #[new]
    #[pyo3(signature = (first, *replaced))]
    fn new(first: &Bound<'_, PyAny>, replaced: Vec<Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut made = match first.cast::<PyDict>() {
            Ok(values) => {
                let problem = set(dalembert::Problem::builder(), values)?;
                Problem { problem, accuracy: None, title: None, units: UnitSystem::default() }
            }
            Err(_) => {
                let Scene { problem, accuracy, title, units, .. } = Scene::parse(first.extract()?).map_err(refuse)?;
                Problem { problem, accuracy, title, units }
            }
        };
        for values in replaced {
            made.problem = set(made.problem.to_builder(), &values)?;
        }
        Ok(made)
    }

    /// Its numbers and profiles by the names of the constructor, as they are spelt; what is absent is left out.
    fn values(&self) -> (Vec<(&'static str, String)>, Vec<Spelt>) {
        let dalembert::Problem { rod, gravity, start, run } = &self.problem;
        let mut numbers = vec![("length", Some(&rod.length))];
        match &rod.material {
            Material::WaveSpeed(speed) => numbers.push(("wave_speed", Some(speed))),
            Material::Elastic { modulus, density, area } => {
                numbers.extend([("modulus", Some(modulus)), ("density", Some(density)), ("area", area.as_ref())]);
            }
        }
        numbers.extend([("damping", rod.damping.as_ref()), ("gravity", gravity.as_ref())]);
        let mut profiles = vec![];
        match start {
            Start::Uniform(Speed::Given(speed)) => numbers.push(("impact_speed", Some(speed))),
            Start::Uniform(Speed::DropHeight(height)) => numbers.push(("drop_height", Some(height))),
            Start::Above { gap, speed } => numbers.extend([("impact_speed", Some(speed)), ("gap", Some(gap))]),
            Start::Profile(profile) => {
                profiles = vec![("displacement", &profile.displacement), ("velocity", &profile.velocity)];
                profiles.retain(|(_, points)| !points.is_empty());
            }
        }
        let text = |(name, number): (_, Option<&Number>)| Some((name, number?.to_string()));
        let mut numbers: Vec<(&'static str, String)> = numbers.into_iter().filter_map(text).collect();
        numbers.push(match run {
            Run::Impacts(impacts) => ("impacts", impacts.to_string()),
            Run::Time(time) => ("time", time.to_string()),
        });
        let points = |(name, points): (_, &Vec<(Number, Number)>)| {
            (name, points.iter().map(|(x, value)| [x.to_string(), value.to_string()]).collect())
        };
        (numbers, profiles.into_iter().map(points).collect())
    }

    /// Whether the upper end is held; the title of the scene.
    fn about(&self) -> (bool, Option<&str>) {
        (self.problem.rod.top == Top::Fixed, self.title.as_deref())
    }

    /// `c`, `t₁`, `R`, `M`, in doubles; `M` is infinite without gravity and `None` where the start is not uniform.
    fn parameters(&self) -> PyResult<(f64, f64, f64, Option<f64>)> {
        let rod = Parameters::<f64>::of(&self.problem, &()).map_err(refuse)?;
        let groups = self.problem.dimensionless();
        Ok((rod.wave_speed, rod.round_trip(), groups.damping_ratio, groups.speed_ratio))
    }

    /// Solves it, in the numbers that are asked for, through the first contact alone or the whole run.
    fn solve(
        &self,
        py: Python<'_>,
        digits: Option<i64>,
        exact: bool,
        certified: bool,
        accuracy: Option<f64>,
        first_contact: bool,
    ) -> PyResult<History> {
        let count = |digits| {
            let refused = |_| refuse(format!("found {digits} digits asked for, expected 1 to {MAX_DIGITS}"));
            u32::try_from(digits).map_err(refused)
        };
        let numbers = match (certified, exact, digits.map(count).transpose()?) {
            (true, true, _) => return Err(refuse("found certified and exact, expected one of them")),
            (true, _, digits) => Numbers::Certified(digits.unwrap_or(CERTIFIED_DIGITS)),
            (_, true, None) => Numbers::Exact,
            (_, true, Some(digits)) => Numbers::ExactThenDigits(digits),
            (_, _, Some(digits)) => Numbers::Digits(digits),
            _ => Numbers::Double(accuracy.or(self.accuracy)),
        };
        if accuracy.is_some() && !matches!(numbers, Numbers::Double(_)) {
            return Err(refuse("found accuracy with other numbers, expected it with doubles only"));
        }
        let question = if first_contact { Question::first_contact(numbers) } else { Question::run(numbers) };
        let (problem, stop) = (self.problem.clone(), Arc::default());
        let solved = (problem.clone(), Units::of(&problem, self.units));
        let observe = observer(&stop);
        // The plan may already take long: it foresees the digits that a chaotic run loses.
        let solution = run(py, &stop, move || Plan::of(&problem, &question)?.solve_typed(&problem, observe))?;
        Ok(History::new(solution, solved, stop))
    }
}

/// A value of a problem, as a builder takes it.
#[derive(Clone)]
pub(crate) enum Given {
    Number(Written),
    Displacement(Vec<(Written, Written)>),
    Velocity(Vec<(Written, Written)>),
    Top(Top),
}

impl Given {
    /// The value of this name.
    pub(crate) fn of(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(match name {
            "displacement" => Given::Displacement(points(name, value)?),
            "velocity" => Given::Velocity(points(name, value)?),
            "top" => Given::Top(one_of(name, value, &[("free", Top::Free), ("fixed", Top::Fixed)])?),
            _ if Builder::numbers().any(|known| known == name) => Given::Number(written(name, value)?),
            _ => {
                let known = Builder::numbers().collect::<Vec<_>>().join(", ");
                let expected = format!("one of {known}, displacement, velocity, top");
                return Err(PyTypeError::new_err(format!("found the unknown value `{name}`, expected {expected}")));
            }
        })
    }

    pub(crate) fn set(self, builder: Builder, name: &str) -> Builder {
        match self {
            Given::Number(number) => builder.named(name, number),
            Given::Displacement(points) => builder.displacement(points),
            Given::Velocity(points) => builder.velocity(points),
            Given::Top(top) => builder.top(top),
        }
    }
}

/// The problem of a builder with all of `values` set.
fn set(mut builder: Builder, values: &Bound<'_, PyDict>) -> PyResult<dalembert::Problem> {
    for (name, value) in values {
        let name: String = name.extract()?;
        builder = Given::of(&name, &value)?.set(builder, &name);
    }
    builder.build().map_err(refuse)
}
