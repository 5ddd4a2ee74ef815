//! What a file holds by its ending, and writing it.

use std::path::{Path, PathBuf};

use clap::ValueEnum;

use super::failure::{self, Failure};
#[cfg(feature = "plot")]
use crate::output::Rendered;
use crate::output::{Size, write_together};

/// How rows are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    /// For a person
    Table,
    /// For a program
    Json,
    /// For a spreadsheet
    Csv,
}

/// What a picture is written as, by the ending of its file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Picture {
    Svg,
    Png,
    Pdf,
}

/// What a file holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Rows(Format),
    Picture(Picture),
}

impl Kind {
    /// By its ending, and for rows by the `format` that is asked for.
    ///
    /// **Errors**: those of [`Picture::of`]; an ending that names neither a picture nor rows, without a `format`.
    pub(super) fn of(path: &Path, format: Option<Format>) -> Result<Self, Failure> {
        let by_ending = match ending(path).as_deref() {
            Some("svg" | "png" | "pdf") => return Picture::of(path).map(Kind::Picture),
            Some("json") => Some(Format::Json),
            Some("csv") => Some(Format::Csv),
            Some("txt") | None => Some(Format::Table),
            Some(_) => None,
        };
        let path = path.display();
        format.or(by_ending).map(Kind::Rows).ok_or_else(|| {
            miette::miette!(
                "found {path}, expected .svg, .png, .pdf, .json, .csv or .txt, or --format to say what it holds"
            )
        })
    }
}

/// The ending of a file in small letters.
pub(super) fn ending(path: &Path) -> Option<String> {
    path.extension().and_then(|ending| ending.to_str()).map(str::to_lowercase)
}

/// The format that is asked for, or the one that the ending of the file says; an empty ending is that of no file.
///
/// **Errors**: an ending of none.
pub(super) fn format<F: Copy>(asked: Option<F>, path: Option<&Path>, endings: &[(&str, F)]) -> Result<F, Failure> {
    let found = path.and_then(ending).unwrap_or_default();
    let by_ending = || endings.iter().find(|known| known.0 == found).map(|known| known.1);
    asked.or_else(by_ending).ok_or_else(|| {
        let known: Vec<String> = endings.iter().map(|known| format!(".{}", known.0)).filter(|k| k != ".").collect();
        let known = known.join(", ");
        let known = known.rsplit_once(", ").map_or(known.clone(), |(most, last)| format!("{most} or {last}"));
        miette::miette!("found the ending .{found}, expected {known} here, or --format to say what the file holds")
    })
}

/// That `path`, or standard output, cannot be written.
pub(super) fn unwritten(path: Option<&Path>) -> impl FnOnce(std::io::Error) -> failure::Io + use<> {
    let path = path.filter(|path| *path != Path::new("-"));
    failure::cannot(&format!("write {}", path.map_or("standard output".into(), |path| path.display().to_string())))
}

/// Writes to a file whole or not at all, or to standard output.
pub(super) fn write(path: Option<&Path>, bytes: &[u8]) -> Result<(), Failure> {
    write_all(&[(path, bytes)])
}

/// Writes all of several files, or none.
fn write_all(files: &[(Option<&Path>, &[u8])]) -> Result<(), Failure> {
    Ok(write_together(files).map_err(|(k, error)| unwritten(files[k].0)(error))?)
}

/// Writes each file, all of them or none; rows are printed too, if no file holds any.
pub(super) fn write_each(
    paths: &[PathBuf],
    format: Option<Format>,
    bytes: impl Fn(Kind) -> Result<Vec<u8>, Failure>,
) -> Result<(), Failure> {
    let (mut files, mut printed) = (Vec::new(), false);
    for path in paths {
        let kind = Kind::of(path, format)?;
        printed |= matches!(kind, Kind::Rows(_));
        files.push((Some(path.as_path()), bytes(kind)?));
    }
    if !printed {
        files.push((None, bytes(Kind::Rows(format.unwrap_or(Format::Table)))?));
    }
    write_all(&files.iter().map(|(path, bytes)| (*path, bytes.as_slice())).collect::<Vec<_>>())
}

/// The bytes of a file that can be made.
pub(super) fn made(what: &str, made: Result<impl Into<Vec<u8>>, impl std::fmt::Display>) -> Result<Vec<u8>, Failure> {
    made.map(Into::into).map_err(|error| miette::miette!("cannot write {what}: {error}"))
}

/// The bytes of a JSON file.
pub(super) fn json(value: &serde_json::Value) -> Vec<u8> {
    format!("{value:#}\n").into_bytes()
}

impl Picture {
    /// **Errors**: an ending of no picture; a PNG or PDF in a build that draws none.
    pub(super) fn of(path: &Path) -> Result<Self, Failure> {
        match ending(path).as_deref() {
            Some("svg") => Ok(Picture::Svg),
            Some("png") if cfg!(feature = "plot") => Ok(Picture::Png),
            Some("pdf") if cfg!(feature = "plot") => Ok(Picture::Pdf),
            Some("png" | "pdf") => {
                Err(miette::miette!("found {} in a build without the feature `plot`, expected .svg", path.display()))
            }
            _ if path == Path::new("-") => Ok(Picture::Svg),
            _ => Err(miette::miette!("found {}, expected a file that ends in .svg, .png or .pdf", path.display())),
        }
    }
}

/// A picture as the bytes of its file.
pub(super) fn picture(kind: Picture, svg: String, size: Size) -> Result<Vec<u8>, Failure> {
    match kind {
        Picture::Svg => Ok(svg.into_bytes()),
        Picture::Png | Picture::Pdf => rendered(kind, &svg, size),
    }
}

#[cfg(feature = "plot")]
fn rendered(kind: Picture, svg: &str, size: Size) -> Result<Vec<u8>, Failure> {
    let drawn = Rendered::of(svg).and_then(|rendered| {
        let missing = rendered.missing();
        if !missing.is_empty() {
            eprintln!("note: the font of PNG and PDF has no {missing}, which stay empty; an SVG has all letters");
        }
        if kind == Picture::Pdf { rendered.pdf() } else { rendered.png(size.scale()) }
    });
    drawn.map_err(|error| miette::miette!("cannot draw: {error}"))
}

/// Refused before anything is solved.
#[cfg(not(feature = "plot"))]
fn rendered(_: Picture, _: &str, _: Size) -> Result<Vec<u8>, Failure> {
    Ok(Vec::new())
}
