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

#[test]
fn a_panel_says_that_it_is_cut_off() {
    let axis = || Axis::new("x", "", [0.0, 1.0]);
    let drawn = |points: Vec<DVec2>| {
        let mut panel = Panel::new("", axis(), axis());
        panel.lines("curve", vec![points], Stroke::new("#000000", 0.2));
        crate::draw::Sheet { title: Vec::new(), panels: vec![panel] }.svg(crate::draw::Size::Page)
    };
    let says = |points: Vec<DVec2>| drawn(points).contains("cut off at the frame");
    let from = DVec2::new(0.0, 0.5);
    assert!(says(vec![from, DVec2::new(0.5, 1.2)]) && says(vec![from, DVec2::new(1.0, -0.1)]));
    // A line that leaves at the side is a part of a longer one.
    assert!(!says(vec![from, DVec2::new(0.5, 1.0)]) && !says(vec![from, DVec2::new(2.0, 3.0)]));
}
