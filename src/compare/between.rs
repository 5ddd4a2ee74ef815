//! Values at very many times: asked at some of them, and interpolated where that is shown to do.

use std::ops::Range;

use crate::error::Error;

/// Times that one polynomial is tried on first.
const CHUNK: usize = 4096;
/// With fewer times than this, all of them are asked.
const FEW: usize = 64;
/// Nodes of the polynomial, and the places between them where it is held against the asked values.
const NODES: usize = 9;
/// It does where it is within this share of the greatest value of the column: a thousandth of what is promised of ours.
const CLOSE: f64 = 1e-12;

/// The places of `range` that are asked: nodes at the extremes of a Chebyshev polynomial, and the middles between them.
fn asked(range: &Range<usize>) -> Vec<usize> {
    let last = (range.len() - 1) as f64;
    let half_steps = 2 * (NODES - 1);
    let place = |k: usize| (1.0 - (std::f64::consts::PI * k as f64 / half_steps as f64).cos()) / 2.0;
    (0..=half_steps).map(|k| range.start + (place(k) * last).round() as usize).collect()
}

/// The polynomial through `nodes`, by the barycentric formula.
struct Polynomial {
    nodes: Vec<(f64, f64)>,
    weights: Vec<f64>,
}

impl Polynomial {
    fn through(nodes: Vec<(f64, f64)>) -> Self {
        let width = nodes[nodes.len() - 1].0 - nodes[0].0;
        let weight = |k: usize| {
            let others = nodes.iter().enumerate().filter(|(i, _)| *i != k);
            1.0 / others.map(|(_, (t, _))| (nodes[k].0 - t) * 4.0 / width).product::<f64>()
        };
        let weights = (0..nodes.len()).map(weight).collect();
        Polynomial { nodes, weights }
    }

    fn at(&self, time: f64) -> f64 {
        let (mut top, mut bottom) = (0.0, 0.0);
        for ((node, value), weight) in self.nodes.iter().zip(&self.weights) {
            let apart = time - node;
            if apart == 0.0 {
                return *value;
            }
            (top, bottom) = (top + weight / apart * value, bottom + weight / apart);
        }
        top / bottom
    }
}

/// The values of `columns` functions at ascending `times`, of which `ask` answers any.
///
/// **Source**: between rays every quantity is smooth, without damping a parabola. On each stretch of times the
/// polynomial through nine values is held against eight others; where it differs the stretch is halved, down to a few
/// times, which are asked. A jump or a kink makes it differ.
///
/// **Accuracy**: within 1e-12 of the greatest value where it was held against the asked ones.
///
/// **Errors**: those of `ask`.
pub(super) fn filled(
    times: &[f64],
    columns: usize,
    ask: impl Fn(&[f64]) -> Result<Vec<Vec<f64>>, Error>,
) -> Result<Vec<Vec<f64>>, Error> {
    let mut all = vec![vec![0.0; times.len()]; columns];
    let mut scales = vec![0.0f64; columns];
    let mut stretches: Vec<Range<usize>> =
        (0..times.len()).step_by(CHUNK).map(|from| from..(from + CHUNK).min(times.len())).collect();
    while !stretches.is_empty() {
        let places: Vec<Vec<usize>> = stretches
            .iter()
            .map(|range| if range.len() < FEW { range.clone().collect() } else { asked(range) })
            .collect();
        let at: Vec<f64> = places.iter().flatten().map(|place| times[*place]).collect();
        let answers = ask(&at)?;
        for (scale, values) in scales.iter_mut().zip(&answers) {
            *scale = values.iter().fold(*scale, |most, value| most.max(value.abs()));
        }
        let (mut start, mut next) = (0, Vec::new());
        for (range, places) in stretches.iter().zip(&places) {
            let answers: Vec<&[f64]> = answers.iter().map(|values| &values[start..start + places.len()]).collect();
            start += places.len();
            if range.len() < FEW {
                for (values, answers) in all.iter_mut().zip(&answers) {
                    values[range.clone()].copy_from_slice(answers);
                }
                continue;
            }
            let polynomial = |answers: &&[f64]| {
                let nodes = places.iter().zip(*answers).step_by(2).map(|(place, value)| (times[*place], *value));
                Polynomial::through(nodes.collect())
            };
            let polynomials: Vec<Polynomial> = answers.iter().map(polynomial).collect();
            let does = polynomials.iter().zip(&answers).zip(&scales).all(|((polynomial, answers), scale)| {
                let between = places.iter().zip(*answers).skip(1).step_by(2);
                between.into_iter().all(|(place, value)| (polynomial.at(times[*place]) - value).abs() <= CLOSE * scale)
            });
            if !does {
                let middle = range.start + range.len() / 2;
                next.extend([range.start..middle, middle..range.end]);
                continue;
            }
            for (values, polynomial) in all.iter_mut().zip(&polynomials) {
                for k in range.clone() {
                    values[k] = polynomial.at(times[k]);
                }
            }
        }
        stretches = next;
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    /// A parabola with a jump, a line with a kink and an exponential: every value, and few of them asked.
    #[test]
    fn jumps_and_kinks_are_met() {
        let count = 100_000;
        let times: Vec<f64> = (0..count).map(|k| f64::from(k) / 1e4).collect();
        let functions: [fn(f64) -> f64; 3] =
            [|t| if t < 3.21 { t * t } else { 1.0 - t }, |t| (t - 7.654).abs(), |t| (-t).exp()];
        let asked = Cell::new(0);
        let ask = |at: &[f64]| {
            asked.set(asked.get() + at.len());
            Ok(functions.iter().map(|f| at.iter().map(|t| f(*t)).collect()).collect())
        };
        let found = filled(&times, 3, ask).unwrap();
        for (function, values) in functions.iter().zip(&found) {
            for (t, value) in times.iter().zip(values) {
                assert!((function(*t) - value).abs() <= 1e-10, "{t}: {value}");
            }
        }
        assert!(asked.get() < 2000, "{}", asked.get());
    }
}
