//! From the triangles of patches to one surface: shared points are stored once.

use rustc_hash::{FxHashMap, FxHashSet};

use super::cell::{Cell, is_even};
use super::contour_surface::{ContourSurface, SurfacePoint};
use super::flat_faces::is_in_flat_face;
use super::owner::Owner;
use super::patch::PatchPoint;
use super::piece::Piece;
use super::polygons::Polygons;
use super::refinement::{Facet, Refinement};
use super::simple::SimpleCells;
use super::tessellation::Tessellation;
use crate::interpolant::TetrahedronCubics;

/// A level's cells and pieces, and how far triangles may be from it, if that decides how
/// fine they are.
pub struct Level<'a> {
    /// The interpolant.
    pub interpolant: &'a dyn TetrahedronCubics,
    /// The level.
    pub level: f64,
    /// The simple cells, which have no pieces.
    pub simple: &'a SimpleCells,
    /// The other active cells.
    pub cells: Vec<Cell>,
    /// The pieces.
    pub pieces: Vec<Piece>,
    /// The tolerance.
    pub tolerance: Option<f64>,
}

/// Adds the triangles of a level: those of patches, chunk by chunk, and those of faces that
/// lie on the level.
pub fn add_level(
    surface: &mut ContourSurface,
    level: Level,
    patches: &[Tessellation],
    flat_faces: &Tessellation,
) {
    let (first_point, first_triangle) = (surface.points.len(), surface.triangles.len());
    let polygons = Polygons::new(level.simple, level.interpolant, level.level, surface);
    let first_of_builder = surface.points.len();
    let (places, on_level, facets) = (FxHashMap::default(), FxHashSet::default(), Vec::new());
    let drawn = Vec::new();
    let mut builder =
        Builder { surface, level, polygons, places, facets, drawn, on_level, collapsed: false };
    for chunk in patches {
        builder.add(chunk);
    }
    builder.add(flat_faces);
    builder.finish(first_of_builder);
    let Builder { surface, polygons, .. } = builder;
    polygons.add_triangles(surface);
    surface.level_points.push(first_point..surface.points.len());
    surface.level_triangles.push(first_triangle..surface.triangles.len());
}

struct Builder<'a> {
    surface: &'a mut ContourSurface,
    level: Level<'a>,
    /// The simple cells' part.
    polygons: Polygons,
    /// Where the points are that patches share.
    places: FxHashMap<Owner, u32>,
    /// The triangles, if a tolerance may divide them.
    facets: Vec<Facet>,
    /// Those that are drawn.
    drawn: Vec<Drawn>,
    /// Points that are vertices on the level.
    on_level: FxHashSet<u32>,
    /// Whether parts of patches fell together on the level.
    collapsed: bool,
}

/// A triangle that is drawn: of a facet what the surface keeps.
#[derive(Clone, Copy, Debug)]
struct Drawn {
    /// Its corners, as places among the points of the surface.
    corners: [u32; 3],
    /// The cell, as a place among those that are active.
    cell: u32,
}

