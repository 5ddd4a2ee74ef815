//! Enclosures: intervals with ends of any number of bits, rounded outwards.
//!
//! A comparison of intervals has three answers. The third is the error [`Open`](super::Open): the caller handles it, or
//! passes it on to code that repeats the computation with more bits.

mod system;

use std::cmp::Ordering;
use std::ops::Neg;

use super::float::{self, Float, Round, down, rounded, up};
use super::radical::Radical;
use super::{Estimate, Rational};

/// Precision of an [`Interval`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IntervalPrecision {
    /// Bits of the significands of both ends.
    pub bits: u32,
    /// Whether the interval carries the exact number inside, made of fractions and square roots, as long as it is
    /// short. The exact number decides coincidences that no interval can decide.
    pub exact: bool,
}

impl IntervalPrecision {
    /// Returns the precision of intervals alone.
    pub fn bits(bits: u32) -> Self {
        IntervalPrecision { bits, exact: false }
    }

    /// Returns the precision of intervals with the exact number inside while it is known.
    pub fn with_exact(bits: u32) -> Self {
        IntervalPrecision { bits, exact: true }
    }
}

/// The exact number inside an interval.
#[derive(Clone, Debug)]
enum Inside {
    /// No exact number is requested.
    Off,
    /// The exact number is not made of fractions and square roots, or too long.
    Lost,
    Known(Box<Radical>),
}

/// A closed interval from `lo` to `hi` that contains the true number.
///
/// **Accuracy**: *enclosure*: every operation rounds its ends outwards.
///
/// A comparison that the ends do not decide is [`Open`](super::Open), unless exact numbers decide it.
#[derive(Clone, Debug)]
pub struct Interval {
    lo: Float,
    hi: Float,
    inside: Inside,
}

impl Inside {
    fn of(number: Option<Radical>) -> Self {
        number.map_or(Inside::Lost, |number| Inside::Known(Box::new(number)))
    }

    /// Returns another number, if exact numbers are requested.
    fn other(&self, number: impl FnOnce() -> Option<Radical>) -> Self {
        if matches!(self, Inside::Off) { Inside::Off } else { Inside::of(number()) }
    }

    fn map(&self, f: impl FnOnce(&Radical) -> Option<Radical>) -> Self {
        match self {
            Inside::Known(number) => Inside::of(f(number)),
            Inside::Lost => Inside::Lost,
            Inside::Off => Inside::Off,
        }
    }

    fn with(&self, other: &Self, f: impl FnOnce(&Radical, &Radical) -> Option<Radical>) -> Self {
        match (self, other) {
            (Inside::Known(a), Inside::Known(b)) => Inside::of(f(a, b)),
            (Inside::Off, _) | (_, Inside::Off) => Inside::Off,
            _ => Inside::Lost,
        }
    }
}

impl Interval {
    /// Returns the interval from `lo` to `hi`; the whole line if an end is NaN.
    fn checked(lo: Float, hi: Float, inside: Inside) -> Self {
        if lo.is_nan() || hi.is_nan() {
            return Interval { inside, ..Interval::everything(lo.prec()) };
        }
        if matches!(&inside, Inside::Known(number) if number.vanishes()) {
            let zero = Float::new(lo.prec());
            return Interval { lo: zero.clone(), hi: zero, inside };
        }
        Interval { lo, hi, inside }
    }

    pub(crate) fn everything(bits: u32) -> Self {
        let [lo, hi] = [f64::NEG_INFINITY, f64::INFINITY].map(|end| Float::with_val(bits, end));
        Interval { lo, hi, inside: Inside::Off }
    }

    /// Returns the interval from `lo` to `hi`.
    ///
    /// **Errors**: the whole line from −∞ to ∞ if an end is NaN or the ends are in the wrong order.
    pub fn between(lo: Float, hi: Float) -> Self {
        if lo > hi { Interval::everything(lo.prec()) } else { Interval::checked(lo, hi, Inside::Off) }
    }

