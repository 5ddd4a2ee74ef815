//! Problems.

use std::sync::Arc;

use dalembert::problem::{Builder, Written};
use dalembert::quantity::UnitSystem;
use dalembert::solve::{CERTIFIED_DIGITS, MAX_DIGITS};
use dalembert::{ChainScene, Numbers, Parameter, Parameters, Plan, Question, Scene, Top, UnknownName};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::argument::{one_of, refuse, typed, written};
use super::history::History;
use super::{observer, run};

/// A parameter of a problem as it is written: a number, or the points of a profile.
#[derive(IntoPyObject)]
struct Given {
    name: &'static str,
    number: Option<String>,
    points: Vec<[String; 2]>,
}

/// The values of a problem and some that follow from them.
#[derive(IntoPyObject)]
struct Facts {
    given: Vec<Given>,
    has_fixed_top: bool,
    title: Option<String>,
    wave_speed: f64,
    round_trip: f64,
    damping_ratio: f64,
    /// Infinite without gravity, and `None` where the start is not uniform.
    speed_ratio: Option<f64>,
}

fn points(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<(Written, Written)>> {
    let pairs: Vec<[Bound<'_, PyAny>; 2]> = typed(name, value, "points (x, value), an array of shape (n, 2)")?;
    pairs.iter().map(|[x, v]| Ok((written("x", x)?, written(name, v)?))).collect()
}

/// Reads a scene of a single rod, or that of a body of a chain.
fn scene(text: &str, body: Option<usize>) -> PyResult<Scene> {
    if !ChainScene::is_chain(text) {
        return Scene::parse(text).map_err(refuse);
    }
    let chain = ChainScene::parse(text).map_err(refuse)?;
    match (body, chain.chain.bodies().len()) {
        (Some(body), _) => chain.body(body).map_err(refuse),
        (None, 1) => chain.body(0).map_err(refuse),
        (None, count) => {
            let expected = "dalembert.Chain(scene), or one of Problem.bodies(scene)";
            Err(refuse(format!("found a chain of {count} bodies, expected {expected}")))
        }
    }
}

/// Returns for each body of a chain whether it is a bar; nothing for a rod on rigid ground.
#[pyfunction]
pub(crate) fn bars(text: &str) -> PyResult<Vec<bool>> {
    if !ChainScene::is_chain(text) {
        return Ok(Vec::new());
    }
    let chain = ChainScene::parse(text).map_err(refuse)?.chain;
    Ok(chain.bodies().iter().map(|body| body.rigid_mass().is_none()).collect())
}

/// A problem, with the accuracy, the title and the units of its scene.
#[pyclass(frozen, module = "dalembert._core")]
pub(crate) struct Problem {
    pub(crate) problem: dalembert::Problem,
    pub(crate) accuracy: Option<f64>,
    pub(crate) title: Option<String>,
    pub(crate) units: UnitSystem,
}

#[pymethods]
impl Problem {
    /// Builds a problem from its values by name, from a scene in TOML, or from a chain in TOML and the index of a body,
    /// and then replaces some values, in order.
    #[new]
    #[pyo3(signature = (first, *replaced))]
    fn new(first: &Bound<'_, PyAny>, replaced: Vec<Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut made = match first.cast::<PyDict>() {
            Ok(values) => {
                let problem = set(dalembert::Problem::builder(), values)?;
                Problem { problem, accuracy: None, title: None, units: UnitSystem::default() }
            }
            Err(_) => {
                let (text, body) = match first.extract::<(String, usize)>() {
                    Ok((text, body)) => (text, Some(body)),
                    Err(_) => (first.extract()?, None),
                };
                let Scene { problem, accuracy, title, units, .. } = scene(&text, body)?;
                Problem { problem, accuracy, title, units }
            }
        };
        for values in replaced {
            made.problem = set(made.problem.to_builder(), &values)?;
        }
        Ok(made)
    }

    fn facts(&self) -> PyResult<Facts> {
        let problem = &self.problem;
        let given = Parameter::ALL.iter().map(|parameter| Given {
            name: parameter.name(),
            number: parameter.given(problem).map(|number| number.to_string()),
            points: parameter
                .list(problem)
                .into_iter()
                .flatten()
                .map(|(x, v)| [x.to_string(), v.to_string()])
                .collect(),
        });
        let parameters = Parameters::<f64>::of(problem, &()).map_err(refuse)?;
        let groups = problem.dimensionless();
        Ok(Facts {
            given: given.filter(|given| given.number.is_some() || !given.points.is_empty()).collect(),
            has_fixed_top: problem.top() == Top::Fixed,
            title: self.title.clone(),
            wave_speed: parameters.wave_speed,
            round_trip: parameters.round_trip(),
            damping_ratio: groups.damping_ratio,
            speed_ratio: groups.speed_ratio,
        })
    }

    /// Returns the problem as a scene file.
    fn to_toml(&self) -> PyResult<String> {
        if self.problem.chain().is_some() {
            return Err(refuse("found a body of a chain with other values, which no scene file of a rod holds"));
        }
        let mut scene = Scene::from(self.problem.clone());
        (scene.title, scene.units, scene.accuracy) = (self.title.clone(), self.units, self.accuracy);
        Ok(scene.to_toml())
    }

    /// Solves the problem in the numbers that are asked for, through the first contact alone or the whole run.
    fn solve(
        &self,
        py: Python<'_>,
        digits: &Bound<'_, PyAny>,
        exact: &Bound<'_, PyAny>,
        certified: &Bound<'_, PyAny>,
        accuracy: &Bound<'_, PyAny>,
        first_contact: &Bound<'_, PyAny>,
    ) -> PyResult<History> {
        let numbers = numbers([digits, exact, certified, accuracy], self.accuracy)?;
        let first_contact: bool = typed("first_contact", first_contact, "True or False")?;
        let question = if first_contact { Question::first_contact(numbers) } else { Question::run(numbers) };
        let (problem, stop) = (self.problem.clone(), Arc::default());
        let observe = observer(&stop);
        // The plan may already take long: it foresees the digits that a chaotic run loses.
        let history = run(py, &stop, move || Plan::of(&problem, &question)?.solve(&problem, observe))?;
        Ok(History::new(history.in_units(self.units), stop))
    }
}

/// Reads the numbers that are asked for by `digits`, `exact`, `certified` and `accuracy`.
pub(crate) fn numbers(
    [digits, exact, certified, accuracy]: [&Bound<'_, PyAny>; 4],
    default_accuracy: Option<f64>,
) -> PyResult<Numbers> {
    let flag = |name: &str, value: &Bound<'_, PyAny>| typed::<bool>(name, value, "True or False");
    let (exact, certified) = (flag("exact", exact)?, flag("certified", certified)?);
    let digits: Option<i64> = typed("digits", digits, "an integer or None")?;
    let accuracy: Option<f64> = typed("accuracy", accuracy, "a float or None")?;
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
        _ => Numbers::Double(accuracy.or(default_accuracy)),
    };
    if accuracy.is_some() && !matches!(numbers, Numbers::Double(_)) {
        return Err(refuse("found accuracy with other numbers, expected it with doubles only"));
    }
    Ok(numbers)
}

/// A value of a problem, as a builder takes it.
#[derive(Clone)]
pub(crate) enum Setting {
    Number(Parameter, Written),
    Displacement(Vec<(Written, Written)>),
    Strain(Vec<(Written, Written)>),
    Velocity(Vec<(Written, Written)>),
    Top(Top),
}

impl Setting {
    /// Reads the value of this name.
    pub(crate) fn new(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Self> {
        let parameter = name.parse().map_err(|error: UnknownName| PyTypeError::new_err(error.to_string()))?;
        Ok(match parameter {
            Parameter::Displacement(None) => Setting::Displacement(points(name, value)?),
            Parameter::Strain(None) => Setting::Strain(points(name, value)?),
            Parameter::Velocity(None) => Setting::Velocity(points(name, value)?),
            Parameter::Top => Setting::Top(one_of(name, value, &[("free", Top::Free), ("fixed", Top::Fixed)])?),
            Parameter::Displacement(Some(_)) | Parameter::Strain(Some(_)) | Parameter::Velocity(Some(_)) => {
                return Err(PyTypeError::new_err(format!("found {name}, expected all points of {}", parameter.name())));
            }
            _ => Setting::Number(parameter, written(name, value)?),
        })
    }

    pub(crate) fn apply(self, builder: Builder) -> Builder {
        match self {
            Setting::Number(parameter, number) => builder.set(parameter, number),
            Setting::Displacement(points) => builder.displacement(points),
            Setting::Strain(points) => builder.strain(points),
            Setting::Velocity(points) => builder.velocity(points),
            Setting::Top(top) => builder.top(top),
        }
    }
}

/// Returns the message for a name that no parameter has; `None` for a name that one has.
#[pyfunction]
pub(crate) fn unknown_parameter(name: &str) -> Option<String> {
    name.parse::<Parameter>().err().map(|error| error.to_string())
}

/// Returns the problem of a builder with all of `values` set.
fn set(mut builder: Builder, values: &Bound<'_, PyDict>) -> PyResult<dalembert::Problem> {
    for (name, value) in values {
        builder = Setting::new(&name.extract::<String>()?, &value)?.apply(builder);
    }
    builder.build().map_err(refuse)
}
