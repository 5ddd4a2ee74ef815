//! A table of a scene file, taken apart key by key.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::{SceneError, SceneErrorKind, short};
use crate::number::{Number, NumberError};

/// A TOML value with its place.
pub(super) type Value<'a> = Spanned<DeValue<'a>>;

/// A value with its key and the places of both.
pub(super) struct Entry<'a> {
    pub(super) key: &'static str,
    pub(super) key_span: Range<usize>,
    pub(super) value: &'a Value<'a>,
}

/// A number with its key and place.
#[derive(Clone)]
pub(super) struct Quantity {
    pub(super) key: &'static str,
    pub(super) number: Number,
    pub(super) span: Range<usize>,
}

/// A table whose keys are all known.
pub(super) struct Table<'a> {
    source: &'a str,
    /// How messages call it: `[rod]`, or `the scene`.
    name: String,
    /// Where it begins, to point at when a key is missing.
    span: Range<usize>,
    entries: Vec<Entry<'a>>,
}

impl<'a> Table<'a> {
    /// The table, if all its keys are among `known`.
    pub(super) fn new(
        source: &'a str,
        name: impl Into<String>,
        span: Range<usize>,
        table: &'a DeTable<'a>,
        known: &'static [&'static str],
    ) -> Result<Self, SceneError> {
        let name = name.into();
        let mut entries = Vec::with_capacity(table.len());
        let mut unknown: Option<&Spanned<std::borrow::Cow<'_, str>>> = None;
        for (key, value) in table {
            match known.iter().find(|k| **k == key.get_ref().as_ref()) {
                Some(known) => entries.push(Entry { key: known, key_span: key.span(), value }),
                // toml hands the keys over in alphabetical order; the first one in the file is reported.
                None if unknown.is_none_or(|u| key.span().start < u.span().start) => unknown = Some(key),
                None => {}
            }
        }
        if let Some(key) = unknown {
            let text = key.get_ref();
            let hint = nearest(text, known).map_or(String::new(), |k| format!(" (did you mean {k}?)"));
            let found = format!("the unknown key `{}` in {name}", short(text));
            let expected = format!("one of {}{hint}", known.join(", "));
            return Err(SceneError::new(source, key.span(), SceneErrorKind::UnknownKey, found, expected));
        }
        Ok(Table { source, name, span, entries })
    }

    pub(super) fn entries(&self) -> &[Entry<'a>] {
        &self.entries
    }

    pub(super) fn get(&self, key: &str) -> Option<&Entry<'a>> {
        self.entries.iter().find(|entry| entry.key == key)
    }

    /// The error that a key is missing: `what` says how, such as `no length`.
    pub(super) fn missing(&self, what: &str, expected: &str) -> SceneError {
        self.error(self.span.clone(), SceneErrorKind::MissingKey, format!("{what} in {}", self.name), expected)
    }

    /// The error that `key` stands in the way of something, if the table has it.
    pub(super) fn refuse(&self, key: &str, other: &str, expected: &str) -> Result<(), SceneError> {
        self.get(key).map_or(Ok(()), |entry| {
            let (span, kind) = (entry.key_span.clone(), SceneErrorKind::Contradiction);
            Err(SceneError::new(self.source, span, kind, format!("{key} as well as {other}"), expected))
        })
    }

    /// The table under `key`.
    pub(super) fn table(&self, key: &str, known: &'static [&'static str]) -> Result<Option<Table<'a>>, SceneError> {
        let Some(entry) = self.get(key) else { return Ok(None) };
        match entry.value.get_ref() {
            DeValue::Table(table) => {
                Table::new(self.source, format!("[{key}]"), entry.key_span.clone(), table, known).map(Some)
            }
            _ => Err(self.wrong_type(entry.value, key, &format!("a table, [{key}]"))),
        }
    }

    /// The text under `key`.
    pub(super) fn string(&self, key: &str) -> Result<Option<(&'a str, Range<usize>)>, SceneError> {
        let Some(entry) = self.get(key) else { return Ok(None) };
        match entry.value.get_ref() {
            DeValue::String(text) => Ok(Some((text, entry.value.span()))),
            _ => Err(self.wrong_type(entry.value, key, "a string")),
        }
    }

    /// The number under `key`.
    pub(super) fn number(&self, key: &'static str) -> Result<Option<Quantity>, SceneError> {
        let Some(entry) = self.get(key) else { return Ok(None) };
        self.number_of(entry.value, key).map(Some)
    }

    /// The number that a value spells, taken from the source itself so that no digit is lost.
    pub(super) fn number_of(&self, value: &Value<'_>, key: &'static str) -> Result<Quantity, SceneError> {
        let span = value.span();
        let text = match value.get_ref() {
            DeValue::Integer(_) | DeValue::Float(_) => self.slice(&span),
            DeValue::String(text) => text,
            _ => return Err(self.wrong_type(value, key, "a number such as 3, 0.1, 1e-9 or \"1/3\"")),
        };
        match text.parse() {
            Ok(number) => Ok(Quantity { key, number, span }),
            Err(error) => {
                let found = format!("{key} = {}", short(self.slice(&span)));
                let found = match error {
                    NumberError::TooLong(count) => format!("{found}, {count} characters"),
                    _ => found,
                };
                let expected = match error {
                    NumberError::Unreadable(_) => "a number such as 3, 0.1, 1e-9 or \"1/3\", decimal and finite",
                    NumberError::ZeroDenominator(_) => "a fraction whose denominator is not zero",
                    NumberError::Size(_) => "zero or a magnitude between 1e-300 and 1e300",
                    NumberError::TooLong(_) => "a number of at most 20000 characters",
                };
                Err(SceneError::new(self.source, span, SceneErrorKind::NotANumber, found, expected))
            }
        }
    }

    pub(super) fn wrong_type(&self, value: &Value<'_>, key: &str, expected: &str) -> SceneError {
        let article = if matches!(value.get_ref(), DeValue::Array(_) | DeValue::Integer(_)) { "an" } else { "a" };
        let found = match value.get_ref() {
            DeValue::Table(_) => format!("{key}, a table"),
            other => format!("{key} = {}, {article} {}", short(self.slice(&value.span())), other.type_str()),
        };
        self.error(value.span(), SceneErrorKind::WrongType, found, expected)
    }

    pub(super) fn error(
        &self,
        span: Range<usize>,
        kind: SceneErrorKind,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> SceneError {
        SceneError::new(self.source, span, kind, found, expected)
    }

    /// The source at a span.
    pub(super) fn slice(&self, span: &Range<usize>) -> &'a str {
        self.source.get(span.clone()).unwrap_or_default()
    }
}

/// The known key that is spelled most like `key`, if any is close.
fn nearest(key: &str, known: &[&'static str]) -> Option<&'static str> {
    // A key of more than 40 bytes is close to none, and the distance is quadratic.
    if key.len() > 40 {
        return None;
    }
    let (distance, name) = known.iter().map(|name| (edit_distance(key, name), *name)).min()?;
    (distance <= 1 + name.len() / 4).then_some(name)
}

/// The least number of characters to insert, delete or replace that makes `a` into `b`.
fn edit_distance(a: &str, b: &str) -> usize {
    let mut row: Vec<usize> = (0..=b.chars().count()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = i;
        row[0] = i + 1;
        for (j, y) in b.chars().enumerate() {
            let replaced = diagonal + usize::from(!x.eq_ignore_ascii_case(&y));
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.chars().count()]
}
