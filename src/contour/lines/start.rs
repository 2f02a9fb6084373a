//! A cell as the first piece: its crossings with the edges of the mesh.
//!
//! Edges that lie wholly on the level are lines of the contour themselves
//! ([`FlatEdge`]). The cubic of their cell is divided by them, and what is left
//! is traced as any other piece: so a nodal line that runs into a boundary on
//! which the solution is zero ends there, instead of turning along it.

use super::crossing::{Crossing, Owner};
use super::piece::{Cell, EdgeCrossing, EdgeCrossings, Piece};
use crate::bernstein::{Sign, TriangleCubic, vertices};
use crate::contour::crossings::crossings;
use crate::mesh::{TriangleFrame, Vector};

/// An edge of the mesh that lies wholly on the level, seen from one of its cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FlatEdge {
    /// The edge's point of lower number.
    pub low: u32,
    /// The edge's point of higher number.
    pub high: u32,
    /// Whether the whole cell lies on the level.
    pub in_flat_cell: bool,
    /// The cell.
    pub cell: u32,
    /// Whether the higher side is on the left of the way from `low` to `high`, as far
    /// as this cell knows: by its value beside the edge's middle.
    pub low_to_high: bool,
}

/// The edges of a cell that lie on the level. `cubic` is the cell's, less the level.
pub fn flat_edges(cell: u32, points: [u32; 3], cubic: &TriangleCubic) -> Vec<FlatEdge> {
    let in_flat_cell = cubic.coefficients == [0.0; 10];
    let zero = cubic.zero_sides();
    (0..3)
        .filter(|&edge| zero[edge])
        .map(|edge| {
            let (a, b) = (points[(edge + 1) % 3], points[(edge + 2) % 3]);
            // the cell is on the left of its own edges
            let low_to_high = (a < b) == (slope_beside(cubic, edge) >= 0.0);
            FlatEdge { low: a.min(b), high: a.max(b), in_flat_cell, cell, low_to_high }
        })
        .collect()
}

/// On which side of zero a cubic is beside the middle of an edge on which it is zero:
/// positive above, negative below.
pub fn slope_beside(cubic: &TriangleCubic, edge: usize) -> f64 {
    let mut middle = [0.5; 3];
    middle[edge] = 0.0;
    cubic.without_zero_sides().value(&middle)
}

/// The whole cell as a piece. `whole` is its cubic less the level; `cell.cubic`
/// is the same, divided by the edges that lie on the level.
pub fn first_piece(cell: &mut Cell, whole: &TriangleCubic, points: [u32; 3]) -> Piece {
    let flat = whole.zero_sides();
    let mut edges = [0, 1, 2].map(|edge| {
        if flat[edge] {
            EdgeCrossings::new()
        } else {
            edge_crossings(cell, whole, edge, flat, points)
        }
    });
    let signs = corner_signs(whole, cell.cubic, flat, &edges);
    for edge in (0..3).filter(|&edge| flat[edge]) {
        edges[edge] = crossings_of_flat_edge(cell, edge, signs, points);
    }
    Piece { corners: vertices(), signs, cubic: *cell.cubic, edges, depth: 0 }
}

/// The crossings on an edge, found in the direction from its point of lower
/// number, which both its cells share.
///
/// Where a corner lies on a flat edge, the crossing at that corner belongs to the
/// flat edge and is left out.
fn edge_crossings(
    cell: &mut Cell,
    whole: &TriangleCubic,
    edge: usize,
    flat: [bool; 3],
    points: [u32; 3],
) -> EdgeCrossings {
    let (start, end) = ((edge + 1) % 3, (edge + 2) % 3);
    let forward = points[start] < points[end];
    let cubic = if forward { whole.edge(edge) } else { whole.edge(edge).reversed() };
    let (from, to) = if forward { (start, end) } else { (end, start) };
    let [first, .., last] = cubic.coefficients;
    let on_flat_edge = |corner: usize| (0..3).any(|other| flat[other] && other != corner);
    let mut found = EdgeCrossings::new();
    let mut place = 0;
    for t in crossings(&cubic, Sign::of(first), Sign::of(last)) {
        let (low, high) = (points[from], points[to]);
        let owner = match t {
            0.0 => Owner::Point(low),
            1.0 => Owner::Point(high),
            _ => Owner::Edge { low, high, place },
        };
        place += u8::from(matches!(owner, Owner::Edge { .. }));
        let divided_out = (t == 0.0 && on_flat_edge(from)) || (t == 1.0 && on_flat_edge(to));
        if !divided_out {
            let position = along_edge(cell.frame, from, to, t);
            let mut at = [0.0; 3];
            (at[from], at[to]) = (1.0 - t, t);
            let crossing = cell.add(Crossing { owner, at, position });
            found.push(EdgeCrossing { t: if forward { t } else { 1.0 - t }, crossing });
        }
    }
    if !forward {
        found.reverse();
    }
    found
}

/// The point of an edge at `t`; exactly the corner at either end.
fn along_edge(frame: &TriangleFrame, from: usize, to: usize, t: f64) -> Vector {
    frame.corners()[from] * (1.0 - t) + frame.corners()[to] * t
}

/// The sides on which the corners lie: by their values, or, for corners on a flat
/// edge, as the crossings of the other edges demand.
fn corner_signs(
    whole: &TriangleCubic,
    divided: &TriangleCubic,
    flat: [bool; 3],
    edges: &[EdgeCrossings; 3],
) -> [Sign; 3] {
    let mut signs = whole.vertices().map(Sign::of);
    let count = flat.iter().filter(|&&flat| flat).count();
    let flip = |sign: Sign, edge: usize| if edges[edge].len() % 2 == 0 { sign } else { !sign };
    if count == 1 {
        let apex = (0..3).find(|&edge| flat[edge]).unwrap_or(0);
        let (next, last) = ((apex + 1) % 3, (apex + 2) % 3);
        // edge `last` joins the apex and corner `next`, edge `next` the apex and `last`
        signs[next] = flip(signs[apex], last);
        signs[last] = flip(signs[apex], next);
    } else if count >= 2 {
        signs = divided.vertices().map(Sign::of);
        if let Some(edge) = (0..3).find(|&edge| !flat[edge]) {
            let (start, end) = ((edge + 1) % 3, (edge + 2) % 3);
            signs[start] = whole.edge(edge).roots().after_start();
            signs[end] = flip(signs[start], edge);
        }
    }
    signs
}

/// Where the rest of the contour meets a flat edge. At an end of the edge that is
/// a point of the mesh; between, the cell's own.
fn crossings_of_flat_edge(
    cell: &mut Cell,
    edge: usize,
    signs: [Sign; 3],
    points: [u32; 3],
) -> EdgeCrossings {
    let (start, end) = ((edge + 1) % 3, (edge + 2) % 3);
    let found = crossings(&cell.cubic.edge(edge), signs[start], signs[end]);
    found
        .into_iter()
        .map(|t| {
            let owner = match t {
                0.0 => Owner::Point(points[start]),
                1.0 => Owner::Point(points[end]),
                _ => cell.next_owner(),
            };
            let mut at = [0.0; 3];
            (at[start], at[end]) = (1.0 - t, t);
            let position = along_edge(cell.frame, start, end, t);
            EdgeCrossing { t, crossing: cell.add(Crossing { owner, at, position }) }
        })
        .collect()
}
