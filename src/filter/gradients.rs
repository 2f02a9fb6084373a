//! The gradient of the array that is contoured.

use std::fmt;

use super::chosen_array::{ChosenArray, Component, named};
use super::error::FilterError;
use crate::field::{RecoveryDegree, recover_gradients};
use crate::mesh::{TriangleMesh, Vector};
use crate::simplices::{nodal_gradients, vectors};
use crate::vtk::{DataArray, UnstructuredGrid};

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
pub struct Gradients {
    /// One gradient a point.
    pub vectors: Vec<Vector>,
    /// Where they came from.
    pub origin: GradientOrigin,
    /// What people should know about the choice.
    pub warning: Option<String>,
}

impl Gradients {
    /// No gradients, for an interpolant that needs none.
    pub fn none() -> Self {
        Self { vectors: Vec::new(), origin: GradientOrigin::Unused, warning: None }
    }

    /// The gradients of the chosen array's values.
    ///
    /// # Errors
    /// If the array named is not there or has the wrong shape.
    pub fn new(
        grid: &UnstructuredGrid,
        mesh: &TriangleMesh,
        chosen: &ChosenArray,
        values: &[f64],
        source: &GradientSource,
    ) -> Result<Self, FilterError> {
        match source {
            GradientSource::Recovered => Ok(Self::recovered(mesh, values)),
            GradientSource::Array(name) => {
                let array = named(grid, name)?;
                let vectors =
                    gradient_of(array, chosen).ok_or_else(|| wrong_shape(array, chosen))?;
                let misfit = misfit(mesh, values, &vectors);
                let warning = (misfit > WORST_FIT).then(|| {
                    format!(
                        "array '{name}' does not look like the gradient of '{}': values along \
                         edges differ from it by {:.0} %",
                        chosen.label(),
                        100.0 * misfit
                    )
                });
                Ok(Self { vectors, origin: GradientOrigin::Array(name.clone()), warning })
            }
            GradientSource::Automatic => Ok(Self::automatic(grid, mesh, chosen, values)),
        }
    }

    fn recovered(mesh: &TriangleMesh, values: &[f64]) -> Self {
        let vectors = recover_gradients(mesh, values, RecoveryDegree::default());
        Self { vectors, origin: GradientOrigin::Recovered, warning: None }
    }

    /// By the shape functions of quadratic cells, at their points; recovered at
    /// points that have none. Nothing if no point has any.
    fn of_cells(grid: &UnstructuredGrid, mesh: &TriangleMesh, values: &[f64]) -> Option<Self> {
        let known = nodal_gradients(grid, mesh.points(), values, 2)?;
        if known.iter().all(Option::is_none) {
            return None;
        }
        let mut corners = mesh.triangles().iter().flatten();
        let vectors = if corners.all(|&point| known[point as usize].is_some()) {
            known.into_iter().map(Option::unwrap_or_default).collect()
        } else {
            let recovered = recover_gradients(mesh, values, RecoveryDegree::default());
            let pairs = known.into_iter().zip(recovered);
            pairs.map(|(known, recovered)| known.unwrap_or(recovered)).collect()
        };
        Some(Self { vectors, origin: GradientOrigin::Cells, warning: None })
    }

    /// An array with a conventional name that fits the values, else by quadratic
    /// cells, else recovered.
    fn automatic(
        grid: &UnstructuredGrid,
        mesh: &TriangleMesh,
        chosen: &ChosenArray,
        values: &[f64],
    ) -> Self {
        let mut refused = None;
        for array in conventional(grid, &chosen.array.name) {
            let Some(vectors) = gradient_of(array, chosen) else { continue };
            let misfit = misfit(mesh, values, &vectors);
            if misfit <= WORST_FIT {
                let origin = GradientOrigin::Array(array.name.clone());
                return Self { vectors, origin, warning: None };
            }
            refused.get_or_insert_with(|| {
                format!(
                    "array '{0}' is not used as the gradient of '{1}': values along edges differ \
                     from it by {2:.0} % (--gradient '{0}' forces it)",
                    array.name,
                    chosen.label(),
                    100.0 * misfit
                )
            });
        }
        let other = Self::of_cells(grid, mesh, values);
        let other = other.unwrap_or_else(|| Self::recovered(mesh, values));
        Self { warning: refused, ..other }
    }
}

/// A gradient fits if the values' differences along edges agree with it on
/// average to better than this: half, for on a coarse mesh much is curvature.
const WORST_FIT: f64 = 0.5;

/// How much the values' differences along edges differ from the mean of the
/// gradients at the ends, relative to the differences.
fn misfit(mesh: &TriangleMesh, values: &[f64], gradients: &[Vector]) -> f64 {
    let (mut wrong, mut all) = (0.0, 0.0);
    for &[a, b, c] in mesh.triangles() {
        for (from, to) in [(a, b), (b, c), (c, a)].map(|(p, q)| (p as usize, q as usize)) {
            let difference = values[to] - values[from];
            let edge = mesh.points()[to] - mesh.points()[from];
            let expected = (gradients[from] + gradients[to]).dot(&edge) / 2.0;
            let error = (difference - expected).abs();
            if error.is_finite() {
                wrong += error;
                all += difference.abs();
            }
        }
    }
    // the gradient of a constant is zero, or rounding
    if all > 0.0 { wrong / all } else { 0.0 }
}

/// The gradient of what is chosen, from an array of its shape: three components
/// (or two) for a scalar, three for each component of a vector.
fn gradient_of(array: &DataArray, chosen: &ChosenArray) -> Option<Vec<Vector>> {
    let of_vector = chosen.array.components > 1;
    match chosen.component {
        Some(Component::Magnitude) if of_vector => None,
        Some(Component::Number(component)) if of_vector => {
            let whole = array.components == 3 * chosen.array.components;
            let start = 3 * component;
            let part = |n: usize| array.component(start + n).filter(|_| whole);
            let (x, y, z) = (part(0)?, part(1)?, part(2)?);
            Some((0..x.len()).map(|n| Vector::new(x[n], y[n], z[n])).collect())
        }
        _ => vectors(array),
    }
}

fn wrong_shape(array: &DataArray, chosen: &ChosenArray) -> FilterError {
    let expected = match chosen.component {
        Some(Component::Magnitude) if chosen.array.components > 1 => {
            "the gradient of a magnitude is always recovered: leave --gradient out; none".to_owned()
        }
        Some(_) if chosen.array.components > 1 => {
            format!("3 for each of the {} components of a vector", chosen.array.components)
        }
        _ => "3".to_owned(),
    };
    let (name, components) = (array.name.clone(), array.components);
    FilterError::GradientShape { name, components, expected }
}

/// Arrays whose names say that they are the gradient of `name`: first those that
/// name it, then those called gradient and no more.
fn conventional<'a>(grid: &'a UnstructuredGrid, name: &str) -> Vec<&'a DataArray> {
    let name = name.to_lowercase();
    let stems = ["grad", "gradient", "gradients", "nabla"];
    let mut specific = Vec::new();
    let mut general = Vec::new();
    for array in grid.point_data.iter() {
        let candidate = array.name.to_lowercase();
        let plain: String = candidate.chars().filter(|c| !"_- ()[]{}".contains(*c)).collect();
        let wanted: String = name.chars().filter(|c| !"_- ()[]{}".contains(*c)).collect();
        if stems.iter().any(|s| plain == format!("{s}{wanted}") || plain == format!("{wanted}{s}"))
        {
            specific.push(array);
        } else if stems.contains(&plain.as_str()) {
            general.push(array);
        }
    }
    specific.extend(general);
    specific
}
