//! The monitors of an interpolant, one number a simplex and one a cell.

use rayon::prelude::*;

use super::error::FilterError;
use super::interpolant::Interpolant;
use super::known_pde::KnownPde;
use super::options::{ContourOptions, InterpolantKind};
use super::second_interpolant::{NamedInterpolants, SecondInterpolant};
use super::solution::Domain;
use crate::field::Field;
use crate::interpolant::{Equation, Pieces, Predictor};
use crate::mesh::{RefinedMesh, RefinedPlace, SimplexMesh, Vector};
use crate::monitor::{SamplePoints, defect, interpolation_error, once_refined, surface_area};

/// What tells how much a cell needs to be refined, see [`crate::monitor`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Monitor {
    /// How far the cubic is from satisfying the PDE: about `∫ |L p - g|` over the cell.
    #[default]
    Defect,
    /// The area of the interpolant's graph over the cell.
    SurfaceArea,
    /// The mean difference to the interpolant on the mesh with every edge halved, whose new
    /// points have values and gradients of the cubics (gradients are the mean over the cells
    /// around). What differs is then what the PDE, or the neighbours, say of smaller cells.
    StepwiseError,
    /// The mean difference to a second interpolant of the same data; by default the full
    /// quartic on triangles and the thesis' tri-cubic in tetrahedra, or without a PDE the cubic
    /// of each cell by itself.
    InterpolationError(Option<SecondInterpolant>),
}

impl Monitor {
    /// The name of its cell array, where none is given.
    pub fn default_name(self) -> &'static str {
        match self {
            Self::Defect => "DefectMonitor",
            Self::SurfaceArea => "AreaMonitor",
            Self::StepwiseError => "StepwiseMonitor",
            Self::InterpolationError(_) => "InterpolationMonitor",
        }
    }

    /// Whether a cell's number is the mean of its parts' by their size, and not their sum.
    fn is_mean(self) -> bool {
        matches!(self, Self::StepwiseError | Self::InterpolationError(_))
    }
}

/// A monitor of one interpolant.
pub struct CellMonitor<'a> {
    /// Which.
    pub monitor: Monitor,
    /// Where it looks in each cell.
    pub samples: SamplePoints,
    /// The PDE, if it is known.
    pub pde: Option<&'a KnownPde>,
    /// What the interpolant is.
    pub kind: InterpolantKind,
    /// Where the PDE's right-hand side takes the solution from.
    pub predictor: Predictor,
}

impl<'a> CellMonitor<'a> {
    /// That of an interpolant made by these options.
    pub fn new(
        monitor: Monitor,
        samples: SamplePoints,
        pde: Option<&'a KnownPde>,
        options: &ContourOptions,
    ) -> Self {
        let (kind, predictor) = (options.interpolant, options.predictor);
        Self { monitor, samples, pde, kind, predictor }
    }

    /// One number for each of so many cells: those of the solids, or if there are none of the
    /// two-dimensional cells; not a number for others, for those of other processes, and where
    /// it cannot be computed.
    ///
    /// A cell that was split has the sum of its parts' numbers if these are integrals, and
    /// their mean by size if they are means; parts without size do not count.
    ///
    /// # Errors
    /// If it needs a PDE and there is none, or has nothing to compare the interpolant with.
    pub fn of_cells(&self, of: &Interpolant, cells: usize) -> Result<CellNumbers, FilterError> {
        let solution = &of.solution;
        match (&solution.tetrahedra, &solution.triangles) {
            (Some(domain), _) => Ok(self.joined(domain, &self.of_tetrahedra(of, domain)?, cells)),
            (None, Some(domain)) => Ok(self.joined(domain, &self.of_triangles(of, domain)?, cells)),
            (None, None) => Ok(CellNumbers { numbers: vec![f64::NAN; cells], asked: 0, failed: 0 }),
        }
    }

    /// One number a triangle.
    ///
    /// # Errors
    /// As [`CellMonitor::of_cells`].
    pub fn of_triangles(
        &self,
        of: &Interpolant,
        domain: &Domain<3>,
    ) -> Result<Vec<f64>, FilterError> {
        match of.in_triangles() {
            Some((cubics, _)) => self.numbers(&*cubics, domain, of.solution.field(domain)),
            None => Ok(vec![f64::NAN; domain.count()]),
        }
    }

