//! One round trip between two lattice times: whether the transient has died away, and the first root of the stress.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use super::field::{FirstContact, Shares, Trips};
use super::first_root::{FirstRoot, coefficients, first_root};
use super::outcome::{Bounce, BounceKind};
use crate::reason::{Doubt, NoBounceReason};
use crate::special::BoundedSpecial;

/// A search for the first root of the force on the ground.
pub(super) struct Search<'a, N> {
    pub(super) contact: &'a FirstContact<N>,
    pub(super) kernels: Option<&'a Kernels<N>>,
}

/// Lists that are computed once, by their keys.
type Known<K, T> = RefCell<BTreeMap<K, Rc<[T]>>>;

/// Sums over the rays that the search for the bounce needs for one damping, each computed once for many speeds: the
/// motion is linear in `μ` and `g`.
#[derive(Debug)]
pub struct Kernels<N> {
    /// Shares of the force at the nodes of a cell, by the cell and the number of nodes.
    cells: Known<(i64, usize), Shares<N>>,
    /// Shares of `v_t` and `c v_x`, less the static state, at lattice times.
    lattice: Known<i64, [Shares<N>; 2]>,
}

impl<N> Default for Kernels<N> {
    fn default() -> Self {
        Kernels { cells: RefCell::default(), lattice: RefCell::default() }
    }
}

/// Returns the entry of a table for `key`, computing it if it is missing.
fn known<K: Ord, T>(table: &Known<K, T>, key: K, find: impl FnOnce() -> Rc<[T]>) -> Rc<[T]> {
    let held = table.borrow().get(&key).cloned();
    held.unwrap_or_else(|| {
        let list = find();
        table.borrow_mut().insert(key, list.clone());
        list
    })
}

/// The force in a cell, over `scale`: within `error` of a Chebyshev sum.
pub(super) struct Interpolant<N> {
    pub(super) scale: N,
    pub(super) sum: Vec<f64>,
    /// Error bound, including the rounding in the evaluation of the sum; [`first_root`] uses it for derivatives too.
    pub(super) error: f64,
}

/// A part of a cell with exactly one root of the stress, the first.
pub(super) struct Bracket<N> {
    /// Index of the cell: the number of round trips before it.
    cell: i64,
    /// Ends of the part, in round trips.
    from: N,
    to: N,
    /// Lower bound of the fall of the force per round trip.
    slope: N,
}

impl<N: BoundedSpecial> FirstContact<N> {
    /// Tests whether, at `k t₁`, the transient is below the static stress everywhere in the rod: then it stays so.
    pub(super) fn settled(&self, k: i64, kernels: Option<&Kernels<N>>) -> Option<NoBounceReason> {
        if self.weightless {
            return None;
        }
        let (share, largest) = (self.static_share(), self.transient(k, kernels)?);
        let part = largest / share;
        (largest < share * (1.0 - 1e-9)).then_some(NoBounceReason::SettlesUnderWeight { trips: k, part })
    }

    /// Computes `gL/c` over `μ + μ₀`.
    pub(super) fn static_share(&self) -> f64 {
        (self.critical.clone() / self.total_speed()).near().0 / 2.0
    }

