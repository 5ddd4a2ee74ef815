use super::*;

#[test]
fn absolute_values_bound_what_signs_give() {
    let basis = super::super::series::Basis::new(&1.0f64, 12, 4);
    let mut c: Vec<f64> = (0..12).map(|k| (-1.3f64).powi(-k)).collect();
    let mut most = sizes(&c);
    let dropped = c[11] / 48.0;
    basis.integrate(&mut c);
    assert!(2.0 * dropped.abs() <= integrate(&mut most));
    assert!(c.iter().zip(&most).all(|(c, most)| c.abs() <= most * (1.0 + 1e-15)));
    super::super::series::times_x(&mut c);
    times_x(&mut most);
    assert!(c.iter().zip(&most).all(|(c, most)| c.abs() <= most * (1.0 + 1e-15)));
}
