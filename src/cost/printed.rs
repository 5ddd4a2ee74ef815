//! The paper's integrals as they are printed, by adaptive quadrature: what a reader would program from the page.
//!
//! Nothing here is shared with the closed forms, so that each can be held against the other: I₀ is the integral (2.16), and not a
//! series; the extension of the data is a square wave; integrals nest as deep as in print, three for an energy.

use std::cell::Cell;
use std::time::{Duration, Instant};

use super::CostError;
use crate::rod::Parameters;

/// Gauss–Kronrod: positive nodes, Kronrod weights, and the weights of the seven Gauss nodes among them.
const NODES: [f64; 8] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_4,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_47,
    0.0,
];
const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_56,
    0.104_790_010_322_250_19,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_4,
    0.204_432_940_075_298_89,
    0.209_482_141_084_727_82,
];
const GAUSS: [f64; 4] =
    [0.129_484_966_168_869_7, 0.279_705_391_489_276_64, 0.381_830_050_505_118_9, 0.417_959_183_673_469_4];
/// Halvings of one piece.
const DEEPEST: u32 = 16;
/// No integral is asked for more than this, relative.
const FLOOR: f64 = 1e-13;
/// Evaluations of I₀ between two looks at the clock.
const BETWEEN_LOOKS: u32 = 4096;

/// The first contact by (2.22)–(2.28), (3.38), (3.39) and (3.54) as printed, in doubles.
///
/// **Source**: as named at each method; the reflected data of (2.13) are a square wave, and every integral is cut where it jumps.
///
/// **Units**: any consistent units; momenta and energies are per linear density.
///
/// **Accuracy**: an *f64 estimate*, from quadrature to about `tolerance` of what each integral weighs. Nothing is proved.
///
/// ```
/// # use dalembert::{rod::Parameters, cost::printed::Printed};
/// // r = 0: the stress in the first round trip is −(μ + gt)/c.
/// let rod = Parameters { length: 1.0, wave_speed: 1.0, damping: 0.0, gravity: 1.0, speed: 3.0 };
/// assert!((Printed::new(&rod, 1e-10).stress(1.0) + 4.0).abs() < 1e-14);
/// ```
#[derive(Debug)]
pub struct Printed {
    l: f64,
    c: f64,
    r: f64,
    g: f64,
    mu: f64,
    tolerance: f64,
    evaluations: Cell<u32>,
    deadline: Option<Instant>,
    late: Cell<bool>,
}

impl Printed {
    /// The integrals of `rod` to `tolerance`.
    pub fn new(rod: &Parameters<f64>, tolerance: f64) -> Self {
        let Parameters { length: l, wave_speed: c, damping: r, gravity: g, speed: mu } = *rod;
        Printed { l, c, r, g, mu, tolerance, evaluations: Cell::new(0), deadline: None, late: Cell::new(false) }
    }

    /// For no longer than this, from now: then integrals are cut short, and [`Printed::finished`] says so.
    pub fn within(mut self, seconds: f64) -> Self {
        self.deadline = Instant::now().checked_add(Duration::from_secs_f64(seconds.clamp(0.0, 1e6)));
        self
    }

    /// Whether all integrals asked for so far were done.
    ///
    /// **Errors**: [`CostError::GaveUp`].
    pub fn finished(&self) -> Result<(), CostError> {
        if self.late.get() { Err(CostError::GaveUp("the nested integrals take too long".into())) } else { Ok(()) }
    }

    fn count(&self) {
        let count = self.evaluations.get() + 1;
        self.evaluations.set(count % BETWEEN_LOOKS);
        if count == BETWEEN_LOOKS && self.deadline.is_some_and(|deadline| Instant::now() > deadline) {
            self.late.set(true);
        }
    }

    /// `∫ f` over `[a,b]`, cut at `cuts`, to `tolerance` of `∫|f|`.
    fn integral(&self, a: f64, b: f64, cuts: &[f64], f: &dyn Fn(f64) -> f64) -> f64 {
        self.integral_above(0.0, a, b, cuts, f)
    }

    /// The same, but not below `noise`, which f holds where it cancels.
    fn integral_above(&self, noise: f64, a: f64, b: f64, cuts: &[f64], f: &dyn Fn(f64) -> f64) -> f64 {
        // A cut within rounding of an end would leave a sliver on which f is noise.
        let (least, blur) = (a.min(b), 1e-13 * (a.abs() + b.abs()));
        let inner = |cut: &f64| *cut > least + blur && *cut < b - blur;
        let mut ends: Vec<f64> = cuts.iter().copied().filter(inner).chain([a, b]).collect();
        ends.sort_by(f64::total_cmp);
        let pieces: Vec<Piece> = ends.windows(2).map(|pair| Piece::of(pair[0], pair[1], f)).collect();
        // Halves as good as the whole may be: the estimate is that of the seven-point rule, far above the error of the fifteen. Below
        // the floor it is the noise of the integrals within.
        let allowed = self.tolerance.max(FLOOR) * pieces.iter().map(|piece| piece.size).sum::<f64>() + noise;
        pieces.into_iter().map(|piece| self.halved(piece, allowed, 0, f)).sum()
    }

