//! A VTK XML file whose head has been parsed.

use super::encoding::{ByteOrder, Coded, Coding, HeaderWord};
use super::error::{ArrayError, VtkError};
use super::file_bytes::FileBytes;
use super::payload::{Layout, Payload};
use super::xml::{Document, Node, XmlProblem};
use std::borrow::Cow;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// How far from its end a file must close its root element.
const TAIL: usize = 1 << 10;

/// A VTK XML file whose head has been parsed.
#[derive(Debug)]
pub(super) struct XmlFile {
    path: PathBuf,
    bytes: FileBytes,
    document: Document,
    layout: Layout,
    version: String,
    appended: Option<(Coding, Range<usize>)>,
}

/// The encoded bytes that the arrays of one reading may still take.
///
/// All together take no more bytes than the file has: else ten thousand arrays at one
/// offset would fill any memory from a small file.
#[derive(Debug)]
pub(super) struct Budget {
    left: usize,
}

impl Budget {
    /// What reading these files may take.
    pub(super) fn of(files: &[&XmlFile]) -> Self {
        // Files in memory or mapped do not add up to more than an address holds, but for
        // the same one several times.
        let left = files.iter().fold(0usize, |sum, file| sum.saturating_add(file.bytes.len()));
        Self { left }
    }

    fn charge(&mut self, payload: &Payload<'_>) -> Result<(), ArrayError> {
        let left = self.left.checked_sub(payload.encoded_len());
        self.left = left.ok_or(ArrayError::Overlap)?;
        Ok(())
    }
}

impl XmlFile {
    /// Maps the file and parses its head.
    pub(super) fn open(path: &Path, expected: &'static str) -> Result<Self, VtkError> {
        Self::parse(path, FileBytes::open(path)?, expected)
    }

    /// Parses the head of a file in memory.
    pub(super) fn parse(
        path: &Path,
        bytes: FileBytes,
        expected: &'static str,
    ) -> Result<Self, VtkError> {
        Self::parse_any(path, bytes)?.expect(expected)
    }

    /// Parses the head of a file in memory, whatever it holds.
    pub(super) fn parse_any(path: &Path, bytes: FileBytes) -> Result<Self, VtkError> {
        check_signature(path, &bytes)?;
        let document = Document::parse(&bytes).map_err(|problem| xml_error(path, problem))?;
        let root = document.root(&bytes);
        check_root(path, root)?;
        let layout = read_layout(path, root)?;
        let version = root.attribute("version").unwrap_or_default().into_owned();
        let appended = read_appended(path, &document, &bytes)?;
        Ok(Self { path: path.to_owned(), bytes, document, layout, version, appended })
    }

    /// Refuses another type of data.
    pub(super) fn expect(self, expected: &'static str) -> Result<Self, VtkError> {
        match self.kind() {
            found if found == expected => Ok(self),
            found => Err(VtkError::OtherType {
                path: self.path.clone(),
                found: found.into_owned(),
                expected,
            }),
        }
    }

    /// The type of data, as VTK calls it.
    pub(super) fn kind(&self) -> Cow<'_, str> {
        self.document.root(&self.bytes).attribute("type").unwrap_or_default()
    }

    /// The file's name, for messages.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Lets go the memory that holds what was read.
    pub(super) fn release(&self) {
        self.bytes.release();
    }

    /// Bytes of the file.
    pub(super) fn len(&self) -> usize {
        self.bytes.len()
    }

    /// The version of the format, such as `1.0`; empty where it is not given.
    pub(super) fn version(&self) -> &str {
        &self.version
    }

    /// The element that holds the data, named as the file's type.
    pub(super) fn data_set(&self) -> Result<Node<'_>, VtkError> {
        let kind = self.kind();
        let root = self.document.root(&self.bytes);
        root.child(&kind).ok_or_else(|| VtkError::NotVtk {
            path: self.path.clone(),
            found: format!("there is no element <{kind}>"),
        })
    }

    /// Adds the place to what is wrong with an array.
    pub(super) fn array_error(&self, section: &str, name: &str, problem: ArrayError) -> VtkError {
        VtkError::Array {
            path: self.path.clone(),
            section: section.to_owned(),
            name: name.to_owned(),
            problem,
        }
    }

    /// Finds the encoded values of a `<DataArray>` and checks their header.
    pub(super) fn payload<'a>(
        &'a self,
        array: Node<'a>,
        budget: &mut Budget,
    ) -> Result<Payload<'a>, ArrayError> {
        let format = array.attribute("format");
        let offset = array.attribute("offset");
        let payload = match (format.as_deref(), offset) {
            (Some("appended"), Some(offset)) | (None, Some(offset)) => self.appended(&offset)?,
            (Some("appended"), None) => return Err(bad_offset("")),
            (Some("ascii") | None, _) => {
                let (text, place) = self.text(array);
                Payload::ascii(text, place)
            }
            (Some("binary"), _) => self.inline(array)?,
            (Some(other), _) => return Err(ArrayError::UnknownFormat(other.to_owned())),
        };
        budget.charge(&payload)?;
        Ok(payload)
    }

    fn appended(&self, offset: &str) -> Result<Payload<'_>, ArrayError> {
        let (coding, range) = self.appended.as_ref().ok_or(ArrayError::NoAppendedData)?;
        let offset: u64 = offset.trim().parse().map_err(|_| bad_offset(offset))?;
        let data = self.bytes.get(range.clone()).unwrap_or_default();
        let start = usize::try_from(offset).ok().filter(|at| *at <= data.len());
        let start = start.ok_or(ArrayError::OffsetOutside { offset, available: data.len() })?;
        let coded = Coded {
            bytes: data.get(start..).unwrap_or_default(),
            offset: range.start + start,
            coding: *coding,
        };
        Payload::binary(coded, &self.layout)
    }

    fn inline<'a>(&'a self, array: Node<'a>) -> Result<Payload<'a>, ArrayError> {
        let (text, offset) = self.text(array);
        let coded = Coded { bytes: text, offset, coding: Coding::Base64 };
        Payload::binary(coded, &self.layout)
    }

    /// An element's text and its place in the file.
    fn text<'a>(&'a self, array: Node<'a>) -> (&'a [u8], usize) {
        let range = array.text();
        let start = range.start;
        (self.bytes.get(range).unwrap_or_default(), start)
    }
}

