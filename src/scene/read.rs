//! The reader of scenes: TOML types and keys, and the place of each error.

use std::ops::Range;

use toml::Spanned;
use toml::de::DeTable;

use super::error::{SceneError, position};
use super::publication::Publication;
use super::reader::{Key, Reader, Value};
use super::suggest;
use super::target::Target;
use crate::names::did_you_mean;
use crate::number::Number;
use crate::problem::given::Given;
use crate::problem::profile::{Points, SHAPE};
use crate::problem::validate::Draft;
use crate::problem::written::{has_unit, short};
use crate::problem::{Material, Parameter, Problem, ProblemError, ProblemErrorKind as Kind, Top};
use crate::quantity::UnitSystem;
use crate::solve::ACCURACIES;

const TOP_KEYS: &[&str] = &["title", "units", "rod", "impact", "gravity", "start", "run", "publication", "target"];

/// The tables whose keys are parameters.
const TABLES: [&str; 5] = ["rod", "impact", "gravity", "start", "run"];

fn keys(table: &str) -> Vec<&'static str> {
    let parameters = Parameter::ALL.iter().map(|parameter| parameter.table_and_key());
    let keys = parameters.filter(|(of, _)| *of == table).map(|(_, key)| key);
    keys.chain((table == "run").then_some("accuracy")).collect()
}

const MAX_BYTES: usize = 16 << 20;

/// A scene file, checked: a problem in exact numbers, and the line that each value stands on.
///
/// **Accuracy**: *exact*; a number is the rational that its text spells.
///
/// ```toml
/// title = "A rod dropped on the ground"
/// [rod]
/// length = 1            # L: a TOML number, or a string such as "1/3"
/// wave_speed = 1        # c; or modulus and density: then c = √(modulus/density)
/// [impact]
/// speed = 3             # μ at the touch, which is t = 0; or drop_height, with gravity
/// [gravity]
/// acceleration = 1      # g; absent or 0: no gravity
/// [run]
/// time = 40             # or impacts = 3; absent: the first contact and the flight after it
/// ```
///
/// `docs/scenes.md` has every key, the start of the clock, published values, and sources.
///
/// # Where the clock starts
/// At the first touch; with a `gap`, that far above the ground: every point of the undeformed rod moves down with
/// `speed`, and until the touch `h″ + 2r h′ = −g`. Under a fixed top the rod is stopped there at `t = 0`, and hangs
/// from `v(L,t) = gap`: its lower end may touch or not.
///
/// ```
/// use dalembert::Scene;
/// let scene = Scene::parse("rod = { length = 1, wave_speed = 1 }\nimpact = { speed = 2, gap = 3 }\n")?;
/// let history = scene.problem.doubles()?;
/// assert_eq!((history.contacts()[0].impact, history.contacts()[0].release), (1.5, Some(3.5))); // gap/μ, and 2L/c more
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Limits
/// Those of a [problem](crate::Problem#limits), an accuracy of 1e-15 … 0.1, and at most 16 MiB of text.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// `title`.
    pub title: Option<String>,
    /// `units`: what the numbers are in; SI where nothing is said. It names what is printed and changes no number.
    pub units: UnitSystem,
    /// The problem to solve.
    pub problem: Problem,
    /// `run.accuracy`: the relative accuracy asked for.
    pub accuracy: Option<f64>,
    /// `[publication]`: where the scene comes from.
    pub publication: Option<Publication>,
    /// `[[target]]`: what others have published of this scene.
    pub targets: Vec<Target>,
    pub(super) source: String,
    pub(super) lines: Vec<(String, usize)>,
}

impl Scene {
    /// Reads a scene.
    ///
    /// **Errors**: [`SceneError`], which says what was found, at which line and column, and what was expected, for
    /// everything that is not a scene within the [limits](crate::Scene#limits).
    ///
    /// ```
    /// use dalembert::Scene;
    /// let scene = Scene::parse("[rod]\nlength = 0.1\nwave_speed = 1\n[impact]\nspeed = '1/3'\n")?;
    /// assert_eq!(scene.problem.length().to_string(), "0.1");
    /// assert_eq!(scene.line_of("impact.speed"), Some(5));
    /// # Ok::<(), dalembert::SceneError>(())
    /// ```
    pub fn parse(source: &str) -> Result<Self, SceneError> {
        let document = document(source)?;
        Reader { source, document: document.get_ref() }.scene()
    }

    /// The line, from 1, of a key such as `rod.damping` or `start`; `None` where the scene does not have it.
    pub fn line_of(&self, key: &str) -> Option<usize> {
        self.lines.iter().find(|(name, _)| name == key).map(|(_, line)| *line)
    }

