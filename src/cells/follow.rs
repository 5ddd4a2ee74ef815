//! Following the ground end through contacts and flights.
//!
//! With `y = v_t + c v_x` at the ground: in contact `y = c v_x`, and the rod leaves when `y` turns positive; in flight
//! `y = v_t`, and it lands when `v(0,·) = ∫ y` returns to zero. A landing at which `y` is not negative, and at `y = 0` not
//! falling, is none: the flight goes on.

use super::bounce::Held;
use super::march::{Medium, State};
use super::root::first_descent;
use super::series::{at_one, at_zero, bound, derivative, evaluate};
use super::start::Data;
use crate::error::Error;
use crate::history::{Ending, EventKind};
use crate::special::RoundedSpecial;

/// What happened at the ground during one strip, dimensionless.
#[derive(Clone, Debug)]
pub(super) struct Piece<S> {
    /// Its beginning.
    pub(super) from: S,
    /// Its length.
    pub(super) len: S,
    /// Whether the ground end is in contact.
    pub(super) contact: bool,
    /// Whether the first segment was cut for this strip.
    pub(super) cut: bool,
    /// Whether the rod is at rest: nothing was marched.
    pub(super) still: bool,
    /// `v_t + c v_x` in Chebyshev coefficients.
    pub(super) trace: Vec<S>,
    /// `v(0,·)`; empty in contact.
    pub(super) height: Vec<S>,
}

impl<S: RoundedSpecial> Piece<S> {
    /// Its end.
    pub(super) fn to(&self) -> S {
        self.from.clone() + &self.len
    }
}

/// An event, dimensionless.
#[derive(Clone, Debug)]
pub(super) struct Mark<S> {
    /// Landing or leaving.
    pub(super) kind: EventKind,
    /// Its time.
    pub(super) time: S,
    /// `v_t(0,·)`, just before or just after.
    pub(super) velocity: S,
    /// How far the time may be off.
    pub(super) time_error: f64,
}

/// How far to go.
#[derive(Clone, Debug)]
pub(super) enum Goal<S> {
    /// This many contacts with the flights after them.
    Impacts(u32),
    /// Up to this time, dimensionless.
    Time(S),
}

/// The rod at the ground, on its way.
#[derive(Debug)]
pub(super) struct Follower<'a, S> {
    pub(super) medium: &'a Medium<S>,
    pub(super) data: &'a Data<S>,
    pub(super) held: Option<&'a Held<S>>,
    pub(super) state: State<S>,
    pub(super) contact: bool,
    /// Contacts so far.
    landed: u32,
    /// `v(0,b)`.
    pub(super) height: S,
    pub(super) pieces: Vec<Piece<S>>,
    pub(super) marks: Vec<Mark<S>>,
    /// States at the beginning of each round trip, with the number of pieces before them.
    pub(super) checkpoints: Vec<(usize, State<S>)>,
    pub(super) warnings: Vec<String>,
    /// Error of `p`, `q` made in one cell.
    cell_error: f64,
    /// Error of `p`, `q` from impacts that are off in time.
    pub(super) scattered: f64,
    /// Error of `h` and `h′` from rays that are off: `Σ |jump| · time error`, fading as the jumps do; and the most it was.
    shifted: f64,
    pub(super) most_shifted: f64,
    /// Error of `v(0,b)`.
    pub(super) height_error: f64,
    /// The trace at the end of the last piece.
    last_trace: Option<S>,
}

/// The most strips that are followed: some hundred megabytes.
const MOST_PIECES: usize = 400_000;
/// The most segments of a round trip.
const MOST_SEGMENTS: usize = 4096;

impl<'a, S: RoundedSpecial> Follower<'a, S> {
    /// At `t = 0`.
    pub(super) fn new(medium: &'a Medium<S>, data: &'a Data<S>) -> Self {
        let mut follower = Self::with(medium, data, data.march(medium, &mut |_| {}));
        follower.height = data.ground.clone();
        if !data.ground.is_positive() && !follower.rises() {
            follower.contact = true;
            follower.landed = 1;
            let velocity = data.end_velocity();
            follower.marks.push(Mark { kind: EventKind::Impact, time: data.slope.zero(), velocity, time_error: 0.0 });
        }
        follower
    }

