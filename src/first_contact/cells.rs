//! One cell between two lattice times: has the transient died away, and where is the first root of the stress.

use super::bounce::{Bounce, BounceKind, Bracket, Route};
use super::field::FirstContact;
use super::search::{FirstRoot, coefficients, first_root};
use crate::number::Analytic;
use crate::special::roundoff;

/// The force in a cell, over `scale`: within `error` of a Chebyshev sum.
pub(super) struct Interpolant<S> {
    pub(super) scale: S,
    pub(super) sum: Vec<f64>,
    /// Includes what the rounding of the sum's own evaluation adds, see [`first_root`] for derivatives.
    pub(super) error: f64,
}

impl<S: Analytic> FirstContact<S> {
    /// Whether, at `k t₁`, the transient is below the static stress everywhere in the rod: then it stays so.
    ///
    /// At a lattice time no ray is inside the rod, so both invariants are analytic in a; with 25 Chebyshev points the
    /// interpolant is off by at most `4M·8^{−24}/7`, M from [`FirstContact::amplitude`], and it is nowhere larger than the
    /// sum of its coefficients' magnitudes. Errors of the values add up with `|ℓ_j| ≤ 2`.
    pub(super) fn settled(&self, k: i64) -> Option<String> {
        if self.critical.is_zero() {
            return None;
        }
        let share = (self.critical.clone() / (self.rod.speed.clone() + &self.critical)).to_f64() / 2.0;
        let largest = self.transient(k)?;
        (largest < share * (1.0 - 1e-9)).then(|| {
            let part = largest / share;
            format!(
                "from t = {k} t₁ on the transient stays below {part:.4} of the static stress gL/c², and the rod settles under its weight"
            )
        })
    }

    /// A bound of `|v_t ∓ c(v_x − v_s′)|/(μ + μ₀)` at `k t₁`, and so at all later times; `None` where that is more than the static
    /// share `gL/c` of it, or not known.
    pub(super) fn transient(&self, k: i64) -> Option<f64> {
        const NODES: usize = 24;
        let trips = self.damping.int(k);
        let total = self.rod.speed.clone() + &self.critical;
        let (alpha, beta) = (self.rod.speed.clone() / &total, self.critical.clone() / &total);
        let (mut upward, mut downward) = (Vec::with_capacity(NODES + 1), Vec::with_capacity(NODES + 1));
        let (mut roundings, mut width) = (0.0f64, 0.0f64);
        let share = beta.to_f64() / 2.0;
        for j in 0..=NODES {
            let node = (std::f64::consts::PI * j as f64 / NODES as f64).cos();
            let a = trips.double((0.25 + 0.25 * node).clamp(0.0, 0.5));
            // The limit from inside at the ground: the ray that comes down has arrived, the one it starts has not.
            let [_, rate, slope] =
                self.field_of(&a, &trips, |_, travel, down| *travel < trips || (*travel == trips && down))?;
            let velocity = rate.impact.value * &alpha + rate.weight.value * &beta;
            let held = a - trips.ratio(1, 2);
            let strain = slope.impact.value * &alpha + (slope.weight.value - held) * &beta;
            let (up, down) = (velocity.clone() - &strain, velocity + strain);
            width = width.max(up.width().to_f64()).max(down.width().to_f64());
            let (up, down) = (up.to_f64(), down.to_f64());
            if up.abs().max(down.abs()) > share {
                return None;
            }
            upward.push(up);
            downward.push(down);
            roundings +=
                rate.impact.roundings + rate.weight.roundings + slope.impact.roundings + slope.weight.roundings;
            roundings += 16.0 * (up.abs() + down.abs() + 1.0);
        }
        // The largest value and the largest slope of an interpolant, by its coefficients.
        let size = |values: &[f64]| {
            let sum = coefficients(values);
            let steep: f64 = (0u32..).zip(&sum).map(|(n, c)| f64::from(n * n) * c.abs()).sum();
            (sum.iter().map(|c| c.abs()).sum::<f64>(), steep)
        };
        // Interpolation in a, from the ellipse ρ = 8 around the rod.
        let interpolation =
            4.0 * self.amplitude(k as f64, (8.0 - 1.0 / 8.0) / 8.0, 1.0, 1.0) * 8f64.powi(-(NODES as i32));
        let ((up, up_steep), (down, down_steep)) = (size(&upward), size(&downward));
        // Nodes and coefficients are doubles. With the interpolant's factor 3.1 for 25 points: the nodes are off by 10⁻¹⁵, and
        // each coefficient, see `cell`, by 5·10⁻¹⁵ of the largest value, all 25 by 1.3·10⁻¹³.
        let doubles = 4e-15 * up_steep.max(down_steep) + 2e-13 * up.max(down);
        let largest = up.max(down) + interpolation + 3.1 * width + 2.0 * self.bound(roundings) + doubles;
        Some(largest)
    }

