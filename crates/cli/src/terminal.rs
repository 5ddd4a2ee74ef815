//! The terminal: colour, width, messages on standard error, and progress bars.

use std::fmt::Display;
use std::io::IsTerminal;
use std::sync::{Mutex, PoisonError, RwLock};

use clap::ColorChoice;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

/// Width of tables and prose where standard output is no terminal, in characters.
const DEFAULT_WIDTH: usize = 80;
/// Least width that is used of a terminal.
const MIN_WIDTH: usize = 40;

/// Options that hold for every subcommand.
#[derive(Clone, Copy, Debug)]
struct Settings {
    quiet: bool,
    color: ColorChoice,
}

static SETTINGS: RwLock<Settings> = RwLock::new(Settings { quiet: false, color: ColorChoice::Auto });

fn settings() -> Settings {
    SETTINGS.read().map_or_else(|poisoned| **poisoned.get_ref(), |settings| *settings)
}

/// Sets the options `--quiet` and `--color` for the rest of the run.
pub(crate) fn configure(quiet: bool, color: ColorChoice) {
    *SETTINGS.write().unwrap_or_else(|poisoned| poisoned.into_inner()) = Settings { quiet, color };
}

/// Returns whether messages on standard error are coloured.
pub(crate) fn is_colored() -> bool {
    match settings().color {
        ColorChoice::Always => true,
        ColorChoice::Never => false,
        ColorChoice::Auto => {
            std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
        }
    }
}

/// Returns the width of tables and prose in characters: that of the terminal, or 80.
pub(crate) fn width() -> usize {
    match terminal_size::terminal_size_of(std::io::stdout()) {
        Some((width, _)) => usize::from(width.0).max(MIN_WIDTH),
        None => DEFAULT_WIDTH,
    }
}

/// Prints a note on standard error, unless `--quiet` is given.
pub(crate) fn note(text: impl Display) {
    message("note", text);
}

/// Prints a warning on standard error, unless `--quiet` is given. A warning that several histories share is printed
/// once.
pub(crate) fn warn(text: impl Display) {
    static PRINTED: Mutex<Vec<String>> = Mutex::new(Vec::new());
    let text = text.to_string();
    let mut printed = PRINTED.lock().unwrap_or_else(PoisonError::into_inner);
    if !printed.contains(&text) {
        message("warning", &text);
        printed.push(text);
    }
}

fn message(kind: &str, text: impl Display) {
    if !settings().quiet {
        eprintln!("{kind}: {text}");
    }
}

/// Returns a progress bar on standard error. It shows on a terminal only, and not with `--quiet`.
pub(crate) fn bar(total: Option<u64>, template: &str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(total, draw_target());
    match style(template) {
        Some(style) => bar.with_style(style),
        None => bar,
    }
}

/// Returns where progress bars are drawn.
pub(crate) fn draw_target() -> ProgressDrawTarget {
    if settings().quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() }
}

/// Returns the style of a template, in which `{left}` is the remaining time, empty while it is not known.
pub(crate) fn style(template: &str) -> Option<ProgressStyle> {
    let left = |state: &ProgressState, out: &mut dyn std::fmt::Write| {
        let seconds = state.eta().as_secs();
        if seconds > 0 && state.pos() > 0 {
            let _ = write!(out, ", {:#} left", indicatif::HumanDuration(state.eta()));
        }
    };
    Some(ProgressStyle::with_template(template).ok()?.with_key("left", left))
}
