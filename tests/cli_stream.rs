//! Pieces taken one at a time give the contours of the whole.

#[path = "support/program.rs"]
mod program;
mod support;

use std::collections::BTreeSet;

use program::{Bench, square_of};
use support::mixed_grid::mixed_grid;
use support::tetrahedra::kuhn_grid;
use vtu2contour::filter::ORIGINAL_CELLS;
use vtu2contour::mesh::Vector;
use vtu2contour::vtk::{
    Attributes, DataArray, Declaration, Encoding, Floats, PvdEntry, Selection, UnstructuredGrid,
    Values, WriteOptions, read_grid, write_pvd, write_pvtu, write_vtu,
};

/// Pieces of solids and, below them, surfaces, each finer than the one before and beside it, of
/// which the last cells belong to the next. Before, between and after them: one without cells, and
/// one with a single point.
fn write_pieces(bench: &Bench) -> usize {
    let mut files = Vec::new();
    let mut write = |grid: &UnstructuredGrid| {
        files.push(bench.path(&format!("piece_{}.vtu", files.len())));
        write_vtu(files.last().unwrap(), grid, Default::default()).unwrap();
    };
    let mut lone = square_of(&[(1, &[4])]);
    add_data(&mut lone, 9);
    write(&lone);
    for n in [2_u8, 3, 5] {
        let place = f64::from(n);
        let wave = |p: &Vector| {
            let phase = 3.0 * (p.x + place) + 2.0 * p.y * p.z;
            let slope = Vector::new(3.0, 2.0 * p.z, 2.0 * p.y) * phase.cos();
            (phase.sin() + 0.1 * place, slope)
        };
        let mut grid = mixed_grid(&kuhn_grid(usize::from(n)), wave, |p| p.x > 0.7);
        let points = grid.points.to_f64().unwrap();
        let moved = points.chunks(3).flat_map(|p| [p[0] + place, p[1], p[2]]);
        grid.points = DataArray::new("Points", 3, moved.collect::<Vec<f64>>());
        let given = grid.point_data.get("g").unwrap().clone();
        grid.point_data = grid.point_data.without(&["g"]);
        grid.point_data.push(DataArray { name: "gradient".into(), ..given });
        let cells = grid.types.len();
        grid.cell_data.push(DataArray::new("material", 2, vec![n; 2 * cells]));
        write(&grid);
        if n == 3 {
            write(&UnstructuredGrid::new(DataArray::new("Points", 3, Vec::<f64>::new())));
        }
    }
    let first = read_grid(&files[1], &Selection::All).unwrap().data;
    let declaration = Declaration::of_grid(&first, Floats::AsGiven);
    write_pvtu(bench.path("in.pvtu"), &files, &declaration).unwrap();
    files.len()
}

/// The arrays of the pieces, at so many points and in a single cell.
fn add_data(grid: &mut UnstructuredGrid, points: usize) {
    grid.point_data.push(DataArray::new("u", 1, vec![0.5; points]));
    grid.point_data.push(DataArray::new("gradient", 3, vec![0.0; 3 * points]));
    grid.cell_data.push(DataArray::new("vtkGhostType", 1, vec![0_u8]));
    grid.cell_data.push(DataArray::new("material", 2, vec![9_u8; 2]));
}

/// The tuple of each array, as text.
fn tuples(data: &Attributes, index: usize) -> String {
    let tuple = |array: &DataArray| {
        let values = array.to_f64().unwrap();
        let of_index = &values[index * array.components..(index + 1) * array.components];
        format!("{} {} {of_index:?}\n", array.name, array.array_type())
    };
    data.iter().map(tuple).collect()
}

/// The cells of a file with all that is known of them and their points, in no order.
fn cells_of(bench: &Bench, file: &str) -> BTreeSet<String> {
    let grid = read_grid(bench.path(file), &Selection::All).unwrap().data;
    let points = grid.points.to_f64().unwrap();
    let point = |&p: &i64| {
        let p = p as usize;
        format!("{:?} {}", &points[3 * p..3 * p + 3], tuples(&grid.point_data, p))
    };
    let cell = |(n, corners): (usize, &[i64])| {
        let corners: String = corners.iter().map(point).collect();
        format!("{} {}{corners}", grid.types[n], tuples(&grid.cell_data, n))
    };
    let count = grid.types.len();
    let cells: BTreeSet<String> = grid.cells.iter().enumerate().map(cell).collect();
    assert_eq!(cells.len(), count, "{file}");
    cells
}

#[test]
fn pieces_one_at_a_time_are_the_whole() {
    let bench = Bench::new();
    write_pieces(&bench);
    for options in [
        &["-n", "5"][..],
        &["-n", "5", "--range", "0,1", "--normals", "--gradients", "--segments"],
        &["-v", "0.3,0.9", "--single", "-g", "recover"],
        &["-v", "0.3", "--nside", "3", "--spacing", "0.1"],
        &["-n", "2", "--tolerance", "1e-3"],
    ] {
        for output in ["vtp", "vtu"] {
            let [whole, stream] = ["whole", "stream"].map(|name| format!("{name}.{output}"));
            bench.succeed(&[&["in.pvtu", "-o", &whole, "-a", "u"][..], options].concat());
            let streamed = ["in.pvtu", "-o", &stream, "-a", "u", "--stream"];
            let said = bench.succeed(&[&streamed[..], options].concat());
            assert!(said.contains("piece_0.vtu': nothing to contour"), "{said}");
            let [expected, found] = [&whole, &stream].map(|file| cells_of(&bench, file));
            assert!(expected.len() > 100 && found == expected, "{output} {options:?}");
        }
        // the list of pieces is the same but for the numbers of cells
        bench.succeed(&[&["in.pvtu", "-o", "pieces.pvtp", "-a", "u"][..], options].concat());
        let without = |file| {
            let is_number = |line: &&str| !line.contains(ORIGINAL_CELLS);
            let without = |cell: String| cell.lines().filter(is_number).collect::<String>();
            cells_of(&bench, file).into_iter().map(without).collect::<BTreeSet<String>>()
        };
        assert_eq!(without("pieces.pvtp"), without("whole.vtp"), "{options:?}");
    }
}