    /// One number a tetrahedron.
    ///
    /// # Errors
    /// As [`CellMonitor::of_cells`].
    pub fn of_tetrahedra(
        &self,
        of: &Interpolant,
        domain: &Domain<4>,
    ) -> Result<Vec<f64>, FilterError> {
        match of.in_tetrahedra() {
            Some((cubics, _)) => self.numbers(&*cubics, domain, of.solution.field(domain)),
            None => Ok(vec![f64::NAN; domain.count()]),
        }
    }

    fn equation(&self) -> Option<Equation<'_>> {
        self.pde.map(|known| known.equation(self.predictor))
    }

    /// One number a simplex.
    fn numbers<'b, const CORNERS: usize>(
        &self,
        pieces: &(impl Pieces<CORNERS> + ?Sized),
        domain: &'b Domain<'_, CORNERS>,
        field: Field<'b>,
    ) -> Result<Vec<f64>, FilterError>
    where
        for<'m> SimplexMesh<'m, CORNERS>: NamedInterpolants<CORNERS>,
    {
        let equation = self.equation();
        match self.monitor {
            Monitor::Defect => {
                let what = "the defect, how far the cubics are from satisfying the PDE,".to_owned();
                let equation = equation.ok_or(FilterError::NeedsPde { what })?;
                Ok(defect(pieces, &equation, self.samples))
            }
            Monitor::SurfaceArea => Ok(surface_area(pieces, self.samples)),
            _ if self.kind == InterpolantKind::Linear => Err(FilterError::NothingToCompare),
            Monitor::StepwiseError => self.stepwise(pieces, &domain.mesh, field),
            Monitor::InterpolationError(second) => {
                let default =
                    SecondInterpolant::default_for(self.kind, self.pde.is_some(), CORNERS);
                let second = second.unwrap_or(default);
                let is_same = second == SecondInterpolant::QuadraticPrecision
                    && self.kind == InterpolantKind::QuadraticPrecision;
                if is_same {
                    return Err(FilterError::SameInterpolant { name: second.name() });
                }
                let others = domain.mesh.second(second, field, equation.as_ref())?;
                Ok(interpolation_error(pieces, others.as_ref(), self.samples))
            }
        }
    }

    /// The stepwise error to the mesh with every edge halved.
    fn stepwise<const CORNERS: usize>(
        &self,
        pieces: &(impl Pieces<CORNERS> + ?Sized),
        mesh: &SimplexMesh<CORNERS>,
        field: Field,
    ) -> Result<Vec<f64>, FilterError>
    where
        for<'m> SimplexMesh<'m, CORNERS>: NamedInterpolants<CORNERS>,
    {
        let mut refined = RefinedMesh::uniform(mesh, 2);
        let (values, gradients): (Vec<f64>, Vec<Vector>) =
            data_of(&refined, pieces, field).into_iter().unzip();
        let points = std::mem::take(&mut refined.points);
        let corners = refined.pieces.iter().map(|piece| piece.corners).collect();
        let finer_mesh = SimplexMesh::new(points, corners)?;
        let arrays = self.pde.map(|known| linear(&known.arrays, mesh, &refined.places));
        let equation = self
            .pde
            .zip(arrays.as_ref())
            .map(|(known, arrays)| Equation { arrays, ..known.equation(self.predictor) });
        let field = Field { values: &values, gradients: &gradients };
        let finer = finer_mesh.interpolant(self.kind, field, equation.as_ref());
        Ok(once_refined(pieces, &refined, finer.as_ref(), self.samples))
    }

    /// The numbers of the cells from those of their simplices.
    fn joined<const CORNERS: usize>(
        &self,
        domain: &Domain<CORNERS>,
        numbers: &[f64],
        cells: usize,
    ) -> CellNumbers {
        let is_mean = self.monitor.is_mean();
        let (mut sums, mut sizes) = (vec![0.0; cells], vec![0.0; cells]);
        let mut is_asked = vec![false; cells];
        for (simplex, number) in numbers.iter().enumerate().filter(|(n, _)| !domain.is_ghost(*n)) {
            let cell = domain.parent(simplex as u32) as usize;
            let size = domain.mesh.measure(simplex);
            is_asked[cell] = true;
            if size != 0.0 {
                sums[cell] += if is_mean { size * number } else { *number };
                sizes[cell] += size;
            }
        }
        let number = |(sum, &size): (f64, &f64)| match size {
            0.0 => f64::NAN,
            size if is_mean => sum / size,
            _ => sum,
        };
        let numbers: Vec<f64> = sums.into_iter().zip(&sizes).map(number).collect();
        let asked = is_asked.iter().filter(|is_asked| **is_asked).count();
        let computed = numbers.iter().filter(|number| !number.is_nan()).count();
        CellNumbers { numbers, asked, failed: asked - computed }
    }
}

