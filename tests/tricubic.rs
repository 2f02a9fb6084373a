//! The tri-cubic: continuous, exact where it must be, of its order.

mod support;

use std::collections::HashMap;

use support::meshes::Random;
use support::order::order;
use support::polynomial::Polynomial;
use support::problems_3d::{FIFTH, Problem, SEVENTH};
use support::tetrahedra::{graded_cube, kuhn_grid, random_cube, shuffled};
use vtu2contour::bernstein::Barycentric4;
use vtu2contour::field::{Field, RecoveryDegree, recover_gradients};
use vtu2contour::interpolant::{Equation, Linear, Predictor, TetrahedronCubics, Tricubic};
use vtu2contour::mesh::{TetrahedronMesh, Vector};
use vtu2contour::pde::Pde;

fn equation<'a>(pde: &'a Pde, arrays: &'a [Vec<f64>]) -> Equation<'a> {
    Equation { pde, arrays, predictor: Predictor::Quadratic }
}

fn parse(text: &str) -> Pde {
    Pde::parse(text, &[], &[]).unwrap()
}

fn random_vector(random: &mut Random) -> Vector {
    Vector::from([(); 3].map(|()| random.uniform(-1.0, 1.0)))
}

/// Values and gradients that have nothing to do with each other.
fn noise(random: &mut Random, mesh: &TetrahedronMesh) -> (Vec<f64>, Vec<Vector>) {
    let values = mesh.points().iter().map(|_| random.uniform(-1.0, 1.0)).collect();
    let gradients = mesh.points().iter().map(|_| random_vector(random)).collect();
    (values, gradients)
}

fn inside(random: &mut Random) -> Barycentric4 {
    let weights = [(); 4].map(|()| random.uniform(0.01, 1.0));
    weights.map(|weight| weight / weights.iter().sum::<f64>())
}

/// Each interior face has the same ten coefficients, bit for bit, from both sides.
fn check_continuous(cubics: &dyn TetrahedronCubics, random: &mut Random) {
    let mesh = cubics.mesh();
    let mut faces = HashMap::new();
    let mut shared = 0;
    for (tetrahedron, points) in mesh.tetrahedra().iter().enumerate() {
        for opposite in 0..4 {
            let mut vertices = [1, 2, 3].map(|step| (opposite + step) % 4);
            vertices.sort_unstable_by_key(|&vertex| points[vertex]);
            let cubic = cubics.cubic(tetrahedron);
            let face = cubic.face(vertices);
            let Some((other, to)) = faces.insert(vertices.map(|v| points[v]), (face, tetrahedron))
            else {
                continue;
            };
            assert_eq!(face.coefficients.map(f64::to_bits), other.coefficients.map(f64::to_bits));
            shared += 1;
            // and so the values are the same, wherever the face stands in each
            let mut at = inside(random);
            at[opposite] = 0.0;
            let at = at.map(|weight| weight / at.iter().sum::<f64>());
            let beyond = mesh.tetrahedra()[to];
            let there = beyond.map(|p| points.iter().position(|q| p == *q).map_or(0.0, |v| at[v]));
            assert!((cubic.value(&at) - cubics.cubic(to).value(&there)).abs() < 1e-12);
        }
    }
    assert!(shared > mesh.tetrahedra().len());
}

const ODD_PDE: &str =
    "(1 + x^2)*uxx + 2*uyy + (1 + y)*uzz + uxy/2 - uyz/3 = sin(x)*u - uy + ux*uz/100";

#[test]
fn neighbours_have_the_same_bits_on_their_common_face() {
    let mut random = Random(11);
    let pde = parse(ODD_PDE);
    for mesh in [random_cube(&mut random, 300), graded_cube(&mut random, 300), kuhn_grid(3)] {
        for mesh in [shuffled(&mut random, &mesh), mesh] {
            let (values, gradients) = noise(&mut random, &mesh);
            let field = Field { values: &values, gradients: &gradients };
            check_continuous(&Tricubic::new(&mesh, field), &mut random);
            let plain = Tricubic::with_quadratic_precision(&mesh, field);
            check_continuous(&plain, &mut random);
            let with_pde = Tricubic::with_pde(&mesh, field, &equation(&pde, &[]));
            assert_eq!(with_pde.singular(), 0);
            check_continuous(&with_pde, &mut random);
            check_continuous(&Linear::new(&mesh, &values), &mut random);
        }
    }
}

