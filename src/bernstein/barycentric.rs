//! Barycentric coordinates.

/// Barycentric coordinates in a triangle: weights of its three vertices.
///
/// They sum to one, and all are non-negative for a point of the triangle.
pub type Barycentric = [f64; 3];

/// Barycentric coordinates in a tetrahedron: weights of its four vertices.
pub type Barycentric4 = [f64; 4];

/// The vertices of a triangle or a tetrahedron.
pub const fn vertices<const COUNT: usize>() -> [[f64; COUNT]; COUNT] {
    let mut all = [[0.0; COUNT]; COUNT];
    let mut vertex = 0;
    while vertex < COUNT {
        all[vertex][vertex] = 1.0;
        vertex += 1;
    }
    all
}

/// The point at `t` between `a` (t = 0) and `b` (t = 1).
pub fn between<const COUNT: usize>(a: &[f64; COUNT], b: &[f64; COUNT], t: f64) -> [f64; COUNT] {
    let s = 1.0 - t;
    std::array::from_fn(|n| s * a[n] + t * b[n])
}
