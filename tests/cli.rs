//! The command line: what it writes, what it says, how it ends.

#[path = "support/program.rs"]
mod program;

use program::{Bench, read_lines, sample, square_of, u};
use vtu2contour::vtk::{DataArray, Selection, UnstructuredGrid, Values, VtuFile, write_vtu};

#[test]
fn lines_follow_the_conventions_of_vtk() {
    let bench = Bench::new();
    let input = sample("problem4.vtu");
    bench.succeed(&[
        &input,
        "-o",
        "out.vtp",
        "-v",
        "0.3,0.9",
        "-v",
        "1.5",
        "--gradients",
        "--normals",
    ]);
    let lines = read_lines(&bench.path("out.vtp"));
    let values = lines.point_data.get("u").unwrap().to_f64().unwrap();
    assert!(values.iter().all(|v| [0.3, 0.9, 1.5].contains(v)));
    let active = lines.point_data.active(vtu2contour::vtk::AttributeKind::Scalars);
    assert_eq!(active.unwrap().name, "u");
    for name in ["gradient", "laplacian", "OriginalCellIds", "Gradients", "Normals"] {
        assert!(lines.point_data.get(name).is_some(), "no {name}");
    }
    // cell data are the parents' own
    let grid = VtuFile::open(&input).unwrap().read(&Selection::All).unwrap().data;
    let parents = lines.cell_data.get("OriginalCellIds").unwrap().to_f64().unwrap();
    for name in ["area", "region"] {
        let theirs = grid.cell_data.get(name).unwrap().to_f64().unwrap();
        let ours = lines.cell_data.get(name).unwrap().to_f64().unwrap();
        assert_eq!(ours.len(), lines.lines.len());
        assert!(ours.iter().zip(&parents).all(|(value, &cell)| *value == theirs[cell as usize]));
    }
    assert_eq!(lines.field_data.get("TimeValue"), grid.field_data.get("TimeValue"));
    // closed lines return to their first point
    let closed = lines.lines.iter().filter(|line| line.first() == line.last()).count();
    assert!(closed > 0);
}

#[test]
fn segments_have_the_data_of_their_own_cells() {
    let bench = Bench::new();
    let input = sample("problem4.vtu");
    bench.succeed(&[&input, "-o", "lines.vtp", "-v", "0.9"]);
    bench.succeed(&[&input, "-o", "segments.vtp", "-v", "0.9", "--segments"]);
    let (lines, segments) =
        (read_lines(&bench.path("lines.vtp")), read_lines(&bench.path("segments.vtp")));
    let count: usize = lines.lines.iter().map(|line| line.len() - 1).sum();
    assert_eq!(segments.lines.len(), count);
    assert!(segments.lines.iter().all(|segment| segment.len() == 2));
    let grid = VtuFile::open(&input).unwrap().read(&Selection::All).unwrap().data;
    let points = segments.points.to_f64().unwrap();
    let corners = grid.points.to_f64().unwrap();
    let parents = segments.cell_data.get("OriginalCellIds").unwrap().to_f64().unwrap();
    for (segment, parent) in segments.lines.iter().zip(parents) {
        let middle = [0, 1].map(|n| {
            segment.iter().map(|&point| points[3 * point as usize + n]).sum::<f64>() / 2.0
        });
        let cell = grid.cells.get(parent as usize).unwrap();
        let corner = |n: usize| [0, 1].map(|axis| corners[3 * cell[n] as usize + axis]);
        assert!(is_inside(middle, [corner(0), corner(1), corner(2)]));
    }
}

/// Whether a point lies in a triangle, give or take rounding.
fn is_inside(p: [f64; 2], corners: [[f64; 2]; 3]) -> bool {
    let side =
        |a: [f64; 2], b: [f64; 2]| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    let [a, b, c] = corners;
    let sides = [side(a, b), side(b, c), side(c, a)];
    sides.iter().all(|s| *s > -1e-6) || sides.iter().all(|s| *s < 1e-6)
}

