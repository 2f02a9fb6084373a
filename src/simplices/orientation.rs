//! Tetrahedra turned so that their volume is positive.

use super::left_out::Reason;
use crate::mesh::Vector;

/// The volumes of a cell's tetrahedra by sign, six times over.
#[derive(Clone, Copy, Debug, Default)]
struct Volumes {
    positive: f64,
    negative: f64,
}

/// How a cell's tetrahedra lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lie {
    /// All on one side, as in a convex cell.
    Apart,
    /// Some over others: the cell is not convex, or its faces are not plane.
    Folded,
}

/// The part of a cell's volume that counts as folded, not as rounding.
const ROUNDING: f64 = 1e-10;

/// The most that a polyhedron may be folded, as a part of its volume. Cells of
/// finite-element types have no limit: were one folded by much, the Jacobian of its
/// own shape functions would change sign, and the mesh was useless from the start.
const MOST_FOLDED: f64 = 0.05;

/// Turns the tetrahedra of one cell so that each has a positive volume, which is
/// what a contour's normals rely on; inverted cells come out as if they were not.
///
/// # Errors
/// If the cell is a polyhedron, and they lie over one another by much.
pub fn orient(
    tetrahedra: &mut [[u32; 4]],
    positions: &[Vector],
    is_polyhedron: bool,
) -> Result<Lie, Reason> {
    let mut volumes = Volumes::default();
    for corners in tetrahedra {
        let volume = orient_one(corners, positions);
        if volume < 0.0 {
            volumes.negative -= volume;
        } else {
            volumes.positive += volume;
        }
    }
    let (less, more) =
        (volumes.positive.min(volumes.negative), volumes.positive.max(volumes.negative));
    if is_polyhedron && less > MOST_FOLDED * more {
        Err(Reason::NotConvex)
    } else if less > ROUNDING * more {
        Ok(Lie::Folded)
    } else {
        Ok(Lie::Apart)
    }
}

/// Turns a tetrahedron so that its volume is positive; returns six times the volume that it had.
pub fn orient_one(corners: &mut [u32; 4], positions: &[Vector]) -> f64 {
    let volume = sixfold_volume(corners, positions);
    if volume < 0.0 {
        corners.swap(2, 3);
    }
    volume
}

/// Six times the volume of a tetrahedron.
fn sixfold_volume(corners: &[u32; 4], positions: &[Vector]) -> f64 {
    let [a, b, c, d] = corners.map(|point| positions[point as usize]);
    (b - a).cross(&(c - a)).dot(&(d - a))
}
