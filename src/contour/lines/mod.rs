//! Contour lines on triangles.

mod arc;
mod bezier;
mod contour_lines;
mod crossing;
mod curve;
mod hermite;
mod intercept;
mod line_builder;
mod method;
mod piece;
mod situation;
mod start;
mod stitch;
mod trace;
mod traces;
mod walls;

pub use bezier::Bezier;
pub use contour_lines::{ContourLines, Counts, LinePoint, Polyline};
pub use curve::Resolution;
pub use method::Method;

use rayon::prelude::*;

use crate::contour::CellRanges;
use crate::contour::rounding::{LevelBand, Rounding};
use crate::interpolant::TriangleCubics;
use crate::interruption::checkpoint;
use line_builder::add_level;
use trace::{Tracing, trace};
use traces::Traces;
use walls::Walls;

/// Cells traced at a time by one thread.
const CHUNK: usize = 64;

/// Contour lines of `interpolant` at the given levels (finite, ascending).
///
/// Every component of every contour is found: cells are passed over only where
/// bounds by the Bernstein coefficients exclude a contour, and pieces are drawn
/// only with the A-patch certificate; [`Counts::unresolved`] tells where that
/// failed. All points lie on their level to rounding. The result does not depend
/// on the number of threads.
///
/// `ranges` must be those of `interpolant`; they serve any number of calls.
///
/// Source: thesis, section 2.3.
pub fn contour_lines(
    interpolant: &dyn TriangleCubics,
    ranges: &CellRanges,
    levels: &[f64],
    method: Method,
    resolution: Resolution,
) -> ContourLines {
    let no_walls = |_: &Rounding, _: &[u32]| Walls::default();
    lines_between(interpolant, ranges, levels, (method, resolution), no_walls)
}

/// The same for a solution with boundary conditions: where the values on the boundary
/// are the level and the gradients there nearly agree, the boundary is the contour.
///
/// A gradient that is recovered, or projected, has a small component along a boundary
/// on which the solution is constant. The cubics weave about that constant there, and
/// their contour is a row of dashes; this draws the boundary's edges instead. Inner
/// edges, and edges that are far from the level between their ends, stay as they are.
pub fn contour_lines_with_walls(
    interpolant: &dyn TriangleCubics,
    ranges: &CellRanges,
    levels: &[f64],
    method: Method,
    resolution: Resolution,
) -> ContourLines {
    let walls =
        |rounding: &Rounding, cells: &[u32]| Walls::new(interpolant, ranges, rounding, cells);
    lines_between(interpolant, ranges, levels, (method, resolution), walls)
}

/// Contour lines between the walls that `walls` finds in the active cells of a level.
fn lines_between(
    interpolant: &dyn TriangleCubics,
    ranges: &CellRanges,
    levels: &[f64],
    (method, resolution): (Method, Resolution),
    walls: impl Fn(&Rounding, &[u32]) -> Walls,
) -> ContourLines {
    let mut lines = ContourLines { levels: levels.to_vec(), ..Default::default() };
    lines.counts.unusable = ranges.unusable();
    let resolution = resolution.no_finer_than(interpolant.mesh());
    for (place, &level) in levels.iter().enumerate() {
        let bounds = |cell: usize| interpolant.cubic(cell).value_bounds();
        let in_band = |band: LevelBand| {
            let cells = ranges.cells_at(level, |range| band.of_range(range), bounds);
            let rounding = Rounding::new(interpolant.mesh(), bounds, band, &cells);
            let walls = walls(&rounding, &cells);
            (cells, rounding, walls)
        };
        let mut found = in_band(LevelBand::new(level));
        let of_walls = found.2.distance();
        if of_walls > 0.0 {
            // a cell of little spread may be at the same wall, and by itself not near the level
            found = in_band(LevelBand { level, of_walls });
        }
        let (cells, rounding, walls) = found;
        let tracing = Tracing { level, rounding: &rounding, walls: &walls, method, resolution };
        lines.counts.active += cells.len();
        let mut traces = trace_cells(interpolant, &tracing, &cells);
        traces.add_flat_edges(interpolant.mesh());
        lines.counts.divided += traces.divided;
        lines.counts.unresolved += traces.unresolved;
        lines.counts.coarse += traces.coarse;
        lines.counts.touching += traces.touching;
        add_level(&mut lines, place, &traces);
    }
    lines
}

fn trace_cells(interpolant: &dyn TriangleCubics, tracing: &Tracing, cells: &[u32]) -> Traces {
    let mesh = interpolant.mesh();
    let chunks: Vec<Traces> = cells
        .par_chunks(CHUNK)
        .map(|chunk| {
            checkpoint();
            let mut traces = Traces::default();
            for &cell in chunk {
                let number = cell as usize;
                let (cubic, frame) = (interpolant.cubic(number), mesh.frame(number));
                trace(tracing, cell, mesh.triangles()[number], &cubic, &frame, &mut traces);
            }
            traces
        })
        .collect();
    chunks.into_iter().fold(Traces::default(), Traces::joined)
}
