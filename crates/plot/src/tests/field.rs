use super::*;

/// The polygons cover the rectangle without overlaps.
#[test]
fn cells_cover_the_rectangle() {
    let rod = Parameters { length: 2.0, wave_speed: 3.0, damping: 0.0, gravity: 0.0, speed: 1.0 };
    let extent = Extent { rod, span: [0.3, 5.1], is_soft: false, has_waves: true };
    let rays: Vec<Ray> = (-3..40)
        .map(|k| Ray { departure: 0.17 * f64::from(k * k) - 1.0, jump: true, share: 1.0, legs: [true; 2] })
        .collect();
    for width in [None, Some(0.2)] {
        let [rising, falling] = [0.0, extent.trip()].map(|delay| extent.characteristics(&rays, delay, width));
        let polygons = extent.polygons(&rising, &falling).unwrap();
        let whole: f64 = polygons.iter().map(|polygon| clip::area(polygon).abs()).sum();
        assert!((whole - 4.8 * 2.0).abs() < 1e-9, "{whole}");
    }
}

#[test]
fn colours_end_at_round_numbers() {
    assert_eq!([0.0, 5.15, 0.5, 2.74, 1.21, 9.06].map(round_above), [0.0, 6.0, 0.5, 3.0, 1.5, 10.0]);
}

#[test]
fn slopes_are_those_of_linear_functions() {
    let value = |point: DVec2| 3.0 - 2.0 * point.x + 0.5 * point.y;
    let at = samples(&[DVec2::ZERO, DVec2::new(2.0, 1.0), DVec2::new(3.0, 5.0), DVec2::new(0.0, 4.0)]);
    let found = slope([at[1] - at[0], at[2] - at[0]], [1, 2].map(|k| value(at[k]) - value(at[0])));
    assert!((found - DVec2::new(-2.0, 0.5)).length() < 1e-12);
}
