//! The command line: the cubics at points, on refined meshes, on regular grids.

#[path = "support/program.rs"]
mod program;

use std::fs;

use program::{Bench, sample, square_of};
use vtu2contour::vtk::{
    Attributes, DataArray, Selection, UnstructuredGrid, Values, VtpFile, VtuFile, write_vtu,
};

/// A cubic and its gradient.
fn cubic([x, y, z]: [f64; 3]) -> (f64, [f64; 3]) {
    let value = x * x * x - 2.0 * x * y + y * y + 3.0 * z * z * x;
    (value, [3.0 * x * x - 2.0 * y + 3.0 * z * z, 2.0 * y - 2.0 * x, 6.0 * z * x])
}

/// Its PDE, which makes the interpolant exact.
const PDE: &str = "uxx + uyy + uzz = 12*x + 2";

/// In the plane z = 0.
const PLANE_PDE: &str = "uxx + uyy = 6*x + 2";

fn with_data(mut grid: UnstructuredGrid) -> UnstructuredGrid {
    let points = grid.points.to_f64().unwrap();
    let points = points.as_chunks::<3>().0;
    let values: Vec<f64> = points.iter().map(|p| cubic(*p).0).collect();
    let gradients: Vec<f64> = points.iter().flat_map(|p| cubic(*p).1).collect();
    let linear: Vec<f64> = points.iter().map(|p| 1.0 + 2.0 * p[0] - p[1]).collect();
    grid.point_data.push(DataArray::new("u", 1, values));
    grid.point_data.push(DataArray::new("grad_u", 3, gradients));
    grid.point_data.push(DataArray::new("linear", 1, linear));
    let cells: Vec<i64> = (100..100 + grid.cells.len() as i64).collect();
    grid.cell_data.push(DataArray::new("cell", 1, cells));
    grid
}

/// The unit square as quads and triangles.
fn square() -> UnstructuredGrid {
    let cells: [(u8, &[i64]); 5] = [
        (9, &[0, 1, 4, 3]),
        (5, &[1, 2, 5]),
        (5, &[1, 5, 4]),
        (9, &[3, 4, 7, 6]),
        (9, &[4, 5, 8, 7]),
    ];
    with_data(square_of(&cells))
}

/// Two hexahedra along x, of length 1 each.
fn bar() -> UnstructuredGrid {
    let points = (0..12).flat_map(|n| [n % 3, n / 3 % 2, n / 6]).map(f64::from);
    let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, points.collect::<Vec<f64>>()));
    for first in [0, 1] {
        let face = [first, first + 1, first + 4, first + 3];
        grid.push_cell(12, &[face, face.map(|corner| corner + 6)].concat());
    }
    with_data(grid)
}

fn bench(grid: &UnstructuredGrid) -> Bench {
    let bench = Bench::new();
    write_vtu(bench.path("in.vtu"), grid, Default::default()).unwrap();
    bench
}

fn numbers(data: &Attributes, name: &str) -> Vec<f64> {
    data.get(name).unwrap_or_else(|| panic!("{name}")).to_f64().unwrap()
}

/// At each point the cubic, its gradient, and the linear array.
fn check(points: &[[f64; 3]], data: &Attributes, dimension: usize) {
    let (u, gradients) = (numbers(data, "u"), numbers(data, "Gradients"));
    let linear = numbers(data, "linear");
    assert_eq!(data.active_names()[0].1, "u");
    for (n, p) in points.iter().enumerate() {
        let (value, gradient) = cubic(*p);
        assert!((u[n] - value).abs() < 1e-12, "{p:?}: {} {value}", u[n]);
        assert!((linear[n] - (1.0 + 2.0 * p[0] - p[1])).abs() < 1e-12);
        for axis in 0..dimension {
            assert!((gradients[3 * n + axis] - gradient[axis]).abs() < 1e-10, "{p:?}");
        }
    }
}

fn points_of(array: &DataArray) -> Vec<[f64; 3]> {
    array.to_f64().unwrap().as_chunks::<3>().0.to_vec()
}

fn read(bench: &Bench, name: &str) -> UnstructuredGrid {
    VtuFile::open(bench.path(name)).unwrap().read(&Selection::All).unwrap().data
}

