//! Files that other programs wrote, read from a folder beside the project; skipped where
//! the folder is missing.

use std::f64::consts::E;
use std::path::{Path, PathBuf};
use vtu2contour::vtk::{
    AnyFile, AttributeKind, Selection, UnstructuredGrid, VtkError, VtpFile, VtuFile, read_grid,
};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data")
}

/// The grid in a file; `None`, and a note, where the file is missing.
fn read(name: &str) -> Option<UnstructuredGrid> {
    let path = folder().join(name);
    if !path.exists() {
        println!("skipped: {name} is missing");
        return None;
    }
    Some(read_grid(&path, &Selection::All).unwrap_or_else(|e| panic!("{e}")).data)
}

/// File, points, cells, and how many cells have which of VTK's types.
type Counts = (&'static str, usize, usize, &'static [(u8, usize)]);

const COUNTS: [Counts; 29] = [
    ("vtkdata/QuadraticTetra.vtu", 189, 96, &[(24, 96)]),
    ("vtkdata/Tetrahedron.vtu", 35, 96, &[(10, 96)]),
    ("vtkdata/Triangle.vtu", 9, 8, &[(5, 8)]),
    ("vtkdata/quadraticTetra01.vtu", 22, 3, &[(22, 2), (24, 1)]),
    ("vtkdata/polyhedron2pieces.vtu", 18, 4, &[(14, 2), (42, 2)]),
    ("vtkdata/Disc_BiQuadraticQuads.vtu", 1569, 376, &[(28, 376)]),
    ("vtkdata/kiefer_tet10_celldata.vtu", 102_578, 56_786, &[(24, 56_786)]),
    ("vtkdata/ex-blow_5/ex-blow_5_0_0.vtu", 82, 116, &[(5, 116)]),
    ("vtkdata/ex-blow_5/ex-blow_5_0_7.vtu", 80, 116, &[(5, 116)]),
    ("lagrange/data2d.vtu", 256, 4, &[(70, 4)]),
    ("lagrange/data3d.vtu", 864, 4, &[(72, 4)]),
    ("readvtk/pointdata_appended_binary_compressed.vtu", 243, 3, &[(70, 3)]),
    ("vtkio/hexahedron_lz4.vtu", 8, 1, &[(12, 1)]),
    ("vtkio/hexahedron_lz4_inline_binary.vtu", 8, 1, &[(12, 1)]),
    ("vtkio/hexahedron_parallel_lzma_0.vtu", 8, 1, &[(12, 1)]),
    ("vtkio/pygmsh_lzma.vtu", 18, 38, &[(1, 4), (3, 12), (5, 22)]),
    ("vtkio/pygmsh_zlib.vtu", 18, 38, &[(1, 4), (3, 12), (5, 22)]),
    ("vtkio/tet.vtu", 4, 1, &[(10, 1)]),
    ("vtkio/box_para.vtu", 8, 6, &[(7, 6)]),
    ("vtkio/hexahedron_parallel_lzma.pvtu", 8, 1, &[(12, 1)]),
    ("vtkdata/CylinderQuadratic.vtk", 2814, 1522, &[(24, 1522)]),
    ("vtkdata/CylinderLinear.vtk", 465, 1522, &[(10, 1522)]),
    ("vtkdata/post.vtk", 2288, 8750, &[(10, 8750)]),
    ("vtkdata/blow.vtk", 687, 1057, &[(5, 928), (9, 129)]),
    ("vtkdata/uGridEx.vtk", 27, 12, &[(1, 1), (3, 2), (5, 2), (6, 1), (7, 1), (9, 1), (10, 2)]),
    ("mfem/square-disc-p2.vtk", 356, 154, &[(22, 154)]),
    ("mfem/escher-p2.vtk", 117, 42, &[(24, 42)]),
    ("mfem/star-mixed-p2.vtk", 101, 30, &[(22, 20), (28, 10)]),
    ("cardiac/atrium_patient02.vtk", 13_952, 27_673, &[(5, 27_673)]),
];

#[test]
fn points_and_cells_are_counted() {
    for (name, points, cells, types) in COUNTS {
        let Some(grid) = read(name) else {
            continue;
        };
        assert_eq!(grid.points.tuples(), points, "{name}");
        assert_eq!(grid.cells.len(), cells, "{name}");
        for (kind, count) in types {
            let found = grid.types.iter().filter(|found| *found == kind).count();
            assert_eq!(found, *count, "{name}: type {kind}");
        }
    }
}

fn range(values: &[f64]) -> (f64, f64) {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (least, greatest)
}

