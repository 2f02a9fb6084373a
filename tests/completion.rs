//! Interpolants without a PDE: cubics are reproduced, good meshes gain an order, and no
//! mesh is worse for it than by quadratic precision.

mod support;

use nalgebra::Rotation3;
use proptest::prelude::*;
use support::domains::{Domain, slope_of_waves, waves};
use support::meshes::{Random, grid, random_square};
use support::order::order;
use support::polynomial::Polynomial;
use support::problem4;
use support::problems_3d::PROBLEMS;
use support::sampling::{errors_in_tetrahedra, errors_on_square};
use support::tetrahedra::{graded_cube, kuhn_grid, random_cube, shuffled};
use vtu2contour::bernstein::{TetrahedronCubic, TriangleCubic};
use vtu2contour::field::{Field, RecoveryDegree, recover_gradients};
use vtu2contour::interpolant::{Pci, TetrahedronCubics, TriangleCubics, Tricubic};
use vtu2contour::mesh::{SimplexMesh, TetrahedronMesh, TriangleMesh, Vector};

/// A solution: its value and its gradient.
type Solution = (&'static str, fn(&Vector) -> f64, fn(&Vector) -> Vector);

const FOURTH: Solution = ("problem 4", problem4::value, problem4::gradient);
const WAVES: Solution = ("waves", waves, slope_of_waves);
const FRONT: Solution = ("front", front, slope_of_front);

/// A front a twentieth wide, which coarse meshes do not resolve.
fn front(p: &Vector) -> f64 {
    (20.0 * (p.x + p.y * p.y - 0.8)).tanh()
}

fn slope_of_front(p: &Vector) -> Vector {
    Vector::new(1.0, 2.0 * p.y, 0.0) * 20.0 * (1.0 - front(p).powi(2))
}

fn at_points<const CORNERS: usize>(
    mesh: &SimplexMesh<CORNERS>,
    (_, value, gradient): Solution,
) -> (Vec<f64>, Vec<Vector>) {
    let points = mesh.points().iter();
    (points.clone().map(value).collect(), points.map(gradient).collect())
}

/// The mean and the greatest error, each relative to that by quadratic precision.
fn relative_errors(mesh: &TriangleMesh, field: Field, solution: Solution) -> [f64; 2] {
    let error = |pci: &Pci| errors_on_square(pci, solution.1);
    let (free, plain) =
        (error(&Pci::new(mesh, field)), error(&Pci::with_quadratic_precision(mesh, field)));
    [free[0] / plain[0], free[1] / plain[1]]
}

fn square(seed: u64, h: f64) -> TriangleMesh<'static> {
    Domain::rectangle("square", 1.0, 1.0).mesh(&mut Random(seed), h)
}

/// DESIGN: 7.9e-7 or better; quadratic precision makes 5.3e-6.
#[test]
fn the_grid_of_5000_points() {
    let mesh = grid(69);
    let (values, gradients) = at_points(&mesh, FOURTH);
    let field = Field { values: &values, gradients: &gradients };
    let [mean, greatest] = errors_on_square(&Pci::new(&mesh, field), FOURTH.1);
    let plain = errors_on_square(&Pci::with_quadratic_precision(&mesh, field), FOURTH.1);
    println!(
        "{mean:.2e}, at most {greatest:.2e}; quadratic precision {:.2e}, {:.2e}",
        plain[0], plain[1]
    );
    assert!(mean < 7.9e-7 && (5.2e-6..5.4e-6).contains(&plain[0]));
    assert!(greatest < 0.3 * plain[1]);
}

/// Of 20 meshes of each size; the gradients exact, and recovered.
#[test]
fn random_meshes_with_slivers_are_never_worse() {
    for count in [100, 500, 2000] {
        for solution in [FOURTH, WAVES, FRONT] {
            let mut found = Vec::new();
            for seed in 0..20 {
                let mesh = random_square(&mut Random(100 + seed), count);
                let (values, exact) = at_points(&mesh, solution);
                let recovered = recover_gradients(&mesh, &values, RecoveryDegree::Three);
                found.push([exact, recovered].map(|gradients| {
                    let field = Field { values: &values, gradients: &gradients };
                    relative_errors(&mesh, field, solution)
                }));
            }
            let worst = |k: usize, m: usize| found.iter().map(|f| f[k][m]).fold(0.0, f64::max);
            let mean = |k: usize| found.iter().map(|f| f[k][0]).sum::<f64>() / 20.0;
            println!(
                "{} on {count} points: mean {:.2}, worst {:.2}, greatest error {:.2}; \
                 recovered gradients {:.2}, {:.2}, {:.2}",
                solution.0,
                mean(0),
                worst(0, 0),
                worst(0, 1),
                mean(1),
                worst(1, 0),
                worst(1, 1)
            );
            assert!(worst(0, 0) < 1.05 && worst(1, 0) < 1.05);
            assert!(worst(0, 1) < 1.5 && worst(1, 1) < 1.5);
            assert!(mean(0) < 1.0 && mean(1) < 1.0);
        }
    }
}

