//! Meshes of tetrahedra for tests.

use vtu2contour::mesh::{TetrahedronMesh, Vector};

use super::delaunay_3d::Delaunay;
use super::meshes::Random;

/// The six tetrahedra of a cube around its diagonal from corner 0 to corner 7 (Kuhn
/// 1960), each of positive volume.
pub const KUHN: [[u32; 4]; 6] =
    [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];

/// A corner of the unit cube: the bits of its number are x, y and z.
pub fn cube_corner(number: u32) -> Vector {
    Vector::from([0, 1, 2].map(|axis| f64::from(number >> axis & 1)))
}

/// The Delaunay mesh of the corners of the unit cube and random points in it, `count`
/// points in all, as in the thesis' section 5.2.2.
pub fn random_cube(random: &mut Random, count: usize) -> TetrahedronMesh<'static> {
    cube_of(count, || Vector::from([(); 3].map(|()| random.uniform(0.0, 1.0))))
}

/// As [`random_cube`], with many more points towards the corner at the origin: tetrahedra
/// of all sizes, many of them thin.
pub fn graded_cube(random: &mut Random, count: usize) -> TetrahedronMesh<'static> {
    cube_of(count, || Vector::from([(); 3].map(|()| random.uniform(0.0, 1.0).powi(3))))
}

fn cube_of(count: usize, mut point: impl FnMut() -> Vector) -> TetrahedronMesh<'static> {
    let mut delaunay = Delaunay::new();
    for _ in 8..count {
        delaunay.insert(point());
    }
    let tetrahedra = delaunay.tetrahedra();
    TetrahedronMesh::new(delaunay.points, tetrahedra).unwrap()
}

/// The unit cube as `n` by `n` by `n` cubes, each cut into six tetrahedra alike, so that
/// neighbours agree on their common faces.
pub fn kuhn_grid(n: usize) -> TetrahedronMesh<'static> {
    let at = |k: usize| k as f64 / n as f64;
    let side = n + 1;
    let points = (0..side.pow(3))
        .map(|k| Vector::new(at(k % side), at(k / side % side), at(k / (side * side))));
    let mut tetrahedra = Vec::new();
    for cube in 0..n.pow(3) {
        let first = [cube % n, cube / n % n, cube / (n * n)];
        let point = |corner: u32| {
            let [i, j, k] = [0, 1, 2].map(|axis| first[axis] + (corner as usize >> axis & 1));
            ((k * side + j) * side + i) as u32
        };
        tetrahedra.extend(KUHN.map(|corners| corners.map(point)));
    }
    TetrahedronMesh::new(points.collect(), tetrahedra).unwrap()
}

/// The same mesh with the tetrahedra, and the corners of each, in random order.
pub fn shuffled(random: &mut Random, mesh: &TetrahedronMesh) -> TetrahedronMesh<'static> {
    let mut tetrahedra = mesh.tetrahedra().to_vec();
    shuffle(random, &mut tetrahedra);
    for corners in &mut tetrahedra {
        shuffle(random, corners);
    }
    TetrahedronMesh::new(mesh.points().to_vec(), tetrahedra).unwrap()
}

/// The same mesh with points numbered at random and, inside the unit cube, moved by up to
/// `amount` along each axis; shuffled.
pub fn renumbered(
    random: &mut Random,
    mesh: &TetrahedronMesh,
    amount: f64,
) -> TetrahedronMesh<'static> {
    let mut order: Vec<u32> = (0..mesh.points().len() as u32).collect();
    shuffle(random, &mut order);
    let mut points = mesh.points().to_vec();
    for (point, &number) in mesh.points().iter().zip(&order) {
        let mut moved = |x: f64| {
            let is_inside = x > 0.0 && x < 1.0;
            if is_inside { x + random.uniform(-amount, amount) } else { x }
        };
        points[number as usize] = Vector::new(moved(point.x), moved(point.y), moved(point.z));
    }
    let named = mesh.tetrahedra().iter().map(|corners| corners.map(|n| order[n as usize]));
    let tetrahedra = named.collect();
    shuffled(random, &TetrahedronMesh::new(points, tetrahedra).unwrap())
}

fn shuffle<T>(random: &mut Random, items: &mut [T]) {
    for end in (1..items.len()).rev() {
        items.swap(end, random.uniform(0.0, end as f64 + 1.0) as usize);
    }
}
