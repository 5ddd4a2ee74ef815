//! Answers to questions about an undamped history, in the units of the scene.

use std::rc::Rc;

use super::history::{Centre, Moment, Trip, Undamped};
use super::parts::{self, Parted};
use super::start::Units;
use super::trace::{GroundEvent, Line, Part, Piece, Place};
use crate::error::Error;
use crate::motion::moments::{self, Moments};
use crate::motion::{
    Contact, Course, Event, EventKind, Field, Motion, Pair, Ray, Scales, Side, StressPiece, Stretch, WavePiece, Waves,
    by_time,
};
use crate::number::{Bounded, Open};
use crate::problem::Top;

/// Maximum number of pieces of [`Waves`]: a longer function is of no use in another program.
const MOST_PIECES: usize = 1_000_000;

impl<N: Bounded> Motion<N> for Undamped<N> {
    fn course(&self) -> &Course<N> {
        &self.course
    }

    fn stress_pieces(&self) -> Vec<StressPiece<N>> {
        let mut out: Vec<StressPiece<N>> = Vec::new();
        let mut last: Option<(&Piece<N>, usize)> = None;
        for (trip, pieces) in self.ground.trace.stored() {
            for piece in pieces {
                let here = Moment { index: trip + 1, age: piece.age.clone() };
                match last {
                    Some((from, begun)) if continues(from, begun, piece, trip) => continue,
                    Some((from, begun)) => out.extend(self.stress_piece(from, begun, &here)),
                    None => (),
                }
                last = Some((piece, trip));
            }
        }
        out.extend(last.and_then(|(from, begun)| self.stress_piece(from, begun, &self.end)));
        out
    }

    fn strain(&self, time: &N, side: Side) -> Result<N, Error> {
        let place = self.place(&self.locate(time)?, side)?;
        let piece = self.ground.trace.piece(&place);
        if place.index == 0 {
            return Ok(self.problem.data.at(&time.zero())?.strain);
        }
        if !piece.contact {
            return Ok(time.zero());
        }
        let p = piece.line.value_at(&place.age);
        Ok(-(p * &self.problem.units.velocity / &self.problem.units.wave_speed))
    }

    fn pair(&self, pair: Pair, time: &N, side: Side) -> Result<[N; 2], Error> {
        let Units { round_trip, velocity, length, .. } = &self.problem.units;
        let moment = self.locate(time)?;
        if pair == Pair::GroundEnd {
            let place = self.place(&moment, side)?;
            let piece = self.ground.trace.piece(&place);
            let rate = if place.index == 0 {
                self.problem.ground_velocity.clone()
            } else if piece.contact {
                time.zero()
            } else {
                piece.line.value_at(&place.age)
            };
            let height = self.height_at(&self.place(&moment, Side::Left)?);
            return Ok([height * velocity * round_trip, rate * velocity]);
        }
        let (trip, unit) = (self.last_trip(&moment, time)?, velocity.square() * length);
        if pair == Pair::EnergyParts {
            // The breaks of `v_t = (p + q)/2` and `c v_x = (q − p)/2` are the breaks of both invariants.
            return Ok(self.squares(&trip)?.map(|part| part * &unit));
        }
        let Centre { height, rate } = self.centre_at(&trip)?;
        if pair == Pair::Centre {
            return Ok([height * velocity * round_trip, rate * velocity]);
        }
        // `E_z = ½ ∫ (w − h′)² ds` with `w` of [`Undamped::visit_rod`], times `L`.
        let (gravity, mut sum) = (&self.problem.gravity, rate.zero());
        self.visit_rod(&trip, &mut |part| {
            let value = part.value - gravity.clone() * (rate.one() - &part.offset) - &rate;
            let vibration = Part { value, slope: part.slope + gravity, ..part };
            sum = sum.clone() + vibration.square_integral();
        })?;
        Ok([(rate.square().halved() + gravity.clone() * &height) * &unit, sum.halved() * &unit])
    }

    fn field(&self, point: &N, time: &N, side: Side) -> Result<Field<N>, Error> {
        let units = &self.problem.units;
        self.check(point)?;
        if side == Side::Left && time.vanishes()? {
            return Ok(self.problem.data.at(point)?);
        }
        let moment = self.locate(time)?;
        let height = point.clone().halved() / &units.length;
        let lift = self.problem.gravity.clone() * &height;
        let (below, above) = (self.shifted(&moment, &-height.clone())?, self.shifted(&moment, &height)?);
        let p = self.p_at(&below, side)? - &lift;
        let p_before = self.p_at(&Moment { index: above.index - 1, ..above }, side)?;
        // The recursion holds for values as well as for lines.
        let zero = height.zero();
        let q = self.ground.trace.returned(Line { intercept: p_before, slope: zero }).intercept + &lift;
        let v = self.height_at(&self.place(&moment, Side::Left)?) + self.stretched(&moment, &height)?;
        Ok(Field {
            displacement: v * &units.velocity * &units.round_trip,
            velocity: (p.clone() + &q).halved() * &units.velocity,
            strain: (q - p).halved() * &units.velocity / &units.wave_speed,
        })
    }

