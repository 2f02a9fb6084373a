//! Refined meshes fill what they refine, and their cells fit together.

mod support;

use std::collections::HashMap;

use support::meshes::{Random, random_square};
use support::tetrahedra::{graded_cube, random_cube, shuffled};
use vtu2contour::field::Field;
use vtu2contour::interpolant::{
    Linear, Pci, TetrahedronCubics, TriangleCubics, Tricubic, bent_edges_of_tetrahedron,
    bent_edges_of_triangle,
};
use vtu2contour::mesh::{RefinedMesh, RefinedPiece, SimplexMesh, Vector, piece_edges};

use support::problem4;
use support::problems_3d::FIFTH;

/// Twice the area, or six times the volume, with sign in space or for a normal along z.
fn size<const CORNERS: usize>(corners: [Vector; CORNERS]) -> f64 {
    match corners[..] {
        [a, b, c] => (b - a).cross(&(c - a)).z,
        [a, b, c, d] => (b - a).cross(&(c - a)).dot(&(d - a)),
        _ => f64::NAN,
    }
}

/// How often each side is one of a piece: twice, but on the boundary.
fn sides<const CORNERS: usize>(pieces: &[[u32; CORNERS]]) -> HashMap<Vec<u32>, usize> {
    let mut sides = HashMap::new();
    for corners in pieces {
        for missing in 0..CORNERS {
            let mut side = corners.to_vec();
            side.remove(missing);
            side.sort_unstable();
            *sides.entry(side).or_insert(0) += 1;
        }
    }
    sides
}

/// The pieces fill their parents, are turned as these are, agree on sides, and their places
/// are where they are said to be. Returns how many sides are on the boundary.
fn check<const CORNERS: usize>(
    mesh: &SimplexMesh<CORNERS>,
    refined: &RefinedMesh<CORNERS>,
) -> usize {
    let mut filled = vec![0.0; mesh.simplices().len()];
    for piece in &refined.pieces {
        let parent = piece.parent as usize;
        let corners = piece.corners.map(|corner| refined.points[corner as usize]);
        let (part, whole) = (size(corners), size(mesh.corners(parent)));
        assert!(part * whole > 0.0);
        filled[parent] += part / whole;
        for (at, corner) in piece.at.iter().zip(corners) {
            assert!((mesh.position(parent, at) - corner).norm() < 1e-12);
        }
    }
    assert!(filled.iter().all(|filled| (filled - 1.0).abs() < 1e-9));
    for (place, point) in refined.places.iter().zip(&refined.points) {
        assert!((mesh.position(place.simplex as usize, &place.at) - point).norm() < 1e-12);
    }
    let pieces: Vec<[u32; CORNERS]> = refined.pieces.iter().map(|piece| piece.corners).collect();
    let sides = sides(&pieces);
    // a hanging point would leave sides inside that only one piece has
    assert!(sides.values().all(|count| *count <= 2));
    sides.values().filter(|count| **count == 1).count()
}

fn boundary<const CORNERS: usize>(mesh: &SimplexMesh<CORNERS>) -> usize {
    sides(mesh.simplices()).values().filter(|count| **count == 1).count()
}

#[test]
fn uniform_refinement() {
    let mut random = Random(1);
    let square = random_square(&mut random, 40);
    let cube = random_cube(&mut random, 40);
    let cube = shuffled(&mut random, &cube);
    for parts in [1, 2, 3, 5] {
        let n = parts as usize;
        let refined = RefinedMesh::uniform(&square, parts);
        assert_eq!(refined.pieces.len(), n * n * square.triangles().len());
        assert_eq!(check(&square, &refined), n * boundary(&square));
        let refined = RefinedMesh::uniform(&cube, parts);
        assert_eq!(refined.pieces.len(), n * n * n * cube.tetrahedra().len());
        assert_eq!(check(&cube, &refined), n * n * boundary(&cube));
    }
}

/// The boundary of the pieces is that of the mesh: nothing inside is open.
fn check_closed<const CORNERS: usize>(
    mesh: &SimplexMesh<CORNERS>,
    refined: &RefinedMesh<CORNERS>,
    on_boundary: impl Fn(&[Vector]) -> bool,
) {
    check(mesh, refined);
    let pieces: Vec<[u32; CORNERS]> = refined.pieces.iter().map(|piece| piece.corners).collect();
    for (side, count) in sides(&pieces) {
        let corners: Vec<Vector> = side.iter().map(|p| refined.points[*p as usize]).collect();
        assert_eq!(count, if on_boundary(&corners) { 1 } else { 2 }, "{corners:?}");
    }
}

fn on_a_face_of_the_cube(corners: &[Vector]) -> bool {
    let flush = |axis: usize, side: f64| corners.iter().all(|corner| corner[axis] == side);
    (0..3).any(|axis| flush(axis, 0.0) || flush(axis, 1.0))
}

