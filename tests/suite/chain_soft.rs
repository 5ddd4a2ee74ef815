//! Chains with springs, dashpots and rigid masses against an independent program, closed forms and limits.

use std::ops::ControlFlow;
use std::sync::Arc;

use dalembert::chain::{Body, Chain, ChainColumn, ChainListing, ChainQuantity, ChainRun, End, Points, Spring};
use dalembert::number::{Bounded, IntervalPrecision, Number, Scalar, Value, Wide};
use dalembert::reason::Warning;
use dalembert::{ChainScene, Ending, Error, Estimate, Interval, Numbers, Parameter, Problem, Quantity, Side};
use serde_json::Value as Json;

fn number(text: &str) -> Number {
    text.parse().unwrap()
}

fn read(value: &Json) -> Number {
    match value {
        Json::Null => 0.into(),
        Json::String(text) => number(text),
        value => number(&value.to_string()),
    }
}

fn points(value: &Json) -> Points {
    value.as_array().into_iter().flatten().map(|pair| (read(&pair[0]), read(&pair[1]))).collect()
}

fn body(scene: &Json) -> Body {
    let body = match (&scene["mass"], &scene["modulus"]) {
        (Json::String(mass), _) => return Body::rigid(number(mass)).with_velocity(read(&scene["velocity"])),
        (_, Json::String(_)) => {
            let [length, modulus, density, area] =
                ["length", "modulus", "density", "area"].map(|key| read(&scene[key]));
            Body::elastic(length, modulus, density, area)
        }
        _ => Body::new(read(&scene["length"]), read(&scene["wave_speed"]), read(&scene["impedance"])),
    };
    body.with_velocity(read(&scene["velocity"])).with_displacement(points(&scene["displacement"]))
}

/// Returns the chain of a case.
fn chain(scene: &Json) -> Chain {
    let end = |node: &Json| match node["kind"].as_str().unwrap() {
        "free" if node["force"].is_array() => End::Force(points(&node["force"])),
        "free" => End::Free,
        "fixed" | "spring" => End::Velocity(Vec::new()),
        "ground" => End::Ground { gap: read(&node["gap"]), velocity: points(&node["velocity"]) },
        kind => panic!("{kind}"),
    };
    let (bodies, nodes) = (scene["bodies"].as_array().unwrap(), scene["interfaces"].as_array().unwrap());
    let mut builder = Chain::builder(body(&bodies[0])).gravity(read(&scene["gravity"])).until(read(&scene["until"]));
    for (above, node) in bodies.iter().zip(nodes).skip(1) {
        builder = match node["kind"].as_str() {
            Some("contact") => builder.contact(read(&node["gap"]), body(above)),
            Some("bonded" | "spring") => builder.bonded(body(above)),
            kind => panic!("{kind:?}"),
        };
    }
    for (k, node) in nodes.iter().enumerate() {
        if node["stiffness"].is_string() || node["dashpot"].is_string() {
            builder =
                builder.spring(k, Spring { stiffness: read(&node["stiffness"]), damping: read(&node["dashpot"]) });
        }
    }
    builder.bottom(end(&nodes[0])).top(end(&nodes[nodes.len() - 1])).build().unwrap()
}

fn cases() -> Vec<Json> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/reference/soft_chains.json");
    let file: Json = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    file["cases"].as_array().unwrap().clone()
}

/// A comparison with the numbers of a case: each is within its bound and a half of the last of 30 digits.
struct Compared {
    name: String,
    count: usize,
    /// The greatest bound, relative to the number or to one, of what is no time of a peak.
    widest: f64,
}

impl Compared {
    fn check<N: Bounded>(&mut self, place: impl Fn() -> String, found: &N, expected: &Json) {
        let Json::String(text) = expected else { return };
        let exact = found.alike_text(text);
        let size = exact.to_f64().abs();
        let apart = found.clone() - &exact;
        let rounding = apart.double(size * 5.1e-30 + 1e-32);
        let differs = [apart.clone() - &rounding, -apart - &rounding].map(|excess| excess.positive() == Ok(true));
        let bound = found.log2_error().exp2();
        assert!(!differs.contains(&true), "{}: {}: {} ± {bound:e} is not {text}", self.name, place(), found.text(),);
        self.count += 1;
        if !place().contains("peak time") {
            self.widest = self.widest.max(bound / size.max(1.0));
        }
    }
}

