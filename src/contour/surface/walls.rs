//! Faces of the domain's boundary that lie on the level: Dirichlet walls.
//!
//! Where a boundary condition fixes the solution, the values at the points are exact, and
//! gradients and face coefficients are not: the cubics weave about the level, and its surface
//! would be scraps along the wall. The values are believed: the wall is the surface.
//!
//! What of a cubic belongs to a wall is put on the level, and the slope off the wall is taken
//! as linear along the wall's edges. The cubic of a cell at a wall is then the product of the
//! distance from the wall and a function that is linear on it; where that is zero, another part
//! of the surface ends in the wall. The sides on which a wall's points count are those of that
//! function, so pieces at a wall are as simple as others. All of this belongs to points, edges
//! and faces, so cells agree.

use std::collections::{HashMap, HashSet};

use rayon::prelude::*;

use super::cell::less_level;
use crate::bernstein::TetrahedronCubic;
use crate::contour::CellRanges;
use crate::contour::components::components;
use crate::contour::rounding::Rounding;
use crate::interpolant::TetrahedronCubics;

/// The parts of the boundary that are taken as lying on the level.
#[derive(Debug, Default)]
pub struct Walls {
    /// Triples of points, ascending, sorted.
    faces: Vec<[u32; 3]>,
    /// Their edges: pairs of points, lower first, sorted.
    edges: Vec<[u32; 2]>,
    /// For each of their points, how the solution rises from there into the domain.
    rises: HashMap<u32, f64>,
    /// How far from the level the value at one of their points is at most.
    distance: f64,
}

/// How far the inner coefficients of a wall may be from the level, as a part of the spread of
/// its cell; as for lines.
const OF_WALL: f64 = 0.25;

/// A slope off a wall that is less than this part of the values beside it counts as none, as
/// where two walls meet: then these values say on which side of it the solution lies.
const NO_SLOPE: f64 = 1e-2;

/// The coefficients of a cubic whose slope off a wall is one sum to some five times what those
/// next to a point do.
const OF_ALL: f64 = 0.2;

/// A face of the boundary that may be on a wall, by the values at its corners.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    face: [u32; 3],
    area: f64,
    /// How far from the level the value at a corner is at most.
    distance: f64,
    /// Whether its corners are on the level without regard to the rest of a wall.
    is_on_level: bool,
    /// Whether its inner coefficients are near enough to the level.
    is_near: bool,
    /// Whether the surface runs beside it, inside the cell, all along.
    is_followed: bool,
}

impl Walls {
    /// The walls on a level, among the cells that are active there.
    ///
    /// Faces without a point inside are no wall: few points of the same value are what a solution
    /// has that is symmetric. A wall that the surface follows inside the cells all
    /// along, as the ball around a hole, is left to it.
    ///
    /// A wall has one value, and is taken as a whole: it is on the level if the greater part of its
    /// area is by itself. A first call, with a band without width, finds faces that are; a second,
    /// with a band as wide as their [`distance`](Self::distance) and the cells in it, the whole.
    pub fn new(
        interpolant: &dyn TetrahedronCubics,
        ranges: &CellRanges,
        rounding: &Rounding,
        cells: &[u32],
    ) -> Self {
        let mut candidates: Vec<Candidate> = cells
            .par_iter()
            .flat_map_iter(|&cell| candidates(interpolant, rounding, cell as usize))
            .collect();
        candidates.par_sort_unstable_by_key(|candidate| candidate.face);
        let alone = candidates.chunk_by(|a, b| a.face == b.face);
        let mut lone: Vec<Candidate> =
            alone.filter(|sides| sides.len() == 1).map(|sides| sides[0]).collect();
        remove_faces_of_left_out_cells(&mut lone, interpolant, ranges);
        let found = walls_among(&lone);
        if found.is_empty() {
            return Self::default();
        }
        let distance = found.iter().map(|face| face.distance).fold(0.0, f64::max);
        let faces: Vec<[u32; 3]> = found.into_iter().map(|found| found.face).collect();
        let mut edges: Vec<[u32; 2]> = faces.iter().flat_map(|&face| edges_of(face)).collect();
        edges.sort_unstable();
        edges.dedup();
        let mut walls = Self { faces, edges, rises: HashMap::new(), distance };
        walls.rises = walls.rises_from(interpolant, rounding.level(), cells);
        walls
    }

    /// How far from the level the value at a point of a wall is at most: cells that are so near
    /// to the level may be at a wall as well.
    pub fn distance(&self) -> f64 {
        self.distance
    }

