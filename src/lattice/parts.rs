//! Kinetic and strain energy: the upward and the downward wave combined at each point of the rod.

use std::cmp::Ordering;

use super::history::{Trip, Undamped};
use super::start::Units;
use super::trace::Part;
use crate::motion::moments::Moments;
use crate::motion::{Side, Stretch};
use crate::number::{Bounded, Open};

/// A stretch of the rod on which both invariants are linear.
struct Both<N> {
    width: N,
    /// `(p + q)/2` and `(q − p)/2` at its lower end, and their slopes.
    values: [N; 2],
    slopes: [N; 2],
    /// Jumps across its lower end, each with the deviation of its place.
    shifts: Vec<(N, N)>,
}

/// A jump whose place is known only within a bound.
pub(super) struct Shift<N> {
    /// Its place.
    at: N,
    /// Zero, within the errors that the uncertain place causes in `∫ |v_t| dx` and `∫ |v_x| dx`.
    off: [N; 2],
}

/// The stretches of the rod, and the jumps between them whose places are uncertain.
pub(super) type Parted<N> = (Vec<Stretch<N>>, Vec<Shift<N>>);

/// Widens the moments of the cells between `points` by the effect of `shifts`. An error in the place of a jump of `v_x`
/// moves all of the rod above it.
pub(super) fn widened<N: Bounded>(cells: &mut [Moments<N>], shifts: &[Shift<N>], points: &[N]) {
    let (Some(first), Some(point)) = (shifts.first(), points.first()) else { return };
    let (mut rest, mut below) = (shifts, first.off[1].zero());
    for (cell, pair) in cells.iter_mut().zip(points.windows(2)) {
        let (a, b, width) = (&pair[0], &pair[1], pair[1].clone() - &pair[0]);
        while let Some((shift, others)) = rest.split_first().filter(|(shift, _)| shift.at.below(a) == Ok(true)) {
            (rest, below) = (others, below + &shift.off[1]);
        }
        let mut off = [point.zero(), point.zero()];
        for shift in rest.iter().filter(|shift| b.below(&shift.at) != Ok(true)) {
            off = std::array::from_fn(|k| off[k].clone() + &shift.off[k]);
        }
        let [velocity, strain] = off;
        let displacement = (below.clone() + &strain) * &width;
        for (sum, off) in cell.iter_mut().zip([displacement, velocity, strain]) {
            sum[1] = sum[1].clone() + off.clone() * &width;
            sum[0] = sum[0].clone() + off;
        }
    }
}

impl<N: Bounded> Undamped<N> {
    /// Computes `∫ ((p + q)/2)²` and `∫ ((q − p)/2)²` over the rod at the end of a round trip, in units of `2L`.
    pub(super) fn squares(&self, trip: &Trip<N>) -> Result<[N; 2], Open> {
        let zero = self.problem.gravity.zero();
        let mut sums = [zero.clone(), zero.clone()];
        self.visit_both(trip, &mut |both| {
            for ((sum, value), slope) in sums.iter_mut().zip(both.values).zip(both.slopes) {
                let reach = value.magnitude().doubled();
                let (offset, width) = (zero.clone(), both.width.clone());
                let part = Part { offset, width, value, slope, shift: None, late_end: None };
                let mut area = part.square_integral();
                // `[f²]` is at most `(2|f| + |[f]|) |[f]|`; only its size matters because the deviation has no sign.
                for (jump, late) in &both.shifts {
                    let jump = jump.clone().halved().magnitude();
                    area = area + (reach.clone() + &jump) * jump * late;
                }
                *sum = sum.clone() + area;
            }
        })?;
        Ok(sums)
    }

