//! How far other people's data are from ours, in L¹, L² and L∞.

use std::ops::Range;

use serde::Serialize;

use dalembert::quantity::Quantity;

/// A norm of the difference `theirs − ours`; for the greatest difference with its place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Norm {
    /// `‖theirs − ours‖`.
    pub absolute: f64,
    /// The same divided by `‖ours‖` at the same samples; `None` where ours is zero there.
    pub relative: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// Where in the rod, for a field.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub point: Option<f64>,
}

/// One quantity: values at the samples of the grid, and how far apart they are.
#[derive(Debug)]
pub struct Compared {
    pub what: Quantity,
    pub ours: Vec<f64>,
    pub theirs: Vec<f64>,
    pub norms: Norms,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Norms {
    pub samples: usize,
    /// How many of them are on a jump of ours.
    pub on_jumps: usize,
    /// `∫ |theirs − ours|`.
    pub l1: Norm,
    /// `√∫ (theirs − ours)²`.
    pub l2: Norm,
    /// `max |theirs − ours|` over all samples.
    pub linf: Norm,
    /// The same over samples away from jumps; `None` where there are none.
    pub linf_off_jumps: Option<Norm>,
}

/// One of the norms; `None` where no sample counts.
pub(super) type OfNorms = fn(&Norms) -> Option<Norm>;

/// The norms: what data and tables call them.
pub(super) const NORMS: [(&str, &str, OfNorms); 4] = [
    ("l1", "L1", |norms| Some(norms.l1)),
    ("l2", "L2", |norms| Some(norms.l2)),
    ("linf", "L∞", |norms| Some(norms.linf)),
    ("linf_off_jumps", "L∞ off jumps", |norms| norms.linf_off_jumps),
];

/// Where and when samples are, and what they weigh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grid {
    /// Times, in order.
    pub times: Vec<f64>,
    /// Points of the rod, for a field: in order at each time.
    pub points: Option<Vec<f64>>,
    /// One for each sample.
    pub weights: Vec<f64>,
}

impl Grid {
    /// The grid of samples at these times and points.
    ///
    /// **Source**: the trapezoidal rule. A sample weighs half the way to each of its neighbours in time, and for a
    /// field in `x` at its time as well; where there is but one time, or one point at a time, that direction weighs 1.
    /// Nothing is interpolated: the integrals are sums over samples, whatever is between them. Two rows at one time,
    /// the limits at a jump, share what one would weigh.
    ///
    /// ```
    /// use dalembert_compare::Grid;
    /// assert_eq!(Grid::new(vec![0.0, 1.0, 4.0], None).weights, [0.5, 2.0, 1.5]);
    /// let field = Grid::new(vec![0.0, 0.0, 1.0, 1.0], Some(vec![0.0, 3.0, 0.0, 3.0]));
    /// assert_eq!(field.weights, [0.75; 4]);
    /// ```
    pub fn new(times: Vec<f64>, points: Option<Vec<f64>>) -> Self {
        let weights = match &points {
            None => trapezoid(&times),
            Some(points) => {
                let rows = rows(&times, points);
                let of_rows = trapezoid(&rows.iter().map(|row| times[row.start]).collect::<Vec<_>>());
                let weigh = |(row, of_row): (&Range<usize>, f64)| {
                    trapezoid(&points[row.clone()]).into_iter().map(move |weight| weight * of_row)
                };
                rows.iter().zip(of_rows).flat_map(weigh).collect()
            }
        };
        Grid { times, points, weights }
    }
}

/// The rows of a field: the samples of one time, or of one limit of it, with points that increase.
fn rows(times: &[f64], points: &[f64]) -> Vec<Range<usize>> {
    let ends =
        (1..=times.len()).filter(|k| *k == times.len() || times[*k] > times[k - 1] || points[*k] <= points[k - 1]);
    let mut start = 0;
    ends.map(|end| std::mem::replace(&mut start, end)..end).collect()
}

