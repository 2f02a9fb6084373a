//! A tetrahedral piece of a cell.

use arrayvec::ArrayVec;

use super::cell::Cell;
use crate::bernstein::{
    Barycentric4, PatchCertificate, SegmentCubic, Sign, TetrahedronCubic, vertices,
};
use crate::contour::crossings::{MAX_CROSSINGS, crossings};

/// A piece of a cell: at first the whole cell, later what divisions made of it.
#[derive(Clone, Debug)]
pub struct Piece {
    /// The cell, as a place among those that are active.
    pub cell: u32,
    /// Its vertices, ascending: points of the mesh, then those that divisions added.
    pub vertices: [u32; 4],
    /// Where they are in the cell.
    pub at: [Barycentric4; 4],
    /// On which side of the level each counts.
    pub signs: [Sign; 4],
    /// Whether the vertices, in this order, are those of a right-handed tetrahedron.
    pub right_handed: bool,
    /// How many divisions made this piece.
    pub depth: u16,
}

/// The six edges of a tetrahedron, by its vertices in order.
pub const EDGES: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// The error of de Casteljau's algorithm, as a part of the largest coefficient.
const NOISE: f64 = 32.0 * f64::EPSILON;

impl Piece {
    /// The whole of a cell; `place` is the cell's among those that are active.
    pub fn whole(cell: &Cell, place: u32) -> Self {
        Self {
            cell: place,
            vertices: cell.points,
            at: vertices(),
            signs: cell.cubic.vertices().map(Sign::of),
            right_handed: cell.right_handed,
            depth: 0,
        }
    }

    /// What is known of the surface in this piece.
    pub fn certificate(&self, cell: &Cell) -> PatchCertificate {
        if self.depth == 0 {
            return cell.cubic.patch_certificate(self.signs);
        }
        let (low, high) = cell.cubic.bounds();
        let noise = NOISE * high.max(-low);
        let here = cell.cubic.sub_tetrahedron(&self.at);
        let settled = here.coefficients.map(|c| if c.abs() <= noise { 0.0 } else { c });
        TetrahedronCubic::new(settled).patch_certificate(self.signs)
    }

    /// The cubic on an edge, from its vertex of lower number to the other: the same bits in
    /// all pieces that share the edge.
    pub fn line(&self, cell: &Cell, [low, high]: [usize; 2]) -> SegmentCubic {
        cell.cubic.restrict(&self.at[low], &self.at[high])
    }

    /// Where the surface crosses an edge; the same bits in all pieces that share it.
    pub fn edge_crossings(&self, cell: &Cell, edge: [usize; 2]) -> ArrayVec<f64, MAX_CROSSINGS> {
        let [start, end] = edge.map(|n| self.signs[n]);
        crossings(&self.line(cell, edge), start, end)
    }
}
