use super::*;

#[test]
fn the_hull_covers_both_and_little_more() {
    let at = |value: f64, bound: f64| Estimate::new(value, bound / value.unit());
    for (a, b, low, high) in [
        (at(0.0, 0.0), at(-0.63, 0.0), -0.63, 0.0),
        (at(1.0, 0.25), at(2.0, 0.5), 0.75, 2.5),
        (at(1.0, 2.0), at(1.5, 0.5), -1.0, 3.0),
        (at(1.5, 0.5), at(1.0, 2.0), -1.0, 3.0),
    ] {
        let all = hull(a, &b);
        let (least, most) = (all.value() - all.bound(), all.value() + all.bound());
        assert!(least <= low && most >= high, "{least} {most}");
        assert!(least > low - 1e-14 && most < high + 1e-14, "{least} {most}");
    }
    assert_eq!(hull(at(1.0, 0.0), &at(0.0, f64::INFINITY)).bound(), f64::INFINITY);
}
