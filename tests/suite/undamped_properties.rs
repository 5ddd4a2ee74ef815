//! What holds of every undamped history, tested exactly, in fractions, on random scenes. Speeds that are small
//! multiples of `g t₁` are common among them, so that rays and events often coincide.

use crate::stripped::undamped;
use dalembert::engine::{Motion, Undamped, reflection};
use dalembert::number::Scalar;
use dalembert::quantity::{flights, restitution};
use dalembert::{Ending, EventKind, Number, Parameters, Problem, Profile, Run, Side, Start, Top};
use dalembert_verify::paper;
use proptest::prelude::*;
use rug::{Float, Rational};

type Exact = Undamped<Rational>;

fn number(p: i64, q: i64) -> Number {
    format!("{p}/{q}").parse().unwrap()
}

/// Positive fractions with small numerator and denominator.
fn small() -> impl Strategy<Value = (i64, i64)> {
    (1i64..=12, 1i64..=6)
}

/// A uniform start. `μ = M g t₁` with a small fraction `M`, or any `μ` without gravity.
fn uniform() -> impl Strategy<Value = Problem> {
    (small(), small(), prop::option::weighted(0.8, small()), small(), any::<bool>()).prop_map(|(l, c, g, m, fixed)| {
        let (l, c) = (number(l.0, l.1), number(c.0, c.1));
        let mut rod = Problem::builder().length(&l).wave_speed(&c).impact_speed(number(m.0, m.1));
        if let Some((p, q)) = g {
            let g = number(p, q);
            let mu: Rational = Rational::from(m) * 2i64 * l.to_rational() / c.to_rational() * g.to_rational();
            rod = rod.gravity(g).impact_speed(mu);
        }
        rod.top(if fixed { Top::Fixed } else { Top::Free }).build().unwrap()
    })
}

/// A piecewise-linear start above or on the ground.
fn profile() -> impl Strategy<Value = Problem> {
    let points = prop::collection::vec((1i64..12, -4i64..=4), 0..4);
    (uniform(), points.clone(), points, 0i64..4, any::<bool>()).prop_map(|(problem, shape, speeds, lift, jump)| {
        let length = problem.length().to_rational();
        let list = |points: &[(i64, i64)], from: i64, to: i64| {
            let mut inner: Vec<_> = points.to_vec();
            inner.sort();
            inner.dedup_by_key(|(x, _)| *x);
            let x = |k: i64| -> Number { (length.clone() * k / 12i64).to_string().parse().unwrap() };
            let mut list = vec![(x(0), Number::from(from))];
            list.extend(inner.iter().map(|(k, y)| (x(*k), number(*y, 3))));
            list.push((x(12), Number::from(to)));
            list
        };
        // On the ground it is the strain that is linear.
        let (displacement, strain) = match lift {
            0 => (Vec::new(), list(&shape, -1, 1)),
            _ => (list(&shape, lift, 1), Vec::new()),
        };
        // A fixed top stands still.
        let top_speed = if problem.top() == Top::Fixed { 0 } else { -2 };
        let mut velocity = list(&speeds, -1, top_speed);
        if jump && velocity.len() > 2 {
            let (x, _) = velocity[1].clone();
            velocity.insert(2, (x, Number::from(2)));
        }
        problem.to_builder().start(Start::Profile(Profile { displacement, strain, velocity })).build().unwrap()
    })
}

/// The history to `trips` round trips, or as far as fractions reach.
fn solve(mut problem: Problem, trips: i64) -> (Problem, Exact) {
    let round_trip = Parameters::<Rational>::of(&problem, &()).unwrap().round_trip();
    problem = problem.with_run(Run::Time(Rational::from(round_trip * trips).to_string().parse().unwrap())).unwrap();
    let history = Exact::solve(&problem, &()).unwrap();
    (problem, history)
}

