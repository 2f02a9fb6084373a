//! Gradients recovered on tetrahedra: exact for polynomials, of their order.

mod support;

use support::meshes::Random;
use support::order::order;
use support::polynomial::Polynomial;
use support::problems_3d::FIFTH;
use support::tetrahedra::{graded_cube, kuhn_grid, random_cube, shuffled};
use vtu2contour::field::{RecoveryDegree, recover_gradients};
use vtu2contour::mesh::{TetrahedronMesh, Vector};

/// The same grid with its inner points moved by up to a fifth of the spacing.
fn shaken_grid(random: &mut Random, n: usize) -> TetrahedronMesh<'static> {
    let mesh = kuhn_grid(n);
    let shaken = mesh.points().iter().map(|point| {
        let move_by = Vector::from([(); 3].map(|()| random.uniform(-0.2, 0.2) / n as f64));
        let inside = point.iter().all(|&x| 0.0 < x && x < 1.0);
        if inside { point + move_by } else { *point }
    });
    TetrahedronMesh::new(shaken.collect(), mesh.tetrahedra().to_vec()).unwrap()
}

/// At all points, those of the boundary too.
#[test]
fn polynomials_are_exact_on_any_mesh() {
    let mut random = Random(21);
    let delaunay = random_cube(&mut random, 300);
    let meshes = [
        kuhn_grid(4),
        shaken_grid(&mut random, 5),
        graded_cube(&mut random, 300),
        shuffled(&mut random, &delaunay),
        delaunay,
    ];
    for mesh in &meshes {
        for (degree, number) in [(RecoveryDegree::Two, 2), (RecoveryDegree::Three, 3)] {
            let u = Polynomial::random(&mut random, number);
            let (values, gradients) = u.at_points(mesh);
            let found = recover_gradients(mesh, &values, degree);
            for (point, (found, exact)) in found.iter().zip(&gradients).enumerate() {
                let error = (found - exact).norm();
                assert!(error < 1e-9, "point {point}, degree {number}: {error:.1e}");
            }
        }
    }
}

#[test]
fn orders_of_accuracy() {
    const SIZES: [usize; 3] = [8, 12, 18];
    let observed = |degree: RecoveryDegree, inside: f64| {
        order(&SIZES.map(|n| {
            let mesh = shaken_grid(&mut Random(22), n);
            let (values, gradients) = FIFTH.at_points(&mesh);
            let found = recover_gradients(&mesh, &values, degree);
            let mut errors = Vec::new();
            for (point, (found, exact)) in mesh.points().iter().zip(found.iter().zip(&gradients)) {
                if point.iter().all(|&x| inside <= x && x <= 1.0 - inside) {
                    errors.push((found - exact).norm());
                }
            }
            (1.0 / n as f64, errors.iter().sum::<f64>() / errors.len() as f64)
        }))
    };
    let [two, three] = [RecoveryDegree::Two, RecoveryDegree::Three]
        .map(|degree| [observed(degree, 0.25), observed(degree, 0.0)]);
    println!("orders: degree 2 inside and all {two:.2?}, degree 3 inside and all {three:.2?}");
    assert!(two[0] > 1.85 && two[1] > 1.85);
    assert!(three[0] > 2.85 && three[1] > 2.85);
}

/// A value that is missing stays so and does not spread.
#[test]
fn missing_values() {
    let mesh = kuhn_grid(4);
    let mut values: Vec<f64> = mesh.points().iter().map(|p| p.x - p.z).collect();
    values[62] = f64::NAN;
    let found = recover_gradients(&mesh, &values, RecoveryDegree::Two);
    for (point, gradient) in found.iter().enumerate() {
        let right = (gradient - Vector::new(1.0, 0.0, -1.0)).norm() < 1e-9;
        assert_eq!(right, point != 62);
    }
    assert!(found[62].x.is_nan());
}
