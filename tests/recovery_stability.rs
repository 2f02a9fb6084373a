//! Recovered gradients are near the true ones on boundaries too, on any mesh, and contours
//! from them are better than linear ones.

mod support;

use support::domains::{Domain, on_boundary, slope_of_waves, waves};
use support::meshes::{Random, grid, random_square};
use support::tetrahedra::{graded_cube, kuhn_grid, random_cube};
use vtu2contour::contour::CellRanges;
use vtu2contour::contour::lines::{Method, Resolution, contour_lines};
use vtu2contour::field::{Field, RecoveryDegree, recover_gradients};
use vtu2contour::interpolant::{Linear, Pci, TriangleCubics};
use vtu2contour::mesh::{PointNeighbours, SimplexMesh, TetrahedronMesh, TriangleMesh, Vector};

fn values<const CORNERS: usize>(mesh: &SimplexMesh<CORNERS>) -> Vec<f64> {
    mesh.points().iter().map(waves).collect()
}

fn recovered<const CORNERS: usize>(mesh: &SimplexMesh<CORNERS>) -> Vec<Vector> {
    recover_gradients(mesh, &values(mesh), RecoveryDegree::Three)
}

/// The greatest errors of the recovered gradient, on the boundary and inside.
fn gradient_errors<const CORNERS: usize>(
    mesh: &SimplexMesh<CORNERS>,
    on_boundary: &[bool],
) -> [f64; 2] {
    let mut worst = [0.0_f64; 2];
    for ((point, found), &outside) in mesh.points().iter().zip(recovered(mesh)).zip(on_boundary) {
        let error = (found - slope_of_waves(point)).norm();
        let worst = &mut worst[usize::from(!outside)];
        *worst = worst.max(error);
    }
    worst
}

/// The greatest error of the solution along the contour lines of an interpolant.
fn contour_error(interpolant: &dyn TriangleCubics, h: f64) -> f64 {
    let levels: Vec<f64> = (-9..10).map(|k| f64::from(k) / 10.0 + 0.003).collect();
    let resolution = Resolution { spacing: h / 5.0, tolerance: 1e-6 };
    let ranges = CellRanges::new(interpolant);
    let lines = contour_lines(interpolant, &ranges, &levels, Method::Intercept, resolution);
    assert!(!lines.lines.is_empty());
    let error = |line: usize| {
        let level = levels[lines.lines[line].level];
        let points = lines.line_points(&lines.lines[line]);
        points.map(|point| (waves(&point.position) - level).abs()).fold(0.0, f64::max)
    };
    (0..lines.lines.len()).map(error).fold(0.0, f64::max)
}

/// The contour errors of the cubics with recovered gradients, and of the linear interpolant.
fn contour_errors(mesh: &TriangleMesh, h: f64) -> [f64; 2] {
    let (values, gradients) = (values(mesh), recovered(mesh));
    let cubics = Pci::new(mesh, Field { values: &values, gradients: &gradients });
    [contour_error(&cubics, h), contour_error(&Linear::new(mesh, &values), h)]
}

/// The fourth derivatives reach 256: third-order errors are a part of 256 h³.
#[test]
fn boundaries_of_domains_in_the_plane() {
    for h in [0.3, 0.15, 0.075] {
        for domain in Domain::all(h) {
            for seed in 0..4 {
                let mesh = domain.mesh(&mut Random(seed), h);
                let [edge, inside] = gradient_errors(&mesh, &on_boundary(&mesh));
                let [cubic, linear] = contour_errors(&mesh, h);
                let scale = 256.0 * h * h * h;
                println!(
                    "{:9} h {h:5}, {:4} points: gradient {edge:.4} = {:.3} 256h³ on the boundary, \
                     {inside:.4} = {:.3} inside; u on contours {cubic:.5}, linear {linear:.5}",
                    domain.name,
                    mesh.points().len(),
                    edge / scale,
                    inside / scale,
                );
                assert!(edge < 1.3 * scale && inside < 0.25 * scale);
                assert!(cubic < if h < 0.2 { 0.4 } else { 1.0 } * linear);
            }
        }
    }
}

/// Where no cubic is determined across: one to three cells. Never worse than linear, unless
/// the mesh is too coarse for either.
#[test]
fn thin_strips() {
    for h in [0.3, 0.15, 0.075] {
        for cells in [1.0, 2.0, 3.0] {
            let strip = Domain::rectangle("strip", 4.0, cells * h);
            for seed in 0..4 {
                let mesh = strip.mesh(&mut Random(seed), h);
                let [edge, inside] = gradient_errors(&mesh, &on_boundary(&mesh));
                let [cubic, linear] = contour_errors(&mesh, h);
                println!("strip {cells} h {h}: {edge:.4} {inside:.4}; {cubic:.5} {linear:.5}");
                assert!(edge < 25.0 * h && cubic < if h < 0.2 { 1.0 } else { 1.5 } * linear);
            }
        }
    }
}

