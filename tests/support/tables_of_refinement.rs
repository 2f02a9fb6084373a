//! Tables 5.12 to 5.16: meshes refined by five monitors against a uniform one.
//!
//! As in the thesis (section 5.4), every mesh has exactly so many points, and errors and defects
//! are those at 100 by 100 regular points inside. It does not tell its coarse meshes; here all
//! begin with the same symmetric grid. It judges meshes refined by the quartics with these; here
//! all are judged by the PCI, so that only the meshes differ.

use std::sync::OnceLock;

use nalgebra::Matrix3;
use vtu2contour::field::Field;
use vtu2contour::interpolant::family::spaces::{DEI4_15, FQI};
use vtu2contour::interpolant::family::{Dei, DeiOptions};
use vtu2contour::interpolant::{Equation, Pci, Pieces, Predictor};
use vtu2contour::mesh::{PointLocator, RefinedMesh, TriangleMesh, Vector};
use vtu2contour::monitor::{
    SamplePoints, Selection, defect, interpolation_error, once_refined, surface_area,
};
use vtu2contour::pde::{Pde, Sample};
use vtu2contour::refine::Marks;
use vtu2contour::refine::delaunay::{DelaunayOptions, delaunay};

use super::meshes::{grid, symmetric_grid};
use super::reference;

/// A monitor of the tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    Uniform,
    SurfaceArea,
    Defect,
    Stepwise,
    Interpolation,
}

/// In the thesis' order.
pub const METHODS: [Method; 5] =
    [Method::Uniform, Method::SurfaceArea, Method::Defect, Method::Stepwise, Method::Interpolation];

/// The numbers of points.
pub const POINTS: [usize; 4] = [900, 1600, 2500, 3600];

/// What is measured of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct Measured {
    pub average_error: f64,
    pub maximum_error: f64,
    pub maximum_defect: f64,
}

/// A table: its quantity, and the thesis' numbers, for each method those at each number of
/// points.
pub struct Compared {
    pub number: &'static str,
    pub problem: usize,
    pub what: &'static str,
    pub of: fn(&Measured) -> f64,
    pub thesis: [[f64; 4]; 5],
}

/// The thesis' tables. (In 5.12, "Stepwise, 3600" is printed as 2.32e-8; its ratio says 2.32e-7.)
pub const TABLES: [Compared; 5] = [
    Compared {
        number: "5.12",
        problem: 1,
        what: "average error",
        of: |measured| measured.average_error,
        thesis: [
            [6.06e-6, 1.75e-6, 1.03e-6, 4.89e-7],
            [3.45e-6, 9.46e-7, 6.87e-7, 3.37e-7],
            [2.32e-6, 7.98e-7, 3.15e-7, 1.54e-7],
            [3.30e-6, 9.70e-7, 4.30e-7, 2.32e-7],
            [2.17e-6, 6.84e-7, 2.54e-7, 1.14e-7],
        ],
    },
    Compared {
        number: "5.13",
        problem: 1,
        what: "maximum defect",
        of: |measured| measured.maximum_defect,
        thesis: [
            [1.44e-1, 9.05e-2, 6.01e-2, 3.99e-2],
            [9.53e-2, 5.02e-2, 3.26e-2, 2.72e-2],
            [5.39e-2, 3.46e-2, 2.49e-2, 1.50e-2],
            [7.38e-2, 3.96e-2, 2.92e-2, 1.72e-2],
            [7.51e-2, 3.18e-2, 1.91e-2, 1.31e-2],
        ],
    },
    Compared {
        number: "5.14",
        problem: 2,
        what: "average error",
        of: |measured| measured.average_error,
        thesis: [
            [3.17e-6, 9.97e-7, 4.07e-7, 1.83e-7],
            [1.66e-6, 6.11e-7, 2.34e-7, 1.04e-7],
            [3.06e-7, 1.06e-7, 4.62e-8, 2.16e-8],
            [6.16e-7, 1.88e-7, 7.43e-8, 3.61e-8],
            [3.59e-7, 1.28e-7, 5.26e-8, 2.81e-8],
        ],
    },
    Compared {
        number: "5.15",
        problem: 2,
        what: "maximum error",
        of: |measured| measured.maximum_error,
        thesis: [
            [2.73e-4, 8.85e-5, 3.93e-5, 1.88e-5],
            [2.01e-4, 7.05e-5, 2.39e-5, 1.42e-5],
            [6.42e-6, 2.41e-6, 7.58e-7, 3.14e-7],
            [2.01e-5, 4.25e-6, 3.93e-6, 1.81e-6],
            [4.50e-6, 1.79e-6, 7.29e-7, 4.81e-7],
        ],
    },
    Compared {
        number: "5.16",
        problem: 2,
        what: "maximum defect",
        of: |measured| measured.maximum_defect,
        thesis: [
            [6.74e-2, 3.72e-2, 2.73e-2, 1.63e-2],
            [4.87e-2, 2.84e-2, 1.80e-2, 1.20e-2],
            [1.36e-2, 7.56e-3, 4.63e-3, 3.33e-3],
            [1.65e-2, 9.07e-3, 5.73e-3, 4.21e-3],
            [1.39e-2, 7.83e-3, 5.01e-3, 3.51e-3],
        ],
    },
];

