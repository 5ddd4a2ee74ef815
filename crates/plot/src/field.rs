//! Field along the rod over time: polygons between characteristics, in which the field does not jump.

use dalembert::number::{Estimate, Scalar};
use dalembert::problem::Parameters;
use dalembert::solve::TypedHistory;
use dalembert::{Error, Field};
use glam::DVec2;

use crate::draw::{FieldPiece, clip};
use crate::picture::FieldQuantity;

/// A double with its bound.
pub(crate) type Double = Estimate<f64>;

/// Number of rays above which none is drawn, nor its jump measured.
pub(crate) const MAX_RAYS: usize = 300;

/// Ray that is in the rod during the span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ray {
    /// Time at which it leaves the ground.
    pub(crate) departure: f64,
    /// Whether the field jumps across it, and not only the field's slope.
    pub(crate) jump: bool,
    /// Its jump, as a share of the greatest one.
    pub(crate) share: f64,
    /// Whether it rises to the top, and whether it comes back from there.
    pub(crate) legs: [bool; 2],
}

/// Field and rays over the span.
#[derive(Clone, Debug)]
pub(crate) struct FieldMap {
    pub(crate) rays: Vec<Ray>,
    pub(crate) values: FieldValues,
    /// Round number that no absolute value exceeds.
    pub(crate) color_limit: f64,
    /// Columns of the grid for each round trip, if they are too few to show the waves.
    pub(crate) coarse_columns: Option<f64>,
}

#[derive(Clone, Debug)]
pub(crate) enum FieldValues {
    /// Polygons in `(t, x)`, in each of which the field is taken as linear.
    Linear(Vec<FieldPiece>),
    /// Values at the middles of the cells of a grid of [`COLUMNS`] and [`ROWS`], row by row from the ground up.
    Grid(Vec<f64>),
}

/// Number of polygons above which a grid takes their place.
const MAX_POLYGONS: usize = 6000;
/// Number of parts of a round trip into which a curved field is divided.
const PARTS: f64 = 10.0;
/// Columns of a grid, along the time.
pub(crate) const COLUMNS: usize = 480;
/// Rows of a grid, along the rod.
pub(crate) const ROWS: usize = 96;
/// Columns that a round trip needs to show its waves.
const MIN_COLUMNS: f64 = 8.0;

impl FieldMap {
    /// Asks a history for a field, in units of `1/factor`.
    ///
    /// **Source**: between the rays of an undamped rod velocity and strain are linear in `x` and `t` (d'Alembert), and
    /// a cell is one polygon. Between the rays of a damped rod they are smooth, and a cell is divided. A spring makes
    /// fronts that are as steep as it is stiff, and a grid shows them.
    pub(crate) fn new(
        history: &TypedHistory<f64>,
        quantity: FieldQuantity,
        factor: f64,
        extent: &Extent,
        rays: Vec<Ray>,
    ) -> Result<FieldMap, Error> {
        let parts = || PARTS.min((4.0 * MAX_POLYGONS as f64 / (extent.trips() * 16.0)).sqrt()).max(2.0);
        let width = extent.is_damped().then(|| extent.trip() / parts());
        let [rising, falling] = [0.0, extent.trip()].map(|delay| extent.characteristics(&rays, delay, width));
        let mut greatest = 0.0f64;
        let polygons = if extent.is_soft { None } else { extent.polygons(&rising, &falling) };
        let (values, coarse_columns) = if let Some(polygons) = polygons {
            let points: Vec<DVec2> = polygons.iter().flat_map(|polygon| samples(polygon)).collect();
            let values = values_at(history, quantity, extent, &points)?;
            let values: Vec<f64> = values.into_iter().map(|value| factor * value).collect();
            let samples = values.chunks(3).zip(points.chunks(3));
            let settled =
                polygons.into_iter().zip(samples).filter(|(_, (v, _))| v.iter().all(|value| value.is_finite()));
            let piece = |(corners, (v, at)): (Vec<DVec2>, (&[f64], &[DVec2]))| {
                let slope = slope([at[1] - at[0], at[2] - at[0]], [v[1] - v[0], v[2] - v[0]]);
                let ends = corners.iter().map(|corner| (v[0] + slope.dot(*corner - at[0])).abs());
                greatest = ends.fold(greatest, f64::max);
                FieldPiece { corners, at: at[0], value: v[0], slope }
            };
            (FieldValues::Linear(settled.map(piece).collect()), None)
        } else {
            let values: Vec<f64> = grid(history, quantity, extent)?.into_iter().map(|value| factor * value).collect();
            greatest = values.iter().filter(|value| value.is_finite()).fold(0.0, |most, value| most.max(value.abs()));
            let columns = COLUMNS as f64 / extent.trips();
            (FieldValues::Grid(values), Some(columns).filter(|columns| *columns < MIN_COLUMNS))
        };
        Ok(FieldMap { rays, values, color_limit: round_above(greatest), coarse_columns })
    }
}

