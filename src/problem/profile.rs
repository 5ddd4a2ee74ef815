//! The checks of a start that is linear between points.

use std::borrow::Cow;
use std::cmp::Ordering;

use super::given::{ByParameter, Given, UNITS, range, within};
use super::written::short;
use super::{Parameter, ProblemError, ProblemErrorKind as Kind, Profile, Written};
use crate::number::Number;

const MAX_POINTS: usize = 100_000;
/// Least distance of two points of a profile, in lengths of the rod.
const MIN_SPACING: f64 = 1e-12;

/// The form of a list of points, in words.
pub(crate) const SHAPE: &str = "points [x, value] from x = 0 to x = length, such as [[0, 0], [1, -1]]";

/// A list of points `(x, value)` that is not checked.
pub(crate) type Points = Vec<(Written, Written)>;

/// The profile of a rod of this length, from the points of the lists of the start; what is not given is zero.
/// `over_ground` states whether the ground at zero limits the displacement.
pub(super) fn check(given: &ByParameter<Points>, length: &Number, over_ground: bool) -> Result<Profile, ProblemError> {
    let read = |parameter: Parameter| {
        given.get(&parameter).map_or(Ok(Vec::new()), |points| read(parameter.name(), points, length, over_ground))
    };
    let [displacement, strain, velocity] = Parameter::LISTS;
    if given.contains_key(&displacement) && given.contains_key(&strain) {
        return Err(ProblemError::strain_and_displacement(strain.path()));
    }
    Ok(Profile { displacement: read(displacement)?, strain: read(strain)?, velocity: read(velocity)? })
}

/// The points of one function on the whole rod.
fn read(key: &str, points: &Points, length: &Number, over_ground: bool) -> Result<Vec<(Number, Number)>, ProblemError> {
    if !(2..=MAX_POINTS).contains(&points.len()) {
        let (path, found) = (format!("start.{key}"), format!("{} points of the {key}", points.len()));
        return Err(ProblemError::new(Kind::Profile, &path, found, format!("2 to {MAX_POINTS} {SHAPE}")));
    }
    let mut kept: Vec<(Number, Number)> = Vec::with_capacity(points.len());
    for (i, (x, v)) in points.iter().enumerate() {
        let before = i.checked_sub(1).map_or("", |before| &points[before].0.shown);
        let checked = point(key, x, v).and_then(|(number, value)| {
            if over_ground && i == 0 && key == "displacement" && value.to_f64() < 0.0 {
                let found = format!("the displacement {} at x = 0", v.shown);
                return Err(ProblemError::new(Kind::OutOfRange, "v", found, "zero or more: the ground is at zero"));
            }
            let misplaced = |expected: Cow<'static, str>| {
                ProblemError::new(Kind::Profile, "x", format!("the point x = {} of the {key}", x.shown), expected)
            };
            let place = place(&kept, number, before, key != "displacement", length).map_err(misplaced)?;
            if i + 1 == points.len() && place.compare(length).is_ne() {
                return Err(misplaced(format!("the last point at the length {}", short(&length.to_string())).into()));
            }
            Ok((place, value.clone()))
        });
        kept.push(checked.map_err(|error| ProblemError { path: format!("start.{key}[{i}].{}", error.path), ..error })?);
    }
    Ok(kept)
}

/// The two numbers of a point, each of a possible size.
fn point<'a>(key: &'a str, x: &'a Written, v: &'a Written) -> Result<(&'a Number, &'a Number), ProblemError> {
    let (x, v) = (Given::new("x", "x", x)?, Given::new("v", key, v)?);
    if !v.number.is_zero() && !within(v.number.to_f64().abs(), UNITS) {
        return Err(v.error(Kind::OutOfRange, "", format!("zero or a magnitude {}", range(UNITS))));
    }
    if x.number.to_f64() < 0.0 {
        return Err(x.error(Kind::OutOfRange, "", "a point of the rod, from x = 0 to x = length"));
    }
    Ok((x.number, v.number))
}

/// The place `x` of the point after `kept`, or what is expected of it; `before` shows the place of the point before it.
/// Places of equal value take the same text, so that they are equal in every number system.
fn place(
    kept: &[(Number, Number)],
    x: &Number,
    before: &str,
    may_jump: bool,
    length: &Number,
) -> Result<Number, Cow<'static, str>> {
    let Some((last, _)) = kept.last() else {
        return if x.is_zero() { Ok(x.clone()) } else { Err("the first point at x = 0".into()) };
    };
    let against_length = x.compare(length);
    if against_length.is_gt() {
        return Err(format!("a point within the length {}", short(&length.to_string())).into());
    }
    match x.compare(last) {
        Ordering::Less => Err(format!("one beyond x = {before}, the point before it").into()),
        Ordering::Equal if !may_jump => Err("each x once: a displacement has no jump".into()),
        Ordering::Equal if x.is_zero() || against_length.is_eq() => Err("a jump inside the rod, not at its end".into()),
        Ordering::Equal if kept.iter().rev().nth(1).is_some_and(|(b, _)| b.compare(x).is_eq()) => {
            Err("each x at most twice".into())
        }
        Ordering::Equal => Ok(last.clone()),
        Ordering::Greater if x.to_f64() - last.to_f64() < MIN_SPACING * length.to_f64() => {
            Err(format!("points at least {MIN_SPACING:e} of the length apart").into())
        }
        Ordering::Greater => Ok(if against_length.is_eq() { length.clone() } else { x.clone() }),
    }
}
