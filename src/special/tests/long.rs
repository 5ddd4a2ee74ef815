use super::*;
use crate::special::bessel::expansion;

/// Computes `e^{−z} Σ_m (z/2)^{2m+n}/(m!(m+n)!)` term by term: once a term is less than half of the previous one, the
/// rest is below the last term.
fn series(z: &Float, n: i64) -> Float {
    let half = z.clone() / 2u32;
    let square = half.clone().square();
    let mut term = (1..=n).fold(Float::with_val(z.prec(), 1), |term, k| term * &half / k);
    let mut sum = term.clone();
    for m in 1i64.. {
        term = term * &square / (m * (m + n));
        sum += &term;
        if Float::with_val(64, &square * 2u32) < m * (m + n) && term <= sum.clone() >> (z.prec() + 2) {
            break;
        }
    }
    sum * (-z.clone()).exp()
}

#[test]
fn both_expansions_agree() {
    for digits in [64u32, 300, 2000] {
        for n in [0, 1] {
            let z = Float::with_val(digits, digits + 70);
            let (near, far) = (series(&z, n), expansion(&z, n));
            let wrong: Float = (near - &far) / far;
            assert!(wrong.is_zero() || wrong.get_exp().unwrap() < 14 - digits as i32, "{digits} {n} {wrong}");
        }
    }
}

fn off(value: &Float, exact: &Float, p: u32) -> f64 {
    let wrong = Float::with_val(64, value - exact) / exact;
    (wrong.abs() << p).to_f64()
}

/// Compares the fast method and its bound with the series and the expansion, term by term, in twice the precision.
#[test]
fn the_fast_way_keeps_its_bound() {
    for p in [64u32, 65, 200, 1000, 4096] {
        for z in [1e-300, 1e-20, 0.1, 0.7, 1.0, 1.99, 3.0, 10.0, 33.3, 120.0, 400.0, 1000.0, 1e5] {
            for z in [Float::with_val(p, z), Float::with_val(p, z) * Float::with_val(p, 2).sqrt()] {
                for n in [0, 1, 2, 7, 40] {
                    if n > 1 && z > 2000 || p > 3000 && z > 200 && n > 1 {
                        continue;
                    }
                    let long = Float::with_val(2 * p + 64, &z);
                    let far = n <= 1 && z > 2 * p + 128;
                    let exact = if far { expansion(&long, n) } else { series(&long, n) };
                    let (value, bound) = finished(in_scaled(&longer(&z), n as u32), p);
                    let wrong = off(&value, &exact, p);
                    assert!(wrong <= bound && bound < 1.1, "{p} {z} {n} {wrong} {bound}");
                }
            }
        }
    }
}

/// Compares with the ratios in twice the precision, for the same numbers, which are exact there.
#[test]
fn the_recurrence_without_divisions_keeps_its_bound() {
    let weight = |n: i64| {
        let (even, odd) = ((n + 1) % 2, n % 2);
        let cube = n * (n * n - 1);
        let b = if n % 2 == 0 { n * (n * n - 4) / 24 } else { cube / 24 };
        [odd, even, n * n / 4, n, b, (n * n + 1) / 2]
    };
    let first = [1, 2, 2, 1, 3, 1];
    for p in [64u32, 200, 1000, 2100] {
        for damping in [1e-300, 1e-9, 0.3, 3.0, 20.0, 60.0, 5e3] {
            for (travel, time) in [(0.0, 1.0), (0.5, 0.501), (0.5, 0.5 + 1e-9), (1.0, 1.9), (3.0, 7.3)] {
                if p > 1000 && damping > 100.0 {
                    continue;
                }
                let third = Float::with_val(p, 3).recip() >> 40;
                let number = |x: f64| Float::with_val(p, x) * (Float::with_val(p, 1) + &third);
                let ray = Ray::new(&number(damping), &number(travel), &number(time));
                let exact = ray.map(|x| Float::with_val(2 * p, x));
                let found = Float::ray_sums_rounded(&ray, first, weight);
                let sure = exact.sums_by_ratios(first, weight, Float::ray_start_rounded(&exact));
                let case = format!("{p} {damping} {travel} {time}");
                let start = off(&found.values.start, &sure.values.start, p);
                assert!(start <= found.start_roundings && found.start_roundings < 1.1, "{case}: {start}");
                for (value, exact) in found.values.sums.iter().zip(&sure.values.sums) {
                    let wrong = off(value, exact, p);
                    assert!(wrong <= found.sum_roundings, "{case}: {wrong} {}", found.sum_roundings);
                }
            }
        }
    }
}