/// Times spread over the history: ordinary ones and those of the events.
fn times(history: &Exact, count: i64) -> Vec<Rational> {
    let end = history.end();
    let mut times: Vec<_> = (0..=count).map(|k| end.clone() * k / count).collect();
    times.extend(history.events().iter().map(|event| event.t.clone()));
    times
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    /// Corollary 1, (3.47)–(3.53), (3.66)–(3.72), 4.1, (4.72), Remark 2: the paper's formulas and the lattice share no
    /// code.
    #[test]
    fn the_first_contact_is_the_paper_s(mut problem in uniform()) {
        problem = problem.to_builder().top(Top::Free).run(Run::Impacts(1)).build().unwrap();
        let history = Exact::solve(&problem, &()).unwrap();
        let rod = Parameters::<Rational>::of(&problem, &()).unwrap();
        let paper = paper::UndampedContact::new(&rod).unwrap();
        let bounce = paper.bounce_time();
        prop_assert_eq!(history.contacts()[0].release.as_ref(), Some(&bounce));
        for time in times(&history, 12) {
            let (h, rate) = history.centre(&time).unwrap();
            prop_assert_eq!((h, rate.clone()), paper.centre(&time), "t = {}", time);
            prop_assert_eq!(rate * &rod.length, paper.momentum(&time));
            let energy = history.energy(&time).unwrap();
            prop_assert_eq!(energy.total, paper.total_energy());
            prop_assert_eq!(energy.translational, paper.translational_energy(&time), "t = {}", time);
            for side in [Side::Left, Side::Right] {
                // Before the start and from the next impact on the paper does not speak.
                if (time > 0 || side == Side::Right) && (time < history.end() || side == Side::Left) {
                    prop_assert_eq!(history.strain(&time, side).unwrap(), paper.strain(&time, side), "t = {}", time);
                }
            }
        }
        let contact = &history.contacts()[0];
        prop_assert_eq!(history.energy(&bounce).unwrap().vibrational, paper.vibrational_energy_at_bounce());
        let e = restitution(&history, contact.times()).unwrap();
        prop_assert_eq!(e.e_p.unwrap(), paper.momentum_restitution());
        prop_assert_eq!(e.e_e2.unwrap(), paper.energy_restitution_squared().unwrap());
        // The impulse turns the momentum round and carries the weight meanwhile.
        let weight = rod.gravity.clone() * &rod.length * &bounce;
        prop_assert_eq!(&contact.impulse, &(paper.momentum(&bounce) - paper.momentum(&Rational::new()) + weight));
        let flight = flights(&history).unwrap().remove(0);
        if let Some(highest) = flight.top_time.zip(flight.top) {
            prop_assert_eq!(Some(highest), paper.highest());
        }
    }

    /// Energy is one and the same fraction at all times, for every start and both tops.
    #[test]
    fn energy_is_constant(problem in prop_oneof![uniform(), profile()]) {
        let (_, history) = solve(problem, 8);
        let start = history.energy(&Rational::new()).unwrap().total;
        for time in times(&history, 7) {
            let energy = history.energy(&time).unwrap();
            prop_assert_eq!(&energy.total, &start, "t = {}", time);
            prop_assert!(energy.vibrational >= 0);
        }
    }

    /// (1.3)–(1.6): the end never goes below the ground, is only ever pushed, and never both in the air and pushed; the
    /// top is free of stress or does not move.
    #[test]
    fn boundary_conditions(problem in prop_oneof![uniform(), profile()]) {
        let (problem, history) = solve(problem, 8);
        let length = problem.length().to_rational();
        let top = history.field(&length, &Rational::new(), Side::Right).unwrap().displacement;
        for time in times(&history, 19) {
            for side in [Side::Left, Side::Right] {
                // Before the start there are the data, which need not obey the contact law.
                if time == 0 && side == Side::Left {
                    continue;
                }
                let (v, rate) = history.ground_end(&time, side).unwrap();
                let stress = history.strain(&time, side).unwrap();
                prop_assert!(v >= 0, "v = {} at {}", v, time);
                prop_assert!(stress <= 0, "v_x = {} at {}", stress, time);
                prop_assert_eq!(Rational::from(&v * &stress), 0);
                let at_top = history.field(&length, &time, side).unwrap();
                let ground = history.field(&Rational::new(), &time, side).unwrap();
                prop_assert_eq!((&ground.displacement, &ground.velocity, &ground.strain), (&v, &rate, &stress));
                match problem.top() {
                    Top::Free => prop_assert_eq!(at_top.strain, 0),
                    Top::Fixed => prop_assert_eq!(at_top.displacement, top.clone()),
                }
            }
        }
    }

    /// Momentum: between two times the centre gains the impulse of the ground less the weight.
    #[test]
    fn momentum_balance(mut problem in prop_oneof![uniform(), profile()]) {
        problem = problem.to_builder().top(Top::Free).build().unwrap();
        let (problem, history) = solve(problem, 8);
        let rod = Parameters::<Rational>::of(&problem, &()).unwrap();
        for contact in history.contacts() {
            let to = contact.release.clone().unwrap_or_else(|| history.end());
            let gained = history.centre(&to).unwrap().1 - history.centre(&contact.impact).unwrap().1;
            let weight = Rational::from(&to - &contact.impact) * &rod.gravity;
            prop_assert_eq!(contact.impulse.clone() / &rod.length, gained + weight);
            prop_assert!(contact.peak_strain <= 0);
        }
    }

    /// Proposition 2: across every ray the field jumps by exactly what the ray carries, both jumps together where two
    /// rays cross, and it is continuous elsewhere.
    #[test]
    fn jumps_are_carried_by_rays(problem in prop_oneof![uniform(), profile()], place in 0i64..=12) {
        let (problem, history) = solve(problem, 6);
        let rod = Parameters::<Rational>::of(&problem, &()).unwrap();
        let x = rod.length.clone() * place / 12i64;
        let end = history.end();
        let rays: Vec<_> = (0..6).flat_map(|trip| history.rays(trip).unwrap()).collect();
        let mut instants = Vec::new();
        for ray in &rays {
            instants.push(ray.from.clone() + Rational::from(&x / &rod.wave_speed));
            instants.push(ray.to.clone() - Rational::from(&x / &rod.wave_speed));
        }
        instants.extend((1..8).map(|k| end.clone() * k / 8i64));
        // Within the first round trip the rays that the start sent are not in the list.
        for time in instants.iter().filter(|time| **time > rod.round_trip() && **time < end) {
            let mut carried = [Rational::new(), Rational::new()];
            let mut here = |at: &Rational, jump: &[Rational; 2]| {
                if at == time {
                    carried[0] += &jump[0];
                    carried[1] += &jump[1];
                }
            };
            for ray in &rays {
                here(&(ray.from.clone() + Rational::from(&x / &rod.wave_speed)), &ray.up);
                here(&(ray.to.clone() - Rational::from(&x / &rod.wave_speed)), &ray.down);
            }
            let [before, after] = [Side::Left, Side::Right].map(|side| history.field(&x, time, side).unwrap());
            prop_assert_eq!(after.strain - before.strain, carried[0].clone(), "v_x at {}", time);
            prop_assert_eq!(after.velocity - before.velocity, carried[1].clone(), "v_t at {}", time);
            prop_assert_eq!(after.displacement, before.displacement);
        }
    }

    /// A ray of a uniform start that meets no event leaves the ground as the reflection of what arrived.
    #[test]
    fn reflections_are_diagonal(problem in uniform()) {
        let (_, history) = solve(problem, 6);
        for trip in 0..5 {
            for ray in history.rays(trip).unwrap() {
                let next = history.rays(trip + 1).unwrap().into_iter().find(|next| next.from == ray.to);
                let (Some(next), false) = (next, history.events().iter().any(|event| event.t == ray.to)) else {
                    continue;
                };
                let held = history.ground_end(&ray.to, Side::Right).unwrap().0 == 0 &&
                    history.ground_end(&ray.to, Side::Right).unwrap().1 == 0;
                prop_assert_eq!(reflection(held) * ray.down_vector(), next.up_vector());
            }
        }
    }

    /// `h` and `h′` are the means of `v` and `v_t`, integrated between the rays by Simpson's rule, which is exact
    /// there.
    #[test]
    fn the_centre_is_the_mean_of_the_field(problem in prop_oneof![uniform(), profile()], part in 1i64..24) {
        let (problem, history) = solve(problem, 6);
        let rod = Parameters::<Rational>::of(&problem, &()).unwrap();
        let time = Rational::from(history.end() * part / 24);
        let mut cuts = vec![Rational::new(), rod.length.clone()];
        // Rays of the start come from before it, a round trip earlier for each period.
        for trip in 0..6 {
            for ray in history.rays(trip).unwrap() {
                for shift in -1..=1 {
                    let from = ray.from.clone() + Rational::from(rod.round_trip() * shift);
                    cuts.push(Rational::from(&time - &from) * &rod.wave_speed);
                    cuts.push((from + rod.round_trip() - &time) * &rod.wave_speed);
                }
            }
        }
        if let Start::Profile(profile) = problem.start() {
            for (point, _) in profile.displacement.iter().chain(&profile.strain).chain(&profile.velocity) {
                for sign in [-1i64, 1] {
                    let way: Rational = rod.wave_speed.clone() * &time * sign + point.to_rational();
                    cuts.extend([way.clone(), -way.clone(), rod.length.clone() * 2 - way]);
                }
            }
        }
        cuts.retain(|x| *x >= 0 && *x <= rod.length);
        cuts.sort();
        cuts.dedup();
        let (mut mean, mut rate) = (Rational::new(), Rational::new());
        for pair in cuts.windows(2) {
            let width = Rational::from(&pair[1] - &pair[0]);
            let [a, b, c] = [1, 2, 3].map(|k| {
                let point = pair[0].clone() + width.clone() * k / 4;
                history.field(&point, &time, Side::Right).unwrap()
            });
            // Milne's open rule: exact for cubics, and it never asks on a ray.
            mean += (a.displacement * 2 - b.displacement + c.displacement * 2) * width.clone() / 3;
            rate += (a.velocity * 2 - b.velocity + c.velocity * 2) * width / 3;
        }
        prop_assert_eq!(history.centre(&time).unwrap(), (mean / &rod.length, rate / &rod.length));
    }

    /// Double precision keeps the order of events and its own error bounds wherever fractions know the truth.
    #[test]
    fn doubles_stay_within_their_bounds(problem in prop_oneof![uniform(), profile()]) {
        let (problem, exact) = solve(problem, 8);
        let mut problem = problem;
        if let Ending::ExactnessEnds { .. } = exact.ending() {
            problem = problem.with_run(Run::Time(exact.end().to_string().parse().unwrap())).unwrap();
        }
        let rounded = undamped::<f64>(&problem, &()).unwrap();
        let rod = Parameters::<Rational>::of(&problem, &()).unwrap();
        // Fractions may end so shortly before an event that doubles place it before their end.
        let mut events = rounded.events().to_vec();
        let is_cut_off = matches!(exact.ending(), Ending::ExactnessEnds { .. });
        let is_late = |event: &dalembert::Event<f64>| event.t + event.t_error >= exact.end().to_f64();
        if is_cut_off && events.len() == exact.events().len() + 1 && events.last().is_some_and(is_late) {
            events.pop();
        }
        let kinds = events.iter().map(|e| e.kind).collect::<Vec<_>>();
        prop_assert_eq!(kinds, exact.events().iter().map(|e| e.kind).collect::<Vec<_>>());
        for (ours, truth) in events.iter().zip(exact.events()) {
            let error = (Rational::from_f64(ours.t).unwrap() - &truth.t).abs().to_f64();
            let bound = ours.t_error.max(4.0 * f64::EPSILON * ours.t);
            prop_assert!(error <= bound, "{} > {}", error, ours.t_error);
        }
        let bound = 32.0 * rounded.error_estimate();
        let scales = rounded.scales();
        for time in times(&exact, 9).iter().filter(|time| **time < exact.end()) {
            let x = rod.length.clone() * 5i64 / 7i64;
            let truth = exact.field(&x, time, Side::Right).unwrap();
            let ours = rounded.field(&Scalar::to_f64(&x), &Scalar::to_f64(time), Side::Right).unwrap();
            let error = (ours.displacement - truth.displacement.to_f64()).abs();
            prop_assert!(error <= bound * scales.velocity * scales.time, "v at {}: {:e}", time, error);
        }
    }

    /// More digits only ever add to the same history.
    #[test]
    fn precisions_agree(problem in uniform()) {
        let round_trip = Parameters::<Rational>::of(&problem, &()).unwrap().round_trip();
        let mut problem = problem;
        problem = problem.with_run(Run::Time(Rational::from(round_trip * 9).to_string().parse().unwrap())).unwrap();
        let low = undamped::<Float>(&problem, &256).unwrap();
        let high = undamped::<Float>(&problem, &512).unwrap();
        prop_assert_eq!(low.events().len(), high.events().len());
        for (a, b) in low.events().iter().zip(high.events()) {
            prop_assert_eq!(a.kind, b.kind);
            let error = Scalar::to_f64(&(Float::with_val(512, &b.t) - &a.t)).abs();
            prop_assert!(error <= a.t_error.max(1e-70), "{:e} > {:e}", error, a.t_error);
        }
    }
}

