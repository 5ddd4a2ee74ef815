//! The energies during the first contact: `E_z` as a sum of squares, by Gauss–Legendre between the rays.

use super::field::{Estimate, FirstContact, Parts};
use super::rebound::translational;
use crate::history::{Energy, Side};
use crate::number::Analytic;
use crate::special::gauss_legendre;

/// One node: travel time, weight in `∫ da`, `v_t − h′`, `c v_x`.
struct Node<S> {
    weight: S,
    deviation: Estimate<S>,
    strain: Estimate<S>,
}

/// Most nodes between two rays; only damping far beyond `r t₁ = 100` could ask for more.
const MOST_NODES: usize = 4000;

impl<S: Analytic> FirstContact<S> {
    /// `E`, `E_h`, `E_z` at a time of the contact, and a bound for the error of each.
    ///
    /// **Source**: (3.54), (3.61)–(3.63), with `E_z = ½∫((v_t − h′)² + c²v_x²)dx`, so that `E_z ≪ E` keeps its digits.
    ///
    /// **Accuracy**: the bounds hold rounding and quadrature. At `t₁` and `R ≤ 1` the parts of `v_t` and `v_x` that
    /// do not depend on x are left out before they are added up, and `E_z` is relatively accurate however small; at
    /// other times its error is that of `v_t` and `v_x`, which are known to a part of `μ + μ₀`.
    ///
    /// ```
    /// # use dalembert::{rod::Parameters, first_contact::FirstContact};
    /// // r = 0, μ ≥ μ₀ = 2: E_z(t₁) = μ₀² L/6.
    /// let rod = Parameters { length: 1.0, wave_speed: 1.0, damping: 0.0, gravity: 1.0, speed: 1e6 };
    /// let (energy, _) = FirstContact::new(&rod).energy(&2.0);
    /// assert!((energy.vibrational - 2.0_f64 / 3.0).abs() < 1e-14);
    /// ```
    pub fn energy(&self, time: &S) -> (Energy<S>, [f64; 3]) {
        let trips = self.trips(time);
        let (centre, velocity) = self.centre_at(&trips);
        let translational = translational(&self.rod, &centre, &velocity);
        let vibrational = self.vibrational(&trips);
        let total = translational.value.clone() + &vibrational.value;
        let errors = [translational.error + vibrational.error, translational.error, vibrational.error];
        (Energy { total, translational: translational.value, vibrational: vibrational.value }, errors)
    }

    /// `E_h(t)/E(t)` and `E(t)/E(0)`: the factors of `e_E²` at `t = t_b`.
    ///
    /// **Source**: (4.73).
    ///
    /// **Errors**: `None` where `μ = 0`.
    pub fn restitution_factors(&self, time: &S) -> Option<(S, S)> {
        if self.rod.speed.is_zero() {
            return None;
        }
        let (energy, _) = self.energy(time);
        let start = self.rod.speed.square() * &self.rod.length / self.rod.speed.int(2);
        Some((energy.translational / &energy.total, energy.total / &start))
    }

    /// `E_z` at `t/t₁`.
    fn vibrational(&self, trips: &S) -> Estimate<S> {
        let unknown = || Estimate { value: trips.zero(), error: f64::INFINITY };
        let scale = (self.rod.speed.to_f64() + self.critical.to_f64()).powi(2);
        // Twice at most: with the number of nodes for an energy of natural size, and with the one for what is found.
        let mut size = scale;
        let mut result = unknown();
        let mut used = 0;
        for _ in 0..3 {
            let (n, rest) = self.nodes(trips, size);
            if n > used {
                used = n;
                let Some(found) = self.integrate(trips, n) else { return unknown() };
                result = found;
            }
            let length = self.rod.length.to_f64();
            size = (result.value.to_f64() / length).max(1e-290 * scale);
            if n >= used && n < MOST_NODES && self.nodes(trips, size).0 <= used {
                result.error += rest * length;
                break;
            }
        }
        result
    }

