//! What is systematically wrong with other people's data: computed, and offered as a hint.
//!
//! The difference `e = theirs − ours` is fitted by one thing at a time: a multiple of ours (scale, sign), a constant
//! (origin), or a multiple of the rate of ours (time shift). A fit becomes a hint where it takes away at least half of
//! `‖e‖₂`, so that it is the greater part of what is wrong, and where one of two things holds.
//!
//! - *From the first sample on*: the first sample, and both halves of the time up to the first event after it, or of
//!   half of that time, and so on, say the same within a quarter. A scheme starts from the same data as ours: its
//!   errors are nothing at the first sample and grow from there; a wrong factor, sign, origin or clock is not.
//! - *Everywhere*: every contact and every flight by itself says the same within a quarter, and the first sample with
//!   them where it has a say. Errors of a scheme grow from impact to impact, or differ from one to the other.
//!
//! A factor and an origin must be more than a scheme may lose at impacts, unless they are there at `t = 0`: a code that
//! stops the node at the ground at once loses the energy of half an element, `h/2L`, at each impact, as much as a step
//! `h/c` is of the round trip `2L/c`.
//!
//! The clock of the contacts is read from the first of them, which starts from exact data as well: from how far the
//! force spreads about its centroid, as the ends of a contact are smeared by every scheme, which changes the spread in
//! the second order only. A shift of the contacts counts where beginning, end and centroid say the same. A factor of
//! the force that chatter hides from the fit, or turns the fit away from by more than 5 %, is read from the impulses.
//! Nothing here is fitted to results.

use serde::Serialize;

use super::norms::Grid;
use super::touch::Touch;
use crate::number::Scalar;
use crate::quantity::Rays;

/// A hint, with the quantity that it is about.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Hint {
    /// The name of the quantity; `contact` for what the contacts show, `t` for what all quantities show.
    pub quantity: String,
    /// What.
    pub finding: Finding,
}

