//! Every variant of the format, written by an encoder that is not the library's.

mod vtk_common;

use vtk_common::{Format, sample, variants};
use vtu2contour::vtk::{ArrayType, AttributeKind, Selection, UnstructuredGrid, Values, VtuFile};

fn read(bytes: Vec<u8>, selection: &Selection) -> UnstructuredGrid {
    let file = VtuFile::from_bytes("sample.vtu", bytes).unwrap();
    let loaded = file.read(selection).unwrap();
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    loaded.data
}

fn check(grid: &UnstructuredGrid) {
    assert_eq!(grid.points.tuples(), 5);
    assert_eq!(grid.points.component(0).unwrap(), [0.0, 2.0, 1.0, 4.0, 4.0]);
    assert!(grid.cells.offsets().eq([0, 4, 7, 10]));
    assert_eq!(grid.cells.connectivity(), [0, 1, 2, 3, 0, 1, 2, 2, 3, 4]);
    assert_eq!(grid.types, [10, 5, 5]);
    let point = |name: &str| grid.point_data.get(name).unwrap().values.clone();
    let cell = |name: &str| grid.cell_data.get(name).unwrap().values.clone();
    assert_eq!(point("a <f64>"), vec![0.1, -2e-300, 3e300, 0.0, 5.0].into());
    let thirds: Vec<f32> = (0..15).map(|i| i as f32 / 7.0).collect();
    assert_eq!(point("f32"), thirds.into());
    assert_eq!(point("i8"), vec![-128i8, -1, 0, 1, 127].into());
    assert_eq!(point("u8"), vec![0u8, 1, 2, 254, 255].into());
    assert_eq!(point("i16"), vec![-32768i16, -2, -1, 0, 1, 2, 3, 4, 5, 32767].into());
    assert_eq!(point("u16"), vec![0u16, 1, 2, 3, 65535].into());
    assert_eq!(cell("i32"), vec![i32::MIN, 0, i32::MAX].into());
    assert_eq!(cell("u32"), vec![0, 1, u32::MAX].into());
    assert_eq!(cell("i64"), vec![i64::MIN, 0, i64::MAX].into());
    assert_eq!(cell("u64"), vec![0, 1, u64::MAX].into());
    assert_eq!(grid.field_data.get("TimeValue").unwrap().values, vec![0.25].into());
    let active = grid.point_data.active(AttributeKind::Scalars).unwrap();
    assert_eq!(active.name, "a <f64>");
}

#[test]
fn every_variant_is_read() {
    for variant in variants() {
        println!("{variant:?}");
        check(&read(sample(variant), &Selection::All));
    }
}

#[test]
fn descriptions_need_no_decoding() {
    for variant in variants() {
        // Spoil the data, where that does not touch the XML.
        let mut bytes = sample(variant);
        if variant.format == Format::AppendedRaw {
            let mark = bytes.windows(2).position(|pair| pair == b">_").unwrap() + 1;
            let end = bytes.len() - "</AppendedData></VTKFile>".len();
            bytes[mark + 1..end].fill(0xFF);
        }
        let file = VtuFile::from_bytes("sample.vtu", bytes).unwrap();
        let description = file.description().unwrap();
        assert_eq!((description.points(), description.cells()), (5, 3));
        let arrays = description.point_arrays.iter();
        let arrays: Vec<_> = arrays.map(|a| (&a.name[..], a.array_type, a.components)).collect();
        assert_eq!(arrays[0], ("a <f64>", ArrayType::F64, 1));
        assert_eq!(arrays[1], ("f32", ArrayType::F32, 3));
        assert_eq!(description.point_arrays[0].active, [AttributeKind::Scalars]);
        assert_eq!(description.cell_arrays.len(), 4);
        assert_eq!(description.field_arrays[0].name, "TimeValue");
    }
}

#[test]
fn arrays_that_are_not_selected_are_not_decoded() {
    for variant in variants().into_iter().filter(|v| v.format == Format::Ascii) {
        let text = String::from_utf8(sample(variant)).unwrap();
        let spoiled = text.replace("-128", "x128").into_bytes();
        let file = VtuFile::from_bytes("sample.vtu", spoiled.clone()).unwrap();
        let message = file.read(&Selection::All).unwrap_err().to_string();
        assert!(message.contains("'i8' of PointData: 'x128' at byte"), "{message}");
        let grid = read(spoiled, &Selection::named(["f32"], ["u64"]));
        assert_eq!((grid.point_data.len(), grid.cell_data.len()), (1, 1));
        assert!(grid.point_data.active(AttributeKind::Scalars).is_none());
    }
}

#[test]
fn missing_arrays_are_named_with_those_there_are() {
    let file = VtuFile::from_bytes("sample.vtu", sample(variants()[0])).unwrap();
    let error = file.read(&Selection::named(["nope"], [""; 0])).unwrap_err();
    let expected = "'sample.vtu' has no array 'nope' in PointData; \
        it has 'a <f64>', 'f32', 'i8', 'u8', 'i16', 'u16'";
    assert_eq!(error.to_string(), expected);
}

#[test]
fn strings_and_bits_are_read() {
    let text = "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><FieldData>\
        <Array type='String' Name='s' NumberOfTuples='2' format='ascii'>104 0 0</Array>\
        <DataArray type='Bit' Name='b' NumberOfTuples='5' format='binary'>AQAAAFA=</DataArray>\
        </FieldData></UnstructuredGrid></VTKFile>";
    let grid = read(text.as_bytes().to_vec(), &Selection::All);
    let strings = Values::Strings(vec![String::from("h"), String::new()]);
    assert_eq!(grid.field_data.get("s").unwrap().values, strings);
    let bits = vec![0u8, 1, 0, 1, 0].into();
    assert_eq!(grid.field_data.get("b").unwrap().values, bits);
}
