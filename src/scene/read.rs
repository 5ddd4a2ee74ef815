//! From the text of a scene to a checked problem.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::ops::Range;

use toml::de::{DeTable, DeValue};

use super::error::{SceneError, SceneErrorKind as Kind, position};
use super::table::{Quantity, Table, Value};
use crate::number::Number;
use crate::rod::{Material, Problem, Profile, Rod, Run, Speed, Start, Top};

const SCENE_KEYS: &[&str] = &["title", "rod", "impact", "gravity", "start", "run"];
const ROD_KEYS: &[&str] = &["length", "wave_speed", "modulus", "density", "area", "damping", "top"];
const IMPACT_KEYS: &[&str] = &["speed", "drop_height"];
const GRAVITY_KEYS: &[&str] = &["acceleration"];
const START_KEYS: &[&str] = &["displacement", "velocity"];
const RUN_KEYS: &[&str] = &["time", "impacts", "accuracy"];

const MAX_BYTES: usize = 16 << 20;
const MAX_IMPACTS: u32 = 10_000_000;
const MAX_POINTS: usize = 100_000;
/// Every quantity with a unit: energies are products of at most seven of them and stay within 1e±300.
const UNITS: (f64, f64) = (1e-40, 1e40);
const MAX_DAMPING: f64 = 1e6;
const MIN_DAMPING: f64 = 1e-305;
const SPEED_RATIO: (f64, f64) = (1e-12, 1e12);
const MAX_ROUND_TRIPS: f64 = 1e12;
/// Least distance of two points of a profile, in lengths of the rod.
const MIN_SPACING: f64 = 1e-12;

/// What a person wrote, checked: a problem in exact numbers, and the line that each value stands on.
///
/// **Accuracy**: *exact*; a number is the rational that its text spells.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// `title`.
    pub title: Option<String>,
    /// What is to be solved.
    pub problem: Problem,
    /// `run.accuracy`: the relative accuracy asked for.
    pub accuracy: Option<Number>,
    source: String,
    lines: BTreeMap<String, usize>,
}

impl Scene {
    /// Reads a scene.
    ///
    /// **Errors**: [`SceneError`], which says what was found, at which line and column, and what was expected, for
    /// everything that is not a scene within the [limits](crate::scene#limits).
    ///
    /// ```
    /// use dalembert::Scene;
    /// let scene = Scene::parse("[rod]\nlength = 0.1\nwave_speed = 1\n[impact]\nspeed = '1/3'\n")?;
    /// assert_eq!(scene.problem.rod.length.to_string(), "0.1");
    /// assert_eq!(scene.line_of("impact.speed"), Some(5));
    /// # Ok::<(), dalembert::scene::SceneError>(())
    /// ```
    pub fn parse(source: &str) -> Result<Self, SceneError> {
        if source.len() > MAX_BYTES {
            let found = format!("a scene of {} bytes", source.len());
            return Err(SceneError::new("", 0..0, Kind::TooLong, found, format!("at most {MAX_BYTES}")));
        }
        let document = DeTable::parse(source).map_err(|error| syntax(source, &error))?;
        Reader::new(source, document.get_ref())?.scene()
    }

    /// The line, from 1, of a key such as `rod.damping` or `start`; `None` where the scene does not have it.
    pub fn line_of(&self, key: &str) -> Option<usize> {
        self.lines.get(key).copied()
    }

    /// The text that the scene was read from.
    pub fn source(&self) -> &str {
        &self.source
    }
}

/// What the TOML reader says, with its place.
fn syntax(source: &str, error: &toml::de::Error) -> SceneError {
    let span = error.span().unwrap_or(0..0);
    let (found, expected) = error.message().split_once(", expected ").unwrap_or((error.message(), ""));
    let expected = if expected.is_empty() { "a TOML document" } else { expected };
    SceneError::new(source, span, Kind::Syntax, format!("text that is not TOML ({found})"), expected)
}

/// The tables of one scene.
struct Reader<'a> {
    source: &'a str,
    root: Table<'a>,
    rod: Table<'a>,
    impact: Option<Table<'a>>,
    gravity: Option<Table<'a>>,
    start: Option<Table<'a>>,
    run: Option<Table<'a>>,
}

/// The quantities that decide the size of everything else, each with its place.
struct Scales {
    length: Quantity,
    /// `c` in double precision.
    wave_speed: f64,
    damping: Option<Quantity>,
    gravity: Option<Quantity>,
}

