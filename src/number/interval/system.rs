//! Enclosures as a number system of formulas.

use std::cmp::Ordering;
use std::fmt;

use super::super::float::{self, Constant, Float, Round, down, rounded, up};
use super::super::radical::Radical;
use super::super::rational;
use super::super::{Analytic, Bounded, Estimate, Number, Open, Rational, Reads, Scalar, show};
use super::{Inside, Interval, IntervalPrecision};

/// Prints the digits that both ends prove, up to the requested precision; both ends if they prove no digit.
impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let held = (f64::from(self.lo.prec()) * std::f64::consts::LOG10_2) as u32;
        let asked = f.precision().and_then(|digits| u32::try_from(digits).ok()).unwrap_or(held);
        match show(self, asked.clamp(1, held)) {
            text if text == "0" && self.vanishes() != Ok(true) => f.write_str(&self.text()),
            text => f.write_str(&text),
        }
    }
}

impl Scalar for Interval {
    type Precision = IntervalPrecision;

    fn from_number(number: &Number, precision: &IntervalPrecision) -> Self {
        Interval::rational(&number.to_rational(), *precision)
    }

    fn precision(&self) -> IntervalPrecision {
        IntervalPrecision { bits: self.lo.prec(), exact: !matches!(self.inside, Inside::Off) }
    }

    fn int(&self, n: i64) -> Self {
        let bits = self.lo.prec();
        let inside = self.inside.other(|| Radical::rational(Rational::from(n)));
        Interval { lo: down(bits, n), hi: up(bits, n), inside }
    }

    fn double(&self, x: f64) -> Self {
        let bits = self.lo.prec();
        let inside = self.inside.other(|| Rational::try_from(x).ok().and_then(Radical::rational));
        Interval::checked(down(bits, x), up(bits, x), inside)
    }

    /// Returns the square root. The part below zero of an interval around zero is dropped, see [`Analytic::sqrt`].
    fn try_sqrt(&self) -> Option<Self> {
        match Scalar::sign(self) {
            Ok(Ordering::Less) => None,
            Ok(Ordering::Equal) => Some(self.zero()),
            _ => Some(self.sqrt()),
        }
    }

    /// Returns the end farther from zero, rounded away from zero, as bounds require.
    fn to_f64(&self) -> f64 {
        if self.hi.cmp_abs(&self.lo) == Some(Ordering::Less) {
            self.lo.to_f64_round(Round::AwayZero)
        } else {
            self.hi.to_f64_round(Round::AwayZero)
        }
    }

    fn roundoff(&self) -> Self {
        let unit = Float::with_val(self.lo.prec(), 1) >> self.lo.prec();
        Interval { lo: unit.clone(), hi: unit, inside: Inside::Off }
    }

    fn bits(&self) -> Option<u32> {
        Some(self.lo.prec())
    }

    fn sign(&self) -> Result<Ordering, Open> {
        match (self.lo.cmp0(), self.hi.cmp0()) {
            (Some(Ordering::Greater), _) => Ok(Ordering::Greater),
            (_, Some(Ordering::Less)) => Ok(Ordering::Less),
            (Some(Ordering::Equal), Some(Ordering::Equal)) => Ok(Ordering::Equal),
            _ => self.exact_sign().ok_or(Open),
        }
    }

    fn compare(&self, other: &Self) -> Result<Ordering, Open> {
        if self.hi < other.lo {
            return Ok(Ordering::Less);
        }
        if self.lo > other.hi {
            return Ok(Ordering::Greater);
        }
        if self.lo == self.hi && other.lo == other.hi && self.lo == other.lo {
            return Ok(Ordering::Equal);
        }
        match (&self.inside, &other.inside) {
            (Inside::Known(a), Inside::Known(b)) => a.compare(b).ok_or(Open),
            _ => Err(Open),
        }
    }

    fn positive(&self) -> Result<bool, Open> {
        if self.hi.cmp0().is_some_and(Ordering::is_le) { Ok(false) } else { Ok(Scalar::sign(self)?.is_gt()) }
    }

    fn negative(&self) -> Result<bool, Open> {
        if self.lo.cmp0().is_some_and(Ordering::is_ge) { Ok(false) } else { Ok(Scalar::sign(self)?.is_lt()) }
    }

