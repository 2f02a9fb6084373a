//! Series of files, each at its time (`.pvd`).

use super::any_file::AnyFile;
use super::error::VtkError;
use super::file_bytes::FileBytes;
use super::file_names::beside;
use super::xml::Node;
use super::xml_file::XmlFile;
use std::path::{Path, PathBuf};

/// A `.pvd` file: which file holds the data of which time. None of them is opened.
#[derive(Clone, Debug, PartialEq)]
pub struct PvdFile {
    path: PathBuf,
    entries: Vec<PvdEntry>,
}

/// One file of a series.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PvdEntry {
    /// The time, in the unit of whoever wrote it; `None` where the file does not say.
    pub time: Option<f64>,
    /// Which part of the data at that time; 0 where the file does not say.
    pub part: u64,
    /// The group of the part; empty where the file does not say.
    pub group: String,
    /// The path of the file, which may be of any of VTK's types.
    pub file: PathBuf,
}

impl PvdEntry {
    /// The only file of a time.
    pub fn new(time: f64, file: impl Into<PathBuf>) -> Self {
        Self { time: Some(time), file: file.into(), ..Self::default() }
    }
}

/// The type of data set, as VTK calls it.
pub(super) const KIND: &str = "Collection";

impl PvdFile {
    /// Reads the list.
    ///
    /// # Errors
    /// The file cannot be read, is of another kind, its XML is broken or cut, or an entry
    /// has no file, or a time or part that is no number.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, VtkError> {
        XmlFile::open(path.as_ref(), KIND)?.try_into()
    }

    /// Takes a file that is in memory. `name` stands for its path; the entries' names are
    /// relative to its folder.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn from_bytes(name: impl AsRef<Path>, bytes: Vec<u8>) -> Result<Self, VtkError> {
        XmlFile::parse(name.as_ref(), FileBytes::Owned(bytes), KIND)?.try_into()
    }

    /// The entries, in the order of the file.
    pub fn entries(&self) -> &[PvdEntry] {
        &self.entries
    }

    /// Opens the file of an entry.
    ///
    /// # Errors
    /// [`VtkError::Piece`]: it cannot be read, or is a series itself.
    pub fn open_entry(&self, entry: &PvdEntry) -> Result<AnyFile, VtkError> {
        let opened = FileBytes::open_regular(&entry.file)
            .and_then(|bytes| AnyFile::parse(&entry.file, bytes))
            .and_then(|file| match file {
                AnyFile::Pvd(series) => Err(series.no_grid()),
                other => Ok(other),
            });
        opened.map_err(|problem| VtkError::Piece {
            path: self.path.clone(),
            problem: Box::new(problem),
        })
    }

    /// Why a series is not read as one grid.
    pub(super) fn no_grid(&self) -> VtkError {
        VtkError::Series { path: self.path.clone() }
    }
}

impl TryFrom<XmlFile> for PvdFile {
    type Error = VtkError;

    fn try_from(file: XmlFile) -> Result<Self, VtkError> {
        let file = file.expect(KIND)?;
        let nodes = file.data_set()?.children().filter(|node| node.name() == "DataSet");
        let entries = nodes.map(|node| entry(&file, node)).collect::<Result<_, _>>()?;
        Ok(Self { path: file.path().to_owned(), entries })
    }
}

fn entry(file: &XmlFile, node: Node<'_>) -> Result<PvdEntry, VtkError> {
    let text = |name| node.attribute(name).unwrap_or_default();
    let bad = |attribute, expected| VtkError::Attribute {
        path: file.path().to_owned(),
        element: String::from("DataSet"),
        attribute,
        value: text(attribute).into_owned(),
        expected,
    };
    if text("file").is_empty() {
        return Err(bad("file", "the name of a file"));
    }
    let time = match text("timestep").trim() {
        "" => None,
        number => Some(number.parse().map_err(|_| bad("timestep", "a number"))?),
    };
    let part = match text("part").trim() {
        "" => 0,
        number => number.parse().map_err(|_| bad("part", "a count"))?,
    };
    let group = text("group").into_owned();
    Ok(PvdEntry { time, part, group, file: beside(file.path(), &text("file")) })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(entries: &str) -> Result<PvdFile, VtkError> {
        let text =
            format!("<VTKFile type='Collection'><Collection>{entries}</Collection></VTKFile>");
        PvdFile::from_bytes("runs/x.pvd", text.into_bytes())
    }

    #[test]
    fn entries_in_order() {
        let entries = "<DataSet timestep='2.5e-1' group='g' part='3' file='a b.vtu'/>\
                       <DataSet file='/elsewhere/c.vtp' timestep=' -1 '/><DataSet file='../d.vtk'/>";
        let file = read(entries).unwrap();
        let [first, second, third] = file.entries() else { panic!("{file:?}") };
        assert_eq!((first.time, first.part, &first.group[..]), (Some(0.25), 3, "g"));
        assert_eq!(first.file, Path::new("runs/a b.vtu"));
        assert_eq!(*second, PvdEntry::new(-1.0, "/elsewhere/c.vtp"));
        assert_eq!((third.time, &third.file), (None, &PathBuf::from("runs/../d.vtk")));
        assert!(read("").unwrap().entries().is_empty());
    }

    #[test]
    fn nonsense_is_named() {
        let message = |entry| read(entry).unwrap_err().to_string();
        assert!(message("<DataSet timestep='1'/>").contains("file=\"\""));
        assert!(message("<DataSet file='a' timestep='now'/>").contains("timestep=\"now\""));
        assert!(message("<DataSet file='a' part='-1'/>").contains("part=\"-1\""));
    }
}
