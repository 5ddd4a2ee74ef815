//! Proof of a damped run: the properties of the true motion that follow from the stored one.
//!
//! The stored history is taken as exact data. Each step differs from the exact image of the state stored before it by
//! at most its own defect (module `defect`). Neither `sup(|δp|, |δq|)` nor `∫ |δp| + |δq|` grows (module `cell`; `|p| =
//! |q|` at both ends), so errors are added, step by step, and never propagated. `docs/proofs.md` has the lemmas.
//! Dimensionless: times in `t₁`, lengths in `c t₁`, velocities in `V`; `δ = δ_E + δ_W`:
//!
//! - **E**, `roundoff`: `sup |δ_E|`, the sum of all defects so far.
//! - **W**, `masses`: `∫ |δ_W|`. An event with a time error of at most τ differs from the true one in the boundary
//!   condition at the ground for at most τ, where p is −q in one motion and q in the other: `2τ max|q|`.
//! - **Θ**, `clock`: bound of the shift of the true motion's clock at impacts, which replaces that mass.
//! - Away from displaced rays, `|δq| ≤ F = E + min(R(T + 1), e^R) W` plus the rounding of the trace itself.
//! - In flight `|δv(0,·)| ≤ H`, [`Proof::height_off`].
//!
//! A sign below that is not proved ends the proof: at the beginning of the strip in question.

use super::account::{Change, Open, Proof, Release, SLACK};
use super::budget::AtEvent;
use super::follow::Follower;
use super::leap::LeapCount;
use super::march::{Medium, on_circle};
use super::piece::Found;
use super::series::{at_one, at_zero, bound, derivative, evaluate};
use super::signs::{Part, clear, doubles};
use super::start::Data;
use super::uncertainty::Uncertainty;
use crate::error::Error;
use crate::motion::{Ending, EventKind};
use crate::reason::{Near, Reason};
use crate::special::RoundedSpecial;

/// Roundings of a queried value, per cube of the number of terms of a series.
const ASKED: f64 = 4096.0;

impl<S: RoundedSpecial> Follower<'_, S> {
    /// Runs `work` on the account of the proof, if there is one.
    pub(super) fn prove(&mut self, work: impl FnOnce(&mut Proof<S>, &Self)) {
        // Only runs in long numbers are proved.
        if cfg!(feature = "wide")
            && let Some(mut proof) = self.proof.take()
        {
            work(&mut proof, self);
            self.proof = Some(proof);
        }
    }

    /// Returns whether the proof has ended.
    pub(super) fn open(&self) -> bool {
        self.proof.as_ref().is_some_and(|proof| proof.open.is_some())
    }
}

impl<S: RoundedSpecial> Proof<S> {
    pub(super) fn start(&mut self, run: &Follower<'_, S>) {
        let (unit, data) = (self.steps.unit, run.data);
        let defect = self.steps.start(&run.state, data.most, data.shortest);
        self.add(defect);
        // A break is misplaced by at most 16 roundings of 1: those of x, L, x/2L, the part of a piece, and its mirror
        // image. Up to there each of `p` and `q` is off by the jump, at most 4, and `most` is at least 1.
        self.masses += 256.0 * unit * data.most * run.state.segments.len() as f64;
        self.summed = 64.0 * unit * data.ground.to_f64().abs();
        self.rising = !data.ground.is_positive();
        self.most = self.most.max(run.state.bound());
        self.rays.extend(run.state.segments.iter().map(|segment| (segment.at.clone(), [0.0; 2])));
        self.joins(run.medium, 1);
    }

    /// Computes F at a time.
    fn trace_off(&self, damping: f64, time: f64) -> f64 {
        (self.roundoff + (damping * (time + 1.0)).min(damping.exp()) * self.masses) * (1.0 + SLACK)
    }

    /// Computes `A`: the bound of the error of `h′` of a flight.
    fn rate_off(&self, damping: f64) -> f64 {
        (damping.exp() * (self.roundoff + self.masses) + self.means[0]) * (1.0 + SLACK)
    }

