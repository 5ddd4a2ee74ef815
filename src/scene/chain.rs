//! The reader of scenes with several bodies, `[[body]]` and `[ends]`, and of a `[rod]` with other ends than a rod on
//! rigid ground has.

use std::ops::Range;

use toml::de::DeTable;

use super::error::{SceneError, position};
use super::publication::Publication;
use super::read::{Scene, document};
use super::reader::{Reader, Value};
use super::target::{ChainTarget, Target};
use crate::chain::{Body, BodyMaterial, Chain, Joint, MAX_PIECES, Points, Spring};
use crate::error::{ProblemError, ProblemErrorKind as Kind};
use crate::number::{Number, Rational};
use crate::problem::Problem;
use crate::problem::written::short;
use crate::quantity::{Measure, UnitSystem};

const TOP_KEYS: &[&str] = &["title", "units", "body", "ends", "ground", "gravity", "run", "publication", "target"];
const ROD_TOP_KEYS: &[&str] =
    &["title", "units", "rod", "impact", "start", "ground", "gravity", "run", "publication", "target"];
const BODY_KEYS: &[&str] = &[
    "name",
    "length",
    "wave_speed",
    "impedance",
    "modulus",
    "density",
    "area",
    "poisson",
    "state",
    "velocity",
    "displacement",
    "strain",
    "mass",
    "joint",
    "gap",
];
const RIGID_KEYS: &[&str] = &["name", "mass", "velocity", "joint", "gap"];
const JOINT_KEYS: &[&str] = &["stiffness", "damping", "penalty", "bonded"];
const ROD_KEYS: &[&str] =
    &["length", "wave_speed", "impedance", "modulus", "density", "area", "poisson", "state", "bottom", "top"];
const TABLES: [(&str, &[&str]); 6] = [
    ("ends", &["bottom", "top"]),
    ("impact", &["speed", "gap"]),
    ("start", &["displacement", "strain", "velocity"]),
    ("ground", &["velocity", "stiffness", "damping", "penalty"]),
    ("gravity", &["acceleration"]),
    ("run", &["time", "accuracy", "pieces"]),
];
/// Keys of a single rod on rigid ground, and what a chain has in their place.
const INSTEAD: [(&str, &str); 2] = [
    ("impact.drop_height", "gap, beside speed = 0: the body falls from there, and times count from the start"),
    ("run.impacts", "time: a chain runs up to a time"),
];

/// A scene file with several bodies, checked: a chain in exact numbers, and the line that each value stands on.
///
/// ```toml
/// title = "A moving bar hits another"
/// [[body]]                 # from the bottom up
/// length = 10
/// modulus = 100            # with density and area; or wave_speed and impedance
/// density = 0.01
/// [[body]]
/// mass = 6                 # without a length: rigid
/// velocity = -0.1          # upward
/// gap = 0.01               # above the body below
/// [run]
/// time = 1
/// ```
///
/// `docs/scenes.md` has every key: ends, joints with springs and dashpots, a single body in `[rod]`, and `[[target]]`.
///
/// ```
/// use dalembert::{ChainScene, Numbers};
/// let scene = ChainScene::parse(
///     "[[body]]\nlength = 1\nwave_speed = 1\nimpedance = 1\n\
///      [[body]]\nlength = 1\nwave_speed = 1\nimpedance = 1\nvelocity = -1\ngap = 1\n[run]\ntime = 4\n",
/// )?;
/// let listing = scene.chain.solve(Numbers::Exact)?.listing()?;
/// assert_eq!(listing.contacts[0].impulse.to_string(), "1");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ChainScene {
    /// `title`.
    pub title: Option<String>,
    /// `units`: the units of the numbers; SI if absent.
    pub units: UnitSystem,
    /// The chain to solve.
    pub chain: Chain,
    /// `run.accuracy`: the requested relative accuracy.
    pub accuracy: Option<f64>,
    /// `[publication]`: where the scene comes from.
    pub publication: Option<Publication>,
    /// `[[target]]`: published values of bodies, each with its body, from 0.
    pub targets: Vec<(usize, Target)>,
    /// `[[target]]`: published values of the whole chain.
    pub chain_targets: Vec<ChainTarget>,
    source: String,
    lines: Vec<(String, usize)>,
}

