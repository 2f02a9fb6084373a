//! How long an evaluation takes: `cargo test --release --test pde_speed -- --ignored --nocapture`.

use std::hint::black_box;
use std::time::Instant;
use vtu2contour::pde::{Pde, Sample};

const POINTS: usize = 64 * 256;

fn report(name: &str, expression: &str) {
    let pde = Pde::parse(&format!("uxx + uyy = {expression}"), &[], &[]).unwrap();
    let samples: Vec<Sample> = (0..POINTS).map(sample).collect();
    let mut batch = pde.batch();
    samples.iter().for_each(|sample| batch.push(sample));
    let mut values = Vec::new();
    let mut lines = Vec::new();
    let batches = time(|| pde.right_hand_sides(black_box(&batch), &mut values));
    let slopes = time(|| pde.linearizations(black_box(&batch), &mut lines));
    let single = time(|| {
        for sample in &samples {
            black_box(pde.right_hand_side(black_box(sample)));
        }
    });
    println!(
        "{name:32} batch {batches:6.1} ns, with derivatives {slopes:6.1} ns, single {single:6.1} ns"
    );
}

fn sample(i: usize) -> Sample<'static> {
    let t = i as f64 / POINTS as f64;
    Sample {
        x: [t, 1.0 - t, t * t],
        u: t,
        gradient: [1.0, t, -t],
        arrays: &[],
    }
}

/// Nanoseconds a point, the best of many runs.
fn time(mut run: impl FnMut()) -> f64 {
    let once = |run: &mut dyn FnMut()| {
        let start = Instant::now();
        run();
        start.elapsed().as_secs_f64()
    };
    let best = (0..100)
        .map(|_| once(&mut run))
        .fold(f64::INFINITY, f64::min);
    best * 1e9 / POINTS as f64
}

#[test]
#[ignore = "a measurement, for release builds"]
fn nanoseconds_a_point() {
    report("constant", "1");
    report(
        "20 operations, none slow",
        "6*x*(y^3-y^2)*(z^2+1) + (x^3-x)*(6*y-2)*u + 2*ux*(y - uy)",
    );
    report(
        "20 operations with sin, cos, exp",
        "2*pi*cos(pi*x)*sin(pi*y)*u*z - 3*pi^2*u + x*y*z - exp(-x)*ux/2 + y^2*uy - x*z",
    );
    report(
        "problem 4 (4 exp)",
        "-100*exp(-(5-10*x)^2/2) + (50-100*x)*ux - 150*exp(-(5-10*x)^2/2)*exp(-(5-10*y)^2/2) \
         - 75*exp(-(5-10*y)^2/2) + (50-100*y)*uy",
    );
    report("problem 5", "2*pi*cos(pi*x)*sin(pi*y)*sin(pi*z) - 3*pi^2*u");
}
