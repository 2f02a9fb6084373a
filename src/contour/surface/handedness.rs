//! Which way round slivers are.
//!
//! Triangles turn as the handedness of their cell says. A cell with a volume shows it by itself;
//! one whose volume is rounding, or zero, has that which its neighbours leave to it: two cells
//! turn their common face in opposite directions. Delaunay meshes of regular points are full of
//! such cells, with corners in any order.

use std::collections::{HashMap, VecDeque};

use rayon::prelude::*;

use super::cell::Cell;
use crate::bernstein::TetrahedronCubic;
use crate::interruption::checkpoint;
use crate::mesh::Vector;

/// A cell is a sliver if six times its volume is below this part of its longest edge from one
/// corner, cubed. In a mesh without folds neighbours and volume agree, so that it may be ample.
const SLIVER: f64 = 1e-9;

/// The cells at each face of a sliver, by their places.
type CellsAtFaces = HashMap<[u32; 3], Vec<usize>>;

/// Gives slivers the handedness that their neighbours leave to them. Those that have slivers alone
/// for neighbours keep their own.
pub fn settle_slivers(cells: &mut [Cell]) {
    let mut is_open: Vec<bool> = cells.par_iter().map(|cell| is_sliver(&cell.corners)).collect();
    if !is_open.contains(&true) {
        return;
    }
    let at_faces = cells_at_faces(cells, &is_open);
    let mut settled: VecDeque<usize> = (0..cells.len()).filter(|&cell| !is_open[cell]).collect();
    while let Some(from) = settled.pop_front() {
        checkpoint();
        for opposite in 0..4 {
            let beyond = at_faces.get(&face(&cells[from], opposite)).map_or(&[][..], |c| &c[..]);
            // where more than two cells meet, they cannot all turn the face in opposite directions
            let &[a, b] = beyond else { continue };
            let to = if a == from { b } else { a };
            if std::mem::take(&mut is_open[to]) {
                let is_even = is_opposite_at_even_place(&cells[to], face(&cells[from], opposite));
                cells[to].right_handed = turns_upward(&cells[from], opposite) != is_even;
                settled.push_back(to);
            }
        }
    }
}

/// Whether a tetrahedron with these corners has hardly any volume.
pub fn is_sliver(corners: &[Vector; 4]) -> bool {
    let squares = [1, 2, 3].map(|n| (corners[n] - corners[0]).norm_squared());
    let longest = squares.into_iter().fold(0.0, f64::max);
    // squared, for speed
    signed_volume(corners).powi(2) <= SLIVER.powi(2) * longest.powi(3)
}

/// Six times the volume, above zero for a right-handed tetrahedron.
pub fn signed_volume(corners: &[Vector; 4]) -> f64 {
    let [a, b, c] = [1, 2, 3].map(|corner| corners[corner] - corners[0]);
    a.cross(&b).dot(&c)
}

fn cells_at_faces(cells: &[Cell], is_sliver: &[bool]) -> CellsAtFaces {
    let mut at_faces = CellsAtFaces::new();
    for (cell, _) in cells.iter().zip(is_sliver).filter(|(_, is_sliver)| **is_sliver) {
        at_faces.extend((0..4).map(|opposite| (face(cell, opposite), Vec::new())));
    }
    for (place, cell) in cells.iter().enumerate() {
        checkpoint();
        for opposite in 0..4 {
            if let Some(cells) = at_faces.get_mut(&face(cell, opposite)) {
                cells.push(place);
            }
        }
    }
    at_faces
}

/// The points of a face, ascending.
fn face(cell: &Cell, opposite: usize) -> [u32; 3] {
    TetrahedronCubic::FACE_VERTICES[opposite].map(|corner| cell.points[corner])
}

/// Whether the points of a face, ascending, turn counter-clockwise seen from outside the cell.
fn turns_upward(cell: &Cell, opposite: usize) -> bool {
    cell.right_handed == opposite.is_multiple_of(2)
}

/// Whether the corner opposite a face of a cell stands at an even place.
fn is_opposite_at_even_place(cell: &Cell, points: [u32; 3]) -> bool {
    (0..4).any(|opposite| opposite % 2 == 0 && face(cell, opposite) == points)
}
