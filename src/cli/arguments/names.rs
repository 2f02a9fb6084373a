//! Names that options take.

use clap::ValueEnum;
use vtu2contour::contour::lines::Method;
use vtu2contour::filter::{InterpolantKind, RefineMethod, SecondInterpolant};
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
            SecondInterpolantName::Pqi => Self::Pqi,
            SecondInterpolantName::Fqi => Self::Fqi,
            SecondInterpolantName::P3 => Self::P3,
            SecondInterpolantName::QuadraticPrecision => Self::QuadraticPrecision,
            SecondInterpolantName::Linear => Self::Linear,
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
