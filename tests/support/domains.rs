//! Meshes of domains in the plane as mesh generators make them: even points on the
//! boundary, less even ones inside.

use std::f64::consts::TAU;

use spade::Point2;
use vtu2contour::mesh::{TriangleMesh, Vector};

use super::meshes::{Random, delaunay};

/// A domain in the plane: its name, and its boundary as closed polygons.
pub struct Domain {
    pub name: &'static str,
    loops: Vec<Vec<[f64; 2]>>,
}

impl Domain {
    /// A rectangle with a corner at the origin.
    pub fn rectangle(name: &'static str, width: f64, height: f64) -> Self {
        Self { name, loops: vec![vec![[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]]] }
    }

    /// A rectangle, a disk, an L and an annulus, the round ones for meshes of width `h`.
    pub fn all(h: f64) -> [Self; 4] {
        let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        [
            Self::rectangle("rectangle", 2.0, 1.0),
            Self { name: "disk", loops: vec![circle(1.0, h)] },
            Self { name: "L", loops: vec![corners.to_vec()] },
            Self { name: "annulus", loops: vec![circle(1.0, h), circle(0.4, h)] },
        ]
    }

    /// A mesh of about the width `h`: equilateral triangles inside, their corners moved by
    /// up to a fifth of it.
    pub fn mesh(&self, random: &mut Random, h: f64) -> TriangleMesh<'static> {
        let mut points: Vec<[f64; 2]> = self.sides().flat_map(|side| divided(side, h)).collect();
        let edge = points.len();
        let rows = (3.0 / h) as i32;
        for (i, j) in (-rows..=rows).flat_map(|j| (-rows..=rows).map(move |i| (i, j))) {
            let mut moved = || random.uniform(-0.2, 0.2);
            let x = (f64::from(i) + 0.5 * f64::from(j % 2) + moved()) * h;
            let y = (f64::from(j) * 0.75_f64.sqrt() + moved()) * h;
            let clear = |p: &[f64; 2]| (p[0] - x).hypot(p[1] - y) > 0.6 * h;
            if self.contains([x, y]) && points[..edge].iter().all(clear) {
                points.push([x, y]);
            }
        }
        let all = delaunay(points.iter().map(|&[x, y]| Point2::new(x, y)).collect());
        let kept = (0..all.triangles().len()).filter(|&triangle| {
            let [a, b, c] = all.corners(triangle);
            let centroid = (a + b + c) / 3.0;
            let area = (b - a).cross(&(c - a)).z / 2.0;
            area > 1e-9 * h * h && self.contains([centroid.x, centroid.y])
        });
        let triangles = kept.map(|triangle| all.triangles()[triangle]).collect();
        TriangleMesh::new(all.points().to_vec(), triangles).unwrap()
    }

    fn sides(&self) -> impl Iterator<Item = [[f64; 2]; 2]> {
        self.loops.iter().flat_map(|corners| {
            (0..corners.len()).map(|k| [corners[k], corners[(k + 1) % corners.len()]])
        })
    }

    /// Whether a ray from a point crosses the boundary an odd number of times.
    fn contains(&self, [x, y]: [f64; 2]) -> bool {
        let crossed = self.sides().filter(|[a, b]| {
            (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
        });
        crossed.count() % 2 == 1
    }
}

/// A circle as a polygon of sides as long as `h`.
fn circle(radius: f64, h: f64) -> Vec<[f64; 2]> {
    let sides = (TAU * radius / h).round() as usize;
    let angles = (0..sides).map(|k| TAU * k as f64 / sides as f64);
    angles.map(|t| [radius * t.cos(), radius * t.sin()]).collect()
}

/// Points on a side, its end left out.
fn divided([a, b]: [[f64; 2]; 2], h: f64) -> Vec<[f64; 2]> {
    let parts = ((b[0] - a[0]).hypot(b[1] - a[1]) / h).round().max(1.0) as usize;
    let at = |t: f64, axis: usize| a[axis] + t * (b[axis] - a[axis]);
    (0..parts).map(|k| k as f64 / parts as f64).map(|t| [at(t, 0), at(t, 1)]).collect()
}

/// Which points lie on the boundary of a mesh.
pub fn on_boundary(mesh: &TriangleMesh) -> Vec<bool> {
    let mut on = vec![false; mesh.points().len()];
    for edge in vtu2contour::mesh::boundary_edges(mesh) {
        edge.iter().for_each(|&point| on[point as usize] = true);
    }
    on
}

/// sin 3x cos 4y cos 2z, its fourth derivatives up to 256.
pub fn waves(p: &Vector) -> f64 {
    (3.0 * p.x).sin() * (4.0 * p.y).cos() * (2.0 * p.z).cos()
}

/// The gradient of [`waves`].
pub fn slope_of_waves(p: &Vector) -> Vector {
    let [(sx, cx), (sy, cy), (sz, cz)] = [3.0 * p.x, 4.0 * p.y, 2.0 * p.z].map(f64::sin_cos);
    Vector::new(3.0 * cx * cy * cz, -4.0 * sx * sy * cz, -2.0 * sx * cy * sz)
}
