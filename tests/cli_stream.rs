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
    AttributeKind, Attributes, DataArray, Declaration, Encoding, Floats, PolyData, PvdEntry,
    Selection, UnstructuredGrid, Values, VtpFile, WriteOptions, read_grid, write_pvd, write_pvtp,
    write_pvtu, write_vtp, write_vtu,
};

/// Pieces of solids and, below them, surfaces, each finer than the one before and beside it, of
/// which the last cells belong to the next. Among them are a single point, one without cells, and,
/// far off, one of ghosts only and one without values. All but the first have roles and field data
/// of their own.
fn write_pieces(bench: &Bench) -> usize {
    let mut files = Vec::new();
    let mut write = |grid: &mut UnstructuredGrid| {
        let number = files.len();
        let role = AttributeKind::Scalars;
        grid.point_data.set_active(role, if number == 0 { "u" } else { "w" });
        if number > 0 {
            grid.field_data.push(DataArray::new("k", 1, vec![number as f64]));
        }
        files.push(bench.path(&format!("piece_{number}.vtu")));
        write_vtu(&files[number], grid, Default::default()).unwrap();
    };
    let mut lone = square_of(&[(1, &[4])]);
    lone.point_data.push(DataArray::new("u", 1, vec![0.5; 9]));
    lone.point_data.push(DataArray::new("grad_u", 3, vec![0.0; 27]));
    lone.point_data.push(DataArray::new("w", 1, vec![0.5; 9]));
    lone.cell_data.push(DataArray::new("vtkGhostType", 1, vec![0_u8]));
    lone.cell_data.push(DataArray::new("material", 2, vec![9_u8; 2]));
    write(&mut lone);
    for n in [2_u8, 20, 3, 5, 40] {
        let place = f64::from(n);
        let wave = |p: &Vector| {
            let phase = 3.0 * (p.x + place) + 2.0 * p.y * p.z;
            let slope = Vector::new(3.0, 2.0 * p.z, 2.0 * p.y) * phase.cos();
            (phase.sin() + 0.1 * place, slope)
        };
        let mesh = kuhn_grid(usize::from(n % 6).max(1));
        let mut grid = mixed_grid(&mesh, wave, |p| p.x > 0.7 || n == 20);
        let points = grid.points.to_f64().unwrap();
        let moved = points.chunks(3).flat_map(|p| [p[0] + place, p[1], p[2]]);
        grid.points = DataArray::new("Points", 3, moved.collect::<Vec<f64>>());
        let given = grid.point_data.get("g").unwrap().clone();
        grid.point_data = grid.point_data.without(&["g"]);
        grid.point_data.push(DataArray { name: "grad_u".into(), ..given });
        let values = grid.point_data.get("u").unwrap().to_f64().unwrap();
        grid.point_data.push(DataArray::new(
            "w",
            1,
            values.iter().map(|u| 3.0 * u).collect::<Vec<_>>(),
        ));
        if n == 40 {
            grid.point_data.push(DataArray::new("u", 1, vec![f64::NAN; values.len()]));
        }
        let cells = grid.types.len();
        grid.cell_data.push(DataArray::new("material", 2, vec![n; 2 * cells]));
        write(&mut grid);
        if n == 3 {
            write(&mut UnstructuredGrid::new(DataArray::new("Points", 3, Vec::<f64>::new())));
        }
    }
    let first = read_grid(&files[1], &Selection::All).unwrap().data;
    let declaration = Declaration::of_grid(&first, Floats::AsGiven);
    write_pvtu(bench.path("in.pvtu"), &files, &declaration).unwrap();
    files.len()
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

/// The cells of a file with all that is known of them and their points, in no order; and the roles
/// of its arrays, and its field data.
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
    let mut cells: BTreeSet<String> = grid.cells.iter().enumerate().map(cell).collect();
    assert_eq!(cells.len(), count, "{file}");
    let roles = [&grid.point_data, &grid.cell_data].map(|data| data.active_names());
    let fields = grid.field_data.iter().map(|array| (&array.name, &array.values));
    cells.insert(format!("{roles:?} {:?}", fields.collect::<Vec<_>>()));
    cells
}

