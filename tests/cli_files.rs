//! The command line on files of every kind: one grid, pieces, series.

#[path = "support/program.rs"]
mod program;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use program::{Bench, read_lines, square, u};
use serde_json::Value;
use vtu2contour::vtk::{
    DataArray, Declaration, Floats, PolyData, PvdEntry, PvdFile, PvtpFile, Selection,
    UnstructuredGrid, read_grid, write_pvd, write_pvtu, write_vtp, write_vtu,
};

/// The square with `u` times a factor, and two arrays that travel along.
fn solution(factor: f64) -> UnstructuredGrid {
    let mut grid = square();
    let scaled: Vec<f64> = u().to_f64().unwrap().iter().map(|value| factor * value).collect();
    grid.point_data.push(DataArray::new("u", 1, scaled));
    let gradient: Vec<f64> = [2.0 * factor, 0.0, 0.0].repeat(9);
    grid.point_data.push(DataArray::new("gradient", 3, gradient));
    grid.point_data.push(DataArray::new("other", 2, vec![1.0f32; 18]));
    grid.cell_data.push(DataArray::new("c", 1, (0..8).collect::<Vec<i32>>()));
    grid.field_data.push(DataArray::new("TimeValue", 1, vec![factor]));
    grid
}

/// Writes a series whose step `n` is `n + 1` times the solution, at time n / 4.
fn write_series(bench: &Bench, steps: u32) {
    std::fs::create_dir_all(bench.path("run")).unwrap();
    let entry = |n: u32| {
        let file = bench.path(&format!("run/run_{n}.vtu"));
        write_vtu(&file, &solution(f64::from(n + 1)), Default::default()).unwrap();
        PvdEntry::new(f64::from(n) / 4.0, file)
    };
    let entries: Vec<_> = (0..steps).map(entry).collect();
    write_pvd(bench.path("run.pvd"), &entries).unwrap();
}

/// Writes pieces that lie side by side, the last but one empty.
fn write_pieces(bench: &Bench) {
    let piece = |n: u32| {
        let mut grid = solution(1.0);
        let coordinates = grid.points.to_f64().unwrap();
        let moved: Vec<f64> =
            (0..27).map(|i| coordinates[i] + if i % 3 == 1 { f64::from(n) } else { 0.0 }).collect();
        grid.points = DataArray::new("Points", 3, moved);
        grid
    };
    let empty = UnstructuredGrid::new(DataArray::new("Points", 3, Vec::<f64>::new()));
    let pieces = [piece(0), piece(1), empty, piece(2)];
    let path = |n: usize| bench.path(&format!("piece_{n}.vtu"));
    for (n, piece) in pieces.iter().enumerate() {
        write_vtu(path(n), piece, Default::default()).unwrap();
    }
    let declaration = Declaration::of_grid(&pieces[0], Floats::AsGiven);
    let names: Vec<PathBuf> = (0..4).map(path).collect();
    write_pvtu(bench.path("in.pvtu"), &names, &declaration).unwrap();
}

/// The polylines of files, in no order, each as the bits of its points.
fn shapes<'a>(files: impl IntoIterator<Item = &'a PolyData>) -> BTreeSet<Vec<u64>> {
    let mut shapes = BTreeSet::new();
    for lines in files {
        let points = lines.points.to_f64().unwrap();
        for line in lines.lines.iter() {
            let bits = |&p: &i64| (0..3).map(|n| points[3 * p as usize + n].to_bits()).collect();
            assert!(shapes.insert(line.iter().flat_map(|p| -> Vec<u64> { bits(p) }).collect()));
        }
    }
    shapes
}

fn levels_of(lines: &PolyData) -> BTreeSet<u64> {
    let values = lines.point_data.get("u").unwrap().to_f64().unwrap();
    values.into_iter().map(f64::to_bits).collect()
}

