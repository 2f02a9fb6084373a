//! Monitors: how much each cell needs to be refined (thesis, section 3.3).
//!
//! A monitor is one number a cell, and takes any interpolants ([`Pieces`](crate::interpolant::Pieces))
//! on triangles or tetrahedra:
//!
//! | monitor | the number of a cell |
//! |---|---|
//! | [`defect`] | its area times the mean of `\|L p - g\|`: about `∫ \|L p - g\|` |
//! | [`surface_area`] | `∫ √(1 + \|∇p\|²)` |
//! | [`stepwise_error`] | the mean difference to the interpolant of another mesh, a step before or after |
//! | [`interpolation_error`] | the mean difference to another interpolant on the same mesh |
//!
//! Means and integrals are those over [`SamplePoints`], the same in every cell. All numbers
//! are the same for any number of threads. Where one cannot be computed (a cell without
//! size, values that are not finite) it is NaN, and [`summary`](Summary::new) counts it.
//! [`Selection`] then tells which cells are to be refined.

mod defect;
mod interpolation_error;
mod sample_points;
mod selection;
mod stepwise_error;
mod summary;
mod surface_area;

pub use defect::{defect, greatest_defect};
pub use interpolation_error::interpolation_error;
pub use sample_points::SamplePoints;
pub use selection::{Selection, SelectionError};
pub use stepwise_error::{once_refined, stepwise_error};
pub use summary::Summary;
pub use surface_area::surface_area;

use rayon::prelude::*;

use crate::interruption::checkpoint;
use crate::mesh::SimplexMesh;

/// One number a cell, of its sample points with their weights; NaN for cells without size
/// and where the number is not finite.
fn by_cell<const CORNERS: usize>(
    mesh: &SimplexMesh<CORNERS>,
    points: SamplePoints,
    number: impl Fn(usize, &[([f64; CORNERS], f64)]) -> f64 + Sync,
) -> Vec<f64> {
    let fixed = points.fixed();
    let of_cell = |cell: usize| {
        checkpoint();
        if mesh.measure(cell) == 0.0 {
            return f64::NAN;
        }
        let number = match points.random(cell) {
            Some(random) => number(cell, &random),
            None => number(cell, &fixed),
        };
        if number.is_finite() { number } else { f64::NAN }
    };
    (0..mesh.simplices().len()).into_par_iter().with_min_len(64).map(of_cell).collect()
}