/// What may be wrong.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Finding {
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
        /// The names of factors that are often forgotten and are this one.
        known: Vec<&'static str>,
    },
    /// Theirs is zero at every sample.
    Empty,
    /// `theirs = −ours`.
    Sign,
    /// `theirs = ours + offset`.
    Origin {
        /// The offset.
        offset: f64,
    },
    /// A velocity of theirs is that of their own displacement at another time.
    Rate {
        /// The displacement.
        of: &'static str,
        /// How late it is.
        late: f64,
        /// The same in steps of the samples.
        steps: f64,
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
    /// Whether both say the same, within 5 %: of two estimates the one from samples is then the better.
    pub(crate) fn is_near(&self, other: &Finding) -> bool {
        let ((kind, ours), (other, theirs)) = (self.kind(), other.kind());
        kind == other && (ours / theirs - 1.0).abs() < KNOWN
    }

    /// Its name in JSON, and its value.
    pub(crate) fn kind(&self) -> (&'static str, f64) {
        match self {
            Finding::TimeShift { late, .. } | Finding::Rate { late, .. } => ("time_shift", *late),
            Finding::Clock { rate, .. } => ("clock", *rate),
            Finding::Scale { factor, .. } => ("scale", *factor),
            Finding::Empty => ("empty", 0.0),
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

/// Three digits.
fn rounded(x: f64) -> String {
    if (0.01..1000.0).contains(&x.abs()) { format!("{x:.2}") } else { format!("{x:.2e}") }
}

impl std::fmt::Display for Hint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let name = &self.quantity;
        match &self.finding {
            Finding::TimeShift { late, steps } => {
                let side = if *late > 0.0 { "late" } else { "early" };
                let (by, steps) = (late.abs().decimal(4), steps.abs());
                write!(
                    f,
                    "{name} is {by} {side}, {steps:.2} steps: is it on the same clock? --shift {}",
                    (-late).decimal(4)
                )
            }
            Finding::Clock { rate, impulse } => {
                write!(f, "clock {} per contact", percent(*rate))?;
                let Some(impulse) = impulse else { return write!(f, ": check mass, length or wave speed") };
                // c = √(E/ρ): mass by m gives m/2 and m, length by m gives m and m, modulus by m gives −m/2 and 0.
                write!(f, ", impulse {}: ", percent(*impulse))?;
                let like = match (impulse / rate).round() {
                    2.0 => format!("as with a mass off by {}: ", percent(2.0 * rate)),
                    1.0 => format!("as with a length off by {}: ", percent(*rate)),
                    0.0 => format!("as with a modulus off by {}: ", percent(-2.0 * rate)),
                    _ => String::new(),
                };
                write!(f, "{like}check mass, length or wave speed")
            }
            Finding::Scale { factor, known } => {
                let close = (0.5..1.5).contains(factor) && known.is_empty();
                let factor = if close { format!("{factor:.4}") } else { rounded(*factor) };
                let ask = match (known.as_slice(), close) {
                    ([], true) => "is mass, modulus, length or speed off?".to_string(),
                    ([], false) => "which unit?".to_string(),
                    (known, _) => known.join(" "),
                };
                write!(f, "{name} × {factor}: {ask}")
            }
            Finding::Empty => write!(f, "{name} is zero throughout: an empty column?"),
            Finding::Sign => {
                let option = if matches!(name.as_str(), "force" | "stress" | "strain" | "impulse") {
                    "--compression"
                } else {
                    "--axis"
                };
                write!(f, "{name} has the other sign: {option}?")
            }
            Finding::Origin { offset } => {
                let option = if name.starts_with('u') || name == "h" { " --u-origin?" } else { "" };
                write!(f, "{name} is off by {} everywhere: is it measured from elsewhere?{option}", rounded(*offset))
            }
            Finding::Rate { of, late, steps } => {
                let side = if *late > 0.0 { "late" } else { "early" };
                write!(
                    f,
                    "{name} is {:.2} steps {side} against the rate of {of}: is it that between two steps?",
                    steps.abs()
                )
            }
            Finding::Missing(count) => {
                write!(f, "contacts missing in theirs: {count} of ours; see the table of contacts")
            }
            Finding::Invented(count) => {
                write!(f, "contacts that ours does not have: {count}; see the table of contacts")
            }
        }
    }
}

/// A quantity to be looked at: values at samples, and what is known of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<'a> {
    /// Our values.
    pub ours: &'a [f64],
    /// Their values.
    pub theirs: &'a [f64],
    /// Its natural scale; zero where there is none.
    pub scale: f64,
    /// Whether it has a jump or a kink where a ray passes.
    pub rays: Rays,
    /// Factors that are often forgotten for this quantity, with what to ask.
    pub factors: &'a [(f64, &'static str)],
}

/// What a hint is judged by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measures<'a> {
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
/// The fewest samples that are a stretch.
const FEWEST: usize = 8;
/// Within this share of a known factor it is that factor.
const KNOWN: f64 = 0.05;
/// Differences below this share of ours are within the accuracy of ours.
const ACCURACY: f64 = 1e-9;

/// `e ≈ a b`: `Σ w e b` and `Σ w b²` of a stretch of samples, and what they weigh.
#[derive(Clone, Copy, Default)]
struct Sums {
    eb: f64,
    bb: f64,
    weight: f64,
}

/// A fit `e ≈ value · b`.
#[derive(Clone, Copy, Debug)]
struct Fit {
    value: f64,
    /// `‖e − value · b‖²/‖e‖²`.
    left: f64,
    /// Whether the first sample has a say.
    from_start: bool,
    /// How much of the samples it holds over, by their number.
    reach: usize,
    /// How many stretches have a say.
    tell: usize,
}

