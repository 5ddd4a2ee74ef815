//! From the text of a scene to a checked problem.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::de::{DeTable, DeValue};

use super::error::{SceneError, SceneErrorKind as Kind, position};
use super::table::{Quantity, Table};
use crate::number::Number;
use crate::rod::{Material, Problem, Rod, Run, Top};

const SCENE_KEYS: &[&str] = &["title", "rod", "impact", "gravity", "start", "run"];
const ROD_KEYS: &[&str] = &["length", "wave_speed", "modulus", "density", "area", "damping", "top"];
const IMPACT_KEYS: &[&str] = &["speed", "drop_height"];
const GRAVITY_KEYS: &[&str] = &["acceleration"];
const START_KEYS: &[&str] = &["displacement", "velocity"];
const RUN_KEYS: &[&str] = &["time", "impacts", "accuracy"];

const MAX_BYTES: usize = 16 << 20;
const MAX_IMPACTS: u32 = 10_000_000;
/// Every quantity with a unit: energies are products of at most seven of them and stay within 1e±300.
pub(super) const UNITS: (f64, f64) = (1e-40, 1e40);
const MAX_DAMPING: f64 = 1e6;
const MIN_DAMPING: f64 = 1e-305;
const MAX_ROUND_TRIPS: f64 = 1e12;

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
    let expected = match (found, expected) {
        ("duplicate key", "") => "each key once",
        (_, "") => "a TOML document",
        (_, expected) => expected,
    };
    SceneError::new(source, span, Kind::Syntax, format!("text that is not TOML ({found})"), expected)
}

/// The tables of one scene.
pub(super) struct Reader<'a> {
    source: &'a str,
    pub(super) root: Table<'a>,
    rod: Table<'a>,
    pub(super) impact: Option<Table<'a>>,
    gravity: Option<Table<'a>>,
    pub(super) start: Option<Table<'a>>,
    run: Option<Table<'a>>,
}

/// The quantities that decide the size of everything else, each with its place.
pub(super) struct Scales {
    pub(super) length: Quantity,
    /// `c` in double precision.
    wave_speed: f64,
    damping: Option<Quantity>,
    pub(super) gravity: Option<Quantity>,
}

impl Scales {
    fn round_trip(&self) -> f64 {
        2.0 * self.length.number.to_f64() / self.wave_speed
    }

    /// `μ₀ = g t₁`.
    pub(super) fn critical_speed(&self) -> Option<f64> {
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
            return Err(rod.missing("no wave speed", "wave_speed, or modulus, density and area"));
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
            return Err(table.missing("no acceleration", "acceleration, zero or more"));
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
        if !within(t1, UNITS) {
            return refuse(length, format!("the round trip 2L/c = {t1:e}"), format!("one {}", range(UNITS)));
        }
        if let (Some(g), Some(speed)) = (&scales.gravity, scales.critical_speed())
            && !within(speed, UNITS)
        {
            return refuse(g, format!("g t₁ = {speed:e}"), format!("a speed {}", range(UNITS)));
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
    pub(super) fn shown(&self, quantity: &Quantity) -> String {
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

/// A quantity that has to be there.
fn required(table: &Table<'_>, key: &'static str, what: &str) -> Result<Quantity, SceneError> {
    positive(table, key, what)?.ok_or_else(|| table.missing(&format!("no {key}"), &format!("{what} above zero")))
}

/// A quantity above zero, if it is there.
pub(super) fn positive(table: &Table<'_>, key: &'static str, what: &str) -> Result<Option<Quantity>, SceneError> {
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

pub(super) fn out_of_range(table: &Table<'_>, quantity: &Quantity, expected: &str) -> SceneError {
    let found = format!("{} = {}", quantity.key, super::error::short(table.slice(&quantity.span)));
    table.error(quantity.span.clone(), Kind::OutOfRange, found, expected)
}

pub(super) fn within(value: f64, (low, high): (f64, f64)) -> bool {
    (low..=high).contains(&value)
}

pub(super) fn range((low, high): (f64, f64)) -> String {
    format!("between {low:e} and {high:e}")
}
