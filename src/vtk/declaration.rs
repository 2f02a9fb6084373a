//! What the pieces of a data set in several files have in common.

use super::array_type::ArrayType;
use super::attributes::Attributes;
use super::data_array::DataArray;
use super::description::ArrayInfo;
use super::poly_data::PolyData;
use super::unstructured_grid::UnstructuredGrid;
use super::write_options::Floats;

/// The arrays that all pieces of a `.pvtu` or `.pvtp` file have, types as in the files.
#[derive(Clone, Debug, PartialEq)]
pub struct Declaration {
    /// `Float32` or `Float64`.
    pub points: ArrayType,
    /// Point arrays.
    pub point_arrays: Vec<ArrayInfo>,
    /// Cell arrays.
    pub cell_arrays: Vec<ArrayInfo>,
}

impl Declaration {
    /// What all pieces have, where this is one that was written in that precision.
    pub fn of_grid(piece: &UnstructuredGrid, floats: Floats) -> Self {
        Self::of(&piece.points, &piece.point_data, &piece.cell_data, floats)
    }

    /// What all pieces have, where this is one that was written in that precision.
    pub fn of_poly_data(piece: &PolyData, floats: Floats) -> Self {
        Self::of(&piece.points, &piece.point_data, &piece.cell_data, floats)
    }

    fn of(
        points: &DataArray,
        point_data: &Attributes,
        cell_data: &Attributes,
        floats: Floats,
    ) -> Self {
        Self {
            points: floats.applied_to(points.array_type()),
            point_arrays: infos(point_data, floats),
            cell_arrays: infos(cell_data, floats),
        }
    }
}

fn infos(attributes: &Attributes, floats: Floats) -> Vec<ArrayInfo> {
    let info = |array: &DataArray| {
        let active = attributes.active_names().iter().filter(|(_, name)| *name == array.name);
        ArrayInfo {
            name: array.name.clone(),
            array_type: floats.applied_to(array.array_type()),
            components: array.components,
            component_names: array.component_names.clone(),
            active: active.map(|(kind, _)| *kind).collect(),
        }
    };
    attributes.iter().map(info).collect()
}