    /// The force in `(k t₁, (k+1) t₁)` as a Chebyshev sum in doubles, or why there is none.
    ///
    /// Chebyshev interpolation in n + 1 points is off by at most `4Mρ⁻ⁿ/(ρ−1)`. The ellipse with `ρ + 1/ρ = 4k + 2`
    /// stays in Re τ ≥ 0, where `|e^{−Rτ}I₀(R√(τ²−j²))| ≤ 1`, because `(Re √(τ²−j²))² ≤ (Re τ)²`; so each ray adds at
    /// most 1 to the impact's share and, integrated from j, at most 2k + 1 to the weight's: `M ≤ (2k+1)²`.
    ///
    /// The rest is rounding, with `u = 2⁻⁵³`, for values at most V and coefficients c:
    /// - the nodes are off by `10⁻¹⁵`, the cosines in the coefficients too; each coefficient by `2V (10⁻¹⁵·1.5 + (n+3)u)`;
    /// - a value, which is known to `rounding`, is turned into a double: `2uV` more;
    /// - an error made at index k of Clenshaw's recurrence has the weight `T_k`, at most 1, in its result, and the recurrence's
    ///   terms are at most `Σ (j+1)|c_j|`: together `12 u (n+1) Σ (j+1)|c_j|`. In the slope the weights are at most `n²` and the
    ///   terms `Σ (j+1)³|c_j|`; divided by the `4(n+1)²` that [`first_root`] allows slopes, that is less than `4 u Σ (j+1)³|c_j|`.
    pub(super) fn interpolant(&self, route: &Route<S>, k: i64) -> Result<Interpolant<S>, String> {
        let at = |x: f64| self.inside(k, x);
        // Any scale will do.
        let scale = [-1.0, 0.0, 1.0]
            .map(|x| self.force(route, &at(x), k).0.magnitude())
            .into_iter()
            .fold(self.damping.zero(), |sum, probe| sum + probe);
        if !(scale.is_positive() && scale.is_finite()) {
            return Err(format!(
                "between {k} t₁ and {} t₁ the stress is below every number that this precision holds",
                k + 1
            ));
        }
        let width = 2.0 * k as f64 + 1.0;
        let rho = width + (width * width - 1.0).sqrt();
        let log_bound = 2.0 * width.ln() - scale.ln().to_f64() + (4.0 / (rho - 1.0)).ln();
        let n = ((log_bound + 35.0) / rho.ln()).ceil().clamp(8.0, 4000.0) as usize;
        let mut values = Vec::with_capacity(n + 1);
        let mut rounding = (scale.width() / &scale).to_f64();
        for j in 0..=n {
            let (value, error) = self.force(route, &at((std::f64::consts::PI * j as f64 / n as f64).cos()), k);
            let value = value / &scale;
            rounding = rounding.max((value.width() + error / &scale).to_f64());
            values.push(value.to_f64());
        }
        if rounding.is_nan() || rounding > 1e-7 {
            return Err(format!("between {k} t₁ and {} t₁ rounding reaches {rounding:.1e} of the stress", k + 1));
        }
        let sum = coefficients(&values);
        let weighted = |power: i32| (1u32..).zip(&sum).map(|(n, c)| f64::from(n).powi(power) * c.abs()).sum::<f64>();
        let largest = values.iter().fold(0.0f64, |largest, value| largest.max(value.abs()));
        let (nodes, u) = (n as f64 + 1.0, f64::EPSILON / 2.0);
        // The interpolant of errors is at most 1 + (2/π) ln n < 6.3 times as large for n ≤ 4000.
        let places = 1e-15 * weighted(2) + 2.0 * u * largest + rounding;
        let coefficients = 2.0 * nodes * largest * (1.5e-15 + (nodes + 2.0) * u);
        let recurrence = u * (12.0 * nodes * weighted(1) + 4.0 * weighted(3));
        let interpolation = (log_bound - n as f64 * rho.ln() + 1e-6).exp();
        Ok(Interpolant { error: interpolation + 6.3 * places + coefficients + recurrence, scale, sum })
    }

