use std::collections::VecDeque;

use super::*;
use crate::cells::series::evaluate;

/// Builds a separated state with jumps, after a few strips of contact.
fn vibration(damping: f64, gravity: f64) -> (Medium<f64>, State<f64>, Flight<f64>) {
    let medium = Medium::new(&damping, (gravity, -gravity / 2.0), true, -53.0, 1);
    let mut segments = VecDeque::new();
    let cuts = [0.0, 0.21, 0.37, 0.8, 1.0];
    for (k, pair) in cuts.windows(2).enumerate() {
        let values: Vec<f64> =
            medium.basis.nodes().iter().map(|x| (k as f64 - 0.7) * (1.0 - x) + 0.3 * x * x).collect();
        segments.push_back(medium.segment(pair[0], pair[1] - pair[0], &values));
    }
    let mut state = State { round: 0, segments };
    for _ in 0..6 {
        medium.strip(&mut state, true, &mut |_| {});
    }
    let flight = medium.take_off(&mut state, &0.0);
    (medium, state, flight)
}

#[test]
fn a_leap_is_a_march() {
    for (damping, trips) in [(1e-9, 5), (0.01, 9), (0.4, 7), (1.0, 5), (2.0, 4)] {
        let (medium, mut state, _) = vibration(damping, 0.3);
        let mut leapt = state.clone();
        let ground = medium.ground_of(&state);
        medium.leap(&mut leapt, &ground, trips);
        while state.round < leapt.round || state.segments[0].at != leapt.segments[0].at {
            medium.strip(&mut state, false, &mut |_| {});
        }
        assert_eq!(state.segments.len(), leapt.segments.len());
        for (a, b) in state.segments.iter().zip(&leapt.segments) {
            for x in [0.0, 0.3, 1.0] {
                let off = evaluate(&a.q, &x) - evaluate(&b.q, &x);
                assert!(off.abs() < 2e-14, "{damping}: {off:e} of {}", evaluate(&a.q, &x));
            }
        }
    }
}

#[test]
fn the_end_is_where_the_trace_brings_it() {
    for damping in [1e-9, 0.3, 2.0] {
        let (medium, mut state, flight) = vibration(damping, 0.3);
        let mut height = medium.ground_of(&state);
        assert!((height + flight.height).abs() < 1e-15);
        for _ in 0..9 {
            let mut trace = medium.trace(&state, false);
            medium.basis.integrate(&mut trace);
            height += crate::cells::series::at_one(&trace, &0.0) * state.segments[0].len;
            medium.strip(&mut state, false, &mut |_| {});
            assert!((height - medium.ground_of(&state)).abs() < 1e-14);
        }
        // Free fall is the whole motion.
        let (rise, rate) = medium.rigid(&flight.at(&0.7), &0.25);
        let (h, dh) = flight.at(&(0.7 + 0.25 * 0.6));
        assert!((evaluate(&rise, &0.6) - h).abs() < 1e-14 && (evaluate(&rate, &0.6) - dh).abs() < 1e-14);
    }
}
