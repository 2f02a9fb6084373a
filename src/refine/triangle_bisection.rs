//! Bisection of triangles: what the longest-edge and the newest-vertex method share.
//!
//! Each triangle has an *apex*, the corner opposite the edge that it is bisected at first;
//! which corner that is makes the method. Edges are marked before anything is divided, and a
//! mark on any edge of a triangle is one on that opposite its apex too. So new points are the
//! middles of edges of the input, a triangle becomes two, three or four, and no point hangs.

use rayon::prelude::*;

use super::Marks;
use super::refinement::{NewPoint, Refinement};
use crate::interruption::checkpoint;
use crate::mesh::{NumberedEdges, TriangleMesh};

/// A triangle that can be bisected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bisectable {
    /// Its points.
    pub corners: [u32; 3],
    /// The corner opposite the edge at which it is bisected.
    pub apex: u8,
}

/// Bisects the marked triangles, and as many others as it takes for all to fit together.
/// `apexes`: one a triangle. Returns the refined mesh, whose state are its apexes.
pub fn bisect(mesh: &TriangleMesh, apexes: &[u8], marks: &Marks) -> Refinement<3> {
    let edges = NumberedEdges::new(mesh);
    let mut marking = Marking::new(&edges, apexes, marks.room(mesh.points().len()));
    for &triangle in marks.cells {
        checkpoint();
        if !marking.add(marking.edge_of(triangle)) {
            break;
        }
    }
    let middles = Middles::new(mesh, &edges, marking.closed());
    let triangles = mesh.triangles().par_iter().zip(apexes).zip(edges.of_triangles());
    let (cells, parents): (Vec<Bisectable>, Vec<u32>) = triangles
        .enumerate()
        .flat_map_iter(|(parent, ((&corners, &apex), sides))| {
            let mut parts = arrayvec::ArrayVec::<Bisectable, 4>::new();
            let middles = sides.map(|edge| middles.of(edge));
            Bisectable { corners, apex }.divide(&middles, &mut |part| parts.push(part));
            parts.into_iter().map(move |part| (part, parent as u32))
        })
        .unzip();
    Refinement {
        cells: cells.par_iter().map(|cell| cell.corners).collect(),
        state: cells.par_iter().map(|cell| u16::from(cell.apex)).collect(),
        parents,
        ..middles.into_points(mesh)
    }
}

impl Bisectable {
    /// Divides at the middles of edges, each opposite a corner: first at that opposite the
    /// apex, then both halves at what was a whole edge of this triangle.
    fn divide(self, middles: &[Option<u32>; 3], parts: &mut impl FnMut(Self)) {
        let apex = usize::from(self.apex);
        let Some(middle) = middles[apex] else { return parts(self) };
        for replaced in [(apex + 2) % 3, (apex + 1) % 3] {
            let mut half = Self { apex: replaced as u8, ..self };
            half.corners[replaced] = middle;
            let mut rest = [None; 3];
            rest[replaced] = middles[replaced];
            half.divide(&rest, parts);
        }
    }
}

/// Marks of edges in the making.
struct Marking<'a> {
    edges: &'a NumberedEdges,
    apexes: &'a [u8],
    marks: Vec<Mark>,
    /// How many more marks there may be.
    room: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mark {
    None,
    /// Marked as soon as the edges are that it asks for.
    Waiting,
    Marked,
}

impl<'a> Marking<'a> {
    fn new(edges: &'a NumberedEdges, apexes: &'a [u8], room: usize) -> Self {
        Self { edges, apexes, marks: vec![Mark::None; edges.count()], room }
    }

    /// The edge opposite the apex.
    fn edge_of(&self, triangle: u32) -> u32 {
        let triangle = triangle as usize;
        self.edges.of_triangles()[triangle][usize::from(self.apexes[triangle])]
    }

    /// Marks an edge, before it those that it asks for: wherever this stops for want of room,
    /// no mark is without those it asks for (but in a ring of edges that ask for each other).
    /// Returns whether there was room.
    fn add(&mut self, edge: u32) -> bool {
        let mut path = vec![edge];
        while let Some(&edge) = path.last() {
            if self.marks[edge as usize] == Mark::Marked {
                path.pop();
                continue;
            }
            self.marks[edge as usize] = Mark::Waiting;
            let asked = self.asked(edge).find(|&next| self.marks[next as usize] == Mark::None);
            match asked {
                Some(next) => path.push(next),
                None if self.room == 0 => return false,
                None => {
                    self.marks[edge as usize] = Mark::Marked;
                    self.room -= 1;
                    path.pop();
                }
            }
        }
        true
    }