impl Scales {
    fn round_trip(&self) -> f64 {
        2.0 * self.length.number.to_f64() / self.wave_speed
    }

    /// `μ₀ = g t₁`.
    fn critical_speed(&self) -> Option<f64> {
        self.gravity.as_ref().map(|g| g.number.to_f64() * self.round_trip())
    }
}

impl<'a> Reader<'a> {
    fn new(source: &'a str, document: &'a DeTable<'a>) -> Result<Self, SceneError> {
        let root = Table::new(source, "the scene", 0..0, document, SCENE_KEYS)?;
        let rod = root.table("rod", ROD_KEYS)?.ok_or_else(|| {
            root.error(0..0, Kind::MissingKey, "no [rod]", "the table [rod] with length and wave_speed")
        })?;
        let impact = root.table("impact", IMPACT_KEYS)?;
        let gravity = root.table("gravity", GRAVITY_KEYS)?;
        let start = root.table("start", START_KEYS)?;
        let run = root.table("run", RUN_KEYS)?;
        Ok(Reader { source, root, rod, impact, gravity, start, run })
    }

    fn scene(&self) -> Result<Scene, SceneError> {
        let title = self.root.string("title")?.map(|(text, _)| text.to_string());
        let length = required(&self.rod, "length", "a length")?;
        let (material, wave_speed) = self.material()?;
        let damping = non_negative(&self.rod, "damping", "a damping")?;
        let gravity = self.gravity()?;
        let top = self.top()?;
        let scales = Scales { length, wave_speed, damping, gravity };
        self.check_scales(&scales)?;
        let start = self.start(&scales)?;
        let run = self.run(&scales)?;
        let accuracy = self.accuracy()?;
        let Scales { length, damping, gravity, .. } = scales;
        let rod = Rod { length: length.number, material, damping: damping.map(|r| r.number), top };
        let problem = Problem { rod, gravity: gravity.map(|g| g.number), start, run };
        Ok(Scene { title, problem, accuracy, source: self.source.to_string(), lines: self.lines() })
    }

    /// What sets the wave speed, and the wave speed in double precision.
    fn material(&self) -> Result<(Material, f64), SceneError> {
        let rod = &self.rod;
        const ELASTIC: [&str; 3] = ["modulus", "density", "area"];
        if let Some(wave_speed) = positive(rod, "wave_speed", "a wave speed")? {
            for key in ELASTIC {
                rod.refuse(key, "wave_speed", "either wave_speed, or modulus, density and area")?;
            }
            let value = wave_speed.number.to_f64();
            return Ok((Material::WaveSpeed(wave_speed.number), value));
        }
        if ELASTIC.iter().all(|key| rod.get(key).is_none()) {
            return Err(rod.missing("wave_speed, or modulus, density and area"));
        }
        let modulus = required(rod, "modulus", "a modulus")?.number;
        let density = required(rod, "density", "a density")?.number;
        let area = required(rod, "area", "an area")?.number;
        let wave_speed = (modulus.to_f64() / density.to_f64()).sqrt();
        Ok((Material::Elastic { modulus, density, area }, wave_speed))
    }

    fn top(&self) -> Result<Top, SceneError> {
        match self.rod.string("top")? {
            None | Some(("free", _)) => Ok(Top::Free),
            Some(("fixed", _)) => Ok(Top::Fixed),
            Some((_, span)) => {
                let found = format!("top = {}", super::error::short(self.rod.slice(&span)));
                Err(self.rod.error(span, Kind::OutOfRange, found, "\"free\" or \"fixed\""))
            }
        }
    }

    fn gravity(&self) -> Result<Option<Quantity>, SceneError> {
        let Some(table) = &self.gravity else { return Ok(None) };
        if table.get("acceleration").is_none() {
            return Err(table.missing("acceleration"));
        }
        non_negative(table, "acceleration", "an acceleration")
    }

