//! An answer in any number system, and how many of its digits are right.

use crate::first_contact::Bounce;
use crate::number::{Estimate, Number, Rounded, Scalar};

/// What a route answers.
#[derive(Clone, Debug)]
pub enum Value {
    /// In double precision.
    Double(f64),
    /// In more bits.
    #[cfg(feature = "mp")]
    Long(rug::Float),
    /// A fraction.
    #[cfg(feature = "mp")]
    Exact(rug::Rational),
    /// Two bounds.
    #[cfg(feature = "mp")]
    Enclosed(crate::number::Interval),
    /// That there is no bounce.
    NoBounce,
    /// That it does not know, and why.
    Undecided(String),
}

/// An answer with the bound that the route itself gives for its error.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The answer.
    pub value: Value,
    /// By how much it may be off, in its own unit; zero where the route claims to be exact.
    pub bound: f64,
}

/// Why there is no answer.
#[derive(Debug)]
pub(super) struct Trouble(pub(super) String);

impl<E: std::error::Error> From<E> for Trouble {
    fn from(error: E) -> Self {
        Trouble(error.to_string())
    }
}

/// How many digits of an answer are right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kept {
    /// None can be counted: words instead of a number.
    Words,
    /// `−log₁₀` of the relative error, as far as the truth is known.
    Digits(f64),
    /// The truth itself.
    All,
}

impl Kept {
    /// As a number: infinite for the truth itself, zero where there is nothing to count.
    pub fn digits(self) -> f64 {
        match self {
            Kept::Words => 0.0,
            Kept::Digits(digits) => digits,
            Kept::All => f64::INFINITY,
        }
    }
}

/// The truth, as the catalogue spells it: an integer or a fraction is exact, a decimal is right to half a unit of its last digit,
/// `no bounce` is a word.
#[derive(Clone, Debug)]
pub struct Truth {
    /// As spelt.
    pub text: &'static str,
    /// The number, if it is one.
    pub(super) number: Option<Number>,
    /// Significant digits; `None` where it is exact.
    pub digits: Option<u32>,
}

/// The one truth that is no number.
pub(super) const NO_BOUNCE: &str = "no bounce";

impl Truth {
    /// The truth that `text` spells.
    pub fn new(text: &'static str) -> Self {
        let number: Option<Number> = text.parse().ok();
        let (mantissa, _) = text.split_once('e').unwrap_or((text, ""));
        let digits = mantissa.trim_start_matches(['-', '0', '.']).bytes().filter(u8::is_ascii_digit).count();
        Truth { text, number, digits: mantissa.contains('.').then_some(digits as u32) }
    }

    /// Digits to which an answer can be compared with it.
    fn most(&self) -> f64 {
        self.digits.map_or(f64::INFINITY, |digits| f64::from(digits) - 1.0)
    }

    /// The nearest double; zero for a word.
    pub fn to_f64(&self) -> f64 {
        self.number.as_ref().map_or(0.0, Number::to_f64)
    }

    /// How many digits of `value` are right.
    pub(super) fn kept(&self, value: &Value) -> Kept {
        match (&self.number, value) {
            (None, _) | (_, Value::NoBounce | Value::Undecided(_)) => Kept::Words,
            (_, Value::Double(value)) if !value.is_finite() => Kept::Digits(0.0),
            #[cfg(feature = "mp")]
            (_, Value::Enclosed(value)) => self.kept_by(value),
            (Some(truth), value) => match value.log10_off(truth) {
                f64::NEG_INFINITY if self.digits.is_none() => Kept::All,
                off => self.counted(self.unit().log10() - off),
            },
        }
    }

    fn counted(&self, digits: f64) -> Kept {
        Kept::Digits(digits.clamp(0.0, self.most()))
    }

    /// What an error is relative to.
    pub(super) fn unit(&self) -> f64 {
        let size = self.to_f64().abs();
        if size == 0.0 { 1.0 } else { size }
    }

    /// The digits that both ends have in common with the truth, none where it lies outside.
    #[cfg(feature = "mp")]
    fn kept_by(&self, value: &crate::number::Interval) -> Kept {
        let Some((low, high)) = self.ends() else { return Kept::Words };
        if *value.hi() < low || *value.lo() > high {
            return Kept::Digits(0.0);
        }
        let width = value.radius();
        if width.is_zero() && self.digits.is_none() {
            return Kept::All;
        }
        let digits = if width.is_zero() { f64::INFINITY } else { -width.log10().to_f64() + self.unit().log10() };
        self.counted(digits)
    }

