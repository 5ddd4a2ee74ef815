//! The flights between the contacts, and how high they go.

use crate::history::{EventKind, History};
use crate::number::Scalar;

/// A flight of the rod.
#[derive(Clone, Debug, PartialEq)]
pub struct Flight<S> {
    /// Its beginning.
    pub from: S,
    /// Its end; `None` where the history ends before.
    pub to: Option<S>,
    /// `t*` and `h_max = h(t*)`, where the centre of mass turns within the flight.
    pub highest: Option<(S, S)>,
}

/// The flights of a history, in order.
///
/// **Source**: Remark 2, for every flight and not just the first.
///
/// **Accuracy**: *exact* for exact histories, otherwise that of `h` and `h′` at the release.
///
/// ```
/// use dalembert::{Number, Problem, quantity::flights, solve::undamped};
/// let problem = Problem::uniform(Number::from(1), Number::from(1), Number::from(1), Number::from(4));
/// let history = undamped::<f64>(&problem, &())?;
/// // μ²/2g − 2gL²/3c² = 8 − 2/3, reached at (2gL + μc)/cg = 6.
/// let (time, height) = flights(&history)[0].highest.unwrap();
/// assert!((time - 6.0).abs() < 1e-14 && (height - 22.0 / 3.0).abs() < 1e-14);
/// # Ok::<(), dalembert::Error>(())
/// ```
pub fn flights<S: Scalar>(history: &dyn History<S>) -> Vec<Flight<S>> {
    let events = history.events();
    let end = history.end();
    let releases = events.iter().enumerate().filter(|(_, event)| event.kind == EventKind::Release);
    releases
        .map(|(k, release)| {
            let to = events.get(k + 1).map(|impact| impact.time.clone());
            let last = to.as_ref().unwrap_or(&end);
            let highest = history.highest(release).filter(|(time, _)| time <= last);
            Flight { from: release.time.clone(), to, highest }
        })
        .collect()
}
