//! Means and projections of damped rods, each within the bound that it carries: against fractions where nothing is
//! damped, against finer cells, against the closed form, and against quadratures of the field in twenty digits.

use dalembert::engine::{ContactHistory, Damped, Motion};
use dalembert::number::{IntervalPrecision, Scalar};
use dalembert::quantity::{Slice, slices};
use dalembert::special::gauss_legendre;
use dalembert::{Ending, Estimate, Float, Interval, Number, Problem, Rational, Reason, Side, Start, Value};
use proptest::prelude::*;

use crate::common::compares;
use crate::damped_properties::scene;

const BOTH: [Slice; 2] = [Slice::Averages, Slice::P1];

/// A grid in a rod of this length: regular, so that rays meet its points; one cell; fine; with points that are
/// roundings apart.
fn grid(kind: u8, length: f64, seed: f64) -> Vec<f64> {
    let even = |n: u32| (0..=n).map(|k| length * f64::from(k) / f64::from(n)).collect::<Vec<_>>();
    match kind {
        0 => even(8),
        1 => vec![seed * length / 2.0, length],
        2 => even(24),
        3 => {
            let near = [0.0, seed, seed * (1.0 + 1e-15), seed * (1.0 + 4e-15), 0.5, 0.5 + 1e-14, 1.0 - 1e-15, 1.0];
            let mut points: Vec<f64> = near.iter().map(|x| x * length).collect();
            points.sort_by(f64::total_cmp);
            points.dedup();
            points
        }
        _ => even(1),
    }
}

fn exact(list: &[f64]) -> Vec<Estimate<f64>> {
    list.iter().map(|x| Estimate::exact(*x)).collect()
}

fn rational(list: &[f64]) -> Vec<Rational> {
    list.iter().map(|x| Rational::from_f64(*x).unwrap()).collect()
}

/// Where two tables, from v on, differ by more than their bounds.
fn apart(a: &[Vec<Estimate<f64>>], b: &[Vec<Estimate<f64>>]) -> Vec<String> {
    let apart = |(a, b): (&Estimate<f64>, &Estimate<f64>)| {
        let (off, most) = ((a.value() - b.value()).abs(), a.bound() + b.bound());
        let within = off <= most;
        (!within).then(|| format!("{:e} {:e}: off {off:e}, bound {most:e}", a.value(), b.value()))
    };
    assert_eq!(a.iter().map(Vec::len).collect::<Vec<_>>(), b.iter().map(Vec::len).collect::<Vec<_>>());
    a[3..].iter().flatten().zip(b[3..].iter().flatten()).filter_map(apart).collect()
}

/// The nearest doubles, within their rounding.
fn doubles<S: Scalar>(table: &[Vec<S>]) -> Vec<Vec<Estimate<f64>>> {
    table.iter().map(|column| column.iter().map(|x| Estimate::rounded(x.to_f64(), 2.0)).collect()).collect()
}

fn too_long(motion: &dyn Motion<Estimate<f64>>) -> bool {
    matches!(motion.ending(), Ending::Undecided(Reason::Effort { .. }))
}

/// Other lists of events are a fault, unless one of the histories says that it does not know its own.
fn warned(histories: &[&dyn Motion<Estimate<f64>>]) -> Result<[usize; 1], TestCaseError> {
    let warned = histories.iter().any(|history| !history.warnings().is_empty());
    prop_assert!(warned, "other events, and no warning");
    Ok([0])
}

/// What a cell carries comes from its own ends and its ray: a thousand cells are as well known as ten.
#[test]
fn fine_grids_are_known_as_well() {
    let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).time(40).build().unwrap();
    let history = rod.doubles().unwrap();
    let mut count = 0;
    for (slice, n) in BOTH.into_iter().flat_map(|slice| [(slice, 100), (slice, 1000)]) {
        let points: Vec<f64> = (0..=n).map(|k| f64::from(k) / f64::from(n)).collect();
        // v = −g(2 − t)²/2 + … has values of some units: their roundings over the width of a cell, and few more.
        let most = 1e3 * f64::from(n) * f64::EPSILON;
        let carried = history.ask(
            |motion| slices(motion, slice, &exact(&points), &exact(&[0.0, 0.3, 1.0, 2.0, 11.7]), None),
            |table| table[3..].iter().flatten().collect(),
        );
        for x in carried.unwrap()[3..].iter().flatten() {
            assert!(x.bound() <= most, "{slice:?}, {n} cells: {x:?} above {most:e}");
            count += 1;
        }
    }
    assert!(count > 30_000, "{count} numbers");
}

