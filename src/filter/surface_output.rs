//! Iso-surfaces as a part of the output.

use super::output::{Output, OutputPoint};
use super::resample::Stencil;
use super::solution::Domain;
use crate::contour::surface::ContourSurface;
use crate::interpolant::TetrahedronCubics;
use crate::mesh::{TetrahedronFrame, Vector};

/// Iso-surfaces, and what they came from.
pub struct SurfaceOutput<'a> {
    /// The solids.
    pub domain: &'a Domain<'a, 4>,
    /// The interpolant that was contoured.
    pub interpolant: &'a dyn TetrahedronCubics,
    /// Its surfaces.
    pub surface: &'a ContourSurface,
}

impl SurfaceOutput<'_> {
    /// Adds the surfaces to the output.
    pub fn add_to(&self, output: &mut Output) {
        let first = output.points.len() as i64;
        let gradients = output.options.need_gradients().then(|| self.gradients());
        for (&level, points) in self.surface.levels.iter().zip(&self.surface.level_points) {
            for number in points.clone() {
                let point = &self.surface.points[number];
                let cell = point.cell as usize;
                output.points.push(OutputPoint {
                    position: point.position,
                    stencil: Stencil {
                        points: self.interpolant.mesh().tetrahedra()[cell],
                        weights: point.at,
                    },
                    level,
                    parent: self.domain.parent(point.cell),
                    gradient: gradients.as_ref().map_or(Vector::zeros(), |all| all[number]),
                });
            }
        }
        for (triangle, &cell) in self.surface.triangles.iter().zip(&self.surface.cells) {
            output.polys.push(&triangle.map(|point| first + i64::from(point)));
            output.parents.push(self.domain.parent(cell));
        }
    }

    /// The gradient at each point: that of the cubic; between several cubics, whose slopes
    /// across their common face differ, the mean over the triangles at the point.
    fn gradients(&self) -> Vec<Vector> {
        let mesh = self.interpolant.mesh();
        let mut sums = vec![(Vector::zeros(), 0.0); self.surface.points.len()];
        for (triangle, &cell) in self.surface.triangles.iter().zip(&self.surface.cells) {
            let frame = TetrahedronFrame::new(mesh.corners(cell as usize));
            if frame.is_degenerate() {
                continue;
            }
            let cubic = self.interpolant.cubic(cell as usize);
            for &point in triangle {
                let at = frame.barycentric(&self.surface.points[point as usize].position);
                let gradient = frame.gradient(&cubic.barycentric_gradient(&at));
                if gradient.iter().all(|x| x.is_finite()) {
                    let (sum, count) = &mut sums[point as usize];
                    *sum += gradient;
                    *count += 1.0;
                }
            }
        }
        sums.into_iter().map(|(sum, count)| if count > 0.0 { sum / count } else { sum }).collect()
    }
}
