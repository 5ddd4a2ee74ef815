//! Options that several subcommands share: the numbers of the answer, lists of values, and where the output goes.

use std::path::{Path, PathBuf};

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Arg, Args};

use crate::failure::Failure;
use crate::file::{self, Destination, Format};
use crate::source::{self, AnyScene};
use dalembert::Scene;
use dalembert::number::List;
use dalembert::problem::Parameter;
use dalembert::solve::{CERTIFIED_DIGITS, Numbers};

/// Returns a parser of the words that name the variants of `T`, with their documentation as help.
pub(crate) fn words<T>() -> impl TypedValueParser<Value = T>
where
    &'static str: From<T>,
    T: strum::VariantArray + strum::EnumMessage + std::str::FromStr + Copy + Send + Sync + 'static,
{
    let value = |variant: &T| {
        PossibleValue::new(<&'static str>::from(*variant)).help(variant.get_documentation().unwrap_or(""))
    };
    PossibleValuesParser::new(T::VARIANTS.iter().map(value))
        .try_map(|name| name.parse().map_err(|_| "expected one of the words listed"))
}

/// Returns the change of `--format` to an option that takes the `known` formats.
pub(crate) fn known_formats(known: &'static [Format]) -> impl FnOnce(Arg) -> Arg {
    move |argument| argument.value_parser(file::formats(known))
}

/// Parses a list of numbers, `0.3,1/3` or `A..B:N`. An error shows the grammar.
pub(crate) fn list(text: &str) -> Result<List, String> {
    List::equally_spaced(text)
        .map_err(|error| format!("{error}\n\na list is V1,V2,… such as 0.3,1/3, or A..B:N for N numbers from A to B"))
}

/// Returns a parser that says what was `expected`.
pub(crate) fn expecting<T: std::str::FromStr>(expected: &'static str) -> impl Fn(&str) -> Result<T, String> + Clone {
    move |text| text.parse().map_err(|_| format!("expected {expected}"))
}

/// Runs `work` on `threads` threads, or on one for each core.
pub(crate) fn in_threads<T: Send>(threads: Option<usize>, work: impl FnOnce() -> T + Send) -> Result<T, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).build()?;
    Ok(pool.install(work))
}

/// The numbers of the answer.
#[derive(Args, Clone, Copy, Debug)]
pub(crate) struct NumberArgs {
    /// Decimal digits, rounded from values known to eight more of their scale; with --exact, from where exactness ends
    #[arg(long, value_name = "N", value_parser = expecting::<u32>("a whole number of digits, such as 50"))]
    digits: Option<u32>,
    /// Exact fractions, as far as they reach
    #[arg(long)]
    exact: bool,
    /// Proved digits: every number is enclosed, with as many bits as that takes
    #[arg(long, conflicts_with_all = ["exact", "accuracy"])]
    certified: bool,
    /// Accuracy relative to the greatest number of an answer, such as 1e-10; more bits are taken where doubles do not
    /// reach it
    #[arg(long, value_name = "E", value_parser = expecting::<f64>("a number such as 1e-10"))]
    #[arg(allow_negative_numbers = true, conflicts_with_all = ["digits", "exact"])]
    accuracy: Option<f64>,
}

impl NumberArgs {
    pub(crate) fn is_double(self) -> bool {
        self.digits.is_none() && !self.certified && !self.exact
    }

    /// Returns the requested numbers; without an option, doubles to `default`.
    pub(crate) fn numbers_to(self, default: Option<f64>) -> Numbers {
        match self {
            NumberArgs { certified: true, digits, .. } => Numbers::Certified(digits.unwrap_or(CERTIFIED_DIGITS)),
            NumberArgs { exact: true, digits: None, .. } => Numbers::Exact,
            NumberArgs { exact: true, digits: Some(digits), .. } => Numbers::ExactThenDigits(digits),
            NumberArgs { digits: Some(digits), .. } => Numbers::Digits(digits),
            NumberArgs { accuracy, .. } => Numbers::Double(accuracy.or(default)),
        }
    }
}

