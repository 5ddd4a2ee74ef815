//! The traits that formulas ask of a number.

use std::cmp::Ordering;

use super::float::Wide;
use crate::number::spelling::spelled_as;
use crate::number::{Estimate, Number, Open, Reads, Rounded, Scalar};

impl<const N: usize> Scalar for Wide<N> {
    type Precision = ();

    fn from_number(number: &Number, (): &()) -> Self {
        Wide::nearest(&number.to_rational())
    }

    fn precision(&self) {}

    #[inline]
    fn int(&self, n: i64) -> Self {
        Wide::from(n)
    }

    #[inline]
    fn double(&self, x: f64) -> Self {
        Wide::from(x)
    }

    fn try_sqrt(&self) -> Option<Self> {
        (!self.negative && !self.is_nan()).then(|| self.root())
    }

    #[inline]
    fn to_f64(&self) -> f64 {
        self.nearest_double()
    }

    #[inline]
    fn roundoff(&self) -> Self {
        Wide::power(-64 * N as i32)
    }

    #[inline]
    fn bits(&self) -> Option<u32> {
        Some(64 * N as u32)
    }

    /// Zero for what is no number.
    #[inline]
    fn sign(&self) -> Result<Ordering, Open> {
        Ok(match self.negative {
            _ if Wide::is_zero(self) || self.is_nan() => Ordering::Equal,
            true => Ordering::Less,
            false => Ordering::Greater,
        })
    }

    #[inline]
    fn compare(&self, other: &Self) -> Result<Ordering, Open> {
        Ok(self.partial_cmp(other).unwrap_or(Ordering::Equal))
    }

    #[inline]
    fn floor_int(&self) -> Option<i64> {
        let (top, below) = (self.limbs[N - 1], &self.limbs[..N - 1]);
        let (whole, rest) = match self.exponent {
            ..=0 => (0, top),
            exponent @ 1..=63 => ((top >> (64 - exponent)) as i64, top << exponent),
            _ => return (*self == Wide::from(i64::MIN)).then_some(i64::MIN),
        };
        let parts = rest != 0 || below.iter().any(|limb| *limb != 0);
        Some(if self.negative { -whole - i64::from(parts) } else { whole })
    }

    fn is_finite(&self) -> bool {
        self.finite()
    }

    fn decimal(&self, digits: u32) -> String {
        self.in_decimal(digits)
    }

    fn text(&self) -> String {
        self.in_decimal(Self::DIGITS)
    }

    #[inline]
    fn magnitude(&self) -> Self {
        Wide { negative: false, ..*self }
    }
}

impl<const N: usize> Rounded for Wide<N> {
    #[inline]
    fn is_negative(&self) -> bool {
        self.negative && !self.is_nan()
    }

    #[inline]
    fn is_positive(&self) -> bool {
        !self.negative && !Wide::is_zero(self) && !self.is_nan()
    }

    #[inline]
    fn is_zero(&self) -> bool {
        Wide::is_zero(self)
    }

    #[inline]
    fn unit(&self) -> f64 {
        f64::from_bits((1023 - 64 * N as u64) << 52)
    }

    #[inline]
    fn in_roundoffs(&self) -> f64 {
        self.scaled(64 * N as i32).nearest_double().abs()
    }
}

/// Both systems round: the bound of the longer number, and the rounding to a double.
impl<const N: usize> Reads<Estimate<Wide<N>>> for Estimate<f64> {
    fn read(number: Estimate<Wide<N>>) -> Self {
        let (bound, value) = (number.bound(), number.to_f64());
        Estimate::new(value, bound / value.unit() * (1.0 + f64::EPSILON) + value.abs())
    }

    fn give(&self, (): &()) -> Estimate<Wide<N>> {
        match spelled_as(*self.value(), self.spelled_as()) {
            Some(number) => Estimate::from_number(&number, &()),
            None => Estimate::exact(Wide::from(*self.value())),
        }
    }
}
