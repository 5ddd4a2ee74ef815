//! Times of repeated runs: medians and spreads.

use std::hint::black_box;
use std::time::{Duration, Instant};

use crate::error::VerifyError;

/// The time of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// The median, seconds.
    pub seconds: f64,
    /// The distance of the quartiles, seconds; `None` for a single run.
    pub spread: Option<f64>,
    /// Number of runs.
    pub runs: usize,
}

/// Least time of a sample, seconds: shorter runs are timed many at a time.
const SHORTEST: f64 = 4e-5;
const MOST_SAMPLES: usize = 31;

impl Timing {
    /// Computes median and distance of the quartiles of `samples`, interpolated linearly.
    pub(super) fn from_samples(samples: &mut [f64]) -> Self {
        samples.sort_by(f64::total_cmp);
        let at = |part: f64| {
            let place = part * (samples.len().max(1) - 1) as f64;
            let at = |k: usize| samples.get(k).or(samples.last()).copied().unwrap_or(f64::NAN);
            let (low, share) = (place.floor() as usize, place.fract());
            at(low) + share * (at(low + 1) - at(low))
        };
        let spread = (samples.len() > 1).then(|| at(0.75) - at(0.25));
        Timing { seconds: at(0.5), spread, runs: samples.len() }
    }
}

/// Checks that a budget is a time.
pub(super) fn check_budget(seconds: f64) -> Result<(), VerifyError> {
    if seconds > 0.0 && seconds <= 86_400.0 { Ok(()) } else { Err(VerifyError::Budget(seconds)) }
}

/// Measures the seconds of one call, averaged over `batch` calls.
pub(super) fn sample<T>(batch: u32, mut run: impl FnMut() -> T) -> f64 {
    let start = Instant::now();
    for _ in 0..batch {
        black_box(run());
    }
    start.elapsed().as_secs_f64() / f64::from(batch)
}

/// Returns the number of calls that make a sample long enough, where one call takes `once` seconds.
pub(super) fn batch_size(once: f64) -> u32 {
    (SHORTEST / once.max(1e-9)).ceil().clamp(1.0, 1e5) as u32
}

/// Repeats `run`, which took `once` seconds the first time, for about `slot`.
///
/// The first run, with cold caches and branch predictors, counts only where no other run fits.
pub(super) fn repeat<T>(once: f64, slot: Duration, mut run: impl FnMut() -> T) -> Timing {
    let start = Instant::now();
    let slot = slot.as_secs_f64();
    let mut samples = Vec::with_capacity(MOST_SAMPLES);
    let mut batched = batch_size(once);
    while samples.len() < MOST_SAMPLES && start.elapsed().as_secs_f64() + once * f64::from(batched) < slot {
        let took = sample(batched, &mut run);
        // A run that was slow only the first time is timed in batches after all.
        if samples.is_empty() && batch_size(took) > 2 * batched {
            batched = batch_size(took);
            continue;
        }
        samples.push(took);
    }
    if samples.len() < 2 {
        samples.push(once);
    }
    Timing::from_samples(&mut samples)
}

#[cfg(test)]
#[path = "tests/timing.rs"]
mod tests;
