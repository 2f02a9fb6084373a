//! What to contour, and how.

use super::chosen_array::Component;
use super::error::FilterError;
use super::gradients::GradientSource;
use super::output::OutputOptions;
use crate::contour::Levels;
use crate::contour::lines::{Method, Resolution};
use crate::contour::surface::{Fineness, MOST_POINTS};
use crate::interpolant::Predictor;
use crate::vtk::{ArrayType, UnstructuredGrid};

/// Which interpolant to contour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InterpolantKind {
    /// The pure cubic interpolant of values, gradients and PDE.
    #[default]
    Pci,
    /// The pure cubic interpolant of values and gradients, each cell by itself.
    QuadraticPrecision,
    /// The linear interpolant of the values, as VTK's own filter.
    Linear,
}

impl InterpolantKind {
    /// Whether gradients decide the contours, and not only the values.
    pub fn uses_gradients(self) -> bool {
        self != Self::Linear
    }
}

/// What to contour, and how.
#[derive(Clone, Debug)]
pub struct ContourOptions {
    /// The point array; the active scalars, or the only one, if not given.
    pub array: Option<String>,
    /// What of it, if it has several components.
    pub component: Option<Component>,
    /// Where its gradient comes from.
    pub gradient: GradientSource,
    /// Points no further apart than this are made one, in units of length; 0 for those at
    /// exactly the same place. Not given: every point stays by itself.
    pub merge_points: Option<f64>,
    /// The levels.
    pub levels: Levels,
    /// How curves are drawn.
    pub method: Method,
    /// The greatest distance between neighbouring points, in units of length.
    pub spacing: Option<f64>,
    /// The greatest distance of a segment or a triangle from the contour, in units of
    /// length. Without this and `spacing`: [`DEFAULT_TOLERANCE`] times the diagonal for
    /// lines; without this, `points_per_side` and `triangles`:
    /// [`DEFAULT_SURFACE_TOLERANCE`] times the diagonal for surfaces.
    pub tolerance: Option<f64>,
    /// Points on each side of a patch of a surface: the thesis' *nSide*, 2 to [`MOST_POINTS`].
    pub points_per_side: Option<u32>,
    /// The greatest number of triangles: as many points on each side as that allows.
    pub triangles: Option<usize>,
    /// The size of what is contoured, a length that default tolerances are parts of; the
    /// diagonal of the grid's own cells if not given. Pieces of a whole need that of the
    /// whole: where they meet, they have to be equally fine.
    pub size: Option<f64>,
    /// The interpolant.
    pub interpolant: InterpolantKind,
    /// The PDE as text, see [`crate::pde`].
    pub pde: Option<String>,
    /// Its parameters.
    pub parameters: Vec<(String, f64)>,
    /// Where its right-hand side takes the solution from.
    pub predictor: Predictor,
    /// Points of single precision; as the grid's own if not given.
    pub single: Option<bool>,
    /// Two-point segments instead of polylines.
    pub segments: bool,
    /// Put out `Gradients`.
    pub gradients: bool,
    /// Put out `Normals`.
    pub normals: bool,
}

/// The default tolerance, as a part of the bounding box's diagonal: a tenth of a
/// pixel where a picture of the mesh is ten thousand pixels wide.
pub const DEFAULT_TOLERANCE: f64 = 1e-5;

/// The default tolerance of surfaces, as a part of the diagonal: a pixel where a picture of
/// the mesh is a thousand pixels wide.
pub const DEFAULT_SURFACE_TOLERANCE: f64 = 1e-3;

/// The least tolerance of surfaces, as a part of the diagonal: finer ones have more
/// triangles than memory holds.
const LEAST_OF_SURFACES: f64 = 1e-6;

/// The least spacing or tolerance, as a part of the diagonal.
const LEAST: f64 = 1e-6;

