//! What holds of every damped history, on random scenes, each within the error that the history itself claims.

use crate::common::compares;
use crate::stripped::{Stripped, damped, undamped};
use dalembert::engine::{Damped, Motion};
use dalembert::{Ending, Estimate, Event, Number, Parameters, Problem, Profile, Reason, Side, Speed, Start, Top};
use proptest::prelude::*;

fn number(x: f64) -> Number {
    format!("{x:e}").parse().unwrap()
}

/// A rod of any scale. `μ = M max(g t₁, c/10)`, profiles in units of `L/8` and `c/4`, `r t₁` from `low` to `high`.
pub(crate) fn scene(low: f64, high: f64) -> impl Strategy<Value = Problem> {
    let rod = (prop::sample::select(vec![0.5, 1.0, 3.0]), prop::sample::select(vec![0.7, 1.0, 5.0]), any::<bool>());
    let effects = (low.ln()..high.ln(), prop::option::weighted(0.7, 0.05f64..1.0));
    let points = prop::collection::vec((1u8..8, -4i8..=4), 0..3);
    let start = (prop::option::weighted(0.5, 0.05f64..5.0), 0u8..4, points.clone(), points, any::<bool>());
    (rod, effects, start).prop_map(|((length, c, fixed), (damping, gravity), (uniform, lift, shape, speeds, jump))| {
        let t1 = 2.0 * length / c;
        let g = gravity.map_or(0.0, |g| g * c / t1);
        let list = |points: &[(u8, i8)], from: f64, to: f64, unit: f64| {
            let mut inner = points.to_vec();
            inner.sort_unstable();
            inner.dedup_by_key(|(x, _)| *x);
            let mut list = vec![(number(0.0), number(from))];
            list.extend(
                inner.iter().map(|(x, y)| (number(f64::from(*x) * length / 8.0), number(f64::from(*y) * unit))),
            );
            list.push((number(length), number(to)));
            list
        };
        let start = match uniform {
            Some(speed) => Start::Uniform(Speed::Given(number(speed * (g * t1).max(c / 10.0)))),
            None => {
                let height = f64::from(lift) * length / 8.0;
                // On the ground it is the strain that is linear.
                let (displacement, strain) = match lift {
                    0 => (Vec::new(), list(&shape, -0.3, 0.2, 0.25)),
                    _ => (list(&shape, height, height, length / 16.0), Vec::new()),
                };
                let top = if fixed { 0.0 } else { -c / 4.0 };
                let mut velocity = list(&speeds, -c / 8.0, top, c / 8.0);
                if jump && velocity.len() > 2 {
                    let (x, _) = velocity[1].clone();
                    velocity.insert(2, (x, number(c / 3.0)));
                }
                Start::Profile(Profile { displacement, strain, velocity })
            }
        };
        let top = if fixed { Top::Fixed } else { Top::Free };
        let rod = Problem::builder().length(number(length)).wave_speed(number(c)).top(top).start(start);
        let rod = rod.damping(number(damping.exp() / t1)).gravity(gravity.map_or(0.into(), |_| number(g)));
        rod.time(number(5.3 * t1)).build().unwrap()
    })
}

/// The history; `None` where it ends as too long, so that runs that are compared may end in different places.
fn solve(problem: &Problem) -> Option<Stripped<f64, Damped<f64>>> {
    let history = damped::<f64>(problem, &(), 13.0).unwrap();
    (!matches!(history.ending(), Ending::Undecided(Reason::Effort { .. }))).then_some(history)
}

/// Ordinary times, spread over the history.
fn times(history: &dyn Motion<f64>, count: u32) -> Vec<f64> {
    (0..count).map(|k| history.end() * (f64::from(k) + 0.382) / f64::from(count)).collect()
}

/// A case counts where the bound of the whole run says something: below 1e-6 of the natural scales.
const SAYS_SOMETHING: f64 = 1e-6;

