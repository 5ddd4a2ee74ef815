//! The contact law and the events, from break to break.
//!
//! At the ground `v(0,·)` is the reflection at zero of `∫ q dt`: whenever the end touches, the sign of `q` just after
//! decides, `q > 0` (or `q = 0` and rising) is flight and everything else is contact. A landing with no speed that `q`
//! presses on is therefore a contact, one that `q` lifts off again is a graze and no event.
//!
//! In rounded numbers each decision is made against a running bound of the error that has reached it (first order in the
//! roundoff `u`, every operation counted at least once): what lies within the bound counts as a coincidence. That is
//! allowed because `v` depends continuously on such a choice, and it keeps slivers from multiplying. Where the bound
//! itself grows, as it must in a chaotic history, it says how many digits are left.

use std::cmp::Ordering;

use super::march::{Halt, Until};
use super::trace::{Occurrence, Part, Piece, Trace};
use crate::history::EventKind;
use crate::number::Scalar;

/// More round trips than this are not left out at once: their number must fit the arithmetic.
const MOST_LEAPT: usize = if usize::BITS < 64 { usize::MAX >> 2 } else { usize::MAX >> 12 };

/// What arrives at the ground on `from … to`: `q` is linear, with bounds on its error and on that of both ends.
struct Incoming<S> {
    from: S,
    to: S,
    /// At `from`.
    q: S,
    intercept: S,
    slope: S,
    /// Of the line.
    line_error: f64,
    /// Of `q` anywhere on the line as it is computed.
    q_error: f64,
    from_error: f64,
    to_error: f64,
}

pub(super) struct March<S> {
    pub(super) trace: Trace<S>,
    /// `u`.
    pub(super) unit: S,
    pub(super) occurrences: Vec<Occurrence<S>>,
    pub(super) grazes: Vec<(usize, S)>,
    pub(super) contact: bool,
    pub(super) contacts: u32,
    /// `v(0,·)` where the march stands; exactly zero while the end touches.
    pub(super) height: S,
    pub(super) height_error: f64,
    /// `q` just before the break at which the march stands.
    pub(super) arriving: S,
    /// How far the touch at this break may be off in time, in roundoffs.
    pub(super) touch_error: f64,
    pub(super) greatest_error: f64,
    pub(super) relative_error: f64,
    /// `u^{−1/2}`: half of the digits, in roundoffs.
    pub(super) half_digits: f64,
    pub(super) greatest_speed: f64,
    /// At least `greatest_speed`, which is what a round trip lifts.
    pub(super) greatest_height: f64,
}

impl<S: Scalar> March<S> {
    /// The sign of `x`, zero if it lies within `error` roundoffs of zero.
    fn sign(&self, x: &S, error: f64) -> Ordering {
        if S::RIGOROUS {
            x.partial_cmp(&x.zero()).unwrap_or(Ordering::Equal)
        } else if x.magnitude() <= self.unit.double(error.min(self.widest())) * &self.unit {
            Ordering::Equal
        } else if x.is_negative() {
            Ordering::Less
        } else {
            Ordering::Greater
        }
    }

    /// The widest coincidence in roundoffs, half of the digits of the greatest value: where the bound has grown beyond that,
    /// the history is not determined any more, and a decision by the sign alone is as good as any.
    fn widest(&self) -> f64 {
        self.half_digits * self.greatest_height
    }

    pub(super) fn negative(&self, x: &S, error: f64) -> bool {
        self.sign(x, error) == Ordering::Less
    }

    fn positive(&self, x: &S, error: f64) -> bool {
        self.sign(x, error) == Ordering::Greater
    }

    fn vanishes(&self, x: &S, error: f64) -> bool {
        self.sign(x, error) == Ordering::Equal
    }