    /// The number of nodes that leave less than a roundoff of `size` between two rays, and what they leave.
    ///
    /// n nodes on an interval of half-width w leave less than `(64/15) w M ρ^{−2n}/(1 − ρ⁻²)`, where M bounds the
    /// integrand on the Bernstein ellipse ρ, which reaches `δ = (ρ − 1/ρ)w/2` beyond an interval of half-width w.
    pub(super) fn nodes(&self, trips: &S, size: f64) -> (usize, f64) {
        let goal = self.damping.log2_roundoff() * std::f64::consts::LN_2 + size.max(f64::MIN_POSITIVE).ln();
        let best = self.ellipses(trips).map(|[log, step]| (log - goal) / step).fold(f64::INFINITY, f64::min);
        ((best.ceil().clamp(2.0, MOST_NODES as f64)) as usize, goal.exp())
    }

    /// The logarithms of that bound without nodes, and of what each node takes off, for some ρ.
    pub(super) fn ellipses(&self, trips: &S) -> impl Iterator<Item = [f64; 2]> {
        let tau = trips.to_f64();
        let (mu, mu0) = (self.rod.speed.to_f64(), self.critical.to_f64());
        [1.1f64, 1.25, 1.5, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0].into_iter().map(move |rho| {
            // No ray has come farther than a = τ, and where none has been the integrand does not depend on a.
            let beyond = (rho - 1.0 / rho) / 2.0 * (tau / 2.0).min(0.25);
            let amplitude = self.amplitude(tau, beyond, mu, mu0);
            let log = 2.0 * amplitude.ln() + (5.0 / (1.0 - 1.0 / (rho * rho))).ln();
            [log, 2.0 * rho.ln()]
        })
    }

    /// The integral with n nodes between two rays.
    pub(super) fn integrate(&self, trips: &S, n: usize) -> Option<Estimate<S>> {
        let nodes = self.sample(trips, n)?;
        let mut sum = trips.zero();
        let mut error = 0.0;
        for node in nodes {
            let (z, s) = (node.deviation.value.to_f64().abs(), node.strain.value.to_f64().abs());
            let each = z * node.deviation.error + s * node.strain.error;
            error += node.weight.to_f64() * (2.0 * each + self.bound((n as f64 + 16.0) * (z * z + s * s)));
            sum = sum + (node.deviation.value.square() + node.strain.value.square()) * &node.weight;
        }
        // dx = c t₁ da = 2L da.
        let value = sum * &self.rod.length;
        Some(Estimate { value, error: error * self.rod.length.to_f64() })
    }

    fn sample(&self, trips: &S, n: usize) -> Option<Vec<Node<S>>> {
        let rule = gauss_legendre(trips, n);
        let half = trips.ratio(1, 2);
        let fraction = trips.clone() - trips.int(trips.floor_int()?);
        let cut = if fraction > half { trips.one() - fraction } else { fraction };
        let mut places = Vec::new();
        for (from, to) in [(trips.zero(), cut.clone()), (cut, half.clone())] {
            let width = to - &from;
            if width.is_positive() {
                let mid = width.clone() / width.int(2);
                places.extend(rule.iter().map(|(x, w)| (mid.clone() * &(x.one() + x) + &from, w.clone() * &mid)));
            }
        }
        if !S::RIGOROUS && *trips == trips.one() && self.damping <= trips.one() {
            return self.sample_first_return(&places);
        }
        let [_, centre] = self.centre_parts(trips)?;
        let one = trips.one();
        let nodes = places.into_iter().map(|(a, weight)| {
            let [_, rate, slope] = self.field_parts(&a, trips, Side::Right)?;
            let deviation = self.combine(&difference(&rate, &centre), &one);
            Some(Node { weight, deviation, strain: self.combine(&slope, &one) })
        });
        nodes.collect()
    }

