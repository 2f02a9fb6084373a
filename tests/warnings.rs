//! What the filter tells people: of a PDE or a gradient that is hardly the solution's,
//! and silence where all is well.

mod support;

use std::f64::consts::PI;
use std::path::Path;

use support::domains::Domain;
use support::meshes::{Random, random_square};
use vtu2contour::contour::Levels;
use vtu2contour::filter::{
    Component, ContourOptions, GradientSource, InterpolantKind, contour, preview,
};
use vtu2contour::mesh::{TriangleMesh, Vector};
use vtu2contour::vtk::{DataArray, Selection, UnstructuredGrid, VtuFile};

fn sample(name: &str) -> UnstructuredGrid {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples").join(name);
    VtuFile::open(file).unwrap().read(&Selection::All).unwrap().data
}

fn warnings(grid: &UnstructuredGrid, options: &ContourOptions) -> Vec<String> {
    contour(grid, options, &mut |_| {}).unwrap().report.warnings
}

fn with_pde(pde: &str) -> ContourOptions {
    let parameters = if pde.contains("k2") { vec![("k2".to_owned(), 84.39413)] } else { vec![] };
    ContourOptions { pde: Some(pde.to_owned()), parameters, ..ContourOptions::default() }
}

#[test]
fn the_right_pde_is_used_in_silence() {
    for (name, pde) in [
        ("islands.vtu", "uxx + uyy = -k2*u"),
        ("plate_with_holes.vtu", "uxx + uyy = -6"),
        ("no_gradient.vtu", "uxx + uyy = 0"),
        ("problem4.vtu", "uxx + uyy = laplacian"),
    ] {
        assert_eq!(warnings(&sample(name), &with_pde(pde)), Vec::<String>::new(), "{name}");
    }
}

/// sin(kx) cos(ky) on random points, with its gradient: 150 of them are eight a
/// wavelength.
fn coarse(seed: u64, points: usize) -> UnstructuredGrid {
    waves_on(&random_square(&mut Random(seed), points))
}

/// sin(kx) cos(ky) on a mesh, with its gradient.
fn waves_on(mesh: &TriangleMesh) -> UnstructuredGrid {
    let k = 3.0 * PI;
    let coordinates = mesh.points().iter().flat_map(|p| [p.x, p.y, p.z]).collect::<Vec<f64>>();
    let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, coordinates));
    for triangle in mesh.triangles() {
        grid.push_cell(5, &triangle.map(i64::from));
    }
    let values = mesh.points().iter().map(|p| (k * p.x).sin() * (k * p.y).cos());
    let gradient = |p: &Vector| {
        let (sx, cx, sy, cy) = ((k * p.x).sin(), (k * p.x).cos(), (k * p.y).sin(), (k * p.y).cos());
        [k * cx * cy, -k * sx * sy, 0.0]
    };
    let gradients = mesh.points().iter().flat_map(gradient).collect::<Vec<f64>>();
    grid.point_data.push(DataArray::new("u", 1, values.collect::<Vec<f64>>()));
    grid.point_data.push(DataArray::new("gradient", 3, gradients));
    grid
}

#[test]
fn coarse_meshes_do_not_make_a_right_pde_wrong() {
    let k = 3.0 * PI;
    for seed in 0..20 {
        let grid = coarse(seed, 150);
        let right = with_pde(&format!("uxx + uyy = -2*{k}^2*u"));
        assert_eq!(warnings(&grid, &right), Vec::<String>::new(), "seed {seed}");
        let wrong = with_pde(&format!("uxx + uyy = 2*{k}^2*u"));
        assert_eq!(warnings(&grid, &wrong).len(), 1, "seed {seed}");
    }
}

#[test]
fn a_wrong_pde_is_noticed() {
    for (name, pde) in [
        ("islands.vtu", "uxx + uyy = k2*u"),
        ("islands.vtu", "uxx + uyy = -2*k2*u"),
        ("islands.vtu", "uxx + uyy = -k2*u/2"),
        ("islands.vtu", "uxx + uyy = 500"),
        ("islands.vtu", "uxx + uyy = 0"),
        ("plate_with_holes.vtu", "uxx + uyy = 6"),
        ("plate_with_holes.vtu", "uxx + uyy = -12"),
        ("problem4.vtu", "uxx + uyy = -laplacian"),
        ("problem4.vtu", "uxx + uyy = 10*laplacian"),
    ] {
        let told = warnings(&sample(name), &with_pde(pde));
        assert!(told.iter().any(|w| w.contains("the PDE does not fit")), "{name} {pde}: {told:?}");
    }
}