    /// Leaves out round trips of a long flight under gravity that only repeat the one before `trip`: as many as end surely in
    /// flight. Returns how many.
    ///
    /// With `D = ∫ q dt` over that trip, `v(0,·)` at age `f` is `v + j (D − f − (j − 1)/2)` after `j` more trips, `v ≥ 0`: a
    /// concave function of `j`, positive up to `k` for every `f ≤ 1` if `D − 1 − (k − 1)/2 > 0`. One trip is kept in hand.
    pub(super) fn leap(&mut self, trip: usize, until: &Until<S>) -> usize {
        if !self.trace.falls_freely() {
            return 0;
        }
        let zero = self.height.zero();
        let mut rise = zero.clone();
        let mut size = 0.0;
        // q is off by its own error everywhere, and by its jump for as long as a break is off.
        let pieces = self.trace.slice(trip);
        let mut rise_error = pieces.iter().map(|piece| piece.value_error).fold(0.0, f64::max);
        if !S::RIGOROUS {
            for pair in pieces.windows(2) {
                let jump = pair[1].at(&pair[1].fraction) - pair[0].at(&pair[1].fraction);
                rise_error += jump.to_f64().abs() * pair[1].fraction_error;
            }
        }
        self.trace.window((trip, &zero), (trip, &zero.one()), |Part { width, value, slope, .. }| {
            let part = (slope * &width / width.int(2) + &value) * &width;
            if !S::RIGOROUS {
                size += part.to_f64().abs();
            }
            rise = rise.clone() + part;
        });
        let most = match until {
            Until::Age(last, _) => last.saturating_sub(trip),
            Until::Contacts(_) => MOST_LEAPT,
        };
        let safe =
            (rise.clone() * rise.int(2)).floor_int().and_then(|trips| usize::try_from(trips - 2).ok()).unwrap_or(0);
        let trips = safe.min(most).min(MOST_LEAPT);
        if trips < 2 {
            return 0;
        }
        let (j, two) = (rise.int(trips as i64), rise.int(2));
        // At the beginning of the next trip, j trips after that of this one: v + j (D − 1 − (j − 1)/2).
        let lift = (rise.clone() - rise.one() - (j.clone() - rise.one()) / two) * &j;
        if !S::RIGOROUS {
            let total = trips as f64;
            rise_error += 8.0 * size;
            self.height_error += total * (rise_error + 8.0 * total) + self.height.to_f64().abs();
            // The top of the flight is among what is left out: D²/2.
            self.greatest_height = self.greatest_height.max(rise.to_f64() * rise.to_f64() / 2.0);
        }
        self.height = self.height.clone() + lift;
        self.arriving = self.arriving.clone() - &j;
        self.trace.repeat(rise, rise_error, trips);
        trips
    }

    /// `√(e u)` in roundoffs: the error of the square root of a number that may be zero.
    fn root_error(&self, error: f64) -> f64 {
        error.sqrt() * self.half_digits
    }

    /// One round trip: everything that left the ground in the one before comes back.
    pub(super) fn trip(&mut self, trip: usize, until: &Until<S>) -> Option<Halt<S>> {
        self.trace.begin_trip();
        let ((mut at, fallen), end) = (self.trace.start_of(trip), self.trace.last_start());
        while at < end {
            let known = (self.occurrences.len(), self.trace.pieces().len());
            let (mut incoming, next) = self.incoming(at, end, &fallen);
            at = next;
            let open = |march: &mut Self| {
                S::take_open().then(|| {
                    march.occurrences.truncate(known.0);
                    march.trace.truncate(known.1);
                })
            };
            if let Until::Age(last, stop) = until
                && *last <= trip
            {
                // A stop within rounding of the end of its trip is a stop at the beginning of the next.
                let stop = &if *last == trip { stop.clone() } else { stop.zero() };
                let tolerance = if S::RIGOROUS { 0.0 } else { 4.0 * (trip as f64 + 1.0) + incoming.to_error };
                let past = incoming.to.clone() - stop;
                if self.positive(&past, tolerance) {
                    let rest = incoming.cut(stop);
                    if rest.from > incoming.from
                        && let Some(halt) = self.stretch(trip, &incoming, until)
                    {
                        return Some(halt);
                    }
                    self.decide(trip, &rest, until);
                    self.leave(&rest.from, &rest, rest.from_error);
                    return Some(if open(self).is_some() { Halt::Open(trip, incoming.from) } else { Halt::Time });
                }
            }
            let halt = self.stretch(trip, &incoming, until);
            if open(self).is_some() {
                return Some(Halt::Open(trip, incoming.from));
            }
            if halt.is_some() {
                return halt;
            }
        }
        None
    }