#[test]
fn pieces_one_at_a_time_are_the_whole() {
    let bench = Bench::new();
    write_pieces(&bench);
    for options in [
        &["-n", "5"][..],
        &["-a", "w", "-n", "5", "--range", "0,1", "--normals", "--gradients", "--segments"],
        &["-v", "0.3,0.9", "--single", "-g", "recover"],
        &["-v", "0.3", "--nside", "3", "--spacing", "0.1"],
        &["-a", "u", "-n", "2", "--tolerance", "1e-3"],
    ] {
        for output in ["vtp", "vtu"] {
            let [whole, stream] = ["whole", "stream"].map(|name| format!("{name}.{output}"));
            bench.succeed(&[&["in.pvtu", "-o", &whole][..], options].concat());
            let streamed = ["in.pvtu", "-o", &stream, "--stream"];
            let said = bench.succeed(&[&streamed[..], options].concat());
            assert!(said.contains("piece_0.vtu': nothing to contour"), "{said}");
            let is_none = said.contains("piece_6.vtu': no cell holds a finite value");
            assert_eq!(is_none, !options.contains(&"w"), "{said}");
            assert!(!said.contains("piece_2.vtu'"), "{said}");
            let [expected, found] = [&whole, &stream].map(|file| cells_of(&bench, file));
            let (count, differ) = (expected.len(), found.symmetric_difference(&expected).count());
            assert!(count > 100 && differ == 0, "{count} {differ} {output} {options:?}");
        }
        // the list of pieces is the same but for the numbers of cells
        bench.succeed(&[&["in.pvtu", "-o", "pieces.pvtp"][..], options].concat());
        let without = |file| {
            let is_number = |line: &&str| !line.contains(ORIGINAL_CELLS);
            let without = |cell: String| cell.lines().filter(is_number).collect::<String>();
            cells_of(&bench, file).into_iter().map(without).collect::<BTreeSet<String>>()
        };
        assert_eq!(without("pieces.pvtp"), without("whole.vtp"), "{options:?}");
    }
}

#[test]
fn surfaces_one_at_a_time_are_the_whole() {
    let bench = Bench::new();
    let files = ["a.vtp", "b.vtp", "c.vtp"].map(|name| bench.path(name));
    for (n, file) in (1..).zip(&files) {
        let points = square_of(&[]).points.to_f64().unwrap();
        let values = points.chunks(3).map(|p| p[0] * p[0] + p[1]).collect::<Vec<_>>();
        let moved = points.chunks(3).flat_map(|p| [p[0], p[1], f64::from(n)]);
        let mut data = PolyData::new(DataArray::new("Points", 3, moved.collect::<Vec<f64>>()));
        data.point_data.push(DataArray::new("u", 1, values));
        (0..n).for_each(|point| data.verts.push(&[point.into()]));
        (1..n).for_each(|point| data.lines.push(&[0, point.into()]));
        data.polys.push(&[0, 1, 4, 3]);
        data.polys.push(&[4, 5, 8]);
        data.strips.push(&[1, 2, 4, 5]);
        let cells = 0..data.cell_count() as i64;
        let numbers = cells.map(|cell| 100 * i64::from(n) + cell).collect::<Vec<_>>();
        data.cell_data.push(DataArray::new("number", 1, numbers));
        if n > 1 {
            data.field_data.push(DataArray::new("k", 1, vec![f64::from(n)]));
        }
        write_vtp(file, &data, Default::default()).unwrap();
    }
    let first = VtpFile::open(&files[0]).unwrap().read(&Selection::All).unwrap().data;
    let declaration = Declaration::of_poly_data(&first, Floats::AsGiven);
    write_pvtp(bench.path("in.pvtp"), &files, &declaration).unwrap();
    for options in [&["-n", "3"][..], &["-v", "0.7", "--pde", "uxx + uyy = k"]] {
        bench.succeed(&[&["in.pvtp", "-o", "whole.vtp"], options].concat());
        bench.succeed(&[&["in.pvtp", "-o", "stream.vtp", "--stream"], options].concat());
        assert!(cells_of(&bench, "stream.vtp") == cells_of(&bench, "whole.vtp"), "{options:?}");
    }
    // as VTK numbers them
    let whole = read_grid(bench.path("in.pvtp"), &Selection::All).unwrap().data;
    let numbers = whole.cell_data.get("number").unwrap().component(0).unwrap();
    let lines = read_grid(bench.path("stream.vtp"), &Selection::All).unwrap().data;
    let of_lines = |name: &str| lines.cell_data.get(name).unwrap().component(0).unwrap();
    let original = of_lines(ORIGINAL_CELLS).into_iter().map(|cell| numbers[cell as usize]);
    assert_eq!(original.collect::<Vec<_>>(), of_lines("number"));
}

