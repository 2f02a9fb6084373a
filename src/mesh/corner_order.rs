//! The corners of a tetrahedron in the order of its points' numbers.

/// The corners of a tetrahedron in ascending order of their points, and whether that is an even
/// permutation. A point that is there twice comes in the order of corners.
pub(crate) fn ascending_corners(points: &[u32; 4]) -> ([usize; 4], bool) {
    let mut keys = [0, 1, 2, 3].map(|corner| u64::from(points[corner]) << 2 | corner as u64);
    let mut is_even = true;
    // a sorting network: no branches
    for [i, j] in [[0, 1], [2, 3], [0, 2], [1, 3], [1, 2]] {
        let (low, high) = (keys[i].min(keys[j]), keys[i].max(keys[j]));
        is_even ^= low != keys[i];
        (keys[i], keys[j]) = (low, high);
    }
    (keys.map(|key| (key & 3) as usize), is_even)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn corners_are_sorted(points in prop::array::uniform4(0..6_u32)) {
            let (order, is_even) = ascending_corners(&points);
            let sorted = order.map(|corner| (points[corner], corner));
            prop_assert!(sorted.windows(2).all(|pair| pair[0] < pair[1]));
            let pairs = (0..4).flat_map(|i| (0..i).map(move |j| [j, i]));
            let inversions = pairs.filter(|[j, i]| order[*j] > order[*i]).count();
            prop_assert_eq!(is_even, inversions % 2 == 0);
        }
    }
}
