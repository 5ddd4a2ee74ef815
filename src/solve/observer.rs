//! Who is told how far a run is.

use std::ops::ControlFlow;
use std::sync::{Arc, LazyLock};

/// Receives from time to time how far a run is, in round trips, or in contacts where so many are asked for, and how
/// many pieces it has; may end the run with [`Error::Interrupted`](crate::Error::Interrupted).
pub type Observer = Arc<dyn Fn(usize, usize) -> ControlFlow<()> + Send + Sync>;

pub(super) static UNOBSERVED: LazyLock<Observer> = LazyLock::new(|| Arc::new(crate::lattice::unobserved));

/// An observer that does nothing.
pub(crate) fn unobserved() -> Observer {
    UNOBSERVED.clone()
}
