//! How the first contact ends, over the two numbers that decide it: `R = r t₁` and `M = μ/(g t₁)`.

use rayon::prelude::*;
use std::collections::BTreeMap;

use glam::DVec2;

use super::contour::{Edge, crossed, loops};
use super::grid::{Axis, Grid, SweepError, values};
use dalembert::Ending;
use dalembert::engine::Motion;
use dalembert::engine::{Bounce, FirstContact, Kernels};
use dalembert::number::{Analytic, Estimate, Number, Scalar};
use dalembert::problem::{Parameter, Parameters, Problem, Speed, Start};
use dalembert::solve::{Engine, Numbers, Plan, Question, Rung};
use dalembert::special::{i0_scaled, i1_scaled};
use dalembert::{number::short, problem::Written};

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Regime {
    /// With a bounce at so many round trips, `t_b/t₁`.
    Bounce(f64),
    Never,
    /// Neither is shown.
    Undecided,
}

/// The regimes over a grid, `M` by rows and `R` along them.
#[derive(Debug)]
pub struct Map {
    pub damping: Vec<Number>,
    pub speed: Vec<Number>,
    pub regimes: Vec<Regime>,
    /// For a picture, once [`Map::with_regions`] has found them: of each band the closed lines about it and all before
    /// it, in steps of the grid.
    pub regions: Vec<Vec<Vec<DVec2>>>,
}

/// The `t_b/t₁` up to which each band of a map reaches, in order.
pub const BANDS: [f64; 8] = [1.0, 1.25, 1.5, 1.75, 2.0, 3.0, 4.0, f64::INFINITY];

impl Regime {
    /// The place of its band in [`BANDS`]; after these that without a bounce, and what is not decided.
    pub fn band(self) -> usize {
        match self {
            Regime::Bounce(time) => BANDS.iter().position(|most| time <= *most).unwrap_or(BANDS.len() + 1),
            Regime::Never => BANDS.len(),
            Regime::Undecided => BANDS.len() + 1,
        }
    }
}

impl Map {
    /// The map for the ranges `damping` of R and `speed` of M, as [`Axis`] has them: a rod with `t₁ = g = 1` has `R =
    /// r` and `M = μ`. It is the same for any number of threads; `done` is called after each point.
    pub fn new(damping: &str, speed: &str, done: &(dyn Fn() + Sync)) -> Result<Self, SweepError> {
        let rod = unit_rod();
        let axis = |parameter, text| Ok::<_, SweepError>(Axis { parameter, values: values(text)? });
        let grid =
            Grid::new(rod.clone(), vec![axis(Parameter::ImpactSpeed, speed)?, axis(Parameter::Damping, damping)?])?;
        // Before any point is solved.
        for (axis, least) in grid.axes.iter().zip([f64::MIN_POSITIVE, 0.0]) {
            let values: Vec<f64> = axis.values.iter().map(Number::to_f64).collect();
            if values.len() < 2 || values[0] < least || !values.is_sorted_by(|a, b| a < b) {
                let found = axis.values.iter().map(Number::to_string).collect::<Vec<_>>().join(",");
                let expected = "two values or more that increase, R from zero and M from above zero";
                return Err(SweepError::new(format!("the values {}", short(&found)), expected));
            }
        }
        let [speeds, dampings] = [0, 1].map(|k: usize| grid.axes[k].values.clone());
        let parts: Vec<&[Number]> = speeds.chunks(SHARING).collect();
        let columns = (0..dampings.len() * parts.len())
            .into_par_iter()
            .map(|k| {
                let kernels = Kernels::default();
                let mut regimes = Vec::with_capacity(SHARING);
                for speed in parts[k % parts.len()] {
                    regimes.push(regime(&rod, &dampings[k / parts.len()], speed, &kernels));
                    done();
                }
                Ok(regimes)
            })
            .collect::<Result<Vec<_>, _>>()?;
        let columns: Vec<Regime> = columns.concat();
        let rows = (0..speeds.len()).flat_map(|row| columns.iter().skip(row).step_by(speeds.len()).copied());
        let regimes = rows.collect();
        Ok(Map { regimes, damping: dampings, speed: speeds, regions: Vec::new() })
    }

