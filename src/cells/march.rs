//! Marching: from the data on one upward characteristic to those on the next.
//!
//! Dimensionless: time in `t₁`, `x/c` in `t₁` (so that the rod is `0 … ½`), velocities in `V`. The state is `q` on the
//! characteristic `ξ = b` that leaves the ground at time `b`, for `b ≤ η ≤ b + 1`, in segments between the downward
//! rays. A strip carries the first segment to the ground, sends `p` up through the others, reflects it at the top and
//! appends the result as the last segment, one round trip later.
//!
//! A segment stores its place as a fraction of a round trip, which its ray keeps for ever. The place is copied, not
//! computed again, so that rays return at exactly the same fraction and lengths never drift.

use std::collections::VecDeque;
use std::sync::OnceLock;

use super::cell::{Cell, cross, diagonal};
use super::series::{Basis, add_scaled, at_one, at_zero, bound, derivative, evaluate, scale, terms_for};
use super::uncertainty::Off;
use crate::number::Rounded;
use crate::special::gauss_legendre;

/// The strongest damping `R` for leaps: `R²‖D⁻²‖ ≤ 0.13`.
pub(super) const MOST_SEPARATED_DAMPING: f64 = 2.0;

/// Constants of a run.
#[derive(Clone, Debug)]
pub(super) struct Medium<S> {
    pub(super) basis: Basis<S>,
    /// `κ = r t₁/2`.
    pub(super) kappa: S,
    /// `g t₁/V`.
    pub(super) gravity: S,
    /// Slope of the static state at the ground, in `V`: contact has `z_x = v_x − slope`.
    pub(super) slope: S,
    /// Slope of `−z` at the ground in flight, `z_x = −offset`: zero where z is the vibration about the centre of mass.
    pub(super) offset: S,
    pub(super) free_top: bool,
    /// Truncation of one cell relative to `V`, as `log₂`.
    pub(super) log2_accuracy: f64,
    pub(super) longest: S,
    rules: [OnceLock<Vec<(S, S)>>; RULES],
}

/// Number of quadrature rules; each serves half the length of the one before.
const RULES: usize = 8;

/// Bounds `a`, `b` of the sides for [`terms_for`]: velocities of a few dozen `V`, slopes `(1 + r t₁)` times that. They
/// enter as logarithms; the error estimate uses the values of the run.
const SIDE_BOUND: f64 = 32.0;

/// `q` on a part of an upward characteristic: `e^{κ(η−η₀)} q` in Chebyshev coefficients.
#[derive(Clone, Debug)]
pub(super) struct Segment<S> {
    /// Place where its lower end meets the ground, as a fraction of a round trip in `0 … 1`.
    pub(super) at: S,
    /// Length in `η`.
    pub(super) len: S,
    /// `e^{−κ len}`.
    pub(super) decay: S,
    pub(super) q: Vec<S>,
    /// Time error of the ray at its lower end.
    pub(super) off: Off,
}

/// `q` on a whole upward characteristic.
#[derive(Clone, Debug)]
pub(super) struct State<S> {
    /// Number of whole round trips so far.
    pub(super) round: i64,
    /// Segments from the ground up; never empty.
    pub(super) segments: VecDeque<Segment<S>>,
}

impl<S: Rounded> Medium<S> {
    /// Builds the medium for `R = r t₁`, with segments `shorten` times shorter than necessary.
    pub(super) fn new(damping: &S, (gravity, slope): (S, S), free_top: bool, log2_accuracy: f64, shorten: i64) -> Self {
        let r = damping.to_f64();
        let offset = if free_top && r <= MOST_SEPARATED_DAMPING { slope.zero() } else { slope.clone() };
        // κ·len ≤ 1 on each segment: every series stays short, and the factor e^{κs} costs no noticeable digits.
        let longest = if r > 2.0 { damping.int(2) / damping } else { damping.one() } / damping.int(shorten);
        let depth = 0.5 * r.min(2.0);
        // y = (κ len)² is largest for two longest segments.
        let powers = super::cell::terms(depth * depth, log2_accuracy) + 1;
        // The trace times e^{−r τ}, and squares on a line of constant time, grow at most like e^{4κ|s|}.
        let size = terms_for(SIDE_BOUND, SIDE_BOUND * (1.0 + r) * longest.to_f64(), 4.0 * depth, log2_accuracy);
        let basis = Basis::new(damping, size, powers);
        let kappa = damping.clone() * damping.ratio(1, 2);
        Medium { basis, kappa, gravity, slope, offset, free_top, log2_accuracy, longest, rules: Default::default() }
    }

