//! Triangles of a patch.

use arrayvec::ArrayVec;

use super::cell::is_even;
use super::patch::{Patch, PatchPoint, Ray};
use crate::bernstein::Sign;

/// The triangles of some patches.
#[derive(Debug, Default)]
pub struct Tessellation {
    /// The points; each patch has its own.
    pub points: Vec<PatchPoint>,
    /// The ray of each point.
    pub rays: Vec<Ray>,
    /// The cell of each point, as a place among those that are active.
    pub point_cells: Vec<u32>,
    /// The triangles, as places in `points`, with the lower side in front.
    pub triangles: Vec<[u32; 3]>,
    /// For each patch, its piece and its first triangle; none for flat faces.
    pub patches: Vec<(u32, usize)>,
}

impl Tessellation {
    /// Adds a point of a patch.
    pub fn add_point(&mut self, patch: &Patch, ray: &Ray) -> u32 {
        self.points.push(patch.point(ray));
        self.rays.push(*ray);
        self.point_cells.push(patch.piece.cell);
        self.points.len() as u32 - 1
    }
}

/// The corners of a patch: rays along the edges of its piece, in an order that has the
/// lower side of the level in front. Three, or four around a quadrilateral.
pub fn corners(patch: &Patch) -> ArrayVec<Ray, 4> {
    let edges = corner_edges(patch.piece.signs, patch.piece.right_handed);
    let ray = |edge: [usize; 2]| {
        let mut ray = [0.0; 4];
        edge.into_iter().for_each(|vertex| ray[vertex] = 1.0);
        ray
    };
    edges.into_iter().map(ray).collect()
}

/// The edges around a patch in that order, given the sides of the vertices, and whether these are
/// those of a right-handed tetrahedron. None if all are on one side, as in what is unresolved.
pub fn corner_edges(signs: [Sign; 4], right_handed: bool) -> ArrayVec<[usize; 2], 4> {
    let group = |side| (0..4).filter(|&n| signs[n] == side).collect::<ArrayVec<usize, 4>>();
    let (above, below) = (group(Sign::Above), group(Sign::Below));
    let mut edges = match (&above[..], &below[..]) {
        (&[apex], &[b, c, d]) => ArrayVec::from_iter([[apex, b], [apex, c], [apex, d]]),
        (&[b, c, d], &[apex]) => ArrayVec::from_iter([[apex, b], [apex, d], [apex, c]]),
        (&[a, b], &[c, d]) => ArrayVec::from_iter([[a, c], [a, d], [b, d], [b, c]]),
        _ => return ArrayVec::new(),
    };
    // the orders above are those of a right-handed tetrahedron whose vertices are listed so
    let listed: ArrayVec<usize, 4> = match below.len() {
        1 => below.iter().chain(&above).copied().collect(),
        _ => above.iter().chain(&below).copied().collect(),
    };
    if right_handed != is_even(&listed) {
        edges[1..].reverse();
    }
    edges
}