    /// The same with [`Map::regions`]. Between two points in different bands each edge is halved until it is known to
    /// some part of [`FINE`] of the picture; `done` is called after each edge.
    pub fn with_regions(self, done: &(dyn Fn() + Sync)) -> Self {
        let (dampings, speeds) = (Spread::of(&self.damping), Spread::of(&self.speed));
        let (across, up) = (self.damping.len(), self.speed.len());
        let rod = unit_rod();
        let regime_at = |at: DVec2, kernels: &Kernels<Estimate<f64>>| {
            regime(&rod, &dampings.number(at.x, &self.damping), &speeds.number(at.y, &self.speed), kernels).band()
        };
        // The points, about them those on the border of the picture, about these a ring that is in no band.
        let size = [across + 4, up + 4];
        let steps = |k: usize, count: usize| (k as f64 - 1.5).clamp(0.0, count as f64);
        let place = |node: [usize; 2]| DVec2::new(steps(node[0], across), steps(node[1], up));
        let Ok(bands) = (0..size[0])
            .into_par_iter()
            .map(|column| {
                let kernels = Kernels::default();
                let band = |row: usize| match [column, row] {
                    [x, y] if x == 0 || y == 0 || x + 1 == size[0] || y + 1 == size[1] => usize::MAX,
                    [x, y] if (2..across + 2).contains(&x) && (2..up + 2).contains(&y) => {
                        self.regimes[(y - 2) * across + x - 2].band()
                    }
                    node => regime_at(place(node), &kernels),
                };
                Ok::<_, std::convert::Infallible>((0..size[1]).map(band).collect::<Vec<_>>())
            })
            .collect::<Result<Vec<_>, _>>();
        let mut regions = Vec::new();
        for level in 0..=BANDS.len() {
            let inside = |[x, y]: [usize; 2]| bands[x][y] <= level;
            let edges = crossed(size, &inside);
            let Ok(crossings) = (0..edges.len())
                .into_par_iter()
                .map(|k| {
                    let [a, b] = edges[k];
                    // One damping has one set of kernels.
                    let mut kernels = Kernels::default();
                    let (mut within, mut beyond) = if inside(a) { (place(a), place(b)) } else { (place(b), place(a)) };
                    // The ring lies on the border.
                    let outer = [a, b].map(|[x, y]| bands[x][y]).contains(&usize::MAX);
                    let halvings = (FINE / across.max(up) as f64).log2().ceil().max(2.0) as usize;
                    for _ in 0..if outer { 0 } else { halvings } {
                        let point = within.midpoint(beyond);
                        if a[0] != b[0] {
                            kernels = Kernels::default();
                        }
                        *(if regime_at(point, &kernels) <= level { &mut within } else { &mut beyond }) = point;
                    }
                    done();
                    Ok::<_, std::convert::Infallible>(if outer { within } else { within.midpoint(beyond) })
                })
                .collect::<Result<Vec<_>, _>>();
            let of: BTreeMap<Edge, DVec2> = edges.iter().copied().zip(crossings).collect();
            regions.push(
                loops(&edges, &inside)
                    .into_iter()
                    .map(|line| line.into_iter().map(|edge| of[&edge]).collect())
                    .collect(),
            );
        }
        Map { regions, ..self }
    }
}

/// Parts of the longer side of a picture that no eye tells apart.
const FINE: f64 = 4096.0;

/// Values of an axis as middles of equal parts of it, in themselves or in their logarithms.
pub struct Spread {
    pub log: bool,
    first: f64,
    step: f64,
}

impl Spread {
    pub fn of(values: &[Number]) -> Self {
        let value = |k: usize| values.get(k).map_or(0.0, Number::to_f64);
        let last = values.len().saturating_sub(1);
        let (from, middle, to) = (value(0), value(values.len() / 2), value(last));
        let place = (values.len() / 2) as f64 / last.max(1) as f64;
        let log = from > 0.0 && to > 0.0 && {
            let (straight, geometric) = (from + (to - from) * place, from * (to / from).powf(place));
            (middle / geometric).ln().abs() < (middle / straight).ln().abs()
        };
        let [from, to] = [from, to].map(|end| if log { end.ln() } else { end });
        Spread { log, first: from, step: (to - from) / last.max(1) as f64 }
    }

    /// What lies so many steps beyond the lower border of the first part.
    pub fn border(&self, steps: f64) -> f64 {
        let place = self.first + self.step * (steps - 0.5);
        if self.log { place.exp() } else { place }
    }

    /// The value so many steps beyond the lower border, between the values that it lies between; not below zero.
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

/// The rod with `t₁ = g = 1`.
fn unit_rod() -> Problem {
    Problem::uniform(1.into(), 2.into(), 1.into(), 1.into())
}

/// Speeds of one damping that share its kernels.
const SHARING: usize = 256;

/// The regime of a point, as its plan has it: all points of a damping share its kernels where that is the closed form.
fn regime(rod: &Problem, damping: &Number, speed: &Number, kernels: &Kernels<Estimate<f64>>) -> Regime {
    let mut problem = rod.clone();
    problem.rod.damping = Some(damping.clone()).filter(|damping| !damping.is_zero());
    problem.start = Start::Uniform(Speed::Given(speed.clone()));
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

/// The `M` above which the bounce comes at `t₁`, (2.32) in closed form: `(I₀(R) + I₁(R))/(2 − I₀(R))`; none from
/// `I₀(R) = 2` on.
pub fn threshold(damping_ratio: &Estimate<f64>) -> Option<Estimate<f64>> {
    let (i0, i1) = (i0_scaled(damping_ratio), i1_scaled(damping_ratio));
    let below = (-damping_ratio.clone()).exp() * damping_ratio.int(2) - &i0;
    (below.positive() == Ok(true)).then(|| (i0 + i1) / below)
}

/// The double next to [`threshold`]; infinite where there is none.
pub fn threshold_near(damping_ratio: f64) -> f64 {
    threshold(&Estimate::exact(damping_ratio)).map_or(f64::INFINITY, Estimate::into_value)
}

#[cfg(test)]
#[path = "tests/regimes.rs"]
mod tests;
