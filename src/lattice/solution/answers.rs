//! What is answered of an undamped history.

use super::super::scaled::Units;
use super::super::trace::Piece;
use super::{Moment, Undamped};
use crate::error::Error;
use crate::history::{Contact, Ending, Energy, Event, Field, History, Scales, Side, StressPiece};
use crate::number::Scalar;
use crate::rod::Top;

impl<S: Scalar> History<S> for Undamped<S> {
    fn end(&self) -> S {
        self.time_of(&self.end)
    }

    fn ending(&self) -> &Ending {
        &self.ending
    }

    fn events(&self) -> &[Event<S>] {
        self.events.get_or_init(|| self.tell_events())
    }

    fn contacts(&self) -> &[Contact<S>] {
        self.contacts.get_or_init(|| self.tell_contacts())
    }

    fn stress_pieces(&self) -> Vec<StressPiece<S>> {
        let Units { wave_speed, velocity, .. } = &self.problem.units;
        let scale = velocity.clone() / wave_speed;
        let mut out: Vec<StressPiece<S>> = Vec::new();
        let mut last: Option<(&Piece<S>, usize)> = None;
        let mut close = |from: &Piece<S>, trip: usize, to: &Moment<S>| {
            let stress = |age: S| {
                if !from.contact {
                    return age.zero();
                }
                -(from.at(&(age + &from.fraction)) * &scale)
            };
            let width = to.fraction.int(to.index as i64 - 1 - trip as i64) + &to.fraction - &from.fraction;
            if width.is_positive() {
                let begin = Moment { index: trip + 1, fraction: from.fraction.clone() };
                out.push(StressPiece {
                    from: self.time_of(&begin),
                    to: self.time_of(to),
                    left: stress(width.zero()),
                    right: stress(width),
                    chebyshev: Vec::new(),
                });
            }
        };
        for (trip, pieces) in self.marched.trace.stored() {
            for piece in pieces {
                let here = Moment { index: trip + 1, fraction: piece.fraction.clone() };
                match last {
                    Some((from, begun)) if self.continues(from, begun, piece, trip) => continue,
                    Some((from, begun)) => close(from, begun, &here),
                    None => (),
                }
                last = Some((piece, trip));
            }
        }
        if let Some((from, begun)) = last {
            close(from, begun, &self.end);
        }
        out
    }

    fn stress(&self, time: &S, side: Side) -> Result<S, Error> {
        let moment = self.locate(time)?;
        let (found, piece) = self.piece_at(&moment, side);
        // Before the start nothing is stressed at the ground.
        if found == 0 || !piece.contact {
            return Ok(time.zero());
        }
        let p = self.marched.trace.value(moment.index, &moment.fraction, side == Side::Left);
        Ok(-(p * &self.problem.units.velocity / &self.problem.units.wave_speed))
    }

    fn ground_end(&self, time: &S, side: Side) -> Result<(S, S), Error> {
        let moment = self.locate(time)?;
        let Units { round_trip, velocity, .. } = &self.problem.units;
        let (found, piece) = self.piece_at(&moment, side);
        let rate = if found == 0 {
            self.problem.ground_velocity.clone()
        } else if piece.contact {
            time.zero()
        } else {
            self.marched.trace.value(moment.index, &moment.fraction, side == Side::Left)
        };
        Ok((self.height_at(&moment) * velocity * round_trip, rate * velocity))
    }

    fn top_end(&self, time: &S, side: Side) -> Result<(S, S), Error> {
        let top = self.field_at(&self.locate(time)?, &self.problem.units.length, side);
        Ok((top.displacement, top.velocity))
    }

    fn centre(&self, time: &S) -> Result<(S, S), Error> {
        let (h, rate) = self.centre_at(&self.locate(time)?);
        let Units { round_trip, velocity, .. } = &self.problem.units;
        Ok((h * velocity * round_trip, rate * velocity))
    }

