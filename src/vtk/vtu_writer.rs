//! Writing unstructured grids (`.vtu`).

use super::atomic_file::AtomicFile;
use super::column::numbers;
use super::error::{ArrayError, VtkError};
use super::old_hexahedra;
use super::polyhedra::Polyhedra;
use super::unstructured_grid::UnstructuredGrid;
use super::write_options::WriteOptions;
use super::writing::{check_data, write_attributes, write_field, write_lists, write_points};
use super::xml_writer::{ArrayTag, XmlWriter};
use std::io::{self, Write};
use std::path::Path;

/// Writes a grid to a file, which appears whole or not at all.
///
/// # Errors
/// [`VtkError::Inconsistent`] if an array has another length than its points or cells,
/// [`VtkError::Write`] if the file cannot be written.
pub fn write_vtu(
    path: impl AsRef<Path>,
    grid: &UnstructuredGrid,
    options: WriteOptions,
) -> Result<(), VtkError> {
    check(grid)?;
    let mut file = AtomicFile::create(path)?;
    write(&mut file, grid, options).map_err(VtkError::Write)?;
    file.commit()
}

/// Writes a grid as the bytes of a `.vtu` file.
///
/// # Errors
/// As [`write_vtu`].
pub fn write_vtu_to(
    out: impl Write,
    grid: &UnstructuredGrid,
    options: WriteOptions,
) -> Result<(), VtkError> {
    check(grid)?;
    write(out, grid, options).map_err(VtkError::Write)
}

fn check(grid: &UnstructuredGrid) -> Result<(), VtkError> {
    let cells = grid.cells.len();
    check_data(&grid.points, &grid.point_data, &grid.cell_data, cells)?;
    let contradiction = |name: &str, problem| VtkError::Inconsistent {
        section: "Cells",
        name: name.to_owned(),
        problem,
    };
    let count = |name: &str, found: usize| match found == cells {
        true => Ok(()),
        false => Err(contradiction(name, ArrayError::Count { found, expected: cells })),
    };
    let indices = |error| contradiction("connectivity", error);
    grid.cells.check_indices(grid.points.tuples()).map_err(indices)?;
    count("types", grid.types.len())?;
    let Some(polyhedra) = &grid.polyhedra else {
        return Ok(());
    };
    count("faceoffsets", polyhedra.cells.len())?;
    let faces = |error| contradiction("faces", error);
    polyhedra.faces.check_indices(grid.points.tuples()).map_err(faces)?;
    polyhedra.cells.check_indices(polyhedra.faces.len()).map_err(faces)
}

fn write(out: impl Write, grid: &UnstructuredGrid, options: WriteOptions) -> io::Result<()> {
    // Not every program reads the newer version: it is written where it makes a difference.
    let version = if old_hexahedra::has_any(&grid.types) { "2.1" } else { "1.0" };
    let mut xml = XmlWriter::begin_version(out, "UnstructuredGrid", version, options)?;
    xml.open("UnstructuredGrid", &[])?;
    write_field(&mut xml, &grid.field_data, options)?;
    let points = grid.points.tuples().to_string();
    let cells = grid.cells.len().to_string();
    xml.open("Piece", &[("NumberOfPoints", &points), ("NumberOfCells", &cells)])?;
    write_attributes(&mut xml, "PointData", &grid.point_data, options)?;
    write_attributes(&mut xml, "CellData", &grid.cell_data, options)?;
    write_points(&mut xml, &grid.points, options)?;
    xml.open("Cells", &[])?;
    write_lists(&mut xml, &grid.cells)?;
    xml.array(&ArrayTag::plain("types"), Box::new(numbers(&grid.types[..])))?;
    if let Some(polyhedra) = &grid.polyhedra {
        write_faces(&mut xml, polyhedra)?;
    }
    xml.close("Cells")?;
    xml.close("Piece")?;
    xml.close("UnstructuredGrid")?;
    xml.finish()?.flush()
}

/// Writes the faces in the form that every VTK and meshio read.
fn write_faces<W: Write>(xml: &mut XmlWriter<'_, W>, polyhedra: &Polyhedra) -> io::Result<()> {
    let (stream, ends) = polyhedra.to_stream();
    xml.array(&ArrayTag::plain("faces"), Box::new(numbers(stream)))?;
    xml.array(&ArrayTag::plain("faceoffsets"), Box::new(numbers(ends)))
}
