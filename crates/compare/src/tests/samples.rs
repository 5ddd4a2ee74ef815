use super::*;

/// Six decimals, six digits, sums of a step, and no more than a quarter of a step.
#[test]
fn rounding_of_written_times() {
    let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-6;
    let rounding = TimeRounding::new(&[0.125_001, 0.5, 12.25], 0.1);
    assert!(near(rounding.at(0.5), 0.5e-6), "{rounding:?}");
    let rounding = TimeRounding::new(&[0.001_234_56, 0.666_667], 0.1);
    assert!(near(rounding.at(0.666_667), 0.5e-6), "{rounding:?}");
    // 0.1 + 0.2 needs all digits of a double.
    let rounding = TimeRounding::new(&[0.1, 0.1 + 0.2], 0.1);
    assert!(rounding.at(0.3) < 1e-15, "{rounding:?}");
    assert_eq!(TimeRounding::new(&[0.0, 1.0, 2.0], 1.0).at(2.0), 0.25);
}