/// The weights of the trapezoidal rule at ascending places; 1 where there is only one.
fn trapezoid(places: &[f64]) -> Vec<f64> {
    let last = places.len().saturating_sub(1);
    if places.first() == places.last() {
        return vec![1.0; places.len()];
    }
    (0..=last).map(|k| (places[(k + 1).min(last)] - places[k.saturating_sub(1)]) / 2.0).collect()
}

/// The power of two next to the greatest of some values, within what has an inverse; 1 where all are zero.
fn size(values: impl Iterator<Item = f64>) -> f64 {
    let most = values.fold(0.0, f64::max);
    if most > 0.0 { most.log2().round().clamp(-1000.0, 1000.0).exp2() } else { 1.0 }
}

/// Values below this share of their natural scale are rounding of zero, such as that of a top that is held.
const NOTHING: f64 = 1e-12;

/// The norms of `theirs − ours` over `grid`, with `on_jumps` of the samples on a jump; `away` says which samples count
/// as away from jumps. Where ours is below 1e-12 of its scale `natural` throughout there is no relative norm. There
/// must be a sample.
///
/// **Accuracy**: *exact* but for rounding, as sums over samples; what happens between them is not seen.
pub fn norms(
    grid: &Grid,
    ours: &[f64],
    theirs: &[f64],
    natural: f64,
    on_jumps: usize,
    away: impl Fn(usize) -> bool,
) -> Norms {
    // Of about 1 each, by powers of two: no square leaves the range of doubles, and no digit changes.
    let apart = |a: &f64, b: &f64| (b / 2.0 - a / 2.0).abs();
    let (unit, own_unit) =
        (size(ours.iter().zip(theirs).map(|(a, b)| apart(a, b))), size(ours.iter().map(|a| a.abs())));
    let (mut sums, mut own, mut scale) = ([0.0; 2], [0.0; 2], [0.0f64; 2]);
    let mut greatest: [Option<(usize, f64)>; 2] = [None; 2];
    for (k, (weight, (a, b))) in grid.weights.iter().zip(ours.iter().zip(theirs)).enumerate() {
        let (difference, a) = (apart(a, b) / unit, a / own_unit);
        sums = [sums[0] + weight * difference, sums[1] + weight * difference * difference];
        own = [own[0] + weight * a.abs(), own[1] + weight * a * a];
        for (which, counts) in [true, away(k)].into_iter().enumerate() {
            if counts {
                scale[which] = scale[which].max(a.abs());
                if greatest[which].is_none_or(|(_, most)| difference > most) {
                    greatest[which] = Some((k, difference));
                }
            }
        }
    }
    if scale[0] <= NOTHING * (natural / own_unit) {
        (own, scale) = ([0.0; 2], [0.0; 2]);
    }
    let unit = 2.0 * unit;
    let norm = |absolute: f64, own: f64| {
        let relative = (own > 0.0).then(|| absolute * (unit / own_unit) / own);
        Norm { absolute: absolute * unit, relative, time: None, point: None }
    };
    let greatest = [0, 1].map(|which| {
        let (k, absolute) = greatest[which]?;
        let point = grid.points.as_ref().map(|points| points[k]);
        Some(Norm { time: Some(grid.times[k]), point, ..norm(absolute, scale[which]) })
    });
    Norms {
        samples: ours.len(),
        on_jumps,
        l1: norm(sums[0], own[0]),
        l2: norm(sums[1].sqrt(), own[1].sqrt()),
        linf: greatest[0].unwrap_or(Norm { time: Some(0.0), ..Norm::default() }),
        linf_off_jumps: greatest[1],
    }
}

/// The observed order of convergence `log(e₁/e₂)/log(h₁/h₂)` between two widths; `None` where it is not defined.
///
/// ```
/// assert_eq!(dalembert_compare::order((0.2, 0.04), (0.1, 0.01)), Some(2.0));
/// ```
pub fn order((coarse, error): (f64, f64), (fine, less): (f64, f64)) -> Option<f64> {
    let order = (error / less).log2() / (coarse / fine).log2();
    order.is_finite().then_some(order)
}

#[cfg(test)]
#[path = "tests/norms.rs"]
mod tests;
