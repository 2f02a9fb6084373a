//! Where a cubic is further from linear than a tolerance.
//!
//! Between a part of a cubic and the linear function of its corner values lies no more
//! than between their Bernstein coefficients: so a part of which no coefficient is
//! further away than the tolerance is linear as far as that goes, with certainty.

use crate::bernstein::{SegmentCubic, TetrahedronCubic, TriangleCubic};
use crate::mesh::{PieceEdge, RefinedPiece, Vector, piece_edges};

/// The edges along which a part of a cubic is bent by more than `tolerance`; the longest
/// if there is none and the part is bent inside; none if it is not. `points` are those of
/// the refined mesh.
pub fn bent_edges_of_triangle(
    cubic: &TriangleCubic,
    piece: &RefinedPiece<3>,
    points: &[Vector],
    tolerance: f64,
) -> Vec<PieceEdge> {
    let part = cubic.sub_triangle(&piece.at);
    let straight = TriangleCubic::linear(part.vertices());
    let edge = |[i, j]: PieceEdge| part.edge(3 - i - j);
    chosen(piece, points, tolerance, edge, greatest(&part.coefficients, &straight.coefficients))
}

/// The same in a tetrahedron.
pub fn bent_edges_of_tetrahedron(
    cubic: &TetrahedronCubic,
    piece: &RefinedPiece<4>,
    points: &[Vector],
    tolerance: f64,
) -> Vec<PieceEdge> {
    let part = cubic.sub_tetrahedron(&piece.at);
    let straight = TetrahedronCubic::linear(part.vertices());
    let edge = |edge: PieceEdge| part.edge(edge);
    chosen(piece, points, tolerance, edge, greatest(&part.coefficients, &straight.coefficients))
}

fn chosen<const CORNERS: usize>(
    piece: &RefinedPiece<CORNERS>,
    points: &[Vector],
    tolerance: f64,
    edge: impl Fn(PieceEdge) -> SegmentCubic,
    anywhere: f64,
) -> Vec<PieceEdge> {
    if anywhere.is_nan() || anywhere <= tolerance {
        return Vec::new();
    }
    let bent = piece_edges::<CORNERS>().filter(|&corners| bend(&edge(corners)) > tolerance);
    let bent: Vec<PieceEdge> = bent.collect();
    if !bent.is_empty() {
        return bent;
    }
    let length = |edge: &PieceEdge| {
        let [a, b] = edge.map(|corner| points[piece.corners[corner] as usize]);
        (b - a).norm()
    };
    let longest = piece_edges::<CORNERS>().max_by(|a, b| length(a).total_cmp(&length(b)));
    longest.into_iter().collect()
}

/// How far a cubic on an edge is from linear, at most.
fn bend(edge: &SegmentCubic) -> f64 {
    let [start, near, far, end] = edge.coefficients;
    let [near_line, far_line] = [(2.0 * start + end) / 3.0, (start + 2.0 * end) / 3.0];
    (near - near_line).abs().max((far - far_line).abs())
}

fn greatest(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
