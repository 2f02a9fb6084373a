//! The command line: monitors as cell arrays, and meshes refined by them.

#[path = "support/program.rs"]
mod program;

use program::{Bench, sample, square_of};
use vtu2contour::vtk::{DataArray, Selection, UnstructuredGrid, VtuFile, write_vtu};

/// What a test solution is at a point: its value and its gradient.
type Solution = fn([f64; 3]) -> (f64, [f64; 3]);

fn x_squared([x, _, _]: [f64; 3]) -> (f64, [f64; 3]) {
    (x * x, [2.0 * x, 0.0, 0.0])
}

/// A cubic: its Laplacian is 6 x + 2 in the plane, and 12 x + 2 in space.
fn cubic([x, y, z]: [f64; 3]) -> (f64, [f64; 3]) {
    let value = x * x * x - 2.0 * x * y + y * y + 3.0 * z * z * x;
    (value, [3.0 * x * x - 2.0 * y + 3.0 * z * z, 2.0 * y - 2.0 * x, 6.0 * z * x])
}

fn wave([x, y, z]: [f64; 3]) -> (f64, [f64; 3]) {
    let (sine, cosine) = (3.0 * x + 2.0 * y + z).sin_cos();
    (sine, [3.0 * cosine, 2.0 * cosine, cosine])
}

fn with_data(mut grid: UnstructuredGrid, solution: Solution) -> UnstructuredGrid {
    let points = grid.points.to_f64().unwrap().as_chunks::<3>().0.to_vec();
    let (values, gradients): (Vec<f64>, Vec<[f64; 3]>) = points.into_iter().map(solution).unzip();
    grid.point_data.push(DataArray::new("u", 1, values));
    grid.point_data.push(DataArray::new("grad_u", 3, gradients.concat()));
    grid.cell_data.push(DataArray::new(
        "number",
        1,
        (0..grid.types.len() as i64).collect::<Vec<_>>(),
    ));
    grid
}

const QUADS: [(u8, &[i64]); 4] =
    [(9, &[0, 1, 4, 3]), (9, &[1, 2, 5, 4]), (9, &[3, 4, 7, 6]), (9, &[4, 5, 8, 7])];

/// The triangles that the quads are cut into, two by two.
const TRIANGLES: [(u8, &[i64]); 8] = [
    (5, &[0, 1, 4]),
    (5, &[0, 4, 3]),
    (5, &[1, 2, 5]),
    (5, &[1, 5, 4]),
    (5, &[3, 4, 7]),
    (5, &[3, 7, 6]),
    (5, &[4, 5, 8]),
    (5, &[4, 8, 7]),
];

/// Two unit cubes side by side, and a triangle on one.
fn bar() -> UnstructuredGrid {
    let points = (0..12).flat_map(|n| [n % 3, n / 3 % 2, n / 6]).map(f64::from);
    let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, points.collect::<Vec<f64>>()));
    for first in [0, 1] {
        let face = [first, first + 1, first + 4, first + 3];
        grid.push_cell(12, &[face, face.map(|corner| corner + 6)].concat());
    }
    grid.push_cell(5, &[0, 1, 4]);
    grid
}

fn bench(grid: &UnstructuredGrid) -> Bench {
    let bench = Bench::new();
    write_vtu(bench.path("in.vtu"), grid, Default::default()).unwrap();
    bench
}

fn read(bench: &Bench, name: &str) -> UnstructuredGrid {
    VtuFile::open(bench.path(name)).unwrap().read(&Selection::All).unwrap().data
}

fn cell_numbers(grid: &UnstructuredGrid, name: &str) -> Vec<f64> {
    grid.cell_data.get(name).unwrap_or_else(|| panic!("{name}")).to_f64().unwrap()
}

/// The cell array of a monitor of `in.vtu`.
fn monitored(bench: &Bench, more: &[&str]) -> Vec<f64> {
    let job = ["monitor", "in.vtu", "-o", "out.vtu", "-a", "u", "--name", "eta", "-m"];
    bench.succeed(&[&job[..], more].concat());
    cell_numbers(&read(bench, "out.vtu"), "eta")
}

