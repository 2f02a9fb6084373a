//! Values and gradients of an interpolant at any points.

use rayon::prelude::*;

use super::interpolant::Interpolant;
use super::solution::Solution;
use crate::interpolant::{Pieces, Taylor};
use crate::interruption::checkpoint;
use crate::mesh::{PointLocator, Vector};

/// Finds the cells of a solution that hold points. It borrows nothing, so that it can be
/// kept.
#[derive(Clone, Debug)]
pub struct Locators {
    triangles: Option<PointLocator>,
    tetrahedra: Option<PointLocator>,
}

/// Where a point is: the cell, and the weights of its corners.
#[derive(Clone, Copy, Debug)]
pub enum Place {
    /// On a two-dimensional cell.
    Triangle(usize, [f64; 3]),
    /// In a solid.
    Tetrahedron(usize, [f64; 4]),
}

/// The cubic at a point: value, and gradient per unit of length; not a number outside.
type Evaluated = (f64, Vector);

impl Locators {
    /// Those of the cells of a solution.
    pub fn new(solution: &Solution) -> Self {
        Self {
            triangles: solution.triangles.as_ref().map(|domain| PointLocator::new(&domain.mesh)),
            tetrahedra: solution.tetrahedra.as_ref().map(|domain| PointLocator::new(&domain.mesh)),
        }
    }

    /// Where a point is in the solution that this was made of: in a solid, else on a
    /// two-dimensional cell; nowhere if it is further from all cells than a millionth of the
    /// mesh's size.
    pub fn place(&self, solution: &Solution, point: &Vector) -> Option<Place> {
        let in_solid = || {
            let (domain, locator) = (solution.tetrahedra.as_ref()?, self.tetrahedra.as_ref()?);
            let found = locator.locate(&domain.mesh, point, locator.forgiving_distance())?;
            Some(Place::Tetrahedron(found.simplex, found.at))
        };
        let on_surface = || {
            let (domain, locator) = (solution.triangles.as_ref()?, self.triangles.as_ref()?);
            let found = locator.locate(&domain.mesh, point, locator.forgiving_distance())?;
            Some(Place::Triangle(found.simplex, found.at))
        };
        in_solid().or_else(on_surface)
    }

    /// Value and gradient at each point, see [`Locators::place`]; not a number outside all
    /// cells, and in those with values that are not finite. On a common face the gradient is
    /// that of one of the cells. On a surface in space it is tangential.
    pub fn evaluate(&self, interpolant: &Interpolant, points: &[Vector]) -> Vec<Evaluated> {
        let (triangles, tetrahedra) = (interpolant.in_triangles(), interpolant.in_tetrahedra());
        let taylor = |place| -> Option<Taylor> {
            match place {
                Place::Triangle(cell, at) => Some(triangles.as_ref()?.0.taylor(cell, &at)),
                Place::Tetrahedron(cell, at) => Some(tetrahedra.as_ref()?.0.taylor(cell, &at)),
            }
        };
        let evaluate = |point| {
            checkpoint();
            let found = self.place(&interpolant.solution, point).and_then(taylor);
            found
                .map_or((f64::NAN, Vector::repeat(f64::NAN)), |there| (there.value, there.gradient))
        };
        points.par_iter().map(evaluate).collect()
    }
}
