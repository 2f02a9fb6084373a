//! Reading unstructured grids (`.vtu`).

use super::attributes::Attributes;
use super::cell_array::CellArray;
use super::cell_reader::{CELLS, Integers, ListSource, read_lists};
use super::description::{Description, Sections};
use super::error::VtkError;
use super::file_bytes::FileBytes;
use super::old_hexahedra;
use super::piece::{Piece, PieceCounts};
use super::pieces::Pieces;
use super::polyhedra_reader::read_polyhedra;
use super::reading::{Loaded, Reading};
use super::selection::Selection;
use super::unstructured_grid::UnstructuredGrid;
use super::xml_file::{Budget, XmlFile};
use std::path::Path;

/// An open `.vtu` file. Nothing is decoded before it is asked for.
///
/// The file is mapped into memory: it must not be changed or shortened by another program
/// while this value lives.
#[derive(Debug)]
pub struct VtuFile {
    file: XmlFile,
}

/// The type of data set, as VTK calls it.
const KIND: &str = "UnstructuredGrid";

impl VtuFile {
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
    /// A piece does not say how many points and cells it has.
    pub fn description(&self) -> Result<Description, VtkError> {
        let pieces = grid_pieces(self.file.path(), &[&self.file])?;
        Ok(Sections::join(&pieces).describe(self.file.version(), &pieces))
    }

    /// Decodes points, cells, field data and the selected arrays, and joins all pieces.
    ///
    /// # Errors
    /// A selected array is missing, or differs between the pieces; or any of the data is
    /// cut, corrupt, or contradicts the rest.
    pub fn read(&self, selection: &Selection) -> Result<Loaded<UnstructuredGrid>, VtkError> {
        read_grids(&grid_pieces(self.file.path(), &[&self.file])?, selection)
    }

    /// The parsed file.
    pub(super) fn xml(&self) -> &XmlFile {
        &self.file
    }
}

impl TryFrom<XmlFile> for VtuFile {
    type Error = VtkError;

    fn try_from(file: XmlFile) -> Result<Self, VtkError> {
        Ok(Self { file: file.expect(KIND)? })
    }
}

/// The pieces of one file or of several.
pub(super) fn grid_pieces<'a>(
    path: &'a Path,
    files: &[&'a XmlFile],
) -> Result<Pieces<'a>, VtkError> {
    Pieces::of(path, files, PieceCounts::of_grid)
}

/// Decodes and joins pieces.
pub(super) fn read_grids(
    pieces: &Pieces<'_>,
    selection: &Selection,
) -> Result<Loaded<UnstructuredGrid>, VtkError> {
    let mut budget = pieces.budget();
    let reading = Reading::open(pieces, selection, &mut budget)?;
    let types = read_types(&pieces.list, &mut budget)?;
    let mut cells = read_lists(CELLS, &cell_sources(&pieces.list), &mut budget)?;
    let polyhedra = read_polyhedra(&pieces.list, &mut budget)?;
    let warnings = reading.warnings.clone();
    let decoded = reading.decode()?;
    renumber_old(pieces, &types, &mut cells, &decoded.cell_data);
    pieces.list.iter().for_each(|piece| piece.file.release());
    Ok(Loaded {
        data: UnstructuredGrid {
            points: decoded.points,
            cells,
            types,
            polyhedra,
            point_data: decoded.point_data,
            cell_data: decoded.cell_data,
            field_data: decoded.field_data,
        },
        warnings,
    })
}

fn cell_sources<'a>(pieces: &[Piece<'a>]) -> Vec<ListSource<'a>> {
    let source = |piece: &Piece<'a>| ListSource {
        file: piece.file,
        section: piece.node.child("Cells"),
        label: piece.label("Cells"),
        count: Some(piece.counts.cells),
        bound: piece.counts.points,
    };
    pieces.iter().map(source).collect()
}

/// Brings the cells of pieces in old files to today's order of nodes.
fn renumber_old(pieces: &Pieces<'_>, types: &[u8], cells: &mut CellArray, cell_data: &Attributes) {
    let mut end = 0;
    for piece in &pieces.list {
        let start = end;
        end += piece.counts.cells;
        if old_hexahedra::is_before(piece.file.version(), old_hexahedra::XML_VERSION) {
            old_hexahedra::renumber(cells, types, start..end, cell_data);
        }
    }
}

/// Reads the cell types of all pieces.
fn read_types(pieces: &[Piece<'_>], budget: &mut Budget) -> Result<Vec<u8>, VtkError> {
    let mut types = Vec::new();
    for piece in pieces {
        let file = piece.file;
        let count = piece.counts.cells;
        if count == 0 {
            continue;
        }
        let section = piece.node.child("Cells");
        let read = Integers::open(file, section, "types", Some(count), budget).and_then(|part| {
            let start = types.len();
            types.resize(start + part.count(), 0u8);
            part.decode(types.get_mut(start..).unwrap_or_default())
        });
        let label = piece.label("Cells");
        read.map_err(|problem| file.array_error(&label, "types", problem))?;
    }
    Ok(types)
}
