//! Plateaus: cells that lie on the level as a whole.
//!
//! A surface is the border of a region. A plateau is inside it or outside, as a whole, and
//! either border is closed; it counts as on the side that is rarer around it, so that as
//! much as possible of its outline is drawn. All of a plateau that hangs together by its points
//! counts as on one side, as do then the points: so the cells around it agree.

use std::collections::HashMap;

use super::cell::Cell;
use crate::contour::components::components;
use crate::interruption::checkpoint;

/// Gives the points of plateaus their sides.
pub fn settle_plateaus(cells: &mut [Cell]) {
    let plateau: Vec<[u32; 4]> =
        cells.iter().filter(|cell| cell.is_plateau).map(|cell| cell.points).collect();
    if plateau.is_empty() {
        return;
    }
    let component = components(plateau.len(), |n| plateau[n]);
    let of_cell = |(points, &component): (&[u32; 4], &usize)| points.map(|p| (p, component));
    let of_point: HashMap<u32, usize> = plateau.iter().zip(&component).flat_map(of_cell).collect();
    // whole numbers: the same in whatever order
    let mut around = vec![0_i64; plateau.len()];
    for cell in cells.iter() {
        checkpoint();
        for component in cell.points.iter().filter_map(|point| of_point.get(point)) {
            around[*component] += predominance(cell);
        }
    }
    for cell in cells {
        checkpoint();
        for (rise, point) in cell.rises.iter_mut().zip(cell.points) {
            if let Some(&component) = of_point.get(&point) {
                *rise = if around[component] > 0 { -1.0 } else { 1.0 };
            }
        }
    }
}

/// How many more coefficients of a cell are above the level than below.
fn predominance(cell: &Cell) -> i64 {
    let side = |value: &f64| i64::from(*value > 0.0) - i64::from(*value < 0.0);
    cell.cubic.coefficients.iter().map(side).sum()
}
