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
use dalembert::number::{Number, Scalar};
use dalembert::quantity::Units;
use dalembert::solve::{History, Numbers, Question};
use dalembert::{ChainScene, Ending, Scene};
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
enum Drawn {
    /// Scenes by themselves, with their names.
    Rods(Vec<(String, Scene)>),
    /// All bodies of one chain.
    Chain(Box<ChainScene>),
}

/// Accuracy of a picture without --accuracy: finer than any line.
const ACCURACY: f64 = 1e-6;

/// Returns whether a chain has a body with waves.
fn has_bar(scene: &ChainScene) -> bool {
    scene.chain.bodies().iter().any(|body| body.rigid_mass().is_none())
}

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
        let drawn = self.read()?;
        let pictures = match (self.quantity.is_empty(), &drawn) {
            (false, _) => self.pictures()?,
            (true, Drawn::Chain(scene)) if has_bar(scene) => Picture::CHAIN.to_vec(),
            (true, Drawn::Chain(_)) => Picture::CHAIN.into_iter().filter(|it| *it != Picture::SpaceTime).collect(),
            (true, Drawn::Rods(scenes)) if scenes.len() == 1 => Picture::SHEET.to_vec(),
            (true, Drawn::Rods(_)) => Picture::COMPARED.to_vec(),
        };
        let has_field = pictures.contains(&Picture::SpaceTime);
        if !has_field && (self.deformed || self.field != FieldQuantity::default()) {
            let option = if self.deformed { "--deformed" } else { "--field" };
            return Err(failure!("found {option} without xt, expected it with --quantity xt"));
        }
        if self.deformed && self.field != FieldQuantity::default() {
            return Err(failure!("found --deformed with --field, expected one of them"));
        }
        if let Drawn::Chain(scene) = &drawn
            && has_field
            && !has_bar(scene)
        {
            return Err(failure!("found xt of a chain without bars, expected it of bars: it shows their waves"));
        }
        let mut request =
            Request { pictures, field: self.field, deformed: self.deformed, from, to, heights: Vec::new() };
        let (gathered, title) = match drawn {
            Drawn::Chain(_) if self.deformed => {
                return Err(failure!("found --deformed of a chain, expected it with --body N"));
            }
            Drawn::Chain(scene) => {
                request.heights = heights(&scene.chain);
                let title = scene.title.as_deref().or(self.name()).map(without_subscripts);
                (self.gather_chain(&scene, &request)?, title.into_iter().collect())
            }
            Drawn::Rods(scenes) => {
                let gather = |(name, scene): &(String, Scene)| {
                    let file = Path::new(name).file_stem().and_then(|stem| stem.to_str()).unwrap_or(name);
                    let (history, found) = gather(file, self.solve(scene)?, &request)?;
                    note_span(file, &request, &found, &history);
                    Ok(found)
                };
                let mut gathered = scenes.iter().map(gather).collect::<Result<Vec<_>, Failure>>()?;
                let title = match scenes.as_slice() {
                    [(_, scene)] => {
                        gathered[0].heading(scene.title.as_deref().or(self.name()), &scene.problem, &request)
                    }
                    _ => {
                        name_by_differences(&mut gathered);
                        let part = |scene: &SceneData| {
                            Some(format!("{}: {}", without_subscripts(&scene.name), scene.shown_part(&request)?))
                        };
                        gathered.iter().filter_map(part).collect()
                    }
                };
                (gathered, title)
            }
        };
        let sheet = request.sheet(&gathered, title).map_err(|error| failure!("{error}"))?;
        let svg = sheet.svg(self.size);
        write_all(&destinations, |format| file::picture(format, svg.clone(), self.size))
    }

    /// Reads the scenes: those that are named, or one chain.
    fn read(&self) -> Result<Drawn, Failure> {
        if let [name] = self.scenes.as_slice() {
            return match self.body.read_any(name)? {
                AnyScene::Chain(scene) if scene.chain.bodies().len() > 1 || !has_bar(&scene) => Ok(Drawn::Chain(scene)),
                scene => Ok(Drawn::Rods(vec![(name.clone(), scene.into_rod(name, None)?)])),
            };
        }
        let read = |name: &String| Ok((name.clone(), self.body.read(name)?));
        Ok(Drawn::Rods(self.scenes.iter().map(read).collect::<Result<_, Failure>>()?))
    }

    /// Asks the bars of a chain and, for its rigid bodies, the chain, all over the same span.
    fn gather_chain(&self, scene: &ChainScene, request: &Request) -> Result<Vec<SceneData>, Failure> {
        let name = |k: usize| {
            let name = scene.chain.bodies()[k].name();
            name.map_or_else(|| format!("body {}", k + 1), str::to_string)
        };
        let bodies = scene.bodies()?;
        let bar = bodies.iter().flatten().next();
        let units = bar.map_or_else(Units::unnamed, |bar| Units::new(&bar.problem, bar.units));
        let solve = |bar: &Option<Scene>| bar.as_ref().map(|bar| self.solve(bar)).transpose();
        let answers = bodies.iter().map(solve).collect::<Result<Vec<_>, _>>()?;
        let span = |answer: &Answer| Ok(answer.history.in_doubles(|doubles| request.span(doubles))??);
        let spans = answers.iter().flatten().map(span).collect::<Result<Vec<_>, Failure>>()?;
        let shared = request.over(&spans);
        let chain = if answers.iter().all(Option::is_some) {
            None
        } else {
            let chain = match &self.to {
                Some(to) => scene.chain.with_until(to.clone())?,
                None => scene.chain.clone(),
            };
            Some(chain.solve(self.picture_numbers(scene.accuracy))?)
        };
        let mut all = Vec::new();
        for (k, answer) in answers.into_iter().enumerate() {
            if let Some(answer) = answer {
                let (history, found) = gather(&name(k), answer, &shared)?;
                if all.iter().all(SceneData::is_rigid) {
                    note_span(self.name().unwrap_or("the chain"), request, &found, &history);
                }
                all.push(found);
            } else if let Some(chain) = &chain {
                all.push(shared.gather_rigid(name(k), units.clone(), chain, k)?);
            }
        }
        Ok(all)
    }

    /// Returns the name of the first scene; what comes from standard input has none.
    fn name(&self) -> Option<&str> {
        Some(self.scenes[0].as_str()).filter(|name| *name != "-")
    }

    /// Returns the numbers in which a scene of this accuracy is drawn.
    fn picture_numbers(&self, accuracy: Option<f64>) -> Numbers {
        match self.numbers.numbers_to(accuracy) {
            Numbers::Double(None) => Numbers::Double(Some(ACCURACY)),
            numbers => numbers,
        }
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

    fn solve(&self, scene: &Scene) -> Result<Answer, Failure> {
        let numbers = self.picture_numbers(scene.accuracy);
        let question = match &self.to {
            Some(to) => Question::between(0.into(), to.clone(), numbers),
            None => Question::run(numbers),
        };
        solve(scene, &question)
    }
}

/// Asks the history of an answer for all that the pictures show, and prints its warnings.
fn gather(name: &str, answer: Answer, request: &Request) -> Result<(History, SceneData), Failure> {
    let Answer { history, info, progress } = answer;
    let found = history.in_doubles(|doubles| request.gather(name.into(), info.units.clone(), doubles))??;
    drop(progress);
    RunInfo { warnings: history.warnings(), ..info }.print_warnings();
    Ok((history, found))
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