/// A number in the system of another one.
trait ReadsText: Bounded {
    fn alike_text(&self, text: &str) -> Self {
        Self::from_number(&number(text), &self.precision())
    }
}
impl<N: Bounded> ReadsText for N {}

/// Compares events, contacts, forces, gaps, energies, ends and sums of all cases; returns the number of comparisons and
/// the widest bound.
fn compare<N: Bounded>(precision: &N::Precision, only: impl Fn(&str) -> bool) -> (usize, f64) {
    let mut compared = Compared { name: String::new(), count: 0, widest: 0.0 };
    for case in cases().iter().filter(|case| only(case["name"].as_str().unwrap())) {
        compared.name = case["name"].as_str().unwrap().to_string();
        let run = ChainRun::<N>::new(&chain(&case["scene"]), precision, &|_, _| ControlFlow::Continue(())).unwrap();
        assert_eq!(*run.ending(), Ending::Time, "{}", compared.name);
        let events: Vec<&Json> =
            case["events"].as_array().unwrap().iter().filter(|event| event["kind"] != "return").collect();
        assert_eq!(run.events().len(), events.len(), "{}", compared.name);
        for (event, expected) in run.events().iter().zip(events) {
            let at = || format!("event at {}", expected["t"]);
            assert_eq!(event.node as u64, expected["node"].as_u64().unwrap(), "{}: {}", compared.name, at());
            assert_eq!(event.kind.name(), expected["kind"].as_str().unwrap(), "{}: {}", compared.name, at());
            compared.check(at, &event.t, &expected["t"]);
            compared.check(at, &event.before, &expected["before"]);
            compared.check(at, &event.after, &expected["after"]);
        }
        let contacts = case["contacts"].as_array().unwrap();
        assert_eq!(run.contacts().len(), contacts.len());
        for (contact, expected) in run.contacts().iter().zip(contacts) {
            let at = |name: &str| format!("{name} of the contact at {}", expected["start"]);
            compared.check(|| at("impact"), &contact.impact, &expected["start"]);
            assert_eq!(contact.release.is_some(), expected["end"].is_string());
            contact.release.iter().for_each(|release| compared.check(|| at("release"), release, &expected["end"]));
            compared.check(|| at("impulse"), &contact.impulse, &expected["impulse"]);
            compared.check(|| at("peak"), &contact.peak, &expected["peak"]);
            compared.check(|| at("peak time"), &contact.peak_time, &expected["peak_time"]);
        }
        for sample in case["samples"].as_array().unwrap() {
            let time = N::spelling(&read(&sample["t"]), precision);
            let at = |name: &str, place: usize| format!("{name} {place} at {}", sample["t"]);
            for (k, node) in sample["nodes"].as_array().unwrap().iter().enumerate() {
                compared.check(|| at("force", k), &run.force(k, &time, Side::Right).unwrap(), &node["force"]);
                compared.check(|| at("gap", k), &run.gap(k, &time).unwrap(), &node["gap"]);
                let [stored, dissipated] = run.spring_energies(k, &time, Side::Right).unwrap();
                compared.check(|| at("spring energy", k), &stored, &node["stored"]);
                compared.check(|| at("dissipated", k), &dissipated, &node["dissipated"]);
                for (side, body, is_top) in [("below", k.wrapping_sub(1), true), ("above", k, false)] {
                    if node[side].is_object() {
                        let field = run.end_field(body, is_top, &time, Side::Right).unwrap();
                        compared.check(|| at("v", k), &field.displacement, &node[side]["v"]);
                        compared.check(|| at("v_t", k), &field.velocity, &node[side]["v_t"]);
                    }
                }
            }
            for (k, body) in sample["bodies"].as_array().unwrap().iter().enumerate() {
                let sums = run.sums(k, &time).unwrap();
                compared.check(|| at("mean displacement", k), &sums.displacement, &body["mean_displacement"]);
                compared.check(|| at("mean velocity", k), &sums.velocity, &body["mean_velocity"]);
                compared.check(|| at("kinetic", k), &sums.kinetic, &body["kinetic"]);
                compared.check(|| at("strain", k), &sums.strain, &body["strain"]);
                let scene = &case["scene"]["bodies"][k];
                if let (Json::String(length), third) = (&scene["length"], &body["third"]) {
                    let point = time.alike_text(length) / time.int(3);
                    let field = run.field(k, &point, &time, Side::Right).unwrap();
                    compared.check(|| at("v at a third", k), &field.displacement, &third["v"]);
                    compared.check(|| at("v_t at a third", k), &field.velocity, &third["v_t"]);
                    let force = run.axial_force(k, &point, &time, Side::Right).unwrap();
                    compared.check(|| at("N at a third", k), &force, &third["N"]);
                }
            }
        }
    }
    (compared.count, compared.widest)
}

