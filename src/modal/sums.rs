//! The sums over the modes, with the lattice added up in closed form and a bound for what is left out.

use std::f64::consts::PI;

use super::Modal;
use crate::mapped::{CollectVec, MapEach, mapped};
use crate::motion::Side;
use crate::number::{Estimate, Rounded};

/// The function of time in a sum.
#[derive(Clone, Copy)]
pub(super) enum History {
    /// `S`.
    Sine,
    /// `C − RS`.
    Falling,
    /// `C + RS`.
    Rising,
}

/// The function of place in a sum.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Shape {
    /// `sin ωa`.
    Sine,
    /// `cos ωa`.
    Cosine,
    /// 1.
    Mean,
}

/// `Σ 4 ε^p · motion · shape`; p is odd with the sine and even otherwise.
#[derive(Clone, Copy)]
pub(super) struct Series {
    power: usize,
    motion: History,
    shape: Shape,
}

pub(super) const fn series(power: usize, motion: History, shape: Shape) -> Series {
    Series { power, motion, shape }
}

/// Most powers of ε that are added up in closed form.
const MOST_POWERS: usize = 8;
/// More modes than this are not summed.
pub(super) const MOST_MODES: i64 = 1 << 20;

/// `C` and `S` as power series in `y = −iε` at one time, cut after K powers.
struct Expansion<S> {
    /// `F_m` for each [`History`], m < K.
    powers: [Vec<S>; 3],
    /// How many modes are summed.
    modes: i64,
    /// `ln ρ` and `ln B`.
    circle: [f64; 2],
}

