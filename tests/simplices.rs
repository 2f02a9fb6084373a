//! All cell types as simplices: volumes, orientation, and that neighbours fit.

mod support;

use std::collections::HashMap;

use proptest::prelude::*;
use support::cells::Cells;
use support::meshes::Random;
use vtu2contour::mesh::Vector;
use vtu2contour::simplices::{Reason, SplitGrid};
use vtu2contour::vtk::{DataArray, Polyhedra, UnstructuredGrid};

fn volume(split: &SplitGrid, corners: &[u32; 4]) -> f64 {
    let [a, b, c, d] = corners.map(|point| split.points[point as usize]);
    (b - a).cross(&(c - a)).dot(&(d - a)) / 6.0
}

fn volumes(split: &SplitGrid) -> Vec<f64> {
    split.tetrahedra.simplices.iter().map(|corners| volume(split, corners)).collect()
}

fn area(split: &SplitGrid) -> f64 {
    let doubled = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|point| split.points[point as usize]);
        (b - a).cross(&(c - a)).norm()
    };
    split.triangles.simplices.iter().map(doubled).sum::<f64>() / 2.0
}

/// Faces that belong to one tetrahedron only; none may belong to more than two.
fn boundary(split: &SplitGrid) -> Vec<[u32; 3]> {
    let mut counts: HashMap<[u32; 3], usize> = HashMap::new();
    for &[a, b, c, d] in &split.tetrahedra.simplices {
        for mut face in [[a, b, c], [a, b, d], [a, c, d], [b, c, d]] {
            face.sort_unstable();
            *counts.entry(face).or_default() += 1;
        }
    }
    assert!(counts.values().all(|&count| count <= 2));
    counts.into_iter().filter(|&(_, count)| count == 1).map(|(face, _)| face).collect()
}

/// Checks that the cells fill the unit cube without cracks.
fn check_cube(cells: &Cells) {
    let split = SplitGrid::new(&cells.grid()).unwrap();
    assert_eq!(split.left_out.total(), 0);
    let volumes = volumes(&split);
    assert!(volumes.iter().all(|&volume| volume > 0.0));
    assert!((volumes.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{}", volumes.iter().sum::<f64>());
    for face in boundary(&split) {
        let corners = face.map(|point| split.points[point as usize]);
        let on_a_side = (0..3).any(|axis| {
            [0.0, 1.0].iter().any(|side| corners.iter().all(|corner| corner[axis] == *side))
        });
        assert!(on_a_side, "a crack at {face:?}");
    }
    let parents = &split.tetrahedra.parents;
    assert_eq!(parents.len(), volumes.len());
    assert!(parents.windows(2).all(|pair| pair[0] <= pair[1]));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn linear_cells_fit_together(seed: u64, n in 1..4_usize) {
        let random = &mut Random(seed);
        check_cube(&Cells::cube(n, 0.15, &[12, 13, 14, 42], random).renumbered(random));
    }

    /// Hexahedra with nodes inside four faces, along one direction.
    #[test]
    fn hexahedra_of_24_nodes_fit_together(seed: u64, n in 1..3_usize) {
        let random = &mut Random(seed);
        let mut cells = Cells::cube(n, 0.15, &[12], random).quadratic(true);
        for (cell_type, nodes) in &mut cells.cells {
            *cell_type = 33;
            nodes.truncate(24);
        }
        check_cube(&cells.renumbered(random));
    }

    #[test]
    fn quadratic_cells_fit_together(seed: u64, n in 1..3_usize, inner: bool) {
        let random = &mut Random(seed);
        check_cube(&Cells::cube(n, 0.15, &[12, 13, 14], random).quadratic(inner).renumbered(random));
    }
}

fn grid(points: &[[f64; 3]], cells: &[(u8, &[i64])]) -> UnstructuredGrid {
    let coordinates: Vec<f64> = points.iter().flatten().copied().collect();
    let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, coordinates));
    cells.iter().for_each(|(cell_type, points)| grid.push_cell(*cell_type, points));
    grid
}

