//! Contact law and events, from break to break.
//!
//! At the ground `v(0,·)` is `∫ q dt` reflected at zero. Whenever the end touches, the sign of `q` just after decides:
//! `q > 0` (or `q = 0` and rising) is flight, everything else is contact. A landing without speed is therefore a
//! contact if `q` presses the end down, and a graze without an event if `q` lifts it off again.
//!
//! Estimates that are equal within their bounds count as a coincidence: a touch at a break, a line that continues
//! behind a break. Treating such numbers as equal is allowed because `v` depends continuously on that choice, and it
//! keeps slivers from multiplying. A height that is set to zero keeps its bound. A touch at a break may truly happen a
//! little before or after the break: the time of the event carries this error, the age of the break does not, because
//! the ray alone determines it.
//!
//! Formulas use the stored ages. If the true age of a break differs from the stored one within its bound, the height
//! changes by the jump of `v_t` times that difference ([`Bounded::cross_break`]). The age of a release affects the
//! flight after it in the same way.

use std::cmp::Ordering;

use super::march::{Halt, March, Stop, Until};
use super::trace::{GroundEvent, Line, Piece, at_deviating, place_to};
use crate::motion::{Ending, EventKind};
use crate::number::{Bounded, Open};

/// The wave that arrives at the ground between two consecutive breaks, `from … to`.
#[derive(Clone)]
pub(super) struct Stretch<N> {
    /// Pieces of the previous trip that return here.
    incoming: std::ops::Range<usize>,
    from: N,
    to: N,
    /// `q`.
    line: Line<N>,
    /// `q(from)`.
    q: N,
    /// `q(to)`.
    q_end: N,
    /// `q(from)` and `q(to)` as exact multiples of gravity where these are known, see [`Piece`].
    knots: [Option<i64>; 2],
}

