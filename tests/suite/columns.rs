//! The columns of a table over time, each against a route of its own: integrals of the field over the rod, momentum
//! balance, and what pencil and paper give.

use crate::common::Random;
use crate::cuts::cuts;
use dalembert::quantity::Needs;
use dalembert::{Number, Problem, Quantity, Rational, Run, Scene, Side};

fn scene(name: &str) -> Problem {
    let source = dalembert::builtin::get(name).unwrap().source;
    Scene::parse(source).unwrap().problem
}

fn fraction(p: i64, q: i64) -> Rational {
    Rational::from((p, q))
}

/// `½ ∫ v_t² dx` and `½ c² ∫ v_x² dx` from values of the field: between rays both squares are quadratic, for which the
/// rule with the weights 2/3, −1/3, 2/3 at the quarters is exact.
fn from_field(rod: &Problem, history: &dalembert::TypedHistory<Rational>, time: &Rational) -> [Rational; 2] {
    let trip = history.rays(0).unwrap()[0].clone();
    let c = rod.length().to_rational() * 2 / (trip.to.clone() - trip.from);
    let mut sums = [Rational::new(), Rational::new()];
    for pair in cuts(rod, history, time).windows(2) {
        let width = pair[1].clone() - &pair[0];
        for (quarter, weight) in [(1, fraction(2, 3)), (2, fraction(-1, 3)), (3, fraction(2, 3))] {
            let x = width.clone() * fraction(quarter, 4) + &pair[0];
            let field = &history.field(&[x], std::slice::from_ref(time), Side::Right).unwrap()[0];
            sums[0] += field.velocity.clone().square() * &weight * &width / 2;
            let stretch: Rational = field.strain.clone() * &c;
            sums[1] += stretch.square() * weight * &width / 2;
        }
    }
    sums
}

#[test]
fn the_page_on_output_lists_all_columns() {
    let page = include_str!("../../docs/output.md").split_whitespace().collect::<Vec<_>>().join(" ");
    let list = Needs::Time.quantities().map(Quantity::name).collect::<Vec<_>>().join(" ");
    assert!(page.contains(&format!("`{list}`")), "{list}");
}

#[test]
fn the_docstring_of_python_lists_all_columns() {
    let source = include_str!("../../python/dalembert/_history.py");
    let doc = source
        .split("def columns(")
        .nth(1)
        .and_then(|rest| rest.split("names : str or sequence of str").nth(1))
        .unwrap();
    let doc = doc.split("or of the groups").next().unwrap();
    let mut listed: Vec<&str> = doc.split("``").skip(1).step_by(2).collect();
    let mut known: Vec<&str> = Needs::Time.quantities().map(Quantity::name).collect();
    listed.sort_unstable();
    known.sort_unstable();
    assert_eq!(listed, known);
}

/// Nothing that needs the same has the same name, and every name is found.
#[test]
fn names_are_told_apart_by_what_they_need() {
    for quantity in Quantity::ALL {
        assert_eq!(quantity.needs().named(quantity.name()), Some(*quantity));
        assert_eq!(quantity.needs().called(quantity.name()), Some(*quantity));
        assert!(!quantity.meaning().is_empty());
        for name in quantity.also() {
            assert_eq!(quantity.needs().called(name), Some(*quantity), "{name}");
        }
    }
}

#[test]
fn energies_are_integrals_of_the_field() {
    let scenes = ["doyen-ern-piperno", "getfem-dynamic-contact", "paper-strong", "figure-2", "mu-4-3"];
    for name in scenes {
        let rod = scene(name);
        let history = rod.exact().unwrap();
        let columns = [Quantity::KineticEnergy, Quantity::StrainEnergy, Quantity::GravityEnergy, Quantity::Energy];
        let times: Vec<Rational> = (0..=23).map(|k| history.end().clone() * fraction(k, 23)).collect();
        let table = history.columns(&columns, &times, Some(Side::Right)).unwrap();
        for (k, time) in times.iter().enumerate() {
            let sums = from_field(&rod, &history, time);
            assert_eq!([&table[0][k], &table[1][k]], [&sums[0], &sums[1]], "{name} at {time}");
            assert_eq!(table[0][k].clone() + &table[1][k] + &table[2][k], table[3][k], "{name} at {time}");
        }
    }
}

/// `ρS (P(t) − P(0) + gLt) = ∫ force` for a free top: (3.36) integrated.
#[test]
fn impulse_is_what_momentum_has_gained() {
    for name in ["doyen-ern-piperno", "paper-strong", "figure-3", "mu-4-3"] {
        let rod = scene(name);
        let history = rod.exact().unwrap();
        let times: Vec<Rational> = (0..=40).map(|k| history.end().clone() * fraction(k, 40)).collect();
        let table = history.columns(&[Quantity::Impulse, Quantity::CentreVelocity], &times, Some(Side::Right)).unwrap();
        let length = rod.length().to_rational();
        let gravity = rod.gravity().map_or_else(Rational::new, Number::to_rational);
        for (k, time) in times.iter().enumerate() {
            let gained = table[1][k].clone() - &table[1][0] + gravity.clone() * time;
            assert_eq!(table[0][k], gained * &length, "{name} at {time}");
        }
        // Between contacts nothing is given; each contact gives what it says.
        let given: Rational = history.contacts().iter().map(|contact| contact.impulse.clone()).sum();
        assert_eq!(*table[0].last().unwrap(), given, "{name}");
    }
}

