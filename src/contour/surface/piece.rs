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

/// The error of de Casteljau's algorithm, as a part of the largest coefficient.
const NOISE: f64 = 32.0 * f64::EPSILON;

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

    /// What is known of the surface in this piece.
    pub fn certificate(&self, cell: &Cell) -> PatchCertificate {
        let here = self.cubic(cell);
        match here.patch_certificate(self.signs) {
            // all rays meet the surface where they begin, or in a wall
            PatchCertificate::Empty if self.is_opposed(cell, &here) => PatchCertificate::Patch,
            certificate => certificate,
        }
    }

    /// The cubic on this piece; what rounding alone keeps from the level is zero.
    fn cubic(&self, cell: &Cell) -> TetrahedronCubic {
        if self.depth == 0 {
            return cell.cubic;
        }
        let noise = noise(&cell.cubic);
        let here = cell.cubic.sub_tetrahedron(&self.at);
        TetrahedronCubic::new(here.coefficients.map(|c| if c.abs() <= noise { 0.0 } else { c }))
    }

    /// Whether a vertex counts as on the other side than the cubic on the piece, which is of
    /// one sign: a neighbour, where the cubic is not, then has a surface on their common face.
    fn is_opposed(&self, cell: &Cell, here: &TetrahedronCubic) -> bool {
        let (low, high) = here.bounds();
        let side = if low < 0.0 || high > 0.0 { Sign::of(low) } else { self.signs[0] };
        (0..4).any(|n| self.signs[n] != side && cell.has_side(&self.at[n]))
    }

    /// Whether sheets may meet in a vertex: it lies on the level, and the slope there is zero.
    pub fn has_singular_vertex(&self, cell: &Cell) -> bool {
        let noise = noise(&cell.cubic);
        let is_flat = |at: &Barycentric4| {
            let slopes = cell.cubic.barycentric_gradient(at);
            slopes.iter().all(|slope| (slope - slopes[0]).abs() <= STEEP * noise)
        };
        self.at.iter().any(|at| cell.cubic.value(at).abs() <= noise && is_flat(at))
    }

    /// Whether an edge lies on the level as a whole, to rounding.
    pub fn has_edge_on_level(&self, cell: &Cell) -> bool {
        let noise = noise(&cell.cubic);
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

/// Values no larger than this may be rounding alone.
fn noise(cubic: &TetrahedronCubic) -> f64 {
    let (low, high) = cubic.bounds();
    NOISE * high.max(-low)
}
