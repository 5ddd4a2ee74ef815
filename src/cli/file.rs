//! What a file holds by its ending, and writing it.

use std::path::Path;

use super::{Failure, Format, source};
#[cfg(feature = "plot")]
use crate::output::Rendered;
use crate::output::{Size, write_together};

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

/// Writes to a file whole or not at all, or to standard output.
pub(super) fn write(path: Option<&Path>, bytes: &[u8]) -> Result<(), Failure> {
    write_all(&[(path, bytes)])
}

/// Writes all of several files, or none.
pub(super) fn write_all(files: &[(Option<&Path>, &[u8])]) -> Result<(), Failure> {
    Ok(write_together(files).map_err(|(k, error)| {
        let path = files[k].0.filter(|path| *path != Path::new("-"));
        let name = path.map_or("standard output".into(), |path| path.display().to_string());
        source::cannot(&format!("write {name}"))(error)
    })?)
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
