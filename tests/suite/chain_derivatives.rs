//! Derivatives of the numbers of whole chains, against closed forms and difference quotients of exact runs.

use dalembert::chain::{Body, Chain, ChainColumn, ChainHistory, ChainNumbers, ChainQuantity, End};
use dalembert::number::{Scalar, Value};
use dalembert::reason::Warning;
use dalembert::solve::NoDerivative;
use dalembert::{ChainScene, Derivative, Error, EventKind, Number, Numbers, Parameter, Side};

use crate::random_chain::Random;

fn number(text: &str) -> Number {
    text.parse().unwrap()
}

/// Bars of impedance 3 and 2 that meet at t = 1 at the speed one.
fn two_bars() -> Chain {
    let bar = |length: i64, impedance: i64| Body::new(length.into(), 1.into(), impedance.into());
    let upper = bar(2, 2).with_velocity((-1).into());
    Chain::builder(bar(4, 3)).contact(1.into(), upper).until(6.into()).build().unwrap()
}

fn by(history: &ChainHistory, parameter: &str, column: &str, time: &Number) -> Derivative<Value> {
    let column = ChainColumn::read(column, history.chain()).unwrap();
    let numbers = ChainNumbers::Columns { columns: &[column], times: std::slice::from_ref(time), side: Side::Right };
    history.derivatives(parameter.parse().unwrap(), numbers).unwrap().remove(0).remove(0).unwrap()
}

/// **Source**: `f = v Z₁Z₂/(Z₁ + Z₂)` until the wave in the shorter bar returns.
#[test]
fn the_force_between_two_bars_changes_as_its_closed_form() {
    for numbers in [Numbers::Exact, Numbers::default(), Numbers::ExactThenDigits(30)] {
        let history = two_bars().solve(numbers).unwrap();
        let slope = |parameter: &str| by(&history, parameter, "force.1", &number("3/2")).value().unwrap().to_f64();
        for (parameter, expected) in [
            ("body.1.impedance", 4.0 / 25.0),
            ("body.2.impedance", 9.0 / 25.0),
            ("body.2.velocity", -6.0 / 5.0),
            ("joint.1.gap", 0.0),
            ("body.2.length", 0.0),
            ("gravity", 0.0),
        ] {
            assert!((slope(parameter) - expected).abs() < 1e-15, "{parameter} in {numbers}");
        }
        assert!(history.warnings().is_empty(), "{:?}", history.warnings());
        // Impact at gap/v, release 2L/c later.
        let times = history.derivatives("body.2.wave_speed".parse().unwrap(), ChainNumbers::Events).unwrap();
        let times: Vec<f64> = times.iter().map(|row| row[0].as_ref().unwrap().value().unwrap().to_f64()).collect();
        assert_eq!(times, [0.0, -4.0]);
    }
}

/// At the time of the impact, a shorter gap leaves the force as it is, and a longer one takes it away.
#[test]
fn a_number_that_jumps_has_a_derivative_on_one_side() {
    let history = two_bars().solve(Numbers::Exact).unwrap();
    let found = by(&history, "joint.1.gap", "force.1", &1.into());
    let [left, right] = found.sides();
    assert_eq!((left.map(Value::to_f64), right.map(Value::to_f64)), (Ok(0.0), Err(NoDerivative::Jumps)));
}

