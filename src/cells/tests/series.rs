use super::*;

#[test]
fn the_integral_of_a_series_is_that_of_its_function() {
    let basis = Basis::new(&1.0, 20, 4);
    let mut c = basis.exponential(&0.75, 20);
    basis.integrate(&mut c);
    for x in [0.0, 0.3, 1.0] {
        let exact = (0.75f64 * x).exp_m1() / 0.75;
        assert!((evaluate(&c, &x) - exact).abs() < 1e-15, "{x}");
    }
    assert_eq!(evaluate(&basis.powers[3], &0.5), 0.125);
    let d = derivative(&basis.powers[3]);
    assert!((evaluate(&d, &0.5) - 0.75).abs() < 1e-15);
}

#[test]
fn gauss_legendre_is_exact_to_its_degree() {
    let rule = crate::special::gauss_legendre(&1.0f64, 6);
    let integral: f64 = rule.iter().map(|(x, w)| w / 2.0 * f64::midpoint(1.0, *x).powi(11)).sum();
    assert!((integral - 1.0 / 12.0).abs() < 1e-16);
}

#[test]
fn the_number_of_terms_is_enough() {
    for theta in [1e-3, 0.1, 1.0, 2.0] {
        for log2_accuracy in [-10.0, -30.0, -50.0] {
            let basis = Basis::new(&1.0f64, 40, 1);
            let c = basis.exponential(&theta, 40);
            let n = terms_for(1.0, 0.0, theta, log2_accuracy);
            assert!(bound(&c, n) <= log2_accuracy.exp2() + 4e-14, "{theta} {log2_accuracy} {n}");
        }
    }
}