/// Gradients of first order: means of those of the linear pieces.
#[test]
fn poor_gradients_do_no_harm() {
    for (mesh, most) in [(square(1, 0.04), 1.02), (grid(25), 1.05)] {
        for solution in [FOURTH, WAVES, FRONT] {
            let (values, _) = at_points(&mesh, solution);
            let gradients = mean_gradients(&mesh, &values);
            let field = Field { values: &values, gradients: &gradients };
            let [mean, greatest] = relative_errors(&mesh, field, solution);
            println!("{}: {mean:.3}, {greatest:.3}", solution.0);
            assert!(mean < most && greatest < 1.1);
        }
    }
}

fn mean_gradients(mesh: &TriangleMesh, values: &[f64]) -> Vec<Vector> {
    let mut sums = vec![(Vector::zeros(), 0.0); mesh.points().len()];
    for (triangle, points) in mesh.triangles().iter().enumerate() {
        let frame = mesh.frame(triangle);
        let slope = frame.gradient(&points.map(|point| values[point as usize]));
        let [a, b, c] = frame.corners();
        let area = (b - a).cross(&(c - a)).norm();
        for &point in points {
            sums[point as usize].0 += slope * area;
            sums[point as usize].1 += area;
        }
    }
    sums.into_iter().map(|(sum, area)| sum / area).collect()
}

#[test]
fn orders_on_meshes_of_quality() {
    const WIDTHS: [f64; 4] = [0.06, 0.04, 0.027, 0.018];
    let observed = |recovered: bool| {
        order(&WIDTHS.map(|h| {
            let mesh = square(2, h);
            let (values, mut gradients) = at_points(&mesh, WAVES);
            if recovered {
                gradients = recover_gradients(&mesh, &values, RecoveryDegree::Three);
            }
            let field = Field { values: &values, gradients: &gradients };
            (h, errors_on_square(&Pci::new(&mesh, field), WAVES.1)[0])
        }))
    };
    let [exact, recovered] = [observed(false), observed(true)];
    println!("orders: {exact:.2}, with recovered gradients {recovered:.2}");
    assert!(exact > 3.85 && recovered > 3.7);
}

/// On random meshes triangles do not keep their shape: at least the third order.
#[test]
fn orders_on_random_meshes() {
    const COUNTS: [usize; 3] = [500, 2000, 8000];
    let found = order(&COUNTS.map(|count| {
        let errors = (0..5).map(|seed| {
            let mesh = random_square(&mut Random(seed), count);
            let (values, gradients) = at_points(&mesh, WAVES);
            let field = Field { values: &values, gradients: &gradients };
            errors_on_square(&Pci::new(&mesh, field), WAVES.1)[0].ln()
        });
        ((count as f64).powf(-0.5), (errors.sum::<f64>() / 5.0).exp())
    }));
    println!("order {found:.2}");
    assert!(found > 3.0);
}