impl ChainScene {
    /// Returns whether `source` is a scene of this kind: a TOML document with `[[body]]`, or with a `[rod]` that has a
    /// `bottom`, a `[ground]`, or a `top` that is neither free nor fixed.
    pub fn is_chain(source: &str) -> bool {
        let Ok(document) = DeTable::parse(source) else { return false };
        let reader = Reader { source, document: document.get_ref() };
        let is_other_top = || {
            let (_, top) = reader.get("rod.top")?;
            Some(top.get_ref().as_table().is_some() || matches!(top.get_ref().as_str(), Some("ground" | "absorbing")))
        };
        ["body", "ends", "ground", "rod.bottom"].into_iter().any(|key| reader.get(key).is_some())
            || is_other_top() == Some(true)
    }

    /// Reads a scene.
    ///
    /// **Errors**: [`SceneError`] with the place of the value.
    pub fn parse(source: &str) -> Result<Self, SceneError> {
        let document = document(source)?;
        Reader { source, document: document.get_ref() }.chain()
    }

    /// Returns a scene for each bar, in the order of the bodies, with the problem of [`Chain::problems`]; `None` for a
    /// rigid body.
    ///
    /// **Errors**: those of [`Chain::problems`].
    pub fn bodies(&self) -> Result<Vec<Option<Scene>>, ProblemError> {
        let problems = self.chain.problems()?.into_iter().enumerate();
        Ok(problems.map(|(body, problem)| Some(self.of_body(body, problem?))).collect())
    }

    /// Returns the scene of the bar with this index.
    ///
    /// **Errors**: those of [`Chain::problem`].
    pub fn body(&self, body: usize) -> Result<Scene, ProblemError> {
        Ok(self.of_body(body, self.chain.problem(body)?))
    }

    fn of_body(&self, body: usize, problem: Problem) -> Scene {
        let own = format!("body[{body}].");
        let line = |(key, line): &(String, usize)| match key.strip_prefix(&own) {
            Some(key @ ("velocity" | "displacement" | "strain")) => (format!("start.{key}"), *line),
            Some(key) => (format!("rod.{key}"), *line),
            None => (key.clone(), *line),
        };
        Scene {
            title: self.title.as_ref().map(|title| match self.chain.bodies()[body].name() {
                _ if self.chain.bodies().len() == 1 => title.clone(),
                Some(name) => format!("{title}: {name}"),
                None => format!("{title}: body {}", body + 1),
            }),
            units: if self.has_material() { self.units } else { UnitSystem::Other },
            problem,
            accuracy: self.accuracy,
            publication: self.publication.clone(),
            targets: self.targets.iter().filter(|(of, _)| *of == body).map(|(_, target)| target.clone()).collect(),
            source: self.source.clone(),
            lines: self.lines.iter().map(line).collect(),
        }
    }

    /// Returns the line, from 1, of a key such as `body[1].gap` or `ends.top`; in a `[rod]` that of `rod.top`.
    pub fn line_of(&self, key: &str) -> Option<usize> {
        let in_rod = key.replace("body[0]", "rod").replace("ends.", "rod.");
        let line = |key: &str| self.lines.iter().find(|(name, _)| name == key).map(|(_, line)| *line);
        line(key).or_else(|| line(&in_rod))
    }

    /// Returns the name of the unit of `measure`: `N`; empty if no body has a material or the unit is not known.
    pub fn unit(&self, measure: Measure) -> &'static str {
        if self.has_material() { self.units.name(measure, false) } else { "" }
    }

    fn has_material(&self) -> bool {
        self.chain.bodies().iter().any(|body| matches!(body.material(), BodyMaterial::Elastic { .. }))
    }

    /// Returns the text that the scene was read from.
    pub fn source(&self) -> &str {
        &self.source
    }
}

