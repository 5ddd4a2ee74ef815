//! `dalembert sample`.

use clap::Args;

use crate::answer::{Visit, gathered, print, solve};
use crate::args::words;
use crate::args::{NumberArgs, OutputArgs};
use crate::failure::Failure;
use crate::file;
use crate::output::{Head, Quantity, Samples, samples, samples_data, shared};
use crate::source;
use dalembert::Error;
use dalembert::engine::Motion;
use dalembert::number::{List, Scalar};
use dalembert::problem::Parameter;
use dalembert::solve::{Question, Target, TypedHistory};
use dalembert::{Ending, Side};

#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  dalembert sample paper-strong --quantity stress --times 0.3,1.2,2 --side left\n  \
    dalembert sample doyen-ern-piperno --quantity end,energy --times 0..16/3:9 --exact\n  \
    dalembert sample paper-weak --quantity field --times 1/3 --points 0.25,0.9\n  \
    dalembert sample figure-4-r02 --quantity stress --times 0.1,0.3 --derivatives speed,damping"
)]
pub(crate) struct Sample {
    /// A scene file, `-`, or a built-in scene. It is followed as far as the last time, whatever its own run says
    scene: String,
    /// What to sample: one, or several over time with commas between them, whose columns are then named as in reference
    #[arg(long, value_enum, value_delimiter = ',', required = true)]
    quantity: Vec<Quantity>,
    /// Times: numbers such as 0.3 or 1/3 separated by commas, or A..B:N for N times from A to B
    #[arg(long, value_name = "LIST", value_parser = List::equally_spaced, allow_hyphen_values = true)]
    times: List,
    /// Points of the rod for the field, in the same form; by default its two ends and its middle
    #[arg(long, value_name = "LIST", value_parser = List::equally_spaced, allow_hyphen_values = true)]
    points: Option<List>,
    /// Which limit where there are two
    #[arg(long, value_parser = words::<Side>(), default_value_t)]
    side: Side,
    /// Derivatives of the values by values of the scene, as with solve; time and point stay where they are
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    derivatives: Vec<Parameter>,
    #[command(flatten)]
    numbers: NumberArgs,
    #[command(flatten)]
    output: OutputArgs,
}

impl Sample {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let scene = source::read(&self.scene)?;
        let (Some(first), Some(last)) = (self.times.least(), self.times.greatest()) else {
            return Err(failure!("found no times, expected at least one"));
        };
        let of_field = self.quantity.contains(&Quantity::Field);
        if self.points.is_some() && !of_field {
            return Err(failure!("found --points, expected them with --quantity field only"));
        }
        if of_field && self.quantity.len() > 1 {
            return Err(failure!(
                "found field beside others, expected it alone: its rows are points, theirs are times"
            ));
        }
        if let Some(k) = (1..self.quantity.len()).find(|k| self.quantity[..*k].contains(&self.quantity[*k])) {
            return Err(failure!("found --quantity {} twice, expected each once", self.quantity[k].name()));
        }
        if last.to_f64() < 0.0 {
            return Err(failure!("found time {last}, expected times from 0 on"));
        }
        solve(&scene, &Question::between(first, last, self.numbers.numbers(&scene)), self)
    }

    fn gather<S: Scalar>(&self, history: &dyn Motion<S>, head: &Head) -> Result<(Samples, Vec<S>), Error> {
        let length = history.scales().length;
        let precision = length.precision();
        let points = match &self.points {
            Some(points) => points.lift::<S>(&precision),
            None => vec![length.zero(), length.clone() / length.int(2), length],
        };
        samples(history, &self.quantity, (&self.times.lift(&precision), &points), self.side, head)
    }
}

impl Visit for Sample {
    fn visit<S: Target>(
        &self,
        history: &TypedHistory<S>,
        head: Head,
        progress: source::Progress,
    ) -> Result<(), Failure> {
        let head = Head { wide: self.output.wide, ..head };
        let mut samples = gathered(history, &progress, |motion| self.gather(motion, &head))?;
        for by in self.derivatives.iter().copied() {
            let too_long = || Error::Derivative { parameter: by.name(), expected: "times and points of fewer digits" };
            let points = match (&self.points, &self.quantity[..]) {
                (Some(points), _) => points.numbers(),
                (None, [Quantity::Field]) => List::Range(0.into(), history.problem().rod.length.clone(), 3).numbers(),
                (None, _) => Some(Vec::new()),
            };
            let (times, points) = self.times.numbers().zip(points).ok_or_else(too_long)?;
            let found = history.derivatives_at(by, &samples.quantities, &times, &points, self.side)?;
            samples.derivatives.push((by, shared(found)));
        }
        let head = Head { warnings: history.warnings(), ..head };
        print(&self.output, head, progress, |head, format| file::rows(&samples_data(samples, head), format))?;
        // Where that is not for the time asked for, as at rest.
        if !matches!(history.ending(), Ending::Time | Ending::NextImpact) {
            eprintln!("note: {}", history.ending());
        }
        Ok(())
    }
}