/// Complementarity (1.4)–(1.6) at 10 000 random times, exactly, on the histories that stay rational for ever: μ a whole
/// multiple of gL/c.
#[test]
fn complementarity_at_ten_thousand_times() {
    let mut checked = 0;
    for k in 2..=6 {
        let problem = crate::common::uniform("1", "1", "1", &k.to_string(), Run::Time(400.into()));
        let history = Exact::solve(&problem, &()).unwrap();
        assert_eq!(history.ending(), &Ending::Time);
        let mut random = crate::common::Random(12345 + k);
        for _ in 0..2000 {
            let time = Rational::from(((random.between(0.0, 1.0) * 2f64.powi(40)) as u64, 1u64 << 40)) * 400;
            let (v, _) = history.ground_end(&time, Side::Right).unwrap();
            let stress = history.strain(&time, Side::Right).unwrap();
            assert!(v >= 0 && stress <= 0 && Rational::from(&v * &stress) == 0, "μ = {k}, t = {time}");
            checked += 1;
        }
    }
    assert_eq!(checked, 10_000);
}

/// Doyen, Ern & Piperno's family: with μ = k gL/c, k ≥ 2, the second contact undoes the vibration of the first, and the
/// period is 4(k + 1)L/c.
#[test]
fn every_second_contact_undoes_the_vibration() {
    for k in 2..=9i64 {
        let problem = crate::common::uniform("10", "30", "10", &number(10 * k, 3).to_string(), Run::Impacts(8));
        let history = Exact::solve(&problem, &()).unwrap();
        let impacts: Vec<_> = history.events().iter().filter(|event| event.kind == EventKind::Impact).collect();
        let period = Rational::from((4 * (k + 1), 3));
        for pair in impacts.windows(3) {
            assert_eq!(Rational::from(&pair[2].t - &pair[0].t), period, "k = {k}");
        }
        // μ₀ = 20/3: E_z = μ₀² L/6 after odd contacts, 0 after even ones.
        for (n, contact) in history.contacts().iter().enumerate() {
            let vibrational = history.energy(contact.release.as_ref().unwrap()).unwrap().vibrational;
            let expected = if n % 2 == 0 { Rational::from((2000, 27)) } else { Rational::new() };
            assert_eq!(vibrational, expected, "k = {k}, contact {n}");
        }
    }
}

