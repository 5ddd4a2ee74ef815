//! `dalembert cost`.

use std::path::PathBuf;

use clap::Args;

use crate::args::{NumberArgs, quantity};
use crate::failure::Failure;
use crate::file::{self, Format, ROWS, ROWS_OR_PICTURE, formats};
use crate::output::{cost_data, cost_svg, effects_data};
use crate::source;
use dalembert::number::Number;
use dalembert::quantity::{Measure, Quantity};
use dalembert_plot::draw::Size;
use dalembert_verify::RouteQuestion;
use dalembert_verify::cost;

#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  dalembert cost figure-4-r02 --quantity e_E2 -o cost.svg\n  \
    dalembert cost figure-4-r02 --quantity energy --time 2 --seconds 60\n  \
    dalembert cost doyen-ern-piperno --effects")]
pub(crate) struct Cost {
    /// A scene file, `-`, or a built-in scene
    scene: String,
    /// What is asked of every route; by default the bounce time, or the last event of a scene with several impacts
    #[arg(long, value_parser = quantity())]
    quantity: Option<Quantity>,
    /// Time of a quantity that has a value at every time; by default three quarters of a round trip, or, if the quantity is
    /// zero then, the middle of the first contact or flight in which it is not
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    time: Option<Number>,
    /// Instead: what each effect of the scene costs, and that those it does not call for cost nothing
    #[arg(long)]
    effects: bool,
    /// About how long to measure
    #[arg(long, value_name = "S", default_value_t = 10.0, allow_negative_numbers = true)]
    seconds: f64,
    #[command(flatten)]
    numbers: NumberArgs,
    /// What to print; by default a table
    #[arg(long, value_parser = formats(ROWS))]
    format: Option<Format>,
    /// Write to this file, whole or not at all: a picture (.svg, .png, .pdf), .json, .csv, or a table; `-` is standard
    /// output. Can be given several times. Beside pictures the rows are printed as well
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
}

impl Cost {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let scene = source::read(&self.scene)?;
        // Before ten seconds are spent.
        self.check()?;
        let title = scene.title.as_deref();
        let bar = source::bar(Some(1000), "{bar:40} {percent} %, {msg}");
        let observe = |share: f64, what: &str| {
            bar.set_message(what.to_string());
            bar.set_position((1000.0 * share.min(1.0)) as u64);
        };
        let (data, svg) = if self.effects {
            let of_energy = |quantity: Quantity| {
                quantity.measure() == Some(Measure::Energy) || quantity == Quantity::EnergyRestitution
            };
            let energies = self.quantity.is_some_and(of_energy);
            (effects_data(&cost::effects(&scene, energies, self.seconds, observe)?, title), None)
        } else {
            let question = RouteQuestion::from_scene(&scene, self.quantity, self.time.clone())?;
            let plan = question.plan(self.numbers.numbers(&scene))?;
            let table = cost::work_precision(&question, &plan, self.seconds, observe)?;
            (cost_data(&table, title), Some(cost_svg(&table, title)))
        };
        bar.finish_and_clear();
        file::write_each(&self.output, self.format, |format| match &svg {
            Some(svg) if format.is_picture() => file::picture(format, svg.clone(), Size::Page),
            _ => file::rows(&data, format),
        })
    }

    fn check(&self) -> Result<(), Failure> {
        self.output.iter().try_for_each(|path| match Format::of(Some(path), self.format, ROWS_OR_PICTURE)? {
            format if format.is_picture() && self.effects => {
                Err(failure!("found --effects with {}, expected a table, JSON or CSV", path.display()))
            }
            _ => Ok(()),
        })
    }
}
