//! The publication that a scene comes from.

use serde::{Deserialize, Serialize};

use super::error::SceneError;
use super::reader::Reader;

/// Defines [`Publication`] by its keys.
macro_rules! publication {
    ($($(#[$doc:meta])+ $key:ident,)+) => {
        /// The publication that a scene comes from, as `[publication]` gives it: the entries of BibTeX, and a verdict.
        #[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(default)]
        pub struct Publication {
            $($(#[$doc])+ #[serde(skip_serializing_if = "Option::is_none")] pub $key: Option<String>,)+
        }

        const KEYS: &[&str] = &[$(stringify!($key)),+];

        impl Publication {
            /// Returns the entries of BibTeX, with their names.
            pub fn entries(&self) -> impl Iterator<Item = (&'static str, &str)> {
                let values = [$((stringify!($key), &self.$key)),+].into_iter().filter(|(key, _)| *key != "verdict");
                values.filter_map(|(key, value)| Some((key, value.as_deref()?)))
            }

            fn read(text: impl Fn(&str) -> Result<Option<String>, SceneError>) -> Result<Self, SceneError> {
                Ok(Publication { $($key: text(stringify!($key))?),+ })
            }
        }
    };
}

publication! {
    /// The authors, with `and` between them.
    author,
    /// The title.
    title,
    /// The journal.
    journal,
    /// The volume of the journal.
    volume,
    /// The pages.
    pages,
    /// The publisher of a book, a manual or a program.
    publisher,
    /// The year.
    year,
    /// The digital object identifier.
    doi,
    /// The address.
    url,
    /// A sentence on the published values.
    verdict,
}

impl Reader<'_> {
    pub(super) fn publication(&self) -> Result<Option<Publication>, SceneError> {
        let Some((_, value)) = self.get("publication") else { return Ok(None) };
        let Some(document) = value.get_ref().as_table() else {
            return Err(self.wrong_type(value, "publication", "a table, [publication]"));
        };
        let reader = Reader { document, ..*self };
        reader.check_near((document, "[publication]"), KEYS)?;
        Publication::read(|key| Ok(reader.text(key)?.map(|(text, _)| text.to_string()))).map(Some)
    }
}
