//! Cut, corrupted and forged files: an error or sane data, never a panic, a hang, or more
//! memory than the file accounts for.
//!
//! A test run makes 20 000 mutated files of every format and encoding. The hunt of a million
//! is the same test with another number, takes about two minutes, and other seeds hunt elsewhere:
//!
//! ```text
//! VTK_MUTATIONS=1000000 VTK_SEED=2 cargo test --test vtk_robustness mutated
//! ```

#[path = "vtk_common/counting.rs"]
mod counting;
#[path = "vtk_common/legacy.rs"]
mod legacy;
#[path = "vtk_common/mutation.rs"]
mod mutation;
mod vtk_common;

use mutation::{Random, mutate};
use std::path::{Path, PathBuf};
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use vtk_common::{Compressor, Format, Variant, sample, variants};
use vtu2contour::vtk::{
    Encoding, LegacyFile, PolyData, PvdFile, PvtpFile, PvtuFile, Selection, UnstructuredGrid,
    VtkError, VtpFile, VtuFile, write_vtp_to, write_vtu_to,
};

/// Memory is counted for the whole process, so only one test runs at a time.
fn alone() -> MutexGuard<'static, ()> {
    static LOCK: Mutex<()> = Mutex::new(());
    LOCK.lock().unwrap_or_else(PoisonError::into_inner)
}

// --- Reading under watch ------------------------------------------------------------

/// What a file may take beside four times its size.
const SLACK: usize = 64 << 20;

/// The longest any small file may take.
const PATIENCE: Duration = Duration::from_secs(5);

/// The formats, each with a reader of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Vtu,
    Vtp,
    Pvtu,
    Pvtp,
    Pvd,
    Vtk,
}

const KINDS: [Kind; 6] = [Kind::Vtu, Kind::Vtp, Kind::Pvtu, Kind::Pvtp, Kind::Pvd, Kind::Vtk];

#[derive(Clone)]
struct Sample {
    name: String,
    kind: Kind,
    bytes: Vec<u8>,
}

/// Reads a file and checks memory, time, and that what comes out is consistent: the
/// writer refuses data whose lengths or indices contradict each other.
fn read(name: &str, bytes: Vec<u8>, kind: Kind) -> Result<(), VtkError> {
    let size = bytes.len();
    let before = counting::begin();
    let start = Instant::now();
    let result = parse(bytes, kind).map(Data::write);
    let taken = counting::peak().saturating_sub(before);
    assert!(taken <= 4 * size + SLACK, "{name}: {taken} bytes for {size}");
    assert!(start.elapsed() < PATIENCE, "{name}: {:?}", start.elapsed());
    if let Err(error) = &result {
        let message = error.to_string();
        assert!(!message.contains(char::is_control), "{message}");
        assert!(message.contains("x."), "{message}");
    }
    result.map(|written| written.expect("what was read is consistent"))
}

/// What came out of a file.
enum Data {
    Grid(UnstructuredGrid),
    PolyData(PolyData),
    Nothing,
}

impl Data {
    fn write(self) -> Result<(), VtkError> {
        match self {
            Self::Grid(grid) => write_vtu_to(std::io::sink(), &grid, RAW.into()),
            Self::PolyData(data) => write_vtp_to(std::io::sink(), &data, RAW.into()),
            Self::Nothing => Ok(()),
        }
    }
}

