//! The interpolant of NumPy arrays, which stay where they are.

use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

use numpy::{
    PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use vtu2contour::filter::{
    ContourOptions, ContouredSolution, Contours, FilterError, GradientOrigin, Gradients,
    Interpolant, InterpolantKind, Interpolation, KnownPde, Locators, Monitored, Solution,
};
use vtu2contour::mesh::{SimplexMesh, TetrahedronMesh, TriangleMesh, Vector};

use super::arrays::{rows, slice, vectors};
use super::job;
use super::monitor::{self, MonitorChoice};
use super::options::{self, DrawingOptions, SolutionOptions};
use super::output::{self, Done};

/// The interpolant of NumPy arrays, made once and contoured at any levels.
///
/// It keeps the arrays, and looks at them again whenever it is used.
#[pyclass(frozen)]
pub struct ArrayInterpolant {
    arrays: Arrays,
    /// Gradients that no array holds: recovered ones.
    recovered: Option<Vec<Vector>>,
    origin: GradientOrigin,
    interpolation: Interpolation,
    /// What it was made by.
    options: ContourOptions,
    pde: Option<Arc<KnownPde>>,
    locators: OnceLock<Locators>,
}

/// A PDE as text, its parameters, and the arrays that it may name.
type PdeParts = (String, Vec<(String, f64)>, Vec<(String, Vec<f64>)>);

/// Points, cells, values and gradients.
struct Arrays {
    points: Py<PyArray2<f64>>,
    /// Numbers of corners; a negative one becomes one that no point has.
    cells: Py<PyArray2<u32>>,
    values: Py<PyArray1<f64>>,
    gradients: Option<Py<PyArray2<f64>>>,
}

/// The same while they are looked at.
struct Borrowed<'py> {
    points: PyReadonlyArray2<'py, f64>,
    cells: PyReadonlyArray2<'py, u32>,
    values: PyReadonlyArray1<'py, f64>,
    gradients: Option<PyReadonlyArray2<'py, f64>>,
}

/// The same as slices, which threads may share.
#[derive(Clone, Copy)]
struct Slices<'a> {
    points: &'a [Vector],
    cells: Cells<'a>,
    values: &'a [f64],
    gradients: Option<&'a [Vector]>,
}

#[derive(Clone, Copy)]
enum Cells<'a> {
    Triangles(&'a [[u32; 3]]),
    Tetrahedra(&'a [[u32; 4]]),
}

impl Arrays {
    fn borrow<'py>(&self, py: Python<'py>) -> PyResult<Borrowed<'py>> {
        let gradients = self.gradients.as_ref().map(|array| array.bind(py).try_readonly());
        Ok(Borrowed {
            points: self.points.bind(py).try_readonly()?,
            cells: self.cells.bind(py).try_readonly()?,
            values: self.values.bind(py).try_readonly()?,
            gradients: gradients.transpose()?,
        })
    }
}

impl Borrowed<'_> {
    fn slices(&self) -> PyResult<Slices<'_>> {
        let corners = self.cells.as_slice();
        let corners = corners.map_err(|_| PyValueError::new_err("cells must be contiguous"))?;
        let cells = match self.cells.shape()[..] {
            [_, 3] => Cells::Triangles(bytemuck::cast_slice(corners)),
            [_, 4] => Cells::Tetrahedra(bytemuck::cast_slice(corners)),
            _ => return Err(PyValueError::new_err("cells must have shape (m, 3) or (m, 4)")),
        };
        let gradients = self.gradients.as_ref().map(|array| vectors(array, "gradients"));
        Ok(Slices {
            points: vectors(&self.points, "points")?,
            cells,
            values: slice(&self.values, "values")?,
            gradients: gradients.transpose()?,
        })
    }
}

