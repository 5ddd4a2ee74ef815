//! Reconstruction of the field: the cells are marched again from the nearest stored state.
//!
//! The run stores the trace at the ground and one state for every round trip. A query marches again over the cells in
//! between, with the known cuts. It costs at most two round trips of cells, less after a query about a time nearby, and
//! the memory is that of a trace.

use super::cell::Cell;
use super::flight::Flight;
use super::march::Medium;
use super::piece::{Checkpoint, Piece};
use super::series::{evaluate, smaller};
use super::start::Data;
use super::strips::{Line, MOST_KEPT, Node, Nodes, Pool, Strips};
use super::uncertainty::slack;
use crate::motion::Side;
use crate::number::Scalar;
use crate::special::RoundedSpecial;

/// Data from which the field is reconstructed.
#[derive(Debug)]
pub(super) struct Record<'a, S: Scalar> {
    pub(super) medium: &'a Medium<S>,
    pub(super) data: &'a Data<S>,
    pub(super) pieces: &'a [Piece<S>],
    pub(super) checkpoints: &'a [Checkpoint<S>],
    pub(super) flights: &'a [Flight<S>],
    pub(super) pool: &'a Pool<S>,
}

/// A visited cell, with the flight whose vibration it holds.
type Passing<'a, 'b, 'c, S> = (&'a Cell<'b, S>, Option<&'c Flight<S>>);

/// Function that computes `h′`, the rest of `v_t`, and `v_x` at places.
type Values<'a, S> = dyn Fn(&[S]) -> Vec<(S, S, S)> + 'a;

