//! Axes: their range, their unit and the numbers beside them.

use dalembert::number::Scalar;

/// Axis of a panel.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Symbol and unit: `t [ms]`.
    pub label: String,
    /// Value at the left or lower end.
    pub from: f64,
    /// Value at the right or upper end.
    pub to: f64,
    /// Values and texts of the ticks, in place of round numbers.
    pub ticks: Option<Vec<(f64, String)>>,
    /// Whether the scale is logarithmic.
    log: bool,
    /// Factor from a value to the number beside its tick.
    factor: f64,
    /// Unit of these numbers, with its prefix.
    unit: String,
}

/// Units that take prefixes.
const PREFIXED: [&str; 7] = ["s", "m", "m/s", "Pa", "N", "N s", "J"];
const PREFIXES: [(i32, &str); 9] =
    [(-12, "p"), (-9, "n"), (-6, "μ"), (-3, "m"), (0, ""), (3, "k"), (6, "M"), (9, "G"), (12, "T")];

impl Axis {
    /// Creates the axis of a quantity with this symbol and unit. The unit gets the prefix, or the power of ten, that
    /// makes the numbers short.
    pub fn new(symbol: &str, unit: &str, [from, to]: [f64; 2]) -> Self {
        let (from, to) = if to > from { (from, to) } else { (from - 0.5 * spread(from), from + 0.5 * spread(from)) };
        let power = match from.abs().max(to.abs()) {
            0.05..5000.0 => 0,
            greatest => 3 * (greatest.log10() / 3.0).floor() as i32,
        };
        let prefix = PREFIXES.iter().find(|prefix| prefix.0 == power).filter(|_| PREFIXED.contains(&unit));
        let unit = match prefix {
            Some((_, prefix)) => format!("{prefix}{unit}"),
            None if power == 0 => unit.into(),
            None => format!("{} {unit}", power_of_ten(power)).trim_end().into(),
        };
        let label = if unit.is_empty() { symbol.into() } else { format!("{symbol} [{unit}]") };
        Axis { label, from, to, ticks: None, log: false, factor: 10f64.powi(-power), unit }
    }

    /// Creates the logarithmic axis of a number without a unit.
    pub fn log(label: &str, [from, to]: [f64; 2]) -> Self {
        Axis { label: label.into(), from, to, ticks: None, log: true, factor: 1.0, unit: String::new() }
    }

    /// Returns a range that holds all finite values, zero too if `zero` is true, and a little space at both ends.
    pub fn range(values: impl Iterator<Item = f64>, zero: bool) -> [f64; 2] {
        let start = if zero { [0.0, 0.0] } else { [f64::INFINITY, f64::NEG_INFINITY] };
        let finite = values.filter(|value| value.is_finite());
        let [from, to] = finite.fold(start, |[from, to], value| [from.min(value), to.max(value)]);
        if from > to {
            return [0.0, 1.0];
        }
        let space = 0.06 * if to > from { to - from } else { spread(from) };
        [from - space, to + space]
    }

    /// Formats a value with three digits, in the unit of the label.
    pub(crate) fn short(&self, value: f64) -> String {
        with_minus_sign(&(value * self.factor).decimal(3))
    }

    /// Formats a value with six digits and its unit. A unit that is only a power of ten is not used.
    pub(crate) fn with_unit(&self, value: f64) -> String {
        match self.unit.as_str() {
            unit if unit.is_empty() || unit.starts_with("10") => with_minus_sign(&value.decimal(6)),
            unit => format!("{} {unit}", with_minus_sign(&(value * self.factor).decimal(6))),
        }
    }

    /// Returns the place of a value on the axis, as a share of its length.
    pub(super) fn share(&self, value: f64) -> f64 {
        let scale = |x: f64| if self.log { x.ln() } else { x };
        (scale(value) - scale(self.from)) / (scale(self.to) - scale(self.from))
    }

    /// Returns the values and the texts of about `count` ticks.
    pub(super) fn ticks(&self, count: f64) -> Vec<(f64, String)> {
        if let Some(ticks) = &self.ticks {
            return ticks.clone();
        }
        if self.log {
            return self.log_ticks();
        }
        let [from, to] = [self.from, self.to].map(|end| end * self.factor);
        let step = round_step((to - from) / count.max(1.0));
        let places = usize::try_from(-(step.log10() + 1e-9).floor() as i32).unwrap_or(0);
        let first = (from / step - 1e-6).ceil() as i64;
        (first..)
            .map(|k| k as f64 * step)
            .take_while(|value| *value <= to + 1e-6 * step)
            .map(|value| (value / self.factor, with_minus_sign(&format!("{value:.places$}"))))
            .collect()
    }

    fn log_ticks(&self) -> Vec<(f64, String)> {
        let steps: &[f64] = if self.to / self.from > 300.0 { &[1.0] } else { &[1.0, 2.0, 5.0] };
        let range = self.from * (1.0 - 1e-9)..=self.to * (1.0 + 1e-9);
        let decades = self.from.log10().floor() as i32..=self.to.log10().ceil() as i32;
        let ticks = decades.flat_map(|decade| steps.iter().map(move |step| (decade, *step)));
        let value = |(decade, step): (i32, f64)| step * 10f64.powi(decade);
        let ticks: Vec<_> = ticks.filter(|tick| range.contains(&value(*tick))).collect();
        // All ticks of an axis are written alike.
        let plain = ticks.iter().all(|(decade, _)| (-2..=3).contains(decade));
        let text = |(decade, step): (i32, f64)| match step {
            _ if plain => value((decade, step)).to_string(),
            1.0 => power_of_ten(decade),
            _ => format!("{step}·{}", power_of_ten(decade)),
        };
        ticks.into_iter().map(|tick| (value(tick), text(tick))).collect()
    }
}

/// Returns the width of the range that is shown around a single value.
fn spread(value: f64) -> f64 {
    if value == 0.0 { 1.0 } else { 0.2 * value.abs() }
}

/// Returns the least of 1, 2 and 5 times a power of ten that is not below `least`.
fn round_step(least: f64) -> f64 {
    let power = 10f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0, 10.0].map(|step| step * power).into_iter().find(|step| *step >= least * 0.999).unwrap_or(least)
}

/// Replaces a leading hyphen by the minus sign, and `-0.00` by `0.00`.
fn with_minus_sign(number: &str) -> String {
    match number.strip_prefix('-') {
        Some(digits) if digits.chars().all(|digit| matches!(digit, '0' | '.')) => digits.into(),
        Some(digits) => format!("−{digits}"),
        None => number.into(),
    }
}

/// Formats a power of ten: `10⁻³`.
pub fn power_of_ten(exponent: i32) -> String {
    const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let superscript = |sign: char| sign.to_digit(10).map_or('⁻', |digit| SUPERSCRIPTS[digit as usize]);
    "10".chars().chain(exponent.to_string().chars().map(superscript)).collect()
}

#[cfg(test)]
#[path = "tests/axis.rs"]
mod tests;
