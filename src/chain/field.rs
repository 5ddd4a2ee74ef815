//! The field along a body of a chain, and the sums over it.

use super::run::ChainRun;
use super::start::Bar;
use super::wave::{Piece, Wave, is_exact_zero, order};
use crate::error::Error;
use crate::motion::{Field, Side, Stretch};
use crate::number::{Bounded, Open};

/// Energies, centre and momentum of a body.
#[derive(Clone, Debug)]
pub struct BodySums<N> {
    /// Mean displacement: that of the centre of mass.
    pub displacement: N,
    /// Mean velocity.
    pub velocity: N,
    /// Kinetic energy.
    pub kinetic: N,
    /// Strain energy.
    pub strain: N,
    /// Energy of height: weight times mean displacement.
    pub potential: N,
}

impl<N> BodySums<N> {
    /// Converts the sums to other numbers.
    pub fn map<T>(self, f: impl Fn(N) -> T) -> BodySums<T> {
        BodySums {
            displacement: f(self.displacement),
            velocity: f(self.velocity),
            kinetic: f(self.kinetic),
            strain: f(self.strain),
            potential: f(self.potential),
        }
    }
}

impl<N: Bounded> ChainRun<N> {
    /// Returns displacement, velocity and strain of a body at its point `x`; on a ray, the limit in time from `side`.
    ///
    /// **Errors**: [`Error::TimeOutside`], [`Error::PointOutside`]; [`Error::Open`] if the point is not told from a ray.
    pub fn field(&self, body: usize, point: &N, time: &N, side: Side) -> Result<Field<N>, Error> {
        self.check_time(time)?;
        let Bar { length, wave_speed, .. } = &self.bars[body];
        if point.negative()? || length.below(point)? {
            return Err(Error::PointOutside { found: point.text(), length: length.text() });
        }
        let [up, down] = &self.waves[body];
        let above = length.clone() - point;
        let rising = wave_at(up, time.clone() - point.clone() / wave_speed, side)?;
        let falling = wave_at(down, time.clone() - above / wave_speed, side)?;
        let fall = self.gravity.clone() * time;
        Ok(Field {
            displacement: (rising.1 + &falling.1 - fall.clone() * time).halved(),
            velocity: (rising.0.clone() + &falling.0).halved() - fall,
            strain: (falling.0 - rising.0).halved() / wave_speed,
        })
    }

    /// Returns displacement, velocity and strain of the bottom or the top of a body, as [`ChainRun::field`] does.
    pub fn end_field(&self, body: usize, is_top: bool, time: &N, side: Side) -> Result<Field<N>, Error> {
        let length = &self.bars[body].length;
        self.field(body, &if is_top { length.clone() } else { length.zero() }, time, side)
    }

    /// Returns the tensile axial force of a body at its point `x`, as [`ChainRun::field`] does.
    pub fn axial_force(&self, body: usize, point: &N, time: &N, side: Side) -> Result<N, Error> {
        let Bar { wave_speed, impedance, .. } = &self.bars[body];
        Ok(self.field(body, point, time, side)?.strain * wave_speed * impedance)
    }

