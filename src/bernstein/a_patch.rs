//! The A-patch certificate: one sheet of a contour, seen from a vertex.
//!
//! Look at a Bernstein polynomial on a triangle from one of its vertices, the
//! *apex*. On the ray to a point of the opposite edge it is a cubic whose four
//! Bernstein coefficients are averages, one over each layer of coefficients. If
//! the signs change at most once from layer to layer, then by Descartes' rule
//! each ray meets the zero set at most once: the zero set is a graph over the
//! rays, with no loop, no branch and nothing hidden. One layer may hold both
//! signs, since whichever sign its average takes, there is still one change.
//!
//! Source: C. Bajaj, J. Chen, G. Xu, *Modeling with cubic A-patches*, ACM Trans.
//! Graph. 14 (1995) 103-133, three-sided patches; here in two dimensions.

use super::sign::Sign;
use super::triangle::TriangleCubic;

/// What the signs of the coefficients say about the zero set in a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Certificate {
    /// No coefficient of the other sign: the zero set is empty, or lies on the
    /// border of the triangle.
    Empty,
    /// Every ray from this vertex meets the zero set at most once.
    Graph {
        /// The vertex, 0 to 2.
        apex: usize,
    },
    /// Nothing is known; a smaller triangle may tell.
    None,
}

/// Layers of coefficients, from each vertex to the opposite edge.
const LAYERS: [[&[usize]; 4]; 3] = [
    [&[0], &[1, 2], &[3, 4, 5], &[6, 7, 8, 9]],
    [&[6], &[3, 7], &[1, 4, 8], &[0, 2, 5, 9]],
    [&[9], &[5, 8], &[2, 4, 7], &[0, 1, 3, 6]],
];

/// The signs found in a set of coefficients.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Signs {
    below: bool,
    above: bool,
}

impl Signs {
    fn of(coefficients: &[f64; 10], positions: &[usize]) -> Self {
        let mut signs = Signs { below: false, above: false };
        for &position in positions {
            signs.below |= coefficients[position] < 0.0;
            signs.above |= coefficients[position] > 0.0;
        }
        signs
    }
}

impl TriangleCubic {
    /// The A-patch certificate for the zero set of this polynomial.
    ///
    /// `signs` are the sides on which the corners count. A zero coefficient counts
    /// as either sign, but at the apex as its corner does: there the rays begin, and
    /// one that begins on the other side has a crossing more. Of several possible
    /// apexes the one with the value farthest from zero is chosen, for its rays meet
    /// the zero set at the steepest angles.
    pub fn certificate(&self, signs: [Sign; 3]) -> Certificate {
        let all = Signs::of(&self.coefficients, &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
        if !(all.below && all.above) {
            return Certificate::Empty;
        }
        let apex = (0..3)
            .filter(|&apex| changes_sign_once(&self.coefficients, apex, signs[apex]))
            .max_by(|&a, &b| self.distance_from_zero(a).total_cmp(&self.distance_from_zero(b)));
        apex.map_or(Certificate::None, |apex| Certificate::Graph { apex })
    }

    fn distance_from_zero(&self, vertex: usize) -> f64 {
        self.coefficients[LAYERS[vertex][0][0]].abs()
    }
}

/// Whether the layers seen from `apex`, which counts as on the given side, change
/// sign at most once.
fn changes_sign_once(coefficients: &[f64; 10], apex: usize, side: Sign) -> bool {
    let mut layers = LAYERS[apex].map(|positions| Signs::of(coefficients, positions));
    layers[0] = Signs { below: side == Sign::Below, above: side == Sign::Above };
    // layers of one sign, then at most one mixed layer, then the other sign
    let once = |first: fn(&Signs) -> bool, second: fn(&Signs) -> bool| {
        let leading = layers.iter().take_while(|layer| !second(layer)).count();
        layers.iter().skip(leading + 1).all(|layer| !first(layer))
    };
    once(|s| s.above, |s| s.below) || once(|s| s.below, |s| s.above)
}

#[cfg(test)]
mod tests {
    use super::super::barycentric::Barycentric;
    use super::*;
    use Sign::{Above, Below};
    use proptest::prelude::*;

    const VERTICES: [Barycentric; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    #[test]
    fn one_sign_is_empty() {
        assert_eq!(TriangleCubic::new([1.0; 10]).certificate([Above; 3]), Certificate::Empty);
        assert_eq!(TriangleCubic::new([0.0; 10]).certificate([Above; 3]), Certificate::Empty);
    }

    #[test]
    fn an_island_is_not_certified() {
        // all of the border above zero, the centre far below
        let mut island = [1.0; 10];
        island[TriangleCubic::CENTRE] = -10.0;
        assert_eq!(TriangleCubic::new(island).certificate([Above; 3]), Certificate::None);
    }

    #[test]
    fn a_mixed_base_is_a_graph_over_part_of_it() {
        let mut bay = [1.0; 10];
        bay[7] = -3.0;
        assert_eq!(TriangleCubic::new(bay).certificate([Above; 3]), Certificate::Graph { apex: 0 });
    }

    #[test]
    fn a_mixed_layer_needs_the_far_layers_settled() {
        // from vertex 0: above, mixed, mixed, below
        let layers = [1.0, 1.0, -1.0, 1.0, -1.0, -1.0, -1.0, -1.0, -1.0, -1.0];
        assert!(!changes_sign_once(&layers, 0, Above));
    }

    #[test]
    fn an_apex_on_the_level_counts_as_its_corner() {
        // from vertex 0: on the level, below, below, mixed
        let layers = [0.0, -2.0, 0.0, -2.0, 0.0, 0.0, -1.0, 1.0, -1.0, 1.0];
        assert!(changes_sign_once(&layers, 0, Below));
        assert!(!changes_sign_once(&layers, 0, Above));
        // a line through vertex 0 is still certified, from another vertex
        let line = TriangleCubic::linear([0.0, 1.0, -1.0]);
        assert_eq!(line.certificate([Above, Above, Below]), Certificate::Graph { apex: 2 });
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        /// Every linear function is certified from some vertex, so subdivision
        /// ends wherever the polynomial is nearly linear.
        #[test]
        fn linear_functions_are_certified(values in prop::array::uniform3(-1.0..1.0f64)) {
            let certificate = TriangleCubic::linear(values).certificate(values.map(Sign::of));
            prop_assert!(certificate != Certificate::None);
        }

        /// What is certified holds: rays from the apex cross zero at most once.
        #[test]
        fn certified_rays_cross_once(
            centre in -1.0..1.0f64,
            slopes in prop::array::uniform2(-1.0..1.0f64),
            noise in prop::array::uniform10(-0.5..0.5f64),
        ) {
            let linear = TriangleCubic::linear([centre, centre + slopes[0], centre + slopes[1]]);
            let mut coefficients = linear.coefficients;
            for (c, n) in coefficients.iter_mut().zip(noise) {
                *c += n;
            }
            let cubic = TriangleCubic::new(coefficients);
            let signs = [0, 6, 9].map(|corner| Sign::of(coefficients[corner]));
            let Certificate::Graph { apex } = cubic.certificate(signs) else { return Ok(()) };
            for step in 0..=50 {
                let s = f64::from(step) / 50.0;
                let mut base = [0.0; 3];
                base[(apex + 1) % 3] = 1.0 - s;
                base[(apex + 2) % 3] = s;
                let ray = cubic.restrict(&VERTICES[apex], &base);
                let crossings = ray.roots().crossings().filter(|&t| t > 0.0 && t < 1.0).count();
                prop_assert!(crossings <= 1);
            }
        }
    }
}
