//! Lists of files: pieces and series, written and read back.

mod vtk_common;

use std::path::Path;
use vtk_common::{sample, variants};
use vtu2contour::vtk::{
    AnyFile, AttributeKind, DataArray, Declaration, Encoding, Floats, PolyData, PvdEntry, PvdFile,
    PvtpFile, PvtuFile, Selection, UnstructuredGrid, VtkError, VtuFile, WriteOptions, read_grid,
    write_pvd, write_pvtp, write_pvtu, write_vtp, write_vtu,
};

/// A tetrahedron whose points and data count from `first`.
fn tetrahedron(first: i32) -> UnstructuredGrid {
    let points: Vec<f64> = (first..first + 12).map(f64::from).collect();
    let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, points));
    grid.push_cell(10, &[0, 1, 2, 3]);
    let values: Vec<i32> = (first..first + 4).collect();
    grid.point_data.push(DataArray::new("a <i>", 1, values));
    grid.point_data.set_active(AttributeKind::Scalars, "a <i>");
    grid.cell_data.push(DataArray::new("vtkGhostType", 1, vec![first as u8]));
    grid.field_data.push(DataArray::new("TimeValue", 1, vec![f64::from(first)]));
    grid
}

fn empty() -> UnstructuredGrid {
    UnstructuredGrid::new(DataArray::new("Points", 3, Vec::<f64>::new()))
}

/// Writes the pieces into a folder of their own, and their list beside it.
fn write_pieces(folder: &Path, pieces: &[UnstructuredGrid]) -> std::path::PathBuf {
    std::fs::create_dir_all(folder.join("parts")).unwrap();
    let name = |index: usize| folder.join(format!("parts/ä {index}.vtu"));
    let encodings = [Encoding::Raw, Encoding::Zlib, Encoding::Ascii, Encoding::Base64];
    for (index, piece) in pieces.iter().enumerate() {
        write_vtu(name(index), piece, encodings[index % 4].into()).unwrap();
    }
    let list = folder.join("x.pvtu");
    let names: Vec<_> = (0..pieces.len()).map(name).collect();
    let declaration = Declaration::of_grid(&tetrahedron(0), Floats::AsGiven);
    write_pvtu(&list, &names, &declaration).unwrap();
    list
}

#[test]
fn pieces_are_joined_or_streamed() {
    let folder = tempfile::tempdir().unwrap();
    let pieces = [empty(), tetrahedron(0), empty(), tetrahedron(20), tetrahedron(40)];
    let list = write_pieces(folder.path(), &pieces);
    let text = std::fs::read_to_string(&list).unwrap();
    assert!(text.contains("<Piece Source=\"parts/ä 0.vtu\"/>"), "{text}");
    let file = PvtuFile::open(&list).unwrap();
    let loaded = file.read(&Selection::All).unwrap();
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    let grid = loaded.data;
    assert_eq!(grid.cells.connectivity(), (0..12).collect::<Vec<i64>>());
    let scalars = grid.point_data.active(AttributeKind::Scalars).unwrap();
    assert_eq!(scalars.values, vec![0i32, 1, 2, 3, 20, 21, 22, 23, 40, 41, 42, 43].into());
    assert_eq!(grid.cell_data.get("vtkGhostType").unwrap().values, vec![0u8, 20, 40].into());
    assert_eq!(grid.field_data.get("TimeValue").unwrap().values, vec![0.0].into());
    assert_eq!(read_grid(&list, &Selection::All).unwrap().data, grid);
    let description = file.description().unwrap();
    assert_eq!((description.points(), description.cells()), (12, 3));
    assert_eq!(description.pieces.len(), 5);
    let any = AnyFile::open(&list).unwrap();
    assert_eq!(any.piece_paths(), file.piece_paths());
    let piece = |index| any.read_piece(index, &Selection::All).unwrap().data;
    assert_eq!((0..5).map(piece).collect::<Vec<_>>(), pieces);
    let read = |file: Result<VtuFile, _>| file.unwrap().read(&Selection::All).unwrap().data;
    let streamed: Vec<_> = file.pieces().map(read).collect();
    assert_eq!(streamed, pieces);
    assert!(file.piece_paths()[4].ends_with("parts/ä 4.vtu"));
}

