//! The slope of a polynomial fitted to values around a point, and how far to trust it.

use nalgebra::{Cholesky, SMatrix, SVector};

use super::patch_frame::PatchFrame;
use crate::mesh::Vector;

/// The slope of a fitted polynomial.
#[derive(Clone, Copy, Debug)]
pub(super) struct PolynomialFit {
    /// The polynomial's gradient at the point.
    pub slope: Vector,
    /// How wrong it can be, see [`worst_remainder`]; without unit.
    pub error: f64,
}

impl PolynomialFit {
    /// The same slope, its error taken for so much greater.
    pub fn at_disadvantage(self, by: f64) -> Self {
        Self { error: self.error + by, ..self }
    }
}

/// The mesh widths over which the function of the error bound changes by its own size.
const LENGTH: f64 = 3.0;

/// Errors in the values of that function, such as a solver makes.
const NOISE: f64 = 1e-3;

/// What a value at some distance can differ from the Taylor polynomial of a degree.
///
/// The function has values and scaled derivatives up to 1: an m-th derivative of
/// 1/`LENGTH`^m. It stands for what a mesh can resolve; a bound for it ranks fits of any
/// degree on any patch.
fn worst_remainder(distance: f64, degree: usize) -> f64 {
    let term = |product: f64, m: usize| product * distance / (LENGTH * m as f64);
    let remainder = (1..=degree + 1).fold(1.0, term);
    remainder.min(2.0) + NOISE
}

/// Closer than this, as a part of the mean distance of neighbours, a point is not worth
/// more: its difference is hardly above the noise.
const CLOSE: f64 = 0.1;

/// The weight of an equation at a distance, squared. Far values are worth less: they
/// differ more from a polynomial.
fn weight(squared_distance: f64) -> f64 {
    (squared_distance + CLOSE * CLOSE).powi(-2)
}

/// A monomial of which less than this, squared, is not a combination of those before it
/// is not determined as far as rounding can tell.
const ROUNDING: f64 = 1e-7;

/// The values that a polynomial is fitted to.
#[derive(Clone, Copy)]
pub(super) struct Samples<'a> {
    /// All points of the mesh.
    pub points: &'a [Vector],
    /// One value a point.
    pub values: &'a [f64],
    /// The point whose value and slope the polynomial has.
    pub centre: u32,
    /// The points around it.
    pub around: &'a [u32],
}

impl Samples<'_> {
    /// The least-squares polynomial of a degree up to three, or nothing if the values do
    /// not determine it.
    pub fn fit(&self, frame: &PatchFrame, degree: usize) -> Option<PolynomialFit> {
        match (frame.rows().len(), degree) {
            (1, 1) => self.least_squares::<1, 1>(frame, degree),
            (1, 2) => self.least_squares::<1, 2>(frame, degree),
            (1, 3) => self.least_squares::<1, 3>(frame, degree),
            (2, 1) => self.least_squares::<2, 2>(frame, degree),
            (2, 2) => self.least_squares::<2, 5>(frame, degree),
            (2, 3) => self.least_squares::<2, 9>(frame, degree),
            (3, 1) => self.least_squares::<3, 3>(frame, degree),
            (3, 2) => self.least_squares::<3, 9>(frame, degree),
            (3, 3) => self.least_squares::<3, 19>(frame, degree),
            _ => None,
        }
    }

    /// The fit with `TERMS` monomials of `DIM` coordinates beside the constant.
    ///
    /// The slope is a sum of the values' differences to that at the centre, each times a
    /// vector. The lengths of these vectors times the remainders bound its error.
    fn least_squares<const DIM: usize, const TERMS: usize>(
        &self,
        frame: &PatchFrame,
        degree: usize,
    ) -> Option<PolynomialFit> {
        if self.around.len() < TERMS {
            return None;
        }
        let rows = SMatrix::<f64, DIM, 3>::from_fn(|row, axis| frame.rows()[row][axis]);
        let origin = self.points[self.centre as usize];
        let samples = || {
            let finite = self.around.iter().map(|&point| point as usize);
            finite.filter(|&point| self.values[point].is_finite()).map(|point| {
                let at = rows * (self.points[point] - origin);
                (at.norm_squared(), monomials::<DIM, TERMS>(&at), self.values[point])
            })
        };
        let mut matrix = SMatrix::<f64, TERMS, TERMS>::zeros();
        for (squared_distance, row, _) in samples() {
            matrix.ger(weight(squared_distance), &row, &row, 1.0);
        }
        let unit = SMatrix::<f64, TERMS, DIM>::identity();
        let inverse = determined(matrix)?.solve(&unit).transpose();
        let mut slope = SVector::<f64, DIM>::zeros();
        let mut error = 0.0;
        for (squared_distance, row, value) in samples() {
            let share = inverse * row * weight(squared_distance);
            slope += share * (value - self.values[self.centre as usize]);
            error += share.norm() * worst_remainder(squared_distance.sqrt(), degree);
        }
        let slope = rows.transpose() * slope;
        (error.is_finite() && slope.iter().all(|x| x.is_finite()))
            .then_some(PolynomialFit { slope, error: LENGTH * error })
    }
}

