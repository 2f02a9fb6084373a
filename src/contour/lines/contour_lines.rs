//! Contour lines of an interpolant: all levels, as polylines.

use std::ops::Range;

use rayon::prelude::*;

use super::bezier::Bezier;
use super::crossing::{Crossing, Owner};
use super::curve::Resolution;
use super::method::Method;
use super::start::FlatEdge;
use super::stitch::{Chain, End, Link, Stitched, stitch};
use super::trace::{InnerPoint, Strand, Traces, Tracing, trace};
use crate::bernstein::Barycentric;
use crate::contour::CellRanges;
use crate::interpolant::TriangleCubics;
use crate::mesh::{TriangleMesh, Vector};

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
    /// the side of the cells' normals, the higher values are on the left.
    pub lines: Vec<Polyline>,
    /// Bézier pieces, line after line, in the lines' directions. Their ends lie
    /// on the contour; between, they are as near as the method brings them.
    pub curves: Vec<Bezier>,
    /// The cell of each Bézier piece.
    pub curve_cells: Vec<u32>,
    /// What was done.
    pub counts: Counts,
}

/// Coefficients this close to the level, as a multiple of the largest magnitude
/// in the data, are on the level: the error of computing them is as large.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Cells traced at a time by one thread.
const CHUNK: usize = 64;

/// Contour lines of `interpolant` at the given levels (finite, ascending).
///
/// Every component of every contour is found: cells are passed over only where
/// the Bernstein coefficients exclude a contour, and pieces are drawn only with
/// the A-patch certificate; [`Counts::unresolved`] tells where that failed. All
/// points lie on their level to rounding. The result does not depend on the
/// number of threads.
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
    let mut lines = ContourLines { levels: levels.to_vec(), ..Default::default() };
    lines.counts.unusable = ranges.unusable();
    let magnitude = ranges.magnitude();
    for (place, &level) in levels.iter().enumerate() {
        let rounding = ROUNDING * magnitude.max(level.abs());
        let tracing = Tracing { level, rounding, method, resolution };
        let cells = ranges.cells_at(level, rounding);
        lines.counts.active += cells.len();
        let mut traces = trace_cells(interpolant, &tracing, &cells);
        traces.add_flat_edges(interpolant.mesh());
        lines.counts.divided += traces.divided;
        lines.counts.unresolved += traces.unresolved;
        lines.add_level(place, &traces);
    }
    lines
}