/// Returns the least number with one digit, or 1.2, 1.5 or 2.5, times a power of ten, that is not below a value; 0 for
/// 0.
fn round_above(value: f64) -> f64 {
    if value == 0.0 {
        return 0.0;
    }
    let power = 10f64.powf(value.log10().floor());
    let steps = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    steps.into_iter().map(|step| step * power).find(|step| *step >= value * (1.0 - 1e-9)).unwrap_or(value)
}

/// Returns a number as a double; NaN if its bound does not settle it.
pub(crate) fn settled(x: &Double) -> f64 {
    if x.log2_error() < f64::INFINITY { x.to_f64() } else { f64::NAN }
}

/// Distance in time, in round trips, at which a point on a front takes its value.
const ASIDE: f64 = 1e-6;

/// Returns the field at points `(t, x)`.
fn values_at(
    history: &TypedHistory<f64>,
    quantity: FieldQuantity,
    extent: &Extent,
    points: &[DVec2],
) -> Result<Vec<f64>, Error> {
    if extent.has_waves {
        let waves = history.waves()?;
        return Ok(points.iter().map(|point| quantity.of_field(waves.at(&point.y, &point.x))).collect());
    }
    // A damped rod answers in one march for points in the order of time.
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|a, b| points[*a].x.total_cmp(&points[*b].x));
    let rates = history.ask(
        |motion| {
            let end = motion.end();
            let place = |k: &usize| (end.double(points[*k].y), end.double(points[*k].x));
            let places: Vec<_> = order.iter().map(place).collect();
            match motion.rates(&places) {
                // A point on a front that only its bound tells from it takes the value beside it.
                Err(Error::Open(_) | Error::NotDecided { .. }) if extent.is_soft => {
                    let aside = end.double(ASIDE * extent.trip());
                    let one = |place: &(Double, Double)| motion.rates(std::slice::from_ref(place));
                    let beside = |(x, t): &(Double, Double)| one(&(x.clone(), t.clone() - &aside));
                    let rates = places.iter().map(|place| one(place).or_else(|_| beside(place)));
                    Ok(rates.collect::<Result<Vec<_>, _>>()?.concat())
                }
                rates => rates,
            }
        },
        |rates| rates.iter().flatten().collect(),
    )?;
    let mut values = vec![f64::NAN; points.len()];
    for (k, rates) in order.into_iter().zip(rates) {
        values[k] = settled(&quantity.of_rates(rates));
    }
    Ok(values)
}

/// Returns the field at the middles of the grid's cells, row by row from the ground up.
fn grid(history: &TypedHistory<f64>, quantity: FieldQuantity, extent: &Extent) -> Result<Vec<f64>, Error> {
    let middle = |k: usize, count: usize| (k as f64 + 0.5) / count as f64;
    let point = |k: usize| extent.point(middle(k % COLUMNS, COLUMNS), middle(k / COLUMNS, ROWS));
    values_at(history, quantity, extent, &(0..COLUMNS * ROWS).map(point).collect::<Vec<_>>())
}

impl FieldQuantity {
    fn of_field<S>(self, field: Field<S>) -> S {
        self.of_rates([field.velocity, field.strain])
    }

    /// Returns the quantity from `v_t` and `v_x`.
    fn of_rates<S>(self, [velocity, strain]: [S; 2]) -> S {
        match self {
            FieldQuantity::Stress | FieldQuantity::Strain => strain,
            FieldQuantity::Velocity => velocity,
        }
    }
}

