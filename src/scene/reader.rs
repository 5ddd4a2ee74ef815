//! A table of a scene as TOML: what stands at a key, as text or as an exact number, and the place of whatever is wrong.

use std::borrow::Cow;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::SceneError;
use super::suggest;
use crate::names::{did_you_mean, nearest};
use crate::number::Number;
use crate::problem::given::Given;
use crate::problem::written::short;
use crate::problem::{ProblemErrorKind as Kind, Written};

pub(super) type Key<'a> = Spanned<Cow<'a, str>>;
pub(super) type Value<'a> = Spanned<DeValue<'a>>;

/// The table of a scene, or one of the tables in it.
pub(super) struct Reader<'a> {
    pub(super) source: &'a str,
    pub(super) document: &'a DeTable<'a>,
}

impl<'a> Reader<'a> {
    pub(super) fn text(&self, path: &str) -> Result<Option<(&'a str, Range<usize>)>, SceneError> {
        let Some((key, value)) = self.get(path) else { return Ok(None) };
        let text = value.get_ref().as_str().ok_or_else(|| self.wrong_type(value, key.get_ref(), "a string"))?;
        Ok(Some((text, value.span())))
    }

    pub(super) fn number(&self, path: &str) -> Result<Option<Written>, SceneError> {
        self.get(path).map(|(key, value)| self.written(value, key.get_ref())).transpose()
    }

    /// The number that a value spells, taken from the source itself so that no digit is lost.
    pub(super) fn written(&self, value: &Value<'a>, key: &str) -> Result<Written, SceneError> {
        let shown = self.slice(&value.span());
        match value.get_ref() {
            DeValue::Integer(_) | DeValue::Float(_) => Ok(Written::new(shown, shown)),
            DeValue::String(text) => Ok(Written::new(text, shown)),
            _ => Err(self.wrong_type(value, key, "a number such as 3, 0.1, 1e-9 or \"1/3\"")),
        }
    }

    /// Reads the number at a key outside of the problem.
    pub(super) fn plain_number(&self, key: &str) -> Result<Option<Number>, SceneError> {
        self.get(key).map(|(_, value)| self.number_in(value, key)).transpose()
    }

    /// Reads the number `value`, which stands at `key` or in a list there.
    pub(super) fn number_in(&self, value: &Value<'_>, key: &str) -> Result<Number, SceneError> {
        let written = self.written(value, key)?;
        let number = Given::new("", key, &written).map(|given| given.number.clone());
        number.map_err(|error| self.error(value.span(), error.kind, error.found, error.expected))
    }

    /// The place among `known` of the word at `key`.
    pub(super) fn choice(&self, key: &str, known: &[&'static str]) -> Result<Option<usize>, SceneError> {
        let Some((_, value)) = self.get(key) else { return Ok(None) };
        let text = value.get_ref().as_str();
        let place = known.iter().position(|name| Some(*name) == text);
        place.map(Some).ok_or_else(|| {
            let found = format!("{key} = {}", short(self.slice(&value.span())));
            let hint = did_you_mean(text.and_then(|text| nearest(text, known.iter().copied())));
            self.error(value.span(), Kind::OutOfRange, found, format!("one of {}{hint}", known.join(", ")))
        })
    }

    /// Refuses a key of `table` that is not among `known`; `meant` is what it may stand for.
    pub(super) fn check_known(
        &self,
        (table, shown): (&DeTable<'_>, &str),
        known: &[&'static str],
        meant: impl Fn(&str) -> Option<String>,
    ) -> Result<(), SceneError> {
        // toml hands the keys over in alphabetical order; the first one in the file is reported.
        let unknown = table.keys().filter(|key| !known.contains(&key.get_ref().as_ref()));
        let Some(key) = unknown.min_by_key(|key| key.span().start) else { return Ok(()) };
        let found = format!("the unknown key `{}` in {shown}", short(key.get_ref()));
        let expected = match suggest::refused(key.get_ref()) {
            Some(expected) => expected.to_string(),
            None => format!("one of {}{}", known.join(", "), did_you_mean(meant(key.get_ref()))),
        };
        Err(self.error(key.span(), Kind::UnknownKey, found, expected))
    }

    /// Refuses a key of `table` that is not among `known`, and suggests the nearest of these.
    pub(super) fn check_near(&self, table: (&DeTable<'_>, &str), known: &[&'static str]) -> Result<(), SceneError> {
        self.check_known(table, known, |key| nearest(key, known.iter().copied()).map(String::from))
    }

    /// Key and value at a path such as `rod` or `rod.length`.
    pub(super) fn get(&self, path: &str) -> Option<(&'a Key<'a>, &'a Value<'a>)> {
        match path.split_once('.') {
            None => self.document.get_key_value(path),
            Some((table, key)) => {
                Reader { document: self.document.get(table)?.get_ref().as_table()?, ..*self }.get(key)
            }
        }
    }

    pub(super) fn wrong_type(&self, value: &Value<'_>, key: &str, expected: &str) -> SceneError {
        let article = if matches!(value.get_ref(), DeValue::Array(_) | DeValue::Integer(_)) { "an" } else { "a" };
        let found = match value.get_ref() {
            DeValue::Table(_) => format!("{key}, a table"),
            other => format!("{key} = {}, {article} {}", short(self.slice(&value.span())), other.type_str()),
        };
        self.error(value.span(), Kind::WrongType, found, expected)
    }

    pub(super) fn error(
        &self,
        span: Range<usize>,
        kind: Kind,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> SceneError {
        SceneError::new(self.source, span, kind, found, expected)
    }

    pub(super) fn slice(&self, span: &Range<usize>) -> &'a str {
        self.source.get(span.clone()).unwrap_or_default()
    }
}
