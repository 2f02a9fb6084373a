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

use super::hermite::Known;
use super::pci;
use crate::bernstein::{TetrahedronCubic, TriangleCubic, joined, value_bounds};
use crate::field::Field;
use crate::mesh::{TetrahedronMesh, TriangleMesh, ascending_corners};

/// Between which numbers the values of a triangle's cubic are, without a PDE; nothing if one of
/// what they come of is not finite.
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
        moved(centre, joined(joined(one, two), three))
    });
    let amid_faces = joined_four([first?, second?, third?, fourth?]);
    let on_edges = joined(joined(joined(ab, ac), joined(ad, bc)), joined(bd, cd));
    Some(value_bounds(on_edges, amid_faces, TetrahedronCubic::SHARE_OF_FACES))
}

/// The range of what is in four ranges.
fn joined_four([a, b, c, d]: [[f64; 2]; 4]) -> [f64; 2] {
    joined(joined(a, b), joined(c, d))
}

fn of_triangle(cubic: &TriangleCubic) -> Option<[f64; 2]> {
    let [a, ab, ac, ba, centre, ca, b, bc, cb, c] = cubic.coefficients;
    let others = [a, b, c, ab, ac, ba, ca, bc, cb].map(|other| [other, other]);
    let others = others.into_iter().fold([a, a], joined);
    Some(value_bounds(others, moved(centre, others)?, TriangleCubic::SHARE_OF_CENTRE))
}

/// Where neighbours may move the coefficient amid a triangle: no farther than the others, which
/// have the given range, differ by.
fn moved(centre: f64, others: [f64; 2]) -> Option<[f64; 2]> {
    if !centre.is_finite() {
        // as it is if any of the others, of which it is a sum, is not
        return None;
    }
    let spread = others[1] - others[0];
    let spread = if spread.is_finite() { spread } else { 0.0 };
    // what is finite stays so
    Some([(centre - spread).max(f64::MIN), (centre + spread).min(f64::MAX)])
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
        // the others differ by 3, so that the coefficient is up to 5, and counts for 2/9
        let near = |found: Option<[f64; 2]>, [low, high]: [f64; 2]| {
            let [least, greatest] = found.unwrap();
            (low - 1e-3..=low).contains(&least) && (high..high + 1e-3).contains(&greatest)
        };
        assert!(near(reach([0.0, 3.0, 3.0], 2.0), [-2.0 / 9.0, 3.0 + 4.0 / 9.0]));
        assert!(near(reach([0.0, 3.0, 3.0], 0.0), [-2.0 / 3.0, 3.0]));
    }

    #[test]
    fn reaches_at_the_end_of_numbers() {
        let [low, high] = reach([0.0, 1e308, 1e308], 1e308).unwrap();
        assert!(low == 0.0 && 1.1e308 < high && high < 1.2e308);
        // a coefficient that differs too much for a number stays where it is
        assert_eq!(reach([-1e308, 1e308, 1e308], 0.0), Some([-1e308, 1e308]));
        for wrong in [f64::NAN, f64::INFINITY] {
            assert_eq!(reach([0.0; 3], wrong), None);
        }
    }
}