/// A test problem: its equation and its solution.
pub struct Problem {
    pub pde: Pde,
    pub solution: fn(&Vector) -> (f64, Vector),
}

const ALPHA: f64 = 100.0;
const PEAK: f64 = 0.117;

/// The thesis' problem 1 or 2.
pub fn problem(number: usize) -> Problem {
    if number == 1 {
        let parameters = [("beta".to_owned(), reference::BETA)];
        let pde = Pde::parse("uxx + uyy + beta*(1 - exp(2*x))*u = 0", &parameters, &[]).unwrap();
        return Problem { pde, solution: |point| reference::reference().at(point) };
    }
    let parameters = [("a".to_owned(), ALPHA), ("b".to_owned(), PEAK)];
    // the second derivative of (x² - x) exp(-a (x - c)²), and the function itself
    let bend = |x: &str, c: &str| {
        format!(
            "(2 - 4*a*({x} - {c})*(2*{x} - 1) + ({x}^2 - {x})*(4*a^2*({x} - {c})^2 - 2*a))\
             *exp(-a*({x} - {c})^2)"
        )
    };
    let value = |x: &str, c: &str| format!("({x}^2 - {x})*exp(-a*({x} - {c})^2)");
    let text = format!(
        "uxx + uyy = {}*{} + {}*{}",
        bend("x", "0.5"),
        value("y", "b"),
        value("x", "0.5"),
        bend("y", "b")
    );
    Problem { pde: Pde::parse(&text, &parameters, &[]).unwrap(), solution: peak }
}

/// Problem 2.
fn peak(point: &Vector) -> (f64, Vector) {
    let along = |x: f64, c: f64| {
        let bell = (-ALPHA * (x - c).powi(2)).exp();
        let slope = 2.0 * x - 1.0 - 2.0 * ALPHA * (x - c) * (x * x - x);
        ((x * x - x) * bell, slope * bell)
    };
    let ((p, dp), (q, dq)) = (along(point.x, 0.5), along(point.y, PEAK));
    (p * q, Vector::new(dp * q, p * dq, 0.0))
}

impl Method {
    pub fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::SurfaceArea => "surface area, PQI",
            Self::Defect => "defect, PCI",
            Self::Stepwise => "stepwise, PCI",
            Self::Interpolation => "FQI - PCI",
        }
    }

    /// The monitor on a mesh with the solution's data.
    pub fn monitor(self, mesh: &TriangleMesh, problem: &Problem) -> Vec<f64> {
        let data = Data::new(mesh, problem);
        let (equation, options) = (problem.equation(), DeiOptions::default());
        let (field, points) = (data.field(), SamplePoints::Fixed);
        let pci = Pci::with_pde(mesh, field, &equation);
        let pieces: &dyn Pieces<3> = &pci;
        match self {
            Self::Uniform => vec![1.0; mesh.triangles().len()],
            Self::Defect => defect(pieces, &equation, points),
            Self::SurfaceArea => {
                surface_area(&Dei::new(DEI4_15, mesh, field, &equation, &options), points)
            }
            Self::Interpolation => {
                let other = Dei::new(FQI, mesh, field, &equation, &options);
                interpolation_error(pieces, &other, points)
            }
            Self::Stepwise => {
                let refined = RefinedMesh::uniform(mesh, 2);
                let cells = refined.pieces.iter().map(|piece| piece.corners).collect();
                let fine = TriangleMesh::new(refined.points.clone(), cells).unwrap();
                let data = Data::new(&fine, problem);
                let finer = Pci::with_pde(&fine, data.field(), &equation);
                once_refined(pieces, &refined, &finer, points)
            }
        }
    }

    /// A mesh of exactly so many points, a square.
    pub fn mesh(self, problem: &Problem, points: usize) -> TriangleMesh<'static> {
        if self == Self::Uniform {
            return grid(points.isqrt() - 1);
        }
        let mut mesh = symmetric_grid(COARSE);
        while mesh.points().len() < points {
            mesh = self.step(&mesh, problem, points);
        }
        mesh
    }

    /// One step of refinement.
    pub fn step(
        self,
        mesh: &TriangleMesh,
        problem: &Problem,
        max_points: usize,
    ) -> TriangleMesh<'static> {
        step_by(&self.monitor(mesh, problem), mesh, max_points)
    }
}

