//! `dalembert cost`.

use clap::Args;
use indicatif::ProgressBar;

use crate::args::{SceneArgs, known_formats};
use crate::failure::Failure;
use crate::file::{self, Destination, ROWS, ROWS_OR_PICTURE, write_with_rows};
use crate::output::{Dataset, cost_data, cost_svg, effects_data, rows_bytes};
use crate::quantities::{NameParser, Scope, has_material, is_of_chain, unknown};
use crate::source::AnyScene;
use crate::terminal;
use dalembert::ChainScene;
use dalembert::chain::ChainQuery;
use dalembert::number::Number;
use dalembert::quantity::{Measure, Quantity};
use dalembert_plot::draw::Size;
use dalembert_verify::{ChainQuestion, RouteQuestion, cost};

#[derive(Args, Debug)]
#[command(mut_arg("format", known_formats(ROWS)))]
#[command(after_help = "Examples:\n  dalembert cost figure-4-r02 --quantity e_E2 -o cost.svg\n  \
    dalembert cost figure-4-r02 --quantity energy --time 2 --seconds 60\n  \
    dalembert cost doyen-ern-piperno --effects\n  \
    dalembert cost saint-venant-mass --quantity force.1 --time 1/2\n\nBeside a picture the table is printed as well.")]
pub(crate) struct Cost {
    #[command(flatten)]
    scene: SceneArgs,
    /// The quantity that every route computes, or a group, which stands for its first one; by default the bounce time,
    /// or the last event of a scene with several impacts. Of a whole chain it has a place: release.1, force.top,
    /// u_top.2
    #[arg(long, value_parser = NameParser::new(&[Scope::SingleNumber], []).open())]
    quantity: Option<String>,
    /// The time of a quantity over time; by default three quarters of a round trip, or, if the quantity is zero then,
    /// the middle of the first contact or flight in which it is not; of a whole chain the end of the run
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
        let destinations = self.scene.output.destinations(ROWS_OR_PICTURE)?;
        let is_of_chain = self.quantity.as_deref().is_some_and(is_of_chain);
        let scene = match self.scene.body.read_any(&self.scene.scene)? {
            AnyScene::Chain(scene) if scene.chain.bodies().len() > 1 || is_of_chain => {
                return self.chain(&scene, destinations);
            }
            scene => scene.into_rod(&self.scene.scene, None)?,
        };
        let numbers = self.scene.numbers.numbers_to(scene.accuracy);
        if self.effects && destinations.iter().any(|destination| destination.format.is_picture()) {
            return Err(failure!("found --effects with a picture, expected a table, JSON or CSV"));
        }
        let names: Vec<String> = self.quantity.iter().cloned().collect();
        let quantity = Scope::SingleNumber.resolve(&names, has_material(&scene))?.first().copied();
        let title = scene.title.as_deref();
        let (bar, observe) = share_bar();
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
        self.write(destinations, &data, svg)
    }

    /// Measures a quantity of a whole chain.
    fn chain(&self, scene: &ChainScene, destinations: Vec<Destination>) -> Result<(), Failure> {
        if self.effects {
            return Err(failure!("found --effects with a chain of bodies, expected it with one of them, --body N"));
        }
        let chain = &scene.chain;
        let read = |name: &String| {
            ChainQuery::read(name, chain).ok_or_else(|| unknown(name, " of a chain", &ChainQuery::names(chain)))
        };
        let query = self.quantity.as_ref().map(read).transpose()?;
        let question = ChainQuestion::new(chain, query, self.time.clone())?;
        let numbers = self.scene.numbers.numbers_to(scene.accuracy);
        let (bar, observe) = share_bar();
        let unit = scene.unit(question.measure());
        let table = cost::chain_work_precision(&question, (numbers, unit), self.seconds, observe)?;
        bar.finish_and_clear();
        let title = scene.title.as_deref();
        self.write(destinations, &cost_data(&table, title), Some(cost_svg(&table, title)))
    }

    /// Writes a table, and where there is one a picture.
    fn write(&self, destinations: Vec<Destination>, data: &Dataset, svg: Option<String>) -> Result<(), Failure> {
        write_with_rows(destinations, self.scene.output.format, |format| match &svg {
            Some(svg) if format.is_picture() => file::picture(format, svg.clone(), Size::Page),
            _ => rows_bytes(data, format),
        })
    }
}

/// Returns a progress bar of the time, and the function that moves it.
fn share_bar() -> (ProgressBar, impl FnMut(f64, &str)) {
    let bar = terminal::bar(Some(1000), "{bar:40} {percent} %, {msg}");
    let shown = bar.clone();
    let observe = move |share: f64, what: &str| {
        shown.set_message(what.to_string());
        shown.set_position((1000.0 * share.min(1.0)) as u64);
    };
    (bar, observe)
}
