//! Simple cells: their surface is one patch, and nothing else of them is near the level.
//!
//! On a fine mesh nearly all active cells are. With two points a side, or where a tolerance asks for
//! no more, a patch is the polygon of the crossings of its cell's edges: it is drawn from these,
//! without pieces and rays ([`super::polygons`]). Names and places of points are those that
//! [`super::patch`] finds, so that both kinds of cells fit together.

use std::sync::LazyLock;

use arrayvec::ArrayVec;
use rayon::prelude::*;

use super::contour_surface::SurfacePoint;
use super::division::Marks;
use super::handedness::{is_sliver, signed_volume};
use super::tessellation::corner_edges;
use crate::bernstein::{PatchCertificate, SegmentCubic, Sign, TetrahedronCubic};
use crate::contour::crossings::crossings;
use crate::contour::holds;
use crate::contour::rounding::{self, LevelBand};
use crate::interpolant::TetrahedronCubics;
use crate::interruption::checkpoint;
use crate::mesh::{TetrahedronFrame, Vector, ascending_corners};

/// A cell with one patch.
#[derive(Clone, Copy, Debug)]
pub struct SimpleCell {
    /// The cell's number.
    pub number: u32,
    /// The numbers of its corners, ascending.
    pub points: [u32; 4],
    /// The places of its corners in the mesh's own order.
    order: [u8; 4],
    /// The sides of the corners, ascending.
    signs: [Sign; 4],
    /// Whether the corners, ascending, are those of a right-handed tetrahedron.
    right_handed: bool,
}

/// The simple ones of the cells that are active at a level.
#[derive(Debug, Default)]
pub struct SimpleCells(Vec<SimpleCell>);

/// The cells that are active at a level.
pub struct Sorted {
    /// The simple ones.
    pub simple: SimpleCells,
    /// The numbers of the others.
    pub others: Vec<u32>,
    /// The numbers of all active cells that share points with the others, these included.
    pub around: Vec<u32>,
}

impl Sorted {
    /// No cells are taken to be simple.
    pub fn without_simple(active: Vec<u32>) -> Self {
        Self { simple: SimpleCells::default(), around: active.clone(), others: active }
    }

    /// Those of some cells that are active. With a tolerance only such cells are simple in which no
    /// triangle between crossings of edges is farther than that from the surface.
    pub fn new(
        interpolant: &dyn TetrahedronCubics,
        band: LevelBand,
        cells: &[u32],
        tolerance: Option<f64>,
    ) -> Self {
        let judge = |&number: &u32| {
            checkpoint();
            judge(interpolant, band, number, tolerance)
        };
        let judged: Vec<Judged> = cells.par_iter().map(judge).collect();
        let numbers = |wanted: &dyn Fn(&Judged) -> bool| -> Vec<u32> {
            let pairs = cells.iter().zip(&judged).filter(|(_, judged)| wanted(judged));
            pairs.map(|(&number, _)| number).collect()
        };
        // slivers turn as the cells around them do
        let slivers = numbers(&|judged| matches!(judged, Judged::Sliver));
        let beside_slivers = around(interpolant, &slivers, cells);
        let mut beside_slivers = beside_slivers.iter().peekable();
        let (mut simple, mut others) = (Vec::with_capacity(cells.len()), Vec::new());
        for (&number, judged) in cells.iter().zip(&judged) {
            let is_beside = beside_slivers.next_if(|beside| **beside == number).is_some();
            match judged {
                Judged::Inactive => {}
                Judged::Simple(cell) if !is_beside => simple.push(*cell),
                _ => others.push(number),
            }
        }
        let around = if others.is_empty() {
            Vec::new()
        } else {
            let active = numbers(&|judged| !matches!(judged, Judged::Inactive));
            around(interpolant, &others, &active)
        };
        Self { simple: SimpleCells(simple), others, around }
    }
}

impl SimpleCells {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Takes out the cells of which an edge is marked, to be divided with their neighbours.
    /// `points` is the number of the mesh's points.
    pub fn take_marked(&mut self, marks: &Marks, points: u32) -> Vec<u32> {
        let mut at_marks = vec![false; points as usize];
        for [low, high] in marks.edges().filter(|[_, high]| *high < points) {
            at_marks[low as usize] = true;
            at_marks[high as usize] = true;
        }
        let mut taken = Vec::new();
        self.0.retain(|cell| {
            let has_two = cell.points.iter().filter(|&&point| at_marks[point as usize]).count() > 1;
            let is_marked = has_two && marks.touch_edges_of(&cell.points);
            if is_marked {
                taken.push(cell.number);
            }
            !is_marked
        });
        taken
    }

    /// The cells.
    pub fn cells(&self) -> &[SimpleCell] {
        &self.0
    }
}

/// What a cell is.
enum Judged {
    Inactive,
    Simple(SimpleCell),
    Sliver,
    Other,
}

