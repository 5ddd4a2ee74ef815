//! Derivatives of columns and of the field at times, and those by the numbers of a start that is not uniform: by hand
//! and by Euler's identities.

use crate::command::{json, quiet};
use crate::command_samples::names;
use crate::common::{compares, uniform};
use crate::derivatives::{bessel, dimension, given, linear_starts, meets, number, undamped};
use dalembert::rug::Rational;
use dalembert::{Derivative, Error, Number, Parameter, Problem, Quantity, Run, Side};
use proptest::prelude::*;

/// Columns with the powers of length in them; per ρS where that is part of them.
const COLUMNS: [(Quantity, i32); 12] = [
    (Quantity::EndDisplacement, 1),
    (Quantity::EndVelocity, 1),
    (Quantity::TopDisplacement, 1),
    (Quantity::TopVelocity, 1),
    (Quantity::Centre, 1),
    (Quantity::CentreVelocity, 1),
    (Quantity::Strain, 0),
    (Quantity::Impulse, 2),
    (Quantity::Energy, 3),
    (Quantity::VibrationalEnergy, 3),
    (Quantity::StrainEnergy, 3),
    (Quantity::Contact, 0),
];
/// Those of the first six that are the rate of the one before.
const DISPLACEMENTS: [usize; 3] = [0, 2, 4];
const FIELD: [Quantity; 3] = [Quantity::PointDisplacement, Quantity::PointVelocity, Quantity::PointStrain];

fn text(x: &Rational) -> Number {
    x.to_string().parse().unwrap()
}

type Table = Vec<Vec<Option<Derivative<Rational>>>>;

/// `Σ a p ∂f/∂p` over the values p of the problem, which have the dimension to the power a; `None` where a derivative
/// is not the same from both sides.
fn sum(tables: &[(Parameter, Rational, Table)], (row, column): (usize, usize), power: usize) -> Option<Rational> {
    let term = |(by, value, table): &(Parameter, Rational, Table)| {
        if value.is_zero() {
            return Some(Rational::new());
        }
        let (length, time) = dimension(*by);
        Some(table[row][column].as_ref()?.value()?.clone() * value * [length, time][power])
    };
    tables.iter().map(term).sum()
}

/// A value at a time scales with the lengths that are given, the time as it is; a displacement with the times that are
/// given and with t, by which its derivative is the velocity. Of the field x is one of the lengths.
fn euler_identities(cases: u32, least: [u32; 3], rods: impl Strategy<Value = Problem>) {
    compares(cases, least, (rods, 1i64..48, 0i64..=4), |(problem, part, place)| {
        let history = problem.exact().unwrap();
        let time = history.end().clone() * Rational::from((part, 48));
        let point = problem.length().to_rational() * Rational::from((place, 4));
        let (times, points) = ([text(&time)], [text(&point)]);
        let columns = COLUMNS.map(|(quantity, _)| quantity);
        let values = history.columns(&columns, std::slice::from_ref(&time), Some(Side::Right)).unwrap();
        let [before, field] = [Side::Left, Side::Right].map(|side| {
            history.field(std::slice::from_ref(&point), std::slice::from_ref(&time), side).unwrap().remove(0)
        });
        let of = |quantities: &[Quantity], points: &[Number]| -> Vec<(Parameter, Rational, Table)> {
            let table = |by| history.derivatives_at(by, quantities, &times, points, Side::Right).unwrap();
            given(&problem).into_iter().map(|(by, value)| (by, value, table(by))).collect()
        };
        let (over_time, along) = (of(&columns, &[]), of(&FIELD, &points));
        let (mut smooth, mut kinks, mut fields) = (0, 0, 0);
        for (k, (quantity, power)) in COLUMNS.iter().enumerate() {
            match sum(&over_time, (0, k), 0) {
                Some(sum) => prop_assert_eq!(sum, values[k][0].clone() * *power, "{:?}", quantity),
                None => kinks += 1,
            }
        }
        for k in DISPLACEMENTS {
            if let Some(sum) = sum(&over_time, (0, k), 1) {
                prop_assert_eq!(sum, -(time.clone() * &values[k + 1][0]), "{:?}", COLUMNS[k]);
                smooth += 1;
            }
        }
        if let (Some(length), Some(by_time)) = (sum(&along, (0, 0), 0), sum(&along, (0, 0), 1)) {
            // A ray that meets the top is still on its way there in a longer rod.
            let sides = if place == 4 { vec![&before, &field] } else { vec![&field] };
            let expected = sides.iter().map(|side| field.displacement.clone() - point.clone() * &side.strain);
            let expected: Vec<_> = expected.collect();
            prop_assert!(expected.contains(&length), "{:?} {:?}", length, expected);
            prop_assert_eq!(by_time, -(time * &field.velocity));
            fields += 1;
        }
        Ok([smooth, kinks, fields])
    });
}

#[test]
fn euler_identities_of_uniform_starts() {
    euler_identities(80, [55, 1, 50], undamped());
}

#[test]
fn euler_identities_of_other_starts() {
    euler_identities(40, [35, 0, 30], linear_starts());
}

