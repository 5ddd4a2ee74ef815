//! Bodies of random chains as problems of their own, against the chain itself.

use crate::random_chain::Random;
use dalembert::Numbers;
use dalembert::Side;
use dalembert::chain::{Body, Chain, ChainColumn, ChainParameter, ChainQuantity, End};
use dalembert::number::{Bounded, Number, Rational, Scalar, Value};
use dalembert::problem::{Parameter, Problem};
use dalembert::quantity::{Quantity, Undefined, Units};
use dalembert::reason::Warning;

fn number(text: &str) -> Number {
    text.parse().unwrap()
}

/// Returns a quantity of a body, in fractions and in the units of the chain.
fn exact(problem: &Problem, quantity: Quantity, time: &Number, side: Side) -> Value {
    problem.solve_in(Numbers::Exact).unwrap().at_time(quantity, time.clone(), side).unwrap()
}

#[test]
fn bodies_move_as_in_the_chain() {
    let mut random = Random(4711);
    let quantities =
        ["u_end", "v_end", "u_top", "v_top", "force_top", "h", "h_rate", "kinetic", "strain_energy", "E_total"];
    let mut compared = 0;
    for _ in 0..25 {
        let chain = random.chain();
        let whole = chain.solve(Numbers::Exact).unwrap();
        let problems: Vec<_> = chain.problems().unwrap().into_iter().flatten().collect();
        for time in ["37/29", "5/2", "113/19"].map(number) {
            for (k, problem) in problems.iter().enumerate() {
                if problem.solve_in(Numbers::Exact).unwrap().end().to_f64() < time.to_f64() {
                    continue;
                }
                for name in quantities {
                    let quantity = name.parse::<Quantity>().unwrap();
                    let column = match name {
                        // The node above the body.
                        "force_top" => ChainColumn { quantity: ChainQuantity::Force, place: k + 1 },
                        _ => ChainColumn::read(&format!("{name}.{}", k + 1), &chain).unwrap(),
                    };
                    for side in [Side::Left, Side::Right] {
                        let expected = whole.value(column, &time, side).unwrap();
                        let found = exact(problem, quantity, &time, side);
                        assert_eq!(found.to_string(), expected.to_string(), "{name} of {k} at {time} of {chain:?}");
                        compared += 1;
                    }
                }
                let energy = exact(problem, Quantity::TranslationalEnergy, &time, Side::Right).to_f64()
                    + exact(problem, Quantity::VibrationalEnergy, &time, Side::Right).to_f64();
                let total = exact(problem, Quantity::Energy, &time, Side::Right).to_f64();
                assert!((energy - total).abs() <= 1e-12 * (1.0 + total.abs()));
            }
        }
    }
    assert!(compared > 1500, "{compared}");
}

/// Returns the chain with all events of its joints seen by the bodies above them.
#[test]
fn contacts_of_bodies_are_those_of_the_joints_below_them() {
    let mut random = Random(99);
    let mut contacts = 0;
    for _ in 0..40 {
        let chain = random.chain();
        let listing = |numbers| chain.solve(numbers).unwrap().listing().unwrap();
        let listings = [listing(Numbers::Exact), listing(Numbers::Digits(30))];
        for (k, problem) in chain.problems().unwrap().iter().flatten().enumerate() {
            let long = problem.solve_in(Numbers::Digits(30)).unwrap();
            for numbers in [Numbers::Exact, Numbers::default(), Numbers::Digits(20)] {
                let listing = &listings[usize::from(numbers != Numbers::Exact)];
                let history = problem.solve_in(numbers).unwrap();
                let found = history.contacts().unwrap();
                let expected: Vec<_> = listing.contacts.iter().filter(|contact| contact.node == k).collect();
                assert_eq!(found.len(), expected.len(), "{chain:?}");
                for (found, expected) in found.iter().zip(expected) {
                    let near = |found: &Value, expected: &Value| {
                        let off = (found.to_f64() - expected.to_f64()).abs();
                        assert!(off <= found.log2_error().exp2() + 1e-15 * expected.to_f64().abs(), "{chain:?}");
                    };
                    near(&found.impact, &expected.impact);
                    assert_eq!(found.release.is_some(), expected.release.is_some());
                    near(&found.impulse, &expected.impulse);
                    contacts += 1;
                }
                // The impulse of a flight changes nothing but gravity: h′ at the events against momentum.
                for event in history.events().unwrap() {
                    let truth =
                        long.at_time(Quantity::CentreVelocity, spelled(&event.t), Side::Right).unwrap().to_f64();
                    let off = (event.h_rate.to_f64() - truth).abs();
                    let allowed = event.h_rate.log2_error().exp2() + event.t.log2_error().exp2() * 1e3 + 1e-13;
                    assert!(off <= allowed, "{off:e} {allowed:e} {chain:?}");
                    assert!(event.h_rate.log2_error().exp2() < 1e-6, "{event:?} {chain:?}");
                }
            }
        }
    }
    assert!(contacts > 100, "{contacts}");
}