    /// Encloses a fraction. **Accuracy**: *enclosure* of one unit in the last place, a point if the fraction fits.
    pub fn rational(x: &Rational, precision: IntervalPrecision) -> Self {
        let IntervalPrecision { bits, exact } = precision;
        let inside = if exact { Inside::of(Radical::rational(x.clone())) } else { Inside::Off };
        Interval { lo: down(bits, x), hi: up(bits, x), inside }
    }

    /// Returns the lower end: the true number is not smaller.
    ///
    /// ```
    /// let rod = dalembert::Problem::builder().length(1).wave_speed(3).impact_speed(1).build()?;
    /// let history = rod.certified(20)?;
    /// // t_b = 2L/c = 2/3, which no binary number is.
    /// let end = history.contacts()[0].release.clone().unwrap();
    /// let truth = dalembert::Rational::from(2) / dalembert::Rational::from(3);
    /// assert!(*end.lo() < truth && *end.hi() > truth);
    /// assert_eq!(format!("{end:.20}"), "0.66666666666666666667");
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn lo(&self) -> &Float {
        &self.lo
    }

    /// Returns the upper end: the true number is not greater.
    pub fn hi(&self) -> &Float {
        &self.hi
    }

    /// Returns a number in the middle, for starting values and pictures.
    pub fn mid(&self) -> Float {
        let bits = self.lo.prec();
        let mut mid = Float::with_val(bits + 1, &self.lo + &self.hi);
        mid >>= 1;
        mid.set_prec(bits);
        mid
    }

    /// Returns an upper bound of half the width.
    pub fn radius(&self) -> Float {
        up(53, &self.hi - &self.lo) / 2u32
    }

    /// Returns whether the interval contains `x`.
    pub fn contains(&self, x: &Rational) -> bool {
        self.lo <= *x && self.hi >= *x
    }

    /// Intersects two enclosures of the same number; `None` if they are disjoint, which proves one of them wrong.
    pub fn meet(&self, other: &Self) -> Option<Self> {
        let lo = if self.lo >= other.lo { &self.lo } else { &other.lo };
        let hi = if self.hi <= other.hi { &self.hi } else { &other.hi };
        (lo <= hi).then(|| Interval { lo: lo.clone(), hi: hi.clone(), inside: self.inside.clone() })
    }

    /// Returns the middle in this many bits, with a bound of its distance from the true number.
    pub(crate) fn estimate(&self, bits: u32) -> Estimate<Float> {
        let middle = Float::with_val(bits, self.mid());
        let far = |end: &Float| rounded(64, end - &middle, Round::AwayZero).abs();
        let radius = far(&self.lo).max(&far(&self.hi)) << bits;
        let error = if radius.is_finite() { radius.to_f64_round(Round::Up) } else { f64::INFINITY };
        Estimate::new(middle, error)
    }

    /// Encloses all numbers within the bound of `x`. The factor and the summand cover the rounding of doubles.
    pub(crate) fn within(x: &Estimate<Float>) -> Self {
        let (middle, bits) = (x.value(), x.value().prec());
        let radius = Float::with_val(64, x.error() * (1.0 + 1e-9) + 1e-300) >> bits;
        if x.error() == 0.0 {
            return Interval::between(middle.clone(), middle.clone());
        } else if !radius.is_finite() {
            return Interval::everything(bits);
        }
        Interval::between(down(bits, middle - &radius), up(bits, middle + &radius))
    }

    fn exact_sign(&self) -> Option<Ordering> {
        match &self.inside {
            Inside::Known(number) => number.sign(),
            _ => None,
        }
    }

    /// Encloses `f` by its value at the middle, plus or minus the radius, for functions with `|f′| ≤ 1` and `|f| ≤ 1`.
    fn lipschitz(&self, f: impl Fn(&Float, Round) -> Float) -> Self {
        let bits = self.lo.prec();
        let (mid, one) = (self.mid(), Float::with_val(bits, 1));
        let radius = up(bits, &self.hi - &mid).max(&up(bits, &mid - &self.lo));
        let (lo, hi) = (down(bits, &f(&mid, Round::Down) - &radius), up(bits, &f(&mid, Round::Up) + &radius));
        let inside = self.inside.map(|_| None);
        if lo.is_nan() || hi.is_nan() {
            return Interval { lo: -one.clone(), hi: one, inside };
        }
        let within = |end: Float| end.max(&-one.clone()).min(&one);
        Interval { lo: within(lo), hi: within(hi), inside }
    }

