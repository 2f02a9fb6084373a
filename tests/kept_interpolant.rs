//! An interpolant that is kept is contoured as one that is new, and so are bare arrays.

mod support;

use std::borrow::Cow;

use support::mixed_grid::mixed_grid;
use support::tetrahedra::kuhn_grid;
use vtu2contour::contour::Levels;
use vtu2contour::contour::surface::ContourSurface;
use vtu2contour::filter::{
    ContourOptions, FilterError, GradientSource, Gradients, Interpolant, Solution, contour,
};
use vtu2contour::mesh::{TetrahedronMesh, TriangleMesh, Vector};

/// A smooth function that is no cubic, and its gradient.
fn wave(p: &Vector) -> (f64, Vector) {
    let (s, c) = (3.0 * p.x + 2.0 * p.y + p.z).sin_cos();
    (s + p.z * p.z, Vector::new(3.0 * c, 2.0 * c, c + 2.0 * p.z))
}

fn options(level: f64) -> ContourOptions {
    ContourOptions {
        levels: Levels::Explicit(vec![level]),
        array: Some("u".to_owned()),
        gradient: GradientSource::Array("g".to_owned()),
        ..ContourOptions::default()
    }
}

#[test]
fn every_level_is_as_that_of_a_new_one() {
    let grid = mixed_grid(&kuhn_grid(5), wave, |_| false);
    let solution = Solution::of_grid(&grid, &options(0.0)).unwrap();
    let kept = Interpolant::new(solution, &options(0.0)).unwrap();
    for level in [-0.5, 0.25, 0.9] {
        let contours = kept.contours(&options(level)).unwrap();
        let output = kept.output(&contours, options(level).output(&grid)).poly_data(&grid);
        let new = contour(&grid, &options(level), &mut |_| {}).unwrap();
        assert!(!output.lines.is_empty() && !output.polys.is_empty());
        assert_eq!(output, new.poly_data);
    }
}

#[test]
fn views_of_arrays_are_contoured_as_the_grid_of_them() {
    let mesh = kuhn_grid(5);
    let grid = mixed_grid(&mesh, wave, |_| false);
    let (values, vectors): (Vec<f64>, Vec<Vector>) = mesh.points().iter().map(wave).unzip();
    let view = TetrahedronMesh::view(mesh.points(), mesh.tetrahedra()).unwrap();
    let gradients = Gradients::given(&view, &values, Cow::Borrowed(&vectors), "g", "u");
    let solution = Solution::of_tetrahedra(view, &values, gradients, None).unwrap();
    let kept = Interpolant::new(solution, &options(0.25)).unwrap();
    let surface = kept.contours(&options(0.25)).unwrap().surface.unwrap();
    let whole = contour(&grid, &options(0.25), &mut |_| {}).unwrap().surface;
    // the corners of cells that are left-handed here have another order in the grid
    let positions = |s: &ContourSurface| s.points.iter().map(|p| p.position).collect::<Vec<_>>();
    assert!(!surface.triangles.is_empty());
    assert_eq!(positions(&surface), positions(&whole));
    assert_eq!(surface.triangles, whole.triangles);
}

#[test]
fn arrays_of_other_lengths_are_refused() {
    let points = [Vector::zeros(), Vector::x(), Vector::y()];
    let mesh = || TriangleMesh::view(&points, &[[0, 1, 2]]).unwrap();
    let short = || Gradients::given(&mesh(), &[0.0; 3], Cow::Owned(vec![Vector::x()]), "g", "u");
    let refused = |solution: Result<Solution, FilterError>| solution.err().unwrap().to_string();
    let values = Solution::of_triangles(mesh(), &[0.0; 2], Gradients::none(), None);
    assert!(refused(values).contains("values for each point: there are 2, and 3 points"));
    let gradients = Solution::of_triangles(mesh(), &[0.0; 3], short(), None);
    assert!(refused(gradients).contains("gradients for each point: there are 1, and 3 points"));
}
