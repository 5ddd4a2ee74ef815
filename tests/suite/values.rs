//! The history without a number type: its values against pencil and paper, and against the typed history.

use dalembert::engine::Motion;
use dalembert::number::List;
use dalembert::quantity::Table;
use dalembert::quantity::{Slice, UnitSystem};
use dalembert::solve::{Places, StressForm};
use dalembert::{Error, Estimate, Numbers, Parameter, Problem, Quantity, Side, Value, Warning};

/// `ρS = 2`, `c = 2`, `t₁ = 1`, and `M = μ/(g t₁) = 3`.
fn rod() -> Problem {
    Problem::builder().length(1).material(4, 1, 2).gravity(1).impact_speed(3).time("3/2").build().unwrap()
}

#[test]
fn values_carry_unit_bound_and_kind() {
    let doubles = rod().solve().unwrap();
    let exact = rod().solve_in(Numbers::Exact).unwrap();
    // The force is E S (μ + g t)/c = 4 (3 + t).
    let force = |history: &dalembert::History| history.at_time(Quantity::Force, "1/3", Side::Right).unwrap();
    let (double, fraction) = (force(&doubles), force(&exact));
    assert_eq!((fraction.to_string(), fraction.unit()), ("40/3".into(), "N"));
    assert!(fraction.is_exact() && fraction.is_proved() && fraction.as_rational().is_some());
    assert!(!double.is_exact() && !double.is_proved() && double.is_double());
    assert!((double.to_f64() - 40.0 / 3.0).abs() <= double.bound().to_f64() && double.bound().to_f64() < 1e-13);
    assert_eq!(serde_json::to_string(&fraction).unwrap(), "\"40/3\"");
    assert_eq!(serde_json::to_value(&double).unwrap().as_f64(), Some(double.to_f64()));
    // ρ S L (2 μ + g t₁): the momentum that turns round, and what gravity gave in the contact.
    let contacts = exact.contacts().unwrap();
    assert_eq!((contacts[0].impulse.to_string(), contacts[0].impulse.unit()), ("14".into(), "N s"));
    assert_eq!(contacts[0].release.as_ref().map(Value::to_string), Some("1".into()));
    assert_eq!(exact.events().unwrap().len(), 2);
    let energy = exact.energy("1/2").unwrap();
    // E = ρSL μ²/2 at the touch, and it is kept.
    assert_eq!((energy.total.to_string(), energy.total.unit()), ("9".into(), "J"));
}

#[test]
fn every_question_agrees_with_the_typed_history() {
    let (history, typed) = (rod().solve().unwrap(), rod().doubles().unwrap());
    let times = [0.0, 0.25, 0.5, 1.25];
    let quantities = [Quantity::Time, Quantity::EndVelocity, Quantity::Strain, Quantity::Force, Quantity::Energy];
    let values = history.sample(&quantities, &Places::from(&times[..]), Some(Side::Left)).unwrap();
    let numbers = typed.columns(&quantities, &times, Some(Side::Left)).unwrap();
    let mut compared = 0;
    for (values, numbers) in values.iter().zip(&numbers) {
        for (value, number) in values.iter().zip(numbers) {
            assert_eq!(value, number);
            compared += 1;
        }
    }
    assert_eq!(compared, 20);
    let points = List::equally_spaced("0..1:3").unwrap();
    let (at, list) = (Places::from(&points), List::equally_spaced("1/4,1/2").unwrap());
    let field = history.sample_field(Slice::Points, &at, &Places::from(&list), Some(Side::Right)).unwrap();
    let exactly = |list: &[f64]| list.iter().map(|x| Estimate::exact(*x)).collect();
    let grid = |_: &dyn Motion<_>| Ok((exactly(&[0.0, 0.5, 1.0]), exactly(&[0.25, 0.5])));
    let numbers = typed.ask_slices(Slice::Points, Some(Side::Right), grid).unwrap();
    let same = |(values, numbers): (&Vec<Value>, &Vec<Estimate<f64>>)| {
        values.iter().zip(numbers).all(|(a, b)| *a == *b.value())
    };
    assert!(field.iter().zip(&numbers).all(same));
    assert_eq!((field.len(), field[0].len()), (6, 6));
    let found = history.at("1/2", "1/8").unwrap();
    // The wave front is at x = c t = 1/4: above it the rod falls freely.
    assert_eq!((found.velocity.to_f64(), found.velocity.unit()), (-3.125, "m/s"));
    let listing = history.listing(Some(StressForm::Series), true).unwrap();
    assert_eq!((listing.events.len(), listing.contacts.len(), listing.stress.len()), (2, 1, 2));
    assert_eq!(listing.contacts[0].len(), Table::Contacts.quantities().len());
    assert!(history.in_units(UnitSystem::Si).units().has_material());
}

#[test]
fn a_time_that_is_no_number_is_refused_by_name() {
    let error = rod().solve().unwrap().strain("soon", Side::Right).unwrap_err();
    assert!(matches!(&error, Error::Spelling { quantity: "time", .. }), "{error}");
    assert!(error.to_string().starts_with("time: "), "{error}");
}

/// Rates that are carried through a run have bounds; derivatives from other runs do not, and a warning says so.
#[test]
fn estimated_errors_of_derivatives_are_warned_of() {
    let rod = |damping| Problem::builder().length(1).wave_speed(1).damping(damping).impact_speed(3).build().unwrap();
    let warned = |problem: &Problem, by: Parameter| {
        let history = problem.solve().unwrap();
        history.derivatives(by, &[Quantity::EventTime]).unwrap();
        let warnings = history.warnings();
        let estimated = warnings.iter().filter(|warning| matches!(warning, Warning::EstimatedErrors { .. }));
        estimated.map(ToString::to_string).collect::<Vec<_>>()
    };
    assert_eq!(warned(&rod("0"), Parameter::Length), [""; 0]);
    let by = |name: &str| vec![format!("the errors of the derivatives by {name} are estimates, no bounds")];
    assert_eq!(warned(&rod("0.1"), Parameter::Length), by("length"));
    assert_eq!(warned(&rod("0"), Parameter::Damping), by("damping"));
}
