//! Pictures: the work–precision diagram as SVG, and any of our SVGs as PNG.

use std::sync::Arc;

use kuva::backend::svg::SvgBackend;
use kuva::plot::legend::LegendPosition;
use kuva::plot::scatter::MarkerShape;
use kuva::plot::{LinePlot, ScatterPlot};
use kuva::render::annotations::ReferenceLine;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::render_multiple;
use resvg::{tiny_skia, usvg};

use super::cost::asked;
use crate::compare::cost::{Family, Row, Table};

/// DejaVu Sans, Latin and Greek letters, digits above and below the line and signs: what our pictures write.
const FONT: &[u8] = include_bytes!("font/DejaVuSans-subset.ttf");
pub(super) use super::draw::FAMILY;
/// Where the scale of errors is drawn together: the digits of a double get as much of the picture as the thousand
/// beyond them.
const DOUBLES_END: f64 = 18.0;
/// Digits at the ticks beyond, equally far apart.
const BEYOND: [f64; 8] = [DOUBLES_END, 50.0, 100.0, 300.0, 1000.0, 3000.0, 10_000.0, 30_000.0];
const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 460.0;

/// Colours that stay apart for every kind of sight (Okabe and Ito), and a mark for each route.
fn look(family: Family) -> (&'static str, MarkerShape) {
    match family {
        Family::ClosedForm => ("#0072b2", MarkerShape::Circle),
        Family::Lattice => ("#009e73", MarkerShape::Square),
        Family::ContactThenCells => ("#009e73", MarkerShape::Square),
        Family::Cells => ("#d55e00", MarkerShape::Diamond),
        Family::Modes => ("#cc79a7", MarkerShape::Triangle),
        Family::Printed => ("#8c6d1f", MarkerShape::TriangleDown),
        Family::Differences => ("#56b4e9", MarkerShape::Pentagon),
        Family::Enclosures => ("#000000", MarkerShape::Cross),
    }
}

/// `10⁻¹⁵`.
fn power_of_ten(exponent: f64) -> String {
    let digits = format!("{exponent:.0}");
    let raised = digits.chars().map(|digit| match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => digit.to_digit(10).and_then(|d| char::from_u32(0x2070 + d)).unwrap_or(digit),
    });
    std::iter::once("10").map(String::from).chain([raised.collect()]).collect()
}

/// The place of an error of `10^−digits` on the scale, upwards; a tick is 1.
fn place_of(digits: f64, decades: f64) -> f64 {
    if digits <= DOUBLES_END {
        return -digits / decades;
    }
    let k = BEYOND.iter().rposition(|tick| *tick <= digits).unwrap_or(0).min(BEYOND.len() - 2);
    let share = (digits / BEYOND[k]).ln() / (BEYOND[k + 1] / BEYOND[k]).ln();
    -(DOUBLES_END / decades + k as f64 + share)
}

/// The digits at a place: the inverse at ticks.
fn digits_at(place: f64, decades: f64) -> f64 {
    let beyond = -place - DOUBLES_END / decades;
    if beyond < 0.5 { -place * decades } else { BEYOND[(beyond.round() as usize).min(BEYOND.len() - 1)] }
}