const BOX: [[f64; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [2.0, 0.0, 0.0],
    [2.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [2.0, 0.0, 1.0],
    [2.0, 1.0, 1.0],
    [0.0, 1.0, 1.0],
];

/// Solvers write wedges, pyramids and tetrahedra as hexahedra that name corners
/// twice: these are cut as what they are, and fit to their neighbours.
#[test]
fn collapsed_hexahedra_are_what_they_look_like() {
    let cases: [(&[i64], u8, &[i64]); 4] = [
        (&[0, 1, 2, 2, 4, 5, 6, 6], 13, &[0, 1, 2, 4, 5, 6]),
        (&[0, 1, 2, 3, 4, 4, 4, 4], 14, &[0, 1, 2, 3, 4]),
        (&[0, 1, 2, 2, 5, 5, 5, 5], 10, &[0, 1, 2, 5]),
        (&[3, 3, 1, 2, 6, 6, 6, 6], 10, &[3, 1, 2, 6]),
    ];
    for (collapsed, cell_type, points) in cases {
        let one = SplitGrid::new(&grid(&BOX, &[(12, collapsed)])).unwrap();
        let other = SplitGrid::new(&grid(&BOX, &[(cell_type, points)])).unwrap();
        let sorted = |split: &SplitGrid| {
            let mut tetrahedra = split.tetrahedra.simplices.clone();
            tetrahedra.iter_mut().for_each(|corners| corners.sort_unstable());
            tetrahedra.sort_unstable();
            tetrahedra
        };
        assert_eq!(sorted(&one), sorted(&other), "{collapsed:?}");
        assert!(
            (volumes(&one).iter().sum::<f64>() - volumes(&other).iter().sum::<f64>()).abs() < 1e-14
        );
        assert!(one.folded.total() == 0 && one.left_out.total() == 0);
    }
    let nothing = SplitGrid::new(&grid(&BOX, &[(12, &[0, 1, 2, 3, 0, 1, 2, 3])])).unwrap();
    assert_eq!(nothing.left_out.to_string(), "1 hexahedra (collapsed to nothing)");
}

proptest! {
    /// A quadratic hexahedron collapsed to a quadratic wedge, pyramid or tetrahedron,
    /// in any numbering, is cut as that.
    #[test]
    fn collapsed_quadratic_hexahedra_too(seed: u64, case in 0..3_usize) {
        let corners: [u32; 8] =
            [[0, 1, 2, 2, 4, 5, 6, 6], [0, 1, 2, 3, 4, 4, 4, 4], [0, 1, 2, 2, 5, 5, 5, 5]][case];
        let (cell_type, plain): (u8, &[u32]) =
            [(13, &[0, 1, 2, 4, 5, 6][..]), (14, &[0, 1, 2, 3, 4]), (10, &[0, 1, 2, 5])][case];
        let mut cells = Cells { points: BOX.map(Vector::from).to_vec(), ..Cells::default() };
        cells.cells.push((12, corners.to_vec()));
        cells.cells.push((cell_type, plain.to_vec()));
        let cells = cells.quadratic(false).renumbered(&mut Random(seed));
        let split = SplitGrid::new(&cells.grid()).unwrap();
        prop_assert_eq!(split.left_out.total(), 0);
        let mut halves: [Vec<[u32; 4]>; 2] = Default::default();
        for (corners, &parent) in split.tetrahedra.simplices.iter().zip(&split.tetrahedra.parents) {
            let mut corners = *corners;
            corners.sort_unstable();
            halves[parent as usize].push(corners);
        }
        halves.iter_mut().for_each(|half| half.sort_unstable());
        prop_assert_eq!(&halves[0], &halves[1]);
    }

    /// A polygon's area is that of its triangles, whatever its shape and plane.
    #[test]
    fn star_shaped_polygons_keep_their_area(
        radii in prop::collection::vec(0.2..2.0f64, 3..40),
        tilt in 0.0..3.0f64,
        start in 0..40_usize,
    ) {
        let count = radii.len();
        let corner = |n: usize| {
            let (sin, cos) = (std::f64::consts::TAU * n as f64 / count as f64).sin_cos();
            [radii[n] * cos, radii[n] * sin * tilt.cos(), radii[n] * sin * tilt.sin()]
        };
        let points: Vec<[f64; 3]> = (0..count).map(corner).collect();
        let order: Vec<i64> = (0..count).map(|n| ((n + start) % count) as i64).collect();
        let split = SplitGrid::new(&grid(&points, &[(7, &order)])).unwrap();
        let step = std::f64::consts::TAU / count as f64;
        let expected: f64 =
            (0..count).map(|n| radii[n] * radii[(n + 1) % count] * step.sin() / 2.0).sum();
        prop_assert_eq!(split.triangles.simplices.len(), count - 2);
        prop_assert!((area(&split) - expected).abs() < 1e-11 * expected.max(1.0));
    }
}

/// A comb with eleven teeth, corners in the middle of straight edges included.
#[test]
fn a_comb_is_cut_inside() {
    let mut points = vec![[22.0, -1.0, 0.0], [11.0, -1.0, 0.0], [0.0, -1.0, 0.0]];
    for tooth in 0..11 {
        let x = f64::from(2 * tooth);
        points.extend([[x, 0.0, 0.0], [x, 5.0, 0.0], [x + 1.0, 5.0, 0.0], [x + 1.0, 0.0, 0.0]]);
    }
    points.push([22.0, 0.0, 0.0]);
    let corners: Vec<i64> = (0..points.len() as i64).rev().collect();
    let split = SplitGrid::new(&grid(&points, &[(7, &corners)])).unwrap();
    assert_eq!(split.left_out.total(), 0);
    assert!((area(&split) - 77.0).abs() < 1e-12, "{}", area(&split));
}

#[test]
fn a_dented_quad_is_cut_at_its_dent() {
    let dart = [[2.0, 2.0, 0.0], [1.0, 0.8, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0]];
    for start in 0..4 {
        // the dent has each number once
        let mut points = dart;
        points.rotate_left(start);
        let split = SplitGrid::new(&grid(&points, &[(9, &[0, 1, 2, 3])])).unwrap();
        assert!((area(&split) - 1.0).abs() < 1e-14, "{}", area(&split));
    }
}

#[test]
fn what_cannot_be_cut_is_counted_with_its_reason() {
    let cells: [(u8, &[i64]); 15] = [
        (5, &[0, 1, 2]),
        (3, &[0, 1]),
        (1, &[0]),
        (5, &[0, 1, 1]),
        (5, &[0, 1]),
        (7, &[0, 2, 1, 3, 4]),
        (7, &[0, 2]),
        (12, &[0, 1, 2, 3, 4, 5, 6]),
        (41, &[0, 1, 2, 3, 4]),
        (42, &[0, 1, 2, 3]),
        (70, &[0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7]),
        (70, &[0, 1, 2]),
        (200, &[0, 1, 2]),
        (10, &[0, 1, 2, 2]),
        (24, &[0, 1, 2, 2, 3, 4, 5, 6, 7, 3]),
    ];
    let split = SplitGrid::new(&grid(&BOX, &cells)).unwrap();
    assert_eq!(split.triangles.simplices, [[0, 1, 2]]);
    assert_eq!(split.tetrahedra.simplices.len(), 0);
    let reasons: Vec<(u8, Reason, usize)> = split.left_out.iter().collect();
    assert_eq!(
        reasons,
        [
            (5, Reason::PointCount, 1),
            (5, Reason::Collapsed, 1),
            (7, Reason::PointCount, 1),
            (7, Reason::CrossingEdges, 1),
            (10, Reason::Collapsed, 1),
            (12, Reason::PointCount, 1),
            (24, Reason::Collapsed, 1),
            (41, Reason::Unsupported, 1),
            (42, Reason::OpenSurface, 1),
            (70, Reason::HighOrder, 1),
            (70, Reason::PointCount, 1),
            (200, Reason::Unsupported, 1),
        ]
    );
}

/// An L-shaped prism: one polyhedron of eight faces.
fn l_shape(shift: f64) -> UnstructuredGrid {
    let outline =
        [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0 + shift, 1.0 + shift], [1.0, 2.0], [0.0, 2.0]];
    let points: Vec<[f64; 3]> =
        [0.0, 1.0].iter().flat_map(|&z| outline.map(|[x, y]| [x, y, z])).collect();
    let all: Vec<i64> = (0..12).collect();
    let mut grid = grid(&points, &[(42, &all)]);
    let mut polyhedra = Polyhedra::default();
    polyhedra.faces.push(&[0, 1, 2, 3, 4, 5]);
    polyhedra.faces.push(&[6, 7, 8, 9, 10, 11]);
    for n in 0..6 {
        let next = (n + 1) % 6;
        polyhedra.faces.push(&[n, next, next + 6, n + 6]);
    }
    polyhedra.cells.push(&[0, 1, 2, 3, 4, 5, 6, 7]);
    grid.polyhedra = Some(polyhedra);
    grid
}

#[test]
fn polyhedra_may_fold_a_little() {
    // convex; an L seen from its outer corner, which sees all of it
    for (shift, total) in [(0.5, 3.5), (0.0, 3.0)] {
        let split = SplitGrid::new(&l_shape(shift)).unwrap();
        assert_eq!((split.left_out.total(), split.folded.total()), (0, 0));
        assert!(
            (volumes(&split).iter().sum::<f64>() - total).abs() < 1e-12,
            "{:?}",
            volumes(&split)
        );
    }
    // with corners numbered from the end of an arm, no longer
    let mut turned = l_shape(0.0);
    let points = turned.points.to_f64().unwrap();
    let moved = [
        points[6..18].to_vec(),
        points[0..6].to_vec(),
        points[24..36].to_vec(),
        points[18..24].to_vec(),
    ];
    turned.points = DataArray::new("Points", 3, moved.concat());
    let split = SplitGrid::new(&turned).unwrap();
    assert_eq!(split.left_out.to_string(), "1 polyhedra (far from convex)");
    assert!(split.tetrahedra.simplices.is_empty() && split.tetrahedra.parents.is_empty());
}

#[test]
fn inverted_cells_come_out_positive() {
    let cells: [(u8, &[i64]); 3] =
        [(12, &[4, 5, 6, 7, 0, 1, 2, 3]), (13, &[0, 2, 1, 4, 6, 5]), (10, &[0, 2, 1, 4])];
    let split = SplitGrid::new(&grid(&BOX, &cells)).unwrap();
    let volumes = volumes(&split);
    assert!(volumes.iter().all(|&volume| volume > 0.0) && split.folded.total() == 0);
    assert!((volumes.iter().sum::<f64>() - (2.0 + 1.0 + 1.0 / 3.0)).abs() < 1e-14);
}

#[test]
fn a_folded_hexahedron_is_kept_and_counted() {
    let mut dented = BOX;
    dented[7] = [1.5, 0.2, 0.5];
    let split = SplitGrid::new(&grid(&dented, &[(12, &[0, 1, 2, 3, 4, 5, 6, 7])])).unwrap();
    assert_eq!((split.folded.to_string().as_str(), split.left_out.total()), ("1 hexahedra", 0));
    assert!(volumes(&split).iter().all(|&volume| volume > 0.0));
}

#[test]
fn contradictions_are_refused() {
    let refused = SplitGrid::new(&grid(&BOX, &[(5, &[0, 1, 8])])).unwrap_err().to_string();
    assert!(refused.starts_with("the cells do not fit the points"), "{refused}");
    let mut bad = l_shape(0.0);
    bad.polyhedra.as_mut().unwrap().faces.push(&[0, 1, 99]);
    assert!(SplitGrid::new(&bad).is_err());
    // a face that is not there, or missing, or twice
    for numbers in
        [&[0, 1, 2, 3, 4, 5, 6, 9][..], &[0, 1, 2, 3, 4, 5, 6], &[0, 1, 2, 3, 4, 5, 6, 7, 7]]
    {
        let mut open = l_shape(0.0);
        let polyhedra = open.polyhedra.as_mut().unwrap();
        polyhedra.cells = Default::default();
        polyhedra.cells.push(numbers);
        let split = SplitGrid::new(&open).unwrap();
        assert_eq!(split.left_out.iter().next(), Some((42, Reason::OpenSurface, 1)));
    }
}

/// Quads, pixels, strips and the quadratic kinds, by area.
#[test]
fn two_dimensional_cells_keep_their_area() {
    let mut points = vec![];
    for y in 0..3 {
        points.extend((0..3).map(|x| [f64::from(x), f64::from(y), 0.0]));
    }
    let cells: [(u8, &[i64], f64); 12] = [
        (9, &[0, 2, 8, 6], 4.0),
        (8, &[0, 2, 6, 8], 4.0),
        (6, &[0, 2, 6, 8], 4.0),
        (6, &[0, 2, 6, 6, 8], 2.0),
        (7, &[0, 1, 2, 8, 6], 4.0),
        (22, &[0, 2, 6, 1, 4, 3], 2.0),
        (34, &[0, 2, 6, 1, 4, 3, 4], 2.0),
        (23, &[0, 2, 8, 6, 1, 5, 7, 3], 4.0),
        (23, &[0, 2, 6, 6, 1, 4, 6, 3], 2.0),
        (28, &[0, 2, 8, 6, 1, 5, 7, 3, 4], 4.0),
        (30, &[0, 2, 8, 6, 1, 7], 4.0),
        (36, &[0, 2, 8, 6, 1, 5, 7, 3], 4.0),
    ];
    for (cell_type, nodes, expected) in cells {
        let split = SplitGrid::new(&grid(&points, &[(cell_type, nodes)])).unwrap();
        assert!((area(&split) - expected).abs() < 1e-14, "{cell_type}: {}", area(&split));
        assert_eq!(split.left_out.total(), 0);
        // all in the direction of the cell
        for corners in &split.triangles.simplices {
            let [a, b, c] = corners.map(|point| split.points[point as usize]);
            assert!((b - a).cross(&(c - a)).z >= 0.0, "{cell_type}: {corners:?}");
        }
    }
}
