//! Contour lines: exact, complete, joined, the same on any number of threads.

mod support;

use support::brute_force::{self, Components};
use support::distance::{distance_to_lines, sampled};
use support::meshes::{Random, grid, random_square};
use support::problem4;
use vtu2contour::bernstein::TriangleCubic;
use vtu2contour::contour::CellRanges;
use vtu2contour::contour::lines::{ContourLines, Method, Resolution, contour_lines};
use vtu2contour::field::Field;
use vtu2contour::interpolant::{Equation, Pci, Predictor, TriangleCubics};
use vtu2contour::mesh::{TriangleMesh, Vector, boundary_edges};
use vtu2contour::pde::Pde;

const METHODS: [Method; 4] = [Method::Intercept, Method::Sode, Method::Odea, Method::Aodea];
const COARSE: Resolution = Resolution { spacing: f64::INFINITY, tolerance: 1e-3 };

fn contour(interpolant: &dyn TriangleCubics, levels: &[f64], method: Method) -> ContourLines {
    contour_lines(interpolant, &CellRanges::new(interpolant), levels, method, COARSE)
}

fn components(lines: &ContourLines) -> Components {
    let closed = lines.lines.iter().filter(|line| line.closed).count();
    Components { all: lines.lines.len(), closed }
}

/// Random values and gradients, some so steep that a triangle holds many crossings
/// and islands.
fn random_field(random: &mut Random, points: usize) -> (Vec<f64>, Vec<Vector>) {
    let steepness = random.uniform(0.0, 30.0);
    let values = (0..points).map(|_| random.uniform(-1.0, 1.0)).collect();
    let gradients = (0..points)
        .map(|_| {
            let mut slope = || random.uniform(-steepness, steepness);
            Vector::new(slope(), slope(), 0.0)
        })
        .collect();
    (values, gradients)
}

/// Every line is closed or ends on the boundary; the ends of open lines lie there.
fn check_ends(lines: &ContourLines, mesh: &TriangleMesh) {
    let boundary = boundary_edges(mesh);
    for line in lines.lines.iter().filter(|line| !line.closed) {
        let points: Vec<_> = lines.line_points(line).collect();
        for end in [points[0], points[points.len() - 1]] {
            let near = boundary.iter().any(|&[a, b]| {
                let (a, b) = (mesh.points()[a as usize], mesh.points()[b as usize]);
                let t = (end.position - a).dot(&(b - a)) / (b - a).norm_squared();
                (a + (b - a) * t.clamp(0.0, 1.0) - end.position).norm() < 1e-12
            });
            assert!(near, "a line ends inside, at {}", end.position);
        }
    }
}

/// All points lie on their level, and no two neighbours coincide.
fn check_points(lines: &ContourLines, interpolant: &dyn TriangleCubics, range: f64) {
    for line in &lines.lines {
        let level = lines.levels[line.level];
        let points: Vec<_> = lines.line_points(line).collect();
        assert!(points.len() >= 2);
        for point in &points {
            let value = interpolant.cubic(point.cell as usize).value(&point.at);
            assert!((value - level).abs() < 1e-12 * range, "{value} is not {level}");
            let position = interpolant.mesh().position(point.cell as usize, &point.at);
            assert!((position - point.position).norm() < 1e-13);
        }
        assert!(points.windows(2).all(|pair| pair[0].position != pair[1].position));
        assert_eq!(line.closed, points[0].position == points[points.len() - 1].position);
    }
}

/// A level anywhere in a range, or, as often, close below its top, where there
/// are small islands.
fn random_level(random: &mut Random, low: f64, high: f64) -> f64 {
    if random.uniform(0.0, 1.0) < 0.5 {
        return random.uniform(low, high);
    }
    high - (high - low) * 10_f64.powf(random.uniform(-5.0, -1.0))
}

