//! Bézier cells of order two as Lagrange cells.
//!
//! A Bézier cell is given by control points and control values, which lie on its
//! curved shape at its corners only. What is split, and carried along, has to be on
//! it: each inner control point is replaced by the point of the cell with its
//! parameters, and its data by the data there. That is the same cell, in terms of
//! Lagrange polynomials.

use std::borrow::Cow;

use super::element::Element;
use super::layout::{BEZIER_2, is_bezier_2};
use super::reference::{Place, Reference};
use crate::vtk::{AttributeKind, Attributes, DataArray, UnstructuredGrid, Values};

/// The grid with its Bézier cells of order two as Lagrange cells; as it is if it has
/// none. Arrays of floating-point numbers are converted as the points are; others
/// have no values between points.
///
/// Rational cells, which have active `RationalWeights`, are converted to the Lagrange
/// cell through the same points, if all weights are positive; else they stay.
pub fn lagrange_grid(grid: &UnstructuredGrid) -> Cow<'_, UnstructuredGrid> {
    let weights = grid.point_data.active(AttributeKind::RationalWeights);
    let weights = weights.and_then(|array| array.component(0));
    let means = Means::new(grid, weights.as_deref());
    if means.cells.is_empty() {
        return Cow::Borrowed(grid);
    }
    let mut grid = grid.clone();
    for &cell in &means.cells {
        grid.types[cell] = lagrange_type(grid.types[cell]);
    }
    grid.points = means.apply(&grid.points);
    let active = grid.point_data.active_names().to_vec();
    let is_weight = |array: &DataArray| {
        active
            .iter()
            .any(|(kind, name)| *kind == AttributeKind::RationalWeights && *name == array.name)
    };
    let converted = grid
        .point_data
        .iter()
        .map(|array| if is_weight(array) { array.clone() } else { means.apply(array) });
    let mut point_data: Attributes = converted.collect();
    for (kind, name) in &active {
        point_data.set_active(*kind, name);
    }
    grid.point_data = point_data;
    Cow::Owned(grid)
}

/// VTK's Lagrange types precede its Bézier types in the same order.
fn lagrange_type(bezier: u8) -> u8 {
    bezier - 7
}

/// The points to be replaced, each by a weighted mean of control points.
#[derive(Default)]
struct Means {
    /// The cells that can be converted.
    cells: Vec<usize>,
    /// The points to be replaced.
    targets: Vec<usize>,
    /// Where the mean of each begins in `terms`, and the end.
    starts: Vec<usize>,
    /// Control points and weights.
    terms: Vec<(usize, f64)>,
}

impl Means {
    /// Of all Bézier cells of order two. Cells that share an inner control point,
    /// on an edge or a face, have the same mean for it.
    fn new(grid: &UnstructuredGrid, weights: Option<&[f64]>) -> Self {
        let mut means = Self { starts: vec![0], ..Self::default() };
        let mut done = Vec::new();
        // most grids have none: types tell so in less time than cells
        let types = grid.types.iter().enumerate();
        for (cell, &cell_type) in types.filter(|(_, cell_type)| BEZIER_2.contains(cell_type)) {
            let nodes = grid.cells.get(cell).unwrap_or_default();
            if !is_bezier_2(cell_type, nodes.len()) || !are_points(nodes, grid.points.tuples()) {
                continue;
            }
            let Some(element) = Element::of(lagrange_type(cell_type), nodes.len()) else {
                continue;
            };
            let weight = |&node: &i64| weights.map_or(1.0, |weights| weights[node as usize]);
            if !nodes.iter().all(|node| weight(node) > 0.0 && weight(node).is_finite()) {
                continue;
            }
            means.cells.push(cell);
            done.resize(grid.points.tuples(), false);
            for (&at, &target) in element.nodes.iter().zip(nodes) {
                if !std::mem::replace(&mut done[target as usize], true) {
                    means.push(element, at, nodes, weight, target as usize);
                }
            }
        }
        means
    }

    /// Adds the mean that is the point of a cell at a node.
    fn push(
        &mut self,
        element: &Element,
        at: Place,
        nodes: &[i64],
        weight: impl Fn(&i64) -> f64,
        target: usize,
    ) {
        let start = self.terms.len();
        for (&of, node) in element.nodes.iter().zip(nodes) {
            let share = bernstein(element.reference, of, at) * weight(node);
            if share > 0.0 {
                self.terms.push((*node as usize, share));
            }
        }
        let sum: f64 = self.terms[start..].iter().map(|(_, share)| share).sum();
        self.terms[start..].iter_mut().for_each(|(_, share)| *share /= sum);
        self.targets.push(target);
        self.starts.push(self.terms.len());
    }

    /// An array with its values at the points replaced.
    fn apply(&self, array: &DataArray) -> DataArray {
        let mut converted = array.clone();
        match (&array.values, &mut converted.values) {
            (Values::F32(from), Values::F32(to)) => {
                self.replace(array.components, |n| from[n].into(), |n, value| to[n] = value as f32);
            }
            (Values::F64(from), Values::F64(to)) => {
                self.replace(array.components, |n| from[n], |n, value| to[n] = value);
            }
            _ => {}
        }
        converted
    }

    fn replace(
        &self,
        components: usize,
        from: impl Fn(usize) -> f64,
        mut to: impl FnMut(usize, f64),
    ) {
        for (target, bounds) in self.targets.iter().zip(self.starts.windows(2)) {
            let terms = &self.terms[bounds[0]..bounds[1]];
            for component in 0..components {
                let term =
                    |&(point, share): &(usize, f64)| share * from(point * components + component);
                to(target * components + component, terms.iter().map(term).sum());
            }
        }
    }
}

/// Whether all nodes are points; the grid may not have been checked yet.
fn are_points(nodes: &[i64], points: usize) -> bool {
    nodes.iter().all(|&node| usize::try_from(node).is_ok_and(|node| node < points))
}

/// The Bernstein polynomial of degree two of a node, at a place.
fn bernstein(reference: Reference, of: Place, at: Place) -> f64 {
    let line = |axis: usize| quadratic(&[1.0 - of[axis], of[axis]], &[1.0 - at[axis], at[axis]]);
    let triangle = |p: Place| [1.0 - p[0] - p[1], p[0], p[1]];
    let tetrahedron = |p: Place| [1.0 - p[0] - p[1] - p[2], p[0], p[1], p[2]];
    match reference {
        Reference::Triangle => quadratic(&triangle(of), &triangle(at)),
        Reference::Square => line(0) * line(1),
        Reference::Tetrahedron => quadratic(&tetrahedron(of), &tetrahedron(at)),
        Reference::Wedge => quadratic(&triangle(of), &triangle(at)) * line(2),
        Reference::Cube => line(0) * line(1) * line(2),
        // VTK has no Bézier pyramids of order two
        Reference::Pyramid => 0.0,
    }
}

/// The quadratic Bernstein polynomial of a corner or mid node of a simplex, by
/// barycentric coordinates.
fn quadratic(of: &[f64], at: &[f64]) -> f64 {
    let mut product = 1.0;
    let mut factor = 2.0;
    for (of, at) in of.iter().zip(at) {
        if *of > 0.75 {
            product *= at * at;
            factor = 1.0;
        } else if *of > 0.25 {
            product *= at;
        }
    }
    factor * product
}
