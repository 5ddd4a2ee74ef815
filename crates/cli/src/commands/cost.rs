//! `dalembert cost`.

use clap::Args;

use crate::args::{SceneArgs, known_formats};
use crate::failure::Failure;
use crate::file::{self, ROWS, ROWS_OR_PICTURE, write_with_rows};
use crate::output::{cost_data, cost_svg, effects_data, rows_bytes};
use crate::quantities::{NameParser, Scope, has_material};
use crate::terminal;
use dalembert::number::Number;
use dalembert::quantity::{Measure, Quantity};
use dalembert_plot::draw::Size;
use dalembert_verify::RouteQuestion;
use dalembert_verify::cost;

#[derive(Args, Debug)]
#[command(mut_arg("format", known_formats(ROWS)))]
#[command(after_help = "Examples:\n  dalembert cost figure-4-r02 --quantity e_E2 -o cost.svg\n  \
    dalembert cost figure-4-r02 --quantity energy --time 2 --seconds 60\n  \
    dalembert cost doyen-ern-piperno --effects\n\nBeside a picture the table is printed as well.")]
pub(crate) struct Cost {
    #[command(flatten)]
    scene: SceneArgs,
    /// The quantity that every route computes, or a group, which stands for its first one; by default the bounce time,
    /// or the last event of a scene with several impacts
    #[arg(long, value_parser = NameParser::new(&[Scope::SingleNumber], []))]
    quantity: Option<String>,
    /// The time of a quantity over time; by default three quarters of a round trip, or, if the quantity is zero then,
    /// the middle of the first contact or flight in which it is not
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    time: Option<Number>,
    /// Instead: the cost of each effect of the scene, and that effects which it does not call for cost nothing
    #[arg(long)]
    effects: bool,
    /// Seconds to measure, about
    #[arg(long, value_name = "S", default_value_t = 10.0, allow_negative_numbers = true)]
    seconds: f64,
}

impl Cost {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let (scene, numbers) = self.scene.read()?;
        let destinations = self.scene.output.destinations(ROWS_OR_PICTURE)?;
        if self.effects && destinations.iter().any(|destination| destination.format.is_picture()) {
            return Err(failure!("found --effects with a picture, expected a table, JSON or CSV"));
        }
        let names: Vec<String> = self.quantity.iter().cloned().collect();
        let quantity = Scope::SingleNumber.resolve(&names, has_material(&scene))?.first().copied();
        let title = scene.title.as_deref();
        let bar = terminal::bar(Some(1000), "{bar:40} {percent} %, {msg}");
        let observe = |share: f64, what: &str| {
            bar.set_message(what.to_string());
            bar.set_position((1000.0 * share.min(1.0)) as u64);
        };
        let (data, svg) = if self.effects {
            let is_of_energy = |quantity: Quantity| {
                quantity.measure() == Some(Measure::Energy) || quantity == Quantity::EnergyRestitution
            };
            let energies = quantity.is_some_and(is_of_energy);
            (effects_data(&cost::effects(&scene, energies, self.seconds, observe)?, title), None)
        } else {
            let question = RouteQuestion::from_scene(&scene, quantity, self.time.clone())?;
            let plan = question.plan(numbers)?;
            let table = cost::work_precision(&question, &plan, self.seconds, observe)?;
            (cost_data(&table, title), Some(cost_svg(&table, title)))
        };
        bar.finish_and_clear();
        write_with_rows(destinations, self.scene.output.format, |format| match &svg {
            Some(svg) if format.is_picture() => file::picture(format, svg.clone(), Size::Page),
            _ => rows_bytes(&data, format),
        })
    }
}
