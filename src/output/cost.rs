//! What accuracy and effects cost, as tables, JSON and CSV.

use serde_json::{Value, json};

use super::csv;
use crate::aligned::table;
use crate::routes::cost::{Difference, Row, Table, Timing};

/// A time in the unit that suits it, to three digits: `3.21 ms`.
///
/// ```
/// assert_eq!(dalembert::output::duration(3.2149e-3), "3.21 ms");
/// assert_eq!(dalembert::output::duration(0.0), "0 s");
/// ```
pub fn duration(seconds: f64) -> String {
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

fn spread(timing: &Timing) -> String {
    timing.spread.map_or_else(|| "–".into(), duration)
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

/// The table for a person. The plan's choice has an arrow.
pub(crate) fn cost_table(cost: &Table, title: Option<&str>) -> String {
    let mut out = title.map_or_else(String::new, |title| format!("{title}\n"));
    out += &format!("{} = {:?}\n\n", asked(cost), cost.truth.value.to_f64());
    let rows = cost.rows.iter().map(|row| {
        vec![
            row.family.name().into(),
            row.setting.clone(),
            if row.chosen { "← the plan".into() } else { String::new() },
            error(row),
            duration(row.timing.seconds),
            spread(&row.timing),
            row.timing.runs.to_string(),
        ]
    });
    let header = ["route", "setting", "", "error", "time", "spread", "runs"];
    out += &table(&header, rows.collect(), 3);
    out += "\n\nerror: relative, against ";
    out += &match cost.truth.log10_half_width {
        width if width == f64::NEG_INFINITY => "the exact fraction".into(),
        width if cost.truth.proved => format!("a value that is proved to 1e{}", width.ceil()),
        width => format!("a value known to about 1e{}", width.ceil()),
    };
    out += "\ntime:  median of the runs, and the distance of their quartiles\n";
    for item in &cost.left_out {
        let setting = item.setting.as_ref().map_or_else(String::new, |setting| format!(", {setting}"));
        out += &format!("not here: {}{setting}: {}\n", item.family.name(), item.why);
    }
    out
}

/// Schema 1.
pub(crate) fn cost_json(cost: &Table, title: Option<&str>) -> Value {
    let finite = |x: f64| if x.is_finite() { json!(x) } else { Value::Null };
    let rows = cost.rows.iter().map(|row| {
        json!({
            "route": row.family.name(),
            "setting": row.setting,
            "error": row.error(),
            "log10_error": finite(row.log10_error),
            "seconds": row.timing.seconds,
            "spread_seconds": row.timing.spread,
            "runs": row.timing.runs,
            "chosen": row.chosen,
        })
    });
    let left_out = cost
        .left_out
        .iter()
        .map(|item| json!({ "route": item.family.name(), "setting": item.setting, "because": item.why }));
    json!({
        "schema": 1,
        "title": title,
        "quantity": cost.quantity.name(),
        "time": cost.time.as_ref().map(crate::Number::to_f64),
        "truth": cost.truth.value.to_f64(),
        "truth_log10_half_width": finite(cost.truth.log10_half_width),
        "truth_proved": cost.truth.proved,
        "rows": rows.collect::<Vec<_>>(),
        "left_out": left_out.collect::<Vec<_>>(),
    })
}

/// The rows.
pub(crate) fn cost_csv(cost: &Table) -> Result<String, ::csv::Error> {
    let rows = cost.rows.iter().map(|row| {
        let spread = row.timing.spread.map_or_else(String::new, |spread| spread.to_string());
        vec![
            row.family.name().into(),
            row.setting.clone(),
            error(row),
            row.timing.seconds.to_string(),
            spread,
            row.timing.runs.to_string(),
            row.chosen.to_string(),
        ]
    });
    let header = ["route", "setting", "error", "seconds", "spread_seconds", "runs", "chosen"];
    csv::write("", header, rows)
}

/// What each effect costs, for a person.
pub(crate) fn effects_table(rows: &[Difference], title: Option<&str>) -> String {
    let mut out = title.map_or_else(String::new, |title| format!("{title}\n\n"));
    let rows = rows.iter().map(|row| {
        vec![
            row.name().into(),
            if row.called { "yes" } else { "no" }.into(),
            duration(row.with.seconds),
            duration(row.without.seconds),
            duration(row.seconds),
            duration(row.noise()),
            if row.is_noise() { "within the noise" } else { "" }.into(),
        ]
    });
    let header = ["effect", "called for", "with", "without", "costs", "noise", ""];
    out += &table(&header, rows.collect(), 2);
    out + "\n\nwith:    the scene as planned\n\
           without: the effect switched off, which changes nothing where it is not called for; for the plan itself, \
           the engine called directly\n\
           costs:   median of the differences of neighbouring runs, and what it may be by chance\n"
}

/// What each effect costs, schema 1.
pub(crate) fn effects_json(rows: &[Difference], title: Option<&str>) -> Value {
    let rows = rows.iter().map(|row| {
        json!({
            "effect": row.name(),
            "called": row.called,
            "with_seconds": row.with.seconds,
            "without_seconds": row.without.seconds,
            "seconds": row.seconds,
            "spread_seconds": row.spread,
            "noise_seconds": row.noise(),
            "runs": row.with.runs,
            "noise": row.is_noise(),
        })
    });
    json!({ "schema": 1, "title": title, "quantity": "effects", "rows": rows.collect::<Vec<_>>() })
}

/// What each effect costs, as rows.
pub(crate) fn effects_csv(rows: &[Difference]) -> Result<String, ::csv::Error> {
    let header = ["effect", "called", "with_seconds", "without_seconds", "seconds", "noise_seconds", "noise"];
    let rows = rows.iter().map(|row| {
        let number = |x: f64| x.to_string();
        let (with, without) = (number(row.with.seconds), number(row.without.seconds));
        let (called, noise) = (row.called.to_string(), row.is_noise().to_string());
        vec![row.name().into(), called, with, without, number(row.seconds), number(row.noise()), noise]
    });
    csv::write("", header, rows)
}
