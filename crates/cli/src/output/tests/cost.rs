use super::*;

#[test]
fn times_have_three_digits() {
    assert_eq!([3.2149e-3, 0.0].map(duration), ["3.21 ms", "0 s"]);
}

#[test]
fn labels() {
    for digits in [0.0, 3.0, 18.0, 50.0, 1000.0] {
        assert!((digits_at(place_of(digits, 3.0), 3.0) - digits).abs() < 1e-9, "{digits}");
    }
    // Equal factors of digits are equally far apart between two ticks.
    let middle = (100.0f64 * 300.0).sqrt();
    assert!((place_of(middle, 3.0) - place_of(100.0, 3.0) + 0.5).abs() < 1e-12);
}