#[test]
fn an_independent_program_has_the_same_numbers_in_doubles() {
    let (count, widest) = compare::<Estimate<f64>>(&(), |_| true);
    assert!(count > 4_500 && widest < 1e-5, "{count} numbers within {widest:e}");
}

#[test]
fn an_independent_program_has_the_same_thirty_digits() {
    // Peaks of a plateau and the gap rates of a stiff contact lose most: 1e-25 in one of them.
    let (count, widest) = compare::<Estimate<Wide<2>>>(&(), |_| true);
    assert!(count > 4_500 && widest < 1e-24, "{count} numbers within {widest:e}");
}

#[test]
fn enclosures_contain_the_numbers_of_an_independent_program() {
    let one_of_each = ["spring_ground_k1", "spring_dashpot_d3_k10", "striker_on_rod_on_ground", "random_4018"];
    let precision = IntervalPrecision::with_exact(192);
    let (count, widest) = compare::<Interval>(&precision, |name| one_of_each.contains(&name));
    assert!(count > 550 && widest < 1e-40, "{count} numbers within {widest:e}");
}

fn free_rod(stiffness: &str, damping: &str, until: &str) -> Chain {
    let rod = Body::new(1.into(), 1.into(), 1.into()).with_velocity((-1).into());
    let ground = End::Ground { gap: 0.into(), velocity: Vec::new() };
    let spring = Spring { stiffness: number(stiffness), damping: number(damping) };
    Chain::builder(rod).bottom(ground).spring(0, spring).until(number(until)).build().unwrap()
}

pub(crate) fn striker(mass: &str, until: &str) -> Chain {
    let mass = Body::rigid(number(mass)).with_velocity((-1).into());
    let rod = Body::new(1.into(), 1.into(), 1.into());
    let chain = Chain::builder(rod).contact(0.into(), mass).bottom(End::Velocity(Vec::new()));
    chain.until(number(until)).build().unwrap()
}

fn listing(chain: &Chain, numbers: Numbers) -> Arc<ChainListing> {
    chain.solve(numbers).unwrap().listing().unwrap()
}

/// A mass `m` at speed 1 on top of a rod with `Z = 1` pushes with `e^(−t/m)`, and the rod is at rest below the wave.
#[test]
fn a_rod_that_is_struck_at_its_top_alone_has_its_sums() {
    let chain = striker("6", "0.9");
    let run = ChainRun::<Estimate<f64>>::new(&chain, &(), &|_, _| ControlFlow::Continue(())).unwrap();
    for t in [0.25, 0.5, 0.875] {
        let time = Estimate::<f64>::spelling(&number(&t.to_string()), &());
        let sums = run.sums(0, &time).unwrap();
        let energy = 1.5 * (1.0 - f64::exp(-t / 3.0));
        let expected = [
            (&sums.velocity, -6.0 * (1.0 - f64::exp(-t / 6.0))),
            (&sums.displacement, -6.0 * (t - 6.0 * (1.0 - f64::exp(-t / 6.0)))),
            (&sums.kinetic, energy),
            (&sums.strain, energy),
        ];
        for (found, expected) in expected {
            assert!((found.value() - expected).abs() <= 1e-13, "{found:?} against {expected}");
        }
        assert!(run.stretches(0, &time).is_err());
    }
}

