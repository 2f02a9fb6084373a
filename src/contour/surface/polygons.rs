//! Simple cells as they are drawn: each is the polygon of the crossings of its edges.
//!
//! They share their sides with the triangles of other cells. Where a tolerance divides such a side,
//! the simple cell there has to be divided too: it is woken, and becomes one of the others.

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::contour_surface::ContourSurface;
use super::owner::Owner;
use super::simple::SimpleCells;
use super::uniform::cut;
use crate::interpolant::TetrahedronCubics;
use crate::interruption::checkpoint;

/// The polygons of simple cells, of which the points are in a surface and the triangles are not
/// yet.
#[derive(Debug, Default)]
pub struct Polygons {
    /// The numbers of the cells.
    cells: Vec<u32>,
    /// The corners of each, as places among the surface's points.
    corners: Vec<[u32; 4]>,
    /// Where the crossing of each edge is among the surface's points.
    crossings: FxHashMap<EdgeKey, u32>,
    /// Sides, by their ends, the lesser first, and the polygons that have them, sorted; empty until
    /// one is woken.
    at_sides: Vec<([u32; 2], u32)>,
    /// Which were woken.
    is_awake: Vec<bool>,
}

/// An edge of the mesh: its points' numbers in one, the lower first.
type EdgeKey = u64;

/// The key of an edge between points, the lower first.
fn edge_key(low: u32, high: u32) -> EdgeKey {
    u64::from(low) << 32 | u64::from(high)
}

/// The corner that a triangle has less than a quadrilateral.
const NONE: u32 = u32::MAX;

impl Polygons {
    /// Adds the crossings of the edges of simple cells to a surface.
    pub fn new(
        simple: &SimpleCells,
        interpolant: &dyn TetrahedronCubics,
        level: f64,
        surface: &mut ContourSurface,
    ) -> Self {
        let cells = simple.cells();
        let first = surface.points.len() as u32;
        let mut crossings = FxHashMap::default();
        crossings.reserve(cells.len());
        // of each crossing, a cell and the edge there
        let mut edges: Vec<(u32, [u8; 2])> = Vec::with_capacity(cells.len());
        let mut corners: Vec<[u32; 4]> = Vec::with_capacity(cells.len());
        for (place, cell) in cells.iter().enumerate() {
            let mut polygon = [NONE; 4];
            for (corner, &[low, high]) in polygon.iter_mut().zip(cell.edges()) {
                let key = edge_key(cell.points[low as usize], cell.points[high as usize]);
                *corner = *crossings.entry(key).or_insert_with(|| {
                    edges.push((place as u32, [low, high]));
                    first + edges.len() as u32 - 1
                });
            }
            corners.push(polygon);
        }
        let point = |&(place, edge): &(u32, [u8; 2])| {
            checkpoint();
            cells[place as usize].crossing(interpolant, level, edge)
        };
        surface.points.par_extend(edges.par_iter().map(point));
        let (cells, is_awake) =
            (cells.iter().map(|cell| cell.number).collect(), vec![false; cells.len()]);
        Self { cells, corners, crossings, at_sides: Vec::new(), is_awake }
    }

    /// Where a point is among the surface's points, if it is the crossing of an edge that a simple
    /// cell has.
    pub fn crossing(&self, point: &Owner) -> Option<u32> {
        match *point {
            Owner::Edge { low, high } => self.crossings.get(&edge_key(low, high)).copied(),
            _ => None,
        }
    }

    /// Wakes the cells that have one of some sides, given by their ends, the lesser first;
    /// returns their numbers.
    pub fn wake(&mut self, sides: impl Iterator<Item = [u32; 2]>) -> Vec<u32> {
        let mut sides = sides.peekable();
        if self.at_sides.is_empty() && sides.peek().is_some() {
            self.index_sides();
        }
        let mut woken = Vec::new();
        for side in sides {
            let first = self.at_sides.partition_point(|(other, _)| *other < side);
            let here = self.at_sides[first..].iter().take_while(|(other, _)| *other == side);
            for &(_, place) in here {
                if !std::mem::replace(&mut self.is_awake[place as usize], true) {
                    woken.push(self.cells[place as usize]);
                }
            }
        }
        woken
    }

    fn index_sides(&mut self) {
        for (place, corners) in self.corners.iter().enumerate() {
            let count = corners.iter().filter(|&&corner| corner != NONE).count();
            for n in 0..count {
                let ends = [corners[n], corners[(n + 1) % count]];
                let side = [ends[0].min(ends[1]), ends[0].max(ends[1])];
                self.at_sides.push((side, place as u32));
            }
        }
        self.at_sides.par_sort_unstable();
    }

    /// Adds the triangles of those that were not woken to the surface.
    pub fn add_triangles(&self, surface: &mut ContourSurface) {
        let polygons = self.corners.iter().zip(&self.cells).zip(&self.is_awake);
        for ((corners, cell), _) in polygons.filter(|(_, is_awake)| !**is_awake) {
            let first = surface.triangles.len();
            add_polygon(*corners, surface);
            let triangles = surface.triangles.len() - first;
            surface.cells.extend(std::iter::repeat_n(*cell, triangles));
        }
    }
}

/// Adds the triangles of a polygon.
fn add_polygon(around: [u32; 4], surface: &mut ContourSurface) {
    let [a, b, c, d] = around;
    if d == NONE {
        surface.triangles.push([a, b, c]);
    } else {
        let triangles = cut(around.map(|n| surface.points[n as usize].position));
        surface.triangles.extend(triangles.map(|triangle| triangle.map(|n| around[n])));
    }
}
