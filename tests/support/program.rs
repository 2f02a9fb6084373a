//! The program, run in a folder of its own.
#![allow(dead_code)] // no test needs all of it

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;
use vtu2contour::vtk::{DataArray, PolyData, Selection, UnstructuredGrid, VtpFile, write_vtu};

/// A folder for a test's files, and the program run in it.
pub struct Bench {
    pub folder: TempDir,
}

impl Bench {
    pub fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn run(&self, arguments: &[&str]) -> Output {
        let program = env!("CARGO_BIN_EXE_vtu2contour");
        Command::new(program).args(arguments).current_dir(self.folder.path()).output().unwrap()
    }

    /// Runs a job that must succeed; returns what it said.
    pub fn succeed(&self, arguments: &[&str]) -> String {
        let output = self.run(arguments);
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "{arguments:?} failed: {said}");
        said
    }

    /// Runs a job that must fail with the given exit code; returns what it said.
    pub fn fail(&self, code: i32, arguments: &[&str]) -> String {
        let output = self.run(arguments);
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {said}");
        assert!(!said.contains("panicked"), "{said}");
        assert!(!self.path("out.vtp").exists(), "{arguments:?} left a file");
        said
    }

    /// A unit square of 8 triangles with the given arrays, as `in.vtu`.
    pub fn write_grid(&self, point_arrays: Vec<DataArray>, cell_arrays: Vec<DataArray>) {
        let mut grid = square();
        point_arrays.into_iter().for_each(|array| grid.point_data.push(array));
        cell_arrays.into_iter().for_each(|array| grid.cell_data.push(array));
        write_vtu(self.path("in.vtu"), &grid, Default::default()).unwrap();
    }
}

/// The unit square as 2 by 2 squares of two triangles.
pub fn square() -> UnstructuredGrid {
    let corners = [0_i64, 1, 3, 4];
    let halves = corners.map(|n| [[n, n + 1, n + 4], [n, n + 4, n + 3]]);
    let cells: Vec<(u8, &[i64])> = halves.iter().flatten().map(|half| (5, &half[..])).collect();
    square_of(&cells)
}

/// Nine points of the unit square, row by row, and the given cells.
pub fn square_of(cells: &[(u8, &[i64])]) -> UnstructuredGrid {
    let coordinates: Vec<f64> =
        (0..9).flat_map(|n| [f64::from(n % 3) / 2.0, f64::from(n / 3) / 2.0, 0.0]).collect();
    let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, coordinates));
    cells.iter().for_each(|(cell_type, points)| grid.push_cell(*cell_type, points));
    grid
}

pub fn u() -> DataArray {
    DataArray::new("u", 1, (0..9).map(|n| f64::from(n % 3)).collect::<Vec<f64>>())
}

pub fn samples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("samples")
}

pub fn sample(name: &str) -> String {
    samples().join(name).to_str().unwrap().to_owned()
}

pub fn read_lines(path: &Path) -> PolyData {
    VtpFile::open(path).unwrap().read(&Selection::All).unwrap().data
}
