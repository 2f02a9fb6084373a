//! Polylines from the strands of a level.

use super::bezier::Bezier;
use super::contour_lines::{ContourLines, LinePoint, Polyline};
use super::crossing::Crossing;
use super::stitch::{Chain, Link, Stitched, stitch};
use super::traces::{InnerPoint, Traces};
use crate::mesh::Vector;

/// Joins the strands of a level into polylines.
pub fn add_level(lines: &mut ContourLines, level: usize, traces: &Traces) {
    let stitched = stitch(&traces.strands, |end| traces.leaving(end));
    let mut joints = vec![None; stitched.joint_count];
    for chain in &stitched.chains {
        let start = lines.connectivity.len();
        let mut line = LineBuilder { lines, joints: &mut joints, start };
        line.follow(chain, &stitched, traces);
        line.finish(level, chain, traces);
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
        if chain.closed {
            close(lines, start);
        }
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

/// Ends a closed line at its first point, by number.
fn close(lines: &mut ContourLines, start: usize) {
    let [first, .., last] = lines.connectivity[start..] else { return };
    let position = |point: u32| lines.points[point as usize].position;
    if position(first) == position(last) {
        if let Some(end) = lines.connectivity.last_mut() {
            *end = first;
        }
    } else {
        lines.connectivity.push(first);
        lines.segment_cells.extend(lines.segment_cells.last().copied());
    }
}

fn in_order<T>(link: &Link, first: T, last: T) -> (T, T) {
    if link.backwards { (last, first) } else { (first, last) }
}
