//! Cubic polynomials on a triangle.

use arrayvec::ArrayVec;

use super::barycentric::Barycentric;
use super::bounds::{bounds, value_bounds};
use super::segment::SegmentCubic;

/// A cubic polynomial on a triangle, by its ten Bernstein coefficients.
///
/// `p(λ) = Σ b_ijk 3!/(i! j! k!) λ₀ⁱ λ₁ʲ λ₂ᵏ` over `i + j + k = 3`.
///
/// The coefficients stand in layers from vertex 0 to the opposite edge:
///
/// ```text
///            300                     0
///          210 201                  1 2
///        120 111 102               3 4 5
///      030 021 012 003            6 7 8 9
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleCubic {
    /// Bernstein coefficients, layer by layer.
    pub coefficients: [f64; 10],
}

/// The position of `b_ijk`, given `j` and `k`: layer `j + k`, place `k`.
const fn position(j: usize, k: usize) -> usize {
    let layer = j + k;
    layer * (layer + 1) / 2 + k
}

/// Positions of the four coefficients of the edge opposite each vertex, in the
/// counter-clockwise direction (from vertex `e + 1` to vertex `e + 2`).
const EDGES: [[usize; 4]; 3] = [
    [position(3, 0), position(2, 1), position(1, 2), position(0, 3)],
    [position(0, 3), position(0, 2), position(0, 1), position(0, 0)],
    [position(0, 0), position(1, 0), position(2, 0), position(3, 0)],
];

impl TriangleCubic {
    /// The position of `b_111`, the one coefficient that no edge sees.
    pub const CENTRE: usize = position(1, 1);

    /// The cubic with the given coefficients, layer by layer from vertex 0.
    pub fn new(coefficients: [f64; 10]) -> Self {
        Self { coefficients }
    }

    /// The cubic with vertex coefficients `b_iii = vertex[i]`, edge coefficients
    /// `b_iij = toward(i, j)` (the one near vertex `i` on its edge to vertex `j`),
    /// and `b_111 = centre`.
    pub fn assemble(vertex: [f64; 3], toward: impl Fn(usize, usize) -> f64, centre: f64) -> Self {
        let [first, second, third] = vertex;
        Self::new([
            first,
            toward(0, 1),
            toward(0, 2),
            toward(1, 0),
            centre,
            toward(2, 0),
            second,
            toward(1, 2),
            toward(2, 1),
            third,
        ])
    }

    /// The cubic that equals the linear function with the given vertex values.
    pub fn linear(values: [f64; 3]) -> Self {
        let toward = |i: usize, j: usize| (2.0 * values[i] + values[j]) / 3.0;
        Self::assemble(values, toward, (values[0] + values[1] + values[2]) / 3.0)
    }

    /// This cubic with the `b_111` that reproduces quadratics: a quarter of the edge
    /// coefficients less a sixth of the vertex coefficients.
    pub fn with_quadratic_centre(mut self) -> Self {
        let [a, ab, ac, ba, _, ca, b, bc, cb, c] = self.coefficients;
        let edges = (ab + ba) + (bc + cb) + (ca + ac);
        self.coefficients[Self::CENTRE] = edges / 4.0 - (a + b + c) / 6.0;
        self
    }

    /// The cubic with `b_ijk` given by a function of `[i, j, k]`.
    pub fn from_coefficients(coefficient: impl Fn([usize; 3]) -> f64) -> Self {
        let mut coefficients = [0.0; 10];
        for j in 0..=3 {
            for k in 0..=3 - j {
                coefficients[position(j, k)] = coefficient([3 - j - k, j, k]);
            }
        }
        Self { coefficients }
    }

    /// The coefficient `b_ijk`; `i + j + k` must be three.
    pub fn coefficient(&self, [i, j, k]: [usize; 3]) -> f64 {
        debug_assert_eq!(i + j + k, 3);
        self.coefficients[position(j, k)]
    }

    /// The value at `at`, by de Casteljau's algorithm.
    pub fn value(&self, at: &Barycentric) -> f64 {
        self.blossom(at, at, at)
    }

