//! Decimals of fractions, with any number of digits.

use super::rational::{self, Integer, Rational};

/// Returns a decimal with exactly `digits` significant digits, rounded to nearest from the exact value of `x`.
///
/// Zero is `0`. The notation is plain for small exponents (`0.00123`, `31.0000`), otherwise `1.23e-45`.
///
/// **Accuracy**: correctly rounded.
///
/// ```
/// use dalembert::number::{Rational, decimal};
/// assert_eq!(decimal(&(Rational::from(2) / Rational::from(3)), 5), "0.66667");
/// assert_eq!(decimal(&Rational::from(31), 5), "31.000");
/// ```
pub fn decimal(x: &Rational, digits: u32) -> String {
    let digits = digits.max(1) as usize;
    let order = rational::sign(x);
    if order.is_eq() {
        return "0".into();
    }
    let (p, q) = rational::parts(x);
    let p = if order.is_lt() { -p } else { p };
    // Scale to an integer with `digits` digits; the first guess of the exponent may be off by one.
    let mut exponent = ((log2(&p) - log2(&q)) * std::f64::consts::LOG10_2).floor() as i64;
    let (mantissa, exponent) = loop {
        let text = scaled(&p, &q, digits as i64 - 1 - exponent).to_string();
        match text.len() {
            n if n == digits => break (text, exponent),
            n if n > digits => exponent += 1,
            _ => exponent -= 1,
        }
    };
    let sign = if order.is_lt() { "-" } else { "" };
    let point = exponent + 1;
    if (-5..=digits.max(21) as i64).contains(&point) {
        let body = if point <= 0 {
            format!("0.{}{mantissa}", "0".repeat(point.unsigned_abs() as usize))
        } else if point as usize >= digits {
            format!("{mantissa}{}", "0".repeat(point as usize - digits))
        } else {
            format!("{}.{}", &mantissa[..point as usize], &mantissa[point as usize..])
        };
        return format!("{sign}{body}");
    }
    let (head, tail) = mantissa.split_at(1);
    let dot = if tail.is_empty() { "" } else { "." };
    format!("{sign}{head}{dot}{tail}e{exponent}")
}

/// Approximates `log₂ n` for an integer `n > 0`.
fn log2(n: &Integer) -> f64 {
    let limbs = rational::limbs(n);
    limbs.last().map_or(0.0, |top| (*top as f64).log2()) + 64.0 * (limbs.len() as f64 - 1.0)
}

/// Returns `p/q · 10^power`, rounded to the nearest integer.
fn scaled(p: &Integer, q: &Integer, power: i64) -> Integer {
    let zeros = "0".repeat(power.unsigned_abs() as usize);
    let factor = format!("1{zeros}").parse::<Integer>().unwrap_or_default();
    let (p, q) = if power < 0 { (p.clone(), q.clone() * factor) } else { (p.clone() * factor, q.clone()) };
    ((p << 1usize) + &q) / (q << 1usize)
}
