//! Contacts as samples show them, and their assignment to the exact contacts.

use schemars::JsonSchema;
use serde::Serialize;

/// A contact as it is compared: from samples, or from the exact history.
#[derive(Clone, Debug, Default, PartialEq, JsonSchema, Serialize)]
pub(crate) struct ContactRecord {
    /// The beginning; for samples the middle between the last one off the ground and the first one on it.
    pub impact: f64,
    /// The end, likewise; `None` where the samples end before.
    pub release: Option<f64>,
    /// `∫ F dt`; `None` where no force is known, as for the next two.
    pub impulse: Option<f64>,
    /// `∫ t F dt / ∫ F dt`.
    pub centroid: Option<f64>,
    /// The greatest force.
    pub peak_force: Option<f64>,
    /// The number of short separations that were taken as part of the contact.
    #[serde(skip_serializing_if = "is_zero")]
    pub merged: usize,
    /// Whether the contact is shorter than two steps of the samples: a scheme may begin it a step late and end it a
    /// step early, and then no sample shows it.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub below_step: bool,
}

/// An exact contact and one of the data that are the same; either may be missing.
#[derive(Clone, Debug, Default, PartialEq, JsonSchema, Serialize)]
pub(crate) struct ContactPair {
    pub ours: Option<ContactRecord>,
    pub theirs: Option<ContactRecord>,
}

/// A run of samples on the ground.
struct SampleRun {
    first: usize,
    last: usize,
    /// The number of short separations inside.
    merged: usize,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
fn is_zero(count: &usize) -> bool {
    *count == 0
}

impl ContactRecord {
    /// Builds the contact with a force, given as `[time, force, weight in time]`.
    pub(super) fn with_force(from: f64, to: Option<f64>, force: impl Iterator<Item = [f64; 3]>) -> Self {
        let (mut impulse, mut moment, mut peak) = (0.0, 0.0, 0.0f64);
        for [time, force, weight] in force {
            (impulse, moment) = (impulse + weight * force, moment + weight * force * (time - from));
            peak = peak.max(force);
        }
        let centroid = (impulse > 0.0).then(|| from + moment / impulse);
        ContactRecord {
            impact: from,
            release: to,
            impulse: Some(impulse),
            centroid,
            peak_force: Some(peak),
            ..ContactRecord::default()
        }
    }

    /// Returns beginning, end, impulse, centroid and peak.
    pub(super) fn numbers(&self) -> [Option<f64>; 5] {
        [Some(self.impact), self.release, self.impulse, self.centroid, self.peak_force]
    }

    /// Returns the numbers of `other` minus those of this contact.
    pub(super) fn differences(&self, other: &ContactRecord) -> [Option<f64>; 5] {
        let mut differences = other.numbers();
        differences.iter_mut().zip(self.numbers()).for_each(|(b, a)| *b = a.zip(*b).map(|(a, b)| b - a));
        differences
    }

    fn middle(&self) -> f64 {
        self.centroid.unwrap_or_else(|| self.release.map_or(self.impact, |to| f64::midpoint(self.impact, to)))
    }

    /// Returns the overlap with `theirs`, which is `late`, as a share of both together, plus the ratio of the lesser to
    /// the greater impulse.
    fn similarity(&self, theirs: &ContactRecord, late: f64) -> f64 {
        let end = |contact: &ContactRecord| contact.release.unwrap_or(f64::MAX);
        let (from, to) = (theirs.impact - late, end(theirs) - late);
        let both = (to.min(end(self)) - from.max(self.impact)).max(0.0);
        let either = to.max(end(self)) - from.min(self.impact);
        let ratio = |(a, b): (f64, f64)| if a > 0.0 && b > 0.0 { (a / b).min(b / a) } else { 0.0 };
        (if either > 0.0 { both / either } else { 0.0 }) + self.impulse.zip(theirs.impulse).map_or(0.0, ratio)
    }

