//! Points are found in meshes: plane, in space, graded, and on edges.

mod support;

use support::meshes::{Random, random_square};
use support::tetrahedra::{graded_cube, kuhn_grid};
use vtu2contour::mesh::{PointLocator, SimplexMesh, TriangleMesh, Vector};

fn random_vector(random: &mut Random, low: f64, high: f64) -> Vector {
    Vector::from([(); 3].map(|()| random.uniform(low, high)))
}

/// Random barycentric coordinates.
fn random_place<const CORNERS: usize>(random: &mut Random) -> [f64; CORNERS] {
    let weights = [(); CORNERS].map(|()| random.uniform(0.001, 1.0));
    weights.map(|weight| weight / weights.iter().sum::<f64>())
}

/// A random point of each simplex is found there, and where it is said to be.
fn check_finds_its_points<const CORNERS: usize>(random: &mut Random, mesh: &SimplexMesh<CORNERS>) {
    let locator = PointLocator::new(mesh);
    for simplex in 0..mesh.simplices().len() {
        let at = random_place(random);
        let point = mesh.position(simplex, &at);
        let found = locator.locate(mesh, &point, 1e-12).expect("it is inside");
        assert_eq!(found.simplex, simplex);
        assert!((mesh.position(simplex, &found.at) - point).norm() < 1e-12);
    }
}

/// The distance found is the least over all simplices, each in a mesh of its own.
fn check_against_all<const CORNERS: usize>(
    random: &mut Random,
    mesh: &SimplexMesh<CORNERS>,
    queries: usize,
) {
    let locator = PointLocator::new(mesh);
    let alone: Vec<(SimplexMesh<CORNERS>, PointLocator)> = (0..mesh.simplices().len())
        .map(|simplex| {
            let one = vec![mesh.simplices()[simplex]];
            let mesh = SimplexMesh::new(mesh.points().to_vec(), one).unwrap();
            let locator = PointLocator::new(&mesh);
            (mesh, locator)
        })
        .collect();
    for _ in 0..queries {
        let point = random_vector(random, -0.5, 1.5);
        let found = locator.locate(mesh, &point, f64::INFINITY).unwrap();
        let each = alone
            .iter()
            .map(|(mesh, locator)| locator.locate(mesh, &point, f64::INFINITY).unwrap().distance);
        assert_eq!(found.distance, each.fold(f64::INFINITY, f64::min));
        let within = found.distance * (1.0 - 1e-9);
        assert!(found.distance == 0.0 || locator.locate(mesh, &point, within).is_none());
    }
}

/// The square rolled to three quarters of a cylinder.
fn rolled(square: &TriangleMesh) -> TriangleMesh<'static> {
    let roll = |p: &Vector| {
        let (sin, cos) = (1.5 * std::f64::consts::PI * p.x).sin_cos();
        Vector::new(0.3 * cos, 0.3 * sin, p.y)
    };
    let points = square.points().iter().map(roll).collect();
    TriangleMesh::new(points, square.triangles().to_vec()).unwrap()
}

#[test]
fn points_of_simplices_are_found_in_them() {
    let mut random = Random(1);
    let square = random_square(&mut random, 800);
    check_finds_its_points(&mut random, &square);
    check_finds_its_points(&mut random, &rolled(&square));
    check_finds_its_points(&mut random, &kuhn_grid(5));
}

#[test]
fn nothing_is_nearer_than_what_is_found() {
    let mut random = Random(2);
    let square = random_square(&mut random, 100);
    check_against_all(&mut random, &square, 200);
    check_against_all(&mut random, &rolled(&square), 200);
    let cube = graded_cube(&mut random, 60);
    check_against_all(&mut random, &cube, 200);
}

/// A boundary layer: cells from 1 down to a billionth.
#[test]
fn graded_meshes() {
    let heights: Vec<f64> = (0..30).map(|n| 0.5_f64.powi(30 - n)).collect();
    let points = heights.iter().flat_map(|&y| [0.0, 1.0].map(|x| Vector::new(x, y, 0.0)));
    let layers = (0..29_u32).flat_map(|n| {
        let n = 2 * n;
        [[n, n + 1, n + 3], [n, n + 3, n + 2]]
    });
    let mesh = TriangleMesh::new(points.collect(), layers.collect()).unwrap();
    check_finds_its_points(&mut Random(3), &mesh);
}

/// Points on edges and corners, rounded as they come, are always found, in a simplex that
/// has the edge or corner.
#[test]
fn edges_and_corners_have_no_gaps() {
    let mut random = Random(4);
    let mesh = random_square(&mut random, 500);
    let locator = PointLocator::new(&mesh);
    for triangle in 0..mesh.triangles().len() {
        let corners = mesh.triangles()[triangle];
        for corner in 0..3 {
            let mut at = [0.0; 3];
            at[corner] = random.uniform(0.0, 1.0);
            at[(corner + 1) % 3] = 1.0 - at[corner];
            let point = mesh.position(triangle, &at);
            let found = locator.locate(&mesh, &point, 1e-15).expect("it is on the mesh");
            let holder = mesh.triangles()[found.simplex];
            assert!(
                holder.contains(&corners[corner]) && holder.contains(&corners[(corner + 1) % 3])
            );
            let vertex = mesh.points()[corners[corner] as usize];
            let found = locator.locate(&mesh, &vertex, 1e-15).expect("it is a point of the mesh");
            assert!(mesh.triangles()[found.simplex].contains(&corners[corner]));
        }
    }
}

/// Far from the origin, boundary points in single precision are forgiven, others are not.
#[test]
fn what_is_forgiven() {
    let mesh = kuhn_grid(2);
    let moved = mesh.points().iter().map(|p| p * 100.0 + Vector::new(0.0, 30.0, -20.0)).collect();
    let mesh = SimplexMesh::new(moved, mesh.simplices().to_vec()).unwrap();
    let locator = PointLocator::new(&mesh);
    let within = locator.forgiving_distance();
    assert!((within - 1e-4 * 3f64.sqrt()).abs() < 1e-12);
    let place = |x: f64| Vector::new(f64::from(x as f32), 77.7, 12.3);
    let rounded = place(100.0 * (1.0 + 1e-7));
    assert!(rounded.x > 100.0);
    let found = locator.locate(&mesh, &rounded, within).expect("single precision");
    assert_eq!(mesh.position(found.simplex, &found.at).x, 100.0);
    assert_eq!(locator.locate(&mesh, &place(100.001), within), None);
}
