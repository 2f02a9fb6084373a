//! VTK's data in, VTK's data out: contouring as a filter.
//!
//! This is what the command line and the Python module call. It joins the floors
//! below: which array of a grid is meant and where its gradient is, cells as
//! simplices, the interpolant, its contours, and the data that travel along.

mod cells;
mod chosen_array;
mod contour_filter;
mod error;
mod gradient_arrays;
mod gradients;
mod known_pde;
mod level_warning;
mod line_output;
mod merge_points;
mod needed_arrays;
mod options;
mod pde_warning;
mod picture;
mod preview;
mod range_warning;
mod resample;
mod solution;

pub use cells::{Cells, Part, Tetrahedra, Triangles};
pub use chosen_array::{ChosenArray, Component};
pub use contour_filter::{Contoured, Report, Stage, contour};
pub use error::FilterError;
pub use gradients::{GradientOrigin, GradientSource, Gradients};
pub use level_warning::level_warning;
pub use line_output::ORIGINAL_CELLS;
pub use needed_arrays::needed_arrays;
pub use options::{ContourOptions, DEFAULT_TOLERANCE, InterpolantKind};
pub use picture::picture;
pub use preview::{Preview, preview};
pub use solution::{Interpolated, Solution};
