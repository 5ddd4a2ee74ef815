//! The problem in lattice units: the round trip, and the speed that gravity produces in it.

use crate::error::Error;
use crate::motion::{AtStart, Segment};
use crate::number::{Bounded, Open};
use crate::problem::{Parameters, Problem, Start, Top};

/// The units of the lattice. In these units a break returns after exactly 1, and gravity is 1 or 0.
#[derive(Clone, Debug)]
pub struct Units<N> {
    /// The unit of time, `t₁ = 2L/c`.
    pub round_trip: N,
    /// The unit of velocity: `μ₀ = g t₁` with gravity, `μ` (or the greatest initial speed) without.
    pub velocity: N,
    /// `L`, the length of the rod.
    pub length: N,
    /// `c`.
    pub wave_speed: N,
}

/// The undamped problem in [`Units`].
#[derive(Clone, Debug)]
pub struct Scaled<N> {
    /// The units, in the numbers of the scene.
    pub units: Units<N>,
    /// Gravity: 1 or 0.
    pub gravity: N,
    /// The end `x = L`.
    pub top: Top,
    /// The initial data, in the units of the scene.
    pub(crate) data: AtStart<N>,
    /// `v(0,0)`.
    pub ground_start: N,
    /// `v_t(0,0)`.
    pub ground_velocity: N,
    /// The trace of `p` at the ground during the round trip before the start that would produce the state of the rod at
    /// `t = 0`: `(age, value, slope)` in order of the age, the first at 0.
    pub before: Vec<(N, N, N)>,
}

impl<N: Bounded> Scaled<N> {
    /// Converts `problem` to lattice units.
    ///
    /// **Source**: `q(0,t) = q₀(ct) − g t` until `L/c` and, reflected at the top, `p₀(2L − ct)` after it.
    ///
    /// **Accuracy**: *exact* in fractions, a few roundings otherwise.
    ///
    /// **Errors**: [`Error::Irrational`] where a fraction cannot hold a parameter.
    pub fn of(problem: &Problem, precision: &N::Precision) -> Result<Self, Error> {
        let given = Parameters::of(problem, precision)?;
        Self::with(problem, &given, AtStart::of(problem, &given))
    }

    /// Converts `problem` with `given` and `data` in place of its own numbers.
    pub(crate) fn with(problem: &Problem, given: &Parameters<N>, data: AtStart<N>) -> Result<Self, Error> {
        let round_trip = given.round_trip();
        let has_gravity = problem.gravity().is_some_and(|gravity| !gravity.is_zero());
        let one = given.length.one();
        let gravity = if has_gravity { one.clone() } else { one.zero() };
        let first = |list: &[(N, N)]| list.first().map_or_else(|| one.zero(), |(_, value)| value.clone());
        let profile = matches!(problem.start(), Start::Profile(_));
        let velocity = match profile {
            _ if has_gravity => given.critical_speed(),
            false => given.speed.clone(),
            true => greatest_speed(&data.segments, &given.wave_speed)?,
        };
        let (length, wave_speed, top) = (given.length.clone(), given.wave_speed.clone(), problem.top());
        let ground_start = first(&data.displacement) / &velocity / &round_trip;
        let ground_velocity = first(&data.velocity) / &velocity;
        let units = Units { round_trip, velocity, length, wave_speed };
        let before = match (profile, top) {
            (true, _) => before(&data.segments, &units, &gravity, top),
            (false, Top::Free) => vec![(one.zero(), gravity.clone() + &ground_velocity, -gravity.clone())],
            (false, Top::Fixed) => vec![
                (one.zero(), -ground_velocity.clone(), gravity.clone()),
                (one.clone().halved(), gravity.clone().halved() + &ground_velocity, -gravity.clone()),
            ],
        };
        Ok(Scaled { units, gravity, top, data, ground_start, ground_velocity, before })
    }

    /// Returns the greatest of 1 and the magnitudes of [`Scaled::before`] at its breaks, in lattice units.
    pub fn greatest_speed(&self) -> f64 {
        self.before.iter().map(|(_, p, _)| p.to_f64().abs()).fold(1.0, f64::max)
    }
}

/// Returns the greatest of `|v_t|` and `c |v_x|`, or `c` if all are zero.
fn greatest_speed<N: Bounded>(segments: &[Segment<N>], wave_speed: &N) -> Result<N, Open> {
    let mut greatest = wave_speed.zero();
    for Segment { velocities, strains, .. } in segments {
        let stretches = strains.iter().map(|strain| strain.clone() * wave_speed);
        for candidate in velocities.iter().cloned().chain(stretches) {
            greatest = greatest.larger(candidate.magnitude());
        }
    }
    Ok(if greatest.vanishes()? { wave_speed.clone() } else { greatest })
}

/// Builds [`Scaled::before`]: `q₀` arrives in the first half of the trip, `p₀`, reflected at the top, in the second.
fn before<N: Bounded>(segments: &[Segment<N>], units: &Units<N>, gravity: &N, top: Top) -> Vec<(N, N, N)> {
    let one = units.length.one();
    let twice = units.length.clone().doubled();
    let piece = |(up, Segment { ends: [a, b], velocities: [va, vb], strains: [ea, eb] }): (bool, &Segment<N>)| {
        // q₀ arrives at f = x/2L; p₀ arrives at f = 1 − x/2L, from the top downwards.
        let place = |x: &N| if up { one.clone() - x.clone() / &twice } else { x.clone() / &twice };
        let wave = |v: &N, strain: &N| {
            let stretch = strain.clone() * &units.wave_speed;
            let wave = if up { v.clone() - stretch } else { v.clone() + stretch };
            wave / &units.velocity
        };
        let ends = [(place(a), wave(va, ea)), (place(b), wave(vb, eb))];
        let [first, second] = ends;
        let ((from, value), (to, last)) = if up { (second, first) } else { (first, second) };
        let slope = (last - &value) / (to - &from);
        // The fixed top requires −q₀ + g f, the free top q₀ + g (1 − f); p₀ requires g (1 − f) in both cases.
        let (value, slope) = match top {
            Top::Fixed if !up => (gravity.clone() * &from - value, gravity.clone() - slope),
            _ => (value + gravity.clone() * (one.clone() - &from), slope - gravity),
        };
        (from, value, slope)
    };
    let down = segments.iter().map(|segment| (false, segment));
    down.chain(segments.iter().rev().map(|segment| (true, segment))).map(piece).collect()
}
