//! Published values beside those of this library.

use serde_json::{Value as Json, json};

use super::column::Column;
use super::dataset::{Cell, Dataset};
use dalembert::number::{Estimate, Scalar, show};
use dalembert_verify::published::{ComparedValue, PublishedScene};

use super::citation::plain_text;

/// Significant digits of a difference in a table.
const DIFFERENCE_DIGITS: u32 = 3;

/// Returns a row for each value. Below a table stand the source of each value, and how many agree.
pub(crate) fn targets_data(all: &[PublishedScene], wide: bool) -> Dataset {
    let several = all.len() > 1;
    let mut sources: Vec<&str> = Vec::new();
    let mut rows = Vec::new();
    for (published, reached) in
        all.iter().flat_map(|published| published.values.iter().map(move |value| (published, value)))
    {
        let (theirs, unit) = (&reached.published, reached.unit);
        let place = sources.iter().position(|source| *source == theirs.source).unwrap_or_else(|| {
            sources.push(&theirs.source);
            sources.len() - 1
        });
        let time = reached.time.as_ref().map(|time| Estimate::<f64>::from_number(time, &()));
        let (label, spelled) = (reached.label.clone(), reached.time.as_ref().map(ToString::to_string));
        let mut row: Vec<Cell> = if several { vec![published.name.clone().into()] } else { Vec::new() };
        row.extend([
            if unit.is_empty() { label.clone() } else { format!("{label}, {unit}") }.into(),
            label.into(),
            unit.into(),
            spelled.into(),
            Cell::number(time),
            theirs.value.to_string().into(),
            Cell::number(Some(reached.theirs())),
            Cell::Number(reached.ours.clone()),
            show(&reached.difference(), DIFFERENCE_DIGITS).into(),
            Cell::number(Some(reached.difference())),
            theirs.tolerance().into(),
            format!("{} to {} ({})", verdict(reached), tolerance(theirs.tolerance()), place + 1).into(),
            reached.agrees().into(),
            if theirs.differs { "differs" } else { "agrees" }.into(),
            theirs.source.clone().into(),
            theirs.note.clone().into(),
        ]);
        rows.push(row);
    }
    let listed: String = sources.iter().enumerate().map(|(k, source)| format!("({}) {source}\n", k + 1)).collect();
    let title = all.first().filter(|_| !several).and_then(|published| published.title.as_ref());
    let values = || all.iter().flat_map(|published| &published.values);
    let (count, agreed) = (values().count(), values().filter(|value| value.agrees()).count());
    let known = values().filter(|value| !value.agrees() && value.is_expected()).count();
    let known = if known > 0 { format!(", {known} of them as the scene expects") } else { String::new() };
    let below = match count {
        0 => "the scene lists no published value: it has no [[target]]\n".into(),
        _ => format!("\n\n{listed}\n{count} published values: {agreed} agree, {} differ{known}\n", count - agreed),
    };
    let above = title.map_or_else(String::new, |title| format!("{title}\n\n"));
    let keys = (!wide && !several).then_some(1);
    Dataset { columns: columns(several), rows, around: [above, below], keys, ..Dataset::default() }
}

/// Returns the columns of published values, of one scene or of several.
fn columns(several: bool) -> Vec<Column> {
    let mut columns = if several { vec![Column::new("scene").text()] } else { Vec::new() };
    columns.extend([
        Column::table("quantity").text(),
        Column::data("quantity").text(),
        Column::csv("unit").text(),
        Column::table("t").named("t"),
        Column::json("t"),
        Column::table("published").named("published"),
        Column::json("published"),
        Column::new("ours"),
        Column::table("difference"),
        Column::data("difference"),
        Column::data("within"),
        Column::table("agrees").text(),
        Column::data("agrees"),
        Column::data("expected"),
        Column::data("source"),
        Column::data("note"),
    ]);
    columns
}

/// Returns a tolerance in words: `5e-5`, or `all digits` for none.
fn tolerance(tolerance: f64) -> String {
    if tolerance == 0.0 { "all digits".into() } else { format!("{tolerance:e}") }
}