#[test]
fn a_damped_rod_balances_momentum_and_energy() {
    let rod = scene("figure-4-r02").with_run(Run::Impacts(3)).unwrap();
    let history = rod.doubles().unwrap();
    let (r, g) = (0.2, 1.0);
    let times: Vec<f64> = (0..=60).map(|k| history.end() * f64::from(k) / 60.0).collect();
    let columns = [
        Quantity::Impulse,
        Quantity::CentreVelocity,
        Quantity::Centre,
        Quantity::KineticEnergy,
        Quantity::StrainEnergy,
        Quantity::GravityEnergy,
        Quantity::Energy,
    ];
    let table = history.columns(&columns, &times, Some(Side::Right)).unwrap();
    let bound = 1e-9;
    for (k, t) in times.iter().enumerate() {
        let [impulse, rate, h, kinetic, strain, gravity, total] = std::array::from_fn(|j| table[j][k]);
        let gained = rate - table[1][0] + 2.0 * r * h + g * t;
        assert!((impulse - gained).abs() < bound * 5.0, "{t}: {impulse} {gained}");
        assert!((kinetic + strain + gravity - total).abs() < bound * 25.0, "{t}");
        assert!(kinetic >= 0.0 && strain >= 0.0);
    }
    // Gauss with two points in 4000 cells: between rays its error is below 1e-12, and in the few cells that hold a ray
    // a jump of the square of at most 25 is off by no more than the cell.
    let cells = 4000;
    for k in [7, 20, 33, 51] {
        let off = 0.5 / 3f64.sqrt();
        let points: Vec<f64> = (0..cells)
            .flat_map(|j| [0.5 - off, 0.5 + off].map(|part| (f64::from(j) + part) / f64::from(cells)))
            .collect();
        let field = history.field(&points, &times[k..=k], Side::Right).unwrap();
        let mean = |square: &dyn Fn(&dalembert::Field<f64>) -> f64| {
            field.iter().map(square).sum::<f64>() / (4.0 * f64::from(cells))
        };
        let (kinetic, strain) = (mean(&|f| f.velocity.powi(2)), mean(&|f| f.strain.powi(2)));
        let rays = 12.0;
        assert!((kinetic - table[3][k]).abs() < rays * 25.0 / f64::from(cells), "{kinetic} {}", table[3][k]);
        assert!((strain - table[4][k]).abs() < rays * 25.0 / f64::from(cells), "{strain} {}", table[4][k]);
    }
}

/// Theorem 1's damped contact, enclosed: parts of the energy, and the impulse, hold the values in doubles.
#[test]
fn enclosures_hold_the_doubles() {
    let rod = scene("figure-4-r02");
    let (proved, double) = (rod.certified(15).unwrap(), rod.first_contact().unwrap());
    let columns = [Quantity::KineticEnergy, Quantity::StrainEnergy, Quantity::Impulse, Quantity::Force];
    for t in ["1/3", "1", "3/2"] {
        let number: Number = t.parse().unwrap();
        let time = dalembert::number::Scalar::from_number(&number, &dalembert::number::Scalar::precision(proved.end()));
        let enclosed = proved.columns(&columns, &[time], Some(Side::Right)).unwrap();
        let values = double.columns(&columns, &[number.to_f64()], Some(Side::Right)).unwrap();
        for ((enclosed, value), column) in enclosed.iter().zip(&values).zip(columns) {
            let middle = dalembert::number::Scalar::to_f64(&enclosed[0]);
            assert!((middle - value[0]).abs() < 1e-12 * middle.abs(), "{}: {middle} {}", column.name(), value[0]);
        }
    }
}

