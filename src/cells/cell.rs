//! One characteristic cell: Riemann's formula for the pair of invariants, without a kernel and without a quadrature.
//!
//! The deviation `z = v − v_s` from the static state has the invariants `p = z_t − c z_x` and `q = z_t + c z_x`, and
//! with `κ = r/2`, `ξ = t − x/c`, `η = t + x/c`
//!
//! ```text
//! p_η = q_ξ = −κ(p + q),      P = e^{κ(ξ+η)} p,  Q = e^{κ(ξ+η)} q:      P_η = −κQ,  Q_ξ = −κP
//! ```
//!
//! Riemann's formula for a cell with lower corner (0,0), incoming `P(ξ,0)`, `Q(0,η)`, kernels `F₀(y) = Σ yᵏ/k!²`:
//!
//! ```text
//! P(ξ,η) = Σ_k (κ²η)ᵏ/k! (Jᵏ P(·,0))(ξ)  −  κ Σ_k (κ²ξ)ᵏ/k! (Jᵏ⁺¹ Q(0,·))(η)           J = ∫₀
//! ```
//!
//! because `∫ F₀(κ²ξ(η−s)) Q(s) ds = Σ (κ²ξ)ᵏ/k!² ∫ (η−s)ᵏ Q(s) ds` and repeated integration is Cauchy's formula. In
//! Chebyshev coefficients `J` has two diagonals, so a cell costs one operation per coefficient, times the few terms of
//! the sum. At `r = 0` the outgoing data are the incoming data, exactly; no formula divides by `r`.
//!
//! ## Sup norm
//! `|p|, |q| ≤ M` on the incoming sides gives `|p|, |q| ≤ M` in the cell: the majorant system `P_η = κQ`, `Q_ξ = κP`
//! with data `M e^{κs}` has the solution `M e^{κ(ξ+η)}`. Reflections `p = ±q` keep the bound. So errors of `p`, `q`
//! never grow, and the error of one cell counts once along each path of cells.
//!
//! ## Entire sides
//! If moreover `|P̂(s)| ≤ (a + b|s|) e^{κ|s|}` for complex `s` on an incoming side, and `|q| ≤ a`, then the outgoing
//! side obeys the same bound with the same `a`, `b`: by the majorant, and because data `b ξ e^{κξ}` alone give at most
//! `b ξ e^{κ(ξ+η)}` (maximum principle for `u_η = κ(w−u)`, `w_ξ = κ(u−w)` on `0 … ξ`). Between breaks the initial data
//! have that form, so one number of Chebyshev terms, from [`super::series::terms_for`], suffices for a side for ever.

use std::borrow::Cow;
use std::sync::LazyLock;

use super::series::{Basis, add_scaled, at_one, evaluate_all, scale, times_x};
use crate::number::Rounded;

/// A cell with its incoming data: `e^{κ(ξ−ξ₀)} p` on the side `η = η₀`, `e^{κ(η−η₀)} q` on the side `ξ = ξ₀`.
#[derive(Clone, Debug)]
pub(super) struct Cell<'a, S: Clone> {
    /// `ξ₀`, `η₀`: the lower corner.
    pub(super) corner: (S, S),
    /// `Δξ`, `Δη`.
    pub(super) size: (S, S),
    /// `κΔξ`, `κΔη`.
    pub(super) depth: (S, S),
    pub(super) p: Cow<'a, [S]>,
    pub(super) q: Cow<'a, [S]>,
    /// Amount to add to `p` and to subtract from `q`: the reflection at the stress-free ground end is about this value.
    pub(super) offset: S,
}

/// Returns the number of terms of `Σ yᵏ/k!²` beyond the first that reach the accuracy `2^log2_accuracy`, `y ≥ 0`.
///
/// `‖Jᵏ‖ ≤ 1/k!` on the unit interval, so the terms of the formula above are at most `yᵏ/k!²` of the data; for `y ≤ 1`
/// each is less than half of the one before it, so the first one below half the accuracy bounds the rest.
pub(super) fn terms(y: f64, log2_accuracy: f64) -> usize {
    if y <= 0.0 {
        return 0;
    }
    static SQUARES: LazyLock<[f64; 1001]> = LazyLock::new(|| std::array::from_fn(|k| 2.0 * (k as f64).log2()));
    let (log2_y, mut log2_term, mut k) = (y.log2(), 0.0, 0usize);
    while log2_term > log2_accuracy - 1.0 && k < 1000 {
        k += 1;
        log2_term += log2_y - SQUARES[k];
    }
    k.saturating_sub(1)
}