    /// Computes H, at the time `flown` after the release.
    ///
    /// If separated: at the release `|δv(0)|` is at most the mass that the release has left; since then `h` moves by
    /// `s A`, and `z(0) = ∫ w (q − h′) dη` with `∫|w| ≤ ¼e^R`, `|w| ≤ ½e^R` has an error then and now; and since `z(0)`
    /// was last a mean of stored data, it has the defects of the steps. Otherwise the defect of each step moves the end
    /// by its own mean and vibration: by `(s + 3)(E + W)` under a free top, and by `2(E + W)` under a held one, with
    /// the masses W of displaced rays; the error of the sum of `∫ q dt` itself is added.
    fn height_off(&self, run: &Follower<'_, S>, flown: f64) -> f64 {
        let (damping, both) = (run.damping(), self.roundoff + self.masses);
        let rate = 2.0 * damping;
        let fall = if rate * flown < 1e-8 { flown } else { -(-rate * flown).exp_m1() / rate };
        let off = if let Some(flight) = run.flying() {
            let far = flight.height.to_f64().abs() + fall * flight.rate.to_f64().abs();
            let far = far + run.medium.gravity.to_f64() * (flown * flown).min(flown / damping);
            let (centre, mean) = (self.rate_off(damping), self.means[0] + self.means[1]);
            let swing = damping.exp() * (0.25 * (self.roundoff + centre) + 0.5 * self.masses);
            self.left
                + fall * centre
                + 2.0 * (swing + mean)
                + (self.roundoff - self.weighed + self.trip)
                + 64.0 * self.steps.unit * (far + self.most)
        } else if run.medium.free_top {
            (fall + 3.0) * both + self.summed
        } else {
            2.0 * both + self.summed
        };
        off * (1.0 + SLACK)
    }

    /// Bounds the rates of change of the motion from the beginning of a strip on, as long as its contact or flight goes
    /// on. If `jump` is known, it bounds the jump of p on the ray that starts with the strip.
    ///
    /// `(p_t, q_t)` solves the equations without gravity, with the same reflections: the part that comes from its
    /// continuous part never exceeds that in size, and the part that comes from its masses never exceeds them in mass.
    /// On the characteristic `q_t = q_η + q_ξ`, `q_ξ = −κ(p + q)`.
    fn change(&self, run: &Follower<'_, S>, jump: Option<f64>) -> Change {
        let (medium, zero) = (run.medium, run.height.zero());
        let (kappa, offset) = (medium.kappa.to_f64(), 2.0 * medium.offset.to_f64().abs());
        let (mut slope, mut jumps) = (0.0f64, 0.0);
        let mut before: Option<f64> = None;
        for segment in &run.state.segments {
            let q = doubles(&segment.q);
            slope = slope.max(bound(&derivative(&q), 0) / segment.len.to_f64() + kappa * bound(&q, 0));
            if let Some(before) = before {
                jumps += (at_zero(&segment.q, &zero).to_f64() - before).abs();
            }
            before = Some((at_one(&segment.q, &zero) * &segment.decay).to_f64());
        }
        let most = run.state.bound() + offset;
        let falls = run.centre().map_or(0.0, |(_, rate)| {
            let gravity = medium.gravity.to_f64();
            gravity + 4.0 * kappa * (rate.to_f64().abs() + gravity)
        });
        let roundings = 64.0 * self.steps.size * f64::EPSILON * most * run.state.segments.len() as f64;
        Change {
            between: (slope + 2.0 * kappa * most + falls) * (1.0 + SLACK),
            jumps: (jumps + jump.unwrap_or(2.0 * most)) * (1.0 + SLACK) + roundings,
        }
    }

    /// Records the error bounds of values up to now.
    fn note(&mut self, run: &Follower<'_, S>, time: f64, high: f64) {
        let damping = run.damping();
        let both = self.roundoff + self.masses;
        let centre = run.centre().map_or(0.0, |(_, rate)| rate.to_f64().abs());
        let most = 2.0 * (self.most + centre + run.medium.gravity.to_f64() + run.medium.slope.to_f64().abs());
        let far = 1.0 + time;
        let asked =
            ASKED * self.steps.unit * (self.steps.size.powi(3) * most + far * (self.slope + most)) + 4.0 * self.leapt;
        self.height = if run.contact { self.height } else { self.height.max(high) };
        let now = Uncertainty {
            rise: self.height + 2.0 * both + far * asked,
            speed: self.trace_off(damping, time) + asked,
            rate: self.rate_off(damping) + both + asked,
            late: self.clock,
            slope: self.slope,
            jumps: self.jumps,
            most,
            peak: most,
            ..Uncertainty::default()
        };
        let last = self.known.len() - 1;
        self.known[last] = self.known[last].max(now);
    }

