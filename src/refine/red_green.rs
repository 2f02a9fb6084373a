//! Regular refinement of triangles.
//!
//! R. E. Bank, A. H. Sherman, A. Weiser (1983); thesis, A.1.3. A marked triangle is divided in
//! four by the middles of its edges (*red*), and so is each that has two divided edges then. One
//! with a single divided edge is bisected for the time being (*green*): before the next step
//! the two halves are one triangle again. So all triangles are similar to those of the first
//! mesh, or halves of such.

use std::collections::HashMap;

use rayon::prelude::*;

use super::longest_edge::corners_opposite_longest;
use super::triangle_bisection::Middles;
use super::{Marks, RefineError, Refinement};
use crate::interruption::checkpoint;
use crate::mesh::{NumberedEdges, TriangleMesh};

/// Divides the marked triangles in four.
///
/// The state tells which triangles are green halves, and how they lie together. Without it
/// halves count as triangles of their own, and angles may be halved again. Halves whose common
/// point on the divided edge is no longer in its middle stay as they are.
///
/// # Errors
/// If a mark is no triangle of the mesh, the state does not fit it, or a triangle cannot be
/// divided.
pub fn red_green(mesh: &TriangleMesh, marks: &Marks) -> Result<Refinement<3>, RefineError> {
    marks.check(mesh)?;
    let joined = Joined::new(mesh, marks.state)?;
    let whole =
        TriangleMesh::view(mesh.points(), &joined.corners).map_err(|_| RefineError::State)?;
    let edges = NumberedEdges::new(&whole);
    let room = marks.room(mesh.points().len());
    let marking = Marking::new(&joined, &edges, room);
    let marked = marked_edges(&marking, marks.cells, || corners_opposite_longest(&whole));
    let middles = Middles::new(&whole, &edges, marked);
    let parts: Vec<Part> = (0..joined.corners.len())
        .into_par_iter()
        .flat_map_iter(|triangle| joined.divide(triangle, &edges, &middles))
        .collect();
    Ok(Refinement {
        cells: parts.iter().map(|part| part.corners).collect(),
        parents: parts.iter().map(|part| part.parent).collect(),
        state: parts.iter().map(|part| part.state).collect(),
        ..middles.into_points(mesh)
    })
}

/// A triangle of the refined mesh.
struct Part {
    corners: [u32; 3],
    parent: u32,
    state: u16,
}

/// The state of a triangle that is no half.
const REGULAR: u16 = 0;

/// The state of a half: which of its corners is the middle of the divided edge, and which is
/// an end of that.
fn half_state(middle: usize, end: usize) -> u16 {
    1 + 3 * middle as u16 + end as u16
}

/// What [`half_state`] was made of.
fn half_corners(state: u16) -> Result<Option<[usize; 2]>, RefineError> {
    let Some(code) = state.checked_sub(1).map(usize::from) else { return Ok(None) };
    let [middle, end] = [code / 3, code % 3];
    let fits = middle < 3 && middle != end;
    fits.then_some(Some([middle, end])).ok_or(RefineError::State)
}

/// A green triangle: what is known of it beside its corners.
#[derive(Clone, Copy)]
struct Green {
    /// The middle of its divided edge.
    middle: u32,
    /// The corner that is opposite that edge.
    apex: usize,
    /// Its two halves, that with the corner after the apex first.
    halves: [u32; 2],
}

/// The triangles, halves joined.
struct Joined {
    corners: Vec<[u32; 3]>,
    /// For each triangle its number in the mesh; of a green one, its first half's.
    cells: Vec<u32>,
    greens: HashMap<u32, Green>,
    /// For each triangle of the mesh, the one that it is or is part of.
    of_cells: Vec<u32>,
}

impl Joined {
    fn new(mesh: &TriangleMesh, state: &[u16]) -> Result<Self, RefineError> {
        let count = mesh.triangles().len();
        let partners = partners(mesh, state)?;
        let mut joined = Self {
            corners: Vec::with_capacity(count),
            cells: Vec::with_capacity(count),
            greens: HashMap::new(),
            of_cells: vec![0; count],
        };
        for (cell, &corners) in mesh.triangles().iter().enumerate() {
            let triangle = joined.corners.len() as u32;
            match partners.get(&(cell as u32)) {
                Some(half) if half.partner < cell as u32 => {
                    joined.of_cells[cell] = joined.of_cells[half.partner as usize];
                    continue;
                }
                Some(half) => {
                    let (whole, green) = half.joined(corners, cell as u32);
                    joined.corners.push(whole);
                    joined.greens.insert(triangle, green);
                }
                None => joined.corners.push(corners),
            }
            joined.cells.push(cell as u32);
            joined.of_cells[cell] = triangle;
        }
        Ok(joined)
    }

