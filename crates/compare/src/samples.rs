//! Samples: the rows of a file at times of the history.

use super::data::{Columns, DataError, DataErrorKind};
use super::map::ColumnMap;
use super::norms::Grid;
use dalembert::Side;
use dalembert::quantity::Quantity;

/// The rows from `t = 0` on.
#[derive(Clone, Debug)]
pub(crate) struct Samples {
    pub(crate) grid: Grid,
    /// The columns in the conventions of the file.
    pub(crate) quantities: Vec<(Quantity, Vec<f64>)>,
    pub(crate) step: f64,
    /// The number of rows before `t = 0`.
    pub(crate) outside: usize,
    pub(crate) notes: Vec<String>,
    pub(crate) rounding: TimeRounding,
    /// The limit that each row holds at a jump, where that is known.
    pub(crate) sides: Vec<Option<Side>>,
}

/// The rounding of the times of a file: half a unit of the last written digit, plus the rounding of steps that are
/// added up one by one, and at most a quarter of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TimeRounding {
    /// The greatest number of decimals of a time.
    decimals: i32,
    /// The greatest number of digits of a time.
    digits: i32,
    rows: f64,
    pub(crate) most: f64,
}

/// Largest number of times whose digits are counted.
const COUNTED: usize = 1000;

impl TimeRounding {
    fn new(times: &[f64], step: f64) -> Self {
        let (mut decimals, mut digits) = (0, 1);
        for time in times.iter().step_by(times.len().div_ceil(COUNTED).max(1)).filter(|time| **time != 0.0) {
            // The shortest text of this double is that of a file with fewer digits.
            let text = format!("{time:e}");
            let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
            let written = mantissa.chars().filter(char::is_ascii_digit).count() as i32;
            digits = digits.max(written);
            decimals = decimals.max(written - 1 - exponent.parse::<i32>().unwrap_or(0));
        }
        TimeRounding { decimals, digits, rows: times.len() as f64, most: step / 4.0 }
    }

    /// Returns the rounding of `time`.
    pub(crate) fn at(&self, time: f64) -> f64 {
        let place = time.abs().log10().floor().max(-300.0) as i32 + 1 - self.digits;
        let unit = 10f64.powi(place.max(-self.decimals));
        (unit / 2.0 + self.rows * f64::EPSILON * time.abs()).min(self.most)
    }
}

impl Samples {
    /// Builds the samples in `columns` as `map` assigns them, with `shift` added to the times; times that are not in
    /// the file are `start + k step`. Two rows at one time are the limits at a jump, the earlier first; a field needs
    /// the column of sides for that.
    pub(crate) fn new(
        mut columns: Columns,
        map: &ColumnMap,
        counted: Option<(f64, f64)>,
        shift: f64,
        length: f64,
    ) -> Result<Self, DataError> {
        let rows = columns.rows();
        if rows == 0 {
            return Err(columns.whole(DataErrorKind::Empty));
        }
        let mut values = std::mem::take(&mut columns.values).into_iter();
        let mut of = |what| map.place(what).and_then(|_| values.next());
        let mut times: Vec<f64> = match (of(Quantity::Time), counted) {
            (Some(times), _) => times,
            (None, Some((start, step))) => (0..rows).map(|k| start + k as f64 * step).collect(),
            (None, None) => Vec::new(),
        };
        let (points, given_sides) = (of(Quantity::Point), of(Quantity::Side));
        let refuse = |row: usize, what: Quantity, kind| columns.refuse(row, map.place(what).unwrap_or(0), kind);
        let mut sides = match &given_sides {
            Some(given) => sides_of(given).map_err(|(row, kind)| refuse(row, Quantity::Side, kind))?,
            None => vec![None; times.len()],
        };
        let limits = [Some(Side::Left), Some(Side::Right)];
        for k in 1..times.len() {
            let (before, found) = (times[k - 1], times[k]);
            if found == before && points.is_none() && given_sides.is_none() && sides[k - 1].is_none() {
                sides[k - 1..=k].copy_from_slice(&limits);
            }
            let follows = found > before || (found == before && (points.is_some() || sides[k - 1..=k] == limits));
            if !follows {
                return Err(columns.refuse(k, map.columns[0].1, DataErrorKind::NotIncreasing { before, found }));
            }
        }
        times.iter_mut().for_each(|time| *time += shift);
        let misplaced = points.as_ref().and_then(|points| misplaced_point(points, &times, &sides, length));
        if let Some((row, kind)) = misplaced {
            return Err(refuse(row, Quantity::Point, kind));
        }
        let from = times.partition_point(|time| *time < 0.0);
        let last = times.last().copied().unwrap_or(0.0);
        if last <= 0.0 {
            return Err(columns.whole(DataErrorKind::NoOverlap { last }));
        }
        if points.is_none() && times[from] == last {
            return Err(columns.whole(DataErrorKind::OneTime(last)));
        }
        let cut = |mut values: Vec<f64>| values.split_off(from);
        let (times, points, sides) = (cut(times), points.map(&cut), sides.split_off(from));
        let step = median_step(&times);
        let rounding = TimeRounding::new(&times, step);
        let whats = map.columns.iter().map(|(what, _)| *what);
        let is_place = |what: &Quantity| matches!(what, Quantity::Time | Quantity::Point | Quantity::Side);
        let quantities = whats.skip_while(|what| is_place(what)).zip(values.map(&cut)).collect();
        let unused = map.unused.join(", ");
        let notes = (!unused.is_empty()).then(|| format!("not used: {unused}")).into_iter().collect();
        Ok(Samples { grid: Grid::new(times, points), quantities, step, outside: from, notes, rounding, sides })
    }
}

/// Reads sides: −1 is left, 1 right, and 0 either.
///
/// **Errors**: the row of another number.
fn sides_of(given: &[f64]) -> Result<Vec<Option<Side>>, (usize, DataErrorKind)> {
    let side = |(row, found): (usize, &f64)| match *found {
        -1.0 => Ok(Some(Side::Left)),
        0.0 => Ok(None),
        1.0 => Ok(Some(Side::Right)),
        other => Err((row, DataErrorKind::Side(other.to_string()))),
    };
    given.iter().enumerate().map(side).collect()
}

/// Returns the first row whose point is outside the rod, or not above the point before it at the same time.
fn misplaced_point(
    points: &[f64],
    times: &[f64],
    sides: &[Option<Side>],
    length: f64,
) -> Option<(usize, DataErrorKind)> {
    let limits = [Some(Side::Left), Some(Side::Right)];
    points.iter().copied().enumerate().find_map(|(k, found)| {
        if !(0.0..=length).contains(&found) {
            return Some((k, DataErrorKind::PointOutside { found, length }));
        }
        let is_same = |before: &usize| times[*before] == times[k] && sides[*before..=k] != limits;
        let before = points[k.checked_sub(1).filter(is_same)?];
        (before >= found).then_some((k, DataErrorKind::PointsNotIncreasing { before, found }))
    })
}

/// Returns the median of the steps between ascending times; zero without any.
fn median_step(times: &[f64]) -> f64 {
    let mut steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| *step > 0.0).collect();
    let middle = steps.len() / 2;
    if steps.is_empty() { 0.0 } else { *steps.select_nth_unstable_by(middle, f64::total_cmp).1 }
}

#[cfg(test)]
#[path = "tests/samples.rs"]
mod tests;
