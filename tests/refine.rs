//! Refined meshes fit together, fill what they refine, keep its borders, and their cells keep
//! their shapes.

mod support;

use std::collections::{HashMap, HashSet};

use proptest::prelude::*;
use support::checked::is_symmetric;
use support::meshes::{Random, grid, random_square, symmetric_grid};
use support::tetrahedra::{graded_cube, random_cube};
use vtu2contour::mesh::{SimplexMesh, TetrahedronMesh, TriangleMesh, Vector};
use vtu2contour::refine::delaunay::{DelaunayOptions, delaunay};
use vtu2contour::refine::{
    Marks, NewPoint, RefineError, Refinement, Smoothing, TriangleMethod, refine_tetrahedra, smooth,
};

use TriangleMethod::{Centroid, LongestEdge, NewestVertex, RedGreen};

const METHODS: [TriangleMethod; 4] = [LongestEdge, NewestVertex, RedGreen, Centroid];

/// Twice the area for a normal along z, or six times the volume, with sign.
fn size<const CORNERS: usize>(corners: [Vector; CORNERS]) -> f64 {
    match corners[..] {
        [a, b, c] => (b - a).cross(&(c - a)).z,
        [a, b, c, d] => (b - a).cross(&(c - a)).dot(&(d - a)),
        _ => f64::NAN,
    }
}

/// The smallest angle of a triangle, in degrees.
fn smallest_angle(corners: [Vector; 3]) -> f64 {
    let angle = |n: usize| {
        let [a, b, c] = [0, 1, 2].map(|step| corners[(n + step) % 3]);
        (b - a).angle(&(c - a)).to_degrees()
    };
    (0..3).map(angle).fold(180.0, f64::min)
}

/// The sides of cells, and the cells that have each.
fn sides<const CORNERS: usize>(cells: &[[u32; CORNERS]]) -> HashMap<Vec<u32>, Vec<usize>> {
    let mut sides: HashMap<Vec<u32>, Vec<usize>> = HashMap::new();
    for (cell, corners) in cells.iter().enumerate() {
        for missing in 0..CORNERS {
            let mut side = corners.to_vec();
            side.remove(missing);
            side.sort_unstable();
            sides.entry(side).or_default().push(cell);
        }
    }
    sides
}

/// The points of the input that a point of the refined mesh is a mean of.
fn origin<const CORNERS: usize>(
    mesh: &SimplexMesh<CORNERS>,
    refined: &Refinement<CORNERS>,
    point: u32,
) -> Vec<u32> {
    let Some(new) = (point as usize).checked_sub(mesh.points().len()) else { return vec![point] };
    match refined.new_points[new] {
        NewPoint::Edge { ends, .. } => ends.to_vec(),
        NewPoint::Inside { cell, at } => {
            let corners = mesh.simplices()[cell as usize].iter().zip(at);
            corners.filter(|(_, weight)| *weight != 0.0).map(|(corner, _)| *corner).collect()
        }
    }
}

/// The cells fill their parents, are turned as these are, and fit together; what was a side of
/// one cell alone, or one between two of different regions, is still made up of sides that are.
fn check<const CORNERS: usize>(
    mesh: &SimplexMesh<CORNERS>,
    refined: &Refinement<CORNERS>,
    regions: &[u32],
    is_nested: bool,
) {
    let points = mesh.points().len();
    assert_eq!(refined.points[..points], *mesh.points());
    assert_eq!(refined.points.len(), points + refined.new_points.len());
    assert_eq!(refined.cells.len(), refined.parents.len());
    for (new, place) in refined.points[points..].iter().zip(&refined.new_points) {
        let expected = match place {
            NewPoint::Edge { ends: [a, b], at } => {
                assert!(a < b);
                mesh.points()[*a as usize] * (1.0 - at) + mesh.points()[*b as usize] * *at
            }
            NewPoint::Inside { cell, at } => mesh.position(*cell as usize, at),
        };
        assert!((new - expected).norm() < 1e-14);
    }
    let whole: f64 = (0..mesh.simplices().len()).map(|cell| size(mesh.corners(cell))).sum();
    let parts = || refined.cells.iter().map(|c| size(c.map(|p| refined.points[p as usize])));
    assert!((parts().sum::<f64>() / whole - 1.0).abs() < 1e-12);
    let mut filled = vec![0.0; mesh.simplices().len()];
    for (part, &parent) in parts().zip(&refined.parents) {
        assert!(part > 0.0, "inverted");
        filled[parent as usize] += part / size(mesh.corners(parent as usize));
    }
    assert!(!is_nested || filled.iter().all(|filled| (filled - 1.0).abs() < 1e-9));
    let old = sides(mesh.simplices());
    let region = |cell: &usize| regions[refined.parents[*cell] as usize];
    for (side, cells) in sides(&refined.cells) {
        // all of a side's points lie on one side of the input, or the side is inside a cell
        let mut within: Vec<u32> =
            side.iter().flat_map(|point| origin(mesh, refined, *point)).collect();
        within.sort_unstable();
        within.dedup();
        let above = old.get(&within);
        let alone = above.is_some_and(|cells| cells.len() == 1);
        assert_eq!(cells.len(), if alone { 1 } else { 2 }, "hanging or open: {within:?}");
        let between = cells.len() == 2 && region(&cells[0]) != region(&cells[1]);
        let was = above.is_some_and(|cells| match cells[..] {
            [one, other] => regions[one] != regions[other],
            _ => false,
        });
        assert_eq!(between, was, "an interface moved");
    }
}

