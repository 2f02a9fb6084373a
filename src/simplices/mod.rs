//! Cells of all of VTK's types as triangles and tetrahedra.
//!
//! Knows VTK's cell types and meshes; what a contour is, it does not know.

mod cell_type;
mod convex_solid;
mod corner_cut;
mod layout;
mod left_out;
mod orientation;
mod polygon;
mod polyhedron;
mod split_grid;
mod splitter;

pub use cell_type::{CellCounts, dimension, name as cell_type_name};
pub use left_out::{LeftOut, Reason};
pub use polygon::MOST_CORNERS;
pub use split_grid::{Pieces, SplitError, SplitGrid, vectors};
