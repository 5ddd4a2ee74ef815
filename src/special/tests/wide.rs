use super::*;

/// The greatest errors of Bessel functions and of the sums of rays beside those of six limbs, in roundings.
fn beside_more<const N: usize>() -> [f64; 3] {
    let mut greatest = [0.0f64; 3];
    let unit = Wide::<6>::from(1.0).double(Wide::<N>::from(1.0).unit());
    let mut meet = |k: usize, found: &Wide<N>, roundings: f64, sure: &Wide<6>| {
        let off = (((found.resized::<6>() - sure) / sure).magnitude() / unit).to_f64();
        assert!(off <= roundings && roundings < 1.1, "{k} {off} {roundings}");
        greatest[k] = greatest[k].max(off);
    };
    let third = Wide::<N>::from(1.0) / Wide::from(3.0);
    for z in [1e-9, 0.3, 1.0, 7.0, 40.0, 150.0, 300.0, 400.0, 900.0] {
        let z = Wide::from(z) * (third + Wide::from(1.0));
        for n in [0, 1, 2, 5] {
            let (found, roundings) = z.in_scaled_rounded(n);
            if n <= 1 || z.to_f64() <= far(&z) {
                meet(0, &found, roundings, &z.resized::<6>().in_scaled_rounded(n).0);
            }
        }
    }
    let weight = |n: i64| [n % 2, 1 - n % 2, n * n / 4, n, (n * n + 1) / 2];
    for damping in [0.0, 1e-9, 0.1, 2.0, 30.0, 700.0] {
        for (travel, time) in [(0.0, 1.0), (1.0, 1.0), (1.0, 1.5), (3.0, 3.001), (2.0, 90.0), (0.7, 2.3), (1.1, 7.0)] {
            let number = |x: f64| Wide::<N>::from(x) * (third + Wide::from(1.0));
            let ray = Ray::new(&number(damping), &number(travel), &number(time));
            let found = Wide::ray_sums_rounded(&ray, [1, 2, 2, 1, 1], weight);
            let sure = Wide::<6>::ray_sums_rounded(&ray.map(|x| x.resized()), [1, 2, 2, 1, 1], weight).values;
            meet(1, &found.values.start, found.start_roundings, &sure.start);
            let sums = found.values.sums.iter().zip(&sure.sums).filter(|(_, sure)| !sure.is_zero());
            sums.for_each(|(sum, sure)| meet(2, sum, found.sum_roundings, sure));
        }
    }
    greatest
}

/// Within the roundings that are stated, and more than half of them are met.
#[test]
fn roundings_hold_beside_more_limbs() {
    for greatest in [beside_more::<2>(), beside_more::<3>(), beside_more::<4>()] {
        assert!(greatest.iter().all(|most| *most > 0.55), "{greatest:?}");
    }
}

#[test]
fn no_value_is_no_number() {
    let x = Wide::<2>::from(1.0);
    let infinite = x / x.zero();
    for z in [-x, infinite] {
        let (value, roundings) = z.in_scaled_rounded(0);
        assert!(value.to_f64().is_nan() && roundings == f64::INFINITY);
    }
    let ray = Ray::new(&infinite, &x, &x);
    assert_eq!(Wide::ray_start_rounded(&ray).1, f64::INFINITY);
}

#[test]
fn values_are_those_of_long_floats() {
    use crate::number::Float;
    for z in [0.25, 3.0, 190.0, 380.0, 1000.0, 5000.0] {
        for n in [0, 1, 3] {
            let sure = Float::with_val(600, z).in_scaled_rounded(n).0;
            let (value, roundings) = Wide::<4>::from(z).in_scaled_rounded(n);
            let exact = value.to_rational().unwrap();
            let off = ((Float::with_val(600, &exact) - &sure) / &sure).abs().to_f64() / value.unit();
            assert!(off <= roundings, "{z} {n} {off} {roundings}");
        }
    }
    for (damping, travel, time) in [(0.1, 0.0, 2.0), (0.5, 1.0, 1.5), (90.0, 2.0, 3.0), (700.0, 1.0, 4.0)] {
        let long = Ray::new(&Float::with_val(600, damping), &Float::with_val(600, travel), &Float::with_val(600, time));
        let sure = Float::ray_sums_rounded(&long, [1, 2], |n| [n, n * n]).values;
        let ray = Ray::new(&Wide::<4>::from(damping), &Wide::from(travel), &Wide::from(time));
        let found = Wide::ray_sums_rounded(&ray, [1, 2], |n| [n, n * n]);
        let near = |value: &Wide<4>, sure: &Float| {
            let exact = value.to_rational().unwrap();
            let off = ((Float::with_val(600, &exact) - sure) / sure).abs().to_f64() / value.unit();
            assert!(off < 1.1, "{damping} {off}");
        };
        near(&found.values.start, &sure.start);
        found.values.sums.iter().zip(&sure.sums).for_each(|(sum, sure)| near(sum, sure));
    }
}
