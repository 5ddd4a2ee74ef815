//! The field along a body of a chain, and the sums over it.

use std::ops::RangeInclusive;

use super::curve::{Signal, bound, greater, primitive, product, turned, value};
use super::run::ChainRun;
use super::start::Bar;
use super::sums::BodySums;
use super::wave::{Limit, Piece, Wave, order};
use crate::error::Error;
use crate::motion::{Field, Side, Stretch};
use crate::number::{Bounded, Open, is_exact_zero};

impl<N: Bounded> ChainRun<N> {
    /// Returns displacement, velocity and strain of a body at its point `x`; on a ray, the limit in time from `side`.
    ///
    /// **Errors**: [`Error::TimeOutside`], [`Error::PointOutside`]; [`Error::Open`] if the point is not told from a
    /// ray.
    pub fn field(&self, body: usize, point: &N, time: &N, side: Side) -> Result<Field<N>, Error> {
        self.field_by((body, point, time), |wave, time| wave.at(time, side))
    }

    /// Returns [`ChainRun::field`], with bounds that cover both limits where the point is not told from a ray.
    pub(super) fn field_within(&self, body: usize, point: &N, time: &N, limit: Limit) -> Result<Field<N>, Error> {
        self.field_by((body, point, time), |wave, time| Ok(wave.within(time, limit)))
    }

    fn field_by(
        &self,
        (body, point, time): (usize, &N, &N),
        at: impl Fn(&Wave<N>, &N) -> Result<(N, N), Open>,
    ) -> Result<Field<N>, Error> {
        self.check_time(time)?;
        let Bar { length, wave_speed, mass, .. } = &self.bars[body];
        let is_rigid = mass.is_some();
        if point.negative()? || length.below(point)? {
            return Err(Error::PointOutside { found: point.text(), length: length.text() });
        }
        let [up, down] = &self.waves[body];
        let above = length.clone() - point;
        let rising = at(up, &(time.clone() - point.clone() / wave_speed))?;
        let falling = at(down, &(time.clone() - above / wave_speed))?;
        let [fall, twice] = self.fallen(time);
        Ok(Field {
            displacement: (rising.1 + &falling.1 - twice).halved(),
            velocity: (rising.0.clone() + &falling.0).halved() - fall,
            strain: if is_rigid { length.zero() } else { (falling.0 - rising.0).halved() / wave_speed },
        })
    }

    /// Returns displacement, velocity and strain of the bottom or the top of a body, as [`ChainRun::field`] does.
    pub fn end_field(&self, body: usize, is_top: bool, time: &N, side: Side) -> Result<Field<N>, Error> {
        self.field(body, &self.end_point(body, is_top), time, side)
    }

