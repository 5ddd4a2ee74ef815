//! The closed forms against the paper's own integrals, done by quadrature that shares no code with the crate.
#![allow(clippy::unwrap_used)]

use dalembert::first_contact::FirstContact;
use dalembert::history::Side;
use dalembert::rod::Parameters;

/// Five-point Gauss rule.
const RULE: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// `∫ f` over `[a,b]`, cut at `cuts` and into panels.
fn integral(a: f64, b: f64, cuts: &[f64], panels: u32, f: impl Fn(f64) -> f64) -> f64 {
    let mut ends: Vec<f64> = cuts.iter().copied().filter(|c| a < *c && *c < b).chain([a, b]).collect();
    ends.sort_by(f64::total_cmp);
    let piece = |lo: f64, hi: f64| {
        let w = (hi - lo) / f64::from(panels);
        let panel = |k: u32| {
            let mid = lo + w * (f64::from(k) + 0.5);
            RULE.iter().map(|(x, weight)| weight * f(mid + 0.5 * w * x)).sum::<f64>() * 0.5 * w
        };
        (0..panels).map(panel).sum::<f64>()
    };
    ends.windows(2).map(|e| piece(e[0], e[1])).sum()
}

/// (2.16): the trapezoidal rule over a period.
fn i0(z: f64) -> f64 {
    let n = 24;
    (0..n).map(|k| (z * (std::f64::consts::PI * f64::from(k) / f64::from(n)).cos()).cosh()).sum::<f64>() / f64::from(n)
}

/// `I₁(z)/z`, from the same integral by parts.
fn i1_over_z(z: f64) -> f64 {
    let n = 24;
    let point = |k: i32| {
        let angle = std::f64::consts::PI * f64::from(k) / f64::from(n);
        angle.sin().powi(2) * (z * angle.cos()).cosh()
    };
    (0..n).map(point).sum::<f64>() / f64::from(n)
}

struct Paper {
    l: f64,
    c: f64,
    r: f64,
    g: f64,
    mu: f64,
}

impl Paper {
    /// The symmetric extension of 1.
    fn sign(&self, y: f64) -> f64 {
        if (y / (2.0 * self.l)).floor() as i64 % 2 == 0 { 1.0 } else { -1.0 }
    }

    fn lattice(&self) -> Vec<f64> {
        (-12..=12).map(|k| 2.0 * self.l * f64::from(k)).collect()
    }

    /// `∫_{x−cτ}^{x+cτ} kernel(λs, x − y) 1^e(y) dy`.
    fn cone(&self, x: f64, tau: f64, kernel: impl Fn(f64, f64) -> f64) -> f64 {
        let lambda = self.r / self.c;
        let ct = self.c * tau;
        integral(x - ct, x + ct, &self.lattice(), 3, |y| {
            let s = (ct * ct - (x - y) * (x - y)).max(0.0).sqrt();
            kernel(lambda * s, x - y) * self.sign(y)
        })
    }

    /// `∫₀ᵗ f(τ) dτ`, cut where the cone meets the lattice.
    fn duhamel(&self, x: f64, t: f64, f: impl Fn(f64) -> f64) -> f64 {
        let cuts: Vec<f64> = self.lattice().iter().map(|y| (y - x).abs() / self.c).collect();
        integral(0.0, t, &cuts, 3, f)
    }

    /// v from (2.24), `v_x` from (2.22), `v_t` from (2.23), as the appendix combines them.
    fn field(&self, x: f64, t: f64) -> [f64; 3] {
        let Paper { c, r, g, mu, .. } = *self;
        let lambda = r / c;
        let source = |tau: f64| -g * (r * (t - tau)).exp();
        let i0_kernel = |z: f64, _: f64| i0(z);
        let force = |tau: f64| source(tau) * self.cone(x, tau, i0_kernel);
        let w = (-mu * self.cone(x, t, i0_kernel) + self.duhamel(x, t, force)) / (2.0 * c);
        let (ahead, behind) = (self.sign(x + c * t), self.sign(x - c * t));
        let tilt = |z: f64, d: f64| lambda * lambda * i1_over_z(z) * d;
        let edge = |tau: f64| source(tau) * (self.sign(x + c * tau) - self.sign(x - c * tau));
        let inner = |tau: f64| source(tau) * self.cone(x, tau, tilt);
        let w_x = (-mu * (ahead - behind) + mu * self.cone(x, t, tilt) + self.duhamel(x, t, edge)
            - self.duhamel(x, t, inner))
            / (2.0 * c);
        let spread = |z: f64, _: f64| r * t * lambda * i1_over_z(z);
        let w_t = -0.5 * mu * (ahead + behind)
            - 0.5 * mu * self.cone(x, t, spread)
            - g * self.cone(x, t, i0_kernel) / (2.0 * c)
            + r * self.duhamel(x, t, force) / (2.0 * c);
        let decay = (-r * t).exp();
        [decay * w, decay * (w_t - r * w), decay * w_x]
    }

    /// (2.27).
    fn h_r(&self, t: f64) -> f64 {
        let t1 = 2.0 * self.l / self.c;
        let ray = |j: i32| {
            let lag = f64::from(j) * t1;
            if lag > t { 0.0 } else { 2.0 * f64::from((-1i32).pow(j as u32)) * i0(self.r * (t * t - lag * lag).sqrt()) }
        };
        i0(self.r * t) + (1..12).map(ray).sum::<f64>()
    }

    fn trips(&self) -> Vec<f64> {
        (1..12).map(|k| f64::from(k) * 2.0 * self.l / self.c).collect()
    }

    /// (2.28).
    fn psi(&self, t: f64) -> f64 {
        let history = integral(0.0, t, &self.trips(), 4, |tau| (self.r * (t - tau)).exp() * self.h_r(tau));
        -self.mu / self.c * self.h_r(t) - self.g / self.c * history
    }

