//! Adaptive Gauss–Kronrod quadrature, with a deadline.

use std::cell::Cell;
use std::time::{Duration, Instant};

/// Gauss–Kronrod: positive nodes, Kronrod weights, and the weights of the seven Gauss nodes among them.
#[rustfmt::skip]
const NODES: [f64; 8] = [
    0.991_455_371_120_812_6, 0.949_107_912_342_758_5, 0.864_864_423_359_769_1, 0.741_531_185_599_394_4,
    0.586_087_235_467_691_1, 0.405_845_151_377_397_2, 0.207_784_955_007_898_47, 0.0,
];
#[rustfmt::skip]
const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_224, 0.063_092_092_629_978_56, 0.104_790_010_322_250_19, 0.140_653_259_715_525_92,
    0.169_004_726_639_267_9, 0.190_350_578_064_785_4, 0.204_432_940_075_298_89, 0.209_482_141_084_727_82,
];
const GAUSS: [f64; 4] =
    [0.129_484_966_168_869_7, 0.279_705_391_489_276_64, 0.381_830_050_505_118_9, 0.417_959_183_673_469_4];
/// Halvings of one piece.
const DEEPEST: u32 = 16;
/// No integral is asked for more than this, relative.
const FLOOR: f64 = 1e-13;
/// Pieces between two looks at the clock.
const BETWEEN_LOOKS: u32 = 256;

/// Integrals to a relative tolerance, until a deadline.
#[derive(Debug)]
pub struct Quadrature {
    tolerance: f64,
    deadline: Option<Instant>,
    pieces: Cell<u32>,
    late: Cell<bool>,
}

impl Quadrature {
    pub fn new(tolerance: f64) -> Self {
        Quadrature { tolerance, deadline: None, pieces: Cell::new(0), late: Cell::new(false) }
    }

    /// The same, for no longer than `seconds` from now.
    pub fn limited_to(mut self, seconds: f64) -> Self {
        self.deadline = Instant::now().checked_add(Duration::from_secs_f64(seconds.clamp(0.0, 1e6)));
        self
    }

    /// Whether the deadline has cut an integral short.
    pub fn is_late(&self) -> bool {
        self.late.get()
    }

    /// `∫ f` over `[a,b]`, cut at `cuts`, to the tolerance of `∫|f|` and not below `noise`, the rounding error of f.
    pub fn integral(&self, [a, b]: [f64; 2], cuts: &[f64], noise: f64, f: &dyn Fn(f64) -> f64) -> f64 {
        // A cut within rounding of an end would leave a sliver on which f is noise.
        let (least, blur) = (a.min(b), 1e-13 * (a.abs() + b.abs()));
        let inner = |cut: &f64| *cut > least + blur && *cut < b - blur;
        let mut ends: Vec<f64> = cuts.iter().copied().filter(inner).chain([a, b]).collect();
        ends.sort_by(f64::total_cmp);
        let pieces: Vec<Piece> = ends.windows(2).map(|pair| self.piece(pair[0], pair[1], f)).collect();
        // Halves as good as the whole may be: the estimate is that of the seven-point rule, far above the error of the
        // fifteen. Below the floor it is the noise of the integrals within.
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
        Piece::of(from, to, f)
    }
}

/// `∫ f` and `∫ |f|` over a piece, and an estimate of the error of the first.
struct Piece {
    from: f64,
    to: f64,
    value: f64,
    size: f64,
    error: f64,
}

impl Piece {
    fn of(from: f64, to: f64, f: &dyn Fn(f64) -> f64) -> Self {
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
