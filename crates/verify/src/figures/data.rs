//! The numbers of the figures.

use rayon::prelude::*;

use super::{Figure, FigureKind};
use crate::error::VerifyError;
use crate::paper::formulas::restitution_limit;
use crate::regimes::{Axis, Grid, Map, threshold_near};
use dalembert::engine::{FirstContact, Motion};
use dalembert::number::{Analytic, Estimate, Scalar};
use dalembert::problem::{Parameters, Problem, Run};
use dalembert::quantity::{Restitution, energy_shares, restitution};
use dalembert::solve::{Numbers, Plan, Question};
use dalembert::{Error, Side};

/// The values of `r` in Figures 4–7, where `c = L = g = 1`.
pub const DAMPINGS: [&str; 4] = ["0", "0.1", "0.2", "0.3"];
/// The values of `r` in Figure 1.
pub const HELD_DAMPINGS: [&str; 3] = ["2.6", "2.9", "3.0"];
/// Number of points of Figure 1 in each round trip.
const PER_TRIP: i32 = 100;
/// Accuracy of the figures, relative to a number or to 1. The last digit printed is at most twenty times the bound, so
/// that a printed number is right to 1e-12.
const ACCURACY: f64 = 9e-14;
/// Accuracy of Figure 4: the bound of doubles is some 1e-11 at the later bounces, and the CSV prints no digit beyond
/// it.
const RESTITUTION_ACCURACY: f64 = 1e-10;

/// The numbers of a figure: columns by name and rows in order, or a map.
#[derive(Debug, Default)]
pub struct FigureData {
    /// The names of the columns.
    pub columns: Vec<&'static str>,
    /// The rows; a number that is not defined is `None`.
    pub rows: Vec<Row>,
    /// The map of [`FigureKind::Regimes`], in place of rows.
    pub map: Option<Map>,
}

type Double = Estimate<f64>;
/// The numbers of one row, with their bounds.
type Row = Vec<Option<Double>>;

impl FigureData {
    /// Computes the numbers of `figure`.
    ///
    /// **Accuracy**: *within its own bound*, which is at most 1e-10 for Figure 4, 1e-9 for the tenth bounce and 1e-13
    /// for the others, relative to the numbers or to 1.
    ///
    /// ```
    /// use dalembert_verify::figures::{FIGURES, FigureData};
    /// // Figure 8 has the corners of its regions: x − c t₁ = −3/2 is one for L = c = 1, x = 1/2, t₁ = 2.
    /// let data = FigureData::new(&FIGURES[7])?;
    /// assert_eq!(data.values()[0], [Some(1.0), Some(-1.5), Some(0.0)]);
    /// # Ok::<(), dalembert_verify::VerifyError>(())
    /// ```
    pub fn new(figure: &Figure) -> Result<Self, VerifyError> {
        let (columns, rows) = match figure.kind {
            FigureKind::HeldStress => held_stresses()?,
            FigureKind::VibrationalEnergy | FigureKind::EnergyShares => energies()?,
            FigureKind::Restitution => restitutions()?,
            FigureKind::TranslationalShare | FigureKind::EnergyKept | FigureKind::EnergyOverDecay => {
                shares(figure.kind)?
            }
            FigureKind::IntegrationRegions => regions(),
            FigureKind::TenthBounce => tenth_bounces()?,
            FigureKind::Regimes => {
                let map = Map::new("0..4:240", "0.05..1e4:240:log", &|| ())?.with_regions(&|| ());
                return Ok(FigureData { map: Some(map), ..FigureData::default() });
            }
        };
        Ok(FigureData { columns, rows, map: None })
    }

    /// Returns the numbers without their bounds.
    pub fn values(&self) -> Vec<Vec<Option<f64>>> {
        let plain = |number: &Option<Double>| number.as_ref().map(|number| *number.value());
        self.rows.iter().map(|row| row.iter().map(plain).collect()).collect()
    }
}

