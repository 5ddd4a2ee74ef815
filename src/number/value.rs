//! A number of an answer, whatever its number system.

use std::cmp::Ordering;

use serde::{Serialize, Serializer};

use super::text::{DOUBLE_DIGITS, bound_of_log2, double_bound, show, show_beside, shown_bound};
use super::{Bounded, Estimate, Float, Interval, Number, Rational, Reads, Scalar, Wide};

/// A number of an answer, with its bound, its digits and its unit.
///
/// `{}` prints the digits that were asked for, and none beyond the bound.
///
/// **Accuracy**: *within its bound* for doubles and digits, *exact* for fractions, *enclosure* for proved digits.
///
/// ```
/// use dalembert::{Numbers, Problem, Side};
/// let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).build()?;
/// // Behind the first front v_x(0,t) = −(μ + g t)/c.
/// let strain = rod.solve()?.strain(1, Side::Right)?;
/// assert_eq!((strain.to_f64(), strain.is_exact()), (-4.0, false));
/// assert!(strain.bound().to_f64() < 1e-14);
/// let strain = rod.solve_in(Numbers::Exact)?.strain("1/3", Side::Right)?;
/// assert_eq!((strain.to_string(), strain.bound().to_string()), ("-10/3".into(), "0".into()));
/// # Ok::<(), dalembert::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Value {
    stored: Stored,
    digits: u32,
    unit: &'static str,
}

#[derive(Clone, Debug)]
enum Stored {
    Double(Estimate<f64>),
    Float(Box<Estimate<Float>>),
    Fraction(Box<Rational>),
    Enclosure(Box<Interval>),
}

/// Evaluates `$body` for the number inside `$value`, whatever its system.
macro_rules! stored {
    ($value:expr, $number:ident => $body:expr) => {
        match &$value.stored {
            Stored::Double($number) => $body,
            Stored::Float(boxed) => stored!(@ boxed, $number => $body),
            Stored::Fraction(boxed) => stored!(@ boxed, $number => $body),
            Stored::Enclosure(boxed) => stored!(@ boxed, $number => $body),
        }
    };
    (@ $boxed:ident, $number:ident => $body:expr) => {{
        let $number = &**$boxed;
        $body
    }};
}

impl Value {
    fn new(stored: Stored) -> Self {
        Value { stored, digits: 0, unit: "" }
    }

    /// The same number, printed to `digits` digits (0: all of them), in `unit`.
    pub(crate) fn printed_in(self, digits: u32, unit: &'static str) -> Self {
        Value { digits, unit, ..self }
    }

    /// Returns the number as a double with its bound.
    pub(crate) fn to_double(&self) -> Value {
        let number: Estimate<f64> = match &self.stored {
            Stored::Double(number) => number.clone(),
            Stored::Enclosure(number) => Reads::read((**number).clone()),
            Stored::Float(number) => {
                let mut double: Estimate<f64> = Reads::read((**number).clone());
                // The shortest decimal of a double is within one rounding of it.
                double.widen(double.value().abs());
                double
            }
            Stored::Fraction(number) => Reads::read((**number).clone()),
        };
        number.into()
    }

    /// Returns the middle of an enclosure with its bound; any other number as it is.
    pub(crate) fn without_ends(self) -> Value {
        match self.stored {
            Stored::Enclosure(number) => Estimate::<Float>::read(*number).into(),
            _ => self,
        }
    }

    /// Returns the nearest double; of an enclosure, that of its middle.
    pub fn to_f64(&self) -> f64 {
        match &self.stored {
            Stored::Double(number) => *number.value(),
            Stored::Enclosure(number) => number.decimal(25).parse().unwrap_or(f64::NAN),
            Stored::Float(number) => Scalar::to_f64(&**number),
            Stored::Fraction(number) => Scalar::to_f64(&**number),
        }
    }

