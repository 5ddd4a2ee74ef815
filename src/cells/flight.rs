//! Separation of a flight under a free top into the centre of mass and the vibration about it.
//!
//! `v = h(t) + z(x,t)` with `h″ + 2Rh′ = −g` alone, and `z` of mean zero with free ends. Two solutions w of the adjoint
//! equation that depend on t alone separate them on the characteristic `t = b + x`, `0 ≤ x ≤ ½`, that leaves the ground
//! at b. By Green's formula in the triangle between the characteristic and `t = b`, where `q = v_t + v_x`,
//!
//! ```text
//! h′(b) = 2 ∫ e^{2Rx} q + g x φ₁(2Rx) dx                      w = e^{2R(t−b)}
//! z(0,b) = −2 ∫ (½ − x − x φ₁(2Rx)) (q − h′(b + x)) dx          w = −(t−b) φ₁(2R(t−b))
//! ```
//!
//! The second formula makes the mean of z vanish, and holds on every characteristic of the flight: the height of the
//! end is never summed over round trips.

use super::march::{MOST_SEPARATED_DAMPING, Medium, State};
use super::series::{at_one, at_zero, integral, times_x};
use crate::special::{RoundedSpecial, phi1, phi2};

/// Motion of the centre of mass in a flight.
#[derive(Clone, Debug)]
pub(super) struct Flight<S> {
    /// Start of the flight: the number of whole round trips, and the fraction.
    pub(super) from: (i64, S),
    /// `h` at the start.
    pub(super) height: S,
    /// `h′` at the start.
    pub(super) rate: S,
    /// `2R`.
    drag: S,
    gravity: S,
}

impl<S: RoundedSpecial> Flight<S> {
    /// Returns the age of the flight when the characteristic of `state` leaves the ground.
    pub(super) fn age(&self, state: &State<S>) -> S {
        let at = &state.segments[0].at;
        at.clone() - &self.from.1 + at.int(state.round - self.from.0)
    }

    pub(super) fn age_at(&self, t: &S) -> S {
        t.clone() - t.int(self.from.0) - &self.from.1
    }

    /// Computes `h` and `h′` at an age.
    pub(super) fn at(&self, age: &S) -> (S, S) {
        let fall = -(self.drag.clone() * age);
        let drop = phi2(&fall) * &age.square() * &self.gravity;
        (phi1(&fall) * age * &self.rate + &self.height - drop, self.rate_at(age))
    }

    pub(super) fn rate_at(&self, age: &S) -> S {
        let fall = -(self.drag.clone() * age);
        fall.exp() * &self.rate - phi1(&fall) * age * &self.gravity
    }
}

impl<S: RoundedSpecial> Medium<S> {
    /// Computes `h` and `h′` over a strip of length `len`, as series, from their values at its beginning.
    ///
    /// The Taylor coefficients of `h′` are `c_{k+1} = −2R c_k/(k+1)`, after the second one, `−(g + 2Rh′)`.
    pub(super) fn rigid(&self, (height, rate): &(S, S), len: &S) -> (Vec<S>, Vec<S>) {
        let zero = len.zero();
        let drag = self.kappa.clone() * len.int(4);
        let mut taylor = vec![rate.clone(), -(drag.clone() * rate + &self.gravity) * len];
        let fall = drag * len;
        let (mut log2_term, mut k) = (0.0, 2i64);
        while log2_term > self.log2_accuracy - 2.0 && k < 1000 {
            let next = -(taylor[taylor.len() - 1].clone() * &fall) / len.int(k);
            taylor.push(next);
            log2_term += (fall.to_f64() / k as f64).log2();
            k += 1;
        }
        let mut series = vec![zero; self.basis.size()];
        for term in taylor.into_iter().rev() {
            times_x(&mut series);
            series[0] = series[0].clone() + term;
        }
        (self.basis.primitive(&series, len, height), series)
    }

    /// Returns whether flights are separated into centre of mass and vibration.
    pub(super) fn splits(&self) -> bool {
        self.free_top && 2.0 * self.kappa.to_f64() <= MOST_SEPARATED_DAMPING
    }

