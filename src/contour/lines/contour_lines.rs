//! Contour lines of an interpolant: all levels, as polylines.

use std::ops::Range;

use super::bezier::Bezier;
use crate::bernstein::Barycentric;
use crate::mesh::Vector;

/// A point of a contour line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinePoint {
    /// Where in space.
    pub position: Vector,
    /// A cell that holds it.
    pub cell: u32,
    /// Where in that cell: the weights with which other point data are interpolated.
    pub at: Barycentric,
}

/// One line: a contour from end to end, or once around.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Polyline {
    /// Which level, as a place in [`ContourLines::levels`].
    pub level: usize,
    /// Whether it returns to its first point. That point is then named twice.
    pub closed: bool,
    /// Its points, as places in [`ContourLines::connectivity`].
    pub points: Range<usize>,
    /// Its Bézier pieces, as places in [`ContourLines::curves`].
    pub curves: Range<usize>,
}

/// What was done, and what could not be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Cells whose range holds a level, summed over the levels.
    pub active: usize,
    /// Those of them that had to be divided.
    pub divided: usize,
    /// Pieces whose contour could not be settled before the size limit. Their
    /// crossings are joined by straight lines.
    pub unresolved: usize,
    /// Cells inside which the interpolant touches the level and turns back, as x² does
    /// at 0. No line is drawn there: a level that differs by rounding has two or none.
    pub touching: usize,
    /// Arcs that were given as many points as an arc may have, and are still not as
    /// fine as asked.
    pub coarse: usize,
    /// Cells left out because a value or a gradient is not finite.
    pub unusable: usize,
}

/// Contour lines of all levels.
#[derive(Clone, Debug, Default)]
pub struct ContourLines {
    /// The levels, ascending.
    pub levels: Vec<f64>,
    /// The points. Lines that meet in a point of the mesh share it.
    pub points: Vec<LinePoint>,
    /// Numbers of points, line after line.
    pub connectivity: Vec<u32>,
    /// For each entry of `connectivity`, the cell of the segment that begins
    /// there; the last entry of a line repeats the one before.
    pub segment_cells: Vec<u32>,
    /// The lines, by level and then in the order of their first cells. Seen from
    /// the side of the cells' normals, the higher values are on the left; but not
    /// of both halves of a line that runs straight on where lines cross, and of
    /// neither side of a ridge or a valley.
    pub lines: Vec<Polyline>,
    /// Bézier pieces, line after line, in the lines' directions. Their ends lie
    /// on the contour; between, they are as near as the method brings them.
    pub curves: Vec<Bezier>,
    /// The cell of each Bézier piece.
    pub curve_cells: Vec<u32>,
    /// What was done.
    pub counts: Counts,
}

impl ContourLines {
    /// The points of a line.
    pub fn line_points(&self, line: &Polyline) -> impl Iterator<Item = &LinePoint> {
        self.connectivity[line.points.clone()].iter().map(|&point| &self.points[point as usize])
    }
}
