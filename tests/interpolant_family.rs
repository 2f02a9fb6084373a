//! The family of interpolants: each reproduces its space, only some are continuous.

mod support;

use nalgebra::Rotation3;
use support::domains::Domain;
use support::meshes::{Random, grid, random_square};
use support::order::order;
use support::polynomial::Polynomial;
use support::problem4;
use support::problems_3d::{FIFTH, SIXTH};
use support::tetrahedra::{kuhn_grid, random_cube, shuffled};
use vtu2contour::field::Field;
use vtu2contour::interpolant::family::{
    CollocationPoints, Dei, DeiOptions, Shape, Space,
    spaces::{DEI, DEI3_13, DEI3_15, DEI4_15, FQI, P2, P2_HAT, P3, PCI, RECTANGLE},
};
use vtu2contour::interpolant::{Equation, Pci, Pieces, Predictor, Taylor};
use vtu2contour::mesh::{SimplexMesh, TetrahedronMesh, TriangleMesh, Vector};
use vtu2contour::pde::{Pde, Sample};

/// As in the thesis: no piece is left out.
const ALL: DeiOptions = DeiOptions { points: CollocationPoints::Chosen, limit: f64::INFINITY };

fn parse(text: &str) -> Pde {
    Pde::parse(text, &[], &[]).unwrap()
}

fn equation(pde: &Pde) -> Equation<'_> {
    Equation { pde, arrays: &[], predictor: Predictor::Quadratic }
}

fn triangles(seed: u64) -> TriangleMesh<'static> {
    Domain::rectangle("square", 1.0, 1.0).mesh(&mut Random(seed), 0.2)
}

/// A grid of tetrahedra, turned such that no edge is along an axis, its points moved.
fn tetrahedra(random: &mut Random) -> TetrahedronMesh<'static> {
    let grid = kuhn_grid(3);
    let turn = Rotation3::from_euler_angles(0.3, 0.4, 0.5);
    let moved = |p: &Vector| turn * p + Vector::from([(); 3].map(|()| random.uniform(-0.05, 0.05)));
    let points = grid.points().iter().map(moved).collect();
    TetrahedronMesh::new(points, grid.tetrahedra().to_vec()).unwrap()
}

/// The unit square as rectangles, its corners in turn, wider to the right.
fn rectangles() -> SimplexMesh<'static, 4> {
    let at = |k: u32| f64::from(k * k) / 16.0;
    let points = (0..5).flat_map(|j| (0..5).map(move |i| Vector::new(at(i), at(j) / 2.0, 0.0)));
    let corners = (0..4).flat_map(|j| (0..4).map(move |i| 5 * j + i));
    let quads = corners.map(|p| [p, p + 1, p + 6, p + 5]).collect();
    SimplexMesh::new(points.collect(), quads).unwrap()
}

/// A random place of a cell.
fn place<const CORNERS: usize>(random: &mut Random, shape: Shape) -> [f64; CORNERS] {
    if shape == Shape::Rectangle {
        let (s, t) = (random.uniform(0.0, 1.0), random.uniform(0.0, 1.0));
        let weights = [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t];
        return std::array::from_fn(|corner| weights[corner]);
    }
    let weights = [(); CORNERS].map(|()| random.uniform(0.01, 1.0));
    weights.map(|weight| weight / weights.iter().sum::<f64>())
}