/// A plane mesh, turned and stretched in space.
fn in_space(mesh: &TriangleMesh, angles: [f64; 3], stretch: f64) -> TriangleMesh<'static> {
    let turn = Rotation3::from_euler_angles(angles[0], angles[1], angles[2]);
    let moved = mesh.points().iter().map(|p| turn * Vector::new(p.x, stretch * p.y, 0.0));
    TriangleMesh::new(moved.collect(), mesh.triangles().to_vec()).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(30))]

    /// On any mesh, in any plane, boundaries included.
    #[test]
    fn cubics_are_reproduced(
        seed in 0..1000_u64, angles in prop::array::uniform3(-3.0..3.0f64), power in -2.0..0.0f64,
    ) {
        let mut random = Random(seed);
        let flat = [random_square(&mut random, 60), square(seed, 0.15), grid(3)];
        for mesh in flat.map(|mesh| in_space(&mesh, angles, 10_f64.powf(power))) {
            let u = Polynomial::random(&mut random, 3);
            let values: Vec<f64> = mesh.points().iter().map(|p| u.value(p)).collect();
            let gradients: Vec<Vector> = mesh.points().iter().map(|p| u.gradient(p)).collect();
            let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
            for triangle in 0..mesh.triangles().len() {
                let at = [0.5, 0.3, 0.2];
                let exact = u.value(&mesh.position(triangle, &at));
                let error = (pci.cubic(triangle).value(&at) - exact).abs();
                prop_assert!(error < 1e-9, "triangle {}: {:.1e}", triangle, error);
            }
        }
    }

    /// Whatever the order of triangles and corners; also of data that contradict each other.
    #[test]
    fn the_order_of_nodes_does_not_matter(seed in 0..1000_u64) {
        let mut random = Random(seed);
        let mesh = random_square(&mut random, 60);
        let values: Vec<f64> = mesh.points().iter().map(|_| random.uniform(-1.0, 1.0)).collect();
        let gradients: Vec<Vector> =
            values.iter().map(|_| Vector::new(random.uniform(-1.0, 1.0), 0.3, 0.0)).collect();
        let count = mesh.triangles().len();
        let turned = (0..count).rev().map(|triangle| {
            let [a, b, c] = mesh.triangles()[triangle];
            [[a, b, c], [b, c, a], [c, a, b], [b, a, c]][triangle % 4]
        });
        let other = TriangleMesh::new(mesh.points().to_vec(), turned.collect()).unwrap();
        let field = Field { values: &values, gradients: &gradients };
        let (one, two) = (Pci::new(&mesh, field), Pci::new(&other, field));
        let centre = [1.0 / 3.0; 3];
        for triangle in 0..count {
            let found = two.cubic(count - 1 - triangle).value(&centre);
            prop_assert!((one.cubic(triangle).value(&centre) - found).abs() < 1e-9);
        }
    }
}

/// On a sphere there are no cubics, but nothing is lost: unfolded neighbours serve.
#[test]
fn curved_surfaces_gain_too() {
    let mesh = square(4, 0.05);
    let lifted = mesh.points().iter().map(|p| {
        let (x, y) = (p.x - 0.5, p.y - 0.5);
        Vector::new(x, y, (1.0 - x * x - y * y).sqrt())
    });
    let mesh = TriangleMesh::new(lifted.collect(), mesh.triangles().to_vec()).unwrap();
    let (values, gradients) = at_points(&mesh, WAVES);
    let field = Field { values: &values, gradients: &gradients };
    let error = |pci: &Pci| {
        let at = [1.0 / 3.0; 3];
        let error = |triangle: usize| {
            let foot = mesh.position(triangle, &at).normalize();
            (pci.cubic(triangle).value(&at) - waves(&foot)).abs()
        };
        (0..mesh.triangles().len()).map(error).sum::<f64>()
    };
    let relative =
        error(&Pci::new(&mesh, field)) / error(&Pci::with_quadratic_precision(&mesh, field));
    println!("relative error {relative:.3}");
    assert!(relative < 1.01);
}

/// How far a coefficient is from that of quadratic precision, and how far it may be: what the
/// nine others of the triangle or face differ by.
fn excess(coefficient: f64, plain: f64, others: impl Iterator<Item = f64> + Clone) -> f64 {
    let spread = others.clone().fold(f64::MIN, f64::max) - others.fold(f64::MAX, f64::min);
    (coefficient - plain).abs() - spread
}

/// Where they contradict each other, neighbours are not let draw hills.
#[test]
fn neighbours_say_no_more_than_the_data() {
    let mut random = Random(77);
    let (plane, solid) = (random_square(&mut random, 200), random_cube(&mut random, 200));
    let values: Vec<f64> = (0..300).map(|_| random.uniform(-1.0, 1.0)).collect();
    let gradients: Vec<Vector> =
        values.iter().map(|value| Vector::repeat(10_f64.powf(3.0 * value))).collect();
    let of = |count: usize| Field { values: &values[..count], gradients: &gradients[..count] };
    let field = of(plane.points().len());
    let (pci, plain) = (Pci::new(&plane, field), Pci::with_quadratic_precision(&plane, field));
    for triangle in 0..plane.triangles().len() {
        let (cubic, plain) = (pci.cubic(triangle), plain.cubic(triangle));
        let centre = TriangleCubic::CENTRE;
        let others = (0..10).filter(|&n| n != centre).map(|n| cubic.coefficients[n]);
        let excess = excess(cubic.coefficients[centre], plain.coefficients[centre], others);
        assert!(excess < 1e-9, "triangle {triangle}: {excess}");
    }
    let field = of(solid.points().len());
    let (tricubic, plain) =
        (Tricubic::new(&solid, field), Tricubic::with_quadratic_precision(&solid, field));
    for tetrahedron in 0..solid.tetrahedra().len() {
        let (cubic, plain) = (tricubic.cubic(tetrahedron), plain.cubic(tetrahedron));
        for (face, vertices) in
            TetrahedronCubic::FACES.into_iter().zip(TetrahedronCubic::FACE_VERTICES)
        {
            let edges = vertices.iter().flat_map(|&a| vertices.iter().map(move |&b| [a, b]));
            let edges =
                edges.filter(|[a, b]| a != b).flat_map(|edge| cubic.edge(edge).coefficients);
            let excess = excess(cubic.coefficients[face], plain.coefficients[face], edges);
            assert!(excess < 1e-9, "tetrahedron {tetrahedron}: {excess}");
        }
    }
}

