use super::*;
use crate::motion::{Pair, Side};
use crate::number::Scalar;
use crate::solve::question::{Question, unobserved};

/// A rod that bounces three times, damped or not.
fn rod(damping: Option<&str>) -> Problem {
    let problem = Problem::uniform(1.into(), 1.into(), 1.into(), 3.into());
    problem.to_builder().damping(damping.unwrap_or("0")).impacts(3).build().unwrap()
}

fn meets(a: &Estimate<Float>, b: &Estimate<Float>) {
    let off = (a.value().clone() - b.value()).to_f64().abs();
    assert!(off <= a.bound() + b.bound(), "{a:?} {b:?}");
    assert!(a.bound() <= 8.0 * b.bound() + 1e-60, "{a:?} {b:?}");
}

/// A motion in numbers on the stack answers in long numbers as one in MPFR's does.
#[test]
fn both_kinds_of_long_numbers_answer_alike() {
    for damping in [None, Some("1/10")] {
        let problem = rod(damping);
        let plan = Plan::of(&problem, &Question::run(Numbers::Digits(20))).unwrap();
        let ours = Float::run(&problem, &plan, Rung::Bits(256), &unobserved()).unwrap();
        let other = estimates::<Float>(&problem, &plan, (256, &256), &unobserved()).unwrap();
        assert_eq!(ours.ending(), other.ending());
        assert_eq!(ours.events().len(), other.events().len());
        meets(&ours.end(), &other.end());
        for (a, b) in ours.events().iter().zip(other.events()) {
            assert_eq!(a.t.value().prec(), 256);
            a.numbers().into_iter().zip(b.numbers()).for_each(|(a, b)| meets(a, b));
            // Each is asked about its own time of the event.
            for side in [Side::Left, Side::Right] {
                meets(&ours.strain(&a.t, side).unwrap(), &other.strain(&b.t, side).unwrap());
            }
        }
        let like = ours.end();
        let (point, time) = (like.ratio(1, 3), like.ratio(5, 3));
        let [a, b] = [&ours, &other].map(|motion| motion.field(&point, &time, Side::Left).unwrap());
        a.numbers().into_iter().zip(b.numbers()).for_each(|(a, b)| meets(a, b));
        for pair in [Pair::GroundEnd, Pair::Centre, Pair::Energy, Pair::EnergyParts] {
            let [a, b] = [&ours, &other].map(|motion| motion.pair(pair, &time, Side::Left).unwrap());
            a.iter().zip(&b).for_each(|(a, b)| meets(a, b));
        }
        let points = [like.zero(), like.ratio(1, 2), like.one()];
        let [a, b] = [&ours, &other].map(|motion| motion.moments(&time, &points).unwrap());
        a.iter().flatten().flatten().zip(b.iter().flatten().flatten()).for_each(|(a, b)| meets(a, b));
    }
}

/// The first longer numbers of a plan fill a number on the stack.
#[test]
fn plans_take_whole_sizes() {
    let problem = rod(Some("1/10"));
    for (digits, bits) in [(1, 128), (15, 256), (30, 256), (50, 256), (80, 384)] {
        let plan = Plan::of(&problem, &Question::run(Numbers::Digits(digits))).unwrap();
        assert_eq!(plan.rung, Rung::Bits(bits), "{digits}");
    }
}
