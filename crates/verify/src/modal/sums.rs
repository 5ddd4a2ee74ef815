//! The sums over the modes, with the lattice added up in closed form and a bound for what is left out.

use std::f64::consts::PI;

use super::Modal;
use dalembert::Side;
use dalembert::number::{Analytic, Estimate, Rounded, Scalar};
use dalembert::special::RoundedSpecial;

/// The function of time in a sum.
#[derive(Clone, Copy)]
pub(super) enum TimeFactor {
    /// `S`.
    Sine,
    /// `C − RS`.
    Falling,
    /// `C + RS`.
    Rising,
}

/// The function of place in a sum.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum SpaceFactor {
    /// `sin ωa`.
    Sine,
    /// `cos ωa`.
    Cosine,
    /// 1.
    Mean,
}

/// `Σ 4 ε^p · time · space`; p is odd with the sine and even otherwise.
#[derive(Clone, Copy)]
pub(super) struct Series {
    power: usize,
    time: TimeFactor,
    space: SpaceFactor,
}

pub(super) const fn series(power: usize, time: TimeFactor, space: SpaceFactor) -> Series {
    Series { power, time, space }
}

/// Maximum number of powers of ε that are added up in closed form.
const MOST_POWERS: usize = 8;
/// Maximum number of modes of a sum.
pub(super) const MOST_MODES: i64 = 1 << 20;

/// `C` and `S` as power series in `y = −iε` at one time, cut after K powers.
struct Expansion<S> {
    /// `F_m` for each [`TimeFactor`], m < K.
    powers: [Vec<Estimate<S>>; 3],
    /// Number of modes that are summed.
    modes: i64,
    /// `ln ρ` and `ln B`.
    circle: [f64; 2],
}

impl<S: RoundedSpecial> Expansion<S> {
    /// Adds the powers of ε, whose sums are known in closed form, to the `sum` of a series.
    fn add_closed(&self, mut sum: Estimate<S>, closed: &ClosedSums<S>, series: Series) -> Estimate<S> {
        let Series { power: p, time, space } = series;
        for (m, factor) in self.powers[time as usize].iter().enumerate() {
            let Some(value) = closed.get(space, m + p) else { continue };
            let part = if p / 2 % 2 == 0 { value } else { -value };
            sum = sum + part * factor;
        }
        sum
    }

    /// Returns the logarithm of the bound of what the modes from N on add to a series, see [`Modal::sums`].
    fn log_tail(&self, Series { power: p, time, .. }: Series) -> f64 {
        let (order, [log_radius, log_bound]) = (self.powers[0].len(), self.circle);
        let log_bound = if matches!(time, TimeFactor::Sine) { log_bound + log_radius } else { log_bound };
        let q = (order + p) as f64 - 1.0;
        8f64.ln() + log_bound
            - order as f64 * log_radius
            - q * (2.0 * PI * self.modes as f64).ln()
            - (2.0 * PI * q).ln()
    }
}

/// A choice of K powers of ε and N modes.
struct Truncation {
    /// Estimated error of the sums.
    error: f64,
    /// K.
    order: usize,
    /// N.
    modes: i64,
    /// `ln ρ` and `ln B`.
    circle: [f64; 2],
}

