//! Values and gradients of an interpolant at any points.

use rayon::prelude::*;

use super::interpolant::Interpolant;
use crate::interruption::checkpoint;
use crate::mesh::{PointLocator, Vector};

/// Finds the cells of an interpolant that hold points. It borrows nothing, so that it can be
/// kept.
#[derive(Clone, Debug)]
pub struct Locators {
    triangles: Option<PointLocator>,
    tetrahedra: Option<PointLocator>,
}

/// The cubic at a point: value, and gradient per unit of length; not a number outside.
type Evaluated = (f64, Vector);

impl Locators {
    /// Those of the cells of an interpolant.
    pub fn new(interpolant: &Interpolant) -> Self {
        let solution = &interpolant.solution;
        Self {
            triangles: solution.triangles.as_ref().map(|domain| PointLocator::new(&domain.mesh)),
            tetrahedra: solution.tetrahedra.as_ref().map(|domain| PointLocator::new(&domain.mesh)),
        }
    }

    /// Value and gradient at each point: in a solid, else on a two-dimensional cell; not a
    /// number outside all cells (further than a millionth of the mesh's size), and in those
    /// with values that are not finite. On a common face the gradient is that of one of the
    /// cells. On a surface in space it is tangential.
    pub fn evaluate(&self, interpolant: &Interpolant, points: &[Vector]) -> Vec<Evaluated> {
        let (triangles, tetrahedra) = (interpolant.in_triangles(), interpolant.in_tetrahedra());
        let in_solid = |point: &Vector| -> Option<Evaluated> {
            let ((cubics, _), locator) = (tetrahedra.as_ref()?, self.tetrahedra.as_ref()?);
            let found = locator.locate(cubics.mesh(), point, locator.forgiving_distance())?;
            let slope = cubics.cubic(found.simplex).barycentric_gradient(&found.at);
            let gradient = cubics.mesh().frame(found.simplex).gradient(&slope);
            Some((cubics.cubic(found.simplex).value(&found.at), gradient))
        };
        let on_surface = |point: &Vector| -> Option<Evaluated> {
            let ((cubics, _), locator) = (triangles.as_ref()?, self.triangles.as_ref()?);
            let found = locator.locate(cubics.mesh(), point, locator.forgiving_distance())?;
            let slope = cubics.cubic(found.simplex).barycentric_gradient(&found.at);
            let gradient = cubics.mesh().frame(found.simplex).gradient(&slope);
            Some((cubics.cubic(found.simplex).value(&found.at), gradient))
        };
        let evaluate = |point| {
            checkpoint();
            let nowhere = (f64::NAN, Vector::repeat(f64::NAN));
            in_solid(point).or_else(|| on_surface(point)).unwrap_or(nowhere)
        };
        points.par_iter().map(evaluate).collect()
    }
}