fn parse(bytes: Vec<u8>, kind: Kind) -> Result<Data, VtkError> {
    let all = &Selection::All;
    match kind {
        Kind::Vtu => read_grid(bytes).map(Data::Grid),
        Kind::Vtp => {
            let file = VtpFile::from_bytes("x.vtp", bytes)?;
            file.description()?;
            file.read(all).map(|loaded| Data::PolyData(loaded.data))
        }
        Kind::Pvtu => {
            let file = PvtuFile::from_bytes(PIECES.path().join("x.pvtu"), bytes)?;
            file.description()?;
            file.pieces().try_for_each(|piece| piece.map(drop))?;
            file.read(all).map(|loaded| Data::Grid(loaded.data))
        }
        Kind::Pvtp => {
            let file = PvtpFile::from_bytes(PIECES.path().join("x.pvtp"), bytes)?;
            file.description()?;
            file.read(all).map(|loaded| Data::PolyData(loaded.data))
        }
        Kind::Pvd => PvdFile::from_bytes("x.pvd", bytes).map(|_| Data::Nothing),
        Kind::Vtk => {
            let file = LegacyFile::from_bytes("x.vtk", bytes)?;
            file.description();
            file.read(all).map(|loaded| Data::Grid(loaded.data.into_grid()))
        }
    }
}

/// A folder with the files that the samples of lists name.
static PIECES: LazyLock<tempfile::TempDir> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    for (index, variant) in variants().into_iter().step_by(16).enumerate() {
        let grid = read_grid(sample(variant)).unwrap();
        let mut data = PolyData::new(grid.points.clone());
        data.point_data = grid.point_data.clone();
        data.polys.push(&[0, 1, 4]);
        let write = |name: String, bytes| std::fs::write(folder.path().join(name), bytes).unwrap();
        write(format!("{index}.vtu"), sample(variant));
        let mut bytes = Vec::new();
        write_vtp_to(&mut bytes, &data, RAW.into()).unwrap();
        write(format!("{index}.vtp"), bytes);
    }
    folder
});

const RAW: Encoding = Encoding::Raw;

fn read_grid(bytes: Vec<u8>) -> Result<UnstructuredGrid, VtkError> {
    let file = VtuFile::from_bytes("x.vtu", bytes)?;
    file.description()?;
    file.read(&Selection::All).map(|loaded| loaded.data)
}

// --- Samples ------------------------------------------------------------------------

/// Small files of every variant of the format, written here, by the library's writer, and
/// (where they are at hand) by VTK and meshio.
fn samples() -> Vec<Sample> {
    let mut all: Vec<Sample> = variants()
        .into_iter()
        .filter(|variant| variant.block == 48 && variant.wide_header != variant.big_endian)
        .map(|variant| Sample {
            name: format!("{variant:?}.vtu"),
            kind: Kind::Vtu,
            bytes: sample(variant),
        })
        .collect();
    all.extend(our_samples());
    all.extend(list_samples());
    all.extend(legacy::samples().into_iter().map(|(name, bytes)| Sample {
        name,
        kind: Kind::Vtk,
        bytes,
    }));
    all.extend(shared_samples());
    all
}

fn our_samples() -> Vec<Sample> {
    let mut grid = read_grid(sample(variants()[0])).unwrap();
    let mut polyhedra = vtu2contour::vtk::Polyhedra::default();
    polyhedra.faces.push(&[0, 1, 2]);
    polyhedra.cells.push(&[0]);
    polyhedra.cells.push(&[]);
    polyhedra.cells.push(&[]);
    grid.polyhedra = Some(polyhedra);
    let mut data = PolyData::new(grid.points.clone());
    data.point_data = grid.point_data.clone();
    data.lines.push(&[0, 1, 2, 0]);
    data.polys.push(&[0, 1, 4]);
    let encodings = [
        Encoding::Raw,
        Encoding::Zlib,
        Encoding::Lz4,
        Encoding::Lzma,
        Encoding::Base64,
        Encoding::Ascii,
    ];
    let both = encodings.map(|encoding| {
        let (mut vtu, mut vtp) = (Vec::new(), Vec::new());
        write_vtu_to(&mut vtu, &grid, encoding.into()).unwrap();
        write_vtp_to(&mut vtp, &data, encoding.into()).unwrap();
        [(Kind::Vtu, vtu), (Kind::Vtp, vtp)].map(|(kind, bytes)| Sample {
            name: format!("{encoding:?}.{kind:?}"),
            kind,
            bytes,
        })
    });
    both.into_iter().flatten().collect()
}