    /// Computes `2 ∫ f(x) q dx` over the characteristic, with `q` from the segments and `f` given at `x`.
    fn weighed(&self, state: &State<S>, weight: &dyn Fn(&S) -> S) -> S {
        let mut start = self.kappa.zero();
        let mut sum = start.clone();
        for segment in &state.segments {
            let depth = -(self.kappa.clone() * &segment.len);
            let weights = self.basis.nodes().iter().map(|node| {
                let x = (node.clone() * &segment.len + &start) * &start.ratio(1, 2);
                weight(&x) * &(node.clone() * &depth).exp()
            });
            let weights = self.basis.through(&weights.collect::<Vec<_>>(), self.basis.size());
            sum = sum + integral(&self.basis.product(&weights, &segment.q, self.basis.size())) * &segment.len;
            start = start + &segment.len;
        }
        sum
    }

    /// Computes `∫ w dq` of a vibration over a round trip, `w = e^{−κs} + κ(1 − s)`, by parts: the change of `∫y` of a
    /// contact of one round trip, per time by which the vibration comes earlier.
    pub(super) fn phase(&self, state: &State<S>) -> f64 {
        let (kappa, zero) = (self.kappa.to_f64(), self.kappa.zero());
        let last = &state.segments[state.segments.len() - 1];
        let after = (at_one(&last.q, &zero) * &last.decay).to_f64();
        let before = at_zero(&state.segments[0].q, &zero).to_f64();
        let weight = |x: &S| (-(self.kappa.int(2) * x * &self.kappa)).exp() * &self.kappa + &self.kappa;
        (-kappa).exp() * after - (1.0 + kappa) * before + self.weighed(state, &weight).to_f64()
    }

    /// Computes `z(0,b)` from the `q` of a vibration.
    pub(super) fn ground_of(&self, state: &State<S>) -> S {
        let drag = self.kappa.clone() * self.kappa.int(4);
        -self.weighed(state, &|x| x.ratio(1, 2) - x - phi1(&(drag.clone() * x)) * x)
    }

    /// Separates `q` of the deviation from the static state into centre of mass and vibration, with the end at
    /// `height`.
    pub(super) fn take_off(&self, state: &mut State<S>, height: &S) -> Flight<S> {
        let (zero, half) = (self.kappa.zero(), self.kappa.ratio(1, 2));
        let drag = self.kappa.clone() * self.kappa.int(4);
        // Adds v_x of the static state; `weight` below is the share of gravity in h′(b).
        self.shift(state, &|x| self.gravity.clone() * x + &self.slope);
        let grown = self.weighed(state, &|x| (drag.clone() * x).exp());
        // 2 ∫₀^½ x φ₁(2Rx) dx = ½ φ₂(R), as ∫₀ˣ y φ₁(ay) dy = x² φ₂(ax).
        let weight = phi2(&(drag.clone() * &half)) * &self.gravity * &half;
        let rate = grown + weight;
        let segment = &state.segments[0];
        let mut flight =
            Flight { from: (state.round, segment.at.clone()), height: zero, rate, drag, gravity: self.gravity.clone() };
        self.shift(state, &|x| -flight.rate_at(x));
        flight.height = height.clone() - self.ground_of(state);
        flight
    }

    /// Recombines centre of mass and vibration, at the present age of the flight.
    pub(super) fn touch_down(&self, state: &mut State<S>, flight: &Flight<S>) {
        let age = flight.age(state);
        let rate = flight.rate_at(&age);
        let now = Flight { rate, ..flight.clone() };
        self.shift(state, &|x| now.rate_at(x) - self.gravity.clone() * x - &self.slope);
    }

    /// Converts the state from one flight, or from the deviation from the static state, to another.
    pub(super) fn convert(&self, state: &mut State<S>, from: Option<&Flight<S>>, to: Option<&Flight<S>>) {
        if let Some(from) = from {
            self.touch_down(state, from);
        }
        if let Some(to) = to {
            let age = to.age(state);
            let now = Flight { rate: to.rate_at(&age), ..to.clone() };
            self.shift(state, &|x| self.gravity.clone() * x + &self.slope - now.rate_at(x));
        }
    }

    /// Adds a function of x to `q`.
    fn shift(&self, state: &mut State<S>, f: &dyn Fn(&S) -> S) {
        let mut start = self.kappa.zero();
        for segment in &mut state.segments {
            let depth = self.kappa.clone() * &segment.len;
            let values = self.basis.nodes().iter().map(|node| {
                let x = (node.clone() * &segment.len + &start) * &start.ratio(1, 2);
                f(&x) * &(node.clone() * &depth).exp()
            });
            let added = self.basis.through(&values.collect::<Vec<_>>(), segment.q.len());
            for (q, added) in segment.q.iter_mut().zip(added) {
                *q = q.clone() + added;
            }
            start = start + &segment.len;
        }
    }
}

#[cfg(test)]
#[path = "tests/flight.rs"]
mod tests;
