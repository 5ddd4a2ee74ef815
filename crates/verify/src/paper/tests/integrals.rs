use super::*;

#[test]
fn the_integral_is_the_function_of_the_first_kind() {
    for k in 0..120 {
        let z = 0.5 * f64::from(k);
        let found = [i0(z), z * i1_over_z(z)].map(|value| value * (-z).exp());
        let truth = [dalembert::special::i0_scaled(&z), dalembert::special::i1_scaled(&z)];
        assert!(found.iter().zip(truth).all(|(a, b)| (a - b).abs() < 4e-15), "{z} {found:?} {truth:?}");
    }
}