#[test]
fn at_the_points_of_a_table() {
    let bench = bench(&square());
    fs::write(bench.path("at.csv"), "name,x,y\na,0.3,0.7\nb,0.5,0.5\nc,2,0\nd,1,1\n").unwrap();
    let said = bench.succeed(&[
        "interpolate",
        "in.vtu",
        "-o",
        "out.csv",
        "--at",
        "at.csv",
        "-a",
        "u",
        "--pde",
        PLANE_PDE,
    ]);
    assert!(said.contains("1 points are outside the mesh"), "{said}");
    let text = fs::read_to_string(bench.path("out.csv")).unwrap();
    let mut lines = text.lines();
    let names = lines.next().unwrap();
    assert_eq!(
        names,
        "x,y,z,u,grad_u:0,grad_u:1,grad_u:2,linear,Gradients:0,Gradients:1,Gradients:2,vtkValidPointMask"
    );
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|field| field.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 4);
    for (row, point) in rows.iter().zip([[0.3, 0.7], [0.5, 0.5], [2.0, 0.0], [1.0, 1.0]]) {
        let (value, gradient) = cubic([point[0], point[1], 0.0]);
        assert_eq!(row[..3], [point[0], point[1], 0.0]);
        if point[0] > 1.0 {
            assert!(row[3..11].iter().all(|x| x.is_nan()) && row[11] == 0.0);
        } else {
            assert!((row[3] - value).abs() < 1e-12 && row[11] == 1.0);
            assert!((row[8] - gradient[0]).abs() < 1e-12);
        }
    }
}

#[test]
fn at_the_points_of_a_grid() {
    let bench = bench(&bar());
    let points = [[0.3, 0.2, 0.9], [1.5, 1.0, 0.0], [1.0, 0.5, 0.5], [2.0, 1.0, 1.0]];
    let mut there = UnstructuredGrid::new(DataArray::new("Points", 3, points.concat()));
    there.push_cell(10, &[0, 1, 2, 3]);
    write_vtu(bench.path("at.vtu"), &there, Default::default()).unwrap();
    let job = ["interpolate", "in.vtu", "--at", "at.vtu", "-a", "u", "--pde", PDE];
    assert_eq!(bench.succeed(&[&job[..], &["-o", "out.vtu"]].concat()), "");
    let found = read(&bench, "out.vtu");
    check(&points, &found.point_data, 3);
    assert_eq!(found.cells, there.cells);
    bench.succeed(&[&job[..], &["-o", "out.vtp"]].concat());
    let found = VtpFile::open(bench.path("out.vtp")).unwrap().read(&Selection::All).unwrap().data;
    check(&points, &found.point_data, 3);
    assert_eq!(found.verts.len(), 4);
}

#[test]
fn on_subdivided_cells() {
    for (grid, dimension, simplices, pde) in [(square(), 2, 8, PLANE_PDE), (bar(), 3, 12, PDE)] {
        let bench = bench(&grid);
        let job = ["interpolate", "in.vtu", "-o", "out.vtu", "-a", "u", "--pde", pde];
        bench.succeed(&[&job[..], &["--subdivide", "4"]].concat());
        let fine = read(&bench, "out.vtu");
        assert_eq!(fine.cells.len(), simplices * 4_usize.pow(dimension));
        check(&points_of(&fine.points), &fine.point_data, dimension as usize);
        // cell data travel along
        let (cell, parent) =
            (numbers(&fine.cell_data, "cell"), numbers(&fine.cell_data, "OriginalCellIds"));
        assert!(cell.iter().zip(parent).all(|(cell, parent)| *cell == 100.0 + parent));
        // and contouring the finer mesh finds the data again
        bench.succeed(&["out.vtu", "-o", "lines.vtp", "-v", "0.3"]);
    }
}

#[test]
fn on_adapted_cells() {
    let bench = bench(&bar());
    let job = ["interpolate", "in.vtu", "-o", "out.vtu", "-a", "u", "--pde", PDE, "--tolerance"];
    let cells = ["1", "0.1", "0.01"].map(|tolerance| {
        bench.succeed(&[&job[..], &[tolerance]].concat());
        let fine = read(&bench, "out.vtu");
        check(&points_of(&fine.points), &fine.point_data, 3);
        fine.cells.len()
    });
    assert!(cells[0] < cells[1] && 4 * cells[1] < cells[2], "{cells:?}");
}

