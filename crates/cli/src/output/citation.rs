//! References of a run, in words and as BibTeX.

use dalembert::Publication;

/// A reference with the key of its entry.
#[derive(Clone, Debug)]
pub(crate) struct Reference {
    /// The key of the entry in BibTeX.
    pub(crate) key: String,
    /// The kind of the entry in BibTeX.
    pub(crate) kind: &'static str,
    /// The entries.
    pub(crate) publication: Publication,
    /// The part of it in the run.
    pub(crate) note: String,
}

/// Returns a publication in words: authors, title, journal or publisher, year, address.
pub(crate) fn plain_text(publication: &Publication) -> String {
    let Publication { author, title, journal, volume, pages, publisher, year, doi, url, verdict: _ } = publication;
    let author = author.as_ref().map(|names| match names.matches(" and ").count() {
        0 | 1 => names.clone(),
        more => names.replacen(" and ", ", ", more - 1),
    });
    let volume = volume.as_ref().map_or_else(String::new, |volume| format!(" {volume}"));
    let journal = journal.as_ref().map(|journal| format!("{journal}{volume}"));
    let pages = pages.as_ref().map(|pages| format!("pages {}", pages.replace("--", "–")));
    let doi = doi.as_ref().map(|doi| format!("https://doi.org/{doi}"));
    let parts = [&author, title, &journal, &pages, publisher, year, &doi, url];
    let parts: Vec<&str> = parts.into_iter().filter_map(|part| part.as_deref()).collect();
    parts.join(", ") + "."
}

/// Returns a text with the characters escaped that LaTeX reserves.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for character in text.chars() {
        match character {
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => out.extend(['\\', character]),
            '\\' => out += "\\textbackslash{}",
            '~' => out += "\\textasciitilde{}",
            '^' => out += "\\textasciicircum{}",
            _ => out.push(character),
        }
    }
    out
}

impl Reference {
    /// Returns the reference in words, with its purpose.
    pub(crate) fn text(&self) -> String {
        format!("{} ({}).", plain_text(&self.publication).trim_end_matches('.'), self.note)
    }

    /// Returns the entry of BibTeX.
    pub(crate) fn bibtex(&self) -> String {
        let mut out = format!("@{}{{{},\n", self.kind, self.key);
        for (name, value) in self.publication.entries().chain([("note", self.note.as_str())]) {
            // An address is printed as it is; a title, and the name of a group, keep their capitals.
            let value = match name {
                "doi" | "url" => value.to_string(),
                "title" => format!("{{{}}}", escaped(value)),
                "author" if value.starts_with("The ") => format!("{{{}}}", escaped(value)),
                _ => escaped(value),
            };
            let name = match (name, self.kind) {
                ("publisher", "misc") => "howpublished",
                ("publisher", "techreport") => "institution",
                _ => name,
            };
            out += &format!("  {name} = {{{value}}},\n");
        }
        out + "}\n"
    }
}
