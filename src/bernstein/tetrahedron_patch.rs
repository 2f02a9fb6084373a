//! The A-patch certificate on a tetrahedron: one sheet of a surface.
//!
//! Cut the four vertices into two groups: one vertex and three (*three-sided*), or two
//! and two (*four-sided*). Rays run from each point of the first group's vertex or edge
//! to each point of the other's face or edge; they fill the tetrahedron, and only meet
//! at their ends. On a ray the polynomial is a cubic whose Bernstein coefficients are
//! averages, one over each *layer*: the coefficients of one degree in the second group.
//! The zero set is a graph over the rays, one sheet with nothing hidden, if
//!
//! - the signs change at most once from layer to layer, one inner layer holding both
//!   signs at most (Descartes' rule), or
//! - the polynomial is monotone along each ray: the differences of successive layers,
//!   taken to a common degree, are all of one sign. A linear function always is.
//!
//! In both cases the first and the last layer must each be of one sign: no sheet passes
//! through a group's own edge or face.
//!
//! Source: C. Bajaj, J. Chen, G. Xu, *Modeling with cubic A-patches*, ACM Trans.
//! Graph. 14 (1995) 103-133; S. Luk, S. Mann, *Tetrahedral A-patches* (2009). The
//! monotone form is ours.

use super::sign::Sign;
use super::tetrahedron::{CUBIC, Exponents, TetrahedronCubic};

/// What the signs of the coefficients say about the zero set in a tetrahedron.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PatchCertificate {
    /// No coefficient of the other sign: the zero set is empty, or lies on the
    /// border of the tetrahedron.
    Empty,
    /// Every ray between the two groups of vertices meets the zero set exactly once.
    Patch,
    /// Nothing is known; a smaller tetrahedron may tell.
    None,
}

/// Differences of successive layers that are smaller than this part of the largest
/// coefficient may be rounding, and have no sign.
const NOISE: f64 = 16.0 * f64::EPSILON;

impl TetrahedronCubic {
    /// The certificate for the zero set of this polynomial. `signs` are the sides on
    /// which the vertices count, and make the two groups; zero coefficients count as
    /// either sign.
    pub fn patch_certificate(&self, signs: [Sign; 4]) -> PatchCertificate {
        let (low, high) = self.bounds();
        if low >= 0.0 || high <= 0.0 {
            return PatchCertificate::Empty;
        }
        if signs.iter().all(|&sign| sign == signs[0]) {
            return PatchCertificate::None;
        }
        let layers = Layers::of(self, signs);
        // the second is there for speed: what it accepts the third does too
        let is_patch = layers.ends_are_clean()
            && (layers.change_once()
                || self.falls_in_all_directions(signs)
                || self.is_monotone(signs));
        if is_patch { PatchCertificate::Patch } else { PatchCertificate::None }
    }

    /// Whether the polynomial falls, or at least does not rise, in all directions from a vertex
    /// above to one below: then it does so along all rays, which go in a mean of these.
    fn falls_in_all_directions(&self, signs: [Sign; 4]) -> bool {
        let falls = |from: usize, to: usize| {
            RAISED.iter().all(|at| self.coefficients[at[to]] <= self.coefficients[at[from]])
        };
        let on = |side: Sign| (0..4).filter(move |&vertex| signs[vertex] == side);
        on(Sign::Above).all(|from| on(Sign::Below).all(|to| falls(from, to)))
    }

    /// Whether the polynomial falls, or at least does not rise, along all rays from the
    /// vertices above to those below.
    fn is_monotone(&self, signs: [Sign; 4]) -> bool {
        let (low, high) = self.bounds();
        let noise = NOISE * high.max(-low);
        (0..3).all(|layer| {
            raised(layer, signs).all(|exponents| self.rise(exponents, layer, signs) <= noise)
        })
    }

