//! The thesis' hybrid refinement: exact by hand, and what every refined mesh must be.

mod support;

use std::collections::HashSet;
use std::f64::consts::TAU;

use proptest::prelude::*;
use vtu2contour::mesh::{TriangleMesh, Vector};
use vtu2contour::refine::delaunay::{DelaunayError, DelaunayOptions, delaunay};
use vtu2contour::refine::{Marks, NewPoint, RefineError, Refinement};

use support::checked::{
    boundary, check, is_delaunay, is_symmetric, least_angle, mesh_of, on_circle,
};
use support::domains::Domain;
use support::meshes::{Random, grid, symmetric_grid};

fn plain() -> DelaunayOptions<'static> {
    DelaunayOptions { least_angle: 0.0, ..DelaunayOptions::default() }
}

fn refine(mesh: &TriangleMesh, marks: &[u32], options: &DelaunayOptions) -> Refinement<3> {
    let refined = delaunay(mesh, &Marks::all(marks), options).unwrap();
    check(mesh, options.regions, &refined, options.curves.is_empty());
    refined
}

fn mesh(points: &[[f64; 2]], cells: &[[u32; 3]]) -> TriangleMesh<'static> {
    let points = points.iter().map(|p| Vector::new(p[0], p[1], 0.0)).collect();
    TriangleMesh::new(points, cells.to_vec()).unwrap()
}

#[test]
fn a_circumcenter_by_hand() {
    // the middle one of nine triangles that make one
    let h = 3.0_f64.sqrt() / 2.0;
    let rows = (0..4).flat_map(|j| (0..4 - j).map(move |i| [i, j]));
    let points: Vec<[f64; 2]> =
        rows.map(|[i, j]| [f64::from(i) + 0.5 * f64::from(j), h * f64::from(j)]).collect();
    let cells = [
        [0, 1, 4],
        [1, 2, 5],
        [2, 3, 6],
        [1, 5, 4],
        [2, 6, 5],
        [4, 5, 7],
        [5, 6, 8],
        [5, 8, 7],
        [7, 8, 9],
    ];
    let mesh = mesh(&points, &cells);
    let refined = refine(&mesh, &[3], &plain());
    assert_eq!(refined.cells.len(), 11);
    let expected = (mesh.points()[1] + mesh.points()[5] + mesh.points()[4]) / 3.0;
    assert!((refined.points[10] - expected).norm() < 1e-15);
    assert_eq!(refined.parents.iter().filter(|&&parent| parent == 3).count(), 3);
    // the others are as they were
    assert!(cells.iter().filter(|cell| **cell != cells[3]).all(|c| refined.cells.contains(c)));
}

#[test]
fn the_middle_of_a_boundary_edge_by_hand() {
    // the circumcenter of a flat triangle is beyond its longest edge
    let flat = mesh(&[[0.0, 0.0], [4.0, 0.0], [2.0, 1.0]], &[[0, 1, 2]]);
    let refined = refine(&flat, &[0], &plain());
    assert_eq!(refined.points[3], Vector::new(2.0, 0.0, 0.0));
    assert_eq!(refined.new_points, [NewPoint::Edge { ends: [0, 1], at: 0.5 }]);
    assert_eq!(refined.cells.len(), 2);
    // clockwise cells stay clockwise, in any plane
    let points = flat.points().iter().map(|p| Vector::new(5.0, p.x, p.y)).collect();
    let turned = TriangleMesh::new(points, vec![[0, 2, 1]]).unwrap();
    let refined = delaunay(&turned, &Marks::all(&[0]), &plain()).unwrap();
    assert_eq!(refined.points[3], Vector::new(5.0, 2.0, 0.0));
    for &[a, b, c] in &refined.cells {
        let [a, b, c] = [a, b, c].map(|p| refined.points[p as usize]);
        assert!((b - a).cross(&(c - a)).x < 0.0);
    }
}

