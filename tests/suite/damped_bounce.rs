//! Two ways to the first contact: cells, and the closed form.

use crate::common::uniform;
use crate::stripped::Stripped;
use dalembert::engine::{Bounce, ContactHistory, Damped, FirstContact, Motion, Scales};
use dalembert::{Ending, Error, Estimate, EventKind, Number, Numbers, Parameters, Problem, Reason, Run, Side};

/// A rod of any length, wave speed, damping, gravity and speed that may bounce more than once.
fn scene(random: &mut impl FnMut() -> f64) -> Problem {
    let mut spread = |low: f64, high: f64| -> f64 { low * (high / low).powf(random()) };
    let (length, c) = (spread(0.1, 10.0), spread(0.1, 10.0));
    let t1 = 2.0 * length / c;
    let damping = spread(1e-6, 1.7) / t1;
    let gravity = spread(0.01, 10.0);
    let speed = gravity * t1 * spread(0.3, 6.0);
    let text = |x: f64| format!("{x:e}");
    let mut problem = uniform(&text(length), &text(c), &text(gravity), &text(speed), Run::Impacts(3));
    if damping > 1e-5 && length > 0.5 {
        problem = problem.with_run(Run::Time(text(7.7 * t1).parse::<Number>().unwrap())).unwrap();
    }
    problem = problem.to_builder().damping(text(damping)).build().unwrap();
    problem
}

/// Cells from the start, and the closed form; `None` where the first contact does not end, or a march is refused as too
/// long.
fn both(problem: &Problem) -> Option<(Damped<f64>, ContactHistory<Estimate<f64>>)> {
    let rod = Parameters::<f64>::of(problem, &()).unwrap();
    let form = FirstContact::new(&rod.carry());
    let bounce = form.bounce();
    if !matches!(bounce, Bounce::At { .. }) {
        return None;
    }
    let marched = Damped::<f64>::solve(problem, &(), 13.0).unwrap();
    if matches!(marched.ending(), Ending::Undecided(Reason::Effort { .. })) {
        return None;
    }
    Some((marched, ContactHistory::new(form, bounce, None).unwrap()))
}

