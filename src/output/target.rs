//! Published values beside ours.

use serde_json::{Value, json};

use super::dataset::{Cell, Column, Dataset};
use super::record::Head;
use crate::aligned::table;
use crate::number::{Scalar, show};
use crate::routes::{Published, Reached};
use crate::scene::Target;

/// Significant digits of a difference in a table.
const DIFFERENCE_DIGITS: u32 = 3;

/// A row for each; a table has below it where each value was published.
pub(crate) fn targets_data<S: Scalar>(reached: &[Reached<S>], head: &Head) -> Dataset {
    let mut sources: Vec<&str> = Vec::new();
    let rows = reached.iter().map(|reached| {
        let target = &reached.target;
        let place = sources.iter().position(|source| *source == target.source).unwrap_or_else(|| {
            sources.push(&target.source);
            sources.len() - 1
        });
        let time = target.time.as_ref().map(|time| S::from_number(time, &reached.ours.precision()));
        vec![
            target.label().into(),
            target.quantity.unit(&head.units).into(),
            target.time.as_ref().map(ToString::to_string).into(),
            Cell::optional(time.as_ref()),
            target.published.to_string().into(),
            Cell::number(&reached.published),
            Cell::number(&reached.ours),
            show(&reached.difference(), DIFFERENCE_DIGITS).into(),
            Cell::number(&reached.difference()),
            target.source.clone().into(),
            format!("({})", place + 1).into(),
        ]
    });
    let rows = rows.collect();
    let below: String = sources.iter().enumerate().map(|(k, source)| format!("({}) {source}\n", k + 1)).collect();
    let above = head.title.as_ref().map_or_else(String::new, |title| format!("{title}\n\n"));
    let below = match reached {
        [] => "the scene lists no published value: it has no [[target]]\n".into(),
        _ => format!("\n\n{below}"),
    };
    let keys = (!head.wide).then_some(1);
    Dataset { columns: target_columns(), rows, around: [above, below], digits: head.digits, keys, ..Dataset::default() }
}

fn target_columns() -> Vec<Column> {
    vec![
        Column::new("quantity").text(),
        Column::table("unit").named("unit").text(),
        Column::table("t").named("time"),
        Column::json("time"),
        Column::table("published").named("published"),
        Column::json("published"),
        Column::new("ours"),
        Column::table("difference"),
        Column::data("difference"),
        Column::data("source"),
        Column::table(""),
    ]
}

/// The published values of the built-in scenes: a line each.
pub(crate) fn published_table(published: &[Published]) -> String {
    let rows = published.iter().flat_map(|published| {
        published.reached.iter().map(|reached| {
            let target = &reached.target;
            let difference = show(&reached.difference(), DIFFERENCE_DIGITS);
            let verdict = if reached.agrees() { "agrees" } else { "DIFFERS" };
            vec![published.scene.into(), target.label(), verdict.into(), target.published.to_string(), difference]
        })
    });
    let header = ["published for", "quantity", "", "published", "ours less that"];
    table(&header, rows.collect(), 3)
}

/// The same for the repository's page.
pub(crate) fn published_page(published: &[Published]) -> String {
    let mut out = String::from(
        "## Published values of other programs\n\nEach value that a built-in scene lists as published, \
         and whether ours rounds to it (or is within what the scene says it may be off).\n\n\
         | scene | quantity | t | published | | source |\n|---|---|---|---|---|---|\n",
    );
    for Published { scene, reached } in published {
        for reached in reached {
            let Target { time, published, source, .. } = &reached.target;
            let time = time.as_ref().map_or_else(|| "–".into(), ToString::to_string);
            let verdict = if reached.agrees() { "agrees" } else { "DIFFERS" };
            let label = reached.target.label();
            out += &format!("| `{scene}` | {label} | {time} | {published} | {verdict} | {source} |\n");
        }
    }
    out
}

/// The same as JSON.
pub(crate) fn published_json(published: &[Published]) -> Value {
    let scene = |Published { scene, reached }: &Published| {
        let agrees =
            targets_data(reached, &Head::default()).objects().into_iter().zip(reached).map(|(mut row, reached)| {
                row["agrees"] = reached.agrees().into();
                row
            });
        json!({ "scene": scene, "values": agrees.collect::<Vec<_>>() })
    };
    published.iter().map(scene).collect()
}