#[test]
fn a_step_of_a_series_is_taken_in_pieces() {
    let bench = Bench::new();
    write_pieces(&bench);
    let steps =
        [PvdEntry::new(0.5, bench.path("in.pvtu")), PvdEntry::new(1.0, bench.path("1.vtu"))];
    write_pvd(bench.path("run.pvd"), &steps).unwrap();
    write_vtu(bench.path("1.vtu"), &square_of(&[(5, &[0, 1, 3])]), Default::default()).unwrap();
    let options = ["-a", "u", "-n", "3", "--stats", "stats.json"];
    let run = |first: &[&str]| {
        bench.succeed(&[first, &options].concat());
        let stats = std::fs::read_to_string(bench.path("stats.json")).unwrap();
        stats.matches("\"time\": 0.5").count()
    };
    assert_eq!(run(&["in.pvtu", "-o", "whole.vtp"]), 0);
    let expected = cells_of(&bench, "whole.vtp");
    assert_eq!(run(&["run.pvd", "--time", "0.5", "-o", "step.vtp", "--stream"]), 3);
    assert!(cells_of(&bench, "step.vtp") == expected);
    assert_eq!(run(&["run.pvd", "--time", "0.5", "-o", "step.pvtp"]), 3);
    for (arguments, expected) in [
        (&["run.pvd", "-o", "out.vtp"][..], "is a series of 2 files: write a series"),
        (&["run.pvd", "-o", "lines.pvd"], "--stream is for the pieces of one, with --time T"),
        (&["in.pvtu", "-o", "out.svg"], "--stream is for .vtp, .vtu and .pvtp"),
        (&["run.pvd", "--time", "0.5", "-o", "in.pvtu.vtp", "--stats", "run.pvd"], "written over"),
        (&["run.pvd", "--time", "0.5", "-o", "a.vtp", "--stats", "in.pvtu"], "written over"),
        (&["run.pvd", "--time", "0.5", "-o", "a.vtp", "--stats", "piece_3.vtu"], "written over"),
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
    let last = write_pieces(&bench) - 2;
    let options = ["in.pvtu", "-o", "stream.vtp", "-a", "u", "-v", "0.5", "--stream"];
    let said = bench.succeed(&options);
    assert!(!said.contains("does not fit"), "{said}");
    let file = bench.path(&format!("piece_{last}.vtu"));
    let mut grid = read_grid(&file, &Selection::All).unwrap().data;
    let wrong =
        grid.point_data.get("grad_u").unwrap().to_f64().unwrap().iter().map(|g| -g).collect();
    grid.point_data.push(DataArray::new("grad_u", 3, Values::F64(wrong)));
    write_vtu(&file, &grid, Default::default()).unwrap();
    let said = bench.succeed(&options);
    let expected = "'grad_u' does not fit the values of all pieces";
    assert!(said.contains(expected), "{said}");
    bench.succeed(&[&options[..], &["-g", "grad_u"]].concat());
}

#[test]
fn an_array_that_is_too_short_in_a_piece_is_left_out() {
    let bench = Bench::new();
    let last = write_pieces(&bench) - 2;
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
