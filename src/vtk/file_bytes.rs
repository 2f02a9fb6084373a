//! The bytes of a file: mapped from the disk, or given in memory.

use super::error::VtkError;
use memmap2::Mmap;
use std::fs::File;
use std::io;
use std::ops::Deref;
use std::path::Path;

/// The bytes of a file.
#[derive(Debug)]
pub(super) enum FileBytes {
    Mapped(Mmap),
    Owned(Vec<u8>),
}

impl FileBytes {
    /// Maps a file; devices and pipes, which cannot be mapped, are read.
    pub(super) fn open(path: &Path) -> Result<Self, VtkError> {
        let bytes = Self::open_any(path);
        bytes.map_err(|source| VtkError::Read { path: path.to_owned(), source })
    }

    /// Maps a file that another one names: a device or pipe would be read without end.
    pub(super) fn open_regular(path: &Path) -> Result<Self, VtkError> {
        let is_regular = std::fs::metadata(path).map(|metadata| metadata.is_file());
        let refused = match is_regular {
            Ok(true) => return Self::open(path),
            Ok(false) => io::Error::other("it is no regular file"),
            Err(error) => error,
        };
        Err(VtkError::Read { path: path.to_owned(), source: refused })
    }

    /// Lets go the memory that holds what was read of a mapped file; who reads on has it again.
    pub(super) fn release(&self) {
        #[cfg(unix)]
        if let Self::Mapped(map) = self {
            release(map);
        }
    }

    fn open_any(path: &Path) -> io::Result<Self> {
        let mut file = File::open(path)?;
        let metadata = file.metadata()?;
        if metadata.is_dir() {
            return Err(io::ErrorKind::IsADirectory.into());
        }
        if !metadata.is_file() {
            let mut bytes = Vec::new();
            io::Read::read_to_end(&mut file, &mut bytes)?;
            return Ok(Self::Owned(bytes));
        }
        map(&file).map(Self::Mapped)
    }
}

#[allow(
    unsafe_code,
    reason = "mapping reads a large file at the speed of memory and leaves out the arrays \
              nobody asks for; it is sound while no other program changes the file, which \
              every reader of files has to rely on"
)]
fn map(file: &File) -> io::Result<Mmap> {
    // SAFETY: the map is read only and private to this process; the bytes are checked as
    // any data from outside are, and never used as anything but bytes.
    unsafe { Mmap::map(file) }
}

#[cfg(unix)]
#[allow(
    unsafe_code,
    reason = "what was read stays in memory beside the arrays made of it: it was a third of all \
              that a contour of ten million tetrahedra needed"
)]
fn release(map: &Mmap) {
    // SAFETY: the pages of a map of a file that nobody wrote to come back from the file.
    let released = unsafe { map.unchecked_advise(memmap2::UncheckedAdvice::DontNeed) };
    // advice that is not taken costs memory, and nothing else
    drop(released);
}

impl Deref for FileBytes {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        match self {
            Self::Mapped(map) => map,
            Self::Owned(bytes) => bytes,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_folders_and_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x");
        assert!(FileBytes::open(&path).is_err());
        std::fs::write(&path, b"").unwrap();
        assert!(FileBytes::open(&path).unwrap().is_empty());
        std::fs::write(&path, b"abc").unwrap();
        assert_eq!(&*FileBytes::open(&path).unwrap(), b"abc");
        assert!(FileBytes::open(folder.path()).is_err());
    }
}