impl Measures<'_> {
    /// Fits `e` by `basis`, where both are given: from the first sample on if that holds, everywhere otherwise; `None`
    /// where neither does.
    fn fit(&self, e: &[f64], basis: impl Fn(usize) -> Option<f64>) -> Option<Fit> {
        let times = &self.grid.times;
        let first = *times.first()?;
        // An event within two steps is that of the start.
        let soon = first + 2.0 * self.step * self.round_trip;
        let until = self.events.iter().find(|event| **event > soon).or(times.last()).copied()?;
        let mut shares = std::iter::successors(Some(until - first), |share| Some(share / 2.0)).map_while(|share| {
            let early = times.partition_point(|time| *time < first + share);
            let fit = || self.stretches(&e[..early], &basis, &[first + share / 2.0]);
            (early >= FEWEST).then(fit)
        });
        let start = shares.find_map(|fit| fit.filter(|fit| fit.from_start && fit.tell >= 2));
        start.or_else(|| self.stretches(e, &basis, self.events))
    }

    /// The fit over stretches that end at `ends`, the first sample being one of its own, if all of them agree.
    fn stretches(&self, e: &[f64], basis: impl Fn(usize) -> Option<f64>, ends: &[f64]) -> Option<Fit> {
        let (mut all, mut square) = (Sums::default(), 0.0);
        let mut stretches = vec![Sums::default(); ends.len() + 2];
        let mut own = 1;
        for (k, (e, weight)) in e.iter().zip(&self.grid.weights).enumerate() {
            while ends.get(own - 1).is_some_and(|end| *end <= self.grid.times[k]) {
                own += 1;
            }
            let Some(b) = basis(k) else { continue };
            square += weight * e * e;
            for sums in [&mut stretches[if self.grid.times[k] == self.grid.times[0] { 0 } else { own }], &mut all] {
                (sums.eb, sums.bb, sums.weight) =
                    (sums.eb + weight * e * b, sums.bb + weight * b * b, sums.weight + weight);
            }
        }
        let value = all.eb / all.bb;
        if !value.is_finite() || square <= 0.0 {
            return None;
        }
        let density = |sums: &Sums| if sums.weight > 0.0 { sums.bb / sums.weight } else { 0.0 };
        let most = stretches.iter().map(density).fold(0.0, f64::max);
        let tells = |sums: &&Sums| density(sums) > TELLS * most;
        let agrees = |sums: &Sums| (sums.eb / sums.bb - value).abs() <= AGREES * value.abs();
        let left = ((square - all.eb * value) / square).max(0.0);
        let holds = left <= LEFT * LEFT && stretches.iter().filter(tells).all(agrees);
        let from_start = tells(&&stretches[0]);
        holds.then(|| Fit { value, left, from_start, reach: e.len(), tell: stretches.iter().filter(tells).count() })
    }

    /// `Σ w value²` over the samples that count.
    fn square(&self, values: &[f64], counts: impl Fn(usize) -> bool) -> f64 {
        let counted = values.iter().zip(&self.grid.weights).enumerate().filter(|(k, _)| counts(*k));
        counted.map(|(_, (value, weight))| weight * value * value).sum()
    }

    /// The hint that one quantity gives, if any. Samples that are not `away` from jumps are left out, for all of it or
    /// for its rate.
    ///
    /// **Source**: the conditions at the head of this module.
    pub(super) fn of_pair(&self, pair: &Pair<'_>, away: impl Fn(usize) -> bool) -> Option<Finding> {
        let counts = |k: usize| pair.rays != Rays::Jump || away(k);
        let e: Vec<f64> = pair.theirs.iter().zip(pair.ours).map(|(theirs, ours)| theirs - ours).collect();
        let natural = pair.scale * pair.scale * self.grid.weights.iter().sum::<f64>();
        if self.square(&e, counts) <= ACCURACY * ACCURACY * self.square(pair.ours, counts).max(natural) {
            return None;
        }
        let most = pair.ours.iter().fold(0.0f64, |most, value| most.max(value.abs()));
        if pair.theirs.iter().all(|value| *value == 0.0) {
            // A scheme that releases a few steps late may be at rest as long.
            let moved = pair.ours.iter().filter(|value| value.abs() > TELLS * most).count();
            return (moved >= FEWEST).then_some(Finding::Empty);
        }
        let times = &self.grid.times;
        let rate = |k: usize| {
            let (before, after) = (k.saturating_sub(1), (k + 1).min(times.len() - 1));
            let inner = times[before] < times[after] && (pair.rays == Rays::Smooth || (before..=after).all(&away));
            inner.then(|| (pair.ours[after] - pair.ours[before]) / (times[after] - times[before]))
        };
        // What impacts may take in all; no scheme loses a quarter.
        let impacts = self.events.len().div_ceil(2).max(1) as f64;
        let loss = (2.0 * impacts * self.step).min(AGREES);
        let at_zero = times.first().is_some_and(|first| *first == 0.0);
        let more = |fit: &Fit, scale: f64| (fit.from_start && at_zero) || fit.value.abs() > loss * scale;
        let gross = |fit: &Fit| fit.value.abs() >= AGREES;
        let multiple = self.fit(&e, |k| counts(k).then(|| pair.ours[k]));
        let multiple = multiple.filter(|fit| more(fit, 1.0) && (fit.tell >= 2 || gross(fit)));
        let constant = self.fit(&e, |k| counts(k).then_some(1.0)).filter(|fit| more(fit, most) && fit.tell >= 2);
        let late = self.fit(&e, rate).filter(|fit| fit.tell >= 2);
        let step = self.step * self.round_trip;
        let multiple = multiple.map(|fit| (fit, scaled(1.0 + fit.value, pair.factors)));
        let constant = constant.map(|fit| (fit, Finding::Origin { offset: fit.value }));
        let late = late.map(|fit| (fit, Finding::TimeShift { late: -fit.value, steps: -fit.value / step }));
        // What holds for longer says more. Where several explain it as well, as with an energy that does not change, it
        // is the first of them.
        let better = |best: (Fit, Finding), next: (Fit, Finding)| {
            let as_long = next.0.reach == best.0.reach;
            let closer = next.0.left < LEFT * best.0.left - f64::EPSILON;
            if next.0.reach > best.0.reach || (as_long && closer) { next } else { best }
        };
        [multiple, constant, late].into_iter().flatten().reduce(better).map(|(_, finding)| finding)
    }

    /// The hint that a displacement and its velocity, both theirs, are not at the same times.
    ///
    /// **Source**: `velocity(t) = u′(t − late)`, with `u′` and `u″` as central differences, which are exact where `u`
    /// is a parabola. A quarter of a step is the least that counts: `v` and `u′` of one scheme are means of each other.
    pub(super) fn of_rate(
        &self,
        of: &'static str,
        [u, velocity]: [&[f64]; 2],
        away: impl Fn(usize) -> bool,
    ) -> Option<Finding> {
        let times = &self.grid.times;
        let apart = |k: usize| times[k - 1] < times[k] && times[k] < times[k + 1];
        let inner = |k: usize| k > 0 && k + 1 < times.len() && apart(k) && (k - 1..=k + 1).all(&away);
        let slope = |k: usize| (u[k + 1] - u[k]) / (times[k + 1] - times[k]);
        // u′ and u″ where steps may differ.
        let rates = |k: usize| {
            let (h0, h1) = (times[k] - times[k - 1], times[k + 1] - times[k]);
            let (d0, d1) = (slope(k - 1), slope(k));
            ((d0 * h1 + d1 * h0) / (h0 + h1), 2.0 * (d1 - d0) / (h0 + h1))
        };
        let e: Vec<f64> = (0..times.len()).map(|k| if inner(k) { velocity[k] - rates(k).0 } else { 0.0 }).collect();
        let fit = self.stretches(&e, |k| inner(k).then(|| rates(k).1), self.events)?;
        let (late, steps) = (-fit.value, -fit.value / (self.step * self.round_trip));
        (steps.abs() >= AGREES).then_some(Finding::Rate { of, late, steps })
    }
}