/// A polynomial of the space that satisfies the PDE is the interpolant, to rounding.
fn check_reproduces<const CORNERS: usize, const N: usize>(
    space: Space<CORNERS, N>,
    mesh: &SimplexMesh<CORNERS>,
    operator: &str,
    points: CollocationPoints,
    close: f64,
) {
    let mut random = Random(5);
    let (each, total) = (i32::from(space.each), i32::from(space.total));
    let dimension = space.shape.dimension();
    let exact = Polynomial::with_powers(&mut random, each, total, dimension as u32);
    let pde = parse(&format!("{operator} = {}", exact.operator_text(operator)));
    let (values, gradients) = exact.at_points(mesh);
    let field = Field { values: &values, gradients: &gradients };
    let options = DeiOptions { points, ..ALL };
    let dei = Dei::new(space, mesh, field, &equation(&pde), &options);
    assert_eq!(dei.singular(), 0, "{}", space.name);
    let mut errors = Vec::new();
    for cell in 0..mesh.simplices().len() {
        let at = place(&mut random, space.shape);
        let (found, position) = (dei.taylor(cell, &at), mesh.position(cell, &at));
        errors.push((found.value - exact.value(&position)).abs());
        errors.push((found.gradient - exact.gradient(&position)).norm() / 100.0);
    }
    let worst = errors.iter().fold(0.0, |worst: f64, error| worst.max(*error));
    assert!(worst < close, "{}: {worst:e}", space.name);
}

const LAPLACIAN: &str = "uxx + uyy";
const OTHER: &str = "(2 + x)*uxx + uyy/2 - uxy/3";

#[test]
fn plane_spaces_are_reproduced() {
    let mesh = triangles(1);
    for operator in [LAPLACIAN, OTHER] {
        for points in [CollocationPoints::Chosen, CollocationPoints::Searched { seed: 3 }] {
            check_reproduces(PCI, &mesh, operator, points, 1e-12);
            check_reproduces(DEI3_13, &mesh, operator, points, 1e-9);
            check_reproduces(DEI3_15, &mesh, operator, points, 1e-9);
            check_reproduces(DEI, &mesh, operator, points, 1e-9);
            check_reproduces(DEI4_15, &mesh, operator, points, 1e-9);
            check_reproduces(FQI, &mesh, operator, points, 1e-7);
            check_reproduces(RECTANGLE, &rectangles(), operator, points, 1e-9);
        }
    }
}

#[test]
fn spaces_in_space_are_reproduced() {
    let mesh = tetrahedra(&mut Random(2));
    let random = CollocationPoints::Searched { seed: 4 };
    for operator in ["uxx + uyy + uzz", "(2 + x)*uxx + uyy/2 + 3*uzz - uxy/3 + uyz"] {
        for points in [CollocationPoints::Chosen, random] {
            check_reproduces(P3, &mesh, operator, points, 1e-9);
            check_reproduces(P2, &mesh, operator, points, 1e-7);
            check_reproduces(P2_HAT, &mesh, operator, points, 1e-9);
        }
    }
}

/// `L p = g` at the points of the space, in every cell.
fn check_collocates<const CORNERS: usize, const N: usize>(
    space: Space<CORNERS, N>,
    mesh: &SimplexMesh<CORNERS>,
) {
    let pde = parse("uxx + (2 + y)*uyy + uzz + uxy/2 = x*y - z");
    let values: Vec<f64> = mesh.points().iter().map(|p| (3.0 * p.x).sin() + p.y * p.z).collect();
    let gradients = vec![Vector::new(1.0, 0.5, 0.2); values.len()];
    let field = Field { values: &values, gradients: &gradients };
    let dei = Dei::new(space, mesh, field, &equation(&pde), &ALL);
    assert_eq!(dei.singular(), 0, "{}", space.name);
    for cell in 0..mesh.simplices().len() {
        for at in space.collocation_points() {
            let position = mesh.position(cell, &at);
            let h = dei.taylor(cell, &at).hessian;
            let terms = [h[(0, 0)], (2.0 + position.y) * h[(1, 1)], h[(2, 2)], h[(0, 1)] / 2.0];
            let sample = Sample { x: position.into(), ..Sample::default() };
            let defect = terms.iter().sum::<f64>() - pde.right_hand_side(&sample);
            assert!(defect.abs() < 1e-9 * (1.0 + h.norm()), "{}: {defect:e}", space.name);
        }
    }
}