    /// Returns the contact with the flag `below_step` for samples at `times`.
    pub(super) fn sampled_at(self, times: &[f64]) -> Self {
        let Some(to) = self.release else { return self };
        let first = times.partition_point(|time| *time <= self.impact).saturating_sub(1);
        let last = times.partition_point(|time| *time < to).min(times.len().saturating_sub(1));
        let step = (first..last).map(|k| times[k + 1] - times[k]).fold(0.0, f64::max);
        ContactRecord { below_step: to - self.impact < 2.0 * step, ..self }
    }
}

/// Finds the contacts in samples that are on the ground where `touches` says so, with `force` where it is known.
/// Separations shorter than `shortest` are chatter: part of the contact, and counted.
///
/// **Accuracy**: integrals by the trapezoidal rule, with the last sample before and the first one after a contact.
pub(super) fn find_contacts(
    times: &[f64],
    touches: impl Fn(usize) -> bool,
    force: Option<&[f64]>,
    shortest: f64,
) -> Vec<ContactRecord> {
    let mut runs: Vec<SampleRun> = Vec::new();
    for (k, time) in times.iter().enumerate().filter(|(k, _)| touches(*k)) {
        match runs.last_mut() {
            Some(run) if run.last + 1 == k => run.last = k,
            Some(run) if time - times[run.last] < shortest => (run.last, run.merged) = (k, run.merged + 1),
            _ => runs.push(SampleRun { first: k, last: k, merged: 0 }),
        }
    }
    let record = |SampleRun { first, last, merged }| {
        let (before, after) = (first.saturating_sub(1), (last + 1).min(times.len() - 1));
        let (from, to) = (f64::midpoint(times[before], times[first]), f64::midpoint(times[last], times[after]));
        let to = (last < after).then_some(to);
        let contact = match force {
            None => ContactRecord { impact: from, release: to, ..ContactRecord::default() },
            Some(force) => {
                let at = |k: usize, step: usize| [times[k], force[k], (times[step + 1] - times[step]) / 2.0];
                ContactRecord::with_force(from, to, (before..after).flat_map(|k| [at(k, k), at(k + 1, k)]))
            }
        };
        ContactRecord { merged, ..contact }.sampled_at(times)
    };
    runs.into_iter().map(record).collect()
}

/// Assigns the contacts `theirs` to `ours`, in order of time: pairs, ours without theirs, and theirs without ours.
///
/// A candidate for one of ours lies within half the distance to its nearest neighbour, after the difference that the
/// pair before had: clocks that drift apart are followed. Of several candidates, the one that agrees best in overlap,
/// place and impulse is taken.
pub(super) fn match_contacts(ours: &[ContactRecord], theirs: &[ContactRecord]) -> Vec<ContactPair> {
    let reach = |k: usize| {
        let to = |other: Option<&ContactRecord>| {
            other.map_or(f64::INFINITY, |other| (other.middle() - ours[k].middle()).abs())
        };
        to(k.checked_sub(1).and_then(|k| ours.get(k))).min(to(ours.get(k + 1))) / 2.0
    };
    let only_theirs = |contact: &ContactRecord| ContactPair { ours: None, theirs: Some(contact.clone()) };
    let (mut pairs, mut late, mut next) = (Vec::new(), 0.0, 0);
    for (k, a) in ours.iter().enumerate() {
        let reach = reach(k);
        let apart = |b: &ContactRecord| b.middle() - late - a.middle();
        let until =
            |within: &dyn Fn(f64) -> bool| theirs[next..].iter().take_while(|b| within(apart(b))).count() + next;
        let (from, to) = (until(&|apart| apart < -reach), until(&|apart| apart <= reach));
        let agreement = |b: &ContactRecord| a.similarity(b, late) + 1.0 - apart(b).abs() / reach;
        let best = (from..to).max_by(|i, j| agreement(&theirs[*i]).total_cmp(&agreement(&theirs[*j])));
        let end = best.unwrap_or(from);
        pairs.extend(theirs[next..end].iter().map(only_theirs));
        pairs.push(ContactPair { ours: Some(a.clone()), theirs: best.map(|k| theirs[k].clone()) });
        if let Some(best) = best {
            late += apart(&theirs[best]);
        }
        next = end + usize::from(best.is_some());
    }
    pairs.extend(theirs[next..].iter().map(only_theirs));
    pairs
}

#[cfg(test)]
#[path = "tests/contacts.rs"]
mod tests;