fn near(found: &Value, expected: f64, relative: f64) {
    let found = found.to_f64();
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} against {expected}");
}

/// Returns the positive root of `eˣ = a + 2x` by Newton's method.
fn extension(a: f64) -> f64 {
    let mut x = 1.7f64;
    for _ in 0..60 {
        x -= (x.exp() - a - 2.0 * x) / (x.exp() - 2.0);
    }
    x
}

/// **Source**: the contact of a free rod on a spring ground ends at `2L/c + x/ω` with `eˣ = 2 − e^(−2ωL/c) + 2x`, and
/// its greatest depth is `(μ/ω)(2e^(−E/2) − 1)`.
#[test]
fn a_free_rod_leaves_a_spring_ground_when_its_closed_form_says() {
    for k in ["2", "5", "20", "1000", "100000", "10000000", "1000000000"] {
        let omega: f64 = k.parse().unwrap();
        let chain = free_rod(k, "0", "4");
        let listing = listing(&chain, Numbers::default());
        let end = (-2.0 * omega).exp();
        let x = extension(2.0 - end);
        let release = listing.contacts[0].release.clone().unwrap();
        // The stored time has 53 bits, and what is beyond 2 is held against the closed form with those that it has.
        assert!((release.to_f64() - 2.0 - x / omega).abs() < 1e-14 + 1e-12 * x / omega, "{release} for k = {k}");
        near(&listing.contacts[0].peak, 2.0 * (-end / 2.0).exp() - 1.0, 1e-12);
    }
    // From an equation solver with 60 digits.
    let digits = listing(&free_rod("20", "0", "4"), Numbers::Digits(28)).contacts[0].release.clone().unwrap();
    assert_eq!(digits.to_string(), "2.083917349500833032607362403");
}

/// **Source**: the force of a free rod of speed 1 on a spring, `1 − e^(−kt)` until the wave is back at `t = 2`.
#[test]
fn stress_pieces_are_the_series_of_the_force() {
    for k in ["2", "20", "200"] {
        let stiffness: f64 = k.parse().unwrap();
        let rod = free_rod(k, "0", "4").problem(0).unwrap();
        let history = rod.doubles().unwrap();
        let pieces = history.ask(|motion| Ok(motion.stress_pieces()), |_| Vec::new()).unwrap();
        assert!(pieces.windows(2).all(|pair| pair[0].end.value() == pair[1].start.value()), "k = {k}");
        assert_eq!((*pieces[0].start.value(), *pieces[pieces.len() - 1].end.value()), (0.0, 4.0));
        let mut impulse = 0.0;
        for piece in &pieces {
            let [from, to] = [&piece.start, &piece.end].map(|time| *time.value());
            let late = stiffness * (piece.start.bound() + piece.end.bound());
            for share in [0.0, 0.1, 0.5, 0.8, 1.0] {
                let t = from + (to - from) * share;
                let found = piece.eval(&Estimate::exact(t));
                if t <= 2.0 {
                    let off = (found.value() + 1.0 - (-stiffness * t).exp()).abs();
                    assert!(off <= found.bound() + late + 1e-15, "{found:?} at {t} for k = {k}");
                }
                let field = if share == 0.5 { history.strain(t, Side::Right).unwrap() } else { *found.value() };
                assert!((found.value() - field).abs() <= found.bound() + late + 1e-14 && found.bound() < 1e-9);
            }
            impulse -= piece.integral(&piece.end).value();
        }
        assert!((impulse - history.contacts()[0].impulse).abs() < 1e-10, "{impulse} for k = {k}");
    }
}

/// A held rod that stretches at rest onto a spring of stiffness 200.
fn stretching_rod(modulus: &str, gravity: &str) -> Chain {
    let rod = Body::elastic(1.into(), number(modulus), 1.into(), 1.into())
        .with_displacement(vec![(0.into(), number("0.5")), (1.into(), 0.into())]);
    let ground = End::Ground { gap: number("0.5"), velocity: Vec::new() };
    let spring = Spring { stiffness: 200.into(), damping: 0.into() };
    let chain = Chain::builder(rod).bottom(ground).top(End::Velocity(Vec::new())).spring(0, spring);
    chain.gravity(number(gravity)).until(3.into()).build().unwrap()
}