impl<S: RoundedSpecial> Modal<S> {
    /// Computes the sums in `list` at `(τ,a)`, damped, each with its bound.
    ///
    /// With `y = −iε`, `C = Re(X e^{iωτ})` and `S = Re(yΓ e^{iωτ})`, `X = exp(τR² y/(1 + √(1 + R²y²)))`,
    /// `Γ = X/√(1 + R²y²)`, and `4 Σ Re(y^m e^{iωα}) = U_m(α)`, see [`lattice`]. A factor ε² is `−y²`, and
    /// `ε Re(Z e^{iωτ}) sin ωa = ½ Re(yZ (e^{iω(τ+a)} − e^{iω(τ−a)}))`: so the power of y and the index of U agree.
    ///
    /// **Accuracy**: for `|y| ≤ ρ ≤ 1/2R` the root has a real part of at least 0.866, so all of X, X ± RyΓ are at most
    /// `B = 1.6 e^{0.54 τR²ρ}`, and yΓ at most ρB. By Cauchy's estimate what K powers leave is at most `2B(ε/ρ)^K` for
    /// `ε ≤ ρ/2`, and `Σ_{n≥N} ε^q ≤ (2πN)^{1−q}/(2π(q − 1))`, because `ω^{−q}` is convex: the modes from N on add less
    /// than `8 B ρ^{−K} (2πN)^{1−K−p}/(2π(K + p − 1))`.
    pub(super) fn sums<const N: usize>(
        &self,
        trips: &Estimate<S>,
        a: &Estimate<S>,
        side: Side,
        list: [Series; N],
    ) -> [Estimate<S>; N] {
        let unknown = || std::array::from_fn(|_| Estimate::new(trips.value().zero(), f64::INFINITY));
        let Some(expansion) = self.expansion(trips) else { return unknown() };
        let order = expansion.powers[0].len();
        let Some(closed) = ClosedSums::new(trips, a, side, order + 4) else { return unknown() };
        let (tau, r) = (trips.to_f64(), self.damping.to_f64());
        let fade = (-(self.damping.clone() * trips)).exp();
        // Parts of the sums without and with the factor e^{−Rτ}.
        let mut bare: [Estimate<S>; N] = std::array::from_fn(|_| trips.zero());
        let mut damped: [Estimate<S>; N] = std::array::from_fn(|_| trips.zero());
        let used = [0, 1, 2].map(|m| list.iter().any(|s| s.time as usize == m));
        let pi = trips.pi();
        for n in (0..expansion.modes).rev() {
            let omega = pi.clone() * &trips.int(2 * n + 1);
            let step = trips.one() / &omega;
            let (alpha, beta) = (omega.clone() * trips, omega.clone() * a);
            let (turn, lift) = (alpha.cos(), alpha.sin());
            let none = [trips.zero(), trips.zero(), trips.zero()];
            let (exact, own) = if omega.to_f64() < 2.0 * r {
                (none.clone().map(|zero| [zero.clone(), zero]), self.direct(&omega, trips))
            } else {
                (self.rotating(&omega, trips), none)
            };
            // Re(D e^{iα}) for each function of time: the phase turns a difference, which is small where it is not well
            // known.
            let mut rests = [None, None, None];
            for (m, [re, im]) in exact.into_iter().enumerate().filter(|(m, _)| used[*m]) {
                let head = polynomial(&expansion.powers[m], &step);
                rests[m] = Some((re - &head[0]) * &turn - (im - &head[1]) * &lift);
            }
            let (sine, cosine) = (beta.sin(), beta.cos());
            let mut power = trips.int(4);
            let powers: [Estimate<S>; 5] = std::array::from_fn(|_| {
                let next = power.clone() * &step;
                std::mem::replace(&mut power, next)
            });
            for (k, term) in list.iter().enumerate() {
                let (Some(rest), own) = (&rests[term.time as usize], &own[term.time as usize]) else { continue };
                let space = match term.space {
                    SpaceFactor::Sine => powers[term.power].clone() * &sine,
                    SpaceFactor::Cosine => powers[term.power].clone() * &cosine,
                    SpaceFactor::Mean => powers[term.power].clone(),
                };
                bare[k] = bare[k].clone() + rest.clone() * &space;
                damped[k] = damped[k].clone() + own.clone() * &space;
            }
        }
        std::array::from_fn(|k| {
            let sum = expansion.add_closed(bare[k].clone(), &closed, list[k]);
            within(sum * &fade + &damped[k], expansion.log_tail(list[k]) - r * tau)
        })
    }

    /// Computes F for `S`, `C − RS`, `C + RS` of one mode with `ω ≥ 2R`: `e^{−iθ}` with `θ = (ω − Ω)τ = τR²/(ω + Ω)`.
    fn rotating(&self, omega: &Estimate<S>, trips: &Estimate<S>) -> [[Estimate<S>; 2]; 3] {
        let r = &self.damping;
        let frequency = ((omega.clone() - r) * &(omega.clone() + r)).sqrt();
        let lag = r.square() * trips / (omega.clone() + &frequency);
        let (c, s) = (lag.cos(), lag.sin());
        let sine = [-(s.clone() / &frequency), -(c.clone() / &frequency)];
        let (re, im) = (sine[0].clone() * r, sine[1].clone() * r);
        let falling = [c.clone() - &re, -(s.clone() + &im)];
        let rising = [c + &re, im - &s];
        [sine, falling, rising]
    }

    /// Expands the motion at one time, with the number K of powers that promises the least error.
    ///
    /// More powers leave less behind, but exceed their sum by `|F_m| ≈ (τR²/2)^m/m!`.
    fn expansion(&self, trips: &Estimate<S>) -> Option<Expansion<S>> {
        let (r, tau) = (self.damping.to_f64(), trips.to_f64());
        let powers = self.powers(trips);
        let turn = 0.54 * tau * r * r;
        let mut best: Option<Truncation> = None;
        let mut rounding = 0.0;
        for order in 2..=MOST_POWERS {
            let taken = order - 1;
            let sizes = [&powers[0][taken], &powers[1][taken]].map(|f| f.to_f64().abs());
            rounding += 100.0 * trips.value().unit() * (sizes[0] + sizes[1]) / PI.powi(taken as i32);
            for radius in [order as f64 / turn, 0.5 / r].map(|rho| rho.min(0.5 / r).min(1e300)) {
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
                if best.as_ref().is_none_or(|best| error < best.error) {
                    best = Some(Truncation { error, order, modes, circle });
                }
            }
        }
        let Truncation { order, modes, circle, .. } = best?;
        let powers = powers.map(|mut list| {
            list.truncate(order);
            list
        });
        Some(Expansion { powers, modes, circle })
    }

