use super::*;

/// Thinning keeps a spike and the first point.
#[test]
fn extremes_are_kept() {
    let line = |count: i32, value: &dyn Fn(i32) -> f64| {
        thinned((0..count).map(|k| DVec2::new(f64::from(k), value(k))).collect())
    };
    let points = line(10_000, &|k| if k == 4321 { 5.0 } else { 0.0 });
    assert!(points.len() <= 2 * PLACES && points.contains(&DVec2::new(4321.0, 5.0)) && points[0].x == 0.0);
    assert_eq!(line(3, &|k| f64::from(k)).len(), 3);
}
