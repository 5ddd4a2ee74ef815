//! Initial state: from displacement and velocity at `t = 0` to the characteristic that leaves the ground at `t = 0`.
//!
//! Reflection of `z = v − v_s` at the top continues the rod, so the data live on `0 ≤ x ≤ 1` (in `c t₁`). Between
//! breaks `z_x` and `z_t` are linear in `x`, and the solution that continues such data to the whole plane is
//! elementary:
//!
//! ```text
//! z_x = b + d (x−x₀) + e τ(t),    z_t = d τ(t) + (a + e (x−x₀)) e^{−2rt},    τ(t) = (1 − e^{−2rt})/2r
//! ```
//!
//! It holds in the triangle above its interval; the square cell around that triangle takes its lower sides from it.

use std::collections::VecDeque;

use super::cell::Cell;
use super::march::{Medium, State};
use crate::error::Error;
use crate::motion::{AtStart, Scales, Segment};
use crate::number::Rounded;
use crate::problem::{Parameters, Problem, Start, Top};
use crate::special::RoundedSpecial;

/// Number of bits by which the truncation of series lies below a rounding: their sum is hardly more than the rounding.
const SPARE_BITS: f64 = 4.0;

/// Largest damping `R`: cells are at most `2/r` wide, so a round trip takes `(r t₁/2)²` of them, at most a million.
const MOST_DAMPING: f64 = 2000.0;

/// Linear data on an interval.
#[derive(Clone, Debug)]
pub(super) struct Linear<S> {
    from: S,
    len: S,
    /// `z_x` at `from`: `b`.
    strain: S,
    /// `z_t` at `from`: `a`.
    velocity: S,
    /// `dz_x/dx`: `d`.
    strain_slope: S,
    /// `dz_t/dx`: `e`.
    velocity_slope: S,
}

impl<S: Rounded> Linear<S> {
    /// Returns the mirror image about `x = ½` for even or odd `z`.
    fn mirrored(&self, even: bool) -> Self {
        let sign = |value: S| if even { value } else { -value };
        let strain = self.strain.clone() + self.strain_slope.clone() * &self.len;
        let velocity = self.velocity.clone() + self.velocity_slope.clone() * &self.len;
        Linear {
            from: self.from.one() - &self.from - &self.len,
            len: self.len.clone(),
            strain: sign(-strain),
            velocity: sign(velocity),
            strain_slope: sign(self.strain_slope.clone()),
            velocity_slope: sign(-self.velocity_slope.clone()),
        }
    }

    /// Returns whether `next` continues these data linearly.
    fn continues_in(&self, next: &Self) -> bool {
        self.strain.clone() + self.strain_slope.clone() * &self.len == next.strain
            && self.velocity.clone() + self.velocity_slope.clone() * &self.len == next.velocity
            && self.strain_slope == next.strain_slope
            && self.velocity_slope == next.velocity_slope
    }

    fn part(&self, offset: &S, len: S) -> Self {
        Linear {
            from: self.from.clone() + offset,
            len,
            strain: self.strain.clone() + self.strain_slope.clone() * offset,
            velocity: self.velocity.clone() + self.velocity_slope.clone() * offset,
            ..self.clone()
        }
    }

    /// Computes `z_t` and `z_x` of the continued solution at `x = from + offset` and time `t`.
    fn at(&self, damping: &S, offset: &S, t: &S) -> (S, S) {
        let decay = (damping.clone() * t * t.int(-2)).exp();
        let tau = t.clone() * phi_one(&(damping.clone() * t * t.int(-2)));
        let z_t =
            self.strain_slope.clone() * &tau + (self.velocity.clone() + self.velocity_slope.clone() * offset) * decay;
        let z_x = self.strain.clone() + self.strain_slope.clone() * offset + self.velocity_slope.clone() * tau;
        (z_t, z_x)
    }
}

/// Rounds a place in `0 … 1` to the nearest multiple of two roundings of 1; sums and differences of such are exact.
pub(super) fn on_grid<S: Rounded>(place: S) -> S {
    let one = place.one();
    place + &one - &one
}

