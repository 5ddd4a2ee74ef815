//! All that needs numbers longer than doubles: their values, and the routes that compute in them.

use rug::ops::Pow;
use rug::{Float, Rational};

use super::account::ByClosedForm;
use super::quantity::Question;
use super::route::Route;
use super::value::{Answer, Bounded, NoAnswer, System, Value};
use crate::lattice::Undamped;
use crate::number::{Analytic, Estimate, Interval, Number, Scalar, bits_for_digits};
use crate::paper::UndampedContact;
use crate::problem::Parameters;
use crate::solve::Numbers;

/// Whether this build has such numbers.
pub(crate) const AVAILABLE: bool = true;
/// Bits beyond the digits that the closed form is asked for.
const SPARE_BITS: u32 = 16;

/// The numbers that a formula is evaluated in to many digits.
pub(crate) type Digits = Float;

/// A number that is no double.
#[derive(Clone, Debug)]
pub(crate) enum Long {
    /// In more bits.
    Float(Float),
    /// Without any error.
    Fraction(Rational),
    /// Between two bounds.
    Enclosure(Box<Interval>),
}

impl Long {
    pub(super) fn to_f64(&self) -> f64 {
        match self {
            Long::Float(value) => value.to_f64(),
            Long::Fraction(value) => Scalar::to_f64(value),
            Long::Enclosure(value) => value.mid().to_f64(),
        }
    }

    pub(super) fn log10_radius(&self) -> Option<f64> {
        match self {
            Long::Enclosure(value) => Some(log10(value.radius())),
            _ => None,
        }
    }

    fn middle(&self) -> Option<Rational> {
        match self {
            Long::Float(value) => value.to_rational(),
            Long::Fraction(value) => Some(value.clone()),
            Long::Enclosure(value) => value.mid().to_rational(),
        }
    }
}

impl std::fmt::Display for Long {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Long::Float(value) => match value.to_rational() {
                Some(value) => f.write_str(&crate::number::decimal(&value, 18)),
                None => f.write_str("not a number"),
            },
            Long::Fraction(value) => write!(f, "{value}"),
            Long::Enclosure(value) => f.write_str(&crate::number::show(&**value, 18)),
        }
    }
}

impl System for Float {
    fn value(self) -> Value {
        Value::Long(Long::Float(self))
    }

    fn exponential(&self) -> Option<Self> {
        Some(Analytic::exp(self))
    }
}

impl System for Estimate<Float> {
    fn value(self) -> Value {
        self.into_value().value()
    }

    fn exponential(&self) -> Option<Self> {
        Some(Analytic::exp(self))
    }
}

impl System for Interval {
    fn value(self) -> Value {
        Value::Long(Long::Enclosure(Box::new(self)))
    }

    fn exponential(&self) -> Option<Self> {
        Some(Analytic::exp(self))
    }
}

impl System for Rational {
    fn value(self) -> Value {
        Value::Long(Long::Fraction(self))
    }

    /// Only at zero: no other fraction has a rational exponential.
    fn exponential(&self) -> Option<Self> {
        (self.vanishes() == Ok(true)).then(|| self.one())
    }
}

/// The number that a person wrote.
pub(super) fn exact(number: &Number) -> Value {
    number.to_rational().value()
}

fn log10(size: Float) -> f64 {
    if size.is_zero() { f64::NEG_INFINITY } else { size.log10().to_f64() }
}

fn middle(value: &Value) -> Option<Rational> {
    match value {
        Value::Double(value) => Rational::from_f64(*value),
        Value::Long(value) => value.middle(),
    }
}

pub(super) fn log10_apart(a: &Value, b: &Value) -> f64 {
    match (middle(a), middle(b)) {
        (Some(a), Some(b)) => log10(Float::with_val(64, a - b).abs()),
        _ => f64::INFINITY,
    }
}

/// Whether an enclosure holds a number that is within `10^place` of `truth`, or `truth` itself for `place = None`.
pub(super) fn holds(value: &Value, truth: &Value, place: Option<i32>) -> bool {
    let (Value::Long(Long::Enclosure(value)), Some(truth)) = (value, middle(truth)) else { return false };
    let slack = place.map_or_else(Rational::new, |place| Rational::from(10).pow(place));
    *value.lo() <= truth.clone() + &slack && *value.hi() >= truth - slack
}

/// The answer of a route that needs long numbers.
pub(super) fn run(route: Route, question: &Question) -> Result<Answer, NoAnswer> {
    let problem = &question.problem;
    match route {
        Route::LongFormula(_, digits, formula) => {
            let bits = bits_for_digits(digits) + SPARE_BITS;
            let lift = |p: i32, q: i32| Float::with_val(bits, Rational::from((p, q)));
            Ok(Bounded::unbounded(formula(&lift).value()))
        }
        Route::ClosedForm(Numbers::Digits(digits)) => {
            let bits = bits_for_digits(digits) + SPARE_BITS;
            let rod = Parameters::<Estimate<Float>>::of(problem, &bits)?;
            question.ask(&rod, &ByClosedForm::new(&rod))
        }
        Route::Lattice(Numbers::Exact) => question.ask_history(&Undamped::<Rational>::solve(problem, &())?),
        Route::PrintedForms => {
            let rod = Parameters::<Rational>::of(problem, &())?;
            let contact = UndampedContact::new(&rod).ok_or_else(|| NoAnswer::gave_up("they are printed for r = 0"))?;
            question.ask(&rod, &contact)
        }
        _ => Err(NoAnswer::gave_up("this route has no such numbers")),
    }
}
