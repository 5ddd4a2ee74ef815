//! Fractions in pure Rust, with the functions of `rational_gmp`.

use std::cmp::Ordering;

pub(crate) use dashu_int::IBig as Integer;
use dashu_int::ops::{BitTest, Gcd, SquareRootRem};
use dashu_int::{Sign, UBig};
pub use dashu_ratio::RBig as Rational;

pub(super) fn quotient(p: Integer, q: Integer) -> Rational {
    Rational::from_parts_signed(p, q)
}

pub(super) fn parts(x: &Rational) -> (Integer, Integer) {
    (x.numerator().clone(), x.denominator().clone().into())
}

pub(super) fn nearest_double(x: &Rational) -> f64 {
    x.to_f64().value()
}

pub(super) fn floor(x: &Rational) -> Option<i64> {
    x.floor().try_into().ok()
}

pub(super) fn sign(x: &Rational) -> Ordering {
    match x.sign() {
        _ if x.is_zero() => Ordering::Equal,
        Sign::Positive => Ordering::Greater,
        Sign::Negative => Ordering::Less,
    }
}

pub(super) fn half(x: Rational) -> Rational {
    x / Rational::from(2)
}

pub(super) fn size(x: &Rational) -> u32 {
    (x.numerator().bit_len() + x.denominator().bit_len()) as u32
}

pub(crate) fn bits(n: &Integer) -> u32 {
    n.bit_len() as u32
}

pub(super) fn gcd(a: Integer, b: &Integer) -> Integer {
    a.gcd(b).into()
}

pub(super) fn exact_root(n: &Integer) -> Option<Integer> {
    let (root, rest) = UBig::try_from(n.clone()).ok()?.sqrt_rem();
    rest.is_zero().then(|| root.into())
}

pub(super) fn limbs(n: &Integer) -> Vec<u64> {
    let bytes = n.clone().into_parts().1.to_le_bytes();
    let limb = |bytes: &[u8]| bytes.iter().rev().fold(0, |limb, byte| limb << 8 | u64::from(*byte));
    bytes.chunks(8).map(limb).collect()
}

pub(super) fn from_limbs(limbs: &[u64]) -> Integer {
    let bytes: Vec<u8> = limbs.iter().flat_map(|limb| limb.to_le_bytes()).collect();
    UBig::from_le_bytes(&bytes).into()
}
