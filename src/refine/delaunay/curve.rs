//! Curved boundaries, as polylines.

use spade::Point2;

/// A polyline that boundary points are put onto; closed if it ends where it begins.
#[derive(Clone, Debug)]
pub struct Curve {
    points: Vec<Point2<f64>>,
    /// How far along the polyline each point is.
    lengths: Vec<f64>,
}

/// How far the ends of an edge may be off, as a part of its length.
const ON_CURVE: f64 = 0.01;

impl Curve {
    /// The polyline of these points.
    pub fn new(points: Vec<Point2<f64>>) -> Self {
        let mut lengths = vec![0.0];
        for pair in points.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + pair[0].distance_2(pair[1]).sqrt());
        }
        Self { points, lengths }
    }

    /// The point of the polyline halfway between two points that lie on it, the shorter way.
    /// A polyline is not quite the curve that meshes are made of, so they are on it if they
    /// are as near as a part of their own distance.
    pub fn between(&self, a: Point2<f64>, b: Point2<f64>) -> Option<Point2<f64>> {
        let tolerance = ON_CURVE * a.distance_2(b).sqrt();
        let (a, b) = (self.place(a, tolerance)?, self.place(b, tolerance)?);
        let whole = *self.lengths.last()?;
        let middle = 0.5 * (a + b);
        let is_closed = self.points.first() == self.points.last();
        let goes_around = is_closed && (a - b).abs() > 0.5 * whole;
        self.point(if goes_around { (middle + 0.5 * whole) % whole } else { middle })
    }

    /// How far along the polyline a point is, if it is as near as that.
    fn place(&self, point: Point2<f64>, tolerance: f64) -> Option<f64> {
        let segments = self.points.windows(2).zip(&self.lengths);
        let places = segments.map(|(ends, start)| {
            let (from, to) = (ends[0], ends[1]);
            let length = from.distance_2(to).sqrt();
            let along = ((point.x - from.x) * (to.x - from.x)
                + (point.y - from.y) * (to.y - from.y))
                / length;
            let along = if length > 0.0 { along.clamp(0.0, length) } else { 0.0 };
            let share = if length > 0.0 { along / length } else { 0.0 };
            (point.distance_2(mix(from, to, share)).sqrt(), start + along)
        });
        let nearest = places.min_by(|one, other| one.0.total_cmp(&other.0))?;
        (nearest.0 <= tolerance).then_some(nearest.1)
    }

    /// The point that is so far along the polyline.
    fn point(&self, length: f64) -> Option<Point2<f64>> {
        let next = self.lengths.partition_point(|&start| start < length).max(1);
        let (from, to) = (self.lengths[next - 1], *self.lengths.get(next)?);
        let share = if to > from { (length - from) / (to - from) } else { 0.0 };
        Some(mix(self.points[next - 1], self.points[next], share))
    }
}

/// The point at a share of the way.
pub fn mix(from: Point2<f64>, to: Point2<f64>, share: f64) -> Point2<f64> {
    let (a, b) = (1.0 - share, share);
    Point2::new(a * from.x + b * to.x, a * from.y + b * to.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Curve {
        let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [0.0, 0.0]];
        Curve::new(corners.iter().map(|c| Point2::new(c[0], c[1])).collect())
    }

    #[test]
    fn halfway_by_hand() {
        let between = |a: [f64; 2], b: [f64; 2]| {
            square().between(Point2::new(a[0], a[1]), Point2::new(b[0], b[1]))
        };
        assert_eq!(between([1.0, 0.0], [2.0, 1.0]), Some(Point2::new(2.0, 0.0)));
        // past the place where the polyline begins
        assert_eq!(between([1.0, 0.0], [0.0, 1.0]), Some(Point2::new(0.0, 0.0)));
        assert_eq!(between([1.0, 1.0], [2.0, 1.0]), None);
    }
}