#[test]
fn precision_follows_the_input_or_the_option() {
    let bench = Bench::new();
    let single = sample("no_gradient.vtu");
    let is_single =
        |name: &str| matches!(read_lines(&bench.path(name)).points.values, Values::F32(_));
    bench.succeed(&[&single, "-o", "as_input.vtp"]);
    bench.succeed(&[&single, "-o", "double.vtp", "--double"]);
    bench.succeed(&[&sample("problem4.vtu"), "-o", "single.vtp", "--single"]);
    assert!(is_single("as_input.vtp") && !is_single("double.vtp") && is_single("single.vtp"));
}

#[test]
fn threads_do_not_change_the_bytes() {
    let bench = Bench::new();
    let input = sample("islands.vtu");
    for (name, threads) in [("one.vtp", "1"), ("two.vtp", "2"), ("seven.vtp", "7")] {
        bench.succeed(&[&input, "-o", name, "-n", "21", "--threads", threads]);
    }
    let bytes = |name: &str| std::fs::read(bench.path(name)).unwrap();
    assert_eq!(bytes("one.vtp"), bytes("two.vtp"));
    assert_eq!(bytes("one.vtp"), bytes("seven.vtp"));
}

#[test]
fn every_encoding_holds_the_same_lines() {
    let bench = Bench::new();
    let input = sample("problem4.vtu");
    bench.succeed(&[&input, "-o", "raw.vtp"]);
    let raw = read_lines(&bench.path("raw.vtp"));
    for encoding in ["zlib", "lz4", "base64", "ascii"] {
        bench.succeed(&[&input, "-o", "other.vtp", "--encoding", encoding]);
        assert_eq!(read_lines(&bench.path("other.vtp")), raw, "{encoding}");
    }
}

#[test]
fn pictures_hold_one_path_a_line() {
    let bench = Bench::new();
    let input = sample("islands.vtu");
    bench.succeed(&[&input, "-o", "out.vtp", "-n", "5"]);
    bench.succeed(&[&input, "-o", "out.svg", "-n", "5"]);
    let lines = read_lines(&bench.path("out.vtp")).lines.len();
    let picture = std::fs::read_to_string(bench.path("out.svg")).unwrap();
    assert_eq!(picture.matches("\n<path d=").count(), lines);
    assert!(picture.len() < 100_000, "{} bytes", picture.len());
}

#[test]
fn stats_are_json() {
    let bench = Bench::new();
    bench.succeed(&[&sample("problem4.vtu"), "-o", "out.vtp", "--stats", "stats.json"]);
    let text = std::fs::read_to_string(bench.path("stats.json")).unwrap();
    let stats: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(stats["cells"]["triangles"], 734);
    assert_eq!(stats["cells"]["unresolved"], 0);
    assert_eq!(stats["gradient"], "gradient");
    assert_eq!(stats["levels"].as_array().unwrap().len(), 10);
    assert!(stats["seconds"]["contour"].as_f64().unwrap() > 0.0);
}

