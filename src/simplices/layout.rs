//! How VTK's cell types are cut: tables of node numbers, in VTK's order of nodes.
//!
//! The tables follow the classes of VTK's Common/DataModel, faces counter-clockwise
//! from outside.

use std::ops::RangeInclusive;

use super::left_out::Reason;

/// A polygon or a face, as numbers of the cell's nodes.
type Loop = &'static [u8];

/// How a cell is cut.
#[derive(Clone, Copy, Debug)]
pub enum Cut {
    /// Points and lines hold no simplices.
    Nothing,
    /// A two-dimensional cell: convex polygons.
    Polygons(&'static [Loop]),
    /// A triangle strip.
    Strip,
    /// One polygon of all nodes.
    Polygon,
    /// One polygon of the first half of the nodes, which are the corners, and the
    /// second half, the mid nodes after them.
    QuadraticPolygon,
    /// A solid: convex solids, each as its faces.
    Solids(&'static [&'static [Loop]]),
    /// A quadratic solid as its faces (corner, mid node, and so on), which have no
    /// nodes inside.
    Corners(&'static [Loop]),
    /// A solid whose faces are in a list of their own.
    Polyhedron,
}

/// The nodes of a cell and how it is cut.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    /// How it is cut.
    pub cut: Cut,
    /// How many of its nodes, the first ones, are corners.
    corners: u8,
    /// How many, the next ones, are mid nodes of edges.
    mids: u8,
    /// How many, the next ones, are inside faces; at most one more is inside the cell.
    inner: u8,
}

impl Layout {
    /// The layout of a cell with VTK's type and a number of points.
    ///
    /// # Errors
    /// Why such a cell cannot be cut.
    pub fn new(cell_type: u8, points: usize) -> Result<Self, Reason> {
        use Cut::{
            Corners, Nothing, Polygon, Polygons, Polyhedron, QuadraticPolygon, Solids, Strip,
        };
        let (cut, [corners, mids, inner]) = match (cell_type, points) {
            (0..=4 | 21 | 35 | 68 | 75, _) => (Nothing, [0, 0, 0]),
            (5 | 69 | 76, 3) => (Polygons(&[&[0, 1, 2]]), [3, 0, 0]),
            (9 | 70 | 77, 4) => (Polygons(&[&[0, 1, 2, 3]]), [4, 0, 0]),
            (8, 4) => (Polygons(&[&[0, 1, 3, 2]]), [4, 0, 0]),
            (6, 3..) => (Strip, [0, 0, 0]),
            (7, 3..) => (Polygon, [0, 0, 0]),
            (36, 6..) if points.is_multiple_of(2) => (QuadraticPolygon, [0, 0, 0]),
            (22 | 69, 6) => (Polygons(TRIANGLE_6), [3, 3, 0]),
            (34 | 69, 7) => (Polygons(TRIANGLE_7), [3, 3, 0]),
            (23, 8) => (Polygons(QUAD_8), [4, 4, 0]),
            (28 | 70, 9) => (Polygons(QUAD_9), [4, 4, 0]),
            (30, 6) => (Polygons(QUAD_6), [4, 2, 0]),
            (10 | 71 | 78, 4) => (Solids(&[TETRAHEDRON]), [4, 0, 0]),
            (11, 8) => (Solids(&[VOXEL]), [8, 0, 0]),
            (12 | 72 | 79, 8) => (Solids(&[HEXAHEDRON]), [8, 0, 0]),
            (13 | 73 | 80, 6) => (Solids(&[WEDGE]), [6, 0, 0]),
            (14 | 74 | 81, 5) => (Solids(&[PYRAMID]), [5, 0, 0]),
            (15, 10) => (Solids(&[PENTAGONAL_PRISM]), [10, 0, 0]),
            (16, 12) => (Solids(&[HEXAGONAL_PRISM]), [12, 0, 0]),
            (24 | 71, 10) => (Corners(TETRAHEDRON_10), [4, 6, 0]),
            (25, 20) => (Corners(HEXAHEDRON_20), [8, 12, 0]),
            (26, 15) => (Corners(WEDGE_15), [6, 9, 0]),
            (27, 13) => (Corners(PYRAMID_13), [5, 8, 0]),
            (29 | 72, 27) => (Solids(HEXAHEDRON_27), [8, 12, 6]),
            (31, 12) => (Solids(WEDGE_12), [6, 6, 0]),
            (32 | 73, 18) => (Solids(WEDGE_18), [6, 9, 3]),
            (33, 24) => (Solids(&[HEXAHEDRON_24]), [8, 12, 4]),
            (37, 19) => (Solids(PYRAMID_19), [5, 8, 5]),
            (42, _) => (Polyhedron, [0, 0, 0]),
            _ => return Err(reason(cell_type, points)),
        };
        Ok(Self { cut, corners, mids, inner })
    }

