//! Exact fractions.

use std::cmp::Ordering;

use super::radical::square_factor;
use super::rational::{self, Integer, Rational};
use super::{Bounded, Estimate, Number, Open, Reads, Scalar, spelled_as};

/// Upper limit of the square factors that a printed surd moves out of its root.
const SMALL_FACTOR: u32 = 10_000;

impl Scalar for Rational {
    type Precision = ();

    fn from_number(number: &Number, _: &()) -> Self {
        number.to_rational()
    }

    fn precision(&self) {}

    fn int(&self, n: i64) -> Self {
        Rational::from(n)
    }

    fn double(&self, x: f64) -> Self {
        debug_assert!(x.is_finite(), "found {x}, expected a fraction");
        Rational::try_from(x).unwrap_or_default()
    }

    fn try_sqrt(&self) -> Option<Self> {
        let (p, q) = rational::parts(self);
        Some(rational::quotient(rational::exact_root(&p)?, rational::exact_root(&q)?))
    }

    fn to_f64(&self) -> f64 {
        rational::nearest_double(self)
    }

    fn floor_int(&self) -> Option<i64> {
        rational::floor(self)
    }

    fn sign(&self) -> Result<Ordering, Open> {
        Ok(rational::sign(self))
    }

    fn compare(&self, other: &Self) -> Result<Ordering, Open> {
        Ok(self.cmp(other))
    }

    fn text(&self) -> String {
        self.to_string()
    }

    fn surd(&self, plus: bool, square: &Self) -> String {
        // √(n/d) = √(n d)/d; squares of small primes move out of the root.
        let (numerator, denominator) = rational::parts(square);
        let (zero, one) = (Integer::from(0), Integer::from(1));
        let radicand = numerator * &denominator;
        let root = square_factor(&radicand, SMALL_FACTOR);
        let radicand = if root == zero { one.clone() } else { radicand / (root.clone() * &root) };
        let (times, over) = rational::parts(&rational::quotient(root, denominator));
        let times = if times == one { String::new() } else { times.to_string() };
        let over = if over == one { String::new() } else { format!("/{over}") };
        let root = format!("{times}√{radicand}{over}");
        match (rational::sign(self).is_eq(), plus) {
            (true, true) => root,
            (true, false) => format!("−{root}"),
            (false, _) => format!("{self} {} {root}", if plus { '+' } else { '−' }),
        }
    }
}

impl Bounded for Rational {
    fn halved(self) -> Self {
        rational::half(self)
    }
}

/// Rounds once.
impl Reads<Rational> for Estimate<f64> {
    fn read(number: Rational) -> Self {
        let value = Scalar::to_f64(&number);
        let exact = Rational::try_from(value).is_ok_and(|value| value == number);
        if exact { Estimate::exact(value) } else { Estimate::rounded(value, 1.0) }
    }

    fn give(&self, (): &()) -> Rational {
        let exactly = || Rational::try_from(*self.value()).unwrap_or_default();
        spelled_as(*self.value(), self.spelled_as()).map_or_else(exactly, |number| number.to_rational())
    }
}

#[cfg(test)]
#[path = "tests/fraction.rs"]
mod tests;
