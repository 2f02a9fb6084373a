//! Tables 5.1 and 5.2: six interpolants on triangles, problem 4.
//!
//! As in the thesis (section 5.2.1), the error is the mean over a regular grid. It tells
//! neither where its random points are nor which grid: here the centres of 40 by 40
//! squares, and meshes of three kinds. A single sliver on the boundary can decide the
//! mean, so the median over several meshes is taken.

use vtu2contour::field::Field;
use vtu2contour::interpolant::family::spaces::{DEI, DEI3_13, DEI3_15, DEI4_15};
use vtu2contour::interpolant::family::{CollocationPoints, Dei, DeiOptions, Space};
use vtu2contour::interpolant::{Equation, Pci, Pieces, Predictor};
use vtu2contour::mesh::{PointLocator, TriangleMesh, Vector};
use vtu2contour::pde::Pde;

use super::domains::Domain;
use super::meshes::{Random, delaunay, random_square};
use super::problem4;
use spade::Point2;

/// An interpolant of the tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Member {
    Pci,
    Dei,
    Adei,
    Dei3_13,
    Dei3_15,
    Dei4_15,
}

/// The columns, in the thesis' order.
pub const MEMBERS: [Member; 6] =
    [Member::Pci, Member::Dei, Member::Adei, Member::Dei3_13, Member::Dei3_15, Member::Dei4_15];

const NONE: f64 = f64::NAN;

/// Points, and the thesis' errors.
pub const THESIS: [(usize, [f64; 6]); 6] = [
    (100, [0.034112, 0.105088, 0.039668, 0.901402, 0.161128, 0.036194]),
    (200, [0.004943, 0.292204, 0.005256, 0.005956, 0.033420, 0.007144]),
    (500, [0.000703, 0.004561, 0.000876, 0.001542, 0.004836, 0.000916]),
    (1000, [0.000208, 0.003134, 0.000278, 0.000426, 0.001198, 0.000210]),
    (2000, [0.000071, 0.001873, NONE, 0.000917, 0.000407, 0.000085]),
    (5000, [0.000009, 0.000077, NONE, 0.000019, 0.000116, 0.000011]),
];

/// The thesis' times in seconds (table 5.2), by the same points.
pub const THESIS_TIMES: [[f64; 6]; 6] = [
    [0.38, 1.21, 95.63, 0.77, 1.10, 1.10],
    [0.77, 2.48, 628.13, 1.59, 2.25, 2.19],
    [2.31, 6.54, 3570.60, 4.22, 5.77, 5.82],
    [3.85, 13.35, 19422.59, 8.68, 11.92, 11.81],
    [7.58, 26.64, NONE, 17.25, 23.72, 23.51],
    [18.68, 69.92, NONE, 44.66, 62.23, 61.90],
];

/// How the interpolants are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Random collocation points, the linear predictor, every piece kept.
    Thesis,
    /// Chosen points, the quadratic predictor, pieces that are hardly determined replaced.
    Ours,
}

/// What the points of a mesh are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Points {
    /// Random, and the four corners: triangles on the boundary are slivers.
    Random,
    /// The same, with a root of their number random on each side.
    RandomWithSides,
    /// As a mesh generator sets them.
    Quality,
}

impl Points {
    pub fn name(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::RandomWithSides => "random, sides too",
            Self::Quality => "quality",
        }
    }

    /// A Delaunay mesh of about so many points.
    pub fn mesh(self, count: usize, seed: u64) -> TriangleMesh<'static> {
        let mut random = Random(seed);
        match self {
            Self::Random => random_square(&mut random, count - 4),
            Self::RandomWithSides => with_sides(&mut random, count),
            Self::Quality => {
                let width = (2.0 / (3f64.sqrt() * count as f64)).sqrt();
                Domain::rectangle("square", 1.0, 1.0).mesh(&mut random, width)
            }
        }
    }
}

fn with_sides(random: &mut Random, count: usize) -> TriangleMesh<'static> {
    let side = (count as f64).sqrt().round() as usize - 2;
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let mut points = corners.to_vec();
    for _ in 0..side {
        let mut along = || random.uniform(0.0, 1.0);
        points.extend([[along(), 0.0], [along(), 1.0], [0.0, along()], [1.0, along()]]);
    }
    while points.len() < count {
        points.push([random.uniform(0.0, 1.0), random.uniform(0.0, 1.0)]);
    }
    delaunay(points.into_iter().map(|[x, y]| Point2::new(x, y)).collect())
}

