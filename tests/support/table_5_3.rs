//! Table 5.3, column p3: average error of tri-cubics on random tetrahedra.
//!
//! As in the thesis (section 5.2.2), the mesh is the Delaunay mesh of random points and
//! the corners of the unit cube, and the error is that at 1000 regular points: here the
//! centres of 10 by 10 by 10 cubes.

use vtu2contour::bernstein::{Barycentric4, TetrahedronCubic};
use vtu2contour::field::Field;
use vtu2contour::interpolant::{
    DiscontinuousTricubic, Equation, Linear, Predictor, TetrahedronCubics, Tricubic,
};
use vtu2contour::mesh::{TetrahedronMesh, Vector};
use vtu2contour::pde::Pde;

use super::meshes::Random;
use super::problems_3d::{FIFTH, Problem, SIXTH};
use super::tetrahedra::random_cube;

/// The problems, points, and the thesis' errors of p3.
const THESIS: [(Problem, [(usize, f64); 4]); 2] = [
    (FIFTH, [(64, 8.4e-3), (512, 4.97e-4), (4096, 3.76e-5), (32768, 5.56e-6)]),
    (SIXTH, [(64, 1.5e-3), (512, 5.42e-5), (4096, 4.76e-6), (32768, 4.77e-7)]),
];

/// Regular points along each side of the cube.
const REGULAR: usize = 10;

/// One row of the table: average errors on one mesh.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The number of the problem.
    pub problem: usize,
    /// Points of the mesh.
    pub points: usize,
    /// Tetrahedra of the mesh.
    pub tetrahedra: usize,
    /// The thesis' error, discontinuous.
    pub thesis: f64,
    /// The thesis' interpolant, discontinuous, on our mesh.
    pub discontinuous: f64,
    /// Ours.
    pub continuous: f64,
    /// Ours without the PDE.
    pub without_pde: f64,
    /// Without neighbours too.
    pub quadratic_precision: f64,
    /// Of the linear interpolant.
    pub linear: f64,
}

/// The rows with at most `most` points, on meshes by chance from `seed`.
pub fn rows(most: usize, seed: u64) -> Vec<Row> {
    let mut rows = Vec::new();
    for (problem, sizes) in THESIS {
        for (points, thesis) in sizes.into_iter().filter(|(points, _)| *points <= most) {
            let mesh = random_cube(&mut Random(seed), points);
            rows.push(row(&problem, &mesh, thesis));
        }
    }
    rows
}

fn row(problem: &Problem, mesh: &TetrahedronMesh, thesis: f64) -> Row {
    let (values, gradients) = problem.at_points(mesh);
    let field = Field { values: &values, gradients: &gradients };
    let pde = Pde::parse(problem.pde, &[], &[]).expect("the PDE is one");
    let equation = |predictor| Equation { pde: &pde, arrays: &[], predictor };
    let ours = Tricubic::with_pde(mesh, field, &equation(Predictor::Quadratic));
    let theirs = DiscontinuousTricubic::with_pde(mesh, field, &equation(Predictor::Linear));
    let free = Tricubic::new(mesh, field);
    let plain = Tricubic::with_quadratic_precision(mesh, field);
    let linear = Linear::new(mesh, &values);
    let places = regular_places(mesh);
    let error = |cubic: &dyn Fn(usize) -> TetrahedronCubic| {
        let errors = places.iter().map(|(tetrahedron, at)| {
            let exact = (problem.value)(&mesh.position(*tetrahedron, at));
            (cubic(*tetrahedron).value(at) - exact).abs()
        });
        errors.sum::<f64>() / places.len() as f64
    };
    Row {
        problem: problem.number,
        points: mesh.points().len(),
        tetrahedra: mesh.tetrahedra().len(),
        thesis,
        discontinuous: error(&|tetrahedron| theirs.cubic(tetrahedron)),
        continuous: error(&|tetrahedron| ours.cubic(tetrahedron)),
        without_pde: error(&|tetrahedron| free.cubic(tetrahedron)),
        quadratic_precision: error(&|tetrahedron| plain.cubic(tetrahedron)),
        linear: error(&|tetrahedron| linear.cubic(tetrahedron)),
    }
}

/// The regular points: the tetrahedron that holds each, and where.
fn regular_places(mesh: &TetrahedronMesh) -> Vec<(usize, Barycentric4)> {
    let mut places = vec![None; REGULAR.pow(3)];
    let regular = |n: usize| (n as f64 + 0.5) / REGULAR as f64;
    for tetrahedron in 0..mesh.tetrahedra().len() {
        let frame = mesh.frame(tetrahedron);
        let [a, b, c, d] = frame.corners();
        let (low, high) = (a.inf(b).inf(c).inf(d), a.sup(b).sup(c).sup(d));
        // the regular points in the bounding box
        let first = low.map(|x| (x * REGULAR as f64 - 0.5).ceil().max(0.0) as usize);
        let end = high.map(|x| (x * REGULAR as f64 + 0.5).floor() as usize);
        for (n, place) in places.iter_mut().enumerate() {
            let [i, j, k] = [n % REGULAR, n / REGULAR % REGULAR, n / (REGULAR * REGULAR)];
            let inside = |axis: usize, n: usize| (first[axis]..end[axis]).contains(&n);
            if !(inside(0, i) && inside(1, j) && inside(2, k)) {
                continue;
            }
            let at = frame.barycentric(&Vector::new(regular(i), regular(j), regular(k)));
            if at.iter().all(|&weight| weight >= -1e-12) {
                *place = Some((tetrahedron, at));
            }
        }
    }
    places.into_iter().map(|place| place.expect("the mesh fills the cube")).collect()
}
