//! The thesis' fourth test problem (section 5.1, eq. 5.1), exact.

use vtu2contour::mesh::{TriangleMesh, Vector};

/// The PDE as text.
pub const PDE: &str = "uxx + uyy = -100*exp(-(5-10*x)^2/2) + (50-100*x)*ux \
    - 150*exp(-(5-10*x)^2/2)*exp(-(5-10*y)^2/2) - 75*exp(-(5-10*y)^2/2) + (50-100*y)*uy";

fn bell(x: f64) -> f64 {
    (-(5.0 - 10.0 * x).powi(2) / 2.0).exp()
}

/// The solution.
pub fn value(p: &Vector) -> f64 {
    bell(p.x) + 0.75 * bell(p.y) + 0.75 * bell(p.x) * bell(p.y)
}

/// Its gradient.
pub fn gradient(p: &Vector) -> Vector {
    let slope = |x: f64| 10.0 * (5.0 - 10.0 * x) * bell(x);
    let x = slope(p.x) * (1.0 + 0.75 * bell(p.y));
    let y = slope(p.y) * (0.75 + 0.75 * bell(p.x));
    Vector::new(x, y, 0.0)
}

/// Values and gradients at the points of a mesh.
pub fn at_points(mesh: &TriangleMesh) -> (Vec<f64>, Vec<Vector>) {
    (mesh.points().iter().map(value).collect(), mesh.points().iter().map(gradient).collect())
}
