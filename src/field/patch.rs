//! The points around one point, and the polynomial fitted to their values.

use nalgebra::{Cholesky, Const, SMatrix, SVector};

use super::recovery::RecoveryDegree;
use crate::mesh::{PointNeighbours, Vector};

/// Rings of neighbours beyond which a patch does not grow.
const MAX_RINGS: usize = 4;

/// Points beyond which a patch does not grow: several times what a cubic needs.
const MAX_POINTS: usize = 160;

/// A patch that grows ring by ring; kept between points so that its memory is used
/// again.
#[derive(Default)]
pub(super) struct Patch {
    /// The point itself first, then its neighbours in order of distance in edges.
    points: Vec<u32>,
    /// Where the outermost ring begins.
    ring: usize,
}

impl Patch {
    /// The patch of one point alone.
    pub fn start(&mut self, point: u32) {
        self.points.clear();
        self.points.push(point);
        self.ring = 0;
    }

    /// The slope at the first point of the polynomial that fits the values, in space;
    /// the polynomial is one of the coordinates along `axes`: two in a plane, three in
    /// space.
    pub fn gradient(
        &mut self,
        points: &[Vector],
        neighbours: &PointNeighbours,
        values: &[f64],
        axes: &[Vector],
        degree: RecoveryDegree,
    ) -> Vector {
        let degree = match degree {
            RecoveryDegree::Two => 2,
            RecoveryDegree::Three => 3,
        };
        for _ in 0..MAX_RINGS {
            let grown = self.grow(neighbours);
            // a fit with no value to spare only repeats the noise in the values
            let enough = self.points.len() > terms(axes.len(), degree) + 1;
            if (enough || !grown)
                && let Some(slope) = self.fit(points, values, axes, degree)
            {
                return slope;
            }
            if !grown {
                break;
            }
        }
        let lower = |degree| self.fit(points, values, axes, degree);
        lower(2).or_else(|| lower(1)).unwrap_or_default()
    }

    /// Adds the next ring; false if there is none, or the patch is full.
    fn grow(&mut self, neighbours: &PointNeighbours) -> bool {
        let end = self.points.len();
        for place in self.ring..end {
            let around = neighbours.of(self.points[place]);
            // of a great fan, points all around it
            let step = around.len().div_ceil(MAX_POINTS).max(1);
            for &point in around.iter().step_by(step) {
                // patches are small: a search is faster than a set
                if self.points.len() < MAX_POINTS && !self.points.contains(&point) {
                    self.points.push(point);
                }
            }
        }
        self.ring = end;
        self.points.len() > end
    }

    /// The slope of the least-squares polynomial of a degree, or nothing if the patch
    /// does not determine it.
    fn fit(
        &self,
        points: &[Vector],
        values: &[f64],
        axes: &[Vector],
        degree: usize,
    ) -> Option<Vector> {
        match terms(axes.len(), degree) {
            2 => self.slope::<2>(points, values, axes),
            3 => self.slope::<3>(points, values, axes),
            5 => self.slope::<5>(points, values, axes),
            9 => self.slope::<9>(points, values, axes),
            _ => self.slope::<19>(points, values, axes),
        }
    }

    /// The slope of the least-squares polynomial with `TERMS` terms beside the
    /// constant.
    fn slope<const TERMS: usize>(
        &self,
        points: &[Vector],
        values: &[f64],
        axes: &[Vector],
    ) -> Option<Vector> {
        let (&centre, others) = self.points.split_first()?;
        let offset = |point: u32| points[point as usize] - points[centre as usize];
        let size = others.iter().map(|&point| offset(point).norm()).fold(0.0, f64::max);
        let mut matrix = SMatrix::<f64, TERMS, TERMS>::zeros();
        let mut right = SVector::<f64, TERMS>::zeros();
        for &point in others.iter().filter(|&&point| values[point as usize].is_finite()) {
            let row = monomials::<TERMS>(&(offset(point) / size), axes);
            matrix.ger(1.0, &row, &row, 1.0);
            right += row * (values[point as usize] - values[centre as usize]);
        }
        let factor = well_determined(Cholesky::new(matrix)?)?;
        let solution = factor.solve(&right) / size;
        Some(axes.iter().zip(solution.iter()).map(|(axis, slope)| axis * *slope).sum())
    }
}

/// How many monomials of so many variables there are up to a degree, without the
/// constant.
fn terms(variables: usize, degree: usize) -> usize {
    (1..=variables).fold(1, |count, n| count * (degree + n) / n) - 1
}

/// The first `TERMS` monomials after the constant, of the coordinates along `axes`:
/// `s, t, s², s t, t², s³, …` in a plane.
fn monomials<const TERMS: usize>(offset: &Vector, axes: &[Vector]) -> SVector<f64, TERMS> {
    let mut all = SVector::zeros();
    let along = |axis: usize| axes[axis].dot(offset);
    let mut term = 0;
    let mut put = |monomial: f64| {
        if term < TERMS {
            all[term] = monomial;
            term += 1;
        }
    };
    (0..axes.len()).for_each(|i| put(along(i)));
    for i in 0..axes.len() {
        (i..axes.len()).for_each(|j| put(along(i) * along(j)));
    }
    for i in 0..axes.len() {
        for j in i..axes.len() {
            (j..axes.len()).for_each(|k| put(along(i) * along(j) * along(k)));
        }
    }
    all
}

/// A pivot below this fraction of the largest means that the points of the patch
/// (nearly) lie on a curve or a surface of the fitted degree.
const SMALLEST_PIVOT: f64 = 1e-4;

fn well_determined<const N: usize>(
    factor: Cholesky<f64, Const<N>>,
) -> Option<Cholesky<f64, Const<N>>> {
    let pivots = factor.l_dirty().diagonal();
    (pivots.min() > SMALLEST_PIVOT * pivots.max()).then_some(factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_terms_as_monomials() {
        assert_eq!([1, 2, 3].map(|degree| terms(2, degree)), [2, 5, 9]);
        assert_eq!([1, 2, 3].map(|degree| terms(3, degree)), [3, 9, 19]);
        let axes = [Vector::x(), Vector::y(), Vector::z()];
        let in_space = monomials::<19>(&Vector::new(2.0, 3.0, 5.0), &axes);
        let expected: [f64; 19] = [
            2.0, 3.0, 5.0, 4.0, 6.0, 10.0, 9.0, 15.0, 25.0, 8.0, 12.0, 20.0, 18.0, 30.0, 50.0,
            27.0, 45.0, 75.0, 125.0,
        ];
        assert_eq!(in_space, SVector::from(expected));
        let in_plane = monomials::<5>(&Vector::new(2.0, 3.0, 5.0), &axes[..2]);
        assert_eq!(in_plane, SVector::from([2.0, 3.0, 4.0, 6.0, 9.0]));
    }
}
