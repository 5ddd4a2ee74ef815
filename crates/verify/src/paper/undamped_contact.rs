//! The undamped first contact, `r = 0`, from the paper's closed forms: (3.47)–(3.53), (3.66)–(3.72), Corollary 1,
//! Remark 2.
//!
//! Each method is the printed formula, to be compared with the engines. In fractions the printed formulas satisfy
//! exactly: `P = L h′`, `P` and `h` continuous at `t₁` and `t_b`, `E_h = P²/2L + L g h`, `E_h + E_z = μ²L/2`. Only the
//! case `μ = μ₀` is left out in print, see [`UndampedContact::momentum_restitution`].

use dalembert::Side;
use dalembert::number::Scalar;
use dalembert::problem::Parameters;

/// The undamped first contact and the flight that follows it, up to the next impact `t₂`.
///
/// **Source**: paper, section 2.2 (Corollary 1), section 3 (the cases `r = 0`), section 4.
///
/// **Units**: any consistent units; energies and momenta are per linear density.
///
/// **Accuracy**: *exact* in fractions; a rounding for each operation otherwise.
///
/// ```
/// # use dalembert::{Number, Parameters, Problem};
/// # use dalembert_verify::paper::UndampedContact;
/// // L = c = g = 1: μ₀ = 2, so μ = 1 stays on the ground for 2t₁ − μ/g = 3.
/// let problem = Problem::uniform(Number::from(1), Number::from(1), Number::from(1), Number::from(1));
/// let rod = UndampedContact::new(&Parameters::<f64>::of(&problem, &())?).unwrap();
/// assert_eq!(rod.bounce_time(), 3.0);
/// assert_eq!(rod.centre(&3.0), (-1.0 / 6.0 + 1.0 / 3.0, 0.5));
/// # Ok::<(), dalembert::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct UndampedContact<S> {
    rod: Parameters<S>,
    round_trip: S,
    /// Whether `μ ≥ μ₀`: the case `t_b = t₁`.
    strong: bool,
}

impl<S: Scalar + PartialOrd> UndampedContact<S> {
    /// Builds the first contact of the rod that hits the ground undeformed with uniform velocity `−μ`.
    ///
    /// **Errors**: `None` where the rod is damped.
    pub fn new(rod: &Parameters<S>) -> Option<Self> {
        let strong = rod.speed >= rod.critical_speed();
        let undamped = rod.damping == rod.damping.zero();
        undamped.then(|| UndampedContact { round_trip: rod.round_trip(), rod: rod.clone(), strong })
    }

    /// Computes `t_b`: `t₁` for `μ ≥ μ₀`, otherwise `2t₁ − μ/g`.
    ///
    /// **Source**: Corollary 1; Remark 1 for `g = 0`.
    pub fn bounce_time(&self) -> S {
        if self.strong {
            return self.round_trip.clone();
        }
        self.round_trip.int(2) * &self.round_trip - self.rod.speed.clone() / &self.rod.gravity
    }

    /// Computes `v_x(0,t) = Ψ₀(t)`: piecewise linear, zero in flight.
    ///
    /// **Source**: (2.28) with `r = 0`, as integrated before (3.52).
    pub fn strain(&self, time: &S, side: Side) -> S {
        let (Parameters { wave_speed: c, gravity: g, speed: mu, .. }, t1) = (&self.rod, &self.round_trip);
        let before = |t: &S| time < t || (time == t && side == Side::Left);
        if before(t1) {
            -(g.clone() * time + mu) / c
        } else if before(&self.bounce_time()) {
            (mu.clone() - (t1.int(2) * t1 - time) * g) / c
        } else {
            c.zero()
        }
    }

