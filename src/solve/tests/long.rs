use super::*;
use crate::solve::question::Question;

/// The first longer numbers of a plan fill a number on the stack.
#[test]
fn plans_take_whole_sizes() {
    let problem = Problem::uniform(1.into(), 1.into(), 1.into(), 3.into());
    let problem = problem.to_builder().damping("1/10").impacts(3).build().unwrap();
    for (digits, bits) in [(1, 128), (15, 256), (30, 256), (50, 256), (80, 384)] {
        let plan = Plan::of(&problem, &Question::run(crate::solve::Numbers::Digits(digits))).unwrap();
        assert_eq!(plan.rung, Rung::Bits(bits), "{digits}");
    }
}
