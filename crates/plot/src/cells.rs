//! The field along the rod over time: polygons of characteristic cells, in which nothing jumps.

use glam::DVec2;

use super::picture::Along;
use crate::draw::{Piece, clip};
use dalembert::Error;
use dalembert::number::Scalar;
use dalembert::problem::Parameters;
use dalembert::solve::{Target, TypedHistory};
use dalembert::{Field, Side};

/// More rays than this are not drawn, and their jumps not looked up.
pub(super) const MOST_RAYS: usize = 300;

/// A ray, by the time at which it leaves the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Break {
    pub time: f64,
    /// Whether the field jumps across it; otherwise only its slope.
    pub jump: bool,
    /// Its jump, as a share of the greatest.
    pub share: f64,
}

#[derive(Clone, Debug)]
pub struct Cells {
    pub breaks: Vec<Break>,
    pub values: Values,
    /// A round number that no absolute value is above: where the colours end.
    pub greatest: f64,
    /// Round trips of the span.
    trips: f64,
}

#[derive(Clone, Debug)]
pub enum Values {
    /// Polygons in `(t, x)`, in each of which the field is taken as linear.
    Linear(Vec<Piece>),
    /// Values at the middles of rectangles, so many along the time, from the ground up, row by row.
    Grid(usize, Vec<f64>),
}

/// More polygons are not drawn: a grid takes their place.
const MOST_CELLS: usize = 6000;
/// Where a field is curved a cell is cut into parts that are no wider than this share of a round trip.
const PARTS: f64 = 10.0;
/// So many columns and rows.
const GRID: [usize; 2] = [480, 96];
/// With fewer columns a round trip its waves are not told apart.
const FEW_COLUMNS: f64 = 8.0;

/// The polygons of a field and its values, in units of `1/factor`.
///
/// **Source**: between the rays of an undamped rod velocity and strain are linear in `x` and `t` (d'Alembert), and a
/// cell is one polygon. Between those of a damped rod they are smooth, and a cell is cut into parts.
pub fn of<S: Target>(
    history: &TypedHistory<S>,
    (along, factor): (Along, f64),
    strip: &Strip,
    breaks: Vec<Break>,
) -> Result<Cells, Error> {
    let fine = strip
        .is_damped()
        .then(|| strip.trip / PARTS.min((4.0 * MOST_CELLS as f64 / (strip.trips() * 16.0)).sqrt()).max(2.0));
    let [rising, falling] = [0.0, strip.trip].map(|late| strip.knots(&breaks, late, fine));
    let mut greatest = 0.0f64;
    let values = match strip.polygons(&rising, &falling) {
        Some(polygons) => {
            let points: Vec<DVec2> = polygons.iter().flat_map(|polygon| samples(polygon)).collect();
            let values =
                ask(history, along, strip, &points)?.into_iter().map(|value| factor * value).collect::<Vec<_>>();
            let pieces = polygons.into_iter().zip(values.chunks(3)).zip(points.chunks(3));
            let pieces = pieces.filter(|((_, values), _)| values.iter().all(|value| value.is_finite()));
            Values::Linear(
                pieces
                    .into_iter()
                    .map(|((corners, values), at)| {
                        let slope =
                            slope([at[1] - at[0], at[2] - at[0]], [values[1] - values[0], values[2] - values[0]]);
                        let ends = corners.iter().map(|corner| (values[0] + slope.dot(*corner - at[0])).abs());
                        greatest = ends.fold(greatest, f64::max);
                        Piece { corners, at: at[0], middle: values[0], slope }
                    })
                    .collect::<Vec<_>>(),
            )
        }
        None => {
            let values = grid(history, along, strip)?.into_iter().map(|value| factor * value).collect::<Vec<_>>();
            greatest = values.iter().filter(|value| value.is_finite()).fold(0.0, |most, value| most.max(value.abs()));
            Values::Grid(GRID[0], values)
        }
    };
    Ok(Cells { breaks, values, greatest: round_above(greatest), trips: strip.trips() })
}

/// The next number with one or two digits from which colours can begin; 0 for 0.
fn round_above(value: f64) -> f64 {
    if value == 0.0 {
        return 0.0;
    }
    let power = 10f64.powf(value.log10().floor());
    let steps = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    steps.into_iter().map(|step| step * power).find(|step| *step >= value * (1.0 - 1e-9)).unwrap_or(value)
}

/// A number as a double; NaN where its bound or enclosure leaves it open.
pub(super) fn settled<S: Scalar>(x: &S) -> f64 {
    if x.log2_error() < f64::INFINITY { x.to_f64() } else { f64::NAN }
}

fn ask<S: Target>(history: &TypedHistory<S>, along: Along, strip: &Strip, points: &[DVec2]) -> Result<Vec<f64>, Error> {
    if !strip.is_damped() {
        let waves = history.waves()?.map(|x| x.to_f64());
        return Ok(points.iter().map(|point| along.part(waves.at(&point.y, &point.x))).collect());
    }
    let values = history.ask(
        |motion| {
            let like = motion.end();
            let value = |point: &DVec2| {
                Ok(along.part(motion.field(&like.double(point.y), &like.double(point.x), Side::Right)?))
            };
            points.iter().map(value).collect::<Result<Vec<_>, _>>()
        },
        |values| values.iter().collect::<Vec<_>>(),
    )?;
    Ok(values.iter().map(settled).collect::<Vec<_>>())
}

