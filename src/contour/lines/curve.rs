//! Curves along an arc: what all methods of stage three share.

use super::arc::{Arc, Node};
use super::bezier::Bezier;
use crate::mesh::{TriangleMesh, Vector};

/// How fine the output is. A limit that is not wanted is infinite; one that is no
/// positive number is no limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// The thesis' threshold: the greatest distance between neighbouring points,
    /// in units of length.
    pub spacing: f64,
    /// The greatest distance of a segment from the contour, in units of length.
    pub tolerance: f64,
}

/// Coordinates are known to this part of the largest.
const COORDINATE: f64 = 4.0 * f64::EPSILON;

impl Resolution {
    /// The same limits, but none finer than coordinates of the mesh can be told
    /// apart.
    pub fn no_finer_than(self, mesh: &TriangleMesh) -> Self {
        let is_larger = |x: f64, than: f64| x.abs() > than && x.is_finite();
        let larger = |than: f64, x: &f64| if is_larger(*x, than) { x.abs() } else { than };
        let largest = mesh.points().iter().flat_map(|point| point.iter()).fold(0.0, larger);
        let least = COORDINATE * largest;
        let limit = |value: f64| if value > 0.0 { value.max(least) } else { f64::INFINITY };
        Self { spacing: limit(self.spacing), tolerance: limit(self.tolerance) }
    }
}

/// The curve between two crossings: points on the contour strictly between them,
/// and Bézier pieces from end to end.
#[derive(Debug, Default)]
pub struct Drawing {
    /// Points on the contour, in order, without the two ends.
    pub points: Vec<Node>,
    /// Pieces from the first end to the last.
    pub curves: Vec<Bezier>,
    /// Whether the arc was given all the points that it may have, and is not as fine
    /// as asked.
    pub coarse: bool,
}

impl Drawing {
    /// Whether the arc may not be halved any more; takes note of it.
    pub fn is_full(&mut self, depth: u32) -> bool {
        let full = depth == 0 || self.points.len() >= MAX_POINTS;
        self.coarse |= full;
        full
    }
}

/// Halvings of an arc after which it is halved no more: its ends' rays are then as
/// close as rounding lets them be.
pub const MAX_DEPTH: u32 = 40;

/// Points that an arc may have. More are only asked for where no number of points
/// is enough.
const MAX_POINTS: usize = 1 << 20;

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
    chord.norm() <= resolution.spacing
        && is_near(arc, &at, resolution.tolerance)
        && !turns_back(a, b)
}

/// Whether the contour turns by more than a sixth of a circle between two points:
/// across a narrow tongue a chord is near the contour, and the tip is far from it.
fn turns_back(a: &Node, b: &Node) -> bool {
    let cosine = a.uphill.dot(&b.uphill);
    let known = a.uphill != Vector::zeros() && b.uphill != Vector::zeros();
    known && cosine < 0.5
}

/// Between the places at which a curve's distance is measured it may be further; a
/// third more was seen.
const MARGIN: f64 = 0.7;

/// Whether a curve is within `tolerance` of the contour, by its distances at
/// three places: one alone would be deceived where the two curves cross.
pub fn is_near(arc: &Arc, curve: &dyn Fn(f64) -> Vector, tolerance: f64) -> bool {
    tolerance == f64::INFINITY
        || [0.25, 0.5, 0.75].iter().all(|&t| arc.distance(&curve(t)) <= MARGIN * tolerance)
}

/// Points of the arc along a Bézier piece of it, as many as the resolution asks
/// for; the piece's points are the guesses.
pub fn follow(
    arc: &Arc,
    curve: &Bezier,
    (a, from): (&Node, f64),
    (b, to): (&Node, f64),
    resolution: &Resolution,
    drawing: &mut Drawing,
) {
    let t = 0.5 * (from + to);
    if is_fine(arc, a, b, resolution) || drawing.is_full(u32::from(from < t && t < to)) {
        return;
    }
    let across = arc.frame().normal().cross(&curve.derivative(t));
    let m = arc.land(&curve.point(t), &across, a, b);
    follow(arc, curve, (a, from), (&m, t), resolution, drawing);
    drawing.points.push(m);
    follow(arc, curve, (&m, t), (b, to), resolution, drawing);
}
