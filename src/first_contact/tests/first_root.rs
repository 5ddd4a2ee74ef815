use super::*;

fn search(f: impl Fn(f64) -> f64) -> FirstRoot {
    let n = 40;
    let values: Vec<f64> = (0..=n).map(|j| f((std::f64::consts::PI * f64::from(j) / f64::from(n)).cos())).collect();
    first_root(&coefficients(&values), 1e-13, |x| (f(x).abs() > 1e-15).then_some(f(x) > 0.0))
}

#[test]
fn derivative_of_a_cubic() {
    // T₃ = 4x³ − 3x, T₃′ = 12x² − 3 = 6T₂ + 3.
    assert_eq!(derivative(&[1.0, 0.0, 0.0, 1.0]), vec![3.0, 0.0, 6.0]);
    assert_eq!(derivative(&[2.0]), vec![0.0]);
}

#[test]
fn the_first_of_several() {
    let FirstRoot::Between { lo, hi, .. } = search(|x| (9.0 * (x + 1.0)).cos()) else { panic!() };
    let root = std::f64::consts::PI / 18.0 - 1.0;
    assert!(lo < root && root < hi);
    assert_eq!(search(|x| x.exp()), FirstRoot::None);
    assert!(matches!(search(|x| x * x), FirstRoot::Unclear(_)));
    assert_eq!(search(|x| x * x + 1e-9), FirstRoot::None);
    // Two roots 2·10⁻⁴ apart, the first of them.
    let FirstRoot::Between { lo, hi, .. } = search(|x| (x - 0.3) * (x - 0.3) - 1e-8) else { panic!() };
    assert!(lo < 0.2999 && 0.2999 < hi && hi < 0.3001);
    // A plus at the left end that is far below the error of the sum.
    assert!(matches!(search(|x| 1e-14 - (x + 1.0)), FirstRoot::Between { .. }));
}