/// Each cell with the given chance.
fn chosen(random: &mut Random, cells: usize, chance: f64) -> Vec<u32> {
    (0..cells as u32).filter(|_| random.uniform(0.0, 1.0) < chance).collect()
}

fn mesh_of<const CORNERS: usize>(refined: &Refinement<CORNERS>) -> SimplexMesh<'static, CORNERS> {
    SimplexMesh::new(refined.points.clone(), refined.cells.clone()).unwrap()
}

/// Steps of a method with random marks, each looked at; then what the last looks like.
fn steps(
    mesh: TriangleMesh<'static>,
    method: TriangleMethod,
    count: usize,
    random: &mut Random,
) -> TriangleMesh<'static> {
    let (mut mesh, mut state) = (mesh, Vec::new());
    let centre = |mesh: &TriangleMesh, t: usize| mesh.corners(t).iter().sum::<Vector>().x;
    let mut regions: Vec<u32> =
        (0..mesh.triangles().len()).map(|t| u32::from(centre(&mesh, t) > 1.2)).collect();
    for _ in 0..count {
        let cells = chosen(random, mesh.triangles().len(), 0.1);
        let marks = Marks { state: &state, ..Marks::all(&cells) };
        let refined = method.refine(&mesh, &marks).unwrap();
        check(&mesh, &refined, &regions, method != RedGreen);
        let divided: HashSet<u32> = (0..refined.parents.len())
            .filter(|&n| !mesh.triangles().contains(&refined.cells[n]))
            .map(|n| refined.parents[n])
            .collect();
        assert!(cells.iter().all(|cell| divided.contains(cell)), "a mark was not divided");
        regions = refined.parents.iter().map(|&parent| regions[parent as usize]).collect();
        mesh = mesh_of(&refined);
        state = refined.state;
    }
    mesh
}

fn smallest_of(mesh: &TriangleMesh) -> f64 {
    (0..mesh.triangles().len()).map(|t| smallest_angle(mesh.corners(t))).fold(180.0, f64::min)
}