    /// Computes `P(t)`: the momentum per linear density.
    ///
    /// **Source**: (3.50), (3.52).
    pub fn momentum(&self, time: &S) -> S {
        let (Parameters { length: l, wave_speed: c, gravity: g, speed: mu, .. }, t) = (&self.rod, time);
        let n = |k: i64| l.int(k);
        let ct = c.clone() * t;
        let gt = g.clone() * t;
        if *t <= self.round_trip {
            return (ct.clone() - l) * mu + (ct / n(2) - l) * &gt;
        }
        if self.strong {
            return mu.clone() * l - gt * l + n(2) * &l.square() * g / c;
        }
        let four = n(4) * g * &l.square() / c;
        if *t <= self.bounce_time() {
            return (mu.clone() + &gt) * &(n(3) * l - ct.clone() / n(2)) - four - mu.clone() * &ct / n(2);
        }
        four + mu.square() * c / (n(2) * g) - (mu.clone() + &gt) * l
    }

    /// Computes `h(t)` and `h′(t) = P/L`: the centre of mass, relative to its place in the undeformed rod on the
    /// ground.
    ///
    /// **Source**: (3.51), (3.53).
    pub fn centre(&self, time: &S) -> (S, S) {
        let (Parameters { length: l, wave_speed: c, gravity: g, speed: mu, .. }, t) = (&self.rod, time);
        let n = |k: i64| l.int(k);
        let ct = c.clone() * t;
        let velocity = self.momentum(t) / l;
        let height = if *t <= self.round_trip {
            // (g c t³/6 + (μc − gL) t²/2 − μLt)/L
            let cubic = g.clone() * &ct * &t.square() / n(6);
            let square = (mu.clone() * c - g.clone() * l) * &t.square() / n(2);
            (cubic + &square - mu.clone() * l * t) / l
        } else if self.strong {
            let start = n(8) * g * &l.square() / (n(3) * &c.square());
            let ray = (mu.clone() - g.clone() * t) * l * &n(2) / c;
            mu.clone() * t - g.clone() * &t.square() / n(2) - &start - &ray
        } else if *t <= self.bounce_time() {
            let impact = (ct.clone() - n(2) * l) * c * mu * &n(3);
            let weight = (n(4) * &l.square() - n(5) * l * &ct + ct.square()) * g;
            (n(4) * l - &ct) * &(impact + &weight) / (n(6) * &c.square() * l)
        } else {
            let late = ct - n(4) * l;
            let impact = c.square() * c * &mu.square() * mu;
            let linear = n(3) * &c.square() * g * &mu.square() - n(6) * c * &g.square() * l * mu;
            let square = n(3) * &g.square() * g * l * &late.square();
            (impact + &(late * &linear) - &square) / (n(6) * &c.square() * &g.square() * l)
        };
        (height, velocity)
    }

    /// Computes `E = μ²L/2`, the energy at all times.
    ///
    /// **Source**: (3.66).
    pub fn total_energy(&self) -> S {
        self.rod.speed.square() * &self.rod.length / self.rod.speed.int(2)
    }

    /// Computes `E_h(t)`: the translational energy.
    ///
    /// **Source**: (3.67), (3.68).
    pub fn translational_energy(&self, time: &S) -> S {
        let (Parameters { length: l, wave_speed: c, gravity: g, speed: mu, .. }, t) = (&self.rod, time);
        let n = |k: i64| l.int(k);
        let (ct, gt) = (c.clone() * t, g.clone() * t);
        if *t <= self.round_trip {
            let start = n(12) * &l.square() * &mu.square();
            let square = n(3) * &ct.square() * &(n(2) * mu + &gt).square();
            let cross = n(8) * &ct * l * &(n(3) * &mu.square() + n(3) * mu * &gt + gt.square());
            return (start + &square - &cross) / (n(24) * l);
        }
        if self.strong {
            let mu0 = self.rod.critical_speed();
            return l.clone() * &(mu.square() - mu0.square() / n(3)) / n(2);
        }
        if *t <= self.bounce_time() {
            let (late, beyond) = (n(4) * l - &ct, ct.clone() - n(3) * l);
            let weight = g.square() * &(n(4) * l - n(3) * &ct) * &late.square() * &late;
            let impact = n(12) * &c.square() * &mu.square() * &beyond.square();
            let cross = n(12) * c * g * mu * &late.square() * &(ct - n(2) * l);
            return (weight + &impact + &cross) / (n(24) * &c.square() * l);
        }
        let mu0 = self.rod.critical_speed();
        let form = n(3) * &mu.square() - n(4) * mu * &mu0 + n(3) * &mu0.square();
        l.clone() * &mu.square() * &form / (n(6) * &mu0.square())
    }

