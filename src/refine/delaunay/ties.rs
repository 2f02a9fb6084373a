//! Points on a circle: which diagonals.
//!
//! Where four points or more lie on a circle, as far as rounding can tell, they make a polygon of
//! which every triangulation is Delaunay, and rounding and the order of insertion would choose.
//! Here geometry does, in a way that every symmetry of the mesh respects: the shorter diagonals
//! first, of equal ones those whose lines are farther from the middle of the mesh, through which
//! all lines of symmetry go. These lie along the boundary rather than across it, as the level lines
//! of most solutions do, and an edge along a level line has the smaller error. One that cuts off a
//! corner of the domain is the last: of a triangle with two sides on the boundary a solver learns
//! nothing that the boundary values do not say.
//!
//! Diagonals that are equal by this are each other's mirror images, and if they cross, as in a
//! rectangle of which two sides are on both sides of a line of symmetry, there is no symmetric
//! choice: both are taken, and a point is added where they cross. Its triangles have no smaller
//! angles than those of the rectangle.
//!
//! Only polygons that have a new point are looked at.

use spade::Point2;

use super::curve::mix;
use super::linked::{LinkedTriangles, is_on_circle, orientation};
use super::triangulation::cross;

/// What is closer than this, relative to its size, is the same.
const SAME: f64 = 1e-9;

/// Gives all polygons of points on a circle that have a point of number `first_new` or above their
/// diagonals. Returns where a point has to be added, and a triangle there.
pub fn settle(cells: &mut LinkedTriangles, first_new: u32) -> Vec<(Point2<f64>, u32)> {
    let mut places = Vec::new();
    let Some(centre) = centre(cells) else { return places };
    let mut is_seen = vec![false; cells.triangles().len()];
    for triangle in 0..cells.triangles().len() as u32 {
        let is_new = cells.triangle(triangle).points.iter().any(|&point| point >= first_new);
        let is_inside = cells.triangle(triangle).side.is_some();
        if !is_new || !is_inside || is_seen[triangle as usize] {
            continue;
        }
        let parts = on_one_circle(cells, triangle, &mut is_seen);
        if parts.len() < 2 {
            continue;
        }
        let Some(polygon) = Polygon::new(cells, &parts) else { continue };
        let mut faces = polygon.faces(&polygon.diagonals(centre));
        places.extend(faces.iter().filter(|face| face.len() > 3).map(|face| {
            // any triangle of the polygon is near
            (polygon.place_in(face), parts[0])
        }));
        // for the time being, or for good if no more points are allowed
        let fan = |face: &Vec<usize>| -> Vec<[usize; 3]> {
            face.windows(2).skip(1).map(|pair| [face[0], pair[0], pair[1]]).collect()
        };
        let triangles = faces.drain(..).flat_map(|face| fan(&face));
        let triangles: Vec<[u32; 3]> =
            triangles.map(|corners| corners.map(|corner| polygon.points[corner])).collect();
        cells.replace(&parts, &triangles);
    }
    places
}

/// The middle of the mesh: the mean of its points would depend on where it is fine.
fn centre(cells: &LinkedTriangles) -> Option<Point2<f64>> {
    let (mut area, mut x, mut y) = (0.0, 0.0, 0.0);
    let inside = cells.triangles().iter().filter(|triangle| triangle.side.is_some());
    for triangle in inside {
        let [a, b, c] = triangle.points.map(|point| cells.position(point));
        let part = cross(a, b, c);
        area += part;
        x += part * (a.x + b.x + c.x) / 3.0;
        y += part * (a.y + b.y + c.y) / 3.0;
    }
    (area > 0.0).then(|| Point2::new(x / area, y / area))
}

/// The triangles around one, and itself, that have their corners on the same circle.
fn on_one_circle(cells: &LinkedTriangles, first: u32, is_seen: &mut [bool]) -> Vec<u32> {
    let mut parts = vec![first];
    is_seen[first as usize] = true;
    let mut next = 0;
    while let Some(&part) = parts.get(next) {
        next += 1;
        for corner in 0..3 {
            let triangle = cells.triangle(part);
            let Some((beyond, opposite)) = cells.twin((part, corner)) else { continue };
            if triangle.borders[corner].is_kept || is_seen[beyond as usize] {
                continue;
            }
            let [a, b] = triangle.edge(corner);
            let ends = [a, b, triangle.points[corner], cells.triangle(beyond).points[opposite]];
            let [a, b, c, d] = ends.map(|point| cells.position(point));
            if is_on_circle(a, b, c, d) {
                is_seen[beyond as usize] = true;
                parts.push(beyond);
            }
        }
    }
    parts
}

/// Points on a circle, counter-clockwise, that of the lowest number first.
struct Polygon {
    points: Vec<u32>,
    corners: Vec<Point2<f64>>,
    /// Whether the side from each corner to the next is kept: on a boundary or an interface.
    is_kept: Vec<bool>,
}

