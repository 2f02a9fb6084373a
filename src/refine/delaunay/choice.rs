//! Which point is added for a triangle.

use std::collections::{HashMap, HashSet};

use rayon::prelude::*;
use spade::Point2;

use super::curve::mix;
use super::features::sorted;
use super::longest_edge;
use super::triangulation::{Face, FaceNumber, Triangulation, Way, centroid, cross};

/// A point to be added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Addition {
    /// In the middle of a feature.
    Halve {
        edge: [u32; 2],
        /// How often angles may halve the halves.
        halvings: u8,
    },
    /// Inside the domain.
    Inside {
        place: Point2<f64>,
        /// The face that holds it now.
        face: FaceNumber,
        /// How far it is from all points.
        radius: f64,
    },
}

/// Lengths closer than this part of them are the same: rounding must not decide.
const SAME: f64 = 1e-9;

/// The thesis' choice for a marked triangle: its circumcenter, if that is inside the domain;
/// the middle of the longest edge, if that is on the boundary; its centroid otherwise.
///
/// A circumcenter that sees a kept edge under more than a right angle is not taken (Ruppert
/// 1995): the edge is halved instead, else flat triangles would be left there.
pub fn by_thesis(triangulation: &Triangulation, face: &Face) -> Vec<Addition> {
    let Circle { centre, radius } = circle(face);
    if let Way::Free(holder) = triangulation.way(face, centre) {
        let encroached = triangulation.encroached(centre, holder);
        if !encroached.is_empty() {
            return encroached.into_iter().map(|edge| halve(triangulation, edge)).collect();
        }
        return vec![Addition::Inside { place: centre, face: holder, radius }];
    }
    let (length, _) = longest_edge(face);
    let kept = [[0, 1], [1, 2], [2, 0]].into_iter().filter(|&[i, j]| {
        face.corners[i].distance_2(face.corners[j]).sqrt() >= length * (1.0 - SAME)
    });
    let kept = kept
        .map(|[i, j]| sorted([face.points[i], face.points[j]]))
        .filter(|edge| triangulation.features.contains_key(edge));
    // of two that are equally long, neither is preferred
    let halved: Vec<Addition> = kept.map(|edge| halve(triangulation, edge)).collect();
    if !halved.is_empty() {
        return halved;
    }
    let place = centroid(&face.corners);
    let nearest = face.corners.iter().map(|corner| corner.distance_2(place));
    let radius = nearest.fold(f64::INFINITY, f64::min).sqrt();
    vec![Addition::Inside { place, face: face.number, radius }]
}

/// Halving a feature because a mark asks for it.
fn halve(triangulation: &Triangulation, edge: [u32; 2]) -> Addition {
    let halvings = triangulation.features.get(&edge).map_or(0, |feature| feature.halvings);
    Addition::Halve { edge, halvings }
}

/// The circle through the corners of a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Circle {
    pub centre: Point2<f64>,
    pub radius: f64,
}

/// The circle through the corners. Where the centre is the middle of a side but for rounding,
/// it is that middle: two right triangles with a common side have one centre.
pub fn circle(face: &Face) -> Circle {
    let [a, b, c] = face.corners;
    let doubled = 2.0 * cross(a, b, c);
    let (bx, by, cx, cy) = (b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y);
    let (bb, cc) = (bx * bx + by * by, cx * cx + cy * cy);
    let (x, y) = ((cy * bb - by * cc) / doubled, (bx * cc - cx * bb) / doubled);
    let centre = Point2::new(a.x + x, a.y + y);
    let radius = x.hypot(y);
    let middles = [(a, b), (b, c), (c, a)].map(|(from, to)| mix(from, to, 0.5));
    let same = middles.into_iter().find(|m| m.distance_2(centre).sqrt() <= SAME * radius);
    Circle { centre: same.unwrap_or(centre), radius }
}

/// Additions closer than this part of the smaller distance to all points conflict: both
/// triangles are refined by one of them.
const CONFLICT: f64 = 0.5;