/// The body of a chain that is taken as a rod.
#[derive(Args, Clone, Copy, Debug)]
pub(crate) struct BodyArgs {
    /// Take this body of a chain, from 1, the lowest, as a rod: its ground is the body or the stop below it
    #[arg(long, value_name = "N")]
    body: Option<usize>,
}

impl BodyArgs {
    /// Reads the scene called `name`: that of a rod, or of the chosen body of a chain.
    pub(crate) fn read(self, name: &str) -> Result<Scene, Failure> {
        source::read(name)?.into_rod(name, self.body)
    }

    /// Returns the number of the chosen body.
    pub(crate) fn number(self) -> Option<usize> {
        self.body
    }

    /// Reads the scene called `name`: a rod or the chosen body of a chain, or a chain of which no body is chosen.
    pub(crate) fn read_any(self, name: &str) -> Result<AnyScene, Failure> {
        match self.body {
            None => source::read(name),
            Some(_) => self.read(name).map(|scene| AnyScene::Rod(Box::new(scene))),
        }
    }
}

/// A scene, the numbers of its answer, and where that goes.
#[derive(Args, Clone, Debug)]
pub(crate) struct SceneArgs {
    /// A scene file, `-`, or a built-in scene
    pub(crate) scene: String,
    #[command(flatten)]
    pub(crate) body: BodyArgs,
    #[command(flatten)]
    pub(crate) numbers: NumberArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

impl SceneArgs {
    /// Reads the scene, and returns it with the requested numbers.
    pub(crate) fn read(&self) -> Result<(Scene, Numbers), Failure> {
        let scene = self.body.read(&self.scene)?;
        let numbers = self.numbers.numbers_to(scene.accuracy);
        Ok((scene, numbers))
    }
}

/// The format of the output, and the files that it goes to. Each subcommand names the formats that it knows with
/// [`known_formats`].
#[derive(Args, Clone, Debug)]
pub(crate) struct OutputArgs {
    /// Format of the output; by default that of the ending of FILE, or the first of these
    #[arg(long, value_parser = file::formats(&[]))]
    pub(crate) format: Option<Format>,
    /// Write to this file, whole or not at all; its ending chooses the format, and `-` is standard output. Can be given
    /// several times
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
}

impl OutputArgs {
    /// Returns where the output goes: to each file, in the format of its ending or the requested one; without a file
    /// to standard output, in the requested format or the first of `known`.
    pub(crate) fn destinations(&self, known: &[Format]) -> Result<Vec<Destination>, Failure> {
        self.destinations_in(None, known)
    }

    /// Returns [`OutputArgs::destinations`] in the `implied` format where none is requested.
    pub(crate) fn destinations_in(
        &self,
        implied: Option<Format>,
        known: &[Format],
    ) -> Result<Vec<Destination>, Failure> {
        let requested = self.format.or(implied);
        if self.output.is_empty() {
            return Ok(vec![Destination { path: None, format: requested.unwrap_or(known[0]) }]);
        }
        let destination = |path: &PathBuf| {
            let format = file::format(path, requested, known)?;
            Ok(Destination { path: Some(path.clone()).filter(|path| path != Path::new("-")), format })
        };
        self.output.iter().map(destination).collect()
    }

    /// Returns whether any file is named.
    pub(crate) fn is_given(&self) -> bool {
        !self.output.is_empty()
    }
}

/// Refuses a value by which derivatives are asked for twice.
pub(crate) fn each_once(parameters: &[Parameter]) -> Result<(), Failure> {
    let is_twice = |(k, by): &(usize, &Parameter)| parameters[..*k].contains(by);
    match parameters.iter().enumerate().find(is_twice) {
        Some((_, by)) => Err(failure!("found --derivatives {by} twice, expected each once")),
        None => Ok(()),
    }
}
