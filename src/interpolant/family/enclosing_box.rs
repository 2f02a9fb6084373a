//! The box around a cell, whose coordinates run from 0 to 1 (thesis, eq. 1.3, figure 1.1).

use super::shape::Shape;
use crate::mesh::Vector;

/// The box around a cell. A cell in a plane has no third side.
#[derive(Clone, Copy, Debug)]
pub(super) struct EnclosingBox {
    origin: Vector,
    /// The sides, as vectors.
    sides: [Vector; 3],
    /// The gradients of the coordinates.
    pub gradients: [Vector; 3],
}

impl EnclosingBox {
    /// The box with sides along the axes, or in a plane along two directions of it; none
    /// for a cell that is not of its shape or has no size.
    pub fn new(shape: Shape, corners: &[Vector]) -> Option<Self> {
        let directions = shape.directions(corners)?;
        let first = corners[0];
        let mut origin = first;
        let (mut sides, mut gradients) = ([Vector::zeros(); 3], [Vector::zeros(); 3]);
        for (axis, direction) in directions.iter().enumerate().take(shape.dimension()) {
            let along = corners.iter().map(|corner| (corner - first).dot(direction));
            let (low, high) =
                along.fold((0.0, 0.0), |(low, high): (f64, f64), x| (low.min(x), high.max(x)));
            origin += direction * low;
            sides[axis] = direction * (high - low);
            gradients[axis] = direction / (high - low);
        }
        Some(Self { origin, sides, gradients })
    }

    /// The coordinates of a point.
    pub fn coordinates(&self, point: &Vector) -> [f64; 3] {
        let offset = point - self.origin;
        self.gradients.map(|gradient| gradient.dot(&offset))
    }

    /// Derivatives by the coordinates, from a gradient in space.
    pub fn slopes(&self, gradient: &Vector) -> [f64; 3] {
        self.sides.map(|side| side.dot(gradient))
    }

    /// A gradient in space, from derivatives by the coordinates.
    pub fn gradient(&self, slopes: &[f64; 3]) -> Vector {
        self.gradients.iter().zip(slopes).map(|(gradient, slope)| gradient * *slope).sum()
    }
}
