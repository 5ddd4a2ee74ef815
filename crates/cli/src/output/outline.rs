//! The stress at the ground as a line of blocks, for a terminal.

use super::run_info::RunInfo;
use dalembert::StressPiece;
use dalembert::engine::straight;
use dalembert::number::{Estimate, Scalar};
use dalembert::quantity::Measure;
use dalembert::solve::History;

const BLOCKS: usize = 76;
const HEIGHTS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
const FLIGHT: char = '·';
/// Largest error of straight pieces, as a share of the greatest value: less than half a height.
const STRAIGHT_ERROR: f64 = 0.05;

/// Returns the least `v_x(0,t)` in each of [`BLOCKS`] equal parts of the history; empty where the rod is never pressed.
///
/// **Accuracy**: 0.05 of the greatest `|v_x(0,t)|`.
pub(crate) fn outline(history: &History) -> Vec<f64> {
    let pieces = history.in_doubles(|history| history.ask(|motion| Ok(motion.stress_pieces()), |_| Vec::new()));
    let Ok(Ok(pieces)) = pieces else { return Vec::new() };
    let pieces: Vec<_> = pieces.into_iter().map(|piece| piece.map(Estimate::into_value)).collect();
    least_values(&straight(&pieces, STRAIGHT_ERROR), history.end().to_f64())
}

/// Returns the least value of straight pieces in each part of a history up to `end`.
fn least_values(pieces: &[StressPiece<f64>], end: f64) -> Vec<f64> {
    let mut least = vec![0.0f64; BLOCKS];
    let width = end / BLOCKS as f64;
    for piece in pieces.iter().filter(|piece| piece.end > piece.start && piece.strain_start.min(piece.strain_end) < 0.0)
    {
        let first = (piece.start / width) as usize;
        for (k, part) in least.iter_mut().enumerate().skip(first) {
            let [from, to] = [k, k + 1].map(|k| (k as f64 * width).clamp(piece.start, piece.end));
            if from >= piece.end {
                break;
            }
            if to > from {
                *part = part.min(piece.eval(&from)).min(piece.eval(&to));
            }
        }
    }
    if least.iter().all(|value| *value == 0.0) { Vec::new() } else { least }
}

/// Returns the line of blocks below its span and its scale, the `peak` of all contacts.
pub(super) fn sparkline(outline: &[f64], end: f64, peak: f64, info: &RunInfo) -> String {
    let block = |value: &f64| match (8.0 * value / peak).ceil() as usize {
        0 => FLIGHT,
        height => HEIGHTS[height.min(8) - 1],
    };
    let line: String = outline.iter().map(block).collect();
    let (measure, symbol) = match info.units.has_material() {
        true => (Measure::Stress, "E v_x(0,t)"),
        false => (Measure::Strain, "v_x(0,t)"),
    };
    let scale = info.units.factor(measure, &()).unwrap_or(1.0);
    let unit = info.units.name(measure);
    let space = if unit.is_empty() { "" } else { " " };
    let (end, peak) = (short(end), short(scale * peak));
    format!("{symbol} at the ground, t = 0 … {end}, peak {peak}{space}{unit}, {FLIGHT} flight\n {line}\n\n")
}

/// Returns `x` to four digits.
fn short(x: f64) -> String {
    if (1e-3..1e4).contains(&x.abs()) { x.decimal(4) } else { format!("{x:.3e}") }
}

#[cfg(test)]
#[path = "tests/outline.rs"]
mod tests;
