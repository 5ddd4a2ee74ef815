//! The stress at the ground as a line of blocks, for a glance at a terminal.

use super::record::Head;
use dalembert::StressPiece;
use dalembert::engine::{Motion, straight};
use dalembert::number::Scalar;
use dalembert::quantity::Measure;

const BLOCKS: usize = 76;
const HEIGHTS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
const FLIGHT: char = '·';
/// How far straight pieces may be off, as a share of the greatest: less than half a height.
const STRAIGHT: f64 = 0.05;

/// The least `v_x(0,t)` in each of [`BLOCKS`] equal parts of the history; empty where the rod is never pressed.
///
/// **Accuracy**: 0.05 of the greatest `|v_x(0,t)|`.
pub(crate) fn outline<S: Scalar>(motion: &dyn Motion<S>) -> Vec<f64> {
    let pieces = motion.stress_pieces().into_iter().map(|piece| piece.map(|x| x.to_f64())).collect::<Vec<_>>();
    parts(&straight(&pieces, STRAIGHT), motion.end().to_f64())
}

fn parts(pieces: &[StressPiece<f64>], end: f64) -> Vec<f64> {
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

/// The line, below what it spans and its scale: the `peak` of all contacts.
pub(super) fn sparkline(outline: &[f64], end: f64, peak: f64, head: &Head) -> String {
    let block = |value: &f64| match (8.0 * value / peak).ceil() as usize {
        0 => FLIGHT,
        height => HEIGHTS[height.min(8) - 1],
    };
    let line: String = outline.iter().map(block).collect();
    let (measure, symbol) = match head.units.has_material() {
        true => (Measure::Stress, "E v_x(0,t)"),
        false => (Measure::Strain, "v_x(0,t)"),
    };
    let scale = head.units.factor(measure, &()).unwrap_or(1.0);
    let unit = head.units.name(measure);
    let space = if unit.is_empty() { "" } else { " " };
    let (end, peak) = (short(end), short(scale * peak));
    format!("{symbol} at the ground, t = 0 … {end}, peak {peak}{space}{unit}, {FLIGHT} flight\n {line}\n\n")
}

/// Four digits.
fn short(x: f64) -> String {
    if (1e-3..1e4).contains(&x.abs()) { x.decimal(4) } else { format!("{x:.3e}") }
}

#[cfg(test)]
#[path = "tests/outline.rs"]
mod tests;
