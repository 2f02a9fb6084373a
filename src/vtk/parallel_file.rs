//! A file that lists the files of its pieces (`.pvtu`, `.pvtp`).

use super::array_head::ArrayHead;
use super::description::Sections;
use super::error::{VtkError, line};
use super::file_bytes::FileBytes;
use super::file_names::beside;
use super::xml::Node;
use super::xml_file::XmlFile;
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// A file that lists the files of its pieces, of which none has been opened.
#[derive(Debug)]
pub(super) struct ParallelFile {
    pub(super) file: XmlFile,
    /// The pieces' files, in order.
    pub(super) pieces: Vec<PathBuf>,
}

impl ParallelFile {
    /// Reads the list. Names are relative to the folder of the list, or absolute.
    pub(super) fn new(file: XmlFile) -> Result<Self, VtkError> {
        let nodes = file.data_set()?.children().filter(|node| node.name() == "Piece");
        let mut seen = HashSet::new();
        let mut pieces = Vec::new();
        for node in nodes {
            let source = node.attribute("Source").unwrap_or_default();
            // A list may not make a little file into much data.
            if source.is_empty() || !seen.insert(source.clone()) {
                return Err(bad_source(&file, source.into_owned()));
            }
            pieces.push(beside(file.path(), &source));
        }
        Ok(Self { file, pieces })
    }

    /// Maps the file of piece `index`, parses its head, and makes of it what it should be.
    pub(super) fn open_piece<T>(
        &self,
        index: usize,
        kind: impl Fn(XmlFile) -> Result<T, VtkError>,
    ) -> Result<T, VtkError> {
        let path = self.pieces.get(index).map_or(Path::new(""), PathBuf::as_path);
        FileBytes::open_regular(path)
            .and_then(|bytes| XmlFile::parse_any(path, bytes))
            .and_then(kind)
            .map_err(|problem| VtkError::Piece {
                path: self.file.path().to_owned(),
                problem: Box::new(problem),
            })
    }

    /// The pieces' files, all open.
    pub(super) fn open_all<T>(
        &self,
        kind: impl Fn(XmlFile) -> Result<T, VtkError>,
    ) -> Result<Vec<T>, VtkError> {
        (0..self.pieces.len()).map(|index| self.open_piece(index, &kind)).collect()
    }

    /// One line for each array that is declared but not in the pieces, or the reverse.
    pub(super) fn compare(&self, sections: &Sections<'_>) -> Vec<String> {
        let mut warnings = Vec::new();
        let all = [&sections.points, &sections.cells].into_iter();
        for section in all.filter(|section| !section.is_empty) {
            let declared = self.declared(section.label);
            let is_known = |name: &String| {
                let read = section.arrays.iter().any(|array| array.name == *name);
                read || section.unusable.iter().any(|(known, _)| known == name)
            };
            let missing = declared.iter().filter(|name| !is_known(name));
            warnings.extend(missing.map(|name| missing_warning(section.label, name)));
            let extra = section.arrays.iter().filter(|array| !declared.contains(&array.name));
            warnings.extend(extra.map(|array| extra_warning(section.label, &array.name)));
        }
        warnings
    }

    /// The names of the arrays that the file says its pieces have.
    fn declared(&self, section: &str) -> HashSet<String> {
        let data_set = self.file.data_set().ok();
        let declaration = data_set.and_then(|node| node.child(&format!("P{section}")));
        let arrays = declaration.into_iter().flat_map(Node::into_children);
        arrays.map(|node| ArrayHead::read(node).name).collect()
    }
}

fn missing_warning(section: &str, name: &str) -> String {
    format!("{section} array '{}' left out: it is declared, but no piece has it", line(name))
}

fn extra_warning(section: &str, name: &str) -> String {
    format!("{section} array '{}' is in every piece, but not declared: it is read", line(name))
}

fn bad_source(file: &XmlFile, value: String) -> VtkError {
    VtkError::Attribute {
        path: file.path().to_owned(),
        element: String::from("Piece"),
        attribute: "Source",
        value,
        expected: "the name of a file not named before",
    }
}
