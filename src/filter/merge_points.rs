//! Points at the same place made one.
//!
//! Discontinuous elements give each cell its own points. Nothing is connected then, and
//! every contour ends at every edge.

use std::borrow::Cow;
use std::collections::HashMap;

use super::error::FilterError;
use crate::mesh::SimplexMesh;
use crate::vtk::{CellArray, DataArray, UnstructuredGrid, Values};

/// The grid with points no further apart than `tolerance` (a length; 0 for points at
/// exactly the same place) made one; the grid itself without a tolerance.
///
/// Cells name the point of lowest number instead of the others, whose floating-point data
/// are averaged there. The others stay, without cells. Faces of polyhedra keep theirs.
///
/// # Errors
/// If the tolerance is negative or no number.
pub fn merge_points(
    grid: &UnstructuredGrid,
    tolerance: Option<f64>,
) -> Result<Cow<'_, UnstructuredGrid>, FilterError> {
    let Some(tolerance) = tolerance else { return Ok(Cow::Borrowed(grid)) };
    if tolerance.is_nan() || tolerance < 0.0 {
        return Err(FilterError::MergeTolerance { value: tolerance });
    }
    let points = grid.points.to_f64().unwrap_or_default();
    let leaders = leaders(&points, tolerance);
    let mut merged = grid.clone();
    let mut cells = CellArray::new();
    for cell in grid.cells.iter() {
        // the reader has checked that every index is that of a point
        let corners: Vec<i64> =
            cell.iter().map(|&point| i64::from(leaders[point as usize])).collect();
        cells.push(&corners);
    }
    merged.cells = cells;
    for array in grid.point_data.iter() {
        if let Some(values) = averaged(array, &leaders) {
            // an array of a name that is there takes its place
            merged.point_data.push(DataArray { values, ..array.clone() });
        }
    }
    Ok(Cow::Owned(merged))
}

/// So many boxes along an axis can be told apart.
const BOXES: f64 = 1e18;

/// For each point the first one within the tolerance.
fn leaders(coordinates: &[f64], tolerance: f64) -> Vec<u32> {
    let largest =
        coordinates.iter().filter(|x| x.is_finite()).fold(0.0, |a: f64, x| a.max(x.abs()));
    // boxes are counted by whole numbers; so small a tolerance says no more than zero
    let tolerance = if tolerance * BOXES < largest { 0.0 } else { tolerance };
    let mut boxes: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    let mut leaders = Vec::with_capacity(coordinates.len() / 3);
    for (number, point) in coordinates.chunks_exact(3).enumerate() {
        let own = box_of(point, tolerance);
        let is_near = |&leader: &u32| {
            let other = &coordinates[3 * leader as usize..][..3];
            let squares = point.iter().zip(other).map(|(a, b)| (a - b).powi(2));
            squares.sum::<f64>().sqrt() <= tolerance
        };
        let around = neighbours(own, tolerance).filter_map(|at| boxes.get(&at)).flatten();
        let leader = around.copied().filter(is_near).min().unwrap_or(number as u32);
        if leader == number as u32 && point.iter().all(|x| x.is_finite()) {
            boxes.entry(own).or_default().push(leader);
        }
        leaders.push(leader);
    }
    leaders
}

/// The box of a point, as wide as the tolerance; without one, its coordinates' bits.
fn box_of(point: &[f64], tolerance: f64) -> [i64; 3] {
    let along = |x: f64| {
        // adding zero makes -0 and 0 the same
        if tolerance > 0.0 { (x / tolerance).floor() as i64 } else { (x + 0.0).to_bits() as i64 }
    };
    [along(point[0]), along(point[1]), along(point[2])]
}

/// A box and those around it; the box alone without a tolerance.
fn neighbours([x, y, z]: [i64; 3], tolerance: f64) -> impl Iterator<Item = [i64; 3]> {
    let reach = i64::from(tolerance > 0.0);
    let near = move |c: i64| (-reach..=reach).map(move |step| c.saturating_add(step));
    near(x).flat_map(move |x| near(y).flat_map(move |y| near(z).map(move |z| [x, y, z])))
}