#[test]
fn quadratics_are_reproduced_without_a_pde() {
    let mut random = Random(12);
    for mesh in [random_cube(&mut random, 100), graded_cube(&mut random, 100)] {
        let u = Polynomial::random(&mut random, 2);
        let (values, gradients) = u.at_points(&mesh);
        let field = Field { values: &values, gradients: &gradients };
        let tricubic = Tricubic::with_quadratic_precision(&mesh, field);
        assert!(worst(&tricubic, &u, &mut random) < 1e-13 * range(&values));
    }
}

/// The greatest error at random points of all tetrahedra.
fn worst(cubics: &dyn TetrahedronCubics, u: &Polynomial, random: &mut Random) -> f64 {
    let mut worst = 0.0_f64;
    for tetrahedron in 0..cubics.mesh().tetrahedra().len() {
        let at = inside(random);
        let exact = u.value(&cubics.mesh().position(tetrahedron, &at));
        worst = worst.max((cubics.cubic(tetrahedron).value(&at) - exact).abs());
    }
    worst
}

fn range(values: &[f64]) -> f64 {
    let (low, high) = values.iter().fold((values[0], values[0]), |(l, h), &v| (l.min(v), h.max(v)));
    high - low
}

/// Any cubic, with the PDE that says what an operator makes of it.
#[test]
fn cubics_are_reproduced_with_their_pde() {
    let mut random = Random(13);
    let meshes = [random_cube(&mut random, 200), graded_cube(&mut random, 200), kuhn_grid(4)];
    for mesh in &meshes {
        for operator in [
            "uxx + uyy + uzz",
            "3*uxx + 2*uyy + uzz + uxy - uyz/2",
            "(1 + x^2)*uxx + (2 - y)*uyy + uzz + x*y*uxz",
        ] {
            let u = Polynomial::random(&mut random, 3);
            let (values, gradients) = u.at_points(mesh);
            let field = Field { values: &values, gradients: &gradients };
            let pde = parse(&format!("{operator} = {}", u.operator_text(operator)));
            let tricubic = Tricubic::with_pde(mesh, field, &equation(&pde, &[]));
            let error = worst(&tricubic, &u, &mut random) / range(&values);
            let without = Tricubic::with_quadratic_precision(mesh, field);
            let without = worst(&without, &u, &mut random) / range(&values);
            println!("{operator}: {error:.1e}, without the PDE {without:.1e}");
            assert!(error < 1e-12 && without > 1e-4);
        }
    }
}

/// A linear map of space, with the operator mapped along, changes no coefficient.
#[test]
fn affine_invariance() {
    let mut random = Random(14);
    let mesh = random_cube(&mut random, 120);
    let (values, gradients) = noise(&mut random, &mesh);
    let load: Vec<f64> = values.iter().map(|_| random.uniform(-1.0, 1.0)).collect();
    let map = nalgebra::Matrix3::new(2.0, 0.3, -0.1, 0.2, 0.5, 0.4, -0.6, 0.1, 3.0);
    let mapped = mesh.points().iter().map(|p| map * p + Vector::repeat(0.7)).collect();
    let mapped = TetrahedronMesh::new(mapped, mesh.tetrahedra().to_vec()).unwrap();
    let inverse = map.try_inverse().unwrap().transpose();
    let mapped_gradients: Vec<Vector> = gradients.iter().map(|g| inverse * g).collect();
    // the Laplacian in the old coordinates
    let a = map * map.transpose();
    let text = format!(
        "{}*uxx + {}*uyy + {}*uzz + {}*uxy + {}*uxz + {}*uyz = load",
        a[(0, 0)],
        a[(1, 1)],
        a[(2, 2)],
        2.0 * a[(0, 1)],
        2.0 * a[(0, 2)],
        2.0 * a[(1, 2)]
    );
    let names = ["load".to_owned()];
    let pdes = ["uxx + uyy + uzz = load", &text].map(|t| Pde::parse(t, &[], &names).unwrap());
    let arrays = [load];
    let one = Field { values: &values, gradients: &gradients };
    let one = Tricubic::with_pde(&mesh, one, &equation(&pdes[0], &arrays));
    let two = Field { values: &values, gradients: &mapped_gradients };
    let two = Tricubic::with_pde(&mapped, two, &equation(&pdes[1], &arrays));
    for tetrahedron in 0..mesh.tetrahedra().len() {
        let pairs = one.cubic(tetrahedron).coefficients.into_iter();
        for (a, b) in pairs.zip(two.cubic(tetrahedron).coefficients) {
            assert!((a - b).abs() < 1e-10);
        }
    }
}