    fn halved(&self, piece: Piece, allowed: f64, depth: u32, f: &dyn Fn(f64) -> f64) -> f64 {
        if piece.error <= allowed || depth == DEEPEST || self.late.get() {
            return piece.value;
        }
        let middle = 0.5 * (piece.from + piece.to);
        let halves = [(piece.from, middle), (middle, piece.to)].map(|(from, to)| Piece::of(from, to, f));
        halves.into_iter().map(|half| self.halved(half, allowed, depth + 1, f)).sum()
    }

    /// (2.16), by the trapezoidal rule over a period, which converges geometrically.
    fn i0(&self, z: f64) -> f64 {
        self.period(z, |_| 1.0)
    }

    /// `I₁(z)/z`, from the same integral by parts.
    fn i1_over_z(&self, z: f64) -> f64 {
        self.period(z, |angle| angle.sin().powi(2))
    }

    fn period(&self, z: f64, weight: impl Fn(f64) -> f64) -> f64 {
        self.count();
        // The rule leaves 2 I_{2n}(z): below a roundoff of I₀ for all z.
        let n = 12 + (2.0 * z.sqrt() + 0.6 * z) as i32;
        let point = |k: i32| {
            let angle = std::f64::consts::PI * f64::from(k) / f64::from(n);
            weight(angle) * (z * angle.cos()).cosh()
        };
        (0..n).map(point).sum::<f64>() / f64::from(n)
    }

    /// The symmetric extension of 1.
    fn sign(&self, y: f64) -> f64 {
        if (y / (2.0 * self.l)).floor() as i64 % 2 == 0 { 1.0 } else { -1.0 }
    }

    /// Where the extended data jump, as far as the cone of `(x,t)` reaches.
    fn lattice(&self, reach: f64) -> Vec<f64> {
        let most = (reach / (2.0 * self.l)).ceil() as i64 + 1;
        (-most..=most).map(|k| 2.0 * self.l * k as f64).collect()
    }

    /// `t₁, 2t₁, …` up to `t`.
    fn trips(&self, t: f64) -> Vec<f64> {
        let t1 = 2.0 * self.l / self.c;
        (1..=(t / t1).ceil() as i64).map(|k| k as f64 * t1).collect()
    }

    /// `∫_{x−cτ}^{x+cτ} kernel(λs, x − y) 1^e(y) dy`.
    fn cone(&self, x: f64, tau: f64, kernel: &dyn Fn(f64, f64) -> f64) -> f64 {
        let lambda = self.r / self.c;
        let ct = self.c * tau;
        self.integral(x - ct, x + ct, &self.lattice(x + ct), &|y| {
            let s = (ct * ct - (x - y) * (x - y)).max(0.0).sqrt();
            kernel(lambda * s, x - y) * self.sign(y)
        })
    }

    /// `∫₀ᵗ f(τ) dτ`, cut where the cone meets the lattice.
    fn duhamel(&self, x: f64, t: f64, f: &dyn Fn(f64) -> f64) -> f64 {
        if self.g == 0.0 {
            return 0.0;
        }
        let cuts: Vec<f64> = self.lattice(x + self.c * t).iter().map(|y| (y - x).abs() / self.c).collect();
        // On the ground the cone cancels by symmetry: what is left of it there is rounding.
        let noise = 16.0 * f64::EPSILON * self.g * t * self.c * t * (self.r * t).exp() * self.i0(self.r * t);
        self.integral_above(noise, 0.0, t, &cuts, f)
    }

    /// `v`, `v_t`, `v_x` at `(x,t)`, with the limits from later times on a ray.
    ///
    /// **Source**: (2.24), (2.23), (2.22), as the appendix combines them.
    pub fn field(&self, x: f64, t: f64) -> [f64; 3] {
        let Printed { c, r, g, mu, .. } = *self;
        let lambda = r / c;
        let source = |tau: f64| -g * (r * (t - tau)).exp();
        let i0 = |z: f64, _: f64| self.i0(z);
        let force = |tau: f64| source(tau) * self.cone(x, tau, &i0);
        let (fallen, forced) = (self.cone(x, t, &i0), self.duhamel(x, t, &force));
        let w = (-mu * fallen + forced) / (2.0 * c);
        let (ahead, behind) = (self.sign(x + c * t), self.sign(x - c * t));
        let tilt = |z: f64, d: f64| lambda * lambda * self.i1_over_z(z) * d;
        let edge = |tau: f64| source(tau) * (self.sign(x + c * tau) - self.sign(x - c * tau));
        let inner = |tau: f64| source(tau) * self.cone(x, tau, &tilt);
        let w_x = (-mu * (ahead - behind) + mu * self.cone(x, t, &tilt) + self.duhamel(x, t, &edge)
            - self.duhamel(x, t, &inner))
            / (2.0 * c);
        let spread = |z: f64, _: f64| r * t * lambda * self.i1_over_z(z);
        let w_t = -0.5 * mu * (ahead + behind) - 0.5 * mu * self.cone(x, t, &spread) - g * fallen / (2.0 * c)
            + r * forced / (2.0 * c);
        let decay = (-r * t).exp();
        [decay * w, decay * (w_t - r * w), decay * w_x]
    }

