//! The pieces that are joined into one data set: of one file or of several.

use super::error::VtkError;
use super::piece::{Piece, ReadCounts};
use super::xml::Node;
use super::xml_file::{Budget, XmlFile};
use std::path::Path;

/// The pieces that are joined into one data set, and what they share.
pub(super) struct Pieces<'a> {
    /// The file that was asked for, for messages about all pieces.
    pub(super) path: &'a Path,
    pub(super) list: Vec<Piece<'a>>,
    /// The first `<FieldData>` of the files.
    pub(super) field: Option<(&'a XmlFile, Node<'a>)>,
    files: Vec<&'a XmlFile>,
}

impl<'a> Pieces<'a> {
    /// All pieces of the files, in order.
    pub(super) fn of(
        path: &'a Path,
        files: &[&'a XmlFile],
        read: ReadCounts,
    ) -> Result<Self, VtkError> {
        let list = Piece::all(files, read)?;
        let mut field = None;
        for file in files {
            let found = file.data_set()?.child("FieldData").map(|node| (*file, node));
            field = field.or(found);
        }
        Ok(Self { path, list, field, files: files.to_vec() })
    }

    /// Takes the field data of another file, where it has any, in place of the pieces'.
    pub(super) fn with_field_of(mut self, file: &'a XmlFile) -> Result<Self, VtkError> {
        if let Some(node) = file.data_set()?.child("FieldData") {
            self.field = Some((file, node));
            self.files.push(file);
        }
        Ok(self)
    }

    /// What one reading of the pieces may take.
    pub(super) fn budget(&self) -> Budget {
        Budget::of(&self.files)
    }
}
