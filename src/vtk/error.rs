//! What can be wrong with a file, each in one line that says what to do.

use super::array_type::ArrayType;
use std::io;
use std::path::PathBuf;
use thiserror::Error;

/// Why a VTK file could not be read or written.
#[derive(Debug, Error)]
#[allow(missing_docs)] // the messages say what the fields are
pub enum VtkError {
    /// The file is missing or may not be read.
    #[error("cannot read '{}': {source}", path.display())]
    Read { path: PathBuf, source: io::Error },

    /// The output could not be created, written or renamed; the message names it.
    #[error("{0}")]
    Write(io::Error),

    /// The file is not XML at all, or not VTK's.
    #[error("'{}' is not a VTK XML file: {found}", path.display())]
    NotVtk { path: PathBuf, found: String },

    /// The file is in VTK's older format.
    #[error(
        "'{}' is a legacy VTK file, not XML: convert it, for example with \
         `python -c \"import pyvista; pyvista.read('IN.vtk').save('OUT.vtu')\"`",
        path.display()
    )]
    Legacy { path: PathBuf },

    /// The file holds another kind of data.
    #[error("'{}' holds a VTK {found}, but a {expected} is expected", path.display())]
    OtherType { path: PathBuf, found: String, expected: &'static str },

    /// The XML is not well formed.
    #[error("'{}': bad XML at byte {offset}: {problem}", path.display())]
    Xml { path: PathBuf, offset: u64, problem: String },

    /// The file stops before its end.
    #[error("'{}' is cut short: {missing}; copy or write it again", path.display())]
    Truncated { path: PathBuf, missing: String },

    /// An attribute of the file or of a piece has a value that means nothing.
    #[error("'{}': <{element}> has {attribute}=\"{value}\", expected {expected}", path.display())]
    Attribute {
        path: PathBuf,
        element: String,
        attribute: &'static str,
        value: String,
        expected: &'static str,
    },

    /// An array cannot be decoded.
    #[error("'{}': array '{name}' of {section}: {problem}", path.display())]
    Array { path: PathBuf, section: String, name: String, problem: ArrayError },

    /// An array that was asked for is not in the file.
    #[error("'{}' has no array '{name}' in {section}; it has {}", path.display(), list(available))]
    MissingArray { path: PathBuf, section: &'static str, name: String, available: Vec<String> },

    /// An array that was asked for is in the file, but cannot be used.
    #[error("'{}': array '{name}' of {section} cannot be used: {reason}", path.display())]
    UnusableArray { path: PathBuf, section: &'static str, name: String, reason: String },

    /// The data given to a writer contradict themselves.
    #[error("cannot write array '{name}' of {section}: {problem}")]
    Inconsistent { section: &'static str, name: String, problem: ArrayError },
}

/// What is wrong with one array. Offsets are bytes from the beginning of the file.
#[derive(Debug, Error, Clone, PartialEq)]
#[allow(missing_docs)] // the messages say what the fields are
pub enum ArrayError {
    #[error("it is missing")]
    Missing,

    #[error("unknown type '{0}'")]
    UnknownType(String),

    #[error("type {found} where {expected} is expected")]
    WrongType { found: ArrayType, expected: &'static str },

    #[error("{found} components where {expected} are expected")]
    Components { found: usize, expected: usize },

    #[error("unknown format '{0}', expected ascii, binary or appended")]
    UnknownFormat(String),

    #[error("unknown compressor '{0}', expected vtkZLib-, vtkLZ4- or vtkLZMADataCompressor")]
    UnknownCompressor(String),

    #[error("{attribute}=\"{value}\" is not a count")]
    BadAttribute { attribute: &'static str, value: String },

    #[error("it is appended, but the file has no <AppendedData>")]
    NoAppendedData,

    #[error("its offset {offset} lies past the {available} bytes of <AppendedData>")]
    OffsetOutside { offset: u64, available: usize },

    #[error("its data at byte {offset} are cut short: {needed} bytes needed, {available} left")]
    CutShort { offset: usize, needed: u64, available: usize },

    #[error("bad base64 near byte {offset}")]
    BadBase64 { offset: usize },

    #[error("'{token}' at byte {offset} is not a number of type {expected}")]
    BadNumber { token: String, offset: usize, expected: ArrayType },

    #[error("{found} values where {expected} are expected")]
    Count { found: usize, expected: usize },

    #[error("{bytes} bytes are no whole number of values of {size} bytes")]
    PartOfValue { bytes: usize, size: usize },

    #[error("its header at byte {offset} promises {promised}, more than the file can hold")]
    TooLarge { offset: usize, promised: String },

    #[error("its block sizes at byte {offset} contradict each other")]
    BlockSizes { offset: usize },

    #[error("block {block} does not decompress: {problem}")]
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

    #[error("{value} is no index")]
    NoIndex { value: String },

    #[error("the faces of cell {cell} contradict its face offset")]
    BadFaces { cell: usize },
}

/// The names, for a message.
fn list(names: &[String]) -> String {
    if names.is_empty() {
        return String::from("none");
    }
    let quoted: Vec<_> = names.iter().map(|name| format!("'{name}'")).collect();
    quoted.join(", ")
}
