//! Units by their names: what brings a number in one to another.

/// A unit as powers of metre, kilogram and second, and its size in those, `size · 10^ten`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Unit {
    powers: [i32; 3],
    size: f64,
    ten: i32,
}

/// The factor from one unit to another: `factor · 10^ten`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conversion {
    factor: f64,
    ten: i32,
}

/// Names, powers and sizes; those in the first lines take prefixes. The inch and the pound-force are exact.
const PREFIXED: [(&str, [i32; 3], i32); 7] = [
    ("m", [1, 0, 0], 0),
    ("g", [0, 1, 0], -3),
    ("s", [0, 0, 1], 0),
    ("N", [1, 1, -2], 0),
    ("Pa", [-1, 1, -2], 0),
    ("J", [2, 1, -2], 0),
    ("ε", [0, 0, 0], 0),
];
const PLAIN: [(&str, [i32; 3], f64, i32); 11] = [
    ("1", [0; 3], 1.0, 0),
    ("-", [0; 3], 1.0, 0),
    ("–", [0; 3], 1.0, 0),
    ("%", [0; 3], 1.0, -2),
    ("t", [0, 1, 0], 1.0, 3),
    ("in", [1, 0, 0], 2.54, -2),
    ("ft", [1, 0, 0], 3.048, -1),
    ("lbf", [1, 1, -2], 4.448_221_615_260_5, 0),
    ("psi", [-1, 1, -2], 6.894_757_293_168_361, 3),
    ("min", [0, 0, 1], 6.0, 1),
    ("bar", [-1, 1, -2], 1.0, 5),
];
const PREFIXES: [(&str, i32); 9] =
    [("n", -9), ("µ", -6), ("μ", -6), ("u", -6), ("m", -3), ("c", -2), ("k", 3), ("M", 6), ("G", 9)];

/// Greatest power of a unit that is read.
const MOST_POWER: i32 = 9;

impl Unit {
    /// Returns the unit of one name: `mm`, `lbf`.
    fn from_name(name: &str) -> Option<Self> {
        let plain = PLAIN.iter().find(|(known, ..)| *known == name);
        let prefixed = |name: &str, ten: i32| {
            let (_, powers, own) = PREFIXED.iter().find(|(known, ..)| *known == name)?;
            Some(Unit { powers: *powers, size: 1.0, ten: own + ten })
        };
        let with = |(prefix, ten): &(&str, i32)| prefixed(name.strip_prefix(prefix)?, *ten);
        plain
            .map(|(_, powers, size, ten)| Unit { powers: *powers, size: *size, ten: *ten })
            .or_else(|| prefixed(name, 0))
            .or_else(|| PREFIXES.iter().find_map(with))
    }

    /// Returns the unit times a power of another one.
    fn times(self, other: Self, power: i32) -> Self {
        let powers = [0, 1, 2].map(|k| self.powers[k] + power * other.powers[k]);
        Unit { powers, size: self.size * other.size.powi(power), ten: self.ten + power * other.ten }
    }

    /// Parses products and quotients of names with powers: `N s/m²`, `kg*m^-1`, `Ns`.
    fn parse(text: &str) -> Option<Self> {
        let raised = [("**", "^"), ("⁻", "^-"), ("¹", "1"), ("²", "^2"), ("³", "^3"), ("(", " "), (")", " ")];
        let text = raised.iter().fold(text.trim().to_string(), |text, (from, to)| text.replace(from, to));
        let mut whole = Unit { powers: [0; 3], size: 1.0, ten: 0 };
        for (place, group) in text.split('/').enumerate() {
            let sign = if place == 0 { 1 } else { -1 };
            let names = group.split([' ', '·', '*', '.']).filter(|name| !name.is_empty());
            let mut count = 0;
            for factor in names {
                let digits = factor.find(|c: char| c == '^' || c.is_ascii_digit()).filter(|at| *at > 0);
                let (name, power) = factor.split_at(digits.unwrap_or(factor.len()));
                let power = if power.is_empty() { 1 } else { power.trim_start_matches('^').parse().ok()? };
                if !(-MOST_POWER..=MOST_POWER).contains(&power) {
                    return None;
                }
                let two = |at: usize| {
                    let (first, second) = name.split_at_checked(at)?;
                    Some(Unit::from_name(first)?.times(Unit::from_name(second)?, 1))
                };
                let unit = Unit::from_name(name).or_else(|| (1..name.len()).find_map(two))?;
                whole = whole.times(unit, sign * power);
                count += 1;
            }
            if count == 0 {
                return None;
            }
        }
        Some(whole)
    }
}

impl Conversion {
    /// Conversion of a number that is in its unit.
    pub const NONE: Self = Conversion { factor: 1.0, ten: 0 };

    /// Returns the conversion from the unit `found` to the unit `expected`, nothing being a unit without dimension;
    /// `None` where either is not known, or they do not measure the same.
    pub fn between(found: &str, expected: &str) -> Option<Self> {
        let (from, to) = (Unit::parse(found)?, Unit::parse(if expected.is_empty() { "1" } else { expected })?);
        let conversion = Conversion { factor: from.size / to.size, ten: from.ten - to.ten };
        (from.powers == to.powers).then_some(conversion)
    }

    /// Returns the number in the other unit.
    ///
    /// **Accuracy**: one rounding between units of the same system up to `10^22`, two otherwise.
    pub fn apply(self, value: f64) -> f64 {
        let size = 10f64.powi(self.ten.abs());
        let value = value * self.factor;
        if self.ten < 0 { value / size } else { value * size }
    }
}

#[cfg(test)]
#[path = "tests/convert.rs"]
mod tests;