    /// Returns Gauss–Legendre nodes and weights on `0 … 1` for products of a parabola with functions that grow like
    /// `e^{4κ|s|}`, on a part of length `len` of a line of constant time.
    pub(super) fn rule(&self, len: &S) -> &[(S, S)] {
        let (mut k, mut longest) = (0, self.longest.clone());
        while k + 1 < RULES && len.int(2) * len <= longest {
            (k, longest) = (k + 1, longest.clone() / longest.int(2));
        }
        let (one, half) = (len.one(), len.ratio(1, 2));
        let on_unit = |(x, weight): (S, S)| ((x + &one) * &half, weight * &half);
        let rule = || gauss_legendre(&self.kappa, self.terms(&longest, 4.0) / 2 + 2);
        self.rules[k].get_or_init(|| rule().into_iter().map(on_unit).collect())
    }

    /// Returns the resolution relative to the greatest `|q|`: the truncation of a cell, or a rounding.
    pub(super) fn least(&self) -> f64 {
        self.log2_accuracy.max(self.kappa.log2_roundoff()).exp2()
    }

    /// Estimates the error of a cell: the truncation of the series of its sides and of its sum, and four roundings of
    /// every coefficient (the sum, the correction, the decay and its factor). Both are relative to the present motion.
    pub(super) fn cell_error(&self, state: &State<S>) -> f64 {
        let unit = self.log2_accuracy.exp2() + self.kappa.log2_roundoff().exp2();
        4.0 * unit * (state.bound() + self.slope.to_f64().abs())
    }

    /// Returns the number of terms for a function that grows like `e^{multiple·κ|s|}` on a segment.
    pub(super) fn terms(&self, len: &S, multiple: f64) -> usize {
        let (kappa, len) = (self.kappa.to_f64(), len.to_f64());
        let b = SIDE_BOUND * (1.0 + 2.0 * kappa) * len;
        terms_for(SIDE_BOUND, b, multiple * kappa * len, self.log2_accuracy).min(self.basis.size())
    }

    /// Builds a segment through values of `q` at the nodes.
    pub(super) fn segment(&self, at: S, len: S, values: &[S]) -> Segment<S> {
        let terms = self.terms(&len, 1.0);
        let depth = self.kappa.clone() * &len;
        let scaled = self.basis.nodes().iter().zip(values).map(|(x, q)| (depth.clone() * x).exp() * q);
        let q = self.basis.through(&scaled.collect::<Vec<_>>(), terms);
        Segment { decay: (-depth).exp(), at, len, q, off: Off::default() }
    }

    /// Cuts a segment at `0 < cut < len`; the new ray starts with the time error `off`.
    fn cut(&self, segment: &Segment<S>, cut: &S, off: Off) -> (Segment<S>, Segment<S>) {
        let (zero, one) = (cut.zero(), cut.one());
        let fraction = cut.clone() / &segment.len;
        let rest = segment.len.clone() - cut;
        let low = self.basis.restrict(&segment.q, &zero, &fraction, self.terms(cut, 1.0));
        let mut high = self.basis.restrict(&segment.q, &fraction, &one, self.terms(&rest, 1.0));
        let decay = (-(self.kappa.clone() * cut)).exp();
        scale(&mut high, &decay);
        let at = on_circle(segment.at.clone() + cut);
        let high_decay = (-(self.kappa.clone() * &rest)).exp();
        (
            Segment { at: segment.at.clone(), len: cut.clone(), decay, q: low, off: segment.off },
            Segment { at, len: rest, decay: high_decay, q: high, off },
        )
    }

