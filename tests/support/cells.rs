//! Grids of cells of many types that fit together.

use std::collections::HashMap;

use vtu2contour::mesh::Vector;
use vtu2contour::vtk::{DataArray, Polyhedra, UnstructuredGrid};

use super::meshes::Random;

/// Cells by VTK's type and points; polyhedra have faces instead of points.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    pub points: Vec<Vector>,
    pub cells: Vec<(u8, Vec<u32>)>,
    /// The faces of each cell that is a polyhedron.
    pub faces: HashMap<usize, Vec<Vec<u32>>>,
}

/// The edges of VTK's linear cells, in the order of the mid nodes of quadratic ones.
pub const TETRAHEDRON_EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
pub const HEXAHEDRON_EDGES: [[usize; 2]; 12] = [
    [0, 1],
    [1, 2],
    [2, 3],
    [3, 0],
    [4, 5],
    [5, 6],
    [6, 7],
    [7, 4],
    [0, 4],
    [1, 5],
    [2, 6],
    [3, 7],
];
pub const WEDGE_EDGES: [[usize; 2]; 9] =
    [[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]];
pub const PYRAMID_EDGES: [[usize; 2]; 8] =
    [[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 4], [2, 4], [3, 4]];
/// Their faces, in the order of the nodes inside them.
const HEXAHEDRON_FACES: [&[usize]; 6] =
    [&[0, 4, 7, 3], &[1, 2, 6, 5], &[0, 1, 5, 4], &[3, 7, 6, 2], &[0, 3, 2, 1], &[4, 5, 6, 7]];
const WEDGE_FACES: [&[usize]; 3] = [&[0, 1, 4, 3], &[1, 2, 5, 4], &[2, 0, 3, 5]];
const PYRAMID_FACES: [&[usize]; 5] =
    [&[0, 3, 2, 1], &[0, 1, 4], &[1, 2, 4], &[2, 3, 4], &[3, 0, 4]];

impl Cells {
    /// The unit cube in `n` by `n` by `n` boxes, inner points moved by `jitter` of a
    /// box at most. Columns of boxes are cut into wedges, or each box of a column is
    /// a hexahedron, six pyramids or a polyhedron, whichever of the types 12, 13, 14
    /// and 42 is among the `kinds`, at random.
    pub fn cube(n: usize, jitter: f64, kinds: &[u8], random: &mut Random) -> Self {
        let boxes: Vec<u8> = kinds.iter().copied().filter(|&kind| kind != 13).collect();
        let mut cells = Self::default();
        for place in 0..(n + 1).pow(3) {
            let index = [place % (n + 1), place / (n + 1) % (n + 1), place / (n + 1).pow(2)];
            let inner = index.iter().all(|&i| i > 0 && i < n);
            let mut shift = || if inner { random.uniform(-jitter, jitter) } else { 0.0 };
            cells.points.push(Vector::from(index.map(|i| (i as f64 + shift()) / n as f64)));
        }
        let point = |x: usize, y: usize, z: usize| (x + (n + 1) * (y + (n + 1) * z)) as u32;
        for (x, y) in (0..n).flat_map(|x| (0..n).map(move |y| (x, y))) {
            let wedges = kinds.contains(&13) && random.uniform(0.0, 1.0) < 0.3;
            for z in 0..n {
                let corner = |[a, b]: [usize; 2], c: usize| point(x + a, y + b, z + c);
                let square = [[0, 0], [1, 0], [1, 1], [0, 1]];
                let corners: Vec<u32> =
                    (0..8).map(|node| corner(square[node % 4], node / 4)).collect();
                match boxes[random.uniform(0.0, boxes.len() as f64) as usize] {
                    _ if wedges => cells.push_wedges(&corners),
                    14 => cells.push_pyramids(&corners),
                    42 => cells.push_polyhedron(&corners),
                    kind => cells.cells.push((kind, corners)),
                }
            }
        }
        cells
    }

    fn push_wedges(&mut self, corners: &[u32]) {
        for nodes in [[0, 1, 2, 4, 5, 6], [0, 2, 3, 4, 6, 7]] {
            self.cells.push((13, nodes.map(|node: usize| corners[node]).to_vec()));
        }
    }

    fn push_pyramids(&mut self, corners: &[u32]) {
        let sum: Vector = corners.iter().map(|&corner| self.points[corner as usize]).sum();
        let apex = self.points.len() as u32;
        self.points.push(sum / 8.0);
        for face in HEXAHEDRON_FACES {
            // the base of a pyramid is counter-clockwise from its apex
            let mut nodes: Vec<u32> = face.iter().rev().map(|&node| corners[node]).collect();
            nodes.push(apex);
            self.cells.push((14, nodes));
        }
    }