impl<S: Rounded> Modal<S> {
    /// The sums in `list` at `(τ,a)`, damped, each with its bound.
    ///
    /// With `y = −iε`, `C = Re(X e^{iωτ})` and `S = Re(yΓ e^{iωτ})`, `X = exp(τR² y/(1 + √(1 + R²y²)))`,
    /// `Γ = X/√(1 + R²y²)`, and `4 Σ Re(y^m e^{iωα}) = U_m(α)`, see [`lattice`]. A factor ε² is `−y²`, and
    /// `ε Re(Z e^{iωτ}) sin ωa = ½ Re(yZ (e^{iω(τ+a)} − e^{iω(τ−a)}))`: so the power of y and the index of U agree.
    ///
    /// **Accuracy**: for `|y| ≤ ρ ≤ 1/2R` the root has a real part of at least 0.866, so all of X, X ± RyΓ are at most
    /// `B = 1.6 e^{0.54 τR²ρ}`, and yΓ at most ρB. By Cauchy's estimate what K powers leave is at most `2B(ε/ρ)^K` for
    /// `ε ≤ ρ/2`, and `Σ_{n≥N} ε^q ≤ (2πN)^{1−q}/(2π(q − 1))`, because `ω^{−q}` is convex: the modes from N on add less
    /// than `8 B ρ^{−K} (2πN)^{1−K−p}/(2π(K + p − 1))`.
    pub(super) fn sums<const N: usize>(&self, trips: &S, a: &S, side: Side, list: [Series; N]) -> [Estimate<S>; N] {
        let unknown = || Estimate::new(trips.zero(), f64::INFINITY);
        let Some(expansion) = self.expansion(trips) else { return std::array::from_fn(|_| unknown()) };
        let order = expansion.powers[0].len();
        let Some(closed) = closed_sums(trips, a, side, order + 4) else { return std::array::from_fn(|_| unknown()) };
        let (tau, r) = (trips.to_f64(), self.damping.to_f64());
        let fade = (-(self.damping.clone() * trips)).exp();
        // To be damped, and damped already.
        let mut bare: [S; N] = std::array::from_fn(|_| trips.zero());
        let mut damped: [S; N] = std::array::from_fn(|_| trips.zero());
        let (mut bare_roundings, mut damped_roundings) = ([0.0f64; N], [0.0f64; N]);
        let used = [0, 1, 2].map_each(|m| list.iter().any(|s| s.motion as usize == m));
        let pi = trips.pi();
        for n in (0..expansion.modes).rev() {
            let omega = pi.clone() * &trips.int(2 * n + 1);
            let w = omega.to_f64();
            let step = trips.one() / &omega;
            let (alpha, beta) = (omega.clone() * trips, omega.clone() * a);
            let (turn, lift) = (alpha.cos(), alpha.sin());
            let direct = w < 2.0 * r;
            // Re(D e^{iα}), damped part, roundings of both, for each motion.
            let mut motions: [Option<(S, S, f64, f64)>; 3] = [None, None, None];
            let (exact, off) = if direct { self.direct(&omega, trips) } else { self.rotating(&omega, trips) };
            for m in 0..3 {
                if !used[m] {
                    continue;
                }
                let (head, size) = polynomial(&expansion.powers[m], &step);
                let [re, im] = head;
                motions[m] = Some(if direct {
                    let rest = -(re * &turn - im * &lift);
                    (rest, exact[m][0].clone(), size * (12.0 + 8.0 * w * tau), off[m])
                } else {
                    let (re, im) = (exact[m][0].clone() - re, exact[m][1].clone() - im);
                    // The phase turns a difference, which is small where the phase is not well known.
                    let small = re.to_f64().abs() + im.to_f64().abs();
                    (re * &turn - im * &lift, trips.zero(), size * 12.0 + off[m] + small * (8.0 + 8.0 * w * tau), 0.0)
                });
            }
            let (sine, cosine) = (beta.sin(), beta.cos());
            let mut power = trips.int(4);
            let powers: [S; 5] = std::array::from_fn(|_| {
                let next = power.clone() * &step;
                std::mem::replace(&mut power, next)
            });
            for (k, term) in list.iter().enumerate() {
                let Some((rest, own, rest_roundings, own_roundings)) = &motions[term.motion as usize] else { continue };
                let place = match term.shape {
                    Shape::Sine => powers[term.power].clone() * &sine,
                    Shape::Cosine => powers[term.power].clone() * &cosine,
                    Shape::Mean => powers[term.power].clone(),
                };
                let weight = powers[term.power].to_f64();
                let blur = 8.0 + 8.0 * w * a.to_f64().abs();
                let (left, own_part) = (rest.clone() * &place, own.clone() * &place);
                bare_roundings[k] += weight * (rest_roundings + rest.to_f64().abs() * blur);
                damped_roundings[k] += weight * (own_roundings + own.to_f64().abs() * blur);
                bare[k] = bare[k].clone() + left;
                damped[k] = damped[k].clone() + own_part;
                bare_roundings[k] += bare[k].to_f64().abs();
                damped_roundings[k] += damped[k].to_f64().abs();
            }
        }
        let shrink = fade.to_f64();
        std::array::from_fn(|k| {
            let Series { power: p, motion, shape } = list[k];
            let mut sum = bare[k].clone();
            let mut roundings = bare_roundings[k];
            for (m, factor) in expansion.powers[motion as usize].iter().enumerate() {
                let Some((value, size)) = closed.get(shape, m + p) else { continue };
                let part = if p / 2 % 2 == 0 { value } else { -value };
                roundings += factor.to_f64().abs() * size * (24.0 + 4.0 * m as f64 + 4.0 * (tau + 1.0));
                sum = sum + part * factor;
                roundings += sum.to_f64().abs();
            }
            roundings += sum.to_f64().abs() * (8.0 + 4.0 * r * tau);
            let [log_radius, log_bound] = expansion.circle;
            let log_bound = if matches!(motion, History::Sine) { log_bound + log_radius } else { log_bound };
            let q = (order + p) as f64 - 1.0;
            let log_tail = 8f64.ln() + log_bound
                - order as f64 * log_radius
                - q * (2.0 * PI * expansion.modes as f64).ln()
                - (2.0 * PI * q).ln()
                - r * tau;
            let value = sum * &fade + &damped[k];
            let last = 2.0 * value.to_f64().abs();
            self.within(value, roundings * shrink + damped_roundings[k] + last, log_tail, 1.0)
        })
    }

    /// Damped `S`, `C − RS`, `C + RS` of one mode, and their roundings.
    ///
    /// `q = (ω−R)(ω+R)` is off by less than `8uω(ω+R)`, with the rounding of R, and `|dS/dq| = |τC − S|/2|q|` and
    /// `|dC/dq| = τ|S|/2` are below `min(τ³/6, (τ + |q|^{−1/2})/2|q|)` and `min(τ²/2, τ|q|^{−1/2}/2)` times the growth,
    /// 1 or `cosh κτ`.
    fn direct(&self, omega: &S, trips: &S) -> ([[S; 2]; 3], [f64; 3]) {
        let (c, s) = self.pair(omega, trips);
        let (w, r, tau) = (omega.to_f64(), self.damping.to_f64(), trips.to_f64());
        let q = ((omega.clone() - &self.damping) * &(omega.clone() + &self.damping)).to_f64();
        let growth = if q < 0.0 { c.to_f64().abs() } else { (-r * tau).exp() };
        let root = q.abs().sqrt();
        let blur = 8.0 * w * (w + r) * growth;
        let relative = 12.0 + 4.0 * r * tau;
        let off_s = blur * (tau.powi(3) / 6.0).min((tau + 1.0 / root) / (2.0 * q.abs())) + relative * s.to_f64().abs();
        let off_c = blur * (tau * tau / 2.0).min(tau / (2.0 * root)) + relative * growth;
        let damped = s.clone() * &self.damping;
        let zero = || omega.zero();
        let both = off_c + r * off_s + 2.0 * (growth + damped.to_f64().abs());
        ([[s, zero()], [c.clone() - &damped, zero()], [c + &damped, zero()]], [off_s, both, both])
    }

