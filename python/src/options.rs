//! What to contour and how, as Python says it.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use vtu2contour::contour::Levels;
use vtu2contour::contour::lines::Method;
use vtu2contour::filter::{Component, ContourOptions, GradientSource, InterpolantKind};
use vtu2contour::interpolant::Predictor;
use vtu2contour::monitor::Selection;

/// What the interpolant is made of: a dictionary with these keys.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct SolutionOptions {
    scalars: Option<String>,
    component: Option<ComponentChoice>,
    gradient: Option<String>,
    merge_points: Option<f64>,
    interpolant: String,
    pde: Option<String>,
    parameters: Vec<(String, f64)>,
    predictor: String,
}

/// A number, or `"mag"`.
#[derive(FromPyObject)]
enum ComponentChoice {
    Number(usize),
    Name(String),
}

/// How contours are drawn: a dictionary with these keys.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct DrawingOptions {
    levels: Option<Vec<f64>>,
    count: usize,
    range: Option<[f64; 2]>,
    method: Option<String>,
    spacing: Option<f64>,
    tolerance: Option<f64>,
    nside: Option<u32>,
    triangles: Option<usize>,
    size: Option<f64>,
    double: Option<bool>,
    segments: bool,
    gradients: bool,
    normals: bool,
}

impl SolutionOptions {
    /// As the library takes them.
    ///
    /// # Errors
    /// `ValueError` for a word that is none of those to choose from.
    pub fn options(self) -> PyResult<ContourOptions> {
        let component = match self.component {
            None => None,
            Some(ComponentChoice::Number(number)) => Some(Component::Number(number)),
            Some(ComponentChoice::Name(name)) => {
                let magnitude = [("mag", Component::Magnitude)];
                Some(chosen("component", &name, &magnitude)?)
            }
        };
        let gradient = match self.gradient.as_deref() {
            None => GradientSource::Automatic,
            Some("recover") => GradientSource::Recovered,
            Some(name) => GradientSource::Array(name.to_owned()),
        };
        let interpolants = [
            ("pci", InterpolantKind::Pci),
            ("quadratic-precision", InterpolantKind::QuadraticPrecision),
            ("linear", InterpolantKind::Linear),
        ];
        let predictors = [("quadratic", Predictor::Quadratic), ("linear", Predictor::Linear)];
        Ok(ContourOptions {
            array: self.scalars,
            component,
            gradient,
            merge_points: self.merge_points,
            interpolant: chosen("interpolant", &self.interpolant, &interpolants)?,
            pde: self.pde,
            parameters: self.parameters,
            predictor: chosen("predictor", &self.predictor, &predictors)?,
            ..ContourOptions::default()
        })
    }
}

impl DrawingOptions {
    /// As the library takes them.
    ///
    /// # Errors
    /// `ValueError` for a word that is none of those to choose from.
    pub fn options(self) -> PyResult<ContourOptions> {
        let methods = [
            ("intercept", Method::Intercept),
            ("sode", Method::Sode),
            ("odea", Method::Odea),
            ("aodea", Method::Aodea),
        ];
        let method = self.method.map(|name| chosen("method", &name, &methods)).transpose()?;
        let equal = Levels::Equal { count: self.count, range: self.range };
        Ok(ContourOptions {
            levels: self.levels.map_or(equal, Levels::Explicit),
            method: method.unwrap_or_default(),
            spacing: self.spacing,
            tolerance: self.tolerance,
            points_per_side: self.nside,
            triangles: self.triangles,
            size: self.size,
            single: self.double.map(|double| !double),
            segments: self.segments,
            gradients: self.gradients,
            normals: self.normals,
            ..ContourOptions::default()
        })
    }
}

/// What is contoured and how, in one.
///
/// # Errors
/// `ValueError` for a word that is none of those to choose from.
pub fn joined(solution: SolutionOptions, drawing: DrawingOptions) -> PyResult<ContourOptions> {
    let drawing = drawing.options()?;
    Ok(ContourOptions {
        levels: drawing.levels,
        method: drawing.method,
        spacing: drawing.spacing,
        tolerance: drawing.tolerance,
        points_per_side: drawing.points_per_side,
        triangles: drawing.triangles,
        size: drawing.size,
        single: drawing.single,
        segments: drawing.segments,
        gradients: drawing.gradients,
        normals: drawing.normals,
        ..solution.options()?
    })
}

/// How cells are selected, and by which number.
///
/// # Errors
/// `ValueError` for a word that is none of those to choose from.
pub fn selection((how, number): (String, f64)) -> PyResult<Selection> {
    type ByNumber = fn(f64) -> Selection;
    let selections: [(&str, ByNumber); 4] = [
        ("average", Selection::AboveAverage),
        ("fraction", Selection::Fraction),
        ("bulk", Selection::Bulk),
        ("tolerance", Selection::Above),
    ];
    Ok(chosen("select", &how, &selections)?(number))
}

/// What a word stands for.
///
/// # Errors
/// `ValueError` if it is none of those to choose from.
pub fn chosen<T: Copy>(argument: &str, word: &str, choices: &[(&str, T)]) -> PyResult<T> {
    match choices.iter().find(|(name, _)| *name == word) {
        Some((_, choice)) => Ok(*choice),
        None => {
            let names: Vec<String> = choices.iter().map(|(name, _)| format!("'{name}'")).collect();
            let names = names.join(" or ");
            Err(PyValueError::new_err(format!("{argument} must be {names}, not '{word}'")))
        }
    }
}