/// A square bent in space, some of its triangles cut out: holes that touch each other and the
/// boundary.
fn surface(random: &mut Random, count: usize) -> TriangleMesh<'static> {
    let flat = random_square(random, count);
    let bent = flat.points().iter().map(|p| Vector::new(p.x, p.y, random.uniform(0.0, 0.3)));
    let points = bent.collect();
    let mut kept = flat.triangles().to_vec();
    kept.retain(|_| random.uniform(0.0, 1.0) < 0.85);
    let triangles = if kept.is_empty() { flat.triangles().to_vec() } else { kept };
    TriangleMesh::new(points, triangles).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(24) })]

    #[test]
    fn triangles_fit_together_and_keep_their_angles(seed in 0..1_u64 << 40, count in 3..60_usize) {
        let random = &mut Random(seed);
        let mesh = surface(random, count);
        let smallest = smallest_of(&mesh);
        for method in METHODS {
            let last = steps(mesh.clone(), method, 8, random);
            let bound = match method {
                LongestEdge | NewestVertex => 0.5 * smallest,
                // a half may divide the smallest angle, its sides one to two
                RedGreen => smallest / 3.0,
                Centroid => 0.0,
            };
            prop_assert!(smallest_of(&last) >= bound * (1.0 - 1e-9), "{method:?}: {} of {smallest}", smallest_of(&last));
        }
    }

    /// Steps without end about one point: as good as a few.
    #[test]
    fn many_steps_keep_angles(seed in 0..1_u64 << 40, count in 0..12_usize) {
        let start = surface(&mut Random(seed), count);
        let smallest = smallest_of(&start);
        let place = start.position(0, &[0.2, 0.3, 0.5]);
        for (method, bound) in [(LongestEdge, 0.5), (NewestVertex, 0.5), (RedGreen, 1.0 / 3.0)] {
            let (mut mesh, mut state) = (start.clone(), Vec::new());
            for _ in 0..30 {
                let distance = |t: u32| (mesh.position(t as usize, &[1.0 / 3.0; 3]) - place).norm();
                let all = 0..mesh.triangles().len() as u32;
                let nearest = all.min_by(|s, t| distance(*s).total_cmp(&distance(*t))).unwrap();
                let cells = [nearest];
                let refined = method.refine(&mesh, &Marks { state: &state, ..Marks::all(&cells) }).unwrap();
                check(&mesh, &refined, &vec![0; mesh.triangles().len()], method != RedGreen);
                mesh = mesh_of(&refined);
                state = refined.state;
            }
            prop_assert!(mesh.triangles().len() > 60);
            let last = smallest_of(&mesh);
            prop_assert!(last >= bound * smallest * (1.0 - 1e-9), "{method:?}: {last} of {smallest}");
        }
    }

    /// Smoothing turns no triangle over and makes the worst no worse; what is fixed stays.
    #[test]
    fn smoothing_keeps_the_mesh(seed in 0..1_u64 << 40, count in 3..60_usize) {
        let random = &mut Random(seed);
        let mesh = random_square(random, count);
        let cells = chosen(random, mesh.triangles().len(), 0.3);
        let regions: Vec<u32> = (0..mesh.triangles().len() as u32).map(|t| t / 7 % 2).collect();
        for smoothing in [Smoothing::Laplacian, Smoothing::Optimised] {
            let before = RedGreen.refine(&mesh, &Marks::all(&cells)).unwrap();
            let mut after = before.clone();
            smooth(&mesh, &mut after, &regions, smoothing, 10);
            let shape = |refined: &Refinement<3>, cell: usize| {
                let corners = refined.cells[cell].map(|p| refined.points[p as usize]);
                let squares: f64 = (0..3).map(|n| (corners[n] - corners[(n + 1) % 3]).norm_squared()).sum();
                size(corners) / squares
            };
            let all = || 0..before.cells.len();
            let worst = |refined| all().map(|cell| shape(refined, cell)).fold(1.0, f64::min);
            prop_assert!(worst(&before) > 0.0 && worst(&after) >= worst(&before));
            let area: f64 = all().map(|cell| size(after.cells[cell].map(|p| after.points[p as usize]))).sum();
            prop_assert!((area - 2.0).abs() < 1e-12);
            // boundary and interfaces are where they were, so every region has its area
            for (side, cells) in sides(&before.cells) {
                let region = |cell: usize| regions[before.parents[cell] as usize];
                if cells.len() == 1 || region(cells[0]) != region(cells[1]) {
                    for point in side {
                        prop_assert_eq!(before.points[point as usize], after.points[point as usize]);
                    }
                }
            }
            let old = mesh.points().len();
            let noted: HashSet<u32> = after.moved.iter().map(|moved| moved.point).collect();
            for point in 0..old {
                let is_moved = before.points[point] != after.points[point];
                prop_assert_eq!(is_moved, noted.contains(&(point as u32)));
            }
            for moved in &after.moved {
                let there = mesh.position(moved.cell as usize, &moved.at);
                prop_assert!((there - after.points[moved.point as usize]).norm() < 1e-12);
            }
            for (place, point) in after.new_points.iter().zip(&after.points[old..]) {
                if let NewPoint::Inside { cell, at } = place {
                    prop_assert!((mesh.position(*cell as usize, at) - point).norm() < 1e-12);
                }
            }
        }
    }

    #[test]
    fn tetrahedra_fit_together(seed in 0..1_u64 << 40, count in 0..30_usize) {
        let random = &mut Random(seed);
        let mut mesh = if count % 2 == 0 { random_cube(random, count) } else { graded_cube(random, count) };
        let mut state = Vec::new();
        let mut regions: Vec<u32> = (0..mesh.tetrahedra().len() as u32).map(|t| t % 3).collect();
        for _ in 0..4 {
            let cells = chosen(random, mesh.tetrahedra().len(), 0.05);
            let refined = refine_tetrahedra(&mesh, &Marks { state: &state, ..Marks::all(&cells) }).unwrap();
            check(&mesh, &refined, &regions, true);
            let mut parts = vec![0; mesh.tetrahedra().len()];
            refined.parents.iter().for_each(|&parent| parts[parent as usize] += 1);
            prop_assert!(cells.iter().all(|&cell| parts[cell as usize] > 1));
            regions = refined.parents.iter().map(|&parent| regions[parent as usize]).collect();
            mesh = mesh_of(&refined);
            state = refined.state;
        }
    }

    /// A bound on points is met exactly by bisection, and never exceeded.
    #[test]
    fn a_bound_is_kept(seed in 0..1_u64 << 40, count in 3..60_usize, room in 0..30_usize) {
        let random = &mut Random(seed);
        let mesh = random_square(random, count);
        let cells = chosen(random, mesh.triangles().len(), 0.8);
        let max_points = mesh.points().len() + room;
        let regions = vec![0; mesh.triangles().len()];
        for method in METHODS {
            let all = method.refine(&mesh, &Marks::all(&cells)).unwrap();
            let bounded = method.refine(&mesh, &Marks { max_points, ..Marks::all(&cells) }).unwrap();
            check(&mesh, &bounded, &regions, true);
            let expected = max_points.min(all.points.len());
            // not every number is possible with a few triangles
            if method == RedGreen && count < 20 {
                prop_assert!(bounded.points.len() <= expected);
            } else {
                prop_assert_eq!(bounded.points.len(), expected, "{:?}", method);
            }
        }
        let cube = random_cube(random, count / 2);
        let cells = chosen(random, cube.tetrahedra().len(), 0.5);
        let max_points = cube.points().len() + room;
        let points = |count: usize| {
            refine_tetrahedra(&cube, &Marks::all(&cells[..count])).unwrap().points.len()
        };
        let bounded = refine_tetrahedra(&cube, &Marks { max_points, ..Marks::all(&cells) }).unwrap();
        let most = (0..=cells.len()).rev().find(|&count| points(count) <= max_points).unwrap();
        prop_assert_eq!(bounded.points.len(), points(most));
    }
}

