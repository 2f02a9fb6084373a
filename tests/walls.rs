//! Levels that are the value of a boundary condition: the wall is the contour.

mod support;

use std::f64::consts::PI;
use std::path::Path;

use support::meshes::{Random, grid};
use vtu2contour::contour::lines::{ContourLines, Method, Resolution, contour_lines_with_walls};
use vtu2contour::contour::{CellRanges, Levels};
use vtu2contour::field::Field;
use vtu2contour::filter::{ContourOptions, contour};
use vtu2contour::interpolant::{Pci, TriangleCubics};
use vtu2contour::mesh::{TriangleMesh, Vector};
use vtu2contour::vtk::{Selection, VtuFile};

const RESOLUTION: Resolution = Resolution { spacing: f64::INFINITY, tolerance: 1e-3 };

fn nodal(
    mesh: &TriangleMesh,
    value: impl Fn(&Vector) -> f64,
    gradient: impl FnMut(&Vector) -> Vector,
) -> (Vec<f64>, Vec<Vector>) {
    (mesh.points().iter().map(value).collect(), mesh.points().iter().map(gradient).collect())
}

fn at_level(pci: &Pci, level: f64) -> ContourLines {
    contour_lines_with_walls(pci, &CellRanges::new(pci), &[level], Method::Aodea, RESOLUTION)
}

fn length(lines: &ContourLines, line: usize) -> f64 {
    let points: Vec<_> = lines.line_points(&lines.lines[line]).map(|p| p.position).collect();
    points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}

/// A membrane on the unit square whose gradients are turned a little, so that those on
/// the walls are not at right angles to them.
fn noisy_membrane(mesh: &TriangleMesh) -> (Vec<f64>, Vec<Vector>) {
    let mut random = Random(3);
    nodal(
        mesh,
        |p| p.x * (1.0 - p.x) * p.y * (1.0 - p.y),
        |p| {
            let slope = |a: f64, b: f64| (1.0 - 2.0 * a) * b * (1.0 - b);
            let (across, up) = (slope(p.x, p.y), slope(p.y, p.x));
            let turn = random.uniform(-0.2, 0.2);
            Vector::new(across - turn * up, up + turn * across, 0.0)
        },
    )
}

#[test]
fn the_wall_is_the_contour_although_gradients_are_noisy() {
    let mesh = grid(8);
    let (values, gradients) = noisy_membrane(&mesh);
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    // a level that went through single precision, and the like, is the wall too
    for level in [0.0, 1e-9, -1e-9] {
        let lines = at_level(&pci, level);
        assert_eq!(lines.lines.len(), 1, "level {level}");
        assert!(lines.lines[0].closed && (length(&lines, 0) - 4.0).abs() < 1e-12);
    }
    // and one that is near the wall's value is not
    assert!((length(&at_level(&pci, 1e-3), 0) - 4.0).abs() > 1e-3);
}

#[test]
fn a_curved_boundary_edge_is_left_alone() {
    // sin(4πx) (1 + y) is zero at all points of the grid, and between them only on
    // the lines x = n/4
    let mesh = grid(4);
    let (values, gradients) = nodal(
        &mesh,
        |_| 0.0,
        |p| Vector::new(4.0 * PI * (4.0 * PI * p.x).cos() * (1.0 + p.y), 0.0, 0.0),
    );
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    let lines = at_level(&pci, 0.0);
    assert_eq!(lines.lines.len(), 5);
    for line in &lines.lines {
        let x: Vec<f64> = lines.line_points(line).map(|p| p.position.x).collect();
        assert!(x.iter().all(|&other| other == x[0]), "{x:?}");
    }
}

#[test]
fn a_lone_edge_is_no_wall() {
    // 3y - (x - 1/2)² has the two points at the middle of the bottom on the level -1/36,
    // and is above it between them
    let mesh = grid(3);
    let (values, gradients) = nodal(
        &mesh,
        |p| 3.0 * p.y - (p.x - 0.5).powi(2),
        |p| Vector::new(1.0 - 2.0 * p.x, 3.0, 0.0),
    );
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    let lines = at_level(&pci, -1.0 / 36.0);
    assert_eq!(lines.lines.len(), 2);
    assert!(lines.lines.iter().all(|line| !line.closed));
}

#[test]
fn a_line_beside_cells_that_are_left_out_is_no_wall() {
    let mesh = grid(8);
    let mut random = Random(5);
    let noise = |_: &Vector| Vector::new(1.0, random.uniform(-0.1, 0.1), 0.0);
    let (values, gradients) = nodal(&mesh, |p| p.x - 0.5, noise);
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    let mut ranges = CellRanges::new(&pci);
    let is_right =
        |cell: usize| mesh.corners(cell).iter().map(|corner| corner.x).sum::<f64>() > 1.5;
    ranges.exclude(is_right);
    let lines = contour_lines_with_walls(&pci, &ranges, &[0.0], Method::Aodea, RESOLUTION);
    // what is drawn is the cubics' contour in the cells on the left
    assert!(!lines.lines.is_empty());
    for point in &lines.points {
        assert!(pci.cubic(point.cell as usize).value(&point.at).abs() < 1e-14);
    }
    assert!(lines.points.iter().any(|point| point.position.x < 0.499));
}

#[test]
fn the_samples_walls_are_whole() {
    // file, level, lines; VTK's linear contours have 9, 2, 1, 1 and 1
    let cases = [
        ("islands.vtu", 0.0, 11),
        ("islands.vtu", 1e-9, 11),
        ("plate_with_holes.vtu", 0.0, 2),
        ("plate_with_holes.vtu", 1.0, 1),
        ("no_gradient.vtu", 0.0, 1),
        ("no_gradient.vtu", 1.0, 1),
    ];
    for (name, level, expected) in cases {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples").join(name);
        let grid = VtuFile::open(file).unwrap().read(&Selection::All).unwrap().data;
        let levels = Levels::Explicit(vec![level]);
        let options = ContourOptions { levels, ..ContourOptions::default() };
        let lines = contour(&grid, &options, &mut |_| {}).unwrap().lines;
        assert_eq!(lines.lines.len(), expected, "{name} at {level}");
    }
}

/// A boundary value that is off the level, as one of single precision or of a solver, is the level
/// on all of the wall or nowhere, although cells at the corners have less spread, and the value is
/// not near the level in them.
#[test]
fn a_wall_off_the_level_is_drawn_whole_or_not_at_all() {
    let mesh = grid(8);
    let bump = |x: f64| 4.0 * x * (1.0 - x);
    let slope = |x: f64| 4.0 * (1.0 - 2.0 * x);
    for off in [0.0, 1e-17, 1e-12, 3e-8, 1e-7, 1.5e-7, 2e-7, 3e-7, 4e-7, 6e-7, 1e-6, 1e-5] {
        let (values, gradients) = nodal(
            &mesh,
            |p| bump(p.x) * bump(p.y) + off,
            |p| Vector::new(slope(p.x) * bump(p.y), bump(p.x) * slope(p.y), 0.0),
        );
        let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
        let lines = at_level(&pci, 0.0);
        let lengths: Vec<f64> = (0..lines.lines.len()).map(|line| length(&lines, line)).collect();
        println!("{off}: {lengths:?} {:?}", lines.counts);
        let is_drawn = !lengths.is_empty();
        assert!(!is_drawn || (lengths.len() == 1 && (lengths[0] - 4.0).abs() < 1e-12), "{off}");
        assert!((is_drawn || off > 1e-7) && (!is_drawn || off < 1e-6), "{off}");
    }
}
