//! Parts of the domain's boundary that lie on the level: Dirichlet walls.
//!
//! Where a boundary condition fixes the solution, the values at the points are
//! exact and the gradients are not: recovered or projected ones have a small
//! component along the wall, so the cubics weave about the level there, and its
//! contour would be a row of dashes. The values are believed: the wall is the
//! contour. No edge inside the domain is touched, and no two cells disagree, since
//! an edge of the boundary belongs to one cell.

use rayon::prelude::*;

use super::start::slope_beside;
use crate::bernstein::TriangleCubic;
use crate::contour::CellRanges;
use crate::contour::components::components;
use crate::contour::rounding::Rounding;
use crate::interpolant::TriangleCubics;

/// The edges of the boundary that are taken as lying on the level.
#[derive(Debug, Default)]
pub struct Walls {
    /// Pairs of points, lower first, sorted.
    edges: Vec<[u32; 2]>,
    /// Their points, sorted.
    points: Vec<u32>,
    /// How far from the level the value at one of their points is at most.
    distance: f64,
}

/// How far the inner coefficients of a wall may be from the level, as a part of the
/// spread of its cell. Projected gradients on coarse meshes come to 0.17, where a wall
/// bends at a point that has one gradient for both edges. An arch between two
/// points on the level, such as sin x between two of its zeros, has 0.5 and more.
const OF_WALL: f64 = 0.25;

/// An edge that may be on a wall, by the values at its ends, seen from one of its cells.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    edge: [u32; 2],
    length: f64,
    /// How far from the level the value at an end is at most.
    distance: f64,
    /// Whether its ends are on the level without regard to the rest of a wall.
    is_on_level: bool,
    /// Whether its inner coefficients are near enough to the level.
    is_near: bool,
    /// Whether the contour runs beside it, inside the cell, from end to end.
    is_followed: bool,
}

impl Walls {
    /// The walls on a level, among the cells that are active there.
    ///
    /// One edge alone is no wall: two points of the same value and a curve between
    /// them are what a solution has that is symmetric. A wall that the contour
    /// follows inside the cells all along, as the circle around a hole, is left
    /// to it.
    ///
    /// A wall has one value, and is taken as a whole: it is on the level if the greater part of its
    /// length is by itself. A first call, with a band without width, finds edges that are; a second,
    /// with a band as wide as their [`distance`](Self::distance) and the cells in it, the whole.
    pub fn new(
        interpolant: &dyn TriangleCubics,
        ranges: &CellRanges,
        rounding: &Rounding,
        cells: &[u32],
    ) -> Self {
        let mut candidates: Vec<Candidate> = cells
            .par_iter()
            .flat_map_iter(|&cell| candidates(interpolant, rounding, cell as usize))
            .collect();
        candidates.par_sort_unstable_by_key(|candidate| candidate.edge);
        let mut lone: Vec<Candidate> = candidates
            .chunk_by(|a, b| a.edge == b.edge)
            .filter(|cells| cells.len() == 1 && cells[0].is_near)
            .map(|cells| cells[0])
            .collect();
        remove_edges_of_left_out_cells(&mut lone, interpolant, ranges);
        Self::of_chains(&lone)
    }

    /// Keeps the edges of chains that are walls.
    fn of_chains(candidates: &[Candidate]) -> Self {
        let chain = components(candidates.len(), |n| candidates[n].edge);
        let mut counts = vec![0; candidates.len()];
        let (mut lengths, mut on_level) =
            (vec![0.0; candidates.len()], vec![0.0; candidates.len()]);
        let mut followed = vec![true; candidates.len()];
        for (candidate, &chain) in candidates.iter().zip(&chain) {
            counts[chain] += 1;
            lengths[chain] += candidate.length;
            on_level[chain] += if candidate.is_on_level { candidate.length } else { 0.0 };
            followed[chain] &= candidate.is_followed;
        }
        let is_wall = |chain: usize| {
            let is_on_level = 2.0 * on_level[chain] >= lengths[chain];
            is_on_level && counts[chain] > 1 && !followed[chain]
        };
        let of_walls = candidates.iter().zip(chain).filter(|(_, chain)| is_wall(*chain));
        let found: Vec<&Candidate> = of_walls.map(|(candidate, _)| candidate).collect();
        let distance = found.iter().map(|edge| edge.distance).fold(0.0, f64::max);
        let edges: Vec<[u32; 2]> = found.iter().map(|found| found.edge).collect();
        let mut points: Vec<u32> = edges.iter().flatten().copied().collect();
        points.sort_unstable();
        points.dedup();
        Self { edges, points, distance }
    }

    /// How far from the level the value at a point of a wall is at most: cells that are so near
    /// to the level may be at a wall as well.
    pub fn distance(&self) -> f64 {
        self.distance
    }

    /// Whether the edge between two points is a wall.
    pub fn has_edge(&self, a: u32, b: u32) -> bool {
        !self.edges.is_empty() && self.edges.binary_search(&[a.min(b), a.max(b)]).is_ok()
    }

