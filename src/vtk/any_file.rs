//! One way into every file that holds a grid or a surface, whatever its format.

use super::description::Description;
use super::error::VtkError;
use super::file_bytes::FileBytes;
use super::legacy_reader::{LegacyData, LegacyFile, SIGNATURE};
use super::poly_data::PolyData;
use super::pvd_file::{self, PvdFile};
use super::pvtp_reader::PvtpFile;
use super::pvtu_reader::PvtuFile;
use super::reading::Loaded;
use super::selection::Selection;
use super::unstructured_grid::UnstructuredGrid;
use super::vtp_reader::VtpFile;
use super::vtu_reader::VtuFile;
use super::xml_file::XmlFile;
use std::path::{Path, PathBuf};

/// Reads a `.vtu`, `.pvtu`, `.vtp`, `.pvtp` or legacy `.vtk` file as a grid: see
/// [`AnyFile::read`].
///
/// # Errors
/// As [`AnyFile::open`] and [`AnyFile::read`].
pub fn read_grid(
    path: impl AsRef<Path>,
    selection: &Selection,
) -> Result<Loaded<UnstructuredGrid>, VtkError> {
    AnyFile::open(path)?.read(selection)
}

/// An open file of any format.
#[derive(Debug)]
#[allow(clippy::large_enum_variant)] // there is one of it, for a moment
pub enum AnyFile {
    /// An unstructured grid.
    Vtu(VtuFile),
    /// The list of the pieces of an unstructured grid.
    Pvtu(PvtuFile),
    /// Polygonal data.
    Vtp(VtpFile),
    /// The list of the pieces of polygonal data.
    Pvtp(PvtpFile),
    /// Either, in the older format.
    Legacy(Box<LegacyFile>),
    /// A series of files.
    Pvd(PvdFile),
}

impl AnyFile {
    /// Opens a file. The format is known by the file's content, not by its name.
    ///
    /// # Errors
    /// As the readers of the formats: [`VtuFile`], [`PvtuFile`], [`VtpFile`], [`PvtpFile`],
    /// [`LegacyFile`], [`PvdFile`].
    pub fn open(path: impl AsRef<Path>) -> Result<Self, VtkError> {
        let path = path.as_ref();
        Self::parse(path, FileBytes::open(path)?)
    }

    /// Takes the bytes of a file. `path` stands for its name in messages.
    pub(super) fn parse(path: &Path, bytes: FileBytes) -> Result<Self, VtkError> {
        if bytes.starts_with(SIGNATURE) {
            return LegacyFile::parse(path, bytes).map(|file| Self::Legacy(Box::new(file)));
        }
        let file = XmlFile::parse_any(path, bytes)?;
        let kind = file.kind().into_owned();
        match &kind[..] {
            "PUnstructuredGrid" => file.try_into().map(Self::Pvtu),
            "PolyData" => file.try_into().map(Self::Vtp),
            "PPolyData" => file.try_into().map(Self::Pvtp),
            pvd_file::KIND => file.try_into().map(Self::Pvd),
            "UnstructuredGrid" => file.try_into().map(Self::Vtu),
            _ => Err(VtkError::NoGrid { path: path.to_owned(), found: kind }),
        }
    }

    /// Decodes a grid. Vertices, lines, polygons and strips of surfaces become cells of the
    /// grid; pieces are joined.
    ///
    /// # Errors
    /// [`VtkError::Series`]: the file is a `.pvd`, whose entries are read one by one. Else as
    /// the readers of the formats.
    pub fn read(&self, selection: &Selection) -> Result<Loaded<UnstructuredGrid>, VtkError> {
        match self {
            Self::Vtu(file) => file.read(selection),
            Self::Pvtu(file) => file.read(selection),
            Self::Vtp(file) => file.read(selection).map(surface),
            Self::Pvtp(file) => file.read(selection).map(surface),
            Self::Legacy(file) => {
                file.read(selection).map(|loaded| loaded.map(LegacyData::into_grid))
            }
            Self::Pvd(file) => Err(file.no_grid()),
        }
    }

