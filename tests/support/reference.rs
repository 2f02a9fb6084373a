//! The thesis' first test problem, which has no closed form, by fine finite elements.
//!
//! `Δu = q u` with `q = β (e^{2x} - 1)` on the unit square, `u = 1` on its boundary. With
//! `u = 1 + w` and products of polynomials of one variable, the equations of the coefficients
//! `C` of `w` are `(A + Q) C M + M C A = -b mᵀ`, where `A`, `Q` and `M` are the matrices of
//! slopes, of `q` and of values along one side. Both directions are diagonalised: so the solve
//! is direct, and elements may be of high degree. They become smaller toward the sides, since
//! at the corners on the right `u` is like `r² log r`.

use std::sync::OnceLock;

use nalgebra::{DMatrix, DVector};
use vtu2contour::mesh::Vector;

/// `β`.
pub const BETA: f64 = 20.0;

/// Degree of the polynomials on each element.
const DEGREE: usize = 11;

/// Elements from each side to the middle, each so many times as long as the one before it.
const ELEMENTS: usize = 10;
const GROWTH: f64 = 2.0;

/// The solution.
pub struct Reference {
    side: Elements,
    /// The coefficients of the products, along x and along y.
    coefficients: DMatrix<f64>,
}

/// Continuous polynomials of one variable on elements of a side, zero at its ends: those of
/// Bernstein on each.
struct Elements {
    nodes: Vec<f64>,
    degree: usize,
}

/// The solution, made once.
pub fn reference() -> &'static Reference {
    static MADE: OnceLock<Reference> = OnceLock::new();
    MADE.get_or_init(|| Reference::new(ELEMENTS, DEGREE))
}

impl Reference {
    /// The solution by so many elements from each side to the middle.
    pub fn new(elements: usize, degree: usize) -> Self {
        let side = Elements::new(elements, degree);
        let q = |x: f64| BETA * ((2.0 * x).exp() - 1.0);
        let (mass, _) = side.matrix(0, |_| 1.0);
        let (slopes, _) = side.matrix(1, |_| 1.0);
        let (reaction, load) = side.matrix(0, q);
        let (_, whole) = side.matrix(0, |_| 1.0);
        let (values_x, modes_x) = diagonalised(&(&slopes + reaction), &mass);
        let (values_y, modes_y) = diagonalised(&slopes, &mass);
        let (along_x, along_y) = (modes_x.tr_mul(&load), modes_y.tr_mul(&whole));
        // of the modes the slopes' matrices are one, those of values the eigenvalues
        let weights = DMatrix::from_fn(along_x.len(), along_y.len(), |i, j| {
            -along_x[i] * along_y[j] / (values_x[i] + values_y[j])
        });
        Self { coefficients: modes_x * weights * modes_y.transpose(), side }
    }

    /// Value and gradient at a point.
    pub fn at(&self, point: &Vector) -> (f64, Vector) {
        let [x, y] = [point.x, point.y].map(|at| self.side.at(at));
        let mut sum = [1.0, 0.0, 0.0];
        for (i, [p, dp]) in &x {
            for (j, [q, dq]) in &y {
                let coefficient = self.coefficients[(*i, *j)];
                sum[0] += coefficient * p * q;
                sum[1] += coefficient * dp * q;
                sum[2] += coefficient * p * dq;
            }
        }
        (sum[0], Vector::new(sum[1], sum[2], 0.0))
    }
}

/// Eigenvalues and eigenvectors of `M v = μ K v`, with `vᵀ K v = 1`.
///
/// Not of `K v = λ M v`: the smooth modes have the largest `μ` and the smallest `λ`, and
/// rounding is relative to the largest of all, for `λ` ten orders of magnitude above.
fn diagonalised(stiffness: &DMatrix<f64>, mass: &DMatrix<f64>) -> (DVector<f64>, DMatrix<f64>) {
    let factor = stiffness.clone().cholesky().expect("the slopes' matrix is positive").l();
    let half = factor.solve_lower_triangular(mass).unwrap();
    let whole = factor.solve_lower_triangular(&half.transpose()).unwrap();
    let eigen = (0.5 * (&whole + whole.transpose())).symmetric_eigen();
    let modes = factor.transpose().solve_upper_triangular(&eigen.eigenvectors).unwrap();
    (eigen.eigenvalues, modes)
}