/// Two steps of bisection about a corner, of which all is known.
#[test]
fn a_square_by_hand() {
    let square = grid(1);
    let once = LongestEdge.refine(&square, &Marks::all(&[0, 1])).unwrap();
    assert_eq!(once.cells.len(), 4);
    assert_eq!(once.points[4], Vector::new(0.5, 0.5, 0.0));
    let twice = LongestEdge.refine(&mesh_of(&once), &Marks::all(&[0])).unwrap();
    assert_eq!((twice.points.len(), twice.cells.len()), (6, 5));
    // red: each in four, and the sides of the square in two
    let red = RedGreen.refine(&square, &Marks::all(&[0, 1])).unwrap();
    assert_eq!((red.points.len(), red.cells.len()), (9, 8));
}

/// Meshes that are wrong are refused, or refined as they are: never a panic, never without end.
#[test]
fn wrong_cells_are_told_or_kept() {
    let random = &mut Random(11);
    for round in 0..300 {
        let mut points: Vec<Vector> = (0..9)
            .map(|_| Vector::from([0; 3].map(|_| random.uniform(0.0, 2.0).floor())))
            .collect();
        if round % 10 == 0 {
            points[4].y = f64::NAN;
        }
        let mut some = || random.uniform(0.0, 9.0) as u32;
        let triangles: Vec<[u32; 3]> = (0..8).map(|_| [some(), some(), some()]).collect();
        let tetrahedra: Vec<[u32; 4]> = (0..6).map(|_| [some(), some(), some(), some()]).collect();
        let is_wrong = |corners: &[u32]| {
            let twice = (1..corners.len()).any(|n| corners[..n].contains(&corners[n]));
            twice || corners.iter().any(|&point| points[point as usize].y.is_nan())
        };
        let flat = TriangleMesh::new(points.clone(), triangles.clone()).unwrap();
        for method in METHODS {
            let refined = method.refine(&flat, &Marks::all(&[0, 3, 5]));
            assert_eq!(refined.is_err(), triangles.iter().any(|cell| is_wrong(cell)));
            let usable = triangles.iter().copied().filter(|cell| !is_wrong(cell)).collect();
            let usable = TriangleMesh::new(points.clone(), usable).unwrap();
            let all: Vec<u32> = (0..usable.triangles().len() as u32).collect();
            let refined = method.refine(&usable, &Marks::all(&all)).unwrap();
            assert!(all.is_empty() || refined.cells.len() > all.len());
        }
        let solid = TetrahedronMesh::new(points.clone(), tetrahedra.clone()).unwrap();
        let refined = refine_tetrahedra(&solid, &Marks::all(&[0, 3, 5]));
        assert_eq!(refined.is_err(), tetrahedra.iter().any(|cell| is_wrong(cell)));
    }
    let twice = TriangleMesh::new(vec![Vector::zeros(); 3], vec![[0, 1, 2], [2, 1, 1]]).unwrap();
    let error = LongestEdge.refine(&twice, &Marks::all(&[])).unwrap_err();
    assert_eq!(error, RefineError::RepeatedCorner { cell: 1, point: 1 });
    let nowhere = vec![Vector::zeros(), Vector::x(), Vector::repeat(f64::INFINITY)];
    let nowhere = TriangleMesh::new(nowhere, vec![[0, 1, 2]]).unwrap();
    let error = RedGreen.refine(&nowhere, &Marks::all(&[])).unwrap_err();
    assert_eq!(error, RefineError::NotFinite { point: 2 });
}

