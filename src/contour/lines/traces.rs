//! What is found in cells: arcs of a contour, not yet joined.

use super::arc::Node;
use super::bezier::Bezier;
use super::crossing::{Crossing, Owner};
use super::curve::Drawing;
use super::piece::Cell;
use super::start::FlatEdge;
use super::stitch::End;
use crate::bernstein::Barycentric;
use crate::mesh::{TriangleMesh, Vector};

/// An arc of the contour in a cell, directed with the higher side on its left.
#[derive(Clone, Copy, Debug)]
pub struct Strand {
    /// Its first point.
    pub start: Crossing,
    /// Its last point.
    pub end: Crossing,
    /// The cell.
    pub cell: u32,
    /// Where its inner points begin in [`Traces::points`]; they end where those
    /// of the next strand begin.
    pub first_point: usize,
    /// The same for its pieces in [`Traces::curves`].
    pub first_curve: usize,
}

/// A point of a strand between its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InnerPoint {
    /// Where in the cell.
    pub at: Barycentric,
    /// Where in space.
    pub position: Vector,
}

/// What was found in a series of cells.
#[derive(Debug, Default)]
pub struct Traces {
    /// The arcs.
    pub strands: Vec<Strand>,
    /// Inner points of all arcs.
    pub points: Vec<InnerPoint>,
    /// Bézier pieces of all arcs.
    pub curves: Vec<Bezier>,
    /// Edges on the level, once from each of their cells.
    pub flat_edges: Vec<FlatEdge>,
    /// Cells that were divided.
    pub divided: usize,
    /// Pieces whose contour could not be settled.
    pub unresolved: usize,
    /// Cells in which the level is touched, but not crossed.
    pub touching: usize,
    /// Arcs that are not as fine as asked.
    pub coarse: usize,
    /// The arc that is being drawn; kept so that its memory is used again.
    pub drawing: Drawing,
}

impl Traces {
    /// Adds straight strands between pairs of crossings.
    pub fn add_straight(&mut self, cell: &Cell, pairs: &[[u32; 2]]) {
        for pair in pairs {
            let [start, end] = pair.map(|crossing| cell.crossings[crossing as usize]);
            self.add(cell, start, end, &mut Drawing::default());
        }
    }

    /// Adds a strand and empties its drawing; passes over one that is a single point.
    ///
    /// One between different owners is kept even if it has no length: it joins them.
    pub fn add(&mut self, cell: &Cell, start: Crossing, end: Crossing, drawing: &mut Drawing) {
        if drawing.points.is_empty() && start.owner == end.owner {
            drawing.curves.clear();
            return;
        }
        self.strands.push(Strand {
            start,
            end,
            cell: cell.number,
            first_point: self.points.len(),
            first_curve: self.curves.len(),
        });
        if drawing.curves.is_empty() {
            drawing.curves.push(Bezier::line(start.position, end.position));
        }
        let inner = |node: Node| InnerPoint { at: node.at, position: node.position };
        self.points.extend(drawing.points.drain(..).map(inner));
        self.curves.append(&mut drawing.curves);
        self.coarse += usize::from(std::mem::take(&mut drawing.coarse));
    }

    /// These traces, followed by others.
    pub fn joined(mut self, other: Traces) -> Traces {
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
        self.coarse += other.coarse;
        self.touching += other.touching;
        self
    }

    /// Edges on the level become strands, each once; those between two cells that
    /// lie on the level as a whole do not.
    pub fn add_flat_edges(&mut self, mesh: &TriangleMesh) {
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
        let (from, to) =
            if edge.low_to_high { (edge.low, edge.high) } else { (edge.high, edge.low) };
        let (start, end) = (crossing(from), crossing(to));
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
    pub fn points_of(&self, strand: usize) -> &[InnerPoint] {
        let end = self.strands.get(strand + 1).map_or(self.points.len(), |next| next.first_point);
        &self.points[self.strands[strand].first_point..end]
    }

    /// The Bézier pieces of a strand.
    pub fn curves_of(&self, strand: usize) -> &[Bezier] {
        let end = self.strands.get(strand + 1).map_or(self.curves.len(), |next| next.first_curve);
        &self.curves[self.strands[strand].first_curve..end]
    }

    /// The unit direction in which a strand leaves one of its ends.
    pub fn leaving(&self, end: End) -> Vector {
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
