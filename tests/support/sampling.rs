//! Errors of interpolants over points of the domain.

use vtu2contour::interpolant::{TetrahedronCubics, TriangleCubics};
use vtu2contour::mesh::Vector;

/// The mean and the greatest error at 100 by 100 points of the unit square, in the middle
/// of as many small squares, as in the thesis' section 5.1.
pub fn errors_on_square(cubics: &dyn TriangleCubics, u: fn(&Vector) -> f64) -> [f64; 2] {
    const SIDE: usize = 100;
    let mut errors = vec![None; SIDE * SIDE];
    for triangle in 0..cubics.mesh().triangles().len() {
        let frame = cubics.mesh().frame(triangle);
        if frame.is_degenerate() {
            continue;
        }
        let range = |axis: usize| {
            let of_corners = frame.corners().map(|corner| corner[axis] * SIDE as f64 - 0.5);
            let low = of_corners.into_iter().fold(f64::INFINITY, f64::min);
            let high = of_corners.into_iter().fold(f64::NEG_INFINITY, f64::max);
            low.ceil().max(0.0) as usize..(high.floor() + 1.0).clamp(0.0, SIDE as f64) as usize
        };
        let cubic = cubics.cubic(triangle);
        for (i, j) in range(0).flat_map(|i| range(1).map(move |j| (i, j))) {
            let point = Vector::new(i as f64 + 0.5, j as f64 + 0.5, 0.0) / SIDE as f64;
            let at = frame.barycentric(&point);
            if at.iter().all(|&weight| weight > -1e-12) {
                errors[i * SIDE + j] = Some((cubic.value(&at) - u(&point)).abs());
            }
        }
    }
    let errors: Vec<f64> = errors.into_iter().flatten().collect();
    let sum = errors.iter().sum::<f64>();
    [sum / errors.len() as f64, errors.into_iter().fold(0.0, f64::max)]
}

/// The mean error, weighted by volume, and the greatest, at four points of each tetrahedron.
pub fn errors_in_tetrahedra(
    cubics: &dyn TetrahedronCubics,
    u: impl Fn(&Vector) -> f64,
) -> [f64; 2] {
    const PLACES: [[f64; 4]; 4] =
        [[0.25; 4], [0.7, 0.1, 0.1, 0.1], [0.1, 0.2, 0.3, 0.4], [0.05, 0.3, 0.6, 0.05]];
    let mesh = cubics.mesh();
    let (mut sum, mut weights, mut greatest) = (0.0, 0.0, 0.0_f64);
    for tetrahedron in 0..mesh.tetrahedra().len() {
        let [a, b, c, d] = mesh.corners(tetrahedron);
        let volume = (b - a).cross(&(c - a)).dot(&(d - a)).abs();
        let cubic = cubics.cubic(tetrahedron);
        for at in &PLACES {
            let error = (cubic.value(at) - u(&mesh.position(tetrahedron, at))).abs();
            sum += error * volume;
            weights += volume;
            greatest = greatest.max(error);
        }
    }
    [sum / weights, greatest]
}