/// Returns three points inside a convex polygon that are not on one line.
fn samples(corners: &[DVec2]) -> [DVec2; 3] {
    let middle = corners.iter().sum::<DVec2>() / corners.len() as f64;
    let first = corners[0] - middle;
    let apart = |corner: &&DVec2| first.perp_dot(**corner - middle).abs();
    let other = corners.iter().max_by(|a, b| apart(a).total_cmp(&apart(b))).copied().unwrap_or(middle);
    [middle, middle + 0.5 * first, middle.lerp(other, 0.5)]
}

/// Returns the gradient of a linear function from its differences along two vectors.
fn slope([a, b]: [DVec2; 2], [da, db]: [f64; 2]) -> DVec2 {
    DVec2::new(da * b.y - db * a.y, a.x * db - b.x * da) / a.perp_dot(b)
}

/// Rectangle `from ≤ t ≤ to`, `0 ≤ x ≤ L` that is drawn.
pub(crate) struct Extent {
    pub(crate) rod: Parameters<f64>,
    pub(crate) span: [f64; 2],
    /// Whether the rod is a body of a chain with springs, whose fronts are too steep for polygons.
    pub(crate) is_soft: bool,
    /// Whether two travelling waves describe the rod: it is undamped and by itself.
    pub(crate) has_waves: bool,
}

impl Extent {
    /// Returns the duration of a round trip.
    pub(crate) fn trip(&self) -> f64 {
        self.rod.round_trip()
    }

    fn is_damped(&self) -> bool {
        self.rod.damping > 0.0
    }

    /// Returns the number of round trips of the span.
    fn trips(&self) -> f64 {
        (self.span[1] - self.span[0]) / self.trip()
    }

    /// Returns the point `(t, x)` at these shares of the span and of the rod.
    fn point(&self, span_share: f64, rod_share: f64) -> DVec2 {
        let [from, to] = self.span;
        DVec2::new(from + (to - from) * span_share, self.rod.length * rod_share)
    }

    /// Returns the characteristics that bound the cells: the values of `t − x/c` for the delay 0, and those of
    /// `t + x/c` for the delay of a round trip, at the rays and at the corners of the rectangle. Neighbours are at most
    /// `width` apart.
    fn characteristics(&self, rays: &[Ray], delay: f64, width: Option<f64>) -> Vec<f64> {
        let ([from, to], half) = (self.span, 0.5 * self.trip());
        let (least, greatest) = if delay == 0.0 { (from - half, to) } else { (from, to + half) };
        let inner = rays.iter().filter(|ray| ray.legs[usize::from(delay > 0.0)]);
        let inner = inner.map(|ray| ray.departure + delay).filter(|value| *value > least && *value < greatest);
        let mut values: Vec<f64> = [least].into_iter().chain(inner).chain([greatest]).collect();
        values.dedup_by(|b, a| *b - *a < 1e-9 * self.trip());
        let Some(width) = width else { return values };
        let parts = |pair: &[f64]| {
            let (from, apart) = (pair[0], pair[1] - pair[0]);
            let count = (apart / width - 1e-9).ceil().max(1.0) as usize;
            (0..count).map(move |k| from + apart * k as f64 / count as f64)
        };
        values.windows(2).flat_map(parts).chain(values.last().copied()).collect()
    }

    /// Returns the part of each cell inside the rectangle; `None` if there are too many.
    fn polygons(&self, rising: &[f64], falling: &[f64]) -> Option<Vec<Vec<DVec2>>> {
        if rising.len() > MAX_POLYGONS {
            return None;
        }
        let corners = [(self.span[0], 0.0), (self.span[1], self.rod.length)].map(DVec2::from);
        let smallest = 0.5e-9 * self.rod.length * self.trip();
        let mut polygons = Vec::new();
        for xi in rising.windows(2) {
            let first = falling.partition_point(|eta| *eta <= xi[0]).saturating_sub(1);
            for eta in falling[first..].windows(2).take_while(|eta| eta[0] < xi[1] + self.trip()) {
                let corner = |xi: f64, eta: f64| DVec2::new(0.5 * (xi + eta), 0.5 * self.rod.wave_speed * (eta - xi));
                let cell = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(a, b)| corner(xi[a], eta[b]));
                let inside = clip::polygon(cell.to_vec(), corners);
                if clip::area(&inside).abs() >= smallest {
                    polygons.push(inside);
                }
                if polygons.len() > MAX_POLYGONS {
                    return None;
                }
            }
        }
        Some(polygons)
    }
}

#[cfg(test)]
#[path = "tests/field.rs"]
mod tests;