/// (1.3)–(1.6): the ground pushes and never pulls, and only what touches it; the top is free or stays.
#[test]
fn the_ends_obey_their_conditions() {
    compares(64, [60], scene(1e-6, 20.0), |problem| {
        let Some(history) = solve(&problem) else { return Ok([0]) };
        let (scales, error) = (history.scales(), history.error_estimate());
        let (rise, strain) = (scales.velocity * scales.time, scales.velocity / scales.wave_speed);
        let at_top = history.top_end(&0.0, Side::Right).unwrap().0;
        for t in times(&history, 12) {
            for side in [Side::Left, Side::Right] {
                let (height, velocity) = history.ground_end(&t, side).unwrap();
                let stress = history.strain(&t, side).unwrap();
                prop_assert!(height >= -error * rise, "v = {height:e} at {t}");
                prop_assert!(stress <= error * strain, "v_x = {stress:e} at {t}");
                prop_assert!((height * stress).abs() <= error * rise * strain, "v v_x at {t}");
                prop_assert!(stress == 0.0 || velocity.abs() <= error * scales.velocity, "v_t v_x at {t}");
            }
            let top = history.field(&scales.length, &t, Side::Right).unwrap();
            if problem.top() == Top::Free {
                prop_assert!(top.strain.abs() <= 2.0 * error * strain, "free top: {:e} at {t}", top.strain);
            } else {
                prop_assert!((top.displacement - at_top).abs() <= 2.0 * error * rise, "fixed top at {t}");
                prop_assert!(top.velocity.abs() <= 2.0 * error * scales.velocity, "fixed top at {t}");
            }
        }
        Ok([usize::from(error < SAYS_SOMETHING)])
    });
}

/// `P′ + 2rP = −c² v_x(0,t) − gL`, integrated; and `E′ = −2r ∫ v_t² ≤ 0`.
#[test]
fn momentum_and_energy_balance() {
    compares(64, [60], scene(1e-6, 20.0), |problem| {
        let Some(history) = solve(&problem) else { return Ok([0]) };
        let (scales, error) = (history.scales(), history.error_estimate());
        let rod = Parameters::<f64>::of(&problem, &()).unwrap();
        let end = history.end();
        if problem.top() == Top::Free {
            let ((h0, rate0), (h, rate)) = (history.centre(&0.0).unwrap(), history.centre(&end).unwrap());
            let gained = rate - rate0 + 2.0 * rod.damping * (h - h0) + rod.gravity * end;
            let impulse: f64 = history.contacts().iter().map(|contact| contact.impulse).sum();
            // Two h′, two h with 2R, and the stress for as long as it lasts, where c²/L = 2c/t₁.
            let bound = error * scales.velocity * (2.0 + 4.0 * rod.damping * scales.time + 2.0 * end / scales.time);
            let off = (gained - impulse / scales.length).abs();
            prop_assert!(off <= 2.0 * bound, "{off:e} against {bound:e}");
        }
        let energies: Vec<_> = times(&history, 14).iter().map(|t| history.energy(t).unwrap()).collect();
        for pair in energies.windows(2) {
            // v_t and c v_x of a few V, and g h, on both sides.
            let speed = (pair[0].vibrational.max(0.0) / scales.length).sqrt() + scales.velocity;
            let bound = 16.0 * error * speed * scales.velocity * scales.length;
            prop_assert!(pair[1].total <= pair[0].total + bound, "{:e} after {:e}", pair[1].total, pair[0].total);
            prop_assert!(pair[1].vibrational >= 0.0);
            // The rounding of the sum itself.
            let split = pair[1].translational + pair[1].vibrational;
            prop_assert!((pair[1].total - split).abs() <= 4.0 * f64::EPSILON * split.abs().max(pair[1].vibrational));
        }
        Ok([usize::from(error < SAYS_SOMETHING)])
    });
}

