//! A rod that starts above the ground: the touch by hand, and after it the motion of the rod that touches at `t = 0`.

use dalembert::{Ending, EventKind, Number, Problem, Side, Start};
use dalembert::{Run, Top};
use proptest::prelude::*;

use crate::common::close;

fn n(text: &str) -> Number {
    text.parse().unwrap()
}

/// `c = L = 1`.
fn above(gravity: &str, speed: &str, gap: &str) -> dalembert::problem::Builder {
    Problem::builder().length(1).wave_speed(1).gravity(gravity).impact_speed(speed).gap(gap)
}

/// g = 1, μ = 1, gap = 4: h = 4 − t − t²/2 is zero at t = 2, with the velocity −3, and Corollary 1 goes on from there.
#[test]
fn a_fall_by_hand() {
    let rod = above("1", "1", "4").time(7).build().unwrap();
    assert_eq!(rod.dimensionless().speed_ratio, Some(1.5));
    let history = rod.doubles().unwrap();
    let events: Vec<_> = history.events().iter().map(|event| (event.kind, event.t, event.v_end)).collect();
    // The release velocity is that of μ = 3: the stress −(μ + g t)/c at t₁ = 2 jumps by 2μ/c.
    assert_eq!(events, [(EventKind::Impact, 2.0, -3.0), (EventKind::Release, 4.0, 1.0)]);
    for (time, height, rate) in [(0.0, 4.0, -1.0), (1.0, 2.5, -2.0), (1.5, 1.375, -2.5)] {
        let near = |(v, v_t): (f64, f64)| {
            close("v", v, height, 4.0, 1e-15);
            close("v_t", v_t, rate, 1.0, 1e-15);
        };
        near(history.ground_end(time, Side::Right).unwrap());
        near(history.top_end(time, Side::Right).unwrap());
        near(history.centre(time).unwrap());
        let field = history.at(0.25, time).unwrap();
        near((field.displacement, field.velocity));
        assert_eq!(field.strain, 0.0);
        let energy = history.energy(time).unwrap();
        // ½μ² + g·gap.
        close("E", energy.total, 4.5, 1.0, 1e-15);
        assert_eq!((energy.translational, energy.vibrational), (energy.total, 0.0));
        assert_eq!(history.strain(time, Side::Right).unwrap(), 0.0);
    }
    assert_eq!(history.strain(3.0, Side::Right).unwrap(), -4.0);
    assert_eq!(history.stress_history().unwrap().pieces[0].end, 2.0);
}

/// Without gravity the touch is at gap/μ.
#[test]
fn a_flight_without_gravity_by_hand() {
    let history = above("0", "1/4", "5").build().unwrap().doubles().unwrap();
    assert_eq!(history.contacts()[0].impact, 20.0);
    assert_eq!(history.contacts()[0].release, Some(22.0));
    assert_eq!(history.events()[1].v_end, 0.25);
}

/// The top stops at t = 0, half a length up: −1 below the wave from the top, which stretches the rod by 1. The lower
/// end touches at ½; compressed by 1, it stays until the wave from the top arrives at 1, and leaves with +1.
#[test]
fn a_rod_that_is_stopped_at_its_top_by_hand() {
    let history = above("0", "1", "1/2").fixed_top().time(2).build().unwrap().doubles().unwrap();
    let contact = &history.contacts()[0];
    assert_eq!((contact.impact, contact.release, contact.impulse, contact.peak_strain), (0.5, Some(1.0), 0.5, -1.0));
    assert_eq!(history.events()[1].v_end, 1.0);
    assert_eq!(history.top_end(0.75, Side::Right).unwrap(), (0.5, 0.0));
    let field = history.at(0.75, 0.5).unwrap();
    assert_eq!((field.displacement, field.velocity, field.strain), (0.25, 0.0, 1.0));
    let crossed = history.at(0.25, 0.875).unwrap();
    assert_eq!((crossed.velocity, crossed.strain), (1.0, 0.0));
}

/// A held rod above the reach of its end, and a damped one that stops before the ground.
#[test]
fn some_never_touch() {
    // Let go undeformed under g = 1, the end swings down to −gL²/c² = −1 and back.
    let rod = above("1", "0", "2").fixed_top().build().unwrap();
    let history = rod.doubles().unwrap();
    assert!(history.contacts().is_empty() && matches!(history.ending(), Ending::NoFurtherImpact(_)));
    let lowest = history.ground_end(2.0, Side::Right).unwrap().0;
    assert!((lowest - 1.0).abs() < 1e-14, "{lowest}");
    // μ/2r = 5 is less than the gap.
    let history = above("0", "1", "6").damping("0.1").build().unwrap().doubles().unwrap();
    assert!(history.contacts().is_empty() && matches!(history.ending(), Ending::NoFurtherImpact(_)));
}