impl<'a> Reader<'a> {
    fn chain(&self) -> Result<ChainScene, SceneError> {
        let is_rod = self.get("body").is_none();
        let (others, expected) = match is_rod {
            true => (vec!["ends"], "bottom and top in [rod]: [ends] belongs to bodies, [[body]]"),
            false => (
                vec!["rod", "impact", "start"],
                "either [rod] or [[body]]: velocity and displacement of the start belong to each [[body]]",
            ),
        };
        if let Some((key, _)) = others.iter().find_map(|key| self.get(key)) {
            let found = format!("[{}] beside {}", key.get_ref(), if is_rod { "[rod]" } else { "[[body]]" });
            return Err(self.error(key.span(), Kind::Contradiction, found, expected));
        }
        let known = if is_rod { ROD_TOP_KEYS } else { TOP_KEYS };
        self.check_near((self.document, "the scene"), known)?;
        for (path, expected) in INSTEAD {
            if let Some((key, _)) = self.get(path) {
                let found = format!("{} in a chain, or in a [rod] that is solved as one", key.get_ref());
                return Err(self.error(key.span(), Kind::UnknownKey, found, expected));
            }
        }
        for (name, known) in TABLES {
            let Some((_, value)) = self.get(name) else { continue };
            let Some(table) = value.get_ref().as_table() else {
                return Err(self.wrong_type(value, name, &format!("a table, [{name}]")));
            };
            self.check_near((table, &format!("[{name}]")), known)?;
        }
        let tables = self.bodies()?;
        let mut lines = self.lines();
        let mut joined = Vec::new();
        let mut springs = Vec::new();
        for (k, (table, span)) in tables.iter().enumerate() {
            let reader = Reader { document: table, ..*self };
            joined.push(match is_rod {
                true => (Joint::Bonded, reader.material_body(("[rod]", ROD_KEYS), span.clone())?),
                false => {
                    let (joint, body, spring) = reader.body(k, span.clone())?;
                    springs.extend(spring.map(|spring| (k, spring)));
                    (joint, body)
                }
            });
            lines.push((format!("body[{k}]"), position(self.source, span.start).0));
            let keys = table.keys().map(|key| (format!("body[{k}].{}", key.get_ref()), key.span().start));
            lines.extend(keys.map(|(name, start)| (name, position(self.source, start).0)));
        }
        let mut joined = joined.into_iter();
        let Some((_, mut lowest)) = joined.next() else {
            return Err(self.error(0..0, Kind::Missing, "no body", "one [[body]] or more"));
        };
        if is_rod {
            lowest = self.started(lowest)?;
        }
        let joined: Vec<(Joint, Body)> = joined.collect();
        let highest = joined.last().map_or_else(|| lowest.clone(), |(_, body)| body.clone());
        let ([mut bottom, top], own) = self.ends(is_rod, [&lowest, &highest])?;
        if is_rod {
            lowest = self.above_ground(lowest, &mut bottom)?;
        }
        for (node, spring) in [0, joined.len() + 1].into_iter().zip(own) {
            springs.extend(spring.map(|spring| (node, spring)));
        }
        let start = Chain::builder(lowest);
        let mut builder = joined.into_iter().fold(start, |builder, (joint, body)| builder.joined(joint, body));
        for (node, spring) in springs {
            builder = builder.spring(node, spring);
        }
        let run = self.table("run");
        let time = run.plain_number("time")?;
        let time =
            time.ok_or_else(|| self.error(0..0, Kind::Missing, "no time in [run]", "the last time of the chain"))?;
        let pieces = match run.plain_number("pieces")? {
            Some(pieces) if pieces.to_f64() >= 1.0 => pieces.to_f64() as usize,
            Some(pieces) => {
                let span = self.get("run.pieces").map_or(0..0, |(_, value)| value.span());
                return Err(self.error(span, Kind::OutOfRange, format!("pieces = {pieces}"), "1 wave piece or more"));
            }
            None => MAX_PIECES,
        };
        builder = builder.bottom(bottom).top(top).until(time).max_pieces(pieces);
        if let Some(gravity) = self.table("gravity").plain_number("acceleration")? {
            builder = builder.gravity(gravity);
        }
        let chain = builder.build().map_err(|error| self.placed(error))?;
        let is_elastic = |body: &Body| matches!(body.material(), BodyMaterial::Elastic { .. });
        let materials: Vec<bool> = chain.bodies().iter().map(is_elastic).collect();
        let (targets, chain_targets) = self.targets(&materials, Some(&chain))?;
        Ok(ChainScene {
            title: self.text("title")?.map(|(text, _)| text.to_string()),
            units: self.units()?,
            chain,
            publication: self.publication()?,
            targets,
            chain_targets,
            accuracy: self.accuracy()?,
            source: self.source.to_string(),
            lines,
        })
    }

