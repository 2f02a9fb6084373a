//! Iso-surfaces: closed, complete, exact, the same on any number of threads.

mod support;

use std::collections::HashMap;

use rayon::prelude::*;
use support::brute_force_3d::{self, Characteristics};
use support::meshes::Random;
use support::problems_3d::PROBLEMS;
use support::surfaces::{area, check_even, on_boundary};
use support::tetrahedra::{graded_cube, kuhn_grid, random_cube, shuffled};
use vtu2contour::contour::CellRanges;
use vtu2contour::contour::surface::{
    ContourSurface, Fineness, contour_surface, points_per_side_within,
};
use vtu2contour::field::Field;
use vtu2contour::interpolant::{TetrahedronCubics, Tricubic};
use vtu2contour::mesh::{TetrahedronMesh, Vector};

/// Every edge belongs to two triangles, which run along it in opposite directions, or lies
/// on the boundary; no triangle is degenerate or doubled, and no point without a triangle.
fn check_closed(surface: &ContourSurface, name: &str) {
    let used: std::collections::HashSet<u32> =
        surface.triangles.iter().flatten().copied().collect();
    assert_eq!(used.len(), surface.points.len(), "{name}: points");
    let mut edges: HashMap<(u32, u32), usize> = HashMap::new();
    for triangle in &surface.triangles {
        let [a, b, c] = triangle.map(|n| surface.points[n as usize].position);
        assert!((b - a).cross(&(c - a)).norm() > 0.0, "{name}: no area {a} {b} {c}");
        for n in 0..3 {
            *edges.entry((triangle[n], triangle[(n + 1) % 3])).or_default() += 1;
        }
    }
    for (&(from, to), &count) in &edges {
        let [a, b] = [from, to].map(|n| surface.points[n as usize].position);
        assert_eq!(count, 1, "{name}: twice from {a} to {b}");
        assert!(edges.contains_key(&(to, from)) || on_boundary(&a, &b), "{name}: open {a} {b}");
    }
}

fn check_levels(surface: &ContourSurface, f: &dyn TetrahedronCubics, range: f64) {
    for (level, points) in surface.levels.iter().zip(&surface.level_points) {
        for point in &surface.points[points.clone()] {
            let value = f.cubic(point.cell as usize).value(&point.at);
            assert!((value - level).abs() <= 1e-12 * range, "{value} {level}");
        }
    }
}

fn check(mesh: &TetrahedronMesh, values: &[f64], gradients: &[Vector], name: &str) -> [usize; 3] {
    let f = Tricubic::new(mesh, Field { values, gradients });
    let ranges = CellRanges::of_tetrahedra(&f);
    let [low, high] = ranges.attained_in_tetrahedra(&f).unwrap();
    let levels: Vec<f64> = (1..6).map(|n| low + (high - low) * f64::from(n) / 6.0).collect();
    let mut found = [0; 3];
    for fineness in [
        Fineness::PointsPerSide(2),
        Fineness::PointsPerSide(3),
        Fineness::PointsPerSide(4),
        Fineness::Tolerance(1e-3),
    ] {
        let surface = contour_surface(&f, &ranges, &levels, fineness);
        let name = format!("{name} {fineness:?}");
        check_closed(&surface, &name);
        if surface.counts.unresolved == 0 {
            check_levels(&surface, &f, high - low);
        }
        found = [surface.counts.active, surface.counts.divided, surface.counts.unresolved];
    }
    found
}

#[test]
fn surfaces_are_closed() {
    let mut random = Random(1);
    let meshes = [random_cube(&mut random, 200), graded_cube(&mut random, 200), kuhn_grid(5)];
    for (n, mesh) in meshes.iter().enumerate() {
        let mesh = shuffled(&mut random, mesh);
        for problem in PROBLEMS {
            let (values, gradients) = problem.at_points(&mesh);
            let name = format!("mesh {n}, problem {}", problem.number);
            let [_, _, unresolved] = check(&mesh, &values, &gradients, &name);
            assert_eq!(unresolved, 0, "{name}");
        }
    }
}

