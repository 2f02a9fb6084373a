//! Bisection of tetrahedra.
//!
//! D. N. Arnold, A. Mukherjee, L. Pouly, Locally adapted tetrahedral meshes using bisection
//! (2000): the marked tetrahedra are bisected, and then all that have a divided edge, until none
//! has. Any mesh can be the first: its marks are the longest edges of faces. How often the
//! tetrahedra are bisected again in one step is bounded; so new points may lie on edges that
//! are new themselves.

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::marked_tetrahedron::{MarkedTetrahedron, TetrahedronMarks};
use super::{Marks, NewPoint, RefineError, Refinement};
use crate::interruption::checkpoint;
use crate::mesh::{Faces, TetrahedronMesh, piece_edges};

/// Bisects the marked tetrahedra, and as many others as it takes for all to fit together.
///
/// The state is the marks of all tetrahedra. With it all that come of one tetrahedron, in
/// however many steps, have at most 72 shapes. Without it the step begins anew with longest
/// edges: each such beginning may make shapes worse once more.
///
/// A bound on points is never exceeded, and may not be met: it takes as many of the marked
/// tetrahedra as it allows, those first that come first.
///
/// # Errors
/// If a mark is no tetrahedron of the mesh, the state does not fit it, a tetrahedron has points
/// that are not finite or one of them twice, or there are too many points to be numbered.
pub fn refine_tetrahedra(
    mesh: &TetrahedronMesh,
    marks: &Marks,
) -> Result<Refinement<4>, RefineError> {
    marks.check(mesh)?;
    let tetrahedra = marked_tetrahedra(mesh, marks.state)?;
    let mut cells = Vec::with_capacity(marks.cells.len());
    let mut is_named = vec![false; tetrahedra.len()];
    for &cell in marks.cells {
        if !std::mem::replace(&mut is_named[cell as usize], true) {
            cells.push(cell);
        }
    }
    let room = marks.room(mesh.points().len());
    let refined = |count: usize| Bisection::new(mesh, &tetrahedra).run(&cells[..count], room);
    let (count, bisection) = most_that_fit(cells.len(), room, refined);
    if count < cells.len() && marks.max_points > u32::MAX as usize {
        return Err(RefineError::TooLarge);
    }
    Ok(bisection.into_refinement())
}

/// The marks of a state, or the first ones: the longest edge of each face; of equally long ones
/// that between the greater points.
fn marked_tetrahedra(
    mesh: &TetrahedronMesh,
    state: &[u16],
) -> Result<Vec<MarkedTetrahedron>, RefineError> {
    if !state.is_empty() {
        return marked_by_state(mesh, state);
    }
    let first = |&corners: &[u32; 4]| {
        let rank = |i: usize, j: usize| {
            let ends = [corners[i].min(corners[j]), corners[i].max(corners[j])];
            let [from, to] = ends.map(|end| mesh.points()[end as usize]);
            // numbers that are not negative have the order of their bits
            ((to - from).norm_squared().to_bits(), ends)
        };
        MarkedTetrahedron { corners, marks: TetrahedronMarks::first(rank) }
    };
    Ok(mesh.tetrahedra().par_iter().map(first).collect())
}

/// The marks of a state. Tetrahedra must agree on their common faces, else divisions would
/// never fit together.
fn marked_by_state(
    mesh: &TetrahedronMesh,
    state: &[u16],
) -> Result<Vec<MarkedTetrahedron>, RefineError> {
    let tetrahedra: Option<Vec<MarkedTetrahedron>> = mesh
        .tetrahedra()
        .par_iter()
        .zip(state)
        .map(|(&corners, &code)| {
            Some(MarkedTetrahedron { corners, marks: TetrahedronMarks::of_code(code)? })
        })
        .collect();
    let tetrahedra = tetrahedra.ok_or(RefineError::State)?;
    let faces = Faces::new(mesh);
    let marked_edge = |side: &crate::mesh::Side| {
        let MarkedTetrahedron { corners, marks } = &tetrahedra[side.tetrahedron()];
        let [a, b] = marks.marked_edge(side.opposite()).map(|corner| corners[corner]);
        [a.min(b), a.max(b)]
    };
    let agree = (0..faces.count()).into_par_iter().all(|face| {
        let mut edges = faces.sides(face).iter().map(marked_edge);
        let first = edges.next();
        edges.all(|edge| Some(edge) == first)
    });
    if agree { Ok(tetrahedra) } else { Err(RefineError::State) }
}

