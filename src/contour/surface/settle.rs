//! From active cells to pieces with one simple patch each.

use rayon::prelude::*;

use super::cell::Cell;
use super::division::{Marks, mark};
use super::piece::Piece;
use crate::bernstein::PatchCertificate;
use crate::interruption::checkpoint;

/// The pieces that hold a patch.
#[derive(Debug, Default)]
pub struct Settled {
    /// The pieces, in the order of their cells.
    pub pieces: Vec<Piece>,
    /// Cells that were divided.
    pub divided: usize,
    /// Pieces whose surface could not be certified before the limit.
    pub unresolved: usize,
}

/// Divisions of a piece beyond which it is left unresolved. Three halve its size, so it is
/// then some 2⁻³² of its cell: coefficients that far apart differ by rounding alone.
const MAX_DEPTH: u16 = 96;

/// The same for a piece with a vertex in which sheets may meet, which is then 1/256 of its
/// cell: every smaller piece looks alike.
const MAX_DEPTH_AT_VERTEX: u16 = 24;

/// The same for a piece with an edge on the level, which is then 1/16 of its cell: where
/// sheets meet in an edge every smaller piece looks alike, and there are ever more of them.
const MAX_DEPTH_AT_EDGE: u16 = 12;

/// Pieces of a cell beyond which they are left unresolved. A surface that can be
/// certified needs some tens; only one that is double along a curve, or nearly so, asks
/// for more.
const MAX_PIECES: usize = 4096;

/// Pieces of all cells together beyond which cells are left with less of them,
/// [`MAX_PIECES_OF_MANY`]: a surface that is double everywhere would fill the memory.
const MANY: usize = 1 << 22;

/// Pieces of a cell beyond which they are left unresolved, if there are many in all.
const MAX_PIECES_OF_MANY: usize = 64;

/// A piece and what is known of it.
struct Known {
    piece: Piece,
    certificate: PatchCertificate,
    /// Whether it may be divided further.
    is_divisible: bool,
}

/// Divides the cells until each piece holds one simple patch or none. `points` is the
/// number of the mesh's points: vertices that divisions add are numbered from there. Cells that
/// need not be divided for their own sake may wait outside; `wake` is told the marked edges, and
/// adds those that have one to the cells.
pub fn settle(
    cells: &mut Vec<Cell>,
    points: u32,
    mut wake: impl FnMut(&Marks, &mut Vec<Cell>),
) -> Settled {
    // cell by cell, so that what no division touches stays where it is
    let numbers = (0..cells.len()).into_par_iter();
    let mut pieces: Vec<Vec<Known>> = numbers.map(|number| whole(cells, number)).collect();
    let mut next_vertex = points;
    loop {
        let marks = Marks::new(marked(cells, &pieces), next_vertex);
        if marks.len() == 0 {
            return settled(pieces);
        }
        next_vertex += marks.len() as u32;
        wake(&marks, cells);
        pieces.extend((pieces.len()..cells.len()).map(|number| whole(cells, number)));
        pieces.par_iter_mut().zip(&*cells).for_each(|(pieces, cell)| {
            checkpoint();
            divide(cell, &marks, pieces);
        });
    }
}

/// A cell as one piece; none if no surface can be there.
fn whole(cells: &[Cell], number: usize) -> Vec<Known> {
    let cell = &cells[number];
    known(cell, Piece::whole(cell, number as u32)).into_iter().collect()
}

/// What is known of a piece; nothing if no surface can be there.
fn known(cell: &Cell, piece: Piece) -> Option<Known> {
    let certificate = piece.certificate(cell)?;
    let undecided = certificate == PatchCertificate::None;
    let is_divisible = undecided && piece.depth < deepest(&piece, cell);
    Some(Known { piece, certificate, is_divisible })
}

/// The divisions that a piece may have come of, and be divided again.
fn deepest(piece: &Piece, cell: &Cell) -> u16 {
    if piece.has_edge_on_level(cell) {
        MAX_DEPTH_AT_EDGE
    } else if piece.has_singular_vertex(cell) {
        MAX_DEPTH_AT_VERTEX
    } else {
        MAX_DEPTH
    }
}

/// The edges that undecided pieces want to be divided, unless these are at a limit. `pieces` are
/// those of each cell.
fn marked(cells: &[Cell], pieces: &[Vec<Known>]) -> Vec<([u32; 2], f64)> {
    let all: usize = pieces.iter().map(Vec::len).sum();
    let most = if all < MANY { MAX_PIECES } else { MAX_PIECES_OF_MANY };
    let of_cells = pieces.par_iter().zip(cells).filter(|(pieces, _)| pieces.len() < most);
    of_cells
        .flat_map_iter(|(pieces, cell)| {
            let divisible = pieces.iter().filter(|known| known.is_divisible);
            divisible.map(|known| mark(&known.piece, cell))
        })
        .collect()
}

/// Divides those pieces of a cell that have a marked edge.
fn divide(cell: &Cell, marks: &Marks, pieces: &mut Vec<Known>) {
    if !pieces.iter().any(|known| marks.touch(&known.piece)) {
        return;
    }
    let mut parts = Vec::new();
    for before in std::mem::take(pieces) {
        if marks.touch(&before.piece) {
            marks.divide(before.piece, cell, &mut parts);
            pieces.extend(parts.drain(..).filter_map(|part| known(cell, part)));
        } else {
            pieces.push(before);
        }
    }
}

fn settled(pieces: Vec<Vec<Known>>) -> Settled {
    let mut settled = Settled::default();
    for of_cell in pieces {
        let mut is_divided = false;
        for Known { piece, certificate, .. } in of_cell {
            let is_certified = certificate != PatchCertificate::None;
            // else only neighbours had to be
            is_divided |= piece.depth > 0 && (piece.is_cut() || !is_certified);
            settled.unresolved += usize::from(!is_certified);
            if piece.is_cut() {
                settled.pieces.push(Piece { is_certified, ..piece });
            }
        }
        settled.divided += usize::from(is_divided);
    }
    settled
}
