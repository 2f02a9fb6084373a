//! Names that options take.

use clap::ValueEnum;
use vtu2contour::contour::lines::Method;
use vtu2contour::filter::{FamilyMember, InterpolantKind, RefineMethod, SecondInterpolant};
use vtu2contour::interpolant::Predictor;
use vtu2contour::refine::{Smoothing, TriangleMethod};
use vtu2contour::vtk::Encoding;

/// Names of the interpolants.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Interpolant {
    /// The pure cubic interpolant: one cubic a cell, from values, gradients and the PDE, or
    /// without one from the neighbours; of fourth order
    Pci,
    /// Without PDE and neighbours: exact for quadratics, of third order
    QuadraticPrecision,
    /// Linear, as VTK's own filter
    Linear,
}

/// Names of the members of the thesis' family.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum FamilyMemberName {
    /// The standard DEI: bicubic, --pde holds at seven points of a triangle; of a quad that is a
    /// rectangle at four
    Dei,
    /// The same on triangles, with points searched in each
    Adei,
    /// Bicubic of total degree four on triangles: --pde holds at four points
    #[value(name = "dei3-13")]
    Dei3_13,
    /// Bicubic of total degree five on triangles: --pde holds at six points
    #[value(name = "dei3-15")]
    Dei3_15,
    /// The pure quartic on triangles: --pde holds at six points
    Pqi,
    /// The full quartic on triangles: --pde holds at sixteen points
    Fqi,
    /// The pure tri-cubic of each tetrahedron by itself: --pde holds at four points
    P3,
    /// The triquadratic in tetrahedra: --pde holds at eleven points
    P2,
    /// The triquadratic of total degree three in tetrahedra: --pde holds at the centre
    P2Hat,
}

/// Names of the predictors.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum PredictorName {
    /// From the cubic that reproduces quadratics
    Quadratic,
    /// From the linear interpolant, as in the thesis
    Linear,
}

/// Names of the methods.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum MethodName {
    /// Points on the contour, joined by straight lines
    Intercept,
    /// Curves y(x) or x(y)
    Sode,
    /// Curves by arc length
    Odea,
    /// Curves by arc length, as many as the tolerance asks for
    Aodea,
}

/// Names of the encodings.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum EncodingName {
    /// Bytes, appended
    Raw,
    /// Compressed by zlib, appended
    Zlib,
    /// Compressed by LZ4, appended
    Lz4,
    /// Compressed by LZMA, appended: slow, and the smallest
    Lzma,
    /// Base64 inside the XML
    Base64,
    /// Numbers as text
    Ascii,
}

/// Names of the ways to refine triangles.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum RefineMethodName {
    /// Longest-edge bisection: no angle falls below half of the smallest
    Bisect,
    /// Newest-vertex bisection: few shapes of triangles
    NewestVertex,
    /// Division in four, and in two for the time being where that has to fit
    RedGreen,
    /// A point in the middle of each: angles become ever smaller
    Centroid,
    /// The thesis' hybrid in a Delaunay triangulation: circumcenters, edges, middles
    Delaunay,
}

/// Names of the monitors.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum MonitorName {
    /// How far the cubics are from satisfying --pde, integrated over the cell
    Defect,
    /// The area of the cubics' graph over the cell: it follows slopes, not errors
    Area,
    /// What would change if each edge were halved: the mean difference to the cubics on that
    /// mesh, whose new points have the cubics' values and gradients
    Stepwise,
    /// The mean difference to a second interpolant of the same data: --second
    Interpolation,
}

/// Names of what the interpolant is compared with.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum SecondInterpolantName {
    /// The pure quartic of each triangle: --pde holds at six points
    Pqi,
    /// The full quartic of each triangle: --pde holds at sixteen points
    Fqi,
    /// The pure tri-cubic of each tetrahedron by itself: --pde holds at four points
    P3,
    /// The cubic of each cell by itself, which reproduces quadratics: needs no --pde
    QuadraticPrecision,
    /// The linear interpolant: needs no --pde
    Linear,
}

/// Names of the ways to move points.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum SmoothingName {
    /// Towards the mean of the neighbours
    Laplacian,
    /// Towards where the worst triangle would be equilateral
    Optimised,
}

impl From<SecondInterpolantName> for SecondInterpolant {
    fn from(name: SecondInterpolantName) -> Self {
        match name {
            SecondInterpolantName::Pqi => Self::Member(FamilyMember::Pqi),
            SecondInterpolantName::Fqi => Self::Member(FamilyMember::Fqi),
            SecondInterpolantName::P3 => Self::Member(FamilyMember::P3),
            SecondInterpolantName::QuadraticPrecision => Self::QuadraticPrecision,
            SecondInterpolantName::Linear => Self::Linear,
        }
    }
}

impl From<FamilyMemberName> for FamilyMember {
    fn from(name: FamilyMemberName) -> Self {
        match name {
            FamilyMemberName::Dei => Self::Dei,
            FamilyMemberName::Adei => Self::Adei,
            FamilyMemberName::Dei3_13 => Self::Dei3_13,
            FamilyMemberName::Dei3_15 => Self::Dei3_15,
            FamilyMemberName::Pqi => Self::Pqi,
            FamilyMemberName::Fqi => Self::Fqi,
            FamilyMemberName::P3 => Self::P3,
            FamilyMemberName::P2 => Self::P2,
            FamilyMemberName::P2Hat => Self::P2Hat,
        }
    }
}

impl From<SmoothingName> for Smoothing {
    fn from(name: SmoothingName) -> Self {
        match name {
            SmoothingName::Laplacian => Self::Laplacian,
            SmoothingName::Optimised => Self::Optimised,
        }
    }
}

impl From<RefineMethodName> for RefineMethod {
    fn from(name: RefineMethodName) -> Self {
        match name {
            RefineMethodName::Bisect => Self::Divide(TriangleMethod::LongestEdge),
            RefineMethodName::NewestVertex => Self::Divide(TriangleMethod::NewestVertex),
            RefineMethodName::RedGreen => Self::Divide(TriangleMethod::RedGreen),
            RefineMethodName::Centroid => Self::Divide(TriangleMethod::Centroid),
            RefineMethodName::Delaunay => Self::Delaunay,
        }
    }
}

impl From<Interpolant> for InterpolantKind {
    fn from(name: Interpolant) -> Self {
        match name {
            Interpolant::Pci => Self::Pci,
            Interpolant::QuadraticPrecision => Self::QuadraticPrecision,
            Interpolant::Linear => Self::Linear,
        }
    }
}

impl From<PredictorName> for Predictor {
    fn from(name: PredictorName) -> Self {
        match name {
            PredictorName::Quadratic => Self::Quadratic,
            PredictorName::Linear => Self::Linear,
        }
    }
}

impl From<MethodName> for Method {
    fn from(name: MethodName) -> Self {
        match name {
            MethodName::Intercept => Self::Intercept,
            MethodName::Sode => Self::Sode,
            MethodName::Odea => Self::Odea,
            MethodName::Aodea => Self::Aodea,
        }
    }
}

impl From<EncodingName> for Encoding {
    fn from(name: EncodingName) -> Self {
        match name {
            EncodingName::Raw => Self::Raw,
            EncodingName::Zlib => Self::Zlib,
            EncodingName::Lz4 => Self::Lz4,
            EncodingName::Lzma => Self::Lzma,
            EncodingName::Base64 => Self::Base64,
            EncodingName::Ascii => Self::Ascii,
        }
    }
}
