//! File formats by the ending of a name, and writing files whole or not at all.

use std::fs::File;
use std::io::{self, ErrorKind, Seek, Write};
use std::path::{Path, PathBuf};

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use tempfile::NamedTempFile;

use crate::failure::{self, Failure};
#[cfg(feature = "raster")]
use dalembert_plot::draw::ParsedSvg;
use dalembert_plot::draw::Size;

/// A format of output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Table,
    Json,
    Csv,
    Npz,
    Markdown,
    Bibtex,
    Toml,
    Svg,
    Png,
    Pdf,
}

/// Each format with its word after `--format`, the ending of its files, and its purpose.
const FORMATS: [(Format, &str, &str, &str); 10] = [
    (Format::Table, "table", "txt", "For a person"),
    (Format::Json, "json", "json", "For a program"),
    (Format::Csv, "csv", "csv", "For a spreadsheet"),
    (Format::Npz, "npz", "npz", "For NumPy: an array for each column"),
    (Format::Markdown, "markdown", "md", "For a page: nothing that depends on the machine"),
    (Format::Bibtex, "bibtex", "bib", "For a list of references"),
    (Format::Toml, "toml", "toml", "A scene"),
    (Format::Svg, "svg", "svg", "A picture"),
    (Format::Png, "png", "png", "A picture"),
    (Format::Pdf, "pdf", "pdf", "A picture"),
];

pub(crate) const PICTURES: &[Format] = &[Format::Svg, Format::Png, Format::Pdf];
pub(crate) const ROWS: &[Format] = &[Format::Table, Format::Json, Format::Csv];
pub(crate) const ROWS_OR_PICTURE: &[Format] =
    &[Format::Table, Format::Json, Format::Csv, Format::Svg, Format::Png, Format::Pdf];

/// Returns a parser of the words of `known` formats.
pub(crate) fn formats(known: &'static [Format]) -> impl TypedValueParser<Value = Format> {
    let known = FORMATS.iter().filter(|format| known.contains(&format.0));
    let values = known.map(|(_, word, _, help)| PossibleValue::new(*word).help(*help));
    let named = |word: String| FORMATS.iter().find(|format| format.1 == word).map(|format| format.0);
    PossibleValuesParser::new(values).try_map(move |word| named(word).ok_or("expected a format"))
}

impl Format {
    pub(crate) fn is_picture(self) -> bool {
        PICTURES.contains(&self)
    }

    /// Returns the ending of a file of this format, without its dot.
    pub(crate) fn ending(self) -> &'static str {
        FORMATS[self as usize].2
    }
}

/// Returns the format of the file `path`, one of `known`: that of its ending for a picture, else the `requested` one,
/// else that of its ending. Standard output, and where rows are known a file without an ending, has the first.
pub(crate) fn format(path: &Path, requested: Option<Format>, known: &[Format]) -> Result<Format, Failure> {
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let only_rows = known[0] == Format::Table || !known.iter().any(|format| format.is_picture());
    let has_default = path == Path::new("-") || (ending.is_empty() && only_rows);
    let by_ending = known.iter().find(|format| format.ending() == ending).or(has_default.then_some(&known[0])).copied();
    let format = by_ending.filter(|format| format.is_picture()).or(requested).or(by_ending);
    let path = path.display();
    match format {
        None => {
            let endings: Vec<String> = known.iter().map(|format| format!(".{}", format.ending())).collect();
            let endings = endings.join(", ");
            let endings = endings.rsplit_once(", ").map_or(endings.clone(), |(most, last)| format!("{most} or {last}"));
            let or = if known.contains(&Format::Json) { ", or --format to say what the file holds" } else { "" };
            Err(failure!("found {path}, expected a file that ends in {endings}{or}"))
        }
        Some(Format::Png | Format::Pdf) if !cfg!(feature = "raster") => {
            Err(failure!("found {path} in a build without the feature `raster`, expected .svg"))
        }
        Some(format) => Ok(format),
    }
}

/// A file or standard output, and the format of what is written there.
#[derive(Clone, Debug)]
pub(crate) struct Destination {
    /// Path of the file; `None` stands for standard output.
    pub(crate) path: Option<PathBuf>,
    pub(crate) format: Format,
}

impl Destination {
    /// Returns whether a table is printed on standard output.
    pub(crate) fn is_printed_table(&self) -> bool {
        self.path.is_none() && self.format == Format::Table
    }

    /// Writes what `fill` writes: to the file when it is complete, or to standard output.
    pub(crate) fn write_with(&self, fill: impl FnOnce(&mut File) -> io::Result<()>) -> Result<(), Failure> {
        let write = || match &self.path {
            Some(path) => put(stage(path, fill)?, path),
            None => {
                let mut file = tempfile::tempfile()?;
                fill(&mut file)?;
                file.rewind()?;
                to_stdout(|out| io::copy(&mut file, out).map(drop))
            }
        };
        let name = self.path.as_ref().map_or_else(|| "standard output".into(), |path| path.display().to_string());
        write().map_err(failure::cannot(&format!("write {name}")))
    }
}

/// Writes the bytes of each destination: all files appear, each complete, or none.
pub(crate) fn write_all(
    destinations: &[Destination],
    bytes: impl Fn(Format) -> Result<Vec<u8>, Failure>,
) -> Result<(), Failure> {
    let contents = destinations.iter().map(|destination| bytes(destination.format)).collect::<Result<Vec<_>, _>>()?;
    let contents = || destinations.iter().map(|destination| &destination.path).zip(&contents);
    put_all(contents().filter_map(|(path, bytes)| Some((path.clone()?, bytes.as_slice()))))?;
    contents().filter(|(path, _)| path.is_none()).try_for_each(|(_, bytes)| print(bytes))
}

