//! Reading files in VTK's older format (`.vtk`): unstructured grids and polygonal data.
//!
//! This is a reader of our own and not `vtkio` 0.7.0-rc2, which was the first choice: of
//! the 9 real files at hand it reads 7 (field data before the points, and version 5.1 as
//! meshio writes it, are refused), of 308 files that VTK 9.7 writes of one array each 154,
//! of 32 that hold every type 4. NaN and infinity in ascii, `signed_char`, 64-bit integers,
//! strings, the names of components and any `TimeValue` are refused, and its errors name
//! neither a place nor a reason: half of what VTK writes would be lost. This one reads them
//! all as VTK does, with the decoders of numbers that the XML files use.
//!
//! What is decoded is first found ([`LegacyIndex`]), in one pass over the file: the format
//! has no table of contents. A file that ends between two sections is whole, as far as
//! anyone can tell; one that ends anywhere else is refused.

use super::array_type::ArrayType;
use super::cell_array::CellArray;
use super::data_array::DataArray;
use super::description::Description;
use super::error::{ArrayError, VtkError};
use super::file_bytes::FileBytes;
use super::legacy_array::LegacyArray;
use super::legacy_cells::LegacyCells;
use super::legacy_index::{LegacyIndex, LegacyKind};
use super::legacy_polyhedra::split_polyhedra;
use super::old_hexahedra;
use super::piece::PieceCounts;
use super::poly_data::PolyData;
use super::reading::Loaded;
use super::selection::Selection;
use super::unstructured_grid::UnstructuredGrid;
use super::values::Values;
use std::path::{Path, PathBuf};

/// How every legacy file begins.
pub(super) const SIGNATURE: &[u8] = b"# vtk DataFile Version";

/// An open `.vtk` file of any version from 1.0 to 5.1, ascii or binary, of which nothing
/// has been decoded.
///
/// The file is mapped into memory: it must not be changed or shortened by another program
/// while this value lives.
#[derive(Debug)]
pub struct LegacyFile {
    path: PathBuf,
    bytes: FileBytes,
    index: LegacyIndex,
}

/// The data of a `.vtk` file.
#[derive(Clone, Debug, PartialEq)]
pub enum LegacyData {
    /// `UNSTRUCTURED_GRID`
    Grid(UnstructuredGrid),
    /// `POLYDATA`
    PolyData(PolyData),
}

impl LegacyData {
    /// The same points, cells and data as a grid of cells.
    pub fn into_grid(self) -> UnstructuredGrid {
        match self {
            Self::Grid(grid) => grid,
            Self::PolyData(data) => data.into_grid(),
        }
    }
}

