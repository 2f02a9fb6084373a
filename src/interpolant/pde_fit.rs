//! Whether a PDE and the data speak of the same solution.
//!
//! Values and gradients alone determine second derivatives, roughly: those of the cubic
//! that reproduces quadratics. Where they say `L u` and the PDE says `g`, the quotient
//! `L u / g` is near one if the PDE is the solution's own; it is -1 everywhere if a sign
//! is wrong, and 1/2 if a factor 2 is. One triangle says little, least on a coarse
//! mesh; most of them together say much.

use rayon::prelude::*;

use super::TriangleCubics;
use crate::bernstein::{Barycentric, TriangleCubic};
use crate::mesh::TriangleFrame;
use crate::pde::Pde;

/// What both say in one triangle, at its centroid.
#[derive(Clone, Copy, Debug)]
struct Comparison {
    /// `L u` by the data.
    by_data: f64,
    /// `g`.
    by_pde: f64,
    /// How large the terms of `L u` are, all taken as positive.
    terms: f64,
}

impl Comparison {
    /// Compares a cubic that satisfies the PDE at its centroid, so that `L p = g` there,
    /// with the one that has the same edges and reproduces quadratics. Nothing if they
    /// are one: the PDE was not used.
    fn new(cubic: &TriangleCubic, frame: &TriangleFrame, operator: &[f64; 6]) -> Option<Self> {
        let free = cubic.with_quadratic_centre();
        let terms = terms(&free, frame, operator);
        let is_used = free.coefficients != cubic.coefficients;
        is_used.then(|| Self {
            by_data: terms.iter().sum(),
            by_pde: self::terms(cubic, frame, operator).iter().sum(),
            terms: terms.iter().map(|term| term.abs()).sum(),
        })
    }
}

/// The terms of `L p` at the centroid: `uxx, uyy, uzz, uxy, uxz, uyz` with their
/// coefficients.
fn terms(cubic: &TriangleCubic, frame: &TriangleFrame, operator: &[f64; 6]) -> [f64; 6] {
    let hessian = frame.hessian(&cubic.barycentric_hessian(&CENTROID));
    let places = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
    [0, 1, 2, 3, 4, 5].map(|n| operator[n] * hessian[places[n]])
}

/// How well a PDE fits values and gradients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PdeFit {
    /// Of the quotients `L u / g`: those that 30, 50 and 70 per cent are below. Nothing
    /// if `g` is zero, or next to it, nearly everywhere.
    quotients: Option<[f64; 3]>,
    /// The median of `|L u - g|`, relative to the size of the terms: one if they do
    /// not agree at all.
    defect: f64,
}

/// `g` counts as not zero above this part of the size of the terms.
const COUNTS: f64 = 0.1;

/// Quotients count if so many triangles have one.
const ENOUGH: f64 = 0.1;

/// The PDE does not fit if seven of ten quotients are below the first, or above the
/// second. Right PDEs keep well away from them even on meshes with five points a
/// wavelength; a wrong sign or factor 2 does not.
const QUOTIENTS: [f64; 2] = [0.65, 1.5];

/// Nor does it if the median defect is above this.
const DEFECT: f64 = 0.9;

/// So many triangles are looked at, evenly spread: quantiles do not need more.
const LOOKED_AT: usize = 20_000;

const CENTROID: Barycentric = [1.0 / 3.0; 3];

impl PdeFit {
    /// How well a PDE fits the data of the interpolant that was made of both.
    pub fn new(interpolant: &dyn TriangleCubics, pde: &Pde) -> Self {
        let triangles = interpolant.mesh().triangles().len();
        let step = triangles.div_ceil(LOOKED_AT).max(1);
        let looked_at: Vec<usize> = (0..triangles).step_by(step).collect();
        let found: Vec<Comparison> = looked_at
            .into_par_iter()
            .filter_map(|triangle| {
                let cubic = interpolant.cubic(triangle);
                let frame = interpolant.mesh().frame(triangle);
                Comparison::new(&cubic, &frame, &pde.operator(&frame.position(&CENTROID).into()))
            })
            .collect();
        Self::of(&found)
    }

    /// The fit from what was found in each triangle.
    fn of(triangles: &[Comparison]) -> Self {
        let size = |found: &Comparison| found.by_pde.abs() + found.terms;
        let found: Vec<&Comparison> =
            triangles.iter().filter(|f| size(f).is_finite() && size(f) > 0.0).collect();
        let defects = found.iter().map(|f| (f.by_data - f.by_pde).abs() / size(f));
        let defect = quantile(&mut defects.collect::<Vec<f64>>(), 0.5).unwrap_or(0.0);
        let counted = found.iter().filter(|f| f.by_pde.abs() > COUNTS * size(f));
        let mut quotients: Vec<f64> = counted.map(|f| f.by_data / f.by_pde).collect();
        let enough = quotients.len() as f64 > ENOUGH * found.len() as f64;
        let at = |part: f64| quantile(&mut quotients, part);
        let [low, middle, high] = [0.3, 0.5, 0.7].map(at);
        let quotients = low.zip(middle).zip(high).filter(|_| enough);
        Self { quotients: quotients.map(|((low, middle), high)| [low, middle, high]), defect }
    }

    /// Whether the PDE is hardly that of the data.
    pub fn is_poor(&self) -> bool {
        let [least, most] = QUOTIENTS;
        let off = self.quotients.is_some_and(|[low, _, high]| high < least || low > most);
        off || self.defect > DEFECT
    }

    /// The median of `L u / g`, with `L u` by the data; nothing if `g` is zero nearly
    /// everywhere.
    pub fn quotient(&self) -> Option<f64> {
        self.quotients.map(|[_, middle, _]| middle)
    }
}

/// The value that a part of the values is below.
fn quantile(values: &mut [f64], part: f64) -> Option<f64> {
    let place = ((values.len() as f64 * part) as usize).min(values.len().checked_sub(1)?);
    Some(*values.select_nth_unstable_by(place, f64::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fit(quotient: impl Fn(usize) -> f64, by_pde: f64) -> PdeFit {
        let triangle = |n: usize| {
            let by_data = quotient(n) * if by_pde == 0.0 { 1.0 } else { by_pde };
            Comparison { by_data, by_pde, terms: by_data.abs() }
        };
        PdeFit::of(&(0..100).map(triangle).collect::<Vec<_>>())
    }

    #[test]
    fn scattered_quotients_about_one_are_a_fit() {
        let scattered = fit(|n| if n < 25 { -2.0 } else { 0.5 + n as f64 / 100.0 }, 3.0);
        assert!(!scattered.is_poor());
        assert_eq!(scattered.quotient(), Some(1.0));
    }

    #[test]
    fn signs_and_factors_are_noticed() {
        for quotient in [-1.0, 0.1, 0.5, 2.0] {
            let wrong = fit(|n| quotient + (n % 10) as f64 / 100.0, 3.0);
            assert!(wrong.is_poor(), "{quotient}");
        }
        assert!(fit(|_| 1.0, 0.0).is_poor());
        assert!(!PdeFit::of(&[]).is_poor());
    }
}
