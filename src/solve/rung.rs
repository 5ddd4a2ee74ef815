//! Rungs of the ladder: the numbers of one attempt each.

use serde::Serialize;

use super::question::Numbers;
use crate::number::bits_for_digits;

/// The numbers of one attempt, in the order of their cost.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, strum::Display)]
#[serde(rename_all = "snake_case")]
pub enum Rung {
    /// Doubles with their error bound.
    #[strum(to_string = "doubles")]
    Double,
    /// Numbers of this many bits with their error bound.
    #[strum(to_string = "numbers of {0} bits")]
    Bits(u32),
    /// Fractions.
    #[strum(to_string = "fractions")]
    Fractions,
    /// Doubles, confirmed by enclosures of this many bits with the same events.
    #[strum(to_string = "doubles that enclosures of {0} bits confirm")]
    Confirmed(u32),
    /// Enclosures of this many bits, with exact roots inside if the rod is undamped.
    #[strum(to_string = "enclosures of {0} bits")]
    Enclosures(u32),
}

/// Deficit of an attempt.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Lacks {
    /// Approximate number of missing bits.
    Bits(f64),
    /// Numbers that are equal, not merely within their bounds.
    Exactness,
}

/// Minimum bits of a number with an error bound that follows doubles.
pub(super) const FEWEST_BITS: u32 = 128;
/// Bits of the numbers on the stack.
const SIZES: [u32; 3] = [128, 256, 384];
/// Bits by which such numbers may be shorter than planned; guard bits are several times as many.
const SHORTER: u32 = 8;
/// Maximum bits of a number with an error bound.
pub(super) const MOST_BITS: u32 = 1 << 22;
/// Bits of the enclosures that decide whether events of a chain coincide.
const DECIDING_BITS: u32 = 256;
/// Accuracy, as that of pictures, from which on numbers on the stack answer what stays in doubt.
pub(super) const COARSE: f64 = 1e-6;
/// Bits that a run of a chain in digits has beyond those of its digits.
const SPARE_BITS: u32 = 64;

/// Whether answers in doubles may take numbers of any length, and enclosures. The tests inside the library leave them
/// out, to shorten their build; `tests/suite` has them.
pub(crate) const LONG: bool = cfg!(feature = "long") && !cfg!(test);
/// Maximum bits of the numbers that may follow doubles; those of doubles if none may.
pub(super) const LONGEST: u32 = match (LONG, cfg!(feature = "wide") && !cfg!(test)) {
    (true, _) => MOST_BITS,
    (false, true) => FEWEST_BITS,
    (false, false) => f64::MANTISSA_DIGITS,
};

impl Rung {
    /// Returns the bits of the significand; those of a double for fractions.
    pub(super) fn bits(self) -> u32 {
        match self {
            Rung::Bits(bits) | Rung::Confirmed(bits) | Rung::Enclosures(bits) => bits,
            Rung::Double | Rung::Fractions => f64::MANTISSA_DIGITS,
        }
    }
}

/// Returns the bits of the shortest numbers on the stack with at least `bits − SHORTER`, or `bits` if there are none.
pub(super) fn size(bits: u32) -> u32 {
    SIZES.into_iter().find(|size| bits <= size + SHORTER).unwrap_or(bits)
}

/// Returns the numbers of the attempts at a chain, in order.
pub(crate) fn rungs(numbers: Numbers) -> Vec<Rung> {
    let long = |bits: u32| [Rung::Bits(bits), Rung::Enclosures(bits.max(DECIDING_BITS)), Rung::Bits(2 * bits + 256)];
    let bits = |digits: u32| bits_for_digits(digits) + SPARE_BITS;
    match numbers {
        Numbers::Double(_) if !LONG => vec![Rung::Double, Rung::Fractions],
        Numbers::Double(accuracy) => {
            let is_coarse = accuracy.is_some_and(|accuracy| accuracy >= COARSE);
            let last = Rung::Bits(if is_coarse { DECIDING_BITS } else { 2 * DECIDING_BITS });
            vec![Rung::Double, Rung::Fractions, Rung::Bits(128), Rung::Enclosures(DECIDING_BITS), last]
        }
        Numbers::Exact => vec![Rung::Fractions],
        Numbers::Digits(digits) => long(bits(digits)).into(),
        Numbers::ExactThenDigits(digits) => [Rung::Fractions].into_iter().chain(long(bits(digits))).collect(),
        Numbers::Certified(digits) => [1, 2, 4].map(|times| Rung::Enclosures(times * bits(digits))).into(),
    }
}
