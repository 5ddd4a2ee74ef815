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
    /// Given in place of the displacement, of a rod that touches the ground.
    strain: Vec<(S, S)>,
    pub(crate) velocity: Vec<(S, S)>,
    /// Segments in order, from the ground up.
    pub(crate) segments: Vec<Segment<S>>,
    /// Points from which the start sends rays.
    pub(crate) corners: Vec<S>,
    zero: S,
}

/// A segment of the rod on which strain and velocity are linear.
#[derive(Clone, Debug)]
pub(crate) struct Segment<S> {
    /// `x_a`, `x_b`.
    pub(crate) ends: [S; 2],
    /// `v_t(x_a⁺)`, `v_t(x_b⁻)`.
    pub(crate) velocities: [S; 2],
    /// `v_x(x_a⁺)`, `v_x(x_b⁻)`.
    pub(crate) strains: [S; 2],
}

/// A number of the initial data other than the impact speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Datum {
    Point,
    /// Displacement, by its index in the list; a single point holds the displacement of the whole rod.
    Displacement(usize),
    Strain(usize),
    Velocity(usize),
}

impl<S: Scalar> AtStart<S> {
    pub(crate) fn of(problem: &Problem, given: &Parameters<S>) -> Self {
        let precision = given.length.precision();
        AtStart::with(problem, given, &|_, number| S::from_number(number, &precision))
    }

    pub(crate) fn with(problem: &Problem, given: &Parameters<S>, lift: &dyn Fn(Datum, &Number) -> S) -> Self {
        let zero = given.length.zero();
        let points = |list: &[(Number, Number)], datum: fn(usize) -> Datum| -> Vec<(S, S)> {
            list.iter().enumerate().map(|(k, (x, value))| (lift(Datum::Point, x), lift(datum(k), value))).collect()
        };
        let (displacement, strain, velocity) = match problem.start() {
            Start::Profile(profile) => (
                points(&profile.displacement, Datum::Displacement),
                points(&profile.strain, Datum::Strain),
                points(&profile.velocity, Datum::Velocity),
            ),
            Start::Uniform(_) | Start::Above { .. } => {
                let gap = problem.gap().map(|gap| (zero.clone(), lift(Datum::Displacement(0), gap)));
                (Vec::from_iter(gap), Vec::new(), vec![(zero.clone(), -given.speed.clone())])
            }
        };
        let (mut corners, mut segments) = (Vec::new(), Vec::new());
        if let Start::Profile(profile) = problem.start() {
            let lists = [&displacement, &strain, &velocity].map(Vec::as_slice);
            segments = self::segments(profile, (problem.length(), &given.length), lists);
            corners.extend(lists.into_iter().flatten().map(|(x, _)| x.clone()));
            corners.extend([zero.clone(), given.length.clone()]);
        } else {
            let (ends, speed) = ([zero.clone(), given.length.clone()], -given.speed.clone());
            segments.push(Segment { ends, velocities: [speed.clone(), speed], strains: [zero.clone(), zero.clone()] });
        }
        if problem.top() == Top::Fixed {
            corners.push(given.length.clone());
        }
        AtStart { displacement, strain, velocity, segments, corners, zero }
    }

    /// Returns `v`, `v_t`, `v_x` at `t = 0` and the point `x` of the rod.
    pub(crate) fn at(&self, x: &S) -> Result<Field<S>, Open> {
        let (velocity, _) = self.on_line(&self.velocity, x)?;
        if self.strain.is_empty() {
            let (displacement, strain) = self.on_line(&self.displacement, x)?;
            return Ok(Field { displacement, velocity, strain });
        }
        let (strain, _) = self.on_line(&self.strain, x)?;
        let (mut displacement, half) = (self.zero.clone(), self.zero.ratio(1, 2));
        for pair in self.strain.windows(2) {
            let [(from, low), (to, high)] = pair else { continue };
            if !x.below(to)? {
                displacement = displacement + (to.clone() - from) * (low.clone() + high) * &half;
            } else if from.below(x)? {
                let way = x.clone() - from;
                let rise = (high.clone() - low) * &way / (to.clone() - from);
                displacement = displacement + way * (low.clone() + rise * &half);
            }
        }
        Ok(Field { displacement, velocity, strain })
    }

    /// Returns whether the strain is given in place of the displacement.
    pub(crate) fn is_strained(&self) -> bool {
        !self.strain.is_empty()
    }

    /// Returns the displacement of the upper end.
    pub(crate) fn top(&self) -> S {
        let twice = |pair: &[(S, S)]| (pair[1].0.clone() - &pair[0].0) * (pair[0].1.clone() + &pair[1].1);
        let half = self.zero.ratio(1, 2);
        let given = self.displacement.last().map_or_else(|| self.zero.clone(), |(_, v)| v.clone());
        self.strain.windows(2).map(twice).fold(given, |sum, part| sum + part * &half)
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

/// Returns the segments on which all lists of `profile`, with the numbers of `lists`, are linear.
fn segments<S: Scalar>(
    profile: &Profile,
    (place, length): (&Number, &S),
    [displacement, strain, velocity]: [&[(S, S)]; 3],
) -> Vec<Segment<S>> {
    let or_rest = |places: &[(Number, Number)], numbers: &[(S, S)]| -> Vec<(Number, S, S)> {
        let zero = length.zero();
        if places.is_empty() {
            return vec![(0.into(), zero.clone(), zero.clone()), (place.clone(), length.clone(), zero)];
        }
        let points = places.iter().zip(numbers);
        points.map(|((place, _), (x, value))| (place.clone(), x.clone(), value.clone())).collect()
    };
    let is_strained = !profile.strain.is_empty();
    let stretched = match is_strained {
        true => or_rest(&profile.strain, strain),
        false => or_rest(&profile.displacement, displacement),
    };
    let velocity = or_rest(&profile.velocity, velocity);
    let mut segments = Vec::new();
    let (mut i, mut j) = (0, 0);
    while let (Some([ya, yb]), Some([va, vb])) = (stretched.get(i..i + 2), velocity.get(j..j + 2)) {
        let from = if ya.0.compare(&va.0).is_gt() { ya } else { va };
        let to = if yb.0.compare(&vb.0).is_lt() { yb } else { vb };
        if from.0.compare(&to.0).is_lt() {
            let slope = |a: &(Number, S, S), b: &(Number, S, S)| (b.2.clone() - &a.2) / (b.1.clone() - &a.1);
            let (bend, rate) = (slope(ya, yb), slope(va, vb));
            let at_ends = |a: &(Number, S, S), slope: &S| {
                [from, to].map(|(_, x, _)| a.2.clone() + slope.clone() * (x.clone() - &a.1))
            };
            let strains = if is_strained { at_ends(ya, &bend) } else { [bend.clone(), bend] };
            let ends = [from.1.clone(), to.1.clone()];
            segments.push(Segment { ends, velocities: at_ends(va, &rate), strains });
        }
        // Advance the list whose segment ends first, or both lists if their segments end together.
        let order = yb.0.compare(&vb.0);
        i += usize::from(order.is_le());
        j += usize::from(order.is_ge());
    }
    segments
}
