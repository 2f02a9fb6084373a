//! Cubic polynomials on a tetrahedron.

use std::ops::{Add, Mul};

use super::barycentric::Barycentric4;
use super::bounds::{bounds, value_bounds};
use super::segment::SegmentCubic;
use super::triangle::TriangleCubic;

/// A cubic polynomial on a tetrahedron, by its twenty Bernstein coefficients.
///
/// `p(λ) = Σ b_ijkl 3!/(i! j! k! l!) λ₀ⁱ λ₁ʲ λ₂ᵏ λ₃ˡ` over `i + j + k + l = 3`.
///
/// The coefficients stand in layers from vertex 0 to the opposite face; each layer
/// is ordered as the coefficients of a [`TriangleCubic`] are, so the last one *is*
/// the cubic on that face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TetrahedronCubic {
    /// Bernstein coefficients, layer by layer.
    pub coefficients: [f64; 20],
}

/// Exponents of the four barycentric coordinates.
pub type Exponents = [usize; 4];

/// The position of the coefficient with the given exponents. It does not depend on
/// the first, so it serves polynomials of any degree.
const fn position([_, j, k, l]: Exponents) -> usize {
    let (layer, row) = (j + k + l, k + l);
    layer * (layer + 1) * (layer + 2) / 6 + row * (row + 1) / 2 + l
}

/// The exponents of the coefficients of a polynomial of the given degree, in order
/// of position; `COUNT` must be their number.
pub(super) const fn exponents<const COUNT: usize>(degree: usize) -> [Exponents; COUNT] {
    let mut all = [[0; 4]; COUNT];
    let mut j = 0;
    while j <= degree {
        let mut k = 0;
        while j + k <= degree {
            let mut l = 0;
            while j + k + l <= degree {
                let one = [degree - j - k - l, j, k, l];
                all[position(one)] = one;
                l += 1;
            }
            k += 1;
        }
        j += 1;
    }
    all
}

pub(super) const CUBIC: [Exponents; 20] = exponents(3);

/// For each coefficient of a polynomial of one degree less, the positions of the
/// four from which de Casteljau's algorithm makes it.
const fn parents<const COUNT: usize>(degree: usize) -> [[usize; 4]; COUNT] {
    let below: [Exponents; COUNT] = exponents(degree - 1);
    let mut all = [[0; 4]; COUNT];
    let mut n = 0;
    while n < COUNT {
        let mut vertex = 0;
        while vertex < 4 {
            let mut raised = below[n];
            raised[vertex] += 1;
            all[n][vertex] = position(raised);
            vertex += 1;
        }
        n += 1;
    }
    all
}

/// The position of the coefficient that is `power` times at a vertex, the rest at another.
const fn on_edge(vertex: usize, power: usize, other: usize) -> usize {
    let mut exponents = [0; 4];
    exponents[vertex] += power;
    exponents[other] += 3 - power;
    position(exponents)
}

/// The positions of the coefficients on the line from each vertex to each, by their power
/// at the second.
static EDGES: [[[usize; 4]; 4]; 4] = {
    let mut all = [[[0; 4]; 4]; 4];
    let mut n = 0;
    while n < 64 {
        let (from, to, power) = (n / 16, n / 4 % 4, n % 4);
        all[from][to][power] = on_edge(to, power, from);
        n += 1;
    }
    all
};

/// The positions of the coefficients at vertices and on edges.
const ON_EDGES: [usize; 16] = {
    let (mut all, mut count, mut n) = ([0; 16], 0, 0);
    while n < CUBIC.len() {
        let [a, b, c, d] = CUBIC[n];
        if a > 1 || b > 1 || c > 1 || d > 1 {
            all[count] = n;
            count += 1;
        }
        n += 1;
    }
    all
};

pub(super) const TO_QUADRATIC: [[usize; 4]; 10] = parents(3);
const TO_LINEAR: [[usize; 4]; 4] = parents(2);