/// A plateau beside a hill stays flat, and a wall on which the solution is zero has no value.
#[test]
fn what_is_constant_stays_constant() {
    let hill = |p: &Vector| (p.x - 0.4).max(0.0).powi(2);
    let slope_of_hill = |p: &Vector| Vector::x() * (2.0 * (p.x - 0.4).max(0.0));
    let mut random = Random(78);
    let plane = random_square(&mut random, 300);
    let (values, gradients) = at_points(&plane, ("hill", hill, slope_of_hill));
    let pci = Pci::new(&plane, Field { values: &values, gradients: &gradients });
    let is_flat = |points: &&[u32; 3]| points.iter().all(|&point| values[point as usize] == 0.0);
    assert!(plane.triangles().iter().filter(is_flat).count() > 100);
    for (triangle, points) in plane.triangles().iter().enumerate() {
        assert!(!is_flat(&points) || pci.cubic(triangle).coefficients == [0.0; 10]);
    }

    let solid = kuhn_grid(5);
    let wave = |p: &Vector| p.x * (3.0 * p.y + 4.0 * p.z).sin();
    let slope_of_wave = |p: &Vector| {
        let (sin, cos) = (3.0 * p.y + 4.0 * p.z).sin_cos();
        Vector::new(sin, 3.0 * p.x * cos, 4.0 * p.x * cos)
    };
    let (values, gradients) = at_points(&solid, ("wave", wave, slope_of_wave));
    let tricubic = Tricubic::new(&solid, Field { values: &values, gradients: &gradients });
    let mut walls = 0;
    for (tetrahedron, points) in solid.tetrahedra().iter().enumerate() {
        for (face, corners) in
            TetrahedronCubic::FACES.into_iter().zip(TetrahedronCubic::FACE_VERTICES)
        {
            if corners.iter().all(|&corner| solid.points()[points[corner] as usize].x == 0.0) {
                walls += 1;
                assert_eq!(tricubic.cubic(tetrahedron).coefficients[face], 0.0);
            }
        }
    }
    assert!(walls > 20, "{walls}");
}

#[test]
fn missing_values_do_not_spread() {
    let mesh = grid(6);
    let (mut values, gradients) = at_points(&mesh, FOURTH);
    values[24] = f64::NAN;
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    for (triangle, points) in mesh.triangles().iter().enumerate() {
        let finite = pci.cubic(triangle).coefficients.iter().all(|c| c.is_finite());
        assert_eq!(finite, !points.contains(&24));
    }
}

#[test]
fn the_same_bits_for_any_number_of_threads() {
    let mesh = random_square(&mut Random(8), 3000);
    let solid = random_cube(&mut Random(8), 800);
    let bits = |threads: usize| -> (Vec<u64>, Vec<u64>) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let (values, gradients) = at_points(&mesh, FRONT);
        let pci =
            pool.install(|| Pci::new(&mesh, Field { values: &values, gradients: &gradients }));
        let plane = (0..mesh.triangles().len()).flat_map(|t| pci.cubic(t).coefficients);
        let plane = plane.map(f64::to_bits).collect();
        let (values, gradients) = at_points(&solid, WAVES);
        let field = Field { values: &values, gradients: &gradients };
        let tricubic = pool.install(|| Tricubic::new(&solid, field));
        let space = (0..solid.tetrahedra().len()).flat_map(|t| tricubic.cubic(t).coefficients);
        (plane, space.map(f64::to_bits).collect())
    };
    let one = bits(1);
    assert!(one == bits(2) && one == bits(7));
}