/// Values in doubles at the times of events, beside them and elsewhere are within their bounds of the fractions.
#[test]
fn doubles_are_within_their_bounds() {
    let mut random = Random(31_337);
    let (mut compared, mut at_events) = (0, 0);
    let names = ["u_end", "v_end", "u_top", "v_top", "h", "h_rate", "force", "E_total", "E_z", "impulse"];
    let quantities = names.map(|name| name.parse::<Quantity>().unwrap());
    let chains = if cfg!(feature = "mp") { 15 } else { 5 };
    for _ in 0..chains {
        let chain = random.chain();
        let listing = chain.solve(Numbers::Exact).unwrap().listing().unwrap();
        let events = &listing.events;
        let beside = |text: &str, by: &str| {
            let shifted = number(text).to_rational() + number(by).to_rational();
            shifted.to_string().parse::<Number>().ok()
        };
        let mut times: Vec<Number> = ["37/29", "2.7182818284590452353602", "4.1"].map(number).into();
        for event in events.iter().take(6) {
            let text = event.t.to_string();
            times.extend(["0", "1e-15", "-1e-15", "1e-30"].iter().filter_map(|by| beside(&text, by)));
        }
        for problem in chain.problems().unwrap().into_iter().flatten() {
            let exact = problem.solve_in(Numbers::Exact).unwrap();
            let doubles = problem.solve().unwrap();
            for time in &times {
                if time.to_f64() < 0.0 || exact.end().to_f64() <= time.to_f64() {
                    continue;
                }
                for quantity in quantities {
                    for side in [Side::Left, Side::Right] {
                        let (Ok(expected), Ok(found)) = (
                            exact.at_time(quantity, time.clone(), side),
                            doubles.at_time(quantity, time.clone(), side),
                        ) else {
                            panic!(
                                "{quantity} at {time} of {chain:?}: {:?}",
                                doubles.at_time(quantity, time.clone(), side)
                            );
                        };
                        let truth = number(&expected.to_string()).to_rational();
                        let value = Rational::try_from(found.to_f64()).unwrap();
                        let off = Scalar::to_f64(&Scalar::magnitude(&(value - truth)));
                        let bound = found.log2_error().exp2();
                        assert!(off <= bound, "{quantity} {side} at {time}: {off:e} > {bound:e} of {chain:?}");
                        compared += 1;
                    }
                }
                at_events += 1;
            }
        }
    }
    assert!(compared > 250 * chains && at_events > 10 * chains, "{compared} {at_events}");
}

/// A double next to the time of a ray is the time of the ray: at it a history in doubles has both limits of fractions.
#[test]
fn doubles_next_to_rays_have_both_limits() {
    let mut random = Random(8_128);
    let quantities = ["v_end", "strain", "v_top"].map(|name| name.parse::<Quantity>().unwrap());
    let (mut compared, mut jumps) = (0, 0);
    for _ in 0..12 {
        let chain = random.chain();
        for problem in chain.problems().unwrap().into_iter().flatten() {
            let (exact, doubles) = (problem.exact().unwrap(), problem.doubles().unwrap());
            let ends = exact.ask(|motion| motion.departures(), |_| Vec::new()).unwrap();
            let digits = problem.digits(20).unwrap().ask(|motion| motion.departures(), |_| Vec::new()).unwrap();
            // Digits do not know that a jump is zero.
            assert!(ends.iter().zip(&digits).all(|(exact, found)| exact.len() <= found.len()), "{chain:?}");
            let end = *doubles.end() * (1.0 - 1e-9);
            let rays = ends.into_iter().flatten().map(|(time, _)| time);
            let rays: Vec<Rational> = rays.filter(|time| (1e-9..end).contains(&time.to_f64())).step_by(5).collect();
            let near: Vec<f64> = rays.iter().map(Scalar::to_f64).collect();
            let both = [Side::Left, Side::Right].map(|side| {
                let expected = exact.columns(&quantities, &rays, Some(side)).unwrap();
                let found = doubles.columns(&quantities, &near, Some(side)).unwrap();
                for (expected, found) in expected.iter().flatten().zip(found.iter().flatten()) {
                    let off = (expected.to_f64() - found).abs();
                    assert!(off <= 1e-9 * (1.0 + found.abs()), "{side}: {found} for {expected} of {chain:?}");
                    compared += 1;
                }
                expected
            });
            jumps +=
                both[0].iter().flatten().zip(both[1].iter().flatten()).filter(|(left, right)| left != right).count();
        }
    }
    assert!(compared > 1_000 && jumps > 200, "{compared} {jumps}");
}