    /// Whether a point is on a wall.
    pub fn has_point(&self, point: u32) -> bool {
        !self.points.is_empty() && self.points.binary_search(&point).is_ok()
    }
}

/// The edges of a cell that may be on a wall.
fn candidates(
    interpolant: &dyn TriangleCubics,
    rounding: &Rounding,
    cell: usize,
) -> impl Iterator<Item = Candidate> {
    let points = interpolant.mesh().triangles()[cell];
    let cubic = interpolant.cubic(cell);
    let values = cubic.vertices();
    let may_be_on_wall = [0, 1, 2].map(|n| rounding.may_be_on_wall(points[n], values[n]));
    let on_level = [0, 1, 2].map(|n| rounding.is_on_level(points[n], values[n]));
    let corners = interpolant.mesh().corners(cell);
    let ends = |edge: usize| [(edge + 1) % 3, (edge + 2) % 3];
    (0..3).filter(move |&edge| ends(edge).iter().all(|&end| may_be_on_wall[end])).map(move |edge| {
        let [from, to] = ends(edge);
        let (a, b) = (points[from], points[to]);
        let (low, high) = cubic.bounds();
        let [_, first, second, _] =
            cubic.edge(edge).coefficients.map(|value| value - rounding.level());
        let side = side(&cubic, edge, rounding.level());
        let distance = |end: usize| (values[end] - rounding.level()).abs();
        Candidate {
            edge: [a.min(b), a.max(b)],
            length: (corners[to] - corners[from]).norm(),
            distance: distance(from).max(distance(to)),
            is_on_level: on_level[from] && on_level[to],
            is_near: first.abs().max(second.abs()) <= OF_WALL * (high - low),
            is_followed: first * side < 0.0 && second * side < 0.0,
        }
    })
}

/// On which side of the level a cell is, beside an edge that is taken as zero:
/// positive above, negative below.
fn side(cubic: &TriangleCubic, edge: usize, level: f64) -> f64 {
    let on_edge_zero = TriangleCubic::from_coefficients(|exponents| {
        if exponents[edge] == 0 { 0.0 } else { cubic.coefficient(exponents) - level }
    });
    slope_beside(&on_edge_zero, edge)
}

/// An edge beside a cell that is left out (a ghost, or one without values) is
/// inside the domain, although one cell alone has a contour.
fn remove_edges_of_left_out_cells(
    candidates: &mut Vec<Candidate>,
    interpolant: &dyn TriangleCubics,
    ranges: &CellRanges,
) {
    if candidates.is_empty() || !ranges.leaves_out_any() {
        return;
    }
    let triangles = interpolant.mesh().triangles().iter().enumerate();
    let mut inside: Vec<[u32; 2]> = triangles
        .filter(|(cell, _)| ranges.leaves_out(*cell))
        .flat_map(|(_, &[a, b, c])| [[a, b], [b, c], [c, a]])
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    inside.sort_unstable();
    candidates.retain(|candidate| inside.binary_search(&candidate.edge).is_err());
}

#[cfg(test)]
mod tests {
    use super::*;

    fn candidate(edge: [u32; 2], is_followed: bool) -> Candidate {
        let (length, distance) = (1.0, 0.0);
        Candidate { edge, length, distance, is_on_level: true, is_near: true, is_followed }
    }

    #[test]
    fn chains_of_two_edges_are_walls_and_lone_edges_are_not() {
        let candidates = [[0, 1], [2, 3], [5, 7], [6, 7]].map(|edge| candidate(edge, false));
        let walls = Walls::of_chains(&candidates);
        assert_eq!(walls.edges, [[5, 7], [6, 7]]);
        assert!(walls.has_edge(7, 5) && !walls.has_edge(0, 1));
        assert!(walls.has_point(6) && !walls.has_point(2));
    }

    #[test]
    fn a_wall_is_on_the_level_if_the_greater_part_of_its_length_is() {
        let on_level = candidate([0, 1], false);
        let off = Candidate { is_on_level: false, distance: 0.5, ..candidate([1, 2], false) };
        for (length, expected) in [(0.5, &[[0, 1], [1, 2]][..]), (2.0, &[])] {
            let walls = Walls::of_chains(&[on_level, Candidate { length, ..off }]);
            assert_eq!(walls.edges, expected);
            assert_eq!(walls.distance(), if expected.is_empty() { 0.0 } else { 0.5 });
        }
    }

    #[test]
    fn a_wall_that_is_followed_all_along_is_left_to_the_contour() {
        let ring = [[0, 1], [0, 3], [1, 2], [2, 3]];
        assert!(Walls::of_chains(&ring.map(|edge| candidate(edge, true))).edges.is_empty());
        let woven = ring.map(|edge| candidate(edge, edge != [1, 2]));
        assert_eq!(Walls::of_chains(&woven).edges, ring);
    }
}
