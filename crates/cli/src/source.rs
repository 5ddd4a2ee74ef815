//! Where a scene comes from, and how a run shows its progress.

use std::io::Read;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::failure::{Failure, cannot};
use dalembert::problem::Parameters;
use dalembert::solve::{Observer, Plan, Reach};
use dalembert::{Scene, builtin};

/// More than any scene: what is read of an endless stream before it is refused.
const MAX_BYTES: u64 = (16 << 20) + 1;

/// The scene of this name: `-`, a file, or a built-in scene.
pub(crate) fn read(name: &str) -> Result<Scene, Failure> {
    let path = std::path::Path::new(name);
    let builtin = builtin::get(name).filter(|_| !path.is_file());
    let (shown, text) = if name == "-" {
        ("standard input", read_text(std::io::stdin(), "standard input")?)
    } else if let Some(builtin) = builtin {
        (name, builtin.source.to_string())
    } else if path.is_dir() {
        let scenes = "a scene file in it, such as `FOLDER/rod.toml`, or a name that `dalembert scenes` lists";
        return Err(failure!("found the folder `{name}` as a scene").help(format!("expected {scenes}")));
    } else if path.exists() {
        let file = std::fs::File::open(name).map_err(cannot(&format!("open {name}")))?;
        (name, read_text(file, name)?)
    } else {
        let nearest = nearest(name).map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
        let scenes = "a scene file, `-` for standard input, or a name that `dalembert scenes` lists";
        let failure = failure!("found no file and no built-in scene called `{name}`");
        return Err(failure.help(format!("expected {scenes}{nearest}")));
    };
    Scene::parse(&text).map_err(|error| Failure::in_file(error, shown))
}

/// The scene that a name which is none may mean: a file beside it that only lacks the ending, or the built-in scene
/// whose name is the same but for hyphens and case, or a part of it.
fn nearest(name: &str) -> Option<String> {
    let file = format!("{name}.toml");
    if std::path::Path::new(&file).is_file() {
        return Some(file);
    }
    let letters =
        |text: &str| text.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect::<String>();
    let wanted = letters(name);
    let near = |known: &&str| wanted == letters(known) || (wanted.len() > 3 && letters(known).contains(&wanted));
    builtin::names().find(near).map(str::to_string)
}

fn read_text(from: impl Read, name: &str) -> Result<String, Failure> {
    let mut text = String::new();
    from.take(MAX_BYTES).read_to_string(&mut text).map_err(cannot(&format!("read {name}")))?;
    Ok(text)
}

/// A progress bar on standard error, on a terminal only.
pub(crate) fn bar(total: Option<u64>, template: &str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(total, ProgressDrawTarget::stderr());
    match ProgressStyle::with_template(template) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// A progress bar on standard error: only on a terminal, and only for runs over a second.
pub(crate) struct Progress {
    bar: ProgressBar,
    /// The thread that waits for a second, and what wakes it by its end.
    watch: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Progress {
    pub(crate) fn of(scene: &Scene, plan: &Plan) -> Self {
        let (total, unit) = match &plan.reach {
            Reach::Time(time) => {
                let round_trip = Parameters::<f64>::of(&scene.problem, &()).map(|rod| rod.round_trip());
                (round_trip.ok().map(|trip| (time.to_f64() / trip).ceil() as u64), "round trips")
            }
            Reach::Contacts(contacts) => (Some(u64::from(*contacts)), "contacts"),
            Reach::FirstContact => (None, "contacts"),
        };
        let template = match total {
            Some(_) => format!("{{bar:40}} {{pos}}/{{len}} {unit}, {{msg}}, {{eta}} left"),
            None => "{spinner} {elapsed}".into(),
        };
        let bar = bar(total, &template);
        bar.set_draw_target(ProgressDrawTarget::hidden());
        // A thread of its own shows it: a single step of a run in many digits can take longer than a second.
        let (running, ended) = channel::<()>();
        let shown = bar.clone();
        let watch = std::thread::spawn(move || {
            if ended.recv_timeout(Duration::from_secs(1)) == Err(RecvTimeoutError::Timeout) {
                shown.set_draw_target(ProgressDrawTarget::stderr());
                shown.enable_steady_tick(Duration::from_millis(100));
            }
        });
        Progress { bar, watch: Some((running, watch)) }
    }

    /// The run has ended, and its answer is worked on.
    pub(crate) fn stage(&self, what: &'static str) {
        if let Ok(style) = ProgressStyle::with_template("{spinner} {elapsed} {msg}") {
            self.bar.set_style(style);
        }
        self.bar.set_message(what);
    }

    /// Does something that prints, with the bar out of its way.
    pub(crate) fn aside<T>(&self, print: impl FnOnce() -> T) -> T {
        self.bar.suspend(print)
    }

    /// What an engine calls as it goes on.
    pub(crate) fn observer(&self) -> Observer {
        let (bar, calls) = (self.bar.clone(), AtomicUsize::new(0));
        Arc::new(move |done, pieces| {
            bar.set_position(done as u64);
            // Now and then only: a round trip can take less than a microsecond.
            if calls.fetch_add(1, Ordering::Relaxed).is_multiple_of(16) {
                bar.set_message(format!("{pieces} pieces"));
            }
            ControlFlow::Continue(())
        })
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((running, watch)) = self.watch.take() {
            drop(running);
            // A thread that only waits does not fail.
            let _ = watch.join();
        }
        self.bar.finish_and_clear();
    }
}