/// The work–precision diagram: error against time, both by decades, a line for each route and a star on the plan's
/// choice. Answers without any error stand on the lowest line, which says so; beyond double precision the decades of
/// the error are drawn together, as the ticks say.
pub(crate) fn cost_svg(cost: &Table, title: Option<&str>) -> String {
    let finite = |row: &&Row| row.log10_error.is_finite();
    let digits = cost.rows.iter().filter(finite).map(|row| -row.log10_error);
    let (least, most) = digits.fold((0.0, 0.0), |(least, most), d| (f64::min(least, d), f64::max(most, d)));
    let long = most > DOUBLES_END;
    let decades = if long { 3.0 } else { 2.0 };
    let exact = cost.rows.iter().any(|row| !row.log10_error.is_finite());
    // Answers without error have a line of their own below all others.
    let lowest = place_of(if long { most } else { DOUBLES_END }, decades).floor() - if exact { 1.0 } else { 0.0 };
    let place = |row: &Row| {
        let error = if row.log10_error.is_finite() { place_of(-row.log10_error, decades) } else { lowest };
        (row.timing.seconds.max(1e-12).log10(), error)
    };
    let times: Vec<f64> = cost.rows.iter().map(|row| place(row).0).collect();
    let first = times.iter().copied().fold(f64::INFINITY, f64::min).floor();
    let last = times.iter().copied().fold(f64::NEG_INFINITY, f64::max).ceil().max(first + 1.0);
    let mut plots: Vec<Plot> = Vec::new();
    // The rows come by family.
    for rows in cost.rows.chunk_by(|a, b| a.family == b.family) {
        let family = rows[0].family;
        let points: Vec<(f64, f64)> = rows.iter().map(place).collect();
        let (color, marker) = look(family);
        plots.push(LinePlot::new().with_data(points.clone()).with_color(color).with_stroke_width(1.2).into());
        let marks = ScatterPlot::new().with_data(points).with_color(color).with_size(4.5).with_marker(marker);
        plots.push(marks.with_legend(family.name()).into());
    }
    let chosen: Vec<(f64, f64)> = cost.rows.iter().filter(|row| row.chosen).map(place).collect();
    let ring = ScatterPlot::new().with_data(chosen.clone()).with_color("#000000").with_size(9.0);
    plots.push(ring.with_marker_opacity(0.0).with_marker_stroke_width(1.6).into());
    let star = ScatterPlot::new().with_data(chosen).with_color("#000000").with_size(4.0);
    plots.push(star.with_marker(MarkerShape::Star).with_legend("the plan's choice").into());
    let errors = move |place: f64| match place {
        place if exact && place <= lowest + 0.5 => "no error".into(),
        place => power_of_ten(-digits_at(place, decades)),
    };
    let mut layout = Layout::auto_from_plots(&plots)
        .with_width(WIDTH)
        .with_height(HEIGHT)
        .with_title(title.unwrap_or("What accuracy costs"))
        .with_title_size(15)
        .with_subtitle(asked(cost))
        .with_x_label("time, seconds")
        .with_y_label("relative error")
        .with_label_size(13)
        .with_tick_size(12)
        .with_body_size(12)
        .with_font_family(FAMILY)
        .with_x_axis_min(first)
        .with_x_axis_max(last)
        // Marks on the lowest line are whole.
        .with_y_axis_min(if exact { lowest - 0.4 } else { lowest })
        .with_y_axis_max(place_of(least, decades).ceil() + 0.3)
        .with_x_tick_step(1.0)
        .with_y_tick_step(1.0)
        .with_x_tick_format(TickFormat::Custom(Arc::new(power_of_ten)))
        .with_y_tick_format(TickFormat::Custom(Arc::new(errors)))
        .with_legend_position(LegendPosition::OutsideRightTop);
    if long {
        let ends = place_of(DOUBLES_END, decades);
        layout = layout.with_reference_line(ReferenceLine::horizontal(ends).with_color("#666666"));
    }
    SvgBackend::new().render_scene(&render_multiple(plots, layout))
}

/// An SVG as a PNG, `scale` pixels for each of its units, on white.
///
/// **Errors**: what the SVG reader or the PNG writer says; none for the SVGs that are drawn here.
pub(crate) fn png(svg: &str, scale: f32) -> Result<Vec<u8>, String> {
    let mut options = usvg::Options { font_family: FAMILY.into(), ..usvg::Options::default() };
    options.fontdb_mut().load_font_data(FONT.to_vec());
    let tree = usvg::Tree::from_str(svg, &options).map_err(|error| error.to_string())?;
    let size = tree.size().to_int_size().scale_by(scale).ok_or("a picture without size")?;
    let mut pixels = tiny_skia::Pixmap::new(size.width(), size.height()).ok_or("a picture without size")?;
    pixels.fill(tiny_skia::Color::WHITE);
    resvg::render(&tree, tiny_skia::Transform::from_scale(scale, scale), &mut pixels.as_mut());
    pixels.encode_png().map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels() {
        assert_eq!([-15.0, 0.0, 3.0, -1008.0].map(power_of_ten), ["10⁻¹⁵", "10⁰", "10³", "10⁻¹⁰⁰⁸"]);
        for digits in [0.0, 3.0, 18.0, 50.0, 1000.0] {
            assert!((digits_at(place_of(digits, 3.0), 3.0) - digits).abs() < 1e-9, "{digits}");
        }
        // Equal factors of digits are equally far apart between two ticks.
        let middle = (100.0f64 * 300.0).sqrt();
        assert!((place_of(middle, 3.0) - place_of(100.0, 3.0) + 0.5).abs() < 1e-12);
    }
}
