//! Writing files that list other files: pieces (`.pvtu`, `.pvtp`) and series (`.pvd`).

use super::atomic_file::AtomicFile;
use super::declaration::Declaration;
use super::description::ArrayInfo;
use super::error::VtkError;
use super::file_names::name_from;
use super::pvd_file::PvdEntry;
use super::write_options::WriteOptions;
use super::xml_writer::{ArrayTag, XmlWriter};
use std::io::{self, Write};
use std::path::Path;

/// Writes a `.pvtu` file: the list of the `.vtu` files that are the pieces of a grid, which
/// appears whole or not at all. The files need not be there yet.
///
/// # Errors
/// [`VtkError::Write`]: the file cannot be written, or a name is not Unicode.
pub fn write_pvtu<P: AsRef<Path>>(
    path: impl AsRef<Path>,
    pieces: &[P],
    declaration: &Declaration,
) -> Result<(), VtkError> {
    let list = path.as_ref();
    let mut file = AtomicFile::create(list)?;
    write_pieces(&mut file, "PUnstructuredGrid", list, pieces, declaration)?;
    file.commit()
}

/// Writes a `.pvtp` file: the list of the `.vtp` files that are the pieces of a surface,
/// which appears whole or not at all. The files need not be there yet.
///
/// # Errors
/// As [`write_pvtu`].
pub fn write_pvtp<P: AsRef<Path>>(
    path: impl AsRef<Path>,
    pieces: &[P],
    declaration: &Declaration,
) -> Result<(), VtkError> {
    let mut file = AtomicFile::create(&path)?;
    write_pvtp_to(&mut file, path, pieces, declaration)?;
    file.commit()
}

/// Writes the bytes of a `.pvtp` file. `list` is the path it will have: pieces are named
/// relative to it.
///
/// # Errors
/// As [`write_pvtu`].
pub fn write_pvtp_to<P: AsRef<Path>>(
    out: impl Write,
    list: impl AsRef<Path>,
    pieces: &[P],
    declaration: &Declaration,
) -> Result<(), VtkError> {
    write_pieces(out, "PPolyData", list.as_ref(), pieces, declaration)
}

/// Writes a `.pvd` file: the list of the files of a series, which appears whole or not at
/// all. The files need not be there yet.
///
/// # Errors
/// As [`write_pvtu`].
pub fn write_pvd(path: impl AsRef<Path>, entries: &[PvdEntry]) -> Result<(), VtkError> {
    let mut file = AtomicFile::create(&path)?;
    write_pvd_to(&mut file, path, entries)?;
    file.commit()
}

/// Writes the bytes of a `.pvd` file. `list` is the path it will have: files are named
/// relative to it.
///
/// # Errors
/// As [`write_pvtu`].
pub fn write_pvd_to(
    out: impl Write,
    list: impl AsRef<Path>,
    entries: &[PvdEntry],
) -> Result<(), VtkError> {
    write_list(out, "Collection", &[], |xml| {
        entries.iter().try_for_each(|entry| write_entry(xml, list.as_ref(), entry))
    })
}

fn write_pieces<P: AsRef<Path>>(
    out: impl Write,
    kind: &str,
    list: &Path,
    pieces: &[P],
    declaration: &Declaration,
) -> Result<(), VtkError> {
    write_list(out, kind, &[("GhostLevel", "0")], |xml| {
        declare(xml, declaration)?;
        name_pieces(xml, list, pieces)
    })
}

fn write_list<W: Write>(
    out: W,
    kind: &str,
    attributes: &[(&str, &str)],
    fill: impl Fn(&mut XmlWriter<'static, W>) -> io::Result<()>,
) -> Result<(), VtkError> {
    let write = || {
        let mut xml = XmlWriter::begin(out, kind, WriteOptions::default())?;
        xml.open(kind, attributes)?;
        fill(&mut xml)?;
        xml.close(kind)?;
        xml.finish()?.flush()
    };
    write().map_err(VtkError::Write)
}

fn declare(xml: &mut XmlWriter<'static, impl Write>, declaration: &Declaration) -> io::Result<()> {
    declare_section(xml, "PPointData", &declaration.point_arrays)?;
    declare_section(xml, "PCellData", &declaration.cell_arrays)?;
    xml.open("PPoints", &[])?;
    let points = ArrayTag { components: 3, ..ArrayTag::plain("Points") };
    xml.declare(declaration.points, &points)?;
    xml.close("PPoints")
}

fn declare_section(
    xml: &mut XmlWriter<'static, impl Write>,
    section: &str,
    arrays: &[ArrayInfo],
) -> io::Result<()> {
    let roles = |array: &'_ ArrayInfo| -> Vec<_> {
        array.active.iter().map(|kind| (kind.name(), array.name.clone())).collect()
    };
    let active: Vec<_> = arrays.iter().flat_map(roles).collect();
    let active: Vec<_> = active.iter().map(|(kind, name)| (*kind, &name[..])).collect();
    xml.open(section, &active)?;
    for array in arrays {
        let tag = ArrayTag {
            name: &array.name,
            components: array.components,
            component_names: &array.component_names,
            tuples: None,
        };
        xml.declare(array.array_type, &tag)?;
    }
    xml.close(section)
}

fn name_pieces<P: AsRef<Path>>(
    xml: &mut XmlWriter<'static, impl Write>,
    list: &Path,
    pieces: &[P],
) -> io::Result<()> {
    for piece in pieces {
        xml.empty("Piece", &[("Source", &name_from(list, piece.as_ref())?)])?;
    }
    Ok(())
}

fn write_entry(
    xml: &mut XmlWriter<'static, impl Write>,
    list: &Path,
    entry: &PvdEntry,
) -> io::Result<()> {
    let name = name_from(list, &entry.file)?;
    let time = entry.time.map(|time| time.to_string());
    let part = entry.part.to_string();
    let mut attributes = vec![("group", &entry.group[..]), ("part", &part), ("file", &name)];
    if let Some(time) = &time {
        attributes.insert(0, ("timestep", time));
    }
    xml.empty("DataSet", &attributes)
}
