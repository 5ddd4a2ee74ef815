//! Finished points on disk, so that an interrupted sweep goes on where it was.
//!
//! A journal is a text of lines: the identity of the sweep, then a finished point a line, in the order in which they
//! were finished. A last line that is not whole is that of a sweep that was killed while it wrote; its point is solved
//! again.

use std::fs::{File, OpenOptions};
use std::io::{Error, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use serde_json::Value;

use super::run::Point;

/// The finished points of a sweep in a file.
#[derive(Debug)]
pub(crate) struct Journal {
    path: PathBuf,
    file: Mutex<File>,
}

impl Journal {
    /// Opens the journal beside `output`, and returns the points that it holds. `sweep` is everything that the points
    /// depend on.
    ///
    /// **Errors**: those of the file system; [`ErrorKind::AlreadyExists`] where there is a journal and none is to be
    /// resumed; [`ErrorKind::InvalidData`] for one of another sweep.
    pub(crate) fn open(output: &Path, sweep: &Value, resume: bool) -> Result<(Self, Vec<Point>), Error> {
        let path = journal_path(output);
        if !resume && path.exists() {
            return Err(ErrorKind::AlreadyExists.into());
        }
        let mut bytes = match std::fs::read(&path) {
            Err(error) if error.kind() == ErrorKind::NotFound => Vec::new(),
            other => other?,
        };
        // The text after the last end of a line was not finished.
        bytes.truncate(bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1));
        let whole = String::from_utf8(bytes).map_err(|_| ErrorKind::InvalidData)?;
        let mut lines = whole.lines();
        let points = match lines.next() {
            None => Some(Vec::new()),
            Some(head) if serde_json::from_str(head).is_ok_and(|head: Value| head == *sweep) => {
                lines.map(serde_json::from_str).collect::<Result<Vec<Point>, _>>().ok()
            }
            Some(_) => None,
        };
        let points = points.ok_or(ErrorKind::InvalidData)?;
        let mut file = OpenOptions::new().create(true).truncate(false).write(true).open(&path)?;
        file.set_len(whole.len() as u64)?;
        std::io::Seek::seek(&mut file, std::io::SeekFrom::End(0))?;
        if whole.is_empty() {
            file.write_all(format!("{sweep}\n").as_bytes())?;
        }
        Ok((Journal { path, file: Mutex::new(file) }, points))
    }

    /// Adds a finished point.
    pub(crate) fn add(&self, point: &Point) -> Result<(), Error> {
        let line = serde_json::to_string(point)? + "\n";
        self.file.lock().unwrap_or_else(PoisonError::into_inner).write_all(line.as_bytes())
    }

    /// Removes the journal of a sweep whose output is written.
    pub(crate) fn remove(self) -> Result<(), Error> {
        std::fs::remove_file(&self.path)
    }
}

/// Returns the path `FILE.unfinished`.
pub(crate) fn journal_path(output: &Path) -> PathBuf {
    let mut name = output.as_os_str().to_os_string();
    name.push(".unfinished");
    name.into()
}

#[cfg(test)]
#[path = "tests/journal.rs"]
mod tests;
