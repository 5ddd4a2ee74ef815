//! The number: sign, exponent and mantissa, its rounding and its order.

use std::cmp::Ordering;
use std::ops::Neg;

use super::limbs::{increment, move_up, order, shift_up};

/// A binary floating-point number with a mantissa of 2 to 6 machine words, on the stack: `64 LIMBS` bits.
///
/// A number is `± m 2^e` with `½ ≤ m < 1`, zero without a sign, an infinity, or no number.
///
/// **Accuracy**: sums, differences, products, quotients, square roots and conversions are *correctly rounded*, a number
/// in the middle between two away from zero; so each is within the unit roundoff `2^{−64 LIMBS}` of itself.
/// Elementary functions are within 0.51 units in the last place. Beyond seven limbs these and square roots have the
/// digits of eight. Results below `2^{−2³⁰}` become the least number with
/// their sign, those from `2^{2³⁰}` on become infinite.
#[derive(Clone, Copy, Debug)]
pub struct Wide<const LIMBS: usize> {
    /// The mantissa, least significant limb first. Its top bit is set, or all of it is zero.
    pub(super) limbs: [u64; LIMBS],
    pub(super) exponent: i32,
    pub(super) negative: bool,
}

/// The exponent of zero, far below all others.
pub(super) const ZERO: i32 = i32::MIN;
/// The exponent of an infinity, whose limbs are zero, and of what is no number, whose limbs are not.
pub(super) const INFINITE: i32 = i32::MAX;
/// The greatest exponent; its negative is the least one.
pub(super) const MOST: i32 = 1 << 30;
/// The top bit of a limb.
pub(super) const TOP: u64 = 1 << 63;

impl<const N: usize> Wide<N> {
    /// The number of limbs; the compiler refuses fewer than two.
    pub(super) const LIMBS: usize = {
        assert!(N >= 2, "a number has at least two limbs");
        N
    };
    pub(super) const ZERO: Self = Wide { limbs: [0; N], exponent: ZERO, negative: false };
    pub(super) const ONE: Self = Wide::power(0);
    pub(super) const NAN: Self = Wide { limbs: [TOP; N], exponent: INFINITE, negative: false };

    /// `2^exponent`.
    pub(super) const fn power(exponent: i32) -> Self {
        let mut limbs = [0; N];
        limbs[N - 1] = TOP;
        Wide { limbs, exponent: exponent + 1, negative: false }
    }

    pub(super) const fn infinity(negative: bool) -> Self {
        Wide { limbs: [0; N], exponent: INFINITE, negative }
    }

    #[inline]
    pub(super) fn is_zero(&self) -> bool {
        self.exponent == ZERO
    }

    /// Whether the number is neither infinite nor none.
    #[inline]
    pub(super) fn finite(&self) -> bool {
        self.exponent != INFINITE
    }

    #[inline]
    pub(super) fn is_nan(&self) -> bool {
        !self.finite() && self.limbs[N - 1] != 0
    }

    /// Whether the number is zero, infinite or none.
    #[inline]
    pub(super) fn is_special(&self) -> bool {
        self.exponent == ZERO || self.exponent == INFINITE
    }

    /// A double of the same kind: −1, 0, 1, infinite or no number.
    #[cold]
    pub(super) fn kind(&self) -> f64 {
        let size = match self.exponent {
            ZERO => 0.0,
            INFINITE if self.is_nan() => f64::NAN,
            INFINITE => f64::INFINITY,
            _ => 1.0,
        };
        if self.negative { -size } else { size }
    }

    /// `self · 2^by`.
    #[inline]
    pub(super) fn scaled(self, by: i32) -> Self {
        if self.is_zero() || !self.finite() {
            return self;
        }
        self.within(i64::from(self.exponent) + i64::from(by))
    }

    /// The number of this sign and mantissa with an exponent that may be too great or too small.
    #[inline(always)]
    fn within(self, exponent: i64) -> Self {
        if exponent.abs() <= i64::from(MOST) {
            return Wide { exponent: exponent as i32, ..self };
        }
        if exponent > 0 {
            Wide::infinity(self.negative)
        } else {
            Wide { negative: self.negative, ..Wide::power(-MOST) }
        }
    }

    /// Rounds a mantissa with its top bit set to nearest; the guard is the limb below it.
    ///
    /// Whatever lies below the guard, not negative and less than its unit, changes nothing: the guard's top bit says
    /// whether a half of a unit is reached.
    #[inline(always)]
    pub(super) fn rounded(mut limbs: [u64; N], guard: u64, exponent: i64, negative: bool) -> Self {
        let mut exponent = exponent;
        if increment(&mut limbs, guard >= TOP) {
            limbs[N - 1] = TOP;
            exponent += 1;
        }
        Wide { limbs, exponent: 0, negative }.within(exponent)
    }