fn bad_offset(value: &str) -> ArrayError {
    ArrayError::BadAttribute { attribute: "offset", value: value.to_owned() }
}

/// Recognises files of other kinds by their first bytes.
fn check_signature(path: &Path, bytes: &[u8]) -> Result<(), VtkError> {
    let path = path.to_owned();
    let found = match bytes {
        [] => "it is empty",
        [0x1F, 0x8B, ..] => "it is compressed with gzip; unpack it with gunzip",
        [0x89, b'H', b'D', b'F', ..] => "it is HDF5 (.vtkhdf); save it as .vtu in ParaView",
        _ if bytes.starts_with(b"# vtk DataFile") => return Err(VtkError::NotXml { path }),
        _ if is_xml(bytes) => return Ok(()),
        _ => "it does not begin with an XML element",
    };
    Err(VtkError::NotVtk { path, found: found.to_owned() })
}

/// Whether the first of the bytes, after a mark of their order, is that of an element.
fn is_xml(bytes: &[u8]) -> bool {
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    text.trim_ascii_start().starts_with(b"<")
}

fn xml_error(path: &Path, problem: XmlProblem) -> VtkError {
    let path = path.to_owned();
    match problem {
        XmlProblem::Malformed { offset, problem } => VtkError::Xml { path, offset, problem },
        XmlProblem::Unclosed { element } => {
            VtkError::Truncated { path, missing: format!("it ends inside <{element}>") }
        }
        XmlProblem::Empty => {
            VtkError::NotVtk { path, found: String::from("it has no XML element") }
        }
    }
}

fn check_root(path: &Path, root: Node<'_>) -> Result<(), VtkError> {
    if root.name() != "VTKFile" {
        return Err(VtkError::NotVtk {
            path: path.to_owned(),
            found: format!("its root element is <{}>", root.name()),
        });
    }
    Ok(())
}

fn read_layout(path: &Path, root: Node<'_>) -> Result<Layout, VtkError> {
    let bad = |attribute, value: &str, expected| VtkError::Attribute {
        path: path.to_owned(),
        element: root.name().to_owned(),
        attribute,
        value: value.to_owned(),
        expected,
    };
    let order = match root.attribute("byte_order").as_deref() {
        None | Some("LittleEndian") => ByteOrder::Little,
        Some("BigEndian") => ByteOrder::Big,
        Some(other) => return Err(bad("byte_order", other, "LittleEndian or BigEndian")),
    };
    let word = match root.attribute("header_type").as_deref() {
        None | Some("UInt32") => HeaderWord::U32,
        Some("UInt64") => HeaderWord::U64,
        Some(other) => return Err(bad("header_type", other, "UInt32 or UInt64")),
    };
    let compressor = root.attribute("compressor").map(|name| name.into_owned());
    Ok(Layout { order, word, compressor: compressor.filter(|name| !name.is_empty()) })
}

