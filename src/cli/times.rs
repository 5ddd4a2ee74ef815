//! Times for a golden file: from the command line, or from a file that is read as it is needed.

use std::fs::File;
use std::io::{BufRead, BufReader, Seek};
use std::path::Path;

use super::failure::Failure;
use super::failure::cannot;
use crate::number::{List, Number, Scalar};

/// Where the times come from.
#[derive(Debug)]
pub(super) enum Times {
    List(List),
    File(TimesFile),
    /// The start, every impact and release, and the end.
    Events,
}

/// A file of times that has been read once and found good.
#[derive(Debug)]
pub(super) struct TimesFile {
    file: File,
    name: String,
    least: Number,
    greatest: Number,
}

/// Rows that are asked about at once.
pub(super) const CHUNK: usize = 1 << 14;

impl TimesFile {
    /// Checks the file at `path`, or standard input for `-`: one time a line; empty lines and what follows a `#` do
    /// not count.
    ///
    /// **Errors**: the first line that is no time, with its number.
    pub(super) fn open(path: &Path) -> Result<Self, Failure> {
        let stdin = path == Path::new("-");
        let name = if stdin { "standard input".to_string() } else { path.display().to_string() };
        let read = || cannot(&format!("read {name}"));
        let mut file = if stdin { tempfile::tempfile() } else { File::open(path) }.map_err(read())?;
        if stdin {
            std::io::copy(&mut std::io::stdin(), &mut file).map_err(read())?;
        } else if !file.metadata().map_err(read())?.is_file() {
            // What can be read only once is kept.
            let mut kept = tempfile::tempfile().map_err(read())?;
            std::io::copy(&mut file, &mut kept).map_err(read())?;
            file = kept;
        }
        let mut ends: Option<(Number, Number)> = None;
        lines(&file, &name, |time| {
            match &mut ends {
                None => ends = Some((time.clone(), time)),
                Some((least, _)) if time.compare(least).is_lt() => *least = time,
                Some((_, greatest)) if time.compare(greatest).is_gt() => *greatest = time,
                Some(_) => (),
            }
            Ok(())
        })?;
        let Some((least, greatest)) = ends else {
            return Err(failure!("{name}: found no times, expected one a line"));
        };
        Ok(TimesFile { file, name, least, greatest })
    }

    fn chunks(&self, at_once: usize, visit: &mut dyn FnMut(List) -> Result<(), Failure>) -> Result<(), Failure> {
        let mut chunk = Vec::with_capacity(at_once);
        lines(&self.file, &self.name, |time| {
            chunk.push(time);
            if chunk.len() < at_once {
                return Ok(());
            }
            visit(List::Numbers(std::mem::replace(&mut chunk, Vec::with_capacity(at_once))))
        })?;
        if chunk.is_empty() { Ok(()) } else { visit(List::Numbers(chunk)) }
    }
}

/// Reads the times of a file from its beginning.
fn lines(mut file: &File, name: &str, mut visit: impl FnMut(Number) -> Result<(), Failure>) -> Result<(), Failure> {
    let read = || cannot(&format!("read {name}"));
    file.rewind().map_err(read())?;
    let mut reader = BufReader::new(file);
    let (mut line, mut row) = (String::new(), 0);
    loop {
        line.clear();
        row += 1;
        if reader.read_line(&mut line).map_err(read())? == 0 {
            return Ok(());
        }
        let text = line.split('#').next().unwrap_or_default().trim_start_matches('\u{feff}').trim();
        if text.is_empty() {
            continue;
        }
        let values = text.split(|c: char| c == ',' || c == ';' || c.is_whitespace()).filter(|part| !part.is_empty());
        let count = values.count();
        if count != 1 {
            return Err(failure!("{name}, row {row}: found {count} values, expected one time a line"));
        }
        let time: Number = text.parse().map_err(|error| failure!("{name}, row {row}: {error}"))?;
        if time.to_f64() < 0.0 {
            return Err(failure!("{name}, row {row}: found time {time}, expected times from 0 on"));
        }
        visit(time)?;
    }
}

impl Times {
    /// The first and the last time; `None` for events.
    pub(super) fn ends(&self) -> Result<Option<(Number, Number)>, Failure> {
        match self {
            Times::Events => Ok(None),
            Times::File(file) => Ok(Some((file.least.clone(), file.greatest.clone()))),
            Times::List(list) => match (list.least(), list.greatest()) {
                (Some(least), Some(greatest)) if least.to_f64() >= 0.0 => Ok(Some((least, greatest))),
                (Some(least), _) => Err(failure!("found time {least}, expected times from 0 on")),
                _ => Err(failure!("found no times, expected at least one")),
            },
        }
    }

    /// Hands out all times in their order, so many at once; `None` stands for the events.
    pub(super) fn chunks(
        &self,
        at_once: usize,
        visit: &mut dyn FnMut(Option<Chunk<'_>>) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        match self {
            Times::Events => visit(None),
            Times::File(file) => {
                file.chunks(at_once, &mut |list| visit(Some(Chunk { from: 0, to: list.len(), list: &list })))
            }
            Times::List(list) => (0..list.len())
                .step_by(at_once)
                .try_for_each(|from| visit(Some(Chunk { list, from, to: (from + at_once).min(list.len()) }))),
        }
    }
}

/// A part of a list of times.
pub(super) struct Chunk<'a> {
    list: &'a List,
    from: usize,
    to: usize,
}

impl Chunk<'_> {
    pub(super) fn lift<S: Scalar>(&self, precision: &S::Precision) -> Vec<S> {
        self.list.lift_part(self.from..self.to, precision)
    }
}