    /// At the first release, where the end leaves with `velocity` and the time may be off by `time_error`.
    pub(super) fn released(
        medium: &'a Medium<S>,
        data: &'a Data<S>,
        held: &'a Held<S>,
        (velocity, time_error): (S, f64),
    ) -> Self {
        let (mut state, error) = held.state(medium);
        state.segments[0].time_error = time_error;
        let mut follower = Self::with(medium, data, state);
        follower.held = Some(held);
        follower.landed = 1;
        follower.scattered = error;
        // As in `event`.
        follower.shifted = 2.0 * velocity.to_f64().abs() * time_error;
        follower.most_shifted = follower.shifted;
        follower.height_error += velocity.to_f64().abs() * time_error;
        follower.marks.push(Mark { kind: EventKind::Release, time: held.release.clone(), velocity, time_error });
        follower
    }

    /// In flight at height zero, with no error but that of the first cells.
    fn with(medium: &'a Medium<S>, data: &'a Data<S>, state: State<S>) -> Self {
        // A cell: what the series of its sides and of its sum leave out, and four roundings of every coefficient: the sum,
        // the correction, the decay and its factor.
        let roundoff = 4.0 * data.slope.log2_roundoff().exp2() * (1.0 + state.bound());
        Follower {
            medium,
            data,
            held: None,
            state,
            contact: false,
            landed: 0,
            height: data.slope.zero(),
            pieces: Vec::new(),
            marks: Vec::new(),
            checkpoints: Vec::new(),
            warnings: Vec::new(),
            cell_error: 4.0 * medium.log2_accuracy.exp2() + roundoff,
            scattered: 0.0,
            shifted: 0.0,
            most_shifted: 0.0,
            height_error: roundoff,
            last_trace: None,
        }
    }

    /// The error of `p` and `q`: what cells made, once for each cell on the longest path to here, and what impacts made.
    pub(super) fn error(&self) -> f64 {
        self.cell_error * (2.0 * self.pieces.len() as f64 + 8.0) + self.scattered
    }

    /// Whether the ground end, at height zero, leaves at once: `y > 0`, or `y = 0` and rising.
    ///
    /// What is less than the error counts as zero; Markov's inequality, `‖f′‖ ≤ 2n²‖f‖` on the unit interval, says what that
    /// is for a derivative.
    fn rises(&self) -> bool {
        let mut c = self.medium.trace(&self.state, true);
        let zero = self.height.zero();
        let mut noise = self.error();
        for _ in 0..3 {
            let value = at_zero(&c, &zero).to_f64();
            if value.abs() > noise {
                return value > 0.0;
            }
            noise *= 2.0 * (c.len() as f64).powi(2);
            c = derivative(&c);
        }
        false
    }

