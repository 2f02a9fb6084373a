//! The Python module: arrays in, arrays out. What users see is in `python/vtu2contour`.

mod array_interpolant;
mod arrays;
mod error;
mod grid;
mod grid_interpolant;
mod job;
mod monitor;
mod options;
mod output;
mod refinement;

/// The compiled part of `vtu2contour`.
#[pyo3::pymodule]
mod _core {
    #[pymodule_export]
    use super::array_interpolant::{ArrayInterpolant, contour_arrays};
    #[pymodule_export]
    use super::error::{MissingArrayError, NothingToContourError};
    #[pymodule_export]
    use super::grid_interpolant::{GridInterpolant, contour_grid};

    #[pymodule_export]
    use super::refinement::{curves, refine_arrays, refine_grid};

    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
