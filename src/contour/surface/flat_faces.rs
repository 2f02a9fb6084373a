//! Faces of the domain's boundary that lie on the level as a whole.
//!
//! They are part of the surface, each once, whichever side is higher. Rays end on them too: what
//! lies in such a face is left out there and added here. Faces inside the domain are left to the
//! patches, which draw them where they divide the level's sides.

use super::cell::Cell;
use super::lattice;
use super::owner::Owner;
use super::patch::PatchPoint;
use super::tessellation::Tessellation;
use crate::bernstein::{Barycentric4, Sign, TetrahedronCubic};
use crate::interruption::checkpoint;

/// A face on the level.
#[derive(Clone, Copy, Debug)]
pub struct FlatFace {
    /// Its cell, as a place among those that are active.
    cell: u32,
    /// The corner of the cell opposite.
    opposite: usize,
}

/// The faces that are drawn as a whole.
pub fn flat_faces(cells: &[Cell]) -> impl Iterator<Item = FlatFace> {
    cells.iter().enumerate().flat_map(|(place, cell)| {
        let flat = (0..4).filter(|&opposite| cell.flat[opposite]);
        flat.map(move |opposite| FlatFace { cell: place as u32, opposite })
    })
}

/// Leaves to the patches the faces that are not on the domain's boundary: those of two cells, all
/// of which are active at the level.
pub fn leave_to_patches(cells: &mut [Cell]) {
    let mut sides: Vec<([u32; 3], FlatFace)> = Vec::new();
    for face in flat_faces(cells) {
        checkpoint();
        let cell = &cells[face.cell as usize];
        let points = TetrahedronCubic::FACE_VERTICES[face.opposite].map(|n| cell.points[n]);
        sides.push((points, face));
    }
    sides.sort_unstable_by_key(|(points, _)| *points);
    for of_face in sides.chunk_by(|a, b| a.0 == b.0).filter(|of_face| of_face.len() > 1) {
        for (_, face) in of_face {
            cells[face.cell as usize].flat[face.opposite] = false;
        }
    }
}

/// Adds all faces that lie on the level; `sides` segments along each of their edges.
pub fn add_flat_faces(cells: &[Cell], sides: u32, tessellation: &mut Tessellation) {
    for face in flat_faces(cells) {
        add_face(&cells[face.cell as usize], &face, sides, tessellation);
    }
}

/// Whether a triangle lies in one of the faces of its cell that are drawn as a whole.
pub fn is_in_flat_face(cell: &Cell, corners: &[Barycentric4; 3]) -> bool {
    (0..4).any(|n| cell.flat[n] && corners.iter().all(|at| at[n] == 0.0))
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
    let opposite_is_above = side_of_cell(cell, face.opposite) == Sign::Above;
    let turned = opposite_is_behind != opposite_is_above;
    let triangles = lattice::triangles(sides, first);
    tessellation
        .triangles
        .extend(triangles.map(|[a, b, c]| if turned { [a, c, b] } else { [a, b, c] }));
}

/// On which side of the level a cell lies, next to one of its faces.
fn side_of_cell(cell: &Cell, opposite: usize) -> Sign {
    let mut beside = [0.3; 4];
    beside[opposite] = 0.1;
    cell.sign(&beside)
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
