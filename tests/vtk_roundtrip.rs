//! Random data written in every encoding and read back.

use proptest::collection::vec;
use proptest::prelude::*;
use vtu2contour::vtk::{
    AttributeKind, Attributes, CellArray, DataArray, Encoding, Floats, PolyData, Polyhedra,
    Selection, UnstructuredGrid, Values, VtkError, VtpFile, VtuFile, WriteOptions, write_vtp,
    write_vtp_to, write_vtu, write_vtu_to,
};

const ENCODINGS: [Encoding; 6] = [
    Encoding::Raw,
    Encoding::Zlib,
    Encoding::Lz4,
    Encoding::Lzma,
    Encoding::Base64,
    Encoding::Ascii,
];

fn values(count: usize) -> BoxedStrategy<Values> {
    let float = prop_oneof![any::<f64>(), Just(f64::NAN), Just(-0.0), Just(f64::NEG_INFINITY)];
    prop_oneof![
        vec(any::<i8>(), count).prop_map(Values::from),
        vec(any::<u8>(), count).prop_map(Values::from),
        vec(any::<i16>(), count).prop_map(Values::from),
        vec(any::<u16>(), count).prop_map(Values::from),
        vec(any::<i32>(), count).prop_map(Values::from),
        vec(any::<u32>(), count).prop_map(Values::from),
        vec(any::<i64>(), count).prop_map(Values::from),
        vec(any::<u64>(), count).prop_map(Values::from),
        vec(any::<f32>(), count).prop_map(Values::from),
        vec(float, count).prop_map(Values::from),
        vec("[^\0]{0,5}", count).prop_map(Values::from),
    ]
    .boxed()
}

/// Names of all sorts but for control characters, which XML cannot hold.
const NAME: &str = "[ -~éß∇\t\n\r]{0,9}";

fn array(tuples: usize) -> impl Strategy<Value = DataArray> {
    (1usize..5, NAME, vec(NAME, 0..4)).prop_flat_map(move |(components, name, labels)| {
        values(tuples * components).prop_map(move |values| {
            let mut array = DataArray::new(name.clone(), components, values);
            array.component_names = labels.iter().take(components).cloned().collect();
            while array.component_names.last().is_some_and(String::is_empty) {
                array.component_names.pop();
            }
            array
        })
    })
}

fn attributes(tuples: usize) -> impl Strategy<Value = Attributes> {
    (vec(array(tuples), 0..4), any::<prop::sample::Index>()).prop_map(|(arrays, index)| {
        let mut set: Attributes = arrays.into_iter().collect();
        if !set.is_empty() {
            let name = set.iter().nth(index.index(set.len())).unwrap().name.clone();
            set.set_active(AttributeKind::Scalars, &name);
            set.set_active(AttributeKind::Tensors, &name);
        }
        set
    })
}

fn points(count: usize) -> BoxedStrategy<DataArray> {
    prop_oneof![
        vec(any::<f32>(), 3 * count).prop_map(|v| DataArray::new("Points", 3, v)),
        vec(any::<f64>(), 3 * count).prop_map(|v| DataArray::new("Points", 3, v)),
    ]
    .boxed()
}

/// Lists of indices below `bound`.
fn lists(bound: usize) -> BoxedStrategy<CellArray> {
    let index = 0..bound.max(1) as i64;
    let most = if bound == 0 { 0 } else { 6 };
    vec(vec(index, 0..=most), 0..6)
        .prop_map(|lists| {
            let mut cells = CellArray::new();
            lists.iter().for_each(|list| cells.push(list));
            cells
        })
        .boxed()
}

/// One face of each of the first cells, as far as the points reach.
fn polyhedra(cells: &CellArray, points: usize) -> Option<Polyhedra> {
    let mut polyhedra = Polyhedra::default();
    for cell in 0..cells.len() {
        if cell % 2 == 0 && points > 0 {
            let face = polyhedra.faces.len() as i64;
            polyhedra.faces.push(&[0, points as i64 - 1]);
            polyhedra.faces.push(&[]);
            polyhedra.cells.push(&[face, face + 1]);
        } else {
            polyhedra.cells.push(&[]);
        }
    }
    (points > 0 && !cells.is_empty()).then_some(polyhedra)
}

fn grid() -> impl Strategy<Value = UnstructuredGrid> {
    let sized =
        |count| (points(count), lists(count), attributes(count), attributes(2), any::<bool>());
    (0usize..9).prop_flat_map(sized).prop_flat_map(|parts| {
        let (points, cells, point_data, field_data, faces) = parts;
        let count = cells.len();
        (attributes(count), vec(any::<u8>(), count)).prop_map(move |(cell_data, types)| {
            let polyhedra = faces.then(|| polyhedra(&cells, points.tuples())).flatten();
            UnstructuredGrid {
                points: points.clone(),
                cells: cells.clone(),
                types,
                polyhedra,
                point_data: point_data.clone(),
                cell_data,
                field_data: without_roles(&field_data),
            }
        })
    })
}

/// Field data have no active arrays.
fn without_roles(set: &Attributes) -> Attributes {
    set.iter().cloned().collect()
}