    /// Computes `E_z(t_b)`: the vibrational energy at the bounce, which the flight keeps.
    ///
    /// **Source**: Theorem 2, (3.69).
    pub fn vibrational_energy_at_bounce(&self) -> S {
        let (Parameters { length: l, speed: mu, .. }, mu0) = (&self.rod, self.rod.critical_speed());
        if self.strong {
            return mu0.square() * l / l.int(6);
        }
        let form = l.int(4) * &mu0 - l.int(3) * mu;
        mu.square() * mu * l * &form / (mu0.square() * &l.int(6))
    }

    /// Computes `e_P = −P(t_b)/P(0)`: the momentum coefficient of restitution, `min(1, μ/μ₀)`.
    ///
    /// **Source**: section 4.1. The paper leaves `μ = μ₀` out of both cases; both give 1 there.
    pub fn momentum_restitution(&self) -> S {
        if self.strong { self.rod.speed.one() } else { self.rod.speed.clone() / self.rod.critical_speed() }
    }

    /// Computes `e_E²`: the square of the energy coefficient of restitution.
    ///
    /// **Source**: (4.72). At `μ → 0` it is 1, at `μ = 2μ₀/3` it is least, 5/9.
    ///
    /// **Errors**: `None` where `μ = 0 = μ₀`: nothing moves.
    pub fn energy_restitution_squared(&self) -> Option<S> {
        let (mu, mu0) = (&self.rod.speed, self.rod.critical_speed());
        let n = |k: i64| mu.int(k);
        if self.strong {
            return (*mu != mu.zero()).then(|| n(1) - mu0.square() / (n(3) * &mu.square()));
        }
        let form = n(3) * &mu.square() - n(4) * mu * &mu0 + n(3) * &mu0.square();
        Some(form / (n(3) * &mu0.square()))
    }

    /// Computes `t*` and `h_max = h(t*)`: the top of the flight, provided that no impact comes first.
    ///
    /// **Source**: Remark 2.
    ///
    /// **Errors**: `None` where `g = 0`: the flight has no top.
    ///
    /// ```
    /// # use dalembert::{Number, Parameters, Problem};
    /// # use dalembert_verify::paper::UndampedContact;
    /// let problem = Problem::uniform(Number::from(1), Number::from(1), Number::from(1), Number::from(4));
    /// let rod = UndampedContact::new(&Parameters::<f64>::of(&problem, &())?).unwrap();
    /// assert_eq!(rod.highest(), Some((6.0, 8.0 - 2.0 / 3.0)));
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn highest(&self) -> Option<(S, S)> {
        let Parameters { length: l, wave_speed: c, gravity: g, speed: mu, .. } = &self.rod;
        let n = |k: i64| l.int(k);
        if *g == g.zero() {
            return None;
        }
        let (gl, cm) = (g.clone() * l, c.clone() * mu);
        if self.strong {
            let time = (n(2) * &gl + &cm) / (c.clone() * g);
            let height = mu.square() / (n(2) * g) - n(2) * &gl * l / (n(3) * &c.square());
            return Some((time, height));
        }
        let time = (n(8) * &gl.square() - n(2) * &gl * &cm + cm.square()) / (n(2) * c * g * &gl);
        let form = n(12) * &gl.square() - n(8) * &gl * &cm + n(3) * &cm.square();
        let height = mu.square() * &form / (n(24) * g * &gl.square());
        Some((time, height))
    }
}
