//! The numbers in which routes answer, and the distance of two answers.

use dalembert::Value;
use dalembert::number::{Analytic, Estimate, Float, Interval, IntoValue, Number, Rational, Scalar, show};

/// A number system in which routes answer.
pub(super) trait RouteNumber: IntoValue {
    /// Returns `eˣ`; `None` for a fraction whose exponential is none.
    fn try_exp(&self) -> Option<Self>;
}

macro_rules! with_exponential {
    ($($name:ty),*) => {$(
        impl RouteNumber for $name {
            fn try_exp(&self) -> Option<Self> {
                exponential(self)
            }
        }
    )*};
}
with_exponential!(Estimate<f64>, Estimate<Float>, Interval);

fn exponential<S: Analytic>(x: &S) -> Option<S> {
    Some(x.exp())
}

impl RouteNumber for Rational {
    fn try_exp(&self) -> Option<Self> {
        (self.vanishes() == Ok(true)).then(|| self.one())
    }
}

/// Decimal digits beyond those of a binary number that make its decimal text as good as exact.
const SPARE_DIGITS: u32 = 40;

/// Returns a number of decimal digits that spell `number` as good as exactly.
fn decimal_digits<S: Scalar>(number: &S) -> u32 {
    number.bits().unwrap_or(0) / 3 + SPARE_DIGITS
}

fn parsed(text: &str) -> Option<Rational> {
    text.parse::<Number>().ok().map(|number| number.to_rational())
}

/// Returns `value` as a fraction; of an enclosure, its middle. `None` for a value that is not finite.
fn fraction(value: &Value) -> Option<Rational> {
    if let Some(value) = value.as_double() {
        return value.is_finite().then(|| Rational::default().double(*value.value()));
    }
    let of_float = value.as_float().and_then(|value| parsed(&value.decimal(decimal_digits(value))));
    let of_interval = || value.as_interval().and_then(|value| parsed(&value.decimal(decimal_digits(value))));
    value.as_rational().cloned().or(of_float).or_else(of_interval)
}

/// Returns `log₁₀` of half the width of an enclosure; `None` for any other number.
pub(super) fn log10_radius(value: &Value) -> Option<f64> {
    value.as_interval().map(|value| value.log2_error() * std::f64::consts::LOG10_2)
}

/// Returns `log₁₀ |a − b|`, between the middles of enclosures: −∞ for equal numbers, ∞ where one is not finite. An
/// error of a thousand digits has no double.
pub(super) fn log10_distance(a: &Value, b: &Value) -> f64 {
    let (Some(a), Some(b)) = (fraction(a), fraction(b)) else { return f64::INFINITY };
    log10((a - b).magnitude())
}

/// Returns `log₁₀ x` of `x ≥ 0`, which may lie outside of the range of doubles.
fn log10(mut x: Rational) -> f64 {
    if x.vanishes() == Ok(true) {
        return f64::NEG_INFINITY;
    }
    let (large, mut shift) = (Rational::default().double(1e200), 0.0);
    loop {
        match Scalar::to_f64(&x) {
            near if near < 1e-200 => (x, shift) = (x * &large, shift - 200.0),
            near if near > 1e200 => (x, shift) = (x / &large, shift + 200.0),
            near => return near.log10() + shift,
        }
    }
}

/// Returns whether `value` is an enclosure of a number that is within `10^log10_slack` of `truth`; `log10_slack` is a
/// whole number or −∞.
pub(super) fn encloses(value: &Value, truth: &Value, log10_slack: f64) -> bool {
    let ends = value.as_interval().and_then(|value| value.ends(decimal_digits(value)));
    let ends = ends.and_then(|[low, high]| Some([parsed(&low)?, parsed(&high)?]));
    let slack = if log10_slack.is_finite() { parsed(&format!("1e{log10_slack}")) } else { Some(0.into()) };
    let (Some([low, high]), Some(truth), Some(slack)) = (ends, fraction(truth), slack) else { return false };
    low <= truth.clone() + &slack && high >= truth - slack
}

/// Writes at most eighteen digits of `value`, as the catalogue shows it.
pub(crate) fn shown(value: &Value) -> String {
    if let Some(value) = value.as_double() {
        return match *value.value() {
            0.0 => "0".into(),
            value if (1e-4..1e9).contains(&value.abs()) || !value.is_finite() => value.to_string(),
            value => format!("{value:e}"),
        };
    }
    let of_float = value.as_float().map(|value| value.decimal(18)).or(value.as_rational().map(Scalar::text));
    of_float.unwrap_or_else(|| value.as_interval().map_or(String::new(), |value| show(value, 18)))
}
