//! The header of rows and functions: scene, units, signs, what the numbers are worth, and how to cite them.

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Value as Json, json};

use super::column::Column;
use super::run_info::{ExactUntil, RunInfo};
use super::schema_types::BoundSchema;
use crate::answer::note_end;
use dalembert::solve::{ExactnessEnd, History, Numbers};
use dalembert::{Bound, ChainScene, Estimate};
use dalembert_compare::SchemaVersion;

const SIGNS: &str = "x and displacements upwards from the undeformed rod on the ground; strain and stress positive in \
                     tension, force positive in compression";
const CHAIN_SIGNS: &str = "displacements upwards from the undeformed body in its place at the start, velocities upwards; \
                           force positive in compression; bodies are counted from the bottom";
const SIDE: &str = "left is the limit from earlier times, right from later ones; both: they are the same";
const READ: &str = "pandas.read_csv(FILE, comment=\"#\"), or \
    numpy.genfromtxt((s for s in open(FILE) if s[0] != \"#\"), delimiter=\",\", names=True, dtype=None)";
const CITE: &str = concat!(
    "The dalembert developers, dalembert ",
    env!("CARGO_PKG_VERSION"),
    ": exact reference solutions for the bouncing elastic rod; with the scene above"
);

/// The header of a file with rows or a function.
#[derive(Debug)]
pub(crate) struct Header<'a> {
    title: Option<String>,
    /// The number system in words.
    number: String,
    effects: Vec<&'static str>,
    exact_until: Option<ExactnessEnd>,
    warnings: Vec<String>,
    signs: &'static str,
    /// The text of the scene.
    scene: &'a str,
    /// The number of the body, from 1, and the number of bodies of its chain.
    body: Option<[usize; 2]>,
    numbers: Numbers,
    /// The things that have a bound: `each column`.
    subject: &'a str,
    /// The last time of the history.
    until: f64,
    /// The reason why the history ends, if its end is among the rows.
    ends: Option<String>,
}

/// The header as JSON.
#[derive(Debug, JsonSchema, Serialize)]
pub(super) struct HeaderJson<'a> {
    schema: SchemaVersion,
    /// The word reference.
    kind: &'static str,
    /// The version of dalembert.
    dalembert: &'static str,
    title: Option<&'a str>,
    /// The text of the scene, without comments.
    scene: String,
    /// The body of the scene, from 1 at the bottom; absent for a single rod.
    #[serde(skip_serializing_if = "Option::is_none")]
    body: Option<usize>,
    effects: &'a [&'static str],
    /// The last time of the history.
    until: f64,
    numbers: &'a str,
    proved: bool,
    /// The worth of the numbers.
    promise: String,
    signs: &'static str,
    side: &'static str,
    /// The reason why the history ends where it does; null where the times are chosen.
    ends: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    exact_until: Option<ExactUntil>,
    warnings: Vec<String>,
    cite: &'static str,
    columns: Vec<ColumnJson<'a>>,
}

#[derive(Debug, JsonSchema, Serialize)]
struct ColumnJson<'a> {
    name: &'a str,
    symbol: &'a str,
    meaning: &'a str,
    /// The unit, empty where there is none or none is known.
    unit: &'a str,
    /// Bound of the error of every value of the column; absent in fractions, null where it is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<BoundSchema>")]
    bound: Option<Json>,
}

impl<'a> Header<'a> {
    /// Returns the header of an output of `history`; with `states_end` it states why the history ends.
    pub(crate) fn new(history: &History, info: RunInfo, scene: &'a str, subject: &'a str, states_end: bool) -> Self {
        // A double is stated with all its digits.
        let end = history.end().as_double().map_or_else(|| history.end(), |end| Estimate::exact(*end.value()).into());
        let ends = states_end.then(|| note_end(history, &end));
        let body = history.problem().chain().map(|(chain, body)| [body + 1, chain.bodies().len()]);
        let body = body.filter(|[_, count]| *count > 1);
        let warnings = info.warning_texts();
        let RunInfo { title, number, effects, exact_until, .. } = info;
        let (numbers, until) = (history.plan().numbers, end.to_f64());
        Header {
            title,
            number,
            effects,
            exact_until,
            warnings,
            signs: SIGNS,
            scene,
            body,
            numbers,
            subject,
            until,
            ends,
        }
    }

