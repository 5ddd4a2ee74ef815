//! The time that accuracy and effects take: rows, and the work–precision diagram.

use glam::DVec2;
use serde_json::json;

use super::column::Column;
use super::dataset::Dataset;
use dalembert::number::Number;
use dalembert_plot::draw::{Axis, Key, Mark, Panel, Sheet, Size, Stroke, power_of_ten, without_subscripts};
use dalembert_verify::cost::{CostRow, CostTable, EffectCost, Family};

/// Returns a time to three digits in the unit that suits it: `3.21 ms`.
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

/// Returns the relative error of a row, however small: `3.2e-15`; `0` without an error, `unknown` without a bound.
fn error(row: &CostRow) -> String {
    if row.log10_error == f64::NEG_INFINITY {
        return "0".into();
    }
    if !row.log10_error.is_finite() {
        return "unknown".into();
    }
    let mut exponent = row.log10_error.floor();
    let mut mantissa = format!("{:.1}", 10f64.powf(row.log10_error - exponent));
    if mantissa == "10.0" {
        mantissa = "1.0".into();
        exponent += 1.0;
    }
    format!("{mantissa}e{exponent}")
}

/// Returns the quantity and its time: `t_b`, or `h(t) at t = 1.5`.
fn quantity_text(table: &CostTable) -> String {
    match &table.time {
        Some(time) => format!("{} at t = {time}", table.symbol),
        None => table.symbol.clone(),
    }
}