/// Computes `φ₁(z) = (eᶻ − 1)/z = Σ zᵏ/(k+1)!` for `|z| ≤ 2`, without a division by `z`.
fn phi_one<S: Rounded>(z: &S) -> S {
    let (mut sum, mut term) = (z.one(), z.one());
    for k in 2..10_000 {
        term = term * z / z.int(k);
        let next = sum.clone() + &term;
        if next == sum {
            break;
        }
        sum = next;
    }
    sum
}

/// Initial data in dimensionless form.
#[derive(Clone, Debug)]
pub(super) struct Data<S> {
    /// `t₁`, `V = max(|data|, g t₁)` or 1 if all of these vanish, and the scales of the problem.
    pub(super) units: Scales<S>,
    /// `V t₁`.
    pub(super) displacement: S,
    /// `R = r t₁`.
    pub(super) damping: S,
    /// `g t₁/V`.
    pub(super) gravity: S,
    /// `v_s′(0)`.
    pub(super) slope: S,
    /// Initial data in the units of the problem.
    pub(super) given: AtStart<S>,
    /// `v(0,0)`.
    pub(super) ground: S,
    /// Whether the rod starts undeformed, with one velocity.
    pub(super) rigid: bool,
    /// Whether `h(0)` and `h′(0)` are exactly zero.
    pub(super) zero_means: [bool; 2],
    /// Dimensionless data on the whole rod, without its mirror image.
    half: Vec<Linear<S>>,
    /// Bound of the terms in the dimensionless data, before differences of displacements are taken.
    pub(super) most: f64,
    /// Length of the shortest part of the rod between breaks, as a fraction of `c t₁`.
    pub(super) shortest: f64,
}

impl<S: Rounded> Data<S> {
    /// Computes the dimensionless data of `problem`.
    ///
    /// **Accuracy**: a few roundings.
    pub(super) fn of(problem: &Problem, parameters: &Parameters<S>, free_top: bool) -> Self {
        let time = parameters.round_trip();
        let zero = time.zero();
        let given = AtStart::of(problem, parameters);
        let gravity_speed = parameters.critical_speed();
        let mut scale = gravity_speed.clone();
        let mut raise = |candidate: S| {
            if candidate > scale {
                scale = candidate;
            }
        };
        for Segment { velocities, strains, .. } in &given.segments {
            velocities.iter().for_each(|velocity| raise(velocity.magnitude()));
            strains.iter().for_each(|strain| raise((strain.clone() * &parameters.wave_speed).magnitude()));
        }
        if let Some((_, v)) = given.displacement.first() {
            raise((v.clone() / &time).magnitude());
        }
        if scale.is_zero() {
            scale = zero.one();
        }
        let gravity = gravity_speed / &scale;
        let displacement = scale.clone() * &time;
        // The static state is v_s = g x²/2 + slope·x, stress-free or at its given height at x = ½.
        let ground = given.displacement.first().map_or_else(|| zero.clone(), |(_, v)| v.clone() / &displacement);
        let last = given.top() / &displacement;
        let slope = if free_top {
            gravity.clone() * zero.ratio(-1, 2)
        } else {
            last * zero.int(2) - gravity.clone() * zero.ratio(1, 4)
        };
        let reach = parameters.length.int(2) * &parameters.length;
        let piece = |Segment { ends, velocities, strains }: &Segment<S>| {
            let [from, to] = ends.each_ref().map(|x| x.clone() / &reach);
            let ([left, right], len) = (velocities.each_ref().map(|v| v.clone() / &scale), to - &from);
            let [low, high] = strains.each_ref().map(|strain| strain.clone() * &reach / &displacement);
            Linear {
                strain_slope: (high - &low) / &len - &gravity,
                strain: low - &slope - gravity.clone() * &from,
                velocity_slope: (right - &left) / &len,
                velocity: left,
                from,
                len,
            }
        };
        let half: Vec<Linear<S>> = given.segments.iter().map(piece).collect();
        let shortest = half.iter().map(|piece| piece.len.to_f64()).fold(1.0, f64::min);
        let greatest = |list: &[(S, S)]| list.iter().map(|(_, v)| v.to_f64().abs()).fold(0.0, f64::max);
        let far = greatest(&given.displacement) / displacement.to_f64();
        let fast = greatest(&given.velocity) / scale.to_f64();
        // Strains are at most 1 in these units. Their slopes are differences, and the top is the sum of their areas.
        let strained = if given.is_strained() { 2.0 / shortest + given.segments.len() as f64 } else { 0.0 };
        let most = 2.0 * far / shortest + 2.0 * fast / shortest + strained + gravity.to_f64() + slope.to_f64().abs();
        let damping = parameters.damping.clone() * &time;
        let units = Scales { time, velocity: scale, ..Scales::of(parameters) };
        let zero_means = match problem.start() {
            Start::Profile(profile) => Some(profile.has_zero_means()),
            _ => None,
        };
        let (rigid, zero_means) = (zero_means.is_none(), zero_means.unwrap_or_default());
        Data { units, displacement, damping, gravity, slope, given, ground, rigid, zero_means, half, most, shortest }
    }

