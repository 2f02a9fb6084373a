//! Points on a circle: which of two diagonals.
//!
//! Where four points lie on a circle, both diagonals are Delaunay, and rounding and the order of
//! insertion choose. Here geometry does, in a way that every symmetry of the mesh respects: the
//! shorter diagonal, or of equal ones that whose line passes nearer to the middle of the mesh.
//! Only edges of triangles at new points are looked at.

use rayon::slice::ParallelSliceMut;
use spade::Point2;

use super::features::sorted;
use super::triangulation::cross;

/// The points that are triangulated.
pub struct Ties<'a> {
    pub position: &'a dyn Fn(u32) -> Point2<f64>,
    /// The first of the new points.
    pub first_new: u32,
    /// Whether an edge is kept as it is.
    pub is_kept: &'a dyn Fn([u32; 2]) -> bool,
}

/// What is closer than this, relative to its size, is the same.
const SAME: f64 = 1e-9;

/// A triangle at each side of an edge, and its corner opposite.
type Sides = [Option<(usize, u32)>; 2];

impl Ties<'_> {
    /// Turns diagonals of counter-clockwise triangles.
    pub fn settle(&self, triangles: &mut [[u32; 3]]) {
        let Some(centre) = self.centre(triangles) else { return };
        // each turn lowers the sum of all lengths, or else that of the distances
        loop {
            let edges = self.edges(triangles);
            let mut is_turned = vec![false; triangles.len()];
            let mut count = 0;
            for (edge, sides) in edges {
                let [Some((one, c)), Some((other, d))] = sides else { continue };
                if is_turned[one] || is_turned[other] || !self.should_turn(edge, [c, d], centre) {
                    continue;
                }
                let [a, b] = edge;
                triangles[one] = [c, a, d];
                triangles[other] = [d, b, c];
                for triangle in [one, other] {
                    let [p, q, r] = triangles[triangle].map(|point| (self.position)(point));
                    if cross(p, q, r) < 0.0 {
                        triangles[triangle].swap(1, 2);
                    }
                    is_turned[triangle] = true;
                }
                count += 1;
            }
            if count == 0 {
                return;
            }
        }
    }

    /// The middle of the mesh: the mean of its points would depend on where it is fine.
    fn centre(&self, triangles: &[[u32; 3]]) -> Option<Point2<f64>> {
        let (mut area, mut x, mut y) = (0.0, 0.0, 0.0);
        for triangle in triangles {
            let [a, b, c] = triangle.map(|point| (self.position)(point));
            let part = cross(a, b, c);
            area += part;
            x += part * (a.x + b.x + c.x) / 3.0;
            y += part * (a.y + b.y + c.y) / 3.0;
        }
        (area > 0.0).then(|| Point2::new(x / area, y / area))
    }

    /// The edges of triangles that a new point is a corner of, with both their triangles, sorted.
    fn edges(&self, triangles: &[[u32; 3]]) -> Vec<([u32; 2], Sides)> {
        let is_near = |triangle: &[u32; 3]| triangle.iter().any(|p| *p >= self.first_new);
        let count = triangles.iter().flatten().max().map_or(0, |&most| most as usize + 1);
        let mut is_end = vec![false; count];
        for triangle in triangles.iter().filter(|triangle| is_near(triangle)) {
            triangle.iter().for_each(|&point| is_end[point as usize] = true);
        }
        // the edge, its side, the triangle there and its corner opposite
        let mut named: Vec<([u32; 2], usize, usize, u32)> = Vec::new();
        for (number, &[a, b, c]) in triangles.iter().enumerate() {
            for ([p, q], opposite) in [([a, b], c), ([b, c], a), ([c, a], b)] {
                if is_end[p as usize] && is_end[q as usize] {
                    named.push((sorted([p, q]), usize::from(p > q), number, opposite));
                }
            }
        }
        named.par_sort_unstable();
        let groups = named.chunk_by(|one, next| one.0 == next.0);
        let near = groups.filter(|group| group.iter().any(|side| is_near(&triangles[side.2])));
        let near = near.filter(|group| !(self.is_kept)(group[0].0));
        let both = near.map(|group| {
            let mut sides = Sides::default();
            group.iter().for_each(|&(_, side, number, c)| sides[side] = Some((number, c)));
            (group[0].0, sides)
        });
        both.collect()
    }

    /// Whether the other diagonal is as good by Delaunay's rule, and better by ours.
    fn should_turn(&self, edge: [u32; 2], opposite: [u32; 2], centre: Point2<f64>) -> bool {
        let [[a, b], [c, d]] = [edge, opposite].map(|ends| ends.map(|end| (self.position)(end)));
        if !is_on_circle(a, b, c, d) {
            return false;
        }
        let [own, other] = [[a, b], [c, d]].map(|[p, q]| p.distance_2(q).sqrt());
        let size = own.max(other);
        if (own - other).abs() > SAME * size {
            return other < own;
        }
        let distance = |p: Point2<f64>, q: Point2<f64>| cross(p, q, centre).abs() / size;
        let [own, other] = [distance(a, b), distance(c, d)];
        own - other > SAME * size
    }
}

/// Whether four points lie on a circle, as far as rounding can tell: the angles at `c` and `d`
/// over the edge from `a` to `b` make 180 degrees.
fn is_on_circle(a: Point2<f64>, b: Point2<f64>, c: Point2<f64>, d: Point2<f64>) -> bool {
    let angle = |at: Point2<f64>| {
        let dot = (a.x - at.x) * (b.x - at.x) + (a.y - at.y) * (b.y - at.y);
        cross(at, a, b).abs().atan2(dot)
    };
    (angle(c) + angle(d) - std::f64::consts::PI).abs() < SAME
}