    /// How the solution rises from the corners of a cell into the domain, for those that are on
    /// a wall.
    pub fn rises(&self, points: [u32; 4]) -> [f64; 4] {
        points.map(|point| self.rises.get(&point).copied().unwrap_or(0.0))
    }

    /// A cubic less the level, put on the level where the cell has walls, and with a slope that
    /// is linear along their edges. `points` are the corners of the cell, ascending.
    pub fn applied(&self, points: [u32; 4], cubic: TetrahedronCubic) -> TetrahedronCubic {
        if !points.iter().any(|point| self.rises.contains_key(point)) {
            return cubic;
        }
        let mut walled = TetrahedronCubic::from_coefficients(|exponents| {
            let is_on_wall = self.holds(points, exponents);
            if is_on_wall { 0.0 } else { cubic.coefficient(exponents) }
        });
        for opposite in 0..4 {
            if let Some(amid) = self.amid_face(points, &walled, opposite) {
                walled.coefficients[TetrahedronCubic::FACES[opposite]] = amid;
            }
        }
        walled
    }

    /// Whether all edges of a face are in walls, but the face is not.
    pub fn surround(&self, face: [u32; 3]) -> bool {
        !self.has_face(face) && edges_of(face).into_iter().all(|edge| self.has_edge(edge))
    }

    /// Whether the coefficient with the given exponents belongs to a wall.
    fn holds(&self, points: [u32; 4], exponents: [usize; 4]) -> bool {
        let mut corners = points.into_iter().zip(exponents).filter(|(_, e)| *e > 0).map(|(p, _)| p);
        match [corners.next(), corners.next(), corners.next()] {
            [Some(a), None, None] => self.rises.contains_key(&a),
            [Some(a), Some(b), None] => self.has_edge([a, b]),
            [Some(a), Some(b), Some(c)] => self.has_face([a, b, c]),
            _ => false,
        }
    }

    /// The coefficient amid a face with which the slope is linear along its edges in walls;
    /// nothing if it has none, or is a wall itself.
    fn amid_face(
        &self,
        points: [u32; 4],
        cubic: &TetrahedronCubic,
        opposite: usize,
    ) -> Option<f64> {
        let corners = TetrahedronCubic::FACE_VERTICES[opposite];
        if self.has_face(corners.map(|n| points[n])) {
            return None;
        }
        let [a, b, c] = corners;
        let (mut sum, mut count) = (0.0, 0);
        for [low, high, beside] in [[a, b, c], [a, c, b], [b, c, a]] {
            if self.has_edge([points[low], points[high]]) {
                let toward = |from: usize| cubic.edge([from, beside]).coefficients[1];
                sum += 0.5 * (toward(low) + toward(high));
                count += 1;
            }
        }
        (count > 0).then(|| sum / f64::from(count))
    }

    fn has_edge(&self, edge: [u32; 2]) -> bool {
        self.edges.binary_search(&edge).is_ok()
    }

    fn has_face(&self, face: [u32; 3]) -> bool {
        self.faces.binary_search(&face).is_ok()
    }

    /// For each point of the walls, the mean of the coefficients next to it, or, where these
    /// vanish, of all in its cells.
    fn rises_from(
        &self,
        interpolant: &dyn TetrahedronCubics,
        level: f64,
        cells: &[u32],
    ) -> HashMap<u32, f64> {
        let mut points: Vec<u32> = self.faces.iter().flatten().copied().collect();
        points.sort_unstable();
        points.dedup();
        let mut sums: HashMap<u32, [f64; 2]> = points.into_iter().map(|p| (p, [0.0; 2])).collect();
        for &cell in cells {
            let points = interpolant.mesh().tetrahedra()[cell as usize];
            if !points.iter().any(|point| sums.contains_key(point)) {
                continue;
            }
            let cubic = interpolant.cubic(cell as usize).minus(level);
            let all: f64 = cubic.coefficients.iter().sum();
            for (corner, point) in points.into_iter().enumerate() {
                if let Some([next_sum, all_sum]) = sums.get_mut(&point) {
                    let inward = (0..4).filter(|&n| {
                        let (low, high) = (point.min(points[n]), point.max(points[n]));
                        n != corner && !self.has_edge([low, high])
                    });
                    let next = inward.map(|n| cubic.edge([corner, n]).coefficients[1]);
                    *next_sum += next.sum::<f64>();
                    *all_sum += OF_ALL * all;
                }
            }
        }
        let rise =
            |[next, all]: [f64; 2]| if next.abs() > NO_SLOPE * all.abs() { next } else { all };
        sums.into_iter().map(|(point, sums)| (point, rise(sums))).collect()
    }
}