    /// The place `x` of `[−1,1]` in the cell after k round trips.
    pub(super) fn inside(&self, k: i64, x: f64) -> S {
        self.damping.int(k) + (self.damping.double(x) + self.damping.one()) / self.damping.int(2)
    }

    /// The first root inside `(k t₁, (k+1) t₁)`, where the stress is compressive at the left end; `None` where there
    /// is none.
    pub(super) fn cell(&self, route: &Route<S>, k: i64) -> Result<Option<Bracket<S>>, String> {
        let Interpolant { scale, sum, error } = self.interpolant(route, k)?;
        let at = |x: f64| self.inside(k, x);
        let sign = |x: f64| {
            // In doubles, so that nothing is compared that need not be settled.
            let (value, error) = self.force(route, &at(x), k);
            let (value, off) = (value.clone() / &scale, (value.width() + error) / &scale);
            let (value, off) = (value.to_f64(), off.to_f64());
            (value.abs() * (1.0 - 1e-15) > off).then_some(value > 0.0)
        };
        match first_root(&sum, error, sign) {
            FirstRoot::None => Ok(None),
            FirstRoot::Unclear(x) => {
                Err(format!("near t = {:.9} t₁ the stress cannot be told from zero", at(x).to_f64()))
            }
            FirstRoot::Between { lo, hi, slope } => {
                let slope = scale.double(2.0 * slope) * &scale;
                Ok(Some(Bracket { cell: k, from: at(lo), to: at(hi), slope }))
            }
        }
    }

    /// The root in a bracket: the Illinois variant of regula falsi.
    pub(super) fn refine(&self, route: &Route<S>, bracket: Bracket<S>) -> Bounce<S> {
        let Bracket { cell: k, from: mut a, to: mut b, slope } = bracket;
        let (mut fa, mut fb) = (self.force(route, &a, k).0, self.force(route, &b, k).0);
        let unit = roundoff(&a);
        let mut best = (b.clone(), fb.magnitude(), self.force(route, &b, k).1);
        for _ in 0..400 {
            let step = fb.clone() * &(b.clone() - &a) / (fb.clone() - &fa);
            if !step.is_finite() {
                break;
            }
            let c = b.clone() - &step;
            let (fc, error) = self.force(route, &c, k);
            let (size, moved) = (fc.magnitude(), (c.clone() - &b).magnitude());
            if size <= best.1 {
                best = (c.clone(), size.clone(), error.clone());
            }
            if size <= error.clone() / error.int(16) || moved <= unit.clone() * &c {
                break;
            }
            if fc.is_positive() == fb.is_positive() {
                fa = fa.clone() / fa.int(2);
            } else {
                a = b;
                fa = fb;
            }
            b = c;
            fb = fc;
        }
        let (root, size, error) = best;
        let off = ((size + &error) / &slope + unit * &root.int(4) * &root).to_f64();
        Bounce::At { error: off * self.round_trip.to_f64(), time: root * &self.round_trip, kind: BounceKind::Root }
    }
}