#[track_caller]
fn close(found: &[f64], expected: &[f64], within: f64) {
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= within || a.is_nan() && b.is_nan(), "{found:?} {expected:?}");
    }
}

#[test]
fn defect_and_area_by_hand() {
    // the cubic of a right-angled triangle is x² - h² 6 λ₀ λ₁ λ₂ / 8, which satisfies this PDE at
    // the centroid, so the defect is |1/2 - 3/2 λ₀|: at the nine points 8/27 on average, over a
    // quarter of the unit square
    let flat = bench(&with_data(square_of(&QUADS), x_squared));
    let pde = "uxx + uyy = 3";
    close(&monitored(&flat, &["defect", "--pde", pde]), &[0.25 * 8.0 / 27.0; 4], 1e-12);
    close(&monitored(&flat, &["defect", "--pde", "uxx + uyy = 2"]), &[0.0; 4], 1e-12);
    // the triangle is not judged beside solids
    let solid = bench(&with_data(bar(), x_squared));
    let pde = "uxx + uyy + uzz = 2";
    close(&monitored(&solid, &["defect", "--pde", pde]), &[0.0, 0.0, f64::NAN], 1e-12);
    // four coefficients meet any linear right-hand side, and no wave
    let pde = "uxx + uyy + uzz = 3*sin(9*x)";
    assert!(monitored(&solid, &["defect", "--pde", pde])[..2].iter().all(|number| *number > 0.01));
    // where u does not change along y and z, the graph's area is that of a curve: between
    // lines with the least and the greatest slope
    let areas = monitored(&solid, &["area"]);
    assert!(areas[0] > 1.0 && areas[0] < 5.0_f64.sqrt(), "{areas:?}");
    assert!(areas[1] > 5.0_f64.sqrt() && areas[1] < 17.0_f64.sqrt(), "{areas:?}");
}

/// Of a cubic that solves the PDE all interpolants are the cubic itself, also those on halved
/// edges.
#[test]
fn cubics_have_no_error() {
    let pde = ["uxx + uyy = 6*x + 2", "uxx + uyy + uzz = 12*x + 2"];
    let grids = [square_of(&TRIANGLES), bar()];
    let waves = [square_of(&TRIANGLES), bar()].map(|grid| bench(&with_data(grid, wave)));
    for ((grid, pde), waves) in grids.into_iter().zip(pde).zip(waves) {
        let bench = bench(&with_data(grid, cubic));
        for name in ["stepwise", "interpolation"] {
            let none = |numbers: Vec<f64>, least: f64| {
                let judged = numbers.iter().filter(|number| !number.is_nan());
                judged.fold(0.0, |most: f64, number| most.max(*number)) < least
            };
            assert!(none(monitored(&bench, &[name, "--pde", pde]), 1e-12), "{name} {pde}");
            // what is no cubic has one
            assert!(!none(monitored(&waves, &[name, "--pde", pde]), 1e-3), "{name} {pde}");
        }
    }
}

/// A cell that was cut has the sum of its parts, or their mean by size.
#[test]
fn cells_of_parts() {
    let (quads, triangles) = (square_of(&QUADS), square_of(&TRIANGLES));
    let [quads, triangles] = [quads, triangles].map(|grid| bench(&with_data(grid, wave)));
    let pde = "uxx + uyy = -13*u";
    for (name, share) in [("defect", 1.0), ("area", 1.0), ("stepwise", 0.5), ("interpolation", 0.5)]
    {
        let parts = monitored(&triangles, &[name, "--pde", pde]);
        let joined: Vec<f64> = parts.chunks(2).map(|pair| share * (pair[0] + pair[1])).collect();
        close(&monitored(&quads, &[name, "--pde", pde]), &joined, 1e-12);
    }
}

