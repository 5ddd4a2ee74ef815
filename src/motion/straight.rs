//! Piecewise linear approximation of curved pieces of the stress history.

use std::f64::consts::PI;

use super::StressPiece;
use crate::number::Scalar;

/// Cuts the pieces into linear ones, each within `share` of the greatest `|v_x(0,·)|` at the ends of the pieces.
///
/// **Source**: `T_k` differs from its chord by at most 2; `T₀` and `T₁` are linear. A piece is halved until
/// `2 Σ_{k≥2} |c_k|` of its own coefficients is at most half of the tolerance. Each halving drops coefficients worth a
/// 64th of the tolerance, and the number of halvings of a piece is limited.
///
/// **Accuracy**: the tolerance, plus the accuracy of the pieces.
pub fn straight<S: Scalar>(pieces: &[StressPiece<S>], share: f64) -> Vec<StressPiece<S>> {
    let ends = pieces.iter().flat_map(|piece| [&piece.strain_start, &piece.strain_end]);
    let greatest = ends.fold(0.0, |most: f64, strain| most.max(strain.to_f64().abs()));
    let mut parts = Vec::new();
    for piece in pieces {
        cut(piece, share * greatest, &mut parts);
    }
    parts
}

/// Maximum number of halvings; each may drop coefficients worth a 64th of the tolerance.
const MOST_HALVINGS: u32 = 30;

fn cut<S: Scalar>(piece: &StressPiece<S>, tolerance: f64, parts: &mut Vec<StressPiece<S>>) {
    let coefficients = piece.chebyshev.iter().map(Scalar::to_f64).collect();
    let mut shares = Vec::new();
    halve(coefficients, (0.0, 1.0), tolerance, MOST_HALVINGS, &mut shares);
    shares.pop();
    let cut = |share| {
        let time = (piece.end.clone() - &piece.start) * piece.start.double(share) + &piece.start;
        (piece.eval(&time), time)
    };
    let (mut strain_start, mut start) = (piece.strain_start.clone(), piece.start.clone());
    for (strain, time) in shares.into_iter().map(cut).chain([(piece.strain_end.clone(), piece.end.clone())]) {
        let (strain_end, end, chebyshev) = (strain.clone(), time.clone(), Vec::new());
        parts.push(StressPiece { start, end, strain_start, strain_end, chebyshev });
        (strain_start, start) = (strain, time);
    }
}

/// Appends the ends, from left to right, of the parts whose chords are within the tolerance of the polynomial with
/// these Chebyshev coefficients.
fn halve(mut c: Vec<f64>, (from, to): (f64, f64), tolerance: f64, halvings: u32, ends: &mut Vec<f64>) {
    let mut left_out = tolerance / 64.0;
    while let Some(last) = c.pop_if(|last| last.abs() <= left_out) {
        left_out -= last.abs();
    }
    let bent: f64 = c.iter().skip(2).map(|c| c.abs()).sum();
    if halvings == 0 || 2.0 * bent <= tolerance / 2.0 {
        return ends.push(to);
    }
    let middle = 0.5 * (from + to);
    halve(half(&c, -0.5), (from, middle), tolerance, halvings - 1, ends);
    halve(half(&c, 0.5), (middle, to), tolerance, halvings - 1, ends);
}

/// Returns the coefficients of a polynomial on the half of −1 … 1 about `middle`, from values at its Chebyshev points.
fn half(c: &[f64], middle: f64) -> Vec<f64> {
    let n = c.len();
    let angle = |k: usize, j: usize| (PI * k as f64 * (j as f64 + 0.5) / n as f64).cos();
    let value = |j: usize| {
        let x = middle + 0.5 * angle(1, j);
        let (mut b1, mut b2) = (0.0, 0.0);
        for c in c.iter().skip(1).rev() {
            (b1, b2) = (2.0 * x * b1 - b2 + c, b1);
        }
        x * b1 - b2 + c[0]
    };
    let values: Vec<f64> = (0..n).map(value).collect();
    let coefficient = |k: usize| {
        let sum: f64 = values.iter().enumerate().map(|(j, value)| value * angle(k, j)).sum();
        sum * if k == 0 { 1.0 } else { 2.0 } / n as f64
    };
    (0..n).map(coefficient).collect()
}

#[cfg(test)]
#[path = "tests/straight.rs"]
mod tests;
