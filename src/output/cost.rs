//! What accuracy and effects cost.

use serde_json::json;

use super::dataset::{Column, Dataset};
use crate::routes::cost::{Difference, Row, Table};

/// A time in the unit that suits it, to three digits: `3.21 ms`.
pub(crate) fn duration(seconds: f64) -> String {
    let (unit, name) = match seconds.abs() {
        0.0 => return "0 s".into(),
        s if s < 0.999_5e-6 => (1e-9, "ns"),
        s if s < 0.999_5e-3 => (1e-6, "µs"),
        s if s < 0.999_5 => (1e-3, "ms"),
        _ => (1.0, "s"),
    };
    let value = seconds / unit;
    let places = if value.abs() < 9.995 { 2 } else { usize::from(value.abs() < 99.95) };
    format!("{value:.places$} {name}")
}

/// `3.2e-15`, however small; `0` where there is no error.
fn error(row: &Row) -> String {
    if row.log10_error == f64::NEG_INFINITY {
        return "0".into();
    }
    let mut exponent = row.log10_error.floor();
    let mut mantissa = format!("{:.1}", 10f64.powf(row.log10_error - exponent));
    if mantissa == "10.0" {
        mantissa = "1.0".into();
        exponent += 1.0;
    }
    format!("{mantissa}e{exponent}")
}

/// What is asked: `t_b`, or `h(t) at t = 1.5`.
pub(super) fn asked(table: &Table) -> String {
    match &table.time {
        Some(time) => format!("{} at t = {time}", table.quantity.symbol()),
        None => table.quantity.symbol().into(),
    }
}

/// Every route with what it takes. The plan's choice has an arrow.
pub(crate) fn cost_data(cost: &Table, title: Option<&str>) -> Dataset {
    let row = |row: &Row| {
        let timing = &row.timing;
        let mark = if row.chosen { "← the plan" } else { "" };
        vec![
            (Column::new("route").text(), row.family.name().into()),
            (Column::new("setting").text(), row.setting.clone().into()),
            (Column::table("").text(), mark.into()),
            (Column::table("error").named("error"), error(row).into()),
            (Column::json("error"), row.error().into()),
            (Column::json("log10_error"), row.log10_error.into()),
            (Column::table("time"), duration(timing.seconds).into()),
            (Column::data("seconds"), timing.seconds.into()),
            (Column::table("spread"), timing.spread.map(duration).into()),
            (Column::data("spread_seconds"), timing.spread.into()),
            (Column::new("runs"), timing.runs.into()),
            (Column::data("chosen"), row.chosen.into()),
        ]
    };
    let left_out = cost
        .left_out
        .iter()
        .map(|item| json!({ "route": item.family.name(), "setting": item.setting, "because": item.why }));
    let mut below = "\n\nerror: relative, against ".to_string();
    below += &match cost.truth.log10_half_width {
        width if width == f64::NEG_INFINITY => "the exact fraction".into(),
        width if cost.truth.proved => format!("a value that is proved to 1e{}", width.ceil()),
        width => format!("a value known to about 1e{}", width.ceil()),
    };
    below += "\ntime:  median of the runs, and the distance of their quartiles\n";
    for item in &cost.left_out {
        let setting = item.setting.as_ref().map_or_else(String::new, |setting| format!(", {setting}"));
        below += &format!("not here: {}{setting}: {}\n", item.family.name(), item.why);
    }
    let truth = cost.truth.value.to_f64();
    let above = title.map_or_else(String::new, |title| format!("{title}\n"));
    let unit = if cost.unit.is_empty() { String::new() } else { format!(" {}", cost.unit) };
    Dataset {
        header: vec![
            ("schema", 1.into()),
            ("title", title.into()),
            ("quantity", cost.quantity.name().into()),
            ("unit", cost.unit.into()),
            ("time", cost.time.as_ref().map(crate::Number::to_f64).into()),
            ("truth", truth.into()),
            ("truth_log10_half_width", cost.truth.log10_half_width.into()),
            ("truth_proved", cost.truth.proved.into()),
            ("left_out", left_out.collect()),
        ],
        list: "rows",
        around: [format!("{above}{} = {truth:?}{unit}\n\n", asked(cost)), below],
        ..Dataset::of(cost.rows.iter().map(row))
    }
}

/// What each effect costs.
pub(crate) fn effects_data(rows: &[Difference], title: Option<&str>) -> Dataset {
    let row = |row: &Difference| {
        vec![
            (Column::new("effect").text(), row.name().into()),
            (Column::table("called for").text(), if row.called { "yes" } else { "no" }.into()),
            (Column::data("called"), row.called.into()),
            (Column::table("with"), duration(row.with.seconds).into()),
            (Column::data("with_seconds"), row.with.seconds.into()),
            (Column::table("without"), duration(row.without.seconds).into()),
            (Column::data("without_seconds"), row.without.seconds.into()),
            (Column::table("costs"), duration(row.costs.seconds).into()),
            (Column::data("seconds"), row.costs.seconds.into()),
            (Column::json("spread_seconds"), row.costs.spread.into()),
            (Column::table("noise"), duration(row.noise()).into()),
            (Column::data("noise_seconds"), row.noise().into()),
            (Column::json("runs"), row.with.runs.into()),
            (Column::table(""), if row.is_noise() { "within the noise" } else { "" }.into()),
            (Column::data("noise"), row.is_noise().into()),
        ]
    };
    let below = "\n\nwith:    the scene as planned\n\
        without: the effect switched off, which changes nothing where it is not called for; for the plan itself, \
        the engine called directly\n\
        costs:   median of the differences of neighbouring runs, and what it may be by chance\n";
    Dataset {
        header: vec![("schema", 1.into()), ("title", title.into()), ("quantity", "effects".into())],
        list: "rows",
        around: [title.map_or_else(String::new, |title| format!("{title}\n\n")), below.into()],
        ..Dataset::of(rows.iter().map(row))
    }
}

#[cfg(test)]
#[path = "tests/cost.rs"]
mod tests;
