//! Exact values beside the data of others, and the difference: rows, and a picture.

use glam::DVec2;

use super::column::Column;
use super::dataset::Dataset;
use dalembert::quantity::{Measure, Units};
use dalembert_compare::{Bar, ComparedColumn, ComparedFile};
use dalembert_plot::draw::{Axis, Key, Panel, Sheet, Size, Stroke, thinned, without_subscripts};

/// Returns two panels for each quantity: the exact values as a thin line over the data, and the difference.
pub(crate) fn compare_svg(compared: &ComparedFile, title: Option<&str>, units: &Units) -> String {
    let times = &compared.agreement.grid.times;
    let file = std::path::Path::new(&compared.file).file_name().and_then(|name| name.to_str()).unwrap_or("theirs");
    let span = [times.first(), times.last()].map(|end| end.copied().unwrap_or(0.0));
    let panel = |title: &str, unit: &str, curves: Vec<(Vec<f64>, &str, Stroke)>| {
        let values = curves.iter().flat_map(|curve| &curve.0).copied();
        let y = Axis::new(&without_subscripts(title), unit, Axis::range(values, false));
        let mut panel = Panel::new(without_subscripts(title), Axis::new("t", units.name(Measure::Time), span), y);
        for (values, name, stroke) in curves {
            let points = times.iter().zip(values).map(|(time, value)| DVec2::new(*time, value)).collect();
            panel.lines("curve", vec![thinned(points)], stroke);
            panel.legend.push(Key::line(without_subscripts(name), stroke));
        }
        panel
    };
    let panels = compared.agreement.quantities.iter().flat_map(|ComparedColumn { what, ours, theirs, .. }| {
        let unit = if what.unit(units) == "1" { "" } else { what.unit(units) };
        let (exact, other) = (Stroke::new("#000000", 0.2), Stroke::new("#e69f00", 0.5));
        let apart = theirs.iter().zip(ours).map(|(theirs, ours)| theirs - ours).collect();
        [
            panel(what.name(), unit, vec![(theirs.clone(), file, other), (ours.clone(), "ours", exact)]),
            panel(what.name(), unit, vec![(apart, "theirs − ours", Stroke::new("#0072b2", 0.3))]),
        ]
    });
    let title = without_subscripts(title.unwrap_or("Theirs and ours"));
    Sheet { title: vec![title], panels: panels.collect() }.svg(Size::Page)
}

/// Returns a row for each sample: time, point of a field, and for each quantity ours, theirs and the difference. Files
/// of the same times, one for each bar of a chain, have the names of the chain's columns.
pub(crate) fn compare_data(files: &[(Option<Bar<'_>>, &ComparedFile)]) -> Dataset {
    let Some((_, ComparedFile { agreement, .. })) = files.first() else { return Dataset::default() };
    let points = agreement.grid.points.as_ref();
    let mut columns: Vec<Column> = ["t"].into_iter().chain(points.map(|_| "x")).map(Column::new).collect();
    for (bar, file) in files {
        for ComparedColumn { what, .. } in &file.agreement.quantities {
            let name = bar.map_or_else(|| what.name().to_string(), |bar| bar.header(what.name()));
            columns.extend(["ours", "theirs", "difference"].map(|whose| Column::new(format!("{name}_{whose}"))));
        }
    }
    let row = |(k, time): (usize, &f64)| {
        let place = [time.to_string()].into_iter().chain(points.map(|points| points[k].to_string()));
        let all = files.iter().flat_map(|(_, file)| &file.agreement.quantities);
        let values = all.flat_map(|ComparedColumn { ours, theirs, .. }| {
            [ours[k], theirs[k], theirs[k] - ours[k]].map(|value| format!("{value:e}"))
        });
        place.chain(values).map(Into::into).collect()
    };
    Dataset { columns, rows: agreement.grid.times.iter().enumerate().map(row).collect(), ..Dataset::default() }
}