/// A long flight is not marched trip by trip: M = 5·10⁷ takes a handful of pieces, and every answer inside is still
/// exact.
#[test]
fn long_flights_are_leapt() {
    let problem = crate::common::uniform("1", "1", "1", "100000000", Run::Impacts(2));
    let history = Exact::solve(&problem, &()).unwrap();
    assert!(history.ground().trace.count() < 40, "{}", history.ground().trace.count());
    let rod = Parameters::<Rational>::of(&problem, &()).unwrap();
    let paper = paper::UndampedContact::new(&rod).unwrap();
    // μ is a whole multiple of gL/c: the second contact undoes the vibration, and the third begins as the first.
    assert_eq!(history.end(), 4 * (100_000_000 + 1));
    for k in 0..200i64 {
        let time = Rational::from((200_000_001 * k, 200)) + 1;
        assert_eq!(history.centre(&time).unwrap(), paper.centre(&time), "t = {time}");
        assert_eq!(history.energy(&time).unwrap().total, paper.total_energy());
        let (v, _) = history.ground_end(&time, Side::Right).unwrap();
        let field = history.field(&Rational::new(), &time, Side::Right).unwrap();
        assert!(v >= 0 && field.displacement == v);
    }
    let rounded = undamped::<f64>(&problem, &()).unwrap();
    for (ours, truth) in rounded.events().iter().zip(history.events()) {
        crate::common::close("time", ours.t, Scalar::to_f64(&truth.t), 1.0, 1e-14);
        crate::common::close("v_t(0,t)", ours.v_end, Scalar::to_f64(&truth.v_end), 1e8, 1e-14);
    }
    assert!(rounded.error_estimate() < 1e-12);
}

/// μ = 1 comes back to its start every 36: a thousand impacts in doubles, most of them at irrational times, and no
/// coincidence is lost or made up. The bound grows with the number of impacts, not by a factor for each.
#[test]
fn a_thousand_impacts_in_doubles() {
    let problem = crate::common::uniform("1", "1", "1", "1", Run::Impacts(1000));
    let history = undamped::<f64>(&problem, &()).unwrap();
    assert_eq!(history.ending(), &Ending::NextImpact);
    assert_eq!(history.events().len(), 2000);
    for (early, late) in history.events().iter().zip(&history.events()[16..]) {
        assert_eq!(early.kind, late.kind);
        crate::common::close("36 later", late.t, early.t + 36.0, 1.0, 1e-13);
        crate::common::close("h", late.h, early.h, 1.0, 1e-13);
    }
    assert!(history.error_estimate() < 1e-10, "{:e}", history.error_estimate());
}