    /// Returns the number to at most `digits` significant digits, and none beyond its bound.
    pub fn to_digits(&self, digits: u32) -> String {
        stored!(self, number => show(number, digits))
    }

    /// Returns [`Value::to_digits`] beside numbers up to `greatest`: `below 3.1e-6` in place of a `0` that could be a
    /// digit of these.
    ///
    /// ```
    /// use dalembert::{Estimate, Value};
    /// let value = Value::from(Estimate::new(1e-7, 1e10)); // within 1e10 roundings of 1
    /// assert_eq!(value.to_digits(12), "0");
    /// assert_eq!(value.to_digits_beside(12, 1.0), "below 1.3e-6");
    /// assert_eq!(value.to_digits_beside(3, 1.0), "0");
    /// ```
    pub fn to_digits_beside(&self, digits: u32, greatest: f64) -> String {
        stored!(self, number => show_beside(number, digits, greatest))
    }

    /// Returns the bound of the error of the number as it is serialized: of the double, or of the printed digits.
    pub fn bound(&self) -> Bound {
        match &self.stored {
            Stored::Double(number) if show(number, DOUBLE_DIGITS) != "0" => Bound { log2: double_bound(number) },
            _ => self.bound_to_digits(self.printed_digits()),
        }
    }

    /// Returns the bound of the error of [`Value::to_digits`], the rounding to these digits included.
    pub fn bound_to_digits(&self, digits: u32) -> Bound {
        Bound { log2: stored!(self, number => shown_bound(number, digits)) }
    }

    /// Returns `log₂` of the bound of the error of the stored number: −∞ where it is exact.
    pub fn log2_error(&self) -> f64 {
        stored!(self, number => number.log2_error())
    }

    /// Returns whether two doubles agree within their bounds, or two longer numbers are printed alike.
    pub fn agrees(&self, other: &Value) -> bool {
        if self.is_double() && other.is_double() {
            (self.to_f64() - other.to_f64()).abs() <= self.bound().to_f64() + other.bound().to_f64()
        } else {
            self.to_string() == other.to_string()
        }
    }

    /// Returns the number of digits that were asked for; 0 for doubles and fractions.
    pub fn digits(&self) -> u32 {
        self.digits
    }

    /// Returns the unit; empty for a ratio, and where the problem does not determine one.
    pub fn unit(&self) -> &'static str {
        self.unit
    }

    /// Returns whether the number is exact.
    pub fn is_exact(&self) -> bool {
        self.log2_error() == f64::NEG_INFINITY
    }

    /// Returns whether the bound of the number is proved: it is a fraction or an enclosure.
    pub fn is_proved(&self) -> bool {
        matches!(self.stored, Stored::Fraction(_) | Stored::Enclosure(_))
    }

    /// Returns whether the number is finite.
    pub fn is_finite(&self) -> bool {
        stored!(self, number => number.is_finite())
    }

    /// Returns whether the number was computed in doubles.
    pub fn is_double(&self) -> bool {
        matches!(self.stored, Stored::Double(_))
    }

    /// Returns both ends of an enclosure to ten digits more than were asked for, rounded outwards; `None` for all other
    /// numbers.
    pub fn ends(&self) -> Option<[String; 2]> {
        match &self.stored {
            Stored::Enclosure(number) => number.ends(self.digits),
            _ => None,
        }
    }

    /// Returns the double with its bound; `None` for a number of another system.
    pub fn as_double(&self) -> Option<&Estimate<f64>> {
        if let Stored::Double(number) = &self.stored { Some(number) } else { None }
    }

    /// Returns the long number with its bound; `None` for a number of another system.
    pub fn as_float(&self) -> Option<&Estimate<Float>> {
        if let Stored::Float(number) = &self.stored { Some(number) } else { None }
    }

    /// Returns the fraction; `None` for a number of another system.
    pub fn as_rational(&self) -> Option<&Rational> {
        if let Stored::Fraction(number) = &self.stored { Some(number) } else { None }
    }

    /// Returns the enclosure; `None` for a number of another system.
    pub fn as_interval(&self) -> Option<&Interval> {
        if let Stored::Enclosure(number) = &self.stored { Some(number) } else { None }
    }

    fn printed_digits(&self) -> u32 {
        if self.digits == 0 { DOUBLE_DIGITS } else { self.digits }
    }
}

