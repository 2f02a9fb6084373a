//! From active cells to pieces with one simple patch each.

use rayon::iter::Either;
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

/// Pieces of a cell beyond which they are left unresolved. A surface that can be
/// certified needs some tens; only one that is double along a curve, or nearly so, asks
/// for more.
const MAX_PIECES: usize = 4096;

/// A piece and what is known of it.
struct Known {
    piece: Piece,
    certificate: PatchCertificate,
}

/// Divides the cells until each piece holds one simple patch or none. `points` is the
/// number of the mesh's points: vertices that divisions add are numbered from there.
pub fn settle(cells: &[Cell], points: u32) -> Settled {
    let whole = (0..cells.len() as u32).into_par_iter();
    let mut pieces: Vec<Known> = whole
        .map(|place| Piece::whole(&cells[place as usize], place))
        .map(|piece| known(cells, piece))
        .filter(holds_something)
        .collect();
    let mut next_vertex = points;
    loop {
        let marks = Marks::new(marked(cells, &pieces), next_vertex);
        if marks.len() == 0 {
            return settled(cells.len(), pieces);
        }
        next_vertex += marks.len() as u32;
        pieces = pieces
            .into_par_iter()
            .inspect(|_| checkpoint())
            .flat_map_iter(|known| divided(cells, &marks, known))
            .filter(holds_something)
            .collect();
    }
}

fn known(cells: &[Cell], piece: Piece) -> Known {
    let certificate = piece.certificate(&cells[piece.cell as usize]);
    Known { piece, certificate }
}

fn holds_something(known: &Known) -> bool {
    known.certificate != PatchCertificate::Empty
}

/// The edges that undecided pieces want to be divided, unless these are at a limit.
fn marked(cells: &[Cell], pieces: &[Known]) -> Vec<([u32; 2], f64)> {
    // pieces of a cell stand together
    let groups: Vec<&[Known]> = pieces.chunk_by(|a, b| a.piece.cell == b.piece.cell).collect();
    let marks = groups.into_par_iter().filter(|group| group.len() < MAX_PIECES);
    marks
        .flat_map_iter(|group| group.iter().filter(|known| is_undecided(known)))
        .map(|known| mark(&known.piece, &cells[known.piece.cell as usize]))
        .collect()
}

fn is_undecided(known: &Known) -> bool {
    known.certificate == PatchCertificate::None && known.piece.depth < MAX_DEPTH
}

/// The parts of a piece, or the piece itself if no edge of it is marked.
fn divided(cells: &[Cell], marks: &Marks, known: Known) -> impl Iterator<Item = Known> {
    if !marks.touch(&known.piece) {
        return Either::Left(std::iter::once(known));
    }
    let mut parts = Vec::new();
    let cell = &cells[known.piece.cell as usize];
    marks.divide(known.piece, cell, &mut parts);
    Either::Right(parts.into_iter().map(|part| self::known(cells, part)))
}

fn settled(cells: usize, pieces: Vec<Known>) -> Settled {
    let mut divided = vec![false; cells];
    let mut settled = Settled::default();
    for Known { piece, certificate } in pieces {
        divided[piece.cell as usize] |= piece.depth > 0;
        settled.unresolved += usize::from(certificate == PatchCertificate::None);
        settled.pieces.push(piece);
    }
    settled.divided = divided.into_iter().filter(|divided| *divided).count();
    settled
}
