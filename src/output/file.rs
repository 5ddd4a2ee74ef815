//! Files written whole or not at all.

use std::io::{ErrorKind, Write};
use std::path::Path;

/// Writes `bytes` to `path`, or to standard output for `-` or none. A file appears complete or not at all.
pub fn write_whole(path: Option<&Path>, bytes: &[u8]) -> std::io::Result<()> {
    let Some(path) = path.filter(|path| *path != Path::new("-")) else {
        let mut out = std::io::stdout().lock();
        return match out.write_all(bytes).and_then(|()| out.flush()) {
            // A reader that has seen enough, such as `head`.
            Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
            other => other,
        };
    };
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".dalembert-");
    // The permissions of a plain new file, not those of a private temporary one.
    #[cfg(unix)]
    let builder = {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666))
    };
    // The name of the temporary file, which the error would carry, is nobody's business.
    let plain = |error: std::io::Error| match error.kind() {
        ErrorKind::NotFound => std::io::Error::new(ErrorKind::NotFound, format!("no folder {}", folder.display())),
        kind => kind.into(),
    };
    let mut file = builder.tempfile_in(folder).map_err(plain)?;
    file.write_all(bytes).map_err(|error| std::io::Error::from(error.kind()))?;
    file.persist(path)?;
    Ok(())
}
