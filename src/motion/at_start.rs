//! The data at `t = 0`, in the numbers of an engine.

use super::Field;
use crate::mapped::mapped;
use crate::number::{Number, Open, Scalar};
use crate::problem::{Parameters, Problem, Start, Top};

/// The given displacement and velocity: the limit `t → 0⁻` of the motion.
///
/// Where the data jump at a point of the rod, the value is that from above; at the top that from below. A point within
/// eight roundings of a jump is on it.
#[derive(Clone, Debug)]
pub(crate) struct AtStart<S> {
    pub(crate) displacement: Vec<(S, S)>,
    pub(crate) velocity: Vec<(S, S)>,
    /// The points from which it sends rays.
    pub(crate) corners: Vec<S>,
    zero: S,
}

/// Which number of a start that is no speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Datum {
    /// A place along the rod.
    Point,
    /// The displacement there, by the place in its list; that of all points where there is one only.
    Displacement(usize),
    /// The velocity there.
    Velocity(usize),
}

impl<S: Scalar> AtStart<S> {
    /// The data of `problem`, whose numbers are `given`.
    pub(crate) fn of(problem: &Problem, given: &Parameters<S>) -> Self {
        let precision = given.length.precision();
        AtStart::with(problem, given, &|_, number| S::from_number(number, &precision))
    }

    /// The same, with those numbers that `lift` makes of them.
    pub(crate) fn with(problem: &Problem, given: &Parameters<S>, lift: &dyn Fn(Datum, &Number) -> S) -> Self {
        let zero = given.length.zero();
        let points = |list: &[(Number, Number)], datum: fn(usize) -> Datum| -> Vec<(S, S)> {
            mapped(list.iter().enumerate(), |(k, (x, value))| (lift(Datum::Point, x), lift(datum(k), value)))
        };
        let (displacement, velocity) = match &problem.start {
            Start::Profile(profile) => {
                (points(&profile.displacement, Datum::Displacement), points(&profile.velocity, Datum::Velocity))
            }
            Start::Uniform(_) | Start::Above { .. } => {
                let gap = problem.gap().map(|gap| (zero.clone(), lift(Datum::Displacement(0), gap)));
                (Vec::from_iter(gap), vec![(zero.clone(), -given.speed.clone())])
            }
        };
        let mut corners: Vec<S> = Vec::new();
        if let Start::Profile(_) = &problem.start {
            corners.extend(displacement.iter().chain(&velocity).map(|(x, _)| x.clone()));
            corners.extend([zero.clone(), given.length.clone()]);
        }
        if problem.rod.top == Top::Fixed {
            corners.push(given.length.clone());
        }
        AtStart { displacement, velocity, corners, zero }
    }

    /// `v`, `v_t`, `v_x` at `t = 0` and the point `x` of the rod.
    pub(crate) fn at(&self, x: &S) -> Result<Field<S>, Open> {
        let (displacement, strain) = self.on_line(&self.displacement, x)?;
        let (velocity, _) = self.on_line(&self.velocity, x)?;
        Ok(Field { displacement, velocity, strain })
    }

    /// The value at `x`, and the slope, of the lines between `points`; constant where there is one point only.
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
