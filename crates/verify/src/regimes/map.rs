//! The map of regimes over the two numbers that decide how the first contact ends: `R = r t₁` and `M = μ/(g t₁)`.

use rayon::prelude::*;
use std::collections::BTreeMap;

use glam::DVec2;

use super::contour::{Edge, crossed, loops};
use super::grid::{Axis, Grid, GridError, values};
use crate::paper::formulas::ThresholdRatio;
use dalembert::Ending;
use dalembert::engine::{Bounce, FirstContact, Kernels, Motion};
use dalembert::number::{Estimate, Number, Scalar, short};
use dalembert::problem::{Parameter, Parameters, Problem, Written};
use dalembert::solve::{Engine, Numbers, Plan, Question, Rung};

/// The end of a first contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Regime {
    /// A bounce after this many round trips, `t_b/t₁`.
    Bounce(f64),
    /// No bounce, as is proved.
    Never,
    /// Neither is shown.
    Undecided,
}

/// The regimes over a grid of `R` and `M`.
#[derive(Debug)]
pub struct Map {
    /// `R` of the columns.
    pub damping: Vec<Number>,
    /// `M` of the rows.
    pub speed: Vec<Number>,
    /// The regimes, row by row.
    pub regimes: Vec<Regime>,
    /// The outlines of the bands for a picture, which [`Map::with_regions`] finds: closed lines about each band and all
    /// before it, in steps of the grid.
    pub regions: Vec<Vec<Vec<DVec2>>>,
}

/// The upper ends of the bands of a map, `t_b/t₁`, in order.
pub const BANDS: [f64; 8] = [1.0, 1.25, 1.5, 1.75, 2.0, 3.0, 4.0, f64::INFINITY];

impl Regime {
    /// Returns the index of its band in [`BANDS`]; the next index without a bounce, the one after it where undecided.
    fn band(self) -> usize {
        match self {
            Regime::Bounce(time) => BANDS.iter().position(|most| time <= *most).unwrap_or(BANDS.len() + 1),
            Regime::Never => BANDS.len(),
            Regime::Undecided => BANDS.len() + 1,
        }
    }
}

impl Map {
    /// Computes the map for the ranges `damping` of R and `speed` of M, in the grammar of [`Axis`]. It is the same for
    /// any number of threads; `done` is called after each point.
    ///
    /// ```
    /// use dalembert_verify::regimes::{Map, Regime};
    /// let map = Map::new("0,4", "0.5,2", &|| ())?;
    /// // Corollary 1 for R = 0: t_b/t₁ = 2 − M = 3/2, and 1 from M = 1 on. From R = π on there is no bounce.
    /// assert_eq!(map.regimes, [Regime::Bounce(1.5), Regime::Never, Regime::Bounce(1.0), Regime::Never]);
    /// # Ok::<(), dalembert_verify::regimes::GridError>(())
    /// ```
    pub fn new(damping: &str, speed: &str, done: &(dyn Fn() + Sync)) -> Result<Self, GridError> {
        let rod = unit_rod();
        let axis = |parameter, text| Ok::<_, GridError>(Axis { parameter, values: values(text)? });
        let grid = Grid::new(vec![axis(Parameter::ImpactSpeed, speed)?, axis(Parameter::Damping, damping)?])?;
        for (axis, least) in grid.axes.iter().zip([f64::MIN_POSITIVE, 0.0]) {
            let values: Vec<f64> = axis.values.iter().map(Number::to_f64).collect();
            if values.len() < 2 || values[0] < least || !values.is_sorted_by(|a, b| a < b) {
                let found = axis.values.iter().map(Number::to_string).collect::<Vec<_>>().join(",");
                return Err(GridError::NotIncreasing(short(&found)));
            }
        }
        let [speeds, dampings] = [0, 1].map(|k: usize| grid.axes[k].values.clone());
        let parts: Vec<&[Number]> = speeds.chunks(SHARING).collect();
        let part = |k: usize| {
            let kernels = Kernels::default();
            let regime = |speed| {
                let regime = regime(&rod, &dampings[k / parts.len()], speed, &kernels);
                done();
                regime
            };
            parts[k % parts.len()].iter().map(regime).collect::<Vec<_>>()
        };
        let columns: Vec<Vec<Regime>> = (0..dampings.len() * parts.len()).into_par_iter().map(part).collect();
        let columns = columns.concat();
        let rows = (0..speeds.len()).flat_map(|row| columns.iter().skip(row).step_by(speeds.len()).copied());
        let regimes = rows.collect();
        Ok(Map { regimes, damping: dampings, speed: speeds, regions: Vec::new() })
    }

