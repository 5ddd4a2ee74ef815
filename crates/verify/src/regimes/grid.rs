//! Grids of parameter values: the problem of each point.

use dalembert::UnknownName;
use dalembert::number::{List, ListError, Number, NumberError};
use dalembert::problem::{Builder, Parameter, Problem, ProblemError, Written};

const MOST_POINTS: usize = 10_000_000;

/// A reason for which a grid, an axis or a map cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GridError {
    /// A text without a path and values.
    #[error("found `{0}`, expected PATH=V1,V2,…, PATH=A..B:N or PATH=A..B:N:log")]
    NoAxis(String),
    /// A name that is no parameter of a scene.
    #[error(transparent)]
    UnknownPath(UnknownName),
    /// A parameter that is a list.
    #[error(
        "found the parameter `{0}`, expected a number of a scene: {paths}",
        paths = paths().collect::<Vec<_>>().join(", ")
    )]
    NoNumber(Parameter),
    /// A text that spells no values.
    #[error(transparent)]
    Values(#[from] ListError),
    /// A value that cannot be read.
    #[error(transparent)]
    Number(#[from] NumberError),
    /// Two axes of one path.
    #[error("found {0} varied twice, expected each value once")]
    Twice(String),
    /// Axes of these sizes, with too many points.
    #[error("found {0} points, expected at most {MOST_POINTS}")]
    TooManyPoints(String),
    /// Values of a map that do not increase.
    #[error("found the values {0}, expected two values or more that increase, R from zero and M from above zero")]
    NotIncreasing(String),
}

/// Returns the paths of all numbers of a scene.
fn paths() -> impl Iterator<Item = &'static str> {
    Parameter::numbers().map(Parameter::path)
}

/// One parameter that is varied.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The parameter.
    pub parameter: Parameter,
    /// The values, in order.
    pub values: Vec<Number>,
}

impl std::str::FromStr for Axis {
    type Err = GridError;

    /// Reads `PATH=VALUES`, with the values as [`List::read`] reads them.
    fn from_str(text: &str) -> Result<Self, GridError> {
        let (path, list) = text.split_once('=').ok_or_else(|| GridError::NoAxis(text.into()))?;
        let parameter: Parameter = path.trim().parse().map_err(GridError::UnknownPath)?;
        if !parameter.is_number() {
            return Err(GridError::NoNumber(parameter));
        }
        Ok(Axis { parameter, values: values(list)? })
    }
}

/// Reads a list of values. Listed values and both ends of a range stay as written; the values between are the shortest
/// decimals of their doubles.
pub(super) fn values(text: &str) -> Result<Vec<Number>, GridError> {
    let (list, geometric) = List::read(text, true)?;
    let List::Range(from, to, count) = list else { return Ok(list.numbers().unwrap_or_default()) };
    let (a, b, steps) = (from.to_f64(), to.to_f64(), f64::from(count - 1));
    let inner = |k: u32| {
        let k = f64::from(k);
        let value = if geometric { a * (b / a).powf(k / steps) } else { (a * (steps - k) + b * k) / steps };
        Written::from(value).number().cloned().map_err(|error| GridError::Number(error.clone()))
    };
    let between = (1..count - 1).map(inner).collect::<Result<Vec<_>, _>>()?;
    Ok(std::iter::once(from).chain(between).chain([to]).collect())
}

/// Every combination of the values of some axes, with the last axis varying fastest.
#[derive(Clone, Debug)]
pub struct Grid {
    /// The axes, in order.
    pub axes: Vec<Axis>,
}

impl Grid {
    /// Builds the grid of the values of `axes`.
    ///
    /// **Errors**: [`GridError::Twice`]; [`GridError::TooManyPoints`].
    ///
    /// ```
    /// use dalembert_verify::regimes::Grid;
    /// let axes = ["rod.damping=0,0.1", "impact.speed=1..2:3"].map(|axis| axis.parse());
    /// let grid = Grid::new(axes.into_iter().collect::<Result<_, _>>()?)?;
    /// assert_eq!((grid.len(), grid.values(4)[1].1.to_f64()), (6, 1.5));
    /// # Ok::<(), dalembert_verify::regimes::GridError>(())
    /// ```
    pub fn new(axes: Vec<Axis>) -> Result<Self, GridError> {
        for (k, axis) in axes.iter().enumerate() {
            if axes[..k].iter().any(|other| other.parameter == axis.parameter) {
                return Err(GridError::Twice(axis.parameter.full_path()));
            }
        }
        let count = axes.iter().try_fold(1usize, |count, axis| count.checked_mul(axis.values.len()));
        if count.is_none_or(|count| count > MOST_POINTS) {
            let sizes = axes.iter().map(|axis| axis.values.len().to_string()).collect::<Vec<_>>().join(" × ");
            return Err(GridError::TooManyPoints(sizes));
        }
        Ok(Grid { axes })
    }

    /// Returns the number of points.
    #[allow(clippy::len_without_is_empty, reason = "no caller asks")]
    pub fn len(&self) -> usize {
        self.axes.iter().map(|axis| axis.values.len()).product()
    }

    /// Returns the values of a point with their parameters, in the order of the axes.
    pub fn values(&self, index: usize) -> Vec<(Parameter, &Number)> {
        let mut rest = index;
        let mut values = Vec::with_capacity(self.axes.len());
        for Axis { parameter, values: all } in self.axes.iter().rev() {
            values.push((*parameter, &all[rest % all.len()]));
            rest /= all.len();
        }
        values.reverse();
        values
    }

    /// Returns the problem of a point: `start` with the values of the point in place of its own.
    ///
    /// **Errors**: [`ProblemError`] for values that no problem has together.
    pub fn problem(&self, start: &Problem, index: usize) -> Result<Problem, ProblemError> {
        let set = |builder: Builder, (parameter, value)| builder.set(parameter, value);
        self.values(index).into_iter().fold(start.to_builder().from_scene(), set).build()
    }
}

#[cfg(test)]
#[path = "tests/grid.rs"]
mod tests;