    /// The same of any mantissa; zero where limbs and guard are.
    #[inline(always)]
    pub(super) fn normalised(mut limbs: [u64; N], mut guard: u64, exponent: i64, negative: bool) -> Self {
        let mut exponent = exponent;
        if limbs[N - 1] == 0 {
            if guard == 0 && limbs == [0; N] {
                return Wide::ZERO;
            }
            while limbs[N - 1] == 0 {
                move_up(&mut limbs, &mut guard);
                exponent -= 64;
            }
        }
        let zeros = limbs[N - 1].leading_zeros();
        shift_up(&mut limbs, &mut guard, zeros);
        Wide::rounded(limbs, guard, exponent - i64::from(zeros), negative)
    }

    /// The number in `M` limbs: *exact* for more limbs, *correctly rounded* for fewer.
    #[inline]
    pub fn resized<const M: usize>(&self) -> Wide<M> {
        let mut limbs = [0; M];
        let own = limbs.iter_mut().rev().zip(self.limbs.iter().rev());
        own.for_each(|(limb, own)| *limb = *own);
        if M >= N || self.is_zero() || !self.finite() {
            return Wide { limbs, exponent: self.exponent, negative: self.negative };
        }
        Wide::rounded(limbs, self.limbs[N - 1 - M], self.exponent.into(), self.negative)
    }

    /// The order of magnitudes.
    #[inline]
    fn order(&self, other: &Self) -> Ordering {
        self.exponent.cmp(&other.exponent).then_with(|| order(&self.limbs, &other.limbs))
    }
}

impl<const N: usize> From<i64> for Wide<N> {
    #[inline]
    fn from(n: i64) -> Self {
        let size = n.unsigned_abs();
        if size == 0 {
            return Wide::ZERO;
        }
        let zeros = size.leading_zeros();
        let mut limbs = [0; N];
        limbs[Self::LIMBS - 1] = size << zeros;
        Wide { limbs, exponent: 64 - zeros as i32, negative: n < 0 }
    }
}

/// **Accuracy**: *exact*.
impl<const N: usize> From<f64> for Wide<N> {
    #[inline]
    fn from(x: f64) -> Self {
        let (bits, negative) = (x.to_bits(), x.is_sign_negative());
        let (fraction, exponent) = (bits & ((1 << 52) - 1), (bits >> 52 & 0x7ff) as i32);
        match exponent {
            0x7ff if fraction != 0 => Wide::NAN,
            0x7ff => Wide::infinity(negative),
            // Subnormal numbers are multiples of 2^−1074.
            0 => Wide { negative: negative && fraction != 0, ..Wide::from(fraction as i64).scaled(-1074) },
            _ => {
                let mut limbs = [0; N];
                limbs[Self::LIMBS - 1] = TOP | fraction << 11;
                Wide { limbs, exponent: exponent - 1022, negative }
            }
        }
    }
}

impl<const N: usize> Wide<N> {
    /// The nearest double; of two the even one. **Accuracy**: *correctly rounded*.
    #[inline]
    pub(super) fn nearest_double(&self) -> f64 {
        // 63 bits, the last of which says whether there is more.
        let top = self.limbs[N - 1];
        let more = self.limbs[..N - 1].iter().fold(top & 1, |more, limb| more | limb);
        let mantissa = top >> 1 | u64::from(more != 0);
        let sign = if self.negative { -1.0 } else { 1.0 };
        match self.exponent {
            // Above the least normal double the rounding to 53 bits is all; the factor may make it infinite.
            -1021..=1024 => {
                let half = f64::from_bits(((self.exponent + 1022) as u64) << 52);
                sign * (mantissa as i64 as f64 * (2.0 / TOP as f64)) * half
            }
            INFINITE if top != 0 => f64::NAN,
            1025.. => sign * f64::INFINITY,
            ..-1074 => 0.0,
            exponent => {
                // A multiple of 2^−1074.
                let shift = (-1011 - exponent) as u32;
                let kept = mantissa >> shift;
                let (rest, middle) = (mantissa & ((1 << shift) - 1), 1u64 << (shift - 1));
                let up = rest > middle || rest == middle && kept & 1 == 1;
                sign * f64::from_bits(kept + u64::from(up))
            }
        }
    }
}

impl<const N: usize> Neg for Wide<N> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Wide { negative: !self.negative && !self.is_zero(), ..self }
    }
}

impl<const N: usize> PartialEq for Wide<N> {
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl<const N: usize> PartialOrd for Wide<N> {
    /// Compares by value; no number has no order.
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        if self.is_nan() || other.is_nan() {
            return None;
        }
        Some(match (self.negative, other.negative) {
            (false, false) => self.order(other),
            (true, true) => other.order(self),
            (false, true) => Ordering::Greater,
            (true, false) => Ordering::Less,
        })
    }
}