/// r = 1e-30 changes nothing that doubles hold.
#[test]
fn without_damping_they_are_fractions() {
    compares(48, [8], (scene(1e-3, 1.0), 0u8..5, 0.01f64..0.99), |(problem, kind, seed)| {
        let [damped, bare] = ["1e-30", "0"].map(|damping| problem.to_builder().damping(damping).build().unwrap());
        let history = Damped::<f64>::solve(&damped, &(), 13.0).unwrap();
        let Ok(truth) = bare.exact() else { return Ok([0]) };
        if too_long(&history) || matches!(truth.ending(), Ending::ExactnessEnds { .. }) {
            return Ok([0]);
        }
        if history.events().len() != truth.events().len() {
            return warned(&[&history]);
        }
        let mut compared = 0;
        let points = grid(kind, damped.length().to_f64(), seed);
        let end = history.end().to_f64().min(truth.end().to_f64()) * 0.999;
        // Events, each of its own history, among the times.
        let mut times: Vec<(Estimate<f64>, Rational)> = (0..5)
            .map(|k| end * (f64::from(k) + seed) / 5.0)
            .chain([0.0, end / 2.0])
            .map(|t| (Estimate::exact(t), Rational::from_f64(t).unwrap()))
            .collect();
        times.extend(history.events().iter().zip(truth.events()).map(|(a, b)| (a.t.clone(), b.t.clone())));
        times.retain(|(_, t)| *t <= *truth.end());
        for (t, exactly) in times {
            for slice in BOTH {
                let found = slices(&history, slice, &exact(&points), std::slice::from_ref(&t), None).unwrap();
                let grid = |_: &dyn Motion<_>| Ok((rational(&points), vec![exactly.clone()]));
                let truth = truth.ask_slices(slice, None, grid).unwrap();
                prop_assert_eq!(apart(&found, &doubles(&truth)), Vec::<String>::new(), "{:?} {:?}", slice, t);
                compared += found.len();
            }
        }
        Ok([compared])
    });
}

/// A coarse run, whose bounds are wide, against a fine one.
#[test]
fn coarse_cells_are_off_by_no_more_than_they_say() {
    let cases = (scene(1e-3, 3.0), 0u8..5, 0.01f64..0.99, 1f64..5.0);
    compares(24, [18], cases, |(problem, kind, seed, digits)| {
        let solve = |digits: f64| Damped::<f64>::solve(&problem, &(), digits).unwrap();
        let (coarse, fine) = (solve(digits), solve(13.0));
        if too_long(&coarse) || too_long(&fine) {
            return Ok([0]);
        }
        if coarse.events().len() != fine.events().len() {
            return warned(&[&coarse, &fine]);
        }
        let points = exact(&grid(kind, problem.length().to_f64(), seed));
        let end = coarse.end().to_f64().min(fine.end().to_f64()) * 0.999;
        let times: Vec<_> = (0..12).map(|k| Estimate::exact(end * (f64::from(k) + seed) / 12.0)).collect();
        for slice in BOTH {
            let ask = |motion: &dyn Motion<Estimate<f64>>| slices(motion, slice, &points, &times, None).unwrap();
            prop_assert_eq!(apart(&ask(&coarse), &ask(&fine)), Vec::<String>::new(), "{:?}", slice);
        }
        Ok([times.len()])
    });
}

