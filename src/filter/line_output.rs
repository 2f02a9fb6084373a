//! Contour lines as a part of the output.

use std::ops::Range;

use super::output::{Output, OutputOptions, OutputPoint};
use super::resample::Stencil;
use super::solution::Domain;
use crate::contour::lines::{ContourLines, LinePoint};
use crate::interpolant::TriangleCubics;
use crate::mesh::Vector;

/// Contour lines, and what they came from.
pub struct LineOutput<'a> {
    /// The two-dimensional cells.
    pub domain: &'a Domain<'a, 3>,
    /// The interpolant that was contoured.
    pub interpolant: &'a dyn TriangleCubics,
    /// Its contour lines.
    pub lines: &'a ContourLines,
}

impl LineOutput<'_> {
    /// Adds the lines to the output.
    pub fn add_to(&self, output: &mut Output) {
        // where each point is in the output, if it is there
        let mut numbers: Vec<Option<u32>> = vec![None; self.lines.points.len()];
        for line in &self.lines.lines {
            let places = self.distinct(line.points.clone(), output);
            let mut number = |place: usize| {
                let point = self.lines.connectivity[place];
                let number = numbers[point as usize].get_or_insert_with(|| {
                    output.points.push(self.output_point(point, line.level, output.options));
                    output.points.len() as u32 - 1
                });
                i64::from(*number)
            };
            if output.options.segments {
                for pair in places.windows(2) {
                    output.lines.push(&[number(pair[0]), number(pair[1])]);
                    output.parents.push(self.domain.parent(self.lines.segment_cells[pair[0]]));
                }
            } else if places.len() >= 2 {
                let points: Vec<i64> = places.iter().map(|&place| number(place)).collect();
                output.lines.push(&points);
                output.parents.push(self.domain.parent(self.lines.segment_cells[places[0]]));
            }
        }
    }

    /// The places of a line's points, without those that rounding to the output's
    /// precision makes equal to the one before.
    fn distinct(&self, places: Range<usize>, output: &Output) -> Vec<usize> {
        let position = |place: usize| {
            let point = self.lines.connectivity[place] as usize;
            output.options.rounded(&self.lines.points[point].position)
        };
        let first = places.start;
        places.filter(|&place| place == first || position(place) != position(place - 1)).collect()
    }

    fn output_point(&self, number: u32, level: usize, options: OutputOptions) -> OutputPoint {
        let point = &self.lines.points[number as usize];
        let [a, b, c] = self.interpolant.mesh().triangles()[point.cell as usize];
        let [s, t, u] = point.at;
        OutputPoint {
            position: point.position,
            // a triangle has no fourth point: one without weight stands for it
            stencil: options
                .data
                .then_some(Stencil { points: [a, b, c, c], weights: [s, t, u, 0.0] }),
            level: self.lines.levels[level],
            parent: self.domain.parent(point.cell),
            gradient: options.need_gradients().then(|| self.gradient(point)),
        }
    }

    fn gradient(&self, point: &LinePoint) -> Vector {
        let cell = point.cell as usize;
        let slope = self.interpolant.cubic(cell).barycentric_gradient(&point.at);
        self.interpolant.mesh().frame(cell).gradient(&slope)
    }
}
