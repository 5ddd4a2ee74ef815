//! Floats of any number of bits on MPFR.

pub use rug::Float;
pub(crate) use rug::float::{Constant, Round};
pub(crate) use rug::ops::Pow;
use rug::ops::{AddAssignRound, AssignRound, SubAssignRound};

use std::cmp::Ordering;

/// Returns `value` in this many bits, rounded in one direction.
pub(crate) fn rounded<T>(bits: u32, value: T, round: Round) -> Float
where
    Float: AssignRound<T, Round = Round, Ordering = Ordering>,
{
    Float::with_val_round(bits, value, round).0
}

pub(crate) fn down<T>(bits: u32, value: T) -> Float
where
    Float: AssignRound<T, Round = Round, Ordering = Ordering>,
{
    rounded(bits, value, Round::Down)
}

pub(crate) fn up<T>(bits: u32, value: T) -> Float
where
    Float: AssignRound<T, Round = Round, Ordering = Ordering>,
{
    rounded(bits, value, Round::Up)
}

/// Returns the sum in the bits of `a`, rounded in one direction, without an allocation.
pub(super) fn sum(mut a: Float, b: &Float, round: Round) -> Float {
    a.add_assign_round(b, round);
    a
}

/// Returns the difference in the bits of `a`, rounded in one direction, without an allocation.
pub(super) fn difference(mut a: Float, b: &Float, round: Round) -> Float {
    a.sub_assign_round(b, round);
    a
}

/// Returns the greatest integer `≤ x`; `None` if it does not fit.
pub(super) fn floor(x: &Float) -> Option<i64> {
    x.to_integer_round(Round::Down).and_then(|(n, _)| n.to_i64())
}