#[test]
fn second_interpolants() {
    let bench = bench(&with_data(square_of(&TRIANGLES), wave));
    let with = |second: &str| {
        monitored(&bench, &["interpolation", "--second", second, "--pde", "uxx + uyy = -13*u"])
    };
    let all = ["pqi", "fqi", "quadratic-precision", "linear"].map(with);
    for (n, one) in all.iter().enumerate() {
        assert!(one.iter().all(|number| *number > 0.0), "{all:?}");
        assert!(all[..n].iter().all(|other| other != one), "{all:?}");
    }
    // with a PDE it is the full quartic, without one it must need none
    assert_eq!(monitored(&bench, &["interpolation", "--pde", "uxx + uyy = -13*u"]), all[1]);
    assert!(monitored(&bench, &["interpolation"]).iter().all(|number| *number > 0.0));
}

#[test]
fn marks_and_the_summary() {
    let bench = bench(&with_data(square_of(&TRIANGLES), wave));
    let job = ["monitor", "in.vtu", "-o", "out.vtu", "-a", "u", "-m", "defect", "--verbose"];
    let pde = ["--pde", "uxx + uyy = -13*u", "--select", "fraction:0.25", "--stats", "stats.json"];
    let said = bench.succeed(&[&job[..], &pde].concat());
    let grid = read(&bench, "out.vtu");
    let numbers = cell_numbers(&grid, "DefectMonitor");
    let marks = cell_numbers(&grid, "DefectMonitorMarks");
    assert_eq!(marks.iter().sum::<f64>(), 2.0);
    let least = marks.iter().zip(&numbers).filter(|(mark, _)| **mark == 1.0).map(|(_, x)| *x);
    let least = least.fold(f64::INFINITY, f64::min);
    assert_eq!(numbers.iter().filter(|number| **number >= least).count(), 2);
    // all data are still there
    assert_eq!(cell_numbers(&grid, "number"), (0..8).map(f64::from).collect::<Vec<f64>>());
    assert!(grid.point_data.get("grad_u").is_some());
    let stats: serde_json::Value =
        serde_json::from_slice(&std::fs::read(bench.path("stats.json")).unwrap()).unwrap();
    assert_eq!((&stats["cells"], &stats["not_judged"]), (&8.into(), &0.into()));
    assert_eq!((&stats["selected"], &stats["name"]), (&2.into(), &"DefectMonitor".into()));
    let sum: f64 = numbers.iter().sum();
    assert!((stats["sum"].as_f64().unwrap() - sum).abs() < 1e-12);
    assert!((stats["mean"].as_f64().unwrap() - sum / 8.0).abs() < 1e-12);
    let largest = numbers.iter().copied().fold(0.0, f64::max);
    assert_eq!(stats["largest"].as_f64(), Some(largest));
    assert!(said.contains("8 cells") && said.contains("2 selected"), "{said}");
}

#[test]
fn the_same_bytes_for_one_thread_and_two() {
    let bench = Bench::new();
    let input = sample("problem4.vtu");
    for monitor in ["defect", "area", "stepwise", "interpolation"] {
        for samples in ["fixed", "random:7:12"] {
            let of = |threads: &str| {
                bench.succeed(&[
                    "monitor",
                    &input,
                    "-o",
                    "out.vtu",
                    "-m",
                    monitor,
                    "--samples",
                    samples,
                    "--pde",
                    "uxx + uyy = laplacian",
                    "--select",
                    "bulk:0.5",
                    "--threads",
                    threads,
                ]);
                std::fs::read(bench.path("out.vtu")).unwrap()
            };
            assert_eq!(of("1"), of("2"), "{monitor} {samples}");
        }
    }
    let refined = |threads: &str| {
        bench.succeed(&[
            "refine",
            &input,
            "-o",
            "out.vtu",
            "-m",
            "defect",
            "--pde",
            "uxx + uyy = laplacian",
            "--max-points",
            "700",
            "--threads",
            threads,
        ]);
        std::fs::read(bench.path("out.vtu")).unwrap()
    };
    assert_eq!(refined("1"), refined("2"));
}

