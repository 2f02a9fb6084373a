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
//! | 1: no intersection, no tangent | through the extreme inside, to a corner |
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
    match piece.cubic.certificate(piece.signs) {
        Certificate::Empty => Situation::Empty,
        Certificate::Graph { .. } if count == 0 => Situation::Empty,
        Certificate::Graph { apex } if count == 2 && !both_on_one_ray(piece, apex) => {
            Situation::Simple { apex }
        }
        _ => Situation::Undecided(division(piece, count).unwrap_or(longest_edge(corners))),
    }
}

/// Whether the two crossings lie on one ray from the apex, as two on an edge at the
/// apex do. Rounding, or a corner on the level, brings that about.
fn both_on_one_ray(piece: &Piece, apex: usize) -> bool {
    let mut rays = piece.border().map(|(edge, crossing)| piece.ray(apex, edge, crossing.t));
    rays.next() == rays.next()
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

#[cfg(test)]
mod tests {
    use super::super::piece::Cell;
    use super::super::start::first_piece;
    use super::*;
    use crate::bernstein::{SegmentCubic, TriangleCubic};
    use crate::mesh::TriangleFrame;

    /// The situation of the cubic with the given edges and centre, on a triangle
    /// whose longest edge is edge 0.
    fn decide(edges: [[f64; 4]; 3], centre: f64) -> Situation {
        let [opposite_0, opposite_1, opposite_2] = edges;
        assert_eq!(opposite_0[3], opposite_1[0]);
        assert_eq!(opposite_1[3], opposite_2[0]);
        assert_eq!(opposite_2[3], opposite_0[0]);
        let toward = |i: usize, j: usize| {
            let edge = 3 - i - j;
            if j == (i + 1) % 3 { edges[edge][1] } else { edges[edge][2] }
        };
        let vertex = [opposite_2[0], opposite_0[0], opposite_1[0]];
        let cubic = TriangleCubic::assemble(vertex, toward, centre);
        for (edge, coefficients) in edges.iter().enumerate() {
            assert_eq!(cubic.edge(edge).coefficients, *coefficients);
        }
        let corners = [Vector::zeros(), Vector::x() * 2.0, Vector::y() * 2.0];
        let frame = TriangleFrame::new(corners);
        let mut cell = Cell { number: 0, cubic: &cubic, frame: &frame, crossings: Vec::new() };
        let piece = first_piece(&mut cell, &cubic, [0, 1, 2]);
        situation(&piece, &corners)
    }

    /// An edge from `start` to `end` with zeros at the given places.
    fn edge_with_roots(roots: [f64; 3]) -> [f64; 4] {
        let [a, b, c] = roots;
        let (sum, pairs, product) = (a + b + c, a * b + b * c + c * a, a * b * c);
        [
            -product,
            pairs / 3.0 - product,
            (2.0 * pairs - sum) / 3.0 - product,
            1.0 - sum + pairs - product,
        ]
    }

    fn divided_at(situation: Situation) -> (usize, f64) {
        match situation {
            Situation::Undecided(Division::Edge { edge, t }) => (edge, t),
            other => panic!("{other:?}"),
        }
    }

    const BELOW: [f64; 4] = [-1.0; 4];

    #[test]
    fn two_crossings_and_a_certificate_are_the_desired_situation() {
        let third = 1.0 / 3.0;
        let down = [1.0, third, -third, -1.0];
        let up = [-1.0, -third, third, 1.0];
        assert_eq!(decide([BELOW, up, down], -third), Situation::Simple { apex: 0 });
        assert_eq!(decide([BELOW; 3], -1.0), Situation::Empty);
    }

    #[test]
    fn case_1_an_island_is_divided_through_its_top() {
        let (_, t) = divided_at(decide([BELOW; 3], 20.0));
        assert!((t - 0.5).abs() < 0.1, "{t}");
        // nothing hidden, but not certified: the longest edge
        assert_eq!(divided_at(decide([BELOW; 3], 3.0)), (0, 0.5));
    }

    #[test]
    fn cases_2_and_3_a_tangent_is_divided_where_it_touches() {
        // -(t - 0.4)²: touches the level from below; the inside is above
        let square = |t: f64| -(t - 0.4_f64).powi(2);
        let touching = SegmentCubic::hermite(square(0.0), 0.8, square(1.0), -1.2).coefficients;
        let (low, high) = (touching[0], touching[3]);
        let rising = [high, high, low, low];
        let flat = [low, low, low, low];
        let (edge, t) = divided_at(decide([touching, rising, flat], 5.0));
        assert_eq!(edge, 0);
        assert!((t - 0.4).abs() < 1e-6, "{t}");
        // with two crossings besides
        let crossing = [high, high, 3.0, 3.0];
        let back = [3.0, low, low, low];
        let (edge, t) = divided_at(decide([touching, crossing, back], 1.0));
        assert_eq!(edge, 0);
        assert!((t - 0.4).abs() < 1e-6, "{t}");
    }

    #[test]
    fn case_4_four_crossings_are_divided_between_two_of_one_edge() {
        // 2-1-1: two on edge 0, one on each other edge
        let two = edge_with_roots([0.2, 0.6, 3.0]);
        let (first, last) = (two[0], two[3]);
        let one = [last, last, 1.0, 1.0];
        let other = [1.0, 1.0, first, first];
        let (edge, t) = divided_at(decide([two, one, other], 0.0));
        assert_eq!(edge, 0);
        assert!((t - 0.4).abs() < 1e-12, "{t}");
        // 3-1-0: the widest gap of three
        let three = edge_with_roots([0.1, 0.3, 0.8]);
        let (first, last) = (three[0], three[3]);
        let one = [last, last, first, first];
        let (edge, t) = divided_at(decide([three, one, [first; 4]], 0.0));
        assert_eq!(edge, 0);
        assert!((t - 0.55).abs() < 1e-12, "{t}");
    }

    #[test]
    fn case_5_more_than_four_crossings_are_divided_in_four() {
        let wave = edge_with_roots([0.2, 0.5, 0.8]);
        let back = wave.map(|c| -c);
        // edges 0 and 1 have three crossings each, and edge 2 has none
        let flat = [back[3], back[3], wave[0], wave[0]];
        let situation = decide([wave, back.map(|c| c * (wave[3] / back[0])), flat], 0.0);
        assert_eq!(situation, Situation::Undecided(Division::Four));
    }
}
