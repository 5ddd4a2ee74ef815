//! Integrals of the field over the cells of a grid during the first contact, by Gauss–Legendre between points and rays.

use std::cmp::Ordering;

use super::energy::{RADII, Stretch, nodes, rest};
use super::field::{FirstContact, Trips};
use crate::motion::moments::{Moments, Node, Sums, of_sums};
use crate::number::Scalar;
use crate::special::BoundedSpecial;

/// The rule leaves at most this part of a roundoff of `μ + μ₀`, as `log₂`.
const LEFT: f64 = -6.0;

impl<N: BoundedSpecial> FirstContact<N> {
    /// `∫ f dx` and `∫ f (x − a) dx` over each cell `a … b` between neighbours of `points`, for `f` = `v`, `v_t`,
    /// `v_x`.
    ///
    /// **Accuracy**: *within its own bound*, which holds rounding and quadrature. Where a ray is not told from a point
    /// of the grid, or from the top, a cell ends at the ray, and what lies between is at most
    /// [`FirstContact::total_speed`] times their distance.
    pub(super) fn moments_at(&self, points: &[N], trips: &Trips<N>) -> Vec<Moments<N>> {
        let (stretches, _) = self.stretches(trips);
        let (zero, reach) = (self.damping.zero(), self.rod.length.clone() * &self.damping.int(2));
        let ends: Vec<N> = std::iter::once(zero.clone()).chain(points.iter().cloned()).collect();
        let places: Vec<N> = ends.iter().map(|x| (x.clone() / &reach).without_exact()).collect();
        let cells: Vec<_> = places.windows(2).map(|pair| parts(&stretches, &pair[0], &pair[1])).collect();

        let moved = cells.iter().flat_map(|(parts, _)| parts).filter(|part| part.arrived[0] > 0);
        let widest = moved.map(|part| (part.to.clone() - &part.from).to_f64() / 2.0).fold(0.0, f64::max);
        let (left, rule) = self.rule(trips, widest);
        let free = self.free_fall(&trips.number);
        let sums = cells.iter().zip(ends.windows(2)).map(|((parts, doubt), pair)| {
            let node = |part: &Stretch<N>, at: &N, weight: &N| {
                let half = (part.to.clone() - &part.from) / zero.int(2);
                let a = (at.one() + at) * &half + &part.from;
                let [_, rate, slope] = self.field_shares(&a, &trips.number, part.arrived, &free);
                Node {
                    weight: weight.clone() * &half * &reach,
                    x: a * &reach,
                    velocity: self.weighted(&rate),
                    strain: self.weighted(&slope) * &self.slowness,
                }
            };
            let nodes = parts.iter().flat_map(|part| rule.iter().map(move |(at, weight)| node(part, at, weight)));
            let width = pair[1].clone() - &pair[0];
            let off = (left.clone() * &width + self.total_speed() * doubt * &reach).without_exact();
            Sums::of(&pair[0], nodes).widened(&width, &off, &(off.clone() * &self.slowness))
        });
        of_sums(sums.collect(), points, zero.clone())
    }

    /// A rule for intervals of this half-width at most, and what it leaves of `v_t` and `c v_x` for each length.
    ///
    /// n nodes on an interval of half-width w leave less than `(64/15) w M ρ^{−2n}/(1 − ρ⁻²)`, where M bounds the
    /// integrand on the Bernstein ellipse ρ. There a place relative to a cell that holds the interval, which is between
    /// 0 and 1 inside, is at most ρ; the integrands hold its square at most.
    fn rule(&self, trips: &Trips<N>, half: f64) -> (N, Vec<(N, N)>) {
        let tau = trips.number.to_f64();
        let (mu, mu0) = (self.speed.to_f64(), self.critical.to_f64());
        let ellipses = RADII.map(|rho| {
            let amplitude = self.amplitude(tau, (rho - 1.0 / rho) / 2.0 * half, mu, mu0);
            let factor = 32.0 / 15.0 * rho * rho / (1.0 - 1.0 / (rho * rho));
            [amplitude.log2() + factor.log2(), 2.0 * rho.log2()]
        });
        let n = nodes(&ellipses, self.damping.log2_roundoff() + LEFT + (mu + mu0).log2());
        // A part in a thousand more is for the doubles in it.
        let two = self.damping.int(2);
        let left = (two.ln() * &two.double(rest(&ellipses, n) + 1e-3)).exp();
        (left, self.damping.gauss_legendre(n))
    }
}

/// The parts of `from … to` between rays, and how far these may miss an end, where a ray is not told from it.
fn parts<N: Scalar>(stretches: &[Stretch<N>], from: &N, to: &N) -> (Vec<Stretch<N>>, N) {
    let mut doubt = from.zero();
    let (Some(lower), Some(upper)) = (stretches.first(), stretches.last()) else { return (Vec::new(), doubt) };
    let part = |from: &N, to: &N, of: &Stretch<N>| Stretch { from: from.clone(), to: to.clone(), ..*of };
    let cut = &lower.to;
    let sides = [from, to].map(|end| match cut.compare(end) {
        Ok(order @ (Ordering::Less | Ordering::Greater)) => Some(order),
        _ => {
            doubt = doubt.clone() + (cut.clone() - end).magnitude();
            None
        }
    });
    let parts = match sides {
        [Some(Ordering::Greater), Some(Ordering::Greater)] => vec![part(from, to, lower)],
        [Some(Ordering::Greater), Some(_)] => vec![part(from, cut, lower), part(cut, to, upper)],
        [Some(Ordering::Greater), None] => vec![part(from, cut, lower)],
        [Some(_), _] => vec![part(from, to, upper)],
        [None, Some(Ordering::Less)] => vec![part(cut, to, upper)],
        // The cell is no wider than the doubt.
        [None, _] => Vec::new(),
    };
    (parts, doubt)
}
