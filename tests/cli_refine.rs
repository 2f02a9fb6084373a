//! The command line: refined meshes with their data, and a solver between the steps.

#[path = "support/program.rs"]
mod program;

use program::{Bench, square_of};
use vtu2contour::vtk::{Attributes, DataArray, Selection, UnstructuredGrid, VtuFile, write_vtu};

/// A cubic and its gradient.
fn cubic([x, y, z]: [f64; 3]) -> (f64, [f64; 3]) {
    let value = x * x * x - 2.0 * x * y + y * y + 3.0 * z * z * x;
    (value, [3.0 * x * x - 2.0 * y + 3.0 * z * z, 2.0 * y - 2.0 * x, 6.0 * z * x])
}

fn with_data(mut grid: UnstructuredGrid) -> UnstructuredGrid {
    let points = points_of(&grid);
    let values: Vec<f64> = points.iter().map(|p| cubic(*p).0).collect();
    let gradients: Vec<f64> = points.iter().flat_map(|p| cubic(*p).1).collect();
    let linear: Vec<f64> = points.iter().map(|p| 1.0 + 2.0 * p[0] - p[1]).collect();
    grid.point_data.push(DataArray::new("u", 1, values));
    grid.point_data.push(DataArray::new("grad_u", 3, gradients));
    grid.point_data.push(DataArray::new("linear", 1, linear));
    let cells = grid.types.len() as i64;
    grid.cell_data.push(DataArray::new("region", 1, (100..100 + cells).collect::<Vec<i64>>()));
    let eta: Vec<f64> = (0..cells).map(|cell| f64::from(u8::from(cell == 0))).collect();
    grid.cell_data.push(DataArray::new("eta", 1, eta));
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

/// Two hexahedra along x, of length 1 each, and a triangle on one.
fn bar() -> UnstructuredGrid {
    let points = (0..12).flat_map(|n| [n % 3, n / 3 % 2, n / 6]).map(f64::from);
    let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, points.collect::<Vec<f64>>()));
    for first in [0, 1] {
        let face = [first, first + 1, first + 4, first + 3];
        grid.push_cell(12, &[face, face.map(|corner| corner + 6)].concat());
    }
    grid.push_cell(5, &[0, 1, 4]);
    with_data(grid)
}

fn bench(grid: &UnstructuredGrid) -> Bench {
    let bench = Bench::new();
    write_vtu(bench.path("in.vtu"), grid, Default::default()).unwrap();
    bench
}

fn read(bench: &Bench, name: &str) -> UnstructuredGrid {
    VtuFile::open(bench.path(name)).unwrap().read(&Selection::All).unwrap().data
}

fn numbers(data: &Attributes, name: &str) -> Vec<f64> {
    data.get(name).unwrap_or_else(|| panic!("{name}")).to_f64().unwrap()
}

fn points_of(grid: &UnstructuredGrid) -> Vec<[f64; 3]> {
    grid.points.to_f64().unwrap().as_chunks::<3>().0.to_vec()
}

/// Values and gradients are the cubic's, other data linear or the parent's; new points are the
/// middles of their edges.
fn check(grid: &UnstructuredGrid, old: usize, dimension: usize) {
    let points = points_of(grid);
    let (u, gradients) = (numbers(&grid.point_data, "u"), numbers(&grid.point_data, "grad_u"));
    let (linear, edges) =
        (numbers(&grid.point_data, "linear"), numbers(&grid.point_data, "ParentEdge"));
    for (n, p) in points.iter().enumerate() {
        let (value, gradient) = cubic(*p);
        assert!((u[n] - value).abs() < 1e-12, "{p:?}: {} {value}", u[n]);
        assert!((linear[n] - (1.0 + 2.0 * p[0] - p[1])).abs() < 1e-12);
        for axis in 0..dimension {
            assert!((gradients[3 * n + axis] - gradient[axis]).abs() < 1e-10, "{p:?}");
        }
        let edge = [edges[2 * n], edges[2 * n + 1]];
        if n < old || edge[0] < 0.0 {
            assert_eq!(edge, [-1.0; 2]);
            continue;
        }
        let [a, b] = edge.map(|end| points[end as usize]);
        (0..3).for_each(|x| assert!((p[x] - 0.5 * (a[x] + b[x])).abs() < 1e-14, "{p:?}"));
    }
    let regions = numbers(&grid.cell_data, "region");
    let parents = numbers(&grid.cell_data, "OriginalCellIds");
    assert!(regions.iter().zip(parents).all(|(region, parent)| *region == 100.0 + parent));
}

const PDE: [&str; 2] = ["uxx + uyy = 6*x + 2", "uxx + uyy + uzz = 12*x + 2"];

