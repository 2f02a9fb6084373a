//! The numbers that the cells of pieces have in the whole.

use vtu2contour::vtk::Description;

/// Counts the cells of pieces, one piece after the other.
///
/// The cells of grids follow one another. Those of surfaces do so kind by kind: first come the
/// verts of all pieces, then all lines, polygons and strips.
pub struct CellCounter {
    is_surface: bool,
    /// The number of the next cell of each kind; the cells of grids are of the first.
    next: [usize; 4],
}

/// The numbers that the cells of a piece have in the whole.
pub struct CellNumbers {
    /// The first cell of each kind: its number in the piece, and in the whole.
    first: [[usize; 2]; 4],
}

impl CellCounter {
    /// Before the first piece.
    pub fn new(whole: &Description) -> Self {
        let of_kind = |kind: usize| whole.pieces.iter().map(|piece| piece.kinds()[kind]).sum();
        let totals: [usize; 4] = [0, 1, 2, 3].map(of_kind);
        let next = [0, 1, 2, 3].map(|kind| totals[..kind].iter().sum());
        Self { is_surface: totals != [0; 4], next }
    }

    /// The numbers of the next piece's cells, of which the types are given.
    pub fn count(&mut self, types: &[u8]) -> CellNumbers {
        let mut counts = [0; 4];
        if self.is_surface {
            types.iter().for_each(|&cell_type| counts[kind_of(cell_type)] += 1);
        } else {
            counts[0] = types.len();
        }
        let (mut first, mut in_piece) = ([[0; 2]; 4], 0);
        for (kind, count) in counts.into_iter().enumerate() {
            first[kind] = [in_piece, self.next[kind]];
            in_piece += count;
            self.next[kind] += count;
        }
        CellNumbers { first }
    }
}

/// The kind of a surface's cell as a cell of a grid.
fn kind_of(cell_type: u8) -> usize {
    match cell_type {
        1 | 2 => 0,
        3 | 4 => 1,
        6 => 3,
        _ => 2,
    }
}

impl CellNumbers {
    /// The number in the whole of a cell of the piece.
    pub fn in_whole(&self, cell: i64) -> i64 {
        // kinds without cells begin where the next does
        let kind = self.first.iter().rfind(|[in_piece, _]| *in_piece as i64 <= cell);
        kind.map_or(cell, |[in_piece, in_whole]| cell - *in_piece as i64 + *in_whole as i64)
    }
}