/// In the first contact of a damped rod without gravity the strain at the ground is `−(μ/c) e^{−rt} I₀(rt)`, whose
/// derivative by r is `−(μ/c) t e^{−rt} (I₁ − I₀)`.
#[test]
fn the_strain_of_a_damped_rod() {
    let rod = uniform("1", "2", "0", "3", Run::Impacts(1)).to_builder().damping(number("0.25")).build().unwrap();
    let history = rod.doubles().unwrap();
    let (c, mu, r) = (2.0, 3.0, 0.25);
    let times = ["0.1", "0.5", "0.9"].map(number);
    let of = |by| history.derivatives_at(by, &[Quantity::Strain], &times, &[], Side::Right).unwrap();
    let (by_damping, by_speed, by_wave_speed) =
        (of(Parameter::Damping), of(Parameter::ImpactSpeed), of(Parameter::WaveSpeed));
    for (k, time) in times.iter().map(Number::to_f64).enumerate() {
        let (i0, i1, decay) = (bessel(0, r * time), bessel(1, r * time), (-r * time).exp());
        let by_hand = [
            (&by_damping, -mu / c * time * decay * (i1 - i0)),
            (&by_speed, -decay * i0 / c),
            (&by_wave_speed, mu / (c * c) * decay * i0),
        ];
        for (found, expected) in by_hand {
            let found = found[k][0].as_ref().unwrap().value().unwrap();
            meets(found, expected);
            assert!(found.bound() < 1e-8, "{found:?}");
        }
    }
}

/// Where a ray passes. Behind the first front `v_t(0.5, t)` is −g t of all rods, before it −μ − g t: a faster ray has
/// passed, and a slower one has not. A displacement has two derivatives, `v = −(μ + g t)(t − x/c)⁻…` one of them zero.
#[test]
fn beside_a_ray() {
    let rod = uniform("1", "1", "1", "3", Run::Time(number("1")));
    let history = rod.exact().unwrap();
    let (time, point) = ([number("1/2")], [number("1/2")]);
    let found = history.derivatives_at(Parameter::WaveSpeed, &FIELD, &time, &point, Side::Right).unwrap();
    // On the ray v = −μ t − g t²/2. Ahead of it c does not matter; behind v = −(μ + g t)x/c + g x²/2c², by the front
    // v_x = −(μ + g(t − x/c))/c integrated from the ground, and ∂v/∂c is (μ + g t)x/c² − g x²/c³ = 7/4 − 1/4.
    let Some(Derivative::Sides { left: Ok(left), right: Ok(right) }) = &found[0][0] else { panic!("{:?}", found[0]) };
    assert_eq!((left, right), (&Rational::new(), &Rational::from((3, 2))));
    let [slower, faster] = found[0][1].as_ref().unwrap().sides();
    assert!(slower.is_err() && faster.is_ok(), "{:?}", found[0][1]);
    // A shorter rod has no such point as its top: there is one side, and v_x vanishes there at every length.
    let top = history.derivatives_at(Parameter::Length, &FIELD, &[number("1/4")], &[number("1")], Side::Right).unwrap();
    assert_eq!(top[0], vec![Some(Derivative::One(Rational::new())); 3]);
}

#[test]
fn what_has_no_derivative_at_a_time_is_refused() {
    let history = uniform("1", "1", "1", "3", Run::Impacts(1)).exact().unwrap();
    let ask = |quantity, times: &[&str], points: &[&str]| {
        let [times, points] = [times, points].map(|list| list.iter().map(|x| number(x)).collect::<Vec<_>>());
        history.derivatives_at(Parameter::ImpactSpeed, &[quantity], &times, &points, Side::Right).map(|_| ())
    };
    assert!(matches!(ask(Quantity::Strain, &["100"], &[]), Err(Error::TimeOutside { .. } | Error::BeyondEnd { .. })));
    assert!(matches!(ask(Quantity::Strain, &["-1"], &[]), Err(Error::TimeOutside { .. })));
    assert!(matches!(ask(Quantity::PointStrain, &["1"], &["1.5"]), Err(Error::PointOutside { .. })));
    assert!(matches!(ask(Quantity::PointStrain, &["1"], &[]), Err(Error::NotOverTime { .. })));
    assert!(matches!(ask(Quantity::Strain, &["1"], &["1/2"]), Err(Error::NotAlong { .. })));
    assert_eq!(ask(Quantity::Strain, &[], &[]), Ok(()));
}

/// GetFEM's compressed rod, on the ground from 1 to 2: `v_t(0,·) = −v(0,0)/L` before it.
#[test]
fn the_command() {
    let asked = "sample getfem-dynamic-contact --quantity end --times 1/2,3/2 --exact";
    let by = "--derivatives displacement[0],length";
    let found = json(&format!("{asked} {by}"));
    let rows = found["rows"].as_array().unwrap();
    assert_eq!(rows[0], serde_json::json!(["1/2", "right", "1/4", "-1/2", "1/2", "-1", "1/4", "1/2"]));
    assert_eq!(rows[1], serde_json::json!(["3/2", "right", "0", "0", "0", "0", "0", "0"]));
    assert_eq!(names(&found)[4..6], ["u_end_by_displacement[0]", "v_end_by_displacement[0]"]);
    // On the ray of the impact the sides differ, and a velocity has a derivative on one of them.
    let found = json("sample getfem-dynamic-contact --quantity v_end --times 1 --exact --derivatives length");
    assert_eq!(found["rows"], serde_json::json!([["1", "right", "0", null, "0", "jumps"]]));
    let csv = quiet(&format!("{asked} {by} --format csv"));
    assert!(csv.contains(",u_end_by_displacement[0],v_end_by_displacement[0],"), "{csv}");
    let shown = quiet(&format!("{asked} {by}"));
    assert!(
        shown.contains("by displacement[0]:") && shown.contains(" t = 1/2   both        1/2           -1"),
        "{shown}"
    );
}
