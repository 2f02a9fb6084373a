//! Levels that are the value of a boundary condition, in space: the wall is the surface.

mod support;

use support::meshes::Random;
use support::mixed_grid::mixed_grid;
use support::surfaces::{area, check_even};
use support::tetrahedra::{kuhn_grid, shuffled};
use vtu2contour::contour::surface::{ContourSurface, Fineness, contour_surface};
use vtu2contour::contour::{CellRanges, Levels};
use vtu2contour::field::{Field, RecoveryDegree, recover_gradients};
use vtu2contour::filter::{ContourOptions, GradientSource, Interpolant, Solution, contour};
use vtu2contour::interpolant::Tricubic;
use vtu2contour::mesh::Vector;

/// x (1 - x) y (1 - y) z (1 - z) (z - 0.45), zero on the whole boundary and in a plane, and
/// its gradient.
fn with_walls(p: &Vector) -> (f64, Vector) {
    let bump = |x: f64| (x * (1.0 - x), 1.0 - 2.0 * x);
    let [(x, dx), (y, dy), (z, dz)] = [bump(p.x), bump(p.y), bump(p.z)];
    let (plane, slope) = (p.z - 0.45, dz * (p.z - 0.45) + z);
    (x * y * z * plane, Vector::new(dx * y * z * plane, x * dy * z * plane, x * y * slope))
}

/// A level that is the value of a boundary condition: the walls are drawn whole, each face
/// once, and the plane inside ends in them; with exact gradients, and with recovered ones,
/// whose cubics weave about the level on the boundary.
#[test]
fn walls_on_the_level_are_whole() {
    let mesh = shuffled(&mut Random(6), &kuhn_grid(7));
    let (values, exact): (Vec<f64>, Vec<Vector>) = mesh.points().iter().map(with_walls).unzip();
    let recovered = recover_gradients(&mesh, &values, RecoveryDegree::Three);
    let cases = [(exact, "exact", 6, 0.02), (recovered, "recovered", 60, 0.1)];
    for (gradients, name, divided, error) in cases {
        let f = Tricubic::new(&mesh, Field { values: &values, gradients: &gradients });
        let ranges = CellRanges::of_tetrahedra(&f);
        let surface = contour_surface(&f, &ranges, &[0.0], Fineness::PointsPerSide(2));
        check_even(&surface, name);
        let is_in_wall = |triangle: &&[u32; 3]| {
            let corners = triangle.map(|n| surface.points[n as usize].position);
            let in_side = |n: usize, side: f64| corners.iter().all(|p| p[n] == side);
            (0..3).any(|n| in_side(n, 0.0) || in_side(n, 1.0))
        };
        let in_walls = surface.triangles.iter().filter(is_in_wall).count();
        println!("{name}: {:?}, area {}", surface.counts, area(&surface));
        // the rest is where the plane meets two walls at once
        assert!(surface.counts.divided <= divided, "{name}: {:?}", surface.counts);
        assert!(surface.counts.unresolved < 40 * divided, "{name}: {:?}", surface.counts);
        assert_eq!(in_walls, 6 * 2 * 7 * 7, "{name}");
        assert!((area(&surface) - 7.0).abs() < error, "{name}");
    }
}

/// 4 x (1 - x) times the same of y and z, and its gradient; zero on the whole boundary. Cells with
/// all corners there have little spread.
fn bump(p: &Vector) -> (f64, Vector) {
    let factor = |x: f64| (4.0 * x * (1.0 - x), 4.0 * (1.0 - 2.0 * x));
    let [(x, dx), (y, dy), (z, dz)] = [factor(p.x), factor(p.y), factor(p.z)];
    (x * y * z, Vector::new(dx * y * z, x * dy * z, x * y * dz))
}

fn bump_off(off: f64, fineness: Fineness) -> ContourSurface {
    let mesh = shuffled(&mut Random(8), &kuhn_grid(6));
    let of_point = |p: &Vector| (bump(p).0 + off, bump(p).1);
    let (values, gradients): (Vec<f64>, Vec<Vector>) = mesh.points().iter().map(of_point).unzip();
    let f = Tricubic::new(&mesh, Field { values: &values, gradients: &gradients });
    contour_surface(&f, &CellRanges::of_tetrahedra(&f), &[0.0], fineness)
}

/// A boundary value that is off the level, as one of single precision or of a solver, is the level
/// on all of the wall or nowhere, although cells at the edges of the cube have less spread, and the
/// value is not near the level in them.
#[test]
fn a_wall_off_the_level_is_drawn_whole_or_not_at_all() {
    let finenesses =
        [Fineness::PointsPerSide(2), Fineness::PointsPerSide(3), Fineness::Tolerance(1e-2)];
    for fineness in finenesses {
        for off in [0.0, 1e-17, 1e-12, 3e-8, 1e-7, 1.5e-7, 2e-7, 3e-7, 4e-7, 6e-7, 1e-6, 1e-5] {
            let name = format!("{off} {fineness:?}");
            let surface = bump_off(off, fineness);
            println!("{name}: {:?}, area {}", surface.counts, area(&surface));
            check_even(&surface, &name);
            assert_eq!(surface.counts.unresolved, 0, "{name}");
            let is_drawn = !surface.triangles.is_empty();
            assert!(!is_drawn || (area(&surface) - 6.0).abs() < 1e-12, "{name}");
            assert!((is_drawn || off > 1e-7) && (!is_drawn || off < 1e-6), "{name}");
        }
    }
}

/// The cells that are at a wall, and by themselves not near the level, are among those of which
/// the interpolant is computed for a level; also along an edge of the cube, where gradients that
/// are zero make cells with all corners on the boundary constant.
#[test]
fn walls_off_the_level_are_those_of_the_whole_interpolant() {
    for off in [1e-9, 1e-8, 3e-8, 1e-7] {
        let of_point = |p: &Vector| {
            let is_at_edge = (p.x == 0.0 && p.y > 0.9) || (p.x < 0.1 && p.y == 1.0);
            let gradient = if is_at_edge { Vector::zeros() } else { bump(p).1 };
            (bump(p).0 + off, gradient)
        };
        let grid = mixed_grid(&kuhn_grid(16), of_point, |_| false);
        let options = ContourOptions {
            levels: Levels::Explicit(vec![0.0]),
            array: Some("u".to_owned()),
            gradient: GradientSource::Array("g".to_owned()),
            ..ContourOptions::default()
        };
        let whole = Interpolant::new(Solution::of_grid(&grid, &options).unwrap(), &options);
        let whole = whole.unwrap();
        let contours = whole.contours(&options).unwrap();
        let expected = whole.output(&contours, options.output(&grid)).poly_data(&grid);
        let found = contour(&grid, &options, &mut |_| {}).unwrap();
        assert_eq!(found.poly_data, expected, "{off}");
        assert_eq!(expected.polys.is_empty(), off > 3e-8, "{off}");
    }
}