/// The additions without those that conflict, in their order. Those further from all points come
/// first. Of equally far ones that conflict, as on both sides of a line of symmetry, none is
/// preferred: they become one point, amid them.
pub fn without_conflicts(additions: Vec<Addition>) -> Vec<Addition> {
    let mut kept: Vec<(usize, Addition)> = Vec::with_capacity(additions.len());
    let mut halved = HashSet::new();
    let mut inside = Vec::with_capacity(additions.len());
    for (order, addition) in additions.into_iter().enumerate() {
        match addition {
            Addition::Halve { edge, .. } if !halved.insert(edge) => {}
            Addition::Halve { .. } => kept.push((order, addition)),
            Addition::Inside { place, face, radius } => {
                inside.push(Inside { order, place, face, radius });
            }
        }
    }
    // stable: of equal ones the first that is asked for comes first
    inside.par_sort_by(|one, other| other.radius.total_cmp(&one.radius));
    let mut accepted = Nearby::default();
    for equal in inside.chunk_by(|one, next| next.radius >= one.radius * (1.0 - SAME)) {
        let free = equal.iter().filter(|one| accepted.conflicts(one).is_empty());
        for cluster in clusters(free) {
            let one = merged(&cluster);
            kept.push((one.order, one.addition()));
            accepted.add(one);
        }
    }
    kept.par_sort_by_key(|&(order, _)| order);
    kept.into_iter().map(|(_, addition)| addition).collect()
}

/// A point to be added inside the domain: see [`Addition::Inside`].
#[derive(Clone, Copy, Debug)]
struct Inside {
    order: usize,
    place: Point2<f64>,
    face: FaceNumber,
    radius: f64,
}

impl Inside {
    fn addition(self) -> Addition {
        Addition::Inside { place: self.place, face: self.face, radius: self.radius }
    }
}

/// Points to be added, by where they are: in squares about as large as their radius. Faces would
/// not do: a place on an edge is in either.
#[derive(Default)]
struct Nearby {
    points: Vec<Inside>,
    by_square: HashMap<Square, Vec<usize>>,
    levels: Vec<i32>,
}

/// A square: the power of two that is its side, and which it is.
type Square = (i32, [i64; 2]);

impl Nearby {
    fn add(&mut self, one: Inside) {
        let level = one.radius.log2().floor() as i32;
        if !self.levels.contains(&level) {
            self.levels.push(level);
        }
        self.by_square.entry(square(one.place, level)).or_default().push(self.points.len());
        self.points.push(one);
    }

    /// The places in the list of those that are too near. None has a smaller radius.
    fn conflicts(&self, one: &Inside) -> Vec<usize> {
        let squares = self.levels.iter().flat_map(|&level| {
            let (_, [i, j]) = square(one.place, level);
            let steps = (0..9)
                .map(move |step| [i.saturating_add(step % 3 - 1), j.saturating_add(step / 3 - 1)]);
            steps.map(move |place| (level, place))
        });
        let others = squares.filter_map(|square| self.by_square.get(&square)).flatten().copied();
        let is_near = |&other: &usize| {
            let other = &self.points[other];
            let distance = one.place.distance_2(other.place).sqrt();
            distance < CONFLICT * one.radius.min(other.radius) * (1.0 - SAME)
        };
        others.filter(is_near).collect()
    }
}

fn square(place: Point2<f64>, level: i32) -> Square {
    let side = f64::from(level).exp2();
    (level, [place.x, place.y].map(|x| (x / side).floor() as i64))
}

/// Those that conflict with each other, together, in the order of the first of each.
fn clusters<'a>(points: impl Iterator<Item = &'a Inside>) -> Vec<Vec<Inside>> {
    let mut nearby = Nearby::default();
    // one of the same cluster that came before, or the point itself
    let mut earlier: Vec<usize> = Vec::new();
    for &point in points {
        let place = earlier.len();
        earlier.push(place);
        for other in nearby.conflicts(&point) {
            let [one, other] = [place, other].map(|point| first(&earlier, point));
            earlier[one.max(other)] = one.min(other);
        }
        nearby.add(point);
    }
    let mut clusters: Vec<Vec<Inside>> = vec![Vec::new(); earlier.len()];
    for (place, &point) in nearby.points.iter().enumerate() {
        clusters[first(&earlier, place)].push(point);
    }
    clusters.retain(|cluster| !cluster.is_empty());
    clusters
}

fn first(earlier: &[usize], mut point: usize) -> usize {
    while earlier[point] != point {
        point = earlier[point];
    }
    point
}

/// The point amid some; where all are at one place, that place.
fn merged(cluster: &[Inside]) -> Inside {
    let (first, rest) = (&cluster[0], &cluster[1..]);
    let count = cluster.len() as f64;
    let mean = |of: fn(&Inside) -> f64| cluster.iter().map(of).sum::<f64>() / count;
    let is_same = rest.iter().all(|one| one.place == first.place);
    let amid = Point2::new(mean(|one| one.place.x), mean(|one| one.place.y));
    Inside { place: if is_same { first.place } else { amid }, ..*first }
}