#[test]
fn the_pde_holds_at_the_points_of_the_space() {
    let (plane, solid) = (triangles(14), tetrahedra(&mut Random(15)));
    check_collocates(PCI, &plane);
    check_collocates(DEI3_13, &plane);
    check_collocates(DEI4_15, &plane);
    check_collocates(DEI, &plane);
    check_collocates(RECTANGLE, &rectangles());
    check_collocates(P3, &solid);
    check_collocates(P2, &solid);
    check_collocates(P2_HAT, &solid);
}

/// Mean error at random places.
fn error<const CORNERS: usize>(
    pieces: &dyn Pieces<CORNERS>,
    shape: Shape,
    exact: impl Fn(&Vector) -> f64,
) -> f64 {
    let mut random = Random(16);
    let mesh = pieces.mesh();
    let errors = (0..mesh.simplices().len()).map(|cell| {
        let at = place(&mut random, shape);
        (pieces.taylor(cell, &at).value - exact(&mesh.position(cell, &at))).abs()
    });
    errors.sum::<f64>() / mesh.simplices().len() as f64
}

#[test]
fn orders_of_accuracy() {
    let pde = parse(problem4::PDE);
    let plane = |space: &dyn Fn(&TriangleMesh, Field) -> f64| {
        order(&[16, 24, 32, 48].map(|n| {
            let mesh = grid(n);
            let (values, gradients) = problem4::at_points(&mesh);
            (1.0 / n as f64, space(&mesh, Field { values: &values, gradients: &gradients }))
        }))
    };
    macro_rules! plane {
        ($space:expr) => {
            plane(&|mesh, field| {
                let dei = Dei::new($space, mesh, field, &equation(&pde), &ALL);
                error(&dei, Shape::Triangle, problem4::value)
            })
        };
    }
    let pde = parse(FIFTH.pde);
    let p3 = order(&[3, 4, 6, 8].map(|n| {
        let mesh = kuhn_grid(n);
        let (values, gradients) = FIFTH.at_points(&mesh);
        let field = Field { values: &values, gradients: &gradients };
        let dei = Dei::new(P3, &mesh, field, &equation(&pde), &ALL);
        (1.0 / n as f64, error(&dei, Shape::Tetrahedron, FIFTH.value))
    }));
    let found = [plane!(PCI), plane!(DEI3_13), plane!(DEI), plane!(DEI4_15), p3];
    println!("orders of PCI, DEI3-13, DEI, DEI4-15 and p3: {found:.2?}");
    for order in found {
        assert!(order > 3.7, "{found:.2?}");
    }
}

/// The family's PCI is the interpolant that contours read.
#[test]
fn pci_is_pci() {
    let mesh = triangles(3);
    let (values, gradients) = problem4::at_points(&mesh);
    let field = Field { values: &values, gradients: &gradients };
    let pde = parse(problem4::PDE);
    let linear = Equation { predictor: Predictor::Linear, ..equation(&pde) };
    let space = Dei::new(PCI, &mesh, field, &linear, &ALL);
    let pci = Pci::with_pde(&mesh, field, &linear);
    let mut random = Random(4);
    for triangle in 0..mesh.triangles().len() {
        let at = place(&mut random, Shape::Triangle);
        let (one, other) = (space.taylor(triangle, &at), pci.taylor(triangle, &at));
        assert!((one.value - other.value).abs() < 1e-12);
        assert!((one.gradient - other.gradient).norm() < 1e-10);
        assert!((one.hessian - other.hessian).norm() < 1e-8);
    }
}

