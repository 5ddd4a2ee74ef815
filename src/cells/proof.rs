//! A damped run with a proof: what a run in enclosing numbers shows of the true motion.
//!
//! The stored history is taken as exact data. Each step of it (start, strip, cut, joining, separation, leap, dropped
//! vibration) has been evaluated on exact inputs in numbers that carry their bound, and has counted what its series
//! leave out: so `defect` bounds `|q̂ − q|` that this one step has made. Neither `sup(|δp|, |δq|)` nor `∫ |δp| + |δq|`
//! grows (module `cell`; `|p| = |q|` at both ends), so errors are added, step by step, and nothing is propagated.
//! Dimensionless: times in `t₁`, lengths in `c t₁`, velocities in `V`; `δ = δ_E + δ_W`:
//!
//! - **E**, `even`: `sup |δ_E|`, the sum of all defects so far.
//! - **W**, `masses`: `∫ |δ_W|`. An event that is off by at most τ differs from the true one in what holds at the ground
//!   for no longer than 2τ, where p is −q here and q there: `4τ max|q|`.
//! - Away from rays that are off, `|δq| ≤ F = E + min(R(T + 1), e^R) W` and what the trace itself has been rounded by.
//! - In flight, T round trips after its release, `|δv(0,·)| ≤ H`. Taken apart, `|δh′| ≤ E + W` at equal times, and
//!   `z(0) = ∫ w (q − h′) dη` with `|w| ≤ ½e^R`: `H = (2s + 3) e^R (E + W)`, `s = (1 − e^{−2RT})/2R`, and the bounds of
//!   `h`, `h′` and `z(0)` as they are stored. Otherwise `∫ |δv_t(0)|`: of `δ_W` the ground receives at most `(1 + R) W`
//!   in a round trip, as `|q|` gains `κ∫|p|` on its way down: `H = (T + 2)(1 + R)(E + W)`.
//!
//! **Landing** at `t̂`, on a stretch `t̂ ± δ` on which `v̂_t ≤ −s`, `s > F`: `τ = (H + |v̂(0,t̂)|)/s` is less than δ, and
//! `v̂(0,·) > H` before the stretch, except at first while the end has only risen since its release (`v̂_t > F`; v is
//! never negative, so what rises does not touch). Then the true end touches the ground in `t̂ ± τ`, once, and not before.
//! **Release at a root** of the stress: as a landing, with F for H and the slope of the trace for s; the stress is below
//! −F before. The end lets go in `t̂ ± τ`, at least once, and flies from `t̂ + τ` on. **Release at a ray**, whose own τ it
//! has: the stress is below −F on its one side and above F on its other.
//! Where rays are off by up to τ, every strip in which signs of velocities or stresses are asked for is longer than 8τ,
//! so that rays keep their order; and slopes times 8τ are added to F, for what a side is where the true ray has not come.
//!
//! What is not shown by these signs ends the proof: at the beginning of the strip in question, with what is open there.

use super::history::Damped;
use super::piece::Piece;
use super::series::{at_one, at_zero, bound, derivative, evaluate, take_bounds};
use super::uncertainty::Uncertainty;
use crate::error::Error;
use crate::motion::Ending;
use crate::reason::{Near, Reason};
use crate::special::RoundedSpecial;

/// The first release, where the closed form of the first contact has proved it and that there is none before.
#[derive(Clone, Debug)]
pub(crate) enum FirstRelease<S> {
    /// At a ray, after so many round trips.
    Ray(i64),
    /// At a root of the stress, after so many.
    Root(S),
}

/// Parts of a strip that are looked at before a question is left open.
const MOST_PARTS: usize = 600;
/// Differences of doubles are told from zero at so much of their parts.
const SLACK: f64 = 1e-9;

/// What is open: of what kind, and by how much velocities may differ from then on.
struct Open {
    what: Near,
    differ: f64,
}

/// The account at one time.
struct Account<'a, S> {
    run: &'a Damped<S>,
    /// `R`.
    damping: f64,
    even: f64,
    masses: f64,
    /// The most that a ray so far is off.
    late: f64,
    /// The steepest trace so far.
    slope: f64,
    /// Where events have started rays, and how far those are off.
    rays: Vec<(S, f64)>,
    /// When the last event was.
    since: f64,
    /// Whether the end has only risen since its release, and is not clear of the ground.
    rising: bool,
    /// How far the release at a root is off that begins here.
    rooted: Option<f64>,
}

