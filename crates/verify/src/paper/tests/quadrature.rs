use super::*;

/// The Kronrod rule is exact up to degree 22, the Gauss rule in it up to 13.
#[test]
fn rules() {
    for k in 0..=22 {
        let Piece { value, error, .. } = Piece::new(-1.0, 1.0, &|x: f64| x.powi(k));
        let exact = if k % 2 == 0 { 2.0 / f64::from(k + 1) } else { 0.0 };
        assert!((value - exact).abs() < 1e-15, "{k} {value}");
        assert!(k > 13 || error < 1e-15, "{k} {error:e}");
    }
}
