use super::*;

#[test]
fn a_break_elsewhere_moves_a_value_by_its_jumps() {
    // [rate] = 3 over 5 roundoffs; [bend] δ²/2 is far below a roundoff.
    let mut value = Estimate::new(1.0f64, 2.0);
    let [zero, one, four] = [0.0, 1.0, 4.0].map(Estimate::exact);
    value.cross_break(&Estimate::new(0.5, 5.0), [&one, &zero], [&four, &one]);
    assert!((value.error() - 17.0).abs() < 1e-9);
    // A break that may be 2⁻²⁰ away: [bend] δ²/2 alone is 2⁻⁴¹, 2¹² roundoffs.
    let mut value = Estimate::exact(1.0f64);
    value.cross_break(&Estimate::new(0.5, 2f64.powi(33)), [&zero, &zero], [&zero, &one]);
    assert!((value.error() - 2f64.powi(12)).abs() < 1e-9 * value.error());
}

#[test]
fn a_root_next_to_zero() {
    let (touch, half_digits) = (Estimate::new(0.0f64, 8.0), 2f64.powi(53).sqrt());
    let deviation = |rate: f64, bend: f64| {
        let found = touch.root_deviation(&Estimate::exact(rate), &Estimate::exact(bend)).unwrap();
        found.error()
    };
    // 2e/|rate| = 16/2, and √(2e/|bend|) = √(16/4) in units of √u.
    assert_eq!(deviation(-2.0, 4.0), 8.0);
    assert!((deviation(0.0, 4.0) / half_digits - 2.0).abs() < 1e-9);
    assert!(Estimate::exact(0.0f64).root_deviation(&touch, &touch).is_none());
}

#[test]
fn one_number_for_two() {
    let (a, b) = (Estimate::new(1.0f64, 2.0), Estimate::new(1.0 + 2.0 * f64::EPSILON, 3.0));
    // b is 4 roundoffs away, with 3 more in its bound.
    assert!(a.same(&b) && a.clone().joined(&b).error() >= 7.0);
    assert_eq!(a.taken_for_zero().error(), 2.0 + 2f64.powi(53));
}