/// Returns a row for each route, with its error and its time. An arrow marks the choice of the plan.
pub(crate) fn cost_data(cost: &CostTable, title: Option<&str>) -> Dataset {
    let row = |row: &CostRow| {
        let timing = &row.timing;
        let mark = if row.chosen { "← the plan" } else { "" };
        vec![
            (Column::new("route").text(), row.family.to_string().into()),
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
    let left_out = cost.left_out.iter().map(
        |item| json!({ "route": item.family.to_string(), "setting": item.setting, "because": item.why.to_string() }),
    );
    // The error of a truth of zero is that of the number itself.
    let scale = if cost.truth.to_f64() == 0.0 { "absolute" } else { "relative" };
    let mut below = format!("\n\nerror: {scale}, against ");
    below += &match cost.truth.log10_half_width {
        width if width == f64::NEG_INFINITY => "the exact number".into(),
        width if cost.truth.proved => format!("a value that is proved to 1e{}", width.ceil()),
        width => format!("a value known to about 1e{}", width.ceil()),
    };
    below += "\ntime:  median of the runs, and the distance of their quartiles\n";
    for item in &cost.left_out {
        let setting = item.setting.as_ref().map_or_else(String::new, |setting| format!(", {setting}"));
        below += &format!("not here: {}{setting}: {}\n", item.family, item.why);
    }
    let truth = cost.truth.to_f64();
    let above = title.map_or_else(String::new, |title| format!("{title}\n"));
    let unit = if cost.unit.is_empty() { String::new() } else { format!(" {}", cost.unit) };
    Dataset {
        header: json!({
            "schema": 1,
            "title": title,
            "quantity": cost.quantity,
            "unit": cost.unit,
            "time": cost.time.as_ref().map(Number::to_f64),
            "truth": truth,
            "truth_log10_half_width": cost.truth.log10_half_width,
            "truth_proved": cost.truth.proved,
            "left_out": left_out.collect::<Vec<_>>(),
        }),
        list: "rows",
        around: [format!("{above}{} = {truth:?}{unit}\n\n", quantity_text(cost)), below],
        ..Dataset::from_rows(cost.rows.iter().map(row))
    }
}

/// Returns a row for each effect of a scene, with the time that it costs.
pub(crate) fn effects_data(rows: &[EffectCost], title: Option<&str>) -> Dataset {
    let row = |row: &EffectCost| {
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
        header: json!({"schema": 1, "title": title, "quantity": "effects"}),
        list: "rows",
        around: [title.map_or_else(String::new, |title| format!("{title}\n\n")), below.into()],
        ..Dataset::from_rows(rows.iter().map(row))
    }
}

/// Number of digits from which on the scale of errors is compressed: beyond it equal lengths are equal factors.
const DOUBLES_END: f64 = 18.0;
/// Digits at the ticks of the compressed scale, equally far apart.
const COMPRESSED_TICKS: [f64; 8] = [DOUBLES_END, 50.0, 100.0, 300.0, 1000.0, 3000.0, 10_000.0, 30_000.0];

/// Returns the colour and the mark of a route. The colours differ for every kind of colour vision (Okabe and Ito).
fn color_and_mark(family: Family) -> (&'static str, Mark) {
    match family {
        Family::ClosedForm => ("#0072b2", Mark::Dot),
        Family::Lattice | Family::Chain => ("#009e73", Mark::Square),
        Family::PlannedCells => ("#009e73", Mark::Square),
        Family::Cells => ("#d55e00", Mark::Diamond),
        Family::Modes => ("#cc79a7", Mark::Triangle),
        Family::Printed => ("#8c6d1f", Mark::TriangleDown),
        Family::Differences => ("#56b4e9", Mark::Pentagon),
        Family::Enclosures => ("#000000", Mark::Cross),
    }
}

/// Returns the place of an error of `10^−digits` on the scale, upwards; ticks are 1 apart.
fn place_of(digits: f64, decades: f64) -> f64 {
    if digits <= DOUBLES_END {
        return -digits / decades;
    }
    let k = COMPRESSED_TICKS.iter().rposition(|tick| *tick <= digits).unwrap_or(0).min(COMPRESSED_TICKS.len() - 2);
    let share = (digits / COMPRESSED_TICKS[k]).ln() / (COMPRESSED_TICKS[k + 1] / COMPRESSED_TICKS[k]).ln();
    -(DOUBLES_END / decades + k as f64 + share)
}

/// Returns the digits at the tick of a place: the inverse of [`place_of`].
fn digits_at(place: f64, decades: f64) -> f64 {
    let beyond = -place - DOUBLES_END / decades;
    if beyond < 0.5 {
        -place * decades
    } else {
        COMPRESSED_TICKS[(beyond.round() as usize).min(COMPRESSED_TICKS.len() - 1)]
    }
}

/// Returns ticks at all whole numbers of a range.
fn whole_ticks(from: f64, to: f64, text: impl Fn(f64) -> String) -> Vec<(f64, String)> {
    (from.ceil() as i32..=to.floor() as i32).map(|place| (place.into(), text(place.into()))).collect()
}

/// Returns the work–precision diagram: error against time, both by decades, a line for each route and a star on the
/// plan's choice. Answers without any error stand on the lowest line, which says so; beyond double precision the scale
/// of the error is compressed, as the ticks state.
pub(crate) fn cost_svg(cost: &CostTable, title: Option<&str>) -> String {
    let finite = |row: &&CostRow| row.log10_error.is_finite();
    let digits = cost.rows.iter().filter(finite).map(|row| -row.log10_error);
    let (least, most) = digits.fold((0.0, 0.0), |(least, most), d| (f64::min(least, d), f64::max(most, d)));
    let long = most > DOUBLES_END;
    let decades = if long { 3.0 } else { 2.0 };
    let exact = cost.rows.iter().any(|row| !row.log10_error.is_finite());
    // Answers without error have a line of their own below all others.
    let lowest = place_of(if long { most } else { DOUBLES_END }, decades).floor() - if exact { 1.0 } else { 0.0 };
    let place = |row: &CostRow| {
        let error = if row.log10_error.is_finite() { place_of(-row.log10_error, decades) } else { lowest };
        DVec2::new(row.timing.seconds.max(1e-12).log10(), error)
    };
    let times: Vec<f64> = cost.rows.iter().map(|row| place(row).x).collect();
    let first = times.iter().copied().fold(f64::INFINITY, f64::min).floor();
    let last = times.iter().copied().fold(f64::NEG_INFINITY, f64::max).ceil().max(first + 1.0);
    let mut x = Axis::new("time [s]", "", [first, last]);
    x.ticks = Some(whole_ticks(first, last, |power| power_of_ten(power as i32)));
    // Marks on the lowest line are whole.
    let low = if exact { lowest - 0.4 } else { lowest };
    let mut y = Axis::new("relative error", "", [low, place_of(least, decades).ceil() + 0.3]);
    y.ticks = Some(whole_ticks(y.from, y.to, |place| match place {
        place if exact && place <= lowest + 0.5 => "no error".into(),
        place => power_of_ten(-digits_at(place, decades) as i32),
    }));
    let mut panel = Panel::new(format!("{}: error against time", quantity_text(cost)), x, y);
    if long {
        panel.level("doubles-end", place_of(DOUBLES_END, decades), Stroke::new("#666666", 0.2).dashed("1.5 1"));
    }
    // The rows come by family, and in it by ladder.
    for rows in cost.rows.chunk_by(|a, b| a.family == b.family) {
        let ladders = rows.chunk_by(|a, b| a.ladder == b.ladder);
        let lines: Vec<Vec<DVec2>> = ladders.map(|rows| rows.iter().map(place).collect()).collect();
        let (color, mark) = color_and_mark(rows[0].family);
        panel.lines("curve", lines.clone(), Stroke::new(color, 0.3));
        panel.marks("marks", lines.concat(), mark, color);
        panel.legend.push(Key::mark(rows[0].family.to_string(), mark, color));
    }
    let chosen: Vec<DVec2> = cost.rows.iter().filter(|row| row.chosen).map(place).collect();
    for mark in [Mark::Ring, Mark::Star] {
        panel.marks("chosen", chosen.clone(), mark, "#000000");
    }
    panel.legend.push(Key::mark("the plan's choice", Mark::Star, "#000000"));
    Sheet { title: vec![without_subscripts(title.unwrap_or("What accuracy costs"))], panels: vec![panel] }
        .svg(Size::Page)
}

#[cfg(test)]
#[path = "tests/cost.rs"]
mod tests;
