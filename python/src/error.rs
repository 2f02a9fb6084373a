//! The library's errors as Python exceptions.

use pyo3::exceptions::PyValueError;
use pyo3::{PyErr, create_exception};
use vtu2contour::filter::FilterError;

create_exception!(
    vtu2contour,
    MissingArrayError,
    PyValueError,
    "The mesh has no point array of that name, or none at all."
);
create_exception!(
    vtu2contour,
    NothingToContourError,
    PyValueError,
    "The mesh has no cells that can be contoured, or no finite values in them."
);

/// What the texts name as options of the command line are arguments here.
const ARGUMENTS: [(&str, &str); 17] = [
    ("give --array NAME", "give scalars=NAME"),
    ("--component 0..", "component=0.."),
    ("--component mag", "component='mag'"),
    ("(--gradient '", "(gradient='"),
    ("leave --gradient out", "leave gradient out"),
    ("--gradient", "gradient"),
    ("give --pde EQUATION", "give pde=EQUATION"),
    ("--select", "select"),
    ("leave --interpolant out", "leave interpolant out"),
    ("--pde", "pde"),
    ("give --param ", "give parameters "),
    ("--tolerance, --nside and --triangles", "tolerance, nside and triangles"),
    ("--merge-points 0", "merge_points=0"),
    ("--merge-points", "merge_points"),
    ("--method delaunay", "method='delaunay'"),
    ("--interpolant linear", "interpolant='linear'"),
    ("--", ""),
];

/// The exception of an error, with its text: a `ValueError`.
pub fn exception(error: &FilterError) -> PyErr {
    let text = in_python(&error.to_string());
    match error {
        FilterError::NoSuchArray { .. } | FilterError::NoPointArrays { .. } => {
            MissingArrayError::new_err(text)
        }
        _ if error.is_nothing_to_contour() => NothingToContourError::new_err(text),
        _ => PyValueError::new_err(text),
    }
}

/// A text with the names that arguments have in Python.
pub fn in_python(text: &str) -> String {
    ARGUMENTS
        .iter()
        .fold(text.to_owned(), |text, (option, argument)| text.replace(option, argument))
}
