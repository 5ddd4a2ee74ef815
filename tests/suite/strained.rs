//! Starts by their strain: those that a displacement gives as well, and the states at rest that it cannot give.

use dalembert::problem::Builder;
use dalembert::rug::Rational;
use dalembert::{Derivative, Parameter, Problem, Quantity, Side};

fn rod() -> Builder {
    Problem::builder().length(2).wave_speed(3).gravity("0.7").time(9)
}

const VELOCITY: [(&str, &str); 4] = [("0", "-0.2"), ("0.5", "-1"), ("0.5", "-0.4"), ("2", "-0.6")];
/// The same start, by its displacement and by its strain.
const DISPLACEMENT: [(&str, &str); 3] = [("0", "0"), ("0.4", "-0.1"), ("2", "0.1")];
const STRAIN: [(&str, &str); 4] = [("0", "-1/4"), ("0.4", "-1/4"), ("0.4", "1/8"), ("2", "1/8")];

fn both(rod: &Builder) -> [Problem; 2] {
    let moving = rod.clone().velocity(VELOCITY);
    [moving.clone().displacement(DISPLACEMENT), moving.strain(STRAIN)].map(|rod| rod.build().unwrap())
}

#[test]
fn a_strain_in_steps_is_a_displacement_in_lines() {
    for rod in [rod(), rod().fixed_top()] {
        let [by_displacement, by_strain] = both(&rod).map(|rod| rod.exact().unwrap());
        assert_eq!(by_displacement.events(), by_strain.events());
        assert_eq!(by_displacement.stress_history().unwrap(), by_strain.stress_history().unwrap());
        let points: Vec<Rational> = (0..=20).map(|k| Rational::from((k, 10))).collect();
        // Up to the first time that is no fraction.
        let end = by_strain.end().clone();
        let times: Vec<Rational> = (0..18).map(|k| Rational::from((k, 18)) * &end).collect();
        for side in [Side::Left, Side::Right] {
            let [a, b] = [&by_displacement, &by_strain].map(|run| run.field(&points, &times, side).unwrap());
            assert_eq!(a, b);
        }
    }
}

#[test]
fn a_damped_strain_in_steps_is_a_displacement_in_lines() {
    for rod in [rod().damping("0.3"), rod().damping("0.3").fixed_top()] {
        let [by_displacement, by_strain] = both(&rod).map(|rod| rod.solve().unwrap());
        let close = |a: &dalembert::Value, b: &dalembert::Value| {
            let bound = a.bound().to_f64() + b.bound().to_f64();
            assert!((a.to_f64() - b.to_f64()).abs() <= bound && bound < 1e-9, "{a} and {b}, {bound:e}");
        };
        let [a, b] = [&by_displacement, &by_strain].map(|run| run.events().unwrap());
        assert_eq!(a.len(), b.len());
        a.iter().zip(&b).for_each(|(a, b)| close(&a.t, &b.t));
        for time in ["1/7", "2/3", "3", "8"] {
            for point in ["0", "1/3", "2"] {
                let [a, b] = [&by_displacement, &by_strain].map(|run| run.at(point, time).unwrap());
                close(&a.displacement, &b.displacement);
                close(&a.velocity, &b.velocity);
                close(&a.strain, &b.strain);
            }
        }
    }
}

/// A rod that stands on the ground, or hangs from its top, under its own weight: `v_xx = g/c² = 7/90`.
#[test]
fn a_rod_at_rest_stays_at_rest() {
    for damping in ["0", "0.4"] {
        let damped = || rod().damping(damping);
        let standing = damped().strain([("0", "-14/90"), ("2", "0")]);
        let hanging = damped().fixed_top().strain([("0", "0"), ("2", "14/90")]);
        for (rod, weight) in [(standing, 1.4), (hanging, 0.0)] {
            let history = rod.build().unwrap().solve().unwrap();
            for time in ["0.1", "2/3", "4/3", "7"] {
                let field = history.at("1", time).unwrap();
                assert!(field.velocity.to_f64().abs() < 1e-12, "{}", field.velocity);
                let strain = history.strain(time, Side::Right).unwrap();
                assert!((strain.to_f64() * 9.0 + weight).abs() < 1e-12, "{strain}");
            }
            assert!(history.contacts().unwrap().iter().all(|contact| contact.release.is_none()));
        }
    }
}

#[test]
fn derivatives_are_those_of_the_displacement() {
    let [by_displacement, by_strain] = both(&rod()).map(|rod| rod.exact().unwrap());
    let quantities = [Quantity::EventTime];
    let of = |run: &dalembert::TypedHistory<Rational>, by| -> Vec<_> {
        let rows = run.derivatives(by, &quantities).unwrap();
        rows.iter().map(|row| row[0].as_ref().and_then(Derivative::value).cloned()).collect()
    };
    let found = of(&by_strain, Parameter::Strain(None));
    assert!(found.iter().flatten().count() > 1);
    assert_eq!(of(&by_displacement, Parameter::Displacement(None)), found);
    assert_eq!(of(&by_displacement, Parameter::Velocity(Some(0))), of(&by_strain, Parameter::Velocity(Some(0))));
    // Both values of the lower part together.
    let parts = [0, 1].map(|k| of(&by_strain, Parameter::Strain(Some(k))));
    let upper = [2, 3].map(|k| of(&by_strain, Parameter::Strain(Some(k))));
    let mut compared = 0;
    for (k, whole) in found.iter().enumerate() {
        let lists = [&parts[0][k], &parts[1][k], &upper[0][k], &upper[1][k]];
        if let ([Some(a), Some(b), Some(c), Some(d)], Some(whole)) = (lists.map(Option::as_ref), whole) {
            assert_eq!(Rational::from(a + b) / -4 + Rational::from(c + d) / 8, *whole);
            compared += 1;
        }
    }
    assert!(compared > 1);
}

#[test]
fn a_start_has_one_of_strain_and_displacement() {
    let rod = || rod().velocity(VELOCITY);
    let error = rod().strain(STRAIN).displacement(DISPLACEMENT).build().unwrap_err().to_string();
    assert_eq!(
        error,
        "found strain as well as displacement, expected one of them: the strain is the displacement's slope"
    );
    // The one that is set last replaces the other.
    let [by_displacement, by_strain] = both(&self::rod());
    assert_eq!(by_displacement.to_builder().strain(STRAIN).build().unwrap(), by_strain);
    assert_eq!(by_strain.to_builder().displacement(DISPLACEMENT).build().unwrap(), by_displacement);
    let scene = dalembert::Scene::from(by_strain.clone());
    assert_eq!(dalembert::Scene::parse(&scene.to_toml()).unwrap().problem, by_strain);
}
