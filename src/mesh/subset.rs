//! Some of the simplices of a mesh.

use rayon::prelude::*;

use super::simplex_mesh::SimplexMesh;

/// Some of the simplices of a mesh, in ascending order: which they are, and the place of each
/// among them. A bit and a half for each simplex of the mesh are kept.
#[derive(Clone, Debug, Default)]
pub struct Subset {
    /// One bit a simplex: whether it is one of them.
    words: Vec<u64>,
    /// How many come before each word.
    before: Vec<u32>,
    count: usize,
    simplex_count: usize,
}

/// Simplices whose bits stand in one word.
const WORD: usize = u64::BITS as usize;

impl Subset {
    /// Those of so many simplices that `belongs` names.
    pub fn new(simplices: usize, belongs: impl Fn(usize) -> bool + Sync) -> Self {
        Self::of_words(simplices, |number| {
            let first = number * WORD;
            let bits = (first..simplices.min(first + WORD)).filter(|&simplex| belongs(simplex));
            bits.fold(0_u64, |word, simplex| word | 1 << (simplex % WORD))
        })
    }

    /// Those of so many simplices that words of bits name: `word` gives those of each 64 that follow
    /// each other, the first in the lowest bit.
    pub fn of_words(simplices: usize, word: impl Fn(usize) -> u64 + Sync) -> Self {
        let words: Vec<u64> = (0..simplices.div_ceil(WORD)).into_par_iter().map(&word).collect();
        let mut count = 0;
        let counted = words.iter().map(|word| {
            let before = count;
            count += word.count_ones();
            before
        });
        let before = counted.collect();
        Self { words, before, count: count as usize, simplex_count: simplices }
    }

    /// Those of so many simplices that have the given numbers.
    pub fn of_numbers(simplices: usize, numbers: impl Iterator<Item = usize>) -> Self {
        let mut words = vec![0; simplices.div_ceil(WORD)];
        numbers.for_each(|number| words[number / WORD] |= 1 << (number % WORD));
        Self::of_words(simplices, |number| words[number])
    }

    /// None of so many simplices.
    pub fn none(simplices: usize) -> Self {
        Self::of_words(simplices, |_| 0)
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Whether a simplex is one of them.
    pub fn contains(&self, simplex: usize) -> bool {
        self.words[simplex / WORD] >> (simplex % WORD) & 1 == 1
    }

    /// The place of a simplex among them, if it is one.
    pub fn place(&self, simplex: usize) -> Option<usize> {
        let (word, bit) = (self.words[simplex / WORD], simplex % WORD);
        let lower = word & ((1 << bit) - 1);
        let place = self.before[simplex / WORD] + lower.count_ones();
        (word >> bit & 1 == 1).then_some(place as usize)
    }

    /// How many simplices the mesh has.
    pub fn simplex_count(&self) -> usize {
        self.simplex_count
    }

    /// Their numbers, ascending.
    pub fn simplices(&self) -> impl Iterator<Item = usize> + '_ {
        self.words.iter().enumerate().flat_map(|(number, &word)| {
            let mut rest = word;
            std::iter::from_fn(move || {
                let bit = rest.trailing_zeros() as usize;
                let found = (rest != 0).then_some(number * WORD + bit);
                rest &= rest.wrapping_sub(1);
                found
            })
        })
    }

    /// These, and all that share a side with one of them: all points but one.
    pub fn with_neighbours<const CORNERS: usize>(&self, mesh: &SimplexMesh<CORNERS>) -> Self {
        self.with_sharing(mesh, CORNERS - 1)
    }

    /// These, and all that have at least so many corners at points of these.
    pub fn with_sharing<const CORNERS: usize>(
        &self,
        mesh: &SimplexMesh<CORNERS>,
        corners: usize,
    ) -> Self {
        if self.is_empty() {
            return self.clone();
        }
        let simplices = mesh.simplices();
        let mut near = vec![0_u64; mesh.points().len().div_ceil(WORD)];
        for point in self.simplices().flat_map(|simplex| simplices[simplex]) {
            near[point as usize / WORD] |= 1 << (point as usize % WORD);
        }
        let is_near = |point: u32| near[point as usize / WORD] >> (point as usize % WORD) & 1;
        Self::new(simplices.len(), |simplex| {
            simplices[simplex].map(is_near).into_iter().sum::<u64>() >= corners as u64
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::{TriangleMesh, Vector};
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn places_are_those_in_the_list(bits in prop::collection::vec(any::<bool>(), 0..300)) {
            let subset = Subset::new(bits.len(), |simplex| bits[simplex]);
            let listed: Vec<usize> = (0..bits.len()).filter(|&simplex| bits[simplex]).collect();
            prop_assert_eq!(subset.simplices().collect::<Vec<_>>(), listed.clone());
            prop_assert_eq!((subset.len(), subset.is_empty()), (listed.len(), listed.is_empty()));
            for (simplex, &belongs) in bits.iter().enumerate() {
                prop_assert_eq!(subset.contains(simplex), belongs);
                let place = listed.iter().position(|&other| other == simplex);
                prop_assert_eq!(subset.place(simplex), place);
            }
            let again = Subset::of_numbers(bits.len(), listed.iter().copied());
            prop_assert_eq!(again.simplices().collect::<Vec<_>>(), listed);
        }
    }

    #[test]
    fn neighbours_of_a_strip_by_hand() {
        let triangles = (0..6).map(|n| [n, n + 1, n + 2]).collect();
        let mesh = TriangleMesh::new(vec![Vector::zeros(); 8], triangles).unwrap();
        let third = Subset::new(6, |triangle| triangle == 2);
        let ring = third.with_neighbours(&mesh);
        assert_eq!(ring.simplices().collect::<Vec<_>>(), [1, 2, 3]);
        let two_rings = ring.with_neighbours(&mesh);
        assert_eq!(two_rings.simplices().collect::<Vec<_>>(), [0, 1, 2, 3, 4]);
        let last = Subset::new(6, |triangle| triangle == 5);
        let touching = last.with_sharing(&mesh, 1);
        assert_eq!(touching.simplices().collect::<Vec<_>>(), [3, 4, 5]);
    }
}