/// Lists of the files in [`PIECES`].
fn list_samples() -> Vec<Sample> {
    let points = "<PPoints><PDataArray type='Float64' NumberOfComponents='3'/></PPoints>";
    let arrays = "<PPointData Scalars='i8'><PDataArray type='Int8' Name='i8'/>\
                  <PDataArray type='Float32' Name='f32' NumberOfComponents='3'/></PPointData>";
    let field = "<FieldData><DataArray type='Float64' Name='t' NumberOfTuples='1'>0.5</DataArray>\
                 </FieldData>";
    let sample = |kind, data_set: &str, inside: String| {
        let text = format!(
            "<?xml version='1.0'?><VTKFile type='{data_set}' version='1.0'><{data_set}>{inside}\
             </{data_set}></VTKFile>"
        );
        Sample { name: format!("{kind:?}"), kind, bytes: text.into_bytes() }
    };
    let pieces = |suffix: &str| -> String {
        (0..8).map(|index| format!("<Piece Source='{index}.{suffix}'/>")).collect()
    };
    let entry =
        |index| format!("<DataSet timestep='{index}.25' group='' part='0' file='{index}.vtu'/>");
    let entries: String = (0..4).map(entry).collect();
    vec![
        sample(
            Kind::Pvtu,
            "PUnstructuredGrid",
            format!("{field}{arrays}{points}{}", pieces("vtu")),
        ),
        sample(Kind::Pvtp, "PPolyData", format!("{arrays}{points}{}", pieces("vtp"))),
        sample(Kind::Pvd, "Collection", entries),
    ]
}

fn shared_samples() -> Vec<Sample> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    let names = [
        "vtkdata/Triangle.vtu",
        "vtkdata/quadraticTetra01.vtu",
        "vtkdata/polyhedron2pieces.vtu",
        "vtkio/hexahedron_lz4.vtu",
        "vtkio/hexahedron_lz4_inline_binary.vtu",
        "vtkio/hexahedron_parallel_lzma_0.vtu",
        "vtkio/pygmsh_lzma.vtu",
        "vtkio/pygmsh_zlib.vtu",
        "vtkio/tet.vtu",
        "vtkio/box_para.vtu",
        "vtkdata/uGridEx.vtk",
        "mfem/star-mixed-p2.vtk",
    ];
    let paths = names.map(|name| folder.join(name));
    let found: Vec<Sample> = paths.iter().filter_map(open_sample).collect();
    println!("{} of {} shared files skipped", names.len() - found.len(), names.len());
    found
}

fn open_sample(path: &PathBuf) -> Option<Sample> {
    let kind = if path.extension()? == "vtk" { Kind::Vtk } else { Kind::Vtu };
    Some(Sample { name: path.display().to_string(), kind, bytes: std::fs::read(path).ok()? })
}

#[test]
fn whole_samples_are_read() {
    let _guard = alone();
    for sample in samples() {
        let result = read(&sample.name, sample.bytes, sample.kind);
        assert!(result.is_ok(), "{}: {}", sample.name, result.unwrap_err());
    }
}

#[test]
fn cut_files_are_refused_wherever_they_are_cut() {
    let _guard = alone();
    for sample in samples().into_iter().filter(|sample| sample.kind != Kind::Vtk) {
        let whole = sample.bytes.trim_ascii_end().len();
        for end in 0..whole {
            let cut = sample.bytes[..end].to_vec();
            let result = read(&sample.name, cut, sample.kind);
            assert!(result.is_err(), "{} cut at {end} of {whole}", sample.name);
        }
    }
}

