//! Leaps over many round trips of a flight: their length, and the removal of faded rays.

use super::budget::LEAP_CELLS;
use super::effort::LEAST_LEAP;
use super::follow::{Follower, Goal};
use super::leap::most_trips;
use super::piece::Piece;
use crate::special::RoundedSpecial;

impl<S: RoundedSpecial> Follower<'_, S> {
    /// Returns the number of round trips of the next leap: the end is proved to stay above the ground for so long.
    ///
    /// `v(0,t) = h + z(0,t)` with `|z(0,t)| ≤ B e^{−Rτ}` at the age τ from now. Proof: `z` has mean zero, hence `|z(0)|
    /// ≤ ‖z_x‖/√6` on a rod of length ½; `e^{2Rτ} (|ȧ + Ra|² + ω²|a|²)` is constant in each mode `a`, and lies between
    /// `1 ∓ ρ` times `e^{2Rτ}(|ȧ|² + (2πk)²|a|²)`, `ρ = R/2π`; and `½ ∫ p² + q² dx ≤ ½ M²` half a round trip from now,
    /// above the characteristic on which `|q| ≤ M`. So `B = e^{R/2} M √((1 + ρ)/(1 − ρ)/12)`. Where `h′ ≥ −g/2R` the
    /// fall is concave, and so is `h − B e^{−Rτ}`: its minimum is at one of its ends. Otherwise h falls throughout, and
    /// its end is the minimum.
    pub(super) fn leap_length(&self, goal: &Goal<S>) -> Option<i64> {
        let flight = self.flying()?;
        let (damping, gravity) = (self.damping(), self.medium.gravity.to_f64());
        let age = flight.age(&self.state);
        let (height, rate) = flight.at(&age);
        let bound = self.swing(self.state.bound() + self.noise());
        let passing = self.medium.passing(&self.state);
        let concave = rate.to_f64() >= -gravity / (2.0 * damping);
        let clear = |trips: f64| {
            let later = flight.at(&(age.clone() + age.double(trips))).0.to_f64();
            let fade = if concave { (-damping * trips).exp() } else { 1.0 };
            later > bound * fade + self.height_most(trips, passing)
        };
        let mut most = match goal {
            Goal::Time(end) => (end.clone() - self.state.time()).to_f64().floor() - 1.0,
            Goal::Impacts(_) if gravity > 0.0 => 1e15,
            Goal::Impacts(_) => return None,
        };
        if self.state.bound() > 0.0 {
            most = most.min(most_trips(damping).floor());
        }
        if height.to_f64() <= bound || most < LEAST_LEAP || !clear(LEAST_LEAP) {
            return None;
        }
        let (mut low, mut high) = (LEAST_LEAP, 2.0 * LEAST_LEAP);
        while high < most && clear(high) {
            (low, high) = (high, 2.0 * high);
        }
        high = high.min(most);
        if clear(high) {
            low = high;
        }
        while high - low > 1.0 {
            let middle = (0.5 * (low + high)).floor();
            if clear(middle) { low = middle } else { high = middle }
        }
        Some(low as i64)
    }

    /// Computes B of [`Self::leap_length`] for `|q| ≤ most`.
    fn swing(&self, most: f64) -> f64 {
        let rho = self.damping() / (2.0 * std::f64::consts::PI);
        (0.5 * self.damping()).exp() * most * ((1.0 + rho) / (1.0 - rho) / 12.0).sqrt()
    }

    pub(super) fn leap(&mut self, trips: i64) {
        let from = self.state.time();
        let passing = self.medium.passing(&self.state);
        let before = (self.state.segments.len(), self.state.bound() + self.ground.to_f64().abs());
        let least = self.least_over(trips as f64);
        let count = self.medium.leap(&mut self.state, &self.ground, trips);
        self.prove(|proof, run| proof.leap(run, trips as f64, least, &count, before));
        self.budget.leap(trips as f64, LEAP_CELLS * self.cell_error, passing);
        (self.rising, self.last_trace) = (false, None);
        let len = from.int(trips);
        self.pieces.push(Piece { leap: trips, ..Piece::new(from, len, false, self.flight) });
        self.forget();
        self.add_chain();
        if let Some((height, _)) = self.centre() {
            self.height = height + self.medium.ground_of(&self.state);
        }
        self.budget.note_end(self.height_error(0.0));
    }

    /// Removes rays and vibrations below the truncation of a cell.
    fn forget(&mut self) {
        let most = self.state.bound();
        let least = self.medium.least() * self.medium.gravity.to_f64();
        if most > 0.0 && most <= least {
            self.budget.add(most);
            self.prove(|proof, _| proof.add(most));
            self.medium.still(&mut self.state);
        } else {
            let joined = self.medium.join_all(&mut self.state);
            self.budget.add(joined as f64 * self.cell_error);
            self.prove(|proof, run| proof.joins(run.medium, joined));
        }
    }

    /// Computes a lower bound of `v(0,·)` over `trips` round trips: the minimum of `h − B e^{−Rτ}`, which is concave or
    /// falls, as in [`Self::leap_length`], less a billionth of the terms of that difference.
    fn least_over(&self, trips: f64) -> f64 {
        let Some(flight) = self.flying() else { return f64::NEG_INFINITY };
        let (damping, gravity) = (self.damping(), self.medium.gravity.to_f64());
        let age = flight.age(&self.state);
        let (now, rate) = flight.at(&age);
        let bound = self.swing(self.state.bound());
        let later = flight.at(&(age.clone() + age.double(trips))).0.to_f64();
        let concave = rate.to_f64() >= -gravity / (2.0 * damping) * (1.0 - 1e-9);
        let (start, fade) = if concave { (now.to_f64(), (-damping * trips).exp()) } else { (f64::INFINITY, 1.0) };
        (start - bound).min(later - bound * fade) - 1e-9 * (now.to_f64().abs() + later.abs() + bound)
    }
}
