//! Floats in pure Rust against those of MPFR.

use std::cmp::Ordering;

use rug::float::Round as Direction;
use rug::ops::AssignRound;

use super::float::{Constant, Float, Round, floor, rounded};
use super::rational;

const DIRECTIONS: [(Round, Direction); 4] = [
    (Round::Nearest, Direction::Nearest),
    (Round::Down, Direction::Down),
    (Round::Up, Direction::Up),
    (Round::AwayZero, Direction::AwayZero),
];

/// A sequence of numbers (splitmix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    fn below(&mut self, most: u64) -> u64 {
        self.next() % most
    }

    fn bits(&mut self) -> u32 {
        53 + self.below(948) as u32
    }

    /// Returns a number with long runs of equal bits in half of all cases, and an exponent within this range.
    fn float(&mut self, bits: u32, range: i64) -> rug::Float {
        let words: Vec<u64> = (0..bits.div_ceil(64))
            .map(|_| match self.below(4) {
                0 => 0,
                1 => u64::MAX << self.below(64),
                _ => self.next(),
            })
            .collect();
        let size = rug::Integer::from_digits(&words, rug::integer::Order::Lsf) + 1u32;
        let shift = self.below(2 * range as u64 + 1) as i64 - range - i64::from(size.significant_bits());
        let x = rug::Float::with_val_round(bits, size, Direction::Zero).0 << shift as i32;
        if self.below(2) == 0 { -x } else { x }
    }

    /// Returns a number next to `x` by the last bits of either, or one far away.
    fn beside(&mut self, x: &rug::Float, bits: u32, range: i64) -> rug::Float {
        let unit = rug::Float::with_val(bits, 1) << (x.get_exp().unwrap_or(0) - x.prec().min(bits) as i32);
        match self.below(8) {
            0 => rug::Float::with_val(bits, x + &unit),
            1 => rug::Float::with_val(bits, -x) - unit,
            2 => rug::Float::with_val(bits, x),
            3 => unit,
            4 => unit >> (self.below(8) as u32),
            _ => self.float(bits, range),
        }
    }
}

fn ours(x: &rug::Float) -> Float {
    let Some((mantissa, exponent)) = x.to_integer_exp() else { return Float::with_val(x.prec(), x.to_f64()) };
    let limbs = rational::from_limbs(&mantissa.to_digits(rug::integer::Order::Lsf));
    let limbs = if mantissa < 0 { -limbs } else { limbs };
    Float::with_val(x.prec(), limbs) << exponent
}

fn theirs(x: &Float) -> rug::Float {
    let Some((mantissa, exponent)) = x.to_integer_exp() else { return rug::Float::with_val(x.prec(), x.to_f64()) };
    let size = rug::Integer::from_digits(&rational::limbs(&mantissa), rug::integer::Order::Lsf);
    let size = rug::Float::with_val(x.prec(), size) << exponent;
    if x.is_sign_negative() { -size } else { size }
}

/// Asserts that both are the same in each direction.
fn same<T>(what: &str, bits: u32, found: impl Fn(Round) -> Float, sure: impl Fn() -> T)
where
    rug::Float: AssignRound<T, Round = Direction, Ordering = Ordering>,
{
    for (round, direction) in DIRECTIONS {
        let (found, sure) = (found(round), rug::Float::with_val_round(bits, sure(), direction).0);
        let (found, nan) = (theirs(&found), found.is_nan());
        assert!(found == sure || nan && sure.is_nan(), "{what} {round:?} {bits}: {found} {sure}");
    }
}

/// Compares sums, products, quotients and roots; returns how many sums cancel.
fn operations(count: usize, range: i64, seed: u64) -> usize {
    let (mut next, mut cancelled) = (Random(seed), 0);
    for _ in 0..count {
        let [bits, of_x, of_y] = [(); 3].map(|()| next.bits());
        let x = next.float(of_x, range);
        let y = next.beside(&x, of_y, range);
        let (a, b) = (ours(&x), ours(&y));
        assert_eq!((theirs(&a), theirs(&b)), (x.clone(), y.clone()));
        same("sum", bits, |round| rounded(bits, &a + &b, round), || &x + &y);
        same("difference", bits, |round| rounded(bits, &a - &b, round), || &x - &y);
        same("product", bits, |round| rounded(bits, &a * &b, round), || &x * &y);
        same("quotient", bits, |round| rounded(bits, &a / &b, round), || &x / &y);
        same("reciprocal", bits, |round| rounded(bits, a.recip_ref(), round), || x.recip_ref());
        let size = x.clone().abs();
        same("root", bits, |round| rounded(bits, a.clone().abs().sqrt_ref(), round), || size.sqrt_ref());
        same("copy", bits, |round| rounded(bits, &a, round), || &x);
        assert_eq!(a.partial_cmp(&b), x.partial_cmp(&y));
        assert_eq!(a.cmp_abs(&b), x.cmp_abs(&y));
        assert_eq!((a.get_exp(), a.cmp0()), (x.get_exp(), x.cmp0()));
        let whole = x.get_exp().filter(|top| *top < 100).and_then(|_| x.to_integer_round(Direction::Down));
        assert_eq!(floor(&a), whole.and_then(|(n, _)| n.to_i64()));
        for (round, direction) in DIRECTIONS {
            assert_eq!(a.to_f64_round(round), x.to_f64_round(direction), "{x} {round:?}");
        }
        let least = x.get_exp().max(y.get_exp()).unwrap_or(0) - 20;
        let sums = [rug::Float::with_val(2100, &x + &y), rug::Float::with_val(2100, &x - &y)];
        cancelled += usize::from(sums.iter().any(|sum| sum.is_zero() || sum.get_exp().unwrap_or(0) < least));
    }
    cancelled
}

