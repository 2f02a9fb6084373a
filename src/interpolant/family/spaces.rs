//! The table of all spaces.
//!
//! | space | each power | total degree | unknowns | given | collocated |
//! |---|---|---|---|---|---|
//! | [`PCI`] | 3 | 3 | 10 | 9 | 1 |
//! | [`DEI3_13`] | 3 | 4 | 13 | 9 | 4 |
//! | [`DEI3_15`] | 3 | 5 | 15 | 9 | 6 |
//! | [`DEI`] | 3 | 6 | 16 | 9 | 7 |
//! | [`DEI4_15`] | 4 | 4 | 15 | 9 | 6 |
//! | [`FQI`] | 4 | 8 | 25 | 9 | 16 |
//! | [`RECTANGLE`] | 3 | 6 | 16 | 12 | 4 |
//! | [`P3`] | 3 | 3 | 20 | 16 | 4 |
//! | [`P2`] | 2 | 6 | 27 | 16 | 11 |
//! | [`P2_HAT`] | 2 | 3 | 17 | 16 | 1 |
//!
//! The thesis leaves the collocation points of most of them open and draws them at
//! random. Here they are the same in every cell and do not depend on the order of its
//! corners. They were chosen, among orbits on a lattice, for a small norm of the inverse
//! of the system (its median, 90th and 99th percentile) over the triangles of a random
//! Delaunay mesh with the Laplacian: points near the corners and the middles of the sides
//! determine second derivatives best.

use super::shape::Shape::{Rectangle, Tetrahedron, Triangle};
use super::space::Space;

const CENTRE: [f64; 3] = [1.0 / 3.0; 3];
const NEAR_SIDES: [f64; 3] = [0.04, 0.48, 0.48];
const NEAR_CORNERS: [f64; 3] = [0.92, 0.04, 0.04];
const BETWEEN: [f64; 3] = [0.64, 0.18, 0.18];

/// The pure cubic (section 1.6), the one that the thesis chooses: continuous.
pub const PCI: Space<3, 10> = Space::new("PCI", Triangle, 3, 3, &[CENTRE]);

/// Bicubic of total degree four (section 1.7).
pub const DEI3_13: Space<3, 13> = Space::new("DEI3-13", Triangle, 3, 4, &[CENTRE, NEAR_SIDES]);

/// Bicubic of total degree five (section 1.7).
pub const DEI3_15: Space<3, 15> =
    Space::new("DEI3-15", Triangle, 3, 5, &[NEAR_SIDES, NEAR_CORNERS]);

/// The standard DEI: bicubic (section 1.5).
pub const DEI: Space<3, 16> = Space::new("DEI", Triangle, 3, 6, &[CENTRE, BETWEEN, NEAR_CORNERS]);

/// The pure quartic (section 1.7), which chapter 5 calls PQI.
pub const DEI4_15: Space<3, 15> =
    Space::new("DEI4-15", Triangle, 4, 4, &[NEAR_SIDES, NEAR_CORNERS]);

/// The full quartic: chapter 5 names it and defines it nowhere; our reading is the
/// tensor product.
pub const FQI: Space<3, 25> = Space::new(
    "FQI",
    Triangle,
    4,
    8,
    &[CENTRE, NEAR_SIDES, NEAR_CORNERS, [0.6, 0.2, 0.2], [0.7, 0.25, 0.05]],
);

/// The standard DEI on a rectangle (section 1.5): bicubic, and continuous, since a side
/// has a cubic and four data. Its points are those of Gauss.
pub const RECTANGLE: Space<4, 16> = Space::new("rectangle", Rectangle, 3, 6, &[GAUSS]);

/// Bilinear weights of the corners at a point of Gauss' rule of two by two.
const GAUSS: [f64; 4] = {
    let near = 0.788_675_134_594_812_9;
    let far = 1.0 - near;
    [near * near, near * far, far * far, near * far]
};

/// The pure tri-cubic (section 1.8): continuous on edges only.
pub const P3: Space<4, 20> = Space::new("p3", Tetrahedron, 3, 3, &[TOWARD_CORNERS]);

/// The triquadratic (section 1.8). On an edge along an axis it has three coefficients for
/// four data: cells with such an edge are singular.
pub const P2: Space<4, 27> =
    Space::new("p2", Tetrahedron, 2, 6, &[[0.25; 4], TOWARD_CORNERS, [0.45, 0.45, 0.05, 0.05]]);

/// The triquadratic of total degree three (section 1.8), singular in the same cells.
pub const P2_HAT: Space<4, 17> = Space::new("p̂2", Tetrahedron, 2, 3, &[[0.25; 4]]);

const TOWARD_CORNERS: [f64; 4] = [0.7, 0.1, 0.1, 0.1];