    /// The rank of a node in a solid: least is the one inside the cell, then those
    /// inside faces, mid nodes, and corners. So cells and faces with a node inside
    /// are cut from there.
    pub fn rank(&self, node: usize) -> u8 {
        let [corners, mids, inner] = [self.corners, self.mids, self.inner].map(usize::from);
        let begins = [corners, corners + mids, corners + mids + inner];
        begins.iter().map(|&begin| u8::from(node < begin)).sum()
    }
}

/// Why a cell of no known layout is none.
fn reason(cell_type: u8, points: usize) -> Reason {
    match cell_type {
        // still Bézier after all that could be made Lagrange cells
        76..=80 if is_bezier_2(cell_type, points) => Reason::Weights,
        69..=74 | 76..=81 if points > 4 => Reason::HighOrder,
        5..=16 | 22..=34 | 36 | 37 | 69..=74 | 76..=81 => Reason::PointCount,
        _ => Reason::Unsupported,
    }
}

/// The types of which some cells are Bézier cells of order two.
pub const BEZIER_2: RangeInclusive<u8> = 76..=80;

/// Whether this is a Bézier cell of order two.
pub fn is_bezier_2(cell_type: u8, points: usize) -> bool {
    matches!((cell_type, points), (76, 6) | (77, 9) | (78, 10) | (79, 27) | (80, 18))
}

const TRIANGLE_6: &[Loop] = &[&[0, 3, 5], &[3, 1, 4], &[5, 4, 2], &[3, 4, 5]];
const TRIANGLE_7: &[Loop] = &[&[0, 3, 6, 5], &[1, 4, 6, 3], &[2, 5, 6, 4]];
const QUAD_6: &[Loop] = &[&[0, 4, 5, 3], &[4, 1, 2, 5]];
const QUAD_8: &[Loop] = &[&[0, 4, 7], &[1, 5, 4], &[2, 6, 5], &[3, 7, 6], &[4, 5, 6, 7]];
const QUAD_9: &[Loop] = &[&[0, 4, 8, 7], &[4, 1, 5, 8], &[8, 5, 2, 6], &[7, 8, 6, 3]];

const TETRAHEDRON: &[Loop] = &[&[0, 1, 3], &[1, 2, 3], &[2, 0, 3], &[0, 2, 1]];
const VOXEL: &[Loop] =
    &[&[0, 4, 6, 2], &[1, 3, 7, 5], &[0, 1, 5, 4], &[2, 6, 7, 3], &[0, 2, 3, 1], &[4, 5, 7, 6]];
const HEXAHEDRON: &[Loop] =
    &[&[0, 4, 7, 3], &[1, 2, 6, 5], &[0, 1, 5, 4], &[3, 7, 6, 2], &[0, 3, 2, 1], &[4, 5, 6, 7]];
const WEDGE: &[Loop] = &[&[0, 2, 1], &[3, 4, 5], &[0, 1, 4, 3], &[1, 2, 5, 4], &[2, 0, 3, 5]];
const PYRAMID: &[Loop] = &[&[0, 3, 2, 1], &[0, 1, 4], &[1, 2, 4], &[2, 3, 4], &[3, 0, 4]];
const PENTAGONAL_PRISM: &[Loop] = &[
    &[0, 4, 3, 2, 1],
    &[5, 6, 7, 8, 9],
    &[0, 1, 6, 5],
    &[1, 2, 7, 6],
    &[2, 3, 8, 7],
    &[3, 4, 9, 8],
    &[4, 0, 5, 9],
];
const HEXAGONAL_PRISM: &[Loop] = &[
    &[0, 5, 4, 3, 2, 1],
    &[6, 7, 8, 9, 10, 11],
    &[0, 1, 7, 6],
    &[1, 2, 8, 7],
    &[2, 3, 9, 8],
    &[3, 4, 10, 9],
    &[4, 5, 11, 10],
    &[5, 0, 6, 11],
];

const TETRAHEDRON_10: &[Loop] =
    &[&[0, 4, 1, 8, 3, 7], &[1, 5, 2, 9, 3, 8], &[2, 6, 0, 7, 3, 9], &[0, 6, 2, 5, 1, 4]];
