//! Surfaces as fine as a tolerance asks, and no finer.
//!
//! A side of a triangle is divided where it is farther from the level set than the tolerance,
//! and with it the longest side, which keeps triangles in shape; where a triangle is too far
//! inside, its longest side alone. Sides are marked first and divided then, in all triangles
//! that have them: so the surface stays closed whatever the sizes on both sides. The new point
//! is where the ray half way crosses the level.
//!
//! The distance is that to the level set, along the slope, and not that to the curve
//! in which the surface meets a face: where these are nearly tangent the curve winds
//! within the surface, and following it would gain nothing.

use rustc_hash::{FxHashMap as HashMap, FxHashSet};

use arrayvec::ArrayVec;
use rayon::prelude::*;

use super::cell::Cell;
use super::far_cells;
use super::owner::Owner;
use super::patch::{Patch, PatchPoint, Ray};
use super::piece::Piece;
use super::polygons::Polygons;
use super::tessellation::Tessellation;
use super::uniform::tessellate;
use crate::bernstein::{Barycentric4, between};
use crate::interpolant::TetrahedronCubics;
use crate::interruption::checkpoint;
use crate::mesh::{TetrahedronFrame, Vector};

/// A triangle of a patch.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    /// Its corners, as places among the points of the surface.
    pub corners: [u32; 3],
    /// The patch, by the place of its piece; nothing in a face that lies on the level.
    pub piece: Option<u32>,
    /// The rays of its corners.
    pub rays: [Ray; 3],
    /// Where its corners are in the cell.
    pub at: [Barycentric4; 3],
    /// The cell, as a place among those that are active.
    pub cell: u32,
}

impl Facet {
    /// A point inside, by the weights of the corners.
    fn inside(&self, weights: &[f64; 3]) -> Barycentric4 {
        let [a, b, c] = &self.at;
        [0, 1, 2, 3].map(|n| weights[0] * a[n] + weights[1] * b[n] + weights[2] * c[n])
    }
}

/// The sides of a triangle, by the places of their ends; side `n` is opposite corner `n`.
const SIDES: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];

/// Where a triangle is looked at inside: its middle, and between that and the corners.
const INSIDE: [[f64; 3]; 4] = [[1.0 / 3.0; 3], [0.6, 0.2, 0.2], [0.2, 0.6, 0.2], [0.2, 0.2, 0.6]];

/// A side of which no weight differs by more than this from end to end is not divided
/// further.
const SHORTEST: f64 = 1.0 / 256.0;

/// A way along which a weight changes by more than this leads so many times across its cell that
/// rounding, which grows with the third power, counts there.
const FARTHEST: f64 = 1e3;

/// Rounds of divisions: a side is then at its shortest, if it was divided in each other one.
const MAX_ROUNDS: usize = 16;

/// The surface of one level in the making.
pub struct Refinement<'a> {
    /// The interpolant.
    pub interpolant: &'a dyn TetrahedronCubics,
    /// The level.
    pub level: f64,
    /// The active cells but for simple ones.
    pub cells: &'a mut Vec<Cell>,
    /// The pieces.
    pub pieces: &'a mut Vec<Piece>,
    /// The simple cells, which are near enough, unless sides of theirs are divided.
    pub polygons: &'a mut Polygons,
    /// How far a triangle may be from the level set.
    pub tolerance: f64,
    /// The triangles.
    pub facets: Vec<Facet>,
    /// Points that were added, numbered from `first_point` on, and their cells.
    pub points: Vec<(PatchPoint, u32)>,
    /// The number of the first point that is added.
    pub first_point: u32,
    /// Points that are vertices on the level, or on edges that lie on it.
    pub on_level: FxHashSet<u32>,
    /// Triangles that are not as fine as asked, because they would be too small.
    pub coarse: usize,
}

/// What tells a side from all others. All triangles that have it give it the same name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
struct SideName {
    /// Its ends, ascending.
    ends: [u32; 2],
    /// The vertices of the edge, face or piece in which it runs, ascending, if an end is on the
    /// level: parts of the surface may fall together there, and sides with the same ends be
    /// different curves.
    within: [u32; 4],
}