    /// Returns the series of `q + offset`.
    pub(super) fn raised(&self, segment: &Segment<S>, offset: &S) -> Vec<S> {
        let mut q = segment.q.clone();
        self.raise(&mut q, &(self.kappa.clone() * &segment.len), offset);
        q
    }

    fn raise(&self, q: &mut [S], depth: &S, offset: &S) {
        if !offset.is_zero() {
            add_scaled(q, &self.basis.exponential(depth, q.len()), offset);
        }
    }

    /// Returns the data reflected at the ground: `q` in contact, `q + offset` in flight.
    fn mirrored(&self, segment: &Segment<S>, contact: bool) -> Vec<S> {
        if contact { segment.q.clone() } else { self.raised(segment, &self.offset) }
    }

    /// Computes `v_t + c v_x` at the ground over the first segment: the velocity in flight, `c v_x` in contact.
    ///
    /// **Source**: [`diagonal`]; in contact `q` of `z` plus the static slope.
    pub(super) fn trace(&self, state: &State<S>, contact: bool) -> Vec<S> {
        let segment = &state.segments[0];
        let depth = self.kappa.clone() * &segment.len;
        let keep = self.terms(&segment.len, 2.0);
        let q = self.mirrored(segment, contact);
        let grown = diagonal(&self.basis, &q, &depth, !contact, (keep, self.log2_accuracy));
        let mut trace = if depth.is_zero() {
            grown
        } else {
            let terms = self.terms(&segment.len, 4.0);
            let decay = self.basis.exponential(&(depth * segment.len.int(-2)), self.basis.size());
            self.basis.product(&grown, &decay, terms)
        };
        if contact {
            trace[0] = trace[0].clone() + &self.slope;
        }
        trace
    }

