use super::*;

/// Checks that an n-point rule integrates x^(2n−2) exactly, and x^(2n) not.
#[test]
fn degree_of_exactness() {
    for n in 1..60usize {
        let rule = gauss_legendre(&1.0f64, n);
        assert_eq!(rule.len(), n);
        assert!(rule.windows(2).all(|pair| pair[0].0 < pair[1].0));
        let moment = |k: usize| rule.iter().map(|(x, w)| w * x.powi(k as i32)).sum::<f64>();
        let exact = |k: usize| 2.0 / (k as f64 + 1.0);
        assert!((moment(2 * n - 2) - exact(2 * n - 2)).abs() < 4e-15, "{n}");
        if n < 20 {
            assert!((moment(2 * n) - exact(2 * n)).abs() > 1e-13, "{n}");
        }
    }
}

#[test]
fn many_digits() {
    let rule = gauss_legendre(&Float::with_val(400, 1), 41);
    let mut sum = Float::new(400);
    for (x, w) in rule {
        sum += w * x.exp();
    }
    let one = Float::with_val(400, 1);
    let wrong: Float = sum - (one.clone().exp() - (-one).exp());
    assert!(wrong.to_f64().abs() < 1e-110, "{wrong}");
}