/// **Source**: a mass m that strikes a rod of impedance one at the speed one pushes with `e^{−t/m}`, which changes with
/// the mass by `t e^{−t/m}/m²`.
#[test]
fn the_force_below_a_mass_changes_as_its_closed_form() {
    let mass = Body::rigid(2.into()).with_velocity((-1).into());
    let rod = Body::new(1.into(), 1.into(), 1.into());
    let chain = Chain::builder(rod).contact(0.into(), mass).bottom(End::Velocity(Vec::new())).until(1.into());
    let chain = chain.build().unwrap();
    let expected = 0.5 / 4.0 * (-0.25f64).exp();
    for (numbers, accuracy) in [(Numbers::default(), 1e-9), (Numbers::Digits(25), 1e-16)] {
        let history = chain.solve(numbers).unwrap();
        let found = by(&history, "body.2.mass", "force.1", &number("1/2"));
        let found = found.value().unwrap();
        assert!((found.to_f64() - expected).abs() < accuracy, "{found} for {expected}");
        assert!(found.bound().to_f64() < accuracy);
        let is_estimate = |warning: &Warning| matches!(warning, Warning::EstimatedErrors { .. });
        assert!(history.warnings().iter().any(is_estimate));
    }
    let proved = chain.solve(Numbers::Certified(10)).unwrap();
    let refused = proved.derivatives("body.2.mass".parse().unwrap(), ChainNumbers::Events);
    assert!(matches!(refused, Err(Error::Derivative { .. })));
}

#[test]
fn bad_requests_name_what_is_wrong() {
    let history = two_bars().solve(Numbers::default()).unwrap();
    let events = |parameter: &str| history.derivatives(parameter.parse().unwrap(), ChainNumbers::Events);
    assert!(events("length").unwrap_err().to_string().contains("body.1.length"));
    assert!(events("body.3.length").unwrap_err().to_string().contains("found the value body.3.length"));
    let fields = |point: i64, time: i64| {
        let (points, times) = ([point.into()], [time.into()]);
        let numbers = ChainNumbers::Fields { bodies: &[1], points: &points, times: &times, side: Side::Right };
        history.derivatives("gravity".parse().unwrap(), numbers).map(|_| ())
    };
    assert!(matches!(fields(3, 1), Err(Error::PointOutside { .. })));
    assert!(matches!(fields(1, 7), Err(Error::TimeOutside { .. })));
    assert!(fields(1, 1).is_ok());
    let other = ChainColumn { quantity: ChainQuantity::Force, place: 3 };
    assert!(matches!(history.value(other, &1.into(), Side::Right), Err(Error::Problem(_))));
    assert!(matches!(history.field(2, &1.into(), &1.into(), Side::Right), Err(Error::Problem(_))));
    let numbers = ChainNumbers::Columns { columns: &[other], times: &[1.into()], side: Side::Right };
    assert!(matches!(history.derivatives("gravity".parse().unwrap(), numbers), Err(Error::Problem(_))));
    // Bars that fall to a stop land at 0.3…, which is no fraction: fractions have no derivatives after that.
    let bar = Body::new(1.into(), 1.into(), 1.into());
    let stop = End::Ground { gap: number("1/10"), velocity: Vec::new() };
    let chain = Chain::builder(bar.clone()).bonded(bar).bottom(stop).gravity(2.into()).until(3.into()).build().unwrap();
    let history = chain.solve(Numbers::Exact).unwrap();
    let columns = [ChainColumn::read("h.1", &chain).unwrap()];
    let at = |time: &str| {
        let times = [number(time)];
        let numbers = ChainNumbers::Columns { columns: &columns, times: &times, side: Side::Right };
        history.derivatives("gravity".parse().unwrap(), numbers)
    };
    assert_eq!(at("1/5").unwrap()[0][0].as_ref().unwrap().value().unwrap().to_string(), "-1/50");
    assert!(matches!(at("1"), Err(Error::TimeOutside { .. })));
}

/// The relative step of the quotients: second derivatives cost as much.
const STEP: &str = "1/1000000000000";