    /// The text that the scene was read from.
    pub fn source(&self) -> &str {
        &self.source
    }
}

/// Reads a document.
///
/// **Errors**: [`SceneError`] for one that is too long, or is not TOML.
pub(super) fn document(source: &str) -> Result<Spanned<DeTable<'_>>, SceneError> {
    if source.len() > MAX_BYTES {
        let found = format!("a scene of {} bytes", source.len());
        return Err(SceneError::new("", 0..0, Kind::TooLong, found, format!("at most {MAX_BYTES}")));
    }
    DeTable::parse(source).map_err(|error| syntax(source, &error))
}

/// Returns the error of the TOML reader, with its place; a number with a unit and a bare fraction are recognised.
fn syntax(source: &str, error: &toml::de::Error) -> SceneError {
    let span = error.span().unwrap_or(0..0);
    let value = value_around(source, span.start);
    let text = source.get(value.clone()).unwrap_or_default();
    let (found, expected, span) = match error.message().split_once(", expected ") {
        _ if has_unit(text) => (short(text), "a number without a unit", value),
        _ if text.contains('/') && text.parse::<Number>().is_ok() => (short(text), "a fraction in quotes", value),
        Some((found, expected)) => (found.to_string(), expected, span),
        None if error.message() == "duplicate key" => ("duplicate key".into(), "each key once", span),
        None => (error.message().to_string(), "a TOML document", span),
    };
    SceneError::new(source, span, Kind::Syntax, format!("text that is not TOML ({found})"), expected)
}

/// Returns the value around `at`: from the last `=`, `,` or `[` of the line before it.
fn value_around(source: &str, at: usize) -> Range<usize> {
    let start = source.get(..at).and_then(|before| before.rfind(['=', ',', '[', '\n'])).map_or(0, |found| found + 1);
    let value = &source[start..];
    let value = &value[..value.find([',', ']', '}', '#', '\n']).unwrap_or(value.len())];
    let start = start + value.len() - value.trim_start().len();
    start..start + value.trim().len()
}

impl<'a> Reader<'a> {
    fn scene(&self) -> Result<Scene, SceneError> {
        self.check_keys("", TOP_KEYS)?;
        for table in TABLES {
            self.check_keys(table, &keys(table))?;
        }
        let title = self.text("title")?.map(|(text, _)| text.to_string());
        let problem = self.draft()?.check().map_err(|error| self.located(error))?;
        let accuracy = self.accuracy()?;
        let (targets, _) = self.targets(&[matches!(problem.material(), Material::Elastic { .. })], None)?;
        let targets = targets.into_iter().map(|(_, target)| target).collect();
        Ok(Scene {
            title,
            units: self.units()?,
            problem,
            accuracy,
            publication: self.publication()?,
            targets,
            source: self.source.to_string(),
            lines: self.lines(),
        })
    }

