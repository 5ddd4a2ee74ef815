//! Floats of any number of bits as a number system of formulas.

use std::cmp::Ordering;

use super::float::{self, Constant, Float};
use super::spelling::spelled_as;
use super::{Analytic, Estimate, Number, Open, Reads, Rounded, Scalar, decimal};

impl Scalar for Float {
    /// Number of bits of the significand.
    type Precision = u32;

    fn from_number(number: &Number, precision: &u32) -> Self {
        Float::with_val(*precision, number.to_rational())
    }

    fn precision(&self) -> u32 {
        self.prec()
    }

    fn int(&self, n: i64) -> Self {
        Float::with_val(self.prec(), n)
    }

    fn double(&self, x: f64) -> Self {
        Float::with_val(self.prec(), x)
    }

    fn try_sqrt(&self) -> Option<Self> {
        (!self.is_sign_negative() || Float::is_zero(self)).then(|| Float::with_val(self.prec(), self.sqrt_ref()))
    }

    fn to_f64(&self) -> f64 {
        Float::to_f64(self)
    }

    fn roundoff(&self) -> Self {
        Float::with_val(self.prec(), 1) >> self.prec()
    }

    fn floor_int(&self) -> Option<i64> {
        float::floor(self)
    }

    fn bits(&self) -> Option<u32> {
        Some(self.prec())
    }

    fn is_finite(&self) -> bool {
        Float::is_finite(self)
    }

    /// Returns the sign; equal for NaN.
    fn sign(&self) -> Result<Ordering, Open> {
        Ok(self.cmp0().unwrap_or(Ordering::Equal))
    }

    fn compare(&self, other: &Self) -> Result<Ordering, Open> {
        Ok(self.partial_cmp(other).unwrap_or(Ordering::Equal))
    }

    fn decimal(&self, digits: u32) -> String {
        self.to_rational().map_or_else(|| self.to_string(), |value| decimal(&value, digits))
    }

    fn text(&self) -> String {
        self.to_string_radix(10, None)
    }
}

macro_rules! elementary {
    ($($name:ident: $of:ident),*) => {$(
        fn $name(&self) -> Self {
            Float::with_val(self.prec(), self.$of())
        }
    )*};
}

impl Analytic for Float {
    elementary!(sqrt: sqrt_ref, exp: exp_ref, exp_m1: exp_m1_ref, ln: ln_ref, ln_1p: ln_1p_ref);
    elementary!(cos: cos_ref, sin: sin_ref);

    fn pi(&self) -> Self {
        Float::with_val(self.prec(), Constant::Pi)
    }
}

impl Rounded for Float {
    fn unit(&self) -> f64 {
        (-f64::from(self.prec())).exp2().max(f64::MIN_POSITIVE)
    }

    fn in_roundoffs(&self) -> f64 {
        (self.clone() << self.prec()).to_f64().abs()
    }
}

/// Adds the bound of the longer number and the rounding to a double.
impl Reads<Estimate<Float>> for Estimate<f64> {
    fn read(number: Estimate<Float>) -> Self {
        let (bound, value) = (number.bound(), number.to_f64());
        Estimate::new(value, bound / value.unit() * (1.0 + f64::EPSILON) + value.abs())
    }

    fn give(&self, precision: &u32) -> Estimate<Float> {
        match spelled_as(*self.value(), self.spelled_as()) {
            Some(number) => Estimate::from_number(&number, precision),
            None => Estimate::exact(Float::with_val(*precision, self.value())),
        }
    }
}
