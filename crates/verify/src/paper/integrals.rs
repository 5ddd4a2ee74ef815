//! The paper's integrals as printed, by adaptive quadrature: the program that a reader would write from the page.
//!
//! The closed forms share no code with it: I₀ is the integral (2.16), not a series; the extended data are a square
//! wave; integrals nest as deep as in print, three for an energy.

use super::quadrature::Quadrature;
use dalembert::problem::Parameters;

/// The first contact by (2.22)–(2.28), (3.38), (3.39) and (3.54), and the flight by (3.43), (3.44), as printed, in
/// doubles.
///
/// **Source**: as named at each method; the reflected data of (2.13) are a square wave, and every integral is cut where
/// it jumps.
///
/// **Units**: any consistent units; momenta and energies are per linear density.
///
/// **Accuracy**: an *f64 estimate*, from quadrature to about `tolerance` of what each integral weighs. Nothing is
/// proved.
///
/// ```
/// # use dalembert::Parameters;
/// # use dalembert_verify::paper::PrintedIntegrals;
/// // r = 0: the stress in the first round trip is −(μ + gt)/c.
/// let rod = Parameters { length: 1.0, wave_speed: 1.0, damping: 0.0, gravity: 1.0, speed: 3.0 };
/// assert!((PrintedIntegrals::new(&rod, 1e-10).strain(1.0) + 4.0).abs() < 1e-14);
/// ```
#[derive(Debug)]
pub struct PrintedIntegrals {
    l: f64,
    c: f64,
    r: f64,
    g: f64,
    mu: f64,
    quadrature: Quadrature,
}

impl PrintedIntegrals {
    /// Prepares the integrals of `rod`, to be computed to `tolerance`.
    pub fn new(rod: &Parameters<f64>, tolerance: f64) -> Self {
        let Parameters { length: l, wave_speed: c, damping: r, gravity: g, speed: mu } = *rod;
        PrintedIntegrals { l, c, r, g, mu, quadrature: Quadrature::new(tolerance) }
    }

    /// Sets a deadline `seconds` from now, after which integrals are cut short, see [`PrintedIntegrals::is_late`].
    pub(crate) fn limited_to(mut self, seconds: f64) -> Self {
        self.quadrature = self.quadrature.limited_to(seconds);
        self
    }

    /// Returns whether the deadline of [`PrintedIntegrals::limited_to`] has cut an integral short.
    pub(crate) fn is_late(&self) -> bool {
        self.quadrature.is_late()
    }

    fn integral(&self, a: f64, b: f64, cuts: &[f64], f: &dyn Fn(f64) -> f64) -> f64 {
        self.quadrature.integral([a, b], cuts, 0.0, f)
    }

    /// Returns the symmetric extension of 1 at `y`.
    fn sign(&self, y: f64) -> f64 {
        if (y / (2.0 * self.l)).floor() as i64 % 2 == 0 { 1.0 } else { -1.0 }
    }

    /// Returns the jumps of the extended data within `reach` of the origin.
    fn lattice(&self, reach: f64) -> Vec<f64> {
        let most = (reach / (2.0 * self.l)).ceil() as i64 + 1;
        (-most..=most).map(|k| 2.0 * self.l * k as f64).collect()
    }

    /// Returns `t₁`.
    fn round_trip(&self) -> f64 {
        2.0 * self.l / self.c
    }

    /// Returns `t₁, 2t₁, …` up to `t`.
    fn trips(&self, t: f64) -> Vec<f64> {
        let t1 = self.round_trip();
        (1..=(t / t1).ceil() as i64).map(|k| k as f64 * t1).collect()
    }

    /// Computes `∫_{x−cτ}^{x+cτ} kernel(λs, x − y) 1^e(y) dy`.
    fn cone(&self, x: f64, tau: f64, kernel: &dyn Fn(f64, f64) -> f64) -> f64 {
        let lambda = self.r / self.c;
        let ct = self.c * tau;
        self.integral(x - ct, x + ct, &self.lattice(x + ct), &|y| {
            let s = (ct * ct - (x - y) * (x - y)).max(0.0).sqrt();
            kernel(lambda * s, x - y) * self.sign(y)
        })
    }

