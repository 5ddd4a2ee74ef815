//! Errors of a scene, with their place.

use std::ops::Range;
use std::sync::Arc;

use thiserror::Error;

use crate::problem::ProblemErrorKind;

/// Error of a scene: what was found, where, and what was expected.
///
/// ```
/// use dalembert::Scene;
/// use dalembert::problem::ProblemErrorKind;
/// let error = Scene::parse("[rod]\nlength = -1\nwave_speed = 1\n[impact]\nspeed = 3\n").unwrap_err();
/// assert_eq!(error.kind, ProblemErrorKind::OutOfRange);
/// assert_eq!(error.to_string(), "line 2, column 10: found length = -1, expected a length above zero");
/// assert_eq!((error.line, error.column, error.span), (2, 10, 15..17));
/// ```
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("line {line}, column {column}: found {found}, expected {expected}")]
#[non_exhaustive]
pub struct SceneError {
    /// The rule that the scene breaks.
    pub kind: ProblemErrorKind,
    /// Description of the value that was found.
    pub found: String,
    /// Description of a value that is accepted.
    pub expected: String,
    /// The offending bytes of the source.
    pub span: Range<usize>,
    /// Line of the first of them, from 1.
    pub line: usize,
    /// Column of the first of them in characters, from 1.
    pub column: usize,
    pub(super) text: Arc<str>,
}

impl SceneError {
    /// The whole source.
    pub fn source_text(&self) -> &str {
        &self.text
    }

    /// The offending text.
    pub fn offending(&self) -> &str {
        self.text.get(self.span.clone()).unwrap_or_default()
    }

    pub(super) fn new(
        source: &str,
        span: Range<usize>,
        kind: ProblemErrorKind,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        let start = source.floor_char_boundary(span.start);
        let end = source.floor_char_boundary(span.end).max(start);
        let (line, column) = position(source, start);
        let (found, expected) = (found.into(), expected.into());
        SceneError { kind, found, expected, span: start..end, line, column, text: source.into() }
    }
}

/// Line and column of a byte, both from 1; columns count characters.
pub(super) fn position(source: &str, offset: usize) -> (usize, usize) {
    let before = &source[..source.floor_char_boundary(offset)];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}
