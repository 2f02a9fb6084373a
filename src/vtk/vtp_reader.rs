//! Reading polygonal data (`.vtp`).

use super::cell_array::CellArray;
use super::cell_reader::{CELLS, ListSource, read_lists};
use super::description::{Description, Sections};
use super::error::VtkError;
use super::file_bytes::FileBytes;
use super::piece::{Piece, PieceCounts};
use super::pieces::Pieces;
use super::poly_data::{PolyData, by_kind};
use super::reading::{Loaded, Reading};
use super::selection::Selection;
use super::xml_file::{Budget, XmlFile};
use std::path::Path;

/// An open `.vtp` file. Nothing is decoded before it is asked for.
///
/// The file is mapped into memory: it must not be changed or shortened by another program
/// while this value lives.
#[derive(Debug)]
pub struct VtpFile {
    file: XmlFile,
}

/// The type of data set, as VTK calls it.
const KIND: &str = "PolyData";

/// One of the four kinds of cells: its section, and how many a piece has.
type CellKind = (&'static str, fn(&PieceCounts) -> usize);

const VERTS: CellKind = ("Verts", |counts| counts.verts);
const LINES: CellKind = ("Lines", |counts| counts.lines);
const POLYS: CellKind = ("Polys", |counts| counts.polys);
const STRIPS: CellKind = ("Strips", |counts| counts.strips);

impl VtpFile {
    /// Maps the file and parses its head.
    ///
    /// # Errors
    /// The file cannot be read, is of another kind, or its XML is broken or cut.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, VtkError> {
        let file = XmlFile::open(path.as_ref(), KIND)?;
        Ok(Self { file })
    }

    /// Takes a file that is in memory. `name` stands for its path in messages.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn from_bytes(name: impl AsRef<Path>, bytes: Vec<u8>) -> Result<Self, VtkError> {
        let file = XmlFile::parse(name.as_ref(), FileBytes::Owned(bytes), KIND)?;
        Ok(Self { file })
    }

    /// What is in the file, from its head alone.
    ///
    /// # Errors
    /// A piece does not say how many points it has.
    pub fn description(&self) -> Result<Description, VtkError> {
        let pieces = poly_data_pieces(self.file.path(), &[&self.file])?;
        Ok(Sections::join(&pieces).describe(self.file.version(), &pieces))
    }

    /// Decodes points, cells, field data and the selected arrays, and joins all pieces.
    ///
    /// # Errors
    /// A selected array is missing, or differs between the pieces; or any of the data is
    /// cut, corrupt, or contradicts the rest.
    pub fn read(&self, selection: &Selection) -> Result<Loaded<PolyData>, VtkError> {
        read_surfaces(&poly_data_pieces(self.file.path(), &[&self.file])?, selection)
    }

    /// The parsed file.
    pub(super) fn xml(&self) -> &XmlFile {
        &self.file
    }
}

impl TryFrom<XmlFile> for VtpFile {
    type Error = VtkError;

    fn try_from(file: XmlFile) -> Result<Self, VtkError> {
        Ok(Self { file: file.expect(KIND)? })
    }
}

/// The pieces of one file or of several.
pub(super) fn poly_data_pieces<'a>(
    path: &'a Path,
    files: &[&'a XmlFile],
) -> Result<Pieces<'a>, VtkError> {
    Pieces::of(path, files, PieceCounts::of_poly_data)
}

/// Decodes and joins pieces.
pub(super) fn read_surfaces(
    pieces: &Pieces<'_>,
    selection: &Selection,
) -> Result<Loaded<PolyData>, VtkError> {
    let mut budget = pieces.budget();
    let reading = Reading::open(pieces, selection, &mut budget)?;
    let mut cells = |kind| read_cells(&pieces.list, kind, &mut budget);
    let [verts, lines, polys, strips] =
        [cells(VERTS)?, cells(LINES)?, cells(POLYS)?, cells(STRIPS)?];
    let warnings = reading.warnings.clone();
    let mut decoded = reading.decode()?;
    // from the order of the pieces to that of the joined data
    let counts = pieces.list.iter().map(|piece| piece.counts.kinds());
    decoded.cell_data.reorder(&by_kind(counts));
    Ok(Loaded {
        data: PolyData {
            points: decoded.points,
            verts,
            lines,
            polys,
            strips,
            point_data: decoded.point_data,
            cell_data: decoded.cell_data,
            field_data: decoded.field_data,
        },
        warnings,
    })
}

fn read_cells(
    pieces: &[Piece<'_>],
    (section, count): CellKind,
    budget: &mut Budget,
) -> Result<CellArray, VtkError> {
    let sources = pieces.iter().map(|piece| ListSource {
        file: piece.file,
        section: piece.node.child(section),
        label: piece.label(section),
        count: Some(count(&piece.counts)),
        bound: piece.counts.points,
    });
    read_lists(CELLS, &sources.collect::<Vec<_>>(), budget)
}
