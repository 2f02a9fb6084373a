//! The orders of recovered gradients: that of the degree, inside and on the boundary.

mod support;

use support::domains::{Domain, on_boundary, slope_of_waves, waves};
use support::meshes::Random;
use support::order::order;
use support::tetrahedra::kuhn_grid;
use vtu2contour::field::{RecoveryDegree, recover_gradients};
use vtu2contour::mesh::{SimplexMesh, TetrahedronMesh};

/// The mean errors of recovered gradients inside and on the boundary.
fn errors<const CORNERS: usize>(
    mesh: &SimplexMesh<CORNERS>,
    on_boundary: &[bool],
    degree: RecoveryDegree,
) -> [f64; 2] {
    let values: Vec<f64> = mesh.points().iter().map(waves).collect();
    let found = recover_gradients(mesh, &values, degree);
    [false, true].map(|wanted| {
        let points = mesh.points().iter().zip(&found).zip(on_boundary);
        let errors = points.filter(|(_, on)| **on == wanted);
        let errors: Vec<f64> =
            errors.map(|((point, found), _)| (found - slope_of_waves(point)).norm()).collect();
        errors.iter().sum::<f64>() / errors.len() as f64
    })
}

/// The orders inside and on the boundary, of errors on meshes of some widths.
fn orders(widths: &[f64], errors_at: impl Fn(f64) -> [f64; 2]) -> [f64; 2] {
    let found: Vec<(f64, [f64; 2])> = widths.iter().map(|&h| (h, errors_at(h))).collect();
    [0, 1].map(|part| {
        let errors: Vec<(f64, f64)> = found.iter().map(|(h, errors)| (*h, errors[part])).collect();
        order(&errors)
    })
}

const DEGREES: [(RecoveryDegree, f64); 2] =
    [(RecoveryDegree::Two, 2.0), (RecoveryDegree::Three, 3.0)];

/// Meshes as generators make them: degree 2 has order 2, degree 3 order 3, and no less on
/// the boundary.
#[test]
fn in_the_plane() {
    for (degree, expected) in DEGREES {
        let [inside, edge] = orders(&[0.08, 0.05, 0.03, 0.02], |h| {
            let mesh = Domain::rectangle("square", 1.0, 1.0).mesh(&mut Random(4), h);
            errors(&mesh, &on_boundary(&mesh), degree)
        });
        println!("{degree:?}: inside {inside:.2}, on the boundary {edge:.2}");
        assert!(inside > expected - 0.15 && edge > expected - 0.15);
    }
}

#[test]
fn in_space() {
    for (degree, expected) in DEGREES {
        let [inside, edge] = orders(&[1.0 / 8.0, 1.0 / 12.0, 1.0 / 18.0, 1.0 / 26.0], |h| {
            let mesh = shaken_cube(&mut Random(5), (1.0 / h).round() as usize);
            let at_end = |x: &f64| *x <= 0.0 || *x >= 1.0;
            let on_cube: Vec<bool> =
                mesh.points().iter().map(|point| point.iter().any(at_end)).collect();
            errors(&mesh, &on_cube, degree)
        });
        println!("{degree:?}: inside {inside:.2}, on the boundary {edge:.2}");
        assert!(inside > expected - 0.15 && edge > expected - 0.15);
    }
}

/// A grid of cubes with its inner points moved by up to a fifth of the spacing.
fn shaken_cube(random: &mut Random, n: usize) -> TetrahedronMesh<'static> {
    let mesh = kuhn_grid(n);
    let moved = mesh.points().iter().map(|point| {
        let by = point.map(|_| random.uniform(-0.2, 0.2) / n as f64);
        let is_inside = point.iter().all(|&x| 0.0 < x && x < 1.0);
        if is_inside { point + by } else { *point }
    });
    TetrahedronMesh::new(moved.collect(), mesh.tetrahedra().to_vec()).unwrap()
}
