//! The figures of the paper, from its parameters: which there are, what is reproduced and corrected in each, and their
//! numbers.

use rayon::prelude::*;
use std::iter::once;

use crate::paper::formulas::limit;
use crate::regimes::{Axis, Grid, Map, threshold_near};
use dalembert::Error;
use dalembert::Side;
use dalembert::engine::FirstContact;
use dalembert::engine::Motion;
use dalembert::number::{Analytic, Estimate, Scalar};
use dalembert::problem::{Parameters, Problem, Run};
use dalembert::quantity::{Restitution, energy_shares, restitution};
use dalembert::solve::{Numbers, Plan, Question};

pub type Failed = Box<dyn std::error::Error + Send + Sync>;
type Double = Estimate<f64>;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure {
    /// `4`; in files `figure-4`.
    pub name: &'static str,
    pub of: Of,
    pub shown: &'static str,
    /// What is corrected or added, in a sentence.
    pub corrected: &'static str,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Of {
    Kernel,
    Vibration,
    Shares,
    Restitution,
    Translational,
    Kept,
    Decay,
    Regions,
    Regimes,
    Tenth,
}

/// The numbers of a figure: columns by name, rows in order, each with its bound; one that is not defined is none.
#[derive(Debug)]
pub struct Data {
    pub columns: Vec<&'static str>,
    pub rows: Vec<Vec<Option<Double>>>,
    /// Of [`Of::Regimes`], in place of rows.
    pub map: Option<Map>,
}

pub const ALL: [Figure; 10] = [
    Figure {
        name: "1",
        of: Of::Kernel,
        shown: "Ψ_r(t) for r = 2.6, 2.9, 3.0 with g = 0 and t₁ = μ = c = 1, the stress at the ground if the end were \
                held for ever.",
        corrected: "The bounce times are numbers: t_b = 1.78848103329888, 2.55302249931324 and 3.29902605144577.",
    },
    Figure {
        name: "2",
        of: Of::Vibration,
        shown: "E_z(t_b) over μ for r = 0 and c = L = g = 1, with the dot at μ = μ₀ = 2.",
        corrected: "Nothing: from μ₀ on it is μ₀²L/6 = 2/3.",
    },
    Figure {
        name: "3",
        of: Of::Shares,
        shown: "E_h(t_b)/E(0) and E_z(t_b)/E(0) over μ for r = 0 and c = L = g = 1, with dots at μ = μ₀.",
        corrected: "Nothing: E_z/E(0) is greatest at 2μ₀/3, where it is 4/9.",
    },
    Figure {
        name: "4",
        of: Of::Restitution,
        shown: "e_E² over μ for r = 0, 0.1, 0.2, 0.3 and c = L = g = 1, with black dots where t_b = t₁ begins.",
        corrected: "The curves go on to the left of the dots, where t_b > t₁, down to e_E² = 0; and the limits for \
                    μ → ∞ are true ones.",
    },
    Figure {
        name: "5",
        of: Of::Translational,
        shown: "E_h(t₁)/E(t₁) over μ from 3.2 to 12.5 for r = 0, 0.1, 0.2, 0.3 and c = L = g = 1.",
        corrected: "To 1e-12 instead of about 1e-2, and the limit is not 1 as (4.74) supposes but 0.99996647, \
                    0.99945549, 0.99719065 for r = 0.1, 0.2, 0.3.",
    },
    Figure {
        name: "6",
        of: Of::Kept,
        shown: "E(t₁)/E(0) over μ from 3.2 to 12.5 for r = 0, 0.1, 0.2, 0.3 and c = L = g = 1.",
        corrected: "To 1e-12 instead of about 1e-2, with the limits for μ → ∞ beside e^{−2rt₁}.",
    },
    Figure {
        name: "7",
        of: Of::Decay,
        shown: "E(t₁)/E(0) divided by e^{−2rt₁} over μ from 3.2 to 12.5 for r = 0, 0.1, 0.2, 0.3 and c = L = g = 1.",
        corrected: "To 1e-12 instead of about 1e-2; there is no common limit C₀ = 1, but 1.00066892, 1.00541337, \
                    1.01866583 for r = 0.1, 0.2, 0.3, so that (4.75) fails as well.",
    },
    Figure {
        name: "8",
        of: Of::Regions,
        shown: "The regions A, B, C of the integrals in the appendix, for the point (L/2, t₁): their borders are the \
                characteristics through it and the lines y = 0 and y = 2L.",
        corrected: "Nothing; no integral over them is needed any more.",
    },
    Figure {
        name: "regimes",
        of: Of::Regimes,
        shown: "When and whether the first contact ends, over R = r t₁ and M = μ/(g t₁): t_b = t₁ above the curve \
                M = (I₀(R) + I₁(R))/(2 − I₀(R)).",
        corrected: "Not in the paper, which leaves open whether Ψ must have a root: from R = π on it has none.",
    },
    Figure {
        name: "tenth-bounce",
        of: Of::Tenth,
        shown: "e_E² of the tenth bounce over μ for r = 0 and c = L = g = 1, beside that of the first.",
        corrected: "Not in the paper, whose coefficient is that of a first bounce: a later one may give back what the \
                    rod kept as vibration, e_E² > 1. It is empty where the centre of mass never comes back to h = 0.",
    },
];

