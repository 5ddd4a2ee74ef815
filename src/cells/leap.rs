//! A flight of many round trips in one step.
//!
//! In flight both ends are free. The vibration `z` about the centre of mass, extended evenly, has the period 1 in `x`
//! (in `c t₁`), and `Z = e^{Rt} z` obeys `Z_tt − Z_xx = R² Z`. Its modes are `cos(2πkx) e^{±iω_k t}`, `ω_k² = (2πk)² −
//! R²`, `k ≥ 1`. Hence with one real downward wave,
//!
//! ```text
//! Z(x,t) = F(x,t) + F(−x,t),    F_t = Ω F,    Ω = D √(1 + R²D⁻²),    D = ∂/∂y,    D⁻¹: antiderivative of mean zero.
//! F(y,t) = (e^{tG} F(·,0))(y + t),    G = Ω − D = ½R² D⁻¹ − ⅛R⁴ D⁻³ + …
//! ```
//!
//! A whole number n of round trips is `e^{nG}`, and every operator is a power series in `D⁻¹`, which maps piecewise
//! polynomials to piecewise polynomials: jumps stay on their rays. `G` is skew, so `e^{nG}` keeps the norm.
//!
//! On the characteristic `t = x = s/2` that leaves the ground, with `ψ = F_t` at `t = 0`, `H = 1 − (1 + R²D⁻²)^{−½}`,
//!
//! ```text
//! Z_s(s) = ((1 − H/2) e^{sG/2} ψ)(s) + ½ (H e^{sG/2} ψ)(0),    Z(0) = 2 (Ω⁻¹ψ)(0)                       (out)
//! ψ = Σ_j Gʲ/j! Π[(−s/2)ʲ Z_s] + ½ Σ_j (∫(−s/2)ʲ Z ds)/j! G^{j+1} δ                                      (in)
//! ```
//!
//! where Π subtracts the mean and `D⁻¹δ = ½ − s`. The first formula is the chain rule. For the second, `U Z_t − Z U_t`
//! of two solutions is the density of a conserved quantity without flux through the free ends, so its integral over `t
//! = 0` is `∫(U Z_s − Z U_s) ds` over the characteristic; `U = cos(2πkx) e^{−iω_k t}` gives `iω_k a_k/2` of `Z = Σ Re
//! a_k cos(2πkx) e^{iω_k t}`, and `U = ½ e^{−G_k s/2} (1 + e^{−2πiks})`, `G_k = i(ω_k − 2πk)`, on the characteristic.
//! Integrating the first of its terms by parts, `iω_k a_k = 2 ∫ e^{−G_k s/2} e^{−2πiks} Z_s ds + G_k ∫ e^{−G_k s/2} Z
//! ds`, which is (in) mode by mode.
//!
//! ## Truncation
//! On mean-free functions `‖D⁻¹‖ ≤ ¼`, `‖D⁻²‖ ≤ 0.0324` in the sup norm: the integrals of `|½ − s|` and of `|s² − s +
//! ⅙|/2`. The series of `G`, `H` and `e^{nG}` alternate or have known coefficients, and end where the remainder is
//! below the accuracy.

use std::cell::Cell;
use std::collections::VecDeque;

use super::march::{Medium, Segment, State};
use super::series::{Basis, add_scaled, at_one, at_zero, integral, scale, times_x};
use crate::special::RoundedSpecial;

/// Largest `nR²/4π` of one leap, the phase by which damping delays the lowest mode: the series loses `e^{nR²/4π}`.
const MOST_PHASE: f64 = 4.0;
/// Bound of `‖D⁻²‖`.
const INVERSE_SQUARE: f64 = 0.0324;

/// Returns the maximum number of round trips of one leap.
pub(super) fn most_trips(damping: f64) -> f64 {
    MOST_PHASE * 4.0 * std::f64::consts::PI / (damping * damping)
}

/// A function on the circle of length 1: one series for each segment.
type Function<S> = Vec<Vec<S>>;