#[test]
fn it_goes_back_to_a_builder() {
    let rod = above("1", "1", "4").build().unwrap();
    assert_eq!(rod.start(), &Start::Above { gap: n("4"), speed: n("1") });
    assert_eq!(rod.to_builder().build().unwrap(), rod);
    let faster = rod.to_builder().impact_speed(2).build().unwrap();
    assert_eq!(faster.start(), &Start::Above { gap: n("4"), speed: n("2") });
    assert_eq!(rod.to_builder().gap(0).build().unwrap().gap(), None);
    let dropped = rod.to_builder().drop_height(3).build().unwrap();
    assert_eq!(dropped.gap(), None);
    let error = dropped.to_builder().gap(1).build().unwrap_err();
    let expected =
        "found gap without impact_speed, expected impact_speed at t = 0 as well; zero for a rod dropped from rest";
    assert_eq!(error.to_string(), expected);
    assert!(!rod.has_closed_form());
}

/// The gap, the speed, the gravity and the time `τ` of the touch of a random scene, whose numbers are all rational:
/// gap = μτ + gτ²/2; and the same rod that touches at t = 0 with μ + gτ.
fn pairs() -> impl Strategy<Value = (Problem, Problem, rug::Rational)> {
    let small = || (1i64..=9, 1i64..=5).prop_map(rug::Rational::from);
    let gravity = prop::option::weighted(0.7, small());
    (small(), small(), gravity, prop::option::weighted(0.8, small()), small()).prop_map(|(l, c, g, mu, share)| {
        let g = g.unwrap_or_default();
        // Speeds of the size that gravity gives in a round trip, so that contacts of every kind occur.
        let t1 = rug::Rational::from(&l * 2) / &c;
        let unit = if g == 0 { c.clone() } else { rug::Rational::from(&g * &t1) };
        let mu = mu.map_or_else(|| if g == 0 { unit.clone() } else { rug::Rational::new() }, |mu| mu * &unit);
        let tau = share * &t1;
        let touch = rug::Rational::from(&g * &tau) + &mu;
        let gap = (rug::Rational::from(&touch + &mu) * &tau) / 2;
        let end = rug::Rational::from(&t1 * 9) + &tau;
        let rod = Problem::builder().length(l).wave_speed(c).gravity(g).time(end);
        let touching = rod.clone().impact_speed(touch).build().unwrap();
        (rod.impact_speed(mu).gap(gap).build().unwrap(), touching, tau)
    })
}
mod shifted {
    use super::*;
    use dalembert::Side;
    use dalembert::number::Scalar;
    use rug::Rational;

