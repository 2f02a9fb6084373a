//! The difference of two interpolants (thesis, section 3.3.4).

use super::{SamplePoints, by_cell};
use crate::interpolant::Pieces;

/// The mean of `|p - q|` over the sample points of each cell, of two interpolants on the same
/// cells, in the unit of the values.
///
/// The thesis takes the full or the pure quartic for `q`
/// ([`FQI`](crate::interpolant::family::spaces::FQI),
/// [`DEI4_15`](crate::interpolant::family::spaces::DEI4_15)) and the pure cubic for `p`.
pub fn interpolation_error<const CORNERS: usize>(
    pieces: &(impl Pieces<CORNERS> + ?Sized),
    others: &(impl Pieces<CORNERS> + ?Sized),
    points: SamplePoints,
) -> Vec<f64> {
    by_cell(pieces.mesh(), points, |cell, sampled| {
        let differences = sampled.iter().map(|(at, weight)| {
            weight * (pieces.taylor(cell, at).value - others.taylor(cell, at).value).abs()
        });
        differences.sum()
    })
}