/// Compares the elementary functions.
fn functions(count: usize, seed: u64) {
    let mut next = Random(seed);
    for k in 0..count {
        let [bits, of_x] = [(); 2].map(|()| next.bits());
        let range = [4, 12, 60, 400, 2000][k % 5];
        let x = next.float(of_x, range);
        let a = ours(&x);
        same("exp", bits, |round| rounded(bits, a.exp_ref(), round), || x.exp_ref());
        same("exp_m1", bits, |round| rounded(bits, a.exp_m1_ref(), round), || x.exp_m1_ref());
        same("ln", bits, |round| rounded(bits, a.ln_ref(), round), || x.ln_ref());
        same("ln_1p", bits, |round| rounded(bits, a.ln_1p_ref(), round), || x.ln_1p_ref());
        if range < 100 {
            same("sin", bits, |round| rounded(bits, a.sin_ref(), round), || x.sin_ref());
            same("cos", bits, |round| rounded(bits, a.cos_ref(), round), || x.cos_ref());
        }
        if k % 20 == 0 {
            let one = rug::Float::with_val(1001, 1) + (x.clone() >> (x.get_exp().unwrap_or(0) + 900));
            let near = ours(&one);
            same("ln near 1", bits, |round| rounded(bits, near.ln_ref(), round), || one.ln_ref());
            same("pi", bits, |round| rounded(bits, Constant::Pi, round), || rug::float::Constant::Pi);
        }
    }
}

/// Compares texts, doubles, fractions and the values at the ends of the range.
fn conversions(count: usize, seed: u64) {
    let mut next = Random(seed);
    for k in 0..count {
        let (bits, range) = (next.bits(), [3, 70, 1100][k % 3]);
        let x = next.float(bits, range);
        let a = ours(&x);
        assert_eq!(a.to_string(), x.to_string());
        for (round, direction) in DIRECTIONS {
            let digits = 2 + next.below(60) as usize;
            let text = x.to_string_radix_round(10, Some(digits), direction);
            assert_eq!(a.to_string_radix_round(10, Some(digits), round), text, "{digits} {round:?}");
            assert_eq!(a.to_f64_exp_round(round), x.to_f64_exp_round(direction));
        }
        assert_eq!(a.to_rational().unwrap().to_string(), x.to_rational().unwrap().to_string());
        let (p, q) = (next.next() as i64, next.next() as i64 >> 8 | 1);
        let ratio = rational::quotient(p.into(), q.into());
        let sure = rug::Rational::from((p, q));
        same("fraction", bits, |round| rounded(bits, &ratio, round), || &sure);
        let double = f64::from_bits(next.next());
        same("double", bits, |round| rounded(bits, double, round), || double);
    }
}

#[test]
fn operations_are_those_of_mpfr() {
    assert!(operations(6_000, 100, 1) > 1_500);
    operations(6_000, 3000, 2);
    // Products, quotients and shifts beyond the range of exponents.
    operations(3_000, (1 << 30) - 1200, 3);
}

#[test]
fn functions_are_those_of_mpfr() {
    functions(160, 4);
}

#[test]
fn conversions_are_those_of_mpfr() {
    conversions(1_500, 5);
}

#[test]
fn values_that_are_no_numbers_are_those_of_mpfr() {
    let values = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, 1.0, -1.0, 3e9, -3e9];
    for x in values {
        let (x, a) = (rug::Float::with_val(60, x), Float::with_val(60, x));
        for y in values {
            let (y, b) = (rug::Float::with_val(60, y), Float::with_val(60, y));
            same("sum", 60, |round| rounded(60, &a + &b, round), || &x + &y);
            same("difference", 60, |round| rounded(60, &a - &b, round), || &x - &y);
            same("product", 60, |round| rounded(60, &a * &b, round), || &x * &y);
            if !b.is_zero() || a.is_zero() {
                same("quotient", 60, |round| rounded(60, &a / &b, round), || &x / &y);
            }
            assert_eq!(a.partial_cmp(&b), x.partial_cmp(&y));
        }
        same("exp", 60, |round| rounded(60, a.exp_ref(), round), || x.exp_ref());
        same("exp_m1", 60, |round| rounded(60, a.exp_m1_ref(), round), || x.exp_m1_ref());
        same("ln", 60, |round| rounded(60, a.ln_ref(), round), || x.ln_ref());
        same("ln_1p", 60, |round| rounded(60, a.ln_1p_ref(), round), || x.ln_1p_ref());
        same("root", 60, |round| rounded(60, a.sqrt_ref(), round), || x.sqrt_ref());
        same("sin", 60, |round| rounded(60, a.sin_ref(), round), || x.sin_ref());
        same("cos", 60, |round| rounded(60, a.cos_ref(), round), || x.cos_ref());
    }
}

/// `cargo test --release --lib number::pure -- --ignored`: some minutes.
#[test]
#[ignore = "minutes: make explore"]
fn a_million_operations_are_those_of_mpfr() {
    operations(1_000_000, 300, 6);
    operations(300_000, (1 << 30) - 1200, 7);
    functions(60_000, 8);
    conversions(300_000, 9);
}