#[test]
fn random_points_with_slivers() {
    for seed in 0..10 {
        for (count, bound) in [(100, 3.0), (400, 1.5), (1600, 0.7)] {
            let mesh = random_square(&mut Random(seed), count);
            let [edge, inside] = gradient_errors(&mesh, &on_boundary(&mesh));
            let [cubic, linear] = contour_errors(&mesh, 0.05);
            println!("random {count}: {edge:.4} {inside:.4}; {cubic:.5} {linear:.5}");
            assert!(edge < bound && inside < bound && cubic < linear);
        }
    }
}

fn on_cube(mesh: &TetrahedronMesh) -> Vec<bool> {
    let at_end = |x: &f64| *x <= 0.0 || *x >= 1.0;
    mesh.points().iter().map(|point| point.iter().any(at_end)).collect()
}

/// A grid of cubes with all points moved, those of the boundary along it.
fn shaken_cube(random: &mut Random, n: usize) -> TetrahedronMesh<'static> {
    let mesh = kuhn_grid(n);
    let moved = mesh.points().iter().map(|point| {
        point.map(|x| {
            let by = random.uniform(-0.2, 0.2) / n as f64;
            if x > 0.0 && x < 1.0 { x + by } else { x }
        })
    });
    TetrahedronMesh::new(moved.collect(), mesh.tetrahedra().to_vec()).unwrap()
}

#[test]
fn boundaries_of_cubes() {
    for seed in 0..2 {
        for n in [4, 8, 12] {
            let mesh = shaken_cube(&mut Random(seed), n);
            let [edge, inside] = gradient_errors(&mesh, &on_cube(&mesh));
            let scale = 256.0 / (n as f64).powi(3);
            let [outer, inner] = [edge, inside].map(|error| error / scale);
            println!("cube {n}: {edge:.4} = {outer:.3} 256h³, {inside:.4} = {inner:.3} 256h³");
            assert!(outer < 1.3 && inner < 0.3);
        }
        let meshes = [random_cube(&mut Random(seed), 500), graded_cube(&mut Random(seed), 500)];
        for mesh in &meshes {
            let [edge, inside] = gradient_errors(mesh, &on_cube(mesh));
            println!("random cube: {edge:.4} {inside:.4}");
            assert!(edge < 4.0 && inside < 4.0);
        }
    }
}

/// The greatest gradient that values between -1 and 1 get, times the mean length of the
/// edges at its point.
fn amplification<const CORNERS: usize>(mesh: &SimplexMesh<CORNERS>, random: &mut Random) -> f64 {
    let neighbours = PointNeighbours::new(mesh);
    let noise: Vec<f64> = mesh.points().iter().map(|_| random.uniform(-1.0, 1.0)).collect();
    let gradients = recover_gradients(mesh, &noise, RecoveryDegree::Three);
    let amplified = |(point, gradient): (usize, &Vector)| {
        let around = neighbours.of(point as u32);
        let length = |&other: &u32| (mesh.points()[other as usize] - mesh.points()[point]).norm();
        gradient.norm() * around.iter().map(length).sum::<f64>() / around.len() as f64
    };
    gradients.iter().enumerate().map(amplified).fold(0.0, f64::max)
}

/// Whatever the values are: gradients are at most some ten times what values change over
/// an edge.
#[test]
fn noise_is_not_amplified_without_measure() {
    let mut random = Random(5);
    for domain in Domain::all(0.15) {
        let mesh = domain.mesh(&mut random, 0.15);
        let found = amplification(&mesh, &mut random);
        println!("{}: {found:.1}", domain.name);
        assert!(found < 12.0);
    }
    let found = [
        amplification(&grid(12), &mut random),
        amplification(&kuhn_grid(8), &mut random),
        amplification(&shaken_cube(&mut random, 8), &mut random),
    ];
    println!("grids: {found:.1?}");
    assert!(found.iter().all(|&found| found < 12.0));
}

/// A mesh stretched as in a boundary layer gets the same gradients, stretched.
#[test]
fn stretching_changes_nothing() {
    let mesh = Domain::rectangle("square", 1.0, 1.0).mesh(&mut Random(6), 0.1);
    let stretch = |v: &Vector| Vector::new(v.x, 1e-3 * v.y, 0.0);
    let thin = mesh.points().iter().map(stretch).collect();
    let thin = TriangleMesh::new(thin, mesh.triangles().to_vec()).unwrap();
    let values = values(&mesh);
    let even = recover_gradients(&mesh, &values, RecoveryDegree::Three);
    let steep = recover_gradients(&thin, &values, RecoveryDegree::Three);
    for (even, steep) in even.iter().zip(&steep) {
        assert!((even - stretch(steep)).norm() < 1e-7, "{even} {steep}");
    }
}
