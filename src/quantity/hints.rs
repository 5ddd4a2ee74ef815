//! What is systematically wrong with other people's data: computed, and offered as a hint.
//!
//! The difference `e = theirs − ours` is fitted by one thing at a time: a multiple of ours (scale, sign), a constant
//! (origin), or a multiple of the rate of ours (time shift). A fit becomes a hint where
//!
//! 1. it takes away at least half of `‖e‖₂`: it is the greater part of what is wrong;
//! 2. every contact and every flight by itself, and the first sample, say the same within a quarter. Errors of a
//!    scheme start from nothing and grow from impact to impact, or differ from one to the other; a wrong factor, sign,
//!    origin or clock is the same everywhere, and is there from the first sample on;
//! 3. for a factor and an origin, it is more than a scheme may lose: a code that stops the node at the ground at once
//!    loses the energy of half an element, `h/2L`, at each impact, as much as a step `h/c` is of the round trip `2L/c`.
//!
//! Clock and shift of the contacts are read from the table of contacts, where beginning, end and centroid of the force
//! must say the same. Nothing here is fitted to results.

use serde::Serialize;

use super::norms::Grid;
use super::touch::Touch;

/// A hint, with the quantity that it is about.
#[derive(Clone, Debug, PartialEq)]
pub struct Hint {
    /// The name of the quantity; `contact` for what the contacts show, `t` for what all quantities show.
    pub quantity: String,
    /// What.
    pub finding: Finding,
}

/// What may be wrong.
#[derive(Clone, Debug, PartialEq)]
pub enum Finding {
    /// `theirs(t) = ours(t − late)`.
    TimeShift {
        /// How late theirs is.
        late: f64,
        /// The same in steps of the samples.
        steps: f64,
    },
    /// Contacts last `1 + rate` times as long as ours.
    Clock {
        /// The rate.
        rate: f64,
        /// The impulse of theirs divided by that of ours, less 1.
        impulse: Option<f64>,
    },
    /// `theirs = factor · ours`.
    Scale {
        /// The factor.
        factor: f64,
        /// The name of a factor that is often forgotten, if it is one.
        known: Option<&'static str>,
    },
    /// `theirs = −ours`.
    Sign,
    /// `theirs = ours + offset`.
    Origin {
        /// The offset.
        offset: f64,
    },
    /// So many of our contacts are not in theirs.
    Missing(usize),
    /// So many contacts of theirs are none of ours.
    Invented(usize),
}

/// A hint as it is written.
#[derive(Serialize)]
struct Written<'a> {
    kind: &'a str,
    quantity: &'a str,
    value: f64,
    text: String,
}

impl Serialize for Hint {
    fn serialize<Z: serde::Serializer>(&self, z: Z) -> Result<Z::Ok, Z::Error> {
        let (kind, value) = self.finding.kind();
        Written { kind, quantity: &self.quantity, value, text: self.to_string() }.serialize(z)
    }
}

impl Finding {
    /// Its name in JSON, and its value.
    pub fn kind(&self) -> (&'static str, f64) {
        match self {
            Finding::TimeShift { late, .. } => ("time_shift", *late),
            Finding::Clock { rate, .. } => ("clock", *rate),
            Finding::Scale { factor, .. } => ("scale", *factor),
            Finding::Sign => ("sign", -1.0),
            Finding::Origin { offset } => ("origin", *offset),
            Finding::Missing(count) => ("missing", *count as f64),
            Finding::Invented(count) => ("invented", *count as f64),
        }
    }
}

/// `+0.50 %`.
fn percent(share: f64) -> String {
    format!("{:+.2} %", 100.0 * share).replace('-', "−")
}

/// Four digits, with a point where they need one.
fn short(x: f64) -> String {
    if x != 0.0 && !(1e-4..1e6).contains(&x.abs()) { format!("{x:.3e}") } else { format!("{:.4}", x) }
}