type Columns = (Vec<&'static str>, Vec<Row>);

/// Computes Figures 2 and 3: both energies at the bounce, and their shares of `E(0)`.
fn energies() -> Result<Columns, VerifyError> {
    let grid = grid("0", "0.01..8:800")?;
    let bounces = bounces(&grid, ENERGIES, ACCURACY)?;
    let rows = speeds(&grid).into_iter().zip(bounces).map(|(speed, Bounce { time, values: energies })| {
        let whole = speed.clone() * &speed / speed.int(2);
        let shares = energies.clone().map(|energy| energy.map(|energy| energy / &whole));
        [Some(speed), time].into_iter().chain(energies).chain(shares).collect()
    });
    Ok((vec!["speed", "bounce_time", "E_h", "E_z", "E_h_share", "E_z_share"], rows.collect()))
}

/// Computes Figure 4: `e_E²`.
fn restitutions() -> Result<Columns, VerifyError> {
    let grid = grid(&DAMPINGS.join(","), "0.0125..12.5:1000")?;
    let bounces = bounces(&grid, RESTITUTION, RESTITUTION_ACCURACY)?;
    let rows = bounces.into_iter().enumerate();
    let rows = rows.map(|(k, Bounce { time, values: [squared] })| [point(&grid, k), vec![time, squared]].concat());
    Ok((vec!["damping", "speed", "bounce_time", "restitution_squared"], rows.collect()))
}

/// Computes Figures 5 to 7: a share of the energy at `t₁`, its limit for `μ → ∞`, and the limit that the paper
/// supposes.
fn shares(kind: FigureKind) -> Result<Columns, VerifyError> {
    let grid = grid(&DAMPINGS.join(","), "3.2..12.5:373")?;
    let bounces = bounces(&grid, SHARES, ACCURACY)?;
    let limits = DAMPINGS.into_iter().map(Limits::new).collect::<Result<Vec<_>, _>>()?;
    let speeds_of_each = bounces.len() / limits.len();
    let rows = bounces.into_iter().enumerate().map(|(k, Bounce { values, .. })| {
        let Limits { translational, kept, decay, .. } = limits[k / speeds_of_each].clone();
        let ([value, limit], supposed) = match (kind, values) {
            (FigureKind::TranslationalShare, [share, _]) => ([share, translational], Double::exact(1.0)),
            (FigureKind::EnergyKept, [_, share]) => ([share, kept], decay),
            (_, [_, share]) => ([share, kept].map(|kept| kept.map(|kept| kept / &decay)), Double::exact(1.0)),
        };
        [point(&grid, k), vec![value, limit, Some(supposed)]].concat()
    });
    let value = match kind {
        FigureKind::TranslationalShare => "translational_part",
        FigureKind::EnergyKept => "energy_kept",
        _ => "energy_kept_over_decay",
    };
    Ok((vec!["damping", "speed", value, "limit", "supposed_limit"], rows.collect()))
}

/// Returns the corners `(y, t)` of the regions of Figure 8 for `L = c = 1`, `x = 1/2`, `t₁ = 2`.
fn regions() -> Columns {
    let corners: [&[[f64; 2]]; 3] = [
        &[[-1.5, 0.0], [0.0, 0.0], [0.0, 1.5]],
        &[[0.0, 0.0], [2.0, 0.0], [2.0, 0.5], [0.5, 2.0], [0.0, 1.5]],
        &[[2.0, 0.0], [2.5, 0.0], [2.0, 0.5]],
    ];
    let corners = [1.0, 2.0, 3.0].into_iter().zip(corners);
    let rows = corners.flat_map(|(region, corners)| corners.iter().map(move |[y, t]| [region, *y, *t]));
    (vec!["region", "y", "t"], rows.map(|row| row.map(|x| Some(Double::exact(x))).to_vec()).collect())
}

/// Computes `e_E²` of the first and of the tenth bounce.
fn tenth_bounces() -> Result<Columns, VerifyError> {
    let grid = grid("0", "0.005..10:2000")?;
    let tenth: Vec<_> = (0..grid.len()).into_par_iter().map(|index| tenth_restitution(&grid, index)).collect();
    let first = bounces(&grid, RESTITUTION, ACCURACY)?;
    let rows = speeds(&grid).into_iter().zip(first).zip(tenth);
    let rows = rows.map(|((speed, Bounce { values: [first], .. }), tenth)| vec![Some(speed), first, tenth]);
    Ok((vec!["speed", "first_restitution_squared", "tenth_restitution_squared"], rows.collect()))
}

/// Returns the values of a point of the grid.
fn point(grid: &Grid, index: usize) -> Row {
    grid.values(index).into_iter().map(|(_, value)| Some(Double::exact(value.to_f64()))).collect()
}

/// The end of a first contact: `t_b` and some values; all `None` for a contact without a bounce.
#[derive(Clone)]
struct Bounce<const N: usize> {
    time: Option<Double>,
    values: [Option<Double>; N],
}

/// A function that computes values of a first contact from its impact and its bounce.
type Values<const N: usize> = fn(&dyn Motion<Double>, [&Double; 2]) -> Result<[Option<Double>; N], Error>;

/// `e_E²`.
const RESTITUTION: Values<1> = |motion, [from, to]| Ok([restitution(motion, (from, Some(to)))?.e_e2.ok()]);

/// `E_h(t_b)/E(t_b)` and `E(t_b)/E(0)`.
const SHARES: Values<2> = |motion, [from, to]| Ok(energy_shares(motion, (from, Some(to)))?.map(Result::ok));

/// `E_h(t_b)` and `E_z(t_b)`.
const ENERGIES: Values<2> =
    |motion, [_, to]| motion.energy(to).map(|energy| [energy.translational, energy.vibrational].map(Some));

/// Computes the first bounces of a grid over `impact.speed` and `rod.damping`, to `accuracy` of the numbers, or of 1
/// where they are less.
fn bounces<const N: usize>(grid: &Grid, values: Values<N>, accuracy: f64) -> Result<Vec<Bounce<N>>, VerifyError> {
    let start = rod();
    (0..grid.len()).into_par_iter().map(|index| bounce(&grid.problem(&start, index)?, values, accuracy)).collect()
}

/// Builds the paper's rod, `c = L = g = 1`.
fn rod() -> Problem {
    Problem::uniform(1.into(), 1.into(), 1.into(), 1.into())
}

/// Builds a grid of dampings and speeds, with the speed varying fastest.
fn grid(dampings: &str, speeds: &str) -> Result<Grid, VerifyError> {
    let axes = [format!("rod.damping={dampings}"), format!("impact.speed={speeds}")];
    Ok(Grid::new(axes.iter().map(|axis| axis.parse::<Axis>()).collect::<Result<Vec<_>, _>>()?)?)
}

fn bounce<const N: usize>(problem: &Problem, values: Values<N>, accuracy: f64) -> Result<Bounce<N>, VerifyError> {
    let plan = Plan::of(problem, &Question::bounce(Numbers::Double(Some(accuracy))))?;
    let query = |motion: &dyn Motion<Double>| {
        let Some((from, Some(to))) = motion.contact_times(0) else {
            return Ok((None, Bounce { time: None, values: [const { None }; N] }));
        };
        let values = values(motion, [&from, &to])?;
        // The accuracy of the time is relative to itself, that of the others to 1.
        let relative_time = to.clone() / Double::exact(*to.value());
        Ok((Some(relative_time), Bounce { time: Some(to), values }))
    };
    let (_, bounce) = plan
        .ask::<f64, _>(problem, query, |(time, bounce)| time.iter().chain(bounce.values.iter().flatten()).collect())?;
    Ok(bounce)
}

/// The limits of Figures 4–7 for `μ → ∞`, with `t_b = t₁`.
#[derive(Clone, Debug)]
pub struct Limits {
    /// `lim e_E = 2e^{−R}(I₀(R) − I₁(R)) − e^{−2R}`.
    pub restitution: Double,
    /// `lim E_h/E`.
    pub translational: Option<Double>,
    /// `lim E/E(0)`.
    pub kept: Option<Double>,
    /// `e^{−2R}`, `R = r t₁`: the limit of `E/E(0)` that the paper supposes.
    pub decay: Double,
}

impl Limits {
    /// Computes the limits for a damping: the motion is linear in `μ` and `g`, so the ratios are those of `g = 0`.
    pub fn new(damping: &str) -> Result<Self, VerifyError> {
        let rod = Problem::builder().length(1).wave_speed(1).damping(damping).impact_speed(1).build()?;
        let [translational, kept] = bounce(&rod, SHARES, 1e-13)?.values;
        let r = Double::from_number(&damping.parse()?, &());
        let decay = (-r.int(4) * &r).exp();
        Ok(Limits { restitution: restitution_limit(&r), translational, kept, decay })
    }
}

/// Returns the least `μ` that bounces at `t₁`: `μ₀` times the threshold of (2.32).
pub fn threshold_speed(damping: &str) -> f64 {
    2.0 * threshold_near(2.0 * damping.parse().unwrap_or(f64::NAN))
}

/// Computes Figure 1: `r`, `t`, the side of the limit, `Ψ_r(t)` for `g = 0`, `t₁ = μ = c = 1`, and `t_b`. A whole `t`
/// has two rows, one for each limit.
fn held_stresses() -> Result<Columns, VerifyError> {
    let rows = HELD_DAMPINGS.into_iter().map(held_stress).collect::<Result<Vec<_>, _>>()?;
    Ok((vec!["damping", "t", "side", "psi", "bounce_time"], rows.concat()))
}

/// Computes the rows of Figure 1 for one damping.
///
/// **Source**: (2.28), `Ψ_r = e^{rt} v_x(0,t)` while the end is held.
fn held_stress(damping: &str) -> Result<Vec<Row>, VerifyError> {
    let rod = Problem::builder().length("1/2").wave_speed(1).damping(damping).impact_speed(1).build()?;
    let form = FirstContact::new(&Parameters::<Double>::of(&rod, &())?);
    let r = Double::from_number(&damping.parse()?, &());
    // The index of the figures prints 14 decimals.
    let bounce_time = bounce(&rod, |_, _| Ok([]), 1e-15)?.time;
    let row = |(k, side): (i32, Side)| {
        let time = Double::exact(f64::from(k) / f64::from(PER_TRIP));
        let value = (r.clone() * &time).exp() * form.strain(&time, side);
        let side = Double::exact(if side == Side::Left { -1.0 } else { 1.0 });
        vec![damping.parse().ok().map(Double::exact), Some(time), Some(side), Some(value), bounce_time.clone()]
    };
    let sides = |k: i32| match k {
        0 => vec![(k, Side::Right)],
        k if k == 4 * PER_TRIP => vec![(k, Side::Left)],
        k if k % PER_TRIP == 0 => vec![(k, Side::Left), (k, Side::Right)],
        k => vec![(k, Side::Right)],
    };
    Ok((0..=4 * PER_TRIP).flat_map(sides).map(row).collect())
}

/// Computes `e_E²` of the tenth contact at a point of the grid; `None` where it is not defined or not settled.
fn tenth_restitution(grid: &Grid, index: usize) -> Option<Double> {
    let rod = grid.problem(&rod(), index).ok()?.with_run(Run::Impacts(10)).ok()?;
    let query = |motion: &dyn Motion<Double>| {
        let contact = motion.contacts().get(9);
        contact.map(|contact| restitution(motion, contact.times())).transpose()
    };
    let found = rod.doubles().ok()?.ask(query, |found| found.iter().flat_map(Restitution::numbers).collect());
    found.ok()??.e_e2.ok()
}

/// Returns the speeds of the grid.
fn speeds(grid: &Grid) -> Vec<Double> {
    let speeds = grid.axes.last().map(|axis| axis.values.iter().map(|value| Double::exact(value.to_f64())));
    speeds.into_iter().flatten().collect()
}
