//! Quadratic elements: nodes and shape functions on a reference cell.
//!
//! An element is its nodes and the terms that span its space. The slopes of its
//! shape functions at its nodes, which are all that is needed, follow from these by
//! a small matrix inverse, done once.

use std::sync::LazyLock;

use nalgebra::DMatrix;

use super::reference::{Place, Reference};
use super::term::Term;

/// The most nodes that an element has.
pub const MOST_NODES: usize = 27;

/// A quadratic element.
#[derive(Clone, Debug)]
pub struct Element {
    /// The cell on which it is defined.
    pub reference: Reference,
    /// Its nodes, in VTK's order.
    pub nodes: Vec<Place>,
    /// For each node, the derivatives of each shape function there, by the reference
    /// coordinates.
    slopes: Vec<[f64; 3]>,
}

impl Element {
    /// The element of VTK's type with a number of points; none for linear cells,
    /// and for those without shape functions of their own here.
    pub fn of(cell_type: u8, points: usize) -> Option<&'static Self> {
        let place = match (cell_type, points) {
            (22 | 69, 6) => 0,
            (34 | 69, 7) => 1,
            (30, 6) => 2,
            (23, 8) => 3,
            (28 | 70, 9) => 4,
            (24 | 71, 10) => 5,
            (31, 12) => 6,
            (26, 15) => 7,
            (32 | 73, 18) => 8,
            (25, 20) => 9,
            (33, 24) => 10,
            (29 | 72, 27) => 11,
            (27, 13) => 12,
            _ => return None,
        };
        ELEMENTS.get(place)
    }

    /// The derivatives of each shape function at a node.
    pub fn slopes(&self, node: usize) -> &[[f64; 3]] {
        &self.slopes[node * self.nodes.len()..(node + 1) * self.nodes.len()]
    }

    /// The element with the given nodes whose space is spanned by as many terms.
    fn new(reference: Reference, nodes: Vec<Place>, terms: &[Term]) -> Self {
        let count = nodes.len();
        let values = DMatrix::from_fn(count, count, |node, term| terms[term].value(nodes[node]));
        // the tests build every element: none of these matrices is singular
        let inverse = values.try_inverse().unwrap_or_else(|| DMatrix::zeros(count, count));
        let mut slopes = Vec::with_capacity(count * count);
        for &node in &nodes {
            let of_terms: Vec<[f64; 3]> = terms.iter().map(|term| term.derivatives(node)).collect();
            for shape in 0..count {
                slopes.push([0, 1, 2].map(|axis| {
                    (0..count).map(|term| of_terms[term][axis] * inverse[(term, shape)]).sum()
                }));
            }
        }
        Self { reference, nodes, slopes }
    }
}

/// The elements, in the order of [`Element::of`].
static ELEMENTS: LazyLock<[Element; 13]> = LazyLock::new(|| {
    use Reference::{Cube, Pyramid, Square, Tetrahedron, Triangle, Wedge};
    // exponents that are two count, those that are one do not
    let superlinear = |n: &[u8]| n.iter().filter(|&&n| n == 2).count() <= 1;
    let whole = |reference: Reference, means: usize, terms: Vec<Term>| {
        Element::new(reference, reference.nodes(0..means), &terms)
    };
    let mut with_bubble = powers(|[a, b, c]| a + b <= 2 && c == 0);
    with_bubble.push(Term::Bubble);
    let mut of_pyramid = powers(|[a, b, c]| a + b + c <= 2);
    of_pyramid.extend([[1, 1], [2, 1], [1, 2]].map(Term::OverHeight));
    // the square with two mid nodes, and hexahedra without nodes in two faces
    let two_mids = Square.nodes([0, 2].into_iter());
    let four_faces = Cube.nodes(0..16);
    [
        whole(Triangle, 3, powers(|[a, b, c]| a + b <= 2 && c == 0)),
        whole(Triangle, 4, with_bubble),
        Element::new(Square, two_mids, &powers(|[_, b, c]| b <= 1 && c == 0)),
        whole(Square, 4, powers(|[a, b, c]| superlinear(&[a, b]) && c == 0)),
        whole(Square, 5, powers(|[_, _, c]| c == 0)),
        whole(Tetrahedron, 6, powers(|[a, b, c]| a + b + c <= 2)),
        whole(Wedge, 6, powers(|[a, b, c]| a + b <= 2 && c <= 1)),
        whole(Wedge, 9, powers(|[a, b, c]| a + b + c.saturating_sub(1) <= 2 && a + b <= 2)),
        whole(Wedge, 12, powers(|[a, b, _]| a + b <= 2)),
        whole(Cube, 12, powers(|n| superlinear(&n))),
        Element::new(Cube, four_faces, &powers(|[a, b, _]| superlinear(&[a, b]))),
        whole(Cube, 19, powers(|_| true)),
        whole(Pyramid, 8, of_pyramid),
    ]
});

/// The products of powers up to two of each coordinate whose exponents are `wanted`.
fn powers(wanted: impl Fn([u8; 3]) -> bool) -> Vec<Term> {
    let exponents = (0..27).map(|n| [n % 3, n / 3 % 3, n / 9]);
    exponents.filter(|&exponents| wanted(exponents)).map(Term::Powers).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TYPES: [(u8, usize); 13] = [
        (22, 6),
        (34, 7),
        (30, 6),
        (23, 8),
        (28, 9),
        (24, 10),
        (31, 12),
        (26, 15),
        (32, 18),
        (25, 20),
        (33, 24),
        (29, 27),
        (27, 13),
    ];

    /// The slopes at all nodes of the values of `function` are its derivatives.
    fn reproduces(element: &Element, function: Term) -> bool {
        let values: Vec<f64> = element.nodes.iter().map(|&node| function.value(node)).collect();
        (0..element.nodes.len()).all(|node| {
            let exact = function.derivatives(element.nodes[node]);
            (0..3).all(|axis| {
                let slopes = element.slopes(node).iter().zip(&values);
                let found: f64 = slopes.map(|(slopes, value)| slopes[axis] * value).sum();
                (found - exact[axis]).abs() < 1e-12
            })
        })
    }

    #[test]
    fn elements_reproduce_their_quadratics() {
        for (cell_type, count) in TYPES {
            let element = Element::of(cell_type, count).unwrap();
            assert_eq!(element.nodes.len(), count);
            let flat = element.reference.dimension() == 2;
            for [a, b, c] in [0_u8, 1, 2]
                .map(|a| [0_u8, 1, 2].map(|b| [0_u8, 1, 2].map(|c| [a, b, c])))
                .concat()
                .concat()
            {
                // two have directions in which they are linear
                let linear = (cell_type == 30 && b > 1) || (cell_type == 31 && c > 1);
                if a + b + c <= 2 && !(flat && c > 0) && !linear {
                    assert!(
                        reproduces(element, Term::Powers([a, b, c])),
                        "{cell_type}: {a} {b} {c}"
                    );
                }
            }
        }
    }
}
