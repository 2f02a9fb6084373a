//! A tetrahedron at one level.

use arrayvec::ArrayVec;

use super::walls::Walls;
use crate::bernstein::{Barycentric4, Sign, TetrahedronCubic};
use crate::contour::crossings::{MAX_CROSSINGS, crossings};
use crate::contour::rounding::Rounding;
use crate::interpolant::TetrahedronCubics;
use crate::mesh::Vector;

/// A tetrahedron of the mesh with its cubic less the level.
///
/// Its corners stand in the order of their numbers. Whatever is computed on an edge or a
/// face then has the same bits in all cells that share it, because a weight of zero
/// leaves no trace in a sum; so neighbours agree without a table.
#[derive(Clone, Debug)]
pub struct Cell {
    /// The cell's number.
    pub number: u32,
    /// The numbers of its corners, ascending.
    pub points: [u32; 4],
    /// Where its corners are.
    pub corners: [Vector; 4],
    /// The places of its corners in the mesh's own order.
    order: [usize; 4],
    /// The cubic less the level; what rounding alone keeps from the level is zero, and so is
    /// what belongs to a wall.
    pub cubic: TetrahedronCubic,
    /// Values of the cubic that are no larger may be rounding alone.
    pub noise: f64,
    /// On which side corners on the level count, by their signs: of a wall, that on which the
    /// solution rises from there into the domain, and how fast; zero for any other corner.
    pub rises: [f64; 4],
    /// Whether all of the cell lies on the level.
    pub is_plateau: bool,
    /// Which faces, named by the corner opposite, are of the domain's boundary and lie on the
    /// level as a whole: they are drawn so.
    pub flat: [bool; 4],
    /// Whether the corners, in this order, are those of a right-handed tetrahedron; of a sliver,
    /// by its neighbours.
    pub right_handed: bool,
}

/// The error of de Casteljau's algorithm, as a part of the largest coefficient.
const NOISE: f64 = 32.0 * f64::EPSILON;

impl Cell {
    /// A cell at a level; nothing for one of which two corners are the same point, which
    /// its neighbours close up.
    pub fn new(
        interpolant: &dyn TetrahedronCubics,
        rounding: &Rounding,
        walls: &Walls,
        number: u32,
    ) -> Option<Self> {
        let points = interpolant.mesh().tetrahedra()[number as usize];
        let mut order = [0, 1, 2, 3];
        order.sort_by_key(|&place| points[place]);
        let sorted = order.map(|place| points[place]);
        if sorted.windows(2).any(|pair| pair[0] == pair[1]) {
            return None;
        }
        let corners = interpolant.mesh().corners(number as usize);
        let above_level = less_level(&interpolant.cubic(number as usize), points, rounding);
        let is_plateau = above_level.coefficients == [0.0; 20];
        let above_level = TetrahedronCubic::from_coefficients(|exponents| {
            let mut here = [0; 4];
            for (place, exponent) in order.into_iter().zip(exponents) {
                here[place] = exponent;
            }
            above_level.coefficient(here)
        });
        let right_handed = is_right_handed(&corners) == is_even(&order);
        let corners = order.map(|place| corners[place]);
        let (cubic, rises) = (walls.applied(sorted, above_level), walls.rises(sorted));
        let flat = TetrahedronCubic::FACE_VERTICES.map(|face| {
            let on_level = cubic.face(face).coefficients == [0.0; 10];
            // between walls that meet nothing is known inside a face
            on_level && !walls.surround(face.map(|n| sorted[n]))
        });
        let (low, high) = cubic.bounds();
        let noise = NOISE * high.max(-low);
        Some(Self {
            number,
            points: sorted,
            corners,
            order,
            cubic,
            noise,
            rises,
            is_plateau,
            flat,
            right_handed,
        })
    }

