//! Sums over a body of a chain.

use std::collections::VecDeque;
use std::sync::Mutex;

use crate::error::Error;
use crate::motion::maps;
use crate::number::Bounded;
use crate::threads::locked;

/// Energies, centre and momentum of a body.
#[derive(Clone, Debug)]
pub struct BodySums<N> {
    /// Mean displacement: that of the centre of mass.
    pub displacement: N,
    /// Mean velocity.
    pub velocity: N,
    /// Kinetic energy.
    pub kinetic: N,
    /// Strain energy.
    pub strain: N,
    /// Energy of height: weight times mean displacement.
    pub potential: N,
}

maps!(pub BodySums { displacement, velocity, kinetic, strain, potential });

/// The latest sums, each with its body and time: several quantities are made of the same ones. A clone has none.
#[derive(Debug)]
pub(super) struct KeptSums<N>(Mutex<VecDeque<(usize, N, BodySums<N>)>>);

/// Number of sums that are kept: several for each body, as threads ask at times of their own.
const KEPT_SUMS: usize = 32;

impl<N> Default for KeptSums<N> {
    fn default() -> Self {
        KeptSums(Mutex::default())
    }
}

impl<N> Clone for KeptSums<N> {
    fn clone(&self) -> Self {
        KeptSums::default()
    }
}

impl<N: Bounded> KeptSums<N> {
    /// Returns the sums over a body at a time, which `make` computes if they are not kept.
    pub(super) fn get(
        &self,
        body: usize,
        time: &N,
        make: impl FnOnce() -> Result<BodySums<N>, Error>,
    ) -> Result<BodySums<N>, Error> {
        let is_same =
            |at: &N| at.alike(time) && at.log2_error() == time.log2_error() && at.spelled_as() == time.spelled_as();
        let known = |(own, at, _): &&(usize, N, BodySums<N>)| *own == body && is_same(at);
        if let Some((.., sums)) = locked(&self.0).iter().find(known) {
            return Ok(sums.clone());
        }
        let sums = make()?;
        let mut kept = locked(&self.0);
        kept.truncate(KEPT_SUMS - 1);
        kept.push_front((body, time.clone(), sums.clone()));
        Ok(sums)
    }
}
