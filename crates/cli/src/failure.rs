//! What can go wrong, as it is reported: what the library says, and the flags that help.

use std::fmt;
use std::io::IsTerminal;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

use dalembert::Error;
use dalembert::SceneError;

pub(crate) struct Failure {
    message: String,
    help: Option<String>,
    /// A scene that cannot be read, and where it stands.
    scene: Option<(Box<SceneError>, String)>,
}

/// A failure with a message in the form of `format!`.
macro_rules! failure {
    ($($part:tt)*) => { $crate::failure::Failure::new(format!($($part)*)) };
}

impl Failure {
    pub(crate) fn new(message: String) -> Self {
        Failure { message, help: None, scene: None }
    }

    /// A scene of this file that cannot be read.
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
        let colored = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|set| set.is_empty());
        let renderer = if colored { Renderer::styled() } else { Renderer::plain() };
        f.write_str(&renderer.render(&[report]))
    }
}

/// A failure to read or write, with what was tried.
pub(crate) fn cannot(what: &str) -> impl FnOnce(std::io::Error) -> Failure + use<> {
    let what = what.to_string();
    move |error| failure!("cannot {what}: {error}")
}