    /// Goes on until the goal.
    pub(super) fn run(&mut self, goal: &Goal<S>) -> Result<Ending, Error> {
        let unit = self.height.log2_roundoff().exp2();
        let mut round = i64::MIN;
        let mut calm = None;
        // Whether something happened at this very time already.
        let mut fresh = true;
        loop {
            let (pieces, segments) = (self.pieces.len(), self.state.segments.len());
            if pieces >= MOST_PIECES || segments > MOST_SEGMENTS {
                let time = (self.state.time() * &self.data.units.time).to_f64();
                return Err(if pieces >= MOST_PIECES {
                    Error::TooManyPieces { limit: MOST_PIECES, time }
                } else {
                    Error::TooManyRays { limit: MOST_SEGMENTS, time }
                });
            }
            if self.state.round > round {
                round = self.state.round;
                self.checkpoints.push((pieces, self.state.clone()));
                if let Some(ending) = self.settle(goal, &mut calm) {
                    return Ok(ending);
                }
            }
            if let Goal::Impacts(_) = goal
                && let Some(ending) = self.stays()
            {
                return Ok(ending);
            }
            // What the beginning of this strip decides.
            let first = &self.state.segments[0];
            let (len, ray_error) = (first.len.clone(), first.time_error);
            if !fresh && self.contact && self.rises() {
                self.event(ray_error, false);
                fresh = true;
                continue;
            }
            let trace = self.medium.trace(&self.state, self.contact);
            self.pass_ray(&trace, ray_error);
            let height = self.height_over(&trace, &len);
            let grounded = !self.contact && self.height.to_f64() <= self.height_error;
            if !fresh && grounded && !self.rises() {
                let time_error = ray_error.max(self.event_error(&trace, &height, &len.zero(), &len, 0.0));
                if self.land(goal, time_error) {
                    return Ok(Ending::NextImpact);
                }
                fresh = true;
                continue;
            }
            // The next event in this strip.
            let (noise, found) = if self.contact {
                let fall: Vec<S> = trace.iter().map(|term| -term.clone()).collect();
                let noise = self.error().max(unit * 16.0 * bound(&trace, 0));
                (noise, first_descent(&self.medium.basis, &fall, noise))
            } else {
                let noise = self.height_error + self.error() * len.to_f64();
                (noise, first_descent(&self.medium.basis, &height, noise))
            };
            // Where a root is not told from the noise, both the function and what is known of it are off by so much.
            let vague = if found.as_ref().is_some_and(|(_, vague)| *vague) { 2.0 * noise } else { 0.0 };
            let found = found.map(|(x, _)| x * &len);
            let nearby = |x: &S| x.to_f64() <= 32.0 * unit;
            let at_start = found.as_ref().is_some_and(&nearby);
            if at_start && !fresh {
                if self.contact {
                    self.event(ray_error, false);
                } else {
                    let time_error = ray_error.max(self.event_error(&trace, &height, &len.zero(), &len, 0.0));
                    if self.land(goal, time_error) {
                        return Ok(Ending::NextImpact);
                    }
                }
                fresh = true;
                continue;
            }
            if at_start {
                let time = (self.state.time() * &self.data.units.time).to_f64();
                self.warnings.push(format!("at t = {time} rounding decides between contact and flight"));
            }
            let at_end = found.as_ref().is_some_and(|x| nearby(&(len.clone() - x)));
            let found = found.filter(|_| !at_start && !at_end);
            if let Goal::Time(end) = goal {
                let left = end.clone() - self.state.time();
                if left.to_f64() <= 4.0 * unit * end.to_f64().max(1.0) {
                    return Ok(Ending::Time);
                }
                let ends = left < len && found.as_ref().is_none_or(|x| *x > left);
                if ends {
                    self.advance(Some(&left), 0.0, &trace, &height);
                    return Ok(Ending::Time);
                }
            }
            match found {
                Some(x) => {
                    let time_error = self.event_error(&trace, &height, &(x.clone() / &len), &len, vague);
                    self.advance(Some(&x), time_error, &trace, &height);
                    if self.contact {
                        self.event(time_error, true);
                    } else if self.land(goal, time_error) {
                        return Ok(Ending::NextImpact);
                    }
                    fresh = true;
                }
                None => {
                    self.advance(None, 0.0, &trace, &height);
                    if at_end && !self.contact {
                        self.height = self.height.zero();
                    }
                    fresh = false;
                }
            }
            let once = self.state.round > round && !self.contact && matches!(goal, Goal::Impacts(_));
            if once && let Some(ending) = self.escapes() {
                return Ok(ending);
            }
        }
    }

    /// A ray that may be off in time passes the ground: in flight the height takes its jump at the wrong time.
    fn pass_ray(&mut self, trace: &[S], ray_error: f64) {
        if ray_error > 0.0
            && let Some(last) = &self.last_trace
        {
            let jump = at_zero(trace, &self.height.zero()) - last;
            self.height_error += jump.to_f64().abs() * ray_error;
        }
    }

    /// `v(0,·)` over the strip.
    fn height_over(&self, trace: &[S], len: &S) -> Vec<S> {
        if self.contact {
            return Vec::new();
        }
        let mut height = trace.to_vec();
        height.push(len.zero());
        self.medium.basis.integrate(&mut height);
        super::cell::scale(&mut height, len);
        height[0] = height[0].clone() + &self.height;
        height
    }

