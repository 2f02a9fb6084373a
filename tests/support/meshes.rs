//! Meshes for tests.

use spade::{DelaunayTriangulation, Point2, Triangulation};
use vtu2contour::mesh::{TriangleMesh, Vector};

/// Random numbers that are the same every time: SplitMix64 (Steele, Lea, Flood 2014).
pub struct Random(pub u64);

impl Random {
    /// A uniform number in `[low, high)`.
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^= bits >> 31;
        let unit = (bits >> 11) as f64 / (1_u64 << 53) as f64;
        low + unit * (high - low)
    }
}

/// The Delaunay mesh of the corners of the unit square and `count` random points in it.
pub fn random_square(random: &mut Random, count: usize) -> TriangleMesh<'static> {
    let mut points = vec![Point2::new(0.0, 0.0), Point2::new(1.0, 0.0)];
    points.extend([Point2::new(0.0, 1.0), Point2::new(1.0, 1.0)]);
    for _ in 0..count {
        points.push(Point2::new(random.uniform(0.0, 1.0), random.uniform(0.0, 1.0)));
    }
    delaunay(points)
}

/// The Delaunay mesh of points.
pub fn delaunay(points: Vec<Point2<f64>>) -> TriangleMesh<'static> {
    let triangulation = DelaunayTriangulation::<Point2<f64>>::bulk_load_stable(points).unwrap();
    let points = triangulation.vertices().map(|v| Vector::new(v.position().x, v.position().y, 0.0));
    let points: Vec<Vector> = points.collect();
    let triangles = triangulation
        .inner_faces()
        .map(|face| face.vertices().map(|vertex| vertex.index() as u32))
        .collect();
    TriangleMesh::new(points, triangles).unwrap()
}

/// The unit square as `n` by `n` squares, each cut into two triangles.
pub fn grid(n: usize) -> TriangleMesh<'static> {
    let at = |k: usize| k as f64 / n as f64;
    let points = (0..=n).flat_map(|j| (0..=n).map(move |i| Vector::new(at(i), at(j), 0.0)));
    let corner = |i: usize, j: usize| (j * (n + 1) + i) as u32;
    let mut triangles = Vec::new();
    for j in 0..n {
        for i in 0..n {
            let [a, b, c, d] =
                [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    TriangleMesh::new(points.collect(), triangles).unwrap()
}

/// A grid with its diagonals mirrored at x = 1/2.
pub fn symmetric_grid(n: usize) -> TriangleMesh<'static> {
    let plain = grid(n);
    let turned = plain.triangles().chunks(2).flat_map(|pair| {
        let [[a, b, c], [_, _, d]] = [pair[0], pair[1]];
        let is_left = plain.points()[b as usize].x <= 0.5;
        if is_left { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
    });
    TriangleMesh::new(plain.points().to_vec(), turned.collect()).unwrap()
}