#[test]
fn the_same_bits_for_any_number_of_threads() {
    let mut random = Random(15);
    // more than one chunk of sums
    let mesh = random_cube(&mut random, 2000);
    let (values, gradients) = noise(&mut random, &mesh);
    let pde = parse(ODD_PDE);
    let bits = |threads: usize| -> Vec<[u64; 20]> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let field = Field { values: &values, gradients: &gradients };
        let tricubic = pool.install(|| Tricubic::with_pde(&mesh, field, &equation(&pde, &[])));
        let all = 0..mesh.tetrahedra().len();
        all.map(|t| tricubic.cubic(t).coefficients.map(f64::to_bits)).collect()
    };
    let one = bits(1);
    assert!(one == bits(2) && one == bits(7));
}

#[test]
fn where_the_pde_fails_it_is_left_out_and_counted() {
    let mesh = kuhn_grid(4);
    let (values, gradients) = FIFTH.at_points(&mesh);
    let field = Field { values: &values, gradients: &gradients };
    let half = mesh.tetrahedra().len() / 2;
    let plain = Tricubic::new(&mesh, field);
    // not a number on one half; no second derivatives on the other
    for text in ["uxx + uyy + uzz = log(x - 0.5)", "heaviside(x - 0.5)*(uxx + uyy + uzz) = 0"] {
        let pde = parse(text);
        let tricubic = Tricubic::with_pde(&mesh, field, &equation(&pde, &[]));
        assert_eq!(tricubic.singular(), half);
        for tetrahedron in 0..mesh.tetrahedra().len() {
            let cubic = tricubic.cubic(tetrahedron);
            assert!(cubic.coefficients.iter().all(|c| c.is_finite()));
            // a whole layer of cubes away from the half that has a PDE
            let alone = mesh.corners(tetrahedron).iter().all(|corner| corner.x <= 0.25);
            assert!(!alone || cubic == plain.cubic(tetrahedron));
        }
    }
}

#[test]
fn tetrahedra_without_volume_do_no_harm() {
    let mut points = kuhn_grid(2).points().to_vec();
    let mut tetrahedra = kuhn_grid(2).tetrahedra().to_vec();
    let whole = tetrahedra.len();
    // flat, with a corner twice, and with a corner at infinity
    points.push(Vector::repeat(f64::INFINITY));
    tetrahedra.extend([[0, 1, 3, 4], [0, 0, 1, 9], [0, 1, 3, 27]]);
    let mesh = TetrahedronMesh::new(points, tetrahedra).unwrap();
    let (mut values, mut gradients) = FIFTH.at_points(&mesh);
    (values[27], gradients[27]) = (0.0, Vector::zeros());
    let field = Field { values: &values, gradients: &gradients };
    let pde = parse(FIFTH.pde);
    let tricubic = Tricubic::with_pde(&mesh, field, &equation(&pde, &[]));
    assert_eq!(tricubic.singular(), 3);
    for tetrahedron in 0..whole {
        assert!(tricubic.cubic(tetrahedron).coefficients.iter().all(|c| c.is_finite()));
    }
}