#[test]
fn arrays_that_are_not_everywhere_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    let mut other = tetrahedron(20);
    other.point_data = [DataArray::new("b", 1, vec![0f32; 4])].into_iter().collect();
    let mut pieces = [tetrahedron(0), other];
    for piece in &mut pieces {
        piece.cell_data = [DataArray::new("c", 1, vec![1i8])].into_iter().collect();
    }
    let file = PvtuFile::open(write_pieces(folder.path(), &pieces)).unwrap();
    let loaded = file.read(&Selection::All).unwrap();
    assert!(loaded.data.point_data.is_empty());
    assert_eq!(loaded.data.cell_data.len(), 1);
    let expected = [
        "PointData array 'a <i>' left out: not every piece has it",
        "PointData array 'b' left out: not every piece has it",
        "CellData array 'vtkGhostType' left out: it is declared, but no piece has it",
        "CellData array 'c' is in every piece, but not declared: it is read",
    ];
    assert_eq!(loaded.warnings, expected);
    assert_eq!(file.description().unwrap().warnings, expected);
    assert!(file.read(&Selection::named([""; 0], ["c"])).unwrap().warnings.is_empty());
    let error = file.read(&Selection::named(["b"], [""; 0])).unwrap_err();
    assert!(matches!(error, VtkError::UnusableArray { .. }), "{error}");
}

#[test]
fn bad_pieces_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let list = write_pieces(folder.path(), &[tetrahedron(0), tetrahedron(20)]);
    let second = folder.path().join("parts/ä 1.vtu");
    let message = || {
        let file = PvtuFile::open(&list).unwrap();
        assert_eq!(file.pieces().filter(Result::is_err).count(), 1);
        assert!(file.description().is_err());
        file.read(&Selection::All).unwrap_err().to_string()
    };
    std::fs::write(&second, "<VTKFile type='PolyData'/>").unwrap();
    assert!(message().contains("1.vtu' holds a VTK PolyData"), "{}", message());
    std::fs::remove_file(&second).unwrap();
    assert!(message().contains("x.pvtu' lists a file that cannot be read"), "{}", message());
    assert!(message().contains("ä 1.vtu"), "{}", message());
    std::fs::create_dir(&second).unwrap();
    assert!(message().contains("no regular file"), "{}", message());
}

#[test]
fn pieces_without_a_name_of_their_own_are_refused() {
    for pieces in ["<Piece/>", "<Piece Source='a'/><Piece Source='a'/>"] {
        let text = format!(
            "<VTKFile type='PUnstructuredGrid'><PUnstructuredGrid>{pieces}</PUnstructuredGrid>\
             </VTKFile>"
        );
        let error = PvtuFile::from_bytes("x.pvtu", text.into_bytes()).unwrap_err();
        assert!(error.to_string().contains("not named before"), "{error}");
    }
}

#[test]
fn names_may_be_absolute_or_lead_out_of_the_folder() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("lists")).unwrap();
    let piece = folder.path().join("a.vtu");
    std::fs::write(&piece, sample(variants()[0])).unwrap();
    for source in ["../a.vtu", piece.to_str().unwrap()] {
        let text = format!(
            "<VTKFile type='PUnstructuredGrid'><PUnstructuredGrid><Piece Source='{source}'/>\
             </PUnstructuredGrid></VTKFile>"
        );
        let name = folder.path().join("lists/x.pvtu");
        let file = PvtuFile::from_bytes(name, text.into_bytes()).unwrap();
        assert_eq!(file.read(&Selection::All).unwrap().data.points.tuples(), 5, "{source}");
    }
    let list = folder.path().join("lists/y.pvtu");
    let declaration = Declaration::of_grid(&tetrahedron(0), Floats::AsGiven);
    write_pvtu(&list, &[&piece], &declaration).unwrap();
    assert!(std::fs::read_to_string(&list).unwrap().contains("Source=\"../a.vtu\""));
}