#[test]
fn all_data_are_carried() {
    for (grid, dimension, steps) in
        [(square(), 2, "1"), (square(), 2, "3"), (bar(), 3, "1"), (bar(), 3, "2")]
    {
        let bench = bench(&grid);
        let pde = PDE[dimension - 2];
        let job = ["refine", "in.vtu", "-o", "out.vtu", "-a", "u", "--marks", "eta", "--pde", pde];
        let old = grid.points.tuples();
        let methods = ["bisect", "newest-vertex", "red-green", "centroid", "delaunay"];
        for method in methods.into_iter().take(if dimension == 2 { 5 } else { 1 }) {
            let said = bench.succeed(&[&job[..], &["--method", method, "--steps", steps]].concat());
            // the triangle cannot be kept beside tetrahedra that are divided
            assert_eq!(said.contains("not in the refined mesh"), dimension == 3, "{said}");
            let fine = read(&bench, "out.vtu");
            assert!(fine.points.tuples() > old, "{method}");
            check(&fine, old, dimension);
        }
    }
}

/// Points that are moved have the cubic's values where they are then.
#[test]
fn data_follow_points_that_are_moved() {
    let mut grid = square();
    // the middle elsewhere
    let mut points = grid.points.to_f64().unwrap();
    points[3 * 4] = 0.8;
    grid.points = DataArray::new("Points", 3, points);
    grid.point_data = Attributes::new();
    let bench = bench(&with_data(grid));
    for smoothing in ["laplacian", "optimised"] {
        let job = ["refine", "in.vtu", "-o", "out.vtu", "-a", "u", "--marks", "eta", "--smooth"];
        bench.succeed(&[&job[..], &[smoothing, "--pde", PDE[0]]].concat());
        let fine = read(&bench, "out.vtu");
        let middle = points_of(&fine)[4];
        assert!(middle != [0.8, 0.5, 0.0], "{middle:?}");
        let (u, linear) = (numbers(&fine.point_data, "u"), numbers(&fine.point_data, "linear"));
        for (n, p) in points_of(&fine).iter().enumerate() {
            assert!((u[n] - cubic(*p).0).abs() < 1e-12, "{n} {p:?}");
            assert!((linear[n] - (1.0 + 2.0 * p[0] - p[1])).abs() < 1e-12);
        }
    }
}

#[test]
fn a_bound_on_points_is_met() {
    let bench = bench(&square());
    let job = ["refine", "in.vtu", "-o", "out.vtu", "-a", "u", "--marks", "region"];
    bench.succeed(&[&job[..], &["--steps", "9", "--max-points", "57"]].concat());
    assert_eq!(read(&bench, "out.vtu").points.tuples(), 57);
    // by numbers: cell 0 alone is above twice the average, and of its two halves both are
    let said = bench.succeed(&[
        "refine",
        "in.vtu",
        "-o",
        "out.vtu",
        "-a",
        "u",
        "--by",
        "eta",
        "--verbose",
    ]);
    assert!(said.contains("step 1: 2 cells marked, 1 points added: 10 points, 10 cells"), "{said}");
}

/// What a method has to know goes along in the file, if it is that of the method.
#[test]
fn several_runs_are_as_several_steps() {
    let bench = bench(&square());
    for method in ["newest-vertex", "red-green"] {
        let refine = |from: &str, to: &str, steps: &str| {
            bench.succeed(&[
                "refine", from, "-o", to, "-a", "u", "--marks", "eta", "--method", method,
                "--steps", steps,
            ])
        };
        refine("in.vtu", "together.vtu", "2");
        refine("in.vtu", "one.vtu", "1");
        refine("one.vtu", "two.vtu", "1");
        let (together, two) = (read(&bench, "together.vtu"), read(&bench, "two.vtu"));
        assert_eq!((&together.points, &together.cells), (&two.points, &two.cells));
        assert!(two.cell_data.iter().any(|array| array.name.ends_with("State")));
    }
}

/// A mesh without point arrays has nothing to interpolate, and is refined all the same.
#[test]
fn a_mesh_alone() {
    let mut grid = square();
    grid.point_data = Attributes::new();
    let bench = bench(&grid);
    bench.succeed(&["refine", "in.vtu", "-o", "out.vtu", "--marks", "eta"]);
    let fine = read(&bench, "out.vtu");
    assert_eq!(fine.points.tuples(), 10);
    assert_eq!(fine.point_data.len(), 1);
}

