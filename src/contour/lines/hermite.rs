//! Cubic Hermite pieces of a contour: the methods SODE, ODEA and AODEA
//! (thesis, section 2.3.3, eqs. 2.5 to 2.13).

use super::arc::{Arc, Node};
use super::bezier::Bezier;
use super::curve::{Drawing, Resolution, follow, is_near, middle};
use crate::mesh::{Vector, plane_axes};

/// SODE takes `y(x)` only where its slope is at most this; beyond, "the Hermite
/// interpolant may not approximate the solution very well" and arc length serves.
const STEEPEST: f64 = 2.0;

/// SODE: one coordinate as a function of the other, where the gradient keeps its
/// signs and the slope is modest; ODEA elsewhere.
pub fn sode(arc: &Arc, a: &Node, b: &Node, resolution: &Resolution, drawing: &mut Drawing) {
    match graph(arc, a, b) {
        Some(curve) => add(arc, curve, a, b, resolution, drawing),
        None => odea(arc, a, b, resolution, drawing),
    }
}

/// ODEA: both coordinates as functions of arc length, from the two ends; with one
/// point between them if a coordinate has more than one extreme.
pub fn odea(arc: &Arc, a: &Node, b: &Node, resolution: &Resolution, drawing: &mut Drawing) {
    let m = middle(arc, a, b);
    if !needs_middle(arc, a, &m, b) {
        return add(arc, by_arc_length(arc, a, b), a, b, resolution, drawing);
    }
    add(arc, by_arc_length(arc, a, &m), a, &m, resolution, drawing);
    drawing.points.push(m);
    add(arc, by_arc_length(arc, &m, b), &m, b, resolution, drawing);
}

/// AODEA: as ODEA, with points added until each piece is as short, or as close to
/// the contour, as the resolution asks for.
pub fn aodea(
    arc: &Arc,
    a: &Node,
    b: &Node,
    resolution: &Resolution,
    depth: u32,
    drawing: &mut Drawing,
) {
    let curve = by_arc_length(arc, a, b);
    let short = (b.position - a.position).norm() <= resolution.spacing;
    let fine = short && is_near(arc, &|t| curve.point(t), resolution.tolerance);
    if fine || drawing.is_full(depth) {
        return add(arc, curve, a, b, resolution, drawing);
    }
    let m = middle(arc, a, b);
    aodea(arc, a, &m, resolution, depth - 1, drawing);
    drawing.points.push(m);
    aodea(arc, &m, b, resolution, depth - 1, drawing);
}

/// Adds a piece, and the points of the contour along it.
fn add(
    arc: &Arc,
    curve: Bezier,
    a: &Node,
    b: &Node,
    resolution: &Resolution,
    drawing: &mut Drawing,
) {
    follow(arc, &curve, (a, 0.0), (b, 1.0), resolution, drawing);
    drawing.curves.push(curve);
}

/// The unit tangent at a node, with the higher side on the left; along the chord
/// where there is no gradient (eqs. 2.12, 2.13).
fn tangent(arc: &Arc, node: &Node, chord: &Vector) -> Vector {
    let tangent = node.uphill.cross(arc.frame().normal());
    tangent.try_normalize(0.5).unwrap_or_else(|| chord.try_normalize(0.0).unwrap_or_default())
}

/// The Hermite piece by arc length.
///
/// The arc's length, which the thesis leaves open, is taken from the circle with
/// the same chord and the same turn θ between the tangents, and so are the
/// handles, `4/3 tan(θ/4)` of its radius: a circle is then met to order six.
fn by_arc_length(arc: &Arc, a: &Node, b: &Node) -> Bezier {
    let chord = b.position - a.position;
    let (out, back) = (tangent(arc, a, &chord), tangent(arc, b, &chord));
    let turn = out.dot(&back).clamp(-1.0, 1.0).acos();
    let handle = if turn < 1e-4 {
        chord.norm() / 3.0
    } else {
        chord.norm() * (2.0 / 3.0) * (turn / 4.0).tan() / (turn / 2.0).sin()
    };
    Bezier::with_handles(a.position, out * handle, back * handle, b.position)
}

/// The Hermite piece `y(x)` or `x(y)`, whichever is less steep, if the gradient has
/// the same signs at both ends and neither slope is too steep.
fn graph(arc: &Arc, a: &Node, b: &Node) -> Option<Bezier> {
    let axes = plane_axes(arc.frame().normal());
    let same_sign = |axis: &Vector| a.uphill.dot(axis) * b.uphill.dot(axis) > 0.0;
    if !axes.iter().all(same_sign) {
        return None;
    }
    let steepness = |axis: &Vector, other: &Vector| {
        let slope = |node: &Node| (node.uphill.dot(axis) / node.uphill.dot(other)).abs();
        slope(a).max(slope(b))
    };
    let [x, y] = axes;
    let (axis, steepest) = match (steepness(&x, &y), steepness(&y, &x)) {
        (in_x, in_y) if in_x <= in_y => (x, in_x),
        (_, in_y) => (y, in_y),
    };
    let chord = b.position - a.position;
    let third = chord.dot(&axis) / 3.0;
    // the handle is a third of the way along the axis, at the tangent's slope
    let handle = |node: &Node| {
        let tangent = tangent(arc, node, &chord);
        let stretch = third / tangent.dot(&axis);
        (stretch > 0.0).then(|| tangent * stretch)
    };
    if steepest > STEEPEST {
        return None;
    }
    Some(Bezier::with_handles(a.position, handle(a)?, handle(b)?, b.position))
}

/// Whether a coordinate has more than one extreme along the arc, seen from the
/// tangents at its ends and its middle, or the arc turns by more than a right
/// angle: then one Hermite piece may fail (figure 2.23).
fn needs_middle(arc: &Arc, a: &Node, m: &Node, b: &Node) -> bool {
    let chord = b.position - a.position;
    let [at_a, at_m, at_b] = [a, m, b].map(|node| tangent(arc, node, &chord));
    let twice = |axis: &Vector| {
        let (first, middle, last) = (at_a.dot(axis), at_m.dot(axis), at_b.dot(axis));
        first * middle < 0.0 && middle * last < 0.0
    };
    at_a.dot(&at_b) < 0.0 || plane_axes(arc.frame().normal()).iter().any(twice)
}
