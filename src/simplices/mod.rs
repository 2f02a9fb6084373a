//! Cells of all of VTK's types as triangles and tetrahedra.
//!
//! Knows VTK's cell types and meshes; what a contour is, it does not know.

mod cell_type;
mod convex_solid;
mod corner_cut;
mod element;
mod lagrange_grid;
mod layout;
mod left_out;
mod nodal_gradients;
mod orientation;
mod polygon;
mod polyhedron;
mod reference;
mod split_grid;
mod splitter;
mod term;

pub use cell_type::{CellCounts, dimension, name as cell_type_name};
pub use lagrange_grid::lagrange_grid;
pub use left_out::{LeftOut, Reason};
pub use nodal_gradients::nodal_gradients;
pub use polygon::MOST_CORNERS;
pub use split_grid::{Pieces, SplitError, SplitGrid, vectors};
