//! `dalembert sample`.

use clap::{Args, ValueEnum};

use super::{Failure, Format, NumberArgs, OutputArgs, head, source};
use crate::error::Error;
use crate::history::{Ending, History, Side};
use crate::number::{Number, Scalar};
use crate::output::{Head, Quantity, Show, sample, samples_csv, samples_json, samples_table};
use crate::rod::Run;
use crate::scene::Plan;
use crate::solve::{Solution, solve};

/// Values of a quantity at chosen times
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  dalembert sample paper-strong --quantity stress --times 0.3,1.2,2 --side left\n  \
    dalembert sample doyen-ern-piperno --quantity end --times 0..16/3:9 --exact\n  \
    dalembert sample paper-weak --quantity field --times 1/3 --points 0.25,0.9"
)]
pub(super) struct Sample {
    /// A scene file, `-`, or a built-in scene. It is followed as far as the last time, whatever its own run says
    scene: String,
    /// What to sample
    #[arg(long, value_enum)]
    quantity: QuantityArg,
    /// Times: numbers such as 0.3 or 1/3 separated by commas, or A..B:N for N times from A to B
    #[arg(long, value_name = "LIST", value_parser = list, allow_hyphen_values = true)]
    times: List,
    /// Points of the rod for the field, in the same form; by default its two ends and its middle
    #[arg(long, value_name = "LIST", value_parser = list, allow_hyphen_values = true)]
    points: Option<List>,
    /// Which limit where there are two
    #[arg(long, value_enum, default_value_t = SideArg::Right)]
    side: SideArg,
    #[command(flatten)]
    numbers: NumberArgs,
    #[command(flatten)]
    output: OutputArgs,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum QuantityArg {
    /// v_x at the ground
    Stress,
    /// v and v_t of the ground end
    End,
    /// v and v_t of the top
    Top,
    /// h and h′ of the centre of mass
    Centre,
    /// Total, translational and vibrational energy
    Energy,
    /// v, v_t and v_x at points of the rod
    Field,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum SideArg {
    /// The limit from earlier times
    Left,
    /// The limit from later times
    Right,
}

/// The most values that one range may hold.
const MAX_VALUES: u32 = 10_000_000;

/// Numbers, or equally spaced ones.
#[derive(Clone, Debug)]
enum List {
    Numbers(Vec<Number>),
    Range(Number, Number, u32),
}

fn list(text: &str) -> Result<List, String> {
    let number = |text: &str| text.parse::<Number>().map_err(|error| error.to_string());
    let Some((from, rest)) = text.split_once("..") else {
        return Ok(List::Numbers(text.split(',').map(number).collect::<Result<_, _>>()?));
    };
    let (to, count) = rest.split_once(':').ok_or_else(|| format!("found `{text}`, expected A..B:N"))?;
    let count: u32 = count.trim().parse().map_err(|_| format!("found a count `{count}`, expected a whole number"))?;
    if !(2..=MAX_VALUES).contains(&count) {
        return Err(format!("found a count of {count}, expected 2 to {MAX_VALUES}"));
    }
    Ok(List::Range(number(from)?, number(to)?, count))
}

impl List {
    fn greatest(&self) -> Option<Number> {
        let greater = |a: Number, b: &Number| if b.to_f64() > a.to_f64() { b.clone() } else { a };
        match self {
            List::Numbers(numbers) => numbers.iter().cloned().reduce(|a, b| greater(a, &b)),
            List::Range(from, to, _) => Some(greater(from.clone(), to)),
        }
    }

    fn lift<S: Scalar>(&self, precision: &S::Precision) -> Vec<S> {
        match self {
            List::Numbers(numbers) => numbers.iter().map(|number| S::from_number(number, precision)).collect(),
            List::Range(from, to, count) => {
                let (from, to) = (S::from_number(from, precision), S::from_number(to, precision));
                let steps = i64::from(*count) - 1;
                // Weighted so that both ends are met exactly.
                let at = |k: i64| (from.clone() * from.int(steps - k) + to.clone() * to.int(k)) / from.int(steps);
                (0..=steps).map(at).collect()
            }
        }
    }
}

impl Sample {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let mut scene = source::read(&self.scene)?;
        let Some(last) = self.times.greatest() else {
            return Err(miette::miette!("found no times, expected at least one"));
        };
        if self.points.is_some() && !matches!(self.quantity, QuantityArg::Field) {
            return Err(miette::miette!("found --points, expected them with --quantity field only"));
        }
        if last.to_f64() < 0.0 {
            return Err(miette::miette!("found time {last}, expected times from 0 on"));
        }
        scene.problem.run = Run::Time(last);
        let plan = Plan::of(&scene, self.numbers.ask())?;
        let head = head(&scene, &plan);
        let solution = {
            let progress = source::Progress::of(&scene, &plan);
            solve(&scene.problem, &plan, |trip, pieces| progress.observe(trip, pieces))?
        };
        match &solution {
            Solution::Double(history) => self.print(history.as_ref(), &head),
            #[cfg(feature = "mp")]
            Solution::Digits(history, digits) => {
                source::tell_inexact(&scene.problem, &plan);
                self.print(history.as_ref(), &Head { number: format!("{digits} digits"), digits: *digits, ..head })
            }
            #[cfg(feature = "mp")]
            Solution::Exact(history, None) => self.print(history.as_ref(), &head),
            #[cfg(feature = "mp")]
            Solution::Exact(exact, Some((history, digits))) => {
                eprintln!("note: {}; the values are in {digits} digits", exact.ending());
                let (number, exact_until) = (format!("{digits} digits"), Some(exact.ending().clone()));
                self.print(history.as_ref(), &Head { digits: *digits, number, exact_until, ..head })
            }
        }
    }

    fn print<S: Show>(&self, history: &dyn History<S>, head: &Head) -> Result<(), Failure> {
        let length = history.scales().length;
        let precision = length.precision();
        let times = self.times.lift::<S>(&precision);
        let points = match &self.points {
            Some(points) => points.lift::<S>(&precision),
            None => vec![length.zero(), length.clone() / length.int(2), length],
        };
        let quantity = match self.quantity {
            QuantityArg::Stress => Quantity::Stress,
            QuantityArg::End => Quantity::End,
            QuantityArg::Top => Quantity::Top,
            QuantityArg::Centre => Quantity::Centre,
            QuantityArg::Energy => Quantity::Energy,
            QuantityArg::Field => Quantity::Field,
        };
        let side = match self.side {
            SideArg::Left => Side::Left,
            SideArg::Right => Side::Right,
        };
        let samples =
            sample(history, quantity, &times, &points, side).map_err(|error| match (history.ending(), &error) {
                (Ending::ExactnessEnds { .. }, Error::TimeOutside { found, .. }) => {
                    miette::miette!(
                        help = "expected times before it, or --digits N as well, to go on from there in digits",
                        "found time {found}, but {}",
                        history.ending()
                    )
                }
                (ending, Error::TimeOutside { found, .. }) if !matches!(ending, Ending::Time) => {
                    miette::miette!(
                        "found time {found}, expected times up to t = {}: {ending}",
                        history.end().show(head.digits)
                    )
                }
                _ => error.into(),
            })?;
        for warning in history.warnings() {
            eprintln!("warning: {warning}");
        }
        match self.output.format() {
            Format::Table => self.output.write(&samples_table(&samples, quantity, head)),
            Format::Json => self.output.write_json(&samples_json(&samples, quantity, head)),
            Format::Csv => {
                let text = samples_csv(&samples, quantity, head)
                    .map_err(|error| miette::miette!("cannot write CSV: {error}"))?;
                self.output.write(&text)
            }
        }
    }
}
