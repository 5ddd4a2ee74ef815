//! The answer of a route, in the number system of the route.

use dalembert::number::{Analytic, Bounded, Estimate, Float, Interval, Number, Rational, Scalar, show};

/// The answer of a route, with its bound.
#[derive(Clone, Debug)]
pub(crate) enum RouteValue {
    Double(Estimate<f64>),
    Float(Estimate<Float>),
    Fraction(Rational),
    Enclosure(Box<Interval>),
}

/// Decimal digits beyond those of a binary number that make its decimal text as good as exact.
const SPARE_DIGITS: u32 = 40;

impl RouteValue {
    /// Returns the nearest double; of an enclosure, that of its middle.
    pub(crate) fn to_f64(&self) -> f64 {
        match self {
            RouteValue::Double(value) => *value.value(),
            RouteValue::Float(value) => Scalar::to_f64(value),
            RouteValue::Fraction(value) => Scalar::to_f64(value),
            RouteValue::Enclosure(value) => value.decimal(25).parse().unwrap_or(f64::NAN),
        }
    }

    /// Returns the bound of the error; infinite where the route gives none.
    pub(crate) fn bound(&self) -> f64 {
        match self {
            RouteValue::Double(value) => value.bound(),
            RouteValue::Float(value) => value.log2_error().exp2(),
            RouteValue::Fraction(_) => 0.0,
            RouteValue::Enclosure(value) => value.log2_error().exp2(),
        }
    }

    /// Returns `log₁₀` of half the width of an enclosure; `None` for any other number.
    pub(crate) fn log10_radius(&self) -> Option<f64> {
        match self {
            RouteValue::Enclosure(value) => Some(value.log2_error() * std::f64::consts::LOG10_2),
            _ => None,
        }
    }

    /// Returns the value as a fraction; of an enclosure, its middle. `None` for what is not finite.
    fn fraction(&self) -> Option<Rational> {
        fn of_text<S: Scalar>(number: &S) -> Option<Rational> {
            let digits = number.bits()? / 3 + SPARE_DIGITS;
            rational(&number.decimal(digits))
        }
        match self {
            RouteValue::Double(value) => {
                Some(*value.value()).filter(|value| value.is_finite()).map(|value| Rational::default().double(value))
            }
            RouteValue::Float(value) => of_text(value),
            RouteValue::Fraction(value) => Some(value.clone()),
            RouteValue::Enclosure(value) => of_text(&**value),
        }
    }

    /// Returns `log₁₀` of the distance to `other`, between the middles of enclosures: −∞ where there is none, ∞ where
    /// one of both is not finite. An error of a thousand digits has no double.
    pub(crate) fn log10_distance(&self, other: &RouteValue) -> f64 {
        let (Some(a), Some(b)) = (self.fraction(), other.fraction()) else { return f64::INFINITY };
        log10((a - b).magnitude())
    }

    /// Returns whether this is an enclosure of a number that is within `10^log10_slack` of `truth`; `log10_slack` is
    /// a whole number or −∞.
    pub(crate) fn encloses(&self, truth: &RouteValue, log10_slack: f64) -> bool {
        let RouteValue::Enclosure(value) = self else { return false };
        let ends = value.ends(value.bits().unwrap_or(0) / 3 + SPARE_DIGITS);
        let ends = ends.and_then(|[low, high]| Some([rational(&low)?, rational(&high)?]));
        let slack = if log10_slack.is_finite() { rational(&format!("1e{log10_slack}")) } else { Some(0.into()) };
        let (Some([low, high]), Some(truth), Some(slack)) = (ends, truth.fraction(), slack) else { return false };
        low <= truth.clone() + &slack && high >= truth - slack
    }
}

fn rational(text: &str) -> Option<Rational> {
    text.parse::<Number>().ok().map(|number| number.to_rational())
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

impl std::fmt::Display for RouteValue {
    /// Writes at most eighteen digits.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            RouteValue::Double(value) => match *value.value() {
                0.0 => f.write_str("0"),
                value if (1e-4..1e9).contains(&value.abs()) || !value.is_finite() => write!(f, "{value}"),
                value => write!(f, "{value:e}"),
            },
            RouteValue::Float(value) => f.write_str(&value.decimal(18)),
            RouteValue::Fraction(value) => f.write_str(&value.text()),
            RouteValue::Enclosure(value) => f.write_str(&show(&**value, 18)),
        }
    }
}

/// A number system in which routes answer.
pub(crate) trait RouteNumber: Bounded + Into<RouteValue> {
    /// Returns `eˣ`; `None` for a fraction whose exponential is none.
    fn try_exp(&self) -> Option<Self>;
}

macro_rules! route_numbers {
    ($($name:ty: $variant:ident, $exponential:expr;)*) => {$(
        impl From<$name> for RouteValue {
            #[allow(clippy::useless_conversion, reason = "an enclosure is boxed")]
            fn from(value: $name) -> Self {
                RouteValue::$variant(value.into())
            }
        }

        impl RouteNumber for $name {
            fn try_exp(&self) -> Option<Self> {
                let exponential: fn(&Self) -> Option<Self> = $exponential;
                exponential(self)
            }
        }
    )*};
}
route_numbers! {
    Interval: Enclosure, |x| Some(Analytic::exp(x));
    Estimate<f64>: Double, |x| Some(Analytic::exp(x));
    Estimate<Float>: Float, |x| Some(Analytic::exp(x));
    Rational: Fraction, |x| (x.vanishes() == Ok(true)).then(|| x.one());
}