/// First and second derivatives are those of the values, by differences.
fn check_derivatives<const CORNERS: usize>(pieces: &dyn Pieces<CORNERS>, shape: Shape, close: f64) {
    let mut random = Random(6);
    for cell in 0..pieces.mesh().simplices().len() {
        let [from, to] = [(); 2].map(|()| place::<CORNERS>(&mut random, shape));
        // weights on a straight line in the cell, which a rectangle's are along a side only
        let (from, to) = if shape == Shape::Rectangle {
            let [s, t] = [from[1] + from[2], to[1] + to[2]];
            ([1.0 - s, s, 0.0, 0.0], [1.0 - t, t, 0.0, 0.0])
        } else {
            let four = |at: [f64; CORNERS]| std::array::from_fn(|n| *at.get(n).unwrap_or(&0.0));
            (four(from), four(to))
        };
        let on_line = |x: f64| -> [f64; CORNERS] {
            std::array::from_fn(|corner| from[corner] * (1.0 - x) + to[corner] * x)
        };
        let along = |x: f64| pieces.taylor(cell, &on_line(x));
        let mesh = pieces.mesh();
        let direction = mesh.position(cell, &on_line(1.0)) - mesh.position(cell, &on_line(0.0));
        let step = 1e-3;
        let [before, here, after] = [0.5 - step, 0.5, 0.5 + step].map(along);
        let slope = (after.value - before.value) / (2.0 * step);
        let bend = (after.gradient - before.gradient) / (2.0 * step);
        assert!((slope - here.gradient.dot(&direction)).abs() < close * slope.abs().max(1.0));
        let expected = here.hessian * direction;
        assert!((bend - expected).norm() < close * expected.norm().max(1.0));
    }
}

#[test]
fn derivatives_are_slopes() {
    let mesh = triangles(5);
    let (values, gradients) = problem4::at_points(&mesh);
    let field = Field { values: &values, gradients: &gradients };
    let pde = parse(problem4::PDE);
    let equation = equation(&pde);
    check_derivatives(&Dei::new(PCI, &mesh, field, &equation, &ALL), Shape::Triangle, 1e-5);
    check_derivatives(&Dei::new(DEI, &mesh, field, &equation, &ALL), Shape::Triangle, 1e-4);
    check_derivatives(&Dei::new(FQI, &mesh, field, &equation, &ALL), Shape::Triangle, 1e-4);
    check_derivatives(&Pci::with_pde(&mesh, field, &equation), Shape::Triangle, 1e-5);
    let quads = rectangles();
    let values: Vec<f64> = quads.points().iter().map(problem4::value).collect();
    let gradients: Vec<Vector> = quads.points().iter().map(problem4::gradient).collect();
    let field = Field { values: &values, gradients: &gradients };
    check_derivatives(&Dei::new(RECTANGLE, &quads, field, &equation, &ALL), Shape::Rectangle, 1e-4);
}

#[test]
fn derivatives_are_slopes_in_space() {
    let mesh = tetrahedra(&mut Random(7));
    let (values, gradients) = SIXTH.at_points(&mesh);
    let field = Field { values: &values, gradients: &gradients };
    let pde = parse(SIXTH.pde);
    let equation = equation(&pde);
    check_derivatives(&Dei::new(P3, &mesh, field, &equation, &ALL), Shape::Tetrahedron, 1e-4);
    check_derivatives(&Dei::new(P2, &mesh, field, &equation, &ALL), Shape::Tetrahedron, 1e-4);
}

/// Jumps at random points of the common sides (of `SIDE` corners) of all pairs of cells,
/// in ascending order.
fn jumps<const CORNERS: usize, const SIDE: usize>(pieces: &dyn Pieces<CORNERS>) -> Vec<f64> {
    let mut random = Random(8);
    let cells = pieces.mesh().simplices();
    let mut jumps = Vec::new();
    for (one, first) in cells.iter().enumerate() {
        for (other, second) in cells.iter().enumerate().skip(one + 1) {
            let common: Vec<u32> = first.iter().filter(|p| second.contains(p)).copied().collect();
            if common.len() != SIDE {
                continue;
            }
            let weights: [f64; SIDE] = place(&mut random, Shape::Triangle);
            let at = |points: &[u32; CORNERS]| {
                points.map(|p| common.iter().position(|q| *q == p).map_or(0.0, |n| weights[n]))
            };
            let values = [(one, first), (other, second)]
                .map(|(cell, points)| pieces.taylor(cell, &at(points)).value);
            jumps.push((values[0] - values[1]).abs());
        }
    }
    jumps.sort_by(f64::total_cmp);
    jumps
}

