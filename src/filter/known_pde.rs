//! The PDE that is known of a solution, with what it takes from the grid.

use super::error::FilterError;
use super::options::{ContourOptions, InterpolantKind};
use crate::interpolant::{Equation, Predictor};
use crate::pde::{Pde, PdeError, Problem, is_free_name};
use crate::vtk::{DataArray, UnstructuredGrid};

/// A PDE, and the values of each point array that it names.
pub struct KnownPde {
    /// The PDE.
    pub pde: Pde,
    /// One value a point of each array of [`Pde::used_arrays`].
    pub arrays: Vec<Vec<f64>>,
    /// What people should know, a line each.
    pub warnings: Vec<String>,
}

impl KnownPde {
    /// The PDE of the options. Its names may be parameters, field arrays of one number
    /// (a parameter of that name wins) and point arrays of one component.
    ///
    /// # Errors
    /// If the PDE cannot be read, or there is one for an interpolant that uses none.
    pub fn of_grid(
        grid: &UnstructuredGrid,
        options: &ContourOptions,
    ) -> Result<Option<Self>, FilterError> {
        let Some(text) = &options.pde else { return Ok(None) };
        if options.interpolant != InterpolantKind::Pci {
            return Err(FilterError::UnusedPde);
        }
        let scalars: Vec<_> = grid.point_data.iter().filter(|a| a.components == 1).collect();
        let names: Vec<String> = scalars.iter().map(|array| array.name.clone()).collect();
        let mut parameters = options.parameters.clone();
        parameters.extend(parameters_of_file(grid, options));
        let pde = Pde::parse(text, &parameters, &names).map_err(|error| explained(grid, error))?;
        let values = |&place: &usize| scalars[place].to_f64().unwrap_or_default();
        let arrays = pde.used_arrays().iter().map(values).collect();
        let warnings = unused(&pde, options).collect();
        Ok(Some(Self { pde, arrays, warnings }))
    }
}

impl KnownPde {
    /// The PDE as interpolants use it.
    pub fn equation(&self, predictor: Predictor) -> Equation<'_> {
        Equation { pde: &self.pde, arrays: &self.arrays, predictor }
    }
}

/// Field arrays of one number, as parameters; not those whose name has a meaning already.
fn parameters_of_file(grid: &UnstructuredGrid, options: &ContourOptions) -> Vec<(String, f64)> {
    let is_taken = |name: &str| {
        let is_given = options.parameters.iter().any(|(given, _)| given == name);
        is_given || grid.point_data.get(name).is_some() || !is_free_name(name)
    };
    let number = |array: &DataArray| match array.to_f64()?[..] {
        [value] if value.is_finite() => Some((array.name.clone(), value)),
        _ => None,
    };
    grid.field_data.iter().filter(|array| !is_taken(&array.name)).filter_map(number).collect()
}

fn unused(pde: &Pde, options: &ContourOptions) -> impl Iterator<Item = String> {
    let given = pde.unused_parameters().iter().filter_map(|&place| options.parameters.get(place));
    given.map(|(name, _)| format!("the PDE does not use the parameter '{name}'"))
}

/// The error of an unknown name that the grid knows all the same.
fn explained(grid: &UnstructuredGrid, error: PdeError) -> FilterError {
    let Problem::UnknownName { name, .. } = error.problem() else { return error.into() };
    let cure = if let Some(array) = grid.point_data.get(name) {
        format!(
            "is a point array of {} components, and an equation takes arrays of one: if it is \
             the gradient of u, write ux, uy, uz; else store the component that is meant as an \
             array of its own",
            array.components
        )
    } else if grid.field_data.get(name).is_some() {
        format!("is a field array, but not of one number: give --param {name}=VALUE")
    } else if grid.cell_data.get(name).is_some() {
        "is a cell array, and an equation takes point arrays: convert it first, for example with \
         ParaView's Cell Data to Point Data"
            .to_owned()
    } else {
        return error.into();
    };
    FilterError::PdeName { name: name.clone(), cure }
}
