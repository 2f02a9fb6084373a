//! Triangles that know what is beside them, and how they are split and turned.
//!
//! All orientations and circles are decided without rounding (Shewchuk 1997).

use spade::Point2;

use super::features::Side;

/// What is beyond an edge of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Border {
    /// The triangle there, or [`NONE`].
    pub beyond: u32,
    /// Whether the edge is kept.
    pub is_kept: bool,
}

/// No triangle: beyond the edges of the outermost triangles.
pub const NONE: u32 = u32::MAX;

/// A triangle of a triangulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linked {
    /// Its points, counter-clockwise.
    pub points: [u32; 3],
    /// Its edges, in the order of the points opposite.
    pub borders: [Border; 3],
    /// The region that it is part of; nothing outside the domain.
    pub side: Side,
}

/// Triangles that cover a convex polygon.
pub struct LinkedTriangles {
    pub positions: Vec<Point2<f64>>,
    triangles: Vec<Linked>,
    /// A triangle at each point.
    beside: Vec<u32>,
}

/// Both sides of an edge of one or two triangles, each as triangle and corner opposite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// The points of the edge, the lower first.
    pub ends: [u32; 2],
    /// The triangle to the left of the edge from its lower to its higher point, and that to the right.
    pub sides: [Option<(u32, usize)>; 2],
}

/// Three triangles or more at an edge, or two on the same side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NotLinked {
    pub ends: [u32; 2],
    pub count: usize,
}

/// An edge of a triangle, beyond which none is known yet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct OpenEdge {
    high: u32,
    is_right: bool,
    /// Four times the triangle, and the corner opposite.
    place: u32,
}

impl Linked {
    /// A triangle without neighbours.
    pub fn new(points: [u32; 3], side: Side) -> Self {
        Self { points, borders: [Border { beyond: NONE, is_kept: false }; 3], side }
    }

    /// The ends of the edge opposite a corner, as they follow each other.
    pub fn edge(&self, corner: usize) -> [u32; 2] {
        [self.points[(corner + 1) % 3], self.points[(corner + 2) % 3]]
    }
}

impl LinkedTriangles {
    /// Nothing but points.
    pub fn new(positions: Vec<Point2<f64>>) -> Self {
        Self { beside: vec![NONE; positions.len()], positions, triangles: Vec::new() }
    }

    pub fn triangles(&self) -> &[Linked] {
        &self.triangles
    }

    pub fn triangle(&self, number: u32) -> &Linked {
        &self.triangles[number as usize]
    }

    /// Where the points of a triangle are.
    pub fn corners(&self, number: u32) -> [Point2<f64>; 3] {
        self.triangle(number).points.map(|point| self.position(point))
    }

    pub fn position(&self, point: u32) -> Point2<f64> {
        self.positions[point as usize]
    }

    /// Adds triangles, and links all that have no neighbours yet where they share edges.
    /// Returns the edges looked at.
    ///
    /// # Errors
    /// If more than two triangles are at an edge, or two on the same side of it.
    pub fn add(&mut self, more: impl Iterator<Item = Linked>) -> Result<Vec<Pair>, NotLinked> {
        let old = self.triangles.len();
        self.triangles.extend(more);
        self.beside.resize(self.positions.len(), NONE);
        for (triangle, number) in self.triangles[old..].iter().zip(old as u32..) {
            triangle.points.iter().for_each(|&point| self.beside[point as usize] = number);
        }
        let (open, starts) = self.open_edges();
        let mut pairs = Vec::with_capacity(open.len() / 2 + 1);
        for low in 0..self.positions.len() {
            let at_point = &open[starts[low] as usize..starts[low + 1] as usize];
            for group in at_point.chunk_by(|one, next| one.high == next.high) {
                let mut pair = Pair { ends: [low as u32, group[0].high], sides: [None; 2] };
                for &OpenEdge { is_right, place, .. } in group {
                    let side = &mut pair.sides[usize::from(is_right)];
                    if side.replace((place / 4, place as usize % 4)).is_some() {
                        return Err(NotLinked { ends: pair.ends, count: group.len() });
                    }
                }
                if let [Some(one), Some(other)] = pair.sides {
                    self.border_mut(one).beyond = other.0;
                    self.border_mut(other).beyond = one.0;
                }
                pairs.push(pair);
            }
        }
        Ok(pairs)
    }