/// The circle, cut at the rays.
struct Circle<'a, S> {
    basis: &'a Basis<S>,
    /// Start and length of each segment.
    parts: Vec<(S, S)>,
    /// Coefficients of `D^{1−2m}` in `G`, and of `D^{−2m}` in `H`, `m ≥ 1`.
    lag: Vec<S>,
    turn: Vec<S>,
    /// The sum [`LeapCount::dropped`]; and a bound of the later amplification of a term dropped now.
    dropped: Cell<f64>,
    weight: Cell<f64>,
    /// The sum [`LeapCount::integrals`]; and a bound of the size of the present function relative to the wave.
    integrals: Cell<f64>,
    size: Cell<f64>,
    /// Size below which terms are left out.
    accuracy: f64,
}

/// Computes the sums of absolute values from each term on, where a function in one term is at most `norm` times that in
/// the term before.
fn rests<S: RoundedSpecial>(terms: &[S], norm: f64) -> Vec<f64> {
    let mut rests: Vec<f64> = terms.iter().map(|term| term.to_f64().abs()).collect();
    for k in (1..rests.len()).rev() {
        rests[k - 1] += norm * rests[k];
    }
    rests
}

/// Bound of `‖D⁻¹‖` on functions of mean zero that the account of the proof uses; and its square.
const HALF: f64 = 0.5;
const QUARTER: f64 = HALF * HALF;

/// Sums that a leap collects for the account of its error.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LeapCount {
    /// Bound of the sum of all functions that integration and products with s have dropped.
    pub(super) dropped: f64,
    /// Number of terms of `G` and `H`.
    pub(super) order: usize,
    /// Number of powers of `G/2` on the characteristic.
    pub(super) layers: usize,
    /// Number of antiderivatives and products with s, each weighted by a bound of the amplification of its roundings.
    pub(super) integrals: f64,
    /// Number of powers of `D⁻¹` in `e^{nG}`.
    pub(super) powers: usize,
}

fn add<S: RoundedSpecial>(target: &mut [Vec<S>], f: &[Vec<S>], factor: &S) {
    for (target, f) in target.iter_mut().zip(f) {
        add_scaled(target, f, factor);
    }
}

impl<S: RoundedSpecial> Circle<'_, S> {
    fn mean(&self, f: &[Vec<S>]) -> S {
        let zero = self.parts[0].0.zero();
        self.parts.iter().zip(f).fold(zero, |sum, ((_, len), c)| integral(c) * len + &sum)
    }

    /// Records the last coefficient of a series that is integrated or multiplied by s: a bound of the dropped term.
    fn drops(&self, c: &[S]) {
        let last = c.last().map_or(0.0, |last| last.to_f64().abs());
        self.dropped.set(self.dropped.get() + self.weight.get() * last);
    }

    /// Records an antiderivative or a product with s.
    fn counts(&self) {
        self.integrals.set(self.integrals.get() + self.weight.get() * self.size.get());
    }

    /// Runs `work` with the present weight multiplied by `weight`.
    fn weighed<T>(&self, weight: f64, work: impl FnOnce() -> T) -> T {
        let before = self.weight.replace(weight * self.weight.get());
        let found = work();
        self.weight.set(before);
        found
    }

    /// Applies `D⁻¹`, in place.
    fn antiderivative(&self, f: &mut [Vec<S>]) {
        let mut here = self.parts[0].0.zero();
        self.counts();
        for ((_, len), c) in self.parts.iter().zip(f.iter_mut()) {
            self.drops(c);
            *c = self.basis.primitive(c, len, &here);
            here = at_one(c, &len.zero());
        }
        self.centre(f);
    }

    /// Subtracts the mean.
    fn centre(&self, f: &mut [Vec<S>]) {
        let mean = self.mean(f);
        for c in f {
            c[0] = c[0].clone() - &mean;
        }
    }

    fn times_s(&self, f: &mut [Vec<S>], factor: &S) {
        self.counts();
        for ((start, len), c) in self.parts.iter().zip(f) {
            let mut by_x = c.clone();
            self.drops(c);
            times_x(&mut by_x);
            for (c, by_x) in c.iter_mut().zip(by_x) {
                *c = (by_x * len + c.clone() * start) * factor;
            }
        }
    }

    /// Computes `Σ c_m D^{−2m} f`; if `odd`, `Σ c_m D^{1−2m} f`.
    fn series(&self, f: &[Vec<S>], coefficients: &[S], odd: bool) -> Function<S> {
        let small = self.accuracy / (self.weight.get() * self.size.get());
        let enough = rests(coefficients, 1.0).into_iter().take_while(|rest| *rest >= small).count();
        self.sum(f.to_vec(), coefficients, enough, if odd { 1 } else { 2 })
    }

    /// Computes the sum of so many terms of a series in `D⁻²`; the first is the coefficient times `D^{−first} power`.
    fn sum(&self, mut power: Function<S>, coefficients: &[S], terms: usize, first: usize) -> Function<S> {
        let mut sum = vec![vec![self.parts[0].0.zero(); self.basis.size()]; power.len()];
        let size = self.size.get();
        for (m, (factor, rest)) in coefficients.iter().zip(rests(coefficients, QUARTER)).take(terms).enumerate() {
            self.weighed(rest, || {
                for _ in 0..if m > 0 { 2 } else { first } {
                    self.antiderivative(&mut power);
                }
            });
            self.size.set(QUARTER * self.size.get());
            add(&mut sum, &power, factor);
        }
        self.size.set(size);
        sum
    }

    fn lagged(&self, f: &[Vec<S>]) -> Function<S> {
        self.series(f, &self.lag, true)
    }

    fn turned(&self, f: &[Vec<S>]) -> Function<S> {
        self.series(f, &self.turn, false)
    }

    /// Computes `γ = Gδ`.
    fn lagged_delta(&self) -> Function<S> {
        let zero = self.parts[0].0.zero();
        let mut sawtooth = vec![vec![zero.zero(); self.basis.size()]; self.parts.len()];
        for ((start, len), c) in self.parts.iter().zip(&mut sawtooth) {
            let half = zero.ratio(1, 2);
            c[0] = half.clone() - start - len.clone() * &half;
            c[1] = -(len.clone() * &half);
        }
        self.sum(sawtooth, &self.lag, self.lag.len(), 0)
    }

    /// Returns a bound of `‖G‖`, from [`HALF`].
    fn lag_bound(&self) -> f64 {
        HALF * rests(&self.lag, QUARTER).first().copied().unwrap_or(0.0)
    }
}