/// Returns the number that a value prints.
fn spelled(value: &Value) -> Number {
    value.to_string().parse().unwrap()
}

#[test]
fn derivatives_of_a_body_are_those_of_its_closed_form() {
    // Two bars of impedance 1 and Z: the force is v Z/(1 + Z) until the wave returns from the lower one at 2L/c.
    let bar = |impedance: &str| dalembert::chain::Body::new(1.into(), 1.into(), number(impedance));
    let chain = Chain::builder(bar("1")).contact(number("0.5"), bar("3").with_velocity((-1).into())).until(3.into());
    let history = chain.build().unwrap().problem(1).unwrap().solve().unwrap();
    let by = |parameter: Parameter, quantity: Quantity| {
        let found = history.derivatives_at(parameter, &[quantity], &[number("1.1")], &[], Side::Right).unwrap();
        let derivative = found[0][0].clone().unwrap();
        let [left, right] = derivative.sides().map(|side| side.unwrap().to_f64());
        assert!((left - right).abs() < 1e-6);
        right
    };
    // dF/dv for a velocity v times the profile; dF/dZ with E = Zc and ρ = Z/c through the modulus: Z ∝ √E.
    assert!((by(Parameter::Velocity(None), Quantity::Force) - 0.75).abs() < 1e-6);
    let by_modulus = by(Parameter::Modulus, Quantity::Force);
    // F = Z/(1 + Z) at the speed 1, dF/dE = F′(Z) dZ/dE = 1/(1 + Z)² · Z/(2E) with Z = E = 3.
    assert!((by_modulus - 1.0 / 32.0).abs() < 1e-6, "{by_modulus}");
}

#[test]
fn a_changed_body_is_a_changed_chain() {
    let bar = |velocity: i64| dalembert::chain::Body::new(1.into(), 1.into(), 2.into()).with_velocity(velocity.into());
    let chain = Chain::builder(bar(0)).contact(1.into(), bar(-1)).until(6.into()).build().unwrap();
    let upper = chain.problem(1).unwrap();
    let longer = upper.to_builder().set(Parameter::Time, 8).build().unwrap();
    assert_eq!(longer.chain().unwrap().0.until(), &Number::from(8));
    assert_eq!(longer.solve().unwrap().end().to_f64(), 8.0);
    let error = upper.to_builder().damping("0.1").build().unwrap_err();
    assert_eq!(error.path, "rod.damping");
    assert!(upper.to_builder().impacts(3).build().is_err());
    assert!(upper.to_builder().impact_speed(3).build().is_err());
    assert_eq!(
        Units::new(&upper, Default::default())
            .factor::<Rational>(dalembert::quantity::Measure::Force, &())
            .map(|f| f.same(&Rational::from(-2))),
        Some(true)
    );
}

/// Returns the chain of a built-in scene.
fn builtin(name: &str) -> Chain {
    dalembert::ChainScene::parse(dalembert::builtin::get(name).unwrap().source).unwrap().chain
}

/// Computes the central difference quotient of a quantity of the first body in fractions, and its change between two
/// steps.
fn quotient(chain: &Chain, by: ChainParameter, quantity: Quantity, time: &Number) -> Option<[f64; 2]> {
    let value = chain.value(by)?.to_rational();
    let moved = |step: Rational| -> Option<Rational> {
        let number = (value.clone() + step).to_string().parse::<Number>().ok()?;
        let moved = chain.with_value(by, number).ok()?.problem(0).ok()?;
        let history = moved.solve_in(Numbers::Digits(60)).ok()?;
        let found = history.at_time(quantity, time.clone(), Side::Right).ok()?;
        spelled(&found).to_rational().into()
    };
    let slope = |exponent: u32| {
        let h = Rational::from(1) / Rational::from(10i64.pow(exponent));
        let rise = moved(h.clone())? - moved(-h.clone())?;
        Some(Scalar::to_f64(&(rise / (h.clone() + &h))))
    };
    Some([slope(12)?, slope(13)?])
}