    /// The scales that follow from the rod and gravity, within what double precision holds.
    fn check_scales(&self, scales: &Scales) -> Result<(), SceneError> {
        let (t1, length) = (scales.round_trip(), &scales.length);
        let refuse = |quantity: &Quantity, what: String, expected: String| {
            let found = format!("{} = {}, which makes {what}", quantity.key, self.shown(quantity));
            Err(self.root.error(quantity.span.clone(), Kind::Combination, found, expected))
        };
        if !within(scales.wave_speed, UNITS) {
            let found = format!("a modulus and a density which make the wave speed {:e}", scales.wave_speed);
            let span = self.rod.get("modulus").map_or(0..0, |entry| entry.value.span());
            return Err(self.root.error(span, Kind::Combination, found, format!("one {}", range(UNITS))));
        }
        if !within(t1, UNITS) {
            return refuse(length, format!("the round trip 2L/c = {t1:e}"), format!("one {}", range(UNITS)));
        }
        if let (Some(g), Some(speed)) = (&scales.gravity, scales.critical_speed()) {
            if !within(speed, UNITS) {
                return refuse(g, format!("g t₁ = {speed:e}"), format!("a speed {}", range(UNITS)));
            }
        }
        if let Some(r) = &scales.damping {
            let group = r.number.to_f64() * t1;
            let limits = (MIN_DAMPING, MAX_DAMPING);
            if !within(group, limits) {
                return refuse(r, format!("r t₁ = {group:e}"), format!("zero or a value {}", range(limits)));
            }
        }
        Ok(())
    }