#[test]
fn a_field_array_of_one_number_is_a_parameter() {
    let grid = sample("islands.vtu");
    let options = ContourOptions {
        pde: Some("uxx + uyy = -k2*u".to_owned()),
        parameters: Vec::new(),
        ..ContourOptions::default()
    };
    assert_eq!(warnings(&grid, &options), Vec::<String>::new());
    // a parameter that is given wins: with this one the PDE does not fit
    let parameters = vec![("k2".to_owned(), -84.0)];
    let given = ContourOptions { parameters, ..options.clone() };
    assert_eq!(warnings(&grid, &given).len(), 1);
    // one of several numbers cannot be meant, and is told
    let mut grid = grid;
    grid.field_data.push(DataArray::new("k2", 1, vec![84.4, 1.0]));
    assert!(refusal(&grid, &options).contains("'k2' is a field array, but not of one number"));
}

fn recovering(array: &str, component: Option<Component>) -> ContourOptions {
    let gradient = GradientSource::Recovered;
    ContourOptions {
        array: Some(array.to_owned()),
        component,
        gradient,
        ..ContourOptions::default()
    }
}

#[test]
fn recovered_gradients_of_the_samples_are_used_in_silence() {
    for (name, gradient) in [
        ("islands.vtu", Some("Gradients")),
        ("plate_with_holes.vtu", Some("grad_u")),
        ("no_gradient.vtu", None),
        ("problem4.vtu", Some("gradient")),
        ("surface.vtu", Some("gradient")),
    ] {
        let grid = sample(name);
        let arrays = gradient.map(|array| (array, Some(Component::Magnitude)));
        for (array, component) in [("u", None)].into_iter().chain(arrays) {
            let options = recovering(array, component);
            let report = contour(&grid, &options, &mut |_| {}).unwrap().report;
            let values = grid.point_data.get(array).unwrap().to_f64().unwrap();
            let of_tuple = |tuple: &[f64]| match component {
                Some(_) => tuple.iter().map(|x| x * x).sum::<f64>().sqrt(),
                None => tuple[0],
            };
            let width = if component.is_some() { 3 } else { 1 };
            let values = values.chunks(width).map(of_tuple);
            let low = values.clone().fold(f64::INFINITY, f64::min);
            let high = values.fold(f64::NEG_INFINITY, f64::max);
            let range = preview(&grid, &options).unwrap().range;
            let beyond = (low - range[0]).max(range[1] - high) / (high - low);
            println!("{name} {array}: {range:.4?} beyond {low:.4} to {high:.4}");
            assert!(beyond < 0.1, "{name} {array}: {beyond}");
            assert_eq!(report.warnings, Vec::<String>::new(), "{name} {array}");
        }
    }
}

/// Noise is told: cubics swing far about it. Smooth data are not, down to eight points a
/// wavelength.
#[test]
fn cubics_far_beyond_the_values_are_told() {
    for seed in 0..20 {
        let mesh = Domain::rectangle("square", 1.0, 1.0).mesh(&mut Random(seed), 0.085);
        let told = warnings(&waves_on(&mesh), &recovering("u", None));
        assert_eq!(told, Vec::<String>::new(), "seed {seed}");
    }
    let mut grid = coarse(1, 150);
    let mut random = Random(3);
    let noise = (0..grid.points.tuples()).map(|_| random.uniform(-1.0, 1.0));
    grid.point_data.push(DataArray::new("noise", 1, noise.collect::<Vec<f64>>()));
    let told = warnings(&grid, &recovering("noise", None)).concat();
    assert!(told.contains("the cubics of 'noise' reach from"), "{told}");
    let linear = InterpolantKind::Linear;
    let options = ContourOptions { interpolant: linear, ..recovering("noise", None) };
    assert!(!warnings(&grid, &options).concat().contains("the cubics of"));
}

fn refusal(grid: &UnstructuredGrid, options: &ContourOptions) -> String {
    contour(grid, options, &mut |_| {}).err().unwrap().to_string()
}

#[test]
fn names_that_cannot_stand_in_a_pde_are_explained() {
    let grid = sample("islands.vtu");
    let told = refusal(&grid, &with_pde("uxx + uyy = Gradients"));
    assert!(told.contains("'Gradients' is a point array of 3 components"), "{told}");
    let told = refusal(&sample("problem4.vtu"), &with_pde("uxx + uyy = area"));
    assert!(told.contains("'area' is a cell array"), "{told}");
}