/// Stands for no vertex.
const NONE: u32 = u32::MAX;

/// What a triangle asks for.
enum Wish {
    /// Nothing: it is near enough.
    Nothing,
    /// Its sides to be divided.
    Sides([bool; 3]),
    /// What it cannot have: its sides are the shortest there are.
    Refused,
}

impl Refinement<'_> {
    /// Divides triangles until all are near enough.
    pub fn run(&mut self) {
        let mut is_new = vec![true; self.facets.len()];
        for _ in 0..MAX_ROUNDS {
            let wishes: Vec<Wish> = self
                .facets
                .par_iter()
                .zip(&is_new)
                .inspect(|_| checkpoint())
                .map(|(facet, new)| if *new { self.wish(facet) } else { Wish::Nothing })
                .collect();
            let marked = self.marked(&wishes);
            self.wake(&marked);
            let middles = self.middles(&marked);
            self.coarse += wishes.iter().filter(|wish| matches!(wish, Wish::Refused)).count();
            if middles.is_empty() {
                return;
            }
            is_new = self.divide(&middles);
        }
        self.coarse += is_new.iter().filter(|new| **new).count();
    }

    /// Which sides of a triangle it wants to be divided.
    fn wish(&self, facet: &Facet) -> Wish {
        // a face on the level is exact; where nothing is certain, no division makes it so
        let is_certified = |piece: u32| self.pieces[piece as usize].is_certified;
        if !facet.piece.is_some_and(is_certified) {
            return Wish::Nothing;
        }
        let cell = &self.cells[facet.cell as usize];
        let longest = longest_side(cell, facet);
        // all of it is as near to a corner, and corners are exact; so small, slopes may be rounding
        if side_length(cell, facet, longest) <= self.tolerance {
            return Wish::Nothing;
        }
        let frame = TetrahedronFrame::new(cell.corners);
        let is_far = |at: &Barycentric4| self.is_far(cell, &frame, at);
        let side_is_far = |[i, j]: [usize; 2]| {
            [0.25, 0.5, 0.75].iter().any(|&t| is_far(&between(&facet.at[i], &facet.at[j], t)))
        };
        let mut wanted = SIDES.map(side_is_far);
        let is_near = wanted == [false; 3];
        if is_near && !INSIDE.iter().any(|weights| is_far(&facet.inside(weights))) {
            return Wish::Nothing;
        }
        // always: else slivers come of slivers, and one far side of another without end
        wanted[longest] = true;
        let possible = [0, 1, 2].map(|side| wanted[side] && is_long(facet, side));
        if possible == [false; 3] { Wish::Refused } else { Wish::Sides(possible) }
    }

    /// Whether a point may be farther from the level set than the tolerance: the level is not
    /// met within that along the steepest way to it. A value that may be rounding is on the level:
    /// where the cubic touches the level the sign need not change, and the slope is rounding too.
    ///
    /// In a sliver far thinner than the tolerance that way leads so far outside that the cubic is
    /// all rounding there, and in a cell without volume there is none: their neighbours decide.
    fn is_far(&self, cell: &Cell, frame: &TetrahedronFrame, at: &Barycentric4) -> bool {
        let value = cell.cubic.value(at);
        if value.abs() <= cell.noise {
            return false;
        }
        let slope = frame.gradient(&cell.cubic.barycentric_gradient(at));
        let way = direction(&slope) * (-value.signum() * self.tolerance);
        let step = frame.barycentric_direction(&way);
        if frame.is_degenerate() || step.iter().any(|change| change.abs() > FARTHEST) {
            return false;
        }
        let line = cell.cubic.restrict(at, &[0, 1, 2, 3].map(|n| at[n] + step[n]));
        let [.., end] = line.coefficients;
        if end * value < 0.0 {
            // nearly always: it crosses the level, wherever
            return false;
        }
        let is_one_signed = line.coefficients.iter().all(|c| c * value > 0.0);
        is_one_signed || line.roots().as_slice().is_empty()
    }

    /// The sides that are to be divided, each once, with a triangle that has it and its place
    /// there.
    fn marked(&self, wishes: &[Wish]) -> Vec<(SideName, usize, usize)> {
        let mut marked: Vec<(SideName, usize, usize)> = Vec::new();
        for (place, wish) in wishes.iter().enumerate() {
            if let Wish::Sides(sides) = wish {
                for side in (0..3).filter(|&side| sides[side]) {
                    marked.push((self.name(&self.facets[place], side), place, side));
                }
            }
        }
        marked.sort_unstable();
        marked.dedup_by_key(|(name, ..)| *name);
        marked
    }

    /// Adds the triangles of simple cells with sides that are to be divided.
    fn wake(&mut self, marked: &[(SideName, usize, usize)]) {
        let sides = marked.iter().map(|(name, ..)| name);
        let off_level = sides.filter(|name| name.within == [NONE; 4]).map(|name| name.ends);
        let woken = self.polygons.wake(off_level);
        for cell in far_cells(self.interpolant, self.level, &woken) {
            let place = self.cells.len() as u32;
            let piece = Piece { is_certified: true, ..Piece::whole(&cell, place) };
            let mut patch = Tessellation::default();
            tessellate(&Patch { cell: &cell, piece: &piece }, 2, &mut patch);
            let facets = patch.triangles.iter().map(|triangle| {
                let points = triangle.map(|point| &patch.points[point as usize]);
                Facet {
                    corners: points
                        .map(|point| self.polygons.crossing(&point.owner).unwrap_or(NONE)),
                    piece: Some(self.pieces.len() as u32),
                    rays: triangle.map(|point| patch.rays[point as usize]),
                    at: points.map(|point| point.at),
                    cell: place,
                }
            });
            self.facets.extend(facets.collect::<ArrayVec<Facet, 2>>());
            self.cells.push(cell);
            self.pieces.push(piece);
        }
    }

    /// The middles of sides that are to be divided, as new points.
    fn middles(&mut self, marked: &[(SideName, usize, usize)]) -> HashMap<SideName, u32> {
        let found: Vec<PatchPoint> = marked
            .par_iter()
            .map(|&(_, place, side)| self.middle(&self.facets[place], side).1)
            .collect();
        let mut middles = HashMap::with_capacity_and_hasher(marked.len(), Default::default());
        for (&(name, place, _), point) in marked.iter().zip(found) {
            // a ray that ends on the level leads to a point that is there already
            if point.owner.is_on_level() {
                self.coarse += 1;
            } else {
                middles.insert(name, self.first_point + self.points.len() as u32);
                self.points.push((point, self.facets[place].cell));
            }
        }
        middles
    }

    fn name(&self, facet: &Facet, side: usize) -> SideName {
        let corners = SIDES[side];
        let [a, b] = corners.map(|corner| facet.corners[corner]);
        let mut within = [NONE; 4];
        if let (Some(piece), true) = (facet.piece, [a, b].iter().any(|n| self.on_level.contains(n)))
        {
            let [from, to] = corners.map(|corner| facet.rays[corner]);
            for n in (0..4).filter(|&n| from[n] != 0.0 || to[n] != 0.0) {
                within[n] = self.pieces[piece as usize].vertices[n];
            }
            within.sort_unstable();
        }
        SideName { ends: [a.min(b), a.max(b)], within }
    }

    /// The middle of a side: its ray, and where that crosses the level.
    fn middle(&self, facet: &Facet, side: usize) -> (Ray, PatchPoint) {
        let [i, j] = SIDES[side];
        let ray = between(&facet.rays[i], &facet.rays[j], 0.5);
        let cell = &self.cells[facet.cell as usize];
        let point = match facet.piece {
            Some(piece) => Patch { cell, piece: &self.pieces[piece as usize] }.point(&ray),
            None => {
                let at = between(&facet.at[i], &facet.at[j], 0.5);
                PatchPoint { owner: Owner::Patch, at, position: cell.position(&at) }
            }
        };
        (ray, point)
    }

    /// Divides all triangles with the given sides; returns which of the triangles are new.
    fn divide(&mut self, middles: &HashMap<SideName, u32>) -> Vec<bool> {
        let facets = std::mem::take(&mut self.facets);
        let parts: Vec<(Facet, bool)> = facets
            .par_iter()
            .flat_map_iter(|facet| {
                let parts = self.parts(facet, middles);
                let is_new = parts.len() > 1;
                parts.into_iter().map(move |part| (part, is_new))
            })
            .collect();
        let (facets, is_new) = parts.into_iter().unzip();
        self.facets = facets;
        is_new
    }

    /// The parts of a triangle: one to four.
    fn parts(&self, facet: &Facet, middles: &HashMap<SideName, u32>) -> ArrayVec<Facet, 4> {
        let divided = [0, 1, 2].map(|side| middles.get(&self.name(facet, side)).copied());
        if divided == [None; 3] {
            return ArrayVec::from_iter([*facet]);
        }
        // corners, then middles of the sides opposite them
        let corner = |n: usize| (facet.corners[n], facet.rays[n], facet.at[n]);
        let mut points = [0, 1, 2, 0, 0, 0].map(corner);
        for side in 0..3 {
            if let Some(number) = divided[side] {
                let (ray, point) = self.middle(facet, side);
                points[3 + side] = (number, ray, point.at);
            }
        }
        let length = |i: usize, j: usize| {
            let cell = &self.cells[facet.cell as usize];
            (cell.position(&points[j].2) - cell.position(&points[i].2)).norm_squared()
        };
        let part = |[a, b, c]: [usize; 3]| Facet {
            corners: [points[a].0, points[b].0, points[c].0],
            rays: [points[a].1, points[b].1, points[c].1],
            at: [points[a].2, points[b].2, points[c].2],
            ..*facet
        };
        split(divided.map(|middle| middle.is_some()), length).into_iter().map(part).collect()
    }
}