#[test]
fn derivatives_by_values_of_the_whole_chain_are_difference_quotients() {
    let mut random = Random(2027);
    let quantities = ["u_top", "v_end", "force_top", "E_total"].map(|name| name.parse::<Quantity>().unwrap());
    let time = number("43/17");
    let mut counts = [[0, 0]; 2];
    for k in 0..18 {
        let chain = random.chain();
        let problem = chain.problem(0).unwrap();
        // Exact rates of the run in fractions, and quotients in digits.
        let (numbers, counts) = match k % 3 {
            0 => (Numbers::Digits(20), &mut counts[0]),
            _ => (Numbers::Exact, &mut counts[1]),
        };
        let history = problem.solve_in(numbers).unwrap();
        if history.end().to_f64() < time.to_f64() {
            continue;
        }
        for by in chain.parameters() {
            let parameter: Parameter = by.to_string().parse().unwrap();
            assert_eq!(parameter.value(&problem), chain.value(by).map(|number| number.to_f64()), "{by}");
            let Ok(found) =
                history.derivatives_at(parameter, &quantities, std::slice::from_ref(&time), &[], Side::Right)
            else {
                continue;
            };
            for (quantity, found) in quantities.iter().zip(&found[0]) {
                let Some(found) = found.as_ref().and_then(|found| found.value()) else { continue };
                let Some([coarse, fine]) = quotient(&chain, by, *quantity, &time) else { continue };
                let size = 1.0 + fine.abs();
                // A ray may lie between the steps.
                if (coarse - fine).abs() > 1e-9 * size {
                    continue;
                }
                assert!((found.to_f64() - fine).abs() < 1e-9 * size, "{quantity} by {by}: {found}, {fine}; {chain:?}");
                counts[0] += 1;
                counts[1] += usize::from(fine != 0.0 && !by.to_string().starts_with("body.1"));
            }
        }
    }
    assert!(counts.iter().all(|[compared, of_others]| *compared > 60 && *of_others > 10), "{counts:?}");
}

#[test]
fn values_of_other_bodies_have_derivatives_in_closed_form() {
    // A striker of impedance 0.7 and velocity 0.1 meets a bar of impedance 1 across the gap d: until a wave returns,
    // the force is 0.1/(1/0.7 + 1), and the end of the striker moves with 0.1·0.7/1.7 from t = d/0.1 on.
    let chain = builtin("openfoam-7-1-2");
    let history = chain.problem(0).unwrap().doubles().unwrap();
    let derivative = |by: &str, quantity: &str| {
        let (by, quantity) = (by.parse().unwrap(), [quantity.parse().unwrap()]);
        let found = history.derivatives_at(by, &quantity, &[number("0.2")], &[], Side::Right).unwrap();
        found[0][0].as_ref().unwrap().value().unwrap().to_f64()
    };
    let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-15, "{found} {expected}");
    near(derivative("joint.1.gap", "u_top"), 1.0 - 0.7 / 1.7);
    near(derivative("body.1.velocity", "force_top"), 0.7 / 1.7);
    // Z₂ = √(Eρ), so that ∂f/∂E = v Z₁²/(Z₁ + Z₂)² Z₂/2E.
    near(derivative("body.2.modulus", "force_top"), 0.1 * (0.7f64 / 1.7).powi(2) / 200.0);
    near(derivative("body.2.length", "force_top"), 0.0);
    // In doubles they come from fractions, so that none of the errors is an estimate.
    assert!(history.warnings().is_empty(), "{:?}", history.warnings());
    // The contact begins at d/v and lasts 2L/c of the striker: ∂(2L/c)/∂E = −L/cE with c = 70 and E = 49.
    let history = chain.problem(1).unwrap().exact().unwrap();
    let times = |by: &str| {
        let found = history.derivatives(by.parse().unwrap(), &[Quantity::EventTime]).unwrap();
        found.into_iter().map(|row| row[0].as_ref().unwrap().value().unwrap().to_string()).collect::<Vec<_>>()
    };
    assert_eq!(times("joint.1.gap"), ["10", "10"]);
    assert_eq!(times("body.1.velocity"), ["-1", "-1"]);
    assert_eq!(times("body.1.length"), ["0", "1/35"]);
    assert_eq!(times("body.1.modulus"), ["0", "-1/343"]);
    assert_eq!(times("body.2.area"), ["0", "0"]);
}