/// File, point array, its least and greatest value (of a vector: the greatest length).
const RANGES: [(&str, &str, f64, f64); 11] = [
    ("vtkdata/Tetrahedron.vtu", "DistanceToCenter", 0.0, 1.732),
    ("vtkdata/QuadraticTetra.vtu", "Polynomial", 1.0, 7.0),
    ("vtkdata/ex-blow_5/ex-blow_5_0_0.vtu", "DISPLACEMENT_", 0.0, 3.296),
    ("vtkdata/ex-blow_5/ex-blow_5_0_3.vtu", "THICKNESS", 0.4594, 0.7267),
    ("lagrange/data2d.vtu", "data", 1.0 / E, E),
    ("readvtk/pointdata_appended_binary_compressed.vtu", "rho", 1.899, 2.103),
    ("vtkio/tet.vtu", "pressure", -0.9428, 0.4714),
    ("vtkdata/CylinderLinear.vtk", "velocity", 0.0, 1.004),
    ("vtkdata/post.vtk", "Pressure", 0.3554, 1.641),
    ("vtkdata/blow.vtk", "displacement9", 0.0, 9.65),
    ("cardiac/atrium_patient02.vtk", "vtkOriginalPointIds", 0.0, 13951.0),
];

#[test]
fn values_have_the_range_vtk_finds() {
    for (name, array, least, greatest) in RANGES {
        let Some(grid) = read(name) else {
            continue;
        };
        let array = grid.point_data.get(array).unwrap();
        let values = match array.components {
            1 => array.to_f64(),
            _ => array.magnitude(),
        };
        let found = range(&values.unwrap());
        assert!((found.0 - least).abs() < 1e-3, "{name}: {found:?}");
        assert!((found.1 - greatest).abs() < 1e-3, "{name}: {found:?}");
    }
}

#[test]
fn distances_are_those_of_the_points() {
    let Some(grid) = read("vtkdata/Tetrahedron.vtu") else {
        return;
    };
    let [x, y, z] = [0, 1, 2].map(|i| grid.points.component(i).unwrap());
    let distances = grid.point_data.get("DistanceToCenter").unwrap().to_f64().unwrap();
    for (i, distance) in distances.iter().enumerate() {
        let square = (x[i] - 1.0).powi(2) + (y[i] - 1.0).powi(2) + (z[i] - 1.0).powi(2);
        assert!((square.sqrt() - distance).abs() < 1e-6);
    }
}

#[test]
fn polyhedra_of_two_pieces_are_joined() {
    let Some(grid) = read("vtkdata/polyhedron2pieces.vtu") else {
        return;
    };
    let polyhedra = grid.polyhedra.unwrap();
    for (kind, faces) in grid.types.iter().zip(polyhedra.cells.iter()) {
        assert_eq!(*kind == 42, !faces.is_empty());
    }
    let second: Vec<i64> = grid.cells.iter().skip(2).flatten().copied().collect();
    assert!(second.iter().all(|point| *point >= 9), "{second:?}");
    assert!(polyhedra.faces.connectivity().iter().any(|point| *point >= 9));
}

#[test]
fn roles_are_kept() {
    if let Some(grid) = read("vtkdata/ex-blow_5/ex-blow_5_0_0.vtu") {
        let ids = grid.point_data.active(AttributeKind::GlobalIds).unwrap();
        assert_eq!(ids.name, "GlobalNodeId");
    }
}

/// Every file of the folder is read, or refused with a message that names it.
#[test]
fn every_file_is_read_or_refused_politely() {
    let mut files = Vec::new();
    find(&folder(), &mut files);
    println!("{} files", files.len());
    for path in files {
        let extension = path.extension().and_then(|extension| extension.to_str());
        let is_grid = matches!(extension, Some("vtu" | "pvtu" | "vtk"));
        match read_grid(&path, &Selection::All) {
            Ok(loaded) => {
                assert!(is_grid, "{}", path.display());
                let description = AnyFile::open(&path).unwrap().description().unwrap();
                assert_eq!(description.points(), loaded.data.points.tuples());
                assert_eq!(description.cells(), loaded.data.cells.len());
            }
            Err(error) => {
                assert!(!is_grid, "{error}");
                let message = error.to_string();
                assert!(message.contains(&path.display().to_string()), "{message}");
            }
        }
        assert!(VtpFile::open(&path).is_err());
        let error = VtuFile::open(&path).err();
        assert_eq!(matches!(error, Some(VtkError::NotXml { .. })), extension == Some("vtk"));
    }
}

fn find(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            find(&path, files);
        } else {
            files.push(path);
        }
    }
}
