//! The shapes of cells.

use crate::mesh::{TetrahedronFrame, TriangleFrame, Vector};

/// What a cell with a polynomial of its own is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Three corners in a plane.
    Triangle,
    /// Four corners in a plane, in turn, the angles right.
    Rectangle,
    /// Four corners in space.
    Tetrahedron,
}

/// Corners are those of a rectangle if none is further from its place than this part of
/// the diagonal: points in single precision are.
const RIGHT: f64 = 1e-6;

/// The corner weights of a cell as polynomials: coefficients of 1, s, t, v and st.
///
/// They sum to one, are one at their own corner, and linear functions are their mean by
/// them: barycentric coordinates of simplices, the bilinear weights of a rectangle.
pub(super) type WeightTerms = [f64; 5];

impl Shape {
    /// Two or three.
    pub const fn dimension(self) -> usize {
        match self {
            Self::Triangle | Self::Rectangle => 2,
            Self::Tetrahedron => 3,
        }
    }

    /// Whether corners are those of a cell of this shape, which has a size.
    pub fn is_shape_of(self, corners: &[Vector]) -> bool {
        self.directions(corners).is_some()
    }

    /// The directions of the cell's own coordinates, unit vectors; none if the cell is
    /// not what it should be, or has no size.
    pub(super) fn directions(self, corners: &[Vector]) -> Option<[Vector; 3]> {
        match (self, corners) {
            (Self::Triangle, &[a, b, c]) => {
                let frame = TriangleFrame::new([a, b, c]);
                let [first, second] = crate::mesh::plane_axes(frame.normal());
                (!frame.is_degenerate()).then_some([first, second, Vector::zeros()])
            }
            (Self::Rectangle, &[a, b, c, d]) => {
                let [first, second] = [b - a, d - a];
                let close = RIGHT * (c - a).norm();
                let is_right = (a + c - b - d).norm() <= close
                    && first.dot(&second).abs() <= close * first.norm().min(second.norm());
                let directions = [first.try_normalize(close)?, second.try_normalize(close)?];
                is_right.then_some([directions[0], directions[1], Vector::zeros()])
            }
            (Self::Tetrahedron, &[a, b, c, d]) => {
                let frame = TetrahedronFrame::new([a, b, c, d]);
                (!frame.is_degenerate()).then(|| [Vector::x(), Vector::y(), Vector::z()])
            }
            _ => None,
        }
    }

    /// The corner weights as polynomials in the cell's own coordinates, given these at
    /// the corners.
    pub(super) fn weights<const CORNERS: usize>(
        self,
        corners: &[[f64; 3]; CORNERS],
    ) -> [WeightTerms; CORNERS] {
        if self == Self::Rectangle {
            // (1 - s)(1 - t), s (1 - t), s t, (1 - s) t: the box is the rectangle
            let terms = [
                [1.0, -1.0, -1.0, 0.0, 1.0],
                [0.0, 1.0, 0.0, 0.0, -1.0],
                [0.0, 0.0, 0.0, 0.0, 1.0],
                [0.0, 0.0, 1.0, 0.0, -1.0],
            ];
            return std::array::from_fn(|corner| terms[corner]);
        }
        let gradients = barycentric_gradients(&corners.map(Vector::from));
        std::array::from_fn(|corner| {
            let [s, t, v] = gradients[corner].into();
            let there = gradients[corner].dot(&Vector::from(corners[corner]));
            [1.0 - there, s, t, v, 0.0]
        })
    }

    /// All points of a cell that a point is carried to if corners change places, itself
    /// first: so a choice of points does not depend on their order.
    pub(super) fn orbit<const CORNERS: usize>(self, point: [f64; CORNERS]) -> Vec<[f64; CORNERS]> {
        let mut orbit = vec![point];
        let mut next = 0;
        while next < orbit.len() {
            for swapped in self.neighbours(orbit[next]) {
                if !orbit.contains(&swapped) {
                    orbit.push(swapped);
                }
            }
            next += 1;
        }
        orbit
    }

    /// The points that generate the orbit: two corners of a simplex change places, a
    /// rectangle is turned.
    fn neighbours<const CORNERS: usize>(self, point: [f64; CORNERS]) -> Vec<[f64; CORNERS]> {
        if self == Self::Rectangle {
            let mut turned = point;
            turned.rotate_right(1);
            return vec![turned];
        }
        let swap = |corner: usize| {
            let mut swapped = point;
            swapped.swap(corner, corner + 1);
            swapped
        };
        (0..CORNERS - 1).map(swap).collect()
    }
}

fn barycentric_gradients(corners: &[Vector]) -> [Vector; 4] {
    match *corners {
        [a, b, c] => {
            let [one, two, three] = *TriangleFrame::new([a, b, c]).barycentric_gradients();
            [one, two, three, Vector::zeros()]
        }
        [a, b, c, d] => *TetrahedronFrame::new([a, b, c, d]).barycentric_gradients(),
        _ => [Vector::zeros(); 4],
    }
}
