//! VTK's data in, VTK's data out: contouring as a filter.
//!
//! This is what the command line and the Python module call. It joins the floors
//! below: which array of a grid is meant and where its gradient is, cells as
//! simplices, the interpolant, its contours, and the data that travel along.

mod boundary_curves;
mod cell_monitor;
mod cells;
mod chosen_array;
mod contour_filter;
mod contoured_solution;
mod contours;
mod error;
mod evaluation;
mod extent;
mod family_member;
mod gradient_arrays;
mod gradients;
mod interpolant;
mod interpolation;
mod known_pde;
mod level_warning;
mod line_output;
mod merge_points;
mod monitor;
mod needed_arrays;
mod options;
mod output;
mod partial_interpolation;
mod pde_warning;
mod picture;
mod preview;
mod range_warning;
mod rectangles;
mod refined_grid;
mod report;
mod resample;
mod sampling;
mod second_interpolant;
mod solution;
mod surface_output;

pub use boundary_curves::boundary_curves;
pub use cell_monitor::Monitor;
pub use cells::{Cells, Part, Tetrahedra, Triangles};
pub use chosen_array::{ChosenArray, Component};
pub use contour_filter::{Contoured, Stage, contour, contour_owned, prepared};
pub use contoured_solution::ContouredSolution;
pub use contours::Contours;
pub use error::FilterError;
pub use evaluation::{Locators, Place};
pub use extent::Extent;
pub use family_member::FamilyMember;
pub use gradients::{GradientOrigin, GradientSource, Gradients};
pub use interpolant::Interpolant;
pub use interpolation::{Interpolated, Interpolation, OnTetrahedra, OnTriangles};
pub use known_pde::KnownPde;
pub use level_warning::level_warning;
pub use monitor::{MonitorOptions, Monitored, MonitoredGrid, monitor};
pub use needed_arrays::{arrays_of_cells, needed_arrays};
pub use options::{ContourOptions, DEFAULT_SURFACE_TOLERANCE, DEFAULT_TOLERANCE, InterpolantKind};
pub use output::{
    ORIGINAL_CELLS, Output, OutputOptions, OutputPoint, OutputPoints, renumber_cells,
};
pub use picture::picture;
pub use preview::{Preview, preview};
pub use refined_grid::{
    MarkedBy, PARENT_EDGE, RefineMethod, RefineOptions, RefinedGrid, refine, without_origins,
};
pub use report::Report;
pub use resample::Stencil;
pub use sampling::{
    SampleOptions, Sampled, SubdividedGrid, Subdivision, sample, sample_image, subdivide,
};
pub use second_interpolant::SecondInterpolant;
pub use solution::{Domain, Solution};