#[test]
fn a_step_of_a_series_is_taken_in_pieces() {
    let bench = Bench::new();
    write_pieces(&bench);
    let steps =
        [PvdEntry::new(0.0, bench.path("in.pvtu")), PvdEntry::new(1.0, bench.path("1.vtu"))];
    write_pvd(bench.path("run.pvd"), &steps).unwrap();
    write_vtu(bench.path("1.vtu"), &square_of(&[(5, &[0, 1, 3])]), Default::default()).unwrap();
    let options = ["-a", "u", "-n", "3", "--stats", "stats.json"];
    let run = |first: &[&str]| {
        bench.succeed(&[first, &options].concat());
        let stats = std::fs::read_to_string(bench.path("stats.json")).unwrap();
        stats.matches("\"file\"").count()
    };
    assert_eq!(run(&["in.pvtu", "-o", "whole.vtp"]), 0);
    let expected = cells_of(&bench, "whole.vtp");
    assert_eq!(run(&["run.pvd", "--time", "0", "-o", "step.vtp", "--stream"]), 3);
    assert!(cells_of(&bench, "step.vtp") == expected);
    assert_eq!(run(&["run.pvd", "--time", "0", "-o", "step.pvtp"]), 3);
    for (arguments, expected) in [
        (&["run.pvd", "-o", "out.vtp"][..], "is a series of 2 files: write a series"),
        (&["run.pvd", "-o", "lines.pvd"], "--stream is for .vtp, .vtu and .pvtp"),
        (&["in.pvtu", "-o", "out.svg"], "--stream is for .vtp, .vtu and .pvtp"),
        (&["run.pvd", "--time", "0", "-o", "in.pvtu.vtp", "--stats", "run.pvd"], "written over"),
        (&["run.pvd", "--time", "0", "-o", "a.vtp", "--stats", "in.pvtu"], "written over"),
        (&["run.pvd", "--time", "0", "-o", "a.vtp", "--stats", "piece_3.vtu"], "written over"),
    ] {
        let said = bench.fail(1, &[arguments, &["--stream"]].concat());
        assert!(said.contains(expected), "{arguments:?}: {said}");
    }
    for option in [["--triangles", "9"], ["--merge-points", "0"]] {
        let said =
            bench.fail(2, &[&["in.pvtu", "-o", "out.vtp", "--stream"][..], &option].concat());
        assert!(said.contains("cannot be used with"), "{said}");
    }
}

#[test]
fn pieces_with_gradients_of_different_origin_are_told() {
    let bench = Bench::new();
    let last = write_pieces(&bench) - 1;
    let options = ["in.pvtu", "-o", "stream.vtp", "-a", "u", "-v", "0.5", "--stream"];
    let said = bench.succeed(&options);
    assert!(!said.contains("not the same"), "{said}");
    let file = bench.path(&format!("piece_{last}.vtu"));
    let mut grid = read_grid(&file, &Selection::All).unwrap().data;
    let wrong =
        grid.point_data.get("gradient").unwrap().to_f64().unwrap().iter().map(|g| -g).collect();
    grid.point_data.push(DataArray::new("gradient", 3, Values::F64(wrong)));
    write_vtu(&file, &grid, Default::default()).unwrap();
    let said = bench.succeed(&options);
    let expected =
        "the gradient is not the same in all pieces ('gradient', recovered): contours may not";
    assert!(said.contains(expected), "{said}");
    bench.succeed(&[&options[..], &["-g", "gradient"]].concat());
}

#[test]
fn an_array_that_is_too_short_in_a_piece_is_left_out() {
    let bench = Bench::new();
    let last = write_pieces(&bench) - 1;
    let file = bench.path(&format!("piece_{last}.vtu"));
    let grid = read_grid(&file, &Selection::All).unwrap().data;
    let options = WriteOptions { encoding: Encoding::Ascii, ..Default::default() };
    write_vtu(&file, &grid, options).unwrap();
    let text = std::fs::read_to_string(&file).unwrap();
    let (before, rest) = text.split_once("\"material\"").unwrap();
    let (array, after) = rest.split_once("</DataArray>").unwrap();
    let (shorter, _) = array.trim_end().rsplit_once(char::is_whitespace).unwrap();
    std::fs::write(&file, format!("{before}\"material\"{shorter}</DataArray>{after}")).unwrap();
    let run = |output: &str, stream: &[&str]| {
        let options = ["in.pvtu", "-o", output, "-a", "u", "-v", "0.5"];
        bench.succeed(&[&options, stream].concat())
    };
    run("whole.vtp", &[]);
    let said = run("stream.vtp", &["--stream"]);
    assert!(said.contains("'material' left out: it is not alike in all pieces"), "{said}");
    let whole = cells_of(&bench, "whole.vtp");
    assert!(!whole.iter().any(|cell| cell.contains("material")));
    assert!(cells_of(&bench, "stream.vtp") == whole);
}