    fn push_polyhedron(&mut self, corners: &[u32]) {
        let faces = HEXAHEDRON_FACES.map(|face| face.iter().map(|&node| corners[node]).collect());
        // the file need not say which side is outside
        let mut faces = faces.to_vec();
        faces.iter_mut().step_by(2).for_each(|face: &mut Vec<u32>| face.reverse());
        self.faces.insert(self.cells.len(), faces);
        self.cells.push((42, corners.to_vec()));
    }

    /// The same cells of order two, edges straight: without nodes inside faces (13,
    /// 15 or 20 nodes) or with them (18, 19 or 27).
    pub fn quadratic(&self, inner: bool) -> Self {
        let mut grid = Self { points: self.points.clone(), ..Self::default() };
        let mut middles = HashMap::new();
        for (cell_type, corners) in &self.cells {
            let (edges, faces, serendipity, full): (&[[usize; 2]], &[&[usize]], u8, u8) =
                match cell_type {
                    10 => (&TETRAHEDRON_EDGES, &[], 24, 24),
                    12 => (&HEXAHEDRON_EDGES, &HEXAHEDRON_FACES, 25, 29),
                    13 => (&WEDGE_EDGES, &WEDGE_FACES, 26, 32),
                    14 => (&PYRAMID_EDGES, &PYRAMID_FACES, 27, 37),
                    other => panic!("type {other} has no quadratic kind here"),
                };
            let mut nodes = corners.clone();
            let mut middle = |places: &[usize]| {
                let mut ends: Vec<u32> = places.iter().map(|&place| corners[place]).collect();
                ends.sort_unstable();
                let sum: Vector = ends.iter().map(|&end| grid.points[end as usize]).sum();
                let count = ends.len() as f64;
                *middles.entry(ends).or_insert_with(|| {
                    grid.points.push(sum / count);
                    grid.points.len() as u32 - 1
                })
            };
            nodes.extend(edges.iter().map(|edge| middle(edge)));
            if inner {
                nodes.extend(faces.iter().map(|face| middle(face)));
            }
            if inner && matches!(cell_type, 12 | 14) {
                let all: Vec<usize> = (0..corners.len()).collect();
                nodes.push(middle(&all));
            }
            grid.cells.push((if inner { full } else { serendipity }, nodes));
        }
        grid
    }

    /// The same cells with points numbered at random.
    pub fn renumbered(&self, random: &mut Random) -> Self {
        let mut order: Vec<u32> = (0..self.points.len() as u32).collect();
        for last in (1..order.len()).rev() {
            order.swap(last, random.uniform(0.0, last as f64 + 1.0) as usize);
        }
        let mut points = self.points.clone();
        for (point, &number) in self.points.iter().zip(&order) {
            points[number as usize] = *point;
        }
        let renumber = |nodes: &[u32]| nodes.iter().map(|&node| order[node as usize]).collect();
        let cells = self.cells.iter().map(|(t, nodes)| (*t, renumber(nodes))).collect();
        let faces = self.faces.iter().map(|(&cell, faces)| {
            (cell, faces.iter().map(|face| renumber(face)).collect::<Vec<Vec<u32>>>())
        });
        Self { points, cells, faces: faces.collect() }
    }

    /// As a grid.
    pub fn grid(&self) -> UnstructuredGrid {
        let coordinates: Vec<f64> = self.points.iter().flat_map(|p| [p.x, p.y, p.z]).collect();
        let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, coordinates));
        let mut polyhedra = Polyhedra::default();
        let wide = |nodes: &[u32]| nodes.iter().map(|&n| i64::from(n)).collect::<Vec<i64>>();
        for (cell, (cell_type, nodes)) in self.cells.iter().enumerate() {
            grid.push_cell(*cell_type, &wide(nodes));
            let faces = self.faces.get(&cell).map(Vec::as_slice).unwrap_or_default();
            let first = polyhedra.faces.len() as i64;
            faces.iter().for_each(|face| polyhedra.faces.push(&wide(face)));
            polyhedra.cells.push(&(first..first + faces.len() as i64).collect::<Vec<i64>>());
        }
        grid.polyhedra = Some(polyhedra).filter(|_| !self.faces.is_empty());
        grid
    }
}
