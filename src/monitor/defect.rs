//! How far the interpolant is from satisfying the PDE (thesis, section 3.3.1).

use nalgebra::Matrix3;
use rayon::prelude::*;

use super::SamplePoints;
use crate::interpolant::{Collocation, Equation, Pieces, Place, Taylor};
use crate::interruption::checkpoint;
use crate::pde::LANES;

/// `rᵢ = Aᵢ Dᵢ`: the area or volume of each cell times the mean of `|L p - g|` over its
/// sample points, so that all together are about `∫ |L p - g|`.
///
/// The thesis takes a sampled maximum for `Dᵢ` in its text, and in the formula beside it the
/// integral, which is the mean; the mean is steadier. `g` takes `p` itself here, not the
/// predictor of `equation`. In the unit of `g` times an area or a volume.
pub fn defect<const CORNERS: usize>(
    pieces: &(impl Pieces<CORNERS> + ?Sized),
    equation: &Equation,
    points: SamplePoints,
) -> Vec<f64> {
    let mesh = pieces.mesh();
    let mean = |cell: usize, sampled: &[(f64, f64)]| {
        mesh.measure(cell) * sampled.iter().map(|(defect, weight)| defect * weight).sum::<f64>()
    };
    by_defects(pieces, equation, points, mean)
}

/// The greatest `|L p - g|` at the sample points of each cell, in the unit of `g`: what the
/// thesis' tables call the maximum defect is the greatest of these.
pub fn greatest_defect<const CORNERS: usize>(
    pieces: &(impl Pieces<CORNERS> + ?Sized),
    equation: &Equation,
    points: SamplePoints,
) -> Vec<f64> {
    by_defects(pieces, equation, points, |_, sampled| {
        // unlike max, this keeps what is not a number
        sampled.iter().fold(0.0, |most, &(defect, _)| if defect <= most { most } else { defect })
    })
}

/// Cells that one thread takes at a time: whole batches of the PDE.
const CHUNK: usize = LANES;

/// One number a cell, of `|L p - g|` at its sample points and their weights.
fn by_defects<const CORNERS: usize>(
    pieces: &(impl Pieces<CORNERS> + ?Sized),
    equation: &Equation,
    points: SamplePoints,
    number: impl Fn(usize, &[(f64, f64)]) -> f64 + Sync,
) -> Vec<f64> {
    let mesh = pieces.mesh();
    let cells: Vec<usize> = (0..mesh.simplices().len()).collect();
    let chunks = cells.par_chunks(CHUNK).flat_map_iter(|chunk| {
        checkpoint();
        let sampled = sampled(pieces, equation, points, chunk);
        let each = sampled.len() / chunk.len();
        let numbers = chunk.iter().zip(sampled.chunks(each.max(1))).map(|(&cell, sampled)| {
            let number = number(cell, sampled);
            if mesh.measure(cell) > 0.0 && number.is_finite() { number } else { f64::NAN }
        });
        numbers.collect::<Vec<f64>>()
    });
    chunks.collect()
}

/// `|L p - g|` and the weight of each sample point of some cells, one after the other.
fn sampled<const CORNERS: usize>(
    pieces: &(impl Pieces<CORNERS> + ?Sized),
    equation: &Equation,
    points: SamplePoints,
    cells: &[usize],
) -> Vec<(f64, f64)> {
    let mesh = pieces.mesh();
    let fixed = points.fixed();
    let mut collocation = Collocation::new(equation);
    let mut places = Vec::with_capacity(cells.len() * fixed.len());
    for &cell in cells {
        let random = points.random(cell);
        for (at, weight) in random.as_ref().unwrap_or(&fixed) {
            let Taylor { value, gradient, hessian } = pieces.taylor(cell, at);
            let position = mesh.position(cell, at);
            collocation.push(&Place {
                points: &mesh.simplices()[cell],
                at,
                position,
                value,
                gradient,
            });
            places.push((hessian, *weight));
        }
    }
    let (operators, right_hand_sides) = collocation.evaluate();
    let sides = operators.iter().zip(right_hand_sides);
    let defects = places.into_iter().zip(sides);
    defects.map(|((hessian, weight), (l, g))| ((applied(l, &hessian) - g).abs(), weight)).collect()
}

/// `L p`: the coefficients of `uxx, uyy, uzz, uxy, uxz, uyz`, each with its derivative.
fn applied(operator: &[f64; 6], hessian: &Matrix3<f64>) -> f64 {
    let places = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
    operator.iter().zip(places).map(|(factor, place)| factor * hessian[place]).sum()
}
