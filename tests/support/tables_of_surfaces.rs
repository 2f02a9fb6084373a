//! Tables 5.10 and 5.11: average error of iso-surfaces, at the middles of their triangles.
//!
//! The thesis' grids have `n` points a side, cut into tetrahedra in a way that it does not
//! say; here each cube is cut into six.

use vtu2contour::contour::CellRanges;
use vtu2contour::contour::surface::{ContourSurface, Fineness, contour_surface};
use vtu2contour::field::Field;
use vtu2contour::interpolant::{Equation, Linear, Predictor, TetrahedronCubics, Tricubic};
use vtu2contour::mesh::Vector;
use vtu2contour::pde::Pde;

use super::problems_3d::{Problem, SEVENTH, SIXTH};
use super::tetrahedra::kuhn_grid;

/// A table of the thesis.
#[derive(Clone, Copy, Debug)]
pub struct Table {
    /// Its number.
    pub number: &'static str,
    /// The problem.
    pub problem: Problem,
    /// The level.
    pub level: f64,
    /// For each grid, its points a side, and errors and triangles: of MATLAB's isosurface, and of
    /// the thesis' surfaces with 2, 3 and 4 points a side of a patch.
    pub rows: [(usize, [(f64, usize); 4]); 5],
}

/// Both tables.
pub const TABLES: [Table; 2] = [
    Table {
        number: "5.10",
        problem: SIXTH,
        level: 0.07,
        rows: [
            (5, [(4.53e-3, 98), (1.99e-3, 357), (1.01e-3, 1617), (7.93e-4, 3608)]),
            (8, [(1.76e-3, 274), (6.16e-4, 955), (2.17e-4, 4299), (1.57e-4, 9677)]),
            (10, [(1.15e-3, 420), (3.66e-4, 1297), (1.30e-4, 5813), (8.95e-5, 13107)]),
            (15, [(5.30e-4, 962), (1.45e-4, 3372), (4.67e-5, 15113), (2.74e-5, 34003)]),
            (20, [(2.95e-4, 1722), (8.08e-5, 5842), (2.44e-5, 26241), (1.28e-5, 59051)]),
        ],
    },
    Table {
        number: "5.11",
        problem: SEVENTH,
        level: 1.1,
        rows: [
            (5, [(4.58e-3, 55), (4.44e-3, 167), (1.41e-3, 734), (8.92e-4, 1665)]),
            (8, [(1.48e-3, 145), (1.25e-3, 440), (3.79e-4, 1990), (2.07e-4, 4474)]),
            (10, [(9.86e-4, 235), (6.94e-4, 593), (2.21e-4, 2658), (1.35e-4, 6003)]),
            (15, [(4.74e-4, 529), (3.21e-4, 1513), (9.67e-5, 6783), (5.26e-5, 15251)]),
            (20, [(2.59e-4, 931), (1.71e-4, 2695), (4.97e-5, 12089), (2.55e-5, 27169)]),
        ],
    },
];

/// One surface of a table.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Points along a side of the grid.
    pub grid: usize,
    /// Points along a side of a patch.
    pub points: u32,
    /// The thesis' error and number of triangles.
    pub thesis: (f64, usize),
    /// Ours.
    pub ours: (f64, usize),
    /// Of the linear interpolant on the same tetrahedra: what VTK draws.
    pub linear: (f64, usize),
    /// Pieces that could not be certified.
    pub unresolved: usize,
}

impl Table {
    /// The surfaces of grids with at most `most` points a side.
    pub fn compare(&self, most: usize) -> Vec<Row> {
        let grids = self.rows.iter().filter(|(grid, _)| *grid <= most);
        grids.flat_map(|(grid, theirs)| self.compare_grid(*grid, theirs)).collect()
    }

    fn compare_grid(&self, grid: usize, theirs: &[(f64, usize); 4]) -> Vec<Row> {
        let mesh = kuhn_grid(grid - 1);
        let (values, gradients) = self.problem.at_points(&mesh);
        let field = Field { values: &values, gradients: &gradients };
        let pde = Pde::parse(self.problem.pde, &[], &[]).expect("the PDE is one");
        let equation = Equation { pde: &pde, arrays: &[], predictor: Predictor::Quadratic };
        let tricubic = Tricubic::with_pde(&mesh, field, &equation);
        let linear = self.surface(&Linear::new(&mesh, &values), 2);
        let row = |points: u32| {
            let surface = self.surface(&tricubic, points);
            Row {
                grid,
                points,
                thesis: theirs[points as usize - 1],
                ours: self.error(&surface),
                linear: self.error(&linear),
                unresolved: surface.counts.unresolved,
            }
        };
        [2, 3, 4].map(row).to_vec()
    }

    fn surface(&self, interpolant: &dyn TetrahedronCubics, points: u32) -> ContourSurface {
        let ranges = CellRanges::of_tetrahedra(interpolant);
        contour_surface(interpolant, &ranges, &[self.level], Fineness::PointsPerSide(points))
    }

    /// The average error at the middles of the triangles, and how many there are.
    fn error(&self, surface: &ContourSurface) -> (f64, usize) {
        let middle = |triangle: &[u32; 3]| {
            triangle.iter().map(|&n| surface.points[n as usize].position).sum::<Vector>() / 3.0
        };
        let error = |triangle| ((self.problem.value)(&middle(triangle)) - self.level).abs();
        let count = surface.triangles.len();
        (surface.triangles.iter().map(error).sum::<f64>() / count as f64, count)
    }
}