    /// Returns a reader of the table at `name`, or of an empty one.
    pub(super) fn table(&self, name: &str) -> Reader<'a> {
        static EMPTY: std::sync::LazyLock<DeTable<'static>> = std::sync::LazyLock::new(DeTable::new);
        let table = self.get(name).and_then(|(_, value)| value.get_ref().as_table());
        Reader { document: table.unwrap_or(&EMPTY), ..*self }
    }

    fn bodies(&self) -> Result<Vec<(&'a DeTable<'a>, Range<usize>)>, SceneError> {
        let Some((_, value)) = self.get("body") else {
            let rod = self.get("rod").and_then(|(key, value)| Some((value.get_ref().as_table()?, key.span())));
            return Ok(rod.into_iter().collect());
        };
        let refused = |value: &Value<'a>| self.wrong_type(value, "body", "tables, [[body]]");
        let array = value.get_ref().as_array().ok_or_else(|| refused(value))?;
        let table = |value: &'a Value<'a>| value.get_ref().as_table().map(|table| (table, value.span()));
        array.into_iter().map(|value| table(value).ok_or_else(|| refused(value))).collect()
    }

    /// Reads the body in this table, and its joint with the body below.
    fn body(&self, index: usize, span: Range<usize>) -> Result<(Joint, Body, Option<Spring>), SceneError> {
        let shown = format!("[[body]] {}", index + 1);
        let body = match self.plain_number("mass")? {
            Some(mass) => {
                if let Some(key) = BODY_KEYS.iter().find(|key| !RIGID_KEYS.contains(key) && self.get(key).is_some()) {
                    let expected = "a bar without a mass, or a rigid mass without a length and a material";
                    return Err(self.contradiction((key, &shown), expected));
                }
                self.check_near((self.document, &shown), RIGID_KEYS)?;
                Body::rigid(mass)
            }
            None => self.material_body((&shown, BODY_KEYS), span)?,
        };
        let mut body = self.moving(body)?;
        if let Some((name, _)) = self.text("name")? {
            body = body.named(name);
        }
        let contradiction = |key: &str, expected: &str| self.contradiction((key, &shown), expected);
        let table = self.get("joint").and_then(|(_, value)| value.get_ref().as_table());
        let yielding = match table.filter(|_| index > 0) {
            Some(table) => {
                self.check_near((table, &format!("joint of {shown}")), JOINT_KEYS)?;
                let reader = Reader { document: table, ..*self };
                let spring = reader.spring(&body)?;
                if spring.is_none() {
                    let expected = "a stiffness, a damping, or a penalty in multiples of EA/L";
                    return Err(self.contradiction(("joint", &shown), expected));
                }
                spring.map(|spring| Ok((reader.flag("bonded")?, spring))).transpose()?
            }
            None => None,
        };
        let choice = match &yielding {
            Some((bonded, _)) => Some(usize::from(*bonded)),
            None if table.is_some() => None,
            None => self.choice("joint", &["contact", "bonded"])?,
        };
        let joint = match choice {
            _ if index == 0 => {
                for key in ["joint", "gap"] {
                    if self.get(key).is_some() {
                        return Err(contradiction(key, "a body below it: the bottom of the chain is in [ends]"));
                    }
                }
                Joint::Bonded
            }
            Some(1) if self.get("gap").is_some() => return Err(contradiction("gap", "no gap of a bonded joint")),
            Some(1) => Joint::Bonded,
            _ => Joint::Contact { gap: self.plain_number("gap")?.unwrap_or_else(|| 0.into()) },
        };
        Ok((joint, body, yielding.map(|(_, spring)| spring)))
    }

    fn contradiction(&self, (key, shown): (&str, &str), expected: &str) -> SceneError {
        let span = self.get(key).map_or(0..0, |(key, _)| key.span());
        self.error(span, Kind::Contradiction, format!("{key} of {shown}"), expected)
    }

    /// Reads the body in this table, at rest and undeformed; the table is called `shown` and has these keys.
    fn material_body(&self, (shown, known): (&str, &[&'static str]), span: Range<usize>) -> Result<Body, SceneError> {
        if let Some((key, _)) = self.get("damping") {
            let expected = "no damping: it is solved for a single rod on rigid ground, in a [rod] without other ends";
            return Err(self.error(key.span(), Kind::Contradiction, format!("damping of {shown}"), expected));
        }
        self.check_near((self.document, shown), known)?;
        let missing = |key: &str, expected: &str| {
            self.error(span.clone(), Kind::Missing, format!("no {key} in {shown}"), expected)
        };
        let contradiction = |key: &str, expected: &str| self.contradiction((key, shown), expected);
        let length = self.plain_number("length")?.ok_or_else(|| missing("length", "the length of the body"))?;
        let [modulus, density, area, speed, impedance] = ["modulus", "density", "area", "wave_speed", "impedance"];
        Ok(match (self.plain_number(speed)?, self.plain_number(modulus)?) {
            (Some(wave_speed), None) => {
                for key in [density, area, "poisson", "state"] {
                    if self.get(key).is_some() {
                        return Err(contradiction(key, "it with a modulus, or wave_speed and impedance alone"));
                    }
                }
                let expected = "an impedance Z = ρcA beside the wave speed";
                let impedance = match self.plain_number(impedance)? {
                    Some(impedance) => impedance,
                    // The forces of a rod by itself are those per ρA.
                    None if known == ROD_KEYS => wave_speed.clone(),
                    None => return Err(missing(impedance, expected)),
                };
                Body::new(length, wave_speed, impedance)
            }
            (None, Some(modulus)) => {
                if self.get(impedance).is_some() {
                    return Err(contradiction(impedance, "modulus, density and area, or wave_speed and impedance"));
                }
                let density = self.plain_number(density)?.ok_or_else(|| missing(density, "a density"))?;
                let area = self.plain_number(area)?.unwrap_or_else(|| 1.into());
                let young = modulus.to_rational();
                let modulus = self.constrained(modulus)?;
                let of_waves = modulus.to_rational();
                let constraint = (of_waves != young).then(|| of_waves / young);
                Body::elastic(length, modulus, density, area).with_constraint(constraint)
            }
            (Some(_), Some(_)) => return Err(contradiction(speed, "wave_speed or modulus, not both")),
            (None, None) => return Err(missing("wave_speed", "wave_speed and impedance, or modulus and density")),
        })
    }

    /// Returns `body` with velocity, displacement and strain of this table.
    fn moving(&self, body: Body) -> Result<Body, SceneError> {
        let body = match self.get("velocity") {
            Some((_, value)) if value.get_ref().as_array().is_some() => {
                body.with_start(self.list("velocity")?, Vec::new())
            }
            _ => match self.plain_number("velocity")? {
                Some(velocity) => body.with_velocity(velocity),
                None => body,
            },
        };
        Ok(body.with_displacement(self.list("displacement")?).with_strain(self.list("strain")?))
    }

    /// Returns the body of a `[rod]` with the start of `[impact]` or `[start]`.
    fn started(&self, body: Body) -> Result<Body, SceneError> {
        let Some(speed) = self.table("impact").plain_number("speed")? else { return self.table("start").moving(body) };
        if let Some((key, _)) = self.get("start") {
            let found = "[start] beside the speed of [impact]";
            return Err(self.error(key.span(), Kind::Contradiction, found, "one of them"));
        }
        let span = self.get("impact.speed").map_or(0..0, |(_, value)| value.span());
        let refused = || self.error(span, Kind::NotANumber, format!("speed = {speed}"), "a number of fewer digits");
        Ok(body.with_velocity(Number::of_rational(&-speed.to_rational()).ok_or_else(refused)?))
    }

    /// Returns the modulus of waves: `modulus` itself, or the constrained one under uniaxial strain.
    fn constrained(&self, modulus: Number) -> Result<Number, SceneError> {
        let state = self.choice("state", &["uniaxial stress", "uniaxial strain"])?;
        let Some(poisson) = self.plain_number("poisson")? else {
            return match (state, self.get("state")) {
                (Some(1), Some((key, _))) => {
                    let found = "state = \"uniaxial strain\" without poisson";
                    Err(self.error(key.span(), Kind::Missing, found, "Poisson's ratio"))
                }
                _ => Ok(modulus),
            };
        };
        if state != Some(1) {
            return match (state, self.get("poisson")) {
                (None, Some((key, _))) => {
                    let expected = "state = \"uniaxial strain\", or \"uniaxial stress\", in which it changes nothing";
                    Err(self.error(key.span(), Kind::Missing, "poisson without a state", expected))
                }
                _ => Ok(modulus),
            };
        }
        let (one, nu) = (Rational::from(1), poisson.to_rational());
        let span = self.get("poisson").map_or(0..0, |(_, value)| value.span());
        let refused = || {
            self.error(span.clone(), Kind::OutOfRange, format!("poisson = {poisson}"), "a ratio above −1 and below 1/2")
        };
        if nu <= -one.clone() || nu.clone() * Rational::from(2) >= one {
            return Err(refused());
        }
        let factor = (one.clone() - &nu) / ((one.clone() + &nu) * (one - nu * Rational::from(2)));
        Number::of_rational(&(modulus.to_rational() * factor)).ok_or_else(refused)
    }

    /// Reads points, or a single number that holds for ever.
    pub(super) fn list(&self, key: &str) -> Result<Points, SceneError> {
        let Some((_, value)) = self.get(key) else { return Ok(Vec::new()) };
        let Some(array) = value.get_ref().as_array() else {
            return Ok(self.plain_number(key)?.map(|value| vec![(0.into(), value)]).unwrap_or_default());
        };
        let point = |point: &Value<'a>| match point.get_ref().as_array().map(|array| array.iter().as_slice()) {
            Some([x, v]) => Ok((self.number_in(x, key)?, self.number_in(v, key)?)),
            _ => {
                let found = format!("{} among the points of the {key}", short(self.slice(&point.span())));
                Err(self.error(point.span(), Kind::WrongType, found, "points such as [[0, 0], [1, 2]]"))
            }
        };
        let points: Points = array.into_iter().map(point).collect::<Result<_, _>>()?;
        if points.is_empty() {
            let found = format!("no points of the {key}");
            return Err(self.error(value.span(), Kind::Profile, found, "one point or more"));
        }
        Ok(points)
    }

    /// Returns the error of a chain, at its place: `body[1].velocity[2].x`, `ends.top`, `ends.bottom.stiffness`.
    fn placed(&self, error: ProblemError) -> SceneError {
        let ProblemError { kind, path, found, expected } = error;
        let body = path.strip_prefix("body[").and_then(|rest| rest.split_once("]."));
        let span = match body {
            Some((index, key)) => {
                let tables = self.bodies().unwrap_or_default();
                index.parse().ok().and_then(|index: usize| tables.get(index).cloned()).map(|(table, span)| {
                    let key = key.split('[').next().unwrap_or(key);
                    Reader { document: table, ..*self }.span_of(key).unwrap_or(span)
                })
            }
            None => {
                let path = path.split('[').next().unwrap_or(&path);
                // A spring below the lowest body may stand in the table of the ground.
                let ground = path.strip_prefix("ends.bottom.").and_then(|key| self.table("ground").span_of(key));
                ground.or_else(|| self.span_of(path)).or_else(|| self.span_of(&path.replace("ends.", "rod.")))
            }
        };
        self.error(span.unwrap_or(0..0), kind, found, expected)
    }

    /// Returns the place of a value, of a penalty in place of a stiffness, or of the table that lacks the value.
    fn span_of(&self, path: &str) -> Option<Range<usize>> {
        let penalty = path.replace("stiffness", "penalty");
        let table = path.rsplit_once('.').map(|(table, _)| table);
        let found = [Some(path), Some(&penalty), table].into_iter().flatten().find_map(|path| self.get(path));
        found.map(|(_, value)| value.span())
    }
}

#[cfg(test)]
#[path = "tests/chain.rs"]
mod tests;