/// The Euler characteristics of a surface's components.
fn characteristics(surface: &ContourSurface) -> Characteristics {
    let mut parents: Vec<usize> = (0..surface.points.len()).collect();
    fn root(parents: &[usize], mut node: usize) -> usize {
        while parents[node] != node {
            node = parents[node];
        }
        node
    }
    let mut sides = std::collections::HashSet::new();
    for triangle in &surface.triangles {
        for n in 0..3 {
            let [a, b] = [triangle[n], triangle[(n + 1) % 3]];
            sides.insert([a.min(b), a.max(b)]);
            let (a, b) = (root(&parents, a as usize), root(&parents, b as usize));
            parents[a.max(b)] = a.min(b);
        }
    }
    let mut sums: HashMap<usize, i64> = HashMap::new();
    let used: std::collections::HashSet<u32> =
        surface.triangles.iter().flatten().copied().collect();
    for point in used {
        *sums.entry(root(&parents, point as usize)).or_default() += 1;
    }
    for [side, _] in sides {
        *sums.entry(root(&parents, side as usize)).or_default() -= 1;
    }
    for [corner, ..] in &surface.triangles {
        *sums.entry(root(&parents, *corner as usize)).or_default() += 1;
    }
    let mut found: Characteristics = sums.into_values().collect();
    found.sort_unstable();
    found
}

/// Random values and gradients, some so steep that a tetrahedron holds several sheets and
/// islands.
fn random_field(random: &mut Random, points: usize) -> (Vec<f64>, Vec<Vector>) {
    let steep = random.uniform(0.0, 10.0);
    let values = (0..points).map(|_| random.uniform(-1.0, 1.0)).collect();
    let gradient = |random: &mut Random| [(); 3].map(|()| random.uniform(-steep, steep));
    let gradients = (0..points).map(|_| Vector::from(gradient(random))).collect();
    (values, gradients)
}

#[test]
fn surfaces_of_random_data_are_closed() {
    (0..200).into_par_iter().for_each(|n| {
        let mut random = Random(1000 + n);
        let points = if n % 20 == 0 { 27 } else { 8 + n as usize % 5 };
        let mesh = random_cube(&mut random, points);
        let (values, gradients) = random_field(&mut random, mesh.points().len());
        check(&mesh, &values, &gradients, &format!("random {n}"));
    });
}

#[test]
fn nothing_is_missed_on_random_data() {
    let mut random = Random(3);
    let mut finer = [0; 3];
    for case in 0..200 {
        let mesh = random_cube(&mut random, 8 + case % 5);
        let (values, gradients) = random_field(&mut random, mesh.points().len());
        let f = Tricubic::new(&mesh, Field { values: &values, gradients: &gradients });
        let ranges = CellRanges::of_tetrahedra(&f);
        let [low, high] = ranges.attained_in_tetrahedra(&f).unwrap();
        let level = random.uniform(low, high);
        let surface = contour_surface(&f, &ranges, &[level], Fineness::PointsPerSide(2));
        let ours = characteristics(&surface);
        assert_eq!(surface.counts.unresolved, 0);
        let references = [12, 24, 48, 96];
        let agrees = |n: &u32| brute_force_3d::characteristics(&f, level, *n) == ours;
        match references.iter().position(agrees) {
            Some(0) => {}
            Some(place) => finer[place - 1] += 1,
            None => {
                let theirs = brute_force_3d::characteristics(&f, level, 96);
                panic!("case {case}: {ours:?} against {theirs:?}");
            }
        }
    }
    println!("{finer:?} of 200 needed a finer reference");
}

#[test]
fn planes_through_nodes_edges_and_faces() {
    let mesh = shuffled(&mut Random(4), &kuhn_grid(4));
    let directions =
        [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 1.0], [1.0, 2.0, -1.0]];
    for direction in directions.map(Vector::from) {
        let values: Vec<f64> = mesh.points().iter().map(|p| p.dot(&direction)).collect();
        let gradients = vec![direction; values.len()];
        let f = Tricubic::new(&mesh, Field { values: &values, gradients: &gradients });
        let ranges = CellRanges::of_tetrahedra(&f);
        for level in [0.25, 0.5, 0.75] {
            for fineness in
                [Fineness::PointsPerSide(2), Fineness::PointsPerSide(4), Fineness::Tolerance(1e-3)]
            {
                let surface = contour_surface(&f, &ranges, &[level], fineness);
                let name = format!("{direction} {level} {fineness:?}");
                check_closed(&surface, &name);
                assert_eq!(surface.counts.divided, 0);
                let beyond = contour_surface(&f, &ranges, &[level + 1e-9], fineness);
                assert!((area(&surface) - area(&beyond)).abs() < 1e-6, "{name}");
                let normals = surface.triangles.iter().map(|triangle| {
                    let [a, b, c] = triangle.map(|n| surface.points[n as usize].position);
                    (b - a).cross(&(c - a))
                });
                assert!(normals.into_iter().all(|normal| normal.dot(&direction) < 0.0), "{name}");
            }
        }
    }
}

