//! A triangle piece of a cell, with the contour's crossings on its border.

use arrayvec::ArrayVec;

use super::crossing::{Crossing, Owner};
use crate::bernstein::{Barycentric, SegmentCubic, Sign, TriangleCubic, between};
use crate::contour::crossings::{MAX_CROSSINGS, crossings};
use crate::mesh::TriangleFrame;

/// A crossing on the edge of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeCrossing {
    /// Where on the edge, in `[0, 1]`.
    pub t: f64,
    /// Its number among the crossings of the cell.
    pub crossing: u32,
}

/// The crossings on an edge, in its direction.
pub type EdgeCrossings = ArrayVec<EdgeCrossing, MAX_CROSSINGS>;

/// A triangle piece of a cell.
///
/// Edge `e` is opposite corner `e` and runs from corner `e + 1` to corner
/// `e + 2`, so the three edges go around the piece counter-clockwise.
#[derive(Clone, Debug)]
pub struct Piece {
    /// The corners, in barycentric coordinates of the cell.
    pub corners: [Barycentric; 3],
    /// On which side of the level each corner lies.
    pub signs: [Sign; 3],
    /// The cubic less the level, on this piece.
    pub cubic: TriangleCubic,
    /// The crossings on each edge, in its direction.
    pub edges: [EdgeCrossings; 3],
    /// How many divisions made this piece.
    pub depth: u32,
}

impl Piece {
    /// How many crossings there are on the whole border.
    pub fn crossing_count(&self) -> usize {
        self.edges.iter().map(ArrayVec::len).sum()
    }

    /// Whether the cubic is zero at a corner inside the cell, and yet nothing crosses
    /// the border: there the contour touches the level and turns back.
    pub fn is_touched(&self) -> bool {
        let values = self.cubic.vertices();
        let inside = |corner: &Barycentric| !corner.contains(&1.0);
        self.crossing_count() == 0
            && self.corners.iter().zip(values).any(|(corner, value)| value == 0.0 && inside(corner))
    }

    /// The crossings around the border, counter-clockwise from corner 1, each with
    /// its edge. Before the first one the border is on the side of corner 1.
    pub fn border(&self) -> impl Iterator<Item = (usize, EdgeCrossing)> + '_ {
        (0..3).flat_map(|edge| self.edges[edge].iter().map(move |crossing| (edge, *crossing)))
    }

    /// The point of the cell at `t` on an edge.
    fn on_edge(&self, edge: usize, t: f64) -> Barycentric {
        between(&self.corners[(edge + 1) % 3], &self.corners[(edge + 2) % 3], t)
    }

    /// The ray from corner `apex` through the point `t` of an edge: where it meets
    /// the base, the edge opposite.
    pub fn ray(&self, apex: usize, edge: usize, t: f64) -> f64 {
        if edge == apex {
            t
        } else if edge == (apex + 2) % 3 {
            0.0
        } else {
            1.0
        }
    }

    /// A ray from corner `apex`, itself on the level, that enters the apex's side:
    /// one on which some layer of coefficients has a mean on that side. Nothing if
    /// all rays leave that side at once.
    pub fn ray_on_side_of(&self, apex: usize) -> Option<f64> {
        (1..4).find_map(|layer| {
            let means = self.cubic.layer(apex, layer);
            let stations = means.critical_points().into_iter().chain([0.0, 1.0]);
            let far = stations.max_by(|&a, &b| {
                let signed = |t: f64| match self.signs[apex] {
                    Sign::Above => means.value(t),
                    Sign::Below => -means.value(t),
                };
                signed(a).total_cmp(&signed(b))
            })?;
            let value = means.value(far);
            (value != 0.0 && Sign::of(value) == self.signs[apex]).then_some(far)
        })
    }

    /// The side on which an edge lies at `t`: its start's, changed by each
    /// crossing before `t`.
    fn side_at(&self, edge: usize, t: f64) -> Sign {
        let before = self.edges[edge].iter().filter(|crossing| crossing.t < t).count();
        let start = self.signs[(edge + 1) % 3];
        if before % 2 == 0 { start } else { !start }
    }

    /// The part of an edge's crossings between two parameters, rescaled.
    fn part_of_edge(&self, edge: usize, from: f64, to: f64) -> EdgeCrossings {
        self.edges[edge]
            .iter()
            .filter(|crossing| (crossing.t < to || to == 1.0) && (crossing.t >= from))
            .map(|crossing| EdgeCrossing {
                t: ((crossing.t - from) / (to - from)).clamp(0.0, 1.0),
                crossing: crossing.crossing,
            })
            .collect()
    }
}

/// The cell whose pieces are divided: its cubic, and the crossings found so far.
#[derive(Debug)]
pub struct Cell<'a> {
    /// The cell's number.
    pub number: u32,
    /// The cubic less the level, on the whole cell; its coefficients are not far
    /// above one.
    pub cubic: &'a TriangleCubic,
    /// The cell's frame.
    pub frame: &'a TriangleFrame,
    /// All crossings found, on the cell's edges and inside.
    pub crossings: Vec<Crossing>,
}