/// Computes the binomial coefficients times powers `C(p, m) R^{2m}`, `m ≥ 1`, for `p = ±½`, down to the accuracy.
fn binomials<S: RoundedSpecial>(damping: &S, power: i64, log2_accuracy: f64) -> Vec<S> {
    let square = damping.square();
    let (ratio, mut size) = ((square.to_f64() * INVERSE_SQUARE).log2(), 0.0);
    let (mut terms, mut term) = (Vec::new(), damping.one());
    for m in 1i64.. {
        // C(p,m) = C(p,m−1) (p − m + 1)/m, 2p = power.
        term = term * &square * &damping.ratio(power - 2 * m + 2, 2 * m);
        terms.push(term.clone());
        size += ratio;
        // |C(p,m)| ≤ 1, and the remainder is at most a sixth of the last term.
        if size < log2_accuracy || term.is_zero() || m > 2000 {
            break;
        }
    }
    terms
}

/// Computes `ψ` from `Z` and `Z_s` on the characteristic by formula (in), with so many powers of `G/2`.
fn inwards<S: RoundedSpecial>(
    circle: &Circle<'_, S>,
    (value, rate): (Function<S>, Function<S>),
    layers: usize,
) -> Function<S> {
    let one = circle.parts[0].0.one();
    let (half, lag, gamma) = (one.ratio(1, 2), circle.lag_bound(), circle.lagged_delta());
    let mut products = vec![(rate, value)];
    for j in 1..=layers {
        let (mut rate, mut value) = products[j - 1].clone();
        let factor = one.ratio(-1, 2 * j as i64);
        circle.weighed(lag.powi(j as i32), || {
            circle.times_s(&mut rate, &factor);
            circle.times_s(&mut value, &factor);
        });
        products.push((rate, value));
    }
    // Horner's rule.
    let mut wave: Function<S> = Vec::new();
    for (j, (mut rate, value)) in products.into_iter().enumerate().rev() {
        circle.centre(&mut rate);
        add(&mut rate, &gamma, &(circle.mean(&value) * &half));
        if j < layers {
            // The term dropped here is still multiplied by G j times.
            let later = circle.weighed(lag.powi(j as i32), || circle.lagged(&wave));
            add(&mut rate, &later, &one);
        }
        wave = rate;
    }
    wave
}

