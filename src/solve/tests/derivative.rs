//! Rows of events whose place another event takes.

use super::{Derivative, NoDerivative, of_same_events};

#[test]
fn a_row_has_derivatives_where_its_time_has_one() {
    let (one, jumps) = (|x: i64| Some(Derivative::One(x)), Err(NoDerivative::Jumps));
    let time = Some(Derivative::Sides { left: jumps, right: Ok(1) });
    let late = Some(Derivative::Sides { left: Err(NoDerivative::Infinite), right: Ok(1) });
    let found =
        of_same_events(vec![vec![time.clone(), one(2), None], vec![late.clone(), one(3)], vec![one(4), one(5)]]);
    let expected = vec![
        vec![time, Some(Derivative::Sides { left: jumps, right: Ok(2) }), None],
        // The time of the same event may have an infinite derivative.
        vec![late, one(3)],
        vec![one(4), one(5)],
    ];
    assert_eq!(found, expected);
}
