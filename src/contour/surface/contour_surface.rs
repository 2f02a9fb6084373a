//! Iso-surfaces of all levels, as one mesh of triangles.

use std::ops::Range;

use crate::bernstein::Barycentric4;
use crate::mesh::Vector;

/// A point of an iso-surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Where in space.
    pub position: Vector,
    /// A cell that holds it.
    pub cell: u32,
    /// Where in that cell: the weights with which other point data are interpolated.
    pub at: Barycentric4,
}

/// What was done, and what could not be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SurfaceCounts {
    /// Cells whose range holds a level, summed over the levels.
    pub active: usize,
    /// Those of them that had to be divided.
    pub divided: usize,
    /// Pieces whose surface could not be certified before the size limit. They are drawn
    /// as far as their vertices tell.
    pub unresolved: usize,
    /// Triangles and sides that are not as fine as asked, after so many divisions.
    pub coarse: usize,
    /// Cells left out because a value or a gradient is not finite.
    pub unusable: usize,
}

/// Iso-surfaces of all levels.
///
/// No triangle has a corner twice and none is there twice, but where sheets meet in a point or an
/// edge triangles may be so thin that their area is rounding: the surface is closed by them.
#[derive(Clone, Debug, Default)]
pub struct ContourSurface {
    /// The levels, ascending.
    pub levels: Vec<f64>,
    /// The points. Triangles that meet in a point share it.
    pub points: Vec<SurfacePoint>,
    /// The triangles, as places in `points`, level after level. Seen from the side of the
    /// lower values they turn counter-clockwise: their normals are along −grad u.
    pub triangles: Vec<[u32; 3]>,
    /// The cell of each triangle.
    pub cells: Vec<u32>,
    /// For each level, its points.
    pub level_points: Vec<Range<usize>>,
    /// For each level, its triangles.
    pub level_triangles: Vec<Range<usize>>,
    /// What was done.
    pub counts: SurfaceCounts,
}