    fn below(&self, other: &Self) -> Result<bool, Open> {
        if self.lo >= other.hi { Ok(false) } else { Ok(self.compare(other)?.is_lt()) }
    }

    fn log2_error(&self) -> f64 {
        let radius = self.radius();
        if !radius.is_finite() {
            return f64::INFINITY;
        }
        // The exponent is kept apart because the radius of a long number is below the range of doubles.
        let (mantissa, exponent) = radius.to_f64_exp_round(Round::Up);
        mantissa.log2() + f64::from(exponent)
    }

    fn floor_int(&self) -> Option<i64> {
        let (low, high) = (float::floor(&self.lo)?, float::floor(&self.hi)?);
        if low == high {
            return Some(low);
        }
        if let Inside::Known(number) = &self.inside
            && let Some(exact) = number.floor()
        {
            return Some(exact);
        }
        None
    }

    fn is_finite(&self) -> bool {
        self.lo.is_finite() && self.hi.is_finite()
    }

    /// Returns the decimal of the middle.
    fn decimal(&self, digits: u32) -> String {
        self.mid().decimal(digits)
    }

    fn ends(&self, digits: u32) -> Option<[String; 2]> {
        let text = |end: &Float, round| end.to_string_radix_round(10, Some(digits as usize + 10), round);
        Some([text(&self.lo, Round::Down), text(&self.hi, Round::Up)])
    }

    fn proved(&self, digits: u32) -> u32 {
        let agree = |digits: &u32| self.lo.decimal(*digits) == self.hi.decimal(*digits);
        // Ends on both sides of 0.25 do not agree in one digit, but in two.
        (1..=digits).rev().chain(digits + 1..digits + 3).find(agree).unwrap_or(0)
    }

    fn text(&self) -> String {
        let ends = [(&self.lo, Round::Down), (&self.hi, Round::Up)];
        let [lo, hi] = ends.map(|(end, round)| end.to_string_radix_round(10, Some(17), round));
        if lo == hi { lo } else { format!("[{lo}, {hi}]") }
    }

    fn alike(&self, other: &Self) -> bool {
        self.lo == other.lo && self.hi == other.hi
    }

    fn widened(self, by: &Self) -> Self {
        let mut by = by.clone().magnitude();
        by.lo = -by.hi.clone();
        by.inside = self.inside.other(|| None);
        self + by
    }

    fn width(&self) -> Self {
        let width = up(self.lo.prec(), &self.hi - &self.lo);
        let inside = self.inside.map(|_| None);
        Interval::checked(width.clone(), width, inside)
    }

    fn magnitude(&self) -> Self {
        if self.lo.cmp0() != Some(Ordering::Less) {
            return self.clone();
        }
        if self.hi.cmp0() != Some(Ordering::Greater) {
            return -self.clone();
        }
        let low = -self.lo.clone();
        let hi = if low > self.hi { low } else { self.hi.clone() };
        let inside = self
            .inside
            .map(|number| Some(if number.sign()? == Ordering::Less { number.neg() } else { number.clone() }));
        Interval { lo: Float::new(self.lo.prec()), hi, inside }
    }

    fn square(&self) -> Self {
        let size = self.magnitude();
        let bits = size.lo.prec();
        let inside = size.inside.with(&size.inside, Radical::mul);
        Interval::checked(down(bits, size.lo.square_ref()), up(bits, size.hi.square_ref()), inside)
    }

    fn larger(self, other: Self) -> Self {
        if self.lo >= other.hi {
            return self;
        }
        if other.lo >= self.hi {
            return other;
        }
        let inside = self.inside.with(&other.inside, |a, b| match a.compare(b)? {
            Ordering::Less => Some(b.clone()),
            _ => Some(a.clone()),
        });
        let lo = if self.lo > other.lo { self.lo } else { other.lo };
        let hi = if self.hi > other.hi { self.hi } else { other.hi };
        Interval { lo, hi, inside }
    }
}

macro_rules! rising {
    ($($name:ident: $of:ident),*) => {$(
        fn $name(&self) -> Self {
            let (bits, inside) = (self.lo.prec(), self.inside.map(|_| None));
            Interval::checked(down(bits, self.lo.$of()), up(bits, self.hi.$of()), inside)
        }
    )*};
}