    /// The coefficient, at the given exponents, of the next layer less this one: each
    /// raised by one degree in the group in which it lacks one.
    fn rise(&self, exponents: Exponents, layer: usize, signs: [Sign; 4]) -> f64 {
        let lowered = |vertex: usize| {
            let mut lower = exponents;
            lower[vertex] -= 1;
            self.coefficient(lower)
        };
        let mut rise = 0.0;
        for vertex in (0..4).filter(|&vertex| exponents[vertex] > 0) {
            let exponent = exponents[vertex] as f64;
            rise += match signs[vertex] {
                Sign::Above => exponent / (3 - layer) as f64 * lowered(vertex),
                Sign::Below => -exponent / (layer + 1) as f64 * lowered(vertex),
            };
        }
        rise
    }
}

/// Exponents of degree `3 - layer` in the vertices above and `layer + 1` in those below.
fn raised(layer: usize, signs: [Sign; 4]) -> impl Iterator<Item = Exponents> {
    QUARTIC.into_iter().filter(move |exponents| degree_below(exponents, signs) == layer + 1)
}

const QUARTIC: [Exponents; 35] = super::tetrahedron::exponents(4);

/// For each coefficient of a quadratic polynomial, the positions of the cubic's with one more
/// power at each vertex.
static RAISED: [[usize; 4]; 10] = super::tetrahedron::TO_QUADRATIC;

/// The vertices below, as bits.
fn bits_below(signs: [Sign; 4]) -> usize {
    (0..4).filter(|&vertex| signs[vertex] == Sign::Below).fold(0, |bits, vertex| bits | 1 << vertex)
}

fn degree_below(exponents: &Exponents, signs: [Sign; 4]) -> usize {
    exponents.iter().zip(signs).filter(|(_, sign)| *sign == Sign::Below).map(|(e, _)| e).sum()
}

/// Which signs the coefficients of each layer have, from the vertices above to those
/// below.
struct Layers {
    below: [bool; 4],
    above: [bool; 4],
}

/// For each set of vertices below (vertex `n` is bit `n`), the positions of each layer's
/// coefficients, as bits.
static LAYERS: [[u32; 4]; 16] = {
    let mut all = [[0; 4]; 16];
    let mut n = 0;
    while n < 16 * 20 {
        let (below, position) = (n / 20, n % 20);
        let (mut degree, mut vertex) = (0, 0);
        while vertex < 4 {
            degree += CUBIC[position][vertex] * (below >> vertex & 1);
            vertex += 1;
        }
        all[below][degree] |= 1 << position;
        n += 1;
    }
    all
};

impl Layers {
    fn of(cubic: &TetrahedronCubic, signs: [Sign; 4]) -> Self {
        let (mut below, mut above) = (0, 0);
        for (position, &coefficient) in cubic.coefficients.iter().enumerate() {
            below |= u32::from(coefficient < 0.0) << position;
            above |= u32::from(coefficient > 0.0) << position;
        }
        let layers = &LAYERS[bits_below(signs)];
        Self {
            below: layers.map(|layer| layer & below != 0),
            above: layers.map(|layer| layer & above != 0),
        }
    }

    /// The first layer is not below, the last not above.
    fn ends_are_clean(&self) -> bool {
        !self.below[0] && !self.above[3]
    }

    /// Above, then at most one layer of both signs, then below.
    fn change_once(&self) -> bool {
        let leading = self.below.iter().take_while(|below| !**below).count();
        self.above.iter().skip(leading + 1).all(|above| !above)
    }
}

#[cfg(test)]
mod tests {
    use super::super::barycentric::Barycentric4;
    use super::*;
    use Sign::{Above, Below};
    use proptest::prelude::*;

    const SIGNS: [[Sign; 4]; 4] = [
        [Above, Below, Below, Below],
        [Below, Above, Above, Above],
        [Above, Above, Below, Below],
        [Below, Above, Below, Above],
    ];

    #[test]
    fn one_sign_is_empty() {
        let positive = TetrahedronCubic::new([1.0; 20]);
        assert_eq!(positive.patch_certificate([Above; 4]), PatchCertificate::Empty);
    }

