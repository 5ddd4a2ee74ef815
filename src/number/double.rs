//! Double precision numbers.

use std::cmp::Ordering;

use super::{Analytic, Number, Open, Rounded, Scalar};

/// Returns the shortest decimal that rounds to `x`, with an exponent where plain notation would need many zeros.
pub(crate) fn shortest(x: f64) -> String {
    if x == 0.0 || (1e-5..1e16).contains(&x.abs()) { x.to_string() } else { format!("{x:e}") }
}

impl Scalar for f64 {
    type Precision = ();

    fn from_number(number: &Number, _: &()) -> Self {
        number.to_f64()
    }

    fn precision(&self) {}

    #[inline]
    fn int(&self, n: i64) -> Self {
        n as f64
    }

    #[inline]
    fn double(&self, x: f64) -> Self {
        x
    }

    #[inline]
    fn try_sqrt(&self) -> Option<Self> {
        (*self >= 0.0).then(|| f64::sqrt(*self))
    }

    #[inline]
    fn to_f64(&self) -> f64 {
        *self
    }

    #[inline]
    fn roundoff(&self) -> Self {
        f64::EPSILON / 2.0
    }

    #[inline]
    fn floor_int(&self) -> Option<i64> {
        let floor = self.floor();
        (floor.abs() < 9.0e18).then_some(floor as i64)
    }

    #[inline]
    fn bits(&self) -> Option<u32> {
        Some(53)
    }

    fn is_finite(&self) -> bool {
        f64::is_finite(*self)
    }

    /// Returns the sign; equal for NaN.
    #[inline]
    fn sign(&self) -> Result<Ordering, Open> {
        Ok(self.partial_cmp(&0.0).unwrap_or(Ordering::Equal))
    }

    #[inline]
    fn compare(&self, other: &Self) -> Result<Ordering, Open> {
        Ok(self.partial_cmp(other).unwrap_or(Ordering::Equal))
    }

    /// Returns the decimal without trailing zeros.
    fn decimal(&self, digits: u32) -> String {
        // Every double has a decimal of 17 digits; the shortest text often has fewer.
        if digits >= 16 {
            return self.text();
        }
        let rounded = format!("{self:.*e}", digits.max(1) as usize - 1).parse().ok();
        shortest(rounded.filter(|rounded| f64::is_finite(*rounded)).unwrap_or(*self))
    }

    fn as_double(&self) -> Option<f64> {
        Some(*self)
    }

    fn text(&self) -> String {
        // Display never uses an exponent; Debug does for very large and very small values.
        format!("{self:?}")
    }
}

macro_rules! elementary {
    ($($name:ident),*) => {$(
        #[inline]
        fn $name(&self) -> Self {
            f64::$name(*self)
        }
    )*};
}

impl Analytic for f64 {
    elementary!(sqrt, exp, exp_m1, ln, ln_1p, cos, sin);

    #[inline]
    fn pi(&self) -> Self {
        std::f64::consts::PI
    }
}

impl Rounded for f64 {
    #[inline]
    fn unit(&self) -> f64 {
        f64::EPSILON / 2.0
    }

    #[inline]
    fn in_roundoffs(&self) -> f64 {
        self.abs() / (f64::EPSILON / 2.0)
    }
}