    /// Records an event with these time errors.
    fn event(&mut self, off: [f64; 2]) {
        self.events.push(off);
        let last = self.known[self.known.len() - 1];
        self.known.push(Uncertainty { late: self.clock, ..last });
    }

    /// Records the contact that begins the run.
    pub(super) fn contact(&mut self) {
        self.event([0.0; 2]);
        self.known[1] = Uncertainty::default();
    }

    /// Records the proved impact, or ends the proof if the impact is not proved.
    pub(super) fn impact(&mut self, run: &Follower<'_, S>) {
        match self.landed.take() {
            Some(off) => {
                self.event(off);
                self.note(run, run.state.time().to_f64(), 0.0);
            }
            // An impact at a ray is a coincidence.
            None => self.end(run, run.pieces.len(), Open { what: Near::Touch, differ: 2.0 * self.most }),
        }
    }

    fn end(&mut self, run: &Follower<'_, S>, pieces: usize, open: Open) {
        if self.open.is_none() {
            // A release that is not proved takes the strip before it along.
            let pieces = self.release.as_ref().map_or(pieces, |release| release.pieces);
            self.open = Some((pieces.min(run.pieces.len()), open));
        }
    }

    /// Records a release at a ray, which the next strip has to prove; `left` is the last stress.
    pub(super) fn let_go_at_ray(&mut self, run: &Follower<'_, S>, left: &S, at: &S) {
        let ([ray, late], pieces) = (self.ray_at(at), run.pieces.len().saturating_sub(1));
        self.release = Some(Release { pieces, left: Some(left.to_f64()), late, steep: 0.0, ray, at: at.clone() });
    }

    /// Proves the next strip, up to `cut` if there is one; the flag says whether it ends with a release or a landing.
    pub(super) fn strip(&mut self, run: &Follower<'_, S>, cut: Option<(&S, bool)>, trace: &[S], height: &[S]) {
        let first = &run.state.segments[0];
        let (from, len) = (run.state.time().to_f64(), first.len.to_f64());
        let time = from + cut.map_or(len, |(cut, _)| cut.to_f64());
        self.drift(run.medium, len);
        let jump = run.last_trace.as_ref().filter(|_| self.release.is_none());
        let jump = jump.map(|last| (at_zero(trace, &last.zero()) - last).to_f64().abs());
        let change = self.change(run, jump);
        self.slope = self.slope.max(change.between).max(bound(&derivative(trace), 0) / len * (1.0 + SLACK));
        self.jumps = self.jumps.max(change.jumps);
        let own = self.steps.trace(run.medium, first, run.contact);
        let found = if run.contact {
            self.held(run, (time, len), cut, trace, own)
        } else {
            self.flown(run, (time, len), cut, (trace, height), (own, change))
        };
        if let Err(open) = found {
            self.end(run, run.pieces.len(), open);
        }
        if let Some((cut, _)) = cut {
            let fraction = cut.clone() / &first.len;
            let (zero, one, size) = (cut.zero(), cut.one(), run.medium.basis.size());
            let lost = |from: &S, to: &S, len: &S| {
                bound(&run.medium.basis.restrict(&first.q, from, to, size), run.medium.terms(len, 1.0))
            };
            let rest = first.len.clone() - cut;
            let lost = lost(&zero, &fraction, cut) + lost(&fraction, &one, &rest);
            let defect = self.steps.cut(first) + lost;
            self.add(defect);
        }
    }

    /// Proves the release at the end of a run, if there is one, by the strip after it.
    pub(super) fn last_release(&mut self, run: &Follower<'_, S>, cut: Option<(&S, bool)>, trace: &[S], height: &[S]) {
        if self.release.is_some() {
            self.strip(run, cut, trace, height);
        }
    }

