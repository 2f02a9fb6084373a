//! Output that appears whole or not at all.

use super::error::VtkError;
use super::unfinished::TemporaryName;
use std::fs::{self, File, Permissions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::Builder;

/// A file that appears under its name only when it is [committed](Self::commit).
///
/// Until then it has a temporary name in the same folder, and dropping it removes it: a
/// run that fails leaves no half file, and keeps the old file. Devices and pipes
/// (`/dev/stdout`) are written directly. Errors name the file.
#[derive(Debug)]
pub struct AtomicFile {
    path: PathBuf,
    out: BufWriter<File>,
    /// None for devices and pipes.
    name: Option<TemporaryName>,
}

/// A file that is written but has not yet its name: see [`AtomicFile::close`].
#[derive(Debug)]
pub struct ClosedFile {
    path: PathBuf,
    name: Option<TemporaryName>,
}

impl AtomicFile {
    /// Begins a file that will be called `path`.
    ///
    /// # Errors
    /// [`VtkError::Write`]: the folder is missing or may not be written, or `path` is a
    /// folder.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, VtkError> {
        let path = path.as_ref();
        let opened = open(path).map_err(|error| VtkError::Write(named(path, error)));
        let (file, name) = opened?;
        Ok(Self { path: path.to_owned(), out: BufWriter::with_capacity(1 << 16, file), name })
    }

    /// The name the file will have.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Ends the writing. The file gets its name when it is [committed](ClosedFile::commit):
    /// so that several files can appear together, or none of them.
    ///
    /// # Errors
    /// [`VtkError::Write`]: the rest could not be written; the file is removed then.
    pub fn close(self) -> Result<ClosedFile, VtkError> {
        let Self { path, out, name } = self;
        match out.into_inner() {
            Ok(_) => Ok(ClosedFile { path, name }),
            Err(error) => Err(VtkError::Write(named(&path, error.into_error()))),
        }
    }

    /// Gives the file its name, replacing an old one.
    ///
    /// # Errors
    /// [`VtkError::Write`]: the rest could not be written, or the file not be renamed; it
    /// is removed then.
    pub fn commit(self) -> Result<(), VtkError> {
        self.close()?.commit()
    }
}

impl ClosedFile {
    /// Gives the file its name, replacing an old one.
    ///
    /// # Errors
    /// [`VtkError::Write`]: the file cannot be renamed; it is removed then.
    pub fn commit(self) -> Result<(), VtkError> {
        let renamed = self.name.map_or(Ok(()), |name| name.become_file(&real_name(&self.path)));
        renamed.map_err(|error| VtkError::Write(named(&self.path, error)))
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

fn open(path: &Path) -> io::Result<(File, Option<TemporaryName>)> {
    let old = fs::metadata(path).ok();
    match &old {
        Some(old) if old.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
        Some(old) if !old.is_file() => {
            return Ok((fs::OpenOptions::new().write(true).open(path)?, None));
        }
        _ => {}
    }
    let name = real_name(path);
    let file_name = name.file_name().ok_or(io::ErrorKind::InvalidFilename)?;
    let folder = folder_of(&name);
    if !folder.is_dir() {
        let text = format!("there is no folder '{}': make it first", folder.display());
        return Err(io::Error::new(io::ErrorKind::NotFound, text));
    }
    let mut prefix = std::ffi::OsString::from(".");
    prefix.push(file_name);
    let mut builder = Builder::new();
    builder.prefix(&prefix).suffix(".tmp");
    if let Some(permissions) = old.map(|old| old.permissions()).or_else(usual_permissions) {
        builder.permissions(permissions);
    }
    let (file, name) = TemporaryName::create(&builder, folder)?;
    Ok((file, Some(name)))
}

/// The folder that holds a file.
fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
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

/// The error with the file's name, and what can be done about it. What the error itself
/// says of a temporary name is left out.
pub(super) fn named(path: &Path, error: io::Error) -> io::Error {
    let path = path.display();
    let text = match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            format!("cannot write '{path}': the disk is full; free space, or write elsewhere")
        }
        io::ErrorKind::FileTooLarge => {
            format!("cannot write '{path}': it would be larger than files may be here (ulimit -f)")
        }
        io::ErrorKind::PermissionDenied => {
            format!("cannot write '{path}': permission denied; write to a folder of your own")
        }
        _ => format!("cannot write '{path}': {error}"),
    };
    io::Error::new(error.kind(), text)
}

#[cfg(test)]
mod tests {
    use super::super::unfinished::OutputFolder;
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
    fn several_files_appear_together_or_not_at_all() {
        let folder = tempfile::tempdir().unwrap();
        let write = || {
            let paths = ["a", "b"].map(|name| folder.path().join(name));
            paths.map(|path| AtomicFile::create(path).unwrap().close().unwrap())
        };
        drop(write());
        assert!(names(folder.path()).is_empty());
        let files = write();
        assert_eq!(names(folder.path()).iter().filter(|name| name.ends_with(".tmp")).count(), 2);
        files.into_iter().for_each(|file| file.commit().unwrap());
        let mut names = names(folder.path());
        names.sort();
        assert_eq!(names, ["a", "b"]);
    }

    #[test]
    fn folders_stay_only_if_something_is_in_them() {
        let parent = tempfile::tempdir().unwrap();
        let path = parent.path().join("out");
        let begin = || {
            let folder = OutputFolder::create(&path).unwrap();
            (AtomicFile::create(path.join("x")).unwrap().close().unwrap(), folder)
        };
        drop(begin());
        assert!(!path.exists());
        let (file, folder) = begin();
        file.commit().unwrap();
        drop(folder);
        assert_eq!(names(&path), ["x"]);
        drop(begin());
        assert_eq!(names(&path), ["x"]);
        assert!(OutputFolder::create(path.join("x")).is_err());
    }

    #[test]
    fn errors_name_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let missing = folder.path().join("no").join("x.vtp");
        let message = AtomicFile::create(&missing).unwrap_err().to_string();
        let no = folder.path().join("no");
        let expected = format!(
            "cannot write '{}': there is no folder '{}': make it first",
            missing.display(),
            no.display()
        );
        assert_eq!(message, expected);
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
