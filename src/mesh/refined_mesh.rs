//! Simplices divided into smaller ones that fit together.

use std::collections::HashMap;

use rayon::prelude::*;

use super::{SimplexMesh, Vector};

/// A mesh divided into smaller simplices, without hanging points: neighbours agree on
/// their common sides without knowing of each other.
#[derive(Clone, Debug)]
pub struct RefinedMesh<const CORNERS: usize> {
    /// Where each point is in the mesh that was divided, in one of the simplices that
    /// hold it.
    pub places: Vec<RefinedPlace<CORNERS>>,
    /// The same in space.
    pub points: Vec<Vector>,
    /// The simplices, those of one that was divided together.
    pub pieces: Vec<RefinedPiece<CORNERS>>,
}

/// A place in the mesh that was divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RefinedPlace<const CORNERS: usize> {
    /// The simplex.
    pub simplex: u32,
    /// Barycentric coordinates there.
    pub at: [f64; CORNERS],
}

/// A part of a simplex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RefinedPiece<const CORNERS: usize> {
    /// Its corners, as points of the refined mesh.
    pub corners: [u32; CORNERS],
    /// The same in the simplex that was divided.
    pub at: [[f64; CORNERS]; CORNERS],
    /// The simplex that was divided.
    pub parent: u32,
}

/// An edge of a piece, as two of its corners.
pub type PieceEdge = [usize; 2];

impl<const CORNERS: usize> RefinedMesh<CORNERS> {
    /// Each edge in so many equal parts, one at least: a triangle in the square of that
    /// number, a tetrahedron in its cube. Points that no simplex uses go.
    ///
    /// In coordinates `N ≥ x₁ ≥ x₂ ≥ x₃ ≥ 0`, of corners in the order of their numbers,
    /// the simplex is a union of simplices of Freudenthal's division of cubes (1942), and
    /// so is each of its sides: neighbours agree.
    pub fn uniform(mesh: &SimplexMesh<CORNERS>, parts: u32) -> Self {
        let lattice = lattice::<CORNERS>(parts);
        let mut refined = Self { places: Vec::new(), points: Vec::new(), pieces: Vec::new() };
        let mut numbers = HashMap::new();
        for (simplex, points) in mesh.simplices().iter().enumerate() {
            let mut order: [usize; CORNERS] = std::array::from_fn(|corner| corner);
            order.sort_unstable_by_key(|&corner| points[corner]);
            for cell in &lattice {
                let mut piece = RefinedPiece {
                    corners: [0; CORNERS],
                    at: [[0.0; CORNERS]; CORNERS],
                    parent: simplex as u32,
                };
                for (corner, weights) in cell.iter().enumerate() {
                    // a point is its weights and the points that they belong to
                    let name = std::array::from_fn::<_, CORNERS, _>(|n| match weights[n] {
                        0 => (u32::MAX, 0),
                        weight => (points[order[n]], weight),
                    });
                    for (n, weight) in weights.iter().enumerate() {
                        piece.at[corner][order[n]] = f64::from(*weight) / f64::from(parts);
                    }
                    let at = piece.at[corner];
                    piece.corners[corner] = *numbers
                        .entry(sorted(name))
                        .or_insert_with(|| refined.add_point(mesh, piece.parent, at));
                }
                refined.pieces.push(piece.turned_like_parent());
            }
        }
        refined
    }

    /// Divides edges that `marked` names, in all pieces around each, and asks again of
    /// what has become smaller, until nothing is named any more or there are `most`
    /// pieces. Returns whether nothing is named.
    ///
    /// A piece with several marked edges is divided along the longest first, and so are
    /// its sides, so neighbours agree.
    pub fn divide(
        &mut self,
        mesh: &SimplexMesh<CORNERS>,
        most: usize,
        marked: impl Fn(&RefinedPiece<CORNERS>, &[Vector]) -> Vec<PieceEdge> + Sync,
    ) -> bool {
        let mut fresh = vec![true; self.pieces.len()];
        loop {
            let asked = self.pieces.par_iter().zip(&fresh).filter(|(_, fresh)| **fresh);
            let named = asked.flat_map_iter(|(piece, _)| {
                marked(piece, &self.points).into_iter().map(move |edge| piece.edge(edge))
            });
            let mut edges: Vec<[u32; 2]> = named.collect();
            edges.par_sort_unstable();
            edges.dedup();
            if edges.is_empty() || self.pieces.len() + edges.len() > most {
                return edges.is_empty();
            }
            let middles = self.add_middles(mesh, &edges);
            let divided: Vec<Vec<RefinedPiece<CORNERS>>> =
                self.pieces.par_iter().map(|piece| piece.divided(&middles, &self.points)).collect();
            fresh =
                divided.iter().flat_map(|pieces| vec![pieces.len() > 1; pieces.len()]).collect();
            self.pieces = divided.into_iter().flatten().collect();
        }
    }