    /// Finds a stretch from the beginning of a strip on which the stress falls from zero; returns its end, as a part of
    /// the strip, and the time τ from which on the end is proved to press.
    ///
    /// **Source**: a stress that is σ̂₀ at first and falls at least at the rate s is below −F from `(F + |σ̂₀|)/s` on.
    fn pressing_from(&self, trace: &[S], len: f64, fast: f64) -> Option<(S, f64)> {
        let zero = trace[0].zero();
        let start = at_zero(trace, &zero).to_f64();
        let rate = doubles(&derivative(trace));
        let rate = Part::in_doubles(&self.doubles, &rate);
        (0..64).map(|k| (-f64::from(k)).exp2()).find_map(|part| {
            let (_, most) = rate.range(&zero, &zero.double(part));
            let late = 4.0 * (fast + start.abs()) * len / -most * (1.0 + SLACK);
            (most < 0.0 && 4.0 * late <= part * len).then(|| (zero.double(part), late))
        })
    }

    /// Proves a strip in contact.
    ///
    /// **Contact without a force at first**: a stress of at most ε sends the same wave up in contact and in flight, to
    /// within 2ε, and the end rises by no more than F times the duration. Where the stress then falls, the end presses
    /// from τ on; until then it may leave the ground and come back, as at a release.
    ///
    /// **Release at a root**: before, the stress is below −F; around `t̂` it has at least the slope s. So the end lets
    /// go in `t̂ ± τ`, `τ = (F + |σ̂(t̂)|)/s`, at least once.
    fn held(
        &mut self,
        run: &Follower<'_, S>,
        (time, len): (f64, f64),
        cut: Option<(&S, bool)>,
        trace: &[S],
        own: f64,
    ) -> Result<(), Open> {
        let fast = self.trace_off(run.damping(), time) + own + 8.0 * self.slope * self.latest();
        let open = Open { what: Near::Release, differ: 2.0 * (bound(trace, 0) + fast) };
        let (zero, one) = (trace[0].zero(), trace[0].one());
        let was_silent = std::mem::take(&mut self.silent) && at_zero(trace, &zero).to_f64() >= -fast * (1.0 + SLACK);
        let size = bound(trace, 0) + own;
        if was_silent && size <= fast && cut.is_none_or(|(_, event)| !event) {
            let off = 4.0 * run.damping().exp() * size;
            let lifted = len * (fast + off) * (1.0 + SLACK);
            self.add(off);
            self.masses += 2.0 * lifted;
            (self.lifted, self.silent) = (self.lifted + lifted, true);
            self.note(run, time, 0.0);
            return Ok(());
        }
        let begun = if was_silent { self.pressing_from(trace, len, fast) } else { None };
        if let Some((_, late)) = &begun {
            let most = at_zero(trace, &zero).to_f64().abs() + 4.0 * self.slope * late + fast;
            let off = late + 64.0 * self.steps.unit;
            self.lifted += off * most;
            self.starts(run.state.segments[0].at.clone(), run.state.time().to_f64(), [off; 2], 4.0 * off * most);
        }
        let pressing = begun.map_or_else(|| zero.clone(), |(part, _)| part);
        let pressed = |to: S| {
            let part = (pressing.clone(), to);
            part.1 <= part.0
                || Part::in_doubles(&self.doubles, &doubles(trace)).below(part.clone(), fast)
                || Part::of(&run.medium.basis, trace).below(part, fast)
        };
        if len <= 8.0 * self.latest() {
            return Err(open);
        }
        let Some((cut, true)) = cut else {
            let to = cut.map_or(one, |(cut, _)| cut.clone() / &run.state.segments[0].len);
            return if pressed(to) {
                self.note(run, time, 0.0);
                Ok(())
            } else {
                Err(open)
            };
        };
        let at = cut.clone() / &run.state.segments[0].len;
        let rate = derivative(trace);
        let found = Part::in_doubles(&self.doubles, &doubles(&rate)).steep(&at, 1.0);
        let found = found.or_else(|| Part::of(&run.medium.basis, &rate).steep(&at, 1.0));
        let (delta, least, _) = found.ok_or(open)?;
        let rest = evaluate(trace, &at).to_f64().abs() * (1.0 + SLACK) + own;
        let steep = least / len * (1.0 - SLACK);
        let late = (self.trace_off(run.damping(), time) + own + rest) / steep;
        if delta * len < 4.0 * (late + self.latest()) || !pressed(at - zero.double(delta)) {
            return Err(open);
        }
        self.note(run, time, 0.0);
        let place = on_circle(run.state.segments[0].at.clone() + cut);
        self.release =
            Some(Release { pieces: run.pieces.len(), left: None, late, steep, ray: f64::INFINITY, at: place });
        Ok(())
    }

