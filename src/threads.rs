//! Work that falls into independent parts, on several threads.

use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Number of threads that work at the same time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Threads(NonZero<usize>);

impl Default for Threads {
    /// Returns one thread for each core.
    fn default() -> Self {
        Threads(std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN))
    }
}

impl Threads {
    /// Returns the number of threads.
    pub(crate) fn count(self) -> usize {
        self.0.get()
    }

    /// Returns the answers for every index below `count`, in order.
    ///
    /// **Errors**: that of the least index among those that failed before all threads had stopped.
    pub(crate) fn all<T: Send, E: Send>(
        self,
        count: usize,
        one: impl Fn(usize) -> Result<T, E> + Sync,
    ) -> Result<Vec<T>, E> {
        let mut found: Vec<Mutex<Option<Result<T, E>>>> = Vec::new();
        found.resize_with(count, Mutex::default);
        self.each(count, &|k| {
            let answer = one(k);
            let fine = answer.is_ok();
            *locked(&found[k]) = Some(answer);
            fine
        });
        let mut all = Vec::with_capacity(count);
        for answer in found {
            // After an error the rest is empty.
            if let Some(answer) = answer.into_inner().unwrap_or_else(PoisonError::into_inner) {
                all.push(answer?);
            }
        }
        Ok(all)
    }

    /// Visits every index below `count`; none are begun after a visit that was refused.
    fn each(self, count: usize, visit: &(dyn Fn(usize) -> bool + Sync)) {
        let next = AtomicUsize::new(0);
        let work = || loop {
            let k = next.fetch_add(1, Ordering::Relaxed);
            if k >= count {
                break;
            }
            if !visit(k) {
                next.store(count, Ordering::Relaxed);
            }
        };
        std::thread::scope(|scope| {
            for _ in 1..self.count().min(count) {
                scope.spawn(work);
            }
            work();
        });
    }
}

/// Locks a value that is only ever replaced whole, so that a panic leaves it usable.
pub(crate) fn locked<T>(kept: &Mutex<T>) -> MutexGuard<'_, T> {
    kept.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
#[path = "tests/threads.rs"]
mod tests;