/// Finds the appended data: they begin after an underscore and end before the end tag.
fn read_appended(
    path: &Path,
    document: &Document,
    bytes: &[u8],
) -> Result<Option<(Coding, Range<usize>)>, VtkError> {
    let Some((node, after_tag)) = document.appended(bytes) else {
        return Ok(None);
    };
    let coding = match node.attribute("encoding").as_deref() {
        Some("raw") => Coding::Raw,
        // VTK writes "base64", and takes a missing encoding for it.
        _ => Coding::Base64,
    };
    let cut =
        |missing: &str| VtkError::Truncated { path: path.to_owned(), missing: missing.to_owned() };
    let data = bytes.get(after_tag..).unwrap_or_default();
    let mark = data.iter().position(|byte| !byte.is_ascii_whitespace());
    let mark = mark.filter(|at| data.get(*at) == Some(&b'_'));
    let start = mark.ok_or_else(|| cut("<AppendedData> does not begin with '_'"))? + after_tag + 1;
    let end = find_end(bytes, start).ok_or_else(|| cut("it does not end with </VTKFile>"))?;
    Ok(Some((coding, start..end)))
}

/// Where the appended data end: before the last end tags, near the end of the file.
fn find_end(bytes: &[u8], start: usize) -> Option<usize> {
    let tail_start = bytes.len().saturating_sub(TAIL).max(start);
    let tail = bytes.get(tail_start..)?;
    let rfind = |text: &[u8], tag: &[u8]| text.windows(tag.len()).rposition(|part| part == tag);
    let root = rfind(tail, b"</VTKFile>")?;
    let end = rfind(&tail[..root], b"</AppendedData>")?;
    Some(tail_start + end)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<XmlFile, VtkError> {
        let bytes = FileBytes::Owned(text.as_bytes().to_vec());
        XmlFile::parse(Path::new("x.vtu"), bytes, "UnstructuredGrid")
    }

    fn message(text: &str) -> String {
        parse(text).unwrap_err().to_string()
    }

    const GRID: &str = "<VTKFile type='UnstructuredGrid'";

    #[test]
    fn other_files_are_named() {
        assert!(message("").contains("empty"));
        assert!(message("# vtk DataFile Version 3.0\n").contains("legacy"));
        assert!(message("<html></html>").contains("<html>"));
        for text in ["hello", "# <VTKFile>", " ", "\u{feff}x"] {
            assert!(message(text).contains("not a VTK XML file"), "{text}");
        }
        let grid = format!("\u{feff}\n{GRID}/>");
        assert!(
            XmlFile::parse_any(Path::new("x.vtu"), FileBytes::Owned(grid.into_bytes())).is_ok()
        );
        let other = message("<VTKFile type='ImageData'></VTKFile>");
        assert_eq!(other, "'x.vtu' holds a VTK ImageData, but UnstructuredGrid is expected");
    }

    #[test]
    fn layout_and_its_defaults() {
        let file = parse(&format!("{GRID}/>")).unwrap();
        assert_eq!(file.layout.order, ByteOrder::Little);
        assert_eq!(file.layout.word, HeaderWord::U32);
        let text = format!("{GRID} byte_order='BigEndian' header_type='UInt64' compressor='c'/>");
        let file = parse(&text).unwrap();
        assert_eq!(file.layout.order, ByteOrder::Big);
        assert_eq!(file.layout.word, HeaderWord::U64);
        assert_eq!(file.layout.compressor.as_deref(), Some("c"));
        assert!(message(&format!("{GRID} header_type='UInt16'/>")).contains("UInt16"));
    }

    #[test]
    fn appended_data_need_their_mark_and_their_end() {
        let head = format!("{GRID}><UnstructuredGrid/><AppendedData encoding='raw'>");
        let file = parse(&format!("{head}\n _abc</AppendedData></VTKFile>\n")).unwrap();
        let (coding, range) = file.appended.clone().unwrap();
        assert_eq!((coding, &file.bytes[range]), (Coding::Raw, &b"abc"[..]));
        assert!(message(&format!("{head} abc</AppendedData></VTKFile>")).contains("'_'"));
        assert!(message(&format!("{head} _abc</AppendedData></VTKFil")).contains("cut short"));
        assert!(message(&head).contains("cut short"));
    }

    #[test]
    fn arrays_cannot_share_data_without_end() {
        let array = "<DataArray format='appended' offset='0'/>";
        let text = format!(
            "{GRID} header_type='UInt64'><UnstructuredGrid>{array}</UnstructuredGrid>\
             <AppendedData encoding='raw'>_\u{64}{}</AppendedData></VTKFile>",
            "\0".repeat(107)
        );
        let file = parse(&text).unwrap();
        let node = file.data_set().unwrap().child("DataArray").unwrap();
        let mut budget = Budget::of(&[&file]);
        let mut open = || file.payload(node, &mut budget).map(|_| ());
        let results: Vec<_> = (0..9).map(|_| open()).collect();
        assert_eq!(results[0], Ok(()));
        assert_eq!(results[8], Err(ArrayError::Overlap));
    }
}