    /// Evaluates the stretches of each time, on which velocity and strain are linear.
    fn rates(&self, places: &[(N, N)]) -> Result<Vec<[N; 2]>, Error> {
        let stretches = by_time(places, |time| self.stretches(time).map(Rc::new))?;
        let rates = |((point, _), stretches): (&(N, N), Rc<Vec<Stretch<N>>>)| {
            self.check(point)?;
            // A point that rounding does not tell from the edge of two stretches belongs to the lower stretch.
            let after = stretches[1..].partition_point(|stretch| stretch.from.below(point) == Ok(true));
            let Stretch { from, velocity, strain, .. } = &stretches[after];
            let at = |[value, slope]: &[N; 2]| slope.clone() * &(point.clone() - from) + value;
            Ok([at(velocity), at(strain)])
        };
        places.iter().zip(stretches).map(rates).collect()
    }

    fn highest(&self, release: usize) -> Option<(N, N)> {
        let Units { round_trip, velocity, .. } = &self.problem.units;
        let release = self.course.events.get(release)?;
        let rate = &release.h_rate;
        if !self.ground.trace.falls_freely() || rate.negative() == Ok(true) {
            return None;
        }
        let gravity = velocity.clone() / round_trip;
        let rise = rate.square() / &gravity;
        Some((release.t.clone() + rate.clone() / &gravity, release.h.clone() + rise.halved()))
    }

    fn rays(&self, trip: usize) -> Result<Vec<Ray<N>>, Error> {
        let trace = &self.ground.trace;
        if trip >= trace.trips() {
            return Ok(Vec::new());
        }
        let units = &self.problem.units;
        let mut rays = Vec::new();
        for piece in 0..trace.slice(trip + 1).len() {
            let mut here = Place { index: trip + 1, piece, age: units.length.zero() };
            let after = trace.piece(&here);
            here.age = after.age;
            let left = trace.place_before(here.index, piece, &here.age);
            let before = trace.piece(&left);
            let jump = after.line.value_at(&here.age) - before.line.value_at(&left.age);
            let kink = after.line.slope - &before.line.slope;
            if jump.vanishes() == Ok(true) && kink.vanishes() == Ok(true) {
                continue;
            }
            let half = (jump * &units.velocity).halved();
            let strain = half.clone() / &units.wave_speed;
            let from = (here.age.int(trip as i64) + &here.age) * &units.round_trip;
            let up = [-strain.clone(), half.clone()];
            let down = match self.problem.top {
                Top::Free => [strain, half],
                Top::Fixed => [-strain, -half],
            };
            let kink = (kink * &units.velocity / &units.round_trip).halved();
            rays.push(Ray { to: from.clone() + &units.round_trip, from, up, down, kink });
        }
        Ok(rays)
    }

    fn corners(&self) -> Vec<N> {
        self.problem.data.corners.clone()
    }

    fn stretches(&self, time: &N) -> Result<Vec<Stretch<N>>, Error> {
        Ok(self.stretches_and_shifts(time)?.0)
    }

    fn moments(&self, time: &N, points: &[N]) -> Result<Vec<Moments<N>>, Error> {
        let (stretches, shifts) = self.stretches_and_shifts(time)?;
        let mut cells = moments::of_stretches(&stretches, points)?;
        parts::widened(&mut cells, &shifts, points);
        Ok(cells)
    }