    /// What arrives where piece `at` comes back, `fallen` lower, with all pieces after it that continue it; and the piece
    /// after those.
    fn incoming(&self, at: usize, end: usize, fallen: &S) -> (Incoming<S>, usize) {
        let pieces = self.trace.pieces();
        let piece = &pieces[at];
        let mut value_error = piece.value_error;
        let mut next = at + 1;
        while let Some(after) = pieces[..end].get(next)
            && let Some(error) = self.continued(piece, value_error, after)
        {
            value_error = error;
            next += 1;
        }
        let intercept = self.trace.returned(&piece.intercept) - fallen;
        let slope = self.trace.returned_slope(&piece.slope);
        let q = slope.clone() * &piece.fraction + &intercept;
        let (line_error, q_error) = if S::RIGOROUS {
            (0.0, 0.0)
        } else {
            let size = intercept.to_f64().abs();
            let line = value_error + 2.0 * size + fallen.to_f64();
            (line, line + 2.0 * (size + slope.to_f64().abs()))
        };
        let (to, to_error) = match pieces[..end].get(next) {
            Some(after) => (after.fraction.clone(), after.fraction_error),
            None => (q.one(), 0.0),
        };
        let incoming = Incoming {
            from: piece.fraction.clone(),
            to,
            q,
            intercept,
            slope,
            line_error,
            q_error,
            from_error: piece.fraction_error,
            to_error,
        };
        (incoming, next)
    }

    /// The error of the line of `piece` on `next` as well, if no ray is left between the two: the same line on both sides.
    fn continued(&self, piece: &Piece<S>, error: f64, next: &Piece<S>) -> Option<f64> {
        if !piece.slope.same(&next.slope) {
            return None;
        }
        if S::RIGOROUS {
            return piece.intercept.same(&next.intercept).then_some(0.0);
        }
        let jump = next.intercept.clone() - &piece.intercept;
        if !self.vanishes(&jump, error + next.value_error + jump.to_f64().abs()) {
            return None;
        }
        // The true line of `next` is within its own error of the stored one, which is `jump` away.
        let apart = (jump.magnitude() / &self.unit).to_f64();
        Some(error.max(next.value_error + apart))
    }

    /// Contact or flight at the beginning of `incoming`, if the end touches there. True if this is one impact too many.
    fn decide(&mut self, trip: usize, incoming: &Incoming<S>, until: &Until<S>) -> bool {
        if !self.height.is_zero() {
            if !S::RIGOROUS {
                // The break may come earlier or later by its own error, and with it the jump of v_t.
                let jump = incoming.q.clone() - &self.arriving;
                self.height_error += jump.to_f64().abs() * incoming.from_error;
            }
            return false;
        }
        let flight = match self.sign(&incoming.q, incoming.q_error) {
            Ordering::Greater => true,
            Ordering::Less => false,
            Ordering::Equal => incoming.slope.is_positive(),
        };
        if flight != self.contact {
            return false;
        }
        let error = incoming.from_error + self.touch_error;
        if flight {
            let speed =
                if self.vanishes(&incoming.q, incoming.q_error) { incoming.q.zero() } else { incoming.q.clone() };
            self.record(EventKind::Release, trip, &incoming.from, speed, error);
            return false;
        }
        if matches!(until, Until::Contacts(most) if *most == self.contacts) {
            self.contact = true;
            return true;
        }
        // A landing without speed is one because of the ray that arrives with it, whose q presses the end down.
        let speeds = [&self.arriving, &incoming.q].map(|q| (!self.vanishes(q, incoming.q_error)).then(|| q.clone()));
        let speed = speeds.into_iter().flatten().next().unwrap_or_else(|| incoming.q.zero());
        self.record(EventKind::Impact, trip, &incoming.from, speed, error);
        false
    }

    fn record(&mut self, kind: EventKind, trip: usize, fraction: &S, end_velocity: S, error: f64) {
        self.contact = kind == EventKind::Impact;
        self.contacts += u32::from(self.contact);
        self.height_error = 0.0;
        self.occurrences.push(Occurrence { kind, trip, fraction: fraction.clone(), end_velocity, error });
    }