    fn start(&self, scales: &Scales) -> Result<Start, SceneError> {
        match (&self.impact, &self.start) {
            (Some(impact), None) => self.impact(impact, scales).map(Start::Uniform),
            (None, Some(start)) => self.profile(start, scales).map(Start::Profile),
            (Some(_), Some(_)) => {
                let expected = "either [impact], for a uniform start, or [start]";
                self.root.refuse("start", "[impact]", expected)?;
                Err(self.root.missing(expected))
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
                return Err(impact.missing("either speed or drop_height"));
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
            (None, None) => return Err(impact.missing("speed or drop_height")),
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
            return Err(start.missing("displacement, velocity or both"));
        }
        let displacement = self.points(start, "displacement", scales)?;
        let velocity = self.points(start, "velocity", scales)?;
        let values =
            |points: Vec<(Quantity, Quantity)>| points.into_iter().map(|(x, v)| (x.number, v.number)).collect();
        if let Some((_, ground)) = displacement.first() {
            if ground.number.to_f64() < 0.0 {
                let found = format!("the displacement {} at x = 0", self.shown(ground));
                let expected = "zero or more: the ground is at zero";
                return Err(start.error(ground.span.clone(), Kind::OutOfRange, found, expected));
            }
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
            let found = format!("{key} with {} points", array.len());
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
            let (x, v) = point(start, value, key)?;
            let Some((last, _)) = points.last() else {
                if !x.number.is_zero() {
                    return refuse(&x, "the first point at x = 0".into());
                }
                points.push((x, v));
                continue;
            };
            if x.number.compare(length).is_gt() {
                return refuse(&x, format!("a point within the length {}", super::error::short(&length.to_string())));
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
                refuse(x, format!("the last point at the length {}", super::error::short(&length.to_string())))
            }
            _ => Ok(points),
        }
    }

    fn run(&self, scales: &Scales) -> Result<Run, SceneError> {
        let Some(table) = &self.run else { return Ok(Run::Impacts(1)) };
        let time = positive(table, "time", "a time")?;
        let Some(time) = time else { return self.impacts(table) };
        table.refuse("impacts", "time", "either time or impacts")?;
        let round_trips = time.number.to_f64() / scales.round_trip();
        if round_trips > MAX_ROUND_TRIPS {
            let found = format!("time = {}, which is {round_trips:e} round trips", self.shown(&time));
            let expected = format!("at most {MAX_ROUND_TRIPS:e} round trips of 2L/c");
            return Err(table.error(time.span, Kind::Combination, found, expected));
        }
        Ok(Run::Time(time.number))
    }

    fn impacts(&self, table: &Table<'_>) -> Result<Run, SceneError> {
        let Some(entry) = table.get("impacts") else { return Ok(Run::Impacts(1)) };
        let DeValue::Integer(integer) = entry.value.get_ref() else {
            return Err(table.wrong_type(entry.value, "impacts", "a whole number"));
        };
        match integer.as_str().parse() {
            Ok(impacts @ 1..=MAX_IMPACTS) if integer.radix() == 10 => Ok(Run::Impacts(impacts)),
            _ => {
                let found = format!("impacts = {}", super::error::short(table.slice(&entry.value.span())));
                let expected = format!("a whole number from 1 to {MAX_IMPACTS}");
                Err(table.error(entry.value.span(), Kind::OutOfRange, found, expected))
            }
        }
    }

    fn accuracy(&self) -> Result<Option<Number>, SceneError> {
        let Some(table) = &self.run else { return Ok(None) };
        let Some(accuracy) = table.number("accuracy")? else { return Ok(None) };
        if within(accuracy.number.to_f64(), (1e-300, 0.1)) {
            return Ok(Some(accuracy.number));
        }
        let found = format!("accuracy = {}", self.shown(&accuracy));
        Err(table.error(accuracy.span, Kind::OutOfRange, found, "a relative accuracy between 1e-300 and 0.1"))
    }

    /// A number as it stands in the source, shortened.
    fn shown(&self, quantity: &Quantity) -> String {
        super::error::short(self.root.slice(&quantity.span))
    }

    /// The line of every key.
    fn lines(&self) -> BTreeMap<String, usize> {
        let line = |span: &Range<usize>| position(self.source, span.start).0;
        let tables = [
            ("rod", Some(&self.rod)),
            ("impact", self.impact.as_ref()),
            ("gravity", self.gravity.as_ref()),
            ("start", self.start.as_ref()),
            ("run", self.run.as_ref()),
        ];
        let mut lines: BTreeMap<String, usize> =
            self.root.entries().iter().map(|entry| (entry.key.to_string(), line(&entry.key_span))).collect();
        for (name, table) in tables {
            let entries = table.map(Table::entries).unwrap_or_default();
            lines.extend(entries.iter().map(|entry| (format!("{name}.{}", entry.key), line(&entry.key_span))));
        }
        lines
    }
}

/// One point `[x, value]`.
fn point(start: &Table<'_>, value: &Value<'_>, key: &'static str) -> Result<(Quantity, Quantity), SceneError> {
    let pair = value.get_ref().as_array().filter(|array| array.len() == 2);
    let mut numbers = pair.into_iter().flat_map(|array| array.iter());
    let (Some(x), Some(v)) = (numbers.next(), numbers.next()) else {
        let found = format!("{} among the points of the {key}", super::error::short(start.slice(&value.span())));
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

/// A quantity that has to be there.
fn required(table: &Table<'_>, key: &'static str, what: &str) -> Result<Quantity, SceneError> {
    positive(table, key, what)?.ok_or_else(|| table.missing(key))
}

/// A quantity above zero, if it is there.
fn positive(table: &Table<'_>, key: &'static str, what: &str) -> Result<Option<Quantity>, SceneError> {
    let Some(quantity) = table.number(key)? else { return Ok(None) };
    if quantity.number.to_f64() <= 0.0 {
        return Err(out_of_range(table, &quantity, &format!("{what} above zero")));
    }
    if !within(quantity.number.to_f64(), UNITS) {
        return Err(out_of_range(table, &quantity, &format!("{what} {}", range(UNITS))));
    }
    Ok(Some(quantity))
}

/// A quantity that is not negative, if it is there and not zero.
fn non_negative(table: &Table<'_>, key: &'static str, what: &str) -> Result<Option<Quantity>, SceneError> {
    let Some(quantity) = table.number(key)? else { return Ok(None) };
    if quantity.number.to_f64() < 0.0 {
        return Err(out_of_range(table, &quantity, &format!("{what} of zero or more")));
    }
    // A damping is held to the range of r t₁ alone: weak ones are asked for on purpose.
    if !quantity.number.is_zero() && key != "damping" && !within(quantity.number.to_f64(), UNITS) {
        return Err(out_of_range(table, &quantity, &format!("zero or {what} {}", range(UNITS))));
    }
    Ok(Some(quantity).filter(|quantity| !quantity.number.is_zero()))
}

fn out_of_range(table: &Table<'_>, quantity: &Quantity, expected: &str) -> SceneError {
    let found = format!("{} = {}", quantity.key, super::error::short(table.slice(&quantity.span)));
    table.error(quantity.span.clone(), Kind::OutOfRange, found, expected)
}

fn within(value: f64, (low, high): (f64, f64)) -> bool {
    (low..=high).contains(&value)
}

fn range((low, high): (f64, f64)) -> String {
    format!("between {low:e} and {high:e}")
}
