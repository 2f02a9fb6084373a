//! A surface by brute force: the reference that our surfaces are compared with.
//!
//! Each tetrahedron is cut into `n³` small ones, alike from both sides of a face; the
//! cubic is sampled at their corners, and marching tetrahedra give the surface. It knows
//! nothing of roots, certificates or division; it misses what is smaller than its spacing.

use std::collections::HashMap;

use vtu2contour::interpolant::TetrahedronCubics;

/// Euler characteristics of the components of a surface, ascending: 2 for a sphere, 1 for a
/// disc, 0 for a ring or a torus.
pub type Characteristics = Vec<i64>;

/// A sample point by the points of the mesh around it and their weights: the same in all
/// tetrahedra that share it.
type Sample = [(u32, u32); 4];

const NONE: (u32, u32) = (u32::MAX, 0);

/// The orders in which a small cube's three axes are walked: its six tetrahedra.
const WALKS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

/// The surface at `level`, with `n` samples an edge.
pub fn characteristics(f: &dyn TetrahedronCubics, level: f64, n: u32) -> Characteristics {
    let mut complex = Complex::default();
    for tetrahedron in 0..f.mesh().tetrahedra().len() {
        let mut points = [0, 1, 2, 3].map(|k| (f.mesh().tetrahedra()[tetrahedron][k], k));
        points.sort_unstable();
        let cubic = f.cubic(tetrahedron);
        let (low, high) = cubic.bounds();
        if level < low || level > high {
            continue;
        }
        let weights = |[x, y, z]: [u32; 3]| [n - x, x - y, y - z, z];
        let is_above = |at: [u32; 3]| {
            let mut barycentric = [0.0; 4];
            for ((_, place), weight) in points.iter().zip(weights(at)) {
                barycentric[*place] = f64::from(weight) / f64::from(n);
            }
            cubic.value(&barycentric) >= level
        };
        let sample = |at: [u32; 3]| {
            let held = |k: usize| (weights(at)[k] > 0).then(|| (points[k].0, weights(at)[k]));
            let mut sample = [NONE; 4];
            for (place, one) in (0..4).filter_map(held).enumerate() {
                sample[place] = one;
            }
            sample
        };
        let values = Lattice::new(n, is_above);
        for x in 0..n {
            for y in 0..=x {
                for z in 0..=y {
                    for walk in WALKS {
                        if let Some(corners) = small([x, y, z], walk) {
                            complex.add(&corners, &values, &sample);
                        }
                    }
                }
            }
        }
    }
    complex.characteristics()
}

/// The corners of a small tetrahedron, if it lies in the large one: x ≥ y ≥ z.
fn small(start: [u32; 3], walk: [usize; 3]) -> Option<[[u32; 3]; 4]> {
    let mut corners = [start; 4];
    for step in 0..3 {
        corners[step + 1] = corners[step];
        corners[step + 1][walk[step]] += 1;
    }
    corners.iter().all(|[x, y, z]| x >= y && y >= z).then_some(corners)
}

/// On which side of the level the samples of a tetrahedron lie.
struct Lattice {
    side: usize,
    above: Vec<bool>,
}

impl Lattice {
    fn new(n: u32, is_above: impl Fn([u32; 3]) -> bool) -> Self {
        let side = n as usize + 1;
        let mut above = vec![false; side.pow(3)];
        for x in 0..=n {
            for y in 0..=x {
                for z in 0..=y {
                    above[(x as usize * side + y as usize) * side + z as usize] =
                        is_above([x, y, z]);
                }
            }
        }
        Self { side, above }
    }

    fn at(&self, [x, y, z]: [u32; 3]) -> bool {
        self.above[(x as usize * self.side + y as usize) * self.side + z as usize]
    }
}

/// Crossings of small edges and small faces, and which belong together.
#[derive(Default)]
struct Complex {
    edges: HashMap<[Sample; 2], usize>,
    /// For each crossed small face, one of its crossings.
    faces: HashMap<[Sample; 3], usize>,
    /// For each crossed small tetrahedron, one of its crossings.
    cells: Vec<usize>,
    parents: Vec<usize>,
}

impl Complex {
    fn add(
        &mut self,
        corners: &[[u32; 3]; 4],
        values: &Lattice,
        name: &impl Fn([u32; 3]) -> Sample,
    ) {
        let above = corners.map(|corner| values.at(corner));
        if above.iter().all(|&side| side == above[0]) {
            return;
        }
        let names = corners.map(name);
        let mut first = None;
        for a in 0..4 {
            for b in 0..a {
                if above[a] != above[b] {
                    let crossing = self.edge([names[a], names[b]]);
                    let root = *first.get_or_insert(crossing);
                    self.join(root, crossing);
                }
            }
        }
        let Some(first) = first else { return };
        self.cells.push(first);
        for left_out in 0..4 {
            let face: Vec<usize> = (0..4).filter(|&k| k != left_out).collect();
            if face.iter().any(|&k| above[k] != above[face[0]]) {
                let mut named = [0, 1, 2].map(|k| names[face[k]]);
                named.sort_unstable();
                self.faces.entry(named).or_insert(first);
            }
        }
    }

    fn edge(&mut self, mut ends: [Sample; 2]) -> usize {
        ends.sort_unstable();
        let next = self.parents.len();
        let place = *self.edges.entry(ends).or_insert(next);
        if place == next {
            self.parents.push(next);
        }
        place
    }

    fn root(&mut self, mut node: usize) -> usize {
        while self.parents[node] != node {
            self.parents[node] = self.parents[self.parents[node]];
            node = self.parents[node];
        }
        node
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b)] = a.min(b);
    }

    /// Crossed edges, less crossed faces, plus crossed cells: points, sides and polygons.
    fn characteristics(mut self) -> Characteristics {
        let mut sums: HashMap<usize, i64> = HashMap::new();
        for node in 0..self.parents.len() {
            *sums.entry(self.root(node)).or_default() += 1;
        }
        for node in self.faces.values().copied().collect::<Vec<_>>() {
            *sums.entry(self.root(node)).or_default() -= 1;
        }
        for node in self.cells.clone() {
            *sums.entry(self.root(node)).or_default() += 1;
        }
        let mut found: Characteristics = sums.into_values().collect();
        found.sort_unstable();
        found
    }
}
