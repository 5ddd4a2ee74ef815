//! The attempts of a plan after the first, and the effort of each.

use super::plan::{CELLS, CellLimits, Climb, Engine, NEAR_MISS, PROOF_GUARD_BITS, Plan};
use super::question::Numbers;
use super::rung::{FEWEST_BITS, Lacks, Rung, rungs, size};
use crate::cells::Effort;

/// Bits of the series of a damped march beyond the estimated need of its answer.
const SERIES_GUARD_BITS: f64 = 6.0;
/// Bits that [`Effort::digits`] carries beyond those of its digits.
const EFFORT_BITS: f64 = 20.0;

impl Plan {
    /// Returns the rung after `rung`, by the deficit of the answer; `None` if no other numbers are worth trying.
    pub(crate) fn next(&self, rung: Rung, lacks: Lacks) -> Option<Rung> {
        if self.engine == Engine::Chain {
            return self.chain_rungs().into_iter().skip_while(|known| *known != rung).nth(1);
        }
        let Climb { bits: after, most_bits, near_miss, exact_roots, most_enclosed, .. } = self.climb;
        if most_bits <= FEWEST_BITS {
            return match (rung, lacks) {
                (Rung::Double, Lacks::Exactness) => Some(Rung::Fractions),
                (Rung::Double | Rung::Fractions, Lacks::Bits(_)) if after <= most_bits => Some(Rung::Bits(after)),
                _ => None,
            };
        }
        let Lacks::Bits(missing) = lacks else {
            // Fractions are fast, and end early if they do not apply; more bits distinguish a near miss from a meeting.
            return match rung {
                Rung::Double => Some(Rung::Fractions),
                Rung::Bits(bits) if bits < near_miss => Some(Rung::Bits(bits + NEAR_MISS)),
                Rung::Bits(bits) if matches!(self.numbers, Numbers::Double(_)) => Some(Rung::Confirmed(bits)),
                Rung::Bits(bits) => Some(Rung::Enclosures(bits)),
                Rung::Fractions | Rung::Confirmed(_) | Rung::Enclosures(_) => None,
            };
        };
        match rung {
            Rung::Fractions if matches!(self.numbers, Numbers::Exact | Numbers::ExactThenDigits(_)) => None,
            Rung::Fractions | Rung::Double => Some(Rung::Bits(after)),
            Rung::Bits(bits) => {
                // A double root needs two bits for each missing one.
                let more = if missing.is_finite() { (2.0 * missing).ceil() + 8.0 } else { f64::from(bits) };
                let next = f64::from(bits) + more.max(f64::from(bits / 4));
                if exact_roots.is_some_and(|most| next > f64::from(most)) {
                    Some(Rung::Enclosures(after))
                } else {
                    (next <= f64::from(most_bits)).then_some(Rung::Bits(size(next as u32)))
                }
            }
            Rung::Confirmed(bits) => Some(Rung::Enclosures(bits)),
            Rung::Enclosures(bits) => {
                let next = f64::from(bits) + missing.clamp(32.0, f64::from(bits));
                let fits = if self.cells.is_some() { size } else { |bits| bits };
                (next <= f64::from(most_enclosed)).then_some(Rung::Enclosures(fits(next as u32)))
            }
        }
    }

    /// Returns the numbers of the attempts at a body of a chain, in order.
    pub(super) fn chain_rungs(&self) -> Vec<Rung> {
        let rungs = rungs(self.numbers).into_iter();
        rungs.filter(|rung| rung.bits() <= self.climb.most_bits).collect()
    }

    /// Returns whether longer numbers may follow the first ones.
    pub(super) fn may_climb(&self) -> bool {
        self.climb.bits <= self.climb.most_bits
    }

    /// Returns the rungs to query, in order, if those of `rung` cannot distinguish a time from an event or a ray.
    pub(super) fn telling(&self, rung: Rung) -> Vec<Rung> {
        let exact = self.engine == Engine::Lattice && !matches!(rung, Rung::Bits(_));
        let longer = [1, 2, 4].map(|times| times * self.climb.bits).into_iter();
        let longer = longer.filter(|bits| *bits > rung.bits() && *bits <= self.climb.most_bits).map(Rung::Bits);
        exact.then_some(Rung::Fractions).into_iter().chain(longer).collect()
    }

    /// Returns the limits of a damped march in the numbers of `rung`. A run that has lost its events is useless if
    /// longer numbers follow.
    pub(super) fn effort(&self, rung: Rung) -> Effort {
        let CellLimits { double_digits, double_cells, long_cells, .. } = self.cells.unwrap_or(CELLS);
        let (digits, cells) = match rung {
            Rung::Bits(bits) | Rung::Enclosures(bits) => {
                let fewer = |cells: u64| (cells as f64 * (f64::from(FEWEST_BITS) / f64::from(bits)).powi(2)) as u64;
                let all = f64::from(bits) * std::f64::consts::LOG10_2 - 19.0;
                let needed = self.series_bits.filter(|_| bits == self.climb.bits);
                let digits = needed.map_or(all, |needed| all.min(series_digits(needed)));
                (digits, long_cells.map_or(u64::MAX, fewer))
            }
            _ => (double_digits, double_cells),
        };
        Effort { digits, cells, until_lost: self.may_climb() }
    }

    /// Returns the plan after a run in doubles that lacks this many bits.
    ///
    /// The bound of a march is roughly proportional to the truncation of its series and the roundings of its numbers;
    /// in doubles the roundings dominate. If this proportion fails, the rung after the next uses all terms.
    pub(crate) fn lacking(&self, missing: f64) -> Self {
        let bits = f64::from(f64::MANTISSA_DIGITS) + missing.max(0.0);
        Plan { series_bits: Some(bits), ..self.clone() }
    }

    /// Returns the digits of the series of a proof in this many bits. The first longer numbers use the digits that the
    /// answer needs plus the estimated cost of the proof; later ones use all.
    pub(super) fn proved_digits(&self, bits: u32) -> f64 {
        let all = f64::from(bits) * std::f64::consts::LOG10_2;
        let first = if self.rung == Rung::Double { self.climb.bits } else { self.rung.bits() };
        let wanted = self.goal.digits * std::f64::consts::LOG2_10;
        let spare = if matches!(self.numbers, Numbers::Digits(_)) { self.goal.spare } else { 0.0 };
        let needed = wanted + spare * std::f64::consts::LOG2_10 + f64::from(self.proof_bits + PROOF_GUARD_BITS);
        if bits == first { all.min(series_digits(needed)) } else { all }
    }
}

/// Returns the digits for series with a truncation below `2^−bits`.
fn series_digits(bits: f64) -> f64 {
    (bits + SERIES_GUARD_BITS - EFFORT_BITS) * std::f64::consts::LOG10_2
}
