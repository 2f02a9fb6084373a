//! How fine a surface may be for a number of triangles (thesis, section 5.3.2).
//!
//! The thesis can only estimate how many triangles there will be before it draws them. Here
//! the pieces are known by then, and each has a known number (its table 5.9).

use super::flat_faces::flat_faces;
use super::piece::Piece;
use super::settle::settle;
use super::{cells_at, first_new_vertex, sorted_without_simple};
use crate::bernstein::Sign;
use crate::contour::CellRanges;
use crate::interpolant::TetrahedronCubics;

/// More points a side would be a mistake: a patch has a million triangles then.
pub const MOST_POINTS: u32 = 1025;

/// The greatest number of points on each side of a patch with which the surfaces at all
/// levels together have at most so many triangles; two if even that is too fine.
pub fn points_per_side_within(
    interpolant: &dyn TetrahedronCubics,
    ranges: &CellRanges,
    levels: &[f64],
    triangles: usize,
) -> u32 {
    let of_level = |&level: &f64| {
        let sorted = |band| sorted_without_simple(interpolant, ranges, band);
        let (_, mut cells) = cells_at(interpolant, ranges, level, sorted);
        let settled = settle(&mut cells, first_new_vertex(interpolant), |_, _| {});
        let pieces = settled.pieces.iter();
        let drawn = pieces.filter(|piece| !piece.is_collapsed(&cells[piece.cell as usize]));
        let of_patches: usize = drawn.map(triangles_of).sum();
        of_patches + flat_faces(&cells).count()
    };
    let coarsest: usize = levels.iter().map(of_level).sum();
    let fits = |points: &u32| coarsest * (*points as usize - 1).pow(2) <= triangles;
    (2..=MOST_POINTS).take_while(fits).last().unwrap_or(2)
}

/// The triangles of a piece with two points a side.
fn triangles_of(piece: &Piece) -> usize {
    match piece.signs.iter().filter(|&&sign| sign == Sign::Above).count() {
        1 | 3 => 1,
        2 => 2,
        _ => 0,
    }
}
