//! Scenes of all kinds, and the times at which they are asked.

use std::fmt::Write as _;

use crate::common::Random;
use dalembert::{Material, Number, Problem, TypedHistory};

/// A scene of any kind; `None` where what was drawn is outside of the limits.
pub(super) fn any_scene(random: &mut Random) -> Option<Problem> {
    let fraction = |random: &mut Random, most: i64| {
        let (p, q) = (random.between(1.0, most as f64 + 1.0) as i64, random.of(&[1i64, 1, 2, 4, 5]));
        format!("{p}/{q}").parse::<Number>().unwrap()
    };
    let times = |a: &Number, b: &Number| -> Number { (a.to_rational() * b.to_rational()).to_string().parse().unwrap() };
    let over = |a: &Number, b: &Number| -> Number { (a.to_rational() / b.to_rational()).to_string().parse().unwrap() };
    let text = |text: String| text.parse::<Number>().unwrap();
    let special = random.is(0.4);
    let spread = random.of(&[0.3, 0.3, 3.0]);
    let size = |random: &mut Random| {
        if special { fraction(random, 6) } else { text(random.size(-spread, spread)) }
    };
    let mut rod = Problem::builder();
    let length = size(random);
    let wave_speed;
    rod = rod.length(length.clone());
    if random.is(0.2) {
        let steel = random.is(0.5);
        let (modulus, density) = match (steel, special) {
            (true, true) => (text("2.1e11".into()), text("8400".into())),
            (true, false) => (text("210e9".into()), text("7850".into())),
            (false, true) => {
                let (c, density) = (fraction(random, 6), fraction(random, 4));
                (times(&times(&c, &c), &density), density)
            }
            (false, false) => (text(random.size(-3.0, 6.0)), text(random.size(-3.0, 3.0))),
        };
        wave_speed = text(format!("{:.6e}", (modulus.to_f64() / density.to_f64()).sqrt()));
        rod = rod.modulus(modulus).density(density);
        if random.is(0.6) {
            rod = rod.area(text(random.size(-5.0, 1.0)));
        }
    } else {
        wave_speed = size(random);
        rod = rod.wave_speed(wave_speed.clone());
    }
    let trip = times(&over(&length, &wave_speed), &2.into());
    if random.is(0.55) {
        let ratio = text(random.size(-6.0, 1.3));
        let ratio = if random.is(0.5) { text(random.size(-1.5, 0.3)) } else { ratio };
        rod = rod.damping(text(format!("{:.5e}", over(&ratio, &trip).to_f64())));
    }
    let fixed = random.is(0.25);
    if fixed {
        rod = rod.fixed_top();
    }
    // μ = M g t₁.
    let speed = if special { fraction(random, 4) } else { text(random.size(-spread, spread)) };
    let ratio = if special { fraction(random, 8) } else { text(random.size(-1.3, 1.0)) };
    let gravity = times(&over(&speed, &times(&ratio, &trip)), &1.into());
    let gravity = if special { gravity } else { text(format!("{:.5e}", gravity.to_f64())) };
    let heavy = random.is(0.75);
    if heavy {
        rod = rod.gravity(gravity.clone());
    }
    let kind = random.between(0.0, 1.0);
    let parts = |random: &mut Random| match special {
        true => over(&random.of(&[0i64, 1, 1, 2, 3, 4, 6, 8]).into(), &4.into()),
        false => text(format!("{:.4e}", random.between(0.0, 2.0))),
    };
    if kind < 0.3 {
        rod = rod.impact_speed(speed.clone());
    } else if kind < 0.4 {
        // So high that it falls with the speed, or with a root.
        rod = rod.drop_height(over(&times(&speed, &speed), &times(&2.into(), &gravity)));
    } else if kind < 0.6 {
        // The gap of a fall that takes so many trips.
        let time = times(&trip, &parts(random));
        let fall = times(&times(&time, &time), &over(&gravity, &2.into()));
        let slow = heavy && random.is(0.3);
        let way = if slow { 0.into() } else { times(&speed, &time) };
        let fall: Number = if heavy { fall } else { 0.into() };
        let gap: Number = (way.to_rational() + fall.to_rational()).to_string().parse().unwrap();
        let gap = if special { gap } else { text(format!("{:.5e}", gap.to_f64())) };
        rod = rod.gap(gap).impact_speed(if slow { 0.into() } else { speed.clone() });
    } else {
        let places = |random: &mut Random, jumps: bool| {
            let count = random.between(0.0, 4.0) as usize;
            let mut list: Vec<i64> = (0..count).map(|_| random.between(1.0, 12.0) as i64).collect();
            list.sort_unstable();
            list.dedup();
            let mut all = vec![0];
            for k in list {
                all.push(k);
                if jumps && random.is(0.5) {
                    all.push(k);
                }
            }
            all.push(12);
            all.into_iter().map(|k| times(&length, &over(&k.into(), &12.into()))).collect::<Vec<_>>()
        };
        let signed = |random: &mut Random, unit: &Number, low: f64, high: f64| {
            let part = random.between(low, high);
            let part = if special { (part * 4.0).round() / 4.0 } else { part };
            times(unit, &text(format!("{part:.3e}")))
        };
        let way = times(&speed, &trip);
        if random.is(0.8) {
            let mut list = Vec::new();
            for x in places(random, false) {
                let ground = list.is_empty();
                let value = match (ground, random.is(0.5)) {
                    (true, true) => 0.into(),
                    (true, false) => signed(random, &way, 0.0, 1.0),
                    _ => signed(random, &way, -0.4, 0.4),
                };
                list.push((x, value));
            }
            rod = rod.displacement(list);
        }
        let velocity: Vec<_> =
            places(random, true).into_iter().map(|x| (x, signed(random, &speed, -2.0, 1.0))).collect();
        rod = rod.velocity(velocity);
    }
    rod = if random.is(0.5) {
        rod.impacts(random.of(&[1i64, 1, 2, 2, 3, 4]))
    } else {
        let trips = if random.is(0.5) { random.between(0.3, 3.0) } else { random.between(1.0, 8.0) };
        if special {
            rod.time(times(&trip, &over(&((trips * 4.0).ceil() as i64).into(), &4.into())))
        } else {
            rod.time(text(format!("{:.4e}", trips * trip.to_f64())))
        }
    };
    rod.build().ok()
}

/// The times at which a run is asked, in order: the start, any, and that of a ray. `asked_times` asks at those that are
/// printed for events.
pub(super) fn times(problem: &Problem, history: &TypedHistory<f64>, random: &mut Random) -> Vec<Number> {
    let end = *history.end();
    let mut times: Vec<Number> = (0..3).map(|_| random.between(0.0, end)).map(typed).collect();
    if let Material::WaveSpeed(c) = problem.material() {
        let half = problem.length().to_rational() / c.to_rational();
        let count = (end / half.to_f64()).min(1e6) as i64;
        let k = random.between(0.0, count as f64 + 1.0) as i64;
        times.push((half * k).to_string().parse().unwrap());
    }
    // What is rounded up may be beyond the end.
    times.retain(|time| time.to_f64() < end * (1.0 - 1e-5));
    times.push(0.into());
    times.sort_by_key(Number::to_rational);
    times.dedup_by(|a, b| a.to_rational() == b.to_rational());
    times
}

pub(super) fn typed(x: f64) -> Number {
    format!("{x:.5e}").parse().unwrap()
}

/// A scene as it could be typed.
pub(super) fn spelled(problem: &Problem) -> String {
    let mut text = String::new();
    writeln!(text, "{problem:#?}").unwrap();
    text
}
