//! Norms of the difference between data and exact values, in L¹, L² and L∞.

use std::ops::Range;

use schemars::JsonSchema;
use serde::{Serialize, Serializer};

use dalembert::quantity::Quantity;

/// The weights of the samples in a norm.
pub(super) const WEIGHTS: &str =
    "sums over the samples by the trapezoidal rule: each weighs half the way to its neighbours";

/// A norm of the difference `theirs − ours`; for the greatest difference with its place.
#[derive(Clone, Copy, Debug, Default, PartialEq, JsonSchema, Serialize)]
pub(crate) struct Norm {
    /// `‖theirs − ours‖`.
    pub absolute: f64,
    /// The absolute norm divided by `‖ours‖` at the same samples; `None` where that is zero.
    pub relative: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub t: Option<f64>,
    /// The point of the rod, for a field.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x: Option<f64>,
}

/// A column of the data with the exact values at its samples.
#[derive(Debug, JsonSchema, Serialize)]
pub struct ComparedColumn {
    /// The quantity.
    #[serde(rename = "name", serialize_with = "name")]
    #[schemars(with = "String")]
    pub what: Quantity,
    pub(crate) unit: &'static str,
    /// The exact values.
    #[serde(skip)]
    pub ours: Vec<f64>,
    /// The values of the data, in the conventions and units of the library.
    #[serde(skip)]
    pub theirs: Vec<f64>,
    #[serde(flatten)]
    pub(crate) norms: Norms,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
fn name<S: Serializer>(quantity: &Quantity, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(quantity.name())
}

/// The norms of the difference of a column.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize)]
pub(crate) struct Norms {
    pub samples: usize,
    /// The number of samples on a jump of the exact values.
    pub on_jumps: usize,
    /// `∫ |theirs − ours|`.
    pub l1: Norm,
    /// `√∫ (theirs − ours)²`.
    pub l2: Norm,
    /// `max |theirs − ours|` over all samples.
    pub linf: Norm,
    /// `max |theirs − ours|` over samples away from jumps; `None` where there are none.
    pub linf_off_jumps: Option<Norm>,
}

/// A kind of norm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NormKind {
    /// The name in data and bounds.
    pub name: &'static str,
    /// The name in tables.
    pub title: &'static str,
    /// The norm; `None` where no sample counts.
    pub get: fn(&Norms) -> Option<Norm>,
}

/// The kinds of norms.
pub(crate) const NORMS: [NormKind; 4] = [
    NormKind { name: "l1", title: "L1", get: |norms| Some(norms.l1) },
    NormKind { name: "l2", title: "L2", get: |norms| Some(norms.l2) },
    NormKind { name: "linf", title: "L∞", get: |norms| Some(norms.linf) },
    NormKind { name: "linf_off_jumps", title: "L∞ off jumps", get: |norms| norms.linf_off_jumps },
];

/// The times and points of samples, and their weights in an integral.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grid {
    /// The times, in order.
    pub times: Vec<f64>,
    /// The points of the rod, for a field: in order at each time.
    pub points: Option<Vec<f64>>,
    pub(crate) weights: Vec<f64>,
}

impl Grid {
    /// Builds the grid of samples at these times and points.
    ///
    /// **Source**: the trapezoidal rule. A sample weighs half the distance to each of its neighbours in time, and for a
    /// field in `x` at its time as well; a direction with a single time or point weighs 1. Integrals are sums over
    /// samples, and nothing is interpolated. Two rows at one time, the limits at a jump, share the weight of one.
    pub(crate) fn new(times: Vec<f64>, points: Option<Vec<f64>>) -> Self {
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

/// Returns the rows of a field: the samples of one time, or of one limit at it, with points that increase.
fn rows(times: &[f64], points: &[f64]) -> Vec<Range<usize>> {
    let ends =
        (1..=times.len()).filter(|k| *k == times.len() || times[*k] > times[k - 1] || points[*k] <= points[k - 1]);
    let mut start = 0;
    ends.map(|end| std::mem::replace(&mut start, end)..end).collect()
}

/// Returns the weights of the trapezoidal rule at ascending places; 1 where there is only one.
fn trapezoid(places: &[f64]) -> Vec<f64> {
    let last = places.len().saturating_sub(1);
    if places.first() == places.last() {
        return vec![1.0; places.len()];
    }
    (0..=last).map(|k| (places[(k + 1).min(last)] - places[k.saturating_sub(1)]) / 2.0).collect()
}

/// Returns the power of two nearest to the greatest of some values, within the range of inverses; 1 where all are zero.
fn magnitude(values: impl Iterator<Item = f64>) -> f64 {
    let most = values.fold(0.0, f64::max);
    if most > 0.0 { most.log2().round().clamp(-1000.0, 1000.0).exp2() } else { 1.0 }
}

/// Share of the natural scale below which values are rounded zeros, such as those of a top that is held.
const ROUNDED_ZERO: f64 = 1e-12;

impl Norms {
    /// Computes the norms of `theirs − ours` over `grid`, which has a sample, with `on_jumps` of the samples on a jump;
    /// `away` says which samples are away from jumps. There is no relative norm where all exact values are below 1e-12
    /// of their scale `natural`.
    ///
    /// **Accuracy**: *exact* but for rounding, as sums over samples.
    pub(crate) fn new(
        grid: &Grid,
        ours: &[f64],
        theirs: &[f64],
        natural: f64,
        on_jumps: usize,
        away: impl Fn(usize) -> bool,
    ) -> Norms {
        // Values are scaled to about 1 by powers of two: no square leaves the range of doubles, and no digit changes.
        let apart = |a: &f64, b: &f64| (b / 2.0 - a / 2.0).abs();
        let unit = magnitude(ours.iter().zip(theirs).map(|(a, b)| apart(a, b)));
        let own_unit = magnitude(ours.iter().map(|a| a.abs()));
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
        if scale[0] <= ROUNDED_ZERO * (natural / own_unit) {
            (own, scale) = ([0.0; 2], [0.0; 2]);
        }
        let unit = 2.0 * unit;
        let norm = |absolute: f64, own: f64| {
            let relative = (own > 0.0).then(|| absolute * (unit / own_unit) / own);
            Norm { absolute: absolute * unit, relative, t: None, x: None }
        };
        let greatest = [0, 1].map(|which| {
            let (k, absolute) = greatest[which]?;
            let x = grid.points.as_ref().map(|points| points[k]);
            Some(Norm { t: Some(grid.times[k]), x, ..norm(absolute, scale[which]) })
        });
        Norms {
            samples: ours.len(),
            on_jumps,
            l1: norm(sums[0], own[0]),
            l2: norm(sums[1].sqrt(), own[1].sqrt()),
            linf: greatest[0].unwrap_or(Norm { t: Some(0.0), ..Norm::default() }),
            linf_off_jumps: greatest[1],
        }
    }
}

/// The error of a run on a mesh of some width.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MeshError {
    pub width: f64,
    pub error: f64,
}

/// Returns the observed order of convergence `log(e₁/e₂)/log(h₁/h₂)` between two widths; `None` where it is undefined.
pub(crate) fn convergence_order(coarse: MeshError, fine: MeshError) -> Option<f64> {
    let order = (coarse.error / fine.error).log2() / (coarse.width / fine.width).log2();
    order.is_finite().then_some(order)
}

#[cfg(test)]
#[path = "tests/norms.rs"]
mod tests;
