//! The problem in its own units: one round trip, and the speed that gravity gives in it.

use crate::error::Error;
use crate::number::{Number, Scalar};
use crate::rod::{Parameters, Problem, Profile, Start, Top};

/// The units in which the lattice computes: with them a break returns after exactly 1, and gravity is 1 or 0.
#[derive(Clone, Debug)]
pub struct Units<S> {
    /// The unit of time, `t₁ = 2L/c`.
    pub round_trip: S,
    /// The unit of velocity: `μ₀ = g t₁` with gravity, `μ` (or the greatest initial speed) without.
    pub velocity: S,
    /// `L`, the length of the rod.
    pub length: S,
    /// `c`.
    pub wave_speed: S,
}

/// The undamped problem in [`Units`].
#[derive(Clone, Debug)]
pub struct Scaled<S> {
    /// What the units are.
    pub units: Units<S>,
    /// Gravity: 1 or 0.
    pub gravity: S,
    /// The end `x = L`.
    pub top: Top,
    /// `v(0,0)`.
    pub ground_start: S,
    /// `v_t(0,0)`.
    pub ground_velocity: S,
    /// The trace of `p` at the ground that, one round trip before the start, would have sent what the rod carries at
    /// `t = 0`: `(fraction, value, slope)` in order of the fraction, the first at 0.
    pub before: Vec<(S, S, S)>,
}

impl<S: Scalar> Scaled<S> {
    /// `problem` in the units of its own lattice.
    ///
    /// **Source**: `q(0,t) = q₀(ct) − g t` until `L/c` and, reflected at the top, `p₀(2L − ct)` after it.
    ///
    /// **Accuracy**: *exact* in fractions, a few roundings otherwise.
    ///
    /// **Errors**: [`Error::Irrational`] where a fraction cannot hold a parameter.
    pub fn of(problem: &Problem, precision: &S::Precision) -> Result<Self, Error> {
        let given = Parameters::<S>::of(problem, precision)?;
        let round_trip = given.round_trip();
        let has_gravity = !given.gravity.is_zero();
        let one = given.length.one();
        let gravity = if has_gravity { one.clone() } else { one.zero() };
        let fall = given.critical_speed();
        let units = |velocity: S| Units {
            round_trip: round_trip.clone(),
            velocity,
            length: given.length.clone(),
            wave_speed: given.wave_speed.clone(),
        };
        match &problem.start {
            Start::Uniform(_) => {
                let velocity = if has_gravity { fall } else { given.speed.clone() };
                let speed = given.speed.clone() / &velocity;
                let before = match problem.rod.top {
                    Top::Free => vec![(one.zero(), gravity.clone() - &speed, -gravity.clone())],
                    Top::Fixed => vec![
                        (one.zero(), speed.clone(), gravity.clone()),
                        (one.ratio(1, 2), gravity.clone() * one.ratio(1, 2) - &speed, -gravity.clone()),
                    ],
                };
                let (top, ground_start, ground_velocity) = (problem.rod.top, one.zero(), -speed);
                Ok(Scaled { units: units(velocity), gravity, top, ground_start, ground_velocity, before })
            }
            Start::Profile(profile) => {
                let knots = Knots::of(profile, &given, precision);
                let velocity = if has_gravity { fall } else { knots.greatest_speed(&given.wave_speed) };
                let ground_start = knots.displacement[0].1.clone() / &velocity / &round_trip;
                let ground_velocity = knots.velocity[0].1.clone() / &velocity;
                let units = units(velocity);
                let before = knots.before(&units, &gravity, problem.rod.top);
                Ok(Scaled { units, gravity, top: problem.rod.top, ground_start, ground_velocity, before })
            }
        }
    }
}

impl<S: Scalar> Scaled<S> {
    /// The greatest of the speeds at the start and of 1, in lattice units.
    pub fn greatest_speed(&self) -> f64 {
        self.before.iter().map(|(_, p, _)| p.to_f64().abs()).fold(1.0, f64::max)
    }
}

/// The initial data as lists of `(x, value)`.
struct Knots<S> {
    displacement: Vec<(S, S)>,
    velocity: Vec<(S, S)>,
}