    /// The least and the greatest number that rounds to the text.
    #[cfg(feature = "mp")]
    fn ends(&self) -> Option<(rug::Rational, rug::Rational)> {
        use rug::ops::Pow;
        let value = self.number.as_ref()?.to_rational();
        if self.digits.is_none() {
            return Some((value.clone(), value));
        }
        let (mantissa, exponent) = self.text.split_once('e').unwrap_or((self.text, "0"));
        let places = mantissa.split_once('.').map_or(0, |(_, after)| after.len() as i32);
        let tenth = rug::Rational::from((1, 10));
        // A whole unit: the last digit may have been cut instead of rounded.
        let unit = tenth.pow(places - exponent.parse::<i32>().unwrap_or(0));
        Some((value.clone() - &unit, value + unit))
    }
}

#[cfg(not(feature = "mp"))]
impl Value {
    /// `log₁₀ |self − truth|`.
    fn log10_off(&self, truth: &Number) -> f64 {
        match self {
            Value::Double(value) => (value - truth.to_f64()).abs().log10().max(f64::NEG_INFINITY),
            Value::NoBounce | Value::Undecided(_) => f64::INFINITY,
        }
    }

    /// `self − other`.
    pub(super) fn minus(&self, other: &Value) -> Option<Value> {
        match (self, other) {
            (Value::Double(a), Value::Double(b)) => Some(Value::Double(a - b)),
            _ => None,
        }
    }
}

#[cfg(feature = "mp")]
impl Value {
    /// `log₁₀ |self − truth|`: an error of a thousand digits has no double.
    fn log10_off(&self, truth: &Number) -> f64 {
        let Some(found) = self.rational() else { return f64::INFINITY };
        let off = rug::Float::with_val(64, found - truth.to_rational()).abs();
        if off.is_zero() { f64::NEG_INFINITY } else { off.log10().to_f64() }
    }

    /// `self − other`.
    pub(super) fn minus(&self, other: &Value) -> Option<Value> {
        Some(match (self, other) {
            (Value::Double(a), Value::Double(b)) => Value::Double(a - b),
            (Value::Long(a), Value::Long(b)) => Value::Long(a.clone() - b),
            (Value::Exact(a), Value::Exact(b)) => Value::Exact(a.clone() - b),
            (Value::Enclosed(a), Value::Enclosed(b)) => Value::Enclosed(a.clone() - b),
            _ => return None,
        })
    }

    fn rational(&self) -> Option<rug::Rational> {
        match self {
            Value::Double(value) => rug::Rational::from_f64(*value),
            Value::Long(value) => value.to_rational(),
            Value::Exact(value) => Some(value.clone()),
            Value::Enclosed(_) | Value::NoBounce | Value::Undecided(_) => None,
        }
    }
}

impl std::fmt::Display for Value {
    /// To at most eighteen digits.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Value::Double(value) => f.write_str(&plain(*value)),
            #[cfg(feature = "mp")]
            Value::Long(value) => f.write_str(&shortened(value.to_rational())),
            #[cfg(feature = "mp")]
            Value::Exact(value) => write!(f, "{value}"),
            #[cfg(feature = "mp")]
            Value::Enclosed(value) => f.write_str(&crate::solve::proved_digits(value, 18)),
            Value::NoBounce => f.write_str(NO_BOUNCE),
            Value::Undecided(_) => f.write_str("undecided"),
        }
    }
}

/// The shortest decimal that stands for the double.
fn plain(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || (1e-4..1e9).contains(&size) || !value.is_finite() {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

#[cfg(feature = "mp")]
fn shortened(value: Option<rug::Rational>) -> String {
    value.map_or_else(|| "not a number".into(), |value| crate::number::decimal(&value, 18))
}

/// A number system whose values can be compared with the truth.
pub(super) trait Answers: Scalar {
    fn value(self) -> Value;
}

impl Answers for f64 {
    fn value(self) -> Value {
        Value::Double(self)
    }
}

#[cfg(feature = "mp")]
impl Answers for rug::Float {
    fn value(self) -> Value {
        Value::Long(self)
    }
}

#[cfg(feature = "mp")]
impl Answers for rug::Rational {
    fn value(self) -> Value {
        Value::Exact(self)
    }
}

#[cfg(feature = "mp")]
impl Answers for crate::number::Interval {
    fn value(self) -> Value {
        Value::Enclosed(self)
    }
}

impl<S: Answers + Rounded> From<Estimate<S>> for Answer {
    fn from(estimate: Estimate<S>) -> Self {
        Answer { bound: estimate.bound(), value: estimate.into_value().value() }
    }
}

impl<S: Answers + Rounded> From<Bounce<Estimate<S>>> for Answer {
    fn from(bounce: Bounce<Estimate<S>>) -> Self {
        match bounce {
            Bounce::At { time, .. } => time.into(),
            Bounce::Never(_) => Answer { value: Value::NoBounce, bound: 0.0 },
            Bounce::Undecided { why, .. } => Answer { value: Value::Undecided(why.to_string()), bound: f64::INFINITY },
        }
    }
}
