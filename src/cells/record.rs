//! From what is kept back to the field: the cells are marched again from the last state that was kept.
//!
//! Kept are the trace at the ground and one state for every round trip; everything between is the same march once more, with
//! the cuts that are known. A question costs at most two round trips of cells, and memory is that of a trace.

use super::bounce::Held;
use super::cell::Cell;
use super::follow::Piece;
use super::march::{Medium, State};
use super::series::evaluate;
use super::start::Data;
use crate::history::Side;
use crate::special::RoundedSpecial;

/// All that the field follows from.
#[derive(Debug)]
pub(super) struct Record<'a, S> {
    pub(super) medium: &'a Medium<S>,
    pub(super) data: &'a Data<S>,
    pub(super) held: Option<&'a Held<S>>,
    pub(super) pieces: &'a [Piece<S>],
    pub(super) checkpoints: &'a [(usize, State<S>)],
}

/// A node of a quadrature along the rod.
#[derive(Clone, Debug)]
pub(super) struct Node<S> {
    /// Weight.
    pub(super) weight: S,
    /// `x`.
    pub(super) x: S,
    /// `z_t`.
    pub(super) z_t: S,
    /// `z_x`.
    pub(super) z_x: S,
}

impl<S: RoundedSpecial> Record<'_, S> {
    /// Shows every cell of the strips that meet `from ≤ ξ ≤ to`, in order of `ξ`, then of `η`.
    fn sweep(&self, from: &S, to: &S, visit: &mut impl FnMut(&Cell<'_, S>)) {
        if from.is_negative() && self.held.is_none() {
            self.data.march(self.medium, visit);
        }
        let first = self.pieces.partition_point(|piece| piece.to() < *from);
        let kept = self.checkpoints.partition_point(|(index, _)| *index <= first);
        let Some((index, state)) = kept.checked_sub(1).and_then(|k| self.checkpoints.get(k)) else { return };
        let mut state = state.clone();
        for (k, piece) in self.pieces.iter().enumerate().skip(*index) {
            if piece.still || piece.from > *to {
                break;
            }
            if piece.cut {
                self.medium.cut_first(&mut state, &piece.len, 0.0);
            }
            if k >= first {
                self.medium.strip(&mut state, piece.contact, visit);
            } else {
                self.medium.strip(&mut state, piece.contact, &mut |_| {});
            }
        }
    }

    /// Gauss–Legendre nodes on `0 ≤ x ≤ reach` at time `t`, between all rays.
    ///
    /// **Accuracy**: that of the cells: between rays the squares of `z_t`, `z_x` grow at most like `e^{4κ|s|}`, for which the
    /// tables hold enough terms, and the rule is exact to twice its nodes.
    pub(super) fn line(&self, t: &S, reach: &S) -> Vec<Node<S>> {
        let zero = t.zero();
        let half = t.ratio(1, 2);
        let mut nodes = Vec::new();
        if let Some(z_x) = self.at_rest(t) {
            for (at, weight) in &self.medium.basis.gauss {
                let (x, weight) = (at.clone() * reach, weight.clone() * reach);
                nodes.push(Node { weight, x, z_t: zero.clone(), z_x: z_x.clone() });
            }
            return nodes;
        }
        let mut visit = |cell: &Cell<'_, S>| {
            let (xi, eta) = &cell.corner;
            let low = larger(larger(t.clone() - xi - &cell.size.0, eta.clone() - t), zero.clone());
            let high = smaller(smaller(t.clone() - xi, eta.clone() + &cell.size.1 - t), reach.clone());
            let len = high - &low;
            if !len.is_positive() {
                return;
            }
            for (at, weight) in &self.medium.basis.gauss {
                let x = len.clone() * at + &low;
                let (p, q) = self.inside(cell, &(t.clone() - &x), &(t.clone() + &x));
                let z_t = (p.clone() + &q) * &half;
                let z_x = (q - &p) * &half;
                nodes.push(Node { weight: weight.clone() * &len, x, z_t, z_x });
            }
        };
        self.sweep(&(t.clone() - reach), t, &mut visit);
        if let Some(held) = self.held {
            for (from, to) in held.between_rays(t, &larger(t.clone() - &held.release, zero), reach) {
                let len = to - &from;
                for (at, weight) in &self.medium.basis.gauss {
                    let x = len.clone() * at + &from;
                    let (p, q, _) = held.invariants(&x, t, Side::Right);
                    let (z_t, z_x) = ((p.clone() + &q) * &half, (q - p) * &half);
                    nodes.push(Node { weight: weight.clone() * &len, x, z_t, z_x });
                }
            }
        }
        nodes
    }

    /// `z_x`, the same along the rod, where the rod is at rest at time `t`.
    fn at_rest(&self, t: &S) -> Option<S> {
        let last = self.pieces.last().filter(|piece| piece.still && *t > piece.from)?;
        Some(if last.contact { t.zero() } else { -self.medium.slope.clone() })
    }

    /// `p`, `q` of `z` in a cell.
    fn inside(&self, cell: &Cell<'_, S>, xi: &S, eta: &S) -> (S, S) {
        cell.at(&self.medium.basis, xi, eta, self.medium.log2_accuracy)
    }

    /// `z_t` and `z_x` at a point, from the named side in time.
    pub(super) fn at(&self, x: &S, t: &S, side: Side) -> (S, S) {
        if let Some(z_x) = self.at_rest(t) {
            return (t.zero(), z_x);
        }
        let (xi, eta) = (t.clone() - x, t.clone() + x);
        let slack = slack(t);
        let half = x.ratio(1, 2);
        let before = |held: &&Held<S>| match side {
            Side::Right => xi < held.release.clone() - &slack,
            Side::Left => xi <= held.release.clone() + &slack,
        };
        if let Some(held) = self.held.filter(before) {
            let (p, q, _) = held.invariants(x, t, side);
            return ((p.clone() + &q) * &half, (q - p) * half);
        }
        // The last cell that has begun; where none has, the first.
        let begun = |corner: &S, at: &S| match side {
            Side::Right => *corner <= at.clone() + &slack,
            Side::Left => *corner < at.clone() - &slack,
        };
        let mut best = None;
        let mut visit = |cell: &Cell<'_, S>| {
            if best.is_none() || (begun(&cell.corner.0, &xi) && begun(&cell.corner.1, &eta)) {
                best = Some(self.inside(cell, &xi, &eta));
            }
        };
        // One strip earlier for the left limit.
        let from = xi.clone() - &slack - &slack;
        self.sweep(&from, &(xi.clone() + &slack), &mut visit);
        let (p, q) = best.unwrap_or((x.zero(), x.zero()));
        ((p.clone() + &q) * &half, (q - p) * half)
    }

    /// The piece of the trace at time `t`, and where in it: `0 … 1`.
    pub(super) fn piece(&self, t: &S, side: Side) -> Option<(&Piece<S>, S)> {
        let slack = slack(t);
        let next = match side {
            Side::Right => self.pieces.partition_point(|piece| piece.from <= t.clone() + &slack),
            Side::Left => self.pieces.partition_point(|piece| piece.from < t.clone() - &slack),
        };
        let piece = self.pieces.get(next.saturating_sub(1))?;
        let at = (t.clone() - &piece.from) / &piece.len;
        Some((piece, smaller(larger(at, t.zero()), t.one())))
    }

    /// `v(0,t)`.
    pub(super) fn height(&self, t: &S) -> S {
        match self.piece(t, Side::Left) {
            Some((piece, at)) if !piece.contact => evaluate(&piece.height, &at),
            Some(_) => t.zero(),
            None => self.data.ground.clone(),
        }
    }
}

/// How close to a ray a time is taken to be on it: a few roundings.
fn slack<S: RoundedSpecial>(t: &S) -> S {
    let unit = t.double(t.log2_roundoff().exp2());
    (t.magnitude() + t.one()) * unit * t.int(8)
}

fn larger<S: RoundedSpecial>(a: S, b: S) -> S {
    if a < b { b } else { a }
}

fn smaller<S: RoundedSpecial>(a: S, b: S) -> S {
    if b < a { b } else { a }
}