/// Writes files with their bytes: all of them appear, each complete, or none.
fn put_all<'a>(files: impl Iterator<Item = (PathBuf, &'a [u8])>) -> Result<(), Failure> {
    let cannot_write = |path: &Path| failure::cannot(&format!("write {}", path.display()));
    let stage = |(path, bytes): (PathBuf, &[u8])| {
        let file = stage(&path, |file| file.write_all(bytes)).map_err(cannot_write(&path))?;
        Ok((file, path))
    };
    let staged = files.map(stage).collect::<Result<Vec<_>, Failure>>()?;
    staged.into_iter().try_for_each(|(file, path)| put(file, &path).map_err(cannot_write(&path)))
}

/// Writes each destination, all files or none; prints the rows in `format` too, if no destination holds any.
pub(crate) fn write_with_rows(
    mut destinations: Vec<Destination>,
    format: Option<Format>,
    bytes: impl Fn(Format) -> Result<Vec<u8>, Failure>,
) -> Result<(), Failure> {
    if destinations.iter().all(|destination| destination.format.is_picture()) {
        destinations.push(Destination { path: None, format: format.unwrap_or(Format::Table) });
    }
    write_all(&destinations, bytes)
}

/// Prints `text` on standard output.
pub(crate) fn print(text: &[u8]) -> Result<(), Failure> {
    to_stdout(|out| out.write_all(text)).map_err(failure::cannot("write standard output"))
}

fn to_stdout(write: impl FnOnce(&mut io::StdoutLock<'_>) -> io::Result<()>) -> io::Result<()> {
    let mut out = io::stdout().lock();
    match write(&mut out).and_then(|()| out.flush()) {
        // A reader that has seen enough, such as `head`.
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        other => other,
    }
}

/// Returns whether a path is there, and neither a file nor a folder: a device or a pipe.
fn is_special(path: &Path) -> bool {
    path.metadata().is_ok_and(|found| !found.is_file() && !found.is_dir())
}

/// Puts a complete file in its place. What is written to a device or a pipe goes into it and does not replace it.
fn put(file: NamedTempFile, path: &Path) -> io::Result<()> {
    if !is_special(path) {
        return Ok(file.persist(path).map(drop)?);
    }
    let mut device = File::options().write(true).open(path)?;
    io::copy(&mut file.reopen()?, &mut device).map(drop)
}

/// Returns a temporary file beside `path` that `fill` has written.
fn stage(path: &Path, fill: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<NamedTempFile> {
    if path.is_dir() {
        return Err(ErrorKind::IsADirectory.into());
    }
    let beside = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let temporary = std::env::temp_dir();
    let folder = if is_special(path) { &temporary } else { beside };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".dalembert-");
    // The permissions of a plain new file, not those of a private temporary one.
    #[cfg(unix)]
    let builder = {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666))
    };
    let mut file = builder.tempfile_in(folder).map_err(|error| without_file_name(&error, folder))?;
    fill(file.as_file_mut()).map_err(|error| io::Error::from(error.kind()))?;
    Ok(file)
}

/// Returns the error of making a temporary file in `folder`, without the name of that file.
fn without_file_name(error: &io::Error, folder: &Path) -> io::Error {
    let problem = match error.kind() {
        // Some folders of the system hold no files of others, and report the same.
        ErrorKind::NotFound if folder.is_dir() => "no file can be made in",
        ErrorKind::NotFound => "no folder",
        kind => return kind.into(),
    };
    io::Error::new(ErrorKind::NotFound, format!("{problem} {}", folder.display()))
}

/// Writes named files into a folder, which is made if it does not exist: all of them, or none.
pub(crate) fn write_folder(folder: &Path, files: &[(String, Vec<u8>)]) -> Result<(), Failure> {
    if !folder.is_dir() {
        let parent = folder.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let made = std::fs::create_dir(folder).map_err(|error| without_file_name(&error, parent));
        made.map_err(failure::cannot(&format!("write {}", folder.display())))?;
    }
    put_all(files.iter().map(|(name, bytes)| (folder.join(name), bytes.as_slice())))
}

/// Returns a picture as the bytes of its file.
#[cfg(feature = "raster")]
pub(crate) fn picture(format: Format, svg: String, size: Size) -> Result<Vec<u8>, Failure> {
    if format == Format::Svg {
        return Ok(svg.into_bytes());
    }
    let drawn = ParsedSvg::new(&svg).and_then(|parsed| {
        let missing = parsed.missing_letters();
        if !missing.is_empty() {
            crate::terminal::note(format!(
                "the font of PNG and PDF has no {missing}, which stay empty; an SVG has all letters"
            ));
        }
        if format == Format::Pdf { parsed.pdf() } else { parsed.png(size.scale()) }
    });
    drawn.map_err(|error| failure!("cannot draw: {error}"))
}

/// Returns a picture as the bytes of its file: SVG, as others are refused before anything is solved.
#[cfg(not(feature = "raster"))]
pub(crate) fn picture(_: Format, svg: String, _: Size) -> Result<Vec<u8>, Failure> {
    Ok(svg.into_bytes())
}