/// `r` of Figures 4–7, where `c = L = g = 1`.
pub const DAMPINGS: [&str; 4] = ["0", "0.1", "0.2", "0.3"];
/// `r` of Figure 1.
pub const STRONG: [&str; 3] = ["2.6", "2.9", "3.0"];
/// Points of Figure 1 in each round trip.
const PER_TRIP: i32 = 100;
/// How far a number may be off, relative to it or to 1, before longer numbers take its place. The last digit printed is
/// at most twenty times the bound, so that the number is right to 1e-12 as it is printed.
const SHARP: f64 = 9e-14;
/// Of Figure 4, where the bound of doubles is some 1e-11 at the later bounces and the CSV prints no digit beyond it.
const IN_DOUBLES: f64 = 1e-10;

impl Data {
    /// The numbers without their bounds, for a picture.
    pub fn values(&self) -> Vec<Vec<Option<f64>>> {
        let plain = |number: &Option<Double>| number.as_ref().map(|number| *number.value());
        self.rows.iter().map(|row| row.iter().map(plain).collect()).collect()
    }
}

impl Figure {
    /// The name of its files, without the ending.
    pub fn file(&self) -> String {
        if self.name.parse::<u32>().is_ok() { format!("figure-{}", self.name) } else { self.name.into() }
    }

