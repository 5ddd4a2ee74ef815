//! The number of wave pieces of a run, foreseen from its beginning.

use std::ops::ControlFlow;
use std::sync::Arc;

use super::definition::Chain;
use crate::error::Error;
use crate::solve::Numbers;

/// The wave pieces of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ForeseenPieces {
    /// The pieces of a run to its end.
    Counted(usize),
    /// An estimate by the power of the time with which the pieces grow.
    Estimated {
        /// The pieces of the whole run.
        pieces: f64,
        /// The power.
        power: f64,
        /// The time up to which they were counted.
        time: f64,
    },
}

/// Wave pieces from which on a run is not counted to its end.
const MOST_COUNTED: usize = 100_000;
/// Number of times that the time of a run is halved at most, to see how its pieces grow.
const HALVINGS: i32 = 40;

impl Chain {
    /// Returns the wave pieces that a run in doubles takes: a long run is made in part, and the rest is extrapolated.
    ///
    /// **Accuracy**: a count up to 100,000 pieces, beyond that an *estimate*.
    ///
    /// **Errors**: those of the run; [`Error::TooManyPieces`] if no part of the run is short enough.
    ///
    /// ```
    /// use dalembert::chain::{Body, Chain, ForeseenPieces};
    /// let bar = |velocity: i64| Body::new(1.into(), 1.into(), 1.into()).with_velocity(velocity.into());
    /// let chain = Chain::builder(bar(0)).contact(1.into(), bar(-1)).until(4.into()).build()?;
    /// assert!(matches!(chain.foresee_pieces()?, ForeseenPieces::Counted(1..100)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn foresee_pieces(&self) -> Result<ForeseenPieces, Error> {
        let count = |chain: &Chain| {
            let observe = Arc::new(|_, pieces| match pieces > MOST_COUNTED {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            });
            match chain.solve_observed(Numbers::default(), observe) {
                Ok(history) => Ok(Some(history.pieces())),
                Err(Error::Interrupted | Error::TooManyPieces { .. }) => Ok(None),
                Err(error) => Err(error),
            }
        };
        if let Some(pieces) = count(self)? {
            return Ok(ForeseenPieces::Counted(pieces));
        }
        // The latest time of a run that is counted, and half of it.
        let whole = self.until().to_f64();
        let mut found: Option<(f64, f64)> = None;
        for halvings in 1..=HALVINGS {
            let time = whole / 2f64.powi(halvings);
            let until = format!("{time:e}").parse().map_err(|_| Error::NotDecided { what: "a time", bits: 53 })?;
            let Some(pieces) = count(&self.with_until(until)?)?.map(|pieces| pieces.max(1) as f64) else { continue };
            if let Some((time, later)) = found {
                let power = (later / pieces).log2().max(1.0);
                return Ok(ForeseenPieces::Estimated { pieces: later * (whole / time).powf(power), power, time });
            }
            found = Some((time, pieces));
        }
        Err(Error::TooManyPieces { limit: MOST_COUNTED, time: 0.0 })
    }
}
