//! State after the first contact: from its closed form to the characteristic that leaves the ground at `t_b`.
//!
//! No event at the ground after `t_b` reaches a point with `ξ = t − x/c < t_b`. So at such points the motion is the
//! closed form, which continues as if the end were held. Its limit from `ξ < t_b` is the initial state of the cells:
//! only `p` jumps at upward rays, and `q` is continuous across them.

use std::collections::VecDeque;

use super::budget::{CUT_CELLS, FIRST_CELLS};
use super::effort::MARCHED_TRIPS;
use super::march::{Medium, State};
use super::start::Data;
use super::uncertainty::{Off, slack};
use crate::first_contact::FirstContact;
use crate::motion::{Scales, Side};
use crate::number::Estimate;
use crate::special::RoundedSpecial;

/// The motion before the first release, dimensionless.
#[derive(Clone, Debug)]
pub(super) struct Held<S> {
    contact: FirstContact<Estimate<S>>,
    /// `t_b`.
    pub(super) release: S,
    /// Bound of the motion from the release on, if the vibration has faded to a negligible size.
    faded: Option<f64>,
}

impl<S: RoundedSpecial> Held<S> {
    /// Builds the motion up to `release`, in the units of the problem; rounds a release near a lattice time to it.
    pub(super) fn until(contact: &FirstContact<Estimate<S>>, data: &Data<S>, release: &S) -> Self {
        let trips = release.clone() / &data.units.time;
        let near = (trips.clone() + trips.ratio(1, 2)).floor_int();
        let lattice = near.filter(|k| (trips.clone() - trips.int(*k)).magnitude() <= slack(&trips, 16));
        Held {
            faded: contact.faded(trips.to_f64()).map(f64::exp2),
            contact: contact.clone(),
            release: lattice.map_or_else(|| trips.clone(), |k| trips.int(k)),
        }
    }

    /// Computes `p`, `q` of `z` at a point with `ξ ≤ t_b ≤ t`, and a bound of the error of either.
    pub(super) fn invariants(&self, data: &Data<S>, x: &S, t: &S, side: Side) -> (S, S, f64) {
        if let Some(most) = self.faded {
            return (x.zero(), x.zero(), most);
        }
        let Scales { time, velocity: unit, length, wave_speed, .. } = &data.units;
        // A point within eight roundings of a ray counts as on the ray.
        let [point, time] = [x.clone() * x.int(2) * length, t.clone() * time].map(|at| Estimate::rounded(at, 8.0));
        let field = self.contact.field(&point, &time, side);
        let error = (field.velocity.bound() + wave_speed.to_f64() * field.strain.bound()) / unit.to_f64();
        let velocity = field.velocity.into_value() / unit;
        let strain = field.strain.into_value() * wave_speed / unit;
        let z_x = strain - data.gravity.clone() * x - &data.slope;
        (velocity.clone() - &z_x, velocity + z_x, error)
    }

    /// Returns the parts of `from ≤ x ≤ to` at time `t` between rays of the first contact, if longer than a rounding.
    pub(super) fn between_rays(&self, t: &S, from: &S, to: &S) -> Vec<(S, S)> {
        if to <= from {
            return Vec::new();
        }
        let mut cuts = vec![from.clone()];
        // Rays go up at ξ = k and come down at η = k; less than a round trip of the rod lies between from and to.
        let first = (t.clone() - to).floor_int().unwrap_or(0);
        for k in first..first + 4 {
            for x in [t.clone() - t.int(k), t.int(k) - t] {
                if x > *from && x < *to {
                    cuts.push(x);
                }
            }
        }
        cuts.push(to.clone());
        cuts.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
        let long = |pair: &&[S]| pair[1].clone() - &pair[0] > slack(t, 16);
        cuts.windows(2).filter(long).map(|pair| (pair[0].clone(), pair[1].clone())).collect()
    }

    /// Computes the state on the characteristic that leaves the ground at `t_b`, and a bound of its error: by cells
    /// from the impact on if the contact is short, otherwise by the closed form if its bound is smaller.
    pub(super) fn state(&self, medium: &Medium<S>, data: &Data<S>) -> (State<S>, f64) {
        let (trips, [surely, most]) = (self.release.to_f64(), MARCHED_TRIPS);
        if !medium.splits() || trips > most {
            return self.closed(medium, data);
        }
        let marched = self.marched(medium, data);
        if trips <= surely {
            return marched;
        }
        let closed = self.closed(medium, data);
        if closed.1 < marched.1 { closed } else { marched }
    }

    /// Computes that state by cells.
    fn marched(&self, medium: &Medium<S>, data: &Data<S>) -> (State<S>, f64) {
        let mut state = data.march(medium, &mut |_| {});
        let mut error = FIRST_CELLS * medium.cell_error(&state);
        loop {
            let left = self.release.clone() - state.time();
            if left <= slack(&self.release, 16) {
                break;
            }
            let cell = medium.cell_error(&state);
            if state.segments[0].len.clone() - &left > slack(&self.release, 16) {
                medium.cut_first(&mut state, &left, Off::default());
                error += CUT_CELLS * cell;
            }
            let segments = state.segments.len();
            medium.strip(&mut state, true, &mut |_| {});
            error += (2.0 + (segments - state.segments.len()) as f64) * cell;
        }
        // The place is that of the release itself; the sum of the strips differs by roundings.
        state.segments[0].at = self.release.clone() - self.release.int(state.round);
        (state, error)
    }

    /// Computes that state from the closed form.
    ///
    /// Between the rays `q` keeps the form given in the module `cell`, so the medium's number of terms suffices.
    fn closed(&self, medium: &Medium<S>, data: &Data<S>) -> (State<S>, f64) {
        let release = &self.release;
        let round = release.floor_int().unwrap_or(0);
        let (from, one) = (release.clone() - release.int(round), release.one());
        let half = release.ratio(1, 2);
        let mut pieces = vec![(from.clone(), one.clone() - &from)];
        if from.is_positive() {
            pieces.push((from.zero(), from));
        }
        let mut state = State { round, segments: VecDeque::new() };
        let (mut error, mut eta) = (0.0f64, release.clone());
        for (at, len) in pieces {
            let count = (len.clone() / &medium.longest).to_f64().ceil().max(1.0) as i64;
            let len = len / one.int(count);
            for k in 0..count {
                let value = |node: &S| {
                    let x = (node.clone() * &len + &eta - release) * &half;
                    let (_, q, off) = self.invariants(data, &x, &(release.clone() + &x), Side::Left);
                    error = error.max(off);
                    q
                };
                let values: Vec<S> = medium.basis.nodes().iter().map(value).collect();
                let at = at.clone() + len.clone() * len.int(k);
                state.segments.push_back(medium.segment(at, len.clone(), &values));
                eta = eta + &len;
            }
        }
        let error = error + FIRST_CELLS * medium.cell_error(&state);
        (state, error)
    }
}
