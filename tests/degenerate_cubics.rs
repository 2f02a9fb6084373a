//! Cubics that no random data bring about: with coefficients that are exactly zero, so
//! that levels pass through corners with all their derivatives, lie along lines inside
//! the cell, and cross or touch there.

mod support;

use support::distance::{distance_to_lines, sampled};
use support::meshes::Random;
use vtu2contour::bernstein::TriangleCubic;
use vtu2contour::contour::CellRanges;
use vtu2contour::contour::lines::{ContourLines, Method, Resolution, contour_lines};
use vtu2contour::interpolant::TriangleCubics;
use vtu2contour::mesh::{TriangleMesh, Vector};

const TOLERANCE: f64 = 1e-3;

/// A cubic given by its coefficients, on the triangle of the unit axes.
struct OneCell {
    mesh: TriangleMesh<'static>,
    cubic: TriangleCubic,
}

impl OneCell {
    fn new(coefficients: [f64; 10]) -> Self {
        let points = vec![Vector::zeros(), Vector::x(), Vector::y()];
        let mesh = TriangleMesh::new(points, vec![[0, 1, 2]]).unwrap();
        Self { mesh, cubic: TriangleCubic::new(coefficients) }
    }

    fn contour(&self, method: Method) -> ContourLines {
        let resolution = Resolution { spacing: f64::INFINITY, tolerance: TOLERANCE };
        contour_lines(self, &CellRanges::new(self), &[0.0], method, resolution)
    }

    /// The greatest distance of a point of the contour from the lines.
    fn missed(&self, lines: &ContourLines) -> f64 {
        let points = sampled(self, 0.0, 24);
        points.iter().map(|point| distance_to_lines(lines, point)).fold(0.0, f64::max)
    }
}

impl TriangleCubics for OneCell {
    fn mesh(&self) -> &TriangleMesh<'_> {
        &self.mesh
    }

    fn cubic(&self, _: usize) -> TriangleCubic {
        self.cubic
    }
}

#[test]
fn a_line_along_which_a_cell_is_divided() {
    // x = y is part of the contour, and halves the edge opposite
    let cell = OneCell::new([0.0, 0.0, 0.0, 0.0, -1.0, 2.0, 1.0, 0.0, 0.0, -1.0]);
    let lines = cell.contour(Method::Intercept);
    assert!(cell.missed(&lines) <= TOLERANCE, "{:e}", cell.missed(&lines));
}

/// Checks that nothing is missed without being counted, in `cells` random cells.
fn check(cells: usize, mut coefficient: impl FnMut() -> f64) {
    let methods = [Method::Intercept, Method::Sode, Method::Odea, Method::Aodea];
    let mut unresolved = 0;
    for n in 0..cells {
        let coefficients = [(); 10].map(|()| coefficient());
        let cell = OneCell::new(coefficients);
        let lines = cell.contour(methods[n % 4]);
        unresolved += usize::from(lines.counts.unresolved > 0);
        let missed = cell.missed(&lines);
        let told = lines.counts.unresolved > 0;
        assert!(missed <= TOLERANCE || told, "{coefficients:?}: {missed:e}");
    }
    // most are settled all the same
    assert!(unresolved * 50 <= cells, "{unresolved} of {cells}");
}

#[test]
fn whole_coefficients() {
    let mut random = Random(21);
    check(4000, || random.uniform(-2.0, 3.0).floor());
}

#[test]
fn mostly_zero_coefficients() {
    let mut random = Random(22);
    check(4000, || match random.uniform(0.0, 1.0) {
        zero if zero < 0.6 => 0.0,
        _ => random.uniform(-2.0, 3.0).floor(),
    });
}