/// One step of refinement: what is above twice the average, or if nothing is, above it.
fn step_by(monitor: &[f64], mesh: &TriangleMesh, max_points: usize) -> TriangleMesh<'static> {
    let selected = Selection::AboveAverage(2.0).select_some(monitor).unwrap();
    let marks = Marks { max_points, ..Marks::all(&selected) };
    let refined = delaunay(mesh, &marks, &DelaunayOptions::default()).unwrap();
    assert!(refined.points.len() > mesh.points().len(), "no step is made");
    TriangleMesh::new(refined.points, refined.cells).unwrap()
}

/// The area of the PCI's graph; the thesis' is that of the PQI's.
pub fn area_of_pci(mesh: &TriangleMesh, problem: &Problem) -> Vec<f64> {
    let data = Data::new(mesh, problem);
    surface_area(&Pci::with_pde(mesh, data.field(), &problem.equation()), SamplePoints::Fixed)
}

/// Squares along a side of the mesh that all begin with.
const COARSE: usize = 10;

impl Problem {
    pub fn equation(&self) -> Equation<'_> {
        Equation { pde: &self.pde, arrays: &[], predictor: Predictor::Quadratic }
    }

    /// What the PCI makes of a mesh.
    pub fn measure(&self, mesh: &TriangleMesh) -> Measured {
        let data = Data::new(mesh, self);
        let pci = Pci::with_pde(mesh, data.field(), &self.equation());
        let pieces: &dyn Pieces<3> = &pci;
        let locator = PointLocator::new(mesh);
        let at = |n: usize| (n as f64 + 0.5) / SIDE as f64;
        let (mut sum, mut maximum_error, mut maximum_defect) = (0.0, 0.0_f64, 0.0_f64);
        for place in 0..SIDE * SIDE {
            let point = Vector::new(at(place % SIDE), at(place / SIDE), 0.0);
            let found = locator.locate(mesh, &point, f64::INFINITY).unwrap();
            let taylor = pieces.taylor(found.simplex, &found.at);
            let error = (taylor.value - (self.solution)(&point).0).abs();
            sum += error;
            maximum_error = maximum_error.max(error);
            let sample = Sample {
                x: point.into(),
                u: taylor.value,
                gradient: taylor.gradient.into(),
                arrays: &[],
            };
            let laplacian = laplacian(&taylor.hessian);
            maximum_defect =
                maximum_defect.max((laplacian - self.pde.right_hand_side(&sample)).abs());
        }
        Measured { average_error: sum / (SIDE * SIDE) as f64, maximum_error, maximum_defect }
    }
}

/// Regular points along each side.
const SIDE: usize = 100;

fn laplacian(hessian: &Matrix3<f64>) -> f64 {
    hessian[(0, 0)] + hessian[(1, 1)]
}

/// Values and gradients of the solution at the points of a mesh.
struct Data(Vec<f64>, Vec<Vector>);

impl Data {
    fn new(mesh: &TriangleMesh, problem: &Problem) -> Self {
        let (values, gradients) = mesh.points().iter().map(problem.solution).unzip();
        Self(values, gradients)
    }

    fn field(&self) -> Field<'_> {
        Field { values: &self.0, gradients: &self.1 }
    }
}

/// For each method what is measured at each number of points, made once.
pub fn rows(number: usize) -> &'static [[Measured; 4]; 5] {
    static MADE: [OnceLock<[[Measured; 4]; 5]>; 2] = [OnceLock::new(), OnceLock::new()];
    MADE[number - 1].get_or_init(|| {
        let problem = problem(number);
        METHODS.map(|method| POINTS.map(|points| problem.measure(&method.mesh(&problem, points))))
    })
}