impl Default for ContourOptions {
    fn default() -> Self {
        Self {
            array: None,
            component: None,
            gradient: GradientSource::default(),
            merge_points: None,
            levels: Levels::Equal { count: 10, range: None },
            method: Method::default(),
            spacing: None,
            tolerance: None,
            points_per_side: None,
            triangles: None,
            size: None,
            interpolant: InterpolantKind::default(),
            pde: None,
            parameters: Vec::new(),
            predictor: Predictor::default(),
            single: None,
            segments: false,
            gradients: false,
            normals: false,
        }
    }
}

impl ContourOptions {
    /// The limits of spacing and tolerance, on a mesh of the given diagonal.
    ///
    /// # Errors
    /// If one is not positive, or so small that lines would have millions of points.
    pub fn resolution(&self, diagonal: f64) -> Result<Resolution, FilterError> {
        let limits = [("--spacing", self.spacing), ("--tolerance", self.tolerance)];
        for (option, value) in limits.into_iter().filter_map(|(o, v)| Some((o, v?))) {
            if value.is_nan() || value <= 0.0 {
                return Err(FilterError::NotPositive { option, value });
            }
            let least = LEAST * diagonal;
            if value < least {
                return Err(FilterError::TooSmall { option, value, least });
            }
        }
        let default =
            if self.spacing.is_some() { f64::INFINITY } else { DEFAULT_TOLERANCE * diagonal };
        Ok(Resolution {
            spacing: self.spacing.unwrap_or(f64::INFINITY),
            tolerance: self.tolerance.unwrap_or(default),
        })
    }

    /// How fine surfaces are, on a mesh of the given diagonal; by the number of triangles,
    /// if that is given, `within` tells how many points a side keep it.
    ///
    /// # Errors
    /// If more than one limit is given, or one is not positive.
    pub fn fineness(
        &self,
        diagonal: f64,
        within: impl FnOnce(usize) -> u32,
    ) -> Result<Fineness, FilterError> {
        match (self.tolerance, self.points_per_side, self.triangles) {
            (Some(value), None, None) => {
                let option = "--tolerance";
                if value.is_nan() || value <= 0.0 {
                    return Err(FilterError::NotPositive { option, value });
                }
                let least = LEAST_OF_SURFACES * diagonal;
                if value < least {
                    return Err(FilterError::TooSmall { option, value, least });
                }
                Ok(Fineness::Tolerance(value))
            }
            (None, Some(points), None) if (2..=MOST_POINTS).contains(&points) => {
                Ok(Fineness::PointsPerSide(points))
            }
            (None, Some(points), None) => Err(FilterError::PointsPerSide { points }),
            (None, None, Some(triangles)) => Ok(Fineness::PointsPerSide(within(triangles))),
            (None, None, None) => Ok(Fineness::Tolerance(DEFAULT_SURFACE_TOLERANCE * diagonal)),
            _ => Err(FilterError::TwoFinenesses),
        }
    }

    /// What the output holds, for arrays.
    pub fn bare_output(&self) -> OutputOptions {
        OutputOptions {
            segments: self.segments,
            single: self.single.unwrap_or(false),
            gradients: self.gradients,
            normals: self.normals,
            data: false,
        }
    }

    /// What the output holds, for a grid.
    pub fn output(&self, grid: &UnstructuredGrid) -> OutputOptions {
        let as_grid = grid.points.array_type() == ArrayType::F32;
        OutputOptions {
            segments: self.segments,
            single: self.single.unwrap_or(as_grid),
            gradients: self.gradients,
            normals: self.normals,
            data: true,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_a_side_that_no_memory_holds_are_refused() {
        let fineness = |points| {
            let points_per_side = Some(points);
            let options = ContourOptions { points_per_side, ..Default::default() };
            options.fineness(1.0, |_| 0).map_err(|error| error.to_string())
        };
        assert_eq!(fineness(1025), Ok(Fineness::PointsPerSide(1025)));
        for points in [1, 1026, 70_000] {
            let told = format!("--nside must be 2 to 1025, not {points}");
            assert_eq!(fineness(points), Err(told));
        }
    }
}
