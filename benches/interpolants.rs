//! How long interpolants take: `cargo bench --bench interpolants`.
//!
//! A million triangles; a PDE of twenty operations; recovery; the spaces of the family.

#![allow(missing_docs)] // the macros of criterion make functions without

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use vtu2contour::field::{Field, RecoveryDegree, recover_gradients};
use vtu2contour::interpolant::family::spaces::{DEI, PCI};
use vtu2contour::interpolant::family::{Dei, DeiOptions};
use vtu2contour::interpolant::{Equation, Pci, Predictor};
use vtu2contour::mesh::{PointLocator, TriangleMesh, Vector};
use vtu2contour::pde::Pde;

/// Its right-hand side has twenty operations.
const PDE: &str =
    "uxx + uyy = 2*x*y - 3*u*ux + (1 + x^2)*uy - sin(y)*u + x*y*y - 0.5*ux*uy + exp(x)";

/// The unit square as `n` by `n` squares of two triangles, with a solution.
fn square(n: u32) -> (TriangleMesh<'static>, Vec<f64>, Vec<Vector>) {
    let side = n + 1;
    let at = |k: u32| f64::from(k) / f64::from(n);
    let points: Vec<Vector> =
        (0..side * side).map(|k| Vector::new(at(k % side), at(k / side), 0.0)).collect();
    let triangles = (0..n * n).flat_map(|square| {
        let first = square / n * side + square % n;
        [[first, first + 1, first + side + 1], [first, first + side + 1, first + side]]
    });
    let values = points.iter().map(|p| (3.0 * p.x).sin() * p.y).collect();
    let gradient = |p: &Vector| Vector::new(3.0 * (3.0 * p.x).cos() * p.y, (3.0 * p.x).sin(), 0.0);
    let gradients = points.iter().map(gradient).collect();
    let mesh = TriangleMesh::new(points, triangles.collect()).expect("the points are there");
    (mesh, values, gradients)
}

fn interpolants(criterion: &mut Criterion) {
    let pde = Pde::parse(PDE, &[], &[]).expect("the PDE is one");
    let equation = Equation { pde: &pde, arrays: &[], predictor: Predictor::Quadratic };
    let (mesh, values, gradients) = square(708);
    let field = Field { values: &values, gradients: &gradients };
    let mut group = criterion.benchmark_group("a million triangles");
    group.sample_size(10);
    group.bench_function("PCI", |bench| bench.iter(|| black_box(Pci::new(&mesh, field))));
    group.bench_function("PCI, PDE of 20 operations", |bench| {
        bench.iter(|| black_box(Pci::with_pde(&mesh, field, &equation)));
    });
    for degree in [RecoveryDegree::Two, RecoveryDegree::Three] {
        group.bench_function(format!("recovered gradients, degree {degree:?}"), |bench| {
            bench.iter(|| black_box(recover_gradients(&mesh, &values, degree)));
        });
    }
    group.bench_function("point locator", |bench| {
        bench.iter(|| black_box(PointLocator::new(&mesh)));
    });
    group.finish();
    let (mesh, values, gradients) = square(100);
    let field = Field { values: &values, gradients: &gradients };
    let options = DeiOptions::default();
    let mut group = criterion.benchmark_group("twenty thousand triangles");
    group.sample_size(10);
    group.bench_function("PCI by the family's solver", |bench| {
        bench.iter(|| black_box(Dei::new(PCI, &mesh, field, &equation, &options)));
    });
    group.bench_function("DEI", |bench| {
        bench.iter(|| black_box(Dei::new(DEI, &mesh, field, &equation, &options)));
    });
    group.finish();
}

criterion_group!(benches, interpolants);
criterion_main!(benches);
