//! Proof tests: the bounds for initial data known within an error hold for initial data displaced by that error.
//! Rounding errors are far smaller, so that these tests check the propagation of errors.

use rug::Float;

use super::*;
use crate::cells::effort::{Effort, Task};
use crate::cells::history::Damped;
use crate::cells::start::medium;
use crate::motion::{Motion, Pair, Side, unobserved};
use crate::number::{Estimate, Number, Scalar};
use crate::problem::{Problem, Profile, Run, Start};

const BITS: u32 = 160;

/// Solves a run whose account begins with these sups and masses.
fn proved(problem: &Problem, (roundoff, masses): (f64, f64)) -> Damped<Float> {
    let effort = Effort { until_lost: false, ..Effort::of(40.0) };
    let (medium, data) = medium::<Float>(problem, &BITS, effort.digits, 1).unwrap();
    let mut proof = Proof::new(&medium);
    let unit = data.units.velocity.to_f64();
    (proof.roundoff, proof.masses) = (roundoff / unit, masses / unit);
    let task = Task { problem, precision: &BITS, effort, observe: &unobserved };
    let found = Follower::new(&medium, &data, Some(proof)).run(&task).unwrap();
    Damped::record_of(&task, (medium, data), found).unwrap()
}

/// Greatest ratio of error and bound, and the number of comparisons.
#[derive(Default)]
struct Held {
    most: f64,
    count: usize,
}

impl Held {
    fn compare(&mut self, what: &str, found: &Estimate<Float>, truth: &Estimate<Float>) {
        let off = (found.value().clone() - truth.value()).to_f64().abs();
        let part = if off == 0.0 { 0.0 } else { off / found.bound() };
        assert!(part <= 1.0, "{what}: off by {off:e}, bound {:e}", found.bound());
        self.most = self.most.max(part);
        self.count += 1;
    }

    fn all(&mut self, name: &str, known: &Damped<Float>, truth: &Damped<Float>) {
        assert!(known.events().len() <= truth.events().len(), "{name}");
        for (k, (a, b)) in known.events().iter().zip(truth.events()).enumerate() {
            assert_eq!(a.kind, b.kind, "{name}");
            self.compare(&format!("{name}: time {k}"), &a.t, &b.t);
            self.compare(&format!("{name}: velocity {k}"), &a.v_end, &b.v_end);
            self.compare(&format!("{name}: centre {k}"), &a.h, &b.h);
            self.compare(&format!("{name}: rate {k}"), &a.h_rate, &b.h_rate);
        }
        let contacts = known.course().contacts.iter().zip(&truth.course().contacts);
        for (a, b) in contacts.filter(|(a, b)| a.release.is_some() && b.release.is_some()) {
            self.compare(&format!("{name}: impulse"), &a.impulse, &b.impulse);
            self.compare(&format!("{name}: peak"), &a.peak_strain, &b.peak_strain);
        }
        let times: Vec<f64> = known.events().iter().map(|event| event.t.to_f64()).collect();
        for pair in times.windows(2) {
            let time = Estimate::exact(Float::with_val(BITS, pair[0] + 0.37 * (pair[1] - pair[0])));
            for (a, b) in [Pair::GroundEnd, Pair::Centre, Pair::Energy, Pair::EnergyParts].map(|pair| {
                (known.pair(pair, &time, Side::Left).unwrap(), truth.pair(pair, &time, Side::Left).unwrap())
            }) {
                a.iter().zip(&b).for_each(|(a, b)| self.compare(&format!("{name}: at {time:?}"), a, b));
            }
            for x in [0.21, 0.83] {
                let point = Estimate::exact(Float::with_val(BITS, x));
                let [a, b] = [known, truth].map(|motion| motion.field(&point, &time, Side::Left).unwrap());
                self.compare(&format!("{name}: v"), &a.displacement, &b.displacement);
                self.compare(&format!("{name}: v_t"), &a.velocity, &b.velocity);
                self.compare(&format!("{name}: v_x"), &a.strain, &b.strain);
            }
        }
    }
}

fn number(text: &str) -> Number {
    text.parse().unwrap()
}

fn rod(damping: &str, impacts: u32) -> Problem {
    let mut rod = Problem::uniform(1.into(), 1.into(), 1.into(), 1.into());
    rod = rod.to_builder().damping(number(damping)).run(Run::Impacts(impacts)).build().unwrap();
    rod
}

#[test]
fn a_start_with_another_velocity_is_within_what_is_proved() {
    let mut held = Held::default();
    for damping in ["0.001", "0.02", "0.1", "0.4"] {
        for speed in ["0.3", "3", "10", "100"] {
            let start = |speed: Number| {
                let velocity = vec![(0.into(), speed.clone()), (1.into(), speed)];
                let profile = Profile { velocity, ..Profile::default() };
                rod(damping, 4).to_builder().start(Start::Profile(profile)).build().unwrap()
            };
            // Initial speed greater by 1e-30.
            let faster = number(&(-number(speed).to_rational() - number("1e-30").to_rational()).to_string());
            let known = proved(&start(number(&format!("-{speed}"))), (1e-30, 0.0));
            let truth = proved(&start(faster), (0.0, 0.0));
            held.all(&format!("r = {damping}, μ = {speed}"), &known, &truth);
        }
    }
    assert!(held.count >= 1500 && held.most > 0.1, "{} {}", held.count, held.most);
}

#[test]
fn a_start_with_another_kink_is_within_what_is_proved() {
    let mut held = Held::default();
    for (damping, bend) in [("0.001", "0.2"), ("0.05", "-0.3"), ("0.2", "0.5"), ("0.5", "-0.4")] {
        for speed in ["0.6", "2", "7"] {
            let start = |kink: &str| {
                let kink = number(kink);
                // v_x = bend up to the kink, and zero beyond it.
                let height = number(&(number(bend).to_rational() * kink.to_rational()).to_string());
                let displacement = [(Number::from(0), Number::from(0)), (kink, height.clone()), (1.into(), height)];
                let velocity = [0, 1].map(|x: i64| (Number::from(x), number(&format!("-{speed}")))).to_vec();
                rod(damping, 3).to_builder().displacement(displacement).velocity(velocity).build().unwrap()
            };
            // The jump of v_x is moved by 1e-30 of 2L: in q, and in p.
            let mass = 1e-30 * number(bend).to_f64().abs();
            let known = proved(&start("0.4"), (0.0, mass));
            let truth = proved(&start(&format!("0.4{}1", "0".repeat(28))), (0.0, 0.0));
            held.all(&format!("r = {damping}, μ = {speed}, bend {bend}"), &known, &truth);
        }
    }
    assert!(held.count >= 800 && held.most > 0.1, "{} {}", held.count, held.most);
}
