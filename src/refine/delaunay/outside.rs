//! What lies around a domain: triangles in its holes and bays, and beyond it as far as a frame.
//!
//! A domain's cells, each counter-clockwise, share their edges in pairs, but for those of the
//! boundary. If these do not cross, and every part of the plane between them has either cells or
//! none, then each place has as many cells as it has by the boundary: one, or none.

use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation as _, mitigate_underflow};

use super::DelaunayError;
use super::features::{Features, sorted};
use super::linked::{Linked, LinkedTriangles};

type Spade = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// So many points are around all, and as far off: no kept edge is beyond which there is nothing.
const FRAME: usize = 8;
const FRAME_RADIUS: f64 = 4.0;

/// Adds the outside to the cells of a domain, of which these are the features. The points that
/// are added make a frame around all.
///
/// # Errors
/// If edges of the boundary cross, or cells lie over one another.
pub fn add_outside(cells: &mut LinkedTriangles, features: &Features) -> Result<(), DelaunayError> {
    let mut boundary: Vec<([u32; 2], bool)> = features
        .iter()
        .filter(|(_, feature)| feature.sides.contains(&None))
        .map(|(&ends, feature)| (ends, feature.sides[0].is_some()))
        .collect();
    boundary.sort_unstable();
    let mut used: Vec<u32> = boundary.iter().flat_map(|(ends, _)| *ends).collect();
    used.sort_unstable();
    used.dedup();
    let number = |point: u32| used.partition_point(|&other| other < point);
    let mut points: Vec<_> = used.iter().map(|&point| cells.position(point)).collect();
    let frame = frame(&points);
    points.extend(frame);
    let edges: Vec<[usize; 2]> = boundary.iter().map(|(ends, _)| ends.map(number)).collect();
    let spade = triangulated(points, &edges).map_err(|error| match error {
        DelaunayError::CrossingEdges { ends } => {
            DelaunayError::CrossingEdges { ends: ends.map(|end| used[end as usize]) }
        }
        other => other,
    })?;
    let is_inside = inside(&spade, &edges, &boundary)?;
    let first = cells.positions.len() as u32;
    cells.positions.extend(frame);
    let number = |point: usize| match used.get(point) {
        Some(&number) => number,
        None => first + (point - used.len()) as u32,
    };
    let outside = spade.inner_faces().filter(|face| is_inside[face.index()] == Some(false));
    let outside = outside.map(|face| Linked::new(face.vertices().map(|v| number(v.index())), None));
    let linked = cells.add(outside);
    // what is outside has the boundary's edges, each once
    linked.map_err(|error| DelaunayError::CrossingEdges { ends: error.ends })?;
    Ok(())
}

/// Points around all.
fn frame(points: &[Point2<f64>]) -> [Point2<f64>; FRAME] {
    let all = || points.iter();
    let bound = |of: fn(f64, f64) -> f64, start: f64| {
        let bounds = all().fold((start, start), |(x, y), p| (of(x, p.x), of(y, p.y)));
        Point2::new(bounds.0, bounds.1)
    };
    let (low, high) = (bound(f64::min, f64::INFINITY), bound(f64::max, f64::NEG_INFINITY));
    let radius = FRAME_RADIUS * low.distance_2(high).sqrt();
    let (x, y) = (0.5 * (low.x + high.x), 0.5 * (low.y + high.y));
    std::array::from_fn(|k| {
        let (sine, cosine) = (std::f64::consts::TAU * k as f64 / FRAME as f64).sin_cos();
        mitigate_underflow(Point2::new(x + radius * cosine, y + radius * sine))
    })
}

/// The triangulation of points with these edges.
fn triangulated(points: Vec<Point2<f64>>, edges: &[[usize; 2]]) -> Result<Spade, DelaunayError> {
    let mut crossing = Vec::new();
    let loaded = Spade::try_bulk_load_cdt(points, edges.to_vec(), |edge| crossing.push(edge));
    let Ok(spade) = loaded else { return Err(DelaunayError::TooLarge) };
    // an edge through a point became several
    if spade.num_constraints() != edges.len() {
        let is_missing =
            |edge: &&[usize; 2]| !spade.exists_constraint(handle(edge[0]), handle(edge[1]));
        crossing.extend(edges.iter().find(is_missing));
    }
    match crossing.iter().min() {
        None => Ok(spade),
        Some(edge) => Err(DelaunayError::CrossingEdges { ends: sorted(edge.map(|p| p as u32)) }),
    }
}

/// Whether there are cells in each face, by the boundary's edges, of which `boundary` says
/// whether these lie to the left.
fn inside(
    spade: &Spade,
    edges: &[[usize; 2]],
    boundary: &[([u32; 2], bool)],
) -> Result<Vec<Option<bool>>, DelaunayError> {
    let mut is_inside: Vec<Option<bool>> = vec![None; spade.num_all_faces()];
    for (&[from, to], &(ends, is_left)) in edges.iter().zip(boundary) {
        let edge = spade.get_edge_from_neighbors(handle(from), handle(to));
        let Some(edge) = edge else { return Err(DelaunayError::CrossingEdges { ends }) };
        for (edge, here) in [(edge, is_left), (edge.rev(), !is_left)] {
            let mut open: Vec<_> = edge.face().as_inner().into_iter().collect();
            while let Some(face) = open.pop() {
                match is_inside[face.index()].replace(here) {
                    Some(before) if before == here => continue,
                    Some(_) => return Err(DelaunayError::CrossingEdges { ends }),
                    None => {}
                }
                let inner = face.adjacent_edges().into_iter().filter(|e| !e.is_constraint_edge());
                open.extend(inner.filter_map(|edge| edge.rev().face().as_inner()));
            }
        }
    }
    Ok(is_inside)
}

fn handle(point: usize) -> FixedVertexHandle {
    FixedVertexHandle::from_index(point)
}