/// Nothing tells a legacy file that ends between two sections from a whole one, nor a last
/// number from its beginning; but for these, whatever is cut is refused.
#[test]
fn cut_legacy_files_are_refused_but_between_sections() {
    let _guard = alone();
    for sample in samples().into_iter().filter(|sample| sample.kind == Kind::Vtk) {
        let whole = sample.bytes.trim_ascii_end().len();
        let mut passed = 0;
        for end in 0..whole {
            let cut = sample.bytes[..end].to_vec();
            if read(&sample.name, cut.clone(), sample.kind).is_err() {
                continue;
            }
            let at_line_end = sample.bytes[..end].ends_with(b"\n");
            let file = LegacyFile::from_bytes("x.vtk", cut).unwrap();
            let is_reported = file.description().warnings.iter().any(|w| w.contains("may be cut"));
            let rest = sample.bytes[end..].trim_ascii_start();
            let word = rest.split(u8::is_ascii_whitespace).next().unwrap_or_default();
            let is_keyword =
                word.len() > 3 && word.iter().all(|b| b.is_ascii_uppercase() || *b == b'_');
            assert!(
                is_reported || at_line_end || is_keyword,
                "{} cut at {end}: {:?}",
                sample.name,
                String::from_utf8_lossy(&sample.bytes[..end])
            );
            passed += usize::from(!is_reported);
        }
        assert!(passed < 60, "{}: {passed} cuts are read", sample.name);
    }
}

// --- Mutations ----------------------------------------------------------------------

/// A number from the environment, for longer hunts than a test run allows.
fn setting(name: &str, usual: usize) -> usize {
    let value = std::env::var(name).ok();
    value.and_then(|text| text.parse().ok()).unwrap_or(usual)
}

#[test]
fn mutated_files_do_no_harm() {
    let _guard = alone();
    let samples = samples();
    let by_kind = KINDS.map(|kind| -> Vec<&Sample> {
        samples.iter().filter(|sample| sample.kind == kind).collect()
    });
    let runs = setting("VTK_MUTATIONS", 20_000);
    let mut random = Random::new(setting("VTK_SEED", 1) as u64);
    let mut refused = 0;
    for run in 0..runs {
        let of_kind = &by_kind[run % KINDS.len()];
        let sample = of_kind[run / KINDS.len() % of_kind.len()];
        let mut bytes = sample.bytes.clone();
        for _ in 0..=random.below(4) {
            mutate(&mut bytes, &mut random);
        }
        let keep = bytes.clone();
        let job = || read(&sample.name, bytes, sample.kind);
        match std::panic::catch_unwind(job) {
            Ok(result) => refused += usize::from(result.is_err()),
            Err(_) => panic!("run {run}, {}: {}", sample.name, keep.escape_ascii()),
        }
    }
    println!("{refused} of {runs} refused");
    assert!(refused > runs / 2);
}

// --- Forgeries ----------------------------------------------------------------------

/// Bombs that promise much and hold little.
#[test]
fn forged_sizes_take_no_memory() {
    let _guard = alone();
    let huge = "1000000000000000";
    for variant in variants() {
        let text = sample(variant);
        for name in ["NumberOfPoints=\"5\"", "NumberOfCells=\"3\""] {
            let forged = name.split('"').next().unwrap().to_owned() + "\"" + huge + "\"";
            let bytes = replace(&text, name, &forged);
            assert!(read("forged", bytes, Kind::Vtu).is_err(), "{variant:?} {name}");
        }
        // Only one array is wrong then, and left out.
        let forged = format!("NumberOfComponents=\"{huge}\"");
        let bytes = replace(&text, "NumberOfComponents=\"3\"", &forged);
        read("forged", bytes.clone(), Kind::Vtu).unwrap();
        let file = VtuFile::from_bytes("forged", bytes).unwrap();
        let warnings = file.read(&Selection::All).unwrap().warnings;
        assert!(warnings[0].contains("'f32' left out: 15 values where"), "{warnings:?}");
        let named = file.read(&Selection::named(["f32"], [""; 0]));
        assert!(named.is_err(), "{variant:?}");
    }
}

