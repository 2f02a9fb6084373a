//! The regular points of a triangle, and the small triangles between them.

/// The points of a lattice with so many sides along each edge, row by row from the first
/// corner: for each the weights of the corners, whole numbers with the sum `sides`.
pub fn points(sides: u32) -> impl Iterator<Item = [u32; 3]> {
    (0..=sides).flat_map(move |row| (0..=row).map(move |place| [sides - row, row - place, place]))
}

/// The small triangles, turned as the large one; `first` is the number of the first point.
pub fn triangles(sides: u32, first: u32) -> impl Iterator<Item = [u32; 3]> {
    let at = move |row: u32, place: u32| first + row * (row + 1) / 2 + place;
    (0..sides).flat_map(move |row| {
        (0..=row).flat_map(move |place| {
            let (left, right) = (at(row + 1, place), at(row + 1, place + 1));
            let upright = [at(row, place), left, right];
            let hanging = (place < row).then(|| [at(row, place), right, at(row, place + 1)]);
            [upright].into_iter().chain(hanging)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_sides_by_hand() {
        let weights: Vec<[u32; 3]> = points(2).collect();
        assert_eq!(weights, [[2, 0, 0], [1, 1, 0], [1, 0, 1], [0, 2, 0], [0, 1, 1], [0, 0, 2]]);
        let small: Vec<[u32; 3]> = triangles(2, 7).collect();
        assert_eq!(small, [[7, 8, 9], [8, 10, 11], [8, 11, 9], [9, 11, 12]]);
    }
}