impl Analytic for Interval {
    /// Returns the square root of a number known to be nonnegative; the part of the interval below zero is dropped.
    fn sqrt(&self) -> Self {
        let bits = self.lo.prec();
        let zero = Float::new(bits);
        let lo = if self.lo.is_sign_negative() { zero } else { down(bits, self.lo.sqrt_ref()) };
        let known = self.lo.cmp0().is_some_and(Ordering::is_ge) || self.exact_sign().is_some_and(Ordering::is_ge);
        let inside = self.inside.map(|number| if known { number.sqrt() } else { None });
        Interval::checked(lo, up(bits, self.hi.sqrt_ref()), inside)
    }
    rising!(exp: exp_ref, exp_m1: exp_m1_ref, ln: ln_ref, ln_1p: ln_1p_ref);
    fn cos(&self) -> Self {
        self.lipschitz(|x, round| rounded(x.prec(), x.cos_ref(), round))
    }
    fn sin(&self) -> Self {
        self.lipschitz(|x, round| rounded(x.prec(), x.sin_ref(), round))
    }
    fn pi(&self) -> Self {
        let bits = self.lo.prec();
        let inside = self.inside.map(|_| None);
        Interval { lo: down(bits, Constant::Pi), hi: up(bits, Constant::Pi), inside }
    }
}

impl Bounded for Interval {
    fn centred(&self) -> (Self, Self) {
        if self.lo == self.hi {
            return (self.clone(), self.zero());
        }
        let (mid, bits) = (self.mid(), self.lo.prec());
        let radius = up(bits, &self.hi - &mid).max(&up(bits, &mid - &self.lo));
        let point = |x: Float| Interval::checked(x.clone(), x, self.inside.map(|_| None));
        (point(mid), point(radius))
    }

    fn same(&self, other: &Self) -> bool {
        let points = self.lo == self.hi && other.lo == other.hi && self.lo == other.lo;
        match (&self.inside, &other.inside) {
            _ if points => true,
            (Inside::Known(a), Inside::Known(b)) => a.sub(b).is_some_and(|difference| difference.vanishes()),
            _ => false,
        }
    }

    fn halved(mut self) -> Self {
        self.lo >>= 1;
        self.hi >>= 1;
        let inside = self.inside.map(|number| number.scaled(&rational::half(Rational::from(1))));
        Interval { inside, ..self }
    }

    fn with_identity(mut self) -> Self {
        if matches!(self.inside, Inside::Lost) {
            self.inside = Inside::Known(Box::new(Radical::named()));
        }
        self
    }

    fn or_exactly(self, other: impl FnOnce() -> Self) -> Self {
        // A quotient by a number that may be zero has no finite ends, even if it is known exactly.
        let lost = matches!(self.inside, Inside::Lost);
        if !lost && self.is_finite() {
            return self;
        }
        let other = other();
        match self.meet(&other) {
            Some(both) => Interval { inside: if lost { other.inside } else { self.inside }, ..both },
            // No number is in both: nothing is known.
            None => Interval::everything(self.lo.prec()),
        }
    }

    fn without_exact(self) -> Self {
        Interval { inside: Inside::Off, ..self }
    }
}

/// Reads the middle with the radius and one rounding as its bound, the form in which every long number is printed.
impl Reads<Interval> for Estimate<Float> {
    fn read(number: Interval) -> Self {
        let near = number.estimate(number.lo.prec());
        let error = near.error() + near.to_f64().abs();
        Estimate::new(near.into_value(), error)
    }

    fn give(&self, precision: &IntervalPrecision) -> Interval {
        let rational = self.value().to_rational().unwrap_or(Rational::from(0));
        Interval::rational(&rational, *precision)
    }
}

/// Encloses the numbers within the bound.
impl Reads<Estimate<Float>> for Interval {
    fn read(number: Estimate<Float>) -> Self {
        Interval::within(&number)
    }

    fn give(&self, precision: &u32) -> Estimate<Float> {
        self.estimate(*precision)
    }
}

/// Reads the middle with the radius as its bound.
impl Reads<Interval> for Estimate<f64> {
    fn read(number: Interval) -> Self {
        Estimate::<f64>::read(Estimate::<Float>::read(number))
    }

    fn give(&self, precision: &IntervalPrecision) -> Interval {
        Interval::rational(&Reads::<Rational>::give(self, &()), *precision)
    }
}
