//! VTK's cell types: names and dimensions.

/// The dimension of a cell type, or nothing for a type unknown here.
pub fn dimension(cell_type: u8) -> Option<u8> {
    match cell_type {
        0 => Some(0),
        1 | 2 => Some(0),
        3 | 4 | 21 | 35 | 68 | 75 => Some(1),
        5..=9 | 22 | 23 | 28 | 30 | 34 | 36 | 69 | 70 | 76 | 77 => Some(2),
        10..=16 | 24..=27 | 29 | 31..=33 | 37 | 41 | 42 | 71..=74 | 78..=81 => Some(3),
        _ => None,
    }
}

/// VTK's name of a cell type, in plain words.
pub fn name(cell_type: u8) -> &'static str {
    match cell_type {
        0 => "empty cells",
        1 => "vertices",
        2 => "poly-vertices",
        3 => "lines",
        4 => "polylines",
        5 => "triangles",
        6 => "triangle strips",
        7 => "polygons",
        8 => "pixels",
        9 => "quads",
        10 => "tetrahedra",
        11 => "voxels",
        12 => "hexahedra",
        13 => "wedges",
        14 => "pyramids",
        15 => "pentagonal prisms",
        16 => "hexagonal prisms",
        21 => "quadratic edges",
        22 => "quadratic triangles",
        23 => "quadratic quads",
        24 => "quadratic tetrahedra",
        25 => "quadratic hexahedra",
        26 => "quadratic wedges",
        27 => "quadratic pyramids",
        28 => "biquadratic quads",
        29 => "triquadratic hexahedra",
        30 => "quadratic-linear quads",
        31 => "quadratic-linear wedges",
        32 => "biquadratic-quadratic wedges",
        33 => "biquadratic-quadratic hexahedra",
        34 => "biquadratic triangles",
        35 => "cubic lines",
        36 => "quadratic polygons",
        37 => "triquadratic pyramids",
        41 => "convex point sets",
        42 => "polyhedra",
        68 => "Lagrange curves",
        69 => "Lagrange triangles",
        70 => "Lagrange quads",
        71 => "Lagrange tetrahedra",
        72 => "Lagrange hexahedra",
        73 => "Lagrange wedges",
        74 => "Lagrange pyramids",
        75 => "Bézier curves",
        76 => "Bézier triangles",
        77 => "Bézier quads",
        78 => "Bézier tetrahedra",
        79 => "Bézier hexahedra",
        80 => "Bézier wedges",
        81 => "Bézier pyramids",
        _ => "cells of unknown type",
    }
}

/// How many cells there are of each type, in order of type.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CellCounts(std::collections::BTreeMap<u8, usize>);

impl CellCounts {
    /// Counts one more cell of a type.
    pub fn add(&mut self, cell_type: u8) {
        *self.0.entry(cell_type).or_default() += 1;
    }

    /// How many cells there are in all.
    pub fn total(&self) -> usize {
        self.0.values().sum()
    }

    /// The types and how many cells there are of each.
    pub fn iter(&self) -> impl Iterator<Item = (u8, usize)> + '_ {
        self.0.iter().map(|(&cell_type, &count)| (cell_type, count))
    }
}

impl std::fmt::Display for CellCounts {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let parts: Vec<String> =
            self.iter().map(|(cell_type, count)| format!("{count} {}", name(cell_type))).collect();
        f.write_str(if parts.is_empty() { "no cells" } else { "" })?;
        f.write_str(&parts.join(", "))
    }
}

impl FromIterator<u8> for CellCounts {
    fn from_iter<I: IntoIterator<Item = u8>>(cell_types: I) -> Self {
        let mut counts = Self::default();
        cell_types.into_iter().for_each(|cell_type| counts.add(cell_type));
        counts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_listed_by_type() {
        let counts: CellCounts = [10, 5, 5, 1].into_iter().collect();
        assert_eq!(counts.to_string(), "1 vertices, 2 triangles, 1 tetrahedra");
        assert_eq!(CellCounts::default().to_string(), "no cells");
    }

    #[test]
    fn every_named_type_has_a_dimension() {
        for cell_type in 0..=255 {
            let known = name(cell_type) != "cells of unknown type";
            assert_eq!(dimension(cell_type).is_some(), known, "type {cell_type}");
        }
    }
}