fn poly_data() -> impl Strategy<Value = PolyData> {
    let sized = |n| (points(n), [lists(n), lists(n), lists(n), lists(n)], attributes(n));
    (0usize..9).prop_flat_map(sized).prop_flat_map(|(points, cells, point_data)| {
        let count = cells.iter().map(CellArray::len).sum();
        attributes(count).prop_map(move |cell_data| {
            let [verts, lines, polys, strips] = cells.clone();
            PolyData {
                points: points.clone(),
                verts,
                lines,
                polys,
                strips,
                point_data: point_data.clone(),
                cell_data,
                field_data: Attributes::new(),
            }
        })
    })
}

/// NaN differs from itself, but not its text.
fn same<T: std::fmt::Debug>(left: &T, right: &T) -> bool {
    format!("{left:?}") == format!("{right:?}")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn grids_come_back(grid in grid()) {
        for encoding in ENCODINGS {
            let mut bytes = Vec::new();
            write_vtu_to(&mut bytes, &grid, encoding.into()).unwrap();
            let text = String::from_utf8_lossy(&bytes).into_owned();
            let file = VtuFile::from_bytes("x.vtu", bytes).unwrap();
            let loaded = file.read(&Selection::All).unwrap_or_else(|e| panic!("{e}\n{text}"));
            prop_assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
            prop_assert!(same(&loaded.data, &grid), "{encoding:?}\n{:?}\n{grid:?}", loaded.data);
        }
    }

    #[test]
    fn poly_data_come_back(data in poly_data()) {
        for encoding in ENCODINGS {
            let mut bytes = Vec::new();
            write_vtp_to(&mut bytes, &data, encoding.into()).unwrap();
            let file = VtpFile::from_bytes("x.vtp", bytes).unwrap();
            let loaded = file.read(&Selection::All).unwrap();
            prop_assert!(same(&loaded.data, &data), "{encoding:?}\n{:?}\n{data:?}", loaded.data);
        }
    }
}

/// More values than a compressed block, a chunk of text and a wave of chunks hold.
fn large_grid() -> UnstructuredGrid {
    let count = 40_000;
    let points: Vec<f64> = (0..3 * count).map(|i| (i as f64).sin()).collect();
    let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, points));
    (0..count as i64 - 3).for_each(|i| grid.push_cell(10, &[i, i + 1, i + 2, i + 3]));
    let scalars: Vec<f32> = (0..count).map(|i| (i as f32).cos()).collect();
    grid.point_data.push(DataArray::new("s", 1, scalars));
    grid
}

#[test]
fn large_grids_come_back_from_files() {
    let grid = large_grid();
    let folder = tempfile::tempdir().unwrap();
    for encoding in ENCODINGS {
        let path = folder.path().join(format!("{encoding:?}.vtu"));
        write_vtu(&path, &grid, encoding.into()).unwrap();
        let loaded = VtuFile::open(&path).unwrap().read(&Selection::All).unwrap();
        assert!(loaded.data == grid, "{encoding:?}");
    }
}

#[test]
fn the_same_bytes_for_any_number_of_threads() {
    let grid = large_grid();
    for encoding in ENCODINGS {
        let write = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let mut bytes = Vec::new();
            let job = || write_vtu_to(&mut bytes, &grid, encoding.into());
            pool.unwrap().install(job).unwrap();
            bytes
        };
        assert!(write(1) == write(3), "{encoding:?}");
    }
}

#[test]
fn floats_in_another_precision() {
    let mut data = PolyData::new(DataArray::new("Points", 3, vec![0.1f64, 0.2, 0.3]));
    data.point_data.push(DataArray::new("s", 1, vec![0.5f32]));
    data.point_data.push(DataArray::new("i", 1, vec![5i64]));
    for encoding in ENCODINGS {
        let read = |floats| {
            let mut bytes = Vec::new();
            write_vtp_to(&mut bytes, &data, WriteOptions { encoding, floats }).unwrap();
            let file = VtpFile::from_bytes("x.vtp", bytes).unwrap();
            file.read(&Selection::All).unwrap().data
        };
        let single = read(Floats::Single);
        assert_eq!(single.points.values, vec![0.1f32, 0.2, 0.3].into());
        assert_eq!(single.point_data.get("i").unwrap().values, vec![5i64].into());
        let double = read(Floats::Double);
        assert_eq!(double.point_data.get("s").unwrap().values, vec![0.5f64].into());
    }
}

#[test]
fn contradicting_data_are_not_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x.vtp");
    let good = PolyData::new(DataArray::new("Points", 3, vec![0.0f32; 6]));
    let refuse = |change: fn(&mut PolyData)| {
        let mut data = good.clone();
        change(&mut data);
        let error = write_vtp(&path, &data, WriteOptions::default()).unwrap_err();
        assert!(matches!(error, VtkError::Inconsistent { .. }), "{error}");
        error.to_string()
    };
    let message = refuse(|data| data.point_data.push(DataArray::new("s", 1, vec![1.0f32])));
    assert!(message.contains("'s' of PointData: 1 values where 2"), "{message}");
    refuse(|data| data.cell_data.push(DataArray::new("c", 1, vec![1.0f32])));
    let message = refuse(|data| data.lines.push(&[0, 2]));
    assert!(message.contains("cell 0 has the index 2, outside 0..2"), "{message}");
    refuse(|data| data.points.components = 2);
    refuse(|data| data.points.values = vec![1i8; 6].into());
    assert!(!path.exists());
}

#[test]
fn errors_of_opening_name_the_file() {
    let missing = VtuFile::open("no/such.vtu").unwrap_err().to_string();
    assert!(missing.starts_with("cannot read 'no/such.vtu'"), "{missing}");
}