#[test]
fn a_parameter_that_is_not_used_is_told() {
    let parameters = vec![("k2".to_owned(), 84.39413), ("zz".to_owned(), 3.0)];
    let options = ContourOptions { parameters, ..with_pde("uxx + uyy = -k2*u") };
    let told = warnings(&sample("islands.vtu"), &options);
    assert_eq!(told, ["the PDE does not use the parameter 'zz'"]);
}

#[test]
fn a_gradient_of_a_constant_must_be_zero() {
    let mut grid = coarse(1, 150);
    let points = grid.points.tuples();
    grid.point_data.push(DataArray::new("u", 1, vec![2.0; points]));
    let told = warnings(&grid, &ContourOptions::default());
    let expected = "array 'gradient' is not used as the gradient of 'u': values change far less";
    assert!(told[0].starts_with(expected), "{told:?}");
    // rounding is zero
    grid.point_data.push(DataArray::new("gradient", 3, vec![1e-13; 3 * points]));
    assert!(!warnings(&grid, &ContourOptions::default()).concat().contains("not used"));
}

#[test]
fn components_of_the_gradient_may_be_arrays_of_their_own() {
    let mut grid = coarse(1, 400);
    let gradient = grid.point_data.get("gradient").unwrap().clone();
    for (name, axis) in [("a", 0), ("b", 1)] {
        let values = gradient.component(axis).unwrap();
        grid.point_data.push(DataArray::new(name, 1, values));
    }
    let named = |name: &str| ContourOptions {
        array: Some("u".to_owned()),
        gradient: GradientSource::Array(name.to_owned()),
        ..ContourOptions::default()
    };
    let lines = |options| contour(&grid, options, &mut |_| {}).unwrap().lines.points;
    assert_eq!(lines(&named("a,b")), lines(&named("gradient")));
    assert!(refusal(&grid, &named("a,c")).contains("no point array 'c'"));
    assert!(refusal(&grid, &named("a,gradient")).contains("two or three arrays"));
}

#[test]
fn cells_with_points_of_their_own_are_told_and_can_be_merged() {
    let whole = coarse(2, 400);
    let mut torn = UnstructuredGrid::new(corners_of(&whole, &whole.points));
    for cell in 0..whole.types.len() as i64 {
        torn.push_cell(5, &[3 * cell, 3 * cell + 1, 3 * cell + 2]);
    }
    for array in whole.point_data.iter() {
        torn.point_data.push(corners_of(&whole, array));
    }
    let levels = Levels::Explicit(vec![0.3]);
    let options = ContourOptions { levels, ..ContourOptions::default() };
    let lines = |grid: &UnstructuredGrid, options: &ContourOptions| {
        contour(grid, options, &mut |_| {}).unwrap().lines.lines.len()
    };
    let told = warnings(&torn, &options).concat();
    assert!(told.contains("points are at the place of another") && told.contains("--merge-points"));
    assert_eq!(warnings(&whole, &options), Vec::<String>::new());
    assert!(lines(&torn, &options) > 5 * lines(&whole, &options));
    let merging = ContourOptions { merge_points: Some(0.0), ..options.clone() };
    assert_eq!(warnings(&torn, &merging), Vec::<String>::new());
    assert_eq!(lines(&torn, &merging), lines(&whole, &options));
}

/// The tuples of an array at the corners of all cells.
fn corners_of(grid: &UnstructuredGrid, array: &DataArray) -> DataArray {
    let (values, width) = (array.to_f64().unwrap(), array.components);
    let tuple = |&point: &i64| values[point as usize * width..][..width].to_vec();
    let corners = grid.cells.iter().flatten().flat_map(tuple).collect::<Vec<f64>>();
    DataArray::new(array.name.clone(), width, corners)
}

/// A hexahedron with two corners of its top exchanged.
#[test]
fn a_cell_that_folds_over_itself_is_told() {
    let corners =
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1], [1, 1, 1]];
    let points: Vec<f64> = corners.iter().flatten().map(|&x| f64::from(x)).collect();
    let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, points));
    grid.push_cell(12, &[0, 1, 2, 3, 4, 5, 6, 7]);
    let values: Vec<f64> = corners.iter().map(|p| f64::from(p[0] + 2 * p[1] + 4 * p[2])).collect();
    grid.point_data.push(DataArray::new("u", 1, values));
    let told = warnings(&grid, &ContourOptions::default());
    assert!(
        told.iter().any(|text| text.starts_with("1 hexahedra fold over themselves")),
        "{told:?}"
    );
    let found = preview(&grid, &ContourOptions::default()).unwrap();
    assert_eq!(found.folded.to_string(), "1 hexahedra");
}
