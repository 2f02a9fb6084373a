//! A tetrahedral piece of a cell.

use arrayvec::ArrayVec;

use super::cell::Cell;
use crate::bernstein::{
    Barycentric4, PatchCertificate, SegmentCubic, Sign, TetrahedronCubic, vertices,
};
use crate::contour::crossings::MAX_CROSSINGS;

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
    /// Whether its surface is known to be one simple patch.
    pub is_certified: bool,
}

/// The six edges of a tetrahedron, by its vertices in order.
pub const EDGES: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// Slopes along the edges of a cell are no steeper than this many times its range.
const STEEP: f64 = 6.0;

impl Piece {
    /// The whole of a cell; `place` is the cell's among those that are active.
    pub fn whole(cell: &Cell, place: u32) -> Self {
        Self {
            cell: place,
            vertices: cell.points,
            at: vertices(),
            signs: vertices().map(|at| cell.sign(&at)),
            right_handed: cell.right_handed,
            depth: 0,
            is_certified: false,
        }
    }

    /// What is known of the surface in this piece; nothing if there is none, nor will be when
    /// neighbours divide it.
    ///
    /// A piece that rounding alone could take to the other side stays: if neighbours divide its
    /// edges, the new vertices may count as there, and then their surface ends in this piece.
    pub fn certificate(&self, cell: &Cell) -> Option<PatchCertificate> {
        if self.depth == 0 {
            return is_near_level(&cell.cubic, cell.noise)
                .then(|| cell.cubic.patch_certificate(self.signs));
        }
        let here = cell.cubic.sub_tetrahedron(&self.at);
        is_near_level(&here, cell.noise)
            .then(|| without_rounding(&here, cell.noise).patch_certificate(self.signs))
    }

    /// Whether vertices count as on both sides: else nothing of the surface is drawn.
    pub fn is_cut(&self) -> bool {
        self.signs.iter().any(|&sign| sign != self.signs[0])
    }

    /// Whether the patch falls together in a vertex or an edge on the level, or in a face that is
    /// drawn by itself.
    pub fn is_collapsed(&self, cell: &Cell) -> bool {
        let above = || (0..4).filter(|&n| self.signs[n] == Sign::Above).map(|n| &self.at[n]);
        let in_flat_face = |face: usize| cell.flat[face] && above().all(|at| at[face] == 0.0);
        let ends = above().count() < 3 || (0..4).any(in_flat_face);
        ends && !above().any(|at| cell.has_side(at))
    }

    /// Whether sheets may meet in a vertex: it lies on the level, and the slope there is zero.
    pub fn has_singular_vertex(&self, cell: &Cell) -> bool {
        let noise = cell.noise;
        let is_flat = |at: &Barycentric4| {
            let slopes = cell.cubic.barycentric_gradient(at);
            slopes.iter().all(|slope| (slope - slopes[0]).abs() <= STEEP * noise)
        };
        self.at.iter().any(|at| cell.cubic.value(at).abs() <= noise && is_flat(at))
    }

    /// Whether an edge lies on the level as a whole, to rounding.
    pub fn has_edge_on_level(&self, cell: &Cell) -> bool {
        let noise = cell.noise;
        let is_on_level = |edge: &[usize; 2]| {
            self.line(cell, *edge).coefficients.iter().all(|c| c.abs() <= noise)
        };
        EDGES.iter().any(is_on_level)
    }

    /// The cubic on an edge, from its vertex of lower number to the other: the same bits in
    /// all pieces that share the edge.
    pub fn line(&self, cell: &Cell, [low, high]: [usize; 2]) -> SegmentCubic {
        cell.cubic.restrict(&self.at[low], &self.at[high])
    }

    /// Where the surface crosses an edge; the same bits in all pieces that share it.
    pub fn edge_crossings(&self, cell: &Cell, edge: [usize; 2]) -> ArrayVec<f64, MAX_CROSSINGS> {
        cell.crossings(edge.map(|n| &self.at[n]), edge.map(|n| self.signs[n]))
    }
}

/// Whether a cubic is zero somewhere, or would be if it were changed as much as rounding does.
fn is_near_level(cubic: &TetrahedronCubic, noise: f64) -> bool {
    let (low, high) = cubic.bounds();
    low <= noise && high >= -noise
}

/// A cubic of which what may be rounding alone is zero.
fn without_rounding(cubic: &TetrahedronCubic, noise: f64) -> TetrahedronCubic {
    TetrahedronCubic::new(cubic.coefficients.map(|c| if c.abs() <= noise { 0.0 } else { c }))
}
