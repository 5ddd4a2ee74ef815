//! Published values beside those of this library.

use serde_json::{Value as Json, json};

use super::column::Column;
use super::dataset::{Cell, Dataset};
use dalembert::Target;
use dalembert::number::{Estimate, Scalar, show};
use dalembert_verify::published::PublishedScene;

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
        let (target, unit) = (&reached.target, reached.target.quantity.unit(&published.units));
        let place = sources.iter().position(|source| *source == target.source).unwrap_or_else(|| {
            sources.push(&target.source);
            sources.len() - 1
        });
        let time = target.time.as_ref().map(|time| Estimate::<f64>::from_number(time, &()));
        let (label, spelled) = (target.label(), target.time.as_ref().map(ToString::to_string));
        let mut row: Vec<Cell> = if several { vec![published.name.clone().into()] } else { Vec::new() };
        row.extend([
            if unit.is_empty() { label.clone() } else { format!("{label}, {unit}") }.into(),
            label.into(),
            unit.into(),
            spelled.into(),
            Cell::number(time),
            target.published.to_string().into(),
            Cell::number(Some(reached.published.clone())),
            Cell::number(Some(reached.ours.clone())),
            show(&reached.difference(), DIFFERENCE_DIGITS).into(),
            Cell::number(Some(reached.difference())),
            target.tolerance().into(),
            format!("{} ({})", if reached.agrees() { "yes" } else { "NO" }, place + 1).into(),
            reached.agrees().into(),
            target.source.clone().into(),
        ]);
        rows.push(row);
    }
    let listed: String = sources.iter().enumerate().map(|(k, source)| format!("({}) {source}\n", k + 1)).collect();
    let title = all.first().filter(|_| !several).and_then(|published| published.title.as_ref());
    let (count, agreed) = PublishedScene::count(all);
    let below = match count {
        0 => "the scene lists no published value: it has no [[target]]\n".into(),
        _ => format!("\n\n{listed}\n{count} published values: {agreed} agree, {} differ\n", count - agreed),
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
        Column::data("source"),
    ]);
    columns
}

/// Returns the published values as a section of a page.
pub(crate) fn published_page(published: &[PublishedScene]) -> String {
    let mut out = String::from(
        "## Published values of other programs\n\nEach value that a built-in scene lists as published, \
         and whether ours rounds to it (or is within what the scene says it may be off).\n\n\
         | scene | quantity | t | published | | source |\n|---|---|---|---|---|---|\n",
    );
    for PublishedScene { name: scene, values, .. } in published {
        for reached in values {
            let Target { time, published, source, .. } = &reached.target;
            let time = time.as_ref().map_or_else(|| "–".into(), ToString::to_string);
            let verdict = if reached.agrees() { "agrees" } else { "DIFFERS" };
            let label = reached.target.label();
            out += &format!("| `{scene}` | {label} | {time} | {published} | {verdict} | {source} |\n");
        }
    }
    out
}

pub(crate) fn published_json(published: &[PublishedScene]) -> Json {
    let scene = |published: &PublishedScene| {
        let values = targets_data(std::slice::from_ref(published), false).objects();
        json!({ "scene": published.name, "values": values })
    };
    published.iter().map(scene).collect::<Vec<_>>().into()
}
