//! What any interpolant tells at a place of a cell.

use nalgebra::Matrix3;

use super::{TetrahedronCubics, TriangleCubics};
use crate::mesh::{SimplexMesh, TetrahedronMesh, TriangleMesh, Vector};

/// One polynomial a cell, of whatever degree. Neighbours need not agree.
pub trait Pieces<const CORNERS: usize>: Sync {
    /// The cells.
    fn mesh(&self) -> &SimplexMesh<'_, CORNERS>;

    /// Value and derivatives of a cell's polynomial, at a place given by the weights of
    /// its corners.
    fn taylor(&self, cell: usize, at: &[f64; CORNERS]) -> Taylor;
}

/// A polynomial near a place: value and first and second derivatives. In a plane they are
/// those along it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Taylor {
    /// The value.
    pub value: f64,
    /// The gradient.
    pub gradient: Vector,
    /// The second derivatives.
    pub hessian: Matrix3<f64>,
}

impl Taylor {
    /// From derivatives by coordinates with the given gradients, each coordinate taken as
    /// independent.
    fn new<const CORNERS: usize>(
        value: f64,
        slopes: &[f64; CORNERS],
        second: &[[f64; CORNERS]; CORNERS],
        gradients: &[Vector; CORNERS],
    ) -> Self {
        let mut taylor = Self { value, ..Self::default() };
        for (i, one) in gradients.iter().enumerate() {
            taylor.gradient += one * slopes[i];
            for (j, other) in gradients.iter().enumerate() {
                taylor.hessian += one * other.transpose() * second[i][j];
            }
        }
        taylor
    }
}

/// Cubics are pieces.
impl<T: TriangleCubics + ?Sized> Pieces<3> for T {
    fn mesh(&self) -> &TriangleMesh<'_> {
        TriangleCubics::mesh(self)
    }

    fn taylor(&self, cell: usize, at: &[f64; 3]) -> Taylor {
        let cubic = self.cubic(cell);
        let frame = TriangleCubics::mesh(self).frame(cell);
        let (slopes, second) = (cubic.barycentric_gradient(at), cubic.barycentric_hessian(at));
        Taylor::new(cubic.value(at), &slopes, &second, frame.barycentric_gradients())
    }
}

/// Cubics are pieces.
impl<T: TetrahedronCubics + ?Sized> Pieces<4> for T {
    fn mesh(&self) -> &TetrahedronMesh<'_> {
        TetrahedronCubics::mesh(self)
    }

    fn taylor(&self, cell: usize, at: &[f64; 4]) -> Taylor {
        let cubic = self.cubic(cell);
        let frame = TetrahedronCubics::mesh(self).frame(cell);
        let (slopes, second) = (cubic.barycentric_gradient(at), cubic.barycentric_hessian(at));
        Taylor::new(cubic.value(at), &slopes, &second, frame.barycentric_gradients())
    }
}
