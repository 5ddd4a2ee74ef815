//! Exact fractions.

use std::cmp::Ordering;

use rug::float::Round;
use rug::ops::DivRounding;
use rug::{Float, Integer, Rational};

use super::{Answer, Bounded, Number, Open, Scalar};

/// Square factors below this leave the root of a surd that is printed.
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

    fn roundoff(&self) -> Self {
        Rational::new()
    }

    fn floor_int(&self) -> Option<i64> {
        Integer::from(self.numer().div_floor(self.denom())).to_i64()
    }

    fn bits(&self) -> Option<u32> {
        None
    }

    fn is_finite(&self) -> bool {
        true
    }

    fn sign(&self) -> Result<Ordering, Open> {
        Ok(self.cmp0())
    }

    fn compare(&self, other: &Self) -> Result<Ordering, Open> {
        Ok(self.cmp(other))
    }

    fn text(&self) -> String {
        self.to_string()
    }

    fn surd(&self, plus: bool, square: &Self) -> String {
        // √(n/d) = √(n d)/d, and squares of small primes leave the root.
        let mut radicand = Integer::from(square.numer() * square.denom());
        let mut factor = Rational::from((1, square.denom()));
        let mut prime = Integer::from(2);
        while prime < SMALL_FACTOR && Integer::from(prime.square_ref()) <= radicand {
            let square = Integer::from(prime.square_ref());
            while radicand.is_divisible(&square) {
                radicand.div_exact_mut(&square);
                factor *= &prime;
            }
            prime += 1;
        }
        if radicand.is_perfect_square() {
            factor *= radicand.sqrt();
            radicand = Integer::from(1);
        }
        let times = if *factor.numer() == 1 { String::new() } else { factor.numer().to_string() };
        let over = if *factor.denom() == 1 { String::new() } else { format!("/{}", factor.denom()) };
        let root = format!("{times}√{radicand}{over}");
        match (self.cmp0().is_eq(), plus) {
            (true, true) => root,
            (true, false) => format!("−{root}"),
            (false, _) => format!("{self} {} {root}", if plus { '+' } else { '−' }),
        }
    }

    fn zero(&self) -> Self {
        Rational::new()
    }
}

impl Bounded for Rational {
    fn halved(self) -> Self {
        self >> 1u32
    }
}

impl Answer for Rational {
    type Carried = Rational;

    fn carry(&self) -> Rational {
        self.clone()
    }

    fn strip(carried: Rational) -> Rational {
        carried
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surds_are_printed_in_lowest_terms() {
        let text = |a: (i32, i32), plus, b: (i32, i32)| Rational::from(a).surd(plus, &Rational::from(b));
        assert_eq!(text((3, 1), true, (2, 1)), "3 + √2");
        assert_eq!(text((5, 2), false, (12, 1)), "5/2 − 2√3");
        assert_eq!(text((0, 1), true, (1, 2)), "√2/2");
        assert_eq!(text((1, 1), true, (8, 9)), "1 + 2√2/3");
    }
}
