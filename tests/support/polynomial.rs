//! Polynomials in space, with their derivatives, as numbers and as text.

use vtu2contour::mesh::{SimplexMesh, Vector};

use super::meshes::Random;

/// A sum of monomials: coefficients, and exponents of x, y and z.
#[derive(Clone, Debug)]
pub struct Polynomial {
    terms: Vec<(f64, [i32; 3])>,
}

impl Polynomial {
    /// A polynomial of the given degree with coefficients in [-1, 1).
    pub fn random(random: &mut Random, degree: i32) -> Self {
        Self::with_powers(random, degree, degree, 3)
    }

    /// A polynomial of the first two or all three coordinates with powers up to `each`
    /// and degrees up to `total`, its coefficients in [-1, 1).
    pub fn with_powers(random: &mut Random, each: i32, total: i32, dimension: u32) -> Self {
        let side = each + 1;
        let exponents =
            (0..side.pow(dimension)).map(|n| [n % side, n / side % side, n / (side * side)]);
        let wanted = exponents.filter(|exponents| exponents.iter().sum::<i32>() <= total);
        Self { terms: wanted.map(|exponents| (random.uniform(-1.0, 1.0), exponents)).collect() }
    }

    /// The value at a point.
    pub fn value(&self, p: &Vector) -> f64 {
        let power = |exponents: &[i32; 3]| {
            p.x.powi(exponents[0]) * p.y.powi(exponents[1]) * p.z.powi(exponents[2])
        };
        self.terms.iter().map(|(factor, exponents)| factor * power(exponents)).sum()
    }

    /// The gradient at a point.
    pub fn gradient(&self, p: &Vector) -> Vector {
        Vector::from([0, 1, 2].map(|axis| self.derivative(axis).value(p)))
    }

    /// Values and gradients at the points of a mesh.
    pub fn at_points<const CORNERS: usize>(
        &self,
        mesh: &SimplexMesh<CORNERS>,
    ) -> (Vec<f64>, Vec<Vector>) {
        let points = mesh.points().iter();
        (
            points.clone().map(|p| self.value(p)).collect(),
            points.map(|p| self.gradient(p)).collect(),
        )
    }

    /// The derivative along an axis.
    fn derivative(&self, axis: usize) -> Self {
        let terms = self.terms.iter().filter(|(_, exponents)| exponents[axis] > 0);
        let terms = terms.map(|&(factor, mut exponents)| {
            exponents[axis] -= 1;
            (factor * f64::from(exponents[axis] + 1), exponents)
        });
        Self { terms: terms.collect() }
    }

    /// The text of an operator with each second derivative of u replaced by this
    /// polynomial's.
    pub fn operator_text(&self, operator: &str) -> String {
        let mut text = operator.to_owned();
        for (first, one) in ["x", "y", "z"].iter().enumerate() {
            for (second, other) in ["x", "y", "z"].iter().enumerate() {
                let derivative = self.derivative(first).derivative(second).text();
                text = text.replace(&format!("u{one}{other}"), &format!("({derivative})"));
            }
        }
        text
    }

    fn text(&self) -> String {
        let term =
            |(factor, [x, y, z]): &(f64, [i32; 3])| format!("({factor:?})*x^{x}*y^{y}*z^{z}");
        self.terms.iter().map(term).collect::<Vec<_>>().join(" + ")
    }
}
