//! Where the cubic of a cell may go, whatever its neighbours say.
//!
//! Neighbours move the coefficient amid a triangle no farther than its other nine differ by
//! ([`super::limit`]). So the cubic is bounded before a neighbour is asked, and in most cells no
//! neighbour need be asked for a level.
//!
//! The bounds hold to the last bit: the differences are of the same numbers, and sums round
//! alike upwards and downwards.
//!
//! Source: ours.

use super::hermite::{Known, joined};
use super::pci;
use crate::bernstein::{TetrahedronCubic, TriangleCubic};
use crate::field::Field;
use crate::mesh::{TetrahedronMesh, TriangleMesh, ascending_corners};

/// Between which numbers all coefficients of a triangle's cubic are, without a PDE; nothing if
/// they are not finite.
pub fn reach_on_triangle(mesh: &TriangleMesh, field: &Field, triangle: usize) -> Option<[f64; 2]> {
    of_triangle(&pci::quadratic_precision(mesh, field, triangle))
}

/// The same in a tetrahedron.
pub fn reach_in_tetrahedron(
    mesh: &TetrahedronMesh,
    field: &Field,
    tetrahedron: usize,
) -> Option<[f64; 2]> {
    let points = mesh.tetrahedra()[tetrahedron];
    let points = ascending_corners(&points).0.map(|corner| points[corner]);
    let known = Known::new(&points, mesh.points(), field);
    let [ab, ac, ad, bc, bd, cd] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]]
        .map(|[from, to]| known.range_on_edge(from, to));
    let edges = [[bc, cd, bd], [ac, cd, ad], [ab, bd, ad], [ab, bc, ac]];
    let [first, second, third, fourth] = [0, 1, 2, 3].map(|opposite| {
        let centre = known.amid(TetrahedronCubic::FACE_VERTICES[opposite]);
        let [one, two, three] = edges[opposite];
        widened(centre, joined(joined(one, two), three))
    });
    Some(joined(joined(first?, second?), joined(third?, fourth?)))
}

fn of_triangle(cubic: &TriangleCubic) -> Option<[f64; 2]> {
    let [a, ab, ac, ba, centre, ca, b, bc, cb, c] = cubic.coefficients;
    let others = [a, b, c, ab, ac, ba, ca, bc, cb].map(|other| [other, other]);
    widened(centre, others.into_iter().fold([a, a], joined))
}

/// The least and the greatest coefficient of a triangle, if the one amid it may move by what
/// the others, which have the given range, differ by.
fn widened(centre: f64, others: [f64; 2]) -> Option<[f64; 2]> {
    if !centre.is_finite() {
        // as it is if any of the others, of which it is a sum, is not
        return None;
    }
    let spread = others[1] - others[0];
    let spread = if spread.is_finite() { spread } else { 0.0 };
    // what is finite stays so
    let reach = [(centre - spread).max(f64::MIN), (centre + spread).min(f64::MAX)];
    Some(joined(others, reach))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The reach of a triangle with vertices, and coefficients beside them, of these values.
    fn reach(values: [f64; 3], centre: f64) -> Option<[f64; 2]> {
        of_triangle(&TriangleCubic::assemble(values, |from, _| values[from], centre))
    }

    #[test]
    fn reaches_by_hand() {
        assert_eq!(reach([1.0; 3], 1.0), Some([1.0, 1.0]));
        // the others differ by 3
        assert_eq!(reach([0.0, 3.0, 3.0], 2.0), Some([-1.0, 5.0]));
        assert_eq!(reach([0.0, 3.0, 3.0], 0.0), Some([-3.0, 3.0]));
    }

    #[test]
    fn reaches_at_the_end_of_numbers() {
        assert_eq!(reach([0.0, 1e308, 1e308], 1e308), Some([0.0, f64::MAX]));
        // a coefficient that differs too much for a number stays where it is
        assert_eq!(reach([-1e308, 1e308, 1e308], 0.0), Some([-1e308, 1e308]));
        for wrong in [f64::NAN, f64::INFINITY] {
            assert_eq!(reach([0.0; 3], wrong), None);
        }
    }
}