    /// Computes `∫₀ᵗ f(τ) dτ`, cut where the cone meets the lattice.
    fn duhamel(&self, x: f64, t: f64, f: &dyn Fn(f64) -> f64) -> f64 {
        if self.g == 0.0 {
            return 0.0;
        }
        let cuts: Vec<f64> = self.lattice(x + self.c * t).iter().map(|y| (y - x).abs() / self.c).collect();
        // On the ground the cone cancels by symmetry, up to rounding.
        let noise = 16.0 * f64::EPSILON * self.g * t * self.c * t * (self.r * t).exp() * i0(self.r * t);
        self.quadrature.integral([0.0, t], &cuts, noise, f)
    }

    /// Computes `v`, `v_t`, `v_x` at `(x,t)`, with the limits from later times on a ray.
    ///
    /// **Source**: (2.24), (2.23), (2.22), as the appendix combines them.
    pub fn field(&self, x: f64, t: f64) -> [f64; 3] {
        let PrintedIntegrals { c, r, g, mu, .. } = *self;
        let lambda = r / c;
        let source = |tau: f64| -g * (r * (t - tau)).exp();
        let kernel = |z: f64, _: f64| i0(z);
        let force = |tau: f64| source(tau) * self.cone(x, tau, &kernel);
        let (fallen, forced) = (self.cone(x, t, &kernel), self.duhamel(x, t, &force));
        let w = (-mu * fallen + forced) / (2.0 * c);
        let (ahead, behind) = (self.sign(x + c * t), self.sign(x - c * t));
        let tilt = |z: f64, d: f64| lambda * lambda * i1_over_z(z) * d;
        let edge = |tau: f64| source(tau) * (self.sign(x + c * tau) - self.sign(x - c * tau));
        let inner = |tau: f64| source(tau) * self.cone(x, tau, &tilt);
        let w_x = (-mu * (ahead - behind) + mu * self.cone(x, t, &tilt) + self.duhamel(x, t, &edge)
            - self.duhamel(x, t, &inner))
            / (2.0 * c);
        let spread = |z: f64, _: f64| r * t * lambda * i1_over_z(z);
        let w_t = -0.5 * mu * (ahead + behind) - 0.5 * mu * self.cone(x, t, &spread) - g * fallen / (2.0 * c)
            + r * forced / (2.0 * c);
        let decay = (-r * t).exp();
        [decay * w, decay * (w_t - r * w), decay * w_x]
    }

    /// Computes `H_r(t)`. **Source**: (2.27), with the k of (2.26) from a division.
    pub fn impact_kernel(&self, t: f64) -> f64 {
        let t1 = self.round_trip();
        let ray = |j: i64| {
            let lag = j as f64 * t1;
            let sign = if j % 2 == 0 { 2.0 } else { -2.0 };
            sign * i0(self.r * (t * t - lag * lag).max(0.0).sqrt())
        };
        let rays = (t / t1).floor() as i64;
        i0(self.r * t) + (1..=rays).map(ray).sum::<f64>()
    }

    /// Computes `Ψ_r(t)`. **Source**: (2.28).
    fn psi(&self, t: f64) -> f64 {
        let history = if self.g == 0.0 {
            0.0
        } else {
            self.integral(0.0, t, &self.trips(t), &|tau| (self.r * (t - tau)).exp() * self.impact_kernel(tau))
        };
        -self.mu / self.c * self.impact_kernel(t) - self.g / self.c * history
    }

    /// Computes `v_x(0,t) = e^{−rt} Ψ_r(t)`, the limit from later times. **Source**: (2.28).
    pub fn strain(&self, t: f64) -> f64 {
        (-self.r * t).exp() * self.psi(t)
    }

