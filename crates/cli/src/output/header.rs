//! The header of rows and functions: scene, units, signs, what the numbers are worth, and how to cite them.

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Value as Json, json};

use super::column::Column;
use super::run_info::{ExactUntil, RunInfo};
use super::schema_types::BoundSchema;
use crate::answer::note_end;
use dalembert::solve::{History, Numbers};
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

/// The header of a file with rows or a function, as JSON has it.
#[derive(Clone, Debug, Default, JsonSchema, Serialize)]
pub(crate) struct Header {
    schema: SchemaVersion,
    /// The word reference.
    kind: &'static str,
    /// The version of dalembert.
    dalembert: &'static str,
    title: Option<String>,
    /// The text of the scene, without comments.
    scene: String,
    /// The body of the scene, from 1 at the bottom; absent for a single rod.
    #[serde(skip_serializing_if = "Option::is_none")]
    body: Option<usize>,
    effects: Vec<&'static str>,
    /// The last time of the history.
    until: f64,
    numbers: String,
    proved: bool,
    /// The worth of the numbers.
    promise: String,
    signs: &'static str,
    side: &'static str,
    /// The reason why the history ends where it does; null where the times are chosen.
    ends: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    exact_until: Option<ExactUntil>,
    warnings: Vec<String>,
    cite: &'static str,
    columns: Vec<ColumnJson>,
    /// The number of bodies of the chain.
    #[serde(skip)]
    bodies: usize,
    /// The end of exactness in words.
    #[serde(skip)]
    exactness_end: Option<String>,
    /// Whether the numbers are fractions, which have no bounds.
    #[serde(skip)]
    is_exact: bool,
    /// Whether the numbers are rounded to doubles in NPZ.
    #[serde(skip)]
    is_longer: bool,
}

#[derive(Clone, Debug, JsonSchema, Serialize)]
struct ColumnJson {
    name: String,
    symbol: String,
    meaning: String,
    /// The unit, empty where there is none or none is known.
    unit: &'static str,
    /// Bound of the error of every value of the column; absent in fractions, null where it is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<BoundSchema>")]
    bound: Option<Json>,
}

/// Returns the worth of the numbers of `subject`, the things that have a bound, in a sentence.
fn promise(numbers: Numbers, subject: &str) -> String {
    match numbers {
        Numbers::Double(_) => format!("{subject} within its bound, carried through the computation"),
        Numbers::Exact => "fractions without any error".to_string(),
        Numbers::Certified(digits) => format!("{digits} digits, proved by enclosures; fewer where no more are known"),
        Numbers::Digits(digits) | Numbers::ExactThenDigits(digits) => {
            format!("{digits} digits, rounded once from values known to more")
        }
    }
}

impl Header {
    /// Returns the header of an output of `history`, in which `subject` has a bound: `each column`; with `states_end`
    /// it states why the history ends.
    pub(crate) fn new(history: &History, info: RunInfo, scene: &str, subject: &str, states_end: bool) -> Self {
        // A double is stated with all its digits.
        let end = history.end().as_double().map_or_else(|| history.end(), |end| Estimate::exact(*end.value()).into());
        let body = history.problem().chain().map(|(chain, body)| (body + 1, chain.bodies().len()));
        let (body, bodies) = body.filter(|(_, count)| *count > 1).unzip();
        Header {
            warnings: info.warning_texts(),
            title: info.title,
            body,
            effects: info.effects,
            until: end.to_f64(),
            numbers: info.number,
            signs: SIGNS,
            ends: states_end.then(|| note_end(history, &end)),
            exact_until: info.exact_until.as_ref().map(ExactUntil::from_end),
            bodies: bodies.unwrap_or(1),
            exactness_end: info.exact_until.map(|end| end.to_string()),
            ..Header::of(scene, history.plan().numbers, subject)
        }
    }

    /// Returns the header of columns of a chain that is followed to the time `until`; `ends` states why it ends, if its
    /// end is among the rows.
    pub(crate) fn of_chain(
        (scene, until): (&ChainScene, f64),
        numbers: Numbers,
        warnings: Vec<String>,
        ends: Option<String>,
    ) -> Self {
        let called = scene.effects().into_iter().filter(|effect| effect.called);
        Header {
            title: scene.title.clone(),
            effects: called.map(|effect| effect.effect).collect(),
            until,
            numbers: numbers.to_string(),
            signs: CHAIN_SIGNS,
            ends,
            warnings,
            ..Header::of(scene.source(), numbers, "each column")
        }
    }

    fn of(scene: &str, numbers: Numbers, subject: &str) -> Self {
        let lines = scene.lines().map(str::trim_end);
        let lines = lines.filter(|line| !line.is_empty() && !line.trim_start().starts_with('#'));
        Header {
            kind: "reference",
            dalembert: env!("CARGO_PKG_VERSION"),
            scene: lines.collect::<Vec<_>>().join("\n"),
            proved: matches!(numbers, Numbers::Exact | Numbers::Certified(_)),
            promise: promise(numbers, subject),
            side: SIDE,
            cite: CITE,
            is_exact: numbers == Numbers::Exact,
            is_longer: !matches!(numbers, Numbers::Double(_)),
            ..Header::default()
        }
    }

    /// Returns whether the numbers of a column have a bound: fractions and words have none.
    fn has_bound(&self, column: &Column) -> bool {
        !self.is_exact && column.has_bound()
    }

    /// Returns the header with the columns and their bounds, for JSON or NPZ.
    pub(super) fn with_columns(&self, columns: &[Column], bounds: &[Bound], is_npz: bool) -> Header {
        let bound = |bound: &Bound| if bound.to_string() == "unknown" { Json::Null } else { json!(bound) };
        let columns = columns.iter().zip(bounds).map(|(column, greatest)| ColumnJson {
            name: column.csv_name().into(),
            symbol: column.symbol.to_string(),
            meaning: column.meaning.to_string(),
            unit: column.unit,
            bound: self.has_bound(column).then(|| bound(greatest)),
        });
        let rounded = if is_npz && self.is_longer { "; here rounded to the nearest double" } else { "" };
        Header { promise: format!("{}{rounded}", self.promise), columns: columns.collect(), ..self.clone() }
    }

    /// Returns the lines above a CSV or a function.
    pub(super) fn lines(&self) -> Vec<String> {
        let proved = if self.proved { "" } else { " (not proved)" };
        let line = |key: &str, value: &str| format!("{key}: {value}");
        let mut lines = vec![format!("dalembert {}: {}", self.dalembert, self.kind)];
        lines.extend(self.title.iter().map(|title| line("title", title)));
        lines.extend(self.scene.lines().map(|scene| line("scene", scene)));
        let body = self.body.map(|body| {
            format!("{body} of {}, from the bottom: x, displacements and contacts are its own", self.bodies)
        });
        lines.extend(body.iter().map(|body| line("body", body)));
        lines.push(line("until", &format!("the history is followed to t = {}", self.until)));
        lines.push(line("numbers", &format!("{}: {}{proved}", self.numbers, self.promise)));
        lines.push(line("signs", self.signs));
        lines.extend(self.exactness_end.iter().map(|end| line("note", &format!("{end}; all is in digits"))));
        lines.extend(self.ends.clone());
        lines.extend(self.warnings.iter().map(|warning| line("warning", &warning.replace('\n', " "))));
        lines.push(line("cite", self.cite));
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
