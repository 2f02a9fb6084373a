//! Files of several pieces, joined; written by hand.

use vtu2contour::vtk::{Selection, UnstructuredGrid, VtkError, VtpFile, VtuFile};

fn array(kind: &str, name: &str, components: usize, values: &str) -> String {
    format!(
        "<DataArray type='{kind}' Name='{name}' NumberOfComponents='{components}' \
         format='ascii'>{values}</DataArray>"
    )
}

fn cells(section: &str, connectivity: &str, offsets: &str) -> String {
    let connectivity = array("Int32", "connectivity", 1, connectivity);
    let offsets = array("Int64", "offsets", 1, offsets);
    format!("<{section}>{connectivity}{offsets}</{section}>")
}

fn points(values: &str) -> String {
    format!("<Points>{}</Points>", array("Float32", "P", 3, values))
}

/// A piece of two points, with a vertex, a line and two strips in one of two orders.
fn surface_piece(first: usize) -> String {
    let ids: Vec<String> = (first..first + 4).map(|id| id.to_string()).collect();
    let data = array("Int32", "id", 1, &ids.join(" "));
    let pairs = array("Int8", "pair", 2, "1 2 3 4 5 6 7 8");
    [
        "<Piece NumberOfPoints='2' NumberOfVerts='1' NumberOfLines='1' NumberOfStrips='2'>",
        &points("0 0 0 1 1 1"),
        &cells("Strips", "0 1 1 0", "2 4"),
        &cells("Lines", "1 0", "2"),
        &cells("Verts", "1", "1"),
        &format!("<CellData>{data}{pairs}</CellData></Piece>"),
    ]
    .concat()
}

#[test]
fn cells_of_a_kind_come_together_and_take_their_data_along() {
    let pieces = [surface_piece(0), surface_piece(10)].concat();
    let text = format!("<VTKFile type='PolyData'><PolyData>{pieces}</PolyData></VTKFile>");
    let file = VtpFile::from_bytes("x.vtp", text.into_bytes()).unwrap();
    assert_eq!(file.description().unwrap().cells(), 8);
    let data = file.read(&Selection::All).unwrap().data;
    assert_eq!(data.points.tuples(), 4);
    assert_eq!(data.verts.connectivity(), [1, 3]);
    assert_eq!(data.lines.connectivity(), [1, 0, 3, 2]);
    assert_eq!(data.strips.connectivity(), [0, 1, 1, 0, 2, 3, 3, 2]);
    assert!(data.strips.offsets().eq([0, 2, 4, 6, 8]));
    let ids = data.cell_data.get("id").unwrap();
    assert_eq!(ids.values, vec![0i32, 10, 1, 11, 2, 3, 12, 13].into());
    let pairs = data.cell_data.get("pair").unwrap();
    let expected = vec![1i8, 2, 1, 2, 3, 4, 3, 4, 5, 6, 7, 8, 5, 6, 7, 8];
    assert_eq!(pairs.values, expected.into());
}

/// A grid of pieces, each given by its point arrays (none: an empty piece).
fn grid(pieces: &[Option<String>]) -> VtuFile {
    let piece = |arrays: &Option<String>| match arrays {
        None => String::from("<Piece NumberOfPoints='0' NumberOfCells='0'/>"),
        Some(arrays) => [
            "<Piece NumberOfPoints='2' NumberOfCells='1'>",
            &format!("<PointData Scalars='s'>{arrays}</PointData>"),
            &points("0 0 0 1 1 1"),
            &cells("Cells", "0 1", "2").replace("</Cells>", &array("UInt8", "types", 1, "3")),
            "</Cells></Piece>",
        ]
        .concat(),
    };
    let pieces: String = pieces.iter().map(piece).collect();
    let text = format!(
        "<VTKFile type='UnstructuredGrid'><UnstructuredGrid>{pieces}</UnstructuredGrid></VTKFile>"
    );
    VtuFile::from_bytes("x.vtu", text.into_bytes()).unwrap()
}

#[test]
fn empty_pieces_are_passed_over() {
    let s = |values| Some(array("Int16", "s", 1, values));
    let file = grid(&[None, s("1 2"), None, s("3 4"), None]);
    let loaded = file.read(&Selection::All).unwrap();
    assert!(loaded.warnings.is_empty());
    assert_eq!(loaded.data.cells.connectivity(), [0, 1, 2, 3]);
    let values = &loaded.data.point_data.get("s").unwrap().values;
    assert_eq!(*values, vec![1i16, 2, 3, 4].into());
    assert_eq!(file.description().unwrap().pieces.len(), 5);
    let nothing = grid(&[None]).read(&Selection::All).unwrap().data;
    assert_eq!((nothing.points.tuples(), nothing.cells.len()), (0, 0));
}

#[test]
fn arrays_of_some_pieces_are_left_out_and_reported() {
    let s = array("Int16", "s", 1, "1 2");
    let both = format!("{s}{}", array("Int8", "t", 1, "5 6"));
    let other = array("Int32", "s", 1, "3 4");
    let file = grid(&[Some(both), Some(other)]);
    let loaded = file.read(&Selection::All).unwrap();
    assert!(loaded.data.point_data.is_empty());
    assert!(loaded.data.point_data.active_names().is_empty());
    let warnings = loaded.warnings.join("\n");
    assert!(warnings.contains("'s' left out: its type or components differ"), "{warnings}");
    assert!(warnings.contains("'t' left out: not every piece has it"), "{warnings}");
    let error = file.read(&Selection::named(["t"], [""; 0])).unwrap_err();
    assert!(matches!(error, VtkError::UnusableArray { .. }), "{error}");
    let none = file.read(&Selection::none()).unwrap();
    assert!(none.warnings.is_empty());
}

