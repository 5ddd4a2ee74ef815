use super::*;

/// Compares sums of arguments with a relative error of 10⁻⁶ with the sums of the exact arguments.
#[test]
fn errors_of_the_arguments_are_covered() {
    let weight = |n: i64| [n % 2, n, n * n * n];
    let u = f64::EPSILON / 2.0;
    for damping in [0.0, 1e-9, 0.3, 2.9, 40.0, 3e3] {
        for (travel, time) in [(0.0, 1.0), (1.0, 1.0 + 1e-7), (0.5, 0.7), (3.0, 7.3)] {
            for turn in 0..27 {
                let off = |k: i32| f64::from(turn / 3i32.pow(k as u32) % 3 - 1) * 1e-6;
                let (xi, eta, r) = (time - travel, time + travel, damping);
                let known = |x: f64, off: f64| Estimate::new(x * (1.0 + off), x * (1.0 + 1e-6) * 1e-6 / u);
                let ray = Ray { xi: known(xi, off(0)), eta: known(eta, off(1)), damping: known(r, off(2)) };
                let sure = Ray { xi, eta, damping: r };
                let (found, sure) = (ray.sums([1, 2, 1], weight), sure.sums([1, 2, 1], weight));
                let pairs = found.sums.iter().zip(&sure.sums).chain([(&found.start, &sure.start)]);
                for (found, sure) in pairs {
                    let wrong = (found.value() - sure).abs();
                    assert!(wrong <= found.bound(), "{damping} {travel} {time}: {found:?} {sure}");
                    assert!(found.bound() <= 0.1 * (1.0 + sure), "{damping} {travel} {time}: {found:?}");
                }
                for n in 0..4 {
                    let found = known(damping, off(2)).in_scaled(n);
                    assert!((found.value() - damping.in_scaled(n)).abs() <= found.bound(), "{damping} {n}");
                }
            }
        }
    }
}

#[test]
fn nodes_are_within_their_bounds() {
    let long = |x: &f64| crate::number::Float::with_val(160, x);
    for n in [1usize, 2, 5, 24, 60, 200] {
        let rule = Estimate::exact(1.0f64).gauss_legendre(n);
        for ((x, w), (node, weight)) in rule.iter().zip(gauss_legendre(&long(&1.0), n)) {
            assert!((node - long(x.value())).abs() <= x.bound(), "{n} {x:?}");
            assert!((weight - long(w.value())).abs() <= w.bound(), "{n} {w:?}");
        }
    }
}
