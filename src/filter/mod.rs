//! VTK's data in, VTK's data out: contouring as a filter.
//!
//! This is what the command line and the Python module call. It joins the floors
//! below: which array of a grid is meant and where its gradient is, cells as
//! triangles, the interpolant, its contours, and the data that travel along.

mod cell_type;
mod contour_filter;
mod error;
mod gradient_arrays;
mod known_pde;
mod line_output;
mod merge_points;
mod options;
mod pde_warning;
mod picture;
mod resample;
mod scalars;
mod solution;
mod triangles;

pub use cell_type::{CellCounts, dimension, name as cell_type_name};
pub use contour_filter::{Contoured, Report, Stage, contour};
pub use error::FilterError;
pub use line_output::ORIGINAL_CELLS;
pub use options::{ContourOptions, DEFAULT_TOLERANCE, InterpolantKind};
pub use picture::picture;
pub use scalars::{ChosenArray, Component, GradientSource, Gradients};
pub use solution::{Interpolated, Solution};
pub use triangles::Triangles;
