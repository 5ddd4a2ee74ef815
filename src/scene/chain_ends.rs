//! The ends of a chain in a scene, and springs at ends and joints.

use super::error::SceneError;
use super::reader::Reader;
use crate::chain::{Body, End, Spring};
use crate::error::ProblemErrorKind as Kind;
use crate::number::Number;

pub(super) const SPRING_KEYS: [&str; 3] = ["stiffness", "damping", "penalty"];
const END_KEYS: &[&str] = &["force", "velocity", "infinite", "gap", "stiffness", "damping", "penalty"];
const END_WORDS: [&str; 4] = ["free", "fixed", "ground", "absorbing"];

impl Reader<'_> {
    /// Reads the spring of this table, for a joint or an end of `body`; `None` if there is none.
    pub(super) fn spring(&self, body: &Body) -> Result<Option<Spring>, SceneError> {
        let [stiffness, damping, penalty] = SPRING_KEYS.map(|key| self.plain_number(key));
        let (stiffness, damping, penalty) = (stiffness?, damping?, penalty?);
        let zero = || Number::from(0);
        let stiffness = match (stiffness, penalty) {
            (Some(_), Some(_)) => {
                let span = self.get("penalty").map_or(0..0, |(key, _)| key.span());
                let expected = "one of them: a penalty is a stiffness in multiples of EA/L";
                return Err(self.error(span, Kind::Contradiction, "penalty beside stiffness", expected));
            }
            (None, Some(penalty)) => {
                let (key, value) = self.get("penalty").map_or((0..0, 0..0), |(key, v)| (key.span(), v.span()));
                let Some(own) = body.stiffness() else {
                    let expected = "a stiffness: a rigid mass has no EA/L";
                    return Err(self.error(key, Kind::Contradiction, "penalty of a rigid mass", expected));
                };
                if penalty.to_f64() < 0.0 {
                    return Err(self.error(value, Kind::OutOfRange, format!("penalty = {penalty}"), "zero or more"));
                }
                let found = || format!("penalty = {penalty}, whose product with EA/L has too many digits");
                let product = Number::of_rational(&(own * penalty.to_rational()));
                product.ok_or_else(|| self.error(value, Kind::OutOfRange, found(), "a stiffness"))?
            }
            (stiffness, None) => match (stiffness, &damping) {
                (None, None) => return Ok(None),
                (stiffness, _) => stiffness.unwrap_or_else(zero),
            },
        };
        Ok(Some(Spring { stiffness, damping: damping.unwrap_or_else(zero) }))
    }

    /// Reads `true` or `false`; `false` if the key is absent.
    pub(super) fn flag(&self, key: &str) -> Result<bool, SceneError> {
        let Some((_, value)) = self.get(key) else { return Ok(false) };
        value.get_ref().as_bool().ok_or_else(|| self.wrong_type(value, key, "true or false"))
    }

    /// Reads the ends, in `[ends]` or in `[rod]`, and `[ground]`, with the springs there. A `[rod]` without a bottom is
    /// above the ground, by the gap of `[impact]`.
    pub(super) fn ends(&self, is_rod: bool, bodies: [&Body; 2]) -> Result<([End; 2], [Option<Spring>; 2]), SceneError> {
        let place = if is_rod { "rod" } else { "ends" };
        let table = self.table(place);
        let ground = self.table("ground").list("velocity")?;
        let [bottom, top] =
            [("bottom", bodies[0]), ("top", bodies[1])].map(|(name, body)| table.end(name, place, body));
        let ((mut bottom, below), (top, above)) = (bottom?, top?);
        let gap = self.table("impact").plain_number("gap")?;
        match &mut bottom {
            None if is_rod => bottom = Some(End::Ground { gap: gap.unwrap_or_else(|| 0.into()), velocity: Vec::new() }),
            Some(End::Ground { gap: own, .. }) if own.to_f64() == 0.0 => *own = gap.unwrap_or_else(|| own.clone()),
            _ if gap.is_some() => {
                let span = self.get("impact.gap").map_or(0..0, |(key, _)| key.span());
                let expected = "bottom = \"ground\", or no bottom: other ends have no gap above the ground";
                return Err(self.error(span, Kind::Contradiction, "gap of [impact] above another bottom", expected));
            }
            _ => {}
        }
        let Some((key, _)) = self.get("ground") else {
            return Ok(([bottom.unwrap_or(End::Free), top.unwrap_or(End::Free)], [below, above]));
        };
        let yielding = self.table("ground").spring(bodies[0])?;
        if below.is_some() && yielding.is_some() {
            let found = "[ground] with a spring beside that of the bottom";
            return Err(self.error(key.span(), Kind::Contradiction, found, "a spring in one of both"));
        }
        let bottom = match bottom {
            None => End::Ground { gap: 0.into(), velocity: ground },
            Some(End::Ground { gap, velocity }) if velocity.is_empty() => End::Ground { gap, velocity: ground },
            Some(end @ End::Ground { .. }) if ground.is_empty() => end,
            Some(_) => {
                let expected = "bottom = \"ground\" or { gap = … }: a body that is fixed or free there meets no ground";
                return Err(self.error(key.span(), Kind::Contradiction, "[ground] under another bottom", expected));
            }
        };
        Ok(([bottom, top.unwrap_or(End::Free)], [below.or(yielding), above]))
    }

    /// Returns the body of a `[rod]` with its displacement counted from the ground, as that of a rod on rigid ground:
    /// the displacement of its lower end at the start is its gap, and a gap displaces the whole body.
    pub(super) fn above_ground(&self, body: Body, bottom: &mut End) -> Result<Body, SceneError> {
        let End::Ground { gap, .. } = bottom else { return Ok(body) };
        let has_own = self.get("rod.bottom").is_some_and(|(_, value)| value.get_ref().as_table().is_some());
        let height = body.displacement().first().map(|(_, height)| height.clone());
        match height {
            Some(height) if !has_own && self.get("impact.gap").is_none() => {
                if height.to_f64() < 0.0 {
                    let span = self.get("start.displacement").map_or(0..0, |(_, value)| value.span());
                    let found = format!("the displacement {height} at x = 0");
                    return Err(self.error(span, Kind::OutOfRange, found, "zero or more: the ground is at zero"));
                }
                *gap = height;
                Ok(body)
            }
            None if !gap.is_zero() && self.get("impact.gap").is_some() => {
                let points = [0.into(), body.length().clone()].map(|x| (x, gap.clone()));
                Ok(body.with_displacement(points.into()))
            }
            _ => Ok(body),
        }
    }

    /// Reads the end at `name` of the table called `place`, at an end of `body`, and its spring.
    fn end(&self, name: &str, place: &str, body: &Body) -> Result<(Option<End>, Option<Spring>), SceneError> {
        let Some((key, value)) = self.get(name) else { return Ok((None, None)) };
        let Some(table) = value.get_ref().as_table() else {
            let end = self.choice(name, &END_WORDS)?.map(|word| match END_WORDS[word] {
                "fixed" => End::Velocity(Vec::new()),
                "ground" => End::Ground { gap: 0.into(), velocity: Vec::new() },
                "absorbing" => End::Infinite { impedance: None, gap: None },
                _ => End::Free,
            });
            return Ok((end, None));
        };
        let reader = Reader { document: table, ..*self };
        self.check_near((table, &format!("{name} of [{place}]")), END_KEYS)?;
        let gap = reader.plain_number("gap")?;
        let spring = reader.spring(body)?;
        let has = |key: &str| table.contains_key(key);
        let end = match [has("force"), has("velocity"), has("infinite"), has("gap")] {
            [false, false, false, false] if spring.is_some() => End::Velocity(Vec::new()),
            [true, false, false, false] => End::Force(reader.list("force")?),
            [false, true, false, false] => End::Velocity(reader.list("velocity")?),
            [false, velocity, false, true] => {
                let velocity = if velocity { reader.list("velocity")? } else { Vec::new() };
                End::Ground { gap: gap.unwrap_or_else(|| 0.into()), velocity }
            }
            [false, false, true, _] => End::Infinite { impedance: reader.plain_number("infinite")?, gap },
            _ => {
                let expected = "one of a force, a velocity, a gap of a stop (which may have a velocity and a stiffness), a \
                     stiffness, or infinite = Z with a gap or without";
                let keys: Vec<&str> = table.keys().map(|key| key.get_ref().as_ref()).collect();
                let keys = if keys.is_empty() { "no key".into() } else { keys.join(" and ") };
                let found = format!("{name} of [{place}] with {keys}");
                return Err(self.error(key.span(), Kind::Contradiction, found, expected));
            }
        };
        Ok((Some(end), spring))
    }
}
