//! Monitors: exact by hand, and what they must not depend on.

mod support;

use proptest::prelude::*;
use vtu2contour::field::Field;
use vtu2contour::interpolant::family::spaces::{DEI4_15, FQI, P3};
use vtu2contour::interpolant::family::{Dei, DeiOptions};
use vtu2contour::interpolant::{Equation, Linear, Pci, Predictor, Tricubic};
use vtu2contour::mesh::{RefinedMesh, TetrahedronMesh, TriangleMesh, Vector};
use vtu2contour::monitor::{
    SamplePoints, Summary, defect, greatest_defect, interpolation_error, once_refined,
    stepwise_error, surface_area,
};
use vtu2contour::pde::Pde;

use support::meshes::{Random, random_square};
use support::problem4;

const FIXED: SamplePoints = SamplePoints::Fixed;

fn triangle() -> TriangleMesh<'static> {
    let points = vec![Vector::zeros(), Vector::x(), Vector::y()];
    TriangleMesh::new(points, vec![[0, 1, 2]]).unwrap()
}

fn tetrahedron() -> TetrahedronMesh<'static> {
    let points = vec![Vector::zeros(), Vector::x(), Vector::y(), Vector::z()];
    TetrahedronMesh::new(points, vec![[0, 1, 2, 3]]).unwrap()
}

/// Values and gradients of a function.
fn at(points: &[Vector], u: fn(&Vector) -> (f64, Vector)) -> (Vec<f64>, Vec<Vector>) {
    points.iter().map(u).unzip()
}

fn pde(text: &str) -> Pde {
    Pde::parse(text, &[], &[]).unwrap()
}

fn equation(pde: &Pde) -> Equation<'_> {
    Equation { pde, arrays: &[], predictor: Predictor::Quadratic }
}

#[track_caller]
fn close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() < 1e-14, "{found:?}, not {expected:?}");
    }
}

fn x_squared(p: &Vector) -> (f64, Vector) {
    (p.x * p.x, Vector::x() * 2.0 * p.x)
}

#[test]
fn defect_by_hand() {
    let mesh = triangle();
    let (values, gradients) = at(mesh.points(), x_squared);
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    // the area of 1/2 times |2 - 0|
    let laplace = pde("uxx + uyy = 0");
    close(&defect(&pci, &equation(&laplace), FIXED), &[1.0]);
    close(&greatest_defect(&pci, &equation(&laplace), FIXED), &[2.0]);
    // |2 - (u + 2)| = x²: λ₁ is 1/9 thrice, 2/9 twice, 4/9 twice, 5/9 and 7/9 once
    let helmholtz = pde("uxx + uyy = u + 2");
    close(&defect(&pci, &equation(&helmholtz), FIXED), &[0.5 * 13.0 / 81.0]);
    close(&greatest_defect(&pci, &equation(&helmholtz), FIXED), &[49.0 / 81.0]);
    // coefficients and other derivatives: 3·2 x + 0 - 2 ux = 2 x, mean 2/3
    let mixed = pde("3*x*uxx + 5*uxy + uzz = 2*ux");
    close(&defect(&pci, &equation(&mixed), FIXED), &[1.0 / 3.0]);
}

#[test]
fn defect_of_arrays_and_in_tetrahedra() {
    let mesh = tetrahedron();
    let (values, gradients) = at(mesh.points(), |p| (p.norm_squared(), p * 2.0));
    let cubics = Tricubic::new(&mesh, Field { values: &values, gradients: &gradients });
    let poisson = Pde::parse("uxx + uyy + uzz = f", &[], &["f".to_owned()]).unwrap();
    let arrays = [vec![5.0, 4.0, 4.0, 4.0]];
    let equation = Equation { pde: &poisson, arrays: &arrays, predictor: Predictor::Quadratic };
    // a volume of 1/6 times the mean of |6 - 4 - λ₀|
    close(&defect(&cubics, &equation, FIXED), &[1.75 / 6.0]);
}

#[test]
fn surface_area_by_hand() {
    let slope = |p: &Vector| (2.0 * p.x + 2.0 * p.y, Vector::new(2.0, 2.0, 0.0));
    let mesh = triangle();
    let (values, gradients) = at(mesh.points(), slope);
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    close(&surface_area(&pci, FIXED), &[1.5]);
    let mesh = tetrahedron();
    let (values, gradients) = at(mesh.points(), slope);
    let cubics = Tricubic::new(&mesh, Field { values: &values, gradients: &gradients });
    close(&surface_area(&cubics, FIXED), &[0.5]);
}