#[test]
fn field_data_of_the_list_come_before_those_of_the_pieces() {
    let folder = tempfile::tempdir().unwrap();
    let list = write_pieces(folder.path(), &[empty(), tetrahedron(7), tetrahedron(9)]);
    let time = |text: &str| {
        let file = PvtuFile::from_bytes(&list, text.to_owned().into_bytes()).unwrap();
        let all = &Selection::All;
        let [joined, second] = [file.read(all), file.read_piece(1, all)]
            .map(|read| read.unwrap().data.field_data.get("TimeValue").unwrap().values.clone());
        assert_eq!(joined, second);
        joined
    };
    let text = std::fs::read_to_string(&list).unwrap();
    assert_eq!(time(&text), vec![7.0].into());
    let field = "<FieldData><DataArray type=\"Int8\" Name=\"TimeValue\" NumberOfTuples=\"1\">\
                 5</DataArray></FieldData><PPointData";
    assert_eq!(time(&text.replace("<PPointData", field)), vec![5i8].into());
}

#[test]
fn surfaces_in_pieces() {
    let folder = tempfile::tempdir().unwrap();
    let mut names = Vec::new();
    let options = WriteOptions { floats: Floats::Single, ..WriteOptions::default() };
    let mut data = PolyData::new(DataArray::new("Points", 3, vec![0.5f64; 9]));
    data.polys.push(&[0, 1, 2]);
    data.point_data.push(DataArray::new("v", 3, vec![1.0f64; 9]));
    for index in 0..3 {
        names.push(folder.path().join(format!("{index}.vtp")));
        write_vtp(&names[index], &data, options).unwrap();
    }
    let list = folder.path().join("x.pvtp");
    write_pvtp(&list, &names, &Declaration::of_poly_data(&data, options.floats)).unwrap();
    let text = std::fs::read_to_string(&list).unwrap();
    let declared = "<PDataArray type=\"Float32\" Name=\"v\" NumberOfComponents=\"3\"/>";
    assert!(text.contains(declared), "{text}");
    let loaded = PvtpFile::open(&list).unwrap().read(&Selection::All).unwrap();
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    assert_eq!(loaded.data.polys.connectivity(), [0, 1, 2, 3, 4, 5, 6, 7, 8]);
    assert_eq!(PvtpFile::open(&list).unwrap().pieces().len(), 3);
    let piece = AnyFile::open(&list).unwrap().read_piece(2, &Selection::All).unwrap().data;
    assert_eq!(piece.cells.connectivity(), [0, 1, 2]);
}

#[test]
fn series_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let list = folder.path().join("x.pvd");
    let entries = vec![
        PvdEntry::new(0.1, folder.path().join("a & b.vtu")),
        PvdEntry::new(-1e300, folder.path().join("parts/c.vtp")),
        PvdEntry {
            time: None,
            part: 7,
            group: String::from("g"),
            file: folder.path().join("d.vtk"),
        },
    ];
    write_pvd(&list, &entries).unwrap();
    assert_eq!(PvdFile::open(&list).unwrap().entries(), entries);
    let error = read_grid(&list, &Selection::All).unwrap_err();
    assert!(matches!(error, VtkError::Series { .. }), "{error}");
    assert!(error.to_string().contains("is a series of files"), "{error}");
}

#[test]
fn entries_of_a_series_are_opened_by_what_they_hold() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let list = path("x.pvd");
    write_vtu(path("grid.vtk"), &tetrahedron(0), WriteOptions::default()).unwrap();
    std::fs::create_dir(path("folder")).unwrap();
    let names = ["grid.vtk", "missing.vtu", "x.pvd", "folder"];
    let entries: Vec<_> = names.iter().map(|name| PvdEntry::new(0.0, path(name))).collect();
    write_pvd(&list, &entries).unwrap();
    let AnyFile::Pvd(series) = AnyFile::open(&list).unwrap() else { panic!("no series") };
    let open = |entry: usize| series.open_entry(&series.entries()[entry]);
    assert!(matches!(open(0).unwrap(), AnyFile::Vtu(_)));
    for (entry, reason) in [(1, "missing.vtu"), (2, "is a series of files"), (3, "no regular file")]
    {
        let message = open(entry).unwrap_err().to_string();
        assert!(message.contains("x.pvd' lists a file that cannot be read"), "{message}");
        assert!(message.contains(reason), "{message}");
    }
}