#[test]
fn a_mesh_refined_by_a_monitor_has_just_so_many_points() {
    let bench = Bench::new();
    let input = sample("problem4.vtu");
    for method in ["bisect", "centroid", "delaunay"] {
        for monitor in ["defect", "interpolation"] {
            let said = bench.succeed(&[
                "refine",
                &input,
                "-o",
                "out.vtu",
                "-m",
                monitor,
                "--pde",
                "uxx + uyy = laplacian",
                "--max-points",
                "901",
                "--method",
                method,
                "--verbose",
            ]);
            assert_eq!(read(&bench, "out.vtu").points.tuples(), 901, "{method} {monitor}");
            assert!(said.contains("step 2: "), "{said}");
        }
    }
    // so many steps and no more
    let job = ["refine", &input, "-o", "out.vtu", "-m", "area", "--steps", "2", "--verbose"];
    let said = bench.succeed(&job);
    assert!(said.contains("step 2: ") && !said.contains("step 3: "), "{said}");
}

/// One step by a monitor is one by its array.
#[test]
fn a_step_is_as_by_the_array() {
    let bench = Bench::new();
    let input = sample("problem4.vtu");
    let choice = ["-m", "defect", "--pde", "uxx + uyy = laplacian"];
    bench.succeed(
        &[&["refine", &input, "-o", "one.vtu", "--select", "bulk:0.3"][..], &choice].concat(),
    );
    bench.succeed(&[&["monitor", &input, "-o", "judged.vtu"][..], &choice].concat());
    let by = ["--by", "DefectMonitor", "--select", "bulk:0.3", "--pde", "uxx + uyy = laplacian"];
    bench.succeed(&[&["refine", "judged.vtu", "-o", "other.vtu"][..], &by].concat());
    let (one, other) = (read(&bench, "one.vtu"), read(&bench, "other.vtu"));
    assert!(one.points.tuples() > 404);
    assert_eq!((one.points, one.cells), (other.points, other.cells));
}

/// In space too, step after step: the marks of bisection are kept, and the cubics of cells with
/// three sides at right angles, of which the Laplacian says nothing, stay near the solution.
#[test]
fn tetrahedra_are_refined_by_a_monitor() {
    let bench = Bench::new();
    let pde = "uxx + uyy + uzz = 6*x*(y^3 - y^2)*(z^2 + 1) + (x^3 - x)*(6*y - 2)*(z^2 + 1) \
               + 2*(x^3 - x)*(y^3 - y^2)";
    let said = bench.succeed(&[
        "refine",
        &sample("problem6.vtu"),
        "-o",
        "out.vtu",
        "-m",
        "defect",
        "--pde",
        pde,
        "--max-points",
        "800",
    ]);
    assert_eq!(said, "");
    let grid = read(&bench, "out.vtu");
    let points = grid.points.to_f64().unwrap();
    assert!((780..=800).contains(&(points.len() / 3)), "{}", points.len() / 3);
    let numbers = |name: &str| grid.point_data.get(name).unwrap().to_f64().unwrap();
    let (u, gradients) = (numbers("u"), numbers("gradient"));
    for (n, &[x, y, z]) in points.as_chunks::<3>().0.iter().enumerate() {
        let [p, q, r] = [x * x * x - x, y * y * y - y * y, z * z + 1.0];
        assert!((u[n] - p * q * r).abs() < 2e-3, "{n}");
        let exact = [(3.0 * x * x - 1.0) * q * r, p * (3.0 * y * y - 2.0 * y) * r, p * q * 2.0 * z];
        for (found, exact) in gradients[3 * n..].iter().zip(exact) {
            assert!((found - exact).abs() < 0.1, "{n}: {found} {exact}");
        }
    }
}

#[test]
fn cells_that_cannot_be_judged_are_counted() {
    let mut grid = with_data(square_of(&TRIANGLES), wave);
    let mut values = grid.point_data.get("u").unwrap().to_f64().unwrap();
    values[2] = f64::NAN;
    grid.point_data.push(DataArray::new("u", 1, values));
    let spoiled = bench(&grid);
    let job = ["monitor", "in.vtu", "-o", "out.vtu", "-a", "u", "-g", "grad_u", "-m"];
    for name in ["defect", "stepwise", "interpolation", "area"] {
        let pde = ["--pde", "uxx + uyy = -13*u", "--select", "fraction:1", "--name", "eta"];
        let said = spoiled.succeed(&[&job[..], &[name], &pde].concat());
        assert!(said.contains("1 of 8 cells could not be judged"), "{name} {said}");
        let grid = read(&spoiled, "out.vtu");
        let (numbers, marks) = (cell_numbers(&grid, "eta"), cell_numbers(&grid, "etaMarks"));
        for (cell, (number, mark)) in numbers.iter().zip(marks).enumerate() {
            // the corner 2 is one of cell 2 alone
            assert_eq!((number.is_nan(), mark), (cell == 2, f64::from(cell != 2)), "{name}");
        }
    }
}

