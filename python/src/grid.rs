//! A grid that Python took apart, as the library's.

use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use vtu2contour::vtk::{AttributeKind, Attributes, CellArray, Polyhedra, UnstructuredGrid};

use super::arrays::{NamedArray, data_array, slice};

/// A grid as a dictionary with these keys.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct GridParts<'py> {
    points: NamedArray<'py>,
    offsets: PyReadonlyArray1<'py, i64>,
    connectivity: PyReadonlyArray1<'py, i64>,
    types: PyReadonlyArray1<'py, u8>,
    /// The faces of polyhedra, as in VTK's files before 9.4: a stream, and where each cell's
    /// part of it ends (-1 for other cells).
    faces: Option<(Vec<i64>, Vec<i64>)>,
    point_data: Vec<NamedArray<'py>>,
    cell_data: Vec<NamedArray<'py>>,
    field_data: Vec<NamedArray<'py>>,
    /// VTK's names of roles, and the arrays that have them.
    point_roles: Vec<(String, String)>,
    cell_roles: Vec<(String, String)>,
}

impl GridParts<'_> {
    /// The grid; it borrows nothing from Python.
    ///
    /// # Errors
    /// `ValueError` if cells or arrays do not fit together.
    pub fn grid(self) -> PyResult<UnstructuredGrid> {
        let contradiction = |error| PyValueError::new_err(format!("the cells are wrong: {error}"));
        let mut grid = UnstructuredGrid::new(data_array(self.points)?);
        let offsets = slice(&self.offsets, "offsets")?.to_vec();
        let connectivity = slice(&self.connectivity, "connectivity")?.to_vec();
        grid.cells = CellArray::from_parts(offsets, connectivity).map_err(contradiction)?;
        grid.types = slice(&self.types, "types")?.to_vec();
        if let Some((stream, ends)) = self.faces {
            let mut polyhedra = Polyhedra::default();
            polyhedra.push_stream(&stream, &ends).map_err(contradiction)?;
            grid.polyhedra = Some(polyhedra);
        }
        if grid.types.len() != grid.cells.len() {
            return Err(PyValueError::new_err("there must be one type for each cell"));
        }
        let (points, cells) = (grid.points.tuples(), grid.types.len());
        grid.point_data = attributes(self.point_data, &self.point_roles, Some(points))?;
        grid.cell_data = attributes(self.cell_data, &self.cell_roles, Some(cells))?;
        grid.field_data = attributes(self.field_data, &[], None)?;
        Ok(grid)
    }
}

fn attributes(
    arrays: Vec<NamedArray>,
    roles: &[(String, String)],
    tuples: Option<usize>,
) -> PyResult<Attributes> {
    let mut attributes = Attributes::new();
    for array in arrays {
        let array = data_array(array)?;
        if tuples.is_some_and(|tuples| tuples != array.tuples()) {
            let (name, found) = (array.name, array.values.len());
            return Err(PyValueError::new_err(format!(
                "array '{name}' has {found} values, too few or many"
            )));
        }
        attributes.push(array);
    }
    for (role, name) in roles {
        if let Some(kind) = AttributeKind::of_name(role) {
            attributes.set_active(kind, name);
        }
    }
    Ok(attributes)
}
