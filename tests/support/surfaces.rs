//! What surfaces in the unit cube are checked for.

use std::collections::{HashMap, HashSet};

use vtu2contour::contour::surface::ContourSurface;
use vtu2contour::mesh::Vector;

/// Whether two points lie in one side of the unit cube.
pub fn on_boundary(a: &Vector, b: &Vector) -> bool {
    let near = |x: f64, side: f64| (x - side).abs() < 1e-12;
    (0..3).any(|n| [0.0, 1.0].iter().any(|&side| near(a[n], side) && near(b[n], side)))
}

/// Every edge inside belongs to an even number of triangles, half of them in each direction:
/// sheets may meet in an edge. No triangle is doubled, or has the same corner twice.
pub fn check_even(surface: &ContourSurface, name: &str) {
    let mut edges: HashMap<[u32; 2], i32> = HashMap::new();
    let mut names = HashSet::new();
    for triangle in &surface.triangles {
        let mut sorted = *triangle;
        sorted.sort_unstable();
        assert!(sorted[0] < sorted[1] && sorted[1] < sorted[2], "{name}: {sorted:?}");
        assert!(names.insert(sorted), "{name}: doubled");
        for n in 0..3 {
            let [a, b] = [triangle[n], triangle[(n + 1) % 3]];
            *edges.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
        }
    }
    for (edge, balance) in edges {
        let [a, b] = edge.map(|n| surface.points[n as usize].position);
        assert!(balance == 0 || on_boundary(&a, &b), "{name}: {balance} at {a} {b}");
    }
}

/// The area of all triangles.
pub fn area(surface: &ContourSurface) -> f64 {
    let area = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|n| surface.points[n as usize].position);
        0.5 * (b - a).cross(&(c - a)).norm()
    };
    surface.triangles.iter().map(area).sum()
}