    /// Computes `F_m`, m < 8: X by the recurrence of an exponential, Γ by the binomial series.
    fn powers(&self, trips: &Estimate<S>) -> [Vec<Estimate<S>>; 3] {
        let square = self.damping.square();
        let zero = || trips.zero();
        let mut exponent: Vec<Estimate<S>> = (0..MOST_POWERS).map(|_| zero()).collect();
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
        let sine: Vec<Estimate<S>> = (0..MOST_POWERS).map(|m| if m == 0 { zero() } else { gamma(m - 1) }).collect();
        let falling = x.iter().zip(&sine).map(|(x, s)| x.clone() - self.damping.clone() * s).collect();
        let rising = x.iter().zip(&sine).map(|(x, s)| x.clone() + self.damping.clone() * s).collect();
        [sine, falling, rising]
    }
}

/// Computes `Σ F_m (−iε)^m`.
fn polynomial<S: Rounded>(powers: &[Estimate<S>], step: &Estimate<S>) -> [Estimate<S>; 2] {
    let mut parts = [step.zero(), step.zero()];
    let mut power = step.one();
    for (m, factor) in powers.iter().enumerate() {
        let (term, part) = (power.clone() * factor, parts[m % 2].clone());
        // 1, −i, −1, i.
        parts[m % 2] = if m % 4 == 0 || m % 4 == 3 { part + term } else { part - term };
        power = power * step;
    }
    parts
}

/// `U_m` at `τ + a` and at `τ − a`.
struct ClosedSums<S> {
    later: Vec<Estimate<S>>,
    earlier: Vec<Estimate<S>>,
}

impl<S: Rounded> ClosedSums<S> {
    fn new(trips: &Estimate<S>, a: &Estimate<S>, side: Side, count: usize) -> Option<Self> {
        let numbers = euler(trips, count);
        Some(ClosedSums {
            later: lattice(&(trips.clone() + a), side, &numbers)?,
            earlier: lattice(&(trips.clone() - a), side, &numbers)?,
        })
    }

    /// Returns the closed sum; `None` for m = 0, which has no factor.
    fn get(&self, space: SpaceFactor, m: usize) -> Option<Estimate<S>> {
        let (later, earlier) = (self.later.get(m)?, self.earlier.get(m)?);
        let two = later.int(2);
        match space {
            _ if m == 0 => None,
            SpaceFactor::Sine => Some((later.clone() - earlier) / two),
            SpaceFactor::Cosine => Some((later.clone() + earlier) / two),
            SpaceFactor::Mean => Some(later.clone()),
        }
    }
}

/// Computes `c_j = E_j/(2^j j!)` with Euler's numbers, from `Σ c_j z^j = 1/cosh(z/2)`.
fn euler<S: Rounded>(like: &Estimate<S>, count: usize) -> Vec<Estimate<S>> {
    // cosh(z/2) = Σ h_j z^j, j even.
    let mut cosh = vec![like.one()];
    for j in 1..=count as i64 {
        let next = cosh[cosh.len() - 1].clone() / like.int(2 * j);
        cosh.push(next);
    }
    let mut list = vec![like.one()];
    for j in 1..=count {
        let mut sum = like.zero();
        for k in (2..=j).step_by(2) {
            sum = sum - list[j - k].clone() * &cosh[k];
        }
        list.push(sum);
    }
    list
}

/// Computes `U_m(α) = 4 Σ Re((−i)^m e^{iωα})/ω^m = (−1)^{⌊α⌋} E_{m−1}(α − ⌊α⌋)/(m−1)!`, m = 0 … (the first is a
/// placeholder).
///
/// `U_1` is the square wave, `U_m′ = U_{m−1}`, and each changes its sign over a round trip, which fixes the constant:
/// Euler's polynomials, here by their expansion about 1/2.
fn lattice<S: Rounded>(alpha: &Estimate<S>, side: Side, numbers: &[Estimate<S>]) -> Option<Vec<Estimate<S>>> {
    let mut whole = alpha.value().floor_int()?;
    if side == Side::Left && *alpha.value() == alpha.value().int(whole) {
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

/// Returns `value` with a bound that includes the tail `e^log_tail`; the bound of a value that is no number is
/// infinite.
pub(super) fn within<S: Rounded>(value: Estimate<S>, log_tail: f64) -> Estimate<S> {
    let error = value.error() + (log_tail - value.log2_roundoff() * std::f64::consts::LN_2).exp();
    let known = value.is_finite() && !error.is_nan();
    Estimate::new(value.into_value(), if known { error.max(f64::MIN_POSITIVE) } else { f64::INFINITY })
}
