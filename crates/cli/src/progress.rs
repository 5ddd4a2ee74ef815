//! The progress bar of a single run.

use std::io::IsTerminal;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget};

use crate::terminal;
use dalembert::Scene;
use dalembert::problem::Parameters;
use dalembert::solve::{Observer, Plan, Reach};

/// A progress bar on standard error: on a terminal for runs over a second; elsewhere one note in a long run.
pub(crate) struct Progress {
    bar: ProgressBar,
    /// The thread that shows the bar after a second, and the channel whose closing ends it.
    delay: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Progress {
    /// Returns the bar of a run of `scene` by `plan`.
    pub(crate) fn new(scene: &Scene, plan: &Plan) -> Self {
        let (total, unit) = match &plan.reach {
            Reach::Time(time) => {
                let round_trip = Parameters::<f64>::of(&scene.problem, &()).map(|rod| rod.round_trip());
                (round_trip.ok().map(|trip| (time.to_f64() / trip).ceil() as u64), "round trips")
            }
            Reach::Contacts(contacts) => (Some(u64::from(*contacts)), "contacts"),
            Reach::FirstContact => (None, "contacts"),
        };
        match total {
            Some(_) => Progress::with(total, &format!("{{bar:40}} {{pos}}/{{len}} {unit}, {{msg}}{{left}}")),
            None => Progress::with(None, "{spinner} {elapsed}"),
        }
    }

    /// Returns the progress of a chain, whose number of events nobody knows before.
    pub(crate) fn of_chain() -> Self {
        Progress::with(None, "{spinner} {elapsed} {pos} events, {msg}")
    }

    fn with(total: Option<u64>, template: &str) -> Self {
        let bar = terminal::bar(total, template);
        bar.set_draw_target(ProgressDrawTarget::hidden());
        // A thread of its own shows the bar: a single step of a run in many digits can take longer than a second.
        let (sender, receiver) = channel::<()>();
        let shown = bar.clone();
        let thread = std::thread::spawn(move || {
            if receiver.recv_timeout(Duration::from_secs(1)) == Err(RecvTimeoutError::Timeout) {
                shown.set_draw_target(terminal::draw_target());
                shown.enable_steady_tick(Duration::from_millis(100));
                let is_silent = !std::io::stderr().is_terminal();
                if is_silent && receiver.recv_timeout(SILENCE) == Err(RecvTimeoutError::Timeout) {
                    terminal::note(reached(&shown));
                }
            }
        });
        Progress { bar, delay: Some((sender, thread)) }
    }

    /// Replaces the bar by the name of the `stage` that follows the run.
    pub(crate) fn set_stage(&self, stage: &'static str) {
        if let Some(style) = terminal::style("{spinner} {elapsed} {msg}") {
            self.bar.set_style(style);
        }
        self.bar.set_message(stage);
    }

    /// Hides the bar while `print` runs.
    pub(crate) fn suspend<T>(&self, print: impl FnOnce() -> T) -> T {
        self.bar.suspend(print)
    }

    /// Returns the function that an engine calls as it advances.
    pub(crate) fn observer(&self) -> Observer {
        let (bar, calls) = (self.bar.clone(), AtomicUsize::new(0));
        Arc::new(move |done, pieces| {
            // A run that starts again in longer numbers leaves the bar where it is.
            bar.set_position(bar.position().max(done as u64));
            // Every 16th call only: a round trip can take less than a microsecond.
            if calls.fetch_add(1, Ordering::Relaxed).is_multiple_of(16) {
                bar.set_message(format!("{pieces} pieces"));
            }
            ControlFlow::Continue(())
        })
    }
}

/// Time after which a run off a terminal says how far it is.
const SILENCE: Duration = Duration::from_secs(15);

/// Returns how far a run is, in words.
fn reached(bar: &ProgressBar) -> String {
    let of = bar.length().map_or_else(String::new, |length| format!(" of {length}"));
    let message = bar.message();
    let stage = if message.is_empty() { String::new() } else { format!(" ({message})") };
    format!("still running: {}{of} steps done{stage}; an interrupted run leaves no file half-written", bar.position())
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((sender, thread)) = self.delay.take() {
            drop(sender);
            // A thread that only waits does not fail.
            let _ = thread.join();
        }
        self.bar.finish_and_clear();
    }
}
