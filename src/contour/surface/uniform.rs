//! Patches with a fixed number of points on each side: the thesis' *nSide*.

use super::lattice;
use super::patch::{Patch, Ray};
use super::tessellation::{Tessellation, corners};
use crate::mesh::Vector;

/// Adds the triangles of a patch with `points` points on each side, two at least
/// (thesis, table 5.9): `(n - 1)²` triangles, or `2 (n - 1)²` of a four-sided patch.
pub fn tessellate(patch: &Patch, points: u32, tessellation: &mut Tessellation) {
    let sides = points - 1;
    match corners(patch)[..] {
        [a, b, c] => three_sided(patch, [a, b, c], sides, tessellation),
        [a, b, c, d] => four_sided(patch, [a, b, c, d], sides, tessellation),
        _ => {}
    }
}

fn three_sided(patch: &Patch, corners: [Ray; 3], sides: u32, tessellation: &mut Tessellation) {
    let [a, b, c] = corners;
    let first = tessellation.points.len() as u32;
    for [of_a, of_b, of_c] in lattice::points(sides) {
        tessellation.add_point(patch, &mean(&[(of_a, a), (of_b, b), (of_c, c)], sides));
    }
    tessellation.triangles.extend(lattice::triangles(sides, first));
}

fn four_sided(patch: &Patch, corners: [Ray; 4], sides: u32, tessellation: &mut Tessellation) {
    let [a, b, c, d] = corners;
    let first = tessellation.points.len() as u32;
    for i in 0..=sides {
        let back = sides - i;
        for j in 0..=sides {
            let left = sides - j;
            let terms = [(back * left, a), (back * j, b), (i * j, c), (i * left, d)];
            tessellation.add_point(patch, &mean(&terms, sides * sides));
        }
    }
    let at = |i: u32, j: u32| first + i * (sides + 1) + j;
    for i in 0..sides {
        for j in 0..sides {
            let around = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            add_quadrilateral(around, tessellation);
        }
    }
}

fn add_quadrilateral(around: [u32; 4], tessellation: &mut Tessellation) {
    let triangles = cut(around.map(|n| tessellation.points[n as usize].position));
    tessellation.triangles.extend(triangles.map(|triangle| triangle.map(|n| around[n])));
}

/// The triangles of a quadrilateral, as places of its corners: cut by its shorter diagonal; by the
/// other one if a triangle would have no area, as where three corners are on an edge of the mesh
/// that is on the level.
pub fn cut(corners: [Vector; 4]) -> [[usize; 3]; 2] {
    let length = |n: usize, m: usize| (corners[m] - corners[n]).norm_squared();
    let have_area = |triangles: [[usize; 3]; 2]| {
        triangles.iter().all(|[a, b, c]| {
            let [along, across] = [b, c].map(|&n| corners[n] - corners[*a]);
            along.cross(&across) != Vector::zeros()
        })
    };
    let (one, other) = ([[0, 1, 2], [0, 2, 3]], [[0, 1, 3], [1, 2, 3]]);
    let [shorter, longer] = if length(0, 2) <= length(1, 3) { [one, other] } else { [other, one] };
    if have_area(shorter) || !have_area(longer) { shorter } else { longer }
}

/// The weighted mean of rays. The weights are whole numbers with the sum `total`, so the
/// mean has the same bits in whatever order or way it is reached.
fn mean(terms: &[(u32, Ray)], total: u32) -> Ray {
    [0, 1, 2, 3].map(|n| {
        let sum: f64 = terms.iter().map(|(weight, ray)| f64::from(*weight) * ray[n]).sum();
        sum / f64::from(total)
    })
}