fn trace_cells(interpolant: &dyn TriangleCubics, tracing: &Tracing, cells: &[u32]) -> Traces {
    let mesh = interpolant.mesh();
    let chunks: Vec<Traces> = cells
        .par_chunks(CHUNK)
        .map(|chunk| {
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

impl Traces {
    /// These traces, followed by others.
    fn joined(mut self, other: Traces) -> Traces {
        let (points, curves) = (self.points.len(), self.curves.len());
        self.strands.extend(other.strands.into_iter().map(|strand| Strand {
            first_point: strand.first_point + points,
            first_curve: strand.first_curve + curves,
            ..strand
        }));
        self.points.extend(other.points);
        self.curves.extend(other.curves);
        self.flat_edges.extend(other.flat_edges);
        self.divided += other.divided;
        self.unresolved += other.unresolved;
        self
    }

    /// Edges on the level become strands, each once; those between two cells that
    /// lie on the level as a whole do not.
    fn add_flat_edges(&mut self, mesh: &TriangleMesh) {
        let mut edges = std::mem::take(&mut self.flat_edges);
        edges.sort_unstable();
        for edge in edges.chunk_by(|a, b| (a.low, a.high) == (b.low, b.high)) {
            // sorted, so cells that are not flat come first
            if !edge[0].in_flat_cell {
                self.add_flat_edge(mesh, &edge[0]);
            }
        }
    }

    fn add_flat_edge(&mut self, mesh: &TriangleMesh, edge: &FlatEdge) {
        let corners = mesh.triangles()[edge.cell as usize];
        let crossing = |point: u32| Crossing {
            owner: Owner::Point(point),
            at: corners.map(|corner| f64::from(u8::from(corner == point))),
            position: mesh.points()[point as usize],
        };
        let (start, end) = (crossing(edge.low), crossing(edge.high));
        if start.position != end.position {
            self.strands.push(Strand {
                start,
                end,
                cell: edge.cell,
                first_point: self.points.len(),
                first_curve: self.curves.len(),
            });
            self.curves.push(Bezier::line(start.position, end.position));
        }
    }

    /// The inner points of a strand.
    fn points_of(&self, strand: usize) -> &[InnerPoint] {
        let end = self.strands.get(strand + 1).map_or(self.points.len(), |next| next.first_point);
        &self.points[self.strands[strand].first_point..end]
    }

    /// The Bézier pieces of a strand.
    fn curves_of(&self, strand: usize) -> &[Bezier] {
        let end = self.strands.get(strand + 1).map_or(self.curves.len(), |next| next.first_curve);
        &self.curves[self.strands[strand].first_curve..end]
    }

    /// The unit direction in which a strand leaves one of its ends.
    fn leaving(&self, end: End) -> Vector {
        let strand = &self.strands[end.strand];
        let inner = self.points_of(end.strand);
        let (here, next) = if end.last {
            (strand.end.position, inner.last().map_or(strand.start.position, |p| p.position))
        } else {
            (strand.start.position, inner.first().map_or(strand.end.position, |p| p.position))
        };
        (next - here).try_normalize(0.0).unwrap_or_default()
    }
}

impl ContourLines {
    fn add_level(&mut self, level: usize, traces: &Traces) {
        let stitched = stitch(&traces.strands, |end| traces.leaving(end));
        let mut joints = vec![None; stitched.joint_count];
        for chain in &stitched.chains {
            let mut line = LineBuilder { lines: self, joints: &mut joints, start: 0 };
            line.start = line.lines.connectivity.len();
            line.follow(chain, &stitched, traces);
            line.finish(level, chain, traces);
        }
    }

    /// The points of a line.
    pub fn line_points(&self, line: &Polyline) -> impl Iterator<Item = &LinePoint> {
        self.connectivity[line.points.clone()].iter().map(|&point| &self.points[point as usize])
    }
}

/// Builds one polyline from a chain of strands.
struct LineBuilder<'a> {
    lines: &'a mut ContourLines,
    /// The point at each joint of this level, once it has one.
    joints: &'a mut [Option<u32>],
    /// Where the line begins in the connectivity.
    start: usize,
}

impl LineBuilder<'_> {
    fn follow(&mut self, chain: &Chain, stitched: &Stitched, traces: &Traces) {
        for link in &chain.links {
            let strand = &traces.strands[link.strand];
            let joints = stitched.joints[link.strand];
            let (first, last) = in_order(link, (strand.start, joints[0]), (strand.end, joints[1]));
            self.go_to_joint(first, strand.cell);
            let inner = traces.points_of(link.strand);
            let count = inner.len();
            for place in 0..count {
                let point = &inner[if link.backwards { count - 1 - place } else { place }];
                self.go_to_new(point, strand.cell);
            }
            self.go_to_joint(last, strand.cell);
        }
    }

    fn go_to_new(&mut self, point: &InnerPoint, cell: u32) {
        let number = self.lines.points.len() as u32;
        let InnerPoint { at, position } = *point;
        if self.last_position() != Some(position) {
            self.lines.points.push(LinePoint { position, cell, at });
            self.append(number, cell);
        }
    }

    fn go_to_joint(&mut self, (crossing, joint): (Crossing, u32), cell: u32) {
        if self.last_position() == Some(crossing.position) {
            // the segment that begins here lies in the new cell
            if let Some(last) = self.lines.segment_cells.last_mut() {
                *last = cell;
            }
            return;
        }
        let Crossing { at, position, .. } = crossing;
        let points = &mut self.lines.points;
        let number = *self.joints[joint as usize].get_or_insert_with(|| {
            points.push(LinePoint { position, cell, at });
            points.len() as u32 - 1
        });
        self.append(number, cell);
    }

    fn append(&mut self, point: u32, cell: u32) {
        self.lines.connectivity.push(point);
        self.lines.segment_cells.push(cell);
    }

    fn last_position(&self) -> Option<Vector> {
        let last = self.lines.connectivity[self.start..].last()?;
        Some(self.lines.points[*last as usize].position)
    }

    /// Closes the line and keeps it, unless rounding has left a single point.
    fn finish(self, level: usize, chain: &Chain, traces: &Traces) {
        let Self { lines, start, .. } = self;
        let end = lines.connectivity.len();
        if end - start < 2 {
            lines.connectivity.truncate(start);
            lines.segment_cells.truncate(start);
            return;
        }
        lines.segment_cells[end - 1] = lines.segment_cells[end - 2];
        let first_curve = lines.curves.len();
        for link in &chain.links {
            let curves = traces.curves_of(link.strand).iter();
            lines.curve_cells.extend(curves.clone().map(|_| traces.strands[link.strand].cell));
            if link.backwards {
                lines.curves.extend(curves.rev().map(Bezier::reversed));
            } else {
                lines.curves.extend(curves);
            }
        }
        let curves = first_curve..lines.curves.len();
        lines.lines.push(Polyline { level, closed: chain.closed, points: start..end, curves });
    }
}

fn in_order<T>(link: &Link, first: T, last: T) -> (T, T) {
    if link.backwards { (last, first) } else { (first, last) }
}
