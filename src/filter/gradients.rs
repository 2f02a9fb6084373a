//! The gradient of the array that is contoured.

use std::borrow::Cow;
use std::fmt;

use super::chosen_array::{ChosenArray, Component, named};
use super::error::FilterError;
use super::gradient_arrays::GradientArrays;
use crate::field::{RecoveryDegree, recover_gradients};
use crate::mesh::{SimplexMesh, Vector};
use crate::simplices::nodal_gradients;
use crate::vtk::UnstructuredGrid;

/// Where the gradient comes from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum GradientSource {
    /// An array with a conventional name if there is one that fits the values;
    /// else, where there are quadratic cells, by their shape functions; else
    /// recovered.
    #[default]
    Automatic,
    /// This array.
    Array(String),
    /// Recovered from the values.
    Recovered,
}

/// Where gradients came from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum GradientOrigin {
    /// An array.
    Array(String),
    /// The shape functions of quadratic cells.
    Cells,
    /// Recovery from the values.
    Recovered,
    /// Nowhere: the interpolant needs none.
    Unused,
}

impl fmt::Display for GradientOrigin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Array(name) => write!(f, "'{name}'"),
            Self::Cells => f.write_str("of the quadratic cells"),
            Self::Recovered => f.write_str("recovered"),
            Self::Unused => f.write_str("not used"),
        }
    }
}

/// Gradients at the points, and where they came from.
#[derive(Clone, Debug)]
pub struct Gradients<'a> {
    /// One gradient a point.
    pub vectors: Cow<'a, [Vector]>,
    /// Where they came from.
    pub origin: GradientOrigin,
    /// What people should know about the choice.
    pub warning: Option<String>,
}

impl<'a> Gradients<'a> {
    /// The given gradients, one a point; `name` and `label` say of what they are.
    pub fn given<const CORNERS: usize>(
        mesh: &SimplexMesh<CORNERS>,
        values: &[f64],
        vectors: Cow<'a, [Vector]>,
        name: &str,
        label: &str,
    ) -> Self {
        let count = mesh.points().len();
        // a solution refuses other lengths
        let is_whole = values.len() == count && vectors.len() == count;
        let misfit = if is_whole { misfit(mesh, values, &vectors) } else { 0.0 };
        let warning = (misfit > WORST_FIT).then(|| {
            let difference = difference(misfit);
            format!("array '{name}' does not look like the gradient of '{label}': {difference}")
        });
        Self { vectors, origin: GradientOrigin::Array(name.to_owned()), warning }
    }
}

impl Gradients<'static> {
    /// No gradients, for an interpolant that needs none.
    pub fn none() -> Self {
        Self { vectors: Cow::default(), origin: GradientOrigin::Unused, warning: None }
    }

    /// The gradients of the chosen array's values.
    ///
    /// # Errors
    /// If the array named is not there or has the wrong shape.
    pub fn new<const CORNERS: usize>(
        grid: &UnstructuredGrid,
        mesh: &SimplexMesh<CORNERS>,
        chosen: &ChosenArray,
        values: &[f64],
        source: &GradientSource,
    ) -> Result<Self, FilterError> {
        match source {
            GradientSource::Recovered => Ok(Self::recovered(mesh, values)),
            GradientSource::Array(name) => {
                let arrays = match GradientArrays::named(grid, name) {
                    Some(arrays) => arrays,
                    None => return Err(missing(grid, name)),
                };
                let vectors = arrays.vectors(chosen).ok_or_else(|| wrong_shape(&arrays, chosen))?;
                Ok(Self::given(mesh, values, vectors.into(), name, &chosen.label()))
            }
            GradientSource::Automatic => Ok(Self::automatic(grid, mesh, chosen, values)),
        }
    }

    /// Gradients recovered from the values.
    pub fn recovered<const CORNERS: usize>(mesh: &SimplexMesh<CORNERS>, values: &[f64]) -> Self {
        let vectors = recover_gradients(mesh, values, RecoveryDegree::default()).into();
        Self { vectors, origin: GradientOrigin::Recovered, warning: None }
    }

    /// By the shape functions of quadratic cells, at their points; recovered at
    /// points that have none. Nothing if no point has any.
    fn of_cells<const CORNERS: usize>(
        grid: &UnstructuredGrid,
        mesh: &SimplexMesh<CORNERS>,
        values: &[f64],
    ) -> Option<Self> {
        let known = nodal_gradients(grid, mesh.points(), values, CORNERS as u8 - 1)?;
        if known.iter().all(Option::is_none) {
            return None;
        }
        let mut corners = mesh.simplices().iter().flatten();
        let vectors: Vec<Vector> = if corners.all(|&point| known[point as usize].is_some()) {
            known.into_iter().map(Option::unwrap_or_default).collect()
        } else {
            let recovered = recover_gradients(mesh, values, RecoveryDegree::default());
            let pairs = known.into_iter().zip(recovered);
            pairs.map(|(known, recovered)| known.unwrap_or(recovered)).collect()
        };
        Some(Self { vectors: vectors.into(), origin: GradientOrigin::Cells, warning: None })
    }

    /// An array with a conventional name that fits the values, else by quadratic
    /// cells, else recovered.
    fn automatic<const CORNERS: usize>(
        grid: &UnstructuredGrid,
        mesh: &SimplexMesh<CORNERS>,
        chosen: &ChosenArray,
        values: &[f64],
    ) -> Self {
        let mut refused = None;
        for arrays in GradientArrays::conventional(grid, &chosen.array.name) {
            let Some(vectors) = arrays.vectors(chosen) else { continue };
            let misfit = misfit(mesh, values, &vectors);
            if misfit <= WORST_FIT {
                let origin = GradientOrigin::Array(arrays.name());
                return Self { vectors: vectors.into(), origin, warning: None };
            }
            if arrays.is_certain {
                refused.get_or_insert_with(|| {
                    format!(
                        "array '{0}' is not used as the gradient of '{1}': {2} \
                         (--gradient '{0}' forces it)",
                        arrays.name(),
                        chosen.label(),
                        difference(misfit)
                    )
                });
            }
        }
        let other = Self::of_cells(grid, mesh, values);
        let other = other.unwrap_or_else(|| Self::recovered(mesh, values));
        Self { warning: refused, ..other }
    }
}

