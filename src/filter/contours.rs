//! The contours of an interpolant at some levels.

use super::error::FilterError;
use super::interpolant::Interpolant;
use super::options::ContourOptions;
use crate::contour::lines::{ContourLines, Resolution, contour_lines_with_walls};
use crate::contour::surface::{ContourSurface, Fineness, contour_surface, points_per_side_within};

/// The contours of an interpolant at some levels.
#[derive(Clone, Debug)]
pub struct Contours {
    /// The levels, ascending.
    pub levels: Vec<f64>,
    /// The lines, if there are two-dimensional cells.
    pub lines: Option<ContourLines>,
    /// How fine they are.
    pub resolution: Resolution,
    /// The surfaces, if there are solids.
    pub surface: Option<ContourSurface>,
    /// How fine they are.
    pub fineness: Option<Fineness>,
}

impl Contours {
    /// The contours at the levels of the options, drawn as they say.
    pub(super) fn new(
        interpolant: &Interpolant,
        options: &ContourOptions,
    ) -> Result<Self, FilterError> {
        let diagonal = options.size.unwrap_or(interpolant.interpolation.diagonal);
        let resolution = options.resolution(diagonal)?;
        let levels = options.levels.resolve(interpolant.interpolation.range)?;
        let lines = interpolant.in_triangles().map(|(cubics, ranges)| {
            contour_lines_with_walls(cubics.as_ref(), ranges, &levels, options.method, resolution)
        });
        let (mut surface, mut fineness) = (None, None);
        if let Some((cubics, ranges)) = interpolant.in_tetrahedra() {
            let within = |limit| points_per_side_within(cubics.as_ref(), ranges, &levels, limit);
            let chosen = options.fineness(diagonal, within)?;
            fineness = Some(chosen);
            surface = Some(contour_surface(cubics.as_ref(), ranges, &levels, chosen));
        }
        Ok(Self { levels, lines, resolution, surface, fineness })
    }
}