/// The force on the spring rises as `(Z/2)(1 − e^(−ks/Z))`, all along, and its slope is far below the errors of doubles
/// at the end. **Source**: at `s = 2` the exponential is below 1e-173.
#[test]
fn a_peak_that_a_force_approaches_is_sharp_in_doubles() {
    for modulus in ["1.00020001", "1.0404", "1.21"] {
        let chain = stretching_rod(modulus, "0");
        let run = ChainRun::<Estimate<f64>>::new(&chain, &(), &|_, _| ControlFlow::Continue(())).unwrap();
        let peak = run.contacts().swap_remove(0).peak;
        let truth = modulus.parse::<f64>().unwrap() / 2.0;
        assert!((peak.value() - truth).abs() <= peak.bound() && peak.bound() < 1e-11, "{peak:?} for {modulus}");
    }
}

/// Gravity bends such a force downward, by so little that doubles do not know the slope: the time of the peak is known
/// within a bound that covers it.
#[test]
fn a_peak_that_doubles_do_not_find_is_not_dated() {
    for modulus in ["1", "1.0404"] {
        for eighth in (61..130).step_by(2) {
            let gravity = format!("{:e}", 10f64.powf(f64::from(-eighth) / 8.0));
            let chain = stretching_rod(modulus, &gravity);
            let run = ChainRun::<Estimate<f64>>::new(&chain, &(), &|_, _| ControlFlow::Continue(())).unwrap();
            let long = ChainRun::<Estimate<Wide<4>>>::new(&chain, &(), &|_, _| ControlFlow::Continue(())).unwrap();
            let found = run.contacts().swap_remove(0).peak_time;
            let truth = long.contacts().swap_remove(0).peak_time;
            let off = (found.value() - truth.to_f64()).abs();
            assert!(off <= found.bound() + 1e-15, "off by {off:e}, bound {:e}, g = {gravity}", found.bound());
            assert!(truth.log2_error() < -30.0, "{truth:?}");
        }
    }
}

/// **Source**: the closed form above, `T(ω) = 2 + x/ω`; with `(eˣ − 2) x′ = 2e^(−2ω)` it is `T′ = x′/ω − x/ω²`. The
/// peak is `2e^(−E/2) − 1` with `E = e^(−2ω)`, and its slope `2E e^(−E/2)`.
#[test]
fn derivatives_by_the_stiffness_are_those_of_the_closed_form() {
    for k in ["2", "20", "1000000"] {
        let rod = free_rod(k, "0", "4").problem(0).unwrap();
        assert_eq!(Parameter::Stiffness.given(&rod), Some(number(k)));
        let omega: f64 = k.parse().unwrap();
        let end = (-2.0 * omega).exp();
        let x = extension(2.0 - end);
        let slope = 2.0 * end / (x.exp() - 2.0) / omega - x / omega / omega;
        let found = rod.doubles().unwrap().derivatives(Parameter::Stiffness, &[Quantity::Release, Quantity::PeakForce]);
        for (cell, expected) in found.unwrap()[0].iter().zip([slope, 2.0 * end * (-end / 2.0).exp()]) {
            let found = cell.as_ref().unwrap().value().unwrap();
            let off = (found.value() - expected).abs();
            assert!(off <= found.bound() + 1e-12 * expected.abs(), "{found:?} against {expected:e}");
            assert!(found.bound() < 1e-6 / omega, "{found:?} for k = {k}");
        }
        // Another value gives the history of another chain.
        let softer = Parameter::Stiffness.set(&rod, omega / 2.0).unwrap();
        let release = |rod: &Problem| rod.doubles().unwrap().contacts()[0].release.unwrap();
        let x = extension(2.0 - (-omega).exp());
        assert!((release(&softer) - 2.0 - 2.0 * x / omega).abs() < 1e-12, "{softer:?}");
        assert!(softer != rod && Parameter::Stiffness.set(&softer, omega).unwrap() == rod);
    }
    let rigid = Problem::builder().length(1).wave_speed(1).impact_speed(1);
    assert_eq!(Parameter::Stiffness.value(&rigid.clone().build().unwrap()), None);
    let error = rigid.stiffness(20).build().unwrap_err().to_string();
    assert!(error.contains("found a stiffness of rigid ground, expected a rod on a spring"), "{error}");
}