    proptest! {
        #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

        /// Exactly: events, contacts, and every quantity at times between.
        #[test]
        fn in_fractions((above, touching, tau) in pairs(), shares in prop::collection::vec(0i64..=60, 6)) {
            let (above, touching) = (above.exact().unwrap(), touching.exact().unwrap());
            let later = |time: &Rational| Rational::from(time + &tau);
            // The run of the one that touches first is longer by τ.
            let reach = Rational::from(above.end() - &tau).min(touching.end().clone());
            let events: Vec<_> = touching.events().iter().filter(|event| event.t < reach).collect();
            prop_assert!(above.events().len() >= events.len() && !events.is_empty());
            for (ours, event) in above.events().iter().zip(events) {
                prop_assert_eq!((ours.kind, &ours.t), (event.kind, &later(&event.t)));
                let numbers = |event: &dalembert::Event<Rational>| {
                    [&event.v_end, &event.h, &event.h_rate].map(Clone::clone)
                };
                prop_assert_eq!(numbers(ours), numbers(event));
            }
            let ended = touching.contacts().iter().filter(|contact| contact.release.as_ref().is_some_and(|to| *to < reach));
            for (ours, contact) in above.contacts().iter().zip(ended) {
                prop_assert_eq!((&ours.impulse, &ours.peak_strain), (&contact.impulse, &contact.peak_strain));
            }
            let length = touching.scales().length;
            for (k, share) in shares.into_iter().enumerate() {
                let time = Rational::from(&reach * Rational::from((share, 60)));
                let side = [Side::Left, Side::Right][k % 2];
                let point = Rational::from(&length * Rational::from((k as i64, 5)));
                if share == 0 && side == Side::Left {
                    continue;
                }
                let at = later(&time);
                prop_assert_eq!(above.strain(at.clone(), side).unwrap(), touching.strain(time.clone(), side).unwrap());
                let ends = |history: &dalembert::TypedHistory<Rational>, time: &Rational| {
                    let ground = history.ground_end(time.clone(), side).unwrap();
                    (ground, history.top_end(time.clone(), side).unwrap())
                };
                prop_assert_eq!(ends(&above, &at), ends(&touching, &time));
                prop_assert_eq!(above.energy(at.clone()).unwrap(), touching.energy(time.clone()).unwrap());
                prop_assert_eq!(
                    above.field(std::slice::from_ref(&point), &[at], side).unwrap(),
                    touching.field(&[point], &[time], side).unwrap()
                );
            }
        }

        /// Before the touch: h = gap − μt − gt²/2, everywhere, without strain.
        #[test]
        fn the_fall_in_fractions((above, _, tau) in pairs(), share in 0i64..60) {
            let (gap, speed) = match above.start() {
                Start::Above { gap, speed } => (gap.to_rational(), speed.to_rational()),
                other => panic!("{other:?}"),
            };
            let gravity = above.gravity().map_or_else(Rational::new, Number::to_rational);
            let length = above.length().to_rational();
            let time = tau * Rational::from((share, 60));
            let height = gap - Rational::from(&speed * &time) - Rational::from(&gravity * &time) * &time / 2;
            let rate = -(speed + gravity * &time);
            let history = above.exact().unwrap();
            let field = history.at(Rational::from(&length * Rational::from((1, 3))), time.clone()).unwrap();
            prop_assert_eq!((&field.displacement, &field.velocity, field.strain == 0), (&height, &rate, true));
            prop_assert_eq!(history.centre(time.clone()).unwrap(), (height.clone(), rate.clone()));
            prop_assert_eq!(history.ground_end(time, Side::Right).unwrap(), (height, rate));
        }

        /// In doubles, digits and enclosures against fractions: the end's height is continuous, whatever events do.
        #[test]
        fn in_other_numbers((above, touching, tau) in pairs(), share in 1i64..=60) {
            let exact = touching.exact().unwrap();
            let reach = Rational::from(exact.end() - &tau);
            prop_assume!(reach > 0);
            let time = reach * Rational::from((share, 60));
            let (height, _) = exact.ground_end(time.clone(), Side::Right).unwrap();
            let at = Rational::from(&time + &tau);
            let scale = exact.scales();
            let size = (Rational::from(&scale.time * &scale.velocity) * 10i64).to_f64();
            let near = |what: &str, found: f64, accuracy: f64| close(what, found, height.to_f64(), size, accuracy);
            near("doubles", above.doubles().unwrap().ground_end(at.to_f64(), Side::Right).unwrap().0, 1e-8);
            let float = rug::Float::with_val(200, &at);
            near("digits", above.digits(30).unwrap().ground_end(float, Side::Right).unwrap().0.to_f64(), 1e-15);
            let proved = above.certified(20).unwrap();
            let precision = dalembert::number::Scalar::precision(proved.end());
            let asked = dalembert::Interval::from_number(&n(&at.to_string()), &precision);
            prop_assert!(proved.ground_end(asked, Side::Right).unwrap().0.contains(&height));
        }
    }

    /// Let fall from 4 under g = 1: the touch is at 2√2, which is no fraction, is known to any digits, and is enclosed.
    #[test]
    fn an_irrational_touch() {
        let rod = super::above("1", "0", "4").time(4).build().unwrap();
        let exact = rod.exact().unwrap();
        let Ending::ExactnessEnds { kind, time, .. } = exact.ending() else { panic!("{:?}", exact.ending()) };
        assert_eq!((kind, time.as_str()), (&EventKind::Impact, "2√2"));
        let root = rug::Float::with_val(400, 8).sqrt();
        let digits = rod.digits(60).unwrap();
        let error = rug::Float::with_val(400, &digits.events()[0].t - &root).to_f64().abs();
        assert!(error < 1e-59, "{error}");
        let proved = rod.certified(40).unwrap();
        let time = &proved.events()[0].t;
        assert!(*time.lo() <= root && root <= *time.hi());
        assert!(rug::Float::with_val(400, time.hi() - time.lo()).to_f64() < 1e-40);
    }
}