    /// Finds [`Map::regions`]. Between two points in different bands the edge is halved until the border is known to
    /// one part in `FINE` of the picture; `done` is called after each edge.
    pub fn with_regions(self, done: &(dyn Fn() + Sync)) -> Self {
        let (across, up) = (self.damping.len(), self.speed.len());
        let (dampings, speeds) = (CellAxis::new(&self.damping), CellAxis::new(&self.speed));
        let rod = unit_rod();
        let band_at = |steps: DVec2, kernels: &Kernels<Estimate<f64>>| {
            let (r, m) = (dampings.number(steps.x, &self.damping), speeds.number(steps.y, &self.speed));
            regime(&rod, &r, &m, kernels).band()
        };
        // The nodes: the points of the map, about them the border of the picture, about it a ring outside of all bands.
        let size = [across + 4, up + 4];
        let steps = |k: usize, count: usize| (k as f64 - 1.5).clamp(0.0, count as f64);
        let place = |[x, y]: [usize; 2]| DVec2::new(steps(x, across), steps(y, up));
        let column = |x: usize| {
            let kernels = Kernels::default();
            let band = |y: usize| match [x, y] {
                _ if x == 0 || y == 0 || x + 1 == size[0] || y + 1 == size[1] => OUTSIDE,
                _ if (2..across + 2).contains(&x) && (2..up + 2).contains(&y) => {
                    self.regimes[(y - 2) * across + x - 2].band()
                }
                node => band_at(place(node), &kernels),
            };
            (0..size[1]).map(band).collect::<Vec<_>>()
        };
        let bands: Vec<Vec<usize>> = (0..size[0]).into_par_iter().map(column).collect();
        let halvings = (FINE / across.max(up) as f64).log2().ceil().max(2.0) as usize;
        let crossing = |[a, b]: Edge, level: usize| {
            let [band_a, band_b] = [a, b].map(|[x, y]| bands[x][y]);
            let (mut inside, mut outside) = if band_a <= level { (place(a), place(b)) } else { (place(b), place(a)) };
            if [band_a, band_b].contains(&OUTSIDE) {
                return inside;
            }
            // The kernels belong to one damping.
            let mut kernels = Kernels::default();
            for _ in 0..halvings {
                let middle = inside.midpoint(outside);
                if a[0] != b[0] {
                    kernels = Kernels::default();
                }
                *(if band_at(middle, &kernels) <= level { &mut inside } else { &mut outside }) = middle;
            }
            inside.midpoint(outside)
        };
        let region = |level: usize| {
            let is_inside = |[x, y]: [usize; 2]| bands[x][y] <= level;
            let edges = crossed(size, &is_inside);
            let found = |edge: &Edge| {
                let crossing = crossing(*edge, level);
                done();
                (*edge, crossing)
            };
            let crossings: BTreeMap<Edge, DVec2> = edges.par_iter().map(found).collect();
            let lines = loops(&edges, &is_inside).into_iter();
            lines.map(|line| line.into_iter().map(|edge| crossings[&edge]).collect()).collect()
        };
        let regions = (0..=BANDS.len()).map(region).collect();
        Map { regions, ..self }
    }
}

/// Band of the nodes outside of the picture.
const OUTSIDE: usize = usize::MAX;
/// Number of parts of the longer side of a picture that no eye tells apart.
const FINE: f64 = 4096.0;

/// An axis of a picture: each value is the middle of a cell, and all cells are equally wide, in the values or in their
/// logarithms.
pub struct CellAxis {
    /// Whether the cells are equally wide in the logarithms.
    pub log: bool,
    first: f64,
    step: f64,
}