/// Returns the word for whether a value agrees: `yes`, `no` where that is known, or `NO`.
fn verdict(value: &ComparedValue) -> &'static str {
    match (value.agrees(), value.is_expected()) {
        (true, true) => "yes",
        (true, false) => "YES",
        (false, true) => "no",
        (false, false) => "NO",
    }
}

/// Most characters of a fraction in a table; a longer one is printed in digits.
const FRACTION: usize = 20;
/// Digits of numbers that are not fractions.
pub(crate) const PAGE_DIGITS: u32 = 15;

/// Returns the published values of the scenes as a page: a row for each scene, and a section for each with its values.
pub(crate) fn benchmarks_page(all: &[PublishedScene]) -> String {
    let (count, _) = PublishedScene::count(all);
    let differ = all.iter().flat_map(|scene| &scene.values).filter(|value| !value.agrees()).count();
    let mut out = format!(
        "# Published tests beside the exact answer\n\n\
         {} tests with {count} published numbers, of which {differ} differ from the exact answer by more than half a unit \
         of their last digit, or than what their source allows. A number is exact where it is a fraction; otherwise its \
         {PAGE_DIGITS} digits are right. `dalembert scenes --targets --format markdown` writes this page, and the tests of \
         the project hold it against the scenes.\n\n\
         Parameters are those that the source gives. What is inferred from other numbers of the source is said to be so \
         in the section of the test.\n\n\
         | test | agree | verdict |\n|---|---|---|\n",
        all.len()
    );
    for scene in all {
        let agree = scene.values.iter().filter(|value| value.agrees()).count();
        let verdict = scene.publication.as_ref().and_then(|publication| publication.verdict.as_deref());
        let title = scene.title.as_deref().unwrap_or(&scene.name);
        let (name, of) = (&scene.name, scene.values.len());
        out += &format!("| [{title}](#{name}) | {agree} of {of} | {} |\n", verdict.unwrap_or_default());
    }
    for scene in all {
        let title = scene.title.as_deref().unwrap_or(&scene.name);
        out += &format!("\n<a id=\"{}\"></a>\n\n## {title}\n\n", scene.name);
        if let Some(publication) = &scene.publication {
            out += &format!("*Source*: {}\n\n", escaped(&plain_text(publication)));
        }
        for paragraph in &scene.comment {
            out += &format!("{}\n\n", escaped(paragraph));
        }
        out += &format!("```sh\ndalembert scenes {} --targets\n```\n\n", scene.name);
        out += "| quantity | t | published | exact | exact − published | agrees | source |\n|---|---|---|---|---|---|---|\n";
        for value in &scene.values {
            out += &page_row(value);
        }
    }
    out
}

fn page_row(value: &ComparedValue) -> String {
    let ComparedValue { label, unit, time, published, ours } = value;
    let unit = if unit.is_empty() { String::new() } else { format!(", {unit}") };
    let time = time.as_ref().map_or_else(|| "–".into(), ToString::to_string);
    let exact = ours.to_string();
    let exact = if exact.chars().count() > FRACTION { ours.to_digits(PAGE_DIGITS) } else { exact };
    let difference = value.difference();
    let difference = match difference.value().abs() <= difference.bound() {
        true => "0".into(),
        false => show(&difference, DIFFERENCE_DIGITS),
    };
    let agrees = if value.agrees() { "yes" } else { "no" };
    let note = published.note.as_ref().map_or_else(String::new, |note| format!(". {note}"));
    let source = escaped(&(published.source.clone() + &note));
    format!("| {label}{unit} | {time} | {} | {exact} | {difference} | {agrees} | {source} |\n", published.value)
}

/// Escapes what Markdown would take for emphasis or a column.
fn escaped(text: &str) -> String {
    text.replace('|', "\\|").replace('*', "\\*").replace('_', "\\_")
}

pub(crate) fn published_json(published: &[PublishedScene]) -> Json {
    let scene = |published: &PublishedScene| {
        let values = targets_data(std::slice::from_ref(published), false).objects();
        json!({ "scene": published.name, "values": values })
    };
    published.iter().map(scene).collect::<Vec<_>>().into()
}
