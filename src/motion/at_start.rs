//! Initial data at `t = 0`, in the numbers of an engine.

use super::Field;
use crate::number::{Number, Open, Scalar};
use crate::problem::{Parameters, Problem, Profile, Start, Top};

/// The given displacement and velocity: the limit `t → 0⁻` of the motion.
///
/// At a jump of the data inside the rod the value is the limit from above; at the top it is the limit from below. A
/// point within eight roundings of a jump counts as the jump.
#[derive(Clone, Debug)]
pub(crate) struct AtStart<S> {
    pub(crate) displacement: Vec<(S, S)>,
    pub(crate) velocity: Vec<(S, S)>,
    /// Segments in order, from the ground up.
    pub(crate) segments: Vec<Segment<S>>,
    /// Points from which the start sends rays.
    pub(crate) corners: Vec<S>,
    zero: S,
}

/// A segment of the rod on which displacement and velocity are linear.
#[derive(Clone, Debug)]
pub(crate) struct Segment<S> {
    /// `x_a`, `x_b`.
    pub(crate) ends: [S; 2],
    /// `v_t(x_a⁺)`, `v_t(x_b⁻)`.
    pub(crate) velocities: [S; 2],
    /// `v_x`.
    pub(crate) strain: S,
}

/// A number of the initial data other than the impact speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Datum {
    Point,
    /// Displacement, by its index in the list; a single point holds the displacement of the whole rod.
    Displacement(usize),
    Velocity(usize),
}

impl<S: Scalar> AtStart<S> {
    /// Returns the data of `problem` with the parameters `given`.
    pub(crate) fn of(problem: &Problem, given: &Parameters<S>) -> Self {
        let precision = given.length.precision();
        AtStart::with(problem, given, &|_, number| S::from_number(number, &precision))
    }

    /// Returns the data of `problem`, with its numbers converted by `lift`.
    pub(crate) fn with(problem: &Problem, given: &Parameters<S>, lift: &dyn Fn(Datum, &Number) -> S) -> Self {
        let zero = given.length.zero();
        let points = |list: &[(Number, Number)], datum: fn(usize) -> Datum| -> Vec<(S, S)> {
            list.iter().enumerate().map(|(k, (x, value))| (lift(Datum::Point, x), lift(datum(k), value))).collect()
        };
        let (displacement, velocity) = match problem.start() {
            Start::Profile(profile) => {
                (points(&profile.displacement, Datum::Displacement), points(&profile.velocity, Datum::Velocity))
            }
            Start::Uniform(_) | Start::Above { .. } => {
                let gap = problem.gap().map(|gap| (zero.clone(), lift(Datum::Displacement(0), gap)));
                (Vec::from_iter(gap), vec![(zero.clone(), -given.speed.clone())])
            }
        };
        let (mut corners, mut segments) = (Vec::new(), Vec::new());
        if let Start::Profile(profile) = problem.start() {
            segments = self::segments(profile, (problem.length(), &given.length), &displacement, &velocity);
            corners.extend(displacement.iter().chain(&velocity).map(|(x, _)| x.clone()));
            corners.extend([zero.clone(), given.length.clone()]);
        } else {
            let (ends, speed) = ([zero.clone(), given.length.clone()], -given.speed.clone());
            segments.push(Segment { ends, velocities: [speed.clone(), speed], strain: zero.clone() });
        }
        if problem.top() == Top::Fixed {
            corners.push(given.length.clone());
        }
        AtStart { displacement, velocity, segments, corners, zero }
    }

    /// Returns `v`, `v_t`, `v_x` at `t = 0` and the point `x` of the rod.
    pub(crate) fn at(&self, x: &S) -> Result<Field<S>, Open> {
        let (displacement, strain) = self.on_line(&self.displacement, x)?;
        let (velocity, _) = self.on_line(&self.velocity, x)?;
        Ok(Field { displacement, velocity, strain })
    }

    /// Returns value and slope at `x` of the piecewise linear function through `points`, constant for one point.
    fn on_line(&self, points: &[(S, S)], x: &S) -> Result<(S, S), Open> {
        let mut line = points.first().map(|(x, value)| (x, value, self.zero.clone()));
        let roundings = self.zero.double(8.0 * self.zero.log2_roundoff().exp2());
        for ((from, a), (to, b)) in points.iter().zip(points.iter().skip(1)) {
            let reached = from.clone() - from.clone() * &roundings;
            if from.below(to)? && !x.below(&reached)? {
                line = Some((from, a, (b.clone() - a) / (to.clone() - from)));
            }
        }
        Ok(match line {
            Some((from, value, slope)) => (slope.clone() * (x.clone() - from) + value, slope),
            None => (self.zero.clone(), self.zero.clone()),
        })
    }
}

/// Returns the segments on which both lists of `profile`, with the numbers `displacement` and `velocity`, are linear.
fn segments<S: Scalar>(
    profile: &Profile,
    (place, length): (&Number, &S),
    displacement: &[(S, S)],
    velocity: &[(S, S)],
) -> Vec<Segment<S>> {
    let or_rest = |places: &[(Number, Number)], numbers: &[(S, S)]| -> Vec<(Number, S, S)> {
        let zero = length.zero();
        if places.is_empty() {
            return vec![(0.into(), zero.clone(), zero.clone()), (place.clone(), length.clone(), zero)];
        }
        let points = places.iter().zip(numbers);
        points.map(|((place, _), (x, value))| (place.clone(), x.clone(), value.clone())).collect()
    };
    let (displacement, velocity) = (or_rest(&profile.displacement, displacement), or_rest(&profile.velocity, velocity));
    let mut segments = Vec::new();
    let (mut i, mut j) = (0, 0);
    while let (Some([ya, yb]), Some([va, vb])) = (displacement.get(i..i + 2), velocity.get(j..j + 2)) {
        let from = if ya.0.compare(&va.0).is_gt() { ya } else { va };
        let to = if yb.0.compare(&vb.0).is_lt() { yb } else { vb };
        if from.0.compare(&to.0).is_lt() {
            let slope = |a: &(Number, S, S), b: &(Number, S, S)| (b.2.clone() - &a.2) / (b.1.clone() - &a.1);
            let (strain, rate) = (slope(ya, yb), slope(va, vb));
            let velocities = [from, to].map(|(_, x, _)| va.2.clone() + rate.clone() * (x.clone() - &va.1));
            segments.push(Segment { ends: [from.1.clone(), to.1.clone()], velocities, strain });
        }
        // Advance the list whose segment ends first, or both lists if their segments end together.
        let order = yb.0.compare(&vb.0);
        i += usize::from(order.is_le());
        j += usize::from(order.is_ge());
    }
    segments
}