/// New boundary points are on the curve that a file gives, with the cubic's values there.
#[test]
fn a_curved_boundary_is_met() {
    let on_circle = |n: i64, of: i64| {
        let angle = std::f64::consts::TAU * (n % of) as f64 / of as f64;
        [angle.cos(), angle.sin(), 0.0]
    };
    let points: Vec<f64> = (0..8).flat_map(|n| on_circle(n, 8)).chain([0.0; 3]).collect();
    let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, points));
    (0..8).for_each(|n| grid.push_cell(5, &[8, n, (n + 1) % 8]));
    let bench = bench(&with_data(grid));
    // half of the circle as one polyline, half as lines
    let points: Vec<f64> = (0..720).flat_map(|n| on_circle(n, 720)).collect();
    let mut circle = UnstructuredGrid::new(DataArray::new("Points", 3, points));
    circle.push_cell(4, &(0..=360).collect::<Vec<i64>>());
    (360..720).for_each(|n| circle.push_cell(3, &[n, (n + 1) % 720]));
    write_vtu(bench.path("circle.vtu"), &circle, Default::default()).unwrap();
    let job = ["refine", "in.vtu", "-o", "out.vtu", "-a", "u", "--marks", "region"];
    let job = [&job[..], &["--pde", PDE[0], "--boundary", "circle.vtu"]].concat();
    let delaunay = [&job[..], &["--method", "delaunay", "--steps", "3"]].concat();
    bench.succeed(&delaunay);
    let fine = read(&bench, "out.vtu");
    let (u, edges) = (numbers(&fine.point_data, "u"), numbers(&fine.point_data, "ParentEdge"));
    let mut on_curve = 0;
    for (n, p) in points_of(&fine).iter().enumerate() {
        assert!((u[n] - cubic(*p).0).abs() < 1e-10, "{p:?}: {}", u[n]);
        if n > 8 && edges[2 * n] >= 0.0 {
            let radius = p[0].hypot(p[1]);
            assert!((radius - 1.0).abs() < 1e-4, "{p:?}");
            on_curve += 1;
        }
    }
    assert!(on_curve >= 24, "{on_curve}");
    // only the hybrid moves sides of cells; and the curve must be this mesh's
    let said = bench.fail(1, &job);
    assert!(said.contains("--boundary is for triangles by --method delaunay"), "{said}");
    let circle_elsewhere: Vec<f64> =
        circle.points.to_f64().unwrap().iter().map(|x| x + 5.0).collect();
    circle.points = DataArray::new("Points", 3, circle_elsewhere);
    write_vtu(bench.path("circle.vtu"), &circle, Default::default()).unwrap();
    let said = bench.fail(1, &delaunay);
    assert!(
        said.contains("'in.vtu': no edge of the boundary or between regions lies on"),
        "{said}"
    );
    std::fs::copy(bench.path("in.vtu"), bench.path("circle.vtu")).unwrap();
    let said = bench.fail(1, &delaunay);
    assert!(said.contains("--boundary: 'circle.vtu': there are no lines"), "{said}");
}

#[test]
fn threads_do_not_matter() {
    for grid in [square(), bar()] {
        let bench = bench(&grid);
        for method in ["bisect", "newest-vertex", "red-green", "centroid", "delaunay"] {
            let with = |threads: &str| {
                bench.succeed(&[
                    "refine",
                    "in.vtu",
                    "-o",
                    "out.vtu",
                    "-a",
                    "u",
                    "--marks",
                    "region",
                    "--method",
                    method,
                    "--smooth",
                    "optimised",
                    "--steps",
                    "3",
                    "--threads",
                    threads,
                    "-q",
                ]);
                std::fs::read(bench.path("out.vtu")).unwrap()
            };
            let one = with("1");
            assert!(one == with("2") && one == with("5"), "{method}");
        }
    }
}

