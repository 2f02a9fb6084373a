//! Which array to contour.

use super::error::FilterError;
use crate::vtk::{ArrayType, AttributeKind, Attributes, DataArray, UnstructuredGrid};

/// What to take of an array with several components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// One component, from 0.
    Number(usize),
    /// The length of the vector.
    Magnitude,
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

/// The point array of that name.
pub fn named<'a>(grid: &'a UnstructuredGrid, name: &str) -> Result<&'a DataArray, FilterError> {
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
