//! The map of regimes: numbers, and a picture.

use std::fmt::Write;
use std::io::Cursor;

use ndarray::{Array1, Array2};
use ndarray_npy::{NpzWriter, WriteNpzError};

use crate::number::{Number, Scalar};
use crate::sweep::{Map, Regime, threshold};

/// Colours by `t_b/t₁`, each up to its number and with it.
const BANDS: [(f64, &str, &str); 8] = [
    (1.0, "#440154", "t_b = t₁"),
    (1.25, "#46327e", "to 1.25 t₁"),
    (1.5, "#365c8d", "to 1.5 t₁"),
    (1.75, "#277f8e", "to 1.75 t₁"),
    (2.0, "#1fa187", "to 2 t₁"),
    (3.0, "#4ac16d", "to 3 t₁"),
    (4.0, "#a0da39", "to 4 t₁"),
    (f64::INFINITY, "#fde725", "later"),
];
const NEVER: (&str, &str) = ("#d9d9d9", "no bounce");
const UNDECIDED: (&str, &str) = ("#e31a1c", "not decided");

fn color(regime: Regime) -> &'static str {
    match regime {
        Regime::Bounce(time) => BANDS.iter().find(|band| time <= band.0).map_or(UNDECIDED.0, |band| band.1),
        Regime::Never => NEVER.0,
        Regime::Undecided => UNDECIDED.0,
    }
}

/// `t_b/t₁`; empty where there is no bounce, with the reason in a word.
pub(crate) fn regimes_csv(map: &Map) -> Result<String, csv::Error> {
    let row = |(k, regime): (usize, &Regime)| {
        let (m, r) = (&map.speed[k / map.damping.len()], &map.damping[k % map.damping.len()]);
        let (time, word) = match regime {
            Regime::Bounce(time) => (time.text(), "bounce"),
            Regime::Never => (String::new(), "no bounce"),
            Regime::Undecided => (String::new(), "not decided"),
        };
        vec![r.to_string(), m.to_string(), time, word.to_string()]
    };
    let rows = map.regimes.iter().enumerate().map(row).collect();
    super::csv::write("", ["damping_ratio", "speed_ratio", "bounce_ratio", "regime"].map(String::from).into(), rows)
}

/// `R` of each column and the `M` above which the bounce comes at `t₁`; empty where no M is high enough.
pub(crate) fn threshold_csv(map: &Map) -> Result<String, csv::Error> {
    let row = |r: &Number| {
        let m = threshold(r.to_f64());
        vec![r.to_string(), if m.is_finite() { m.text() } else { String::new() }]
    };
    super::csv::write(
        "",
        ["damping_ratio", "threshold"].map(String::from).into(),
        map.damping.iter().map(row).collect(),
    )
}

/// How often each regime comes, in words.
pub(crate) fn regimes_text(map: &Map) -> String {
    let count = map.regimes.len() as f64;
    let share = |is: fn(&Regime) -> bool| 100.0 * map.regimes.iter().filter(|regime| is(regime)).count() as f64 / count;
    format!(
        "{} × {} points\nbounce at t₁:  {:5.1} %\nlater:         {:5.1} %\nno bounce:     {:5.1} %\nnot decided:   {:5.1} %\n",
        map.damping.len(),
        map.speed.len(),
        share(|regime| *regime == Regime::Bounce(1.0)),
        share(|regime| matches!(regime, Regime::Bounce(time) if *time != 1.0)),
        share(|regime| *regime == Regime::Never),
        share(|regime| *regime == Regime::Undecided),
    )
}

/// `damping_ratio`, `speed_ratio`, `bounce_ratio` (rows of one M; infinite where there is no bounce, NaN where none is
/// shown), and `threshold` at each R.
pub(crate) fn regimes_npz(map: &Map) -> Result<Vec<u8>, WriteNpzError> {
    let mut bytes = Cursor::new(Vec::new());
    let mut npz = NpzWriter::new_compressed(&mut bytes);
    let doubles = |list: &[Number]| list.iter().map(Number::to_f64).collect::<Array1<f64>>();
    let (columns, value) = (map.damping.len(), |place: usize| match map.regimes[place] {
        Regime::Bounce(time) => time,
        Regime::Never => f64::INFINITY,
        Regime::Undecided => f64::NAN,
    });
    npz.add_array("damping_ratio", &doubles(&map.damping))?;
    npz.add_array("speed_ratio", &doubles(&map.speed))?;
    npz.add_array("bounce_ratio", &Array2::from_shape_fn((map.speed.len(), columns), |(m, r)| value(m * columns + r)))?;
    npz.add_array("threshold", &doubles(&map.damping).mapv(threshold))?;
    npz.finish()?;
    Ok(bytes.into_inner())
}