    /// Its numbers.
    ///
    /// **Accuracy**: *within its own bound*, which is at most 1e-10 for Figure 4, 1e-9 for the tenth bounce and 1e-13
    /// for the others, relative to the numbers or to 1.
    pub fn data(&self) -> Result<Data, Failed> {
        let point = |grid: &Grid, k: usize| {
            grid.values(k).into_iter().map(|value| Some(Double::exact(value.to_f64()))).collect()
        };
        let (columns, rows): (&[&'static str], Vec<Vec<Option<Double>>>) = match self.of {
            Of::Kernel => {
                let rows = STRONG.into_iter().map(kernel).collect::<Result<Vec<_>, _>>()?;
                (&["damping", "t", "side", "psi", "bounce_time"], rows.concat())
            }
            Of::Vibration | Of::Shares => {
                let grid = grid("0", "0.01..8:800")?;
                let found = contacts(&grid, ENERGIES, SHARP)?;
                let rows = speeds(&grid).into_iter().zip(found).map(|(speed, ended)| {
                    let (time, energies) = ended.unzip();
                    let energies = energies.unwrap_or_else(|| vec![None, None]);
                    let whole = speed.clone() * &speed / speed.int(2);
                    let shares = energies.clone().into_iter().map(|energy| energy.map(|energy| energy / &whole));
                    [Some(speed), time].into_iter().chain(energies).chain(shares).collect()
                });
                (&["speed", "bounce_time", "E_h", "E_z", "E_h_share", "E_z_share"], rows.collect())
            }
            Of::Restitution => {
                let grid = grid(&DAMPINGS.join(","), "0.0125..12.5:1000")?;
                let found = contacts(&grid, RESTITUTION, IN_DOUBLES)?;
                let rows = found.into_iter().enumerate().map(|(k, ended)| {
                    let (time, restitution) = ended.unzip();
                    [point(&grid, k), vec![time, restitution.and_then(|values| values[0].clone())]].concat()
                });
                (&["damping", "speed", "bounce_time", "restitution_squared"], rows.collect())
            }
            Of::Translational | Of::Kept | Of::Decay => {
                let grid = grid(&DAMPINGS.join(","), "3.2..12.5:373")?;
                let found = contacts(&grid, SHARES, SHARP)?;
                let limits = DAMPINGS.into_iter().map(limits).collect::<Result<Vec<_>, _>>()?;
                let each = found.len() / limits.len();
                let rows = found.into_iter().enumerate().map(|(k, ended)| {
                    let Limits { translational, kept, decay, .. } = limits[k / each].clone();
                    let shares = ended.map_or([None, None], |(_, shares)| [shares[0].clone(), shares[1].clone()]);
                    let ([value, limit], supposed) = match (self.of, shares) {
                        (Of::Translational, [share, _]) => ([share, translational], Double::exact(1.0)),
                        (Of::Kept, [_, share]) => ([share, kept], decay),
                        (_, [_, share]) => {
                            ([share, kept].map(|kept| kept.map(|kept| kept / &decay)), Double::exact(1.0))
                        }
                    };
                    [point(&grid, k), vec![value, limit, Some(supposed)]].concat()
                });
                let columns: &[&'static str] = match self.of {
                    Of::Translational => &["damping", "speed", "translational_part", "limit", "supposed_limit"],
                    Of::Kept => &["damping", "speed", "energy_kept", "limit", "supposed_limit"],
                    _ => &["damping", "speed", "energy_kept_over_decay", "limit", "supposed_limit"],
                };
                (columns, rows.collect())
            }
            Of::Regions => {
                // The corners of each region for L = c = 1, x = 1/2, t₁ = 2: where y and t are.
                let corners: [&[[f64; 2]]; 3] = [
                    &[[-1.5, 0.0], [0.0, 0.0], [0.0, 1.5]],
                    &[[0.0, 0.0], [2.0, 0.0], [2.0, 0.5], [0.5, 2.0], [0.0, 1.5]],
                    &[[2.0, 0.0], [2.5, 0.0], [2.0, 0.5]],
                ];
                let corners = [1.0, 2.0, 3.0].into_iter().zip(corners);
                let rows = corners.flat_map(|(region, corners)| corners.iter().map(move |[y, t]| [region, *y, *t]));
                (
                    &["region", "y", "t"],
                    rows.into_iter().map(|row| row.map(|x| Some(Double::exact(x))).to_vec()).collect(),
                )
            }
            Of::Regimes => {
                let map = Map::new("0..4:240", "0.05..1e4:240:log", &|| ())?.with_regions(&|| ());
                return Ok(Data { columns: Vec::new(), rows: Vec::new(), map: Some(map) });
            }
            Of::Tenth => {
                let grid = grid("0", "0.005..10:2000")?;
                let tenth = tenth(&grid)?;
                let first = contacts(&grid, RESTITUTION, SHARP)?;
                let rows = speeds(&grid).into_iter().zip(tenth).zip(first).map(|((speed, tenth), first)| {
                    vec![Some(speed), first.and_then(|(_, values)| values[0].clone()), tenth]
                });
                (&["speed", "first_restitution_squared", "tenth_restitution_squared"], rows.collect())
            }
        };
        Ok(Data { columns: columns.to_vec(), rows, map: None })
    }
}

/// A first contact that ends with a bounce: `t_b`, and what is asked there.
type Ended = Option<(Double, Vec<Option<Double>>)>;

/// What is asked of a first contact between its impact and its bounce.
type Wanted = fn(&dyn Motion<Double>, [&Double; 2]) -> Result<Vec<Option<Double>>, Error>;

/// `e_E²`.
const RESTITUTION: Wanted = |motion, [from, to]| Ok(vec![restitution(motion, (from, Some(to)))?.e_e2.ok()]);

/// `E_h(t_b)/E(t_b)` and `E(t_b)/E(0)`.
const SHARES: Wanted = |motion, [from, to]| Ok(energy_shares(motion, (from, Some(to)))?.map(Result::ok).to_vec());

/// `E_h(t_b)` and `E_z(t_b)`.
const ENERGIES: Wanted =
    |motion, [_, to]| motion.energy(to).map(|energy| vec![Some(energy.translational), Some(energy.vibrational)]);

/// The first contacts of a grid over `impact.speed` and `rod.damping`, the speed varying fastest, to `accuracy` of the
/// numbers, or of 1 where they are less.
fn contacts(grid: &Grid, wanted: Wanted, accuracy: f64) -> Result<Vec<Ended>, Failed> {
    (0..grid.len())
        .into_par_iter()
        .map(|index| contact(&grid.problem(index)?, wanted, accuracy))
        .collect::<Result<Vec<_>, _>>()
}

/// The grid of the paper's rod, `c = L = g = 1`.
fn grid(dampings: &str, speeds: &str) -> Result<Grid, Failed> {
    let rod = Problem::uniform(1.into(), 1.into(), 1.into(), 1.into());
    let axes = [format!("rod.damping={dampings}"), format!("impact.speed={speeds}")];
    Ok(Grid::new(rod, axes.iter().map(|axis| axis.parse::<Axis>()).collect::<Result<Vec<_>, _>>()?)?)
}

fn contact(problem: &Problem, wanted: Wanted, accuracy: f64) -> Result<Ended, Failed> {
    let plan = Plan::of(problem, &Question::bounce(Numbers::Double(Some(accuracy))))?;
    let query = |motion: &dyn Motion<Double>| {
        let Some((from, Some(to))) = motion.contact_times(0) else { return Ok(None) };
        let values = wanted(motion, [&from, &to])?;
        // The time relative to itself, and the others to 1.
        let whole = to.clone() / Double::exact(*to.value());
        Ok(Some((whole, (to, values))))
    };
    let found = plan.ask::<f64, _>(problem, query, |ended| {
        ended.iter().flat_map(|(whole, (_, values))| once(whole).chain(values.iter().flatten())).collect()
    })?;
    Ok(found.map(|(_, ended)| ended))
}

/// What Figures 4–7 tend to for `μ → ∞`, as long as `t_b = t₁`.
#[derive(Clone, Debug)]
pub struct Limits {
    /// `lim e_E = 2e^{−R}(I₀(R) − I₁(R)) − e^{−2R}`.
    pub restitution: Double,
    /// `lim E_h/E` and `lim E/E(0)`.
    pub translational: Option<Double>,
    pub kept: Option<Double>,
    /// `e^{−2R}`, `R = r t₁`: what the paper supposes of `E/E(0)`.
    pub decay: Double,
}

/// The limits for a damping: the motion is linear in `μ` and `g`, so for `μ → ∞` all ratios are those of `g = 0`.
pub fn limits(damping: &str) -> Result<Limits, Failed> {
    let rod = Problem::builder().length(1).wave_speed(1).damping(damping).impact_speed(1).build()?;
    let shares = contact(&rod, SHARES, 1e-13)?.map_or(Vec::new(), |(_, shares)| shares);
    let share = |k: usize| shares.get(k).cloned().flatten();
    let r = Double::from_number(&damping.parse()?, &());
    let decay = (-r.int(4) * &r).exp();
    Ok(Limits { restitution: limit(&r), translational: share(0), kept: share(1), decay })
}

/// `μ` from which the bounce comes at `t₁`: `μ₀` times the threshold of (2.32).
pub fn dot(damping: &str) -> f64 {
    2.0 * threshold_near(2.0 * damping.parse().unwrap_or(f64::NAN))
}

/// Rows of Figure 1: `r`, `t`, which limit, `Ψ_r(t)` for `g = 0`, `t₁ = μ = c = 1`, and `t_b`. Two are of each whole
/// `t`.
///
/// **Source**: (2.28), `Ψ_r = e^{rt} v_x(0,t)` while the end is held.
fn kernel(damping: &str) -> Result<Vec<Vec<Option<Double>>>, Failed> {
    let rod = Problem::builder().length("1/2").wave_speed(1).damping(damping).impact_speed(1).build()?;
    let form = FirstContact::new(&Parameters::<Double>::of(&rod, &())?);
    let r = Double::from_number(&damping.parse()?, &());
    // As sharp as doubles can be: the index prints 14 decimals.
    let bounce = contact(&rod, |_, _| Ok(Vec::new()), 1e-15)?.map(|bounce| bounce.0);
    let row = |(k, side): (i32, Side)| {
        let time = Double::exact(f64::from(k) / f64::from(PER_TRIP));
        let value = (r.clone() * &time).exp() * form.strain(&time, side);
        let side = Double::exact(if side == Side::Left { -1.0 } else { 1.0 });
        vec![damping.parse().ok().map(Double::exact), Some(time), Some(side), Some(value), bounce.clone()]
    };
    let sides = |k: i32| match k {
        0 => vec![(k, Side::Right)],
        k if k == 4 * PER_TRIP => vec![(k, Side::Left)],
        k if k % PER_TRIP == 0 => vec![(k, Side::Left), (k, Side::Right)],
        k => vec![(k, Side::Right)],
    };
    Ok((0..=4 * PER_TRIP).flat_map(sides).map(row).collect())
}

/// `e_E²` of the tenth contact over `impact.speed`, without damping; `None` where it is not defined or not settled.
fn tenth(grid: &Grid) -> Result<Vec<Option<Double>>, Failed> {
    let one = |index: usize| {
        let rod = grid.problem(index).ok()?.with_run(Run::Impacts(10)).ok()?;
        let query = |motion: &dyn Motion<Double>| {
            let contact = motion.contacts().get(9);
            contact.map(|contact| restitution(motion, contact.times())).transpose()
        };
        let found = rod.doubles().ok()?.ask(query, |found| found.iter().flat_map(Restitution::numbers).collect());
        found.ok()??.e_e2.ok()
    };
    (0..grid.len()).into_par_iter().map(|index| Ok(one(index))).collect::<Result<Vec<_>, _>>()
}

fn speeds(grid: &Grid) -> Vec<Double> {
    grid.axes
        .last()
        .map_or_else(Vec::new, |axis| axis.values.iter().map(|value| Double::exact(value.to_f64())).collect())
}