impl Builder<'_> {
    fn add(&mut self, chunk: &Tessellation) {
        let places: Vec<u32> = (0..chunk.points.len()).map(|n| self.place(chunk, n)).collect();
        let mut patches = chunk.patches.iter().peekable();
        let mut piece = None;
        for (n, triangle) in chunk.triangles.iter().enumerate() {
            while let Some((number, _)) = patches.next_if(|(_, first)| *first <= n) {
                piece = Some(*number);
            }
            let corners = triangle.map(|point| places[point as usize]);
            let points = triangle.map(|point| &chunk.points[point as usize]);
            let cell = chunk.point_cells[triangle[0] as usize];
            let rays = triangle.map(|point| chunk.rays[point as usize]);
            let at = points.map(|point| point.at);
            let facet = Facet { corners, piece, rays, at, cell };
            let is_on_level = corners.iter().all(|corner| self.on_level.contains(corner));
            self.collapsed |= is_on_level || is_collapsed(corners);
            if self.level.tolerance.is_some() {
                self.facets.push(facet);
            } else {
                self.draw(&facet);
            }
        }
    }

    /// Draws a triangle, unless it is part of a face that is drawn as a whole.
    fn draw(&mut self, facet: &Facet) {
        let Facet { corners, cell, .. } = *facet;
        if !is_drawn_as_face(facet, &self.level.cells[cell as usize]) {
            self.drawn.push(Drawn { corners, cell });
        }
    }

    /// Where a point is in the surface; added if it is new.
    fn place(&mut self, chunk: &Tessellation, n: usize) -> u32 {
        let point = &chunk.points[n];
        let next = self.surface.points.len() as u32;
        if let Some(crossing) = self.polygons.crossing(&point.owner) {
            return crossing;
        }
        let place = match point.owner {
            Owner::Patch => next,
            owner => *self.places.entry(owner).or_insert(next),
        };
        if place == next {
            add_point(self.surface, &self.level.cells, point, chunk.point_cells[n]);
            if point.owner.is_on_level() {
                self.on_level.insert(place);
            }
        }
        place
    }

    /// Refines the triangles, if a tolerance asks for it, and adds them to the surface.
    /// `first_point` is the first that is not a simple cell's.
    fn finish(&mut self, first_point: usize) {
        if let Some(tolerance) = self.level.tolerance {
            let mut refinement = Refinement {
                interpolant: self.level.interpolant,
                level: self.level.level,
                cells: &mut self.level.cells,
                pieces: &mut self.level.pieces,
                polygons: &mut self.polygons,
                tolerance,
                facets: std::mem::take(&mut self.facets),
                points: Vec::new(),
                first_point: self.surface.points.len() as u32,
                on_level: std::mem::take(&mut self.on_level),
                coarse: 0,
            };
            refinement.run();
            let Refinement { facets, points, coarse, .. } = refinement;
            for (point, cell) in &points {
                add_point(self.surface, &self.level.cells, point, *cell);
            }
            // not before: what is thin may have an inside that refinement finds
            facets.iter().for_each(|facet| self.draw(facet));
            self.surface.counts.coarse += coarse;
        }
        if self.collapsed {
            self.drawn.retain(|triangle| !is_collapsed(triangle.corners));
            drop_doubles(&mut self.drawn);
        }
        self.drop_unused_points(first_point);
        let number = |triangle: &Drawn| self.level.cells[triangle.cell as usize].number;
        self.surface.triangles.extend(self.drawn.iter().map(|triangle| triangle.corners));
        self.surface.cells.extend(self.drawn.iter().map(number));
    }

    /// Takes away points of the level that no triangle has, as those of patches in faces that are
    /// drawn by themselves.
    fn drop_unused_points(&mut self, first: usize) {
        let mut is_used = vec![false; self.surface.points.len() - first];
        for corner in self.drawn.iter().flat_map(|triangle| triangle.corners) {
            if let Some(place) = (corner as usize).checked_sub(first) {
                is_used[place] = true;
            }
        }
        if !is_used.contains(&false) {
            return;
        }
        let mut next = first;
        let mut numbers = vec![0; is_used.len()];
        for old in (0..is_used.len()).filter(|&old| is_used[old]) {
            self.surface.points[next] = self.surface.points[first + old];
            numbers[old] = next as u32;
            next += 1;
        }
        self.surface.points.truncate(next);
        for triangle in &mut self.drawn {
            triangle.corners = triangle.corners.map(|corner| {
                let place = (corner as usize).checked_sub(first);
                place.map_or(corner, |place| numbers[place])
            });
        }
    }
}

/// Whether a triangle of a patch lies in a face that is drawn as a whole.
fn is_drawn_as_face(facet: &Facet, cell: &Cell) -> bool {
    facet.piece.is_some() && is_in_flat_face(cell, &facet.at)
}

/// Whether corners fell together on the level.
fn is_collapsed([a, b, c]: [u32; 3]) -> bool {
    a == b || b == c || c == a
}

fn add_point(surface: &mut ContourSurface, cells: &[Cell], point: &PatchPoint, cell: u32) {
    let cell = &cells[cell as usize];
    surface.points.push(SurfacePoint {
        position: point.position,
        cell: cell.number,
        at: cell.in_mesh_order(&point.at),
    });
}

/// Takes away pairs of triangles with the same corners and opposite fronts: what is left
/// of a thin part of the surface when its two sides fall together.
fn drop_doubles(triangles: &mut Vec<Drawn>) {
    let name = |mut corners: [u32; 3]| {
        corners.sort_unstable();
        corners
    };
    let mut named: Vec<([u32; 3], bool, usize)> = triangles
        .iter()
        .map(|triangle| triangle.corners)
        .enumerate()
        .map(|(place, corners)| (name(corners), is_even(&corners.map(|n| n as usize)), place))
        .collect();
    named.sort_unstable();
    let mut dropped = vec![false; triangles.len()];
    for same in named.chunk_by(|a, b| a.0 == b.0) {
        let odd = same.iter().filter(|(_, is_even, _)| !is_even).count();
        // the odd ones come first
        let pairs = odd.min(same.len() - odd);
        for (_, _, place) in &same[odd - pairs..odd + pairs] {
            dropped[*place] = true;
        }
    }
    let mut dropped = dropped.into_iter();
    triangles.retain(|_| !dropped.next().unwrap_or(false));
}