    /// Returns the point of the bottom or the top of a body.
    pub(super) fn end_point(&self, body: usize, is_top: bool) -> N {
        let length = &self.bars[body].length;
        if is_top { length.clone() } else { length.zero() }
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
        // A body that is struck at its top alone has a curve downward first.
        if self.waves[body].iter().any(Wave::is_curved) {
            return Err(Error::Curved);
        }
        let earliest = time.clone() - travel;
        // Upward pieces in the order of x: the last to leave is the lowest.
        let rising = window(up, &earliest, time)?;
        let falling = window(down, &earliest, time)?;
        let place = |from: &N| (time.clone() - from) * wave_speed;
        let mut rising =
            rising.iter().rev().map(|piece| (place(&piece.from), piece.signal.clone().into_line())).peekable();
        let tops = falling.iter().skip(1).map(|piece| length.clone() - place(&piece.from)).map(Some).chain([None]);
        let mut falling = falling.iter().map(|piece| piece.signal.clone().into_line()).zip(tops).peekable();
        let mut from = length.zero();
        let mut displacement = self.end_field(body, false, time, Side::Left)?.displacement;
        let [fall, _] = self.fallen(time);
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
    /// **Errors**: [`Error::TimeOutside`]; [`Error::Open`] if it is not decided whether the velocity of a rigid body
    /// has jumped.
    pub fn sums(&self, body: usize, time: &N) -> Result<BodySums<N>, Error> {
        self.kept.get(body, time, || self.make_sums(body, time))
    }

    fn make_sums(&self, body: usize, time: &N) -> Result<BodySums<N>, Error> {
        let Bar { length, wave_speed, impedance, mass, .. } = &self.bars[body];
        let zero = length.zero();
        if let Some(mass) = mass {
            let Field { displacement, velocity, .. } = self.field(body, &zero, time, Side::Right)?;
            let kinetic = (velocity.square() * mass).halved();
            let potential = displacement.clone() * mass * &self.gravity;
            return Ok(BodySums { displacement, velocity, kinetic, strain: zero, potential });
        }
        let stretches = match self.stretches(body, time) {
            Err(Error::Curved | Error::Open(_)) => return self.window_sums(body, time),
            stretches => stretches?,
        };
        let mut sums = [zero.clone(), zero.clone(), zero.clone(), zero];
        for stretch in stretches {
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

    /// Returns the sums over a body whose waves are curves, or the order of whose rays is not decided.
    ///
    /// **Source**: with `P = ∫p`, `∫ v dx = (c/2) ∫ (P + Q − g t²) ds` over the travel time before `t`, and the
    /// energies are `(Z/8) ∫ (p + q − 2gt)² ds` and `(Z/8) ∫ (q − p)² ds`, where `q` is taken at `2t − T − s`.
    fn window_sums(&self, body: usize, time: &N) -> Result<BodySums<N>, Error> {
        let Bar { impedance, travel, wave_speed, .. } = &self.bars[body];
        let windows = self.waves[body].each_ref().map(|wave| Window::new(wave, time, travel));
        let [rising, falling] = windows;
        let (rising, falling) = (rising?, falling?);
        let [fall, twice] = self.fallen(time);
        let total = rising.total.clone() + &falling.total;
        let squares = rising.square() + falling.square();
        let cross = rising.product(&falling);
        let density = impedance.clone() / wave_speed;
        let mean = |sum: N| sum.halved() / travel;
        // ∫ (p + q − 2gt)² = ∫p² + ∫q² + 2∫pq − 4gt ∫(p + q) + 4g²t² T.
        let moved =
            squares.clone() + cross.clone().doubled() - (total.clone() * &fall - fall.square() * travel) * fall.int(4);
        let stretched = squares - cross.doubled();
        let energy = |sum: N| sum * impedance / impedance.int(8);
        let displacement = mean(rising.height + &falling.height) - twice.halved();
        Ok(BodySums {
            velocity: mean(total) - &fall,
            kinetic: energy(moved),
            strain: energy(stretched),
            potential: displacement.clone() * &density * &self.bars[body].length * &self.gravity,
            displacement,
        })
    }

    /// Returns `½ ∫ ((v_t − h′)² + c² v_x²) dx` of a body with these sums.
    ///
    /// **Errors**: [`Error::TimeOutside`].
    pub(super) fn vibration(&self, body: usize, time: &N, sums: &BodySums<N>) -> Result<N, Error> {
        let BodySums { kinetic, strain, velocity: rate, .. } = sums;
        let Bar { length, wave_speed: speed, impedance, .. } = &self.bars[body];
        let stretches = match self.stretches(body, time) {
            Err(Error::Curved | Error::Open(_)) => {
                let whole = (kinetic.clone() + strain) * speed / impedance;
                return Ok(whole - rate.square() * length.clone().halved());
            }
            stretches => stretches?,
        };
        let mut sum = rate.zero();
        for stretch in stretches {
            let [velocity, slope] = stretch.velocity.clone();
            let around = square(&stretch, &[velocity - rate, slope]);
            sum = sum + around + square(&stretch, &stretch.strain) * speed * speed;
        }
        Ok(sum.halved())
    }
}

/// A wave over the travel time before a time.
struct Window<N> {
    /// Stored beginning and end of each part, with the wave on it.
    parts: Vec<(N, N, Signal<N>)>,
    begin: N,
    end: N,
    /// Integral of the wave, and integral of that integral.
    total: N,
    height: N,
    /// For each uncertain border, its uncertainty times the jump of the wave there, and the sum of both values.
    slivers: Vec<(N, N)>,
}

impl<N: Bounded> Window<N> {
    fn new(wave: &Wave<N>, time: &N, travel: &N) -> Result<Self, Error> {
        let earliest = time.clone() - travel;
        let [firsts, lasts] = [wave.pieces_at(&earliest, Side::Right), wave.pieces_at(time, Side::Left)];
        let [(begin, early), (end, late)] = [&earliest, time].map(N::centred);
        // Of the pieces that an end may lie in, the one that the stored values tell.
        let stored = |near: &RangeInclusive<usize>, at: &N| {
            let begun = |k: &usize| wave.pieces[*k].from.centred().0.below(at) == Ok(true);
            near.clone().rev().find(begun).unwrap_or(*near.start())
        };
        let (first, last) = (stored(&firsts, &begin), stored(&lasts, &end));
        let first = first.min(last);
        let zero = time.zero();
        let total = wave.sum_within(lasts.clone(), time) - wave.sum_within(firsts.clone(), &earliest);
        let mut window = Window {
            parts: Vec::new(),
            total,
            height: zero.clone(),
            slivers: Vec::new(),
            begin: begin.clone(),
            end: end.clone(),
        };
        for (near, at) in [(&firsts, &begin), (&lasts, &end)] {
            // Between the stored and the true beginning of a piece either wave may be the true one.
            for k in near.clone().skip(1) {
                let sizes = [k - 1, k].map(|k| wave.pieces[k].signal.value_at(at).magnitude());
                let size = sizes[0].clone() + &sizes[1];
                let unsure = wave.pieces[k].from.centred().1 + &early + &late;
                window.height = window.height.widened(&(size.clone() * &unsure * travel));
                window.slivers.push((size.clone() * unsure, size));
            }
        }
        for k in first..=last {
            let piece = &wave.pieces[k];
            let (own, own_late) = piece.from.centred();
            let from = if k == first { begin.clone() } else { own.clone() };
            let to = if k == last { end.clone() } else { wave.pieces[k + 1].from.centred().0 };
            let (width, rounding) = (to.clone() - &from).centred();
            if k > first && !is_exact_zero(&own_late) {
                let [before, after] = [&wave.pieces[k - 1], piece].map(|piece| piece.signal.value_at(&own).magnitude());
                let jump = (wave.pieces[k - 1].signal.value_at(&own) - piece.signal.value_at(&own)).magnitude();
                window.slivers.push((jump * own_late, before + after));
            }
            for late in [(k == first).then_some(&early), (k == last).then_some(&late), Some(&rounding)] {
                let Some(late) = late.filter(|late| !is_exact_zero(*late)) else { continue };
                let size = piece.signal.value_at(&from).magnitude() + piece.signal.value_at(&to).magnitude();
                window.slivers.push((size.clone() * late, size));
            }
            let curve = piece.signal.about(&from, &width);
            let twice = primitive(&primitive(&curve.terms));
            let reach = width.clone() / &curve.unit;
            let risen = (value(&twice, &reach) * curve.unit.square()).widened(&(curve.error * width.square()));
            window.height = window.height + wave.sum_at(k, &from) * &width + risen;
            window.parts.push((from, to, piece.signal.clone()));
        }
        // The whole window lies off by the error of its ends.
        let off = wave.sum_within(lasts, time).magnitude() + wave.sum_within(firsts, &earliest).magnitude();
        window.height = window.height.widened(&(off * (early + late)));
        Ok(window)
    }

    /// Returns the greatest magnitude of the wave.
    fn most(&self) -> N {
        let size = |(from, to, signal): &(N, N, Signal<N>)| {
            let width = (to.clone() - from).centred().0;
            signal.about(from, &width).most()
        };
        self.parts.iter().map(size).fold(self.begin.zero(), greater)
    }

    /// Returns the integral of the square.
    fn square(&self) -> N {
        let part = |(from, to, signal): &(N, N, Signal<N>)| {
            let width = (to.clone() - from).centred().0;
            signal.about(from, &width).trimmed().square_integral(&width)
        };
        let sum = self.parts.iter().map(part).fold(self.begin.zero(), |sum, part| sum + part);
        self.slivers.iter().fold(sum, |sum, (area, size)| sum.widened(&(area.clone() * size)))
    }

    /// Returns the integral of the product with another wave that runs against this one.
    fn product(&self, other: &Self) -> N {
        let zero = self.begin.zero();
        let mirror = |at: &N| (self.begin.clone() + &self.end - at).centred().0;
        let mut sum = zero.clone();
        let mut from = self.begin.clone();
        let mut others = other.parts.iter().rev().peekable();
        let mut own = self.parts.iter().peekable();
        while let (Some((_, own_end, p)), Some((other_begin, _, q))) = (own.peek(), others.peek()) {
            let other_end = mirror(other_begin);
            let is_own_first = own_end.below(&other_end) == Ok(true);
            let to = if is_own_first { own_end.clone() } else { other_end.clone() };
            let width = (to.clone() - &from).centred().0;
            if width.positive() == Ok(true) {
                let (p, q) = (p.about(&from, &width).trimmed(), q.about(&mirror(&to), &width).trimmed());
                let reach = width.clone() / &p.unit;
                let turned = turned(&q.terms, &reach);
                let (a, b) = (bound(&p.terms, &reach), bound(&q.terms, &reach));
                let error = (a + &p.error) * &q.error + b * &p.error;
                let part = value(&primitive(&product(&p.terms, &turned)), &reach) * &p.unit;
                sum = sum + part.widened(&(error * &width));
            }
            let ends_alike = own_end.alike(&other_end);
            if is_own_first || ends_alike {
                own.next();
            }
            if !is_own_first {
                others.next();
            }
            from = to;
        }
        let [own_most, other_most] = [self, other].map(Window::most);
        let slivers = |window: &Self, most: &N| {
            window.slivers.iter().fold(zero.clone(), |sum, (area, _)| sum + area.clone() * most)
        };
        sum.widened(&(slivers(self, &other_most) + slivers(other, &own_most)))
    }
}

/// Returns `∫ f² dx` over a stretch, on which `f` has a value at its lower end and a slope.
fn square<N: Bounded>(stretch: &Stretch<N>, [value, slope]: &[N; 2]) -> N {
    let rise = slope.clone() * &stretch.width;
    let middle = rise.clone().halved() + value;
    (middle.square() + rise.square() / rise.int(12)) * &stretch.width
}

/// Returns the pieces of a wave between two times.
fn window<'a, N: Bounded>(wave: &'a Wave<N>, from: &N, to: &N) -> Result<&'a [Piece<N>], Open> {
    let first = wave.piece_at(from, Side::Right)?;
    let last = wave.piece_at(to, Side::Left)?;
    Ok(&wave.pieces[first.min(last)..=last])
}