/// A gradient fits if the values' differences along edges agree with it on
/// average to better than this: half, for on a coarse mesh much is curvature.
const WORST_FIT: f64 = 0.5;

/// Differences below this part of the values are rounding, of single precision too.
const ROUNDING: f64 = 1e-7;

/// So many simplices, evenly spread, tell whether a gradient fits: a mean needs no more.
const SAMPLE: usize = 1 << 14;

/// How much the values' differences along edges differ from the mean of the
/// gradients at the ends, relative to the differences.
fn misfit<const CORNERS: usize>(
    mesh: &SimplexMesh<CORNERS>,
    values: &[f64],
    gradients: &[Vector],
) -> f64 {
    let (mut wrong, mut all, mut rounding) = (0.0, 0.0, 0.0);
    // by neither 2 nor 3, so that it picks all of the simplices into which bricks are cut
    let step = mesh.simplices().len() / SAMPLE / 6 * 6 + 1;
    for corners in mesh.simplices().iter().step_by(step) {
        for [from, to] in pairs(corners) {
            let difference = values[to] - values[from];
            let edge = mesh.points()[to] - mesh.points()[from];
            let expected = (gradients[from] + gradients[to]).dot(&edge) / 2.0;
            let error = (difference - expected).abs();
            if error.is_finite() {
                wrong += error;
                all += difference.abs();
                rounding += ROUNDING * values[from].abs();
            }
        }
    }
    // the gradient of a constant is zero, or rounding
    if wrong <= rounding { 0.0 } else { wrong / all }
}

/// The edges of a simplex, by their points.
fn pairs<const CORNERS: usize>(corners: &[u32; CORNERS]) -> impl Iterator<Item = [usize; 2]> {
    (0..CORNERS)
        .flat_map(move |to| (0..to).map(move |from| [from, to].map(|n| corners[n] as usize)))
}

/// How far values differ from a gradient, in words.
fn difference(misfit: f64) -> String {
    if misfit < 10.0 {
        format!("values along edges differ from it by {:.0} %", 100.0 * misfit)
    } else {
        "values change far less than it says".to_owned()
    }
}

/// There is no array of this name, or one of those between its commas cannot be a
/// component.
fn missing(grid: &UnstructuredGrid, name: &str) -> FilterError {
    let parts = name.split(',').map(str::trim);
    let missing = parts.filter_map(|part| named(grid, part).err()).next();
    missing.unwrap_or_else(|| FilterError::GradientParts { name: name.to_owned() })
}

fn wrong_shape(arrays: &GradientArrays, chosen: &ChosenArray) -> FilterError {
    let expected = match chosen.component {
        Some(Component::Magnitude) if chosen.array.components > 1 => {
            "the gradient of a magnitude is always recovered: leave --gradient out; none".to_owned()
        }
        Some(_) if chosen.array.components > 1 => {
            format!("3 for each of the {} components of a vector", chosen.array.components)
        }
        _ => "3".to_owned(),
    };
    let (name, components) = (arrays.name(), arrays.components());
    FilterError::GradientShape { name, components, expected }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::TriangleMesh;

    #[test]
    fn a_sample_tells_of_all_of_a_large_mesh() {
        // squares of two triangles, in a row
        let squares = 2 * SAMPLE as u32;
        let points = (0..=squares).flat_map(|n| [0.0, 1.0].map(|y| Vector::new(n.into(), y, 0.0)));
        let points: Vec<Vector> = points.collect();
        let cut = |n: u32| [[2 * n, 2 * n + 2, 2 * n + 1], [2 * n + 2, 2 * n + 3, 2 * n + 1]];
        let mesh = TriangleMesh::new(points, (0..squares).flat_map(cut).collect()).unwrap();
        let along = vec![Vector::x(); mesh.points().len()];
        let values = |slope: fn(f64) -> f64| -> Vec<f64> {
            mesh.points().iter().map(|point| slope(point.x)).collect()
        };
        assert_eq!(misfit(&mesh, &values(|x| x), &along), 0.0);
        // constant in one half
        let half = misfit(&mesh, &values(|x| x.min(f64::from(SAMPLE as u32))), &along);
        assert!((half - 1.0).abs() < 1e-3, "{half}");
        let across = vec![Vector::y(); mesh.points().len()];
        let none = misfit(&mesh, &values(|x| x), &across);
        // wrong by 1, 2 and 1 along sides on which values change by 1, 1 and 0
        assert!((none - 2.0).abs() < 1e-3, "{none}");
    }
}
