//! Surfaces by tolerance: as near as asked, at the interpolant's order, with few triangles.

mod support;

use std::collections::HashMap;

use support::meshes::Random;
use support::order::order;
use support::problems_3d::{PROBLEMS, SEVENTH, SIXTH};
use support::surfaces::check_even;
use support::tetrahedra::{kuhn_grid, random_cube, renumbered, shuffled};
use vtu2contour::contour::CellRanges;
use vtu2contour::contour::surface::{ContourSurface, Fineness, contour_surface};
use vtu2contour::field::Field;
use vtu2contour::interpolant::{Equation, Predictor, TetrahedronCubics, Tricubic};
use vtu2contour::mesh::{TetrahedronMesh, Vector};
use vtu2contour::pde::Pde;

/// Weights of places in a triangle: its corners' means, and points of its sides.
const PLACES: [[f64; 3]; 7] = [
    [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0],
    [0.5, 0.5, 0.0],
    [0.5, 0.0, 0.5],
    [0.0, 0.5, 0.5],
    [0.6, 0.2, 0.2],
    [0.2, 0.6, 0.2],
    [0.2, 0.2, 0.6],
];

/// The greatest distance of a triangle from the level set of its cell's cubic, if that is looked
/// for in many directions at the given step.
fn distance_to_cubic(surface: &ContourSurface, f: &dyn TetrahedronCubics, step: f64) -> f64 {
    let directions = directions();
    let mut greatest: f64 = 0.0;
    for (triangle, &cell) in surface.triangles.iter().zip(&surface.cells) {
        let corners = triangle.map(|n| surface.points[n as usize].position);
        let (cubic, frame) = (f.cubic(cell as usize), f.mesh().frame(cell as usize));
        for place in PLACES {
            let from = weighted(&corners, place);
            let is_above = |p: Vector| cubic.value(&frame.barycentric(&p)) >= surface.levels[0];
            let start = is_above(from);
            let slope = frame.gradient(&cubic.barycentric_gradient(&frame.barycentric(&from)));
            let ways =
                || directions.iter().copied().chain([1.0, -1.0].map(|s| slope.normalize() * s));
            let is_met = |steps: &i32| {
                ways().any(|way| is_above(from + way * (step * f64::from(*steps))) != start)
            };
            greatest = greatest.max(step * f64::from((1..1000).find(is_met).unwrap()));
        }
    }
    greatest
}

/// Unit vectors to all sides.
fn directions() -> Vec<Vector> {
    let mut random = Random(8);
    let mut any = || random.uniform(-1.0, 1.0);
    (0..60).map(|_| Vector::new(any(), any(), any()).normalize()).collect()
}

fn weighted(corners: &[Vector; 3], weights: [f64; 3]) -> Vector {
    corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2]
}

/// The triangles of the coarsest uniform patches that are as near as that, or that are more
/// than `enough`.
fn uniform_triangles(
    f: &dyn TetrahedronCubics,
    ranges: &CellRanges,
    level: f64,
    tolerance: f64,
    enough: usize,
) -> usize {
    for points in 2.. {
        let surface = contour_surface(f, ranges, &[level], Fineness::PointsPerSide(points));
        let count = surface.triangles.len();
        if count > enough || distance_to_cubic(&surface, f, 0.1 * tolerance) <= 1.1 * tolerance {
            return count;
        }
    }
    unreachable!("ever finer patches have ever more triangles")
}

/// The triangles by tolerance and by uniform patches.
fn compared(
    mesh: &TetrahedronMesh,
    value: impl Fn(&Vector) -> f64,
    gradient: impl Fn(&Vector) -> Vector,
    level: f64,
    tolerance: f64,
) -> [usize; 2] {
    let values: Vec<f64> = mesh.points().iter().map(value).collect();
    let gradients: Vec<Vector> = mesh.points().iter().map(gradient).collect();
    let f = Tricubic::new(mesh, Field { values: &values, gradients: &gradients });
    let ranges = CellRanges::of_tetrahedra(&f);
    let surface = contour_surface(&f, &ranges, &[level], Fineness::Tolerance(tolerance));
    let (ours, coarse) = (surface.triangles.len(), surface.counts.coarse);
    // slivers of random meshes have cubics that no small triangle follows; they are counted
    assert!(200 * coarse < ours, "{:?}", surface.counts);
    if coarse == 0 {
        let distance = distance_to_cubic(&surface, &f, 0.1 * tolerance);
        assert!(distance <= 1.1 * tolerance, "{distance} of {tolerance}");
    }
    [ours, uniform_triangles(&f, &ranges, level, tolerance, 10 * ours)]
}