#[test]
fn what_is_wrong_is_told() {
    let good = bench(&with_data(square_of(&TRIANGLES), wave));
    let fail = |code: i32, more: &[&str]| {
        let said = good.fail(code, &[&["monitor", "in.vtu", "-a", "u", "-o"][..], more].concat());
        assert!(!good.path("out.vtu").exists() && !good.path("stats.json").exists(), "{more:?}");
        said
    };
    assert!(fail(2, &["out.vtu"]).contains("--monitor"));
    assert!(fail(2, &["out.vtu", "-m", "defects"]).contains("[possible values: defect, area"));
    assert!(fail(2, &["out.vtu", "-m", "area", "--samples", "some"]).contains("random:SEED:N"));
    assert!(fail(2, &["out.vtu", "-m", "area", "--samples", "0"]).contains("above 0"));
    assert!(fail(2, &["out.vtu", "-m", "area", "--select", "above:1"]).contains("tolerance:V"));
    let said = fail(1, &["out.vtu", "-m", "defect", "--stats", "stats.json"]);
    assert!(said.contains("the PDE: give --pde EQUATION, such as"), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
    assert!(fail(1, &["out.vtp", "-m", "area"]).contains("a grid with a monitor is a .vtu"));
    let fqi = ["out.vtu", "-m", "interpolation", "--second", "fqi"];
    assert!(fail(1, &fqi).contains("'fqi' needs the PDE"));
    let p3 = ["out.vtu", "-m", "interpolation", "--second", "p3", "--pde", "uxx + uyy = 0"];
    assert!(fail(1, &p3).contains("no interpolant 'p3' on two-dimensional cells"));
    let linear = ["out.vtu", "-m", "stepwise", "--interpolant", "linear"];
    assert!(fail(1, &linear).contains("choose the monitor 'area'"));
    let itself = ["quadratic-precision"; 2];
    let itself =
        ["out.vtu", "-m", "interpolation", "--interpolant", itself[0], "--second", itself[1]];
    assert!(fail(1, &itself).contains("is the interpolant itself"));
    let missing = ["monitor", "in.vtu", "-a", "v", "-o", "out.vtu", "-m", "area"];
    assert!(good.fail(1, &missing).contains("no point array 'v'; the point arrays are 'u'"));
    // the same of refine, where a defect needs a PDE too, and a grid without data has no monitor
    let refine = ["refine", "in.vtu", "-a", "u", "-o", "out.vtu", "-m", "defect"];
    assert!(good.fail(1, &refine).contains("give --pde EQUATION"));
    let mut bare = square_of(&TRIANGLES);
    write_vtu(good.path("bare.vtu"), &bare, Default::default()).unwrap();
    for job in ["monitor", "refine"] {
        let said = good.fail(1, &[job, "bare.vtu", "-o", "out.vtu", "-m", "area"]);
        assert!(said.contains("there are no point arrays"), "{said}");
    }
    // nothing but NaN, and no cells
    bare.point_data.push(DataArray::new("u", 1, vec![f64::NAN; 9]));
    write_vtu(good.path("nan.vtu"), &bare, Default::default()).unwrap();
    let said = good.fail(1, &["monitor", "nan.vtu", "-o", "out.vtu", "-m", "area"]);
    assert!(said.contains("no cell holds a finite value of 'u'"), "{said}");
    let empty = with_data(square_of(&[]), wave);
    write_vtu(good.path("empty.vtu"), &empty, Default::default()).unwrap();
    let said = good.fail(1, &["monitor", "empty.vtu", "-a", "u", "-o", "out.vtu", "-m", "area"]);
    assert!(said.contains("the grid has no cells"), "{said}");
    assert!(!good.path("out.vtu").exists());
}
