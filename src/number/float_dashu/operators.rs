//! Operators, comparisons and text of floats.

use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Shl, Shr, ShrAssign, Sub, SubAssign};

use super::operation::{Function, Operation};
use super::{Finite, Float, Infinite, Nan, Rational, Round, round};

impl Neg for Float {
    type Output = Float;
    fn neg(self) -> Float {
        let value = match self.value {
            Nan => Nan,
            Infinite(sign) => Infinite(-sign),
            Finite(mantissa, exponent) => Finite(-mantissa, exponent),
        };
        Float { value, ..self }
    }
}

impl Neg for &Float {
    type Output = Float;
    fn neg(self) -> Float {
        -self.clone()
    }
}

macro_rules! arithmetic {
    ($($trait:ident $method:ident $assign:ident $assign_method:ident),*) => {$(
        impl<'a> $trait<&'a Float> for &'a Float {
            type Output = Operation<'a>;
            fn $method(self, other: &'a Float) -> Operation<'a> {
                Operation(Function::$trait, self, other)
            }
        }

        impl $trait<&Float> for Float {
            type Output = Float;
            fn $method(self, other: &Float) -> Float {
                Float::with_val(self.bits, $trait::$method(&self, other))
            }
        }

        impl $assign<&Float> for Float {
            fn $assign_method(&mut self, other: &Float) {
                *self = Float::with_val(self.bits, $trait::$method(&*self, other));
            }
        }

        arithmetic!(@value $trait $method $assign $assign_method, Float |other| other);
        arithmetic!(@value $trait $method $assign $assign_method, u32 |other| Float::with_val(32, other));
        arithmetic!(@value $trait $method $assign $assign_method, i64 |other| Float::with_val(64, other));
    )*};
    (@value $trait:ident $method:ident $assign:ident $assign_method:ident, $type:ty |$value:ident| $float:expr) => {
        impl $trait<$type> for Float {
            type Output = Float;
            fn $method(self, $value: $type) -> Float {
                $trait::$method(self, &$float)
            }
        }

        impl $assign<$type> for Float {
            fn $assign_method(&mut self, $value: $type) {
                $assign::$assign_method(self, &$float);
            }
        }
    };
}
arithmetic!(Add add AddAssign add_assign, Sub sub SubAssign sub_assign, Mul mul MulAssign mul_assign);
arithmetic!(Div div DivAssign div_assign);

macro_rules! shifts {
    ($($trait:ident $method:ident $type:ty: |$by:ident| $change:expr),*) => {$(
        impl $trait<$type> for Float {
            type Output = Float;
            fn $method(self, $by: $type) -> Float {
                match self.value {
                    Finite(mantissa, exponent) => {
                        round(mantissa, exponent.saturating_add($change), self.bits, Round::Nearest)
                    }
                    value => Float { value, ..self },
                }
            }
        }
    )*};
}
shifts!(Shl shl u32: |by| i64::from(by), Shr shr u32: |by| -i64::from(by), Shl shl i32: |by| i64::from(by));

impl ShrAssign<u32> for Float {
    fn shr_assign(&mut self, by: u32) {
        *self = self.clone() >> by;
    }
}

impl PartialEq for Float {
    fn eq(&self, other: &Self) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl PartialOrd for Float {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        let (ours, theirs) = (self.kind(), other.kind());
        match (self.finite(), other.finite()) {
            (Some((m, e)), Some((n, f))) if ours == theirs && ours != 0.0 => {
                let (a, b) = if ours < 0.0 { (other, self) } else { (self, other) };
                let least = e.min(f);
                let in_full = || (m << (e - least) as usize).cmp(&(n << (f - least) as usize));
                Some(a.top().cmp(&b.top()).then_with(in_full))
            }
            _ => ours.partial_cmp(&theirs),
        }
    }
}

macro_rules! comparable {
    ($($type:ty: |$value:ident| $float:expr),*) => {$(
        impl PartialEq<$type> for Float {
            fn eq(&self, $value: &$type) -> bool {
                *self == $float
            }
        }

        impl PartialOrd<$type> for Float {
            fn partial_cmp(&self, $value: &$type) -> Option<Ordering> {
                self.partial_cmp(&$float)
            }
        }
    )*};
}
comparable!(i32: |n| Float::with_val(32, *n), u64: |n| Float::with_val(64, *n), f64: |x| Float::with_val(53, *x));

impl PartialEq<Rational> for Float {
    fn eq(&self, other: &Rational) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl PartialOrd<Rational> for Float {
    fn partial_cmp(&self, other: &Rational) -> Option<Ordering> {
        let infinite = || self.partial_cmp(&0);
        self.to_rational().map_or_else(infinite, |own| own.partial_cmp(other))
    }
}

impl fmt::Display for Float {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.to_string_radix(10, None))
    }
}
