//! How long a surface takes, stage by stage: `cargo bench --bench surfaces`.
//!
//! A million tetrahedra; `RAYON_NUM_THREADS` sets the threads.

#![allow(missing_docs)] // the macros of criterion make functions without

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use vtu2contour::contour::CellRanges;
use vtu2contour::contour::surface::{Fineness, contour_surface};
use vtu2contour::field::Field;
use vtu2contour::interpolant::Tricubic;
use vtu2contour::mesh::{Faces, Vector};

#[path = "../tests/support/mod.rs"]
mod support;

use support::tetrahedra::kuhn_grid;

fn surfaces(criterion: &mut Criterion) {
    let mesh = kuhn_grid(55);
    let centre = Vector::repeat(0.5);
    let values: Vec<f64> = mesh.points().iter().map(|point| (point - centre).norm()).collect();
    let slope = |point: &Vector| (point - centre) / (point - centre).norm().max(1e-9);
    let gradients: Vec<Vector> = mesh.points().iter().map(slope).collect();
    let field = Field { values: &values, gradients: &gradients };
    let mut group = criterion.benchmark_group("a million tetrahedra");
    group.throughput(Throughput::Elements(mesh.tetrahedra().len() as u64)).sample_size(10);
    group.bench_function("faces", |bench| bench.iter(|| black_box(Faces::new(&mesh))));
    group.bench_function("tri-cubic", |bench| {
        bench.iter(|| black_box(Tricubic::new(&mesh, field)));
    });
    let tricubic = Tricubic::new(&mesh, field);
    let alone = Tricubic::with_quadratic_precision(&mesh, field);
    group.bench_function("ranges", |bench| {
        bench.iter(|| black_box(CellRanges::of_tetrahedra(&tricubic)));
    });
    group.bench_function("ranges, each cell by itself", |bench| {
        bench.iter(|| black_box(CellRanges::of_tetrahedra(&alone)));
    });
    let ranges = CellRanges::of_tetrahedra(&tricubic);
    group.bench_function("least and greatest value", |bench| {
        bench.iter(|| black_box(ranges.attained_in_tetrahedra(&tricubic)));
    });
    for points in [2, 4] {
        group.bench_function(format!("one level, {points} points a side"), |bench| {
            let fineness = Fineness::PointsPerSide(points);
            bench.iter(|| black_box(contour_surface(&tricubic, &ranges, &[0.3], fineness)));
        });
    }
    group.finish();
}

criterion_group!(benches, surfaces);
criterion_main!(benches);