    /// Compares the pieces at the ground now and half a round trip ago, when the ray now at the top left it.
    fn may_jump(&self, time: &N) -> Result<bool, Error> {
        let now = self.locate(time)?;
        let before = self.shifted(&now, &-now.age.one().halved())?;
        for moment in [now, before] {
            let [left, right] = [self.place(&moment, Side::Left)?, self.place(&moment, Side::Right)?];
            if (left.index, left.piece) != (right.index, right.piece) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Builds the pieces of `P` and the polynomial from the ground trace `p`: `v_t − c v_x = p(t − x/c) − g x/c`, and
    /// `v_t + c v_x = ±p(t + x/c − t₁) + g x/c`, less `g t₁` under a free top. Each `P′` subtracts half of that `g t₁`.
    fn waves(&self) -> Result<Waves<N>, Error> {
        let Units { round_trip, velocity, wave_speed, length } = &self.problem.units;
        let trace = &self.ground.trace;
        if trace.begin() > 1 {
            let start = (round_trip.int(trace.begin() as i64 - 1) * round_trip).text();
            return Err(Error::TimeForgotten { found: "0".into(), start });
        }
        let pull = match self.problem.top {
            Top::Free => self.problem.gravity.clone().halved(),
            Top::Fixed => velocity.zero(),
        };
        let mut pieces: Vec<WavePiece<N>> = Vec::new();
        for index in 0..=trace.trips() {
            for piece in 0..trace.slice(index).len() {
                let here = trace.piece(&Place { index, piece, age: velocity.zero() });
                let from = (here.age.int(index as i64 - 1) + &here.age) * round_trip;
                let rate = (here.line.value_at(&here.age) - &pull) * velocity;
                let slope = here.line.slope * velocity / round_trip;
                let sum = match pieces.last() {
                    None => velocity.zero(),
                    Some(last) => {
                        let (before, arrived) = last.at(&from);
                        if last.slope.same(&slope) && arrived.same(&rate) {
                            continue;
                        }
                        before
                    }
                };
                pieces.push(WavePiece { from, sum, rate, slope });
            }
            if pieces.len() > MOST_PIECES {
                let time = round_trip.to_f64() * index as f64;
                return Err(Error::TooManyPieces { limit: MOST_PIECES, time });
            }
        }
        // `g` in the units of the scene; the lattice gravity is 1 or 0.
        let curvature = self.problem.gravity.clone() * velocity / round_trip / wave_speed.square();
        let start = self.problem.ground_start.clone() * velocity * round_trip;
        let zero = velocity.zero();
        let mut waves = Waves {
            linear: match self.problem.top {
                Top::Free => -(curvature.clone() * length),
                Top::Fixed => zero.clone(),
            },
            quadratic: curvature.halved(),
            constant: zero.clone(),
            top: self.problem.top,
            round_trip: round_trip.clone(),
            wave_speed: wave_speed.clone(),
            length: length.clone(),
            pieces,
        };
        waves.constant = start - waves.at(&zero, &zero).displacement;
        Ok(waves)
    }

    fn scales(&self) -> Scales<N> {
        let Units { round_trip, velocity, length, wave_speed } = self.problem.units.clone();
        let velocity = velocity.double(self.problem.greatest_speed()) * velocity;
        let gravity = self.problem.units.velocity.clone() / &round_trip * &self.problem.gravity;
        Scales { time: round_trip, velocity, length, wave_speed, gravity }
    }

    fn error_estimate(&self) -> N {
        let unit = self.problem.gravity.roundoff();
        unit.double(self.ground.relative_error) * unit
    }

    fn digits_lost(&self) -> Option<(u32, f64)> {
        let lost = self.ground.relative_error;
        (lost > 0.0).then(|| (self.ground.contacts, lost.max(1.0).log10()))
    }
}

impl<N: Bounded> Undamped<N> {
    fn stretches_and_shifts(&self, time: &N) -> Result<Parted<N>, Error> {
        let moment = self.locate(time)?;
        let Units { round_trip, velocity, .. } = &self.problem.units;
        let height = self.height_at(&self.place(&moment, Side::Left)?) * velocity * round_trip;
        Ok(self.stretches_at(&self.last_trip(&moment, time)?, height)?)
    }

    pub(super) fn in_scene_units(&self) -> Result<Vec<Event<N>>, Error> {
        let Units { round_trip, velocity, .. } = &self.problem.units;
        let rise = velocity.clone() * round_trip;
        let mut events: Vec<Event<N>> = Vec::with_capacity(self.ground.events.len());
        let mut last: Option<(&GroundEvent<N>, Centre<N>)> = None;
        for event in &self.ground.events {
            let centre = match last {
                Some((before, centre)) if before.trip == event.trip && self.problem.top == Top::Free => {
                    self.centre_later(before, centre, event)
                }
                _ => self.centre_at_event(event)?,
            };
            let time = self.time_of(&Moment { index: event.trip + 1, age: event.age.clone() });
            events.push(Event {
                kind: event.kind,
                t_error: time.log2_error().exp2(),
                t: time,
                v_end: event.end_velocity.clone() * velocity,
                h: centre.height.clone() * &rise,
                h_rate: centre.rate.clone() * velocity,
            });
            last = Some((event, centre));
        }
        Ok(events)
    }

    /// Returns the place of an event as the limit from the right and from the left.
    fn places(&self, event: &GroundEvent<N>) -> [Place<N>; 2] {
        let (index, piece, age) = (event.trip + 1, event.piece, event.age.clone());
        let before = self.ground.trace.place_before(index, piece, &age);
        [Place { index, piece, age }, before]
    }

    fn centre_at_event(&self, event: &GroundEvent<N>) -> Result<Centre<N>, Open> {
        let a_trip_before = Place { index: event.trip, piece: event.incoming, age: event.age.clone() };
        let [_, until] = self.places(event);
        self.centre_at(&Trip { ends: [a_trip_before, until], at_event: true })
    }

    /// Computes the centre at the next event of the same round trip: under a free top `h″ = −(c²/L) v_x(0,t) − g`. The
    /// sum starts anew in every round trip, so it visits each piece once and adds the roundings of one trip only.
    fn centre_later(&self, before: &GroundEvent<N>, centre: Centre<N>, event: &GroundEvent<N>) -> Centre<N> {
        let width = event.age.clone() - &before.age;
        let fall = self.problem.gravity.clone() * &width;
        let (mut push, mut lift) = (width.zero(), width.zero());
        if before.kind == EventKind::Impact {
            let ([from, _], [_, until]) = (self.places(before), self.places(event));
            self.ground.trace.window(&from, &until, &mut |part| {
                let first = part.integral();
                lift = lift.clone() + (width.clone() - &part.offset) * &first - part.moment();
                push = push.clone() + first;
            });
        }
        let height = centre.height + (centre.rate.clone() - fall.clone().halved()) * &width + lift.doubled();
        Centre { height, rate: centre.rate + push.doubled() - fall }
    }

    pub(super) fn summed_contacts(&self) -> Vec<Contact<N>> {
        let Units { length, velocity, wave_speed, .. } = &self.problem.units;
        Contact::between(&self.course.events, |k| {
            let [from, _] = self.places(&self.ground.events[k]);
            let until = match self.ground.events.get(k + 1) {
                Some(release) => self.places(release)[1].clone(),
                None => {
                    let Moment { index, age } = self.end.clone();
                    Place { index, piece: self.ground.trace.slice(index).len() - 1, age }
                }
            };
            let (mut sum, mut peak) = (from.age.zero(), from.age.zero());
            self.ground.trace.window(&from, &until, &mut |part| {
                sum = sum.clone() + part.integral();
                peak = part.ends().into_iter().fold(peak.clone(), N::larger);
            });
            (sum.doubled() * length * velocity, -(peak * velocity / wave_speed))
        })
    }

    fn check(&self, point: &N) -> Result<(), Error> {
        let length = &self.problem.units.length;
        let outside = point.negative()? || length.below(point)? || !point.is_finite();
        if outside { Err(Error::PointOutside { found: point.text(), length: length.text() }) } else { Ok(()) }
    }

    /// Returns the stress from the beginning of a piece of `trip` to a moment; `None` if it is empty within the bounds.
    fn stress_piece(&self, from: &Piece<N>, trip: usize, to: &Moment<N>) -> Option<StressPiece<N>> {
        let Units { wave_speed, velocity, .. } = &self.problem.units;
        let end = to.age.int(to.index as i64 - 1 - trip as i64) + &to.age;
        if (end.clone() - &from.age).positive() == Ok(false) {
            return None;
        }
        let scale = velocity.clone() / wave_speed;
        let stress = |age: &N| if from.contact { -(from.line.value_at(age) * &scale) } else { age.zero() };
        Some(StressPiece {
            start: self.time_of(&Moment { index: trip + 1, age: from.age.clone() }),
            end: self.time_of(to),
            strain_start: stress(&from.age),
            strain_end: stress(&end),
            chebyshev: Vec::new(),
        })
    }
}

/// Returns whether `piece` of `trip` continues `from` of trip `begun`: the same line in contact, or flight in both.
fn continues<N: Bounded>(from: &Piece<N>, begun: usize, piece: &Piece<N>, trip: usize) -> bool {
    if !from.contact || !piece.contact {
        return from.contact == piece.contact;
    }
    let Line { intercept, slope } = from.line.clone();
    let trips = slope.int(trip as i64 - begun as i64);
    from.line.slope.same(&piece.line.slope) && Line { intercept: trips * &slope + &intercept, slope }.same(&piece.line)
}