#[test]
fn nothing_is_missed_on_random_data() {
    let mut random = Random(1);
    let mut explained = 0;
    let mut found = Components { all: 0, closed: 0 };
    for case in 0..1000 {
        let mesh = random_square(&mut random, case % 12);
        let (values, gradients) = random_field(&mut random, mesh.points().len());
        let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
        let ranges = CellRanges::new(&pci);
        let [low, high] = ranges.attained(&pci).unwrap();
        let level = random_level(&mut random, low, high);
        let method = METHODS[case % 4];
        let lines = contour_lines(&pci, &ranges, &[level], method, COARSE);
        check_points(&lines, &pci, high - low);
        check_ends(&lines, &mesh);
        assert_eq!(lines.counts.unresolved, 0, "case {case}");
        let agrees = |n: &usize| components(&lines) == brute_force::components(&pci, level, *n);
        // what the reference's spacing hides, a finer reference must show
        let resolution = [64, 256, 1024, 4096].iter().find(|n| agrees(n));
        assert!(resolution.is_some(), "case {case}: {:?}", components(&lines));
        explained += usize::from(resolution != Some(&64));
        found.all += components(&lines).all;
        found.closed += components(&lines).closed;
    }
    println!("{found:?}; {explained} of 1000 cases needed a finer reference");
    assert!(found.closed > 500 && found.all > 1500 && explained < 100);
}

/// The interpolant of a function with its gradient.
fn nodal(
    mesh: &TriangleMesh,
    value: impl Fn(&Vector) -> f64,
    gradient: impl Fn(&Vector) -> Vector,
) -> (Vec<f64>, Vec<Vector>) {
    (mesh.points().iter().map(value).collect(), mesh.points().iter().map(gradient).collect())
}

fn lengths(lines: &ContourLines) -> Vec<f64> {
    let length = |line| {
        let points: Vec<_> = lines.line_points(line).map(|p| p.position).collect();
        points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum::<f64>()
    };
    lines.lines.iter().map(length).collect()
}

#[test]
fn a_level_through_nodes_and_along_edges() {
    // u = x on a grid, levels on its lines: one straight line each
    let mesh = grid(4);
    let (values, gradients) = nodal(&mesh, |p| p.x, |_| Vector::x());
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    for method in METHODS {
        let lines = contour(&pci, &[0.0, 0.25, 0.5, 0.75, 1.0], method);
        assert_eq!(lines.lines.len(), 5);
        for line in &lines.lines {
            let points: Vec<_> = lines.line_points(line).map(|p| p.position).collect();
            assert_eq!(points.len(), 5);
            assert!(points.iter().all(|p| p.x == lines.levels[line.level]));
        }
    }
}

#[test]
fn a_diagonal_level_through_nodes() {
    // u = x + y: the level 1 runs through nodes and across the squares
    let mesh = grid(4);
    let (values, gradients) = nodal(&mesh, |p| p.x + p.y, |_| Vector::new(1.0, 1.0, 0.0));
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    let lines = contour(&pci, &[0.0, 1.0, 2.0], Method::Aodea);
    // at 0 and 2 the contour is a corner: a point, not a line
    assert_eq!(lines.lines.len(), 1);
    assert_eq!(lines.lines[0].level, 1);
    assert!((lengths(&lines)[0] - 2_f64.sqrt()).abs() < 1e-14);
}

#[test]
fn ridges_and_valleys_along_edges_are_drawn_once() {
    for sign in [1.0, -1.0] {
        let mesh = grid(4);
        let square = |p: &Vector| sign * (p.x - 0.5).powi(2);
        let slope = |p: &Vector| Vector::new(2.0 * sign * (p.x - 0.5), 0.0, 0.0);
        let (values, gradients) = nodal(&mesh, square, slope);
        let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
        let lines = contour(&pci, &[0.0], Method::Aodea);
        assert_eq!(lengths(&lines), [1.0]);
        assert_eq!(lines.counts.unresolved, 0);
    }
}

#[test]
fn flat_cells_are_outlined_once() {
    // u = 0 up to x = 1/2, then a slope
    let mesh = grid(4);
    let ramp = |p: &Vector| (p.x - 0.5).max(0.0).powi(2);
    let slope = |p: &Vector| Vector::new(2.0 * (p.x - 0.5).max(0.0), 0.0, 0.0);
    let (values, gradients) = nodal(&mesh, ramp, slope);
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    assert_eq!(lengths(&contour(&pci, &[0.0], Method::Aodea)), [1.0]);
    // a constant solution has no line
    let flat = vec![3.0; values.len()];
    let none = vec![Vector::zeros(); values.len()];
    let pci = Pci::new(&mesh, Field { values: &flat, gradients: &none });
    assert!(contour(&pci, &[3.0], Method::Aodea).lines.is_empty());
}