/// Returns the derivatives of a quantity of a body at a time from the left and from the right, in fractions and digits.
fn sides(chain: &Chain, body: usize, by: &str, quantity: &str, time: &str) -> [[String; 2]; 2] {
    [Numbers::Exact, Numbers::Digits(12)].map(|numbers| {
        let history = chain.problem(body).unwrap().solve_in(numbers).unwrap();
        let (by, quantity) = (by.parse().unwrap(), [quantity.parse().unwrap()]);
        let found = history.derivatives_at(by, &quantity, &[number(time)], &[], Side::Right).unwrap();
        found[0][0]
            .as_ref()
            .unwrap()
            .sides()
            .map(|side| format!("{:.9}", side.unwrap().to_f64() + 0.0).replace("-0.000000000", "0.000000000"))
    })
}

#[test]
fn a_velocity_that_is_not_given_is_zero_and_has_derivatives() {
    // Two bars in contact from t = 1/2 on have the velocity (Z₁v₁ + Z₂v₂)/(Z₁ + Z₂).
    let bar = |impedance: i64| dalembert::chain::Body::new(1.into(), 1.into(), impedance.into());
    let chain = Chain::builder(bar(1).with_velocity(1.into())).contact(number("1/2"), bar(3)).until(2.into());
    let found = sides(&chain.build().unwrap(), 1, "body.2.velocity", "v_end", "1");
    assert!(found.iter().flatten().all(|side| side == "0.750000000"), "{found:?}");
}

#[test]
fn the_right_side_of_a_negative_value_is_the_greater_one() {
    // Both bars fall at 1 and touch; the lower one lands at 1/2. A lower bar that falls slower is struck by the upper
    // one before that, and both have the mean velocity.
    let bar = || dalembert::chain::Body::new(1.into(), 1.into(), 1.into()).with_velocity((-1).into());
    let ground = dalembert::chain::End::Ground { gap: number("1/2"), velocity: Vec::new() };
    let chain = Chain::builder(bar()).contact(0.into(), bar()).bottom(ground).until(5.into()).build().unwrap();
    let found = sides(&chain, 1, "body.1.velocity", "v_end", "1/2");
    assert!(found.iter().all(|[left, right]| left == "0.000000000" && right == "0.500000000"), "{found:?}");
}

#[test]
fn moduli_of_bars_whose_sides_are_held_are_those_of_the_scene() {
    let scene = |modulus: &str| {
        let own = format!("length = 1\nmodulus = {modulus}\npoisson = \"1/4\"\nstate = \"uniaxial strain\"");
        let text = format!(
            "[[body]]\n{own}\ndensity = \"6/5\"\nvelocity = 1\n[[body]]\nlength = 1\nmodulus = 4\ndensity = 1\n\
             velocity = -1\ngap = \"1/2\"\n[run]\ntime = 3\n"
        );
        dalembert::ChainScene::parse(&text).unwrap().chain
    };
    let chain = scene("1");
    let parameter: ChainParameter = "body.1.modulus".parse().unwrap();
    assert_eq!(chain.value(parameter), Some(1.into()));
    assert_eq!(chain.with_value(parameter, 2.into()).unwrap(), scene("2"));
    let rod = chain.problem(0).unwrap();
    let doubled = rod.to_builder().set(Parameter::Modulus, 2).build().unwrap();
    assert_eq!(doubled.chain().unwrap().0, scene("2"));
    assert_eq!(Parameter::Modulus.value(&rod), Some(1.0));
    // Z₁ = √(Mρ) with M = 6E/5, and the force is Z₁Z₂ Δv/(Z₁ + Z₂): ∂f/∂E = Z₂² Δv/(Z₁ + Z₂)² Z₁/2E.
    for by in ["body.1.modulus", "modulus"] {
        let found = sides(&chain, 0, by, "force_top", "1");
        assert!(found.iter().flatten().all(|side| side == "0.468750000"), "{by}: {found:?}");
    }
}

#[test]
fn a_listing_in_doubles_reaches_the_end_where_no_other_numbers_do() {
    // Fractions end at the first event, and enclosures do not decide an event and a ray that coincide later.
    let bar = |length: &str, impedance: i64| dalembert::chain::Body::new(number(length), 1.into(), impedance.into());
    let ground = dalembert::chain::End::Ground { gap: number("1/4"), velocity: Vec::new() };
    let chain = Chain::builder(bar("1", 1).with_velocity((-2).into())).contact(0.into(), bar("1/2", 4)).bottom(ground);
    let history = chain.gravity(1.into()).until(8.into()).build().unwrap().solve(Numbers::default()).unwrap();
    let listing = history.listing().unwrap();
    assert_eq!((listing.events.len(), listing.end.to_f64()), (14, 8.0));
    assert_eq!(history.ending().unwrap(), dalembert::Ending::Time);
    assert!(matches!(history.warnings()[..], [Warning::Coincidence { .. }]), "{:?}", history.warnings());
}