#[test]
fn interpolation_error_by_hand() {
    let mesh = triangle();
    let (values, gradients) = at(mesh.points(), x_squared);
    let field = Field { values: &values, gradients: &gradients };
    // |x² - x|
    let (pci, linear) = (Pci::new(&mesh, field), Linear::new(&mesh, &values));
    close(&interpolation_error(&pci, &linear, FIXED), &[14.0 / 81.0]);
    // all quartics reproduce what the cubic does
    let poisson = pde("uxx + uyy = 2");
    let (equation, options) = (equation(&poisson), DeiOptions::default());
    let cubic = Pci::with_pde(&mesh, field, &equation);
    let full = Dei::new(FQI, &mesh, field, &equation, &options);
    let pure = Dei::new(DEI4_15, &mesh, field, &equation, &options);
    assert!(
        interpolation_error(&cubic as &dyn vtu2contour::interpolant::Pieces<3>, &full, FIXED)[0]
            < 1e-12
    );
    assert!(
        interpolation_error(&cubic as &dyn vtu2contour::interpolant::Pieces<3>, &pure, FIXED)[0]
            < 1e-12
    );
}

#[test]
fn interpolation_error_in_tetrahedra() {
    let mesh = tetrahedron();
    let (values, gradients) = at(mesh.points(), |p| (p.norm_squared(), p * 2.0));
    let field = Field { values: &values, gradients: &gradients };
    let poisson = pde("uxx + uyy + uzz = 6");
    let own = Dei::new(P3, &mesh, field, &equation(&poisson), &DeiOptions::default());
    let cubics = Tricubic::new(&mesh, field);
    let pieces: &dyn vtu2contour::interpolant::Pieces<4> = &cubics;
    assert!(interpolation_error(pieces, &own, FIXED)[0] < 1e-12);
}

#[test]
fn stepwise_error_by_hand() {
    let mesh = triangle();
    let (values, _) = at(mesh.points(), x_squared);
    let coarse = Linear::new(&mesh, &values);
    let refined = RefinedMesh::uniform(&mesh, 2);
    let cells = refined.pieces.iter().map(|piece| piece.corners).collect();
    let fine_mesh = TriangleMesh::new(refined.points.clone(), cells).unwrap();
    let (fine_values, _) = at(fine_mesh.points(), x_squared);
    let fine = Linear::new(&fine_mesh, &fine_values);
    // 0 where x is 0 or 1, and 1/4 where it is 1/2; linear in each part
    let mean = |part: &[u32; 3]| {
        let of = |&p: &u32| if refined.points[p as usize].x == 0.5 { 0.25 } else { 0.0 };
        part.iter().map(of).sum::<f64>() / 3.0
    };
    let by_part: Vec<f64> = fine_mesh.triangles().iter().map(mean).collect();
    let mut sorted = by_part.clone();
    sorted.sort_by(f64::total_cmp);
    close(&sorted, &[1.0 / 12.0, 1.0 / 12.0, 1.0 / 6.0, 1.0 / 6.0]);
    close(&stepwise_error(&fine, &coarse, FIXED), &by_part);
    close(&once_refined(&coarse, &refined, &fine, FIXED), &[0.125]);
    close(&stepwise_error(&coarse, &coarse, FIXED), &[0.0]);
}

#[test]
fn what_cannot_be_computed_is_not_a_number() {
    let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [2.0, 0.0], [1.0, 1.0]];
    let points = points.iter().map(|p| Vector::new(p[0], p[1], 0.0)).collect();
    // the second has no area, the third no value at one corner
    let mesh = TriangleMesh::new(points, vec![[0, 1, 2], [0, 1, 3], [1, 4, 2]]).unwrap();
    let (mut values, gradients) = at(mesh.points(), x_squared);
    values[4] = f64::NAN;
    let pci =
        Pci::with_quadratic_precision(&mesh, Field { values: &values, gradients: &gradients });
    let laplace = pde("uxx + uyy = 0");
    let monitors = [
        defect(&pci, &equation(&laplace), FIXED),
        greatest_defect(&pci, &equation(&laplace), FIXED),
        interpolation_error(&pci, &pci, FIXED),
    ];
    for monitor in monitors {
        assert_eq!(monitor.iter().map(|x| x.is_nan()).collect::<Vec<_>>(), [false, true, true]);
        assert_eq!(Summary::new(&monitor).not_computed, 2);
    }
    // an inverse at zero slope
    let singular = pde("uxx + uyy = 1/uy");
    assert!(defect(&pci, &equation(&singular), FIXED)[0].is_nan());
}