    /// Computes `P(t)` in contact. **Source**: (3.38), with `t` for `(1 − e^{−2rt})/2r` where `r = 0`.
    pub fn momentum(&self, t: f64) -> f64 {
        let PrintedIntegrals { l, c, r, g, mu, .. } = *self;
        let push = self.integral(0.0, t, &self.trips(t), &|tau| (r * tau).exp() * self.psi(tau));
        let lost = (-2.0 * r * t).exp();
        let fallen = if r == 0.0 { t } else { (1.0 - lost) / (2.0 * r) };
        -c * c * lost * push - g * l * fallen - mu * l * lost
    }

    /// Computes `P(t)` in the flight that begins at `release`, `r ≠ 0`. **Source**: (3.43).
    pub(crate) fn flight_momentum(&self, release: f64, t: f64) -> f64 {
        let limit = self.g * self.l / (2.0 * self.r);
        (self.momentum(release) + limit) * (-2.0 * self.r * (t - release)).exp() - limit
    }

    /// Computes `∫₀ᴸ f(v, v_t, v_x) dx`, cut at the ray inside.
    fn over_rod(&self, t: f64, f: impl Fn([f64; 3]) -> f64) -> f64 {
        let ray = (self.c * t) % (2.0 * self.l);
        self.integral(0.0, self.l, &[ray, 2.0 * self.l - ray], &|x| f(self.field(x, t)))
    }

    /// Computes `h(t)` in contact. **Source**: (3.39), the mean of (2.24).
    pub fn centre(&self, t: f64) -> f64 {
        self.over_rod(t, |[v, _, _]| v) / self.l
    }

    /// Computes `h(t)` in the flight that begins at `release`, `r ≠ 0`. **Source**: (3.44).
    pub(crate) fn flight_centre(&self, release: f64, t: f64) -> f64 {
        let PrintedIntegrals { l, r, g, .. } = *self;
        let (h0, h1, since) = (self.centre(release), self.momentum(release) / l, t - release);
        let lost = (-2.0 * r * since).exp();
        (h1 + 2.0 * r * h0 - g * since - h1 * lost) / (2.0 * r) + g / (4.0 * r * r) * (1.0 - lost)
    }

    /// Computes `E(t)`. **Source**: (3.54): three integrals, one in the other.
    pub(crate) fn energy(&self, t: f64) -> f64 {
        self.over_rod(t, |[v, v_t, v_x]| 0.5 * (v_t * v_t + self.c * self.c * v_x * v_x) + self.g * v)
    }

    /// Computes the right-hand side of (2.32): the least μ that bounces at `t₁`.
    pub(crate) fn threshold(&self) -> f64 {
        let (t1, r) = (self.round_trip(), self.r);
        let weight = self.integral(0.0, t1, &[], &|tau| (r * (t1 - tau)).exp() * i0(r * tau));
        self.g * weight / (2.0 - i0(r * t1))
    }
}

/// Computes `I₀(z)` by the integral (2.16). **Accuracy**: within a few roundings.
pub(crate) fn i0(z: f64) -> f64 {
    period(z, |_| 1.0)
}

/// Computes `I₁(z)/z` by the same integral, integrated by parts. **Accuracy**: within a few roundings.
fn i1_over_z(z: f64) -> f64 {
    period(z, |angle| angle.sin().powi(2))
}

/// Computes the mean of `weight(θ) cosh(z cos θ)` over a period by the trapezoidal rule, which converges geometrically.
fn period(z: f64, weight: impl Fn(f64) -> f64) -> f64 {
    // The rule leaves 2 I_{2n}(z): below a roundoff of I₀ for all z.
    let n = 12 + (2.0 * z.sqrt() + 0.6 * z) as i32;
    let point = |k: i32| {
        let angle = std::f64::consts::PI * f64::from(k) / f64::from(n);
        weight(angle) * (z * angle.cos()).cosh()
    };
    (0..n).map(point).sum::<f64>() / f64::from(n)
}

#[cfg(test)]
#[path = "tests/integrals.rs"]
mod tests;
