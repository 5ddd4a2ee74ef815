//! The stress history of a contact as polynomials with a proved distance.

use super::closed_form::{ClosedForm, Trips, plain};
use crate::error::Error;
use crate::history::{Side, StressPiece};
use crate::number::{Analytic, Interval, Scalar};

/// More terms than this are not taken: what they would add is a width.
const MOST_TERMS: usize = 4000;

impl ClosedForm {
    /// `v_x(0,·)` from 0 to `end`, one piece for each round trip.
    ///
    /// The coefficients are those of the polynomial through n + 1 Chebyshev points, in enclosures; what it leaves out,
    /// `4Mρ⁻ⁿ/(ρ−1)`, is a width of the first. Later cells have `M ≤ (2k+1)²` on `ρ + 1/ρ = 4k + 2`, see the search for the
    /// bounce; a shorter piece with the same left end has its ellipse inside of that one. In the first, `e^{−Rτ}I₀(Rτ)` and
    /// `e^{−Rτ}I₁(Rτ)` are at most `e^{2Rd}` where `Re τ ≥ −d`: on ρ = 6 and half-width 1/2, `d = 25/24`, `|τ| < 2.1`.
    pub(super) fn pieces(&self, end: &Trips) -> Result<Vec<StressPiece<Interval>>, Error> {
        let last = if end.on_lattice { end.passed - 1 } else { end.passed };
        (0..=last).map(|k| self.piece(k, if k == last { end.clone() } else { self.lattice(k + 1) })).collect()
    }

    fn piece(&self, k: i64, to: Trips) -> Result<StressPiece<Interval>, Error> {
        let (speed, critical) = (plain(&self.exact.speed), plain(&self.exact.critical_speed()));
        let damping = plain(&self.exact.damping) * self.contact.round_trip();
        let one = speed.one();
        let width = 2.0 * k as f64 + 1.0;
        let (rho, log) = if k == 0 {
            (6.0, 2.0 * 25.0 / 24.0 * damping.to_f64() + 5.2f64.ln())
        } else {
            (width + (width * width - 1.0).sqrt(), 2.0 * width.ln())
        };
        let log = log + (4.0 / (rho - 1.0)).ln() + 1e-6;
        let digits = f64::from(self.bits()) * std::f64::consts::LN_2;
        let n = ((log + digits) / rho.ln()).ceil().clamp(2.0, MOST_TERMS as f64) as usize;
        let rest = one.double(log - n as f64 * rho.ln() * (1.0 - 1e-12)).exp() * (speed + critical)
            / plain(&self.exact.wave_speed);
        let from = one.int(k);
        let half = (to.plain.clone() - &from) / one.int(2);
        let middle = from + &half;
        let cosines: Vec<Interval> = (0..2 * n as i64).map(|j| (one.pi() * one.ratio(j, n as i64)).cos()).collect();
        let values = self.settled("what the stress is", || {
            let at = |cosine: &Interval| self.contact.stress_at(&(half.clone() * cosine + &middle), k);
            Some(cosines.iter().take(n + 1).map(at).collect::<Vec<_>>())
        })?;
        let halved = |j: usize, x: Interval| if j == 0 || j == n { x / one.int(2) } else { x };
        let coefficient = |i: usize| {
            let terms =
                values.iter().enumerate().map(|(j, value)| halved(j, value.clone() * &cosines[i * j % (2 * n)]));
            halved(i, terms.fold(one.zero(), |sum, term| sum + term) * one.ratio(2, n as i64))
        };
        let mut chebyshev: Vec<Interval> = (0..=n).map(coefficient).collect();
        if let Some(first) = chebyshev.first_mut() {
            *first = first.clone().widened(&rest);
        }
        let start = self.lattice(k);
        let right = if to.on_lattice { self.stress_at(&to, Side::Left)? } else { self.stress_at(&to, Side::Right)? };
        Ok(StressPiece {
            left: self.stress_at(&start, Side::Right)?,
            right,
            from: self.round_trip.int(k) * &self.round_trip,
            to: self.round_trip.int(k + 1) * &self.round_trip,
            chebyshev,
        })
    }
}
