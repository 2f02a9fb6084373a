//! Where cells and points of a triangulation come from.

use std::sync::LazyLock;

use rayon::prelude::*;

use super::NewPoint;
use crate::mesh::{PointLocator, TriangleMesh, Vector};

/// Finds cells of the input: mostly among those around a corner that is near, which takes less
/// than a search in the whole mesh.
pub struct Origins<'a> {
    mesh: &'a TriangleMesh<'a>,
    /// A number for each cell, or none.
    regions: &'a [u32],
    /// The cells around each point, one after the other.
    around: Vec<u32>,
    /// Where those of each point begin, and the end of the last.
    offsets: Vec<u32>,
    locator: LazyLock<PointLocator, Box<dyn FnOnce() -> PointLocator + Send + Sync + 'a>>,
}

/// A place with all weights above this is in a cell: rounding.
const INSIDE: f64 = -1e-12;

impl<'a> Origins<'a> {
    /// `regions`: one number a cell of the mesh, or none.
    pub fn new(mesh: &'a TriangleMesh<'a>, regions: &'a [u32]) -> Self {
        let mut offsets = vec![0; mesh.points().len() + 1];
        let corners = || mesh.triangles().iter().flatten().map(|&point| point as usize);
        corners().for_each(|point| offsets[point + 1] += 1);
        for point in 0..mesh.points().len() {
            offsets[point + 1] += offsets[point];
        }
        let mut next = offsets.clone();
        let mut around = vec![0; 3 * mesh.triangles().len()];
        for (place, point) in corners().enumerate() {
            around[next[point] as usize] = (place / 3) as u32;
            next[point] += 1;
        }
        let locator = LazyLock::new(Box::new(|| PointLocator::new(mesh)) as Box<_>);
        Self { mesh, regions, around, offsets, locator }
    }

    /// A cell turned as the one it comes from, which is told too: in which its middle lies, or
    /// where a curve moved the border of its region, the nearest of this region. A cell of the
    /// input is as it was.
    /// `likely`: the number of the input's cell that it probably is.
    pub fn of_cell(
        &self,
        cell: [u32; 3],
        region: u32,
        points: &[Vector],
        likely: u32,
    ) -> ([u32; 3], u32) {
        let near = || cell.iter().flat_map(|&corner| self.cells_around(corner));
        let all = self.mesh.triangles();
        let is_likely = |old: &[u32; 3]| old.iter().all(|point| cell.contains(point));
        if let Some(&same) = all.get(likely as usize).filter(|old| is_likely(old)) {
            return (same, likely);
        }
        let is_same =
            |old: &&u32| self.mesh.triangles()[**old as usize].iter().all(|p| cell.contains(p));
        if let Some(&same) = near().find(is_same) {
            return (self.mesh.triangles()[same as usize], same);
        }
        let [a, b, c] = cell.map(|point| points[point as usize]);
        let middle = (a + b + c) / 3.0;
        let is_of_region = |old: u32| self.region(old) == region;
        let parent = self.holder(near().copied().filter(|&old| is_of_region(old)), &middle);
        let parent = parent.unwrap_or_else(|| self.nearest(&middle, region));
        let normal = (b - a).cross(&(c - a));
        let is_turned = normal.dot(self.mesh.frame(parent as usize).normal()) < 0.0;
        (if is_turned { [cell[0], cell[2], cell[1]] } else { cell }, parent)
    }

    /// Where a point is. `likely`: cells that probably hold it.
    pub fn of_point(&self, point: &Vector, likely: &[u32]) -> NewPoint<3> {
        if let Some(cell) = self.holder(likely.iter().copied(), point) {
            let at = self.mesh.weights_at(cell as usize, point);
            return NewPoint::Inside { cell, at };
        }
        match self.locator.locate(self.mesh, point, f64::INFINITY) {
            Some(found) => NewPoint::Inside { cell: found.simplex as u32, at: found.at },
            None => NewPoint::Inside { cell: 0, at: [1.0 / 3.0; 3] },
        }
    }

    /// The cells of the input around a point of it; none around a new one.
    fn cells_around(&self, point: u32) -> &[u32] {
        let bounds = self.offsets.get(point as usize..point as usize + 2);
        bounds.map_or(&[], |bounds| &self.around[bounds[0] as usize..bounds[1] as usize])
    }

    fn region(&self, cell: u32) -> u32 {
        self.regions.get(cell as usize).copied().unwrap_or(0)
    }

    /// Of some cells the one in which a place lies furthest from the sides.
    fn holder(&self, cells: impl Iterator<Item = u32>, place: &Vector) -> Option<u32> {
        let depths = cells.map(|cell| (self.depth(cell, place), cell));
        let deepest =
            depths.max_by(|one, other| one.0.total_cmp(&other.0).then(other.1.cmp(&one.1)));
        deepest.filter(|(depth, _)| *depth >= INSIDE).map(|(_, cell)| cell)
    }

    /// The least weight of a place: negative outside.
    fn depth(&self, cell: u32, place: &Vector) -> f64 {
        self.mesh.weights_at(cell as usize, place).into_iter().fold(f64::INFINITY, f64::min)
    }

    /// The cell of a region that holds a place, or is nearest to it.
    fn nearest(&self, place: &Vector, region: u32) -> u32 {
        let found = self.locator.locate(self.mesh, place, f64::INFINITY);
        let cell = found.map_or(0, |found| found.simplex as u32);
        if self.region(cell) == region {
            return cell;
        }
        // beyond a border that a curve moved: so few that a search through all will do
        let distance = |cell: u32| -> f64 {
            let corners = self.mesh.corners(cell as usize);
            (corners.iter().sum::<Vector>() / 3.0 - place).norm_squared()
        };
        let cells = (0..self.mesh.triangles().len() as u32).into_par_iter();
        let of_region = cells.filter(|&cell| self.region(cell) == region);
        let nearest = of_region
            .min_by(|&one, &other| distance(one).total_cmp(&distance(other)).then(one.cmp(&other)));
        nearest.unwrap_or(cell)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_and_points_by_hand() {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.4, 0.3], [0.5, 0.7]];
        let points = points.map(|[x, y]| Vector::new(x, y, 0.0));
        let cells = vec![[0, 1, 2], [2, 3, 0]];
        let mesh = TriangleMesh::new(points[..4].to_vec(), cells).unwrap();
        let origins = Origins::new(&mesh, &[]);
        assert_eq!(origins.of_cell([0, 2, 3], 0, &points, 7), ([2, 3, 0], 1));
        assert_eq!(origins.of_cell([0, 1, 4], 0, &points, 7), ([0, 1, 4], 0));
        assert_eq!(origins.of_cell([3, 5, 2], 0, &points, 7), ([3, 5, 2], 1));
        let regions = [7, 8];
        let origins = Origins::new(&mesh, &regions);
        assert_eq!(origins.of_cell([0, 1, 4], 8, &points, 0).1, 1);
        for likely in [&[0, 1][..], &[]] {
            let NewPoint::Inside { cell, at } = origins.of_point(&points[5], likely) else {
                panic!()
            };
            assert_eq!(cell, 1);
            assert!((mesh.position(1, &at) - points[5]).norm() < 1e-15);
        }
    }
}
