//! Medians and spreads of repeated runs.

use std::hint::black_box;
use std::time::{Duration, Instant};

use crate::value::NoAnswer;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// The median, seconds.
    pub seconds: f64,
    /// The distance of the quartiles, seconds; `None` where it ran once.
    pub spread: Option<f64>,
    pub runs: usize,
}

/// A sample shorter than this is mostly the clock itself: short runs are timed many at a time.
const SHORTEST: f64 = 4e-5;
const MOST_SAMPLES: usize = 31;

impl Timing {
    /// Median and distance of the quartiles of `samples`, linear between them.
    pub fn of(samples: &mut [f64]) -> Self {
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

/// Refuses a budget that is no time.
pub fn check_budget(seconds: f64) -> Result<(), NoAnswer> {
    let refused = || NoAnswer::gave_up(format!("found {seconds} seconds, expected more than 0 and at most 86400"));
    if seconds > 0.0 && seconds <= 86_400.0 { Ok(()) } else { Err(refused()) }
}

/// Seconds that one call takes, averaged over `batch` calls.
pub fn sample<T>(batch: u32, mut run: impl FnMut() -> T) -> f64 {
    let start = Instant::now();
    for _ in 0..batch {
        black_box(run());
    }
    start.elapsed().as_secs_f64() / f64::from(batch)
}

/// How many calls make a sample long enough to be timed.
pub fn batch(once: f64) -> u32 {
    (SHORTEST / once.max(1e-9)).ceil().clamp(1.0, 1e5) as u32
}

/// Repeats `run`, which took `once` the first time, for about `slot`.
///
/// The first run counts only where nothing else fits: it finds caches and branch predictors cold.
pub fn repeat<T>(once: f64, slot: Duration, mut run: impl FnMut() -> T) -> Timing {
    let start = Instant::now();
    let slot = slot.as_secs_f64();
    let mut samples = Vec::with_capacity(MOST_SAMPLES);
    let mut batched = batch(once);
    while samples.len() < MOST_SAMPLES && start.elapsed().as_secs_f64() + once * f64::from(batched) < slot {
        let took = sample(batched, &mut run);
        // What was slow for being first is timed in batches after all.
        if samples.is_empty() && batch(took) > 2 * batched {
            batched = batch(took);
            continue;
        }
        samples.push(took);
    }
    if samples.len() < 2 {
        samples.push(once);
    }
    Timing::of(&mut samples)
}

#[cfg(test)]
#[path = "tests/clock.rs"]
mod tests;
