//! How far a contour is from the lines that were drawn.

use vtu2contour::bernstein::between;
use vtu2contour::contour::lines::ContourLines;
use vtu2contour::interpolant::TriangleCubics;
use vtu2contour::mesh::Vector;

/// Points of the contour found by bisection along the lines of a lattice in each cell.
pub fn sampled(interpolant: &dyn TriangleCubics, level: f64, n: usize) -> Vec<Vector> {
    let mut points = Vec::new();
    for cell in 0..interpolant.mesh().triangles().len() {
        let cubic = interpolant.cubic(cell).minus(level);
        let at = |j: f64, k: f64| [n as f64 - j - k, j, k].map(|x| x / n as f64);
        for (j, k) in (0..n).flat_map(|j| (0..n - j).map(move |k| (j as f64, k as f64))) {
            for to in [at(j + 1.0, k), at(j, k + 1.0)] {
                let from = at(j, k);
                let (start, end) = (cubic.value(&from), cubic.value(&to));
                if start * end < 0.0 {
                    let (mut low, mut high) = (0.0, 1.0);
                    for _ in 0..40 {
                        let middle = 0.5 * (low + high);
                        let value = cubic.value(&between(&from, &to, middle));
                        if value * start > 0.0 { low = middle } else { high = middle }
                    }
                    points.push(interpolant.mesh().position(cell, &between(&from, &to, low)));
                }
            }
        }
    }
    points
}

/// The distance of a point from the nearest segment.
pub fn distance_to_lines(lines: &ContourLines, point: &Vector) -> f64 {
    let mut least = f64::INFINITY;
    for line in &lines.lines {
        let points: Vec<_> = lines.line_points(line).map(|p| p.position).collect();
        for pair in points.windows(2) {
            let along = pair[1] - pair[0];
            let t = (point - pair[0]).dot(&along) / along.norm_squared();
            least = least.min((pair[0] + along * t.clamp(0.0, 1.0) - point).norm());
        }
    }
    least
}