#[test]
fn numbers_of_chains_have_limits() {
    let bar = || dalembert::chain::Body::new(1.into(), 1.into(), 1.into());
    let end = dalembert::chain::End::Force(vec![(0.into(), number("1e41"))]);
    let of = |chain: dalembert::chain::ChainBuilder| chain.until(1.into()).build().unwrap_err();
    for (error, path) in [
        (of(Chain::builder(bar().with_velocity(number("1e300")))), "body[0].velocity[0]"),
        (of(Chain::builder(bar().with_velocity(number("-1e-41")))), "body[0].velocity[0]"),
        (of(Chain::builder(bar()).contact(number("1e41"), bar())), "body[1].gap"),
        (of(Chain::builder(bar()).top(end)), "ends.top[0]"),
    ] {
        assert_eq!(error.path, path);
        assert_eq!(error.expected, "zero, or a number between 1e-40 and 1e40 in size");
    }
}

#[test]
fn values_that_a_chain_does_not_have_are_refused_by_name() {
    let chain = builtin("openfoam-7-1-2");
    let rod = chain.problem(0).unwrap();
    let refused = |text: &str| rod.to_builder().set(text.parse::<Parameter>().unwrap(), 1).build().unwrap_err();
    for text in ["body.3.length", "body.2.mass", "joint.1.stiffness", "joint.2.gap", "bottom.gap"] {
        let error = refused(text).to_string();
        assert!(error.contains(text) && error.contains("joint.1.gap"), "{error}");
    }
    let negative = rod.to_builder().set("body.2.length".parse::<Parameter>().unwrap(), -1).build().unwrap_err();
    assert_eq!(negative.to_string(), "found length = -1, expected a number above zero");
    let alone = Problem::builder().length(1).wave_speed(1).impact_speed(1);
    let alone = alone.set("body.2.length".parse::<Parameter>().unwrap(), 1);
    assert!(alone.build().unwrap_err().to_string().contains("rod by itself"));
}

/// A bar that flies has the highest point where its centre, from the waves in it, has no velocity. A bar under a load
/// does not fall freely.
#[test]
fn a_body_that_falls_freely_has_its_highest_point() {
    let bar = || Body::new(1.into(), 1.into(), 1.into());
    let chain = |until: i64| {
        let upper = bar().with_velocity((-1).into());
        let chain = Chain::builder(bar()).contact(number("1/2"), upper).bottom(End::Velocity(Vec::new()));
        chain.gravity(number("3/10")).until(until.into()).build().unwrap()
    };
    let upper = chain(12).problem(1).unwrap();
    let flight = upper.doubles().unwrap().flights().unwrap().remove(0);
    let [time, top] = [flight.top_time.unwrap(), flight.top.unwrap()];
    assert!((time - 77.0 / 9.0).abs() < 1e-12 && (top - 127.0 / 144.0).abs() < 1e-12, "{time} {top}");
    let at = |quantity: Quantity, time: &str| exact(&upper, quantity, &number(time), Side::Right).to_string();
    assert_eq!(at(Quantity::CentreVelocity, "77/9"), "0");
    assert_eq!(at(Quantity::Centre, "77/9"), "127/144");
    // The flight begins at 16/3, and the bar turns after 7.
    for (until, reason) in [(7, Some(Undefined::NotYet)), (12, None)] {
        let history = chain(until).problem(1).unwrap().solve_in(Numbers::Exact).unwrap();
        let flights = history.listing(None, true).unwrap().flights;
        assert_eq!(flights[0][2].clone().err(), reason, "until {until}");
    }
    // A load on its top acts on the bar as long as it flies.
    let upper = bar().with_velocity((-1).into());
    let loaded = Chain::builder(bar()).contact(number("1/2"), upper).bottom(End::Velocity(Vec::new()));
    let loaded = loaded.top(End::Force(vec![(0.into(), number("1/10"))])).gravity(number("3/10"));
    let flights = loaded.until(12.into()).build().unwrap().problem(1).unwrap().doubles().unwrap().flights().unwrap();
    assert!(!flights.is_empty() && flights.iter().all(|flight| flight.top_time.is_none()));
}
