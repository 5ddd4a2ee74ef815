//! Sums, products, quotients and square roots.

use super::float::{TOP, Wide};
use super::limbs::{Divisor, add_masked, move_down, order, product, shift_down};

impl<const N: usize> Wide<N> {
    /// `self + other`, with the sign of `other` as given. **Accuracy**: *correctly rounded*.
    ///
    /// The smaller number is shifted to the exponent of the greater one, with a guard limb below. Less than its unit is
    /// lost, and that only for shifts beyond 64 bits: its last bit then stands for it. A sum shifts at most one bit out
    /// of the mantissa, and a difference at most one bit in where anything was lost, so that the bit that decides the
    /// rounding is right. From a shift of `64 N + 2` on the smaller number is less than a half of the distance to
    /// either neighbour of the greater one.
    #[inline(always)]
    fn sum(&self, other: &Self, negative: bool) -> Self {
        let other = Wide { negative, ..*other };
        let (a, b) = if self.exponent >= other.exponent { (*self, other) } else { (other, *self) };
        if !a.finite() || b.is_zero() {
            return if a.finite() { a } else { Wide::from(a.kind() + b.kind()) };
        }
        let apart = a.exponent.abs_diff(b.exponent);
        if apart >= 64 * N as u32 + 2 {
            return a;
        }
        let mut small = b.limbs;
        let mut guard = shift_down(&mut small, apart % 64);
        if apart >= 64 {
            let (mut lost, mut left) = (0, apart / 64);
            while left > 0 {
                lost |= guard;
                guard = move_down(&mut small);
                left -= 1;
            }
            guard |= u64::from(lost != 0);
        }
        let minus = a.negative != b.negative;
        let mask = u64::from(minus).wrapping_neg();
        // The guard of the greater one is zero.
        let (below, carry) = (guard ^ mask).overflowing_add(u64::from(minus));
        let (mut sum, carry) = add_masked(&a.limbs, &small, mask, carry);
        let mut sign = a.negative;
        if minus && !carry {
            // Of equal exponents the second was the greater; there is no guard.
            (sum, _) = add_masked(&[0; N], &sum, u64::MAX, true);
            sign = !sign;
        }
        // A bit that is carried out of a sum comes back at the top; the last bit stands for what is lost.
        let over = u64::from(carry & !minus);
        let last = below & over;
        let guard = below >> over | sum[0] << 1 << (63 - over) & over.wrapping_neg() | last;
        shift_down(&mut sum, over as u32);
        sum[N - 1] |= over << 63;
        Wide::normalised(sum, guard, i64::from(a.exponent) + over as i64, sign)
    }

    #[inline]
    fn plus(self, other: &Self) -> Self {
        self.sum(other, other.negative)
    }

    #[inline]
    fn minus(self, other: &Self) -> Self {
        self.sum(other, !other.negative)
    }

    /// `self · other`. **Accuracy**: *correctly rounded*: the product is exact before it is rounded.
    #[inline(always)]
    fn times(self, other: &Self) -> Self {
        let negative = self.negative != other.negative;
        if self.is_special() || other.is_special() {
            return Wide::from(self.kind() * other.kind());
        }
        let (mut limbs, mut guard) = product(&self.limbs, &other.limbs);
        let exponent = i64::from(self.exponent) + i64::from(other.exponent);
        let zero = (limbs[N - 1] >> 63) ^ 1;
        // The upper half is at least a quarter.
        super::limbs::shift_up(&mut limbs, &mut guard, zero as u32);
        Wide::rounded(limbs, guard, exponent - zero as i64, negative)
    }

    /// `self/other`. **Accuracy**: *correctly rounded*: `N + 1` limbs of the quotient are exact, rounded down.
    #[inline]
    fn over(self, other: &Self) -> Self {
        let negative = self.negative != other.negative;
        if self.is_special() || other.is_special() {
            return Wide::from(self.kind() / other.kind());
        }
        let exponent = i64::from(self.exponent) - i64::from(other.exponent);
        if other.limbs[N - 1] == TOP && other.limbs[..N - 1].iter().all(|limb| *limb == 0) {
            return Wide::rounded(self.limbs, 0, exponent + 1, negative);
        }
        let divisor = Divisor::new(&other.limbs);
        let mut rest = self.limbs;
        let whole = order(&rest, &other.limbs).is_ge();
        if whole {
            (rest, _) = add_masked(&rest, &other.limbs, u64::MAX, true);
        }
        let mut limbs = [0; N];
        limbs.iter_mut().rev().for_each(|limb| *limb = divisor.next(&mut rest));
        let mut guard = divisor.next(&mut rest);
        if whole {
            guard = guard >> 1 | shift_down(&mut limbs, 1);
            limbs[N - 1] |= TOP;
        }
        Wide::rounded(limbs, guard, exponent + i64::from(whole), negative)
    }

    /// The square root; no number for negative ones. **Accuracy**: *correctly rounded*.
    pub(super) fn root(&self) -> Self {
        if self.is_zero() || self.is_nan() || self.negative {
            return if self.is_zero() { *self } else { Wide::NAN };
        }
        if !self.finite() {
            return *self;
        }
        guarded!(N, M => {
            let root = self.resized::<M>().near_root();
            match M.checked_sub(N + 1).map(|guard| root.limbs[guard].abs_diff(TOP) > 1 << 32) {
                Some(false) => self.middle(&root),
                _ => root.resized(),
            }
        })
    }

    /// The root of a finite positive number within `2³²` units of the last limb.
    ///
    /// Newton's method for `1/√x` squares the relative error ε of a step to `3ε²/2` and adds less than six roundings,
    /// twice in 128 bits from the double and then in all; the last step, for the root, leaves `ε²/2` and three
    /// roundings. A double is within `2^{−50}`, 128 bits are within `2^{−98}`, and the square of what the steps in all
    /// bits are counted by is below a rounding.
    fn near_root(&self) -> Self {
        let half = self.exponent.div_euclid(2);
        let x = Wide { exponent: self.exponent - 2 * half, ..*self };
        let step = |y: Wide<N>| y + y.scaled(-1) * (Wide::ONE - x * y * y);
        let start: Wide<2> = Wide::from(x.nearest_double().sqrt().recip());
        let start = start + start.scaled(-1) * (Wide::ONE - x.resized::<2>() * start * start);
        let mut bits = 96;
        let mut y = start.resized();
        while 2 * bits < 64 * N {
            (y, bits) = (step(y), 2 * bits - 2);
        }
        let root = x * y;
        (root + y.scaled(-1) * (x - root * root)).scaled(half)
    }

    /// The root next to a point in the middle of two numbers: the square of that point is exact in 16 limbs.
    #[cold]
    fn middle<const M: usize>(&self, near: &Wide<M>) -> Self {
        let mut below = Wide::<N> { limbs: [0; N], exponent: near.exponent, negative: false };
        below.limbs.copy_from_slice(&near.limbs[M - N..]);
        let unit = Wide::power(near.exponent - 64 * N as i32);
        let middle = below.resized::<16>() + Wide::<16>::power(near.exponent - 64 * N as i32 - 1);
        if self.resized::<16>() >= middle * middle { below + unit } else { below }
    }
}

operators!([const N: usize] Wide<N>);