/// Rates carried through runs against quotients of exact runs with another value, on both sides.
#[test]
fn rates_of_random_chains_are_those_of_difference_quotients() {
    let (mut compared, mut sided, mut replaced) = (0, 0, 0);
    for seed in 1..=250 {
        let mut random = Random(seed * 7919);
        let chain = random.chain();
        let parameters: Vec<_> = chain.parameters().collect();
        let parameter = parameters[random.below(parameters.len() as u64) as usize];
        let value = chain.value(parameter).unwrap().to_rational();
        let Ok(history) = chain.solve(Numbers::Exact) else { continue };
        let (columns, times) = (ChainColumn::all(&chain), [number("7/3"), number("17/4")]);
        let numbers = [
            ChainNumbers::Events,
            ChainNumbers::Contacts,
            ChainNumbers::Columns { columns: &columns, times: &times, side: Side::Right },
        ];
        let size = if value == Scalar::zero(&value) { Scalar::int(&value, 1) } else { value.magnitude() };
        let steps = [-1i64, 1].map(|sign| size.clone() * number(STEP).to_rational() * Scalar::int(&size, sign));
        for numbers in numbers {
            let Ok(found) = history.derivatives(Parameter::OfChain(parameter), numbers) else { continue };
            // Where another event takes the place of one, no number of its row has a derivative.
            for row in found.iter().filter(|_| matches!(numbers, ChainNumbers::Events)) {
                for side in 0..2 {
                    let has = |cell: &Option<Derivative<Value>>| cell.as_ref().unwrap().sides()[side].is_ok();
                    if row[0].as_ref().unwrap().sides()[side].err() == Some(NoDerivative::Jumps) {
                        assert!(!row.iter().any(has), "{row:?} by {parameter}, seed {seed}");
                        replaced += 1;
                    }
                }
            }
            for (side, step) in steps.iter().enumerate() {
                let moved = number(&(value.clone() + step).to_string());
                let Ok(moved) = chain.with_value(parameter, moved) else { continue };
                let Ok(moved) = moved.solve(Numbers::Exact) else { continue };
                let (own, there) = (keyed(&history, numbers), keyed(&moved, numbers));
                for (k, (key, row)) in own.iter().enumerate() {
                    let Some((_, others)) = there.iter().find(|(other, _)| other == key) else { continue };
                    for (j, pair) in row.iter().zip(others).enumerate() {
                        let (Some(here), Some(there)) = pair else { continue };
                        let derivative = found[k][j].as_ref().unwrap();
                        let [here, there] = [here, there].map(|value| value.as_rational().unwrap().clone());
                        let Ok(rate) = derivative.sides()[side] else { continue };
                        let quotient = Scalar::to_f64(&((there - here) / step));
                        let rate = rate.to_f64();
                        assert!(
                            (quotient - rate).abs() < 1e-6 * (1.0 + rate.abs()),
                            "{quotient} for {rate} by {parameter}, seed {seed}, row {k}, column {j} of {numbers:?}"
                        );
                        compared += 1;
                        sided += usize::from(derivative.value().is_none());
                    }
                }
            }
        }
    }
    assert!(compared > 5000 && sided > 10 && replaced > 0, "{compared} compared, {sided} sided, {replaced} replaced");
}

/// Node, kind and place of the event of a row, or its place alone.
type Key = (usize, String, usize);

/// Returns the numbers by the queries of a history, each row with its key.
fn keyed(history: &ChainHistory, numbers: ChainNumbers<'_>) -> Vec<(Key, Vec<Option<Value>>)> {
    let listing = history.listing().unwrap();
    let owners: Vec<(usize, String)> = match numbers {
        ChainNumbers::Events => listing.events.iter().map(|event| (event.node, event.kind.to_string())).collect(),
        ChainNumbers::Contacts => listing.contacts.iter().map(|contact| (contact.node, String::new())).collect(),
        ChainNumbers::Columns { times, .. } => (0..times.len()).map(|row| (row, String::new())).collect(),
        ChainNumbers::Fields { .. } => Vec::new(),
    };
    let place = |k: usize| owners[..k].iter().filter(|owner| **owner == owners[k]).count();
    let keys = (0..owners.len()).map(|k| (owners[k].0, owners[k].1.clone(), place(k)));
    keys.zip(values(history, numbers)).collect()
}