    fn energy(&self, time: &S) -> Result<Energy<S>, Error> {
        let moment = self.locate(time)?;
        let Units { velocity, length, .. } = &self.problem.units;
        let gravity = &self.problem.gravity;
        let (h, rate) = self.centre_at(&moment);
        let half = h.ratio(1, 2);
        let (mut up, mut down) = (h.zero(), h.zero());
        // ∫ (a + m s)² ds over a part, as a sum of squares about its middle.
        let square = |w: &S, a: S, m: &S| {
            let rise = m.clone() * w;
            let middle = a + rise.clone() / w.int(2);
            (middle.square() + rise.square() / w.int(12)) * w
        };
        self.window(
            &moment,
            &half,
            |[offset, w, a, m]| {
                let lift = gravity.clone() * (half.clone() - &offset);
                up = up.clone() + square(&w, a - lift - &rate, &(m + gravity));
            },
            |[offset, w, a, m]| {
                let lift = gravity.clone() * &offset;
                down = down.clone() + square(&w, a + lift - &rate, &(m + gravity));
            },
        );
        let unit = velocity.square() * length;
        let vibrational = (up + down) / h.int(2) * &unit;
        let translational = (rate.square() / h.int(2) + gravity.clone() * &h) * &unit;
        Ok(Energy { total: translational.clone() + &vibrational, translational, vibrational })
    }

    fn field(&self, point: &S, time: &S, side: Side) -> Result<Field<S>, Error> {
        let length = &self.problem.units.length;
        if point.is_negative() || point > length || !point.is_finite() {
            return Err(Error::PointOutside { found: point.text(), length: length.text() });
        }
        Ok(self.field_at(&self.locate(time)?, point, side))
    }

    fn highest(&self, release: &Event<S>) -> Option<(S, S)> {
        let Units { round_trip, velocity, .. } = &self.problem.units;
        if self.problem.gravity.is_zero() || self.problem.top == Top::Fixed || release.centre_velocity.is_negative() {
            return None;
        }
        let gravity = velocity.clone() / round_trip;
        let rate = &release.centre_velocity;
        let rise = rate.square() / &gravity / rate.int(2);
        Some((release.time.clone() + rate.clone() / &gravity, release.centre.clone() + rise))
    }

    fn scales(&self) -> Scales<S> {
        let Units { round_trip, velocity, length, wave_speed } = self.problem.units.clone();
        let velocity = velocity.double(self.problem.greatest_speed()) * velocity;
        let gravity = self.problem.units.velocity.clone() / &self.problem.units.round_trip * &self.problem.gravity;
        Scales { time: round_trip, velocity, length, wave_speed, gravity }
    }

    fn error_estimate(&self) -> S {
        let zero = self.problem.gravity.zero();
        if S::RIGOROUS { zero } else { zero.double(self.marched.relative_error) * zero.roundoff() }
    }

    fn digits_lost(&self) -> Option<(u32, f64)> {
        (!S::RIGOROUS).then(|| (self.marched.contacts, self.marched.greatest_error.max(1.0).log10()))
    }

    fn warnings(&self) -> &[String] {
        &self.warnings
    }
}

impl<S: Scalar> Undamped<S> {
    /// Whether `piece` of `trip` continues `from` of trip `begun`: the same line (or flight in both).
    fn continues(&self, from: &Piece<S>, begun: usize, piece: &Piece<S>, trip: usize) -> bool {
        if from.contact != piece.contact {
            return false;
        }
        if !piece.contact {
            return true;
        }
        if !from.slope.same(&piece.slope) {
            return false;
        }
        let later = from.slope.int(trip as i64 - begun as i64) * &from.slope + &from.intercept;
        if S::RIGOROUS {
            return later.same(&piece.intercept);
        }
        let rounding = 4.0 * (later.to_f64().abs() + piece.intercept.to_f64().abs());
        let jump = later - &piece.intercept;
        let error = from.value_error + piece.value_error + rounding;
        jump.magnitude() <= jump.roundoff() * jump.double(error)
    }
}
