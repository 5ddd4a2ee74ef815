//! Numbers as a person writes them.

use std::cmp::Ordering;
use std::fmt;
use std::str::FromStr;

use thiserror::Error;

use super::rational::{self, Integer, Rational};

/// A number as a person wrote it: `3`, `0.1`, `1e-9`, `1/3`, `2.5/7`. It represents exactly the rational that it
/// spells: `0.1` is 1/10, never the nearest double.
///
/// **Accuracy**: exact; [`Number::to_f64`] rounds once.
///
/// ```
/// use dalembert::Number;
/// let tenth: Number = "0.1".parse()?;
/// assert_eq!(tenth.to_f64(), 0.1);
/// assert_eq!(tenth.to_string(), "0.1");
/// assert!("0x10".parse::<Number>().is_err());
/// # Ok::<(), dalembert::number::NumberError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Number {
    text: String,
    value: f64,
}

/// Reason to reject a text as a number.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum NumberError {
    /// The text does not spell a number.
    #[error("found `{0}`, expected a number such as 3, 0.1, 1e-9 or \"1/3\"")]
    Unreadable(String),
    /// The denominator is zero.
    #[error("found `{0}`, expected a fraction whose denominator is not zero")]
    ZeroDenominator(String),
    /// The magnitude is outside the range that every number system holds.
    #[error("found `{0}`, expected zero or a magnitude between 1e-300 and 1e300")]
    Size(String),
    /// The text is too long.
    #[error("found a number of {0} characters, expected at most {MAX_CHARACTERS}")]
    TooLong(usize),
}

const MAX_CHARACTERS: usize = 20_000;

impl Number {
    /// Returns the nearest double. **Accuracy**: correctly rounded for decimals and for fractions of integers below
    /// 2⁵³; within 1.5 ulp for other fractions.
    #[inline]
    pub fn to_f64(&self) -> f64 {
        self.value
    }

    /// Returns the number of digits in which the number is written, those of an exponent included.
    pub(crate) fn written_digits(&self) -> u32 {
        self.text.bytes().filter(u8::is_ascii_digit).count() as u32
    }

    /// Returns whether the number is zero.
    pub fn is_zero(&self) -> bool {
        self.value == 0.0
    }

    /// Compares two numbers by value: `1/2` and `0.5` are equal here.
    ///
    /// **Accuracy**: *exact*.
    ///
    /// ```
    /// use dalembert::Number;
    /// use std::cmp::Ordering;
    /// let third: Number = "1/3".parse()?;
    /// assert_eq!(third.compare(&"2/6".parse()?), Ordering::Equal);
    /// assert_eq!(third.compare(&"0.333333333333333333333333333333".parse()?), Ordering::Greater);
    /// # Ok::<(), dalembert::number::NumberError>(())
    /// ```
    pub fn compare(&self, other: &Number) -> Ordering {
        // Both doubles are within 1.5 ulp: they decide if they differ by more than that.
        let slack = 4.0 * f64::EPSILON * self.value.abs().max(other.value.abs());
        if (self.value - other.value).abs() > slack {
            return self.value.total_cmp(&other.value);
        }
        self.to_rational().cmp(&other.to_rational())
    }

    /// Returns numerator and denominator, each as a decimal.
    fn parts(&self) -> (&str, &str) {
        self.text.split_once('/').unwrap_or((&self.text, "1"))
    }

    /// Returns the fraction that the text spells. **Accuracy**: exact.
    pub fn to_rational(&self) -> Rational {
        let (numerator, denominator) = self.parts();
        decimal_to_rational(numerator) / decimal_to_rational(denominator)
    }

    /// Returns the number that `fraction` spells; `None` if its magnitude or its length is not accepted.
    pub(crate) fn of_rational(fraction: &Rational) -> Option<Number> {
        fraction.to_string().parse().ok()
    }
}

/// Converts a checked decimal to a fraction.
fn decimal_to_rational(text: &str) -> Rational {
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let power = exponent.parse().unwrap_or(0) - fraction.len() as i64;
    let zeros = "0".repeat(usize::try_from(power.unsigned_abs()).unwrap_or(0));
    let integer = |text: String| text.parse::<Integer>().unwrap_or_default();
    match power < 0 {
        true => rational::quotient(integer(format!("{whole}{fraction}")), integer(format!("1{zeros}"))),
        false => integer(format!("{whole}{fraction}{zeros}")).into(),
    }
}

impl FromStr for Number {
    type Err = NumberError;

    fn from_str(source: &str) -> Result<Self, NumberError> {
        let text: String = source.trim().chars().filter(|c| *c != '_').collect();
        if text.len() > MAX_CHARACTERS {
            return Err(NumberError::TooLong(text.len()));
        }
        let (numerator, denominator) = match text.split_once('/') {
            Some((a, b)) => (a.trim(), b.trim()),
            None => (text.as_str(), "1"),
        };
        let unreadable = || NumberError::Unreadable(short(source.trim()));
        if !is_decimal(numerator) || !is_decimal(denominator) {
            return Err(unreadable());
        }
        let top: f64 = numerator.parse().map_err(|_| unreadable())?;
        let bottom: f64 = denominator.parse().map_err(|_| unreadable())?;
        if spells_zero(denominator) {
            return Err(NumberError::ZeroDenominator(short(source.trim())));
        }
        let fits = |value: f64| (1e-300..=1e300).contains(&value.abs());
        let usable = spells_zero(numerator) || (fits(top) && fits(bottom) && fits(top / bottom));
        if !usable {
            return Err(NumberError::Size(short(source.trim())));
        }
        let text = if denominator == "1" { numerator.to_string() } else { format!("{numerator}/{denominator}") };
        // Adding zero turns −0 into 0.
        Ok(Number { text, value: top / bottom + 0.0 })
    }
}

/// Shortens a text for a message: one line, at most 40 characters.
pub fn short(text: &str) -> String {
    const MOST: usize = 40;
    let mut shown = String::new();
    for c in text.chars().take(MOST) {
        if c.is_control() {
            shown.extend(c.escape_default());
        } else {
            shown.push(c);
        }
    }
    if text.chars().nth(MOST).is_some() {
        shown.push('…');
    }
    shown
}

/// Returns whether all digits of the mantissa are 0.
fn spells_zero(decimal: &str) -> bool {
    let mantissa = decimal.split(['e', 'E']).next().unwrap_or(decimal);
    !mantissa.contains(|c: char| c.is_ascii_digit() && c != '0')
}

/// Returns whether the text is a plain decimal; `f64::from_str` also accepts `inf` and `nan`.
fn is_decimal(text: &str) -> bool {
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
    let (mantissa, exponent) = unsigned.split_once(['e', 'E']).unwrap_or((unsigned, "0"));
    let exponent = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
    let digits = |s: &str| s.bytes().all(|b| b.is_ascii_digit());
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    digits(whole) && digits(fraction) && !(whole.is_empty() && fraction.is_empty())
        // Beside at most MAX_CHARACTERS digits, five digits of exponent span the range that is accepted.
        && !exponent.is_empty() && exponent.len() <= 6 && digits(exponent)
}

impl From<i64> for Number {
    fn from(n: i64) -> Self {
        Number { text: n.to_string(), value: n as f64 }
    }
}

/// Compares the texts: `1/2` and `0.5` are equal in value but not here.
impl PartialEq for Number {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// Writes the text: a JSON number would be rounded.
impl serde::Serialize for Number {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.text)
    }
}

#[cfg(test)]
#[path = "tests/literal.rs"]
mod tests;
