use super::*;

#[test]
fn both_branches_meet() {
    for z in [-1.0f64, 1.0] {
        let (below, above) = (phi2(&(z * (1.0 - 1e-13))), phi2(&(z * (1.0 + 1e-13))));
        assert!((below - above).abs() < 2e-13, "{z} {below} {above}");
    }
    let (below, above) = (log_rest(&(0.25f64 - 1e-15)), log_rest(&(0.25f64 + 1e-15)));
    assert!((below - above).abs() < 1e-14, "{below} {above}");
    assert_eq!(phi1(&1e-300), 1.0);
    assert_eq!(phi2(&-1e-300), 0.5);
    assert_eq!(log_rest(&1e-300), 0.5);
    assert_eq!(log_mean(&0.0), 1.0);
}

#[test]
fn fractions_of_e() {
    use crate::number::{Float, Scalar};
    let one = Float::with_val(300, 1);
    let e = one.clone().exp();
    let wrong = (phi2(&one) - (e - 2u32)).abs();
    assert!(wrong < 1e-88, "{wrong}");
    let tiny = Float::with_val(300, 1e-40);
    let wrong = phi2(&tiny) - one.ratio(1, 2) - tiny.clone() / 6u32;
    assert!(wrong.to_f64().abs() < 1e-80);
}
