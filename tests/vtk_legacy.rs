//! Files in VTK's older format, written by hand.

#[path = "vtk_common/legacy.rs"]
mod legacy;

use vtu2contour::vtk::{
    AttributeKind, LegacyData, LegacyFile, LegacyProblem, PolyData, Selection, UnstructuredGrid,
    Values, VtkError,
};

fn open(bytes: Vec<u8>) -> LegacyFile {
    LegacyFile::from_bytes("x.vtk", bytes).unwrap()
}

fn grid(bytes: Vec<u8>) -> UnstructuredGrid {
    match open(bytes).read(&Selection::All).unwrap().data {
        LegacyData::Grid(grid) => grid,
        LegacyData::PolyData(data) => panic!("{data:?}"),
    }
}

#[test]
fn every_keyword_of_an_ascii_file() {
    let grid = grid(legacy::old_grid());
    assert_eq!(grid.points.values, vec![0f32, 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1.].into());
    assert!(grid.cells.offsets().eq([0, 4, 7]));
    assert_eq!(grid.types, [10, 5]);
    let point = |name: &str| grid.point_data.get(name).unwrap();
    assert_eq!(format!("{:?}", point("s 1").values), "F64([0.001, NaN, -inf, 4.0])");
    assert_eq!(point("v").component_names, ["x", "", "z z"]);
    assert_eq!(point("n").values.to_f64().unwrap()[11], 12.0);
    assert_eq!((point("t").components, point("uv").components), (9, 2));
    assert_eq!(
        point("rgb").values,
        vec![0u8, 128, 255, 0, 0, 0, 255, 255, 255, 51, 102, 153].into()
    );
    assert_eq!(point("s2").values, vec![1i32, 2, 3, 4, 5, 6, 7, 8].into());
    assert_eq!(grid.cell_data.get("id").unwrap().values, vec![7i64, -8].into());
    assert_eq!(grid.cell_data.get("bits").unwrap().values, vec![0u8, 1, 1, 0, 0, 1].into());
    assert_eq!(grid.field_data.get("TimeValue").unwrap().values, vec![0.25].into());
    let names = Values::Strings(vec![String::from("a b"), String::new()]);
    assert_eq!(grid.field_data.get("names").unwrap().values, names);
    for (role, name) in [
        (AttributeKind::Scalars, "s 1"),
        (AttributeKind::Vectors, "v"),
        (AttributeKind::Normals, "n"),
        (AttributeKind::Tensors, "t"),
        (AttributeKind::TCoords, "uv"),
        (AttributeKind::GlobalIds, "g"),
    ] {
        assert_eq!(grid.point_data.active(role).unwrap().name, name);
    }
}

#[test]
fn nothing_is_lost_in_silence() {
    let loaded = open(legacy::old_grid()).read(&Selection::All).unwrap();
    assert_eq!(loaded.warnings, ["lookup table 'table' left out: colours are no data"]);
    let text = String::from_utf8(legacy::old_grid()).unwrap();
    let warnings =
        |text: &str| open(text.into()).read(&Selection::All).unwrap().warnings.join("\n");
    let longer = text.replace("bits 3 2 bit\n0 1 1\n0 0 1", "bits 3 1 bit\n0 1 1");
    assert!(warnings(&longer).contains("CellData array 'bits' left out: 1 tuples where 2"));
    assert!(warnings(&text.replace("s2", "uv")).contains("several arrays 'uv': the last is taken"));
    assert!(warnings(text.trim_end()).contains("its last number may be cut"));
}

#[test]
fn version_five_has_offsets() {
    let grid = grid(legacy::new_grid());
    assert!(grid.cells.offsets().eq([0, 4, 7]));
    assert_eq!(grid.cells.connectivity(), [0, 1, 2, 3, 0, 1, 2]);
    assert_eq!(grid.point_data.get("u").unwrap().values, vec![1u64, 2, 3, u64::MAX].into());
    assert_eq!(grid.point_data.get("c").unwrap().values, vec![1i8, -2, 3, -4, 5, -6, 7, -8].into());
}

#[test]
fn binary_numbers_are_big_endian() {
    let grid = grid(legacy::binary_grid());
    assert_eq!(grid.points.values.to_f64().unwrap()[3], 1.0);
    assert_eq!((grid.cells.connectivity(), &grid.types[..]), (&[0i64, 1, 2, 3][..], &[10u8][..]));
    let point = |name: &str| grid.point_data.get(name).unwrap().values.clone();
    assert_eq!(point("s"), vec![1.5f32, -2.0, 3.0, 0.1].into());
    assert_eq!(point("i"), vec![1i64, -1, 1 << 30, 0].into());
    assert_eq!(point("t"), Values::Strings(["a", "", "b", "c"].map(String::from).to_vec()));
    assert_eq!(point("b"), vec![0u8, 1, 0, 1, 0, 1, 0, 1].into());
}