/// The largest number of marks for which there is room, and what they come to. More marks never
/// need fewer points, so the number lies between one that fits and one that does not; where it
/// is likely is guessed from the points that these need.
fn most_that_fit<'a>(
    marks: usize,
    room: usize,
    refined: impl Fn(usize) -> Option<Bisection<'a>>,
) -> (usize, Bisection<'a>) {
    let whole = refined(marks);
    let (mut fits, mut too_many) = (0, marks);
    if let Some(bisection) = whole {
        return (marks, bisection);
    }
    let mut best = refined(0);
    // a mark needs a point at least; later guesses follow what the marks so far needed
    let mut guess = room.min(marks / 2);
    while too_many - fits > 1 {
        checkpoint();
        let count = guess.clamp(fits + 1, too_many - 1);
        match refined(count) {
            Some(bisection) => {
                let each = bisection.added() as f64 / count as f64;
                (fits, guess) = (count, (room as f64 / each) as usize);
                best = Some(bisection);
            }
            None => (too_many, guess) = (count, fits + (count - fits) / 2),
        }
        if fits * 1024 > 1023 * too_many {
            break;
        }
        if guess <= fits || guess >= too_many {
            guess = fits + (too_many - fits) / 2;
        }
    }
    (fits, best.unwrap_or_else(|| unreachable!("no marks need no points")))
}

/// A bisection in the making.
#[derive(Clone)]
struct Bisection<'a> {
    mesh: &'a TetrahedronMesh<'a>,
    tetrahedra: Vec<MarkedTetrahedron>,
    parents: Vec<u32>,
    /// The middles of divided edges.
    middles: FxHashMap<[u32; 2], u32>,
    /// The divided edges, in the order of their middles.
    edges: Vec<[u32; 2]>,
    /// The last round in which an edge at each point was divided.
    rounds: Vec<u32>,
}

impl<'a> Bisection<'a> {
    fn new(mesh: &'a TetrahedronMesh<'a>, tetrahedra: &[MarkedTetrahedron]) -> Self {
        Self {
            mesh,
            tetrahedra: tetrahedra.to_vec(),
            parents: (0..tetrahedra.len() as u32).collect(),
            middles: FxHashMap::default(),
            edges: Vec::new(),
            rounds: vec![0; mesh.points().len()],
        }
    }

    /// How many points were added.
    fn added(&self) -> usize {
        self.edges.len()
    }

    /// Bisects tetrahedra, and then all that have divided edges; nothing if that takes more
    /// points than there is room for.
    fn run(mut self, cells: &[u32], room: usize) -> Option<Self> {
        let mut asked = cells.to_vec();
        for round in 1.. {
            checkpoint();
            if asked.is_empty() {
                break;
            }
            let old = self.tetrahedra.len();
            for &tetrahedron in &asked {
                self.bisect(tetrahedron as usize, round);
            }
            if self.added() > room || self.tetrahedra.len() > u32::MAX as usize {
                return None;
            }
            asked = self.open(&asked, old, round);
        }
        Some(self)
    }

    /// The halves take the place of the whole, and the last.
    fn bisect(&mut self, tetrahedron: usize, round: u32) {
        let edge = self.tetrahedra[tetrahedron].refinement_edge();
        let next = (self.mesh.points().len() + self.edges.len()) as u32;
        let middle = *self.middles.entry(edge).or_insert(next);
        if middle == next {
            self.edges.push(edge);
            self.rounds.push(0);
            edge.iter().for_each(|&end| self.rounds[end as usize] = round);
        }
        let [one, other] = self.tetrahedra[tetrahedron].bisect(middle);
        self.tetrahedra[tetrahedron] = one;
        self.tetrahedra.push(other);
        self.parents.push(self.parents[tetrahedron]);
    }