/// Returns the numbers by the queries of a history.
fn values(history: &ChainHistory, numbers: ChainNumbers<'_>) -> Vec<Vec<Option<Value>>> {
    let listing = history.listing().unwrap();
    match numbers {
        ChainNumbers::Events => {
            let row = |event: &dalembert::chain::ChainEvent<Value>| {
                vec![Some(event.t.clone()), Some(event.before.clone()), Some(event.after.clone())]
            };
            listing.events.iter().map(row).collect()
        }
        ChainNumbers::Contacts => {
            let row = |contact: &dalembert::chain::ChainContact<Value>| {
                let settled = |value: &Value| Some(value.clone()).filter(|_| listing.is_settled(contact));
                let [impulse, peak] = [&contact.impulse, &contact.peak].map(settled);
                vec![Some(contact.impact.clone()), contact.release.clone(), impulse, peak]
            };
            listing.contacts.iter().map(row).collect()
        }
        ChainNumbers::Columns { columns, times, side } => {
            let row = |time: &Number| columns.iter().map(|column| history.value(*column, time, side).ok()).collect();
            times.iter().map(row).collect()
        }
        ChainNumbers::Fields { .. } => Vec::new(),
    }
}

fn solved(name: &str, numbers: Numbers) -> ChainHistory {
    let scene = dalembert::builtin::CHAINS.iter().find(|scene| scene.name == name).unwrap();
    ChainScene::parse(scene.source).unwrap().chain.solve(numbers).unwrap()
}

fn times(history: &ChainHistory, parameter: &str) -> Vec<[Result<f64, NoDerivative>; 2]> {
    let rows = history.derivatives(parameter.parse().unwrap(), ChainNumbers::Events).unwrap();
    rows.iter().map(|row| row[0].as_ref().unwrap().sides().map(|side| side.map(Value::to_f64))).collect()
}

/// **Source**: a bar at 100 m/s strikes another over a gap of 0.02, and a third that comes from the other side at
/// −100 m/s strikes it at the same time; each joint closes at gap/v of its own bar, v = 100, and opens 2L/c later.
#[test]
fn simultaneous_events_have_the_derivatives_of_their_own_joints() {
    let history = solved("schwarz-three-bars", Numbers::Exact);
    let found = times(&history, "body.1.velocity");
    let listing = history.listing().unwrap();
    for (event, sides) in listing.events.iter().zip(&found) {
        let expected = match (event.node, event.kind) {
            (1, EventKind::Impact) => -0.02 / 100.0f64.powi(2),
            (2, EventKind::Impact) => 0.0,
            _ => continue,
        };
        assert_eq!(*sides, [Ok(expected); 2], "{} of joint {}", event.kind, event.node);
    }
}

/// **Source**: bars that touch at the start and close at v = 1/5 close later by gap/v.
#[test]
fn a_gap_that_opens_between_touching_bars_delays_all_events() {
    for numbers in [Numbers::Exact, Numbers::default(), Numbers::ExactThenDigits(30), Numbers::Digits(30)] {
        let found = times(&solved("cirak-west", numbers), "joint.1.gap");
        assert_eq!(found.len(), 2);
        for side in found.concat() {
            assert!((side.unwrap() - 5.0).abs() < 1e-9, "{side:?} in {numbers}");
        }
    }
}

/// **Source**: a difference quotient of two runs to 45 digits with g = 1e-20 and without.
#[test]
fn a_gravity_of_zero_has_derivatives_to_all_digits() {
    let chain = |gravity: &str| {
        let history = solved("saint-venant-mass", Numbers::default());
        history.chain().with_values([(Parameter::Gravity, number(gravity))]).unwrap()
    };
    let last = |gravity: &str| {
        let history = chain(gravity).solve(Numbers::Digits(45)).unwrap();
        let t = history.listing().unwrap().events[2].t.to_string();
        number(&t).to_rational()
    };
    let expected = Scalar::to_f64(&((last("1e-20") - last("0")) / number("1e-20").to_rational()));
    for numbers in [Numbers::default(), Numbers::Digits(20)] {
        let found = times(&solved("saint-venant-mass", numbers), "gravity")[2];
        assert!((found[1].unwrap() - expected).abs() < 1e-8, "{found:?} for {expected} in {numbers}");
    }
}
