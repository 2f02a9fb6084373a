//! The point of a simplex that is nearest to a given one.

use std::array::from_fn;

use super::{TetrahedronFrame, TriangleFrame, Vector};

/// Barycentric coordinates of the point of a simplex (up to four corners) that is nearest
/// to `point`, none of them negative, and how far it is.
///
/// If the point's projection onto the simplex's own plane is not inside, the nearest
/// point is on a facet that the projection is beyond: the same question, one dimension
/// lower.
pub(super) fn closest_point<const CORNERS: usize>(
    corners: &[Vector; CORNERS],
    point: &Vector,
) -> ([f64; CORNERS], f64) {
    const { assert!(CORNERS <= 4) }
    let (at, distance) = closest(corners, point);
    (from_fn(|corner| at[corner]), distance)
}

/// The same for any number of corners up to four; the coordinates that are not needed are
/// zero.
fn closest(corners: &[Vector], point: &Vector) -> ([f64; 4], f64) {
    let projection = projection(corners, point);
    let beyond = |corner: usize| projection.is_none_or(|at| at[corner] < 0.0);
    if let Some(at) = projection
        && !(0..corners.len()).any(beyond)
    {
        return (at, distance(corners, &at, point));
    }
    let facets = (0..corners.len()).filter(|&corner| corners.len() > 1 && beyond(corner));
    let nearest = facets.map(|corner| closest_on_facet(corners, corner, point));
    nearest.min_by(|one, other| one.1.total_cmp(&other.1)).unwrap_or(([0.0; 4], f64::INFINITY))
}

/// The nearest point on the facet opposite a corner.
fn closest_on_facet(corners: &[Vector], opposite: usize, point: &Vector) -> ([f64; 4], f64) {
    let mut facet = [Vector::zeros(); 4];
    let facet = &mut facet[..corners.len() - 1];
    facet[..opposite].copy_from_slice(&corners[..opposite]);
    facet[opposite..].copy_from_slice(&corners[opposite + 1..]);
    let (mut at, distance) = closest(facet, point);
    at[opposite..].rotate_right(1);
    (at, distance)
}

/// Barycentric coordinates of the projection onto the simplex's line, plane or space;
/// none if it has no length, area or volume.
fn projection(corners: &[Vector], point: &Vector) -> Option<[f64; 4]> {
    match *corners {
        [_] => Some([1.0, 0.0, 0.0, 0.0]),
        [a, b] => {
            let along = (point - a).dot(&(b - a)) / (b - a).norm_squared();
            along.is_finite().then_some([1.0 - along, along, 0.0, 0.0])
        }
        [a, b, c] => {
            let frame = TriangleFrame::new([a, b, c]);
            let [i, j, k] = frame.barycentric(point);
            (!frame.is_degenerate()).then_some([i, j, k, 0.0])
        }
        [a, b, c, d] => {
            let frame = TetrahedronFrame::new([a, b, c, d]);
            (!frame.is_degenerate()).then(|| frame.barycentric(point))
        }
        _ => None,
    }
}

/// How far `point` is from the point of the simplex at `at`. Inside a tetrahedron it is
/// that point: zero, without rounding.
fn distance(corners: &[Vector], at: &[f64; 4], point: &Vector) -> f64 {
    if corners.len() == 4 {
        return 0.0;
    }
    corners.iter().zip(at).map(|(corner, weight)| (corner - point) * *weight).sum::<Vector>().norm()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vectors() -> impl Strategy<Value = Vector> {
        prop::array::uniform3(-2.0..2.0f64).prop_map(Vector::from)
    }

    /// No point of the simplex is nearer than the one found, and it is where it is said
    /// to be.
    fn check<const CORNERS: usize>(
        corners: [Vector; CORNERS],
        point: Vector,
        others: &[[f64; 4]],
    ) -> Result<(), TestCaseError> {
        let place = |at: &[f64]| corners.iter().zip(at).map(|(c, w)| c * *w).sum::<Vector>();
        let (at, distance) = closest_point(&corners, &point);
        prop_assert!(at.iter().all(|&weight| weight >= 0.0));
        prop_assert!((at.iter().sum::<f64>() - 1.0).abs() < 1e-9);
        prop_assert!(((place(&at) - point).norm() - distance).abs() < 1e-9);
        for other in others {
            let sum: f64 = other[..CORNERS].iter().sum();
            let other: Vec<f64> = other[..CORNERS].iter().map(|weight| weight / sum).collect();
            prop_assert!((place(&other) - point).norm() >= distance - 1e-9);
        }
        Ok(())
    }

    proptest! {
        #[test]
        fn nothing_is_nearer(
            corners in prop::array::uniform4(vectors()), point in vectors(),
            others in prop::collection::vec(prop::array::uniform4(0.001..1.0f64), 50),
        ) {
            check(corners, point, &others)?;
            check([corners[0], corners[1], corners[2]], point, &others)?;
            check([corners[0], corners[1]], point, &others)?;
        }

        /// Simplices without size are the union of their facets.
        #[test]
        fn flat_simplices_too(
            corners in prop::array::uniform3(vectors()), point in vectors(),
            weights in prop::array::uniform3(-1.0..1.0f64),
            others in prop::collection::vec(prop::array::uniform4(0.001..1.0f64), 50),
        ) {
            let [a, b, c] = corners;
            let flat = a + (b - a) * weights[0] + (c - a) * weights[1];
            check([a, b, c, flat], point, &others)?;
            check([a, b, a + (b - a) * weights[2]], point, &others)?;
            check([a, a, a], point, &others)?;
        }
    }

    #[test]
    fn corners_edges_and_faces_by_hand() {
        let corners = [Vector::zeros(), Vector::x(), Vector::y(), Vector::z()];
        let find = |x, y, z| closest_point(&corners, &Vector::new(x, y, z));
        assert_eq!(find(0.25, 0.25, 0.25), ([0.25; 4], 0.0));
        assert_eq!(find(-1.0, -1.0, -1.0), ([1.0, 0.0, 0.0, 0.0], 3f64.sqrt()));
        assert_eq!(find(0.5, -1.0, -1.0), ([0.5, 0.5, 0.0, 0.0], 2f64.sqrt()));
        assert_eq!(find(0.25, 0.5, -3.0), ([0.25, 0.25, 0.5, 0.0], 3.0));
    }
}