impl<S: Scalar> Knots<S> {
    fn of(profile: &Profile, given: &Parameters<S>, precision: &S::Precision) -> Self {
        let lift = |list: &[(Number, Number)]| -> Vec<(S, S)> {
            if list.is_empty() {
                let zero = given.length.zero();
                return vec![(zero.clone(), zero.clone()), (given.length.clone(), zero)];
            }
            list.iter().map(|(x, y)| (S::from_number(x, precision), S::from_number(y, precision))).collect()
        };
        Knots { displacement: lift(&profile.displacement), velocity: lift(&profile.velocity) }
    }

    /// The segments on which both lists are linear: `(x_a, x_b, v_t(x_a⁺), v_t(x_b⁻), v_x)`.
    fn segments(&self) -> Vec<[S; 5]> {
        let mut out = Vec::new();
        let (mut i, mut j) = (0, 0);
        while i + 1 < self.displacement.len() && j + 1 < self.velocity.len() {
            let [(xa, ya), (xb, yb)] = [&self.displacement[i], &self.displacement[i + 1]];
            let [(sa, va), (sb, vb)] = [&self.velocity[j], &self.velocity[j + 1]];
            let from = if xa > sa { xa } else { sa };
            let to = if xb < sb { xb } else { sb };
            if from < to {
                let strain = (yb.clone() - ya) / (xb.clone() - xa);
                let rate = (vb.clone() - va) / (sb.clone() - sa);
                let at = |x: &S| va.clone() + rate.clone() * (x.clone() - sa);
                out.push([from.clone(), to.clone(), at(from), at(to), strain]);
            }
            // Whichever list's segment ends first is left behind; both where they end together.
            let (leave_i, leave_j) = (xb <= sb, sb <= xb);
            i += usize::from(leave_i);
            j += usize::from(leave_j);
        }
        out
    }

    fn greatest_speed(&self, wave_speed: &S) -> S {
        let mut greatest = wave_speed.zero();
        for [_, _, va, vb, strain] in self.segments() {
            for candidate in [va.magnitude(), vb.magnitude(), (strain * wave_speed).magnitude()] {
                greatest = greatest.larger(candidate);
            }
        }
        if greatest.is_zero() { wave_speed.clone() } else { greatest }
    }

    /// [`Scaled::before`]: `q₀` arrives on the first half of the trip, `p₀` on the second, after the reflection at the top.
    fn before(&self, units: &Units<S>, gravity: &S, top: Top) -> Vec<(S, S, S)> {
        let one = units.length.one();
        let twice = units.length.int(2) * &units.length;
        let segments = self.segments();
        let mut before = Vec::with_capacity(2 * segments.len());
        for [xa, xb, va, vb, strain] in &segments {
            // q₀ at f = x/2L; the fixed top sends −q₀ + g f where the free one sends q₀ + g (1 − f).
            let stretch = strain.clone() * &units.wave_speed;
            let (qa, qb) = ((va.clone() + &stretch) / &units.velocity, (vb.clone() + &stretch) / &units.velocity);
            let (fa, fb) = (xa.clone() / &twice, xb.clone() / &twice);
            let slope = (qb - &qa) / (fb - &fa);
            let (value, slope) = match top {
                Top::Free => (qa + gravity.clone() * (one.clone() - &fa), slope - gravity),
                Top::Fixed => (gravity.clone() * &fa - qa, gravity.clone() - slope),
            };
            before.push((fa, value, slope));
        }
        for [xa, xb, va, vb, strain] in segments.iter().rev() {
            // p₀ + g (1 − f) at f = 1 − x/2L, from the top downwards.
            let stretch = strain.clone() * &units.wave_speed;
            let (pa, pb) = ((va.clone() - &stretch) / &units.velocity, (vb.clone() - &stretch) / &units.velocity);
            let (from, to) = (one.clone() - xb.clone() / &twice, one.clone() - xa.clone() / &twice);
            let slope = (pa - &pb) / (to - &from) - gravity;
            let value = pb + gravity.clone() * (one.clone() - &from);
            before.push((from, value, slope));
        }
        before
    }
}
