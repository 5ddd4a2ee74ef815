//! `dalembert plot`.

use std::path::Path;

use clap::Args;
use clap::builder::PossibleValue;

use crate::answer::{Answer, solve};
use crate::args::{BodyArgs, NumberArgs, OutputArgs, known_formats, words};
use crate::failure::Failure;
use crate::file::{self, PICTURES, write_all};
use crate::output::RunInfo;
use crate::quantities::{NameParser, Scope};
use crate::source::AnyScene;
use crate::terminal;
use dalembert::Ending;
use dalembert::Scene;
use dalembert::number::{Number, Scalar};
use dalembert::solve::{History, Numbers, Question};
use dalembert_plot::draw::{Size, without_subscripts};
use dalembert_plot::{FieldQuantity, Picture, Request, SceneData, heights};

#[derive(Args, Debug)]
#[command(mut_arg("format", known_formats(PICTURES)))]
#[command(after_help = "\
    Without --quantity, one scene is told in four pictures: the field along the rod with its rays and contacts, the \
    stress at the ground, the motion of both ends and of the centre of mass, and the energy; several scenes are drawn \
    over each other.\n\n\
    Examples:\n  dalembert plot doyen-ern-piperno -o bounces.png\n  \
    dalembert plot rod.toml --quantity xt --field velocity --to 12 -o xt.svg\n  \
    dalembert plot figure-4-r01 figure-4-r03 --quantity stress,h --size column -o damping.svg")]
pub(crate) struct Plot {
    /// Scene files, `-`, or built-in scenes
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<String>,
    #[command(flatten)]
    body: BodyArgs,
    /// Pictures, quantities and groups of them, separated by commas; by default those that tell the scene
    #[arg(long, visible_alias = "columns", value_name = "LIST", value_delimiter = ',')]
    #[arg(value_parser = NameParser::new(&[Scope::OverTime], pictures()))]
    quantity: Vec<String>,
    /// Quantity that the colours of xt show
    #[arg(long, value_parser = words::<FieldQuantity>(), default_value_t)]
    field: FieldQuantity,
    /// Draw the places of points of the rod in xt, in place of the field
    #[arg(long)]
    deformed: bool,
    /// The first time to draw; by default the start, or shortly before the first impact
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    from: Option<Number>,
    /// The last time to draw, whatever the scene's own run says; by default what shows the first contacts
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    to: Option<Number>,
    /// Size of the picture
    #[arg(long, value_parser = words::<Size>(), default_value_t)]
    size: Size,
    #[command(flatten)]
    numbers: NumberArgs,
    #[command(flatten)]
    output: OutputArgs,
}

/// Scenes to be drawn.
struct Drawn {
    /// Scenes with their names.
    scenes: Vec<(String, Scene)>,
    /// Heights of the bodies if the scenes are those of one chain.
    heights: Vec<f64>,
    /// Title of the chain.
    title: Option<String>,
}

impl Drawn {
    fn rods(scenes: Vec<(String, Scene)>) -> Self {
        Self { scenes, heights: Vec::new(), title: None }
    }
}

/// Accuracy of a picture without --accuracy: finer than any line.
const ACCURACY: f64 = 1e-6;

/// Returns the names of pictures that are no quantities.
fn pictures() -> impl Iterator<Item = PossibleValue> {
    let names = Picture::names().filter(|name| !matches!(name.parse(), Ok(Picture::Quantity(_))));
    names.map(|name| PossibleValue::new(name).help("a picture"))
}