/// A mesh that is its own mirror image stays so, if the marks are.
#[test]
fn symmetric_meshes_stay_symmetric() {
    for method in METHODS {
        let (mut mesh, mut state) = (symmetric_grid(6), Vec::new());
        for step in 1..6 {
            let near = |&t: &u32| {
                let middle = mesh.position(t as usize, &[1.0 / 3.0; 3]);
                (middle - Vector::new(0.5, 0.2, 0.0)).norm() < 0.6 / f64::from(step)
            };
            let cells: Vec<u32> = (0..mesh.triangles().len() as u32).filter(near).collect();
            assert!(!cells.is_empty());
            let refined =
                method.refine(&mesh, &Marks { state: &state, ..Marks::all(&cells) }).unwrap();
            mesh = mesh_of(&refined);
            state = refined.state;
            assert!(is_symmetric(&mesh), "{method:?}, step {step}");
        }
    }
}

/// What comes of each tetrahedron of a mesh, in any steps, has at most 72 shapes.
#[test]
fn shapes_are_bounded_in_any_mesh() {
    let random = &mut Random(5);
    let (mut mesh, mut state) = (random_cube(random, 6), Vec::new());
    let mut roots: Vec<u32> = (0..mesh.tetrahedra().len() as u32).collect();
    let mut shapes: HashMap<u32, HashSet<Vec<i64>>> = HashMap::new();
    let mut counts = Vec::new();
    while mesh.tetrahedra().len() < 60_000 {
        let cells = chosen(random, mesh.tetrahedra().len(), 0.15);
        let refined =
            refine_tetrahedra(&mesh, &Marks { state: &state, ..Marks::all(&cells) }).unwrap();
        roots = refined.parents.iter().map(|&parent| roots[parent as usize]).collect();
        mesh = mesh_of(&refined);
        state = refined.state;
        for (cell, root) in roots.iter().enumerate() {
            shapes.entry(*root).or_default().insert(shape(mesh.corners(cell)));
        }
        counts.push(shapes.values().map(HashSet::len).max().unwrap());
    }
    assert!(*counts.last().unwrap() <= 72, "{counts:?}");
    assert!(counts.len() > 8 && counts[0] < 20, "{counts:?}");
}

