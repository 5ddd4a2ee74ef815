//! What several subcommands are asked: in which numbers, and where their output goes.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use super::failure::Failure;
use super::file::{self, Format, ROWS, formats};
use crate::quantity::Quantity;
use crate::scene::Scene;
use crate::solve::{CERTIFIED_DIGITS, Numbers};

/// The name of a quantity that is one number.
pub(super) fn quantity() -> impl TypedValueParser<Value = Quantity> {
    let value =
        |quantity: Quantity| PossibleValue::new(quantity.name()).aliases(quantity.also()).help(quantity.meaning());
    PossibleValuesParser::new(Quantity::singles().map(value))
        .try_map(|name| Quantity::single(&name).ok_or("expected a quantity"))
}

/// How exact the numbers are to be.
#[derive(Args, Clone, Copy, Debug)]
pub(super) struct NumberArgs {
    /// Decimal digits, rounded from values known to eight more of their scale; with --exact, from where exactness ends
    #[arg(long, value_name = "N", value_parser = digits)]
    digits: Option<u32>,
    /// Exact fractions, as far as they reach
    #[arg(long)]
    exact: bool,
    /// Proved digits: everything is enclosed, with as many bits as that takes
    #[arg(long, conflicts_with_all = ["exact", "accuracy"])]
    certified: bool,
    /// Accuracy relative to the greatest number of an answer, such as 1e-10; more bits are taken where doubles do not
    /// reach it
    #[arg(long, value_name = "E", value_parser = accuracy, conflicts_with_all = ["digits", "exact"])]
    accuracy: Option<f64>,
}

fn digits(text: &str) -> Result<u32, String> {
    text.parse().map_err(|_| "expected a whole number of digits, such as 50".into())
}

fn accuracy(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| "expected a number such as 1e-10".into())
}

impl NumberArgs {
    pub(super) fn in_doubles(self) -> bool {
        self.digits.is_none() && !self.certified && !self.exact
    }

    /// The numbers that are asked for; without an option, doubles to the accuracy of the scene.
    pub(super) fn numbers(self, scene: &Scene) -> Numbers {
        match self {
            NumberArgs { certified: true, digits, .. } => Numbers::Certified(digits.unwrap_or(CERTIFIED_DIGITS)),
            NumberArgs { exact: true, digits: None, .. } => Numbers::Exact,
            NumberArgs { exact: true, digits: Some(digits), .. } => Numbers::ExactThenDigits(digits),
            NumberArgs { digits: Some(digits), .. } => Numbers::Digits(digits),
            NumberArgs { accuracy, .. } => Numbers::Double(accuracy.or(scene.accuracy)),
        }
    }
}

/// Where the output goes and what it looks like.
#[derive(Args, Clone, Debug)]
pub(super) struct OutputArgs {
    /// What to print; by default a table, or what the ending of FILE says
    #[arg(long, value_parser = formats(ROWS))]
    pub(super) format: Option<Format>,
    /// Write to this file, whole or not at all; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// One row for each contact or effect, however wide the table
    #[arg(long)]
    pub(super) wide: bool,
}

impl OutputArgs {
    /// What is printed: what is asked for, or what the ending of the file says.
    pub(super) fn format(&self) -> Result<Format, Failure> {
        Format::of(self.output.as_deref(), self.format, ROWS)
    }

    pub(super) fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        file::write(self.output.as_deref(), bytes)
    }
}