    /// The edges without a neighbour, by their lower points, and where those of each begin.
    fn open_edges(&self) -> (Vec<OpenEdge>, Vec<u32>) {
        let all = || {
            self.triangles.iter().zip(0_u32..).flat_map(|(triangle, number)| {
                let corners = (0..3).filter(|&corner| triangle.borders[corner].beyond == NONE);
                corners.map(move |corner| {
                    let [from, to] = triangle.edge(corner);
                    // numbers of corners have 32 bits, too
                    let place = 4 * number + corner as u32;
                    (from.min(to), OpenEdge { high: from.max(to), is_right: from > to, place })
                })
            })
        };
        let mut starts = vec![0_u32; self.positions.len() + 2];
        all().for_each(|(low, _)| starts[low as usize + 2] += 1);
        for point in 2..starts.len() {
            starts[point] += starts[point - 1];
        }
        let nothing = OpenEdge { high: NONE, is_right: false, place: 0 };
        let mut open = vec![nothing; starts[starts.len() - 1] as usize];
        for (low, edge) in all() {
            let next = &mut starts[low as usize + 1];
            open[*next as usize] = edge;
            *next += 1;
        }
        let mut rest = &mut open[..];
        for bounds in starts.windows(2) {
            let (own, others) = rest.split_at_mut((bounds[1] - bounds[0]) as usize);
            own.sort_unstable();
            rest = others;
        }
        (open, starts)
    }

    fn border_mut(&mut self, (triangle, corner): (u32, usize)) -> &mut Border {
        &mut self.triangles[triangle as usize].borders[corner]
    }

    /// The same edge as its other triangle has it.
    pub fn twin(&self, (triangle, corner): (u32, usize)) -> Option<(u32, usize)> {
        let beyond = self.triangle(triangle).borders[corner].beyond;
        let other = self.triangles.get(beyond as usize)?;
        let [from, to] = self.triangle(triangle).edge(corner);
        let twin = (0..3).find(|&corner| other.edge(corner) == [to, from])?;
        Some((beyond, twin))
    }

    /// The edge from a point to another one, as the triangle to its left has it.
    pub fn find(&self, [from, to]: [u32; 2]) -> Option<(u32, usize)> {
        let first = *self.beside.get(from as usize)?;
        let mut triangle = first;
        loop {
            let points = self.triangles.get(triangle as usize)?.points;
            let place = points.iter().position(|&point| point == from)?;
            // the edge that follows the point, else on around it to the left
            let edge = (triangle, (place + 2) % 3);
            if self.triangle(triangle).edge(edge.1) == [from, to] {
                return Some(edge);
            }
            triangle = self.triangle(triangle).borders[(place + 1) % 3].beyond;
            if triangle == first {
                return None;
            }
        }
    }

    /// Says of an edge whether it is kept.
    pub fn keep(&mut self, edge: (u32, usize), is_kept: bool) {
        self.border_mut(edge).is_kept = is_kept;
        if let Some(twin) = self.twin(edge) {
            self.border_mut(twin).is_kept = is_kept;
        }
    }

    pub fn set_side(&mut self, triangle: u32, side: Side) {
        self.triangles[triangle as usize].side = side;
    }

    /// Positive if a place is to the left of the edge opposite a corner, zero if it is on its
    /// line.
    pub fn side_of(&self, triangle: u32, corner: usize, place: Point2<f64>) -> f64 {
        let [a, b] = self.triangle(triangle).edge(corner).map(|point| self.position(point));
        orientation(a, b, place)
    }

    /// Whether a place is inside the circle around a triangle.
    pub fn is_in_circle(&self, triangle: u32, place: Point2<f64>) -> bool {
        let [a, b, c] = self.corners(triangle).map(coord);
        robust::incircle(a, b, c, coord(place)) > 0.0
    }

    /// Whether an edge has to be turned: the corner beyond is inside the circle. By more than
    /// rounding: else mirrored edges would not be turned alike.
    pub fn is_bad(&self, (triangle, corner): (u32, usize)) -> bool {
        let Linked { points, borders, .. } = self.triangle(triangle);
        if borders[corner].is_kept {
            return false;
        }
        let Some((beyond, opposite)) = self.twin((triangle, corner)) else { return false };
        let far = self.position(self.triangle(beyond).points[opposite]);
        let near = self.position(points[corner]);
        let [a, b] = self.triangle(triangle).edge(corner).map(|point| self.position(point));
        self.is_in_circle(triangle, far) && !is_on_circle(a, b, near, far)
    }