impl LegacyFile {
    /// Maps the file and finds what is in it.
    ///
    /// # Errors
    /// The file cannot be read, is of another kind or holds another data set, is cut, or
    /// contradicts itself.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, VtkError> {
        Self::parse(path.as_ref(), FileBytes::open(path.as_ref())?)
    }

    /// Takes a file that is in memory. `name` stands for its path in messages.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn from_bytes(name: impl AsRef<Path>, bytes: Vec<u8>) -> Result<Self, VtkError> {
        Self::parse(name.as_ref(), FileBytes::Owned(bytes))
    }

    pub(super) fn parse(path: &Path, bytes: FileBytes) -> Result<Self, VtkError> {
        let path = path.to_owned();
        if !bytes.starts_with(SIGNATURE) {
            let found = String::from("it does not begin with '# vtk DataFile Version'");
            return Err(VtkError::NotVtk { path, found });
        }
        match LegacyIndex::read(&bytes) {
            Ok(index) => Ok(Self { path, bytes, index }),
            Err(flaw) => Err(VtkError::Legacy { path, offset: flaw.offset, problem: flaw.problem }),
        }
    }

    /// What is in the file; nothing is decoded.
    pub fn description(&self) -> Description {
        let index = &self.index;
        let count = |kind: usize| match index.kind {
            LegacyKind::Grid => 0,
            LegacyKind::PolyData => {
                index.cells.get(kind).and_then(Option::as_ref).map_or(0, LegacyCells::len)
            }
        };
        Description {
            version: index.version.clone(),
            pieces: vec![PieceCounts {
                points: index.point_count(),
                cells: index.cell_count(),
                verts: count(0),
                lines: count(1),
                polys: count(2),
                strips: count(3),
            }],
            point_arrays: index.point_data.describe(),
            cell_arrays: index.cell_data.describe(),
            field_arrays: index.field_data.describe(),
            warnings: self.warnings(&[&index.point_data, &index.cell_data, &index.field_data]),
        }
    }

    fn warnings(&self, sections: &[&super::legacy_section::LegacySection]) -> Vec<String> {
        let of_arrays = sections.iter().flat_map(|section| section.warnings());
        of_arrays.chain(self.index.warnings.iter().cloned()).collect()
    }

    /// Decodes points, cells, field data and the selected arrays.
    ///
    /// # Errors
    /// A selected array is missing or of the wrong length; or any of the data is corrupt,
    /// or contradicts the rest.
    pub fn read(&self, selection: &Selection) -> Result<Loaded<LegacyData>, VtkError> {
        let index = &self.index;
        let point_data = index.point_data.clone().select(&self.path, selection.points())?;
        let cell_data = index.cell_data.clone().select(&self.path, selection.cells())?;
        let warnings = self.warnings(&[&point_data, &cell_data, &index.field_data]);
        let mut data = self.read_shape()?;
        let (points, cells, field) = match &mut data {
            LegacyData::Grid(grid) => {
                (&mut grid.point_data, &mut grid.cell_data, &mut grid.field_data)
            }
            LegacyData::PolyData(data) => {
                (&mut data.point_data, &mut data.cell_data, &mut data.field_data)
            }
        };
        *points = point_data.decode(&self.path, &self.bytes)?;
        *cells = cell_data.decode(&self.path, &self.bytes)?;
        *field = index.field_data.decode(&self.path, &self.bytes)?;
        if let LegacyData::Grid(grid) = &mut data {
            self.renumber_old(grid);
        }
        Ok(Loaded { data, warnings })
    }

    /// Brings the cells of an old file to today's order of nodes.
    fn renumber_old(&self, grid: &mut UnstructuredGrid) {
        if old_hexahedra::is_before(&self.index.version, old_hexahedra::LEGACY_VERSION) {
            let all = 0..grid.types.len();
            old_hexahedra::renumber(&mut grid.cells, &grid.types, all, &grid.cell_data);
        }
    }

    /// Points and cells without data.
    fn read_shape(&self) -> Result<LegacyData, VtkError> {
        let points = self.read_points()?;
        let count = points.tuples();
        let cells = |place: usize| {
            let cells = self.index.cells.get(place).and_then(Option::as_ref);
            let cells = cells.map_or(Ok(CellArray::new()), |cells| cells.decode(&self.bytes));
            cells.map_err(|problem| self.error("Cells", problem))
        };
        if self.index.kind == LegacyKind::Grid {
            return self.read_grid(UnstructuredGrid::new(points), cells(0)?);
        }
        let mut data = PolyData::new(points);
        let kinds = [&mut data.verts, &mut data.lines, &mut data.polys, &mut data.strips];
        for (place, kind) in kinds.into_iter().enumerate() {
            *kind = cells(place)?;
            kind.check_indices(count).map_err(|problem| self.error("Cells", problem))?;
        }
        Ok(LegacyData::PolyData(data))
    }

    fn read_grid(
        &self,
        mut grid: UnstructuredGrid,
        cells: CellArray,
    ) -> Result<LegacyData, VtkError> {
        let count = grid.points.tuples();
        let error = |problem| self.error("Cells", problem);
        if let Some(types) = &self.index.types {
            grid.types = read_types(types, &self.bytes).map_err(error)?;
        }
        let (cells, polyhedra) = split_polyhedra(cells, &grid.types).map_err(error)?;
        cells.check_indices(count).map_err(error)?;
        grid.cells = cells;
        grid.polyhedra = polyhedra;
        Ok(LegacyData::Grid(grid))
    }

    /// `Float32` and `Float64` are kept, integers become `Float64`.
    fn read_points(&self) -> Result<DataArray, VtkError> {
        let Some(points) = &self.index.points else {
            return Ok(DataArray::new("Points", 3, Vec::<f32>::new()));
        };
        let error = |problem| self.error("Points", problem);
        let kind = points.array_type();
        if matches!(kind, ArrayType::Bit | ArrayType::String) {
            return Err(error(ArrayError::WrongType { found: kind, expected: "a number" }));
        }
        let mut points = points.decode(&self.bytes).map_err(error)?;
        if !kind.is_float() {
            points.values = Values::F64(points.to_f64().unwrap_or_default());
        }
        Ok(points)
    }

    fn error(&self, section: &str, problem: ArrayError) -> VtkError {
        let (section, name) = (section.to_owned(), section.to_lowercase());
        VtkError::Array { path: self.path.clone(), section, name, problem }
    }
}

fn read_types(types: &LegacyArray, bytes: &[u8]) -> Result<Vec<u8>, ArrayError> {
    let mut kinds = Vec::with_capacity(types.tuples);
    types.for_each_index(bytes, |kind| {
        let small = u8::try_from(kind);
        kinds.push(small.map_err(|_| ArrayError::NoIndex { value: kind.to_string() })?);
        Ok(())
    })?;
    Ok(kinds)
}