    /// At `t₁`, for R ≤ 1: the impact's share without what is the same along the rod.
    ///
    /// Two rays are there, `ξ = 1 ∓ a` and `ξ + η = 2`. In powers of R, `∂_tU₁ − RU₁ = 1 − Rξ + R²ξ/2 + T₃(ξ)`, and
    /// the first three add up to a constant; `T₃` is of order R³, `I₀ − 1` of order R². What is left has no
    /// cancellation but its own zeros.
    fn sample_first_return(&self, places: &[(S, S)]) -> Option<Vec<Node<S>>> {
        let trips = self.damping.one();
        let [_, centre] = self.centre_parts(&trips)?;
        let damp = (-self.damping.clone()).exp();
        let rest: Vec<S> =
            places.iter().map(|(a, _)| self.third_order(a) + self.third_order(&(trips.clone() - a))).collect();
        let mut mean = trips.zero();
        for ((_, weight), value) in places.iter().zip(&rest) {
            mean = mean + weight.clone() * &trips.int(2) * value;
        }
        let mut nodes = Vec::with_capacity(places.len());
        for ((a, weight), value) in places.iter().zip(rest) {
            let [_, mut rate, mut slope] = self.field_parts(a, &trips, Side::Right)?;
            let size = value.to_f64().abs() + mean.to_f64().abs();
            rate = difference(&rate, &centre);
            rate.impact.value = (value - &mean) * &damp;
            rate.impact.roundings = 200.0 * size;
            let (near, far) = (self.bessel_rest(a), self.bessel_rest(&(trips.clone() - a)));
            slope.impact.roundings = 100.0 * (near.to_f64() + far.to_f64());
            slope.impact.value = (far - near) * &damp;
            let (deviation, strain) = (self.combine(&rate, &trips), self.combine(&slope, &trips));
            nodes.push(Node { weight: weight.clone(), deviation, strain });
        }
        Some(nodes)
    }

    /// `I₀(R√(1−a²)) − 1`, for R ≤ 1: terms fall at least fourfold, so the sum ends when one is a roundoff of it.
    fn bessel_rest(&self, a: &S) -> S {
        let square = (a.one() - a) * &(a.one() + a) * &self.damping.square() / a.int(4);
        let terms = (-a.log2_roundoff() / 2.0) as i64 + 2;
        let mut term = a.one();
        let mut sum = a.zero();
        for m in 1..=terms {
            term = term * &square / a.int(m * m);
            let before = sum.clone();
            sum = sum + &term;
            if sum == before {
                break;
            }
        }
        sum
    }

    /// `T₃(a) = Σ_{p≥3} (R/2)^p Σ_{n+2m=p} ±{1,2} ξ^{n+m}η^m/(m!(n+m)!)`, with `ξ = 1 − a`, `η = 1 + a`.
    ///
    /// The terms of order p are at most `R^p/p!` together, since `Σ_ℤ qⁿIₙ = e^R`; the sum ends where that is a
    /// roundoff of R³/48, and each order is one polynomial in ξ, η by Horner in η/ξ-free form.
    fn third_order(&self, a: &S) -> S {
        let (xi, eta) = (a.one() - a, a.one() + a);
        let half = self.damping.clone() / a.int(2);
        let reach = self.damping.to_f64().max(1e-30);
        // x[k] = (Rξ/2)^k/k!, y[k] = (Rη/2)^k/k!: the term is x[n+m] y[m].
        let (step_x, step_y) = (half.clone() * &xi, half * &eta);
        let goal = a.log2_roundoff() - 8.0;
        let (mut orders, mut log) = (3i64, 0.0f64);
        while log > goal {
            orders += 1;
            log += (reach / orders as f64).log2();
        }
        let powers = |step: &S| {
            let mut list = vec![a.one()];
            for k in 1..=orders {
                let next = step.clone() * &list[list.len() - 1] / a.int(k);
                list.push(next);
            }
            list
        };
        let (x, y) = (powers(&step_x), powers(&step_y));
        let mut sum = a.zero();
        for p in (3..=orders).rev() {
            let mut order = a.zero();
            for m in 0..=p / 2 {
                let n = p - 2 * m;
                let term = x[(n + m) as usize].clone() * &y[m as usize];
                order = order + if n == 0 { term } else { term * &a.int(2) };
            }
            sum = if p % 2 == 0 { sum + &order } else { sum - &order };
        }
        sum
    }
}

/// `a − b`, part by part.
fn difference<S: Analytic>(a: &Parts<S>, b: &Parts<S>) -> Parts<S> {
    let mut result = a.clone();
    for (to, from) in [(&mut result.impact, &b.impact), (&mut result.weight, &b.weight)] {
        to.value = to.value.clone() - &from.value;
        to.roundings += from.roundings + 2.0 * from.value.to_f64().abs();
    }
    result
}
