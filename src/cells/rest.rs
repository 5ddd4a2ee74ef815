//! Proofs that no release, no impact or no motion at all can follow.
//!
//! In natural units `d` is the deviation from the state at rest, `p`, `q` are its invariants, `B` is a bound of them on
//! one upward characteristic. By the sup norm of [`super::cell`] and the reflections `p = ±q`, `B` bounds them at all
//! later points.

use super::follow::{Follower, Goal};
use super::march::Medium;
use super::piece::Piece;
use super::record::Record;
use super::series::bound;
use super::strips::{Node, Pool};
use crate::motion::Ending;
use crate::reason::{NoBounceReason, Reason, StillState};
use crate::special::RoundedSpecial;

/// Multiple of the accumulated error below which a motion counts as over.
const OVER: f64 = 3.0;

impl<S: RoundedSpecial> Follower<'_, S> {
    /// Returns the reason why no impact can follow, if this is proved; only where gravity does not pull the end back.
    ///
    /// In flight the end swings about a state at height `s = v_s′(0)/2`, stress-free at the ground and with the strain
    /// of its weight `v_x = gx` above (top fixed), or about the centre of mass (top free, `g = 0`), whose height `h`
    /// tends monotonically to `h + h′/2r`. The deviation `d` has an energy `E` that cannot grow, and `|d(0)| ≤ √ℓ
    /// ‖d_x‖`, `‖d_x‖ ≤ √(2E)`, with `ℓ = ½` for a fixed top; `ℓ = ⅙` where the mean of `d` vanishes, as then `d(0) =
    /// −∫(1 − 2x) d_x dx`. No impact follows once `√(2ℓE)` is less than the least height.
    pub(super) fn escapes(&self) -> Option<Ending> {
        let (medium, data) = (self.medium, self.data);
        let slope = medium.slope.to_f64();
        // Gravity makes the slope negative under a free top.
        if slope < 0.0 {
            return None;
        }
        let (pieces, checkpoints, flights) = (&self.pieces, &self.checkpoints, &self.flights);
        let pool = &Pool::default();
        let record = Record { medium, data, pieces, checkpoints, flights, pool };
        let t = self.state.time();
        let nodes = record.line(&t, &t.ratio(1, 2));
        let sum = |f: &dyn Fn(f64, f64, f64) -> f64| -> f64 {
            let term = |n: &Node<S>| n.weight.to_f64() * f(n.x.to_f64(), n.velocity().to_f64(), n.strain.to_f64());
            nodes.iter().map(term).sum()
        };
        let (least, rate, share) = if medium.free_top {
            let rate = 2.0 * sum(&|_, v_t, _| v_t);
            let mean = self.height.to_f64() + 2.0 * sum(&|x, _, v_x| (0.5 - x) * v_x);
            // The rise h′/2r, where 4κ = 2r.
            let rise = rate / (4.0 * medium.kappa.to_f64());
            (mean.min(mean + rise), rate, sum(&|_, v_t, v_x| (v_t - rate).powi(2) + v_x.powi(2)) / 6.0)
        } else {
            let weight = medium.gravity.to_f64();
            (slope / 2.0, f64::INFINITY, sum(&|x, v_t, v_x| v_t.powi(2) + (v_x - weight * x).powi(2)) / 2.0)
        };
        let (kappa, masses) = (medium.kappa.to_f64(), self.budget.masses());
        let off = 8.0 * (self.trace_error() + self.height_most(0.0, 0.0)) + masses;
        // A centre that may fall does so by the rise, which is off by δh′/2r.
        let fallen = if rate > off { 0.0 } else { off / (4.0 * kappa) };
        // Displaced rays enter the root of an energy by that of mass times jump. The values of the present are at most
        // e^κ times those of the characteristic that begins now, and no greater than those of the start.
        let jump = (2.0 * kappa.exp() * self.state.bound()).min(256.0 * data.most);
        let displaced = (jump * masses).sqrt();
        let swing = share.sqrt() + off + fallen + displaced;
        (least > swing).then(|| {
            let unit = data.displacement.to_f64();
            let from = (t * &data.units.time).to_f64();
            Ending::NoFurtherImpact(Reason::StaysAbove { from, swing: swing * unit, height: least * unit })
        })
    }

    /// Returns the reason why no release can follow, if this is proved.
    ///
    /// In contact `p = −q` at the ground and `p = ±q` at the top, so `|q| ≤ B` on one characteristic gives `|q| ≤ B` at
    /// all later times, and with `B < |v_s′(0)|`, `v_s′(0) < 0`, the stress `q + v_s′(0)` stays negative. The run still
    /// follows the first round trip of the contact, for its peak.
    pub(super) fn stays(&self) -> Option<Ending> {
        let (round, at) = self.landing.as_ref()?;
        let first = &self.state.segments[0].at;
        if self.state.round <= *round || self.state.round == *round + 1 && first < at {
            return None;
        }
        let most = self.state.bound() + self.trace_error();
        let slope = self.medium.slope.to_f64();
        (self.contact && slope < 0.0 && most < -slope).then(|| {
            let from = (self.state.time() * &self.data.units.time).to_f64();
            self.held(Reason::StaysPressed { from, part: most / -slope })
        })
    }

    /// Returns the ending of a contact that lasts for ever.
    fn held(&self, reason: Reason) -> Ending {
        if self.marks.len() > 1 { Ending::Rest(reason) } else { Ending::NoBounce(reason) }
    }

    /// Bounds velocities and displacements from now on, as deviations from the state at rest, if that state is
    /// determined.
    ///
    /// - Pressed on the ground, `v_s′(0) < 0`, in contact for ever: `B` and `B/2`, as `d(0) = 0` and `d_x ≤ B` on a rod
    ///   of length ½.
    /// - Hanging from a fixed top, `v_s′(0) > 0`, in flight: `B` and `B/2` from the top, less than the height of the
    ///   end.
    /// - Neither, `v_s′(0) = 0`: then `v_s` solves both contact and flight, and `B` holds after every event. Under a
    ///   fixed top displacements are at most `B/2`. Under a free one `(h′ + 2rh)′ = −c²v_x/L` vanishes in flight: from
    ///   a height of the end now, or in later flights from a contact, in which `|h| ≤ B/4`, the centre moves by at most
    ///   `B/2r`; the end is at most `B/4` from it, and neither moves faster than `B`, whatever events follow.
    fn left(&self, time: f64) -> Option<(f64, f64)> {
        let Medium { slope, kappa, free_top, .. } = self.medium;
        let value = slope.to_f64();
        // The rate h′ of a separated flight without gravity tends to zero.
        let mut most = self.state.bound() + self.centre().map_or(0.0, |(_, rate)| rate.to_f64().abs());
        if value > 0.0 && !self.contact {
            // q of the deviation from the hanging rod is q + slope.
            let raised = self.state.segments.iter().map(|segment| bound(&self.medium.raised(segment, slope), 0));
            most = raised.fold(0.0, f64::max);
        }
        let velocity = most + self.noise();
        let clear = if self.contact { value <= 0.0 } else { value >= 0.0 };
        let far = if value == 0.0 && *free_top {
            (velocity * (1.0 + 1.0 / (4.0 * kappa.to_f64()))).min(velocity * time.max(1.0))
        } else {
            velocity / 2.0
        };
        let over = most <= OVER * self.noise() && (value == 0.0 || velocity < value.abs());
        (clear && over).then_some((velocity, far))
    }

    /// Ends a run whose motion is below its own error: the state at rest answers for the rest of the time.
    ///
    /// `since` is the first time of that condition. A round trip later the bound holds on whole lines of constant time,
    /// not only on a characteristic, and the state at rest may stand for the field.
    pub(super) fn settle(&mut self, goal: &Goal<S>, since: &mut Option<S>) -> Option<Ending> {
        // The state at rest proves nothing about a given time.
        if self.proof.is_some() && matches!(goal, Goal::Time(_)) {
            return None;
        }
        let now = self.state.time();
        let time = match goal {
            Goal::Time(end) => (end.clone() - &now).to_f64(),
            Goal::Impacts(_) => f64::INFINITY,
        };
        let (velocity, far) = self.left(time)?;
        let neither = self.medium.slope.is_zero();
        let units = &self.data.units;
        let (from, speed) = ((now.clone() * &units.time).to_f64(), velocity * units.velocity.to_f64());
        let still = |state| Reason::Still { from, speed, state };
        let Goal::Time(end) = goal else {
            // A rod that nothing moves or presses stays where it is.
            let nothing = || Reason::NoBounce(NoBounceReason::NothingMoves);
            return neither.then(|| match (speed == 0.0, self.contact) {
                (true, true) => self.held(nothing()),
                (true, false) => Ending::NoFurtherImpact(nothing()),
                (false, _) => Ending::Undecided(still(StillState::Open)),
            });
        };
        let since = since.get_or_insert_with(|| now.clone());
        if (now.clone() - &*since).to_f64() < 1.0 || time < 1.0 {
            return None;
        }
        let zero = now.zero();
        let rest = if self.medium.free_top { self.height.clone() } else { self.medium.slope.clone() * now.ratio(1, 2) };
        let ending = if self.contact && !neither {
            self.held(still(StillState::Pressed))
        } else if !self.contact && rest.to_f64() > far + self.height_most(0.0, 0.0) {
            Ending::NoFurtherImpact(still(StillState::Above(rest.to_f64() * self.data.displacement.to_f64())))
        } else {
            Ending::Rest(still(StillState::Faint))
        };
        let (trace, height) = if self.contact {
            (vec![self.medium.slope.clone(), zero], Vec::new())
        } else {
            (vec![zero.clone(), zero.clone()], vec![rest, zero])
        };
        self.budget.rest(far);
        self.budget.add(velocity);
        let len = end.clone() - &now;
        self.pieces.push(Piece { still: true, trace, height, ..Piece::new(now, len, self.contact, None) });
        Some(ending)
    }
}
