use super::*;

/// A line through 0, 1 and 3 at 0, 1 and 2: by hand 3/2 t − 1/6, Σ r² = 1/6, and the errors from (JᵀJ)⁻¹.
#[test]
fn a_line_by_hand() {
    let data = [0.0, 1.0, 3.0];
    let residuals = |v: &[f64]| Some((0..3).map(|t| v[0] * t as f64 + v[1] - data[t]).collect::<Vec<f64>>());
    let linear = |_: &[f64], _: &[f64]| Some(vec![vec![0.0, 1.0, 2.0], vec![1.0; 3]]);
    let found = least_squares(&[7.0, -3.0], &[1.0, 1.0], 1, 20, residuals, linear).unwrap();
    assert!((found.values[0] - 1.5).abs() < 1e-12 && (found.values[1] + 1.0 / 6.0).abs() < 1e-12);
    assert!(found.settled);
    // JᵀJ = [[5, 3], [3, 3]], its inverse [[1/2, −1/2], [−1/2, 5/6]], one degree of freedom.
    assert!((found.errors[0] - (1.0 / 12.0f64).sqrt()).abs() < 1e-12, "{found:?}");
    assert!((found.errors[1] - (5.0 / 36.0f64).sqrt()).abs() < 1e-12, "{found:?}");
}

/// The mean of forty samples, of which each two are the same one of twenty independent ±1: 1/√19, and not 1/√39.
#[test]
fn neighbours_that_are_off_alike_count_once() {
    let data: Vec<f64> = (0..40).map(|k| if k / 2 % 2 == 0 { 1.0 } else { -1.0 }).collect();
    let residuals = |v: &[f64]| Some(data.iter().map(|data| v[0] - data).collect::<Vec<f64>>());
    let found = least_squares(&[3.0], &[1.0], 1, 20, residuals, |_, _| Some(vec![vec![1.0; 40]])).unwrap();
    assert!((found.errors[0] - (1.0 / 19.0f64).sqrt()).abs() < 1e-12, "{found:?}");
}
