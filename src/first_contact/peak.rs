//! Where in a cell the ground presses hardest.

use super::bounce::Route;
use super::cells::Interpolant;
use super::field::FirstContact;
use super::search::evaluate;
use crate::number::Analytic;

/// Where the force may exceed a given one.
pub(crate) enum Summit<S> {
    /// Nowhere.
    Below,
    /// Where it may, it rises towards the end.
    AtEnd,
    /// Where it may, it falls from the beginning.
    AtStart,
    /// Around so many round trips, where its second derivative, by round trips, is at most `−bend`.
    Inside {
        /// An approximation.
        at: S,
        /// Where the bound holds.
        between: [S; 2],
        /// The bound.
        bend: S,
    },
    /// Not known; but it is at most this.
    AtMost(S),
}

/// Pieces that a cell is cut into.
const PIECES: usize = 128;

impl<S: Analytic> FirstContact<S> {
    /// Where between `k t₁` and the place `to` of `[−1,1]` in its cell the force exceeds `known`, if anywhere.
    ///
    /// With the Chebyshev sum p, `|f − p| ≤ e`: on a piece of width w the sum is at most its greater end plus `B₂w²/8`, its
    /// slope is that of the middle within `B₂w/2`, its second derivative that of the middle within `B₃w/2`, where
    /// `B₂ = Σ|c_n| n²(n²−1)/3` and `B₃ = Σ|c_n| n²(n²−1)(n²−4)/15`. The slopes of f and p differ by at most `4(n+1)²e`, as
    /// there; their second derivatives, by Markov's inequality and the same series with k⁴ for k², by `4(n+1)⁴e`.
    pub(crate) fn summit(&self, k: i64, to: f64, known: &S) -> Summit<S> {
        let Ok(Interpolant { scale, sum, error }) = self.interpolant(&Route::Rays, k) else {
            return Summit::AtMost(known.one());
        };
        let level = (known.clone() / &scale).to_f64() * (1.0 - 1e-12) - error;
        let (slopes, bends) = (derivative(&sum), derivative(&derivative(&sum)));
        let weighted = |weight: fn(f64) -> f64| {
            (0u32..).zip(&sum).map(|(n, c)| weight(f64::from(n)) * c.abs()).sum::<f64>() * (1.0 + 1e-9)
        };
        let second = weighted(|n| n * n * (n * n - 1.0) / 3.0);
        let third = weighted(|n| n * n * (n * n - 1.0) * (n * n - 4.0).abs() / 15.0);
        let size = (sum.len() * sum.len()) as f64 * 4.0 * error;
        // A little more, so that no rounding leaves the end out.
        let width = (to + 1.0) / PIECES as f64 * (1.0 + 1e-12);
        let place = |i: usize| -1.0 + width * i as f64;
        let value = |x: f64| evaluate(&sum, x).0;
        let (mut first, mut last, mut most) = (None, 0, 0.0f64);
        for i in 0..PIECES {
            let above = value(place(i)).max(value(place(i + 1))) + second * width * width / 8.0 + error;
            if above > level {
                first.get_or_insert(i);
                last = i;
                most = most.max(above);
            }
        }
        let Some(first) = first else { return Summit::Below };
        let (mut rising, mut falling, mut bend) = (true, true, f64::INFINITY);
        for i in first..=last {
            let middle = place(i) + 0.5 * width;
            let (slope, doubt) = (value_of(&slopes, middle), second * width * 0.5 + size);
            rising &= slope > doubt;
            falling &= slope < -doubt;
            bend = bend.min(-value_of(&bends, middle) - third * width * 0.5 - size * (sum.len() * sum.len()) as f64);
        }
        if rising && last + 1 == PIECES {
            return Summit::AtEnd;
        }
        if falling && first == 0 {
            return Summit::AtStart;
        }
        if bend > 0.0 {
            let highest = (first..=last + 1).max_by(|a, b| value(place(*a)).total_cmp(&value(place(*b))));
            let at = self.inside(k, highest.map_or(0.0, place));
            let between = [self.inside(k, place(first)), self.inside(k, place(last + 1))];
            return Summit::Inside { at, between, bend: scale.double(4.0 * bend) * &scale };
        }
        Summit::AtMost(scale.double(most * (1.0 + 1e-12)) * &scale)
    }

    /// Half the static share of the force and a bound of the transient from `k t₁` on: no later force is greater.
    pub(crate) fn most_after(&self, k: i64) -> Option<S> {
        let share = self.critical.clone() / (self.rod.speed.clone() + &self.critical) / self.critical.int(2);
        Some(share.double(self.transient(k)?) + &share)
    }
}

fn value_of(sum: &[f64], x: f64) -> f64 {
    evaluate(sum, x).0
}

/// The Chebyshev coefficients of the derivative: `d_{k−1} = d_{k+1} + 2k c_k`, the first one halved.
fn derivative(sum: &[f64]) -> Vec<f64> {
    let mut result = vec![0.0; sum.len() + 1];
    for k in (1..sum.len()).rev() {
        result[k - 1] = result[k + 1] + 2.0 * k as f64 * sum[k];
    }
    result[0] *= 0.5;
    result.truncate(sum.len().saturating_sub(1).max(1));
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivative_of_a_cubic() {
        // T₃ = 4x³ − 3x, T₃′ = 12x² − 3 = 6T₂ + 3.
        assert_eq!(derivative(&[1.0, 0.0, 0.0, 1.0]), vec![3.0, 0.0, 6.0]);
        assert_eq!(derivative(&[2.0]), vec![0.0]);
    }
}
