//! What hangs together.

use std::collections::HashMap;
use std::hash::Hash;

/// The component of each of `count` things, named by one of its members. Two things are of
/// one component if a path of common joints leads from one to the other; `joints` are those
/// of a thing.
pub fn components<Joint: Eq + Hash, Joints: IntoIterator<Item = Joint>>(
    count: usize,
    joints: impl Fn(usize) -> Joints,
) -> Vec<usize> {
    let mut parents: Vec<usize> = (0..count).collect();
    let mut first_at = HashMap::new();
    for number in 0..count {
        for joint in joints(number) {
            let other = *first_at.entry(joint).or_insert(number);
            let (one, two) = (root(&mut parents, other), root(&mut parents, number));
            parents[one.max(two)] = one.min(two);
        }
    }
    (0..count).map(|number| root(&mut parents, number)).collect()
}

/// The thing that names a component; the way to it is halved for the next search.
fn root(parents: &mut [usize], mut number: usize) -> usize {
    while parents[number] != number {
        parents[number] = parents[parents[number]];
        number = parents[number];
    }
    number
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chains_by_hand() {
        let edges = [[0, 1], [4, 5], [2, 3], [1, 2], [5, 6]];
        assert_eq!(components(edges.len(), |n| edges[n]), [0, 1, 0, 0, 1]);
    }
}