impl From<Estimate<f64>> for Value {
    fn from(number: Estimate<f64>) -> Self {
        Value::new(Stored::Double(number))
    }
}

impl<const LIMBS: usize> From<Estimate<Wide<LIMBS>>> for Value {
    fn from(number: Estimate<Wide<LIMBS>>) -> Self {
        Estimate::<Float>::read(number).into()
    }
}

/// Conversion of a boxed system.
macro_rules! boxed {
    ($($type:ty: $variant:ident),*) => {$(
        impl From<$type> for Value {
            fn from(number: $type) -> Self {
                Value::new(Stored::$variant(Box::new(number)))
            }
        }
    )*};
}
boxed!(Estimate<Float>: Float, Rational: Fraction, Interval: Enclosure);

impl std::fmt::Display for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(&self.to_digits(self.printed_digits()))
    }
}

/// Equality with the nearest double.
impl PartialEq<f64> for Value {
    fn eq(&self, other: &f64) -> bool {
        self.to_f64() == *other
    }
}

impl From<&Value> for f64 {
    fn from(value: &Value) -> f64 {
        value.to_f64()
    }
}

/// Compares two printed numbers.
fn compare(a: &str, b: &str) -> Option<Ordering> {
    Some(a.parse::<Number>().ok()?.compare(&b.parse().ok()?))
}

/// A number for a double (null if not finite), `{"value": …, "lo": …, "hi": …}` with `lo ≤ truth ≤ hi` and
/// `lo ≤ value ≤ hi` for an enclosure, a string otherwise.
impl Serialize for Value {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Enclosure {
            value: String,
            lo: String,
            hi: String,
        }
        let text = self.to_string();
        match (&self.stored, self.ends()) {
            (Stored::Double(number), _) if !number.value().is_finite() => serializer.serialize_none(),
            (Stored::Double(_), _) if text == "0" => serializer.serialize_f64(0.0),
            (Stored::Double(number), _) => serializer.serialize_f64(*number.value()),
            (_, Some([lo, hi])) => {
                // The rounding of the value to fewer digits than the ends must not leave the enclosure.
                let outer = |end: String, order| if compare(&text, &end) == Some(order) { text.clone() } else { end };
                let (lo, hi) = (outer(lo, Ordering::Less), outer(hi, Ordering::Greater));
                Enclosure { value: text, lo, hi }.serialize(serializer)
            }
            (_, None) => serializer.serialize_str(&text),
        }
    }
}

/// A bound of the error of a printed number. `{}` prints two digits, rounded up: `3.1e-14`; `0` where the number is
/// exact.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Bound {
    log2: f64,
}

impl Bound {
    /// Returns the bound whose `log₂` is `log2`: −∞ for an exact number.
    pub fn from_log2(log2: f64) -> Self {
        Bound { log2 }
    }

    /// Returns the bound as a double: zero where it is below the least one.
    pub fn to_f64(self) -> f64 {
        self.log2.exp2()
    }
}

impl std::fmt::Display for Bound {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(&bound_of_log2(self.log2))
    }
}

/// A number where a double holds it, a string otherwise.
impl Serialize for Bound {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let text = self.to_string();
        match text.parse::<f64>() {
            Ok(bound) if bound > 0.0 || text == "0" => serializer.serialize_f64(bound),
            _ => serializer.serialize_str(&text),
        }
    }
}

/// A number that can be handed out as a [`Value`].
pub trait IntoValue: Bounded + Into<Value> {}

impl<S: Bounded + Into<Value>> IntoValue for S {}