impl Cell<'_> {
    /// The piece divided in two, by a line from corner `edge` to the point `t` of
    /// the edge opposite, or to one a little before it if that line lies on the contour.
    pub fn split_edge(&mut self, piece: &Piece, edge: usize, t: f64) -> [Piece; 2] {
        let t = self.beside_contour(piece, edge, t);
        let (apex, start, end) = (edge, (edge + 1) % 3, (edge + 2) % 3);
        let middle = Corner { at: piece.on_edge(edge, t), sign: piece.side_at(edge, t) };
        let [apex, start, end] =
            [apex, start, end].map(|n| Corner { at: piece.corners[n], sign: piece.signs[n] });
        let cut = self.line(&apex, &middle);
        let first_half = piece.part_of_edge(edge, 0.0, t);
        let second_half = piece.part_of_edge(edge, t, 1.0);
        let (before, after) =
            (piece.edges[(edge + 2) % 3].clone(), piece.edges[(edge + 1) % 3].clone());
        let first = self.piece([apex, start, middle], [first_half, reversed(&cut), before], piece);
        let second = self.piece([apex, middle, end], [second_half, after, cut], piece);
        [first, second]
    }

    /// The piece divided in four, by lines between the middles of its edges.
    pub fn quadrisect(&mut self, piece: &Piece) -> [Piece; 4] {
        let middle = [0, 1, 2]
            .map(|edge| Corner { at: piece.on_edge(edge, 0.5), sign: piece.side_at(edge, 0.5) });
        let corner = [0, 1, 2].map(|n| Corner { at: piece.corners[n], sign: piece.signs[n] });
        // inner[n] runs parallel to edge n, in its direction
        let inner = [0, 1, 2].map(|n| self.line(&middle[(n + 2) % 3], &middle[(n + 1) % 3]));
        let outer = |n: usize| {
            let (next, last) = ((n + 1) % 3, (n + 2) % 3);
            let after = piece.part_of_edge(last, 0.0, 0.5);
            let before = piece.part_of_edge(next, 0.5, 1.0);
            ([corner[n], middle[last], middle[next]], [inner[n].clone(), before, after])
        };
        let [a, b, c] = [0, 1, 2].map(|n| {
            let (corners, edges) = outer(n);
            self.piece(corners, edges, piece)
        });
        let centre = [reversed(&inner[0]), reversed(&inner[1]), reversed(&inner[2])];
        [a, b, c, self.piece(middle, centre, piece)]
    }

    /// A point of an edge, at `t` or a little before, for which the line from the corner
    /// opposite does not lie on the contour as a whole.
    ///
    /// Such a line would have no crossings, and hide the contour from both its sides.
    fn beside_contour(&self, piece: &Piece, edge: usize, t: f64) -> f64 {
        // of four lines through a corner at most three lie on the contour of a cubic
        let candidates = [1.0, 0.9375, 0.875, 0.8125].map(|factor| factor * t);
        let apex = &piece.corners[edge];
        let hidden = |t: &f64| self.is_on_contour(apex, &piece.on_edge(edge, *t));
        candidates.into_iter().find(|t| !hidden(t)).unwrap_or(t)
    }

    /// Whether a line lies on the contour as a whole.
    fn is_on_contour(&self, from: &Barycentric, to: &Barycentric) -> bool {
        settled(&self.cubic.restrict(from, to)).coefficients == [0.0; 4]
    }

    /// The crossings on a new line inside the cell.
    fn line(&mut self, from: &Corner, to: &Corner) -> EdgeCrossings {
        let restricted = settled(&self.cubic.restrict(&from.at, &to.at));
        let found = crossings(&restricted, from.sign, to.sign);
        found
            .into_iter()
            .map(|t| {
                let at = between(&from.at, &to.at, t);
                let (owner, position) = (self.next_owner(), self.frame.position(&at));
                EdgeCrossing { t, crossing: self.add(Crossing { owner, at, position }) }
            })
            .collect()
    }

    /// Adds a crossing; returns its number.
    pub fn add(&mut self, crossing: Crossing) -> u32 {
        self.crossings.push(crossing);
        self.crossings.len() as u32 - 1
    }

    /// The owner of the next crossing inside this cell.
    pub fn next_owner(&self) -> Owner {
        Owner::Cell { cell: self.number, place: self.crossings.len() as u32 }
    }

    fn piece(&self, corners: [Corner; 3], edges: [EdgeCrossings; 3], parent: &Piece) -> Piece {
        let positions = corners.map(|corner| corner.at);
        Piece {
            corners: positions,
            signs: corners.map(|corner| corner.sign),
            cubic: TriangleCubic::new(
                self.cubic.sub_triangle(&positions).coefficients.map(without_noise),
            ),
            edges,
            depth: parent.depth + 1,
        }
    }
}

/// The error of de Casteljau's algorithm, for coefficients near one.
const NOISE: f64 = 16.0 * f64::EPSILON;

/// A coefficient, or zero if it is no larger than the error with which it was
/// computed. A line that happens to lie on the contour is then zero, as it should
/// be, and not a series of false crossings.
fn without_noise(coefficient: f64) -> f64 {
    if coefficient.abs() <= NOISE { 0.0 } else { coefficient }
}

/// A cubic on a line without the errors of its coefficients.
pub fn settled(cubic: &SegmentCubic) -> SegmentCubic {
    SegmentCubic::new(cubic.coefficients.map(without_noise))
}

#[derive(Clone, Copy)]
struct Corner {
    at: Barycentric,
    sign: Sign,
}

fn reversed(edge: &EdgeCrossings) -> EdgeCrossings {
    edge.iter().rev().map(|c| EdgeCrossing { t: 1.0 - c.t, crossing: c.crossing }).collect()
}