impl<N: Bounded> March<'_, N> {
    /// Returns the sign of `x`. If `x` is zero within its bound but that bound exceeds half of the digits of the
    /// greatest value, the sign is undetermined: the stored value decides arbitrarily, and the march records that no
    /// event from here on is determined.
    fn sign(&mut self, x: &N) -> Result<Ordering, Open> {
        let sign = x.sign()?;
        if sign.is_ne() || x.roundoffs() <= self.half_digits * self.greatest_height {
            return Ok(sign);
        }
        let trip = self.trip_number();
        self.undetermined.get_or_insert(trip);
        x.clone().nominal().sign()
    }

    /// Records that numbers equal only within their bounds were taken as equal, where the motion depends on it.
    fn coincide(&mut self) {
        let trip = self.trip_number();
        self.coincidence.get_or_insert(trip);
    }

    /// Returns the number of the current round trip, from 0.
    fn trip_number(&self) -> usize {
        self.trace.trips() - 1
    }

    /// Marches one round trip: everything that left the ground in the previous trip returns.
    pub(super) fn trip(&mut self) -> Result<(), Halt<N>> {
        let before = self.trace.trips();
        self.trace.begin_trip();
        let (mut next, end, fallen) = (self.trace.start_of(before), self.trace.last_start(), self.trace.fallen(before));
        while next < end {
            let known = (self.events.len(), self.trace.pieces().len());
            match self.next_stretch(next, end, fallen.as_ref()) {
                Ok(after) => next = after,
                Err(Stop::Halt(halt)) => return Err(halt),
                Err(Stop::Open) => {
                    let (trip, age) = (self.trip_number(), self.trace.pieces()[next].age.clone());
                    let height = self.trace.pieces().get(known.1).map_or(&self.height, |piece| &piece.height);
                    let spread = self.trace.spread(height);
                    self.events.truncate(known.0);
                    self.trace.truncate(known.1);
                    return Err(self.open(trip, &age, spread));
                }
            }
        }
        Ok(())
    }

    /// Processes the stretch that begins where piece `first` returns, or the part of it before the final time. Returns
    /// the index of the piece after the stretch.
    fn next_stretch(&mut self, first: usize, end: usize, fallen: Option<&N>) -> Result<usize, Stop<N>> {
        let mut stretch = self.arriving(first, end, fallen);
        let next = stretch.incoming.end;
        let stop = match self.until {
            Until::Time { trip, age } if *trip == self.trip_number() => age.clone(),
            _ => return self.follow(stretch).map(|()| next),
        };
        let halt = Halt { trip: self.trip_number(), age: stop.clone(), ending: Ending::Time };
        if place_to(&stop, &stretch.from)?.is_le() {
            // The piece after the final time supplies the limit from the right.
            self.meet_break(&stretch)?;
            self.leave(&stretch.from, &stretch.line, None);
        } else if place_to(&stop, &stretch.to)?.is_lt() {
            let q = stretch.line.value_at_stored(&stop);
            let rest = Stretch { from: stop.clone(), q: q.clone(), knots: [None; 2], ..stretch.clone() };
            (stretch.to, stretch.q_end, stretch.knots[1]) = (stop, q, None);
            self.follow(stretch)?;
            if self.meet_break(&rest)? {
                self.leave(&rest.from, &rest.line, None);
            }
        } else {
            return self.follow(stretch).map(|()| next);
        }
        Err(Stop::Halt(halt))
    }

    /// Builds the stretch that begins where piece `first` returns, `fallen` lower, with all pieces that continue it.
    fn arriving(&self, first: usize, end: usize, fallen: Option<&N>) -> Stretch<N> {
        let pieces = &self.trace.pieces()[..end];
        let (from, mut line) = (pieces[first].age.clone(), pieces[first].line.clone());
        let mut next = first + 1;
        while let Some(after) = pieces.get(next)
            && line.same(&after.line)
        {
            line = line.joined(&after.line);
            next += 1;
        }
        let to = pieces.get(next).map_or_else(|| from.one(), |after| after.age.clone());
        let mut line = self.trace.returned(line);
        if let Some(fallen) = fallen {
            line.intercept = line.intercept - fallen;
        }
        let (q, q_end) = (line.value_at_stored(&from), line.value_at_stored(&to));
        let trip = self.trip_number();
        let knot = |piece: usize| Some(self.trace.knot_returned(pieces.get(piece)?.knot?, trip));
        Stretch { incoming: first..next, from, to, line, q, q_end, knots: [first, next].map(knot) }
    }

    /// Processes contact and flight in one stretch, with all events inside.
    fn follow(&mut self, stretch: Stretch<N>) -> Result<(), Stop<N>> {
        let changed = self.meet_break(&stretch)?;
        self.leave(&stretch.from, &stretch.line, stretch.knots[0].filter(|knot| !changed || *knot == 0));
        let (mut from, mut q) = (stretch.from.clone(), stretch.q.clone());
        loop {
            let contact = self.contact;
            let age = if contact { self.release_in(&stretch)? } else { self.landing_in(&from, &q, &stretch)? };
            let Some(age) = age else {
                (self.arriving_q, self.arriving_slope) = (stretch.q_end, stretch.line.slope);
                return Ok(());
            };
            (self.height, self.touches) = (self.zero.clone(), true);
            if contact {
                // `q` is zero by the choice of the age; the stored line may differ from zero by its bound.
                q = stretch.line.value_at_stored(&age).taken_for_zero();
                self.record(EventKind::Release, age.clone(), q.zero(), &stretch)?;
            } else {
                self.record(EventKind::Impact, age.clone(), stretch.line.value_at(&age), &stretch)?;
            }
            // `q` vanishes at a release.
            self.leave(&age, &stretch.line, contact.then_some(0));
            from = age;
        }
    }

    /// Decides on contact or flight if the end touches at the beginning of `stretch`. Returns whether that changes.
    fn meet_break(&mut self, stretch: &Stretch<N>) -> Result<bool, Stop<N>> {
        let Stretch { from, q, line, .. } = stretch;
        let early = self.early.take();
        let sign = match stretch.knots[0] {
            _ if !self.touches => None,
            Some(knot) => Some(knot.cmp(&0)),
            None => Some(self.sign(q)?),
        };
        let equal = sign == Some(Ordering::Equal) && q.roundoffs() > 0.0 && stretch.knots[0].is_none();
        if early.is_some() || equal {
            // A release at a root and a landing with speed come out alike on both sides of a break where q is
            // continuous. The same holds for a release where the ray carries the zero of a rising q.
            let either_side = match sign {
                Some(Ordering::Equal) => self.contact && line.slope.positive()?,
                Some(Ordering::Less) => !self.contact && (q.clone() - &self.arriving_q).vanishes()?,
                _ => false,
            };
            if !either_side {
                self.coincide();
            }
        }
        let flight = match sign {
            None => !self.contact,
            Some(Ordering::Greater) => true,
            Some(Ordering::Less) => false,
            Some(Ordering::Equal) => line.slope.positive()?,
        };
        if flight {
            let before = if self.contact { [&self.zero, &self.zero] } else { [&self.arriving_q, &self.arriving_slope] };
            self.height.cross_break(from, before, [q, &line.slope]);
        }
        if flight != self.contact {
            return Ok(false);
        }
        let time = early.iter().fold(from.clone(), N::widened);
        let late = time.deviation();
        // A landing without speed is an impact only if the arriving ray brings a `q` that presses the end down.
        let velocity = if !flight && !self.arriving_q.vanishes()? {
            at_deviating(&self.arriving_q, &self.arriving_slope, late.as_ref())
        } else if sign.is_some_and(Ordering::is_ne) {
            at_deviating(q, &line.slope, late.as_ref())
        } else {
            q.taken_for_zero()
        };
        if !flight {
            self.height = self.zero.clone();
        }
        self.record(if flight { EventKind::Release } else { EventKind::Impact }, time, velocity, stretch)?;
        Ok(true)
    }

    fn record(&mut self, kind: EventKind, age: N, end_velocity: N, stretch: &Stretch<N>) -> Result<(), Stop<N>> {
        let trip = self.trip_number();
        self.contact = kind == EventKind::Impact;
        if self.contact && matches!(self.until, Until::Contacts(most) if *most == self.contacts) {
            self.leave(&age, &stretch.line, None);
            return Err(Stop::Halt(Halt { trip, age, ending: Ending::NextImpact }));
        }
        self.contacts += u32::from(self.contact);
        let pieces = self.trace.pieces();
        let mut incoming = stretch.incoming.start;
        while incoming + 1 < stretch.incoming.end && !age.below(&pieces[incoming + 1].age)? {
            incoming += 1;
        }
        let (piece, incoming) = (pieces.len() - self.trace.last_start(), incoming - self.trace.start_of(trip));
        self.events.push(GroundEvent { kind, trip, age, piece, incoming, end_velocity });
        Ok(())
    }

    /// Stores the piece that leaves from `age` on: `−q` in contact, `q` in flight; `knot` is `q` there, see [`Piece`].
    fn leave(&mut self, age: &N, q: &Line<N>, knot: Option<i64>) {
        let (line, knot) = if self.contact { (-q.clone(), knot.map(|k| -k)) } else { (q.clone(), knot) };
        let of_line = line.intercept.roundoffs() + line.slope.roundoffs();
        self.greatest_height = self.greatest_height.max(self.height.to_f64());
        let relative = f64::max(of_line / self.greatest_speed, self.height.roundoffs() / self.greatest_height);
        // The error is capped at all digits of a number.
        self.relative_error = self.relative_error.max(relative.min(self.half_digits * self.half_digits));
        self.trace.push(Piece { age: age.clone(), line, height: self.height.clone(), contact: self.contact, knot });
    }

    /// Returns the release inside a stretch of contact: the root of `q`.
    fn release_in(&mut self, Stretch { to, line, q_end, knots, .. }: &Stretch<N>) -> Result<Option<N>, Open> {
        let sign = match knots[1] {
            Some(knot) => knot.cmp(&0),
            None => self.sign(q_end)?,
        };
        if !sign.is_gt() || !line.slope.positive()? {
            return Ok(None);
        }
        let age = -(line.intercept.clone() / &line.slope);
        if self.sign(&(age.clone() - to))?.is_lt() {
            return Ok(Some(age));
        }
        // The release coincides with the break within the bounds: `meet_break` decides with the next stretch.
        self.early = q_end.root_deviation(&line.slope, &self.zero);
        Ok(None)
    }

    /// Returns the landing inside a stretch of flight from `from` on: the first root of
    /// `v = height + q s + slope s²/2`. Without a landing, sets the height to that at the end of the stretch.
    fn landing_in(&mut self, from: &N, q: &N, stretch: &Stretch<N>) -> Result<Option<N>, Stop<N>> {
        let Stretch { to, line: Line { slope, .. }, q_end, .. } = stretch;
        let width = to.clone().minus_stored(from);
        let end = (q.clone() + q_end).halved() * width + &self.height;
        // The height at the end, widened by the deviation of the break.
        let at_end = match to.deviation() {
            Some(late) => self.sign(&(late * q_end + &end))?,
            None => self.sign(&end)?,
        };
        // The least height lies inside the stretch if v turns from falling to rising there.
        let dips = !self.touches && slope.positive()? && q.negative()? && q_end.positive()?;
        let root = if at_end.is_lt() || dips { self.first_root(at_end, from, q, slope)? } else { None };
        self.touches = !at_end.is_gt();
        if let Some(age) = root {
            if self.sign(&(age.clone() - to))?.is_lt() {
                return Ok(Some(age));
            }
            // The landing coincides with the break within the bounds: `meet_break` decides with the next stretch.
            self.touches = true;
        }
        self.height = if self.touches { end.taken_for_zero() } else { end };
        if self.touches {
            self.early = self.height.root_deviation(q_end, slope);
        }
        Ok(None)
    }

    /// Returns the first root of `height + q s + slope s²/2` if the signs prove that it exists: the height is negative
    /// at the end, or it dips below zero before.
    fn first_root(&mut self, at_end: Ordering, from: &N, q: &N, slope: &N) -> Result<Option<N>, Stop<N>> {
        let disc = q.square() - (slope.clone() * &self.height).doubled();
        if at_end.is_ge() {
            let sign = self.sign(&disc)?;
            if sign.is_eq() && disc.roundoffs() > 0.0 {
                self.coincide();
            }
            if !sign.is_gt() {
                return Ok(None);
            }
        }
        let exact = disc.try_sqrt();
        let is_known = exact.is_some();
        let root = exact.unwrap_or_else(|| disc.near_sqrt());
        // Each form of the root adds terms of one sign. The form without a quotient by a root keeps the exact number
        // of enclosures.
        let flown = if q.positive()? {
            (q.clone() + &root) / (-slope.clone())
        } else {
            let sum = root.clone() - q;
            (self.height.clone().doubled() / sum).or_exactly(|| -((root + q) / slope))
        };
        if !is_known {
            let trip = self.trip_number();
            let (age, ending) = before_surd(&self.problem.units.round_trip, trip, [from, q, slope, &disc], flown)?;
            return Err(Stop::Halt(Halt { trip, age, ending }));
        }
        Ok(Some((from.clone().nominal() + flown).with_identity()))
    }
}

/// Returns a fraction just below an irrational landing, up to which the history is exact, and the ending with the surd;
/// `flown` is the width up to the landing, to 100 bits.
fn before_surd<N: Bounded>(
    unit: &N,
    trip: usize,
    [from, q, slope, disc]: [&N; 4],
    flown: N,
) -> Result<(N, Ending), Open> {
    let scale = unit.clone() / slope;
    let rational = (q.int(trip as i64) + from) * unit - scale.clone() * q;
    let time = rational.surd(slope.negative()?, &(scale.square() * disc));
    let near = ((q.int(trip as i64) + from + &flown) * unit).to_f64();
    // Prefer a short fraction if one fits between the beginning of the piece and the root.
    let ticks = ((from.to_f64() + flown.to_f64()) * PARTS_OF_A_TRIP as f64 - 1e-3).floor();
    let short = from.int(ticks as i64) / from.int(PARTS_OF_A_TRIP);
    let below = if from.below(&short)? { short } else { flown * from.double(1.0 - 1e-9) + from };
    Ok((below, Ending::ExactnessEnds { kind: EventKind::Impact, time, near }))
}

/// Number of parts of a round trip to which the end of an exact history is rounded down.
const PARTS_OF_A_TRIP: i64 = 1_000_000;