    /// Adds the middles of edges, in the order of the edges; returns their numbers.
    fn add_middles(
        &mut self,
        mesh: &SimplexMesh<CORNERS>,
        edges: &[[u32; 2]],
    ) -> HashMap<[u32; 2], u32> {
        let mut holders: HashMap<[u32; 2], (u32, [f64; CORNERS])> = HashMap::new();
        for piece in &self.pieces {
            for [i, j] in piece_edges::<CORNERS>() {
                let edge = piece.edge([i, j]);
                if edges.binary_search(&edge).is_ok() {
                    holders.entry(edge).or_insert_with(|| (piece.parent, piece.middle([i, j])));
                }
            }
        }
        let holders = edges.iter().filter_map(|edge| Some((*edge, *holders.get(edge)?)));
        holders.map(|(edge, (simplex, at))| (edge, self.add_point(mesh, simplex, at))).collect()
    }

    fn add_point(&mut self, mesh: &SimplexMesh<CORNERS>, simplex: u32, at: [f64; CORNERS]) -> u32 {
        self.places.push(RefinedPlace { simplex, at });
        self.points.push(mesh.position(simplex as usize, &at));
        self.points.len() as u32 - 1
    }
}

impl<const CORNERS: usize> RefinedPiece<CORNERS> {
    /// An edge by its points, ascending.
    fn edge(&self, [i, j]: PieceEdge) -> [u32; 2] {
        let [a, b] = [self.corners[i], self.corners[j]];
        [a.min(b), a.max(b)]
    }

    fn middle(&self, [i, j]: PieceEdge) -> [f64; CORNERS] {
        std::array::from_fn(|n| 0.5 * (self.at[i][n] + self.at[j][n]))
    }

    /// This piece divided along its marked edges, the longest first.
    fn divided(self, middles: &HashMap<[u32; 2], u32>, points: &[Vector]) -> Vec<Self> {
        let length = |edge: PieceEdge| {
            let [a, b] = self.edge(edge);
            ((points[b as usize] - points[a as usize]).norm(), [a, b])
        };
        let marked =
            piece_edges::<CORNERS>().filter(|edge| middles.contains_key(&self.edge(*edge)));
        let longest = marked.max_by(|one, other| {
            let (one, other) = (length(*one), length(*other));
            one.0.total_cmp(&other.0).then(one.1.cmp(&other.1))
        });
        let Some([i, j]) = longest else { return vec![self] };
        let (middle, at) = (middles[&self.edge([i, j])], self.middle([i, j]));
        let with = |corner: usize| {
            let mut half = self;
            (half.corners[corner], half.at[corner]) = (middle, at);
            half.divided(middles, points)
        };
        let mut parts = with(j);
        parts.extend(with(i));
        parts
    }

    /// This piece with its corners in such an order that it is turned as its parent is.
    fn turned_like_parent(mut self) -> Self {
        if determinant(&self.at) < 0.0 {
            self.corners.swap(CORNERS - 2, CORNERS - 1);
            self.at.swap(CORNERS - 2, CORNERS - 1);
        }
        self
    }
}

/// All edges of a piece.
pub fn piece_edges<const CORNERS: usize>() -> impl Iterator<Item = PieceEdge> {
    (0..CORNERS).flat_map(|i| (i + 1..CORNERS).map(move |j| [i, j]))
}

/// The simplices of a simplex whose edges are divided in so many parts: the corners of
/// each, by their weights, which sum to that number.
fn lattice<const CORNERS: usize>(parts: u32) -> Vec<[[u32; CORNERS]; CORNERS]> {
    let dimension = CORNERS - 1;
    let cubes = (0..parts.pow(dimension as u32)).map(|number| {
        let digit = |axis: usize| number / parts.pow(axis as u32) % parts;
        (0..dimension).map(digit).collect::<Vec<u32>>()
    });
    let orders = permutations(dimension);
    cubes
        .flat_map(|cube| {
            orders
                .iter()
                .filter_map(move |order| {
                    let mut place = cube.clone();
                    let mut cell = [[0; CORNERS]; CORNERS];
                    cell[0] = weights(parts, &place)?;
                    for (step, &axis) in order.iter().enumerate() {
                        place[axis] += 1;
                        cell[step + 1] = weights(parts, &place)?;
                    }
                    Some(cell)
                })
                .collect::<Vec<_>>()
        })
        .collect()
}