impl<S: RoundedSpecial> Record<'_, S> {
    /// Visits every cell of the strips that meet `from ≤ ξ ≤ to`, in order of `ξ`, then of `η`.
    fn sweep<'c>(&'c self, from: &S, to: &S, visit: &mut dyn FnMut(Passing<'_, '_, 'c, S>)) {
        if from.is_negative() {
            self.data.march(self.medium, &mut |cell| visit((cell, None)));
        }
        let first = self.pieces.partition_point(|piece| piece.to() < *from);
        let kept = self.checkpoints.partition_point(|kept| kept.index <= first);
        let Some((start, kept)) = kept.checked_sub(1).and_then(|k| Some((k, self.checkpoints.get(k)?))) else { return };
        let mut strips = self.pool.take(start).unwrap_or_else(|| Strips::after(start, kept));
        // A rod at rest is not marched.
        let marched = self.pieces.len() - usize::from(self.pieces.last().is_some_and(|piece| piece.still));
        let until = self.pieces[..marched].partition_point(|piece| piece.from <= *to);
        let mut next = kept.index;
        for (strip, piece) in self.pieces[..until].iter().skip(kept.index).enumerate() {
            if strip == strips.count() {
                if piece.leap > 0 || strips.size >= MOST_KEPT {
                    break;
                }
                strips.keep(self.medium, self.flights, piece);
            }
            if next >= first {
                let flight = piece.flight.and_then(|k| self.flights.get(k));
                strips.show(strip, &mut |cell| visit((cell, flight)));
            }
            next += 1;
        }
        if next < until {
            self.sweep_on((next, first, until), strips.ahead(), (from, to, kept.index), visit);
        }
        self.pool.put(strips);
    }

    /// Visits the cells from piece `next` on without keeping them: leaps, and strips with many rays.
    fn sweep_on<'c>(
        &'c self,
        (next, first, until): (usize, usize, usize),
        mut ahead: Strips<S>,
        (from, to, begun): (&S, &S, usize),
        visit: &mut dyn FnMut(Passing<'_, '_, 'c, S>),
    ) {
        for (k, piece) in self.pieces[..until].iter().enumerate().skip(next) {
            ahead.fly(self.medium, self.flights, piece.flight);
            let now = piece.flight.and_then(|k| self.flights.get(k));
            if piece.leap > 0 {
                // The march covers at most two round trips of a leap.
                let skipped = (from.clone() - &piece.from).floor_int().unwrap_or(0).clamp(0, piece.leap);
                let end = ahead.state.round + piece.leap;
                let fraction = ahead.state.segments[0].at.clone();
                if k > begun {
                    ahead.ground = self.medium.ground_of(&ahead.state);
                }
                if skipped > 0 {
                    ahead.state = self.pool.leap((k, skipped), || {
                        let mut state = ahead.state.clone();
                        self.medium.leap(&mut state, &ahead.ground, skipped);
                        state
                    });
                }
                while ahead.state.time() <= *to && (ahead.state.round < end || ahead.state.segments[0].at != fraction) {
                    self.medium.strip(&mut ahead.state, false, &mut |cell| visit((cell, now)));
                }
            } else if k >= first {
                ahead.strip(self.medium, piece, &mut |cell| visit((cell, now)));
            } else {
                ahead.strip(self.medium, piece, &mut |_| {});
            }
        }
    }

    /// Computes [`Record::line`] along the whole rod.
    pub(super) fn whole_line(&self, t: &S) -> Nodes<S> {
        self.pool.line(t, || self.line(t, &t.ratio(1, 2)))
    }

    pub(super) fn line(&self, t: &S, reach: &S) -> Vec<Node<S>> {
        self.lines(t, std::slice::from_ref(reach)).pop().unwrap_or_default().0
    }

    /// Computes Gauss–Legendre nodes at time `t` from the ground to the first of `cuts`, and from each to the next,
    /// between all rays.
    ///
    /// **Accuracy**: that of the cells: between rays the squares of `z_t`, `z_x` grow at most like `e^{4κ|s|}`, for
    /// which the tables hold enough terms; the rule with n nodes is exact for 2n terms.
    pub(super) fn lines(&self, t: &S, cuts: &[S]) -> Vec<Line<S>> {
        let zero = t.zero();
        let mut lines = vec![Line::<S>::default(); cuts.len()];
        let Some(reach) = cuts.last() else { return lines };
        // Adds the nodes between two rays, part by part.
        let mut add = |from: &S, to: &S, values: &Values<'_, S>| {
            let first = cuts.partition_point(|cut| cut <= from);
            let ends = cuts[first..].iter().map(|cut| smaller(to.clone(), cut.clone()));
            let starts = std::iter::once(from).chain(&cuts[first..]);
            let parts = starts.zip(ends).map(|(from, end)| (from, end - from));
            let parts: Vec<_> = parts.take_while(|(_, len)| len.is_positive()).collect();
            let nodes = parts.iter().zip(first..).flat_map(|((from, len), line)| {
                let rule = self.medium.rule(len).iter();
                rule.map(move |(at, weight)| (line, len.clone() * at + *from, weight.clone() * len))
            });
            let nodes: Vec<_> = nodes.collect();
            let places: Vec<S> = nodes.iter().map(|(_, x, _)| x.clone()).collect();
            for ((line, x, weight), (rigid, motion, strain)) in nodes.into_iter().zip(values(&places)) {
                lines[line].0.push(Node { weight, x, rigid, motion, strain });
            }
            lines.iter_mut().skip(first).take(parts.len()).for_each(|(_, parts)| *parts += 1);
        };
        if let Some(contact) = self.at_rest(t) {
            let still = |x: &S| (zero.clone(), zero.clone(), self.rest_strain(x, contact));
            add(&zero, reach, &|places| places.iter().map(still).collect());
            return lines;
        }
        self.sweep(&(t.clone() - reach), t, &mut |(cell, flight)| {
            let (xi, eta) = &cell.corner;
            let low = (t.clone() - xi - &cell.size.0).larger(eta.clone() - t).larger(zero.clone());
            let high = smaller(smaller(t.clone() - xi, eta.clone() + &cell.size.1 - t), reach.clone());
            add(&low, &high, &|points| {
                let places: Vec<(S, S)> = points.iter().map(|x| (x.clone(), t.clone())).collect();
                self.inside((cell, flight), &places)
            });
        });
        lines
    }

    /// Returns whether the rod at rest is in contact, if it is at rest at time `t`.
    fn at_rest(&self, t: &S) -> Option<bool> {
        self.pieces.last().filter(|piece| piece.still && *t > piece.from).map(|piece| piece.contact)
    }

    /// Computes `v_s′(x)`.
    fn static_strain(&self, x: &S) -> S {
        self.data.gravity.clone() * x + &self.data.slope
    }

    fn rest_strain(&self, x: &S, contact: bool) -> S {
        let strain = self.static_strain(x);
        if contact { strain } else { strain - &self.data.slope }
    }

    /// Computes `h′` of the flight, the rest of `v_t`, and `v_x`, at places in a cell, a point and a time.
    fn inside(&self, (cell, flight): Passing<'_, '_, '_, S>, places: &[(S, S)]) -> Vec<(S, S, S)> {
        let Some((_, first)) = places.first() else { return Vec::new() };
        let points: Vec<(S, S)> = places.iter().map(|(x, t)| (t.clone() - x, t.clone() + x)).collect();
        let found = cell.at(&self.medium.basis, &points, self.medium.log2_accuracy);
        let rate = |t: &S| flight.map(|flight| flight.rate_at(&flight.age_at(t)));
        let half = first.ratio(1, 2);
        let mut known = (first, rate(first));
        let mut values = Vec::with_capacity(places.len());
        for ((p, q), (x, t)) in found.into_iter().zip(places) {
            if t != known.0 {
                known = (t, rate(t));
            }
            let (motion, strain) = ((p.clone() + &q) * &half, (q - p) * &half);
            values.push(match &known.1 {
                Some(rigid) => (rigid.clone(), motion, strain),
                None => (x.zero(), motion, strain + self.static_strain(x)),
            });
        }
        values
    }

    /// Computes the limits of `v_t` and `v_x` at a point from the given side in time.
    pub(super) fn at(&self, x: &S, t: &S, side: Side) -> (S, S) {
        if let Some(contact) = self.at_rest(t) {
            return (t.zero(), self.rest_strain(x, contact));
        }
        let (xi, eta) = (t.clone() - x, t.clone() + x);
        let slack = slack(t, 8);
        // The last cell that has begun, or the first cell if none has.
        let begun = |corner: &S, at: &S| match side {
            Side::Right => *corner <= at.clone() + &slack,
            Side::Left => *corner < at.clone() - &slack,
        };
        let mut best = None;
        // The left limit needs one more strip.
        let from = xi.clone() - &slack - &slack;
        self.sweep(&from, &(xi.clone() + &slack), &mut |(cell, flight)| {
            if best.is_none() || (begun(&cell.corner.0, &xi) && begun(&cell.corner.1, &eta)) {
                best = Some((cell.kept(), flight));
            }
        });
        let found = best.and_then(|(kept, flight)| self.inside((&kept, flight), &[(x.clone(), t.clone())]).pop());
        found.map_or_else(|| (x.zero(), x.zero()), |(rigid, motion, strain)| (rigid + motion, strain))
    }

    /// Computes the limits of `v_t` and `v_x` from later times at all places, a point and a time, in increasing order
    /// of times: the values of [`Record::at`], in one march for all of them.
    pub(super) fn at_all(&self, places: &[(S, S)]) -> Vec<(S, S)> {
        let (Some((reach, first)), Some((_, last))) = (places.first(), places.last()) else { return Vec::new() };
        let reach = places.iter().fold(reach.clone(), |reach, (x, _)| reach.larger(x.clone()));
        let slack = slack(last, 8);
        let mut values = vec![(slack.zero(), slack.zero()); places.len()];
        self.sweep(&(first.clone() - &reach - &slack), &(last.clone() + &slack), &mut |(cell, flight)| {
            let (xi, eta) = (cell.corner.0.clone() - &slack, cell.corner.1.clone() - &slack);
            let (xi_end, eta_end) = (xi.clone() + &cell.size.0 + &slack, eta.clone() + &cell.size.1 + &slack);
            let begun = places.partition_point(|(_, t)| t.int(2) * t < xi.clone() + &eta);
            let until = xi_end.clone() + &eta_end;
            let ended = places[begun..].partition_point(|(_, t)| t.int(2) * t <= until);
            let is_met = |k: &usize| {
                let (x, t) = &places[*k];
                let (from, to) = (t.clone() - x, t.clone() + x);
                from >= xi && from <= xi_end && to >= eta && to <= eta_end
            };
            let met: Vec<usize> = (begun..begun + ended).filter(is_met).collect();
            let inside: Vec<(S, S)> = met.iter().map(|k| places[*k].clone()).collect();
            for (k, (rigid, motion, strain)) in met.into_iter().zip(self.inside((cell, flight), &inside)) {
                values[k] = (rigid + motion, strain);
            }
        });
        for ((x, t), value) in places.iter().zip(&mut values) {
            if self.at_rest(t).is_some() {
                *value = self.at(x, t, Side::Right);
            }
        }
        values
    }

    /// Returns the flight at time `t`, if it is separated.
    pub(super) fn flight(&self, t: &S, side: Side) -> Option<&Flight<S>> {
        self.piece(t, side).and_then(|(piece, _)| piece.flight).and_then(|k| self.flights.get(k))
    }

    /// Returns the piece of the trace at time `t`, and the place in it: `0 … 1`.
    pub(super) fn piece(&self, t: &S, side: Side) -> Option<(&Piece<S>, S)> {
        let slack = slack(t, 8);
        let next = match side {
            Side::Right => self.pieces.partition_point(|piece| piece.from <= t.clone() + &slack),
            Side::Left => self.pieces.partition_point(|piece| piece.from < t.clone() - &slack),
        };
        let piece = self.pieces.get(next.saturating_sub(1))?;
        let at = (t.clone() - &piece.from) / &piece.len;
        Some((piece, smaller(at.larger(t.zero()), t.one())))
    }

    /// Computes `v(0,t)` and `v_t(0,t)`.
    pub(super) fn end(&self, t: &S, side: Side) -> (S, S) {
        match self.piece(t, side) {
            Some((piece, _)) if piece.leap > 0 => {
                // The mean of z vanishes, so v(0,t) is h less a weighted mean of z_x.
                let half = t.ratio(1, 2);
                let lack = self
                    .whole_line(t)
                    .iter()
                    .fold(t.zero(), |sum, node| (half.clone() - &node.x) * &node.strain * &node.weight + &sum);
                let centre = self.flight(t, side).map_or_else(|| t.zero(), |flight| flight.at(&flight.age_at(t)).0);
                (centre - lack * t.int(2), self.at(&t.zero(), t, side).0)
            }
            Some((piece, at)) if !piece.contact => (evaluate(&piece.height, &at), evaluate(&piece.trace, &at)),
            Some(_) => (t.zero(), t.zero()),
            None => (self.data.ground.clone(), t.zero()),
        }
    }

    pub(super) fn height(&self, t: &S) -> S {
        self.end(t, Side::Left).0
    }
}
