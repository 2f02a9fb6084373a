//! Writing polygonal data (`.vtp`).

use super::atomic_file::AtomicFile;
use super::error::VtkError;
use super::poly_data::PolyData;
use super::write_options::WriteOptions;
use super::writing::{check_data, write_attributes, write_field, write_lists, write_points};
use super::xml_writer::XmlWriter;
use std::io::{self, Write};
use std::path::Path;

/// Writes polygonal data to a file, which appears whole or not at all.
///
/// # Errors
/// [`VtkError::Inconsistent`] if an array has another length than its points or cells,
/// [`VtkError::Write`] if the file cannot be written.
pub fn write_vtp(
    path: impl AsRef<Path>,
    data: &PolyData,
    options: WriteOptions,
) -> Result<(), VtkError> {
    check(data)?;
    let mut file = AtomicFile::create(path)?;
    write(&mut file, data, options).map_err(VtkError::Write)?;
    file.commit()
}

/// Writes polygonal data as the bytes of a `.vtp` file.
///
/// # Errors
/// As [`write_vtp`].
pub fn write_vtp_to(
    out: impl Write,
    data: &PolyData,
    options: WriteOptions,
) -> Result<(), VtkError> {
    check(data)?;
    write(out, data, options).map_err(VtkError::Write)
}

fn check(data: &PolyData) -> Result<(), VtkError> {
    let cells = data.cell_count();
    check_data(&data.points, &data.point_data, &data.cell_data, cells)?;
    let kinds = [
        ("Verts", &data.verts),
        ("Lines", &data.lines),
        ("Polys", &data.polys),
        ("Strips", &data.strips),
    ];
    for (section, cells) in kinds {
        let checked = cells.check_indices(data.points.tuples());
        checked.map_err(|problem| VtkError::Inconsistent {
            section,
            name: String::from("connectivity"),
            problem,
        })?;
    }
    Ok(())
}

fn write(out: impl Write, data: &PolyData, options: WriteOptions) -> io::Result<()> {
    let mut xml = XmlWriter::begin(out, "PolyData", options)?;
    xml.open("PolyData", &[])?;
    write_field(&mut xml, &data.field_data, options)?;
    let kinds = [
        ("NumberOfPoints", data.points.tuples()),
        ("NumberOfVerts", data.verts.len()),
        ("NumberOfLines", data.lines.len()),
        ("NumberOfStrips", data.strips.len()),
        ("NumberOfPolys", data.polys.len()),
    ];
    let counts = kinds.map(|(name, count)| (name, count.to_string()));
    xml.open("Piece", &counts.each_ref().map(|(name, count)| (*name, &count[..])))?;
    write_attributes(&mut xml, "PointData", &data.point_data, options)?;
    write_attributes(&mut xml, "CellData", &data.cell_data, options)?;
    write_points(&mut xml, &data.points, options)?;
    let sections = [
        ("Verts", &data.verts),
        ("Lines", &data.lines),
        ("Strips", &data.strips),
        ("Polys", &data.polys),
    ];
    for (section, cells) in sections {
        xml.open(section, &[])?;
        write_lists(&mut xml, cells)?;
        xml.close(section)?;
    }
    xml.close("Piece")?;
    xml.close("PolyData")?;
    xml.finish()?.flush()
}
