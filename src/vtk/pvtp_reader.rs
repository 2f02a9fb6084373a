//! Reading polygonal data in several files (`.pvtp`).

use super::description::{Description, Sections};
use super::error::VtkError;
use super::file_bytes::FileBytes;
use super::parallel_file::ParallelFile;
use super::pieces::Pieces;
use super::poly_data::PolyData;
use super::reading::Loaded;
use super::selection::Selection;
use super::vtp_reader::{VtpFile, poly_data_pieces, read_surfaces};
use super::xml_file::XmlFile;
use std::path::{Path, PathBuf};

/// An open `.pvtp` file, which lists the `.vtp` files of a surface's pieces. No piece is
/// opened before it is asked for.
#[derive(Debug)]
pub struct PvtpFile {
    list: ParallelFile,
}

/// The type of data set, as VTK calls it.
const KIND: &str = "PPolyData";

impl PvtpFile {
    /// Reads the list of pieces.
    ///
    /// # Errors
    /// The file cannot be read, is of another kind, its XML is broken or cut, or a piece
    /// has no name or that of one before it.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, VtkError> {
        XmlFile::open(path.as_ref(), KIND)?.try_into()
    }

    /// Takes a file that is in memory. `name` stands for its path in messages; the pieces
    /// are looked for in its folder.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn from_bytes(name: impl AsRef<Path>, bytes: Vec<u8>) -> Result<Self, VtkError> {
        XmlFile::parse(name.as_ref(), FileBytes::Owned(bytes), KIND)?.try_into()
    }

    /// The files of the pieces, in order. Names in the file are relative to its folder, or
    /// absolute; they may lead out of the folder.
    pub fn piece_paths(&self) -> &[PathBuf] {
        &self.list.pieces
    }

    /// The pieces in order, each opened when it is taken: for those who need but one at a
    /// time. Points on the border of two pieces are in both.
    pub fn pieces(&self) -> impl ExactSizeIterator<Item = Result<VtpFile, VtkError>> + '_ {
        (0..self.list.pieces.len()).map(|index| self.list.open_piece(index, VtpFile::try_from))
    }

    /// What is in all pieces together, from their heads alone.
    ///
    /// # Errors
    /// A piece cannot be opened, or does not say how many points and cells it has.
    pub fn description(&self) -> Result<Description, VtkError> {
        let files = self.list.open_all(VtpFile::try_from)?;
        let pieces = self.join(&files)?;
        let sections = Sections::join(&pieces);
        let mut description = sections.describe(self.list.file.version(), &pieces);
        description.warnings.extend(self.list.compare(&sections));
        Ok(description)
    }

    /// Decodes all pieces and joins them, one after the other: points are not merged, and
    /// ghost cells (`vtkGhostType`) are kept. Arrays that a piece lacks are left out, with
    /// a warning; empty pieces have no say. Field data are those of the `.pvtp`, else of
    /// the first piece that has any.
    ///
    /// # Errors
    /// A piece cannot be opened; or as [`VtpFile::read`].
    pub fn read(&self, selection: &Selection) -> Result<Loaded<PolyData>, VtkError> {
        let files = self.list.open_all(VtpFile::try_from)?;
        let pieces = self.join(&files)?;
        let mut loaded = read_surfaces(&pieces, selection)?;
        if *selection == Selection::All {
            loaded.warnings.extend(self.list.compare(&Sections::join(&pieces)));
        }
        Ok(loaded)
    }

    /// Decodes one piece, with the field data of the list where it has any.
    ///
    /// # Errors
    /// The piece cannot be opened; or as [`VtpFile::read`].
    pub fn read_piece(
        &self,
        index: usize,
        selection: &Selection,
    ) -> Result<Loaded<PolyData>, VtkError> {
        let file = self.list.open_piece(index, VtpFile::try_from)?;
        read_surfaces(&self.join(&[file])?, selection)
    }

    fn join<'a>(&'a self, files: &'a [VtpFile]) -> Result<Pieces<'a>, VtkError> {
        let files: Vec<_> = files.iter().map(VtpFile::xml).collect();
        poly_data_pieces(self.list.file.path(), &files)?.with_field_of(&self.list.file)
    }
}

impl TryFrom<XmlFile> for PvtpFile {
    type Error = VtkError;

    fn try_from(file: XmlFile) -> Result<Self, VtkError> {
        Ok(Self { list: ParallelFile::new(file.expect(KIND)?)? })
    }
}