impl std::fmt::Display for Hint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let name = &self.quantity;
        match &self.finding {
            Finding::TimeShift { late, steps } => {
                let side = if *late > 0.0 { "late" } else { "early" };
                let (by, steps) = (short(late.abs()), steps.abs());
                write!(f, "{name} is {by} {side}, {steps:.2} steps: is it on the same clock? --shift {:e}", -late)
            }
            Finding::Clock { rate, impulse } => {
                write!(f, "clock {} per contact", percent(*rate))?;
                let Some(impulse) = impulse else { return write!(f, ": check mass, length or wave speed") };
                // c = √(E/ρ): mass by m gives m/2 and m, length by m gives m and m, modulus by m gives −m/2 and 0.
                write!(f, ", impulse {}: ", percent(*impulse))?;
                match impulse / rate {
                    share if (share - 2.0).abs() < 0.4 => write!(f, "as with a mass {} off; check it first", percent(2.0 * rate)),
                    share if (share - 1.0).abs() < 0.4 => write!(f, "as with a length {} off; check it first", percent(*rate)),
                    share if share.abs() < 0.4 => {
                        write!(f, "as with a modulus {} off; check modulus and wave speed first", percent(-2.0 * rate))
                    }
                    _ => write!(f, "check mass, length or wave speed"),
                }
            }
            Finding::Scale { factor, known } => {
                write!(f, "{name} × {}", if (0.01..100.0).contains(&factor.abs()) { format!("{factor:.3}") } else { format!("{factor:.3e}") })?;
                match known {
                    Some(known) => write!(f, ": {known}"),
                    None => write!(f, ": check units and what it is divided by"),
                }
            }
            Finding::Sign => write!(f, "{name} has the other sign: --axis down for displacements and velocities, --compression for forces"),
            Finding::Origin { offset } => {
                write!(f, "{name} is off by {} everywhere: is it measured from elsewhere? --u-origin", short(*offset))
            }
            Finding::Missing(count) => write!(f, "contacts missing in theirs: {count} of ours; see the table of contacts"),
            Finding::Invented(count) => write!(f, "contacts that ours does not have: {count}; see the table of contacts"),
        }
    }
}

/// A quantity to be looked at: values at samples, and what is known of it.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    /// Our values.
    pub ours: &'a [f64],
    /// Their values.
    pub theirs: &'a [f64],
    /// Whether it has two values where a ray passes; otherwise only its rate has.
    pub jumps: bool,
    /// Factors that are often forgotten for this quantity, with what to ask.
    pub factors: &'a [(f64, &'static str)],
}

/// What a hint is judged by.
#[derive(Clone, Copy, Debug)]
pub struct Measures<'a> {
    /// Where samples are: at a point in time each.
    pub grid: &'a Grid,
    /// Times of events, ascending: between them is a contact or a flight.
    pub events: &'a [f64],
    /// The median step divided by the round trip.
    pub step: f64,
    /// `t₁`.
    pub round_trip: f64,
}

/// At least so much of `‖e‖₂` is left by what is no explanation.
const LEFT: f64 = 0.5;
/// Within this share of each other, estimates agree.
const AGREES: f64 = 0.25;
/// A contact or a flight with less than this share of the greatest weight per sample says nothing of its own.
const TELLS: f64 = 0.05;
/// Differences below this share of ours are within the accuracy of ours.
const ACCURACY: f64 = 1e-9;

/// `e ≈ a b`: `Σ w e b` and `Σ w b²` of a stretch of samples, and how many they are.
#[derive(Clone, Copy, Default)]
struct Sums {
    eb: f64,
    bb: f64,
    count: usize,
}

/// A fit, and whether it holds everywhere.
struct Fit {
    value: f64,
    /// `‖e − a b‖²/‖e‖²`.
    left: f64,
    agrees: bool,
    /// How many stretches have a say.
    tell: usize,
}