    /// The side of the level on which a point counts. On a wall it is the side on which the
    /// solution lies next to it, on a plateau that of the plateau; elsewhere what is on the level
    /// counts as above.
    pub fn sign(&self, at: &Barycentric4) -> Sign {
        let value = self.cubic.value(at);
        Sign::of(if value == 0.0 { self.rise(at) } else { value })
    }

    /// Whether a point is on one side of the level, if only as a point of a wall or plateau.
    pub fn has_side(&self, at: &Barycentric4) -> bool {
        self.cubic.value(at) != 0.0 || self.rise(at) != 0.0
    }

    /// Where the surface crosses the line from `a` to `b`, whose ends count as on the given
    /// sides.
    pub fn crossings(
        &self,
        [a, b]: [&Barycentric4; 2],
        [start, end]: [Sign; 2],
    ) -> ArrayVec<f64, MAX_CROSSINGS> {
        let line = self.cubic.restrict(a, b);
        if line.coefficients == [0.0; 4] && start != end {
            let (from, to) = (self.rise(a), self.rise(b));
            let t = (from / (from - to)).clamp(0.0, 1.0);
            return ArrayVec::from_iter([if t.is_nan() { 1.0 } else { t }]);
        }
        crossings(&line, start, end)
    }

    /// On which side of the level a point that is on it counts: linear between corners.
    fn rise(&self, at: &Barycentric4) -> f64 {
        ((self.rises[0] * at[0] + self.rises[1] * at[1]) + self.rises[2] * at[2])
            + self.rises[3] * at[3]
    }

    /// The point at the given weights.
    pub fn position(&self, at: &Barycentric4) -> Vector {
        let [a, b, c, d] = &self.corners;
        ((a * at[0] + b * at[1]) + c * at[2]) + d * at[3]
    }

    /// Weights of the corners, in the mesh's own order.
    pub fn in_mesh_order(&self, at: &Barycentric4) -> Barycentric4 {
        let mut ordered = [0.0; 4];
        for (place, weight) in self.order.into_iter().zip(at) {
            ordered[place] = *weight;
        }
        ordered
    }
}

/// A cubic less the level, in a cell with the given corners. What rounding alone keeps from the
/// level is zero.
pub fn less_level(
    cubic: &TetrahedronCubic,
    points: [u32; 4],
    rounding: &Rounding,
) -> TetrahedronCubic {
    let values = cubic.vertices();
    let near = [0, 1, 2, 3].map(|n| rounding.at(points[n], values[n]));
    TetrahedronCubic::from_coefficients(|exponents| {
        let difference = cubic.coefficient(exponents) - rounding.level();
        // a coefficient of a face belongs to all its corners
        let own = (0..4).filter(|&n| exponents[n] > 0).map(|n| near[n]);
        if difference.abs() <= own.fold(0.0, f64::max) { 0.0 } else { difference }
    })
}

/// Whether four corners are those of a right-handed tetrahedron, exactly. Corners in one
/// plane count as such: they are in the file's order, and that is right-handed.
fn is_right_handed(corners: &[Vector; 4]) -> bool {
    let [a, b, c, d] = corners.map(|p| robust::Coord3D { x: p.x, y: p.y, z: p.z });
    robust::orient3d(a, b, c, d) <= 0.0
}

/// Whether a permutation is even.
pub fn is_even(order: &[usize]) -> bool {
    let pairs = (0..order.len()).flat_map(|j| (0..j).map(move |i| (i, j)));
    pairs.filter(|&(i, j)| order[i] > order[j]).count() % 2 == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn handedness() {
        let corners = [Vector::zeros(), Vector::x(), Vector::y(), Vector::z()];
        assert!(is_right_handed(&corners));
        let [a, b, c, d] = corners;
        assert!(!is_right_handed(&[b, a, c, d]));
        assert!(is_even(&[0, 1, 2, 3]) && is_even(&[1, 2, 0, 3]) && !is_even(&[1, 0, 2, 3]));
    }
}