    /// Returns the body between its rays, from the bottom up.
    ///
    /// **Errors**: [`Error::TimeOutside`]; [`Error::Open`] if the order of two rays is not decided.
    pub fn stretches(&self, body: usize, time: &N) -> Result<Vec<Stretch<N>>, Error> {
        self.check_time(time)?;
        let Bar { length, wave_speed, travel, .. } = &self.bars[body];
        let [up, down] = &self.waves[body];
        let earliest = time.clone() - travel;
        // Upward pieces in the order of x: the last to leave is the lowest.
        let rising = window(up, &earliest, time)?;
        let falling = window(down, &earliest, time)?;
        let place = |from: &N| (time.clone() - from) * wave_speed;
        let mut rising = rising.iter().rev().map(|piece| (place(&piece.from), &piece.line)).peekable();
        let tops = falling.iter().skip(1).map(|piece| length.clone() - place(&piece.from)).map(Some).chain([None]);
        let mut falling = falling.iter().map(|piece| &piece.line).zip(tops).peekable();
        let mut from = length.zero();
        let mut displacement = self.end_field(body, false, time, Side::Left)?.displacement;
        let fall = self.gravity.clone() * time;
        let mut stretches = Vec::new();
        while let (Some((rise_end, p)), Some((q, fall_end))) = (rising.peek(), falling.peek()) {
            let is_last_rise = order(rise_end, length)?.is_ge();
            let first = match fall_end {
                None if is_last_rise => std::cmp::Ordering::Equal,
                None => std::cmp::Ordering::Less,
                Some(_) if is_last_rise => std::cmp::Ordering::Greater,
                Some(end) => order(rise_end, end)?,
            };
            let to = match (first, fall_end) {
                (std::cmp::Ordering::Equal, None) => length.clone(),
                (std::cmp::Ordering::Greater, Some(end)) => end.clone(),
                _ => rise_end.clone(),
            };
            let width = to.clone() - &from;
            if !is_exact_zero(&width) {
                let above = length.clone() - &from;
                let (a, b) = (
                    p.value_at(&(time.clone() - from.clone() / wave_speed)),
                    q.value_at(&(time.clone() - above / wave_speed)),
                );
                // Along x the argument of p falls and that of q rises.
                let (rate_up, rate_down) = (p.slope.clone() / wave_speed, q.slope.clone() / wave_speed);
                let velocity = [(a.clone() + &b).halved() - &fall, (rate_down.clone() - &rate_up).halved()];
                let strain = [(b - a).halved() / wave_speed, (rate_down + rate_up).halved() / wave_speed];
                let stretch =
                    Stretch { from: from.clone(), width, displacement: displacement.clone(), velocity, strain };
                displacement = stretch.displacement_after(&stretch.width);
                stretches.push(stretch);
            }
            from = to;
            if first.is_le() {
                rising.next();
            }
            if first.is_ge() {
                falling.next();
            }
        }
        Ok(stretches)
    }

    /// Returns energies, centre and momentum of a body.
    ///
    /// **Errors**: those of [`ChainRun::stretches`].
    pub fn sums(&self, body: usize, time: &N) -> Result<BodySums<N>, Error> {
        let Bar { length, wave_speed, impedance, .. } = &self.bars[body];
        let zero = length.zero();
        let mut sums = [zero.clone(), zero.clone(), zero.clone(), zero];
        for stretch in self.stretches(body, time)? {
            let [displacement, velocity, _] = stretch.moments(&stretch.width);
            let added = [
                displacement[0].clone(),
                velocity[0].clone(),
                square(&stretch, &stretch.velocity),
                square(&stretch, &stretch.strain),
            ];
            for (sum, added) in sums.iter_mut().zip(added) {
                *sum = sum.clone() + added;
            }
        }
        let density = impedance.clone() / wave_speed;
        let [displacement, velocity, kinetic, strain] = sums;
        Ok(BodySums {
            kinetic: (kinetic * &density).halved(),
            strain: (strain * wave_speed * impedance).halved(),
            potential: displacement.clone() * &density * &self.gravity,
            displacement: displacement / length,
            velocity: velocity / length,
        })
    }

    /// Returns `½ ∫ ((v_t − h′)² + c² v_x²) dx` of a body whose centre has the velocity `rate`.
    ///
    /// **Errors**: those of [`ChainRun::stretches`].
    pub(super) fn vibration(&self, body: usize, time: &N, rate: &N) -> Result<N, Error> {
        let speed = &self.bars[body].wave_speed;
        let mut sum = rate.zero();
        for stretch in self.stretches(body, time)? {
            let [velocity, slope] = stretch.velocity.clone();
            let around = square(&stretch, &[velocity - rate, slope]);
            sum = sum + around + square(&stretch, &stretch.strain) * speed * speed;
        }
        Ok(sum.halved())
    }
}

/// Returns `∫ f² dx` over a stretch, on which `f` has a value at its lower end and a slope.
fn square<N: Bounded>(stretch: &Stretch<N>, [value, slope]: &[N; 2]) -> N {
    let rise = slope.clone() * &stretch.width;
    let middle = rise.clone().halved() + value;
    (middle.square() + rise.square() / rise.int(12)) * &stretch.width
}

/// Returns value and integral of a wave at a time.
fn wave_at<N: Bounded>(wave: &Wave<N>, time: N, side: Side) -> Result<(N, N), Open> {
    let at = wave.piece_at(&time, side)?;
    Ok((wave.pieces[at].line.value_at(&time), wave.sum_at(at, &time)))
}

/// Returns the pieces of a wave between two times.
fn window<'a, N: Bounded>(wave: &'a Wave<N>, from: &N, to: &N) -> Result<&'a [Piece<N>], Open> {
    let first = wave.piece_at(from, Side::Right)?;
    let last = wave.piece_at(to, Side::Left)?;
    Ok(&wave.pieces[first.min(last)..=last])
}
