use super::*;

#[test]
fn zero_is_white_and_gradients_bend_at_the_colours() {
    assert_eq!([-1.0, 0.0, 2.0].map(diverging), ["#053061", "#f7f7f7", "#67001f"]);
    let stops = diverging_stops(-0.3, 0.1);
    assert_eq!(stops.len(), 4); // the ends, −0.2 and 0
    assert!((stops[2].0 - 0.75).abs() < 1e-12 && stops[2].1 == "#f7f7f7");
}
