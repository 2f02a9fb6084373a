//! The pure cubic interpolant: continuous, exact where it must be, of its order.

mod support;

use support::meshes::{Random, grid, random_square};
use support::order::order;
use support::problem4;
use vtu2contour::bernstein::Barycentric;
use vtu2contour::field::{Field, RecoveryDegree, recover_gradients};
use vtu2contour::interpolant::{Equation, Linear, Pci, Predictor, TriangleCubics};
use vtu2contour::mesh::{TriangleMesh, Vector};
use vtu2contour::pde::Pde;

/// Mean error of an interpolant against problem 4 at points of each triangle.
fn error(interpolant: &dyn TriangleCubics) -> f64 {
    let places: [Barycentric; 4] =
        [[0.34, 0.33, 0.33], [0.6, 0.2, 0.2], [0.2, 0.6, 0.2], [0.2, 0.2, 0.6]];
    let mesh = interpolant.mesh();
    let mut errors = Vec::new();
    for triangle in 0..mesh.triangles().len() {
        for at in &places {
            let exact = problem4::value(&mesh.position(triangle, at));
            errors.push((interpolant.cubic(triangle).value(at) - exact).abs());
        }
    }
    errors.iter().sum::<f64>() / errors.len() as f64
}

const SIZES: [usize; 4] = [24, 32, 48, 64];

fn observed_order(error_on: impl Fn(&TriangleMesh, &[f64], &[Vector]) -> f64) -> f64 {
    let errors = SIZES.map(|n| {
        let mesh = grid(n);
        let (values, gradients) = problem4::at_points(&mesh);
        (1.0 / n as f64, error_on(&mesh, &values, &gradients))
    });
    order(&errors)
}

fn with_pde(
    mesh: &TriangleMesh,
    values: &[f64],
    gradients: &[Vector],
    predictor: Predictor,
) -> f64 {
    let pde = Pde::parse(problem4::PDE, &[], &[]).unwrap();
    let equation = Equation { pde: &pde, arrays: &[], predictor };
    error(&Pci::with_pde(mesh, Field { values, gradients }, &equation))
}

#[test]
fn orders_of_accuracy() {
    let linear = observed_order(|mesh, values, _| error(&Linear::new(mesh, values)));
    let plain = observed_order(|mesh, values, gradients| {
        error(&Pci::with_quadratic_precision(mesh, Field { values, gradients }))
    });
    let completed = observed_order(|mesh, values, gradients| {
        error(&Pci::new(mesh, Field { values, gradients }))
    });
    let thesis = observed_order(|mesh, u, g| with_pde(mesh, u, g, Predictor::Linear));
    let ours = observed_order(|mesh, u, g| with_pde(mesh, u, g, Predictor::Quadratic));
    let recovered = observed_order(|mesh, values, _| {
        let gradients = recover_gradients(mesh, values, RecoveryDegree::Three);
        error(&Pci::new(mesh, Field { values, gradients: &gradients }))
    });
    println!(
        "orders: linear {linear:.2}, quadratic precision {plain:.2}, without PDE \
         {completed:.2}, with PDE {ours:.2} (linear predictor {thesis:.2}), recovered \
         gradients {recovered:.2}"
    );
    assert!((1.9..2.2).contains(&linear));
    assert!((2.9..3.2).contains(&plain));
    assert!(completed > 3.85);
    assert!(ours > 3.85);
    assert!(recovered > 3.85);
}

#[test]
fn neighbours_have_the_same_bits_on_their_common_edge() {
    let mut random = Random(5);
    let mesh = random_square(&mut random, 200);
    let mut number = || random.uniform(-1.0, 1.0);
    let values: Vec<f64> = mesh.points().iter().map(|_| number()).collect();
    let gradients: Vec<Vector> =
        mesh.points().iter().map(|_| Vector::new(number(), number(), number())).collect();
    let pde = Pde::parse("uxx + 2*uyy + uxy/2 = sin(x)*u - uy", &[], &[]).unwrap();
    let equation = Equation { pde: &pde, arrays: &[], predictor: Predictor::Quadratic };
    let field = Field { values: &values, gradients: &gradients };
    let interpolants: [&dyn TriangleCubics; 4] = [
        &Pci::new(&mesh, field),
        &Pci::with_quadratic_precision(&mesh, field),
        &Pci::with_pde(&mesh, field, &equation),
        &Linear::new(&mesh, &values),
    ];
    for interpolant in interpolants {
        let mut edges = std::collections::HashMap::new();
        let mut shared = 0;
        for (triangle, points) in mesh.triangles().iter().enumerate() {
            for edge in 0..3 {
                let (from, to) = (points[(edge + 1) % 3], points[(edge + 2) % 3]);
                let cubic = interpolant.cubic(triangle).edge(edge);
                let forward = if from < to { cubic } else { cubic.reversed() };
                let bits = forward.coefficients.map(f64::to_bits);
                if let Some(other) = edges.insert((from.min(to), from.max(to)), bits) {
                    assert_eq!(bits, other);
                    shared += 1;
                }
            }
        }
        assert!(shared > 500);
    }
}

