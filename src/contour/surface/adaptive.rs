//! Patches as fine as a tolerance asks, and no finer.
//!
//! A side of a triangle is divided if it is farther than the tolerance from the surface,
//! as far as its own three quarter points tell. That is decided by the side alone, in the
//! same way by both patches if it lies in a face between them: so the surface stays closed
//! whatever the sizes on both sides. A triangle whose sides are near enough, but whose
//! middle is not, gets a point there.

use std::collections::HashMap;

use super::patch::{Patch, Ray};
use super::tessellation::{Tessellation, corners};
use crate::mesh::Vector;

/// A side of which no weight differs by more than this from end to end is not divided
/// further. It is a limit of the side's own, so both its patches observe it alike.
const SHORTEST: f64 = 1.0 / 1024.0;

/// Divisions of a triangle beyond which only its sides in faces are divided, and it gets
/// no point in its middle.
const MAX_DEPTH: u32 = 12;

/// The triangles of one patch in the making.
struct Refinement<'a, 'b> {
    patch: &'a Patch<'a>,
    tolerance: f64,
    tessellation: &'b mut Tessellation,
    /// The rays of the points, from `first_point` on.
    rays: Vec<Ray>,
    first_point: u32,
    /// What is known of each side: its middle point, if it must be divided.
    sides: HashMap<[u32; 2], Option<u32>>,
}

/// Adds the triangles of a patch, no point of which is much farther than `tolerance` from
/// the surface.
pub fn tessellate(patch: &Patch, tolerance: f64, tessellation: &mut Tessellation) {
    let first_point = tessellation.points.len() as u32;
    let (rays, sides) = (Vec::new(), HashMap::new());
    let mut refinement = Refinement { patch, tolerance, tessellation, rays, first_point, sides };
    let points: Vec<u32> = corners(patch).iter().map(|ray| refinement.add(ray)).collect();
    match points[..] {
        [a, b, c] => refinement.refine([a, b, c], 0),
        [a, b, c, d] => {
            let [first, second] = refinement.halves([a, b, c, d]);
            refinement.refine(first, 0);
            refinement.refine(second, 0);
        }
        _ => {}
    }
}

impl Refinement<'_, '_> {
    fn add(&mut self, ray: &Ray) -> u32 {
        self.rays.push(*ray);
        self.tessellation.add_point(self.patch, ray)
    }

    fn ray(&self, point: u32) -> &Ray {
        &self.rays[(point - self.first_point) as usize]
    }

    fn position(&self, point: u32) -> Vector {
        self.tessellation.points[point as usize].position
    }

    /// A triangle, divided by its sides and its middle until it is near enough.
    fn refine(&mut self, corners: [u32; 3], depth: u32) {
        let [a, b, c] = corners;
        let middles = [(a, b), (b, c), (c, a)].map(|(a, b)| self.middle(a, b, depth));
        let parts = match middles {
            [None, None, None] => {
                self.refine_middle(corners, depth);
                return;
            }
            [Some(m), None, None] => vec![[a, m, c], [m, b, c]],
            [None, Some(m), None] => vec![[b, m, a], [m, c, a]],
            [None, None, Some(m)] => vec![[c, m, b], [m, a, b]],
            [Some(m), Some(n), None] => self.corner_cut([a, b, c], m, n),
            [None, Some(m), Some(n)] => self.corner_cut([b, c, a], m, n),
            [Some(n), None, Some(m)] => self.corner_cut([c, a, b], m, n),
            [Some(m), Some(n), Some(o)] => vec![[a, m, o], [b, n, m], [c, o, n], [m, n, o]],
        };
        for part in parts {
            self.refine(part, depth + 1);
        }
    }

    /// A triangle with the sides around its second corner divided.
    fn corner_cut(&self, [a, b, c]: [u32; 3], before: u32, after: u32) -> Vec<[u32; 3]> {
        let [first, second] = self.halves([a, before, after, c]);
        vec![[before, b, after], first, second]
    }

    /// A quadrilateral, cut by its shorter diagonal.
    fn halves(&self, [a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
        let length = |n: u32, m: u32| (self.position(m) - self.position(n)).norm_squared();
        if length(a, c) <= length(b, d) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
    }

    /// A triangle whose sides are near enough: with a point in its middle if that is not.
    fn refine_middle(&mut self, [a, b, c]: [u32; 3], depth: u32) {
        let third = |n: usize| (self.ray(a)[n] + self.ray(b)[n] + self.ray(c)[n]) / 3.0;
        let ray = [0, 1, 2, 3].map(third);
        let middle = self.patch.point(&ray);
        let normal =
            (self.position(b) - self.position(a)).cross(&(self.position(c) - self.position(a)));
        let height = normal
            .try_normalize(0.0)
            .map_or(0.0, |normal| (middle.position - self.position(a)).dot(&normal).abs());
        if height <= self.tolerance || depth >= MAX_DEPTH {
            self.tessellation.coarse += usize::from(height > self.tolerance);
            self.tessellation.triangles.push([a, b, c]);
            return;
        }
        let middle = self.add(&ray);
        for part in [[a, b, middle], [b, c, middle], [c, a, middle]] {
            self.refine(part, depth + 1);
        }
    }

    /// The middle of a side, if it must be divided.
    fn middle(&mut self, a: u32, b: u32, depth: u32) -> Option<u32> {
        let name = [a.min(b), a.max(b)];
        if let Some(&known) = self.sides.get(&name) {
            return known;
        }
        let ray = half_way(self.ray(a), self.ray(b));
        let is_far = self.is_far(a, b, &ray);
        let is_inside = ray.iter().all(|weight| *weight > 0.0);
        let is_last = self.weight_length(a, b) <= SHORTEST || (is_inside && depth >= MAX_DEPTH);
        self.tessellation.coarse += usize::from(is_far && is_last);
        let middle = (is_far && !is_last).then(|| self.add(&ray));
        self.sides.insert(name, middle);
        middle
    }

    /// The greatest difference of a weight from one end of a side to the other.
    fn weight_length(&self, a: u32, b: u32) -> f64 {
        let differences = self.ray(a).iter().zip(self.ray(b)).map(|(a, b)| (a - b).abs());
        differences.fold(0.0, f64::max)
    }

    /// Whether the surface above a side is farther from it than the tolerance.
    fn is_far(&self, a: u32, b: u32, middle: &Ray) -> bool {
        // an order that does not depend on the patch: by the rays
        let (a, b) = if self.ray(a) < self.ray(b) { (a, b) } else { (b, a) };
        let rays = [half_way(self.ray(a), middle), *middle, half_way(middle, self.ray(b))];
        rays.iter().any(|ray| {
            let on_surface = self.patch.point(ray).position;
            distance_to_segment(&on_surface, &self.position(a), &self.position(b)) > self.tolerance
        })
    }
}

fn half_way(a: &Ray, b: &Ray) -> Ray {
    [0, 1, 2, 3].map(|n| 0.5 * (a[n] + b[n]))
}

fn distance_to_segment(point: &Vector, start: &Vector, end: &Vector) -> f64 {
    let along = end - start;
    let length = along.norm_squared();
    let t = if length > 0.0 { (point - start).dot(&along) / length } else { 0.0 };
    (point - (start + along * t.clamp(0.0, 1.0))).norm()
}
