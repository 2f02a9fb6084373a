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
    let (above, below) = (patch.group(Sign::Above), patch.group(Sign::Below));
    let ray = |n: usize, m: usize| -> Ray {
        let mut ray = [0.0; 4];
        ray[n] = 1.0;
        ray[m] = 1.0;
        ray
    };
    let mut corners = match (&above[..], &below[..]) {
        (&[apex], &[b, c, d]) => ArrayVec::from_iter([ray(apex, b), ray(apex, c), ray(apex, d)]),
        (&[b, c, d], &[apex]) => ArrayVec::from_iter([ray(apex, b), ray(apex, d), ray(apex, c)]),
        (&[a, b], &[c, d]) => ArrayVec::from_iter([ray(a, c), ray(a, d), ray(b, d), ray(b, c)]),
        // unresolved, with all vertices on one side
        _ => return ArrayVec::new(),
    };
    // the orders above are those of a right-handed tetrahedron whose vertices are listed so
    let listed: ArrayVec<usize, 4> = match below.len() {
        1 => below.iter().chain(&above).copied().collect(),
        _ => above.iter().chain(&below).copied().collect(),
    };
    if patch.piece.right_handed != is_even(&listed) {
        corners[1..].reverse();
    }
    corners
}