impl Member {
    pub fn name(self) -> &'static str {
        match self {
            Self::Pci => "PCI",
            Self::Dei => "DEI",
            Self::Adei => "ADEI",
            Self::Dei3_13 => "DEI3-13",
            Self::Dei3_15 => "DEI3-15",
            Self::Dei4_15 => "DEI4-15",
        }
    }

    /// The interpolant of problem 4, and how many triangles have no piece of their own.
    pub fn build<'a>(
        self,
        mesh: &'a TriangleMesh,
        field: Field<'a>,
        pde: &Pde,
        way: Way,
    ) -> (Box<dyn Pieces<3> + 'a>, usize) {
        match self {
            Self::Pci => {
                let pci = Pci::with_pde(mesh, field, &way.equation(pde));
                let singular = pci.singular();
                (Box::new(pci), singular)
            }
            Self::Dei | Self::Adei => self.of_space(DEI, mesh, field, pde, way),
            Self::Dei3_13 => self.of_space(DEI3_13, mesh, field, pde, way),
            Self::Dei3_15 => self.of_space(DEI3_15, mesh, field, pde, way),
            Self::Dei4_15 => self.of_space(DEI4_15, mesh, field, pde, way),
        }
    }

    fn of_space<'a, const N: usize>(
        self,
        space: Space<3, N>,
        mesh: &'a TriangleMesh,
        field: Field<'a>,
        pde: &Pde,
        way: Way,
    ) -> (Box<dyn Pieces<3> + 'a>, usize) {
        let points = match (self, way) {
            (Self::Adei, _) => CollocationPoints::Searched { seed: 1 },
            (_, Way::Thesis) => CollocationPoints::Random { seed: 1 },
            (_, Way::Ours) => CollocationPoints::Chosen,
        };
        let options = DeiOptions { points, ..way.options() };
        let dei = Dei::new(space, mesh, field, &way.equation(pde), &options);
        let singular = dei.singular();
        (Box::new(dei), singular)
    }
}

impl Way {
    pub fn name(self) -> &'static str {
        match self {
            Self::Thesis => "its way, our meshes",
            Self::Ours => "ours",
        }
    }

    pub fn equation(self, pde: &Pde) -> Equation<'_> {
        let predictor = match self {
            Self::Thesis => Predictor::Linear,
            Self::Ours => Predictor::Quadratic,
        };
        Equation { pde, arrays: &[], predictor }
    }

    pub fn options(self) -> DeiOptions {
        match self {
            Self::Thesis => DeiOptions { limit: f64::INFINITY, ..DeiOptions::default() },
            Self::Ours => DeiOptions::default(),
        }
    }
}

/// A row: average errors on meshes of one kind and size.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    pub points: usize,
    pub way: Way,
    /// Of each interpolant.
    pub errors: [f64; 6],
    /// The part of the triangles without a piece of their own.
    pub left_out: [f64; 6],
}

/// The rows with at most `most` points, each the median over meshes from `seeds`.
pub fn rows(points: Points, most: usize, seeds: std::ops::RangeInclusive<u64>) -> Vec<Row> {
    let sizes = THESIS.iter().map(|(points, _)| *points).filter(|size| *size <= most);
    sizes
        .flat_map(|size| {
            let meshes: Vec<TriangleMesh> =
                seeds.clone().map(|seed| points.mesh(size, seed)).collect();
            [Way::Thesis, Way::Ours].map(|way| row(size, &meshes, way))
        })
        .collect()
}

fn row(points: usize, meshes: &[TriangleMesh], way: Way) -> Row {
    let found = MEMBERS.map(|member| {
        let each = meshes.iter().map(|mesh| error(mesh, member, way));
        let (errors, parts): (Vec<f64>, Vec<f64>) = each.unzip();
        (median(errors), median(parts))
    });
    Row { points, way, errors: found.map(|f| f.0), left_out: found.map(|f| f.1) }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// The average error, and the part of the triangles left out.
fn error(mesh: &TriangleMesh, member: Member, way: Way) -> (f64, f64) {
    let (values, gradients) = problem4::at_points(mesh);
    let field = Field { values: &values, gradients: &gradients };
    let pde = Pde::parse(problem4::PDE, &[], &[]).expect("the PDE is one");
    let (pieces, singular) = member.build(mesh, field, &pde, way);
    let sampled = sampled(mesh, &*pieces, REGULAR);
    let errors = sampled.iter().map(|(point, value)| (value - problem4::value(point)).abs());
    let error = errors.sum::<f64>() / sampled.len() as f64;
    (error, singular as f64 / mesh.triangles().len() as f64)
}

/// Regular points along each side.
const REGULAR: usize = 40;

/// The interpolant at the centres of `count` by `count` squares.
pub fn sampled(mesh: &TriangleMesh, pieces: &dyn Pieces<3>, count: usize) -> Vec<(Vector, f64)> {
    let locator = PointLocator::new(mesh);
    let at = |n: usize| (n as f64 + 0.5) / count as f64;
    let points = (0..count).flat_map(|j| (0..count).map(move |i| Vector::new(at(i), at(j), 0.0)));
    points
        .map(|point| {
            let place =
                locator.locate(mesh, &point, f64::INFINITY).expect("the mesh has triangles");
            (point, pieces.taylor(place.simplex, &place.at).value)
        })
        .collect()
}