    #[test]
    fn an_island_is_not_certified() {
        let mut island = TetrahedronCubic::new([1.0; 20]);
        island.coefficients[14] = -30.0;
        assert_eq!(island.patch_certificate([Above; 4]), PatchCertificate::None);
    }

    #[test]
    fn a_sheet_that_enters_through_the_base_is_not_certified() {
        // above at vertex 0, below on the base's border, above inside the base
        let mut cubic = TetrahedronCubic::linear([1.0, -1.0, -1.0, -1.0]);
        cubic.coefficients[14] = 20.0;
        assert_eq!(cubic.patch_certificate(SIGNS[0]), PatchCertificate::None);
    }

    /// A ray between the groups, at weights within them.
    fn ray(signs: [Sign; 4], weights: [f64; 4]) -> [Barycentric4; 2] {
        [Above, Below].map(|side| {
            let on_side = |n: usize| if signs[n] == side { weights[n] } else { 0.0 };
            let sum: f64 = (0..4).map(on_side).sum();
            [0, 1, 2, 3].map(|n| on_side(n) / sum)
        })
    }

    proptest! {
        #[test]
        fn linear_functions_are_patches(v in prop::array::uniform4(0.01..1.0f64), which in 0..4usize) {
            let signs = SIGNS[which];
            let value = |n: usize| if signs[n] == Above { v[n] } else { -v[n] };
            let cubic = TetrahedronCubic::linear([0, 1, 2, 3].map(value));
            prop_assert_eq!(cubic.patch_certificate(signs), PatchCertificate::Patch);
        }

        /// The layers' signs, one coefficient after the other.
        #[test]
        fn layers_are_those_of_the_exponents(
            c in prop::collection::vec(-2..3_i32, 20), which in 0..4usize,
        ) {
            let cubic = TetrahedronCubic::new(std::array::from_fn(|n| f64::from(c[n])));
            let layers = Layers::of(&cubic, SIGNS[which]);
            for layer in 0..4 {
                let own = || (0..20).filter(|&n| degree_below(&CUBIC[n], SIGNS[which]) == layer);
                prop_assert_eq!(layers.below[layer], own().any(|n| c[n] < 0));
                prop_assert_eq!(layers.above[layer], own().any(|n| c[n] > 0));
            }
        }

        #[test]
        fn what_falls_in_all_directions_is_monotone(
            v in prop::array::uniform4(0.05..1.0f64), noise in prop::collection::vec(-0.2..0.2f64, 20),
            which in 0..4usize,
        ) {
            let signs = SIGNS[which];
            let value = |n: usize| if signs[n] == Above { v[n] } else { -v[n] };
            let mut cubic = TetrahedronCubic::linear([0, 1, 2, 3].map(value));
            for (c, noise) in cubic.coefficients.iter_mut().zip(noise) {
                *c += noise;
            }
            prop_assert!(!cubic.falls_in_all_directions(signs) || cubic.is_monotone(signs));
        }

        /// What the certificate promises: one crossing on every ray.
        #[test]
        fn each_ray_crosses_once(
            v in prop::array::uniform4(0.05..1.0f64), noise in prop::collection::vec(-0.7..0.7f64, 20),
            which in 0..4usize, w in prop::array::uniform4(0.01..1.0f64),
        ) {
            let signs = SIGNS[which];
            let value = |n: usize| if signs[n] == Above { v[n] } else { -v[n] };
            let mut cubic = TetrahedronCubic::linear([0, 1, 2, 3].map(value));
            for (exponents, (c, noise)) in CUBIC.iter().zip(cubic.coefficients.iter_mut().zip(noise)) {
                if !exponents.contains(&3) {
                    *c += noise;
                }
            }
            if cubic.patch_certificate(signs) == PatchCertificate::Patch {
                let [from, to] = ray(signs, w);
                let line = cubic.restrict(&from, &to);
                let samples = (0..=200).map(|n| line.value(f64::from(n) / 200.0));
                let signs: Vec<bool> = samples.map(|value| value > 0.0).collect();
                prop_assert_eq!(signs.windows(2).filter(|pair| pair[0] != pair[1]).count(), 1);
            }
        }
    }
}