#[test]
fn noise_on_the_level_is_the_level() {
    // sin(π x) sin(π y) is not quite zero at x = 1 and y = 1: 1e-16, or 1e-32
    let mesh = grid(6);
    let pi = std::f64::consts::PI;
    let value = |p: &Vector| (pi * p.x).sin() * (pi * p.y).sin();
    let gradient = |p: &Vector| {
        Vector::new((pi * p.x).cos() * (pi * p.y).sin(), (pi * p.x).sin() * (pi * p.y).cos(), 0.0)
            * pi
    };
    let (values, gradients) = nodal(&mesh, value, gradient);
    assert!(values.iter().any(|u| u.abs() > 0.0 && u.abs() < 1e-15));
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    let lines = contour(&pci, &[0.0], Method::Aodea);
    assert_eq!(lines.counts.unresolved, 0);
    assert_eq!(lines.lines.len(), 1);
    assert!(lines.lines[0].closed && (lengths(&lines)[0] - 4.0).abs() < 1e-12);
}

#[test]
fn a_nodal_line_ends_on_a_boundary_where_the_solution_is_zero() {
    // u = y (1 - y) (x - 0.3): zero at the bottom, at the top and on x = 0.3,
    // which meets both inside an edge
    let mesh = grid(4);
    let value = |p: &Vector| p.y * (1.0 - p.y) * (p.x - 0.3);
    let gradient =
        |p: &Vector| Vector::new(p.y * (1.0 - p.y), (1.0 - 2.0 * p.y) * (p.x - 0.3), 0.0);
    let (values, gradients) = nodal(&mesh, value, gradient);
    let pde = Pde::parse("uxx + uyy = -2*(x - 0.3)", &[], &[]).unwrap();
    let equation = Equation { pde: &pde, arrays: &[], predictor: Predictor::Quadratic };
    let field = Field { values: &values, gradients: &gradients };
    let pci = Pci::with_pde(&mesh, field, &equation);
    for method in METHODS {
        let lines = contour(&pci, &[0.0], method);
        let mut found = lengths(&lines);
        found.sort_by(f64::total_cmp);
        assert_eq!(found.len(), 3, "{found:?}");
        assert!(found.iter().all(|length| (length - 1.0).abs() < 1e-12), "{found:?}");
    }
}

#[test]
fn lines_that_cross_in_a_node_run_straight_on() {
    // u = (x - 1/2)² - (y - 1/2)²: two diagonals through the middle node
    let mesh = grid(2);
    let value = |p: &Vector| (p.x - 0.5).powi(2) - (p.y - 0.5).powi(2);
    let gradient = |p: &Vector| Vector::new(2.0 * p.x - 1.0, 1.0 - 2.0 * p.y, 0.0);
    let (values, gradients) = nodal(&mesh, value, gradient);
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    let lines = contour(&pci, &[0.0], Method::Aodea);
    assert_eq!(lines.lines.len(), 2);
    assert!(lengths(&lines).iter().all(|length| (length - 2_f64.sqrt()).abs() < 1e-12));
    // they share the point in which they cross
    let used = lines.connectivity.len();
    assert_eq!(lines.points.len(), used - 1);
}

#[test]
fn a_saddle_inside_a_cell_is_reported() {
    // the same cross, its middle inside a triangle: two branches that touch are
    // settled down to rounding and no further
    let mesh = grid(1);
    let value = |p: &Vector| (p.x - 0.7) * (p.y - 0.2);
    let gradient = |p: &Vector| Vector::new(p.y - 0.2, p.x - 0.7, 0.0);
    let (values, gradients) = nodal(&mesh, value, gradient);
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    let lines = contour(&pci, &[0.0], Method::Aodea);
    check_ends(&lines, &mesh);
    assert_eq!(lines.lines.len(), 2);
    assert!((lengths(&lines).iter().sum::<f64>() - 2.0).abs() < 1e-6);
    assert!(lines.counts.unresolved <= 12);
}

