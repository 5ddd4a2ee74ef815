//! The start of a scene: an impact with one speed, or a profile along the rod.

use std::cmp::Ordering;

use toml::de::DeValue;

use super::error::{SceneError, SceneErrorKind as Kind, short};
use super::read::{Reader, Scales, UNITS, out_of_range, positive, range, within};
use super::table::{Quantity, Table, Value};
use crate::rod::{Profile, Speed, Start};

const SPEED_RATIO: (f64, f64) = (1e-12, 1e12);
const MAX_POINTS: usize = 100_000;
/// Least distance of two points of a profile, in lengths of the rod.
const MIN_SPACING: f64 = 1e-12;

impl Reader<'_> {
    /// The motion at `t = 0`.
    pub(super) fn start(&self, scales: &Scales) -> Result<Start, SceneError> {
        match (&self.impact, &self.start) {
            (Some(impact), None) => self.impact(impact, scales).map(Start::Uniform),
            (None, Some(start)) => self.profile(start, scales).map(Start::Profile),
            (Some(_), Some(_)) => {
                let expected = "either [impact], for a uniform start, or [start]";
                self.root.refuse("start", "[impact]", expected)?;
                Err(self.root.missing("[impact] and [start]", expected))
            }
            (None, None) => {
                let (found, expected) =
                    ("neither [impact] nor [start]", "[impact] with speed or drop_height, or [start]");
                Err(self.root.error(0..0, Kind::MissingKey, found, expected))
            }
        }
    }

    fn impact(&self, impact: &Table<'_>, scales: &Scales) -> Result<Speed, SceneError> {
        let given = positive(impact, "speed", "an impact speed")?;
        let height = positive(impact, "drop_height", "a drop height")?;
        let (quantity, speed) = match (given, height) {
            (Some(_), Some(_)) => {
                impact.refuse("drop_height", "speed", "either speed or drop_height")?;
                return Err(impact.missing("speed and drop_height", "either speed or drop_height"));
            }
            (Some(speed), None) => {
                let value = speed.number.to_f64();
                (speed, value)
            }
            (None, Some(height)) => {
                let Some(g) = &scales.gravity else {
                    let expected = "[gravity] with an acceleration above zero, or speed in place of drop_height";
                    let span = impact.get("drop_height").map_or(0..0, |entry| entry.key_span.clone());
                    return Err(impact.error(span, Kind::MissingKey, "drop_height without gravity", expected));
                };
                let value = (2.0 * g.number.to_f64() * height.number.to_f64()).sqrt();
                (height, value)
            }
            (None, None) => return Err(impact.missing("no speed", "speed or drop_height")),
        };
        let refuse = |what: String, expected: String| {
            let found = format!("{} = {}, which makes {what}", quantity.key, self.shown(&quantity));
            Err(impact.error(quantity.span.clone(), Kind::Combination, found, expected))
        };
        if !within(speed, UNITS) {
            return refuse(format!("the impact speed {speed:e}"), format!("one {}", range(UNITS)));
        }
        if let Some(critical) = scales.critical_speed() {
            let ratio = speed / critical;
            if !within(ratio, SPEED_RATIO) {
                return refuse(format!("μ/(g t₁) = {ratio:e}"), format!("a value {}", range(SPEED_RATIO)));
            }
        }
        Ok(if quantity.key == "speed" { Speed::Given(quantity.number) } else { Speed::DropHeight(quantity.number) })
    }

    fn profile(&self, start: &Table<'_>, scales: &Scales) -> Result<Profile, SceneError> {
        if start.entries().is_empty() {
            return Err(start.missing("no points", "displacement, velocity or both"));
        }
        let displacement = self.points(start, "displacement", scales)?;
        let velocity = self.points(start, "velocity", scales)?;
        let values =
            |points: Vec<(Quantity, Quantity)>| points.into_iter().map(|(x, v)| (x.number, v.number)).collect();
        if let Some((_, ground)) = displacement.first()
            && ground.number.to_f64() < 0.0
        {
            let found = format!("the displacement {} at x = 0", self.shown(ground));
            let expected = "zero or more: the ground is at zero";
            return Err(start.error(ground.span.clone(), Kind::OutOfRange, found, expected));
        }
        Ok(Profile { displacement: values(displacement), velocity: values(velocity) })
    }

    /// The points of a piecewise-linear function on the whole rod.
    fn points(
        &self,
        start: &Table<'_>,
        key: &'static str,
        scales: &Scales,
    ) -> Result<Vec<(Quantity, Quantity)>, SceneError> {
        const SHAPE: &str = "points [x, value] from x = 0 to x = length, such as [[0, 0], [1, -1]]";
        let Some(entry) = start.get(key) else { return Ok(Vec::new()) };
        let DeValue::Array(array) = entry.value.get_ref() else {
            return Err(start.wrong_type(entry.value, key, SHAPE));
        };
        if !(2..=MAX_POINTS).contains(&array.len()) {
            let found = format!("{} points of the {key}", array.len());
            let expected = format!("2 to {MAX_POINTS} {SHAPE}");
            return Err(start.error(entry.value.span(), Kind::Profile, found, expected));
        }
        let length = &scales.length.number;
        let refuse = |x: &Quantity, expected: String| {
            let found = format!("the point x = {} of the {key}", self.shown(x));
            Err(start.error(x.span.clone(), Kind::Profile, found, expected))
        };
        let mut points: Vec<(Quantity, Quantity)> = Vec::with_capacity(array.len());
        for value in array.iter() {
            let (mut x, v) = point(start, value, key)?;
            let Some((last, _)) = points.last() else {
                if !x.number.is_zero() {
                    return refuse(&x, "the first point at x = 0".into());
                }
                points.push((x, v));
                continue;
            };
            // Points of equal value take the same text, so that they are equal in every number system.
            match x.number.compare(length) {
                Ordering::Greater => {
                    return refuse(&x, format!("a point within the length {}", short(&length.to_string())));
                }
                Ordering::Equal => x.number = length.clone(),
                Ordering::Less => {}
            }
            match x.number.compare(&last.number) {
                Ordering::Less => {
                    return refuse(&x, format!("one beyond x = {}, the point before it", self.shown(last)));
                }
                Ordering::Equal if key == "displacement" => {
                    return refuse(&x, "each x once: a displacement has no jump".into());
                }
                Ordering::Equal if x.number.is_zero() || x.number.compare(length).is_eq() => {
                    return refuse(&x, "a jump inside the rod, not at its end".into());
                }
                Ordering::Equal => {
                    let before = points.len().checked_sub(2).and_then(|i| points.get(i));
                    if before.is_some_and(|(b, _)| b.number.compare(&x.number).is_eq()) {
                        return refuse(&x, "each x at most twice".into());
                    }
                    x.number = last.number.clone();
                }
                Ordering::Greater => {
                    if x.number.to_f64() - last.number.to_f64() < MIN_SPACING * length.to_f64() {
                        return refuse(&x, format!("points at least {MIN_SPACING:e} of the length apart"));
                    }
                }
            }
            points.push((x, v));
        }
        match points.last() {
            Some((x, _)) if x.number.compare(length).is_ne() => {
                refuse(x, format!("the last point at the length {}", short(&length.to_string())))
            }
            _ => Ok(points),
        }
    }
}

/// One point `[x, value]`.
fn point(start: &Table<'_>, value: &Value<'_>, key: &'static str) -> Result<(Quantity, Quantity), SceneError> {
    let pair = value.get_ref().as_array().filter(|array| array.len() == 2);
    let mut numbers = pair.into_iter().flat_map(|array| array.iter());
    let (Some(x), Some(v)) = (numbers.next(), numbers.next()) else {
        let found = format!("{} among the points of the {key}", short(start.slice(&value.span())));
        return Err(start.error(value.span(), Kind::WrongType, found, "a point [x, value]"));
    };
    let (x, v) = (start.number_of(x, "x")?, start.number_of(v, key)?);
    let sized = |quantity: &Quantity| quantity.number.is_zero() || within(quantity.number.to_f64().abs(), UNITS);
    if !sized(&v) {
        return Err(out_of_range(start, &v, &format!("zero or a magnitude {}", range(UNITS))));
    }
    if x.number.to_f64() < 0.0 {
        return Err(out_of_range(start, &x, "a point of the rod, from x = 0 to x = length"));
    }
    Ok((x, v))
}