/// The matrix factored, unless it is singular up to rounding. How much of a column the
/// others do not explain does not depend on its scale.
fn determined<const N: usize>(
    matrix: SMatrix<f64, N, N>,
) -> Option<Cholesky<f64, nalgebra::Const<N>>> {
    let factor = Cholesky::new(matrix)?;
    let (pivots, whole) = (factor.l_dirty().diagonal(), matrix.diagonal());
    let mut pairs = pivots.iter().zip(whole.iter());
    pairs.all(|(pivot, whole)| pivot * pivot > ROUNDING * whole).then_some(factor)
}

/// The first `TERMS` monomials after the constant: `s, t, s², s t, t², s³, …` in a plane.
fn monomials<const DIM: usize, const TERMS: usize>(at: &SVector<f64, DIM>) -> SVector<f64, TERMS> {
    let mut all = SVector::zeros();
    let mut term = 0;
    let mut put = |monomial: f64| {
        if term < TERMS {
            all[term] = monomial;
            term += 1;
        }
    };
    (0..DIM).for_each(|i| put(at[i]));
    for i in 0..DIM {
        (i..DIM).for_each(|j| put(at[i] * at[j]));
    }
    for i in 0..DIM {
        for j in i..DIM {
            (j..DIM).for_each(|k| put(at[i] * at[j] * at[k]));
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn monomials_by_hand() {
        let in_space = monomials::<3, 19>(&SVector::from([2.0, 3.0, 5.0]));
        let expected: [f64; 19] = [
            2.0, 3.0, 5.0, 4.0, 6.0, 10.0, 9.0, 15.0, 25.0, 8.0, 12.0, 20.0, 18.0, 30.0, 50.0,
            27.0, 45.0, 75.0, 125.0,
        ];
        assert_eq!(in_space, SVector::from(expected));
        let in_plane = monomials::<2, 5>(&SVector::from([2.0, 3.0]));
        assert_eq!(in_plane, SVector::from([2.0, 3.0, 4.0, 6.0, 9.0]));
    }

    /// On a line the fit with as many values as terms is a finite difference, whose
    /// weights are known: -1.5 at the point, 2 and -0.5.
    #[test]
    fn a_one_sided_difference_and_its_bound() {
        let points = [0.0, 1.0, 2.0].map(|x| Vector::x() * x);
        let axes = [Vector::x(), Vector::y()];
        let samples =
            Samples { points: &points, values: &[1.0, 4.0, 2.0], centre: 0, around: &[1, 2] };
        let offsets = || points[1..2].iter().copied();
        let frame = PatchFrame::new(offsets(), offsets(), &axes);
        let fit = samples.fit(&frame, 2).unwrap();
        assert!((fit.slope - Vector::x() * 5.5).norm() < 1e-9);
        let bound = LENGTH * (2.0 * worst_remainder(1.0, 2) + 0.5 * worst_remainder(2.0, 2));
        assert!((fit.error - bound).abs() < 1e-9);
        assert!((worst_remainder(2.0, 2) - NOISE - (2.0_f64 / LENGTH).powi(3) / 6.0).abs() < 1e-12);
        assert!(samples.fit(&frame, 3).is_none());
    }

    /// Three rows do not determine a cubic, however many points there are, also if
    /// rounding makes the matrix regular.
    #[test]
    fn three_rows_do_not_make_a_cubic() {
        let place = |k: usize| Vector::new((k % 5) as f64 / 3.0, (k / 5) as f64 / 7.0, 0.0);
        let points: Vec<Vector> = (0..15).map(place).collect();
        let around: Vec<u32> = (1..15).collect();
        let offsets = || points[1..].iter().copied();
        let frame = PatchFrame::new(offsets(), offsets(), &[Vector::x(), Vector::y()]);
        let values = vec![0.0; 15];
        let samples = Samples { points: &points, values: &values, centre: 0, around: &around };
        assert!(samples.fit(&frame, 3).is_none());
        assert!(samples.fit(&frame, 2).is_some());
    }
}