#[test]
fn polygonal_data_of_all_kinds() {
    let LegacyData::PolyData(data) = open(legacy::surface()).read(&Selection::All).unwrap().data
    else {
        panic!("not polygonal data")
    };
    let PolyData { verts, lines, polys, strips, .. } = &data;
    assert_eq!([verts, lines, polys, strips].map(|cells| cells.connectivity().len()), [1, 2, 3, 4]);
    assert_eq!(data.points.values.to_f64().unwrap()[9..], [1.0, 1.0, 0.0]);
    assert_eq!(data.cell_data.get("s").unwrap().values, vec![1i32, 2, 3, 4].into());
    let counts = open(legacy::surface()).description().pieces[0];
    assert_eq!((counts.verts, counts.lines, counts.polys, counts.strips), (1, 1, 1, 1));
}

#[test]
fn polyhedra_are_taken_out_of_their_lists() {
    let grid = grid(legacy::polyhedron());
    assert_eq!(grid.cells.connectivity(), [1, 2, 3, 4, 3, 2, 1, 0]);
    let polyhedra = grid.polyhedra.unwrap();
    assert!(polyhedra.cells.offsets().eq([0, 4, 4]));
    assert_eq!(polyhedra.faces.get(0), Some(&[4i64, 2, 1][..]));
    let text = String::from_utf8(legacy::polyhedron()).unwrap();
    for bad in ["4 9 4 2 1", "4 3 5 2 1", "4 3 4 2 -1"] {
        let file = LegacyFile::from_bytes("x", text.replace("4 3 4 2 1", bad).into());
        assert!(file.unwrap().read(&Selection::All).is_err(), "{bad}");
    }
}

#[test]
fn only_selected_arrays_are_decoded() {
    let text = String::from_utf8(legacy::old_grid()).unwrap();
    let file = open(text.replace("1e-3 nan", "1e-3 x").into());
    let error = file.read(&Selection::All).unwrap_err().to_string();
    assert!(error.contains("'s 1' of PointData: 'x' at byte"), "{error}");
    let data = file.read(&Selection::named(["v"], [""; 0])).unwrap().data.into_grid();
    assert_eq!((data.point_data.len(), data.cell_data.len()), (1, 0));
    let points = ["v", "q"].map(String::from).to_vec();
    let at_most = file.read(&Selection::AtMost { points, cells: vec![] }).unwrap();
    assert_eq!(at_most.data.into_grid(), data);
    let error = file.read(&Selection::named(["q"], [""; 0])).unwrap_err();
    assert!(matches!(error, VtkError::MissingArray { .. }), "{error}");
    assert_eq!(file.description().point_arrays[0].name, "s 1");
}

#[test]
fn what_is_wrong_is_named_with_its_place() {
    let text = String::from_utf8(legacy::old_grid()).unwrap();
    let message = |old: &str, new: &str| {
        assert!(text.contains(old));
        let file = LegacyFile::from_bytes("x.vtk", text.replacen(old, new, 1).into());
        let read = file.and_then(|file| file.read(&Selection::All).map(drop));
        read.unwrap_err().to_string()
    };
    for (old, new, expected) in [
        ("ASCII", "EBCDIC", "'EBCDIC' where ASCII or BINARY should be, at byte 43"),
        ("UNSTRUCTURED_GRID", "RECTILINEAR_GRID", "holds a RECTILINEAR_GRID"),
        ("POINTS 4", "POINTS 5", "should be"),
        ("POINTS 4 float", "POINTS 4 half", "array 'Points': unknown type 'half'"),
        ("POINTS 4", "POINTS four", "'four' where the number of points should be"),
        ("CELLS 2 9", "CELLS 2 8", "should be"),
        ("3 0 1 2\nCELL", "3 0 1 4\nCELL", "outside 0..4"),
        ("CELL_TYPES 2\n10", "CELL_TYPES 2\n256", "256 is no index"),
        ("POINT_DATA 4", "POINT_DATA 3", "should be"),
        ("NORMALS", "ABNORMALS", "'ABNORMALS' where a keyword such as SCALARS or FIELD should be"),
        ("LOOKUP_TABLE default\n7", "7", "LOOKUP_TABLE"),
        ("POINTS 4 float", "POINTS 1152921504606846976 float", "the file ends where the rest"),
    ] {
        let message = message(old, new);
        assert!(message.contains(expected), "{new}: {message}");
        assert!(message.starts_with("'x.vtk'"), "{message}");
    }
    let few = text.split("CELL_TYPES").next().unwrap();
    let error = LegacyFile::from_bytes("x.vtk", few.into()).unwrap_err();
    let expected = LegacyProblem::Ends { expected: "CELL_TYPES" };
    assert!(matches!(error, VtkError::Legacy { problem, .. } if problem == expected));
    let error = LegacyFile::from_bytes("x.vtk", b"<VTKFile/>".to_vec()).unwrap_err();
    assert!(matches!(error, VtkError::NotVtk { .. }), "{error}");
}
