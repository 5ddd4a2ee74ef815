//! The closed forms for a caller who has decided which rays have arrived.

use super::bounce::{Bounce, Bracket, Found, Route};
use super::field::{Estimate, FirstContact};
use super::rebound::{Rebound, translational};
use crate::history::{Energy, Field};
use crate::number::Analytic;
use crate::special::confluent;

impl<S: Analytic> FirstContact<S> {
    /// The search for the bounce, up to a bracket.
    pub(crate) fn found(&self) -> Found<S> {
        self.search(&Route::Rays)
    }

    /// The root in a bracket.
    pub(crate) fn root_in(&self, bracket: Bracket<S>) -> Bounce<S> {
        self.refine(&Route::Rays, bracket)
    }

    /// What presses on the ground at `t/t₁`, with k returning rays: `−c v_x/(μ + μ₀)`.
    pub(crate) fn force_at(&self, trips: &S, k: i64) -> S {
        self.force(&Route::Rays, trips, k).0
    }

    /// The derivative of [`FirstContact::force_at`] by round trips: with `(e^{−rt}G_r)′ = e^{−rt}H_r`, and for each ray
    /// `(e^{−Rτ} ₀F₁(;1;y))′ = e^{−Rτ} (½R²τ ₀F₁(;2;y) − R ₀F₁(;1;y))`, `y = R²(τ² − j²)/4`.
    pub(crate) fn force_rate_at(&self, trips: &S, k: i64) -> S {
        let (r, total) = (&self.damping, self.rod.speed.clone() + &self.critical);
        let quarter = r.square() / r.int(4);
        let (mut kernel, mut rate) = (r.zero(), r.zero());
        for j in 0..=k {
            let y = (trips.clone() - r.int(j)) * &(trips.clone() + r.int(j)) * &quarter;
            let weight = r.int(if j == 0 { 1 } else { 2 } * if j % 2 == 0 { 1 } else { -1 });
            let start = confluent(&y, 0);
            rate = rate + (quarter.clone() * trips * &r.int(2) * confluent(&y, 1) - start.clone() * r) * &weight;
            kernel = kernel + start * weight;
        }
        let fade = (-(r.clone() * trips)).exp();
        (rate * &self.rod.speed + kernel * &self.critical) * fade / total
    }

    /// `v_x(0,t)` at `t/t₁`, with k returning rays.
    pub(crate) fn stress_at(&self, trips: &S, k: i64) -> S {
        self.combine(&self.ground(trips, k), &(-(trips.one() / &self.rod.wave_speed))).value
    }

    /// `v`, `v_t`, `v_x` at the travel time `a t₁` from the ground, with so many rays `arrived`, upwards and downwards.
    pub(crate) fn field_at(&self, a: &S, trips: &S, arrived: [i64; 2]) -> Option<Field<S>> {
        let [value, rate, slope] = self.field_of(a, trips, |j, _, down| j < arrived[usize::from(down)])?;
        let one = trips.one();
        Some(Field {
            displacement: self.combine(&value, &self.round_trip).value,
            velocity: self.combine(&rate, &one).value,
            strain: self.combine(&slope, &(one / &self.rod.wave_speed)).value,
        })
    }

    /// `E`, `E_h`, `E_z` at `t/t₁`.
    pub(crate) fn energy_at(&self, trips: &S) -> Option<Energy<S>> {
        let [height, rate] = self.centre_parts(trips)?;
        let (centre, velocity) = (self.combine(&height, &self.round_trip), self.combine(&rate, &trips.one()));
        let translational = translational(&self.rod, &centre, &velocity).value;
        let vibrational = self.vibrational_enclosed(trips)?;
        Some(Energy { total: translational.clone() + &vibrational, translational, vibrational })
    }

    /// `E_z` at `t/t₁`. In enclosures the rest of the quadrature is a width; nothing is known where `None`.
    fn vibrational_enclosed(&self, trips: &S) -> Option<S> {
        let scale = (self.rod.speed.to_f64() + self.critical.to_f64()).powi(2);
        let (n, _) = self.nodes(trips, scale);
        let mut value = self.enclosed_by(trips, n)?;
        let size = value.to_f64().abs() / self.rod.length.to_f64();
        let (more, _) = self.nodes(trips, size.max(1e-290 * scale));
        if more > n {
            value = self.enclosed_by(trips, more)?;
        }
        Some(value)
    }

    /// The integral with n nodes between two rays, and its rest, which is below `5 L A² ρ^{−2n}/(1 − ρ⁻²)` for every ρ, see
    /// `nodes`; one part in a thousand more is for the doubles in it.
    fn enclosed_by(&self, trips: &S, n: usize) -> Option<S> {
        let least = self.ellipses(trips).map(|[log, step]| log - n as f64 * step).fold(f64::INFINITY, f64::min);
        let rest = trips.double(least + 1e-3).exp() * &self.rod.length;
        Some(self.integrate(trips, n)?.value.widened(&rest))
    }

    /// `h` and `h′` at `t/t₁`.
    pub(crate) fn motion_at(&self, trips: &S) -> Option<(S, S)> {
        let [height, rate] = self.centre_parts(trips)?;
        Some((self.combine(&height, &self.round_trip).value, self.combine(&rate, &trips.one()).value))
    }

    /// The flight after a bounce at `time`, with this motion of the centre.
    pub(crate) fn flight_from(&self, time: &S, (centre, velocity): (S, S)) -> Rebound<S> {
        let known = |value: S| Estimate { value, error: 0.0 };
        Rebound { time: time.clone(), centre: known(centre), velocity: known(velocity), rod: self.rod.clone() }
    }
}