#[test]
fn cells_and_the_closed_form_agree_within_their_bounds() {
    // splitmix64, to 0 … 1.
    let mut seed = 7u64;
    let mut random = || {
        seed = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (seed ^ (seed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    };
    let (mut scenes, mut compared, mut useful) = (0, 0, 0);
    while scenes < 1000 {
        let problem = scene(&mut random);
        let Some((marched, contact)) = both(&problem) else { continue };
        scenes += 1;
        let Scales { time: t1, velocity, length, wave_speed, .. } = contact.scales().map(|scale| scale.into_value());
        let mut near = |what: &str, a: &Estimate<f64>, b: &Estimate<f64>, unit: f64| {
            let (off, bound) = ((a.value() - b.value()).abs(), a.bound() + b.bound());
            assert!(off <= bound, "{problem:?} {what}: {a:?} {b:?}, off by {off:e}, bound {bound:e}");
            compared += 1;
            useful += i32::from(bound < 1e-9 * unit);
        };
        let (ours, theirs) = (&contact.events()[1], &marched.events()[1]);
        assert_eq!((ours.kind, theirs.kind), (EventKind::Release, EventKind::Release));
        near("release", &ours.t, &theirs.t, t1);
        near("h", &ours.h, &theirs.h, velocity * t1);
        near("h'", &ours.h_rate, &theirs.h_rate, velocity);
        near("impulse", &contact.contacts()[0].impulse, &marched.contacts()[0].impulse, velocity * length);
        let release = ours.t.value() - ours.t.bound() - theirs.t.bound();
        for share in [0.1, 0.37, 0.7, 0.999] {
            let t = Estimate::exact(release * share);
            for x in [0.0, 0.41, 1.0] {
                let x = Estimate::exact(x * length);
                let (a, b) = (contact.field(&x, &t, Side::Right).unwrap(), marched.field(&x, &t, Side::Right).unwrap());
                near("v", &a.displacement, &b.displacement, velocity * t1);
                near("v_t", &a.velocity, &b.velocity, velocity);
                near("v_x", &a.strain, &b.strain, velocity / wave_speed);
            }
            let (a, b) = (contact.energy(&t).unwrap(), marched.energy(&t).unwrap());
            near("E_z", &a.vibrational, &b.vibrational, length * velocity * velocity);
        }
    }
    assert!(compared == 44 * scenes && useful > compared - compared / 20, "{useful} of {compared}");
}

#[test]
fn a_question_about_the_first_contact_needs_no_cells() {
    let mut problem = uniform("1", "1", "1", "3", Run::Impacts(10));
    problem = problem.to_builder().damping("0.1").build().unwrap();
    let (long, short) = both(&problem).unwrap();
    let (long, short) = (Stripped::new(long), Stripped::new(short));
    assert_eq!(*short.ending(), Ending::Bounce);
    assert_eq!(short.end(), 2.0);
    assert_eq!((short.events().len(), short.contacts().len()), (2, 1));
    assert_eq!((short.events()[1].kind, short.events()[1].t), (EventKind::Release, long.events()[1].t));
    assert_eq!(short.contacts()[0].release, long.contacts()[0].release);
    assert!(matches!(short.centre(&2.5), Err(Error::TimeOutside { .. })));
}

/// Every number within its own bound of what forty digits say.
#[test]
fn answers_carry_their_bounds() {
    use dalembert::number::Scalar;
    use rug::Float;
    for (damping, speed) in [("0.1", "3"), ("0.02", "10"), ("0.3", "5")] {
        let mut problem = uniform("1", "1", "1", speed, Run::Impacts(4));
        problem = problem.to_builder().damping(damping).build().unwrap();
        let bounded = Damped::<f64>::solve(&problem, &(), 13.0).unwrap();
        let truth = crate::stripped::damped::<Float>(&problem, &200, 40.0).unwrap();
        let near = |what: &str, ours: &Estimate<f64>, truth: &Float| {
            let off = Float::with_val(200, truth - *ours.value()).abs().to_f64();
            let useful = 1e-8 * (1.0 + ours.value().abs());
            // The truth has forty digits.
            assert!(
                off <= ours.bound() + 1e-40 && ours.bound() < useful,
                "{damping} {what}: {off:e} {:e}",
                ours.bound()
            );
        };
        for (ours, truth) in bounded.events().iter().zip(truth.events()) {
            near("time", &ours.t, &truth.t);
            near("velocity", &ours.v_end, &truth.v_end);
            near("h", &ours.h, &truth.h);
            near("h'", &ours.h_rate, &truth.h_rate);
        }
        // A contact without end lasts as long as the history, which may end elsewhere in more digits.
        for (ours, truth) in bounded.contacts().iter().zip(truth.contacts()).filter(|(ours, _)| ours.release.is_some())
        {
            near("impulse", &ours.impulse, &truth.impulse);
            near("peak", &ours.peak_strain, &truth.peak_strain);
        }
        let (ours, exact) = (bounded.highest(1).unwrap(), truth.highest(1).unwrap());
        near("t*", &ours.0, &exact.0);
        near("h(t*)", &ours.1, &exact.1);
        for k in 0..10 {
            let t = bounded.end().to_f64() * (f64::from(k) + 0.37) / 10.0;
            let (time, point) = (Float::with_val(200, t), Float::with_val(200, 0.625));
            let (ours, exact) = (
                bounded.field(&Estimate::exact(0.625), &Estimate::exact(t), Side::Right).unwrap(),
                truth.field(&point, &time, Side::Right).unwrap(),
            );
            near("v", &ours.displacement, &exact.displacement);
            near("v_t", &ours.velocity, &exact.velocity);
            near("v_x", &ours.strain, &exact.strain);
            let (ours, exact) = (bounded.energy(&Estimate::exact(t)).unwrap(), truth.energy(&time).unwrap());
            near("E", &ours.total, &exact.total);
            near("E_z", &ours.vibrational, &exact.vibrational);
        }
    }
}

/// Over a flight of thousands of round trips the vibration dies out, and the centre of mass falls by Stokes' law.
#[test]
fn a_flight_outlasts_its_vibration() {
    for (damping, speed) in [(0.314, 20_000), (0.001, 200_000)] {
        let problem = Problem::builder().length(1).wave_speed(1).damping(damping).gravity(1).impact_speed(speed);
        let problem = problem.impacts(2).build().unwrap();
        let history = problem.doubles().unwrap();
        let [_, release, landing, ..] = history.events() else { panic!("{:?}", history.events()) };
        let (age, drag) = (landing.t - release.t, 2.0 * damping);
        // h(τ) = h₀ + (h₀′ + g/2r)(1 − e^{−2rτ})/2r − gτ/2r, and h = 0 where a rod without vibration lands.
        let height = release.h + (release.h_rate + 1.0 / drag) * -(-drag * age).exp_m1() / drag - age / drag;
        assert!(height.abs() < 1e-10 * age, "r = {damping}: {height:e} after {age}");
        assert!(age > 1e4, "{age}");
    }
}

/// The highest points of the flights of rods that the ground pushes for an uncertain time before they leave it.
#[test]
fn highest_points_are_within_their_bounds() {
    let mut compared = 0;
    for (length, modulus, density, damping, speed, gravity) in [
        ("0.1", "12e9", "600", "0.0027", "3", "1.62"),
        ("0.1", "12e9", "600", "3e-5", "3", "1.62"),
        ("2.5", "7e10", "2700", "10.2", "0.5", "1.62"),
        ("0.5", "1e6", "1100", "4", "2", "9.81"),
        ("1", "1", "1", "0.1", "3", "1"),
    ] {
        let [modulus, density] = [modulus, density].map(|x| x.parse::<Number>().unwrap());
        let rod = Problem::builder().length(length).material(modulus, density, 1);
        let rod = rod.damping(damping).impact_speed(speed).gravity(gravity).impacts(5).build().unwrap();
        let history = rod.solve_in(Numbers::default()).unwrap();
        let truth = rod.solve_in(Numbers::Digits(30)).unwrap();
        for (ours, truth) in history.flights().unwrap().into_iter().zip(truth.flights().unwrap()) {
            assert_eq!(ours.top.is_some(), truth.top.is_some());
            for (ours, truth) in [(ours.top, truth.top), (ours.top_time, truth.top_time)] {
                let (Some(ours), Some(truth)) = (ours, truth) else { continue };
                let off = (ours.to_f64() - truth.to_f64()).abs();
                let bound = ours.bound().to_f64() + f64::EPSILON * truth.to_f64().abs();
                assert!(off <= bound, "{length} {damping}: {ours:?} {truth:?}: {off:e}");
                compared += 1;
            }
        }
    }
    assert!(compared > 30, "{compared}");
}