    /// Refuses a table that is none, has an unknown key, or lacks what it is there for.
    fn check_keys(&self, name: &str, known: &[&'static str]) -> Result<(), SceneError> {
        let (table, shown, span) = match (name, self.get(name)) {
            ("", _) => (self.document, "the scene".to_string(), 0..0),
            ("rod", None) => {
                let expected = "the table [rod] with length and wave_speed";
                return Err(self.error(0..0, Kind::Missing, "no [rod]", expected));
            }
            (_, None) => return Ok(()),
            (_, Some((key, value))) => match value.get_ref().as_table() {
                Some(table) => (table, format!("[{name}]"), key.span()),
                None => return Err(self.wrong_type(value, name, &format!("a table, [{name}]"))),
            },
        };
        self.check_known((table, &shown), known, |key| suggest::key(key, name, known))?;
        let (found, expected) = match name {
            "impact" => ("no speed", "speed, with a gap or without, or drop_height"),
            "gravity" => ("no acceleration", "acceleration, zero or more"),
            "start" => ("no points", "displacement, velocity or both"),
            _ => return Ok(()),
        };
        if table.is_empty() {
            return Err(self.error(span, Kind::Missing, format!("{found} in {shown}"), expected));
        }
        Ok(())
    }

    /// The values of the problem, unchecked.
    fn draft(&self) -> Result<Draft, SceneError> {
        if let Some((_, value)) = self.get("run.impacts")
            && value.get_ref().as_integer().is_none()
        {
            return Err(self.wrong_type(value, "impacts", "a whole number"));
        }
        let mut draft = Draft { from_scene: true, top: self.top()?, ..Draft::default() };
        for parameter in Parameter::numbers() {
            if let Some(number) = self.number(parameter.path())? {
                draft.numbers.insert(parameter, number);
            }
        }
        for list in Parameter::LISTS {
            if let Some(points) = self.points(list.path())? {
                draft.profiles.insert(list, points);
            }
        }
        Ok(draft)
    }

    /// The error of a problem, at its place: the key where it is about what stands beside it or is missing, or the
    /// value.
    fn located(&self, error: ProblemError) -> SceneError {
        let ProblemError { kind, path, mut found, expected } = error;
        let (path, point) = path.split_once('[').unwrap_or((&path, ""));
        let span = match self.get(path) {
            None => 0..0,
            Some((key, value)) if matches!(kind, Kind::Missing | Kind::Contradiction) => {
                if kind == Kind::Missing && value.get_ref().as_table().is_some() {
                    found += &format!(" in [{path}]");
                }
                key.span()
            }
            Some((_, value)) => coordinate(value, point).unwrap_or(value).span(),
        };
        self.error(span, kind, found, expected)
    }

    fn top(&self) -> Result<Option<Top>, SceneError> {
        match self.text("rod.top")? {
            None => Ok(None),
            Some(("free", _)) => Ok(Some(Top::Free)),
            Some(("fixed", _)) => Ok(Some(Top::Fixed)),
            Some((text, span)) => {
                let hint = did_you_mean(suggest::top(text).map(|top| format!("\"{top}\"")));
                let (found, expected) = (format!("top = {}", short(self.slice(&span))), "\"free\" or \"fixed\"");
                Err(self.error(span, Kind::OutOfRange, found, format!("{expected}{hint}")))
            }
        }
    }

    pub(super) fn units(&self) -> Result<UnitSystem, SceneError> {
        let Some((text, span)) = self.text("units")? else { return Ok(UnitSystem::default()) };
        UnitSystem::ALL.iter().find(|(name, _)| *name == text).map(|(_, units)| *units).ok_or_else(|| {
            let known = UnitSystem::ALL.map(|(name, _)| format!("\"{name}\"")).join(", ");
            let found = format!("units = {}", short(self.slice(&span)));
            self.error(span, Kind::OutOfRange, found, format!("one of {known}"))
        })
    }

    pub(super) fn accuracy(&self) -> Result<Option<f64>, SceneError> {
        let Some(written) = self.number("run.accuracy")? else { return Ok(None) };
        let given = Given::new("run.accuracy", "accuracy", &written).map_err(|error| self.located(error))?;
        let accuracy = given.number.to_f64();
        if ACCURACIES.contains(&accuracy) {
            return Ok(Some(accuracy));
        }
        let expected = "a relative accuracy between 1e-15 and 0.1";
        Err(self.located(given.error(Kind::OutOfRange, "", expected)))
    }

    fn points(&self, path: &str) -> Result<Option<Points>, SceneError> {
        let Some((key, value)) = self.get(path) else { return Ok(None) };
        let Some(array) = value.get_ref().as_array() else {
            return Err(self.wrong_type(value, key.get_ref(), SHAPE));
        };
        let point = |point: &Value<'a>| match point.get_ref().as_array().map(|array| array.iter().as_slice()) {
            Some([x, v]) => Ok((self.written(x, "x")?, self.written(v, key.get_ref())?)),
            _ => {
                let found = format!("{} among the points of the {}", short(self.slice(&point.span())), key.get_ref());
                Err(self.error(point.span(), Kind::WrongType, found, "a point [x, value]"))
            }
        };
        array.into_iter().map(point).collect::<Result<Vec<_>, _>>().map(Some)
    }

    /// The line of every key.
    pub(super) fn lines(&self) -> Vec<(String, usize)> {
        let line = |key: &Key<'_>| position(self.source, key.span().start).0;
        let mut lines = Vec::new();
        for (name, value) in self.document {
            lines.push((name.get_ref().to_string(), line(name)));
            for key in value.get_ref().as_table().iter().flat_map(|table| table.keys()) {
                lines.push((format!("{}.{}", name.get_ref(), key.get_ref()), line(key)));
            }
        }
        lines
    }
}

/// The coordinate at `3].x` of an array of points.
fn coordinate<'a>(points: &'a Value<'a>, place: &str) -> Option<&'a Value<'a>> {
    let (index, coordinate) = place.split_once("].")?;
    let point = points.get_ref().as_array()?.get(index.parse::<usize>().ok()?)?;
    point.get_ref().as_array()?.get(usize::from(coordinate != "x"))
}

#[cfg(test)]
#[path = "tests/read.rs"]
mod tests;