#[test]
fn a_double_curve_inside_cells_is_reported() {
    let mesh = grid(1);
    let square = |p: &Vector| (p.x - 0.3).powi(2);
    let slope = |p: &Vector| Vector::new(2.0 * (p.x - 0.3), 0.0, 0.0);
    let (values, gradients) = nodal(&mesh, square, slope);
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    let lines = contour(&pci, &[0.0], Method::Aodea);
    assert_eq!(lines.counts.touching, 2);
}

#[test]
fn missing_values_leave_their_cells_out() {
    let mesh = grid(4);
    let (mut values, gradients) = nodal(&mesh, |p| p.x, |_| Vector::x());
    values[12] = f64::NAN;
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    let lines = contour(&pci, &[0.3], Method::Aodea);
    assert_eq!(lines.counts.unusable, 6);
    assert_eq!(lines.lines.len(), 2);
}

#[test]
fn a_triangle_without_area_does_not_break_the_line() {
    let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 1.0], [1.0, -1.0]];
    let points = points.map(|[x, y]| Vector::new(x, y, 0.0)).to_vec();
    let triangles = vec![[0, 1, 3], [1, 2, 3], [0, 4, 2], [0, 2, 1]];
    let mesh = TriangleMesh::new(points, triangles).unwrap();
    let (values, gradients) = nodal(&mesh, |p| p.x, |_| Vector::x());
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    let lines = contour(&pci, &[0.7], Method::Aodea);
    assert_eq!(lines.lines.len(), 1);
    check_ends(&lines, &mesh);
}

#[test]
fn one_huge_value_harms_its_own_cells_only() {
    let mesh = grid(8);
    let (mut values, gradients) = nodal(&mesh, |p| p.x, |_| Vector::x());
    let corner = mesh.points().iter().position(|p| p.x == 1.0 && p.y == 1.0).unwrap();
    values[corner] = 1e20;
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    let lines = contour(&pci, &[0.3], Method::Aodea);
    assert!((lengths(&lines)[0] - 1.0).abs() < 1e-12);
}

#[test]
fn a_side_that_is_zero_twice() {
    // u = y² (4 x - 1), with its PDE: zero on y = 0, twice, and on x = 1/4
    let mesh = grid(1);
    let value = |p: &Vector| p.y * p.y * (4.0 * p.x - 1.0);
    let gradient = |p: &Vector| Vector::new(4.0 * p.y * p.y, 2.0 * p.y * (4.0 * p.x - 1.0), 0.0);
    let (values, gradients) = nodal(&mesh, value, gradient);
    let pde = Pde::parse("uxx + uyy = 2*(4*x - 1)", &[], &[]).unwrap();
    let equation = Equation { pde: &pde, arrays: &[], predictor: Predictor::Quadratic };
    let pci = Pci::with_pde(&mesh, Field { values: &values, gradients: &gradients }, &equation);
    for method in METHODS {
        let found = lengths(&contour(&pci, &[0.0], method));
        assert_eq!(found.len(), 2);
        assert!(found.iter().all(|length| (length - 1.0).abs() < 1e-12), "{found:?}");
    }
}

#[test]
fn tiny_and_huge_numbers_are_as_any_others() {
    // a circle, its values and its size scaled: as many points, and as soon
    let count = |values: f64, size: f64, offset: f64| {
        let plain = grid(8);
        let moved = |p: &Vector| Vector::new(p.x * size + offset, p.y * size + offset, 0.0);
        let points = plain.points().iter().map(moved).collect();
        let mesh = TriangleMesh::new(points, plain.triangles().to_vec()).unwrap();
        let from_middle = |p: &Vector| p - Vector::new(0.47, 0.53, 0.0);
        let (u, g) = nodal(
            &plain,
            |p| values * from_middle(p).norm_squared(),
            |p| from_middle(p) * (2.0 * values / size),
        );
        let pci = Pci::new(&mesh, Field { values: &u, gradients: &g });
        let resolution = Resolution { spacing: f64::INFINITY, tolerance: 1e-4 * size };
        let ranges = CellRanges::new(&pci);
        let lines = contour_lines(&pci, &ranges, &[0.1 * values], Method::Aodea, resolution);
        assert_eq!(components(&lines), Components { all: 1, closed: 1 });
        lines.points.len()
    };
    let usual = count(1.0, 1.0, 0.0);
    for (values, size, offset) in [
        (1e-170, 1.0, 0.0),
        (1e-300, 1.0, 0.0),
        (1e150, 1.0, 0.0),
        (1.0, 1e-9, 0.0),
        (1.0, 1e9, 0.0),
    ] {
        assert_eq!(count(values, size, offset), usual, "{values:e} {size:e}");
    }
    // far from the origin coordinates have few digits left, and points are fewer
    assert!(count(1.0, 1.0, 1e11) <= 2 * usual);
    // limits that are no numbers are no limits
    let mesh = grid(2);
    let (u, g) = nodal(&mesh, |p| p.x, |_| Vector::x());
    let pci = Pci::new(&mesh, Field { values: &u, gradients: &g });
    let resolution = Resolution { spacing: f64::NAN, tolerance: f64::NAN };
    let lines = contour_lines(&pci, &CellRanges::new(&pci), &[0.3], Method::Sode, resolution);
    assert_eq!(lines.points.len(), 5);
}