    /// The parts of a triangle.
    fn divide(
        &self,
        triangle: usize,
        edges: &NumberedEdges,
        middles: &Middles,
    ) -> arrayvec::ArrayVec<Part, 8> {
        let corners = self.corners[triangle];
        let green = self.greens.get(&(triangle as u32));
        let mut points = edges.of_triangles()[triangle].map(|edge| middles.of(edge));
        let mut parents = [self.cells[triangle]; 4];
        if let Some(Green { middle, apex, halves }) = green {
            points[*apex] = Some(*middle);
            // the one at the apex and the one in the middle lie in both halves alike
            parents[(apex + 1) % 3] = halves[0];
            parents[(apex + 2) % 3] = halves[1];
            parents[3] = halves[1];
        }
        let mut parts = arrayvec::ArrayVec::new();
        match points {
            [None, None, None] => {
                parts.push(Part { corners, parent: parents[0], state: REGULAR });
            }
            [Some(a), Some(b), Some(c)] => {
                let [p, q, r] = corners;
                let children = [[p, c, b], [c, q, a], [b, a, r], [a, b, c]];
                for (corner, child) in children.into_iter().enumerate() {
                    // an edge that was a half before may be divided again
                    let divided = (0..3).find_map(|apex| {
                        let [a, b] = [child[(apex + 1) % 3], child[(apex + 2) % 3]];
                        Some((apex, middles.of(edges.find(a, b).filter(|_| green.is_some())?)?))
                    });
                    add_halves(&mut parts, child, [parents[corner]; 2], divided);
                }
            }
            _ => {
                let divided = (0..3).find_map(|apex| Some((apex, points[apex]?)));
                let halves = green.map_or([parents[0]; 2], |green| green.halves);
                add_halves(&mut parts, corners, halves, divided);
            }
        }
        parts
    }
}

/// Adds a triangle, or its two halves if an edge is divided, given by the corner opposite.
fn add_halves(
    parts: &mut arrayvec::ArrayVec<Part, 8>,
    corners: [u32; 3],
    parents: [u32; 2],
    divided: Option<(usize, u32)>,
) {
    let Some((apex, middle)) = divided else {
        parts.push(Part { corners, parent: parents[0], state: REGULAR });
        return;
    };
    let [next, last] = [(apex + 1) % 3, (apex + 2) % 3];
    for ((kept, replaced), parent) in [(next, last), (last, next)].into_iter().zip(parents) {
        let mut half = corners;
        half[replaced] = middle;
        parts.push(Part { corners: half, parent, state: half_state(replaced, kept) });
    }
}

/// A half, and what it is half of.
#[derive(Clone, Copy)]
struct Half {
    /// The corners that are the middle and the end of the divided edge.
    corners: [usize; 2],
    /// The other half.
    partner: u32,
    /// The end of the divided edge that the other half has.
    far: u32,
}

impl Half {
    /// The triangle of the two halves. `corners`, `cell`: those of this half.
    fn joined(&self, corners: [u32; 3], cell: u32) -> ([u32; 3], Green) {
        let [middle, end] = self.corners;
        let mut whole = corners;
        whole[middle] = self.far;
        let apex = 3 - middle - end;
        let halves =
            if end == (apex + 1) % 3 { [cell, self.partner] } else { [self.partner, cell] };
        (whole, Green { middle: corners[middle], apex, halves })
    }
}

/// The halves that have their other half beside them, and the middle still where it was.
fn partners(mesh: &TriangleMesh, state: &[u16]) -> Result<HashMap<u32, Half>, RefineError> {
    // the middle, the apex, the cell, and which corners the middle and the end are
    let mut halves: Vec<([u32; 2], u32, [usize; 2])> = Vec::new();
    for (cell, &state) in state.iter().enumerate() {
        if let Some([middle, end]) = half_corners(state)? {
            let corners = mesh.triangles()[cell];
            halves.push(([corners[middle], corners[3 - middle - end]], cell as u32, [middle, end]));
        }
    }
    halves.sort_unstable();
    let mut partners = HashMap::with_capacity(halves.len());
    for pair in halves.chunk_by(|one, other| one.0 == other.0) {
        let &[(common, one, ours), (_, other, theirs)] = pair else { continue };
        let end = |cell: u32, [_, end]: [usize; 2]| mesh.triangles()[cell as usize][end];
        let ends = [end(one, ours), end(other, theirs)];
        let [middle, from, to] =
            [common[0], ends[0], ends[1]].map(|point| mesh.points()[point as usize]);
        if ends[0] != ends[1] && middle == (from + to) * 0.5 {
            partners.insert(one, Half { corners: ours, partner: other, far: ends[1] });
            partners.insert(other, Half { corners: theirs, partner: one, far: ends[0] });
        }
    }
    Ok(partners)
}

/// So often one triangle fewer is divided in four to meet a bound on points exactly. It takes
/// one or two; on meshes of a few triangles some numbers of points cannot be met at all.
const TRIES: usize = 8;