/// All monitors of a mesh of problem 4.
fn all(mesh: &TriangleMesh, points: SamplePoints) -> Vec<Vec<f64>> {
    let (values, gradients) = problem4::at_points(mesh);
    let field = Field { values: &values, gradients: &gradients };
    let pde = pde(problem4::PDE);
    let equation = equation(&pde);
    let (pci, free) = (Pci::with_pde(mesh, field, &equation), Pci::new(mesh, field));
    vec![
        defect(&pci, &equation, points),
        surface_area(&pci, points),
        stepwise_error(&pci, &free, points),
        interpolation_error(&pci, &free, points),
    ]
}

#[test]
fn the_same_bytes_for_any_number_of_threads() {
    let mesh = random_square(&mut Random(3), 500);
    for points in [FIXED, SamplePoints::Random { count: 7, seed: 1 }] {
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| all(&mesh, points))
        };
        assert_eq!(format!("{:?}", with(1)), format!("{:?}", with(5)));
    }
}

#[test]
fn random_points_tell_about_the_same() {
    let mesh = random_square(&mut Random(3), 500);
    let random = |seed| all(&mesh, SamplePoints::Random { count: 200, seed });
    for ((fixed, one), other) in all(&mesh, FIXED).iter().zip(random(1)).zip(random(2)) {
        let sum = |values: &[f64]| Summary::new(values).sum;
        // of the bubble λ₀ λ₁ λ₂ the fixed points make 1.18 of what it is
        assert!((sum(&one) / sum(fixed) - 1.0).abs() < 0.2);
        assert_ne!(one, other);
    }
}

proptest! {
    /// Turned, mirrored and named in another order, cells keep their numbers.
    #[test]
    fn the_order_of_corners_does_not_count(seed in 0..1000_u64) {
        let mesh = random_square(&mut Random(seed), 20);
        let turned = mesh.triangles().iter().map(|&[a, b, c]| [c, a, b]).collect();
        let swapped = mesh.triangles().iter().map(|&[a, b, c]| [b, a, c]).collect();
        for other in [turned, swapped] {
            let other = TriangleMesh::new(mesh.points().to_vec(), other).unwrap();
            for (one, other) in all(&mesh, FIXED).iter().zip(all(&other, FIXED)) {
                let greatest = Summary::new(one).maximum;
                for (a, b) in one.iter().zip(other) {
                    prop_assert!((a - b).abs() < 1e-9 * greatest);
                }
            }
        }
    }

    /// `∫ |L p - g|` scales as it must: with lengths by the square for an area, and the
    /// values as they are.
    #[test]
    fn defect_scales(seed in 0..1000_u64, scale in 0.1..10.0f64) {
        let mesh = random_square(&mut Random(seed), 20);
        let (values, gradients) = problem4::at_points(&mesh);
        let scaled = mesh.points().iter().map(|p| p * scale).collect();
        let large = TriangleMesh::new(scaled, mesh.triangles().to_vec()).unwrap();
        let slopes: Vec<Vector> = gradients.iter().map(|g| g / scale).collect();
        // ∫ |Δu|: second derivatives fall as the area grows
        let laplace = pde("uxx + uyy = 0");
        let of = |mesh: &TriangleMesh, gradients: &[Vector]| {
            let pci = Pci::new(mesh, Field { values: &values, gradients });
            defect(&pci, &equation(&laplace), FIXED)
        };
        let (one, other) = (of(&mesh, &gradients), of(&large, &slopes));
        let greatest = Summary::new(&one).maximum;
        for (a, b) in one.iter().zip(other) {
            prop_assert!((a - b).abs() < 1e-9 * greatest);
        }
    }
}
