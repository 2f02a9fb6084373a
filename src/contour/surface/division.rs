//! Stage two: pieces that are in no desired situation are divided until they are
//! (thesis, section 2.4.2).
//!
//! The thesis' desired situations, three or four crossings on as many edges, are those
//! that [`PatchCertificate`] can certify; it does so exactly, where counting crossings
//! would miss what is hidden inside a face or a cell. Its rules say which piece to
//! divide; here a piece only *marks* an edge, and all pieces around a marked edge are
//! divided there, in the order of the edges' numbers. So neighbours cut their common
//! face alike, and the surface stays closed:
//!
//! | thesis' case | here |
//! |---|---|
//! | two or more intersections on one edge | the same, but in the middle between two of them |
//! | no intersection, a component inside | of its long edges that along which the cubic bends most, in its middle |
//! | three or four, but not certified | the same |
//!
//! The thesis divides a piece with a component inside in four, at an extreme. Bisection
//! finds the component as surely, without a point that comes near to a face.

use rustc_hash::FxHashMap;

use super::cell::Cell;
use super::piece::{EDGES, Piece};
use crate::bernstein::{Barycentric4, SegmentCubic, Sign, between};

/// An edge of a piece, by the numbers of its vertices, the lower first.
pub type EdgeName = [u32; 2];

/// A point that divides an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgePoint {
    /// Its number as a vertex.
    pub vertex: u32,
    /// Where on the edge, from the vertex of lower number.
    pub t: f64,
}

/// The edges that are divided in one round.
#[derive(Debug, Default)]
pub struct Marks(FxHashMap<EdgeName, EdgePoint>);

/// A division nearer to a vertex than this would make slivers.
const NEAREST: f64 = 0.2;

/// Edges no shorter than this part of the longest may be divided. Dividing shorter ones
/// would make slivers: where the cubic is a saddle, ever longer ones.
const LONG: f64 = 0.7;

/// The edge by which a piece wants to be divided, and where. The place depends on the
/// edge alone, so that all who mark an edge agree.
pub fn mark(piece: &Piece, cell: &Cell) -> (EdgeName, f64) {
    let lengths = EDGES.map(|[low, high]| length(&piece.at[low], &piece.at[high]));
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    let long = (0..6).filter(|&n| lengths[n] >= LONG * longest);
    let bend_of = |n: usize| bend(&piece.line(cell, EDGES[n]));
    let most = long.max_by(|&n, &m| bend_of(n).total_cmp(&bend_of(m))).unwrap_or(0);
    let edge = EDGES[most];
    (edge.map(|n| piece.vertices[n]), division_point(&piece.edge_crossings(cell, edge)))
}

/// The length of an edge if the cell were regular: then no shape of the cell matters.
fn length(a: &Barycentric4, b: &Barycentric4) -> f64 {
    a.iter().zip(b).map(|(a, b)| (b - a).powi(2)).sum::<f64>().sqrt()
}

/// How far a cubic is from a linear function, by its second differences.
fn bend(line: &SegmentCubic) -> f64 {
    let [a, b, c, d] = line.coefficients;
    (a - 2.0 * b + c).abs().max((b - 2.0 * c + d).abs())
}

/// In the middle of the widest gap between crossings, or of the edge.
fn division_point(crossings: &[f64]) -> f64 {
    let gaps = crossings.windows(2).map(|pair| (pair[0], pair[1]));
    let widest = gaps.max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)));
    let middle = widest.map_or(0.5, |(start, end)| 0.5 * (start + end));
    if (NEAREST..=1.0 - NEAREST).contains(&middle) { middle } else { 0.5 }
}

impl Marks {
    /// Gives each marked edge a vertex, numbered from `first` on.
    pub fn new(mut marked: Vec<(EdgeName, f64)>, first: u32) -> Self {
        marked.sort_unstable_by_key(|(edge, _)| *edge);
        marked.dedup_by_key(|(edge, _)| *edge);
        let numbered = marked.into_iter().zip(first..);
        Self(numbered.map(|((edge, t), vertex)| (edge, EdgePoint { vertex, t })).collect())
    }

    /// How many edges there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// The edges.
    pub fn edges(&self) -> impl Iterator<Item = EdgeName> {
        self.0.keys().copied()
    }

    /// Whether an edge between some vertices, which are ascending, is marked.
    pub fn touch_edges_of(&self, vertices: &[u32; 4]) -> bool {
        EDGES.iter().any(|edge| self.0.contains_key(&edge.map(|n| vertices[n])))
    }

    /// The marked edge of a piece that comes first, as places of its vertices.
    fn first_of(&self, piece: &Piece) -> Option<([usize; 2], EdgePoint)> {
        let marked = EDGES.into_iter().filter_map(|edge| {
            let name = edge.map(|n| piece.vertices[n]);
            self.0.get(&name).map(|&point| (edge, point))
        });
        // vertices are numbered in the order of their edges
        marked.min_by_key(|(_, point)| point.vertex)
    }

    /// Whether a piece has a marked edge.
    pub fn touch(&self, piece: &Piece) -> bool {
        self.touch_edges_of(&piece.vertices)
    }

    /// Divides a piece by all its marked edges.
    pub fn divide(&self, piece: Piece, cell: &Cell, parts: &mut Vec<Piece>) {
        let Some(([low, high], point)) = self.first_of(&piece) else {
            parts.push(piece);
            return;
        };
        let at = between(&piece.at[low], &piece.at[high], point.t);
        let sign = cell.sign(&at);
        for replaced in [high, low] {
            let part = with_vertex(&piece, replaced, point.vertex, at, sign);
            self.divide(part, cell, parts);
        }
    }
}

/// The piece with one vertex replaced by a new one, whose number is the greatest.
fn with_vertex(piece: &Piece, replaced: usize, vertex: u32, at: Barycentric4, sign: Sign) -> Piece {
    let mut part = piece.clone();
    part.vertices[replaced] = vertex;
    part.at[replaced] = at;
    part.signs[replaced] = sign;
    part.vertices[replaced..].rotate_left(1);
    part.at[replaced..].rotate_left(1);
    part.signs[replaced..].rotate_left(1);
    // each exchange of neighbours on the way to the end turns the order over
    let exchanges = 3 - replaced;
    part.right_handed = piece.right_handed == exchanges.is_multiple_of(2);
    part.depth = piece.depth + 1;
    part
}
