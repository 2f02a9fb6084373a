//! Meshes made finer where that is asked for.
//!
//! Which cells are to be divided is decided elsewhere ([`Marks`]); here they are, with as many
//! of their neighbours as it takes for all cells to fit together again. The result says where
//! every cell and every point comes from ([`Refinement`]). Cells are divided, never joined over
//! what was a side of one: boundaries, and interfaces between regions of cells, stay where
//! they are.
//!
//! In the plane and on surfaces ([`TriangleMethod`], [`smooth`]), and in space ([`refine_tetrahedra`]).

mod centroid;
pub mod delaunay;
mod longest_edge;
mod marked_tetrahedron;
mod marks;
mod newest_vertex;
mod red_green;
mod refinement;
mod smoothing;
mod tetrahedron_bisection;
mod triangle_bisection;
mod triangle_method;

pub use marks::{Marks, RefineError};
pub use refinement::{MovedPoint, NewPoint, Refinement};
pub use smoothing::{Smoothing, smooth};
pub use tetrahedron_bisection::refine_tetrahedra;
pub use triangle_method::TriangleMethod;