#[test]
fn levels_through_nodes() {
    let mut random = Random(5);
    let mut contradictory = 0;
    for case in 0..60 {
        let mesh = random_cube(&mut random, 8 + case % 12);
        let mut whole = || random.uniform(-1.0, 2.0).floor();
        let values: Vec<f64> = mesh.points().iter().map(|_| whole()).collect();
        let steep = random.uniform(0.0, 3.0);
        let mut slope = || random.uniform(-steep, steep);
        let gradients: Vec<Vector> =
            values.iter().map(|_| Vector::from([(); 3].map(|()| slope()))).collect();
        let f = Tricubic::new(&mesh, Field { values: &values, gradients: &gradients });
        let ranges = CellRanges::of_tetrahedra(&f);
        for fineness in
            [Fineness::PointsPerSide(2), Fineness::PointsPerSide(3), Fineness::Tolerance(1e-2)]
        {
            let surface = contour_surface(&f, &ranges, &[0.0], fineness);
            check_even(&surface, &format!("case {case} {fineness:?} {:?}", surface.counts));
            contradictory += usize::from(surface.counts.unresolved > 0);
        }
    }
    // once the boundary around a corner is on the level, and gradients at random point in and
    // out of it
    assert_eq!(contradictory, 3);
}

/// Where a level passes through points of the mesh the surface is refined as elsewhere: a
/// ball around a point, and through points.
#[test]
fn a_tolerance_holds_at_points_on_the_level() {
    let mesh = shuffled(&mut Random(7), &kuhn_grid(4));
    let centre = Vector::repeat(0.5);
    let values: Vec<f64> = mesh.points().iter().map(|p| (p - centre).norm_squared()).collect();
    let gradients: Vec<Vector> = mesh.points().iter().map(|p| 2.0 * (p - centre)).collect();
    let f = Tricubic::new(&mesh, Field { values: &values, gradients: &gradients });
    let ranges = CellRanges::of_tetrahedra(&f);
    let level = 0.25 * 0.25;
    let tolerance = 1e-3;
    let surface = contour_surface(&f, &ranges, &[level], Fineness::Tolerance(tolerance));
    check_closed(&surface, "ball");
    assert_eq!((surface.counts.unresolved, surface.counts.coarse), (0, 0));
    let through = surface.points.iter().filter(|p| p.at.iter().any(|w| *w > 1.0 - 1e-12)).count();
    assert_eq!(through, 6);
    for triangle in &surface.triangles {
        let [a, b, c] = triangle.map(|n| surface.points[n as usize].position);
        for place in [(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0, (a + b + c) / 3.0] {
            let distance = ((place - centre).norm() - 0.25).abs();
            assert!(distance <= 1.02 * tolerance, "{distance} at {place}");
        }
    }
}

/// Two boxes, one upon the other, with or without their common face cut along different
/// diagonals; a cell whose corners are those of that face lies between them then. `lift` is how
/// far one of these corners is out of their plane.
fn boxes(with_flat_cell: bool, lift: f64) -> TetrahedronMesh<'static> {
    let below = kuhn_grid(1);
    let mut points: Vec<Vector> = below.points().to_vec();
    points.extend_from_within(0..4);
    points[8..].iter_mut().for_each(|point| point.z = 2.0);
    points.iter_mut().for_each(|point| point.z *= 0.5);
    points[4].z += lift;
    // the corners of the upper box, mirrored so that its lower face is cut the other way
    let upper =
        if with_flat_cell { [5, 4, 7, 6, 9, 8, 11, 10] } else { [4, 5, 6, 7, 8, 9, 10, 11] };
    let mut tetrahedra = below.tetrahedra().to_vec();
    let above = below.tetrahedra().iter().map(|corners| corners.map(|n| upper[n as usize]));
    tetrahedra.extend(above.collect::<Vec<_>>());
    tetrahedra.extend(with_flat_cell.then_some([4, 5, 6, 7]));
    TetrahedronMesh::new(points, tetrahedra).unwrap()
}