/// What has been shown.
struct Shown {
    /// How far each event may be off, that of the end last where it is one.
    late: Vec<f64>,
    /// Before the first event, and after each.
    known: Vec<(f64, f64, f64)>,
    open: Option<(usize, Open)>,
}

/// A series as it is stored, and the bound that it had.
fn stored<S: RoundedSpecial>(c: &[S]) -> (Vec<S>, f64) {
    let mut c = c.to_vec();
    let unit = c.first().map_or(0.0, S::unit);
    let off = take_bounds(&mut c) * unit;
    (c, off)
}

/// The least and the greatest that a series may be.
fn range<S: RoundedSpecial>(c: &[S]) -> (f64, f64) {
    let (middle, spread) = (c[0].to_f64(), bound(c, 1));
    let slack = SLACK * 1e-3 * (middle.abs() + spread) + c[0].most() - middle.abs();
    (middle - spread - slack, middle + spread + slack)
}

impl<S: RoundedSpecial> Account<'_, S> {
    fn part(&self, c: &[S], from: &S, to: &S) -> Vec<S> {
        if from.is_zero() && *to == to.one() {
            return c.to_vec();
        }
        self.run.medium.basis.restrict(c, from, to, c.len())
    }

    /// F at a time.
    fn trace_off(&self, time: f64) -> f64 {
        self.even + (self.damping * (time + 1.0)).min(self.damping.exp()) * self.masses
    }

    /// H, so long after the release.
    fn height_off(&self, piece: &Piece<S>, flown: f64) -> f64 {
        let both = (self.even + self.masses) * (1.0 + SLACK);
        let rate = 2.0 * self.damping;
        if piece.flight.is_some() {
            let fall = if rate * flown < 1e-8 { flown } else { -(-rate * flown).exp_m1() / rate };
            (2.0 * fall + 3.0) * self.damping.exp() * both
        } else {
            (flown + 2.0) * (1.0 + self.damping) * both
        }
    }

    /// Whether a series is below `−off` throughout.
    fn below(&self, c: &[S], off: f64) -> bool {
        let mut parts = vec![(c[0].zero(), c[0].one())];
        let mut count = 0;
        while let Some((from, to)) = parts.pop() {
            let (low, high) = range(&self.part(c, &from, &to));
            if high < -off {
                continue;
            }
            count += 1;
            if low > -off || count > MOST_PARTS {
                return false;
            }
            let middle = (from.clone() + &to) * &from.ratio(1, 2);
            parts.push((middle.clone(), to));
            parts.push((from, middle));
        }
        true
    }

    /// Whether the end surely does not touch the ground.
    fn clear(&mut self, height: &[S], trace: &[S], (high, fast): (f64, f64)) -> Result<(), Open> {
        let mut parts = vec![(height[0].zero(), height[0].one())];
        let mut count = 0;
        while let Some((from, to)) = parts.pop() {
            let (low, most) = range(&self.part(height, &from, &to));
            if low > high {
                self.rising = false;
                continue;
            }
            let (slow, steep) = range(&self.part(trace, &from, &to));
            if self.rising && slow > fast {
                continue;
            }
            count += 1;
            if most < -high || count > MOST_PARTS {
                return Err(Open { what: Near::Touch, differ: 2.0 * (slow.abs().max(steep.abs()) + fast) });
            }
            let middle = (from.clone() + &to) * &from.ratio(1, 2);
            parts.push((middle.clone(), to));
            parts.push((from, middle));
        }
        Ok(())
    }

    /// A stretch `x ± δ` on which `sign · g` is positive: δ, and the least and the greatest of it there.
    fn steep(&self, g: &[S], x: &S, sign: f64) -> Option<(S, f64, f64)> {
        for k in 1..200 {
            let delta = x.double((-f64::from(k)).exp2());
            let (from, to) = (x.clone() - &delta, x.clone() + &delta);
            if from.is_negative() || to > x.one() {
                continue;
            }
            let (low, high) = range(&self.part(g, &from, &to));
            let (least, most) = if sign > 0.0 { (low, high) } else { (-high, -low) };
            if least > 0.0 {
                return Some((delta, least, most));
            }
        }
        None
    }

    /// An event that is off by τ, where `|q| ≤ most`.
    fn happens(&mut self, at: Option<&S>, time: f64, late: f64, most: f64) {
        self.masses += 4.0 * late * (most + self.trace_off(time)) * (1.0 + SLACK);
        self.late = self.late.max(late);
        self.rays.extend(at.map(|at| (at.clone(), late)));
        self.since = time;
    }

    /// How far the ray may be off that comes down here.
    fn ray_at(&self, at: &S) -> f64 {
        let known = self.rays.iter().filter(|(ray, _)| ray == at).map(|(_, late)| *late);
        known.fold(64.0 * at.unit(), f64::max)
    }

    /// A strip in contact, which ends with a release if `next` is the strip after it.
    fn contact(
        &mut self,
        piece: &Piece<S>,
        next: Option<&Piece<S>>,
        first: Option<&FirstRelease<S>>,
    ) -> Result<Option<f64>, Open> {
        let (time, len) = (piece.to().to_f64(), piece.len.to_f64());
        let (whole_len, series) = match &piece.enclosed.whole {
            Some((len, trace, _)) if next.is_some() => (len, trace),
            _ => (&piece.len, &piece.trace),
        };
        let (trace, off) = stored(series);
        let fast = self.trace_off(time) + off + 8.0 * self.slope * self.late;
        let zero = piece.len.zero();
        let open = |c: &[S]| Open { what: Near::Release, differ: 2.0 * (bound(c, 0) + fast) };
        let ends = |c: &[S]| {
            let last = at_one(c, &zero);
            Open { what: Near::Release, differ: 4.0 * (last.most() + fast) }
        };
        let Some(next) = next else {
            let shown = first.is_some() || len > 8.0 * self.late && self.below(&trace, fast);
            return if shown { Ok(None) } else { Err(open(&trace)) };
        };
        if piece.enclosed.whole.is_none() {
            // At a ray.
            let at = next.enclosed.at.as_ref().ok_or_else(|| ends(&trace))?;
            let (after, after_off) = stored(&next.trace);
            let (left, right) = (at_one(&trace, &zero), at_zero(&after, &zero));
            let late = match first {
                Some(FirstRelease::Ray(trips)) if piece.to() == zero.int(*trips) => 0.0,
                Some(_) => return Err(ends(&trace)),
                None => self.ray_at(at),
            };
            let fast = fast + after_off;
            let shown = first.is_some() || self.below(&trace, fast) && len > 8.0 * self.late;
            let (left_range, right_range) = (range(std::slice::from_ref(&left)), range(std::slice::from_ref(&right)));
            if !(shown && left_range.1 < -fast && right_range.0 > fast) {
                return Err(ends(&trace));
            }
            self.happens(Some(at), time, late, left.most().max(right.most()));
            return Ok(Some(late));
        }
        let x = piece.len.clone() / whole_len;
        let scale = whole_len.to_f64();
        let rate = derivative(&trace);
        let (delta, least, most) = self.steep(&rate, &x, 1.0).ok_or_else(|| open(&trace))?;
        let rest = evaluate(&trace, &x).most();
        let (least, most) = (least / scale * (1.0 - SLACK), most / scale * (1.0 + SLACK));
        let late = match first {
            Some(FirstRelease::Root(time)) => (time.clone() - piece.to()).most(),
            Some(FirstRelease::Ray(_)) => return Err(ends(&trace)),
            None => (fast + rest) / least,
        };
        // The flight shows from when on it flies; its trace is rounded more.
        let late = 1024.0 * late.max((fast + rest) / least);
        if delta.to_f64() * scale < 4.0 * (late + self.late) {
            return Err(open(&trace));
        }
        let before = x.clone() - &delta;
        if first.is_none() && before.is_positive() && !self.below(&self.part(&trace, &zero, &before), fast) {
            return Err(open(&trace));
        }
        self.happens(next.enclosed.at.as_ref(), time, late, rest + 2.0 * most * late);
        self.rooted = Some(late);
        Ok(Some(late))
    }

    /// A strip in flight, or a leap, which ends with a landing if it `lands`.
    fn flight(&mut self, piece: &Piece<S>, next: Option<&Piece<S>>, lands: bool) -> Result<Option<f64>, Open> {
        let (time, len) = (piece.to().to_f64(), piece.len.to_f64());
        let flown = time - self.since + self.late;
        let touch = |differ| Open { what: Near::Touch, differ };
        if piece.leap > 0 {
            if piece.enclosed.clear <= self.height_off(piece, flown) {
                return Err(touch(self.slope));
            }
            self.rising = false;
            return Ok(None);
        }
        let (whole_len, trace, height) = match &piece.enclosed.whole {
            Some((len, trace, height)) if lands => (len, trace, height),
            _ => (&piece.len, &piece.trace, &piece.height),
        };
        let ((trace, off), (height, height_off)) = (stored(trace), stored(height));
        let fast = self.trace_off(time) + off + 8.0 * self.slope * self.late;
        let high = self.height_off(piece, flown) + height_off;
        let (zero, scale) = (piece.len.zero(), whole_len.to_f64());
        if (self.rising || lands) && len <= 8.0 * self.late {
            return Err(touch(4.0 * bound(&trace, 0)));
        }
        let mut from = zero.clone();
        if let Some(late) = self.rooted.take() {
            // From zero on it rises, fast enough at τ already.
            let rate = derivative(&trace);
            let rises = (0..200).find_map(|k| {
                let to = zero.double((-f64::from(k)).exp2());
                let (least, _) = range(&self.part(&rate, &zero, &to));
                (least > 0.0).then_some((to, least))
            });
            let (to, least) = rises.ok_or(Open { what: Near::Release, differ: 2.0 * bound(&trace, 0) })?;
            let shown = (fast + at_zero(&trace, &zero).most()) / (least / scale * (1.0 - SLACK));
            if !(shown <= late && to.to_f64() * scale >= 2.0 * late) {
                return Err(Open { what: Near::Release, differ: 2.0 * bound(&trace, 0) });
            }
            from = to;
        }
        if !lands {
            if from < zero.one() {
                let parts = (self.part(&height, &from, &zero.one()), self.part(&trace, &from, &zero.one()));
                self.clear(&parts.0, &parts.1, (high, fast))?;
            }
            return Ok(None);
        }
        if piece.enclosed.whole.is_none() {
            return Err(touch(4.0 * (at_one(&trace, &zero).most() + fast)));
        }
        let x = piece.len.clone() / whole_len;
        let (delta, least, most) = self.steep(&trace, &x, -1.0).ok_or_else(|| touch(2.0 * fast))?;
        let late = (high + evaluate(&height, &x).most()) / (least * (1.0 - SLACK)) * (1.0 + SLACK);
        if least <= fast || delta.to_f64() * scale < 4.0 * (late + self.late) {
            return Err(touch(2.0 * (most + fast)));
        }
        let before = x - &delta;
        if before > from {
            let parts = (self.part(&height, &from, &before), self.part(&trace, &from, &before));
            self.clear(&parts.0, &parts.1, (high, fast))?;
        }
        self.happens(next.and_then(|next| next.enclosed.at.as_ref()), time, late, most);
        Ok(Some(late))
    }

    /// Goes over all strips, until something is open.
    fn follow(mut self, first: Option<&FirstRelease<S>>) -> Shown {
        let pieces = &self.run.pieces;
        let (mut late, mut known) = (Vec::new(), vec![(0.0, 0.0, 0.0)]);
        if pieces.first().is_some_and(|piece| piece.contact) {
            late.push(0.0);
            known.push((0.0, 0.0, 0.0));
        }
        let mut first = first;
        for (k, piece) in pieces.iter().enumerate() {
            self.even += piece.enclosed.defect * (1.0 + SLACK);
            if !piece.trace.is_empty() {
                let rate = derivative(&piece.trace);
                self.slope = self.slope.max(bound(&rate, 0) / piece.len.to_f64() * (1.0 + SLACK));
            }
            let next = pieces.get(k + 1).filter(|next| next.contact != piece.contact);
            let lands = next.is_some() || k + 1 == pieces.len() && self.run.course.ending == Ending::NextImpact;
            let flown = piece.to().to_f64() - self.since + self.late;
            let found = if piece.still {
                Err(Open { what: Near::End, differ: 0.0 })
            } else if piece.contact {
                self.contact(piece, next, first)
            } else {
                self.flight(piece, next, lands)
            };
            match found {
                Ok(event) => {
                    let time = piece.to().to_f64();
                    let rigid = if piece.contact { 0.0 } else { self.height_off(piece, flown) };
                    let sum = (self.even + self.masses) * (1.0 + self.damping) * (flown + 3.0);
                    let last = known.len() - 1;
                    let now = &mut known[last];
                    let far = if piece.contact { sum } else { self.even + self.masses };
                    *now = (rigid.max(0.0) + far, self.trace_off(time), self.even + self.masses);
                    if let Some(off) = event {
                        first = None;
                        late.push(off);
                        known.push(*known.last().unwrap_or(&(0.0, 0.0, 0.0)));
                        self.rising = piece.contact;
                    }
                }
                Err(open) => return Shown { late, known, open: Some((k, open)) },
            }
        }
        Shown { late, known, open: None }
    }
}