impl Measures<'_> {
    /// Fits `e` by `basis`, where both are given; the first sample counts as a stretch of its own if `first`.
    fn fit(&self, e: &[f64], basis: impl Fn(usize) -> Option<f64>, first: bool) -> Option<Fit> {
        let (mut all, mut square) = (Sums::default(), 0.0);
        let mut stretches: Vec<Sums> = vec![Sums::default(); self.events.len() + 2];
        let mut stretch = 1;
        for (k, (e, weight)) in e.iter().zip(&self.grid.weights).enumerate() {
            let time = self.grid.times[k];
            while self.events.get(stretch - 1).is_some_and(|event| *event <= time) {
                stretch += 1;
            }
            let Some(b) = basis(k) else { continue };
            square += weight * e * e;
            let own = if first && k == 0 { 0 } else { stretch };
            for sums in [&mut stretches[own], &mut all] {
                (sums.eb, sums.bb, sums.count) = (sums.eb + weight * e * b, sums.bb + weight * b * b, sums.count + 1);
            }
        }
        let value = all.eb / all.bb;
        if !value.is_finite() || square <= 0.0 {
            return None;
        }
        let density = |sums: &Sums| if sums.count == 0 { 0.0 } else { sums.bb / sums.count as f64 };
        // The first sample has half a weight.
        let most = stretches.iter().map(density).fold(0.0, f64::max);
        let telling = stretches.iter().filter(|sums| density(sums) > TELLS * most);
        let tell = telling.clone().count();
        let agrees = telling.into_iter().all(|sums| (sums.eb / sums.bb - value).abs() <= AGREES * value.abs());
        Some(Fit { value, left: ((square - all.eb * value) / square).max(0.0), agrees, tell })
    }

    /// The hint that one quantity gives, if any.
    ///
    /// **Source**: the three conditions at the head of this module.
    ///
    /// Samples that are not `away` from jumps are left out, for all of it or for the rate.
    pub fn of_pair(&self, pair: &Pair<'_>, away: impl Fn(usize) -> bool) -> Option<Finding> {
        let counts = |k: usize| !pair.jumps || away(k);
        let e: Vec<f64> = pair.theirs.iter().zip(pair.ours).map(|(theirs, ours)| theirs - ours).collect();
        let norm = |values: &[f64]| {
            let counted = values.iter().zip(&self.grid.weights).enumerate().filter(|(k, _)| counts(*k));
            counted.map(|(_, (value, weight))| weight * value * value).sum::<f64>().sqrt()
        };
        let scale = norm(pair.ours);
        if norm(&e) <= ACCURACY * scale {
            return None;
        }
        let times = &self.grid.times;
        let rate = |k: usize| {
            let (before, after) = (k.checked_sub(1)?, k + 1);
            let inner = after < times.len() && [before, k, after].into_iter().all(&away);
            inner.then(|| (pair.ours[after] - pair.ours[before]) / (times[after] - times[before]))
        };
        // What impacts may take in all; no scheme loses a quarter.
        let impacts = self.events.len().div_ceil(2).max(1) as f64;
        let loss = (2.0 * impacts * self.step).min(AGREES);
        let holds = |fit: &Fit, gross: bool| fit.left <= LEFT * LEFT && fit.agrees && (fit.tell >= 2 || gross);
        let multiple = self.fit(&e, |k| counts(k).then(|| pair.ours[k]), true);
        let multiple = multiple.filter(|fit| holds(fit, fit.value.abs() >= AGREES) && fit.value.abs() > loss);
        let constant = self.fit(&e, |k| counts(k).then_some(1.0), true);
        let most = pair.ours.iter().fold(0.0f64, |most, value| most.max(value.abs()));
        let constant = constant.filter(|fit| holds(fit, false) && fit.value.abs() > loss * most);
        let late = self.fit(&e, rate, false).filter(|fit| holds(fit, false));
        let multiple = multiple.map(|fit| (fit.left, scaled(1.0 + fit.value, pair.factors)));
        let constant = constant.map(|fit| (fit.left, Finding::Origin { offset: fit.value }));
        let late = late.map(|fit| {
            let step = self.step * self.round_trip;
            (fit.left, Finding::TimeShift { late: -fit.value, steps: -fit.value / step })
        });
        // Where several explain it as well, as with an energy that does not change, the first of them.
        let better = |best: (f64, Finding), next: (f64, Finding)| if next.0 < LEFT * best.0 - f64::EPSILON { next } else { best };
        [multiple, constant, late].into_iter().flatten().reduce(better).map(|(_, finding)| finding)
    }
}

