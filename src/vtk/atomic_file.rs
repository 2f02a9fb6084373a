//! Output that appears whole or not at all.

use super::error::VtkError;
use std::fs::{self, File, Permissions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};

/// A file that appears under its name only when it is [committed](Self::commit).
///
/// Until then it has a temporary name in the same folder, and dropping it removes it: a
/// run that fails leaves no half file, and keeps the old file. Devices and pipes
/// (`/dev/stdout`) are written directly. Errors name the file.
#[derive(Debug)]
pub struct AtomicFile {
    path: PathBuf,
    out: BufWriter<Target>,
}

#[derive(Debug)]
enum Target {
    Temporary(NamedTempFile),
    Direct(File),
}

impl Write for Target {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::Temporary(file) => file.write(bytes),
            Self::Direct(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Temporary(file) => file.flush(),
            Self::Direct(file) => file.flush(),
        }
    }
}

impl AtomicFile {
    /// Begins a file that will be called `path`.
    ///
    /// # Errors
    /// [`VtkError::Write`]: the folder is missing or may not be written, or `path` is a
    /// folder.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, VtkError> {
        let path = path.as_ref();
        let target = open(path).map_err(|error| VtkError::Write(named(path, error)))?;
        Ok(Self { path: path.to_owned(), out: BufWriter::with_capacity(1 << 16, target) })
    }

    /// The name the file will have.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Gives the file its name, replacing an old one.
    ///
    /// # Errors
    /// [`VtkError::Write`]: the rest could not be written, or the file not be renamed; it
    /// is removed then.
    pub fn commit(self) -> Result<(), VtkError> {
        let path = self.path;
        let finished = self.out.into_inner().map_err(|error| error.into_error());
        finished
            .and_then(|target| match target {
                Target::Temporary(file) => {
                    let result = file.persist(real_name(&path));
                    result.map(drop).map_err(|error| error.error)
                }
                Target::Direct(mut file) => file.flush(),
            })
            .map_err(|error| VtkError::Write(named(&path, error)))
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let result = self.out.write(bytes);
        result.map_err(|error| named(&self.path, error))
    }

    fn write_all(&mut self, bytes: &[u8]) -> io::Result<()> {
        let result = self.out.write_all(bytes);
        result.map_err(|error| named(&self.path, error))
    }

    fn flush(&mut self) -> io::Result<()> {
        let result = self.out.flush();
        result.map_err(|error| named(&self.path, error))
    }
}

fn open(path: &Path) -> io::Result<Target> {
    let old = fs::metadata(path).ok();
    match &old {
        Some(old) if old.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
        Some(old) if !old.is_file() => {
            return fs::OpenOptions::new().write(true).open(path).map(Target::Direct);
        }
        _ => {}
    }
    let name = real_name(path);
    let folder = name.parent().filter(|folder| !folder.as_os_str().is_empty());
    let mut prefix = std::ffi::OsString::from(".");
    prefix.push(name.file_name().unwrap_or_default());
    let mut builder = Builder::new();
    builder.prefix(&prefix).suffix(".tmp");
    if let Some(permissions) = old.map(|old| old.permissions()).or_else(usual_permissions) {
        builder.permissions(permissions);
    }
    let file = builder.tempfile_in(folder.unwrap_or(Path::new(".")))?;
    Ok(Target::Temporary(file))
}

/// Where a link leads: the file is replaced there, and the link kept.
fn real_name(path: &Path) -> PathBuf {
    match fs::symlink_metadata(path) {
        Ok(metadata) if metadata.is_symlink() => {
            fs::canonicalize(path).unwrap_or_else(|_| path.to_owned())
        }
        _ => path.to_owned(),
    }
}

/// Temporary files are private unless told otherwise; output is not.
#[cfg(unix)]
fn usual_permissions() -> Option<Permissions> {
    use std::os::unix::fs::PermissionsExt;
    Some(Permissions::from_mode(0o666))
}

#[cfg(not(unix))]
fn usual_permissions() -> Option<Permissions> {
    None
}

/// The error with the file's name.
fn named(path: &Path, error: io::Error) -> io::Error {
    let text = format!("cannot write '{}': {error}", path.display());
    io::Error::new(error.kind(), text)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let name = |entry: io::Result<fs::DirEntry>| entry.unwrap().file_name();
        entries.map(|entry| name(entry).into_string().unwrap()).collect()
    }

    #[test]
    fn committed_files_replace_old_ones() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.json");
        fs::write(&path, "old").unwrap();
        let mut file = AtomicFile::create(&path).unwrap();
        file.write_all(b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"old");
        file.commit().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(names(folder.path()), ["x.json"]);
    }

    #[test]
    fn dropped_files_leave_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let mut file = AtomicFile::create(folder.path().join("x")).unwrap();
        file.write_all(&[0; 1 << 20]).unwrap();
        drop(file);
        assert!(names(folder.path()).is_empty());
    }

    #[test]
    fn errors_name_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let missing = folder.path().join("no").join("x.vtp");
        let message = AtomicFile::create(&missing).unwrap_err().to_string();
        assert!(message.contains("x.vtp"), "{message}");
        let message = AtomicFile::create(folder.path()).unwrap_err().to_string();
        assert!(message.contains("directory"), "{message}");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_reported_with_the_name() {
        let mut file = AtomicFile::create("/dev/full").unwrap();
        let written = file.write_all(&[0; 1 << 20]);
        let message = written.unwrap_err().to_string();
        assert!(message.contains("'/dev/full'"), "{message}");
        let mut file = AtomicFile::create("/dev/full").unwrap();
        file.write_all(b"x").unwrap();
        assert!(matches!(file.commit(), Err(VtkError::Write(_))));
    }

    #[cfg(unix)]
    #[test]
    fn permissions_and_links_are_kept() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().unwrap();
        let [real, link] = ["real", "link"].map(|name| folder.path().join(name));
        fs::write(&real, "old").unwrap();
        fs::set_permissions(&real, Permissions::from_mode(0o640)).unwrap();
        symlink(&real, &link).unwrap();
        AtomicFile::create(&link).unwrap().commit().unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&real).unwrap(), b"");
        let mode = fs::metadata(&real).unwrap().permissions().mode();
        assert_eq!(mode & 0o777, 0o640);
    }
}
