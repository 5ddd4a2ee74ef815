//! Exact stress histories, each beside what the theory says of it.
//!
//! A snapshot says "unchanged"; that it is right is said by the assertions: those of [`snapshot`] for every case, and
//! those of the case itself, from a closed form or worked out by hand.

use crate::common::{fraction as q, uniform};
use dalembert::engine::{Motion, Undamped};
use dalembert::number::Scalar;
use dalembert::{Ending, Error, Parameters, Problem, Rational, Run, Scene, Side, StressHistory, Top, builtin};
use dalembert_verify::paper;

type Exact = Undamped<Rational>;

fn scene(text: &str) -> Problem {
    Scene::parse(text).unwrap().problem
}

/// The contacts as pairs of fractions.
fn contacts(history: &Exact) -> Vec<(Rational, Rational)> {
    history.contacts().iter().filter_map(|contact| Some((contact.impact.clone(), contact.release.clone()?))).collect()
}

/// Solves in fractions; asserts what holds in every undamped history; compares with the snapshot of this name.
fn snapshot(name: &str, problem: &Problem) -> Exact {
    let history = Exact::solve(problem, &()).unwrap();
    let rod = Parameters::<Rational>::of(problem, &()).unwrap();
    let pieces = history.stress_pieces();

    // The ground pushes and never pulls (1.4); the pieces leave no gap.
    assert!(
        pieces
            .iter()
            .all(|piece| piece.strain_start <= q(0, 1) && piece.strain_end <= q(0, 1) && piece.start < piece.end),
        "{name}"
    );
    assert!(pieces.windows(2).all(|pair| pair[0].end == pair[1].start), "{name}");
    assert_eq!((&pieces[0].start, &pieces[pieces.len() - 1].end), (&Rational::default(), &history.end()), "{name}");

    // Energy is the same fraction at every event.
    let energy = history.energy(&Rational::default()).unwrap().total;
    for event in history.events() {
        assert_eq!(history.energy(&event.t).unwrap().total, energy, "{name} at {}", event.t);
    }

    // Contacts: the impulse is the area under the stress; with a free top it is momentum gained and weight carried.
    for (contact, (from, to)) in history.contacts().iter().zip(contacts(&history)) {
        let within = pieces.iter().filter(|piece| piece.start >= from && piece.end <= to);
        let area = within
            .map(|p| Rational::from(&p.strain_start + &p.strain_end) / q(2, 1) * Rational::from(&p.end - &p.start))
            .fold(q(0, 1), |sum, part| sum + part);
        let stiffness = Rational::from(&rod.wave_speed * &rod.wave_speed);
        assert_eq!(contact.impulse, -stiffness * area, "{name}: impulse of the contact from {from}");
        if problem.top() == Top::Free {
            let gained = history.centre(&to).unwrap().1 - history.centre(&from).unwrap().1;
            let weight = Rational::from(&to - &from) * &rod.gravity;
            assert_eq!(contact.impulse, (gained + weight) * &rod.length, "{name}: momentum balance from {from}");
        }
        // Complementarity (1.6): while the ground pushes, the end stands still on it.
        let middle = Rational::from(&from + &to) / q(2, 1);
        assert_eq!(history.ground_end(&middle, Side::Right).unwrap(), (q(0, 1), q(0, 1)), "{name}");
    }

    let stress = StressHistory { pieces, ending: history.ending().clone() };
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(concat!(env!("CARGO_MANIFEST_DIR"), "/snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(format!("stress_{name}"), stress));
    history
}

/// One uniform impact against Corollary 1 and the other closed forms of the first contact.
fn first_contact(name: &str, [length, wave_speed, gravity, speed]: [&str; 4]) -> Exact {
    let problem = uniform(length, wave_speed, gravity, speed, Run::Impacts(1));
    let history = snapshot(name, &problem);
    let closed = paper::UndampedContact::new(&Parameters::<Rational>::of(&problem, &()).unwrap()).unwrap();
    let bounce = closed.bounce_time();
    assert_eq!(contacts(&history), [(q(0, 1), bounce.clone())], "{name}: Corollary 1");
    for k in 0..=24 {
        let time = &bounce * q(k, 20);
        if time > history.end() {
            break;
        }
        for side in [Side::Left, Side::Right] {
            if k > 0 || side == Side::Right {
                assert_eq!(history.strain(&time, side).unwrap(), closed.strain(&time, side), "{name} at {time}");
            }
        }
        assert_eq!(history.centre(&time).unwrap(), closed.centre(&time), "{name} at {time}: (3.51), (3.53)");
    }
    assert_eq!(history.energy(&bounce).unwrap().vibrational, closed.vibrational_energy_at_bounce(), "{name}: (3.69)");
    history
}

/// L = c = g = 1 and μ = k ≥ 2: contacts `[0, 2]`, `[2k + 2, 2k + 4]` and the same again every `4(k + 1)`; the second
/// contact is the first one backwards.
fn periodic(k: i64) {
    let period = 4 * (k + 1);
    let problem = uniform("1", "1", "1", &k.to_string(), Run::Time((2 * period).into()));
    let history = snapshot(&format!("mu_{k}"), &problem);
    let starts = [0, 2 * k + 2, period, period + 2 * k + 2];
    assert_eq!(contacts(&history), starts.map(|start| (q(start, 1), q(start + 2, 1))));
    for (n, (from, _)) in contacts(&history).iter().enumerate() {
        for age in [q(1, 4), q(1, 1), q(7, 4)] {
            let down = if n % 2 == 0 { age.clone() } else { q(2, 1) - &age };
            let stress = history.strain(&Rational::from(from + &age), Side::Right).unwrap();
            assert_eq!(stress, -(q(k, 1) + down), "μ = {k}: −(μ + g t)/c, or its mirror image");
        }
    }
}

#[test]
fn mu_2_is_periodic() {
    periodic(2);
}

#[test]
fn mu_3_is_periodic() {
    periodic(3);
}

#[test]
fn mu_4_is_periodic() {
    periodic(4);
}

#[test]
fn mu_1_2_stays_for_seven_halves() {
    let history = first_contact("mu_1_2", ["1", "1", "1", "1/2"]);
    assert_eq!(contacts(&history)[0].1, q(7, 2));
}

#[test]
fn mu_1_stays_for_three() {
    let history = first_contact("mu_1", ["1", "1", "1", "1"]);
    assert_eq!(contacts(&history)[0].1, q(3, 1));
    // q = 3 − t after t = 4, where v(0,4) = 1/2: the flight ends where 1 − (t − 3)²/2 = 0.
    let Ending::ExactnessEnds { time, .. } = history.ending() else { panic!("{:?}", history.ending()) };
    assert_eq!(time, "3 + √2");
}

/// What is asked beyond the end has the reason of the end; before the start there is none.
#[test]
fn questions_beyond_the_end() {
    let rod = Problem::builder().length(1).wave_speed(1).impact_speed(1);
    let weak = rod.clone().gravity(1).time(5).build().unwrap().exact().unwrap();
    let asked = |time: i32| weak.strain(q(time.into(), 1), Side::Right).unwrap_err();
    let Error::BeyondExactness { found, ending } = asked(5) else { panic!("{}", asked(5)) };
    assert_eq!((found, ending), ("5".to_string(), weak.ending().to_string()));
    assert!(matches!(asked(-1), Error::TimeOutside { .. }));
    // Without gravity nothing follows the first bounce.
    let free = rod.build().unwrap().doubles().unwrap();
    let beyond = free.energy(1e6).unwrap_err();
    assert!(matches!(&beyond, Error::BeyondEnd { ending, .. } if *ending == free.ending().to_string()), "{beyond}");
    assert!(matches!(free.ending(), Ending::NoFurtherImpact(_)));
}

#[test]
fn mu_4_3_has_the_least_restitution() {
    let history = first_contact("mu_4_3", ["1", "1", "1", "4/3"]);
    let e = dalembert::quantity::restitution(&history, history.contacts()[0].times()).unwrap();
    // (4.72) at μ = 2μ₀/3.
    assert_eq!(e.e_e2.unwrap(), q(5, 9));
}

#[test]
fn mu_3_2_stays_for_five_halves() {
    let history = first_contact("mu_3_2", ["1", "1", "1", "3/2"]);
    assert_eq!(contacts(&history)[0].1, q(5, 2));
}

#[test]
fn other_units_strong_impact() {
    // t₁ = 9/2, μ₀ = 9/10.
    let history = first_contact("strong", ["3/2", "2/3", "1/5", "7/3"]);
    assert_eq!(contacts(&history)[0].1, q(9, 2));
}

#[test]
fn other_units_weak_impact() {
    // t₁ = 9/2, μ₀ = 9/10, t_b = 9 − μ/g = 15/2.
    let history = first_contact("weak", ["3/2", "2/3", "1/5", "3/10"]);
    assert_eq!(contacts(&history)[0].1, q(15, 2));
}

#[test]
fn without_gravity_the_stress_is_constant() {
    let problem = uniform("1", "2", "0", "1/3", Run::Time(10.into()));
    let history = snapshot("no_gravity", &problem);
    // −μ/c for 2L/c; the rod leaves undeformed, at the speed of its arrival, and never comes back.
    assert_eq!(contacts(&history), [(q(0, 1), q(1, 1))]);
    assert_eq!(history.strain(&q(1, 2), Side::Right).unwrap(), q(-1, 6));
    assert_eq!(history.field(&q(1, 3), &q(5, 1), Side::Right).unwrap().velocity, q(1, 3));
}

#[test]
fn doyen_ern_piperno() {
    let history = snapshot("doyen_ern_piperno", &scene(builtin::get("doyen-ern-piperno").unwrap().source));
    let starts = [q(0, 1), q(8, 3), q(16, 3), q(8, 1), q(32, 3), q(40, 3)];
    assert_eq!(contacts(&history), starts.map(|start| (start.clone(), start + q(2, 3))));
    // −(μ + g t)/c at t₁ = 2/3: −(10 + 20/3)/30.
    assert!(history.contacts().iter().all(|contact| contact.peak_strain == q(-5, 9)));
}

#[test]
fn getfem_dynamic_contact() {
    let history = snapshot("getfem_dynamic_contact", &scene(builtin::get("getfem-dynamic-contact").unwrap().source));
    assert_eq!(contacts(&history), [1, 4, 7].map(|start| (q(start, 1), q(start + 1, 1))));
    for (n, d) in [(1, 4), (2, 1), (9, 4), (3, 1), (5, 1), (6, 1)] {
        let time = q(n, d);
        // u(0,t) = (1−t)/2 on [0,1], 0 on [1,2], (t−2)/2 on [2,3].
        let age = time.clone() - q((time.clone() / q(3, 1)).floor_int().unwrap() * 3, 1);
        let expected = if age <= q(1, 1) {
            (q(1, 1) - age) / q(2, 1)
        } else if age <= q(2, 1) {
            q(0, 1)
        } else {
            (age - q(2, 1)) / q(2, 1)
        };
        assert_eq!(history.ground_end(&time, Side::Right).unwrap().0, expected, "{time}");
    }
}

#[test]
fn fixed_top_with_gravity() {
    let problem = scene(
        "rod = { length = 1, wave_speed = 1, top = 'fixed' }\nimpact = { speed = 1 }\ngravity = { acceleration = 1 }\n\
         run = { time = 2 }",
    );
    let history = snapshot("fixed_top_gravity", &problem);
    // −(μ + g t)/c until the top, which stopped at t = 0, pulls the end up: at L/c, not at 2L/c.
    assert_eq!(contacts(&history), [(q(0, 1), q(1, 1))]);
    assert_eq!(history.contacts()[0].peak_strain, q(-2, 1));
    assert_eq!(history.contacts()[0].impulse, q(3, 2));
    // The top is held where it was.
    assert_eq!(history.top_end(&q(3, 2), Side::Right).unwrap(), (q(0, 1), q(0, 1)));
}

#[test]
fn fixed_top_above_the_ground_with_gravity() {
    let problem = scene(
        "rod = { length = 1, wave_speed = 1, top = 'fixed' }\nstart = { displacement = [[0, 0.5], [1, 0]] }\n\
         gravity = { acceleration = 0.75 }\nrun = { time = 2 }",
    );
    let history = snapshot("fixed_top_fall", &problem);
    // Free at first: v(0,t) = 1/2 − t/2 − 3t²/8 = 0 at t = 2/3, with the speed −1/2 − 3t/4 = −1.
    let impact = &history.events()[0];
    assert_eq!((&impact.t, &impact.v_end), (&q(2, 3), &q(-1, 1)));
    // Contact begins with −μ/c for the speed of arrival.
    assert_eq!(history.strain(&q(2, 3), Side::Right).unwrap(), q(-1, 1));
}

#[test]
fn lower_half_moving() {
    let problem = scene(
        "rod = { length = 1, wave_speed = 1 }\nstart = { velocity = [[0, -1], [0.5, -1], [0.5, 0], [1, 0]] }\n\
         run = { time = 12 }",
    );
    let history = snapshot("lower_half", &problem);
    // The lower half stops within 1/2. Its wave returns from the top at 3/2 and lifts the end off at 2.
    assert_eq!(contacts(&history), [(q(0, 1), q(2, 1))]);
    let stress = [(1, 4, -1), (1, 1, 0), (7, 4, -1)];
    for (n, d, expected) in stress {
        assert_eq!(history.strain(&q(n, d), Side::Right).unwrap(), q(expected, 1));
    }
    // −1/2 becomes +1/2; an impulse of one.
    assert_eq!(history.centre(&q(2, 1)).unwrap().1, q(1, 2));
}

#[test]
fn linear_velocity() {
    let problem =
        scene("rod = { length = 1, wave_speed = 1 }\nstart = { velocity = [[0, -1], [1, 1]] }\nrun = { time = 12 }");
    let history = snapshot("linear_velocity", &problem);
    // What arrives at t is v_t(ct, 0) = −1 + 2t: stress −(1 − 2t) until t = 1/2.
    assert_eq!(contacts(&history), [(q(0, 1), q(1, 2))]);
    assert_eq!(history.strain(&q(1, 8), Side::Right).unwrap(), q(-3, 4));
    assert_eq!(history.contacts()[0].impulse, q(1, 4));
}

#[test]
fn compressed_at_rest() {
    let problem = scene(
        "rod = { length = 1, wave_speed = 1 }\nstart = { displacement = [[0, 0], [1, -0.25]] }\nrun = { time = 12 }",
    );
    let history = snapshot("compressed", &problem);
    // The free top unloads the rod, which stays until that is known below: L/c. Then it flies undeformed at c·1/4.
    assert_eq!(contacts(&history), [(q(0, 1), q(1, 1))]);
    assert_eq!(history.strain(&q(1, 2), Side::Right).unwrap(), q(-1, 4));
    let energy = history.energy(&q(3, 1)).unwrap();
    assert_eq!((energy.translational, energy.vibrational), (q(1, 32), q(0, 1)));
}

#[test]
fn dropped_from_above() {
    let problem = scene(
        "rod = { length = 1, wave_speed = 1 }\nstart = { displacement = [[0, 2], [1, 2]] }\n\
         gravity = { acceleration = 1 }\nrun = { time = 26 }",
    );
    let history = snapshot("dropped_from_2", &problem);
    // √(2 g h) = 2 after t = 2: the history of μ = 2 from there on.
    let later = Exact::solve(&uniform("1", "1", "1", "2", Run::Time(24.into())), &()).unwrap();
    for k in 0..96 {
        let time = q(k, 4) + q(1, 8);
        let stress = later.strain(&time, Side::Right).unwrap();
        assert_eq!(history.strain(&(time.clone() + q(2, 1)), Side::Right).unwrap(), stress, "{time}");
    }
}