/// Under damping, without gravity: −h″ = 2r h′ gives the touch at −ln(1 − 2r gap/μ)/2r with the speed μ − 2r gap; after
/// it the closed form of the first contact, which the cells that follow the fall do not use.
#[test]
fn a_damped_flight_by_hand() {
    for (damping, speed, gap) in [(0.1_f64, 1.0, 2.0), (0.3, 2.0, 0.5), (0.05, 1.0, 0.01)] {
        let rod = |speed: f64| Problem::builder().length(1).wave_speed(1).damping(damping).impact_speed(speed).time(8);
        let touch = -(-2.0 * damping * gap / speed).ln_1p() / (2.0 * damping);
        let slower = speed - 2.0 * damping * gap;
        let above = rod(speed).gap(gap).build().unwrap().doubles().unwrap();
        let touching = rod(slower).build().unwrap().doubles().unwrap();
        close("touch", above.events()[0].t, touch, 1.0, 1e-12);
        close("speed", above.events()[0].v_end, -slower, 1.0, 1e-11);
        close("release", above.events()[1].t, touch + touching.events()[1].t, 1.0, 1e-11);
        close("rebound", above.events()[1].v_end, touching.events()[1].v_end, 1.0, 1e-10);
        for time in [0.3, 0.9, 1.7] {
            let strain = |history: &dalembert::TypedHistory<f64>, t: f64| history.strain(t, Side::Right).unwrap();
            close("strain", strain(&above, touch + time), strain(&touching, time), 1.0, 1e-10);
        }
        let flown = |history: &dalembert::TypedHistory<f64>, t: f64| history.ground_end(t, Side::Right).unwrap();
        close("flight", flown(&above, touch + 2.5).0, flown(&touching, 2.5).0, 1.0, 1e-10);
        let time = touch / 2.0;
        let fallen = speed * -(-2.0 * damping * time).exp_m1() / (2.0 * damping);
        close("height", above.ground_end(time, Side::Right).unwrap().0, gap - fallen, 1.0, 1e-12);
    }
}

/// Under damping and gravity the fall h(t) has one zero, found here by bisection in 200 bits, and the motion after
/// it is that of the rod that touches with that speed.
#[test]
fn a_damped_fall_against_bisection() {
    use rug::Float;
    let bits = 200;
    let float = |text: &str| Float::with_val(bits, Float::parse(text).unwrap());
    for (damping, gravity, speed, gap) in [("0.1", "1", "1", "4"), ("0.5", "2", "0", "1"), ("2", "1", "3", "0.25")] {
        let (r, g) = (float(damping), float(gravity));
        let twice = Float::with_val(bits, &r * 2);
        // h′ = −(μ e^{−2rt} + (g/2r)(1 − e^{−2rt})), h = gap + (g/2r − μ)(1 − e^{−2rt})/2r − (g/2r) t.
        let terminal = Float::with_val(bits, &g / &twice);
        let fade = |t: &Float| Float::with_val(bits, -(&twice * t.clone())).exp();
        let height = |t: &Float| {
            let fallen = (1 - fade(t)) / &twice;
            float(gap) + (terminal.clone() - float(speed)) * fallen - Float::with_val(bits, &terminal * t)
        };
        let (mut low, mut high) = (Float::new(bits), float("100"));
        for _ in 0..bits {
            let middle = Float::with_val(bits, &low + &high) / 2;
            if height(&middle) > 0 { low = middle } else { high = middle }
        }
        let faded = fade(&low);
        let touch_speed: Float = Float::with_val(bits, float(speed) * &faded) + terminal.clone() * (1 - faded);
        let rod = Problem::builder().length(1).wave_speed(1).damping(damping).gravity(gravity);
        let above = rod.clone().impact_speed(speed).gap(gap).time(12).build().unwrap().digits(25).unwrap();
        let touching = rod.impact_speed(&*touch_speed.to_string_radix(10, Some(55))).time(12).build().unwrap();
        let touching = touching.digits(25).unwrap();
        let off = |a: &Float, b: &Float| Float::with_val(bits, a - b).to_f64().abs();
        assert!(off(&above.events()[0].t, &low) < 1e-24, "{damping}: {}", above.events()[0].t);
        assert!(above.events().len() > 1 || damping != "0.1");
        for (ours, event) in above.events().iter().zip(touching.events()) {
            assert_eq!(ours.kind, event.kind);
            assert!(off(&ours.t, &Float::with_val(bits, &event.t + &low)) < 1e-22, "{damping}: {}", ours.t);
            assert!(off(&ours.v_end, &event.v_end) < 1e-22);
            assert!(off(&ours.h, &event.h) < 1e-22);
        }
    }
}

/// A start above the ground is proved, damped or not.
#[test]
fn what_is_proved() {
    let damped = above("1", "1", "4").damping("0.1").build().unwrap();
    let (proved, digits) = (damped.certified(20).unwrap(), damped.digits(40).unwrap());
    for (a, b) in proved.events().iter().zip(digits.events()) {
        assert!((rug::Float::with_val(200, a.t.mid()) - &b.t).abs() < 1e-38 && a.t.radius() < 1e-19, "{}", a.t);
    }
    assert_eq!(proved.events().len(), digits.events().len());
    let mut problem = above("1", "1", "4").build().unwrap();
    problem = problem.to_builder().top(Top::Fixed).run(Run::Impacts(2)).build().unwrap();
    assert!(problem.certified(20).is_ok());
}