/// The weights of the corners at `N ≥ x₁ ≥ x₂ ≥ x₃ ≥ 0`, the differences of these; none
/// outside.
fn weights<const CORNERS: usize>(parts: u32, place: &[u32]) -> Option<[u32; CORNERS]> {
    let mut weights = [0; CORNERS];
    let mut before = parts;
    for (weight, &here) in weights.iter_mut().zip(place) {
        *weight = before.checked_sub(here)?;
        before = here;
    }
    weights[CORNERS - 1] = before;
    Some(weights)
}

fn permutations(count: usize) -> Vec<Vec<usize>> {
    if count == 0 {
        return vec![Vec::new()];
    }
    let shorter = permutations(count - 1);
    let with = |order: &Vec<usize>, place: usize| {
        let mut longer = order.clone();
        longer.insert(place, count - 1);
        longer
    };
    shorter.iter().flat_map(|order| (0..count).map(|place| with(order, place))).collect()
}

fn sorted<T: Ord, const N: usize>(mut items: [T; N]) -> [T; N] {
    items.sort_unstable();
    items
}

/// By elimination; its sign tells how a piece is turned.
fn determinant<const CORNERS: usize>(rows: &[[f64; CORNERS]; CORNERS]) -> f64 {
    let mut rows = *rows;
    let mut product = 1.0;
    for column in 0..CORNERS {
        let largest = (column..CORNERS)
            .max_by(|a, b| rows[*a][column].abs().total_cmp(&rows[*b][column].abs()))
            .unwrap_or(column);
        if largest != column {
            rows.swap(largest, column);
            product = -product;
        }
        let pivot = rows[column];
        product *= pivot[column];
        for row in rows.iter_mut().skip(column + 1) {
            let factor = row[column] / pivot[column];
            row.iter_mut().zip(pivot).for_each(|(entry, above)| *entry -= factor * above);
        }
    }
    product
}

#[cfg(test)]
mod tests {
    use super::super::TriangleMesh;
    use super::*;

    #[test]
    fn a_triangle_in_four_by_hand() {
        let points = vec![Vector::zeros(), Vector::x() * 2.0, Vector::y() * 2.0];
        let mesh = TriangleMesh::new(points, vec![[0, 1, 2]]).unwrap();
        let refined = RefinedMesh::uniform(&mesh, 2);
        assert_eq!((refined.points.len(), refined.pieces.len()), (6, 4));
        assert!(refined.points.contains(&Vector::new(1.0, 1.0, 0.0)));
        for piece in &refined.pieces {
            let [a, b, c] = piece.corners.map(|corner| refined.points[corner as usize]);
            assert_eq!((b - a).cross(&(c - a)), Vector::z());
        }
    }

    #[test]
    fn one_part_is_the_mesh() {
        let points = vec![Vector::zeros(), Vector::x(), Vector::y(), Vector::z()];
        let mesh = SimplexMesh::new(points, vec![[2, 3, 0, 1]]).unwrap();
        let refined = RefinedMesh::uniform(&mesh, 1);
        assert_eq!((refined.points.len(), refined.pieces.len()), (4, 1));
        assert!(determinant(&refined.pieces[0].at) > 0.0);
    }

    #[test]
    fn an_edge_is_divided_in_both_triangles() {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let points = points.map(|[x, y]| Vector::new(x, y, 0.0)).to_vec();
        let mesh = TriangleMesh::new(points, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
        let mut refined = RefinedMesh::uniform(&mesh, 1);
        let marked = |piece: &RefinedPiece<3>, _: &[Vector]| {
            let whole = piece.parent == 0 && piece.at.concat().iter().all(|x| x.fract() == 0.0);
            let diagonal = piece_edges::<3>().filter(|edge| {
                let [a, b] = edge.map(|corner| piece.at[corner]);
                a[1] == 0.0 && b[1] == 0.0
            });
            if whole { diagonal.collect() } else { Vec::new() }
        };
        assert!(refined.divide(&mesh, 100, marked));
        assert_eq!((refined.points.len(), refined.pieces.len()), (5, 4));
        assert_eq!(refined.points[4], Vector::new(0.5, 0.5, 0.0));
    }
}