    /// Bounds `|v_t ∓ c(v_x − v_s′)|/(μ + μ₀)` at `k t₁`, and so at all later times; `None` if the bound exceeds the
    /// static share `gL/c`, or is unknown.
    ///
    /// At a lattice time no ray is inside the rod, so both invariants are analytic in a; with 25 Chebyshev points the
    /// error of the interpolant is at most `4M·8^{−24}/7`, M from [`FirstContact::amplitude`], and its size is at most
    /// the sum of its coefficients' magnitudes. Errors of the values add up to at most 3.1 times the greatest of them.
    pub(super) fn transient(&self, k: i64, kernels: Option<&Kernels<N>>) -> Option<f64> {
        const NODES: usize = 24;
        let trips = self.damping.int(k);
        let (total, free) = (self.total_speed(), self.free_fall(&trips));
        let sample = |j: usize| {
            let node = (std::f64::consts::PI * j as f64 / NODES as f64).cos();
            let a = trips.double((0.25 + 0.25 * node).clamp(0.0, 0.5));
            // Limit from inside at the ground: the downward ray has arrived, the upward ray that it starts has not.
            let [_, rate, slope] = self.field_shares(&a, &trips, [k, k], &free);
            [rate, Shares { impact: slope.impact, weight: slope.weight - (a - trips.ratio(1, 2)) }]
        };
        let held = kernels.map(|kernels| known(&kernels.lattice, k, || (0..=NODES).map(sample).collect()));
        let (mut upward, mut downward) = (Vec::with_capacity(NODES + 1), Vec::with_capacity(NODES + 1));
        let mut error = 0.0f64;
        let share = self.static_share();
        for j in 0..=NODES {
            let [rate, slope] = held.as_ref().map_or_else(|| sample(j), |held| held[j].clone());
            let (velocity, strain) = (self.weighted(&rate) / &total, self.weighted(&slope) / &total);
            let ((up, up_off), (down, down_off)) = ((velocity.clone() - &strain).near(), (velocity + strain).near());
            error = error.max(up_off).max(down_off);
            if !(up.is_finite() && down.is_finite()) || up.abs().max(down.abs()) > share {
                return None;
            }
            upward.push(up);
            downward.push(down);
        }
        // Greatest value and greatest slope of an interpolant, by its coefficients.
        let size = |values: &[f64]| {
            let sum = coefficients(values);
            let steep: f64 = (0u32..).zip(&sum).map(|(n, c)| f64::from(n * n) * c.abs()).sum();
            (sum.iter().map(|c| c.abs()).sum::<f64>(), steep)
        };
        // Interpolation in a, from the ellipse ρ = 8 around the rod.
        let interpolation =
            4.0 * self.amplitude(k as f64, (8.0 - 1.0 / 8.0) / 8.0, 1.0, 1.0) * 8f64.powi(-(NODES as i32));
        let ((up, up_steep), (down, down_steep)) = (size(&upward), size(&downward));
        // Nodes and coefficients are doubles. With the interpolant's factor 3.1 for 25 points: the nodes are off by
        // 10⁻¹⁵, and each coefficient, see `interpolant`, by 5·10⁻¹⁵ of the largest value, all 25 by 1.3·10⁻¹³.
        let doubles = 4e-15 * up_steep.max(down_steep) + 2e-13 * up.max(down);
        Some(up.max(down) + interpolation + 3.1 * error + doubles)
    }

    /// Converts the place `x` of `[−1,1]` in the cell after k round trips to round trips.
    pub(super) fn inside(&self, k: i64, x: f64) -> N {
        (self.damping.int(k) + (self.damping.double(x) + self.damping.one()) / self.damping.int(2)).middle()
    }

    /// Computes the force on the ground, `−c v_x/(μ + μ₀)`, positive in contact, with `k` returned rays.
    pub(super) fn force(&self, trips: &N, k: i64) -> N {
        self.weighted(&self.ground(trips, k)) / self.total_speed()
    }
}