impl Plot {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        if !self.output.is_given() {
            return Err(failure!("found no file, expected --output FILE, such as -o bounces.svg"));
        }
        let destinations = self.output.destinations(PICTURES)?;
        let time = |time: &Option<Number>| time.as_ref().map(Number::to_f64);
        let (from, to) = (time(&self.from), time(&self.to));
        if let Some(from) = from.filter(|from| *from < 0.0) {
            return Err(failure!("found --from {from}, expected a time from 0 on"));
        }
        if let Some(to) = to.filter(|to| *to <= from.unwrap_or(0.0)) {
            let from = from.unwrap_or(0.0);
            return Err(failure!("found --to {to}, expected a time after {from}, where the picture begins"));
        }
        let Drawn { scenes, heights, title: chain_title } = self.read()?;
        let pictures = match (self.quantity.is_empty(), scenes.len()) {
            (false, _) => self.pictures()?,
            (true, _) if !heights.is_empty() => Picture::CHAIN.to_vec(),
            (true, 1) => Picture::SHEET.to_vec(),
            (true, _) => Picture::COMPARED.to_vec(),
        };
        let has_field = pictures.contains(&Picture::SpaceTime);
        if !has_field && (self.deformed || self.field != FieldQuantity::default()) {
            let option = if self.deformed { "--deformed" } else { "--field" };
            return Err(failure!("found {option} without xt, expected it with --quantity xt"));
        }
        if self.deformed && self.field != FieldQuantity::default() {
            return Err(failure!("found --deformed with --field, expected one of them"));
        }
        if self.deformed && !heights.is_empty() {
            return Err(failure!("found --deformed of a chain, expected it with --body N"));
        }
        let request = Request { pictures, field: self.field, deformed: self.deformed, from, to, heights };
        let gather = |(name, scene): &(String, Scene)| self.gather(name, scene, &request);
        let mut gathered = scenes.iter().map(gather).collect::<Result<Vec<_>, _>>()?;
        let title = match scenes.as_slice() {
            [(_, scene)] => {
                // What comes from standard input has no name.
                let name = Some(self.scenes[0].as_str()).filter(|name| *name != "-");
                gathered[0].heading(scene.title.as_deref().or(name), &scene.problem, &request)
            }
            _ if !request.heights.is_empty() => {
                let name = Some(self.scenes[0].as_str()).filter(|name| *name != "-");
                chain_title.as_deref().or(name).map(without_subscripts).into_iter().collect()
            }
            _ => {
                name_by_differences(&mut gathered);
                let part = |scene: &SceneData| {
                    Some(format!("{}: {}", without_subscripts(&scene.name), scene.shown_part(&request)?))
                };
                gathered.iter().filter_map(part).collect()
            }
        };
        let sheet = request.sheet(&gathered, title).map_err(|error| failure!("{error}"))?;
        let svg = sheet.svg(self.size);
        write_all(&destinations, |format| file::picture(format, svg.clone(), self.size))
    }

    /// Reads the scenes: those that are named, or the bodies of one chain.
    fn read(&self) -> Result<Drawn, Failure> {
        if let [name] = self.scenes.as_slice() {
            return match self.body.read_any(name)? {
                AnyScene::Chain(scene) if scene.chain.bodies().len() > 1 => {
                    let bodies = scene.chain.bodies().iter().zip(1..);
                    let names = bodies.map(|(body, k)| body.name().map_or_else(|| format!("body {k}"), str::to_string));
                    let scenes = names.zip(scene.bodies()?).collect();
                    Ok(Drawn { scenes, heights: heights(&scene.chain), title: scene.title })
                }
                scene => Ok(Drawn::rods(vec![(name.clone(), scene.into_rod(name, None)?)])),
            };
        }
        let read = |name: &String| Ok((name.clone(), self.body.read(name)?));
        Ok(Drawn::rods(self.scenes.iter().map(read).collect::<Result<_, Failure>>()?))
    }

    /// Returns the requested pictures.
    fn pictures(&self) -> Result<Vec<Picture>, Failure> {
        let mut pictures = Vec::new();
        for name in &self.quantity {
            match name.parse::<Picture>() {
                Ok(picture) => pictures.push(picture),
                Err(_) => {
                    let quantities = Scope::OverTime.resolve(std::slice::from_ref(name), true)?;
                    let drawn = quantities.iter().map(|quantity| quantity.name().parse::<Picture>().ok());
                    let drawn = drawn.collect::<Option<Vec<_>>>();
                    pictures.extend(drawn.ok_or_else(|| failure!("found --quantity {name}, which has no picture"))?);
                }
            }
        }
        Ok(pictures)
    }

    fn gather(&self, name: &str, scene: &Scene, request: &Request) -> Result<SceneData, Failure> {
        let numbers = match self.numbers.numbers(scene) {
            Numbers::Double(None) => Numbers::Double(Some(ACCURACY)),
            numbers => numbers,
        };
        let question = match &self.to {
            Some(to) => Question::between(0.into(), to.clone(), numbers),
            None => Question::run(numbers),
        };
        let file = Path::new(name).file_stem().and_then(|stem| stem.to_str()).unwrap_or(name);
        let Answer { history, info, progress } = solve(scene, &question)?;
        let found = history.in_doubles(|doubles| request.gather(file.into(), info.units.clone(), doubles))??;
        drop(progress);
        RunInfo { warnings: history.warnings(), ..info }.print_warnings();
        note_span(file, request, &found, &history);
        Ok(found)
    }
}

/// Prints notes on the part of a history that is drawn.
fn note_span(name: &str, request: &Request, found: &SceneData, history: &History) {
    let ([from, to], end) = (found.span, found.end);
    let note = |text: String| terminal::note(format!("{name}: {text}"));
    let short = |time: f64| time.decimal(6);
    let runs_on = matches!(history.ending(), Ending::Time | Ending::NextImpact);
    let is_short = request.to.map_or(!runs_on, |asked| asked > end * (1.0 + 1e-12));
    if end < history.end().to_f64() {
        note(format!("drawn up to t = {}, as far as the events are settled", short(to)));
    } else if request.shows_span() && request.to.is_none() && (to < end || from > request.from.unwrap_or(0.0)) {
        let (from, to, end) = (short(from), short(to), short(end));
        note(format!("drawn from t = {from} to {to} of {end}; --from and --to draw another span"));
    } else if is_short {
        note(format!("the history ends at t = {}: {}", short(end), history.ending()));
    }
    if let Some(columns) = found.coarse_columns() {
        note(format!(
            "xt has {} columns for a round trip, too few for its waves; --from and --to draw another span",
            columns.decimal(2)
        ));
    }
}

/// Most values that the name of a scene states.
const MAX_DIFFERENT: usize = 3;

/// Names scenes by the values in which they differ, if these are few.
fn name_by_differences(scenes: &mut [SceneData]) {
    let values = |scene: &SceneData| {
        let rod = &scene.rod;
        [("L", rod.length), ("c", rod.wave_speed), ("r", rod.damping), ("g", rod.gravity), ("μ", rod.speed)]
    };
    let all: Vec<_> = scenes.iter().map(values).collect();
    let different: Vec<usize> = (0..5).filter(|k| all.iter().any(|values| values[*k] != all[0][*k])).collect();
    if different.is_empty() || different.len() > MAX_DIFFERENT {
        return;
    }
    for (scene, values) in scenes.iter_mut().zip(&all) {
        let values = different.iter().map(|k| format!("{} = {}", values[*k].0, values[*k].1.decimal(6)));
        scene.name = values.collect::<Vec<_>>().join(", ");
    }
}
