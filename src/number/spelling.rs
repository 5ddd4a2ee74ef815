//! Numbers that doubles represent: the decimal or the simple fraction that someone wrote.

use super::Number;

/// Maximum denominator of a simple fraction: no two such fractions are as close as neighbouring doubles.
const MOST_DENOMINATOR: i64 = 10_000;

/// Form in which a rounded number was spelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spelling {
    /// The shortest decimal that rounds to it; for longer numbers, any form.
    Decimal,
    /// A simple fraction.
    Fraction,
    /// Another number that rounds to it.
    Near,
}

/// Returns the number that a double represents: the shortest decimal that rounds to it, or, if that decimal takes all
/// digits of a double, a simple fraction that rounds to it. `None` for NaN and infinities.
pub(super) fn spelled(x: f64) -> Option<Number> {
    let decimal = x.to_string();
    let digits = decimal.bytes().filter(u8::is_ascii_digit).count();
    let fraction = if digits > 15 { simple_fraction(x) } else { None };
    fraction.unwrap_or(decimal).parse().ok()
}

/// Returns the spelling of `number`, which rounds to `x`.
pub(super) fn spelling(x: f64, number: &Number) -> Spelling {
    let same = |other: Option<Number>| other.is_some_and(|other| other.compare(number).is_eq());
    let text = number.to_string();
    let mantissa = text.split(['e', 'E']).next().unwrap_or_default();
    // Every double represents a decimal with so few digits.
    let short = !text.contains('/') && mantissa.bytes().filter(u8::is_ascii_digit).count() <= 15;
    match short || same(x.to_string().parse().ok()) {
        true => Spelling::Decimal,
        false if same(spelled(x)) => Spelling::Fraction,
        false => Spelling::Near,
    }
}

/// Returns the number that a double represents if its spelling is known.
pub(crate) fn spelled_as(x: f64, spelling: Option<Spelling>) -> Option<Number> {
    match spelling {
        Some(Spelling::Decimal) => x.to_string().parse().ok(),
        _ => spelled(x),
    }
}

/// Returns the first convergent of the continued fraction of `x` that rounds to it, if its denominator is small.
fn simple_fraction(x: f64) -> Option<String> {
    let (mut rest, mut last, mut now) = (x.abs(), (0i64, 1i64), (1i64, 0i64));
    while rest < 1e15 {
        let whole = rest.floor();
        let next = |last: i64, now: i64| (whole as i64).checked_mul(now)?.checked_add(last);
        (last, now) = (now, (next(last.0, now.0)?, next(last.1, now.1)?));
        if now.1 > MOST_DENOMINATOR {
            return None;
        }
        if now.0 as f64 / now.1 as f64 == x.abs() {
            return Some(format!("{}{}/{}", if x < 0.0 { "-" } else { "" }, now.0, now.1));
        }
        rest = 1.0 / (rest - whole);
    }
    None
}
