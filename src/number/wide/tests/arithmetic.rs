//! Sums, products, quotients, roots and conversions beside exact ones.

use std::cmp::Ordering;

use super::Wide;
use super::float::{MOST, TOP};
use crate::number::rational::{self, Integer};
use crate::number::{Rational, Rounded, Scalar};

/// Numbers that are made to be awkward: limbs of zeros, ones and single bits, exponents that meet, neighbours.
pub(super) struct Awkward(pub(super) u64);

impl Awkward {
    pub(super) fn word(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    pub(super) fn below(&mut self, n: u64) -> u64 {
        (self.word() >> 16) % n
    }

    fn limb(&mut self) -> u64 {
        match self.below(8) {
            0 => 0,
            1 => u64::MAX,
            2 => 1 << self.below(64),
            3 => u64::MAX << self.below(64),
            _ => self.word(),
        }
    }

    pub(super) fn number<const N: usize>(&mut self, exponents: u64) -> Wide<N> {
        let mut limbs = std::array::from_fn(|_| self.limb());
        limbs[N - 1] |= TOP;
        Wide { limbs, exponent: self.below(exponents) as i32, negative: self.below(2) == 1 }
    }

    /// Two numbers; every fourth time the second is a few units of the last place from the first.
    fn pair<const N: usize>(&mut self, exponents: u64) -> [Wide<N>; 2] {
        let a = self.number::<N>(exponents);
        let mut b = self.number::<N>(exponents);
        match self.below(4) {
            0 => {
                b = a;
                b.limbs[0] ^= self.below(4);
                b.negative = self.below(2) == 1;
            }
            1 => b.exponent = a.exponent + self.below(3) as i32,
            _ => {}
        }
        [a, b]
    }
}

/// A whole multiple of the last place, and so many halves of it off the exact value.
fn halves<const N: usize>(found: &Wide<N>, exact: &Rational) -> f64 {
    if found.is_zero() {
        assert!(rational::sign(exact).is_eq());
        return 0.0;
    }
    let unit = Wide::<N>::power(found.exponent - 64 * N as i32).to_rational().unwrap();
    let off = (found.to_rational().unwrap() - exact) / unit * Rational::from(2);
    let inwards = rational::sign(&off).is_gt() != found.negative;
    // Below a power of two, units are half as great.
    let power = found.magnitude() == Wide::power(found.exponent - 1);
    let size = Scalar::magnitude(&off) * Rational::from(if power && inwards { 2 } else { 1 });
    let order = size.cmp(&Rational::from(1));
    assert!(order.is_lt() || order.is_eq() && inwards, "{found:?} {exact}");
    Scalar::to_f64(&size)
}

/// Operations on fractions, which each build has: exact in every bit. At least `greatest` halves of a unit are met.
fn beside_fractions<const N: usize>(count: usize) {
    let mut next = Awkward(0x9e37_79b9_7f4a_7c15 + N as u64);
    let mut greatest = [0.0f64; 6];
    for _ in 0..count {
        let [a, b] = next.pair::<N>(70 * N as u64);
        let [x, y] = [a, b].map(|x| x.to_rational().unwrap());
        let found = [a + b, a - b, a * b, a / b];
        let exact = [x.clone() + &y, x.clone() - &y, x.clone() * &y, x.clone() / &y];
        let all = found.into_iter().zip(exact).zip(&mut greatest);
        all.for_each(|((found, exact), most)| *most = most.max(halves(&found, &exact)));
        let quotient = x / y;
        greatest[4] = greatest[4].max(halves(&Wide::<N>::nearest(&quotient), &quotient));
        let narrow = a.resized::<2>();
        greatest[5] = greatest[5].max(halves(&narrow, &a.to_rational().unwrap()));
        assert_eq!(a.to_f64(), rational::nearest_double(&a.to_rational().unwrap()));
        let root = a.magnitude().sqrt_of();
        let [low, high] = [-1, 1].map(|side| {
            let unit = Wide::<16>::power(root.exponent - 64 * N as i32 - 1);
            root.resized::<16>() + if side < 0 { -unit } else { unit }
        });
        let square = a.magnitude().resized::<16>();
        assert!(low * low <= square && square < high * high);
    }
    let last = if N == 2 { 5 } else { 6 };
    assert!(greatest[..last].iter().all(|most| *most > 0.5), "{greatest:?}");
}

impl<const N: usize> Wide<N> {
    fn sqrt_of(&self) -> Self {
        self.try_sqrt().unwrap()
    }
}

#[test]
fn operations_are_those_of_fractions() {
    beside_fractions::<2>(4_000);
    beside_fractions::<3>(3_000);
    beside_fractions::<4>(3_000);
    beside_fractions::<6>(2_000);
}

/// A one below 1, whose root is next to the middle of it and 1; roots of squares; the square of a middle.
fn hard_roots<const N: usize>() {
    let below = Wide::<N>::ONE - Wide::power(-64 * N as i32);
    assert_eq!(below.sqrt_of(), below);
    let above = Wide::<N>::ONE + Wide::power(2 - 64 * N as i32);
    assert_eq!(above.sqrt_of(), Wide::<N>::ONE + Wide::power(1 - 64 * N as i32));
    let just = Wide::<N>::ONE + Wide::power(1 - 64 * N as i32);
    assert_eq!(just.sqrt_of(), Wide::<N>::ONE);
    for k in 1..2000 {
        let root = Wide::<N>::from(k * k * 1_000_003);
        assert_eq!((root * root).sqrt_of(), root);
    }
    assert_eq!(Wide::<N>::ZERO.try_sqrt(), Some(Wide::ZERO));
    assert_eq!((-Wide::<N>::ONE).try_sqrt(), None);
}

#[test]
fn roots_next_to_a_middle() {
    hard_roots::<2>();
    hard_roots::<3>();
    hard_roots::<4>();
    hard_roots::<6>();
}

fn carries_and_ends<const N: usize>() {
    let (one, unit) = (Wide::<N>::ONE, Wide::<N>::power(-64 * N as i32));
    let below = one - unit;
    assert_eq!(below.limbs, [u64::MAX; N]);
    assert_eq!(below + unit, one);
    assert_eq!(below + unit.scaled(-1), one, "half a unit goes away from zero");
    assert_eq!(below + (unit.scaled(-1) - unit.scaled(-60)), below);
    assert_eq!(one - unit.scaled(-2), one);
    assert_eq!(one - unit.scaled(-1), one, "a quarter of a unit below 1 is in the middle");
    assert_eq!(one - (unit.scaled(-1) + unit.scaled(-9)), below);
    assert_eq!((one + unit) - one, unit.scaled(1), "a half of the unit above 1 goes away from zero");
    assert_eq!((one + (unit - unit.scaled(-9))) - one, Wide::ZERO);
    assert_eq!(below * below, one - unit.scaled(1));
    assert_eq!((one / Wide::from(3)) * Wide::from(3), one);
    let least = Wide::<N>::power(-MOST);
    let greatest = Wide { limbs: [u64::MAX; N], exponent: MOST, negative: false };
    assert_eq!(least * least, least);
    assert_eq!((-least) / greatest, -least);
    assert!(!(greatest * greatest).is_finite() && !(greatest + greatest).is_finite());
    let (again, nothing) = (greatest, Wide::ZERO);
    assert_eq!(greatest - again, nothing);
    assert_eq!((greatest * greatest).to_f64(), f64::INFINITY);
    let infinite = one / Wide::ZERO;
    assert_eq!((infinite.to_f64(), (-infinite).to_f64()), (f64::INFINITY, f64::NEG_INFINITY));
    let negative = -infinite;
    let none = [infinite + negative, nothing / Wide::ZERO, infinite * nothing, infinite / negative];
    assert!(none.iter().all(|x| x.to_f64().is_nan() && x.partial_cmp(&one).is_none()));
    assert!(!none.iter().any(|x| none.contains(x)));
    assert!(none.iter().all(|x| (*x + one).is_nan() && (one * *x).is_nan() && (one / *x).is_nan()));
    assert_eq!(one / infinite, Wide::ZERO);
    assert!(infinite > greatest && -infinite < -greatest && Wide::ZERO < least && -least < Wide::ZERO);
    assert_eq!(Wide::<N>::from(0.0) - Wide::ZERO, -Wide::<N>::ZERO);
}

#[test]
fn carries_go_through_all_limbs_and_exponents_end() {
    carries_and_ends::<2>();
    carries_and_ends::<3>();
    carries_and_ends::<4>();
    carries_and_ends::<6>();
}

#[test]
fn doubles_come_and_go() {
    let mut next = Awkward(5);
    let special = [0.0, 5e-324, 1.5e-323, 2.2e-308, f64::MIN_POSITIVE, f64::MAX, 0.1, 1e-310, f64::INFINITY];
    let random: Vec<f64> = (0..20_000).map(|_| f64::from_bits(next.word())).filter(|x| !x.is_nan()).collect();
    assert!(random.len() > 19_000);
    for x in special.into_iter().chain(random) {
        assert_eq!(Wide::<3>::from(x).to_f64(), x);
        assert_eq!(Wide::<2>::from(-x).to_f64(), -x);
    }
    let least = Wide::<2>::from(5e-324);
    let more = Wide::<2>::power(-1175);
    assert_eq!([least.scaled(-1), least.scaled(-1) + more, least.scaled(-2)].map(|x| x.to_f64()), [0.0, 5e-324, 0.0]);
    let middle = Wide::<2>::from(f64::MAX) + Wide::power(970);
    assert_eq!([middle, middle - Wide::power(900)].map(|x| x.to_f64()), [f64::INFINITY, f64::MAX]);
}

#[test]
fn integers_and_floors() {
    let of = |x: f64| Wide::<2>::from(x).floor_int();
    assert_eq!(
        [0.0, 0.5, -0.5, 7.0, -7.0, -7.25, 9e18].map(of),
        [0, 0, -1, 7, -7, -8, 9_000_000_000_000_000_000].map(Some)
    );
    assert_eq!([9.3e18, f64::INFINITY, f64::NAN].map(of), [None; 3]);
    assert_eq!((Wide::<2>::from(3) - Wide::power(-100)).floor_int(), Some(2));
    for n in [0, 1, -1, 12345, i64::MAX, i64::MIN] {
        assert_eq!(Wide::<2>::from(n).floor_int(), Some(n));
    }
}

#[test]
fn texts() {
    let third = Wide::<2>::from_number(&"1/3".parse().unwrap(), &());
    assert_eq!(third.decimal(5), "0.33333");
    assert_eq!((-third.scaled(10)).decimal(37), "-341.3333333333333333333333333333333333");
    assert_eq!(third.text(), "0.3333333333333333333333333333333333333338");
    assert_eq!(Wide::<3>::from(1e-9).decimal(3), "1.00e-9");
    assert_eq!(Wide::<3>::from(31).decimal(5), "31.000");
    assert_eq!([f64::NAN, f64::INFINITY].map(|x| Wide::<2>::from(x).decimal(5)), ["NaN", "inf"]);
    assert_eq!(Wide::<2>::power(1 << 25).text(), "0.5·2^33554433");
    assert_eq!(third.compare(&Wide::from(0.1)), Ok(Ordering::Greater));
    let mut next = Awkward(77);
    for _ in 0..300 {
        let x = next.number::<3>(100);
        assert_eq!(Wide::from_number(&x.text().parse().unwrap(), &()), x);
    }
}

#[test]
fn integers_of_limbs() {
    for text in ["0", "18446744073709551616", "-340282366920938463463374607431768211455"] {
        let n: Integer = text.parse().unwrap();
        let size = rational::from_limbs(&rational::limbs(&n));
        assert!(size == n || -size == n);
    }
    assert!(rational::limbs(&Integer::from(0)).is_empty());
}

#[test]
fn units_are_those_of_the_bits() {
    let x = Wide::<3>::from(3);
    assert_eq!((x.unit(), x.log2_roundoff(), x.bits()), (2f64.powi(-192), -192.0, Some(192)));
    assert_eq!(x.in_roundoffs(), 3.0 * 2f64.powi(192));
    assert_eq!(x.roundoff().to_f64(), x.unit());
}

/// Against the long floats of the build: those of MPFR, or those in pure Rust.
mod long {
    use super::*;
    use crate::number::Float;
    use crate::number::rational::from_limbs;