fn check_jumps<const CORNERS: usize, const SIDE: usize>(
    pieces: &dyn Pieces<CORNERS>,
    continuous: bool,
) {
    let jumps = jumps::<CORNERS, SIDE>(pieces);
    assert!(jumps.len() > 20);
    let (median, greatest) = (jumps[jumps.len() / 2], jumps[jumps.len() - 1]);
    assert_eq!(greatest < 1e-11, continuous, "{greatest:e}");
    assert!(continuous || median > 1e-7, "{median:e}");
}

#[test]
fn only_the_pure_cubic_and_rectangles_are_continuous() {
    let mesh = triangles(9);
    let (values, gradients) = problem4::at_points(&mesh);
    let field = Field { values: &values, gradients: &gradients };
    let pde = parse(problem4::PDE);
    let equation = equation(&pde);
    check_jumps::<3, 2>(&Dei::new(PCI, &mesh, field, &equation, &ALL), true);
    check_jumps::<3, 2>(&Pci::with_pde(&mesh, field, &equation), true);
    check_jumps::<3, 2>(&Dei::new(DEI3_13, &mesh, field, &equation, &ALL), false);
    check_jumps::<3, 2>(&Dei::new(DEI3_15, &mesh, field, &equation, &ALL), false);
    check_jumps::<3, 2>(&Dei::new(DEI, &mesh, field, &equation, &ALL), false);
    check_jumps::<3, 2>(&Dei::new(DEI4_15, &mesh, field, &equation, &ALL), false);
    check_jumps::<3, 2>(&Dei::new(FQI, &mesh, field, &equation, &ALL), false);
    let quads = rectangles();
    let values: Vec<f64> = quads.points().iter().map(problem4::value).collect();
    let gradients: Vec<Vector> = quads.points().iter().map(problem4::gradient).collect();
    let field = Field { values: &values, gradients: &gradients };
    check_jumps::<4, 2>(&Dei::new(RECTANGLE, &quads, field, &equation, &ALL), true);
}

#[test]
fn in_space_none_is_continuous_but_p3_on_edges() {
    let mesh = tetrahedra(&mut Random(10));
    let (values, gradients) = SIXTH.at_points(&mesh);
    let field = Field { values: &values, gradients: &gradients };
    let pde = parse(SIXTH.pde);
    let equation = equation(&pde);
    let p3 = Dei::new(P3, &mesh, field, &equation, &ALL);
    check_jumps::<4, 3>(&p3, false);
    check_jumps::<4, 2>(&p3, true);
    check_jumps::<4, 3>(&Dei::new(P2, &mesh, field, &equation, &ALL), false);
    check_jumps::<4, 3>(&Dei::new(P2_HAT, &mesh, field, &equation, &ALL), false);
}

/// What is not determined is counted, and a polynomial that reproduces quadratics and has
/// the values at the corners stands in.
#[test]
fn singular_cells_are_counted_and_still_quadratic() {
    let mesh = random_square(&mut Random(11), 50);
    let mut random = Random(12);
    let exact = Polynomial::with_powers(&mut random, 2, 2, 2);
    let (values, gradients) = exact.at_points(&mesh);
    let field = Field { values: &values, gradients: &gradients };
    let count = mesh.triangles().len();
    let not_finite = parse("uxx + uyy = 1/(x - x)");
    let right = parse(&format!("{LAPLACIAN} = {}", exact.operator_text(LAPLACIAN)));
    let none = DeiOptions { limit: 0.0, ..DeiOptions::default() };
    for dei in [
        Dei::new(DEI, &mesh, field, &equation(&not_finite), &DeiOptions::default()),
        Dei::new(DEI, &mesh, field, &equation(&right), &none),
    ] {
        assert_eq!(dei.singular(), count);
        for triangle in 0..count {
            let at = place(&mut random, Shape::Triangle);
            let (found, position) = (dei.taylor(triangle, &at), mesh.position(triangle, &at));
            assert!((found.value - exact.value(&position)).abs() < 1e-12);
            assert!((found.gradient - exact.gradient(&position)).norm() < 1e-9);
        }
    }
}

