//! Published values beside ours.

use serde_json::{Value, json};

use super::record::Head;
use super::table::{cell, fitted};
use crate::aligned::table;
use crate::number::{DOUBLE_DIGITS, Scalar, number_json, show};
use crate::routes::{Published, Reached};
use crate::scene::Target;

/// Significant digits of a difference in a table.
const DIFFERENCE_DIGITS: u32 = 3;

/// The table, and below it where each value was published.
pub(crate) fn targets_table<S: Scalar>(reached: &[Reached<S>], head: &Head) -> String {
    let mut out = head.title.as_ref().map_or_else(String::new, |title| format!("{title}\n\n"));
    if reached.is_empty() {
        return out + "the scene lists no published value: it has no [[target]]\n";
    }
    let mut sources: Vec<&str> = Vec::new();
    let rows = reached.iter().map(|reached| {
        let target = &reached.target;
        let place = sources.iter().position(|source| *source == target.source).unwrap_or_else(|| {
            sources.push(&target.source);
            sources.len() - 1
        });
        let unit = target.quantity.unit(&head.units);
        vec![
            target.label(),
            unit.to_string(),
            target.time.as_ref().map_or_else(|| "–".into(), ToString::to_string),
            target.published.to_string(),
            cell(&reached.ours, head),
            show(&reached.difference(), DIFFERENCE_DIGITS),
            format!("({})", place + 1),
        ]
    });
    let header = ["quantity", "unit", "t", "published", "ours", "difference", ""];
    out += &(fitted(&header, &rows.collect::<Vec<_>>(), 2, 1, head.wide) + "\n\n");
    for (k, source) in sources.iter().enumerate() {
        out += &format!("({}) {source}\n", k + 1);
    }
    out
}

/// A list of objects with `quantity`, `time`, `published`, `ours`, `difference`, `source`.
pub(crate) fn targets_json<S: Scalar>(reached: &[Reached<S>], head: &Head) -> Value {
    let number = |x: &S| number_json(x, head.digits);
    let row = |reached: &Reached<S>| {
        let time = reached.target.time.as_ref().map(|time| S::from_number(time, &reached.ours.precision()));
        json!({
            "quantity": reached.target.label(),
            "time": time.as_ref().map(number),
            "published": number(&reached.published),
            "ours": number(&reached.ours),
            "difference": number(&reached.difference()),
            "source": reached.target.source,
        })
    };
    reached.iter().map(row).collect()
}

/// The same as rows.
pub(crate) fn targets_csv<S: Scalar>(reached: &[Reached<S>], head: &Head) -> Result<String, csv::Error> {
    let digits = if head.digits == 0 { DOUBLE_DIGITS } else { head.digits };
    let header = ["quantity", "unit", "time", "published", "ours", "difference", "source"];
    let row = |reached: &Reached<S>| {
        let target = &reached.target;
        vec![
            target.label(),
            target.quantity.unit(&head.units).into(),
            target.time.as_ref().map_or_else(String::new, ToString::to_string),
            target.published.to_string(),
            show(&reached.ours, digits),
            show(&reached.difference(), digits),
            target.source.clone(),
        ]
    };
    super::csv::write("", header, reached.iter().map(row))
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
         and whether ours rounds to it (or is within what the scene says it may be off). \
         `dalembert scenes NAME --targets` shows both.\n\n\
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
        let rows: Vec<Value> = targets_json(reached, &Head::default()).as_array().cloned().unwrap_or_default();
        let agrees = rows.into_iter().zip(reached).map(|(mut row, reached)| {
            row["agrees"] = reached.agrees().into();
            row
        });
        json!({ "scene": scene, "values": agrees.collect::<Vec<_>>() })
    };
    published.iter().map(scene).collect()
}
