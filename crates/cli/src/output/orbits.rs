//! Periodic orbits as rows, and their period against their energy.

use glam::DVec2;

use super::column::Column;
use super::dataset::{Cell, Dataset};
use dalembert::number::Scalar;
use dalembert::orbits::{Orbit, OrbitValues};
use dalembert::quantity::{Measure, Units};
use dalembert_plot::draw::{Axis, Key, LINES, Mark, Panel, Sheet, Size};

/// An orbit with its place in the list, from 1.
pub(crate) struct OrbitRow {
    pub(crate) number: usize,
    pub(crate) orbit: Orbit,
    pub(crate) values: OrbitValues,
    /// Growth of a disturbance in each period; `None` where it is not settled.
    pub(crate) growth: Option<f64>,
}

/// Returns a row for each orbit, with the growth of a disturbance if that was asked for; long numbers have `digits`
/// digits.
pub(crate) fn orbits_data(
    rows: &[OrbitRow],
    units: &Units,
    title: Option<&str>,
    (digits, has_growth): (u32, bool),
) -> Dataset {
    let measured = |name: &'static str, head: &str, measure: Measure| {
        let unit = units.name(measure);
        let head = if unit.is_empty() { head.to_string() } else { format!("{head} [{unit}]") };
        Column::new(name).headed(head).with_unit(unit).bounded()
    };
    let mut columns = vec![
        Column::new("orbit"),
        Column::new("period_ratio").headed("T/t₁"),
        Column::new("contact_ratio").headed("contact/t₁"),
        measured("period", "T", Measure::Time),
        measured("contact", "contact", Measure::Time),
        measured("impact_speed", "speed", Measure::Velocity),
        measured("height", "height", Measure::Length),
        measured("excess_energy", "E − E_rest", Measure::Energy),
        Column::data("energy").with_unit(units.name(Measure::Energy)).bounded(),
        Column::data("first_branch"),
    ];
    columns.extend(has_growth.then(|| Column::new("growth")));
    let cells = |OrbitRow { number, orbit, values, growth }: &OrbitRow| {
        let OrbitValues { period, contact, impact_speed, height, energy, excess } = values;
        let ratios = [orbit.period_ratio(), orbit.contact_ratio()].map(|ratio| Cell::from(ratio.to_string()));
        let numbers = [period, contact, impact_speed, height, excess, energy].map(|value| Cell::Number(value.clone()));
        let mut cells = vec![Cell::from(*number)];
        cells.extend(ratios.into_iter().chain(numbers));
        cells.push(i64::from(orbit.is_of_first_branch()).into());
        // An estimate, with the digits that it is worth.
        let growth = growth.map(|growth| Scalar::decimal(&growth, 3));
        cells.extend(has_growth.then(|| growth.into()));
        cells
    };
    let count = match rows.len() {
        0 => "no orbit with one contact in each period\n".into(),
        1 => "\n".into(),
        count => format!("\n\n{count} orbits\n"),
    };
    Dataset {
        columns,
        rows: rows.iter().map(cells).collect(),
        around: [title.map_or_else(String::new, |title| format!("{title}\n\n")), count],
        digits,
        keys: Some(3),
        ..Dataset::default()
    }
}

/// Returns the picture of the periods against the energies above that of the rod at rest.
pub(crate) fn orbits_svg(rows: &[OrbitRow], units: &Units, title: Option<&str>) -> String {
    let points = rows.iter().map(|OrbitRow { orbit, values, .. }| {
        (orbit.is_of_first_branch(), DVec2::new(values.excess.to_f64(), values.period.to_f64()))
    });
    let points: Vec<(bool, DVec2)> = points.filter(|(_, point)| point.x > 0.0).collect();
    let ends = |values: &mut dyn Iterator<Item = f64>| {
        values.fold([f64::INFINITY, 0.0_f64], |[from, to], value| [from.min(value), to.max(value)])
    };
    let [from, to] = ends(&mut points.iter().map(|(_, point)| point.x));
    let [from, to] = if from <= to { [from / 1.5, to * 1.5] } else { [0.1, 10.0] };
    let unit = units.name(Measure::Energy);
    let x = Axis::log(&format!("energy above rest [{unit}]"), [from, to]);
    let periods = Axis::range(points.iter().map(|(_, point)| point.y), false);
    let y = Axis::new("period T", units.name(Measure::Time), periods);
    let mut panel = Panel::new("period against energy of the orbits with one contact in each period", x, y);
    let of = |first: bool| points.iter().filter(|(is, _)| *is == first).map(|(_, point)| *point).collect::<Vec<_>>();
    panel.marks("orbits", of(false), Mark::Point, LINES[0]);
    panel.marks("first", of(true), Mark::Dot, LINES[1]);
    panel.legend = vec![Key::mark("first branch", Mark::Dot, LINES[1]), Key::mark("others", Mark::Point, LINES[0])];
    Sheet { title: title.map(String::from).into_iter().collect(), panels: vec![panel] }.svg(Size::Page)
}