const HEXAHEDRON_20: &[Loop] = &[
    &[0, 16, 4, 15, 7, 19, 3, 11],
    &[1, 9, 2, 18, 6, 13, 5, 17],
    &[0, 8, 1, 17, 5, 12, 4, 16],
    &[3, 19, 7, 14, 6, 18, 2, 10],
    &[0, 11, 3, 10, 2, 9, 1, 8],
    &[4, 12, 5, 13, 6, 14, 7, 15],
];
const WEDGE_15: &[Loop] = &[
    &[0, 8, 2, 7, 1, 6],
    &[3, 9, 4, 10, 5, 11],
    &[0, 6, 1, 13, 4, 9, 3, 12],
    &[1, 7, 2, 14, 5, 10, 4, 13],
    &[2, 8, 0, 12, 3, 11, 5, 14],
];
const PYRAMID_13: &[Loop] = &[
    &[0, 8, 3, 7, 2, 6, 1, 5],
    &[0, 5, 1, 10, 4, 9],
    &[1, 6, 2, 11, 4, 10],
    &[2, 7, 3, 12, 4, 11],
    &[3, 8, 0, 9, 4, 12],
];

/// A solid with the faces of a linear one, whose corners are the given nodes.
macro_rules! hexahedron {
    ($a:literal $b:literal $c:literal $d:literal, $e:literal $f:literal $g:literal $h:literal) => {
        &[
            &[$a, $e, $h, $d],
            &[$b, $c, $g, $f],
            &[$a, $b, $f, $e],
            &[$d, $h, $g, $c],
            &[$a, $d, $c, $b],
            &[$e, $f, $g, $h],
        ]
    };
}
macro_rules! wedge {
    ($a:literal $b:literal $c:literal, $d:literal $e:literal $f:literal) => {
        &[&[$a, $c, $b], &[$d, $e, $f], &[$a, $b, $e, $d], &[$b, $c, $f, $e], &[$c, $a, $d, $f]]
    };
}

const HEXAHEDRON_27: &[&[Loop]] = &[
    hexahedron!(0 8 24 11, 16 22 26 20),
    hexahedron!(8 1 9 24, 22 17 21 26),
    hexahedron!(24 9 2 10, 26 21 18 23),
    hexahedron!(11 24 10 3, 20 26 23 19),
    hexahedron!(16 22 26 20, 4 12 25 15),
    hexahedron!(22 17 21 26, 12 5 13 25),
    hexahedron!(26 21 18 23, 25 13 6 14),
    hexahedron!(20 26 23 19, 15 25 14 7),
];
const WEDGE_12: &[&[Loop]] =
    &[wedge!(0 6 8, 3 9 11), wedge!(6 1 7, 9 4 10), wedge!(8 7 2, 11 10 5), wedge!(6 7 8, 9 10 11)];
const WEDGE_18: &[&[Loop]] = &[
    wedge!(0 6 8, 12 15 17),
    wedge!(6 1 7, 15 13 16),
    wedge!(8 7 2, 17 16 14),
    wedge!(6 7 8, 15 16 17),
    wedge!(12 15 17, 3 9 11),
    wedge!(15 13 16, 9 4 10),
    wedge!(17 16 14, 11 10 5),
    wedge!(15 16 17, 9 10 11),
];
/// A hexahedron with nodes inside the four faces around its third direction: four
/// faces in four, and two cut at their mid nodes. All is joined to the least of
/// the four nodes; there is none inside.
const HEXAHEDRON_24: &[Loop] = &[
    &[0, 16, 20, 11],
    &[16, 4, 15, 20],
    &[20, 15, 7, 19],
    &[11, 20, 19, 3],
    &[1, 9, 21, 17],
    &[9, 2, 18, 21],
    &[21, 18, 6, 13],
    &[17, 21, 13, 5],
    &[0, 8, 22, 16],
    &[8, 1, 17, 22],
    &[22, 17, 5, 12],
    &[16, 22, 12, 4],
    &[3, 19, 23, 10],
    &[19, 7, 14, 23],
    &[23, 14, 6, 18],
    &[10, 23, 18, 2],
    &[8, 0, 11],
    &[11, 3, 10],
    &[10, 2, 9],
    &[9, 1, 8],
    &[11, 10, 9, 8],
    &[15, 4, 12],
    &[12, 5, 13],
    &[13, 6, 14],
    &[14, 7, 15],
    &[12, 13, 14, 15],
];
/// A hexahedron at each corner of the base, and a solid of eight faces at the apex.
const PYRAMID_19: &[&[Loop]] = &[
    hexahedron!(0 5 13 8, 9 14 18 17),
    hexahedron!(1 6 13 5, 10 15 18 14),
    hexahedron!(2 7 13 6, 11 16 18 15),
    hexahedron!(3 8 13 7, 12 17 18 16),
    &[
        &[4, 9, 14, 10],
        &[4, 10, 15, 11],
        &[4, 11, 16, 12],
        &[4, 12, 17, 9],
        &[18, 14, 9, 17],
        &[18, 15, 10, 14],
        &[18, 16, 11, 15],
        &[18, 17, 12, 16],
    ],
];
