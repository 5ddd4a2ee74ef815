//! Failures of the command as they are reported: the message, help, and the place in a scene.

use std::fmt;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

use crate::terminal;
use dalembert::{Error, SceneError};

/// A failure with its message, what may help, and the place in a scene file.
pub(crate) struct Failure {
    message: String,
    help: Option<String>,
    /// The error of a scene that cannot be read, and the name of its file.
    scene: Option<(Box<SceneError>, String)>,
}

/// Builds a failure with a message in the form of `format!`.
macro_rules! failure {
    ($($part:tt)*) => { $crate::failure::Failure::new(format!($($part)*)) };
}

impl Failure {
    pub(crate) fn new(message: String) -> Self {
        Failure { message, help: None, scene: None }
    }

    /// Builds the failure of a scene file that cannot be read.
    pub(crate) fn in_file(error: SceneError, name: &str) -> Self {
        Failure { message: error.to_string(), help: None, scene: Some((Box::new(error), name.into())) }
    }

    pub(crate) fn help(self, text: impl Into<String>) -> Self {
        Failure { help: Some(text.into()), ..self }
    }
}

impl<E: std::error::Error + 'static> From<E> for Failure {
    fn from(error: E) -> Self {
        let found: &(dyn std::error::Error + 'static) = &error;
        let help = match found.downcast_ref() {
            Some(Error::BeyondExactness { .. }) => Some("--digits N as well goes on from there in digits".into()),
            _ => None,
        };
        Failure { message: error.to_string(), help, scene: None }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place = self.scene.iter().map(|(scene, file)| {
            let annotation = AnnotationKind::Primary.span(scene.span.clone());
            Snippet::source(scene.source_text()).path(file).annotation(annotation)
        });
        let help = self.help.iter().map(|help| Level::HELP.message(help));
        let report = Level::ERROR.primary_title(&self.message).elements(place).elements(help);
        let renderer = if terminal::is_colored() { Renderer::styled() } else { Renderer::plain() };
        f.write_str(&renderer.render(&[report]))
    }
}

/// Returns a function that builds the failure of a read or write: `cannot {what}: {error}`.
pub(crate) fn cannot(what: &str) -> impl FnOnce(std::io::Error) -> Failure + use<> {
    let what = what.to_string();
    move |error| failure!("cannot {what}: {error}")
}