/// What comes of each tetrahedron has a bounded number of shapes: new ones cease to appear.
#[test]
fn tetrahedra_have_few_shapes() {
    let points = [[0.0, 0.0, 0.0], [1.0, 0.1, 0.0], [0.3, 0.8, 0.1], [0.2, 0.3, 0.9]];
    let points: Vec<Vector> = points.into_iter().map(Vector::from).collect();
    let mut mesh = TetrahedronMesh::new(points, vec![[0, 1, 2, 3]]).unwrap();
    let (mut state, mut shapes) = (Vec::new(), HashSet::new());
    let mut counts = Vec::new();
    for step in 0..14 {
        // at first everything, then a corner
        let all = 0..mesh.tetrahedra().len() as u32;
        let cells: Vec<u32> = if step < 9 {
            all.collect()
        } else {
            all.filter(|&cell| mesh.tetrahedra()[cell as usize].contains(&0)).collect()
        };
        let refined =
            refine_tetrahedra(&mesh, &Marks { state: &state, ..Marks::all(&cells) }).unwrap();
        mesh = mesh_of(&refined);
        state = refined.state;
        for cell in 0..mesh.tetrahedra().len() {
            shapes.insert(shape(mesh.corners(cell)));
        }
        counts.push(shapes.len());
    }
    assert!(counts[13] <= 72, "{counts:?}");
    assert_eq!(counts[7], counts[13], "{counts:?}");
}

/// The lengths of the edges by the longest, ascending by their neighbours: the same for similar
/// tetrahedra.
fn shape(corners: [Vector; 4]) -> Vec<i64> {
    let mut lengths: Vec<f64> = Vec::new();
    for i in 0..4 {
        (i + 1..4).for_each(|j| lengths.push((corners[j] - corners[i]).norm()));
    }
    lengths.sort_by(f64::total_cmp);
    let longest = lengths[5];
    lengths.iter().map(|length| (length / longest * 1e6).round() as i64).collect()
}

/// The same to the last bit for any number of threads.
#[test]
fn threads_do_not_matter() {
    let random = &mut Random(7);
    let (square, cube) = (random_square(random, 500), random_cube(random, 200));
    let cells = chosen(random, 900, 0.3);
    let all = || {
        let flat = METHODS.map(|method| {
            let mut refined = method.refine(&square, &Marks::all(&cells)).unwrap();
            smooth(&square, &mut refined, &[], Smoothing::Optimised, 3);
            refined
        });
        let hybrid = delaunay(&square, &Marks::all(&cells), &DelaunayOptions::default()).unwrap();
        (flat, hybrid, refine_tetrahedra(&cube, &Marks::all(&cells)).unwrap())
    };
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(all)
    };
    let one = with(1);
    assert!(one == with(2) && one == with(5));
}

#[test]
fn what_does_not_fit_is_told() {
    let square = grid(2);
    for method in METHODS {
        let error = method.refine(&square, &Marks::all(&[3, 8])).unwrap_err();
        assert_eq!(error, RefineError::NoSuchCell { cell: 8, cells: 8 });
    }
    for state in [&[0_u16; 3][..], &[9; 8], &[u16::MAX; 8]] {
        for method in [NewestVertex, RedGreen] {
            let error = method.refine(&square, &Marks { state, ..Marks::all(&[0]) }).unwrap_err();
            if state[0] == 9 && method == RedGreen {
                continue;
            }
            assert_eq!(error, RefineError::State);
        }
    }
    // marks of tetrahedra that do not agree on their common face
    let points: Vec<Vector> =
        [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0; 3]]
            .map(Vector::from)
            .to_vec();
    let two = TetrahedronMesh::new(points, vec![[0, 1, 2, 3], [1, 2, 3, 4]]).unwrap();
    let good = refine_tetrahedra(&two, &Marks::all(&[])).unwrap().state;
    let with = |code| {
        let state = [good[0], code];
        refine_tetrahedra(&two, &Marks { state: &state, ..Marks::all(&[0]) })
    };
    assert_eq!(with(good[1]), refine_tetrahedra(&two, &Marks::all(&[0])));
    let results: Vec<_> = (0..1 << 11).map(with).collect();
    assert!(
        results.iter().all(|result| !matches!(result, Err(error) if *error != RefineError::State))
    );
    let good = results.iter().flatten().count();
    assert!((2..400).contains(&good), "{good}");
    results.iter().flatten().for_each(|refined| check(&two, refined, &[0, 0], true));
}
