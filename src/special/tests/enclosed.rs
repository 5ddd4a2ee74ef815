use super::*;
use crate::number::IntervalPrecision;
use crate::special::{i0_scaled, i1_scaled};
use rug::Rational;

/// Checks precisions from few bits, where every cut is coarse, to many, against a reference with twice as many.
#[test]
fn sums_in_many_bits_lie_inside() {
    let fraction = |p: i64| Rational::from((p, 1000));
    let holds = |found: &Interval, truth: &Float, bits: u32| {
        let narrow = found.width().hi().to_f64() <= truth.to_f64().abs() * 2f64.powi(18 - bits as i32);
        assert!(found.lo() <= truth && truth <= found.hi(), "{} {truth}", found.text());
        narrow
    };
    for bits in [24u32, 53, 200, 700] {
        for z in [0, 1, 300, 3000, 77_777, 900_000] {
            let (few, many) = (
                Interval::rational(&fraction(z), IntervalPrecision::bits(bits)),
                Float::with_val(2 * bits + 300, fraction(z)),
            );
            assert!(holds(&i0_scaled(&few), &i0_scaled(&many), bits), "{z} {bits}");
            assert!(holds(&i1_scaled(&few), &i1_scaled(&many), bits), "{z} {bits}");
            assert!(holds(&few.in_scaled(5), &many.in_scaled(5), bits), "{z} {bits}");
            for (travel, time) in [(0, 700), (1000, 1000), (1000, 1001), (2300, 5000)] {
                let few = Ray::new(
                    &few,
                    &Interval::rational(&fraction(travel), few.precision()),
                    &Interval::rational(&fraction(time), few.precision()),
                );
                let wide = 2 * bits + 300;
                let many =
                    Ray::new(&many, &Float::with_val(wide, fraction(travel)), &Float::with_val(wide, fraction(time)));
                let weights = |n: i64| [n, n * (n * n - 1)];
                let (few, many) = (few.sums([1, 2], weights), many.sums([1, 2], weights));
                for (few, many) in few.sums.iter().zip(&many.sums).chain([(&few.start, &many.start)]) {
                    assert!(few.lo() <= many && many <= few.hi(), "{z} {bits} {travel} {time} {} {many}", few.text());
                }
            }
        }
    }
}

#[test]
fn moments_are_enclosed() {
    for n in [1usize, 2, 7, 40, 151] {
        let one = Interval::rational(&Rational::from(1), IntervalPrecision::bits(200));
        let rule = one.gauss_legendre(n);
        for power in [0, n - 1 + (n - 1) % 2, 2 * n - 2].into_iter().filter(|power| *power <= 2 * n - 2) {
            let sum =
                rule.iter().fold(one.zero(), |sum, (x, w)| sum + (0..power).fold(w.clone(), |product, _| product * x));
            let exact = Rational::from((2, power as u32 + 1));
            assert!(sum.contains(&exact), "{n} {power} {}", sum.text());
            assert!(sum.radius() < 1e-50, "{n} {power} {}", sum.radius());
        }
    }
}
