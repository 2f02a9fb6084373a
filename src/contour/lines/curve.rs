//! Curves along an arc: what all methods of stage three share.

use super::arc::{Arc, Node};
use super::bezier::Bezier;
use crate::mesh::Vector;

/// How fine the output is. A limit that is not wanted is infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// The thesis' threshold: the greatest distance between neighbouring points,
    /// in units of length.
    pub spacing: f64,
    /// The greatest distance of a segment from the contour, in units of length.
    pub tolerance: f64,
}

/// The curve between two crossings: points on the contour strictly between them,
/// and Bézier pieces from end to end.
#[derive(Debug, Default)]
pub struct Drawing {
    /// Points on the contour, in order, without the two ends.
    pub points: Vec<Node>,
    /// Pieces from the first end to the last.
    pub curves: Vec<Bezier>,
}

/// Halvings of an arc after which its points are as close as they get.
pub const MAX_DEPTH: u32 = 16;

/// The middle of the arc: where the line through the middle of the chord, along
/// the mean of the normals at its ends, meets the contour.
///
/// Figure 2.19 gives that line the mean angle of the *tangents*; such a line need
/// not meet the contour at all, and figure 2.20 shows the normal.
pub fn middle(arc: &Arc, a: &Node, b: &Node) -> Node {
    let chord = b.position - a.position;
    let mean = a.uphill + b.uphill;
    // after a U-turn the normals cancel
    let direction = if mean.norm() > 0.1 { mean } else { arc.frame().normal().cross(&chord) };
    arc.land(&((a.position + b.position) / 2.0), &direction, a, b)
}

/// Whether the straight line between two points of an arc is fine enough.
pub fn is_fine(arc: &Arc, a: &Node, b: &Node, resolution: &Resolution) -> bool {
    let chord = b.position - a.position;
    let at = |t: f64| a.position + chord * t;
    chord.norm() <= resolution.spacing && is_near(arc, &at, resolution.tolerance)
}

/// Whether a curve is within `tolerance` of the contour, by its distances at
/// three places: one alone would be deceived where the two curves cross.
pub fn is_near(arc: &Arc, curve: &dyn Fn(f64) -> Vector, tolerance: f64) -> bool {
    tolerance == f64::INFINITY
        || [0.25, 0.5, 0.75].iter().all(|&t| arc.distance(&curve(t)) <= tolerance)
}

/// Points of the arc along a Bézier piece of it, as many as the resolution asks
/// for; the piece's points are the guesses.
pub fn follow(
    arc: &Arc,
    curve: &Bezier,
    (a, from): (&Node, f64),
    (b, to): (&Node, f64),
    resolution: &Resolution,
    points: &mut Vec<Node>,
) {
    let t = 0.5 * (from + to);
    if to - from < 1.0 / f64::from(1 << MAX_DEPTH) || is_fine(arc, a, b, resolution) {
        return;
    }
    let across = arc.frame().normal().cross(&curve.derivative(t));
    let m = arc.land(&curve.point(t), &across, a, b);
    follow(arc, curve, (a, from), (&m, t), resolution, points);
    points.push(m);
    follow(arc, curve, (&m, t), (b, to), resolution, points);
}