#[test]
fn the_centroid_by_hand() {
    // the circumcenter (2, -1.5) is beyond the boundary from (0, 0) to (5, -3), and the longest
    // edge is not on it
    let points = [[0.0, 0.0], [4.0, 0.0], [2.0, 1.0], [5.0, -3.0]];
    let two = mesh(&points, &[[0, 1, 2], [0, 3, 1]]);
    let refined = refine(&two, &[0], &plain());
    assert!((refined.points[4] - Vector::new(2.0, 1.0 / 3.0, 0.0)).norm() < 1e-15);
    // between two regions the same edge is as good as a boundary
    let options = DelaunayOptions { regions: &[1, 2], ..plain() };
    let refined = refine(&two, &[0], &options);
    assert_eq!(refined.new_points, [NewPoint::Edge { ends: [0, 1], at: 0.5 }]);
}

#[test]
fn one_circumcenter_of_two_right_triangles_is_one_point() {
    let square = grid(1);
    let refined = refine(&square, &[0, 1], &plain());
    assert_eq!(refined.points.len(), 5);
    assert_eq!(refined.points[4], Vector::new(0.5, 0.5, 0.0));
    assert_eq!(refined.cells.len(), 4);
}

#[test]
fn nothing_marked_changes_nothing() {
    let mesh = grid(3);
    let refined = delaunay(&mesh, &Marks::all(&[]), &plain()).unwrap();
    assert_eq!(
        (refined.points, refined.cells),
        (mesh.points().to_vec(), mesh.triangles().to_vec())
    );
}

/// A square with a square hole, as 8 by 8 squares without the middle 2 by 2.
fn with_hole() -> TriangleMesh<'static> {
    let all = grid(8);
    let kept = (0..all.triangles().len()).filter(|&cell| {
        let middle = all.position(cell, &[1.0 / 3.0; 3]) - Vector::new(0.5, 0.5, 0.0);
        middle.x.abs().max(middle.y.abs()) > 0.125
    });
    let cells = kept.map(|cell| all.triangles()[cell]).collect();
    TriangleMesh::new(all.points().to_vec(), cells).unwrap()
}

#[test]
fn holes_and_interfaces_stay() {
    let mesh = with_hole();
    let regions: Vec<u32> = (0..mesh.triangles().len())
        .map(|cell| u32::from(mesh.position(cell, &[1.0 / 3.0; 3]).x > 0.5))
        .collect();
    let options = DelaunayOptions { regions: &regions, ..DelaunayOptions::default() };
    let (mut mesh, mut regions) = (mesh, options.regions.to_vec());
    for step in 0..4 {
        let marks: Vec<u32> = (0..mesh.triangles().len() as u32)
            .filter(|&cell| {
                (mesh.corners(cell as usize)[0] - Vector::new(0.375, 0.4, 0.0)).norm() < 0.3
            })
            .collect();
        let options = DelaunayOptions { regions: &regions, ..options };
        let refined = refine(&mesh, &marks, &options);
        let next = mesh_of(&refined);
        assert!(least_angle(&next, |_| true) >= 20.0, "step {step}");
        regions = refined.parents.iter().map(|&parent| regions[parent as usize]).collect();
        mesh = next;
    }
    assert!(mesh.triangles().len() > 500);
}

#[test]
fn new_points_of_a_curved_boundary_are_on_it() {
    let polyline: Vec<Vector> =
        (0..=720).map(|k| on_circle(1.0, TAU * f64::from(k % 720) / 720.0)).collect();
    let inner: Vec<Vector> = polyline.iter().map(|p| p * 0.4).collect();
    let [_, _, _, annulus] = Domain::all(0.5);
    let mut mesh = annulus.mesh(&mut Random(1), 0.5);
    // the generator's points are on the circles, but not on the polylines' corners
    let curves = [polyline, inner];
    let options = DelaunayOptions { curves: &curves, ..DelaunayOptions::default() };
    let on_polyline = |p: &Vector| {
        let nearest = |radius: f64| (p.norm() - radius).abs() < 1e-4;
        nearest(1.0) || nearest(0.4)
    };
    for _ in 0..3 {
        let all: Vec<u32> = (0..mesh.triangles().len() as u32).collect();
        let refined = refine(&mesh, &all, &options);
        mesh = mesh_of(&refined);
    }
    let ends: HashSet<u32> = boundary(&mesh).into_iter().flatten().collect();
    let off = ends.iter().filter(|&&end| !on_polyline(&mesh.points()[end as usize])).count();
    assert_eq!(off, 0, "of {}", ends.len());
    assert!(ends.len() > 36, "{}", ends.len());
}

