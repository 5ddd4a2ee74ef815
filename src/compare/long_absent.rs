//! What stands for `long` in a build without multiple precision: no such value exists, and no route that needs one is
//! taken.

use super::quantity::Question;
use super::route::Route;
use super::value::{Answer, Bounded, NoAnswer, System, Value};
use crate::error::Error;
use crate::number::{Float, Interval, Number, Rational};

pub(crate) const AVAILABLE: bool = false;

pub(crate) type Digits = f64;

#[derive(Clone, Debug)]
pub(crate) enum Long {}

impl Long {
    pub(super) fn to_f64(&self) -> f64 {
        match *self {}
    }

    pub(super) fn log10_radius(&self) -> Option<f64> {
        match *self {}
    }
}

impl std::fmt::Display for Long {
    fn fmt(&self, _: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match *self {}
    }
}

pub(super) fn exact(number: &Number) -> Value {
    Value::Double(number.to_f64())
}

/// Asked only where the difference is not finite.
pub(super) fn log10_apart(_: &Value, _: &Value) -> f64 {
    f64::INFINITY
}

pub(super) fn holds(_: &Value, _: &Value, _: Option<i32>) -> bool {
    false
}

pub(super) fn run(route: Route, _: &Question) -> Result<Answer, NoAnswer> {
    match route {
        Route::LongFormula(_, _, formula) => {
            Ok(Bounded::unbounded(Value::Double(formula(&|p, q| f64::from(p) / f64::from(q)))))
        }
        _ => Err(Error::NoMultiprecision.into()),
    }
}

macro_rules! absent {
    ($($name:ident),*) => {$(
        impl System for $name {
            fn value(self) -> Value {
                match self {}
            }
            fn exponential(&self) -> Option<Self> {
                match *self {}
            }
        }
    )*};
}
absent!(Float, Rational, Interval);
