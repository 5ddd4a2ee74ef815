//! Events at the ground that the error bound leaves open: touches that may be misses, releases that may not occur.
//!
//! A function `f` is known within a bound. A touch or a release is decided where `f` passes through the whole bound on
//! one stretch on which its derivative has one sign beyond its own bound; there is none where `f` stays clear of the
//! bound. Anything else is open: the true motion may have an event that the computed motion lacks, or the reverse.

use super::series::{Basis, at_zero, derivative, spread};
use crate::number::Rounded;

/// Length, in strips, below which a stretch is not halved, followed by the maximum number of stretches of a strip.
const SHORTEST: f64 = 1e-14;
const MOST_PARTS: usize = 1000;

/// Restricts series to the two halves of the unit interval; the later half comes first.
fn halves<S: Rounded, const N: usize>(basis: &Basis<S>, series: &[Vec<S>; N]) -> [[Vec<S>; N]; 2] {
    let zero = series[0][0].zero();
    let (half, one) = (zero.ratio(1, 2), zero.one());
    let part = |from: &S, to: &S| std::array::from_fn(|k| basis.restrict(&series[k], from, to, series[k].len()));
    [part(&half, &one), part(&zero, &half)]
}

/// Returns whether the derivative is positive throughout.
fn increases<S: Rounded>(c: &[S]) -> bool {
    let slope = derivative(c);
    slope.first().is_some_and(|mean| mean.to_f64() > spread(&slope))
}

/// Result of a test of a part of a strip.
enum Told {
    /// No event occurs in the part.
    Clear,
    /// The event occurs in the part; the rest of the strip is not tested.
    Over,
    /// The part is undecided; its halves may be decided.
    Open,
}

/// Returns the start, in strips, of the first part that `told` leaves open at the smallest size.
fn open<S: Rounded, const N: usize>(
    basis: &Basis<S>,
    series: [Vec<S>; N],
    mut told: impl FnMut(f64, &[Vec<S>; N]) -> Told,
) -> Option<f64> {
    let mut parts = vec![(0.0, 1.0, series)];
    let mut count = 0;
    while let Some((from, width, series)) = parts.pop() {
        count += 1;
        match told(from, &series) {
            Told::Clear => continue,
            Told::Over => return None,
            Told::Open if width < SHORTEST || count > MOST_PARTS => return Some(from),
            Told::Open => {}
        }
        let width = 0.5 * width;
        let [late, early] = halves(basis, &series);
        parts.push((from + width, width, late));
        parts.push((from, width, early));
    }
    None
}

/// Returns the first place in the strip, as a fraction of it, where a touch of the flying end is undecided. `height`
/// and its derivative `trace` are known within `high` and `fast`. `rising` is true while the end has only risen since
/// the release and is not yet clear of the ground.
pub(super) fn open_touch<S: Rounded>(
    basis: &Basis<S>,
    (height, trace): (&[S], &[S]),
    (high, fast): (f64, f64),
    rising: &mut bool,
) -> Option<f64> {
    open(basis, [height.to_vec(), trace.to_vec()], |_, [height, trace]| {
        let (middle, reach) = (height[0].to_f64(), spread(height));
        if middle - reach > high {
            *rising = false;
            return Told::Clear;
        }
        if middle + reach < -high {
            return Told::Over;
        }
        let start = at_zero(height, &height[0].zero()).to_f64();
        let (middle, reach) = (trace[0].to_f64(), spread(trace));
        if *rising && (middle - reach > fast || increases(trace)) {
            return Told::Clear;
        }
        if start > high && (middle - reach).max(-middle - reach) > fast {
            *rising = false;
            return Told::Clear;
        }
        if !*rising && middle + reach < -fast { Told::Clear } else { Told::Open }
    })
}

/// Returns the first place in the strip, as a fraction of it, where a release is undecided. The stress `trace` is known
/// within `off`. `begins` is true where the stress may fall from zero by construction.
pub(super) fn open_release<S: Rounded>(basis: &Basis<S>, trace: &[S], off: f64, mut begins: bool) -> Option<f64> {
    // Before the first wave arrives, and without weight, the stress is exactly zero.
    if trace.iter().all(S::is_zero) {
        return None;
    }
    open(basis, [trace.to_vec()], |from, [trace]| {
        let (middle, reach) = (trace[0].to_f64(), spread(trace));
        if middle + reach < -off {
            begins = false;
            return Told::Clear;
        }
        if middle - reach > off {
            return Told::Over;
        }
        let pressed = from > 0.0 || at_zero(trace, &trace[0].zero()).to_f64() < -off;
        let falls = || increases(&trace.iter().map(|term| -term.clone()).collect::<Vec<_>>());
        let told = (pressed || begins) && increases(trace) || begins && falls();
        if told { Told::Clear } else { Told::Open }
    })
}
