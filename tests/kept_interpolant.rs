//! An interpolant that is kept is contoured as one that is new, and so are bare arrays.

mod support;

use std::borrow::Cow;

use support::tetrahedra::kuhn_grid;
use vtu2contour::contour::Levels;
use vtu2contour::contour::surface::ContourSurface;
use vtu2contour::filter::{
    ContourOptions, FilterError, GradientSource, Gradients, Interpolant, Solution, contour,
};
use vtu2contour::mesh::{TetrahedronMesh, TriangleMesh, Vector};
use vtu2contour::vtk::{DataArray, UnstructuredGrid};

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

/// Tetrahedra and the faces of one side of the cube, which are triangles.
fn mixed_grid(mesh: &TetrahedronMesh) -> UnstructuredGrid {
    let flat =
        |vectors: &[Vector]| vectors.iter().flat_map(|v| [v.x, v.y, v.z]).collect::<Vec<_>>();
    let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, flat(mesh.points())));
    let is_below = |point: &&u32| mesh.points()[**point as usize].z == 0.0;
    for corners in mesh.tetrahedra() {
        grid.push_cell(10, &corners.map(i64::from));
        let bottom: Vec<i64> = corners.iter().filter(is_below).map(|&p| i64::from(p)).collect();
        if bottom.len() == 3 {
            grid.push_cell(5, &bottom);
        }
    }
    let (values, gradients): (Vec<f64>, Vec<Vector>) = mesh.points().iter().map(wave).unzip();
    grid.point_data.push(DataArray::new("u", 1, values));
    grid.point_data.push(DataArray::new("g", 3, flat(&gradients)));
    grid
}

#[test]
fn every_level_is_as_that_of_a_new_one() {
    let grid = mixed_grid(&kuhn_grid(5));
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
    let grid = mixed_grid(&mesh);
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