/// A diagonal by the places of its ends, the lower first.
#[derive(Clone, Copy, Debug)]
struct Diagonal {
    ends: [usize; 2],
    length: f64,
    /// From the middle of the mesh.
    distance: f64,
    /// Whether both sides that it cuts off, being no more than two, are kept.
    cuts_corner: bool,
}

/// Polygons of more points keep the diagonals that they have: their number is squared.
const MOST_POINTS: usize = 64;

impl Polygon {
    /// What triangles make together; nothing if that is no convex polygon, for rounding.
    fn new(cells: &LinkedTriangles, parts: &[u32]) -> Option<Self> {
        let mut points: Vec<u32> =
            parts.iter().flat_map(|&part| cells.triangle(part).points).collect();
        points.sort_unstable();
        points.dedup();
        let count = points.len();
        if count != parts.len() + 2 || count > MOST_POINTS {
            return None;
        }
        let middle = mean(points.iter().map(|&point| cells.position(point)));
        let lowest = points[0];
        let angle = |&point: &u32| {
            let place = cells.position(point);
            (place.y - middle.y).atan2(place.x - middle.x)
        };
        points.sort_by(|one, other| angle(one).total_cmp(&angle(other)));
        let first = points.iter().position(|&point| point == lowest)?;
        points.rotate_left(first);
        let corners: Vec<_> = points.iter().map(|&point| cells.position(point)).collect();
        let is_convex = (0..count).all(|k| {
            let [a, b, c] = [0, 1, 2].map(|step| corners[(k + step) % count]);
            orientation(a, b, c) > 0.0
        });
        let is_kept = (0..count).map(|k| {
            let side = [points[k], points[(k + 1) % count]];
            parts.iter().any(|&part| {
                let triangle = cells.triangle(part);
                (0..3)
                    .any(|corner| triangle.edge(corner) == side && triangle.borders[corner].is_kept)
            })
        });
        let is_kept = is_kept.collect();
        is_convex.then_some(Self { points, corners, is_kept })
    }

    /// Diagonals that do not cross, as many as can be chosen without preferring one of two that
    /// are equal.
    fn diagonals(&self, centre: Point2<f64>) -> Vec<Diagonal> {
        let mut all = self.all(centre);
        let size = all.iter().map(|diagonal| diagonal.length).fold(0.0, f64::max);
        let mut chosen: Vec<Diagonal> = Vec::new();
        all.sort_by(|one, other| one.length.total_cmp(&other.length));
        for equal in all.chunk_by_mut(|one, next| next.length - one.length <= SAME * size) {
            equal.sort_by(|one, other| {
                let farther = other.distance.total_cmp(&one.distance);
                one.cuts_corner.cmp(&other.cuts_corner).then(farther)
            });
            let is_equal = |one: &Diagonal, next: &Diagonal| {
                one.cuts_corner == next.cuts_corner && one.distance - next.distance <= SAME * size
            };
            for equal in equal.chunk_by(is_equal) {
                let cross = |one: &Diagonal, others: &[Diagonal]| {
                    others.iter().any(|other| one.crosses(other))
                };
                let possible: Vec<Diagonal> =
                    equal.iter().filter(|one| !cross(one, &chosen)).copied().collect();
                chosen.extend(possible.iter().filter(|one| !cross(one, &possible)));
            }
        }
        chosen
    }

    fn all(&self, centre: Point2<f64>) -> Vec<Diagonal> {
        let count = self.corners.len();
        let pairs = (0..count).flat_map(|i| (i + 2..count).map(move |j| [i, j]));
        let inner = pairs.filter(|&[i, j]| j - i < count - 1);
        let diagonal = |ends: [usize; 2]| {
            let [p, q] = ends.map(|end| self.corners[end]);
            let length = p.distance_2(q).sqrt();
            let distance = cross(p, q, centre).abs() / length;
            Diagonal { ends, length, distance, cuts_corner: self.cuts_corner(ends) }
        };
        inner.map(diagonal).collect()
    }

    fn cuts_corner(&self, [i, j]: [usize; 2]) -> bool {
        let count = self.corners.len();
        let both_kept = |first: usize| self.is_kept[first] && self.is_kept[(first + 1) % count];
        (j - i == 2 && both_kept(i)) || (i + count - j == 2 && both_kept(j))
    }

    /// The parts into which diagonals divide the polygon.
    fn faces(&self, diagonals: &[Diagonal]) -> Vec<Vec<usize>> {
        let mut faces = vec![(0..self.corners.len()).collect::<Vec<_>>()];
        for &Diagonal { ends: [i, j], .. } in diagonals {
            let has_both = |face: &Vec<usize>| face.contains(&i) && face.contains(&j);
            let Some(place) = faces.iter().position(has_both) else { continue };
            let face = faces.swap_remove(place);
            let between = |&k: &usize| i <= k && k <= j;
            faces.push(face.iter().copied().filter(between).collect());
            faces.push(face.into_iter().filter(|&k| k <= i || j <= k).collect());
        }
        faces
    }

