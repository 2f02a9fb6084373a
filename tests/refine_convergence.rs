//! A solver in a loop of refinement: at corners and slits the error of linear elements falls as
//! fast as where there are none, and on uniform meshes it does not.

mod support;

use support::p1::{Harmonic, corner, error, indicators, solve, tip};
use vtu2contour::mesh::{TriangleMesh, Vector};
use vtu2contour::monitor::Selection;
use vtu2contour::refine::{Marks, TriangleMethod};

/// Squares of side 1/2 in [-1, 1]², each cut in two, those left out whose centre is `hole`.
fn squares(hole: impl Fn(f64, f64) -> bool) -> TriangleMesh<'static> {
    let at = |k: u32| f64::from(k) / 2.0 - 1.0;
    let points = (0..25).map(|n| Vector::new(at(n % 5), at(n / 5), 0.0)).collect();
    let lower_left = (0..16).map(|n| n % 4 + n / 4 * 5);
    let kept = lower_left.filter(|n| !hole(at(n % 5) + 0.25, at(n / 5) + 0.25));
    let triangles = kept.flat_map(|a| [[a, a + 1, a + 6], [a, a + 6, a + 5]]);
    TriangleMesh::new(points, triangles.collect()).unwrap()
}

fn l_shape() -> TriangleMesh<'static> {
    let whole = squares(|x, y| x > 0.0 && y < 0.0);
    // without the points that no triangle uses
    let is_used = |point: u32| whole.triangles().iter().flatten().any(|other| *other == point);
    let used: Vec<u32> = (0..25).filter(|point| is_used(*point)).collect();
    let number = |point: u32| used.iter().position(|other| *other == point).unwrap() as u32;
    let points = used.iter().map(|&point| whole.points()[point as usize]).collect();
    let triangles = whole.triangles().iter().map(|corners| corners.map(number)).collect();
    TriangleMesh::new(points, triangles).unwrap()
}

/// Cut along the positive x axis: points 13 and 14 are there twice.
fn slit() -> TriangleMesh<'static> {
    let whole = squares(|_, _| false);
    let mut points = whole.points().to_vec();
    points.extend([points[13], points[14]]);
    let triangles = whole.triangles().iter().map(|corners| {
        let centre = corners.iter().map(|&point| whole.points()[point as usize].y).sum::<f64>();
        corners.map(|point| match point {
            13 | 14 if centre < 0.0 => point + 12,
            other => other,
        })
    });
    let triangles = triangles.collect();
    TriangleMesh::new(points, triangles).unwrap()
}

/// The slope of the logarithm of the error over that of the number of points, over the
/// later half of the steps: of refinement by the indicators, or of everything.
fn rate(
    mesh: TriangleMesh<'static>,
    of: Harmonic,
    method: TriangleMethod,
    selection: Option<Selection>,
    most: usize,
) -> f64 {
    let (mut mesh, mut state, mut history) = (mesh, Vec::new(), Vec::new());
    while mesh.points().len() < most {
        let u = solve(&mesh, of);
        let unknowns = mesh.points().len() as f64;
        history.push([unknowns.ln(), error(&mesh, &u, of).ln()]);
        let all = || (0..mesh.triangles().len() as u32).collect();
        let cells = selection.map_or_else(all, |s| s.select(&indicators(&mesh, &u)).unwrap());
        let marks = Marks { state: &state, ..Marks::all(&cells) };
        let refined = method.refine(&mesh, &marks).unwrap();
        state = refined.state;
        mesh = TriangleMesh::new(refined.points, refined.cells).unwrap();
    }
    let later = &history[history.len() / 2..];
    let mean = |n: usize| later.iter().map(|step| step[n]).sum::<f64>() / later.len() as f64;
    let (x, y) = (mean(0), mean(1));
    let product = |step: &[f64; 2]| (step[0] - x) * (step[1] - y);
    later.iter().map(product).sum::<f64>()
        / later.iter().map(|step| (step[0] - x).powi(2)).sum::<f64>()
}

#[test]
fn the_rate_is_optimal_by_refinement_and_not_without() {
    let bulk = Some(Selection::Bulk(0.5));
    let domains: [(_, Harmonic, f64); 2] =
        [(l_shape(), corner, -1.0 / 3.0), (slit(), tip, -1.0 / 4.0)];
    for (mesh, of, expected) in domains {
        for method in
            [TriangleMethod::LongestEdge, TriangleMethod::NewestVertex, TriangleMethod::RedGreen]
        {
            let found = rate(mesh.clone(), of, method, bulk, 6000);
            assert!((-0.58..-0.46).contains(&found), "{method:?}: {found}");
        }
        let uniform = rate(mesh, of, TriangleMethod::RedGreen, None, 12000);
        assert!((uniform - expected).abs() < 0.04, "{uniform} {expected}");
    }
}