/// The edges that are divided. Where there is no room for all `cells`, as many as there is
/// room for, and single edges of the others, each `longest` first. `none`: nothing marked yet.
fn marked_edges(none: &Marking, cells: &[u32], longest: impl Fn() -> Vec<u8>) -> Vec<bool> {
    let mut best = none.clone();
    let whole = best.run(cells);
    if whole == cells.len() || best.room == 0 {
        return best.marked;
    }
    let longest = longest();
    best.fill(cells, &longest);
    for fewer in (whole.saturating_sub(TRIES)..whole).rev() {
        if best.room == 0 {
            break;
        }
        let mut other = none.clone();
        other.run(&cells[..fewer]);
        other.fill(&cells[fewer..], &longest);
        if other.room < best.room {
            best = other;
        }
    }
    best.marked
}

/// Marks of edges in the making.
#[derive(Clone)]
struct Marking<'a> {
    joined: &'a Joined,
    edges: &'a NumberedEdges,
    marked: Vec<bool>,
    /// The green triangles of the halves of divided edges.
    above: HashMap<u32, u32>,
    /// Marked since the last mark that was asked for began.
    trail: Vec<u32>,
    room: usize,
}

impl<'a> Marking<'a> {
    fn new(joined: &'a Joined, edges: &'a NumberedEdges, room: usize) -> Self {
        let points = joined.greens.iter().flat_map(|(&triangle, green)| {
            let corners = joined.corners[triangle as usize];
            [1, 2].map(|step| (triangle, green.middle, corners[(green.apex + step) % 3]))
        });
        let above =
            points.filter_map(|(triangle, a, b)| Some((edges.find(a, b)?, triangle))).collect();
        let marked = vec![false; edges.count()];
        Self { joined, edges, marked, above, trail: Vec::new(), room }
    }

    /// Marks the edges of triangles, as far as there is room; returns of how many there was.
    fn run(&mut self, cells: &[u32]) -> usize {
        let is_marked = |cell: &&u32| {
            self.mark_triangle(self.joined.of_cells[**cell as usize]);
            self.keep()
        };
        cells.iter().take_while(is_marked).count()
    }

    /// Marks single edges of triangles, the longest first, for the last few points. `longest`:
    /// the corner opposite it.
    fn fill(&mut self, cells: &[u32], longest: &[u8]) {
        for &cell in cells {
            let triangle = self.joined.of_cells[cell as usize];
            let first = usize::from(longest[triangle as usize]);
            for step in 0..3 {
                if self.room == 0 {
                    return;
                }
                self.mark_edge(triangle, (first + step) % 3);
                self.keep();
            }
        }
    }

    /// Marks what the last marks ask for; without the room for all of it, takes them back.
    fn keep(&mut self) -> bool {
        checkpoint();
        self.spread();
        let is_room = self.trail.len() <= self.room;
        if is_room {
            self.room -= self.trail.len();
        } else {
            self.trail.iter().for_each(|&edge| self.marked[edge as usize] = false);
        }
        self.trail.clear();
        is_room
    }

    fn mark_triangle(&mut self, triangle: u32) {
        (0..3).for_each(|corner| self.mark_edge(triangle, corner));
    }

    /// Marks the edge opposite a corner, unless it has its middle.
    fn mark_edge(&mut self, triangle: u32, corner: usize) {
        let edge = self.edges.of_triangles()[triangle as usize][corner];
        let has_middle = self.joined.greens.get(&triangle).is_some_and(|g| g.apex == corner);
        if !has_middle && !self.marked[edge as usize] {
            self.marked[edge as usize] = true;
            self.trail.push(edge);
        }
    }

    /// Marks the triangles that marked edges ask for.
    fn spread(&mut self) {
        let mut done = 0;
        while let Some(&edge) = self.trail.get(done) {
            done += 1;
            if let Some(&triangle) = self.above.get(&edge) {
                self.mark_triangle(triangle);
            }
            for &triangle in self.edges.triangles(edge) {
                let sides = self.edges.of_triangles()[triangle as usize];
                let divided = sides.iter().filter(|&&side| self.marked[side as usize]).count();
                if divided > 1 || self.joined.greens.contains_key(&triangle) {
                    self.mark_triangle(triangle);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Vector;

    #[test]
    fn a_half_is_joined_before_it_is_divided() {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let points = points.map(|[x, y]| Vector::new(x, y, 0.0)).to_vec();
        let mesh = TriangleMesh::new(points, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
        let first = red_green(&mesh, &Marks::all(&[0])).unwrap();
        assert_eq!((first.points.len(), first.cells.len()), (7, 6));
        assert_eq!(first.parents, [0, 0, 0, 0, 1, 1]);
        assert_eq!(first.state.iter().filter(|state| **state == REGULAR).count(), 4);
        // the halves are one again, and that is divided in four
        let mesh = TriangleMesh::new(first.points, first.cells).unwrap();
        let marks = Marks { state: &first.state, ..Marks::all(&[4]) };
        let second = red_green(&mesh, &marks).unwrap();
        assert_eq!((second.points.len(), second.cells.len()), (9, 8));
        assert!(second.state.iter().all(|state| *state == REGULAR));
        // without the state they are not
        let anew = red_green(&mesh, &Marks::all(&[4])).unwrap();
        assert!(anew.state.iter().any(|state| *state != REGULAR));
    }
}