/// A steel bar at 0.1 m/s without gravity: σ = ρ c μ, F = S σ; E = ½ ρSL μ², all of it strain at L/c.
#[test]
fn a_material_gives_units() {
    let rod = Problem::builder().length(2).material(900, 1, "1/2").impact_speed(3).build().unwrap();
    let history = rod.exact().unwrap();
    let columns = [
        Quantity::Stress,
        Quantity::Force,
        Quantity::Energy,
        Quantity::StrainEnergy,
        Quantity::Impulse,
        Quantity::Contact,
    ];
    let at = |t: Rational, side| {
        let table = history.columns(&columns, &[t], Some(side)).unwrap();
        table.into_iter().map(|mut column| column.remove(0)).collect::<Vec<_>>()
    };
    // c = 30, L/c = 1/15: the whole rod is strained by μ/c = 1/10 and at rest.
    let expected = [(-90, 1), (45, 1), (9, 2), (9, 2), (3, 1), (1, 1)].map(|(p, q)| fraction(p, q));
    assert_eq!(at(fraction(1, 15), Side::Right), expected);
    // At 2L/c the force ends; it has turned the momentum round: 2 ρSL μ = 6.
    let [zero, one] = [0, 1].map(|n| fraction(n, 1));
    let after = [zero.clone(), zero.clone(), fraction(9, 2), zero.clone(), fraction(6, 1), zero.clone()];
    assert_eq!(at(fraction(2, 15), Side::Right), after);
    let before = [fraction(-90, 1), fraction(45, 1), fraction(9, 2), zero, fraction(6, 1), one];
    assert_eq!(at(fraction(2, 15), Side::Left), before);
}

/// The held rod of GetFEM: v(0,t) = (1 − t)/2, then contact with v_x = −1/2 until 2.
#[test]
fn both_limits_at_a_jump() {
    let history = scene("getfem-dynamic-contact").exact().unwrap();
    let columns =
        [Quantity::Time, Quantity::Side, Quantity::EndVelocity, Quantity::Strain, Quantity::Contact, Quantity::Impulse];
    let times = [fraction(1, 2), fraction(1, 1), fraction(3, 2), fraction(2, 1), fraction(3, 1)];
    let table = history.columns(&columns, &times, None).unwrap();
    let expected = [
        [(1, 2), (1, 1), (1, 1), (3, 2), (2, 1), (2, 1), (3, 1), (3, 1)],
        [(0, 1), (-1, 1), (1, 1), (0, 1), (-1, 1), (1, 1), (-1, 1), (1, 1)],
        [(-1, 2), (-1, 2), (0, 1), (0, 1), (0, 1), (1, 2), (1, 2), (-1, 2)],
        [(0, 1), (0, 1), (-1, 2), (-1, 2), (-1, 2), (0, 1), (0, 1), (0, 1)],
        [(0, 1), (0, 1), (1, 1), (1, 1), (1, 1), (0, 1), (0, 1), (0, 1)],
        [(0, 1), (0, 1), (0, 1), (1, 4), (1, 2), (1, 2), (1, 2), (1, 2)],
    ]
    .map(|column| column.map(|(p, q)| fraction(p, q)));
    for (found, expected) in table.iter().zip(&expected) {
        assert_eq!(found, expected);
    }
}

/// Times in order take one march; each value is, bit for bit, that of a history that is asked for this time alone, in
/// any order: random scenes, times at random, at events, where rays meet the ends, and twice, from both sides.
#[test]
fn one_march_has_the_values_of_many() {
    let mut random = Random(1878);
    let mut random = move || random.between(0.0, 1.0);
    let any = || Problem::builder().length(2).wave_speed(3).gravity(1);
    let rod = || any().impacts(4);
    let mut problems = vec![
        rod().damping("0.01").impact_speed(40).impacts(2),
        rod().damping("0.2").fixed_top().impact_speed("1.7"),
        any().damping("1.5").impact_speed(3).time(20),
        rod().damping("0.1").gap("0.4").impact_speed(1),
        any().damping("0.3").displacement([(0, "0.1"), (1, "-0.2"), (2, "0")]).time(9),
    ];
    for _ in 0..5 {
        let (damping, speed) = (10f64.powf(2.5 * random() - 2.0), 0.3 + 4.0 * random());
        problems.push(rod().damping(damping).impact_speed(speed));
    }
    let all: Vec<Quantity> = Needs::Time.quantities().collect();
    for (name, problem) in problems.into_iter().map(|problem| problem.build().unwrap()).enumerate() {
        let history = problem.doubles().unwrap();
        let (end, trip) = (*history.end(), history.scales().time);
        let mut times: Vec<f64> = (0..20).map(|_| end * random()).collect();
        times.extend((0..40).map(|k| 0.25 * trip * f64::from(k)));
        times.extend(history.events().iter().flat_map(|event| [event.t, event.t + 0.5 * trip]));
        times.extend([0.0, end, end]);
        times.retain(|time| *time <= end);
        times.sort_by(f64::total_cmp);
        let bits =
            |table: &[Vec<f64>], row: usize| table.iter().map(|values| values[row].to_bits()).collect::<Vec<_>>();
        for side in [Side::Left, Side::Right] {
            let table = history.columns(&all, &times, Some(side)).unwrap();
            let alone = problem.doubles().unwrap();
            for (row, time) in times.iter().enumerate().rev() {
                // The first ones of a history that has been asked nothing yet.
                let fresh = (row % 16 == 0).then(|| problem.doubles().unwrap());
                let found = fresh.as_ref().unwrap_or(&alone).columns(&all, &[*time], Some(side)).unwrap();
                assert_eq!(bits(&table, row), bits(&found, 0), "problem {name} at {time}, {side:?}");
            }
        }
    }
}
