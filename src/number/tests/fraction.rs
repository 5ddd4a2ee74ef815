use super::*;

#[test]
fn surds_are_printed_in_lowest_terms() {
    let fraction = |(p, q): (i32, i32)| rational::quotient(p.into(), q.into());
    let text = |a, plus, b| fraction(a).surd(plus, &fraction(b));
    assert_eq!(text((3, 1), true, (2, 1)), "3 + √2");
    assert_eq!(text((5, 2), false, (12, 1)), "5/2 − 2√3");
    assert_eq!(text((0, 1), true, (1, 2)), "√2/2");
    assert_eq!(text((1, 1), true, (8, 9)), "1 + 2√2/3");
}