/// **Source**: `π√(M/k)(1 + kL/6EA)` for k → 0; the vibration of the rod shifts the release by less than the power 3/2.
#[test]
fn a_soft_ground_has_the_limit_of_a_rigid_rod() {
    for k in ["0.01", "0.001", "0.0001"] {
        let size: f64 = k.parse().unwrap();
        let rigid = std::f64::consts::PI / size.sqrt();
        let listing = listing(&free_rod(k, "0", &format!("{}", 1.2 * rigid)), Numbers::default());
        let release = listing.contacts[0].release.clone().unwrap().to_f64();
        let rest = (release / rigid - 1.0 - size / 6.0) / size.powf(1.5);
        assert!(rest.abs() < 0.05, "{rest} for k = {k}");
    }
}

/// **Source**: a matched dashpot, `d = Z`, absorbs; the force of any dashpot begins with `Zdμ/(Z + d)`.
#[test]
fn a_dashpot_ground_begins_with_its_force() {
    for (d, force) in [("1", 0.5), ("0.25", 0.2), ("3", 0.75)] {
        let chain = free_rod("0", d, "1.5");
        let history = chain.solve(Numbers::default()).unwrap();
        let column = ChainColumn { quantity: ChainQuantity::Force, place: 0 };
        near(&history.value(column, &number("0.7"), Side::Right).unwrap(), force, 1e-14);
    }
}

/// **Source**: the delay equation of the classical problem, solved piece by piece with 60 digits; Timoshenko and
/// Goodier print 3.068, 4.708, 5.900, 7.419.
#[test]
fn a_mass_leaves_a_clamped_rod_when_independent_programs_say() {
    let published = [
        ("1/2", "2.50457890972218", 2.0183156),
        ("1", "3.06766764161831", 2.1353353),
        ("2", "4.70856724366773", 2.3678794),
        ("4", "5.89959043960327", 2.9744101),
        ("6", "7.40759189126928", 3.4687922),
    ];
    for (mass, release, peak) in published {
        let listing = listing(&striker(mass, "8"), Numbers::Digits(15));
        let contact = &listing.contacts[0];
        assert_eq!(contact.release.as_ref().unwrap().to_string(), release);
        near(&contact.peak, peak, 3e-8);
    }
    // A light mass leaves at 2L/c + m/Z, with an error of the size of e^(−2/m).
    for mass in ["0.1", "0.02", "0.01"] {
        let size: f64 = mass.parse().unwrap();
        near(
            listing(&striker(mass, "4"), Numbers::default()).contacts[0].release.as_ref().unwrap(),
            2.0 + size,
            1e-8_f64.max(1.1 * (-2.0 / size).exp()),
        );
    }
    // A heavy one swings with the rod as a spring of a third of its mass.
    for mass in ["100", "1000"] {
        let size: f64 = mass.parse().unwrap();
        let expected = std::f64::consts::PI * (size + 1.0 / 3.0).sqrt();
        let listing = listing(&striker(mass, &format!("{}", 1.3 * expected)), Numbers::default());
        near(listing.contacts[0].release.as_ref().unwrap(), expected, 0.02);
        near(&listing.contacts[0].peak, size.sqrt() + 1.0, 0.03);
    }
}

