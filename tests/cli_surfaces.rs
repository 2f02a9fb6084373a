//! The command line on solids: iso-surfaces.

#[path = "support/program.rs"]
mod program;

use program::{Bench, read_lines};
use vtu2contour::vtk::{DataArray, PolyData, UnstructuredGrid, write_vtu};

/// `n³` unit cubes as hexahedra, and `u = x² + y² + z²` with its gradient.
fn cubes(n: i64) -> UnstructuredGrid {
    let side = n + 1;
    let point = |number: i64| [number % side, number / side % side, number / (side * side)];
    let points: Vec<[f64; 3]> =
        (0..side.pow(3)).map(|number| point(number).map(|x| x as f64)).collect();
    let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, points.concat()));
    for cube in 0..n.pow(3) {
        let first = cube % n + side * (cube / n % n + side * (cube / (n * n)));
        let face = [first, first + 1, first + 1 + side, first + side];
        let above = face.map(|corner| corner + side * side);
        grid.push_cell(12, &[face, above].concat());
    }
    let u = points.iter().map(|p| p.iter().map(|x| x * x).sum());
    let gradient: Vec<f64> = points.iter().flatten().map(|x| 2.0 * x).collect();
    grid.point_data.push(DataArray::new("u", 1, u.collect::<Vec<f64>>()));
    grid.point_data.push(DataArray::new("grad_u", 3, gradient));
    grid.cell_data.push(DataArray::new("cube", 1, (0..n.pow(3)).collect::<Vec<i64>>()));
    grid
}

fn bench() -> Bench {
    let bench = Bench::new();
    write_vtu(bench.path("in.vtu"), &cubes(3), Default::default()).unwrap();
    bench
}

fn floats(data: &PolyData, name: &str) -> Vec<f64> {
    data.point_data.get(name).unwrap().to_f64().unwrap()
}

#[test]
fn a_sphere_is_one() {
    let bench = bench();
    let said = bench.succeed(&["in.vtu", "-o", "out.vtp", "-v", "4.1", "--normals", "--gradients"]);
    assert_eq!(said, "");
    let sphere = read_lines(&bench.path("out.vtp"));
    assert!(sphere.polys.len() > 100 && sphere.lines.is_empty());
    let radius = 4.1_f64.sqrt();
    let points = sphere.points.to_f64().unwrap();
    let (gradients, normals) = (floats(&sphere, "Gradients"), floats(&sphere, "Normals"));
    for n in 0..points.len() / 3 {
        let of = |values: &[f64]| [values[3 * n], values[3 * n + 1], values[3 * n + 2]];
        let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let point = of(&points);
        // quadratics are exact, so all points lie on the sphere
        assert!((length(point) - radius).abs() < 1e-13, "{point:?}");
        for (k, x) in point.into_iter().enumerate() {
            assert!((of(&gradients)[k] - 2.0 * x).abs() < 1e-12);
            // normals are along -grad u, of single precision
            assert!((of(&normals)[k] + x / radius).abs() < 1e-6);
        }
    }
    assert!(floats(&sphere, "u").iter().all(|&u| u == 4.1));
    let cubes = sphere.cell_data.get("cube").unwrap().to_f64();
    assert_eq!(cubes, sphere.cell_data.get("OriginalCellIds").unwrap().to_f64());
}

#[test]
fn triangles_by_points_a_side_and_by_number() {
    let bench = bench();
    let count = |arguments: &[&str]| {
        let all = [&["in.vtu", "-o", "out.vtp", "-v", "4.1,6.2"], arguments].concat();
        bench.succeed(&all);
        read_lines(&bench.path("out.vtp")).polys.len()
    };
    let coarsest = count(&["--nside", "2"]);
    assert_eq!(count(&["--nside", "3"]), 4 * coarsest);
    let budget = (9 * coarsest).to_string();
    assert_eq!(count(&["--triangles", &budget]), 9 * coarsest);
    let less = (9 * coarsest - 1).to_string();
    assert_eq!(count(&["--triangles", &less]), 4 * coarsest);
    assert!(count(&["--tolerance", "0.001"]) > count(&["--tolerance", "0.01"]));
    let said =
        self::bench().fail(2, &["in.vtu", "-o", "out.vtp", "--nside", "3", "--tolerance", "1"]);
    assert!(said.contains("cannot be used with"), "{said}");
}

#[test]
fn stats_and_info_know_tetrahedra() {
    let bench = bench();
    bench.succeed(&["in.vtu", "-o", "out.vtp", "-v", "4", "--stats", "stats.json"]);
    let stats = std::fs::read_to_string(bench.path("stats.json")).unwrap();
    let triangles = read_lines(&bench.path("out.vtp")).polys.len();
    for part in [
        "\"tetrahedra\": 162".to_owned(),
        "\"unresolved\": 0".to_owned(),
        format!("\"triangles\": {triangles}"),
    ] {
        assert!(stats.contains(&part), "{part}: {stats}");
    }
    let info = String::from_utf8(bench.run(&["info", "in.vtu"]).stdout).unwrap();
    assert!(info.contains("cells     162 tetrahedra\n"), "{info}");
    assert!(info.contains("range     0.0 to 27.0\n"), "{info}");
}

#[test]
fn a_picture_of_solids_is_refused() {
    let said = bench().fail(1, &["in.vtu", "-o", "out.svg"]);
    assert!(said.contains("the grid has solids only: write surfaces, with -o NAME.vtp"), "{said}");
}

#[test]
fn mixed_grids_have_lines_and_surfaces() {
    let bench = Bench::new();
    let mut grid = cubes(2);
    // a quad of the boundary
    grid.push_cell(9, &[0, 1, 4, 3]);
    grid.cell_data = Default::default();
    write_vtu(bench.path("in.vtu"), &grid, Default::default()).unwrap();
    bench.succeed(&["in.vtu", "-o", "out.vtp", "-v", "0.5"]);
    let both = read_lines(&bench.path("out.vtp"));
    assert_eq!(both.lines.len(), 1);
    assert!(both.polys.len() > 1);
    let cells = both.cell_data.get("OriginalCellIds").unwrap().to_f64().unwrap();
    assert_eq!(cells[0], 8.0);
    assert!(cells[1..].iter().all(|&cell| cell == 0.0));
    let points = both.points.to_f64().unwrap();
    for point in points.chunks_exact(3) {
        assert!((point.iter().map(|x| x * x).sum::<f64>() - 0.5).abs() < 1e-13);
    }
}