/// The triangles into which one is split of whose sides one or more are divided: corners 0 to 2,
/// middles 3 to 5 of the sides opposite. Quadrilaterals are cut by their shorter diagonal.
fn split(divided: [bool; 3], length: impl Fn(usize, usize) -> f64) -> ArrayVec<[usize; 3], 4> {
    let mut parts = ArrayVec::new();
    match divided.iter().filter(|divided| **divided).count() {
        1 => {
            let a = divided.iter().position(|divided| *divided).unwrap_or(0);
            let (b, c, middle) = ((a + 1) % 3, (a + 2) % 3, a + 3);
            parts.extend([[a, b, middle], [a, middle, c]]);
        }
        2 => {
            // the corner between the two divided sides is cut off
            let a = divided.iter().position(|divided| !*divided).unwrap_or(0);
            let (b, c) = ((a + 1) % 3, (a + 2) % 3);
            let (of_b, of_c) = (b + 3, c + 3);
            parts.push([a, of_c, of_b]);
            if length(b, of_b) <= length(of_c, c) {
                parts.extend([[of_c, b, of_b], [b, c, of_b]]);
            } else {
                parts.extend([[of_c, b, c], [of_c, c, of_b]]);
            }
        }
        _ => parts.extend([[0, 5, 4], [1, 3, 5], [2, 4, 3], [3, 4, 5]]),
    }
    parts
}

/// The unit vector along another, whose squares may be too small or too large for numbers;
/// NaN for zero.
fn direction(vector: &Vector) -> Vector {
    (vector / vector.amax()).normalize()
}

fn is_long(facet: &Facet, side: usize) -> bool {
    let [a, b] = SIDES[side].map(|corner| &facet.rays[corner]);
    a.iter().zip(b).any(|(a, b)| (a - b).abs() > SHORTEST)
}

fn longest_side(cell: &Cell, facet: &Facet) -> usize {
    let length = |side: usize| side_length(cell, facet, side);
    (0..3).max_by(|&a, &b| length(a).total_cmp(&length(b))).unwrap_or(0)
}

fn side_length(cell: &Cell, facet: &Facet, side: usize) -> f64 {
    let [from, to] = SIDES[side].map(|corner| cell.position(&facet.at[corner]));
    (to - from).norm()
}