/// A factor as a finding: −1 is a sign, others may have a name.
fn scaled(factor: f64, known: &[(f64, &'static str)]) -> Finding {
    let near = |value: f64| (factor / value - 1.0).abs() < 0.01;
    if near(-1.0) {
        return Finding::Sign;
    }
    Finding::Scale { factor, known: known.iter().find(|(value, _)| near(*value)).map(|(_, name)| *name) }
}

/// Of several values, their mean where all are within a quarter of it.
fn agreed(values: &[f64]) -> Option<f64> {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    values.iter().all(|value| (value - mean).abs() <= AGREES * mean.abs()).then_some(mean)
}

/// What the table of contacts shows: a clock, a shift, contacts that are missing or invented.
///
/// A rate counts where it is more than the steps of the samples leave open at both ends of a contact, where duration and
/// spread of the force say the same, and every contact with them. A shift counts where it is more than a step, and
/// beginning, end and centroid of every contact say the same.
pub fn of_contacts(rows: &[(Option<Touch>, Option<Touch>)], step: f64) -> Vec<Hint> {
    let hint = |finding| Hint { quantity: "contact".into(), finding };
    let mut hints = Vec::new();
    let resolved = |touch: &Touch| touch.duration().is_some_and(|duration| duration > 2.0 * step);
    let missing = rows.iter().filter(|(a, b)| b.is_none() && a.as_ref().is_some_and(resolved)).count();
    let invented = rows.iter().filter(|(a, b)| a.is_none() && b.as_ref().is_some_and(resolved)).count();
    hints.extend((missing > 0).then(|| hint(Finding::Missing(missing))));
    hints.extend((invented > 0).then(|| hint(Finding::Invented(invented))));
    let pairs: Vec<(&Touch, &Touch)> = rows.iter().filter_map(|(a, b)| a.as_ref().zip(b.as_ref())).collect();
    let whole: Vec<_> = pairs.iter().filter(|(a, b)| a.to.is_some() && b.to.is_some()).collect();
    let ratio = |a: Option<f64>, b: Option<f64>| a.zip(b).map(|(a, b)| b / a - 1.0).filter(|rate| rate.is_finite());
    let rates = whole.iter().flat_map(|(a, b)| {
        let duration = ratio(a.duration(), b.duration());
        duration.into_iter().chain(ratio(a.spread, b.spread))
    });
    let open = whole.iter().filter_map(|(a, b)| a.duration().map(|duration| 4.0 * b.step.max(step / 2.0) / duration));
    let clock = agreed(&rates.collect::<Vec<_>>()).filter(|rate| rate.abs() > open.fold(0.0, f64::max));
    if let Some(rate) = clock {
        let impulse = whole.first().and_then(|(a, b)| ratio(a.impulse, b.impulse));
        hints.push(hint(Finding::Clock { rate, impulse }));
        return hints;
    }
    let shifts = pairs.iter().flat_map(|(a, b)| {
        let to = a.to.zip(b.to).map(|(a, b)| b - a);
        let centroid = a.centroid.zip(b.centroid).map(|(a, b)| b - a);
        std::iter::once(b.from - a.from).chain(to).chain(centroid)
    });
    let late = agreed(&shifts.collect::<Vec<_>>()).filter(|late| late.abs() > step);
    hints.extend(late.map(|late| hint(Finding::TimeShift { late, steps: late / step })));
    hints
}

/// One hint for all quantities in place of the same shift of each.
pub fn gathered(mut hints: Vec<Hint>) -> Vec<Hint> {
    let late = |hint: &Hint| match hint.finding {
        Finding::TimeShift { late, steps } => Some((late, steps)),
        _ => None,
    };
    let shifts: Vec<(f64, f64)> = hints.iter().filter_map(late).collect();
    let mean = agreed(&shifts.iter().map(|shift| shift.0).collect::<Vec<_>>());
    if let (Some(mean), Some((first, steps)), true) = (mean, shifts.first(), shifts.len() > 1) {
        hints.retain(|hint| late(hint).is_none());
        let finding = Finding::TimeShift { late: mean, steps: steps * mean / first };
        hints.push(Hint { quantity: "t".into(), finding });
    }
    hints
}