fn replace(bytes: &[u8], old: &str, new: &str) -> Vec<u8> {
    let old = old.as_bytes();
    let at = bytes.windows(old.len()).position(|part| part == old).unwrap();
    [&bytes[..at], new.as_bytes(), &bytes[at + old.len()..]].concat()
}

/// A header of 2^60 bytes or blocks is refused at once.
#[test]
fn forged_headers_take_no_memory() {
    let _guard = alone();
    for compressor in [None, Some(Compressor::Zlib), Some(Compressor::Lzma)] {
        let variant = Variant {
            format: Format::AppendedRaw,
            compressor,
            wide_header: true,
            big_endian: false,
            block: 48,
        };
        let bytes = sample(variant);
        let mark = bytes.windows(2).position(|pair| pair == b">_").unwrap() + 2;
        // The block size (word 1) may be any: the only block is the last.
        let words: &[usize] = if compressor.is_some() { &[0, 2, 3] } else { &[0] };
        for word in words {
            for value in [1u64 << 60, u64::MAX, u64::MAX / 8, 1 << 40] {
                let mut forged = bytes.clone();
                let at = mark + 8 * word;
                forged[at..at + 8].copy_from_slice(&value.to_le_bytes());
                let result = read("forged", forged, Kind::Vtu);
                assert!(result.is_err(), "{word} {value}");
            }
        }
    }
}

/// Blocks that really decompress to far more than they are.
#[test]
fn compressed_bombs_stop_at_the_promised_size() {
    let _guard = alone();
    for compressor in [Compressor::Zlib, Compressor::Lz4, Compressor::Lzma] {
        let bytes = bomb(compressor, 1 << 22);
        assert!(read("bomb", bytes.clone(), Kind::Vtu).is_ok());
        // The same blocks, promised to be a hundred bytes.
        let mark = bytes.windows(2).position(|pair| pair == b">_").unwrap() + 2;
        let mut forged = bytes;
        forged[mark + 8..mark + 16].copy_from_slice(&100u64.to_le_bytes());
        assert!(read("bomb", forged, Kind::Vtu).is_err(), "{compressor:?}");
    }
}

/// Data that nothing measures are left out when they are far larger than the file.
#[test]
fn field_data_without_a_length_stay_small() {
    let _guard = alone();
    let bytes = bomb(Compressor::Zlib, 20 << 20);
    assert!(bytes.len() < 1 << 20);
    assert!(read("field", bytes.clone(), Kind::Vtu).is_ok());
    let loaded = VtuFile::from_bytes("x.vtu", bytes).unwrap().read(&Selection::All).unwrap();
    assert!(loaded.data.field_data.is_empty());
    assert!(loaded.warnings[0].contains("nothing says how many values"), "{:?}", loaded.warnings);
}

