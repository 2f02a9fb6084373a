//! The arc of a contour through a simple piece, as a graph over rays.
//!
//! In a simple piece every ray from the apex meets the contour at most once, so
//! where a ray meets the base is a coordinate along the arc. Whatever way a new point
//! of the arc is found, its ray must lie between the rays of its neighbours:
//! that keeps the points in order and on this arc, and when it fails the ray
//! between them is a way that cannot.

use nalgebra::Matrix3;

use super::piece::{Piece, settled};
use crate::bernstein::{Barycentric, Sign, TriangleCubic, between};
use crate::contour::crossings::crossings;
use crate::mesh::{TriangleFrame, Vector};

/// The arc of a contour through a simple piece.
#[derive(Debug)]
pub struct Arc<'a> {
    cubic: &'a TriangleCubic,
    frame: &'a TriangleFrame,
    corners: [Barycentric; 3],
    signs: [Sign; 3],
    /// From barycentric coordinates of the cell to those of the piece.
    to_piece: Matrix3<f64>,
    apex: usize,
    /// Values no larger than this are zero, to rounding.
    rounding: f64,
}

/// Barycentric coordinates of the base, in the piece, below which a point counts as
/// the apex.
const AT_APEX: f64 = 1e-12;

/// A point of an arc.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// Where, in barycentric coordinates of the cell.
    pub at: Barycentric,
    /// Where, in space.
    pub position: Vector,
    /// Where the ray through it meets the base, in `[0, 1]`.
    pub ray: f64,
    /// The unit vector along the gradient; zero where there is none.
    pub uphill: Vector,
}

impl<'a> Arc<'a> {
    /// The arc through a simple piece: `cubic` (less the level) crosses zero at most
    /// once on each ray from its corner `apex`, and just once on those between the
    /// arc's ends. Values up to `rounding` count as zero.
    ///
    /// Nothing if the piece is so thin that its coordinates cannot be computed.
    pub fn new(
        cubic: &'a TriangleCubic,
        frame: &'a TriangleFrame,
        piece: &Piece,
        apex: usize,
        rounding: f64,
    ) -> Option<Self> {
        let Piece { corners, signs, .. } = *piece;
        let from_piece = Matrix3::from_fn(|row, column| corners[column][row]);
        let to_piece = from_piece.try_inverse()?;
        let arc = Self { cubic, frame, corners, signs, to_piece, apex, rounding };
        (!frame.is_degenerate()).then_some(arc)
    }

    /// The triangle's frame.
    pub fn frame(&self) -> &TriangleFrame {
        self.frame
    }

    /// The node at a point of the contour; `ray` is where its ray meets the base.
    pub fn node(&self, at: Barycentric, position: Vector, ray: f64) -> Node {
        let uphill = self.gradient(&at).try_normalize(0.0).unwrap_or_else(Vector::zeros);
        Node { at, position, ray, uphill }
    }

    fn node_at(&self, at: Barycentric, ray: f64) -> Node {
        self.node(at, self.frame.position(&at), ray)
    }

    fn gradient(&self, at: &Barycentric) -> Vector {
        self.frame.gradient(&self.cubic.barycentric_gradient(at))
    }

    /// Where the ray through a point of the piece meets the base. The apex is on all
    /// rays: for a point that rounding cannot tell from it there is none.
    fn ray(&self, at: &Barycentric) -> Option<f64> {
        let inside = self.to_piece * Vector::from(*at);
        let (start, end) = (inside[(self.apex + 1) % 3], inside[(self.apex + 2) % 3]);
        (start + end > AT_APEX).then(|| (end / (start + end)).clamp(0.0, 1.0))
    }

    /// How far a point is from the contour, to first order: value over slope.
    pub fn distance(&self, position: &Vector) -> f64 {
        let at = self.frame.barycentric(position);
        let value = self.cubic.value(&at).abs();
        if value <= self.rounding { 0.0 } else { value / self.gradient(&at).norm() }
    }

    /// The point of the arc near `guess`, found along the line through `guess` in
    /// the given direction, and strictly between two nodes. Where that line
    /// misses this arc, the point on a ray between the nodes.
    pub fn land(&self, guess: &Vector, direction: &Vector, a: &Node, b: &Node) -> Node {
        let at = self.frame.barycentric(guess);
        self.on_line(&at, direction, a, b).unwrap_or_else(|| {
            let ray = self.ray(&at).filter(|&ray| is_between(ray, a, b));
            self.on_ray(ray.unwrap_or(0.5 * (a.ray + b.ray)))
        })
    }

    /// The point of the arc nearest to `at` on a line, and between two nodes.
    fn on_line(&self, at: &Barycentric, direction: &Vector, a: &Node, b: &Node) -> Option<Node> {
        let along = Vector::from(self.frame.barycentric_direction(direction));
        let (from, to) = self.clip(&Vector::from(*at), &along)?;
        let point = |step: f64| <[f64; 3]>::from(Vector::from(*at) + along * step);
        let line = self.cubic.restrict(&point(from), &point(to));
        line.roots()
            .crossings()
            .map(|t| (1.0 - t) * from + t * to)
            .filter_map(|step| Some((step, self.ray(&point(step))?)))
            .filter(|&(_, ray)| is_between(ray, a, b))
            .min_by(|p, q| p.0.abs().total_cmp(&q.0.abs()))
            .map(|(step, ray)| self.node_at(point(step), ray))
    }

    /// The steps along a line at which it enters and leaves the piece.
    fn clip(&self, at: &Vector, along: &Vector) -> Option<(f64, f64)> {
        let (start, slope) = (self.to_piece * at, self.to_piece * along);
        let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
        for n in 0..3 {
            let step = -start[n] / slope[n];
            if slope[n] > 0.0 {
                from = from.max(step);
            } else if slope[n] < 0.0 {
                to = to.min(step);
            } else if start[n] < 0.0 {
                return None;
            }
        }
        (from < to && from.is_finite() && to.is_finite()).then_some((from, to))
    }

    /// The point of the arc on the ray to the point `ray` of the base.
    pub fn on_ray(&self, ray: f64) -> Node {
        let apex = &self.corners[self.apex];
        let (start, end) = (&self.corners[(self.apex + 1) % 3], &self.corners[(self.apex + 2) % 3]);
        let base = between(start, end, ray);
        let line = settled(&self.cubic.restrict(apex, &base));
        // between the arc's ends the base is on the other side than the apex
        let side = self.signs[self.apex];
        let t = crossings(&line, side, !side).first().copied().unwrap_or(1.0);
        self.node_at(between(apex, &base, t), ray)
    }
}

/// Whether a ray lies between those of two nodes, and not so near to one of them
/// that halving the arc there would make no headway: across a narrow tongue the
/// nearest point is next to an end.
fn is_between(ray: f64, a: &Node, b: &Node) -> bool {
    let (low, high) = (a.ray.min(b.ray), a.ray.max(b.ray));
    let margin = (high - low) / 16.0;
    ray > low + margin && ray < high - margin
}
