//! Integrals of the field over the cells of a grid, from polynomials between rays or from quadrature nodes.

use super::Stretch;
use super::maps::maps;
use crate::error::Error;
use crate::number::Scalar;

/// `∫ f dx` and `∫ f (x − a) dx` over a cell `a … b`, for `f` = `v`, `v_t`, `v_x`.
pub(crate) type Moments<S> = [[S; 2]; 3];

pub(crate) fn of_stretches<S: Scalar>(stretches: &[Stretch<S>], points: &[S]) -> Result<Vec<Moments<S>>, Error> {
    let mut cells = Vec::with_capacity(points.len());
    let mut rest = stretches.iter().peekable();
    for pair in points.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        let zero = || [a.zero(), a.zero()];
        let mut sums = [zero(), zero(), zero()];
        while let Some(&stretch) = rest.peek() {
            let end = stretch.from.clone() + &stretch.width;
            // The stretch ends before the cell, reaches into it from below, or begins in it. Each part is cut from the
            // whole stretch: a cut of a cut would double the bound of its beginning, cell by cell.
            let skipped = a.clone() - &stretch.from;
            let part = match skipped.positive()? {
                true if !a.below(&end)? => {
                    rest.next();
                    continue;
                }
                true => &Stretch { from: a.clone(), ..stretch.after(&skipped) },
                false => stretch,
            };
            let within = end.below(b)?;
            let way = if within { part.width.clone() } else { b.clone() - &part.from };
            let offset = part.from.clone() - a;
            for (sum, [area, moment]) in sums.iter_mut().zip(part.moments(&way)) {
                sum[1] = sum[1].clone() + moment + &(offset.clone() * &area);
                sum[0] = sum[0].clone() + area;
            }
            if !within {
                break;
            }
            rest.next();
        }
        cells.push(sums);
    }
    Ok(cells)
}

/// A quadrature node on the rod.
#[derive(Clone, Debug)]
pub(crate) struct Node<S> {
    pub(crate) weight: S,
    pub(crate) x: S,
    /// `v_t`.
    pub(crate) velocity: S,
    /// `v_x`.
    pub(crate) strain: S,
}

maps!(pub(crate) Node { weight, x, velocity, strain });

/// `∫ v_x (x − a)ⁿ dx` for n < 3 and `∫ v_t (x − a)ⁿ dx` for n < 2, over a cell that begins at a.
#[derive(Clone, Debug)]
pub(crate) struct Sums<S> {
    from: S,
    strain: [S; 3],
    velocity: [S; 2],
}

impl<S: Scalar> Sums<S> {
    pub(crate) fn of(from: &S, nodes: impl IntoIterator<Item = Node<S>>) -> Self {
        let zero = || from.zero();
        let mut sums = Sums { from: from.clone(), strain: [zero(), zero(), zero()], velocity: [zero(), zero()] };
        for Node { weight, x, velocity, strain } in nodes {
            let offset = x - from;
            let (mut strain, mut velocity) = (strain * &weight, velocity * &weight);
            for (n, sum) in sums.strain.iter_mut().enumerate() {
                *sum = sum.clone() + &strain;
                strain = strain * &offset;
                if let Some(sum) = sums.velocity.get_mut(n) {
                    *sum = sum.clone() + &velocity;
                    velocity = velocity * &offset;
                }
            }
        }
        sums
    }

    /// Widens the sums for errors up to `velocity` in `∫ |v_t| dx` and `strain` in `∫ |v_x| dx` over this width.
    pub(crate) fn widened(mut self, width: &S, velocity: &S, strain: &S) -> Self {
        let mut power = width.one();
        for (n, sum) in self.strain.iter_mut().enumerate() {
            *sum = sum.clone().widened(&(power.clone() * strain));
            if let Some(sum) = self.velocity.get_mut(n) {
                *sum = sum.clone().widened(&(power.clone() * velocity));
            }
            power = power * width;
        }
        self
    }

    /// Returns the moments of the cell up to `to`, and `v` there, given `v` at its beginning. Integration by parts:
    /// `∫ v = h v(a) + ∫ (b − x) v_x` and `∫ v (x − a) = ½h² v(a) + ½∫ (h² − (x − a)²) v_x`, with h the width.
    pub(crate) fn moments(self, to: &S, start: &S) -> (Moments<S>, S) {
        let Sums { from, strain: [rise, first, second], velocity } = self;
        let width = to.clone() - &from;
        let end = start.clone() + &rise;
        let area = end.clone() * &width - &first;
        let moment = (end.clone() * &width.square() - second) / width.int(2);
        ([[area, moment], velocity, [rise, first]], end)
    }
}

/// Computes the moments of all cells from the sums below the first point and in each cell, and from `v` at the ground.
pub(crate) fn of_sums<S: Scalar>(sums: Vec<Sums<S>>, points: &[S], ground: S) -> Vec<Moments<S>> {
    let mut start = ground;
    let moments = sums.into_iter().zip(points).map(|(sums, to)| {
        let (moments, end) = sums.moments(to, &start);
        start = end;
        moments
    });
    moments.skip(1).collect()
}