/// Computes `Z_s` on the characteristic, and `Z(0)`, from `ψ` by formula (out), with so many powers of `G/2`.
fn outwards<S: RoundedSpecial>(circle: &Circle<'_, S>, mut wave: Function<S>, layers: usize) -> (Function<S>, S) {
    let (zero, one) = (circle.parts[0].0.zero(), circle.parts[0].0.one());
    let (half, lag) = (one.ratio(1, 2), circle.lag_bound());
    let mut at_ground = wave.clone();
    add(&mut at_ground, &circle.turned(&wave), &-one.clone());
    circle.antiderivative(&mut at_ground);
    let ground = at_zero(&at_ground[0], &zero) * zero.int(2);
    let mut terms = Vec::with_capacity(layers + 1);
    for j in 0..=layers {
        circle.size.set(lag.powi(j as i32));
        let mut term = wave.clone();
        let turned = circle.turned(&wave);
        add(&mut term, &turned, &-half.clone());
        let corner = at_zero(&turned[0], &zero) * &half;
        for c in &mut term {
            c[0] = c[0].clone() + &corner;
        }
        terms.push(term);
        if j < layers {
            wave = circle.lagged(&wave);
        }
    }
    let mut rate: Function<S> = Vec::new();
    for (j, mut term) in terms.into_iter().enumerate().rev() {
        circle.size.set(lag.powi(j as i32 + 1));
        if j < layers {
            circle.times_s(&mut rate, &zero.ratio(1, 2 * (j as i64 + 1)));
            add(&mut term, &rate, &one);
        }
        rate = term;
    }
    (rate, ground)
}

impl<S: RoundedSpecial> Medium<S> {
    /// Computes the state of a flight `trips` round trips later, and the sums for its account.
    ///
    /// **Accuracy**: the truncation of a cell and a few dozen roundings, relative to the greatest `|q|`.
    pub(super) fn leap(&self, state: &mut State<S>, ground: &S, trips: i64) -> LeapCount {
        if state.bound() == 0.0 {
            // Only the centre of mass moves; over a large number of round trips the series below would overflow.
            state.round += trips;
            return LeapCount::default();
        }
        let damping = self.kappa.clone() + &self.kappa;
        let mut start = damping.zero();
        let mut parts = Vec::with_capacity(state.segments.len());
        for segment in &state.segments {
            parts.push((start.clone(), segment.len.clone()));
            start = start + &segment.len;
        }
        let circle = Circle {
            basis: &self.basis,
            parts,
            lag: binomials(&damping, 1, self.log2_accuracy),
            turn: binomials(&damping, -1, self.log2_accuracy).into_iter().map(|c: S| -c).collect(),
            dropped: Cell::new(0.0),
            weight: Cell::new(1.0),
            integrals: Cell::new(0.0),
            size: Cell::new(1.0),
            accuracy: self.log2_accuracy.exp2(),
        };
        // Powers of G/2 on the characteristic. With Bernoulli's polynomials B_k, ‖D⁻ᵏ‖ ≤ ∫|B_k|/k!, which is ¼, 1/192
        // and 1/7680 for k = 1, 3 and 5. Hence ‖G/2‖ ≤ R²/16 (1 + R²/150) ≤ R²/15.5 for R ≤ 2; no leap has more.
        let layers = self.powers(damping.to_f64().powi(2) / 14.0);
        let mut wave = inwards(&circle, self.scaled(state, &circle, ground), layers);
        let powers = self.pass(&circle, &mut wave, &damping, trips);
        let (rate, ground) = outwards(&circle, wave, layers);
        self.unscaled(&mut state.segments, &circle, &rate, &ground);
        state.round += trips;
        let (dropped, integrals) = (circle.dropped.get(), circle.integrals.get());
        LeapCount { dropped, order: circle.lag.len(), layers, integrals, powers }
    }

