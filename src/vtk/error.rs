//! What can be wrong with a file, each in one line that says what to do.

use super::array_type::ArrayType;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a VTK file could not be read or written.
#[derive(Debug, Error)]
#[allow(missing_docs)] // the messages say what the fields are
pub enum VtkError {
    /// The file is missing or may not be read.
    #[error("cannot read '{}': {source}", file(path))]
    Read { path: PathBuf, source: io::Error },

    /// The output could not be created, written or renamed; the message names it.
    #[error("{0}")]
    Write(io::Error),

    /// The file is not XML at all, or not VTK's.
    #[error("'{}' is not a VTK XML file: {}", file(path), line(found))]
    NotVtk { path: PathBuf, found: String },

    /// The file is in VTK's older format.
    #[error("'{}' is a legacy VTK file, not XML: `read_grid` reads it", file(path))]
    NotXml { path: PathBuf },

    /// The file holds another kind of data.
    #[error("'{}' holds a VTK {}, but {expected} is expected", file(path), line(found))]
    OtherType { path: PathBuf, found: String, expected: &'static str },

    /// The file holds neither a grid nor a surface.
    #[error(
        "'{}' holds a VTK {}, neither a grid nor a surface: {}",
        file(path),
        line(found),
        cure(found)
    )]
    NoGrid { path: PathBuf, found: String },

    /// A file that another one lists cannot be read.
    #[error("'{}' lists a file that cannot be read: {problem}", file(path))]
    Piece { path: PathBuf, problem: Box<VtkError> },

    /// The file lists the files of a series.
    #[error(
        "'{}' is a series of files, each at its time, and no single grid: read its entries \
         one by one",
        file(path)
    )]
    Series { path: PathBuf },

    /// A legacy file contradicts itself, stops too early, or holds what cannot be read.
    #[error("'{}': {problem}, at byte {offset}", file(path))]
    Legacy { path: PathBuf, offset: usize, problem: LegacyProblem },

    /// The XML is not well formed.
    #[error("'{}': bad XML at byte {offset}: {}", file(path), line(problem))]
    Xml { path: PathBuf, offset: u64, problem: String },

    /// The file stops before its end.
    #[error("'{}' is cut short: {}; copy or write it again", file(path), line(missing))]
    Truncated { path: PathBuf, missing: String },

    /// An attribute of the file or of a piece has a value that means nothing.
    #[error(
        "'{}': <{element}> has {attribute}=\"{}\", expected {expected}",
        file(path),
        line(value)
    )]
    Attribute {
        path: PathBuf,
        element: String,
        attribute: &'static str,
        value: String,
        expected: &'static str,
    },

    /// An array cannot be decoded.
    #[error("'{}': array '{}' of {section}: {problem}", file(path), line(name))]
    Array { path: PathBuf, section: String, name: String, problem: ArrayError },

    /// An array that was asked for is not in the file.
    #[error(
        "'{}' has no array '{}' in {section}; it has {}",
        file(path),
        line(name),
        list(available)
    )]
    MissingArray { path: PathBuf, section: &'static str, name: String, available: Vec<String> },

    /// An array that was asked for is in the file, but cannot be used.
    #[error("'{}': array '{}' of {section} cannot be used: {reason}", file(path), line(name))]
    UnusableArray { path: PathBuf, section: &'static str, name: String, reason: String },

    /// The data given to a writer contradict themselves.
    #[error("cannot write array '{}' of {section}: {problem}", line(name))]
    Inconsistent { section: &'static str, name: String, problem: ArrayError },
}

/// What is wrong with one array. Offsets are bytes from the beginning of the file.
#[derive(Debug, Error, Clone, PartialEq)]
#[allow(missing_docs)] // the messages say what the fields are
pub enum ArrayError {
    #[error("it is missing")]
    Missing,

    #[error("unknown type '{}'", line(.0))]
    UnknownType(String),

    #[error("type {found} where {expected} is expected")]
    WrongType { found: ArrayType, expected: &'static str },

    #[error("{found} components where {expected} are expected")]
    Components { found: usize, expected: usize },

    #[error("unknown format '{}', expected ascii, binary or appended", line(.0))]
    UnknownFormat(String),

    #[error(
        "unknown compressor '{}', expected vtkZLib-, vtkLZ4- or vtkLZMADataCompressor",
        line(.0)
    )]
    UnknownCompressor(String),

    #[error("{attribute}=\"{}\" is not a count", line(value))]
    BadAttribute { attribute: &'static str, value: String },

    #[error("it is appended, but the file has no <AppendedData>")]
    NoAppendedData,

    #[error("its offset {offset} lies past the {available} bytes of <AppendedData>")]
    OffsetOutside { offset: u64, available: usize },

    #[error("its data at byte {offset} are cut short: {needed} bytes needed, {available} left")]
    CutShort { offset: usize, needed: u64, available: usize },

    #[error("bad base64 near byte {offset}")]
    BadBase64 { offset: usize },

    #[error("'{}' at byte {offset} is not a number of type {expected}", line(token))]
    BadNumber { token: String, offset: usize, expected: ArrayType },

    #[error("{found} values where {expected} are expected")]
    Count { found: usize, expected: usize },

    #[error("nothing says how many values it has, and its {bytes} bytes are too many")]
    NoCount { bytes: usize },

    #[error("{bytes} bytes are no whole number of values of {size} bytes")]
    PartOfValue { bytes: usize, size: usize },

    #[error("its header at byte {offset} promises {promised}, more than the file can hold")]
    TooLarge { offset: usize, promised: String },

    #[error("its block sizes at byte {offset} contradict each other")]
    BlockSizes { offset: usize },

    #[error("block {block} does not decompress: {}", line(problem))]
    Decompression { block: usize, problem: String },

    #[error("several arrays share the same data in <AppendedData>, more than the file can hold")]
    Overlap,

    #[error("the first offset is not 0")]
    FirstOffset,

    #[error("the offset of cell {cell} is smaller than the one before it")]
    FallingOffsets { cell: usize },

    #[error("cell {cell} has the index {index}, outside 0..{count}")]
    IndexOutOfRange { cell: usize, index: i64, count: usize },

    #[error("value {at} is the index {index}, outside 0..{count}")]
    OutOfRange { at: usize, index: i64, count: usize },

    #[error("{} is no index", line(value))]
    NoIndex { value: String },

    #[error("the faces of cell {cell} contradict its face offset")]
    BadFaces { cell: usize },
}

/// What is wrong with a legacy file.
#[derive(Debug, Error, Clone, PartialEq)]
#[allow(missing_docs)] // the messages say what the fields are
pub enum LegacyProblem {
    #[error("the file ends where {expected} should be; copy or write it again")]
    Ends { expected: &'static str },

    #[error("'{}' where {expected} should be", line(found))]
    Unexpected { found: String, expected: &'static str },

    #[error(
        "it holds a {}, not an unstructured grid or polygonal data: convert it, for example with \
         `python -c \"import pyvista; \
         pyvista.read('IN.vtk').cast_to_unstructured_grid().save('OUT.vtu')\"`",
        line(.0)
    )]
    OtherType(String),

    #[error("array '{}': {problem}", line(name))]
    Array { name: String, problem: ArrayError },

    #[error("data of {found} {what}, where the file has {expected}")]
    Tuples { what: &'static str, found: usize, expected: usize },
}

/// How to make a grid of other data.
fn cure(found: &str) -> &'static str {
    if found.contains("MultiBlock") || found.contains("Partitioned") || found.contains("Overlap") {
        "read the files that it lists one by one, or join them, for example with ParaView's \
         Merge Blocks"
    } else {
        "convert it, for example with `python -c \"import pyvista; \
         pyvista.read('IN').cast_to_unstructured_grid().save('OUT.vtu')\"`"
    }
}

/// How many characters of a text, and how many names, a message shows.
const SHOWN: usize = 100;
const NAMES_SHOWN: usize = 30;

/// A text from a file, such that a message stays one line of bearable length.
pub(super) fn line(text: &str) -> String {
    let mut line = String::new();
    for (index, character) in text.chars().enumerate() {
        match character {
            _ if index == SHOWN => {
                line.push('…');
                break;
            }
            control if control.is_control() => line.extend(control.escape_default()),
            other => line.push(other),
        }
    }
    line
}

/// The name of a file, such that a message stays one line: it may come from another file.
fn file(path: &Path) -> String {
    let name = path.display().to_string();
    let mut line = String::with_capacity(name.len());
    for character in name.chars() {
        match character.is_control() {
            true => line.extend(character.escape_default()),
            false => line.push(character),
        }
    }
    line
}

/// The names, for a message.
fn list(names: &[String]) -> String {
    if names.is_empty() {
        return String::from("none");
    }
    let shown = names.iter().take(NAMES_SHOWN);
    let mut quoted: Vec<_> = shown.map(|name| format!("'{}'", line(name))).collect();
    if names.len() > NAMES_SHOWN {
        quoted.push(format!("and {} more", names.len() - NAMES_SHOWN));
    }
    quoted.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_stay_one_line_of_bearable_length() {
        assert_eq!(line("a\nb é'\u{7f}"), "a\\nb é'\\u{7f}");
        assert_eq!(line(&"é".repeat(1000)).chars().count(), SHOWN + 1);
        let names: Vec<_> = (0..40).map(|n| n.to_string()).collect();
        assert!(list(&names).ends_with("'29', and 10 more"));
        assert_eq!(list(&[]), "none");
    }
}
