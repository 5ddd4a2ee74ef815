//! The stress history of a contact as polynomials with a proved distance.

use super::field::{FirstContact, Trips};
use crate::motion::{Side, StressPiece};
use crate::special::BoundedSpecial;

/// Maximum number of terms; the truncation error widens the first coefficient.
const MOST_TERMS: usize = 4000;

impl<N: BoundedSpecial> FirstContact<N> {
    /// Computes `v_x(0,·)` from 0 to `end`, one piece for each round trip.
    pub(super) fn pieces(&self, end: &Trips<N>) -> Vec<StressPiece<N>> {
        let last = if end.on_lattice { end.passed - 1 } else { end.passed };
        (0..=last).map(|k| self.piece(k, if k == last { end.clone() } else { self.lattice(k + 1) })).collect()
    }

    /// Computes one piece. The coefficients are those of the polynomial through n + 1 Chebyshev points; its truncation
    /// error, `4Mρ⁻ⁿ/(ρ−1)`, and terms that are zero within their bounds widen the first. Later cells have `M ≤
    /// (2k+1)²` on `ρ + 1/ρ = 4k + 2`, see the search for the bounce; a shorter piece with the same left end has its
    /// ellipse inside of that one. In the first, `e^{−Rτ}I₀(Rτ)` and `e^{−Rτ}I₁(Rτ)` are at most `e^{2Rd}` where `Re τ
    /// ≥ −d`: with ρ ≤ 6 and half-width 1/2, `d = ((ρ + 1/ρ)/2 − 1)/2`, `|τ| < 2.1`.
    fn piece(&self, k: i64, to: Trips<N>) -> StressPiece<N> {
        let one = self.damping.one();
        let digits = -one.log2_roundoff() * std::f64::consts::LN_2;
        let after = |rho: f64, log: f64| (rho, log + (4.0 / (rho - 1.0)).ln() + 1e-6);
        let ellipses: Vec<(f64, f64)> = if k == 0 {
            let (r, radii) = (self.damping.to_f64(), [6.0f64, 3.0, 2.0, 1.5, 1.25, 1.1, 1.05]);
            radii.map(|rho| after(rho, r * ((rho + 1.0 / rho) / 2.0 - 1.0) + 5.2f64.ln())).to_vec()
        } else {
            let width = 2.0 * k as f64 + 1.0;
            vec![after(width + (width * width - 1.0).sqrt(), 2.0 * width.ln())]
        };
        let terms = |(rho, log): &(f64, f64)| (log + digits) / rho.ln();
        let n = ellipses.iter().map(terms).fold(f64::INFINITY, f64::min).ceil().clamp(2.0, MOST_TERMS as f64) as usize;
        let left_out = ellipses.iter().map(|(rho, log)| log - n as f64 * rho.ln() * (1.0 - 1e-12));
        let left_out = one.double(left_out.fold(f64::INFINITY, f64::min)).exp();
        let mut rest = left_out * self.total_speed() / &self.rod.wave_speed;

        let half = (to.number.clone() - one.int(k)) / one.int(2);
        let middle = half.clone() + one.int(k);
        let cosines: Vec<N> = (0..2 * n as i64).map(|j| (one.pi() * one.ratio(j, n as i64)).cos()).collect();
        let at = |cosine: &N| self.stress_in_cell(&(half.clone() * cosine + &middle), k);
        let values: Vec<N> = cosines.iter().take(n + 1).map(at).collect();
        let halved = |j: usize, x: N| if j == 0 || j == n { x / one.int(2) } else { x };
        let coefficient = |i: usize| {
            let terms =
                values.iter().enumerate().map(|(j, value)| halved(j, value.clone() * &cosines[i * j % (2 * n)]));
            halved(i, terms.fold(one.zero(), |sum, term| sum + term) * one.ratio(2, n as i64))
        };
        let mut chebyshev: Vec<N> = (0..=n).map(coefficient).collect();
        while let Some(last) = chebyshev.pop_if(|last| !matches!(last.sign(), Ok(order) if order.is_ne())) {
            rest = rest + last.magnitude();
        }
        match chebyshev.first_mut() {
            Some(first) => *first = first.clone().widened(&rest),
            None => chebyshev.push(one.zero().widened(&rest)),
        }
        let side = if to.on_lattice { Side::Left } else { Side::Right };
        StressPiece {
            strain_start: self.stress_at(&self.lattice(k), Side::Right),
            strain_end: self.stress_at(&to, side),
            start: self.round_trip.int(k) * &self.round_trip,
            end: self.round_trip.int(k + 1) * &self.round_trip,
            chebyshev,
        }
    }
}
