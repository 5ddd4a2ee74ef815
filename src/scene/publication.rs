//! The publication that a scene comes from.

use serde::{Deserialize, Serialize};

use super::error::SceneError;
use super::reader::Reader;
use crate::names::nearest;

/// The publication that a scene comes from, as `[publication]` gives it: the entries of BibTeX, and a verdict.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Publication {
    /// The authors, with `and` between them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub author: Option<String>,
    /// The title.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// The journal.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub journal: Option<String>,
    /// The volume of the journal.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volume: Option<String>,
    /// The pages.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pages: Option<String>,
    /// The publisher of a book, a manual or a program.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub publisher: Option<String>,
    /// The year.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub year: Option<String>,
    /// The digital object identifier.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub doi: Option<String>,
    /// The address.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub url: Option<String>,
    /// A sentence on the published values.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verdict: Option<String>,
}

const KEYS: &[&str] = &["author", "title", "journal", "volume", "pages", "publisher", "year", "doi", "url", "verdict"];

impl Publication {
    /// Returns the entries of BibTeX, with their names.
    pub fn entries(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let Publication { author, title, journal, volume, pages, publisher, year, doi, url, verdict: _ } = self;
        let values = [author, title, journal, volume, pages, publisher, year, doi, url];
        KEYS.iter().zip(values).filter_map(|(key, value)| Some((*key, value.as_deref()?)))
    }
}

impl Reader<'_> {
    pub(super) fn publication(&self) -> Result<Option<Publication>, SceneError> {
        let Some((_, value)) = self.get("publication") else { return Ok(None) };
        let Some(document) = value.get_ref().as_table() else {
            return Err(self.wrong_type(value, "publication", "a table, [publication]"));
        };
        let reader = Reader { document, ..*self };
        let near = |key: &str| nearest(key, KEYS.iter().copied()).map(String::from);
        reader.check_known((document, "[publication]"), KEYS, near)?;
        let text = |key: &str| Ok(reader.text(key)?.map(|(text, _)| text.to_string()));
        Ok(Some(Publication {
            author: text("author")?,
            title: text("title")?,
            journal: text("journal")?,
            volume: text("volume")?,
            pages: text("pages")?,
            publisher: text("publisher")?,
            year: text("year")?,
            doi: text("doi")?,
            url: text("url")?,
            verdict: text("verdict")?,
        }))
    }
}