    /// Returns the number of terms `sizeᵏ/k!` that reach the accuracy.
    fn powers(&self, size: f64) -> usize {
        let (mut log2_term, mut k) = (0.0, 0usize);
        while log2_term > self.log2_accuracy && k < 1000 {
            k += 1;
            log2_term += (size / k as f64).log2();
        }
        k
    }

    /// Computes `Z` and `Z_s` from `q` and `z(0)`: `Z_s = κZ + ½e^{κs}q`.
    fn scaled(&self, state: &State<S>, circle: &Circle<'_, S>, ground: &S) -> (Function<S>, Function<S>) {
        let size = self.basis.size();
        let (mut here, mut grown) = (ground.clone(), ground.one());
        let (mut value, mut rate) = (Vec::new(), Vec::new());
        for (segment, (_, len)) in state.segments.iter().zip(&circle.parts) {
            let mut push = segment.q.clone();
            push.resize(size, len.zero());
            scale(&mut push, &(grown.clone() * len.ratio(1, 2)));
            grown = grown / &segment.decay;
            // Each iteration of Z = Z(0) + J(κZ + push) adds a power of κ·len ≤ ½.
            let depth = self.kappa.clone() * len;
            circle.drops(&push);
            let first = self.basis.primitive(&push, len, &here);
            let mut sum = first.clone();
            for _ in 0..self.powers(depth.to_f64()) {
                circle.drops(&sum);
                self.basis.integrate(&mut sum);
                scale(&mut sum, &depth);
                for (s, f) in sum.iter_mut().zip(&first) {
                    *s = f.clone() + &*s;
                }
            }
            add_scaled(&mut push, &sum, &self.kappa);
            here = at_one(&sum, &len.zero());
            value.push(sum);
            rate.push(push);
        }
        (value, rate)
    }

    /// Computes `q` from `Z_s` and `Z(0)`.
    fn unscaled(&self, segments: &mut VecDeque<Segment<S>>, circle: &Circle<'_, S>, rate: &[Vec<S>], ground: &S) {
        let (mut here, mut shrunk) = (ground.clone(), ground.int(2));
        for ((segment, rate), (_, len)) in segments.iter_mut().zip(rate).zip(&circle.parts) {
            circle.drops(rate);
            let value = self.basis.primitive(rate, len, &here);
            here = at_one(&value, &len.zero());
            for (k, q) in segment.q.iter_mut().enumerate() {
                *q = (rate[k].clone() - value[k].clone() * &self.kappa) * &shrunk;
            }
            shrunk = shrunk * &segment.decay;
        }
    }

    /// Applies `e^{−Rn} e^{nG}`, and returns the number of powers of `D⁻¹` used.
    ///
    /// The coefficients `e_k` of the powers of `D⁻¹` follow from `E′ = nG′E`: `k e_k = n Σ i g_i e_{k−i}` over odd i.
    fn pass(&self, circle: &Circle<'_, S>, wave: &mut Function<S>, damping: &S, trips: i64) -> usize {
        let n = damping.int(trips);
        let mut coefficients = vec![damping.one()];
        let mut below = 0usize;
        for k in 1..4000usize {
            let mut sum = damping.zero();
            for (m, g) in circle.lag.iter().enumerate() {
                let i = 2 * m + 1;
                if i > k {
                    break;
                }
                sum = sum + g.clone() * damping.int(i as i64) * &coefficients[k - i];
            }
            let next = sum * &n / damping.int(k as i64);
            let size = next.to_f64().abs().log2() + 0.5 * k as f64 * INVERSE_SQUARE.log2();
            coefficients.push(next);
            // After four small terms in a row the coefficients fall faster than geometrically.
            below = if size < self.log2_accuracy - 2.0 { below + 1 } else { 0 };
            if below >= 4 {
                break;
            }
        }
        let mut power = wave.clone();
        for (factor, rest) in coefficients.iter().zip(rests(&coefficients, HALF)).skip(1) {
            circle.weighed(rest, || circle.antiderivative(&mut power));
            circle.size.set(HALF * circle.size.get());
            add(wave, &power, factor);
        }
        circle.size.set(1.0);
        let decay = (-(damping.clone() * &n)).exp();
        for c in wave {
            scale(c, &decay);
        }
        coefficients.len() - 1
    }
}
