//! What a file holds by its ending, and writing it.

use std::path::{Path, PathBuf};

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use super::failure::{self, Failure};
pub(crate) use crate::output::Format;
use crate::output::{Dataset, write_together};
#[cfg(feature = "raster")]
use dalembert_plot::draw::ParsedSvg;
use dalembert_plot::draw::Size;

/// Each format with its word after `--format`, its ending, and whom it is for.
const FORMATS: [(Format, &str, &str, &str); 8] = [
    (Format::Table, "table", "txt", "For a person"),
    (Format::Json, "json", "json", "For a program"),
    (Format::Csv, "csv", "csv", "For a spreadsheet"),
    (Format::Npz, "npz", "npz", "For NumPy: an array for each column"),
    (Format::Markdown, "markdown", "md", "For a page: nothing that depends on the machine"),
    (Format::Svg, "svg", "svg", ""),
    (Format::Png, "png", "png", ""),
    (Format::Pdf, "pdf", "pdf", ""),
];

pub(crate) const PICTURES: &[Format] = &[Format::Svg, Format::Png, Format::Pdf];
pub(crate) const ROWS: &[Format] = &[Format::Table, Format::Json, Format::Csv];
pub(crate) const ROWS_OR_PICTURE: &[Format] =
    &[Format::Table, Format::Json, Format::Csv, Format::Svg, Format::Png, Format::Pdf];

/// What `--format` takes where these are written.
pub(crate) fn formats(known: &'static [Format]) -> impl TypedValueParser<Value = Format> {
    let known = FORMATS.iter().filter(|format| known.contains(&format.0));
    let values = known.map(|(_, word, _, help)| PossibleValue::new(*word).help(*help));
    let of = |word: String| FORMATS.iter().find(|format| format.1 == word).map(|format| format.0);
    PossibleValuesParser::new(values).try_map(move |word| of(word).ok_or("no format"))
}

impl Format {
    pub(crate) fn is_picture(self) -> bool {
        PICTURES.contains(&self)
    }

    pub(crate) fn ending(self) -> &'static str {
        FORMATS[self as usize].2
    }

    /// What is written to `path`, one of those `known`: a picture by its ending, else what is `asked`, else what the
    /// ending says; without an ending the first.
    pub(crate) fn of(path: Option<&Path>, asked: Option<Format>, known: &[Format]) -> Result<Format, Failure> {
        let named = path.filter(|path| *path != Path::new("-"));
        let ending = named.map(|path| path.extension().unwrap_or_default().to_string_lossy().to_lowercase());
        let by_ending = known.iter().find(|known| ending.as_deref() == Some(known.ending()));
        // Where a picture can be meant, its file says so.
        let first = ending.as_deref().is_none_or(|ending| {
            ending.is_empty() && (known[0] == Format::Table || !known.iter().any(|known| known.is_picture()))
        });
        let by_ending = by_ending.or(first.then_some(&known[0])).copied();
        let format = by_ending.filter(|format| format.is_picture()).or(asked).or(by_ending);
        let path = named.unwrap_or(Path::new("-")).display();
        let Some(format) = format else {
            let endings: Vec<String> = known.iter().map(|known| format!(".{}", known.ending())).collect();
            let endings = endings.join(", ");
            let endings = endings.rsplit_once(", ").map_or(endings.clone(), |(most, last)| format!("{most} or {last}"));
            let or = if known.contains(&Format::Json) { ", or --format to say what the file holds" } else { "" };
            return Err(failure!("found {path}, expected a file that ends in {endings}{or}"));
        };
        match format {
            Format::Png | Format::Pdf if !cfg!(feature = "raster") => {
                Err(failure!("found {path} in a build without the feature `raster`, expected .svg"))
            }
            format => Ok(format),
        }
    }
}

/// That `path`, or standard output, cannot be written.
pub(crate) fn unwritten(path: Option<&Path>) -> impl FnOnce(std::io::Error) -> Failure + use<> {
    let path = path.filter(|path| *path != Path::new("-"));
    failure::cannot(&format!("write {}", path.map_or("standard output".into(), |path| path.display().to_string())))
}

/// Writes to a file whole or not at all, or to standard output.
pub(crate) fn write(path: Option<&Path>, bytes: &[u8]) -> Result<(), Failure> {
    write_all(&[(path, bytes)])
}

/// Writes all of several files, or none.
fn write_all(files: &[(Option<&Path>, &[u8])]) -> Result<(), Failure> {
    write_together(files).map_err(|(k, error)| unwritten(files[k].0)(error))
}

/// Writes each file, all of them or none; rows are printed too, if no file holds any.
pub(crate) fn write_each(
    paths: &[PathBuf],
    asked: Option<Format>,
    bytes: impl Fn(Format) -> Result<Vec<u8>, Failure>,
) -> Result<(), Failure> {
    let (mut files, mut printed) = (Vec::new(), false);
    for path in paths {
        let format = Format::of(Some(path), asked, ROWS_OR_PICTURE)?;
        printed |= !format.is_picture();
        files.push((Some(path.as_path()), bytes(format)?));
    }
    if !printed {
        files.push((None, bytes(asked.unwrap_or(Format::Table))?));
    }
    write_all(&files.iter().map(|(path, bytes)| (*path, bytes.as_slice())).collect::<Vec<_>>())
}

pub(crate) fn made(what: &str, made: Result<impl Into<Vec<u8>>, impl std::fmt::Display>) -> Result<Vec<u8>, Failure> {
    made.map(Into::into).map_err(|error| failure!("cannot write {what}: {error}"))
}

pub(crate) fn rows(data: &Dataset, format: Format) -> Result<Vec<u8>, Failure> {
    match format {
        Format::Table => Ok(data.table().into_bytes()),
        Format::Json => Ok(json(&data.json())),
        Format::Npz => made("NPZ", data.npz()),
        _ => made("CSV", data.csv()),
    }
}

pub(crate) fn json(value: &serde_json::Value) -> Vec<u8> {
    format!("{value:#}\n").into_bytes()
}

/// A picture as the bytes of its file.
#[cfg(feature = "raster")]
pub(crate) fn picture(format: Format, svg: String, size: Size) -> Result<Vec<u8>, Failure> {
    if format == Format::Svg {
        return Ok(svg.into_bytes());
    }
    let drawn = ParsedSvg::new(&svg).and_then(|parsed| {
        let missing = parsed.missing_letters();
        if !missing.is_empty() {
            eprintln!("note: the font of PNG and PDF has no {missing}, which stay empty; an SVG has all letters");
        }
        if format == Format::Pdf { parsed.pdf() } else { parsed.png(size.scale()) }
    });
    drawn.map_err(|error| failure!("cannot draw: {error}"))
}

/// A picture as the bytes of its file: SVG, as others are refused before anything is solved.
#[cfg(not(feature = "raster"))]
pub(crate) fn picture(_: Format, svg: String, _: Size) -> Result<Vec<u8>, Failure> {
    Ok(svg.into_bytes())
}