/// Cells from t = 0 on and the closed form share nothing in the first contact; enclosures hold what longer numbers
/// give.
#[test]
fn closed_form_and_cells_are_one() {
    let cases = (-6f64..2.5, 0f64..5.0, any::<bool>(), 0u8..5, 0.01f64..0.99);
    compares(16, [16], cases, |(damping, speed, weighs, kind, seed)| {
        let gravity = if weighs { "0.25" } else { "0" };
        let rod = Problem::builder().length(2).wave_speed(4).gravity(gravity).impact_speed(speed + 0.01);
        let problem = rod.damping(damping.exp()).time(3).build().unwrap();
        let closed = ContactHistory::<Estimate<f64>>::solve(&problem, &()).unwrap();
        let cells = Damped::<f64>::solve(&problem, &(), 13.0).unwrap();
        let end = closed.end().to_f64();
        // t₁ = 1: at halves and quarters of it rays are at the ends and at points of the grid.
        let mut times: Vec<f64> = [0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0].into();
        times.extend([seed * end, 0.5 * seed, 0.25 + 1e-16, 0.5 * (1.0 - 1e-15)]);
        times.retain(|t| *t <= end);
        let points = grid(kind, 2.0, seed);
        let enclosed = ContactHistory::<Interval>::solve(&problem, &IntervalPrecision::with_exact(150)).unwrap();
        let long = ContactHistory::<Estimate<Float>>::solve(&problem, &200).unwrap();
        for slice in BOTH {
            let (points, times) = (exact(&points), exact(&times));
            let ask = |motion: &dyn Motion<Estimate<f64>>| slices(motion, slice, &points, &times, None).unwrap();
            let found = ask(&closed);
            prop_assert_eq!(apart(&found, &ask(&cells)), Vec::<String>::new(), "{:?}", slice);
            let spelled = |x: f64| Rational::from_f64(x).unwrap().to_string();
            let lift = |x: &Estimate<f64>| spelled(*x.value()).parse::<Number>().unwrap();
            let [points, times] = [&points, &times].map(|list| list.iter().map(lift).collect::<Vec<_>>());
            let known = |list: &[Number]| list.iter().map(|x| Estimate::from_number(x, &200)).collect::<Vec<_>>();
            let inside = |list: &[Number]| {
                list.iter().map(|x| Interval::from_number(x, &IntervalPrecision::with_exact(150))).collect::<Vec<_>>()
            };
            let long = slices(&long, slice, &known(&points), &known(&times), None).unwrap();
            let enclosed = slices(&enclosed, slice, &inside(&points), &inside(&times), None).unwrap();
            for (enclosure, value) in enclosed[3..].iter().flatten().zip(long[3..].iter().flatten()) {
                prop_assert!(enclosure.lo() <= value.value() && value.value() <= enclosure.hi(), "{:?}", enclosure);
                // Where cells are roundings of doubles wide, few of the bits are left.
                let width = Float::with_val(53, enclosure.hi() - enclosure.lo()).to_f64();
                prop_assert!(width < if kind == 3 { 1e-3 } else { 1e-30 }, "{:?}", enclosure);
            }
            prop_assert_eq!(apart(&found, &doubles(&long)), Vec::<String>::new(), "{:?}", slice);
        }
        Ok([1])
    });
}

/// Constant and linear fields are their own projections, and quadratic ones have the means of parabolas: a strained
/// start, and rods at rest on the ground and under a fixed top.
#[test]
fn linear_fields_are_reproduced() {
    let rod = || Problem::builder().length(2).wave_speed(3).gravity("0.9").damping(4);
    let start = rod().displacement([(0, "1"), (2, "1.5")]).velocity([(0, "-1"), (2, "-1")]).time(1);
    let (still, held) = (rod().impact_speed("0.1").time(90), rod().gap(1).impact_speed(0).fixed_top().time(90));
    // v as a + b x + d x², and v_t.
    let (bend, shift) = (0.9 / 18.0, 0.9 * 2.0 / 9.0);
    let resting = [0.0, -shift, bend];
    let cases =
        [(start, 0.0, [1.0, 0.25, 0.0], -1.0), (still, 80.0, resting, 0.0), (held, 80.0, [0.8, 0.0, bend], 0.0)];
    for (problem, t, [a, b, d], rate) in cases {
        let history = problem.build().unwrap().solve().unwrap();
        for points in [vec![0.0, 2.0], vec![0.0, 0.3, 0.30001, 1.7, 2.0]] {
            let at = |slice| history.sample_field(slice, &points[..].into(), &[t][..].into(), None).unwrap();
            let value = |column: Vec<Value>| column.iter().map(Value::to_f64).collect::<Vec<_>>();
            let [nodal, means] =
                [Slice::P1, Slice::Averages].map(|slice| at(slice).into_iter().map(value).collect::<Vec<_>>());
            for (k, x) in points.iter().enumerate() {
                assert!((nodal[4][k] - rate).abs() < 1e-9, "{t} {x} {}", nodal[4][k]);
                assert!((nodal[5][k] - (b + 2.0 * d * x)).abs() < 1e-9, "{t} {x} {}", nodal[5][k]);
                assert!(d != 0.0 || (nodal[3][k] - (a + b * x)).abs() < 1e-9, "{t} {x} {}", nodal[3][k]);
            }
            for (k, pair) in points.windows(2).enumerate() {
                let (x, y) = (pair[0], pair[1]);
                let mean = a + b * (x + y) / 2.0 + d * (x * x + x * y + y * y) / 3.0;
                assert!((means[3][k] - mean).abs() < 1e-9, "{t} {x} {} {mean}", means[3][k]);
            }
        }
    }
}