/// An interface that is curved stays one, and gets onto its curve: cells between the old edge and
/// the curve belong to the region that they lie in now.
#[test]
fn an_interface_may_be_curved() {
    let sides = 8;
    let ring = |radius: f64| {
        (0..sides).map(move |k| on_circle(radius, TAU * f64::from(k) / f64::from(sides)))
    };
    let points: Vec<Vector> =
        [Vector::zeros()].into_iter().chain(ring(0.5)).chain(ring(1.0)).collect();
    let n = sides as u32;
    let mut cells: Vec<[u32; 3]> = (0..n).map(|k| [0, 1 + k, 1 + (k + 1) % n]).collect();
    for k in 0..n {
        let [a, b] = [1 + k, 1 + (k + 1) % n];
        cells.extend([[a, a + n, b + n], [a, b + n, b]]);
    }
    let mut regions: Vec<u32> = (0..3 * n).map(|cell| u32::from(cell < n)).collect();
    let mut mesh = TriangleMesh::new(points, cells).unwrap();
    let curves = [(0..=720).map(|k| on_circle(0.5, TAU * f64::from(k % 720) / 720.0)).collect()];
    for _ in 0..4 {
        let options = DelaunayOptions { regions: &regions, curves: &curves, ..Default::default() };
        let all: Vec<u32> = (0..mesh.triangles().len() as u32).collect();
        let refined = refine(&mesh, &all, &options);
        regions = refined.parents.iter().map(|&parent| regions[parent as usize]).collect();
        mesh = mesh_of(&refined);
    }
    let inner = (0..mesh.triangles().len()).filter(|&cell| regions[cell] == 1);
    let disk = TriangleMesh::new(
        mesh.points().to_vec(),
        inner.map(|cell| mesh.triangles()[cell]).collect(),
    );
    let rim: HashSet<u32> = boundary(&disk.unwrap()).into_iter().flatten().collect();
    assert!(rim.len() >= 32, "{}", rim.len());
    assert!(rim.iter().all(|&p| (mesh.points()[p as usize].norm() - 0.5).abs() < 1e-5));
}

#[test]
fn symmetric_meshes_stay_symmetric() {
    for options in [plain(), DelaunayOptions::default()] {
        let mut mesh = symmetric_grid(8);
        assert!(is_symmetric(&mesh));
        for step in 0..5 {
            // what is near the peak of the thesis' second problem, nearest first
            let mut near: Vec<(f64, u32)> = (0..mesh.triangles().len() as u32)
                .map(|cell| {
                    let middle = mesh.position(cell as usize, &[1.0 / 3.0; 3]);
                    ((middle - Vector::new(0.5, 0.117, 0.0)).norm(), cell)
                })
                .filter(|(distance, _)| *distance < 0.5 / f64::from(step + 1))
                .collect();
            near.sort_by(|one, other| one.0.total_cmp(&other.0));
            let marks: Vec<u32> = near.into_iter().map(|(_, cell)| cell).collect();
            let refined = refine(&mesh, &marks, &options);
            mesh = mesh_of(&refined);
            assert!(is_symmetric(&mesh), "step {step}, {} points", mesh.points().len());
        }
        assert!(mesh.points().len() > 200);
    }
}

#[test]
fn the_bound_on_points_is_met_exactly() {
    let mesh = grid(10);
    let all: Vec<u32> = (0..mesh.triangles().len() as u32).collect();
    for max_points in [121, 122, 150, 200] {
        for options in [plain(), DelaunayOptions::default()] {
            let marks = Marks { max_points, ..Marks::all(&all) };
            let refined = delaunay(&mesh, &marks, &options).unwrap();
            check(&mesh, &[], &refined, true);
            assert_eq!(refined.points.len(), max_points);
        }
    }
    // the neediest is served first
    let marks = Marks { max_points: 122, ..Marks::all(&[77, 3]) };
    let refined = delaunay(&mesh, &marks, &plain()).unwrap();
    assert!((refined.points[121] - mesh.position(77, &[1.0 / 3.0; 3])).norm() < 0.05);
}

