//! Gradients at points, from the shape functions of quadratic cells.

use arrayvec::ArrayVec;
use rayon::prelude::*;

use super::element::{Element, MOST_NODES};
use crate::mesh::Vector;
use crate::vtk::UnstructuredGrid;

/// Cells that are worked on at a time; their results wait in memory.
const BLOCK: usize = 1 << 14;

/// A cell's part in the gradient at a point.
#[derive(Clone, Copy, Debug)]
struct Share {
    point: u32,
    /// The size of the cell.
    weight: f64,
    gradient: Vector,
}

/// The gradients of `values`, one a point, by the quadratic cells of one dimension
/// (2 or 3): those of each cell's own polynomial, in space, through its curved shape.
///
/// A point gets the mean over its cells, weighted by their size: a sliver's gradient
/// is the least certain and hardly counts. On a surface the gradient is tangential.
/// It is exact for quadratics on cells with straight edges; those without nodes
/// inside faces have to be affine images of the reference cell, unless they are
/// triangles or tetrahedra anyway.
///
/// Nothing at points without such cells, or where all of these are degenerate or
/// have values that are not finite; nothing at all if there are no such cells.
pub fn nodal_gradients(
    grid: &UnstructuredGrid,
    points: &[Vector],
    values: &[f64],
    dimension: u8,
) -> Option<Vec<Option<Vector>>> {
    let element = |cell: usize| {
        let nodes = grid.cells.get(cell)?;
        let element = Element::of(grid.types[cell], nodes.len())?;
        (element.reference.dimension() == dimension).then_some((element, nodes))
    };
    let cells = grid.types.len();
    (0..cells).into_par_iter().find_any(|&cell| element(cell).is_some())?;
    let mut sums = vec![(0.0, Vector::zeros()); points.len()];
    for start in (0..cells).step_by(BLOCK) {
        let block = (start..cells.min(start + BLOCK)).into_par_iter();
        let shares =
            block.filter_map(element).flat_map_iter(|(e, nodes)| shares(e, nodes, points, values));
        // in the order of the cells, so that the sums are the same every time
        for Share { point, weight, gradient } in shares.collect::<Vec<Share>>() {
            let (weights, sum) = &mut sums[point as usize];
            *weights += weight;
            *sum += gradient * weight;
        }
    }
    let mean = |(weights, sum): (f64, Vector)| (weights > 0.0).then(|| sum / weights);
    Some(sums.into_iter().map(mean).collect())
}

/// What a cell says about the gradients at its nodes.
fn shares(
    element: &Element,
    nodes: &[i64],
    points: &[Vector],
    values: &[f64],
) -> ArrayVec<Share, MOST_NODES> {
    let mut shares = ArrayVec::new();
    let mut size = 0.0;
    for (node, &point) in nodes.iter().enumerate() {
        let (gradient, determinant) = gradient(element, node, nodes, points, values);
        size += determinant;
        if gradient.iter().all(|x| x.is_finite()) {
            shares.push(Share { point: point as u32, weight: 0.0, gradient });
        }
    }
    // the mean of the determinant is the ratio of sizes, closely enough for a weight
    let weight = element.reference.measure() * size / nodes.len() as f64;
    shares.iter_mut().for_each(|share| share.weight = weight);
    shares.retain(|share| share.weight.is_finite());
    shares
}

/// A node is degenerate if its Jacobian determinant is below this part of the
/// product of its columns.
const FLAT: f64 = 1e-10;

/// The gradient at a node of a cell, and the Jacobian determinant there, without its
/// sign. The gradient is NaN where the cell is degenerate.
fn gradient(
    element: &Element,
    node: usize,
    nodes: &[i64],
    points: &[Vector],
    values: &[f64],
) -> (Vector, f64) {
    let mut columns = [Vector::zeros(); 3];
    let mut slope = [0.0; 3];
    for (&point, by) in nodes.iter().zip(element.slopes(node)) {
        let point = point as usize;
        for axis in 0..3 {
            columns[axis] += points[point] * by[axis];
            slope[axis] += values[point] * by[axis];
        }
    }
    let [a, b, mut c] = columns;
    let on_surface = element.reference.dimension() == 2;
    if on_surface {
        // across the surface nothing changes
        c = a.cross(&b).try_normalize(0.0).unwrap_or_default();
    }
    let determinant = a.cross(&b).dot(&c);
    let product = a.norm() * b.norm() * c.norm();
    if determinant.abs() <= FLAT * product || !product.is_finite() {
        return (Vector::repeat(f64::NAN), 0.0);
    }
    let dual = b.cross(&c) * slope[0] + c.cross(&a) * slope[1] + a.cross(&b) * slope[2];
    (dual / determinant, determinant.abs())
}