/// The faces of a cell that may be on a wall; none of a plateau, which is exact as it is.
fn candidates(
    interpolant: &dyn TetrahedronCubics,
    rounding: &Rounding,
    cell: usize,
) -> impl Iterator<Item = Candidate> {
    let points = interpolant.mesh().tetrahedra()[cell];
    let cubic = interpolant.cubic(cell);
    let is_plateau = less_level(&cubic, points, rounding).coefficients == [0.0; 20];
    let values = cubic.vertices();
    let may_be_on_wall = [0, 1, 2, 3].map(|n| rounding.may_be_on_wall(points[n], values[n]));
    let count = may_be_on_wall.iter().filter(|may_be| **may_be).count();
    let is_candidate = move |&n: &usize| count == 4 || (count == 3 && !may_be_on_wall[n]);
    let opposite = (0..4).filter(move |n| !is_plateau && is_candidate(n));
    opposite.map(move |opposite| candidate(interpolant, rounding, cell, opposite))
}

fn candidate(
    interpolant: &dyn TetrahedronCubics,
    rounding: &Rounding,
    cell: usize,
    opposite: usize,
) -> Candidate {
    let (mesh, cubic) = (interpolant.mesh(), interpolant.cubic(cell));
    let (points, values) = (mesh.tetrahedra()[cell], cubic.vertices());
    let corners = TetrahedronCubic::FACE_VERTICES[opposite];
    let mut face = corners.map(|n| points[n]);
    face.sort_unstable();
    let [a, b, c] = corners.map(|n| mesh.corners(cell)[n]);
    let (low, high) = cubic.bounds();
    let whole = cubic.minus(rounding.level());
    let on_face = whole.face(corners).coefficients;
    let inner = || (0..10).filter(|n| ![0, 6, 9].contains(n)).map(|n| on_face[n]);
    let beside = side(&whole, opposite);
    Candidate {
        face,
        area: 0.5 * (b - a).cross(&(c - a)).norm(),
        distance: corners.map(|n| whole.vertices()[n].abs()).into_iter().fold(0.0, f64::max),
        is_on_level: corners.iter().all(|&n| rounding.is_on_level(points[n], values[n])),
        is_near: inner().all(|value| value.abs() <= OF_WALL * (high - low)),
        is_followed: inner().all(|value| value * beside < 0.0),
    }
}

/// On which side of the level a cell is, beside a face that is taken as zero: positive above,
/// negative below.
fn side(whole: &TetrahedronCubic, opposite: usize) -> f64 {
    let mut sums = [0.0; 4];
    TetrahedronCubic::from_coefficients(|exponents| {
        sums[exponents[opposite]] += whole.coefficient(exponents);
        0.0
    });
    sums.into_iter().skip(1).find(|sum| *sum != 0.0).unwrap_or(0.0)
}

/// A face beside a cell that is left out (a ghost, or one without values) is inside the domain,
/// although one cell alone has a surface.
fn remove_faces_of_left_out_cells(
    candidates: &mut Vec<Candidate>,
    interpolant: &dyn TetrahedronCubics,
    ranges: &CellRanges,
) {
    if candidates.is_empty() || !ranges.leaves_out_any() {
        return;
    }
    let cells = interpolant.mesh().tetrahedra().iter().enumerate();
    let left_out = cells.filter(|(cell, _)| ranges.leaves_out(*cell));
    let faces = left_out.flat_map(|(_, points)| {
        TetrahedronCubic::FACE_VERTICES.map(|corners| {
            let mut face = corners.map(|n| points[n]);
            face.sort_unstable();
            face
        })
    });
    let mut inside: Vec<[u32; 3]> = faces.collect();
    inside.sort_unstable();
    candidates.retain(|candidate| inside.binary_search(&candidate.face).is_err());
}

/// The faces that are walls: those near the level that hang together by their edges, if they
/// have a point inside, the greater part of their area is on the level, and the surface does not
/// follow all of them; and those between points of walls, however far the cubic weaves there.
fn walls_among(candidates: &[Candidate]) -> Vec<Candidate> {
    let near: Vec<Candidate> = candidates.iter().filter(|c| c.is_near).copied().collect();
    let component = components(near.len(), |n| edges_of(near[n].face));
    let rim = rim(&near);
    let mut has_inside = vec![false; near.len()];
    let mut followed = vec![true; near.len()];
    let (mut area, mut on_level) = (vec![0.0; near.len()], vec![0.0; near.len()]);
    for (candidate, &component) in near.iter().zip(&component) {
        area[component] += candidate.area;
        on_level[component] += if candidate.is_on_level { candidate.area } else { 0.0 };
        has_inside[component] |= candidate.face.iter().any(|point| !rim.contains(point));
        followed[component] &= candidate.is_followed;
    }
    let is_wall = |component: usize| {
        let is_on_level = 2.0 * on_level[component] >= area[component];
        is_on_level && has_inside[component] && !followed[component]
    };
    let of_walls = near.iter().zip(component).filter(|(_, component)| is_wall(*component));
    let points: HashSet<u32> = of_walls.flat_map(|(candidate, _)| candidate.face).collect();
    let is_between = |c: &&Candidate| c.face.iter().all(|point| points.contains(point));
    candidates.iter().filter(is_between).copied().collect()
}