/// Values at the middles of the grid, from the ground up, row by row.
fn grid<S: Target>(history: &TypedHistory<S>, along: Along, strip: &Strip) -> Result<Vec<f64>, Error> {
    let [across, up] = GRID;
    let middle = |k: usize, count: usize| (k as f64 + 0.5) / count as f64;
    if !strip.is_damped() {
        let place = |k: usize| strip.place(middle(k % across, across), middle(k / across, up));
        return ask(history, along, strip, &(0..across * up).map(place).collect::<Vec<_>>());
    }
    let found = history.ask(
        |motion| {
            let like = motion.end();
            let points: Vec<_> = (0..up).map(|k| like.double(strip.place(0.0, middle(k, up)).y)).collect();
            let times: Vec<_> = (0..across).map(|k| like.double(strip.place(middle(k, across), 0.0).x)).collect();
            motion.rates(&points, &times)
        },
        |rates| rates.iter().flatten().collect(),
    )?;
    let value = |k: usize| {
        let [velocity, strain] = &found[(k % across) * up + k / across];
        settled(if along == Along::Velocity { velocity } else { strain })
    };
    Ok((0..across * up).map(value).collect())
}

impl Cells {
    /// How many columns of the grid a round trip has, where they are too few to show its waves.
    pub fn coarse(&self) -> Option<f64> {
        let columns = GRID[0] as f64 / self.trips;
        (matches!(self.values, Values::Grid(..)) && columns < FEW_COLUMNS).then_some(columns)
    }
}

impl Along {
    fn part<S>(self, field: Field<S>) -> S {
        match self {
            Along::Stress | Along::Strain => field.strain,
            Along::Velocity => field.velocity,
        }
    }
}

/// Three points inside of a convex polygon that are not on one line.
fn samples(corners: &[DVec2]) -> [DVec2; 3] {
    let middle = corners.iter().sum::<DVec2>() / corners.len() as f64;
    let first = corners[0] - middle;
    let apart = |corner: &&DVec2| first.perp_dot(**corner - middle).abs();
    let other = corners.iter().max_by(|a, b| apart(a).total_cmp(&apart(b))).copied().unwrap_or(middle);
    [middle, middle + 0.5 * first, middle.lerp(other, 0.5)]
}

/// The slope of a linear function with these differences in these directions.
fn slope([a, b]: [DVec2; 2], [da, db]: [f64; 2]) -> DVec2 {
    DVec2::new(da * b.y - db * a.y, a.x * db - b.x * da) / a.perp_dot(b)
}

/// The rod over the span: `from ≤ t ≤ to`, `0 ≤ x ≤ L`.
pub(super) struct Strip {
    pub(super) rod: Parameters<f64>,
    pub(super) span: [f64; 2],
    pub(super) trip: f64,
}

impl Strip {
    pub(super) fn is_damped(&self) -> bool {
        self.rod.damping > 0.0
    }

    fn trips(&self) -> f64 {
        (self.span[1] - self.span[0]) / self.trip
    }

    fn place(&self, across: f64, up: f64) -> DVec2 {
        let [from, to] = self.span;
        DVec2::new(from + (to - from) * across, self.rod.length * up)
    }

    /// The values of `t ∓ x/c` at the rays, so much `late`, and at the ends of the strip; no two farther apart than
    /// `fine`.
    fn knots(&self, breaks: &[Break], late: f64, fine: Option<f64>) -> Vec<f64> {
        let ([from, to], half) = (self.span, 0.5 * self.trip);
        let (least, most) = if late == 0.0 { (from - half, to) } else { (from, to + half) };
        let inner = breaks.iter().map(|ray| ray.time + late).filter(|knot| *knot > least && *knot < most);
        let mut knots: Vec<f64> = [least].into_iter().chain(inner).chain([most]).collect();
        knots.dedup_by(|b, a| *b - *a < 1e-9 * self.trip);
        let Some(fine) = fine else { return knots };
        let parts = |pair: &[f64]| {
            let (from, width) = (pair[0], pair[1] - pair[0]);
            let count = (width / fine - 1e-9).ceil().max(1.0) as usize;
            (0..count).map(move |k| from + width * k as f64 / count as f64)
        };
        knots.windows(2).flat_map(parts).chain(knots.last().copied()).collect()
    }

    /// What of each cell lies in the strip; `None` where there are too many.
    fn polygons(&self, up: &[f64], down: &[f64]) -> Option<Vec<Vec<DVec2>>> {
        if up.len() > MOST_CELLS {
            return None;
        }
        let mut polygons = Vec::new();
        for xi in up.windows(2) {
            let first = down.partition_point(|eta| *eta <= xi[0]).saturating_sub(1);
            for eta in down[first..].windows(2).take_while(|eta| eta[0] < xi[1] + self.trip) {
                let corner = |xi: f64, eta: f64| DVec2::new(0.5 * (xi + eta), 0.5 * self.rod.wave_speed * (eta - xi));
                let cell = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(a, b)| corner(xi[a], eta[b]));
                let inside = self.clipped(cell.to_vec());
                if !inside.is_empty() {
                    polygons.push(inside);
                }
                if polygons.len() > MOST_CELLS {
                    return None;
                }
            }
        }
        Some(polygons)
    }

    /// What of a convex polygon lies in the strip; empty where that is nothing.
    fn clipped(&self, polygon: Vec<DVec2>) -> Vec<DVec2> {
        let ([from, to], length) = (self.span, self.rod.length);
        let polygon = clip::polygon(polygon, [DVec2::new(from, 0.0), DVec2::new(to, length)]);
        let none = 2.0 * clip::area(&polygon).abs() < 1e-9 * length * self.trip;
        if none { Vec::new() } else { polygon }
    }
}

#[cfg(test)]
#[path = "tests/cells.rs"]
mod tests;