    /// Where a point joins the corners of a face symmetrically: of four, where the diagonals
    /// cross, so that no angle becomes smaller.
    fn place_in(&self, face: &[usize]) -> Point2<f64> {
        let corner = |k: usize| self.corners[face[k]];
        if face.len() != 4 {
            return mean((0..face.len()).map(corner));
        }
        let [a, b, c, d] = [0, 1, 2, 3].map(corner);
        let (one, other) = (cross(a, c, b).abs(), cross(a, c, d).abs());
        mix(b, d, one / (one + other))
    }
}

impl Diagonal {
    fn crosses(&self, other: &Self) -> bool {
        let ([i, j], [p, q]) = (self.ends, other.ends);
        (i < p && p < j && j < q) || (p < i && i < q && q < j)
    }
}

fn mean(points: impl ExactSizeIterator<Item = Point2<f64>>) -> Point2<f64> {
    let count = points.len() as f64;
    let (x, y) = points.fold((0.0, 0.0), |(x, y), point| (x + point.x, y + point.y));
    Point2::new(x / count, y / count)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(corners: &[[f64; 2]]) -> Polygon {
        let corners: Vec<_> = corners.iter().map(|&[x, y]| Point2::new(x, y)).collect();
        let is_kept = vec![false; corners.len()];
        Polygon { points: (0..corners.len() as u32).collect(), corners, is_kept }
    }

    fn ends(polygon: &Polygon, centre: [f64; 2]) -> Vec<[usize; 2]> {
        let chosen = polygon.diagonals(Point2::new(centre[0], centre[1]));
        let mut ends: Vec<_> = chosen.into_iter().map(|diagonal| diagonal.ends).collect();
        ends.sort_unstable();
        ends
    }

    #[test]
    fn diagonals_by_hand() {
        let rectangle = polygon(&[[-1.0, 0.0], [1.0, 0.0], [1.0, 1.0], [-1.0, 1.0]]);
        assert_eq!(ends(&rectangle, [5.0, 2.0]), [[1, 3]]);
        assert_eq!(ends(&rectangle, [-5.0, 2.0]), [[0, 2]]);
        // a line of symmetry through two sides: neither
        assert_eq!(ends(&rectangle, [0.0, 5.0]).len(), 0);
        let [face] = &rectangle.faces(&[])[..] else { panic!() };
        assert_eq!(rectangle.place_in(face), Point2::new(0.0, 0.5));
        // the shorter one of a kite
        let kite = polygon(&[[-1.0, 0.0], [0.6, -0.8], [1.0, 0.0], [0.6, 0.8]]);
        assert_eq!(ends(&kite, [0.0, 0.0]), [[1, 3]]);
    }

    #[test]
    fn hexagons_by_hand() {
        let h = 3.0_f64.sqrt() / 2.0;
        let corners = [[1.0, 0.0], [0.5, h], [-0.5, h], [-1.0, 0.0], [-0.5, -h], [0.5, -h]];
        let hexagon = polygon(&corners);
        // all lines of symmetry pass through it: nothing is chosen
        assert_eq!(ends(&hexagon, [0.0, 0.0]).len(), 0);
        // one does, through two corners: what is left is the rectangle amid
        assert_eq!(ends(&hexagon, [9.0, 0.0]), [[1, 5], [2, 4]]);
        // one does, through two sides: the same, since diagonals farther off cross their images
        assert_eq!(ends(&hexagon, [0.0, 9.0]), [[1, 5], [2, 4]]);
        let faces = hexagon.faces(&hexagon.diagonals(Point2::new(0.0, 9.0)));
        let mut counts: Vec<usize> = faces.iter().map(Vec::len).collect();
        counts.sort_unstable();
        assert_eq!(counts, [3, 3, 4]);
        // none does
        assert_eq!(ends(&hexagon, [9.0, 1.0]).len(), 3);
    }

    #[test]
    fn corners_of_the_domain_are_not_cut_off() {
        let mut square = polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        assert_eq!(ends(&square, [9.0, 9.0]), [[1, 3]]);
        for first in 0..4 {
            square.is_kept = (0..4).map(|side| side == first || side == (first + 1) % 4).collect();
            let cut = if first % 2 == 0 { [[1, 3]] } else { [[0, 2]] };
            // whatever lies farther from the middle
            for centre in [[9.0, 9.0], [9.0, -8.0]] {
                assert_eq!(ends(&square, centre), cut, "{first}");
            }
        }
    }
}
