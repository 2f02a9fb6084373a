//! Lines of a grid as curves: boundaries that refinement puts its new points on.

use std::collections::HashMap;

use super::error::FilterError;
use crate::mesh::Vector;
use crate::vtk::UnstructuredGrid;

/// VTK's cell types of two points, and of several one after the other.
const LINE: u8 = 3;
const POLYLINE: u8 = 4;

/// The curves that the lines and polylines of a grid make, in the grid's unit of length.
///
/// Lines that share a point, or have points at the same place, go on in each other; where three
/// or more meet, each ends. A closed curve ends with its first point. Other cells are ignored.
///
/// # Errors
/// If there are no lines.
pub fn boundary_curves(grid: &UnstructuredGrid) -> Result<Vec<Vec<Vector>>, FilterError> {
    let points = grid.points.to_f64().unwrap_or_default();
    let points: Vec<Vector> =
        points.chunks_exact(3).map(|at| Vector::new(at[0], at[1], at[2])).collect();
    let chains = Segments::new(grid, &points).into_chains();
    if chains.is_empty() {
        return Err(FilterError::NoLines);
    }
    let place = |point: &usize| points[*point];
    Ok(chains.iter().map(|chain| chain.iter().map(place).collect()).collect())
}

/// Lines of two points each, which stand for all points at the same place.
struct Segments {
    ends: Vec<[usize; 2]>,
    /// The segments at each point.
    around: HashMap<usize, Vec<usize>>,
    is_taken: Vec<bool>,
}

impl Segments {
    fn new(grid: &UnstructuredGrid, points: &[Vector]) -> Self {
        let mut first_there = HashMap::new();
        let mut segments = Self { ends: Vec::new(), around: HashMap::new(), is_taken: Vec::new() };
        let lines = grid.types.iter().zip(grid.cells.iter());
        for (_, line) in lines.filter(|(kind, _)| [LINE, POLYLINE].contains(kind)) {
            let known: Vec<usize> = line
                .iter()
                .filter_map(|&point| usize::try_from(point).ok().filter(|&p| p < points.len()))
                .map(|point| {
                    // zeros of both signs are one
                    let place = points[point].map(|x| (x + 0.0).to_bits());
                    *first_there.entry(<[u64; 3]>::from(place)).or_insert(point)
                })
                .collect();
            known.windows(2).for_each(|ends| segments.push([ends[0], ends[1]]));
        }
        segments
    }

    fn push(&mut self, ends: [usize; 2]) {
        if ends[0] != ends[1] {
            let number = self.ends.len();
            ends.iter().for_each(|&end| self.around.entry(end).or_default().push(number));
            self.ends.push(ends);
            self.is_taken.push(false);
        }
    }

    /// The points of whole lines: first of those that end somewhere, then of closed ones.
    fn into_chains(mut self) -> Vec<Vec<usize>> {
        let mut chains = Vec::new();
        for only_from_ends in [true, false] {
            for segment in 0..self.ends.len() {
                for start in self.ends[segment] {
                    let is_start = !only_from_ends || self.around[&start].len() != 2;
                    if is_start && !self.is_taken[segment] {
                        chains.push(self.follow(start, segment));
                    }
                }
            }
        }
        chains
    }

    /// The points from a start along a segment, as far as it goes on.
    fn follow(&mut self, start: usize, segment: usize) -> Vec<usize> {
        let (mut chain, mut next) = (vec![start], Some(segment));
        let mut here = start;
        while let Some(segment) = next {
            self.is_taken[segment] = true;
            let [a, b] = self.ends[segment];
            here = if a == here { b } else { a };
            chain.push(here);
            let around = &self.around[&here];
            let free = around.iter().copied().find(|&other| !self.is_taken[other]);
            next = free.filter(|_| around.len() == 2);
        }
        chain
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vtk::DataArray;

    fn grid(cells: &[(u8, &[i64])]) -> UnstructuredGrid {
        // points 0 and 5 are at the same place
        let x = [0.0, 1.0, 2.0, 3.0, 4.0, 0.0, 6.0];
        let points: Vec<f64> = x.iter().flat_map(|&x| [x, 0.0, 0.0]).collect();
        let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, points));
        cells.iter().for_each(|(kind, points)| grid.push_cell(*kind, points));
        grid
    }

    fn curves(cells: &[(u8, &[i64])]) -> Vec<Vec<f64>> {
        let found = boundary_curves(&grid(cells)).unwrap();
        found.iter().map(|curve| curve.iter().map(|point| point.x).collect()).collect()
    }

    #[test]
    fn lines_go_on_in_each_other() {
        let open: [(u8, &[i64]); 3] = [(LINE, &[2, 1]), (LINE, &[1, 0]), (POLYLINE, &[2, 3, 4])];
        assert_eq!(curves(&open), [[0.0, 1.0, 2.0, 3.0, 4.0]]);
        let closed: [(u8, &[i64]); 2] = [(POLYLINE, &[0, 1, 2, 3]), (LINE, &[3, 5])];
        assert_eq!(curves(&closed), [[0.0, 1.0, 2.0, 3.0, 0.0]]);
    }

    #[test]
    fn three_that_meet_end_there() {
        let star: [(u8, &[i64]); 2] = [(POLYLINE, &[1, 2, 3]), (LINE, &[2, 4])];
        assert_eq!(curves(&star), [[1.0, 2.0], [2.0, 3.0], [2.0, 4.0]]);
    }

    #[test]
    fn without_lines_there_is_no_curve() {
        assert!(matches!(boundary_curves(&grid(&[(5, &[0, 1, 2])])), Err(FilterError::NoLines)));
        assert!(matches!(boundary_curves(&grid(&[(LINE, &[0, 5])])), Err(FilterError::NoLines)));
    }
}
