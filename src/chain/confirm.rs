//! Runs whose coincidences enclosures confirm.

use std::ops::ControlFlow;

use super::definition::Chain;
use super::run::ChainRun;
use crate::error::Error;
use crate::motion::Ending;
use crate::number::{Bounded, Interval, IntervalPrecision, Scalar};

impl<N: Bounded> ChainRun<N> {
    /// Solves `chain` as [`ChainRun::new`] does. If events that agree within their bounds count as one, a run in
    /// enclosures of this many bits, with exact roots, may confirm that they coincide.
    ///
    /// The run is confirmed if that of the enclosures decides every event and has the same events and rays, each at the
    /// same time within the bounds, and if events and arrivals of rays that agree within the bounds are at equal times.
    ///
    /// **Errors**: those of [`ChainRun::new`].
    pub(crate) fn confirmed(
        chain: &Chain,
        precision: &N::Precision,
        bits: u32,
        observe: &dyn Fn(usize, usize) -> ControlFlow<()>,
    ) -> Result<Self, Error> {
        let run = ChainRun::new(chain, precision, observe)?;
        if run.doubt.is_none() || run.ending != Ending::Time {
            return Ok(run);
        }
        match ChainRun::<Interval>::new(chain, &IntervalPrecision::with_exact(bits), observe) {
            Ok(decided) if run.is_confirmed_by(&decided) => Ok(ChainRun { doubt: None, ..run }),
            Err(Error::Interrupted) => Err(Error::Interrupted),
            _ => Ok(run),
        }
    }

    fn is_confirmed_by(&self, decided: &ChainRun<Interval>) -> bool {
        let is_decided = decided.doubt.is_none() && decided.ending == Ending::Time;
        let mut events = self.events.iter().zip(&decided.events);
        let mut waves = self.waves.iter().flatten().zip(decided.waves.iter().flatten());
        is_decided
            && self.events.len() == decided.events.len()
            && self.touches.len() == decided.touches.len()
            && events.all(|(own, other)| (own.kind, own.node) == (other.kind, other.node) && agree(&own.t, &other.t))
            && waves.all(|(own, other)| {
                let (mut own, mut other) = (own.rays(), other.rays());
                loop {
                    match (own.next(), other.next()) {
                        (None, None) => return true,
                        (Some((own, _)), Some((other, _))) if agree(own, other) => {}
                        _ => return false,
                    }
                }
            })
            && self.meets_exactly(decided)
    }

    /// Returns whether events and arrivals of rays are at equal times in `decided` wherever they agree within the
    /// bounds. Both runs have the same of them.
    fn meets_exactly(&self, decided: &ChainRun<Interval>) -> bool {
        let events = self.events.iter().zip(&decided.events);
        let mut times: Vec<(N, Interval)> = events.map(|(own, other)| (own.t.clone(), other.t.clone())).collect();
        for (body, (own, other)) in self.waves.iter().zip(&decided.waves).enumerate() {
            let travels = (&self.bars[body].travel, &decided.bars[body].travel);
            for (own, other) in own.iter().zip(other) {
                let rays = own.rays().zip(other.rays());
                times.extend(rays.map(|((a, _), (b, _))| (a.clone() + travels.0, b.clone() + travels.1)));
            }
        }
        times.sort_by(|a, b| a.0.to_f64().total_cmp(&b.0.to_f64()));
        times.windows(2).all(|pair| !agree(&pair[0].0, &pair[1].1) || pair[0].1.same(&pair[1].1))
    }
}

/// Returns whether two numbers agree within their bounds, and the rounding to doubles.
fn agree<N: Bounded>(own: &N, other: &Interval) -> bool {
    let [a, b] = [own.to_f64(), other.to_f64()];
    (a - b).abs() <= own.log2_error().exp2() + other.log2_error().exp2() + 2.0 * f64::EPSILON * a.abs()
}
