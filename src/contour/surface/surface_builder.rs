//! From the triangles of patches to one surface: shared points are stored once.

use std::collections::HashMap;

use super::cell::Cell;
use super::contour_surface::{ContourSurface, SurfacePoint};
use super::flat_faces::are_in_flat_face;
use super::owner::Owner;
use super::tessellation::Tessellation;

/// Adds the triangles of a level: those of patches, chunk by chunk, and those of faces that
/// lie on the level.
pub fn add_level(
    surface: &mut ContourSurface,
    cells: &[Cell],
    patches: &[Tessellation],
    flat_faces: &Tessellation,
) {
    let (first_point, first_triangle) = (surface.points.len(), surface.triangles.len());
    let mut builder = Builder { surface, cells, places: HashMap::new(), collapsed: false };
    for chunk in patches {
        builder.add(chunk, true);
    }
    builder.add(flat_faces, false);
    if builder.collapsed {
        drop_doubles(surface, first_triangle);
    }
    surface.level_points.push(first_point..surface.points.len());
    surface.level_triangles.push(first_triangle..surface.triangles.len());
}

struct Builder<'a> {
    surface: &'a mut ContourSurface,
    cells: &'a [Cell],
    /// Where the points are that patches share.
    places: HashMap<Owner, u32>,
    /// Whether some points of patches fell together on the level.
    collapsed: bool,
}

impl Builder<'_> {
    fn add(&mut self, chunk: &Tessellation, without_flat_faces: bool) {
        let places: Vec<u32> = (0..chunk.points.len()).map(|n| self.place(chunk, n)).collect();
        for triangle in &chunk.triangles {
            let [a, b, c] = triangle.map(|point| places[point as usize]);
            let corners = triangle.map(|point| &chunk.points[point as usize]);
            let cell = chunk.point_cells[triangle[0] as usize];
            let cell = &self.cells[cell as usize];
            if a == b || b == c || c == a {
                self.collapsed = true;
            } else if !(without_flat_faces && are_in_flat_face(cell, corners)) {
                self.surface.triangles.push([a, b, c]);
                self.surface.cells.push(cell.number);
            }
        }
    }

    /// Where a point is in the surface; added if it is new.
    fn place(&mut self, chunk: &Tessellation, n: usize) -> u32 {
        let point = &chunk.points[n];
        let next = self.surface.points.len() as u32;
        let place = match point.owner {
            Owner::Patch => next,
            owner => *self.places.entry(owner).or_insert(next),
        };
        if place == next {
            let cell = &self.cells[chunk.point_cells[n] as usize];
            self.surface.points.push(SurfacePoint {
                position: point.position,
                cell: cell.number,
                at: cell.in_mesh_order(&point.at),
            });
        }
        place
    }
}

/// Takes away pairs of triangles with the same corners and opposite fronts: what is left
/// of a thin part of the surface when its two sides fall together.
fn drop_doubles(surface: &mut ContourSurface, first: usize) {
    let mut named: Vec<([u32; 3], usize)> = surface.triangles[first..]
        .iter()
        .enumerate()
        .map(|(n, triangle)| {
            let mut name = *triangle;
            name.sort_unstable();
            (name, first + n)
        })
        .collect();
    named.sort_unstable();
    let mut dropped = vec![false; surface.triangles.len()];
    for same in named.chunk_by(|a, b| a.0 == b.0) {
        let kept = same.len() % 2;
        for (_, triangle) in &same[kept..] {
            dropped[*triangle] = true;
        }
    }
    let keep = |n: usize| !dropped[n];
    surface.triangles = kept(&surface.triangles, keep);
    surface.cells = kept(&surface.cells, keep);
}

fn kept<T: Copy>(all: &[T], keep: impl Fn(usize) -> bool) -> Vec<T> {
    all.iter().enumerate().filter(|(n, _)| keep(*n)).map(|(_, one)| *one).collect()
}