#[test]
fn lines_along_edges_have_the_higher_side_on_the_left() {
    for sign in [1.0, -1.0] {
        let mesh = grid(2);
        let (values, gradients) = nodal(&mesh, |p| sign * (p.x - 0.5), |_| Vector::x() * sign);
        let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
        let lines = contour(&pci, &[0.0], Method::Aodea);
        let points: Vec<_> = lines.line_points(&lines.lines[0]).map(|p| p.position).collect();
        assert!((points[2] - points[0]).y * sign < 0.0);
    }
}

#[test]
fn a_loop_that_begins_and_ends_in_a_node_is_drawn() {
    // a petal at the corner of one triangle
    struct Petal(TriangleMesh<'static>);
    impl TriangleCubics for Petal {
        fn mesh(&self) -> &TriangleMesh<'_> {
            &self.0
        }
        fn cubic(&self, _: usize) -> TriangleCubic {
            // 2 λ₀ λ₁ λ₂ - λ₀³ - λ₁³
            TriangleCubic::new([-1.0, 0.0, 0.0, 0.0, 1.0 / 3.0, 0.0, -1.0, 0.0, 0.0, 0.0])
        }
    }
    let points = vec![Vector::zeros(), Vector::x(), Vector::y()];
    let petal = Petal(TriangleMesh::new(points, vec![[0, 1, 2]]).unwrap());
    for method in METHODS {
        let lines = contour(&petal, &[0.0], method);
        assert_eq!(components(&lines), Components { all: 1, closed: 1 });
        assert!((lengths(&lines)[0] - petal_length()).abs() < 0.01);
        let line = &lines.lines[0];
        assert_eq!(lines.connectivity[line.points.start], lines.connectivity[line.points.end - 1]);
    }
}

/// The length of 2 λ₀ λ₁ λ₂ = λ₀³ + λ₁³, by its points on the rays λ₁ = s λ₀.
fn petal_length() -> f64 {
    let count = 10_000;
    let points: Vec<Vector> = (0..=count)
        .map(|n| {
            let s = (f64::from(n) / f64::from(count) * std::f64::consts::FRAC_PI_2).tan();
            let first = 2.0 * s / (1.0 + s * s * s + 2.0 * s * (1.0 + s));
            Vector::new(s * first, 1.0 - first - s * first, 0.0)
        })
        .filter(|point| point.x.is_finite())
        .collect();
    points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}

/// A cubic with random coefficients, its gradient, and a PDE that it solves.
struct RandomCubic([f64; 10]);

impl RandomCubic {
    fn new(random: &mut Random) -> Self {
        Self([(); 10].map(|()| random.uniform(-1.0, 1.0)))
    }

    fn value(&self, p: &Vector) -> f64 {
        let [a, b, c, d, e, f, g, h, i, j] = self.0;
        let (x, y) = (p.x, p.y);
        let cubic = g * x * x * x + h * x * x * y + i * x * y * y + j * y * y * y;
        a + b * x + c * y + d * x * x + e * x * y + f * y * y + cubic
    }

