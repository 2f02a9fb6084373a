//! Barycentric coordinates of a triangle.

/// Barycentric coordinates in a triangle: weights of its three vertices.
///
/// They sum to one, and all are non-negative for a point of the triangle.
pub type Barycentric = [f64; 3];

/// The point at `t` between `a` (t = 0) and `b` (t = 1).
pub fn between(a: &Barycentric, b: &Barycentric, t: f64) -> Barycentric {
    let s = 1.0 - t;
    [s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2]]
}
