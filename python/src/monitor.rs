//! Monitors, as Python asks for them.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use vtu2contour::filter::{FamilyMember, Monitor, MonitorOptions, Monitored, SecondInterpolant};
use vtu2contour::monitor::SamplePoints;

use super::arrays::to_python;
use super::error::in_python;
use super::options::{chosen, selection};

/// Which monitor: a dictionary with these keys.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct MonitorChoice {
    kind: String,
    second: Option<String>,
    /// So many random points of a seed; fixed ones if not given.
    samples: Option<(u16, u64)>,
    /// How cells are selected, and by which number.
    select: Option<(String, f64)>,
    name: Option<String>,
}

impl MonitorChoice {
    /// As the library takes it.
    ///
    /// # Errors
    /// `ValueError` for a word that is none of those to choose from.
    pub fn options(self) -> PyResult<MonitorOptions> {
        let seconds = [
            SecondInterpolant::Member(FamilyMember::Pqi),
            SecondInterpolant::Member(FamilyMember::Fqi),
            SecondInterpolant::Member(FamilyMember::P3),
            SecondInterpolant::QuadraticPrecision,
            SecondInterpolant::Linear,
        ];
        let seconds = seconds.map(|second| (second.name(), second));
        let second = self.second.map(|name| chosen("second", &name, &seconds)).transpose()?;
        let kinds = [
            ("defect", Monitor::Defect),
            ("area", Monitor::SurfaceArea),
            ("stepwise", Monitor::StepwiseError),
            ("interpolation", Monitor::InterpolationError(second)),
        ];
        let random = |(count, seed)| SamplePoints::Random { count, seed };
        Ok(MonitorOptions {
            monitor: chosen("kind", &self.kind, &kinds)?,
            samples: self.samples.map_or(SamplePoints::Fixed, random),
            selection: self.select.map(selection).transpose()?,
            name: self.name,
        })
    }
}

/// What a monitor found: its `arrays`, by their names, its summary, and what people should know
/// (`told` when the interpolant was made are left out).
pub fn dictionary<'py>(
    py: Python<'py>,
    monitored: Monitored,
    told: &[String],
) -> PyResult<Bound<'py, PyDict>> {
    let result = PyDict::new(py);
    let warnings = monitored.warnings.iter().filter(|text| !told.contains(text));
    let warnings: Vec<String> = warnings.map(|text| in_python(text)).collect();
    result.set_item("warnings", warnings)?;
    let arrays = PyDict::new(py);
    for array in monitored.arrays {
        arrays.set_item(array.name.clone(), to_python(py, array)?)?;
    }
    result.set_item("arrays", arrays)?;
    Ok(result)
}
