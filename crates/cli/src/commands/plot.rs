//! `dalembert plot`.

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::answer::{Visit, solve, warned};
use crate::args::NumberArgs;
use crate::args::words;
use crate::failure::Failure;
use crate::file::{self, Format, PICTURES};
use crate::output::Head;
use crate::source;
use dalembert::Ending;
use dalembert::Scene;
use dalembert::number::{Number, Scalar};
use dalembert::solve::{Numbers, Question, Target, TypedHistory};
use dalembert_plot::draw::Size;
use dalembert_plot::{FieldQuantity, Picture, Request, SceneData, UnknownPicture};

#[derive(Args, Debug)]
#[command(after_help = format!("\
    Without --quantity, one scene is told in four pictures: the field along the rod with its rays and contacts, the \
    stress at the ground, the motion of both ends and of the centre of mass, and the energy; several scenes are drawn \
    over each other.\n\n\
    Quantities: {}; the columns are those of `dalembert reference`.\n\n\
    Examples:\n  dalembert plot doyen-ern-piperno -o bounces.png\n  \
    dalembert plot rod.toml --quantity xt --field velocity --to 12 -o xt.svg\n  \
    dalembert plot figure-4-r01 figure-4-r03 --quantity stress,h --size column -o damping.svg",
    known()
))]
pub(crate) struct Plot {
    /// Scene files, `-`, or built-in scenes
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<String>,
    /// What to draw, separated by commas; by default what tells the scene
    #[arg(long, value_name = "A,B,C", value_delimiter = ',', value_parser = named)]
    quantity: Vec<Picture>,
    /// What the colours of xt show
    #[arg(long, value_parser = words::<FieldQuantity>(), default_value_t)]
    field: FieldQuantity,
    /// In xt, where points of the rod are in place of the field
    #[arg(long)]
    deformed: bool,
    /// The first time to draw; by default the start, or shortly before the first impact
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    from: Option<Number>,
    /// The last time to draw, whatever the scene's own run says; by default what shows the first contacts
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    to: Option<Number>,
    /// What the picture is made for
    #[arg(long, value_parser = words::<Size>(), default_value_t)]
    size: Size,
    #[command(flatten)]
    numbers: NumberArgs,
    /// Write to this file, whole or not at all: .svg, .png or .pdf; `-` is standard output, for SVG
    #[arg(short, long, value_name = "FILE", required = true)]
    output: Vec<PathBuf>,
}

/// The accuracy of a picture where none is asked for: finer than any line.
const ACCURACY: f64 = 1e-6;

fn known() -> String {
    Picture::names().collect::<Vec<_>>().join(", ")
}

fn named(name: &str) -> Result<Picture, UnknownPicture> {
    name.trim().parse()
}