#[test]
fn edges_divided_at_random() {
    let mut random = Random(2);
    let square = random_square(&mut random, 30);
    let cube = graded_cube(&mut random, 40);
    // an edge is named by chance, but by the same chance in all pieces
    fn by_chance<const CORNERS: usize>(
        piece: &RefinedPiece<CORNERS>,
        points: &[Vector],
    ) -> Vec<[usize; 2]> {
        let chance = |edge: &[usize; 2]| {
            let [a, b] = edge.map(|corner| piece.corners[corner]);
            (a * b + a + b) % 3 == 0 && points.len() < 1500
        };
        piece_edges::<CORNERS>().filter(chance).collect()
    }
    let mut refined = RefinedMesh::uniform(&square, 1);
    refined.divide(&square, 5_000, by_chance);
    assert!(refined.pieces.len() > 500);
    let on_side = |corners: &[Vector]| {
        let flush = |axis: usize, at: f64| corners.iter().all(|corner| corner[axis] == at);
        (0..2).any(|axis| flush(axis, 0.0) || flush(axis, 1.0))
    };
    check_closed(&square, &refined, on_side);
    let mut refined = RefinedMesh::uniform(&cube, 1);
    refined.divide(&cube, 5_000, by_chance);
    assert!(refined.pieces.len() > 1000);
    check_closed(&cube, &refined, on_a_face_of_the_cube);
}

/// With a tolerance the cubic is nowhere further from linear.
#[test]
fn a_tolerance_is_kept() {
    let mut random = Random(3);
    let square = random_square(&mut random, 60);
    let (values, gradients) = problem4::at_points(&square);
    let pci = Pci::new(&square, Field { values: &values, gradients: &gradients });
    let cubic = |piece: &RefinedPiece<3>| pci.cubic(piece.parent as usize);
    let tolerance = 0.01;
    let mut refined = RefinedMesh::uniform(&square, 1);
    let fine = refined.divide(&square, 1_000_000, |piece, points| {
        bent_edges_of_triangle(&cubic(piece), piece, points, tolerance)
    });
    assert!(fine);
    check(&square, &refined);
    for piece in &refined.pieces {
        let part = cubic(piece).sub_triangle(&piece.at);
        let at = [0.2, 0.3, 0.5];
        let straight: f64 = part.vertices().iter().zip(at).map(|(u, weight)| u * weight).sum();
        assert!((part.value(&at) - straight).abs() <= tolerance);
    }
    // less than the uniform mesh that is as fine
    let finest = refined.pieces.iter().map(|piece| {
        let corners = piece.corners.map(|corner| refined.points[corner as usize]);
        size(corners) / size(square.corners(piece.parent as usize))
    });
    let finest = finest.fold(1.0, f64::min);
    let uniform = square.triangles().len() as f64 / finest;
    assert!((refined.pieces.len() as f64) < 0.2 * uniform, "{} {uniform}", refined.pieces.len());
    // a linear function needs no refinement, and too many cells are not made
    let linear = Linear::new(&square, &values);
    let mut none = RefinedMesh::uniform(&square, 1);
    let marked = |piece: &RefinedPiece<3>, points: &[Vector]| {
        let cubic = TriangleCubics::cubic(&linear, piece.parent as usize);
        bent_edges_of_triangle(&cubic, piece, points, 1e-9)
    };
    assert!(none.divide(&square, 1_000_000, marked));
    assert_eq!(none.pieces.len(), square.triangles().len());
    let mut coarse = RefinedMesh::uniform(&square, 1);
    let fine = coarse.divide(&square, 1000, |piece, points| {
        bent_edges_of_triangle(&cubic(piece), piece, points, 1e-9)
    });
    assert!(!fine && coarse.pieces.len() <= 1000);
}

#[test]
fn a_tolerance_is_kept_in_space() {
    let cube = random_cube(&mut Random(4), 60);
    let (values, gradients) = FIFTH.at_points(&cube);
    let tricubic = Tricubic::new(&cube, Field { values: &values, gradients: &gradients });
    let cubic = |piece: &RefinedPiece<4>| tricubic.cubic(piece.parent as usize);
    let mut refined = RefinedMesh::uniform(&cube, 1);
    let fine = refined.divide(&cube, 1_000_000, |piece, points| {
        bent_edges_of_tetrahedron(&cubic(piece), piece, points, 0.02)
    });
    assert!(fine);
    check_closed(&cube, &refined, on_a_face_of_the_cube);
    for piece in &refined.pieces {
        let part = cubic(piece).sub_tetrahedron(&piece.at);
        let at = [0.1, 0.2, 0.3, 0.4];
        let straight: f64 = part.vertices().iter().zip(at).map(|(u, weight)| u * weight).sum();
        assert!((part.value(&at) - straight).abs() <= 0.02);
    }
}