    fn gradient(&self, p: &Vector) -> Vector {
        let [_, b, c, d, e, f, g, h, i, j] = self.0;
        let (x, y) = (p.x, p.y);
        Vector::new(
            b + 2.0 * d * x + e * y + 3.0 * g * x * x + 2.0 * h * x * y + i * y * y,
            c + e * x + 2.0 * f * y + h * x * x + 2.0 * i * x * y + 3.0 * j * y * y,
            0.0,
        )
    }

    /// `(2 + x) uxx + 3 uyy + y uxy = …`
    fn pde(&self) -> Pde {
        let [_, _, _, d, e, f, g, h, i, j] = self.0;
        let xx = format!("({:e} + {:e}*x + {:e}*y)", 2.0 * d, 6.0 * g, 2.0 * h);
        let yy = format!("({:e} + {:e}*x + {:e}*y)", 2.0 * f, 2.0 * i, 6.0 * j);
        let xy = format!("({e:e} + {:e}*x + {:e}*y)", 2.0 * h, 2.0 * i);
        let text = format!("(2 + x)*uxx + 3*uyy + y*uxy = (2 + x)*{xx} + 3*{yy} + y*{xy}");
        Pde::parse(&text, &[], &[]).unwrap()
    }
}

#[test]
fn cubics_with_their_pde_are_exact() {
    let mut random = Random(2);
    for case in 0..100 {
        let mesh = random_square(&mut random, 20);
        let cubic = RandomCubic::new(&mut random);
        let (values, gradients) = nodal(&mesh, |p| cubic.value(p), |p| cubic.gradient(p));
        let pde = cubic.pde();
        let predictor = [Predictor::Quadratic, Predictor::Linear][case % 2];
        let equation = Equation { pde: &pde, arrays: &[], predictor };
        let field = Field { values: &values, gradients: &gradients };
        let pci = Pci::with_pde(&mesh, field, &equation);
        assert_eq!(pci.singular(), 0);
        let [low, high] = CellRanges::new(&pci).attained(&pci).unwrap();
        let levels: Vec<f64> = (1..6).map(|n| low + (high - low) * f64::from(n) / 6.0).collect();
        let lines = contour(&pci, &levels, METHODS[case % 4]);
        assert!(!lines.lines.is_empty());
        for line in &lines.lines {
            for point in lines.line_points(line) {
                let error = cubic.value(&point.position) - levels[line.level];
                assert!(error.abs() < 1e-12 * (high - low), "error {error:e}");
            }
        }
    }
}

