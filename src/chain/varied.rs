//! Exact numbers of a chain with the rates at which they change with one of its values.

use super::body::{Body, BodyMaterial, Points};
use crate::error::{Error, ProblemError, ProblemErrorKind as Kind};
use crate::number::{Bounded, Dual, Number, Rational, Scalar};

/// An exact number of a chain with its rate.
pub(super) type Given = Dual<Rational>;

/// A chain, or a part of one, beside that of the chain with one value greater. Numbers that carry a rate take over the
/// differences.
#[derive(Debug)]
pub(crate) struct Varied<'a, T: ?Sized> {
    pub(crate) now: &'a T,
    /// The same with one value greater: each number is greater by its rate.
    pub(crate) further: &'a T,
    /// Whether the value falls, so that the rates are negative.
    pub(crate) falls: bool,
}

impl<T: ?Sized> Clone for Varied<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: ?Sized> Copy for Varied<'_, T> {}

impl<'a, T: ?Sized> Varied<'a, T> {
    /// Returns a part of both chains.
    pub(super) fn part<U: ?Sized>(self, pick: impl Fn(&'a T) -> &'a U) -> Varied<'a, U> {
        self.with(pick(self.now), pick(self.further))
    }

    fn with<U: ?Sized>(self, now: &'a U, further: &'a U) -> Varied<'a, U> {
        Varied { now, further, falls: self.falls }
    }

    /// Returns a part that both chains have.
    pub(super) fn some<U: ?Sized>(self, pick: impl Fn(&'a T) -> Option<&'a U>) -> Option<Varied<'a, U>> {
        Some(self.with(pick(self.now)?, pick(self.further)?))
    }

    /// Returns an exact number that is computed from the part, with its rate.
    pub(super) fn number(self, value: impl Fn(&'a T) -> Rational) -> Given {
        let [now, further] = [self.now, self.further].map(value);
        let rate = if self.falls { now.clone() - further } else { further - &now };
        Dual::new(now, rate)
    }
}

impl<'a> Varied<'a, Number> {
    pub(super) fn given(self) -> Given {
        if self.now == self.further { Dual::constant(self.now.to_rational()) } else { self.number(Number::to_rational) }
    }
}

impl<'a> Varied<'a, Points> {
    pub(super) fn given(self) -> Vec<(Given, Given)> {
        let number = |now: &'a Number, further: &'a Number| self.with(now, further).given();
        if self.now.is_empty() {
            // Without points the value is zero everywhere.
            let from_zero = |value: &Number| {
                let rate = value.to_rational();
                Dual::new(Rational::default(), if self.falls { -rate } else { rate })
            };
            return self.further.iter().map(|(x, value)| (number(x, x), from_zero(value))).collect();
        }
        let pairs = self.now.iter().zip(self.further);
        pairs.map(|(now, further)| (number(&now.0, &further.0), number(&now.1, &further.1))).collect()
    }
}

impl<'a> Varied<'a, Body> {
    /// Returns the mass of a rigid body; `None` for a bar.
    pub(super) fn mass(self) -> Option<Varied<'a, Number>> {
        self.some(Body::rigid_mass)
    }

    /// Returns `Z²` and `c²`; zero and one for a rigid body.
    pub(super) fn squares(self) -> [Given; 2] {
        use BodyMaterial::{Elastic, Impedance};
        let number = |now: &'a Number, further: &'a Number| self.with(now, further).given();
        match (&self.now.material, &self.further.material) {
            (Impedance { wave_speed: c, impedance: z }, Impedance { wave_speed: further_c, impedance: further_z }) => {
                [number(z, further_z), number(c, further_c)].map(|number| number.square())
            }
            (Impedance { .. } | Elastic { .. }, Impedance { .. } | Elastic { .. }) => {
                let [modulus, density, area] = [0, 1, 2].map(|k| self.number(|body| body.elastic_numbers()[k].clone()));
                [area.square() * &modulus * &density, modulus / density]
            }
            _ => self.now.squares().map(Dual::constant),
        }
    }
}

/// Converts an exact number with its rate; each of both is exact if it is a double, and rounded once if it is short
/// enough for a [`Number`].
///
/// **Errors**: [`Kind::OutOfRange`] if one of both is below 1e-300 or above 1e300.
pub(super) fn lift<N: Bounded>(x: &Given, precision: &N::Precision) -> Result<N, Error> {
    let value = lifted::<N>(x.value(), precision)?;
    match x.rate() {
        Some(rate) if *rate != Rational::default() => Ok(value.with_rate(&lifted(rate, precision)?)),
        _ => Ok(value),
    }
}

fn lifted<N: Bounded>(x: &Rational, precision: &N::Precision) -> Result<N, Error> {
    if let Some(number) = Number::of_rational(x) {
        let near = N::from_number(&number, precision);
        let double = Scalar::to_f64(x);
        let is_exact = near.roundoffs() > 0.0 && Scalar::double(x, double) == *x;
        return Ok(if is_exact { near.double(double) } else { near });
    }
    // p/q = (P/Q) 10ᵏ, where P and Q have the digits of p and q with a point after the first.
    let text = x.to_string();
    let (p, q) = text.split_once('/').unwrap_or((&text, "1"));
    let (sign, p) = p.strip_prefix('-').map_or(("", p), |p| ("-", p));
    let spelled = |text: String| text.parse::<Number>().map(|number| N::from_number(&number, precision));
    let mantissa = |sign: &str, digits: &str| spelled(format!("{sign}{}.{}", &digits[..1], &digits[1..]));
    let power = spelled(format!("1e{}", p.len() as i64 - q.len() as i64));
    match (mantissa(sign, p), mantissa("", q), power) {
        (Ok(p), Ok(q), Ok(power)) => Ok(p / &q * power),
        _ => {
            let found = format!("a ratio of numbers of {} and {} digits", p.len(), q.len());
            Err(ProblemError::new(Kind::OutOfRange, "body", found, "ratios between 1e-300 and 1e300").into())
        }
    }
}

/// Returns the square root of an exact number.
pub(super) fn root<N: Bounded>(quantity: &'static str, square: &Given, precision: &N::Precision) -> Result<N, Error> {
    if let Some(root) = square.try_sqrt() {
        return lift(&root, precision);
    }
    let irrational = || Error::Irrational { quantity, square: square.value().to_string() };
    lift::<N>(square, precision)?.try_sqrt().ok_or_else(irrational)
}
