//! The area of the graph (thesis, section 3.3.2).

use super::{SamplePoints, by_cell};
use crate::interpolant::Pieces;

/// The area of the interpolant's graph over each cell: `∫ √(1 + |∇p|²)`, by the mean over the
/// sample points; on tetrahedra the same integral over the volume.
///
/// Values and lengths have different units, so it depends on both: where slopes are small it
/// is the cell's own area.
pub fn surface_area<const CORNERS: usize>(
    pieces: &(impl Pieces<CORNERS> + ?Sized),
    points: SamplePoints,
) -> Vec<f64> {
    let mesh = pieces.mesh();
    by_cell(mesh, points, |cell, sampled| {
        let stretch = sampled.iter().map(|(at, weight)| {
            weight * (1.0 + pieces.taylor(cell, at).gradient.norm_squared()).sqrt()
        });
        mesh.measure(cell) * stretch.sum::<f64>()
    })
}