    /// The tetrahedra that have divided edges: of those bisected in this round, whenever that
    /// was; of the others, in this round.
    fn open(&self, bisected: &[u32], old: usize, round: u32) -> Vec<u32> {
        let mut is_new = vec![false; self.tetrahedra.len()];
        bisected.iter().for_each(|&tetrahedron| is_new[tetrahedron as usize] = true);
        is_new[old..].fill(true);
        let is_open = |(tetrahedron, is_new): (&MarkedTetrahedron, &bool)| {
            let at = |point: &&u32| self.rounds[**point as usize] == round;
            // both ends of an edge that was divided were noted
            let may_be = *is_new || tetrahedron.corners.iter().filter(at).count() > 1;
            may_be && self.has_divided_edge(tetrahedron)
        };
        let all = self.tetrahedra.par_iter().zip(&is_new).enumerate();
        all.filter(|(_, each)| is_open(*each)).map(|(tetrahedron, _)| tetrahedron as u32).collect()
    }

    fn has_divided_edge(&self, tetrahedron: &MarkedTetrahedron) -> bool {
        piece_edges::<4>().any(|edge| {
            let [a, b] = edge.map(|corner| tetrahedron.corners[corner]);
            self.middles.contains_key(&[a.min(b), a.max(b)])
        })
    }

    /// The parts of each tetrahedron together, in the order of these.
    fn into_refinement(self) -> Refinement<4> {
        let mut order: Vec<u32> = (0..self.tetrahedra.len() as u32).collect();
        order.par_sort_by_key(|&part| self.parents[part as usize]);
        let parts = || order.par_iter().map(|&part| part as usize);
        let mut refined = Refinement {
            points: self.mesh.points().to_vec(),
            cells: parts().map(|part| self.tetrahedra[part].corners).collect(),
            parents: parts().map(|part| self.parents[part]).collect(),
            new_points: Vec::new(),
            moved: Vec::new(),
            state: parts().map(|part| self.tetrahedra[part].marks.code()).collect(),
        };
        refined.new_points = self.places(&refined);
        for edge in &self.edges {
            let [a, b] = edge.map(|end| refined.points[end as usize]);
            refined.points.push((a + b) * 0.5);
        }
        refined
    }

    /// Where the new points lie.
    fn places(&self, refined: &Refinement<4>) -> Vec<NewPoint<4>> {
        let first = self.mesh.points().len();
        let mut holders = vec![0; self.edges.len()];
        for (corners, &parent) in refined.cells.iter().zip(&refined.parents) {
            for point in corners.iter().filter_map(|&point| (point as usize).checked_sub(first)) {
                holders[point] = parent;
            }
        }
        let places = self.stencils().into_iter().zip(holders).map(|(stencil, cell)| {
            if let [(from, _), (to, at)] = stencil[..] {
                return NewPoint::Edge { ends: [from, to], at };
            }
            let weight = |corner| stencil.iter().find(|(point, _)| *point == corner);
            let at = self.mesh.tetrahedra()[cell as usize];
            NewPoint::Inside { cell, at: at.map(|corner| weight(corner).map_or(0.0, |w| w.1)) }
        });
        places.collect()
    }

    /// The new points as means of points of the input. All that a middle is a mean of are
    /// corners of one tetrahedron.
    fn stencils(&self) -> Vec<Stencil> {
        let first = self.mesh.points().len();
        let mut stencils: Vec<Stencil> = Vec::with_capacity(self.edges.len());
        for edge in &self.edges {
            let mut middle = Stencil::new();
            for &end in edge {
                let old = || [(end, 1.0)].into_iter().collect();
                let new = (end as usize).checked_sub(first);
                let parts = new.map_or_else(old, |place| stencils[place].clone());
                for (point, weight) in parts {
                    match middle.iter_mut().find(|(other, _)| *other == point) {
                        Some((_, sum)) => *sum += 0.5 * weight,
                        None => middle.push((point, 0.5 * weight)),
                    }
                }
            }
            middle.sort_unstable_by_key(|&(point, _)| point);
            stencils.push(middle);
        }
        stencils
    }
}

/// Points of the input, ascending, and their weights.
type Stencil = arrayvec::ArrayVec<(u32, f64), 4>;