    pub(in super::super) fn float<const N: usize>(x: &Wide<N>) -> Float {
        let size = Float::with_val(64 * N as u32, from_limbs(&x.limbs));
        let size = if x.negative { -size } else { size };
        size << x.exponent.wrapping_sub(64 * N as i32)
    }

    /// Asserts that both are the same, or as far from the exact value, and ours farther from zero.
    fn same<const N: usize>(found: &Wide<N>, nearest: Float, exact: impl Fn() -> Float) {
        let value = if found.is_zero() { Float::new(64) } else { float(found) };
        if value != nearest {
            let exact = exact();
            let off = |x: &Float| Float::with_val(2000, x - &exact).abs();
            assert!(off(&value) == off(&nearest) && value.cmp_abs(&nearest) == Some(Ordering::Greater), "{exact}");
        }
    }

    fn beside<const N: usize>(count: usize, seed: u64) {
        let bits = 64 * N as u32;
        let mut next = Awkward(seed + N as u64);
        let mut orders = [0; 3];
        for _ in 0..count {
            let [a, b] = next.pair::<N>(66 * N as u64);
            let (x, y) = (float(&a), float(&b));
            same(&(a + b), Float::with_val(bits, &x + &y), || Float::with_val(2000, &x + &y));
            same(&(a - b), Float::with_val(bits, &x - &y), || Float::with_val(2000, &x - &y));
            same(&(a * b), Float::with_val(bits, &x * &y), || Float::with_val(2000, &x * &y));
            // Quotients and roots of so many bits are never in the middle.
            same(&(a / b), Float::with_val(bits, &x / &y), || Float::new(2000));
            same(&a.magnitude().sqrt_of(), Float::with_val(bits, x.clone().abs().sqrt()), || Float::new(2000));
            assert_eq!(a.partial_cmp(&b), x.partial_cmp(&y));
            orders[(a.partial_cmp(&b).unwrap() as i8 + 1) as usize] += 1;
            assert_eq!(a.to_f64(), x.to_f64());
        }
        assert!(orders.iter().all(|met| *met > count / 100), "{orders:?}");
    }

    #[test]
    fn operations_are_those_of_long_floats() {
        beside::<2>(25_000, 1);
        beside::<3>(25_000, 2);
        beside::<4>(25_000, 3);
        beside::<6>(25_000, 4);
    }

    /// `cargo test --release --lib number::wide -- --ignored`: some minutes.
    #[test]
    #[ignore = "minutes: make explore"]
    fn ten_million_operations_are_those_of_long_floats() {
        beside::<2>(10_000_000, 5);
        beside::<3>(10_000_000, 6);
        beside::<4>(10_000_000, 7);
        beside::<6>(10_000_000, 8);
    }
}
pub(super) use long::float;