    /// F for `S`, `C − RS`, `C + RS` of one mode with `ω ≥ 2R`, and their roundings: `e^{−iθ}` with
    /// `θ = (ω − Ω)τ = τR²/(ω + Ω)`.
    fn rotating(&self, omega: &S, trips: &S) -> ([[S; 2]; 3], [f64; 3]) {
        let r = &self.damping;
        let frequency = ((omega.clone() - r) * &(omega.clone() + r)).sqrt();
        let lag = r.square() * trips / (omega.clone() + &frequency);
        let (c, s) = (lag.cos(), lag.sin());
        let sine = [-(s.clone() / &frequency), -(c.clone() / &frequency)];
        let (re, im) = (sine[0].clone() * r, sine[1].clone() * r);
        let falling = [c.clone() - &re, -(s.clone() + &im)];
        let rising = [c + &re, im - &s];
        let off = 16.0 + 8.0 * lag.to_f64();
        ([sine, falling, rising], [off / frequency.to_f64(), 2.0 * off, 2.0 * off])
    }

    /// The series at one time, with the number K of powers that promises most.
    ///
    /// More powers leave less behind but are larger, by `|F_m| ≈ (τR²/2)^m/m!`, than what they add up to.
    fn expansion(&self, trips: &S) -> Option<Expansion<S>> {
        let (r, tau) = (self.damping.to_f64(), trips.to_f64());
        let powers = self.powers(trips);
        let turn = 0.54 * tau * r * r;
        let mut best: Option<(f64, usize, i64, [f64; 2])> = None;
        let mut rounding = 0.0;
        for order in 2..=MOST_POWERS {
            let taken = order - 1;
            let sizes = [&powers[0][taken], &powers[1][taken]].map_each(|f| f.to_f64().abs());
            rounding += 100.0 * trips.unit() * (sizes[0] + sizes[1]) / PI.powi(taken as i32);
            for radius in [order as f64 / turn, 0.5 / r].map_each(|rho| rho.min(0.5 / r).min(1e300)) {
                let least = 1.0 / (PI * radius) + 1.0;
                if least.is_nan() || least > MOST_MODES as f64 {
                    continue;
                }
                let modes = self.modes.max(least as i64 + 1);
                let circle = [radius.ln(), turn * radius + 1.6f64.ln()];
                let tail = (circle[1] + circle[0]
                    - order as f64 * circle[0]
                    - (order as f64 - 1.0) * (2.0 * PI * modes as f64).ln())
                .exp();
                let error = tail + rounding;
                if best.as_ref().is_none_or(|b| error < b.0) {
                    best = Some((error, order, modes, circle));
                }
            }
        }
        let (_, order, modes, circle) = best?;
        let powers = powers.map(|mut list| {
            list.truncate(order);
            list
        });
        Some(Expansion { powers, modes, circle })
    }

    /// `F_m`, m < 8: X by the recurrence of an exponential, Γ by the binomial series.
    fn powers(&self, trips: &S) -> [Vec<S>; 3] {
        let square = self.damping.square();
        let zero = || trips.zero();
        let mut exponent: Vec<S> = mapped(0..MOST_POWERS, |_| zero());
        let mut root = exponent.clone();
        let (mut half, mut inverse) = (trips.ratio(1, 2) * trips * &square, trips.one());
        for m in (0..MOST_POWERS as i64).step_by(2) {
            root[m as usize] = inverse.clone();
            exponent[m as usize + 1] = half.clone();
            // binom(½, k+1)/binom(½, k) = (1 − 2k)/(2k + 2) with k = m/2 + 1; the same for −½ with k = m/2.
            half = half * &square * &trips.ratio(-(m + 1), m + 4);
            inverse = inverse * &square * &trips.ratio(-(m + 1), m + 2);
        }
        let mut x = vec![trips.one()];
        for n in 1..MOST_POWERS {
            let sum = (1..=n).fold(zero(), |sum, k| sum + exponent[k].clone() * &x[n - k] * &trips.int(k as i64));
            x.push(sum / trips.int(n as i64));
        }
        let gamma = |n: usize| (0..=n).fold(zero(), |sum, k| sum + root[k].clone() * &x[n - k]);
        let sine: Vec<S> = mapped(0..MOST_POWERS, |m| if m == 0 { zero() } else { gamma(m - 1) });
        let falling = x.iter().zip(&sine).map(|(x, s)| x.clone() - self.damping.clone() * s).collect_vec();
        let rising = x.iter().zip(&sine).map(|(x, s)| x.clone() + self.damping.clone() * s).collect_vec();
        [sine, falling, rising]
    }
}

