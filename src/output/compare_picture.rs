//! Other people's data over ours, and the difference below, as SVG.

use kuva::backend::svg::SvgBackend;
use kuva::plot::LinePlot;
use kuva::render::figure::Figure;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;

use super::picture::FAMILY;
use crate::agreement::{Compared, ComparedFile};
use crate::quantity::Units;

const WIDTH: f64 = 760.0;
/// Heights of the two panels of a quantity.
const HEIGHTS: [f64; 2] = [210.0, 150.0];
/// Points of a line: more than the picture has places for are drawn as the least and the greatest of each place.
const PLACES: usize = 760;

/// A line through at most two points a place.
fn line(times: &[f64], values: impl Fn(usize) -> f64) -> Vec<(f64, f64)> {
    let step = times.len().div_ceil(PLACES).max(1);
    if step <= 2 {
        return times.iter().enumerate().map(|(k, time)| (*time, values(k))).collect();
    }
    let place = |start: usize| {
        let range = start..(start + step).min(times.len());
        let least = range.clone().min_by(|a, b| values(*a).total_cmp(&values(*b))).unwrap_or(start);
        let most = range.max_by(|a, b| values(*a).total_cmp(&values(*b))).unwrap_or(start);
        [least.min(most), least.max(most)].map(|k| (times[k], values(k)))
    };
    (0..times.len()).step_by(step).flat_map(place).collect()
}

/// Two panels for each quantity: ours with theirs over it, and theirs − ours.
pub(crate) fn compare_svg(compared: &ComparedFile, title: Option<&str>, units: &Units) -> String {
    let times = &compared.agreement.grid.times;
    let file = std::path::Path::new(&compared.file).file_name().and_then(|name| name.to_str()).unwrap_or("theirs");
    let (mut plots, mut layouts) = (Vec::new(), Vec::new());
    let mut figure = Figure::new(2 * compared.agreement.quantities.len(), 1);
    for (k, Compared { what, ours, theirs, .. }) in compared.agreement.quantities.iter().enumerate() {
        let name = match what.unit(units) {
            "" | "1" => what.name().to_string(),
            unit => format!("{}, {unit}", what.name()),
        };
        let drawn =
            |points, color: &str, width| LinePlot::new().with_data(points).with_color(color).with_stroke_width(width);
        let exact = drawn(line(times, |k| ours[k]), "#000000", 2.2).with_legend("ours");
        let other = drawn(line(times, |k| theirs[k]), "#d55e00", 1.1).with_legend(file);
        let apart = drawn(line(times, |k| theirs[k] - ours[k]), "#0072b2", 1.0);
        let panels: [(Vec<Plot>, String); 2] =
            [(vec![exact.into(), other.into()], name), (vec![apart.into()], "theirs − ours".into())];
        for (row, (panel, label)) in panels.into_iter().enumerate() {
            let mut layout = Layout::auto_from_plots(&panel)
                .with_y_label(label)
                .with_label_size(13)
                .with_tick_size(12)
                .with_body_size(12)
                .with_font_family(FAMILY)
                .with_x_axis_min(times.first().copied().unwrap_or(0.0))
                .with_x_axis_max(times.last().copied().unwrap_or(1.0));
            if row == 1 {
                layout = layout.with_x_label("t");
            }
            plots.push(panel);
            layouts.push(layout);
            figure = figure.with_row_height(2 * k + row, HEIGHTS[row]);
        }
    }
    let structure = (0..plots.len()).map(|k| vec![k]).collect();
    let figure = figure
        .with_title(title.unwrap_or("Theirs and ours"))
        .with_title_size(15)
        .with_structure(structure)
        .with_plots(plots)
        .with_layouts(layouts)
        .with_cell_size(WIDTH, HEIGHTS[0])
        .with_shared_legend_bottom();
    SvgBackend::new().render_scene(&figure.render())
}

#[cfg(test)]
mod tests {
    use super::line;

    /// A spike survives, and the ends do.
    #[test]
    fn extremes_are_kept() {
        let times: Vec<f64> = (0..10_000).map(f64::from).collect();
        let points = line(&times, |k| if k == 4321 { 5.0 } else { 0.0 });
        assert!(points.len() <= 1520 && points.contains(&(4321.0, 5.0)) && points[0].0 == 0.0);
        assert_eq!(line(&times[..3], |k| k as f64), [(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)]);
    }
}
