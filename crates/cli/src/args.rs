//! What several subcommands are asked: in which numbers, and where their output goes.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use super::failure::Failure;
use super::file::{self, Format, ROWS, formats};
use dalembert::Scene;
use dalembert::quantity::Quantity;
use dalembert::solve::{CERTIFIED_DIGITS, Numbers};

/// The name of a quantity that is one number.
pub(crate) fn quantity() -> impl TypedValueParser<Value = Quantity> {
    let value =
        |quantity: Quantity| PossibleValue::new(quantity.name()).aliases(quantity.also()).help(quantity.meaning());
    PossibleValuesParser::new(Quantity::singles().map(value))
        .try_map(|name| Quantity::single(&name).ok_or("expected a quantity"))
}

/// Parser of the words that name the variants of `T`, with their documentation as help.
pub(crate) fn words<T>() -> impl TypedValueParser<Value = T>
where
    &'static str: From<T>,
    T: strum::VariantArray
        + strum::EnumMessage
        + std::str::FromStr
        + Copy
        + Into<&'static str>
        + std::fmt::Display
        + Send
        + Sync
        + 'static,
{
    let value = |variant: &T| {
        PossibleValue::new(<&'static str>::from(*variant)).help(variant.get_documentation().unwrap_or(""))
    };
    PossibleValuesParser::new(T::VARIANTS.iter().map(value))
        .try_map(|name| name.parse().map_err(|_| "expected one of the words listed"))
}

/// Runs `work` on `threads` threads, or on one for each core.
pub(crate) fn in_threads<T: Send>(threads: Option<usize>, work: impl FnOnce() -> T + Send) -> Result<T, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).build()?;
    Ok(pool.install(work))
}

/// How exact the numbers are to be.
#[derive(Args, Clone, Copy, Debug)]
pub(crate) struct NumberArgs {
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
    pub(crate) fn in_doubles(self) -> bool {
        self.digits.is_none() && !self.certified && !self.exact
    }

    /// The numbers that are asked for; without an option, doubles to the accuracy of the scene.
    pub(crate) fn numbers(self, scene: &Scene) -> Numbers {
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
pub(crate) struct OutputArgs {
    /// What to print; by default a table, or what the ending of FILE says
    #[arg(long, value_parser = formats(ROWS))]
    pub(crate) format: Option<Format>,
    /// Write to this file, whole or not at all; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// One row for each contact or effect, however wide the table
    #[arg(long)]
    pub(crate) wide: bool,
}

impl OutputArgs {
    /// What is printed: what is asked for, or what the ending of the file says.
    pub(crate) fn format(&self) -> Result<Format, Failure> {
        Format::of(self.output.as_deref(), self.format, ROWS)
    }

    pub(crate) fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        file::write(self.output.as_deref(), bytes)
    }
}
