//! Table 5.7: average error of the contours of problem 4, on triangle meshes of
//! good quality.
//!
//! As in the thesis (section 5.3.1), the error at a sample point is the difference
//! between the exact solution there and the level, and the sample points are
//! random points of the drawn curve, as many for each part of it that lies in one
//! triangle. The thesis tells neither its levels nor its thresholds: here ten equal
//! levels, and as thresholds of Intercept and AODEA a fiftieth and a half of the
//! mean edge.

use std::path::Path;

use vtu2contour::contour::lines::{ContourLines, Method, Resolution, contour_lines};
use vtu2contour::contour::{CellRanges, Levels};
use vtu2contour::field::Field;
use vtu2contour::filter::Cells;
use vtu2contour::interpolant::{Equation, Pci, Predictor, TriangleCubics};
use vtu2contour::mesh::TriangleMesh;
use vtu2contour::pde::Pde;
use vtu2contour::vtk::{Selection, VtuFile};

use super::problem4;

/// Points, and the thesis' errors of Intercept, SODE, ODEA and AODEA.
const THESIS: [(usize, [f64; 4]); 3] = [
    (900, [9.03e-6, 6.87e-4, 6.87e-4, 2.47e-5]),
    (1600, [6.55e-6, 2.99e-5, 2.26e-5, 1.56e-5]),
    (2500, [5.46e-6, 1.28e-5, 1.23e-5, 6.63e-6]),
];

const METHODS: [(&str, Method); 4] = [
    ("Intercept", Method::Intercept),
    ("SODE", Method::Sode),
    ("ODEA", Method::Odea),
    ("AODEA", Method::Aodea),
];

/// Random points on each part of a curve in one triangle. (The thesis takes one;
/// more give the same mean with less chance in it.)
const SAMPLES: usize = 16;

/// One row of the table: errors of one method on one mesh.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Points of the mesh.
    pub points: usize,
    /// The method.
    pub method: &'static str,
    /// The thesis' error.
    pub thesis: f64,
    /// Ours.
    pub ours: f64,
    /// Ours with the thesis' predictor, the linear one.
    pub linear_predictor: f64,
    /// The mean error of the points that are written to a file.
    pub of_points: f64,
}

/// The table.
pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for (points, thesis) in THESIS {
        let mesh = mesh(points);
        for ((name, method), thesis) in METHODS.iter().zip(thesis) {
            let lines = contour(&mesh, Predictor::Quadratic, *method);
            rows.push(Row {
                points,
                method: name,
                thesis,
                ours: curve_error(&lines),
                linear_predictor: curve_error(&contour(&mesh, Predictor::Linear, *method)),
                of_points: point_error(&lines),
            });
        }
    }
    rows
}

fn mesh(points: usize) -> TriangleMesh<'static> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    let file = VtuFile::open(folder.join(format!("problem4_{points}.vtu")));
    let grid = file.and_then(|file| file.read(&Selection::none())).expect("the mesh is there").data;
    let cells = Cells::new(&grid).expect("the mesh is one");
    cells.triangles.expect("the mesh has triangles").mesh
}

fn contour(mesh: &TriangleMesh, predictor: Predictor, method: Method) -> ContourLines {
    let (values, gradients) = problem4::at_points(mesh);
    let field = Field { values: &values, gradients: &gradients };
    let pde = Pde::parse(problem4::PDE, &[], &[]).expect("the PDE is one");
    let pci = Pci::with_pde(mesh, field, &Equation { pde: &pde, arrays: &[], predictor });
    let ranges = CellRanges::new(&pci);
    let range = ranges.attained(&pci).expect("the mesh has cells");
    let levels = Levels::Equal { count: 10, range: None }.resolve(range).expect("finite levels");
    let edge = mean_edge(pci.mesh());
    let spacing = if method == Method::Intercept { edge / 50.0 } else { edge / 2.0 };
    let resolution = Resolution { spacing, tolerance: f64::INFINITY };
    contour_lines(&pci, &ranges, &levels, method, resolution)
}

fn mean_edge(mesh: &TriangleMesh) -> f64 {
    let edges = (0..mesh.triangles().len()).flat_map(|triangle| {
        let [a, b, c] = mesh.corners(triangle);
        [a - b, b - c, c - a].map(|edge| edge.norm())
    });
    let lengths: Vec<f64> = edges.collect();
    lengths.iter().sum::<f64>() / lengths.len() as f64
}

/// The average error over random points of the curves as drawn.
fn curve_error(lines: &ContourLines) -> f64 {
    let mut state = 1_u64;
    let mut random = || {
        // Knuth's MMIX generator
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut errors = Vec::new();
    for line in &lines.lines {
        let level = lines.levels[line.level];
        let curves = &lines.curves[line.curves.clone()];
        let cells = &lines.curve_cells[line.curves.clone()];
        let mut start = 0;
        for cell in cells.chunk_by(|a, b| a == b) {
            let in_cell = &curves[start..start + cell.len()];
            for _ in 0..SAMPLES {
                let place = random() * in_cell.len() as f64;
                let point = in_cell[place as usize].point(place.fract());
                errors.push((problem4::value(&point) - level).abs());
            }
            start += cell.len();
        }
    }
    errors.iter().sum::<f64>() / errors.len() as f64
}

/// The average error over the points that are written to a file.
fn point_error(lines: &ContourLines) -> f64 {
    let mut errors = Vec::new();
    for line in &lines.lines {
        for point in lines.line_points(line) {
            errors.push((problem4::value(&point.position) - lines.levels[line.level]).abs());
        }
    }
    errors.iter().sum::<f64>() / errors.len() as f64
}