/// A factor as a finding: −1 is a sign, others may have a name.
fn scaled(factor: f64, known: &[(f64, &'static str)]) -> Finding {
    let near = |value: f64| (factor / value - 1.0).abs() < KNOWN;
    if (factor + 1.0).abs() < AGREES {
        return Finding::Sign;
    }
    Finding::Scale { factor, known: known.iter().filter(|(value, _)| near(*value)).map(|(_, name)| *name).collect() }
}

/// Of several values, their mean where all are within a quarter of it.
fn agreed(values: &[f64]) -> Option<f64> {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    values.iter().all(|value| (value - mean).abs() <= AGREES * mean.abs()).then_some(mean)
}

/// What the table of contacts shows: a clock, a shift, contacts that are missing or invented.
///
/// **Source**: of a force that is sampled, each end is known to half a step, and a smear by a share `w` of the
/// duration, such as that of a penalty, adds at most `12 w²` to the square of the spread: `w` is no more than what the
/// duration is longer than the spread. A rate beyond both is one of the clock. A shift counts where it is more than a
/// step, and beginning, end and centroid of every contact say the same. A step is the longest between the samples at
/// `times` that a contact lies between; `typical` is that which a shift is counted in. A contact that had begun before
/// the first sample shows nothing, unless theirs ends late as well.
pub(super) fn of_contacts(rows: &[(Option<Touch>, Option<Touch>)], times: &[f64], typical: f64) -> Vec<Hint> {
    let hint = |finding| Hint { quantity: "contact".into(), finding };
    let mut hints = Vec::new();
    let longest = |touch: &Touch| longest_step(touch, times);
    let begun = |touch: &Touch| begun_before(touch, times, typical);
    // Late data end late as well.
    let cut = |a: &Touch, b: &Touch| begun(a) && a.to.zip(b.to).is_some_and(|(a, b)| (a - b).abs() <= typical);
    let resolved =
        |touch: &Touch| !begun(touch) && touch.duration().is_some_and(|duration| duration > 2.0 * longest(touch));
    let missing = rows.iter().filter(|(a, b)| b.is_none() && a.as_ref().is_some_and(resolved)).count();
    let invented = rows.iter().filter(|(a, b)| a.is_none() && b.as_ref().is_some_and(resolved)).count();
    hints.extend((missing > 0).then(|| hint(Finding::Missing(missing))));
    hints.extend((invented > 0).then(|| hint(Finding::Invented(invented))));
    let both = rows.iter().filter_map(|(a, b)| a.as_ref().zip(b.as_ref()));
    let pairs: Vec<(&Touch, &Touch)> = both.filter(|(a, b)| !cut(a, b)).collect();
    let ratio = |a: Option<f64>, b: Option<f64>| a.zip(b).map(|(a, b)| b / a - 1.0).filter(|rate| rate.is_finite());
    let first = rows.first().and_then(|(a, b)| a.as_ref().zip(b.as_ref())).filter(|(a, b)| !cut(a, b));
    let clock = first.and_then(|(a, b)| {
        let (rate, longer) = (ratio(a.spread, b.spread)?, ratio(a.duration(), b.duration())?);
        let open = longest(a).max(longest(b)) / a.duration()? + 6.0 * (longer - rate).powi(2);
        // An impulse that is off by more than a clock explains says nothing of the clock.
        let impulse = ratio(a.impulse, b.impulse).filter(|impulse| impulse.abs() < AGREES);
        (rate.abs() > open).then_some(Finding::Clock { rate, impulse })
    });
    if let Some(clock) = clock {
        hints.push(hint(clock));
        return hints;
    }
    let shifts = pairs.iter().flat_map(|(a, b)| {
        let to = a.to.zip(b.to).map(|(a, b)| b - a);
        let centroid = a.centroid.zip(b.centroid).map(|(a, b)| b - a);
        std::iter::once(b.from - a.from).chain(to).chain(centroid)
    });
    let agree = agreed(&shifts.collect::<Vec<_>>()).is_some();
    let step = pairs.iter().map(|(a, b)| longest(a).max(longest(b))).fold(0.0, f64::max);
    let late = first.map(|(a, b)| b.from - a.from).filter(|late| agree && late.abs() > step);
    hints.extend(late.map(|late| hint(Finding::TimeShift { late, steps: late / typical })));
    hints
}

/// Whether a contact had begun before the first sample.
fn begun_before(touch: &Touch, times: &[f64], typical: f64) -> bool {
    times.first().is_none_or(|first| touch.from < first - typical)
}

/// The longest step between the samples at `times` that a contact lies between; infinite where there are none.
fn longest_step(touch: &Touch, times: &[f64]) -> f64 {
    let first = times.partition_point(|time| *time <= touch.from).saturating_sub(1);
    let last = touch.to.map_or(times.len(), |to| times.partition_point(|time| *time < to) + 1);
    let within = &times[first..last.clamp(first, times.len())];
    within.windows(2).map(|pair| pair[1] - pair[0]).reduce(f64::max).unwrap_or(f64::INFINITY)
}

/// The factor that the impulses of all contacts show.
///
/// **Source**: `∫ F dt` is the momentum that the ground gives, which no chatter of the force changes. A factor counts
/// where every contact that begins and ends within the samples has the same within 5 %, and where it is further
/// from 1 than a scheme loses, 25 %, and what the sum over samples may be off: a step of the greatest force.
pub(super) fn of_impulses(
    rows: &[(Option<Touch>, Option<Touch>)],
    times: &[f64],
    typical: f64,
    known: &[(f64, &'static str)],
) -> Option<Finding> {
    let both = rows.iter().filter_map(|(a, b)| a.as_ref().zip(b.as_ref()));
    let whole = both.filter(|(a, b)| a.to.is_some() && b.to.is_some() && !begun_before(a, times, typical));
    let factors = whole.map(|(a, b)| {
        let (ours, theirs, peak) = (a.impulse?, b.impulse?, a.peak?);
        let open = longest_step(a, times) * peak / ours;
        ((theirs / ours - 1.0).abs() > AGREES + open).then_some(theirs / ours)
    });
    let factors = factors.collect::<Option<Vec<f64>>>()?;
    let mean = factors.iter().sum::<f64>() / factors.len() as f64;
    let same = factors.iter().all(|factor| (factor / mean - 1.0).abs() < KNOWN);
    (same && mean > 0.0 && mean.is_finite()).then(|| scaled(mean, known))
}

/// One hint for all quantities in place of the same shift of each.
pub(super) fn gathered(mut hints: Vec<Hint>) -> Vec<Hint> {
    let late = |hint: &Hint| match hint.finding {
        Finding::TimeShift { late, steps } => Some((late, steps)),
        _ => None,
    };
    let shifts: Vec<(f64, f64)> = hints.iter().filter_map(late).collect();
    let agree = agreed(&shifts.iter().map(|shift| shift.0).collect::<Vec<_>>()).is_some();
    // That of the contacts stands first.
    if let (true, true, Some((late_by, steps))) = (shifts.len() > 1, agree, shifts.first().copied()) {
        hints.retain(|hint| late(hint).is_none());
        hints.push(Hint { quantity: "t".into(), finding: Finding::TimeShift { late: late_by, steps } });
    }
    hints
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is printed for a person.
    #[test]
    fn texts() {
        let text = |quantity: &str, finding| Hint { quantity: quantity.into(), finding }.to_string();
        let scale = Finding::Scale { factor: 2.0, known: vec!["is ½ missing?"] };
        assert_eq!(text("E_total", scale), "E_total × 2.00: is ½ missing?");
        let scale = Finding::Scale { factor: 1e-3, known: vec!["is ρ missing?", "is it in thousands?"] };
        assert_eq!(text("force", scale), "force × 1.00e-3: is ρ missing? is it in thousands?");
        assert_eq!(text("u_end", Finding::Empty), "u_end is zero throughout: an empty column?");
        let clock = Finding::Clock { rate: -0.036, impulse: None };
        assert_eq!(text("contact", clock), "clock −3.60 % per contact: check mass, length or wave speed");
        let clock = Finding::Clock { rate: -0.005, impulse: Some(-0.0105) };
        assert!(text("contact", clock).contains("as with a mass off by −1.00 %"));
        assert_eq!(text("v_end", Finding::Sign), "v_end has the other sign: --axis?");
    }

    /// A factor, an origin and a shift of a parabola, and a random error that is none of them.
    #[test]
    fn of_a_parabola() {
        let times: Vec<f64> = (0..200).map(|k| f64::from(k) / 100.0).collect();
        let ours: Vec<f64> = times.iter().map(|t| 3.0 + t - t * t).collect();
        let grid = Grid::new(times.clone(), None);
        let measures = Measures { grid: &grid, events: &[1.0], step: 0.005, round_trip: 2.0 };
        let of = |theirs: Vec<f64>| {
            let pair = Pair { ours: &ours, theirs: &theirs, scale: 0.0, rays: Rays::Smooth, factors: &[(2.0, "half")] };
            measures.of_pair(&pair, |_| true)
        };
        let map = |f: &dyn Fn(f64, f64) -> f64| times.iter().zip(&ours).map(|(t, v)| f(*t, *v)).collect::<Vec<_>>();
        assert_eq!(of(map(&|_, v| 2.0 * v)), Some(Finding::Scale { factor: 2.0, known: vec!["half"] }));
        assert_eq!(of(map(&|_, v| -v)), Some(Finding::Sign));
        assert_eq!(of(map(&|_, _| 0.0)), Some(Finding::Empty));
        assert!(matches!(of(map(&|_, v| v + 0.5)), Some(Finding::Origin { offset }) if (offset - 0.5).abs() < 1e-12));
        let late = of(map(&|t, _| 3.0 + (t - 0.005) - (t - 0.005).powi(2)));
        assert!(matches!(late, Some(Finding::TimeShift { steps, .. }) if (steps - 0.5).abs() < 0.02), "{late:?}");
        assert_eq!(of(map(&|t, v| v + 0.01 * (1e4 * t).sin())), None);
        // An error that grows from nothing.
        assert_eq!(of(map(&|t, v| v * (1.0 + 0.02 * t))), None);
    }

    /// Two contacts of a steady force 1 on [0, 1] and [3, 4], in steps of 0.1: by hand 0.25 + 0.1 · 1/1 is open.
    #[test]
    fn of_two_impulses() {
        let times: Vec<f64> = (0..50).map(|k| f64::from(k) / 10.0).collect();
        let touch = |from: f64, impulse: f64| {
            Some(Touch { from, to: Some(from + 1.0), impulse: Some(impulse), peak: Some(1.0), ..Touch::default() })
        };
        let of = |a: f64, b: f64| {
            let rows = [(touch(0.0, 1.0), touch(0.0, a)), (touch(3.0, 1.0), touch(3.0, b))];
            of_impulses(&rows, &times, 0.1, &[(2.0, "twice?")])
        };
        assert_eq!(of(2.0, 2.0), Some(Finding::Scale { factor: 2.0, known: vec!["twice?"] }));
        assert!(of(1.3, 1.3).is_none() && of(1.4, 1.4).is_some());
        assert!(of(2.0, 1.0).is_none() && of(2.0, 2.5).is_none());
        // One that has not ended has no impulse yet.
        let open = Touch { to: None, ..touch(3.0, 0.5).unwrap() };
        let rows = [(touch(0.0, 1.0), touch(0.0, 3.0)), (touch(3.0, 1.0), Some(open))];
        assert!(of_impulses(&rows, &times, 0.1, &[]).is_some());
        assert_eq!(of_impulses(&[], &times, 0.1, &[]), None);
    }
}