impl Plot {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        // Before anything is solved.
        let format = |path: &PathBuf| Format::of(Some(path), None, PICTURES);
        let formats = self.output.iter().map(format).collect::<Result<Vec<_>, _>>()?;
        let time = |time: &Option<Number>| time.as_ref().map(Number::to_f64);
        let (from, to) = (time(&self.from), time(&self.to));
        if let Some(from) = from.filter(|from| *from < 0.0) {
            return Err(failure!("found --from {from}, expected a time from 0 on"));
        }
        if let Some(to) = to.filter(|to| *to <= from.unwrap_or(0.0)) {
            let from = from.unwrap_or(0.0);
            return Err(failure!("found --to {to}, expected a time after {from}, where the picture begins"));
        }
        let pictures = match (self.quantity.is_empty(), self.scenes.len()) {
            (false, _) => self.quantity.clone(),
            (true, 1) => Picture::SHEET.to_vec(),
            (true, _) => Picture::COMPARED.to_vec(),
        };
        let space_time = pictures.contains(&Picture::SpaceTime);
        if !space_time && (self.deformed || self.field != FieldQuantity::default()) {
            let option = if self.deformed { "--deformed" } else { "--field" };
            return Err(failure!("found {option} without xt, expected it with --quantity xt"));
        }
        if self.deformed && self.field != FieldQuantity::default() {
            return Err(failure!("found --deformed with --field, expected one of them"));
        }
        let request = Request { pictures, field: self.field, deformed: self.deformed, from, to };
        let scenes = self.scenes.iter().map(|name| source::read(name)).collect::<Result<Vec<_>, _>>()?;
        let gather = |(name, scene): (&String, &Scene)| self.gather(name, scene, &request);
        let mut gathered = self.scenes.iter().zip(&scenes).map(gather).collect::<Result<Vec<_>, _>>()?;
        let title = match scenes.as_slice() {
            [scene] => {
                // What comes from standard input has no name.
                let name = Some(self.scenes[0].as_str()).filter(|name| *name != "-");
                gathered[0].heading(scene.title.as_deref().or(name), &scene.problem, &request)
            }
            _ => {
                told_apart(&mut gathered);
                Vec::new()
            }
        };
        let sheet = request.sheet(&gathered, title).map_err(|error| failure!("{error}"))?;
        let svg = sheet.svg(self.size);
        for (path, format) in self.output.iter().zip(formats) {
            file::write(Some(path), &file::picture(format, svg.clone(), self.size)?)?;
        }
        Ok(())
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
        let gather = Gather { name: file, request, found: RefCell::new(None) };
        solve(scene, &question, &gather)?;
        gather.found.into_inner().ok_or_else(|| failure!("found no history of {name}"))
    }
}

/// More values than this that differ between scenes are not told in their names.
const MOST_DIFFERENT: usize = 3;

/// Calls scenes by the values in which they differ, where these are few.
fn told_apart(scenes: &mut [SceneData]) {
    let values = |scene: &SceneData| {
        let rod = &scene.rod;
        [("L", rod.length), ("c", rod.wave_speed), ("r", rod.damping), ("g", rod.gravity), ("μ", rod.speed)]
    };
    let all: Vec<_> = scenes.iter().map(values).collect();
    let different: Vec<usize> = (0..5).filter(|k| all.iter().any(|values| values[*k] != all[0][*k])).collect();
    if different.is_empty() || different.len() > MOST_DIFFERENT {
        return;
    }
    for (scene, values) in scenes.iter_mut().zip(&all) {
        let told = different.iter().map(|k| format!("{} = {}", values[*k].0, values[*k].1.decimal(6)));
        scene.name = told.collect::<Vec<_>>().join(", ");
    }
}

/// Asks a history for what the pictures show.
struct Gather<'a> {
    name: &'a str,
    request: &'a Request,
    found: RefCell<Option<SceneData>>,
}

impl Visit for Gather<'_> {
    fn visit<S: Target>(
        &self,
        history: &TypedHistory<S>,
        head: Head,
        progress: source::Progress,
    ) -> Result<(), Failure> {
        let found = self.request.gather(self.name.into(), head.units.clone(), history)?;
        drop(progress);
        warned(Head { warnings: history.warnings(), ..head }, false);
        let ([from, to], end) = (found.span, found.end);
        let note = |text: String| eprintln!("note: {}: {text}", self.name);
        let short = |time: f64| time.decimal(6);
        let runs_on = matches!(history.ending(), Ending::Time | Ending::NextImpact);
        let short_of = self.request.to.map_or(!runs_on, |asked| asked > end * (1.0 + 1e-12));
        if end < history.end().to_f64() {
            note(format!("drawn up to t = {}, as far as the events are settled", short(to)));
        } else if self.request.shows_span()
            && self.request.to.is_none()
            && (to < end || from > self.request.from.unwrap_or(0.0))
        {
            let (from, to, end) = (short(from), short(to), short(end));
            note(format!("drawn from t = {from} to {to} of {end}; --from and --to draw another span"));
        } else if short_of {
            note(format!("the history ends at t = {}: {}", short(end), history.ending()));
        }
        if let Some(columns) = found.coarse_columns() {
            note(format!(
                "xt has {} columns for a round trip, too few for its waves; --from and --to draw another span",
                columns.decimal(2)
            ));
        }
        self.found.replace(Some(found));
        Ok(())
    }
}
