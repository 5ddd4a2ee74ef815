//! Times for a golden file: from the command line, or from a file that is read as it is needed.

use std::fs::File;
use std::io::{BufRead, BufReader, Seek};
use std::ops::Range;
use std::path::Path;

use super::failure::{Failure, cannot};
use crate::number::{List, Number};

#[derive(Debug)]
pub(super) enum Times {
    List(List),
    /// A file, with its name, that has been read once and found good, and its first and its last time.
    File(File, String, [Number; 2]),
    /// The start, every impact and release, and the end.
    Events,
}

/// Rows that are asked about at once.
pub(super) const CHUNK: usize = 1 << 14;

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
    /// Checks the file at `path`, or standard input for `-`: one time a line; empty lines and what follows a `#` do
    /// not count.
    pub(super) fn open(path: &Path) -> Result<Self, Failure> {
        let stdin = path == Path::new("-");
        let name = if stdin { "standard input".to_string() } else { path.display().to_string() };
        let read = || cannot(&format!("read {name}"));
        let keep = |from: &mut dyn std::io::Read| {
            let mut kept = tempfile::tempfile()?;
            std::io::copy(from, &mut kept).map(|_| kept)
        };
        let mut file = if stdin { keep(&mut std::io::stdin()) } else { File::open(path) }.map_err(read())?;
        // What can be read only once is kept.
        if !file.metadata().map_err(read())?.is_file() {
            file = keep(&mut file).map_err(read())?;
        }
        let mut ends: Option<[Number; 2]> = None;
        lines(&file, &name, |time| {
            match &mut ends {
                None => ends = Some([time.clone(), time]),
                Some([least, _]) if time.compare(least).is_lt() => *least = time,
                Some([_, greatest]) if time.compare(greatest).is_gt() => *greatest = time,
                Some(_) => (),
            }
            Ok(())
        })?;
        let ends = ends.ok_or_else(|| failure!("{name}: found no times, expected one a line"))?;
        Ok(Times::File(file, name, ends))
    }

    /// The first and the last time; `None` for events.
    pub(super) fn ends(&self) -> Result<Option<[Number; 2]>, Failure> {
        match self {
            Times::Events => Ok(None),
            Times::File(.., ends) => Ok(Some(ends.clone())),
            Times::List(list) => match (list.least(), list.greatest()) {
                (Some(least), Some(greatest)) if least.to_f64() >= 0.0 => Ok(Some([least, greatest])),
                (Some(least), _) => Err(failure!("found time {least}, expected times from 0 on")),
                _ => Err(failure!("found no times, expected at least one")),
            },
        }
    }

    /// Hands out all times in their order, so many at once, as parts of lists; `None` stands for the events.
    pub(super) fn chunks(
        &self,
        at_once: usize,
        visit: &mut dyn FnMut(Option<Chunk<'_>>) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        match self {
            Times::Events => visit(None),
            Times::List(list) => (0..list.len())
                .step_by(at_once)
                .try_for_each(|from| visit(Some((list, from..(from + at_once).min(list.len()))))),
            Times::File(file, name, _) => {
                let mut chunk = Vec::with_capacity(at_once);
                let mut whole = |chunk: &mut Vec<Number>| {
                    let list = List::Numbers(std::mem::replace(chunk, Vec::with_capacity(at_once)));
                    visit(Some((&list, 0..list.len())))
                };
                lines(file, name, |time| {
                    chunk.push(time);
                    if chunk.len() < at_once { Ok(()) } else { whole(&mut chunk) }
                })?;
                if chunk.is_empty() { Ok(()) } else { whole(&mut chunk) }
            }
        }
    }
}

pub(super) type Chunk<'a> = (&'a List, Range<usize>);
