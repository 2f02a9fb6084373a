//! Which point is added for a triangle.

use std::collections::HashMap;

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
        /// A point near it.
        near: u32,
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
        let near = face.points[0];
        return vec![Addition::Inside { place: centre, face: holder, near, radius }];
    }
    let (length, _) = longest_edge(face);
    let kept = [[0, 1], [1, 2], [2, 0]].into_iter().filter(|&[i, j]| {
        face.corners[i].distance_2(face.corners[j]).sqrt() >= length * (1.0 - SAME)
    });
    let mut kept = kept
        .map(|[i, j]| sorted([face.points[i], face.points[j]]))
        .filter(|edge| triangulation.features.contains_key(edge));
    if let Some(edge) = kept.next() {
        return vec![halve(triangulation, edge)];
    }
    let place = centroid(&face.corners);
    let nearest = face.corners.iter().map(|corner| corner.distance_2(place));
    let radius = nearest.fold(f64::INFINITY, f64::min).sqrt();
    vec![Addition::Inside { place, face: face.number, near: face.points[0], radius }]
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

/// The additions without those that conflict. A pair that conflicts becomes one point, in the
/// middle between both, so that neither is preferred; a third one goes.
pub fn without_conflicts(triangulation: &Triangulation, additions: Vec<Addition>) -> Vec<Addition> {
    let mut kept: Vec<(Addition, bool)> = Vec::with_capacity(additions.len());
    let mut by_face: HashMap<FaceNumber, Vec<usize>> = HashMap::new();
    let mut halved = std::collections::HashSet::new();
    for addition in additions {
        let Addition::Inside { place, face, near, radius } = addition else {
            let Addition::Halve { edge, .. } = addition else { continue };
            if halved.insert(edge) {
                kept.push((addition, false));
            }
            continue;
        };
        let around = [face].into_iter().chain(triangulation.neighbours(face));
        let others = around.filter_map(|face| by_face.get(&face)).flatten();
        let conflict = others.copied().find(|&other| match kept[other].0 {
            Addition::Inside { place: there, radius: other, .. } => {
                place.distance_2(there).sqrt() < CONFLICT * radius.min(other)
            }
            Addition::Halve { .. } => false,
        });
        match conflict {
            None => {
                by_face.entry(face).or_default().push(kept.len());
                kept.push((addition, false));
            }
            Some(other) if !kept[other].1 => {
                if let Addition::Inside { place: there, radius: r, .. } = kept[other].0 {
                    let between = if place == there { place } else { mix(there, place, 0.5) };
                    let radius = radius.min(r);
                    let merged = Addition::Inside { place: between, face, near, radius };
                    kept[other] = (merged, true);
                }
            }
            Some(_) => {}
        }
    }
    kept.into_iter().map(|(addition, _)| addition).collect()
}