/// The values with those of merged points averaged at their leader; nothing for whole
/// numbers and text, which have no mean.
fn averaged(array: &DataArray, leaders: &[u32]) -> Option<Values> {
    let is_float = matches!(array.values, Values::F32(_) | Values::F64(_));
    let mut values = array.to_f64().filter(|_| is_float)?;
    let mut counts = vec![0_u32; leaders.len()];
    for (point, &leader) in leaders.iter().enumerate() {
        counts[leader as usize] += 1;
        if leader as usize != point {
            for n in 0..array.components {
                values[leader as usize * array.components + n] +=
                    values[point * array.components + n];
            }
        }
    }
    for (tuple, &count) in values.chunks_exact_mut(array.components).zip(&counts) {
        tuple.iter_mut().for_each(|value| *value /= f64::from(count.max(1)));
    }
    Some(match array.values {
        Values::F32(_) => Values::F32(values.into_iter().map(|value| value as f32).collect()),
        _ => Values::F64(values),
    })
}

/// A line if many points of the mesh are at the place of another.
///
/// A mesh whose cells share points has about half as many as triangles: only one with at
/// least as many is looked at.
pub fn coincidence_warning<const CORNERS: usize>(mesh: &SimplexMesh<CORNERS>) -> Option<String> {
    // fewer points than cells: most of them are shared
    if mesh.points().len() < mesh.simplices().len() {
        return None;
    }
    let mut used = vec![false; mesh.points().len()];
    mesh.simplices().iter().flatten().for_each(|&point| used[point as usize] = true);
    let points = mesh.points().iter().zip(&used).filter(|(_, used)| **used);
    let mut places: Vec<[f64; 3]> = points.map(|(point, _)| [point.x, point.y, point.z]).collect();
    let total = places.len();
    if total < mesh.simplices().len() {
        return None;
    }
    places.sort_unstable_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
    places.dedup();
    let coincident = total - places.len();
    (4 * coincident >= total).then(|| {
        format!(
            "{coincident} of {total} points are at the place of another: cells are not connected \
             there, and lines end at their edges; --merge-points 0 makes them one"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles of the unit square, each with its own points; the gap between them is
    /// `gap`.
    fn torn_square(gap: f64) -> UnstructuredGrid {
        let g = gap;
        let points = vec![
            0.0,
            0.0,
            0.0,
            1.0,
            0.0,
            0.0,
            1.0,
            1.0,
            0.0, //
            0.0,
            g,
            0.0,
            1.0,
            1.0 + g,
            0.0,
            -0.0,
            1.0,
            0.0,
        ];
        let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, points));
        grid.push_cell(5, &[0, 1, 2]);
        grid.push_cell(5, &[3, 4, 5]);
        let values: Vec<f64> = (0..6).map(f64::from).collect();
        grid.point_data.push(DataArray::new("u", 1, values));
        grid.point_data.push(DataArray::new("id", 1, Values::I32((0..6).collect())));
        grid
    }

    #[test]
    fn points_are_merged_and_their_values_averaged() {
        for (gap, tolerance) in [(0.0, 0.0), (1e-9, 1e-8)] {
            let grid = torn_square(gap);
            let merged = merge_points(&grid, Some(tolerance)).unwrap();
            let cells: Vec<&[i64]> = merged.cells.iter().collect();
            assert_eq!(cells, [[0, 1, 2], [0, 2, 5]]);
            let u = merged.point_data.get("u").unwrap().to_f64().unwrap();
            assert_eq!([u[0], u[1], u[2], u[5]], [1.5, 1.0, 3.0, 5.0]);
            assert_eq!(merged.point_data.get("id"), grid.point_data.get("id"));
        }
    }

    #[test]
    fn nothing_is_merged_beyond_the_tolerance_or_unasked() {
        let grid = torn_square(1e-9);
        assert_eq!(*merge_points(&grid, Some(1e-10)).unwrap(), grid);
        assert_eq!(*merge_points(&grid, None).unwrap(), grid);
        for tolerance in [-1.0, f64::NAN] {
            assert!(merge_points(&grid, Some(tolerance)).is_err());
        }
    }
}
