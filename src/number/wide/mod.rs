//! Floats of a fixed number of limbs on the stack: long numbers in every build, without an allocation.
//!
//! `limbs` has the mantissas, `float` the number, its rounding and its order, `arithmetic` sums, products, quotients
//! and roots, `elementary` the elementary functions, `convert` the way to fractions and back, `system` what the
//! formulas ask of a number, `long` the way to floats of any number of bits.

/// Evaluates an expression for `M = N + 1`, N from 2 to 7: in a limb more than the numbers have.
macro_rules! guarded {
    ($n:expr, $m:ident => $body:expr) => {
        match $n {
            2 => guarded!(@ $m = 3, $body),
            3 => guarded!(@ $m = 4, $body),
            4 => guarded!(@ $m = 5, $body),
            5 => guarded!(@ $m = 6, $body),
            6 => guarded!(@ $m = 7, $body),
            _ => guarded!(@ $m = 8, $body),
        }
    };
    (@ $m:ident = $count:literal, $body:expr) => {{
        const $m: usize = $count;
        $body
    }};
}

pub(crate) use guarded;

mod arithmetic;
mod convert;
mod elementary;
mod float;
mod limbs;
mod long;
mod system;

pub use float::Wide;

#[cfg(test)]
#[path = "tests/arithmetic.rs"]
mod arithmetic_tests;
#[cfg(test)]
#[path = "tests/elementary.rs"]
mod elementary_tests;
