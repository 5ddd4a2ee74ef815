//! Names that a user may misspell, and the name that was most likely meant.

use thiserror::Error;

/// Error for a name that is not known.
///
/// ```
/// use dalembert::Quantity;
/// let error = "u_edn".parse::<Quantity>().unwrap_err();
/// assert_eq!(error.nearest.as_deref(), Some("u_end"));
/// ```
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("found the {kind} `{found}`, expected one of {}{}", .known.join(", "), did_you_mean(.nearest.as_ref()))]
#[non_exhaustive]
pub struct UnknownName {
    /// The kind of the name, in one word: `quantity`.
    pub kind: &'static str,
    /// The name that was found.
    pub found: String,
    /// The names that are known.
    pub known: Vec<&'static str>,
    /// The known name that is spelled most like it, if any is close.
    pub nearest: Option<String>,
}

impl UnknownName {
    pub(crate) fn new(kind: &'static str, found: &str, known: impl IntoIterator<Item = &'static str>) -> Self {
        let known: Vec<&'static str> = known.into_iter().collect();
        let nearest = nearest(found, known.iter().copied()).map(String::from);
        UnknownName { kind, found: found.into(), known, nearest }
    }
}

/// Returns the known name that is spelled most like `name`, if any is close.
///
/// ```
/// assert_eq!(dalembert::nearest("lenght", ["density", "length"]), Some("length"));
/// assert_eq!(dalembert::nearest("colour", ["density", "length"]), None);
/// ```
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // A name of more than 40 bytes is close to none, and the distance is quadratic.
    if name.len() > 40 {
        return None;
    }
    let name = name.to_ascii_lowercase();
    let distance = |known: &'a str| (strsim::levenshtein(&name, &known.to_ascii_lowercase()), known);
    let (distance, known) = known.into_iter().map(distance).min()?;
    (distance <= 1 + known.len() / 4).then_some(known)
}

/// ` (did you mean …?)`, or nothing.
pub(crate) fn did_you_mean(meant: Option<impl std::fmt::Display>) -> String {
    meant.map_or(String::new(), |meant| format!(" (did you mean {meant}?)"))
}