    /// Marches over the first segment; `visit` receives every cell before it is crossed.
    pub(super) fn strip(&self, state: &mut State<S>, contact: bool, visit: &mut dyn FnMut(&Cell<'_, S>)) {
        let Some(first) = state.segments.pop_front() else { return };
        let zero = first.len.zero();
        let begin = first.at.int(state.round) + &first.at;
        let depth = self.kappa.clone() * &first.len;
        let cell = |eta: &S, len: &S| {
            let size = (first.len.clone(), len.clone());
            ((begin.clone(), eta.clone()), size, (depth.clone(), self.kappa.clone() * len))
        };
        let mut eta = begin.clone();
        // The ground: the cell and its mirror image.
        let q = self.mirrored(&first, contact);
        let mut p = if contact { q.iter().map(|term| -term.clone()).collect() } else { q.clone() };
        let offset = if contact { zero.clone() } else { self.offset.clone() };
        let (corner, size, depths) = cell(&eta, &first.len);
        visit(&Cell { corner, size, depth: depths, p: (&p).into(), q: (&q).into(), offset: offset.clone() });
        let mut out = q;
        self.cross((&mut p, &mut out), (&depth, &depth), (&first.decay, &first.decay));
        self.raise(&mut p, &depth, &offset);
        eta = eta + &first.len;
        for segment in &mut state.segments {
            let (corner, size, depths) = cell(&eta, &segment.len);
            let h = depths.1.clone();
            visit(&Cell { corner, size, depth: depths, p: (&p).into(), q: (&segment.q).into(), offset: zero.clone() });
            self.cross((&mut p, &mut segment.q), (&depth, &h), (&first.decay, &segment.decay));
            eta = eta + &segment.len;
        }
        // The top: likewise a cell and its mirror image.
        let mut q = if self.free_top { p.clone() } else { p.iter().map(|term| -term.clone()).collect() };
        let (corner, size, depths) = cell(&eta, &first.len);
        visit(&Cell { corner, size, depth: depths, p: (&p).into(), q: (&q).into(), offset: zero });
        self.cross((&mut p, &mut q), (&depth, &depth), (&first.decay, &first.decay));
        let wraps = state.segments.front().is_none_or(|next| next.at <= first.at);
        state.round += i64::from(wraps);
        state.segments.push_back(Segment { q, ..first });
        if let Some(last) = state.segments.len().checked_sub(2) {
            self.join(state, last);
        }
    }

    /// Marches over a first segment that starts from given `p` and `q` instead of the ground, with its lower corner at
    /// `corner`, up to the end of the state; the segment becomes the first one.
    pub(super) fn rise(
        &self,
        state: &mut State<S>,
        (p, q): (Segment<S>, Segment<S>),
        corner: (S, S),
        visit: &mut dyn FnMut(&Cell<'_, S>),
    ) {
        let depth = self.kappa.clone() * &p.len;
        let (mut up, offset) = (p.q.clone(), depth.zero());
        let mut eta = corner.1.clone();
        state.segments.push_front(q);
        for segment in &mut state.segments {
            let h = self.kappa.clone() * &segment.len;
            visit(&Cell {
                corner: (corner.0.clone(), eta.clone()),
                size: (p.len.clone(), segment.len.clone()),
                depth: (depth.clone(), h.clone()),
                p: (&up).into(),
                q: (&segment.q).into(),
                offset: offset.clone(),
            });
            self.cross((&mut up, &mut segment.q), (&depth, &h), (&p.decay, &segment.decay));
            eta = eta + &segment.len;
        }
    }

    /// Calls [`cross`] with the tables of this medium.
    fn cross(&self, sides: (&mut Vec<S>, &mut Vec<S>), depth: (&S, &S), decay: (&S, &S)) {
        cross(&self.basis, sides, depth, decay, self.log2_accuracy);
    }

    /// Joins all segments that can be joined, and returns the number of rays removed.
    pub(super) fn join_all(&self, state: &mut State<S>) -> usize {
        let count = state.segments.len();
        for k in (0..count.saturating_sub(1)).rev() {
            self.join(state, k);
        }
        count - state.segments.len()
    }

    /// Replaces the vibration by zero.
    pub(super) fn still(&self, state: &mut State<S>) {
        let first = state.segments[0].clone();
        let depth = self.kappa.clone();
        let q = vec![depth.zero(); self.terms(&depth.one(), 1.0)];
        let whole = Segment { len: depth.one(), decay: (-depth).exp(), q, ..first };
        state.segments = VecDeque::from([whole]);
    }

    /// Bounds the slope of `q` between rays, its range, and its total variation around the circle.
    pub(super) fn variation(&self, state: &State<S>) -> (f64, f64, f64) {
        let (mut slope, mut low, mut high) = (0.0f64, f64::INFINITY, f64::NEG_INFINITY);
        let (mut variation, mut ends) = (0.0, Vec::new());
        for segment in &state.segments {
            let (len, zero) = (segment.len.to_f64(), segment.len.zero());
            let rate = bound(&derivative(&segment.q), 0) / len + self.kappa.to_f64() * bound(&segment.q, 0);
            slope = slope.max(rate);
            variation += rate * len;
            ends.push((at_zero(&segment.q, &zero).to_f64(), (at_one(&segment.q, &zero) * &segment.decay).to_f64()));
            // The factor e^{−κs} applied to the range about c₀.
            let (mean, spread, decay) = (segment.q[0].to_f64(), bound(&segment.q, 1), segment.decay.to_f64());
            low = low.min(mean - spread).min((mean - spread) * decay);
            high = high.max(mean + spread).max((mean + spread) * decay);
        }
        let jumps = ends.iter().zip(ends.iter().cycle().skip(1)).map(|((_, end), (start, _))| (start - end).abs());
        (slope, high - low, variation + jumps.sum::<f64>())
    }

    /// Computes `Σ |jump of q| · time error` of the displaced rays.
    pub(super) fn passing(&self, state: &State<S>) -> f64 {
        let mut sum = 0.0;
        let mut last: Option<S> = None;
        for segment in &state.segments {
            let zero = segment.len.zero();
            let start = at_zero(&segment.q, &zero);
            // The first ray leaves the ground here; its jump is at most twice its own velocity.
            let jump = last.map_or_else(|| 2.0 * start.to_f64().abs(), |last| (start.clone() - last).to_f64().abs());
            sum += jump * segment.off.fixed;
            last = Some(at_one(&segment.q, &zero) * &segment.decay);
        }
        sum
    }

    /// Joins the segments k and k + 1 once they continue each other within the truncation of a cell.
    ///
    /// A jump at age `T` is `e^{−rT}` of its first value, and so are the jumps of derivatives (times powers of `r²T`),
    /// so every ray disappears in the end, except those that keep segments short. The joined series is compared with
    /// the two old ones, term by term: the sum of the differences bounds the change by the joining, and by the sup norm
    /// property the change is never amplified.
    fn join(&self, state: &mut State<S>, k: usize) {
        let (a, b) = (&state.segments[k], &state.segments[k + 1]);
        let len = a.len.clone() + &b.len;
        let size = bound(&a.q, 0) + bound(&b.q, 0) + self.gravity.to_f64() + self.slope.to_f64().abs();
        let accuracy = self.least() * size;
        let zero = len.zero();
        let jump = at_one(&a.q, &zero) * &a.decay - at_zero(&b.q, &zero);
        if len > self.longest || jump.to_f64().abs() > accuracy {
            return;
        }
        let cut = a.len.clone() / &len;
        let growth = len.one() / &a.decay;
        let value = |x: &S| {
            let s = x.clone() * &len;
            if s < a.len { evaluate(&a.q, &(s / &a.len)) } else { evaluate(&b.q, &((s - &a.len) / &b.len)) * &growth }
        };
        let values: Vec<S> = self.basis.nodes().iter().map(value).collect();
        let q = self.basis.through(&values, self.terms(&len, 1.0));
        let low = self.basis.restrict(&q, &zero, &cut, self.basis.size());
        let high = self.basis.restrict(&q, &cut, &len.one(), self.basis.size());
        let differs = |old: &[S], new: &[S], factor: &S| -> f64 {
            let old = old.iter().chain(std::iter::repeat(&zero));
            let difference = old.zip(new).map(|(x, y)| y.clone() * factor - x).collect::<Vec<_>>();
            bound(&difference, 0)
        };
        if differs(&a.q, &low, &len.one()) + differs(&b.q, &high, &a.decay) > accuracy {
            return;
        }
        let decay = (-(self.kappa.clone() * &len)).exp();
        state.segments[k] = Segment { at: a.at.clone(), len, decay, q, off: a.off };
        state.segments.remove(k + 1);
    }

    /// Cuts the first segment, so that the next strip ends at the cut.
    pub(super) fn cut_first(&self, state: &mut State<S>, cut: &S, off: Off) {
        if let Some(first) = state.segments.pop_front() {
            let (low, high) = self.cut(&first, cut, off);
            state.segments.push_front(high);
            state.segments.push_front(low);
        }
    }
}

impl<S: Rounded> State<S> {
    /// Returns `b`: the time at which this characteristic leaves the ground.
    pub(super) fn time(&self) -> S {
        let at = &self.segments[0].at;
        at.int(self.round) + at
    }

    /// Bounds `|q|` of `z` on the characteristic, hence `|q|` at the ground in contact at every later time.
    pub(super) fn bound(&self) -> f64 {
        self.segments.iter().map(|segment| bound(&segment.q, 0)).fold(0.0, f64::max)
    }
}

/// Reduces a place in `0 … 2` to the circle of a round trip.
pub(super) fn on_circle<S: Rounded>(place: S) -> S {
    let one = place.one();
    if place >= one { place - one } else { place }
}