/// Without damping in the limit: events where the lattice has them. What `r t₁ = 1e-12` does to the motion in `t`
/// is at most `r t · V`, and the bound of a value says by how much the landings before it magnify an error. `v(0,·)` is
/// the reflection of twice the arriving displacement: a round trip makes an error of it three times as large at
/// most.
#[test]
fn the_undamped_lattice_is_the_limit() {
    compares(64, [60], scene(1e-12, 1.000001e-12), |problem| {
        let Some(history) = solve(&problem) else { return Ok([0]) };
        let mut plain = problem.clone();
        plain = plain.to_builder().damping(0).build().unwrap();
        let lattice = undamped::<f64>(&plain, &()).unwrap();
        let scales = history.scales();
        // Landings without speed, and releases where the stress only comes to zero, may be missed by one of the two.
        let transversal = |event: &Event<f64>| event.v_end.abs() > 0.02 * scales.velocity;
        let magnified = |event: &Event<f64>| {
            (event.t_error / scales.time / f64::EPSILON).max(1.0) * 1e-12 * (1.0 + event.t / scales.time)
        };
        for (ours, plain) in history.events().iter().zip(lattice.events()) {
            // From a landing without speed on, lists of events need not agree.
            if !transversal(ours) || !transversal(plain) || magnified(ours) > 1e-5 {
                break;
            }
            let off = (ours.t - plain.t).abs() / scales.time;
            if ours.kind == plain.kind && off <= magnified(ours) {
                continue;
            }
            // Nor from a contact without stress on, which the damping may turn into a flight that hardly leaves the
            // ground: then the end of the one touches where that of the other lands or leaves.
            let first = ours.t.min(plain.t);
            let end = |motion: &dyn Motion<f64>| motion.ground_end(&first, Side::Right).unwrap().0;
            let (a, b) = (end(&history), end(&lattice));
            let bound = magnified(ours) * scales.velocity * scales.time;
            prop_assert!(a.max(b) <= bound, "{off:e} against {:e}: {ours:?} {plain:?}", magnified(ours));
            break;
        }
        let mut compared = 0;
        for t in times(&history, 8) {
            let trips = t / scales.time;
            let magnified = 2.0 * 3f64.powf(trips + 1.0) * 1e-12 * trips * scales.velocity * scales.time;
            let ours = history.carried().ground_end(&Estimate::exact(t), Side::Right).unwrap().0;
            let plain = lattice.ground_end(&t, Side::Right).unwrap().0;
            let (off, bound) = ((ours.value() - plain).abs(), magnified + ours.bound());
            prop_assert!(off <= bound, "{ours:?} and {plain:e} at {t}, bound {bound:e}");
            // After events whose order doubles do not tell, the bound is infinite: it holds and shows nothing.
            compared += usize::from(bound < 1e-3 * scales.velocity * scales.time);
        }
        Ok([compared])
    });
}

/// Doubles are as good as they say, against forty digits.
#[test]
fn doubles_keep_their_promise() {
    use dalembert::EventKind;
    use rug::Float;
    compares(8, [8], scene(1e-6, 4.0), |problem| {
        let Some(history) = solve(&problem) else { return Ok([0]) };
        let truth = damped::<Float>(&problem, &200, 40.0).unwrap();
        let (scales, error) = (history.scales(), history.error_estimate());
        for t in times(&history, 6) {
            let exact = Float::with_val(200, t);
            let ((h, rate), (h0, rate0)) = (history.centre(&t).unwrap(), truth.centre(&exact).unwrap());
            let ends = (history.ground_end(&t, Side::Right).unwrap(), truth.ground_end(&exact, Side::Right).unwrap());
            let rise = scales.velocity * scales.time;
            prop_assert!((h - h0.to_f64()).abs() <= error * rise, "h at {t}: {error:e}");
            prop_assert!((rate - rate0.to_f64()).abs() <= error * scales.velocity, "h' at {t}: {error:e}");
            prop_assert!((ends.0.0 - ends.1.0.to_f64()).abs() <= error * rise, "v(0) at {t}: {error:e}");
        }
        if history.events().len() == truth.events().len() {
            for (a, b) in history.events().iter().zip(truth.events()) {
                // Of a hop that rounding decides, times are known to the square root of the error only.
                if a.kind == EventKind::Impact && a.v_end.abs() < 1e-6 * scales.velocity {
                    break;
                }
                let off = (a.t - b.t.to_f64()).abs();
                prop_assert!(off <= a.t_error + b.t_error, "{a:?} {off:e}");
            }
        }
        Ok([times(&history, 6).len()])
    });
}
