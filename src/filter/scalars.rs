//! Which array to contour, and its gradient.

use super::error::FilterError;
use super::gradient_arrays::GradientArrays;
use crate::field::{RecoveryDegree, recover_gradients};
use crate::mesh::{TriangleMesh, Vector};
use crate::vtk::{ArrayType, AttributeKind, Attributes, DataArray, UnstructuredGrid};

/// What to take of an array with several components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// One component, from 0.
    Number(usize),
    /// The length of the vector.
    Magnitude,
}

/// Where the gradient comes from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum GradientSource {
    /// An array with a conventional name if there is one that fits the values;
    /// else recovered.
    #[default]
    Automatic,
    /// This array.
    Array(String),
    /// Recovered from the values.
    Recovered,
}

/// The array that is contoured.
#[derive(Clone, Copy, Debug)]
pub struct ChosenArray<'a> {
    /// The array.
    pub array: &'a DataArray,
    /// What of it, if it has several components.
    pub component: Option<Component>,
}

impl<'a> ChosenArray<'a> {
    /// Chooses the array: by its name; else the active scalars; else the only
    /// array of one component.
    ///
    /// # Errors
    /// If there is no such array, or more than one that could be meant, or the
    /// component does not fit; the message lists what there is.
    pub fn new(
        grid: &'a UnstructuredGrid,
        name: Option<&str>,
        component: Option<Component>,
    ) -> Result<Self, FilterError> {
        let array = match name {
            Some(name) => named(grid, name)?,
            None => default_array(grid)?,
        };
        let chosen = Self { array, component };
        chosen.check()?;
        Ok(chosen)
    }

    fn check(&self) -> Result<(), FilterError> {
        let name = self.array.name.clone();
        let components = self.array.components;
        match self.component {
            _ if self.array.array_type() == ArrayType::String => {
                Err(FilterError::NotNumbers { name })
            }
            None if components > 1 => Err(FilterError::NoComponent { name, components }),
            Some(Component::Number(component)) if component >= components => {
                Err(FilterError::NoSuchComponent { name, component, components })
            }
            _ => Ok(()),
        }
    }

    /// One value a point.
    pub fn values(&self) -> Vec<f64> {
        let values = match self.component {
            Some(Component::Magnitude) => self.array.magnitude(),
            Some(Component::Number(component)) => self.array.component(component),
            None => self.array.component(0),
        };
        values.unwrap_or_default()
    }

    /// What is contoured, for people: `velocity`, `velocity[1]`, `|velocity|`.
    pub fn label(&self) -> String {
        let name = &self.array.name;
        match self.component {
            Some(Component::Number(component)) if self.array.components > 1 => {
                format!("{name}[{component}]")
            }
            Some(Component::Magnitude) => format!("|{name}|"),
            _ => name.clone(),
        }
    }
}

fn named<'a>(grid: &'a UnstructuredGrid, name: &str) -> Result<&'a DataArray, FilterError> {
    if let Some(array) = grid.point_data.get(name) {
        return Ok(array);
    }
    if grid.cell_data.get(name).is_some() {
        return Err(FilterError::CellArray { name: name.to_owned() });
    }
    let available = listed(&grid.point_data);
    Err(FilterError::NoSuchArray { name: name.to_owned(), available })
}

fn default_array(grid: &UnstructuredGrid) -> Result<&DataArray, FilterError> {
    if let Some(active) = grid.point_data.active(AttributeKind::Scalars) {
        return Ok(active);
    }
    let scalars: Vec<&DataArray> = grid.point_data.iter().filter(|a| is_scalar(a)).collect();
    match scalars[..] {
        [only] => Ok(only),
        _ if grid.point_data.is_empty() => {
            Err(FilterError::NoPointArrays { cell_arrays: !grid.cell_data.is_empty() })
        }
        _ => Err(FilterError::AmbiguousArray { available: listed(&grid.point_data) }),
    }
}

/// Whether an array holds one number a point, other than VTK's own marks.
fn is_scalar(array: &DataArray) -> bool {
    let mark = array.name.starts_with("vtkGhost") || array.name.starts_with("vtkOriginal");
    array.components == 1 && array.array_type() != ArrayType::String && !mark
}

fn listed(arrays: &Attributes) -> String {
    let names: Vec<String> = arrays.iter().map(|array| format!("'{}'", array.name)).collect();
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

/// Gradients at the points, and where they came from.
#[derive(Clone, Debug)]
pub struct Gradients {
    /// One gradient a point.
    pub vectors: Vec<Vector>,
    /// The array they came from; nothing if they were recovered.
    pub array: Option<String>,
    /// What people should know about the choice.
    pub warning: Option<String>,
}

impl Gradients {
    /// No gradients, for an interpolant that needs none.
    pub fn none() -> Self {
        Self { vectors: Vec::new(), array: None, warning: None }
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
                let arrays = match GradientArrays::named(grid, name) {
                    Some(arrays) => arrays,
                    None => return Err(missing(grid, name)),
                };
                let vectors = arrays.vectors(chosen).ok_or_else(|| wrong_shape(&arrays, chosen))?;
                let misfit = misfit(mesh, values, &vectors);
                let warning = (misfit > WORST_FIT).then(|| {
                    format!(
                        "array '{name}' does not look like the gradient of '{}': {}",
                        chosen.label(),
                        difference(misfit)
                    )
                });
                Ok(Self { vectors, array: Some(name.clone()), warning })
            }
            GradientSource::Automatic => Ok(Self::automatic(grid, mesh, chosen, values)),
        }
    }

    fn recovered(mesh: &TriangleMesh, values: &[f64]) -> Self {
        let vectors = recover_gradients(mesh, values, RecoveryDegree::default());
        Self { vectors, array: None, warning: None }
    }

    /// An array with a conventional name that fits the values, else recovered.
    fn automatic(
        grid: &UnstructuredGrid,
        mesh: &TriangleMesh,
        chosen: &ChosenArray,
        values: &[f64],
    ) -> Self {
        let mut refused = None;
        for arrays in GradientArrays::conventional(grid, &chosen.array.name) {
            let Some(vectors) = arrays.vectors(chosen) else { continue };
            let misfit = misfit(mesh, values, &vectors);
            if misfit <= WORST_FIT {
                return Self { vectors, array: Some(arrays.name()), warning: None };
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
        Self { warning: refused, ..Self::recovered(mesh, values) }
    }
}

/// A gradient fits if the values' differences along edges agree with it on
/// average to better than this: half, for on a coarse mesh much is curvature.
const WORST_FIT: f64 = 0.5;

/// Differences below this part of the values are rounding, of single precision too.
const ROUNDING: f64 = 1e-7;

/// How much the values' differences along edges differ from the mean of the
/// gradients at the ends, relative to the differences.
fn misfit(mesh: &TriangleMesh, values: &[f64], gradients: &[Vector]) -> f64 {
    let (mut wrong, mut all, mut rounding) = (0.0, 0.0, 0.0);
    for &[a, b, c] in mesh.triangles() {
        for (from, to) in [(a, b), (b, c), (c, a)].map(|(p, q)| (p as usize, q as usize)) {
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
