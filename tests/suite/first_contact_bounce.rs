//! The bounce time: the reference, thresholds, and where doubles lose their digits.

use crate::common::{bounce_time, first_contact};
use dalembert::engine::{Bounce, BounceKind, FirstContact};
use dalembert::reason::NoBounceReason;
use dalembert::special::RoundedSpecial;
use dalembert::{Ending, Estimate, Number, Parameters, Reason, Side};
use serde_json::Value;

type Contact<S> = FirstContact<Estimate<S>>;

fn parameters(damping: f64, gravity: f64, length: f64, speed: f64) -> Parameters<f64> {
    Parameters { length, wave_speed: 1.0, damping, gravity, speed }
}

fn rod(damping: f64, gravity: f64, length: f64, speed: f64) -> Contact<f64> {
    FirstContact::new(&parameters(damping, gravity, length, speed).carry())
}

/// `t_b` in doubles, its bound and its kind.
fn at(bounce: Bounce<Estimate<f64>>) -> (f64, f64, BounceKind) {
    let Bounce::At { time, kind, .. } = bounce else { panic!("{bounce:?}") };
    (*time.value(), time.bound(), kind)
}

fn reference<S: RoundedSpecial>(
    precision: &S::Precision,
    accuracy: f64,
    bounce: impl Fn(&Contact<S>) -> Bounce<Estimate<S>>,
) {
    let cases: Vec<Value> = serde_json::from_str(include_str!("../reference/first_contact.json")).unwrap();
    for case in cases {
        let name = case["name"].as_str().unwrap();
        let read = |value: &Value| S::from_number(&value.as_str().unwrap().parse::<Number>().unwrap(), precision);
        let contact = FirstContact::new(
            &Parameters {
                length: read(&case["length"]),
                wave_speed: read(&case["wave_speed"]),
                damping: read(&case["damping"]),
                gravity: read(&case["gravity"]),
                speed: read(&case["impact_speed"]),
            }
            .carry(),
        );
        match (bounce(&contact), &case["bounce_time"]) {
            (Bounce::Never(reason), Value::Null) => {
                assert!(matches!(reason, NoBounceReason::SettlesUnderWeight { .. }), "{reason}");
                assert!(reason.to_string().contains("static"), "{reason}");
            }
            (Bounce::At { time, kind, .. }, truth) => {
                let truth: S = read(truth);
                let (error, time) = (time.bound(), time.into_value());
                let wrong = (time.clone() - &truth).to_f64().abs();
                assert!(wrong <= accuracy * truth.to_f64(), "{name}: {time:?} off by {wrong:e}");
                // The reference has 44 decimals; parameters such as 0.1 are rounded too.
                let rounding = 2f64.powf(truth.log2_roundoff()) * 8.0 * truth.to_f64();
                assert!(wrong <= error + rounding + 1e-43, "{name}: off by {wrong:e}, bound {error:e}");
                let lattice = (truth.to_f64() / contact.round_trip().value().to_f64()).fract() == 0.0;
                assert_eq!(kind == BounceKind::Jump, lattice, "{name}");
            }
            (found, truth) => panic!("{name}: {found:?}, expected {truth}"),
        }
    }
}

#[test]
fn reference_in_doubles() {
    reference::<f64>(&(), 1e-12, |contact| contact.bounce());
}

/// The plan adds bits where doubles leave it open.
#[test]
fn reference_to_an_accuracy() {
    for case in crate::common::reference("first_contact") {
        let problem = crate::common::problem(&case, dalembert::Run::Impacts(1));
        let history = crate::common::to_accuracy(&problem, 1e-12);
        let truth = case["bounce_time"].as_str().map(|text| text.parse::<f64>().unwrap());
        let found = bounce_time(&history);
        assert_eq!(found.is_some(), truth.is_some(), "{}", case["name"]);
        if let (Some((time, error)), Some(truth)) = (found, truth) {
            assert!((time - truth).abs() <= error + f64::EPSILON * truth && error <= 1e-12 * truth, "{}", case["name"]);
        }
    }
}
#[test]
fn reference_in_forty_digits() {
    reference::<rug::Float>(&256, 1e-42, |contact| contact.bounce());
}

