//! The kinetic and the strain energy apart: what goes up meets what comes down.

use std::cmp::Ordering;

use super::history::Undamped;
use super::trace::{Part, Place};
use crate::number::{Bounded, Open};

/// A stretch of the rod on which one invariant is linear, in the order of `x`.
struct Stretch<N> {
    /// What is left of its width, in parts of `2L`.
    width: N,
    /// The value where what is left begins.
    value: N,
    slope: N,
    /// `[p]` across its beginning, and the deviation of that in place; see [`Part`].
    shift: Option<(N, N)>,
}

impl<N: Bounded> Stretch<N> {
    /// What is left of it after `width`.
    fn after(self, width: &N) -> Self {
        let value = self.slope.clone() * width + &self.value;
        Stretch { width: self.width - width, value, slope: self.slope, shift: None }
    }
}

impl<N: Bounded> Undamped<N> {
    /// `∫ ((p + q)/2)²` and `∫ ((q − p)/2)²` over the rod at the end of a round trip, in parts of `2L`.
    pub(super) fn squares(&self, [from, until]: &[Place<N>; 2]) -> Result<[N; 2], Open> {
        let (gravity, one) = (&self.problem.gravity, until.age.one());
        let (mut down, mut up) = (Vec::new(), Vec::new());
        self.visit_ways(from, until, |rises, part| {
            // w of `visit_rod`.
            let value = part.value - gravity.clone() * (one.clone() - &part.offset);
            let part = Part { value, slope: part.slope + gravity, ..part };
            (if rises { &mut up } else { &mut down }).push(part);
        })?;
        // What goes up is met from its last part on: x falls with the age.
        let mut edges: Vec<_> = up.iter_mut().map(|part| part.shift.take()).collect();
        edges.rotate_left(1);
        let up = up.into_iter().zip(edges).rev().map(|(part, shift)| Stretch {
            value: part.slope.clone() * &part.width + &part.value,
            slope: -part.slope,
            width: part.width,
            shift,
        });
        let stretch = |Part { width, value, slope, shift, .. }| Stretch { width, value, slope, shift };
        Self::integrate(up.collect(), down.into_iter().map(stretch).collect(), &one.zero())
    }

    /// The integrals over two lists of stretches that end together.
    fn integrate(up: Vec<Stretch<N>>, down: Vec<Stretch<N>>, zero: &N) -> Result<[N; 2], Open> {
        let mut sums = [zero.clone(), zero.clone()];
        let (mut up, mut down) = (up.into_iter().peekable(), down.into_iter().peekable());
        let (mut p, mut q) = (up.next(), down.next());
        while let (Some(rising), Some(falling)) = (&p, &q) {
            // Both lists end at the top, whatever is known of their widths.
            let last = up.peek().is_none() && down.peek().is_none();
            let order = if last { Ordering::Equal } else { rising.width.compare(&falling.width)? };
            let width = if order.is_le() { rising.width.clone() } else { falling.width.clone() };
            let half = |a: &N, b: &N, minus: bool| (if minus { a.clone() - b } else { a.clone() + b }).halved();
            for (sum, minus) in sums.iter_mut().zip([false, true]) {
                let part = Part {
                    offset: zero.clone(),
                    width: width.clone(),
                    value: half(&falling.value, &rising.value, minus),
                    slope: half(&falling.slope, &rising.slope, minus),
                    shift: None,
                    late_end: None,
                };
                // [f²] is at most (2|f| + |[f]|) |[f]|; only its size matters, as the deviation has no sign.
                let mut area = part.square_integral();
                for (jump, late) in rising.shift.iter().chain(&falling.shift) {
                    let jump = jump.clone().halved().magnitude();
                    area = area + (part.value.magnitude().doubled() + &jump) * jump * late;
                }
                *sum = sum.clone() + area;
            }
            p = if order.is_le() { up.next() } else { p.map(|stretch| stretch.after(&width)) };
            q = if order.is_ge() { down.next() } else { q.map(|stretch| stretch.after(&width)) };
        }
        Ok(sums)
    }
}
