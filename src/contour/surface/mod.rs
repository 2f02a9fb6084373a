//! Iso-surfaces in tetrahedra.

mod budget;
mod cell;
mod contour_surface;
mod division;
mod flat_faces;
mod handedness;
mod lattice;
mod owner;
mod patch;
mod piece;
mod plateaus;
mod polygons;
mod refinement;
mod settle;
mod simple;
mod surface_builder;
mod tessellation;
mod uniform;
mod walls;

pub use budget::{MOST_POINTS, points_per_side_within};
pub use contour_surface::{ContourSurface, SurfaceCounts, SurfacePoint};

use rayon::prelude::*;

use crate::contour::CellRanges;
use crate::contour::rounding::{LevelBand, Rounding};
use crate::interpolant::TetrahedronCubics;
use crate::interruption::checkpoint;
use cell::Cell;
use patch::Patch;
use piece::Piece;
use settle::settle;
use simple::{SimpleCells, Sorted};
use surface_builder::{Level, add_level};
use tessellation::Tessellation;
use walls::Walls;

/// How fine a surface is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fineness {
    /// So many points on each side of a patch, 2 to [`MOST_POINTS`]: the thesis' *nSide*.
    PointsPerSide(u32),
    /// No point of a triangle is farther from the surface than this, in the mesh's unit.
    Tolerance(f64),
}

/// Pieces tessellated at a time by one thread.
const CHUNK: usize = 64;

/// The surfaces of `interpolant` at the given levels (finite, ascending).
///
/// Closed, up to the boundary of the mesh: every edge inside belongs to two triangles, or to more
/// where sheets meet, as many in each direction. The surface is the border of the region
/// `u >= level`. A plateau (cells that are on the level as a whole, and hang together) is left out
/// of that region if more is above the level around it than below, so that it is outlined. Faces
/// of the boundary that are on the level as a whole are drawn besides. Faces inside at which the
/// level is touched and not crossed are no border, and not drawn.
///
/// Every component is found: cells are passed over only where bounds by the Bernstein coefficients
/// exclude a surface, and pieces are drawn only with the A-patch certificate;
/// [`SurfaceCounts::unresolved`] tells where that failed. All points lie on their level to
/// rounding. The result does not depend on the number of threads.
///
/// `ranges` must be those of `interpolant`; they serve any number of calls.
///
/// Source: thesis, section 2.4.
pub fn contour_surface(
    interpolant: &dyn TetrahedronCubics,
    ranges: &CellRanges,
    levels: &[f64],
    fineness: Fineness,
) -> ContourSurface {
    let mut surface = ContourSurface { levels: levels.to_vec(), ..Default::default() };
    surface.counts.unusable = ranges.unusable();
    let (points, tolerance) = match fineness {
        Fineness::PointsPerSide(points) => (points.clamp(2, MOST_POINTS), None),
        Fineness::Tolerance(tolerance) => (2, Some(tolerance)),
    };
    for &level in levels {
        let sorted = |band: LevelBand| match fineness {
            Fineness::PointsPerSide(3..) => sorted_without_simple(interpolant, ranges, band),
            _ => {
                let near = ranges.cells_near(level, |range| band.of_range(range));
                Sorted::new(interpolant, band, &near, tolerance)
            }
        };
        let (mut simple, mut cells) = cells_at(interpolant, ranges, level, sorted);
        surface.counts.active += simple.len() + cells.len();
        let first_new_vertex = first_new_vertex(interpolant);
        let settled = settle(&mut cells, first_new_vertex, |marks, cells| {
            let woken = simple.take_marked(marks, first_new_vertex);
            cells.extend(far_cells(interpolant, level, &woken));
        });
        surface.counts.divided += settled.divided;
        surface.counts.unresolved += settled.unresolved;
        let patches = tessellations(&cells, &settled.pieces, points);
        let mut flat_faces = Tessellation::default();
        flat_faces::add_flat_faces(&cells, points - 1, &mut flat_faces);
        let pieces = settled.pieces;
        let level = Level { interpolant, level, simple: &simple, cells, pieces, tolerance };
        add_level(&mut surface, level, &patches, &flat_faces);
    }
    surface
}

/// The number from which vertices that divisions add are numbered.
fn first_new_vertex(interpolant: &dyn TetrahedronCubics) -> u32 {
    interpolant.mesh().points().len() as u32
}

/// The cells that may hold a level; none is taken to be simple.
fn sorted_without_simple(
    interpolant: &dyn TetrahedronCubics,
    ranges: &CellRanges,
    band: LevelBand,
) -> Sorted {
    let tolerance = |range: [f64; 2]| band.of_range(range);
    Sorted::without_simple(ranges.cells_at(band.level, tolerance, bounds(interpolant)))
}

/// The bounds of the cubic of a cell, by its number: those by which it is active.
fn bounds(interpolant: &dyn TetrahedronCubics) -> impl Fn(usize) -> [f64; 2] + Sync {
    |cell| interpolant.cubic(cell).value_bounds()
}

/// The cells at a level: the simple ones, and the others. `sorted` gives them by their numbers, for a
/// band around the level.
fn cells_at(
    interpolant: &dyn TetrahedronCubics,
    ranges: &CellRanges,
    level: f64,
    sorted: impl Fn(LevelBand) -> Sorted,
) -> (SimpleCells, Vec<Cell>) {
    let in_band = |band: LevelBand| {
        let sorted = sorted(band);
        // what lies on the level is decided by all around it
        let rounding = Rounding::new(interpolant.mesh(), bounds(interpolant), band, &sorted.around);
        let walls = Walls::new(interpolant, ranges, &rounding, &sorted.around);
        (sorted, rounding, walls)
    };
    let mut found = in_band(LevelBand::new(level));
    let of_walls = found.2.distance();
    if of_walls > 0.0 {
        // a cell of little spread may be at the same wall, and by itself not near the level
        found = in_band(LevelBand { level, of_walls });
    }
    let (Sorted { simple, others, .. }, rounding, walls) = found;
    let cell = |&number: &u32| {
        checkpoint();
        Cell::new(interpolant, &rounding, &walls, number)
    };
    // of known length, so that it is not put together of parts, which takes twice the memory
    let cells: Vec<Option<Cell>> = others.par_iter().map(cell).collect();
    let mut cells: Vec<Cell> = cells.into_iter().flatten().collect();
    handedness::settle_slivers(&mut cells);
    plateaus::settle_plateaus(&mut cells);
    flat_faces::leave_to_patches(&mut cells);
    (simple, cells)
}

/// Cells that have nothing on the level, nor so near that rounding might put it there.
fn far_cells(interpolant: &dyn TetrahedronCubics, level: f64, numbers: &[u32]) -> Vec<Cell> {
    let rounding = Rounding::of_values(level);
    let cell = |&number: &u32| Cell::new(interpolant, &rounding, &Walls::default(), number);
    numbers.iter().filter_map(cell).collect()
}

fn tessellations(cells: &[Cell], pieces: &[Piece], points: u32) -> Vec<Tessellation> {
    let chunks = pieces.par_chunks(CHUNK).enumerate();
    let tessellated = chunks.map(|(chunk, pieces)| {
        checkpoint();
        let mut tessellation = Tessellation::default();
        for (place, piece) in pieces.iter().enumerate() {
            let number = (chunk * CHUNK + place) as u32;
            tessellation.patches.push((number, tessellation.triangles.len()));
            let patch = Patch { cell: &cells[piece.cell as usize], piece };
            uniform::tessellate(&patch, points, &mut tessellation);
        }
        tessellation
    });
    tessellated.collect()
}