/// Where the map lies in the picture.
const LEFT: f64 = 70.0;
const TOP: f64 = 40.0;
const WIDTH: f64 = 520.0;
const HEIGHT: f64 = 400.0;

/// A place along an axis of values, as a share from its first to its last point; by decades where `log`.
fn share(values: &[Number], log: bool, x: f64) -> f64 {
    let scale = |x: f64| if log { x.ln() } else { x };
    let [first, last] = [values.first(), values.last()].map(|end| scale(end.map_or(0.0, Number::to_f64)));
    (scale(x) - first) / (last - first)
}

/// Whether the values of an axis are nearer to a geometric than to an arithmetic progression.
fn is_log(values: &[Number]) -> bool {
    let value = |k: usize| values.get(k).map_or(0.0, Number::to_f64);
    let (first, middle, last) = (value(0), value(values.len() / 2), value(values.len().saturating_sub(1)));
    let place = values.len() as f64 / 2.0 / (values.len() as f64 - 1.0).max(1.0);
    first > 0.0 && last > 0.0 && {
        let (straight, geometric) = (first + (last - first) * place, first * (last / first).powf(place));
        (middle / geometric).ln().abs() < (middle / straight).ln().abs()
    }
}

/// Round numbers from the first to the last value, some six of them.
fn ticks(values: &[Number], log: bool) -> Vec<f64> {
    let [a, b] = [values.first(), values.last()].map(|end| end.map_or(0.0, Number::to_f64));
    let (a, b) = (a.min(b), a.max(b));
    let within = |x: &f64| (a - 1e-9 * (b - a)..=b + 1e-9 * (b - a)).contains(x);
    if log {
        let decades = a.log10().floor() as i32..=b.log10().ceil() as i32;
        let steps = if b / a > 1e4 { &[1.0][..] } else { &[1.0, 2.0, 5.0] };
        return decades.flat_map(|d| steps.iter().map(move |s| s * 10f64.powi(d))).filter(within).collect();
    }
    let raw = (b - a) / 6.0;
    let power = 10f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|s| s * power).into_iter().find(|s| *s >= raw).unwrap_or(raw);
    (0..=40).map(|k| ((a / step).ceil() + f64::from(k)) * step).filter(within).collect()
}

