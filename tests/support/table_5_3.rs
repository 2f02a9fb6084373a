//! Tables 5.3 and 5.4: the interpolants on random tetrahedra, problems 5 and 6.
//!
//! As in the thesis (section 5.2.2), the mesh is the Delaunay mesh of random points and
//! the corners of the unit cube, and the error is that at 1000 regular points: here the
//! centres of 10 by 10 by 10 cubes.

use vtu2contour::field::Field;
use vtu2contour::interpolant::family::spaces::{P2, P2_HAT, P3};
use vtu2contour::interpolant::family::{Dei, DeiOptions, Space};
use vtu2contour::interpolant::{Equation, Linear, Pieces, Predictor, Tricubic};
use vtu2contour::mesh::{PointLocator, TetrahedronMesh, Vector};
use vtu2contour::pde::Pde;

use super::meshes::Random;
use super::problems_3d::{FIFTH, Problem, SIXTH};
use super::tetrahedra::random_cube;

/// An interpolant of the tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Member {
    P3,
    P2,
    P2Hat,
}

/// The columns, in the thesis' order.
pub const MEMBERS: [Member; 3] = [Member::P3, Member::P2, Member::P2Hat];

/// Points, and the thesis' errors of each interpolant.
type Sizes = [(usize, [f64; 3]); 4];

/// The problems with the thesis' errors.
pub const THESIS: [(Problem, Sizes); 2] = [
    (
        FIFTH,
        [
            (64, [8.4e-3, 1.065e-1, 2.95e-2]),
            (512, [4.97e-4, 9.6e-3, 5.8e-3]),
            (4096, [3.76e-5, 1.3e-3, 1.31e-4]),
            (32768, [5.56e-6, 1.67e-4, 4.04e-5]),
        ],
    ),
    (
        SIXTH,
        [
            (64, [1.5e-3, 2.03e-2, 8.6e-3]),
            (512, [5.42e-5, 2.8e-3, 2.3e-3]),
            (4096, [4.76e-6, 1.72e-4, 3.14e-5]),
            (32768, [4.77e-7, 2.98e-5, 1.02e-5]),
        ],
    ),
];

/// The thesis' times in seconds (table 5.4), by the same problems and points.
pub const THESIS_TIMES: [[[f64; 3]; 4]; 2] = [
    [
        [1.021, 2.193, 0.621],
        [10.71, 24.68, 6.098],
        [118.9, 332.2, 56.31],
        [3976.0, 10682.0, 1143.0],
    ],
    [
        [1.091, 2.003, 0.711],
        [10.33, 21.87, 6.259],
        [119.3, 291.8, 52.81],
        [3995.0, 10629.0, 1016.0],
    ],
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
    /// The thesis' errors.
    pub thesis: [f64; 3],
    /// The thesis' interpolants on our mesh: every piece kept, the linear predictor.
    pub as_thesis: [f64; 3],
    /// The same spaces with the quadratic predictor and hardly determined pieces replaced.
    pub family: [f64; 3],
    /// Ours, which is continuous.
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

fn row(problem: &Problem, mesh: &TetrahedronMesh, thesis: [f64; 3]) -> Row {
    let (values, gradients) = problem.at_points(mesh);
    let field = Field { values: &values, gradients: &gradients };
    let pde = Pde::parse(problem.pde, &[], &[]).expect("the PDE is one");
    let places = regular_places(mesh);
    let error = |pieces: &dyn Pieces<4>| {
        let errors = places.iter().map(|(tetrahedron, at)| {
            let exact = (problem.value)(&mesh.position(*tetrahedron, at));
            (pieces.taylor(*tetrahedron, at).value - exact).abs()
        });
        errors.sum::<f64>() / places.len() as f64
    };
    let with = |predictor, limit| {
        let equation = Equation { pde: &pde, arrays: &[], predictor };
        let options = DeiOptions { limit, ..DeiOptions::default() };
        MEMBERS.map(|member| error(&*member.build(mesh, field, &equation, &options)))
    };
    let equation = Equation { pde: &pde, arrays: &[], predictor: Predictor::Quadratic };
    Row {
        problem: problem.number,
        points: mesh.points().len(),
        tetrahedra: mesh.tetrahedra().len(),
        thesis,
        as_thesis: with(Predictor::Linear, f64::INFINITY),
        family: with(Predictor::Quadratic, DeiOptions::default().limit),
        continuous: error(&Tricubic::with_pde(mesh, field, &equation)),
        without_pde: error(&Tricubic::new(mesh, field)),
        quadratic_precision: error(&Tricubic::with_quadratic_precision(mesh, field)),
        linear: error(&Linear::new(mesh, &values)),
    }
}

impl Member {
    pub fn name(self) -> &'static str {
        match self {
            Self::P3 => P3.name,
            Self::P2 => P2.name,
            Self::P2Hat => P2_HAT.name,
        }
    }

    /// The interpolant.
    pub fn build<'a>(
        self,
        mesh: &'a TetrahedronMesh,
        field: Field<'a>,
        equation: &Equation,
        options: &DeiOptions,
    ) -> Box<dyn Pieces<4> + 'a> {
        fn boxed<'a, const N: usize>(
            space: Space<4, N>,
            mesh: &'a TetrahedronMesh,
            field: Field<'a>,
            equation: &Equation,
            options: &DeiOptions,
        ) -> Box<dyn Pieces<4> + 'a> {
            Box::new(Dei::new(space, mesh, field, equation, options))
        }
        match self {
            Self::P3 => boxed(P3, mesh, field, equation, options),
            Self::P2 => boxed(P2, mesh, field, equation, options),
            Self::P2Hat => boxed(P2_HAT, mesh, field, equation, options),
        }
    }
}

/// The regular points: the tetrahedron that holds each, and where.
fn regular_places(mesh: &TetrahedronMesh) -> Vec<(usize, [f64; 4])> {
    let locator = PointLocator::new(mesh);
    let regular = |n: usize| (n as f64 + 0.5) / REGULAR as f64;
    let point =
        |n: usize| [n % REGULAR, n / REGULAR % REGULAR, n / (REGULAR * REGULAR)].map(regular);
    (0..REGULAR.pow(3))
        .map(|n| {
            let point = Vector::from(point(n));
            let place = locator.locate(mesh, &point, 1e-12).expect("the mesh fills the cube");
            (place.simplex, place.at)
        })
        .collect()
}