/// Where rays are at this time, and the ends.
fn cuts(problem: &Problem, events: &[Float], time: &Float) -> Vec<Float> {
    let lift = |x: &Number| Float::from_number(x, &time.prec());
    let dalembert::Material::WaveSpeed(c) = problem.material() else { panic!() };
    let (length, way) = (lift(problem.length()), time.clone() * lift(c));
    let mut sources: Vec<Float> = events.iter().map(|event| (time.clone() - event) * lift(c)).collect();
    let mut corners = vec![length.zero(), length.clone()];
    if let Start::Profile(profile) = problem.start() {
        corners.extend(profile.displacement.iter().chain(&profile.velocity).map(|(x, _)| lift(x)));
    }
    sources.extend(corners.iter().flat_map(|x| [way.clone() + x, way.clone() - x]));
    let round = length.int(2) * &length;
    let mut cuts = vec![length.zero(), length.clone()];
    for source in sources.into_iter().filter(|source| *source > 0) {
        let turns = (source.clone() / &round).floor_int().unwrap();
        let place = source - round.clone() * round.int(turns);
        cuts.push(if place > length { round.clone() - place } else { place });
    }
    cuts.sort_by(|a, b| a.partial_cmp(b).unwrap());
    cuts
}

/// Gauss–Legendre between rays, from values of the field in twenty digits: means, and what a projection leaves, which
/// is orthogonal to every hat function.
#[test]
fn they_are_integrals_of_the_field() {
    let rod = || Problem::builder().length("1.5").wave_speed(2).gravity("0.7").impact_speed("1.9");
    let scenes = [
        rod().damping("0.15").impacts(3),
        rod().damping("1.1").impacts(1),
        rod().damping("0.4").gap("0.2").impacts(2),
        rod().damping("0.3").fixed_top().impacts(2),
    ];
    let points = [0.125, 0.5, 0.5625, 1.5];
    for problem in scenes.map(|scene| scene.build().unwrap()) {
        let (history, digits) = (problem.doubles().unwrap(), problem.digits(20).unwrap());
        let events: Vec<Float> = digits.events().iter().map(|event| event.t.clone()).collect();
        let precision = events[0].prec();
        let float = |x: f64| Float::with_val(precision, x);
        let rule = gauss_legendre(&float(1.0), 16);
        for part in [0.07, 0.33, 0.61, 0.97] {
            let t = part * history.end();
            let time = float(t);
            // Means of 1, and of the hat functions, times v, v_t and v_x.
            let (mut areas, mut loads) = ([[0.0; 3]; 3], [[0.0; 3]; 4]);
            let mut cuts = cuts(&problem, &events, &time);
            cuts.extend(points.map(float));
            cuts.sort_by(|a, b| a.partial_cmp(b).unwrap());
            for pair in cuts.windows(2) {
                let half: Float = (pair[1].clone() - &pair[0]) / 2;
                let middle: Float = half.clone() + &pair[0];
                let Some(cell) = points.windows(2).position(|p| middle > p[0] && middle < p[1]) else { continue };
                if half < 1e-30 {
                    continue;
                }
                let width = points[cell + 1] - points[cell];
                for (at, weight) in &rule {
                    let x = half.clone() * at + &middle;
                    let at = (std::slice::from_ref(&x), std::slice::from_ref(&time));
                    let field = digits.field(at.0, at.1, Side::Right).unwrap().remove(0);
                    let upper = (x - points[cell]).to_f64() / width;
                    for (j, f) in [field.displacement, field.velocity, field.strain].into_iter().enumerate() {
                        let share = (f * &half * weight).to_f64();
                        areas[cell][j] += share / width;
                        loads[cell][j] += share * (1.0 - upper);
                        loads[cell + 1][j] += share * upper;
                    }
                }
            }
            let ask = |slice| {
                let query = |motion: &dyn Motion<_>| slices(motion, slice, &exact(&points), &exact(&[t]), None);
                history.ask(query, |table| table[3..].iter().flatten().collect()).unwrap()
            };
            let (means, nodal) = (ask(Slice::Averages), ask(Slice::P1));
            for j in 0..3 {
                let found = |k: usize| nodal[3 + j][k].to_f64();
                for (k, area) in areas.iter().enumerate() {
                    let (mean, off) = (&means[3 + j][k], means[3 + j][k].to_f64() - area[j]);
                    assert!(off.abs() <= mean.bound() + 1e-14, "{t} {j} {k}: {mean:?} {}", area[j]);
                }
                for (k, load) in loads.iter().enumerate() {
                    let mut rest = -load[j];
                    let mut bound = 1e-14;
                    for (a, b) in [(k.wrapping_sub(1), k), (k + 1, k)] {
                        let (Some(other), Some(this)) = (points.get(a), points.get(b)) else { continue };
                        let width = (other - this).abs();
                        rest += width * (2.0 * found(b) + found(a)) / 6.0;
                        bound += width * (2.0 * nodal[3 + j][b].bound() + nodal[3 + j][a].bound()) / 6.0;
                    }
                    assert!(rest.abs() <= bound, "{t} {j} {k}: {rest:e} {bound:e}");
                }
            }
        }
    }
}