#[test]
fn smooth_solutions_need_no_more_triangles_than_uniform_patches() {
    let meshes = [kuhn_grid(7), shuffled(&mut Random(1), &random_cube(&mut Random(2), 200))];
    for mesh in &meshes {
        for (problem, level) in [(SIXTH, 0.07), (SEVENTH, 1.1)] {
            for tolerance in [3e-3, 1e-3] {
                let [ours, uniform] =
                    compared(mesh, problem.value, problem.gradient, level, tolerance);
                println!("problem {}, {tolerance:e}: {ours} against {uniform}", problem.number);
                assert!(2 * ours <= 3 * uniform, "{}: {ours} {uniform}", problem.number);
            }
        }
    }
}

/// A plane with a narrow hill: x + 0.2 exp(-100 r²), r from the middle of the cube.
#[test]
fn a_steep_part_needs_a_third_of_the_triangles() {
    let mesh = kuhn_grid(10);
    let hill = |p: &Vector| 0.2 * (-100.0 * (p - Vector::repeat(0.5)).norm_squared()).exp();
    let value = |p: &Vector| p.x + hill(p);
    let gradient = |p: &Vector| Vector::x() - 200.0 * hill(p) * (p - Vector::repeat(0.5));
    for tolerance in [1e-3, 3e-4] {
        let [ours, uniform] = compared(&mesh, value, gradient, 0.53, tolerance);
        println!("steep, {tolerance:e}: {ours} against {uniform}");
        assert!(3 * ours <= uniform, "{ours} {uniform}");
    }
}

/// A plane with a narrow hill, on a mesh of which no cell is like another: far from the hill two
/// triangles a cell are enough, and these fit to those that are divided.
#[test]
fn what_is_divided_fits_to_what_is_not() {
    let mesh = renumbered(&mut Random(3), &kuhn_grid(10), 0.02);
    let hill = |p: &Vector| 0.2 * (-100.0 * (p - Vector::repeat(0.5)).norm_squared()).exp();
    let value = |p: &Vector| p.x + 0.3 * p.y + hill(p);
    let gradient =
        |p: &Vector| Vector::new(1.0, 0.3, 0.0) - 200.0 * hill(p) * (p - Vector::repeat(0.5));
    let values: Vec<f64> = mesh.points().iter().map(value).collect();
    let gradients: Vec<Vector> = mesh.points().iter().map(gradient).collect();
    let f = Tricubic::new(&mesh, Field { values: &values, gradients: &gradients });
    let ranges = CellRanges::of_tetrahedra(&f);
    for tolerance in [1e-3, 3e-4, 1e-4] {
        let surface = contour_surface(&f, &ranges, &[0.68], Fineness::Tolerance(tolerance));
        check_even(&surface, &format!("{tolerance:e}"));
        let mut of_cells: HashMap<u32, usize> = HashMap::new();
        surface.cells.iter().for_each(|&cell| *of_cells.entry(cell).or_default() += 1);
        let divided = of_cells.values().filter(|&&triangles| triangles > 2).count();
        println!("{tolerance:e}: {divided} of {} cells are divided", of_cells.len());
        assert!(divided > 20 && of_cells.len() > divided + 20);
        let distance = distance_to_cubic(&surface, &f, tolerance / 4.0);
        assert!(distance <= 1.25 * tolerance, "{distance:e}");
    }
}

/// With their PDE, at a tolerance that falls as h⁴, the triangles of problems 5 to 7 approach
/// the exact surface at order four.
#[test]
fn the_distance_to_the_exact_surface_is_of_fourth_order() {
    for (problem, level) in PROBLEMS.iter().zip([0.3, 0.07, 1.1]) {
        let errors = [4, 6, 8, 12].map(|n| {
            let mesh = kuhn_grid(n);
            let (values, gradients) = problem.at_points(&mesh);
            let pde = Pde::parse(problem.pde, &[], &[]).unwrap();
            let equation = Equation { pde: &pde, arrays: &[], predictor: Predictor::Quadratic };
            let field = Field { values: &values, gradients: &gradients };
            let f = Tricubic::with_pde(&mesh, field, &equation);
            let ranges = CellRanges::of_tetrahedra(&f);
            let tolerance = 0.1 * (n as f64).powi(-4);
            let surface = contour_surface(&f, &ranges, &[level], Fineness::Tolerance(tolerance));
            let distance =
                |p: &Vector| ((problem.value)(p) - level).abs() / (problem.gradient)(p).norm();
            let (mut sum, mut count) = (0.0, 0.0);
            for triangle in &surface.triangles {
                let corners = triangle.map(|n| surface.points[n as usize].position);
                for place in PLACES {
                    sum += distance(&weighted(&corners, place));
                    count += 1.0;
                }
            }
            (1.0 / n as f64, sum / count)
        });
        let order = order(&errors);
        println!("problem {}: {errors:?}, order {order}", problem.number);
        assert!(order > 3.75, "{order}");
    }
}