/// Cells without size, and quads that are no rectangles, are counted.
#[test]
fn cells_of_another_shape_are_counted() {
    let points = [[0.0, 0.0], [1.0, 0.0], [1.2, 1.0], [0.0, 1.0], [0.5, 0.0]];
    let points = points.map(|[x, y]| Vector::new(x, y, 0.0)).to_vec();
    let values = [1.0, 2.0, 3.0, 4.0, 5.0];
    let field = Field { values: &values, gradients: &[Vector::x(); 5] };
    let pde = parse("uxx + uyy = 0");
    let quads = SimplexMesh::new(points.clone(), vec![[0, 1, 2, 3]]).unwrap();
    let skew = Dei::new(RECTANGLE, &quads, field, &equation(&pde), &DeiOptions::default());
    assert_eq!(skew.singular(), 1);
    assert_eq!(skew.taylor(0, &[0.25; 4]).value, 2.5);
    let flat = TriangleMesh::new(points, vec![[0, 4, 1]]).unwrap();
    let flat = Dei::new(DEI, &flat, field, &equation(&pde), &DeiOptions::default());
    assert_eq!(flat.singular(), 1);
    let expected = Taylor { value: 5.0, ..Taylor::default() };
    assert_eq!(flat.taylor(0, &[0.0, 1.0, 0.0]), expected);
}

/// Triquadratics have three coefficients on an edge along an axis, but four data.
#[test]
fn triquadratics_are_singular_on_edges_along_axes() {
    let mesh = kuhn_grid(2);
    let (values, gradients) = SIXTH.at_points(&mesh);
    let field = Field { values: &values, gradients: &gradients };
    let pde = parse(SIXTH.pde);
    let equation = equation(&pde);
    let all = mesh.tetrahedra().len();
    assert_eq!(Dei::new(P2, &mesh, field, &equation, &ALL).singular(), all);
    assert_eq!(Dei::new(P2_HAT, &mesh, field, &equation, &ALL).singular(), all);
    assert_eq!(Dei::new(P3, &mesh, field, &equation, &ALL).singular(), 0);
}

/// The chosen points do not depend on the order of a cell's corners.
#[test]
fn the_order_of_corners_does_not_matter() {
    let mut random = Random(13);
    let mesh = random_cube(&mut random, 60);
    let other = shuffled(&mut random, &mesh);
    let (values, gradients) = SIXTH.at_points(&mesh);
    let field = Field { values: &values, gradients: &gradients };
    let pde = parse(SIXTH.pde);
    let (one, two) = (
        Dei::new(P2, &mesh, field, &equation(&pde), &DeiOptions::default()),
        Dei::new(P2, &other, field, &equation(&pde), &DeiOptions::default()),
    );
    assert_eq!(one.singular(), two.singular());
    for (cell, points) in mesh.tetrahedra().iter().enumerate() {
        let holds = |corners: &&[u32; 4]| corners.iter().all(|corner| points.contains(corner));
        let there = other.tetrahedra().iter().position(|corners| holds(&corners)).unwrap();
        let at = [0.1, 0.2, 0.3, 0.4];
        let moved =
            other.tetrahedra()[there].map(|p| at[points.iter().position(|q| *q == p).unwrap()]);
        let (a, b) = (one.taylor(cell, &at).value, two.taylor(there, &moved).value);
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
}
