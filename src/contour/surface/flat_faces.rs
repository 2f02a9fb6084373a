//! Faces of the mesh that lie on the level as a whole.
//!
//! They are part of the surface, each once, whichever side is higher; except between two
//! cells that lie on the level as a whole. Those between the two sides of the level are left to
//! the patches. Rays end on the others too: what lies in such a face is left out there and added
//! here.

use super::cell::Cell;
use super::lattice;
use super::owner::Owner;
use super::patch::PatchPoint;
use super::tessellation::Tessellation;
use crate::bernstein::{Sign, TetrahedronCubic};

/// A face on the level, seen from one of its cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FlatFace {
    /// The numbers of its corners, ascending.
    points: [u32; 3],
    /// Whether the whole cell lies on the level.
    in_flat_cell: bool,
    /// The cell, as a place among those that are active.
    cell: u32,
    /// The corner of the cell opposite.
    opposite: usize,
}

/// The faces that lie on the level and are drawn, each seen from one of its cells.
pub fn flat_faces(cells: &[Cell]) -> Vec<FlatFace> {
    let mut faces: Vec<FlatFace> = Vec::new();
    for (place, cell) in cells.iter().enumerate() {
        let in_flat_cell = cell.cubic.coefficients == [0.0; 20];
        for opposite in (0..4).filter(|&face| cell.flat[face]) {
            let points = TetrahedronCubic::FACE_VERTICES[opposite].map(|n| cell.points[n]);
            faces.push(FlatFace { points, in_flat_cell, cell: place as u32, opposite });
        }
    }
    faces.sort_unstable();
    // sorted, so a cell that is not flat comes first; a face of flat cells alone is drawn on the
    // boundary only
    let of_face = faces.chunk_by(|a, b| a.points == b.points);
    of_face.filter(|face| !face[0].in_flat_cell || face.len() == 1).map(|face| face[0]).collect()
}

/// Leaves to the patches the faces inside the mesh that have the level's two sides beside them:
/// these are drawn once, from below, and are cut where another part of the surface runs into them.
/// Whole are drawn those at which the level is touched only, for which there are no patches.
pub fn leave_to_patches(cells: &mut [Cell]) {
    let mut sides: Vec<([u32; 3], usize, usize)> = Vec::new();
    for (place, cell) in cells.iter().enumerate() {
        for opposite in (0..4).filter(|&face| cell.flat[face]) {
            let points = TetrahedronCubic::FACE_VERTICES[opposite].map(|n| cell.points[n]);
            sides.push((points, place, opposite));
        }
    }
    sides.sort_unstable();
    for of_face in sides.chunk_by(|a, b| a.0 == b.0) {
        let &[(_, one, of_one), (_, other, of_other)] = of_face else { continue };
        let beside = [sides_beside(&cells[one], of_one), sides_beside(&cells[other], of_other)];
        if beside != [[Sign::Above; 2]; 2] && beside != [[Sign::Below; 2]; 2] {
            cells[one].flat[of_one] = false;
            cells[other].flat[of_other] = false;
        }
    }
}

/// The sides on which a cell may lie beside a face that is on the level, the lowest and the
/// highest.
fn sides_beside(cell: &Cell, opposite: usize) -> [Sign; 2] {
    let mut layers = [[0.0_f64; 2]; 4];
    TetrahedronCubic::from_coefficients(|exponents| {
        let value = cell.cubic.coefficient(exponents);
        let [low, high] = &mut layers[exponents[opposite]];
        (*low, *high) = (low.min(value), high.max(value));
        value
    });
    match layers.into_iter().find(|layer| *layer != [0.0; 2]) {
        Some([_, high]) if high <= 0.0 => [Sign::Below; 2],
        Some([low, _]) if low < 0.0 => [Sign::Below, Sign::Above],
        _ => [Sign::Above; 2],
    }
}

/// Adds all faces that lie on the level; `sides` segments along each of their edges.
pub fn add_flat_faces(cells: &[Cell], sides: u32, tessellation: &mut Tessellation) {
    for face in flat_faces(cells) {
        add_face(&cells[face.cell as usize], &face, sides, tessellation);
    }
}

/// Whether three points of a cell lie in one of its faces that is on the level.
pub fn are_in_flat_face(cell: &Cell, points: [&PatchPoint; 3]) -> bool {
    (0..4).any(|n| cell.flat[n] && points.iter().all(|point| point.at[n] == 0.0))
}

fn add_face(cell: &Cell, face: &FlatFace, sides: u32, tessellation: &mut Tessellation) {
    let corners = TetrahedronCubic::FACE_VERTICES[face.opposite];
    let first = tessellation.points.len() as u32;
    for weights in lattice::points(sides) {
        let weights = weights.map(|weight| f64::from(weight) / f64::from(sides));
        tessellation.points.push(point(cell, corners, weights));
        tessellation.rays.push([0.0; 4]);
        tessellation.point_cells.push(face.cell);
    }
    // right-handed with the opposite corner first: its side is behind the face
    let even = face.opposite.is_multiple_of(2);
    let opposite_is_behind = cell.right_handed == even;
    let opposite_is_above = Sign::of(side_of_cell(cell, face.opposite)) == Sign::Above;
    let turned = opposite_is_behind != opposite_is_above;
    let triangles = lattice::triangles(sides, first);
    tessellation
        .triangles
        .extend(triangles.map(|[a, b, c]| if turned { [a, c, b] } else { [a, b, c] }));
}

/// A value that tells on which side of the level a cell lies, next to one of its faces.
fn side_of_cell(cell: &Cell, opposite: usize) -> f64 {
    let mut beside = [0.3; 4];
    beside[opposite] = 0.1;
    cell.cubic.value(&beside)
}

fn point(cell: &Cell, corners: [usize; 3], weights: [f64; 3]) -> PatchPoint {
    let mut at = [0.0; 4];
    for (corner, weight) in corners.into_iter().zip(weights) {
        at[corner] = weight;
    }
    let held: Vec<usize> = corners.into_iter().filter(|&corner| at[corner] != 0.0).collect();
    let owner = match held[..] {
        [only] => Owner::Vertex(cell.points[only]),
        [low, high] => Owner::OnEdge {
            low: cell.points[low],
            high: cell.points[high],
            weight: at[high].to_bits(),
        },
        _ => Owner::Patch,
    };
    PatchPoint { owner, at, position: cell.position(&at) }
}