impl<N: BoundedSpecial> Search<'_, N> {
    /// Computes the force at the n + 1 Chebyshev points of a cell, from its end to its beginning.
    fn at_nodes(&self, k: i64, n: usize) -> Vec<N> {
        let place = |j: usize| self.contact.inside(k, (std::f64::consts::PI * j as f64 / n as f64).cos());
        let find = || (0..=n).map(|j| self.contact.ground(&place(j), k)).collect();
        let shares: Rc<[_]> = match self.kernels {
            Some(kernels) => known(&kernels.cells, (k, n), find),
            None => find(),
        };
        let total = self.contact.total_speed();
        shares.iter().map(|shares| self.contact.weighted(shares) / &total).collect()
    }

    /// Computes the force in `(k t₁, (k+1) t₁)` as a Chebyshev sum in doubles, or returns the reason why this fails.
    ///
    /// The error of Chebyshev interpolation in n + 1 points is at most `4Mρ⁻ⁿ/(ρ−1)`. The ellipse with `ρ + 1/ρ = 4k +
    /// 2` stays in Re τ ≥ 0, where `|e^{−Rτ}I₀(R√(τ²−j²))| ≤ 1`, because `(Re √(τ²−j²))² ≤ (Re τ)²`; so each ray adds
    /// at most 1 to the impact's share and, integrated from j, at most 2k + 1 to the weight's: `M ≤ (2k+1)²`.
    ///
    /// The remaining error is rounding, with `u = 2⁻⁵³`, for values at most V and coefficients c:
    /// - the nodes are off by `10⁻¹⁵`, the cosines in the coefficients too; each coefficient by
    ///   `2V (10⁻¹⁵·1.5 + (n+3)u)`;
    /// - a value, which is known to `rounding`, is converted to a double: `2uV` more;
    /// - an error made at index k of Clenshaw's recurrence has the weight `T_k`, at most 1, in its result, and the
    ///   recurrence's terms are at most `Σ (j+1)|c_j|`: together `12 u (n+1) Σ (j+1)|c_j|`. In the slope the weights
    ///   are at most `n²` and the terms `Σ (j+1)³|c_j|`; divided by the `4(n+1)²` that [`first_root`] allows slopes,
    ///   that is less than `4 u Σ (j+1)³|c_j|`.
    pub(super) fn interpolant(&self, k: i64) -> Result<Interpolant<N>, Doubt> {
        let zero = self.contact.damping.zero();
        // Any exact number is valid as a scale.
        let probes = self.at_nodes(k, 2).into_iter().rev();
        let scale = probes.fold(zero, |sum, probe| sum + probe.magnitude()).middle();
        if !(scale.positive() == Ok(true) && scale.is_finite()) {
            return Err(Doubt::Faint(k));
        }
        let width = 2.0 * k as f64 + 1.0;
        let rho = width + (width * width - 1.0).sqrt();
        let log_bound = 2.0 * width.ln() - scale.ln().near().0 + (4.0 / (rho - 1.0)).ln();
        let n = ((log_bound + 35.0) / rho.ln()).ceil().clamp(8.0, 4000.0) as usize;
        // Speeds that need about as many nodes share them.
        let n = if self.kernels.is_some() { n.next_multiple_of(8) } else { n };
        let mut values = Vec::with_capacity(n + 1);
        let mut rounding = 0.0f64;
        for value in self.at_nodes(k, n) {
            let (value, error) = (value / &scale).near();
            rounding = if error.is_nan() { f64::INFINITY } else { rounding.max(error) };
            values.push(value);
        }
        if rounding > 1e-7 {
            return Err(Doubt::Rounding(k, rounding));
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

    /// Finds the first root inside `(k t₁, (k+1) t₁)`, where the stress is compressive at the left end; `None` if there
    /// is none.
    pub(super) fn cell(&self, k: i64) -> Result<Option<Bracket<N>>, Doubt> {
        let Interpolant { scale, sum, error } = self.interpolant(k)?;
        let at = |x: f64| self.contact.inside(k, x);
        let sign = |x: f64| {
            self.contact.force(&at(x), k).sign().ok().filter(|order| order.is_ne()).map(std::cmp::Ordering::is_gt)
        };
        match first_root(&sum, error, sign) {
            FirstRoot::None => Ok(None),
            FirstRoot::Unclear(x) => Err(Doubt::NearZero(at(x).near().0)),
            FirstRoot::Between { lo, hi, slope } => {
                let slope = scale.double(2.0 * slope) * &scale;
                Ok(Some(Bracket { cell: k, from: at(lo), to: at(hi), slope }))
            }
        }
    }

    /// Computes the root in a bracket: the Illinois variant of regula falsi, in exact numbers of round trips, until the
    /// sign of the force is undecided. The force falls at least as fast as `slope`, so the root is within `|f|/slope`.
    pub(super) fn refine(&self, bracket: Bracket<N>) -> Bounce<N> {
        let Bracket { cell: k, from: mut a, to: mut b, slope } = bracket;
        let force = |x: &N| self.contact.force(x, k);
        let (mut fa, found) = (force(&a).middle(), force(&b));
        let mut fb = found.middle();
        let mut best = (b.clone(), found);
        for _ in 0..400 {
            let step = (fb.clone() * &(b.clone() - &a) / (fb.clone() - &fa)).middle();
            if !step.is_finite() {
                break;
            }
            let c = (b.clone() - &step).middle();
            let found = force(&c);
            let fc = found.middle();
            let unsettled = !matches!(found.sign(), Ok(order) if order.is_ne());
            if unsettled || fc.magnitude().below(&best.1.middle().magnitude()) == Ok(true) {
                best = (c.clone(), found);
            }
            let moved = (c.clone() - &b).middle().magnitude();
            if unsettled || moved.below(&(c.roundoff() * &c)) != Ok(false) {
                break;
            }
            if fc.positive() == fb.positive() {
                fa = (fa.clone() / fa.int(2)).middle();
            } else {
                a = b;
                fa = fb;
            }
            (b, fb) = (c, fc);
        }
        let (root, force) = best;
        let root = root.widened(&(force.magnitude() / &slope));
        let time = (root.clone() * &self.contact.round_trip).without_exact();
        let trips = Trips { exact: root.clone(), number: root, passed: k, on_lattice: false };
        Bounce::At { time, trips, kind: BounceKind::Root }
    }
}