    /// `H_r(t)`. **Source**: (2.27).
    pub fn impact_kernel(&self, t: f64) -> f64 {
        let t1 = 2.0 * self.l / self.c;
        let rays = (t / t1).floor() as i64;
        let ray = |j: i64| {
            let lag = j as f64 * t1;
            let sign = if j % 2 == 0 { 2.0 } else { -2.0 };
            sign * self.i0(self.r * (t * t - lag * lag).max(0.0).sqrt())
        };
        self.i0(self.r * t) + (1..=rays).map(ray).sum::<f64>()
    }

    /// `Ψ_r(t)`. **Source**: (2.28).
    fn psi(&self, t: f64) -> f64 {
        let history = if self.g == 0.0 {
            0.0
        } else {
            self.integral(0.0, t, &self.trips(t), &|tau| (self.r * (t - tau)).exp() * self.impact_kernel(tau))
        };
        -self.mu / self.c * self.impact_kernel(t) - self.g / self.c * history
    }

    /// `v_x(0,t) = e^{−rt} Ψ_r(t)`, the limit from later times. **Source**: (2.28).
    pub fn stress(&self, t: f64) -> f64 {
        (-self.r * t).exp() * self.psi(t)
    }

    /// `P(t)`. **Source**: (3.38), with `t` for `(1 − e^{−2rt})/2r` where `r = 0`.
    pub fn momentum(&self, t: f64) -> f64 {
        let Printed { l, c, r, g, mu, .. } = *self;
        let push = self.integral(0.0, t, &self.trips(t), &|tau| (r * tau).exp() * self.psi(tau));
        let lost = (-2.0 * r * t).exp();
        let fallen = if r == 0.0 { t } else { (1.0 - lost) / (2.0 * r) };
        -c * c * lost * push - g * l * fallen - mu * l * lost
    }

    /// `∫₀ᴸ f(v, v_t, v_x) dx`, cut at the ray inside.
    fn over_rod(&self, t: f64, f: impl Fn([f64; 3]) -> f64) -> f64 {
        let ray = (self.c * t) % (2.0 * self.l);
        self.integral(0.0, self.l, &[ray, 2.0 * self.l - ray], &|x| f(self.field(x, t)))
    }

    /// `h(t)`. **Source**: (3.39), the mean of (2.24).
    pub fn centre(&self, t: f64) -> f64 {
        self.over_rod(t, |[v, _, _]| v) / self.l
    }

    /// `E(t)`. **Source**: (3.54): three integrals, one in the other.
    pub fn energy(&self, t: f64) -> f64 {
        self.over_rod(t, |[v, v_t, v_x]| 0.5 * (v_t * v_t + self.c * self.c * v_x * v_x) + self.g * v)
    }
}

/// `∫ f` and `∫ |f|` over a piece, and an estimate of the error of the first.
struct Piece {
    from: f64,
    to: f64,
    value: f64,
    size: f64,
    error: f64,
}

impl Piece {
    fn of(from: f64, to: f64, f: &dyn Fn(f64) -> f64) -> Self {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let centre = f(middle);
        let (mut kronrod, mut size, mut gauss) = (KRONROD[7] * centre, KRONROD[7] * centre.abs(), GAUSS[3] * centre);
        for k in 0..7 {
            let (low, high) = (f(middle - half * NODES[k]), f(middle + half * NODES[k]));
            kronrod += KRONROD[k] * (low + high);
            size += KRONROD[k] * (low.abs() + high.abs());
            if k % 2 == 1 {
                gauss += GAUSS[k / 2] * (low + high);
            }
        }
        Piece { from, to, value: kronrod * half, size: size * half, error: (kronrod - gauss).abs() * half }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The Kronrod rule is exact up to degree 22, the Gauss rule in it up to 13.
    #[test]
    fn rules() {
        for k in 0..=22 {
            let Piece { value, error, .. } = Piece::of(-1.0, 1.0, &|x: f64| x.powi(k));
            let exact = if k % 2 == 0 { 2.0 / f64::from(k + 1) } else { 0.0 };
            assert!((value - exact).abs() < 1e-15, "{k} {value}");
            assert!(k > 13 || error < 1e-15, "{k} {error:e}");
        }
    }

    #[test]
    fn bessel_functions_by_their_integral() {
        let rod = Parameters { length: 1.0, wave_speed: 1.0, damping: 1.0, gravity: 1.0, speed: 1.0 };
        let printed = Printed::new(&rod, 1e-10);
        for k in 0..120 {
            let z = 0.5 * f64::from(k);
            let found = [printed.i0(z), z * printed.i1_over_z(z)].map(|value| value * (-z).exp());
            let truth = [crate::special::i0_scaled(&z), crate::special::i1_scaled(&z)];
            assert!(found.iter().zip(truth).all(|(a, b)| (a - b).abs() < 4e-15), "{z} {found:?} {truth:?}");
        }
    }
}