/// One number a cell.
pub struct CellNumbers {
    /// One number a cell; not a number where there is none.
    pub numbers: Vec<f64>,
    /// Cells that are to have one: not those of lower dimension or another process.
    pub asked: usize,
    /// Those of them that have none.
    pub failed: usize,
}

/// Value and gradient at a point.
type Sample = (f64, Vector);

/// What is known at the points of a refined mesh: at old ones the field, at others the values
/// of the pieces and the mean of the gradients of those around.
fn data_of<const CORNERS: usize>(
    refined: &RefinedMesh<CORNERS>,
    pieces: &(impl Pieces<CORNERS> + ?Sized),
    field: Field,
) -> Vec<Sample> {
    let corners = refined.pieces.par_iter().flat_map_iter(|piece| {
        piece.corners.into_iter().zip(piece.at).map(|(point, at)| (point, piece.parent, at))
    });
    let mut around: Vec<(u32, u32, [f64; CORNERS])> =
        corners.filter(|(_, _, at)| old_corner(at).is_none()).collect();
    around.par_sort_unstable_by_key(|&(point, parent, _)| (point, parent));
    around.dedup_by_key(|(point, parent, _)| (*point, *parent));
    let old = |place: &RefinedPlace<CORNERS>| -> Sample {
        let corner = old_corner(&place.at).unwrap_or_default();
        let point = pieces.mesh().simplices()[place.simplex as usize][corner] as usize;
        (field.values[point], field.gradients[point])
    };
    let mut data: Vec<Sample> = refined.places.par_iter().map(old).collect();
    let groups: Vec<_> = around.chunk_by(|one, next| one.0 == next.0).collect();
    let means: Vec<(u32, Sample)> =
        groups.into_par_iter().map(|group| (group[0].0, mean_of(group, pieces))).collect();
    means.into_iter().for_each(|(point, sample)| data[point as usize] = sample);
    data
}

/// The corner at which a place is; nothing if it is between corners.
fn old_corner<const CORNERS: usize>(at: &[f64; CORNERS]) -> Option<usize> {
    at.iter().position(|&weight| weight == 1.0)
}

/// The mean over the cells around a point, of those whose values are finite.
fn mean_of<const CORNERS: usize>(
    around: &[(u32, u32, [f64; CORNERS])],
    pieces: &(impl Pieces<CORNERS> + ?Sized),
) -> Sample {
    let taylor = around.iter().map(|(_, cell, at)| pieces.taylor(*cell as usize, at));
    let finite = taylor.filter(|taylor| {
        taylor.value.is_finite() && taylor.gradient.iter().all(|slope| slope.is_finite())
    });
    let (mut sum, mut count) = ((0.0, Vector::zeros()), 0.0);
    for taylor in finite {
        sum = (sum.0 + taylor.value, sum.1 + taylor.gradient);
        count += 1.0;
    }
    // not a number if there is none
    (sum.0 / count, sum.1 / count)
}

/// Arrays of one value a point, linearly at the points of a refined mesh.
fn linear<const CORNERS: usize>(
    arrays: &[Vec<f64>],
    mesh: &SimplexMesh<CORNERS>,
    places: &[RefinedPlace<CORNERS>],
) -> Vec<Vec<f64>> {
    let at = |array: &Vec<f64>, place: &RefinedPlace<CORNERS>| {
        let corners = mesh.simplices()[place.simplex as usize].iter().zip(&place.at);
        // a point without weight has no say, not even as NaN
        let weighed = corners.filter(|(_, weight)| **weight != 0.0);
        weighed.map(|(&point, weight)| weight * array[point as usize]).sum()
    };
    arrays.iter().map(|array| places.par_iter().map(|place| at(array, place)).collect()).collect()
}
