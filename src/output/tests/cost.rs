use super::duration;

#[test]
fn times_have_three_digits() {
    assert_eq!([3.2149e-3, 0.0].map(duration), ["3.21 ms", "0 s"]);
}