/// Delaunay meshes of regular points are full of cells without volume, or with one that is
/// rounding, whose corners stand in any order.
#[test]
fn cells_without_volume_are_closed_oriented_and_cheap() {
    let value = |p: &Vector| (2.0 * p.x).sin() + (p.y + 3.0 * p.z).cos();
    let gradient = |p: &Vector| {
        let down = -(p.y + 3.0 * p.z).sin();
        Vector::new(2.0 * (2.0 * p.x).cos(), down, 3.0 * down)
    };
    let mut random = Random(8);
    for (lift, fineness) in [0.0, 1e-14, -1e-14, 1e-10]
        .into_iter()
        .flat_map(|lift| [Fineness::PointsPerSide(3), Fineness::Tolerance(1e-3)].map(|f| (lift, f)))
    {
        let mut triangles = Vec::new();
        for with_flat_cell in [false, true, true, true, true] {
            let mesh = shuffled(&mut random, &boxes(with_flat_cell, lift));
            let values: Vec<f64> = mesh.points().iter().map(value).collect();
            let gradients: Vec<Vector> = mesh.points().iter().map(gradient).collect();
            let f = Tricubic::new(&mesh, Field { values: &values, gradients: &gradients });
            let ranges = CellRanges::of_tetrahedra(&f);
            let surface = contour_surface(&f, &ranges, &[0.5, 0.9], fineness);
            check_closed(&surface, &format!("{with_flat_cell} {lift} {fineness:?}"));
            assert_eq!((surface.counts.unresolved, surface.counts.coarse), (0, 0));
            triangles.push(surface.triangles.len());
        }
        assert!(triangles.iter().all(|&count| count < 2 * triangles[0]), "{triangles:?}");
    }
}

/// Patches that end in faces on the level lie there as a whole: neither their triangles nor their
/// points are kept beside those of the faces.
#[test]
fn a_plane_of_triple_zeros_is_drawn_once() {
    let mesh = kuhn_grid(4);
    let values: Vec<f64> = mesh.points().iter().map(|p| (p.x - 0.5).powi(3)).collect();
    let slope = |p: &Vector| 3.0 * (p.x - 0.5).powi(2) * Vector::x();
    let gradients: Vec<Vector> = mesh.points().iter().map(slope).collect();
    let f = Tricubic::new(&mesh, Field { values: &values, gradients: &gradients });
    let ranges = CellRanges::of_tetrahedra(&f);
    for fineness in
        [Fineness::PointsPerSide(2), Fineness::PointsPerSide(4), Fineness::Tolerance(1e-3)]
    {
        let surface = contour_surface(&f, &ranges, &[0.0], fineness);
        check_closed(&surface, &format!("{fineness:?}"));
        assert!((area(&surface) - 1.0).abs() < 1e-12);
    }
}

/// A face on the level is drawn although no patch is: it counts.
#[test]
fn faces_on_the_level_are_within_the_number_of_triangles() {
    let mesh = kuhn_grid(3);
    let values: Vec<f64> = mesh.points().iter().map(|p| p.x).collect();
    let gradients = vec![Vector::x(); values.len()];
    let f = Tricubic::new(&mesh, Field { values: &values, gradients: &gradients });
    let ranges = CellRanges::of_tetrahedra(&f);
    // on the boundary, between cells on both sides of it, and through cells
    for (level, coarsest) in [(0.0, 18), (1.0 / 3.0, 18), (0.5, 72)] {
        let points = points_per_side_within(&f, &ranges, &[level], 1000);
        let surface = contour_surface(&f, &ranges, &[level], Fineness::PointsPerSide(points));
        let most = (2..).map(|n: usize| coarsest * (n - 1).pow(2)).take_while(|&n| n <= 1000);
        assert_eq!(surface.triangles.len(), most.last().unwrap(), "{level}");
    }
}

/// Around a line of the level on which the slope is zero pieces are far smaller than the
/// tolerance, and slopes are rounding: nothing is gained by triangles that are smaller still.
#[test]
fn triangles_smaller_than_the_tolerance_stay_whole() {
    let mesh = kuhn_grid(1);
    let (a, b) = (|p: &Vector| p.x - 0.45, |p: &Vector| p.y - 0.4);
    let values: Vec<f64> = mesh.points().iter().map(|p| a(p) * a(p) * b(p)).collect();
    let gradient = |p: &Vector| Vector::new(2.0 * a(p) * b(p), a(p) * a(p), 0.0);
    let gradients: Vec<Vector> = mesh.points().iter().map(gradient).collect();
    let f = Tricubic::new(&mesh, Field { values: &values, gradients: &gradients });
    let ranges = CellRanges::of_tetrahedra(&f);
    let [coarsest, fine] = [Fineness::PointsPerSide(2), Fineness::Tolerance(1e-2)]
        .map(|fineness| contour_surface(&f, &ranges, &[0.0], fineness).triangles.len());
    assert!(fine < 3 * coarsest, "{coarsest} {fine}");
}

