//! VTK's XML files: unstructured grids (`.vtu`) and polygonal data (`.vtp`).

mod array_type;
mod attributes;
mod cell_array;
mod data_array;
mod error;
mod poly_data;
mod polyhedra;
mod scalar;
mod unstructured_grid;
mod values;

pub use array_type::ArrayType;
pub use attributes::{AttributeKind, Attributes};
pub use cell_array::CellArray;
pub use data_array::DataArray;
pub use error::{ArrayError, VtkError};
pub use poly_data::PolyData;
pub use polyhedra::Polyhedra;
pub use scalar::Scalar;
pub use unstructured_grid::UnstructuredGrid;
pub use values::Values;