impl<'a> Slices<'a> {
    /// The solution, of which the PDE is known or not.
    fn solution(
        &self,
        options: &ContourOptions,
        pde: Option<Arc<KnownPde>>,
    ) -> Result<Solution<'a>, FilterError> {
        match self.cells {
            Cells::Triangles(cells) => {
                let mesh = TriangleMesh::view(self.points, cells)?;
                let gradients = self.gradients(&mesh, options);
                Solution::of_triangles(mesh, self.values, gradients, pde)
            }
            Cells::Tetrahedra(cells) => {
                let mesh = TetrahedronMesh::view(self.points, cells)?;
                let gradients = self.gradients(&mesh, options);
                Solution::of_tetrahedra(mesh, self.values, gradients, pde)
            }
        }
    }

    fn gradients<const CORNERS: usize>(
        &self,
        mesh: &SimplexMesh<CORNERS>,
        options: &ContourOptions,
    ) -> Gradients<'a> {
        match self.gradients {
            _ if options.interpolant == InterpolantKind::Linear => Gradients::none(),
            Some(vectors) => {
                Gradients::given(mesh, self.values, Cow::Borrowed(vectors), "gradient", "u")
            }
            // a solution refuses other lengths
            None if self.values.len() != self.points.len() => Gradients::none(),
            None => Gradients::recovered(mesh, self.values),
        }
    }

    /// The same solution when its gradients are known.
    fn known_solution(&self, gradients: Gradients<'a>) -> Result<Solution<'a>, FilterError> {
        match self.cells {
            Cells::Triangles(cells) => {
                let mesh = TriangleMesh::view(self.points, cells)?;
                Solution::of_triangles(mesh, self.values, gradients, None)
            }
            Cells::Tetrahedra(cells) => {
                let mesh = TetrahedronMesh::view(self.points, cells)?;
                Solution::of_tetrahedra(mesh, self.values, gradients, None)
            }
        }
    }
}

impl ArrayInterpolant {
    /// Does something with the interpolant while other Python threads go on.
    fn with<T: Send>(
        &self,
        py: Python,
        job: impl FnOnce(&Interpolant) -> Result<T, FilterError> + Send,
    ) -> PyResult<T> {
        let borrowed = self.arrays.borrow(py)?;
        let slices = borrowed.slices()?;
        job::run(py, move || {
            let vectors = match &self.recovered {
                Some(recovered) => Cow::Borrowed(&recovered[..]),
                None => Cow::Borrowed(slices.gradients.unwrap_or_default()),
            };
            let gradients = Gradients { vectors, origin: self.origin.clone(), warning: None };
            let solution = slices.known_solution(gradients)?;
            let interpolation = Cow::Borrowed(&self.interpolation);
            job(&Interpolant { solution, interpolation })
        })
    }
}

#[pymethods]
impl ArrayInterpolant {
    /// Of points (n, 3), cells (m, 3) or (m, 4), values (n,) and gradients (n, 3); a PDE may
    /// name the `arrays`, which have one value a point.
    #[new]
    fn new(
        py: Python,
        points: Py<PyArray2<f64>>,
        cells: Py<PyArray2<u32>>,
        values: Py<PyArray1<f64>>,
        gradients: Option<Py<PyArray2<f64>>>,
        options: SolutionOptions,
        arrays: Vec<(String, Vec<f64>)>,
    ) -> PyResult<Self> {
        let options = options.options()?;
        let kept = Arrays { points, cells, values, gradients };
        let borrowed = kept.borrow(py)?;
        let slices = borrowed.slices()?;
        let (recovered, origin, interpolation, pde) = job::run(py, || {
            let pde = KnownPde::of_arrays(&options, slices.points.len(), arrays)?.map(Arc::new);
            let Interpolant { solution, interpolation } =
                Interpolant::new(slices.solution(&options, pde.clone())?, &options)?;
            let domains = (solution.triangles, solution.tetrahedra);
            let gradients = match domains {
                (Some(domain), _) => domain.gradients,
                (_, Some(domain)) => domain.gradients,
                (None, None) => Gradients::none(),
            };
            let recovered = match gradients.vectors {
                Cow::Owned(vectors) => Some(vectors),
                Cow::Borrowed(_) => None,
            };
            Ok((recovered, gradients.origin, interpolation.into_owned(), pde))
        })?;
        drop(borrowed);
        Ok(Self {
            arrays: kept,
            recovered,
            origin,
            interpolation,
            options,
            pde,
            locators: OnceLock::new(),
        })
    }