impl Elements {
    fn new(count: usize, degree: usize) -> Self {
        let whole = (GROWTH.powi(count as i32) - 1.0) / (GROWTH - 1.0);
        let mut nodes: Vec<f64> = (0..=count)
            .map(|n| 0.5 * (GROWTH.powi(n as i32) - 1.0) / (GROWTH - 1.0) / whole)
            .collect();
        nodes.extend((0..count).rev().map(|n| 1.0 - nodes[n]).collect::<Vec<f64>>());
        Self { nodes, degree }
    }

    /// How many functions there are: all of Bernstein's but the first and the last.
    fn count(&self) -> usize {
        (self.nodes.len() - 1) * self.degree - 1
    }

    /// The functions that are not zero at a place: number, value and slope of each.
    fn at(&self, x: f64) -> Vec<(usize, [f64; 2])> {
        let last = self.nodes.len() - 2;
        let element = self.nodes.partition_point(|&node| node <= x).clamp(1, last + 1) - 1;
        self.of_element(element, x)
    }

    fn of_element(&self, element: usize, x: f64) -> Vec<(usize, [f64; 2])> {
        let (start, end) = (self.nodes[element], self.nodes[element + 1]);
        let (t, width, degree) = ((x - start) / (end - start), end - start, self.degree);
        let (values, lower) = (bernstein(degree, t), bernstein(degree - 1, t));
        let slope = |n: usize| {
            let before = if n > 0 { lower[n - 1] } else { 0.0 };
            let after = lower.get(n).copied().unwrap_or(0.0);
            degree as f64 * (before - after) / width
        };
        let numbered = (0..=degree).filter_map(|n| {
            let number = (element * degree + n).checked_sub(1)?;
            (number < self.count()).then(|| (number, [values[n], slope(n)]))
        });
        numbered.collect()
    }

    /// The integrals of `factor` times two functions or (`order` 1) their slopes, and of
    /// `factor` times one.
    fn matrix(&self, order: usize, factor: impl Fn(f64) -> f64) -> (DMatrix<f64>, DVector<f64>) {
        let mut pairs = DMatrix::zeros(self.count(), self.count());
        let mut single = DVector::zeros(self.count());
        let rule = gauss(self.degree + 4);
        for element in 0..self.nodes.len() - 1 {
            let (start, end) = (self.nodes[element], self.nodes[element + 1]);
            for &(t, weight) in &rule {
                let x = start + t * (end - start);
                let weight = weight * (end - start) * factor(x);
                let there = self.of_element(element, x);
                for (i, one) in &there {
                    single[*i] += weight * one[order];
                    for (j, other) in &there {
                        pairs[(*i, *j)] += weight * one[order] * other[order];
                    }
                }
            }
        }
        (pairs, single)
    }
}

/// Bernstein's polynomials of a degree.
fn bernstein(degree: usize, t: f64) -> Vec<f64> {
    let mut values = vec![1.0];
    for n in 1..=degree {
        let old = |k: usize| values.get(k).copied().unwrap_or(0.0);
        values = (0..=n)
            .map(|k| (1.0 - t) * old(k) + if k > 0 { t * old(k - 1) } else { 0.0 })
            .collect();
    }
    values
}

/// Gauss' rule on the unit interval: points and weights, by Newton's method on Legendre's
/// polynomial.
fn gauss(count: usize) -> Vec<(f64, f64)> {
    let n = count as f64;
    let rule = (0..count).map(|k| {
        let mut x = (std::f64::consts::PI * (k as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 0.0;
        for _ in 0..50 {
            let (mut before, mut value) = (1.0, x);
            for m in 2..=count {
                let m = m as f64;
                (before, value) = (value, ((2.0 * m - 1.0) * x * value - (m - 1.0) * before) / m);
            }
            slope = n * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
    });
    rule.collect()
}
