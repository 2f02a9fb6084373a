//! Stage three: the curve between two crossings (thesis, section 2.3.3).
//!
//! Four methods. *Intercept* finds points of the arc until they are close enough
//! and joins them by straight lines. The others draw cubic Hermite pieces between
//! points of the arc, written as Bézier curves: *SODE* takes one coordinate as a
//! function of the other, *ODEA* takes both as functions of arc length, and
//! *AODEA* adds points until the pieces are short, or close, enough.
//!
//! Hermite pieces are near the contour, not on it. They serve where curves can be
//! drawn (SVG). Where points are wanted they are only guesses: each is moved onto
//! the contour ([`Arc::land`]), so that every point of the output lies on its
//! level, whatever the method.

use super::arc::{Arc, Node};
use super::curve::{Drawing, MAX_DEPTH, Resolution};
use super::{hermite, intercept};

/// How the curve between two crossings is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Points on the contour, joined by straight lines.
    Intercept,
    /// Hermite pieces `y(x)` or `x(y)`.
    Sode,
    /// Hermite pieces by arc length.
    Odea,
    /// Hermite pieces by arc length, as many as the resolution asks for.
    #[default]
    Aodea,
}

/// Draws the arc between two of its points into `drawing`.
pub fn draw(
    arc: &Arc,
    [a, b]: [&Node; 2],
    method: Method,
    resolution: &Resolution,
    drawing: &mut Drawing,
) {
    match method {
        Method::Intercept => intercept::intercept(arc, a, b, resolution, drawing),
        Method::Sode => hermite::sode(arc, a, b, resolution, drawing),
        Method::Odea => hermite::odea(arc, a, b, resolution, drawing),
        Method::Aodea => hermite::aodea(arc, a, b, resolution, MAX_DEPTH, drawing),
    }
}
