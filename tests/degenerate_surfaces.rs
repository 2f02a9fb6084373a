//! Surfaces at a level that is the value of whole edges, faces and cells: closed as any others.

mod support;

use rayon::prelude::*;
use support::meshes::Random;
use support::surfaces::{area, check_even};
use support::tetrahedra::{kuhn_grid, random_cube, renumbered};
use vtu2contour::contour::CellRanges;
use vtu2contour::contour::surface::{ContourSurface, Fineness, contour_surface};
use vtu2contour::field::Field;
use vtu2contour::interpolant::{Linear, TetrahedronCubics, Tricubic};
use vtu2contour::mesh::{TetrahedronMesh, Vector};

const FINENESSES: [Fineness; 4] = [
    Fineness::PointsPerSide(2),
    Fineness::PointsPerSide(3),
    Fineness::PointsPerSide(4),
    Fineness::Tolerance(1e-2),
];

/// A mesh, and values and gradients at its points.
struct Solution {
    mesh: TetrahedronMesh<'static>,
    values: Vec<f64>,
    gradients: Vec<Vector>,
}

impl Solution {
    fn of(mesh: TetrahedronMesh<'static>, data: impl FnMut(&Vector) -> (f64, Vector)) -> Self {
        let (values, gradients) = mesh.points().iter().map(data).unzip();
        Self { mesh, values, gradients }
    }

    fn cubic(&self) -> Tricubic<'_> {
        Tricubic::new(&self.mesh, Field { values: &self.values, gradients: &self.gradients })
    }

    fn linear(&self) -> Linear<'_, 4> {
        Linear::new(&self.mesh, &self.values)
    }
}

fn at_zero(f: &dyn TetrahedronCubics, fineness: Fineness) -> ContourSurface {
    contour_surface(f, &CellRanges::of_tetrahedra(f), &[0.0], fineness)
}

/// The tri-cubic of a number of solutions, and the linear interpolant of many more.
fn check_all(name: &str, cubics: u64, solution: impl Fn(&mut Random) -> Solution + Sync) {
    (0..200_u64).into_par_iter().for_each(|seed| {
        let solution = solution(&mut Random(seed));
        for fineness in FINENESSES {
            let name = format!("{name} {seed} {fineness:?}");
            check_even(&at_zero(&solution.linear(), fineness), &format!("{name}, linear"));
            if seed < cubics {
                check_even(&at_zero(&solution.cubic(), fineness), &name);
            }
        }
    });
}

/// One of -1, 0 and 1.
fn whole(random: &mut Random) -> f64 {
    random.uniform(-1.0, 2.0).floor()
}

fn direction(random: &mut Random) -> Vector {
    Vector::from([(); 3].map(|()| random.uniform(-1.0, 1.0))).normalize()
}

/// A grid of which every second has its points moved.
fn grid(random: &mut Random, n: usize) -> TetrahedronMesh<'static> {
    let amount = 0.04 * random.uniform(0.0, 2.0).floor();
    renumbered(random, &kuhn_grid(n), amount)
}

/// ± max(d·p - c, 0)²: a plateau that fills half of the cube.
#[test]
fn plateaus_are_closed() {
    check_all("plateau", 4, |random| {
        let mesh = grid(random, 3);
        let (along, from) = (direction(random), random.uniform(-0.5, 1.0));
        let side = random.uniform(0.0, 2.0).floor() - 0.5;
        Solution::of(mesh, |p| {
            let rise = (along.dot(p) - from).max(0.0);
            (side * rise * rise, along * (2.0 * side * rise))
        })
    });
}

/// A step: a plateau between what is above and what is below.
#[test]
fn steps_are_closed() {
    check_all("step", 1, |random| {
        let mesh = grid(random, 3);
        let (along, from) = (direction(random), random.uniform(-0.5, 0.7));
        Solution::of(mesh, |p| {
            let rise = along.dot(p) - from;
            let (up, down) = ((rise - 0.4).max(0.0), (-rise).max(0.0));
            (up * up - down * down, along * (2.0 * (up + down)))
        })
    });
}

/// (y - x)² (x + y - c): the level is touched in a plane of faces, and crossed in another one.
#[test]
fn double_planes_are_closed() {
    check_all("double plane", 1, |random| {
        let mesh = renumbered(random, &kuhn_grid(2), 0.0);
        let from = [0.5, 0.3, 1.0, 0.75][random.uniform(0.0, 4.0) as usize];
        Solution::of(mesh, |p| {
            let (a, b) = (p.y - p.x, p.x + p.y - from);
            let (of_a, of_b) = (Vector::new(-1.0, 1.0, 0.0), Vector::new(1.0, 1.0, 0.0));
            (a * a * b, of_a * (2.0 * a * b) + of_b * (a * a))
        })
    });
}

