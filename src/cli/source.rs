//! Where a scene comes from, and how a run shows its progress.

use std::io::Read;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::Failure;
#[cfg(feature = "mp")]
use crate::error::Error;
#[cfg(feature = "mp")]
use crate::rod::Problem;
use crate::rod::{Parameters, Run};
#[cfg(feature = "mp")]
use crate::scene::{Plan, System};
use crate::scene::{Scene, builtin};

/// More than any scene: what is read of an endless stream before it is refused.
const MAX_BYTES: u64 = (16 << 20) + 1;

/// A failure to read or write, with what was tried.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("cannot {what}: {error}")]
pub(super) struct Io {
    what: String,
    error: std::io::Error,
}

pub(super) fn cannot(what: &str) -> impl FnOnce(std::io::Error) -> Io + use<> {
    let what = what.to_string();
    move |error| Io { what, error }
}

#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("found no file and no built-in scene called `{name}`")]
#[diagnostic(help("expected a scene file, `-` for standard input, or a name that `dalembert scenes` lists{nearest}"))]
struct NoScene {
    name: String,
    nearest: String,
}

/// The scene of this name: `-`, a file, or a built-in scene.
pub(super) fn read(name: &str) -> Result<Scene, Failure> {
    let (shown, text) = if name == "-" {
        ("standard input", read_text(std::io::stdin(), "standard input")?)
    } else if std::path::Path::new(name).is_file() {
        let file = std::fs::File::open(name).map_err(cannot(&format!("open {name}")))?;
        (name, read_text(file, name)?)
    } else if let Some(builtin) = builtin::get(name) {
        (name, builtin.source.to_string())
    } else if std::path::Path::new(name).exists() {
        let file = std::fs::File::open(name).map_err(cannot(&format!("open {name}")))?;
        (name, read_text(file, name)?)
    } else {
        let near = builtin::names().find(|known| known.contains(name) || name.contains(*known));
        let nearest = near.map_or_else(String::new, |near| format!(", such as `{near}`"));
        return Err(NoScene { name: name.into(), nearest }.into());
    };
    Scene::parse(&text).map_err(|error| error.in_file(shown).into())
}

fn read_text(from: impl Read, name: &str) -> Result<String, Failure> {
    let mut text = String::new();
    from.take(MAX_BYTES).read_to_string(&mut text).map_err(cannot(&format!("read {name}")))?;
    Ok(text)
}

/// Says why a run that was to be exact is in digits from its beginning.
#[cfg(feature = "mp")]
pub(super) fn tell_inexact(problem: &Problem, plan: &Plan) {
    if let System::Exact(Some(digits)) = plan.system
        && let Err(Error::Irrational { quantity, square }) = Parameters::<rug::Rational>::of(problem, &())
    {
        eprintln!("note: the {quantity} √({square}) is no fraction; all that follows is in {digits} digits");
    }
}

/// A progress bar on standard error: only on a terminal, and only for runs over a second.
pub(super) struct Progress {
    bar: ProgressBar,
    begun: std::time::Instant,
    trips: Option<u64>,
}

impl Progress {
    pub(super) fn of(scene: &Scene) -> Self {
        let trips = match &scene.problem.run {
            Run::Time(time) => {
                let precision = ();
                Parameters::<f64>::of(&scene.problem, &precision)
                    .ok()
                    .map(|rod| (time.to_f64() / rod.round_trip()).ceil() as u64)
            }
            Run::Impacts(_) => None,
        };
        Progress { bar: ProgressBar::hidden(), begun: std::time::Instant::now(), trips }
    }

    pub(super) fn observe(&mut self, trip: usize, pieces: usize) {
        // The clock is looked at now and then only: a round trip can take less than a microsecond.
        if !trip.is_multiple_of(64) || self.begun.elapsed().as_secs() < 1 {
            return;
        }
        if self.bar.is_hidden() && self.bar.position() == 0 {
            self.bar = match self.trips {
                Some(trips) => ProgressBar::new(trips),
                None => ProgressBar::new_spinner(),
            };
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
            let template = if self.trips.is_some() {
                "{bar:40} {pos}/{len} round trips, {msg}"
            } else {
                "{spinner} {pos} round trips, {msg}"
            };
            if let Ok(style) = ProgressStyle::with_template(template) {
                self.bar.set_style(style);
            }
        }
        self.bar.set_message(format!("{pieces} pieces"));
        self.bar.set_position(trip as u64);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