fn names_in(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let name = |entry: std::io::Result<std::fs::DirEntry>| entry.unwrap().file_name();
    let mut names: Vec<String> = entries.map(|entry| name(entry).into_string().unwrap()).collect();
    names.sort();
    names
}

fn stats(bench: &Bench) -> Value {
    let text = std::fs::read_to_string(bench.path("stats.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

#[test]
fn every_kind_of_grid_gives_the_same_lines() {
    let bench = Bench::new();
    let grid = solution(1.0);
    write_vtu(bench.path("in.vtu"), &grid, Default::default()).unwrap();
    let mut surface = PolyData::new(grid.points.clone());
    grid.cells.iter().for_each(|triangle| surface.polys.push(triangle));
    surface.point_data = grid.point_data.clone();
    surface.cell_data = grid.cell_data.clone();
    surface.field_data = grid.field_data.clone();
    write_vtp(bench.path("in.vtp"), &surface, Default::default()).unwrap();
    let declaration = Declaration::of_grid(&grid, Floats::AsGiven);
    write_pvtu(bench.path("in.pvtu"), &[bench.path("in.vtu")], &declaration).unwrap();
    std::fs::write(bench.path("in.vtk"), legacy(&grid)).unwrap();
    std::fs::copy(bench.path("in.vtp"), bench.path("misnamed.vtu")).unwrap();
    write_pvd(bench.path("in.pvd"), &[PvdEntry::new(7.0, bench.path("in.pvtu"))]).unwrap();
    bench.succeed(&["in.vtu", "-o", "expected.vtp", "-a", "u"]);
    let expected = read_lines(&bench.path("expected.vtp"));
    assert_eq!(expected.lines.len(), 10);
    for input in ["in.vtp", "in.pvtu", "in.vtk", "misnamed.vtu", "in.pvd"] {
        let said = bench.succeed(&[input, "-o", "lines.vtp", "-a", "u"]);
        assert_eq!(said, "", "{input}");
        assert_eq!(read_lines(&bench.path("lines.vtp")), expected, "{input}");
    }
}

/// The grid as a file of the older format.
fn legacy(grid: &UnstructuredGrid) -> String {
    let text = |values: Vec<f64>| values.iter().map(|v| format!("{v} ")).collect::<String>();
    let array = |array: &DataArray, kind: &str| {
        let (name, components) = (&array.name, array.components);
        let values = text(array.to_f64().unwrap());
        format!("{name} {components} {} {kind}\n{values}\n", array.tuples())
    };
    let cells: String =
        grid.cells.iter().map(|c| format!("3 {} {} {}\n", c[0], c[1], c[2])).collect();
    [
        "# vtk DataFile Version 3.0\nsquare\nASCII\nDATASET UNSTRUCTURED_GRID\nFIELD f 1\n",
        &array(grid.field_data.get("TimeValue").unwrap(), "double"),
        &format!("POINTS 9 double\n{}\n", text(grid.points.to_f64().unwrap())),
        &format!("CELLS 8 32\n{cells}CELL_TYPES 8\n5 5 5 5 5 5 5 5\nCELL_DATA 8\nFIELD f 1\n"),
        &array(grid.cell_data.get("c").unwrap(), "int"),
        "POINT_DATA 9\nFIELD f 3\n",
        &array(grid.point_data.get("u").unwrap(), "double"),
        &array(grid.point_data.get("gradient").unwrap(), "double"),
        &array(grid.point_data.get("other").unwrap(), "float"),
    ]
    .concat()
}

#[test]
fn a_series_has_the_same_levels_at_all_times() {
    let bench = Bench::new();
    write_series(&bench, 4);
    let said = bench.succeed(&["run.pvd", "-o", "out.pvd", "-n", "3", "--stats", "stats.json"]);
    assert_eq!(said, "");
    let list = PvdFile::open(bench.path("out.pvd")).unwrap();
    let expected =
        |n: u32| PvdEntry::new(f64::from(n) / 4.0, bench.path(&format!("out/out_{n}.vtp")));
    assert_eq!(list.entries(), (0..4).map(expected).collect::<Vec<_>>());
    // u goes from 0 to 2, 4, 6 and 8: the levels are 2, 4 and 6
    for (n, count) in [(0, 1), (1, 2), (2, 3), (3, 3)] {
        let lines = read_lines(&list.entries()[n].file);
        // the first touches its highest level
        let levels: BTreeSet<u64> = [2.0, 4.0, 6.0].iter().map(|v: &f64| v.to_bits()).collect();
        assert!(levels_of(&lines).is_subset(&levels) && lines.lines.len() == count, "step {n}");
        bench.succeed(&[&format!("run/run_{n}.vtu"), "-o", "one.vtp", "-v", "2,4,6", "-q"]);
        assert_eq!(read_lines(&bench.path("one.vtp")), lines, "step {n}");
        let time = lines.field_data.get("TimeValue").unwrap().to_f64().unwrap();
        assert_eq!(time, [n as f64 + 1.0]);
    }
    let stats = stats(&bench);
    assert_eq!(stats["levels"], serde_json::json!([2.0, 4.0, 6.0]));
    assert_eq!(stats["range"], serde_json::json!([0.0, 8.0]));
    assert_eq!((&stats["cells"]["triangles"], &stats["output"]["lines"]), (&32.into(), &9.into()));
    let parts = stats["parts"].as_array().unwrap();
    assert_eq!(
        (parts.len(), &parts[3]["time"], &parts[1]["range"][1]),
        (4, &0.75.into(), &4.0.into())
    );
    assert!(parts[2]["file"].as_str().unwrap().ends_with("run_2.vtu"));
    assert_eq!(names_in(&bench.path("out")).len(), 4);
}

#[test]
fn a_step_of_a_series_is_chosen_by_its_time() {
    let bench = Bench::new();
    write_series(&bench, 3);
    for (time, step) in [("first", 0), ("last", 2), ("0.25", 1), ("2.5e-1", 1)] {
        bench.succeed(&["run.pvd", "-o", "lines.vtp", "--time", time]);
        bench.succeed(&[&format!("run/run_{step}.vtu"), "-o", "expected.vtp"]);
        let [lines, expected] = ["lines.vtp", "expected.vtp"].map(|n| read_lines(&bench.path(n)));
        assert_eq!(lines, expected, "{time}");
    }
    bench.succeed(&["run.pvd", "-o", "last.pvd", "--time", "last"]);
    let list = PvdFile::open(bench.path("last.pvd")).unwrap();
    assert_eq!(list.entries(), [PvdEntry::new(0.5, bench.path("last/last_0.vtp"))]);
    let said = bench.fail(1, &["run.pvd", "-o", "out.vtp", "--time", "0.3"]);
    assert!(said.contains("no step at that time; its times are 0, 0.25, 0.5"), "{said}");
    let said = bench.fail(1, &["run.pvd", "-o", "out.vtp"]);
    assert!(said.contains("is a series of 3 files: write a series, with -o NAME.pvd"), "{said}");
    let said = bench.fail(1, &["run/run_0.vtu", "-o", "out.vtp", "--time", "0"]);
    assert!(said.contains("is no series (.pvd): leave --time out"), "{said}");
}

#[test]
fn parts_of_one_time_and_files_without_a_time_stay_what_they_are() {
    let bench = Bench::new();
    write_series(&bench, 2);
    let file = |n: u32| bench.path(&format!("run/run_{n}.vtu"));
    let entries = [
        PvdEntry { part: 1, group: "a".into(), ..PvdEntry::new(0.5, file(0)) },
        PvdEntry { part: 2, group: "b".into(), ..PvdEntry::new(0.5, file(1)) },
        PvdEntry { file: file(1), ..PvdEntry::default() },
        PvdEntry::new(0.75, file(0)),
    ];
    write_pvd(bench.path("parts.pvd"), &entries).unwrap();
    let written = |options: &[&str]| {
        bench.succeed(&[&["parts.pvd", "-o", "out.pvd"], options].concat());
        let list = PvdFile::open(bench.path("out.pvd")).unwrap();
        let described = |entry: &PvdEntry| (entry.time, entry.part, entry.group.clone());
        list.entries().iter().map(described).collect::<Vec<_>>()
    };
    let all = entries.iter().map(|e| (e.time, e.part, e.group.clone())).collect::<Vec<_>>();
    assert_eq!(written(&[]), all);
    assert_eq!(written(&["--time", "0.5"]), all[..3]);
    let said = bench.fail(1, &["parts.pvd", "-o", "out.vtp", "--time", "0.5"]);
    assert!(said.contains("has 3 files at that time"), "{said}");
}

#[test]
fn pieces_are_joined_or_kept_apart() {
    let bench = Bench::new();
    write_pieces(&bench);
    let options = ["-a", "u", "-v", "0.5,1.5", "--tolerance", "1e-4"];
    let run = |output| bench.succeed(&[&["in.pvtu", "-o", output][..], &options].concat());
    assert_eq!(run("joined.vtp") + &run("pieces.pvtp"), "");
    let joined = read_lines(&bench.path("joined.vtp"));
    let list = PvtpFile::open(bench.path("pieces.pvtp")).unwrap();
    assert_eq!(names_in(&bench.path("pieces")), ["pieces_0.vtp", "pieces_1.vtp", "pieces_3.vtp"]);
    let pieces: Vec<PolyData> = list.piece_paths().iter().map(|path| read_lines(path)).collect();
    assert_eq!(pieces.len(), 3);
    assert_eq!(shapes([&joined]).len(), 6);
    assert_eq!(shapes(&pieces), shapes([&joined]));
    let together = list.read(&Selection::All).unwrap();
    assert_eq!(together.warnings, [""; 0]);
    for (ours, theirs) in [
        (&together.data.point_data, &joined.point_data),
        (&together.data.cell_data, &joined.cell_data),
    ] {
        let names = |set: &vtu2contour::vtk::Attributes| -> Vec<_> {
            set.iter().map(|array| (array.name.clone(), array.array_type())).collect()
        };
        assert_eq!(names(ours), names(theirs));
    }
    // without levels, they are those of the joined grid
    bench.succeed(&["in.pvtu", "-o", "joined.vtp", "-n", "3", "-a", "u"]);
    bench.succeed(&["in.pvtu", "-o", "pieces.pvtp", "-n", "3", "-a", "u"]);
    let pieces = read_grid(bench.path("pieces.pvtp"), &Selection::All).unwrap().data;
    let levels = pieces.point_data.get("u").unwrap().to_f64().unwrap();
    let levels: BTreeSet<u64> = levels.into_iter().map(f64::to_bits).collect();
    assert_eq!(levels, levels_of(&read_lines(&bench.path("joined.vtp"))));
    // any other input has one piece
    bench.succeed(&["piece_0.vtu", "-o", "one.pvtp", "-a", "u"]);
    assert_eq!(PvtpFile::open(bench.path("one.pvtp")).unwrap().piece_paths().len(), 1);
}

#[test]
fn pieces_of_a_list_have_the_arrays_that_all_have() {
    let bench = Bench::new();
    write_pieces(&bench);
    let mut grid = solution(1.0);
    grid.point_data.push(DataArray::new("extra", 1, vec![1i8; 9]));
    write_vtu(bench.path("piece_1.vtu"), &grid, Default::default()).unwrap();
    let said = bench.succeed(&["in.pvtu", "-o", "out.pvtp", "-a", "u"]);
    assert!(said.contains("'extra' left out: not every piece has it"), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
    let list = PvtpFile::open(bench.path("out.pvtp")).unwrap();
    assert_eq!(list.read(&Selection::All).unwrap().warnings, [""; 0]);
    assert!(list.piece_paths().iter().all(|p| read_lines(p).point_data.get("extra").is_none()));
}

#[test]
fn a_single_grid_in_a_list_has_the_time_of_its_data() {
    let bench = Bench::new();
    write_vtu(bench.path("in.vtu"), &solution(2.5), Default::default()).unwrap();
    bench.succeed(&["in.vtu", "-o", "out.pvd", "-a", "u"]);
    let list = PvdFile::open(bench.path("out.pvd")).unwrap();
    assert_eq!(list.entries(), [PvdEntry::new(2.5, bench.path("out/out_0.vtp"))]);
}

#[test]
fn a_series_that_cannot_be_finished_leaves_nothing() {
    let bench = Bench::new();
    write_series(&bench, 4);
    let before = names_in(bench.folder.path());
    let mut broken = solution(1.0);
    broken.point_data = [DataArray::new("w", 1, vec![0.0; 9])].into_iter().collect();
    write_vtu(bench.path("run/run_2.vtu"), &broken, Default::default()).unwrap();
    for levels in ["-v1", "-n3"] {
        let said = bench.fail(1, &["run.pvd", "-o", "out.pvd", "-a", "u", levels]);
        assert!(said.contains("run_2.vtu': no point array 'u'"), "{said}");
        assert_eq!(said.lines().count(), 1);
        assert_eq!(names_in(bench.folder.path()), before);
    }
    std::fs::remove_file(bench.path("run/run_2.vtu")).unwrap();
    let said = bench.fail(1, &["run.pvd", "-o", "out.pvd", "-v1"]);
    assert!(said.contains("run.pvd' lists a file that cannot be read"), "{said}");
    assert_eq!(names_in(bench.folder.path()), before);
    // what was there stays, and what another run left is no hindrance
    std::fs::create_dir(bench.path("out")).unwrap();
    std::fs::write(bench.path("out/out_0.vtp"), "old").unwrap();
    bench.fail(1, &["run.pvd", "-o", "out.pvd", "-v1"]);
    assert_eq!(std::fs::read(bench.path("out/out_0.vtp")).unwrap(), b"old");
    write_series(&bench, 4);
    bench.succeed(&["run.pvd", "-o", "out.pvd", "-v1"]);
    assert_eq!(read_lines(&bench.path("out/out_0.vtp")).lines.len(), 1);
}

#[test]
fn steps_without_contours_are_told_once() {
    let bench = Bench::new();
    write_series(&bench, 4);
    let mut line = solution(1.0);
    line.cells = Default::default();
    line.types.clear();
    line.cell_data = Default::default();
    line.push_cell(3, &[0, 1]);
    let step = |n: u32| bench.path(&format!("run/run_{n}.vtu"));
    for n in [1, 2] {
        write_vtu(step(n), &line, Default::default()).unwrap();
    }
    let said = bench.succeed(&["run.pvd", "-o", "out.pvd", "-v", "1,100"]);
    assert_eq!(said.lines().count(), 2, "{said}");
    let first = "2 of 4 files, first 'run/run_1.vtu' (time 0.25): nothing to contour";
    assert!(said.contains(first), "{said}");
    assert!(said.contains("no contour at 100.0: outside the range 0.0 to 8.0 of 'u'"), "{said}");
    let list = PvdFile::open(bench.path("out.pvd")).unwrap();
    let times: Vec<_> = list.entries().iter().map(|entry| entry.time).collect();
    assert_eq!(times, [Some(0.0), Some(0.75)]);
    assert_eq!(names_in(&bench.path("out")), ["out_0.vtp", "out_3.vtp"]);
    for n in 0..4 {
        write_vtu(step(n), &line, Default::default()).unwrap();
    }
    bench.fail(1, &["run.pvd", "-o", "none.pvd", "-v", "1"]);
    assert!(!bench.path("none.pvd").exists() && !bench.path("none").exists());
}

#[test]
fn a_warning_of_one_step_names_it() {
    let bench = Bench::new();
    write_series(&bench, 3);
    let mut grid = solution(2.0);
    let mut values = grid.point_data.get("u").unwrap().to_f64().unwrap();
    values[8] = f64::NAN;
    grid.point_data.push(DataArray::new("u", 1, values));
    write_vtu(bench.path("run/run_1.vtu"), &grid, Default::default()).unwrap();
    let said = bench.succeed(&["run.pvd", "-o", "out.pvd"]);
    assert!(said.contains("run_1.vtu' (time 0.25): left out: 2 triangles with values"), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
    assert_eq!(bench.succeed(&["run.pvd", "-o", "out.pvd", "-q"]), "");
}

#[test]
fn nothing_that_is_read_is_written_over() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("out")).unwrap();
    write_series(&bench, 1);
    let lines = bench.path("out/out_0.vtp");
    bench.succeed(&["run/run_0.vtu", "-o", "out/out_0.vtp"]);
    write_pvd(bench.path("in.pvd"), &[PvdEntry::new(0.0, &lines)]).unwrap();
    let before = std::fs::read(&lines).unwrap();
    let said = bench.fail(1, &["in.pvd", "-o", "out.pvd"]);
    assert!(said.contains("'out/out_0.vtp' would be written over"), "{said}");
    let said = bench.fail(1, &["run.pvd", "-o", "run.pvd"]);
    assert!(said.contains("'run.pvd' would be written over"), "{said}");
    assert_eq!(std::fs::read(&lines).unwrap(), before);
    // a file in the place of the folder
    std::fs::write(bench.path("taken"), "").unwrap();
    let said = bench.fail(1, &["run.pvd", "-o", "taken.pvd"]);
    assert!(said.contains("cannot write 'taken'"), "{said}");
    assert!(!bench.path("taken.pvd").exists());
}

#[test]
fn arrays_that_a_picture_does_not_need_are_not_decoded() {
    let bench = Bench::new();
    write_vtu(bench.path("in.vtu"), &solution(1.0), vtu2contour::vtk::Encoding::Ascii.into())
        .unwrap();
    let text = std::fs::read_to_string(bench.path("in.vtu")).unwrap();
    let at = text.find("Name=\"c\"").unwrap();
    let (head, tail) = text.split_at(at);
    std::fs::write(bench.path("in.vtu"), head.to_owned() + &tail.replacen('7', "x", 1)).unwrap();
    let said = bench.fail(1, &["in.vtu", "-o", "out.vtp", "-a", "u"]);
    assert!(said.contains("array 'c' of CellData"), "{said}");
    bench.succeed(&["in.vtu", "-o", "out.svg", "-a", "u"]);
}

#[test]
fn info_tells_of_all_files() {
    let bench = Bench::new();
    write_series(&bench, 12);
    let info = |arguments: &[&str]| {
        let output = bench.run(&[&["info"], arguments].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    let text = info(&["run.pvd"]);
    for part in [
        "series, 12 files",
        "time 0.25  ",
        "... 2 more",
        "time 2.75  ",
        "9 points, 8 cells (8 triangles), 1 piece,",
        "c  Int32 x 1  0.0 to 7.0",
        "array     u",
        "cells     96 triangles",
        "range     0.0 to 24.0",
        "levels    10 by default",
    ] {
        assert!(text.contains(part), "no {part:?} in {text}");
    }
    assert!(!text.contains("time 1.5"), "{text}");
    let text = info(&["run.pvd", "--time", "last"]);
    assert!(text.contains("time 2.75") && text.contains("cells     8 triangles"), "{text}");
    write_pieces(&bench);
    let text = info(&["in.pvtu", "-a", "u"]);
    assert!(text.contains("27 points, 24 cells (24 triangles), 4 pieces"), "{text}");
}
