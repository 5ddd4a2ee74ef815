//! The contact law and the events, from break to break.
//!
//! At the ground `v(0,·)` is the reflection at zero of `∫ q dt`: whenever the end touches, the sign of `q` just after
//! decides, `q > 0` (or `q = 0` and rising) is flight and everything else is contact. A landing with no speed that `q`
//! presses on is therefore a contact, one that `q` lifts off again is a graze and no event.
//!
//! A coincidence (a touch at a break, a line that goes on behind one) is equality: within the bound, for an estimate. It is
//! allowed to take numbers for equal that may not be, because `v` depends continuously on such a choice, and it keeps slivers
//! from multiplying. What that changes is counted in the bound of what is taken for zero.
//!
//! Ages stand in the formulas as they are stored. A break that truly lies elsewhere in its bound moves the height by its
//! jump of `v_t` times how far it is off ([`Bounded::cross_break`]), and so does the age of a release the flight after it.

use std::cmp::Ordering;

use super::limits::{Halt, Stop, Until};
use super::march::March;
use super::trace::{GroundEvent, Line, Piece, at_deviating};
use crate::motion::EventKind;
use crate::number::{Bounded, Open, sign_within};

/// What arrives at the ground between two breaks, `from … to`.
pub(super) struct Stretch<N> {
    trip: usize,
    /// The pieces of the trip before that come back.
    incoming: std::ops::Range<usize>,
    from: N,
    to: N,
    /// `q`.
    line: Line<N>,
    /// At `from`.
    q: N,
    /// At `to`.
    q_end: N,
}

/// Where a flight meets the ground in a stretch.
enum Landing<N> {
    No,
    /// At the end of the stretch, as far as the bounds tell.
    AtEnd,
    At(N),
}

impl<N: Bounded> March<N> {
    /// The sign of `x`. Where it is zero only within a bound that is wider than half of the digits of the greatest value, it
    /// is not determined: the stored value decides, which is as good as any, and so it may be with every event from here on.
    fn sign(&mut self, x: &N) -> Result<Ordering, Open> {
        let (sign, cut) = sign_within(x, self.half_digits * self.greatest_height)?;
        if cut && self.undetermined.is_none() {
            self.undetermined = Some(self.trace.trips() - 1);
        }
        Ok(sign)
    }

    /// One round trip: everything that left the ground in the one before comes back.
    pub(super) fn trip(&mut self, trip: usize, until: &Until<N>) -> Result<(), Halt<N>> {
        self.trace.begin_trip();
        let (mut next, end, fallen) = (self.trace.start_of(trip), self.trace.last_start(), self.trace.fallen(trip));
        while next < end {
            let known = (self.events.len(), self.trace.pieces().len());
            match self.next_stretch(trip, next, end, fallen.as_ref(), until) {
                Ok(after) => next = after,
                Err(Stop::Halt(halt)) => return Err(halt),
                Err(Stop::Open) => {
                    let age = self.trace.pieces()[next].age.clone();
                    let height = self.trace.pieces().get(known.1).map_or(&self.height, |piece| &piece.height);
                    let spread = self.trace.spread(height);
                    self.events.truncate(known.0);
                    self.trace.truncate(known.1);
                    return Err(Halt::Open { trip, age, spread });
                }
            }
        }
        Ok(())
    }

    /// The stretch that begins where piece `first` comes back, as far as the time asked for. Returns the piece after it.
    fn next_stretch(
        &mut self,
        trip: usize,
        first: usize,
        end: usize,
        fallen: Option<&N>,
        until: &Until<N>,
    ) -> Result<usize, Stop<N>> {
        let mut stretch = self.arriving(trip, first, end, fallen)?;
        let next = stretch.incoming.end;
        match until {
            Until::Time { trip: last, age: stop } if *last == trip => {
                if !stretch.from.below(stop)? {
                    let (age, _) = self.meet_break(&stretch, until)?;
                    self.leave(age, &stretch.line);
                    return Err(Stop::Halt(Halt::Time));
                }
                if !stop.below(&stretch.to)? {
                    self.follow(stretch, until)?;
                    return Ok(next);
                }
                let line = stretch.line.clone();
                (stretch.q_end, stretch.to) = (line.value_at_stored(stop), stop.clone());
                let rest = Stretch {
                    trip,
                    incoming: stretch.incoming.clone(),
                    from: stop.clone(),
                    to: stop.clone(),
                    q: stretch.q_end.clone(),
                    q_end: stretch.q_end.clone(),
                    line,
                };
                self.follow(stretch, until)?;
                if let (age, true) = self.meet_break(&rest, until)? {
                    self.leave(age, &rest.line);
                }
                Err(Stop::Halt(Halt::Time))
            }
            _ => {
                self.follow(stretch, until)?;
                Ok(next)
            }
        }
    }

