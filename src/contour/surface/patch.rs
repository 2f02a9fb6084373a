//! Stage three: the surface in a piece, ray by ray (thesis, section 2.4.3).
//!
//! The vertices above the level and those below are two groups. Rays run from one group
//! to the other; each crosses the surface once, so a ray is the parameter of its crossing:
//! four weights, which sum to one in each group. With three and one vertices these are the
//! thesis' lines from the apex to the base, with two and two its lines from edge to edge.
//! On a face they are the same in both cases: from the vertex that is alone on its side to
//! the edge opposite. So patches meet in the faces of their pieces.

use arrayvec::ArrayVec;

use super::cell::Cell;
use super::owner::Owner;
use super::piece::Piece;
use crate::bernstein::{Barycentric4, Sign, between};
use crate::mesh::Vector;

/// A ray: weights of the piece's vertices, which sum to one over those above the level
/// and over those below.
pub type Ray = [f64; 4];

/// A point of the surface.
#[derive(Clone, Copy, Debug)]
pub struct PatchPoint {
    /// Who owns it.
    pub owner: Owner,
    /// Where in the cell.
    pub at: Barycentric4,
    /// Where in space.
    pub position: Vector,
}

/// The surface in a piece.
#[derive(Clone, Copy, Debug)]
pub struct Patch<'a> {
    /// The cell.
    pub cell: &'a Cell,
    /// The piece.
    pub piece: &'a Piece,
}

/// The vertices of one side, by their places in the piece.
type Group = ArrayVec<usize, 4>;

/// A crossing this near to the end of its ray, as a part of the ray, is the end: rounding
/// alone keeps it away, and triangles between the two would have no area.
const AT_END: f64 = 64.0 * f64::EPSILON;

impl Patch<'_> {
    /// Where a ray crosses the surface.
    pub fn point(&self, ray: &Ray) -> PatchPoint {
        let (from, to) = self.ends(ray);
        let (start, end) = (self.weighted(&from, ray), self.weighted(&to, ray));
        let sides = [from[0], to[0]].map(|n| self.piece.signs[n]);
        let found = self.cell.crossings([&start, &end], sides);
        // one, if the piece is certified; of three in one that is not, the middle one
        let t = found.get(found.len() / 2).copied().unwrap_or(0.5);
        let (owner, t) = if t <= AT_END {
            (self.owner_of_end(&from, ray), 0.0)
        } else if t >= 1.0 - AT_END {
            (self.owner_of_end(&to, ray), 1.0)
        } else {
            (self.owner_of_crossing(&from, &to, ray), t)
        };
        let at = between(&start, &end, t);
        PatchPoint { owner, at, position: self.cell.position(&at) }
    }

    /// The groups of vertices between which a ray runs: on a face, from the vertex alone on
    /// its side; on an edge, from the vertex of lower number. Neighbours agree on both.
    fn ends(&self, ray: &Ray) -> (Group, Group) {
        let held = |side: Sign| -> Group {
            (0..4).filter(|&n| ray[n] != 0.0 && self.piece.signs[n] == side).collect()
        };
        let (above, below) = (held(Sign::Above), held(Sign::Below));
        let above_first = match above.len().cmp(&below.len()) {
            std::cmp::Ordering::Less => true,
            std::cmp::Ordering::Greater => false,
            std::cmp::Ordering::Equal => above[0] < below[0],
        };
        if above_first { (above, below) } else { (below, above) }
    }

    /// The point of the cell that a group's weights stand for.
    fn weighted(&self, group: &Group, ray: &Ray) -> Barycentric4 {
        if let [only] = group[..] {
            return self.piece.at[only];
        }
        let mut point = [0.0; 4];
        for &vertex in group {
            for (sum, weight) in point.iter_mut().zip(self.piece.at[vertex]) {
                *sum += ray[vertex] * weight;
            }
        }
        point
    }

    fn owner_of_end(&self, group: &Group, ray: &Ray) -> Owner {
        let vertex = |n: usize| self.piece.vertices[n];
        match group[..] {
            [only] => Owner::Vertex(vertex(only)),
            [low, high] => {
                Owner::OnEdge { low: vertex(low), high: vertex(high), weight: ray[high].to_bits() }
            }
            [a, b, c] => Owner::OnFace {
                vertices: [a, b, c].map(vertex),
                weights: [b, c].map(|n| ray[n].to_bits()),
            },
            _ => Owner::Patch,
        }
    }

    fn owner_of_crossing(&self, from: &Group, to: &Group, ray: &Ray) -> Owner {
        let vertex = |n: usize| self.piece.vertices[n];
        match (&from[..], &to[..]) {
            (&[from], &[to]) => Owner::Edge { low: vertex(from), high: vertex(to) },
            (&[apex], &[low, high]) => Owner::Face {
                apex: vertex(apex),
                low: vertex(low),
                high: vertex(high),
                weight: ray[high].to_bits(),
            },
            _ => Owner::Patch,
        }
    }
}
