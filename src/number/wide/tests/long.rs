use rug::Float;

use super::*;
use crate::number::{Analytic, Scalar};

fn numbers<const N: usize>() -> Vec<Wide<N>> {
    let root = Wide::<N>::from(2).sqrt();
    let mut list = vec![Wide::ZERO, Wide::ONE, -Wide::ONE, root, -root, Wide::from(-7), Wide::from(0.1)];
    list.extend([1, -1, 63, 64, 65, 1000, -1000, 1 << 20, -(1 << 20)].map(|by| root.scaled(by)));
    list.push(Wide::ONE - Wide::power(-64 * N as i32));
    list
}

fn there_and_back<const N: usize>() {
    for x in numbers::<N>() {
        let float = to_float(&x);
        assert_eq!(float.prec(), 64 * N as u32);
        assert_eq!(from_float::<N>(&float), x, "{float}");
        if let Some(fraction) = x.to_rational().filter(|_| x.exponent.unsigned_abs() < 2000) {
            assert_eq!(float.to_rational().unwrap(), fraction);
        }
        // Fewer bits fit, more are rounded within the bound.
        let fewer = Float::with_val(64 * N as u32 - 13, &float);
        assert_eq!(to_float(&from_float::<N>(&fewer)), fewer);
        let more: Estimate<Float> = Estimate::new(Float::with_val(64 * N as u32 + 40, 1) / 3 * &float, 1e6);
        let given: Estimate<Wide<N>> = more.give(&());
        let off = to_float(given.value()) - more.value();
        assert!(off.to_f64().abs() + more.bound() <= given.bound() * (1.0 + 1e-12));
    }
    for special in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        let there = to_float(&Wide::<N>::from(special));
        for found in [there.to_f64(), Scalar::to_f64(&from_float::<N>(&there))] {
            assert!(found == special || found.is_nan() && special.is_nan(), "{found} for {special}");
        }
    }
}

#[test]
fn floats_of_as_many_bits_are_the_same_numbers() {
    there_and_back::<2>();
    there_and_back::<3>();
    there_and_back::<4>();
    there_and_back::<6>();
}