    /// Its contours, and what was done.
    fn contour<'py>(
        &self,
        py: Python<'py>,
        options: DrawingOptions,
    ) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyDict>)> {
        let options = options.options()?;
        let (output, done) = self.with(py, |interpolant| {
            let contours = interpolant.contours(&options)?;
            let done = Done::new(interpolant, &contours);
            Ok((interpolant.output(&contours, options.bare_output()), done))
        })?;
        Ok((output::bare_contours(py, output)?, output::report(py, &done)?))
    }

    /// A monitor of its cells, and what people should know. `pde`: another PDE than that which
    /// it was made by, with its parameters and the arrays that it may name.
    fn monitor<'py>(
        &self,
        py: Python<'py>,
        choice: MonitorChoice,
        pde: Option<PdeParts>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let options = choice.options()?;
        let monitored = self.with(py, |interpolant| {
            let other = match pde {
                None => None,
                Some((text, parameters, arrays)) => {
                    let (pde, points) = (Some(text), interpolant.solution.values.len());
                    let given = ContourOptions { pde, parameters, ..self.options.clone() };
                    KnownPde::of_arrays(&given, points, arrays)?
                }
            };
            let pde = other.as_ref().or(self.pde.as_deref());
            let domains = (&interpolant.solution.triangles, &interpolant.solution.tetrahedra);
            let cells = match domains {
                (Some(domain), _) => domain.count(),
                (_, Some(domain)) => domain.count(),
                (None, None) => 0,
            };
            Monitored::new(interpolant, cells, &options, &self.options, pde)
        })?;
        monitor::dictionary(py, monitored, &self.interpolation.warnings)
    }

    /// Values at points, and gradients.
    #[allow(clippy::type_complexity)] // a pair of arrays
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<f64>,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray2<f64>>)> {
        let points = vectors(&points, "points")?;
        let (values, gradients): (Vec<f64>, Vec<Vector>) = self.with(py, |interpolant| {
            let locators = job::kept(&self.locators, || Locators::new(&interpolant.solution));
            Ok(locators.evaluate(interpolant, points).into_iter().unzip())
        })?;
        Ok((PyArray1::from_vec(py, values), rows(py, gradients)?))
    }

    /// What people should know of it, a line each.
    fn warnings(&self) -> Vec<String> {
        output::warnings(&self.interpolation)
    }

    /// What is known of it.
    fn info<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let borrowed = self.arrays.borrow(py)?;
        let slices = borrowed.slices()?;
        let gradients =
            Gradients { vectors: Cow::default(), origin: self.origin.clone(), warning: None };
        let solution = slices.known_solution(gradients).map_err(|e| super::error::exception(&e))?;
        let interpolation = Cow::Borrowed(&self.interpolation);
        output::information(py, &Interpolant { solution, interpolation })
    }
}

/// The contours of arrays as an [`ArrayInterpolant`] takes them, and what was done: for once, so
/// that little is computed where no level is.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // those of `ArrayInterpolant`, and how to draw
pub fn contour_arrays<'py>(
    py: Python<'py>,
    points: Py<PyArray2<f64>>,
    cells: Py<PyArray2<u32>>,
    values: Py<PyArray1<f64>>,
    gradients: Option<Py<PyArray2<f64>>>,
    solution: SolutionOptions,
    arrays: Vec<(String, Vec<f64>)>,
    drawing: DrawingOptions,
) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyDict>)> {
    let options = options::joined(solution, drawing)?;
    let kept = Arrays { points, cells, values, gradients };
    let borrowed = kept.borrow(py)?;
    let slices = borrowed.slices()?;
    let (output, done) = job::run(py, || {
        let pde = KnownPde::of_arrays(&options, slices.points.len(), arrays)?.map(Arc::new);
        let contoured = ContouredSolution::new(slices.solution(&options, pde)?, &options)?;
        let Contours { lines, surface, .. } = &contoured.contours;
        let done = Done::of_report(contoured.report(), lines.as_ref(), surface.as_ref());
        Ok((contoured.output(options.bare_output()), done))
    })?;
    Ok((output::bare_contours(py, output)?, output::report(py, &done)?))
}