fn bomb(compressor: Compressor, size: usize) -> Vec<u8> {
    let variant = Variant {
        format: Format::AppendedRaw,
        compressor: Some(compressor),
        wide_header: true,
        big_endian: false,
        block: 1 << 22,
    };
    let mut bomb = vtk_common::Encoder::new("UnstructuredGrid", variant);
    let zeros = vec![0; size / 8];
    bomb.raw("<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"/><FieldData>")
        .array("a", 1, &vtk_common::i64s(&zeros))
        .raw("</FieldData>");
    bomb.finish("UnstructuredGrid")
}

/// A stream of polyhedra in which every number is a face takes a bounded multiple of its
/// text: 4 as numbers, and 8 as faces.
#[test]
fn forged_polyhedra_take_bounded_memory() {
    let _guard = alone();
    let faces = 4_000_000;
    let array = |kind: &str, name: &str, values: &str| {
        format!("<DataArray type='{kind}' Name='{name}' format='ascii'>{values}</DataArray>")
    };
    let text = [
        "<VTKFile type='UnstructuredGrid'><UnstructuredGrid>",
        "<Piece NumberOfPoints='1' NumberOfCells='1'><Points>",
        "<DataArray type='Float32' NumberOfComponents='3'>0 0 0</DataArray></Points><Cells>",
        &array("Int8", "connectivity", "0"),
        &array("Int8", "offsets", "1"),
        &array("UInt8", "types", "42"),
        &array("Int64", "faces", &format!("{faces}{}", " 0".repeat(faces))),
        &array("Int64", "faceoffsets", &(faces + 1).to_string()),
        "</Cells></Piece></UnstructuredGrid></VTKFile>",
    ]
    .concat();
    let bytes = text.into_bytes();
    let (size, before) = (bytes.len(), counting::begin());
    read_grid(bytes).unwrap();
    let taken = counting::peak() - before;
    assert!(taken <= 13 * size, "{taken} bytes for {size}");
}

/// Blocks that ask for a dictionary of 64 MiB each and hold 48 bytes.
#[test]
fn large_dictionaries_take_no_memory() {
    let _guard = alone();
    let variant = Variant {
        format: Format::AppendedRaw,
        compressor: Some(Compressor::Lzma),
        wide_header: false,
        big_endian: false,
        block: 48,
    };
    let mut bytes = sample(variant);
    let heads: Vec<usize> = (0..bytes.len() - 24).filter(|at| is_xz_head(&bytes[*at..])).collect();
    assert!(heads.len() > 10);
    for head in heads {
        bytes[head + 16] = 28;
        let checksum = crc32(&bytes[head + 12..head + 20]).to_le_bytes();
        bytes[head + 20..head + 24].copy_from_slice(&checksum);
    }
    let before = counting::begin();
    read_grid(bytes).unwrap();
    let taken = counting::peak() - before;
    assert!(taken < 4 << 20, "{taken}");
}

/// The stream's signature, and a head of 12 bytes that names the filter LZMA2.
fn is_xz_head(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\xFD7zXZ\0") && bytes[12..16] == [2, 0, 0x21, 1]
}

fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, _| (crc >> 1) ^ (0xEDB8_8320 * (crc & 1));
    let byte = |crc: u32, byte: &u8| (0..8).fold(crc ^ u32::from(*byte), step);
    !bytes.iter().fold(!0, byte)
}

/// Many arrays at one offset would add up to more than the file.
#[test]
fn arrays_that_share_their_data_do_not_add_up() {
    let _guard = alone();
    let count = 20_000;
    let array = |index: usize| {
        format!("<DataArray type='Int8' Name='{index}' format='appended' offset='0'/>")
    };
    let arrays: String = (0..200).map(array).collect();
    let mut bytes = format!(
        "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><FieldData>{arrays}</FieldData>\
         </UnstructuredGrid><AppendedData encoding='raw'>_"
    )
    .into_bytes();
    bytes.extend((count as u32).to_le_bytes());
    bytes.extend(vec![0; count]);
    bytes.extend(b"</AppendedData></VTKFile>");
    let message = read("shared", bytes, Kind::Vtu).unwrap_err().to_string();
    assert!(message.contains("share the same data"), "{message}");
}

/// A head of many tiny elements, attributes and names.
#[test]
fn swollen_heads_take_bounded_memory() {
    let _guard = alone();
    let file = |inside: String| {
        let text = format!("<VTKFile type='UnstructuredGrid'><UnstructuredGrid>{inside}");
        format!("{text}</UnstructuredGrid></VTKFile>").into_bytes()
    };
    let piece = "<Piece NumberOfPoints='0' NumberOfCells='0'/>";
    let attributes: String = (0..100_000).map(|i| format!(" a{i}=''")).collect();
    let arrays = "<DataArray type='Int8' Name='a'/>".repeat(50_000);
    for inside in [
        "<a/>".repeat(1_000_000),
        piece.repeat(20_000),
        format!("<Piece NumberOfPoints='0' NumberOfCells='0'{attributes}/>"),
        format!("<FieldData>{arrays}</FieldData>"),
        "<a>".repeat(200_000),
    ] {
        let _ = read("swollen", file(inside), Kind::Vtu);
    }
}
