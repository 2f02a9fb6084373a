//! Linear finite elements for Laplace's equation, as a solver in a loop of refinement has them.

use vtu2contour::mesh::{NumberedEdges, TriangleMesh, Vector, boundary_edges};

/// A harmonic function and its gradient.
pub type Harmonic = fn(&Vector) -> (f64, Vector);

/// `r^a sin(a θ)`, θ from 0 to 2π, counted from the positive x axis.
fn power(p: &Vector, a: f64) -> (f64, Vector) {
    let (r, mut t) = (p.x.hypot(p.y), p.y.atan2(p.x));
    if t < 0.0 {
        t += std::f64::consts::TAU;
    }
    let slope = a * r.powf(a - 1.0);
    let gradient = Vector::new(((a - 1.0) * t).sin(), ((a - 1.0) * t).cos(), 0.0) * slope;
    (r.powf(a) * (a * t).sin(), gradient)
}

/// The corner of an L, which lacks the quadrant of positive x and negative y.
pub fn corner(p: &Vector) -> (f64, Vector) {
    power(p, 2.0 / 3.0)
}

/// The tip of a slit along the positive x axis, on both sides of which it is zero.
pub fn tip(p: &Vector) -> (f64, Vector) {
    power(p, 0.5)
}

/// The solution with the values of a function on the boundary, by conjugate gradients.
pub fn solve(mesh: &TriangleMesh, of: Harmonic) -> Vec<f64> {
    let count = mesh.points().len();
    let mut is_fixed = vec![false; count];
    boundary_edges(mesh).iter().flatten().for_each(|&point| is_fixed[point as usize] = true);
    let mut u: Vec<f64> = (0..count).map(|p| of(&mesh.points()[p]).0).collect();
    let stiffness: Vec<[[f64; 3]; 3]> = (0..mesh.triangles().len())
        .map(|triangle| {
            let gradients = *mesh.frame(triangle).barycentric_gradients();
            let area = area(mesh, triangle);
            gradients.map(|one| gradients.map(|other| area * one.dot(&other)))
        })
        .collect();
    let apply = |x: &[f64]| {
        let mut y = vec![0.0; count];
        for (corners, local) in mesh.triangles().iter().zip(&stiffness) {
            for (i, row) in corners.iter().zip(local) {
                let sum: f64 = corners.iter().zip(row).map(|(j, a)| a * x[*j as usize]).sum();
                y[*i as usize] += sum;
            }
        }
        (0..count).filter(|p| is_fixed[*p]).for_each(|p| y[p] = 0.0);
        y
    };
    let mut diagonal = vec![0.0; count];
    for (corners, local) in mesh.triangles().iter().zip(&stiffness) {
        (0..3).for_each(|n| diagonal[corners[n] as usize] += local[n][n]);
    }
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let preconditioned = |r: &[f64]| -> Vec<f64> {
        r.iter().zip(&diagonal).map(|(r, d)| if *d > 0.0 { r / d } else { 0.0 }).collect()
    };
    let mut r: Vec<f64> = apply(&u).iter().map(|x| -x).collect();
    let mut z = preconditioned(&r);
    let mut p = z.clone();
    let mut rz = dot(&r, &z);
    let first = rz;
    while rz > 1e-20 * first {
        let ap = apply(&p);
        let step = rz / dot(&p, &ap);
        (0..count).for_each(|n| {
            u[n] += step * p[n];
            r[n] -= step * ap[n];
        });
        z = preconditioned(&r);
        let next = dot(&r, &z);
        p = z.iter().zip(&p).map(|(z, p)| z + next / rz * p).collect();
        rz = next;
    }
    u
}

/// The error in the energy norm, by 64 points a triangle.
pub fn error(mesh: &TriangleMesh, u: &[f64], of: Harmonic) -> f64 {
    let of_triangle = |triangle: usize| {
        let slope = slope(mesh, triangle, u);
        let corners = mesh.corners(triangle);
        let n = 8;
        let mut sum = 0.0;
        for i in 0..n {
            for j in 0..2 * (n - i) - 1 {
                // centroids of the small triangles, those that stand and those that hang
                let shift = if j % 2 == 0 { 1.0 / 3.0 } else { 2.0 / 3.0 };
                let (s, t) = (i as f64 + shift, (j / 2) as f64 + shift);
                let weights = [s / n as f64, t / n as f64];
                let point = corners[0] * (1.0 - weights[0] - weights[1])
                    + corners[1] * weights[0]
                    + corners[2] * weights[1];
                sum += (of(&point).1 - slope).norm_squared();
            }
        }
        area(mesh, triangle) * sum / (n * n) as f64
    };
    (0..mesh.triangles().len()).map(of_triangle).sum::<f64>().sqrt()
}

/// The squares of the residual estimator: half the jumps of the normal derivative over the
/// edges, times their lengths (Babuška, Rheinboldt 1978; Verfürth 1996).
pub fn indicators(mesh: &TriangleMesh, u: &[f64]) -> Vec<f64> {
    let edges = NumberedEdges::new(mesh);
    let mut squares = vec![0.0; mesh.triangles().len()];
    for edge in 0..edges.count() as u32 {
        let &[one, other] = edges.triangles(edge) else { continue };
        let [a, b] = edges.ends()[edge as usize].map(|end| mesh.points()[end as usize]);
        let jump = slope(mesh, one as usize, u) - slope(mesh, other as usize, u);
        let square = 0.5 * (jump.cross(&(b - a))).norm_squared();
        squares[one as usize] += square;
        squares[other as usize] += square;
    }
    squares
}

fn slope(mesh: &TriangleMesh, triangle: usize, u: &[f64]) -> Vector {
    mesh.frame(triangle).gradient(&mesh.triangles()[triangle].map(|point| u[point as usize]))
}

fn area(mesh: &TriangleMesh, triangle: usize) -> f64 {
    let [a, b, c] = mesh.corners(triangle);
    0.5 * (b - a).cross(&(c - a)).norm()
}