#[test]
fn on_regular_points() {
    let bench = bench(&bar());
    let job =
        ["interpolate", "in.vtu", "-o", "out.vti", "-a", "u", "--pde", PDE, "--encoding", "ascii"];
    assert_eq!(bench.succeed(&[&job[..], &["--grid", "5,3,2"]].concat()), "");
    let text = fs::read_to_string(bench.path("out.vti")).unwrap();
    assert!(
        text.contains("WholeExtent=\"0 4 0 2 0 1\" Origin=\"0 0 0\" Spacing=\"0.5 0.5 1\""),
        "{text}"
    );
    let start = text.find("Name=\"u\"").unwrap();
    let body = text[start..].split_once('>').unwrap().1.split_once('<').unwrap().0;
    let values: Vec<f64> = body.split_whitespace().map(|x| x.parse().unwrap()).collect();
    assert_eq!(values.len(), 30);
    for (n, value) in values.iter().enumerate() {
        let [i, j, k] = [n % 5, n / 5 % 3, n / 15].map(|x| x as f64);
        assert!((value - cubic([0.5 * i, 0.5 * j, k]).0).abs() < 1e-12);
    }
}

/// Every member of the family that holds cubics finds this one, on triangles, on quads that are
/// rectangles, and in tetrahedra.
#[test]
fn members_of_the_family() {
    let flat = ["dei", "adei", "dei3-13", "dei3-15", "pqi", "fqi"].map(|name| (name, 2));
    for (name, dimension) in flat.into_iter().chain([("p3", 3)]) {
        let (grid, pde) = if dimension == 2 { (square(), PLANE_PDE) } else { (bar(), PDE) };
        let bench = bench(&grid);
        let job = ["interpolate", "in.vtu", "-o", "out.vtu", "-a", "u", "--pde", pde];
        bench.succeed(&[&job[..], &["--subdivide", "3", "--family", name]].concat());
        let fine = read(&bench, "out.vtu");
        check(&points_of(&fine.points), &fine.point_data, dimension);
    }
    // a triquadratic has no unique polynomial in cells with an edge along an axis
    let bench = bench(&bar());
    for name in ["p2", "p2-hat"] {
        let job = ["interpolate", "in.vtu", "-o", "out.vtu", "-a", "u", "--pde", PDE];
        let said = bench.succeed(&[&job[..], &["--subdivide", "3", "--family", name]].concat());
        assert!(said.contains("12 triangles or tetrahedra could not use the PDE"), "{said}");
    }
}

/// Rectangles have a bicubic each, which fit together along sides; halved they do not.
#[test]
fn rectangles_have_bicubics() {
    let quads: [(u8, &[i64]); 4] =
        [(9, &[0, 1, 4, 3]), (8, &[1, 2, 4, 5]), (8, &[3, 4, 6, 7]), (9, &[5, 8, 7, 4])];
    let triangles = [[0, 1, 4], [0, 4, 3], [1, 2, 4], [2, 5, 4]];
    let triangles: Vec<(u8, &[i64])> = triangles.iter().map(|c| (5, &c[..])).collect();
    let jumps = [&quads[..], &triangles].map(|cells| {
        let mut grid = square_of(cells);
        let points = points_of(&grid.points);
        let harmonic = points.iter().map(|[x, y, _]| (3.0 * x).exp() * (3.0 * y).sin());
        grid.point_data.push(DataArray::new("u", 1, harmonic.collect::<Vec<f64>>()));
        let slope = |[x, y, _]: &[f64; 3]| {
            let size = 3.0 * (3.0 * x).exp();
            [size * (3.0 * y).sin(), size * (3.0 * y).cos(), 0.0]
        };
        let slopes: Vec<f64> = points.iter().flat_map(slope).collect();
        grid.point_data.push(DataArray::new("grad_u", 3, slopes));
        let bench = bench(&grid);
        // on both sides of a side of two cells, and of a diagonal
        let text = "0.4999999,0.2\n0.5000001,0.2\n0.1,0.1000001\n0.1000001,0.1\n";
        fs::write(bench.path("at.csv"), text).unwrap();
        let job = ["interpolate", "in.vtu", "-o", "out.vtp", "-a", "u", "--pde", "uxx + uyy = 0"];
        bench.succeed(&[&job[..], &["--at", "at.csv", "--family", "dei"]].concat());
        let file = VtpFile::open(bench.path("out.vtp")).unwrap();
        let values = numbers(&file.read(&Selection::All).unwrap().data.point_data, "u");
        [values[1] - values[0], values[3] - values[2]].map(f64::abs)
    });
    // slopes times the distance of the points
    assert!(jumps[0].iter().all(|jump| *jump < 1e-5), "{jumps:?}");
    // along an axis a bicubic is a cubic, which the ends determine
    assert!(jumps[1][0] < 1e-5 && jumps[1][1] > 1e-3, "{jumps:?}");
}