#[test]
fn other_directions_of_the_same_mesh_give_the_same_contour() {
    // cells renumbered, their corners rotated, all points moved by an affine map
    let mut random = Random(3);
    for _ in 0..50 {
        let mesh = random_square(&mut random, 8);
        let (values, gradients) = random_field(&mut random, mesh.points().len());
        let map = nalgebra::Matrix3::new(2.0, 0.7, 0.0, -0.3, 0.5, 0.0, 0.2, 0.4, 1.0);
        let inverse_transposed = map.try_inverse().unwrap().transpose();
        let points: Vec<Vector> = mesh.points().iter().map(|p| map * p).collect();
        let turned: Vec<Vector> = gradients.iter().map(|g| inverse_transposed * g).collect();
        let triangles = mesh.triangles().iter().rev().map(|&[a, b, c]| [b, c, a]).collect();
        let other_mesh = TriangleMesh::new(points, triangles).unwrap();
        let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
        let other = Pci::new(&other_mesh, Field { values: &values, gradients: &turned });
        let levels = [-0.5, 0.1, 0.6];
        let (lines, moved) =
            (contour(&pci, &levels, Method::Aodea), contour(&other, &levels, Method::Aodea));
        assert_eq!(components(&lines), components(&moved));
        for line in &moved.lines {
            for point in moved.line_points(line) {
                let back = map.try_inverse().unwrap() * point.position;
                let cell = mesh.triangles().len() - 1 - point.cell as usize;
                let at = mesh.frame(cell).barycentric(&back);
                let error = pci.cubic(cell).value(&at) - moved.levels[line.level];
                assert!(error.abs() < 1e-11, "error {error:e}");
            }
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let mut random = Random(4);
    let mesh = random_square(&mut random, 2000);
    let (values, gradients) = problem4::at_points(&mesh);
    let on_threads = |count: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build().unwrap();
        pool.install(|| {
            let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
            contour(&pci, &[0.1, 0.5, 0.9, 1.3], Method::Aodea)
        })
    };
    let (one, two, five) = (on_threads(1), on_threads(2), on_threads(5));
    for other in [two, five] {
        assert_eq!(one.points, other.points);
        assert_eq!(one.connectivity, other.connectivity);
        assert_eq!(one.lines, other.lines);
        assert_eq!(one.curves, other.curves);
    }
}

#[test]
fn segments_are_as_near_and_as_short_as_asked() {
    let mesh = grid(12);
    let (values, gradients) = problem4::at_points(&mesh);
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    let ranges = CellRanges::new(&pci);
    for method in METHODS {
        for tolerance in [1e-3, 1e-5] {
            let resolution = Resolution { spacing: f64::INFINITY, tolerance };
            let lines = contour_lines(&pci, &ranges, &[0.2, 0.8], method, resolution);
            let worst = worst_distance(&lines, &pci);
            assert!(worst <= tolerance, "{method:?}: {worst:e} against {tolerance:e}");
        }
        let resolution = Resolution { spacing: 0.01, tolerance: f64::INFINITY };
        let lines = contour_lines(&pci, &ranges, &[0.2, 0.8], method, resolution);
        for line in &lines.lines {
            let points: Vec<_> = lines.line_points(line).map(|p| p.position).collect();
            assert!(points.windows(2).all(|pair| (pair[1] - pair[0]).norm() <= 0.01));
        }
    }
}

#[test]
fn no_part_of_the_contour_is_far_from_the_lines() {
    // narrow tongues too, in which points found across lie next to each other
    let mut random = Random(8);
    for case in 0..400 {
        let mesh = random_square(&mut random, case % 6);
        let (values, gradients) = random_field(&mut random, mesh.points().len());
        let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
        let ranges = CellRanges::new(&pci);
        let [low, high] = ranges.attained(&pci).unwrap();
        let level = random_level(&mut random, low, high);
        let lines = contour_lines(&pci, &ranges, &[level], METHODS[case % 4], COARSE);
        assert_eq!(lines.counts.coarse, 0);
        for point in sampled(&pci, level, 24) {
            let distance = distance_to_lines(&lines, &point);
            assert!(distance <= COARSE.tolerance, "case {case}: {distance:e} at {point}");
        }
    }
}

/// The greatest distance of a segment from the contour, by value over slope at 16
/// places of each.
fn worst_distance(lines: &ContourLines, pci: &Pci) -> f64 {
    let mut worst: f64 = 0.0;
    for line in &lines.lines {
        let cells = &lines.segment_cells[line.points.clone()];
        let points: Vec<_> = lines.line_points(line).map(|p| p.position).collect();
        for (pair, &cell) in points.windows(2).zip(cells) {
            let frame = pci.mesh().frame(cell as usize);
            let cubic = pci.cubic(cell as usize);
            for part in 1..16 {
                let position = pair[0] + (pair[1] - pair[0]) * (f64::from(part) / 16.0);
                let at = frame.barycentric(&position);
                let slope = frame.gradient(&cubic.barycentric_gradient(&at)).norm();
                worst = worst.max((cubic.value(&at) - lines.levels[line.level]).abs() / slope);
            }
        }
    }
    worst
}

#[test]
fn the_higher_side_is_on_the_left() {
    let mesh = grid(6);
    let (values, gradients) = problem4::at_points(&mesh);
    let pci = Pci::new(&mesh, Field { values: &values, gradients: &gradients });
    for method in METHODS {
        let lines = contour(&pci, &[0.3, 0.9], method);
        for line in &lines.lines {
            let cells = &lines.segment_cells[line.points.clone()];
            let points: Vec<_> = lines.line_points(line).collect();
            for (pair, &cell) in points.windows(2).zip(cells) {
                let along = pair[1].position - pair[0].position;
                let middle = (pair[0].position + pair[1].position) / 2.0;
                let frame = mesh.frame(cell as usize);
                let at = frame.barycentric(&middle);
                let uphill = frame.gradient(&pci.cubic(cell as usize).barycentric_gradient(&at));
                assert!(Vector::z().cross(&along).dot(&uphill) > 0.0);
            }
        }
    }
}