/// Kinetic energy, strain energy, springs and losses keep their sum in random chains.
#[test]
fn energy_is_conserved() {
    for case in cases() {
        let scene = &case["scene"];
        let bodies = scene["bodies"].as_array().unwrap();
        let is_driven = scene["interfaces"]
            .as_array()
            .unwrap()
            .iter()
            .any(|node| node["velocity"].is_array() || node["force"].is_array() || node["kind"] == "infinite");
        if is_driven {
            continue;
        }
        let chain = chain(scene);
        let run = ChainRun::<Estimate<Wide<2>>>::new(&chain, &(), &|_, _| ControlFlow::Continue(())).unwrap();
        let total = |share: &str| {
            let end = run.end().clone();
            let time = end.clone() * end.alike_text(share);
            let mut sum = end.zero();
            for body in 0..bodies.len() {
                let sums = run.sums(body, &time).unwrap();
                sum = sum + sums.kinetic + sums.strain + sums.potential;
            }
            for node in 0..=bodies.len() {
                let [stored, dissipated] = run.spring_energies(node, &time, Side::Right).unwrap();
                sum = sum + stored + dissipated;
            }
            sum
        };
        let first = total("0.0123");
        for share in ["0.21", "0.4567", "0.8123", "0.977"] {
            let off = total(share) - &first;
            assert_ne!(off.positive(), Ok(true), "{} at {share}: {}", case["name"], off.text());
            assert_ne!(off.negative(), Ok(true), "{} at {share}: {}", case["name"], off.text());
            assert!(off.to_f64().abs() < 1e-18 * first.to_f64().abs().max(1.0), "{}: {}", case["name"], off.text());
        }
    }
}

/// Signals that rise from zero: a front behind a spring, and a load on a mass that touches its spring. The exact
/// numbers are within the bounds, and fall through zero at the front.
#[test]
fn a_contact_that_closes_without_speed_is_within_its_bounds() {
    fn run<N: Bounded>(chain: &Chain, precision: &N::Precision) -> ChainRun<N> {
        ChainRun::<N>::new(chain, precision, &|_, _| ControlFlow::Continue(())).unwrap()
    }
    fn holds<N: Bounded>(found: &N, exact: i64) -> bool {
        let off = found.clone() - found.int(exact);
        off.positive() != Ok(true) && off.negative() != Ok(true)
    }
    fn check<N: Bounded>(precision: &N::Precision, most: f64) {
        let bar = || Body::new(1.into(), 1.into(), 1.into());
        let ground = || End::Ground { gap: 0.into(), velocity: Vec::new() };
        let spring = |stiffness: i64| Spring { stiffness: stiffness.into(), damping: 0.into() };
        let chain = Chain::builder(bar()).contact(0.into(), bar().with_velocity((-1).into())).spring(1, spring(20));
        let front = run::<N>(&chain.bottom(ground()).until(3.into()).build().unwrap(), precision);
        let impact = &front.events()[1];
        assert_eq!((impact.node, impact.kind.name()), (0, "impact"));
        assert!(holds(&impact.t, 1) && holds(&impact.before, 0) && holds(&impact.after, 0), "{impact:?}");
        assert!(impact.t.log2_error() < most, "{impact:?}");
        // The force is 1 − cos t: it touches zero at 2π and is there again.
        let load = End::Force(vec![(0.into(), (-1).into())]);
        let chain = Chain::builder(Body::rigid(1.into())).spring(0, spring(1)).bottom(ground()).top(load);
        let swing = run::<N>(&chain.until(8.into()).build().unwrap(), precision);
        assert_eq!(*swing.ending(), Ending::Time);
        assert!(swing.undetermined_from().is_some() && swing.events().len() == 1);
        assert_eq!(swing.events()[0].t.vanishes(), Ok(true));
        let force = swing.force(0, &N::spelling(&7.into(), precision), Side::Right).unwrap();
        assert!((force.to_f64() - (1.0 - f64::cos(7.0))).abs() < 1e-6, "{force:?}");
    }
    check::<Estimate<f64>>(&(), -24.0);
    check::<Estimate<Wide<2>>>(&(), -55.0);
    check::<Interval>(&IntervalPrecision::with_exact(128), -55.0);
}