    /// Adds a point inside a triangle. Returns the edges opposite to it.
    pub fn split(&mut self, triangle: u32, point: u32) -> [(u32, usize); 3] {
        let Linked { points: [a, b, c], borders: [of_a, of_b, of_c], side } =
            *self.triangle(triangle);
        let one = self.triangles.len() as u32;
        let other = one + 1;
        let (first, second, third) = (to(triangle), to(one), to(other));
        self.put(triangle, [a, b, point], [second, third, of_c], side);
        self.put(one, [b, c, point], [third, first, of_a], side);
        self.put(other, [c, a, point], [first, second, of_b], side);
        [(triangle, 2), (one, 2), (other, 2)]
    }

    /// Adds a point on an edge between two triangles, which halves it. Returns the edges
    /// opposite to the point.
    pub fn split_edge(&mut self, edge: (u32, usize), point: u32) -> Option<[(u32, usize); 4]> {
        let twin = self.twin(edge)?;
        let ((left, _), (right, _)) = (edge, twin);
        let Linked { points: [p, a, b], borders: [half, of_a, of_b], side } = self.from(edge);
        let Linked { points: [q, _, _], borders: [_, of_b2, of_a2], side: beyond } =
            self.from(twin);
        let one = self.triangles.len() as u32;
        let other = one + 1;
        let halved = |triangle: u32| Border { beyond: triangle, ..half };
        self.put(left, [p, a, point], [halved(other), to(one), of_b], side);
        self.put(one, [p, point, b], [halved(right), of_a, to(left)], side);
        self.put(right, [q, b, point], [halved(one), to(other), of_a2], beyond);
        self.put(other, [q, point, a], [halved(left), of_b2, to(right)], beyond);
        Some([(left, 2), (one, 1), (right, 2), (other, 1)])
    }

    /// Turns the edge between two triangles, so that it joins the corners opposite. Returns the
    /// edges around: first those of the triangle, then those of the other one.
    fn flip(&mut self, edge: (u32, usize)) -> Option<[(u32, usize); 4]> {
        let twin = self.twin(edge)?;
        let ((left, _), (right, _)) = (edge, twin);
        let Linked { points: [p, a, b], borders: [_, of_a, of_b], side } = self.from(edge);
        let Linked { points: [q, _, _], borders: [_, of_b2, of_a2], .. } = self.from(twin);
        self.put(left, [p, a, q], [of_b2, to(right), of_b], side);
        self.put(right, [q, b, p], [of_a, to(left), of_a2], side);
        Some([(left, 0), (left, 2), (right, 0), (right, 2)])
    }

    /// Turns edges until no corner is inside the circle around the triangle beyond: of these
    /// edges, and of those around the ones that are turned.
    pub fn make_delaunay(&mut self, mut open: Vec<(u32, usize)>) {
        while let Some(edge) = open.pop() {
            if self.is_bad(edge) {
                open.extend(self.flip(edge).into_iter().flatten());
            }
        }
    }

    /// Other triangles in the place of some that make a polygon, as many as these.
    pub fn replace(&mut self, old: &[u32], new: &[[u32; 3]]) {
        let outer: Vec<([u32; 2], Border)> = old
            .iter()
            .flat_map(|&number| {
                let triangle = *self.triangle(number);
                [0, 1, 2].map(|corner| (triangle.edge(corner), triangle.borders[corner]))
            })
            .filter(|(_, border)| border.is_kept || !old.contains(&border.beyond))
            .collect();
        let side = self.triangle(old[0]).side;
        let has = |points: &[u32; 3], [from, to]: [u32; 2]| {
            (0..3).any(|corner| [points[corner], points[(corner + 1) % 3]] == [from, to])
        };
        for (&number, &points) in old.iter().zip(new) {
            let edges = [0, 1, 2].map(|corner| Linked::new(points, side).edge(corner));
            let borders = edges.map(|[from, to]| {
                let as_before = outer.iter().find(|(edge, _)| *edge == [from, to]);
                let inner = || old.iter().zip(new).find(|(_, points)| has(points, [to, from]));
                let inner = || inner().map_or(self::to(NONE), |(&number, _)| self::to(number));
                as_before.map_or_else(inner, |(_, border)| *border)
            });
            self.put(number, points, borders, side);
        }
    }

    /// A triangle, a corner first.
    fn from(&self, (triangle, corner): (u32, usize)) -> Linked {
        let Linked { mut points, mut borders, side } = *self.triangle(triangle);
        points.rotate_left(corner);
        borders.rotate_left(corner);
        Linked { points, borders, side }
    }

    /// Replaces a triangle, or adds it as the last, and tells its neighbours.
    fn put(&mut self, number: u32, points: [u32; 3], borders: [Border; 3], side: Side) {
        let place = number as usize;
        if place >= self.triangles.len() {
            self.triangles.resize(place + 1, Linked::new([NONE; 3], None));
        }
        self.triangles[place] = Linked { points, borders, side };
        self.beside.resize(self.positions.len(), NONE);
        points.iter().for_each(|&point| self.beside[point as usize] = number);
        for corner in 0..3 {
            if let Some(twin) = self.twin((number, corner)) {
                self.border_mut(twin).beyond = number;
            }
        }
    }
}

