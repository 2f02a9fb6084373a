//! One cell at one level: from its cubic to the arcs of its contour.

use std::collections::VecDeque;

use arrayvec::ArrayVec;

use super::arc::{Arc, Node};
use super::crossing::{Crossing, Owner};
use super::curve::Resolution;
use super::method::{Method, draw};
use super::piece::{Cell, Piece};
use super::situation::{Division, Situation, situation};
use super::start::{first_piece, flat_edges};
use super::traces::Traces;
use super::walls::Walls;
use crate::bernstein::{Sign, TriangleCubic};
use crate::contour::rounding::Rounding;
use crate::mesh::TriangleFrame;

/// What all cells of a level share.
#[derive(Clone, Copy, Debug)]
pub struct Tracing<'a> {
    /// The level.
    pub level: f64,
    /// How near to the level counts as on it.
    pub rounding: &'a Rounding,
    /// Parts of the boundary that lie on the level.
    pub walls: &'a Walls,
    /// How arcs are drawn.
    pub method: Method,
    /// How finely.
    pub resolution: Resolution,
}

/// Divisions of a piece beyond which it is left unresolved. Most halve an edge, so
/// the piece is then some 2⁻³² of its cell: coefficients that far apart differ by
/// rounding alone.
const MAX_DEPTH: u32 = 64;

/// Pieces of a cell beyond which the rest is left unresolved. A contour that can
/// be settled needs some tens; only one that is double along a whole curve,
/// such as the level 0 of x², asks for so many.
const MAX_PIECES: usize = 4096;

/// Finds the contour in one cell. `points` are the numbers of its corners, and
/// `cubic` is the interpolant there.
pub fn trace(
    tracing: &Tracing,
    cell: u32,
    points: [u32; 3],
    cubic: &TriangleCubic,
    frame: &TriangleFrame,
    traces: &mut Traces,
) {
    let Some((whole, rounding)) = above_level(tracing, points, cubic) else {
        traces.unresolved += 1;
        return;
    };
    let flat = flat_edges(cell, points, &whole);
    traces.flat_edges.extend_from_slice(&flat);
    let divided = if flat.is_empty() { whole } else { whole.without_zero_sides() };
    if divided.coefficients == [0.0; 10] {
        return;
    }
    let mut cell = Cell { number: cell, cubic: &divided, frame, crossings: Vec::new() };
    let first = first_piece(&mut cell, &whole, points);
    trace_pieces(tracing, rounding, &mut cell, first, traces);
}

/// The cubic less the level, and how near to zero its values count as zero.
///
/// Both are divided by a power of two, so that the largest coefficient is near one
/// and no square of a slope leaves the range of floating-point numbers. That
/// changes no bit of where the cubic is zero. Nothing if the difference is no
/// finite number.
fn above_level(
    tracing: &Tracing,
    points: [u32; 3],
    cubic: &TriangleCubic,
) -> Option<(TriangleCubic, f64)> {
    let Tracing { rounding, walls, level, .. } = tracing;
    let values = cubic.vertices();
    let rounded = [0, 1, 2].map(|n| rounding.at(points[n], values[n]));
    let near = [0, 1, 2].map(|n| {
        let is_given = walls.has_point(points[n]);
        if is_given { rounding.at_wall(points[n], values[n]) } else { rounded[n] }
    });
    let wall = [0, 1, 2].map(|n| walls.has_edge(points[(n + 1) % 3], points[(n + 2) % 3]));
    let whole = TriangleCubic::from_coefficients(|exponents| {
        let difference = cubic.coefficient(exponents) - level;
        let on_wall = (0..3).any(|edge| wall[edge] && exponents[edge] == 0);
        // a coefficient of an edge belongs to both its ends
        let near = (0..3).filter(|&n| exponents[n] > 0).map(|n| near[n]).fold(0.0, f64::max);
        if on_wall || difference.abs() <= near { 0.0 } else { difference }
    });
    let (low, high) = whole.bounds();
    let size = high.max(-low);
    if !size.is_finite() {
        return None;
    }
    let scale = if size > 0.0 { size.log2().floor().exp2() } else { 1.0 };
    let rounding = rounded.into_iter().fold(0.0, f64::max) / scale;
    Some((TriangleCubic::new(whole.coefficients.map(|c| c / scale)), rounding))
}

fn trace_pieces(
    tracing: &Tracing,
    rounding: f64,
    cell: &mut Cell,
    first: Piece,
    traces: &mut Traces,
) {
    // the largest first: where no number of pieces is enough, only the smallest
    // are left unresolved
    let mut waiting = VecDeque::from([first]);
    let mut seen = 0;
    let mut touched = false;
    while let Some(piece) = waiting.pop_front() {
        seen += 1;
        let corners = piece.corners.map(|corner| cell.frame.position(&corner));
        match situation(&piece, &corners) {
            Situation::Empty => {
                touched |= piece.is_touched();
                join_along_border(cell, &piece, traces);
            }
            Situation::Simple { apex } => draw_arc(tracing, rounding, cell, &piece, apex, traces),
            Situation::Undecided(_) if is_at_limit(rounding, &piece, seen) => {
                traces.unresolved += 1;
                join_nearest(cell, &piece, traces);
            }
            Situation::Undecided(Division::Four) => waiting.extend(cell.quadrisect(&piece)),
            Situation::Undecided(Division::Edge { edge, t }) => {
                waiting.extend(cell.split_edge(&piece, edge, t));
            }
        }
    }
    traces.divided += usize::from(seen > 1);
    traces.touching += usize::from(touched);
}