/// A rod on rigid ground leaves at `2L/c`, whatever hangs far above it.
#[test]
fn an_event_at_the_last_time_is_listed() {
    let rod = Body::new(1.into(), 3.into(), 1.into()).with_velocity((-1).into());
    let mass = Body::rigid(1.into());
    let ground = End::Ground { gap: 0.into(), velocity: Vec::new() };
    let spring = Spring { stiffness: 1.into(), damping: 0.into() };
    let chain = Chain::builder(rod).contact(10.into(), mass).spring(1, spring).bottom(ground);
    let chain = chain.until(number("2/3")).build().unwrap();
    fn events<N: Bounded>(chain: &Chain, precision: &N::Precision) -> usize {
        let run = ChainRun::<N>::new(chain, precision, &|_, _| ControlFlow::Continue(())).unwrap();
        assert_eq!(*run.ending(), Ending::Time);
        assert!(run.undetermined_from().is_none_or(|at| (at - 2.0 / 3.0).abs() < 1e-15));
        run.events().len()
    }
    assert_eq!(events::<Estimate<f64>>(&chain, &()), 2);
    assert_eq!(events::<Estimate<Wide<2>>>(&chain, &()), 2);
    assert_eq!(events::<Interval>(&chain, &IntervalPrecision::with_exact(128)), 2);
    let history = chain.solve(Numbers::default()).unwrap();
    assert_eq!(history.listing().unwrap().events.len(), 2);
}

#[test]
fn fractions_and_bodies_by_themselves_are_refused() {
    let chain = striker("1", "4");
    assert_eq!(chain.solve(Numbers::Exact).unwrap_err(), Error::SoftExact);
    let [bar, mass] = [0, 1].map(|body| chain.problem(body));
    assert_eq!(bar.unwrap().chain().unwrap().1, 0);
    assert!(mass.unwrap_err().to_string().contains("found a rigid mass, expected a bar"));
    // A rigid mass on rigid ground has no force of finite size.
    let mass = || Body::rigid(1.into()).with_velocity((-1).into());
    let ground = || End::Ground { gap: 1.into(), velocity: Vec::new() };
    let error = Chain::builder(mass()).bottom(ground()).until(4.into()).build().unwrap_err();
    assert!(error.to_string().contains("a rigid bottom beside a rigid mass"), "{error}");
    // On a spring it swings: contact for π√(m/k).
    let spring = Spring { stiffness: 4.into(), damping: 0.into() };
    let chain = Chain::builder(mass()).bottom(ground()).spring(0, spring).until(4.into()).build().unwrap();
    let release = listing(&chain, Numbers::default()).contacts[0].release.clone().unwrap();
    near(&release, 1.0 + std::f64::consts::FRAC_PI_2, 1e-14);
}

/// The start has a front that rises from zero at 1/3 and closes a contact, which no attempt decides: doubles with the
/// events of the longest attempt answer within their bounds.
#[test]
fn doubles_answer_where_all_attempts_have_the_same_doubt() {
    let scene = "body = [\n{ length = 1, wave_speed = 1, impedance = 1 },\n\
                 { length = 1, wave_speed = 1, impedance = 1, velocity = [[0, 0], ['1/3', 0], [1, -1]], \
                 joint = { stiffness = 20 } },\n]\nends.bottom = 'fixed'\nrun.time = 3";
    let chain = ChainScene::parse(scene).unwrap().chain;
    let history = chain.solve(Numbers::Double(Some(1e-6))).unwrap();
    let truth = chain.solve(Numbers::Digits(30)).unwrap();
    assert!(matches!(history.warnings()[..], [Warning::Coincidence { .. }]), "no doubt");
    let mut in_doubles = 0;
    for name in ["force.1", "v_top.2", "u_end.1", "v_top.1"] {
        let column = ChainColumn::read(name, &chain).unwrap();
        for tenths in 11..30 {
            let time = format!("{}.{}", tenths / 10, tenths % 10).parse().unwrap();
            let [ours, truth] = [&history, &truth].map(|history| history.value(column, &time, Side::Right).unwrap());
            let off = (ours.to_f64() - truth.to_f64()).abs();
            let bound = ours.bound().to_f64();
            assert!(off <= bound + f64::EPSILON * truth.to_f64().abs(), "{name} {time}: {ours:?} {truth:?}");
            in_doubles += usize::from(bound > 8.0 * f64::EPSILON * ours.to_f64().abs());
        }
    }
    assert!(in_doubles > 30, "{in_doubles} of 76 in doubles");
}
