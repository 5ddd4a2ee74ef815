//! Arrays of limbs, least significant first: what mantissas are made of.
//!
//! The innermost loops are `while` loops: tests run with few optimisations, where ranges take half of the time.

use std::cmp::Ordering;

/// Adds `carry` to the number; returns what is carried out of the top limb.
#[inline(always)]
pub(super) fn increment<const N: usize>(limbs: &mut [u64; N], carry: bool) -> bool {
    limbs.iter_mut().fold(carry, |carry, limb| {
        let (sum, carry) = limb.overflowing_add(u64::from(carry));
        *limb = sum;
        carry
    })
}

/// `a + (b ^ mask)` and a carry, with what is carried out of the top limb: with a mask of ones, `a − b`.
#[inline(always)]
pub(super) fn add_masked<const N: usize>(a: &[u64; N], b: &[u64; N], mask: u64, mut carry: bool) -> ([u64; N], bool) {
    let (mut sum, mut k) = ([0; N], 0);
    while k < N {
        (sum[k], carry) = a[k].carrying_add(b[k] ^ mask, carry);
        k += 1;
    }
    (sum, carry)
}

/// Shifts limbs and guard up by `0 … 63` bits.
#[inline(always)]
pub(super) fn shift_up<const N: usize>(limbs: &mut [u64; N], guard: &mut u64, bits: u32) {
    // In two steps, because a shift by 64 is none.
    let mut below = *guard;
    *guard <<= bits;
    for limb in limbs {
        let next = *limb;
        *limb = next << bits | below >> 1 >> (63 - bits);
        below = next;
    }
}

/// Shifts limbs down by `0 … 63` bits; returns what leaves them as the guard.
#[inline(always)]
pub(super) fn shift_down<const N: usize>(limbs: &mut [u64; N], bits: u32) -> u64 {
    let mut above = 0;
    for limb in limbs.iter_mut().rev() {
        let next = *limb;
        *limb = next >> bits | above << 1 << (63 - bits);
        above = next;
    }
    above << 1 << (63 - bits)
}

/// Moves all limbs up by one place, with the guard in the lowest.
#[inline(always)]
pub(super) fn move_up<const N: usize>(limbs: &mut [u64; N], guard: &mut u64) {
    let mut below = std::mem::take(guard);
    limbs.iter_mut().for_each(|limb| std::mem::swap(limb, &mut below));
}

/// Moves all limbs down by one place; returns the lowest.
#[inline(always)]
pub(super) fn move_down<const N: usize>(limbs: &mut [u64; N]) -> u64 {
    let mut above = 0;
    limbs.iter_mut().rev().for_each(|limb| std::mem::swap(limb, &mut above));
    above
}

#[inline]
pub(super) fn order<const N: usize>(a: &[u64; N], b: &[u64; N]) -> Ordering {
    a.iter().rev().cmp(b.iter().rev())
}

/// The upper half of `a b`, and the limb below it.
#[inline(always)]
pub(super) fn product<const N: usize>(a: &[u64; N], b: &[u64; N]) -> ([u64; N], u64) {
    let (mut sum, mut guard, mut i) = ([0; N], 0, 0);
    while i < N {
        let mut carry;
        (guard, carry) = a[i].carrying_mul_add(b[0], sum[0], 0);
        let mut k = 1;
        while k < N {
            (sum[k - 1], carry) = a[i].carrying_mul_add(b[k], sum[k], carry);
            k += 1;
        }
        sum[N - 1] = carry;
        i += 1;
    }
    (sum, guard)
}

/// A divisor with its top bit set, and the reciprocal of its two upper limbs `d`: `⌊(2¹⁹² − 1)/d⌋ − 2⁶⁴`.
///
/// **Source**: Möller and Granlund, *Improved division by invariant integers*, 2011, algorithms 6 and 4.
pub(super) struct Divisor<'a, const N: usize> {
    limbs: &'a [u64; N],
    upper: u128,
    reciprocal: u64,
}

impl<'a, const N: usize> Divisor<'a, N> {
    pub(super) fn new(limbs: &'a [u64; N]) -> Self {
        let (high, low) = (limbs[N - 1], limbs[N - 2]);
        let mut reciprocal = ((u128::MAX - (u128::from(high) << 64)) / u128::from(high)) as u64;
        let mut rest = high.wrapping_mul(reciprocal).wrapping_add(low);
        if rest < low {
            reciprocal -= 1;
            if rest >= high {
                reciprocal -= 1;
                rest -= high;
            }
            rest = rest.wrapping_sub(high);
        }
        let upper = u128::from(high) << 64 | u128::from(low);
        let (less, more) = low.carrying_mul(reciprocal, 0);
        let (rest, over) = rest.overflowing_add(more);
        if over {
            reciprocal -= 1;
            if u128::from(rest) << 64 | u128::from(less) >= upper {
                reciprocal -= 1;
            }
        }
        Divisor { limbs, upper, reciprocal }
    }

    /// The quotient of the three upper limbs, `top < d` and `next`, by `d`.
    #[inline]
    fn estimate(&self, top: u128, next: u64) -> u64 {
        let (high, low) = ((self.upper >> 64) as u64, self.upper as u64);
        let product = u128::from(self.reciprocal) * (top >> 64);
        let sum = product.wrapping_add(top);
        let (quotient, part) = ((sum >> 64) as u64, sum as u64);
        let rest = (top as u64).wrapping_sub(quotient.wrapping_mul(high));
        let rest = (u128::from(rest) << 64 | u128::from(next))
            .wrapping_sub(u128::from(low) * u128::from(quotient))
            .wrapping_sub(self.upper);
        let (mut quotient, mut rest) = (quotient.wrapping_add(1), rest);
        if (rest >> 64) as u64 >= part {
            quotient = quotient.wrapping_sub(1);
            rest = rest.wrapping_add(self.upper);
        }
        if rest >= self.upper { quotient.wrapping_add(1) } else { quotient }
    }

    /// The next limb of the quotient; `rest`, below the divisor, moves up by a limb and becomes the remainder.
    ///
    /// The estimate from three limbs is right or one too great, and `2⁶⁴ − 1` where the upper limbs are those of the
    /// divisor.
    #[inline]
    pub(super) fn next(&self, rest: &mut [u64; N]) -> u64 {
        let below = if N > 2 { rest[N.saturating_sub(3)] } else { 0 };
        let top = u128::from(rest[N - 1]) << 64 | u128::from(rest[N - 2]);
        let mut quotient = if top >= self.upper { u64::MAX } else { self.estimate(top, below) };
        // The remainder moves up by a limb on the way.
        let (mut carry, mut borrow, mut below) = (0, false, 0);
        for (rest, limb) in rest.iter_mut().zip(self.limbs) {
            let (low, next) = quotient.carrying_mul(*limb, carry);
            let (less, short) = u64::borrowing_sub(below, low, borrow);
            (below, carry, borrow) = (*rest, next, short);
            *rest = less;
        }
        let top = below;
        let (_, mut short) = top.borrowing_sub(carry, borrow);
        while short {
            quotient -= 1;
            let (sum, over) = add_masked(rest, self.limbs, 0, false);
            *rest = sum;
            short = !over;
        }
        quotient
    }
}