impl CellAxis {
    /// Builds the axis of `values`, logarithmic where that is nearer to the middle value.
    pub fn new(values: &[Number]) -> Self {
        let value = |k: usize| values.get(k).map_or(0.0, Number::to_f64);
        let last = values.len().saturating_sub(1);
        let (from, middle, to) = (value(0), value(values.len() / 2), value(last));
        let place = (values.len() / 2) as f64 / last.max(1) as f64;
        let log = from > 0.0 && to > 0.0 && {
            let (straight, geometric) = (from + (to - from) * place, from * (to / from).powf(place));
            (middle / geometric).ln().abs() < (middle / straight).ln().abs()
        };
        let [from, to] = [from, to].map(|end| if log { end.ln() } else { end });
        CellAxis { log, first: from, step: (to - from) / last.max(1) as f64 }
    }

    /// Returns the value at `steps` cells beyond the lower border of the first cell.
    pub fn border(&self, steps: f64) -> f64 {
        let place = self.first + self.step * (steps - 0.5);
        if self.log { place.exp() } else { place }
    }

    /// Interpolates `values` at `steps` cells beyond the lower border; the result is not below zero.
    fn number(&self, steps: f64, values: &[Number]) -> Number {
        let (below, share) = ((steps - 0.5).floor(), (steps - 0.5).fract());
        let value = match (values.get(below as usize), values.get(below as usize + 1)) {
            _ if below < 0.0 => self.border(steps).max(0.0),
            (Some(a), _) if share == 0.0 => return a.clone(),
            (Some(a), Some(b)) if self.log => a.to_f64() * (b.to_f64() / a.to_f64()).powf(share),
            (Some(a), Some(b)) => a.to_f64() + share * (b.to_f64() - a.to_f64()),
            _ => self.border(steps),
        };
        Written::from(value).number().cloned().unwrap_or_else(|_| 0.into())
    }
}

/// Builds the rod with `t₁ = g = 1`, for which `R = r` and `M = μ`.
fn unit_rod() -> Problem {
    Problem::uniform(1.into(), 2.into(), 1.into(), 1.into())
}

/// Maximum number of speeds of one damping that share its kernels.
const SHARING: usize = 256;

/// Computes the regime of a point by its plan. Where the plan takes the closed form, all points of a damping share its
/// kernels.
fn regime(rod: &Problem, damping: &Number, speed: &Number, kernels: &Kernels<Estimate<f64>>) -> Regime {
    let Ok(problem) = rod.to_builder().damping(damping).impact_speed(speed).build() else { return Regime::Undecided };
    let Ok(plan) = Plan::of(&problem, &Question::bounce(Numbers::default())) else { return Regime::Undecided };
    if (plan.engine, plan.rung) == (Engine::ClosedForm, Rung::Double)
        && let Ok(rod) = Parameters::<Estimate<f64>>::of(&problem, &())
    {
        let exact = 10f64.powf(-plan.goal.digits);
        match FirstContact::new(&rod).bounce_sharing(kernels) {
            Bounce::At { time, .. } if time.bound() <= exact * time.value() => return Regime::Bounce(*time.value()),
            Bounce::Never(_) => return Regime::Never,
            _ => {}
        }
    }
    by_plan(&problem, &plan)
}

/// Computes the regime of a problem by `plan`.
fn by_plan(problem: &Problem, plan: &Plan) -> Regime {
    let query = |motion: &dyn Motion<Estimate<f64>>| {
        let end = motion.contact_times(0).and_then(|(_, end)| end);
        Ok((end, matches!(motion.ending(), Ending::NoBounce(_))))
    };
    match plan.ask::<f64, _>(problem, query, |(end, _)| end.iter().collect()) {
        Ok((Some(time), _)) => Regime::Bounce(time.into_value()),
        Ok((None, true)) => Regime::Never,
        _ => Regime::Undecided,
    }
}

/// Computes the `M` above which the bounce comes at `t₁`, (2.32) in closed form: `(I₀(R) + I₁(R))/(2 − I₀(R))`; `None`
/// from `I₀(R) = 2` on.
pub fn threshold(damping_ratio: &Estimate<f64>) -> Option<Estimate<f64>> {
    let ThresholdRatio { numerator, denominator } = ThresholdRatio::new(damping_ratio);
    (denominator.positive() == Ok(true)).then(|| numerator / denominator)
}

/// Returns the double nearest to [`threshold`]; infinite where there is none.
pub fn threshold_near(damping_ratio: f64) -> f64 {
    threshold(&Estimate::exact(damping_ratio)).map_or(f64::INFINITY, Estimate::into_value)
}

#[cfg(test)]
#[path = "tests/map.rs"]
mod tests;