    /// Proves, in the first strip of a flight, the release that it begins with; returns the time errors of the release.
    ///
    /// **At a ray**: the stress is below −F on one side of it, or the end has stood without a force there, and the
    /// velocity is above F on the other. **At a root**: by
    /// `t̂ + τ` the velocity is above F; τ is as great as this requires.
    fn released(
        &mut self,
        run: &Follower<'_, S>,
        release: &Release<S>,
        trace: &[S],
        own: f64,
    ) -> Result<[f64; 2], Open> {
        let (zero, time) = (trace[0].zero(), run.state.time().to_f64());
        let right = at_zero(trace, &zero).to_f64();
        let size = bound(trace, 0);
        let open = Open { what: Near::Release, differ: 2.0 * size };
        let slack = own + SLACK * right.abs();
        let fast = self.trace_off(run.damping(), time) + own + 8.0 * self.slope * self.latest();
        let late = match release.left {
            Some(left) => {
                // An end that has stood without a force need not have pressed.
                if left > -fast - slack && !self.silent || right < fast + slack {
                    return Err(open);
                }
                release.late
            }
            // No other ray is near.
            None => {
                let fast = self.trace_off(run.damping(), time) + own;
                (2.0 * (fast + right.abs() + slack) / release.steep).max(release.late)
            }
        };
        let most = right.abs().max(release.left.map_or(0.0, f64::abs)) + 4.0 * self.slope * late + fast;
        let late_ray = late + 64.0 * self.steps.unit;
        // One motion has contact while the other flies, for the time error: once at a ray, but maybe twice at a root.
        let times = if release.left.is_some() { 2.0 } else { 4.0 };
        self.left = times * late_ray * most + self.lifted;
        let off = [release.ray.min(self.clock + late), late];
        self.starts(release.at.clone(), time, off.map(|off| off + 64.0 * self.steps.unit), self.left);
        (self.summed, self.rising) = (0.0, true);
        Ok(off)
    }