    /// What arrives where piece `first` comes back, `fallen` lower, with all pieces after it whose line it continues.
    fn arriving(&mut self, trip: usize, first: usize, end: usize, fallen: Option<&N>) -> Result<Stretch<N>, Open> {
        let pieces = &self.trace.pieces()[..end];
        let (from, mut line) = (pieces[first].age.clone(), pieces[first].line.clone());
        let mut next = first + 1;
        while let Some(after) = pieces.get(next)
            && line.same(&after.line)
        {
            line.intercept = line.intercept.joined(&after.line.intercept);
            line.slope = line.slope.joined(&after.line.slope);
            next += 1;
        }
        let to = pieces.get(next).map_or_else(|| from.one(), |after| after.age.clone());
        let mut line = self.trace.returned(line);
        if let Some(fallen) = fallen {
            line.intercept = line.intercept - fallen;
        }
        let (q, q_end) = (line.value_at_stored(&from), line.value_at_stored(&to));
        Ok(Stretch { trip, incoming: first..next, from, to, line, q, q_end })
    }

    /// Contact and flight in one stretch, with the events between them.
    fn follow(&mut self, stretch: Stretch<N>, until: &Until<N>) -> Result<(), Stop<N>> {
        let (mut from, _) = self.meet_break(&stretch, until)?;
        let mut q = stretch.q.clone();
        loop {
            self.leave(from.clone(), &stretch.line);
            let event = if self.contact {
                self.release_in(&stretch)?.map(|age| (EventKind::Release, age))
            } else {
                self.landing_in(&from, &q, &stretch)?.map(|age| (EventKind::Impact, age))
            };
            let Some((kind, age)) = event else {
                (self.arriving_q, self.arriving_slope) = (stretch.q_end, stretch.line.slope);
                return Ok(());
            };
            let q_event = stretch.line.value_at_stored(&age);
            let velocity = match kind {
                // What is zero by the choice of its age is not known to be zero on the line that is stored.
                EventKind::Release => {
                    q = q_event.taken_for_zero();
                    q_event.zero()
                }
                EventKind::Impact => stretch.line.value_at(&age),
            };
            (self.height, self.touches) = (self.zero.clone(), true);
            self.record(kind, age.clone(), velocity, &stretch, until)?;
            from = age;
        }
    }

    /// Contact or flight behind the break at which `stretch` begins, if the end touches there. Returns at which age what
    /// leaves the ground changes, and whether there is an event.
    fn meet_break(&mut self, stretch: &Stretch<N>, until: &Until<N>) -> Result<(N, bool), Stop<N>> {
        let Stretch { from, q, line, .. } = stretch;
        let early = self.early.take();
        let sign = if self.touches { Some(self.sign(q)?) } else { None };
        let flight = match sign {
            None => !self.contact,
            Some(Ordering::Greater) => true,
            Some(Ordering::Less) => false,
            Some(Ordering::Equal) => line.slope.positive()?,
        };
        let age = from.clone();
        if flight {
            let before = if self.contact { [&self.zero, &self.zero] } else { [&self.arriving_q, &self.arriving_slope] };
            self.height.cross_break(from, before, [q, &line.slope]);
        }
        if flight != self.contact {
            return Ok((age, false));
        }
        let time = match early {
            Some(early) => from.clone().widened(&early),
            None => from.clone(),
        };
        if flight {
            let velocity = if sign.is_some_and(Ordering::is_eq) {
                q.taken_for_zero()
            } else {
                at_deviating(q, &line.slope, time.deviation().as_ref())
            };
            self.record(EventKind::Release, time, velocity, stretch, until)?;
            return Ok((age, true));
        }
        self.height = self.zero.clone();
        // A landing without speed is one because of the ray that arrives with it, whose q presses the end down.
        let velocity = if !self.arriving_q.vanishes()? {
            at_deviating(&self.arriving_q, &self.arriving_slope, time.deviation().as_ref())
        } else if !q.vanishes()? {
            at_deviating(q, &line.slope, time.deviation().as_ref())
        } else {
            q.taken_for_zero()
        };
        self.record(EventKind::Impact, time, velocity, stretch, until)?;
        Ok((age, true))
    }