/// A tri-cubic's surfaces at a level.
fn surface_of(
    mesh: &TetrahedronMesh,
    data: impl Fn(&Vector) -> (f64, Vector),
    level: f64,
    fineness: Fineness,
) -> ContourSurface {
    let (values, gradients): (Vec<f64>, Vec<Vector>) = mesh.points().iter().map(data).unzip();
    let f = Tricubic::new(mesh, Field { values: &values, gradients: &gradients });
    contour_surface(&f, &CellRanges::of_tetrahedra(&f), &[level], fineness)
}

/// A mark for missing data makes what is on the far face of its cells rounding there, but not in
/// their neighbours: what these draw up to the face goes on behind it.
#[test]
fn surfaces_are_closed_beside_a_huge_value() {
    for (case, mark) in (0..16).zip([1e8, -1e12, 1e20, -1e30].into_iter().cycle()) {
        let mut random = Random(100 + case);
        let mesh = random_cube(&mut random, 8 + case as usize % 4);
        let (mut values, gradients) = random_field(&mut random, mesh.points().len());
        values[case as usize % 8] = mark;
        let f = Tricubic::new(&mesh, Field { values: &values, gradients: &gradients });
        let ranges = CellRanges::of_tetrahedra(&f);
        let level = random.uniform(-0.9, 0.9);
        let surface = contour_surface(&f, &ranges, &[level], Fineness::PointsPerSide(2));
        check_even(&surface, &format!("case {case}, {mark:e}"));
    }
}

/// Where a cubic is a triple zero all of it near the level is rounding.
#[test]
fn oblique_planes_of_triple_zeros_are_closed() {
    for (direction, level) in [([0.0, 1.0, 1.0], 0.25), ([1.0, 0.0, 1.0], 0.7), ([1.0; 3], 1.3)] {
        let direction = Vector::from(direction);
        let data = |p: &Vector| {
            let off = p.dot(&direction) - level;
            (off.powi(3), 3.0 * off * off * direction)
        };
        for seed in 0..10 {
            let mesh = shuffled(&mut Random(seed), &kuhn_grid(1));
            let surface = surface_of(&mesh, data, 0.0, Fineness::PointsPerSide(2));
            check_even(&surface, &format!("{direction} {seed}"));
        }
    }
}

/// A plane of symmetry between the cells, on the level, and another part of the surface that runs
/// through it, and through its faces.
#[test]
fn a_sheet_through_faces_on_the_level_is_closed() {
    let mesh = shuffled(&mut Random(9), &kuhn_grid(4));
    let data = |p: &Vector| {
        let (x, y) = (p.x - 0.5, p.y + 0.3 * p.z - 0.55);
        (x * y, Vector::new(y, x, 0.3 * x))
    };
    for fineness in [Fineness::PointsPerSide(2), Fineness::PointsPerSide(3)] {
        let surface = surface_of(&mesh, data, 0.0, fineness);
        check_even(&surface, &format!("{fineness:?}"));
        // around the line where they cross pieces are left at 1/16 of a cell
        assert!((area(&surface) - 1.0 - 1.09_f64.sqrt()).abs() < 0.1, "{}", area(&surface));
    }
}

/// The two sides of a ridge on the level are nothing but rounding: no triangle follows that.
#[test]
fn a_ridge_on_the_level_is_not_refined() {
    let mesh = kuhn_grid(2);
    let ridge = |p: &Vector| {
        let off = p.x + 0.3 * p.y - 0.45;
        (-off * off, -2.0 * off * Vector::new(1.0, 0.3, 0.0))
    };
    let [coarsest, fine] = [Fineness::PointsPerSide(2), Fineness::Tolerance(1e-3)]
        .map(|fineness| surface_of(&mesh, ridge, -1e-16, fineness).triangles.len());
    println!("{coarsest} {fine}");
    assert!(fine < 3 * coarsest, "{coarsest} {fine}");
}
