//! Contacts as samples show them, and which of them is which of ours.

use serde::Serialize;

/// A contact as it is compared: from samples, or from the exact history.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Touch {
    /// Its beginning; for samples the middle between the last one off the ground and the first one on it.
    pub from: f64,
    /// Its end, likewise; `None` where the samples end before.
    pub to: Option<f64>,
    /// `∫ F dt`; `None` where no force is known, as for all that follow from it.
    pub impulse: Option<f64>,
    /// `∫ t F dt / ∫ F dt`.
    pub centroid: Option<f64>,
    pub peak: Option<f64>,
    /// How many short separations were taken as part of it.
    #[serde(skip_serializing_if = "is_zero")]
    pub merged: usize,
    /// Whether it is shorter than two steps of the samples: a scheme may begin it a step late and end it a step early,
    /// and then none of them is in it.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub below_step: bool,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
fn is_zero(count: &usize) -> bool {
    *count == 0
}

impl Touch {
    /// What is known of it, but for how it was read.
    pub(super) fn numbers(&self) -> [Option<f64>; 5] {
        [Some(self.from), self.to, self.impulse, self.centroid, self.peak]
    }

    /// How much more these are of `other`.
    pub(super) fn apart(&self, other: &Touch) -> [Option<f64>; 5] {
        let mut apart = other.numbers();
        apart.iter_mut().zip(self.numbers()).for_each(|(b, a)| *b = a.zip(*b).map(|(a, b)| b - a));
        apart
    }

    fn middle(&self) -> f64 {
        self.centroid.unwrap_or_else(|| self.to.map_or(self.from, |to| f64::midpoint(self.from, to)))
    }

    /// How much of the longer one both share, where `theirs` is `late`, and which part of the greater impulse the
    /// lesser is.
    fn agreement(&self, theirs: &Touch, late: f64) -> f64 {
        let end = |touch: &Touch| touch.to.unwrap_or(f64::MAX);
        let (from, to) = (theirs.from - late, end(theirs) - late);
        let both = (to.min(end(self)) - from.max(self.from)).max(0.0);
        let either = to.max(end(self)) - from.min(self.from);
        let share = |(a, b): (f64, f64)| if a > 0.0 && b > 0.0 { (a / b).min(b / a) } else { 0.0 };
        (if either > 0.0 { both / either } else { 0.0 }) + self.impulse.zip(theirs.impulse).map_or(0.0, share)
    }

    pub(super) fn beside(self, times: &[f64]) -> Self {
        let Some(to) = self.to else { return self };
        let first = times.partition_point(|time| *time <= self.from).saturating_sub(1);
        let last = times.partition_point(|time| *time < to).min(times.len().saturating_sub(1));
        let step = (first..last).map(|k| times[k + 1] - times[k]).fold(0.0, f64::max);
        Touch { below_step: to - self.from < 2.0 * step, ..self }
    }
}

/// The contact from `from` to `to` with a force: at each of these times so much, with its weight in time.
pub(super) fn pressed(from: f64, to: Option<f64>, force: impl Iterator<Item = [f64; 3]>) -> Touch {
    let (mut impulse, mut moment, mut peak) = (0.0, 0.0, 0.0f64);
    for [time, force, weight] in force {
        (impulse, moment) = (impulse + weight * force, moment + weight * force * (time - from));
        peak = peak.max(force);
    }
    let centroid = (impulse > 0.0).then(|| from + moment / impulse);
    Touch { from, to, impulse: Some(impulse), centroid, peak: Some(peak), ..Touch::default() }
}

/// The contacts in samples: a sample is on the ground where `touches` says so, and pushes with `force` where that is
/// known. Separations shorter than `shortest` are chatter: part of the contact, and counted.
///
/// **Accuracy**: integrals by the trapezoidal rule, with the last sample before and the first one after a contact.
pub(super) fn touches(
    times: &[f64],
    touches: impl Fn(usize) -> bool,
    force: Option<&[f64]>,
    shortest: f64,
) -> Vec<Touch> {
    // First and last sample of each, and the separations inside.
    let mut runs: Vec<(usize, usize, usize)> = Vec::new();
    for (k, time) in times.iter().enumerate().filter(|(k, _)| touches(*k)) {
        match runs.last_mut() {
            Some((_, last, _)) if *last + 1 == k => *last = k,
            Some((_, last, merged)) if time - times[*last] < shortest => (*last, *merged) = (k, *merged + 1),
            _ => runs.push((k, k, 0)),
        }
    }
    let found = runs.into_iter().map(|(first, last, merged)| {
        let (before, after) = (first.saturating_sub(1), (last + 1).min(times.len() - 1));
        let (from, to) = (f64::midpoint(times[before], times[first]), f64::midpoint(times[last], times[after]));
        let to = (last < after).then_some(to);
        let touch = match force {
            None => Touch { from, to, ..Touch::default() },
            Some(force) => {
                let at = |k: usize, step: usize| [times[k], force[k], (times[step + 1] - times[step]) / 2.0];
                pressed(from, to, (before..after).flat_map(|k| [at(k, k), at(k + 1, k)]))
            }
        };
        Touch { merged, ..touch }.beside(times)
    });
    found.collect()
}

/// Which of `theirs` is which of `ours`, in order of time: pairs, ours without theirs, and theirs without ours.
///
/// One of theirs may be one of ours where it lies within half the way to the nearest other one of ours, after the
/// difference that the pair before had: clocks that drift apart are followed. Of several, that which agrees best in
/// overlap, place and impulse.
pub(super) fn matched(ours: &[Touch], theirs: &[Touch]) -> Vec<(Option<Touch>, Option<Touch>)> {
    let near = |k: usize| {
        let to = |other: Option<&Touch>| other.map_or(f64::INFINITY, |other| (other.middle() - ours[k].middle()).abs());
        to(k.checked_sub(1).and_then(|k| ours.get(k))).min(to(ours.get(k + 1))) / 2.0
    };
    let (mut rows, mut late, mut next) = (Vec::new(), 0.0, 0);
    for (k, a) in ours.iter().enumerate() {
        let near = near(k);
        let apart = |b: &Touch| b.middle() - late - a.middle();
        let until = |reach: &dyn Fn(f64) -> bool| theirs[next..].iter().take_while(|b| reach(apart(b))).count() + next;
        let (from, to) = (until(&|apart| apart < -near), until(&|apart| apart <= near));
        let agreement = |b: &Touch| a.agreement(b, late) + 1.0 - apart(b).abs() / near;
        let best = (from..to).max_by(|i, j| agreement(&theirs[*i]).total_cmp(&agreement(&theirs[*j])));
        let end = best.unwrap_or(from);
        rows.extend(theirs[next..end].iter().map(|b| (None, Some(b.clone()))));
        rows.push((Some(a.clone()), best.map(|k| theirs[k].clone())));
        if let Some(best) = best {
            late += apart(&theirs[best]);
        }
        next = end + usize::from(best.is_some());
    }
    rows.extend(theirs[next..].iter().map(|b| (None, Some(b.clone()))));
    rows
}

#[cfg(test)]
#[path = "tests/touch.rs"]
mod tests;
