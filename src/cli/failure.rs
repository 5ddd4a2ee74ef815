//! What can go wrong, ready to be reported.

/// Everything that can go wrong.
pub type Failure = miette::Report;

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