/// The ends of edges that only one of the faces has.
fn rim(candidates: &[Candidate]) -> HashSet<u32> {
    let mut edges: Vec<[u32; 2]> = candidates.iter().flat_map(|c| edges_of(c.face)).collect();
    edges.sort_unstable();
    edges.chunk_by(|a, b| a == b).filter(|same| same.len() == 1).flat_map(|same| same[0]).collect()
}

fn edges_of([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [a, c], [b, c]]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn candidate(face: [u32; 3], is_followed: bool) -> Candidate {
        let (area, distance) = (1.0, 0.0);
        Candidate { face, area, distance, is_on_level: true, is_near: true, is_followed }
    }

    fn faces_among(candidates: &[Candidate]) -> Vec<[u32; 3]> {
        walls_among(candidates).into_iter().map(|found| found.face).collect()
    }

    /// Four faces around point 0.
    const AROUND: [[u32; 3]; 4] = [[0, 1, 2], [0, 1, 4], [0, 2, 3], [0, 3, 4]];

    #[test]
    fn faces_around_a_point_are_walls_and_a_strip_is_not() {
        let strip = [[5, 6, 7], [6, 7, 8]];
        let faces: Vec<Candidate> =
            AROUND.iter().chain(&strip).map(|&face| candidate(face, false)).collect();
        assert_eq!(faces_among(&faces), AROUND);
    }

    #[test]
    fn a_wall_that_is_followed_all_along_is_left_to_the_surface() {
        assert!(faces_among(&AROUND.map(|face| candidate(face, true))).is_empty());
        let woven = AROUND.map(|face| candidate(face, face[1] == 1));
        assert_eq!(faces_among(&woven), AROUND);
        let far = Candidate { is_near: false, ..candidate([1, 2, 3], false) };
        let beside = Candidate { is_near: false, ..candidate([1, 2, 5], false) };
        let found = faces_among(&[&woven[..], &[far, beside]].concat());
        assert_eq!(found, [&AROUND[..], &[far.face]].concat());
    }

    #[test]
    fn a_wall_is_on_the_level_if_the_greater_part_of_its_area_is() {
        let off = Candidate { is_on_level: false, ..candidate(AROUND[0], false) };
        for (area, expected) in [(2.0, &AROUND[..]), (4.0, &[])] {
            let wall = AROUND.map(|face| candidate(face, false));
            let wall = [&[Candidate { area, ..off }], &wall[1..]].concat();
            assert_eq!(faces_among(&wall), expected);
        }
    }

    #[test]
    fn a_cell_at_a_wall_is_zero_there_and_its_slope_linear() {
        let walls = Walls {
            faces: vec![[0, 1, 2]],
            edges: vec![[0, 1], [0, 2], [1, 2]],
            rises: [(0, 1.0), (1, 1.0), (2, -1.0)].into(),
            distance: 0.0,
        };
        // points 0 and 2 are at the wall, 7 and 8 inside
        let cubic = TetrahedronCubic::from_coefficients(|e| e[2] as f64 + 10.0 * e[0] as f64);
        let walled = walls.applied([0, 2, 7, 8], cubic);
        assert_eq!(walled.edge([0, 1]).coefficients, [0.0; 4]);
        let slopes = [[0, 2], [1, 2]].map(|edge| walled.edge(edge).coefficients[1]);
        assert_eq!(slopes, [21.0, 1.0]);
        assert_eq!(walled.coefficient([1, 1, 1, 0]), 11.0);
        assert_eq!(walled.coefficient([1, 0, 1, 1]), cubic.coefficient([1, 0, 1, 1]));
        assert_eq!(walls.rises([0, 2, 7, 8]), [1.0, -1.0, 0.0, 0.0]);
        assert_eq!(walls.applied([5, 6, 7, 8], cubic), cubic);
        assert!(!walls.surround([0, 1, 2]) && !walls.surround([0, 1, 7]));
    }
}