/// Replaces the incoming `p` and `q` by the outgoing ones, each referred to the new corner.
pub(super) fn cross<S: Rounded>(
    basis: &Basis<S>,
    (p, q): (&mut Vec<S>, &mut Vec<S>),
    (a, h): (&S, &S),
    (decay_a, decay_h): (&S, &S),
    log2_accuracy: f64,
) {
    let y = a.clone() * h;
    let terms = terms(y.to_f64(), log2_accuracy).min(basis.powers.len() - 1);
    let (mut u, mut w) = (p.clone(), q.clone());
    let (mut factor, zero) = (a.one(), a.zero());
    let mut corrections = Vec::with_capacity(terms + 1);
    for k in 0..=terms {
        basis.integrate(&mut u);
        basis.integrate(&mut w);
        corrections.push((at_one(&w, &zero), at_one(&u, &zero), factor.clone()));
        if k < terms {
            factor = factor * &y / a.int(i64::try_from(k + 1).unwrap_or(1));
            add_scaled(p, &u, &factor);
            add_scaled(q, &w, &factor);
        }
    }
    for (k, (from_q, from_p, factor)) in corrections.into_iter().enumerate() {
        add_scaled(p, &basis.powers[k], &-(from_q * &factor * h));
        add_scaled(q, &basis.powers[k], &-(from_p * &factor * a));
    }
    scale(p, decay_h);
    scale(q, decay_a);
}

/// Computes `e^{2κτ} q` on the diagonal `ξ = η` of a cell that is its own mirror image, `p = ±q` on its lower sides, in
/// `terms_kept` terms.
pub(super) fn diagonal<S: Rounded>(
    basis: &Basis<S>,
    q: &[S],
    depth: &S,
    even: bool,
    (terms_kept, log2_accuracy): (usize, f64),
) -> Vec<S> {
    let y = depth.square();
    let count = terms(y.to_f64(), log2_accuracy).min(basis.powers.len() - 1);
    let mirrored = if even { -depth.clone() } else { depth.clone() };
    let mut u = q.to_vec();
    u.resize(terms_kept.max(q.len()), depth.zero());
    let mut layers = Vec::with_capacity(count + 1);
    for _ in 0..=count {
        let mut next = u.clone();
        basis.integrate(&mut next);
        add_scaled(&mut u, &next, &mirrored);
        layers.push(std::mem::replace(&mut u, next));
    }
    // Horner's rule for Σ_k (yx)ᵏ/k! layer_k.
    let mut sum = vec![depth.zero(); terms_kept.max(q.len())];
    for (k, layer) in layers.into_iter().enumerate().rev() {
        if k < count {
            times_x(&mut sum);
            scale(&mut sum, &(y.clone() / depth.int(i64::try_from(k + 1).unwrap_or(1))));
        }
        add_scaled(&mut sum, &layer, &depth.one());
    }
    sum
}

impl<S: Rounded> Cell<'_, S> {
    /// Returns the cell with copies of its incoming data.
    pub(super) fn kept(&self) -> Cell<'static, S> {
        let Cell { corner, size, depth, p, q, offset } = self.clone();
        let (p, q) = (p.into_owned().into(), q.into_owned().into());
        Cell { corner, size, depth, p, q, offset }
    }

    /// Computes `p` and `q` of `z` at the points `(ξ, η)` of the cell.
    pub(super) fn at(&self, basis: &Basis<S>, points: &[(S, S)], log2_accuracy: f64) -> Vec<(S, S)> {
        let (a, h) = (&self.depth.0, &self.depth.1);
        let place = |(xi, eta): &(S, S)| {
            ((xi.clone() - &self.corner.0) / &self.size.0, (eta.clone() - &self.corner.1) / &self.size.1)
        };
        let (xs, es): (Vec<S>, Vec<S>) = points.iter().map(place).unzip();
        let y = a.clone() * h;
        let count = terms(y.to_f64(), log2_accuracy).min(basis.powers.len() - 1);
        let (mut u, mut w) = (self.p.to_vec(), self.q.to_vec());
        // The sums of p and q, and the factors (κ²ξ)ᵏ/k!, (κ²η)ᵏ/k!.
        let mut sums = vec![[y.zero(), y.zero(), y.one(), y.one()]; points.len()];
        let (mut at_x, mut at_e) = (evaluate_all(&u, &xs), evaluate_all(&w, &es));
        for k in 0..=count {
            basis.integrate(&mut u);
            basis.integrate(&mut w);
            let (next_x, next_e) = (evaluate_all(&u, &xs), evaluate_all(&w, &es));
            let next = y.clone() / y.int(i64::try_from(k + 1).unwrap_or(1));
            for (i, [p, q, by_x, by_e]) in sums.iter_mut().enumerate() {
                *p = at_x[i].clone() * &*by_e + &*p - next_e[i].clone() * h * &*by_x;
                *q = at_e[i].clone() * &*by_x + &*q - next_x[i].clone() * a * &*by_e;
                *by_x = by_x.clone() * &xs[i] * &next;
                *by_e = by_e.clone() * &es[i] * &next;
            }
            (at_x, at_e) = (next_x, next_e);
        }
        let value = |([p, q, ..], (x, e)): ([S; 4], (&S, &S))| {
            let decay = (-(a.clone() * x + h.clone() * e)).exp();
            (p * &decay + &self.offset, q * &decay - &self.offset)
        };
        sums.into_iter().zip(xs.iter().zip(&es)).map(value).collect()
    }
}

#[cfg(test)]
#[path = "tests/cell.rs"]
mod tests;