    /// (3.38).
    fn momentum(&self, t: f64) -> f64 {
        let Paper { l, c, r, g, mu } = *self;
        let push = integral(0.0, t, &self.trips(), 4, |tau| (r * tau).exp() * self.psi(tau));
        let lost = (-2.0 * r * t).exp();
        -c * c * lost * push - g * l / (2.0 * r) * (1.0 - lost) - mu * l * lost
    }
}

#[test]
fn closed_forms_are_the_paper_s_integrals() {
    for paper in [
        Paper { l: 1.0, c: 1.5, r: 0.7, g: 0.9, mu: 1.3 },
        Paper { l: 0.5, c: 1.0, r: 2.6, g: 0.0, mu: 1.0 },
        Paper { l: 2.0, c: 1.0, r: 0.05, g: 3.0, mu: 0.2 },
    ] {
        let Paper { l, c, r, g, mu } = paper;
        let contact = FirstContact::new(&Parameters { length: l, wave_speed: c, damping: r, gravity: g, speed: mu });
        let t1 = 2.0 * l / c;
        let speed = mu + g * t1;
        for trips in [0.13, 0.71, 1.37, 2.62] {
            let t = trips * t1;
            for part in [0.0, 0.21, 0.83, 1.0] {
                let x = part * l;
                let (field, errors) = contact.field(&x, &t, Side::Right);
                let truth = paper.field(x, t);
                let found = [field.displacement, field.velocity, field.strain];
                for (k, scale) in [speed * t1, speed, speed / c].into_iter().enumerate() {
                    let wrong = (found[k] - truth[k]).abs();
                    assert!(wrong < 1e-11 * scale, "r = {r}, x = {x}, t = {t}, {k}: {} {}", found[k], truth[k]);
                    assert!(errors[k] < 1e-12 * scale, "{k} {}", errors[k]);
                }
            }
            let stress = contact.stress(&t, Side::Right).value;
            let truth = (-r * t).exp() * paper.psi(t);
            assert!((stress - truth).abs() < 1e-11 * speed / c, "r = {r}, t = {t}: {stress} {truth}");
            let kernel = contact.impact_kernel(&t, Side::Right).value;
            assert!((kernel - (-r * t).exp() * paper.h_r(t)).abs() < 1e-12);
            let (height, velocity) = contact.centre(&t);
            let momentum = paper.momentum(t);
            assert!((velocity.value * l - momentum).abs() < 1e-10 * speed * l, "{} {momentum}", velocity.value * l);
            // (3.39), as the mean of (2.24): cut at the one ray inside.
            let ray = (c * t) % (2.0 * l);
            let cuts = [ray, 2.0 * l - ray];
            let mean = integral(0.0, l, &cuts, 2, |x| paper.field(x, t)[0]) / l;
            assert!((height.value - mean).abs() < 1e-10 * speed * t1, "{} {mean}", height.value);
        }
    }
}

/// Both limits on a ray, and Proposition 2: `[v_x] = e^{−rt} [φᵉ]/2c` along each characteristic.
#[test]
fn jumps_are_those_of_proposition_2() {
    let (r, mu) = (0.4f64, 1.7f64);
    let contact = FirstContact::new(&Parameters { length: 1.0, wave_speed: 1.0, damping: r, gravity: 0.6, speed: mu });
    // At the ground both families cross: a jump of 2μ/c at t₁, upwards; downwards at 2t₁.
    for (t, sign) in [(2.0f64, 1.0), (4.0, -1.0), (6.0, 1.0)] {
        let jump = contact.stress(&t, Side::Right).value - contact.stress(&t, Side::Left).value;
        assert!((jump - sign * 2.0 * mu * (-r * t).exp()).abs() < 1e-14, "{t} {jump}");
    }
    // On the first ray up, x = ct: v_t from −μ's share to that of the ground.
    let (left, _) = contact.field(&0.5, &0.5, Side::Left);
    let (right, _) = contact.field(&0.5, &0.5, Side::Right);
    let decay = (-0.5 * r).exp();
    assert!((right.velocity - left.velocity - mu * decay).abs() < 1e-15);
    assert!((right.strain - left.strain + mu * decay).abs() < 1e-15);
    assert_eq!(right.displacement, left.displacement);
}

/// Scaled sums stay finite and accurate where `e^{rt}` overflows: the rod settles on `v_s = (g/2c²)(x² − 2Lx)`.
#[test]
fn strong_damping() {
    for r in [25.0, 500.0, 5e3] {
        let contact =
            FirstContact::new(&Parameters { length: 1.0, wave_speed: 1.0, damping: r, gravity: 1.0, speed: 1.0 });
        // The first cell: −c v_x = μ e^{−rt}I₀(rt) + g t e^{−rt}(I₀ + I₁)(rt), asymptotically.
        let z = 1.9 * r;
        let leading = 1.0 / (2.0 * std::f64::consts::PI * z).sqrt();
        let (i0e, i1e) =
            (leading * (1.0 + 0.125 / z + 0.0703125 / (z * z)), leading * (1.0 - 0.375 / z - 0.1171875 / (z * z)));
        let expected = -(i0e + 1.9 * (i0e + i1e));
        let stress = contact.stress(&1.9, Side::Right);
        assert!((stress.value / expected - 1.0).abs() < 0.2 / z.powi(3) + 1e-12, "{r} {} {expected}", stress.value);
        let (field, errors) = contact.field(&0.7, &1.9, Side::Right);
        assert!(field.displacement < 0.0 && errors.iter().all(|e| *e < 1e-9), "{r} {errors:?}");
    }
}
