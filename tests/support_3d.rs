//! What the tests in space stand on: their meshes and the thesis' problems.

mod support;

use support::meshes::Random;
use support::problems_3d::PROBLEMS;
use support::tetrahedra::{graded_cube, kuhn_grid, random_cube, shuffled};
use vtu2contour::mesh::{TetrahedronMesh, Vector};
use vtu2contour::pde::{Pde, Sample};

fn volume([a, b, c, d]: [Vector; 4]) -> f64 {
    (b - a).cross(&(c - a)).dot(&(d - a)) / 6.0
}

/// The tetrahedra fill the unit cube, and each face inside belongs to two.
fn check_fills_the_cube(mesh: &TetrahedronMesh) {
    let volumes: Vec<f64> = (0..mesh.tetrahedra().len()).map(|n| volume(mesh.corners(n))).collect();
    assert!(volumes.iter().all(|&volume| volume > 0.0));
    assert!((volumes.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    let mut faces = std::collections::HashMap::new();
    for corners in mesh.tetrahedra() {
        for missing in 0..4 {
            let mut face: Vec<u32> = corners.to_vec();
            face.remove(missing);
            face.sort_unstable();
            *faces.entry(face).or_insert(0) += 1;
        }
    }
    for (face, count) in faces {
        let corners: Vec<Vector> =
            face.iter().map(|&point| mesh.points()[point as usize]).collect();
        let flush = |axis: usize, side: f64| corners.iter().all(|corner| corner[axis] == side);
        let on_border = (0..3).any(|axis| flush(axis, 0.0) || flush(axis, 1.0));
        assert_eq!(count, if on_border { 1 } else { 2 });
    }
}

#[test]
fn meshes_fill_the_cube() {
    let mut random = Random(1);
    check_fills_the_cube(&kuhn_grid(3));
    check_fills_the_cube(&random_cube(&mut random, 8));
    check_fills_the_cube(&graded_cube(&mut random, 600));
    let mesh = random_cube(&mut random, 512);
    check_fills_the_cube(&mesh);
    // the thesis has 3146 tetrahedra of 512 points
    assert!((2800..3400).contains(&mesh.tetrahedra().len()), "{}", mesh.tetrahedra().len());
}

#[test]
fn circumspheres_are_empty() {
    let mesh = random_cube(&mut Random(2), 200);
    for n in 0..mesh.tetrahedra().len() {
        let [a, b, c, d] = mesh.corners(n);
        let [ab, ac, ad] = [b - a, c - a, d - a];
        let towards = ab.norm_squared() * ac.cross(&ad)
            + ac.norm_squared() * ad.cross(&ab)
            + ad.norm_squared() * ab.cross(&ac);
        let radius = towards / (12.0 * volume([a, b, c, d]));
        let centre = a + radius;
        let nearest =
            mesh.points().iter().map(|p| (p - centre).norm()).fold(f64::INFINITY, f64::min);
        assert!(nearest > radius.norm() * (1.0 - 1e-7));
    }
}

#[test]
fn a_shuffled_mesh_has_the_same_tetrahedra() {
    let mut random = Random(3);
    let mesh = random_cube(&mut random, 60);
    let other = shuffled(&mut random, &mesh);
    assert_ne!(mesh, other);
    let sorted = |mesh: &TetrahedronMesh| {
        let mut all = mesh.tetrahedra().to_vec();
        all.iter_mut().for_each(|corners| corners.sort_unstable());
        all.sort_unstable();
        all
    };
    assert_eq!(sorted(&mesh), sorted(&other));
}

/// Solution, gradient and PDE of each problem agree, by differences.
#[test]
fn solutions_solve_their_equations() {
    const STEP: f64 = 1e-3;
    let mut random = Random(4);
    for problem in PROBLEMS {
        let pde = Pde::parse(problem.pde, &[], &[]).unwrap();
        for _ in 0..20 {
            let at = Vector::from([(); 3].map(|()| random.uniform(0.1, 0.9)));
            let (u, gradient) = ((problem.value)(&at), (problem.gradient)(&at));
            let mut laplacian = 0.0;
            for axis in 0..3 {
                let mut step = Vector::zeros();
                step[axis] = STEP;
                let (before, after) =
                    ((problem.value)(&(at - step)), (problem.value)(&(at + step)));
                assert!(((after - before) / (2.0 * STEP) - gradient[axis]).abs() < 1e-4);
                laplacian += (after - 2.0 * u + before) / (STEP * STEP);
            }
            let sample = Sample { x: at.into(), u, gradient: gradient.into(), arrays: &[] };
            assert!((laplacian - pde.right_hand_side(&sample)).abs() < 1e-3);
        }
    }
}
