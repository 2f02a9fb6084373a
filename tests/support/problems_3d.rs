//! The thesis' three test problems in space (section 5.1), exact, on the unit cube.

use std::f64::consts::PI;

use vtu2contour::mesh::{TetrahedronMesh, Vector};

/// A problem: its PDE and its solution.
#[derive(Clone, Copy, Debug)]
pub struct Problem {
    /// Its number in the thesis.
    pub number: usize,
    /// The PDE as text.
    pub pde: &'static str,
    /// The solution.
    pub value: fn(&Vector) -> f64,
    /// Its gradient.
    pub gradient: fn(&Vector) -> Vector,
}

impl Problem {
    /// Values and gradients at the points of a mesh.
    pub fn at_points(&self, mesh: &TetrahedronMesh) -> (Vec<f64>, Vec<Vector>) {
        let points = mesh.points().iter();
        (points.clone().map(self.value).collect(), points.map(self.gradient).collect())
    }
}

/// x sin(πx) sin(πy) sin(πz).
pub const FIFTH: Problem = Problem {
    number: 5,
    pde: "uxx + uyy + uzz = 2*pi*cos(pi*x)*sin(pi*y)*sin(pi*z) - 3*pi^2*u",
    value: |p| {
        let [x, y, z] = sines(p);
        p.x * x * y * z
    },
    gradient: |p| {
        let ([x, y, z], [dx, dy, dz]) = (sines(p), slopes_of_sines(p));
        Vector::new((x + p.x * dx) * y * z, p.x * x * dy * z, p.x * x * y * dz)
    },
};

/// (x³ - x) (y³ - y²) (z² + 1).
pub const SIXTH: Problem = Problem {
    number: 6,
    pde: "uxx + uyy + uzz = 6*x*(y^3 - y^2)*(z^2 + 1) + (x^3 - x)*(6*y - 2)*(z^2 + 1) \
        + 2*(x^3 - x)*(y^3 - y^2)",
    value: |p| {
        let [x, y, z] = sixth_factors(p);
        x * y * z
    },
    gradient: |p| {
        let [x, y, z] = sixth_factors(p);
        let dx = 3.0 * p.x * p.x - 1.0;
        let dy = 3.0 * p.y * p.y - 2.0 * p.y;
        Vector::new(dx * y * z, x * dy * z, x * y * 2.0 * p.z)
    },
};

/// exp(xyz).
pub const SEVENTH: Problem = Problem {
    number: 7,
    pde: "uxx + uyy + uzz = (x^2*y^2 + x^2*z^2 + y^2*z^2)*exp(x*y*z)",
    value: |p| (p.x * p.y * p.z).exp(),
    gradient: |p| Vector::new(p.y * p.z, p.x * p.z, p.x * p.y) * (p.x * p.y * p.z).exp(),
};

/// All three.
pub const PROBLEMS: [Problem; 3] = [FIFTH, SIXTH, SEVENTH];

fn sines(p: &Vector) -> [f64; 3] {
    [p.x, p.y, p.z].map(|x| (PI * x).sin())
}

fn slopes_of_sines(p: &Vector) -> [f64; 3] {
    [p.x, p.y, p.z].map(|x| PI * (PI * x).cos())
}

fn sixth_factors(p: &Vector) -> [f64; 3] {
    [p.x.powi(3) - p.x, p.y.powi(3) - p.y.powi(2), p.z.powi(2) + 1.0]
}
