//! A contour by brute force: the reference that our contours are compared with.
//!
//! Each triangle is cut into `n` by `n` small ones, the cubic is sampled at their
//! corners, and marching triangles give segments. It knows nothing of roots,
//! certificates or subdivision; it misses what is smaller than its spacing.

use std::collections::HashMap;

use vtu2contour::interpolant::TriangleCubics;

/// Connected components of a contour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Components {
    /// All components.
    pub all: usize,
    /// Those that are closed.
    pub closed: usize,
}

/// A sample point, so named that neighbouring triangles agree: a mesh point, a
/// place on a mesh edge, or a place in a triangle.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
enum Sample {
    Point(u32),
    Edge(u32, u32, usize),
    Inside(usize, usize, usize),
}

/// The components of the contour at `level`, with `n` samples an edge.
pub fn components(interpolant: &dyn TriangleCubics, level: f64, n: usize) -> Components {
    let mut links: HashMap<(Sample, Sample), Vec<(Sample, Sample)>> = HashMap::new();
    for triangle in 0..interpolant.mesh().triangles().len() {
        for [a, b] in segments(interpolant, triangle, level, n) {
            links.entry(a).or_default().push(b);
            links.entry(b).or_default().push(a);
        }
    }
    count(&links)
}

type Crossing = (Sample, Sample);

fn segments(
    interpolant: &dyn TriangleCubics,
    triangle: usize,
    level: f64,
    n: usize,
) -> Vec<[Crossing; 2]> {
    let cubic = interpolant.cubic(triangle);
    let points = interpolant.mesh().triangles()[triangle];
    let above = |j: usize, k: usize| {
        let at = [(n - j - k) as f64, j as f64, k as f64].map(|x| x / n as f64);
        cubic.value(&at) >= level
    };
    let sample = |j: usize, k: usize| name(triangle, points, [n - j - k, j, k], n);
    let mut segments = Vec::new();
    let mut small = |corners: [(usize, usize); 3]| {
        let mut crossings = Vec::new();
        for side in 0..3 {
            let ((aj, ak), (bj, bk)) = (corners[side], corners[(side + 1) % 3]);
            if above(aj, ak) != above(bj, bk) {
                let (a, b) = (sample(aj, ak), sample(bj, bk));
                crossings.push(if a < b { (a, b) } else { (b, a) });
            }
        }
        if let [a, b] = crossings[..] {
            segments.push([a, b]);
        }
    };
    for j in 0..n {
        for k in 0..n - j {
            small([(j, k), (j + 1, k), (j, k + 1)]);
            if j + k + 2 <= n {
                small([(j + 1, k), (j + 1, k + 1), (j, k + 1)]);
            }
        }
    }
    segments
}

fn name(triangle: usize, points: [u32; 3], weights: [usize; 3], n: usize) -> Sample {
    if let Some(corner) = weights.iter().position(|&w| w == n) {
        return Sample::Point(points[corner]);
    }
    if let Some(opposite) = weights.iter().position(|&w| w == 0) {
        let (a, b) = ((opposite + 1) % 3, (opposite + 2) % 3);
        let (low, high) = if points[a] < points[b] { (a, b) } else { (b, a) };
        return Sample::Edge(points[low], points[high], weights[high]);
    }
    Sample::Inside(triangle, weights[1], weights[2])
}

fn count(links: &HashMap<Crossing, Vec<Crossing>>) -> Components {
    let mut seen: HashMap<Crossing, bool> = HashMap::new();
    let mut components = Components { all: 0, closed: 0 };
    for &start in links.keys() {
        if seen.contains_key(&start) {
            continue;
        }
        let mut waiting = vec![start];
        let mut closed = true;
        while let Some(crossing) = waiting.pop() {
            if seen.insert(crossing, true).is_none() {
                closed &= links[&crossing].len() == 2;
                waiting.extend(&links[&crossing]);
            }
        }
        components.all += 1;
        components.closed += usize::from(closed);
    }
    components
}