/// An edge that is not kept.
fn to(beyond: u32) -> Border {
    Border { beyond, is_kept: false }
}

fn coord(point: Point2<f64>) -> robust::Coord<f64> {
    robust::Coord { x: point.x, y: point.y }
}

/// Positive if three places are counter-clockwise, zero if they are on a line.
pub fn orientation(a: Point2<f64>, b: Point2<f64>, c: Point2<f64>) -> f64 {
    robust::orient2d(coord(a), coord(b), coord(c))
}

/// What is closer than this, relative to its size, is the same.
const SAME: f64 = 1e-9;

/// Whether four points lie on a circle, as far as rounding can tell: the angles at `c` and `d`
/// over the edge from `a` to `b` make 180 degrees.
pub fn is_on_circle(a: Point2<f64>, b: Point2<f64>, c: Point2<f64>, d: Point2<f64>) -> bool {
    let angle = |at: Point2<f64>| {
        let dot = (a.x - at.x) * (b.x - at.x) + (a.y - at.y) * (b.y - at.y);
        let doubled = (a.x - at.x) * (b.y - at.y) - (a.y - at.y) * (b.x - at.x);
        doubled.abs().atan2(dot)
    };
    (angle(c) + angle(d) - std::f64::consts::PI).abs() < SAME
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of two triangles in a larger one, which covers it.
    fn square() -> LinkedTriangles {
        let places = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let places = places.map(|[x, y]| Point2::new(x, y));
        let mut all = LinkedTriangles::new(places.to_vec());
        let cells = [[0, 1, 2], [0, 2, 3]].map(|points| Linked::new(points, Some(7)));
        let pairs = all.add(cells.into_iter()).unwrap();
        assert_eq!(pairs.len(), 5);
        all
    }

    /// Neighbours know of each other, and agree on what is kept.
    fn check(all: &LinkedTriangles) {
        for (triangle, number) in all.triangles().iter().zip(0..) {
            let [a, b, c] = all.corners(number);
            assert!(orientation(a, b, c) > 0.0);
            for corner in 0..3 {
                let border = triangle.borders[corner];
                let Some(twin) = all.twin((number, corner)) else {
                    assert_eq!(border.beyond, NONE);
                    continue;
                };
                let back = all.triangle(twin.0).borders[twin.1];
                assert_eq!(back, Border { beyond: number, ..border });
            }
        }
    }

    #[test]
    fn splits_and_turns_by_hand() {
        let mut all = square();
        check(&all);
        all.positions.push(Point2::new(0.5, 0.25));
        all.split(0, 4);
        check(&all);
        assert_eq!(all.triangles().len(), 4);
        // the diagonal is kept: halves are, too
        let diagonal = (1, all.triangle(1).points.iter().position(|&p| p == 3).unwrap());
        all.keep(diagonal, true);
        assert!(!all.is_bad(diagonal));
        all.positions.push(Point2::new(0.5, 0.5));
        let around = all.split_edge(diagonal, 5).unwrap();
        check(&all);
        let kept = |all: &LinkedTriangles| {
            all.triangles().iter().flat_map(|t| t.borders).filter(|border| border.is_kept).count()
        };
        assert_eq!((all.triangles().len(), kept(&all)), (6, 4));
        let edge = (around[0].0, 0);
        all.keep(edge, false);
        all.flip(edge).unwrap();
        check(&all);
        assert_eq!(kept(&all), 2);
        all.make_delaunay((0..6).flat_map(|t| [0, 1, 2].map(|corner| (t, corner))).collect());
        check(&all);
        assert!((0..6).all(|t| (0..3).all(|corner| !all.is_bad((t, corner)))));
    }

    #[test]
    fn what_does_not_fit_together_is_refused() {
        let with = |more: [u32; 3]| {
            let mut all = square();
            all.positions.push(Point2::new(2.0, 2.0));
            let cells = [[0, 1, 2], [0, 2, 3], more].map(|points| Linked::new(points, None));
            LinkedTriangles::new(all.positions).add(cells.into_iter()).unwrap_err()
        };
        assert_eq!(with([0, 2, 4]), NotLinked { ends: [0, 2], count: 3 });
        assert_eq!(with([1, 2, 4]), NotLinked { ends: [1, 2], count: 2 });
    }
}
