//! The Delaunay tetrahedra of points in the unit cube, one point after the other
//! (Bowyer 1981, Watson 1981), with exact predicates (Shewchuk 1997).
//!
//! The eight corners come first, as six tetrahedra around a diagonal. They lie on one
//! sphere, so these are Delaunay. The tetrahedra whose circumsphere holds a new point
//! are replaced by those between the point and the border of their union. As "holds" is
//! exact and strict, the point sees each face of that border from inside, so no
//! tetrahedron is flat or turned, whatever points lie on one sphere.

use std::collections::HashMap;

use robust::{Coord3D, insphere, orient3d};
use vtu2contour::mesh::Vector;

use super::tetrahedra::{KUHN, cube_corner};

/// No tetrahedron: the border of the cube.
const NONE: u32 = u32::MAX;

/// The corners of the face opposite each corner, seen counter-clockwise from outside
/// a tetrahedron of positive volume.
const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// Delaunay tetrahedra of positive volume, with what lies beyond each face.
pub struct Delaunay {
    pub points: Vec<Vector>,
    corners: Vec<[u32; 4]>,
    /// Opposite each corner.
    beyond: Vec<[u32; 4]>,
    /// Numbers of tetrahedra that were removed.
    free: Vec<u32>,
    /// The point that last removed each tetrahedron, or one that does not exist.
    removed_by: Vec<u32>,
    /// Where the search for the next point begins.
    last: u32,
}

/// A face of the border of a cavity, seen counter-clockwise from outside it, and the
/// tetrahedron there.
struct BorderFace {
    points: [u32; 3],
    beyond: u32,
}

impl Delaunay {
    /// The eight corners of the unit cube.
    pub fn new() -> Self {
        let mut new = Self {
            points: (0..8).map(cube_corner).collect(),
            corners: KUHN.to_vec(),
            beyond: vec![[NONE; 4]; KUHN.len()],
            free: Vec::new(),
            removed_by: vec![NONE; KUHN.len()],
            last: 0,
        };
        let mut faces = HashMap::new();
        for tetrahedron in 0..KUHN.len() as u32 {
            for (slot, face) in FACES.iter().enumerate() {
                let mut key = face.map(|corner| KUHN[tetrahedron as usize][corner]);
                key.sort_unstable();
                if let Some(other) = faces.insert(key, (tetrahedron, slot)) {
                    new.join((tetrahedron, slot), other);
                }
            }
        }
        new
    }

    /// Adds a point strictly inside the cube that is not there yet.
    pub fn insert(&mut self, position: Vector) {
        assert!(position.iter().all(|&x| 0.0 < x && x < 1.0), "outside the cube: {position}");
        let point = self.points.len() as u32;
        self.points.push(position);
        let border = self.dig(point);
        let mut open = HashMap::new();
        for face in border {
            let [a, b, c] = face.points;
            let new = self.add([point, a, b, c]);
            self.last = new;
            if face.beyond != NONE {
                let slot = self.slot_of(face.beyond, face.points);
                self.join((new, 0), (face.beyond, slot));
            }
            for (slot, edge) in [(1, [b, c]), (2, [c, a]), (3, [a, b])] {
                let key = (edge[0].min(edge[1]), edge[0].max(edge[1]));
                if let Some(other) = open.remove(&key) {
                    self.join((new, slot), other);
                } else {
                    open.insert(key, (new, slot));
                }
            }
        }
        assert!(open.is_empty(), "the border of the cavity is not closed");
    }

    /// The tetrahedra.
    pub fn tetrahedra(&self) -> Vec<[u32; 4]> {
        let all = self.corners.iter().zip(&self.removed_by);
        all.filter(|(_, by)| **by == NONE).map(|(corners, _)| *corners).collect()
    }

    /// Removes the tetrahedra whose circumsphere holds a point; the border of their
    /// union.
    fn dig(&mut self, point: u32) -> Vec<BorderFace> {
        let first = self.locate(point);
        let mut border = Vec::new();
        let mut cavity = vec![first];
        self.removed_by[first as usize] = point;
        while let Some(tetrahedron) = cavity.pop() {
            self.free.push(tetrahedron);
            let corners = self.corners[tetrahedron as usize];
            for (slot, &beyond) in self.beyond[tetrahedron as usize].iter().enumerate() {
                if beyond != NONE && self.removed_by[beyond as usize] == point {
                    continue;
                }
                if beyond != NONE && self.sphere_holds(beyond, point) {
                    self.removed_by[beyond as usize] = point;
                    cavity.push(beyond);
                } else {
                    border.push(BorderFace { points: FACES[slot].map(|c| corners[c]), beyond });
                }
            }
        }
        border
    }

    /// A tetrahedron that holds a point, found by walking towards it.
    fn locate(&self, point: u32) -> u32 {
        let mut here = self.last;
        'walk: loop {
            let corners = self.corners[here as usize];
            for (slot, &beyond) in self.beyond[here as usize].iter().enumerate() {
                let [a, b, c] = FACES[slot].map(|corner| self.coordinates(corners[corner]));
                if beyond != NONE && orient3d(a, b, c, self.coordinates(point)) < 0.0 {
                    here = beyond;
                    continue 'walk;
                }
            }
            return here;
        }
    }

    fn sphere_holds(&self, tetrahedron: u32, point: u32) -> bool {
        let [a, b, c, d] = self.corners[tetrahedron as usize].map(|p| self.coordinates(p));
        // the predicate wants the other orientation
        insphere(b, a, c, d, self.coordinates(point)) > 0.0
    }

    fn coordinates(&self, point: u32) -> Coord3D<f64> {
        let [x, y, z] = self.points[point as usize].into();
        Coord3D { x, y, z }
    }

    fn add(&mut self, corners: [u32; 4]) -> u32 {
        let number = self.free.pop().unwrap_or_else(|| {
            self.corners.push([NONE; 4]);
            self.beyond.push([NONE; 4]);
            self.removed_by.push(NONE);
            self.corners.len() as u32 - 1
        });
        self.corners[number as usize] = corners;
        self.beyond[number as usize] = [NONE; 4];
        self.removed_by[number as usize] = NONE;
        number
    }

    /// The corner of a tetrahedron that is not on one of its faces.
    fn slot_of(&self, tetrahedron: u32, face: [u32; 3]) -> usize {
        let corners = &self.corners[tetrahedron as usize];
        corners.iter().position(|corner| !face.contains(corner)).expect("four corners")
    }

    fn join(&mut self, one: (u32, usize), other: (u32, usize)) {
        self.beyond[one.0 as usize][one.1] = other.0;
        self.beyond[other.0 as usize][other.1] = one.0;
    }
}
