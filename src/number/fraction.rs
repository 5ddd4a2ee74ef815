//! Exact fractions.

use rug::float::Round;
use rug::ops::DivRounding;
use rug::{Float, Integer, Rational};

use super::{Number, Scalar};

impl Scalar for Rational {
    const EXACT: bool = true;
    type Precision = ();

    fn from_number(number: &Number, _: &()) -> Self {
        number.to_rational()
    }

    fn precision(&self) {}

    fn int(&self, n: i64) -> Self {
        Rational::from(n)
    }

    fn double(&self, x: f64) -> Self {
        Rational::from_f64(x).unwrap_or_default()
    }

    fn try_sqrt(&self) -> Option<Self> {
        if self.cmp0().is_lt() || !self.numer().is_perfect_square() || !self.denom().is_perfect_square() {
            return None;
        }
        Some(Rational::from((self.numer().clone().sqrt(), self.denom().clone().sqrt())))
    }

    fn to_f64(&self) -> f64 {
        // Rational::to_f64 truncates; a Float rounds to nearest.
        Float::with_val_round(53, self, Round::Nearest).0.to_f64()
    }

    fn log2_roundoff(&self) -> f64 {
        f64::NEG_INFINITY
    }

    fn floor_int(&self) -> Option<i64> {
        Integer::from(self.numer().div_floor(self.denom())).to_i64()
    }

    fn is_finite(&self) -> bool {
        true
    }

    fn text(&self) -> String {
        self.to_string()
    }

    fn zero(&self) -> Self {
        Rational::new()
    }

    fn is_negative(&self) -> bool {
        self.cmp0().is_lt()
    }

    fn is_positive(&self) -> bool {
        self.cmp0().is_gt()
    }

    fn is_zero(&self) -> bool {
        self.cmp0().is_eq()
    }
}