impl TetrahedronCubic {
    /// The positions of the four coefficients amid a face, which no edge sees, by the
    /// vertex opposite to the face.
    pub const FACES: [usize; 4] = [
        position([0, 1, 1, 1]),
        position([1, 0, 1, 1]),
        position([1, 1, 0, 1]),
        position([1, 1, 1, 0]),
    ];

    /// The vertices of each face, ascending, by the vertex opposite to it.
    pub const FACE_VERTICES: [[usize; 3]; 4] = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]];

    /// The cubic with the given coefficients, layer by layer from vertex 0.
    pub fn new(coefficients: [f64; 20]) -> Self {
        Self { coefficients }
    }

    /// The cubic with vertex coefficients `vertex[i]`, edge coefficients `toward(i, j)`
    /// (the one near vertex `i` on its edge to vertex `j`), and for each vertex the
    /// coefficient amid the face opposite to it.
    pub fn assemble(
        vertex: [f64; 4],
        toward: impl Fn(usize, usize) -> f64,
        face: [f64; 4],
    ) -> Self {
        let mut cubic = Self::new([0.0; 20]);
        for from in 0..4 {
            cubic.coefficients[EDGES[from][from][0]] = vertex[from];
            cubic.coefficients[Self::FACES[from]] = face[from];
            for to in (0..4).filter(|&to| to != from) {
                cubic.coefficients[EDGES[from][to][1]] = toward(from, to);
            }
        }
        cubic
    }

    /// The cubic with coefficients given by a function of their exponents.
    pub fn from_coefficients(coefficient: impl FnMut(Exponents) -> f64) -> Self {
        Self { coefficients: CUBIC.map(coefficient) }
    }

    /// The cubic that equals the linear function with the given vertex values.
    pub fn linear(values: [f64; 4]) -> Self {
        Self::from_coefficients(|exponents| match exponents.iter().position(|&e| e == 3) {
            Some(vertex) => values[vertex],
            None => {
                let terms = exponents.iter().zip(values).map(|(&e, value)| e as f64 * value);
                terms.sum::<f64>() / 3.0
            }
        })
    }

    /// The coefficient with the given exponents, whose sum must be three.
    pub fn coefficient(&self, exponents: Exponents) -> f64 {
        debug_assert_eq!(exponents.iter().sum::<usize>(), 3);
        self.coefficients[position(exponents)]
    }

    /// The values at the four vertices, which are coefficients too.
    pub fn vertices(&self) -> [f64; 4] {
        [0, 1, 2, 3].map(|vertex| self.coefficients[EDGES[vertex][vertex][0]])
    }

    /// The value at `at`, by de Casteljau's algorithm.
    pub fn value(&self, at: &Barycentric4) -> f64 {
        dot(&self.blossoms(at), at)
    }

    /// Derivatives with respect to the four barycentric coordinates, each taken as
    /// an independent variable. The gradient is `Σ ∂p/∂λᵢ ∇λᵢ`.
    pub fn barycentric_gradient(&self, at: &Barycentric4) -> [f64; 4] {
        self.blossoms(at).map(|value| 3.0 * value)
    }

    /// Second derivatives with respect to the barycentric coordinates, taken as
    /// independent variables. The Hessian is `Σ ∂²p/∂λᵢ∂λⱼ ∇λᵢ ∇λⱼᵀ`.
    pub fn barycentric_hessian(&self, at: &Barycentric4) -> [[f64; 4]; 4] {
        let quadratic = contract(&TO_QUADRATIC, &self.coefficients, at);
        let entry = |i: usize, j: usize| {
            let mut exponents = [0; 4];
            exponents[i] += 1;
            exponents[j] += 1;
            6.0 * quadratic[position(exponents)]
        };
        [0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| entry(i, j)))
    }

    /// The blossom at each vertex and twice at a place: what is left after two steps of de
    /// Casteljau.
    pub(crate) fn blossoms<N: Numbers>(&self, at: &[N; 4]) -> [N; 4] {
        let quadratic: [N; 10] = contract(&TO_QUADRATIC, &self.coefficients, at);
        contract(&TO_LINEAR, &quadratic, at)
    }

    /// The cubic on the edge from one vertex to another.
    pub fn edge(&self, [from, to]: [usize; 2]) -> SegmentCubic {
        SegmentCubic::new(EDGES[from][to].map(|position| self.coefficients[position]))
    }

    /// The cubic on the face with the given three vertices, in their order.
    pub fn face(&self, vertices: [usize; 3]) -> TriangleCubic {
        TriangleCubic::from_coefficients(|on_face| {
            let mut exponents = [0; 4];
            for (vertex, exponent) in vertices.iter().zip(on_face) {
                exponents[*vertex] = exponent;
            }
            self.coefficient(exponents)
        })
    }

    /// The cubic on the straight line from `a` (t = 0) to `b` (t = 1).
    pub fn restrict(&self, a: &Barycentric4, b: &Barycentric4) -> SegmentCubic {
        let at_a = contract(&TO_QUADRATIC, &self.coefficients, a);
        let at_b = contract(&TO_QUADRATIC, &self.coefficients, b);
        let (aa, ab) = (contract(&TO_LINEAR, &at_a, a), contract(&TO_LINEAR, &at_a, b));
        let bb = contract(&TO_LINEAR, &at_b, b);
        SegmentCubic::new([dot(&aa, a), dot(&aa, b), dot(&ab, b), dot(&bb, b)])
    }

    /// The same polynomial on the tetrahedron with the given corners.
    pub fn sub_tetrahedron(&self, corners: &[Barycentric4; 4]) -> Self {
        let once = corners.map(|corner| contract(&TO_QUADRATIC, &self.coefficients, &corner));
        Self::from_coefficients(|exponents| {
            let [a, b, c] = arguments(exponents);
            let twice = contract(&TO_LINEAR, &once[a], &corners[b]);
            dot(&twice, &corners[c])
        })
    }

    /// The polynomial minus a constant.
    pub fn minus(&self, constant: f64) -> Self {
        Self::new(self.coefficients.map(|c| c - constant))
    }

    /// Certain bounds: the least and the greatest coefficient. The polynomial lies
    /// between them everywhere in the tetrahedron.
    pub fn bounds(&self) -> (f64, f64) {
        bounds(&self.coefficients)
    }

    /// What the Bernstein polynomials of the four coefficients amid faces sum up to, at most: six
    /// times the sum of the products of three coordinates, which is greatest in the middle.
    pub const SHARE_OF_FACES: f64 = 3.0 / 8.0;

    /// Certain bounds that are closer: the polynomial lies between them, but not all coefficients.
    pub fn value_bounds(&self) -> [f64; 2] {
        let on_edges = ON_EDGES.map(|position| self.coefficients[position]);
        let amid_faces = Self::FACES.map(|position| self.coefficients[position]);
        let [on_edges, amid_faces] = [bounds(&on_edges), bounds(&amid_faces)].map(Into::into);
        value_bounds(on_edges, amid_faces, Self::SHARE_OF_FACES)
    }
}