    /// What leaves the ground from `fraction` on: `−q` in contact, `q` in flight.
    fn leave(
        &mut self,
        fraction: &S,
        Incoming { intercept, slope, line_error, .. }: &Incoming<S>,
        fraction_error: f64,
    ) {
        let (intercept, slope, value_error) = if self.contact {
            (-intercept.clone(), -slope.clone(), *line_error)
        } else {
            (intercept.clone(), slope.clone(), *line_error)
        };
        if !S::RIGOROUS {
            self.greatest_error = self.greatest_error.max(value_error).max(self.height_error).max(fraction_error);
            self.greatest_height = self.greatest_height.max(self.height.to_f64());
            let of_height = self.height_error / self.greatest_height;
            let of_value = value_error / self.greatest_speed;
            let of_time = fraction_error / self.trace.trips().max(1) as f64;
            self.relative_error = self.relative_error.max(of_value).max(of_height).max(of_time);
        }
        self.trace.push(Piece {
            fraction: fraction.clone(),
            intercept,
            slope,
            height: self.height.clone(),
            contact: self.contact,
            value_error,
            height_error: self.height_error,
            fraction_error,
        });
    }

    /// One stretch without a break: contact and flight in it, with the events between them.
    fn stretch(&mut self, trip: usize, incoming: &Incoming<S>, until: &Until<S>) -> Option<Halt<S>> {
        let Incoming { to, slope, to_error, .. } = incoming;
        let one_too_many = self.decide(trip, incoming, until);
        let (mut from, mut q) = (incoming.from.clone(), incoming.q.clone());
        let (q_error, mut from_error) = (incoming.q_error, incoming.from_error);
        let q_end = slope.clone() * to + &incoming.intercept;
        loop {
            self.leave(&from, incoming, from_error);
            if one_too_many {
                return Some(Halt::NextImpact(trip, from));
            }
            let event = if self.contact {
                self.release_in(incoming, &q_end)
            } else {
                match self.landing_in(trip, &from, &q, q_error, incoming, &q_end) {
                    Ok(event) => event,
                    Err(halt) => return Some(halt),
                }
            };
            self.arriving = q_end.clone();
            let (kind, age, error) = event?;
            let q_event = match kind {
                EventKind::Release => q.zero(),
                EventKind::Impact => slope.clone() * &age + &incoming.intercept,
            };
            if self.vanishes(&(age.clone() - to), error + to_error) {
                // Within the error of the break: what comes after the break decides.
                self.touch_error = error;
                return None;
            }
            self.height = q.zero();
            if kind == EventKind::Impact && matches!(until, Until::Contacts(most) if *most == self.contacts) {
                self.contact = true;
                self.leave(&age, incoming, error);
                return Some(Halt::NextImpact(trip, age));
            }
            self.record(kind, trip, &age, q_event.clone(), error);
            (from, q, from_error) = (age, q_event, error);
        }
    }

    /// The release inside a stretch of contact: the root of `q`.
    fn release_in(&mut self, incoming: &Incoming<S>, q_end: &S) -> Option<(EventKind, S, f64)> {
        self.touch_error = 0.0;
        if !self.positive(q_end, incoming.q_error) || !incoming.slope.is_positive() {
            return None;
        }
        let age = -(incoming.intercept.clone() / &incoming.slope);
        let error = if S::RIGOROUS { 0.0 } else { incoming.line_error / incoming.slope.to_f64() + age.to_f64().abs() };
        Some((EventKind::Release, age, error))
    }

