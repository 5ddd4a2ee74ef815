//! Which values of a scene are varied, and the problem of each point.

use dalembert::UnknownName;
use dalembert::number::{List, Number};
use dalembert::problem::{Parameter, Problem, ProblemError, Written};

const MOST_POINTS: usize = 10_000_000;

#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct SweepError(String);

impl SweepError {
    pub fn new(found: impl std::fmt::Display, expected: impl std::fmt::Display) -> Self {
        SweepError(format!("found {found}, expected {expected}"))
    }
}

/// One parameter that is varied, and its values in turn.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    pub parameter: Parameter,
    pub values: Vec<Number>,
}

impl std::str::FromStr for Axis {
    type Err = SweepError;

    /// `PATH=VALUES`, with the values as [`List::read`] reads them.
    fn from_str(text: &str) -> Result<Self, SweepError> {
        let found = |found: &str| format!("`{found}`");
        let (path, list) = text
            .split_once('=')
            .ok_or_else(|| SweepError::new(found(text), "PATH=V1,V2,…, PATH=A..B:N or PATH=A..B:N:log"))?;
        let parameter: Parameter = path.parse().map_err(|error: UnknownName| SweepError(error.to_string()))?;
        if !parameter.is_number() {
            let known = Parameter::numbers().map(Parameter::path).collect::<Vec<_>>().join(", ");
            return Err(SweepError::new(
                format!("the parameter `{parameter}`"),
                format!("a number of a scene: {known}"),
            ));
        }
        Ok(Axis { parameter, values: values(list)? })
    }
}

/// The values that a list spells: listed values and both ends of a range as they are written; what lies between is the
/// shortest decimal of the double.
pub fn values(text: &str) -> Result<Vec<Number>, SweepError> {
    let (list, geometric) = List::read(text, true).map_err(SweepError)?;
    let List::Range(from, to, count) = list else { return Ok(list.numbers().unwrap_or_default()) };
    let (a, b, steps) = (from.to_f64(), to.to_f64(), f64::from(count - 1));
    let inner = |k: u32| {
        let k = f64::from(k);
        let value = if geometric { a * (b / a).powf(k / steps) } else { (a * (steps - k) + b * k) / steps };
        Written::from(value).number().cloned().map_err(|error| SweepError(error.to_string()))
    };
    let between = (1..count - 1).map(inner).collect::<Result<Vec<_>, _>>()?;
    Ok(std::iter::once(from).chain(between).chain([to]).collect::<Vec<_>>())
}

/// Every combination of the values of some axes, the last one varying fastest.
#[derive(Clone, Debug)]
pub struct Grid {
    problem: Problem,
    pub axes: Vec<Axis>,
}

impl Grid {
    /// The points of `problem` with the values of `axes` in place of its own. An axis that comes twice is refused, and
    /// too many points.
    pub fn new(problem: Problem, axes: Vec<Axis>) -> Result<Self, SweepError> {
        for (k, axis) in axes.iter().enumerate() {
            if axes[..k].iter().any(|other| other.parameter == axis.parameter) {
                return Err(SweepError::new(format!("{} varied twice", axis.parameter.path()), "each value once"));
            }
        }
        let count = axes.iter().try_fold(1usize, |count, axis| count.checked_mul(axis.values.len()));
        if count.is_none_or(|count| count > MOST_POINTS) {
            let sizes = axes.iter().map(|axis| axis.values.len().to_string()).collect::<Vec<_>>().join(" × ");
            return Err(SweepError::new(format!("{sizes} points"), format!("at most {MOST_POINTS}")));
        }
        Ok(Grid { problem, axes })
    }

    pub fn len(&self) -> usize {
        self.axes.iter().map(|axis| axis.values.len()).product()
    }

    /// What is varied, as it is at a point.
    pub fn values(&self, index: usize) -> Vec<&Number> {
        let mut rest = index;
        let mut values: Vec<&Number> = Vec::with_capacity(self.axes.len());
        for axis in self.axes.iter().rev() {
            values.push(&axis.values[rest % axis.values.len()]);
            rest /= axis.values.len();
        }
        values.reverse();
        values
    }

    pub fn problem(&self, index: usize) -> Result<Problem, ProblemError> {
        let values = self.axes.iter().zip(self.values(index));
        values
            .fold(self.problem.to_builder().from_scene(), |builder, (axis, value)| builder.set(axis.parameter, value))
            .build()
    }
}

#[cfg(test)]
#[path = "tests/grid.rs"]
mod tests;
