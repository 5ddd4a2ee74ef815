use super::*;

fn series(basis: &Basis<f64>, f: impl Fn(f64) -> f64) -> Vec<f64> {
    let values: Vec<f64> = basis.nodes().iter().map(|x| f(*x)).collect();
    basis.through(&values, 24)
}

#[test]
fn the_first_of_several_roots_is_found() {
    let basis = Basis::new(&1.0f64, 24, 1);
    let c = series(&basis, |x| (0.2 - x) * (0.25 - x) * (0.9 - x));
    let root = first_descent(&basis, &c, 1e-15).unwrap().0;
    assert!((root - 0.2).abs() < 1e-13, "{root}");
    let touch = series(&basis, |x| (x - 0.3) * (x - 0.3));
    assert_eq!(first_descent(&basis, &touch, 1e-14), None);
    let rises = series(&basis, |x| x * (0.5 - x));
    let root = first_descent(&basis, &rises, 1e-14).unwrap().0;
    assert!((root - 0.5).abs() < 1e-14, "{root}");
    let dip = series(&basis, |x| (x - 0.3) * (x - 0.3) - 1e-10);
    let root = first_descent(&basis, &dip, 1e-14).unwrap().0;
    assert!((root - 0.29999).abs() < 1e-9, "{root}");
    assert!((smallest(&basis, &dip, 0.0).unwrap() + 1e-10).abs() < 1e-15);
    // Two valleys, the second one deeper by 1e-9; and a hill, whose least value is at an end.
    let valleys = series(&basis, |x| (x - 0.2) * (x - 0.2) * (x - 0.7) * (x - 0.7) - 1e-9 * x);
    assert!((smallest(&basis, &valleys, 0.0).unwrap() + 0.7e-9).abs() < 1e-15);
    let hill = series(&basis, |x| 1.0 - (x - 0.4) * (x - 0.4));
    assert!((smallest(&basis, &hill, 0.0).unwrap() - 0.64).abs() < 1e-14);
}

/// Noise above the roundings of the sum: only the tolerance ends the search.
#[test]
fn a_plateau_with_noise_has_a_least_value() {
    let basis = Basis::new(&1.0f64, 24, 1);
    let mut plateau = vec![-0.4];
    plateau.extend((1..24).map(|k| f64::from(k * k % 7 - 3) * 1e-14));
    let least = smallest(&basis, &plateau, 1e-12).unwrap();
    assert!((least + 0.4).abs() < 2e-12, "{least}");
}