/// Whether dividing a piece further would only resolve rounding.
fn is_at_limit(rounding: f64, piece: &Piece, seen: usize) -> bool {
    let (low, high) = piece.cubic.bounds();
    piece.depth >= MAX_DEPTH || seen >= MAX_PIECES || high.max(-low) <= rounding
}

/// Draws the one arc of a simple piece.
fn draw_arc(
    tracing: &Tracing,
    rounding: f64,
    cell: &Cell,
    piece: &Piece,
    apex: usize,
    traces: &mut Traces,
) {
    let mut border = piece.border();
    let (Some(first), Some(second)) = (border.next(), border.next()) else { return };
    // the higher side is on the left if the border leaves it where the arc begins
    let (start, end) = match piece.signs[1] {
        Sign::Above => (first, second),
        Sign::Below => (second, first),
    };
    let [start, end] = [start, end].map(|(edge, crossing)| {
        (cell.crossings[crossing.crossing as usize], piece.ray(apex, edge, crossing.t))
    });
    let mut drawing = std::mem::take(&mut traces.drawing);
    if let Some(arc) = Arc::new(cell.cubic, cell.frame, piece, apex, rounding) {
        let node = |(crossing, ray): (Crossing, f64)| arc.node(crossing.at, crossing.position, ray);
        let stations =
            [Some(node(start)), waypoint(&arc, piece, apex, start, end), Some(node(end))];
        let stations: ArrayVec<Node, 3> = stations.into_iter().flatten().collect();
        for (place, pair) in stations.windows(2).enumerate() {
            if place > 0 {
                drawing.points.push(pair[0]);
            }
            draw(&arc, [&pair[0], &pair[1]], tracing.method, &tracing.resolution, &mut drawing);
        }
    }
    traces.add(cell, start.0, end.0, &mut drawing);
    traces.drawing = drawing;
}

/// A point that the arc must pass, where its ends alone would not show it.
fn waypoint(
    arc: &Arc,
    piece: &Piece,
    apex: usize,
    (start, from): (Crossing, f64),
    (end, to): (Crossing, f64),
) -> Option<Node> {
    if start.position == end.position {
        // a loop from the apex back to it
        piece.ray_on_side_of(apex).map(|ray| arc.on_ray(ray))
    } else if may_be_half_an_island(start.owner, end.owner) {
        // if both halves were straight, they would be the same line
        Some(arc.on_ray(0.5 * (from + to)))
    } else {
        None
    }
}

/// Whether an arc and another may have both ends in common: two points inside the
/// cell, or on one edge.
fn may_be_half_an_island(start: Owner, end: Owner) -> bool {
    match (start, end) {
        (Owner::Cell { .. }, Owner::Cell { .. }) => true,
        (Owner::Edge { low, high, .. }, Owner::Edge { low: l, high: h, .. }) => {
            (low, high) == (l, h)
        }
        _ => false,
    }
}

/// Joins the crossings of a piece in which all coefficients have one sign: the
/// parts of the border on the other side are those where the cubic is zero, and
/// the contour runs along them.
fn join_along_border(cell: &Cell, piece: &Piece, traces: &mut Traces) {
    let (low, high) = piece.cubic.bounds();
    let zero_side = if high > -low { Sign::Below } else { Sign::Above };
    traces.add_straight(cell, &pairs_around(piece, zero_side));
}

/// Joins the crossings of an unresolved piece by straight lines, in the shorter of
/// the two ways that do not cross.
fn join_nearest(cell: &Cell, piece: &Piece, traces: &mut Traces) {
    let position = |crossing: u32| cell.crossings[crossing as usize].position;
    let length = |pairs: &[[u32; 2]]| -> f64 {
        pairs.iter().map(|&[a, b]| (position(a) - position(b)).norm()).sum()
    };
    let (above, below) = (pairs_around(piece, Sign::Above), pairs_around(piece, Sign::Below));
    let shorter = if length(&above) <= length(&below) { above } else { below };
    traces.add_straight(cell, &shorter);
}

/// The crossings of a piece in pairs, each at the two ends of a part of the border
/// that lies on the given side, and directed with the higher side on the left.
fn pairs_around(piece: &Piece, side: Sign) -> Vec<[u32; 2]> {
    let mut border: Vec<u32> = piece.border().map(|(_, crossing)| crossing.crossing).collect();
    // after the first crossing the border is on the other side than corner 1
    if piece.signs[1] == side && !border.is_empty() {
        border.rotate_left(1);
    }
    let directed = |pair: &[u32]| match side {
        Sign::Above => [pair[1], pair[0]],
        Sign::Below => [pair[0], pair[1]],
    };
    border.chunks_exact(2).map(directed).collect()
}
