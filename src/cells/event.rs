//! Effects of an event on the state and on its error bound.

use super::account::Proof;
use super::budget::{AtEvent, LEAP_CELLS, MOST_LATE, weight_rest};
use super::dependence::{Landing, TakeOff};
use super::follow::{Follower, Goal};
use super::near::{open_release, open_touch};
use super::piece::Mark;
use super::series::{at_zero, bound, derivative, evaluate};
use super::uncertainty::Off;
use crate::motion::EventKind;
use crate::reason::{Near, Warning};
use crate::special::RoundedSpecial;

/// First step, in strips, of the search for the extent of an undecided stretch; later steps are longer.
const SMALLEST_STEP: f64 = 1e-12;

impl<S: RoundedSpecial> Follower<'_, S> {
    /// Computes the error of a root in the strip: the error of the function plus `vague` over its slope, or the square
    /// root of twice that error over the second derivative if this is less. If the function bends back, the former
    /// grows by a factor of up to two. The rounding of Clenshaw's sum, at most `(2k + 1)² u` of each coefficient,
    /// matters where the strip is long and the hop is short.
    pub(super) fn event_error(&self, trace: &[S], height: &[S], x: &S, len: &S, vague: f64) -> Off {
        let strip = len.to_f64();
        let at = |c: &[S]| evaluate(c, x).to_f64();
        let first = derivative(trace);
        let factor = |k: u32| f64::from(2 * k + 1).powi(2);
        let series = if self.contact { trace } else { height };
        let roundings: f64 = (0u32..).zip(series).map(|(k, c)| factor(k) * c.to_f64().abs()).sum();
        let more = vague + x.log2_roundoff().exp2() * roundings;
        let (error, slope, curvature) = if self.contact {
            (self.budget.point(), at(&first) / strip, at(&derivative(&first)) / (strip * strip))
        } else {
            (self.height_error(strip * x.to_f64()), at(trace), at(&first) / strip)
        };
        // Rounding of the place in the strip.
        let place = 4.0 * x.log2_roundoff().exp2() * (1.0 + self.state.round.unsigned_abs() as f64);
        let (bends_back, slope, curvature) = (slope * curvature < 0.0, slope.abs(), curvature.abs());
        // The error as a fraction of s²/2c, the depth at which the function bends back.
        let part = |error: f64| 2.0 * curvature * (error + more) / (slope * slope);
        let off = |error: f64| {
            let back = if bends_back { 2.0 / (1.0 + (1.0 - part(error)).max(0.0).sqrt()) } else { 1.0 };
            (back * (error + more) / slope).min((2.0 * (error + more) / curvature).sqrt()) + place
        };
        // The clock of the run has an error of its own.
        let late = self.budget.clock(self.contact);
        Off { fixed: off(error.fixed), apart: off(error.apart) + late }
    }

    /// Carries out an impact at the beginning of this strip, at a ray with the time error `ray`; otherwise as
    /// [`Follower::land`]. The end is within the noise of the ground, and reaches it a little later.
    pub(super) fn land_at_ray(&mut self, goal: &Goal<S>, ray: Off, trace: &[S], height: &[S], len: &S) -> bool {
        let zero = len.zero();
        let left = at_zero(height, &zero).to_f64().abs();
        let off = ray.max(self.event_error(trace, height, &zero, len, left));
        self.at_ray = true;
        self.land(goal, off)
    }

    /// Carries out an impact now; returns whether it comes after the last one requested, which ends the run.
    pub(super) fn land(&mut self, goal: &Goal<S>, off: Off) -> bool {
        if let Goal::Impacts(count) = goal
            && self.landed >= *count
        {
            let rounding = self.rounding();
            let last = self.budget.better(off) + rounding;
            self.end_error = if self.lost { f64::INFINITY } else { last };
            return true;
        }
        self.landed += 1;
        self.event(off, None);
        false
    }

    /// Returns the roundings of t₁ and of the present time, which bound the time error of a ray from the initial data:
    /// up to 4.5 of t₁, and two of the time.
    fn rounding(&self) -> f64 {
        let time = self.state.time();
        8.0 * time.log2_roundoff().exp2() * (1.0 + time.to_f64())
    }

    /// Changes contact into flight or flight into contact, now. A release at a root of the trace, where the trace has
    /// this `slope`, has velocity zero. If the end only touches the ground and a ray arrives at that very time, the
    /// velocity is that of the ray.
    pub(super) fn event(&mut self, off: Off, slope: Option<f64>) {
        let zero = self.height.zero();
        let kind = if self.contact { EventKind::Release } else { EventKind::Impact };
        let velocity = match (&self.last_trace, kind) {
            (Some(last), EventKind::Impact) if last.to_f64() < -self.noise() => last.clone(),
            (_, EventKind::Release) if slope.is_some() => zero.clone(),
            _ => at_zero(&self.held_trace(), &zero),
        };
        let time = self.state.time();
        if self.budget.lost(off) && !self.lost {
            self.lost = true;
            let from = (time.clone() * &self.data.units.time).to_f64();
            self.warnings.push(Warning::EventsOverlap { from });
        }
        self.height = zero;
        if !self.contact {
            self.prove(Proof::impact);
        } else if let (Some(last), None) = (self.last_trace.clone(), slope) {
            self.prove(|proof, run| proof.let_go_at_ray(run, &last, &run.state.segments[0].at));
        }
        let rounding = self.rounding();
        self.budget.note_event(off);
        let since = self.budget.since();
        match self.marks.last_mut() {
            Some(last) => last.after = since,
            None => self.before = since,
        }
        let mark = self.marks.len();
        self.marks.push(Mark::new(kind, time, velocity.clone()));
        if self.contact {
            self.contact = false;
            self.rising = true;
            self.let_go(&velocity, off, slope);
        } else {
            self.touch_down(&velocity, off);
            self.note_slope();
            self.contact = true;
            self.weigh();
        }
        if !self.lost {
            self.marks[mark].time_error = self.budget.last(off) + rounding;
            self.marks[mark].at = self.at_event();
        }
    }

    /// Returns the error bounds of values at the event that has just occurred, if flights are separated.
    pub(super) fn at_event(&self) -> Option<AtEvent> {
        let (slope, _, variation) = self.medium.variation(&self.state);
        let begins = self.flying().map(|_| (slope, variation, self.bend()));
        self.medium.splits().then(|| self.budget.at_event(begins))
    }

    /// Computes `z_tt` of the end just after the present time in a separated flight.
    fn bend(&self) -> f64 {
        let (first, zero) = (&self.state.segments[0], self.height.zero());
        at_zero(&derivative(&self.medium.trace(&self.state, false)), &zero).to_f64() / first.len.to_f64()
    }

    /// Releases the end with this velocity, at a root of the stress with this slope or at a ray: p changes from −q to
    /// q, early or late by the time error.
    pub(super) fn let_go(&mut self, velocity: &S, off: Off, slope: Option<f64>) {
        self.budget.let_go(velocity.to_f64().abs(), off, self.cell_error);
        self.take_off(velocity, off, slope);
        self.note_slope();
    }

    /// Records bounds of the slopes of velocities between rays (`q` by its slope and by damping, the static state by
    /// gravity), and of velocities and strains (those of `q`, the centre of mass and the static state).
    pub(super) fn note_slope(&mut self) {
        let rate = self.centre().map_or(0.0, |(_, rate)| rate.to_f64().abs());
        let moving = self.state.bound() + rate;
        let (slope, _, jumps) = self.medium.variation(&self.state);
        let slope = slope + self.medium.gravity.to_f64() + 2.0 * self.damping() * moving;
        let still = self.medium.slope.to_f64().abs() + 0.5 * self.medium.gravity.to_f64();
        self.budget.note_slope((slope, jumps), (moving + still, self.state.bound()));
    }

    pub(super) fn take_off(&mut self, velocity: &S, off: Off, slope: Option<f64>) {
        if !self.medium.splits() {
            return;
        }
        self.weigh();
        let flight = self.medium.take_off(&mut self.state, &self.height);
        let begins = (flight.rate.to_f64(), flight.height.to_f64());
        self.prove(|proof, run| proof.take_off(run.medium, &run.state, begins));
        let (round, first) = (self.state.round, self.state.segments[0].at.clone());
        let since = |(landing, at): &(i64, S)| ((round - landing) as f64) + (first.clone() - at).to_f64();
        let whole = self.landing.as_ref().is_some_and(|(landing, at)| *landing + 1 == round && *at == first);
        self.ground = self.height.clone() - &flight.height;
        let (velocity, rate) = (velocity.to_f64(), flight.rate.to_f64());
        // The contact has p = −q, and the last q is the last trace.
        let last = self.last_trace.as_ref().map_or(self.state.bound(), S::to_f64);
        let fall = -self.medium.gravity.to_f64() - 2.0 * self.damping() * rate;
        let begins = TakeOff {
            at: self.place(),
            len: self.landing.as_ref().map_or(0.0, since),
            whole,
            off: off.apart,
            rounding: 8.0 * self.height.log2_roundoff().exp2(),
            slope,
            jump: (velocity - last, velocity + last),
            end_rate: velocity - rate,
            fall,
        };
        let rounding = LEAP_CELLS * self.cell_error;
        self.budget.take_off(begins, rounding);
        self.flight = Some(self.flights.len());
        self.flights.push(flight);
        self.weigh();
    }

    /// Lands the end: the ray that starts carries the time error.
    fn touch_down(&mut self, velocity: &S, off: Off) {
        let speed = velocity.to_f64().abs();
        self.landing = Some((self.state.round, self.state.segments[0].at.clone()));
        self.compare_rays(speed, off);
        let damping = self.damping();
        self.budget.hit(speed, off);
        let (Some(flight), Some((_, rate))) = (self.flying().cloned(), self.centre()) else { return };
        let (slope, range, variation) = self.medium.variation(&self.state);
        let (phase, sup) = (self.medium.phase(&self.state), self.state.bound());
        let age = flight.age(&self.state).to_f64();
        let fall = -self.medium.gravity.to_f64() - 2.0 * damping * rate.to_f64();
        let landing = Landing {
            at: self.place(),
            velocity: velocity.to_f64(),
            curvature: slope + fall.abs(),
            off,
            rate: rate.to_f64(),
            age,
            fall,
            range,
            variation,
            slope,
            bend: if self.at_ray { slope } else { self.bend() },
            phase: (phase, weight_rest(0.5 * damping) * sup),
        };
        self.budget.land(landing);
        let size = rate.to_f64().abs() + self.medium.gravity.to_f64() + self.medium.slope.to_f64().abs();
        self.prove(|proof, run| proof.shift(&run.state, size));
        self.medium.touch_down(&mut self.state, &flight);
        self.flight = None;
    }

    /// Counts a landing that the bound does not separate from a passing ray: between the two the end may rise for as
    /// long, now and whenever both return. A landing without speed starts no ray.
    fn compare_rays(&mut self, speed: f64, off: Off) {
        let off = self.budget.better(off);
        let segments = &self.state.segments;
        let last = &segments[segments.len() - 1];
        // The ray of the release itself does not count.
        let own = self.flying().is_some_and(|flight| segments[segments.len() - 1].at == flight.from.1);
        let near = segments[0].len.to_f64() < off || (last.len.to_f64() < off && !own);
        let speeds = (self.medium.gravity.to_f64() + self.noise()) * off;
        if speed > speeds && (near || self.at_ray) {
            self.count_unresolved(off);
        }
    }

    /// Records an undecided release at the ray that arrives now: the stress on either side of the ray is within its
    /// bound of zero.
    pub(super) fn note_open_ray(&mut self, trace: &[S]) {
        let off = self.trace_error();
        let after = at_zero(trace, &self.height.zero()).to_f64();
        let before = self.last_trace.as_ref().map_or(f64::NEG_INFINITY, S::to_f64);
        if !self.medium.kappa.is_zero() && before != 0.0 && (after.abs() <= off || before >= -off) {
            self.note_open_release(trace, 0.0, off);
        }
    }

    /// Tests the motion of the ground end in this strip, until `left` from now, against its error bound, as in
    /// [`super::near`]. Returns whether an event is undecided; the bounds of the rest of the run include both outcomes.
    pub(super) fn note_open(&mut self, trace: &[S], height: &[S], fresh: bool, left: f64) -> bool {
        let (basis, len) = (&self.medium.basis, self.state.segments[0].len.to_f64());
        // Without damping events lie on rays by construction; the lattice computes such runs.
        if self.medium.kappa.is_zero() {
            return false;
        }
        let off = self.trace_error();
        if self.contact {
            let begins = fresh && self.pieces.is_empty();
            // A release undecided at the ray that begins the strip is counted already.
            let open = open_release(basis, trace, off, begins).filter(|at| at * len < left);
            if let Some(at) = open.filter(|at| fresh || *at > 0.0) {
                self.note_open_release(trace, at, off);
            }
            return open.is_some();
        }
        let (high, mut rising) = (self.height_most(len, 0.0), self.rising);
        let open = open_touch(basis, (height, trace), (high, off), &mut rising);
        self.rising = rising;
        let Some(at) = open.filter(|at| at * len < left) else { return false };
        let at_ray = at == 0.0 && !fresh;
        let before = self.last_trace.as_ref().filter(|_| at_ray).map_or(0.0, S::to_f64);
        // The stretch on which the end may lie on the ground: p is −q there, and q in flight.
        let lies = |to: f64| value(height, to).abs() <= high && value(trace, to) <= off;
        let (from, to) = stretch(at, |from| value(height, from) <= high, |_, to| lies(to), 2.0);
        let most = if to > from { self.most_on(trace, (from, to)) } else { 0.0 };
        if before < -off {
            // The time until the ray arrives, for the rest of the fall.
            self.budget.cover_hop(4.0 * high);
            self.count_unresolved(2.0 * high / -before);
        }
        self.not_told(at * len, Near::Touch, 2.0 * (most + off));
        true
    }

    /// Records an undecided release. From the place `at` in this strip on the stress is within `off` of zero: the end
    /// may fly until the integral of the greatest possible stress is negative again.
    fn note_open_release(&mut self, trace: &[S], at: f64, off: f64) {
        let mut area = trace.to_vec();
        area.push(trace[0].zero());
        self.medium.basis.integrate(&mut area);
        // The stretch ends once the end has certainly let go, or would be back on the ground.
        let open = |from: f64, to: f64| {
            value(trace, to) <= off && value(&area, to) - value(&area, from) + off * (to - from) >= 0.0
        };
        let both = stretch(at, |from| value(trace, from) >= -off, |from, to| to == at || open(from, to), 1.5);
        let most = self.most_on(trace, both);
        let len = self.state.segments[0].len.to_f64();
        self.not_told(at * len, Near::Release, 2.0 * (most + off));
    }

    /// Bounds `|trace|` on a stretch of this strip.
    fn most_on(&self, trace: &[S], (from, to): (f64, f64)) -> f64 {
        let (from, to) = (trace[0].double(from), trace[0].double(to));
        bound(&self.medium.basis.restrict(trace, &from, &to, trace.len()), 0)
    }

    /// Records an undecided event `later` than now, after which velocities may differ by `differ`.
    pub(super) fn not_told(&mut self, later: f64, what: Near, differ: f64) {
        let units = &self.data.units;
        let time = (self.state.time().to_f64() + later) * units.time.to_f64();
        self.warnings.push(Warning::NotTold { time, what, differ: differ * units.velocity.to_f64() });
        self.budget.cover(differ);
        if differ > MOST_LATE && !self.lost {
            self.lost = true;
            self.warnings.push(Warning::EventsOverlap { from: time });
        }
    }

    /// Counts one more hop or contact of at most this length that the bound does not separate from its neighbours.
    fn count_unresolved(&mut self, longest: f64) {
        let unit = &self.data.units.time;
        let (from, most, landings) = match self.unresolved {
            Some(Warning::HopsUnresolved { from, longest, landings }) => (from, longest, landings),
            _ => ((self.state.time() * unit).to_f64(), 0.0, 0),
        };
        let longest = most.max(longest * unit.to_f64());
        self.unresolved = Some(Warning::HopsUnresolved { from, longest, landings: landings + 1 });
    }
}

/// Computes the value of a series at the place `x` of a strip.
fn value<S: RoundedSpecial>(c: &[S], x: f64) -> f64 {
    evaluate(c, &c[0].double(x)).to_f64()
}

/// Returns the stretch about the place `at` of a strip that reaches back while `before` holds where it begins, and on
/// while `after` holds for both its ends; steps back double, and steps on grow by the factor `growth`.
fn stretch(at: f64, before: impl Fn(f64) -> bool, after: impl Fn(f64, f64) -> bool, growth: f64) -> (f64, f64) {
    let (mut from, mut step) = (at, SMALLEST_STEP);
    while from > 0.0 && before(from) {
        (from, step) = ((from - step).max(0.0), 2.0 * step);
    }
    let (mut to, mut step) = (at, SMALLEST_STEP);
    while to < 1.0 && after(from, to) {
        (to, step) = ((to + step).min(1.0), growth * step);
    }
    (from, to)
}