/// g = 0, t₁ = 1, μ = 1: terms e^{rt}, sum O(t).
#[test]
fn close_to_the_overdamped_rod() {
    let late = [
        (3.13, "11.66136670144388438415940577414071411946"),
        (3.135, "15.33318837004014558549067344667885556140"),
        (3.14, "31.40409847658940057227989202780933895332"),
    ];
    for (damping, truth) in late {
        let plain = rod(damping, 0.0, 0.5, 1.0).bounce();
        assert!(matches!(&plain, Bounce::Undecided { why, .. } if why.needs_bits()), "doubles must notice: {plain:?}");
        let exact = |x: &str| rug::Float::with_val(512, x.parse::<Number>().unwrap().to_rational());
        let contact = FirstContact::new(
            &Parameters {
                length: exact("0.5"),
                wave_speed: exact("1"),
                damping: exact(&damping.to_string()),
                gravity: exact("0"),
                speed: exact("1"),
            }
            .carry(),
        );
        let Bounce::At { time, kind, .. } = contact.bounce() else { panic!("{damping}") };
        let error = time.bound();
        let wrong: rug::Float = time.into_value() - exact(truth);
        assert!(wrong.to_f64().abs() < 1e-38 && error < 1e-38, "{damping}: {wrong} {error}");
        assert_eq!(kind, BounceKind::Root);
        let (time, error) = bounce_time(&first_contact(&parameters(damping, 0.0, 0.5, 1.0), 1e-12)).unwrap();
        let truth: f64 = truth.parse().unwrap();
        assert!((time - truth).abs() <= error && error < 1e-12 * truth, "{damping}: {time} {error}");
    }
    for damping in [3.15, 3.3, 9.42, 9.43, 50.0, 1e4, 1e9] {
        let never = rod(damping, 0.0, 0.5, 1.0).bounce();
        assert!(matches!(&never, Bounce::Never(NoBounceReason::Overdamped { .. })), "{damping}: {never:?}");
    }
}

/// g = 0, r = 3.135, at 12 t₁: 15 digits are gone, and longer numbers are taken for them. The truth is the sum in 1024
/// bits. Where nothing cancels, doubles are enough.
#[test]
fn lost_digits_are_noticed_and_fetched() {
    use dalembert::solve::Rung;
    use dalembert::{Numbers, Plan, Problem, Question, TypedHistory};
    let solved = |damping: &str, accuracy: f64| -> TypedHistory<f64> {
        let problem = Problem::builder().length("1/2").wave_speed(1).damping(damping).impact_speed(1).build().unwrap();
        let plan = Plan::of(&problem, &Question::first_contact(Numbers::Double(Some(accuracy)))).unwrap();
        TypedHistory::solve(&problem, &plan, std::sync::Arc::new(dalembert::engine::unobserved)).unwrap()
    };
    let plain = rod(3.135, 0.0, 0.5, 1.0).strain(&Estimate::exact(12.5), Side::Right);
    let history = solved("3.135", 1e-14);
    let found = history.strain(12.5, Side::Right).unwrap();
    assert!(matches!(history.rung(), Rung::Bits(_)), "{:?}", history.rung());
    assert!(plain.bound() > plain.value().abs().min(found.abs()), "{plain:?}");
    assert!((plain.value() - found).abs() <= plain.bound());
    let lift = |x: f64| rug::Float::with_val(1024, x);
    let damping = || lift(3135.0) / 1000u32;
    let mut sum = lift(0.0);
    for j in 0..=12 {
        let z = (lift(12.5).square() - lift(f64::from(j * j))).sqrt() * damping();
        let mut term = lift(if j == 0 {
            1.0
        } else if j % 2 == 0 {
            2.0
        } else {
            -2.0
        });
        let quarter = z.square() / 4u32;
        for m in 1..400u32 {
            sum += &term;
            term *= &quarter;
            term /= m * m;
        }
    }
    let truth = -(sum * (-damping() * 12.5f64).exp()).to_f64();
    assert!((found - truth).abs() <= 1e-14 * truth.abs(), "{found:e} {truth:e}");

    let early = solved("0.2", 1e-9);
    early.strain(0.5, Side::Right).unwrap();
    assert_eq!(early.rung(), Rung::Double);
}

