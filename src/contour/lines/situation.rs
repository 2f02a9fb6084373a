//! Stage two: is a piece in a desired situation, and if not, how to divide it
//! (thesis, section 2.3.2).
//!
//! The thesis calls two crossings on the border the *desired situation* and
//! divides all other pieces by six rules. Two crossings alone do not exclude a
//! loop inside, nor do no crossings exclude an island: here the A-patch
//! certificate must agree before a piece is drawn or passed over. The rules:
//!
//! | thesis' case | here |
//! |---|---|
//! | 1: no intersection | through the extreme inside, to a corner |
//! | 2, 3: one or three intersections, one a tangent | from the tangent point to the corner opposite |
//! | 4: four intersections (2-1-1, 2-2-0, 3-1-0) | between two crossings of one edge, to the corner opposite |
//! | 5: more than four | in four, by the middles of the edges |
//! | two, but not certified | the longest edge in its middle |
//!
//! A tangent does not change the sign, so it is no crossing here, and cases 2 and
//! 3 have none and two. The 2-2-0 situation needs a second line, which the thesis
//! draws at once and rule 4 draws in the half that still has four crossings. Four
//! crossings on one edge (4-0-0) do not occur: a cubic has three.

use super::piece::Piece;
use crate::bernstein::a_patch::Certificate;
use crate::bernstein::{Barycentric, Sign};
use crate::contour::extreme::{Extreme, recursive_extreme};
use crate::mesh::Vector;

/// What is known of the contour in a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Situation {
    /// Nothing inside; crossings, if any, are joined along the border.
    Empty,
    /// One arc between two crossings, met once by each ray from a corner.
    Simple {
        /// The corner.
        apex: usize,
    },
    /// Not known yet.
    Undecided(Division),
}

/// How to divide a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Division {
    /// By a line from a corner to a point of the edge opposite.
    Edge {
        /// The edge, named by the corner opposite.
        edge: usize,
        /// The point on it, in `(0, 1)`.
        t: f64,
    },
    /// By lines between the middles of the edges.
    Four,
}

/// A division nearer to a corner than this would make slivers; the longest edge
/// is halved instead.
const NEAREST: f64 = 0.02;

/// What is known of a piece, and what to do about it. `corners` are those of the
/// piece, in space.
pub fn situation(piece: &Piece, corners: &[Vector; 3]) -> Situation {
    let count = piece.crossing_count();
    match piece.cubic.certificate() {
        Certificate::Empty => Situation::Empty,
        Certificate::Graph { .. } if count == 0 => Situation::Empty,
        Certificate::Graph { apex } if count == 2 && !both_on_one_ray(piece, apex) => {
            Situation::Simple { apex }
        }
        _ => Situation::Undecided(division(piece, count).unwrap_or(longest_edge(corners))),
    }
}

/// Whether both crossings lie on one edge at the apex, which is itself a ray.
/// Only rounding brings that about.
fn both_on_one_ray(piece: &Piece, apex: usize) -> bool {
    (0..3).any(|edge| edge != apex && piece.edges[edge].len() == 2)
}

/// The thesis' rules.
fn division(piece: &Piece, count: usize) -> Option<Division> {
    match count {
        0 => tangent_point(piece).or_else(|| through_extreme(piece)),
        1..=3 => tangent_point(piece),
        4 => between_crossings(piece),
        _ => Some(Division::Four),
    }
}

/// Cases 2 and 3: the contour touches an edge.
fn tangent_point(piece: &Piece) -> Option<Division> {
    (0..3).find_map(|edge| {
        let roots = piece.cubic.edge(edge).roots();
        roots.touches().find_map(|t| division_at(edge, t))
    })
}

/// Case 1: nothing crosses the border; find a point inside on the other side of
/// the level, and divide by a line through it.
fn through_extreme(piece: &Piece) -> Option<Division> {
    let which = match piece.signs[0] {
        Sign::Below => Extreme::Maximum,
        Sign::Above => Extreme::Minimum,
    };
    let found = recursive_extreme(&piece.cubic, which);
    let hidden = Sign::of(found.value) != piece.signs[0];
    if hidden { through(&found.at) } else { None }
}

/// The line from a corner through a point, by the corner whose line cuts the edge
/// opposite nearest to its middle.
fn through(at: &Barycentric) -> Option<Division> {
    let cut = |edge: usize| {
        let (start, end) = (at[(edge + 1) % 3], at[(edge + 2) % 3]);
        (edge, end / (start + end))
    };
    let from_middle = |t: f64| (t - 0.5).abs();
    let cuts = (0..3).map(cut).filter(|(_, t)| t.is_finite());
    let (edge, t) = cuts.min_by(|a, b| from_middle(a.1).total_cmp(&from_middle(b.1)))?;
    division_at(edge, t)
}

/// Case 4: on the edge with most crossings, in the middle of the widest gap
/// between two of them.
fn between_crossings(piece: &Piece) -> Option<Division> {
    let edge = (0..3).max_by_key(|&edge| piece.edges[edge].len())?;
    let gaps = piece.edges[edge].windows(2).map(|pair| (pair[0].t, pair[1].t));
    let (start, end) = gaps.max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)))?;
    division_at(edge, 0.5 * (start + end))
}

fn division_at(edge: usize, t: f64) -> Option<Division> {
    (t > NEAREST && t < 1.0 - NEAREST).then_some(Division::Edge { edge, t })
}

fn longest_edge(corners: &[Vector; 3]) -> Division {
    let length = |edge: usize| (corners[(edge + 2) % 3] - corners[(edge + 1) % 3]).norm_squared();
    let edge = if length(0) >= length(1) && length(0) >= length(2) {
        0
    } else if length(1) >= length(2) {
        1
    } else {
        2
    };
    Division::Edge { edge, t: 0.5 }
}
