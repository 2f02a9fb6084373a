//! Iso-surfaces as a part of the output.

use rayon::prelude::*;

use super::output::{Output, OutputPoint};
use super::resample::Stencil;
use super::solution::Domain;
use crate::contour::surface::ContourSurface;
use crate::interpolant::TetrahedronCubics;
use crate::mesh::{TetrahedronFrame, Vector};

/// Triangles whose gradients are computed before they are summed.
const AT_ONCE: usize = 1 << 13;

/// Triangles that one thread takes at a time.
const CHUNK: usize = 1 << 8;

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
        let with_data = output.options.data;
        output.points.reserve(self.surface.points.len(), with_data);
        output.polys.reserve(3 * self.surface.triangles.len());
        output.parents.reserve(self.surface.triangles.len());
        for (&level, points) in self.surface.levels.iter().zip(&self.surface.level_points) {
            for number in points.clone() {
                let point = &self.surface.points[number];
                let cell = point.cell as usize;
                output.points.push(OutputPoint {
                    position: point.position,
                    stencil: with_data.then(|| Stencil {
                        points: self.interpolant.mesh().tetrahedra()[cell],
                        weights: point.at,
                    }),
                    level,
                    parent: self.domain.parent(point.cell),
                    gradient: gradients.as_ref().map(|all| all[number]),
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
        let mut sums = vec![(Vector::zeros(), 0.0); self.surface.points.len()];
        let mut of_corners = vec![[Vector::zeros(); 3]; AT_ONCE.min(self.surface.triangles.len())];
        for (triangles, cells) in
            self.surface.triangles.chunks(AT_ONCE).zip(self.surface.cells.chunks(AT_ONCE))
        {
            // in parallel, and added in their order: the same for any number of threads
            let chunks = (triangles.par_chunks(CHUNK), cells.par_chunks(CHUNK)).into_par_iter();
            chunks.zip(of_corners.par_chunks_mut(CHUNK)).for_each(
                |((triangles, cells), of_corners)| {
                    self.put_gradients(triangles, cells, of_corners);
                },
            );
            for (triangle, gradients) in triangles.iter().zip(&of_corners) {
                for (&point, gradient) in triangle.iter().zip(gradients) {
                    if gradient.iter().all(|x| x.is_finite()) {
                        let (sum, count) = &mut sums[point as usize];
                        *sum += gradient;
                        *count += 1.0;
                    }
                }
            }
        }
        sums.into_iter().map(|(sum, count)| if count > 0.0 { sum / count } else { sum }).collect()
    }

    /// Finds the gradients at the corners of triangles, by the cubics of their cells; not a number in
    /// a cell without a volume.
    fn put_gradients(
        &self,
        triangles: &[[u32; 3]],
        cells: &[u32],
        mut of_corners: &mut [[Vector; 3]],
    ) {
        let mesh = self.interpolant.mesh();
        let mut triangles = triangles;
        let (mut points, mut gradients) = (Vec::new(), Vec::new());
        // a patch's triangles follow one another
        for patch in cells.chunk_by(|one, next| one == next) {
            let cell = patch[0] as usize;
            let (frame, cubic) =
                (TetrahedronFrame::new(mesh.corners(cell)), self.interpolant.cubic(cell));
            let gradient = |&point: &u32| {
                if frame.is_degenerate() {
                    return Vector::repeat(f64::NAN);
                }
                let at = frame.barycentric(&self.surface.points[point as usize].position);
                frame.gradient(&cubic.barycentric_gradient(&at))
            };
            let (own, others) = triangles.split_at(patch.len());
            let (of_own, of_others) = of_corners.split_at_mut(patch.len());
            (triangles, of_corners) = (others, of_others);
            // they share points, of which each is asked for once
            points.clear();
            points.extend(own.as_flattened());
            points.sort_unstable();
            points.dedup();
            gradients.clear();
            gradients.extend(points.iter().map(gradient));
            let at = |point: u32| gradients[points.partition_point(|&other| other < point)];
            for (triangle, gradients) in own.iter().zip(of_own) {
                *gradients = triangle.map(at);
            }
        }
    }
}
