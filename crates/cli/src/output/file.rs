//! Files written whole or not at all.

use std::fs::File;
use std::io::{self, ErrorKind, Seek, Write};
use std::path::Path;

use tempfile::NamedTempFile;

/// Writes bytes to each path, or to standard output for `-` or none: all files appear, each complete, or none.
pub(crate) fn write_together(files: &[(Option<&Path>, &[u8])]) -> Result<(), (usize, io::Error)> {
    let (mut staged, mut printed) = (Vec::new(), Vec::new());
    for (k, (path, bytes)) in files.iter().enumerate() {
        match named(*path) {
            Some(path) => {
                staged.push((k, path, stage(path, |file| file.write_all(bytes)).map_err(|error| (k, error))?))
            }
            None => printed.push((k, bytes)),
        }
    }
    for (k, path, file) in staged {
        file.persist(path).map_err(|error| (k, error.into()))?;
    }
    printed.into_iter().try_for_each(|(k, bytes)| to_stdout(|out| out.write_all(bytes)).map_err(|error| (k, error)))
}

/// Lets `fill` write a file, and gives it its name, or copies it to standard output, when it is complete.
pub(crate) fn write_filled(path: Option<&Path>, fill: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<()> {
    let Some(path) = named(path) else {
        let mut file = tempfile::tempfile()?;
        fill(&mut file)?;
        file.rewind()?;
        return to_stdout(|out| io::copy(&mut file, out).map(|_| ()));
    };
    stage(path, fill)?.persist(path)?;
    Ok(())
}

fn named(path: Option<&Path>) -> Option<&Path> {
    path.filter(|path| *path != Path::new("-"))
}

fn to_stdout(write: impl FnOnce(&mut io::StdoutLock<'_>) -> io::Result<()>) -> io::Result<()> {
    let mut out = io::stdout().lock();
    match write(&mut out).and_then(|()| out.flush()) {
        // A reader that has seen enough, such as `head`.
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        other => other,
    }
}

/// A file that `fill` has written, complete beside its place, where it is moved next.
fn stage(path: &Path, fill: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<NamedTempFile> {
    if path.is_dir() {
        return Err(ErrorKind::IsADirectory.into());
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".dalembert-");
    // The permissions of a plain new file, not those of a private temporary one.
    #[cfg(unix)]
    let builder = {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666))
    };
    let mut file = builder.tempfile_in(folder).map_err(|error| plain(&error, folder))?;
    fill(file.as_file_mut()).map_err(|error| io::Error::from(error.kind()))?;
    Ok(file)
}

/// The error of making a temporary file in `folder`, without the name of that file.
fn plain(error: &io::Error, folder: &Path) -> io::Error {
    let what = match error.kind() {
        // Some folders of the system hold no files of others, and say the same.
        ErrorKind::NotFound if folder.is_dir() => "no file can be made in",
        ErrorKind::NotFound => "no folder",
        kind => return kind.into(),
    };
    io::Error::new(ErrorKind::NotFound, format!("{what} {}", folder.display()))
}

/// Writes files into a folder, which is made where there is none: all of them, or none.
pub(crate) fn write_files(folder: &Path, files: &[(String, Vec<u8>)]) -> io::Result<()> {
    if !folder.is_dir() {
        let parent = folder.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        std::fs::create_dir(folder).map_err(|error| plain(&error, parent))?;
    }
    let paths = files.iter().map(|(name, _)| folder.join(name)).collect::<Vec<_>>();
    let files: Vec<_> = paths.iter().zip(files).map(|(path, (_, bytes))| (Some(&**path), &**bytes)).collect();
    write_together(&files).map_err(|(_, error)| error)
}
