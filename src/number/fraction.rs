//! Exact fractions.

use std::cmp::Ordering;

use super::radical::square_factor;
use super::rational::{self, Integer, Rational};
use super::{Bounded, Estimate, Number, Open, Reads, Scalar, Spelling};

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

/// Maximum denominator of a simple fraction: no two such fractions are as close as neighbouring doubles.
const MOST_DENOMINATOR: i64 = 10_000;

/// Returns the number that a double represents: the shortest decimal that rounds to it, or, if that decimal takes all
/// digits of a double, a simple fraction that rounds to it. `None` for NaN and infinities.
pub(super) fn spelled(x: f64) -> Option<Number> {
    let decimal = x.to_string();
    let digits = decimal.bytes().filter(u8::is_ascii_digit).count();
    let fraction = if digits > 15 { simple_fraction(x) } else { None };
    fraction.unwrap_or(decimal).parse().ok()
}

/// Returns the spelling of `number`, which rounds to `x`.
pub(super) fn spelling(x: f64, number: &Number) -> Spelling {
    let same = |other: Option<Number>| other.is_some_and(|other| other.compare(number).is_eq());
    let text = number.to_string();
    let mantissa = text.split(['e', 'E']).next().unwrap_or_default();
    // Every double represents a decimal with so few digits.
    let short = !text.contains('/') && mantissa.bytes().filter(u8::is_ascii_digit).count() <= 15;
    match short || same(x.to_string().parse().ok()) {
        true => Spelling::Decimal,
        false if same(spelled(x)) => Spelling::Fraction,
        false => Spelling::Near,
    }
}

/// Returns the number that a double represents if its spelling is known.
pub(crate) fn spelled_as(x: f64, spelling: Option<Spelling>) -> Option<Number> {
    match spelling {
        Some(Spelling::Decimal) => x.to_string().parse().ok(),
        _ => spelled(x),
    }
}

/// Returns the first convergent of the continued fraction of `x` that rounds to it, if its denominator is small.
fn simple_fraction(x: f64) -> Option<String> {
    let (mut rest, mut last, mut now) = (x.abs(), (0i64, 1i64), (1i64, 0i64));
    while rest < 1e15 {
        let whole = rest.floor();
        let next = |last: i64, now: i64| (whole as i64).checked_mul(now)?.checked_add(last);
        (last, now) = (now, (next(last.0, now.0)?, next(last.1, now.1)?));
        if now.1 > MOST_DENOMINATOR {
            return None;
        }
        if now.0 as f64 / now.1 as f64 == x.abs() {
            return Some(format!("{}{}/{}", if x < 0.0 { "-" } else { "" }, now.0, now.1));
        }
        rest = 1.0 / (rest - whole);
    }
    None
}

#[cfg(test)]
#[path = "tests/fraction.rs"]
mod tests;
