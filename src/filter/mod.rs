//! VTK's data in, VTK's data out: contouring as a filter.
//!
//! This is what the command line and the Python module call. It joins the floors
//! below: which array of a grid is meant and where its gradient is, cells as
//! triangles, the interpolant, its contours, and the data that travel along.

mod cell_type;
mod contour_filter;
mod error;
mod level_warning;
mod line_output;
mod needed_arrays;
mod options;
mod picture;
mod preview;
mod resample;
mod scalars;
mod solution;
mod triangles;

pub use cell_type::{CellCounts, dimension, name as cell_type_name};
pub use contour_filter::{Contoured, Report, Stage, contour};
pub use error::FilterError;
pub use level_warning::level_warning;
pub use line_output::ORIGINAL_CELLS;
pub use needed_arrays::needed_arrays;
pub use options::{ContourOptions, DEFAULT_TOLERANCE, InterpolantKind};
pub use picture::picture;
pub use preview::{Preview, preview};
pub use scalars::{ChosenArray, Component, GradientSource, Gradients};
pub use solution::{Interpolated, Solution};
pub use triangles::Triangles;