impl<S: RoundedSpecial> Damped<S> {
    /// Whether the reason of the ending holds with so much to spare: what it compares are energies and bounds in
    /// doubles.
    fn ends_so(&self, off: f64) -> bool {
        match &self.course.ending {
            Ending::Time | Ending::NextImpact | Ending::Undecided(_) => true,
            Ending::NoFurtherImpact(Reason::StaysAbove { swing, height, .. }) => {
                let unit = self.scales.velocity * self.scales.time;
                height - swing > 1e-6 * (height + swing) + 16.0 * off * unit
            }
            Ending::Rest(Reason::StaysPressed { part, .. }) | Ending::NoBounce(Reason::StaysPressed { part, .. }) => {
                (1.0 - part) * self.medium.slope.to_f64().abs() > 1e-6 + 4.0 * off
            }
            _ => false,
        }
    }

    /// The run with the bounds that are proved of it, as far as they are; where they end before it does, what is open.
    /// `first` is the first release where its closed form has proved it.
    ///
    /// **Errors**: [`Error::NotDecided`] where not even the first strip is shown.
    pub(crate) fn proved(mut self, first: &FirstRelease<S>) -> Result<(Self, bool), Error> {
        let unit = self.data.units.time.unit();
        let segments = self.checkpoints.first().map_or(1, |kept| kept.state.segments.len());
        let (slope, most) = self.checkpoints.first().map_or((0.0, 0.0), |kept| {
            let (slope, ..) = self.medium.variation(&kept.state);
            (slope, kept.state.bound())
        });
        // Places of the start are moved by less than this to where their sums are exact.
        let moved = 64.0
            * unit
            * segments as f64
            * (slope + 4.0 * most + self.medium.slope.most() + self.medium.gravity.most());
        let rising = !self.data.ground.is_positive();
        let account = Account {
            run: &self,
            damping: 2.0 * self.medium.kappa.most(),
            even: moved,
            masses: moved,
            late: 0.0,
            slope: 0.0,
            rays: Vec::new(),
            since: 0.0,
            rising,
            rooted: None,
        };
        let Shown { late, known, mut open } = account.follow(Some(first));
        if open.is_none() && !self.ends_so(known.last().map_or(0.0, |(rise, speed, _)| rise + speed)) {
            open = Some((self.pieces.len(), Open { what: Near::End, differ: 0.0 }));
        }
        let (time, velocity) = (self.scales.time, self.scales.velocity);
        let whole = open.is_none();
        if let Some((piece, Open { what, differ })) = open {
            let bits = self.data.units.time.bits();
            if piece == 0 {
                return Err(Error::not_decided("how the motion begins", bits));
            }
            let from = self.pieces[piece - 1].to() * &self.data.units.time;
            self.pieces.truncate(piece);
            self.checkpoints.retain(|kept| kept.index <= piece);
            self.course.ending = Ending::Unproved { what, differ: differ * velocity };
            self.course.end = super::uncertainty::within(&from, 0.0);
        }
        let mut late = late.into_iter();
        let mut events = std::mem::take(&mut self.course.events);
        let mut count = 0;
        for event in &mut events {
            let Some(off) = late.next() else { break };
            event.time_error = off * time * (1.0 + SLACK);
            count += 1;
        }
        events.truncate(count);
        let end_late = late.next();
        if let Some(off) = end_late {
            self.course.end = super::uncertainty::within(self.course.end.value(), off * time);
        }
        self.course.events = events;
        self.course.warnings.clear();
        self.at_events = vec![None; count];
        let most_late = self.course.events.iter().fold(0.0, |most: f64, event| most.max(event.time_error / time));
        let proved = |(k, (rise, speed, rate)): (usize, (f64, f64, f64))| {
            let found = self.uncertain.get(k).copied().unwrap_or_default();
            Uncertainty { rise, speed, rate, late: 0.0, rays: most_late, ..found }
        };
        self.uncertain = known.into_iter().enumerate().map(proved).collect();
        Ok((self.with_bounds()?, whole))
    }
}