    /// Proves a strip in flight.
    ///
    /// **Landing** at `t̂`, on a stretch `t̂ ± δ` on which `v̂_t ≤ −s`, `s > F`: `4(τ + latest) ≤ δ` with `τ = (H +
    /// |v̂(0,t̂)|)/s` and the greatest time error of the events before, and `v̂(0,·) > H` before the stretch, except at
    /// first while the end has only risen since its release (`v̂_t > F`; v is never negative, so a rising end does not
    /// touch). Then the true end touches the ground in `t̂ ± τ`, once, and not before.
    fn flown(
        &mut self,
        run: &Follower<'_, S>,
        (time, len): (f64, f64),
        cut: Option<(&S, bool)>,
        (trace, height): (&[S], &[S]),
        (own, change): (f64, Change),
    ) -> Result<(), Open> {
        let rigid = run.centre().map_or(0.0, |(_, rate)| {
            let first = 8.0 * (rate.to_f64().abs() + run.medium.gravity.to_f64());
            self.steps.rigid(len, first)
        });
        let sums = (bound(trace, 0) + bound(height, 0)) * self.steps.unit * 16.0 * (self.steps.size + 8.0);
        let own = own + rigid + sums;
        let mut late = None;
        if let Some(release) = self.release.clone() {
            late = Some((self.released(run, &release, trace, own)?, release.left.is_none()));
        }
        self.silent = false;
        // The height of this flight sums up the error of the trace.
        self.summed += own * len;
        self.trip += own * len;
        let high = self.height_off(run, time - self.since + self.latest()) + own * (1.0 + len);
        let fast = self.trace_off(run.damping(), time) + own + 8.0 * self.slope * self.latest();
        let touch = |differ: f64| Open { what: Near::Touch, differ };
        let lands = cut.is_some_and(|(_, event)| event);
        let mut rising = self.rising;
        if (rising || lands) && len <= 8.0 * self.latest() {
            return Err(touch(2.0 * bound(trace, 0)));
        }
        let (quick, low) = (doubles(trace), doubles(height));
        let (zero, one) = (trace[0].zero(), trace[0].one());
        let mut from = zero.clone();
        if let Some(([_, late], true)) = late {
            // The velocity rises at a growing rate, and is above F from τ on.
            let rate = doubles(&derivative(trace));
            let rate = Part::in_doubles(&self.doubles, &rate);
            let start = at_zero(trace, &zero).to_f64().abs() + own;
            let fast = self.trace_off(run.damping(), time) + own;
            let rises = (1..160).map(|k| (-f64::from(k)).exp2()).find(|to| {
                let (least, _) = rate.range(&zero, &zero.double(*to));
                (fast + start) * len <= late * least && to * len >= 2.0 * late
            });
            from = zero.double(rises.ok_or(Open { what: Near::Release, differ: 2.0 * bound(trace, 0) })?);
        }
        if let Some((off, _)) = late {
            self.release = None;
            self.event(off);
        }
        let [low, quick] = [&low, &quick].map(|c| Part::in_doubles(&self.doubles, c));
        let [height_on, trace_on] = [height, trace].map(|c| Part::of(&run.medium.basis, c));
        let shown = |part: (S, S), rising: &mut bool| {
            let mut again = *rising;
            part.0 >= part.1
                || clear((&low, &quick), part.clone(), (high, fast), rising)
                || clear((&height_on, &trace_on), part, (high, fast), &mut again) && {
                    *rising = again;
                    true
                }
        };
        let Some((cut, true)) = cut else {
            let to = cut.map_or(one, |(cut, _)| cut.clone() / &run.state.segments[0].len);
            if !shown((from, to), &mut rising) {
                return Err(touch(2.0 * (bound(trace, 0) + fast)));
            }
            self.note(run, time, high);
            self.rising = rising;
            return Ok(());
        };
        let at = cut.clone() / &run.state.segments[0].len;
        let found = quick.steep(&at, -1.0).or_else(|| trace_on.steep(&at, -1.0));
        let (delta, least, most) = found.ok_or_else(|| touch(2.0 * fast))?;
        let rest = evaluate(height, &at).to_f64().abs();
        let late = (high + rest) / (least * (1.0 - SLACK)) * (1.0 + SLACK);
        let shown = shown((from, at - zero.double(delta)), &mut rising);
        if least <= fast || delta * len < 4.0 * (late + self.latest()) || !shown || rising {
            return Err(touch(2.0 * (most + fast)));
        }
        self.note(run, time, high);
        let place = on_circle(run.state.segments[0].at.clone() + cut);
        // Either the clock is set, or p has the wrong sign for a while.
        let mass = 2.0 * (most + fast);
        if change.between + change.jumps < mass {
            self.set_clock(late, change);
            let rounding = 64.0 * self.steps.unit;
            self.starts(place, time, [self.clock + rounding, rounding], 0.0);
            self.landed = Some([self.clock, 0.0]);
        } else {
            self.landed = Some([self.clock + late, late]);
            self.starts(place, time, [self.clock + late, late], late * mass);
        }
        Ok(())
    }

    /// Proves a leap over `trips` round trips; `least` is a lower bound of the height of the end meanwhile.
    pub(super) fn leap(
        &mut self,
        run: &Follower<'_, S>,
        trips: f64,
        least: f64,
        count: &LeapCount,
        size: (usize, f64),
    ) {
        let time = run.state.time().to_f64();
        self.drift(run.medium, trips);
        let grown = run.damping().exp();
        // Bound of h′ of the stored vibration, and of the error of its height.
        let stray = 4.0 * grown * (grown * (self.roundoff - self.began) + self.means[0] + self.means[1]);
        let defect = self.steps.leap(count, trips, size, stray) + stray;
        self.leapt = self.leapt.max(defect);
        self.add(defect);
        self.means[1] = self.steps.weighed(&run.state, 0.0);
        let high = self.height_off(run, time - self.since + self.latest());
        if least > high && self.release.is_none() {
            self.note(run, time, high);
            self.rising = false;
        } else {
            self.end(run, run.pieces.len(), Open { what: Near::Touch, differ: 2.0 * self.most });
        }
    }
}

