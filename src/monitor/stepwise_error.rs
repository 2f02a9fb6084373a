//! The difference of two steps of refinement (thesis, section 3.3.3).

use rayon::prelude::*;

use super::{SamplePoints, by_cell};
use crate::interpolant::Pieces;
use crate::mesh::{PointLocator, RefinedMesh};

/// The mean of `|p - q|` over the sample points of each cell of `pieces`, where `others` are an
/// interpolant on another mesh of the same domain: that of a step before or after. In the
/// unit of the values.
///
/// Points outside the other mesh, as there are at curved boundaries, are compared with its
/// nearest cell.
pub fn stepwise_error<const CORNERS: usize>(
    pieces: &(impl Pieces<CORNERS> + ?Sized),
    others: &(impl Pieces<CORNERS> + ?Sized),
    points: SamplePoints,
) -> Vec<f64> {
    let (mesh, other_mesh) = (pieces.mesh(), others.mesh());
    let locator = PointLocator::new(other_mesh);
    by_cell(mesh, points, |cell, sampled| {
        let differences = sampled.iter().map(|(at, weight)| {
            let position = mesh.position(cell, at);
            let place = locator.locate(other_mesh, &position, f64::INFINITY);
            let there = place.map_or(f64::NAN, |p| others.taylor(p.simplex, &p.at).value);
            weight * (pieces.taylor(cell, at).value - there).abs()
        });
        differences.sum()
    })
}

/// The same between a mesh and itself with every edge halved (`refined`, of
/// [`RefinedMesh::uniform`] in two parts): the mean of `|p - q|` over the sample points of all
/// parts of each cell of `pieces`, where `finer` are an interpolant on the parts, one after the
/// other.
///
/// This is the thesis' monitor in a step that has none before it: each cell is refined once,
/// to see what that would change.
pub fn once_refined<const CORNERS: usize>(
    pieces: &(impl Pieces<CORNERS> + ?Sized),
    refined: &RefinedMesh<CORNERS>,
    finer: &(impl Pieces<CORNERS> + ?Sized),
    points: SamplePoints,
) -> Vec<f64> {
    let fine_mesh = finer.mesh();
    let differences = by_cell(fine_mesh, points, |part, sampled| {
        let piece = &refined.pieces[part];
        let parent = piece.parent as usize;
        let differences = sampled.iter().map(|(at, weight)| {
            let place = std::array::from_fn(|corner| {
                piece.at.iter().zip(at).map(|(of_piece, share)| of_piece[corner] * share).sum()
            });
            let value = pieces.taylor(parent, &place).value;
            weight * (value - finer.taylor(part, at).value).abs()
        });
        differences.sum()
    });
    // the parts of a cell are together, and of one size
    let parts: Vec<_> = refined.pieces.iter().zip(differences).collect();
    let groups: Vec<_> = parts.chunk_by(|one, next| one.0.parent == next.0.parent).collect();
    let mean = |group: &&[(_, f64)]| {
        group.iter().map(|(_, number)| number).sum::<f64>() / group.len() as f64
    };
    groups.par_iter().map(mean).collect()
}