    /// The blossom (polar form): the symmetric function, affine in each of its
    /// three arguments, that equals the cubic where the arguments agree.
    ///
    /// Its values at the vertices of a smaller triangle are the Bernstein
    /// coefficients there (Farin, section 17.6).
    pub fn blossom(&self, a: &Barycentric, b: &Barycentric, c: &Barycentric) -> f64 {
        contract1(&contract2(&contract3(&self.coefficients, a), b), c)
    }

    /// Derivatives with respect to the three barycentric coordinates, each taken
    /// as an independent variable. The gradient is `Σ ∂p/∂λᵢ ∇λᵢ`.
    pub fn barycentric_gradient(&self, at: &Barycentric) -> [f64; 3] {
        let linear = contract2(&contract3(&self.coefficients, at), at);
        linear.map(|value| 3.0 * value)
    }

    /// Second derivatives with respect to the barycentric coordinates, taken as
    /// independent variables. The Hessian is `Σ ∂²p/∂λᵢ∂λⱼ ∇λᵢ ∇λⱼᵀ`.
    pub fn barycentric_hessian(&self, at: &Barycentric) -> [[f64; 3]; 3] {
        let [a, b, c, d, e, f] = contract3(&self.coefficients, at).map(|value| 6.0 * value);
        [[a, b, c], [b, d, e], [c, e, f]]
    }

    /// The values at the three vertices, which are coefficients too.
    pub fn vertices(&self) -> [f64; 3] {
        let [a, _, _, _, _, _, b, _, _, c] = self.coefficients;
        [a, b, c]
    }

    /// The edge opposite `vertex`, from vertex `vertex + 1` to vertex `vertex + 2`.
    pub fn edge(&self, vertex: usize) -> SegmentCubic {
        SegmentCubic::new(EDGES[vertex].map(|position| self.coefficients[position]))
    }

    /// The means of a layer of coefficients, as seen from vertex `apex`: on the ray
    /// to the point `t` of the opposite edge, they are the Bernstein coefficients of
    /// the cubic. Layer 0 is the apex, layer 3 the opposite edge; layer `n` is of
    /// degree `n`, and here written as a cubic.
    pub fn layer(&self, apex: usize, layer: usize) -> SegmentCubic {
        let (start, end) = ((apex + 1) % 3, (apex + 2) % 3);
        let coefficient = |n: usize| {
            let mut exponents = [0; 3];
            exponents[apex] = 3 - layer;
            exponents[start] = layer - n;
            exponents[end] = n;
            self.coefficient(exponents)
        };
        // elevation, one degree at a time
        let mut means: ArrayVec<f64, 4> = (0..=layer).map(coefficient).collect();
        while means.len() < 4 {
            let degree = means.len() as f64;
            let mix = |n: usize| {
                let before = if n > 0 { n as f64 * means[n - 1] } else { 0.0 };
                let after = if n < means.len() { (degree - n as f64) * means[n] } else { 0.0 };
                (before + after) / degree
            };
            means = (0..=means.len()).map(mix).collect();
        }
        SegmentCubic::new([means[0], means[1], means[2], means[3]])
    }

    /// The cubic on the straight line from `a` (t = 0) to `b` (t = 1).
    pub fn restrict(&self, a: &Barycentric, b: &Barycentric) -> SegmentCubic {
        let (at_a, at_b) = (contract3(&self.coefficients, a), contract3(&self.coefficients, b));
        let (aa, ab, bb) = (contract2(&at_a, a), contract2(&at_a, b), contract2(&at_b, b));
        SegmentCubic::new([
            contract1(&aa, a),
            contract1(&aa, b),
            contract1(&ab, b),
            contract1(&bb, b),
        ])
    }