#[test]
fn arrays_of_the_wrong_length_are_left_out_or_refused() {
    let arrays = [array("Int16", "s", 1, "1 2 3"), array("Int16", "t", 1, "1 2")].concat();
    let file = grid(&[Some(arrays)]);
    let loaded = file.read(&Selection::All).unwrap();
    assert_eq!(loaded.data.point_data.len(), 1);
    assert!(loaded.data.point_data.active_names().is_empty());
    assert!(loaded.warnings[0].contains("3 values where 2 are expected"));
    let at_most = |names: &[&str]| {
        let points = names.iter().map(|name| name.to_string()).collect();
        let loaded = file.read(&Selection::AtMost { points, cells: vec![] }).unwrap();
        (loaded.data.point_data.len(), loaded.warnings.len())
    };
    assert_eq!(at_most(&["s", "t"]), (1, 1));
    assert_eq!((at_most(&["s", "x"]), at_most(&["t", "x"])), ((0, 1), (1, 0)));
    let error = file.read(&Selection::named(["s"], [""; 0])).unwrap_err();
    assert_eq!(error.to_string(), "'x.vtu': array 's' of PointData: 3 values where 2 are expected");
}

#[test]
fn unknown_types_and_formats_are_named() {
    let arrays = array("Float16", "h", 1, "1 2");
    let file = grid(&[Some(arrays)]);
    let loaded = file.read(&Selection::All).unwrap();
    assert!(loaded.warnings[0].contains("unknown type 'Float16'"));
    assert!(file.read(&Selection::named(["h"], [""; 0])).is_err());
    let arrays = array("Int8", "z", 1, "1 2").replace("ascii", "morse");
    let error = grid(&[Some(arrays)]).read(&Selection::All).unwrap_err();
    assert!(error.to_string().contains("unknown format 'morse'"), "{error}");
}

/// The faces of a tetrahedron, as VTK writes them before 9.4 and after.
fn face_arrays(new_form: bool, point: i64) -> String {
    if new_form {
        let points = format!("0 2 1 0 1 3 1 2 3 0 3 {point}");
        return [
            array("Int64", "face_connectivity", 1, &points),
            array("Int64", "face_offsets", 1, "3 6 9 12"),
            array("Int64", "polyhedron_to_faces", 1, "0 1 2 3"),
            array("Int64", "polyhedron_offsets", 1, "0 4"),
        ]
        .concat();
    }
    let stream = format!("4 3 0 2 1 3 0 1 3 3 1 2 3 3 0 3 {point}");
    [array("Int64", "faces", 1, &stream), array("Int64", "faceoffsets", 1, "-1 17")].concat()
}

/// Two pieces of a tetrahedron and a polyhedron each; and one without polyhedra between.
fn polyhedra(new_form: bool, point: i64) -> Result<UnstructuredGrid, VtkError> {
    let piece = |cells: &str, faces: &str| {
        let points = points("0 0 0 1 0 0 0 1 0 0 0 1");
        let cells = cells.replace("</Cells>", faces) + "</Cells>";
        format!("<Piece NumberOfPoints='4' NumberOfCells='2'>{points}{cells}</Piece>")
    };
    let lists = cells("Cells", "0 1 2 3 0 1 2 3", "4 8");
    let with = array("UInt8", "types", 1, "10 42") + &face_arrays(new_form, point);
    let without = array("UInt8", "types", 1, "10 10");
    let pieces = [piece(&lists, &with), piece(&lists, &without), piece(&lists, &with)].concat();
    let text = format!(
        "<VTKFile type='UnstructuredGrid'><UnstructuredGrid>{pieces}</UnstructuredGrid></VTKFile>"
    );
    let file = VtuFile::from_bytes("x.vtu", text.into_bytes())?;
    file.read(&Selection::All).map(|loaded| loaded.data)
}

#[test]
fn both_forms_of_polyhedra_are_joined() {
    for new_form in [false, true] {
        let polyhedra = polyhedra(new_form, 2).unwrap().polyhedra.unwrap();
        assert!(polyhedra.cells.offsets().eq([0, 0, 4, 4, 4, 4, 8]));
        assert_eq!(polyhedra.cells.connectivity(), [0, 1, 2, 3, 4, 5, 6, 7]);
        assert_eq!(polyhedra.faces.len(), 8);
        assert_eq!(polyhedra.faces.get(3), Some(&[0i64, 3, 2][..]));
        assert_eq!(polyhedra.faces.get(7), Some(&[8i64, 11, 10][..]));
    }
}

#[test]
fn faces_of_points_that_are_not_there_are_refused() {
    for new_form in [false, true] {
        for point in [4, -1] {
            let message = polyhedra(new_form, point).unwrap_err().to_string();
            assert!(message.contains("outside 0..4"), "{message}");
        }
    }
}