/// Points of discontinuous elements are one if that is asked for, as for contours.
#[test]
fn points_are_merged() {
    let apart = |cells: &[[f64; 6]]| {
        let points = cells.iter().flatten().copied().collect::<Vec<f64>>();
        let points = points.as_chunks::<2>().0.iter().flat_map(|[x, y]| [*x, *y, 0.0]);
        let points = DataArray::new("Points", 3, points.collect::<Vec<f64>>());
        let mut grid = UnstructuredGrid::new(points);
        for n in 0..cells.len() as i64 {
            grid.push_cell(5, &[3 * n, 3 * n + 1, 3 * n + 2]);
        }
        with_data(grid)
    };
    let bench = bench(&apart(&[[0.0, 0.0, 1.0, 0.0, 1.0, 1.0], [0.0, 0.0, 1.0, 1.0, 0.0, 1.0]]));
    let job = ["interpolate", "in.vtu", "-o", "out.vtu", "-a", "u", "--subdivide", "2"];
    for (more, points) in [(&[][..], 12), (&["--merge-points"][..], 9)] {
        bench.succeed(&[&job[..], more].concat());
        assert_eq!(points_of(&read(&bench, "out.vtu").points).len(), points);
    }
}

/// A domain with holes: what is outside is counted, the same for any number of threads.
#[test]
fn points_in_holes_are_counted() {
    let bench = Bench::new();
    let plate = sample("plate_with_holes.vtu");
    let run = |threads: &str, out: &str| {
        let job = ["interpolate", &plate, "-o", out, "--grid", "60,40", "--threads", threads];
        bench.succeed(&job)
    };
    let said = run("1", "one.vti");
    assert!(said.contains("points are outside the mesh: their values are NaN"), "{said}");
    assert_eq!(said, run("3", "three.vti"));
    assert_eq!(
        fs::read(bench.path("one.vti")).unwrap(),
        fs::read(bench.path("three.vti")).unwrap()
    );
}

#[test]
fn integers_outside_are_zero_and_masked() {
    let mut grid = square();
    grid.point_data.push(DataArray::new("number", 1, Values::I32(vec![7; 9])));
    let bench = bench(&grid);
    fs::write(bench.path("at.csv"), "0.5,0.5\n5,5\n").unwrap();
    bench.succeed(&["interpolate", "in.vtu", "-o", "out.vtp", "--at", "at.csv", "-a", "u"]);
    let found = VtpFile::open(bench.path("out.vtp")).unwrap().read(&Selection::All).unwrap().data;
    assert_eq!(numbers(&found.point_data, "number"), [7.0, 0.0]);
    assert_eq!(numbers(&found.point_data, "vtkValidPointMask"), [1.0, 0.0]);
}

#[test]
fn what_is_wrong_is_told() {
    let bench = bench(&square());
    fs::write(bench.path("bad.csv"), "x,y\n1,one\n").unwrap();
    let job = ["interpolate", "in.vtu", "-a", "u", "-o"];
    let fail = |code: i32, more: &[&str]| bench.fail(code, &[&job[..], more].concat());
    assert!(fail(2, &["out.vtu"]).contains("--at"));
    assert!(
        fail(2, &["out.vtu", "--subdivide", "2", "--tolerance", "1"]).contains("cannot be used")
    );
    assert!(fail(2, &["out.vti", "--grid", "0,3"]).contains("above zero"));
    assert!(fail(1, &["out.vtu", "--grid", "3,3"]).contains("must end in .vti"));
    assert!(fail(1, &["out.vtp", "--subdivide", "2"]).contains("a refined mesh is a .vtu"));
    assert!(fail(1, &["out.csv", "--at", "bad.csv"]).contains("'one' is no number"));
    assert!(fail(1, &["out.csv", "--at", "none.csv"]).contains("none.csv"));
    // a member of the family needs a PDE, its own kind of cells, and a given fineness
    let member = |name, more: &[&'static str]| [&["out.vtu", "--family", name][..], more].concat();
    assert!(fail(2, &member("dei", &["--subdivide", "2"])).contains("--pde"));
    let pde = ["--pde", PLANE_PDE, "--subdivide", "2"];
    let said = fail(1, &member("p3", &pde));
    assert!(said.contains("no interpolant 'p3' on two-dimensional cells: choose one of dei, adei"));
    assert!(fail(2, &member("cubic", &pde)).contains("[possible values: dei, adei"));
    let finer = ["--pde", PLANE_PDE, "--tolerance", "1e-3"];
    assert!(fail(2, &member("dei", &finer)).contains("cannot be used with"));
    assert!(!bench.path("out.vtu").exists() && !bench.path("out.csv").exists());
}