    /// The same polynomial on the triangle with corners `a`, `b`, `c`.
    pub fn sub_triangle(&self, [a, b, c]: &[Barycentric; 3]) -> Self {
        let (at_a, at_b, at_c) = (
            contract3(&self.coefficients, a),
            contract3(&self.coefficients, b),
            contract3(&self.coefficients, c),
        );
        let (aa, ab, ac) = (contract2(&at_a, a), contract2(&at_a, b), contract2(&at_a, c));
        let (bb, bc, cc) = (contract2(&at_b, b), contract2(&at_b, c), contract2(&at_c, c));
        Self::new([
            contract1(&aa, a),
            contract1(&aa, b),
            contract1(&aa, c),
            contract1(&ab, b),
            contract1(&ab, c),
            contract1(&ac, c),
            contract1(&bb, b),
            contract1(&bb, c),
            contract1(&bc, c),
            contract1(&cc, c),
        ])
    }

    /// The polynomial minus a constant.
    pub fn minus(&self, constant: f64) -> Self {
        Self::new(self.coefficients.map(|c| c - constant))
    }

    /// Certain bounds: the least and the greatest coefficient. The polynomial
    /// lies between them everywhere in the triangle.
    pub fn bounds(&self) -> (f64, f64) {
        bounds(&self.coefficients)
    }

    /// The most that the Bernstein polynomial of the coefficient amid the triangle is: 2/9, in the
    /// middle; rounded up.
    pub const SHARE_OF_CENTRE: f64 = 0.2223;

    /// Certain bounds that are closer: the polynomial lies between them, but not all coefficients.
    pub fn value_bounds(&self) -> [f64; 2] {
        let mut on_edges = self.coefficients;
        on_edges[Self::CENTRE] = on_edges[0];
        let centre = self.coefficients[Self::CENTRE];
        value_bounds(bounds(&on_edges).into(), [centre; 2], Self::SHARE_OF_CENTRE)
    }
}

/// One step of de Casteljau's algorithm, from ten coefficients to six.
fn contract3(b: &[f64; 10], at: &Barycentric) -> [f64; 6] {
    let mix = |i: usize, j: usize, k: usize| at[0] * b[i] + at[1] * b[j] + at[2] * b[k];
    [mix(0, 1, 2), mix(1, 3, 4), mix(2, 4, 5), mix(3, 6, 7), mix(4, 7, 8), mix(5, 8, 9)]
}

/// One step of de Casteljau's algorithm, from six coefficients to three.
fn contract2(b: &[f64; 6], at: &Barycentric) -> [f64; 3] {
    let mix = |i: usize, j: usize, k: usize| at[0] * b[i] + at[1] * b[j] + at[2] * b[k];
    [mix(0, 1, 2), mix(1, 3, 4), mix(2, 4, 5)]
}

