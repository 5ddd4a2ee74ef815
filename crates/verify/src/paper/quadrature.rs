//! Adaptive Gauss–Kronrod quadrature, with a deadline.

use std::cell::Cell;
use std::time::{Duration, Instant};

/// Nodes of the Gauss–Kronrod rule of 7 and 15 points, without the negative ones.
#[rustfmt::skip]
const NODES: [f64; 8] = [
    0.991_455_371_120_812_6, 0.949_107_912_342_758_5, 0.864_864_423_359_769_1, 0.741_531_185_599_394_4,
    0.586_087_235_467_691_1, 0.405_845_151_377_397_2, 0.207_784_955_007_898_47, 0.0,
];
/// Weights of all nodes.
#[rustfmt::skip]
const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_224, 0.063_092_092_629_978_56, 0.104_790_010_322_250_19, 0.140_653_259_715_525_92,
    0.169_004_726_639_267_9, 0.190_350_578_064_785_4, 0.204_432_940_075_298_89, 0.209_482_141_084_727_82,
];
/// Weights of every second node in the Gauss rule.
const GAUSS: [f64; 4] =
    [0.129_484_966_168_869_7, 0.279_705_391_489_276_64, 0.381_830_050_505_118_9, 0.417_959_183_673_469_4];
/// Maximum number of halvings of one piece.
const DEEPEST: u32 = 16;
/// Least relative tolerance of an integral.
const FLOOR: f64 = 1e-13;
/// Number of pieces between two looks at the clock.
const BETWEEN_LOOKS: u32 = 256;

/// Adaptive integration to a relative tolerance, up to a deadline.
#[derive(Debug)]
pub(super) struct Quadrature {
    tolerance: f64,
    deadline: Option<Instant>,
    pieces: Cell<u32>,
    late: Cell<bool>,
}

impl Quadrature {
    pub(super) fn new(tolerance: f64) -> Self {
        Quadrature { tolerance, deadline: None, pieces: Cell::new(0), late: Cell::new(false) }
    }

    /// Sets a deadline `seconds` from now.
    pub(super) fn limited_to(mut self, seconds: f64) -> Self {
        self.deadline = Instant::now().checked_add(Duration::from_secs_f64(seconds.clamp(0.0, 1e6)));
        self
    }

    /// Returns whether the deadline has cut an integral short.
    pub(super) fn is_late(&self) -> bool {
        self.late.get()
    }

    /// Computes `∫ f` over `[a,b]`, cut at `cuts`, to the tolerance times `∫|f|`, or to `noise`, the rounding error of
    /// f, where that is more.
    pub(super) fn integral(&self, [a, b]: [f64; 2], cuts: &[f64], noise: f64, f: &dyn Fn(f64) -> f64) -> f64 {
        // A cut within rounding of an end would leave a sliver on which f is noise.
        let (least, blur) = (a.min(b), 1e-13 * (a.abs() + b.abs()));
        let inner = |cut: &f64| *cut > least + blur && *cut < b - blur;
        let mut ends: Vec<f64> = cuts.iter().copied().filter(inner).chain([a, b]).collect();
        ends.sort_by(f64::total_cmp);
        let pieces: Vec<Piece> = ends.windows(2).map(|pair| self.piece(pair[0], pair[1], f)).collect();
        // A half may be as far off as the whole: the estimate is the error of seven points, far above that of fifteen.
        // Below the floor the estimate is the noise of inner integrals.
        let allowed = self.tolerance.max(FLOOR) * pieces.iter().map(|piece| piece.size).sum::<f64>() + noise;
        pieces.into_iter().map(|piece| self.halved(piece, allowed, 0, f)).sum()
    }

    fn halved(&self, piece: Piece, allowed: f64, depth: u32, f: &dyn Fn(f64) -> f64) -> f64 {
        // No halving helps where f overflows.
        if piece.error <= allowed || !piece.value.is_finite() || depth == DEEPEST || self.late.get() {
            return piece.value;
        }
        let middle = 0.5 * (piece.from + piece.to);
        let halves = [(piece.from, middle), (middle, piece.to)].map(|(from, to)| self.piece(from, to, f));
        halves.into_iter().map(|half| self.halved(half, allowed, depth + 1, f)).sum()
    }

    fn piece(&self, from: f64, to: f64, f: &dyn Fn(f64) -> f64) -> Piece {
        let count = self.pieces.get() + 1;
        self.pieces.set(count % BETWEEN_LOOKS);
        if count == BETWEEN_LOOKS && self.deadline.is_some_and(|deadline| Instant::now() > deadline) {
            self.late.set(true);
        }
        Piece::new(from, to, f)
    }
}

/// The integral of `f` over one piece of the range.
struct Piece {
    from: f64,
    to: f64,
    value: f64,
    /// `∫ |f|`.
    size: f64,
    /// Estimated error of `value`.
    error: f64,
}

impl Piece {
    fn new(from: f64, to: f64, f: &dyn Fn(f64) -> f64) -> Self {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let centre = f(middle);
        let (mut kronrod, mut size, mut gauss) = (KRONROD[7] * centre, KRONROD[7] * centre.abs(), GAUSS[3] * centre);
        for k in 0..7 {
            let (low, high) = (f(middle - half * NODES[k]), f(middle + half * NODES[k]));
            kronrod += KRONROD[k] * (low + high);
            size += KRONROD[k] * (low.abs() + high.abs());
            if k % 2 == 1 {
                gauss += GAUSS[k / 2] * (low + high);
            }
        }
        Piece { from, to, value: kronrod * half, size: size * half, error: (kronrod - gauss).abs() * half }
    }
}

#[cfg(test)]
#[path = "tests/quadrature.rs"]
mod tests;