#[test]
fn quadratics_are_reproduced_on_any_triangle_in_space() {
    let mut random = Random(6);
    for _ in 0..200 {
        let mut corner = || Vector::new(0.0, 0.0, 0.0).map(|_| random.uniform(-1.0, 1.0));
        let points = vec![corner(), corner(), corner()];
        let mesh = TriangleMesh::new(points, vec![[0, 1, 2]]).unwrap();
        let value = |p: &Vector| 1.0 + p.x - 2.0 * p.y * p.z + p.x * p.x;
        let gradient = |p: &Vector| Vector::new(1.0 + 2.0 * p.x, -2.0 * p.z, -2.0 * p.y);
        let values: Vec<f64> = mesh.points().iter().map(value).collect();
        let gradients: Vec<Vector> = mesh.points().iter().map(gradient).collect();
        let cubic = Pci::new(&mesh, Field { values: &values, gradients: &gradients }).cubic(0);
        for at in [[0.2, 0.3, 0.5], [1.0 / 3.0; 3], [0.0, 0.5, 0.5]] {
            let exact = value(&mesh.position(0, &at));
            assert!((cubic.value(&at) - exact).abs() < 1e-14);
        }
    }
}

#[test]
fn the_surface_laplacian_acts_in_the_plane_of_the_triangle() {
    // the same triangle and the same cubic, flat and turned in space: one with the
    // Laplacian of the plane, one with that of space
    let mut random = Random(7);
    let turn = nalgebra::Rotation3::from_euler_angles(0.4, -1.1, 2.0);
    let flat: Vec<Vector> = (0..3)
        .map(|_| Vector::new(random.uniform(0.0, 1.0), random.uniform(0.0, 1.0), 0.0))
        .collect();
    let turned: Vec<Vector> = flat.iter().map(|p| turn * p).collect();
    let values = [0.3, -0.2, 1.1];
    let slopes: Vec<Vector> = (0..3)
        .map(|_| Vector::new(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 0.0))
        .collect();
    let turned_slopes: Vec<Vector> = slopes.iter().map(|g| turn * g).collect();
    let cubic = |points: Vec<Vector>, gradients: &[Vector], text: &str| {
        let mesh = TriangleMesh::new(points, vec![[0, 1, 2]]).unwrap();
        let pde = Pde::parse(text, &[], &[]).unwrap();
        let equation = Equation { pde: &pde, arrays: &[], predictor: Predictor::Quadratic };
        Pci::with_pde(&mesh, Field { values: &values, gradients }, &equation).cubic(0)
    };
    let in_plane = cubic(flat, &slopes, "uxx + uyy = 3*u");
    let in_space = cubic(turned, &turned_slopes, "uxx + uyy + uzz = 3*u");
    for (a, b) in in_plane.coefficients.iter().zip(in_space.coefficients) {
        assert!((a - b).abs() < 1e-12);
    }
}

#[test]
fn a_pde_that_does_not_determine_the_cubic_is_left_out_and_counted() {
    let mesh = grid(3);
    let (values, gradients) = problem4::at_points(&mesh);
    let field = Field { values: &values, gradients: &gradients };
    // on these triangles uxx - uyy does not see b_111
    let pde = Pde::parse("uxx - uyy = 0", &[], &[]).unwrap();
    let equation = Equation { pde: &pde, arrays: &[], predictor: Predictor::Quadratic };
    let pci = Pci::with_pde(&mesh, field, &equation);
    assert_eq!(pci.singular(), 18);
    let plain = Pci::with_quadratic_precision(&mesh, field);
    assert!((0..18).all(|triangle| pci.cubic(triangle) == plain.cubic(triangle)));
    // a right-hand side that is not a number is not used either
    let pde = Pde::parse("uxx + uyy = log(x - 0.5)", &[], &[]).unwrap();
    let equation = Equation { pde: &pde, ..equation };
    assert_eq!(Pci::with_pde(&mesh, field, &equation).singular(), 9);
}

#[test]
fn point_arrays_enter_the_pde() {
    // u = x³ with its Laplacian, 6 x, as an array: linear, so interpolated exactly
    let mesh = grid(4);
    let values: Vec<f64> = mesh.points().iter().map(|p| p.x.powi(3)).collect();
    let gradients: Vec<Vector> =
        mesh.points().iter().map(|p| Vector::new(3.0 * p.x * p.x, 0.0, 0.0)).collect();
    let load: Vec<f64> = mesh.points().iter().map(|p| 6.0 * p.x).collect();
    let pde = Pde::parse("uxx + uyy = load", &[], &["load".to_owned()]).unwrap();
    let arrays = [load];
    let equation = Equation { pde: &pde, arrays: &arrays, predictor: Predictor::Quadratic };
    let pci = Pci::with_pde(&mesh, Field { values: &values, gradients: &gradients }, &equation);
    for triangle in 0..mesh.triangles().len() {
        let at = [0.5, 0.3, 0.2];
        let exact = mesh.position(triangle, &at).x.powi(3);
        assert!((pci.cubic(triangle).value(&at) - exact).abs() < 1e-15);
    }
}