#[test]
fn info_tells_what_would_be_contoured() {
    let bench = Bench::new();
    let output = bench.run(&["info", &sample("problem4.vtu")]);
    let text = String::from_utf8(output.stdout).unwrap();
    for part in ["404 points, 734 cells (734 triangles)", "active Scalars", "gradient  gradient"] {
        assert!(text.contains(part), "no {part:?} in {text}");
    }
    // a file without anything to contour is still described
    bench.write_grid(vec![], vec![DataArray::new("c", 1, vec![1.0; 8])]);
    let output = bench.run(&["info", "in.vtu"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && text.contains("no point arrays to contour"), "{text}");
}

#[test]
fn help_teaches() {
    let bench = Bench::new();
    for arguments in [vec!["--help"], vec!["contour", "--help"]] {
        let output = bench.run(&arguments);
        assert!(output.status.success());
        let text = String::from_utf8(output.stdout).unwrap();
        for option in ["--array", "--gradient", "--pde", "--tolerance", "--range", "--stats"] {
            assert!(text.contains(option), "no {option} in {arguments:?}");
        }
    }
    let text = String::from_utf8(bench.run(&["--help"]).stdout).unwrap();
    for example in ["Examples:", "--param k=20", "run.pvd -o lines.pvd", "--time last"] {
        assert!(text.contains(example), "no {example} in the help");
    }
}

#[test]
fn a_wrong_gradient_is_not_used_in_silence() {
    let bench = Bench::new();
    let wrong = DataArray::new("gradient", 3, vec![7.0; 27]);
    bench.write_grid(vec![u(), wrong], vec![]);
    let said = bench.succeed(&["in.vtu", "-o", "out.vtp", "-a", "u"]);
    assert!(said.contains("'gradient' is not used as the gradient of 'u'"), "{said}");
    std::fs::remove_file(bench.path("out.vtp")).unwrap();
    let said = bench.succeed(&["in.vtu", "-o", "out.vtp", "-a", "u", "-g", "gradient"]);
    assert!(said.contains("does not look like the gradient"), "{said}");
}

#[test]
fn warnings_where_users_of_vtk_expect_output() {
    let bench = Bench::new();
    let mut values: Vec<f64> = (0..9).map(|n| f64::from(n % 3)).collect();
    bench.write_grid(vec![u()], vec![]);
    let said = bench.succeed(&["in.vtu", "-o", "out.vtp", "-v", "5,-1,1.5"]);
    assert!(
        said.contains("no contour at -1.0, 5.0: outside the range 0.0 to 2.0 of 'u'"),
        "{said}"
    );
    assert_eq!(read_lines(&bench.path("out.vtp")).lines.len(), 1);
    assert_eq!(bench.succeed(&["in.vtu", "-o", "out.vtp", "-v", "5", "-q"]), "");
    assert_eq!(read_lines(&bench.path("out.vtp")).lines.len(), 0);
    values[8] = f64::NAN;
    bench.write_grid(vec![DataArray::new("u", 1, values)], vec![]);
    let said = bench.succeed(&["in.vtu", "-o", "out.vtp", "-v", "0.5"]);
    assert!(said.contains("left out: 2 triangles with values that are not finite"), "{said}");
    bench.write_grid(vec![u()], vec![]);
    let said = bench.succeed(&["in.vtu", "-o", "out.vtp", "--pde", "uxx - uyy = 0"]);
    assert!(said.contains("the PDE does not determine the cubic in 8 of 8 cells"), "{said}");
    bench.write_grid(vec![DataArray::new("u", 1, vec![2.0; 9])], vec![]);
    let said = bench.succeed(&["in.vtu", "-o", "out.vtp"]);
    assert!(said.contains("'u' is 2.0 at all points"), "{said}");
}

#[test]
fn bad_input_is_one_clear_line() {
    let bench = Bench::new();
    let cases: [(&[&str], &str); 14] = [
        (&["no.vtu", "-o", "out.vtp"], "cannot read 'no.vtu'"),
        (
            &["in.vtu", "-o", "out.vtp", "-a", "w"],
            "no point array 'w'; the point arrays are 'u', 'v', 'text'",
        ),
        (&["in.vtu", "-o", "out.vtp", "-a", "c"], "array 'c' belongs to the cells"),
        (&["in.vtu", "-o", "out.vtp", "-a", "text"], "holds text, not numbers"),
        (&["in.vtu", "-o", "out.vtp", "-a", "v"], "choose one with --component 0..2"),
        (&["in.vtu", "-o", "out.vtp", "-a", "v", "--component", "3"], "has no component 3"),
        (&["in.vtu", "-o", "out.vtp", "-g", "none"], "no point array 'none'"),
        (&["in.vtu", "-o", "out.vtp", "-g", "two"], "no point array 'two'"),
        (&["in.vtu", "-o", "out.vtp", "--pde", "uxx + = 1"], "--pde: character 7"),
        (&["in.vtu", "-o", "out.vtp", "--pde", "uxx = w"], "w"),
        (&["in.vtu", "-o", "out.vtp", "--tolerance", "1e-30"], "too small"),
        (&["in.vtu", "-o", "out.txt"], "must end in .vtp or .vtu (lines), .svg (a picture), .pvtp"),
        (
            &["in.vtu", "-o", "nowhere/out.vtp"],
            "cannot write 'nowhere/out.vtp': there is no folder 'nowhere': make it first\n",
        ),
        (&["in.vtu", "-o", "out.vtp", "--time", "first"], "'in.vtu' is no series (.pvd)"),
    ];
    let text = ["a"; 9].map(String::from).to_vec();
    let vector = DataArray::new("v", 3, vec![1.0; 27]);
    let arrays = vec![u(), vector, DataArray::new("text", 1, text)];
    bench.write_grid(arrays, vec![DataArray::new("c", 1, vec![1.0; 8])]);
    for (arguments, expected) in cases {
        let said = bench.fail(1, arguments);
        assert!(said.contains(expected), "{arguments:?} said {said}");
        let first = said.lines().next().unwrap();
        assert!(first.starts_with("vtu2contour: error: "), "{said}");
        let lines = if expected.starts_with("--pde") || expected == "w" { 3 } else { 1 };
        assert_eq!(said.lines().count(), lines, "{said}");
    }
}

/// Quadratic and Bézier cells are cut at their mid nodes, with gradients of their own.
#[test]
fn quadratic_cells_are_contoured_exactly() {
    let bench = Bench::new();
    let nodes: [i64; 9] = [0, 2, 8, 6, 1, 5, 7, 3, 4];
    let square = |x: i64| f64::from(x as i32 * x as i32);
    // of x^2 + y^2: values at the nodes, and Bézier's control values
    let lagrange = |n: i64| square(n % 3) / 4.0 + square(n / 3) / 4.0;
    let bezier = |n: i64| f64::from(u8::from(n % 3 == 2)) + f64::from(u8::from(n / 3 == 2));
    let values: [(u8, &dyn Fn(i64) -> f64); 3] = [(28, &lagrange), (70, &lagrange), (77, &bezier)];
    for (cell_type, value) in values {
        let mut grid = square_of(&[(cell_type, &nodes)]);
        grid.point_data.push(DataArray::new("u", 1, (0..9).map(value).collect::<Vec<f64>>()));
        write_vtu(bench.path("in.vtu"), &grid, Default::default()).unwrap();
        let info = bench.run(&["info", "in.vtu"]);
        let info = String::from_utf8(info.stdout).unwrap();
        assert!(info.contains("gradient  of the quadratic cells\n"), "{info}");
        assert!(info.contains("cells     8 triangles"), "{info}");
        bench.succeed(&["in.vtu", "-o", "out.vtp", "-v", "0.5", "--stats", "stats.json"]);
        let stats = std::fs::read_to_string(bench.path("stats.json")).unwrap();
        assert!(stats.contains("\"gradient_origin\": \"cells\""), "{stats}");
        let lines = read_lines(&bench.path("out.vtp"));
        let points = lines.points.to_f64().unwrap();
        assert!(points.len() > 30);
        for point in points.chunks_exact(3) {
            let radius = point[0].hypot(point[1]);
            assert!((radius - 0.5_f64.sqrt()).abs() < 1e-14, "{cell_type}: {radius}");
        }
    }
}

/// Points that no quadratic cell holds have recovered gradients, and what cannot be
/// contoured is told.
#[test]
fn mixed_grids_are_contoured_as_far_as_they_can() {
    let bench = Bench::new();
    let cells: [(u8, &[i64]); 5] = [
        (22, &[0, 2, 8, 1, 5, 4]),
        (7, &[0, 4, 8, 7, 3]),
        (5, &[3, 7, 6]),
        (70, &[0; 16]),
        (7, &[0, 8, 2, 6]),
    ];
    let mut grid = square_of(&cells);
    let value = |n: i32| f64::from(n % 3) / 2.0 + f64::from(n / 3);
    grid.point_data.push(DataArray::new("u", 1, (0..9).map(value).collect::<Vec<f64>>()));
    write_vtu(bench.path("in.vtu"), &grid, Default::default()).unwrap();
    let said = bench.succeed(&["in.vtu", "-o", "out.vtp", "--gradients", "-v", "0.4", "-v", "2.2"]);
    let left_out =
        "left out: 1 polygons (whose edges cross), 1 Lagrange quads (of order above 2)\n";
    assert!(said.contains(left_out), "{said}");
    let lines = read_lines(&bench.path("out.vtp"));
    let gradients = lines.point_data.get("Gradients").unwrap().to_f64().unwrap();
    assert!(!gradients.is_empty());
    for gradient in gradients.chunks_exact(3) {
        assert!((gradient[0] - 1.0).hypot(gradient[1] - 2.0) < 1e-12, "{gradient:?}");
    }
}

#[test]
fn grids_that_cannot_be_contoured_are_named() {
    let bench = Bench::new();
    let mut line = UnstructuredGrid::new(DataArray::new("Points", 3, vec![0.0; 12]));
    line.push_cell(3, &[0, 1]);
    line.point_data.push(DataArray::new("u", 1, vec![0.0; 4]));
    write_vtu(bench.path("in.vtu"), &line, Default::default()).unwrap();
    let said = bench.fail(1, &["in.vtu", "-o", "out.vtp"]);
    assert!(said.contains("the grid has 1 lines"), "{said}");
    bench.write_grid(vec![], vec![DataArray::new("c", 1, vec![1.0; 8])]);
    let said = bench.fail(1, &["in.vtu", "-o", "out.vtp"]);
    assert!(said.contains("only cell arrays: convert one first"), "{said}");
    bench.write_grid(vec![DataArray::new("u", 1, vec![f64::NAN; 9])], vec![]);
    let said = bench.fail(1, &["in.vtu", "-o", "out.vtp"]);
    assert!(said.contains("no cell holds a finite value"), "{said}");
    bench.write_grid(vec![u(), DataArray::new("w", 1, vec![1.0; 9])], vec![]);
    let said = bench.fail(1, &["in.vtu", "-o", "out.vtp"]);
    assert!(
        said.contains("which array? give --array NAME; the point arrays are 'u', 'w'"),
        "{said}"
    );
}

#[test]
fn wrong_usage_exits_with_2() {
    let bench = Bench::new();
    let cases: [&[&str]; 9] = [
        &[],
        &["in.vtu"],
        &["in.vtu", "-o", "out.vtp", "-v", "x"],
        &["in.vtu", "-o", "out.vtp", "-v", "inf"],
        &["in.vtu", "-o", "out.vtp", "-n", "0"],
        &["in.vtu", "-o", "out.vtp", "--range", "2,1"],
        &["in.vtu", "-o", "out.vtp", "--spacing", "-1"],
        &["in.vtu", "-o", "out.vtp", "--param", "k"],
        &["in.vtu", "-o", "out.vtp", "--method", "magic"],
    ];
    for arguments in cases {
        bench.fail(2, arguments);
    }
}

#[test]
fn nothing_is_written_over_what_is_read() {
    let bench = Bench::new();
    bench.write_grid(vec![u()], vec![]);
    let cases: [&[&str]; 4] = [
        &["in.vtu", "-o", "./in.vtu"],
        &["in.vtu", "-o", "out.vtp", "--stats", "in.vtu"],
        &["in.vtu", "-o", "out.vtp", "--stats", "out.vtp"],
        &["in.vtu", "-o", "out.vtp", "--stats", "nowhere/stats.json"],
    ];
    let before = std::fs::read(bench.path("in.vtu")).unwrap();
    for arguments in cases {
        bench.fail(1, arguments);
    }
    assert_eq!(std::fs::read(bench.path("in.vtu")).unwrap(), before);
    bench.fail(2, &["in.vtu", "-o", "out.vtp", "--param", "k=1"]);
    bench.succeed(&["in.vtu", "-o", "OUT.VTP"]);
}

#[test]
fn long_lists_of_levels_stay_short() {
    let bench = Bench::new();
    bench.write_grid(vec![u()], vec![]);
    let said = bench.succeed(&["in.vtu", "-o", "out.vtp", "-n", "100", "--range", "5,1e300"]);
    assert!(said.contains("and 95 more levels") && said.len() < 300, "{said}");
}

#[test]
fn a_file_that_is_there_is_kept_when_the_job_fails() {
    let bench = Bench::new();
    std::fs::write(bench.path("old.vtp"), "old").unwrap();
    bench.fail(1, &["no.vtu", "-o", "old.vtp"]);
    assert_eq!(std::fs::read(bench.path("old.vtp")).unwrap(), b"old");
}