/// Meshes that cannot be refined: one line each, with the file, and no output.
#[test]
fn wrong_meshes_are_told() {
    let flat = |points: &[[f64; 2]], cells: &[[i64; 3]]| {
        let points = points.iter().flat_map(|p| [p[0], p[1], 0.0]).collect::<Vec<f64>>();
        let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, points));
        cells.iter().for_each(|cell| grid.push_cell(5, cell));
        grid.cell_data.push(DataArray::new("eta", 1, vec![1.0; cells.len()]));
        grid
    };
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let with = |more: &[[f64; 2]], cells: &[[i64; 3]]| flat(&[&square[..], more].concat(), cells);
    let mut bent = with(&[], &[[0, 1, 2], [0, 2, 3]]);
    let mut heights = bent.points.to_f64().unwrap();
    heights[5] = 0.5;
    bent.points = DataArray::new("Points", 3, heights);
    let cases = [
        (with(&[[f64::NAN, 0.0]], &[[0, 1, 2], [0, 2, 4]]), "bisect", "point 4 is not finite"),
        (
            with(&[[0.0, 0.0]], &[[0, 1, 2], [4, 2, 3]]),
            "delaunay",
            "points 0 and 4 are at the same place",
        ),
        (
            with(&[[0.5, -1.0], [0.5, 0.5], [2.0, 0.5]], &[[0, 1, 2], [4, 6, 5]]),
            "delaunay",
            "crosses another one",
        ),
        (
            with(&[[2.0, 1.0], [2.0, 2.0]], &[[0, 1, 2], [2, 4, 5]]),
            "delaunay",
            "touches itself at point 2",
        ),
        (with(&[], &[[0, 1, 2], [0, 2, 3], [0, 1, 2]]), "delaunay", "edge from point 0 to point"),
        (with(&[[3.0, 0.0]], &[[0, 1, 2], [0, 1, 4]]), "delaunay", "cell 1 has no area"),
        (bent, "delaunay", "does not lie in the plane of the others"),
    ];
    for (grid, method, expected) in cases {
        let bench = bench(&grid);
        let said = bench
            .fail(1, &["refine", "in.vtu", "-o", "out.vtu", "--marks", "eta", "--method", method]);
        assert!(said.contains("'in.vtu': ") && said.contains(expected), "{said}");
        assert_eq!(said.trim_end().lines().count(), 1, "{said}");
        assert!(!bench.path("out.vtu").exists());
        if method == "delaunay" {
            // what is only wrong for the triangulation can be bisected
            bench.succeed(&["refine", "in.vtu", "-o", "out.vtu", "--marks", "eta"]);
        }
    }
}

#[test]
fn a_solver_between_the_steps() {
    let bench = bench(&square());
    let job = ["refine", "in.vtu", "-o", "out.vtu", "-a", "u", "--by", "eta", "--steps", "3"];
    let with = |solver: &'static str| [&job[..], &["--solver", solver]].concat();
    bench.succeed(&with("cp {input} {output} && echo x >> runs"));
    assert_eq!(std::fs::read_to_string(bench.path("runs")).unwrap().lines().count(), 3);
    let whole = read(&bench, "out.vtu");
    assert!(whole.points.tuples() > 11);
    std::fs::remove_file(bench.path("out.vtu")).unwrap();
    // it fails: at once, there is no output; later, the last good mesh is kept
    let said = bench.fail(1, &with("exit 3"));
    assert!(said.contains("'exit 3' must") || said.contains("must name {input}"), "{said}");
    let said = bench.fail(1, &with("exit 3 # {input} {output}"));
    assert!(said.contains("failed (exit status: 3)"), "{said}");
    assert!(!bench.path("out.vtu").exists());
    let said = bench.fail(1, &with("test ! -e once && touch once && cp {input} {output}"));
    assert!(said.contains("failed") && said.contains("'out.vtu' has the mesh of step 1"), "{said}");
    assert_eq!(read(&bench, "out.vtu").points.tuples(), 10);
    let said = bench.fail(1, &with("true {input} {output}"));
    assert!(said.contains("did not write {output}"), "{said}");
    // it writes another mesh, or what is none
    let said = bench.fail(1, &with("cp in.vtu {output} # {input}"));
    assert!(said.contains("it was given 10 points"), "{said}");
    let said = bench.fail(1, &with("sed s/eta/ETA/ {input} > {output}"));
    assert!(said.contains("it did not write the cell array 'eta', and --by needs it"), "{said}");
    let said = bench.fail(1, &with("echo no > {output} # {input}"));
    assert!(said.contains("--solver: what it wrote"), "{said}");
}

#[test]
fn what_is_wrong_is_told() {
    let bench = bench(&square());
    let fail = |code: i32, more: &[&str]| {
        bench.fail(code, &[&["refine", "in.vtu", "-a", "u", "-o"][..], more].concat())
    };
    assert!(fail(2, &["out.vtu"]).contains("--marks"));
    assert!(fail(2, &["out.vtu", "--marks", "eta", "--by", "eta"]).contains("cannot be used"));
    assert!(fail(2, &["out.vtu", "--by", "eta", "--select", "most"]).contains("average:K"));
    assert!(fail(2, &["out.vtu", "--by", "eta", "--select", "bulk:2"]).contains("1 at most"));
    assert!(fail(1, &["out.vtp", "--marks", "eta"]).contains("a refined mesh is a .vtu"));
    let said = fail(1, &["out.vtu", "--marks", "none"]);
    assert!(said.contains("no cell array 'none'; the cell arrays are 'region', 'eta'"), "{said}");
    assert!(fail(1, &["out.vtu", "--by", "eta", "--steps", "2"]).contains("give --solver"));
    assert!(!bench.path("out.vtu").exists());
}
