use super::*;

/// Evaluates (2.16) by the trapezoidal rule, which converges geometrically for a periodic integrand.
fn by_integral(z: f64, n: i32) -> f64 {
    let points = 400 + 4 * z.sqrt() as i32;
    let sum: f64 = (0..points)
        .map(|k| {
            let angle = 2.0 * std::f64::consts::PI * f64::from(k) / f64::from(points);
            (-2.0 * z * (angle / 2.0).sin().powi(2)).exp() * (f64::from(n) * angle).cos()
        })
        .sum();
    sum / f64::from(points)
}

#[test]
fn against_the_integral() {
    for z in [0.0, 1e-8, 0.3, 1.0, 1.8, 7.0, 50.0, 700.0, 1e4] {
        assert!((i0_scaled(&z) - by_integral(z, 0)).abs() < 1e-15 + 1e-13 * by_integral(z, 0), "{z}");
        for n in [1, 2, 3, 8, 20] {
            let wrong = (z.in_scaled(n) - by_integral(z, n as i32)).abs();
            assert!(wrong < 4e-16 + 1e-13 * by_integral(z, n as i32), "{z} {n} {wrong}");
        }
    }
}

#[test]
fn doubles_and_many_digits_agree() {
    for z in [1e-300, 1e-5, 0.7, 1.3, 1.999, 2.0, 3.0, 20.0, 223.9, 224.1, 800.0, 1e4, 1e12] {
        let many = crate::number::Float::with_val(160, z);
        let accuracy = if z <= 2.0 { 9e-16 } else { 3e-16 };
        assert!((i0_scaled(&many).to_f64() / i0_scaled(&z) - 1.0).abs() < accuracy);
        assert!((i1_scaled(&many).to_f64() / i1_scaled(&z) - 1.0).abs() < accuracy);
        for n in if z < 1e5 { vec![2, 5, 30] } else { vec![] } {
            let (double, exact) = (z.in_scaled(n), many.in_scaled(n).to_f64());
            assert!((double - exact).abs() <= 1e-13 * exact, "{z} {n} {double} {exact}");
        }
    }
}