    /// Returns the rod at a moment, in the units of the scene, and the jumps between its stretches whose places are
    /// uncertain. `height` is `v(0,t)`.
    pub(super) fn stretches_at(&self, trip: &Trip<N>, height: N) -> Result<Parted<N>, Open> {
        let Units { velocity, length, wave_speed, .. } = &self.problem.units;
        let twice = length.clone().doubled();
        let rates = [velocity.clone(), velocity.clone() / wave_speed];
        let (zero, mut from, mut displacement) = (length.zero(), length.zero(), height);
        let (mut stretches, mut shifts) = (Vec::new(), Vec::new());
        self.visit_both(trip, &mut |both| {
            for (jump, late) in both.shifts {
                let (half, late) = (jump.halved(), late * &twice);
                let off = rates.each_ref().map(|rate| half.clone() * rate * &late);
                shifts.push(Shift { at: late + &from, off });
            }
            if both.width.alike(&zero) {
                return;
            }
            let width = both.width * &twice;
            let [velocity, strain] = std::array::from_fn(|k| {
                let slope = both.slopes[k].clone() * &rates[k] / &twice;
                [both.values[k].clone() * &rates[k], slope]
            });
            let stretch = Stretch { from: from.clone(), width, displacement: displacement.clone(), velocity, strain };
            from = from.clone() + &stretch.width;
            displacement = stretch.displacement_after(&stretch.width);
            stretches.push(stretch);
        })?;
        Ok((stretches, shifts))
    }

    fn visit_both(&self, trip: &Trip<N>, visit: &mut dyn FnMut(Both<N>)) -> Result<(), Open> {
        let until = &trip.ends[1];
        let (gravity, one) = (&self.problem.gravity, until.age.one());
        let (mut down, mut up) = (Vec::new(), Vec::new());
        self.visit_ways(trip, &mut |rises, part| {
            // The value is w of `visit_rod`.
            let value = part.value - gravity.clone() * (one.clone() - &part.offset);
            let part = Part { value, slope: part.slope + gravity, ..part };
            (if rises { &mut up } else { &mut down }).push(part);
        })?;
        // The upward parts run in order of x from the last one on: x falls as the age grows, and a jump then lies
        // across the other end. The jump of the last part is at the ground, that of the first at the top.
        let mut edges = up.iter_mut().map(|part| part.shift.take()).collect::<Vec<_>>();
        edges.push(self.edge(trip, until, Side::Left).and_then(|edge| edge.shift));
        let at_top = edges.remove(0);
        let top = up.first().zip(down.last()).map(|(p, q)| (p.value.clone(), q.slope.clone() * &q.width + &q.value));
        let turned = |(part, shift): (Part<N>, _)| {
            let value = part.slope.clone() * &part.width + &part.value;
            Part { value, slope: -part.slope, shift, ..part }
        };
        join(up.into_iter().zip(edges).rev().map(turned).collect(), down, visit)?;
        if let (Some(shift), Some((p, q))) = (at_top, top) {
            let (width, slopes) = (one.zero(), [one.zero(), one.zero()]);
            visit(Both { width, values: halves(&p, &q), slopes, shifts: vec![shift] });
        }
        Ok(())
    }
}

/// Returns `(p + q)/2` and `(q − p)/2`.
fn halves<N: Bounded>(p: &N, q: &N) -> [N; 2] {
    [(q.clone() + p).halved(), (q.clone() - p).halved()]
}

/// Visits the common refinement of two lists of parts in the order of x that end together.
fn join<N: Bounded>(up: Vec<Part<N>>, down: Vec<Part<N>>, visit: &mut dyn FnMut(Both<N>)) -> Result<(), Open> {
    let (mut up, mut down) = (up.into_iter(), down.into_iter());
    let (mut p, mut q) = (up.next(), down.next());
    while let (Some(rising), Some(falling)) = (p, q) {
        // Both lists end at the top, even if their widths differ within their bounds.
        let last = up.as_slice().is_empty() && down.as_slice().is_empty();
        let order = if last { Ordering::Equal } else { rising.width.compare(&falling.width)? };
        let width = if order.is_le() { rising.width.clone() } else { falling.width.clone() };
        let mut shifts = Vec::from_iter(rising.shift.clone());
        shifts.extend(falling.shift.clone());
        visit(Both {
            width: width.clone(),
            values: halves(&rising.value, &falling.value),
            slopes: halves(&rising.slope, &falling.slope),
            shifts,
        });
        p = if order.is_le() { up.next() } else { Some(rising.after(&width)) };
        q = if order.is_ge() { down.next() } else { Some(falling.after(&width)) };
    }
    Ok(())
}
