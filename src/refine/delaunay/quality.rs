//! Triangles with small angles, and what is added for them.
//!
//! J. Ruppert, A Delaunay refinement algorithm for quality 2-dimensional mesh generation
//! (1995): the circumcenter, or where that sees a kept edge under a right angle, the middle of
//! that edge.

use rayon::prelude::*;

use super::choice::{Addition, circle, without_conflicts};
use super::features::sorted;
use super::triangulation::{Face, Triangulation, Way};

/// After so many rounds angles are left as they are. Three to six are enough where no two kept
/// edges make a small angle.
pub const ROUNDS: usize = 24;

/// Lengths closer than this part of them are the same: rounding must not decide.
const SAME: f64 = 1e-9;

/// What is added for triangles with a point of number `first_new` or above, and an angle below
/// `least_angle` degrees.
pub fn improvements(
    triangulation: &Triangulation,
    first_new: u32,
    least_angle: f64,
) -> Vec<Addition> {
    let least = least_angle.to_radians().sin();
    let faces = triangulation.faces().flatten().map(|(face, _)| face);
    let bad = faces.filter(|face| {
        face.points.iter().any(|&point| point >= first_new)
            && shortest_edge(face) < 2.0 * least * circle(face).radius
            && !is_given(triangulation, face)
    });
    let additions = bad.flat_map_iter(|face| for_angle(triangulation, &face)).collect();
    without_conflicts(additions)
}

/// The length of the edge opposite a corner.
fn length(face: &Face, corner: usize) -> f64 {
    face.corners[(corner + 1) % 3].distance_2(face.corners[(corner + 2) % 3]).sqrt()
}

/// The length of the shortest edge of a face.
fn shortest_edge(face: &Face) -> f64 {
    (0..3).map(|corner| length(face, corner)).fold(f64::INFINITY, f64::min)
}

/// Whether two kept edges make the least angle, or one of two: no point can change that.
fn is_given(triangulation: &Triangulation, face: &Face) -> bool {
    let shortest = shortest_edge(face);
    (0..3).filter(|&corner| length(face, corner) <= shortest * (1.0 + SAME)).any(|corner| {
        [1, 2].into_iter().all(|step| {
            let edge = sorted([face.points[corner], face.points[(corner + step) % 3]]);
            triangulation.features.contains_key(&edge)
        })
    })
}

fn for_angle(triangulation: &Triangulation, face: &Face) -> Vec<Addition> {
    let circle = circle(face);
    let edges = match triangulation.way(face, circle.centre) {
        Way::Lost => return Vec::new(),
        Way::Blocked(edge) => vec![edge],
        Way::Free(holder) => {
            let encroached = triangulation.encroached(circle.centre, holder);
            if encroached.is_empty() {
                return vec![Addition::Inside {
                    place: circle.centre,
                    face: holder,
                    radius: circle.radius,
                }];
            }
            encroached
        }
    };
    let halved = edges.into_iter().filter_map(|edge| {
        let halvings = triangulation.features.get(&edge)?.halvings.checked_sub(1)?;
        Some(Addition::Halve { edge, halvings })
    });
    halved.collect()
}