    /// Returns `v_t(0⁺, 0)`.
    pub(super) fn end_velocity(&self) -> S {
        self.half.first().map_or_else(|| self.slope.zero(), |piece| piece.velocity.clone())
    }

    /// Marches from `ξ = −1` to `ξ = 0`; `visit` receives every cell, and those beyond `x = ½` are mirror images.
    pub(super) fn march(&self, medium: &Medium<S>, visit: &mut dyn FnMut(&Cell<'_, S>)) -> State<S> {
        let zero = self.slope.zero();
        let mirror = self.half.iter().rev().map(|piece| piece.mirrored(medium.free_top));
        let mut pieces: Vec<Linear<S>> = Vec::new();
        for piece in self.half.iter().cloned().chain(mirror) {
            match pieces.last_mut() {
                Some(last) if last.continues_in(&piece) => last.len = last.len.clone() + &piece.len,
                _ => pieces.push(piece),
            }
        }
        let pieces = pieces.iter().flat_map(|piece| {
            let count = (piece.len.clone() / &medium.longest).to_f64().ceil().max(1.0) as i64;
            let len = piece.len.clone() / zero.int(count);
            let ends: Vec<S> = (0..=count).map(|k| on_grid(piece.from.clone() + len.clone() * len.int(k))).collect();
            let part = |pair: &[S]| Linear {
                from: pair[0].clone(),
                ..piece.part(&(pair[0].clone() - &piece.from), pair[1].clone() - &pair[0])
            };
            ends.windows(2).map(part).collect::<Vec<_>>()
        });
        let mut state = State { round: 0, segments: VecDeque::new() };
        for piece in pieces.collect::<Vec<_>>().into_iter().rev() {
            let half = zero.ratio(1, 2);
            let side = |sign: i64| -> Vec<S> {
                let value = |x: &S| {
                    let shift = (x.clone() * &piece.len) * &half;
                    let offset = piece.len.clone() * &half + shift.clone() * shift.int(sign);
                    let t = shift - piece.len.clone() * &half;
                    let (z_t, z_x) = piece.at(&self.damping, &offset, &t);
                    if sign > 0 { z_t + z_x } else { z_t - z_x }
                };
                medium.basis.nodes().iter().map(value).collect()
            };
            let p = medium.segment(piece.from.clone(), piece.len.clone(), &side(-1));
            let q = medium.segment(piece.from.clone(), piece.len.clone(), &side(1));
            let end = piece.from.clone() + &piece.len;
            medium.rise(&mut state, (p, q), (-end, piece.from.clone()), visit);
        }
        state
    }
}

/// Builds the medium and the data of `problem` for `digits` digits, with segments `shorten` times shorter than needed.
///
/// **Errors**: [`Error::DampingTooStrong`], [`Error::Irrational`].
pub(super) fn medium<S: RoundedSpecial>(
    problem: &Problem,
    precision: &S::Precision,
    digits: f64,
    shorten: i64,
) -> Result<(Medium<S>, Data<S>), Error> {
    let parameters = Parameters::<S>::of(problem, precision)?;
    let free_top = problem.top() == Top::Free;
    let data = Data::of(problem, &parameters, free_top);
    let asked = -digits.max(1.0) * std::f64::consts::LOG2_10 - 20.0;
    let log2_accuracy = asked.max(data.damping.log2_roundoff() - SPARE_BITS);
    let found = data.damping.to_f64();
    if found > MOST_DAMPING {
        return Err(Error::DampingTooStrong { found, most: MOST_DAMPING });
    }
    Ok((Medium::new(&data.damping, (data.gravity.clone(), data.slope.clone()), free_top, log2_accuracy, shorten), data))
}