    /// The edges that must be marked if this one is.
    fn asked(&self, edge: u32) -> impl Iterator<Item = u32> {
        self.edges.triangles(edge).iter().map(|&triangle| self.edge_of(triangle))
    }

    /// Whether each edge is marked, without marks that lack one they ask for: those of a ring
    /// for which there was no room.
    fn closed(mut self) -> Vec<bool> {
        let is_marked = |marking: &Self, edge: u32| marking.marks[edge as usize] == Mark::Marked;
        while self.room == 0 {
            let all = 0..self.edges.count() as u32;
            let lacks = |edge: &u32| {
                is_marked(&self, *edge) && !self.asked(*edge).all(|next| is_marked(&self, next))
            };
            let open: Vec<u32> = all.filter(lacks).collect();
            if open.is_empty() {
                break;
            }
            open.iter().for_each(|&edge| self.marks[edge as usize] = Mark::None);
        }
        self.marks.into_iter().map(|mark| mark == Mark::Marked).collect()
    }
}

/// New points in the middles of marked edges, in the order of these.
pub struct Middles<'a> {
    edges: &'a NumberedEdges,
    /// The point of each edge; [`NONE`] where it is not marked.
    points: Vec<u32>,
    count: usize,
}

/// Stands for no point.
const NONE: u32 = u32::MAX;

impl<'a> Middles<'a> {
    /// Those of the marked edges.
    pub fn new(mesh: &TriangleMesh, edges: &'a NumberedEdges, marked: Vec<bool>) -> Self {
        let first = mesh.points().len();
        let mut count = 0;
        let points = marked.into_iter().map(|is_marked| {
            if !is_marked {
                return NONE;
            }
            count += 1;
            (first + count - 1) as u32
        });
        let points = points.collect();
        Self { edges, points, count }
    }

    /// The middle of an edge, if it is marked.
    pub fn of(&self, edge: u32) -> Option<u32> {
        Some(self.points[edge as usize]).filter(|&point| point != NONE)
    }

    /// The points of a refinement of `mesh`; no cells.
    pub fn into_points(self, mesh: &TriangleMesh) -> Refinement<3> {
        let marked = self.edges.ends().iter().zip(&self.points).filter(|(_, p)| **p != NONE);
        let mut points = Vec::with_capacity(mesh.points().len() + self.count);
        points.extend_from_slice(mesh.points());
        let mut new_points = Vec::with_capacity(self.count);
        for (&ends, _) in marked {
            let [a, b] = ends.map(|end| mesh.points()[end as usize]);
            points.push((a + b) * 0.5);
            new_points.push(NewPoint::Edge { ends, at: 0.5 });
        }
        Refinement { points, new_points, ..Refinement::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Vector;

    /// Six triangles around a point, each asking for the spoke that the next one has too.
    fn wheel() -> (TriangleMesh<'static>, Vec<u8>) {
        let rim = (0..6).map(|n| Vector::new(f64::from(n).cos(), f64::from(n).sin(), 0.0));
        let points: Vec<Vector> = [Vector::zeros()].into_iter().chain(rim).collect();
        let triangles = (0..6).map(|n| [0, 1 + n, 1 + (n + 1) % 6]).collect();
        (TriangleMesh::new(points, triangles).unwrap(), vec![1; 6])
    }

    #[test]
    fn a_ring_is_divided_as_a_whole_or_not_at_all() {
        let (mesh, apexes) = wheel();
        let marks = |max_points| Marks { max_points, ..Marks::all(&[0]) };
        for (max_points, cells) in [(7, 6), (9, 6), (12, 6), (13, 18), (99, 18)] {
            let refined = bisect(&mesh, &apexes, &marks(max_points));
            assert_eq!(refined.cells.len(), cells, "{max_points}");
            assert_eq!(refined.points.len(), if cells == 6 { 7 } else { 13 });
        }
    }

    #[test]
    fn two_triangles_by_hand() {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let points = points.map(|[x, y]| Vector::new(x, y, 0.0)).to_vec();
        let mesh = TriangleMesh::new(points, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
        let refined = bisect(&mesh, &[1, 2], &Marks::all(&[1]));
        assert_eq!(refined.cells, [[4, 1, 2], [0, 1, 4], [0, 4, 3], [4, 2, 3]]);
        assert_eq!(refined.parents, [0, 0, 1, 1]);
        assert_eq!(refined.state, [0, 2, 1, 0]);
        assert_eq!(refined.new_points, [NewPoint::Edge { ends: [0, 2], at: 0.5 }]);
        assert_eq!(refined.points[4], Vector::new(0.5, 0.5, 0.0));
    }
}
