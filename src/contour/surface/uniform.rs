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

/// Adds a quadrilateral, cut by its shorter diagonal; by the other one if a triangle would have no
/// area, as where three corners are on an edge of the mesh that is on the level.
fn add_quadrilateral([a, b, c, d]: [u32; 4], tessellation: &mut Tessellation) {
    let position = |n: u32| tessellation.points[n as usize].position;
    let length = |n: u32, m: u32| (position(m) - position(n)).norm_squared();
    let has_area = |from: u32, to: u32, beside: u32| {
        let [along, across] = [to, beside].map(|n| position(n) - position(from));
        along.cross(&across) != Vector::zeros()
    };
    let leaves_area = |from: u32, to: u32| {
        [a, b, c, d].iter().filter(|&&n| n != from && n != to).all(|&n| has_area(from, to, n))
    };
    let first_is_shorter = length(a, c) <= length(b, d);
    let [shorter, longer] = if first_is_shorter { [[a, c], [b, d]] } else { [[b, d], [a, c]] };
    let takes_shorter = leaves_area(shorter[0], shorter[1]) || !leaves_area(longer[0], longer[1]);
    if takes_shorter == first_is_shorter {
        tessellation.triangles.extend([[a, b, c], [a, c, d]]);
    } else {
        tessellation.triangles.extend([[a, b, d], [b, c, d]]);
    }
}

/// The weighted mean of rays. The weights are whole numbers with the sum `total`, so the
/// mean has the same bits in whatever order or way it is reached.
fn mean(terms: &[(u32, Ray)], total: u32) -> Ray {
    [0, 1, 2, 3].map(|n| {
        let sum: f64 = terms.iter().map(|(weight, ray)| f64::from(*weight) * ray[n]).sum();
        sum / f64::from(total)
    })
}