    fn record(
        &mut self,
        kind: EventKind,
        age: N,
        end_velocity: N,
        stretch: &Stretch<N>,
        until: &Until<N>,
    ) -> Result<(), Stop<N>> {
        self.contact = kind == EventKind::Impact;
        if self.contact && matches!(until, Until::Contacts(most) if *most == self.contacts) {
            self.leave(age.clone(), &stretch.line);
            return Err(Stop::Halt(Halt::NextImpact { trip: stretch.trip, age }));
        }
        self.contacts += u32::from(self.contact);
        let pieces = self.trace.pieces();
        let mut incoming = stretch.incoming.start;
        while incoming + 1 < stretch.incoming.end && !age.below(&pieces[incoming + 1].age)? {
            incoming += 1;
        }
        self.events.push(GroundEvent {
            kind,
            trip: stretch.trip,
            piece: pieces.len() - self.trace.last_start(),
            incoming: incoming - self.trace.start_of(stretch.trip),
            age,
            end_velocity,
        });
        Ok(())
    }

    /// What leaves the ground from `age` on: `−q` in contact, `q` in flight.
    fn leave(&mut self, age: N, q: &Line<N>) {
        let line = if self.contact { -q.clone() } else { q.clone() };
        let of_line = line.intercept.roundoffs() + line.slope.roundoffs();
        self.greatest_height = self.greatest_height.max(self.height.to_f64());
        let relative = (of_line / self.greatest_speed).max(self.height.roundoffs() / self.greatest_height);
        // No number has more digits to lose than all.
        self.relative_error = self.relative_error.max(relative.min(self.half_digits * self.half_digits));
        self.trace.push(Piece { age, line, height: self.height.clone(), contact: self.contact });
    }

    /// The release inside a stretch of contact: the root of `q`.
    fn release_in(&mut self, Stretch { to, line, q_end, .. }: &Stretch<N>) -> Result<Option<N>, Open> {
        if !self.sign(q_end)?.is_gt() || !line.slope.positive()? {
            return Ok(None);
        }
        let age = -(line.intercept.clone() / &line.slope);
        if self.sign(&(age.clone() - to))?.is_lt() {
            return Ok(Some(age));
        }
        // At the break, as far as the bounds tell: what comes after it decides.
        self.early = q_end.root_deviation(&line.slope, &self.zero);
        Ok(None)
    }

    /// The landing inside a stretch of flight that stands at `from`. Without one, leaves the height at the end of the stretch.
    fn landing_in(&mut self, from: &N, q: &N, stretch: &Stretch<N>) -> Result<Option<N>, Stop<N>> {
        let Stretch { to, line, q_end, .. } = stretch;
        let width = to.clone().minus_stored(from);
        let end = (q.clone() + q_end).halved() * width + &self.height;
        // Where the break may be.
        let at_end = match to.deviation() {
            Some(late) => self.sign(&(late * q_end + &end))?,
            None => self.sign(&end)?,
        };
        match self.landing_before(at_end, from, q, stretch)? {
            Landing::At(age) => return Ok(Some(age)),
            Landing::No if at_end.is_gt() => (self.height, self.touches) = (end, false),
            _ => {
                (self.height, self.touches) = (end.taken_for_zero(), true);
                self.early = self.height.root_deviation(q_end, &line.slope);
            }
        }
        Ok(None)
    }

    /// The first root of `v = height + q s + slope s²/2`, which is looked for only where the signs prove that there is one.
    fn landing_before(
        &mut self,
        at_end: Ordering,
        from: &N,
        q: &N,
        Stretch { trip, to, line: Line { slope, .. }, q_end, .. }: &Stretch<N>,
    ) -> Result<Landing<N>, Stop<N>> {
        // The least height lies inside where v turns from falling to rising.
        let dips = !self.touches && slope.positive()? && q.negative()? && q_end.positive()?;
        if at_end.is_ge() && !dips {
            return Ok(Landing::No);
        }
        let disc = q.square() - (slope.clone() * &self.height).doubled();
        if at_end.is_ge() {
            match self.sign(&disc)? {
                Ordering::Less => return Ok(Landing::No),
                Ordering::Equal => {
                    if at_end.is_gt() {
                        self.grazes.push((*trip, from.clone() - q.clone() / slope));
                    }
                    return Ok(Landing::No);
                }
                Ordering::Greater => (),
            }
        }
        let Some(root) = disc.try_sqrt() else {
            let (from, q, slope) = (from.clone(), q.clone(), slope.clone());
            return Err(Stop::Halt(Halt::Irrational { trip: *trip, from, q, slope, disc }));
        };
        // Of the two forms of the root, the one that adds; where enclosures carry the exact number, the one without a
        // quotient by a root keeps it.
        let flown = if q.positive()? {
            (q.clone() + &root) / (-slope.clone())
        } else {
            let sum = root.clone() - q;
            ((self.height.clone().doubled()) / sum).or_exactly(|| -((root + q) / slope))
        };
        let age = (from.clone().nominal() + flown).with_identity();
        if self.sign(&(age.clone() - to))?.is_lt() { Ok(Landing::At(age)) } else { Ok(Landing::AtEnd) }
    }
}