/// Values and gradients of -1, 0 and 1, many of them zero: all that lies on a level by chance.
#[test]
fn whole_numbers_are_closed() {
    check_all("whole numbers", 4, |random| {
        let points = 8 + random.uniform(0.0, 8.0) as usize;
        let mesh = match random.uniform(0.0, 2.0) as usize {
            0 => grid(random, 2),
            _ => random_cube(random, points),
        };
        let zeros = random.uniform(0.0, 0.8);
        let number = |random: &mut Random| {
            let is_zero = random.uniform(0.0, 1.0) < zeros;
            if is_zero { 0.0 } else { whole(random) }
        };
        Solution::of(mesh, |_| {
            let value = number(random);
            let is_flat = random.uniform(0.0, 1.0) < zeros;
            let slope = |_| if is_flat { 0.0 } else { whole(random) };
            (value, Vector::from([0, 1, 2].map(slope)))
        })
    });
}

/// Numbers of parts: plateaus in the form of voxels.
#[test]
fn parts_are_closed() {
    check_all("parts", 4, |random| {
        let mesh = grid(random, 3);
        let zeros = random.uniform(0.2, 0.9);
        Solution::of(mesh, |_| {
            let is_zero = random.uniform(0.0, 1.0) < zeros;
            (if is_zero { 0.0 } else { whole(random) }, Vector::zeros())
        })
    });
}

/// A plateau is outlined, whether it is the highest or the lowest; one between the two sides of
/// the level has the surface on one of its own. Where the level is touched alone there is no
/// surface. The faces of the boundary that are on the level are drawn besides.
#[test]
fn a_plateau_is_on_one_side() {
    type Profile = fn(f64) -> f64;
    let cases: [(&str, Profile, f64, f64); 5] = [
        ("lowest", |x| (x - 0.5).max(0.0), 1.0, 3.0),
        ("highest", |x| -(x - 0.5).max(0.0), 1.0, 3.0),
        ("between", |x| (x - 0.75).max(0.0) - (0.25 - x).max(0.0), 1.0, 2.0),
        ("valley", |x| (x - 0.5).abs(), 0.0, 0.0),
        ("ridge", |x| -(x - 0.5).abs(), 0.0, 0.0),
    ];
    for seed in 0..4 {
        let mesh = renumbered(&mut Random(seed), &kuhn_grid(4), 0.0);
        for (name, profile, inside, on_boundary) in &cases {
            let values: Vec<f64> = mesh.points().iter().map(|p| profile(p.x)).collect();
            let f = Linear::new(&mesh, &values);
            for fineness in FINENESSES {
                let surface = at_zero(&f, fineness);
                check_even(&surface, &format!("{name} {seed} {fineness:?}"));
                let difference = area(&surface) - inside - on_boundary;
                assert!(difference.abs() < 1e-12, "{name} {seed} {fineness:?}: {difference}");
            }
        }
    }
}

/// The same bytes on any number of threads, and as many triangles whatever the order of points
/// and cells.
#[test]
fn neither_threads_nor_the_order_of_points_matter() {
    let on_threads = |threads: usize, f: &dyn TetrahedronCubics, fineness: Fineness| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let surface = pool.install(|| at_zero(f, fineness));
        (surface.points, surface.triangles, surface.cells)
    };
    for seed in 0..3 {
        let mut random = Random(seed);
        let mesh = kuhn_grid(3);
        let number_at = |p: &Vector| {
            let place = p.x * 3.0 + 4.0 * (p.y * 3.0 + 4.0 * p.z * 3.0);
            let number = whole(&mut Random(1000 * seed + place.round() as u64));
            (number, Vector::new(number, 0.0, 0.0))
        };
        let solutions: Vec<Solution> =
            (0..3).map(|_| Solution::of(renumbered(&mut random, &mesh, 0.0), number_at)).collect();
        for fineness in FINENESSES {
            let cubic = solutions[0].cubic();
            assert_eq!(on_threads(1, &cubic, fineness), on_threads(3, &cubic, fineness));
            let count = |solution: &Solution| at_zero(&solution.linear(), fineness).triangles.len();
            let counts: Vec<usize> = solutions.iter().map(count).collect();
            assert!(counts.iter().all(|&count| count == counts[0]), "{seed} {counts:?}");
        }
    }
}