/// `Σ F_m (−iε)^m`, and its roundings.
fn polynomial<S: Rounded>(powers: &[S], step: &S) -> ([S; 2], f64) {
    let mut parts = [step.zero(), step.zero()];
    let mut size = 0.0;
    let mut power = step.one();
    for (m, factor) in powers.iter().enumerate() {
        let term = power.clone() * factor;
        size += term.to_f64().abs() * (1.0 + m as f64 / 4.0);
        let part = parts[m % 2].clone();
        // 1, −i, −1, i.
        parts[m % 2] = if m % 4 == 0 || m % 4 == 3 { part + term } else { part - term };
        power = power * step;
    }
    (parts, size)
}

/// `U_m` at `τ + a` and at `τ − a`.
struct Closed<S> {
    later: Vec<S>,
    earlier: Vec<S>,
}

impl<S: Rounded> Closed<S> {
    /// The closed sum, and a bound of it and of its derivative; none for m = 0, which has no factor.
    fn get(&self, shape: Shape, m: usize) -> Option<(S, f64)> {
        let (later, earlier) = (self.later.get(m)?, self.earlier.get(m)?);
        if m == 0 {
            return None;
        }
        let two = later.int(2);
        let value = match shape {
            Shape::Sine => (later.clone() - earlier) / two,
            Shape::Cosine => (later.clone() + earlier) / two,
            Shape::Mean => later.clone(),
        };
        // 4 Σ ε^{m−1} ≤ 5 π^{1−m} for m ≥ 3; 1 and 1/2 below.
        Some((value, 5.0 * PI.powi(1 - m as i32)))
    }
}

fn closed_sums<S: Rounded>(trips: &S, a: &S, side: Side, count: usize) -> Option<Closed<S>> {
    let numbers = euler(trips, count);
    Some(Closed {
        later: lattice(&(trips.clone() + a), side, &numbers)?,
        earlier: lattice(&(trips.clone() - a), side, &numbers)?,
    })
}

/// `c_j = E_j/(2^j j!)` with Euler's numbers, from `Σ c_j z^j = 1/cosh(z/2)`.
fn euler<S: Rounded>(like: &S, count: usize) -> Vec<S> {
    // cosh(z/2) = Σ h_j z^j, j even.
    let mut cosh = vec![like.one()];
    for j in 1..=count as i64 {
        let next = cosh[cosh.len() - 1].clone() / like.int(2 * j);
        cosh.push(next);
    }
    let mut list: Vec<S> = vec![like.one()];
    for j in 1..=count {
        let mut sum = like.zero();
        for k in (2..=j).step_by(2) {
            sum = sum - list[j - k].clone() * &cosh[k];
        }
        list.push(sum);
    }
    list
}

/// `U_m(α) = 4 Σ Re((−i)^m e^{iωα})/ω^m = (−1)^{⌊α⌋} E_{m−1}(α − ⌊α⌋)/(m−1)!`, m = 0 … (the first is a placeholder).
///
/// `U_1` is the square wave, `U_m′ = U_{m−1}`, and each changes its sign over a round trip, which fixes the constant:
/// Euler's polynomials, here by their expansion about 1/2.
fn lattice<S: Rounded>(alpha: &S, side: Side, numbers: &[S]) -> Option<Vec<S>> {
    let mut whole = alpha.floor_int()?;
    if side == Side::Left && *alpha == alpha.int(whole) {
        whole -= 1;
    }
    let z = alpha.clone() - alpha.int(whole) - alpha.ratio(1, 2);
    let mut list = vec![alpha.zero()];
    for m in 0..numbers.len() - 1 {
        // Σ_k z^k/k! c_{m−k}, by Horner.
        let mut sum = numbers[0].clone();
        for k in (0..m).rev() {
            sum = sum * &z / alpha.int(k as i64 + 1) + &numbers[m - k];
        }
        list.push(if whole % 2 == 0 { sum } else { -sum });
    }
    Some(list)
}
