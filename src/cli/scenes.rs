//! `dalembert scenes`.

use clap::Args;

use super::answer::{Report, answer};
use super::args::OutputArgs;
use super::failure::Failure;
use super::file::{self, Format};
use super::source;
use crate::aligned::table;
use crate::error::Error;
use crate::motion::Motion;
use crate::number::{Number, Scalar};
use crate::output::{Head, targets_data};
use crate::routes::Reached;
use crate::scene::{Target, builtin};
use crate::solve::{Numbers, Question};

/// List the built-in scenes, print one, or hold it against what others have published
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  dalembert scenes ansys-vm265\n  dalembert scenes ansys-vm265 --targets --format json"
)]
pub(super) struct Scenes {
    /// The scene to print; with --targets also a scene file, or `-`
    name: Option<String>,
    /// Print the published values of the scene, its [[target]]s, beside ours
    #[arg(long, requires = "name")]
    targets: bool,
    #[command(flatten)]
    output: OutputArgs,
}

impl Scenes {
    pub(super) fn run(&self) -> Result<(), Failure> {
        if let (true, Some(name)) = (self.targets, &self.name) {
            let scene = source::read(name)?;
            let numbers = Numbers::Double(scene.accuracy.as_ref().map(Number::to_f64));
            return answer(&scene, &Question::run(numbers), &self.output, &Published(&scene.targets));
        }
        if self.output.format.is_some_and(|format| format != Format::Table) {
            return Err(failure!("found --format, expected it with --targets: a list of scenes is a text"));
        }
        let text = match &self.name {
            None => {
                let rows = builtin::ALL.iter().map(|scene| vec![scene.name.to_string(), scene.summary.to_string()]);
                table(&["scene", "what it shows"], rows.collect(), 2) + "\n"
            }
            Some(name) => match builtin::get(name) {
                Some(scene) => scene.source.to_string(),
                None => {
                    let failure = failure!("found no built-in scene called `{name}`");
                    return Err(failure.help("expected one of the names that `dalembert scenes` lists"));
                }
            },
        };
        self.output.write(text.as_bytes())
    }
}

/// The published values of a scene beside ours.
struct Published<'a>(&'a [Target]);

impl Report for Published<'_> {
    type Data<S: Scalar> = Vec<Reached<S>>;

    fn gather<S: Scalar>(&self, history: &dyn Motion<S>, head: &Head) -> Result<Self::Data<S>, Error> {
        Reached::all(history, self.0, &head.units)
    }

    /// None: values of very different size would be held to the digits of the greatest.
    fn numbers<'a, S: Scalar>(&self, _: &'a Self::Data<S>) -> Vec<&'a S> {
        Vec::new()
    }

    fn bytes<S: Scalar>(&self, reached: &Self::Data<S>, head: &Head, format: Format) -> Result<Vec<u8>, Failure> {
        file::rows(&targets_data(reached, head), format)
    }
}