    fn plus(self, other: &Interval) -> Interval {
        let inside = self.inside.with(&other.inside, Radical::add);
        let (lo, hi) = (float::sum(self.lo, &other.lo, Round::Down), float::sum(self.hi, &other.hi, Round::Up));
        Interval::checked(lo, hi, inside)
    }

    fn minus(self, other: &Interval) -> Interval {
        let inside = self.inside.with(&other.inside, Radical::sub);
        let (lo, hi) =
            (float::difference(self.lo, &other.hi, Round::Down), float::difference(self.hi, &other.lo, Round::Up));
        Interval::checked(lo, hi, inside)
    }

    fn times(self, other: &Interval) -> Interval {
        let bits = self.lo.prec();
        let inside = self.inside.with(&other.inside, Radical::mul);
        let (a, b, c, d) = (&self.lo, &self.hi, &other.lo, &other.hi);
        let positive = |x: &Float| x.cmp0() != Some(Ordering::Less);
        let negative = |x: &Float| x.cmp0() != Some(Ordering::Greater);
        if self.lo.is_infinite() || self.hi.is_infinite() || c.is_infinite() || d.is_infinite() {
            return Interval { inside, ..Interval::everything(bits) };
        }
        // The signs select the ends of both factors that give each end of the product.
        let (lo, hi) = match (positive(a), negative(b), positive(c), negative(d)) {
            (true, _, true, _) => (down(bits, a * c), up(bits, b * d)),
            (true, _, _, true) => (down(bits, b * c), up(bits, a * d)),
            (true, _, _, _) => (down(bits, b * c), up(bits, b * d)),
            (_, true, true, _) => (down(bits, a * d), up(bits, b * c)),
            (_, true, _, true) => (down(bits, b * d), up(bits, a * c)),
            (_, true, _, _) => (down(bits, a * d), up(bits, a * c)),
            (_, _, true, _) => (down(bits, a * d), up(bits, b * d)),
            (_, _, _, true) => (down(bits, b * c), up(bits, a * c)),
            _ => {
                let (lo1, lo2) = (down(bits, a * d), down(bits, b * c));
                let (hi1, hi2) = (up(bits, a * c), up(bits, b * d));
                (lo1.min(&lo2), hi1.max(&hi2))
            }
        };
        Interval::checked(lo, hi, inside)
    }

    fn over(self, other: &Interval) -> Interval {
        let bits = self.lo.prec();
        let inside = self.inside.with(&other.inside, Radical::div);
        let (a, b, c, d) = (&self.lo, &self.hi, &other.lo, &other.hi);
        let positive = |x: &Float| x.cmp0() == Some(Ordering::Greater);
        let negative = |x: &Float| x.cmp0() == Some(Ordering::Less);
        if !(positive(c) || negative(d)) || [a, b, c, d].iter().any(|end| end.is_infinite()) {
            return Interval { inside, ..Interval::everything(bits) };
        }
        let over = |x: &Float, y: &Float, round| rounded(bits, x / y, round);
        let (lo, hi) = if positive(c) {
            let least = over(a, if negative(a) { c } else { d }, Round::Down);
            (least, over(b, if negative(b) { d } else { c }, Round::Up))
        } else {
            let least = over(b, if negative(b) { c } else { d }, Round::Down);
            (least, over(a, if negative(a) { d } else { c }, Round::Up))
        };
        Interval::checked(lo, hi, inside)
    }
}

operators!([] Interval);

impl Neg for Interval {
    type Output = Interval;
    fn neg(self) -> Interval {
        Interval { inside: self.inside.map(|number| Some(number.neg())), lo: -self.hi, hi: -self.lo }
    }
}