    /// Decodes one piece of a `.pvtu` or `.pvtp`, with the field data of the list.
    ///
    /// # Errors
    /// The piece cannot be opened, or as [`read`](Self::read).
    pub fn read_piece(
        &self,
        index: usize,
        selection: &Selection,
    ) -> Result<Loaded<UnstructuredGrid>, VtkError> {
        match self {
            Self::Pvtu(file) => file.read_piece(index, selection),
            Self::Pvtp(file) => file.read_piece(index, selection).map(surface),
            _ => self.read(selection),
        }
    }

    /// The files of the pieces of a `.pvtu` or `.pvtp`; none of other files.
    pub fn piece_paths(&self) -> &[PathBuf] {
        match self {
            Self::Pvtu(file) => file.piece_paths(),
            Self::Pvtp(file) => file.piece_paths(),
            _ => &[],
        }
    }

    /// What is in the file. Nothing is decoded; of a `.pvtu` or `.pvtp` every piece is
    /// opened.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn description(&self) -> Result<Description, VtkError> {
        match self {
            Self::Vtu(file) => file.description(),
            Self::Pvtu(file) => file.description(),
            Self::Vtp(file) => file.description(),
            Self::Pvtp(file) => file.description(),
            Self::Legacy(file) => Ok(file.description()),
            Self::Pvd(file) => Err(file.no_grid()),
        }
    }
}

fn surface(loaded: Loaded<PolyData>) -> Loaded<UnstructuredGrid> {
    loaded.map(PolyData::into_grid)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A point in each format, under names that say nothing.
    #[test]
    fn formats_are_known_by_their_content() {
        let points = "<Points><DataArray type='Float32' NumberOfComponents='3'>1 2 3</DataArray>\
                      </Points>";
        let verts = "<Verts><DataArray type='Int8' Name='connectivity'>0</DataArray>\
                     <DataArray type='Int8' Name='offsets'>1</DataArray></Verts>";
        let cells = "<DataArray type='Int8' Name='types'>1</DataArray></Cells>";
        let cells = verts.replace("Verts", "Cells").replace("</Cells>", cells);
        let xml = |kind: &str, inside: &str| {
            format!("<VTKFile type='{kind}'><{kind}>{inside}</{kind}></VTKFile>")
        };
        let piece = |counts: &str, inside: &str| {
            format!("<Piece NumberOfPoints='1' {counts}='1'>{points}{inside}</Piece>")
        };
        let files = [
            xml("UnstructuredGrid", &piece("NumberOfCells", &cells)),
            xml("PolyData", &piece("NumberOfVerts", verts)),
            xml("PUnstructuredGrid", "<Piece Source='0'/>"),
            xml("PPolyData", "<Piece Source='1'/>"),
            String::from(
                "# vtk DataFile Version 2.0\n\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n1 2 3\n\
                 VERTICES 1 2\n1 0\n",
            ),
            xml("Collection", "<DataSet timestep='0' file='0'/>"),
            xml("ImageData", ""),
        ];
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in files.iter().enumerate() {
            std::fs::write(folder.path().join(name.to_string()), text).unwrap();
        }
        for name in ["0", "1", "2", "3", "4"] {
            let path = folder.path().join(name);
            let grid = read_grid(&path, &Selection::All).unwrap().data;
            assert_eq!(grid.points.values, vec![1f32, 2.0, 3.0].into(), "{name}");
            assert_eq!((grid.cells.connectivity(), &grid.types[..]), (&[0i64][..], &[1u8][..]));
            let description = AnyFile::open(&path).unwrap().description().unwrap();
            assert_eq!((description.points(), description.cells()), (1, 1), "{name}");
        }
        let error = |name: &str| {
            let path = folder.path().join(name);
            let described = AnyFile::open(&path).and_then(|file| file.description());
            let error = read_grid(&path, &Selection::All).unwrap_err();
            assert_eq!(error.to_string(), described.unwrap_err().to_string());
            error
        };
        assert!(matches!(error("5"), VtkError::Series { .. }));
        let message = error("6").to_string();
        assert!(message.contains("holds a VTK ImageData, neither a grid nor"), "{message}");
        assert!(matches!(error("7"), VtkError::Read { .. }));
    }
}
