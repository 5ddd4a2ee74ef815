//! Axes: from where to where, in which unit, with which numbers.

use dalembert::number::Scalar;

#[derive(Clone, Debug)]
pub struct Axis {
    /// The symbol with its unit: `t [ms]`.
    pub label: String,
    pub from: f64,
    pub to: f64,
    /// By factors, not by differences.
    pub log: bool,
    /// What the numbers beside it are multiplied with.
    factor: f64,
    /// Their unit, with its prefix.
    unit: String,
    /// Places and texts other than round numbers.
    pub ticks: Option<Vec<(f64, String)>>,
}

/// Units that take prefixes.
const PREFIXED: [&str; 7] = ["s", "m", "m/s", "Pa", "N", "N s", "J"];
const PREFIXES: [(i32, &str); 9] =
    [(-12, "p"), (-9, "n"), (-6, "μ"), (-3, "m"), (0, ""), (3, "k"), (6, "M"), (9, "G"), (12, "T")];

impl Axis {
    /// The axis of a quantity with this symbol and unit over a range of its values: the unit has the prefix, or the
    /// power of ten, that leaves short numbers.
    pub fn new(symbol: &str, unit: &str, [from, to]: [f64; 2]) -> Self {
        let (from, to) = if to > from { (from, to) } else { (from - 0.5 * spread(from), from + 0.5 * spread(from)) };
        let most = from.abs().max(to.abs());
        let power = match most {
            0.05..5000.0 => 0,
            most => 3 * (most.log10() / 3.0).floor() as i32,
        };
        let prefix = PREFIXES.iter().find(|prefix| prefix.0 == power).filter(|_| PREFIXED.contains(&unit));
        let unit = match prefix {
            Some((_, prefix)) => format!("{prefix}{unit}"),
            None if power == 0 => unit.into(),
            None => format!("{} {unit}", power_of_ten(power)).trim_end().into(),
        };
        let label = if unit.is_empty() { symbol.into() } else { format!("{symbol} [{unit}]") };
        Axis { label, from, to, log: false, factor: 10f64.powi(-power), unit, ticks: None }
    }

    /// The axis of a number without a unit, by factors.
    pub fn log(label: &str, [from, to]: [f64; 2]) -> Self {
        Axis { label: label.into(), from, to, log: true, factor: 1.0, unit: String::new(), ticks: None }
    }

    /// The range that holds all values, and zero where `zero` says so, with a little space.
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

    /// A value to three digits, in the unit of the label.
    pub fn shown(&self, value: f64) -> String {
        signed(&(value * self.factor).decimal(3))
    }

    /// A value to six digits in the unit of the label; not divided where that is only a power of ten.
    pub fn told(&self, value: f64) -> String {
        match self.unit.as_str() {
            unit if unit.is_empty() || unit.starts_with("10") => signed(&value.decimal(6)),
            unit => format!("{} {unit}", signed(&(value * self.factor).decimal(6))),
        }
    }

    /// The place of a value as a share of the axis.
    pub fn share(&self, value: f64) -> f64 {
        let scale = |x: f64| if self.log { x.ln() } else { x };
        (scale(value) - scale(self.from)) / (scale(self.to) - scale(self.from))
    }

    /// Places and texts of some `about` numbers.
    pub fn ticks(&self, about: f64) -> Vec<(f64, String)> {
        if let Some(ticks) = &self.ticks {
            return ticks.clone();
        }
        if self.log {
            return self.log_ticks();
        }
        let [from, to] = [self.from, self.to].map(|end| end * self.factor);
        let step = step((to - from) / about.max(1.0));
        let places = usize::try_from(-(step.log10() + 1e-9).floor() as i32).unwrap_or(0);
        let first = (from / step - 1e-6).ceil() as i64;
        (first..)
            .map(|k| k as f64 * step)
            .take_while(|value| *value <= to + 1e-6 * step)
            .map(|value| (value / self.factor, signed(&format!("{value:.places$}"))))
            .collect()
    }

    fn log_ticks(&self) -> Vec<(f64, String)> {
        let steps = if self.to / self.from > 300.0 { &[1.0][..] } else { &[1.0, 2.0, 5.0] };
        let decades = self.from.log10().floor() as i32..=self.to.log10().ceil() as i32;
        let of = |decade: i32| steps.iter().map(move |step| (decade, *step, step * 10f64.powi(decade)));
        let ticks = decades.flat_map(of);
        let within = |value: &f64| (self.from * (1.0 - 1e-9)..=self.to * (1.0 + 1e-9)).contains(value);
        let ticks: Vec<_> = ticks.filter(|(.., value)| within(value)).collect();
        // All of an axis in one form.
        let plain = ticks.iter().all(|(decade, ..)| (-2..=3).contains(decade));
        let text = |(decade, step, value): (i32, f64, f64)| match () {
            () if plain => (value, format!("{value}")),
            () if step == 1.0 => (value, power_of_ten(decade)),
            () => (value, format!("{step}·{}", power_of_ten(decade))),
        };
        ticks.into_iter().map(text).collect()
    }
}

/// A width to show about a lone value.
fn spread(value: f64) -> f64 {
    if value == 0.0 { 1.0 } else { 0.2 * value.abs() }
}

/// 1, 2 or 5 times a power of ten, at least this.
fn step(least: f64) -> f64 {
    let power = 10f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0, 10.0].map(|step| step * power).into_iter().find(|step| *step >= least * 0.999).unwrap_or(least)
}

/// A number with the sign that print has for minus; zero has none.
pub fn signed(text: &str) -> String {
    match text.strip_prefix('-') {
        Some(digits) if digits.chars().all(|digit| matches!(digit, '0' | '.')) => digits.into(),
        Some(digits) => format!("−{digits}"),
        None => text.into(),
    }
}

/// `10⁻³`.
pub fn power_of_ten(exponent: i32) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised = |sign: char| sign.to_digit(10).map_or('⁻', |digit| RAISED[digit as usize]);
    "10".chars().chain(exponent.to_string().chars().map(raised)).collect()
}

#[cfg(test)]
#[path = "tests/axis.rs"]
mod tests;