/// The three vertices, with repeats, that exponents stand for.
fn arguments(exponents: Exponents) -> [usize; 3] {
    let mut vertices = [0; 3];
    let mut place = 0;
    for (vertex, &exponent) in exponents.iter().enumerate() {
        for _ in 0..exponent {
            vertices[place] = vertex;
            place += 1;
        }
    }
    vertices
}

/// A number, or several at a time.
pub(crate) trait Numbers:
    Copy + From<f64> + Add<Output = Self> + Mul<Output = Self>
{
}

impl<N: Copy + From<f64> + Add<Output = N> + Mul<Output = N>> Numbers for N {}

/// One step of de Casteljau's algorithm.
#[inline]
fn contract<C: Copy + Into<N>, N: Numbers, const FROM: usize, const TO: usize>(
    parents: &[[usize; 4]; TO],
    coefficients: &[C; FROM],
    at: &[N; 4],
) -> [N; TO] {
    let mut contracted = [N::from(0.0); TO];
    for (sum, of) in contracted.iter_mut().zip(parents) {
        *sum = dot(&of.map(|position| coefficients[position].into()), at);
    }
    contracted
}

/// The sum of products, from the first to the last: a weight of zero then changes no
/// bit, and a face has the same values in both tetrahedra if they name its vertices in
/// the same order.
#[inline]
fn dot<N: Numbers>(a: &[N; 4], b: &[N; 4]) -> N {
    ((a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]) + a[3] * b[3]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn definition(cubic: &TetrahedronCubic, at: &Barycentric4) -> f64 {
        let factorial = [1.0, 1.0, 2.0, 6.0];
        let term = |exponents: Exponents| {
            let weight: f64 = 6.0 / exponents.map(|e| factorial[e]).iter().product::<f64>();
            let powers = exponents.iter().zip(at).map(|(&e, x)| x.powi(e as i32));
            weight * powers.product::<f64>() * cubic.coefficient(exponents)
        };
        CUBIC.map(term).iter().sum()
    }

    fn cubics() -> impl Strategy<Value = TetrahedronCubic> {
        prop::collection::vec(-1.0..1.0f64, 20)
            .prop_map(|c| TetrahedronCubic::new(c.try_into().unwrap()))
    }

    fn inside() -> impl Strategy<Value = Barycentric4> {
        prop::array::uniform4(0.01..1.0f64).prop_map(|w| {
            let sum: f64 = w.iter().sum();
            w.map(|x| x / sum)
        })
    }

    #[test]
    fn edges_and_faces_by_hand() {
        let numbered: Vec<f64> = (0..20).map(f64::from).collect();
        let cubic = TetrahedronCubic::new(numbered.try_into().unwrap());
        assert_eq!(cubic.edge([0, 1]).coefficients, [0.0, 1.0, 4.0, 10.0]);
        assert_eq!(cubic.edge([3, 2]).coefficients, [19.0, 18.0, 17.0, 16.0]);
        assert_eq!(cubic.vertices(), [0.0, 10.0, 16.0, 19.0]);
        let opposite = cubic.face([1, 2, 3]).coefficients;
        assert_eq!(opposite.to_vec(), (10..20).map(f64::from).collect::<Vec<_>>());
        assert_eq!(cubic.coefficient([0, 1, 1, 1]), 14.0);
    }

    /// The cubic of a tetrahedron that has the vertices of a face at other places, in
    /// the same order, and other coefficients elsewhere.
    fn beyond_the_face(p: &TetrahedronCubic, missing: usize) -> TetrahedronCubic {
        // the face of all vertices but vertex 1 is opposite vertex `missing` there
        let rank = |place: usize| if place < missing { place } else { place - 1 };
        TetrahedronCubic::from_coefficients(|exponents| {
            let mut here = [0; 4];
            for place in (0..4).filter(|&place| place != missing) {
                here[[0, 2, 3][rank(place)]] = exponents[place];
            }
            if exponents[missing] == 0 { p.coefficient(here) } else { 7.0 }
        })
    }

    #[test]
    fn an_assembled_cubic_has_its_parts_in_place() {
        let toward = |i: usize, j: usize| (10 * i + j) as f64;
        let cubic = TetrahedronCubic::assemble([90.0, 91.0, 92.0, 93.0], toward, [80.0; 4]);
        assert_eq!(cubic.coefficient([0, 0, 3, 0]), 92.0);
        assert_eq!(cubic.coefficient([1, 0, 0, 2]), 30.0);
        assert_eq!(cubic.coefficient([0, 2, 1, 0]), 12.0);
        let faces = TetrahedronCubic::assemble([0.0; 4], |_, _| 0.0, [1.0, 2.0, 3.0, 4.0]);
        for (opposite, position) in TetrahedronCubic::FACES.into_iter().enumerate() {
            assert_eq!(faces.coefficients[position], 1.0 + opposite as f64);
            let mut amid = [1; 4];
            amid[opposite] = 0;
            assert_eq!(faces.coefficient(amid), 1.0 + opposite as f64);
        }
    }

    #[test]
    fn bounds_of_values_are_met() {
        let amid = |exponents: Exponents| f64::from(exponents.iter().all(|&power| power < 2));
        let bump = TetrahedronCubic::from_coefficients(amid);
        assert_eq!((bump.value_bounds(), bump.value(&[0.25; 4])), ([0.0, 0.375], 0.375));
        assert_eq!(bump.minus(1.0).value_bounds(), [-1.0, -0.625]);
    }

    proptest! {
        /// Two tetrahedra that share a face compute the same bits on it.
        #[test]
        fn a_face_is_the_same_from_both_sides(
            p in cubics(), missing in 0..4usize, a in 0.0..0.5f64, b in 0.0..0.5f64, t in 0.0..0.5f64,
        ) {
            let other = beyond_the_face(&p, missing);
            let inside = |weights: [f64; 3], off: usize| {
                let mut at = [0.0; 4];
                for (place, weight) in (0..4).filter(|&place| place != off).zip(weights) {
                    at[place] = weight;
                }
                at
            };
            let (from, to) = ([1.0 - a - b, a, b], [t, 0.5, 0.5 - t]);
            prop_assert_eq!(p.value(&inside(from, 1)), other.value(&inside(from, missing)));
            prop_assert_eq!(
                p.restrict(&inside(from, 1), &inside(to, 1)),
                other.restrict(&inside(from, missing), &inside(to, missing))
            );
        }

        #[test]
        fn value_is_the_definition(p in cubics(), at in inside()) {
            prop_assert!((p.value(&at) - definition(&p, &at)).abs() < 1e-14);
            let (low, high) = p.bounds();
            prop_assert!(low <= p.value(&at) && p.value(&at) <= high);
            let [least, greatest] = p.value_bounds();
            prop_assert!(low <= least && greatest <= high);
            let noise = 1e-15;
            prop_assert!(least - noise <= p.value(&at) && p.value(&at) <= greatest + noise);
        }

        #[test]
        fn faces_are_the_polynomial(p in cubics(), s in 0.0..0.5f64, t in 0.0..0.5f64) {
            for vertices in [[0, 1, 2], [3, 1, 0], [2, 3, 1]] {
                let on_face = [1.0 - s - t, s, t];
                let mut at = [0.0; 4];
                for (vertex, weight) in vertices.iter().zip(on_face) {
                    at[*vertex] = weight;
                }
                prop_assert!((p.face(vertices).value(&on_face) - p.value(&at)).abs() < 1e-14);
            }
        }

        #[test]
        fn restriction_is_the_polynomial(p in cubics(), a in inside(), b in inside(), t in 0.0..1.0f64) {
            let at = [0, 1, 2, 3].map(|n| (1.0 - t) * a[n] + t * b[n]);
            prop_assert!((p.restrict(&a, &b).value(t) - p.value(&at)).abs() < 1e-14);
        }

        #[test]
        fn sub_tetrahedron_is_the_polynomial(
            p in cubics(), corners in prop::array::uniform4(inside()), at in inside(),
        ) {
            let whole = [0, 1, 2, 3].map(|n| (0..4).map(|c| at[c] * corners[c][n]).sum::<f64>());
            prop_assert!((p.sub_tetrahedron(&corners).value(&at) - p.value(&whole)).abs() < 1e-14);
        }

        #[test]
        fn derivatives_are_slopes(p in cubics(), a in inside(), b in inside()) {
            let line = p.restrict(&a, &b);
            let middle = [0, 1, 2, 3].map(|n| 0.5 * (a[n] + b[n]));
            let direction = [0, 1, 2, 3].map(|n| b[n] - a[n]);
            let slope = dot(&p.barycentric_gradient(&middle), &direction);
            let hessian = p.barycentric_hessian(&middle);
            let bend = dot(&hessian.map(|row| dot(&row, &direction)), &direction);
            prop_assert!((slope - line.derivative(0.5)).abs() < 1e-13);
            prop_assert!((bend - line.second_derivative(0.5)).abs() < 1e-12);
        }
    }
}
