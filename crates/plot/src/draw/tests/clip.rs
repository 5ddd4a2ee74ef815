use super::*;

const SQUARE: [DVec2; 2] = [DVec2::ZERO, DVec2::ONE];

fn points(list: &[[f64; 2]]) -> Vec<DVec2> {
    list.iter().map(|[x, y]| DVec2::new(*x, *y)).collect()
}

#[test]
fn lines_are_cut_at_the_border() {
    // The line enters, leaves over the top, enters again, and follows the border.
    let zigzag = points(&[[-0.25, 0.5], [0.25, 0.5], [0.5, 1.5], [0.75, 0.5], [0.75, 0.0], [1.0, 0.0]]);
    let cut = [
        points(&[[0.0, 0.5], [0.25, 0.5], [0.375, 1.0]]),
        points(&[[0.625, 1.0], [0.75, 0.5], [0.75, 0.0], [1.0, 0.0]]),
    ];
    assert_eq!(line(&zigzag, SQUARE), cut);
    assert!(line(&points(&[[-1.0, 0.5], [0.5, 2.0]]), SQUARE).is_empty());
    // A line that touches a corner has no part inside.
    assert!(line(&points(&[[-1.0, 1.0], [1.0, -1.0]]), SQUARE).is_empty());
}

#[test]
fn polygons_are_cut_and_grown() {
    let diamond = points(&[[0.5, -0.5], [1.5, 0.5], [0.5, 1.5], [-0.5, 0.5]]);
    assert_eq!(area(&polygon(diamond.clone(), SQUARE)), 1.0);
    let square = points(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    for turned in [square.clone(), square.into_iter().rev().collect()] {
        assert!((area(&grown(&turned, 0.5)).abs() - 4.0).abs() < 1e-12);
    }
    // The sides of the diamond, √2 long, move out by 1/2 on both sides.
    assert!((area(&grown(&diamond, 0.5)) - (2f64.sqrt() + 1.0).powi(2)).abs() < 1e-12);
}