/// A value that is not there spoils the tetrahedra around it and no other.
#[test]
fn missing_values_do_not_spread() {
    let mesh = random_cube(&mut Random(17), 100);
    let (mut values, gradients) = FIFTH.at_points(&mesh);
    values[50] = f64::NAN;
    let field = Field { values: &values, gradients: &gradients };
    let pde = parse(FIFTH.pde);
    let tricubic = Tricubic::with_pde(&mesh, field, &equation(&pde, &[]));
    let around = mesh.tetrahedra().iter().filter(|points| points.contains(&50)).count();
    assert_eq!(tricubic.singular(), around);
    for (tetrahedron, points) in mesh.tetrahedra().iter().enumerate() {
        let finite = tricubic.cubic(tetrahedron).coefficients.iter().all(|c| c.is_finite());
        assert_eq!(finite, !points.contains(&50));
    }
}

/// Equations that determine only a part of each cubic do no harm.
#[test]
fn operators_that_see_little() {
    let mesh = random_cube(&mut Random(18), 500);
    let (values, gradients) = SEVENTH.at_points(&mesh);
    let field = Field { values: &values, gradients: &gradients };
    let without = error(&Tricubic::with_quadratic_precision(&mesh, field), &SEVENTH);
    for text in [
        "uxx = y^2*z^2*u",
        "uxx + uyy = (x^2 + y^2)*z^2*u",
        "uxx - uzz = (z^2 - x^2)*y^2*u",
        "uxy = z*(1 + x*y*z)*u",
    ] {
        let pde = parse(text);
        let tricubic = Tricubic::with_pde(&mesh, field, &equation(&pde, &[]));
        let with = error(&tricubic, &SEVENTH);
        println!("{text}: {with:.2e}, without {without:.2e}");
        assert!(with < without && tricubic.singular() == 0);
    }
}

/// Mean error at points of each tetrahedron.
fn error(cubics: &dyn TetrahedronCubics, problem: &Problem) -> f64 {
    let places = [[0.25; 4], [0.7, 0.1, 0.1, 0.1], [0.1, 0.2, 0.3, 0.4], [0.05, 0.3, 0.6, 0.05]];
    let mesh = cubics.mesh();
    let mut sum = 0.0;
    for tetrahedron in 0..mesh.tetrahedra().len() {
        let cubic = cubics.cubic(tetrahedron);
        for at in &places {
            sum += (cubic.value(at) - (problem.value)(&mesh.position(tetrahedron, at))).abs();
        }
    }
    sum / (4 * mesh.tetrahedra().len()) as f64
}

#[test]
fn orders_of_accuracy() {
    const SIZES: [usize; 3] = [6, 9, 14];
    let pde = parse(FIFTH.pde);
    let observed = |interpolated: &dyn Fn(&TetrahedronMesh, Field) -> f64| {
        order(&SIZES.map(|n| {
            let mesh = kuhn_grid(n);
            let (values, gradients) = FIFTH.at_points(&mesh);
            let field = Field { values: &values, gradients: &gradients };
            (1.0 / n as f64, interpolated(&mesh, field))
        }))
    };
    let linear = observed(&|mesh, field| error(&Linear::new(mesh, field.values), &FIFTH));
    let plain =
        observed(&|mesh, field| error(&Tricubic::with_quadratic_precision(mesh, field), &FIFTH));
    let completed = observed(&|mesh, field| error(&Tricubic::new(mesh, field), &FIFTH));
    let with_pde = observed(&|mesh, field| {
        error(&Tricubic::with_pde(mesh, field, &equation(&pde, &[])), &FIFTH)
    });
    let recovered = observed(&|mesh, field| {
        let gradients = recover_gradients(mesh, field.values, RecoveryDegree::Three);
        let field = Field { values: field.values, gradients: &gradients };
        error(&Tricubic::with_pde(mesh, field, &equation(&pde, &[])), &FIFTH)
    });
    println!(
        "orders: linear {linear:.2}, quadratic precision {plain:.2}, without PDE \
         {completed:.2}, with PDE {with_pde:.2}, with PDE and recovered gradients \
         {recovered:.2}"
    );
    assert!((1.9..2.2).contains(&linear));
    assert!(plain > 2.9 && completed > 3.85);
    assert!(with_pde > 3.85);
    assert!(recovered > 2.9);
}
