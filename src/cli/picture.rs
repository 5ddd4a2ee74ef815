//! Pictures as files.

use std::path::Path;

use super::{Failure, source};
use crate::output::{Size, write_whole};

/// What a picture is written as, by the ending of its file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Svg,
    Png,
}

impl Kind {
    /// **Errors**: an ending of no picture; a PNG in a build that draws none.
    pub(super) fn of(path: &Path) -> Result<Self, Failure> {
        let ending = path.extension().and_then(|ending| ending.to_str()).map(str::to_lowercase);
        match ending.as_deref() {
            Some("svg") => Ok(Kind::Svg),
            Some("png") if cfg!(feature = "plot") => Ok(Kind::Png),
            Some("png") => {
                Err(miette::miette!("found {} in a build without the feature `plot`, expected .svg", path.display()))
            }
            Some("pdf") => Err(miette::miette!(
                help = "programs such as rsvg-convert and Inkscape turn an SVG into PDF",
                "found {}, expected a file that ends in .svg or .png: PDF is not written",
                path.display()
            )),
            _ if path == Path::new("-") => Ok(Kind::Svg),
            _ => Err(miette::miette!("found {}, expected a file that ends in .svg or .png", path.display())),
        }
    }
}

/// Writes a picture, whole or not at all.
pub(super) fn write(path: &Path, kind: Kind, svg: &str, size: Size) -> Result<(), Failure> {
    let written = match kind {
        Kind::Svg => write_whole(Some(path), svg.as_bytes()),
        Kind::Png => write_whole(Some(path), &png(svg, size)?),
    };
    let name = if path == Path::new("-") { "standard output".into() } else { path.display().to_string() };
    Ok(written.map_err(source::cannot(&format!("write {name}")))?)
}

#[cfg(feature = "plot")]
pub(super) fn png(svg: &str, size: Size) -> Result<Vec<u8>, Failure> {
    crate::output::png(svg, size.scale()).map_err(|error| miette::miette!("cannot draw: {error}"))
}

/// Refused before anything is solved.
#[cfg(not(feature = "plot"))]
pub(super) fn png(_: &str, _: Size) -> Result<Vec<u8>, Failure> {
    Ok(Vec::new())
}