#[test]
fn bad_input_is_refused() {
    let refused = |points: &[[f64; 2]], cells: &[[u32; 3]]| {
        delaunay(&mesh(points, cells), &Marks::all(&[0]), &plain()).unwrap_err()
    };
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let with = |more: &[[f64; 2]]| [&square[..], more].concat();
    assert_eq!(
        refused(&with(&[[0.0, 0.0]]), &[[0, 1, 2], [4, 2, 3]]),
        DelaunayError::DuplicatePoints { first: 0, second: 4 }
    );
    // unused points are no points of the domain
    let unused = mesh(&with(&[[0.0, 0.0], [0.1, 0.2]]), &[[0, 1, 2], [0, 2, 3]]);
    assert_eq!(refine(&unused, &[0], &plain()).points.len(), 7);
    let crossing = refused(&with(&[[0.5, -1.0], [0.5, 0.5], [2.0, 0.5]]), &[[0, 1, 2], [4, 6, 5]]);
    assert!(matches!(crossing, DelaunayError::CrossingEdges { .. }), "{crossing}");
    let hanging = refused(&with(&[[0.5, 0.5]]), &[[0, 1, 2], [0, 4, 3], [4, 2, 3]]);
    assert!(matches!(hanging, DelaunayError::CrossingEdges { .. }), "{hanging}");
    assert_eq!(
        refused(&with(&[[2.0, 1.0], [2.0, 2.0]]), &[[0, 1, 2], [2, 4, 5]]),
        DelaunayError::TouchingBoundaries { point: 2 }
    );
    let flat = refused(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], &[[0, 1, 2]]);
    assert_eq!(flat, DelaunayError::NoArea { cell: 0 });
    let bent = vec![Vector::zeros(), Vector::x(), Vector::y(), Vector::new(1.0, 1.0, 0.3)];
    let bent = TriangleMesh::new(bent, vec![[0, 1, 2], [2, 1, 3]]).unwrap();
    let error = delaunay(&bent, &Marks::all(&[0]), &plain()).unwrap_err();
    assert!(matches!(error, DelaunayError::NotInPlane { .. }));
    let mark = delaunay(&grid(1), &Marks::all(&[2]), &plain()).unwrap_err();
    assert_eq!(mark, DelaunayError::Marks(RefineError::NoSuchCell { cell: 2, cells: 2 }));
    let options = DelaunayOptions { regions: &[1], ..plain() };
    let regions = delaunay(&grid(1), &Marks::all(&[0]), &options).unwrap_err();
    assert_eq!(regions, DelaunayError::Regions { regions: 1, cells: 2 });
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]
    /// Domains with acute and reentrant corners, holes and uneven meshes, any cells marked.
    #[test]
    fn refined_meshes_are_meshes(seed in 0..1000_u64, part in 0.02..1.0f64, which in 0..4_usize, keep_angles: bool) {
        let mut random = Random(seed);
        let mut mesh = Domain::all(0.4)[which].mesh(&mut random, 0.4);
        let mut regions: Vec<u32> = (0..mesh.triangles().len())
            .map(|cell| u32::from(mesh.position(cell, &[1.0 / 3.0; 3]).y > 0.3))
            .collect();
        for _ in 0..2 {
            let marks: Vec<u32> =
                (0..mesh.triangles().len() as u32).filter(|_| random.uniform(0.0, 1.0) < part).collect();
            let least_angle = if keep_angles { 20.0 } else { 0.0 };
            let options = DelaunayOptions { regions: &regions, least_angle, ..plain() };
            let refined = refine(&mesh, &marks, &options);
            regions = refined.parents.iter().map(|&parent| regions[parent as usize]).collect();
            mesh = mesh_of(&refined);
        }
    }

    /// Where no two kept edges make a small angle, no new one is small.
    #[test]
    fn angles_are_kept(seed in 0..1000_u64, part in 0.02..1.0f64, which in 0..4_usize) {
        let mut random = Random(seed);
        let mesh = Domain::all(0.3)[which].mesh(&mut random, 0.3);
        let marks: Vec<u32> =
            (0..mesh.triangles().len() as u32).filter(|_| random.uniform(0.0, 1.0) < part).collect();
        let refined = refine(&mesh, &marks, &DelaunayOptions::default());
        let old = mesh.points().len() as u32;
        let is_new = |cell: usize| refined.cells[cell].iter().any(|&point| point >= old);
        let fine = mesh_of(&refined);
        prop_assert!(least_angle(&fine, is_new) >= 20.0);
        prop_assert!(is_delaunay(&fine, |_| false));
    }
}