fn judge(
    interpolant: &dyn TetrahedronCubics,
    band: LevelBand,
    number: u32,
    tolerance: Option<f64>,
) -> Judged {
    let mesh = interpolant.mesh();
    let corners = mesh.corners(number as usize);
    let cubic = interpolant.cubic(number as usize);
    let bounds = cubic.bounds().into();
    let level = band.level;
    let may_hold = |range: [f64; 2]| holds(range, level, |range| band.of_range(range));
    // closer bounds matter only where the level is not between vertices
    let [a, b, c, d] = cubic.vertices().map(|value| value < level);
    let is_between = (a | b | c | d) & !(a & b & c & d);
    let is_active = may_hold(bounds) && (is_between || may_hold(cubic.value_bounds()));
    if !is_active {
        return Judged::Inactive;
    }
    if is_sliver(&corners) {
        return Judged::Sliver;
    }
    let above_level = TetrahedronCubic::new(cubic.coefficients.map(|c| c - level));
    let is_clear =
        |values: &[f64], near: f64| values.iter().fold(true, |all, v| all & (v.abs() > near));
    let is_clear = is_clear(&above_level.coefficients, rounding::of_coefficients(bounds, level))
        && is_clear(&above_level.vertices(), band.of_range(bounds));
    let signs = above_level.vertices().map(Sign::of);
    if !is_clear || above_level.patch_certificate(signs) != PatchCertificate::Patch {
        return Judged::Other;
    }
    if tolerance.is_some_and(|tolerance| !is_flat(&above_level, corners, tolerance)) {
        return Judged::Other;
    }
    let points = mesh.tetrahedra()[number as usize];
    let (order, is_even) = ascending_corners(&points);
    Judged::Simple(SimpleCell {
        number,
        points: order.map(|place| points[place]),
        order: order.map(|place| place as u8),
        signs: order.map(|place| signs[place]),
        right_handed: (signed_volume(&corners) > 0.0) == is_even,
    })
}

/// The active cells that have a point of some cells, these themselves included.
fn around(interpolant: &dyn TetrahedronCubics, cells: &[u32], active: &[u32]) -> Vec<u32> {
    if cells.is_empty() {
        return Vec::new();
    }
    let mesh = interpolant.mesh();
    let mut is_point_of_one = vec![false; mesh.points().len()];
    for point in cells.iter().flat_map(|&cell| mesh.tetrahedra()[cell as usize]) {
        is_point_of_one[point as usize] = true;
    }
    let has_one = |cell: &u32| {
        mesh.tetrahedra()[*cell as usize].iter().any(|&point| is_point_of_one[point as usize])
    };
    active.par_iter().copied().filter(has_one).collect()
}

/// Whether triangles between zeros of a cubic on the edges of its tetrahedron are no farther from
/// the cubic's level set than the tolerance, all of them all over: certain if it says so.
///
/// The cubic and the linear function of its vertex values differ by no more than their
/// coefficients do, `d`. So the linear one is within `d` of zero at the triangle's corners and, being
/// linear, between them. Some way along its slope it is beyond zero by its change less `d`; there the
/// cubic differs from it by `d` times the third power of the sum of the absolute barycentric
/// coordinates, which may be outside the cell. If the change is more than all that, the cubic
/// changes its sign on the way.
fn is_flat(cubic: &TetrahedronCubic, corners: [Vector; 4], tolerance: f64) -> bool {
    let frame = TetrahedronFrame::new(corners);
    let linear = TetrahedronCubic::linear(cubic.vertices());
    let pairs = cubic.coefficients.iter().zip(linear.coefficients);
    let difference = pairs.fold(0.0, |most: f64, (c, l)| most.max((c - l).abs()));
    let slope = frame.gradient(&cubic.vertices());
    let steps = frame.barycentric_direction(&slope);
    let (slope, step) = (slope.norm(), steps.iter().map(|step| step.abs()).sum::<f64>());
    // a shorter way may do where the whole leads far outside
    [1.0, 0.5, 0.25].iter().any(|part| {
        let way = tolerance * part;
        // what the coordinates lose outside, others have too much
        let outside = 1.0 + way * step / slope;
        slope * way > difference * (1.0 + outside.powi(3))
    })
}

impl SimpleCell {
    /// The edges around its patch, by their ends' places among its corners.
    pub fn edges(&self) -> &'static [[u8; 2]] {
        let above = (0..4).filter(|&n| self.signs[n] == Sign::Above);
        let situation = above.fold(usize::from(self.right_handed), |bits, n| bits | 2 << n);
        &POLYGONS[situation]
    }

    /// Where the surface crosses an edge.
    pub fn crossing(
        &self,
        interpolant: &dyn TetrahedronCubics,
        level: f64,
        edge: [u8; 2],
    ) -> SurfacePoint {
        let edge = edge.map(usize::from);
        let [from, to] = edge.map(|n| usize::from(self.order[n]));
        let line = interpolant.edge(self.number as usize, [from, to]);
        let line = SegmentCubic::new(line.coefficients.map(|c| c - level));
        let [start, end] = edge.map(|n| self.signs[n]);
        let t = crossings(&line, start, end).first().copied().unwrap_or(0.5);
        let mut at = [0.0; 4];
        (at[from], at[to]) = (1.0 - t, t);
        let corners = interpolant.mesh().corners(self.number as usize);
        let position = corners[from] * (1.0 - t) + corners[to] * t;
        SurfacePoint { position, cell: self.number, at }
    }
}

/// The edges around each patch, by the situation of its cell: the bits of the corners above the
/// level, and whether it is right-handed.
static POLYGONS: LazyLock<[ArrayVec<[u8; 2], 4>; 32]> = LazyLock::new(|| {
    std::array::from_fn(|situation| {
        let side = |n: usize| if situation & 2 << n == 0 { Sign::Below } else { Sign::Above };
        let edges = corner_edges([0, 1, 2, 3].map(side), situation & 1 == 1);
        edges.into_iter().map(|[n, m]| [n.min(m) as u8, n.max(m) as u8]).collect()
    })
});