impl<S: RoundedSpecial> Found<S> {
    /// Returns the proved part of the result with its proved bounds; if that ends early, with the open question.
    ///
    /// **Errors**: [`Error::NotDecided`] if nothing is proved.
    pub(super) fn proved(mut self, medium: &Medium<S>, data: &Data<S>) -> Result<Self, Error> {
        let Some(proof) = self.proof.take() else { return Ok(self) };
        let (unit, damping) = (proof.steps.unit, 2.0 * medium.kappa.to_f64());
        let mut open = proof.open;
        let off = proof.known.last().map_or(0.0, |known| known.rise + known.speed);
        if open.is_none() && !ends_so(&self.ending, off, medium, data) {
            open = Some((self.pieces.len(), Open { what: Near::End, differ: 0.0 }));
        }
        if let Some((pieces, Open { what, differ })) = open {
            if pieces == 0 {
                return Err(Error::not_decided("how the motion begins", data.slope.bits()));
            }
            self.pieces.truncate(pieces);
            self.checkpoints.retain(|kept| kept.index <= pieces);
            self.ending = Ending::Unproved { what, differ: differ * data.units.velocity.to_f64() };
        }
        self.marks.truncate(proof.events.len());
        self.warnings.clear();
        (self.unresolved, self.end_error) = (None, 0.0);
        let rounding = |time: f64| 16.0 * unit * (1.0 + time);
        let latest = proof.events.iter().map(|[off, _]| *off).fold(0.0, f64::max);
        self.before = proof.known[0];
        for (k, mark) in self.marks.iter_mut().enumerate() {
            let time = mark.time.to_f64();
            let [off, late] = proof.events[k];
            mark.time_error = if time == 0.0 { 0.0 } else { off + rounding(time) };
            let (after, released) = (proof.known[k + 1], mark.kind == EventKind::Release);
            let contact = if released { proof.known[k] } else { after };
            let late = late + rounding(time);
            let (rise, speed) = (contact.rise + late * after.most, after.speed + late * after.slope);
            // h″ is at most this by the forces at both ends and the damping.
            let rate = after.rate + (4.0 + 2.0 * damping) * late * after.most;
            let momentum = rate + 2.0 * damping * rise;
            mark.at = Some(AtEvent { rise, centre: rise, speed, end: speed, rate, momentum });
            mark.after = Uncertainty { rays: latest + rounding(time), ..proof.known[k + 1] };
        }
        if let (Some([late, _]), Ending::NextImpact) = (proof.landed, &self.ending) {
            let end = self.pieces.last().map_or(0.0, |piece| piece.to().to_f64());
            self.end_error = (late + rounding(end)) * (1.0 + SLACK);
        }
        Ok(self)
    }
}

/// Returns whether the reason of an ending holds with a margin: it compares energies and bounds in doubles.
fn ends_so<S: RoundedSpecial>(ending: &Ending, off: f64, medium: &Medium<S>, data: &Data<S>) -> bool {
    let damping = 2.0 * medium.kappa.to_f64();
    match ending {
        Ending::Time | Ending::NextImpact | Ending::Undecided(_) => true,
        Ending::NoFurtherImpact(Reason::StaysAbove { swing, height, .. }) => {
            let unit = data.displacement.to_f64();
            // Displaced rays enter the root of an energy by that of mass times jump.
            let displaced = (2.0 * data.most * off).sqrt();
            height - swing > 1e-6 * (height + swing) + unit * (16.0 * off * (1.0 + 1.0 / damping) + 4.0 * displaced)
        }
        Ending::Rest(Reason::StaysPressed { part, .. }) | Ending::NoBounce(Reason::StaysPressed { part, .. }) => {
            (1.0 - part) * medium.slope.to_f64().abs() > 1e-6 * medium.slope.to_f64().abs() + 4.0 * off
        }
        _ => false,
    }
}

#[cfg(all(test, feature = "mp"))]
#[path = "tests/proof.rs"]
#[allow(clippy::unwrap_used)]
mod tests;