#[test]
fn cubics_are_reproduced_in_space() {
    let mut random = Random(31);
    let delaunay = random_cube(&mut random, 200);
    let meshes =
        [kuhn_grid(3), graded_cube(&mut random, 200), shuffled(&mut random, &delaunay), delaunay];
    for mesh in &meshes {
        let u = Polynomial::random(&mut random, 3);
        let (values, gradients) = u.at_points(mesh);
        let tricubic = Tricubic::new(mesh, Field { values: &values, gradients: &gradients });
        let [_, greatest] = errors_in_tetrahedra(&tricubic, |p| u.value(p));
        println!("{greatest:.1e}");
        assert!(greatest < 1e-9);
    }
}

/// Of data that contradict each other, on meshes with boundaries.
#[test]
fn the_order_of_corners_changes_no_bit_in_space() {
    let mut random = Random(9);
    let mesh = random_cube(&mut random, 200);
    let other = shuffled(&mut random, &mesh);
    let values: Vec<f64> = mesh.points().iter().map(|_| random.uniform(-1.0, 1.0)).collect();
    let gradients: Vec<Vector> =
        values.iter().map(|_| Vector::repeat(random.uniform(-1.0, 1.0))).collect();
    let field = Field { values: &values, gradients: &gradients };
    let sorted = |mesh: &TetrahedronMesh| {
        let tricubic = Tricubic::new(mesh, field);
        let cells = mesh.tetrahedra().iter().enumerate();
        let mut cells: Vec<([u32; 4], [u64; 20])> = cells
            .map(|(tetrahedron, points)| {
                let mut points = *points;
                points.sort_unstable();
                let mut bits = tricubic.cubic(tetrahedron).coefficients.map(f64::to_bits);
                bits.sort_unstable();
                (points, bits)
            })
            .collect();
        cells.sort_unstable();
        cells
    };
    assert!(sorted(&mesh) == sorted(&other));
}

/// Exact gradients: never worse, on random meshes far better. Recovered ones: on average.
#[test]
fn tetrahedra_with_slivers_are_never_worse() {
    for problem in PROBLEMS {
        let mut found = Vec::new();
        for seed in 0..20 {
            let mesh = random_cube(&mut Random(100 + seed), 300);
            let (values, exact) = problem.at_points(&mesh);
            let recovered = recover_gradients(&mesh, &values, RecoveryDegree::Three);
            found.push([exact, recovered].map(|gradients| {
                let field = Field { values: &values, gradients: &gradients };
                let error = |tricubic: &Tricubic| errors_in_tetrahedra(tricubic, problem.value)[0];
                let plain = error(&Tricubic::with_quadratic_precision(&mesh, field));
                error(&Tricubic::new(&mesh, field)) / plain
            }));
        }
        let worst = [0, 1].map(|k| found.iter().map(|f| f[k]).fold(0.0, f64::max));
        let mean = [0, 1].map(|k| found.iter().map(|f| f[k]).sum::<f64>() / 20.0);
        println!("problem {}: mean {mean:.2?}, worst {worst:.2?}", problem.number);
        assert!(worst[0] < 1.0 && worst[1] < 1.05 && mean[0] < 0.8 && mean[1] < 0.95);
    }
}

#[test]
fn orders_in_space() {
    for problem in PROBLEMS {
        let found = order(&[8, 12, 18].map(|n| {
            let mesh = kuhn_grid(n);
            let (values, gradients) = problem.at_points(&mesh);
            let tricubic = Tricubic::new(&mesh, Field { values: &values, gradients: &gradients });
            (1.0 / n as f64, errors_in_tetrahedra(&tricubic, problem.value)[0])
        }));
        println!("problem {}: order {found:.2}", problem.number);
        assert!(found > 3.75);
    }
}

/// Alone, a cell reproduces quadratics, and does not fail.
#[test]
fn lone_cells_reproduce_quadratics() {
    let mesh = TriangleMesh::new(vec![Vector::zeros(), Vector::x(), Vector::y()], vec![[0, 1, 2]]);
    let mesh = mesh.unwrap();
    let (values, gradients) = at_points(&mesh, WAVES);
    let field = Field { values: &values, gradients: &gradients };
    assert_eq!(
        Pci::new(&mesh, field).cubic(0),
        Pci::with_quadratic_precision(&mesh, field).cubic(0)
    );
    let points = vec![Vector::zeros(), Vector::x(), Vector::y(), Vector::z()];
    let mesh = SimplexMesh::<4>::new(points, vec![[0, 1, 2, 3]]).unwrap();
    let (values, gradients) = at_points(&mesh, WAVES);
    let field = Field { values: &values, gradients: &gradients };
    let plain = Tricubic::with_quadratic_precision(&mesh, field);
    assert_eq!(Tricubic::new(&mesh, field).cubic(0), plain.cubic(0));
}
