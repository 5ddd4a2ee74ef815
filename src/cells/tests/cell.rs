use super::*;
use crate::cells::series::evaluate;

#[test]
fn a_constant_velocity_decays() {
    // The field z_x = 0, z_t = e^{−2rt} has p = q = e^{−κ·2(ξ+η)}, so P̂ = e^{−κs} on both sides.
    let basis = Basis::new(&1.0f64, 24, 12);
    let (a, h) = (0.3f64, 0.45f64);
    let (mut p, mut q) = (basis.exponential(&-a, 16), basis.exponential(&-h, 16));
    let (p0, q0) = (p.clone(), q.clone());
    let cell =
        Cell { corner: (0.0, 0.0), size: (1.0, 1.0), depth: (a, h), p: (&p0).into(), q: (&q0).into(), offset: 0.0 };
    let (at_p, at_q) = cell.at(&basis, &[(0.5, 0.25)], -60.0)[0];
    let exact = (-2.0 * (0.5 * a + 0.25 * h)).exp();
    assert!((at_p - exact).abs() < 4e-15 && (at_q - exact).abs() < 4e-15);
    cross(&basis, (&mut p, &mut q), (&a, &h), (&(-a).exp(), &(-h).exp()), -60.0);
    for x in [0.0, 0.4, 1.0] {
        let off = [evaluate(&p, &x) - (-2.0 * h - a * x).exp(), evaluate(&q, &x) - (-2.0 * a - h * x).exp()];
        assert!(off.iter().all(|d| d.abs() < 4e-15), "{off:?}");
    }
    let trace = diagonal(&basis, &q0, &h, true, (16, -60.0));
    assert!((evaluate(&trace, &0.7) - (-4.0 * 0.7 * h + 2.0 * 0.7 * h).exp()).abs() < 4e-15);
}