/// The map as SVG: a rectangle for each run of points of one colour, the threshold and `R = π` as lines.
pub(crate) fn regimes_svg(map: &Map) -> String {
    let mut svg = String::new();
    // Writing to a text does not fail.
    let mut put = |text: std::fmt::Arguments<'_>| {
        let _ = svg.write_fmt(text);
    };
    put(format_args!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"760\" height=\"500\" viewBox=\"0 0 760 500\" \
         font-family=\"DejaVu Sans\" font-size=\"12\">\n<rect width=\"760\" height=\"500\" fill=\"#ffffff\"/>\n"
    ));
    let (rows, columns) = (map.speed.len(), map.damping.len());
    let (width, height) = (WIDTH / columns as f64, HEIGHT / rows as f64);
    put(format_args!("<g shape-rendering=\"crispEdges\">\n"));
    for (row, regimes) in map.regimes.chunks(columns).enumerate() {
        let y = TOP + HEIGHT - (row + 1) as f64 * height;
        let mut start = 0;
        for run in regimes.chunk_by(|a, b| color(*a) == color(*b)) {
            let x = LEFT + start as f64 * width;
            put(format_args!(
                "<rect x=\"{x:.3}\" y=\"{y:.3}\" width=\"{:.3}\" height=\"{height:.3}\" fill=\"{}\"/>\n",
                run.len() as f64 * width,
                color(run[0])
            ));
            start += run.len();
        }
    }
    put(format_args!("</g>\n"));
    // A point is the middle of its rectangle.
    let inner = |share: f64, count: usize| (0.5 + share * (count as f64 - 1.0)) / count as f64;
    let (across, up) = (is_log(&map.damping), is_log(&map.speed));
    let x = |r: f64| LEFT + WIDTH * inner(share(&map.damping, across, r), columns);
    let y = |m: f64| TOP + HEIGHT * (1.0 - inner(share(&map.speed, up, m), rows));
    put(format_args!(
        "<clipPath id=\"map\"><rect x=\"{LEFT}\" y=\"{TOP}\" width=\"{WIDTH}\" height=\"{HEIGHT}\"/></clipPath>\n\
         <g clip-path=\"url(#map)\" fill=\"none\" stroke=\"#ffffff\" stroke-width=\"2\">\n<polyline points=\""
    ));
    // Closer and closer to I₀(R) = 2, where it is infinite.
    let (mut below, mut above) = (1.8, 1.81);
    for _ in 0..60 {
        let middle: f64 = (below + above) / 2.0;
        *(if threshold(middle).is_finite() { &mut below } else { &mut above }) = middle;
    }
    for k in 0..=800 {
        let r = below * (1.0 - (-f64::from(k) / 20.0).exp2());
        let (x, y) = (x(r), y(threshold(r)));
        if x.is_finite() && y.is_finite() {
            put(format_args!("{x:.2},{:.2} ", y.clamp(-1e4, 1e4)));
        }
    }
    let pi = x(std::f64::consts::PI);
    put(format_args!(
        "\"/>\n<line x1=\"{pi:.2}\" y1=\"{TOP}\" x2=\"{pi:.2}\" y2=\"{}\" stroke=\"#000000\" stroke-dasharray=\"6 4\"/>\n</g>\n\
         <rect x=\"{LEFT}\" y=\"{TOP}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"none\" stroke=\"#000000\"/>\n",
        TOP + HEIGHT
    ));
    let bottom = TOP + HEIGHT;
    for tick in ticks(&map.damping, across) {
        let (x, text) = (x(tick), tick.decimal(4));
        put(format_args!(
            "<line x1=\"{x:.2}\" y1=\"{bottom}\" x2=\"{x:.2}\" y2=\"{}\" stroke=\"#000000\"/>\n",
            bottom + 5.0
        ));
        put(format_args!("<text x=\"{x:.2}\" y=\"{}\" text-anchor=\"middle\">{text}</text>\n", bottom + 19.0));
    }
    for tick in ticks(&map.speed, up) {
        let (y, text) = (y(tick), tick.decimal(4));
        put(format_args!(
            "<line x1=\"{}\" y1=\"{y:.2}\" x2=\"{LEFT}\" y2=\"{y:.2}\" stroke=\"#000000\"/>\n",
            LEFT - 5.0
        ));
        put(format_args!("<text x=\"{}\" y=\"{:.2}\" text-anchor=\"end\">{text}</text>\n", LEFT - 9.0, y + 4.0));
    }
    let (middle, half) = (LEFT + WIDTH / 2.0, TOP + HEIGHT / 2.0);
    put(format_args!(
        "<text x=\"{middle}\" y=\"24\" text-anchor=\"middle\" font-size=\"15\">When the first contact ends</text>\n\
         <text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\" font-size=\"13\">R = r t₁</text>\n\
         <text transform=\"translate(20 {half}) rotate(-90)\" text-anchor=\"middle\" font-size=\"13\">M = μ/(g t₁)</text>\n",
        bottom + 42.0
    ));
    let undecided = map.regimes.contains(&Regime::Undecided).then_some(UNDECIDED);
    let legend = BANDS.iter().map(|band| (band.1, band.2)).chain([NEVER]).chain(undecided);
    for (k, (fill, text)) in legend.enumerate() {
        let (x, y) = (LEFT + WIDTH + 20.0, TOP + 22.0 * k as f64);
        put(format_args!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"16\" height=\"16\" fill=\"{fill}\" stroke=\"#000000\"/>\n"
        ));
        put(format_args!("<text x=\"{}\" y=\"{}\">{text}</text>\n", x + 24.0, y + 13.0));
    }
    for (k, text) in ["white: M = (I₀+I₁)/(2−I₀)", "dashed: R = π"].into_iter().enumerate() {
        let y = TOP + 22.0 * 11.0 + 18.0 * k as f64;
        put(format_args!("<text x=\"{}\" y=\"{y}\" font-size=\"10\">{text}</text>\n", LEFT + WIDTH + 12.0));
    }
    svg + "</svg>\n"
}
