//! The Intercept method: points of a contour, joined by straight lines
//! (thesis, section 2.3.3, figure 2.19).

use super::arc::{Arc, Node};
use super::bezier::Bezier;
use super::curve::{Drawing, MAX_DEPTH, Resolution, is_fine, middle};
use crate::mesh::Vector;

/// Draws the arc by points that are as close as the resolution asks for.
pub fn intercept(arc: &Arc, a: &Node, b: &Node, resolution: &Resolution, drawing: &mut Drawing) {
    let first = drawing.points.len();
    add_middles(arc, a, b, resolution, MAX_DEPTH, drawing);
    let mut start: Vector = a.position;
    for node in drawing.points[first..].iter().chain([b]) {
        drawing.curves.push(Bezier::line(start, node.position));
        start = node.position;
    }
}

/// Halves the arc until its points are close enough.
fn add_middles(
    arc: &Arc,
    a: &Node,
    b: &Node,
    resolution: &Resolution,
    depth: u32,
    drawing: &mut Drawing,
) {
    if is_fine(arc, a, b, resolution) || drawing.is_full(depth) {
        return;
    }
    let m = middle(arc, a, b);
    add_middles(arc, a, &m, resolution, depth - 1, drawing);
    drawing.points.push(m);
    add_middles(arc, &m, b, resolution, depth - 1, drawing);
}
