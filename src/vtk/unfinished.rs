//! Files and folders that are being written, under names that must not stay.

use super::atomic_file::named;
use super::error::VtkError;
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::Builder;

/// The names of all files that are being written by this process, and of the folders made
/// for them.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn unfinished() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes every file that is being written, and lets no thread begin or name another: for
/// a program that is about to end, because it was interrupted.
pub fn abandon_unfinished_files() {
    let names = unfinished();
    // a folder can be removed when its files are
    let folders = names.iter().filter(|name| fs::remove_file(name).is_err());
    for folder in folders.collect::<Vec<_>>() {
        let _ = fs::remove_dir(folder);
    }
    std::mem::forget(names);
}

/// The temporary name of a file, which is removed unless it gets another name.
#[derive(Debug)]
pub(super) struct TemporaryName(PathBuf);

impl TemporaryName {
    /// Makes a file under a name that no other file has.
    pub(super) fn create(
        builder: &Builder<'_, '_>,
        folder: &Path,
    ) -> io::Result<(File, TemporaryName)> {
        let mut names = unfinished();
        let (file, path) = builder.tempfile_in(folder)?.keep().map_err(|error| error.error)?;
        names.insert(path.clone());
        Ok((file, TemporaryName(path)))
    }

    /// Gives the file its name, replacing an old one.
    pub(super) fn become_file(self, path: &Path) -> io::Result<()> {
        let mut names = unfinished();
        fs::rename(&self.0, path)?;
        names.remove(&self.0);
        Ok(())
    }
}

impl Drop for TemporaryName {
    fn drop(&mut self) {
        if unfinished().remove(&self.0) {
            let _ = fs::remove_file(&self.0);
        }
    }
}

/// A folder for output: one that is made for it is removed again if nothing comes into it.
#[derive(Debug)]
pub struct OutputFolder {
    /// None if the folder was there before.
    made: Option<PathBuf>,
}

impl OutputFolder {
    /// Makes a folder, unless it is there.
    ///
    /// # Errors
    /// [`VtkError::Write`]: it cannot be made, or there is a file of its name.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, VtkError> {
        let path = path.as_ref();
        if path.is_dir() {
            return Ok(Self { made: None });
        }
        let mut names = unfinished();
        fs::create_dir(path).map_err(|error| VtkError::Write(named(path, error)))?;
        names.insert(path.to_owned());
        Ok(Self { made: Some(path.to_owned()) })
    }
}

impl Drop for OutputFolder {
    fn drop(&mut self) {
        let Some(path) = &self.made else { return };
        if unfinished().remove(path) {
            // it stays if something is in it
            let _ = fs::remove_dir(path);
        }
    }
}
