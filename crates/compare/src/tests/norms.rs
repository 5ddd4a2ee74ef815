use super::*;

/// A straight line against zero: the sums by hand.
#[test]
fn by_hand() {
    let grid = Grid::new(vec![0.0, 1.0, 3.0], None);
    let norms = Norms::new(&grid, &[2.0, 2.0, 2.0], &[2.0, 3.0, -1.0], 1.0, 1, |k| k < 2);
    // Weights ½, 3/2, 1; differences 0, 1, 3; ‖ours‖₁ = 6, ‖ours‖₂² = 12.
    assert_eq!((norms.l1.absolute, norms.l1.relative), (4.5, Some(0.75)));
    assert_eq!((norms.l2.absolute, norms.l2.relative), (10.5f64.sqrt(), Some(10.5f64.sqrt() / 12f64.sqrt())));
    assert_eq!((norms.linf.absolute, norms.linf.t, norms.on_jumps), (3.0, Some(3.0), 1));
    assert_eq!(norms.linf_off_jumps.map(|most| (most.absolute, most.t)), Some((1.0, Some(1.0))));
}

/// Values whose squares no double holds have the norms of the same values of an ordinary size.
#[test]
fn of_any_size() {
    let grid = Grid::new(vec![0.0, 1.0, 3.0], None);
    let of = |unit: f64| {
        let [ours, theirs] = [[2.0, 2.0, 2.0], [2.0, 3.0, -1.0]].map(|list| list.map(|x| x * unit));
        Norms::new(&grid, &ours, &theirs, unit, 1, |k| k < 2)
    };
    for unit in [2f64.powi(1020), 2f64.powi(-1020)] {
        let (found, plain) = (of(unit), of(1.0));
        for (found, plain) in [(found.l1, plain.l1), (found.l2, plain.l2)] {
            assert_eq!((found.absolute, found.relative), (plain.absolute * unit, plain.relative));
        }
        assert_eq!(found.linf, Norm { absolute: 3.0 * unit, ..plain.linf });
    }
}

/// Against nothing there is no relative norm.
#[test]
fn against_zero() {
    let grid = Grid::new(vec![1.0], None);
    for rounding in [0.0, 1e-13] {
        let norms = Norms::new(&grid, &[rounding], &[2.0], 1.0, 0, |_| false);
        assert_eq!((norms.l1.absolute, norms.l1.relative, norms.linf_off_jumps), (2.0 - rounding, None, None));
    }
}

/// Half the distance to each neighbour, in both directions of a field.
#[test]
fn weights_by_hand() {
    assert_eq!(Grid::new(vec![0.0, 1.0, 4.0], None).weights, [0.5, 2.0, 1.5]);
    let field = Grid::new(vec![0.0, 0.0, 1.0, 1.0], Some(vec![0.0, 3.0, 0.0, 3.0]));
    assert_eq!(field.weights, [0.75; 4]);
}

/// A quarter of the error on half the width is order 2; the same width has none.
#[test]
fn order_by_hand() {
    let run = |width, error| MeshError { width, error };
    assert_eq!(convergence_order(run(0.2, 0.04), run(0.1, 0.01)), Some(2.0));
    assert_eq!(convergence_order(run(0.1, 0.04), run(0.1, 0.01)), None);
}
