//! A long number with the bound of its own error, in the place of a rounded number.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Analytic, Answer, Estimate, Float, Interval, Number, Open, Reads, Rounded, Scalar};

/// A long number that an engine takes for a rounded one, comparing values, while the bound of its error is carried
/// beside it: so that one step of a run, evaluated on exact inputs, encloses what it should have given.
///
/// **Accuracy**: *within its own bound*, as [`Estimate`].
#[derive(Clone, Debug)]
pub struct Ball(Estimate<Float>);

/// What bounds in doubles may lose by their own roundings: 10⁷ of them in a row.
const SLACK: f64 = 1.0 + 1e-9;

impl Ball {
    /// The centre and the bound.
    pub(crate) fn estimate(&self) -> &Estimate<Float> {
        &self.0
    }
}

impl From<Estimate<Float>> for Ball {
    fn from(estimate: Estimate<Float>) -> Ball {
        Ball(estimate)
    }
}

impl PartialEq for Ball {
    fn eq(&self, other: &Self) -> bool {
        self.0.value() == other.0.value()
    }
}

impl PartialOrd for Ball {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.value().partial_cmp(other.0.value())
    }
}

impl Neg for Ball {
    type Output = Ball;
    fn neg(self) -> Ball {
        Ball(-self.0)
    }
}

macro_rules! forward {
    ($($trait:ident $method:ident),*) => {$(
        impl<'a> $trait<&'a Ball> for Ball {
            type Output = Ball;
            fn $method(self, other: &'a Ball) -> Ball {
                Ball(self.0.$method(&other.0))
            }
        }
        impl $trait for Ball {
            type Output = Ball;
            fn $method(self, other: Ball) -> Ball {
                Ball(self.0.$method(&other.0))
            }
        }
    )*};
}
forward!(Add add, Sub sub, Mul mul, Div div);

impl Scalar for Ball {
    type Precision = u32;

    fn from_number(number: &Number, precision: &u32) -> Self {
        Ball(Estimate::from_number(number, precision))
    }
    fn precision(&self) -> u32 {
        self.0.precision()
    }
    fn int(&self, n: i64) -> Self {
        Ball(self.0.int(n))
    }
    fn double(&self, x: f64) -> Self {
        Ball(self.0.double(x))
    }
    fn try_sqrt(&self) -> Option<Self> {
        self.0.try_sqrt().map(Ball)
    }
    fn to_f64(&self) -> f64 {
        self.0.to_f64()
    }
    fn roundoff(&self) -> Self {
        Ball(self.0.roundoff())
    }
    fn bits(&self) -> Option<u32> {
        self.0.bits()
    }
    /// That of the value; open where the value is zero and the number need not be.
    fn sign(&self) -> Result<Ordering, Open> {
        match self.0.value().cmp0() {
            Some(Ordering::Equal) if self.0.error() != 0.0 => Err(Open),
            order => order.ok_or(Open),
        }
    }
    fn floor_int(&self) -> Option<i64> {
        self.0.value().floor_int()
    }
    fn is_finite(&self) -> bool {
        self.0.is_finite()
    }
    fn text(&self) -> String {
        self.0.text()
    }
    fn square(&self) -> Self {
        Ball(self.0.square())
    }
    fn magnitude(&self) -> Self {
        Ball(self.0.magnitude())
    }
    fn zero(&self) -> Self {
        Ball(self.0.zero())
    }
    fn one(&self) -> Self {
        Ball(self.0.one())
    }
    fn widened(self, by: &Self) -> Self {
        Ball(self.0.widened(&by.0))
    }
}

macro_rules! elementary {
    ($($name:ident),*) => {$(
        fn $name(&self) -> Self {
            Ball(self.0.$name())
        }
    )*};
}

impl Analytic for Ball {
    elementary!(sqrt, exp, exp_m1, ln, ln_1p, cos, sin, pi);
}

impl Rounded for Ball {
    const ENCLOSES: bool = true;

    fn unit(&self) -> f64 {
        self.0.value().unit()
    }

    fn in_roundoffs(&self) -> f64 {
        self.0.value().in_roundoffs() + self.0.error()
    }

    fn most(&self) -> f64 {
        let size = self.to_f64().abs() * SLACK + self.0.bound();
        if size > 0.0 || self.0.value().is_zero() { size * SLACK } else { f64::MIN_POSITIVE }
    }

    fn take_bound(&mut self) -> f64 {
        let error = self.0.error() * SLACK;
        let value = std::mem::replace(&mut self.0, Estimate::exact(Float::new(2))).into_value();
        self.0 = Estimate::exact(value);
        error
    }

    fn give_bound(self, roundoffs: f64) -> Self {
        let error = self.0.error() + roundoffs;
        Ball(Estimate::new(self.0.into_value(), error))
    }
}

impl Answer for Ball {
    type Carried = Estimate<Ball>;

    fn carry(&self) -> Estimate<Ball> {
        Estimate::exact(self.clone())
    }

    fn exactly(&self) -> Estimate<Ball> {
        Estimate::exact(self.clone())
    }

    fn strip(carried: Estimate<Ball>) -> Ball {
        carried.into_value()
    }
}

/// Both bounds of an answer of an engine: its own, and what its evaluation has rounded.
impl Reads<Estimate<Ball>> for Interval {
    fn read(number: Estimate<Ball>) -> Self {
        let error = (number.error() + number.value().0.error()) * SLACK;
        let value = number.into_value().0.into_value();
        let bits = value.prec();
        let radius = Float::with_val(64, error) >> bits;
        if !radius.is_finite() {
            let all = Float::with_val(bits, rug::float::Special::Infinity);
            return Interval::between(-all.clone(), all);
        }
        let end = |sign: i32, round| {
            let radius = Float::with_val(64, &radius * sign);
            Float::with_val_round(bits, &value + &radius, round).0
        };
        Interval::between(end(-1, rug::float::Round::Down), end(1, rug::float::Round::Up))
    }

    fn give(&self, precision: &u32) -> Estimate<Ball> {
        let middle = Float::with_val(*precision, self.mid());
        let (down, up) = (Float::with_val(64, self.hi() - &middle), Float::with_val(64, &middle - self.lo()));
        let radius = if down > up { down } else { up };
        let roundoffs = (radius << *precision).to_f64() * SLACK;
        Estimate::exact(Ball(Estimate::new(middle, roundoffs.max(0.0))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_third_is_enclosed_and_its_bound_is_taken_once() {
        let mut third = Ball::from_number(&"1/3".parse().unwrap(), &80);
        let read = Interval::read(Estimate::exact(third.clone()));
        assert!(read.contains(&rug::Rational::from((1, 3))) && read.radius() < 1e-23 && read.radius() > 1e-26);
        assert!(third.take_bound() > 0.0 && third.take_bound() == 0.0);
        assert!(!Interval::read(Estimate::exact(third)).contains(&rug::Rational::from((1, 3))));
    }
}