    /// The landing inside a stretch of flight: the first root of `v = height + q s + slope s²/2`, which is looked for only
    /// where the signs prove that there is one. Leaves the height at the end of the stretch, zero where it touches.
    fn landing_in(
        &mut self,
        trip: usize,
        from: &S,
        q: &S,
        q_error: f64,
        incoming: &Incoming<S>,
        q_end: &S,
    ) -> Result<Option<(EventKind, S, f64)>, Halt<S>> {
        let Incoming { to, slope, .. } = incoming;
        let width = to.clone() - from;
        let mean = (q.clone() + q_end) / q.int(2);
        let end = width.clone() * mean + &self.height;
        let (size, end_error) = if S::RIGOROUS {
            (0.0, 0.0)
        } else {
            let size = self.height.to_f64().abs()
                + width.to_f64() * (q.to_f64().abs() + slope.to_f64().abs() * width.to_f64());
            (size, self.height_error + width.to_f64() * q_error + 4.0 * size)
        };
        let break_error = if S::RIGOROUS { 0.0 } else { incoming.to_error * q_end.to_f64().abs() };
        let at_end = self.sign(&end, end_error + break_error);
        // The least height lies inside where v turns from falling to rising.
        let dips = slope.is_positive() && q.is_negative() && q_end.is_positive();
        let disc = q.square() - q.int(2) * slope * &self.height;
        let (disc_error, dip) = if S::RIGOROUS {
            (0.0, self.sign(&disc, 0.0))
        } else {
            let (q, slope) = (q.to_f64().abs(), slope.to_f64().abs());
            let error = 2.0 * q * q_error
                + 2.0 * slope * self.height_error
                + 4.0 * (q * q + 2.0 * slope * self.height.to_f64().abs());
            (error, self.sign(&disc, error))
        };
        let crosses = at_end == Ordering::Less || (dips && dip == Ordering::Greater && self.height.is_positive());
        if !crosses {
            if dips && dip == Ordering::Equal && at_end == Ordering::Greater && self.height.is_positive() {
                self.grazes.push((trip, from.clone() - q.clone() / slope));
            }
            self.settle(end, end_error, at_end, slope, q_end, break_error);
            return Ok(None);
        }
        let Some(root) = disc.try_sqrt() else {
            let (fraction, q, slope) = (from.clone(), q.clone(), slope.clone());
            return Err(Halt::Irrational { trip, fraction, q, slope, disc });
        };
        // Of the two forms of the root, the one that adds.
        let age = if q.is_positive() {
            (q.clone() + &root) / (-slope.clone())
        } else {
            q.int(2) * &self.height / (root.clone() - q)
        };
        let error = if S::RIGOROUS {
            0.0
        } else {
            // |√a − √b| = |a − b|/(√a + √b) where √a is well away from zero, at most √|a − b| where it is not.
            let (root, slope) = (root.to_f64(), slope.to_f64().abs());
            let value = self.height_error + age.to_f64() * q_error + 4.0 * size;
            let relative = disc_error * self.unit.to_f64() / (root * root);
            let simple = 2.0 * value / (root * (1.0 + (1.0 - relative).max(0.0).sqrt()));
            let double = self.root_error(disc_error) / slope;
            simple.min(double) + age.to_f64() + from.to_f64()
        };
        // Where enclosures carry the exact number, the form without a quotient keeps it.
        let age = if S::RIGOROUS && !slope.is_zero() { age.also(-((root.clone() + q) / slope)) } else { age };
        let landing = (from.clone() + age).named();
        if self.vanishes(&(landing.clone() - to), error + incoming.to_error) || landing > *to {
            self.settle(end, end_error, Ordering::Equal, slope, q_end, break_error);
            self.touch_error = error;
            return Ok(None);
        }
        Ok(Some((EventKind::Impact, landing, error)))
    }

    /// Leaves the height at the end of a stretch without a landing: zero where it touches.
    fn settle(&mut self, end: S, end_error: f64, at_end: Ordering, slope: &S, q_end: &S, break_error: f64) {
        self.height_error = end_error + break_error;
        if at_end != Ordering::Equal {
            (self.height, self.touch_error) = (end, 0.0);
            return;
        }
        self.height = end.zero();
        self.touch_error = if S::RIGOROUS {
            0.0
        } else {
            let (speed, slope) = (q_end.to_f64().abs(), slope.to_f64().abs());
            let simple = 2.0 * self.height_error / speed;
            simple.min(self.root_error(2.0 * self.height_error / slope))
        };
    }
}

impl<S: Scalar> Incoming<S> {
    /// Ends at `stop`; what comes after it is returned.
    fn cut(&mut self, stop: &S) -> Self {
        let stop = if *stop > self.from { stop.clone() } else { self.from.clone() };
        let from_error = if stop > self.from { 0.0 } else { self.from_error };
        let rest = Incoming {
            from: stop.clone(),
            to: self.to.clone(),
            q: self.slope.clone() * &stop + &self.intercept,
            intercept: self.intercept.clone(),
            slope: self.slope.clone(),
            line_error: self.line_error,
            q_error: self.q_error,
            from_error,
            to_error: self.to_error,
        };
        (self.to, self.to_error) = (stop, 0.0);
        rest
    }
}