    /// How far a root in the strip may be off: the error of the function, and `vague` more, over its slope, or the root of twice the error
    /// over the second derivative if that is less. What Clenshaw's sum rounds, at most `(k + 2)u` of each coefficient, counts
    /// where the strip is long and the hop is short.
    fn event_error(&self, trace: &[S], height: &[S], x: &S, len: &S, vague: f64) -> f64 {
        let len = len.to_f64();
        let at = |c: &[S]| evaluate(c, x).to_f64().abs();
        let first = derivative(trace);
        let (error, slope, curvature) = if self.contact {
            (self.error(), at(&first) / len, at(&derivative(&first)) / (len * len))
        } else {
            let roundings: f64 = (2u32..).zip(height).map(|(k, c)| f64::from(k) * c.to_f64().abs()).sum();
            let rounding = x.log2_roundoff().exp2() * roundings;
            (self.height_error + self.error() * len * x.to_f64() + rounding, at(trace), at(&first) / len)
        };
        let error = error + vague;
        let unit = 4.0 * x.log2_roundoff().exp2() * (1.0 + self.state.round.unsigned_abs() as f64);
        (error / slope).min((2.0 * error / curvature).sqrt()).min(1.0) + unit
    }

    /// Marches over the first segment, or the part of it before `cut`.
    fn advance(&mut self, cut: Option<&S>, time_error: f64, trace: &[S], height: &[S]) {
        let from = self.state.time();
        let whole = self.state.segments[0].len.clone();
        let (mut trace, mut height) = (trace.to_vec(), height.to_vec());
        if let Some(cut) = cut {
            let fraction = cut.clone() / &whole;
            let part = |c: &[S]| self.medium.basis.restrict(c, &fraction.zero(), &fraction, c.len());
            trace = part(&trace);
            height = if height.is_empty() { height } else { part(&height) };
            self.medium.cut_first(&mut self.state, cut, time_error);
        }
        let len = cut.cloned().unwrap_or(whole);
        let zero = len.zero();
        if !self.contact {
            self.height_error += self.error() * len.to_f64();
            self.height = at_one(&height, &zero);
        }
        // A jump of p fades along its ray like p_η = −κp, and η = 2t there.
        self.shifted *= (-2.0 * self.medium.kappa.to_f64() * len.to_f64()).exp();
        self.last_trace = Some(at_one(&trace, &zero));
        self.medium.strip(&mut self.state, self.contact, &mut |_| {});
        let contact = self.contact;
        self.pieces.push(Piece { from, len, contact, cut: cut.is_some(), still: false, trace, height });
    }

    /// Turns contact into flight or back, now. A release at a root of the trace has velocity zero. Where the end
    /// only touches the ground and a ray arrives at that very time, the velocity is the one that the ray brings.
    fn event(&mut self, time_error: f64, at_root: bool) {
        let zero = self.height.zero();
        let kind = if self.contact { EventKind::Release } else { EventKind::Impact };
        let velocity = match (&self.last_trace, kind) {
            (Some(last), EventKind::Impact) if last.to_f64() < -self.error() => last.clone(),
            (_, EventKind::Release) if at_root => zero.clone(),
            _ => at_zero(&self.medium.trace(&self.state, true), &zero),
        };
        // p goes over from −q to q or back, where q is the velocity.
        self.shifted += 2.0 * velocity.to_f64().abs() * time_error;
        self.most_shifted = self.most_shifted.max(self.shifted);
        if self.contact {
            self.height_error = velocity.to_f64().abs() * time_error;
        } else {
            // The part of the ray that is off has twice the mass of the error of the height, and scatters at rate κ.
            self.scattered += 4.0 * self.medium.kappa.to_f64() * self.height_error;
            self.height_error = 0.0;
        }
        self.contact = !self.contact;
        self.height = zero;
        let time = self.state.time();
        // A ray of the start is off by no more than the roundings of t₁ and of its own time.
        let rounding = 4.0 * time.log2_roundoff().exp2() * (1.0 + time.to_f64());
        self.marks.push(Mark { kind, time, velocity, time_error: time_error.max(rounding) });
    }

    /// An impact now; whether it is the one after the last that was asked for.
    fn land(&mut self, goal: &Goal<S>, time_error: f64) -> bool {
        if let Goal::Impacts(count) = goal
            && self.landed >= *count
        {
            return true;
        }
        self.landed += 1;
        self.event(time_error, false);
        false
    }
}