    /// Returns the header of columns of a chain that is followed to the time `until`; `ends` states why it ends, if its
    /// end is among the rows.
    pub(crate) fn of_chain(
        (scene, until): (&'a ChainScene, f64),
        numbers: Numbers,
        warnings: Vec<String>,
        ends: Option<String>,
    ) -> Self {
        let called = scene.effects().into_iter().filter(|effect| effect.called);
        Header {
            title: scene.title.clone(),
            number: numbers.to_string(),
            effects: called.map(|effect| effect.effect).collect(),
            exact_until: None,
            warnings,
            signs: CHAIN_SIGNS,
            scene: scene.source(),
            body: None,
            numbers,
            subject: "each column",
            until,
            ends,
        }
    }
}

impl Header<'_> {
    /// Returns what the numbers are worth, in a sentence.
    fn promise(&self, is_npz: bool) -> String {
        let promise = match self.numbers {
            Numbers::Double(_) => return format!("{} within its bound, carried through the computation", self.subject),
            Numbers::Exact => "fractions without any error".to_string(),
            Numbers::Certified(digits) => {
                format!("{digits} digits, proved by enclosures; fewer where no more are known")
            }
            Numbers::Digits(digits) | Numbers::ExactThenDigits(digits) => {
                format!("{digits} digits, rounded once from values known to more")
            }
        };
        if is_npz { format!("{promise}; here rounded to the nearest double") } else { promise }
    }

    fn scene_lines(&self) -> impl Iterator<Item = &str> {
        self.scene.lines().map(str::trim_end).filter(|line| !line.is_empty() && !line.trim_start().starts_with('#'))
    }

    fn is_proved(&self) -> bool {
        matches!(self.numbers, Numbers::Exact | Numbers::Certified(_))
    }

    /// Returns whether the numbers of a column have a bound: fractions and words have none.
    fn has_bound(&self, column: &Column) -> bool {
        self.numbers != Numbers::Exact && column.has_bound()
    }

    /// Returns the header as JSON, with the bounds of the columns.
    pub(super) fn to_json<'a>(&'a self, columns: &'a [Column], bounds: &[Bound], is_npz: bool) -> HeaderJson<'a> {
        let bound = |bound: &Bound| if bound.to_string() == "unknown" { Json::Null } else { json!(bound) };
        let columns = columns.iter().zip(bounds).map(|(column, greatest)| ColumnJson {
            name: column.csv_name(),
            symbol: &column.symbol,
            meaning: &column.meaning,
            unit: column.unit,
            bound: self.has_bound(column).then(|| bound(greatest)),
        });
        HeaderJson {
            schema: SchemaVersion,
            kind: "reference",
            dalembert: env!("CARGO_PKG_VERSION"),
            title: self.title.as_deref(),
            scene: self.scene_lines().collect::<Vec<_>>().join("\n"),
            body: self.body.map(|[body, _]| body),
            effects: &self.effects,
            until: self.until,
            numbers: &self.number,
            proved: self.is_proved(),
            promise: self.promise(is_npz),
            signs: self.signs,
            side: SIDE,
            ends: self.ends.as_deref(),
            exact_until: self.exact_until.as_ref().map(ExactUntil::from_end),
            warnings: self.warnings.clone(),
            cite: CITE,
            columns: columns.collect(),
        }
    }

    /// Returns the lines above a CSV or a function.
    pub(super) fn lines(&self) -> Vec<String> {
        let proved = if self.is_proved() { "" } else { " (not proved)" };
        let line = |key: &str, value: &str| format!("{key}: {value}");
        let mut lines = vec![format!("dalembert {}: reference", env!("CARGO_PKG_VERSION"))];
        lines.extend(self.title.iter().map(|title| line("title", title)));
        lines.extend(self.scene_lines().map(|scene| line("scene", scene)));
        let body = self.body.map(|[body, count]| {
            format!("{body} of {count}, from the bottom: x, displacements and contacts are its own")
        });
        lines.extend(body.iter().map(|body| line("body", body)));
        lines.push(line("until", &format!("the history is followed to t = {}", self.until)));
        lines.push(line("numbers", &format!("{}: {}{proved}", self.number, self.promise(false))));
        lines.push(line("signs", self.signs));
        lines.extend(self.exact_until.iter().map(|end| line("note", &format!("{end}; all is in digits"))));
        lines.extend(self.ends.clone());
        lines.extend(self.warnings.iter().map(|warning| line("warning", &warning.replace('\n', " "))));
        lines.push(line("cite", CITE));
        lines
    }

    /// Returns the comments above a CSV, with the bounds of the columns.
    pub(super) fn comments(&self, columns: &[Column], bounds: &[Bound]) -> String {
        let mut text: String = self.lines().iter().map(|line| format!("# {line}\n")).collect();
        text += &format!("# read: {READ}\n");
        for (column, bound) in columns.iter().zip(bounds) {
            let (name, meaning) = (column.csv_name(), &column.meaning);
            let within = if self.has_bound(column) { format!("; within {bound}") } else { String::new() };
            let symbol = if column.symbol.is_empty() { String::new() } else { format!("{}: ", column.symbol) };
            let unit = if column.unit.is_empty() { String::new() } else { format!(" [{}]", column.unit) };
            text += &format!("# column {name}: {symbol}{meaning}{unit}{within}\n");
        }
        text
    }
}