/// The doubles next to π.
#[test]
fn on_both_sides_of_pi() {
    let above = rod(3.141_592_653_589_793_6, 0.0, 0.5, 1.0);
    assert!(matches!(above.bounce(), Bounce::Undecided { why, .. } if why.needs_bits()));
    let above = first_contact(&parameters(3.141_592_653_589_793_6, 0.0, 0.5, 1.0), 1e-12);
    assert!(matches!(above.ending(), Ending::NoBounce(_)), "{}", above.ending());
    let below = first_contact(&parameters(3.141_592_653_589_793, 0.0, 0.5, 1.0), 1e-12);
    let Ending::Undecided(Reason::Doubt(why)) = below.ending() else { panic!("{}", below.ending()) };
    assert!(!why.needs_bits(), "{why}");
}

#[test]
fn the_jump_at_the_threshold() {
    let threshold = 2.593_644_954_560_194;
    let (time, _, kind) = at(rod(0.2, 1.0, 1.0, threshold + 1e-12).bounce());
    assert_eq!((time, kind), (2.0, BounceKind::Jump));
    let (time, error) = bounce_time(&first_contact(&parameters(0.2, 1.0, 1.0, threshold - 1e-12), 1e-12)).unwrap();
    assert!(time > 2.0 && time < 2.0 + 1e-11 && error < 1e-12, "{time} {error}");
}

#[test]
fn every_size_of_speed_and_damping_is_answered() {
    // Doubles alone say how far they got.
    let accuracy = 1e-12;
    for damping in [0.0, 1e-300, 1e-9, 1e-4, 0.1, 0.5, 0.9, 1.2, 1.5, 3.0, 25.0, 5e3] {
        for speed in [1e-8, 1e-4, 0.1, 1.0, 1.9, 2.1, 10.0, 1e4, 1e8] {
            let found = first_contact(&parameters(damping, 1.0, 1.0, speed), 1e-12);
            match (bounce_time(&found), found.ending()) {
                (Some((time, error)), _) => {
                    assert!(time >= 2.0 && error <= accuracy * time, "{damping} {speed}: {time} {error}");
                    if damping < 1e-8 {
                        let undamped = if speed >= 2.0 { 2.0 } else { 4.0 - speed };
                        assert!((time - undamped).abs() < 4e-8, "{damping} {speed}: {time}");
                    }
                }
                (None, Ending::NoBounce(_)) => assert!(damping >= 1e-8, "{damping} {speed}"),
                (None, other) => panic!("{damping} {speed}: {other}"),
            }
        }
    }
}

#[test]
fn nothing_moves_or_nothing_is_known() {
    assert!(matches!(rod(0.1, 0.0, 1.0, 0.0).bounce(), Bounce::Never(NoBounceReason::NothingMoves)));
    assert!(matches!(rod(f64::NAN, 1.0, 1.0, 1.0).bounce(), Bounce::Undecided { .. }));
    assert!(matches!(rod(0.1, 1.0, 1.0, -1.0).bounce(), Bounce::Undecided { .. }));
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(150))]

    /// The glued rod's stress is compressive at a thousand times before t_b, and tensile just after.
    #[test]
    fn nothing_is_missed(damping in 0.0f64..2.2, speed in -2.0f64..3.0, weightless in proptest::bool::weighted(0.2)) {
        let rod = parameters(damping.min(1.5), f64::from(u8::from(!weightless)), 1.0, 10f64.powf(speed));
        let (contact, found) = (FirstContact::new(&rod.carry()), first_contact(&rod, 1e-12));
        let end = match (bounce_time(&found), found.ending()) {
            (Some((time, _)), _) => {
                let after = contact.strain(&Estimate::exact(time + 1e-7), Side::Right);
                let dull = after.bound() > after.value().abs();
                proptest::prop_assert!(*after.value() > 0.0 || dull, "{:?} {:?}", time, after);
                time
            }
            (None, Ending::NoBounce(_)) => 40.0,
            (None, why) => {
                proptest::prop_assert!(weightless && *found.end() > 20.0, "{:?} {}", found.end(), why);
                *found.end()
            }
        };
        for k in 1..1000 {
            let stress = contact.strain(&Estimate::exact(end * f64::from(k) / 1000.0), Side::Right);
            proptest::prop_assert!(*stress.value() <= stress.bound(), "{} {:?}", k, stress);
        }
    }
}
