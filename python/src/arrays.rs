//! NumPy arrays as the library's, and back.

use numpy::{
    Element, PyArray1, PyArray2, PyArrayDyn, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use vtu2contour::mesh::Vector;
use vtu2contour::vtk::{DataArray, Values};

/// A named array as it comes from Python: its name, its values (numbers of one or two axes,
/// or a list of texts), the names of its components.
pub type NamedArray<'py> = (String, Bound<'py, PyAny>, Vec<String>);

/// An array that borrows nothing from Python.
///
/// # Errors
/// `TypeError` for what holds neither numbers nor texts.
pub fn data_array((name, values, component_names): NamedArray) -> PyResult<DataArray> {
    if let Ok(texts) = values.extract::<Vec<String>>() {
        return Ok(DataArray { component_names, ..DataArray::new(name, 1, texts) });
    }
    let found = numbers(&values)
        .ok_or_else(|| PyTypeError::new_err(format!("array '{name}' does not hold numbers")))?;
    let (components, values) = found?;
    Ok(DataArray { component_names, ..DataArray::new(name, components, values) })
}

/// Components and values of an array of numbers; nothing if it is none.
fn numbers(array: &Bound<PyAny>) -> Option<PyResult<(usize, Values)>> {
    None.or_else(|| of_type::<f64>(array))
        .or_else(|| of_type::<f32>(array))
        .or_else(|| of_type::<i64>(array))
        .or_else(|| of_type::<i32>(array))
        .or_else(|| of_type::<u8>(array))
        .or_else(|| of_type::<i8>(array))
        .or_else(|| of_type::<i16>(array))
        .or_else(|| of_type::<u16>(array))
        .or_else(|| of_type::<u32>(array))
        .or_else(|| of_type::<u64>(array))
}

fn of_type<T: Element + Copy>(array: &Bound<PyAny>) -> Option<PyResult<(usize, Values)>>
where
    Values: From<Vec<T>>,
{
    let array = array.cast::<PyArrayDyn<T>>().ok()?;
    let components = array.shape().get(1).copied().unwrap_or(1);
    // in C's order whatever the order in memory
    let values = array.try_readonly().map(|array| match array.as_slice() {
        Ok(values) => values.to_vec(),
        Err(_) => array.as_array().iter().copied().collect(),
    });
    Some(values.map(|values| (components, values.into())).map_err(PyErr::from))
}

/// Numbers in C's order, one after the other in memory.
///
/// # Errors
/// `ValueError` if they are not.
pub fn slice<'a, T: Element>(array: &'a PyReadonlyArray1<T>, name: &str) -> PyResult<&'a [T]> {
    array.as_slice().map_err(|_| not_contiguous(name))
}

/// Rows of three numbers as vectors, where they are.
///
/// # Errors
/// `ValueError` if there are not three to a row, one after the other in memory.
pub fn vectors<'a>(array: &'a PyReadonlyArray2<f64>, name: &str) -> PyResult<&'a [Vector]> {
    let [_, 3] = array.shape()[..] else {
        return Err(PyValueError::new_err(format!("{name} must have shape (n, 3)")));
    };
    array.as_slice().map(bytemuck::cast_slice).map_err(|_| not_contiguous(name))
}

fn not_contiguous(name: &str) -> PyErr {
    PyValueError::new_err(format!("{name} must be contiguous, in C's order"))
}

/// Vectors as an array of rows of three. Nothing is copied.
pub fn rows(py: Python, vectors: Vec<Vector>) -> PyResult<Bound<PyArray2<f64>>> {
    let count = vectors.len();
    PyArray1::from_vec(py, bytemuck::cast_vec::<Vector, f64>(vectors)).reshape([count, 3])
}

/// An array's values as NumPy's; a list for texts. Nothing is copied.
pub fn to_python(py: Python, array: DataArray) -> PyResult<Bound<PyAny>> {
    let components = array.components;
    match array.values {
        Values::F64(values) => shaped(py, values, components),
        Values::F32(values) => shaped(py, values, components),
        Values::I64(values) => shaped(py, values, components),
        Values::I32(values) => shaped(py, values, components),
        Values::I16(values) => shaped(py, values, components),
        Values::I8(values) => shaped(py, values, components),
        Values::U64(values) => shaped(py, values, components),
        Values::U32(values) => shaped(py, values, components),
        Values::U16(values) => shaped(py, values, components),
        Values::U8(values) => shaped(py, values, components),
        Values::Strings(texts) => Ok(texts.into_pyobject(py)?.into_any()),
    }
}

fn shaped<T: Element>(py: Python, values: Vec<T>, components: usize) -> PyResult<Bound<PyAny>> {
    let tuples = values.len() / components.max(1);
    let array = PyArray1::from_vec(py, values);
    if components == 1 {
        return Ok(array.into_any());
    }
    Ok(array.reshape([tuples, components])?.into_any())
}