/// The last step of de Casteljau's algorithm.
fn contract1(b: &[f64; 3], at: &Barycentric) -> f64 {
    at[0] * b[0] + at[1] * b[1] + at[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const VERTICES: [Barycentric; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    fn power(base: f64, exponent: usize) -> f64 {
        base.powi(exponent as i32)
    }

    /// The definition, term by term.
    fn definition(cubic: &TriangleCubic, at: &Barycentric) -> f64 {
        let factorial = [1.0, 1.0, 2.0, 6.0];
        let mut sum = 0.0;
        for i in 0..=3 {
            for j in 0..=3 - i {
                let k = 3 - i - j;
                let weight = 6.0 / (factorial[i] * factorial[j] * factorial[k]);
                let monomial = power(at[0], i) * power(at[1], j) * power(at[2], k);
                sum += weight * monomial * cubic.coefficient([i, j, k]);
            }
        }
        sum
    }

    fn cubics() -> impl Strategy<Value = TriangleCubic> {
        prop::array::uniform10(-1.0..1.0f64).prop_map(TriangleCubic::new)
    }

    fn inside() -> impl Strategy<Value = Barycentric> {
        (0.0..1.0f64, 0.0..1.0f64).prop_map(|(s, t)| {
            let (s, t) = if s + t > 1.0 { (1.0 - s, 1.0 - t) } else { (s, t) };
            [1.0 - s - t, s, t]
        })
    }

    #[test]
    fn vertices_and_edges_by_hand() {
        let numbered = TriangleCubic::new([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
        assert_eq!(VERTICES.map(|v| numbered.value(&v)), [0.0, 6.0, 9.0]);
        assert_eq!(numbered.edge(0).coefficients, [6.0, 7.0, 8.0, 9.0]);
        assert_eq!(numbered.edge(1).coefficients, [9.0, 5.0, 2.0, 0.0]);
        assert_eq!(numbered.edge(2).coefficients, [0.0, 1.0, 3.0, 6.0]);
        assert_eq!(numbered.coefficient([1, 1, 1]), 4.0);
        assert_eq!(numbered.bounds(), (0.0, 9.0));
    }

    #[test]
    fn elevation_keeps_a_linear_function() {
        let linear = TriangleCubic::linear([1.0, 2.0, 4.0]);
        assert!((linear.value(&[0.5, 0.25, 0.25]) - 2.0).abs() < 1e-15);
    }

    #[test]
    fn bounds_of_values_are_met() {
        let mut bump = TriangleCubic::linear([0.0; 3]);
        bump.coefficients[TriangleCubic::CENTRE] = 1.0;
        let ([low, high], top) = (bump.value_bounds(), bump.value(&[1.0 / 3.0; 3]));
        assert!(low == 0.0 && top <= high && high < top + 1e-4, "{top} {high}");
    }

    proptest! {
        #[test]
        fn value_is_the_definition(p in cubics(), at in inside()) {
            prop_assert!((p.value(&at) - definition(&p, &at)).abs() < 1e-14);
        }

        #[test]
        fn bounds_hold(p in cubics(), at in inside()) {
            let (low, high) = p.bounds();
            let value = p.value(&at);
            prop_assert!(low - 1e-15 <= value && value <= high + 1e-15);
            let [least, greatest] = p.value_bounds();
            prop_assert!(low <= least && greatest <= high);
            prop_assert!(least - 1e-15 <= value && value <= greatest + 1e-15);
        }

        #[test]
        fn restriction_is_the_polynomial(p in cubics(), a in inside(), b in inside(), t in 0.0..1.0f64) {
            let at = super::super::between(&a, &b, t);
            prop_assert!((p.restrict(&a, &b).value(t) - p.value(&at)).abs() < 1e-14);
        }

        #[test]
        fn layers_are_the_coefficients_on_a_ray(p in cubics(), t in 0.0..1.0f64) {
            for apex in 0..3 {
                let mut base = [0.0; 3];
                base[(apex + 1) % 3] = 1.0 - t;
                base[(apex + 2) % 3] = t;
                let ray = p.restrict(&VERTICES[apex], &base);
                for layer in 0..4 {
                    let mean = p.layer(apex, layer).value(t);
                    prop_assert!((mean - ray.coefficients[layer]).abs() < 1e-14);
                }
            }
        }

        #[test]
        fn sub_triangle_is_the_polynomial(
            p in cubics(), a in inside(), b in inside(), c in inside(), at in inside(),
        ) {
            let mut whole = [0.0; 3];
            for n in 0..3 {
                whole[n] = at[0] * a[n] + at[1] * b[n] + at[2] * c[n];
            }
            prop_assert!((p.sub_triangle(&[a, b, c]).value(&at) - p.value(&whole)).abs() < 1e-14);
        }

        /// Derivatives along a direction agree with central differences.
        #[test]
        fn derivatives_are_slopes(p in cubics(), a in inside(), b in inside()) {
            let line = p.restrict(&a, &b);
            let middle = super::super::between(&a, &b, 0.5);
            let direction: Vec<f64> = (0..3).map(|n| b[n] - a[n]).collect();
            let gradient = p.barycentric_gradient(&middle);
            let hessian = p.barycentric_hessian(&middle);
            let slope: f64 = (0..3).map(|n| gradient[n] * direction[n]).sum();
            let mut bend = 0.0;
            for n in 0..3 {
                for m in 0..3 {
                    bend += hessian[n][m] * direction[n] * direction[m];
                }
            }
            prop_assert!((slope - line.derivative(0.5)).abs() < 1e-13);
            prop_assert!((bend - line.second_derivative(0.5)).abs() < 1e-12);
            let h = 1e-4;
            let difference = (line.value(0.5 + h) - line.value(0.5 - h)) / (2.0 * h);
            prop_assert!((slope - difference).abs() < 1e-6);
        }
    }
}
